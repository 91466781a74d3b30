/* SPDX-License-Identifier: MIT
 *
 * Random models of kernel-reflection sequences. */
#include "krs_draw.h"
#include "../check.h"

#include <math.h>

static void random_point(double reach, float p[3]) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = (float)check_uniform(-reach, reach);
}

static void random_step(double length, const float from[3], float to[3]) {
    double way[3];
    surface_random_unit(way);
    for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis] + (float)(length * way[axis]);
}

/* The arc's circle is at least as large as its tube: else the inside is only a bound of itself. */
static spt_kernel draw_capsule(void) {
    spt_kernel kernel;
    krs_body body;
    do {
        float a[3], b[3], control[3];
        random_point(0.6, a);
        random_step(check_uniform(0.1, 0.5), a, control);
        random_step(check_uniform(0.1, 0.5), control, b);
        kernel = spt_kernel_capsule(a, b, control, (float)check_uniform(0.01, 0.1));
        body = krs_body_of(&kernel);
    } while (!(body.angle > 0) || body.circle_radius < 2 * body.radius || body.circle_radius > 0.5);
    return kernel;
}

static spt_kernel draw_leaf(void) {
    float tip[3], other[3], any[3], across[3];
    double along[3], unit[3], toward[3];
    random_point(0.6, tip);
    random_step(check_uniform(0.2, 0.8), tip, other);
    random_step(1, tip, any);
    for (int axis = 0; axis < 3; ++axis) {
        along[axis] = (double)other[axis] - (double)tip[axis];
        toward[axis] = (double)any[axis] - (double)tip[axis];
    }
    krs_cross(along, toward, unit);
    for (int axis = 0; axis < 3; ++axis) across[axis] = (float)(3 * unit[axis]);
    const double width = surface_length(along) * check_uniform(0.05, 0.5);
    const double radius = check_uniform(0, 0.05);
    return spt_kernel_leaf(tip, other, across, (float)width, (float)radius);
}

void krs_field_gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                        float *gradient_x, float *gradient_y, float *gradient_z) {
    const reference_field *const field = user;
    float *const out[3] = {gradient_x, gradient_y, gradient_z};
    const double step = 1e-6;
    for (size_t i = 0; i < n; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            double there[3] = {(double)x[i], (double)y[i], (double)z[i]};
            const double here = there[axis];
            there[axis] = here + step;
            const double above = (double)field->distance(field->user, there);
            there[axis] = here - step;
            out[axis][i] =
                (float)((above - (double)field->distance(field->user, there)) / (2 * step));
        }
    }
}

static spt_kernel draw_field(krs_drawn *sample, uint32_t number) {
    analytic_shape torus = analytic_sample(ANALYTIC_TORUS, 1);
    torus.extent = 0.3;
    torus.radius = check_uniform(0.05, 0.15);
    sample->bodies[number] = surface_place_at(torus, 0, 0, 0);
    for (int axis = 0; axis < 3; ++axis)
        sample->bodies[number].center[axis] = check_uniform(-0.3, 0.3);
    surface_turn(&sample->bodies[number]);
    sample->bodies[number].factor = 2;
    sample->references[number] = surface_body_field(&sample->bodies[number]);
    sample->fields[number] = oracle_field(&sample->references[number], 0);
    sample->fields[number].gradient = krs_field_gradient;
    sample->bounds[number] = spt_bound_sphere(0, 0, 0, 1);
    sample->fields[number].bound = &sample->bounds[number];
    return spt_kernel_field(&sample->fields[number]);
}

spt_kernel krs_draw_kernel(krs_drawn *sample, uint32_t number, uint32_t kinds) {
    uint32_t kind;
    float p[3];
    do kind = check_random() % SPT_KERNEL_KINDS;
    while ((kinds >> kind & 1) == 0);
    random_point(0.6, p);
    switch (kind) {
    case SPT_KERNEL_SPHERE:
        return spt_kernel_sphere(p[0], p[1], p[2], (float)check_uniform(0.05, 0.4));
    case SPT_KERNEL_HALF_SPACE:
        return spt_kernel_half_space(p[0], p[1], p[2], (float)check_uniform(-1, 1));
    case SPT_KERNEL_CAPSULE:
        return draw_capsule();
    case SPT_KERNEL_LEAF:
        return draw_leaf();
    case SPT_KERNEL_FIELD:
        return draw_field(sample, number);
    default:
        return spt_kernel_empty();
    }
}

spt_mirror krs_draw_mirror(double offset) {
    spt_mirror mirror;
    double normal[3];
    surface_random_unit(normal);
    for (int axis = 0; axis < 3; ++axis) mirror.normal[axis] = (float)normal[axis];
    mirror.offset = (float)offset;
    return mirror;
}

/* The middle of an instance's ball in the world. Returns 0 for one without. */
static int instance_ball(const krs_expansion *truth, size_t index, double center[3],
                         double *radius) {
    const krs_instance *const one = &truth->instances[index];
    if (!krs_body_ball(&one->body, center, radius)) return 0;
    if (one->body.kind != SPT_KERNEL_FIELD) return 1;
    for (uint32_t i = one->kernel; i < truth->levels; ++i) {
        if ((one->mirrors >> i & 1) != 0) krs_reflect(truth, i, center);
    }
    return 1;
}

/* How far all that stands reaches along a direction, at most and at least. */
static void support(const krs_expansion *truth, const double direction[3], double range[2]) {
    range[0] = HUGE_VAL;
    range[1] = -HUGE_VAL;
    for (size_t i = 0; i < truth->count; ++i) {
        double center[3], radius;
        if (!instance_ball(truth, i, center, &radius)) continue;
        const double middle = surface_dot(direction, center);
        range[0] = fmin(range[0], middle - radius);
        range[1] = fmax(range[1], middle + radius);
    }
    if (range[0] > range[1]) range[0] = range[1] = 0;
}

void krs_draw(krs_drawn *sample, uint32_t levels, uint32_t kinds, double depth) {
    const uint32_t solid = kinds & ~(uint32_t)KRS_HALF_SPACES;
    const uint32_t inner = solid != 0 ? solid : KRS_EMPTY;
    sample->levels = levels;
    sample->kernels[0] = krs_draw_kernel(sample, 0, levels == 0 ? kinds : inner);
    krs_expansion_begin(&sample->truth, &sample->kernels[0]);
    for (uint32_t i = 0; i < levels; ++i) {
        spt_mirror *const mirror = &sample->mirrors[i];
        double normal[3], range[2];
        *mirror = krs_draw_mirror(0);
        krs_widen(mirror->normal, normal);
        support(&sample->truth, normal, range);
        const double gap = check_uniform(0, 0.2) + 1e-5;
        const double cut = depth * check_uniform(0.5, 1) * (range[1] - range[0]) / 2;
        mirror->offset = (float)(range[1] + gap - cut);
        sample->kernels[i + 1] = krs_draw_kernel(sample, i + 1, i + 1 == levels ? kinds : inner);
        krs_expansion_add(&sample->truth, mirror, &sample->kernels[i + 1]);
    }
    sample->reach = 1;
    for (size_t i = 0; i < sample->truth.count; ++i) {
        double center[3], radius;
        if (instance_ball(&sample->truth, i, center, &radius))
            sample->reach = fmax(sample->reach, surface_length(center) + radius);
    }
}

spt_krs_model krs_model_of(const krs_drawn *sample) {
    spt_krs_model model = spt_krs_model_default();
    model.levels = sample->levels;
    model.kernels = sample->kernels;
    model.mirrors = sample->mirrors;
    return model;
}

void krs_build(const krs_drawn *sample, uint32_t lanes, spt_krs *krs) {
    spt_krs_model model = krs_model_of(sample);
    model.max_lanes = lanes;
    CHECK(spt_krs_build(&model, krs) == SPT_OK);
}

size_t krs_draw_on_surface(const krs_drawn *sample, double p[3]) {
    const krs_expansion *const truth = &sample->truth;
    double center[3], radius, seen[3];
    size_t index;
    do index = check_random() % truth->count;
    while (!krs_body_ball(&truth->instances[index].body, center, &radius));
    const krs_instance *const one = &truth->instances[index];
    krs_body_sample(&one->body, seen);
    for (int axis = 0; axis < 3; ++axis) p[axis] = seen[axis];
    for (uint32_t i = one->kernel; i < truth->levels && one->body.kind == SPT_KERNEL_FIELD; ++i) {
        if ((one->mirrors >> i & 1) != 0) krs_reflect(truth, i, p);
    }
    return index;
}

void krs_draw_points(const krs_drawn *sample, size_t count, float (*points)[3]) {
    double center[3], radius;
    int solid = 0;
    for (size_t i = 0; i < sample->truth.count && !solid; ++i)
        solid = krs_body_ball(&sample->truth.instances[i].body, center, &radius);
    for (size_t i = 0; i < count; ++i) {
        random_point(1.2 * sample->reach, points[i]);
        if (i % 2 != 0 && solid) {
            double p[3];
            krs_draw_on_surface(sample, p);
            for (int axis = 0; axis < 3; ++axis) points[i][axis] = (float)p[axis];
            random_step(pow(10, check_uniform(-5, -0.5)), points[i], points[i]);
        }
    }
}
