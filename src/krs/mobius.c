/* SPDX-License-Identifier: MIT
 *
 * Möbius maps in double: how they are made and joined (Szécsi et al. 2016, section 6.2 and
 * Table 1), and what they do to points and vectors. Regions are in mobius_region.c. */
#include <spheretrace/mobius.h>
#include <spheretrace/shapes_math.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "mobius_build.h"
#include "quaternion.h"

static void write_pure(spt_quaternion q, double p[3]) {
    p[0] = q.x;
    p[1] = q.y;
    p[2] = q.z;
}

/* ---- How maps are made --------------------------------------------------------------------- */

static spt_mobius map_of(spt_quaternion a, spt_quaternion b, spt_quaternion c, spt_quaternion d,
                         int32_t orientation) {
    spt_mobius map;
    map.a = a;
    map.b = b;
    map.c = c;
    map.d = d;
    map.orientation = orientation;
    return map;
}

static spt_quaternion real_of(double real) {
    return spt_quaternion_of(real, 0.0, 0.0, 0.0);
}

static double larger(double a, double b) {
    return a > b ? a : b;
}

double spti_mobius_largest(const spt_mobius *map) {
    return larger(larger(spti_quaternion_largest(map->a), spti_quaternion_largest(map->b)),
                  larger(spti_quaternion_largest(map->c), spti_quaternion_largest(map->d)));
}

/* Writes a map whose entries are finite. */
static spt_status give(spt_mobius result, spt_mobius *map) {
    if (!spti_mobius_finite(&result)) return SPT_BAD_ARGUMENT;
    *map = result;
    return SPT_OK;
}

spt_mobius spt_mobius_identity(void) {
    return map_of(real_of(1.0), real_of(0.0), real_of(0.0), real_of(1.0), 1);
}

spt_status spt_mobius_dilation(double scale, spt_mobius *map) {
    const double size = fabs(scale);
    double root;
    if (map == NULL || !(size >= 1e-30 && size <= 1e30)) return SPT_BAD_ARGUMENT;
    root = sqrt(size);
    /* lambda = scale, so that a point reflection turns space over; 1/root rather than root/size
     * keeps |a d| = 1 */
    return give(map_of(real_of(scale < 0.0 ? -root : root), real_of(0.0), real_of(0.0),
                       real_of(1.0 / root), scale < 0.0 ? -1 : 1),
                map);
}

spt_status spt_mobius_translation(const double by[3], spt_mobius *map) {
    if (by == NULL || map == NULL || !spti_finite_3(by)) return SPT_BAD_ARGUMENT;
    return give(map_of(real_of(1.0), spti_pure(by), real_of(0.0), real_of(1.0), 1), map);
}

spt_status spt_mobius_rotation(const double axis[3], double angle, spt_mobius *map) {
    spt_quaternion turn;
    double sine;
    if (axis == NULL || map == NULL || !spti_finite_3(axis) || !(fabs(angle) <= 1e5) ||
        !(spti_quaternion_largest(spti_pure(axis)) > 0.0)) {
        return SPT_BAD_ARGUMENT;
    }
    sine = spti_shape_sin_double(0.5 * angle);
    turn = spt_quaternion_scaled(spti_quaternion_unit(spti_pure(axis)), sine);
    turn.real = spti_shape_cos_double(0.5 * angle);
    turn = spti_quaternion_unit(turn);
    return give(map_of(turn, real_of(0.0), real_of(0.0), turn, 1), map);
}

spt_status spt_mobius_reflection(const double normal[3], double offset, spt_mobius *map) {
    spt_quaternion unit;
    double length;
    if (normal == NULL || map == NULL || !spti_finite_3(normal) || !(fabs(offset) <= DBL_MAX)) {
        return SPT_BAD_ARGUMENT;
    }
    length = spti_quaternion_length(spti_pure(normal));
    if (!(length > 0.0)) return SPT_BAD_ARGUMENT;
    unit = spti_quaternion_unit(spti_pure(normal));
    /* n p n + 2 offset n = (n p + 2 offset) (-n)^-1, n^-1 being -n */
    return give(map_of(unit, real_of(2.0 * (offset / length)), real_of(0.0),
                       spt_quaternion_conjugate(unit), -1),
                map);
}

spt_status spt_mobius_inversion(const double center[3], double radius, spt_mobius *map) {
    spt_quaternion over, from, square;
    double under, factor, size;
    if (center == NULL || map == NULL || !spti_finite_3(center) ||
        !(radius > 0.0 && radius <= DBL_MAX)) {
        return SPT_BAD_ARGUMENT;
    }
    /* C - R^2 (p - C)^-1 = (C p + |C|^2 - R^2) (p - C)^-1, divided by R. The products with 1/R are
     * those that c p will have, so that the center is the pole to the bit. */
    under = 1.0 / radius;
    over = spt_quaternion_scaled(spti_pure(center), under);
    factor = 1.0 / spti_power_below(larger(spti_quaternion_largest(spti_pure(center)), radius));
    from = spt_quaternion_scaled(spti_pure(center), factor);
    size = radius * factor;
    square = spti_quaternion_sum_of_products(spt_quaternion_conjugate(from), from, real_of(-size),
                                             real_of(size));
    return give(map_of(over, real_of(square.real / size / factor), real_of(under),
                       spt_quaternion_conjugate(over), -1),
                map);
}

spt_status spt_mobius_matrix(spt_quaternion a, spt_quaternion b, spt_quaternion c, spt_quaternion d,
                             spt_mobius *map) {
    spt_mobius scaled = map_of(a, b, c, d, 1);
    double largest = spti_mobius_largest(&scaled), lambda, factor;
    if (map == NULL || !(largest > 0.0 && largest <= DBL_MAX)) return SPT_BAD_ARGUMENT;
    factor = 1.0 / spti_power_below(largest);
    scaled = map_of(spt_quaternion_scaled(a, factor), spt_quaternion_scaled(b, factor),
                    spt_quaternion_scaled(c, factor), spt_quaternion_scaled(d, factor), 1);
    if (!spti_in_group(&scaled, &lambda)) return SPT_BAD_ARGUMENT;
    factor = 1.0 / sqrt(fabs(lambda));
    return give(map_of(spt_quaternion_scaled(scaled.a, factor),
                       spt_quaternion_scaled(scaled.b, factor),
                       spt_quaternion_scaled(scaled.c, factor),
                       spt_quaternion_scaled(scaled.d, factor), lambda < 0.0 ? -1 : 1),
                map);
}

spt_status spt_mobius_compose(const spt_mobius *outer, const spt_mobius *inner,
                              spt_mobius *result) {
    if (outer == NULL || inner == NULL || result == NULL) return SPT_BAD_ARGUMENT;
    return give(map_of(spti_quaternion_sum_of_products(outer->a, inner->a, outer->b, inner->c),
                       spti_quaternion_sum_of_products(outer->a, inner->b, outer->b, inner->d),
                       spti_quaternion_sum_of_products(outer->c, inner->a, outer->d, inner->c),
                       spti_quaternion_sum_of_products(outer->c, inner->b, outer->d, inner->d),
                       outer->orientation * inner->orientation),
                result);
}

spt_mobius spt_mobius_inverse(const spt_mobius *map) {
    const double sign = map->orientation;
    return map_of(spt_quaternion_scaled(spt_quaternion_conjugate(map->d), sign),
                  spt_quaternion_scaled(spt_quaternion_conjugate(map->b), sign),
                  spt_quaternion_scaled(spt_quaternion_conjugate(map->c), sign),
                  spt_quaternion_scaled(spt_quaternion_conjugate(map->a), sign), map->orientation);
}

/* ---- Points and vectors -------------------------------------------------------------------- */

spt_quaternion spti_mobius_under(const spt_mobius *map, const double point[3]) {
    return spt_quaternion_sum(spt_quaternion_product(map->c, spti_pure(point)), map->d);
}

void spti_mobius_pole(const spt_mobius *map, double pole[3]) {
    if (spti_quaternion_largest(map->c) > 0.0) {
        write_pure(spti_quaternion_quotient(map->a, map->c), pole);
    } else {
        pole[0] = pole[1] = pole[2] = HUGE_VAL;
    }
}

/* |c| |p| + |d|: v is right to a few 2^-53 of it. */
static double under_reach(const spt_mobius *map, const double point[3]) {
    return spti_quaternion_length(map->c) * spti_quaternion_length(spti_pure(point)) +
           spti_quaternion_length(map->d);
}

/* Two forms, of which the one with the smaller error is taken: (a p + b) v^-1 as it stands, and,
 * since b - P d = lambda c*^-1, P + lambda c*^-1 v^-1 with P = a c^-1. The first loses lambda where
 * a p and b cancel (inversions in small spheres far from the origin), the second cancels itself
 * where P is far. */
double spti_mobius_image(const spt_mobius *map, const double point[3], double image[3]) {
    const spt_quaternion under = spti_mobius_under(map, point);
    const spt_quaternion over =
        spt_quaternion_sum(spt_quaternion_product(map->a, spti_pure(point)), map->b);
    const double reach = under_reach(map, point), length = spti_quaternion_length(under);
    const double a = spti_quaternion_length(map->a), c = spti_quaternion_length(map->c);
    const double plain =
        (a * spti_quaternion_length(spti_pure(point)) + spti_quaternion_length(map->b)) / length +
        spti_quaternion_length(over) / length * (reach / length);
    const double polar = c > 0.0 ? a / c + reach / length / length / c : HUGE_VAL;
    write_pure(spti_quaternion_quotient(over, under), image);
    /* Unless it is clearly worse, the form that the map is defined by. */
    if (4.0 * polar < plain) {
        const spt_quaternion direction = spt_quaternion_product(
            spti_quaternion_unit(map->c), spt_quaternion_conjugate(spti_quaternion_unit(under)));
        const double distance = map->orientation / c / length;
        double pole[3];
        spti_mobius_pole(map, pole);
        image[0] = pole[0] + direction.x * distance;
        image[1] = pole[1] + direction.y * distance;
        image[2] = pole[2] + direction.z * distance;
        return polar;
    }
    return plain;
}

void spti_mobius_turn(const spt_mobius *map, spt_quaternion v, const double vector[3],
                      double image[3]) {
    const spt_quaternion unit = spti_quaternion_unit(v);
    const spt_quaternion turned = spt_quaternion_product(
        spt_quaternion_product(unit, spti_pure(vector)), spt_quaternion_conjugate(unit));
    write_pure(spt_quaternion_scaled(turned, map->orientation), image);
}

/* Where v is nothing but rounding, the point is the pole as exactly as its coordinates can tell. */
static int is_pole(const spt_mobius *map, const double point[3], spt_quaternion under) {
    return spti_quaternion_length(under) <= 0x1p-50 * under_reach(map, point);
}

int spt_mobius_point(const spt_mobius *map, const double point[3], double image[3]) {
    double result[3];
    if (!spti_finite_3(point)) {
        spti_mobius_pole(map, result);
    } else if (is_pole(map, point, spti_mobius_under(map, point))) {
        result[0] = HUGE_VAL;
    } else {
        spti_mobius_image(map, point, result);
    }
    if (result[0] <= DBL_MAX && spti_finite_3(result)) {
        memcpy(image, result, sizeof result);
        return 1;
    }
    image[0] = image[1] = image[2] = HUGE_VAL;
    return 0;
}

double spt_mobius_scale(const spt_mobius *map, const double point[3]) {
    spt_quaternion under;
    double factor;
    if (!spti_finite_3(point)) {
        if (spti_quaternion_largest(map->c) > 0.0) return 0.0;
        under = map->d;
    } else {
        under = spti_mobius_under(map, point);
        if (is_pole(map, point, under)) return HUGE_VAL;
    }
    factor = 1.0 / spti_power_below(spti_quaternion_largest(under));
    return factor / spt_quaternion_square(spt_quaternion_scaled(under, factor)) * factor;
}

void spt_mobius_vector(const spt_mobius *map, const double point[3], const double vector[3],
                       double image[3]) {
    spt_quaternion under = spt_quaternion_of(0.0, 0.0, 0.0, 0.0);
    if (spti_finite_3(point)) {
        under = spti_mobius_under(map, point);
        if (is_pole(map, point, under)) under = spt_quaternion_scaled(under, 0.0);
    } else if (!(spti_quaternion_largest(map->c) > 0.0)) {
        under = map->d;
    }
    spti_mobius_turn(map, under, vector, image);
}
