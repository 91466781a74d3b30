/* SPDX-License-Identifier: MIT
 *
 * The section on error against run time (Bálint & Valasek 2018, section 5). Every number is a cell
 * of a table; nothing is computed here. */
#include <stdio.h>
#include <string.h>

#include "page_error.h"

enum { most_names = 32 };

static const char *const rules[] = {"basic",        "relaxed",  "enhanced",
                                    "auto_relaxed", "adaptive", "convex"};
enum { RULES = sizeof rules / sizeof rules[0], UNLICENSED = RULES - 1 };

static const char *const costs[error_costs] = {"evaluations", "nanoseconds"};
static const char *const errors[error_costs] = {"rms", "rms"};

static const char *const opened[] = {"village_boxes", "smooth_union", "mandelbulb"};
enum { OPENED = sizeof opened / sizeof opened[0] };

static int is_opened(const char *shown) {
    for (int i = 0; i < OPENED; ++i) {
        if (strcmp(opened[i], shown) == 0) return 1;
    }
    return 0;
}

/* ---- By rule -------------------------------------------------------------------------------- */

static void rules_figure(page *out, const csv_table *error, const char *shown) {
    error_pair pair;
    char where[128], name[96], title[96];
    snprintf(title, sizeof title, "%s", shown);
    error_pair_begin(&pair, title);
    for (int i = 0; i < RULES; ++i) {
        snprintf(where, sizeof where, "scene=%s,schedule=direct,method=%s", shown, rules[i]);
        error_pair_add(&pair, error, where, rules[i], costs, errors, PLOT_LINE);
    }
    snprintf(name, sizeof name, "error_rules_%s", shown);
    error_pair_figure(out, &pair, name);
}

static void means_figure(page *out, const csv_table *means) {
    static const char *const budgets[error_costs] = {"budget", "budget"};
    static const char *const gains[error_costs] = {"error_evaluations_over_basic",
                                                   "error_time_over_basic"};
    error_pair pair;
    error_pair_begin(&pair, "Error × cost, basic over the rule, mean of ten kinds");
    error_pair_titles(&pair, "budget, evaluations", "budget, evaluations",
                      "error × evaluations, times better", "error × time, times better");
    for (int i = 1; i < UNLICENSED; ++i) {
        char where[96];
        snprintf(where, sizeof where, "schedule=direct,method=%s", rules[i]);
        error_pair_add(&pair, means, where, rules[i], budgets, gains, PLOT_LINE);
    }
    for (int cost = 0; cost < error_costs; ++cost) {
        plot_add_mark(&pair.drawn[cost], 0, 1, "basic");
    }
    error_pair_figure(out, &pair, "error_means");
    page_words(out,
               "The paper's measure, the product of error and cost, of `basic` over that of each "
               "rule with the same budget: geometric mean of the ten kinds of scene, single rays. "
               "*Left* with evaluations as the cost, *right* with processor time. Above the line a "
               "rule is better than `basic`, below it worse. A small budget shows how fast a rule "
               "comes near a surface; with a large one nearly all rays end, and only the cost "
               "still differs. ");
    page_source(out, "error_means");
    page_figure_end(out);
}

static void by_rule(page *out, const csv_table *error, const csv_table *means) {
    const char *scenes[most_names];
    const int number = csv_distinct(error, "scene", scenes, most_names);
    page_heading(out, "Step rules");
    means_figure(out, means);
    rules_figure(out, error, "village_boxes");
    page_words(
        out, "Single rays of a town of boxes, a field that is dear to evaluate: error against "
             "evaluations and against time. Each marker is a budget; further left and further "
             "down is better. Where a line ends in several markers at one place, more budget buys "
             "nothing: all rays have ended. ");
    page_source(out, "error");
    page_figure_end(out);
    rules_figure(out, error, "smooth_union");
    page_words(
        out, "A ball and a box, blended, a field of a few operations, so that the rule's own work "
             "shows: compare the order of the lines on the left and on the right. ");
    page_source(out, "error");
    page_figure_end(out);
    rules_figure(out, error, "mandelbulb");
    page_words(out,
               "A fractal whose field is an estimate and no distance bound. Rays come so near to "
               "filaments that it is chance whether float and double stop at the same one: its "
               "error need not come down to the stop, and rays that graze are left out, so that ");
    const int row = csv_next(error, -1, "scene=mandelbulb");
    page_number(out, error, row, "truth_hits", "");
    page_words(out, " of ");
    page_number(out, error, row, "rays", "");
    page_words(out, " rays count. ");
    page_source(out, "error");
    page_figure_end(out);
    page_fold(out, "The other scenes");
    for (int i = 0; i < number; ++i) {
        if (is_opened(scenes[i])) continue;
        rules_figure(out, error, scenes[i]);
        page_words(out, "`%s`, single rays, by rule. ", scenes[i]);
        page_source(out, "error");
        page_figure_end(out);
    }
    page_fold_end(out);
}

/* ---- By schedule ---------------------------------------------------------------------------- */

static const char *const schedules[] = {"direct",   "frame",    "passes_1",
                                        "passes_2", "passes_4", "passes_6"};
enum { SCHEDULES = sizeof schedules / sizeof schedules[0] };

static void schedules_figure(page *out, const csv_table *error, const char *shown) {
    error_pair pair;
    char where[128], name[96], title[96];
    snprintf(title, sizeof title, "%s, adaptive", shown);
    error_pair_begin(&pair, title);
    for (int i = 0; i < SCHEDULES; ++i) {
        snprintf(where, sizeof where, "scene=%s,schedule=%s,method=adaptive", shown, schedules[i]);
        error_pair_add(&pair, error, where, schedules[i], costs, errors, PLOT_LINE);
    }
    snprintf(name, sizeof name, "error_schedules_%s", shown);
    error_pair_figure(out, &pair, name);
}

/* The figure in words, at one error. */
static void gains_words(page *out, const csv_table *passes) {
    int count = 0;
    for (int i = 1; i < SCHEDULES; ++i) {
        const int row = csv_next(passes, -1,
                                 "baseline=direct,scene=mean,schedule=%s,method=adaptive,"
                                 "error=0.001",
                                 schedules[i]);
        if (row < 0) continue;
        page_words(out,
                   count++ > 0 ? "; `%s` "
                               : "To come to `1e-3` single rays take, as multiples of `%s`, ",
                   schedules[i]);
        page_number(out, passes, row, "evaluations_gain", "%.2f");
        page_words(out, " of the evaluations and ");
        page_number(out, passes, row, "time_gain", "%.2f");
        page_words(out, " of the time");
    }
    if (count > 0) page_words(out, ". ");
}

/* Of the default, against single rays, at equal error. */
static void gains_figure(page *out, const csv_table *passes) {
    static const char *const reached[error_costs] = {"error", "error"};
    static const char *const gains[error_costs] = {"evaluations_gain", "time_gain"};
    error_pair pair;
    error_pair_begin(&pair, "Cost of single rays over that of a schedule, adaptive");
    error_pair_titles(&pair, "RMS error that is reached", "RMS error that is reached",
                      "evaluations, times fewer", "time, times less");
    for (int i = 1; i < SCHEDULES; ++i) {
        char where[128];
        snprintf(where, sizeof where, "baseline=direct,scene=mean,schedule=%s,method=adaptive",
                 schedules[i]);
        error_pair_add(&pair, passes, where, schedules[i], reached, gains, PLOT_LINE);
    }
    for (int cost = 0; cost < error_costs; ++cost) {
        plot_add_mark(&pair.drawn[cost], 0, 1, "direct");
    }
    error_pair_figure(out, &pair, "error_gains");
    page_words(
        out, "What schedules save to come to the same error, against single rays (`direct`), in "
             "the mean of those of the ten kinds that come to it. `frame` walks cones of "
             "`16x16` and `4x4` pixels, and so does the first pass of each `passes_N`. "
             "Above the line a schedule is cheaper than single rays, below it dearer. Passes walk "
             "a cone for every pixel of every pass, and keep every result, so that they can be "
             "left at any moment. The pictures are small; in larger ones a block of pixels is "
             "narrower, and its cone goes further. ");
    gains_words(out, passes);
    page_source(out, "error_passes");
    page_figure_end(out);
}

static void by_schedule(page *out, const csv_table *error, const csv_table *passes) {
    const char *scenes[most_names];
    const int number = csv_distinct(error, "scene", scenes, most_names);
    page_heading(out, "Schedules");
    gains_figure(out, passes);
    schedules_figure(out, error, "village_boxes");
    page_words(out,
               "The default rule as single rays, as a frame with cones, and in passes of rising "
               "resolution as in the paper. The budget is that of a ray in the last pass and those "
               "before it together; evaluations count all of them, cones included. ");
    page_source(out, "error");
    page_figure_end(out);
    page_fold(out, "The other scenes");
    for (int i = 0; i < number; ++i) {
        if (strcmp(scenes[i], "village_boxes") == 0) continue;
        schedules_figure(out, error, scenes[i]);
        page_words(out, "`%s`, the default rule, by schedule. ", scenes[i]);
        page_source(out, "error");
        page_figure_end(out);
    }
    page_fold_end(out);
}

/* ---- Controls ------------------------------------------------------------------------------- */

static const char *const controls[] = {
    "keinert_listing_1",  "keinert_listing_2", "balint_algorithm_1",
    "balint_algorithm_2", "plain_scalar",      "scalar_basic",
    "scalar_adaptive",    "llvmpipe_basic",    "llvmpipe_adaptive"};
enum { CONTROLS = sizeof controls / sizeof controls[0] };

static void controls_figure(page *out, const csv_table *error, const char *shown) {
    error_pair pair;
    char where[128], name[96], title[96];
    snprintf(title, sizeof title, "%s, against controls", shown);
    error_pair_begin(&pair, title);
    snprintf(where, sizeof where, "scene=%s,schedule=direct,method=basic", shown);
    error_pair_add(&pair, error, where, "basic", costs, errors, PLOT_LINE);
    snprintf(where, sizeof where, "scene=%s,schedule=direct,method=adaptive", shown);
    error_pair_add(&pair, error, where, "adaptive", costs, errors, PLOT_LINE);
    for (int i = 0; i < CONTROLS; ++i) {
        snprintf(where, sizeof where, "scene=%s,schedule=control,method=%s", shown, controls[i]);
        error_pair_add(&pair, error, where, controls[i], costs, errors, PLOT_DASHED);
    }
    for (int cost = 0; cost < error_costs; ++cost) pair.drawn[cost].height = 460;
    snprintf(name, sizeof name, "error_controls_%s", shown);
    error_pair_figure(out, &pair, name);
}

static void against_controls(page *out, const csv_table *error) {
    const char *scenes[most_names];
    const int number = csv_distinct(error, "scene", scenes, most_names);
    page_heading(out, "Controls");
    page_begin(out);
    page_words(out,
               "On the same rays: the papers' listings as they are printed, misprints included "
               "(`balint_algorithm_3` starts with zero over zero, takes one step to NaN and is "
               "left out of the plots); `plain_scalar`, the loop of a textbook; where the scene "
               "has them, the scalar loops that the driver is raced against, with the distance "
               "inlined (`scalar_basic`, `scalar_adaptive`); and the library's emitted shaders, "
               "run by Mesa's llvmpipe. One thread each. The listings and the plain loop call a "
               "function for each point, as the library's callers without vectors would. For a "
               "listing the budget is its number of iterations, of which `balint_algorithm_1` "
               "evaluates twice in each. What a listing returns is taken at its word: a `t` on the "
               "ray is a hit, all else is none, since none of them says that it ran out of "
               "iterations.");
    page_end(out);
    controls_figure(out, error, "village_boxes");
    page_words(
        out, "Keinert's listings return infinity for a ray whose iterations ran out, which counts "
             "with the end of the ray. Bálint's algorithms return how far they came, but have no "
             "end for rays that hit nothing. `basic`, `plain_scalar` and `llvmpipe_basic` take "
             "nearly the same steps, so that their times show what one point at a time, vectors "
             "and shaders cost. ");
    page_source(out, "error");
    page_figure_end(out);
    controls_figure(out, error, "mandelbulb");
    page_words(out, "The same of the fractal. The listings and the plain loop know no bounding "
                    "volume; the scalar loops use it, as the library does. ");
    page_source(out, "error");
    page_figure_end(out);
    page_begin(out);
    page_words(out,
               "*Lost:* no hit where the truth is through the surface, clear of grazing. *Late:* a "
               "hit clearly behind it. *Ghosts:* a hit where the ray stays clear of everything. "
               "*Undecided:* the budget ran out, and the result says so. The library's rules turn "
               "what they cannot decide into *undecided*, which is no hit in the intersection over "
               "union (IoU); the listings have no such answer. *Noise:* half the distance between "
               "the quartiles of the rounds, over the median; a dash where one long run had to "
               "do.");
    page_end(out);
    error_wrongs(out, error, "village_boxes");
    page_source(out, "error");
    page_fold(out, "The other scenes");
    for (int i = 0; i < number; ++i) {
        if (strcmp(scenes[i], "village_boxes") != 0) error_wrongs(out, error, scenes[i]);
    }
    page_fold_end(out);
}

/* ---- The section ---------------------------------------------------------------------------- */

/* How far times can be trusted. */
static void noise_words(page *out, const csv_table *noise) {
    const int all = csv_next(noise, -1, "schedule=all");
    page_begin(out);
    page_words(out,
               "All budgets, rules and rounds of a scene and a schedule take turns. *Noise* is "
               "half the distance between the quartiles of a row's rounds, over the median: ");
    page_number(out, noise, all, "noise_median", "%.2g");
    page_words(out, " in the median of this run, and above ");
    page_number(out, noise, all, "noise_high", "%.2g");
    page_words(out, " in a tenth of the rows. It can be checked: budgets that let all rays end are "
                    "the same work. Of ");
    page_number(out, noise, all, "pairs", "");
    page_words(out, " such pairs ");
    page_number(out, noise, all, "apart", "");
    page_words(out, " differ by more than the noise of both, the median pair by a factor of ");
    page_number(out, noise, all, "ratio_median", "%.3f");
    page_words(out, ", the worst by ");
    page_number(out, noise, all, "ratio_most", "%.3f");
    page_words(out, ": differences in time of that size say nothing. ");
    page_source(out, "error_noise");
    page_end(out);
}

static void introduction(page *out, const csv_table *error) {
    page_begin(out);
    page_words(out,
               "How far from the truth is a picture after a given time? As in ^Bálint & Valasek "
               "2018, section 5^, each ray gets a budget of evaluations, from `8` to `512`, and "
               "its depth is compared with basic tracing in double with ^10000^ steps. The rays "
               "are those of each scene's camera, ");
    page_number(out, error, 0, "rays", "%.0f");
    page_words(
        out, " of them; the stop is the same for all and small, `1e-5` or float's rounding floor "
             "where that is larger, and no pixel's size, so that what a budget leaves is seen. "
             "Errors are lengths along the ray, over the rays that hit clear of grazing, of "
             "which the answer is not a matter of rounding. A ray whose budget ran out counts "
             "with the `t` up to which it is known to be free, one that says it hits nothing "
             "with its end. Times are processor time of one thread, medians of rounds; the machine "
             "may have been busy with other things. Evaluations are exact.");
    page_end(out);
}

void page_error(page *out) {
    csv_table *const error = csv_open(out->tables, "error");
    csv_table *const means = csv_open(out->tables, "error_means");
    csv_table *const passes = csv_open(out->tables, "error_passes");
    csv_table *const front = csv_open(out->tables, "front");
    csv_table *const summary = csv_open(out->tables, "front_summary");
    csv_table *const best = csv_open(out->tables, "error_best");
    csv_table *const equal = csv_open(out->tables, "error_equal");
    csv_table *const noise = csv_open(out->tables, "error_noise");
    page_section(out, "error", "Error against run time");
    introduction(out, error);
    noise_words(out, noise);
    by_rule(out, error, means);
    error_fronts(out, front, summary);
    error_equals(out, equal);
    error_products(out, best);
    by_schedule(out, error, passes);
    against_controls(out, error);
    csv_close(error);
    csv_close(means);
    csv_close(passes);
    csv_close(front);
    csv_close(summary);
    csv_close(best);
    csv_close(equal);
    csv_close(noise);
}
