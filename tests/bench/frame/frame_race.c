/* SPDX-License-Identifier: MIT
 *
 * The race: frames at every width against the scalar loop, same step rule and stop on both sides.
 * A frame makes its own rays; the scalar loop is handed them, for nothing. A race counts only if
 * frames without cones of the scene in one piece give the scalar loop's bits, and all widths the
 * same bits. */
#include <stdlib.h>
#include <string.h>

#include "frame_bench.h"

static const frame_way ways[] = {{SCENE_WHOLE, 0, 0},   {SCENE_WHOLE, 1, 0},
                                 {SCENE_WHOLE, 1, 1},   {SCENE_OBJECTS, 0, 0},
                                 {SCENE_OBJECTS, 0, 1}, {SCENE_OBJECTS, 1, 1}};
static const char *const rules[] = {"basic", "adaptive", "convex"};
enum {
    WAYS = sizeof ways / sizeof ways[0],
    RULES = sizeof rules / sizeof rules[0],
    WAY_PLAIN = 0, /* places in the list */
    WAY_CONES = 2, /* culled, too: a body by itself only where a tile misses its bound */
    WAY_UNION = 3,
    WAY_CULLED = WAYS - 1,
    WIDTH_8 = 2, /* in bench_lanes */
    WIDTH_16 = 3,
    DEFAULT_RULE = 1
};

typedef struct race_scene {
    const char *name;
    double cones[BENCH_WIDTHS], culled[BENCH_WIDTHS]; /* targets by width */
} race_scene;

static const race_scene race_scenes[] = {
#define X(scene, cones_8, cones_16, culled_8, culled_16) \
    {#scene, {0, 0, cones_8, cones_16}, {0, 0, culled_8, culled_16}},
    FRAME_SCENES(X)
#undef X
};
enum { SCENES = sizeof race_scenes / sizeof race_scenes[0] };

/* One way at one width. */
typedef struct race_runner {
    frame_tracer *tracer; /* NULL: does not take part */
    bench_hit *image;
    double ratio[BENCH_MOST_ROUNDS], nanoseconds[BENCH_MOST_ROUNDS];
    double seconds; /* of the whole picture */
    double median;  /* of the ratios */
} race_runner;

typedef struct race_track {
    const race_scene *raced;
    const char *rule;
    frame_picture *picture;
    scalar_trace_fn *scalar;
    bench_hit *expected; /* by pixel */
    bench_hit *found;    /* by ray of a slice */
    double seconds;      /* of the scalar loop, whole picture */
    race_runner runners[WAYS][BENCH_WIDTHS];
} race_track;

typedef struct race_result {
    double ratios[RULES][WAYS][BENCH_WIDTHS];
    frame_threads_result threads; /* with the default rule */
} race_result;

static int widest(void) {
    int width = BENCH_WIDTHS - 1;
    while (bench_lanes[width] > spt_lanes()) --width;
    return width;
}

/* The narrow widths take long and are raced at their best only. A scene that is one object has been
 * raced in one piece. */
static int takes_part(int way, int width, size_t objects) {
    if (bench_lanes[width] > spt_lanes()) return 0;
    return (width >= WIDTH_8 || width == widest() || ways[way].cones) &&
           (ways[way].grain == SCENE_WHOLE || objects > 1);
}

static double run_scalar(const race_track *track, frame_slice slice) {
    const frame_picture *const picture = track->picture;
    const frame_tracer *const plain = track->runners[WAY_PLAIN][widest()].tracer;
    const spt_field field = scene_field(picture->shown, 1);
    const size_t start = picture->first[slice.begin];
    const size_t count = frame_slice_rays(picture, slice);
    const spt_settings settings =
        bench_settings(track->rule, plain->frame.settings.pixel_radius, 1);
    const double before = bench_seconds();
    track->scalar(&field, &settings, count, picture->rays + start, track->found);
    const double seconds = bench_seconds() - before;
    for (size_t i = 0; i < count; ++i) {
        track->expected[picture->pixel[start + i]] = track->found[i];
    }
    return seconds;
}

/* Seconds of a frame for the tiles of a slice. Those are traced as often as the clock needs. */
static double run_frame(const race_track *track, const race_runner *runner, frame_slice slice,
                        double least_seconds) {
    const double before = bench_seconds();
    double seconds;
    int times = 0;
    do {
        frame_tracer_run(runner->tracer, track->picture, slice, runner->image);
        seconds = bench_seconds() - before;
        ++times;
    } while (seconds < least_seconds);
    return seconds / times;
}

static void run_round(const bench_options *options, race_track *track, int round) {
    const frame_slice slice = frame_slice_of(track->picture, round, options->rounds);
    const double rays = (double)frame_slice_rays(track->picture, slice);
    const double scalar = run_scalar(track, slice);
    track->seconds += scalar;
    for (int way = 0; way < WAYS; ++way) {
        for (int width = 0; width < BENCH_WIDTHS; ++width) {
            race_runner *const runner = &track->runners[way][width];
            if (runner->tracer == NULL) continue;
            const double seconds = run_frame(track, runner, slice, options->slice_seconds);
            runner->ratio[round] = scalar / seconds;
            runner->nanoseconds[round] = seconds * 1e9 / rays;
            runner->seconds += seconds;
        }
    }
}

static size_t count_different(const bench_hit *a, const bench_hit *b, size_t count) {
    size_t different = 0;
    for (size_t i = 0; i < count; ++i) different += memcmp(&a[i], &b[i], sizeof *a) != 0;
    return different;
}

/* Pixels that are hit on one side and missed on the other. */
static size_t count_flips(const bench_hit *a, const bench_hit *b, size_t count) {
    size_t flips = 0;
    for (size_t i = 0; i < count; ++i) {
        flips += (a[i].outcome == SPT_HIT) != (b[i].outcome == SPT_HIT);
    }
    return flips;
}

/* What a way gave at every width, and the rows. Returns how many results are not as they must. */
static size_t finish_way(const bench_options *options, FILE *file, race_track *track, int way,
                         double ratios[BENCH_WIDTHS]) {
    const frame_picture *const picture = track->picture;
    const race_runner *const best = &track->runners[way][widest()];
    if (best->tracer == NULL) return 0;
    const int own = ways[way].grain == SCENE_WHOLE ? WAY_PLAIN : WAY_UNION;
    const bench_hit *const uncut = track->runners[own][widest()].image;
    const spt_statistics statistics = frame_tracer_count(best->tracer, picture);
    size_t different = 0;
    for (int width = 0; width < BENCH_WIDTHS; ++width) {
        race_runner *const runner = &track->runners[way][width];
        if (runner->tracer == NULL) continue;
        const size_t flips = count_flips(track->expected, runner->image, picture->count);
        const size_t own_flips = count_flips(uncut, runner->image, picture->count);
        ratios[width] = bench_median(runner->ratio, options->rounds);
        const frame_row row = {track->raced->name,
                               bench_lanes[width],
                               ways[way].cones,
                               ways[way].culling,
                               1,
                               ratios[width],
                               frame_evaluations(&statistics, picture),
                               flips,
                               track->rule,
                               runner->tracer->parts.scene.count,
                               track->seconds / runner->seconds,
                               bench_median(runner->nanoseconds, options->rounds),
                               own_flips};
        frame_write_row(file, &row);
        printf("%-17s%-9s%5zu%6s%8s%6d%9.2f%9.2f%10.2f%8.1f%10.2f%7zu%7zu (%.4f %%)\n", row.scene,
               row.rule, row.components, row.cones ? "yes" : "-", row.culling ? "yes" : "-",
               row.lanes, row.ratio, row.whole_ratio, row.nanoseconds,
               100 * spt_utilisation(&statistics), row.evaluations, flips, own_flips,
               100 * (double)own_flips / (double)picture->count);
        different += count_different(best->image, runner->image, picture->count);
        if (way == WAY_PLAIN) {
            different += count_different(track->expected, runner->image, picture->count);
        }
    }
    fflush(stdout);
    return different;
}

static void enter_runners(race_track *track) {
    scene_parts *const parts = frame_allocate(sizeof *parts);
    scene_parts_of(track->picture->shown, SCENE_OBJECTS, 1, parts);
    const size_t objects = parts->scene.count;
    free(parts);
    for (int way = 0; way < WAYS; ++way) {
        for (int width = 0; width < BENCH_WIDTHS; ++width) {
            race_runner *const runner = &track->runners[way][width];
            memset(runner, 0, sizeof *runner);
            if (!takes_part(way, width, objects)) continue;
            runner->tracer =
                frame_tracer_of(track->picture, &ways[way], track->rule, bench_lanes[width]);
            runner->image = frame_image_of(track->picture->count);
        }
    }
}

static void leave_runners(race_track *track) {
    for (int way = 0; way < WAYS; ++way) {
        for (int width = 0; width < BENCH_WIDTHS; ++width) {
            race_runner *const runner = &track->runners[way][width];
            if (runner->tracer == NULL) continue;
            frame_tracer_free(runner->tracer);
            free(runner->image);
        }
    }
}

/* Two threads with culling and cones at the widest; the ratio is that of the slower of the two. */
static size_t race_threads(const bench_options *options, FILE *file, const race_track *track,
                           frame_threads_result *threads) {
    const int way = track->runners[WAY_CULLED][widest()].tracer != NULL ? WAY_CULLED : WAY_CONES;
    const int own = way == WAY_CULLED ? WAY_UNION : WAY_PLAIN;
    const race_runner *const one = &track->runners[way][widest()];
    const size_t pixels = track->picture->count;
    const spt_statistics statistics = frame_tracer_count(one->tracer, track->picture);
    *threads = frame_threads(options, track->picture, &ways[way], track->rule, one->image);
    const double ratio = track->seconds / threads->largest;
    const frame_row row = {track->raced->name,
                           spt_lanes(),
                           1,
                           1,
                           2,
                           ratio,
                           frame_evaluations(&statistics, track->picture),
                           count_flips(track->expected, one->image, pixels),
                           track->rule,
                           one->tracer->parts.scene.count,
                           ratio,
                           threads->largest * 1e9 / (double)pixels,
                           count_flips(track->runners[own][widest()].image, one->image, pixels)};
    frame_write_row(file, &row);
    return threads->different;
}

static size_t hold_race(const bench_options *options, FILE *file, race_track *track, int rule,
                        race_result *result) {
    size_t different = 0;
    enter_runners(track);
    track->seconds = 0;
    for (int round = 0; round < options->rounds; ++round) run_round(options, track, round);
    for (int way = 0; way < WAYS; ++way) {
        different += finish_way(options, file, track, way, result->ratios[rule][way]);
    }
    if (rule == DEFAULT_RULE) different += race_threads(options, file, track, &result->threads);
    leave_runners(track);
    if (different > 0) {
        printf(
            "%s, %s: %zu results differ from those of the scalar loop, another width or thread\n",
            track->raced->name, track->rule, different);
    }
    return different;
}

static size_t race_picture(const bench_options *options, FILE *file, const race_scene *raced,
                           race_result *result) {
    static race_track track;
    size_t different = 0;
    track.raced = raced;
    track.picture = frame_picture_of(scene_named(raced->name), options->width, options->height);
    track.expected = frame_image_of(track.picture->count);
    track.found = frame_image_of(track.picture->count);
    for (int rule = 0; rule < RULES; ++rule) {
        const int convex = strcmp(rules[rule], "convex") == 0;
        if (convex && !(track.picture->shown->flags & SPT_FIELD_CONVEX)) continue;
        track.rule = rules[rule];
        track.scalar = scalar_loop_of(raced->name, rules[rule]);
        different += hold_race(options, file, &track, rule, result);
    }
    free(track.expected);
    free(track.found);
    frame_picture_free(track.picture);
    return different;
}

/* The better of the two rules is judged, each against the scalar loop with the same rule. */
static void print_target(const race_scene *raced, const char *what, int way, int width,
                         double target, const race_result *result) {
    int best = 0;
    if (target <= 0) return;
    for (int rule = 1; rule <= DEFAULT_RULE; ++rule) {
        if (result->ratios[rule][way][width] > result->ratios[best][way][width]) best = rule;
    }
    const int other = DEFAULT_RULE - best;
    printf("%-17s%-16s%3d lanes   target %5.0f   %-8s %7.2f %-12s (%s %.2f)\n", raced->name, what,
           bench_lanes[width], target, rules[best], result->ratios[best][way][width],
           result->ratios[best][way][width] >= target ? "reached" : "NOT REACHED", rules[other],
           result->ratios[other][way][width]);
}

/* Times repeat to 5 %: what is slower by less is no loss. */
static void print_loss(const race_scene *raced, int width, const race_result *result) {
    for (int rule = 0; rule < RULES; ++rule) {
        const double plain = result->ratios[rule][WAY_PLAIN][width],
                     cones = result->ratios[rule][WAY_CONES][width];
        if (!(plain > 0)) continue;
        printf("%-17s%-16s%3d lanes   target no loss %-8s %7.2f without, %7.2f with %s\n",
               raced->name, "cones", bench_lanes[width], rules[rule], plain, cones,
               cones >= 0.95 * plain ? "reached" : "NOT REACHED");
    }
}

static void print_threads(const race_scene *raced, const frame_threads_result *threads) {
    printf("%-17s2 threads: CPU times sum / largest %.3f   target 1.9 %-12s (median %.3f; sum %.2f "
           "of one thread's; wall %.2fx faster)\n",
           raced->name, threads->share, threads->share >= 1.9 ? "reached" : "NOT REACHED",
           threads->median_share, threads->cost, threads->wall);
}

int frame_race(const bench_options *options, FILE *file) {
    static race_result results[SCENES];
    size_t different = 0;
    printf("Frames of %dx%d against a scalar loop with the scene's distance inlined, same rule\n"
           "(ratio: median of rounds; sums: whole picture. evals/px: cones included; of components "
           "where parts > 1\n"
           "flips: pixels hit or missed other than by the scalar loop; own: other than without "
           "cones and culling)\n"
           "%-17s%-9s%5s%6s%8s%6s%9s%9s%10s%8s%10s%7s%7s\n",
           options->width, options->height, "scene", "rule", "parts", "cones", "culling", "lanes",
           "ratio", "sums", "ns/px", "used %", "evals/px", "flips", "own");
    for (int i = 0; i < SCENES; ++i) {
        different += race_picture(options, file, &race_scenes[i], &results[i]);
    }
    printf("\n");
    for (int i = 0; i < SCENES; ++i) {
        const race_scene *const raced = &race_scenes[i];
        for (int width = WIDTH_8; width <= WIDTH_16 && bench_lanes[width] <= spt_lanes(); ++width) {
            print_target(raced, "cones", WAY_CONES, width, raced->cones[width], &results[i]);
            print_target(raced, "culling + cones", WAY_CULLED, width, raced->culled[width],
                         &results[i]);
            if (raced->cones[width] < 0) print_loss(raced, width, &results[i]);
        }
        print_threads(raced, &results[i].threads);
    }
    return different == 0;
}
