/* SPDX-License-Identifier: MIT
 *
 * Quaternions where sizes and cancellation matter: what the arithmetic of mobius.h leaves out. */
#ifndef SPTI_QUATERNION_H
#define SPTI_QUATERNION_H

#include <spheretrace/mobius.h>

#include <float.h>

/* False for NaN as well as for the infinities. */
static inline int spti_finite_3(const double p[3]) {
    int axis, finite = 1;
    for (axis = 0; axis < 3; ++axis) finite &= p[axis] >= -DBL_MAX && p[axis] <= DBL_MAX;
    return finite;
}

static inline spt_quaternion spti_pure(const double p[3]) {
    return spt_quaternion_of(0.0, p[0], p[1], p[2]);
}

/* The power of two below x > 0, of those whose reciprocal is normal. */
double spti_power_below(double x);

/* The largest magnitude of a component, NaN passed over. */
double spti_quaternion_largest(spt_quaternion q);

/* |q|, and q / |q|, which is 0 where q is: neither over- nor underflows. */
double spti_quaternion_length(spt_quaternion q);
spt_quaternion spti_quaternion_unit(spt_quaternion q);

/* p q^-1, q != 0 */
spt_quaternion spti_quaternion_quotient(spt_quaternion p, spt_quaternion q);

/* p q + r s, as if in twice the precision and then rounded. */
spt_quaternion spti_quaternion_sum_of_products(spt_quaternion p, spt_quaternion q, spt_quaternion r,
                                               spt_quaternion s);

#endif
