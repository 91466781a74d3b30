/* SPDX-License-Identifier: MIT
 *
 * Models level by level: each map is chosen so that what it makes of its level lies on x < 0. */
#include "moekrs_model.h"
#include "../check.h"

#include <math.h>
#include <string.h>

/* ---- Instances ----------------------------------------------------------------------------- */

static moekrs_region kernel_region(const spt_kernel *kernel) {
    const double a[3] = {(double)kernel->a[0], (double)kernel->a[1], (double)kernel->a[2]};
    return kernel->kind == SPT_KERNEL_SPHERE ? moekrs_ball(a, (double)kernel->radius)
                                             : moekrs_half_space(a, (double)kernel->radius);
}

static void add_kernel(moekrs_model *model, int kernel) {
    moekrs_instance *instance = &model->instance[model->count];
    if (model->kernels[kernel].kind == SPT_KERNEL_EMPTY) return;
    instance->region = kernel_region(&model->kernels[kernel]);
    instance->kernel = kernel;
    instance->mirrors = 0;
    ++model->count;
}

/* Level i before its map: L_i, its image in x = 0, and K_(i+1). */
static void join_level(moekrs_model *model, int i) {
    const int count = model->count;
    if ((model->unmirrored >> i & 1) == 0) {
        for (int k = 0; k < count; ++k) {
            moekrs_instance *image = &model->instance[model->count++];
            *image = model->instance[k];
            image->region.center[0] = -image->region.center[0];
            image->mirrors |= UINT64_C(1) << i;
        }
    }
    add_kernel(model, i + 1);
}

static void map_level(moekrs_model *model, const moekrs_chain *chain) {
    for (int k = 0; k < model->count; ++k) {
        model->instance[k].region = moekrs_map_region(chain, &model->instance[k].region);
    }
}

/* How far right L_i reaches; +infinity where it has no end. */
static wide rightmost(const moekrs_model *model) {
    wide most = -HUGE_VALL;
    for (int k = 0; k < model->count; ++k) {
        const moekrs_region *region = &model->instance[k].region;
        const int ball = region->kind == SPT_REGION_BALL;
        const wide x = ball ? region->center[0] + region->radius
                       : region->kind == SPT_REGION_HALF_SPACE && region->center[0] >= 1
                           ? region->radius
                           : HUGE_VALL;
        if (x > most) most = x;
    }
    return most;
}

/* The middle and half diagonal of the box around all instances, or around the balls that outsides
 * leave free. */
static void measure(moekrs_model *model) {
    wide low[3] = {HUGE_VALL, HUGE_VALL, HUGE_VALL}, high[3], half[3];
    for (int axis = 0; axis < 3; ++axis) high[axis] = -HUGE_VALL;
    for (int k = 0; k < model->count; ++k) {
        const moekrs_region *region = &model->instance[k].region;
        if (region->kind == SPT_REGION_HALF_SPACE) continue;
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = fminl(low[axis], region->center[axis] - region->radius);
            high[axis] = fmaxl(high[axis], region->center[axis] + region->radius);
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        const int any = low[axis] <= high[axis];
        half[axis] = any ? (high[axis] - low[axis]) / 2 : 1;
        model->middle[axis] = any ? (double)((high[axis] + low[axis]) / 2) : 0;
    }
    model->reach = (double)moekrs_length(half);
}

static void finish(moekrs_model *model) {
    for (int i = 0; i < model->levels; ++i) {
        model->undone[i] = moekrs_undone(&model->chain[i]);
        model->maps[i] = moekrs_library_map(&model->chain[i]);
    }
    for (int k = 0; k < model->count; ++k) {
        moekrs_instance *instance = &model->instance[k];
        instance->radius = (double)instance->region.radius;
        for (int axis = 0; axis < 3; ++axis) {
            instance->center[axis] = (double)instance->region.center[axis];
        }
    }
    measure(model);
}

int moekrs_expand(moekrs_model *model) {
    int apart = 1;
    model->count = 0;
    add_kernel(model, 0);
    for (int i = 0; i < model->levels; ++i) {
        if ((model->unmirrored >> i & 1) == 0 && !(rightmost(model) < 0)) apart = 0;
        join_level(model, i);
        map_level(model, &model->chain[i]);
    }
    finish(model);
    return apart;
}

/* ---- Drawing ------------------------------------------------------------------------------- */

static wide least_gap(const moekrs_model *model, const double p[3], int absolute) {
    const wide at[3] = {(wide)p[0], (wide)p[1], (wide)p[2]};
    wide least = HUGE_VALL;
    for (int k = 0; k < model->count; ++k) {
        const wide gap = moekrs_region_distance(&model->instance[k].region, at);
        least = fminl(least, absolute ? fabsl(gap) : gap);
    }
    return least;
}

/* Appends a step to the map of level i, and takes it. */
static void take(moekrs_model *model, int i, moekrs_step_kind kind, const double vector[3],
                 double number) {
    moekrs_chain alone;
    alone.count = 0;
    moekrs_append(&alone, kind, vector, number);
    moekrs_append(&model->chain[i], kind, vector, number);
    map_level(model, &alone);
}

static void random_vector(double v[3], double most) {
    for (int axis = 0; axis < 3; ++axis) v[axis] = check_uniform(-most, most);
}

/* An inversion whose centre is clear of all surfaces: outside, or inside the largest instance. */
static void take_inversion(moekrs_model *model, int i, int inside) {
    double center[3];
    int largest = 0;
    measure(model);
    for (int k = 0; k < model->count; ++k) {
        if (model->instance[k].region.radius > model->instance[largest].region.radius) largest = k;
    }
    for (int tries = 0; tries < 400; ++tries) {
        const moekrs_region *around = &model->instance[largest].region;
        const double clear = inside ? 0.2 * (double)around->radius : 0.15 * model->reach;
        random_vector(center, inside ? 0.5 * (double)around->radius : model->reach);
        for (int axis = 0; axis < 3; ++axis) {
            center[axis] += inside ? (double)around->center[axis] : model->middle[axis];
        }
        if (!((double)least_gap(model, center, inside) >= clear)) continue;
        if (inside &&
            moekrs_region_distance(
                around, (const wide[3]){(wide)center[0], (wide)center[1], (wide)center[2]}) > 0) {
            continue;
        }
        take(model, i, MOEKRS_INVERSION, center, check_uniform(0.5, 2) * model->reach);
        return;
    }
}

/* Brings a level to a size near 1 and to x < 0. */
static void take_place(moekrs_model *model, int i, moekrs_flavour flavour) {
    double by[3], factor;
    measure(model);
    factor = check_uniform(0.7, 2) / model->reach;
    take(model, i, MOEKRS_DILATION, NULL, check_random() % 4 == 0 ? -factor : factor);
    measure(model);
    random_vector(by, 0.3);
    for (int axis = 0; axis < 3; ++axis) by[axis] -= model->middle[axis];
    if (flavour != MOEKRS_CUT && i + 1 < model->levels) {
        by[0] = -check_uniform(0.01, 0.4) - (double)rightmost(model);
    }
    take(model, i, MOEKRS_TRANSLATION, by, 0);
}

static void draw_kernels(moekrs_model *model, moekrs_flavour flavour) {
    for (int i = 0; i <= model->levels; ++i) {
        const float radius = (float)check_uniform(0.05, 0.5);
        double center[3];
        random_vector(center, 1.5);
        if (i == 0 && flavour != MOEKRS_CUT) {
            center[0] = -(double)radius - check_uniform(0.02, 0.6);
        }
        model->kernels[i] =
            spt_kernel_sphere((float)center[0], (float)center[1], (float)center[2], radius);
        if (i > 0 && check_random() % 6 == 0) model->kernels[i] = spt_kernel_empty();
    }
    if (flavour != MOEKRS_PLANES) return;
    model->kernels[0] = spt_kernel_half_space(2, 0, 0, (float)check_uniform(-2, -1));
    model->kernels[1] = spt_kernel_empty();
}

void moekrs_draw(moekrs_model *model, int levels, moekrs_flavour flavour, uint64_t unmirrored) {
    memset(model, 0, sizeof *model);
    model->levels = levels;
    model->unmirrored = unmirrored;
    draw_kernels(model, flavour);
    add_kernel(model, 0);
    for (int i = 0; i < levels; ++i) {
        const int last = i == levels - 1 && flavour == MOEKRS_INSIDE_OUT;
        const int plane = i == 0 && flavour == MOEKRS_PLANES;
        double axis[3];
        join_level(model, i);
        random_vector(axis, 1);
        if (!plane) take(model, i, MOEKRS_ROTATION, axis, check_uniform(-3, 3));
        if (flavour != MOEKRS_SIMILAR && (last || plane || check_random() % 10 < 7)) {
            take_inversion(model, i, last);
        }
        if (check_random() % 4 == 0) {
            const double mirror[3] = {0.6, 0, 0.8};
            take(model, i, MOEKRS_REFLECTION, mirror, check_uniform(-1, 1));
        }
        take_place(model, i, flavour);
    }
    CHECK(moekrs_expand(model) || flavour == MOEKRS_CUT);
}

static double random_direction(double at[3]) {
    double length;
    do {
        random_vector(at, 1);
        length = sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
    } while (!(length <= 1 && length > 0.01));
    return length;
}

void moekrs_somewhere(const moekrs_model *model, float p[3]) {
    double at[3];
    random_direction(at);
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = (float)(model->middle[axis] + 1.5 * model->reach * at[axis]);
    }
}

void moekrs_point(const moekrs_model *model, float p[3]) {
    const moekrs_instance *near = &model->instance[check_random() % (uint32_t)model->count];
    const double sign = near->region.kind == SPT_REGION_BALL ? 1 : -1;
    const double away = sign * near->radius * pow(10, check_uniform(-2.5, 0));
    double at[3], size;
    moekrs_somewhere(model, p);
    if (near->region.kind == SPT_REGION_HALF_SPACE || check_random() % 2 == 0) return;
    size = random_direction(at);
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = (float)(near->center[axis] + at[axis] / size * (near->radius + away));
    }
}
