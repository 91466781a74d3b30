/* SPDX-License-Identifier: MIT
 *
 * The parts of the suite for shapes.h that are not about fields as a whole, a file each. */
#ifndef TESTS_TEST_SHAPES_PARTS_H
#define TESTS_TEST_SHAPES_PARTS_H

void shapes_mathematics(void);
void shapes_operators(void);
void shapes_builders(void);

#endif
