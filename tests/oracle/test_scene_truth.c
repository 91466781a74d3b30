/* SPDX-License-Identifier: MIT
 *
 * Rows Q1, Q3, Q13 and Q23: scenes against the slow union in double, and against one field that is
 * the minimum of all components. */
#include "scene_draw.h"
#include "scene_union.h"
#include "scene_views.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>

static scene_ray rays[view_rays];
static union_truth truth[view_rays];
static spt_hit hits[view_rays], whole_hits[view_rays];

/* ---- The shared scenes --------------------------------------------------------------------- */

static void view_values(const void *user, size_t index, size_t n, const double *x, const double *y,
                        const double *z, double *distance) {
    const scene_view *view = user;
    scene_part_reference(view->shown, view->grain, index, n, x, y, z, distance);
}

static union_field view_union(const scene_view *view, const scene_parts *parts) {
    union_field field = {view_values, NULL, NULL, 0};
    field.user = view;
    field.fields = parts->fields;
    field.count = parts->scene.count;
    return field;
}

/* One field that is the minimum, by the same rule. Beyond what rounding decides, a rule of plain
 * steps never asks a component more often than the minimum: a component's sphere is larger. */
static void check_whole(const scene_view *view, const spt_settings *settings, size_t components) {
    const spt_field whole = scene_field(view->shown, spt_lanes());
    const spt_rays from = scene_rays_of(rays);
    const spt_hits to = spt_hits_of(whole_hits);
    uint64_t whole_evaluations = 0, evaluations = 0;
    CHECK(spt_trace(&whole, settings, view_rays, &from, &to, NULL) == SPT_OK);
    for (int i = 0; i < view_rays; ++i) {
        evaluations += hits[i].evaluations;
        whole_evaluations += whole_hits[i].evaluations;
        if (!truth[i].clear || truth[i].inside) continue;
        CHECK_SAY(whole_hits[i].outcome == hits[i].outcome, "ray %d: %d, whole %d", i,
                  hits[i].outcome, whole_hits[i].outcome);
        CHECK_SAY(settings->method != spt_basic() ||
                      hits[i].evaluations <= components * whole_hits[i].evaluations,
                  "ray %d: %u evaluations, whole %u", i, hits[i].evaluations,
                  whole_hits[i].evaluations);
        if (hits[i].outcome != SPT_HIT || whole_hits[i].outcome != SPT_HIT) continue;
        CHECK_SAY(fabs((double)hits[i].t - (double)whole_hits[i].t) <=
                      truth[i].deep - truth[i].near,
                  "ray %d: t %.9g, whole %.9g", i, (double)hits[i].t, (double)whole_hits[i].t);
    }
    CHECK_SAY(evaluations <= components * whole_evaluations, "%lu evaluations, whole %lu",
              (unsigned long)evaluations, (unsigned long)whole_evaluations);
}

static void Q23_shared_scenes_truth(void) {
    static scene_parts parts;
    for (scene_view view = scene_first_view; scene_next_view(&view);) {
        spt_settings settings = spt_settings_default();
        union_field field;
        (void)scene_view_rays(view.shown, rays);
        settings.budget = 2000;
        settings.pixel_radius = 1e-5f;
        scene_parts_of(view.shown, view.grain, spt_lanes(), &parts);
        field = view_union(&view, &parts);
        union_find_truth(&field, &settings, view_rays, rays, truth);
        for (scene_rules walk = scene_first_rule(&parts.scene, view.title);
             scene_next_rule(&walk);) {
            size_t clear, clear_hits;
            settings.method = walk.method;
            scene_run(&parts.scene, &settings, view_rays, rays, hits);
            clear = union_check(&field, &settings, view_rays, rays, truth, hits, &clear_hits);
            CHECK_SAY(clear > view_rays / 2 && clear_hits > view_rays / 10,
                      "only %lu clear, %lu hits", (unsigned long)clear, (unsigned long)clear_hits);
            if (walk.method != spt_convex()) check_whole(&view, &settings, field.count);
        }
    }
}

/* ---- Random scenes ------------------------------------------------------------------------- */

enum { draws = 20, rays_drawn = 100 };

static void drawn_values(const void *user, size_t index, size_t n, const double *x, const double *y,
                         const double *z, double *distance) {
    const drawn_scene *made = user;
    scene_component_value(&made->components[index], n, x, y, z, distance);
}

static void random_scenes(uint32_t selection) {
    static drawn_scene made;
    union_field field = {drawn_values, &made, made.fields, 0};
    size_t clear = 0, clear_hits = 0, inside = 0, runs = 0;
    for (int draw = 0; draw < draws; ++draw) {
        spt_settings settings = scene_draw_settings();
        settings.pixel_radius = 1e-5f; /* tolerances are below the gap */
        scene_draw(&made, 1 + check_random() % (draw % 2 == 0 ? 6 : drawn_components), selection);
        field.count = made.scene.count;
        for (int i = 0; i < rays_drawn; ++i) {
            rays[i] = i % 2 == 0 ? scene_draw_plain_ray() : scene_draw_ray();
        }
        union_find_truth(&field, &settings, rays_drawn, rays, truth);
        for (scene_rules walk = scene_first_rule(&made.scene, "a random scene");
             scene_next_rule(&walk);) {
            settings.method = walk.method;
            for (int width = 0; width < width_count; ++width) {
                size_t more_hits;
                settings.max_lanes = (uint32_t)width_run(widths[width]);
                scene_run(&made.scene, &settings, rays_drawn, rays, hits);
                clear += union_check(&field, &settings, rays_drawn, rays, truth, hits, &more_hits);
                clear_hits += more_hits;
                runs += rays_drawn;
            }
        }
        for (int i = 0; i < rays_drawn; ++i) inside += truth[i].clear && truth[i].inside;
    }
    CHECK_SAY(clear > runs / 2 && clear_hits > runs / 5 && inside > draws,
              "%lu clear, %lu hits, %lu inside of %lu", (unsigned long)clear,
              (unsigned long)clear_hits, (unsigned long)inside, (unsigned long)runs);
}

static void Q1_random_scenes_truth(void) {
    random_scenes(0);
}

static void Q1_united_components_truth(void) {
    random_scenes(DRAW_UNITED);
}

void suite_scene_truth(void) {
    RUN(Q23_shared_scenes_truth);
    RUN(Q1_random_scenes_truth);
    RUN(Q1_united_components_truth);
}
