/* SPDX-License-Identifier: MIT
 *
 * The caller's own volumes (SPT_BOUND_CALLBACK): how their callbacks are called, answers that are
 * none, and callbacks that leave or call the library themselves; through spt_trace() and
 * spt_trace_convex(), in batches and one by one, at every width. */
#include "stress.h"

#include <spheretrace/surface.h>

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <string.h>

/* ---- A ball as a caller's volume ------------------------------------------------------------- */

typedef enum answer {
    ANSWER_TRUE,
    ANSWER_NAN,      /* no constraint */
    ANSWER_NOTHING,  /* not written: none either */
    ANSWER_IN_ONLY,  /* one end is none */
    ANSWER_OUT_ONLY, /* the other */
    ANSWER_INFINITE, /* from minus infinity to infinity: none */
    ANSWER_OUTSIDE,  /* t_in > t_out: the ray stays outside */
    ANSWER_REVERSED, /* the same, of infinities */
    ANSWER_HUGE,     /* FLT_MAX at either end */
    ANSWER_TINY,     /* denormal */
    ANSWER_JUNK,     /* any bits */
    answers
} answer;

typedef struct volume {
    float center[3], radius;
    answer answer;
    size_t calls, rays, faults;
    int left; /* rays before leaving by longjmp; negative: stays */
    jmp_buf way_out;
    void (*visit)(void);
} volume;

static volume ball;
static spt_bound bound;
static float least_x, most_x; /* of the origins of active rays */

static void audit_ray(volume *self, const float origin[3], const float direction[3]) {
    float largest = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        self->faults += !(fabsf(origin[axis]) <= FLT_MAX && fabsf(direction[axis]) <= FLT_MAX);
        largest = fmaxf(largest, fabsf(direction[axis]));
    }
    self->faults += !(largest >= 1.0f && largest <= 2.0f);
    self->faults += !(origin[0] >= least_x && origin[0] <= most_x);
    ++self->rays;
    if (self->left >= 0 && self->left-- == 0) longjmp(self->way_out, 1);
}

/* A little wider than the ball, for rounding. */
static void true_interval(const volume *self, const float origin[3], const float direction[3],
                          float *t_in, float *t_out) {
    double a = 0.0, b = 0.0, c = -1.0001 * (double)self->radius * (double)self->radius;
    for (int axis = 0; axis < 3; ++axis) {
        const double d = (double)direction[axis];
        const double o = (double)origin[axis] - (double)self->center[axis];
        a += d * d;
        b += o * d;
        c += o * o;
    }
    const double square = b * b - a * c;
    if (!(square >= 0.0)) {
        *t_in = INFINITY;
        *t_out = -INFINITY;
        return;
    }
    *t_in = (float)((-b - sqrt(square)) / a);
    *t_out = (float)((-b + sqrt(square)) / a);
}

static void answer_ray(volume *self, const float origin[3], const float direction[3], float *t_in,
                       float *t_out) {
    const float list[answers][2] = {
        [ANSWER_NAN] = {stress_nan(), stress_nan()},
        [ANSWER_INFINITE] = {-stress_infinity(), stress_infinity()},
        [ANSWER_OUTSIDE] = {3.0f, 2.0f},
        [ANSWER_REVERSED] = {stress_infinity(), -stress_infinity()},
        [ANSWER_HUGE] = {-FLT_MAX, FLT_MAX},
        [ANSWER_TINY] = {1e-45f, 1e-42f},
        [ANSWER_JUNK] = {stress_from_bits(check_bits(origin[0]) * 2654435761u),
                         stress_from_bits(check_bits(direction[0]) * 2246822519u)}};
    audit_ray(self, origin, direction);
    if (self->visit != NULL) self->visit();
    if (self->answer == ANSWER_NOTHING) return;
    if (self->answer == ANSWER_TRUE || self->answer == ANSWER_IN_ONLY ||
        self->answer == ANSWER_OUT_ONLY) {
        true_interval(self, origin, direction, t_in, t_out);
        if (self->answer == ANSWER_IN_ONLY) *t_out = stress_nan();
        if (self->answer == ANSWER_OUT_ONLY) *t_in = stress_nan();
        return;
    }
    *t_in = list[self->answer][0];
    *t_out = list[self->answer][1];
}

static void interval_batch(void *user, size_t n, const float *const origin[3],
                           const float *const direction[3], float *t_in, float *t_out) {
    volume *const self = user;
    const float *const arrays[] = {origin[0],    origin[1],    origin[2], direction[0],
                                   direction[1], direction[2], t_in,      t_out};
    ++self->calls;
    self->faults += n == 0 || n % 16 != 0 || n > 256;
    for (int i = 0; i < 8; ++i) {
        self->faults += ((uintptr_t)arrays[i] & 63u) != 0;
        for (int j = 0; j < i; ++j) self->faults += arrays[i] == arrays[j];
    }
    for (size_t i = 0; i < n; ++i) {
        const float o[] = {origin[0][i], origin[1][i], origin[2][i]};
        const float d[] = {direction[0][i], direction[1][i], direction[2][i]};
        answer_ray(self, o, d, &t_in[i], &t_out[i]);
    }
}

static void interval_point(void *user, const float origin[3], const float direction[3], float *t_in,
                           float *t_out) {
    ++((volume *)user)->calls;
    answer_ray(user, origin, direction, t_in, t_out);
}

/* ---- Traces ---------------------------------------------------------------------------------- */

enum { most = 257 };

static spt_ray rays[most];
static int32_t active[most];
static spt_hit hits[most], right[most];
static stress_probe probe;

/* Directions of any length; some miss the volume, some begin in it. */
static void make_rays(void) {
    least_x = 0.0f;
    most_x = 0.5f;
    for (size_t i = 0; i < most; ++i) {
        const float scale = ldexpf(1.0f + 0.25f * (float)(i % 3), (int)(i % 40) - 20);
        const spt_ray ray = {{0.1f * (float)(i % 5), 0.0f, i % 9 == 4 ? 9.9f : 0.0f},
                             0.0f,
                             {((float)(i % 17) - 8.0f) * 0.02f * scale,
                              ((float)(i / 17) - 7.0f) * 0.015f * scale, scale},
                             40.0f / scale};
        rays[i] = ray;
        active[i] = -1;
    }
}

typedef spt_status trace_fn(const spt_field *, const spt_settings *, size_t, const spt_rays *,
                            const spt_hits *, spt_statistics *);
static trace_fn *const traces[] = {spt_trace, spt_trace_convex};

/* The ball of the base scene in a volume, or without one where volume is NULL. */
static spt_status trace(trace_fn *how, uint32_t lanes, size_t count, const spt_bound *in) {
    stress_case what = stress_base();
    stress_way way = stress_ways(STRESS_CONVEX);
    spt_rays columns = spt_rays_of(rays);
    const spt_hits sinks = spt_hits_of(hits);
    what.bound = in;
    what.settings.max_lanes = lanes;
    columns.active.first = active;
    columns.active.stride = 4;
    stress_probe_of(&probe, &what, 0);
    const spt_field field = stress_field(&way, &what, &probe);
    ball.calls = ball.rays = ball.faults = 0;
    memset(hits, 0xa5, sizeof hits);
    return how(&field, &what.settings, count, &columns, &sinks, NULL);
}

static void make_volume(int batch) {
    static const float center[] = {0.05f, 0.0f, 10.0f};
    memset(&ball, 0, sizeof ball);
    memcpy(ball.center, center, sizeof center);
    ball.radius = 1.25f;
    ball.left = -1;
    bound = spt_bound_callback(batch ? interval_batch : NULL, interval_point, &ball);
    make_rays();
}

#define FOR_EACH_WAY(batch, width, how) \
    for (int batch = 0; batch < 2; ++batch) \
        for (int width = 0; width < STRESS_WIDTHS; ++width) \
            for (int how = 0; how < 2; ++how) \
                if (check_context("%s, %u lanes, trace %d", batch ? "batch" : "one by one", \
                                  (unsigned)stress_widths[width], how), \
                    make_volume(batch), 1)

/* Within the tolerance of one another: volumes differ in their size and so in the floor. */
static void check_same_surface(size_t count) {
    size_t wrong = 0;
    for (size_t i = 0; i < count; ++i) {
        const double len = stress_length(rays[i].direction);
        wrong += hits[i].outcome != right[i].outcome ||
                 (hits[i].outcome == SPT_HIT &&
                  !stress_within((double)hits[i].t * len, (double)right[i].t * len, 2e-3));
    }
    CHECK_SAY(wrong == 0, "%u of %u differ", (unsigned)wrong, (unsigned)count);
}

static void F7sb_interval_callbacks_are_called_well(void) {
    static const size_t counts[] = {1, 15, 16, 17, 255, 256, 257};
    static spt_hit first[2][most];
    const spt_bound sphere = spt_bound_sphere(0.05f, 0.0f, 10.0f, 1.25f);
    FOR_EACH_WAY(batch, width, how) {
        const uint32_t lanes = stress_widths[width];
        CHECK(trace(traces[how], lanes, most, &sphere) == SPT_OK);
        memcpy(right, hits, sizeof right);
        for (int i = 0; i < 7; ++i) {
            CHECK(trace(traces[how], lanes, counts[i], &bound) == SPT_OK);
            CHECK_SAY(ball.faults == 0 && probe.faults == 0, "%u faults", (unsigned)ball.faults);
            /* With padding; and spt_trace_convex() may ask twice. */
            CHECK(ball.rays >= counts[i] && (batch || ball.rays <= counts[i] * (size_t)(1 + how)));
            CHECK(!batch || ball.calls < ball.rays);
            check_same_surface(counts[i]);
        }
        if (batch == 0 && width == 0) memcpy(first[how], hits, sizeof hits);
        CHECK(memcmp(first[how], hits, sizeof hits) == 0); /* all 257 of the last count */
    }
}

/* Rays that are inactive or bad are not asked about. */
static void F11sb_interval_callbacks_see_active_rays(void) {
    FOR_EACH_WAY(batch, width, how) {
        size_t on = 0;
        CHECK(trace(traces[how], stress_widths[width], most, &bound) == SPT_OK);
        memcpy(right, hits, sizeof right);
        for (size_t i = 0; i < most; ++i) {
            if (i % 3 != 1) {
                ++on;
                continue;
            }
            rays[i].origin[0] = i % 2 ? 1e6f : stress_nan();
            active[i] = i % 2 ? 0 : -1; /* of those with NaN the library finds out */
        }
        CHECK(trace(traces[how], stress_widths[width], most, &bound) == SPT_OK);
        CHECK_SAY(ball.faults == 0, "%u faults", (unsigned)ball.faults);
        CHECK(ball.rays >= on && (batch || ball.rays <= on * (size_t)(1 + how)));
        for (size_t i = 0; i < most; ++i) {
            if (i % 3 != 1) CHECK(stress_same_hit(&hits[i], &right[i]));
            if (i % 3 == 1 && i % 2 == 0) CHECK(hits[i].outcome == SPT_BAD_RAY);
            if (i % 3 == 1 && i % 2 == 1) CHECK(hits[i].evaluations == 0xa5a5a5a5u);
        }
    }
}

/* ---- Answers that are none ------------------------------------------------------------------- */

static void check_defined(const spt_hit *hit, const spt_ray *ray) {
    const int at = hit->outcome == SPT_HIT || hit->outcome == SPT_LIMIT;
    CHECK(hit->outcome == SPT_HIT || hit->outcome == SPT_MISS || hit->outcome == SPT_LIMIT);
    CHECK(at ? hit->t >= ray->t_min && hit->t <= ray->t_max : hit->t >= INFINITY);
    CHECK(!stress_is_nan(hit->residual) && hit->evaluations <= 128);
    CHECK(!stress_is_nan(hit->candidate_t) && !stress_is_nan(hit->candidate_ratio));
}

static void A3sa_interval_answers_of_any_kind(void) {
    static spt_hit first[2][answers][most];
    FOR_EACH_WAY(batch, width, how) {
        const uint32_t lanes = stress_widths[width];
        CHECK(trace(spt_trace, lanes, most, NULL) == SPT_OK);
        memcpy(right, hits, sizeof right);
        for (int kind = 0; kind < answers; ++kind) {
            const int is_none = kind >= ANSWER_NAN && kind <= ANSWER_INFINITE;
            ball.answer = (answer)kind;
            CHECK(trace(traces[how], lanes, most, &bound) == SPT_OK);
            CHECK(ball.faults == 0 && probe.faults == 0);
            if (how == 0 && (is_none || kind == ANSWER_HUGE)) check_same_surface(most);
            for (size_t i = 0; i < most; ++i) {
                check_defined(&hits[i], &rays[i]);
                if (kind != ANSWER_OUTSIDE && kind != ANSWER_REVERSED) continue;
                CHECK(hits[i].outcome == SPT_MISS && hits[i].evaluations == 0);
            }
            if (batch == 0 && width == 0) memcpy(first[how][kind], hits, sizeof hits);
            CHECK_SAY(memcmp(first[how][kind], hits, sizeof hits) == 0, "answer %d", kind);
        }
    }
}

/* The box that a caller's volume is cut with counts as well, and t counts in the ray's own unit. */
static void R3sa_interval_of_a_callback(void) {
    static const float scales[] = {1.0f, 0x1p-40f, 3.0f, 0x1p60f};
    for (int batch = 0; batch < 2; ++batch) {
        for (int i = 0; i < 4; ++i) {
            const float origin[] = {0.0f, 0.0f, 0.0f}, direction[] = {0.0f, 0.0f, scales[i]};
            const double world = (double)scales[i];
            float t_in = -1.0f, t_out = -1.0f;
            make_volume(batch);
            check_context("%s, scale %g", batch ? "batch" : "one by one", world);
            CHECK(spt_bound_interval(&bound, origin, direction, 0.0f, 100.0f / scales[i], &t_in,
                                     &t_out) == SPT_OK);
            CHECK(ball.faults == 0 && ball.rays > 0);
            CHECK(stress_within((double)t_in * world, 8.75, 2e-3));
            CHECK(stress_within((double)t_out * world, 11.25, 2e-3));
            bound.low[2] = 9.5f;
            CHECK(spt_bound_interval(&bound, origin, direction, 0.0f, 100.0f / scales[i], &t_in,
                                     &t_out) == SPT_OK);
            CHECK(stress_within((double)t_in * world, 9.5, 2e-5));
            bound.high[2] = 9.4f;
            CHECK(spt_bound_interval(&bound, origin, direction, 0.0f, 100.0f / scales[i], &t_in,
                                     &t_out) == SPT_BAD_ARGUMENT);
            ball.answer = ANSWER_OUTSIDE;
            bound.high[2] = 20.0f;
            CHECK(spt_bound_interval(&bound, origin, direction, 0.0f, 100.0f / scales[i], &t_in,
                                     &t_out) == SPT_OK);
            CHECK(check_same_bits(t_in, INFINITY) && check_same_bits(t_out, -INFINITY));
        }
    }
}

/* ---- Callbacks that leave, and that call ----------------------------------------------------- */

static int escapes(trace_fn *how, uint32_t lanes, int after) {
    ball.left = after;
    if (setjmp(ball.way_out) != 0) return 1;
    trace(how, lanes, most, &bound);
    return 0;
}

static void G5sa_longjmp_out_of_an_interval(void) {
    int escaped = 0;
    FOR_EACH_WAY(batch, width, how) {
        CHECK(trace(traces[how], stress_widths[width], most, &bound) == SPT_OK);
        memcpy(right, hits, sizeof right);
        for (int after = 0; after < most; after += 37) {
            escaped += escapes(traces[how], stress_widths[width], after);
        }
        ball.left = -1;
        CHECK(trace(traces[how], stress_widths[width], most, &bound) == SPT_OK);
        CHECK(memcmp(hits, right, sizeof hits) == 0);
    }
    CHECK_SAY(escaped == 16 * 7, "%d escapes", escaped);
}

/* An interval that is itself asked of the library. */
static void ask_library(void) {
    static const float origin[] = {0.0f, 0.0f, -5.0f}, direction[] = {0.0f, 0.0f, 1.0f};
    const spt_bound box = spt_bound_box(-1.0f, -1.0f, -1.0f, 1.0f, 1.0f, 1.0f);
    const spt_ray ray = stress_base().ray;
    const spt_rays columns = spt_rays_of(&ray);
    const spt_hits none = {{NULL, 0}, {NULL, 0}, {NULL, 0}, {NULL, 0}, {NULL, 0},
                           {NULL, 0}, {NULL, 0}, {NULL, 0}, {NULL, 0}};
    const stress_case what = stress_base();
    stress_way way = stress_ways(STRESS_CONVEX);
    stress_probe own;
    float t_in, t_out;
    stress_probe_of(&own, &what, 1);
    const spt_field field = stress_field(&way, &what, &own);
    ball.faults += spt_bound_interval(&box, origin, direction, 0.0f, 9.0f, &t_in, &t_out) != SPT_OK;
    ball.faults += !(t_in >= 3.9f && t_out <= 6.1f);
    ball.faults += spt_trace(&field, &what.settings, 1, &columns, &none, NULL) != SPT_OK;
}

static void G7sa_interval_that_traces(void) {
    FOR_EACH_WAY(batch, width, how) {
        CHECK(trace(traces[how], stress_widths[width], most, &bound) == SPT_OK);
        memcpy(right, hits, sizeof right);
        ball.visit = ask_library;
        CHECK(trace(traces[how], stress_widths[width], most, &bound) == SPT_OK);
        CHECK(ball.faults == 0);
        CHECK(memcmp(hits, right, sizeof hits) == 0);
    }
}

void suite_surface_intervals(void) {
    RUN(F7sb_interval_callbacks_are_called_well);
    RUN(F11sb_interval_callbacks_see_active_rays);
    RUN(A3sa_interval_answers_of_any_kind);
    RUN(R3sa_interval_of_a_callback);
    RUN(G5sa_longjmp_out_of_an_interval);
    RUN(G7sa_interval_that_traces);
}
