/* SPDX-License-Identifier: MIT
 *
 * Chromium without a window, operated as a person would: by the mouse, fingers and keys, through
 * its DevTools protocol over a pipe. One browser at a time. Left out: what is to be seen there. */
#ifndef TESTS_GLSL_VIEWER_BROWSER_H
#define TESTS_GLSL_VIEWER_BROWSER_H

#include <stddef.h>

enum { BROWSER_MISSING = 77 };

/* Starts it, with a folder for its files and one flag more, or NULL. Returns 0, BROWSER_MISSING, or
 * 1 after a message. WebGL runs on SwiftShader, or on what VIEWER_ANGLE names: gl-egl for Mesa. */
int browser_open(const char *folder, const char *flag);
void browser_close(void);

/* The size of the window's inside. On a phone there are fingers instead of a mouse. */
void browser_screen(int width, int height, int density, int is_phone);

/* "dark" or "light": what the person prefers. */
void browser_scheme(const char *scheme);

/* Loads a page and waits until it is there; 0 where it is not. */
int browser_go(const char *url);

/* The value of an expression of JavaScript, promises awaited; NaN or "" where it throws. */
double browser_number(const char *expression);
const char *browser_text(const char *expression); /* until the next call */

/* Input. Places count pixels of CSS from the upper left corner. */
void browser_drag(double x, double y, double to_x, double to_y, const char *button);
void browser_wheel(double x, double y, double lower);
void browser_click(double x, double y);
void browser_key(const char *key, int code);

/* Fingers, one or two of them, move in a straight line. */
typedef struct browser_finger {
    double x, y, to_x, to_y;
} browser_finger;
void browser_touch(const browser_finger *fingers, int count);

/* Writes what is seen to a PNG file; 0 where it could not. */
int browser_screenshot(const char *path);

/* Since the page was loaded: scripts that threw, messages of errors in the console, and requests
 * for anything but the page itself. Each is printed. */
int browser_complaints(void);

#endif
