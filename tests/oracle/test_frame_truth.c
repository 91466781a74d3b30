/* SPDX-License-Identifier: MIT
 *
 * Frames of every scene against a slow walk in double: no ray lost, no start beyond what is free,
 * with and without cones and culling, at every field of view and aspect. */
#include "frame_listen.h"
#include "../check.h"

#include <math.h>
#include <string.h>

enum { most_pixels = 40 * 30 };

static view shown_view;
static spt_camera_ray rays[most_pixels];
static ray_truth truths[most_pixels];
static spt_hit plain[most_pixels], hits[most_pixels], others[most_pixels];

static const double degrees[] = {20, 50, 90, 120, 150};
enum { degree_count = sizeof degrees / sizeof degrees[0] };

static void find_truths(const view *v) {
    const truth_field field = truth_of_scene(v->shown);
    frame_rays(&v->frame, rays);
    for (size_t i = 0; i < frame_pixels(&v->frame); ++i) {
        truths[i] = truth_walk(&field, &v->frame.settings, &rays[i].ray, 0);
    }
}

/* All results against the truth. */
static truth_sum judge(const view *v, const spt_hit *results, const char *what) {
    const truth_field field = truth_of_scene(v->shown);
    truth_sum sum = {0, 0, 0, 0, 0, 0, 0};
    for (size_t i = 0; i < frame_pixels(&v->frame); ++i) {
        const int judgement =
            truth_judge(&field, &v->frame.settings, &rays[i].ray, 0, &truths[i], &results[i]);
        truth_count(&sum, &truths[i], &results[i], judgement);
        CHECK_SAY(judgement == TRUTH_AGREES,
                  "%s: pixel %g %g %s: outcome %d at %.9g; zero %.9g, deep from %.9g, through from "
                  "%.9g",
                  what, frame_x(&v->frame, i), frame_y(&v->frame, i),
                  judgement == TRUTH_LOST   ? "lost"
                  : judgement == TRUTH_LATE ? "late"
                                            : "false",
                  results[i].outcome, (double)results[i].t, truths[i].zero, truths[i].deep,
                  truths[i].through);
    }
    return sum;
}

/* Sums of start over first zero where there is one. */
typedef struct start_sum {
    double ratio;
    uint64_t count;
} start_sum;

/* Where the rays start: no first point that is asked of a ray lies beyond what is free. A ray of
 * which none is asked misses, and was judged as that. */
static void judge_starts(const view *v, uint32_t flags, start_sum *sum) {
    static listener ears;
    listen_trace(&ears, &v->frame, flags, hits);
    for (size_t i = 0; i < frame_pixels(&v->frame); ++i) {
        const double first = ears.first[i];
        /* The point that is heard of is rounded: two units in the last place of it. */
        const double off = 0x1p-22 * (first + 30);
        CHECK_SAY(hits[i].evaluations == 0 || (double)hits[i].t < 0.1 || first < HUGE_VAL,
                  "pixel %g %g was not heard", frame_x(&v->frame, i), frame_y(&v->frame, i));
        CHECK_SAY(!(first < HUGE_VAL) || first - off <= truths[i].deep,
                  "pixel %g %g: starts at %.9g; zero %.9g, deep from %.9g", frame_x(&v->frame, i),
                  frame_y(&v->frame, i), first, truths[i].zero, truths[i].deep);
        if (!(truths[i].zero < HUGE_VAL)) continue;
        sum->ratio += fmin(first / truths[i].zero, 1);
        ++sum->count;
    }
}

/* With a small budget a ray, and its cones, end on the way, where it says it is free up to. */
static void judge_stops(view *v, uint32_t flags, uint32_t budget) {
    const uint32_t before = v->frame.settings.budget;
    v->frame.settings.budget = budget;
    frame_trace(&v->frame, flags, hits);
    (void)judge(v, hits, "stop");
    v->frame.settings.budget = before;
}

/* A frame that leaves nothing out is spt_scene_trace(); a component that is left out changes no
 * answer; cones lose nothing. */
static void check_view(view *v, truth_sum *total) {
    static spt_hit cones[most_pixels];
    truth_sum sum;
    frame_plain(&v->frame, rays, plain);
    frame_trace(&v->frame, SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING, hits);
    frame_same(&v->frame, hits, plain, "plain");
    (void)judge(v, hits, "plain");
    frame_trace(&v->frame, SPT_FRAME_NO_CONES, others);
    frame_same_answer(&v->frame, others, plain, "culled");
    frame_trace(&v->frame, SPT_FRAME_NO_CULLING, cones);
    (void)judge(v, cones, "cones");
    frame_trace(&v->frame, 0, hits);
    sum = judge(v, hits, "cones and culling");
    frame_same_answer(&v->frame, hits, cones, "cones, culled");
    total->rays += sum.rays;
    total->due += sum.due;
    total->found += sum.found;
    total->undecided += sum.undecided;
}

static void check_grains(const scene *shown, double angle, uint32_t width, uint32_t height,
                         truth_sum *total, start_sum *starts) {
    for (int grain = SCENE_WHOLE; grain <= SCENE_PRIMITIVES; ++grain) {
        size_t components = shown_view.parts.scene.count;
        view_of(&shown_view, shown, (scene_grain)grain, angle, width, height);
        if (grain != SCENE_WHOLE && shown_view.parts.scene.count == components) continue;
        check_context("%s in %zu, %g degrees, %ux%u", shown->name, shown_view.parts.scene.count,
                      angle, width, height);
        if (grain == SCENE_WHOLE) find_truths(&shown_view);
        check_view(&shown_view, total);
        judge_starts(&shown_view, 0, starts);
        judge_starts(&shown_view, SPT_FRAME_NO_CULLING, starts);
        for (uint32_t budget = 0; budget < 8; budget += 1 + budget / 2) {
            judge_stops(&shown_view, 0, budget);
            judge_stops(&shown_view, SPT_FRAME_NO_CULLING, budget);
        }
    }
}

/* Landscape, portrait and one of the odd shapes for every scene and field of view. */
static void check_scenes(int part) {
    static const uint32_t shapes[][2] = {{4, 40}, {40, 4}, {1, 1}, {7, 5}, {33, 17}, {3, 30}};
    truth_sum total = {0, 0, 0, 0, 0, 0, 0};
    start_sum starts = {0, 0};
    for (size_t i = 0; i < scene_count; ++i) {
        for (size_t j = 0; j < degree_count; ++j) {
            const uint32_t *odd = shapes[(i + j) % (sizeof shapes / sizeof shapes[0])];
            const uint32_t width = part == 0 ? 24 : part == 1 ? 14 : odd[0];
            const uint32_t height = part == 0 ? 16 : part == 1 ? 22 : odd[1];
            check_grains(scenes[i], degrees[j], width, height, &total, &starts);
        }
    }
    check_context("all scenes");
    CHECK(total.due > total.rays / 10);
    CHECK_SAY(total.found * 1000 >= total.due * 995, "%.0f of %.0f found", (double)total.found,
              (double)total.due);
    /* The starts are worth a name: without cones they would be 0, or the entry of a bound. */
    CHECK_SAY(starts.ratio > 0.5 * (double)starts.count, "%g of the way on average",
              starts.ratio / (double)starts.count);
}

static void frame_truth_landscape(void) {
    check_scenes(0);
}

static void frame_truth_portrait(void) {
    check_scenes(1);
}

static void frame_truth_odd_shapes(void) {
    check_scenes(2);
}

/* The component of a hit is one that is there, and no other is nearer. */
static void frame_truth_components(void) {
    for (size_t i = 0; i < scene_count; ++i) {
        const spt_settings *settings = &shown_view.frame.settings;
        size_t named = 0;
        view_of(&shown_view, scenes[i], SCENE_OBJECTS, 50, 40, 30);
        check_context("%s", scenes[i]->name);
        frame_rays(&shown_view.frame, rays);
        frame_trace(&shown_view.frame, 0, hits);
        for (size_t pixel = 0; pixel < most_pixels; ++pixel) {
            const spt_ray *ray = &rays[pixel].ray;
            const int32_t component = hits[pixel].component;
            const double t = (double)hits[pixel].t;
            double p[3], f, off;
            if (hits[pixel].outcome != SPT_HIT) {
                CHECK(component == -1);
                continue;
            }
            CHECK_SAY(component >= 0 && (size_t)component < shown_view.parts.scene.count, "%d",
                      component);
            for (int axis = 0; axis < 3; ++axis) {
                p[axis] = (double)ray->origin[axis] + t * (double)ray->direction[axis];
            }
            scene_part_reference(scenes[i], SCENE_OBJECTS, (size_t)component, 1, &p[0], &p[1],
                                 &p[2], &f);
            off = fmax((double)settings->epsilon, (double)settings->pixel_radius * t) +
                  16 * 0x1p-24 * (t + 20);
            CHECK_SAY(fabs(f) <= off * (double)scenes[i]->lipschitz,
                      "pixel %zu: component %d is %g away, tolerance %g", pixel, component, f, off);
            ++named;
        }
        CHECK(named > most_pixels / 20);
    }
}

void suite_frame_truth(void) {
    RUN(frame_truth_landscape);
    RUN(frame_truth_portrait);
    RUN(frame_truth_odd_shapes);
    RUN(frame_truth_components);
}
