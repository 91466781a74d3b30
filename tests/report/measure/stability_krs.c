/* SPDX-License-Identifier: MIT
 *
 * Kernel-reflection sequences from 2 to 64 levels deep, mirrors at random and through their levels,
 * so that all of them fold. The truth is the same fold in double (Szecsi et al. 2016, Algorithm 1),
 * whose distance has slope 1. */
#include <math.h>

#include <spheretrace/krs.h>

#include "stability.h"

typedef struct krs_memory {
    spt_krs krs;
    uint32_t levels;
    double normal[SPT_KRS_LEVELS][3], offset[SPT_KRS_LEVELS];
    double center[SPT_KRS_LEVELS + 1][3], radius[SPT_KRS_LEVELS + 1]; /* radius 0: empty */
} krs_memory;

static void krs_kernel(const krs_memory *model, uint32_t i, const double p[3], double *least) {
    const double from[3] = {p[0] - model->center[i][0], p[1] - model->center[i][1],
                            p[2] - model->center[i][2]};
    if (model->radius[i] > 0) *least = fmin(*least, stability_length(from) - model->radius[i]);
}

static double krs_value(const stability_world *world, const double p[3]) {
    const krs_memory *const model = world->memory;
    double at[3] = {p[0], p[1], p[2]}, least = HUGE_VAL;
    krs_kernel(model, model->levels, at, &least);
    for (uint32_t i = model->levels; i-- > 0;) {
        const double *const normal = model->normal[i];
        const double beyond = fmax(stability_dot(normal, at) - model->offset[i], 0);
        for (int axis = 0; axis < 3; ++axis) at[axis] -= 2 * beyond * normal[axis];
        krs_kernel(model, i, at, &least);
    }
    return least;
}

/* A number of a model is the float that the library is given. */
static float draw(report_random *random, double low, double high, double *kept) {
    const float number = (float)report_uniform(random, low, high);
    *kept = (double)number;
    return number;
}

/* Each mirror moves images by at most twice its offset: offsets shrink with the number of mirrors,
 * so that models of every depth have about the same size. */
static spt_mirror draw_mirror(report_random *random, krs_memory *model, uint32_t i) {
    const double most = 0.8 / (2.0 + model->levels);
    spt_mirror mirror;
    double *const normal = model->normal[i];
    do {
        for (int axis = 0; axis < 3; ++axis)
            mirror.normal[axis] = draw(random, -1, 1, &normal[axis]);
    } while (!(stability_length(normal) > 0.2 && stability_length(normal) <= 1));
    const double length = stability_length(normal);
    mirror.offset = draw(random, 0.2 * most, most, &model->offset[i]);
    for (int axis = 0; axis < 3; ++axis) normal[axis] /= length;
    model->offset[i] /= length;
    return mirror;
}

static spt_kernel draw_ball(report_random *random, krs_memory *model, uint32_t i, double reach,
                            double low, double high) {
    double *const center = model->center[i];
    const float x = draw(random, -reach, reach, &center[0]);
    const float y = draw(random, -reach, reach, &center[1]);
    const float z = draw(random, -reach, reach, &center[2]);
    return spt_kernel_sphere(x, y, z, draw(random, low, high, &model->radius[i]));
}

static void krs_build(stability_world *world, double value) {
    spt_kernel kernels[SPT_KRS_LEVELS + 1];
    spt_mirror mirrors[SPT_KRS_LEVELS];
    krs_memory *const model = report_allocate(sizeof *model);
    report_random random = {77};
    double reach = 1;
    stability_begin(world, krs_value);
    model->levels = (uint32_t)value;
    for (uint32_t i = 0; i < model->levels; ++i) {
        mirrors[i] = draw_mirror(&random, model, i);
        reach = fmax(reach, fabs(model->offset[i]));
    }
    /* one kernel of four is a ball, the leaf among them */
    for (uint32_t i = 0; i <= model->levels; ++i) {
        kernels[i] = i % 4 == 0 ? draw_ball(&random, model, i, 0.5, 0.1, 0.25) : spt_kernel_empty();
    }
    spt_krs_model described = spt_krs_model_default();
    described.levels = model->levels;
    described.kernels = kernels;
    described.mirrors = mirrors;
    report_expect(spt_krs_build(&described, &model->krs) == SPT_OK, "a deep model is refused");
    world->memory = model;
    world->field = spt_krs_field(&model->krs);
    /* krs.h: the field is off by 2^-22 (n + 4) of the coordinates, 4u (n + 4); and the position */
    world->units = 3 + 4 * (value + 4);
    world->reach = reach;
}

/* At and around an instance that is drawn: a ball, seen in half of the mirrors above it. */
static void krs_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    const krs_memory *const model = world->memory;
    const uint32_t kernel = report_bits(random) % (model->levels / 4 + 1) * 4;
    const double size = 1.3 * model->radius[kernel];
    double from[3], through[3];
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = report_uniform(random, -0.2, 0.2);
        through[axis] = model->center[kernel][axis] + report_uniform(random, -size, size);
    }
    for (uint32_t i = kernel; i < model->levels; ++i) {
        const double beyond = stability_dot(model->normal[i], through) - model->offset[i];
        if ((report_bits(random) & 1) != 0) continue;
        for (int axis = 0; axis < 3; ++axis) through[axis] -= 2 * beyond * model->normal[i][axis];
    }
    from[2] -= 4;
    stability_aim(ray, from, through, 20);
}

const stability_family stability_krs = {.name = "krs",
                                        .parameter = "levels",
                                        .bound = 1,
                                        .count = 10,
                                        .values = {2, 4, 8, 12, 16, 24, 32, 40, 52, 64},
                                        .build = krs_build,
                                        .ray = krs_ray,
                                        .truth = stability_walk_ray};
