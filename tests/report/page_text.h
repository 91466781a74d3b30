/* SPDX-License-Identifier: MIT
 *
 * Text as HTML and SVG want it. Left out: where it may stand, see page.c. */
#ifndef TESTS_REPORT_PAGE_TEXT_H
#define TESTS_REPORT_PAGE_TEXT_H

#include <stdarg.h>
#include <stdio.h>

/* Escapes what means something in elements and attributes. */
void page_escape(FILE *html, const char *text);

/* The signs of page_words(): `code`, *emphasis*, ^what a paper says^; 10^-4 stands high. */
void page_markup(FILE *html, const char *text);
void page_markup_format(FILE *html, const char *format, va_list arguments);

/* A number as page_number() shows it: 1.2e+06 becomes 1.2e6, long ones have narrow spaces. */
void page_rounded(FILE *html, const char *format, double number);

#endif
