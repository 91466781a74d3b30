/* SPDX-License-Identifier: MIT
 *
 * The fields under test over float: what users trace. */
#define SHAPES_TABLE shapes_float
#define SHAPES_MATHEMATICS mathematics_float
#include "test_shapes_table.h"

const size_t shape_count = sizeof shapes_float / sizeof *shapes_float;
