/* SPDX-License-Identifier: MIT
 *
 * spt_field_check(): it reports each kind of broken promise at a place where it is broken, and
 * nothing of fields that keep theirs: bodies in every kind of bound, and the scenes. */
#include "check.h"
#include "glass_body.h"
#include "glass_bounds.h"

#include "scenes/scenes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { samples = 2000 };

/* In the order of spt_field_faults.worst. */
enum { OUTSIDE_BOUND, NOT_CONVEX, BODY_NOT_CONVEX, STEEP, NONFINITE, FAULTS };

static uint32_t count_of(const spt_field_faults *faults, int kind) {
    const uint32_t counts[FAULTS] = {faults->outside_bound, faults->not_convex,
                                     faults->body_not_convex, faults->steep, faults->nonfinite};
    return counts[kind];
}

/* The faults of a field; only those of the mask may have been found, and all of `must` were. */
static spt_field_faults expect(const spt_field *field, unsigned must, unsigned may) {
    spt_field_faults faults;
    memset(&faults, 0x5a, sizeof faults);
    CHECK(spt_field_check(field, samples, 7, &faults) == SPT_OK);
    for (int kind = 0; kind < FAULTS; ++kind) {
        const float *worst = faults.worst[kind];
        const uint32_t found = count_of(&faults, kind);
        CHECK_SAY(found == 0 || ((must | may) >> kind & 1) != 0,
                  "fault %d found %u times, at %g %g %g", kind, found, (double)worst[0],
                  (double)worst[1], (double)worst[2]);
        CHECK_SAY(found > 0 || (must >> kind & 1) == 0, "fault %d was not found", kind);
        CHECK(found > 0 || (check_same_bits(worst[0], 0) && check_same_bits(worst[1], 0) &&
                            check_same_bits(worst[2], 0)));
    }
    return faults;
}

/* ---- Fields that lie ------------------------------------------------------------------------ */

/* A ring of radius 1 and tube 0.3 about y, or a ball of radius 1 with a fault. */
typedef enum lie { RING, HONEST, TOO_STEEP, NOT_A_NUMBER, MINUS_INFINITE } lie;

static double lie_distance(lie kind, const float p[3]) {
    const double x = (double)p[0], y = (double)p[1], z = (double)p[2];
    const double distance = sqrt(x * x + y * y + z * z) - 1;
    switch (kind) {
    case RING:
        return hypot(hypot(x, z) - 1, y) - 0.3;
    case TOO_STEEP:
        return 1.5 * distance;
    case NOT_A_NUMBER:
        return z > 0.3 ? (double)NAN : distance;
    case MINUS_INFINITE:
        return z > 0.3 ? -HUGE_VAL : distance;
    default:
        return distance;
    }
}

static float lie_point(void *user, float x, float y, float z) {
    const float p[3] = {x, y, z};
    return (float)lie_distance(*(const lie *)user, p);
}

static spt_field lie_field(lie *kind, const spt_bound *bound, uint32_t flags) {
    spt_field field = spt_field_default();
    field.point = lie_point;
    field.user = kind;
    field.bound = bound;
    field.flags = flags;
    return field;
}

static void F3_torus_is_reported(void) {
    const spt_bound bound = spt_bound_sphere(0, 0, 0, 1.5f);
    lie ring = RING;
    spt_field field = lie_field(&ring, &bound, SPT_FIELD_CONVEX);
    spt_field_faults faults = expect(&field, 1u << NOT_CONVEX | 1u << BODY_NOT_CONVEX, 0);
    CHECK_SAY(lie_distance(RING, faults.worst[BODY_NOT_CONVEX]) > 0, "worst is no fault");
    field.flags = 0; /* not declared: only as a body for spt_trace_convex() */
    faults = expect(&field, 1u << BODY_NOT_CONVEX, 0);
    CHECK_SAY(lie_distance(RING, faults.worst[BODY_NOT_CONVEX]) > 0, "worst is no fault");
}

static void F4b_bound_that_cuts_is_reported(void) {
    lie honest = HONEST;
    for (int kind = 0; kind < glass_bound_count; ++kind) {
        const double center[3] = {0, 0, 0};
        const char *name;
        glass_volume volume;
        const spt_bound bound = glass_bound(kind, center, 0.6, &volume, &name);
        const spt_field field = lie_field(&honest, &bound, SPT_FIELD_CONVEX);
        spt_field_faults faults;
        check_context("%s", name);
        faults = expect(&field, 1u << OUTSIDE_BOUND, 0);
        CHECK_SAY(lie_distance(HONEST, faults.worst[OUTSIDE_BOUND]) < 0, "worst is no fault");
    }
}

static void E1_steepness_is_reported(void) {
    const spt_bound bound = spt_bound_sphere(0, 0, 0, 1.5f);
    lie steep = TOO_STEEP;
    spt_field field = lie_field(&steep, &bound, SPT_FIELD_CONVEX);
    expect(&field, 1u << STEEP, 0);
    field.lipschitz = 1.5f;
    expect(&field, 0, 0);
    field.lipschitz = 1.49f; /* too steep by 0.7 in 100 */
    expect(&field, 1u << STEEP, 0);
}

static void A1_values_that_are_no_numbers_are_reported(void) {
    const spt_bound bound = spt_bound_box(-1.5f, -1.5f, -1.5f, 1.5f, 1.5f, 1.5f);
    for (lie kind = NOT_A_NUMBER; kind <= MINUS_INFINITE; ++kind) {
        const spt_field field = lie_field(&kind, &bound, 0);
        const spt_field_faults faults = expect(&field, 1u << NONFINITE, 0);
        check_context("kind %d", (int)kind);
        CHECK_SAY((double)faults.worst[NONFINITE][2] > 0.3, "worst is no fault");
        for (int i = 0; i < FAULTS; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                CHECK(fabs((double)faults.worst[i][axis]) <= 1.5001);
            }
        }
    }
}

/* ---- Fields that keep their promises -------------------------------------------------------- */

static void honest_bodies(void) {
    for (int which = 0; which < 10; ++which) {
        glass_body body = which == 0   ? glass_ball()
                          : which == 1 ? glass_plate()
                          : which == 2 ? glass_cube()
                          : which == 3 ? glass_dodecahedron()
                          : which == 4 ? glass_rounded(8)
                          : which == 5 ? glass_rounded(32)
                                       : glass_random();
        for (int kind = 0; kind < glass_bound_count; ++kind) {
            const char *name;
            glass_volume volume;
            spt_field field = glass_field(&body, 0);
            const spt_bound bound =
                glass_bound(kind, body.center, (double)body.bound.radius, &volume, &name);
            check_context("%s in %s", body.name, name);
            body.single = kind % 2;
            field.bound = &bound;
            expect(&field, 0, 0);
        }
    }
}

/* A body that is not convex is no broken promise where it was not said to be. The Mandelbulb is
 * said to be an estimate, and is found out. */
static void honest_scenes(void) {
    int seen = 0;
    for (size_t i = 0; i < scene_count; ++i) {
        const int estimate = strcmp(scenes[i]->name, "mandelbulb") == 0;
        const unsigned convex = (scenes[i]->flags & SPT_FIELD_CONVEX) != 0;
        const spt_field field = scene_field(scenes[i], spt_lanes());
        if (scenes[i]->bound == NULL) continue;
        ++seen;
        check_context("%s", scenes[i]->name);
        expect(&field, estimate ? 1u << STEEP : 0, convex ? 0 : 1u << BODY_NOT_CONVEX);
    }
    CHECK_SAY(seen > 5, "%d", seen);
}

/* ---- The call ------------------------------------------------------------------------------- */

static void repeatable(void) {
    glass_body body = glass_random();
    const spt_bound small = spt_bound_sphere(0.25f, -0.375f, 0.125f, 0.7f);
    spt_field field = glass_field(&body, 0);
    spt_field_faults first, again, other;
    field.bound = &small;
    CHECK(spt_field_check(&field, samples, 1, &first) == SPT_OK);
    CHECK_SAY(body.asked > 3 * samples && body.asked < 6 * samples + 1024, "%ld evaluations",
              (long)body.asked);
    CHECK(spt_field_check(&field, samples, 1, &again) == SPT_OK);
    CHECK(spt_field_check(&field, samples, 2, &other) == SPT_OK);
    CHECK(memcmp(&first, &again, sizeof first) == 0);
    CHECK(memcmp(&first.worst[OUTSIDE_BOUND], &other.worst[OUTSIDE_BOUND], sizeof other.worst[0]) !=
          0);
}

static void refused(void) {
    const float normal[3] = {0, 0, 1};
    const spt_bound endless = spt_bound_slab(normal, -2, 2);
    glass_body body = glass_ball();
    spt_field field = glass_field(&body, 0), broken = field;
    spt_field_faults faults, before;
    memset(&before, 0x5a, sizeof before);
    faults = before;
    CHECK(spt_field_check(NULL, samples, 1, &faults) == SPT_BAD_ARGUMENT);
    CHECK(spt_field_check(&field, samples, 1, NULL) == SPT_BAD_ARGUMENT);
    CHECK(spt_field_check(&field, 0, 1, &faults) == SPT_BAD_ARGUMENT);
    CHECK(spt_field_check(&field, (1u << 20) + 1, 1, &faults) == SPT_BAD_ARGUMENT);
    broken.batch = NULL;
    CHECK(spt_field_check(&broken, samples, 1, &faults) == SPT_BAD_ARGUMENT);
    broken = field;
    broken.lipschitz = NAN;
    CHECK(spt_field_check(&broken, samples, 1, &faults) == SPT_BAD_ARGUMENT);
    field.bound = NULL;
    CHECK(spt_field_check(&field, samples, 1, &faults) == SPT_UNSUPPORTED);
    field.bound = &endless;
    CHECK(spt_field_check(&field, samples, 1, &faults) == SPT_UNSUPPORTED);
    CHECK(body.asked == 0);
    CHECK(memcmp(&faults, &before, sizeof faults) == 0);
}

void suite_convex_promises(void) {
    RUN(F3_torus_is_reported);
    RUN(F4b_bound_that_cuts_is_reported);
    RUN(E1_steepness_is_reported);
    RUN(A1_values_that_are_no_numbers_are_reported);
    RUN(honest_bodies);
    RUN(honest_scenes);
    RUN(repeatable);
    RUN(refused);
}
