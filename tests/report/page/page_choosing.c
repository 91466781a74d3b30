/* SPDX-License-Identifier: MIT
 *
 * The section on defaults: the rules by which they are chosen, and the data. The papers' open
 * questions are in page_choosing_papers.c. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "page_choosing.h"

/* ---- Plots ----------------------------------------------------------------------------------- */

void choosing_plot_begin(choosing_plot *one, const char *title, const char *x, const char *y) {
    memset(one, 0, sizeof *one);
    one->drawn.title = title;
    one->drawn.x.title = x;
    one->drawn.y.title = y;
    one->drawn.width = 500;
    one->drawn.height = 340;
}

int choosing_line(choosing_plot *to, const csv_table *table, const char *where, const char *x,
                  const char *y, const char *name) {
    const int line = to->lines;
    const int count =
        csv_points(table, where, x, y, to->x[line], to->y[line], choosing_most_points);
    if (count == 0) return -1;
    plot_add(&to->drawn, name, PLOT_LINE, count, to->x[line], to->y[line]);
    ++to->lines;
    return line;
}

int choosing_method_row(const csv_table *means, const char *method) {
    return csv_next(means, -1, "parameter=method,method=%s", method);
}

/* ---- The defaults ---------------------------------------------------------------------------- */

static void rules(page *out) {
    page_begin(out);
    page_words(
        out, "Every number that a caller need not set is chosen by a rule from what this run "
             "measured, and a test compares the headers with it. *Fewest evaluations:* of the "
             "values that lose no ray of any field that is a distance bound, the one with the "
             "least geometric mean of evaluations over the ten kinds of scene and both stops, "
             "half a pixel and `1e-4`. Values within half a percent of it are as good, and of "
             "those the one nearest to basic steps is taken. Evaluations are counted, not timed, "
             "so that the choice is the same on every machine. The others: *largest in the first "
             "cache*, the most rays whose state fits in `32 KiB`, which is arithmetic on sizes and "
             "not a measurement; *fewest evaluations a pixel*, "
             "of equals the faster; *the paper's unless two percent are saved*, what is published "
             "unless another value saves more than that and still decides a ray without end within "
             "the default budget.");
    page_end(out);
}

static void defaults(page *out) {
    csv_table *const table = csv_open(out->tables, "defaults");
    page_table(out,
               "The defaults. *Least*: the value with the very least. *Costs*: by how much the "
               "header's value exceeds that, percent. *From, to*: what the rule takes when any one "
               "of the ten kinds is left out.",
               "setting|rule|the rule takes|the header has|agrees|least|costs|from|to");
    for (int row = 0; row < csv_rows(table); ++row) {
        const int agrees = strcmp(csv_text(table, row, "agrees"), "1") == 0;
        page_row(out);
        page_cell_begin(out, NULL);
        page_words(out, "`%s`", csv_text(table, row, "setting"));
        page_cell_end(out);
        page_cell(out, NULL, "%s", csv_text(table, row, "rule"));
        page_cell_number(out, NULL, table, row, "chosen", "");
        page_cell_number(out, NULL, table, row, "header", "");
        page_cell(out, agrees ? "good" : "bad", agrees ? "yes" : "no");
        page_cell_number(out, NULL, table, row, "least", "");
        page_cell_number(out, NULL, table, row, "above", "%.2f");
        page_cell_number(out, NULL, table, row, "low", "");
        page_cell_number(out, NULL, table, row, "high", "");
    }
    page_table_end(out);
    page_source(out, "defaults");
    csv_close(table);
}

/* ---- Step rules ------------------------------------------------------------------------------ */

static void methods(page *out, const csv_table *means) {
    static const char *const named[] = {"basic", "relaxed", "auto_relaxed", "enhanced", "adaptive"};
    page_table(
        out,
        "Step rules with the numbers of the header: evaluations a ray, geometric means, and "
        "rays that miss what is there or hit behind it. Bounds: nine kinds and six stiff "
        "fields, thin plates, a thin shell, wires, steep bumps, a gyroid's sheet, and a "
        "torus whose distance is said to be a tenth of what it is.",
        "rule|half a pixel|`1e-4`|both|stiff fields|lost, bounds|lost, Mandelbulb|undecided");
    for (size_t i = 0; i < sizeof named / sizeof named[0]; ++i) {
        const int row = choosing_method_row(means, named[i]);
        page_row(out);
        page_cell(out, NULL, "%s", named[i]);
        page_cell_number(out, NULL, means, row, "half_pixel", "%.2f");
        page_cell_number(out, NULL, means, row, "absolute", "%.2f");
        page_cell_number(out, NULL, means, row, "both", "%.2f");
        page_cell_number(out, NULL, means, row, "stiff", "%.2f");
        page_cell_number(out, csv_number(means, row, "lost") > 0 ? "bad" : "good", means, row,
                         "lost", "");
        page_cell_number(out, NULL, means, row, "estimate_lost", "");
        page_cell_number(out, NULL, means, row, "undecided", "");
    }
    page_table_end(out);
    page_source(out, "sweep_mean");
}

/* A column in percent above its least. */
static void line_above(choosing_plot *to, const csv_table *means, const char *where,
                       const char *column, const char *name) {
    const int line = choosing_line(to, means, where, "value", column, name);
    double least = HUGE_VAL;
    if (line < 0) return;
    const int count = to->drawn.series[to->drawn.series_count - 1].count;
    for (int i = 0; i < count; ++i) least = fmin(least, to->y[line][i]);
    for (int i = 0; i < count; ++i) to->y[line][i] = 100 * (to->y[line][i] / least - 1);
}

/* The header's value, as a mark. */
static void mark_default(choosing_plot *to, const csv_table *table, const char *setting) {
    const int row = csv_next(table, -1, "setting=%s", setting);
    plot_add_mark(&to->drawn, 1, csv_number(table, row, "header"), "default");
}

static void sweep_plot(choosing_plot *to, const csv_table *means, const csv_table *table,
                       const char *setting, const char *method) {
    char where[96];
    choosing_plot_begin(to, setting, setting, "evaluations above the least, %");
    snprintf(where, sizeof where, "parameter=%s,method=%s", setting, method);
    line_above(to, means, where, "half_pixel", "ten kinds, half a pixel");
    line_above(to, means, where, "absolute", "ten kinds, 1e-4");
    line_above(to, means, where, "stiff", "stiff fields, both stops");
    to->drawn.y.high = 30;
    mark_default(to, table, setting);
}

static void sweeps(page *out, const csv_table *means) {
    static const char *const names[] = {"choosing_relaxation", "choosing_slope_blend",
                                        "choosing_extrapolation", "choosing_step_cap"};
    static choosing_plot swept[4];
    csv_table *const table = csv_open(out->tables, "defaults");
    plot drawn[4];
    sweep_plot(&swept[0], means, table, "relaxation", "relaxed");
    sweep_plot(&swept[1], means, table, "slope_blend", "auto_relaxed");
    sweep_plot(&swept[2], means, table, "extrapolation", "adaptive");
    sweep_plot(&swept[3], means, table, "step_cap", "adaptive");
    line_above(&swept[2], means, "parameter=extrapolation,method=enhanced", "both",
               "enhanced, both stops");
    swept[3].drawn.x.logarithmic = 1;
    for (int i = 0; i < 4; ++i) drawn[i] = swept[i].drawn;
    page_figures(out, names, drawn, 4);
    page_words(out,
               "Evaluations by the value of each setting, the others at their defaults, in percent "
               "above the least of each line. Read them from left to right: nearer to basic steps "
               "is left. Rejected probes are kept, which favours a larger `relaxation` than the "
               "^1.2 of Keinert et al. (2014, section 4)^; see the figure on re-arming. With an "
               "`extrapolation` of `1` the next sphere on a plane just touches this one, and "
               "rounding turns probes down. ");
    page_source(out, "sweep_mean");
    page_figure_end(out);
    csv_close(table);
}

/* ---- Fields that are no bounds --------------------------------------------------------------- */

static const char *const wild[] = {"mandelbulb", "untold_bumps", "blades", "cells", "waves"};
enum { wild_count = sizeof wild / sizeof wild[0] };

/* How many of the failing rays say so, with the default's cap. */
static void caution_table(page *out, const csv_table *means) {
    csv_table *const defaults = csv_open(out->tables, "defaults");
    const char *const cap =
        csv_text(defaults, csv_next(defaults, -1, "setting=step_cap"), "header");
    page_table(out,
               "The same fields with `adaptive` and its default cap: rays that are lost, hit too "
               "late, and how many of both together carry `SPT_FLAG_STEEP`",
               "field|rays|lost|late|flagged");
    for (int i = 0; i < wild_count; ++i) {
        const int row = csv_next(means, -1, "parameter=step_cap,value=%s,field=%s", cap, wild[i]);
        if (row < 0) continue;
        page_row(out);
        page_cell(out, NULL, "%s", wild[i]);
        page_cell_number(out, "quiet", means, row, "rays", "");
        page_cell_number(out, NULL, means, row, "lost", "");
        page_cell_number(out, NULL, means, row, "late", "");
        page_cell_number(out, NULL, means, row, "flagged", "");
    }
    page_table_end(out);
    page_source(out, "caution_mean");
    csv_close(defaults);
}

static void caution(page *out) {
    static const char *const names[] = {"choosing_caution_relaxation", "choosing_caution_step_cap"};
    csv_table *const table = csv_open(out->tables, "caution_mean");
    static choosing_plot both[2];
    plot drawn[2];
    choosing_plot_begin(&both[0], "relaxed", "relaxation", "lost or late, of 10 000 rays");
    choosing_plot_begin(&both[1], "adaptive", "step_cap", "lost or late, of 10 000 rays");
    for (int k = 0; k < 2; ++k) {
        for (int i = 0; i < wild_count; ++i) {
            char where[96];
            snprintf(where, sizeof where, "parameter=%s,field=%s",
                     k == 0 ? "relaxation" : "step_cap", wild[i]);
            choosing_line(&both[k], table, where, "value", "per_10000", wild[i]);
        }
        drawn[k] = both[k].drawn;
        drawn[k].y.logarithmic = 1;
        drawn[k].y.low = 1;
        drawn[k].y.high = 1000;
    }
    drawn[1].x.logarithmic = 1;
    page_figures(out, names, drawn, 2);
    page_words(
        out, "Fields that are *no* distance bounds: rays that miss what basic steps meet, or hit "
             "behind it. The Mandelbulb's estimate, bumps of which the slope is not told, twisted "
             "blades, a grid in which each cell knows its own ball only, and a sum of waves. Basic "
             "steps, at `1` on the left, are what the others are measured by; what is zero is not "
             "drawn. Any probe beyond the certified sphere may step through such a surface, "
             "however little beyond it goes, and no cap makes a bound of a field that is none: "
             "`step_cap` is chosen by evaluations alone. ");
    page_source(out, "caution_mean");
    page_figure_end(out);
    caution_table(out, table);
    csv_close(table);
}

/* ---- Chunks and schedules -------------------------------------------------------------------- */

static void chunk_line(choosing_plot *to, const csv_table *table, const char *scene) {
    char where[64];
    double noise[choosing_most_points], unused[choosing_most_points];
    snprintf(where, sizeof where, "scene=%s", scene);
    csv_points(table, where, "rays_a_call", "noise", unused, noise, choosing_most_points);
    const int line = choosing_line(to, table, where, "rays_a_call", "ratio", scene);
    if (line < 0) return;
    plot_series *const series = &to->drawn.series[to->drawn.series_count - 1];
    for (int i = 0; i < series->count; ++i) {
        to->low[line][i] = to->y[line][i] * (1 - noise[i]);
        to->high[line][i] = to->y[line][i] * (1 + noise[i]);
    }
    series->low = to->low[line];
    series->high = to->high[line];
}

static void chunks(page *out) {
    static const char *const scenes[] = {"plane", "primitives", "mandelbulb", "village",
                                         "krs_tree_16"};
    csv_table *const table = csv_open(out->tables, "chunk");
    csv_table *const defaults = csv_open(out->tables, "defaults");
    static choosing_plot drawn;
    choosing_plot_begin(&drawn, "Rays in a call", "rays in a call",
                        "time a ray, over that with 256");
    drawn.drawn.y.low = 0.8;
    drawn.drawn.y.high = 2.4;
    drawn.drawn.x.logarithmic = 1;
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; ++i) {
        chunk_line(&drawn, table, scenes[i]);
    }
    plot_add_mark(&drawn.drawn, 1,
                  csv_number(defaults, csv_next(defaults, -1, "setting=SPT_BATCH"), "header"),
                  "SPT_BATCH");
    page_figure(out, "choosing_chunk", &drawn.drawn);
    page_words(
        out, "Time a ray by how many rays a call brings: the driver marches at most `SPT_BATCH` "
             "together, and larger calls are split. Small calls pay for the call itself, and their "
             "last rays march in vectors that are not full. `SPT_BATCH` itself is not chosen by "
             "these times, but by arithmetic: the state of `256` rays takes ");
    const int row = csv_next(table, -1, "rays_a_call=256");
    page_number(out, table, row, "bytes", "");
    page_words(out, " bytes, that of `512` would take ");
    page_number(out, table, csv_next(table, row, "rays_a_call=512"), "bytes", "");
    page_words(out, ", and a first data cache is taken to hold `32 KiB`. Bars: half of what lies "
                    "between the quartiles, to both sides. ");
    page_source(out, "chunk");
    page_figure_end(out);
    csv_close(defaults);
    csv_close(table);
}

static void schedules(page *out) {
    csv_table *const means = csv_open(out->tables, "schedules_mean");
    page_table(out,
               "Whole pictures of eight scenes, each traced in one piece: evaluations a pixel, "
               "those of cones included, and time. Geometric means.",
               "schedule|what it is|evaluations|time over that of rays alone");
    static const struct {
        const char *name, *words;
    } known[] = {{"rays", "each ray from its start"},
                 {"cones", "`spt_frame_trace`: tiles, cones before rays; the default"},
                 {"passes_1", "`spt_frame_advance`, one pass"},
                 {"passes_2", "a half of the resolution, then all of it"},
                 {"passes_4", "quarters"},
                 {"passes_6", "sixths"}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; ++i) {
        const int row = csv_next(means, -1, "schedule=%s", known[i].name);
        page_row(out);
        page_cell(out, NULL, "%s", known[i].name);
        page_cell_begin(out, NULL);
        page_words(out, known[i].words);
        page_cell_end(out);
        page_cell_number(out, NULL, means, row, "evaluations", "%.2f");
        page_cell_number(out, NULL, means, row, "ratio", "%.2f");
    }
    page_table_end(out);
    page_source(out, "schedules_mean");
    page_begin(out);
    page_words(out,
               "Passes of lower resolution show a picture sooner. These have no `shade`, so that "
               "nobody sees the coarse ones: they trace a cone for each of their pixels and no "
               "ray, and what `passes_2` and on take beyond `passes_1` are such cones. Beside "
               "`cones`, which is one piece, `passes_1` shows what it costs to be interruptible.");
    page_end(out);
    csv_close(means);
}

void page_choosing(page *out) {
    csv_table *const means = csv_open(out->tables, "sweep_mean");
    page_section(out, "choosing", "Choosing the defaults");
    rules(out);
    defaults(out);
    page_heading(out, "Step rules and their numbers");
    methods(out, means);
    sweeps(out, means);
    caution(out);
    page_heading(out, "When to over-relax again");
    choosing_rearming(out);
    page_heading(out, "Bonus and penalty of binary tracing");
    choosing_binary(out);
    page_heading(out, "Chunks and schedules");
    chunks(out);
    schedules(out);
    csv_close(means);
}
