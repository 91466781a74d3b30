/* SPDX-License-Identifier: MIT
 *
 * Möbius levels in float32 by their number: points and normals through all of them, balls that
 * probes pull back, and the distance bound against all instances. */
#include "accuracy_levels.h"

#include "../../oracle/moekrs_ask.h"
#include "../../oracle/surface_oracle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double unit = 0x1p-24;
enum { batch = 64 };

typedef struct work {
    level_model model;
    spt_moekrs built;
    level_way way;
    moekrs_query queries[batch];
    spt_ray rays[batch];
    spt_hit hits[batch];
    float point[batch][3], normal[batch][3];
    uint64_t mirrors[batch];
} work;

/* ---- Points and normals ---------------------------------------------------------------------- */

static void locate(work *on) {
    const spt_rays rays = spt_rays_of(on->rays);
    const spt_hits hits = spt_hits_of(on->hits);
    const spt_settings settings = spt_settings_default();
    spt_krs_places places;
    memset(&places, 0, sizeof places);
    places.mirrors.first = on->mirrors;
    places.mirrors.stride = sizeof on->mirrors[0];
    places.point = spt_vector_sinks_of(on->point[0]);
    places.normal = spt_vector_sinks_of(on->normal[0]);
    for (int i = 0; i < batch; ++i) {
        memset(&on->rays[i], 0, sizeof on->rays[i]);
        memset(&on->hits[i], 0, sizeof on->hits[i]);
        memcpy(on->rays[i].origin, on->queries[i].point, sizeof on->rays[i].origin);
        on->rays[i].direction[2] = 1;
        on->hits[i].outcome = SPT_HIT;
    }
    report_expect(spt_moekrs_locate(&on->built, 0, &settings, batch, &rays, &hits, &places) ==
                      SPT_OK,
                  "locating refuses its arguments");
}

/* Kernel 0's gradient where it sees the point, carried out to the world. Returns how far the point
 * is from the kernel's center, by which its error turns the gradient. */
static extended true_normal(const level_model *model, const level_way *way, extended normal[3]) {
    const spt_kernel *const kernel = &model->kernels[0];
    extended length;
    for (int axis = 0; axis < 3; ++axis)
        normal[axis] = way->at[0].at[axis] - (extended)kernel->a[axis];
    length = extended_length(normal);
    for (int axis = 0; axis < 3; ++axis) normal[axis] /= length;
    for (int i = 0; i < model->levels; ++i) {
        place from = way->at[i];
        if ((way->mirrors >> i & 1) != 0) {
            normal[0] = -normal[0];
            from.at[0] = -from.at[0];
        }
        chain_vector(&model->map[i], 0, from, normal);
    }
    return length;
}

static void compare_places(work *on, accuracy_errors *point, accuracy_errors *normal) {
    for (int i = 0; i < batch; ++i) {
        extended truth[3];
        level_follow(&on->model, level_place(on->queries[i].point), &on->way);
        /* Nearer to a mirror rounding decides on which side a point is. */
        if (on->way.nearest < 1e-3L) continue;
        const int same = on->mirrors[i] == on->way.mirrors;
        const place seen = level_place(on->point[i]), turned = level_place(on->normal[i]);
        const extended scale = (extended)unit * on->way.seen / on->way.scale;
        const extended off = extended_distance(seen.at, on->way.at[0].at) / scale;
        accuracy_add(point, same ? (double)off : HUGE_VAL);
        const extended away = true_normal(&on->model, &on->way, truth);
        const double turn = (double)(extended_distance(turned.at, truth) * away / scale);
        accuracy_add(normal, same ? turn : HUGE_VAL);
    }
}

void accuracy_pulled_points(const report_options *options, FILE *rows) {
    const accuracy_subject points = {"level_point", "levels",
                                     "2^-24 of the largest coordinate that a level sees", ""};
    const accuracy_subject normals = {"level_normal", "levels",
                                      "radians; 2^-24 of that coordinate seen from the kernel", ""};
    accuracy_errors point[16], normal[16];
    work *const on = report_allocate(sizeof *on);
    const int count = accuracy_level_count(level_most);
    for (int i = 0; i < count; ++i) {
        report_random random = {(uint64_t)i};
        point[i] = normal[i] = (accuracy_errors){NULL, 0, 0};
        for (size_t left = accuracy_samples(options, 240); left > 0; --left) {
            level_draw(&random, &on->model, accuracy_levels[i], 1);
            level_build(&on->model, &on->built);
            for (int k = 0; k < batch; ++k) level_near(&random, &on->model, on->queries[k].point);
            locate(on);
            compare_places(on, &point[i], &normal[i]);
        }
    }
    for (int i = 0; i < count; ++i) accuracy_write(rows, &points, accuracy_levels[i], 0, &point[i]);
    for (int i = 0; i < count; ++i)
        accuracy_write(rows, &normals, accuracy_levels[i], 0, &normal[i]);
    free(on);
}

/* ---- Balls ----------------------------------------------------------------------------------- */

static void zero_distance(void *user, size_t n, const float *x, const float *y, const float *z,
                          float *distance) {
    (void)user;
    (void)x;
    (void)y;
    (void)z;
    for (size_t i = 0; i < n; ++i) distance[i] = 0;
}

/* The ball as kernel 0 sees it; 0 where a level turns it inside-out, or nearly: no probe asks
 * there. */
static int pull_back(const level_model *model, solid *ball) {
    for (int i = model->levels - 1; i >= 0; --i) {
        const solid outer = *ball;
        const place center = {{outer.center[0], outer.center[1], outer.center[2]}, 0};
        *ball = chain_solid(&model->map[i], 1, outer);
        /* rho' = scale rho / (1 - m), m the square of the part of the way to the pole that the ball
         * reaches: 1 and more is inside-out. */
        const extended open = chain_scale(&model->map[i], 1, center) * outer.radius / ball->radius;
        if (ball->kind != SPT_REGION_BALL || open < 0.25L) return 0;
        if ((model->unmirrored >> i & 1) == 0) ball->center[0] = -fabsl(ball->center[0]);
    }
    return 1;
}

/* Of a model whose only kernel is everywhere 0 the clearance of a probe is minus the radius that
 * it has there: the radius in float32 itself. Too large is the safe side. */
static void compare_balls(work *on, accuracy_errors *off, accuracy_errors *small) {
    const spt_probe probe = spt_moekrs_probe(&on->built);
    moekrs_ask_probe(&probe, 0, batch, on->queries);
    for (int k = 0; k < batch; ++k) {
        const place center = level_place(on->queries[k].point);
        solid ball = {SPT_REGION_BALL, {center.at[0], center.at[1], center.at[2]}, 0};
        ball.radius = (extended)on->queries[k].radius;
        if (!pull_back(&on->model, &ball)) continue;
        const double more = (double)(-(extended)on->queries[k].answer / ball.radius - 1) / unit;
        accuracy_add(off, fabs(more));
        level_follow(&on->model, center, &on->way);
        accuracy_add(small, fmax(-more, 0) * (double)(ball.radius * on->way.scale / on->way.seen));
    }
}

void accuracy_pulled_balls(const report_options *options, FILE *rows) {
    const accuracy_subject radii = {"level_radius", "levels", "2^-24 of the radius", ""};
    const accuracy_subject smaller = {
        "level_radius_small", "levels",
        "too small by; 2^-24 of the largest coordinate that a level sees", ""};
    accuracy_errors off[16], small[16];
    work *const on = report_allocate(sizeof *on);
    spt_field zero = spt_field_default();
    const int count = accuracy_level_count(level_most);
    zero.batch = zero_distance;
    for (int i = 0; i < count; ++i) {
        report_random random = {(uint64_t)i};
        off[i] = small[i] = (accuracy_errors){NULL, 0, 0};
        for (size_t left = accuracy_samples(options, 240); left > 0; --left) {
            level_draw(&random, &on->model, accuracy_levels[i], 1);
            on->model.kernels[0] = spt_kernel_field(&zero);
            level_build(&on->model, &on->built);
            for (int k = 0; k < batch; ++k) {
                level_somewhere(&random, &on->model, on->queries[k].point);
                on->queries[k].radius =
                    (float)((double)on->model.reach * accuracy_spread(&random, 1e-5, 0.3));
            }
            compare_balls(on, &off[i], &small[i]);
        }
    }
    for (int i = 0; i < count; ++i) accuracy_write(rows, &radii, accuracy_levels[i], 0, &off[i]);
    for (int i = 0; i < count; ++i)
        accuracy_write(rows, &smaller, accuracy_levels[i], 0, &small[i]);
    free(on);
}

/* ---- The bound ------------------------------------------------------------------------------- */

/* Above the distance never but by rounding, and how far below. */
static void compare_bound(work *on, accuracy_errors *above, accuracy_errors *below) {
    const spt_field field = spt_moekrs_field(&on->built);
    moekrs_ask_field(&field, 0, batch, on->queries);
    for (int k = 0; k < batch; ++k) {
        const place p = level_place(on->queries[k].point);
        const extended truth = level_distance(&on->model, &p);
        const extended value = (extended)on->queries[k].answer;
        level_follow(&on->model, p, &on->way);
        const extended over = (truth > 0 ? value - truth : truth - value) / (extended)unit;
        accuracy_add(above, (double)fmaxl(over / on->way.seen, 0));
        /* half of the points are anywhere, as far away as the model is large */
        if (k % 2 == 0 && truth > 0) accuracy_add(below, (double)(1 - value / truth));
    }
}

void accuracy_moekrs(const report_options *options, FILE *rows) {
    const accuracy_subject excess = {
        "moekrs_above", "levels", "2^-24 of the largest coordinate that a level sees",
        "mobius.h: above the distance by about 2^-20 of the coordinates that the levels see"};
    const accuracy_subject tightness = {"moekrs_below", "levels", "of the distance",
                                        "mobius.h: how much depends on the maps"};
    accuracy_errors above[16], below[16];
    work *const on = report_allocate(sizeof *on);
    const int count = accuracy_level_count(level_most);
    for (int i = 0; i < count; ++i) {
        report_random random = {(uint64_t)i};
        above[i] = below[i] = (accuracy_errors){NULL, 0, 0};
        for (size_t left = accuracy_samples(options, 480); left > 0; --left) {
            level_draw(&random, &on->model, accuracy_levels[i], 0);
            level_build(&on->model, &on->built);
            for (int k = 0; k < batch; ++k)
                (k % 2 == 0 ? level_somewhere : level_near)(&random, &on->model,
                                                            on->queries[k].point);
            compare_bound(on, &above[i], &below[i]);
        }
    }
    for (int i = 0; i < count; ++i)
        accuracy_write(rows, &excess, accuracy_levels[i], 16, &above[i]);
    for (int i = 0; i < count; ++i)
        accuracy_write(rows, &tightness, accuracy_levels[i], 0, &below[i]);
    free(on);
}
