/* SPDX-License-Identifier: MIT
 *
 * Random bounding volumes and rays that meet them. */
#include "bounds_volume.h"
#include "../check.h"

#include <math.h>

static int chance(unsigned of) {
    return check_random() % of == 0;
}

static void draw_unit(double v[3]) {
    double square;
    do {
        square = 0;
        for (int axis = 0; axis < 3; ++axis) {
            v[axis] = check_uniform(-1, 1);
            square += v[axis] * v[axis];
        }
    } while (square < 0.01);
    for (int axis = 0; axis < 3; ++axis) v[axis] /= sqrt(square);
}

static void cross(const double a[3], const double b[3], double to[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        const int j = (axis + 1) % 3, k = (axis + 2) % 3;
        to[axis] = a[j] * b[k] - a[k] * b[j];
    }
}

/* Three axes: along those of the world, anyhow, or off from right angles as far as is allowed. */
static void draw_axes(float axis[3][3]) {
    static const double world[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double a[3][3], other[3], length = 0;
    const int along = chance(4), skewed = chance(3);
    draw_unit(a[0]);
    draw_unit(other);
    cross(a[0], other, a[1]);
    for (int k = 0; k < 3; ++k) length += a[1][k] * a[1][k];
    for (int k = 0; k < 3; ++k) a[1][k] /= sqrt(length) > 1e-3 ? sqrt(length) : 1e-3;
    cross(a[0], a[1], a[2]);
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            axis[i][k] = (float)(along || length < 1e-6 ? world[(i + 1) % 3][k] : a[i][k]);
            if (skewed) axis[i][k] += (float)check_uniform(-2.5e-4, 2.5e-4);
        }
    }
}

static void draw_planes(volume *out) {
    out->bound = spt_bound_polytope(out->planes, 4 + check_random() % (volume_planes - 3));
    for (size_t i = 0; i < out->bound.plane_count; ++i) {
        const double length = volume_magnitude(6);
        double normal[3], offset = out->size * check_uniform(0.3, 1);
        draw_unit(normal);
        for (int axis = 0; axis < 3; ++axis) {
            if (chance(6)) normal[axis] = 0;
            offset += normal[axis] * out->middle[axis];
            out->planes[i].normal[axis] = (float)(normal[axis] * length);
        }
        if (normal[0] == 0 && normal[1] == 0 && normal[2] == 0) out->planes[i].normal[1] = 1;
        out->planes[i].offset = (float)(offset * length);
    }
}

static void draw_slab(volume *out) {
    const double length = volume_magnitude(6), half = out->size * (chance(4) ? 0 : 1);
    double normal[3], place = 0;
    float turned[3];
    draw_unit(normal);
    for (int axis = 0; axis < 3; ++axis) {
        if (chance(4)) normal[axis] = 0;
        turned[axis] = (float)(normal[axis] * length);
        place += normal[axis] * length * out->middle[axis];
    }
    if (turned[0] == 0.0f && turned[1] == 0.0f && turned[2] == 0.0f) {
        turned[2] = (float)length;
        place = length * out->middle[2];
    }
    out->bound =
        spt_bound_slab(turned, (float)(place - half * length), (float)(place + half * length));
}

/* Some ends, or all. */
static void draw_ends(volume *out) {
    if (chance(2)) return;
    for (int axis = 0; axis < 3; ++axis) {
        const double reach = out->size * check_uniform(0.5, 4);
        if (!chance(4)) out->bound.low[axis] = (float)(out->middle[axis] - reach);
        if (!chance(4)) out->bound.high[axis] = (float)(out->middle[axis] + reach);
    }
}

static void draw_tube(volume *out, spt_bound_kind kind, const float center[3]) {
    const double length = out->size * pow(10, check_uniform(-2, 0));
    double along[3];
    float end[3];
    draw_unit(along);
    for (int axis = 0; axis < 3; ++axis) {
        if (chance(5)) along[axis] = 0;
        end[axis] = (float)((double)center[axis] + along[axis] * length);
    }
    const int one = end[0] == center[0] && end[1] == center[1] && end[2] == center[2];
    if (one && kind == SPT_BOUND_CYLINDER) end[0] = nextafterf(center[0], INFINITY);
    if (kind == SPT_BOUND_CAPSULE && chance(8)) {
        for (int axis = 0; axis < 3; ++axis) end[axis] = center[axis];
    }
    const float radius = (float)(out->size * pow(10, check_uniform(-2, 0)));
    out->bound = kind == SPT_BOUND_CAPSULE ? spt_bound_capsule(center, end, radius)
                                           : spt_bound_cylinder(center, end, radius);
}

void volume_draw(volume *out, spt_bound_kind kind, double scale) {
    float center[3], half[3], axis[3][3];
    out->size = check_uniform(0.01, 1) * scale * pow(10, check_uniform(-4, 0));
    for (int i = 0; i < 3; ++i) {
        center[i] = (float)(check_uniform(-1, 1) * scale);
        out->middle[i] = (double)center[i];
        half[i] = (float)(out->size * pow(10, check_uniform(-3, 0)));
    }
    draw_axes(axis);
    switch (kind) {
    case SPT_BOUND_SPHERE:
        out->bound = spt_bound_sphere(center[0], center[1], center[2], (float)out->size);
        return;
    case SPT_BOUND_BOX:
        out->bound = spt_bound_box(center[0] - half[0], center[1] - half[1], center[2] - half[2],
                                   center[0] + half[0], center[1] + half[1], center[2] + half[2]);
        return;
    case SPT_BOUND_ORIENTED_BOX:
        for (int i = 0; i < 3; ++i) half[i] = chance(6) ? 0 : half[i];
        out->bound = spt_bound_oriented_box(center, axis, half);
        return;
    case SPT_BOUND_ELLIPSOID:
        out->bound = spt_bound_ellipsoid(center, axis, half);
        return;
    case SPT_BOUND_CAPSULE:
    case SPT_BOUND_CYLINDER:
        draw_tube(out, kind, center);
        for (int i = 0; i < 3; ++i) {
            out->middle[i] = 0.5 * ((double)center[i] + (double)out->bound.end[i]);
        }
        return;
    case SPT_BOUND_SLAB:
        draw_slab(out);
        break;
    default:
        draw_planes(out);
    }
    draw_ends(out);
}

/* ---- Rays ----------------------------------------------------------------------------------- */

/* A point of the boundary: where a ray from the middle leaves the volume, or of an oriented box one
 * of a corner, an edge or a face. */
static void draw_target(const volume *self, double target[3]) {
    const float middle[3] = {(float)self->middle[0], (float)self->middle[1],
                             (float)self->middle[2]};
    double direction[3];
    float along[3];
    draw_unit(direction);
    for (int axis = 0; axis < 3; ++axis) along[axis] = (float)direction[axis];
    const volume_interval inside = volume_truth(&self->bound, middle, along);
    const double way = inside.exit > 0 && inside.exit < HUGE_VAL ? inside.exit : self->size;
    for (int axis = 0; axis < 3; ++axis) {
        target[axis] = (double)middle[axis] + way * (double)along[axis];
    }
    if (self->bound.kind != SPT_BOUND_ORIENTED_BOX || chance(3)) return;
    for (int axis = 0; axis < 3; ++axis) target[axis] = self->middle[axis];
    for (int i = 0; i < 3; ++i) {
        const double part = chance(3) ? check_uniform(-1, 1) : chance(2) ? 1 : -1;
        for (int axis = 0; axis < 3; ++axis) {
            target[axis] += part * (double)self->bound.half[i] * (double)self->bound.axis[i][axis];
        }
    }
}

/* Takes what the direction has of the normal there off. */
static void touch(const volume *self, const double target[3], double direction[3]) {
    double normal[3], square = 0, part = 0;
    const double step = 1e-5 * self->size;
    for (int axis = 0; axis < 3; ++axis) {
        double before[3], behind[3];
        for (int k = 0; k < 3; ++k) {
            before[k] = target[k] - (k == axis ? step : 0);
            behind[k] = target[k] + (k == axis ? step : 0);
        }
        normal[axis] = volume_excess(&self->bound, behind) - volume_excess(&self->bound, before);
        square += normal[axis] * normal[axis];
        part += normal[axis] * direction[axis];
    }
    for (int axis = 0; axis < 3 && square > 0; ++axis) {
        direction[axis] -= part / square * normal[axis];
    }
}

void volume_ray(const volume *self, float origin[3], float direction[3]) {
    const double unit = volume_magnitude(6);
    const double far = self->size * volume_magnitude(4) * (chance(3) ? 1e3 : 1);
    double target[3], d[3];
    draw_target(self, target);
    draw_unit(d);
    if (chance(4)) d[check_random() % 3] *= 1e-6;
    if (chance(4)) d[check_random() % 3] = 0;
    if (chance(2)) touch(self, target, d);
    if (fabs(d[0]) + fabs(d[1]) + fabs(d[2]) < 1e-3) d[check_random() % 3] = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const float rounded = (float)d[axis];
        origin[axis] = (float)(target[axis] - (double)rounded * far);
        direction[axis] = (float)((double)rounded * unit);
    }
}

/* ---- Around a box --------------------------------------------------------------------------- */

void volume_ball_point(void *user, const float origin[3], const float direction[3], float *t_in,
                       float *t_out) {
    const volume *self = user;
    double square = 0, along = 0, apart = 0, arm[3];
    for (int axis = 0; axis < 3; ++axis) {
        const double d = (double)direction[axis];
        arm[axis] = self->middle[axis] - (double)origin[axis];
        square += d * d;
        along += d * arm[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        arm[axis] -= along / square * (double)direction[axis];
        apart += arm[axis] * arm[axis];
    }
    const double room = self->size * self->size - apart;
    const double half = sqrt(fmax(room, 0) / square);
    *t_in = room < 0 ? 1.0f : (float)(along / square - half);
    *t_out = room < 0 ? 0.0f : (float)(along / square + half);
}

void volume_ball_batch(void *user, size_t n, const float *const origin[3],
                       const float *const direction[3], float *t_in, float *t_out) {
    for (size_t i = 0; i < n; ++i) {
        const float o[3] = {origin[0][i], origin[1][i], origin[2][i]};
        const float d[3] = {direction[0][i], direction[1][i], direction[2][i]};
        volume_ball_point(user, o, d, &t_in[i], &t_out[i]);
    }
}

/* A plane that the box just touches from behind, and how far the box reaches along its normal. */
static double draw_plane(const volume *self, const double half[3], float normal[3]) {
    double place = 0, n[3];
    draw_unit(n);
    for (int axis = 0; axis < 3; ++axis) {
        normal[axis] = (float)n[axis];
        place += (double)normal[axis] * self->middle[axis];
    }
    return place + fabs((double)normal[0]) * half[0] + fabs((double)normal[1]) * half[1] +
           fabs((double)normal[2]) * half[2];
}

/* The kinds that are cut with a box. */
static void draw_cut(volume *out, spt_bound_kind kind, const double half[3]) {
    float normal[3];
    if (kind == SPT_BOUND_SLAB) {
        const double far = draw_plane(out, half, normal);
        double place = 0;
        for (int axis = 0; axis < 3; ++axis) place += (double)normal[axis] * out->middle[axis];
        out->bound = spt_bound_slab(normal, (float)(2 * place - far - 1e-4), (float)(far + 1e-4));
    } else if (kind == SPT_BOUND_POLYTOPE) {
        out->bound = spt_bound_polytope(out->planes, volume_planes);
        for (int i = 0; i < volume_planes; ++i) {
            const double offset = draw_plane(out, half, out->planes[i].normal);
            out->planes[i].offset = (float)(offset + 1e-4);
        }
    } else {
        out->bound = chance(2) ? spt_bound_callback(volume_ball_batch, NULL, out)
                               : spt_bound_callback(NULL, volume_ball_point, out);
    }
}

void volume_around(volume *out, spt_bound_kind kind, const float low[3], const float high[3]) {
    const int along = (int)(check_random() % 3);
    double half[3], square = 0, across = 0;
    float center[3], end[3], sides[3], axis[3][3];
    draw_axes(axis);
    for (int i = 0; i < 3; ++i) {
        half[i] = 0.5 * ((double)high[i] - (double)low[i]) * 1.0001 + 1e-4;
        out->middle[i] = 0.5 * ((double)high[i] + (double)low[i]);
        center[i] = end[i] = (float)out->middle[i];
        square += half[i] * half[i];
        across += i == along ? 0 : half[i] * half[i];
    }
    out->size = sqrt(square) * 1.0001;
    center[along] -= (float)half[along];
    end[along] += (float)half[along];
    switch (kind) {
    case SPT_BOUND_CAPSULE:
        out->bound = spt_bound_capsule(center, end, (float)sqrt(across));
        return;
    case SPT_BOUND_CYLINDER:
        out->bound = spt_bound_cylinder(center, end, (float)sqrt(across));
        return;
    case SPT_BOUND_ELLIPSOID: /* around a ball */
    case SPT_BOUND_ORIENTED_BOX:
        center[along] = (float)out->middle[along];
        for (int i = 0; i < 3; ++i) {
            double reach = 0;
            for (int k = 0; k < 3; ++k) reach += fabs((double)axis[i][k]) * half[k];
            sides[i] =
                (float)(kind == SPT_BOUND_ELLIPSOID ? 1.002 * out->size * check_uniform(1, 1.5)
                                                    : reach * 1.0001);
        }
        out->bound = kind == SPT_BOUND_ELLIPSOID ? spt_bound_ellipsoid(center, axis, sides)
                                                 : spt_bound_oriented_box(center, axis, sides);
        return;
    case SPT_BOUND_SPHERE:
        out->bound = spt_bound_sphere((float)out->middle[0], (float)out->middle[1],
                                      (float)out->middle[2], (float)out->size);
        return;
    case SPT_BOUND_BOX:
        out->bound = spt_bound_box(low[0], low[1], low[2], high[0], high[1], high[2]);
        return;
    default:
        draw_cut(out, kind, half);
    }
    for (int i = 0; i < 3 && chance(2); ++i) {
        out->bound.low[i] = (float)(out->middle[i] - half[i]);
        out->bound.high[i] = (float)(out->middle[i] + half[i]);
    }
}
