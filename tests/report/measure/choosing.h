/* SPDX-License-Identifier: MIT
 *
 * What the parts that choose the defaults share: extreme fields, and rays with the truth about
 * them. What is swept, and the rule, stand in oracle/choice.h. */
#ifndef TESTS_REPORT_CHOOSING_H
#define TESTS_REPORT_CHOOSING_H

#include <oracle/choice.h>

#include "../report.h"

/* Fields that are distance bounds, but thin, steep or far too small, and fields that are none. */
enum { choosing_stiff_count = 6, choosing_wild_count = 7 };
scene choosing_stiff(int number);
scene choosing_wild(int number);

/* Whether a field is a distance bound: the wild ones are none, nor is the Mandelbulb's estimate. */
int choosing_is_bound(const scene *shown);

/* The rays of a picture for one stop (choice.h), and where the last hit of each may lie
 * (bench/truth.h). A quick report takes every second ray in each direction. */
typedef struct choosing_view {
    scene shown;
    int stop;
    int bound; /* whether it is a distance bound */
    size_t count;
    float pixel_radius;
    spt_ray *rays;
    spt_hit *hits;
    double *last_t;
} choosing_view;

choosing_view *choosing_view_of(const report_options *options, const scene *shown, int stop);
void choosing_view_free(choosing_view *view);

/* What became of the rays. A ray that ran out of budget is undecided, and neither lost nor late. */
typedef struct choosing_count {
    double evaluations, fallbacks; /* a ray */
    uint64_t lost;                 /* missed what is there, */
    uint64_t late;                 /* or hit behind it */
    uint64_t flagged;              /* of both those that said so (SPT_FLAG_STEEP) */
    uint64_t wrong;                /* hits where nothing is */
    uint64_t undecided;
} choosing_count;

choosing_count choosing_trace(const choosing_view *view, const spt_settings *settings);

/* What sweep.csv says of every value of every sweep: the ten kinds, then the stiff fields. And of
 * the step rules with the settings of the header, as a sweep of its own. */
enum { choosing_fields = choice_kinds + choosing_stiff_count, choosing_methods = choice_sweeps };
typedef struct choosing_cell {
    double evaluations; /* a ray */
    double lost, late, wrong, undecided, sampled;
} choosing_cell;
typedef struct choosing_table {
    choosing_cell cell[choice_sweeps + 1][choice_most_values][choosing_fields][choice_stops];
} choosing_table;

choosing_table *choosing_table_read(const report_options *options);

/* What the rule sees of a value: without one of the kinds, or with all of them (-1). */
choice_value choosing_value(const choosing_table *table, int sweep, int value, int left_out);

/* The geometric mean of evaluations over fields first .. last - 1 and stops, but for one field. */
double choosing_mean(const choosing_table *table, int sweep, int value, int first, int last,
                     int first_stop, int last_stop, int left_out);

/* How many values a sweep has, and the value as a number: of step rules their place. */
int choosing_values(int sweep);
double choosing_number(int sweep, int value);

#endif
