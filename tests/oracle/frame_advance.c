/* SPDX-License-Identifier: MIT
 *
 * Runs of progressive frames, with the promises of each call checked. */
#include "frame_advance.h"
#include "../check.h"

#include <math.h>
#include <string.h>

const schedule schedules[] = {
    {"one", 1, {{1, 1, 1}}},
    {"two", 2, {{1, 2, 0.125f}, {1, 1, 0.875f}}},
    {"four", 4, {{1, 4, 0.125f}, {1, 2, 0.125f}, {3, 4, 0.125f}, {1, 1, 0.625f}}},
    {"six",
     6,
     {{1, 6, 0.125f},
      {1, 3, 0.125f},
      {1, 2, 0.125f},
      {2, 3, 0.125f},
      {5, 6, 0.125f},
      {1, 1, 0.375f}}},
    {"two thirds", 2, {{2, 3, 0.5f}, {1, 1, 0.5f}}},
    {"five sevenths", 3, {{3, 11, 0.3f}, {5, 7, 0.2f}, {7, 7, 0.5f}}},
    {"falling", 4, {{4, 5, 0.25f}, {1, 100, 0.25f}, {3, 5, 0.25f}, {1, 1, 1}}},
};
const int schedule_count = sizeof schedules / sizeof schedules[0];

void schedule_set(spt_frame *frame, const schedule *which) {
    frame->passes = which->passes;
    frame->pass_count = which->count;
}

uint32_t schedule_size(uint32_t full, const spt_pass *pass) {
    return (uint32_t)(((uint64_t)full * pass->numerator + pass->denominator - 1) /
                      pass->denominator);
}

advance advance_begin(spt_frame *frame, int which, spt_hit *hits) {
    advance a;
    spt_status status;
    memset(&a.progress, 0, sizeof a.progress);
    a.cones = a.rays = 0;
    a.frame = frame;
    a.state = frame_state(frame, which, &a.size);
    a.hits = hits;
    if (hits != NULL) frame_blank(frame_pixels(frame), hits);
    status = spt_frame_restart(frame, a.state, a.size);
    CHECK_SAY(status == SPT_OK, "restart: %s", spt_status_name(status));
    return a;
}

static size_t passes_of(const spt_frame *frame) {
    return frame->passes != NULL ? frame->pass_count : 1;
}

int advance_finished(const advance *a) {
    return a->progress.pass >= passes_of(a->frame);
}

void advance_step(advance *a, uint64_t evaluations) {
    const spt_frame_progress before = a->progress;
    spt_statistics *const theirs = a->frame->statistics;
    spt_statistics own = spt_statistics_default();
    spt_hits sinks = {{0}, {0}, {0}, {0}, {0}, {0}, {0}, {0}, {0}};
    uint64_t spent;
    spt_status status;
    if (a->hits != NULL) sinks = spt_hits_of(a->hits);
    a->frame->statistics = &own;
    status = spt_frame_advance(a->frame, a->state, a->size, evaluations,
                               a->hits != NULL ? &sinks : NULL, &a->progress);
    a->frame->statistics = theirs;
    a->cones += own.cone_evaluations;
    a->rays += own.rays;
    CHECK_SAY(status == SPT_OK, "advance: %s", spt_status_name(status));
    CHECK(a->progress.restarted == 0);
    CHECK(a->progress.pass >= before.pass && a->progress.pass <= passes_of(a->frame));
    CHECK(a->progress.evaluations >= before.evaluations);
    CHECK(a->progress.pass > before.pass || a->progress.pixels >= before.pixels);
    CHECK(a->progress.pixels <= a->progress.pixel_count);
    spent = a->progress.evaluations - before.evaluations;
    CHECK_SAY(spent < evaluations + own.cone_evaluations + SPT_BATCH,
              "spent %.0f of %.0f, %.0f on cones", (double)spent, (double)evaluations,
              (double)own.cone_evaluations);
    CHECK_SAY(own.evaluations + own.cone_evaluations == spent, "%.0f and %.0f on cones, spent %.0f",
              (double)own.evaluations, (double)own.cone_evaluations, (double)spent);
    /* A chunk that is finished counts as 64, whatever it asked. */
    CHECK_SAY(spent >= evaluations || advance_finished(a) || a->progress.pass > before.pass ||
                  spent + 64 * (a->progress.pixels - before.pixels) >= evaluations,
              "spent %.0f of %.0f", (double)spent, (double)evaluations);
}

void advance_run(advance *a, uint64_t evaluations) {
    enum { most_calls = 1 << 22 };
    int calls = 0;
    while (!advance_finished(a) && calls < most_calls) {
        advance_step(a, evaluations);
        ++calls;
    }
    CHECK_SAY(advance_finished(a), "not finished after %d calls", calls);
}

void advance_finish(advance *a, uint64_t evaluations) {
    advance_run(a, evaluations);
    for (size_t i = 0; a->hits != NULL && i < frame_pixels(a->frame); ++i) {
        CHECK_SAY(!frame_is_blank(&a->hits[i]), "pixel %g %g is not written", frame_x(a->frame, i),
                  frame_y(a->frame, i));
    }
}

/* ---- Colours ------------------------------------------------------------------------------- */

void shade_log_open(shade_log *log, spt_frame *frame, const truth_field *field) {
    log->frame = frame;
    log->field = field;
    log->level = 0;
    log->faults = log->judged = log->wrong = 0;
    for (size_t i = 0; i < passes_of(frame); ++i) {
        const spt_pass full = {1, 1, 1};
        const spt_pass *pass = frame->passes != NULL ? &frame->passes[i] : &full;
        log->levels[i].width = schedule_size(frame->width, pass);
        log->levels[i].height = schedule_size(frame->height, pass);
        log->levels[i].count = 0;
        memset(log->levels[i].known, 0, sizeof log->levels[i].known);
    }
    frame->shade = shade_log_fn;
    frame->shade_user = log;
    frame->channels = log_channels;
}

/* Which column of `count` over `full` pixels a place is the middle of; -1 for none. Places are
 * floats of a few roundings: 1e-3 of a column is far more, in images this small. */
static int column_of(uint32_t count, uint32_t full, float place) {
    const double column = (double)place * (double)count / (double)full - 0.5;
    const double nearest = floor(column + 0.5);
    if (fabs(column - nearest) > 1e-3 || nearest < 0 || nearest >= (double)count) return -1;
    return (int)nearest;
}

/* The settings of the pass at work: half a pixel of it is larger. */
static spt_settings pass_settings(const shade_log *log) {
    const log_level *level = &log->levels[log->level];
    spt_settings settings = log->frame->settings;
    settings.pixel_radius *= fmaxf((float)log->frame->width / (float)level->width,
                                   (float)log->frame->height / (float)level->height);
    return settings;
}

/* The ray is that of the camera; its hit is judged from the camera's start on. */
static void log_ray(shade_log *log, float x, float y, const spt_ray *ray, const spt_hit *hit) {
    const spt_frame *frame = log->frame;
    const spt_settings coarse = pass_settings(log);
    spt_camera_ray camera;
    ray_truth truth;
    if (spt_camera_rays(frame->camera, frame->width, frame->height, 1, &x, &y, &camera) != SPT_OK) {
        ++log->faults;
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        log->faults += !check_same_bits(camera.ray.origin[axis], ray->origin[axis]) ||
                       !check_same_bits(camera.ray.direction[axis], ray->direction[axis]);
    }
    if (log->field == NULL || camera.active == 0) return;
    truth = truth_walk(log->field, &frame->settings, &camera.ray, (double)camera.path);
    ++log->judged;
    log->wrong += truth_judge(log->field, &coarse, &camera.ray, (double)camera.path, &truth, hit) !=
                  TRUTH_AGREES;
}

/* Where it is in the image, and how far the hit: smooth, and different for every pixel. */
static void colour_of(const spt_frame *frame, float x, float y, const spt_hit *hit, float *colour) {
    colour[0] = x / (float)frame->width;
    colour[1] = y / (float)frame->height;
    colour[2] = hit->outcome == SPT_HIT ? 1 / (1 + hit->t) : 2;
}

void shade_log_fn(void *user, size_t count, const float *x, const float *y, const spt_ray *rays,
                  const spt_hit *hits, float *colours) {
    shade_log *log = user;
    log->faults += count == 0 || count > SPT_BATCH;
    for (size_t i = 0; i < count; ++i) {
        log_level *level = &log->levels[log->level];
        const int column = column_of(level->width, log->frame->width, x[i]);
        const int row = column_of(level->height, log->frame->height, y[i]);
        const size_t place = (size_t)row * level->width + (size_t)column;
        colour_of(log->frame, x[i], y[i], &hits[i], &colours[i * log_channels]);
        log_ray(log, x[i], y[i], &rays[i], &hits[i]);
        if (column < 0 || row < 0 || level->known[place]) {
            ++log->faults;
            continue;
        }
        level->known[place] = 1;
        memcpy(&level->colour[place * log_channels], &colours[i * log_channels],
               log_channels * sizeof *colours);
        ++level->count;
        if (level->count == (size_t)level->width * level->height &&
            log->level + 1 < (int)passes_of(log->frame)) {
            ++log->level;
        }
    }
}
