/* SPDX-License-Identifier: MIT
 *
 * Rows G1, G3, G5, G10 and G11 for the calls of krs.h and mobius.h: hosts with another
 * floating-point environment, callers' fields that leave by longjmp, the state of the vector
 * registers, and threads that share a model. Recursion is in test_krs_recursion.c. */
#if defined(__unix__) || defined(__APPLE__)
#define _POSIX_C_SOURCE 200809L
#define HAVE_THREADS
#include <pthread.h>
#endif

#include "krs_world.h"
#include "stress.h"
#include "test_scene_registers.h"

#include <setjmp.h>
#include <string.h>

#if defined(__SSE2__)
#define HAVE_MXCSR
#include <immintrin.h>
#endif

static krs_world world;
static krs_call call;
static unsigned char right[krs_outputs][krs_most][8];

static void prepare(int door) {
    check_context("%s, %u lanes, form %u", krs_table[door].name, (unsigned)world.lanes,
                  (unsigned)world.form);
    krs_world_call(&call, &world, (krs_door)door);
}

static void keep_right(int door) {
    prepare(door);
    CHECK(krs_place_call(&call) == SPT_OK);
    memcpy(right, world.out, sizeof right);
    prepare(door);
}

static void check_right(spt_status status) {
    CHECK(status == SPT_OK && memcmp(right, world.out, sizeof right) == 0);
}

#define FOR_EACH_WAY(door) \
    for (int way = 0; way < STRESS_WIDTHS * krs_forms; ++way) \
        if (krs_world_make(&world, (uint32_t)way % krs_forms, stress_widths[way / krs_forms])) \
            for (int door = 0; door < krs_doors; ++door)

/* ---- G1, G3: the floating-point environment -------------------------------------------------- */

#ifdef HAVE_MXCSR
enum { control_bits = 0xffc0, flush_bits = 0x8040, invalid_masked = 0x80, division_masked = 0x200 };
enum { invalid_seen = 0x01, division_seen = 0x04 };

static struct {
    unsigned control;
    size_t changed, calls;
} spy;

static void look_at_control(void *unused) {
    (void)unused;
    ++spy.calls;
    spy.changed += (_mm_getcsr() & control_bits) != spy.control;
}
#endif

static void G1ka_krs_control_bits_untouched(void) {
#ifdef HAVE_MXCSR
    static const unsigned modes[] = {0, flush_bits, 0x2000, 0x4000, 0x6000 | flush_bits};
    const unsigned saved = _mm_getcsr();
    FOR_EACH_WAY(door) {
        const int i = (door + way) % 5;
        prepare(door);
        krs_world_visit(&world, look_at_control, NULL);
        _mm_setcsr(saved | modes[i]);
        spy.control = _mm_getcsr() & control_bits;
        spy.changed = spy.calls = 0;
        const spt_status status = krs_place_call(&call);
        const unsigned after = _mm_getcsr() & control_bits;
        _mm_setcsr(saved);
        krs_world_visit(&world, NULL, NULL);
        CHECK(status == SPT_OK && after == spy.control && spy.changed == 0);
        CHECK((spy.calls > 0) == (door != KRS_DOOR_POINTS));
    }
#else
    check_skip("G1ka: no MXCSR here");
#endif
}

static void G1kb_krs_denormals_flushed(void) {
#ifdef HAVE_MXCSR
    const unsigned saved = _mm_getcsr();
    FOR_EACH_WAY(door) {
        keep_right(door);
        _mm_setcsr(saved | flush_bits);
        const spt_status status = krs_place_call(&call);
        _mm_setcsr(saved);
        check_right(status);
    }
#else
    check_skip("G1kb: no MXCSR here");
#endif
}

enum { no_number = 22 }; /* the ray of the world with a NaN in it: no valid one */

#ifdef HAVE_MXCSR
static void check_exceptions(int door) {
    const unsigned saved = _mm_getcsr();
    prepare(door);
    _mm_setcsr(saved & ~(unsigned)(invalid_seen | division_seen));
    CHECK(krs_place_call(&call) == SPT_OK);
    const unsigned seen = _mm_getcsr() & (invalid_seen | division_seen);
    _mm_setcsr(saved);
    CHECK_SAY(seen == 0, "exceptions %x raised", seen);
    if (seen != 0) return; /* unmasked, they would end the program */
    memcpy(right, world.out, sizeof right);
    prepare(door);
    _mm_setcsr((saved & ~(unsigned)(invalid_masked | division_masked)) & control_bits);
    const spt_status status = krs_place_call(&call);
    _mm_setcsr(saved);
    check_right(status);
}
#endif

/* Valid rays and finite values raise neither invalid operations nor divisions by zero, not at
 * mirrors and poles either, so that hosts may trap them: rays that end, */
static void G3ka_krs_exceptions_unmasked(void) {
#ifdef HAVE_MXCSR
    FOR_EACH_WAY(door) {
        world.in[KRS_IN_ACTIVE][no_number] = 0;
        for (int i = 0; i < krs_most; ++i) {
            if (krs_float(world.in[KRS_IN_T_MAX][i]) > 1e6f) {
                world.in[KRS_IN_T_MAX][i] = krs_bits(1e6f);
            }
        }
        check_exceptions(door);
    }
#else
    check_skip("G3ka: no MXCSR here");
#endif
}

/* and rays without end past models without. */
static void G3kb_krs_exceptions_without_end(void) {
#ifdef HAVE_MXCSR
    FOR_EACH_WAY(door) {
        world.in[KRS_IN_ACTIVE][no_number] = 0;
        check_exceptions(door);
    }
#else
    check_skip("G3kb: no MXCSR here");
#endif
}

/* ---- G5: longjmp ----------------------------------------------------------------------------- */

static struct {
    jmp_buf way_out;
    int left; /* visits before leaving */
} leaving;

static void leave(void *unused) {
    (void)unused;
    if (leaving.left-- == 0) longjmp(leaving.way_out, 1);
}

static int escapes(int after) {
    leaving.left = after;
    if (setjmp(leaving.way_out) != 0) return 1;
    krs_place_call(&call);
    return 0;
}

static void G5ka_krs_longjmp_out_of_a_kernel(void) {
    static const int visits[] = {0, 1, 3, 8};
    int escaped = 0;
    FOR_EACH_WAY(door) {
        keep_right(door);
        for (int i = 0; i < 4; ++i) {
            krs_world_visit(&world, leave, NULL);
            escaped += escapes(visits[i]);
            krs_world_visit(&world, NULL, NULL);
        }
        prepare(door);
        check_right(krs_place_call(&call));
    }
    /* All but the points of the library's own distortion ask at least once. */
    CHECK_SAY(escaped >= STRESS_WIDTHS * krs_forms * (krs_doors - 1), "%d escapes", escaped);
}

/* ---- G10: the upper halves of the vector registers ------------------------------------------- */

static int dirty;

static void look_at_registers(void *unused) {
    (void)unused;
    dirty += upper_halves_used();
}

static void G10ka_krs_upper_halves_are_clean(void) {
    if (!upper_halves_are_visible()) {
        check_skip("G10ka: the state of the upper halves cannot be read here");
        return;
    }
    FOR_EACH_WAY(door) {
        prepare(door);
        krs_world_visit(&world, look_at_registers, NULL);
        dirty = 0;
        const spt_status status = krs_place_call(&call);
        const int after = upper_halves_used();
        upper_halves_clean();
        krs_world_visit(&world, NULL, NULL);
        CHECK(status == SPT_OK);
        CHECK_SAY(dirty == 0, "%d callbacks found them used", dirty);
        CHECK(!after);
    }
}

/* ---- G11: threads ---------------------------------------------------------------------------- */

#ifdef HAVE_THREADS
enum { threads = 2 };

/* What a thread writes; the models are those of one world, whose witnesses only add to counts, so
 * that they are asked by a copy of their own. */
typedef struct worker {
    unsigned char out[krs_doors][krs_outputs][krs_most][8];
    spt_statistics statistics;
    size_t faults;
} worker;

static const krs_call *shared_calls;

/* check.h has one state for all threads: nothing is checked here. */
static void *work(void *user) {
    worker *const self = user;
    self->statistics = spt_statistics_default();
    for (int door = 0; door < krs_doors; ++door) {
        krs_call own = shared_calls[door];
        own.statistics = &self->statistics;
        memset(self->out[door], krs_fill, sizeof self->out[door]);
        for (int column = 0; column < krs_table[door].outputs; ++column) {
            own.out[column].first = self->out[door][column];
        }
        self->faults += krs_place_call(&own) != SPT_OK;
    }
    return NULL;
}

static void silent_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                         float *distance) {
    for (size_t i = 0; i < n; ++i) distance[i] = krs_witness_distance(user, x[i], y[i], z[i]);
}

static void silent_unmap(void *user, size_t n, float *x, float *y, float *z) {
    (void)user, (void)z;
    for (size_t i = 0; i < n; ++i) x[i] -= 0.25f * y[i];
}

/* Callbacks that write nothing: what a race is must be the library's. */
static void silence(void) {
    for (int i = 0; i < krs_witnesses; ++i) {
        world.inner[i].batch = silent_batch;
        world.inner[i].gradient = NULL;
    }
    world.model.smooth = world.mapped_model.smooth = 0.0f;
    world.unmapping.unmap = silent_unmap;
    CHECK(krs_world_models(&world));
}
#endif

static void G11ka_krs_models_shared_by_threads(void) {
#ifdef HAVE_THREADS
    static worker workers[threads], alone;
    static krs_call calls[krs_doors];
    pthread_t thread[threads];
    CHECK(krs_world_make(&world, 0, 0));
    silence();
    for (int door = 0; door < krs_doors; ++door) {
        krs_world_call(&calls[door], &world, (krs_door)door);
    }
    shared_calls = calls;
    for (int i = 0; i < threads; ++i) {
        CHECK(pthread_create(&thread[i], NULL, work, &workers[i]) == 0);
    }
    for (int i = 0; i < threads; ++i) CHECK(pthread_join(thread[i], NULL) == 0);
    work(&alone);
    for (int i = 0; i < threads; ++i) {
        CHECK(workers[i].faults == 0 && alone.faults == 0);
        CHECK(memcmp(workers[i].out, alone.out, sizeof alone.out) == 0);
        CHECK(workers[i].statistics.evaluations == alone.statistics.evaluations);
    }
#else
    check_skip("G11ka: no threads here");
#endif
}

void suite_krs_host(void) {
    RUN(G11ka_krs_models_shared_by_threads);
    RUN(G1ka_krs_control_bits_untouched);
    RUN(G1kb_krs_denormals_flushed);
    RUN(G3ka_krs_exceptions_unmasked);
    RUN(G3kb_krs_exceptions_without_end);
    RUN(G5ka_krs_longjmp_out_of_a_kernel);
    RUN(G10ka_krs_upper_halves_are_clean);
}
