/* SPDX-License-Identifier: MIT
 *
 * What the tests of pages do again and again: check, ask the page, press what is on it, keep its
 * picture. Left out: the browser, and what is tested. */
#ifndef TESTS_GLSL_VIEWER_ASK_H
#define TESTS_GLSL_VIEWER_ASK_H

#include "viewer_browser.h"

/* Where pictures go. */
extern const char *folder;

extern int checks, failures;

/* The condition must hold; else the printf-style text is printed. */
void check(int good, const char *format, ...);

/* A number and a text of the page, by a printf-style expression of JavaScript. */
double number(const char *format, ...);
const char *text(const char *format, ...);

/* Loads a page, and waits for its picture; 0 where there is none. */
int load(const char *file);

/* Loads a page that must fail, and waits until it says so. */
void load_failing(const char *file);

/* Waits for the picture after what was done; 0 where none comes. */
int is_settled(const char *after);

/* Keeps the viewer's picture under a name of JavaScript. */
void keep(const char *name);

/* The share of the pixels that differ by more than `levels` of 255 between kept pictures. */
double differing(const char *one, const char *other, int levels);

/* The share of the pixels of the picture that have none of the colours of an expression. */
double strangers(const char *colours);

typedef struct place {
    double x, y;
} place;

/* A place on an element, by fractions of its sides; it is scrolled into view. */
place on(const char *id, double across, double down);

/* Clicks on an element, `across` of its width from its left side, and waits for the picture. */
void press_at(const char *id, double across);

/* In its middle. */
void press(const char *id);

/* Chooses by the label that is read there. */
void choose(const char *name, const char *label);

/* Leaves NAME.png in the folder. */
void screenshot(const char *name);

/* The page must not have complained since it was loaded. */
void no_complaints(const char *file);

#endif
