/* SPDX-License-Identifier: MIT
 *
 * spt_offset() as a call: the depth at exact surfaces, many hits at once, several fields, what is
 * not to be done, equal bits, evaluations. Left out: what its states mean, see test_offset.c. */
#include "check.h"
#include "glass_landing.h"
#include "rules.h"

#include <math.h>
#include <string.h>

enum { case_count = 300 };

static landing surface_of(landing_kind kind, double place, double width) {
    landing surface = {kind, place, width, 1, 0, 0};
    return surface;
}

static void draw_cases(const landing *surface, double tolerance, landing_case *cases) {
    for (int i = 0; i < case_count; ++i) {
        const int inside = (int)(check_random() % 2);
        const double over = check_uniform(0, 0.95) * tolerance;
        cases[i] = landing_hit(surface, inside ? -over : over, inside, check_uniform(0, 3));
        cases[i].cross = check_random() % 2 != 0;
    }
}

/* Row K12 of the errata: at an exact surface the origin is as deep as w = 2 max(epsilon,
 * tolerance), whatever f is, on either side; as printed it is max(2 epsilon_min - |f|, |f|), which
 * at any |f| above half of it is within the tolerance. The origin is rounded to floats. */
static void K12_depth(void) {
    static const double places[] = {0, -1, 100, 1e4, 1e6};
    static landing_case cases[case_count];
    static landing_result results[case_count];
    for (int i = 0; i < 5; ++i) {
        for (int cone = 0; cone < 2; ++cone) {
            landing surface = surface_of(LANDING_GROUND, places[i], 1);
            const spt_field field = landing_field(&surface);
            spt_settings settings = spt_settings_default();
            const double round = 0x1p-22 * (fabs(places[i]) + 5);
            settings.epsilon = 1e-3f;
            settings.size = cone ? 0.0f : 500.0f;
            settings.pixel_radius = cone ? 1e-3f : 0.0f;
            check_context("place %g, pixel radius %g", places[i], (double)settings.pixel_radius);
            draw_cases(&surface, 1e-3, cases);
            for (uint32_t checks = 0; checks <= 4; checks += 2) {
                landing_offset(&field, &settings, checks, case_count, cases, results);
                for (int k = 0; k < case_count; ++k) {
                    const double p[3] = {(double)results[k].origin[0], (double)results[k].origin[1],
                                         (double)results[k].origin[2]};
                    const double w = 2 * landing_tolerance(&settings, &results[k]);
                    const double depth = landing_clearance(&surface, &cases[k], p);
                    CHECK_SAY(fabs(depth - w) <= round, "depth %.9g, not %.9g", depth, w);
                    landing_expect_true(&surface, &settings, &cases[k], &results[k]);
                    CHECK(results[k].start == SPT_START_CLEAR);
                }
            }
        }
    }
}

static void F5_zero_normals(void) {
    static landing_case cases[case_count];
    static landing_result results[case_count];
    landing surface = surface_of(LANDING_GROUND, 0, 1);
    const spt_field field = landing_field(&surface);
    const spt_settings settings = spt_settings_default();
    draw_cases(&surface, 1e-4, cases);
    for (int i = 0; i < case_count; ++i) cases[i].normal[2] = i % 2 != 0 ? 0.0f : -0.0f;
    for (uint32_t checks = 0; checks <= 4; ++checks) {
        landing_offset(&field, &settings, checks, case_count, cases, results);
        for (int i = 0; i < case_count; ++i) {
            CHECK_SAY(results[i].start == SPT_START_AT_HIT, "start %d", (int)results[i].start);
            landing_expect_true(&surface, &settings, &cases[i], &results[i]);
        }
    }
}

/* Only hits are done, of rays that are active. */
static void F11_what_is_left_alone(void) {
    static landing_case cases[case_count];
    static landing_result results[case_count], all[case_count], before;
    landing surface = surface_of(LANDING_BALL, 0, 1);
    const spt_field field = landing_field(&surface);
    const spt_settings settings = spt_settings_default();
    draw_cases(&surface, 1e-4, cases);
    landing_offset(&field, &settings, 1, case_count, cases, all);
    memset(results, 0x5a, sizeof results);
    before = results[0];
    for (int i = 0; i < case_count; ++i) {
        if (i % 3 != 0) continue;
        cases[i].hit.outcome = i % 5;
        cases[i].hit.t = i % 2 != 0 ? NAN : INFINITY;
        if (i % 5 == SPT_HIT) cases[i].hit.outcome = SPT_MISS;
    }
    landing_offset(&field, &settings, 1, case_count, cases, results);
    for (int i = 0; i < case_count; ++i) {
        CHECK_SAY(memcmp(&results[i], i % 3 == 0 ? &before : &all[i], sizeof before) == 0,
                  "hit %d, outcome %d", i, cases[i].hit.outcome);
    }
}

static void Q12_same_bits(void) {
    static landing_case cases[case_count], mixed[case_count];
    static landing_result results[case_count], others[case_count];
    for (int kind = 0; kind < LANDING_KINDS; ++kind) {
        landing surface = surface_of((landing_kind)kind, -1, kind == LANDING_BALL ? 1 : 3e-4);
        const spt_field field = landing_field(&surface);
        spt_settings settings = spt_settings_default();
        draw_cases(&surface, 1e-4, cases);
        for (int i = 0; i < case_count; ++i) mixed[i] = cases[37 * i % case_count];
        settings.max_lanes = 1;
        landing_offset(&field, &settings, 4, case_count, cases, results);
        for (int width = 0; width < width_count; ++width) {
            check_context("kind %d, %u lanes", kind, widths[width]);
            settings.max_lanes = widths[width];
            landing_offset(&field, &settings, 4, case_count, mixed, others);
            for (int i = 0; i < case_count; ++i) {
                CHECK(memcmp(&others[i], &results[37 * i % case_count], sizeof *others) == 0);
            }
            for (int i = 0; i < case_count; ++i) {
                landing_offset(&field, &settings, 4, 1, &cases[i], &others[i]);
                CHECK(memcmp(&others[i], &results[i], sizeof *others) == 0);
            }
        }
    }
}

/* At most `checks` evaluations a hit, in batches of at most 256 points that are filled up to 16. */
static void K12_evaluations(void) {
    static landing_case cases[case_count];
    static landing_result results[case_count];
    landing surface = surface_of(LANDING_SHEET, 0, 1e-4);
    const spt_field field = landing_field(&surface);
    const spt_settings settings = spt_settings_default();
    draw_cases(&surface, 1e-4, cases);
    for (uint32_t checks = 0; checks <= 4; ++checks) {
        surface.points = 0;
        landing_offset(&field, &settings, checks, case_count, cases, results);
        CHECK_SAY(surface.points <= checks * (case_count + 2 * 16), "%u of %u checks",
                  surface.points, checks);
    }
}

/* Hits on two fields, ground and a ball, told apart by the component: as each field alone. */
static void F5_components(void) {
    enum { field_count = 2 };
    landing surfaces[field_count] = {surface_of(LANDING_GROUND, 0, 1),
                                     surface_of(LANDING_BALL, 0, 0.01)};
    const spt_field fields[field_count] = {landing_field(&surfaces[0]),
                                           landing_field(&surfaces[1])};
    static landing_case cases[case_count], mine[case_count];
    static landing_result alone[case_count];
    static float origins[case_count][3], t[case_count], residual[case_count];
    static float normals[case_count][3];
    static int32_t component[case_count], start[case_count], outcome[case_count];
    static spt_ray rays[case_count];
    const spt_rays from = spt_rays_of(rays);
    const spt_vectors read = spt_vectors_of(normals[0]);
    const spt_column stay = {NULL, 0};
    spt_hits hits;
    spt_starts starts;
    spt_settings settings = spt_settings_default();
    memset(&hits, 0, sizeof hits);
    memset(&starts, 0, sizeof starts);
    hits.t.first = t;
    hits.residual.first = residual;
    hits.outcome.first = outcome;
    hits.component.first = component;
    hits.t.stride = hits.residual.stride = hits.outcome.stride = hits.component.stride = 4;
    starts.origin = spt_vector_sinks_of(origins[0]);
    starts.start.first = start;
    starts.start.stride = sizeof *start;
    for (int i = 0; i < case_count; ++i) {
        component[i] = i % 2;
        cases[i] = landing_hit(&surfaces[i % 2], check_uniform(0, 1e-4), 0, 0);
        rays[i] = cases[i].ray;
        t[i] = cases[i].hit.t;
        residual[i] = cases[i].hit.residual;
        outcome[i] = SPT_HIT;
        memcpy(normals[i], cases[i].normal, sizeof normals[i]);
    }
    CHECK(spt_offset(fields, field_count, &settings, case_count, &from, &hits, &read, &stay, 2,
                     &starts) == SPT_OK);
    for (int which = 0; which < field_count; ++which) {
        int count = 0;
        for (int i = which; i < case_count; i += 2) mine[count++] = cases[i];
        landing_offset(&fields[which], &settings, 2, (size_t)count, mine, alone);
        for (int k = 0; k < count; ++k) {
            const int i = 2 * k + which;
            CHECK(start[i] == alone[k].start &&
                  memcmp(origins[i], alone[k].origin, sizeof origins[i]) == 0);
        }
    }
}

void suite_offset_calls(void) {
    RUN(K12_depth);
    RUN(F5_zero_normals);
    RUN(F11_what_is_left_alone);
    RUN(Q12_same_bits);
    RUN(K12_evaluations);
    RUN(F5_components);
}
