/* SPDX-License-Identifier: MIT
 *
 * What a scene says beside its hit, exactly: a callback counts how often each component was asked
 * for a ray, and the component by itself with just that budget shows what it had seen by then.
 * flags, evaluations, fallbacks and the candidate are made of these, and so is what is said of a
 * ray that ran out of budget. */
#include "scene_audit.h"
#include "scene_draw.h"
#include "scene_views.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>

/* One ray of a scene, and all its components as far as they were asked. */
typedef struct samples {
    const scene_audit *audit;
    const spt_settings *settings;
    const scene_ray *ray;
    spt_hit hit;
    spt_hit alone[audited_components];
    int ended; /* what ended the ray was seen by a component */
} samples;

static spt_hit alone_with(const samples *self, size_t component, uint32_t budget) {
    const spt_rays from = scene_rays_of(self->ray);
    spt_settings settings = *self->settings;
    spt_hit hit;
    settings.budget = budget;
    /* the component without a listener, by the rule that the scene is to use for it */
    spt_field field = self->audit->listeners[component].inner;
    spt_scene lone = spt_scene_default();
    lone.fields = &field;
    lone.count = 1;
    scene_trace_alone(&lone, 0, &settings, 1, &from, &hit);
    return hit;
}

/* The flags, the counts and the candidate are those of the samples that were taken. */
static void check_sums(const samples *self) {
    const spt_hit *hit = &self->hit;
    uint32_t flags = 0, evaluations = 0, fallbacks = 0;
    float ratio = INFINITY, t = INFINITY;
    for (size_t i = 0; i < self->audit->scene.count; ++i) {
        const spt_hit *alone = &self->alone[i];
        flags |= alone->flags;
        evaluations += alone->evaluations;
        fallbacks += alone->fallbacks;
        if (alone->candidate_ratio < ratio ||
            (check_same_bits(alone->candidate_ratio, ratio) && alone->candidate_t < t)) {
            ratio = alone->candidate_ratio;
            t = alone->candidate_t;
        }
    }
    CHECK_SAY(hit->evaluations == evaluations, "%u evaluations, %u asked", hit->evaluations,
              evaluations);
    CHECK_SAY(hit->flags == flags, "flags %u, of the components %u", hit->flags, flags);
    CHECK_SAY(hit->fallbacks == fallbacks, "fallbacks %u, of the components %u", hit->fallbacks,
              fallbacks);
    CHECK_SAY(check_same_bits(hit->candidate_ratio, ratio) && check_same_bits(hit->candidate_t, t),
              "candidate %.9g at %.9g, of the components %.9g at %.9g",
              (double)hit->candidate_ratio, (double)hit->candidate_t, (double)ratio, (double)t);
}

/* Lazy: a component is asked only from where it is the nearest, so not once it is known to be free
 * beyond where the ray ended. */
static void check_lazy(const samples *self) {
    if (self->hit.outcome == SPT_LIMIT)
        return; /* it is the next one's, that may begin before others */
    for (size_t i = 0; i < self->audit->scene.count; ++i) {
        const uint32_t asked = self->alone[i].evaluations;
        if (asked == 0) continue;
        const spt_hit before = alone_with(self, i, asked - 1);
        CHECK_SAY(before.outcome == SPT_LIMIT && before.t <= self->hit.t,
                  "component %lu was asked at %.9g, the ray ended at %.9g", (unsigned long)i,
                  (double)before.t, (double)self->hit.t);
    }
}

/* A ray that ends where a component ended it; that component was asked, and said so. A miss asked
 * all of them to their end. */
static void check_end(const samples *self) {
    const spt_hit *hit = &self->hit;
    int ends = 0;
    for (size_t i = 0; i < self->audit->scene.count; ++i) {
        const spt_hit *alone = &self->alone[i];
        if (hit->outcome == SPT_MISS) {
            CHECK_SAY(alone->outcome == SPT_MISS, "component %lu: %d", (unsigned long)i,
                      alone->outcome);
        }
        ends += alone->outcome == hit->outcome && check_same_bits(alone->t, hit->t) &&
                check_same_bits(alone->residual, hit->residual);
    }
    CHECK_SAY(ends > 0, "outcome %d at %.9g is no component's", hit->outcome, (double)hit->t);
}

static void check_samples(scene_audit *audit, const spt_settings *settings, const scene_ray *ray) {
    static samples self;
    self.audit = audit;
    self.settings = settings;
    self.ray = ray;
    scene_audit_restart(audit);
    scene_run(&audit->scene, settings, 1, ray, &self.hit);
    for (size_t i = 0; i < audit->scene.count; ++i) {
        self.alone[i] = alone_with(&self, i, (uint32_t)audit->listeners[i].distinct);
        CHECK_SAY(audit->listeners[i].distinct == audit->listeners[i].calls, "%lu in %lu calls",
                  (unsigned long)audit->listeners[i].distinct,
                  (unsigned long)audit->listeners[i].calls);
        CHECK_SAY(self.alone[i].evaluations == audit->listeners[i].distinct,
                  "component %lu was asked %lu times, by itself %u", (unsigned long)i,
                  (unsigned long)audit->listeners[i].distinct, self.alone[i].evaluations);
    }
    check_sums(&self);
    check_lazy(&self);
    check_end(&self);
}

/* Every ray with the budget out of reach, and with one that ends it on the way. */
static void check_rays(scene_audit *audit, spt_settings settings, int count,
                       const scene_ray *rays) {
    const uint32_t budget = settings.budget;
    for (int i = 0; i < count; ++i) {
        settings.max_lanes = widths[check_random() % width_count];
        settings.budget = budget;
        check_samples(audit, &settings, &rays[i]);
        settings.budget = check_random() % 40;
        check_samples(audit, &settings, &rays[i]);
    }
}

static void random_samples(uint32_t selection) {
    static drawn_scene made;
    static scene_audit audit;
    scene_ray rays[12];
    for (int draw = 0; draw < 30; ++draw) {
        spt_settings settings = scene_draw_settings();
        scene_draw(&made, 1 + check_random() % (draw % 2 == 0 ? 4 : 24), selection);
        scene_audit_of(&audit, &made.scene, 1000, 1e6);
        if (draw % 3 == 1) settings.flags |= SPT_SKIP_START;
        if (draw % 5 == 2) settings.flags |= SPT_STOP_INSIDE;
        for (int i = 0; i < 12; ++i) {
            rays[i] = i % 2 == 0 ? scene_draw_ray() : scene_draw_plain_ray();
        }
        for (scene_rules walk = scene_first_rule(&made.scene, "a random scene");
             scene_next_rule(&walk);) {
            settings.method = walk.method;
            check_rays(&audit, settings, 12, rays);
        }
    }
}

static void Q23_random_scenes_samples(void) {
    random_samples(DRAW_UNITED);
}

static void Q23_faulty_components_samples(void) {
    random_samples(DRAW_FAULTS);
}

static void Q23_shared_scenes_samples(void) {
    static scene_parts parts;
    static scene_audit audit;
    static scene_ray all[view_rays];
    scene_ray rays[12];
    for (scene_view view = scene_first_view; scene_next_view(&view);) {
        spt_settings settings = spt_settings_default();
        settings.pixel_radius = scene_view_rays(view.shown, all);
        settings.budget = 100000;
        for (int i = 0; i < 12; ++i) rays[i] = all[check_random() % view_rays];
        scene_parts_of(view.shown, view.grain, spt_lanes(), &parts);
        scene_audit_of(&audit, &parts.scene, 1000, 1e6);
        for (scene_rules walk = scene_first_rule(&parts.scene, view.title);
             scene_next_rule(&walk);) {
            settings.method = walk.method;
            check_rays(&audit, settings, 12, rays);
        }
    }
}

void suite_scene_samples(void) {
    RUN(Q23_random_scenes_samples);
    RUN(Q23_faulty_components_samples);
    RUN(Q23_shared_scenes_samples);
}
