/* SPDX-License-Identifier: MIT
 *
 * The ways of claims_levels.c: rays one by one, frames with cones ahead, ambient occlusion. */
#include "claims_levels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static krs_body body_of(const level_way *way) {
    return way->work != LEVEL_TRACE ? KRS_TREE : krs_case_of[way->traced].body;
}

static int is_frame(const level_way *way) {
    return way->work == LEVEL_TRACE && krs_case_of[way->traced].how == KRS_FRAME;
}

void level_enter(level_runner *runner, const level_way *way, level_track *track) {
    memset(runner, 0, sizeof *runner);
    runner->way = way;
    runner->track = track;
    runner->probe_ratio = (double)spt_binary_default().probe_ratio;
    if (!is_frame(way)) return;
    const krs_body body = body_of(way);
    const frame_picture *const picture = track->pictures[body];
    spt_frame *const frame = &runner->frame;
    frame_expect(spt_frame_init(frame, &track->models.scenes[body], &picture->camera,
                                picture->width, picture->height),
                 "spt_frame_init");
    frame->settings = krs_settings(way->traced, frame->settings.pixel_radius);
    frame->workspace_size = spt_frame_workspace(frame);
    frame->workspace = report_allocate(frame->workspace_size);
    frame->statistics = &runner->statistics;
}

void level_leave(level_runner *runner) {
    free(runner->frame.workspace);
}

static void trace(level_runner *runner) {
    level_track *const track = runner->track;
    const krs_body body = body_of(runner->way);
    const frame_picture *const part = &track->parts[body];
    const spt_settings settings = krs_settings(runner->way->traced, part->pixel_radius);
    const spt_hits sinks = bench_hits_of(track->image);
    if (!is_frame(runner->way)) {
        krs_trace(&track->models, runner->way->traced, (float)runner->probe_ratio, &settings,
                  part->count, part->rays, track->hits, &runner->statistics);
        return;
    }
    for (size_t i = 0; i < part->tiles; ++i) {
        frame_expect(spt_frame_tile(&runner->frame, part->order[i], &sinks), "spt_frame_tile");
    }
}

static void trace_unbounded(level_runner *runner) {
    level_track *const track = runner->track;
    const frame_picture *const part = &track->parts[KRS_TREE];
    const spt_settings settings = krs_settings(runner->way->traced, part->pixel_radius);
    const spt_rays rays = spt_rays_of(part->rays);
    const spt_hits sinks = bench_hits_of(track->hits);
    spt_field field = *krs_models_field(&track->models, KRS_TREE);
    field.bound = NULL;
    frame_expect(spt_trace(&field, &settings, part->count, &rays, &sinks, &runner->statistics),
                 "spt_trace");
}

/* The points are in the Morton order of their pixels, so one of four is one of two by two. */
static void occlude(level_runner *runner) {
    level_track *const track = runner->track;
    const ptrdiff_t one_of = runner->way->one_of;
    const size_t count = track->point_count / (size_t)one_of;
    spt_vectors points = spt_vectors_of(track->points), normals = spt_vectors_of(track->normals);
    spt_sink openness = {track->openness, (ptrdiff_t)sizeof *track->openness};
    for (int axis = 0; axis < 3; ++axis) {
        points.axis[axis].stride *= one_of;
        normals.axis[axis].stride *= one_of;
    }
    frame_expect(spt_ambient_occlusion(krs_models_field(&track->models, KRS_TREE), 1,
                                       (uint32_t)runner->way->samples, track->reach, count, &points,
                                       &normals, &openness),
                 "spt_ambient_occlusion");
    runner->statistics.evaluations += (uint64_t)runner->way->samples * count;
}

double level_run(void *user, int round) {
    level_runner *const runner = user;
    (void)round;
    runner->statistics = spt_statistics_default();
    const double before = bench_seconds();
    switch (runner->way->work) {
    case LEVEL_TRACE:
        trace(runner);
        break;
    case LEVEL_UNBOUNDED:
        trace_unbounded(runner);
        break;
    case LEVEL_OCCLUSION:
        occlude(runner);
        break;
    }
    return bench_seconds() - before;
}

krs_error level_judge(const level_runner *runner) {
    const level_track *const track = runner->track;
    const krs_body body = body_of(runner->way);
    const krs_sample *const sample = &track->samples[body];
    const spt_settings settings =
        krs_settings(runner->way->traced, track->parts[body].pixel_radius);
    bench_hit *const found = frame_image_of(sample->count);
    krs_trace(&track->models, runner->way->traced, (float)runner->probe_ratio, &settings,
              sample->count, sample->rays, found, NULL);
    const krs_error error = krs_sample_judge(sample, &settings, found);
    free(found);
    return error;
}

void level_find_points(level_track *track) {
    const frame_picture *const part = &track->parts[KRS_TREE];
    const spt_field *const field = krs_models_field(&track->models, KRS_TREE);
    const spt_settings settings = krs_settings(krs_single_direct, part->pixel_radius);
    const spt_rays rays = spt_rays_of(part->rays);
    const spt_hits hits = bench_hits_of(track->hits);
    const spt_vector_sinks sinks = spt_vector_sinks_of(track->normals);
    frame_expect(spt_normals(field, 1, &settings, SPT_NORMAL_TETRAHEDRON, 0, part->count, &rays,
                             &hits, &sinks),
                 "spt_normals");
    track->point_count = 0;
    for (size_t i = 0; i < part->count; ++i) {
        const size_t place = track->point_count;
        if (track->hits[i].outcome != SPT_HIT) continue;
        for (size_t axis = 0; axis < 3; ++axis) {
            track->normals[3 * place + axis] = track->normals[3 * i + axis];
            track->points[3 * place + axis] =
                part->rays[i].origin[axis] + track->hits[i].t * part->rays[i].direction[axis];
        }
        ++track->point_count;
    }
}
