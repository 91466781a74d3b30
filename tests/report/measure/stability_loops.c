/* SPDX-License-Identifier: MIT
 *
 * stability_loops.csv: controls. The papers' listings as they are printed, and the loop of a
 * textbook, over the families that are distance bounds, with the same rays and the same judge: what
 * margins, the rounding floor and an honest end of the budget are for. */
#include <math.h>
#include <stdlib.h>

#include "stability_judge.h"

#include "../../oracle/listings.h"

/* Padding repeats the point, as the library's does. */
static float ask(void *user, float x, float y, float z) {
    const stability_world *const world = user;
    float aligned[4 * 16 + 16];
    float *const first = aligned + (64 - ((uintptr_t)aligned & 63)) % 64 / sizeof *aligned;
    for (int i = 0; i < 16; ++i) {
        first[i] = x;
        first[16 + i] = y;
        first[32 + i] = z;
    }
    world->field.batch(world->field.user, 16, first, first + 16, first + 32, first + 48);
    return first[48] / world->field.lipschitz;
}

/* One ray by a loop; returns t. *limit: set where the loop says that its budget ended. */
typedef float loop_fn(const stability_world *world, listing *in, const spt_ray *ray, int *limit);

static float textbook(const stability_world *world, listing *in, const spt_ray *ray, int *limit) {
    float t = ray->t_min;
    while (in->evaluations < world->settings.budget) {
        ++in->evaluations;
        const float radius = in->distance(in->user, ray->origin[0] + t * ray->direction[0],
                                          ray->origin[1] + t * ray->direction[1],
                                          ray->origin[2] + t * ray->direction[2]);
        if (radius < world->settings.epsilon) return t;
        t += radius;
        if (t > ray->t_max) return INFINITY;
    }
    *limit = 1;
    return t;
}

static float listing_1(const stability_world *world, listing *in, const spt_ray *ray, int *limit) {
    (void)limit;
    return keinert_listing_1(in, ray->t_min, ray->t_max, world->settings.epsilon);
}

/* 0.2: what Keinert's 1.2 is in the sense of this algorithm. */
static float algorithm_2(const stability_world *world, listing *in, const spt_ray *ray,
                         int *limit) {
    (void)ray, (void)limit;
    return balint_algorithm_2(in, world->settings.epsilon, 0.2f);
}

static float algorithm_3(const stability_world *world, listing *in, const spt_ray *ray,
                         int *limit) {
    (void)ray, (void)limit;
    return balint_algorithm_3(in, world->settings.epsilon, 0.88f);
}

static const struct {
    const char *name;
    loop_fn *ray;
} loops[] = {{"textbook", textbook},
             {"keinert_listing_1", listing_1},
             {"balint_algorithm_2", algorithm_2},
             {"balint_algorithm_3", algorithm_3}};
enum { loop_count = sizeof loops / sizeof loops[0] };

/* What an answer means to its caller: a t on the ray is a hit, anything else is none. */
static spt_hit hit_of(float t, int limit, const spt_ray *ray, uint32_t evaluations) {
    spt_hit hit = {t, 0, SPT_MISS, evaluations, 0, 0, 0, 0, 0};
    if (limit) {
        hit.outcome = SPT_LIMIT;
    } else if (isnan(t)) {
        hit.outcome = SPT_NONFINITE;
    } else if (ray->t_min <= t && t <= ray->t_max) {
        hit.outcome = SPT_HIT;
    }
    return hit;
}

static void run(int loop, stability_world *world, const stability_sample *sample) {
    for (size_t i = 0; i < sample->count; ++i) {
        const spt_ray *const ray = &sample->rays[i];
        listing in = {ask, world, {0, 0, 0}, {0, 0, 0}, (int)world->settings.budget, 0};
        int limit = 0;
        for (int axis = 0; axis < 3; ++axis) {
            in.origin[axis] = ray->origin[axis];
            in.direction[axis] = ray->direction[axis];
        }
        const float t = loops[loop].ray(world, &in, ray, &limit);
        sample->hits[i] = hit_of(t, limit, ray, in.evaluations);
    }
}

static int cells(const report_options *options) {
    (void)options;
    return stability_family_count;
}

static void measure(const report_options *options, int family, FILE *rows) {
    const stability_family *const swept = stability_families[family];
    if (!swept->bound) return;
    /* one point at a time, padded: a tenth of the rays */
    stability_sample sample = stability_sample_of(stability_ray_count(options) / 10);
    for (int i = 0; i < stability_value_count(options, family); ++i) {
        const double value = stability_value(options, family, i);
        stability_world world;
        stability_draw(family, value, &world, &sample);
        /* the listings know no bounding volume, outside of which a field may be none */
        for (int loop = 0; world.field.bound == NULL && loop < loop_count; ++loop) {
            run(loop, &world, &sample);
            const stability_tally sum = stability_judge(&world, &sample);
            fprintf(rows, "%s,%s,%.9g,%s,%d,%d,%d,%d,%d,%d,%.9g\n", swept->name, swept->parameter,
                    value, loops[loop].name, (int)sample.count, sum.wrong, sum.lost, sum.ghosts,
                    sum.undecided, sum.nonfinite,
                    report_quantile(sample.evaluations, sample.count, 0.99));
        }
        free(world.memory);
    }
    stability_sample_free(&sample);
}

const report_part report_stability_loops = {"stability_loops",
                                            "family,parameter,value,loop,rays,wrong,lost,ghosts,"
                                            "undecided,nonfinite,evaluations_99",
                                            cells,
                                            measure,
                                            0,
                                            {8, 0.5}};
