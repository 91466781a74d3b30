/* SPDX-License-Identifier: MIT
 *
 * The rays of a chunk in a caller's own bounding volume. */
#ifndef SPTI_NARROW_H
#define SPTI_NARROW_H

#include "driver.h"

/* Asks the volume for count prepared rays, all alive, whose t_min before any bound is in
 * SPTI_PROBE; cuts their intervals, and finds those that stay outside (fates). Returns whether
 * there are any. */
int spti_narrow_chunk(const spti_call *call, spti_chunk *chunk, size_t count);

#endif
