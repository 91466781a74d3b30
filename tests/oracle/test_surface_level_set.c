/* SPDX-License-Identifier: MIT
 *
 * The level set that undoes the half pixel (spt_level_set_field): its values against the field's in
 * double, what it keeps, and the pixels of a ball against those of its exact silhouette. */
#include "surface_oracle.h"
#include "../check.h"

#include <spheretrace/surface.h>

#include <math.h>
#include <string.h>

static const float eye_at_zero[3] = {0, 0, 0};

/* ---- Values -------------------------------------------------------------------------------- */

enum { batch = 16 };

static void batch_values(const spt_field *field, float points[batch][3], float values[batch]) {
    static float memory[4 * batch + 16];
    const size_t skipped = (64 - (size_t)((uintptr_t)memory % 64)) % 64 / sizeof memory[0];
    float *at = memory + skipped;
    for (int i = 0; i < batch; ++i) {
        for (int axis = 0; axis < 3; ++axis) at[axis * batch + i] = points[i][axis];
    }
    field->batch(field->user, batch, at, at + batch, at + 2 * batch, at + 3 * batch);
    memcpy(values, at + 3 * batch, batch * sizeof values[0]);
}

typedef struct level {
    surface_body body;
    reference_field reference;
    spt_field given, field;
    spt_settings settings, before; /* as changed and as given */
    spt_level_set memory;
    float eye[3], path, share;
} level;

static void make_level(const surface_run *run, level *all, float share, uint32_t flags) {
    all->body = surface_sphere(check_uniform(-1, 1), check_uniform(-1, 1), 6, 1);
    if (flags == 0) all->body.shape = analytic_sample(ANALYTIC_TORUS, 1.5);
    surface_turn(&all->body);
    all->body.factor = pow(2, check_uniform(-4, 4));
    all->reference = surface_body_field(&all->body);
    all->given = surface_field(run, &all->reference, flags);
    all->before = spt_settings_default();
    all->before.pixel_radius = (float)pow(10, check_uniform(-4, -1));
    all->settings = all->before;
    all->share = share;
    all->path = check_random() % 2 != 0 ? (float)check_uniform(0, 20) : 0;
    for (int axis = 0; axis < 3; ++axis) all->eye[axis] = (float)check_uniform(-1, 1);
    CHECK(spt_level_set_field(&all->given, all->eye, all->path, share, &all->settings, &all->memory,
                              &all->field) == SPT_OK);
}

/* f / lipschitz and the length of the way through p. */
static double value_of(const level *all, const float p[3], double *way) {
    double at[3], offset[3];
    for (int axis = 0; axis < 3; ++axis) {
        at[axis] = (double)p[axis];
        offset[axis] = at[axis] - (double)all->eye[axis];
    }
    *way = (double)all->path + surface_length(offset);
    return surface_distance(&all->body, at);
}

/* Zero where f / lipschitz is -share of the half pixel there, and less than the new half pixel where
 * f is less than 1 - share of the old: both up to the rounding of some operations on numbers below
 * the way and the value. Nowhere steeper than its constant; with a convex f, convex. */
static void level_set_values(void) {
    static const float shares[] = {0, 0.25f, 0.5f, 0.9f, 1};
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        for (int draw = 0; draw < 20; ++draw) {
            static level all;
            float points[batch][3], values[batch];
            const uint32_t flags = draw % 2 != 0 ? SPT_FIELD_CONVEX : 0;
            make_level(&run, &all, shares[draw % 5], flags);
            CHECK(all.field.batch != NULL && all.field.flags == flags);
            CHECK(all.settings.pixel_radius <= all.before.pixel_radius);
            for (int i = 0; i < batch; ++i) {
                for (int axis = 0; axis < 3; ++axis) {
                    points[i][axis] = i % 3 == 2
                                          ? 0.5f * (points[i - 1][axis] + points[i - 2][axis])
                                          : (float)check_uniform(-4, 4);
                }
                if (i % 3 != 2) points[i][2] += 6;
            }
            batch_values(&all.field, points, values);
            for (int i = 0; i < batch; ++i) {
                double way, other_way, apart = 0;
                const double f = value_of(&all, points[i], &way);
                const double pixel = (double)all.before.pixel_radius * way,
                             new_pixel = (double)all.settings.pixel_radius * way;
                const double share = (double)all.share, rounding = 0x1p-20 * (fabs(f) + way);
                const double value = (double)values[i] / (double)all.field.lipschitz;
                if (fabs(f + share * pixel) > rounding) {
                    CHECK_SAY((value > 0) == (f + share * pixel > 0), "share %g: %g, f %g", share,
                              value, f);
                }
                if (fabs(f - (1 - share) * pixel) > rounding) {
                    CHECK_SAY((value < new_pixel) == (f < (1 - share) * pixel),
                              "share %g: %g, f %g, pixel %g, %g", share, value, f, pixel,
                              new_pixel);
                }
                if (i == 0) continue;
                for (int axis = 0; axis < 3; ++axis) {
                    const double d = (double)points[i][axis] - (double)points[i - 1][axis];
                    apart += d * d;
                }
                CHECK_SAY(fabs((double)values[i] - (double)values[i - 1]) <=
                              (double)all.field.lipschitz * (sqrt(apart) + 2 * rounding),
                          "%g over %g", fabs((double)values[i] - (double)values[i - 1]),
                          sqrt(apart));
                if (flags == 0 || i % 3 != 2) continue;
                (void)value_of(&all, points[i - 1], &other_way);
                CHECK_SAY(value <= ((double)values[i - 1] + (double)values[i - 2]) / 2 /
                                           (double)all.field.lipschitz +
                                       2 * rounding,
                          "%g in the middle", value);
            }
        }
    }
}

/* Share 0 leaves all as it is, bit by bit. */
static void level_set_of_nothing(void) {
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        drawn world_drawn;
        spt_field field, same;
        spt_settings settings, changed;
        spt_level_set memory;
        spt_bound bound = spt_bound_sphere(0, 0, 8, 40);
        spt_hit hits[drawn_rays], level_hits[drawn_rays];
        oracle_draw(&world_drawn);
        world_drawn.settings.pixel_radius = 1e-3f;
        settings = surface_settings(&run, &world_drawn.settings);
        changed = settings;
        field = surface_field(&run, &world_drawn.field, 0);
        field.bound = &bound;
        CHECK(spt_level_set_field(&field, eye_at_zero, 0, 0, &changed, &memory, &same) == SPT_OK);
        CHECK(check_same_bits(changed.pixel_radius, settings.pixel_radius));
        CHECK(same.bound == &bound);
        oracle_trace(&field, &settings, drawn_rays, world_drawn.rays, hits);
        oracle_trace(&same, &changed, drawn_rays, world_drawn.rays, level_hits);
        for (int i = 0; i < drawn_rays; ++i) {
            CHECK_SAY(oracle_same_hit(&hits[i], &level_hits[i]), "ray %d: %.9g, %.9g", i,
                      (double)hits[i].t, (double)level_hits[i].t);
        }
    }
}

/* ---- Pixels -------------------------------------------------------------------------------- */

/* The header's example: a disc of about 25 pixels, 2092 pixel centers in it, 2185 within half a
 * pixel and 2138 within a quarter. */
enum { side = 64 };
static const double disc_radius = 25.8449, shift[2] = {0.4332, 0.3989}, half_pixel = 1e-3;

static spt_ray rays[side * side];
static double
    sine[side * side]; /* of the angle by which a ray misses; below 0: it meets the ball */

static void make_picture(surface_body *ball) {
    const double away = 10, tangent = disc_radius * 2 * half_pixel;
    *ball = surface_sphere(0, 0, away, away * tangent / hypot(1, tangent));
    for (int i = 0; i < side * side; ++i) {
        const double x = 2 * half_pixel * (i % side + 0.5 - side / 2 + shift[0]),
                     y = 2 * half_pixel * (i / side + 0.5 - side / 2 + shift[1]);
        const double eye[3] = {0, 0, 0}, target[3] = {x, y, 1};
        rays[i] = surface_aim(eye, target, 1, 100);
        sine[i] = sin(atan(hypot(x, y)) - atan(tangent));
    }
}

static int below(double limit) {
    int count = 0;
    for (int i = 0; i < side * side; ++i) count += sine[i] < limit;
    return count;
}

/* A ray can be a hit only where f comes below the 1 - share of half a pixel (the upper count; float
 * rounding is 1e-7 of the distance, a thousandth of half a pixel). Where it does, it is one unless
 * all samples miss the short stretch: of the level set's function F, whose half pixel is the whole,
 * some sample lies within half a step of the closest approach, where F is more than its least by at
 * most (step / 2)^2 / 2R: 1 % for plain steps, 6 % for the longest (see
 * test_surface_candidate.c). */
static void level_set_silhouette(void) {
    static const float shares[] = {0, 0.5f, 0.9f, 1};
    static const int exact[] = {2185, 2138, 0, 2092};
    surface_body ball;
    reference_field reference;
    make_picture(&ball);
    reference = surface_body_field(&ball);
    CHECK(below(half_pixel) == 2185 && below(half_pixel / 2) == 2138 && below(0) == 2092);
    for (surface_run run = surface_runs(SURFACE_ALL_RULES | SURFACE_CONVEX); surface_next(&run);) {
        if (run.point || (run.lanes != 1 && run.lanes != (uint32_t)spt_lanes())) continue;
        for (int i = 0; i < 4; ++i) {
            static spt_hit hits[side * side];
            const double share = (double)shares[i];
            const double late = run.method == spt_basic() ? 0.012 : 0.06;
            const int most = below((1 - share) * half_pixel + 1e-6),
                      least = below((1 / (1 + late) - share) * half_pixel - 1e-6);
            spt_field field = surface_field(&run, &reference, SPT_FIELD_CONVEX), seen;
            spt_settings given = spt_settings_default(), settings;
            spt_level_set memory;
            int count = 0;
            given.epsilon = 1e-7f;
            given.budget = 400;
            given.pixel_radius = (float)half_pixel;
            settings = surface_settings(&run, &given);
            CHECK(spt_level_set_field(&field, eye_at_zero, 0, shares[i], &settings, &memory,
                                      &seen) == SPT_OK);
            oracle_trace(&seen, &settings, side * side, rays, hits);
            for (int k = 0; k < side * side; ++k) count += hits[k].outcome == SPT_HIT;
            CHECK_SAY(count <= most, "share %g: %d hits, of at most %d", share, count, most);
            CHECK_SAY(count >= least || run.method == spt_convex(),
                      "share %g: %d hits, of at least %d", share, count, least);
            if (run.method == spt_basic() && exact[i] != 0) {
                CHECK_SAY(count == exact[i], "share %g: %d hits for %d", share, count, exact[i]);
            }
        }
    }
}

/* ---- Contract ------------------------------------------------------------------------------ */

static void level_set_refuses(void) {
    const surface_body ball = surface_sphere(0, 0, 6, 1);
    const reference_field reference = surface_body_field(&ball);
    const spt_field field = oracle_field(&reference, 0);
    const spt_field empty = spt_field_default();
    const float bad_eye[3] = {0, NAN, 0};
    spt_settings settings = spt_settings_default(), kept;
    spt_level_set memory;
    spt_field result;
    settings.pixel_radius = 1e-3f;
    kept = settings;
    memset(&result, 0x5a, sizeof result);
#define REFUSED(...) CHECK(spt_level_set_field(__VA_ARGS__) == SPT_BAD_ARGUMENT)
    REFUSED(NULL, eye_at_zero, 0, 0.5f, &settings, &memory, &result);
    REFUSED(&empty, eye_at_zero, 0, 0.5f, &settings, &memory, &result);
    REFUSED(&field, NULL, 0, 0.5f, &settings, &memory, &result);
    REFUSED(&field, bad_eye, 0, 0.5f, &settings, &memory, &result);
    REFUSED(&field, eye_at_zero, -1, 0.5f, &settings, &memory, &result);
    REFUSED(&field, eye_at_zero, NAN, 0.5f, &settings, &memory, &result);
    REFUSED(&field, eye_at_zero, 0, -0.1f, &settings, &memory, &result);
    REFUSED(&field, eye_at_zero, 0, 1.1f, &settings, &memory, &result);
    REFUSED(&field, eye_at_zero, 0, NAN, &settings, &memory, &result);
    REFUSED(&field, eye_at_zero, 0, 0.5f, NULL, &memory, &result);
    REFUSED(&field, eye_at_zero, 0, 0.5f, &settings, NULL, &result);
    REFUSED(&field, eye_at_zero, 0, 0.5f, &settings, &memory, NULL);
#undef REFUSED
    CHECK(check_same_bits(settings.pixel_radius, kept.pixel_radius));
    CHECK(check_bits(result.lipschitz) == 0x5a5a5a5au);
}

void suite_surface_level_set(void) {
    RUN(level_set_values);
    RUN(level_set_of_nothing);
    RUN(level_set_silhouette);
    RUN(level_set_refuses);
}
