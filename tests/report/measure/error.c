/* SPDX-License-Identifier: MIT
 *
 * error.csv: how far from the truth, and after what time and how many evaluations, every method,
 * schedule and control is with every budget (Bálint & Valasek 2018, section 5). A cell: a scene. */
#include "error_runs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const schedules[] = {"direct",   "frame",    "passes_1", "passes_2",
                                        "passes_4", "passes_6", "control"};
enum { SCHEDULES = sizeof schedules / sizeof schedules[0] };

/* Building a shader takes longer than running it. */
static int in_shaders(const report_options *options, uint32_t budget) {
    if (options->quick) return budget == 16 || budget == 64;
    return budget == 8 || budget == 16 || budget == 32 || budget == 64 || budget == 128 ||
           budget == 512;
}

/* ---- The clock ------------------------------------------------------------------------------ */

enum { most_rounds = 9 };

/* Those of a scene and a schedule with every budget, against each other. Their times are compared
 * across budgets, so that all of them take turns in each round: whatever the machine does meanwhile
 * then shows in the noise of each, and not between them. */
typedef struct error_contest {
    const char *schedule;
    int budgets, count, rounds;
    error_runner runner[error_budget_count * error_most_runners];
    error_score score[error_budget_count * error_most_runners];
    double nanoseconds[error_budget_count * error_most_runners][most_rounds]; /* a ray */
} error_contest;

/* Long enough for the clock. */
static double seconds_of(error_runner *runner, const error_scene *in, double least) {
    double seconds = 0;
    int times = 0;
    for (; seconds < least; ++times) seconds += runner->run(runner, in, 0);
    return seconds / times;
}

/* Whose turn it is: every second round goes backwards and each begins elsewhere, so that nobody
 * always comes behind the same other one. */
static int turn_of(const error_contest *contest, int turn) {
    const int begin = contest->rounds * contest->count / most_rounds;
    const int i = (turn + begin) % contest->count;
    return contest->rounds % 2 == 0 ? i : contest->count - 1 - i;
}

/* Seconds that the rounds may take. */
static double most_seconds(const report_options *options, const error_contest *contest) {
    return (options->quick ? 0.07 : 0.22) * contest->budgets;
}

/* Behind the rounds that are there already. Slow ones get fewer: a long run is a mean by itself. */
static void take_times(const report_options *options, const error_scene *in,
                       error_contest *contest) {
    const int rounds = options->quick ? 7 : most_rounds, fewest = contest->rounds > 0 ? 1 : 3;
    const double least = options->quick ? 1e-4 : 5e-4;
    const double most = most_seconds(options, contest);
    const double before = bench_seconds();
    for (; contest->rounds < rounds; ++contest->rounds) {
        if (contest->rounds >= fewest && bench_seconds() - before > most) break;
        for (int turn = 0; turn < contest->count; ++turn) {
            const int i = turn_of(contest, turn);
            const double seconds = seconds_of(&contest->runner[i], in, least);
            contest->nanoseconds[i][contest->rounds] = seconds * 1e9 / (double)in->count;
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

/* Controls write the same in every run, so that their first one counts; where it was long it is the
 * only one. */
static void measure_contest(const report_options *options, const error_scene *in,
                            error_contest *contest, FILE *rows) {
    const int ours = strcmp(contest->schedule, "control") != 0;
    double first = 0;
    for (int i = 0; i < contest->count; ++i) {
        error_runner *const runner = &contest->runner[i];
        memset(in->hits, 0, in->count * sizeof *in->hits);
        const double seconds = runner->run(runner, in, 1);
        contest->nanoseconds[i][0] = seconds * 1e9 / (double)in->count;
        first += seconds;
        contest->score[i] = error_judge(in, runner);
        if (ours) error_check_promises(in, runner);
    }
    contest->rounds = ours ? 0 : 1;
    if (ours || first < most_seconds(options, contest)) take_times(options, in, contest);
    for (int i = 0; i < contest->count; ++i) {
        write_row(rows, in, contest->schedule, &contest->runner[i], &contest->score[i],
                  contest->nanoseconds[i], contest->rounds);
        contest->runner[i].close(&contest->runner[i]);
    }
}

static void add_budget(const report_options *options, const error_scene *in, uint32_t budget,
                       error_contest *contest) {
    error_runner *const runners = contest->runner + contest->count;
    if (strcmp(contest->schedule, "control") != 0) {
        contest->count += error_ours(runners, in, contest->schedule, budget);
    } else {
        int count = error_controls(runners, in, budget);
        if (in_shaders(options, budget)) count += error_shaders(runners + count, in, budget);
        contest->count += count;
    }
    ++contest->budgets;
}

static void measure(const report_options *options, int cell, FILE *rows) {
    error_scene *const in = error_scene_of(options, report_scenes[cell]);
    error_contest *const contest = report_allocate(sizeof *contest);
    for (int schedule = 0; schedule < SCHEDULES; ++schedule) {
        contest->schedule = schedules[schedule];
        contest->budgets = contest->count = 0;
        for (int i = 0; i < error_budget_count; ++i) {
            if (!error_budget_wanted(options, error_budgets[i])) continue;
            add_budget(options, in, error_budgets[i], contest);
        }
        measure_contest(options, in, contest, rows);
    }
    free(contest);
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
    {330, 25}};
