/* SPDX-License-Identifier: MIT
 *
 * Rays of the eye with at most 80 evaluations each, as Keinert et al. 2014 cast their city and
 * their jewel (section 4), at their resolution: tiles from all over the picture, the same in all
 * rounds. */
#include "../../bench/keinert/keinert_cast.h"
#include "claims.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 1280, HEIGHT = 720 };

typedef struct cast_turn {
    cast_rule rule;
    cast_runner runner;
    frame_slice slice;
} cast_turn;

static double run(void *user, int round) {
    const cast_turn *const turn = user;
    const double before = bench_seconds();
    (void)round;
    cast_slice(&turn->runner, turn->slice);
    return bench_seconds() - before;
}

static void count(const cast_turn *turn, claims_result *result) {
    const cast_track *const track = turn->runner.track;
    const size_t begin = track->picture->first[turn->slice.begin];
    const size_t end = track->picture->first[turn->slice.end];
    cast_slice(&turn->runner, turn->slice);
    result->rays = (double)(end - begin);
    for (size_t i = begin; i < end; ++i) result->evaluations += (double)track->hits[i].evaluations;
}

void claims_cast(const report_options *options, const claims_case *measured,
                 claims_callback callback, int rounds, claims_result *results) {
    cast_turn turns[claims_most_ways];
    void *users[claims_most_ways];
    cast_track track;
    memset(&track, 0, sizeof track);
    track.shown = *scene_named(measured->scene);
    claims_repeat_scene(&track.shown, callback);
    track.picture = frame_picture_of(&track.shown, WIDTH, HEIGHT);
    track.hits = report_allocate(track.picture->count * sizeof *track.hits);
    for (int i = 0; i < measured->number; ++i) {
        cast_turn *const turn = &turns[i];
        const claims_way *const way = &measured->ways[i];
        const cast_rule rule = {way->name,       CAST_TRACE,   way->method,
                                way->relaxation, way->against, 0};
        turn->rule = rule;
        turn->slice.begin = 0;
        turn->slice.end = track.picture->tiles / (options->quick ? 16 : 5);
        cast_enter(&turn->runner, &turn->rule, &track);
        count(turn, &results[i]);
        users[i] = turn;
    }
    claims_race(measured, users, run, rounds, results);
    for (int i = 0; i < measured->number; ++i) cast_leave(&turns[i].runner);
    frame_picture_free(track.picture);
    free(track.hits);
}
