/* SPDX-License-Identifier: MIT
 *
 * The village against Embree 3, one thread: as user geometry whose callback traces the same
 * distances with the same rule and stop, and as triangles; ray by ray and in packets of 16. All
 * trace the same primary rays; frames make them themselves. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "peers_check.h"
#include "peers_race.h"

/* Who is raced, and how Embree is asked. */
typedef enum peers_side { SIDE_FRAME, SIDE_SCENE, SIDE_EMBREE } peers_side;
typedef enum peers_form {
    FORM_RAYS,         /* ray by ray */
    FORM_PACKETS,      /* in packets of 16, with a callback of one ray */
    FORM_PACKETS_SIMD, /* in packets of 16, with a callback that is written in vectors */
    peers_forms
} peers_form;

typedef struct peers_runner {
    const char *name, *rule; /* rule "": none */
    peers_side side;
    scene_grain grain; /* of the library's */
    peers_kind kind;   /* of Embree's */
    peers_form form;
} peers_runner;

#define OURS(name, rule, side, grain) \
    { name, rule, side, grain, peers_kinds, peers_forms }
#define EMBREE(name, rule, kind, form) \
    { name, rule, SIDE_EMBREE, SCENE_OBJECTS, kind, form }
static const peers_runner runners[] = {
    OURS("frame", "basic", SIDE_FRAME, SCENE_OBJECTS),
    OURS("frame", "adaptive", SIDE_FRAME, SCENE_OBJECTS),
    OURS("frame_convex_bodies", "adaptive", SIDE_FRAME, SCENE_PRIMITIVES),
    OURS("scene", "basic", SIDE_SCENE, SCENE_OBJECTS),
    OURS("scene", "adaptive", SIDE_SCENE, SCENE_OBJECTS),
    EMBREE("embree_rays", "basic", PEERS_USER, FORM_RAYS),
    EMBREE("embree_rays", "adaptive", PEERS_USER, FORM_RAYS),
    EMBREE("embree_packets", "basic", PEERS_USER, FORM_PACKETS),
    EMBREE("embree_packets", "adaptive", PEERS_USER, FORM_PACKETS),
    EMBREE("embree_packets_simd", "basic", PEERS_USER, FORM_PACKETS_SIMD),
    EMBREE("embree_packets_simd", "adaptive", PEERS_USER, FORM_PACKETS_SIMD),
    EMBREE("embree_triangles", "", PEERS_TRIANGLES, FORM_RAYS),
    EMBREE("embree_triangles_16", "", PEERS_TRIANGLES, FORM_PACKETS)};
#undef OURS
#undef EMBREE
enum { RUNNERS = sizeof runners / sizeof runners[0] };

typedef struct peers_track {
    frame_picture *picture;
    peers_embree *embree;
    bench_hit *image; /* of the library's frames by pixel, of its scenes by ray */
    void *workspace;  /* of spt_scene_trace() */
    size_t workspace_size;
    frame_tracer *tracers[RUNNERS];
    peers_hit *hits[RUNNERS];                       /* by pixel */
    double nanoseconds[RUNNERS][BENCH_MOST_ROUNDS]; /* a pixel */
} peers_track;

static peers_step step_of(const frame_picture *picture, const spt_settings *settings) {
    peers_step step;
    step.adaptive = 0;
    step.budget = settings->budget;
    step.epsilon = settings->epsilon;
    step.pixel_radius = settings->pixel_radius;
    step.extrapolation = settings->extrapolation;
    step.step_cap = settings->step_cap;
    step.reach = (float)VILLAGE_GROUND_HALF;
    for (int axis = 0; axis < 3; ++axis) {
        step.reach = spt_greatest(step.reach, fabsf(picture->camera.eye[axis]));
    }
    return step;
}

/* NaN for a ray that ran out of its budget. */
static peers_hit hit_of(const bench_hit *hit) {
    peers_hit found;
    found.t = hit->outcome == SPT_LIMIT ? NAN : hit->t;
    found.cosine = 0;
    return found;
}

static double run_frame(const peers_track *track, int i, frame_slice slice) {
    const frame_picture *const picture = track->picture;
    const double before = bench_seconds();
    frame_tracer_run(track->tracers[i], picture, slice, track->image);
    const double seconds = bench_seconds() - before;
    for (size_t k = picture->first[slice.begin]; k < picture->first[slice.end]; ++k) {
        track->hits[i][picture->pixel[k]] = hit_of(&track->image[picture->pixel[k]]);
    }
    return seconds;
}

/* The rays of a tile a call; nobody says that they come from one camera. */
static double run_scene(const peers_track *track, int i, frame_slice slice) {
    const frame_picture *const picture = track->picture;
    const spt_frame *const frame = &track->tracers[i]->frame;
    const double before = bench_seconds();
    for (size_t k = slice.begin; k < slice.end; ++k) {
        const size_t start = picture->first[k];
        const spt_rays columns = spt_rays_of(picture->rays + start);
        const spt_hits sinks = bench_hits_of(track->image + start);
        frame_expect(spt_scene_trace(frame->scene, &frame->settings, picture->first[k + 1] - start,
                                     &columns, &sinks, track->workspace, track->workspace_size,
                                     NULL),
                     "spt_scene_trace");
    }
    const double seconds = bench_seconds() - before;
    for (size_t k = picture->first[slice.begin]; k < picture->first[slice.end]; ++k) {
        track->hits[i][picture->pixel[k]] = hit_of(&track->image[k]);
    }
    return seconds;
}

static double run(const peers_track *track, int i, frame_slice slice) {
    const peers_runner *const runner = &runners[i];
    if (runner->side == SIDE_FRAME) return run_frame(track, i, slice);
    if (runner->side == SIDE_SCENE) return run_scene(track, i, slice);
    track->embree->village.step.adaptive = strcmp(runner->rule, "adaptive") == 0;
    track->embree->village.ray_by_ray = runner->form != FORM_PACKETS_SIMD;
    return peers_embree_run(track->embree, runner->kind, runner->form != FORM_RAYS, track->picture,
                            slice, track->hits[i]);
}

/* Repeated as often as the clock needs; the first turn warms caches and is not counted. */
static void run_round(const bench_options *options, peers_track *track, int round) {
    const frame_slice slice = frame_slice_of(track->picture, round, options->rounds);
    const double rays = (double)frame_slice_rays(track->picture, slice);
    for (int i = 0; i < RUNNERS; ++i) {
        double seconds = 0;
        int times = 0;
        run(track, i, slice);
        for (; seconds < options->slice_seconds; ++times) seconds += run(track, i, slice);
        track->nanoseconds[i][round] = seconds / times * 1e9 / rays;
    }
}

static void enter(peers_track *track, const bench_options *options) {
    static const frame_way plain = {SCENE_OBJECTS, 1, 1};
    track->picture = frame_picture_of(scene_named("village"), options->width, options->height);
    track->image = frame_image_of(track->picture->count);
    track->workspace_size = 0;
    for (int i = 0; i < RUNNERS; ++i) {
        frame_way way = plain;
        const size_t size = track->picture->count * sizeof *track->hits[i];
        track->hits[i] = frame_allocate(size);
        track->tracers[i] = NULL;
        if (runners[i].side == SIDE_EMBREE) continue;
        way.grain = runners[i].grain;
        track->tracers[i] = frame_tracer_of(track->picture, &way, runners[i].rule, 0);
        const spt_frame *const frame = &track->tracers[i]->frame;
        const size_t workspace = spt_scene_workspace(frame->scene, &frame->settings);
        if (workspace > track->workspace_size) track->workspace_size = workspace;
    }
    track->workspace = frame_allocate(track->workspace_size);
    const peers_step step = step_of(track->picture, &track->tracers[0]->frame.settings);
    track->embree = peers_embree_of(&step);
}

static void leave(peers_track *track) {
    for (int i = 0; i < RUNNERS; ++i) {
        if (track->tracers[i] != NULL) frame_tracer_free(track->tracers[i]);
        free(track->hits[i]);
    }
    peers_embree_free(track->embree);
    frame_picture_free(track->picture);
    free(track->image);
    free(track->workspace);
}

/* The fastest of the library's, of a grain; SCENE_WHOLE: of any. */
static int fastest_of(const double median[RUNNERS], peers_side side, scene_grain grain) {
    int best = -1;
    for (int i = 0; i < RUNNERS; ++i) {
        if (runners[i].side != side) continue;
        if (grain != SCENE_WHOLE && runners[i].grain != grain) continue;
        if (best < 0 || median[i] < median[best]) best = i;
    }
    return best;
}

/* The fastest of Embree's of a kind, in forms from one to another. */
static int fastest_embree(const double median[RUNNERS], peers_kind kind, peers_form from,
                          peers_form to) {
    int best = -1;
    for (int i = 0; i < RUNNERS; ++i) {
        const peers_form form = runners[i].form;
        if (runners[i].side != SIDE_EMBREE || runners[i].kind != kind) continue;
        if (form < from || form > to) continue;
        if (best < 0 || median[i] < median[best]) best = i;
    }
    return best;
}

static double median_ratio(const bench_options *options, const peers_track *track, int of,
                           int over) {
    double ratio[BENCH_MOST_ROUNDS];
    for (int round = 0; round < options->rounds; ++round) {
        ratio[round] = track->nanoseconds[of][round] / track->nanoseconds[over][round];
    }
    return bench_median(ratio, options->rounds);
}

/* A race, as a line of the table and on the screen. */
typedef struct peers_claim {
    const char *what;
    int peer, ours; /* runners */
    double target;  /* 0: none */
} peers_claim;

static void report(const bench_options *options, const peers_track *track,
                   const double median[RUNNERS], FILE *table, const peers_claim *claim) {
    const peers_runner *const peer = &runners[claim->peer], *const ours = &runners[claim->ours];
    const double ratio = median_ratio(options, track, claim->peer, claim->ours);
    char peer_way[64], our_way[64];
    snprintf(peer_way, sizeof peer_way, "%s %s", peer->name, peer->rule);
    snprintf(our_way, sizeof our_way, "%s %s", ours->name, ours->rule);
    const peers_result result = {"embree",
                                 track->picture->shown->name,
                                 peer_way,
                                 our_way,
                                 spt_lanes(),
                                 track->picture->count,
                                 median[claim->peer],
                                 median[claim->ours],
                                 ratio,
                                 claim->target};
    peers_report(table, &result);
    printf("%-34s %s against %s: %.2fx", claim->what, our_way, peer_way, ratio);
    if (claim->target > 0) {
        printf("   target %.1f %s", claim->target,
               ratio >= claim->target ? "reached" : "NOT REACHED");
    }
    printf("\n");
}

/* User geometry is judged against frames of the same 41 objects, triangles against any. The target
 * was set for a callback of one ray; one that is written in vectors by hand stands beside it. */
static void report_all(const bench_options *options, const peers_track *track,
                       const double median[RUNNERS], FILE *table) {
    const int objects = fastest_of(median, SIDE_FRAME, SCENE_OBJECTS);
    const int any = fastest_of(median, SIDE_FRAME, SCENE_WHOLE);
    const int without = fastest_of(median, SIDE_SCENE, SCENE_WHOLE);
    const int user = fastest_embree(median, PEERS_USER, FORM_RAYS, FORM_PACKETS);
    const int simd = fastest_embree(median, PEERS_USER, FORM_PACKETS_SIMD, FORM_PACKETS_SIMD);
    const int packets = fastest_embree(median, PEERS_TRIANGLES, FORM_PACKETS, FORM_PACKETS);
    const int single = fastest_embree(median, PEERS_TRIANGLES, FORM_RAYS, FORM_RAYS);
    const peers_claim claims[] = {{"user geometry, callback of a ray", user, objects, 4},
                                  {"user geometry, callback in SIMD", simd, objects, 0},
                                  {"triangles, packets of 16", packets, any, 0.8},
                                  {"triangles, ray by ray", single, any, 0},
                                  {"no camera: user, callback of a ray", user, without, 0},
                                  {"no camera: user, callback in SIMD", simd, without, 0}};
    printf("\nThe fastest of each side:\n");
    for (size_t i = 0; i < sizeof claims / sizeof *claims; ++i) {
        report(options, track, median, table, &claims[i]);
    }
}

/* The rows; returns how many hits differ. Those of triangles are not counted: without its robust
 * flag, which costs it a fifth, Embree promises nothing where a ray meets an edge. */
static size_t finish(const bench_options *options, peers_track *track, FILE *table) {
    FILE *file = bench_open(options, "peers_embree.csv",
                            "runner,rule,ns_per_pixel,times_frame,equal,silhouette,limit,"
                            "different");
    double median[RUNNERS], sorted[BENCH_MOST_ROUNDS];
    peers_hit *const truth = frame_allocate(track->picture->count * sizeof *truth);
    const frame_slice whole = {0, track->picture->tiles};
    size_t different = 0;
    peers_embree_run(track->embree, PEERS_ROBUST, 0, track->picture, whole, truth);
    for (int i = 0; i < RUNNERS; ++i) {
        memcpy(sorted, track->nanoseconds[i], sizeof sorted);
        median[i] = bench_median(sorted, options->rounds);
    }
    const int frame = fastest_of(median, SIDE_FRAME, SCENE_OBJECTS);
    for (int i = 0; i < RUNNERS; ++i) {
        const int exact = runners[i].kind == PEERS_TRIANGLES;
        const peers_found found =
            peers_compare(runners[i].name, track->picture,
                          exact ? NULL : &track->embree->village.step, truth, track->hits[i]);
        const double ratio = median_ratio(options, track, i, frame);
        fprintf(file, "%s,%s,%.3f,%.3f,%zu,%zu,%zu,%zu\n", runners[i].name, runners[i].rule,
                median[i], ratio, found.equal, found.silhouette, found.limit, found.different);
        printf("%-22s%-9s%9.2f%8.2f%10zu%12zu%8zu%11zu\n", runners[i].name, runners[i].rule,
               median[i], ratio, found.equal, found.silhouette, found.limit, found.different);
        different += exact ? 0 : found.different;
    }
    report_all(options, track, median, table);
    free(truth);
    fclose(file);
    return different;
}

int peers_race_embree(const bench_options *options, FILE *table) {
    static peers_track track;
    enter(&track, options);
    for (int round = 0; round < options->rounds; ++round) run_round(options, &track, round);
    printf("The village of %dx%d, Embree %s, one thread; %d lanes of ours:\n"
           "%-22s%-9s%9s%8s%10s%12s%8s%11s\n",
           options->width, options->height, RTC_VERSION_STRING, spt_lanes(), "runner", "rule",
           "ns/pixel", "times", "equal", "silhouette", "limit", "different");
    const size_t different = finish(options, &track, table);
    if (different > 0) printf("%zu hits differ from the triangles'\n", different);
    leave(&track);
    return (int)different;
}
