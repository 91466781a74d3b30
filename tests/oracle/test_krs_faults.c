/* SPDX-License-Identifier: MIT
 *
 * What a built model says of itself: spt_krs.straddles and bound, and spt_krs_check(), against the
 * model's instances and against caps of known area. */
#include "krs_draw.h"
#include "../check.h"

#include <math.h>
#include <string.h>

static krs_drawn sample;
static krs_expansion below; /* L_i of a model */
static spt_krs krs;
static spt_krs_faults faults;

static void check_model(uint32_t samples, uint32_t seed) {
    memset(&faults, 0x5a, sizeof faults);
    CHECK(spt_krs_check(&krs, samples, seed, &faults) == SPT_OK);
}

/* normal . x - offset of mirror i is nowhere in L_i larger. */
static double reach_beyond(uint32_t i) {
    double most = -HUGE_VAL;
    for (size_t k = 0; k < below.count; ++k) {
        double center[3], radius;
        const krs_instance *const one = &below.instances[k];
        if (!krs_body_ball(&one->body, center, &radius)) continue;
        for (uint32_t j = one->kernel; j < i && one->body.kind == SPT_KERNEL_FIELD; ++j) {
            if ((one->mirrors >> j & 1) != 0) krs_reflect(&sample.truth, j, center);
        }
        most = fmax(most,
                    surface_dot(sample.truth.normal[i], center) + radius - sample.truth.offset[i]);
    }
    return most;
}

/* ---- Separated models ------------------------------------------------------------------------ */

static void krs_check_finds_nothing(void) {
    for (uint32_t levels = 0; levels <= krs_most_levels; ++levels) {
        check_context("%u levels", levels);
        krs_draw(&sample, levels, KRS_SOLID, 0);
        krs_build(&sample, 0, &krs);
        check_model(300, levels);
        for (uint32_t i = 0; i < SPT_KRS_LEVELS; ++i) {
            /* points of fields that do not come to their surface are none */
            CHECK_SAY(i < levels ? faults.samples[i] > 250 && faults.samples[i] <= 300
                                 : faults.samples[i] == 0,
                      "level %u: %u", i, faults.samples[i]);
            CHECK_SAY(faults.discarded[i] == 0, "level %u: %u of %u, by %g", i, faults.discarded[i],
                      faults.samples[i], (double)faults.depth[i]);
            CHECK(!(faults.depth[i] > 0) && !(faults.depth[i] < 0));
        }
    }
}

/* A ball that is clear of its mirror is no straddle. */
static void krs_straddles_of_a_ball(void) {
    for (int draw = 0; draw < 200; ++draw) {
        const double gap = pow(10, check_uniform(-3, 0)) * (draw % 2 != 0 ? 1 : -1);
        double normal[3], center[3];
        krs_draw(&sample, 1, KRS_SPHERES, 0);
        krs_widen(sample.mirrors[0].normal, normal);
        krs_widen(sample.kernels[0].a, center);
        sample.mirrors[0].offset =
            (float)(surface_dot(normal, center) + (double)sample.kernels[0].radius + gap);
        krs_build(&sample, 0, &krs);
        CHECK_SAY(krs.straddles == (gap < 0), "gap %g: %llx", gap,
                  (unsigned long long)krs.straddles);
    }
}

/* ---- Caps of known area ---------------------------------------------------------------------- */

/* Within five standard deviations of a binomial. */
static void check_share(uint32_t level, double share) {
    const double samples = faults.samples[level], off = faults.discarded[level] - share * samples;
    CHECK_SAY(fabs(off) <= 5 * sqrt(samples * share * (1 - share)) + 1, "%u of %u for %g",
              faults.discarded[level], faults.samples[level], share);
}

/* A cap of height h has the share h / 2r of a sphere (Archimedes). With a second mirror that cuts
 * the image alone, half of that. */
static void krs_check_counts_caps(void) {
    static const double heights[] = {0.02, 0.1, 0.5, 1, 1.5, 1.9};
    enum { samples = 4000 };
    for (int i = 0; i < 6; ++i) {
        for (int second = 0; second < 2; ++second) {
            const double radius = pow(2, check_uniform(-3, 3)), height = heights[i] * radius;
            double normal[3], center[3], worst[3];
            check_context("height %g of radius %g, mirror %d", height, radius, second);
            sample.levels = 1 + (uint32_t)second;
            sample.kernels[0] = spt_kernel_sphere(1, -2, 3, (float)radius);
            sample.kernels[1] = sample.kernels[2] = spt_kernel_empty();
            sample.mirrors[0] = krs_draw_mirror(0);
            krs_widen(sample.mirrors[0].normal, normal);
            krs_widen(sample.kernels[0].a, center);
            const double along = surface_dot(normal, center);
            sample.mirrors[0].offset = (float)(along + (second ? 1.5 * radius : radius - height));
            /* the second the same way: before the image's far end, which is 4 radii off */
            sample.mirrors[1] = sample.mirrors[0];
            sample.mirrors[1].offset = (float)(along + 4 * radius - height);
            krs_expand(&sample.truth, sample.levels, sample.kernels, sample.mirrors);
            krs_build(&sample, 0, &krs);
            CHECK(krs.straddles == (second ? 2u : 1u));
            check_model(samples, (uint32_t)i);
            CHECK(faults.samples[second] == samples);
            check_share((uint32_t)second, heights[i] / (second ? 4 : 2));
            if (second) CHECK(faults.discarded[0] == 0);
            /* heights on a cap are even, and 20 points or more are in each: that none is in the
             * deeper half has odds of 1e-6 */
            const double deepest = height, depth = (double)faults.depth[second];
            CHECK_SAY(depth <= deepest + 1e-5 * (10 + radius) && depth >= 0.5 * deepest, "depth %g",
                      depth);
            krs_widen(faults.worst[second], worst);
            CHECK(fabs(surface_dot(normal, worst) - (double)sample.mirrors[second].offset - depth) <
                  1e-5 * (10 + radius));
        }
    }
}

/* ---- Models that their mirrors cut ----------------------------------------------------------- */

/* Mirrors that no body of an L_i goes through are not blamed, those that much of it goes through
 * are; `worst` is on a body of L_i, and as deep as told. */
static void krs_check_finds_cuts(void) {
    int cut_levels = 0;
    for (uint32_t levels = 1; levels <= krs_most_levels; ++levels) {
        check_context("%u levels", levels);
        krs_draw(&sample, levels, KRS_SOLID, 0.8);
        krs_build(&sample, 0, &krs);
        check_model(1000, 7);
        for (uint32_t i = 0; i < levels; ++i) {
            krs_expand(&below, i, sample.kernels, sample.mirrors);
            const double most = reach_beyond(i), depth = (double)faults.depth[i];
            double worst[3], nearest = HUGE_VAL;
            /* what a lower mirror cuts off is no part of L_i */
            CHECK(faults.samples[i] > 0 && faults.samples[i] <= 1000);
            CHECK((faults.discarded[i] > 0) == (depth > 0));
            CHECK_SAY(depth <= fmax(most, 0) + 1e-4, "%g deep of %g", depth, most);
            if (faults.discarded[i] == 0) continue;
            ++cut_levels;
            CHECK((krs.straddles >> i & 1) != 0);
            krs_widen(faults.worst[i], worst);
            CHECK(fabs(surface_dot(sample.truth.normal[i], worst) - sample.truth.offset[i] -
                       depth) < 1e-4);
            for (size_t k = 0; k < below.count; ++k)
                nearest = fmin(nearest, fabs(krs_instance_distance(&below, k, worst)));
            CHECK_SAY(nearest < 1e-4, "%g from all surfaces", nearest);
        }
    }
    CHECK_SAY(cut_levels > 30, "%d", cut_levels);
}

/* Whatever is beyond its mirror by the instances' own surfaces has its bit set. */
static void krs_straddles_hides_nothing(void) {
    int beyond = 0;
    for (int draw = 0; draw < 60; ++draw) {
        const uint32_t levels = 1 + (uint32_t)draw % 8;
        krs_draw(&sample, levels, KRS_SOLID | KRS_EMPTY, draw % 2 != 0 ? 0.1 : 0.6);
        krs_build(&sample, 0, &krs);
        for (uint32_t i = 0; i < levels; ++i) {
            krs_expand(&below, i, sample.kernels, sample.mirrors);
            for (size_t probe = 0; probe < 60; ++probe) {
                const size_t k = probe % (below.count != 0 ? below.count : 1);
                double p[3];
                if (below.count == 0) break;
                krs_body_sample(&below.instances[k].body, p);
                for (uint32_t j = below.instances[k].kernel;
                     j < i && below.instances[k].body.kind == SPT_KERNEL_FIELD; ++j) {
                    if ((below.instances[k].mirrors >> j & 1) != 0)
                        krs_reflect(&sample.truth, j, p);
                }
                const double off = surface_dot(sample.truth.normal[i], p) - sample.truth.offset[i];
                if (off < 1e-5) continue;
                ++beyond;
                CHECK_SAY((krs.straddles >> i & 1) != 0, "level %u of %u: %g beyond", i, levels,
                          off);
            }
        }
        for (uint32_t i = levels; i < 64; ++i) CHECK((krs.straddles >> i & 1) == 0);
    }
    CHECK_SAY(beyond > 200, "%d", beyond);
    /* A half space across a mirror, and a field without a bound, reach beyond any. */
    krs_draw(&sample, 1, KRS_SPHERES, 0);
    sample.kernels[0] = spt_kernel_half_space(1, 0, 0, -10);
    sample.mirrors[0] = (spt_mirror){{0, 1, 0}, 100};
    krs_build(&sample, 0, &krs);
    CHECK(krs.straddles == 1);
    sample.kernels[0] = krs_draw_kernel(&sample, 0, KRS_FIELDS);
    krs_build(&sample, 0, &krs);
    CHECK(krs.straddles == 0); /* within 1 of the origin */
    sample.fields[0].bound = NULL;
    krs_build(&sample, 0, &krs);
    CHECK(krs.straddles == 1);
}

/* ---- The bound ------------------------------------------------------------------------------- */

static int within(const spt_bound *bound, const double p[3]) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double off = p[axis] - (double)bound->center[axis];
        square += off * off;
    }
    return bound->kind == SPT_BOUND_SPHERE && /* what the header says that it finds */
           sqrt(square) <= (double)bound->radius + 1e-7;
}

static void krs_bound_contains_all(void) {
    for (int draw = 0; draw < 44; ++draw) {
        const uint32_t levels = (uint32_t)draw % (krs_most_levels + 1);
        check_context("%u levels", levels);
        krs_draw(&sample, levels, KRS_SOLID, draw % 2 != 0 ? 0.6 : 0);
        krs_build(&sample, 0, &krs);
        const spt_field field = spt_krs_field(&krs);
        CHECK(krs.bounded && field.bound != NULL && field.bound->kind == krs.bound.kind);
        for (int i = 0; i < 200; ++i) {
            double p[3];
            const size_t index = krs_draw_on_surface(&sample, p);
            if (!krs_instance_kept(&sample.truth, index, p, 0)) continue;
            CHECK_SAY(within(&krs.bound, p), "(%g, %g, %g)", p[0], p[1], p[2]);
        }
    }
}

static void krs_bound_where_there_is_none(void) {
    krs_draw(&sample, 3, KRS_SPHERES, 0);
    const spt_bound own = spt_bound_box(-9, -8, -7, 7, 8, 9);
    spt_krs_model model = krs_model_of(&sample);
    model.bound = &own;
    CHECK(spt_krs_build(&model, &krs) == SPT_OK);
    CHECK(krs.bounded && krs.bound.kind == SPT_BOUND_BOX);
    CHECK(memcmp(krs.bound.low, own.low, sizeof own.low) == 0 &&
          memcmp(krs.bound.high, own.high, sizeof own.high) == 0);
    sample.kernels[3] = spt_kernel_half_space(0, 1, 0, -20);
    CHECK(spt_krs_build(&model, &krs) == SPT_OK); /* the caller knows better */
    CHECK(krs.bounded && krs.bound.kind == SPT_BOUND_BOX);
    model.bound = NULL;
    CHECK(spt_krs_build(&model, &krs) == SPT_OK && !krs.bounded);
    CHECK(spt_krs_field(&krs).bound == NULL);
    sample.kernels[3] = krs_draw_kernel(&sample, 3, KRS_FIELDS);
    CHECK(spt_krs_build(&model, &krs) == SPT_OK && krs.bounded);
    sample.fields[3].bound = NULL;
    CHECK(spt_krs_build(&model, &krs) == SPT_OK && !krs.bounded);
}

/* ---- The call -------------------------------------------------------------------------------- */

static void krs_check_is_repeatable(void) {
    static spt_krs_faults first, other;
    krs_draw(&sample, 5, KRS_SOLID, 0.8);
    krs_build(&sample, 0, &krs);
    check_model(200, 5);
    memcpy(&first, &faults, sizeof faults);
    check_model(200, 5);
    CHECK(memcmp(&first, &faults, sizeof faults) == 0);
    CHECK(spt_krs_check(&krs, 200, 6, &other) == SPT_OK);
    CHECK(memcmp(&first, &other, sizeof other) != 0);
    check_model(1, 1);
    CHECK(faults.samples[0] == 1);
}

static void krs_check_refuses(void) {
    static const uint32_t bad[] = {0, (1u << 20) + 1, UINT32_MAX};
    static spt_krs_faults before;
    krs_draw(&sample, 2, KRS_SPHERES, 0);
    krs_build(&sample, 0, &krs);
    memset(&faults, 0x5a, sizeof faults);
    memcpy(&before, &faults, sizeof faults);
    for (int i = 0; i < 3; ++i) CHECK(spt_krs_check(&krs, bad[i], 1, &faults) == SPT_BAD_ARGUMENT);
    CHECK(spt_krs_check(NULL, 10, 1, &faults) == SPT_BAD_ARGUMENT);
    CHECK(spt_krs_check(&krs, 10, 1, NULL) == SPT_BAD_ARGUMENT);
    for (int endless = 0; endless < 3; ++endless) {
        for (int i = 0; i < 3; ++i) sample.kernels[i] = spt_kernel_empty();
        if (endless == 1) sample.kernels[2] = spt_kernel_half_space(0, 1, 0, 0);
        if (endless == 2) {
            sample.kernels[0] = krs_draw_kernel(&sample, 0, KRS_FIELDS);
            sample.fields[0].bound = NULL;
        }
        krs_build(&sample, 0, &krs);
        CHECK_SAY(spt_krs_check(&krs, 10, 1, &faults) == SPT_UNSUPPORTED, "%d", endless);
    }
    CHECK(memcmp(&before, &faults, sizeof faults) == 0);
}

void suite_krs_faults(void) {
    RUN(krs_check_finds_nothing);
    RUN(krs_straddles_of_a_ball);
    RUN(krs_check_counts_caps);
    RUN(krs_check_finds_cuts);
    RUN(krs_straddles_hides_nothing);
    RUN(krs_bound_contains_all);
    RUN(krs_bound_where_there_is_none);
    RUN(krs_check_is_repeatable);
    RUN(krs_check_refuses);
}
