/* SPDX-License-Identifier: MIT
 *
 * The shapes in double: what those in float are held against. */
#define SPT_SHAPES_DOUBLE
#define ACCURACY_TYPE double
#include "accuracy_shapes_table.h"
