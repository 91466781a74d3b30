/* SPDX-License-Identifier: MIT
 *
 * Passes of rising resolution against a slow walk in double: every scene with every schedule, final
 * and coarse pictures, and where the rays of the last pass start. */
#include "frame_advance.h"
#include "frame_worlds.h"
#include "../check.h"

#include <math.h>
#include <string.h>

enum { most_pixels = 34 * 26 };

static view shown_view;
static spt_camera_ray rays[most_pixels];
static ray_truth truths[most_pixels];
static spt_hit hits[most_pixels], others[most_pixels];
static shade_log seen;

/* Schedules by name of their number of resolutions, section 4 of the paper; of the six shares five
 * are printed, and all must be the whole. */
static void frame_passes_tables(void) {
    for (size_t count = 0; count <= 20; ++count) {
        const spt_pass *passes = spt_passes(count);
        const schedule *expected = NULL;
        double sum = 0;
        for (int i = 0; i < 4; ++i) {
            if (schedules[i].count == count) expected = &schedules[i];
        }
        CHECK((passes != NULL) == (expected != NULL));
        if (passes == NULL || expected == NULL) continue;
        for (size_t i = 0; i < count; ++i) {
            const spt_pass *right = &expected->passes[i];
            CHECK_SAY((uint64_t)passes[i].numerator * right->denominator ==
                          (uint64_t)passes[i].denominator * right->numerator,
                      "%zu passes: pass %zu is %u / %u", count, i, passes[i].numerator,
                      passes[i].denominator);
            CHECK(check_same_bits(passes[i].share, right->share)); /* eighths are exact */
            sum += (double)passes[i].share;
        }
        CHECK(fabs(sum - 1) < 1e-9);
    }
    CHECK(spt_passes((size_t)-1) == NULL);
}

static void find_truths(const view *v) {
    const truth_field field = truth_of_scene(v->shown);
    frame_rays(&v->frame, rays);
    for (size_t i = 0; i < frame_pixels(&v->frame); ++i) {
        truths[i] = truth_walk(&field, &v->frame.settings, &rays[i].ray, 0);
    }
}

static truth_sum judge(const view *v, const spt_hit *results, const char *what) {
    const truth_field field = truth_of_scene(v->shown);
    truth_sum sum = {0, 0, 0, 0, 0, 0, 0};
    for (size_t i = 0; i < frame_pixels(&v->frame); ++i) {
        const int judgement =
            truth_judge(&field, &v->frame.settings, &rays[i].ray, 0, &truths[i], &results[i]);
        truth_count(&sum, &truths[i], &results[i], judgement);
        CHECK_SAY(judgement == TRUTH_AGREES,
                  "%s: pixel %g %g: outcome %d at %.9g; zero %.9g, deep %.9g, through %.9g", what,
                  frame_x(&v->frame, i), frame_y(&v->frame, i), results[i].outcome,
                  (double)results[i].t, truths[i].zero, truths[i].deep, truths[i].through);
    }
    return sum;
}

/* The same schedule with next to nothing left for the last pass: its rays end at their start. */
static void judge_starts(view *v, const schedule *which, double *ratio, uint64_t *count) {
    schedule starved = *which;
    advance a;
    starved.passes[starved.count - 1].share = 1e-6f;
    schedule_set(&v->frame, &starved);
    a = advance_begin(&v->frame, 0, hits);
    advance_finish(&a, 1u << 20);
    (void)judge(v, hits, "start");
    for (size_t i = 0; i < frame_pixels(&v->frame); ++i) {
        if (!(truths[i].zero < HUGE_VAL)) continue;
        CHECK(hits[i].evaluations <= 1);
        if (hits[i].outcome == SPT_LIMIT) *ratio += (double)hits[i].t / truths[i].zero;
        *ratio += hits[i].outcome == SPT_HIT;
        ++*count;
    }
}

/* All schedules; the coarse pictures of one of them. */
static void check_schedules(view *v, int coarse, truth_sum *total, double *ratio, uint64_t *count) {
    const truth_field field = truth_of_scene(v->shown);
    for (int i = 0; i < schedule_count; ++i) {
        advance a;
        truth_sum sum;
        schedule_set(&v->frame, &schedules[i]);
        if (i == coarse) shade_log_open(&seen, &v->frame, &field);
        a = advance_begin(&v->frame, 0, hits);
        advance_finish(&a, 1u << 20);
        sum = judge(v, hits, schedules[i].name);
        total->due += sum.due;
        total->found += sum.found;
        if (i == coarse) {
            CHECK_SAY(seen.faults == 0, "schedule %s: %zu faults of shading", schedules[i].name,
                      seen.faults);
            CHECK_SAY(seen.wrong == 0, "schedule %s: %zu of %zu coarse rays wrong",
                      schedules[i].name, seen.wrong, seen.judged);
            CHECK(seen.level == (int)schedules[i].count - 1);
            CHECK(seen.levels[seen.level].count == frame_pixels(&v->frame));
            v->frame.shade = NULL;
        }
        if (schedules[i].count > 1) judge_starts(v, &schedules[i], ratio, count);
    }
}

static void check_scenes(int first, int step) {
    static const uint32_t shapes[][2] = {{18, 12}, {9, 17}, {3, 30}, {30, 3},
                                         {1, 1},   {7, 5},  {2, 1}};
    static const double degrees[] = {20, 50, 90, 120, 150};
    truth_sum total = {0, 0, 0, 0, 0, 0, 0};
    double ratio = 0;
    uint64_t count = 0;
    for (size_t i = (size_t)first; i < scene_count; i += (size_t)step) {
        for (size_t j = 0; j < 5; ++j) {
            const uint32_t *shape = shapes[(i + j) % (sizeof shapes / sizeof shapes[0])];
            const scene_grain grain = j % 2 == 0 ? SCENE_OBJECTS : SCENE_WHOLE;
            view_of(&shown_view, scenes[i], grain, degrees[j], shape[0], shape[1]);
            check_context("%s, %g degrees, %ux%u", scenes[i]->name, degrees[j], shape[0], shape[1]);
            find_truths(&shown_view);
            check_schedules(&shown_view, (int)(i + j) % schedule_count, &total, &ratio, &count);
        }
    }
    check_context("all scenes");
    CHECK_SAY(total.found * 100 >= total.due * 98, "%.0f of %.0f found", (double)total.found,
              (double)total.due);
    CHECK_SAY(ratio > 0.5 * (double)count, "starts at %g of the way", ratio / (double)count);
}

static void frame_passes_scenes_even(void) {
    check_scenes(0, 2);
}

static void frame_passes_scenes_odd(void) {
    check_scenes(1, 2);
}

/* A single pass is what the tiles give. */
static void frame_passes_one_is_the_frame(void) {
    for (size_t i = 0; i < scene_count; ++i) {
        advance a;
        view_of(&shown_view, scenes[i], SCENE_OBJECTS, 60, 34, 26);
        check_context("%s", scenes[i]->name);
        frame_trace(&shown_view.frame, 0, others);
        for (int given = 0; given < 2; ++given) {
            if (given != 0) schedule_set(&shown_view.frame, &schedules[0]);
            a = advance_begin(&shown_view.frame, 0, hits);
            advance_finish(&a, 1u << 30);
            frame_same(&shown_view.frame, hits, others, "one pass");
        }
    }
}

/* Coarse passes trace their rays only where somebody colours them, and the last pass has the same
 * bits either way: their cones are the same. */
static void frame_passes_unseen(void) {
    for (size_t i = 0; i < scene_count; ++i) {
        for (int j = 0; j < schedule_count; ++j) {
            uint64_t every = 0;
            advance unseen, shaded;
            view_of(&shown_view, scenes[i], SCENE_OBJECTS, 60, 34, 26);
            schedule_set(&shown_view.frame, &schedules[j]);
            check_context("%s, schedule %s", scenes[i]->name, schedules[j].name);
            for (size_t pass = 0; pass < schedules[j].count; ++pass) {
                every += (uint64_t)schedule_size(34, &schedules[j].passes[pass]) *
                         schedule_size(26, &schedules[j].passes[pass]);
            }
            unseen = advance_begin(&shown_view.frame, 0, others);
            advance_finish(&unseen, 1u << 30);
            shade_log_open(&seen, &shown_view.frame, NULL);
            shaded = advance_begin(&shown_view.frame, 0, hits);
            advance_finish(&shaded, 1u << 30);
            frame_same(&shown_view.frame, hits, others, "unseen passes");
            CHECK_SAY(unseen.rays == 34 * 26, "%lu rays", (unsigned long)unseen.rays);
            CHECK_SAY(shaded.rays == every, "%lu rays", (unsigned long)shaded.rays);
            CHECK(shaded.cones == unseen.cones);
        }
    }
}

/* A window of a large image: the same pixels as the frame finds, by the answer. */
static void frame_passes_window(void) {
    static const char *const names[] = {"primitives", "village", "thin_torus", "mandelbulb"};
    for (size_t i = 0; i < 4; ++i) {
        const truth_field field = truth_of_scene(scene_named(names[i]));
        view_of(&shown_view, scene_named(names[i]), SCENE_OBJECTS, 55, 1921, 1081);
        view_window(&shown_view.frame, 950, 520, 984, 546);
        frame_rays(&shown_view.frame, rays);
        for (size_t pixel = 0; pixel < most_pixels; ++pixel) {
            truths[pixel] = truth_walk(&field, &shown_view.frame.settings, &rays[pixel].ray, 0);
        }
        for (int j = 0; j < schedule_count; ++j) {
            advance a;
            schedule_set(&shown_view.frame, &schedules[j]);
            frame_lend_workspace(&shown_view.frame);
            check_context("%s, schedule %s", names[i], schedules[j].name);
            a = advance_begin(&shown_view.frame, 0, hits);
            advance_finish(&a, 100000);
            (void)judge(&shown_view, hits, "window");
        }
    }
}

/* ---- Cameras other than the pinhole in the middle ------------------------------------------ */

static void judge_balls(spt_frame *frame, const ball_scene *balls, const char *what) {
    const truth_field field = ball_scene_truth(balls);
    for (size_t i = 0; i < frame_pixels(frame); ++i) {
        CHECK_SAY(truth_judge(&field, &frame->settings, &rays[i].ray, 0, &truths[i], &hits[i]) ==
                      TRUTH_AGREES,
                  "%s: pixel %zu: outcome %d at %.9g; zero %.9g, deep %.9g", what, i,
                  hits[i].outcome, (double)hits[i].t, truths[i].zero, truths[i].deep);
    }
}

static void check_balls(const spt_camera *camera, uint32_t width, uint32_t height) {
    const world shape = world_draw();
    ball_scene balls;
    const truth_field field = ball_scene_truth(&balls);
    spt_frame frame;
    ball_scene_draw(&balls, &shape);
    CHECK(spt_frame_init(&frame, &balls.scene, camera, width, height) == SPT_OK);
    frame.settings.epsilon = 1e-4f;
    frame.settings.budget = 1000;
    frame_lend_workspace(&frame);
    frame_rays(&frame, rays);
    for (size_t i = 0; i < frame_pixels(&frame); ++i) {
        truths[i] = truth_walk(&field, &frame.settings, &rays[i].ray, 0);
    }
    for (int i = 0; i < schedule_count; ++i) {
        schedule starved = schedules[i];
        advance a;
        schedule_set(&frame, &schedules[i]);
        a = advance_begin(&frame, 0, hits);
        advance_finish(&a, 1u << 20);
        judge_balls(&frame, &balls, schedules[i].name);
        starved.passes[starved.count - 1].share = 1e-6f;
        schedule_set(&frame, &starved);
        a = advance_begin(&frame, 0, hits);
        advance_finish(&a, 1u << 20);
        judge_balls(&frame, &balls, "start");
    }
}

/* Off-axis, mirrored, skewed and parallel cameras, and those of the caller's rays, of which a coarse
 * pixel knows nothing but the rays it asks for. */
static void Q15_passes_of_any_camera(void) {
    static const uint32_t sizes[][2] = {{18, 13}, {7, 19}, {26, 5}};
    const double eye[3] = {0, 0, 0}, target[3] = {0, 0, 8};
    for (int i = 0; i < 30; ++i) {
        const uint32_t *size = sizes[i % 3];
        const uint32_t variant = check_random() % CAMERA_VARIANTS;
        const int kind = i % 3 == 0 ? SPT_CAMERA_ORTHOGRAPHIC : SPT_CAMERA_PINHOLE;
        const double tangent = i % 3 == 0 ? check_uniform(0.2, 0.6) : exp(check_uniform(-2, 1.3));
        spt_camera camera =
            camera_draw((spt_camera_kind)kind, variant, eye, target, 0.5, tangent, 1.2);
        lens user;
        camera.t_max = 50;
        if (i % 5 == 4) camera = lens_camera(&user, i % 2, size[0], size[1]);
        check_context("world %d, camera %u, variant %u", i, camera.kind, variant);
        check_balls(&camera, size[0], size[1]);
    }
}

void suite_frame_passes(void) {
    RUN(frame_passes_tables);
    RUN(frame_passes_scenes_even);
    RUN(frame_passes_scenes_odd);
    RUN(frame_passes_one_is_the_frame);
    RUN(frame_passes_unseen);
    RUN(frame_passes_window);
    RUN(Q15_passes_of_any_camera);
}
