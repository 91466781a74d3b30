/* SPDX-License-Identifier: MIT
 *
 * Progressive frames are the same bits however they are interrupted, and begin anew when they must
 * and only then. */
#include "frame_advance.h"
#include "frame_worlds.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { side_x = 21, side_y = 14, pixels = side_x * side_y };

static view shown_view;
static spt_hit whole[4 * pixels], hits[4 * pixels];
static float whole_picture[pixels * log_channels], picture[pixels * log_channels];
static shade_log seen;

static void take_picture(const advance *a, float *to) {
    const spt_sink sink = {to, log_channels * sizeof *to};
    const spt_status status = spt_frame_picture(a->frame, a->state, a->size, &sink);
    CHECK_SAY(status == SPT_OK, "picture: %s", spt_status_name(status));
}

static void open_view(const char *name, const schedule *which) {
    view_of(&shown_view, scene_named(name), SCENE_OBJECTS, 60, side_x, side_y);
    shown_view.frame.settings.budget = 200;
    schedule_set(&shown_view.frame, which);
    shade_log_open(&seen, &shown_view.frame, NULL);
}

static void run_whole(void) {
    advance a = advance_begin(&shown_view.frame, 0, whole);
    advance_finish(&a, UINT64_MAX / 2);
    take_picture(&a, whole_picture);
    shade_log_open(&seen, &shown_view.frame, NULL);
}

static void run_in_steps(uint64_t evaluations, const char *what) {
    advance a = advance_begin(&shown_view.frame, 0, hits);
    advance_finish(&a, evaluations);
    take_picture(&a, picture);
    frame_same(&shown_view.frame, hits, whole, what);
    CHECK_SAY(memcmp(picture, whole_picture, sizeof picture) == 0, "%s: another picture", what);
    CHECK_SAY(seen.faults == 0, "%s: %zu faults of shading", what, seen.faults);
    shade_log_open(&seen, &shown_view.frame, NULL);
}

/* After every 1, 2, .. 50 evaluations a ray. */
static void frame_interrupted_same_bits(void) {
    static const char *const names[] = {"primitives", "village", "mandelbulb", "slabs"};
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < schedule_count; ++j) {
            open_view(names[i], &schedules[j]);
            check_context("%s, schedule %s", names[i], schedules[j].name);
            run_whole();
            for (uint64_t each = 1 + (uint64_t)(i + j) % 4; each <= 50; each += 4) {
                char what[32];
                snprintf(what, sizeof what, "by %d a ray", (int)each);
                run_in_steps(each * pixels, what);
            }
        }
    }
}

/* Over the borders of tiles, with the results of a region that crosses them. */
static void frame_interrupted_across_tiles(void) {
    enum { wide = 72, high = 16 };
    static spt_hit all[wide * high], some[wide * high];
    for (int i = 0; i < schedule_count; ++i) {
        advance a;
        view_of(&shown_view, scene_named("arches"), SCENE_OBJECTS, 60, 150, 131);
        view_window(&shown_view.frame, 50, 56, 50 + wide, 56 + high);
        schedule_set(&shown_view.frame, &schedules[i]);
        frame_lend_workspace(&shown_view.frame);
        check_context("schedule %s", schedules[i].name);
        a = advance_begin(&shown_view.frame, 0, all);
        advance_finish(&a, UINT64_MAX / 2);
        for (uint64_t each = 500; each < 60000; each *= 5) {
            a = advance_begin(&shown_view.frame, 0, some);
            advance_finish(&a, each);
            frame_same(&shown_view.frame, some, all, "across tiles");
        }
    }
}

/* Every scene, by one evaluation at a time, which is a batch: in the middle of every chunk. */
static void frame_interrupted_every_batch(void) {
    for (size_t i = 0; i < scene_count; ++i) {
        const schedule *which = &schedules[i % (size_t)schedule_count];
        open_view(scenes[i]->name, which);
        check_context("%s, schedule %s", scenes[i]->name, which->name);
        run_whole();
        run_in_steps(1, "by a batch");
    }
}

/* Steps of random length, and another frame traced by the same workspace in between. */
static void frame_interrupted_between_others(void) {
    static view other;
    static spt_hit other_hits[pixels];
    for (int i = 0; i < schedule_count; ++i) {
        advance a;
        int turns = 0;
        open_view("primitives", &schedules[i]);
        check_context("schedule %s", schedules[i].name);
        run_whole();
        view_of(&other, scene_named("primitives"), SCENE_WHOLE, 40, side_x, side_y);
        other.frame.workspace = shown_view.frame.workspace;
        other.frame.workspace_size = shown_view.frame.workspace_size;
        frame_lend_workspace(&shown_view.frame);
        other.frame.workspace = shown_view.frame.workspace;
        other.frame.workspace_size = shown_view.frame.workspace_size;
        a = advance_begin(&shown_view.frame, 0, hits);
        while (!advance_finished(&a) && turns++ < 100000) {
            advance_step(&a, 1 + check_random() % 2000);
            if (turns % 4 == 0) frame_trace(&other.frame, 0, other_hits);
            memset(shown_view.frame.workspace, 0xff, shown_view.frame.workspace_size);
        }
        frame_same(&shown_view.frame, hits, whole, "between others");
    }
}

/* Widths, and a part of an image against the whole. */
static void frame_interrupted_widths_and_regions(void) {
    for (int i = 0; i < schedule_count; ++i) {
        static const uint32_t regions[][4] = {{0, 0, 1, 1}, {5, 3, 17, 13}, {20, 13, 21, 14}};
        open_view("village", &schedules[i]);
        run_whole();
        for (int width = 0; width < width_count; ++width) {
            check_context("schedule %s, width %u", schedules[i].name, widths[width]);
            shown_view.frame.settings.max_lanes = widths[width];
            frame_lend_workspace(&shown_view.frame);
            run_in_steps(1000, "width");
        }
        shown_view.frame.settings.max_lanes = 0;
        shown_view.frame.shade = NULL;
        for (int j = 0; j < 3; ++j) {
            const uint32_t *r = regions[j];
            advance a;
            view_window(&shown_view.frame, r[0], r[1], r[2], r[3]);
            frame_lend_workspace(&shown_view.frame);
            check_context("schedule %s, region %d", schedules[i].name, j);
            a = advance_begin(&shown_view.frame, 0, hits);
            advance_finish(&a, 777);
            for (size_t k = 0; k < frame_pixels(&shown_view.frame); ++k) {
                const size_t x = (size_t)frame_x(&shown_view.frame, k);
                const size_t y = (size_t)frame_y(&shown_view.frame, k);
                CHECK_SAY(oracle_same_hit(&hits[k], &whole[y * side_x + x]),
                          "pixel %zu %zu: t %.9g evaluations %u, whole %.9g %u", x, y,
                          (double)hits[k].t, hits[k].evaluations, (double)whole[y * side_x + x].t,
                          whole[y * side_x + x].evaluations);
            }
        }
    }
}

/* ---- Beginning anew ------------------------------------------------------------------------ */

static void change_nothing(view *v) {
    (void)v;
}
static void change_eye(view *v) {
    v->camera.eye[1] += 0.25f;
}
static void change_window(view *v) {
    v->camera.x_high *= 1.5f;
}
static void change_t_max(view *v) {
    v->camera.t_max *= 0.75f;
}
static void change_epsilon(view *v) {
    v->frame.settings.epsilon *= 4;
}
static void change_budget(view *v) {
    v->frame.settings.budget = 90;
}
static void change_method(view *v) {
    v->frame.settings.method = spt_relaxed();
}
static void change_size(view *v) {
    v->frame.width -= 2;
    v->frame.right -= 2;
}
static void change_region(view *v) {
    v->frame.left += 1;
}
static void change_passes(view *v) {
    schedule_set(&v->frame, &schedules[1]);
}
static void change_flags(view *v) {
    v->frame.flags = SPT_FRAME_NO_CONES;
}

typedef struct change {
    const char *name;
    void (*make)(view *);
} change;
static const change changes[] = {
    {"nothing", change_nothing}, {"eye", change_eye},         {"window", change_window},
    {"t_max", change_t_max},     {"epsilon", change_epsilon}, {"budget", change_budget},
    {"method", change_method},   {"size", change_size},       {"region", change_region},
    {"passes", change_passes},   {"flags", change_flags},
};

/* In the middle of a pass, at the end of one, and when all is finished. */
static void check_change(const change *what, uint64_t evaluations) {
    view *v = &shown_view;
    const int none = what->make == change_nothing;
    const spt_hits sinks = spt_hits_of(hits);
    spt_frame_progress progress;
    advance a, fresh;
    open_view("primitives", &schedules[2]);
    v->frame.shade = NULL;
    a = advance_begin(&v->frame, 0, hits);
    advance_step(&a, evaluations);
    what->make(v);
    frame_lend_workspace(&v->frame);
    frame_blank(pixels, hits);
    check_context("%s changed after %.0f evaluations", what->name, (double)evaluations);
    CHECK(spt_frame_advance(&v->frame, a.state, a.size, 1, &sinks, &progress) == SPT_OK);
    CHECK_SAY(progress.restarted == (none ? 0 : 1), "restarted %u", progress.restarted);
    if (none) return;
    a.progress = progress;
    advance_finish(&a, 5000);
    fresh = advance_begin(&v->frame, 1, whole);
    advance_finish(&fresh, UINT64_MAX / 2);
    frame_same(&v->frame, hits, whole, "anew");
    CHECK(a.progress.evaluations == fresh.progress.evaluations);
}

static void frame_interrupted_begins_anew(void) {
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; ++i) {
        check_change(&changes[i], 1);
        check_change(&changes[i], 2500);
        check_change(&changes[i], UINT64_MAX / 2);
    }
}

/* A field that answers differently without the frame showing it: only spt_frame_restart() helps. */
static float growing_ball(void *user, float x, float y, float z) {
    const float *radius = user;
    return sqrtf(x * x + y * y + z * z) - *radius;
}

static void frame_interrupted_restart(void) {
    const float eye[3] = {0, 0, 5}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    float radius = 1;
    spt_field field = spt_field_default();
    spt_scene balls = spt_scene_default();
    spt_camera camera;
    spt_frame frame;
    advance a;
    field.point = growing_ball;
    field.user = &radius;
    balls.fields = &field;
    balls.count = 1;
    CHECK(spt_camera_pinhole(&camera, eye, target, up, 0.5f, side_x, side_y) == SPT_OK);
    CHECK(spt_frame_init(&frame, &balls, &camera, side_x, side_y) == SPT_OK);
    schedule_set(&frame, &schedules[3]);
    frame_lend_workspace(&frame);
    a = advance_begin(&frame, 0, hits);
    advance_step(&a, 700);
    radius = 2;
    a = advance_begin(&frame, 0, hits);
    CHECK(!advance_finished(&a));
    advance_finish(&a, 700);
    a = advance_begin(&frame, 0, whole);
    advance_finish(&a, UINT64_MAX / 2);
    frame_same(&frame, hits, whole, "restarted");
    /* The middle pixel sees the ball of radius 2, at 3, within half a pixel at 3. */
    CHECK_SAY(fabs((double)hits[side_y / 2 * side_x + side_x / 2].t - 3) < 0.2, "t %g",
              (double)hits[side_y / 2 * side_x + side_x / 2].t);
}

/* A finished frame stays as it is. */
static void frame_interrupted_after_the_end(void) {
    uint64_t spent;
    advance a;
    open_view("slabs", &schedules[3]);
    run_whole();
    a = advance_begin(&shown_view.frame, 0, hits);
    advance_finish(&a, 999);
    spent = a.progress.evaluations;
    for (int i = 0; i < 3; ++i) advance_step(&a, 1000);
    CHECK(a.progress.evaluations == spent && advance_finished(&a));
    frame_same(&shown_view.frame, hits, whole, "after the end");
    take_picture(&a, picture);
    CHECK(memcmp(picture, whole_picture, sizeof picture) == 0);
}

/* What progress counts is what the statistics count, which advance_step() looks at; of that the
 * hits show what the last pass spent on rays. The count does not depend on the division. */
static void frame_interrupted_counts(void) {
    for (int i = 0; i < schedule_count; ++i) {
        uint64_t last_pass = 0, all;
        advance a;
        open_view("primitives", &schedules[i]);
        check_context("schedule %s", schedules[i].name);
        a = advance_begin(&shown_view.frame, 0, hits);
        advance_finish(&a, UINT64_MAX / 2);
        all = a.progress.evaluations;
        shade_log_open(&seen, &shown_view.frame, NULL);
        a = advance_begin(&shown_view.frame, 0, hits);
        advance_finish(&a, 300);
        CHECK_SAY(a.progress.evaluations == all, "%.0f by 300, %.0f at once",
                  (double)a.progress.evaluations, (double)all);
        for (int pixel = 0; pixel < pixels; ++pixel) last_pass += hits[pixel].evaluations;
        CHECK(last_pass <= all - a.cones && a.cones > 0);
        CHECK(schedules[i].count > 1 || last_pass == all - a.cones);
    }
}

void suite_frame_interrupted(void) {
    RUN(frame_interrupted_same_bits);
    RUN(frame_interrupted_across_tiles);
    RUN(frame_interrupted_every_batch);
    RUN(frame_interrupted_between_others);
    RUN(frame_interrupted_widths_and_regions);
    RUN(frame_interrupted_begins_anew);
    RUN(frame_interrupted_restart);
    RUN(frame_interrupted_after_the_end);
    RUN(frame_interrupted_counts);
}
