/* SPDX-License-Identifier: MIT
 *
 * Empty zones (Szécsi et al. 2016, section 8.4) against the truth in double: what lies in one is
 * not there, what lies beyond is found, and what is not touched does not change. What zones cut is
 * in test_scene_cuts.c. */
#include "scene_audit.h"
#include "scene_draw.h"
#include "scene_union.h"
#include "harness.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <string.h>

enum { draws = 30, rays_drawn = 120 };

static drawn_scene made;
static scene_ray rays[rays_drawn];
static union_truth truth[rays_drawn];
static spt_hit hits[rays_drawn], others[rays_drawn];

/* Between a zone and what it contains or leaves outside: above every tolerance of these tests. */
static const double margin = 0.05;

static void visible_values(const void *user, size_t index, size_t n, const double *x,
                           const double *y, const double *z, double *distance) {
    (void)user;
    scene_component_visible(&made.components[index], n, x, y, z, distance);
}

static union_field visible_union(void) {
    const union_field field = {visible_values, NULL, made.fields, made.scene.count};
    return field;
}

static double apart(const float a[3], const double b[3]) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        square += ((double)a[axis] - b[axis]) * ((double)a[axis] - b[axis]);
    }
    return sqrt(square);
}

/* ---- Zones around whole bodies -------------------------------------------------------------- */

/* 1: a zone has the whole body in it, 0: nothing of it, -1: neither beyond doubt. */
static int contains(const spt_zone *zone, const drawn_body *body) {
    double center[3], radius, distance;
    scene_body_ball(body, center, &radius);
    if (body->kind == BODY_PLANE) {
        distance = (double)zone->center[1] - center[1];
        return distance > (double)zone->radius + margin ? 0 : -1;
    }
    distance = apart(zone->center, center);
    if (distance + radius + margin < (double)zone->radius) return 1;
    return distance > radius + (double)zone->radius + margin ? 0 : -1;
}

/* Hides what a zone contains; 0 if the zone cuts something. */
static int hide(const spt_zone *zone) {
    for (int pass = 0; pass < 2; ++pass) {
        for (size_t i = 0; i < made.scene.count; ++i) {
            drawn_component *component = &made.components[i];
            if (zone->component >= 0 && zone->component != (int32_t)i) continue;
            for (int one = 0; one < component->count; ++one) {
                const int inside = contains(zone, &component->bodies[one]);
                if (inside < 0) return 0;
                if (pass == 1) component->hidden[one] |= inside;
            }
        }
    }
    return 1;
}

/* Zones around bodies, of one component or of all, some of them around the same body. */
static void draw_whole_zones(void) {
    made.scene.zone_count = 0;
    for (int attempt = 0; attempt < 60 && made.scene.zone_count < drawn_zones; ++attempt) {
        spt_zone *zone = &made.zones[made.scene.zone_count];
        const uint32_t index = check_random() % (uint32_t)made.scene.count;
        const drawn_component *component = &made.components[index];
        const drawn_body *body = &component->bodies[check_random() % (uint32_t)component->count];
        double center[3], radius;
        scene_body_ball(body, center, &radius);
        if (body->kind == BODY_PLANE) continue;
        for (int axis = 0; axis < 3; ++axis) {
            zone->center[axis] = (float)(center[axis] + check_uniform(-0.1, 0.1));
        }
        zone->radius = (float)(radius + check_uniform(0.23, 0.6)); /* 0.1 sqrt(3) and the margin */
        zone->component = check_random() % 3 == 0 ? -1 : (int32_t)index;
        made.scene.zone_count += hide(zone) != 0;
    }
}

/* Turns a ray so that it passes a zone at its radius, nearly. */
static void graze(scene_ray *self, const spt_zone *zone) {
    const double near = (double)zone->radius *
                        (1 + pow(10, check_uniform(-8, -2)) * (check_random() % 2 == 0 ? 1 : -1));
    double side[3], to[3], square = 0, along = 0, length = 0, d[3];
    for (int axis = 0; axis < 3; ++axis) {
        to[axis] = (double)zone->center[axis] - (double)self->ray.origin[axis];
        side[axis] = check_uniform(-1, 1);
        square += to[axis] * to[axis];
        along += to[axis] * side[axis];
    }
    if (square < 1.1 * near * near) return;
    for (int axis = 0; axis < 3; ++axis) {
        side[axis] -= along / square * to[axis];
        length += side[axis] * side[axis];
    }
    /* The tangent's sine is near / |to|: towards the center by the cosine, aside by the sine. */
    for (int axis = 0; axis < 3; ++axis) {
        d[axis] = to[axis] * sqrt(1 - near * near / square) + side[axis] * near / sqrt(length);
    }
    for (int axis = 0; axis < 3; ++axis)
        self->ray.direction[axis] = (float)(d[axis] / sqrt(square));
}

/* Turns a ray to where a body may be. */
static void aim(scene_ray *self) {
    const drawn_component *component = &made.components[check_random() % made.scene.count];
    const drawn_body *body = &component->bodies[check_random() % (uint32_t)component->count];
    double d[3], length = 0;
    for (int axis = 0; axis < 3; ++axis) {
        d[axis] = (double)body->center[axis] - (double)self->ray.origin[axis];
        d[axis] += check_uniform(-0.5, 0.5);
        length += d[axis] * d[axis];
    }
    for (int axis = 0; axis < 3; ++axis)
        self->ray.direction[axis] = (float)(d[axis] / sqrt(length));
}

static void draw_rays(void) {
    for (int i = 0; i < rays_drawn; ++i) {
        rays[i] = i % 3 == 0 ? scene_draw_ray() : scene_draw_plain_ray();
        if (i % 4 >= 2) aim(&rays[i]);
        if (i % 4 == 1 && made.scene.zone_count > 0) {
            graze(&rays[i], &made.zones[check_random() % made.scene.zone_count]);
        }
    }
}

/* The scene with its zones is the scene without what they contain. */
static void Q23_zones_hide_whole_bodies(void) {
    size_t clear = 0, clear_hits = 0, changed = 0, sum = 0;
    for (int draw = 0; draw < 2 * draws; ++draw) {
        spt_settings settings = scene_draw_settings();
        const union_field field = {visible_values, NULL, made.fields, 1 + (size_t)draw % 6};
        settings.pixel_radius = 1e-5f;
        scene_draw(&made, field.count, DRAW_UNITED | DRAW_SOLID);
        draw_whole_zones();
        draw_rays();
        union_find_truth(&field, &settings, rays_drawn, rays, truth);
        for (scene_rules walk = scene_first_rule(&made.scene, "zones around bodies");
             scene_next_rule(&walk);) {
            size_t more_hits;
            spt_scene full = made.scene;
            settings.method = walk.method;
            settings.max_lanes = widths[check_random() % width_count];
            scene_run(&made.scene, &settings, rays_drawn, rays, hits);
            clear += union_check(&field, &settings, rays_drawn, rays, truth, hits, &more_hits);
            clear_hits += more_hits;
            sum += rays_drawn;
            full.zone_count = 0;
            scene_run(&full, &settings, rays_drawn, rays, others);
            for (int i = 0; i < rays_drawn; ++i) {
                changed += truth[i].clear && hits[i].component != others[i].component;
            }
        }
    }
    CHECK_SAY(clear > sum / 2 && clear_hits > sum / 5 && changed > sum / 20,
              "%lu clear, %lu hits, %lu hid something, of %lu", (unsigned long)clear,
              (unsigned long)clear_hits, (unsigned long)changed, (unsigned long)sum);
}

/* ---- Zones in free space -------------------------------------------------------------------- */

static double free_radius(const float center[3]) {
    const double x = (double)center[0], y = (double)center[1], z = (double)center[2];
    double least = HUGE_VAL;
    for (size_t i = 0; i < made.scene.count; ++i) {
        double f;
        scene_component_value(&made.components[i], 1, &x, &y, &z, &f);
        least = fmin(least, fabs(f) / (double)made.fields[i].lipschitz);
    }
    return least;
}

/* Checks every rule against the truth of the scene as it is. */
static void check_free(const char *title) {
    spt_settings settings = scene_draw_settings();
    const union_field field = visible_union();
    settings.pixel_radius = 0; /* some rays are 1e4 long */
    union_find_truth(&field, &settings, rays_drawn, rays, truth);
    for (scene_rules walk = scene_first_rule(&made.scene, title); scene_next_rule(&walk);) {
        size_t clear, clear_hits;
        settings.method = walk.method;
        settings.max_lanes = widths[check_random() % width_count];
        scene_run(&made.scene, &settings, rays_drawn, rays, hits);
        clear = union_check(&field, &settings, rays_drawn, rays, truth, hits, &clear_hits);
        CHECK_SAY(clear > rays_drawn / 4, "%lu clear", (unsigned long)clear);
    }
}

/* A zone that touches no surface changes nothing, but by how it divides the march. */
static void Q23_zones_in_free_space(void) {
    for (int draw = 0; draw < draws; ++draw) {
        scene_draw(&made, 1 + check_random() % 12, DRAW_UNITED | DRAW_SOLID);
        scene_draw_zones(&made);
        for (size_t i = 0; i < made.scene.zone_count; ++i) {
            const double room = free_radius(made.zones[i].center);
            made.zones[i].radius = (float)fmax(0.9 * (room - margin), 1e-6);
            if (room < margin) made.scene.zone_count = i;
        }
        draw_rays();
        /* Some begin in a zone. */
        for (int i = 0; made.scene.zone_count > 0 && i < rays_drawn; i += 5) {
            const spt_zone *zone = &made.zones[check_random() % made.scene.zone_count];
            for (int axis = 0; axis < 3; ++axis) {
                rays[i].ray.origin[axis] =
                    zone->center[axis] + zone->radius * 0.4f * (float)check_uniform(-1, 1);
            }
        }
        check_free("zones in free space");
    }
}

/* Zones just where a component was asked, as small as can be: their exits round to where the ray
 * already is. */
static void Q23_tiny_zones_at_samples(void) {
    for (int draw = 0; draw < draws; ++draw) {
        const double away = draw % 3 == 0 ? 0 : pow(10, check_uniform(1, 4));
        spt_settings settings = scene_draw_settings();
        spt_hit hit;
        scene_draw(&made, 1 + check_random() % 4, DRAW_UNITED | DRAW_SOLID);
        settings.method = draw % 2 == 0 ? spt_basic() : spt_adaptive();
        draw_rays();
        for (int i = 0; i < rays_drawn; ++i) {
            spt_ray *ray = &rays[i].ray;
            ray->t_max = (float)((70 + away) / oracle_length(ray));
            for (int axis = 0; axis < 3; ++axis) {
                ray->origin[axis] -=
                    (float)(away * (double)ray->direction[axis] / oracle_length(ray));
            }
        }
        for (uint32_t budget = 0; budget < drawn_zones; ++budget) {
            spt_zone *zone = &made.zones[made.scene.zone_count];
            const scene_ray *ray = &rays[budget % 3];
            spt_scene full = made.scene;
            full.zone_count = 0;
            settings.budget = budget / 2;
            scene_run(&full, &settings, 1, ray, &hit);
            if (hit.outcome != SPT_LIMIT) continue;
            for (int axis = 0; axis < 3; ++axis) {
                const float step = hit.t * ray->ray.direction[axis];
                zone->center[axis] = ray->ray.origin[axis] + step;
            }
            zone->radius = (float)pow(10, check_uniform(-30, -4));
            zone->component = -1;
            made.scene.zone_count += free_radius(zone->center) > margin;
        }
        /* Every ray is near one of those that made the zones, or the same. */
        for (int i = 3; i < rays_drawn; ++i) {
            if (i % 2 == 0) rays[i] = rays[i % 3];
        }
        check_free("tiny zones");
    }
}

/* ---- Zones without end ---------------------------------------------------------------------- */

/* A component in a zone that no ray leaves is not there; all of them: nothing is asked. */
static void Q23_zones_without_end(void) {
    static const float radii[] = {1e4f, 1e10f, 1e18f, 1e30f, FLT_MAX};
    for (int draw = 0; draw < draws; ++draw) {
        spt_settings settings = scene_draw_settings();
        static spt_field kept[drawn_components];
        spt_scene fewer = spt_scene_default();
        const size_t count = 2 + check_random() % 12;
        const int32_t gone = (int32_t)(check_random() % (uint32_t)count);
        const spt_zone zone = {{1, -2, 3}, radii[draw % 5], draw % 7 == 0 ? -1 : gone};
        scene_draw(&made, count, DRAW_UNITED);
        made.zones[0] = zone;
        made.scene.zone_count = 1;
        for (size_t i = 0; i < count; ++i) {
            if (zone.component != -1 && (int32_t)i != gone) kept[fewer.count++] = made.fields[i];
        }
        fewer.fields = kept;
        draw_rays();
        for (int i = 0; i < rays_drawn; ++i) {
            rays[i].ray.t_max = (float)(100 / oracle_length(&rays[i].ray));
        }
        for (scene_rules walk = scene_first_rule(&made.scene, "a zone without end");
             scene_next_rule(&walk);) {
            settings.method = walk.method;
            scene_run(&made.scene, &settings, rays_drawn, rays, hits);
            if (fewer.count > 0) scene_run(&fewer, &settings, rays_drawn, rays, others);
            for (int i = 0; i < rays_drawn; ++i) {
                if (fewer.count == 0) {
                    CHECK_SAY(hits[i].outcome == SPT_MISS && hits[i].evaluations == 0,
                              "ray %d: %d after %u", i, hits[i].outcome, hits[i].evaluations);
                    continue;
                }
                others[i].component += others[i].component >= gone;
                CHECK_SAY(oracle_same_hit(&hits[i], &others[i]),
                          "zone of %g, ray %d: %d and %d, t %.9g and %.9g, component %d and %d",
                          (double)zone.radius, i, hits[i].outcome, others[i].outcome,
                          (double)hits[i].t, (double)others[i].t, hits[i].component,
                          others[i].component);
            }
        }
    }
}

void suite_scene_empty(void) {
    RUN(Q23_zones_hide_whole_bodies);
    RUN(Q23_zones_in_free_space);
    RUN(Q23_tiny_zones_at_samples);
    RUN(Q23_zones_without_end);
}
