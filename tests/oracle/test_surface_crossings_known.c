/* SPDX-License-Identifier: MIT
 *
 * Crossings (spt_crossings_of) where their places are known beforehand, starts inside, on and beside
 * a surface, rays that only touch, and what comes of too little room or budget, of NaN and of bad
 * rays. */
#include "surface_solids.h"
#include "../check.h"

#include <math.h>
#include <string.h>

static const spt_ray along_z = {{0, 0, -10}, 0, {0, 0, 1}, 100};

static solid_crossings cross(const surface_run *run, const reference_field *reference,
                             const spt_settings *given, const spt_ray *ray, uint32_t most) {
    const spt_settings settings = surface_settings(run, given);
    const spt_field field = surface_field(run, reference, 0);
    solid_crossings found;
    CHECK(solid_call(&field, &settings, ray, most, &found) == SPT_OK);
    CHECK(found.number <= most);
    return found;
}

/* Head-on, so that each t is at most a tolerance early. */
static void check_known(const char *name, const solid_crossings *found, int count,
                        const double *expected, int inside, double thickness) {
    CHECK_SAY((int)found->number == count && found->inside == inside && found->outcome == SPT_MISS,
              "%s: %u of %d, inside %d, outcome %d", name, found->number, count, found->inside,
              found->outcome);
    for (int i = 0; i < count && i < (int)found->number; ++i) {
        CHECK_SAY((double)found->t[i] <= expected[i] + 1e-5 &&
                      (double)found->t[i] >= expected[i] - 1.05e-4,
                  "%s: crossing %d at %.9g for %.9g", name, i, (double)found->t[i], expected[i]);
    }
    CHECK_SAY(fabs((double)found->thickness - thickness) <= count * 1.05e-4, "%s: %.9g for %.9g",
              name, (double)found->thickness, thickness);
}

static void crossings_known(void) {
    const analytic_shape ring = {ANALYTIC_TORUS, 0.5, 2, {0, 0, 0}};
    surface_solid solid = solid_empty();
    const reference_field field = solid_field(&solid);
    const spt_settings given = spt_settings_default();
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        solid_crossings found;
        solid.shells = 0;
        solid.count = 3; /* two spheres apart and one that overlaps the second */
        solid.bodies[0] = surface_sphere(0, 0, -5, 1);
        solid.bodies[1] = surface_sphere(0, 0, 0, 1);
        solid.bodies[2] = surface_sphere(0, 0, 1.5, 1);
        {
            const double expected[] = {4, 6, 9, 12.5};
            found = cross(&run, &field, &given, &along_z, solid_room);
            check_known("chain", &found, 4, expected, 0, 5.5);
        }
        solid.count = 1;
        solid.bodies[0] = surface_place_at(ring, 0, 0, 0);
        {
            const double expected[] = {7.5, 8.5, 11.5, 12.5};
            found = cross(&run, &field, &given, &along_z, solid_room);
            check_known("torus", &found, 4, expected, 0, 2);
        }
        solid.shells = 1;
        solid.count = 4;
        for (int i = 0; i < 4; ++i) solid.bodies[i] = surface_sphere(0, 0, 0, 4 - i);
        {
            const double expected[] = {6, 7, 8, 9, 11, 12, 13, 14};
            spt_ray inside = along_z;
            found = cross(&run, &field, &given, &along_z, solid_room);
            check_known("shells", &found, 8, expected, 0, 4);
            inside.t_min = 8.5f; /* between t = 8 and 9, in the inner shell */
            found = cross(&run, &field, &given, &inside, solid_room);
            check_known("from the shell", &found, 5, expected + 3, 1, 2.5);
            inside.t_max = 11.25f;
            found = cross(&run, &field, &given, &inside, solid_room);
            check_known("into the shell", &found, 2, expected + 3, 1, 0.75);
        }
    }
}

/* A direction of length 4: t a quarter, thickness in world length; and rays that never end. */
static void crossings_scaled(void) {
    const surface_body ball = surface_sphere(0, 0, 0, 1);
    const reference_field field = surface_body_field(&ball);
    const surface_body below = surface_plane(0);
    const reference_field ground = surface_body_field(&below);
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        spt_settings given = spt_settings_default();
        const spt_ray fast = {{0, 0, -10}, 0, {0, 0, 4}, INFINITY};
        const spt_ray down = {{0, 4, 0}, 0, {0, -2, 0}, INFINITY},
                      up = {{0, -4, 0}, 0, {0, 2, 0}, INFINITY};
        solid_crossings found;
        given.budget = 1000; /* from a tolerance to the end of all floats */
        found = cross(&run, &field, &given, &fast, 4);
        CHECK_SAY(found.number == 2 && found.outcome == SPT_MISS, "%u, %d", found.number,
                  found.outcome);
        CHECK_SAY(fabs((double)found.t[0] - 2.25) <= 3e-5 &&
                      fabs((double)found.t[1] - 2.75) <= 3e-5,
                  "%.9g, %.9g", (double)found.t[0], (double)found.t[1]);
        CHECK_SAY(fabs((double)found.thickness - 2) <= 2.1e-4, "%.9g", (double)found.thickness);
        found = cross(&run, &ground, &given, &down, 4); /* into the ground and never out */
        CHECK_SAY(found.number == 1 && found.outcome == SPT_MISS && found.inside == 0, "%u, %d",
                  found.number, found.outcome);
        CHECK_SAY(check_same_bits(found.thickness, INFINITY), "%g", (double)found.thickness);
        found = cross(&run, &ground, &given, &up, 4);
        CHECK_SAY(found.number == 1 && found.outcome == SPT_MISS && found.inside == 1, "%u, %d",
                  found.number, found.outcome);
        CHECK_SAY(fabs((double)found.thickness - 4) <= 1.1e-4, "%g", (double)found.thickness);
    }
}

/* On the surface, a hair outside or inside, in and out: only what changes sides is a crossing. */
static void crossings_from_the_surface(void) {
    static const struct {
        float z;       /* the start, by a unit ball at 0 */
        int direction; /* -1 in, from above */
        int inside, count;
    } cases[] = {{1, 1, 0, 0},         {1, -1, 0, 2},       {1.00001f, 1, 0, 0},
                 {1.00001f, -1, 0, 2}, {0.99999f, 1, 1, 1}, {0.99999f, -1, 1, 1}};
    const surface_body ball = surface_sphere(0, 0, 0, 1);
    const reference_field field = surface_body_field(&ball);
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        const spt_settings given = spt_settings_default();
        for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
            const spt_ray ray = {{0, 0, cases[i].z}, 0, {0, 0, (float)cases[i].direction}, 10};
            const solid_crossings found = cross(&run, &field, &given, &ray, 4);
            const int out = cases[i].count - 1; /* the last crossing, from the inside out */
            const double way = (double)cases[i].z * -cases[i].direction + 1;
            CHECK_SAY(found.inside == cases[i].inside && (int)found.number == cases[i].count &&
                          found.outcome == SPT_MISS,
                      "case %zu: inside %d, %u crossings, outcome %d", i, found.inside,
                      found.number, found.outcome);
            if (out < 0) continue;
            CHECK_SAY(fabs((double)found.t[out] - way) <= 1.05e-4, "case %zu: %.9g for %.9g", i,
                      (double)found.t[out], way);
            if (out > 0) CHECK_SAY((double)found.t[0] <= 1e-5 + 1e-6, "%g", (double)found.t[0]);
        }
    }
}

/* Past a ball by half a tolerance: no crossing. Through the edge of one, deeper than two: two. */
static void crossings_that_touch(void) {
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        spt_settings given = spt_settings_default();
        given.budget = 2000; /* steps of a tolerance along a stretch of up to 300 */
        for (int i = 0; i < 6; ++i) {
            static const double depths[] = {-0.5e-4, -0.9e-4, -1.1e-4, -2e-4, 3e-4, 1e-3};
            const surface_body ball = surface_sphere(1 - depths[i], 0, 0, 1);
            const reference_field field = surface_body_field(&ball);
            const spt_ray ray = {{0, 0, -5}, 0, {0, 0, 1}, 10};
            const solid_crossings found = cross(&run, &field, &given, &ray, 4);
            const int count = depths[i] > 0 ? 2 : 0;
            CHECK_SAY((int)found.number == count && found.inside == 0 && found.outcome == SPT_MISS,
                      "depth %g: %u, outcome %d", depths[i], found.number, found.outcome);
            if (count == 0) CHECK(fabs((double)found.thickness) <= 0);
        }
    }
}

/* ---- Too little of something --------------------------------------------------------------- */

static void crossings_without_room(void) {
    surface_solid solid = solid_empty();
    const reference_field field = solid_field(&solid);
    solid.shells = 1;
    solid.count = 4;
    for (int i = 0; i < 4; ++i) solid.bodies[i] = surface_sphere(0, 0, 0, 4 - i);
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        const spt_settings given = spt_settings_default();
        const solid_crossings all = cross(&run, &field, &given, &along_z, solid_room);
        CHECK(all.number == 8);
        for (uint32_t most = 1; most < 10; ++most) {
            const solid_crossings found = cross(&run, &field, &given, &along_z, most);
            const uint32_t number = most < 8 ? most : 8;
            CHECK_SAY(found.number == number, "%u of %u", found.number, number);
            CHECK_SAY(found.outcome == (most < 8 ? SPT_HIT : SPT_MISS), "room for %u: outcome %d",
                      most, found.outcome);
            CHECK(memcmp(found.t, all.t, number * sizeof all.t[0]) == 0);
            /* Each shell is 1 thick and lies between an even crossing and the next. */
            CHECK_SAY(fabs((double)found.thickness - number / 2) <= 1e-3, "room for %u: %g", most,
                      (double)found.thickness);
        }
    }
}

static void crossings_on_a_budget(void) {
    surface_solid solid = solid_empty();
    const reference_field field = solid_field(&solid);
    solid.shells = 0;
    solid.count = 2;
    solid.bodies[0] = surface_sphere(0, 0, 0, 1);
    solid.bodies[1] = surface_sphere(1.002, 0, 5, 1); /* passed by 20 tolerances */
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        spt_settings given = spt_settings_default();
        const solid_crossings all = cross(&run, &field, &given, &along_z, 4);
        CHECK(all.number == 2);
        for (given.budget = 0; given.budget < 30; ++given.budget) {
            const solid_crossings found = cross(&run, &field, &given, &along_z, 4);
            CHECK_SAY(found.outcome == SPT_LIMIT ||
                          (found.outcome == SPT_MISS && found.number == 2),
                      "budget %u: %u, outcome %d", given.budget, found.number, found.outcome);
            CHECK(found.number <= 2 && (given.budget > 0 || found.number == 0));
            CHECK(memcmp(found.t, all.t, found.number * sizeof all.t[0]) == 0);
        }
    }
}

static real nan_behind_the_ball(const void *user, const real position[3]) {
    const double p[3] = {(double)position[0], (double)position[1], (double)position[2]};
    return p[2] > *(const double *)user ? (real)NAN : (real)(surface_length(p) - 1);
}

static void crossings_of_nan(void) {
    static const double walls[] = {3, 0.5, -3, -20};
    static const uint32_t numbers[] = {2, 1, 0, 0};
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        const spt_settings given = spt_settings_default();
        for (int i = 0; i < 4; ++i) {
            reference_field field = {nan_behind_the_ball, NULL, 1};
            solid_crossings found;
            field.user = &walls[i];
            found = cross(&run, &field, &given, &along_z, 4);
            CHECK_SAY(found.number == numbers[i] && found.outcome == SPT_NONFINITE,
                      "wall at %g: %u, outcome %d", walls[i], found.number, found.outcome);
            CHECK_SAY(found.thickness >= 0 && found.thickness < 3, "wall at %g: %g", walls[i],
                      (double)found.thickness);
        }
    }
}

static void crossings_of_no_ray(void) {
    const surface_body ball = surface_sphere(0, 0, 0, 1);
    const reference_field field = surface_body_field(&ball);
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        const spt_settings given = spt_settings_default();
        for (int i = 0; i < 3; ++i) {
            spt_ray ray = along_z;
            solid_crossings found;
            if (i == 0) ray.direction[2] = 0;
            if (i == 1) ray.origin[0] = NAN;
            if (i == 2) ray.t_max = -1; /* no bad ray, but an empty one */
            found = cross(&run, &field, &given, &ray, 4);
            CHECK_SAY(found.number == 0 && found.inside == 0 && fabsf(found.thickness) <= 0 &&
                          found.outcome == (i == 2 ? SPT_MISS : SPT_BAD_RAY),
                      "ray %d: %u, inside %d, thickness %g, outcome %d", i, found.number,
                      found.inside, (double)found.thickness, found.outcome);
            CHECK(check_bits(found.t[0]) == 0x5a5a5a5au);
        }
    }
}

/* ---- Contract ------------------------------------------------------------------------------ */

/* Every sink may be absent, inactive rays stay as they are, and what is wrong is refused. */
static void crossings_contract(void) {
    const surface_body ball = surface_sphere(0, 0, 0, 1);
    const reference_field reference = surface_body_field(&ball);
    const spt_field field = oracle_field(&reference, 0);
    spt_settings settings = spt_settings_default();
    const spt_ray rays[3] = {along_z, along_z, along_z};
    static const int32_t active[3] = {-1, 0, -1};
    spt_rays view = spt_rays_of(rays);
    float thickness[3] = {7, 7, 7};
    spt_crossings crossings;
    memset(&crossings, 0, sizeof crossings);
    crossings.most = 2;
    crossings.thickness.first = thickness;
    crossings.thickness.stride = sizeof thickness[0];
    view.active.first = active;
    view.active.stride = sizeof active[0];
    CHECK(spt_crossings_of(&field, &settings, 3, &view, &crossings, NULL) == SPT_OK);
    CHECK_SAY(fabs((double)thickness[0] - 2) <= 3e-4 && check_same_bits(thickness[1], 7) &&
                  check_same_bits(thickness[2], thickness[0]),
              "%g, %g, %g", (double)thickness[0], (double)thickness[1], (double)thickness[2]);
    thickness[0] = 7;
#define REFUSED(...) CHECK(spt_crossings_of(__VA_ARGS__) == SPT_BAD_ARGUMENT)
    REFUSED(NULL, &settings, 1, &view, &crossings, NULL);
    REFUSED(&field, NULL, 1, &view, &crossings, NULL);
    REFUSED(&field, &settings, 1, NULL, &crossings, NULL);
    REFUSED(&field, &settings, 1, &view, NULL, NULL);
    crossings.most = 0;
    REFUSED(&field, &settings, 1, &view, &crossings, NULL);
    crossings.most = 1025;
    REFUSED(&field, &settings, 1, &view, &crossings, NULL);
    crossings.most = 2;
    settings.flags = SPT_STOP_INSIDE;
    REFUSED(&field, &settings, 1, &view, &crossings, NULL);
#undef REFUSED
    CHECK(check_same_bits(thickness[0], 7));
}

void suite_surface_crossings_known(void) {
    RUN(crossings_known);
    RUN(crossings_scaled);
    RUN(crossings_from_the_surface);
    RUN(crossings_that_touch);
    RUN(crossings_without_room);
    RUN(crossings_on_a_budget);
    RUN(crossings_of_nan);
    RUN(crossings_of_no_ray);
    RUN(crossings_contract);
}
