/* SPDX-License-Identifier: MIT
 *
 * stability_audit.csv: what SPT_FLAG_STEEP tells of fields that are no distance bounds: how many of
 * the rays that failed carry it, and how many of all, by every step rule. */
#include <stdlib.h>

#include "stability_judge.h"

static int cells(const report_options *options) {
    (void)options;
    return stability_family_count;
}

static void measure(const report_options *options, int family, FILE *rows) {
    const stability_family *const swept = stability_families[family];
    if (swept->bound) return;
    stability_sample sample = stability_sample_of(stability_ray_count(options));
    for (int i = 0; i < stability_value_count(options, family); ++i) {
        const double value = stability_value(options, family, i);
        stability_world world;
        stability_draw(family, value, &world, &sample);
        for (int rule = 0; rule < report_rules; ++rule) {
            int failing = 0, failing_flagged = 0, flagged = 0;
            if (!stability_runs(family, report_rule[rule])) continue;
            stability_trace(&world, report_rule[rule], &sample);
            stability_judge(&world, &sample);
            for (size_t k = 0; k < sample.count; ++k) {
                const int steep = (sample.hits[k].flags & SPT_FLAG_STEEP) != 0;
                failing += sample.failed[k];
                failing_flagged += sample.failed[k] && steep;
                flagged += steep;
            }
            fprintf(rows, "%s,%s,%.9g,%s,%d,%d,%d,%d,", swept->name, swept->parameter, value,
                    report_rule[rule], (int)sample.count, failing, failing_flagged, flagged);
            if (failing > 0) fprintf(rows, "%.9g", (double)failing_flagged / failing);
            fprintf(rows, "\n");
        }
        free(world.memory);
    }
    stability_sample_free(&sample);
}

const report_part report_stability_audit = {
    "stability_audit",
    "family,parameter,value,method,rays,failing,failing_flagged,flagged,share_flagged",
    cells,
    measure,
    0,
    {45, 3}};
