/* SPDX-License-Identifier: MIT
 *
 * Makes bundles of rays and sends them ahead. */
#include "bundle.h"

#include <float.h>
#include <math.h>

#include "../base/arguments.h"

/* What rounding a direction's components, each below 1, can add to the distance of two of them. */
#define DIRECTION_ROUNDING 0x1p-21f
/* A caller's directions may be this much longer or shorter than 1. */
#define LENGTH_SLACK 1e-5f
/* Cones of half angles near 60 degrees and above get nowhere, and are not convex in the image. */
#define WIDEST_ALPHA 1.0f

static float at_least(float a, float b) {
    return a < b ? b : a;
}

/* How far the corners of rectangles are from their middles at most; in an array of x, y or z
 * each. */
static void farthest_corners(const float (*arrays)[SPT_BATCH], float distance[SPTI_BUNDLES]) {
    for (size_t i = 0; i < SPTI_BUNDLES; ++i) distance[i] = 0.0f;
    for (size_t corner = SPTI_BUNDLES; corner <= 4 * SPTI_BUNDLES; corner += SPTI_BUNDLES) {
        for (size_t i = 0; i < SPTI_BUNDLES; ++i) {
            const float x = arrays[0][i] - arrays[0][corner + i];
            const float y = arrays[1][i] - arrays[1][corner + i];
            const float z = arrays[2][i] - arrays[2][corner + i];
            distance[i] = at_least(x * x + y * y + z * z, distance[i]);
        }
    }
    for (size_t i = 0; i < SPTI_BUNDLES; ++i) distance[i] = sqrtf(distance[i]);
}

/* Fills in what follows from the arrays of the usable bundles. */
static void finish(spti_bundles *bundles) {
    bundles->widest_alpha = bundles->widest_beta = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        bundles->origin_low[axis] = INFINITY;
        bundles->origin_high[axis] = -INFINITY;
    }
    for (size_t i = 0; i < SPTI_BUNDLES; ++i) {
        float reach = 0.0f;
        for (int axis = 0; axis < 3; ++axis) {
            reach = at_least(fabsf(bundles->origin[axis][i]), reach);
        }
        bundles->floor_at_0[i] = SPTI_FLOOR * reach;
        if (!(reach < FLT_MAX / 2)) bundles->usable &= ~(1u << i); /* positions stay finite */
        if (!(bundles->usable >> i & 1)) continue;
        bundles->widest_alpha = at_least(bundles->alpha[i], bundles->widest_alpha);
        bundles->widest_beta = at_least(bundles->beta[i], bundles->widest_beta);
        for (int axis = 0; axis < 3; ++axis) {
            const float origin = bundles->origin[axis][i];
            bundles->origin_high[axis] = at_least(bundles->origin_high[axis], origin);
            if (origin < bundles->origin_low[axis]) bundles->origin_low[axis] = origin;
        }
    }
}

/* Gives slot i the ray of slot j as its middle. */
static void set_middle(spti_bundles *bundles, size_t i, const spti_ray_arrays *rays, size_t j) {
    for (int axis = 0; axis < 3; ++axis) {
        bundles->origin[axis][i] = rays->origin[axis][j];
        bundles->direction[axis][i] = rays->direction[axis][j];
    }
}

/* What rounding the origins of an orthographic camera can add to their distance. */
static float origin_rounding(const spti_view *view, const spti_bundles *bundles, size_t i) {
    float reach = 0.0f;
    if (view->kind == SPT_CAMERA_PINHOLE) return 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        reach = at_least(fabsf(bundles->origin[axis][i]), reach);
        reach = at_least(fabsf(view->eye[axis]), reach);
    }
    return reach * DIRECTION_ROUNDING;
}

void spti_bundles_of(const spti_view *view, spti_isa isa, unsigned present,
                     const float (*rectangles)[4], spti_bundles *bundles) {
    SPTI_ALIGNED(64) float x[SPT_BATCH];
    SPTI_ALIGNED(64) float y[SPT_BATCH];
    spti_ray_arrays rays;
    /* The middles first, then the corners: the cap of the sphere that holds the corners of a
     * rectangle's directions meets the image plane in a convex region, so holds all of them. */
    for (size_t i = 0; i < SPTI_BUNDLES; ++i) {
        const float *const r = rectangles[i];
        x[i] = 0.5f * (r[0] + r[2]);
        y[i] = 0.5f * (r[1] + r[3]);
        for (size_t corner = 0; corner < 4; ++corner) {
            x[(corner + 1) * SPTI_BUNDLES + i] = corner % 2 == 0 ? r[0] : r[2];
            y[(corner + 1) * SPTI_BUNDLES + i] = corner / 2 == 0 ? r[1] : r[3];
        }
    }
    spti_cone_kernels_of[isa]->rays(view, (size_t)5 * SPTI_BUNDLES, x, y, &rays);
    bundles->present = present;
    bundles->usable = 0;
    bundles->longest_path = 0.0f;
    float alpha[SPTI_BUNDLES], beta[SPTI_BUNDLES] = {0.0f};
    farthest_corners((const float(*)[SPT_BATCH])rays.direction, alpha);
    if (view->kind != SPT_CAMERA_PINHOLE) {
        farthest_corners((const float(*)[SPT_BATCH])rays.origin, beta);
    }
    for (size_t i = 0; i < SPTI_BUNDLES; ++i) {
        set_middle(bundles, i, &rays, i);
        bundles->alpha[i] = alpha[i] + DIRECTION_ROUNDING;
        bundles->beta[i] = beta[i] + origin_rounding(view, bundles, i);
        bundles->t_min[i] = view->t_min;
        bundles->t_max[i] = view->t_max;
        if ((present >> i & 1) && bundles->alpha[i] < WIDEST_ALPHA && beta[i] < FLT_MAX) {
            bundles->usable |= 1u << i;
        }
    }
    finish(bundles);
}

/* ---- A caller's rays ------------------------------------------------------------------------ */

static float apart(const float a[3], const float b[3]) {
    const float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrtf(x * x + y * y + z * z);
}

/* Whether a ray counts at all: not one that is left out, nor a bad one (trace.h). */
static int is_member(const spt_camera_ray *ray) {
    float largest = 0.0f;
    if (ray->active == 0) return 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (!spti_finite(ray->ray.origin[axis]) || !spti_finite(ray->ray.direction[axis])) return 0;
        largest = at_least(fabsf(ray->ray.direction[axis]), largest);
    }
    return largest >= FLT_MIN && spti_within(ray->ray.t_min, 0.0f, FLT_MAX) &&
           spti_within(ray->path, 0.0f, FLT_MAX) && ray->ray.t_max <= INFINITY;
}

/* Whether its length is one for which its bundle's cone is right. */
static int is_plain(const spt_camera_ray *ray) {
    const float *const d = ray->ray.direction;
    return fabsf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - 1.0f) <= 2.0f * LENGTH_SLACK;
}

/* The middle ray of 16: the mean. Returns 0 where there is none, or they are not plain. */
static int middle_ray(const spt_camera_ray *rays, float origin[3], float direction[3]) {
    float members = 0.0f;
    int plain = 1;
    for (int axis = 0; axis < 3; ++axis) origin[axis] = direction[axis] = 0.0f;
    for (size_t j = 0; j < SPTI_GROUP; ++j) {
        if (!is_member(&rays[j])) continue;
        members += 1.0f;
        plain = plain && is_plain(&rays[j]);
    }
    for (size_t j = 0; plain && j < SPTI_GROUP; ++j) {
        if (!is_member(&rays[j])) continue;
        for (int axis = 0; axis < 3; ++axis) {
            origin[axis] += rays[j].ray.origin[axis] / members;
            direction[axis] += rays[j].ray.direction[axis];
        }
    }
    const float length = apart(direction, (const float[3]){0.0f, 0.0f, 0.0f});
    if (!(length > 0.0f)) return 0;
    for (int axis = 0; axis < 3; ++axis) direction[axis] /= length;
    return 1;
}

/* Bundle i of 16 rays. */
static void bundle_rays(const spt_camera_ray *rays, size_t i, spti_bundles *bundles) {
    float origin[3], direction[3], alpha = 0.0f, beta = 0.0f;
    float t_min = FLT_MAX, t_max = 0.0f;
    const int plain = middle_ray(rays, origin, direction);
    for (size_t j = 0; j < SPTI_GROUP; ++j) {
        if (!is_member(&rays[j])) continue;
        bundles->present |= 1u << i;
        bundles->longest_path = at_least(rays[j].path, bundles->longest_path);
        alpha = at_least(apart(rays[j].ray.direction, direction), alpha);
        beta = at_least(apart(rays[j].ray.origin, origin), beta);
        t_max = at_least(rays[j].ray.t_max, t_max);
        if (rays[j].ray.t_min < t_min) t_min = rays[j].ray.t_min;
    }
    for (int axis = 0; axis < 3; ++axis) {
        bundles->origin[axis][i] = plain ? origin[axis] : 0.0f;
        bundles->direction[axis][i] = plain ? direction[axis] : (float)(axis == 2);
    }
    bundles->alpha[i] = plain ? alpha + DIRECTION_ROUNDING + LENGTH_SLACK : 0.0f;
    bundles->beta[i] = plain ? beta + beta * DIRECTION_ROUNDING : 0.0f;
    bundles->t_min[i] = plain ? t_min : 0.0f;
    bundles->t_max[i] = t_max;
    if (plain && bundles->alpha[i] < WIDEST_ALPHA && bundles->beta[i] <= FLT_MAX) {
        bundles->usable |= 1u << i;
    }
}

void spti_bundles_of_rays(const spt_camera_ray *rays, spti_bundles *bundles) {
    bundles->present = bundles->usable = 0;
    bundles->longest_path = 0.0f;
    for (size_t i = 0; i < SPTI_BUNDLES; ++i) bundle_rays(rays + i * SPTI_GROUP, i, bundles);
    finish(bundles);
}

/* ---- Walking -------------------------------------------------------------------------------- */

/* The bound, a sphere or the box of any other, grown by as much as the bundles are wide where their
 * rays can be inside it. */
static spt_bound grown_bound(const spti_bundles *bundles, const spt_bound *bound) {
    const int ball = bound->kind == SPT_BOUND_SPHERE;
    float square = 0.0f;
    spt_bound grown = *bound;
    if (!ball) {
        grown.kind = SPT_BOUND_BOX;
        grown.radius = 0.0f;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const float low = ball ? bound->center[axis] - bound->radius : bound->low[axis];
        const float high = ball ? bound->center[axis] + bound->radius : bound->high[axis];
        const float far =
            at_least(high - bundles->origin_low[axis], bundles->origin_high[axis] - low);
        square += far * far;
    }
    const float farthest = sqrtf(square) + bundles->widest_beta;
    const float width = (bundles->widest_beta + bundles->widest_alpha * farthest) * 1.00001f;
    grown.radius += width;
    for (int axis = 0; axis < 3; ++axis) { /* and what these sums are rounded by */
        grown.low[axis] -= width + SPTI_FLOOR * (fabsf(grown.low[axis]) + width);
        grown.high[axis] += width + SPTI_FLOOR * (fabsf(grown.high[axis]) + width);
    }
    return grown;
}

/* No ray of a length near 1 is traced beyond (prepare_kernel.h). */
static float last_t(float t_max) {
    return t_max < FLT_MAX / 4 ? t_max : FLT_MAX / 4;
}

/* Where each bundle is to begin: at t, and not before its component's bound. */
static void begin_walk(const spti_bundles *bundles, const spti_call *call, const float *t,
                       spti_walk *walk) {
    walk->bound = call->march.bound;
    for (size_t i = 0; i < SPTI_BUNDLES; ++i) {
        walk->t[i] = at_least(t[i], bundles->t_min[i]);
        walk->t_out[i] = last_t(bundles->t_max[i]);
    }
    if (walk->bound != NULL && bundles->usable != 0) {
        const spt_bound grown = grown_bound(bundles, walk->bound);
        if (spti_finite(grown.radius) && spti_finite(grown.low[0]) && spti_finite(grown.high[0])) {
            spti_cone_kernels_of[call->isa]->enter(bundles, &grown, walk);
        }
    }
}

static void ask(const spti_call *call, spti_walk *walk, unsigned walking) {
    if (call->field.batch != NULL) {
        call->field.batch(call->field.user, SPTI_BUNDLES, walk->x, walk->y, walk->z,
                          walk->distance);
        return;
    }
    for (size_t i = 0; i < SPTI_BUNDLES; ++i) {
        walk->distance[i] = walking >> i & 1 ? call->field.point(call->field.user, walk->x[i],
                                                                 walk->y[i], walk->z[i])
                                             : 0.0f;
    }
}

void spti_bundles_enter(const spti_bundles *bundles, const spti_call *call, float t[SPTI_BUNDLES]) {
    spti_walk walk;
    begin_walk(bundles, call, t, &walk);
    for (size_t i = 0; i < SPTI_BUNDLES; ++i) {
        if (bundles->usable >> i & 1) t[i] = walk.t[i];
    }
}

static unsigned count_bits(unsigned bits) {
    unsigned count = 0;
    for (unsigned i = 0; i < SPTI_BUNDLES; ++i) count += bits >> i & 1;
    return count;
}

uint64_t spti_bundles_walk(const spti_bundles *bundles, const spti_call *call, uint32_t steps,
                           float t[SPTI_BUNDLES], int *more) {
    const spti_cone_kernels *const kernels = spti_cone_kernels_of[call->isa];
    spti_walk walk;
    uint64_t evaluations = 0;
    unsigned walking = 0;
    begin_walk(bundles, call, t, &walk);
    walk.epsilon = call->march.epsilon;
    walk.pixel_radius = call->march.pixel_radius;
    walk.inverse_lipschitz = call->march.inverse_lipschitz;
    walk.floor_of_size = SPTI_FLOOR * call->march.size;
    walk.convex = (call->field.flags & SPT_FIELD_CONVEX) != 0;
    for (size_t i = 0; i < SPTI_BUNDLES; ++i) {
        const int walks = (bundles->usable >> i & 1) && walk.t[i] <= walk.t_out[i];
        walk.walks[i] = walks ? 1.0f : 0.0f;
        walk.old[i] = INFINITY; /* no sample before */
        walk.t_old[i] = 0.0f;
        walking |= (unsigned)walks << i;
        if (bundles->usable >> i & 1 && !walks) walk.t[i] = INFINITY;
    }
    for (uint32_t step = 0; walking != 0 && step < steps; ++step) {
        kernels->points(bundles, walking, &walk);
        ask(call, &walk, walking);
        evaluations += count_bits(walking);
        walking = kernels->advance(bundles, &walk);
    }
    *more = walking != 0;
    for (size_t i = 0; i < SPTI_BUNDLES; ++i) {
        if (bundles->usable >> i & 1) t[i] = walk.t[i];
    }
    return evaluations;
}
