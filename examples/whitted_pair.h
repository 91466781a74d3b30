/* SPDX-License-Identifier: MIT
 *
 * Pictures of the Whitted renderer: a world as it is shown, and a pair that compares. */
#ifndef EXAMPLES_WHITTED_PAIR_H
#define EXAMPLES_WHITTED_PAIR_H

#include "image.h"
#include "whitted.h"

/* A picture in colours that can be shown, each pixel of four rays; pixels is NULL where it failed. */
image whitted_shown(glass_world *world, whitted_settings *settings, int width, int height,
                    whitted_statistics *statistics);

/* Writes the pair: the world "glass" without and with the optimisation for convex bodies, and the
 * evaluations of the rays inside. Prints what they took, by processor time, in rounds that take
 * turns. Returns whether it came about. */
int whitted_pair(const char *path);

#endif
