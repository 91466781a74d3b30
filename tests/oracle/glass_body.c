/* SPDX-License-Identifier: MIT
 *
 * The distances, the crossings in closed form, for rounded bodies by bisection, and the callbacks.
 */
#include "glass_body.h"
#include "check.h"

#include <math.h>
#include <string.h>

enum { halvings = 60, thirds = 120 };

/* ---- Making them ---------------------------------------------------------------------------- */

static glass_body body_of(const char *name, double reach) {
    static const double center[3] = {0.25, -0.375, 0.125};
    glass_body body;
    memset(&body, 0, sizeof body);
    body.name = name;
    body.slope = body.lipschitz = 1;
    for (int axis = 0; axis < 3; ++axis) body.center[axis] = center[axis];
    body.bound = spt_bound_sphere((float)center[0], (float)center[1], (float)center[2],
                                  (float)(1.001 * reach));
    return body;
}

static void add_plane(glass_body *body, double x, double y, double z, double offset) {
    const double length = sqrt(x * x + y * y + z * z);
    double *normal = body->normal[body->plane_count];
    normal[0] = x / length;
    normal[1] = y / length;
    normal[2] = z / length;
    body->offset[body->plane_count++] = offset;
}

static void add_box(glass_body *body, double x, double y, double z) {
    for (int side = -1; side <= 1; side += 2) {
        add_plane(body, side, 0, 0, x);
        add_plane(body, 0, side, 0, y);
        add_plane(body, 0, 0, side, z);
    }
}

glass_body glass_ball(void) {
    glass_body body = body_of("ball", 1);
    body.radius = 1;
    body.curvature = 1;
    return body;
}

glass_body glass_plate(void) {
    glass_body body = body_of("plate", sqrt(1.5 * 1.5 + 1.5 * 1.5 + 0.2 * 0.2));
    add_box(&body, 1.5, 0.2, 1.5);
    return body;
}

glass_body glass_cube(void) {
    glass_body body = body_of("cube", sqrt(3.0));
    add_box(&body, 1, 1, 1);
    return body;
}

glass_body glass_dodecahedron(void) {
    const double phi = (1 + sqrt(5.0)) / 2;
    glass_body body = body_of("dodecahedron", 1.2584085723648);
    for (int side = -1; side <= 1; side += 2) {
        for (int twin = -1; twin <= 1; twin += 2) {
            add_plane(&body, 0, side, twin * phi, 1);
            add_plane(&body, side, twin * phi, 0, 1);
            add_plane(&body, twin * phi, 0, side, 1);
        }
    }
    return body;
}

glass_body glass_random(void) {
    glass_body body = body_of("random polytope", sqrt(3.0));
    const int cuts = 4 + (int)(check_random() % 11);
    double half[3];
    for (int axis = 0; axis < 3; ++axis) half[axis] = check_uniform(0.6, 1);
    add_box(&body, half[0], half[1], half[2]);
    while (body.plane_count < 6 + cuts) {
        const double x = check_uniform(-1, 1), y = check_uniform(-1, 1), z = check_uniform(-1, 1);
        if (x * x + y * y + z * z < 0.01) continue;
        add_plane(&body, x, y, z, check_uniform(0.5, 1));
    }
    return body;
}

/* Along a unit tangent v the second derivative of the norm on the surface is at most
 * (p - 1) sum h_j^(p-2) (n_j . v)^2 with all h_j <= 1, and sum (n_j . v)^2 over the six axes of a
 * dodecahedron is 2; the gradient sum h_j^(p-1) n_j is shortest at the corners, where three h_j are
 * 3^(-1/p): 3^(1/p - 1) |n_1 + n_2 + n_3| = 0.91 for p = 8 and 0.82 for 32 (a corner is
 * 1.2584 = |n_1 + n_2 + n_3| / (1 + 2 / sqrt 5) from the center). It is longest at the faces, where
 * five heights are 1 / sqrt 5: (1 + 5 / 5^(p/2))^(1/p). */
glass_body glass_rounded(int exponent) {
    glass_body body = glass_dodecahedron();
    body.name = exponent == 8 ? "rounded dodecahedron, 8" : "rounded dodecahedron, 32";
    body.exponent = exponent;
    body.slope = 0.8;
    body.lipschitz = 1.001;
    body.curvature = 2.0 * (exponent - 1) / body.slope;
    return body;
}

/* ---- The truth ------------------------------------------------------------------------------ */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double power(double x, int exponent) {
    double result = x;
    for (int done = 1; done < exponent; done *= 2) result *= result;
    return result;
}

static double root(double x, int exponent) {
    double result = x;
    for (int done = 1; done < exponent; done *= 2) result = sqrt(result);
    return result;
}

static void from_center(const glass_body *body, const double p[3], double v[3]) {
    for (int axis = 0; axis < 3; ++axis) v[axis] = p[axis] - body->center[axis];
}

double glass_distance(const glass_body *body, const double p[3]) {
    double v[3], greatest = -HUGE_VAL, sum = 0;
    from_center(body, p, v);
    if (body->plane_count == 0) return sqrt(dot(v, v)) - body->radius;
    for (int i = 0; i < body->plane_count; ++i) {
        greatest = fmax(greatest, dot(body->normal[i], v) - body->offset[i]);
    }
    if (body->exponent == 0) return greatest;
    for (int i = 0; i < body->plane_count; ++i) {
        sum += power(fmax(0, dot(body->normal[i], v)), body->exponent);
    }
    return root(sum, body->exponent) - 1;
}

int glass_face(const glass_body *body, const double p[3]) {
    double v[3], greatest = -HUGE_VAL;
    int face = 0;
    from_center(body, p, v);
    if (body->exponent != 0) return 0;
    for (int i = 0; i < body->plane_count; ++i) {
        const double distance = dot(body->normal[i], v) - body->offset[i];
        if (distance > greatest) face = i;
        greatest = fmax(greatest, distance);
    }
    return face;
}

double glass_other_faces(const glass_body *body, const double p[3]) {
    double v[3], greatest = -HUGE_VAL;
    const int face = glass_face(body, p);
    from_center(body, p, v);
    if (body->exponent != 0) return HUGE_VAL;
    for (int i = 0; i < body->plane_count; ++i) {
        if (i != face) greatest = fmax(greatest, dot(body->normal[i], v) - body->offset[i]);
    }
    return -greatest;
}

void glass_normal(const glass_body *body, const double p[3], double normal[3]) {
    double length;
    from_center(body, p, normal);
    if (body->exponent != 0) {
        double sum[3] = {0, 0, 0};
        for (int i = 0; i < body->plane_count; ++i) {
            const double height = fmax(0, dot(body->normal[i], normal));
            const double weight = height > 0 ? power(height, body->exponent) / height : 0;
            for (int axis = 0; axis < 3; ++axis) sum[axis] += weight * body->normal[i][axis];
        }
        memcpy(normal, sum, sizeof sum);
    } else if (body->plane_count != 0) {
        memcpy(normal, body->normal[glass_face(body, p)], 3 * sizeof *normal);
    }
    length = sqrt(dot(normal, normal));
    for (int axis = 0; axis < 3; ++axis) normal[axis] /= length;
}

static double along(const glass_body *body, const double o[3], const double d[3], double s) {
    const double p[3] = {o[0] + s * d[0], o[1] + s * d[1], o[2] + s * d[2]};
    return glass_distance(body, p);
}

/* f along a ray is convex: its least value by thirds, and a root on either side of it. */
static int rounded_cross(const glass_body *body, const double o[3], const double d[3], int inside,
                         double *at) {
    double low = 0, high = 100, middle = 0;
    for (int i = 0; i < thirds && !inside; ++i) {
        const double first = low + (high - low) / 3, second = high - (high - low) / 3;
        middle = (first + second) / 2;
        if (along(body, o, d, middle) < 0) break;
        if (along(body, o, d, first) < along(body, o, d, second)) {
            high = second;
        } else {
            low = first;
        }
    }
    if (!inside && !(along(body, o, d, middle) < 0)) return 0;
    low = inside ? 0 : middle; /* inside */
    high = inside ? 10 : 0;    /* outside */
    for (int i = 0; i < halvings; ++i) {
        const double next = (low + high) / 2;
        if (along(body, o, d, next) < 0) {
            low = next;
        } else {
            high = next;
        }
    }
    *at = (low + high) / 2;
    return 1;
}

int glass_cross(const glass_body *body, const double origin[3], const double direction[3],
                int inside, double *at) {
    double v[3], entry = -HUGE_VAL, leave = HUGE_VAL;
    if (body->exponent != 0) return rounded_cross(body, origin, direction, inside, at);
    from_center(body, origin, v);
    if (body->plane_count == 0) {
        const double closest = -dot(v, direction);
        double apart = 0, half;
        for (int axis = 0; axis < 3; ++axis) {
            const double side = v[axis] + closest * direction[axis];
            apart += side * side;
        }
        if (apart > body->radius * body->radius) return 0;
        half = sqrt(body->radius * body->radius - apart);
        entry = closest - half;
        leave = closest + half;
    }
    for (int i = 0; i < body->plane_count; ++i) {
        const double height = body->offset[i] - dot(body->normal[i], v);
        const double rise = dot(body->normal[i], direction);
        if (rise > 0) leave = fmin(leave, height / rise);
        if (rise < 0) entry = fmax(entry, height / rise);
        if (!(fabs(rise) > 0) && height < 0) return 0;
    }
    *at = inside ? leave : entry;
    return inside ? leave >= 0 : entry <= leave && entry >= 0;
}

/* ---- The library's view --------------------------------------------------------------------- */

static void distance_double(void *user, size_t n, const float *x, const float *y, const float *z,
                            float *distance) {
    glass_body *body = user;
    ++body->batches;
    body->asked += n;
    for (size_t i = 0; i < n; ++i) {
        const double p[3] = {(double)x[i], (double)y[i], (double)z[i]};
        distance[i] = (float)glass_distance(body, p);
    }
}

static void distance_single(void *user, size_t n, const float *x, const float *y, const float *z,
                            float *distance) {
    glass_body *body = user;
    const float cx = (float)body->center[0], cy = (float)body->center[1],
                cz = (float)body->center[2], radius = (float)body->radius;
    ++body->batches;
    body->asked += n;
    for (size_t i = 0; i < n; ++i) {
        const float vx = x[i] - cx, vy = y[i] - cy, vz = z[i] - cz;
        distance[i] = -3.0e38f;
        if (body->plane_count == 0) distance[i] = sqrtf(vx * vx + vy * vy + vz * vz) - radius;
    }
    for (int plane = 0; plane < body->plane_count; ++plane) {
        const double *normal = body->normal[plane];
        const float a = (float)normal[0], b = (float)normal[1], c = (float)normal[2];
        const float offset = (float)body->offset[plane];
        for (size_t i = 0; i < n; ++i) {
            const float height = a * (x[i] - cx) + b * (y[i] - cy) + c * (z[i] - cz) - offset;
            distance[i] = distance[i] > height ? distance[i] : height;
        }
    }
}

static void gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                     float *gradient_x, float *gradient_y, float *gradient_z) {
    const glass_body *body = user;
    for (size_t i = 0; i < n; ++i) {
        const double p[3] = {(double)x[i], (double)y[i], (double)z[i]};
        double normal[3];
        glass_normal(body, p, normal);
        gradient_x[i] = (float)(3 * normal[0]); /* the length does not matter */
        gradient_y[i] = (float)(3 * normal[1]);
        gradient_z[i] = (float)(3 * normal[2]);
    }
}

spt_field glass_field(glass_body *body, int with_gradient) {
    spt_field field = spt_field_default();
    field.batch = body->single && body->exponent == 0 ? distance_single : distance_double;
    field.user = body;
    field.flags = SPT_FIELD_CONVEX;
    field.bound = &body->bound;
    field.lipschitz = (float)body->lipschitz;
    if (with_gradient) field.gradient = gradient;
    return field;
}

glass_body glass_body_number(int number) {
    switch (number) {
    case 0:
        return glass_ball();
    case 1:
        return glass_plate();
    case 2:
        return glass_cube();
    case 3:
        return glass_dodecahedron();
    case 4:
        return glass_rounded(8);
    case 5:
        return glass_rounded(32);
    default:
        return glass_random();
    }
}
