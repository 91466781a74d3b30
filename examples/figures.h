/* SPDX-License-Identifier: MIT
 *
 * The figures of Keinert et al. 2014 as pairs, without and with what they show (figures.c): views of
 * scenes traced in batches by the public calls, measurements, pictures put together from panels. */
#ifndef EXAMPLES_FIGURES_H
#define EXAMPLES_FIGURES_H

#include "image.h"
#include "scenes/scenes.h"

/* What is wanted of every figure. */
typedef struct figure_wish {
    int width, height;  /* of a panel */
    const char *folder; /* for pictures and tables; NULL: measure only */
} figure_wish;

/* Each measures, prints what it found, and draws if wanted. Returns whether the measurements show
 * what the figure is to show, and the files were written; says what went wrong. */
int figure_7(const figure_wish *wish);  /* iterations in a city: over-relaxation */
int figure_8(const figure_wish *wish);  /* outlines: the screen-space candidate */
int figure_9(const figure_wish *wish);  /* f at the hits: discontinuity reduction */
int figure_10(const figure_wish *wish); /* the same seen in a texture */

/* Whether a condition holds; prints the words if it does not. */
int figure_expect(int holds, const char *words);

/* ---- A scene seen by its camera (figures_view.c) --------------------------------------------- */

typedef struct figure_view {
    const scene *shown;
    spt_field field;
    spt_settings settings; /* the defaults, and the view's half pixel */
    int width, height;
    size_t count;
    int failed;    /* a call was refused, which was said */
    spt_ray *rays; /* row by row */
    spt_hit *hits;
    float *t;       /* what is shown of each pixel; +infinity: the background */
    float *normals; /* there: x, y, z; zero for the background */
} figure_view;

/* Returns 0, after a message, where memory ran out or there is no such scene. */
int figure_open(figure_view *view, const char *scene_name, const figure_wish *wish);
void figure_close(figure_view *view);

/* Traces all rays and shows the hits. Returns evaluations a ray. */
double figure_trace(figure_view *view);

/* So many rounds of discontinuity reduction, and shows the hits. */
void figure_refine(figure_view *view, uint32_t rounds);

/* The normals of what is shown. */
void figure_find_normals(figure_view *view);

/* The shown point of a pixel, and half a pixel there in world length. */
void figure_point(const figure_view *view, size_t pixel, float point[3]);
float figure_half_pixel(const figure_view *view, size_t pixel);

/* ---- Pictures of panels (figures_sheet.c) ---------------------------------------------------- */

/* Panels in columns and rows, each below its caption. */
typedef struct figure_sheet {
    image picture;
    int panel_width, panel_height;
} figure_sheet;

/* A black sheet; picture.pixels is NULL where memory ran out. */
figure_sheet figure_sheet_of(int columns, int rows, int panel_width, int panel_height);

/* Where a panel begins. */
void figure_place(const figure_sheet *sheet, int column, int row, int *left, int *top);

/* A caption of up to two lines, or a legend from 0 to `largest` with a title. */
void figure_caption(figure_sheet *sheet, int column, int row, const char *text);
void figure_legend(figure_sheet *sheet, int column, int row, const char *title, double largest,
                   const char *unit);

/* The linear light of a pixel of a view. */
typedef void figure_colour_fn(const figure_view *view, size_t pixel, float rgb[3]);
figure_colour_fn figure_normal_colour; /* the normal's components as red, green and blue */

/* Fills a panel with the view, or with what is around one of its pixels, `times` as large. */
void figure_paint(figure_sheet *sheet, int column, int row, const figure_view *view,
                  figure_colour_fn *colour);
void figure_paint_close(figure_sheet *sheet, int column, int row, const figure_view *view,
                        figure_colour_fn *colour, int middle_x, int middle_y, int times);

/* Sunlight and light of the sky on a surface, as a factor of its albedo. */
float figure_daylight(const float normal[3]);

/* Writes the sheet to a file of the wished folder and frees it. Returns 0 after a message. */
int figure_sheet_write(figure_sheet *sheet, const figure_wish *wish, const char *name);

#endif
