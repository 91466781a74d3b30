/* SPDX-License-Identifier: MIT
 *
 * Models level by level: each map is chosen so that what it makes of its level is about as large as
 * before and lies on x < 0. */
#include "accuracy_levels.h"

#include <math.h>

static void add_kernel(level_model *model, int kernel) {
    const spt_kernel *const from = &model->kernels[kernel];
    level_instance *one;
    if (from->kind == SPT_KERNEL_EMPTY) return;
    report_expect(model->count < level_instances, "a model has too many instances");
    one = &model->instance[model->count++];
    one->ball.kind = SPT_REGION_BALL;
    for (int axis = 0; axis < 3; ++axis) one->ball.center[axis] = (extended)from->a[axis];
    one->ball.radius = (extended)from->radius;
    one->kernel = kernel;
    one->mirrors = 0;
}

/* L_i becomes what level i maps: with its image in x = 0, and K_(i+1). */
static void join(level_model *model, int i) {
    const int count = model->count;
    if ((model->unmirrored >> i & 1) == 0) {
        report_expect(2 * count <= level_instances, "a model has too many instances");
        for (int k = 0; k < count; ++k) {
            level_instance *const image = &model->instance[model->count++];
            *image = model->instance[k];
            image->ball.center[0] = -image->ball.center[0];
            image->mirrors |= UINT64_C(1) << i;
        }
    }
    add_kernel(model, i + 1);
}

/* The middle of the box around all instances, and how far they reach from it. */
static void measure(level_model *model) {
    extended low[3] = {HUGE_VALL, HUGE_VALL, HUGE_VALL}, high[3];
    for (int axis = 0; axis < 3; ++axis) high[axis] = -HUGE_VALL;
    for (int k = 0; k < model->count; ++k) {
        const solid *const ball = &model->instance[k].ball;
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = fminl(low[axis], ball->center[axis] - ball->radius);
            high[axis] = fmaxl(high[axis], ball->center[axis] + ball->radius);
        }
    }
    for (int axis = 0; axis < 3; ++axis) model->middle[axis] = (low[axis] + high[axis]) / 2;
    model->reach = 0;
    for (int k = 0; k < model->count; ++k) {
        const solid *const ball = &model->instance[k].ball;
        const extended far = extended_distance(ball->center, model->middle) + ball->radius;
        model->reach = fmaxl(model->reach, far);
    }
}

static void take(level_model *model, int i, const chain_step *step) {
    chain single;
    single.count = 1;
    single.steps[0] = *step;
    model->map[i].steps[model->map[i].count++] = *step;
    for (int k = 0; k < model->count; ++k)
        model->instance[k].ball = chain_solid(&single, 0, model->instance[k].ball);
    measure(model);
}

/* A turn, an inversion in a sphere whose center is outside of all, most of the time, a reflection
 * now and then, and back to a size near 1 and to x < 0. */
static void draw_map(report_random *random, level_model *model, int i) {
    chain_step step = {CHAIN_ROTATION, {0, 0, 0}, 0};
    accuracy_unit(random, step.vector);
    step.number = report_uniform(random, -3, 3);
    model->map[i].count = 0;
    measure(model);
    take(model, i, &step);
    if (report_bits(random) % 10 < 7) {
        const double reach = (double)model->reach, away = reach * report_uniform(random, 1.3, 3);
        step.kind = CHAIN_INVERSION;
        accuracy_unit(random, step.vector);
        for (int axis = 0; axis < 3; ++axis)
            step.vector[axis] = (double)model->middle[axis] + away * step.vector[axis];
        step.number = reach * report_uniform(random, 0.7, 2);
        take(model, i, &step);
    }
    if (report_bits(random) % 4 == 0) {
        step.kind = CHAIN_REFLECTION;
        accuracy_unit(random, step.vector);
        step.number = report_uniform(random, -1, 1);
        take(model, i, &step);
    }
    step.kind = CHAIN_DILATION;
    step.number = report_uniform(random, 0.7, 2) / (double)model->reach;
    take(model, i, &step);
    step.kind = CHAIN_TRANSLATION;
    for (int axis = 0; axis < 3; ++axis)
        step.vector[axis] = report_uniform(random, -0.3, 0.3) - (double)model->middle[axis];
    step.vector[0] -= 0.5 + (double)model->reach;
    take(model, i, &step);
}

static void draw_kernels(report_random *random, level_model *model, int only_first) {
    for (int i = 0; i <= model->levels; ++i) {
        const float radius = (float)report_uniform(random, 0.1, 0.5);
        float center[3];
        for (int axis = 0; axis < 3; ++axis)
            center[axis] = (float)report_uniform(random, -1.5, 1.5);
        if (i == 0) center[0] = -radius - (float)report_uniform(random, 0.02, 0.6);
        model->kernels[i] = i > 0 && (only_first || report_bits(random) % 2 == 0)
                                ? spt_kernel_empty()
                                : spt_kernel_sphere(center[0], center[1], center[2], radius);
    }
}

void level_draw(report_random *random, level_model *model, int levels, int only_first) {
    int mirrors = 0;
    model->levels = levels;
    model->unmirrored = 0;
    model->count = 0;
    for (int i = levels - 1; i >= 0; --i) {
        /* of the levels that are left, so many that all together are about level_mirrors */
        if ((int)(report_bits(random) % (uint32_t)levels) < level_mirrors &&
            mirrors < level_mirrors) {
            ++mirrors;
        } else {
            model->unmirrored |= UINT64_C(1) << i;
        }
    }
    draw_kernels(random, model, only_first);
    add_kernel(model, 0);
    for (int i = 0; i < levels; ++i) {
        join(model, i);
        draw_map(random, model, i);
        model->maps[i] = chain_build(&model->map[i]);
    }
    measure(model);
}

void level_build(const level_model *model, spt_moekrs *built) {
    spt_moekrs_model description = spt_moekrs_model_default();
    description.levels = (uint32_t)model->levels;
    description.kernels = model->kernels;
    description.maps = model->maps;
    description.unmirrored = model->unmirrored;
    report_expect(spt_moekrs_build(&description, built) == SPT_OK, "a model is refused");
}

void level_follow(const level_model *model, place p, level_way *way) {
    extended scale = 1; /* of the world's lengths in those of the level */
    way->at[model->levels] = p;
    way->seen = extended_length(p.at);
    way->nearest = HUGE_VALL;
    way->mirrors = 0;
    for (int i = model->levels - 1; i >= 0; --i) {
        scale *= chain_scale(&model->map[i], 1, p);
        p = chain_image(&model->map[i], 1, p);
        way->seen = fmaxl(way->seen, extended_length(p.at) / scale);
        if ((model->unmirrored >> i & 1) == 0) {
            way->nearest = fminl(way->nearest, fabsl(p.at[0]));
            if (p.at[0] > 0) way->mirrors |= UINT64_C(1) << i;
            p.at[0] = -fabsl(p.at[0]);
        }
        way->at[i] = p;
    }
    way->scale = 1 / scale;
}

extended level_distance(const level_model *model, const place *p) {
    extended least = HUGE_VALL;
    for (int k = 0; k < model->count; ++k)
        least = fminl(least, solid_distance(&model->instance[k].ball, p->at));
    return least;
}

void level_somewhere(report_random *random, const level_model *model, float p[3]) {
    double out[3];
    const double far = 1.5 * (double)model->reach * cbrt(report_uniform(random, 0, 1));
    accuracy_unit(random, out);
    for (int axis = 0; axis < 3; ++axis)
        p[axis] = (float)((double)model->middle[axis] + far * out[axis]);
}

void level_near(report_random *random, const level_model *model, float p[3]) {
    const level_instance *const one =
        &model->instance[report_bits(random) % (uint32_t)model->count];
    const double radius = (double)one->ball.radius * (1 + accuracy_spread(random, 1e-5, 1));
    double out[3];
    accuracy_unit(random, out);
    for (int axis = 0; axis < 3; ++axis)
        p[axis] = (float)((double)one->ball.center[axis] + radius * out[axis]);
}

place level_place(const float p[3]) {
    const double at[3] = {(double)p[0], (double)p[1], (double)p[2]};
    return place_of(at);
}
