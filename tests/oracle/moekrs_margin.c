/* SPDX-License-Identifier: MIT
 *
 * What is true of a model of moekrs_model.h: distances, ways through its levels, and how far
 * float32 may be from them. */
#include "moekrs_model.h"
#include "../check.h"

#include <math.h>
#include <string.h>

spt_moekrs_model moekrs_description(const moekrs_model *model) {
    spt_moekrs_model description = spt_moekrs_model_default();
    description.levels = (uint32_t)model->levels;
    description.kernels = model->kernels;
    description.maps = model->maps;
    description.unmirrored = model->unmirrored;
    return description;
}

void moekrs_built(const moekrs_model *model, uint32_t max_lanes, spt_moekrs *built) {
    spt_moekrs_model description = moekrs_description(model);
    description.max_lanes = max_lanes;
    CHECK(spt_moekrs_build(&description, built) == SPT_OK);
}

double moekrs_distance(const moekrs_model *model, const float p[3], int *which) {
    const double x = (double)p[0], y = (double)p[1], z = (double)p[2];
    double least = HUGE_VAL;
    int nearest = -1;
    for (int k = 0; k < model->count; ++k) {
        const moekrs_instance *one = &model->instance[k];
        const double a = x - one->center[0], b = y - one->center[1], c = z - one->center[2];
        double distance = sqrt(a * a + b * b + c * c) - one->radius;
        if (one->region.kind == SPT_REGION_OUTSIDE) distance = -distance;
        if (one->region.kind == SPT_REGION_HALF_SPACE) {
            distance = one->center[0] * x + one->center[1] * y + one->center[2] * z - one->radius;
        }
        if (distance < least) {
            least = distance;
            nearest = k;
        }
    }
    if (which != NULL) *which = nearest;
    return least;
}

/* Kernel K_0 joins before the mirror of level 0, K_j after that of level j - 1. */
void moekrs_to_kernel(const moekrs_model *model, int kernel, uint64_t mirrors, const wide p[3],
                      wide q[3]) {
    wide at[3] = {p[0], p[1], p[2]};
    for (int i = model->levels - 1; i >= 0 && i >= kernel - 1; --i) {
        moekrs_move(&model->undone[i], at, at);
        if (i >= kernel && (mirrors >> i & 1) != 0) at[0] = -at[0];
    }
    memcpy(q, at, sizeof at);
}

void moekrs_to_world(const moekrs_model *model, int kernel, uint64_t mirrors, const wide q[3],
                     wide p[3]) {
    wide at[3] = {q[0], q[1], q[2]};
    for (int i = kernel == 0 ? 0 : kernel - 1; i < model->levels; ++i) {
        if (i >= kernel && (mirrors >> i & 1) != 0) at[0] = -at[0];
        moekrs_move(&model->chain[i], at, at);
    }
    memcpy(p, at, sizeof at);
}

int moekrs_turns(const moekrs_model *model, const float p[3], double rho) {
    const double center[3] = {(double)p[0], (double)p[1], (double)p[2]};
    moekrs_region ball = moekrs_ball(center, rho);
    for (int i = model->levels - 1; i >= 0; --i) {
        ball = moekrs_map_region(&model->undone[i], &ball);
        if (ball.kind != SPT_REGION_BALL) return 1;
        if ((model->unmirrored >> i & 1) == 0 && ball.center[0] > 0) {
            ball.center[0] = -ball.center[0];
        }
    }
    return 0;
}

/* ---- What float32 may be off by ------------------------------------------------------------ */

static double square(const spt_quaternion *q) {
    return spt_quaternion_square(*q);
}

typedef struct level_state {
    wide center[3], rho, growth;
    double absolute, relative;
} level_state;

/* One level, of a ball (k, rho) with world lengths `growth` times those outside the level's map.
 * With the letters of the header, u = a - k c and q the preimage of k, to first order in 2^-24:
 *   - L is evaluated with rounded a .. d, and k c, d* k, b* + d* k are rounded: the preimage is
 *     that of a point that is |u| (|a||q| + |b| + |k||c||q| + |k||d|) from k, for
 *     L = (a q + b)(c q + d)^-1 and |c q + d| = 1 / |u|;
 *   - |u| is off by (|a| + |k||c|) relative to itself, and rho by as much, twice;
 *   - m = rho^2 |c|^2 / |u|^2 is computed once for the center and the radius of the preimage, so
 *     that its rounding is a ball of a slightly different rho: 4 rho;
 *   - inside, where what is one long is at most |u|^2 (1 + sqrt(m))^2 outside (at the ball's point
 *     away from the pole), its center's two terms and its radius are rounded: |k'| + rho' and
 *     (|q| + |d| / |c|) m / (1 - m).
 * Each term stands for up to eight products and sums of four numbers: the 8 of `factor`. */
static void through_level(const moekrs_model *model, int i, level_state *state) {
    const spt_mobius *map = &model->maps[i];
    const double A = sqrt(square(&map->a)), B = sqrt(square(&map->b)), C = sqrt(square(&map->c)),
                 D = sqrt(square(&map->d));
    const spt_quaternion k = spt_quaternion_of(0, (double)state->center[0],
                                               (double)state->center[1], (double)state->center[2]);
    const spt_quaternion kc = spt_quaternion_product(k, map->c);
    const spt_quaternion u = spt_quaternion_sum(map->a, spt_quaternion_scaled(kc, -1));
    const double K = sqrt(square(&k)), U = sqrt(square(&u)), rho = (double)state->rho;
    const double root = rho * C / U, m = root * root, W = (double)state->growth;
    moekrs_region ball = {SPT_REGION_BALL, {0, 0, 0}, 0};
    wide q[3];
    double Q, inner;
    memcpy(ball.center, state->center, sizeof ball.center);
    ball.radius = state->rho;
    moekrs_move(&model->undone[i], state->center, q);
    Q = (double)moekrs_length(q);
    state->absolute += W * U * (A * Q + B + K * C * Q + K * D);
    state->absolute += W * rho * (2 * (A + K * C) / U + 4);
    state->relative += 2 * (A + K * C) / U + 4;
    if (m < 1) ball = moekrs_map_region(&model->undone[i], &ball);
    inner = (double)(moekrs_length(ball.center) + ball.radius);
    if (C > 0) inner += (Q + D / C) * m / (1 - m);
    state->growth *= (wide)(U * U * (1 + root) * (1 + root));
    state->absolute += (double)state->growth * inner;
    if (!(m < 1)) state->absolute = HUGE_VAL; /* the probe is not decided by its radius */
    memcpy(state->center, rho > 0 ? ball.center : q, sizeof state->center);
    state->rho = rho > 0 ? ball.radius : 0;
}

/* A kernel's distance is off by its largest number. */
static void at_kernel(const moekrs_model *model, int kernel, level_state *state) {
    const spt_kernel *one = &model->kernels[kernel];
    double size = (double)(moekrs_length(state->center) + state->rho) + fabs((double)one->radius);
    if (one->kind == SPT_KERNEL_EMPTY) return;
    for (int axis = 0; axis < 3; ++axis) size += fabs((double)one->a[axis]);
    state->absolute += (double)state->growth * size;
}

moekrs_error moekrs_margin(const moekrs_model *model, const float p[3], double rho) {
    const double factor = 8 * 0x1p-24;
    level_state state = {{(wide)p[0], (wide)p[1], (wide)p[2]}, (wide)rho, 1, 0, 4};
    moekrs_error error;
    for (int i = model->levels - 1; i >= 0; --i) {
        through_level(model, i, &state);
        at_kernel(model, i + 1, &state);
        if ((model->unmirrored >> i & 1) == 0 && state.center[0] > 0) {
            state.center[0] = -state.center[0];
        }
    }
    at_kernel(model, 0, &state);
    error.absolute = factor * state.absolute;
    error.relative = factor * state.relative;
    return error;
}
