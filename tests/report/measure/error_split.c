/* SPDX-License-Identifier: MIT
 *
 * error_split.csv: what the evaluations of passes go into. A pass below the last one walks a cone
 * for each of its pixels, from which the next pass starts. Counts only. */
#include "error_runs.h"

static const char *const schedules[] = {"passes_1", "passes_2", "passes_4", "passes_6"};
enum { SCHEDULES = sizeof schedules / sizeof schedules[0] };

static void measure_schedule(const error_scene *in, const char *schedule, uint32_t budget,
                             FILE *rows) {
    error_runner runners[error_most_runners];
    const int count = error_ours(runners, in, schedule, budget);
    for (int i = 0; i < count; ++i) {
        (void)runners[i].run(&runners[i], in, 1);
        const error_score score = error_judge(in, &runners[i]);
        const double cones = runners[i].cones;
        fprintf(rows, "%s,%s,%s,%u,%.9g,%.9g\n", in->shown->name, schedule, runners[i].method,
                budget, score.evaluations - cones, cones);
        runners[i].close(&runners[i]);
    }
}

static void measure(const report_options *options, int cell, FILE *rows) {
    error_scene *const in = error_scene_of(options, report_scenes[cell]);
    for (int i = 0; i < error_budget_count; ++i) {
        if (!error_budget_wanted(options, error_budgets[i])) continue;
        for (int schedule = 0; schedule < SCHEDULES; ++schedule) {
            measure_schedule(in, schedules[schedule], error_budgets[i], rows);
        }
    }
    error_scene_free(in);
}

const report_part report_error_split = {
    "error_split", "scene,schedule,method,budget,rays,cones", error_cells, measure, 0, {24, 3}};
