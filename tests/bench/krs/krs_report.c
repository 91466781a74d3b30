/* SPDX-License-Identifier: MIT
 *
 * Rows, and goals beside them. */
#include "krs_report.h"

#include <math.h>
#include <string.h>

krs_line krs_line_through(const double *x, const double *y, int count) {
    double mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
    krs_line line;
    for (int i = 0; i < count; ++i) {
        mean_x += x[i] / count;
        mean_y += y[i] / count;
    }
    for (int i = 0; i < count; ++i) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
        yy += (y[i] - mean_y) * (y[i] - mean_y);
    }
    line.slope = xy / xx;
    line.offset = mean_y - line.slope * mean_x;
    line.straight = xy * xy / (xx * yy);
    return line;
}

void krs_begin_row(FILE *file, const char *name, uint32_t levels, int components,
                   double instances) {
    fprintf(file, "%s,%u,%d,%.0f", name, (unsigned)levels, components, instances);
}

void krs_print_goal(const char *what, double value, const char *goal, int reached) {
    printf("%-66s%8.3f   goal %-10s%s\n", what, value, goal, reached ? "reached" : "NOT REACHED");
}

void krs_print_heading(const bench_options *options) {
    printf("\nPictures of %dx%d by levels of each tree. single: a tree. grove: eight by three "
           "mirrors more. copies: the same\neight as a compound. compound: eight different ones "
           "there. moekrs: a palm. Error: how far hits are short of the\nsurface along the ray, in "
           "tolerances: mean, and what 95 %% keep. passed: hits where an exact ray goes on.\n"
           "%-26s%7s%11s%10s%10s%9s%9s%8s%8s%9s%9s%8s\n",
           options->width, options->height, "case", "levels", "instances", "ms", "ns/pixel",
           "evals/px", "ns/eval", "error", "95 %", "passed %", "lost %", "probes");
}

/* A number where it means something. */
static void print_number(FILE *file, const char *format, const char *otherwise, int known,
                         double number) {
    if (known) {
        fprintf(file, format, number);
    } else {
        fputs(otherwise, file);
    }
}

static void write_case(const krs_table *table, int number, int which, double pixels, FILE *file) {
    const krs_described *const described = &krs_case_of[which];
    const krs_result *const result = &table->results[number][which];
    const krs_error *const error = &result->error;
    const int single = described->how != KRS_FRAME, binary = described->how == KRS_BINARY;
    const int compound = described->body == KRS_COPIES || described->body == KRS_KINDS;
    const uint32_t levels = table->levels[number];
    const double instances = krs_models_instances(levels, described->body);
    const double milliseconds = result->nanoseconds * pixels * 1e-6;
    krs_begin_row(file, described->name, levels, compound ? KRS_TREES : 1, instances);
    fprintf(file, ",%s,%.3f,%.3f,%.4f,%.3f", described->rule, milliseconds, result->nanoseconds,
            result->evaluations, result->per_evaluation);
    print_number(file, ",%.3f", ",", single, error->per_hit);
    fprintf(file, ",%.4f,%.4f,%.6f,%.6f,%.6f", error->mean, error->most, error->passed, error->lost,
            error->undecided);
    print_number(file, ",%.2f\n", ",\n", binary, result->probe_ratio);
    printf("%-26s%7u%11.3g%10.1f%10.2f%9.3f%9.3f", described->name, (unsigned)levels, instances,
           milliseconds, result->nanoseconds, result->evaluations, result->per_evaluation);
    printf("%8.3f%8.3f%9.4f%9.4f", error->mean, error->most, 100 * error->passed,
           100 * error->lost);
    print_number(stdout, "%8.2f\n", "       -\n", binary, result->probe_ratio);
}

void krs_write_levels(const krs_table *table, int number, const bench_options *options,
                      FILE *file) {
    const double pixels = (double)options->width * (double)options->height;
    for (int which = 0; which < krs_cases; ++which) {
        write_case(table, number, which, pixels, file);
    }
    fflush(stdout);
}

/* ---- Goals --------------------------------------------------------------------------------- */

/* Values over all numbers of levels. */
typedef struct krs_span {
    double mean; /* geometric */
    double least, most;
} krs_span;

static krs_span span_of(const double *values) {
    krs_span span = {0, values[0], values[0]};
    for (int i = 0; i < KRS_NUMBERS; ++i) {
        span.mean += log(values[i]) / KRS_NUMBERS;
        span.least = fmin(span.least, values[i]);
        span.most = fmax(span.most, values[i]);
    }
    span.mean = exp(span.mean);
    return span;
}

/* Time of one case over that of another: the middle of the rounds. */
static krs_span time_ratios(const krs_table *table, krs_case one, krs_case other) {
    double values[KRS_NUMBERS];
    for (int i = 0; i < KRS_NUMBERS; ++i) {
        const krs_result *const results = table->results[i];
        double ratios[BENCH_MOST_ROUNDS];
        for (int round = 0; round < table->rounds; ++round) {
            ratios[round] = results[one].seconds[round] / results[other].seconds[round];
        }
        values[i] = bench_median(ratios, table->rounds);
    }
    return span_of(values);
}

static krs_span evaluation_ratios(const krs_table *table, krs_case one, krs_case other) {
    double values[KRS_NUMBERS];
    for (int i = 0; i < KRS_NUMBERS; ++i) {
        const krs_result *const results = table->results[i];
        values[i] = results[one].evaluations / results[other].evaluations;
    }
    return span_of(values);
}

static double error_ratio(const krs_table *table, krs_case one, krs_case other) {
    double values[KRS_NUMBERS];
    for (int i = 0; i < KRS_NUMBERS; ++i) {
        const krs_result *const results = table->results[i];
        values[i] = results[one].error.mean / results[other].error.mean;
    }
    return span_of(values).mean;
}

/* The mean over the numbers of levels is judged; the ends stand beside it. */
static void print_span(const char *what, krs_span span, const char *goal, int reached) {
    krs_print_goal(what, span.mean, goal, reached);
    printf("%66s%8.3f to %.3f\n", "by levels", span.least, span.most);
}

static void print_at_most(const char *what, krs_span span, double goal) {
    char text[32];
    snprintf(text, sizeof text, "<= %.2f", goal);
    print_span(what, span, text, span.mean <= goal);
}

static void print_at_least(const char *what, krs_span span, double goal) {
    char text[32];
    snprintf(text, sizeof text, ">= %.2f", goal);
    print_span(what, span, text, span.mean >= goal);
}

/* Of whole pictures, whose evaluations change with the levels: not judged. */
static void print_line(const krs_table *table, krs_case which) {
    double x[KRS_NUMBERS], y[KRS_NUMBERS];
    for (int i = 0; i < KRS_NUMBERS; ++i) {
        x[i] = (double)table->levels[i];
        y[i] = table->results[i][which].nanoseconds;
    }
    const krs_line line = krs_line_through(x, y, KRS_NUMBERS);
    printf("time of a picture, %-26s ns/pixel = %8.2f + %7.3f levels, R^2 %.3f\n",
           krs_case_of[which].name, line.offset, line.slope, line.straight);
}

static void print_bound(const krs_table *table, int rule, const char *name) {
    double values[KRS_NUMBERS];
    char what[96];
    for (int i = 0; i < KRS_NUMBERS; ++i) values[i] = table->bound_over_binary[i][rule];
    snprintf(what, sizeof what, "evaluations of rays that hit, bound / binary, %s", name);
    print_at_most(what, span_of(values), 0.5);
}

void krs_print_goals(const krs_table *table) {
    printf("\n");
    print_at_least("low-resolution phase, times as fast, basic",
                   time_ratios(table, krs_single_direct, krs_single_cones), 1.5);
    print_at_least("low-resolution phase, times as fast, adaptive",
                   time_ratios(table, krs_single_direct_adaptive, krs_single_cones_adaptive), 1.5);
    print_at_most("compound of eight copies / grove, time, basic",
                  time_ratios(table, krs_copies_cones, krs_grove_cones), 1.15);
    print_at_most("compound of eight copies / grove, time, adaptive",
                  time_ratios(table, krs_copies_cones_adaptive, krs_grove_cones_adaptive), 1.15);
    print_at_most("compound of eight kinds / grove, time, basic",
                  time_ratios(table, krs_compound_cones, krs_grove_cones), 1.15);
    print_at_most("compound of eight kinds / grove, time, adaptive",
                  time_ratios(table, krs_compound_cones_adaptive, krs_grove_cones_adaptive), 1.15);
    print_at_most("binary / direct, same error, evaluations, basic",
                  evaluation_ratios(table, krs_single_binary_same_error, krs_single_direct), 2);
    print_at_most(
        "binary / direct, same error, evaluations, adaptive",
        evaluation_ratios(table, krs_single_binary_same_error, krs_single_direct_adaptive), 2);
    const krs_span untuned = evaluation_ratios(table, krs_single_binary, krs_single_direct);
    printf("%-66s%8.3f   (its error: %.2f of that of direct tracing)\n",
           "binary by default / direct, evaluations, basic", untuned.mean,
           error_ratio(table, krs_single_binary, krs_single_direct));
    print_bound(table, 0, "basic");
    print_bound(table, 1, "adaptive");
    printf("\n");
    for (int which = 0; which < krs_cases; ++which) print_line(table, (krs_case)which);
}

int krs_nothing_lost(const krs_table *table) {
    int nothing = 1;
    for (int i = 0; i < KRS_NUMBERS; ++i) {
        for (int which = 0; which < krs_cases; ++which) {
            const double lost = table->results[i][which].error.lost;
            if (!(lost > 0)) continue;
            printf("%s, %u levels: %.5f %% of the rays overlook a surface\n",
                   krs_case_of[which].name, (unsigned)table->levels[i], 100 * lost);
            nothing = 0;
        }
    }
    return nothing;
}
