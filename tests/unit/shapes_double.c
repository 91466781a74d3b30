/* SPDX-License-Identifier: MIT
 *
 * The fields under test over double: what they mean, to hold the float ones against. */
#define SPT_SHAPES_DOUBLE
#define SHAPES_TABLE shapes_double
#define SHAPES_MATHEMATICS mathematics_double
#include "test_shapes_table.h"
