/* SPDX-License-Identifier: MIT
 *
 * Cones of any camera: what a cone has walked through is empty for every ray in the pixel's
 * footprint, in random worlds whose first hits are known; cones that are too wide are none. */
#include "frame_listen.h"
#include "frame_worlds.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <string.h>

enum { most_pixels = 40 * 30, footprint_rays = 64 };
/* Worlds end at t 50; coordinates there stay below 70. */
static const double reach = 50, extent = 70;

static spt_camera_ray rays[most_pixels];
static spt_hit hits[most_pixels], others[most_pixels], plain[most_pixels];

static const uint32_t sizes[][2] = {{40, 30}, {13, 9},  {3, 31}, {33, 4},
                                    {16, 16}, {21, 30}, {5, 5}};
enum { size_count = sizeof sizes / sizeof sizes[0] };

static void open_frame(spt_frame *frame, const ball_scene *balls, const spt_camera *camera,
                       uint32_t width, uint32_t height) {
    CHECK(spt_frame_init(frame, &balls->scene, camera, width, height) == SPT_OK);
    frame->settings.budget = 2000;
    frame->settings.epsilon = 1e-4f;
    frame->settings.pixel_radius = 1e-5f;
    frame_lend_workspace(frame);
}

/* A camera before a world. Those of parallel rays stay above the floor and before the balls. */
static spt_camera draw_camera(int kind, double aspect) {
    const double eye[3] = {0, 0, 0}, target[3] = {0, 0, 8};
    const uint32_t variant = check_random() % CAMERA_VARIANTS;
    const double tangent =
        kind == SPT_CAMERA_PINHOLE ? exp(check_uniform(-2.5, 1.3)) : check_uniform(0.2, 0.6);
    spt_camera camera =
        camera_draw((spt_camera_kind)kind, variant, eye, target, 0.5, tangent, fmax(aspect, 0.5));
    camera.t_max = (float)reach;
    check_context("camera %d, variant %u, tangent %g, aspect %g", kind, variant, tangent, aspect);
    return camera;
}

/* Rounding of the field (two floors) and of the ray. */
static double slack_of(const camera_ray *ray) {
    return 2 * 0x1p-22 * (reach + extent) + 2 * reach * ray->direction_error +
           2 * (ray->origin_error[0] + ray->origin_error[1] + ray->origin_error[2]);
}

/* The least first hit of rays through the pixel. */
static double first_in_footprint(const spt_frame *frame, const world *shape, size_t pixel) {
    double first = HUGE_VAL;
    for (int i = 0; i < footprint_rays; ++i) {
        const double x = frame_x(frame, pixel) + (i < 4 ? (i & 1) - 0.5 : check_uniform(-0.5, 0.5));
        const double y = frame_y(frame, pixel) + (i < 4 ? i / 2 - 0.5 : check_uniform(-0.5, 0.5));
        const camera_ray ray = camera_ray_at(frame->camera, frame->width, frame->height, x, y);
        first = fmin(first, ball_scene_first(shape, ray.origin, ray.direction, slack_of(&ray)));
    }
    return first;
}

/* Components have no bounds here, so that rays start where their cone stopped and not at the entry
 * of a bound. A cone that misses everything ends all its rays: nothing may be in their pixels. */
static void Q15_start_before_footprint(void) {
    static listener ears;
    uint64_t before_hits = 0, well_ahead = 0;
    for (int i = 0; i < 120; ++i) {
        const uint32_t *size = sizes[i % size_count];
        const world shape = world_draw();
        const spt_camera camera = draw_camera(1 + i % 2, (double)size[0] / size[1]);
        ball_scene balls;
        spt_frame frame;
        ball_scene_of(&balls, &shape, 0, i % 3 == 0 ? ~0u : 0);
        open_frame(&frame, &balls, &camera, size[0], size[1]);
        frame.settings.max_lanes = widths[i % width_count];
        listen_trace(&ears, &frame, i % 4 < 2 ? 0 : SPT_FRAME_NO_CULLING, hits);
        for (size_t pixel = 0; pixel < frame_pixels(&frame); ++pixel) {
            const double first = first_in_footprint(&frame, &shape, pixel);
            const double start = ears.first[pixel];
            CHECK_SAY(start < HUGE_VAL ? start - 0x1p-22 * (start + 1) <= first : first > reach,
                      "world %d, pixel %g %g: start %.9g, first hit %.9g", i,
                      frame_x(&frame, pixel), frame_y(&frame, pixel), start, first);
            before_hits += first <= reach;
            well_ahead += first <= reach && start > first / 4;
        }
    }
    check_context("all worlds");
    CHECK(before_hits > 2000);
    CHECK_SAY(well_ahead * 2 > before_hits, "%.0f of %.0f start in the last three quarters",
              (double)well_ahead, (double)before_hits);
}

/* Where the ray is clear of everything, cones and culling change neither outcome nor place. */
static void check_clear(const spt_frame *frame, const world *shape, const spt_hit *given) {
    for (size_t pixel = 0; pixel < frame_pixels(frame); ++pixel) {
        const world_hit truth = world_trace(shape, &rays[pixel].ray);
        const double t = (double)given[pixel].t;
        if (!(truth.gap > 0.02)) continue;
        CHECK_SAY(given[pixel].outcome == (truth.t <= reach ? SPT_HIT : SPT_MISS),
                  "pixel %g %g: outcome %d, truth %g", frame_x(frame, pixel), frame_y(frame, pixel),
                  given[pixel].outcome, truth.t);
        if (given[pixel].outcome != SPT_HIT) continue;
        CHECK_SAY(t <= truth.t + 2e-3 * (1 + truth.t) && fabs(t - truth.t) < 0.05,
                  "pixel %g %g: t %.9g, truth %.9g", frame_x(frame, pixel), frame_y(frame, pixel),
                  t, truth.t);
    }
}

/* The same bits at every width. */
static void check_widths(spt_frame *frame) {
    for (int width = 0; width < width_count; ++width) {
        frame->settings.max_lanes = widths[width];
        frame_lend_workspace(frame);
        frame_trace(frame, 0, others);
        frame_same(frame, others, hits, "width");
    }
}

static void Q15_same_hits_with_cones(void) {
    for (int i = 0; i < 140; ++i) {
        const uint32_t *size = sizes[i % size_count];
        const world shape = world_draw();
        const spt_camera camera = draw_camera(1 + i % 2, (double)size[0] / size[1]);
        ball_scene balls;
        spt_frame frame;
        ball_scene_draw(&balls, &shape);
        open_frame(&frame, &balls, &camera, size[0], size[1]);
        frame_rays(&frame, rays);
        frame_plain(&frame, rays, plain);
        frame_trace(&frame, SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING, hits);
        frame_same(&frame, hits, plain, "plain");
        frame_trace(&frame, SPT_FRAME_NO_CONES, hits);
        frame_same_answer(&frame, hits, plain, "culled");
        check_clear(&frame, &shape, hits);
        frame_trace(&frame, SPT_FRAME_NO_CULLING, others);
        frame_trace(&frame, 0, hits);
        frame_same_answer(&frame, hits, others, "cones, culled");
        check_clear(&frame, &shape, hits);
        check_widths(&frame);
    }
}

/* ---- Cameras of the caller's rays ---------------------------------------------------------- */

/* As frame_trace(), where rays may be inactive. */
static void trace_some(spt_frame *frame, uint32_t flags, spt_hit *results) {
    const spt_hits sinks = spt_hits_of(results);
    frame->flags = flags;
    frame_blank(frame_pixels(frame), results);
    CHECK(spt_frame_trace(frame, 0, spt_frame_tiles(frame), &sinks, NULL) == SPT_OK);
    for (size_t i = 0; i < frame_pixels(frame); ++i) {
        CHECK_SAY(frame_is_blank(&results[i]) == (rays[i].active == 0), "pixel %zu, active %d", i,
                  rays[i].active);
    }
}

static void check_inactive_widths(spt_frame *frame) {
    for (int width = 0; width < width_count; ++width) {
        frame->settings.max_lanes = widths[width];
        frame_lend_workspace(frame);
        trace_some(frame, 0, others);
        frame_same(frame, others, hits, "width");
    }
}

static int is_bad(const spt_camera_ray *ray) {
    const float *d = ray->ray.direction;
    return isnan(ray->ray.t_max) || isnan(d[0]) || isnan(d[1]) || isnan(d[2]);
}

static void judge_all(const spt_frame *frame, const ball_scene *balls, const ray_truth *truths,
                      const spt_hit *results) {
    const truth_field field = ball_scene_truth(balls);
    for (size_t i = 0; i < frame_pixels(frame); ++i) {
        if (rays[i].active == 0) continue;
        if (is_bad(&rays[i])) {
            CHECK(results[i].outcome == SPT_BAD_RAY && isinf(results[i].t));
            CHECK(results[i].evaluations == 0);
            continue;
        }
        CHECK_SAY(truth_judge(&field, &frame->settings, &rays[i].ray, (double)rays[i].path,
                              &truths[i], &results[i]) == TRUTH_AGREES,
                  "pixel %g %g: outcome %d t %.9g; zero %.9g deep %.9g through %.9g",
                  frame_x(frame, i), frame_y(frame, i), results[i].outcome, (double)results[i].t,
                  truths[i].zero, truths[i].deep, truths[i].through);
    }
}

static void check_lens(int kind, const world *shape, const uint32_t size[2]) {
    static ray_truth truths[most_pixels];
    ball_scene balls;
    lens user;
    const spt_camera camera = lens_camera(&user, kind, size[0], size[1]);
    const truth_field field = ball_scene_truth(&balls);
    spt_frame frame;
    ball_scene_draw(&balls, shape);
    open_frame(&frame, &balls, &camera, size[0], size[1]);
    if (kind == LENS_MIXED) frame.settings.pixel_radius = 2e-3f; /* the path counts */
    frame_rays(&frame, rays);
    for (size_t i = 0; i < frame_pixels(&frame); ++i) {
        if (is_bad(&rays[i])) continue;
        truths[i] = truth_walk(&field, &frame.settings, &rays[i].ray, (double)rays[i].path);
    }
    frame_plain(&frame, rays, plain);
    trace_some(&frame, SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING, hits);
    frame_same(&frame, hits, plain, "plain");
    judge_all(&frame, &balls, truths, hits);
    trace_some(&frame, SPT_FRAME_NO_CONES, hits);
    frame_same_answer(&frame, hits, plain, "culled");
    trace_some(&frame, SPT_FRAME_NO_CULLING, others);
    trace_some(&frame, 0, hits);
    frame_same_answer(&frame, hits, others, "cones, culled");
    judge_all(&frame, &balls, truths, hits);
    check_inactive_widths(&frame);
    for (frame.settings.budget = 0; frame.settings.budget < 9;
         frame.settings.budget += 1 + frame.settings.budget / 2) {
        trace_some(&frame, 0, hits);
        judge_all(&frame, &balls, truths, hits);
    }
}

static void Q15_cameras_of_the_caller(void) {
    for (int kind = 0; kind < lens_kinds; ++kind) {
        for (int i = 0; i < 14; ++i) {
            const world shape = world_draw();
            check_context("lens %d, world %d", kind, i);
            check_lens(kind, &shape, sizes[i % size_count]);
        }
    }
}

/* ---- Cones that are none ------------------------------------------------------------------- */

/* One pixel has no bundle to save; a bundle of half angle 90 degrees and more (here 4x4 pixels
 * over nearly 180, and a panorama of so few) has no cone. */
static void F6_no_cone(void) {
    for (int i = 0; i < 40; ++i) {
        const world shape = world_draw();
        const double eye[3] = {0, 0, 0}, target[3] = {0, 0, 8};
        lens user;
        spt_camera camera = camera_draw(SPT_CAMERA_PINHOLE, 0, eye, target, 0.5,
                                        i % 4 == 0 ? 0.6 : exp(check_uniform(3, 9)), 1);
        const uint32_t side = i % 4 == 0 ? 1 : 2 + (uint32_t)i % 3;
        ball_scene balls;
        spt_frame frame;
        camera.t_max = (float)reach;
        if (i % 4 == 1) camera = lens_camera(&user, LENS_PANORAMA, side, side);
        ball_scene_of(&balls, &shape, 0, 0);
        check_context("world %d, %u pixels a side", i, side);
        open_frame(&frame, &balls, &camera, side, side);
        frame_trace(&frame, SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING, hits);
        frame_trace(&frame, SPT_FRAME_NO_CULLING, others);
        frame_same(&frame, others, hits, "no cone");
        frame_trace(&frame, 0, others);
        frame_same_answer(&frame, others, hits, "no cone, culled");
        frame.settings.budget = 0;
        frame_trace(&frame, SPT_FRAME_NO_CULLING, hits);
        for (uint32_t pixel = 0; pixel < side * side; ++pixel) {
            CHECK_SAY(hits[pixel].outcome == SPT_LIMIT && check_same_bits(hits[pixel].t, 0),
                      "pixel %u: starts at %g", pixel, (double)hits[pixel].t);
        }
    }
}

void suite_frame_cones(void) {
    RUN(Q15_start_before_footprint);
    RUN(Q15_same_hits_with_cones);
    RUN(Q15_cameras_of_the_caller);
    RUN(F6_no_cone);
}
