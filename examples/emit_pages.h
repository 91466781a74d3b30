/* SPDX-License-Identifier: MIT
 *
 * The texts of the pages that emit writes: the files of examples/pages, compiled in by the
 * Makefile, a string a line and NULL behind the last. */
#ifndef EXAMPLES_EMIT_PAGES_H
#define EXAMPLES_EMIT_PAGES_H

extern const char *const page_viewer_html[];
extern const char *const page_viewer_css[];
extern const char *const page_viewer_orbit_js[];
extern const char *const page_viewer_draw_js[];
extern const char *const page_viewer_panel_js[];
extern const char *const page_viewer_js[];
extern const char *const page_hybrid_html[];
extern const char *const page_hybrid_js[];
extern const char *const page_three_html[];
extern const char *const page_three_js[];

#endif
