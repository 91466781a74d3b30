/* SPDX-License-Identifier: MIT
 *
 * Ray casting, with at most 80 evaluations a ray as in the paper: the library's step rules against
 * its own basic one, and the paper's listings as printed, in a loop over rays. A vectorised
 * callback takes less time than a rule's own step, so that fewer evaluations hardly show in it; the
 * same callback without vectors stands for fields that cost more. */
#include "keinert_cast.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../truth.h"

static const cast_rule rules[] = {
    {"basic", CAST_TRACE, "basic", 1.2f, 0, 0},
    {"relaxed 1.2", CAST_TRACE, "relaxed", 1.2f, 0, 0},
    {"relaxed 1.6", CAST_TRACE, "relaxed", 1.6f, 0, 0},
    {"adaptive (default)", CAST_TRACE, "adaptive", 1.2f, 0, 1},
    {"convex (by licence)", CAST_TRACE, "convex", 1.2f, 0, 1},
    {"scalar callback, basic", CAST_SCALAR, "basic", 1.2f, 5, 0},
    {"scalar callback, adaptive", CAST_SCALAR, "adaptive", 1.2f, 5, 1},
    {"listing 2, omega 1", CAST_LISTING_2, "basic", 1.0f, 7, 0},
    {"listing 2, omega 1.2", CAST_LISTING_2, "basic", 1.2f, 7, 0},
    {"listing 1, tau = epsilon", CAST_LISTING_1, "basic", 1.2f, 7, 0},
    {"frame with cones, basic", CAST_FRAME, "basic", 1.2f, 0, 0},
    {"frame with cones, adaptive", CAST_FRAME, "adaptive", 1.2f, 0, 1},
    {"frame with cones, convex", CAST_FRAME, "convex", 1.2f, 0, 1},
};
enum { RULES = sizeof rules / sizeof rules[0], BASIC = 0, ADAPTIVE = 3 };

typedef struct cast_race {
    const char *scene, *title;
    double paper;  /* times as fast with over-relaxation; 0: not there */
    int unbounded; /* the field's bound is kept from all */
} cast_race;

static const cast_race races[] = {{"city", "city", 20.409 / 16.829, 0},
                                  {"jewel", "jewel", 3.472 / 2.978, 0},
                                  {"jewel", "jewel without a bound", 3.472 / 2.978, 1},
                                  {"primitives", "primitives", 0, 0}};

/* A frame would take the scene, and its bound, by name. */
static int takes_part(const cast_race *race, const cast_rule *rule) {
    const int licensed = (scene_named(race->scene)->flags & SPT_FIELD_CONVEX) != 0;
    if (strcmp(rule->method, "convex") == 0 && !licensed) return 0;
    return rule->kind != CAST_FRAME || !race->unbounded;
}

static double process_seconds(void *user) {
    (void)user;
    return bench_seconds();
}

static double run(void *user, int round) {
    const cast_runner *const runner = user;
    const bench_options *const options = runner->track->options;
    const frame_slice slice = frame_slice_of(runner->track->picture, round, options->rounds);
    const double before = bench_seconds();
    double seconds;
    int times = 0;
    do {
        cast_slice(runner, slice);
        seconds = bench_seconds() - before;
        ++times;
    } while (seconds < options->slice_seconds);
    return seconds / times;
}

/* RMS depth of two runners, over the rays on which both came to the surface that they met. */
static void compare_depths(const cast_runner *one, const cast_runner *base, keinert_row *row) {
    double square = 0, square_of_base = 0, number = 0;
    for (size_t i = 0; i < one->track->picture->count; ++i) {
        const double depth = (double)one->depth[i], of_base = (double)base->depth[i];
        if (isnan(depth) || isnan(of_base)) continue;
        square += depth * depth;
        square_of_base += of_base * of_base;
        number += 1;
    }
    row->error = sqrt(square / number);
    row->error_of_base = sqrt(square_of_base / number);
    row->error_of = "RMS depth before the surface of rays that hit in both";
}

/* With a time of an evaluation of c + o, c the callback's and o all else, the ratio of times is
 *     E (c + o) / E' (c + o')
 * of basic over adaptive: what c would have to be for what the paper saved. */
static void print_callback_needed(const cast_race *race, const keinert_row *basic,
                                  const keinert_row *adaptive) {
    const spt_field field = scene_field(scene_named(race->scene), spt_lanes());
    const double each = basic->evaluations / basic->rays,
                 less = adaptive->evaluations / basic->rays;
    spt_field_cost cost = {0, 0};
    keinert_expect(spt_field_measure(&field, process_seconds, NULL, &cost), "spt_field_measure");
    const double of_basic = basic->nanoseconds / each - cost.nanoseconds_256;
    const double of_adaptive = adaptive->nanoseconds / less - cost.nanoseconds_256;
    printf("  the callback takes %.2f ns an evaluation, all else %.2f (basic) and %.2f (adaptive)",
           cost.nanoseconds_256, of_basic, of_adaptive);
    if (race->paper > 0 && each > race->paper * less) {
        const double needed =
            (race->paper * less * of_adaptive - each * of_basic) / (each - race->paper * less);
        printf(": one of %.1f ns would save %.2f in time", needed, race->paper);
    }
    printf("\n");
}

/* Everything allocated, all rays of the truth known. */
static void enter(cast_track *track, const bench_options *options, const cast_race *race) {
    const scene *const named = scene_named(race->scene);
    track->options = options;
    track->shown = *named;
    if (race->unbounded) track->shown.bound = NULL;
    track->picture = frame_picture_of(named, options->width, options->height);
    track->hits = keinert_allocate(track->picture->count * sizeof *track->hits);
    track->image = keinert_allocate(track->picture->count * sizeof *track->image);
    track->last_t = keinert_allocate(track->picture->count * sizeof *track->last_t);
    const spt_settings settings = bench_settings("basic", track->picture->pixel_radius, 1);
    for (size_t i = 0; i < track->picture->count; ++i) {
        track->last_t[i] = truth_last_t(&track->shown, &settings, &track->picture->rays[i]);
    }
}

static void leave(cast_track *track) {
    frame_picture_free(track->picture);
    free(track->hits);
    free(track->image);
    free(track->last_t);
}

static int hold(const bench_options *options, FILE *file, const cast_race *race) {
    static keinert_contender contenders[RULES];
    static cast_runner runners[RULES];
    static keinert_row rows[RULES];
    int place[RULES], number = 0;
    cast_track track;
    size_t different = 0;
    enter(&track, options, race);
    for (int rule = 0; rule < RULES; ++rule) {
        if (!takes_part(race, &rules[rule])) continue;
        place[rule] = number;
        cast_enter(&runners[number], &rules[rule], &track);
        contenders[number].name = rules[rule].name;
        contenders[number].against = place[rules[rule].against];
        contenders[number].paper = rules[rule].judged ? race->paper : 0;
        contenders[number].user = &runners[number];
        rows[number] = keinert_row_of("ray casting", race->title);
        ++number;
    }
    keinert_race(contenders, number, options->rounds, run);
    for (int i = 0; i < number; ++i) {
        cast_judge(&runners[i], &rows[i]);
        different += cast_count_different(&runners[i]);
        compare_depths(&runners[i], &runners[contenders[i].against], &rows[i]);
        rows[i].nanoseconds = 1e9 * keinert_middle_seconds(&contenders[i], options->rounds) *
                              options->rounds / rows[i].rays;
    }
    keinert_report(file, contenders, rows, number, options->rounds);
    print_callback_needed(race, &rows[BASIC], &rows[ADAPTIVE]);
    if (different > 0) {
        printf("%s: %zu results differ from those of a single lane\n", race->title, different);
    }
    for (int i = 0; i < number; ++i) cast_leave(&runners[i]);
    leave(&track);
    return different == 0;
}

int keinert_cast(const bench_options *options, FILE *file) {
    int agreed = 1;
    for (size_t i = 0; i < sizeof races / sizeof races[0]; ++i) {
        agreed &= hold(options, file, &races[i]);
    }
    return agreed;
}
