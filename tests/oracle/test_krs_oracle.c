/* SPDX-License-Identifier: MIT
 *
 * Whether the oracle of kernel-reflection sequences can be believed: its kernels against points
 * sampled along what they are swept from, its copies against points carried the other way, its
 * expansion against Algorithm 1 in double. Nothing of the library is asked. */
#include "krs_draw.h"
#include "krs_fold.h"
#include "../check.h"

#include <math.h>

/* Of one kind, drawn as the models draw them. */
static krs_body draw_body(krs_drawn *sample, uint32_t kinds) {
    const spt_kernel kernel = krs_draw_kernel(sample, 0, kinds);
    return krs_body_of(&kernel);
}

static double distance_between(const double a[3], const double b[3]) {
    const double way[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    return surface_length(way);
}

static void random_place(double reach, double p[3]) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = check_uniform(-reach, reach);
}

enum { arc_samples = 800 };

/* The arc is walked by the same angle everywhere, from a by way of control to b; a point of it is
 * within half a step of a sample, so the samples are farther than the truth by at most that. */
static void krs_oracle_arcs(void) {
    static krs_drawn sample;
    for (int draw = 0; draw < 30; ++draw) {
        const krs_body body = draw_body(&sample, KRS_CAPSULES);
        static double arc[arc_samples + 1][3];
        double passes = HUGE_VAL;
        const double step = body.circle_radius * body.angle / arc_samples;
        for (int i = 0; i <= arc_samples; ++i) {
            const double angle = body.angle * i / arc_samples;
            for (int axis = 0; axis < 3; ++axis)
                arc[i][axis] =
                    body.center[axis] + body.circle_radius * (cos(angle) * body.axis[0][axis] +
                                                              sin(angle) * body.axis[1][axis]);
            passes = fmin(passes, distance_between(arc[i], body.control));
        }
        CHECK(distance_between(arc[0], body.a) < 1e-12);
        CHECK(distance_between(arc[arc_samples], body.b) < 1e-12);
        CHECK(passes <= step / 2 + 1e-12);
        for (int query = 0; query < 20; ++query) {
            double p[3], least = HUGE_VAL;
            int nearest = 0;
            random_place(2, p);
            for (int i = 0; i <= arc_samples; ++i) {
                const double distance = distance_between(arc[i], p);
                if (distance < least) nearest = i;
                least = fmin(least, distance);
            }
            const double found = krs_body_distance(&body, p) + body.radius;
            CHECK_SAY(found <= least + 1e-12 && found >= least - step / 2, "%g, samples %g", found,
                      least);
            const double part = krs_arc_fraction(&body, p) * arc_samples;
            CHECK_SAY(fabs(part - nearest) <= 1 || fabs(found - least) < step * step,
                      "%g, samples %d", part, nearest);
        }
    }
}

/* Points of the plane that are on the inner side of both circles through the tips; a circle is
 * found from three points on it by the arcs above. */
static void krs_oracle_leaves(void) {
    static krs_drawn sample;
    enum { across = 60 };
    for (int draw = 0; draw < 30; ++draw) {
        const krs_body body = draw_body(&sample, KRS_LEAVES);
        double p[3], least = HUGE_VAL;
        for (int query = 0; query < 10; ++query) {
            random_place(2, p);
            least = HUGE_VAL;
            for (int i = -across; i <= across; ++i) {
                const double x = body.half * i / across;
                /* The height of an arc over its chord: sqrt(r^2 - x^2) - (r - width). */
                const double height =
                    sqrt(fmax(0, body.circle_radius * body.circle_radius - x * x)) -
                    (body.circle_radius - body.width);
                for (int j = -across; j <= across; ++j) {
                    double q[3];
                    for (int axis = 0; axis < 3; ++axis)
                        q[axis] = body.center[axis] + x * body.axis[0][axis] +
                                  height * j / across * body.axis[1][axis];
                    least = fmin(least, distance_between(p, q));
                }
            }
            /* A point of the leaf is within a column's width of the next column towards the
             * middle, which is no lower, and there within half a row of a sample. */
            const double step = 2 * body.half / across,
                         found = krs_body_distance(&body, p) + body.radius;
            CHECK_SAY(found <= least + 1e-12 && found >= least - step, "%g, samples %g", found,
                      least);
        }
    }
}

/* An image's distance from p is that of the kernel from p carried back. */
static void krs_oracle_images(void) {
    static krs_drawn sample;
    static const uint32_t kinds[] = {KRS_SPHERES, KRS_HALF_SPACES, KRS_CAPSULES, KRS_LEAVES,
                                     KRS_FIELDS};
    for (size_t kind = 0; kind < sizeof kinds / sizeof kinds[0]; ++kind) {
        spt_kernel kernels[5];
        spt_mirror mirrors[4];
        for (uint32_t i = 0; i < 5; ++i) kernels[i] = krs_draw_kernel(&sample, i, kinds[kind]);
        for (int i = 0; i < 4; ++i) mirrors[i] = krs_draw_mirror(check_uniform(-2, 2));
        krs_expand(&sample.truth, 4, kernels, mirrors);
        CHECK(sample.truth.count == 31);
        for (size_t i = 0; i < sample.truth.count; ++i) {
            const krs_instance *const one = &sample.truth.instances[i];
            const krs_body body = krs_body_of(&kernels[one->kernel]);
            double p[3], seen[3];
            CHECK((one->mirrors & ((UINT64_C(1) << one->kernel) - 1)) == 0);
            for (size_t j = 0; j < i; ++j) /* all are different */
                CHECK(one->kernel != sample.truth.instances[j].kernel ||
                      one->mirrors != sample.truth.instances[j].mirrors);
            for (int query = 0; query < 5; ++query) {
                random_place(5, p);
                krs_to_kernel(&sample.truth, one->kernel, one->mirrors, p, seen);
                const double there = krs_body_distance(&body, seen),
                             here = krs_instance_distance(&sample.truth, i, p);
                CHECK_SAY(fabs(there - here) < 1e-12, "%g %g", there, here);
            }
        }
    }
}

/* On separated models both are the same; on others the fold is nowhere below the union. */
static void krs_oracle_folds(void) {
    static krs_drawn sample;
    static krs_folded folded;
    int cut = 0;
    for (uint32_t levels = 0; levels <= 7; ++levels) {
        for (int straddling = 0; straddling < 2; ++straddling) {
            krs_draw(&sample, levels, KRS_ALL, straddling ? 0.8 : 0);
            double worst = 0;
            for (int query = 0; query < 60; ++query) {
                double p[3];
                size_t which = 0;
                random_place(1.2 * sample.reach, p);
                krs_fold(levels, sample.kernels, sample.mirrors, p, &folded);
                const double all = krs_expansion_distance(&sample.truth, p, &which, NULL);
                worst = fmax(worst, folded.distance - all);
                CHECK_SAY(!(folded.distance < all - 1e-9), "%g, union %g", folded.distance, all);
                if (straddling || !(all < HUGE_VAL)) continue;
                CHECK_SAY(!(folded.distance > all + 1e-9), "%g, union %g", folded.distance, all);
                const krs_instance *const one = &sample.truth.instances[which];
                CHECK(one->kernel == folded.kernel && one->mirrors == folded.mirrors);
            }
            cut += worst > 0.01;
        }
    }
    CHECK_SAY(cut >= 1, "%d of 7 models are cut", cut);
}

void suite_krs_oracle(void) {
    RUN(krs_oracle_arcs);
    RUN(krs_oracle_leaves);
    RUN(krs_oracle_images);
    RUN(krs_oracle_folds);
}
