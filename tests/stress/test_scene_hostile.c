/* SPDX-License-Identifier: MIT
 *
 * Rows A1 to A9 and D3 for scenes: a component that answers with anything harms only the rays that
 * ask it, and every ray ends within its budget; and the numbers of components, from one that must
 * be spt_trace() to 20 000. */
#include "test_scene_cases.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- One ray among others ------------------------------------------------------------------- */

enum { beside = 16 };

/* Far away from everything, but for rays of one x. */
typedef struct trap {
    float at_x, value;
} trap;

static float trap_distance(const void *data, float x, float y, float z) {
    const trap *bad = data;
    (void)y, (void)z;
    return check_same_bits(x, bad->at_x) ? bad->value : 50.0f;
}

static spt_ray ray_beside(int index) {
    spt_ray ray = stress_base().ray; /* along z */
    ray.origin[0] = 0.1f * (float)index;
    ray.t_max = 40.0f;
    return ray;
}

static void add_part(union_scene *world, spt_field fields[union_parts + 1],
                     union_part parts[union_parts + 1], int place, union_part part,
                     const stress_way *way) {
    for (int i = 0, from = 0; i <= union_parts; ++i) {
        parts[i] = i == place ? part : world->parts[from];
        fields[i] = i == place ? union_field(way, &parts[i]) : world->fields[from];
        fields[i].user = &parts[i];
        from += i != place;
    }
    world->scene.fields = fields;
    world->scene.count = union_parts + 1;
    world->scene.materials = NULL;
}

static void expect_trapped(const trap *bad, const spt_hit *hit, const spt_hit *clean) {
    if (stress_is_nan(bad->value) || bad->value < -FLT_MAX) {
        CHECK(hit->outcome == SPT_NONFINITE && check_same_bits(hit->t, 0.0f));
        CHECK(check_same_bits(hit->residual, bad->value) && hit->component == -1);
    } else if (bad->value > 1.0f) { /* nothing there: the others decide */
        CHECK(hit->outcome == clean->outcome && check_same_bits(hit->t, clean->t));
        CHECK(hit->component == clean->component);
    } else { /* within the tolerance of everywhere */
        CHECK(hit->outcome == SPT_HIT && check_same_bits(hit->t, 0.0f));
    }
}

static void A2b_union_one_bad_ray_among_others(void) {
    const float values[] = {stress_nan(), -stress_infinity(), stress_infinity(), 3e38f, 1e-42f};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        const spt_settings settings = union_settings(&way);
        for (int i = 0; i < 5 * beside; ++i) {
            static union_scene world;
            static spt_field fields[union_parts + 1];
            static union_part parts[union_parts + 1];
            const int victim = i / 5, place = i % (union_parts + 1);
            trap bad = {-1.0f, values[i % 5]};
            spt_ray rays[beside];
            spt_hit clean[beside], hits[beside];
            for (int k = 0; k < beside; ++k) rays[k] = ray_beside(k);
            union_base(&world, &way);
            add_part(&world, fields, parts, place, union_part_of(trap_distance, &bad), &way);
            union_trace(&way, &world.scene, parts, &settings, beside, rays, clean);
            bad.at_x = rays[victim].origin[0];
            union_trace(&way, &world.scene, parts, &settings, beside, rays, hits);
            for (int k = 0; k < beside; ++k) {
                if (k != victim) CHECK(stress_same_hit(&hits[k], &clean[k]));
            }
            expect_trapped(&bad, &hits[victim], &clean[victim]);
        }
    }
}

/* ---- Components that answer with anything ---------------------------------------------------- */

static float nan_behind(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)y;
    return z > 7.5f ? stress_nan() : 8.0f - z;
}

static float minus_infinity_inside(const void *data, float x, float y, float z) {
    const float distance = stress_sphere_distance(data, x, y, z);
    return distance < 0.05f ? -stress_infinity() : distance;
}

static float plus_infinity_behind(const void *data, float x, float y, float z) {
    return z > 7.0f ? stress_infinity() : stress_sphere_distance(data, x, y, z);
}

static float jump(const void *data, float x, float y, float z) {
    (void)data;
    return z + 0.1f * x < 6.5f + y ? 0.5f : -0.5f;
}

static float steep(const void *data, float x, float y, float z) {
    return 3.0f * stress_sphere_distance(data, x, y, z);
}

static float noise(const void *data, float x, float y, float z) {
    uint32_t hash = check_bits(x) * 2654435761u ^ check_bits(y) * 40503u ^ check_bits(z);
    (void)data;
    hash = (hash ^ hash >> 15) * 2246822519u;
    return stress_from_bits(hash ^ hash >> 13);
}

/* No surface, and never far from one: takes every evaluation there is. */
static float creep(const void *data, float x, float y, float z) {
    (void)data;
    return 0.02f + 0.005f * sinf(40.0f * z + x - y);
}

static float denormal(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)y, (void)z;
    return 1e-42f;
}

static float deep_inside(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)y, (void)z;
    return -FLT_MAX;
}

static stress_distance_fn *const hostile[] = {
    nan_behind, minus_infinity_inside, plus_infinity_behind, jump, steep, noise, creep, denormal,
    deep_inside};
enum { hostile_count = sizeof hostile / sizeof *hostile };

static const stress_sphere in_the_way = {{0.3f, -0.3f, 5.0f}, 0.8f};

/* Each result is that of the component that is reached first, as spt_trace() gives it. */
static void A1d_union_with_a_hostile_component(void) {
    static spt_ray rays[union_rays];
    static spt_hit hits[union_rays];
    static union_expected expected[union_rays];
    static union_scene world;
    static spt_field fields[union_parts + 1];
    static union_part parts[union_parts + 1];
    for (size_t i = 0; i < union_rays; ++i) rays[i] = union_ray(i);
    for (stress_way way = stress_ways(0); stress_next(&way);) {
        for (int i = 0; i < 2 * hostile_count; ++i) {
            const size_t count = 16 + (size_t)i * 13;
            stress_distance_fn *const distance = hostile[i % hostile_count];
            const union_part part = union_part_of(distance, &in_the_way);
            spt_settings settings = union_settings(&way);
            union_base(&world, &way);
            add_part(&world, fields, parts, i % (union_parts + 1), part, &way);
            settings.flags = i < hostile_count ? 0 : 1 + (uint32_t)i % 3;
            union_trace(&way, &world.scene, parts, &settings, count, rays, hits);
            union_separately(&world.scene, &settings, count, rays, expected);
            const size_t decided = union_compare(expected, count, hits);
            const int endless = distance == creep;
            CHECK_SAY(endless || decided > count / 2, "hostile %d: %u of %u decided", i,
                      (unsigned)decided, (unsigned)count);
        }
    }
}

/* ---- Budgets --------------------------------------------------------------------------------- */

static void D3b_union_budgets(void) {
    static const uint32_t budgets[] = {0, 1, 2, 3, 4, 5, 7, 11, 16, 30};
    static spt_ray rays[100];
    static spt_hit hits[100];
    static union_scene world;
    for (size_t i = 0; i < 100; ++i) rays[i] = union_ray(2 * i);
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        spt_settings settings = union_settings(&way);
        for (int i = 0; i < 10; ++i) {
            union_base(&world, &way);
            settings.budget = budgets[i];
            union_trace(&way, &world.scene, world.parts, &settings, 100, rays, hits);
            for (int k = 0; k < 100 && budgets[i] == 0; ++k) {
                CHECK(hits[k].outcome == SPT_LIMIT && check_same_bits(hits[k].t, 0.0f));
                CHECK(check_same_bits(hits[k].residual, stress_infinity()));
            }
        }
    }
}

static void Q9b_union_budget_of_what_was_used(void) {
    static union_scene world;
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (size_t i = 0; i < 12; ++i) {
            const spt_ray ray = union_ray(23 * i);
            spt_settings settings = union_settings(&way);
            spt_hit hit, again;
            union_base(&world, &way);
            union_trace(&way, &world.scene, world.parts, &settings, 1, &ray, &hit);
            CHECK(hit.outcome != SPT_LIMIT);
            if (hit.evaluations == 0) continue;
            settings.budget = hit.evaluations;
            union_trace(&way, &world.scene, world.parts, &settings, 1, &ray, &again);
            CHECK(stress_same_hit(&hit, &again));
            settings.budget = hit.evaluations - 1;
            union_trace(&way, &world.scene, world.parts, &settings, 1, &ray, &again);
            CHECK(again.outcome == SPT_LIMIT && again.evaluations == settings.budget);
            CHECK(again.t <= hit.t); /* free up to there */
        }
    }
}

/* ---- Numbers of components ------------------------------------------------------------------- */

/* A union of one is spt_trace(), with every bit of every result. */
static void scene_of_one_component(void) {
    static const uint32_t budgets[] = {600, 5, 1, 0};
    static spt_ray rays[100];
    static spt_hit hits[100], right[100];
    static union_scene world;
    for (size_t i = 0; i < 100; ++i) rays[i] = union_ray(2 * i);
    rays[7].direction[1] = stress_nan();
    rays[8].t_max = -1.0f;
    rays[9].t_max = stress_infinity();
    rays[10].origin[2] = 10.0f; /* inside */
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < union_parts * 16; ++i) {
            spt_settings settings = union_settings(&way);
            const spt_rays in = spt_rays_of(rays);
            const spt_hits out = spt_hits_of(right);
            union_base(&world, &way);
            const spt_field *const field = &world.fields[i % union_parts];
            world.scene.fields = field;
            world.scene.count = 1;
            settings.budget = budgets[i / union_parts % 4];
            settings.flags = (uint32_t)(i / union_parts / 4);
            union_trace(&way, &world.scene, &world.parts[i % union_parts], &settings, 100, rays,
                        hits);
            if ((field->flags & SPT_FIELD_CONVEX) != 0) settings.method = spt_convex();
            CHECK(spt_trace(field, &settings, 100, &in, &out, NULL) == SPT_OK);
            for (int k = 0; k < 100; ++k) {
                CHECK_SAY(
                    stress_same_hit(&hits[k], &right[k]),
                    "part %d, flags %x, budget %u, ray %d: outcome %d at %.9g after %u, alone "
                    "%d at %.9g after %u",
                    i % union_parts, (unsigned)settings.flags, (unsigned)settings.budget, k,
                    (int)hits[k].outcome, (double)hits[k].t, (unsigned)hits[k].evaluations,
                    (int)right[k].outcome, (double)right[k].t, (unsigned)right[k].evaluations);
            }
        }
    }
}

/* Of components that are reached at the same t the first one is reported, whichever was asked
 * first. */
static void scene_ties(void) {
    static const stress_sphere ball = {{0.0f, 0.0f, 9.0f}, 1.0f}, far = {{0.0f, 5.0f, 9.0f}, 1.0f};
    const spt_ray ray = stress_base().ray; /* both balls of radius 1 at 9, and the larger: t = 8 */
    static const stress_sphere large = {{0.0f, 0.0f, 16.0f}, 8.0f};
    const stress_sphere *const orders[][4] = {{&ball, &ball, &ball, &ball},
                                              {&far, &ball, &large, &ball},
                                              {&far, &large, &ball, &ball},
                                              {&large, &far, &far, &ball}};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        const spt_settings settings = union_settings(&way);
        for (int i = 0; i < 4; ++i) {
            union_part parts[4];
            spt_field fields[4];
            spt_hit hit;
            spt_scene scene = spt_scene_default();
            for (int k = 0; k < 4; ++k) {
                parts[k] = union_part_of(stress_sphere_distance, orders[i][k]);
                fields[k] = union_field(&way, &parts[k]);
            }
            scene.fields = fields;
            scene.count = 4;
            union_trace(&way, &scene, parts, &settings, 1, &ray, &hit);
            stress_expect(&hit, SPT_HIT, 8.0, 0.0);
            CHECK_SAY(hit.component == (i == 1 || i == 2 ? 1 : 0), "order %d: component %d", i,
                      (int)hit.component);
        }
    }
}

/* The ball that the ray meets at 8, and one beside the ray that makes the first step to it short. */
static float ball_and_another(const void *data, float x, float y, float z) {
    static const stress_sphere aside = {{0.0f, 6.0f, 0.0f}, 1.0f};
    const float ahead = stress_sphere_distance(data, x, y, z);
    const float beside_it = stress_sphere_distance(&aside, x, y, z);
    return ahead < beside_it ? ahead : beside_it;
}

/* The one with the short step is on its way while the other one waits at 8. */
static void scene_ties_of_different_marches(void) {
    static const stress_sphere ball = {{0.0f, 0.0f, 9.0f}, 1.0f};
    const spt_ray ray = stress_base().ray;
    for (stress_way way = stress_ways(0); stress_next(&way);) {
        const spt_settings settings = union_settings(&way);
        for (int i = 0; i < 2; ++i) {
            union_part parts[2];
            spt_field fields[2];
            spt_scene scene = spt_scene_default();
            spt_hit hit;
            for (int k = 0; k < 2; ++k) {
                parts[k] = union_part_of(i == k ? ball_and_another : stress_sphere_distance, &ball);
                fields[k] = union_field(&way, &parts[k]);
            }
            scene.fields = fields;
            scene.count = 2;
            union_trace(&way, &scene, parts, &settings, 1, &ray, &hit);
            stress_expect(&hit, SPT_HIT, 8.0, 1e-6);
            if (check_same_bits(hit.t, 8.0f)) CHECK(hit.component == 0);
        }
    }
}

/* A grid of balls, each in a bound, from one end: few of them are asked, and the first is found. */
static void trace_grid(stress_way *way, size_t count) {
    enum { beams = 24 };
    union_part *const parts = malloc(count * sizeof *parts);
    spt_field *const fields = malloc(count * sizeof *fields);
    spt_bound *const bounds = malloc(count * sizeof *bounds);
    stress_sphere *const balls = malloc(count * sizeof *balls);
    spt_scene scene = spt_scene_default();
    const spt_settings settings = union_settings(way);
    spt_ray rays[beams];
    spt_hit hits[beams];
    for (size_t i = 0; i < count; ++i) {
        const stress_sphere ball = {
            {(float)(i % 25) - 12.0f, (float)(i / 25 % 20) - 9.5f, 10.0f + 3.0f * (float)(i / 500)},
            0.2f};
        balls[i] = ball;
        bounds[i] = spt_bound_sphere(ball.center[0], ball.center[1], ball.center[2], 0.25f);
        parts[i] = union_part_of(stress_sphere_distance, &balls[i]);
        fields[i] = union_field(way, &parts[i]);
        fields[i].bound = &bounds[i];
    }
    scene.fields = fields;
    scene.count = count;
    for (int i = 0; i < beams; ++i) {
        rays[i] = stress_base().ray;
        rays[i].origin[0] = (float)(i % 12) - 6.0f;
        rays[i].origin[1] = (float)(i % 5) + 0.5f + 0.0625f * (float)(i / 3);
        rays[i].t_max = 1e4f;
    }
    union_trace(way, &scene, parts, &settings, beams, rays, hits);
    for (int i = 0; i < beams; ++i) {
        const double aside = 0.0625 * (double)(i / 3);
        if (aside > 0.15 && aside < 0.3) continue; /* grazing */
        stress_expect(&hits[i], aside > 0.2 ? SPT_MISS : SPT_HIT,
                      10.0 - sqrt(fmax(0.0, 0.04 - aside * aside)), 2e-4); /* oblique */
        CHECK_SAY(hits[i].evaluations <= 60, "%u evaluations", (unsigned)hits[i].evaluations);
        if (hits[i].outcome == SPT_HIT) {
            const stress_sphere *const ball = &balls[hits[i].component];
            CHECK(check_same_bits(ball->center[0], rays[i].origin[0]));
            CHECK(check_same_bits(ball->center[2], 10.0f));
        }
    }
    free(parts);
    free(fields);
    free(bounds);
    free(balls);
}

static void scene_of_1000_components(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_ONCE); stress_next(&way);) {
        trace_grid(&way, 1000);
    }
}

static void scene_of_20000_components(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_ONCE); stress_next(&way);) {
        if (way.method == spt_adaptive() || way.method == spt_convex()) trace_grid(&way, 20000);
    }
}

void suite_scene_hostile(void) {
    RUN(A2b_union_one_bad_ray_among_others);
    RUN(A1d_union_with_a_hostile_component);
    RUN(D3b_union_budgets);
    RUN(Q9b_union_budget_of_what_was_used);
    RUN(scene_of_one_component);
    RUN(scene_ties);
    RUN(scene_ties_of_different_marches);
    RUN(scene_of_1000_components);
    RUN(scene_of_20000_components);
}
