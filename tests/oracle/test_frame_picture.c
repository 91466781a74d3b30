/* SPDX-License-Identifier: MIT
 *
 * The picture of a progressive frame at every stage, rebuilt in double from the colours that the
 * shade callback gave; and frames that are advanced by a clock. */
#include "frame_advance.h"
#include "../check.h"

#include <math.h>
#include <string.h>

enum { most_pixels = 96 * 96, slow_side = 96 };

static view shown_view;
static spt_hit hits[most_pixels], whole[most_pixels];
static float picture[most_pixels * (log_channels + 1)];
static shade_log seen;

/* Two neighbours in a coarse row or column, and the weight of the second. wide: others that may be
 * asked for instead, because the place is a middle but for rounding. */
typedef struct neighbours {
    int first, second, wide_first, wide_second;
    double weight;
} neighbours;

static int clamped(double index, uint32_t count) {
    return (int)fmin(fmax(index, 0), (double)count - 1);
}

static neighbours neighbours_of(double pixel, uint32_t full, uint32_t count) {
    const double place = pixel * (double)count / (double)full - 0.5, nearest = floor(place + 0.5);
    neighbours n;
    n.first = clamped(floor(place), count);
    n.second = clamped(floor(place) + 1, count);
    n.weight = place - floor(place);
    n.wide_first = n.first;
    n.wide_second = n.second;
    if (fabs(place - nearest) < 1e-4) {
        n.first = n.second = clamped(nearest, count);
        n.wide_first = clamped(nearest - 1, count);
        n.wide_second = clamped(nearest + 1, count);
        n.weight = 0;
    }
    return n;
}

static int all_known(const log_level *level, int left, int right, int top, int bottom) {
    for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
            if (!level->known[(size_t)y * level->width + (size_t)x]) return 0;
        }
    }
    return 1;
}

static double bilinear(const log_level *level, const neighbours *x, const neighbours *y,
                       int channel) {
    const float *colour = level->colour + channel;
    const size_t width = level->width;
    const double a = (double)colour[log_channels * ((size_t)y->first * width + (size_t)x->first)];
    const double b = (double)colour[log_channels * ((size_t)y->first * width + (size_t)x->second)];
    const double c = (double)colour[log_channels * ((size_t)y->second * width + (size_t)x->first)];
    const double d = (double)colour[log_channels * ((size_t)y->second * width + (size_t)x->second)];
    const double above = a + x->weight * (b - a), below = c + x->weight * (d - c);
    return above + y->weight * (below - above);
}

/* The colour of a pixel is that of the finest pass known around it. Where it is on a coarse pixel's
 * middle but for rounding, a pass is certainly, or only perhaps, that one: then a coarser one may
 * stand in. Colours lie in [0, 2]; the weight is off by the rounding of a place among `width`
 * columns, and four products are summed. */
static int is_colour(const shade_log *log, double x, double y, const float *given) {
    const spt_frame *frame = log->frame;
    for (int i = log->level; i >= -1; --i) {
        const log_level *level = &log->levels[i < 0 ? 0 : i];
        const double off =
            i == (int)frame->pass_count - 1
                ? 0
                : 2 * 0x1p-24 * (16 + 4 * (double)level->width + 4 * (double)level->height);
        const neighbours u = neighbours_of(x, frame->width, level->width);
        const neighbours v = neighbours_of(y, frame->height, level->height);
        int equal = 1;
        if (i >= 0 && !all_known(level, u.first, u.second, v.first, v.second)) continue;
        for (int channel = 0; channel < log_channels; ++channel) {
            const double truth = i < 0 ? 0 : bilinear(level, &u, &v, channel);
            equal &= fabs((double)given[channel] - truth) <= off;
        }
        if (equal) return 1;
        /* Certainly this one, unless it only perhaps is. */
        if (i < 0 || i == (int)frame->pass_count - 1 ||
            all_known(level, u.wide_first, u.wide_second, v.wide_first, v.wide_second)) {
            return 0;
        }
    }
    return 0;
}

/* Sinks may leave gaps between pixels. */
static void check_picture(const advance *a, const shade_log *log) {
    enum { stride = log_channels + 1 };
    const spt_sink sink = {picture, stride * sizeof *picture};
    const size_t pixels = frame_pixels(a->frame);
    size_t wrong = 0;
    for (size_t i = 0; i < pixels * stride; ++i) picture[i] = 77;
    CHECK(spt_frame_picture(a->frame, a->state, a->size, &sink) == SPT_OK);
    for (size_t i = 0; i < pixels; ++i) {
        const float *given = &picture[i * stride];
        const int right = is_colour(log, frame_x(a->frame, i), frame_y(a->frame, i), given);
        wrong += !right;
        CHECK_SAY(right, "pass %u, %.0f done: pixel %g %g is %g %g %g", a->progress.pass,
                  (double)a->progress.pixels, frame_x(a->frame, i), frame_y(a->frame, i),
                  (double)given[0], (double)given[1], (double)given[2]);
        CHECK(check_same_bits(given[log_channels], 77));
    }
    CHECK(wrong == 0);
}

static void check_stages(uint32_t width, uint32_t height, const schedule *which, const char *name,
                         uint64_t each) {
    advance a;
    int stages = 0, passes_seen = 0;
    uint32_t pass = UINT32_MAX;
    view_of(&shown_view, scene_named(name), SCENE_OBJECTS, 60, width, height);
    schedule_set(&shown_view.frame, which);
    shade_log_open(&seen, &shown_view.frame, NULL);
    check_context("%s, %ux%u, schedule %s", name, width, height, which->name);
    a = advance_begin(&shown_view.frame, 0, hits);
    check_picture(&a, &seen); /* nothing yet: all 0 */
    while (!advance_finished(&a) && stages++ < 10000) {
        advance_step(&a, each);
        passes_seen += a.progress.pass != pass;
        pass = a.progress.pass;
        check_picture(&a, &seen);
    }
    CHECK(advance_finished(&a) && seen.faults == 0);
    /* It was looked at in the middle of passes. */
    CHECK_SAY(width * height < 1000 || stages > passes_seen, "%d stages of %d passes", stages,
              passes_seen);
    CHECK(seen.levels[which->count - 1].count == frame_pixels(&shown_view.frame));
}

/* Of falling resolutions the finest is not the last: the header speaks of rising ones. */
static int is_rising(const schedule *which) {
    for (size_t i = 1; i < which->count; ++i) {
        const spt_pass *a = &which->passes[i - 1], *b = &which->passes[i];
        if ((uint64_t)a->numerator * b->denominator > (uint64_t)b->numerator * a->denominator) {
            return 0;
        }
    }
    return 1;
}

static void frame_picture_stages(void) {
    for (int i = 0; i < schedule_count; ++i) {
        if (!is_rising(&schedules[i])) continue;
        check_stages(48, 40, &schedules[i], "primitives", 1000);
        check_stages(37, 29, &schedules[i], "village", 700);
        check_stages(5, 33, &schedules[i], "slabs", 1);
    }
}

/* By a batch at a time, in images smaller than a chunk. */
static void frame_picture_tiny(void) {
    static const uint32_t sizes[][2] = {{1, 1}, {2, 1}, {1, 3}, {7, 5}, {17, 3}};
    for (int i = 0; i < schedule_count; ++i) {
        for (int j = 0; j < 5 && is_rising(&schedules[i]); ++j) {
            check_stages(sizes[j][0], sizes[j][1], &schedules[i], "sphere", 1);
        }
    }
}

/* At the end every pixel has the colour of its own hit, which is what the tiles find where there is
 * one pass. */
static void frame_picture_of_hits(void) {
    const spt_sink sink = {picture, log_channels * sizeof *picture};
    advance a;
    view_of(&shown_view, scene_named("primitives"), SCENE_OBJECTS, 60, 48, 40);
    frame_trace(&shown_view.frame, 0, whole);
    schedule_set(&shown_view.frame, &schedules[0]);
    shade_log_open(&seen, &shown_view.frame, NULL);
    a = advance_begin(&shown_view.frame, 0, NULL);
    advance_finish(&a, 12345);
    CHECK(spt_frame_picture(&shown_view.frame, a.state, a.size, &sink) == SPT_OK);
    for (size_t i = 0; i < 48 * 40; ++i) {
        const float expected = whole[i].outcome == SPT_HIT ? 1 / (1 + whole[i].t) : 2;
        CHECK_SAY(check_same_bits(picture[i * log_channels + 2], expected), "pixel %zu: %g, %g", i,
                  (double)picture[i * log_channels + 2], (double)expected);
        CHECK(check_same_bits(picture[i * log_channels], (float)frame_x(a.frame, i) / 48));
    }
}

static void frame_picture_refuses(void) {
    static float blank_picture[most_pixels * log_channels];
    const spt_sink sink = {picture, log_channels * sizeof *picture}, none = {NULL, 4};
    const spt_sink flat = {picture, 0};
    spt_frame *frame = &shown_view.frame;
    advance a;
    float eye;
    view_of(&shown_view, scene_named("sphere"), SCENE_OBJECTS, 60, 30, 20);
    schedule_set(frame, &schedules[1]);
    shade_log_open(&seen, frame, NULL);
    a = advance_begin(frame, 0, hits);
    advance_step(&a, 500);
    memset(picture, 0, sizeof picture);
    frame->shade = NULL;
    CHECK(spt_frame_picture(frame, a.state, a.size, &sink) == SPT_BAD_ARGUMENT);
    frame->shade = shade_log_fn;
    CHECK(spt_frame_picture(NULL, a.state, a.size, &sink) == SPT_BAD_ARGUMENT);
    CHECK(spt_frame_picture(frame, NULL, a.size, &sink) == SPT_BAD_ARGUMENT);
    CHECK(spt_frame_picture(frame, a.state, a.size, NULL) == SPT_BAD_ARGUMENT);
    CHECK(spt_frame_picture(frame, a.state, a.size, &none) == SPT_BAD_ARGUMENT);
    CHECK(spt_frame_picture(frame, a.state, a.size, &flat) == SPT_BAD_ARGUMENT);
    CHECK(spt_frame_picture(frame, a.state, a.size - 1, &sink) != SPT_OK);
    eye = shown_view.camera.eye[0];
    shown_view.camera.eye[0] += 1; /* another frame than the state's */
    CHECK(spt_frame_picture(frame, a.state, a.size, &sink) == SPT_BAD_ARGUMENT);
    shown_view.camera.eye[0] = eye;
    CHECK(memcmp(picture, blank_picture, sizeof blank_picture) == 0);
    CHECK(spt_frame_picture(frame, a.state, a.size, &sink) == SPT_OK);
}

/* ---- By a clock ---------------------------------------------------------------------------- */

/* A ball whose evaluations are the only thing that takes time. */
typedef struct slow_ball {
    double nanoseconds, passed; /* for each point, padding too */
    int stopped;
} slow_ball;

static void slow_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                       float *distance) {
    slow_ball *ball = user;
    ball->passed += 1e-9 * ball->nanoseconds * (double)n;
    for (size_t i = 0; i < n; ++i) {
        distance[i] = sqrtf(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]) - 1;
    }
}

static double slow_clock(void *user) {
    const slow_ball *ball = user;
    return ball->stopped ? 3 : ball->passed;
}

typedef struct slow_case {
    slow_ball ball;
    spt_field field;
    spt_scene scene;
    spt_camera camera;
    spt_frame frame;
} slow_case;

static void open_slow(slow_case *c, double nanoseconds) {
    const float eye[3] = {0, 0, 5}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    memset(&c->ball, 0, sizeof c->ball);
    c->ball.nanoseconds = nanoseconds;
    c->field = spt_field_default();
    c->field.batch = slow_batch;
    c->field.user = &c->ball;
    c->scene = spt_scene_default();
    c->scene.fields = &c->field;
    c->scene.count = 1;
    CHECK(spt_camera_pinhole(&c->camera, eye, target, up, 0.5f, slow_side, slow_side) == SPT_OK);
    CHECK(spt_frame_init(&c->frame, &c->scene, &c->camera, slow_side, slow_side) == SPT_OK);
    schedule_set(&c->frame, &schedules[2]);
    frame_lend_workspace(&c->frame);
}

/* About a given time a call, whatever an evaluation takes. How full its batches are changes from
 * cones to rays and from the first rays of a chunk to its last, so what an evaluation took so far
 * is within a factor of four of what it takes next; and there is the last batch. */
static void frame_picture_by_a_clock(void) {
    static const double costs[] = {1, 30, 2000};
    for (int i = 0; i < 3; ++i) {
        const spt_hits sinks = spt_hits_of(hits);
        const double wanted = 8e-9 * SPT_BATCH * costs[i];
        slow_case c;
        advance a;
        int calls = 0;
        double before = 0;
        open_slow(&c, costs[i]);
        check_context("%g ns an evaluation", costs[i]);
        a = advance_begin(&c.frame, 1, whole);
        advance_finish(&a, UINT64_MAX / 2);
        a = advance_begin(&c.frame, 0, hits);
        c.ball.passed = 0;
        while (!advance_finished(&a) && calls < 10000) {
            double took;
            before = c.ball.passed;
            CHECK(spt_frame_advance_for(&c.frame, a.state, a.size, wanted, slow_clock, &c.ball,
                                        &sinks, &a.progress) == SPT_OK);
            took = c.ball.passed - before;
            ++calls;
            CHECK_SAY(took <= 4 * wanted + 1e-9 * SPT_BATCH * costs[i], "call %d took %g for %g",
                      calls, took, wanted);
            CHECK_SAY(took >= wanted / 4 || advance_finished(&a), "call %d took %g for %g", calls,
                      took, wanted);
        }
        CHECK(calls > 4);
        frame_same(&c.frame, hits, whole, "by a clock");
    }
}

/* A clock that stands still over 2^16 evaluations ends the call, and the frame can go on by counts.
 * Here nothing is hit, so that there are more. */
static void frame_picture_by_a_stopped_clock(void) {
    const spt_hits sinks = spt_hits_of(hits);
    slow_case c;
    advance a;
    open_slow(&c, 10);
    c.camera.eye[0] = 1.5f;
    c.frame.flags = SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING;
    a = advance_begin(&c.frame, 1, whole);
    advance_finish(&a, UINT64_MAX / 2);
    CHECK_SAY(a.progress.evaluations > 1u << 17, "%.0f in all", (double)a.progress.evaluations);
    a = advance_begin(&c.frame, 0, hits);
    c.ball.stopped = 1;
    CHECK(spt_frame_advance_for(&c.frame, a.state, a.size, 1e9, slow_clock, &c.ball, &sinks,
                                NULL) == SPT_UNSUPPORTED);
    CHECK(spt_frame_advance(&c.frame, a.state, a.size, 1, &sinks, &a.progress) == SPT_OK);
    CHECK_SAY(a.progress.restarted == 0 && a.progress.evaluations >= 1u << 16 &&
                  a.progress.evaluations < 1u << 17,
              "%.0f before it was seen", (double)a.progress.evaluations);
    advance_finish(&a, 3000);
    frame_same(&c.frame, hits, whole, "after a stopped clock");
}

void suite_frame_picture(void) {
    RUN(frame_picture_stages);
    RUN(frame_picture_tiny);
    RUN(frame_picture_of_hits);
    RUN(frame_picture_refuses);
    RUN(frame_picture_by_a_clock);
    RUN(frame_picture_by_a_stopped_clock);
}
