/* SPDX-License-Identifier: MIT
 *
 * Equal bits of scenes: every step rule on every scene taken apart gives the same results at every
 * width, for every division of the rays into calls, order and company of a ray, workspace and form
 * of the callbacks; and a union is its components traced one by one. */
#include "check.h"
#include "rules.h"
#include "scenes/parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { most = 1120, fewer = 260 }; /* the first for one rule: it takes longer */

static spt_ray rays[most], mixed[most];
static spt_hit expected[most], found[most], alone[most];
static size_t order[most];
static scene_parts parts;

static void *workspace;
static size_t workspace_size;

/* A workspace of exactly the size that is asked for, as the last call of any scene left it. */
static size_t take_workspace(const spt_settings *settings) {
    const size_t size = spt_scene_workspace(&parts.scene, settings);
    if (size > workspace_size) {
        free(workspace);
        workspace = malloc(size);
        workspace_size = workspace != NULL ? size : 0;
        memset(workspace, 0xff, workspace_size);
    }
    return size;
}

static void give_back(void) {
    free(workspace);
    workspace = NULL;
    workspace_size = 0;
}

static spt_settings settings_of(const rule *one, float pixel_radius, uint32_t lanes) {
    spt_settings settings = spt_settings_default();
    settings.method = one->method();
    settings.pixel_radius = pixel_radius;
    settings.max_lanes = lanes;
    settings.budget = 60;
    return settings;
}

static void trace(const spt_settings *settings, size_t count, const spt_ray *from, spt_hit *to) {
    const size_t size = take_workspace(settings);
    const spt_rays in = spt_rays_of(from);
    const spt_hits out = spt_hits_of(to);
    CHECK(spt_scene_trace(&parts.scene, settings, count, &in, &out, workspace, size, NULL) ==
          SPT_OK);
}

static size_t differences(const spt_hit *a, const spt_hit *b, size_t count) {
    size_t differing = 0;
    for (size_t i = 0; i < count; ++i) differing += memcmp(&a[i], &b[i], sizeof a[i]) != 0;
    return differing;
}

/* The rays of a scene, some of them odd: other lengths, late starts, rays that are none. */
static float scene_test_rays(const scene *shown) {
    float pixel_radius;
    scene_rays_tiled(shown, 40, 28, rays, NULL, &pixel_radius);
    for (size_t i = 0; i < most; i += 7) {
        const float length = ldexpf(1, (int)(check_random() % 40) - 20);
        for (int axis = 0; axis < 3; ++axis) rays[i].direction[axis] *= length;
        rays[i].t_max /= length;
    }
    for (size_t i = 3; i < most; i += 50) rays[i].t_min = (float)check_uniform(0, shown->t_max);
    for (size_t i = 4; i < most; i += 90) rays[i].direction[i % 3] = NAN;
    for (size_t i = 5; i < most; i += 90) rays[i].t_max = -1;
    for (size_t i = 6; i < most; i += 90) rays[i].t_max = INFINITY;
    return pixel_radius;
}

static uint32_t common_flags(void) {
    uint32_t flags = SPT_FIELD_CONVEX;
    for (size_t i = 0; i < parts.scene.count; ++i) flags &= parts.fields[i].flags;
    return flags;
}

static void shuffle(size_t count) {
    for (size_t i = 0; i < count; ++i) order[i] = i;
    for (size_t i = count - 1; i > 0; --i) {
        const size_t other = check_random() % (i + 1), kept = order[i];
        order[i] = order[other];
        order[other] = kept;
    }
}

/* In another order and in calls of random sizes. */
static void trace_divided(const spt_settings *settings, size_t count) {
    size_t done = 0, differing = 0;
    shuffle(count);
    for (size_t i = 0; i < count; ++i) mixed[i] = rays[order[i]];
    memset(found, 0x5a, sizeof found);
    while (done < count) {
        const size_t wanted = 1 + check_random() % (check_random() % 2 != 0 ? 20 : 700);
        const size_t now = wanted < count - done ? wanted : count - done;
        trace(settings, now, mixed + done, found + done);
        done += now;
    }
    for (size_t i = 0; i < count; ++i) {
        differing += memcmp(&found[i], &expected[order[i]], sizeof found[i]) != 0;
    }
    CHECK_SAY(differing == 0, "%u differ in other calls, %u lanes", (unsigned)differing,
              (unsigned)settings->max_lanes);
}

static void compare_all(const scene *shown, scene_grain grain, const rule *one,
                        float pixel_radius) {
    const size_t count = one->method() == spt_adaptive() ? most : fewer;
    scene_parts_of(shown, grain, 1, &parts);
    if (!rule_allowed(one, common_flags())) return;
    spt_settings settings = settings_of(one, pixel_radius, 1);
    check_context("scene %s, grain %d, rule %s", shown->name, (int)grain, one->name);
    trace(&settings, count, rays, expected);
    for (int width = 0; width < width_count; ++width) {
        settings = settings_of(one, pixel_radius, widths[width]);
        scene_parts_of(shown, grain, width_run(widths[width]), &parts);
        memset(found, 0xa5, sizeof found);
        trace(&settings, count, rays, found);
        CHECK_SAY(differences(found, expected, count) == 0, "%u lanes", (unsigned)widths[width]);
        trace_divided(&settings, count);
    }
    scene_parts_of(shown, grain, 0, &parts); /* the callbacks for one point */
    settings = settings_of(one, pixel_radius, 0);
    trace(&settings, count, rays, found);
    CHECK(differences(found, expected, count) == 0);
}

static void parity_scene_widths_calls_order(void) {
    for (size_t i = 0; i < scene_count; ++i) {
        const float pixel_radius = scene_test_rays(scenes[i]);
        const int grains = strcmp(scenes[i]->name, "village") == 0 ? 2 : 1;
        for (int grain = 0; grain < grains; ++grain) {
            for (int j = 0; j < rule_count; ++j) {
                compare_all(scenes[i], (scene_grain)(SCENE_OBJECTS + grain), &rules[j],
                            pixel_radius);
            }
        }
    }
    give_back();
}

/* A scene left whole is spt_trace() of its field, with every bit. */
static void parity_scene_of_one(void) {
    for (size_t i = 0; i < scene_count; ++i) {
        const float pixel_radius = scene_test_rays(scenes[i]);
        scene_parts_of(scenes[i], SCENE_WHOLE, spt_lanes(), &parts);
        CHECK(parts.scene.count == 1);
        for (int j = 0; j < rule_count; ++j) {
            if (!rule_allowed(&rules[j], scenes[i]->flags)) continue;
            spt_settings settings = settings_of(&rules[j], pixel_radius, 0);
            check_context("scene %s, rule %s", scenes[i]->name, rules[j].name);
            trace(&settings, fewer, rays, found);
            const spt_field field = scene_field(scenes[i], spt_lanes());
            const spt_rays in = spt_rays_of(rays);
            const spt_hits out = spt_hits_of(expected);
            if ((field.flags & SPT_FIELD_CONVEX) != 0) settings.method = spt_convex();
            CHECK(spt_trace(&field, &settings, fewer, &in, &out, NULL) == SPT_OK);
            CHECK(differences(found, expected, fewer) == 0);
        }
    }
    give_back();
}

/* scene.h: the first surface, as if every component had been traced by itself. Rays that the budget
 * cannot end, here or there, are left out. */
static void compare_with_components(const rule *one, float pixel_radius) {
    static float t[fewer], residual[fewer];
    static int32_t component[fewer], decided[fewer];
    spt_settings settings = settings_of(one, pixel_radius, 0);
    size_t wrong = 0, compared = 0;
    settings.budget = 20000;
    for (size_t k = 0; k < fewer; ++k) {
        t[k] = residual[k] = INFINITY;
        component[k] = -1;
        decided[k] = 1;
    }
    for (size_t i = 0; i < parts.scene.count; ++i) {
        spt_settings own = settings;
        const spt_rays in = spt_rays_of(rays);
        const spt_hits out = spt_hits_of(alone);
        if ((parts.fields[i].flags & SPT_FIELD_CONVEX) != 0) own.method = spt_convex();
        own.budget = 2000;
        CHECK(spt_trace(&parts.fields[i], &own, fewer, &in, &out, NULL) == SPT_OK);
        for (size_t k = 0; k < fewer; ++k) {
            if (alone[k].outcome == SPT_LIMIT) decided[k] = 0;
            if (alone[k].outcome != SPT_HIT || !(alone[k].t < t[k])) continue;
            t[k] = alone[k].t;
            residual[k] = alone[k].residual;
            component[k] = (int32_t)i;
        }
    }
    trace(&settings, fewer, rays, found);
    for (size_t k = 0; k < fewer; ++k) {
        if (!decided[k] || found[k].outcome == SPT_LIMIT) continue;
        ++compared;
        wrong += !check_same_bits(found[k].t, t[k]) || found[k].component != component[k] ||
                 !check_same_bits(found[k].residual, residual[k]) ||
                 (found[k].outcome == SPT_HIT) != (component[k] >= 0);
    }
    CHECK_SAY(wrong == 0, "%u of %u wrong", (unsigned)wrong, (unsigned)compared);
    CHECK(compared > fewer / 2);
}

static void parity_scene_component_by_component(void) {
    for (size_t i = 0; i < scene_count; ++i) {
        const float pixel_radius = scene_test_rays(scenes[i]);
        scene_parts_of(scenes[i], SCENE_PRIMITIVES, spt_lanes(), &parts);
        if (parts.scene.count == 1) continue;
        for (int j = 0; j < rule_count; ++j) {
            if (!rule_allowed(&rules[j], common_flags())) continue;
            check_context("scene %s, rule %s", scenes[i]->name, rules[j].name);
            compare_with_components(&rules[j], pixel_radius);
        }
    }
    give_back();
}

/* The options of starts, with budgets that end rays anywhere. */
static void parity_scene_flags_and_budgets(void) {
    static const uint32_t budgets[] = {0, 1, 2, 3, 5, 9, 24};
    for (size_t i = 0; i < scene_count; ++i) {
        const float pixel_radius = scene_test_rays(scenes[i]);
        for (uint32_t k = 0; k < 7 * 4; ++k) {
            spt_settings settings = settings_of(&rules[k % 5], pixel_radius, 1);
            if (settings.method == spt_convex()) settings.method = spt_basic();
            check_context("scene %s, budget %u, flags %u, rule %s", scenes[i]->name,
                          (unsigned)budgets[k % 7], k / 7, spt_method_name(settings.method));
            settings.budget = budgets[k % 7];
            settings.flags = k / 7;
            scene_parts_of(scenes[i], SCENE_OBJECTS, 1, &parts);
            trace(&settings, fewer / 4, rays, expected);
            settings.max_lanes = 0;
            scene_parts_of(scenes[i], SCENE_OBJECTS, spt_lanes(), &parts);
            trace(&settings, fewer / 4, rays, found);
            CHECK(differences(found, expected, fewer / 4) == 0);
            trace_divided(&settings, fewer / 4);
        }
    }
    give_back();
}

/* Leaving a result out changes no other one. */
static void parity_scene_absent_sinks(void) {
    const scene *const shown = scene_named("primitives");
    const float pixel_radius = scene_test_rays(shown);
    const spt_settings settings = settings_of(&rules[0], pixel_radius, 0);
    scene_parts_of(shown, SCENE_OBJECTS, spt_lanes(), &parts);
    trace(&settings, 100, rays, expected);
    for (unsigned wanted = 0; wanted < 512; ++wanted) {
        const size_t size = take_workspace(&settings);
        const spt_rays view = spt_rays_of(rays);
        spt_hits hits = spt_hits_of(found);
        spt_sink *const sinks[] = {&hits.t,           &hits.residual,        &hits.outcome,
                                   &hits.evaluations, &hits.flags,           &hits.component,
                                   &hits.candidate_t, &hits.candidate_ratio, &hits.fallbacks};
        size_t wrong = 0;
        memset(found, 0x5a, sizeof found);
        for (int sink = 0; sink < 9; ++sink) {
            if (!(wanted >> sink & 1)) sinks[sink]->first = NULL;
        }
        CHECK(spt_scene_trace(&parts.scene, &settings, 100, &view, &hits, workspace, size, NULL) ==
              SPT_OK);
        for (size_t i = 0; i < 100; ++i) {
            uint32_t word[9], right[9];
            memcpy(word, &found[i], sizeof word);
            memcpy(right, &expected[i], sizeof right);
            for (int sink = 0; sink < 9; ++sink) {
                wrong += word[sink] != (wanted >> sink & 1 ? right[sink] : 0x5a5a5a5au);
            }
        }
        CHECK_SAY(wrong == 0, "sinks %x: %u words", wanted, (unsigned)wrong);
    }
    give_back();
}

void suite_parity_scene(void) {
    RUN(parity_scene_widths_calls_order);
    RUN(parity_scene_of_one);
    RUN(parity_scene_component_by_component);
    RUN(parity_scene_flags_and_budgets);
    RUN(parity_scene_absent_sinks);
}
