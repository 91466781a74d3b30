/* SPDX-License-Identifier: MIT
 *
 * Zones that cut: each component by itself, as its own zones say, the solid showing its cut; and a
 * stretch that begins at a zone's exit is a ray that begins there. */
#include "scene_draw.h"
#include "scene_union.h"
#include "harness.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>

enum { draws = 30, rays_drawn = 120 };

static drawn_scene made;
static scene_ray rays[rays_drawn];
static union_truth truth[rays_drawn];
static scene_expected expected[rays_drawn];
static spt_hit hits[rays_drawn], others[rays_drawn];

static void draw_rays(void) {
    for (int i = 0; i < rays_drawn; ++i) {
        rays[i] = i % 3 == 0 ? scene_draw_ray() : scene_draw_plain_ray();
    }
}

/* How far the line of a ray passes from a point. */
static double line_distance(const spt_ray *ray, const float point[3]) {
    const double length = oracle_length(ray);
    double along = 0, square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        along += ((double)point[axis] - (double)ray->origin[axis]) * (double)ray->direction[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double offset = (double)ray->origin[axis] - (double)point[axis] +
                              along / (length * length) * (double)ray->direction[axis];
        square += offset * offset;
    }
    return sqrt(square);
}

/* ---- Zones of any kind ---------------------------------------------------------------------- */

/* The zones of one component, for it alone. */
static size_t own_zones(size_t index, spt_zone *own) {
    size_t count = 0;
    for (size_t i = 0; i < made.scene.zone_count; ++i) {
        if (made.zones[i].component >= 0 && made.zones[i].component != (int32_t)index) continue;
        own[count] = made.zones[i];
        own[count++].component = 0;
    }
    return count;
}

/* Zones cut what they meet, each component by itself. */
static void expect_zoned(const spt_settings *settings) {
    for (int i = 0; i < rays_drawn; ++i) scene_expect_nothing(&expected[i]);
    for (size_t index = 0; index < made.scene.count; ++index) {
        spt_zone own[drawn_zones];
        spt_scene lone = spt_scene_default();
        lone.fields = &made.fields[index];
        lone.count = 1;
        lone.zones = own;
        lone.zone_count = own_zones(index, own);
        scene_run(&lone, settings, rays_drawn, rays, others);
        for (int i = 0; i < rays_drawn; ++i) {
            scene_expect_also(&expected[i], &others[i], (int32_t)index);
        }
    }
    for (int i = 0; i < rays_drawn; ++i) {
        if (expected[i].sum > settings->budget) expected[i].undecided = 1;
    }
}

static void Q23_zones_as_if_alone(void) {
    for (int draw = 0; draw < draws; ++draw) {
        spt_settings settings = scene_draw_settings();
        scene_draw(&made, 1 + check_random() % 12, DRAW_UNITED);
        scene_draw_zones(&made);
        draw_rays();
        if (draw % 3 == 1) settings.flags |= SPT_SKIP_START;
        if (draw % 5 == 2) settings.flags |= SPT_STOP_INSIDE;
        for (scene_rules walk = scene_first_rule(&made.scene, "cutting zones");
             scene_next_rule(&walk);) {
            settings.method = walk.method;
            settings.max_lanes = widths[check_random() % width_count];
            expect_zoned(&settings);
            scene_run(&made.scene, &settings, rays_drawn, rays, hits);
            /* By the components' bits, without what spt_trace() would have to say of zones. */
            for (int i = 0; i < rays_drawn; ++i) expected[i].any &= ~(uint32_t)SPT_FLAG_STEEP;
            for (int i = 0; i < rays_drawn; ++i) hits[i].flags &= ~(uint32_t)SPT_FLAG_STEEP;
            for (int i = 0; i < rays_drawn; ++i) {
                expected[i].first.flags &= ~(uint32_t)SPT_FLAG_STEEP;
            }
            scene_check(&made.scene, &settings, rays_drawn, rays, expected, hits);
        }
    }
}

/* A ray that meets no zone has the bits of a scene without. */
static void Q12_zones_not_met(void) {
    size_t met = 0, sum = 0;
    for (int draw = 0; draw < draws; ++draw) {
        spt_settings settings = scene_draw_settings();
        spt_scene full;
        scene_draw(&made, 1 + check_random() % 12, DRAW_UNITED | DRAW_FAULTS);
        scene_draw_zones(&made);
        full = made.scene;
        full.zone_count = 0;
        draw_rays();
        for (scene_rules walk = scene_first_rule(&made.scene, "zones beside the rays");
             scene_next_rule(&walk);) {
            settings.method = walk.method;
            settings.max_lanes = widths[check_random() % width_count];
            scene_run(&made.scene, &settings, rays_drawn, rays, hits);
            scene_run(&full, &settings, rays_drawn, rays, others);
            for (int i = 0; i < rays_drawn; ++i) {
                int meets = 0;
                for (size_t zone = 0; zone < made.scene.zone_count; ++zone) {
                    meets |= line_distance(&rays[i].ray, made.zones[zone].center) <
                             (double)made.zones[zone].radius + 1e-3;
                }
                ++sum;
                met += meets != 0;
                CHECK_SAY(meets || oracle_same_hit(&hits[i], &others[i]),
                          "ray %d: t %.9g and %.9g, evaluations %u and %u", i, (double)hits[i].t,
                          (double)others[i].t, hits[i].evaluations, others[i].evaluations);
            }
        }
    }
    CHECK_SAY(met > sum / 10 && met < sum - sum / 10, "%lu of %lu", (unsigned long)met,
              (unsigned long)sum);
}

/* ---- A ball and a zone ----------------------------------------------------------------------- */

typedef struct interval {
    double in, out; /* in > out: none */
} interval;

/* The crossings of a ray of unit direction with a ball; gap receives how far its line is from the
 * ball's surface. */
static interval crossings(const spt_ray *ray, const float center[3], float radius, double *gap) {
    const double distance = line_distance(ray, center), length = oracle_length(ray);
    const double half = (double)radius * (double)radius - distance * distance;
    interval none = {HUGE_VAL, -HUGE_VAL};
    double along = 0;
    *gap = fabs(distance - (double)radius);
    for (int axis = 0; axis < 3; ++axis) {
        along += ((double)center[axis] - (double)ray->origin[axis]) * (double)ray->direction[axis];
    }
    if (half < 0) return none;
    none.in = (along / length - sqrt(half)) / length;
    none.out = (along / length + sqrt(half)) / length;
    return none;
}

/* Where a ray hits a ball without what of it lies in the zone: at the ball, or at the cut where the
 * zone ends within it, seen from before the zone. decided 0: too close to another case, or it begins
 * in the solid or the zone. */
static double cut_truth(const spt_ray *ray, int *at_cut, int *decided) {
    const drawn_body *ball = &made.components[0].bodies[0];
    const spt_zone *zone = &made.zones[0];
    double gaps[2];
    const interval solid = crossings(ray, ball->center, ball->radius, &gaps[0]);
    const interval empty = crossings(ray, zone->center, zone->radius, &gaps[1]);
    const int meets = solid.in <= solid.out, jumps = empty.in <= empty.out && empty.out > 0;
    *at_cut = 0;
    *decided = gaps[0] > union_gap && gaps[1] > union_gap && fabs(solid.in) > 0.05 &&
               fabs(solid.out) > 0.05 && fabs(empty.in) > 0.05 && fabs(empty.out) > 0.05;
    if (!meets || solid.out < 0) return HUGE_VAL;
    if (solid.in < 0 || (jumps && empty.in < 0)) *decided = 0;
    if (!jumps) return solid.in;
    *decided &= fabs(solid.in - empty.in) > 0.05 && fabs(solid.in - empty.out) > 0.05 &&
                fabs(solid.out - empty.out) > 0.05;
    if (solid.in > 0 && (solid.in < empty.in || solid.in > empty.out)) return solid.in;
    *at_cut = empty.out < solid.out;
    return *at_cut ? empty.out : HUGE_VAL;
}

static void check_cut(const spt_ray *ray, const spt_hit *hit, size_t seen[3]) {
    int at_cut, decided;
    const double t = cut_truth(ray, &at_cut, &decided);
    if (!decided) return;
    ++seen[at_cut ? 2 : t < HUGE_VAL];
    CHECK_SAY(hit->outcome == (t < HUGE_VAL ? SPT_HIT : SPT_MISS), "outcome %d at %.9g, truth %.9g",
              hit->outcome, (double)hit->t, t);
    CHECK_SAY((hit->flags & SPT_FLAG_INSIDE) == 0, "inside, t %.9g, truth %.9g", (double)hit->t, t);
    if (hit->outcome != SPT_HIT || !(t < HUGE_VAL)) return;
    /* On the ball: stopped by the tolerance of 1e-4, with a cosine of at least
     * sqrt(0.04 R - 0.0004) / R, 0.18 for radii up to 1.1, and rounding well below it: 1e-3. At the
     * cut only rounding, 2^-22 of coordinates below 20 each for the zone's growth, its exit and t,
     * and the same cosine (zones up to 2: 0.14): a tenth of that would do. */
    CHECK_SAY(fabs((double)hit->t - t) < 1e-3, "t %.9g, truth %.9g, cut %d", (double)hit->t, t,
              at_cut);
    CHECK(hit->component == 0);
}

/* From anywhere to somewhere in the ball. */
static scene_ray draw_cut_ray(void) {
    const drawn_body *ball = &made.components[0].bodies[0];
    scene_ray self = scene_draw_plain_ray();
    double length;
    for (int axis = 0; axis < 3; ++axis) {
        const float aim = ball->center[axis] + (float)check_uniform(-0.8, 0.8);
        self.ray.direction[axis] = aim - self.ray.origin[axis];
    }
    length = oracle_length(&self.ray);
    for (int axis = 0; axis < 3; ++axis) self.ray.direction[axis] /= (float)length;
    return self;
}

static void Q23_zones_show_their_cut(void) {
    size_t seen[3] = {0, 0, 0};
    for (int draw = 0; draw < 4 * draws; ++draw) {
        spt_settings settings = spt_settings_default();
        settings.budget = 1000;
        scene_draw(&made, 1, DRAW_BALLS);
        made.components[0].factor = made.fields[0].lipschitz = 1;
        scene_draw_zones(&made);
        made.scene.zone_count = 1;
        for (int axis = 0; axis < 3; ++axis) {
            made.zones[0].center[axis] =
                made.components[0].bodies[0].center[axis] + (float)check_uniform(-0.7, 0.7);
        }
        for (int i = 0; i < rays_drawn; ++i) rays[i] = draw_cut_ray();
        for (scene_rules walk = scene_first_rule(&made.scene, "a cut ball");
             scene_next_rule(&walk);) {
            settings.method = walk.method;
            settings.max_lanes = widths[check_random() % width_count];
            scene_run(&made.scene, &settings, rays_drawn, rays, hits);
            for (int i = 0; i < rays_drawn; ++i) check_cut(&rays[i].ray, &hits[i], seen);
        }
    }
    CHECK_SAY(seen[0] > 500 && seen[1] > 500 && seen[2] > 500, "%lu misses, %lu hits, %lu cuts",
              (unsigned long)seen[0], (unsigned long)seen[1], (unsigned long)seen[2]);
}

/* ---- Beyond a zone --------------------------------------------------------------------------- */

static void all_values(const void *user, size_t index, size_t n, const double *x, const double *y,
                       const double *z, double *distance) {
    (void)user;
    scene_component_value(&made.components[index], n, x, y, z, distance);
}

/* A ray that begins in a zone gives what spt_trace() gives from the exit, unless the solid is cut
 * there. */
static void Q23_zones_begin_at_exit(void) {
    const union_field field = {all_values, NULL, made.fields, 1};
    size_t clear = 0, sum = 0;
    for (int draw = 0; draw < 3 * draws; ++draw) {
        spt_settings settings = scene_draw_settings();
        static scene_ray later[rays_drawn];
        const spt_rays from = scene_rays_of(later);
        settings.pixel_radius = 1e-5f;
        scene_draw(&made, 1, DRAW_UNITED | DRAW_SOLID);
        scene_draw_zones(&made);
        made.scene.zone_count = 1;
        draw_rays();
        for (int i = 0; i < rays_drawn; ++i) {
            double gap;
            for (int axis = 0; axis < 3; ++axis) {
                rays[i].ray.origin[axis] =
                    made.zones[0].center[axis] +
                    0.55f * made.zones[0].radius * (float)check_uniform(-1, 1);
            }
            rays[i].ray.t_min = 0;
            later[i] = rays[i];
            later[i].ray.t_min =
                (float)crossings(&rays[i].ray, made.zones[0].center, made.zones[0].radius, &gap)
                    .out;
        }
        union_find_truth(&field, &settings, rays_drawn, later, truth);
        for (scene_rules walk = scene_first_rule(&made.scene, "a ray that begins in a zone");
             scene_next_rule(&walk);) {
            settings.method = walk.method;
            settings.max_lanes = widths[check_random() % width_count];
            scene_run(&made.scene, &settings, rays_drawn, rays, hits);
            scene_trace_alone(&made.scene, 0, &settings, rays_drawn, &from, others);
            for (int i = 0; i < rays_drawn; ++i) {
                ++sum;
                if (!truth[i].clear || truth[i].inside) continue;
                ++clear;
                CHECK_SAY(hits[i].outcome == others[i].outcome &&
                              hits[i].flags == others[i].flags &&
                              hits[i].component == others[i].component,
                          "ray %d: outcome %d and %d, flags %u and %u", i, hits[i].outcome,
                          others[i].outcome, hits[i].flags, others[i].flags);
                CHECK_SAY(hits[i].outcome != SPT_HIT || (truth[i].near <= (double)hits[i].t &&
                                                         (double)hits[i].t <= truth[i].deep),
                          "ray %d: t %.9g, from the exit %.9g, truth in [%.9g, %.9g]", i,
                          (double)hits[i].t, (double)others[i].t, truth[i].near, truth[i].deep);
            }
        }
    }
    CHECK_SAY(clear > sum / 2, "%lu clear of %lu", (unsigned long)clear, (unsigned long)sum);
}

void suite_scene_cuts(void) {
    RUN(Q23_zones_as_if_alone);
    RUN(Q12_zones_not_met);
    RUN(Q23_zones_show_their_cut);
    RUN(Q23_zones_begin_at_exit);
}
