/* SPDX-License-Identifier: MIT
 *
 * The four levels of what a scene leaves out, as parts of one section. */
#ifndef TESTS_REPORT_PAGE_LEFT_OUT_H
#define TESTS_REPORT_PAGE_LEFT_OUT_H

#include "../page.h"

void left_out_objects(page *out);
void left_out_loops(page *out);
void left_out_tiles(page *out);
void left_out_shaders(page *out);

#endif
