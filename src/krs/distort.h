/* SPDX-License-Identifier: MIT
 *
 * What the door to distorted fields shares with its kernels. */
#ifndef SPTI_DISTORT_H
#define SPTI_DISTORT_H

#include <spheretrace/krs.h>

#include "../backend/isa.h"

/* THE REGION of a distorted field is a convex set around the distorted body in which the constant
 * of W holds:
 *   twist, taper  around the axis between two heights, within a radius that is linear in the height
 *   bend          the same around `side`, the height being that along it
 *   sway          a box along the frame
 * A point outside stands for the region's nearest one, q: with e between the two, the field is
 *     sqrt((L e)^2 + f(W(q))^2)                                                             (1)
 * where f is positive. That is L-Lipschitz everywhere: q moves no faster than the point, and not at
 * all along the gradient of e, so that the two parts of (1) have gradients at right angles, each of
 * length L at most, and weights whose squares sum to 1. It is no more than L times the distance to
 * the body, since a plane at right angles to the way to q has all of the region behind it. So
 * cones, kernels of sequences and queries beyond the bound may ask anywhere.
 *
 * The region is kept in low and high of spt_distorted.bound, a cylinder or an oriented box, which
 * do not use them: radii at [0] and heights at [1], of a sway the sides of the box along the frame,
 * from the origin. */
typedef struct spti_region {
    float origin[3], frame[3][3];
    float low, high;               /* heights, */
    float radius_low, radius_high; /* radii at them, */
    float narrowest, widest;       /* the lesser and the greater of these */
    float rise, widening;          /* high - low, radius_high - radius_low, and */
    float inverse_square;          /* of the length of the slant side */
    float box_low[3], box_high[3]; /* of sway; nothing else of the above is */
    float rate, wave, phase;
} spti_region;

/* Takes in a deformation that is no map, whose numbers are finite, of a field that was copied to
 * made->inner and made->inner_bound: sets made->frame and made->bound, and distortion.lipschitz to
 * the constant of W. */
spt_status spti_distort_settle(spt_distorted *made);

typedef struct spti_distort_kernels {
    /* Where the inner field sees n points, n > 0 a multiple of 16; and the square of how far
     * outside of the region they are. Points are finite, arrays are aligned and do not overlap. All
     * kinds but maps. */
    void (*move)(const spt_distorted *distorted, size_t n, const float *x, const float *y,
                 const float *z, float *to_x, float *to_y, float *to_z, float *apart);
    /* (1), in place. */
    void (*settle)(float lipschitz, size_t n, const float *apart, float *distance);
    /* Gradients of the inner field become those of the distorted one, at the same points. */
    void (*pull)(const spt_distorted *distorted, size_t n, const float *x, const float *y,
                 const float *z, float *gradient_x, float *gradient_y, float *gradient_z);
} spti_distort_kernels;
extern const spti_distort_kernels *const spti_distort_kernels_of[];

#endif
