/* SPDX-License-Identifier: MIT
 *
 * caution.csv: what settings do to fields that are no distance bounds, where every probe may step
 * through a surface: rays that miss what basic steps meet, or hit behind it; caution_mean.csv: both
 * stops together, and all views of the Mandelbulb. */
#include <string.h>

#include "../csv.h"
#include "choosing.h"

/* Rules and values in the order in which they dare more. */
static const struct {
    const char *setting, *method;
    float value;
} tried[] = {{"relaxation", "relaxed", 1.0f}, {"relaxation", "relaxed", 1.1f},
             {"relaxation", "relaxed", 1.2f}, {"relaxation", "relaxed", 1.4f},
             {"relaxation", "relaxed", 1.6f}, {"relaxation", "relaxed", 1.8f},
             {"relaxation", "relaxed", 1.9f}, {"step_cap", "adaptive", 1},
             {"step_cap", "adaptive", 1.5f},  {"step_cap", "adaptive", 2},
             {"step_cap", "adaptive", 3},     {"step_cap", "adaptive", 4},
             {"step_cap", "adaptive", 6},     {"step_cap", "adaptive", 10},
             {"step_cap", "adaptive", 100}};

static int cells(const report_options *options) {
    (void)options;
    return choosing_wild_count * choice_stops;
}

static void measure(const report_options *options, int cell, FILE *rows) {
    const scene shown = choosing_wild(cell / choice_stops);
    choosing_view *const view = choosing_view_of(options, &shown, cell % choice_stops);
    const spt_settings defaults = spt_settings_default();
    for (size_t i = 0; i < sizeof tried / sizeof tried[0]; ++i) {
        spt_settings settings =
            choice_settings(&defaults, tried[i].method, view->stop, view->pixel_radius);
        *choice_setting(&settings, tried[i].setting) = tried[i].value;
        const choosing_count count = choosing_trace(view, &settings);
        fprintf(rows, "%s,%.6g,%s,%s,%s,%zu,%.9g,%llu,%llu,%llu\n", tried[i].setting,
                (double)tried[i].value, tried[i].method, choice_stop[view->stop], shown.name,
                view->count, count.evaluations, (unsigned long long)count.lost,
                (unsigned long long)count.late, (unsigned long long)count.flagged);
    }
    choosing_view_free(view);
}

const report_part report_caution = {
    "caution", "parameter,value,method,stop,field,rays,evaluations,lost,late,flagged",
    cells,     measure,
    0,         {5, 1.2}};

/* ---- Sums ------------------------------------------------------------------------------------ */

/* Fields whose names begin alike are one. */
static const char *const groups[] = {"mandelbulb", "untold_bumps", "blades", "cells", "waves"};

static int one_cell(const report_options *options) {
    (void)options;
    return 1;
}

static void mean_measure(const report_options *options, int cell, FILE *to) {
    const int each = (int)(sizeof tried / sizeof tried[0]);
    csv_table *const from = csv_open(options->output, "caution");
    (void)cell;
    report_expect(csv_rows(from) == each * cells(options), "caution.csv is not whole");
    for (size_t group = 0; group < sizeof groups / sizeof groups[0]; ++group) {
        for (int place = 0; place < each; ++place) {
            double rays = 0, lost = 0, late = 0, flagged = 0;
            for (int row = place; row < csv_rows(from); row += each) {
                if (strncmp(csv_text(from, row, "field"), groups[group], strlen(groups[group])) !=
                    0) {
                    continue;
                }
                rays += csv_number(from, row, "rays");
                lost += csv_number(from, row, "lost");
                late += csv_number(from, row, "late");
                flagged += csv_number(from, row, "flagged");
            }
            fprintf(to, "%s,%s,%s,%.9g,%.9g,%.9g,%.9g,%.9g\n", csv_text(from, place, "parameter"),
                    csv_text(from, place, "value"), groups[group], rays, lost, late, flagged,
                    1e4 * (lost + late) / rays);
        }
    }
    csv_close(from);
}

const report_part report_caution_mean = {"caution_mean",
                                         "parameter,value,field,rays,lost,late,flagged,per_10000",
                                         one_cell,
                                         mean_measure,
                                         0,
                                         {0.1, 0.1}};
