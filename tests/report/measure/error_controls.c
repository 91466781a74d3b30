/* SPDX-License-Identifier: MIT
 *
 * Controls on the same rays, one ray at a time and a callback for one point: the papers' listings
 * as they are printed, a plain loop, and the scalar loops that the driver is raced against, which
 * have the distance inlined and promise what the library does. */
#include "error_runs.h"

#include <math.h>
#include <stdlib.h>

#include "../../oracle/listings.h"

typedef struct control_own {
    spt_field field;
    spt_settings settings;
    float inverse_lipschitz, pixel_radius;
    scalar_trace_fn *trace;
    bench_hit *hits;
} control_own;

/* One ray by a listing or loop; returns t. *limit: set where it says that its budget ended, which
 * no listing does. */
typedef float control_fn(const control_own *own, listing *in, const spt_ray *ray, int *limit);

typedef struct control_way {
    const char *name;
    control_fn *ray;
} control_way;

/* The listings take a field whose Lipschitz constant is 1. */
static float distance_at(void *user, float x, float y, float z) {
    const control_own *const own = user;
    return own->field.point(own->field.user, x, y, z) * own->inverse_lipschitz;
}

static float listing_1(const control_own *own, listing *in, const spt_ray *ray, int *limit) {
    (void)limit;
    return keinert_listing_1(in, ray->t_min, ray->t_max, own->settings.epsilon);
}

/* omega as it stands in the listing, and nothing forced where nothing is near. */
static float listing_2(const control_own *own, listing *in, const spt_ray *ray, int *limit) {
    (void)limit;
    return keinert_listing_2(in, ray->t_min, ray->t_max, 1.2f, own->pixel_radius, 0);
}

static float algorithm_1(const control_own *own, listing *in, const spt_ray *ray, int *limit) {
    (void)ray, (void)limit;
    return balint_algorithm_1(in, own->settings.epsilon);
}

/* 0.2: Keinert's 1.2 in the sense of this listing. */
static float algorithm_2(const control_own *own, listing *in, const spt_ray *ray, int *limit) {
    (void)ray, (void)limit;
    return balint_algorithm_2(in, own->settings.epsilon, 0.2f);
}

static float algorithm_3(const control_own *own, listing *in, const spt_ray *ray, int *limit) {
    (void)ray, (void)limit;
    return balint_algorithm_3(in, own->settings.epsilon, 0.88f);
}

/* The loop of a textbook. */
static float plain_loop(const control_own *own, listing *in, const spt_ray *ray, int *limit) {
    float t = ray->t_min;
    while (in->evaluations < own->settings.budget) {
        ++in->evaluations;
        const float radius = in->distance(in->user, ray->origin[0] + t * ray->direction[0],
                                          ray->origin[1] + t * ray->direction[1],
                                          ray->origin[2] + t * ray->direction[2]);
        if (radius < own->settings.epsilon) return t;
        t += radius;
        if (t > ray->t_max) return INFINITY;
    }
    *limit = 1;
    return t;
}

static const control_way ways[] = {
    {"keinert_listing_1", listing_1},    {"keinert_listing_2", listing_2},
    {"balint_algorithm_1", algorithm_1}, {"balint_algorithm_2", algorithm_2},
    {"balint_algorithm_3", algorithm_3}, {"plain_scalar", plain_loop}};
enum { WAYS = sizeof ways / sizeof ways[0] };

/* What an answer means to its caller: a t on the ray is a hit, anything else is none. */
static spt_outcome outcome_of(float t, int limit, const spt_ray *ray) {
    if (limit) return SPT_LIMIT;
    if (isnan(t)) return SPT_NONFINITE;
    return ray->t_min <= t && t <= ray->t_max ? SPT_HIT : SPT_MISS;
}

static double run_listing(error_runner *runner, const error_scene *in, int all) {
    const control_way *const way = runner->way;
    control_own *const own = runner->own;
    (void)all;
    const double before = bench_seconds();
    for (size_t i = 0; i < in->count; ++i) {
        const spt_ray *const ray = &in->picture->rays[i];
        listing traced = {distance_at, own, {0, 0, 0}, {0, 0, 0}, (int)runner->budget, 0};
        for (int axis = 0; axis < 3; ++axis) {
            traced.origin[axis] = ray->origin[axis];
            traced.direction[axis] = ray->direction[axis];
        }
        int limit = 0;
        spt_hit *const hit = &in->hits[i];
        hit->t = way->ray(own, &traced, ray, &limit);
        hit->outcome = (int32_t)outcome_of(hit->t, limit, ray);
        hit->evaluations = traced.evaluations;
    }
    return bench_seconds() - before;
}

static double run_scalar(error_runner *runner, const error_scene *in, int all) {
    control_own *const own = runner->own;
    const double before = bench_seconds();
    own->trace(&own->field, &own->settings, in->count, in->picture->rays, own->hits);
    const double seconds = bench_seconds() - before;
    for (size_t i = 0; all && i < in->count; ++i) {
        in->hits[i].t = own->hits[i].t;
        in->hits[i].outcome = own->hits[i].outcome;
        in->hits[i].evaluations = own->hits[i].evaluations;
    }
    return seconds;
}

static void close_control(error_runner *runner) {
    control_own *const own = runner->own;
    free(own->hits);
    free(own);
}

static error_runner open_control(const error_scene *in, const char *name, uint32_t budget) {
    control_own *const own = report_allocate(sizeof *own);
    error_runner runner = {name, 1, budget, in->identity, 0, NULL, close_control, NULL, own};
    double square = 0;
    own->field = scene_field(in->shown, 0);
    own->settings = in->settings;
    own->settings.budget = budget;
    own->inverse_lipschitz = 1 / in->shown->lipschitz;
    /* Listing 2 stops by f / t: where the camera looks at, that is the stop of the others. */
    for (int axis = 0; axis < 3; ++axis) {
        const double apart = in->shown->target[axis] - in->shown->eye[axis];
        square += apart * apart;
    }
    own->pixel_radius = in->settings.epsilon / (float)sqrt(square);
    return runner;
}

static int add_scalar(error_runner *runners, const error_scene *in, const char *name,
                      const char *rule, uint32_t budget) {
    scalar_trace_fn *const trace = scalar_loop_of(in->shown->name, rule);
    if (trace == NULL) return 0;
    runners[0] = open_control(in, name, budget);
    control_own *const own = runners[0].own;
    own->trace = trace;
    own->hits = report_allocate(in->count * sizeof *own->hits);
    runners[0].run = run_scalar;
    return 1;
}

int error_controls(error_runner *runners, const error_scene *in, uint32_t budget) {
    int count = 0;
    for (int i = 0; i < WAYS; ++i) {
        runners[count] = open_control(in, ways[i].name, budget);
        runners[count].way = &ways[i];
        runners[count++].run = run_listing;
    }
    count += add_scalar(runners + count, in, "scalar_basic", "basic", budget);
    count += add_scalar(runners + count, in, "scalar_adaptive", "adaptive", budget);
    return count;
}
