/* SPDX-License-Identifier: MIT
 *
 * What Möbius maps do to balls, outsides and half spaces, by center and radius; the coefficients of
 * Szécsi et al. 2016, appendices A and B; and the exit from an unbounding ball (section 6). */
#include <spheretrace/mobius.h>

#include <float.h>
#include <math.h>

#include "mobius_build.h"
#include "quaternion.h"

/* A boundary that passes the pole this closely, of its distance, has a plane as its image. */
static const double passes = 0x1p-40;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The unit vector c v* / (|c| |v|), times orientation, which points from L(infinity) to L(p) where
 * v = c p + d; 0 where c or v is. */
static void from_pole(const spt_mobius *map, spt_quaternion v, double direction[3]) {
    const spt_quaternion product = spt_quaternion_product(
        spti_quaternion_unit(map->c), spt_quaternion_conjugate(spti_quaternion_unit(v)));
    direction[0] = product.x * map->orientation;
    direction[1] = product.y * map->orientation;
    direction[2] = product.z * map->orientation;
}

/* ---- Images of regions --------------------------------------------------------------------- */

/* Of a ball or its outside: k' = L(k) + (L(k) - P) m / (1 - m) with P = L(infinity) and
 * m = (radius |c| / |v|)^2 (algorithms: 8.5), or P + (L(k) - P) / (1 - m) where the ball contains
 * the pole; L(k) - P = direction / (|c| |v|), and all else is written so that nothing cancels. */
static void image_of_ball(const spt_mobius *map, const spt_region *region, spt_region *image) {
    const double k = region->radius, c = spti_quaternion_length(map->c);
    const spt_quaternion under = spti_mobius_under(map, region->center);
    const double v = spti_quaternion_length(under), reach = k * c, gap = v - reach;
    const int ball = region->kind == SPT_REGION_BALL;
    double direction[3], pole[3], anchor[3], shift;
    int axis;
    from_pole(map, under, direction);
    spti_mobius_pole(map, pole);
    if (fabs(gap) <= passes * v) {
        /* The plane midway between P and L(k); L(k) is on the ball's side. */
        const double sign = ball ? -1.0 : 1.0;
        image->kind = SPT_REGION_HALF_SPACE;
        for (axis = 0; axis < 3; ++axis) image->center[axis] = sign * direction[axis];
        image->radius = dot(image->center, pole) + sign * 0.5 / c / v;
        return;
    }
    image->kind = (gap > 0.0) == ball ? SPT_REGION_BALL : SPT_REGION_OUTSIDE;
    image->radius = k / fabs(gap) / (v + reach);
    if (gap > 0.0) {
        spti_mobius_image(map, region->center, anchor);
        shift = image->radius * (reach / v);
    } else {
        for (axis = 0; axis < 3; ++axis) anchor[axis] = pole[axis];
        shift = -image->radius * (v / reach);
    }
    for (axis = 0; axis < 3; ++axis) image->center[axis] = anchor[axis] + shift * direction[axis];
}

/* Of a half space to a half space. Of the points that the image's boundary passes, P = L(infinity)
 * and the image of the plane's point nearest to the origin, the one that is better known. */
static void image_of_plane(const spt_mobius *map, const double normal[3], double offset,
                           const double across[3], spt_region *image) {
    const double foot[3] = {normal[0] * offset, normal[1] * offset, normal[2] * offset};
    const spt_quaternion under = spti_mobius_under(map, foot);
    const double c = spti_quaternion_length(map->c);
    double anchor[3], error = HUGE_VAL;
    int axis;
    if (spti_quaternion_length(under) > 0.0) error = spti_mobius_image(map, foot, anchor);
    if (error * c <= spti_quaternion_length(map->a)) {
        spti_mobius_turn(map, under, normal, image->center);
    } else {
        spti_mobius_pole(map, anchor);
        for (axis = 0; axis < 3; ++axis) image->center[axis] = -across[axis];
    }
    image->kind = SPT_REGION_HALF_SPACE;
    image->radius = dot(image->center, anchor);
}

/* Of a half space. With p0 the pole, s = offset - normal . p0 how far it is inside and
 * m = lambda c n c^-1, the image's boundary passes P and, opposite, P - m / (s |c|^2). */
static void image_of_half_space(const spt_mobius *map, const spt_region *region,
                                spt_region *image) {
    const double length = spti_quaternion_length(spti_pure(region->center));
    const double offset = region->radius / length, c = spti_quaternion_length(map->c);
    const spt_quaternion unit = spti_quaternion_unit(map->c);
    const spt_quaternion to_pole =
        spt_quaternion_product(spt_quaternion_conjugate(unit), map->d); /* -|c| p0 */
    const double normal[3] = {region->center[0] / length, region->center[1] / length,
                              region->center[2] / length};
    const double inside = offset * c + (normal[0] * to_pole.x + normal[1] * to_pole.y +
                                        normal[2] * to_pole.z); /* s |c| */
    double across[3], pole[3], size = spti_quaternion_length(map->d);
    int axis;
    if (size < fabs(offset) * c) size = fabs(offset) * c;
    spti_mobius_turn(map, unit, normal, across);
    if (fabs(inside) <= passes * size) {
        image_of_plane(map, normal, offset, across, image);
        return;
    }
    spti_mobius_pole(map, pole);
    image->kind = inside > 0.0 ? SPT_REGION_OUTSIDE : SPT_REGION_BALL;
    image->radius = 0.5 / fabs(inside) / c;
    for (axis = 0; axis < 3; ++axis) {
        image->center[axis] = pole[axis] - 0.5 / inside / c * across[axis];
    }
}

static int region_ok(const spt_region *region) {
    double length;
    if (!spti_finite_3(region->center) || !(fabs(region->radius) <= DBL_MAX)) return 0;
    if (region->kind == SPT_REGION_BALL || region->kind == SPT_REGION_OUTSIDE) {
        return region->radius > 0.0;
    }
    length = spti_quaternion_length(spti_pure(region->center));
    return region->kind == SPT_REGION_HALF_SPACE && fabs(length - 1.0) <= 1e-6;
}

spt_status spt_mobius_region(const spt_mobius *map, const spt_region *region, spt_region *image) {
    spt_region result;
    if (map == NULL || region == NULL || image == NULL || !region_ok(region)) {
        return SPT_BAD_ARGUMENT;
    }
    if (region->kind == SPT_REGION_HALF_SPACE) {
        image_of_half_space(map, region, &result);
    } else {
        image_of_ball(map, region, &result);
    }
    if (!region_ok(&result)) return SPT_BAD_ARGUMENT;
    *image = result;
    return SPT_OK;
}

/* ---- Coefficients -------------------------------------------------------------------------- */

spt_sphere_coefficients spt_region_coefficients(const spt_region *region) {
    const double sign = region->kind == SPT_REGION_OUTSIDE ? -1.0 : 1.0;
    spt_sphere_coefficients sphere;
    int axis;
    if (region->kind == SPT_REGION_HALF_SPACE) {
        sphere.alpha = 0.0;
        for (axis = 0; axis < 3; ++axis) sphere.beta[axis] = -region->center[axis];
        sphere.gamma = -2.0 * region->radius;
        return sphere;
    }
    sphere.alpha = sign;
    for (axis = 0; axis < 3; ++axis) sphere.beta[axis] = sign * region->center[axis];
    sphere.gamma = sign * (dot(region->center, region->center) - region->radius * region->radius);
    return sphere;
}

/* x* beta y */
static spt_quaternion between(spt_quaternion x, spt_quaternion beta, spt_quaternion y) {
    return spt_quaternion_product(spt_quaternion_product(spt_quaternion_conjugate(x), beta), y);
}

/* Appendix A. The real part of beta' is 0 in the group, and left out. */
static void pull_back(const spt_mobius *map, const spt_sphere_coefficients *image,
                      double numbers[5]) {
    const spt_quaternion beta = spti_pure(image->beta);
    const spt_quaternion a = map->a, b = map->b, c = map->c, d = map->d;
    const spt_quaternion ba = spt_quaternion_product(spt_quaternion_conjugate(b), a);
    const spt_quaternion dc = spt_quaternion_product(spt_quaternion_conjugate(d), c);
    const spt_quaternion moved = spt_quaternion_sum(
        spt_quaternion_sum(spt_quaternion_scaled(ba, image->alpha), between(d, beta, a)),
        spt_quaternion_sum(between(b, spt_quaternion_conjugate(beta), c),
                           spt_quaternion_scaled(dc, image->gamma)));
    numbers[0] = image->alpha * spt_quaternion_square(a) + 2.0 * between(c, beta, a).real +
                 image->gamma * spt_quaternion_square(c);
    numbers[1] = moved.x;
    numbers[2] = moved.y;
    numbers[3] = moved.z;
    numbers[4] = image->alpha * spt_quaternion_square(b) + 2.0 * between(d, beta, b).real +
                 image->gamma * spt_quaternion_square(d);
}

spt_sphere_coefficients spt_mobius_pull_back(const spt_mobius *map,
                                             const spt_sphere_coefficients *image) {
    const double largest_entry = spti_mobius_largest(map);
    const double factor = 1.0 / spti_power_below(largest_entry);
    spt_mobius scaled = *map;
    spt_sphere_coefficients result;
    double numbers[5], largest = 0.0;
    int i;
    /* Squares of the entries need not be finite. */
    scaled.a = spt_quaternion_scaled(map->a, factor);
    scaled.b = spt_quaternion_scaled(map->b, factor);
    scaled.c = spt_quaternion_scaled(map->c, factor);
    scaled.d = spt_quaternion_scaled(map->d, factor);
    pull_back(&scaled, image, numbers);
    for (i = 0; i < 5; ++i) {
        if (fabs(numbers[i]) > largest) largest = fabs(numbers[i]);
    }
    for (i = 0; i < 5 && largest > 0.0; ++i) numbers[i] /= largest;
    result.alpha = numbers[0];
    for (i = 0; i < 3; ++i) result.beta[i] = numbers[1 + i];
    result.gamma = numbers[4];
    return result;
}

/* ---- Lines --------------------------------------------------------------------------------- */

/* Appendix B as A t^2 + 2 B t + C = 0. With e = alpha origin - beta the discriminant
 * B^2 - A C = |w|^2 (|beta|^2 - alpha gamma) - |e x w|^2: its large parts do not cancel. */
int spt_sphere_meets_line(const spt_sphere_coefficients *sphere, const double origin[3],
                          const double direction[3], double t[2]) {
    const double *beta = sphere->beta, *w = direction;
    const double e[3] = {sphere->alpha * origin[0] - beta[0], sphere->alpha * origin[1] - beta[1],
                         sphere->alpha * origin[2] - beta[2]};
    const double across[3] = {e[1] * w[2] - e[2] * w[1], e[2] * w[0] - e[0] * w[2],
                              e[0] * w[1] - e[1] * w[0]};
    const double a = sphere->alpha * dot(w, w), b = dot(e, w);
    const double c = dot(e, origin) - dot(beta, origin) + sphere->gamma;
    const double square =
        dot(w, w) * (dot(beta, beta) - sphere->alpha * sphere->gamma) - dot(across, across);
    double q, larger, smaller;
    if (fabs(a) <= 0.0) {
        if (fabs(b) <= 0.0) return 0;
        t[0] = -0.5 * c / b;
        return fabs(t[0]) <= DBL_MAX;
    }
    if (!(square >= 0.0)) return 0;
    /* of two roots the one that does not cancel, and the other by their product c / a */
    q = b < 0.0 ? sqrt(square) - b : -sqrt(square) - b;
    larger = q / a;
    smaller = fabs(q) > 0.0 && square > 0.0 ? c / q : larger;
    if (!(fabs(larger) <= DBL_MAX)) { /* all but a plane */
        t[0] = smaller;
        return fabs(smaller) <= DBL_MAX;
    }
    t[0] = smaller < larger ? smaller : larger;
    t[1] = smaller < larger ? larger : smaller;
    return 2;
}

/* Algorithms: 8.8, divided by rho so that an infinite one needs no rule of its own: with
 * u = a - x c, n = (x - P) / |x - P| = -u c* / (|u| |c|), g = n . w and s = |n x w|
 *     t = |u|^2 / (sqrt(rho^-2 - |c|^2 |u|^2 s^2) - |c| |u| g). */
double spt_mobius_exit(const spt_mobius *map, const double point[3], const double direction[3],
                       double rho) {
    const spt_quaternion u = spt_quaternion_sum(
        map->a, spt_quaternion_product(spt_quaternion_conjugate(spti_pure(point)), map->c));
    const spt_quaternion away = spt_quaternion_product(
        spti_quaternion_unit(u), spt_quaternion_conjugate(spti_quaternion_unit(map->c)));
    const double c = spti_quaternion_length(map->c), length = spti_quaternion_length(u);
    const double n[3] = {-away.x, -away.y, -away.z}, *w = direction;
    const double across[3] = {n[1] * w[2] - n[2] * w[1], n[2] * w[0] - n[0] * w[2],
                              n[0] * w[1] - n[1] * w[0]};
    const double along = dot(n, w), sine = sqrt(dot(across, across));
    const double most = c * length, inverse = 1.0 / rho;
    double root;
    /* At P the preimage is at infinity, and nothing is known. */
    if (!(rho > 0.0 && inverse <= DBL_MAX) ||
        length <= 0x1p-50 * (spti_quaternion_length(map->a) +
                             spti_quaternion_length(spti_pure(point)) * c)) {
        return 0.0;
    }
    if (!(inverse >= most * sine) || (along >= 0.0 && !(inverse > most))) return HUGE_VAL;
    root = sqrt(inverse - most * sine) * sqrt(inverse + most * sine);
    if (along > 0.0) {
        return length * ((root + most * along) / (inverse - most)) * (length / (inverse + most));
    }
    return length / (root - most * along) * length;
}
