/* SPDX-License-Identifier: MIT
 *
 * How far a model reaches: the upright box around it, by branch and bound over its instances. Much
 * tighter than the ball that spt_krs_build() finds for a tree of many levels. */
#include "model_grow.h"

#include <math.h>

typedef struct model_ball {
    double center[3], radius; /* below 0: nothing */
} model_ball;

typedef struct model_reach {
    const model_sketch *sketch;
    model_ball balls[SPT_KRS_LEVELS + 1]; /* around L_i */
    double best;
} model_reach;

/* A leaf or an arc lies within its ends' hull, widened by what it bulges: control is its middle. */
static double side_bulge(const spt_kernel *kernel) {
    double square = 0;
    if (kernel->kind == SPT_KERNEL_LEAF) return (double)kernel->width;
    if (kernel->kind != SPT_KERNEL_CAPSULE) return 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double bulge = (double)kernel->control[axis] -
                             0.5 * ((double)kernel->a[axis] + (double)kernel->b[axis]);
        square += bulge * bulge;
    }
    return sqrt(square);
}

static model_ball kernel_ball(const spt_kernel *kernel) {
    model_ball ball = {{0, 0, 0}, -1};
    double square = 0;
    if (kernel->kind == SPT_KERNEL_EMPTY) return ball;
    const int round = kernel->kind == SPT_KERNEL_SPHERE;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (double)kernel->a[axis], b = round ? a : (double)kernel->b[axis];
        ball.center[axis] = 0.5 * (a + b);
        square += 0.25 * (a - b) * (a - b);
    }
    ball.radius = sqrt(square) + side_bulge(kernel) + (double)kernel->radius;
    return ball;
}

static model_ball ball_around(const model_ball *a, const model_ball *b) {
    double way[3], square = 0;
    if (a->radius < 0) return *b;
    if (b->radius < 0) return *a;
    for (int axis = 0; axis < 3; ++axis) {
        way[axis] = b->center[axis] - a->center[axis];
        square += way[axis] * way[axis];
    }
    const double apart = sqrt(square);
    if (apart + b->radius <= a->radius) return *a;
    if (apart + a->radius <= b->radius) return *b;
    model_ball both = {{0, 0, 0}, 0.5 * (apart + a->radius + b->radius)};
    const double share = (both.radius - a->radius) / apart;
    for (int axis = 0; axis < 3; ++axis) both.center[axis] = a->center[axis] + share * way[axis];
    return both;
}

/* How far v . n of a mirror's unit normal. */
static double along_normal(const double v[3], const spt_mirror *mirror) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) sum += v[axis] * (double)mirror->normal[axis];
    return sum;
}

static void find_balls(model_reach *reach) {
    const model_sketch *const sketch = reach->sketch;
    reach->balls[0] = kernel_ball(&sketch->kernels[0]);
    for (uint32_t i = 0; i < sketch->levels; ++i) {
        const spt_mirror *const mirror = &sketch->mirrors[i];
        model_ball image = reach->balls[i];
        const double beyond = along_normal(image.center, mirror) - (double)mirror->offset;
        for (int axis = 0; axis < 3; ++axis) {
            image.center[axis] -= 2 * beyond * (double)mirror->normal[axis];
        }
        const model_ball both = ball_around(&reach->balls[i], &image);
        const model_ball kernel = kernel_ball(&sketch->kernels[i + 1]);
        reach->balls[i + 1] = ball_around(&both, &kernel);
    }
}

static double kernel_reach(const spt_kernel *kernel, const double u[3]) {
    double at_a = 0, at_b = 0;
    for (int axis = 0; axis < 3; ++axis) {
        at_a += u[axis] * (double)kernel->a[axis];
        at_b += u[axis] * (double)kernel->b[axis];
    }
    const int round = kernel->kind == SPT_KERNEL_SPHERE;
    return (round ? at_a : fmax(at_a, at_b)) + side_bulge(kernel) + (double)kernel->radius;
}

/* The greatest u . p of L_level, `more` added: the image of p in a mirror reaches as far along u as
 * p does along the image of u. Only what can beat the best is looked at, the farther half first. */
static void reach_along(model_reach *reach, uint32_t level, const double u[3], double more) {
    const model_sketch *const sketch = reach->sketch;
    const model_ball *const ball = &reach->balls[level];
    if (ball->radius < 0 || model_dot(u, ball->center) + ball->radius + more <= reach->best) return;
    const spt_kernel *const kernel = &sketch->kernels[level];
    if (kernel->kind != SPT_KERNEL_EMPTY) {
        reach->best = fmax(reach->best, kernel_reach(kernel, u) + more);
    }
    if (level == 0) return;
    const spt_mirror *const mirror = &sketch->mirrors[level - 1];
    const double along = along_normal(u, mirror);
    const double shift = more + 2 * along * (double)mirror->offset;
    double image[3];
    for (int axis = 0; axis < 3; ++axis) {
        image[axis] = u[axis] - 2 * along * (double)mirror->normal[axis];
    }
    if (along > 0) reach_along(reach, level - 1, image, shift);
    reach_along(reach, level - 1, u, more);
    if (along <= 0) reach_along(reach, level - 1, image, shift);
}

/* Rounded outward by more than the sketch's numbers have lost. */
spt_bound model_box(const model_sketch *sketch) {
    model_reach reach = {.sketch = sketch};
    double ends[2][3];
    find_balls(&reach);
    for (int axis = 0; axis < 3; ++axis) {
        for (int high = 0; high < 2; ++high) {
            double u[3] = {0, 0, 0};
            u[axis] = high ? 1 : -1;
            reach.best = -HUGE_VAL;
            reach_along(&reach, sketch->levels, u, 0);
            ends[high][axis] = u[axis] * (reach.best + 1e-4 * (1 + fabs(reach.best)));
        }
    }
    return spt_bound_box((float)ends[0][0], (float)ends[0][1], (float)ends[0][2], (float)ends[1][0],
                         (float)ends[1][1], (float)ends[1][2]);
}
