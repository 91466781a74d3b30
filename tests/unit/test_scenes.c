/* SPDX-License-Identifier: MIT
 *
 * The shared scenes keep what they promise: the same bits from every callback, the double-precision
 * reference within rounding, their Lipschitz constants, convexity and bounds. Left out: known
 * answers and cameras, see test_scenes_known.c, and tracing them. */
#include "../check.h"

#include "scenes/scene_deformed.h"
#include "scenes/scenes.h"
#include "test_scenes.h"

#include <math.h>
#include <string.h>

static const double unit_roundoff = 5.9604644775390625e-8; /* 2^-24 */

static void scenes_same_bits_at_every_width(void) {
    static points set;
    float one_by_one[SPT_BATCH];
    for (size_t s = 0; s < scene_count; ++s) {
        const scene *const shown = scenes[s];
        const spt_field single = scene_field(shown, 0);
        fill(shown, &set);
        evaluate(&single, &set, 0, SPT_BATCH);
        memcpy(one_by_one, column(&set, 3), sizeof one_by_one);
        for (int lanes = spt_lanes(); lanes > 0; lanes = narrower(lanes)) {
            const spt_field field = scene_field(shown, lanes);
            check_context("%s, %d lanes", shown->name, lanes);
            evaluate(&field, &set, 0, SPT_BATCH);
            const int count = differing(one_by_one, column(&set, 3), SPT_BATCH);
            CHECK_SAY(count == 0, "%d of %d values differ from one point's", count, SPT_BATCH);
        }
    }
}

static void scenes_place_in_the_batch_does_not_matter(void) {
    static points set, turned;
    for (size_t s = 0; s < scene_count; ++s) {
        fill(scenes[s], &set);
        for (int i = 0; i < SPT_BATCH; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                column(&turned, axis)[SPT_BATCH - 1 - i] = column(&set, axis)[i];
            }
        }
        for (int lanes = spt_lanes(); lanes > 0; lanes = narrower(lanes)) {
            const spt_field field = scene_field(scenes[s], lanes);
            float whole[SPT_BATCH], back[SPT_BATCH];
            check_context("%s, %d lanes", scenes[s]->name, lanes);
            evaluate(&field, &set, 0, SPT_BATCH);
            memcpy(whole, column(&set, 3), sizeof whole);
            evaluate(&field, &turned, 0, SPT_BATCH);
            for (int i = 0; i < SPT_BATCH; ++i) back[i] = column(&turned, 3)[SPT_BATCH - 1 - i];
            CHECK(differing(whole, back, SPT_BATCH) == 0);
            for (size_t n = 16; n <= 112; n += 48) {
                for (size_t first = 0; first + n <= SPT_BATCH; first += n) {
                    evaluate(&field, &set, first, n);
                    CHECK(differing(whole + first, column(&set, 3) + first, n) == 0);
                }
            }
        }
    }
}

/* Mirrors that a point is folded at on its way to the last kernel. */
static int folds_of(const scene *shown) {
    return strcmp(shown->name, "krs_tree_16") == 0 ? 16 : 0;
}

/* What float can resolve, the law behind the tolerance's floor: 2.5 roundings of the point and the
 * scene together (the eye's coordinates stand for its size), one or two for the coordinate that is
 * moved or turned and one for the root and what follows; times lipschitz, which is how much a moved
 * point moves the distance. A fold rounds the point anew: with n of them it is what krs.h promises,
 * 4 (n + 4). Not for the fractal, see test_scenes_known.c. */
static void scenes_reference_within_rounding(void) {
    for (size_t s = 0; s < scene_count; ++s) {
        const scene *const shown = scenes[s];
        const spt_field single = scene_field(shown, 0);
        const int folds = folds_of(shown);
        const double roundings = folds > 0 ? 4 * (folds + 4) : 2.5 * (double)shown->lipschitz;
        double size = 0;
        if (strcmp(shown->name, "mandelbulb") == 0) continue;
        check_context("%s", shown->name);
        for (int axis = 0; axis < 3; ++axis) size += fabs(shown->eye[axis]);
        for (int i = 0; i < 10000; ++i) {
            double p[3];
            draw_in_region(shown, p);
            const double seen =
                (double)single.point(single.user, (float)p[0], (float)p[1], (float)p[2]);
            const double error = fabs(seen - reference_at(shown, p));
            const double sum = fabs(p[0]) + fabs(p[1]) + fabs(p[2]) + size;
            CHECK_SAY(error <= roundings * unit_roundoff * sum, "error %g at %g %g %g", error, p[0],
                      p[1], p[2]);
        }
    }
}

/* From p against the gradient, so that the slope between the two is the steepest there is at p. */
static void step_downhill(const scene *shown, const double p[3], double length, double q[3]) {
    const double flat[3] = {0, 0, 0};
    double gradient[3];
    for (int axis = 0; axis < 3; ++axis) {
        double ahead[3], behind[3];
        memcpy(ahead, p, sizeof ahead);
        memcpy(behind, p, sizeof behind);
        ahead[axis] += 1e-6;
        behind[axis] -= 1e-6;
        gradient[axis] = reference_at(shown, ahead) - reference_at(shown, behind);
    }
    const double steep = fmax(apart(gradient, flat), 1e-12);
    for (int axis = 0; axis < 3; ++axis) q[axis] = p[axis] - length * gradient[axis] / steep;
}

/* Between pairs of points from 1e-4 apart to across the region, every second one down the gradient.
 * Constants such as unit vectors are rounded to float, which allows 8 roundings of slope, and 4 for
 * every fold: rounded components make |n|^2 wrong by 2 at most, and a fold stretches by twice that.
 * That some pair comes near the constant shows that the pairs can fail. */
static void scenes_lipschitz_promise(void) {
    for (size_t s = 0; s < scene_count; ++s) {
        const scene *const shown = scenes[s];
        const double lipschitz = (double)shown->lipschitz, roundings = 8 + 4 * folds_of(shown);
        double steepest = 0;
        if (strcmp(shown->name, "mandelbulb") == 0) continue; /* an estimate */
        check_context("%s", shown->name);
        for (int i = 0; i < 20000; ++i) {
            double p[3], q[3];
            const double share = pow(10, check_uniform(-4, 0));
            draw_in_region(shown, p);
            draw_in_region(shown, q);
            for (int axis = 0; axis < 3; ++axis) q[axis] = p[axis] + share * (q[axis] - p[axis]);
            if (i % 2 == 1) step_downhill(shown, p, 1e-4, q);
            const double slope =
                fabs(reference_at(shown, p) - reference_at(shown, q)) / apart(p, q);
            CHECK_SAY(slope <= lipschitz * (1 + roundings * unit_roundoff),
                      "slope %.9g at %g %g %g", slope, p[0], p[1], p[2]);
            steepest = fmax(steepest, slope);
        }
        CHECK_SAY(steepest > 0.5 * lipschitz, "steepest %g", steepest);
    }
}

static void scenes_convex_where_they_say_so(void) {
    int convex = 0;
    for (size_t s = 0; s < scene_count; ++s) {
        const scene *const shown = scenes[s];
        if ((shown->flags & SPT_FIELD_CONVEX) == 0) continue;
        ++convex;
        check_context("%s", shown->name);
        for (int i = 0; i < 4000; ++i) {
            double p[3], q[3], middle[3];
            draw_in_region(shown, p);
            draw_in_region(shown, q);
            for (int axis = 0; axis < 3; ++axis) middle[axis] = 0.5 * (p[axis] + q[axis]);
            /* 1e-9: what keeps the generalised distance from denormals bends it by 1e-10 */
            CHECK(reference_at(shown, middle) <=
                  0.5 * (reference_at(shown, p) + reference_at(shown, q)) + 1e-9);
        }
    }
    CHECK(convex >= 5);
}

/* Nothing of a surface lies outside its bound: points in and around the region, half of them drawn
 * close to where it ends. */
static void scenes_bound_contains_the_surface(void) {
    for (size_t s = 0; s < scene_count; ++s) {
        const scene *const shown = scenes[s];
        double low[3], high[3];
        int outside = 0;
        if (shown->bound == NULL) continue;
        check_context("%s", shown->name);
        region_of(shown, low, high);
        for (int i = 0; i < 8000; ++i) {
            const double growth = i % 2 == 0 ? 1.02 : 1.8;
            double p[3];
            draw_in_region(shown, p);
            for (int axis = 0; axis < 3; ++axis) {
                const double middle = 0.5 * (low[axis] + high[axis]);
                p[axis] = middle + growth * (p[axis] - middle);
            }
            if (inside_bound(shown->bound, p)) continue;
            ++outside;
            CHECK_SAY(reference_at(shown, p) > 0, "inside at %g %g %g", p[0], p[1], p[2]);
        }
        CHECK(outside > 1000);
    }
}

static void scenes_deformed_constants(void) {
    CHECK(fabsf(scene_named("twisted")->lipschitz -
                spt_twist_lipschitz((float)TWISTED_RATE, (float)TWISTED_REACH)) < 1e-4f);
    CHECK(fabsf(scene_named("bent")->lipschitz -
                spt_bend_lipschitz((float)BENT_RATE, (float)BENT_REACH)) < 1e-4f);
    const spt_bound *const bound = scene_named("bent")->bound;
    CHECK(sqrtf(bound->high[0] * bound->high[0] + bound->low[1] * bound->low[1]) <=
          (float)BENT_REACH);
}

void suite_scenes(void) {
    RUN(scenes_same_bits_at_every_width);
    RUN(scenes_place_in_the_batch_does_not_matter);
    RUN(scenes_reference_within_rounding);
    RUN(scenes_lipschitz_promise);
    RUN(scenes_convex_where_they_say_so);
    RUN(scenes_bound_contains_the_surface);
    RUN(scenes_deformed_constants);
}
