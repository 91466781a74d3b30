/* SPDX-License-Identifier: MIT
 *
 * What every user of a bounding volume needs: it is checked, and made ready for the kernels; and
 * the caller's own volumes are asked. */
#ifndef SPTI_BOUND_CHECK_H
#define SPTI_BOUND_CHECK_H

#include <spheretrace/bound.h>

/* Rays that a caller's volume is asked for at once are a multiple of this many. */
enum { SPTI_BOUND_GROUP = 16 };

/* Takes in a caller's volume; 0 where it breaks its rules. A copy holds what follows from the
 * volume in members that its kind does not use, and may be copied again:
 *   low, high   of every kind the box around it; of slab, polytope and callback the caller's, which
 *               may be infinite. What knows but spheres and boxes takes it for this box
 *   axis[0]     capsule, cylinder: along its axis, of length 1, or x where it has none;
 *   half[0]         and its length
 *   end         ellipsoid: half[i] over the longest;
 *   radius          the longest;
 *   range[0]        and how much longer than a vector its image can be where the ellipsoid is a
 *                   ball of that radius
 *   radius      slab, polytope: the farthest plane's distance from the origin of coordinates */
int spti_bound_copy(spt_bound *to, const spt_bound *from);

/* The largest finite magnitude among the coordinates of a copy. */
float spti_bound_size(const spt_bound *bound);

/* spt_bound_interval() of a copy, for a ray that is known to be good. */
void spti_bound_interval(const spt_bound *copy, const float origin[3], const float direction[3],
                         float t_min, float t_max, float *t_in, float *t_out);

/* Whether the kernels know only the box of a copy, and spti_bound_ask() knows more. */
static inline int spti_bound_asks(const spt_bound *bound) {
    return bound != NULL && bound->kind == SPT_BOUND_CALLBACK;
}

/* Asks a caller's own volume for n rays. Arrays are aligned to 64 bytes; those of the rays are
 * filled up to whole groups by copies. What is not answered is NaN. */
void spti_bound_ask(const spt_bound *bound, size_t n, const float *const origin[3],
                    const float *const direction[3], float *t_in, float *t_out);

/* Cuts an interval with an answer, whose NaN is no constraint. Returns whether anything is left. */
static inline int spti_bound_cut(float t_in, float t_out, float *t_min, float *t_max) {
    /* Quiet comparisons: no answer is no fault. */
    if (isgreater(t_in, *t_min)) *t_min = t_in;
    if (isless(t_out, *t_max)) *t_max = t_out;
    return *t_min <= *t_max;
}

#endif
