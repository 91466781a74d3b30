/* SPDX-License-Identifier: MIT
 *
 * The list of rules, the runs over rules and widths, and the random worlds of the oracle tests. */
#include "harness.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>

/* The reference's rules in its own order. */
static const spt_method *(*const referenced[REFERENCE_RULES])(void) = {
    spt_basic, spt_relaxed, spt_enhanced, spt_auto_relaxed, spt_adaptive, spt_convex};

static reference_rule reference_of(const spt_method *method) {
    int place = 0;
    while (place < REFERENCE_RULES && referenced[place]() != method) ++place;
    return (reference_rule)place;
}

const spt_method *oracle_method(reference_rule wanted) {
    return referenced[wanted]();
}

int oracle_next(oracle_run *run, int convex) {
    while (run->state < rule_count * width_count) {
        const rule *one = &rules[run->state / width_count];
        const uint32_t lanes = widths[run->state % width_count];
        ++run->state;
        if (lanes > (uint32_t)spt_lanes()) continue;
        if (!rule_allowed(one, convex ? SPT_FIELD_CONVEX : 0)) continue;
        run->method = one->method();
        run->rule = reference_of(run->method);
        run->lanes = lanes;
        check_context("method %s, %u lanes", one->name, lanes);
        return 1;
    }
    return 0;
}

spt_settings oracle_settings(const oracle_run *run) {
    spt_settings settings = spt_settings_default();
    settings.method = run->method;
    settings.max_lanes = run->lanes;
    return settings;
}

void oracle_trace(const spt_field *field, const spt_settings *settings, size_t count,
                  const spt_ray *rays, spt_hit *hits) {
    const spt_rays from = spt_rays_of(rays);
    const spt_hits to = spt_hits_of(hits);
    spt_statistics statistics = spt_statistics_default();
    CHECK(spt_trace(field, settings, count, &from, &to, &statistics) == SPT_OK);
    CHECK_SAY(settings->max_lanes == 0 || statistics.lanes == settings->max_lanes, "ran %u",
              statistics.lanes);
}

spt_hit oracle_trace_one(const spt_field *field, const spt_settings *settings, const spt_ray *ray) {
    spt_hit hit = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    oracle_trace(field, settings, 1, ray, &hit);
    return hit;
}

static void rounded_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                          float *distance) {
    const reference_field *field = user;
    for (size_t i = 0; i < n; ++i) {
        const real position[3] = {(real)x[i], (real)y[i], (real)z[i]};
        distance[i] = (float)field->distance(field->user, position);
    }
}

spt_field oracle_field(const reference_field *field, int convex) {
    spt_field view = spt_field_default();
    view.batch = rounded_batch;
    view.user = (void *)(uintptr_t)field; /* read only */
    view.lipschitz = (float)field->lipschitz;
    view.flags = convex ? SPT_FIELD_CONVEX : 0;
    return view;
}

int oracle_same_hit(const spt_hit *a, const spt_hit *b) {
    return check_same_bits(a->t, b->t) && check_same_bits(a->residual, b->residual) &&
           a->outcome == b->outcome && a->evaluations == b->evaluations && a->flags == b->flags &&
           a->component == b->component && check_same_bits(a->candidate_t, b->candidate_t) &&
           check_same_bits(a->candidate_ratio, b->candidate_ratio) && a->fallbacks == b->fallbacks;
}

world world_draw(void) {
    world w;
    w.count = 1 + (int)(check_random() % world_spheres);
    w.has_floor = (int)(check_random() % 2);
    w.scale = 1;
    for (int i = 0; i < w.count; ++i) {
        w.center[i][0] = check_uniform(-3, 3);
        w.center[i][1] = check_uniform(-2, 2);
        w.center[i][2] = 8 + check_uniform(-4, 4);
        w.radius[i] = check_uniform(0.1, 1.1);
    }
    return w;
}

spt_ray world_ray(void) {
    spt_ray ray = {{0, 0, 0}, 0, {0, 0, 0}, 50};
    double d[3], length;
    for (int axis = 0; axis < 3; ++axis) {
        const double reach = axis == 2 ? 1 : 0.5;
        ray.origin[axis] = (float)check_uniform(-reach, reach);
        d[axis] = axis == 2 ? 1 : check_uniform(-0.5, 0.5);
    }
    length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int axis = 0; axis < 3; ++axis) ray.direction[axis] = (float)(d[axis] / length);
    return ray;
}

static real world_distance(const void *user, const real position[3]) {
    const world *w = user;
    const double x = position[0], y = position[1], z = position[2];
    double least = w->has_floor ? y + 3 * w->scale : HUGE_VAL;
    for (int i = 0; i < w->count; ++i) {
        const double a = x - w->scale * w->center[i][0], b = y - w->scale * w->center[i][1],
                     c = z - w->scale * w->center[i][2];
        const double distance = sqrt(a * a + b * b + c * c) - w->scale * w->radius[i];
        if (distance < least) least = distance;
    }
    return (real)least;
}

reference_field world_field(const world *w) {
    reference_field field = {world_distance, NULL, 1};
    field.user = w;
    return field;
}

world_hit world_trace(const world *w, const spt_ray *ray) {
    world_hit hit = {HUGE_VAL, HUGE_VAL};
    const double length = oracle_length(ray);
    double o[3], d[3];
    for (int axis = 0; axis < 3; ++axis) {
        o[axis] = (double)ray->origin[axis] / w->scale;
        d[axis] = (double)ray->direction[axis] / length;
    }
    for (int i = 0; i < w->count; ++i) {
        double v[3], along = 0, across = 0, half;
        for (int axis = 0; axis < 3; ++axis) {
            v[axis] = o[axis] - w->center[i][axis];
            along -= v[axis] * d[axis];
        }
        for (int axis = 0; axis < 3; ++axis) {
            const double offset = v[axis] + along * d[axis];
            across += offset * offset;
        }
        hit.gap = fmin(hit.gap, fabs(sqrt(across) - w->radius[i]));
        half = w->radius[i] * w->radius[i] - across;
        if (half >= 0 && along - sqrt(half) >= 0) hit.t = fmin(hit.t, along - sqrt(half));
    }
    if (w->has_floor) {
        hit.gap = fmin(hit.gap, fabs(d[1]));
        if (d[1] < 0) hit.t = fmin(hit.t, -(3 + o[1]) / d[1]);
    }
    hit.gap = fmin(hit.gap, 0.4 * fabs(hit.t - (double)ray->t_max * length / w->scale));
    hit.t *= w->scale / length;
    if (hit.t < (double)ray->t_min || hit.t > (double)ray->t_max) hit.t = HUGE_VAL;
    return hit;
}

void oracle_draw(drawn *out) {
    spt_settings *settings = &out->settings;
    out->scene = world_draw();
    out->field = world_field(&out->scene);
    *settings = spt_settings_default();
    settings->budget = 200;
    settings->epsilon = 1e-4f;
    settings->pixel_radius = 1e-5f;
    if (check_random() % 2 != 0) {
        settings->relaxation = (float)check_uniform(1, 1.9999);
        settings->extrapolation = (float)check_uniform(0, 1);
        settings->slope_blend = (float)check_uniform(0.001, 1);
        settings->step_cap = (float)pow(10, check_uniform(0, 2));
    }
    for (int i = 0; i < drawn_rays; ++i) {
        out->rays[i] = world_ray();
        out->truth[i] = world_trace(&out->scene, &out->rays[i]);
    }
}

spt_settings oracle_drawn_settings(const drawn *d, const oracle_run *run) {
    spt_settings settings = d->settings;
    settings.method = run->method;
    settings.max_lanes = run->lanes;
    return settings;
}
