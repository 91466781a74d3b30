/* SPDX-License-Identifier: MIT
 *
 * Properties that compare the library with itself, bit by bit: Q5 to Q7
 * scaling, Q9 budget, Q10 what the callback sees, Q12 order, width and neighbours. Several threads
 * are not here. */
#include "harness.h"
#include "../check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { worlds = 30 };

/* The hit with t and residual times powers of two; exact, and infinities stay. */
static spt_hit scaled_hit(const spt_hit *hit, int t_power, int residual_power) {
    spt_hit scaled = *hit;
    scaled.t = ldexpf(hit->t, t_power);
    scaled.candidate_t = ldexpf(hit->candidate_t, t_power);
    scaled.residual = ldexpf(hit->residual, residual_power);
    return scaled;
}

static void check_same(const spt_hit *expected, const spt_hit *hits, int count, int power) {
    for (int i = 0; i < count; ++i) {
        CHECK_SAY(oracle_same_hit(&expected[i], &hits[i]),
                  "2^%d, ray %d: t %.9g and %.9g, evaluations %u and %u, flags %u and %u", power, i,
                  (double)expected[i].t, (double)hits[i].t, expected[i].evaluations,
                  hits[i].evaluations, expected[i].flags, hits[i].flags);
    }
}

/* Powers of two from -most to most, a new one for each world. */
static int draw_power(int most) {
    return (int)(check_random() % (uint32_t)(2 * most + 1)) - most;
}

static void Q5_scene_scaled(void) {
    for (int i = 0; i < worlds; ++i) {
        const int power = draw_power(60);
        drawn d;
        spt_field field;
        spt_ray scaled[drawn_rays];
        oracle_run run = oracle_first_run;
        oracle_draw(&d);
        d.settings.size = (float)check_uniform(0, 100);
        field = oracle_field(&d.field, 0);
        for (int ray = 0; ray < drawn_rays; ++ray) {
            scaled[ray] = d.rays[ray];
            scaled[ray].t_max = ldexpf(scaled[ray].t_max, power);
            for (int axis = 0; axis < 3; ++axis) {
                scaled[ray].origin[axis] = ldexpf(scaled[ray].origin[axis], power);
            }
        }
        while (oracle_next(&run, 0)) {
            spt_settings settings = oracle_drawn_settings(&d, &run);
            spt_hit expected[drawn_rays], hits[drawn_rays];
            d.scene.scale = 1;
            oracle_trace(&field, &settings, drawn_rays, d.rays, expected);
            d.scene.scale = ldexp(1, power);
            settings.epsilon = ldexpf(settings.epsilon, power);
            settings.size = ldexpf(settings.size, power);
            oracle_trace(&field, &settings, drawn_rays, scaled, hits);
            for (int ray = 0; ray < drawn_rays; ++ray) {
                expected[ray] = scaled_hit(&expected[ray], power, power);
            }
            check_same(expected, hits, drawn_rays, power);
        }
    }
}

static void Q6_direction_scaled(void) {
    for (int i = 0; i < worlds; ++i) {
        const int power = draw_power(90);
        drawn d;
        spt_field field;
        spt_ray scaled[drawn_rays];
        oracle_run run = oracle_first_run;
        oracle_draw(&d);
        field = oracle_field(&d.field, 0);
        for (int ray = 0; ray < drawn_rays; ++ray) {
            scaled[ray] = d.rays[ray];
            scaled[ray].t_max = ldexpf(scaled[ray].t_max, -power);
            for (int axis = 0; axis < 3; ++axis) {
                scaled[ray].direction[axis] = ldexpf(scaled[ray].direction[axis], power);
            }
        }
        while (oracle_next(&run, 0)) {
            const spt_settings settings = oracle_drawn_settings(&d, &run);
            spt_hit expected[drawn_rays], hits[drawn_rays];
            oracle_trace(&field, &settings, drawn_rays, d.rays, expected);
            oracle_trace(&field, &settings, drawn_rays, scaled, hits);
            for (int ray = 0; ray < drawn_rays; ++ray) {
                expected[ray] = scaled_hit(&expected[ray], -power, 0);
            }
            check_same(expected, hits, drawn_rays, power);
        }
    }
}

typedef struct steeper_world {
    reference_field field;
    double factor;
} steeper_world;

static real steeper_distance(const void *user, const real position[3]) {
    const steeper_world *w = user;
    return (real)w->factor * w->field.distance(w->field.user, position);
}

static void Q7_field_scaled(void) {
    for (int i = 0; i < worlds; ++i) {
        const int power = draw_power(60);
        drawn d;
        steeper_world w;
        reference_field steeper = {steeper_distance, NULL, 1};
        spt_field field, steeper_field;
        oracle_run run = oracle_first_run;
        oracle_draw(&d);
        w.field = d.field;
        w.factor = ldexp(1, power);
        steeper.user = &w;
        steeper.lipschitz = (real)w.factor;
        field = oracle_field(&d.field, 0);
        steeper_field = oracle_field(&steeper, 0);
        while (oracle_next(&run, 0)) {
            const spt_settings settings = oracle_drawn_settings(&d, &run);
            spt_hit expected[drawn_rays], hits[drawn_rays];
            oracle_trace(&field, &settings, drawn_rays, d.rays, expected);
            oracle_trace(&steeper_field, &settings, drawn_rays, d.rays, hits);
            for (int ray = 0; ray < drawn_rays; ++ray) {
                expected[ray] = scaled_hit(&expected[ray], 0, power);
            }
            check_same(expected, hits, drawn_rays, power);
        }
    }
}

static void Q9_budget_of_what_was_used(void) {
    for (int i = 0; i < worlds / 2; ++i) {
        drawn d;
        spt_field field;
        oracle_run run = oracle_first_run;
        oracle_draw(&d);
        field = oracle_field(&d.field, 0);
        while (oracle_next(&run, 0)) {
            spt_settings settings = oracle_drawn_settings(&d, &run);
            for (int ray = 0; ray < drawn_rays / 4; ++ray) {
                const spt_hit hit = oracle_trace_one(&field, &settings, &d.rays[ray]);
                const uint32_t budget = settings.budget;
                spt_hit again;
                settings.budget = hit.evaluations;
                again = oracle_trace_one(&field, &settings, &d.rays[ray]);
                CHECK_SAY(oracle_same_hit(&hit, &again), "budget %u: outcome %d, t %.9g",
                          settings.budget, again.outcome, (double)again.t);
                CHECK(hit.evaluations >= 1);
                settings.budget = hit.evaluations - 1;
                again = oracle_trace_one(&field, &settings, &d.rays[ray]);
                CHECK_SAY(again.outcome == SPT_LIMIT, "one less: %d", again.outcome);
                CHECK(again.evaluations == settings.budget);
                settings.budget = budget;
            }
        }
    }
}

/* Asks the world, and looks at what the library hands over. */
typedef struct inspector {
    const reference_field *field;
    uint64_t slots, distinct; /* points, and points without repetitions within a batch */
    int bad_count, unaligned, infinite;
} inspector;

typedef struct place {
    float p[3];
} place;

static int compare_places(const void *a, const void *b) {
    return memcmp(a, b, sizeof(place));
}

static void inspect(void *user, size_t n, const float *x, const float *y, const float *z,
                    float *distance) {
    inspector *seen = user;
    place places[SPT_BATCH];
    const uintptr_t all = (uintptr_t)x | (uintptr_t)y | (uintptr_t)z | (uintptr_t)distance;
    seen->unaligned += all % 64 != 0;
    if (n % 16 != 0 || n < 16 || n > SPT_BATCH) {
        ++seen->bad_count;
        return;
    }
    for (size_t i = 0; i < n; ++i) {
        const real position[3] = {(real)x[i], (real)y[i], (real)z[i]};
        places[i].p[0] = x[i];
        places[i].p[1] = y[i];
        places[i].p[2] = z[i];
        seen->infinite += !isfinite(x[i]) || !isfinite(y[i]) || !isfinite(z[i]);
        distance[i] = (float)seen->field->distance(seen->field->user, position);
    }
    qsort(places, n, sizeof *places, compare_places);
    for (size_t i = 0; i < n; ++i) {
        seen->distinct += i == 0 || compare_places(&places[i - 1], &places[i]) != 0;
    }
    seen->slots += n;
}

/* No two rays are ever at the same place, so what repeats in a batch is padding, and the points
 * without it are the evaluations: no ray was asked for twice, none left out. */
static void Q10_what_the_callback_sees(void) {
    for (int i = 0; i < worlds; ++i) {
        drawn d;
        oracle_run run = oracle_first_run;
        oracle_draw(&d);
        while (oracle_next(&run, 0)) {
            const spt_settings settings = oracle_drawn_settings(&d, &run);
            const size_t count = 1 + check_random() % drawn_rays;
            inspector seen = {NULL, 0, 0, 0, 0, 0};
            spt_field field = spt_field_default();
            spt_statistics statistics = spt_statistics_default();
            spt_hit hits[drawn_rays];
            const spt_rays from = spt_rays_of(d.rays);
            const spt_hits to = spt_hits_of(hits);
            uint64_t evaluations = 0;
            seen.field = &d.field;
            field.batch = inspect;
            field.user = &seen;
            CHECK(spt_trace(&field, &settings, count, &from, &to, &statistics) == SPT_OK);
            for (size_t ray = 0; ray < count; ++ray) {
                evaluations += hits[ray].evaluations;
                CHECK(hits[ray].evaluations <= settings.budget);
            }
            CHECK(seen.bad_count == 0 && seen.unaligned == 0 && seen.infinite == 0);
            CHECK_SAY(seen.distinct == evaluations, "%u asked, %u told", (unsigned)seen.distinct,
                      (unsigned)evaluations);
            CHECK(statistics.evaluations == evaluations && statistics.slots == seen.slots);
        }
    }
}

/* Any bits, and often the worst: 4 of 64 are NaN, an infinity, a denormal or FLT_MAX. */
static float junk(void) {
    static const uint32_t worst[] = {0x7fc00000u, 0x7f800000u, 0xff800000u, 0x00000001u,
                                     0x7f7fffffu, 0x80000000u, 0u,          0x7f800001u};
    const uint32_t pick = check_random() % 64;
    const uint32_t bits = pick < 4 ? worst[check_random() % 8] : check_random();
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static spt_ray junk_ray(void) {
    spt_ray ray = world_ray();
    float *numbers[8] = {&ray.origin[0],    &ray.origin[1],    &ray.origin[2],    &ray.t_min,
                         &ray.direction[0], &ray.direction[1], &ray.direction[2], &ray.t_max};
    for (uint32_t i = 1 + check_random() % 8; i > 0; --i) *numbers[check_random() % 8] = junk();
    return ray;
}

enum { crowd = 600 }; /* over two chunks of SPT_BATCH */

/* Each ray alone on one lane is what the same ray must be in any company: at any width, in a random
 * order, with up to two thirds of junk around it, twice in a row. */
static void Q12_company_changes_nothing(void) {
    static spt_ray rays[crowd], mixed[crowd];
    static spt_hit alone[crowd], hits[crowd];
    static size_t from[crowd];
    drawn d;
    spt_field field;
    oracle_run run = oracle_first_run;
    oracle_draw(&d);
    d.settings.budget = 60;
    field = oracle_field(&d.field, 0);
    for (int i = 0; i < crowd; ++i) rays[i] = i % 3 == 0 ? world_ray() : junk_ray();
    while (oracle_next(&run, 0)) {
        spt_settings settings = oracle_drawn_settings(&d, &run);
        settings.max_lanes = 1;
        for (int i = 0; run.lanes == 1 && i < crowd; ++i) {
            alone[i] = oracle_trace_one(&field, &settings, &rays[i]);
        }
        settings.max_lanes = run.lanes;
        for (int round = 0; round < 4; ++round) {
            const int count = round < 2 ? crowd : 1 + (int)(check_random() % crowd);
            for (int i = 0; i < crowd; ++i) from[i] = (size_t)i;
            for (int i = crowd - 1; i > 0 && round > 0; --i) {
                const size_t other = check_random() % (uint32_t)(i + 1), kept = from[i];
                from[i] = from[other];
                from[other] = kept;
            }
            for (int i = 0; i < crowd; ++i) mixed[i] = rays[from[i]];
            memset(hits, 0xa5, sizeof hits);
            oracle_trace(&field, &settings, (size_t)count, mixed, hits);
            for (int i = 0; i < count; ++i) {
                CHECK_SAY(oracle_same_hit(&alone[from[i]], &hits[i]),
                          "round %d, ray %d: t %.9g and %.9g, evaluations %u and %u", round, i,
                          (double)alone[from[i]].t, (double)hits[i].t, alone[from[i]].evaluations,
                          hits[i].evaluations);
            }
        }
    }
}

void suite_invariance(void) {
    RUN(Q5_scene_scaled);
    RUN(Q6_direction_scaled);
    RUN(Q7_field_scaled);
    RUN(Q9_budget_of_what_was_used);
    RUN(Q10_what_the_callback_sees);
    RUN(Q12_company_changes_nothing);
}
