/* SPDX-License-Identifier: MIT
 *
 * Rows G7, G10 and G11: callbacks that call the tracer, the state of the vector registers as a
 * callback and a caller find it, and threads. */
#if defined(__unix__) || defined(__APPLE__)
#define _POSIX_C_SOURCE 200809L
#define HAVE_THREADS
#include <pthread.h>
#endif

#include "stress.h"

#include <stdint.h>
#include <string.h>

#if defined(__x86_64__) && defined(__GNUC__)
#define HAVE_XGETBV
#include <cpuid.h>
#endif

/* ---- G7: recursion ------------------------------------------------------------------------- */

enum { deepest = 1000 };

/* Where in a trace the callback calls the tracer. */
typedef enum moment {
    AT_THE_FIRST_VALUE,
    WHILE_SKIPPING,
    IN_A_BRACKET,
} moment;

typedef struct descent {
    const stress_way *way;
    moment when;
    int depth, limit;
    int outcomes[deepest + 1];
    float t[deepest + 1];
    uintptr_t caller[deepest + 1]; /* an address in the frame that called the tracer */
    uintptr_t frame[deepest + 1];  /* and in the callback's, at each depth */
} descent;

static void descend(descent *self);

/* The sphere of the base scene; a slab that begins where the ray does and is left at 18; a jump. */
static float distance_of(moment when, float x, float y, float z) {
    if (when == WHILE_SKIPPING) return z < 9.0f ? z : 18.0f - z;
    if (when == IN_A_BRACKET) return z < 1.003f ? 0.5f : -0.5f;
    return stress_sphere_distance(stress_base().data, x, y, z);
}

/* Steps of 0.5 do not come so near to the jump as the bracket around it must. */
static int is_moment(moment when, float z) {
    if (when == WHILE_SKIPPING) return z > 0.0f;
    if (when == IN_A_BRACKET) return z > 1.001f && z < 1.005f;
    return 1;
}

/* One value of each level is asked for while all levels below it are traced. */
static float descending_distance(const void *data, float x, float y, float z) {
    descent *self = (descent *)(uintptr_t)data;
    volatile char here = 0;
    if (self->frame[self->depth] == 0 && is_moment(self->when, z)) {
        self->frame[self->depth] = (uintptr_t)&here;
        if (self->depth < self->limit) descend(self);
    }
    return distance_of(self->when, x, y, z);
}

/* In a small frame of its own: the compiler does not see through the pointer. */
static spt_status trace_below(descent *self, const spt_field *field, const spt_settings *settings,
                              const spt_rays *rays, const spt_hits *hits) {
    volatile char here = 0;
    self->caller[self->depth] = (uintptr_t)&here;
    const spt_status status = spt_trace(field, settings, 1, rays, hits, NULL);
    return here == 0 ? status : SPT_BAD_ARGUMENT;
}

static spt_status (*volatile trace_from_here)(descent *, const spt_field *, const spt_settings *,
                                              const spt_rays *, const spt_hits *) = trace_below;

static void descend(descent *self) {
    stress_case what = stress_case_of(descending_distance, self);
    /* Also for the bracket: the way to it may be the longer for it. */
    if (self->when != AT_THE_FIRST_VALUE) what.settings.flags = SPT_SKIP_START;
    const spt_settings settings = stress_settings(self->way, &what);
    const spt_rays rays = spt_rays_of(&what.ray);
    spt_hit hit;
    const spt_hits hits = spt_hits_of(&hit);
    spt_field field = stress_field(self->way, &what, NULL);
    stress_probe probe;
    probe.recorded = STRESS_RECORD; /* keep nothing */
    probe.distance = what.distance;
    probe.data = what.data;
    probe.single = 1;
    probe.calls = probe.points = probe.faults = 0;
    field.user = &probe;
    ++self->depth;
    CHECK(trace_from_here(self, &field, &settings, &rays, &hits) == SPT_OK);
    CHECK(probe.faults == 0);
    self->outcomes[self->depth] = hit.outcome;
    self->t[self->depth] = hit.t;
    --self->depth;
}

static void check_descent(stress_way *way, descent *self, moment when, int limit) {
    memset(self, 0, sizeof *self);
    self->way = way;
    self->when = when;
    self->limit = limit;
    descend(self);
    for (int depth = 1; depth <= limit; ++depth) {
        CHECK(self->outcomes[depth] == SPT_HIT);
        CHECK(self->frame[depth] != 0);
        CHECK(check_same_bits(self->t[depth], self->t[1]));
    }
}

/* trace.h: a level takes at most 32 KiB besides the callback's own, which here is the frames of the
 * probe and of what it calls: few hundred bytes, and no exception is made for them. Sanitizers move
 * locals out of the stack or widen frames, and without optimisation they are not shared. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
#define FRAMES_ARE_WIDENED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || \
    __has_feature(thread_sanitizer)
#define FRAMES_ARE_WIDENED
#endif
#endif

static descent levels;

static void check_frames(const descent *self, int limit) {
#ifndef FRAMES_ARE_WIDENED
    for (int depth = 1; depth <= limit; ++depth) {
        const uintptr_t above = self->caller[depth], below = self->frame[depth];
        const size_t level = (size_t)(above > below ? above - below : below - above);
        CHECK_SAY(level > 0 && level <= 32 * 1024, "%u bytes at depth %d", (unsigned)level, depth);
    }
#else
    (void)self, (void)limit;
#endif
}

static void recurse(moment when) {
    const uint32_t convex = when == AT_THE_FIRST_VALUE ? STRESS_CONVEX : 0;
    for (stress_way way = stress_ways(convex | STRESS_OWN_RAYS); stress_next(&way);) {
        check_descent(&way, &levels, when, 100);
        check_frames(&levels, 100);
    }
}

static void G7_recursion_on_the_usual_stack(void) {
    recurse(AT_THE_FIRST_VALUE);
}

static void G7c_recursion_while_skipping(void) {
    recurse(WHILE_SKIPPING);
}

static void G7d_recursion_in_a_bracket(void) {
    recurse(IN_A_BRACKET);
}

#ifdef HAVE_THREADS
static void *descend_deep(void *unused) {
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        check_descent(&way, &levels, AT_THE_FIRST_VALUE, deepest);
    }
    return unused;
}
#endif

static void G7b_recursion_on_a_large_stack(void) {
#ifdef HAVE_THREADS
    pthread_attr_t attributes;
    pthread_t thread;
    CHECK(pthread_attr_init(&attributes) == 0);
    CHECK(pthread_attr_setstacksize(&attributes, (size_t)64 << 20) == 0);
    CHECK(pthread_create(&thread, &attributes, descend_deep, NULL) == 0);
    CHECK(pthread_join(thread, NULL) == 0);
    pthread_attr_destroy(&attributes);
#else
    check_skip("G7b: no threads here");
#endif
}

/* ---- G10: the upper halves of the vector registers ------------------------------------------ */

#ifdef HAVE_XGETBV
/* Bit 2 of XGETBV with ecx = 1: some upper half is not in its initial state. */
static int upper_halves_used(void) {
    uint32_t low, high;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(1));
    (void)high;
    return (low & 4u) != 0;
}

/* The processor has that form of XGETBV, and it tells used from clean. */
static int upper_halves_are_visible(void) {
    unsigned a, b, c, d;
    if (!__get_cpuid_count(1, 0, &a, &b, &c, &d) || (c & (1u << 27)) == 0) return 0; /* OSXSAVE */
    if (!__get_cpuid_count(0xd, 1, &a, &b, &c, &d) || (a & 4u) == 0) return 0;
    if (!__builtin_cpu_supports("avx2")) return 0;
    __asm__ volatile("vpcmpeqd %%ymm0, %%ymm0, %%ymm0" : : : "xmm0");
    const int used = upper_halves_used();
    __asm__ volatile("vzeroupper" : : : "xmm0");
    return used && !upper_halves_used();
}

static float register_spy(const void *data, float x, float y, float z) {
    int *dirty = (int *)(uintptr_t)data;
    *dirty += upper_halves_used();
    return stress_sphere_distance(stress_base().data, x, y, z);
}
#endif

static void G10_upper_halves_are_clean(void) {
#ifdef HAVE_XGETBV
    if (!upper_halves_are_visible()) {
        check_skip("G10: the state of the upper halves cannot be read here");
        return;
    }
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        int dirty = 0;
        const stress_case what = stress_case_of(register_spy, &dirty);
        const spt_settings settings = stress_settings(&way, &what);
        const spt_rays rays = spt_rays_of(&what.ray);
        spt_hit hit;
        const spt_hits hits = spt_hits_of(&hit);
        stress_probe probe;
        stress_probe_of(&probe, &what, 1);
        const spt_field field = stress_field(&way, &what, &probe);
        const spt_status status = spt_trace(&field, &settings, 1, &rays, &hits, NULL);
        const int after = upper_halves_used();
        __asm__ volatile("vzeroupper" : : : "xmm0");
        CHECK(status == SPT_OK && probe.calls > 0);
        CHECK_SAY(dirty == 0, "%d callbacks found them used", dirty);
        CHECK(!after);
    }
#else
    check_skip("G10: no XGETBV here");
#endif
}

/* ---- G11: threads -------------------------------------------------------------------------- */

#ifdef HAVE_THREADS
enum { threads = 2, thread_rays = 300 };

typedef struct worker {
    pthread_barrier_t *start;
    stress_way way;
    spt_hit hits[thread_rays];
    size_t faults;
} worker;

static void make_rays(spt_ray rays[thread_rays]) {
    for (int i = 0; i < thread_rays; ++i) {
        rays[i] = stress_base().ray;
        rays[i].origin[0] = 0.005f * (float)i;
    }
}

/* check.h has one state for all threads: nothing is checked here. */
static void *work(void *user) {
    worker *self = user;
    const stress_case what = stress_base();
    const spt_settings settings = stress_settings(&self->way, &what);
    spt_ray array[thread_rays];
    stress_probe probe;
    make_rays(array);
    stress_probe_of(&probe, &what, 0);
    const spt_field field = stress_field(&self->way, &what, &probe);
    const spt_rays rays = spt_rays_of(array);
    const spt_hits hits = spt_hits_of(self->hits);
    pthread_barrier_wait(self->start);
    const spt_status status = spt_trace(&field, &settings, thread_rays, &rays, &hits, NULL);
    self->faults = probe.faults + (status != SPT_OK);
    return NULL;
}
#endif

/* Run alone (`build/check G11`) under ThreadSanitizer this is the first call of the process. */
static void G11_first_calls_at_once(void) {
#ifdef HAVE_THREADS
    static worker workers[threads];
    static spt_hit expected[thread_rays];
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        pthread_barrier_t start;
        pthread_t thread[threads];
        const stress_case what = stress_base();
        spt_ray rays[thread_rays];
        CHECK(pthread_barrier_init(&start, NULL, threads) == 0);
        for (int i = 0; i < threads; ++i) {
            workers[i].start = &start;
            workers[i].way = way;
            CHECK(pthread_create(&thread[i], NULL, work, &workers[i]) == 0);
        }
        for (int i = 0; i < threads; ++i) CHECK(pthread_join(thread[i], NULL) == 0);
        pthread_barrier_destroy(&start);
        make_rays(rays);
        stress_run_many(&way, &what, thread_rays, rays, expected);
        for (int i = 0; i < threads; ++i) {
            CHECK(workers[i].faults == 0);
            CHECK(memcmp(workers[i].hits, expected, sizeof expected) == 0);
        }
    }
#else
    check_skip("G11: no threads here");
#endif
}

void suite_reentry(void) {
    RUN(G11_first_calls_at_once);
    RUN(G7_recursion_on_the_usual_stack);
    RUN(G7b_recursion_on_a_large_stack);
    RUN(G7c_recursion_while_skipping);
    RUN(G7d_recursion_in_a_bracket);
    RUN(G10_upper_halves_are_clean);
}
