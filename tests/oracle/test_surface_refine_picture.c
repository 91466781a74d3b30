/* SPDX-License-Identifier: MIT
 *
 * Discontinuity reduction (spt_refine) of a picture: the jumps between pixels of the paper's Figure
 * 9, and every pixel beside the same iteration in double. */
#include "surface_refining.h"
#include "../check.h"

#include <spheretrace/surface.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { wide = 48, high = 36, figure_rounds = 5 };

typedef struct figure {
    reference_field field;
    spt_settings settings;
    spt_ray rays[wide * high];
    spt_hit traced[wide * high];
    double jumps[2 * wide * high];
} figure;

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The median of |f(p) - f(q)| over pixels beside each other that both hit. */
static double median_jump(figure *all, const float *residual) {
    size_t count = 0;
    for (int i = 0; i < wide * high; ++i) {
        const int beside[2] = {i % wide + 1 < wide ? i + 1 : i, i / wide + 1 < high ? i + wide : i};
        if (all->traced[i].outcome != SPT_HIT) continue;
        for (int side = 0; side < 2; ++side) {
            const int other = beside[side];
            if (other == i || all->traced[other].outcome != SPT_HIT) continue;
            all->jumps[count++] = fabs((double)residual[i] - (double)residual[other]);
        }
    }
    CHECK(count > wide * high / 2);
    if (count == 0) return 0;
    qsort(all->jumps, count, sizeof all->jumps[0], ascending);
    return all->jumps[count / 2];
}

static void make_figure(figure *all, const surface_body *ball) {
    const double half = tan(0.35);
    all->field = surface_body_field(ball);
    all->settings = spt_settings_default();
    all->settings.pixel_radius = (float)(half / wide);
    for (int i = 0; i < wide * high; ++i) {
        const double eye[3] = {0, 0, 0};
        const double target[3] = {half * (2 * (i % wide + 0.5) / wide - 1),
                                  half * (2 * (i / wide + 0.5) - high) / wide, 1};
        all->rays[i] = surface_aim(eye, target, 1, 50);
    }
}

/* The hits of the picture after some rounds, each beside the iteration in double. Rounding of t and
 * f adds up over the rounds, no more than kept by a factor 1 - cosine: where the ray meets the ball
 * steeply enough (cosine 0.2 and more) every round is kept by both. */
static void check_against_double(const figure *all, const surface_body *ball, const float *t) {
    for (int i = 0; i < wide * high; ++i) {
        refining_task what = {NULL, NULL, {{0, 0, 0}, 0, {0, 0, 0}, 0}, 0, 1};
        double p[3], gradient[3], d[3], expected;
        if (all->traced[i].outcome != SPT_HIT) continue;
        what.field = &all->field;
        what.settings = &all->settings;
        what.ray = all->rays[i];
        for (int axis = 0; axis < 3; ++axis) d[axis] = (double)what.ray.direction[axis];
        surface_point(&what.ray, (double)all->traced[i].t, p);
        surface_gradient(ball, p, gradient);
        if (surface_dot(gradient, d) > -0.2) continue;
        expected = refining_iterate(&what, (double)all->traced[i].t,
                                    (double)all->traced[i].residual, figure_rounds);
        CHECK_SAY(fabs((double)t[i] - expected) <=
                      figure_rounds * surface_rounding(&what.ray, expected),
                  "pixel %d: %.9g for %.9g", i, (double)t[i], expected);
    }
}

static void refine_figure_9(void) {
    static figure all;
    static spt_hit refined[wide * high];
    static float residual[wide * high], t[wide * high];
    surface_body ball = surface_sphere(0.1, 0.05, 4, 1.3);
    make_figure(&all, &ball);
    for (surface_run run = surface_runs(SURFACE_ALL_RULES | SURFACE_CONVEX); surface_next(&run);) {
        const spt_settings settings = surface_settings(&run, &all.settings);
        const spt_field field = surface_field(&run, &all.field, SPT_FIELD_CONVEX);
        const spt_rays rays = spt_rays_of(all.rays);
        const spt_hits hits = spt_hits_of(refined);
        double before, after;
        if (run.point) continue; /* the same values, see test_surface_parity.c */
        oracle_trace(&field, &settings, wide * high, all.rays, all.traced);
        memcpy(refined, all.traced, sizeof refined);
        CHECK(spt_refine(&field, 1, &settings, figure_rounds, wide * high, &rays, &hits) == SPT_OK);
        for (int i = 0; i < wide * high; ++i) residual[i] = all.traced[i].residual;
        before = median_jump(&all, residual);
        for (int i = 0; i < wide * high; ++i) {
            residual[i] = refined[i].residual;
            t[i] = refined[i].t;
        }
        after = median_jump(&all, residual);
        CHECK_SAY(before >= 5 * after, "median jump %g, before %g", after, before);
        check_against_double(&all, &ball, t);
    }
}

void suite_surface_refine_picture(void) {
    RUN(refine_figure_9);
}
