/* SPDX-License-Identifier: MIT
 *
 * Bounding volumes that the caller answers for: how the callback is asked (rows F11 and Q10), what
 * its answers do, whatever they are, and that asking in batches or one by one, at any width, in a
 * field or a scene, gives the same bits. */
#include "bounds_volume.h"
#include "scene_run.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <string.h>

enum { ray_count = 700 };

/* The unit ball at z = 10, whose rays are told from one another by their origins. */
static float ball_distance(void *user, float x, float y, float z) {
    (void)user;
    return sqrtf(x * x + y * y + (z - 10) * (z - 10)) - 1;
}

static scene_ray rays[ray_count];

/* A third is bad, inactive, or passes the box by far; inactive ones hold anything. */
static void draw_rays(void) {
    for (int i = 0; i < ray_count; ++i) {
        const double length = volume_magnitude(20);
        scene_ray *const self = &rays[i];
        memset(self, 0, sizeof *self);
        self->active = -1;
        self->ray.t_max = (float)INFINITY;
        for (int axis = 0; axis < 3; ++axis) {
            const double target = check_uniform(-1.2, 1.2) + (axis == 2 ? 10 : 0);
            self->ray.origin[axis] = (float)check_uniform(-3, 3);
            self->ray.direction[axis] = (float)((target - (double)self->ray.origin[axis]) * length);
        }
        if (i % 9 == 0) self->ray.direction[2] *= -1;
        if (i % 11 == 0) self->ray.origin[i % 3] = NAN;
        if (i % 13 == 0) self->ray.t_min = -1;
        if (i % 17 == 0) {
            self->active = 0;
            memset(&self->ray, 0xff, sizeof self->ray);
        }
    }
}

/* ---- How it is asked ------------------------------------------------------------------------ */

/* What answers, and whom it saw. */
typedef struct witness {
    volume ball;
    int calls, faults, seen[ray_count];
} witness;

static int is_aligned(const void *pointer) {
    return (uintptr_t)pointer % 64 == 0;
}

/* Which ray it is by its origin and, up to a power of two, its direction; -1: none. */
static int ray_of(const float o[3], const float d[3]) {
    for (int i = 0; i < ray_count; ++i) {
        const spt_ray *const ray = &rays[i].ray;
        int exponent;
        if (!check_same_bits(ray->origin[0], o[0]) || !check_same_bits(ray->origin[1], o[1]) ||
            !check_same_bits(ray->origin[2], o[2])) {
            continue;
        }
        const float largest = fmaxf(fabsf(ray->direction[0]),
                                    fmaxf(fabsf(ray->direction[1]), fabsf(ray->direction[2])));
        frexpf(largest, &exponent);
        for (int axis = 0; axis < 3; ++axis) {
            if (!check_same_bits(ldexpf(ray->direction[axis], 1 - exponent), d[axis])) return -1;
        }
        return i;
    }
    return -1;
}

/* Bad rays, inactive ones and those that look away from the box are not asked for. */
static int is_alive(int i) {
    return rays[i].active != 0 && !(i % 11 == 0) && !(i % 13 == 0) && i % 9 != 0;
}

static void watch(witness *self, const float o[3], const float d[3]) {
    const float largest = fmaxf(fabsf(d[0]), fmaxf(fabsf(d[1]), fabsf(d[2])));
    const int ray = ray_of(o, d);
    self->faults += !(largest >= 1 && largest < 2);
    self->faults += ray < 0 || !is_alive(ray);
    if (ray >= 0) ++self->seen[ray];
}

static void watched_point(void *user, const float o[3], const float d[3], float *t_in,
                          float *t_out) {
    witness *const self = user;
    ++self->calls;
    watch(self, o, d);
    volume_ball_point(&self->ball, o, d, t_in, t_out);
}

static void watched_batch(void *user, size_t n, const float *const origin[3],
                          const float *const direction[3], float *t_in, float *t_out) {
    witness *const self = user;
    ++self->calls;
    self->faults += n % 16 != 0 || n < 16 || n > 256;
    self->faults += !is_aligned(t_in) || !is_aligned(t_out);
    for (int axis = 0; axis < 3; ++axis) {
        self->faults += !is_aligned(origin[axis]) || !is_aligned(direction[axis]);
    }
    for (size_t i = 0; i < n; ++i) {
        const float o[3] = {origin[0][i], origin[1][i], origin[2][i]};
        const float d[3] = {direction[0][i], direction[1][i], direction[2][i]};
        self->faults += !isnan(t_in[i]) || !isnan(t_out[i]);
        watch(self, o, d);
    }
    volume_ball_batch(&self->ball, n, origin, direction, t_in, t_out);
}

static void watched_bound(witness *self, int batch) {
    memset(self, 0, sizeof *self);
    self->ball.middle[2] = 10;
    self->ball.size = 1.001;
    self->ball.bound = batch ? spt_bound_callback(watched_batch, NULL, self)
                             : spt_bound_callback(NULL, watched_point, self);
    for (int axis = 0; axis < 3; ++axis) {
        self->ball.bound.low[axis] = axis == 2 ? 8.5f : -1.5f;
        self->ball.bound.high[axis] = axis == 2 ? 11.5f : 1.5f;
    }
}

/* Every ray that is alive was asked for, once if it was one by one, else some more to fill up. */
static void check_witness(const witness *self, int batch) {
    int alive = 0, seen = 0;
    CHECK_SAY(self->faults == 0, "%d faults", self->faults);
    for (int i = 0; i < ray_count; ++i) {
        const int lives = is_alive(i);
        alive += lives;
        seen += self->seen[i];
        CHECK_SAY(self->seen[i] >= lives, "ray %d was not asked for", i);
    }
    CHECK_SAY(batch ? seen < alive + 16 * self->calls : seen == alive, "%d for %d", seen, alive);
    CHECK(!batch || self->calls <= (ray_count + SPT_BATCH - 1) / SPT_BATCH);
}

static void F11_callback_asked_for_live_rays(void) {
    static witness self;
    static spt_hit first[ray_count], hits[ray_count];
    const spt_rays from = scene_rays_of(rays);
    const spt_hits to = spt_hits_of(hits);
    spt_settings settings = spt_settings_default();
    spt_field field = spt_field_default();
    int found = 0;
    draw_rays();
    field.point = ball_distance;
    field.bound = &self.ball.bound;
    memset(first, 0xa5, sizeof first);
    for (int way = 0; way < 2 * width_count; ++way) {
        const int batch = way % 2 == 0;
        watched_bound(&self, batch);
        settings.max_lanes = widths[way / 2];
        check_context("%u lanes, %s", settings.max_lanes, batch ? "batch" : "point");
        memset(hits, 0xa5, sizeof hits);
        CHECK(spt_trace(&field, &settings, ray_count, &from, &to, NULL) == SPT_OK);
        check_witness(&self, batch);
        if (way == 0) memcpy(first, hits, sizeof first);
        CHECK(memcmp(first, hits, sizeof first) == 0);
    }
    for (int i = 0; i < ray_count; ++i) found += is_alive(i) && first[i].outcome == SPT_HIT;
    CHECK_SAY(found > ray_count / 4, "%d hits", found);
    /* Alone each ray gets the same. */
    for (int i = 0; i < ray_count; i += 7) {
        const spt_rays one = scene_rays_of(&rays[i]);
        spt_hit hit;
        const spt_hits alone = spt_hits_of(&hit);
        memset(&hit, 0xa5, sizeof hit);
        CHECK(spt_trace(&field, &settings, 1, &one, &alone, NULL) == SPT_OK);
        CHECK_SAY(memcmp(&hit, &first[i], sizeof hit) == 0, "ray %d", i);
    }
}

static void F11_callback_in_a_scene(void) {
    static witness self;
    static spt_hit alone[ray_count], hits[ray_count];
    const spt_rays from = scene_rays_of(rays);
    const spt_hits to = spt_hits_of(alone);
    spt_field field = spt_field_default();
    spt_scene scene = spt_scene_default();
    draw_rays();
    field.point = ball_distance;
    field.bound = &self.ball.bound;
    scene.fields = &field;
    scene.count = 1;
    for (int way = 0; way < 6 * width_count; ++way) {
        const int batch = way % 2 == 0;
        spt_settings settings = spt_settings_default();
        settings.max_lanes = widths[way / 6];
        settings.flags = way % 6 < 2 ? 0 : way % 6 < 4 ? SPT_SKIP_START : SPT_STOP_INSIDE;
        check_context("%u lanes, %s, flags %u", settings.max_lanes, batch ? "batch" : "point",
                      settings.flags);
        memset(alone, 0xa5, sizeof alone);
        memset(hits, 0xa5, sizeof hits);
        watched_bound(&self, batch);
        CHECK(spt_trace(&field, &settings, ray_count, &from, &to, NULL) == SPT_OK);
        watched_bound(&self, batch);
        scene_run(&scene, &settings, ray_count, rays, hits);
        check_witness(&self, batch);
        CHECK(memcmp(alone, hits, sizeof hits) == 0);
    }
}

/* ---- What it answers ------------------------------------------------------------------------ */

enum { UNWRITTEN = 1, WRITTEN_IN = 2, WRITTEN_OUT = 3, BOTH = 4 };

typedef struct answer {
    int written;
    float t_in, t_out;
} answer;

static void given_answer(void *user, const float o[3], const float d[3], float *t_in,
                         float *t_out) {
    const answer *const self = user;
    (void)o;
    (void)d;
    if (self->written != UNWRITTEN && self->written != WRITTEN_OUT) *t_in = self->t_in;
    if (self->written != UNWRITTEN && self->written != WRITTEN_IN) *t_out = self->t_out;
}

static void given_answers(void *user, size_t n, const float *const origin[3],
                          const float *const direction[3], float *t_in, float *t_out) {
    const float none[3] = {0, 0, 0};
    (void)origin;
    (void)direction;
    for (size_t i = 0; i < n; ++i) given_answer(user, none, none, &t_in[i], &t_out[i]);
}

/* The results with an answer, which must be those with the box alone, or misses. */
static void check_answer(const answer *given, int misses) {
    static spt_hit expected[ray_count], hits[ray_count];
    const spt_rays from = scene_rays_of(rays);
    const spt_hits to_expected = spt_hits_of(expected), to = spt_hits_of(hits);
    spt_bound bound = spt_bound_box(-1.5f, -1.5f, 8.5f, 1.5f, 1.5f, 11.5f);
    spt_settings settings = spt_settings_default();
    spt_field field = spt_field_default();
    answer copy = *given;
    field.point = ball_distance;
    field.bound = &bound;
    check_context("[%g, %g], written %d", (double)given->t_in, (double)given->t_out,
                  given->written);
    memset(expected, 0xa5, sizeof expected);
    CHECK(spt_trace(&field, &settings, ray_count, &from, &to_expected, NULL) == SPT_OK);
    bound.kind = SPT_BOUND_CALLBACK;
    bound.user = &copy;
    for (int way = 0; way < 2 * width_count; ++way) {
        bound.batch = way % 2 == 0 ? given_answers : NULL;
        bound.point = given_answer;
        settings.max_lanes = widths[way / 2];
        memset(hits, 0xa5, sizeof hits);
        CHECK(spt_trace(&field, &settings, ray_count, &from, &to, NULL) == SPT_OK);
        for (int i = 0; i < ray_count; ++i) {
            if (!misses || !is_alive(i)) {
                CHECK_SAY(memcmp(&hits[i], &expected[i], sizeof hits[i]) == 0, "ray %d", i);
            } else {
                CHECK_SAY(hits[i].outcome == SPT_MISS && hits[i].evaluations == 0, "ray %d", i);
            }
        }
    }
}

static void F2_callback_answers_of_any_sort(void) {
    const float nan = NAN, infinity = (float)INFINITY;
    const answer box_alone[] = {{UNWRITTEN, 0, 0},      {BOTH, nan, nan},
                                {BOTH, -infinity, nan}, {BOTH, nan, infinity},
                                {BOTH, -5, infinity},   {BOTH, -0.0f, 3e38f},
                                {BOTH, 0, 100},         {WRITTEN_IN, 1, 0},
                                {WRITTEN_OUT, 0, 99},   {BOTH, -FLT_MAX, FLT_MAX}};
    const answer nothing[] = {{BOTH, 1, 0},
                              {BOTH, infinity, -infinity},
                              {BOTH, infinity, infinity},
                              {BOTH, -infinity, -infinity},
                              {BOTH, FLT_MAX, infinity},
                              {WRITTEN_IN, 1e30f, 0},
                              {WRITTEN_OUT, 0, -1e-30f},
                              {BOTH, 2e9f, 1e9f}};
    draw_rays();
    for (size_t i = 0; i < sizeof box_alone / sizeof box_alone[0]; ++i) {
        check_answer(&box_alone[i], 0);
    }
    for (size_t i = 0; i < sizeof nothing / sizeof nothing[0]; ++i) check_answer(&nothing[i], 1);
}

/* Its interval is taken as it is, in the units that it was asked in. */
static void Q20_callback_interval_as_it_is(void) {
    const float o[3] = {0, 0, 0}, d[3] = {0, 0, 8}; /* asked with {0, 0, 1} */
    answer given = {BOTH, 9.25f, 10.75f};
    spt_bound bound = spt_bound_callback(NULL, given_answer, &given);
    float entry, exit;
    for (int batch = 0; batch < 2; ++batch) {
        bound.batch = batch ? given_answers : NULL;
        CHECK(spt_bound_interval(&bound, o, d, 0, (float)INFINITY, &entry, &exit) == SPT_OK);
        CHECK(check_same_bits(entry, 9.25f / 8) && check_same_bits(exit, 10.75f / 8));
        CHECK(spt_bound_interval(&bound, o, d, 1.25f, 1.3f, &entry, &exit) == SPT_OK);
        CHECK(check_same_bits(entry, 1.25f) && check_same_bits(exit, 1.3f));
        CHECK(spt_bound_interval(&bound, o, d, 2, 3, &entry, &exit) == SPT_OK);
        CHECK(check_same_bits(entry, (float)INFINITY) && check_same_bits(exit, -(float)INFINITY));
    }
}

/* A ray that comes to the volume from outside begins in the open: its start is not skipped, though
 * it begins right on the surface. */
static void Q20_callback_entered_is_not_skipped(void) {
    static volume ball;
    spt_settings settings = spt_settings_default();
    spt_field field = spt_field_default();
    const spt_ray ray = {{0.3f, 0.2f, 0}, 0, {0, 0, 1}, (float)INFINITY};
    spt_hit hit;
    const spt_rays from = spt_rays_of(&ray);
    const spt_hits to = spt_hits_of(&hit);
    ball.middle[2] = 10;
    ball.size = 1;
    ball.bound = spt_bound_callback(volume_ball_batch, NULL, &ball);
    field.point = ball_distance;
    field.bound = &ball.bound;
    settings.flags = SPT_SKIP_START;
    CHECK(spt_trace(&field, &settings, 1, &from, &to, NULL) == SPT_OK);
    CHECK_SAY(hit.outcome == SPT_HIT && hit.evaluations == 1 &&
                  fabs((double)hit.t - (10 - sqrt(1 - 0.13))) < 1e-5,
              "outcome %d at %.9g, %u evaluations", hit.outcome, (double)hit.t, hit.evaluations);
}

void suite_bounds_callback(void) {
    RUN(F11_callback_asked_for_live_rays);
    RUN(F11_callback_in_a_scene);
    RUN(F2_callback_answers_of_any_sort);
    RUN(Q20_callback_interval_as_it_is);
    RUN(Q20_callback_entered_is_not_skipped);
}
