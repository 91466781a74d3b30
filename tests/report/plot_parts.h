/* SPDX-License-Identifier: MIT
 *
 * What the files of plot.h share: scales and their ticks, text whose width is known about, looks.
 * Lengths are in units of the view box, about pixels. */
#ifndef TESTS_REPORT_PLOT_PARTS_H
#define TESTS_REPORT_PLOT_PARTS_H

#include <stdio.h>

#include "plot.h"

enum { plot_text_size = 14, plot_small_size = 12, plot_title_size = 16, plot_line_height = 18 };
enum { plot_most_ticks = 64, plot_most_lines = 4 };

/* The grey of text that is no data, and of lines. */
#define PLOT_INK "#222"

/* From values to lengths. low and high: of the axis, of the logarithm where it is logarithmic. */
typedef struct plot_scale {
    const plot_axis *axis;
    double low, high;
    double from, to; /* where low and high are drawn */
} plot_scale;

typedef struct plot_tick {
    double at;     /* the value */
    char text[40]; /* empty: a line of the fine grid, or a name */
    int power;     /* to stand high behind the text; plot_no_power: none */
    const char *name;
} plot_tick;
enum { plot_no_power = 9999 };

/* The range of an axis; vertical: of marks at its values. is_y: bars and errors begin at 0 there. */
plot_scale plot_scale_of(const plot *drawn, int is_y);
double plot_place(const plot_scale *scale, double value);
/* Whether a value can be drawn at all. */
int plot_has_place(const plot_scale *scale, double value);
/* Needs from and to; room: what a text takes of it. */
int plot_ticks(const plot_scale *scale, double room, plot_tick ticks[plot_most_ticks]);
double plot_tick_width(const plot_tick *tick);

/* About how wide a text is. */
double plot_width(const char *text, double size);

/* A text cut at spaces (and behind _ where cut_names) into lines of at most `width`, as far as its
 * words allow, at most `most`. */
typedef struct plot_lines {
    int count;
    double width; /* of the longest */
    char line[plot_most_lines][128];
} plot_lines;
plot_lines plot_wrap(const char *text, double width, double size, int most);

/* <text>; anchor: start, middle or end. attributes: further ones, or "". */
void plot_text(FILE *file, double x, double y, const char *anchor, const char *attributes,
               const char *text);
void plot_tick_text(FILE *file, double x, double y, const char *anchor, const plot_tick *tick);

/* Where a plot is drawn: the area within the axes, and the scales, which end at its edges. */
typedef struct plot_frame {
    const plot *drawn;
    double left, right, top, bottom;
    plot_scale x, y;
    int mark_row[plot_most_marks], mark_rows; /* of vertical marks' words, above the frame */
} plot_frame;

/* Words that lie on lines and points have a white border. */
extern const char plot_halo[];

/* Width that marks need on the right: among bars words have no place. */
double plot_mark_margin(const plot *drawn);
/* Gives the words of vertical marks rows; needs the scale of x. */
void plot_layout_marks(plot_frame *frame);
void plot_draw_marks(FILE *file, const plot_frame *frame);

void plot_draw_series(FILE *file, const plot_frame *frame);
/* The values of bars at their ends, where they are few. */
void plot_draw_values(FILE *file, const plot_frame *frame);

/* How much of the data lies in a box: what words there would hide. */
int plot_hidden(const plot_frame *frame, double left, double right, double top, double bottom);

typedef struct plot_look {
    const char *colour, *dash; /* dash: NULL: none */
    int marker, hollow, strong;
} plot_look;

/* A look by number, whatever it is. */
plot_look plot_look_at(int look);
void plot_marker(FILE *file, const plot_look *look, double x, double y, double radius);
/* The marker in white, for a bar of the look's colour. */
void plot_bar_marker(FILE *file, const plot_look *look, double x, double y);

#endif
