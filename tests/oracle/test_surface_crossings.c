/* SPDX-License-Identifier: MIT
 *
 * Crossings (spt_crossings_of) of random rays with random solids, and the same one by one with
 * spt_trace() and SPT_SKIP_START, against crossings certified in double. Left out: cases with known
 * numbers and the contract, see test_surface_crossings_known.c. */
#include "surface_solids.h"
#include "../check.h"

#include <math.h>

static const char *const kind_names[solid_kinds] = {"chain", "shells", "cut",
                                                    "slabs", "torus",  "room"};

enum { draws = 3, rays_a_solid = 5, cases = solid_kinds * draws };

/* The solids, their rays and what is true of them: drawn once for all runs. */
typedef struct drawn_case {
    surface_solid solid;
    reference_field field;
    spt_settings settings;
    spt_ray rays[rays_a_solid];
    solid_truth truth[rays_a_solid];
} drawn_case;

static void draw_case(solid_kind kind, drawn_case *out) {
    solid_draw(kind, &out->solid);
    out->field = solid_field(&out->solid);
    out->settings = spt_settings_default();
    out->settings.budget = 1000;
    out->settings.pixel_radius = check_random() % 2 != 0 ? 1e-4f : 0;
    for (int i = 0; i < rays_a_solid; ++i) {
        out->rays[i] = solid_ray();
        out->truth[i] = solid_true_crossings(&out->field, &out->settings, &out->rays[i]);
    }
}

static void crossings_of_solids(void) {
    static drawn_case all[cases];
    for (int i = 0; i < cases; ++i) draw_case((solid_kind)(i % solid_kinds), &all[i]);
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        int clear = 0, limited = 0, crossed = 0;
        for (int i = 0; i < cases * rays_a_solid; ++i) {
            const drawn_case *one = &all[i / rays_a_solid];
            const solid_truth *truth = &one->truth[i % rays_a_solid];
            const spt_ray *ray = &one->rays[i % rays_a_solid];
            const spt_settings settings = surface_settings(&run, &one->settings);
            const spt_field field = surface_field(&run, &one->field, 0);
            const uint32_t most = i % 4 == 0 ? 1 + check_random() % 5 : solid_room;
            solid_crossings found;
            CHECK(solid_call(&field, &settings, ray, most, &found) == SPT_OK);
            if (!truth->clear) continue;
            check_say("%s", kind_names[i / rays_a_solid % solid_kinds]);
            solid_check(&one->field, ray, most, truth, &found);
            ++clear;
            limited += found.outcome == SPT_LIMIT;
            crossed += (int)found.number;
        }
        CHECK_SAY(clear > cases * rays_a_solid * 3 / 4 && crossed > 2 * clear &&
                      limited <= clear / 50,
                  "%d clear, %d crossings, %d out of budget", clear, crossed, limited);
    }
}

/* A convex body by the secant rule: at most one way in and one out. */
static void crossings_of_convex_bodies(void) {
    static const analytic_kind kinds[] = {ANALYTIC_SPHERE, ANALYTIC_BOX, ANALYTIC_CAPSULE,
                                          ANALYTIC_PLANE};
    for (surface_run run = surface_runs(SURFACE_ALL_RULES | SURFACE_CONVEX); surface_next(&run);) {
        for (int i = 0; i < 16; ++i) {
            surface_body one = surface_place_at(analytic_sample(kinds[i % 4], 2), 0.1, 0.2, 0.3);
            reference_field reference;
            spt_field field;
            spt_settings given = spt_settings_default(), settings;
            const spt_ray ray = solid_ray();
            solid_truth truth;
            solid_crossings found;
            surface_turn(&one);
            one.factor = pow(2, check_uniform(-3, 3));
            reference = surface_body_field(&one);
            field = surface_field(&run, &reference, SPT_FIELD_CONVEX);
            given.budget = 1000;
            settings = surface_settings(&run, &given);
            truth = solid_true_crossings(&reference, &settings, &ray);
            CHECK(solid_call(&field, &settings, &ray, solid_room, &found) == SPT_OK);
            CHECK(found.number <= 2);
            if (truth.clear) solid_check(&reference, &ray, solid_room, &truth, &found);
        }
    }
}

/* The next hit behind t: rays.t_min is the column of t, and the start is skipped. Each hit is the
 * next crossing, as long as the stretch between two is deeper than what is skipped. */
static void next_hit_behind(void) {
    static drawn_case all[solid_kinds];
    for (int i = 0; i < solid_kinds; ++i) draw_case((solid_kind)i, &all[i]);
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        int passed = 0;
        for (int i = 0; i < solid_kinds * rays_a_solid; ++i) {
            const drawn_case *one = &all[i / rays_a_solid];
            const solid_truth *truth = &one->truth[i % rays_a_solid];
            const spt_ray *ray = &one->rays[i % rays_a_solid];
            spt_settings settings = surface_settings(&run, &one->settings);
            const spt_field field = surface_field(&run, &one->field, 0);
            solid_crossings found = {{0}, 0, 0, SPT_MISS, 0};
            spt_rays rays = spt_rays_of(ray);
            spt_hit hit = {0, 0, 0, 0, 0, 0, 0, 0, 0};
            const spt_hits hits = spt_hits_of(&hit);
            if (!truth->clear) continue;
            for (int k = 0; k <= truth->count; ++k) {
                CHECK(spt_trace(&field, &settings, 1, &rays, &hits, NULL) == SPT_OK);
                if (hit.outcome != SPT_HIT) break;
                if (k < solid_room) found.t[k] = hit.t;
                ++found.number;
                rays.t_min.first = &hit.t;
                settings.flags = SPT_SKIP_START;
            }
            if (hit.outcome == SPT_LIMIT) continue;
            CHECK_SAY((int)found.number == truth->count && hit.outcome == SPT_MISS,
                      "%s: %u of %d, outcome %d", kind_names[i / rays_a_solid], found.number,
                      truth->count, hit.outcome);
            for (int k = 0; k < truth->count && k < (int)found.number; ++k) {
                const double exact = truth->t[k], before = k == 0 ? -1 : truth->t[k - 1];
                CHECK_SAY((double)found.t[k] > before &&
                              (double)found.t[k] <=
                                  exact + 30 * surface_rounding(ray, exact) / oracle_length(ray),
                          "%.9g for %.9g", (double)found.t[k], exact);
            }
            passed += truth->count;
        }
        CHECK_SAY(passed > 40, "%d", passed);
    }
}

void suite_surface_crossings(void) {
    RUN(crossings_of_solids);
    RUN(crossings_of_convex_bodies);
    RUN(next_hit_behind);
}
