/* SPDX-License-Identifier: MIT
 *
 * Pixels that cones turn from hit to miss or back: few, and each of them within one pixel of a
 * silhouette of the double truth. */
#include "frame_camera.h"
#include "frame_views.h"
#include "../check.h"

#include <math.h>

enum { window = 64, most_pixels = window * window };

static view shown_view;
static spt_camera_ray rays[most_pixels];
static spt_hit plain[most_pixels], culled[most_pixels], cones[most_pixels];

/* The ray through a point of the image, in double and then rounded, not by the library. */
static spt_ray ray_through(const view *v, double x, double y) {
    const camera_ray exact = camera_ray_at(&v->camera, v->frame.width, v->frame.height, x, y);
    spt_ray ray;
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = (float)exact.origin[axis];
        ray.direction[axis] = (float)exact.direction[axis];
    }
    ray.t_min = v->camera.t_min;
    ray.t_max = v->camera.t_max;
    return ray;
}

/* Within one pixel some rays hit and some do not, or the ray passes a surface that it misses by no
 * more than a pixel: the tolerance is half a pixel, and f at samples up to twice what it is between
 * them. */
static int near_silhouette(const view *v, double x, double y) {
    const truth_field field = truth_of_scene(v->shown);
    int hit = 0, missed = 0;
    for (int i = -4; i <= 4; ++i) {
        for (int j = -4; j <= 4; ++j) {
            const spt_ray ray = ray_through(v, x + i / 4.0, y + j / 4.0);
            const ray_truth truth = truth_walk(&field, &v->frame.settings, &ray, 0);
            hit += truth.zero < HUGE_VAL;
            missed += !(truth.zero < HUGE_VAL);
            if (i == 0 && j == 0 && missed != 0 && truth.clearance <= 4) return 1;
            if (hit != 0 && missed != 0) return 1;
        }
    }
    return 0;
}

/* Flips of one picture against another, of decided rays. */
static uint64_t count_flips(const view *v, const spt_hit *a, const spt_hit *b, const char *what) {
    uint64_t flips = 0;
    for (size_t i = 0; i < frame_pixels(&v->frame); ++i) {
        const double x = frame_x(&v->frame, i), y = frame_y(&v->frame, i);
        const int undecided = a[i].outcome == SPT_LIMIT || b[i].outcome == SPT_LIMIT;
        if (undecided || (a[i].outcome == SPT_HIT) == (b[i].outcome == SPT_HIT)) continue;
        ++flips;
        CHECK_SAY(near_silhouette(v, x, y), "%s: pixel %g %g flips far from a silhouette", what, x,
                  y);
    }
    return flips;
}

typedef struct flip_sum {
    uint64_t pixels, cones, culling;
} flip_sum;

static void add_flips(flip_sum *sum) {
    frame_trace(&shown_view.frame, SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING, plain);
    frame_trace(&shown_view.frame, SPT_FRAME_NO_CONES, culled);
    frame_trace(&shown_view.frame, 0, cones);
    sum->pixels += frame_pixels(&shown_view.frame);
    sum->culling += count_flips(&shown_view, culled, plain, "culling");
    sum->cones += count_flips(&shown_view, cones, plain, "cones");
}

/* Windows of 1921x1081. Scenes of bodies thinner than a pixel in places have more of them. */
static void frame_flips_large(void) {
    flip_sum all = {0, 0, 0};
    for (size_t i = 0; i < scene_count; ++i) {
        for (int place = 0; place < 5; ++place) {
            const uint32_t left = 560 + check_random() % 700, top = 280 + check_random() % 400;
            view_of(&shown_view, scenes[i], SCENE_OBJECTS, scenes[i]->field_of_view, 1921, 1081);
            view_window(&shown_view.frame, left, top, left + window, top + window);
            check_context("%s, from %u %u", scenes[i]->name, left, top);
            add_flips(&all);
        }
    }
    check_context("all scenes");
    CHECK_SAY(all.cones * 10000 <= all.pixels, "%.0f of %.0f pixels flip", (double)all.cones,
              (double)all.pixels);
    CHECK_SAY(all.culling == 0, "%.0f flip by culling", (double)all.culling);
}

/* Small pictures, where much is thinner than a pixel. */
static void frame_flips_small(void) {
    static const double degrees[] = {20, 50, 90, 120, 150};
    flip_sum all = {0, 0, 0};
    for (size_t i = 0; i < scene_count; ++i) {
        for (int j = 0; j < 5; ++j) {
            view_of(&shown_view, scenes[i], SCENE_OBJECTS, degrees[j], j % 2 ? 40 : 64,
                    j % 2 ? 64 : 40);
            check_context("%s, %g degrees", scenes[i]->name, degrees[j]);
            add_flips(&all);
        }
    }
    check_context("all scenes");
    CHECK_SAY(all.cones * 1000 <= all.pixels, "%.0f of %.0f pixels flip", (double)all.cones,
              (double)all.pixels);
    CHECK_SAY(all.culling == 0, "%.0f flip by culling", (double)all.culling);
}

/* Every 61st ray of such windows, and of the image's corners, against the truth. */
static void frame_flips_truth(void) {
    for (size_t i = 0; i < scene_count; ++i) {
        const truth_field field = truth_of_scene(scenes[i]);
        for (int place = 0; place < 3; ++place) {
            const uint32_t left = place == 0 ? 1921 - window : 600 + check_random() % 640;
            const uint32_t top = place == 0 ? 1081 - window : 300 + check_random() % 360;
            view_of(&shown_view, scenes[i], SCENE_OBJECTS, place == 0 ? 120 : 55, 1921, 1081);
            view_window(&shown_view.frame, left, top, left + window, top + window);
            check_context("%s, from %u %u", scenes[i]->name, left, top);
            frame_rays(&shown_view.frame, rays);
            frame_trace(&shown_view.frame, 0, cones);
            shown_view.frame.settings.budget = 0;
            frame_trace(&shown_view.frame, 0, culled);
            for (size_t pixel = check_random() % 61; pixel < most_pixels; pixel += 61) {
                const ray_truth truth =
                    truth_walk(&field, &shown_view.frame.settings, &rays[pixel].ray, 0);
                for (int start = 0; start < 2; ++start) {
                    const spt_hit *hit = start ? &culled[pixel] : &cones[pixel];
                    CHECK_SAY(truth_judge(&field, &shown_view.frame.settings, &rays[pixel].ray, 0,
                                          &truth, hit) == TRUTH_AGREES,
                              "%s %zu: outcome %d t %.9g; zero %.9g deep %.9g through %.9g",
                              start ? "start" : "pixel", pixel, hit->outcome, (double)hit->t,
                              truth.zero, truth.deep, truth.through);
                }
            }
        }
    }
}

void suite_frame_flips(void) {
    RUN(frame_flips_large);
    RUN(frame_flips_small);
    RUN(frame_flips_truth);
}
