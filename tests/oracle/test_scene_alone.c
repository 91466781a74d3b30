/* SPDX-License-Identifier: MIT
 *
 * Row Q23: a scene gives the first of what its components give one by one, with the same bits: on
 * the shared scenes and on random ones, with every rule, at every width. */
#include "scene_draw.h"
#include "scene_views.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rays that are no rays. */
static void spoil(scene_ray *self) {
    float *numbers[9] = {&self->ray.origin[0],    &self->ray.origin[1],    &self->ray.origin[2],
                         &self->ray.direction[0], &self->ray.direction[1], &self->ray.direction[2],
                         &self->ray.t_min,        &self->ray.t_max,        &self->path};
    const float worst[4] = {NAN, -INFINITY, -1, 0};
    if (check_random() % 8 == 0) {
        for (int axis = 0; axis < 3; ++axis) self->ray.direction[axis] = 0;
    } else {
        *numbers[check_random() % 9] = worst[check_random() % 4];
    }
}

/* ---- The shared scenes --------------------------------------------------------------------- */

static scene_ray rays[view_rays];
static scene_expected expected[view_rays];
static spt_hit hits[view_rays];

static void check_view(const scene_view *view, scene_rules *walk, const spt_settings *settings,
                       int lanes) {
    static scene_parts parts;
    scene_parts_of(view->shown, view->grain, lanes, &parts);
    memset(hits, 0xa5, sizeof hits);
    scene_run(&parts.scene, settings, view_rays, rays, hits);
    check_context("%s, method %s, %u lanes, callbacks for %d", walk->title,
                  spt_method_name(walk->method), settings->max_lanes, lanes);
    scene_check(&parts.scene, settings, view_rays, rays, expected, hits);
}

static void Q23_shared_scenes_as_if_alone(void) {
    static scene_parts parts;
    int unions = 0;
    for (scene_view view = scene_first_view; scene_next_view(&view);) {
        const float pixel_radius = scene_view_rays(view.shown, rays);
        spt_settings settings = spt_settings_default();
        settings.budget = 100000;
        ++unions;
        scene_parts_of(view.shown, view.grain, spt_lanes(), &parts);
        for (scene_rules walk = scene_first_rule(&parts.scene, view.title);
             scene_next_rule(&walk);) {
            int undecided = 0;
            settings.method = walk.method;
            settings.max_lanes = 0;
            settings.pixel_radius = walk.place % 2 == 0 ? pixel_radius : 0;
            scene_expect(&parts.scene, &settings, view_rays, rays, expected);
            for (int i = 0; i < view_rays; ++i) undecided += expected[i].undecided;
            CHECK_SAY(undecided <= view_rays / 200, "%d undecided", undecided);
            check_view(&view, &walk, &settings, 0);
            for (int width = 0; width < width_count; ++width) {
                settings.max_lanes = widths[width];
                if (width_run(widths[width]) != (int)widths[width]) continue;
                check_view(&view, &walk, &settings, width_run(widths[width]));
            }
        }
    }
    CHECK_SAY(unions >= 6, "%d unions", unions);
}

/* ---- Random scenes ------------------------------------------------------------------------- */

enum { draws = 16, rays_drawn = 100 };

/* The scene with every rule, at every width or at some width. */
static void check_drawn(const spt_scene *united, const spt_settings *chosen, const char *title,
                        int all_widths, int outcomes[SPT_OUTCOMES]) {
    for (scene_rules walk = scene_first_rule(united, title); scene_next_rule(&walk);) {
        spt_settings settings = *chosen;
        const int some = (int)(check_random() % width_count);
        settings.method = walk.method;
        scene_expect(united, &settings, rays_drawn, rays, expected);
        for (int width = 0; width < width_count; ++width) {
            if (width_run(widths[width]) != (int)widths[width]) continue;
            if (!all_widths && width != some) continue;
            settings.max_lanes = widths[width];
            memset(hits, 0xa5, sizeof hits);
            scene_run(united, &settings, rays_drawn, rays, hits);
            scene_check(united, &settings, rays_drawn, rays, expected, hits);
        }
        for (int i = 0; i < rays_drawn; ++i) {
            if (!expected[i].undecided) ++outcomes[expected[i].first.outcome];
        }
    }
}

static void draw_rays(void) {
    for (int i = 0; i < rays_drawn; ++i) {
        rays[i] = scene_draw_ray();
        if (check_random() % 20 == 0) spoil(&rays[i]);
    }
}

/* Every outcome but SPT_LIMIT occurs often enough to mean something. */
static void check_outcomes(const int outcomes[SPT_OUTCOMES], int faults) {
    int sum = 0;
    for (int i = 0; i < SPT_OUTCOMES; ++i) sum += outcomes[i];
    CHECK_SAY(outcomes[SPT_MISS] > sum / 20 && outcomes[SPT_HIT] > sum / 10 &&
                  outcomes[SPT_BAD_RAY] > sum / 100 && outcomes[SPT_LIMIT] == 0,
              "%d misses, %d hits, %d bad, %d limits of %d", outcomes[SPT_MISS], outcomes[SPT_HIT],
              outcomes[SPT_BAD_RAY], outcomes[SPT_LIMIT], sum);
    CHECK_SAY(!faults || outcomes[SPT_NONFINITE] > sum / 50, "%d not finite",
              outcomes[SPT_NONFINITE]);
}

static void drawn_scenes(uint32_t selection) {
    static drawn_scene made;
    int outcomes[SPT_OUTCOMES] = {0};
    for (int draw = 0; draw < draws; ++draw) {
        spt_settings settings = scene_draw_settings();
        char title[] = "a random scene";
        scene_draw(&made, 1 + check_random() % (draw % 2 == 0 ? 6 : drawn_components), selection);
        draw_rays();
        if (draw % 3 == 1) settings.flags |= SPT_SKIP_START;
        if (draw % 4 == 3) settings.flags |= SPT_STOP_INSIDE;
        check_drawn(&made.scene, &settings, title, 1, outcomes);
    }
    check_outcomes(outcomes, (selection & DRAW_FAULTS) != 0);
}

static void Q23_random_scenes_as_if_alone(void) {
    drawn_scenes(0);
}

static void Q23_united_components_as_if_alone(void) {
    drawn_scenes(DRAW_UNITED);
}

static void Q23_faulty_components_as_if_alone(void) {
    drawn_scenes(DRAW_FAULTS | DRAW_UNITED);
}

static void Q23_steep_components_as_if_alone(void) {
    drawn_scenes(DRAW_STEEP);
}

/* Every field twice: of two equal hits the first one counts. */
static void Q23_equal_hits_lower_component(void) {
    static drawn_scene made;
    static spt_field twice[2 * drawn_components];
    int outcomes[SPT_OUTCOMES] = {0};
    for (int draw = 0; draw < draws / 4; ++draw) {
        const spt_settings settings = scene_draw_settings();
        spt_scene united;
        scene_draw(&made, 1 + check_random() % 20, DRAW_FAULTS);
        united = made.scene;
        united.fields = twice;
        united.count *= 2;
        for (size_t i = 0; i < united.count; ++i) {
            twice[i] = made.fields[draw % 2 == 0 ? i % made.scene.count : i / 2];
        }
        draw_rays();
        check_drawn(&united, &settings, "a scene with every field twice", 1, outcomes);
        for (int i = 0; i < rays_drawn; ++i) {
            const int32_t component = hits[i].component;
            if (hits[i].outcome != SPT_HIT) continue;
            CHECK_SAY(draw % 2 == 0 ? component < (int32_t)made.scene.count : component % 2 == 0,
                      "component %d of %u", component, (unsigned)united.count);
        }
    }
    check_outcomes(outcomes, 1);
}

/* More components than any table on a stack would hold. */
static void Q23_many_components_as_if_alone(void) {
    enum { many = 400 };
    static drawn_scene made[(many + drawn_components - 1) / drawn_components];
    static spt_field fields[many];
    const spt_settings settings = scene_draw_settings();
    int outcomes[SPT_OUTCOMES] = {0};
    spt_scene united = spt_scene_default();
    for (size_t i = 0; i < many; ++i) {
        drawn_scene *part = &made[i / drawn_components];
        if (i % drawn_components == 0) scene_draw(part, drawn_components, DRAW_BALLS);
        fields[i] = part->fields[i % drawn_components];
    }
    united.fields = fields;
    united.count = many;
    draw_rays();
    check_drawn(&united, &settings, "400 balls", 0, outcomes);
    CHECK(outcomes[SPT_HIT] > 0);
}

void suite_scene_alone(void) {
    RUN(Q23_shared_scenes_as_if_alone);
    RUN(Q23_random_scenes_as_if_alone);
    RUN(Q23_united_components_as_if_alone);
    RUN(Q23_faulty_components_as_if_alone);
    RUN(Q23_steep_components_as_if_alone);
    RUN(Q23_equal_hits_lower_component);
    RUN(Q23_many_components_as_if_alone);
}
