/* SPDX-License-Identifier: MIT
 *
 * defaults.csv: what the rules take from the tables, and what the headers say. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <spheretrace/mobius.h>

#include "../csv.h"
#include "choosing.h"

/* rule: a name; the page says what it is. least: the value with the least mean, above: by how many
 * percent the header's is more. low, high: what is chosen when any one kind is left out. */
typedef struct default_row {
    const char *setting, *rule;
    char chosen[32], header[32], least[32], low[32], high[32];
    double above;
} default_row;

static void write_row(const default_row *row, FILE *rows) {
    fprintf(rows, "%s,%s,%s,%s,%d,%s,", row->setting, row->rule, row->chosen, row->header,
            strcmp(row->chosen, row->header) == 0, row->least);
    if (!isnan(row->above)) fprintf(rows, "%.9g", row->above);
    fprintf(rows, ",%s,%s\n", row->low, row->high);
}

/* Like a table's "%.6g", so that equal numbers are equal texts. */
static void write_number(char to[32], double number) {
    snprintf(to, 32, "%.6g", number);
}

static default_row row_of(const char *setting, const char *rule) {
    default_row row = {setting, rule, "", "", "", "", "", 0};
    row.above = (double)NAN;
    return row;
}

/* ---- The numbers of the step rules, and which of these --------------------------------------- */

static int pick(const choosing_table *table, int sweep, int left_out) {
    choice_value values[choice_most_values];
    for (int i = 0; i < choosing_values(sweep); ++i) {
        values[i] = choosing_value(table, sweep, i, left_out);
    }
    return choice_pick(values, choosing_values(sweep));
}

static int least_of(const choosing_table *table, int sweep) {
    int least = 0;
    for (int i = 1; i < choosing_values(sweep); ++i) {
        if (choosing_value(table, sweep, i, -1).evaluations <
            choosing_value(table, sweep, least, -1).evaluations) {
            least = i;
        }
    }
    return least;
}

static void write_value(char to[32], int sweep, int value) {
    if (sweep == choosing_methods) {
        snprintf(to, 32, "%s", choice_method[value]);
    } else {
        write_number(to, choosing_number(sweep, value));
    }
}

/* The header's value, if it is among those that were tried; else -1. */
static int header_of(int sweep) {
    spt_settings defaults = spt_settings_default();
    for (int i = 0; i < choosing_values(sweep); ++i) {
        if (sweep == choosing_methods) {
            if (strcmp(spt_method_name(defaults.method), choice_method[i]) == 0) return i;
            continue;
        }
        const double header = (double)*choice_setting(&defaults, choice_sweep_of[sweep].setting);
        if (fabs(header - choosing_number(sweep, i)) < 1e-6) return i;
    }
    return -1;
}

static void from_sweep(const choosing_table *table, int sweep, FILE *rows) {
    const char *const setting =
        sweep == choosing_methods ? "method" : choice_sweep_of[sweep].setting;
    default_row row = row_of(setting, "fewest evaluations");
    const int chosen = pick(table, sweep, -1), least = least_of(table, sweep);
    const int header = header_of(sweep);
    int low = chosen, high = chosen;
    for (int kind = 0; kind < choice_kinds; ++kind) {
        const int without = pick(table, sweep, kind);
        low = without < low ? without : low;
        high = without > high ? without : high;
    }
    report_expect(low >= 0, "every value loses rays");
    write_value(row.chosen, sweep, chosen);
    write_value(row.least, sweep, least);
    write_value(row.low, sweep, low);
    write_value(row.high, sweep, high);
    if (header >= 0) {
        write_value(row.header, sweep, header);
        row.above = 100 * (choosing_value(table, sweep, header, -1).evaluations /
                               choosing_value(table, sweep, least, -1).evaluations -
                           1);
    }
    write_row(&row, rows);
}

/* ---- Binary tracing -------------------------------------------------------------------------- */

static double probes_of(const csv_table *from, double bonus, double penalty) {
    for (int row = 0; row < csv_rows(from); ++row) {
        if (fabs(csv_number(from, row, "bonus") - bonus) < 1e-6 &&
            fabs(csv_number(from, row, "penalty") - penalty) < 1e-6) {
            return csv_number(from, row, "probes");
        }
    }
    return (double)NAN;
}

/* The least probes by one of the two numbers, the other as given; of bonuses those that decide a
 * ray without end by `endless`, or all (NULL). */
static double least_probes(const csv_table *from, const csv_table *endless, int is_bonus,
                           double other, double *least) {
    double fewest = HUGE_VAL;
    for (int row = 0; row < csv_rows(from); ++row) {
        const double value = csv_number(from, row, is_bonus ? "bonus" : "penalty");
        const double probes =
            is_bonus ? probes_of(from, value, other) : probes_of(from, other, value);
        if (endless != NULL) {
            const int decides = csv_next(endless, -1, "bonus=%s", csv_text(from, row, "bonus"));
            report_expect(decides >= 0, "binary_endless.csv is not whole");
            if (csv_number(endless, decides, "decided") < 1) continue;
        }
        if (probes < fewest) {
            fewest = probes;
            *least = value;
        }
    }
    return fewest;
}

/* The value of the paper, unless another one saves more than two percent of the probes: then that
 * with the least. First the bonus, at the paper's penalty, then the penalty at that bonus. A ray
 * without end must be decided within the default budget, which asks for a bonus of 2 or more. */
static void from_binary(const report_options *options, FILE *rows) {
    const double paper_bonus = 2, paper_penalty = 0.3; /* section 6.1 */
    const spt_binary header = spt_binary_default();
    csv_table *const from = csv_open(options->output, "binary_mean");
    csv_table *const endless = csv_open(options->output, "binary_endless");
    default_row row = row_of("bonus", "the paper's unless two percent are saved");
    double bonus = paper_bonus, penalty = paper_penalty, least = paper_bonus;
    double fewest = least_probes(from, endless, 1, paper_penalty, &least);
    if (probes_of(from, paper_bonus, paper_penalty) > fewest / 0.98) bonus = least;
    fewest = least_probes(from, NULL, 1, paper_penalty, &least);
    write_number(row.chosen, bonus);
    write_number(row.header, (double)header.bonus);
    write_number(row.least, least);
    row.above = 100 * (probes_of(from, (double)header.bonus, paper_penalty) / fewest - 1);
    write_row(&row, rows);
    row.setting = "penalty";
    fewest = least_probes(from, NULL, 0, bonus, &least);
    if (probes_of(from, bonus, paper_penalty) > fewest / 0.98) penalty = least;
    write_number(row.chosen, penalty);
    write_number(row.header, (double)header.penalty);
    write_number(row.least, least);
    row.above = 100 * (probes_of(from, bonus, (double)header.penalty) / fewest - 1);
    write_row(&row, rows);
    csv_close(from);
    csv_close(endless);
}

/* ---- Chunks and schedules -------------------------------------------------------------------- */

/* Arithmetic on sizes: no time decides. */
static void from_chunk(const report_options *options, FILE *rows) {
    const double first_cache = 32768;
    csv_table *const from = csv_open(options->output, "chunk");
    default_row row = row_of("SPT_BATCH", "largest in the first cache");
    double chosen = 0;
    for (int i = 0; i < csv_rows(from); ++i) {
        if (csv_number(from, i, "bytes") <= first_cache) {
            chosen = fmax(chosen, csv_number(from, i, "rays_a_call"));
        }
    }
    write_number(row.chosen, chosen);
    write_number(row.header, SPT_BATCH);
    write_row(&row, rows);
    csv_close(from);
}

/* What a frame does unless it is told otherwise, as schedules_mean.csv calls it. */
static void default_schedule(char to[32]) {
    const scene *const shown = scene_named("sphere");
    const spt_camera camera = scene_camera(shown, 64, 64);
    const spt_field field = scene_field(shown, spt_lanes());
    spt_scene all = spt_scene_default();
    spt_frame frame;
    all.fields = &field;
    all.count = 1;
    report_expect(spt_frame_init(&frame, &all, &camera, 64, 64) == SPT_OK, "a frame is refused");
    if (frame.passes != NULL) {
        snprintf(to, 32, "passes_%zu", (size_t)frame.pass_count);
    } else {
        snprintf(to, 32, "%s", (frame.flags & SPT_FRAME_NO_CONES) != 0 ? "rays" : "cones");
    }
}

/* Of schedules with equally few evaluations the one that takes less time. */
static void from_schedules(const report_options *options, FILE *rows) {
    csv_table *const from = csv_open(options->output, "schedules_mean");
    default_row row = row_of("schedule", "fewest evaluations a pixel");
    int best = 0;
    for (int i = 1; i < csv_rows(from); ++i) {
        const double fewer =
            csv_number(from, best, "evaluations") / csv_number(from, i, "evaluations");
        const double faster = csv_number(from, best, "ratio") / csv_number(from, i, "ratio");
        if (fewer > 1 + 1e-6 || (fewer > 1 - 1e-6 && faster > 1)) best = i;
    }
    snprintf(row.chosen, sizeof row.chosen, "%s", csv_text(from, best, "schedule"));
    default_schedule(row.header);
    write_row(&row, rows);
    csv_close(from);
}

static int one_cell(const report_options *options) {
    (void)options;
    return 1;
}

static void measure(const report_options *options, int cell, FILE *rows) {
    choosing_table *const table = choosing_table_read(options);
    (void)cell;
    from_sweep(table, choosing_methods, rows);
    for (int sweep = 0; sweep < choice_sweeps; ++sweep) {
        int first = 1;
        for (int i = 0; i < sweep; ++i) {
            first &= strcmp(choice_sweep_of[i].setting, choice_sweep_of[sweep].setting) != 0;
        }
        if (first) from_sweep(table, sweep, rows);
    }
    free(table);
    from_chunk(options, rows);
    from_schedules(options, rows);
    from_binary(options, rows);
}

const report_part report_defaults = {
    "defaults", "setting,rule,chosen,header,agrees,least,above,low,high", one_cell, measure, 0,
    {0.1, 0.1}};
