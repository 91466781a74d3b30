/* SPDX-License-Identifier: MIT
 *
 * THE LIST of the page's sections, from top to bottom: SECTION(NAME) is the function page_NAME
 * (page.h) of page/. */
SECTION(summary)
SECTION(error)
SECTION(claims)
SECTION(stability)
SECTION(accuracy)
SECTION(left_out)
SECTION(choosing)
SECTION(about)
