/* SPDX-License-Identifier: MIT
 *
 * All scenes against llvmpipe, one thread: the shader that spt_glsl_emit() writes for a scene, run
 * by a compiler of shaders for this processor's vectors, against spt_trace() on the same rays, with
 * the same rule, stop and budget. Beside it frames of the same picture: what the library makes of a
 * camera that it knows, by bounds, culling and cones. Three shaders of each scene:
 *     plain    the shortest. It promises nothing for fields that are no distance bounds or not
 *              finite, and for odd rays
 *     guarded  with SPT_GLSL_GUARDS: what spt_trace() promises
 *     arrays   plain, of a kernel-reflection sequence whose numbers are in arrays, as one is that
 *              was not written for its scene; the others have literals in their instructions */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "peers_llvmpipe.h"
#include "peers_race.h"

static const struct {
    const char *name;
    uint32_t features;
} ways[] = {{"plain", 0}, {"guarded", SPT_GLSL_GUARDS}, {"arrays", SPT_GLSL_ARRAYS}};
enum { PLAIN, GUARDED, ARRAYS, WAYS };

typedef enum shader_side { SIDE_TRACE, SIDE_FRAME } shader_side;

static const struct {
    const char *name;
    shader_side side;
    int lanes;
} runners[] = {{"trace", SIDE_TRACE, 8},
               {"trace", SIDE_TRACE, 16},
               {"frame", SIDE_FRAME, 8},
               {"frame", SIDE_FRAME, 16}};
enum { RUNNERS = sizeof runners / sizeof runners[0] };

static const char rule[] = "adaptive";
static const char *const stage_names[] = {"compute 450", "fragment 330"};

typedef struct shader_track {
    const scene *shown;
    frame_picture *picture;
    peers_shader *shaders[WAYS][peers_stages];
    peers_stage stage[WAYS]; /* the faster one */
    frame_tracer *tracers[RUNNERS];
    bench_hit *expected, *image;
    float (*seen)[4];
    double theirs[WAYS][BENCH_MOST_ROUNDS], ours[RUNNERS][BENCH_MOST_ROUNDS]; /* ns a ray */
    double evaluations;   /* a ray, of the trace */
    double first_seconds; /* building the plain shader and its first run */
    int different;        /* rays on which shader and trace do not agree bit by bit */
    int apart[RUNNERS];   /* rays of frames whose outcome is not that of the trace */
} shader_track;

static int here(int i) {
    return runners[i].lanes <= spt_lanes();
}

/* By how many stages a way is tried; 0: the scene has not that way. */
static int stages_of(const scene *shown, int way) {
    if (way != ARRAYS) return peers_stages;
    return shown->field != NULL ? 1 : 0;
}

static spt_settings settings_of(const shader_track *track, int lanes) {
    return bench_settings(rule, track->picture->pixel_radius, lanes);
}

/* ---- Both sides ----------------------------------------------------------------------------- */

static char *text_of(const shader_track *track, int way, uint32_t target) {
    const spt_field field = scene_field(track->shown, 1);
    const spt_settings settings = settings_of(track, 0);
    spt_glsl_options options = spt_glsl_options_default();
    size_t length = 0;
    options.field = &field;
    options.settings = &settings;
    options.target = target;
    options.features = ways[way].features;
    (void)spt_glsl_emit(&options, NULL, 0, &length);
    char *const text = frame_allocate(length + 1);
    frame_expect(spt_glsl_emit(&options, text, length + 1, NULL), "spt_glsl_emit");
    return text;
}

static double run_trace(const shader_track *track, int lanes, bench_hit *hits) {
    const spt_field field = scene_field(track->shown, lanes);
    const spt_settings settings = settings_of(track, lanes);
    const spt_rays columns = spt_rays_of(track->picture->rays);
    const spt_hits sinks = bench_hits_of(hits);
    const double before = bench_seconds();
    frame_expect(spt_trace(&field, &settings, track->picture->count, &columns, &sinks, NULL),
                 "spt_trace");
    return bench_seconds() - before;
}

static double run_frame(const shader_track *track, int i) {
    const frame_slice whole = {0, track->picture->tiles};
    const double before = bench_seconds();
    frame_tracer_run(track->tracers[i], track->picture, whole, track->image);
    return bench_seconds() - before;
}

static double run_theirs(const shader_track *track, int way) {
    return peers_shader_run(track->shaders[way][track->stage[way]]);
}

static double run_ours(const shader_track *track, int i) {
    return runners[i].side == SIDE_FRAME ? run_frame(track, i)
                                         : run_trace(track, runners[i].lanes, track->image);
}

/* ---- The same hits -------------------------------------------------------------------------- */

/* In GLSL 3.0e38 stands for infinity. */
static int same_number(float seen, float expected) {
    const float finite = expected < 3.0e38f ? expected : 3.0e38f;
    return memcmp(&seen, &finite, sizeof seen) == 0;
}

static int count_different(const shader_track *track, const peers_shader *shader) {
    int different = 0;
    peers_shader_hits(shader, track->seen);
    for (size_t i = 0; i < track->picture->count; ++i) {
        const float *const seen = track->seen[i];
        const bench_hit *const hit = &track->expected[i];
        different += !(same_number(seen[0], hit->t) && same_number(seen[1], hit->residual) &&
                       (uint32_t)seen[2] == hit->evaluations && (int32_t)seen[3] == hit->outcome);
    }
    return different;
}

/* A frame's cones start rays elsewhere, and its components have bounds of their own: t has other
 * bits, and a ray that passes a silhouette by less than the stop may end otherwise. */
static int count_apart(const shader_track *track) {
    int apart = 0;
    for (size_t i = 0; i < track->picture->count; ++i) {
        const bench_hit *const hit = &track->image[track->picture->pixel[i]];
        apart += hit->outcome != track->expected[i].outcome;
    }
    return apart;
}

/* ---- A scene -------------------------------------------------------------------------------- */

/* By each stage; the faster one is raced. Arrays are slow to build, and compute alone has to do. */
static void build_shaders(shader_track *track, int way) {
    static const uint32_t targets[] = {SPT_GLSL_COMPUTE_450, SPT_GLSL_FRAGMENT_330};
    double best[peers_stages] = {HUGE_VAL, HUGE_VAL};
    for (int stage = 0; stage < stages_of(track->shown, way); ++stage) {
        const double before = bench_seconds();
        char *const text = text_of(track, way, targets[stage]);
        peers_shader *const shader =
            peers_shader_of((peers_stage)stage, text, track->picture, settings_of(track, 0).budget);
        best[stage] = peers_shader_run(shader);
        if (way == PLAIN && stage == 0) track->first_seconds = bench_seconds() - before;
        track->different += count_different(track, shader);
        for (int time = 0; time < 3; ++time)
            best[stage] = fmin(best[stage], peers_shader_run(shader));
        track->shaders[way][stage] = shader;
        free(text);
    }
    track->stage[way] = best[PEERS_FRAGMENT] < best[PEERS_COMPUTE] ? PEERS_FRAGMENT : PEERS_COMPUTE;
}

static void enter(shader_track *track, const bench_options *options) {
    static const frame_way whole_power = {SCENE_OBJECTS, 1, 1};
    track->picture = frame_picture_of(track->shown, options->small_width, options->small_height);
    track->expected = frame_image_of(track->picture->count);
    track->image = frame_image_of(track->picture->count);
    track->seen = frame_allocate(track->picture->count * sizeof *track->seen);
    run_trace(track, spt_lanes(), track->expected);
    for (size_t i = 0; i < track->picture->count; ++i) {
        track->evaluations += track->expected[i].evaluations / (double)track->picture->count;
    }
    for (int way = 0; way < WAYS; ++way) {
        build_shaders(track, way);
    }
    for (int i = 0; i < RUNNERS; ++i) {
        if (runners[i].side != SIDE_FRAME || !here(i)) continue;
        track->tracers[i] = frame_tracer_of(track->picture, &whole_power, rule, runners[i].lanes);
        run_frame(track, i);
        track->apart[i] = count_apart(track);
    }
}

static void leave(shader_track *track) {
    for (int way = 0; way < WAYS; ++way) {
        for (int stage = 0; stage < stages_of(track->shown, way); ++stage) {
            peers_shader_free(track->shaders[way][stage]);
        }
    }
    for (int i = 0; i < RUNNERS; ++i) {
        if (track->tracers[i] != NULL) frame_tracer_free(track->tracers[i]);
    }
    frame_picture_free(track->picture);
    free(track->expected);
    free(track->image);
    free(track->seen);
}

/* One after the other, each as often as the clock needs; the next round begins with the next. */
static void run_round(const bench_options *options, shader_track *track, int round) {
    const double rays = (double)track->picture->count;
    for (int turn = 0; turn < WAYS + RUNNERS; ++turn) {
        const int number = (turn + round) % (WAYS + RUNNERS), i = number - WAYS;
        double seconds = 0;
        int times = 0;
        if (i < 0 ? stages_of(track->shown, number) == 0 : !here(i)) continue;
        for (; seconds < options->slice_seconds; ++times) {
            seconds += i < 0 ? run_theirs(track, number) : run_ours(track, i);
        }
        double *const result = i < 0 ? track->theirs[number] : track->ours[i];
        result[round] = seconds / times * 1e9 / rays;
    }
}

/* ---- Report --------------------------------------------------------------------------------- */

static double median_of(const bench_options *options, const double *values) {
    double sorted[BENCH_MOST_ROUNDS];
    memcpy(sorted, values, (size_t)options->rounds * sizeof *sorted);
    return bench_median(sorted, options->rounds);
}

static double median_ratio(const bench_options *options, const double *theirs, const double *ours) {
    double ratio[BENCH_MOST_ROUNDS];
    for (int round = 0; round < options->rounds; ++round)
        ratio[round] = theirs[round] / ours[round];
    return bench_median(ratio, options->rounds);
}

/* With AVX2. Those that have much to leave out: 6, of the whole library against a shader that makes
 * the same promises, and by the same loop against one with arrays. */
static double target_of(const shader_track *track, int way, int i) {
    const char *const name = track->shown->name;
    const int tree = strncmp(name, "krs_tree", 8) == 0;
    if (runners[i].lanes != 8) return 0;
    if (way == ARRAYS) return runners[i].side == SIDE_TRACE ? 6 : 0;
    if (way != GUARDED) return 0;
    if (runners[i].side == SIDE_TRACE) return 1.5;
    return tree || strcmp(name, "village") == 0 ? 6 : 0;
}

static void report_row(const bench_options *options, const shader_track *track, int way, int i,
                       FILE *table) {
    const double theirs = median_of(options, track->theirs[way]);
    const double ours = median_of(options, track->ours[i]);
    const double ratio = median_ratio(options, track->theirs[way], track->ours[i]);
    const double target = target_of(track, way, i);
    char our_way[32], peer_way[64];
    snprintf(our_way, sizeof our_way, "%s %s", runners[i].name, rule);
    snprintf(peer_way, sizeof peer_way, "%s %s %s", ways[way].name, stage_names[track->stage[way]],
             rule);
    const peers_result result = {"llvmpipe",
                                 track->shown->name,
                                 peer_way,
                                 our_way,
                                 runners[i].lanes,
                                 track->picture->count,
                                 theirs,
                                 ours,
                                 ratio,
                                 target};
    peers_report(table, &result);
    printf(" %7.2f%c", ratio, ratio < target ? '!' : ' ');
}

static void report(const bench_options *options, const shader_track *track, FILE *table) {
    printf("%-18s%6.1f%6.0f ms%7d%6d   ours", track->shown->name, track->evaluations,
           1e3 * track->first_seconds, track->different, track->apart[RUNNERS - 2]);
    for (int i = 0; i < RUNNERS; ++i) {
        if (here(i)) printf(" %7.1f ", median_of(options, track->ours[i]));
    }
    printf("\n");
    for (int way = 0; way < WAYS; ++way) {
        if (stages_of(track->shown, way) == 0) continue;
        printf("    %-9s%-14s%9.1f%17s", ways[way].name, stage_names[track->stage[way]],
               median_of(options, track->theirs[way]), "times");
        for (int i = 0; i < RUNNERS; ++i) {
            if (here(i)) report_row(options, track, way, i, table);
        }
        printf("\n");
    }
    fflush(stdout);
}

static int race(const bench_options *options, const scene *shown, FILE *table) {
    shader_track track;
    memset(&track, 0, sizeof track);
    track.shown = shown;
    enter(&track, options);
    for (int round = 0; round < options->rounds; ++round) run_round(options, &track, round);
    report(options, &track, table);
    leave(&track);
    return track.different;
}

int peers_race_llvmpipe(const bench_options *options, FILE *table) {
    int different = 0;
    if (!peers_llvmpipe_open()) return -1;
    printf(
        "%s and this library, one thread each, %s, %dx%d rays: ns a ray. Ours by spt_trace() of\n"
        "the same rays and by frames with bounds, culling and cones, and how many times as long\n"
        "llvmpipe takes; !: target not reached. Rays that differ from the shaders', and those of\n"
        "frames that end otherwise.\n",
        peers_llvmpipe_name(), rule, options->small_width, options->small_height);
    printf("%-18s%6s%9s%7s%6s%7s %8s %8s %8s %8s\n", "scene", "evals", "build", "differ", "apart",
           "", "trace 8", "trace 16", "frame 8", "frame 16");
    for (size_t i = 0; i < scene_count; ++i) different += race(options, scenes[i], table);
    different += race(options, scene_named("krs_tree_28"), table);
    if (different > 0) printf("%d hits differ from the shaders'\n", different);
    return different;
}
