/* SPDX-License-Identifier: MIT
 *
 * What scenes ask of their components: row Q10, how the callbacks are called; row Q9, budgets; and
 * how much less a lazy union asks than the whole minimum. */
#include "scene_audit.h"
#include "scene_draw.h"
#include "scene_views.h"
#include "harness.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <string.h>

enum { rays_drawn = 300 };

static scene_ray rays[view_rays];
static spt_hit hits[view_rays];

/* ---- Callbacks ----------------------------------------------------------------------------- */

/* Rays of two origins are never at the same place, so what repeats in a batch is padding, and the
 * points without it are the evaluations. */
static void check_callbacks(scene_audit *audit, const spt_settings *settings, int batches_only) {
    spt_statistics statistics = spt_statistics_default();
    const spt_rays from = scene_rays_of(rays);
    const spt_hits to = spt_hits_of(hits);
    uint64_t evaluations = 0;
    scene_audit_restart(audit);
    scene_call(&audit->scene, settings, rays_drawn, &from, &to, &statistics);
    scene_audit_check(audit);
    for (int i = 0; i < rays_drawn; ++i) {
        evaluations += hits[i].evaluations;
        CHECK(hits[i].evaluations <= settings->budget);
    }
    CHECK_SAY(scene_audit_distinct(audit) == evaluations && statistics.evaluations == evaluations,
              "%lu asked, %lu told, %lu counted", (unsigned long)scene_audit_distinct(audit),
              (unsigned long)evaluations, (unsigned long)statistics.evaluations);
    if (!batches_only) return;
    CHECK_SAY(statistics.slots == scene_audit_points(audit) &&
                  statistics.passes == scene_audit_calls(audit),
              "%lu slots, %lu points; %lu passes, %lu calls", (unsigned long)statistics.slots,
              (unsigned long)scene_audit_points(audit), (unsigned long)statistics.passes,
              (unsigned long)scene_audit_calls(audit));
}

/* Rays that begin up to 12 away from the origin and are followed for at most 60. */
static void draw_rays(void) {
    for (int i = 0; i < rays_drawn; ++i) {
        rays[i] = i % 2 == 0 ? scene_draw_plain_ray() : scene_draw_ray();
        rays[i].ray.t_max = fminf(rays[i].ray.t_max, 60 / (float)oracle_length(&rays[i].ray));
        rays[i].ray.t_min = fminf(rays[i].ray.t_min, 60 / (float)oracle_length(&rays[i].ray));
    }
}

static void Q10_scene_random_callbacks(void) {
    static drawn_scene made;
    static scene_audit audit;
    for (int draw = 0; draw < 16; ++draw) {
        spt_settings settings = scene_draw_settings();
        const int batches_only = draw % 2;
        scene_draw(&made, 1 + check_random() % drawn_components, DRAW_UNITED);
        for (size_t i = 0; batches_only && i < made.scene.count; ++i) {
            if (made.fields[i].batch == NULL) made.fields[i] = made.fields[0];
        }
        if (batches_only && made.fields[0].batch == NULL) continue;
        draw_rays();
        scene_audit_of(&audit, &made.scene, 12, 61);
        if (draw % 3 == 0) settings.budget = 1 + check_random() % 40;
        for (scene_rules walk = scene_first_rule(&made.scene, "a random scene");
             scene_next_rule(&walk);) {
            settings.method = walk.method;
            for (int width = 0; width < width_count; ++width) {
                settings.max_lanes = widths[width];
                check_callbacks(&audit, &settings, batches_only);
            }
        }
    }
}

static void Q10_scene_shared_callbacks(void) {
    static scene_parts parts;
    static scene_audit audit;
    for (scene_view view = scene_first_view; scene_next_view(&view);) {
        spt_settings settings = spt_settings_default();
        const scene *shown = view.shown;
        scene_parts_of(shown, view.grain, spt_lanes(), &parts);
        /* Origins differ: they are points of the picture's rays, at a t of their own. Views and
         * bodies are within 25 of the origin, rays up to 60 long. */
        (void)scene_view_rays(shown, rays);
        for (int i = 0; i < rays_drawn; ++i) {
            const double t = check_uniform(0, 0.4);
            rays[i] = rays[i * (view_pixels / rays_drawn)];
            for (int axis = 0; axis < 3; ++axis) {
                rays[i].ray.origin[axis] += (float)(t * (double)rays[i].ray.direction[axis]);
            }
            rays[i].ray.t_max = 60;
        }
        scene_audit_of(&audit, &parts.scene, 25, 61);
        for (scene_rules walk = scene_first_rule(&parts.scene, view.title);
             scene_next_rule(&walk);) {
            settings.method = walk.method;
            check_callbacks(&audit, &settings, 1);
        }
    }
}

/* ---- Budgets ------------------------------------------------------------------------------- */

static int same_value(const spt_scene *united, const drawn_scene *made, const scene_ray *ray,
                      const spt_hit *hit) {
    double p[3], f;
    for (int axis = 0; axis < 3; ++axis) { /* rounded as the library rounds it */
        const float step = hit->t * ray->ray.direction[axis];
        const float sum = ray->ray.origin[axis] + step;
        p[axis] = (double)sum;
    }
    for (size_t i = 0; i < united->count; ++i) {
        scene_component_value(&made->components[i], 1, &p[0], &p[1], &p[2], &f);
        if (check_same_bits((float)f, hit->residual)) return 1;
    }
    return 0;
}

static void check_limit(const drawn_scene *made, const scene_ray *ray, const spt_hit *limit,
                        const spt_hit *full, uint32_t budget) {
    CHECK_SAY(limit->outcome == SPT_LIMIT && limit->evaluations == budget && limit->component == -1,
              "budget %u: outcome %d after %u, component %d", budget, limit->outcome,
              limit->evaluations, limit->component);
    CHECK_SAY(limit->t >= ray->ray.t_min && limit->t <= full->t, "budget %u: t %.9g, then %.9g",
              budget, (double)limit->t, (double)full->t);
    CHECK_SAY(check_same_bits(limit->residual, INFINITY) ||
                  same_value(&made->scene, made, ray, limit),
              "budget %u: f %.9g at %.9g is no component's", budget, (double)limit->residual,
              (double)limit->t);
}

/* With just as many evaluations as it took a ray ends the same way, with fewer it is undecided. */
static void check_budgets(const drawn_scene *made, spt_settings settings, const scene_ray *ray) {
    spt_hit full, hit;
    scene_run(&made->scene, &settings, 1, ray, &full);
    settings.budget = full.evaluations;
    scene_run(&made->scene, &settings, 1, ray, &hit);
    CHECK_SAY(oracle_same_hit(&full, &hit), "budget %u: outcome %d at %.9g, was %d at %.9g",
              settings.budget, hit.outcome, (double)hit.t, full.outcome, (double)full.t);
    for (uint32_t less = 1; less <= full.evaluations; less = less * 2 + 1) {
        settings.budget = full.evaluations - less;
        scene_run(&made->scene, &settings, 1, ray, &hit);
        check_limit(made, ray, &hit, &full, settings.budget);
    }
    settings.budget = 0;
    scene_run(&made->scene, &settings, 1, ray, &hit);
    if (full.evaluations == 0) {
        CHECK(oracle_same_hit(&full, &hit));
    } else {
        check_limit(made, ray, &hit, &full, 0);
        CHECK(check_same_bits(hit.residual, INFINITY) && hit.flags == 0 && hit.fallbacks == 0);
        CHECK(check_same_bits(hit.candidate_t, INFINITY) &&
              check_same_bits(hit.candidate_ratio, INFINITY));
    }
}

static void Q9_scene_budget_of_what_was_used(void) {
    static drawn_scene made;
    for (int draw = 0; draw < 24; ++draw) {
        spt_settings settings = scene_draw_settings();
        if (draw % 3 == 1) settings.flags |= SPT_SKIP_START;
        scene_draw(&made, 1 + check_random() % 20, DRAW_UNITED);
        for (int i = 0; i < 12; ++i)
            rays[i] = i % 2 == 0 ? scene_draw_ray() : scene_draw_plain_ray();
        for (scene_rules walk = scene_first_rule(&made.scene, "a random scene");
             scene_next_rule(&walk);) {
            settings.method = walk.method;
            settings.max_lanes = widths[check_random() % width_count];
            for (int i = 0; i < 12; ++i) check_budgets(&made, settings, &rays[i]);
        }
    }
}

/* The same budget for many rays at once: those that need less do not notice, the others stop. */
static void Q9_scene_budget_of_many(void) {
    static drawn_scene made;
    static spt_hit full[rays_drawn];
    for (int draw = 0; draw < 12; ++draw) {
        spt_settings settings = scene_draw_settings();
        scene_draw(&made, 1 + check_random() % drawn_components, 0);
        for (int i = 0; i < rays_drawn; ++i) rays[i] = scene_draw_ray();
        for (scene_rules walk = scene_first_rule(&made.scene, "a random scene");
             scene_next_rule(&walk);) {
            settings.method = walk.method;
            settings.max_lanes = widths[check_random() % width_count];
            settings.budget = 3000;
            scene_run(&made.scene, &settings, rays_drawn, rays, full);
            settings.budget = check_random() % 30;
            scene_run(&made.scene, &settings, rays_drawn, rays, hits);
            for (int i = 0; i < rays_drawn; ++i) {
                if (full[i].evaluations <= settings.budget) {
                    CHECK_SAY(oracle_same_hit(&full[i], &hits[i]), "ray %d", i);
                } else {
                    check_limit(&made, &rays[i], &hits[i], &full[i], settings.budget);
                }
            }
        }
    }
}

/* ---- How much is asked --------------------------------------------------------------------- */

typedef struct saving {
    const char *name;
    scene_grain grain;
    size_t components;
} saving;

/* Evaluations a ray of the components, over those of the whole minimum times the components. */
static double share_of(const saving *one, const spt_method *method) {
    static scene_parts parts;
    const scene *shown = scene_named(one->name);
    const spt_field whole = scene_field(shown, spt_lanes());
    const spt_rays from = scene_rays_of(rays);
    const spt_hits to = spt_hits_of(hits);
    spt_settings settings = spt_settings_default();
    spt_statistics united = spt_statistics_default(), single = spt_statistics_default();
    scene_parts_of(shown, one->grain, spt_lanes(), &parts);
    CHECK_SAY(parts.scene.count == one->components, "%lu components",
              (unsigned long)parts.scene.count);
    settings.pixel_radius = scene_view_rays(shown, rays);
    settings.budget = 2000;
    settings.method = method;
    scene_call(&parts.scene, &settings, view_pixels, &from, &to, &united);
    CHECK(spt_trace(&whole, &settings, view_pixels, &from, &to, &single) == SPT_OK);
    return (double)united.evaluations / ((double)single.evaluations * (double)one->components);
}

/* What is required is a quarter, for the village's 81 bodies. Measured are 0.001 to 0.013: most
 * rays ask only the few components whose bounds they meet. Twice that is a fault. */
static void Q23_shares_of_the_whole_minimum(void) {
    static const saving savings[] = {{"village", SCENE_PRIMITIVES, 81},
                                     {"village", SCENE_OBJECTS, 41},
                                     {"village_boxes", SCENE_OBJECTS, 82},
                                     {"slabs", SCENE_OBJECTS, 13},
                                     {"primitives", SCENE_OBJECTS, 22}};
    for (size_t i = 0; i < sizeof savings / sizeof savings[0]; ++i) {
        const double basic = share_of(&savings[i], spt_basic());
        const double adaptive = share_of(&savings[i], spt_adaptive());
        const double most = 0.026;
        check_context("%s, %u components", savings[i].name, (unsigned)savings[i].components);
        CHECK_SAY(basic <= most && adaptive <= most, "shares: basic %.4f, adaptive %.4f", basic,
                  adaptive);
    }
}

void suite_scene_counts(void) {
    RUN(Q10_scene_random_callbacks);
    RUN(Q10_scene_shared_callbacks);
    RUN(Q9_scene_budget_of_what_was_used);
    RUN(Q9_scene_budget_of_many);
    RUN(Q23_shares_of_the_whole_minimum);
}
