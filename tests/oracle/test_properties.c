/* SPDX-License-Identifier: MIT
 *
 * Properties with random inputs, against first hits known in double: Q1 to
 * Q4, Q8, Q11, Q13, Q14, with every rule at every width. Those that compare the library with itself
 * are in test_invariance.c. */
#include "harness.h"
#include "../check.h"

#include <math.h>

enum { worlds = 50 };

typedef void property(const drawn *d, const spt_settings *settings, const spt_field *field);

static void each_run(property *holds) {
    for (int i = 0; i < worlds; ++i) {
        drawn d;
        spt_field field;
        oracle_run run = oracle_first_run;
        oracle_draw(&d);
        field = oracle_field(&d.field, 0);
        while (oracle_next(&run, 0)) {
            const spt_settings settings = oracle_drawn_settings(&d, &run);
            holds(&d, &settings, &field);
        }
    }
}

/* Late by two thousandths only where the ray grazes; off by 0.05 nowhere else: the largest
 * tolerance, 1e-5 * 50, over the least cosine, 0.02 at the floor, is 0.025. */
static void check_place(const world_hit *truth, double t) {
    CHECK_SAY(t <= truth->t + 2e-3 * (1 + truth->t) || truth->gap < 0.01, "%.9g behind %.9g", t,
              truth->t);
    CHECK_SAY(truth->gap <= 0.02 || fabs(t - truth->t) < 0.05, "%.9g for %.9g", t, truth->t);
}

static void hits_not_behind(const drawn *d, const spt_settings *settings, const spt_field *field) {
    spt_hit hits[drawn_rays];
    oracle_trace(field, settings, drawn_rays, d->rays, hits);
    for (int i = 0; i < drawn_rays; ++i) {
        if (hits[i].outcome == SPT_HIT) check_place(&d->truth[i], (double)hits[i].t);
        CHECK_SAY((hits[i].flags & SPT_FLAG_STEEP) == 0, "ray %d", i);
    }
}

static void Q1_hit_is_not_behind(void) {
    each_run(hits_not_behind);
}

/* f at p(t), as the library computes it: o + t d with two roundings. */
static float value_at(const spt_field *field, const spt_ray *ray, float t) {
    float x[16], y[16], z[16], distance[16];
    for (int i = 0; i < 16; ++i) {
        const float along[3] = {t * ray->direction[0], t * ray->direction[1],
                                t * ray->direction[2]};
        x[i] = ray->origin[0] + along[0];
        y[i] = ray->origin[1] + along[1];
        z[i] = ray->origin[2] + along[2];
    }
    field->batch(field->user, 16, x, y, z, distance);
    return distance[0];
}

/* The candidate's ratio is that of f there, and none of the certified samples looks closer: not the
 * last. The library may round a few times on the way, each by u; 8u are allowed. */
static void check_candidate(const spt_settings *settings, const spt_field *field,
                            const spt_ray *ray, const spt_hit *hit) {
    const double length = oracle_length(ray), epsilon = (double)settings->epsilon;
    const double f = (double)value_at(field, ray, hit->candidate_t);
    const double ratio = fabs(f) / fmax((double)hit->candidate_t * length, epsilon);
    const double last = fabs((double)hit->residual) / fmax((double)hit->t * length, epsilon);
    CHECK_SAY(fabs((double)hit->candidate_ratio - ratio) <= 0x1p-21 * ratio, "%.9g for %.9g",
              (double)hit->candidate_ratio, ratio);
    CHECK(hit->outcome == SPT_MISS || (double)hit->candidate_ratio <= last * (1 + 0x1p-21));
}

static void residual_is_f(const drawn *d, const spt_settings *settings, const spt_field *field) {
    spt_hit hits[drawn_rays];
    oracle_trace(field, settings, drawn_rays, d->rays, hits);
    for (int i = 0; i < drawn_rays; ++i) {
        /* the library's tolerance is a sum and two products in float */
        const spt_hit *hit = &hits[i];
        const double t = (double)hit->t;
        const double tolerance = oracle_tolerance(settings, &d->rays[i], t) * (1 + 0x1p-21);
        check_candidate(settings, field, &d->rays[i], hit);
        if (hit->outcome != SPT_HIT && hit->outcome != SPT_LIMIT) continue;
        CHECK(check_same_bits(hit->residual, value_at(field, &d->rays[i], hit->t)));
        CHECK_SAY(hit->outcome != SPT_HIT || fabs((double)hit->residual) < tolerance,
                  "residual %g, tolerance %g", (double)hit->residual, tolerance);
    }
}

static void Q2_residual_is_f(void) {
    each_run(residual_is_f);
}

static void no_clear_hit_missed(const drawn *d, const spt_settings *settings,
                                const spt_field *field) {
    spt_hit hits[drawn_rays];
    oracle_trace(field, settings, drawn_rays, d->rays, hits);
    for (int i = 0; i < drawn_rays; ++i) {
        const world_hit *truth = &d->truth[i];
        const double t = (double)hits[i].t;
        CHECK(hits[i].outcome == SPT_HIT || hits[i].outcome == SPT_MISS ||
              hits[i].outcome == SPT_LIMIT);
        if (hits[i].outcome == SPT_MISS) {
            CHECK_SAY(!(truth->t < HUGE_VAL) || truth->gap < 1e-3, "missed %.9g", truth->t);
        }
        if (hits[i].outcome == SPT_LIMIT) {
            CHECK_SAY(t <= truth->t + 1e-3 * (1 + truth->t), "%.9g behind %.9g", t, truth->t);
        }
    }
}

static void Q3_miss_has_no_clear_hit(void) {
    each_run(no_clear_hit_missed);
}

static void halves_agree(const drawn *d, const spt_settings *settings, const spt_field *field) {
    spt_ray near[drawn_rays], far[drawn_rays];
    spt_hit near_hits[drawn_rays], far_hits[drawn_rays];
    spt_settings patient = *settings;
    patient.budget =
        1000; /* towards the floor at 0.02, r falls by 2 % a step: ln(50 / 5e-4) / 0.02 */
    for (int i = 0; i < drawn_rays; ++i) {
        const double split = d->truth[i].t < HUGE_VAL ? d->truth[i].t / 2 : 25;
        near[i] = far[i] = d->rays[i];
        near[i].t_max = far[i].t_min = (float)split;
    }
    oracle_trace(field, &patient, drawn_rays, near, near_hits);
    oracle_trace(field, &patient, drawn_rays, far, far_hits);
    for (int i = 0; i < drawn_rays; ++i) {
        const world_hit *truth = &d->truth[i];
        if (!(truth->gap > 0.02)) continue;
        CHECK_SAY(near_hits[i].outcome == SPT_MISS, "near half %d", near_hits[i].outcome);
        CHECK_SAY(far_hits[i].outcome == (truth->t < HUGE_VAL ? SPT_HIT : SPT_MISS),
                  "far half %d, truth %g", far_hits[i].outcome, truth->t);
        CHECK(far_hits[i].t >= far[i].t_min);
        if (far_hits[i].outcome == SPT_HIT) check_place(truth, (double)far_hits[i].t);
    }
}

static void Q4_split_interval(void) {
    each_run(halves_agree);
}

/* The world in front of a plane z = cut, behind which the field is NaN. */
typedef struct cut_world {
    reference_field field;
    double cut;
} cut_world;

static real cut_distance(const void *user, const real position[3]) {
    const cut_world *w = user;
    return position[2] > (real)w->cut ? (real)NAN : w->field.distance(w->field.user, position);
}

static void Q8_nan_half_space(void) {
    for (int i = 0; i < worlds; ++i) {
        drawn d;
        cut_world w;
        reference_field cut = {cut_distance, NULL, 1};
        spt_field field;
        oracle_run run = oracle_first_run;
        oracle_draw(&d);
        w.field = d.field;
        w.cut = check_uniform(1.5, 8);
        cut.user = &w;
        field = oracle_field(&cut, 0);
        while (oracle_next(&run, 0)) {
            const spt_settings settings = oracle_drawn_settings(&d, &run);
            spt_hit hits[drawn_rays];
            oracle_trace(&field, &settings, drawn_rays, d.rays, hits);
            for (int ray = 0; ray < drawn_rays; ++ray) {
                const spt_hit *hit = &hits[ray];
                const float along = hit->t * d.rays[ray].direction[2];
                const float z = d.rays[ray].origin[2] + along;
                const int behind = (double)z > w.cut;
                /* Every ray runs on behind the plane, so none can miss. */
                CHECK_SAY(hit->outcome == SPT_NONFINITE || hit->outcome == SPT_LIMIT ||
                              hit->outcome == SPT_HIT,
                          "%d", hit->outcome);
                CHECK_SAY(behind == (hit->outcome == SPT_NONFINITE), "outcome %d at z %g, cut %g",
                          hit->outcome, (double)z, w.cut);
                CHECK(isnan(hit->residual) == (hit->outcome == SPT_NONFINITE));
                CHECK(hit->t >= 0 && hit->t <= d.rays[ray].t_max);
                if (hit->outcome == SPT_HIT) check_place(&d.truth[ray], (double)hit->t);
            }
        }
    }
}

/* Inside below z = 2; from 2.5 to 3.5 the field answers -infinity. */
static real pierced_distance(const void *user, const real position[3]) {
    (void)user;
    return position[2] > (real)2.5 && position[2] < (real)3.5 ? -(real)HUGE_VAL : position[2] - 2;
}

/* What is not finite where a probe went is no event: the ray goes back, and finds the way out. From
 * inside -infinity looks like a large radius. */
static void Q8_probe_into_minus_infinity(void) {
    const reference_field pierced = {pierced_distance, NULL, 1};
    const spt_field field = oracle_field(&pierced, 0);
    const spt_ray ray = {{0, 0, 0}, 0, {0, 0, 1}, 100};
    oracle_run run = oracle_first_run;
    while (oracle_next(&run, 0)) {
        spt_settings settings = oracle_settings(&run);
        spt_hit hit;
        settings.relaxation = 1.5f;
        hit = oracle_trace_one(&field, &settings, &ray);
        CHECK_SAY(hit.outcome == SPT_HIT, "%d at %g", hit.outcome, (double)hit.t);
        CHECK(fabs((double)hit.t - 2) <= 1e-4 && hit.flags == SPT_FLAG_INSIDE);
    }
}

/* A ray that starts in the world's first ball, at its center every fourth time. */
static spt_ray ray_inside(const world *w) {
    spt_ray ray = world_ray();
    const double spread = check_random() % 4 == 0 ? 0 : 0.5 * w->radius[0];
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = (float)(w->center[0][axis] + check_uniform(-spread, spread));
        if (check_random() % 4 == 0) ray.direction[axis] = -ray.direction[axis];
    }
    return ray;
}

static void Q11_way_out_of_a_sphere(void) {
    for (int i = 0; i < 4 * worlds; ++i) {
        drawn d;
        spt_field field;
        oracle_run run = oracle_first_run;
        oracle_draw(&d);
        d.scene.count = 1;
        d.scene.has_floor = 0;
        for (int ray = 0; ray < drawn_rays; ++ray) d.rays[ray] = ray_inside(&d.scene);
        field = oracle_field(&d.field, 1);
        while (oracle_next(&run, 1)) {
            const spt_settings settings = oracle_drawn_settings(&d, &run);
            spt_hit hits[drawn_rays];
            oracle_trace(&field, &settings, drawn_rays, d.rays, hits);
            for (int ray = 0; ray < drawn_rays; ++ray) {
                const double t = (double)hits[ray].t;
                const double bound = oracle_tolerance(&settings, &d.rays[ray], t) +
                                     oracle_floor(&settings, &d.rays[ray], t);
                real p[3], off;
                for (int axis = 0; axis < 3; ++axis) {
                    p[axis] = (real)((double)d.rays[ray].origin[axis] +
                                     t * (double)d.rays[ray].direction[axis]);
                }
                off = d.field.distance(d.field.user, p);
                CHECK_SAY(hits[ray].outcome == SPT_HIT, "%d", hits[ray].outcome);
                CHECK_SAY(fabs(off) <= bound && fabs(off) < 0.01, "off by %g of %g", off, bound);
                CHECK(hits[ray].flags == SPT_FLAG_INSIDE);
            }
        }
    }
}

static void Q13_rules_agree_on_clear_hits(void) {
    for (int i = 0; i < worlds; ++i) {
        drawn d;
        spt_field field;
        oracle_run run = oracle_first_run;
        oracle_draw(&d);
        field = oracle_field(&d.field, 0);
        while (oracle_next(&run, 0)) {
            spt_settings settings = oracle_drawn_settings(&d, &run);
            spt_hit hits[drawn_rays];
            settings.budget = 100000;
            oracle_trace(&field, &settings, drawn_rays, d.rays, hits);
            for (int ray = 0; ray < drawn_rays; ++ray) {
                const world_hit *truth = &d.truth[ray];
                if (!(truth->gap > 0.02)) continue;
                CHECK_SAY(hits[ray].outcome == (truth->t < HUGE_VAL ? SPT_HIT : SPT_MISS), "%d",
                          hits[ray].outcome);
                if (hits[ray].outcome == SPT_HIT) check_place(truth, (double)hits[ray].t);
            }
        }
    }
}

/* A ball of the given radius at z = place, times a factor. */
typedef struct lone_ball {
    double radius, place, factor;
} lone_ball;

static real lone_distance(const void *user, const real position[3]) {
    const lone_ball *b = user;
    const double x = position[0], y = position[1], z = position[2] - b->place;
    return (real)(b->factor * (sqrt(x * x + y * y + z * z) - b->radius));
}

static spt_hit trace_ball(const lone_ball *ball, const spt_settings *settings, double t_min) {
    reference_field exact = {lone_distance, NULL, 1};
    spt_field field;
    spt_ray ray = {{0, 0, 0}, 0, {0, 0, 1}, INFINITY};
    exact.user = ball;
    field = oracle_field(&exact, 0);
    ray.t_min = (float)t_min;
    return oracle_trace_one(&field, settings, &ray);
}

/* Balls of radius 1 and 1e3 far ahead (at 1e2 to 1e8; the large one is a plane where it is met),
 * and balls of 1e-18 to 1e18 at ten times their radius. */
static void Q14_steep_only_where_it_is(void) {
    oracle_run run = oracle_first_run;
    while (oracle_next(&run, 0)) {
        for (int power = 2; power <= 8; ++power) {
            for (int i = 0; i < 20; ++i) {
                const double far = pow(10, power) * check_uniform(1, 1.5) + check_uniform(0, 1);
                const lone_ball ball = {i % 2 != 0 ? 1 : 1e3, far + 1e3, 1};
                spt_settings settings = oracle_settings(&run);
                spt_hit hit;
                settings.budget = 256;
                hit = trace_ball(&ball, &settings, 0);
                CHECK_SAY(hit.flags == 0, "ball at %g: flags %u", ball.place, hit.flags);
                CHECK_SAY(hit.outcome == SPT_HIT, "ball at %g: %d", ball.place, hit.outcome);
            }
        }
        for (int power = -18; power <= 18; ++power) {
            const double scale = pow(10, power);
            lone_ball ball = {0, 0, 1};
            spt_settings settings = oracle_settings(&run);
            spt_hit hit;
            ball.radius = scale;
            ball.place = 10 * scale;
            settings.epsilon = (float)(1e-4 * scale);
            hit = trace_ball(&ball, &settings, 0);
            CHECK_SAY(hit.flags == 0 && hit.outcome == SPT_HIT, "1e%d: flags %u", power, hit.flags);
            ball.factor = 1.5; /* jumps over it; only the slope behind it betrays that */
            hit = trace_ball(&ball, &settings, 0);
            CHECK_SAY((hit.flags & SPT_FLAG_STEEP) != 0, "1e%d: flags %u", power, hit.flags);
            ball.factor = 2; /* steps of 1.8 radii from 0.9 before the surface */
            hit = trace_ball(&ball, &settings, 8.1 * scale);
            CHECK_SAY((hit.flags & SPT_FLAG_STEEP) != 0, "1e%d: flags %u", power, hit.flags);
        }
    }
}

/* Rises to 2 at z = 1, falls to 0.5 at 1.9 with slope 5/3, rises again. */
static real kinked_distance(const void *user, const real position[3]) {
    const double z = position[2];
    (void)user;
    if (z <= 1) return (real)(1 + z);
    return (real)(z <= 1.9 ? 2 - (z - 1) * 5 / 3 : 0.5 + (z - 1.9));
}

/* A rejected probe that is reached for free is a verified sample like any other: here 1.9, from the
 * fallback at 1. */
static void Q14_free_jump_is_audited(void) {
    const reference_field kinked = {kinked_distance, NULL, 1};
    const spt_field field = oracle_field(&kinked, 0);
    const spt_ray ray = {{0, 0, 0}, 0, {0, 0, 1}, 100};
    oracle_run run = oracle_first_run;
    while (oracle_next(&run, 0)) {
        spt_settings settings = oracle_settings(&run);
        spt_hit hit;
        if (run.rule != REFERENCE_RELAXED) continue;
        settings.relaxation = 1.9f;
        hit = oracle_trace_one(&field, &settings, &ray);
        CHECK(hit.outcome == SPT_MISS && hit.fallbacks == 1);
        CHECK_SAY(hit.flags == SPT_FLAG_STEEP, "flags %u", hit.flags);
    }
}

void suite_properties(void) {
    RUN(Q1_hit_is_not_behind);
    RUN(Q2_residual_is_f);
    RUN(Q3_miss_has_no_clear_hit);
    RUN(Q4_split_interval);
    RUN(Q8_nan_half_space);
    RUN(Q8_probe_into_minus_infinity);
    RUN(Q11_way_out_of_a_sphere);
    RUN(Q13_rules_agree_on_clear_hits);
    RUN(Q14_steep_only_where_it_is);
    RUN(Q14_free_jump_is_audited);
}
