/* SPDX-License-Identifier: MIT
 *
 * features.csv, continued: what follows a hit, what frames do for themselves, and what scenes may
 * hold, each switched on against the same without. */
#include <stdlib.h>
#include <string.h>

#include "../../bench/frame/frame_picture.h"
#include "left_out_race.h"

enum { width = 320, height = 192 };

/* ---- What follows a hit ---------------------------------------------------------------------- */

typedef struct query_work {
    spt_field field;
    spt_settings settings;
    bench_picture picture;
    spt_hit *hits;            /* of all rays, as are */
    float *normals, *origins; /* these */
} query_work;

static query_work query_work_of(const scene *shown) {
    query_work work;
    work.picture = bench_picture_of(shown, width, height);
    work.field = scene_field(shown, spt_lanes());
    work.settings = bench_settings("adaptive", work.picture.pixel_radius, spt_lanes());
    work.hits = report_allocate(work.picture.count * sizeof *work.hits);
    work.normals = report_allocate(3 * work.picture.count * sizeof *work.normals);
    work.origins = report_allocate(3 * work.picture.count * sizeof *work.origins);
    return work;
}

static void query_work_free(query_work *work) {
    bench_picture_free(&work->picture);
    free(work->hits);
    free(work->normals);
    free(work->origins);
}

/* The results that queries read. */
static spt_hits hits_at(const query_work *work, size_t start) {
    const spt_hits all = spt_hits_of(work->hits + start);
    spt_hits wanted;
    memset(&wanted, 0, sizeof wanted);
    wanted.t = all.t;
    wanted.residual = all.residual;
    wanted.outcome = all.outcome;
    return wanted;
}

static void run_trace(const void *user, size_t start) {
    const query_work *const work = user;
    const spt_rays rays = spt_rays_of(work->picture.rays + start);
    const spt_hits hits = hits_at(work, start);
    frame_expect(spt_trace(&work->field, &work->settings, left_out_slice, &rays, &hits, NULL),
                 "spt_trace");
}

static void find_normals(const void *user, size_t start, spt_normal_rule rule) {
    const query_work *const work = user;
    const spt_rays rays = spt_rays_of(work->picture.rays + start);
    const spt_hits hits = hits_at(work, start);
    const spt_vector_sinks normals = spt_vector_sinks_of(work->normals + 3 * start);
    frame_expect(spt_normals(&work->field, 1, &work->settings, rule, 0, left_out_slice, &rays,
                             &hits, &normals),
                 "spt_normals");
}

static void run_normals_4(const void *user, size_t start) {
    run_trace(user, start);
    find_normals(user, start, SPT_NORMAL_TETRAHEDRON);
}

static void run_normals_6(const void *user, size_t start) {
    run_trace(user, start);
    find_normals(user, start, SPT_NORMAL_CENTRAL);
}

static void run_refining(const void *user, size_t start) {
    const query_work *const work = user;
    const spt_rays rays = spt_rays_of(work->picture.rays + start);
    const spt_hits hits = hits_at(work, start);
    run_trace(user, start);
    frame_expect(spt_refine(&work->field, 1, &work->settings, 3, left_out_slice, &rays, &hits),
                 "spt_refine");
}

static void run_offset(const void *user, size_t start) {
    const query_work *const work = user;
    const spt_rays rays = spt_rays_of(work->picture.rays + start);
    const spt_hits hits = hits_at(work, start);
    const spt_vectors normals = spt_vectors_of(work->normals + 3 * start);
    spt_starts starts;
    memset(&starts, 0, sizeof starts);
    starts.origin = spt_vector_sinks_of(work->origins + 3 * start);
    run_normals_6(user, start);
    frame_expect(spt_offset(&work->field, 1, &work->settings, left_out_slice, &rays, &hits,
                            &normals, NULL, 1, &starts),
                 "spt_offset");
}

static void measure_queries(const report_options *options, const char *name, FILE *rows) {
    query_work work = query_work_of(scene_named(name)), differences = work;
    left_out_field field = {name, "adaptive", work.picture.count, 0, {{0}}};
    differences.field.gradient = NULL;
    left_out_enter(&field, NULL, NULL, 0, run_trace, &work);
    left_out_enter(&field, "normals of 4 values", "query", 0, run_normals_4, &differences);
    left_out_enter(&field, "normals of 6 values", "query", 0, run_normals_6, &differences);
    left_out_enter(&field, "refining", "query", 0, run_refining, &work);
    left_out_enter(&field, "offset origins", "query", 2, run_offset, &differences);
    if (work.field.gradient != NULL) {
        left_out_enter(&field, "normals by callback", "query", 0, run_normals_6, &work);
    }
    left_out_race(options, &field, rows);
    query_work_free(&work);
}

/* ---- Rays from inside of a convex body ------------------------------------------------------- */

static void run_convex(const void *user, size_t start) {
    const query_work *const work = user;
    const spt_rays rays = spt_rays_of(work->picture.rays + start);
    const spt_hits hits = hits_at(work, start);
    frame_expect(
        spt_trace_convex(&work->field, &work->settings, left_out_slice, &rays, &hits, NULL),
        "spt_trace_convex");
}

static void measure_convex(const report_options *options, const char *name, FILE *rows) {
    const scene *const shown = scene_named(name);
    query_work work = query_work_of(shown), checked = work;
    left_out_field field = {name, "convex", work.picture.count, 0, {{0}}};
    /* From around the middle of the body, in the directions of the picture. */
    for (size_t i = 0; i < work.picture.count; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            work.picture.rays[i].origin[axis] =
                (float)shown->target[axis] + 0.1f * work.picture.rays[i].direction[axis];
        }
    }
    checked.settings.flags |= SPT_CHECK_CONVEX;
    left_out_enter(&field, NULL, NULL, 0, run_convex, &work);
    left_out_enter(&field, "convexity check", "flag", 0, run_convex, &checked);
    left_out_race(options, &field, rows);
    query_work_free(&work);
}

/* ---- Frames ---------------------------------------------------------------------------------- */

typedef struct frame_work {
    const frame_picture *picture;
    frame_tracer *tracer;
    bench_hit *image;
} frame_work;

/* The whole picture: tiles differ too much to be a sample. */
static void run_frame(const void *user, size_t start) {
    const frame_work *const work = user;
    (void)start;
    frame_tracer_run(work->tracer, work->picture, frame_slice_of(work->picture, 0, 1), work->image);
}

static void measure_frame(const report_options *options, const char *name, FILE *rows) {
    static const frame_way ways[] = {
        {SCENE_OBJECTS, 0, 0}, {SCENE_OBJECTS, 1, 0}, {SCENE_OBJECTS, 0, 1}, {SCENE_OBJECTS, 1, 1}};
    enum { way_count = 4 };
    const int larger = options->quick ? 2 : 4;
    frame_picture *const picture =
        frame_picture_of(scene_named(name), larger * width, larger * height);
    bench_hit *const image = frame_image_of(picture->count);
    left_out_field field = {name, "adaptive", picture->count, 0, {{0}}};
    frame_work works[way_count];
    for (int i = 0; i < way_count; ++i) {
        works[i].picture = picture;
        works[i].image = image;
        works[i].tracer = frame_tracer_of(picture, &ways[i], "adaptive", 0);
    }
    left_out_enter(&field, NULL, NULL, 0, run_frame, &works[0]);
    left_out_enter(&field, "cones", "frame", 0, run_frame, &works[1]);
    if (works[0].tracer->parts.scene.count > 1) {
        left_out_enter(&field, "culling", "frame", 0, run_frame, &works[2]);
        left_out_enter(&field, "culling and cones", "frame", 0, run_frame, &works[3]);
    }
    left_out_race(options, &field, rows);
    for (int i = 0; i < way_count; ++i) frame_tracer_free(works[i].tracer);
    free(image);
    frame_picture_free(picture);
}

/* ---- Scenes ---------------------------------------------------------------------------------- */

typedef struct scene_work {
    spt_scene scene;
    query_work *query;
    void *workspace;
    size_t workspace_size;
} scene_work;

static void run_scene(const void *user, size_t start) {
    const scene_work *const work = user;
    const spt_rays rays = spt_rays_of(work->query->picture.rays + start);
    const spt_hits hits = hits_at(work->query, start);
    frame_expect(spt_scene_trace(&work->scene, &work->query->settings, left_out_slice, &rays, &hits,
                                 work->workspace, work->workspace_size, NULL),
                 "spt_scene_trace");
}

/* Balls that no ray meets: what it takes to look. */
static void measure_zones(const report_options *options, const char *name, FILE *rows) {
    static const spt_zone far_away = {{0.0f, 1e6f, 0.0f}, 1.0f, -1};
    query_work query = query_work_of(scene_named(name));
    scene_parts *const parts = report_allocate(sizeof *parts);
    left_out_field field = {name, "adaptive", query.picture.count, 0, {{0}}};
    scene_work without, with;
    scene_parts_of(scene_named(name), SCENE_OBJECTS, spt_lanes(), parts);
    without.scene = parts->scene;
    without.query = &query;
    without.workspace_size = spt_scene_workspace(&parts->scene, &query.settings);
    without.workspace = report_allocate(without.workspace_size);
    with = without;
    with.scene.zones = &far_away;
    with.scene.zone_count = 1;
    with.workspace_size = spt_scene_workspace(&with.scene, &query.settings);
    with.workspace = report_allocate(with.workspace_size);
    left_out_enter(&field, NULL, NULL, 0, run_scene, &without);
    left_out_enter(&field, "an empty zone", "scene", 0, run_scene, &with);
    left_out_race(options, &field, rows);
    free(without.workspace);
    free(with.workspace);
    free(parts);
    query_work_free(&query);
}

/* ---- The list -------------------------------------------------------------------------------- */

typedef void query_measure_fn(const report_options *options, const char *name, FILE *rows);

static const struct {
    query_measure_fn *measure;
    const char *scene;
} queries[] = {{measure_queries, "primitives"},  {measure_queries, "krs_tree_16"},
               {measure_convex, "dodecahedron"}, {measure_frame, "primitives"},
               {measure_frame, "village"},       {measure_frame, "mandelbulb"},
               {measure_frame, "krs_tree_16"},   {measure_zones, "village"}};

const int left_out_query_cells = sizeof queries / sizeof queries[0];

void left_out_measure_query(const report_options *options, int cell, FILE *rows) {
    queries[cell].measure(options, queries[cell].scene, rows);
}
