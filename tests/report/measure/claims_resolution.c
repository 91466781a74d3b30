/* SPDX-License-Identifier: MIT
 *
 * Step rules and resolutions that rise as Bálint & Valasek 2018, sections 4 and 5, compare them:
 * their three scenes, by the runs of error_runs.h, seen so that few rays escape. What cones save
 * depends on how many pixels they hold, so the pictures are the middle of one of 1280x720: in
 * that of error.csv a pixel is ten times as wide. Relaxed tracing has the parameter of its own
 * paper; in error.csv it has that of the library. All schedules take turns. */
#include "claims.h"
#include "error_runs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WHOLE_WIDTH = 1280, MOST_RUNNERS = 6 * report_rules, MOST_ROUNDS = 7 };

static const char *const shown[] = {"mandelbulb", "primitives", "village"};
enum { SCENES = sizeof shown / sizeof shown[0] };

static const char *const schedules[] = {"direct",   "frame",    "passes_1",
                                        "passes_2", "passes_4", "passes_6"};
enum { SCHEDULES = sizeof schedules / sizeof schedules[0] };

static const uint32_t budgets[] = {8, 16, 24, 32, 64, 12, 48, 96, 128, 256};
enum { BUDGETS = sizeof budgets / sizeof budgets[0], QUICK_BUDGETS = 5 };

static int cells(const report_options *options) {
    (void)options;
    return SCENES;
}

/* The middle of the whole picture, which is this wide. Rays stop in their pixel's cone, as in the
 * paper's Equation 2. */
static error_scene *enter(const scene *whole, scene *middle, int width, int height) {
    error_scene *const in = report_allocate(sizeof *in);
    const double degree = acos(-1.0) / 180;
    *middle = *whole;
    middle->field_of_view =
        2 * atan(tan(whole->field_of_view / 2 * degree) * width / WHOLE_WIDTH) / degree;
    in->shown = middle;
    in->picture = frame_picture_of(middle, width, height);
    in->count = in->picture->count;
    in->settings = spt_settings_default();
    in->settings.pixel_radius = in->picture->pixel_radius;
    in->settings.relaxation =
        1.2f; /* "yielded the best performance": Keinert et al. 2014, section 4 */
    in->truth = report_allocate(in->count * sizeof *in->truth);
    in->identity = report_allocate(in->count * sizeof *in->identity);
    in->hits = report_allocate(in->count * sizeof *in->hits);
    for (size_t i = 0; i < in->count; ++i) {
        in->truth[i] = error_truth_of(middle, &in->settings, &in->picture->rays[i]);
        in->identity[i] = i;
    }
    return in;
}

/* All schedules and rules with one budget. */
static void measure_budget(const error_scene *in, uint32_t budget, int rounds, FILE *rows) {
    error_runner runners[MOST_RUNNERS];
    error_score scores[MOST_RUNNERS];
    double seconds[MOST_RUNNERS][MOST_ROUNDS];
    const char *schedule[MOST_RUNNERS];
    int count = 0;
    for (int i = 0; i < SCHEDULES; ++i) {
        const int end = count + error_ours(runners + count, in, schedules[i], budget);
        for (; count < end; ++count) schedule[count] = schedules[i];
    }
    for (int i = 0; i < count; ++i) {
        runners[i].run(&runners[i], in, 1);
        scores[i] = error_judge(in, &runners[i]);
    }
    for (int round = 0; round < rounds; ++round) {
        for (int turn = 0; turn < count; ++turn) {
            const int i = (round + turn) % count;
            seconds[i][round] = runners[i].run(&runners[i], in, 0);
        }
    }
    for (int i = 0; i < count; ++i) {
        const claims_spread spread = claims_seconds(seconds[i], rounds);
        fprintf(rows, "%s,%s,%s,%u,%zu,%zu", in->shown->name, schedule[i], runners[i].method,
                (unsigned)budget, in->count, scores[i].truth_hits);
        claims_write(rows, 1e9 * spread.middle / (double)in->count);
        claims_write(rows, claims_noise(spread));
        claims_write(rows, scores[i].evaluations);
        claims_write(rows, scores[i].rms);
        claims_write(rows, (double)scores[i].undecided);
        fputc('\n', rows);
        runners[i].close(&runners[i]);
    }
}

static int ascending(const void *a, const void *b) {
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static void measure(const report_options *options, int cell, FILE *rows) {
    const int quick = options->quick, count = quick ? QUICK_BUDGETS : BUDGETS;
    uint32_t wanted[BUDGETS];
    scene middle;
    error_scene *const in =
        enter(scene_named(shown[cell]), &middle, quick ? 128 : 192, quick ? 64 : 128);
    memcpy(wanted, budgets, sizeof wanted);
    qsort(wanted, (size_t)count, sizeof *wanted, ascending);
    for (int i = 0; i < count; ++i) measure_budget(in, wanted[i], quick ? 3 : MOST_ROUNDS, rows);
    error_scene_free(in);
}

/* By ray, as in error.csv. */
const report_part report_claim_resolution = {
    "claim_resolution",
    "scene,schedule,method,budget,rays,truth_hits,nanoseconds,noise,evaluations,rms,undecided",
    cells,
    measure,
    1,
    {31, 4}};
