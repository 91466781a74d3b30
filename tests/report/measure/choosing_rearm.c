/* SPDX-License-Identifier: MIT
 *
 * rearm.csv: "more sophisticated logic to determine when to re-enable over-relaxation" (Keinert et
 * al. 2014, section 5): policies by omega; rearm_mean.csv: their geometric means. */
#include <math.h>
#include <string.h>

#include "../csv.h"
#include "choosing.h"
#include "choosing_rules.h"

typedef struct rearm_policy {
    const char *name;
    const spt_method *(*method)(void);
    float plain_steps;
} rearm_policy;

static const rearm_policy policies[] = {{"latch_forgetting", choosing_rule_after_forgetting, 100},
                                        {"after_1_forgetting", choosing_rule_after_forgetting, 1},
                                        {"latch", choosing_rule_after, 100},
                                        {"after_1", choosing_rule_after, 1},
                                        {"after_2", choosing_rule_after, 2},
                                        {"after_4", choosing_rule_after, 4},
                                        {"after_8", choosing_rule_after, 8},
                                        {"growing", choosing_rule_growing, 1},
                                        {"halving", choosing_rule_halving, 1},
                                        {"slope", choosing_rule_slope, 1}};
enum { policy_count = sizeof policies / sizeof policies[0], omegas = 9 };

static float omega_of(int place) {
    return (float)(11 + place) / 10;
}

static int rearm_cells(const report_options *options) {
    (void)options;
    return choice_kinds * choice_stops;
}

/* The rule of the library is one of the policies; the study's must count the same. */
static void check_against_library(const choosing_view *view, const spt_settings *settings,
                                  const choosing_count *count) {
    spt_settings library = *settings;
    library.method = spt_relaxed();
    library.max_lanes = 0;
    const choosing_count expected = choosing_trace(view, &library);
    report_expect(memcmp(&expected, count, sizeof expected) == 0,
                  "the study's rule is not that of the library");
}

static void rearm_measure(const report_options *options, int cell, FILE *rows) {
    const scene *const shown = scene_named(choice_kind[cell / choice_stops]);
    choosing_view *const view = choosing_view_of(options, shown, cell % choice_stops);
    const spt_settings defaults = spt_settings_default();
    for (int i = 0; i < policy_count; ++i) {
        for (int place = 0; place < omegas; ++place) {
            spt_settings settings =
                choice_settings(&defaults, "relaxed", view->stop, view->pixel_radius);
            settings.method = policies[i].method();
            settings.max_lanes = 1;
            settings.relaxation = omega_of(place);
            settings.step_cap = policies[i].plain_steps;
            const choosing_count count = choosing_trace(view, &settings);
            if (strcmp(policies[i].name, "after_1") == 0) {
                check_against_library(view, &settings, &count);
            }
            fprintf(rows, "%s,%.6g,%s,%s,%.9g,%.9g,%llu\n", policies[i].name,
                    (double)settings.relaxation, choice_stop[view->stop], shown->name,
                    count.evaluations, count.fallbacks,
                    (unsigned long long)(count.lost + count.late));
        }
    }
    choosing_view_free(view);
}

const report_part report_rearm = {"rearm",     "policy,omega,stop,scene,evaluations,fallbacks,lost",
                                  rearm_cells, rearm_measure,
                                  0,           {17, 4}};

/* ---- Means ----------------------------------------------------------------------------------- */

typedef struct rearm_sum {
    double logarithms, fallbacks, lost, estimate_lost;
    int terms;
} rearm_sum;

static void add_row(rearm_sum *sum, const csv_table *from, int row) {
    const int estimate = strcmp(csv_text(from, row, "scene"), choice_kind[choice_kinds - 1]) == 0;
    sum->logarithms += log(csv_number(from, row, "evaluations"));
    sum->fallbacks += csv_number(from, row, "fallbacks");
    *(estimate ? &sum->estimate_lost : &sum->lost) += csv_number(from, row, "lost");
    ++sum->terms;
}

/* The rows of a policy and an omega: one in each cell, in the order of the cells. */
static void rearm_mean_measure(const report_options *options, int cell, FILE *rows) {
    csv_table *const from = csv_open(options->output, "rearm");
    const int each = policy_count * omegas;
    (void)cell;
    report_expect(csv_rows(from) == each * choice_kinds * choice_stops, "rearm.csv is not whole");
    for (int place = 0; place < each; ++place) {
        rearm_sum sum = {0, 0, 0, 0, 0};
        for (int row = place; row < csv_rows(from); row += each) add_row(&sum, from, row);
        fprintf(rows, "%s,%s,%.9g,%.9g,%.9g,%.9g\n", csv_text(from, place, "policy"),
                csv_text(from, place, "omega"), exp(sum.logarithms / sum.terms),
                sum.fallbacks / sum.terms, sum.lost, sum.estimate_lost);
    }
    csv_close(from);
}

static int one_cell(const report_options *options) {
    (void)options;
    return 1;
}

const report_part report_rearm_mean = {"rearm_mean",
                                       "policy,omega,evaluations,fallbacks,lost,estimate_lost",
                                       one_cell,
                                       rearm_mean_measure,
                                       0,
                                       {0.1, 0.1}};
