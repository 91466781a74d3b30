/* SPDX-License-Identifier: MIT
 *
 * error.csv: how far from the truth, and after what time and how many evaluations, every method,
 * schedule and control is with every budget (Bálint & Valasek 2018, section 5). A cell: a scene. */
#include "error_runs.h"

#include <math.h>
#include <string.h>

enum { most_rounds = 9 };

static const char *const schedules[] = {"direct",   "frame",    "passes_1",
                                        "passes_2", "passes_4", "passes_6"};
enum { SCHEDULES = sizeof schedules / sizeof schedules[0] };

/* Building a shader takes longer than running it. */
static int in_shaders(const report_options *options, uint32_t budget) {
    if (options->quick) return budget == 16 || budget == 64;
    return budget == 8 || budget == 16 || budget == 32 || budget == 64 || budget == 128 ||
           budget == 512;
}

/* ---- The clock ------------------------------------------------------------------------------ */

/* Rounds in which the runners take turns, each of them at least long enough for the clock. Slow
 * ones get fewer: a long run is a mean by itself. */
typedef struct error_times {
    int rounds;
    double nanoseconds[error_most_runners][most_rounds]; /* a ray */
} error_times;

static double seconds_of(error_runner *runner, const error_scene *in, double least) {
    double seconds = 0;
    int times = 0;
    for (; seconds < least; ++times) seconds += runner->run(runner, in, 0);
    return seconds / times;
}

/* Behind the rounds that are there already. */
static void take_times(const report_options *options, const error_scene *in, error_runner *runners,
                       int count, error_times *times) {
    const int rounds = options->quick ? 5 : most_rounds, fewest = times->rounds > 0 ? 1 : 3;
    const double least = options->quick ? 1e-4 : 5e-4, most = options->quick ? 0.08 : 0.25;
    const double before = bench_seconds();
    for (; times->rounds < rounds; ++times->rounds) {
        if (times->rounds >= fewest && bench_seconds() - before > most) break;
        for (int turn = 0; turn < count; ++turn) {
            const int i = (turn + times->rounds) % count;
            const double seconds = seconds_of(&runners[i], in, least);
            times->nanoseconds[i][times->rounds] = seconds * 1e9 / (double)in->count;
        }
    }
}

/* ---- Rows ----------------------------------------------------------------------------------- */

static void write_number(FILE *rows, double number) {
    if (isfinite(number)) fprintf(rows, ",%.9g", number);
    if (!isfinite(number)) fputc(',', rows);
}

/* noise: half the distance between the quartiles, over the median; of no single run. */
static void write_row(FILE *rows, const error_scene *in, const char *schedule,
                      const error_runner *runner, const error_score *score, double *nanoseconds,
                      int rounds) {
    const double median = report_quantile(nanoseconds, (size_t)rounds, 0.5);
    const double low = report_quantile(nanoseconds, (size_t)rounds, 0.25);
    const double high = report_quantile(nanoseconds, (size_t)rounds, 0.75);
    fprintf(rows, "%s,%s,%s,%u", in->shown->name, schedule, runner->method, runner->budget);
    write_number(rows, runner->lanes > 0 ? (double)runner->lanes : (double)NAN);
    write_number(rows, (double)in->count);
    write_number(rows, (double)score->truth_hits);
    write_number(rows, median);
    write_number(rows, rounds > 1 ? (high - low) / 2 / median : (double)NAN);
    write_number(rows, score->evaluations);
    write_number(rows, score->rms);
    write_number(rows, score->maximum);
    write_number(rows, score->rms_both);
    write_number(rows, score->iou);
    write_number(rows, (double)score->lost);
    write_number(rows, (double)score->ghosts);
    write_number(rows, (double)score->late);
    write_number(rows, (double)score->undecided);
    write_number(rows, score->rms * median);
    write_number(rows, score->rms * score->evaluations);
    fputc('\n', rows);
}

/* Those of a schedule and a budget, against each other. Controls write the same in every run, so
 * that their first one counts; where it was long it is the only one. */
static void measure_group(const report_options *options, const error_scene *in,
                          const char *schedule, error_runner *runners, int count, FILE *rows) {
    const int ours = strcmp(schedule, "control") != 0;
    error_score score[error_most_runners];
    error_times times;
    double first = 0;
    for (int i = 0; i < count; ++i) {
        memset(in->hits, 0, in->count * sizeof *in->hits);
        const double seconds = runners[i].run(&runners[i], in, 1);
        times.nanoseconds[i][0] = seconds * 1e9 / (double)in->count;
        first += seconds;
        score[i] = error_judge(in, &runners[i]);
        if (ours) error_check_promises(in, &runners[i]);
    }
    times.rounds = ours ? 0 : 1;
    if (ours || first < 0.25) take_times(options, in, runners, count, &times);
    for (int i = 0; i < count; ++i) {
        write_row(rows, in, schedule, &runners[i], &score[i], times.nanoseconds[i], times.rounds);
        runners[i].close(&runners[i]);
    }
}

static void measure_controls(const report_options *options, const error_scene *in, uint32_t budget,
                             FILE *rows) {
    error_runner runners[error_most_runners];
    int count = error_controls(runners, in, budget);
    if (in_shaders(options, budget)) count += error_shaders(runners + count, in, budget);
    measure_group(options, in, "control", runners, count, rows);
}

static void measure(const report_options *options, int cell, FILE *rows) {
    error_scene *const in = error_scene_of(options, report_scenes[cell]);
    for (int i = 0; i < error_budget_count; ++i) {
        const uint32_t budget = error_budgets[i];
        if (!error_budget_wanted(options, budget)) continue;
        for (int schedule = 0; schedule < SCHEDULES; ++schedule) {
            error_runner runners[error_most_runners];
            const int count = error_ours(runners, in, schedules[schedule], budget);
            measure_group(options, in, schedules[schedule], runners, count, rows);
        }
        measure_controls(options, in, budget, rows);
    }
    error_scene_free(in);
}

int error_cells(const report_options *options) {
    return options->quick ? report_kinds : report_scene_count;
}

const report_part report_error = {
    "error",
    "scene,schedule,method,budget,lanes,rays,truth_hits,nanoseconds,noise,evaluations,rms,maximum,"
    "rms_both,iou,lost,ghosts,late,undecided,error_time,error_evaluations",
    error_cells,
    measure,
    1,
    {330, 22}};
