/* SPDX-License-Identifier: MIT
 *
 * Rows G1, G3, G5, G7, G10 and G11 for frames: callbacks of components, cameras, shading and
 * progress that leave by longjmp or trace frames themselves, other floating-point environments, the
 * state of the vector registers, cancelling, and threads that share the tiles of one frame. */
#if defined(__unix__) || defined(__APPLE__)
#define _POSIX_C_SOURCE 200809L
#define HAVE_THREADS
#include <pthread.h>
#endif

#include "test_frame_cases.h"
#include "test_scene_registers.h"

#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#if defined(__SSE2__)
#define HAVE_MXCSR
#include <immintrin.h>
#endif

static frame_case self;
static spt_hit right[frame_pixels];

#define FOR_EACH_WAY \
    stress_way way = stress_ways(STRESS_CONVEX | STRESS_ONCE | STRESS_OWN_RAYS); \
    stress_next(&way);

static void expect_right(const char *what, int number) {
    CHECK_SAY(frame_differing(self.hits, right, frame_pixels) == 0, "%s %d: %u pixels differ", what,
              number, (unsigned)frame_differing(self.hits, right, frame_pixels));
}

/* ---- Callbacks that do something else -------------------------------------------------------- */

enum { in_component, in_camera, in_shade, in_progress, places };

static struct {
    int where, left; /* calls of that place before the deed; negative: none */
    void (*deed)(void);
    unsigned control;
    size_t seen, changed, dirty, deepest;
    int watches_registers;
    uintptr_t caller; /* an address in the frame that called the library */
} spy;

static void look(void) {
    volatile char here = 0;
    ++spy.seen;
#ifdef HAVE_MXCSR
    spy.changed += (_mm_getcsr() & 0xffc0u) != spy.control;
#endif
    if (spy.watches_registers) spy.dirty += upper_halves_used() != 0;
    const uintptr_t address = (uintptr_t)&here;
    const size_t depth =
        (size_t)(address > spy.caller ? address - spy.caller : spy.caller - address);
    if (depth > spy.deepest) spy.deepest = depth;
}

static void at(int where) {
    look();
    if (spy.where != where || spy.left < 0) return;
    if (spy.left-- == 0 && spy.deed != NULL) spy.deed();
}

static float watched_distance(const void *data, float x, float y, float z) {
    at(in_component);
    return stress_sphere_distance(data, x, y, z);
}

static spt_camera behind; /* whose rays the callback gives */

static void watched_rays(void *user, size_t count, const float *x, const float *y,
                         spt_camera_ray *rays) {
    (void)user;
    at(in_camera);
    CHECK(count >= 1 && count <= SPT_BATCH);
    CHECK(spt_camera_rays(&behind, frame_width, frame_height, count, x, y, rays) == SPT_OK);
}

static void watched_shade(void *user, size_t count, const float *x, const float *y,
                          const spt_ray *rays, const spt_hit *hits, float *colours) {
    (void)user, (void)x, (void)y, (void)rays;
    at(in_shade);
    for (size_t i = 0; i < count * frame_channels; ++i) colours[i] = hits[i / 3].t < 50.0f;
}

static int watched_progress(void *user, size_t done, size_t total) {
    (void)user, (void)done, (void)total;
    at(in_progress);
    return 0;
}

static void watch(const stress_way *way) {
    frame_base(&self, way);
    behind = self.camera;
    self.camera = spt_camera_of_rays(watched_rays, NULL);
    self.world.parts[4].distance = self.world.parts[1].distance = watched_distance;
    self.frame.shade = watched_shade;
    self.frame.progress = watched_progress;
    memset(&spy, 0, sizeof spy);
    spy.left = -1;
#ifdef HAVE_MXCSR
    spy.control = _mm_getcsr() & 0xffc0u;
#endif
    frame_memory(&self);
}

/* ---- G5: longjmp ----------------------------------------------------------------------------- */

static jmp_buf way_out;

static void leave(void) {
    longjmp(way_out, 1);
}

static int tiles_escape(void) {
    if (setjmp(way_out) != 0) return 1;
    frame_trace_whole(&self);
    return 0;
}

static int passes_escape(void) {
    if (setjmp(way_out) != 0) return 1;
    spt_frame_advance(&self.frame, self.state, self.state_size, UINT64_MAX, &self.image, NULL);
    return 0;
}

static void G5c_longjmp_out_of_a_frame(void) {
    for (FOR_EACH_WAY) {
        int escaped[places] = {0, 0, 0, 0};
        watch(&way);
        frame_trace_whole(&self);
        memcpy(right, self.hits, sizeof right);
        for (int i = 0; i < 3 * places; ++i) {
            spy.where = i % places;
            spy.left = i / places;
            spy.deed = leave;
            escaped[i % places] += tiles_escape();
            spy.left = -1;
            memset(self.hits, 0xa5, sizeof self.hits);
            frame_trace_whole(&self);
            expect_right("tiles, escape", i);
        }
        CHECK(escaped[in_component] == 3 && escaped[in_camera] == 3 && escaped[in_progress] == 3);
    }
}

/* A state that a call left in the middle is begun anew, and nothing of that shows. */
static void G5d_longjmp_out_of_a_progressive_frame(void) {
    for (FOR_EACH_WAY) {
        int escaped[places] = {0, 0, 0, 0};
        watch(&way);
        frame_advance_whole(&self, UINT64_MAX);
        memcpy(right, self.hits, sizeof right);
        for (int i = 0; i < 3 * in_progress; ++i) {
            CHECK(spt_frame_restart(&self.frame, self.state, self.state_size) == SPT_OK);
            spy.where = i % in_progress;
            spy.left = i / in_progress * 5;
            spy.deed = leave;
            escaped[i % in_progress] += passes_escape();
            spy.left = -1;
            memset(self.hits, 0xa5, sizeof self.hits);
            frame_advance_whole(&self, 100000);
            expect_right("passes, escape", i);
        }
        CHECK(escaped[in_component] == 3 && escaped[in_camera] == 3 && escaped[in_shade] == 3);
    }
}

/* ---- G7: recursion --------------------------------------------------------------------------- */

static frame_case inner;
static spt_hit inner_right[frame_pixels];
static const stress_way *inner_way;

static void trace_inner(void) {
    frame_base(&inner, inner_way);
    frame_trace_whole(&inner);
    CHECK(frame_differing(inner.hits, inner_right, frame_pixels) == 0);
    frame_advance_whole(&inner, 50000);
}

static void G7h_frames_within_frames(void) {
    for (FOR_EACH_WAY) {
        inner_way = &way;
        frame_base(&inner, &way);
        frame_trace_whole(&inner);
        memcpy(inner_right, inner.hits, sizeof inner_right);
        watch(&way);
        frame_trace_whole(&self);
        memcpy(right, self.hits, sizeof right);
        for (int i = 0; i < 2 * places; ++i) {
            spy.where = i % places;
            spy.left = i / places;
            spy.deed = trace_inner;
            memset(self.hits, 0xa5, sizeof self.hits);
            frame_trace_whole(&self);
            expect_right("recursion", i);
            if (spy.where != in_shade) CHECK(spy.left == -1); /* it happened */
        }
        frame_advance_whole(&self, UINT64_MAX);
        memcpy(right, self.hits, sizeof right);
        spy.where = in_shade;
        spy.left = 2;
        frame_advance_whole(&self, UINT64_MAX);
        CHECK(spy.left == -1);
        expect_right("recursion in shade", 0);
    }
    frame_free(&inner);
}

/* ---- G1, G3, G10: the host's registers ------------------------------------------------------- */

static void G1d_frame_environment(void) {
#ifdef HAVE_MXCSR
    enum { exceptions = 0x05, flush = 0x8040, masks = 0x280 }; /* invalid and division */
    static const unsigned modes[] = {0, flush, 0x2000, 0x4000, 0x6000 | flush};
    const unsigned saved = _mm_getcsr();
    for (FOR_EACH_WAY) {
        watch(&way);
        frame_trace_whole(&self);
        frame_advance_whole(&self, 100000);
        memcpy(right, self.hits, sizeof right);
        for (int i = 0; i < 5; ++i) {
            _mm_setcsr((saved & ~(unsigned)exceptions) | modes[i]);
            spy.control = _mm_getcsr() & 0xffc0u;
            frame_trace_whole(&self);
            frame_advance_whole(&self, 100000);
            const unsigned after = _mm_getcsr();
            _mm_setcsr(saved);
            CHECK((after & 0xffc0u) == spy.control && spy.changed == 0 && spy.seen > 0);
            CHECK_SAY((after & exceptions) == 0, "exceptions %x raised", after & exceptions);
            if ((after & exceptions) != 0) return; /* unmasked, they would end the program */
            if (i < 2) expect_right("mode", i);    /* bits are promised for rounding to nearest */
        }
        _mm_setcsr((saved & ~(unsigned)masks) & 0xffc0u);
        spy.control = _mm_getcsr() & 0xffc0u;
        frame_advance_whole(&self, 100000);
        _mm_setcsr(saved);
        expect_right("unmasked", 0);
    }
#else
    check_skip("G1d: no MXCSR here");
#endif
}

static void G10c_frame_upper_halves_are_clean(void) {
    if (!upper_halves_are_visible()) {
        check_skip("G10c: the state of the upper halves cannot be read here");
        return;
    }
    for (FOR_EACH_WAY) {
        watch(&way);
        spy.watches_registers = 1;
        frame_trace_whole(&self);
        look();
        frame_advance_whole(&self, 100000);
        look();
        spy.watches_registers = 0;
        CHECK_SAY(spy.dirty == 0, "%u times they were found used", (unsigned)spy.dirty);
        CHECK(spy.seen > 100);
    }
}

/* trace.h: a level takes at most 32 KiB besides the callback's own. Few hundred bytes of the test's
 * own frames are counted with it. */
static void G7i_frame_stack(void) {
#ifndef FRAMES_ARE_WIDENED
    for (FOR_EACH_WAY) {
        volatile char here = 0;
        watch(&way);
        spy.caller = (uintptr_t)&here;
        frame_trace_whole(&self);
        frame_advance_whole(&self, 100000);
        CHECK_SAY(spy.deepest > 100 && spy.deepest <= 32 * 1024, "%u bytes", (unsigned)spy.deepest);
    }
#endif
}

/* ---- Cancelling ------------------------------------------------------------------------------ */

static struct { size_t calls, stop_after, faults, total; } counted;

static int counting_progress(void *user, size_t done, size_t total) {
    counted.faults += user != &counted || done != ++counted.calls || done > total;
    counted.total = total;
    return done == counted.stop_after;
}

static void frame_cancelled_between_tiles(void) {
    for (FOR_EACH_WAY) {
        frame_base(&self, &way);
        frame_trace_whole(&self);
        memcpy(right, self.hits, sizeof right);
        self.frame.progress = counting_progress;
        self.frame.progress_user = &counted;
        for (size_t stop = 1; stop <= 3; ++stop) {
            size_t done = 0;
            memset(&counted, 0, sizeof counted);
            counted.stop_after = stop;
            memset(self.hits, 0xa5, sizeof self.hits);
            CHECK(spt_frame_trace(&self.frame, 0, 4, &self.image, &done) == SPT_OK);
            CHECK(done == stop && counted.calls == stop && counted.faults == 0);
            CHECK(counted.total == 4);
            counted.stop_after = counted.calls = 0;
            CHECK(spt_frame_trace(&self.frame, stop, 4 - stop, &self.image, &done) == SPT_OK);
            CHECK(done == 4 - stop && counted.faults == 0 && counted.total == 4 - stop);
            expect_right("cancelled after", (int)stop);
        }
    }
}

/* ---- G11: threads on the tiles of one frame -------------------------------------------------- */

#ifdef HAVE_THREADS
enum { threads = 4 };

typedef struct shared_frame {
    pthread_mutex_t mutex;
    size_t next, tiles;
} shared_frame;

typedef struct worker {
    shared_frame *shared;
    spt_frame frame; /* a copy */
    spt_statistics statistics;
    union_scene world; /* of its own: the parts count their calls */
    size_t failures;
    pthread_t thread;
} worker;

static void *work(void *user) {
    worker *const one = user;
    for (;;) {
        pthread_mutex_lock(&one->shared->mutex);
        const size_t tile = one->shared->next++;
        pthread_mutex_unlock(&one->shared->mutex);
        if (tile >= one->shared->tiles) return NULL;
        one->failures += spt_frame_tile(&one->frame, tile, &self.image) != SPT_OK;
    }
}

static void G11b_threads_share_a_frame(void) {
    static worker workers[threads];
    for (FOR_EACH_WAY) {
        shared_frame shared;
        spt_statistics alone = spt_statistics_default();
        uint64_t evaluations = 0, rays = 0, cones = 0, kept = 0;
        frame_base(&self, &way);
        self.frame.statistics = &alone;
        frame_trace_whole(&self);
        memcpy(right, self.hits, sizeof right);
        memset(self.hits, 0xa5, sizeof self.hits);
        CHECK(pthread_mutex_init(&shared.mutex, NULL) == 0);
        shared.next = 0;
        shared.tiles = spt_frame_tiles(&self.frame);
        for (int i = 0; i < threads; ++i) {
            worker *const one = &workers[i];
            one->shared = &shared;
            one->frame = self.frame;
            one->statistics = spt_statistics_default();
            union_base(&one->world, &way);
            one->frame.scene = &one->world.scene;
            one->frame.statistics = &one->statistics;
            one->frame.workspace = malloc(one->frame.workspace_size);
            one->failures = 0;
            CHECK(pthread_create(&one->thread, NULL, work, one) == 0);
        }
        for (int i = 0; i < threads; ++i) {
            CHECK(pthread_join(workers[i].thread, NULL) == 0);
            CHECK(workers[i].failures == 0);
            evaluations += workers[i].statistics.evaluations;
            rays += workers[i].statistics.rays;
            cones += workers[i].statistics.cone_evaluations;
            kept += workers[i].statistics.kept;
            free(workers[i].frame.workspace);
        }
        pthread_mutex_destroy(&shared.mutex);
        expect_right("threads", threads);
        CHECK(rays == frame_pixels && rays == alone.rays && evaluations == alone.evaluations);
        CHECK(cones == alone.cone_evaluations && kept == alone.kept);
    }
}
#endif

void suite_frame_host(void) {
#ifdef HAVE_THREADS
    RUN(G11b_threads_share_a_frame);
#endif
    RUN(G5c_longjmp_out_of_a_frame);
    RUN(G5d_longjmp_out_of_a_progressive_frame);
    RUN(G7h_frames_within_frames);
    RUN(G1d_frame_environment);
    RUN(G7i_frame_stack);
    RUN(G10c_frame_upper_halves_are_clean);
    RUN(frame_cancelled_between_tiles);
    frame_free(&self);
}
