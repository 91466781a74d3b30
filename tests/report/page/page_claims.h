/* SPDX-License-Identifier: MIT
 *
 * The parts of the section on the papers' claims. */
#ifndef TESTS_REPORT_PAGE_CLAIMS_H
#define TESTS_REPORT_PAGE_CLAIMS_H

#include "../page.h"

/* The plots, by the claims that they belong to. */
void page_claims_steps(page *out);     /* 1, 2 */
void page_claims_error(page *out);     /* 3, 4, 5 */
void page_claims_levels(page *out);    /* 6, 7, 8 */
void page_claims_secondary(page *out); /* 9, 10 */

#endif
