/* SPDX-License-Identifier: MIT
 *
 * The cases against the number of levels: all take turns on the same part of a picture, round by
 * round, until every one has traced all of it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "krs_report.h"

enum { BUDGET = 1024 };

const krs_described krs_case_of[krs_cases] = {
#define X(name, how, body, rule, same_error) {#name, how, body, rule, same_error},
    KRS_CASES(X)
#undef X
};

/* The pictures by body, shared where bodies are seen alike, and memory for their hits. */
typedef struct race_track {
    const bench_options *options;
    frame_picture *pictures[krs_bodies];
    krs_sample samples[krs_bodies];
    bench_hit *hits, *image;
    bench_hit *found[krs_cases]; /* of the samples */
    krs_models models;
    spt_frame frames[krs_cases];
    spt_statistics statistics[krs_cases];
} race_track;

spt_settings krs_settings(krs_case which, float pixel_radius) {
    const krs_described *const described = &krs_case_of[which];
    spt_settings settings = spt_settings_default();
    if (described->how != KRS_BINARY) settings.method = bench_method(described->rule);
    settings.pixel_radius = pixel_radius;
    settings.budget = BUDGET;
    return settings;
}

void krs_trace(const krs_models *models, krs_case which, float probe_ratio,
               const spt_settings *settings, size_t count, const spt_ray *rays, bench_hit *hits,
               spt_statistics *statistics) {
    const krs_body body = krs_case_of[which].body;
    const spt_rays columns = spt_rays_of(rays);
    const spt_hits sinks = bench_hits_of(hits);
    if (krs_case_of[which].how == KRS_DIRECT) {
        frame_expect(spt_trace(krs_models_field(models, body), settings, count, &columns, &sinks,
                               statistics),
                     "spt_trace");
        return;
    }
    spt_binary binary = spt_binary_default();
    binary.probe_ratio = probe_ratio;
    frame_expect(spt_binary_trace(&models->probes[body], &binary, settings, count, &columns, &sinks,
                                  statistics),
                 "spt_binary_trace");
}

/* ---- Racing -------------------------------------------------------------------------------- */

static void enter_frame(race_track *track, krs_case which) {
    const krs_body body = krs_case_of[which].body;
    const frame_picture *const picture = track->pictures[body];
    spt_frame *const frame = &track->frames[which];
    frame_expect(spt_frame_init(frame, &track->models.scenes[body], &picture->camera,
                                picture->width, picture->height),
                 "spt_frame_init");
    frame->settings = krs_settings(which, frame->settings.pixel_radius);
    frame->workspace_size = spt_frame_workspace(frame);
    frame->workspace = frame_allocate(frame->workspace_size);
    frame->statistics = &track->statistics[which];
}

/* Seconds of a pixel of a slice. */
static double run(race_track *track, krs_case which, double probe_ratio, frame_slice slice) {
    const frame_picture *const picture = track->pictures[krs_case_of[which].body];
    const size_t first = picture->first[slice.begin], count = frame_slice_rays(picture, slice);
    const spt_settings settings = krs_settings(which, picture->pixel_radius);
    const spt_hits sinks = bench_hits_of(track->image);
    const double before = bench_seconds();
    if (krs_case_of[which].how != KRS_FRAME) {
        krs_trace(&track->models, which, (float)probe_ratio, &settings, count,
                  picture->rays + first, track->hits + first, &track->statistics[which]);
    } else {
        for (size_t i = slice.begin; i < slice.end; ++i) {
            frame_expect(spt_frame_tile(&track->frames[which], picture->order[i], &sinks),
                         "spt_frame_tile");
        }
    }
    return (bench_seconds() - before) / (double)count;
}

/* Keeps what a case has just found of its sample. */
static void keep_sample(race_track *track, krs_case which, frame_slice slice) {
    const frame_picture *const picture = track->pictures[krs_case_of[which].body];
    const krs_sample *const sample = &track->samples[krs_case_of[which].body];
    const size_t first = picture->first[slice.begin], end = picture->first[slice.end];
    const int by_pixel = krs_case_of[which].how == KRS_FRAME;
    for (size_t i = 0; i < sample->count; ++i) {
        const size_t place = sample->place[i];
        if (place < first || place >= end) continue;
        track->found[which][i] = track->hits[place];
        if (by_pixel) track->found[which][i] = track->image[picture->pixel[place]];
    }
}

static double evaluations_of(const spt_statistics *statistics) {
    return (double)(statistics->evaluations + statistics->cone_evaluations);
}

static void race_rounds(race_track *track, krs_result results[krs_cases]) {
    static double per_evaluation[krs_cases][BENCH_MOST_ROUNDS];
    const int rounds = track->options->rounds;
    for (int round = 0; round < rounds; ++round) {
        for (int turn = 0; turn < krs_cases; ++turn) {
            const krs_case which = (krs_case)((round + turn) % krs_cases);
            const frame_picture *const picture = track->pictures[krs_case_of[which].body];
            const frame_slice slice = frame_slice_of(picture, round, rounds);
            const double before = evaluations_of(&track->statistics[which]);
            const double seconds = run(track, which, results[which].probe_ratio, slice);
            const double more = evaluations_of(&track->statistics[which]) - before;
            keep_sample(track, which, slice);
            results[which].seconds[round] = seconds;
            per_evaluation[which][round] =
                seconds * 1e9 * (double)frame_slice_rays(picture, slice) / more;
        }
    }
    for (int which = 0; which < krs_cases; ++which) {
        double seconds[BENCH_MOST_ROUNDS];
        memcpy(seconds, results[which].seconds, sizeof seconds);
        results[which].nanoseconds = bench_median(seconds, rounds) * 1e9;
        results[which].per_evaluation = bench_median(per_evaluation[which], rounds);
        results[which].evaluations =
            frame_evaluations(&track->statistics[which], track->pictures[0]);
    }
}

/* ---- What hits are worth ------------------------------------------------------------------- */

/* Traces the sample by itself. */
static krs_error judge_alone(race_track *track, krs_case which, double probe_ratio) {
    const krs_body body = krs_case_of[which].body;
    const krs_sample *const sample = &track->samples[body];
    const spt_settings settings = krs_settings(which, track->pictures[body]->pixel_radius);
    krs_trace(&track->models, which, (float)probe_ratio, &settings, sample->count, sample->rays,
              track->found[which], NULL);
    return krs_sample_judge(sample, &settings, track->found[which]);
}

/* The earliest end of probes with which binary tracing errs no more than direct tracing does. */
static double same_error(race_track *track, krs_case which) {
    const double least = 0.05, error = judge_alone(track, krs_single_direct, 0).mean;
    double ratio = 1;
    while (ratio > least && judge_alone(track, which, ratio).mean > error) ratio *= 0.9;
    return ratio;
}

static void find_exact(race_track *track, krs_body body) {
    const spt_settings settings =
        krs_settings(krs_single_direct, track->pictures[body]->pixel_radius);
    krs_sample_exact(&track->samples[body], &track->models, body, &settings);
}

static void judge(race_track *track, krs_result results[krs_cases]) {
    for (int which = 0; which < krs_cases; ++which) {
        const krs_body body = krs_case_of[which].body;
        const spt_settings settings =
            krs_settings((krs_case)which, track->pictures[body]->pixel_radius);
        results[which].error =
            krs_sample_judge(&track->samples[body], &settings, track->found[which]);
    }
}

/* ---- All levels ---------------------------------------------------------------------------- */

static void enter(race_track *track, const bench_options *options) {
    track->options = options;
    for (int body = 0; body < krs_bodies; ++body) {
        const int seen_before = body == KRS_COPIES || body == KRS_KINDS;
        track->pictures[body] = seen_before ? track->pictures[KRS_GROVE]
                                            : frame_picture_of(krs_view((krs_body)body),
                                                               options->width, options->height);
        track->samples[body] = krs_sample_of(track->pictures[body]);
    }
    for (int which = 0; which < krs_cases; ++which) {
        track->found[which] = frame_image_of(track->samples[krs_case_of[which].body].count);
    }
    track->hits = frame_image_of(track->pictures[0]->count);
    track->image = frame_image_of(track->pictures[0]->count);
}

static void leave(race_track *track) {
    for (int body = 0; body < krs_bodies; ++body) {
        krs_sample_free(&track->samples[body]);
        if (body != KRS_COPIES && body != KRS_KINDS) frame_picture_free(track->pictures[body]);
    }
    for (int which = 0; which < krs_cases; ++which) free(track->found[which]);
    free(track->hits);
    free(track->image);
}

static void race_levels(race_track *track, krs_table *table, int number) {
    krs_result *const results = table->results[number];
    memset(results, 0, sizeof table->results[number]);
    krs_models_build(&track->models, table->levels[number], 0);
    for (int body = 0; body < krs_bodies; ++body) find_exact(track, (krs_body)body);
    for (int i = 0; i < krs_cases; ++i) {
        const krs_case which = (krs_case)i;
        track->statistics[which] = spt_statistics_default();
        results[which].probe_ratio = (double)spt_binary_default().probe_ratio;
        if (krs_case_of[which].how == KRS_FRAME) enter_frame(track, which);
        if (krs_case_of[which].same_error) results[which].probe_ratio = same_error(track, which);
    }
    race_rounds(track, results);
    judge(track, results);
    for (int rule = 0; rule < 2; ++rule) {
        table->bound_over_binary[number][rule] =
            krs_hits_ratio(track->samples[KRS_PALM].count,
                           track->found[rule == 0 ? krs_moekrs_bound : krs_moekrs_bound_adaptive],
                           track->found[krs_moekrs_binary]);
    }
    for (int which = 0; which < krs_cases; ++which) {
        if (krs_case_of[which].how == KRS_FRAME) free(track->frames[which].workspace);
    }
}

int krs_race(const bench_options *options, FILE *file) {
    static race_track track;
    static krs_table table;
    enter(&track, options);
    table.rounds = options->rounds;
    krs_print_heading(options);
    for (int number = 0; number < KRS_NUMBERS; ++number) {
        table.levels[number] = (uint32_t)(KRS_FIRST + number * KRS_STEP);
        race_levels(&track, &table, number);
        krs_write_levels(&table, number, options, file);
    }
    leave(&track);
    krs_print_goals(&table);
    return krs_nothing_lost(&table);
}
