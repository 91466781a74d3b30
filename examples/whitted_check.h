/* SPDX-License-Identifier: MIT
 *
 * What the program whitted asserts of small pictures, without files. */
#ifndef EXAMPLES_WHITTED_CHECK_H
#define EXAMPLES_WHITTED_CHECK_H

/* Returns whether all is well, after a line for each thing that was looked at. */
int whitted_check(void);

#endif
