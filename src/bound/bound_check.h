/* SPDX-License-Identifier: MIT
 *
 * What every user of a bounding volume asks before it is used. */
#ifndef SPTI_BOUND_CHECK_H
#define SPTI_BOUND_CHECK_H

#include <spheretrace/bound.h>

/* Takes in a caller's volume; 0 where it breaks its rules. */
int spti_bound_copy(spt_bound *to, const spt_bound *from);

/* The largest magnitude among the coordinates of the volume. */
float spti_bound_size(const spt_bound *bound);

#endif
