/* SPDX-License-Identifier: MIT
 *
 * The plots of the section on the papers' claims. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "page_claims.h"

enum { MOST = 64, SERIES = 8 };

/* Room for what the series of a plot point at. */
typedef struct columns {
    double x[SERIES][MOST], y[SERIES][MOST], low[SERIES][MOST], high[SERIES][MOST];
} columns;

static plot plot_of(const char *title, const char *x, const char *y) {
    plot drawn;
    memset(&drawn, 0, sizeof drawn);
    drawn.title = title;
    drawn.width = 500;
    drawn.height = 380;
    drawn.x.title = x;
    drawn.y.title = y;
    return drawn;
}

static plot_series *add_points(plot *drawn, columns *memory, const csv_table *table,
                               const char *where, const char *name, plot_style style, const char *x,
                               const char *y) {
    const int series = drawn->series_count;
    const int count = csv_points(table, where, x, y, memory->x[series], memory->y[series], MOST);
    return plot_add(drawn, name, style, count, memory->x[series], memory->y[series]);
}

/* ---- Claims 1 and 2 ------------------------------------------------------------------------- */

static const char *const step_cases[] = {"city", "jewel", "jewel_frame", "paths", "glass"};
enum { STEP_CASES = 5 };

/* How many times as fast a case is, or what another column says. */
static void add_cases(plot *drawn, columns *memory, const csv_table *steps, const char *callback,
                      const char *column, const char *name) {
    const int series = drawn->series_count;
    for (int i = 0; i < STEP_CASES; ++i) {
        const char *const way = strcmp(step_cases[i], "glass") == 0 ? "convex" : "adaptive";
        const int row =
            csv_next(steps, -1, "case=%s,callback=%s,way=%s", step_cases[i], callback, way);
        const int timed = strcmp(column, "faster") == 0;
        memory->x[series][i] = i;
        memory->y[series][i] = csv_number(steps, row, column);
        memory->low[series][i] = csv_number(steps, row, timed ? "faster_low" : column);
        memory->high[series][i] = csv_number(steps, row, timed ? "faster_high" : column);
    }
    plot_series *const added =
        plot_add(drawn, name, PLOT_BARS, STEP_CASES, memory->x[series], memory->y[series]);
    added->low = memory->low[series];
    added->high = memory->high[series];
}

void page_claims_steps(page *out) {
    static columns memory;
    static const char *const names[] = {"city", "jewel", "jewel, frame", "paths", "glass"};
    csv_table *const steps = csv_open(out->tables, "claim_steps");
    plot drawn = plot_of("Step rules and convex bodies", "", "times as fast");
    drawn.width = 860;
    drawn.height = 400;
    drawn.x.names = names;
    drawn.x.name_count = STEP_CASES;
    add_cases(&drawn, &memory, steps, "costly", "printed", "the paper");
    add_cases(&drawn, &memory, steps, "vectors", "faster", "our own field");
    add_cases(&drawn, &memory, steps, "scalar", "faster", "built without vectors");
    add_cases(&drawn, &memory, steps, "costly", "faster", "costly field");
    add_cases(&drawn, &memory, steps, "vectors", "fewer", "evaluations");
    plot_add_mark(&drawn, 0, 1, "no gain");
    page_heading(out, "Over-relaxation, and convex bodies backwards");
    page_figure(out, "claims_steps", &drawn);
    page_words(out,
               "The first four: the default step rule `adaptive` against `basic`; the last: a body "
               "of glass by `spt_trace_convex` against marching through it. By time with our own "
               "fields, with the same built without vectors, and with fields made so costly that "
               "they take nearly all of the time, as in the paper; and by evaluations. Bars: "
               "quartiles of the rounds. A rule saves time only where an evaluation costs more "
               "than its longer step: with cheap fields in wide vectors it loses some, ");
    const int city = csv_next(steps, -1, "case=city,callback=vectors,way=adaptive");
    page_words(out, "in the city to ");
    page_number(out, steps, city, "faster", "%.2f");
    page_words(out, ". ");
    page_source(out, "claim_steps");
    page_figure_end(out);
    csv_close(steps);
}

/* ---- Claims 3, 4 and 5 ---------------------------------------------------------------------- */

static void add_gain(plot *drawn, columns *memory, const csv_table *error, const char *where,
                     const char *name) {
    const int series = drawn->series_count;
    plot_series *const added =
        add_points(drawn, memory, error, where, name, PLOT_LINE, "budget", "gain");
    csv_points(error, where, "budget", "gain_low", memory->x[series], memory->low[series], MOST);
    csv_points(error, where, "budget", "gain_high", memory->x[series], memory->high[series], MOST);
    added->low = memory->low[series];
    added->high = memory->high[series];
}

void page_claims_error(page *out) {
    static columns products, times;
    static const char *const names[] = {"claims_product", "claims_resolution"};
    csv_table *const error = csv_open(out->tables, "claim_error");
    plot drawn[2] = {
        plot_of("Squared error x time", "evaluations a ray may take", "times less than relaxed"),
        plot_of("Resolutions that rise", "evaluations a ray may take",
                "times as fast at equal error")};
    for (int i = 0; i < 2; ++i) drawn[i].x.logarithmic = drawn[i].y.logarithmic = 1;
    add_gain(&drawn[0], &products, error, "question=product,method=enhanced,against=relaxed",
             "enhanced");
    add_gain(&drawn[0], &products, error, "question=product,method=auto_relaxed,against=relaxed",
             "auto_relaxed");
    add_gain(&drawn[0], &products, error, "question=product,method=adaptive,against=relaxed",
             "adaptive");
    plot_add_mark(&drawn[0], 0, 1, "as relaxed");
    plot_add_mark(&drawn[0], 0, 1.5, "the paper: up to");
    add_gain(&drawn[1], &times, error, "question=time,method=enhanced,schedule=frame", "frame");
    add_gain(&drawn[1], &times, error, "question=time,method=enhanced,schedule=passes_2",
             "passes_2");
    add_gain(&drawn[1], &times, error, "question=time,method=enhanced,schedule=passes_4",
             "passes_4");
    add_gain(&drawn[1], &times, error, "question=time,method=enhanced,schedule=passes_6",
             "passes_6");
    plot_add_mark(&drawn[1], 0, 1, "rays one by one");
    plot_add_mark(&drawn[1], 0, 1.2, "the paper: up to");
    page_heading(out, "Error and time together");
    page_figures(out, names, drawn, 2);
    page_words(
        out, "Geometric means of the paper's scenes; bars as far as the clock's noise goes. "
             "Left: the squared error times time of the `relaxed` rule, with the parameter of its "
             "paper, over that of others. Enhanced tracing is ahead where some rays are done and "
             "others are not; with the fewest evaluations its first step, a plain one, costs it "
             "the lead, and once all rays are done the errors are equal and the longer step "
             "tells. The default rule `adaptive` keeps up or is ahead. Right: how much sooner the "
             "enhanced "
             "rule is at the error that single rays have with a budget, behind the cones of a "
             "frame and in the paper's passes. Passes walk a cone for every pixel of "
             "each resolution, which costs more than it saves; cones of blocks do not. ");
    page_source(out, "claim_error");
    page_figure_end(out);
    csv_close(error);
}

/* ---- Claims 6, 7 and 8 ---------------------------------------------------------------------- */

/* A line of claim_lines.csv from end to end. */
static void add_line(plot *drawn, columns *memory, const csv_table *lines, const char *way,
                     const char *column) {
    const int series = drawn->series_count;
    const int row = csv_next(lines, -1, "way=%s,column=%s", way, column);
    static const char *const ends[] = {"fewest", "most"};
    for (int i = 0; i < 2; ++i) {
        memory->x[series][i] = csv_number(lines, row, ends[i]);
        memory->y[series][i] = csv_number(lines, row, "offset") +
                               csv_number(lines, row, "slope") * memory->x[series][i];
    }
    plot_add(drawn, NULL, PLOT_DASHED, 2, memory->x[series], memory->y[series])->look =
        drawn->series[series - 1].look;
}

static void add_way(plot *drawn, columns *memory, const csv_table *levels, const char *way,
                    const char *name, const char *column) {
    char where[64];
    snprintf(where, sizeof where, "way=%s", way);
    add_points(drawn, memory, levels, where, name, PLOT_LINE, "levels", column);
}

void page_claims_levels(page *out) {
    static columns pictures, evaluations;
    static const char *const names[] = {"claims_levels", "claims_evaluation"};
    csv_table *const levels = csv_open(out->tables, "claim_levels");
    csv_table *const lines = csv_open(out->tables, "claim_lines");
    plot drawn[2] = {plot_of("Pictures of a tree", "levels", "processor time a pixel, ns"),
                     plot_of("An evaluation", "levels", "processor time an evaluation, ns")};
    add_way(&drawn[0], &pictures, levels, "moebius_binary", "Möbius, binary", "nanoseconds");
    add_way(&drawn[0], &pictures, levels, "moebius_bound", "Möbius, by its bound", "nanoseconds");
    add_way(&drawn[0], &pictures, levels, "binary_same_error", "binary, same error", "nanoseconds");
    add_way(&drawn[0], &pictures, levels, "direct_basic", "direct, basic", "nanoseconds");
    add_way(&drawn[0], &pictures, levels, "direct", "direct, adaptive", "nanoseconds");
    add_way(&drawn[0], &pictures, levels, "cones", "behind cones, adaptive", "nanoseconds");
    add_way(&drawn[0], &pictures, levels, "compound_cones", "compound of eight, cones",
            "nanoseconds");
    add_way(&drawn[1], &evaluations, levels, "direct_unbounded", "while rays are traced",
            "per_evaluation");
    add_line(&drawn[1], &evaluations, lines, "direct_unbounded", "per_evaluation");
    add_way(&drawn[1], &evaluations, levels, "evaluation", "by itself", "per_evaluation");
    add_line(&drawn[1], &evaluations, lines, "evaluation", "per_evaluation");
    drawn[1].y.low = 0;
    page_heading(out, "Kernel-reflection sequences by their levels");
    page_figures(out, names, drawn, 2);
    page_words(out,
               "Left, as Figure 12 of the paper: each level doubles the geometry, and no time "
               "doubles. What bends the curves is the view: a tree of few levels leaves most of "
               "the picture empty, and from some level on twigs are thinner than pixels. Right: an "
               "evaluation, without the view; dashed: straight lines through the points, with "
               "R² of ");
    page_number(out, lines, csv_next(lines, -1, "way=direct_unbounded,column=per_evaluation"),
                "straight", "%.3f");
    page_words(out, " and ");
    page_number(out, lines, csv_next(lines, -1, "way=evaluation"), "straight", "%.3f");
    page_words(out, ". Cones save most where much is empty. Binary tracing is not needed for "
                    "Möbius maps: their distance bound is the faster way. ");
    page_source(out, "claim_levels");
    page_figure_end(out);
    csv_close(lines);
    csv_close(levels);
}

/* ---- Claims 9 and 10 ------------------------------------------------------------------------ */

static void add_shares(plot *drawn, columns *memory, const csv_table *table,
                       const char *const *models, int count, const char *pass, const char *name) {
    const int series = drawn->series_count;
    for (int i = 0; i < count; ++i) {
        const int row = csv_next(table, -1, "model=%s,pass=%s", models[i], pass);
        memory->x[series][i] = i;
        memory->y[series][i] = csv_number(table, row, "share");
        memory->low[series][i] = csv_number(table, row, "share_low");
        memory->high[series][i] = csv_number(table, row, "share_high");
    }
    plot_series *const added =
        plot_add(drawn, name, PLOT_BARS, count, memory->x[series], memory->y[series]);
    added->low = memory->low[series];
    added->high = memory->high[series];
}

void page_claims_secondary(page *out) {
    static columns shares, occlusion;
    static const char *models[MOST];
    static const char *const names[] = {"claims_shadows", "claims_occlusion"};
    csv_table *const table = csv_open(out->tables, "claim_secondary");
    csv_table *const levels = csv_open(out->tables, "claim_levels");
    csv_table *const lines = csv_open(out->tables, "claim_lines");
    const int count = csv_distinct(table, "model", models, MOST);
    const int line = csv_next(lines, -1, "way=direct,column=nanoseconds");
    plot drawn[2] = {plot_of("Soft shadows", "", "share of the time of primary rays"),
                     plot_of("Ambient occlusion", "levels", "processor time a pixel, ns")};
    drawn[0].x.names = models;
    drawn[0].x.name_count = count;
    add_shares(&drawn[0], &shares, table, models, count, "shadow_quarter",
               "a quarter of the pixels");
    add_shares(&drawn[0], &shares, table, models, count, "shadow_quarter_samples",
               "the same by samples alone");
    add_shares(&drawn[0], &shares, table, models, count, "shadow_sixteenth",
               "a quarter of each side");
    plot_add_mark(&drawn[0], 0, 0.25, "the paper");
    add_way(&drawn[1], &occlusion, levels, "occlusion", "five samples", "nanoseconds");
    add_way(&drawn[1], &occlusion, levels, "occlusion_quarter", "at a quarter of the pixels",
            "nanoseconds");
    add_way(&drawn[1], &occlusion, levels, "occlusion_1_sample", "one sample", "nanoseconds");
    plot_add_mark(&drawn[1], 0, csv_number(lines, line, "slope"), "one level more");
    drawn[1].y.logarithmic = 1;
    page_heading(out, "Shadows and ambient occlusion");
    page_figures(out, names, drawn, 2);
    page_words(out,
               "Left: passes of soft shadows of models over the primary rays of their pictures, "
               "those one by one and by the default rule. ^25 %% of the cost of the primary ray "
               "casting^ is what the paper says. Right: ambient occlusion at all hits on the tree, "
               "and what one level more costs on average, ");
    page_number(out, lines, line, "slope", "%.1f ns");
    page_words(out, ". It asks all levels as often as it has samples, at as many pixels as are "
                    "hit, so that it grows with the levels: below that line for few of them, above "
                    "for many. ");
    page_source(out, "claim_secondary");
    page_words(out, " ");
    page_source(out, "claim_levels");
    page_figure_end(out);
    csv_close(lines);
    csv_close(levels);
    csv_close(table);
}
