/* SPDX-License-Identifier: MIT
 *
 * Frames of scenes and of worlds, and their memory. */
#include "frame_views.h"
#include "harness.h"
#include "../check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double radians = 3.14159265358979323846 / 180;
enum { blank = 0xa5 };

void view_of(view *v, const scene *shown, scene_grain grain, double degrees, uint32_t width,
             uint32_t height) {
    float eye[3], target[3];
    const float up[3] = {0, 1, 0};
    spt_status status;
    v->shown = shown;
    v->grain = grain;
    for (int axis = 0; axis < 3; ++axis) {
        eye[axis] = (float)shown->eye[axis];
        target[axis] = (float)shown->target[axis];
    }
    scene_parts_of(shown, grain, spt_lanes(), &v->parts);
    status = spt_camera_pinhole(&v->camera, eye, target, up, (float)tan(degrees / 2 * radians),
                                width, height);
    CHECK_SAY(status == SPT_OK, "%s", spt_status_name(status));
    v->camera.t_max = (float)shown->t_max;
    status = spt_frame_init(&v->frame, &v->parts.scene, &v->camera, width, height);
    CHECK_SAY(status == SPT_OK, "%s", spt_status_name(status));
    v->frame.settings.budget = 1000;
    frame_lend_workspace(&v->frame);
}

void view_window(spt_frame *frame, uint32_t left, uint32_t top, uint32_t right, uint32_t bottom) {
    frame->left = left;
    frame->top = top;
    frame->right = right;
    frame->bottom = bottom;
}

size_t frame_pixels(const spt_frame *frame) {
    return (size_t)(frame->right - frame->left) * (frame->bottom - frame->top);
}

double frame_x(const spt_frame *frame, size_t pixel) {
    return (double)frame->left + (double)(pixel % (frame->right - frame->left)) + 0.5;
}

double frame_y(const spt_frame *frame, size_t pixel) {
    return (double)frame->top + (double)(pixel / (frame->right - frame->left)) + 0.5;
}

/* Memory of exactly this size, so that a sanitizer sees what lies outside. */
typedef struct block {
    void *memory;
    size_t size;
} block;

static void *memory_of(block *which, size_t size) {
    if (which->size != size) {
        free(which->memory);
        which->memory = malloc(size);
        which->size = size;
        if (which->memory == NULL) {
            printf("no memory\n");
            exit(1);
        }
        memset(which->memory, blank, size);
    }
    return which->memory;
}

void frame_lend_workspace(spt_frame *frame) {
    static block workspace;
    const size_t size = spt_frame_workspace(frame);
    CHECK(size > 0);
    frame->workspace = memory_of(&workspace, size);
    frame->workspace_size = size;
}

void *frame_state(const spt_frame *frame, int which, size_t *size) {
    static block states[4];
    *size = spt_frame_state_size(frame);
    CHECK(*size > 0);
    return memory_of(&states[which], *size);
}

void frame_blank(size_t count, spt_hit *hits) {
    memset(hits, blank, count * sizeof *hits);
}

int frame_is_blank(const spt_hit *hit) {
    spt_hit never;
    frame_blank(1, &never);
    return memcmp(hit, &never, sizeof never) == 0;
}

/* No result has an outcome, a count or a number of those bits: about -2.9e-16, and for outcome,
 * flags and component, large negative ones. */
static int has_blanks(const spt_hit *hit) {
    spt_hit never;
    frame_blank(1, &never);
    return check_same_bits(hit->t, never.t) || check_same_bits(hit->residual, never.residual) ||
           hit->outcome == never.outcome || hit->evaluations == never.evaluations ||
           hit->flags == never.flags || hit->component == never.component ||
           check_same_bits(hit->candidate_t, never.candidate_t) ||
           check_same_bits(hit->candidate_ratio, never.candidate_ratio) ||
           hit->fallbacks == never.fallbacks;
}

void frame_trace(spt_frame *frame, uint32_t flags, spt_hit *hits) {
    const spt_hits sinks = spt_hits_of(hits);
    const size_t tiles = spt_frame_tiles(frame), pixels = frame_pixels(frame);
    const uint32_t before = frame->flags;
    size_t done = 0;
    spt_status status;
    frame->flags = flags;
    frame_blank(pixels, hits);
    status = spt_frame_trace(frame, 0, tiles, &sinks, &done);
    CHECK_SAY(status == SPT_OK && done == tiles, "%s after %zu of %zu tiles",
              spt_status_name(status), done, tiles);
    for (size_t i = 0; i < pixels; ++i) {
        CHECK_SAY(!has_blanks(&hits[i]), "pixel %g %g is not written", frame_x(frame, i),
                  frame_y(frame, i));
    }
    frame->flags = before;
}

void frame_rays(const spt_frame *frame, spt_camera_ray *rays) {
    static float x[view_pixels_most], y[view_pixels_most];
    const size_t pixels = frame_pixels(frame);
    for (size_t i = 0; i < pixels; ++i) {
        x[i] = (float)frame_x(frame, i);
        y[i] = (float)frame_y(frame, i);
    }
    CHECK(spt_camera_rays(frame->camera, frame->width, frame->height, pixels, x, y, rays) ==
          SPT_OK);
}

void frame_plain(const spt_frame *frame, const spt_camera_ray *rays, spt_hit *hits) {
    static block workspace;
    const size_t size = spt_scene_workspace(frame->scene, &frame->settings);
    const spt_hits sinks = spt_hits_of(hits);
    spt_rays views = spt_rays_of(&rays->ray);
    spt_status status;
    for (int axis = 0; axis < 3; ++axis) {
        views.origin[axis].stride = views.direction[axis].stride = (ptrdiff_t)sizeof *rays;
    }
    views.t_min.stride = views.t_max.stride = (ptrdiff_t)sizeof *rays;
    views.path.first = &rays->path;
    views.path.stride = (ptrdiff_t)sizeof *rays;
    views.active.first = &rays->active;
    views.active.stride = (ptrdiff_t)sizeof *rays;
    frame_blank(frame_pixels(frame), hits);
    status = spt_scene_trace(frame->scene, &frame->settings, frame_pixels(frame), &views, &sinks,
                             memory_of(&workspace, size), size, NULL);
    CHECK_SAY(status == SPT_OK, "%s", spt_status_name(status));
}

void frame_same(const spt_frame *frame, const spt_hit *a, const spt_hit *b, const char *what) {
    const size_t pixels = frame_pixels(frame);
    for (size_t i = 0; i < pixels; ++i) {
        CHECK_SAY(oracle_same_hit(&a[i], &b[i]),
                  "%s: pixel %g %g: outcome %d t %.9g evaluations %u, expected %d %.9g %u", what,
                  frame_x(frame, i), frame_y(frame, i), a[i].outcome, (double)a[i].t,
                  a[i].evaluations, b[i].outcome, (double)b[i].t, b[i].evaluations);
    }
}

void frame_same_answer(const spt_frame *frame, const spt_hit *a, const spt_hit *b,
                       const char *what) {
    const size_t pixels = frame_pixels(frame);
    for (size_t i = 0; i < pixels; ++i) {
        CHECK_SAY(
            check_same_bits(a[i].t, b[i].t) && check_same_bits(a[i].residual, b[i].residual) &&
                a[i].outcome == b[i].outcome && a[i].component == b[i].component &&
                a[i].flags == b[i].flags,
            "%s: pixel %g %g: outcome %d t %.9g component %d flags %u, expected %d %.9g %d "
            "%u",
            what, frame_x(frame, i), frame_y(frame, i), a[i].outcome, (double)a[i].t,
            a[i].component, a[i].flags, b[i].outcome, (double)b[i].t, b[i].component, b[i].flags);
    }
}
