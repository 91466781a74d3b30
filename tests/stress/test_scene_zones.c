/* SPDX-License-Identifier: MIT
 *
 * Empty zones (Szécsi et al. 2016, section 8.4): where rays end among them, against intervals in
 * double, and zones of hostile sizes, places and numbers, through which every ray must find its
 * end. */
#include "test_scene_cases.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Balls and zones in double --------------------------------------------------------------- */

enum { most_zones = 40, balls = 4, beams = 40 };

typedef struct interval {
    double low, high;
} interval;

/* Where a ray of unit direction is inside a ball; low > high: nowhere. */
static interval inside(const spt_ray *ray, const float center[3], float radius) {
    double along = 0.0, square = 0.0, length = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double to = (double)center[axis] - (double)ray->origin[axis];
        const double way = (double)ray->direction[axis];
        along += to * way;
        square += to * to;
        length += way * way;
    }
    const double middle = along / length;
    const double half = ((double)radius * (double)radius - square + along * middle) / length;
    interval within = {1.0, 0.0};
    if (half >= 0.0) {
        within.low = middle - sqrt(half);
        within.high = middle + sqrt(half);
    }
    return within;
}

typedef struct truth {
    double t; /* +infinity: a miss */
    int component;
    double gap; /* how far, in t, the nearest other answer is */
} truth;

static interval hidden_by(const spt_zone *zone, const spt_ray *ray, int component) {
    const interval nothing = {1.0, 0.0};
    if (zone->component != -1 && zone->component != component) return nothing;
    return inside(ray, zone->center, zone->radius);
}

/* The first point of a ball's interval that no zone hides; gap: how little would change that. */
static double first_seen(const spt_ray *ray, const spt_scene *scene, int component, interval solid,
                         double *gap) {
    double t = solid.low;
    size_t ended = SIZE_MAX; /* the zone whose end is t */
    for (int moved = 1; moved;) {
        moved = 0;
        for (size_t i = 0; i < scene->zone_count; ++i) {
            const interval hidden = hidden_by(&scene->zones[i], ray, component);
            if (i == ended || !(hidden.low <= t && t < hidden.high)) continue;
            t = hidden.high;
            ended = i;
            moved = 1;
        }
    }
    for (size_t i = 0; i < scene->zone_count; ++i) {
        const interval hidden = hidden_by(&scene->zones[i], ray, component);
        if (i == ended || hidden.low > hidden.high) continue;
        *gap = fmin(*gap, fmin(fabs(hidden.low - t), fabs(hidden.high - t)));
        *gap = fmin(*gap, hidden.high - hidden.low); /* grazed, or met only by a little less luck */
    }
    *gap = fmin(*gap, fabs(solid.high - t));
    return t < solid.high ? t : (double)INFINITY;
}

static truth truth_of(const spt_ray *ray, const spt_scene *scene, const stress_sphere *spheres) {
    truth first = {(double)INFINITY, -1, (double)INFINITY};
    double second = (double)INFINITY;
    for (int i = 0; i < balls; ++i) {
        const interval solid = inside(ray, spheres[i].center, spheres[i].radius);
        /* Whether it is met at all must be clear: both with a little more and less radius. */
        const interval more = inside(ray, spheres[i].center, spheres[i].radius + 0.01f);
        if ((more.low > more.high) != (solid.low > solid.high)) first.gap = 0.0;
        if (solid.low > solid.high) continue;
        first.gap = fmin(first.gap, (solid.high - solid.low) / 4.0);
        const double t = first_seen(ray, scene, i, solid, &first.gap);
        if (t < first.t) {
            second = first.t;
            first.t = t;
            first.component = i;
        } else {
            second = fmin(second, t);
        }
    }
    first.gap = fmin(first.gap, second - first.t >= 0.0 ? second - first.t : first.gap);
    return first;
}

/* ---- Worlds ---------------------------------------------------------------------------------- */

typedef struct zoned {
    stress_sphere spheres[balls];
    spt_zone zones[most_zones];
    union_part parts[balls];
    spt_field fields[balls];
    spt_scene scene;
} zoned;

static float uniform(double low, double high) {
    return (float)check_uniform(low, high);
}

static void draw(zoned *world, const stress_way *way, size_t zones) {
    world->scene = spt_scene_default();
    for (int i = 0; i < balls; ++i) {
        const stress_sphere sphere = {{uniform(-1, 1), uniform(-1, 1), uniform(4, 12)},
                                      uniform(0.3, 1.5)};
        world->spheres[i] = sphere;
        world->parts[i] = union_part_of(stress_sphere_distance, &world->spheres[i]);
        world->fields[i] = union_field(way, &world->parts[i]);
    }
    for (size_t i = 0; i < zones; ++i) {
        const spt_zone zone = {{uniform(-1, 1), uniform(-1, 1), uniform(2, 14)},
                               uniform(0.1, 1.5),
                               (int32_t)(check_random() % (2 * balls)) - balls};
        world->zones[i] = zone;
        if (zone.component < 0) world->zones[i].component = -1;
    }
    world->scene.fields = world->fields;
    world->scene.count = balls;
    world->scene.zones = zones != 0 ? world->zones : NULL;
    world->scene.zone_count = zones;
}

static void draw_rays(spt_ray rays[beams]) {
    for (int i = 0; i < beams; ++i) {
        double length = 0.0, direction[3];
        for (int axis = 0; axis < 3; ++axis) {
            direction[axis] = check_uniform(-0.12, 0.12) + (axis == 2);
            length += direction[axis] * direction[axis];
        }
        rays[i] = stress_base().ray;
        for (int axis = 0; axis < 3; ++axis) {
            rays[i].direction[axis] = (float)(direction[axis] / sqrt(length));
        }
    }
}

/* A tolerance of 1e-4 along rays that meet surfaces at a slope of at least that of a chord of
 * 4 gap: cos >= 2 gap / radius, 1e-4 / (0.04 / 1.5) = 4e-3. */
static void zones_random_worlds(void) {
    enum { worlds = 12 };
    static zoned world;
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        size_t hits_seen = 0, cuts = 0, misses = 0;
        for (int i = 0; i < worlds; ++i) {
            const spt_settings settings = union_settings(&way);
            spt_ray rays[beams];
            spt_hit hits[beams];
            draw(&world, &way, (size_t)i * most_zones / worlds);
            draw_rays(rays);
            union_trace(&way, &world.scene, world.parts, &settings, beams, rays, hits);
            for (int k = 0; k < beams; ++k) {
                const truth right = truth_of(&rays[k], &world.scene, world.spheres);
                if (right.gap < 0.02) continue;
                stress_expect(&hits[k], right.component < 0 ? SPT_MISS : SPT_HIT, right.t, 4e-3);
                CHECK_SAY(hits[k].component == right.component, "world %d, ray %d: %d for %d", i, k,
                          (int)hits[k].component, right.component);
                hits_seen += right.component >= 0;
                misses += right.component < 0;
                cuts += right.component >= 0 && hits[k].residual < -0.01f;
            }
        }
        CHECK_SAY(hits_seen > 50 && misses > 20 && cuts > 5, "%u hits, %u misses, %u cuts",
                  (unsigned)hits_seen, (unsigned)misses, (unsigned)cuts);
    }
}

/* Jumps cost no evaluations: with the budget of what was used a ray ends the same way, wherever the
 * zones are, also where it ends before the next one. */
static void zones_and_budgets(void) {
    static zoned world;
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        for (int i = 0; i < 30; ++i) {
            spt_settings settings = union_settings(&way);
            spt_ray rays[beams];
            spt_hit hit, again;
            draw(&world, &way, 1 + (size_t)i % 6);
            draw_rays(rays);
            rays[0].t_max = uniform(2, 14);
            union_trace(&way, &world.scene, world.parts, &settings, 1, rays, &hit);
            if (hit.outcome == SPT_LIMIT || hit.evaluations == 0) continue;
            settings.budget = hit.evaluations;
            union_trace(&way, &world.scene, world.parts, &settings, 1, rays, &again);
            CHECK_SAY(stress_same_hit(&hit, &again),
                      "outcome %d at %.9g, with a budget of %u outcome %d at %.9g, t_max %.9g",
                      (int)hit.outcome, (double)hit.t, (unsigned)settings.budget,
                      (int)again.outcome, (double)again.t, (double)rays[0].t_max);
        }
    }
}

/* A zone that no ray meets changes no bit, wherever it is. */
static void zones_far_away_change_nothing(void) {
    static union_scene world;
    static spt_ray rays[union_rays];
    static spt_hit hits[union_rays], right[union_rays];
    const spt_zone zones[] = {{{500.0f, 0.0f, 0.0f}, 3.0f, -1},
                              {{0.0f, 0.0f, -9.0f}, 8.5f, 2},
                              {{0.0f, 900.0f, 1e5f}, 1.0f, 0},
                              {{0.0f, 0.0f, 1e18f}, 1e17f, -1}};
    for (size_t i = 0; i < union_rays; ++i) rays[i] = union_ray(i);
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        const spt_settings settings = union_settings(&way);
        union_base(&world, &way);
        union_trace(&way, &world.scene, world.parts, &settings, 100, rays, right);
        world.scene.zones = zones;
        world.scene.zone_count = sizeof zones / sizeof *zones;
        union_trace(&way, &world.scene, world.parts, &settings, 100, rays, hits);
        for (int i = 0; i < 100; ++i) CHECK(stress_same_hit(&hits[i], &right[i]));
    }
}

/* ---- Hostile zones --------------------------------------------------------------------------- */

/* The base sphere (9 .. 11 along z) behind, in and without zones; t of the hit, 0: a miss. */
static void expect_along_z(stress_way *way, const spt_zone *zones, size_t count, double t,
                           double tolerance) {
    static const stress_sphere sphere = {{0.0f, 0.0f, 10.0f}, 1.0f};
    union_part part = union_part_of(stress_sphere_distance, &sphere);
    const spt_field field = union_field(way, &part);
    const spt_settings settings = union_settings(way);
    const spt_ray ray = stress_base().ray;
    spt_scene scene = spt_scene_default();
    spt_hit hit;
    scene.fields = &field;
    scene.count = 1;
    scene.zones = zones;
    scene.zone_count = count;
    union_trace(way, &scene, &part, &settings, 1, &ray, &hit);
    stress_expect(&hit, t > 0.0 ? SPT_HIT : SPT_MISS, t, tolerance);
}

static spt_zone zone_at(float z, float radius) {
    const spt_zone zone = {{0.0f, 0.0f, z}, radius, -1};
    return zone;
}

static void zones_along_the_ray(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        const spt_zone nested[] = {zone_at(5.0f, 3.0f), zone_at(5.0f, 2.0f), zone_at(5.0f, 1.0f),
                                   zone_at(5.5f, 2.5f), zone_at(4.5f, 2.5f)};
        const spt_zone hidden[] = {zone_at(10.0f, 1.5f)};
        const spt_zone halves[] = {zone_at(9.0f, 1.25f), zone_at(11.0f, 1.25f)};
        const spt_zone front[] = {zone_at(8.5f, 1.0f)};
        const spt_zone twice[] = {zone_at(8.5f, 1.0f), zone_at(8.5f, 1.0f), zone_at(9.0f, 0.5f)};
        const spt_zone origin[] = {zone_at(0.0f, 1.0f), zone_at(1.0f, 1.0f), zone_at(2.0f, 1.0f)};
        const spt_zone whole[] = {zone_at(50.0f, 60.0f)};
        const spt_zone tiny[] = {zone_at(3.0f, 1e-30f), zone_at(9.0f, FLT_MIN),
                                 zone_at(4.0f, 1e-7f)};
        const spt_zone vast[] = {zone_at(3e38f, 1e38f), zone_at(-3e38f, 2e38f)};
        expect_along_z(&way, nested, 5, 9.0, 1e-4);
        expect_along_z(&way, hidden, 1, 0.0, 0.0);
        expect_along_z(&way, halves, 2, 0.0, 0.0);
        expect_along_z(&way, front, 1, 9.5, 1e-4);
        expect_along_z(&way, twice, 3, 9.5, 1e-4);
        expect_along_z(&way, origin, 3, 9.0, 1e-4);
        expect_along_z(&way, whole, 1, 0.0, 0.0);
        expect_along_z(&way, tiny, 3, 9.0, 2e-4);
        expect_along_z(&way, vast, 2, 9.0, 1e-4);
    }
}

/* Thousands: a chain through which the ray must jump link by link, and one zone many times. */
static void zones_in_thousands(void) {
    enum { links = 4000, copies = 1 << 16 };
    spt_zone *const zones = malloc(copies * sizeof *zones);
    CHECK(zones != NULL);
    if (zones == NULL) return;
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_ONCE); stress_next(&way);) {
        for (int i = 0; i < links; ++i) { /* from 0.5 to 9.5, in an order of no help */
            const int place = (int)((unsigned)i * 2477u % links);
            zones[i] = zone_at(1.0f + 8.0f * (float)place / (links - 1), 0.5f);
        }
        expect_along_z(&way, zones, links, 9.5, 1e-4);
        for (int i = 0; i < links; ++i) { /* each begins where the one before it ends */
            zones[i] = zone_at(1.0f + 0.0009765625f * (float)(2 * i + 1), 0.0009765625f);
        }
        expect_along_z(&way, zones, links, 9.0, 1e-4);
        for (int i = 0; i < copies; ++i) zones[i] = zone_at(8.5f, 1.0f);
        expect_along_z(&way, zones, copies, 9.5, 1e-4);
    }
    free(zones);
}

/* Zones of any floats: every ray ends, and within its budget. */
static void zones_of_any_numbers(void) {
    static const uint32_t worst[] = {0x00000001u, 0x7f7fffffu, 0x80000000u, 0u,
                                     0x00800000u, 0xff7fffffu, 0x5e5e5e5eu, 0x3f800001u};
    static zoned world;
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        for (int i = 0; i < 25; ++i) {
            spt_settings settings = union_settings(&way);
            spt_ray rays[beams];
            spt_hit hits[beams];
            settings.budget = 40;
            draw(&world, &way, 1 + (size_t)i % most_zones);
            for (size_t k = 0; k < world.scene.zone_count; ++k) {
                const float odd = stress_from_bits(worst[check_random() % 8]);
                const uint32_t where = check_random() % 8;
                if (where < 3) world.zones[k].center[where] = odd;
                if (where == 3 && odd > 0.0f) world.zones[k].radius = odd;
            }
            draw_rays(rays);
            if (i % 2 != 0) rays[i % beams].t_max = stress_infinity();
            union_trace(&way, &world.scene, world.parts, &settings, beams, rays, hits);
        }
    }
}

void suite_scene_zones(void) {
    RUN(zones_random_worlds);
    RUN(zones_and_budgets);
    RUN(zones_far_away_change_nothing);
    RUN(zones_along_the_ray);
    RUN(zones_in_thousands);
    RUN(zones_of_any_numbers);
}
