/* SPDX-License-Identifier: MIT
 *
 * stability.csv: every family at every value of its parameter, traced by every step rule and judged
 * ray by ray. Left out: where each rule stops being trustworthy, see stability_trust.c. */
#include <math.h>
#include <stdlib.h>

#include "stability_judge.h"

static void write_row(int family, double value, const char *rule, const stability_sample *sample,
                      const stability_tally *sum, FILE *rows) {
    static const double shares[] = {0.5, 0.99, 1};
    const stability_family *const swept = stability_families[family];
    fprintf(rows, "%s,%d,%s,%.9g,%s,%d", swept->name, swept->bound, swept->parameter, value, rule,
            (int)sample->count);
    fprintf(rows, ",%d,%d,%d,%d,%d,%d,%d,%d", sum->truth_hits, sum->clear_hits, sum->hits,
            sum->wrong, sum->lost, sum->ghosts, sum->undecided, sum->nonfinite);
    for (int i = 0; i < 3; ++i) {
        fprintf(rows, ",%.9g", report_quantile(sample->evaluations, sample->count, shares[i]));
    }
    if (isnan(sum->residual_over_tolerance)) {
        fprintf(rows, ",");
    } else {
        fprintf(rows, ",%.9g", sum->residual_over_tolerance);
    }
    fprintf(rows, ",%d,%d,%d,%d,%d,%d\n", sum->steep, sum->bad_nan, sum->bad_budget,
            sum->bad_residual, sum->clear_misses, sum->clear_undecided);
}

static int cells(const report_options *options) {
    (void)options;
    return stability_family_count;
}

static void measure(const report_options *options, int family, FILE *rows) {
    stability_sample sample = stability_sample_of(stability_ray_count(options));
    for (int i = 0; i < stability_value_count(options, family); ++i) {
        const double value = stability_value(options, family, i);
        stability_world world;
        stability_draw(family, value, &world, &sample);
        for (int rule = 0; rule < report_rules; ++rule) {
            if (!stability_runs(family, report_rule[rule])) continue;
            stability_trace(&world, report_rule[rule], &sample);
            const stability_tally sum = stability_judge(&world, &sample);
            write_row(family, value, report_rule[rule], &sample, &sum, rows);
        }
        free(world.memory);
    }
    stability_sample_free(&sample);
}

const report_part report_stability = {
    "stability",
    "family,bound,parameter,value,method,rays,truth_hits,clear_hits,hits,wrong,lost,ghosts,"
    "undecided,nonfinite,evaluations_50,evaluations_99,evaluations_100,residual_over_tolerance,"
    "steep,bad_nan,bad_budget,bad_residual,clear_misses,clear_undecided",
    cells,
    measure,
    0,
    {75, 5}};
