/* SPDX-License-Identifier: MIT
 *
 * Closed-form roots, then the sign of the exact distance between them: a root at which the sign
 * does not change is no crossing, so superfluous roots do no harm. */
#include "analytic.h"

#include <math.h>

enum { most_roots = 8, depth_samples = 64, halvings = 100 };

double analytic_distance(const analytic_shape *shape, const double p[3]) {
    const double ring = hypot(p[0], p[2]);
    switch (shape->kind) {
    case ANALYTIC_SPHERE:
        return sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - shape->radius;
    case ANALYTIC_PLANE:
        return p[1];
    case ANALYTIC_BOX: {
        double outside = 0, inside = -HUGE_VAL;
        for (int axis = 0; axis < 3; ++axis) {
            const double q = fabs(p[axis]) - shape->half[axis];
            if (q > 0) outside += q * q;
            if (q > inside) inside = q;
        }
        return outside > 0 ? sqrt(outside) : inside;
    }
    case ANALYTIC_CAPSULE: {
        const double beyond = fabs(p[1]) - shape->extent;
        return hypot(ring, beyond > 0 ? beyond : 0) - shape->radius;
    }
    case ANALYTIC_CYLINDER: {
        const double side = ring - shape->radius, end = fabs(p[1]) - shape->extent;
        return side > 0 && end > 0 ? hypot(side, end) : side > end ? side : end;
    }
    default:
        return hypot(ring - shape->extent, p[1]) - shape->radius;
    }
}

double analytic_size(const analytic_shape *shape) {
    const double *half = shape->half;
    switch (shape->kind) {
    case ANALYTIC_PLANE:
        return 1;
    case ANALYTIC_BOX:
        return sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2]);
    case ANALYTIC_CYLINDER:
        return hypot(shape->radius, shape->extent);
    default:
        return shape->radius + shape->extent;
    }
}

analytic_shape analytic_sample(analytic_kind kind, double scale) {
    static const analytic_shape unit[ANALYTIC_KINDS] = {
        {ANALYTIC_SPHERE, 1, 0, {0, 0, 0}},       {ANALYTIC_PLANE, 0, 0, {0, 0, 0}},
        {ANALYTIC_BOX, 0, 0, {0.7, 0.3, 0.5}},    {ANALYTIC_CAPSULE, 0.25, 0.75, {0, 0, 0}},
        {ANALYTIC_CYLINDER, 0.4, 0.8, {0, 0, 0}}, {ANALYTIC_TORUS, 0.15, 0.8, {0, 0, 0}}};
    analytic_shape shape = unit[kind];
    shape.radius *= scale;
    shape.extent *= scale;
    for (int axis = 0; axis < 3; ++axis) shape.half[axis] *= scale;
    return shape;
}

/* The ray with a unit direction, its origin moved to where it comes closest to the shape's center:
 * the roots are then small numbers without cancellation. */
typedef struct line {
    double p[3], d[3];
} line;

static double distance_on(const analytic_shape *shape, const line *ray, double s) {
    const double p[3] = {ray->p[0] + s * ray->d[0], ray->p[1] + s * ray->d[1],
                         ray->p[2] + s * ray->d[2]};
    return analytic_distance(shape, p);
}

/* a s^2 + 2 b s + c = 0, without cancellation. */
static int quadratic_roots(double a, double b, double c, double *roots) {
    const double discriminant = b * b - a * c;
    double q;
    if (!(discriminant >= 0) || !(a > 0)) return 0;
    q = -(b + copysign(sqrt(discriminant), b));
    roots[0] = q / a;
    roots[1] = fabs(q) > 0 ? c / q : 0;
    return 2;
}

static double polynomial(const double *coefficients, int degree, double s) {
    double value = coefficients[degree];
    for (int i = degree - 1; i >= 0; --i) value = value * s + coefficients[i];
    return value;
}

/* All roots in (low, high): between the roots of its derivative a polynomial is monotone, so there
 * bisection finds at most one, and it cannot fail. Recursion ends at degree 1. */
static int polynomial_roots(const double *coefficients, int degree, double low, double high,
                            double *roots) {
    double derivative[4], knots[most_roots];
    int knot_count = 0, count = 0;
    for (int i = 1; i <= degree; ++i) derivative[i - 1] = i * coefficients[i];
    if (degree > 1) knot_count = polynomial_roots(derivative, degree - 1, low, high, knots);
    knots[knot_count] = high;
    for (int piece = 0; piece <= knot_count; ++piece) {
        double a = piece == 0 ? low : knots[piece - 1], b = knots[piece];
        const int negative = polynomial(coefficients, degree, a) < 0;
        if (negative == (polynomial(coefficients, degree, b) < 0)) continue;
        for (int i = 0; i < halvings; ++i) {
            const double middle = (a + b) / 2;
            if ((polynomial(coefficients, degree, middle) < 0) == negative) {
                a = middle;
            } else {
                b = middle;
            }
        }
        roots[count++] = (a + b) / 2;
    }
    return count;
}

static int torus_roots(const analytic_shape *shape, const line *ray, double *roots) {
    const double unit = shape->radius + shape->extent; /* all lengths over it, so that no power */
    const double tube = shape->radius / unit, ring = shape->extent / unit; /* over- or underflows */
    const double x = ray->p[0] / unit, y = ray->p[1] / unit, z = ray->p[2] / unit;
    const double k = x * x + y * y + z * z + ring * ring - tube * tube, w = 4 * ring * ring;
    const double dx = ray->d[0], dz = ray->d[2];
    const double coefficients[5] = {k * k - w * (x * x + z * z), -w * 2 * (x * dx + z * dz),
                                    2 * k - w * (dx * dx + dz * dz), 0, 1};
    const int count = polynomial_roots(coefficients, 4, -1.5, 1.5, roots);
    for (int i = 0; i < count; ++i) roots[i] *= unit;
    return count;
}

/* Where the line passes p[axis] = +-place. */
static int slab_roots(const line *ray, int axis, double place, double *roots) {
    if (!(fabs(ray->d[axis]) > 0)) return 0;
    roots[0] = (place - ray->p[axis]) / ray->d[axis];
    roots[1] = (-place - ray->p[axis]) / ray->d[axis];
    return 2;
}

static int ball_roots(const line *ray, double center_y, double radius, double *roots) {
    const double *p = ray->p, *d = ray->d, y = p[1] - center_y;
    return quadratic_roots(1, p[0] * d[0] + y * d[1] + p[2] * d[2],
                           p[0] * p[0] + y * y + p[2] * p[2] - radius * radius, roots);
}

static int all_roots(const analytic_shape *shape, const line *ray, double *roots) {
    const double *p = ray->p, *d = ray->d, radius = shape->radius;
    int count = 0;
    switch (shape->kind) {
    case ANALYTIC_SPHERE:
        return ball_roots(ray, 0, radius, roots);
    case ANALYTIC_PLANE:
        return slab_roots(ray, 1, 0, roots);
    case ANALYTIC_BOX:
        for (int axis = 0; axis < 3; ++axis) {
            count += slab_roots(ray, axis, shape->half[axis], roots + count);
        }
        return count;
    case ANALYTIC_TORUS:
        return torus_roots(shape, ray, roots);
    default:
        count = quadratic_roots(d[0] * d[0] + d[2] * d[2], p[0] * d[0] + p[2] * d[2],
                                p[0] * p[0] + p[2] * p[2] - radius * radius, roots);
        if (shape->kind == ANALYTIC_CYLINDER) {
            return count + slab_roots(ray, 1, shape->extent, roots + count);
        }
        count += ball_roots(ray, shape->extent, radius, roots + count);
        return count + ball_roots(ray, -shape->extent, radius, roots + count);
    }
}

static void sort(double *values, int count) {
    for (int i = 1; i < count; ++i) {
        const double value = values[i];
        int place = i;
        for (; place > 0 && values[place - 1] > value; --place) values[place] = values[place - 1];
        values[place] = value;
    }
}

/* The first s in [from, to] at which the ray is depth beyond the surface. */
static double first_deep(const analytic_shape *shape, const line *ray, double from, double to,
                         double side, double depth) {
    const double spacing = (to - from) / depth_samples;
    double low = from, high, best = -HUGE_VAL, at = from;
    if (!(depth > 0)) return from;
    for (int i = 0; i <= depth_samples; ++i) {
        const double s = from + i * spacing, beyond = -side * distance_on(shape, ray, s);
        if (beyond > best) {
            best = beyond;
            at = s;
        }
        if (best >= depth) break;
    }
    if (best < depth) { /* a narrow summit between two samples */
        double a = at - spacing, b = at + spacing;
        for (int i = 0; i < halvings; ++i) {
            const double first = a + (b - a) / 3, second = b - (b - a) / 3;
            if (side * distance_on(shape, ray, first) < side * distance_on(shape, ray, second)) {
                b = second;
            } else {
                a = first;
            }
        }
        at = (a + b) / 2;
        if (at < from || at > to || -side * distance_on(shape, ray, at) < depth) return HUGE_VAL;
    }
    high = at;
    for (int i = 0; i < halvings; ++i) {
        const double middle = (low + high) / 2;
        if (-side * distance_on(shape, ray, middle) < depth) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

analytic_hit analytic_trace(const analytic_shape *shape, const reference_ray *ray, double depth) {
    analytic_hit hit = {HUGE_VAL, HUGE_VAL, 0};
    const real *o = ray->origin, *v = ray->direction;
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const double nearest = -(o[0] * v[0] + o[1] * v[1] + o[2] * v[2]) / (length * length);
    const double start = (ray->t_min - nearest) * length, end = (ray->t_max - nearest) * length;
    double knots[most_roots + 2], side;
    int count = 0, first = 0, next;
    line at;
    for (int axis = 0; axis < 3; ++axis) {
        at.d[axis] = v[axis] / length;
        at.p[axis] = o[axis] + nearest * v[axis];
    }
    side = distance_on(shape, &at, start) < 0 ? -1 : 1;
    count = all_roots(shape, &at, knots);
    for (int i = 0; i < count; ++i) { /* those outside the interval are moved to its ends */
        knots[i] = knots[i] < start ? start : knots[i] > end ? end : knots[i];
    }
    knots[count++] = end;
    sort(knots, count);
    while (first + 1 < count &&
           !(side * distance_on(shape, &at, (knots[first] + knots[first + 1]) / 2) < 0)) {
        ++first;
    }
    if (first + 1 == count) return hit;
    for (next = first + 1; next + 1 < count; ++next) {
        if (side * distance_on(shape, &at, (knots[next] + knots[next + 1]) / 2) > 0) break;
    }
    hit.t = nearest + knots[first] / length;
    hit.deep = nearest + first_deep(shape, &at, knots[first], knots[next], side, depth) / length;
    /* A forward difference: below a convex distance its line is a bound behind the crossing. */
    {
        const double h = 1e-6 * analytic_size(shape);
        const double crossing = distance_on(shape, &at, knots[first]);
        hit.cosine = side * (crossing - distance_on(shape, &at, knots[first] + h)) / h;
    }
    return hit;
}

static real distance_of(const void *user, const real position[3]) {
    const double p[3] = {position[0], position[1], position[2]};
    return (real)analytic_distance(user, p);
}

reference_field analytic_field(const analytic_shape *shape) {
    reference_field field = {distance_of, NULL, 1};
    field.user = shape;
    return field;
}
