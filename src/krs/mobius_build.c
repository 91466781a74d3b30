/* SPDX-License-Identifier: MIT
 *
 * The group condition of Möbius maps, and maps rounded to float. */
#include "mobius_build.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "quaternion.h"

/* Images must be pure to this much of their size. */
static const double impure = 1e-5;

static double norm(spt_quaternion q) {
    return sqrt(spt_quaternion_square(q));
}

int spti_mobius_finite(const spt_mobius *map) {
    const spt_quaternion *entries[4] = {&map->a, &map->b, &map->c, &map->d};
    int i, finite = 1;
    for (i = 0; i < 4; ++i) {
        const double imaginary[3] = {entries[i]->x, entries[i]->y, entries[i]->z};
        finite &= fabs(entries[i]->real) <= DBL_MAX && spti_finite_3(imaginary);
    }
    return finite;
}

/* The real part of an image, times |v|^2, is |p|^2 Re(a* c) + Re(b* d) - p . Im(lambda), p pure and
 * v = c p + d: four points of one distance that are no plane's tell all of it, but for the first
 * two terms apart from each other. Points that happen to lie at the zero or the pole have images of
 * which nothing but rounding is left; that much, 2^-44 of what cancelled, is let pass. */
static int takes_space_to_itself(const spt_mobius *map) {
    static const double directions[4][3] = {
        {0.54, 0.63, 0.56}, {0.61, -0.52, -0.60}, {-0.59, 0.55, -0.59}, {-0.57, -0.58, 0.58}};
    const double a = norm(map->a), b = norm(map->b), c = norm(map->c), d = norm(map->d);
    /* where the terms of both sums weigh the same */
    const double radius = sqrt((b * b + d * d) / (a * a + c * c));
    const double size = (a * radius + b) * (c * radius + d);
    const spt_quaternion product = spt_quaternion_product(spt_quaternion_conjugate(map->a), map->c);
    int i;
    if (!(fabs(product.real) * radius * radius <= impure * size)) return 0;
    for (i = 0; i < 4; ++i) {
        const spt_quaternion point = spt_quaternion_scaled(
            spt_quaternion_of(0.0, directions[i][0], directions[i][1], directions[i][2]), radius);
        const spt_quaternion over =
            spt_quaternion_sum(spt_quaternion_product(map->a, point), map->b);
        const spt_quaternion under =
            spt_quaternion_sum(spt_quaternion_product(map->c, point), map->d);
        const spt_quaternion image = spt_quaternion_product(over, spt_quaternion_conjugate(under));
        if (!(fabs(image.real) <= impure * norm(over) * norm(under) + 0x1p-44 * size)) return 0;
    }
    return 1;
}

int spti_in_group(const spt_mobius *map, double *lambda) {
    const spt_quaternion sum =
        spt_quaternion_sum(spt_quaternion_product(spt_quaternion_conjugate(map->a), map->d),
                           spt_quaternion_product(spt_quaternion_conjugate(map->c), map->b));
    const double size = norm(map->a) * norm(map->d) + norm(map->b) * norm(map->c);
    *lambda = sum.real;
    return spti_mobius_finite(map) && fabs(sum.real) >= 1e-6 * size && fabs(sum.real) > 0.0 &&
           takes_space_to_itself(map);
}

int spti_map_ok(const spt_mobius *map) {
    double lambda;
    return (map->orientation == 1 || map->orientation == -1) && spti_in_group(map, &lambda) &&
           fabs(lambda * map->orientation - 1.0) <= 1e-5;
}

/* Returns the length of what is kept: components that are no normal floats are not. */
static double round_entry(spt_quaternion q, float rounded[4]) {
    const double components[4] = {q.real, q.x, q.y, q.z};
    double square = 0.0;
    int i;
    for (i = 0; i < 4; ++i) {
        const double kept = fabs(components[i]) < (double)FLT_MIN ? 0.0 : components[i];
        rounded[i] = (float)kept;
        square += kept * kept;
    }
    return sqrt(square);
}

/* p q / |c|^2; 0 where float cannot hold it. */
static int round_pole(spt_quaternion p, spt_quaternion q, double c_length, float pole[3]) {
    const spt_quaternion product =
        spt_quaternion_scaled(spt_quaternion_product(p, q), 1.0 / c_length);
    const double image[3] = {product.x / c_length, product.y / c_length, product.z / c_length};
    int axis;
    for (axis = 0; axis < 3; ++axis) {
        if (!(fabs(image[axis]) <= (double)FLT_MAX)) return 0;
        pole[axis] = (float)image[axis];
    }
    return 1;
}

/* How the preimage is computed: by quaternions, or by an inversion between the image of infinity and
 * the center. With q - center = -lambda c* (p - pole) c / (|c|^4 |p - pole|^2) the matrix is a rotation
 * or reflection over |c|^2. Where the center is near, seen in inversion radii, this loses less than
 * the sums d* p + b* do, which cancel; for maps that are nearly similar ones it is the other way
 * round. Judged at the image of the origin. */
static void build_inversion(const spt_mobius *map, double c_length, spt_built_map *built) {
    const spt_quaternion c = spt_quaternion_scaled(map->c, 1.0 / c_length);
    const spt_quaternion back = spt_quaternion_conjugate(c);
    const double origin[3] = {0, 0, 0}, factor = -map->orientation / (c_length * c_length);
    double image[3], reach[3] = {0, 0, 0};
    for (int axis = 0; axis < 3; ++axis) {
        const spt_quaternion unit =
            spt_quaternion_of(0, axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0);
        const spt_quaternion turned = spt_quaternion_product(spt_quaternion_product(back, unit), c);
        built->matrix[axis] = (float)(factor * turned.x);
        built->matrix[3 + axis] = (float)(factor * turned.y);
        built->matrix[6 + axis] = (float)(factor * turned.z);
    }
    built->c_inverse = (float)(1.0 / (c_length * c_length));
    if (!(built->c_inverse >= FLT_MIN && built->c_inverse <= FLT_MAX)) return;
    if (!spt_mobius_point(map, origin, image)) {
        built->inverts = 1;
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        reach[0] += fabs(image[axis]);
        reach[1] += fabs((double)built->pole[axis]);
        reach[2] += fabs((double)built->center[axis]);
    }
    const double u = sqrt(spt_mobius_scale(map, origin)); /* |DL| = |u|^2 at the image */
    const double sums = (norm(map->d) * reach[0] + norm(map->b)) / u;
    built->inverts = reach[2] + (reach[0] + reach[1]) / (u * u) <= 2 * sums;
}

int spti_build_map(const spt_mobius *map, spt_built_map *built) {
    const double most = 0x1p63;
    spt_built_map result;
    double a_length, c_length, least;
    int axis;
    if (!spti_map_ok(map)) return 0;
    if (!(norm(map->a) <= most && norm(map->b) <= most && norm(map->c) <= most &&
          norm(map->d) <= most)) {
        return 0;
    }
    a_length = round_entry(map->a, result.a);
    round_entry(map->b, result.b);
    c_length = round_entry(map->c, result.c);
    round_entry(map->d, result.d);
    result.c_length = (float)c_length;
    result.orientation = (float)map->orientation;
    result.inverts = 0;
    result.c_inverse = 0.0f;
    memset(result.matrix, 0, sizeof result.matrix);
    memset(result.whole, 0, sizeof result.whole);
    result.whole[3] = FLT_MAX;
    for (axis = 0; axis < 3; ++axis) {
        result.pole[axis] = INFINITY;
        result.center[axis] = 0.0f;
    }
    if (c_length > 0.0) {
        /* L and its inverse at infinity: a c^-1 and d* c*^-1 */
        const spt_quaternion conjugate = spt_quaternion_conjugate(map->c);
        const spt_quaternion back = spt_quaternion_conjugate(map->d);
        if (!round_pole(map->a, conjugate, c_length, result.pole)) return 0;
        if (!round_pole(back, map->c, c_length, result.center)) return 0;
        build_inversion(map, c_length, &result);
    }
    /* u = a - p c is off by about 2^-23 |a| where it cancels, p being float. */
    least = 0x1p-22 * a_length;
    if (least < 0x1p-60 * c_length) least = 0x1p-60 * c_length;
    if (least < (double)FLT_MIN) least = (double)FLT_MIN;
    result.least = (float)least;
    *built = result;
    return 1;
}
