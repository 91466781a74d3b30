/* SPDX-License-Identifier: MIT
 *
 * Rows G1, G3, G5, G7, G10 and G11 for the calls of surface.h: hosts with another floating-point
 * environment, callbacks that leave by longjmp or call the library themselves, the state of the
 * vector registers, and threads. */
#if defined(__unix__) || defined(__APPLE__)
#define _POSIX_C_SOURCE 200809L
#define HAVE_THREADS
#include <pthread.h>
#endif

#include "stress.h"
#include "surface_world.h"
#include "test_scene_registers.h"

#include <setjmp.h>
#include <string.h>

#if defined(__SSE2__)
#define HAVE_MXCSR
#include <immintrin.h>
#endif

static surface_world world;
static surface_call call;
static uint32_t right[surface_outputs][surface_most * surface_most_crossings];

enum { some = 60, forms = 4 };

static void prepare(int door, int width, uint32_t form) {
    check_context("%s, %u lanes, form %u", surface_table[door].name, (unsigned)stress_widths[width],
                  (unsigned)form);
    surface_call_make(&call, &world, (surface_door)door, stress_widths[width], form);
    call.count = some;
}

#define FOR_EACH_WAY(door, width, form) \
    surface_world_make(&world); \
    for (int door = 0; door < surface_doors; ++door) \
        for (int width = 0; width < STRESS_WIDTHS; ++width) \
            for (uint32_t form = 0; form < forms; ++form)

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

static void G1sa_surface_control_bits_untouched(void) {
#ifdef HAVE_MXCSR
    static const unsigned modes[] = {0, flush_bits, 0x2000, 0x4000, 0x6000 | flush_bits};
    const unsigned saved = _mm_getcsr();
    FOR_EACH_WAY(door, width, form) {
        for (int i = 0; i < 5; ++i) {
            prepare(door, width, form);
            surface_visit(&world, look_at_control, NULL);
            _mm_setcsr(saved | modes[i]);
            spy.control = _mm_getcsr() & control_bits;
            spy.changed = spy.calls = 0;
            const spt_status status = surface_place(&call);
            const unsigned after = _mm_getcsr() & control_bits;
            _mm_setcsr(saved);
            surface_visit(&world, NULL, NULL);
            CHECK(status == SPT_OK && after == spy.control);
            CHECK(spy.calls > 0 && spy.changed == 0);
        }
    }
#else
    check_skip("G1sa: no MXCSR here");
#endif
}

static void G1sb_surface_denormals_flushed(void) {
#ifdef HAVE_MXCSR
    const unsigned saved = _mm_getcsr();
    FOR_EACH_WAY(door, width, form) {
        prepare(door, width, form);
        CHECK(surface_place(&call) == SPT_OK);
        memcpy(right, world.out, sizeof right);
        prepare(door, width, form);
        _mm_setcsr(saved | flush_bits);
        const spt_status status = surface_place(&call);
        _mm_setcsr(saved);
        CHECK(status == SPT_OK && memcmp(right, world.out, sizeof right) == 0);
    }
#else
    check_skip("G1sb: no MXCSR here");
#endif
}

/* Rays that run along an axis, lie in the surface of the bound and pass everything are among them;
 * so are normals of no length and bodies whose ends are one point. */
static void G3sa_surface_exceptions_unmasked(void) {
#ifdef HAVE_MXCSR
    const unsigned saved = _mm_getcsr();
    FOR_EACH_WAY(door, width, form) {
        prepare(door, width, form);
        call.count = surface_most;
        _mm_setcsr(saved & ~(unsigned)(invalid_seen | division_seen));
        CHECK(surface_place(&call) == SPT_OK);
        const unsigned seen = _mm_getcsr() & (invalid_seen | division_seen);
        _mm_setcsr(saved);
        CHECK_SAY(seen == 0, "exceptions %x raised", seen);
        if (seen != 0) continue; /* unmasked, they would end the program */
        memcpy(right, world.out, sizeof right);
        prepare(door, width, form);
        call.count = surface_most;
        _mm_setcsr((saved & ~(unsigned)(invalid_masked | division_masked)) & control_bits);
        const spt_status status = surface_place(&call);
        _mm_setcsr(saved);
        CHECK(status == SPT_OK && memcmp(right, world.out, sizeof right) == 0);
    }
#else
    check_skip("G3sa: no MXCSR here");
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
    surface_place(&call);
    return 0;
}

static void G5sb_surface_longjmp_out_of_a_callback(void) {
    static const int visits[] = {0, 1, 2, 3, 5, 8, 20};
    int escaped = 0;
    FOR_EACH_WAY(door, width, form) {
        prepare(door, width, form);
        CHECK(surface_place(&call) == SPT_OK);
        memcpy(right, world.out, sizeof right);
        for (int i = 0; i < 7; ++i) {
            prepare(door, width, form);
            surface_visit(&world, leave, NULL);
            escaped += escapes(visits[i]);
            surface_visit(&world, NULL, NULL);
        }
        prepare(door, width, form);
        CHECK(surface_place(&call) == SPT_OK);
        CHECK(memcmp(right, world.out, sizeof right) == 0);
    }
    CHECK_SAY(escaped >= 500, "%d escapes", escaped);
}

/* ---- G7: recursion --------------------------------------------------------------------------- */

enum { depths = 24 };

/* At each depth another call, of one index; outputs are those of the depth. */
typedef struct descent {
    int door, width, depth, all_doors;
    uint32_t form;
    uint32_t out[depths + 1][surface_outputs][surface_most_crossings];
    uintptr_t caller[depths + 1]; /* an address in the frame that called */
    uintptr_t frame[depths + 1];  /* and in the visit of a callback */
} descent;

static int door_at(const descent *self, int depth) {
    return self->all_doors ? (self->door + depth) % surface_doors : self->door;
}

static void descend(descent *self);

static void visit_below(void *visitor) {
    descent *const self = visitor;
    volatile char here = 0;
    if (self->frame[self->depth] != 0) return;
    self->frame[self->depth] = (uintptr_t)&here;
    if (self->depth < depths) descend(self);
}

/* In a small frame of its own: the compiler does not see through the pointer. */
static spt_status place_below(descent *self, const surface_call *below) {
    volatile char here = 0;
    self->caller[self->depth] = (uintptr_t)&here;
    const spt_status status = surface_place(below);
    return here == 0 ? status : SPT_BAD_ARGUMENT;
}

static spt_status (*volatile place_from_here)(descent *, const surface_call *) = place_below;

static void descend(descent *self) {
    const int depth = ++self->depth, door = door_at(self, depth);
    surface_call below;
    surface_call_make(&below, &world, (surface_door)door, stress_widths[self->width], self->form);
    below.count = 1;
    for (int column = 0; column < surface_outputs; ++column) {
        memcpy(self->out[depth][column], world.out[column], surface_width(column));
        below.out[column].first = self->out[depth][column];
    }
    CHECK(place_from_here(self, &below) == SPT_OK);
    --self->depth;
}

/* surface.h: a level takes at most 64 KiB besides the callback's own, which here is the frames of
 * the audit and the visit, and those that put the call together: few hundred bytes, and no
 * exception is made for them. */
static void check_frames(const descent *self) {
    for (int depth = 1; depth <= depths; ++depth) {
        const uintptr_t above = self->caller[depth], below = self->frame[depth];
        const size_t level = (size_t)(above > below ? above - below : below - above);
        CHECK(below != 0);
#ifndef FRAMES_ARE_WIDENED
        CHECK_SAY(level > 0 && level <= 64 * 1024, "%u bytes in %s", (unsigned)level,
                  surface_table[door_at(self, depth)].name);
#else
        (void)level;
#endif
    }
}

static void check_descent(descent *self) {
    for (int depth = 1; depth <= depths; ++depth) {
        const int door = door_at(self, depth);
        size_t differing = 0;
        prepare(door, self->width, self->form);
        call.count = 1;
        CHECK(surface_place(&call) == SPT_OK);
        for (int column = 0; column < surface_outputs; ++column) {
            differing +=
                memcmp(self->out[depth][column], world.out[column], surface_width(column)) != 0;
        }
        CHECK_SAY(differing == 0, "%u results differ at depth %d", (unsigned)differing, depth);
    }
    check_frames(self);
}

static void G7sb_surface_recursion(void) {
    static descent self;
    FOR_EACH_WAY(door, width, form) {
        for (int all = 0; all < 2; ++all) {
            memset(&self, 0, sizeof self);
            self.door = door;
            self.width = width;
            self.form = form;
            self.all_doors = all;
            check_context("%s, %u lanes, form %u", surface_table[door].name,
                          (unsigned)stress_widths[width], (unsigned)form);
            surface_visit(&world, visit_below, &self);
            descend(&self);
            surface_visit(&world, NULL, NULL);
            check_descent(&self);
        }
    }
}

/* ---- G10: the upper halves of the vector registers ------------------------------------------- */

static int dirty;

static void look_at_registers(void *unused) {
    (void)unused;
    dirty += upper_halves_used();
}

static void G10sa_surface_upper_halves_are_clean(void) {
    if (!upper_halves_are_visible()) {
        check_skip("G10sa: the state of the upper halves cannot be read here");
        return;
    }
    FOR_EACH_WAY(door, width, form) {
        prepare(door, width, form);
        surface_visit(&world, look_at_registers, NULL);
        dirty = 0;
        const spt_status status = surface_place(&call);
        const int after = upper_halves_used();
        upper_halves_clean();
        surface_visit(&world, NULL, NULL);
        CHECK(status == SPT_OK && surface_calls_seen(&world) > 0);
        CHECK_SAY(dirty == 0, "%d callbacks found them used", dirty);
        CHECK(!after);
    }
}

/* ---- G11: threads ---------------------------------------------------------------------------- */

#ifdef HAVE_THREADS
enum { threads = 2 };

typedef struct worker {
    surface_world world;
    surface_call calls[surface_doors];
    uint32_t out[surface_doors][surface_outputs][surface_most * surface_most_crossings];
    size_t faults;
} worker;

/* check.h has one state for all threads: nothing is checked here. */
static void *work(void *user) {
    worker *const self = user;
    surface_world_make(&self->world);
    for (int door = 0; door < surface_doors; ++door) {
        surface_call_make(&self->calls[door], &self->world, (surface_door)door, 0, 0);
        self->faults += surface_place(&self->calls[door]) != SPT_OK;
        self->faults += surface_faults_seen(&self->world);
        memcpy(self->out[door], self->world.out, sizeof self->out[door]);
    }
    return NULL;
}
#endif

static void G11sa_surface_calls_at_once(void) {
#ifdef HAVE_THREADS
    static worker workers[threads], alone;
    pthread_t thread[threads];
    for (int i = 0; i < threads; ++i) {
        CHECK(pthread_create(&thread[i], NULL, work, &workers[i]) == 0);
    }
    for (int i = 0; i < threads; ++i) CHECK(pthread_join(thread[i], NULL) == 0);
    work(&alone);
    for (int i = 0; i < threads; ++i) {
        CHECK(workers[i].faults == 0);
        CHECK(memcmp(workers[i].out, alone.out, sizeof alone.out) == 0);
    }
#else
    check_skip("G11sa: no threads here");
#endif
}

void suite_surface_host(void) {
    RUN(G11sa_surface_calls_at_once);
    RUN(G1sa_surface_control_bits_untouched);
    RUN(G1sb_surface_denormals_flushed);
    RUN(G3sa_surface_exceptions_unmasked);
    RUN(G5sb_surface_longjmp_out_of_a_callback);
    RUN(G7sb_surface_recursion);
    RUN(G10sa_surface_upper_halves_are_clean);
}
