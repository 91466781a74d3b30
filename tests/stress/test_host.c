/* SPDX-License-Identifier: MIT
 *
 * Rows G1 to G11 but G4, G6 and G8: hosts with another floating-point environment, and callbacks
 * that leave by longjmp or call the tracer. Exceptions (G6) are in test_exceptions.cc, threads and
 * recursion in test_reentry.c. */
#include "stress.h"

#include <fenv.h>
#include <math.h>
#include <setjmp.h>
#include <stdio.h>
#include <string.h>

#if defined(__SSE2__)
#define HAVE_MXCSR
#include <immintrin.h>
#endif

/* ---- Scenes for all of them ---------------------------------------------------------------- */

enum { scene_count = 9 };

static float wavy_floor(const void *data, float x, float y, float z) {
    const float dx = x - floorf(x) - 0.5f, dz = z - floorf(z) - 0.5f; /* slopes of at most 0.5 */
    (void)data;
    return (y + 0.3f * dx * dx - 0.4f * dz * dz) * 0.8f;
}

/* Valid rays, and values that are finite wherever a ray can ask. All scales are at least 1e-18. */
static stress_case scene(int index, uint32_t *selection) {
    static const stress_sphere unit = {{0.0f, 0.0f, 0.0f}, 1.0f},
                               tiny = {{0.0f, 0.0f, 1e-17f}, 1e-18f};
    static const stress_sphere ahead = {{0.2f, -0.1f, 10.0f}, 1.0f};
    static const spt_bound box = {.struct_size = sizeof(spt_bound),
                                  .kind = SPT_BOUND_BOX,
                                  .low = {-2.0f, 0.0f, 8.0f},
                                  .high = {2.0f, 2.0f, 12.0f}};
    static const float zero = 0.0f;
    stress_case what = stress_case_of(stress_sphere_distance, &ahead);
    *selection = STRESS_CONVEX;
    switch (index) {
    case 0:
        return stress_base();
    case 1:
        break; /* off axis, sqrt and division inexact */
    case 2:    /* the ray lies in a face of the bound: 0 * infinity would be invalid */
        what.bound = &box;
        break;
    case 3:
        return stress_case_of(stress_constant_distance, &zero);
    case 4: /* straight away without end: slope -1, denominators near 0 */
        what = stress_case_of(stress_floor_distance, NULL);
        what.ray.origin[1] = 1.0f;
        what.ray.direction[1] = 1.0f;
        what.ray.direction[2] = 0.0f;
        what.ray.t_max = stress_infinity();
        break;
    case 5: /* along: slope 0 */
        what = stress_case_of(stress_floor_distance, NULL);
        what.ray.origin[1] = 0.1f;
        break;
    case 6:
        what = stress_case_of(stress_sphere_distance, &unit);
        break; /* from the inside */
    case 7:
        what = stress_case_of(stress_sphere_distance, &tiny);
        what.settings.epsilon = 1e-22f;
        what.ray.t_max = 1e-16f;
        break;
    default: /* budget runs out, brackets and fallbacks on the way */
        what = stress_case_of(wavy_floor, NULL);
        what.ray.origin[1] = 0.3f;
        what.ray.direction[1] = -0.02f;
        what.settings.pixel_radius = 1e-5f;
        *selection = 0;
        break;
    }
    return what;
}

/* ---- The floating-point environment is left alone ------------------------------------------- */

#ifdef HAVE_MXCSR
/* The results of every scene in the ways of a selection, in order; how many. */
static int all_results(stress_way *way, spt_hit results[scene_count]) {
    int count = 0;
    for (int i = 0; i < scene_count; ++i) {
        uint32_t selection;
        const stress_case what = scene(i, &selection);
        if (way->method == spt_convex() && selection == 0) continue;
        results[count++] = stress_run(way, &what, NULL);
    }
    return count;
}

enum { control_bits = 0xffc0, flush_bits = 0x8040, invalid_masked = 0x80, division_masked = 0x200 };
enum { invalid_seen = 0x01, division_seen = 0x04 };

typedef struct spy {
    unsigned control;
    int changed;
} spy;

static float spying_distance(const void *data, float x, float y, float z) {
    spy *self = (spy *)(uintptr_t)data;
    if ((_mm_getcsr() & control_bits) != self->control) self->changed = 1;
    return stress_sphere_distance(stress_base().data, x, y, z);
}

/* Whatever the host has set is what the callback sees and what is there afterwards. */
static void G1a_control_bits_untouched(void) {
    static const unsigned modes[] = {0, flush_bits, 0x2000, 0x4000, 0x6000 | flush_bits};
    const unsigned saved = _mm_getcsr();
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        for (int i = 0; i < 5; ++i) {
            spy self = {0, 0};
            const stress_case what = stress_case_of(spying_distance, &self);
            _mm_setcsr(saved | modes[i]);
            self.control = _mm_getcsr() & control_bits;
            const spt_settings settings = stress_settings(&way, &what);
            const spt_rays rays = spt_rays_of(&what.ray);
            spt_hit hit;
            const spt_hits hits = spt_hits_of(&hit);
            stress_probe probe;
            stress_probe_of(&probe, &what, 1);
            const spt_field field = stress_field(&way, &what, &probe);
            const spt_status status = spt_trace(&field, &settings, 1, &rays, &hits, NULL);
            const unsigned after = _mm_getcsr() & control_bits;
            _mm_setcsr(saved);
            CHECK(status == SPT_OK);
            CHECK(after == self.control);
            CHECK(!self.changed && probe.calls > 0);
        }
    }
}
#endif

static void G1_denormals_flushed(void) {
#ifdef HAVE_MXCSR
    const unsigned saved = _mm_getcsr();
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        spt_hit usual[scene_count], flushed[scene_count];
        const int count = all_results(&way, usual);
        _mm_setcsr(saved | flush_bits);
        const int again = all_results(&way, flushed);
        _mm_setcsr(saved);
        CHECK(count == again);
        for (int i = 0; i < count; ++i) {
            CHECK_SAY(stress_same_hit(&usual[i], &flushed[i]), "result %d: t %.9g, flushed %.9g", i,
                      (double)usual[i].t, (double)flushed[i].t);
        }
    }
#else
    check_skip("G1: no MXCSR here");
#endif
}

/* ---- G2: rounding modes -------------------------------------------------------------------- */

static void G2_rounding_modes(void) {
    static const int modes[] = {
#ifdef FE_DOWNWARD
        FE_DOWNWARD,
#endif
#ifdef FE_UPWARD
        FE_UPWARD,
#endif
#ifdef FE_TOWARDZERO
        FE_TOWARDZERO,
#endif
        FE_TONEAREST};
    static const int clear[] = {0, 1, 2, 6}; /* scenes with one clear hit */
    const int saved = fegetround();
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 4; ++i) {
            uint32_t selection;
            const stress_case what = scene(clear[i], &selection);
            const spt_hit nearest = stress_run(&way, &what, NULL);
            CHECK(nearest.outcome == SPT_HIT);
            for (size_t mode = 0; mode < sizeof modes / sizeof modes[0]; ++mode) {
                CHECK(fesetround(modes[mode]) == 0);
                const spt_hit hit = stress_run(&way, &what, NULL);
                const int after = fegetround();
                fesetround(saved);
                CHECK(after == modes[mode]);
                /* Either t lies within the tolerance of the one surface. */
                stress_expect(&hit, SPT_HIT, (double)nearest.t,
                              2.0 * stress_tolerance(&what, nearest.t));
            }
        }
    }
}

/* ---- G3: unmasked exceptions --------------------------------------------------------------- */

static void G3_invalid_and_division_unmasked(void) {
#ifdef HAVE_MXCSR
    const unsigned saved = _mm_getcsr();
    int raised = 0;
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        spt_hit results[scene_count];
        _mm_setcsr(saved & ~(unsigned)(invalid_seen | division_seen));
        all_results(&way, results);
        const unsigned seen = _mm_getcsr() & (invalid_seen | division_seen);
        _mm_setcsr(saved);
        CHECK_SAY(seen == 0, "exceptions %x raised", seen);
        raised |= seen != 0;
    }
    if (raised) return; /* unmasked, they would end the program */
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        spt_hit masked[scene_count], unmasked[scene_count];
        const int count = all_results(&way, masked);
        _mm_setcsr((saved & ~(unsigned)(invalid_masked | division_masked)) & control_bits);
        all_results(&way, unmasked);
        _mm_setcsr(saved);
        for (int i = 0; i < count; ++i) CHECK(stress_same_hit(&masked[i], &unmasked[i]));
    }
#else
    check_skip("G3: no MXCSR here");
#endif
}

/* ---- G4: a callback that does not keep bits ------------------------------------------------- */

/* What -ffast-math makes of a callback: results that depend on the place in the arrays. Nothing is
 * promised of equal bits; outcomes of clear hits are the same and every n is whole. */
static void place_dependent_batch(void *user, size_t n, const float *x, const float *y,
                                  const float *z, float *distance) {
    size_t *broken = user;
    *broken += n == 0 || n % 16 != 0 || n > SPT_BATCH;
    for (size_t i = 0; i < n; ++i) {
        const float exact = stress_sphere_distance(stress_base().data, x[i], y[i], z[i]);
        distance[i] = i % 3 == 0 ? nextafterf(exact, 100.0f) : exact;
    }
}

static void G4_callback_depends_on_place(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_BATCH | STRESS_OWN_RAYS);
         stress_next(&way);) {
        const stress_case what = stress_base();
        const spt_settings settings = stress_settings(&way, &what);
        spt_field field = spt_field_default();
        spt_ray ray[100];
        spt_hit hit[100];
        size_t broken = 0;
        for (int i = 0; i < 100; ++i) {
            ray[i] = what.ray;
            ray[i].origin[0] = 0.02f * (float)i; /* the first 50 hit, the others pass by */
        }
        field.batch = place_dependent_batch;
        field.user = &broken;
        field.flags = SPT_FIELD_CONVEX;
        const spt_rays rays = spt_rays_of(ray);
        const spt_hits hits = spt_hits_of(hit);
        CHECK(spt_trace(&field, &settings, 100, &rays, &hits, NULL) == SPT_OK);
        CHECK(broken == 0);
        for (int i = 0; i < 45; ++i) {
            const double x = (double)ray[i].origin[0];
            stress_expect(&hit[i], SPT_HIT, 10.0 - sqrt(1.0 - x * x), 1e-3);
        }
        for (int i = 55; i < 100; ++i) stress_expect(&hit[i], SPT_MISS, 0.0, 0.0);
    }
}

/* ---- G5: longjmp out of the callback ------------------------------------------------------- */

typedef struct escape {
    jmp_buf way_out;
    int left; /* calls before leaving */
} escape;

static float escaping_distance(const void *data, float x, float y, float z) {
    escape *self = (escape *)(uintptr_t)data;
    if (self->left-- == 0) longjmp(self->way_out, 1);
    return stress_sphere_distance(stress_base().data, x, y, z);
}

static int trace_and_escape(const stress_way *way, escape *self, int after) {
    const stress_case what = stress_case_of(escaping_distance, self);
    const spt_settings settings = stress_settings(way, &what);
    const spt_rays rays = spt_rays_of(&what.ray);
    spt_hit hit;
    const spt_hits hits = spt_hits_of(&hit);
    stress_probe probe;
    stress_probe_of(&probe, &what, 1);
    const spt_field field = stress_field(way, &what, &probe);
    self->left = after;
    if (setjmp(self->way_out) != 0) return 1;
    spt_trace(&field, &settings, 1, &rays, &hits, NULL);
    return 0;
}

static void G5_longjmp_out_of_the_callback(void) {
    static escape self;
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        const stress_case what = stress_base();
        const spt_hit before = stress_run(&way, &what, NULL);
        int escaped = 0;
#ifdef HAVE_MXCSR
        const unsigned control = _mm_getcsr() & control_bits;
#endif
        for (int i = 0; i < 1000; ++i) escaped += trace_and_escape(&way, &self, i % 2);
        CHECK(escaped == 1000);
#ifdef HAVE_MXCSR
        CHECK((_mm_getcsr() & control_bits) == control);
#endif
        const spt_hit after = stress_run(&way, &what, NULL);
        CHECK(stress_same_hit(&before, &after));
    }
}

/* ---- G9: which width ran ------------------------------------------------------------------- */

static uint32_t width_that_runs(uint32_t most) {
    const stress_case what = stress_base();
    spt_settings settings = what.settings;
    spt_statistics statistics = spt_statistics_default();
    spt_hit hit;
    const spt_hits hits = spt_hits_of(&hit);
    const spt_rays rays = spt_rays_of(&what.ray);
    stress_way way = stress_ways(0);
    stress_probe probe;
    settings.max_lanes = most;
    stress_probe_of(&probe, &what, 1);
    const spt_field field = stress_field(&way, &what, &probe);
    CHECK(spt_trace(&field, &settings, 1, &rays, &hits, &statistics) == SPT_OK);
    return statistics.lanes;
}

static void G9_width_that_ran(void) {
    const uint32_t widest = (uint32_t)spt_lanes();
    CHECK(widest == 1 || widest == 4 || widest == 8 || widest == 16);
    CHECK(width_that_runs(0) == widest);
    for (int i = 0; i < STRESS_WIDTHS; ++i) {
        const uint32_t asked = stress_widths[i];
        const uint32_t ran = width_that_runs(asked);
        CHECK_SAY(ran == (asked < widest ? asked : widest), "asked %u, ran %u, widest %u",
                  (unsigned)asked, (unsigned)ran, (unsigned)widest);
    }
#if defined(HAVE_MXCSR) && defined(__GNUC__)
    /* Never wider than processor and operating system together allow. */
    __builtin_cpu_init();
    CHECK(widest < 16 || __builtin_cpu_supports("avx512f"));
    CHECK(widest < 8 || __builtin_cpu_supports("avx2"));
#endif
}

void suite_host(void) {
#ifdef HAVE_MXCSR
    RUN(G1a_control_bits_untouched);
#endif
    RUN(G1_denormals_flushed);
    RUN(G2_rounding_modes);
    RUN(G3_invalid_and_division_unmasked);
    RUN(G4_callback_depends_on_place);
    RUN(G5_longjmp_out_of_the_callback);
    RUN(G9_width_that_ran);
}
