/* SPDX-License-Identifier: MIT
 *
 * sweep.csv: evaluations and lost rays of every value of every setting, on ten kinds of field and
 * on stiff ones; sweep_mean.csv: their means. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../csv.h"
#include "choosing.h"

static const char *setting_of(int sweep) {
    return sweep == choosing_methods ? "method" : choice_sweep_of[sweep].setting;
}

static const char *method_of(int sweep, int value) {
    return sweep == choosing_methods ? choice_method[value] : choice_sweep_of[sweep].method;
}

int choosing_values(int sweep) {
    return sweep == choosing_methods ? (int)choice_methods : choice_sweep_of[sweep].count;
}

double choosing_number(int sweep, int value) {
    return sweep == choosing_methods ? value : (double)choice_sweep_of[sweep].values[value];
}

/* ---- Counting -------------------------------------------------------------------------------- */

static scene field_of(int number) {
    return number < choice_kinds ? *scene_named(choice_kind[number])
                                 : choosing_stiff(number - choice_kinds);
}

static spt_settings settings_of(const choosing_view *view, int sweep, int value) {
    const spt_settings defaults = spt_settings_default();
    spt_settings settings =
        choice_settings(&defaults, method_of(sweep, value), view->stop, view->pixel_radius);
    if (sweep != choosing_methods) {
        *choice_setting(&settings, setting_of(sweep)) = choice_sweep_of[sweep].values[value];
    }
    return settings;
}

static int sweep_cells(const report_options *options) {
    (void)options;
    return choosing_fields * choice_stops;
}

static void sweep_measure(const report_options *options, int cell, FILE *rows) {
    const int number = cell / choice_stops, stop = cell % choice_stops;
    const scene shown = field_of(number);
    choosing_view *const view = choosing_view_of(options, &shown, stop);
    spt_ray *const few = report_allocate((size_t)choice_width * choice_height * sizeof *few);
    float pixel_radius;
    const size_t few_count = choice_rays(&shown, choice_every, few, &pixel_radius);
    for (int sweep = 0; sweep <= choosing_methods; ++sweep) {
        for (int value = 0; value < choosing_values(sweep); ++value) {
            const spt_settings settings = settings_of(view, sweep, value);
            const choosing_count count = choosing_trace(view, &settings);
            const uint64_t sampled =
                choice_evaluations(&shown, &settings, few_count, few, view->hits).sum;
            fprintf(rows, "%s,%.6g,%s,%s,%s,%s,%.9g,%llu,%llu,%llu,%llu,%llu\n", setting_of(sweep),
                    choosing_number(sweep, value), method_of(sweep, value), choice_stop[stop],
                    shown.name, number < choice_kinds ? "kind" : "stiff", count.evaluations,
                    (unsigned long long)count.lost, (unsigned long long)count.late,
                    (unsigned long long)count.wrong, (unsigned long long)count.undecided,
                    (unsigned long long)sampled);
        }
    }
    free(few);
    choosing_view_free(view);
}

const report_part report_sweep = {
    "sweep",
    "parameter,value,method,stop,scene,kind,evaluations,lost,late,wrong_hits,undecided,sampled",
    sweep_cells,
    sweep_measure,
    0,
    {14, 4}};

/* ---- Reading --------------------------------------------------------------------------------- */

static int named(const char *const *names, int count, const char *name) {
    for (int i = 0; i < count; ++i) {
        if (strcmp(names[i], name) == 0) return i;
    }
    return -1;
}

static int field_named(const char *name) {
    const int kind = named(choice_kind, choice_kinds, name);
    for (int i = 0; kind < 0 && i < choosing_stiff_count; ++i) {
        if (strcmp(choosing_stiff(i).name, name) == 0) return choice_kinds + i;
    }
    return kind;
}

/* Where a row belongs. */
static choosing_cell *cell_of(choosing_table *table, const csv_table *from, int row) {
    const char *const setting = csv_text(from, row, "parameter");
    const char *const method = csv_text(from, row, "method");
    const double number = csv_number(from, row, "value");
    const int field = field_named(csv_text(from, row, "scene"));
    const int stop = named(choice_stop, choice_stops, csv_text(from, row, "stop"));
    for (int sweep = 0; field >= 0 && stop >= 0 && sweep <= choosing_methods; ++sweep) {
        if (strcmp(setting_of(sweep), setting) != 0) continue;
        for (int value = 0; value < choosing_values(sweep); ++value) {
            /* Half of the last of the six digits that were written. */
            if (strcmp(method_of(sweep, value), method) == 0 &&
                fabs(choosing_number(sweep, value) - number) <= 5e-6 * number) {
                return &table->cell[sweep][value][field][stop];
            }
        }
    }
    return NULL;
}

choosing_table *choosing_table_read(const report_options *options) {
    csv_table *const from = csv_open(options->output, "sweep");
    choosing_table *const table = report_allocate(sizeof *table);
    for (int row = 0; row < csv_rows(from); ++row) {
        choosing_cell *const cell = cell_of(table, from, row);
        report_expect(cell != NULL, "sweep.csv has a row that nobody wrote");
        cell->evaluations = csv_number(from, row, "evaluations");
        cell->lost = csv_number(from, row, "lost");
        cell->late = csv_number(from, row, "late");
        cell->wrong = csv_number(from, row, "wrong_hits");
        cell->undecided = csv_number(from, row, "undecided");
        cell->sampled = csv_number(from, row, "sampled");
    }
    csv_close(from);
    return table;
}

double choosing_mean(const choosing_table *table, int sweep, int value, int first, int last,
                     int first_stop, int last_stop, int left_out) {
    double sum = 0;
    int terms = 0;
    for (int field = first; field < last; ++field) {
        for (int stop = first_stop; field != left_out && stop < last_stop; ++stop, ++terms) {
            sum += log(table->cell[sweep][value][field][stop].evaluations);
        }
    }
    return exp(sum / terms);
}

/* The last kind, the Mandelbulb, is an estimate and no bound. */
static int is_bound(int field) {
    return field != choice_kinds - 1;
}

choice_value choosing_value(const choosing_table *table, int sweep, int value, int left_out) {
    choice_value seen = {
        choosing_mean(table, sweep, value, 0, choice_kinds, 0, choice_stops, left_out), 0};
    for (int field = 0; field < choosing_fields; ++field) {
        for (int stop = 0; is_bound(field) && stop < choice_stops; ++stop) {
            const choosing_cell *const cell = &table->cell[sweep][value][field][stop];
            seen.lost += (uint64_t)(cell->lost + cell->late);
        }
    }
    return seen;
}

/* ---- Means ----------------------------------------------------------------------------------- */

static int one_cell(const report_options *options) {
    (void)options;
    return 1;
}

static void write_mean(const choosing_table *table, int sweep, int value, FILE *rows) {
    const choice_value seen = choosing_value(table, sweep, value, -1);
    double estimate_lost = 0, wrong = 0, undecided = 0, sampled = 0;
    for (int stop = 0; stop < choice_stops; ++stop) {
        for (int field = 0; field < choosing_fields; ++field) {
            const choosing_cell *const cell = &table->cell[sweep][value][field][stop];
            if (!is_bound(field)) estimate_lost += cell->lost + cell->late;
            wrong += cell->wrong;
            undecided += cell->undecided;
            if (field < choice_kinds) sampled += cell->sampled;
        }
    }
    fprintf(rows, "%s,%.6g,%s,%.9g,%.9g,%.9g,%.9g,%llu,%.9g,%.9g,%.9g,%.9g\n", setting_of(sweep),
            choosing_number(sweep, value), method_of(sweep, value),
            choosing_mean(table, sweep, value, 0, choice_kinds, 0, 1, -1),
            choosing_mean(table, sweep, value, 0, choice_kinds, 1, 2, -1), seen.evaluations,
            choosing_mean(table, sweep, value, choice_kinds, choosing_fields, 0, choice_stops, -1),
            (unsigned long long)seen.lost, estimate_lost, wrong, undecided, sampled);
}

static void sweep_mean_measure(const report_options *options, int cell, FILE *rows) {
    choosing_table *const table = choosing_table_read(options);
    (void)cell;
    for (int sweep = 0; sweep <= choosing_methods; ++sweep) {
        for (int value = 0; value < choosing_values(sweep); ++value) {
            write_mean(table, sweep, value, rows);
        }
    }
    free(table);
}

const report_part report_sweep_mean = {
    "sweep_mean",
    "parameter,value,method,half_pixel,absolute,both,stiff,lost,estimate_lost,wrong_hits,undecided,"
    "sampled",
    one_cell,
    sweep_mean_measure,
    0,
    {0.1, 0.1}};
