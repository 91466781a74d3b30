/* SPDX-License-Identifier: MIT
 *
 * Kernel-reflection sequences by their number of levels, as in Figure 12 of Szécsi et al. 2016 and
 * at its resolution, half of it in a quick report: rays one by one, binary tracing, cones ahead,
 * ambient occlusion. All ways take turns on the same tiles, which lie all over the picture. */
#include "claims_levels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 1920, HEIGHT = 1200 };

enum {
    DIRECT_BASIC,
    DIRECT,
    UNBOUNDED,
    BINARY,
    BINARY_SAME_ERROR,
    CONES_BASIC,
    CONES,
    MOEBIUS_BINARY,
    MOEBIUS_BOUND,
    COMPOUND
};

static const level_way ways[] = {
    {"direct_basic", LEVEL_TRACE, krs_single_direct, 0, 0, DIRECT_BASIC},
    {"direct", LEVEL_TRACE, krs_single_direct_adaptive, 0, 0, DIRECT_BASIC},
    {"direct_unbounded", LEVEL_UNBOUNDED, krs_single_direct_adaptive, 0, 0, DIRECT},
    {"binary", LEVEL_TRACE, krs_single_binary, 0, 0, DIRECT_BASIC},
    {"binary_same_error", LEVEL_TRACE, krs_single_binary_same_error, 0, 0, DIRECT_BASIC},
    {"cones_basic", LEVEL_TRACE, krs_single_cones, 0, 0, DIRECT_BASIC},
    {"cones", LEVEL_TRACE, krs_single_cones_adaptive, 0, 0, DIRECT},
    {"moebius_binary", LEVEL_TRACE, krs_moekrs_binary, 0, 0, MOEBIUS_BINARY},
    {"moebius_bound", LEVEL_TRACE, krs_moekrs_bound_adaptive, 0, 0, MOEBIUS_BINARY},
    {"compound_cones", LEVEL_TRACE, krs_compound_cones_adaptive, 0, 0, COMPOUND},
    {"occlusion", LEVEL_OCCLUSION, krs_single_direct, 5, 1, DIRECT},
    {"occlusion_quarter", LEVEL_OCCLUSION, krs_single_direct, 5, 4, DIRECT},
    {"occlusion_1_sample", LEVEL_OCCLUSION, krs_single_direct, 1, 1, DIRECT},
};
enum { WAYS = sizeof ways / sizeof ways[0] };

static int cells(const report_options *options) {
    return options->quick ? 7 : KRS_NUMBERS;
}

/* 2, 4 .. 28 levels; every other of them, and so few that most of a run is left for more, in a
 * quick report: 2, 6, 10 .. 26. */
static uint32_t levels_of(const report_options *options, int cell) {
    return (uint32_t)(KRS_FIRST + (options->quick ? 2 : 1) * KRS_STEP * cell);
}

static void enter(level_track *track, const report_options *options, uint32_t levels) {
    static const krs_body bodies[] = {KRS_TREE, KRS_PALM, KRS_KINDS};
    const int coarser = options->quick ? 2 : 1;
    float low[3], high[3];
    memset(track, 0, sizeof *track);
    krs_models_build(&track->models, levels, 0);
    for (size_t i = 0; i < sizeof bodies / sizeof bodies[0]; ++i) {
        const krs_body body = bodies[i];
        frame_picture *const picture =
            frame_picture_of(krs_view(body), WIDTH / coarser, HEIGHT / coarser);
        track->pictures[body] = picture;
        track->parts[body] = *picture;
        track->parts[body].tiles = picture->tiles / (options->quick ? 10 : 18);
        track->parts[body].count = picture->first[track->parts[body].tiles];
        track->samples[body] = krs_sample_of(&track->parts[body]);
    }
    const size_t count = track->pictures[KRS_TREE]->count;
    const size_t part = track->parts[KRS_TREE].count;
    track->hits = frame_image_of(count);
    track->image = frame_image_of(count);
    track->points = report_allocate(3 * part * sizeof *track->points);
    track->normals = report_allocate(3 * part * sizeof *track->normals);
    track->openness = report_allocate(part * sizeof *track->openness);
    spt_bound_extent(krs_models_field(&track->models, KRS_TREE)->bound, low, high);
    track->reach = 0.05f * fmaxf(high[0] - low[0], fmaxf(high[1] - low[1], high[2] - low[2]));
}

static void leave(level_track *track) {
    for (int body = 0; body < krs_bodies; ++body) {
        if (track->pictures[body] == NULL) continue;
        frame_picture_free(track->pictures[body]);
        krs_sample_free(&track->samples[body]);
    }
    free(track->hits);
    free(track->image);
    free(track->points);
    free(track->normals);
    free(track->openness);
    free(track);
}

/* What hits of rays one by one are worth, and the end of probes with which binary tracing errs no
 * more than direct tracing does: "the ray termination error threshold has to be set much lower"
 * (section 11). */
static void judge(level_track *track, level_runner *runners, krs_error *errors) {
    const double least = 0.05;
    for (int body = KRS_TREE; body <= KRS_PALM; ++body) {
        if (body != KRS_TREE && body != KRS_PALM) continue;
        const spt_settings settings =
            krs_settings(krs_single_direct, track->parts[body].pixel_radius);
        krs_sample_exact(&track->samples[body], &track->models, (krs_body)body, &settings);
    }
    for (int i = 0; i < WAYS; ++i) {
        if (ways[i].work != LEVEL_TRACE || krs_case_of[ways[i].traced].how == KRS_FRAME) continue;
        level_runner *const runner = &runners[i];
        if (i == BINARY_SAME_ERROR) runner->probe_ratio = 1;
        errors[i] = level_judge(runner);
        while (i == BINARY_SAME_ERROR && runner->probe_ratio > least &&
               errors[i].mean > errors[DIRECT_BASIC].mean) {
            runner->probe_ratio *= 0.9;
            errors[i] = level_judge(runner);
        }
    }
}

static void race(level_runner *runners, int rounds) {
    for (int round = 0; round < rounds; ++round) {
        for (int turn = 0; turn < WAYS; ++turn) {
            level_runner *const runner = &runners[(round + turn) % WAYS];
            runner->seconds[round] = level_run(runner, round);
        }
    }
}

static void write_row(const level_runner *runners, int which, const krs_error *error, int rounds,
                      FILE *rows) {
    const level_runner *const runner = &runners[which], *const base = &runners[ways[which].against];
    const level_way *const way = runner->way;
    const int traced = way->work != LEVEL_OCCLUSION, frame = runner->frame.workspace != NULL;
    const krs_described *const described = &krs_case_of[way->traced];
    const level_track *const track = runner->track;
    const double pixels = (double)track->parts[traced ? described->body : KRS_TREE].count;
    const claims_spread spread = claims_seconds(runner->seconds, rounds);
    const double evaluations =
        (double)(runner->statistics.evaluations + runner->statistics.cone_evaluations);
    const double of_base =
        (double)(base->statistics.evaluations + base->statistics.cone_evaluations);
    fprintf(rows, "%s,%u,%.9g,%s", way->name, (unsigned)track->models.levels,
            krs_models_instances(track->models.levels, traced ? described->body : KRS_TREE),
            traced ? described->rule : "");
    claims_write(rows, 1e9 * spread.middle / pixels);
    claims_write(rows, claims_noise(spread));
    claims_write(rows, evaluations / pixels);
    claims_write(rows, 1e9 * spread.middle / evaluations);
    fprintf(rows, ",%s", base->way->name);
    claims_write_spread(rows, claims_faster(runner->seconds, base->seconds, rounds));
    claims_write(rows, of_base / evaluations);
    const int judged = way->work == LEVEL_TRACE && !frame;
    claims_write(rows, judged ? error->mean : (double)NAN);
    claims_write(rows, judged ? error->lost : (double)NAN);
    claims_write(rows, judged ? error->undecided : (double)NAN);
    claims_write(rows, judged && described->how == KRS_BINARY ? runner->probe_ratio : (double)NAN);
    fputc('\n', rows);
}

static void measure(const report_options *options, int cell, FILE *rows) {
    const int rounds = options->quick ? 7 : 9;
    level_track *const track = report_allocate(sizeof *track);
    level_runner *const runners = report_allocate(WAYS * sizeof *runners);
    krs_error errors[WAYS];
    enter(track, options, levels_of(options, cell));
    for (int i = 0; i < WAYS; ++i) level_enter(&runners[i], &ways[i], track);
    judge(track, runners, errors);
    level_run(&runners[DIRECT], 0);
    level_find_points(track);
    race(runners, rounds);
    for (int i = 0; i < WAYS; ++i) write_row(runners, i, &errors[i], rounds, rows);
    const double cost = claims_field_cost(krs_models_field(&track->models, KRS_TREE));
    fprintf(rows, "evaluation,%u,%.9g,,,,,%.9g,,,,,,,,,\n", (unsigned)track->models.levels,
            krs_models_instances(track->models.levels, KRS_TREE), cost);
    for (int i = 0; i < WAYS; ++i) level_leave(&runners[i]);
    free(runners);
    leave(track);
}

/* By pixel, but for per_evaluation: nanoseconds of an evaluation, all else included; of the way
 * `evaluation` by itself. faster, fewer: than the way `against`. error: how far hits are short of
 * the surface along the ray, in tolerances. */
const report_part report_claim_levels = {
    "claim_levels",
    "way,levels,instances,rule,nanoseconds,noise,evaluations,per_evaluation,against,faster,"
    "faster_low,faster_high,fewer,error,lost,undecided,probe_ratio",
    cells,
    measure,
    1,
    {60, 10}};

/* ---- Straight lines through them ------------------------------------------------------------ */

static int one_cell(const report_options *options) {
    (void)options;
    return 1;
}

static void write_line(const csv_table *levels, const char *way, const char *column, FILE *rows) {
    double x[KRS_NUMBERS], y[KRS_NUMBERS];
    char where[64];
    snprintf(where, sizeof where, "way=%s", way);
    const int count = csv_points(levels, where, "levels", column, x, y, KRS_NUMBERS);
    report_expect(count > 2, "a line through too few numbers of levels");
    const krs_line line = krs_line_through(x, y, count);
    fprintf(rows, "%s,%s,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", way, column, x[0], x[count - 1],
            line.offset, line.slope, line.straight, x[count - 1] / x[0], y[count - 1] / y[0]);
}

static void measure_lines(const report_options *options, int cell, FILE *rows) {
    csv_table *const levels = csv_open(options->output, "claim_levels");
    (void)cell;
    for (int i = 0; i < WAYS; ++i) write_line(levels, ways[i].name, "nanoseconds", rows);
    write_line(levels, "direct_unbounded", "per_evaluation", rows);
    write_line(levels, "evaluation", "per_evaluation", rows);
    csv_close(levels);
}

/* column = offset + slope levels, by least squares; straight: the square of the correlation. From
 * the fewest to the most levels, those and what is measured grow by these factors. */
const report_part report_claim_lines = {
    "claim_lines",
    "way,column,fewest,most,offset,slope,straight,levels_grow,grows",
    one_cell,
    measure_lines,
    0,
    {0.01, 0.01}};
