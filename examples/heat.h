/* SPDX-License-Identifier: MIT
 *
 * Numbers as colours: a palette of rising lightness, and the legend that says what they mean. */
#ifndef EXAMPLES_HEAT_H
#define EXAMPLES_HEAT_H

#include "image.h"

/* The colour (linear light) of a value between 0 and 1; values outside take the ends. */
void heat_colour(float value, float rgb[3]);

/* How high the legend strip is, in pixels. */
enum { heat_legend_height = 34 };

/* Draws the legend into the strip of that height from (x, y), width wide: a title, the palette,
 * and five numbers from 0 to largest, with the unit (such as " %") behind the last. */
void heat_legend(image *picture, int x, int y, int width, const char *title, double largest,
                 const char *unit);

/* Draws a text, 5x7 pixels a letter and 6 from one to the next, cut at the picture's edge. Lower
 * case letters are drawn as capitals. */
void heat_text(image *picture, int x, int y, const char *text, const float rgb[3]);

/* Its width in pixels. */
int heat_text_width(const char *text);

/* Fills a rectangle, cut at the picture's edge. */
void heat_fill(image *picture, int x, int y, int width, int height, const float rgb[3]);

#endif
