/* SPDX-License-Identifier: MIT
 *
 * Collision (spt_collide): balls and capsules against spheres, boxes, tori, capsules and
 * half-spaces, alone and several, outside and in, with the least distance along the axis in
 * double. */
#include "surface_oracle.h"
#include "../check.h"

#include <spheretrace/surface.h>

#include <math.h>
#include <string.h>

enum { most_fields = 3, axis_samples = 256 };

typedef struct obstacles {
    surface_body bodies[most_fields];
    surface_group group;
    reference_field references[most_fields];
    spt_field fields[most_fields];
} obstacles;

typedef struct body {
    float from[3], to[3], radius;
} body;

typedef struct contact {
    float distance, normal[3], place;
    int32_t component;
} contact;

static int is_convex(const surface_body *one) {
    return one->factor > 0 && one->shape.kind != ANALYTIC_TORUS;
}

static void surround(const surface_run *run, obstacles *all, size_t count) {
    all->group.bodies = all->bodies;
    all->group.count = count;
    for (size_t i = 0; i < count; ++i) {
        const uint32_t flags = is_convex(&all->bodies[i]) && i % 2 == 0 ? SPT_FIELD_CONVEX : 0;
        all->references[i] = surface_body_field(&all->bodies[i]);
        all->fields[i] = surface_field(run, &all->references[i], flags);
    }
}

/* About `away` on each axis, where float positions are coarse. */
static void draw_obstacles(const surface_run *run, obstacles *all, size_t count, double away) {
    static const analytic_kind kinds[] = {ANALYTIC_SPHERE, ANALYTIC_BOX, ANALYTIC_TORUS,
                                          ANALYTIC_CAPSULE, ANALYTIC_PLANE};
    for (size_t i = 0; i < count; ++i) {
        surface_body *one = &all->bodies[i];
        *one = surface_place_at(analytic_sample(kinds[check_random() % 5], check_uniform(0.8, 2)),
                                away + check_uniform(-1, 1), away + check_uniform(-1, 1),
                                away + check_uniform(-1, 1));
        if (check_random() % 2 != 0) surface_turn(one);
        one->factor = pow(2, check_uniform(-4, 4));
        if (check_random() % 5 == 0) one->factor *= -1;
    }
    surround(run, all, count);
}

static contact collide(const surface_run *run, const obstacles *all, const spt_settings *given,
                       const body *moved, int ball) {
    const spt_settings settings = surface_settings(run, given);
    contact found = {-1, {7, 7, 7}, -1, 77};
    spt_bodies bodies;
    spt_contacts contacts;
    memset(&bodies, 0, sizeof bodies);
    memset(&contacts, 0, sizeof contacts);
    bodies.from = spt_vectors_of(moved->from);
    if (!ball) bodies.to = spt_vectors_of(moved->to);
    bodies.radius.first = &moved->radius;
    contacts.distance.first = &found.distance;
    contacts.normal = spt_vector_sinks_of(found.normal);
    contacts.place.first = &found.place;
    contacts.component.first = &found.component;
    CHECK(spt_collide(all->fields, all->group.count, &settings, 1, &bodies, &contacts) == SPT_OK);
    return found;
}

/* ---- The truth ----------------------------------------------------------------------------- */

typedef struct axis_of {
    const surface_body *one;
    const body *moved;
} axis_of;

static void place_on(const body *moved, double place, double p[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        const double from = (double)moved->from[axis], to = (double)moved->to[axis];
        p[axis] = from + place * (to - from);
    }
}

static double distance_on(const void *user, double place) {
    const axis_of *self = user;
    double p[3];
    place_on(self->moved, place, p);
    return surface_distance(self->one, p);
}

/* The least along the axis: about the best of many samples, and at both ends. */
static double least_on(const surface_body *one, const body *moved) {
    axis_of self;
    double least = HUGE_VAL;
    int best = 0;
    self.one = one;
    self.moved = moved;
    for (int i = 0; i <= axis_samples; ++i) {
        const double distance = distance_on(&self, (double)i / axis_samples);
        if (!(distance < least)) continue;
        least = distance;
        best = i;
    }
    return fmin(least, surface_least(distance_on, &self, fmax(best - 1, 0) / axis_samples,
                                     fmin(best + 1, axis_samples) / axis_samples, NULL));
}

static double least_of_all(const obstacles *all, const body *moved) {
    double least = HUGE_VAL;
    for (size_t i = 0; i < all->group.count; ++i) {
        least = fmin(least, least_on(&all->bodies[i], moved));
    }
    return least;
}

static double axis_length(const body *moved) {
    double between[3];
    for (int axis = 0; axis < 3; ++axis) {
        between[axis] = (double)moved->to[axis] - (double)moved->from[axis];
    }
    return surface_length(between);
}

/* The least tolerance: positions along the axis are rounded twice an axis, values and the radius'
 * difference once, at most 2^-22 of the largest; and so much is to be taken off, that the distance
 * is never more than the true one. */
static double rounding(const body *moved, double distance) {
    double from[3];
    for (int axis = 0; axis < 3; ++axis) from[axis] = (double)moved->from[axis];
    return 0x1p-21 *
           (surface_length(from) + axis_length(moved) + fabs(distance) + 2 * (double)moved->radius);
}

/* The normal at the place is that of its component, up to the turn of the gradient close by; on a
 * crease there is none to check. */
static void check_normal(const obstacles *all, const body *moved, const contact *found) {
    const surface_body *one = &all->bodies[found->component];
    double n[3], p[3], gradient[3], turn = 0;
    place_on(moved, (double)found->place, p);
    surface_gradient(one, p, gradient);
    for (int axis = 0; axis < 3; ++axis) n[axis] = (double)found->normal[axis];
    for (int i = 0; i < 8; ++i) {
        double q[3], other[3];
        for (int axis = 0; axis < 3; ++axis) q[axis] = p[axis] + ((i >> axis & 1) ? 0.02 : -0.02);
        surface_gradient(one, q, other);
        turn = fmax(turn, surface_angle(gradient, other));
    }
    if (!(turn < 0.2)) return;
    CHECK_SAY(fabs(surface_length(n) - 1) <= 4 * 0x1p-23, "length %.9g", surface_length(n));
    CHECK_SAY(surface_angle(n, gradient) <= 3e-3 + turn, "off by %g, which turns by %g",
              surface_angle(n, gradient), turn);
}

static void check_contact(const obstacles *all, const body *moved, const contact *found,
                          double tolerance) {
    const double exact = least_of_all(all, moved) - (double)moved->radius;
    const double distance = (double)found->distance, slack = rounding(moved, exact);
    double p[3];
    CHECK_SAY(distance <= exact, "%.9g, truth %.9g", distance, exact);
    CHECK_SAY(distance >= exact - tolerance - slack, "%.9g, truth %.9g", distance, exact);
    CHECK_SAY(found->component >= 0 && found->component < (int32_t)all->group.count &&
                  found->place >= 0 && found->place <= 1,
              "component %d, place %g", found->component, (double)found->place);
    if (found->component < 0 || found->component >= (int32_t)all->group.count) return;
    place_on(moved, (double)found->place, p);
    CHECK_SAY(surface_distance(&all->bodies[found->component], p) - (double)moved->radius <=
                  exact + tolerance + slack,
              "at %g of component %d: %g, truth %g", (double)found->place, found->component,
              surface_distance(&all->bodies[found->component], p) - (double)moved->radius, exact);
    check_normal(all, moved, found);
}

static body draw_moved(double away, double reach, double length) {
    body moved;
    double along[3];
    surface_random_unit(along);
    for (int axis = 0; axis < 3; ++axis) {
        moved.from[axis] = (float)(away + check_uniform(-reach, reach));
        moved.to[axis] = moved.from[axis] + (float)(length * along[axis]);
    }
    moved.radius = (float)(check_random() % 4 == 0 ? 0 : check_uniform(0, 1));
    return moved;
}

/* ---- Balls and capsules -------------------------------------------------------------------- */

/* The one value at the middle decides. */
static void collide_balls(void) {
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        static obstacles all;
        for (int draw = 0; draw < 100; ++draw) {
            spt_settings given = spt_settings_default();
            const double away = draw % 3 == 0 ? 1000 : 0;
            body moved = draw_moved(away, 4, 0);
            contact found;
            given.epsilon = 1e-20f;
            draw_obstacles(&run, &all, 1 + check_random() % most_fields, away);
            memcpy(moved.to, moved.from, sizeof moved.to);
            found = collide(&run, &all, &given, &moved, draw % 2);
            check_contact(&all, &moved, &found, 0);
        }
    }
}

/* With the tolerance within reach of 64 values: an interval of the axis of width w whose ends have
 * equal values may hide w / 2 less, and best first halves the whole to 1/32 at least. */
static void collide_capsules(void) {
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        static obstacles all;
        for (int draw = 0; draw < 60; ++draw) {
            const double length = check_uniform(0.1, 4);
            const double away = draw % 3 == 0 ? 1000 : 0;
            const body moved = draw_moved(away, 3, length);
            spt_settings given = spt_settings_default();
            contact found;
            given.epsilon = (float)pow(10, check_uniform(-5, -1));
            draw_obstacles(&run, &all, 1 + check_random() % most_fields, away);
            found = collide(&run, &all, &given, &moved, 0);
            check_contact(&all, &moved, &found, fmax((double)given.epsilon, length / 64));
        }
    }
}

/* A budget that is too small leaves a lower bound; each value more makes it no worse. */
static void collide_on_a_budget(void) {
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        static obstacles all;
        for (int draw = 0; draw < 40; ++draw) {
            const body moved = draw_moved(0, 3, check_uniform(0.5, 4));
            spt_settings given = spt_settings_default();
            draw_obstacles(&run, &all, 1, 0);
            for (given.budget = 0; given.budget <= 64; given.budget = given.budget * 2 + 1) {
                const contact found = collide(&run, &all, &given, &moved, 0);
                const double exact = least_of_all(&all, &moved) - (double)moved.radius;
                CHECK_SAY((double)found.distance <= exact, "budget %u: %.9g, truth %.9g",
                          given.budget, (double)found.distance, exact);
            }
        }
    }
}

/* ---- Known cases --------------------------------------------------------------------------- */

static void collide_known(void) {
    static const struct {
        body moved;
        double distance, normal[3];
        int32_t component;
    } cases[] = {
        {{{0, 3, 0}, {0, 5, 0}, 0.5f}, 1.5, {0, 1, 0}, 0},           /* above the unit ball */
        {{{0, 5, 0}, {0, 3, 0}, 0.5f}, 1.5, {0, 1, 0}, 0},           /* the other way round */
        {{{-3, 1.5f, 0}, {3, 1.5f, 0}, 0.75f}, -0.25, {0, 1, 0}, 0}, /* across it, and in it */
        {{{0, 0.5f, 0}, {0, 0.75f, 0}, 0.25f}, -0.75, {0, 1, 0}, 0}, /* its axis in it, too */
        {{{2, -1.5f, 0}, {5, -1.5f, 0}, 0.25f}, 0.25, {0, 1, 0}, 1}, /* over the floor y = -2 */
        {{{9, -1, 0}, {9, 4, 0}, 0.5f}, 0.5, {0, 1, 0}, 1},
        {{{9, -3, 0}, {9, 4, 0}, 0.5f}, -1.5, {0, 1, 0}, 1},
    };
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        static obstacles all;
        spt_settings given = spt_settings_default();
        all.bodies[0] = surface_sphere(0, 0, 0, 1);
        all.bodies[0].factor = 2;
        all.bodies[1] = surface_plane(-2);
        surround(&run, &all, 2);
        given.epsilon = 0.1f;
        for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
            const contact found = collide(&run, &all, &given, &cases[i].moved, 0);
            const double distance = (double)found.distance;
            CHECK_SAY(distance <= cases[i].distance && distance >= cases[i].distance - 0.1 - 1e-6,
                      "case %zu: %g for %g", i, distance, cases[i].distance);
            CHECK_SAY(found.component == cases[i].component, "case %zu: %d", i, found.component);
            if (i == 2) continue; /* anywhere within a tolerance of the middle */
            for (int axis = 0; axis < 3; ++axis) {
                CHECK_SAY(fabs((double)found.normal[axis] - cases[i].normal[axis]) <= 3e-3,
                          "case %zu: normal %g", i, (double)found.normal[axis]);
            }
        }
    }
}

static void collide_not_finite(void) {
    const float bad[] = {NAN, INFINITY, -INFINITY};
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        static obstacles all;
        const spt_settings given = spt_settings_default();
        all.bodies[0] = surface_sphere(0, 0, 0, 1);
        surround(&run, &all, 1);
        for (int i = 0; i < 7 * 3; ++i) {
            body moved = {{0, 3, 0}, {0, 5, 0}, 0.5f};
            contact found;
            *(i % 7 < 3   ? &moved.from[i % 7]
              : i % 7 < 6 ? &moved.to[i % 7 - 3]
                          : &moved.radius) = bad[i / 7];
            found = collide(&run, &all, &given, &moved, 0);
            CHECK_SAY(check_same_bits(found.distance, INFINITY) && found.component == -1,
                      "case %d: %g of %d", i, (double)found.distance, found.component);
            for (int axis = 0; axis < 3; ++axis) CHECK(fabsf(found.normal[axis]) <= 0);
        }
    }
}

static void collide_refuses(void) {
    static obstacles all;
    spt_settings settings = spt_settings_default();
    const body moved = {{0, 3, 0}, {0, 5, 0}, 0.5f};
    float distance = 0.75f;
    surface_run run = surface_runs(0);
    spt_bodies bodies, without;
    spt_contacts contacts;
    CHECK(surface_next(&run));
    all.bodies[0] = surface_sphere(0, 0, 0, 1);
    surround(&run, &all, 1);
    memset(&bodies, 0, sizeof bodies);
    memset(&contacts, 0, sizeof contacts);
    bodies.from = spt_vectors_of(moved.from);
    bodies.radius.first = &moved.radius;
    contacts.distance.first = &distance;
    without = bodies;
    without.from.axis[1].first = NULL;
#define REFUSED(...) CHECK(spt_collide(__VA_ARGS__) == SPT_BAD_ARGUMENT)
    REFUSED(NULL, 1, &settings, 1, &bodies, &contacts);
    REFUSED(all.fields, 0, &settings, 1, &bodies, &contacts);
    REFUSED(all.fields, 1, NULL, 1, &bodies, &contacts);
    REFUSED(all.fields, 1, &settings, 1, NULL, &contacts);
    REFUSED(all.fields, 1, &settings, 1, &bodies, NULL);
    REFUSED(all.fields, 1, &settings, 1, &without, &contacts);
    settings.epsilon = 0;
    REFUSED(all.fields, 1, &settings, 1, &bodies, &contacts);
#undef REFUSED
    CHECK(check_same_bits(distance, 0.75f));
    settings.epsilon = 1e-4f;
    CHECK(spt_collide(all.fields, 1, &settings, 1, &bodies, &contacts) == SPT_OK);
    CHECK_SAY(fabs((double)distance - 1.5) <= 1e-4, "%.9g", (double)distance);
}

void suite_surface_collide(void) {
    RUN(collide_balls);
    RUN(collide_capsules);
    RUN(collide_on_a_budget);
    RUN(collide_known);
    RUN(collide_not_finite);
    RUN(collide_refuses);
}
