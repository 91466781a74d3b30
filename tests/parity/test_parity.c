/* SPDX-License-Identifier: MIT
 *
 * Equal bits: every step rule on every scene gives the same results at every width, for every
 * number of rays, layout of the views, order and company of a ray, and form of the callback. */
#include "check.h"
#include "rules.h"
#include "scenes/scenes.h"
#include "step_rules.h"

#include <math.h>
#include <string.h>

enum { most = 1000, columns = 10, stray = 3 };

static spt_ray rays[most];
static spt_hit expected[most], found[most];
static size_t order[most];

static spt_settings settings_of(const rule *one, float pixel_radius, uint32_t lanes) {
    spt_settings settings = spt_settings_default();
    settings.method = one->method();
    settings.pixel_radius = pixel_radius;
    settings.max_lanes = lanes;
    settings.budget = 60;
    return settings;
}

static size_t differences(const spt_hit *a, const spt_hit *b, size_t count) {
    size_t differing = 0;
    for (size_t i = 0; i < count; ++i) differing += memcmp(&a[i], &b[i], sizeof a[i]) != 0;
    return differing;
}

/* The rays of a scene, some of them odd: inside starts, rays that are not finite, and so on. */
static float scene_test_rays(const scene *shown) {
    float pixel_radius;
    scene_rays_tiled(shown, 40, 25, rays, NULL, &pixel_radius);
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

/* The columns and sinks of views, in the order of spt_ray and spt_hit. */
static void list_columns(spt_rays *view, spt_column *columns_of[8]) {
    for (int axis = 0; axis < 3; ++axis) {
        columns_of[axis] = &view->origin[axis];
        columns_of[4 + axis] = &view->direction[axis];
    }
    columns_of[3] = &view->t_min;
    columns_of[7] = &view->t_max;
}

static void list_sinks(spt_hits *hits, spt_sink *sinks[9]) {
    spt_sink *const all[] = {&hits->t,           &hits->residual,        &hits->outcome,
                             &hits->evaluations, &hits->flags,           &hits->component,
                             &hits->candidate_t, &hits->candidate_ratio, &hits->fallbacks};
    memcpy(sinks, all, sizeof all);
}

/* Layouts of the views. Each loads the first count rays, traces them and brings the hits back. */
typedef spt_status trace_fn(const spt_field *field, const spt_settings *settings, size_t count);

static spt_status trace_structures(const spt_field *field, const spt_settings *settings,
                                   size_t count) {
    const spt_rays view = spt_rays_of(rays);
    const spt_hits hits = spt_hits_of(found);
    return spt_trace(field, settings, count, &view, &hits, NULL);
}

static spt_status trace_arrays(const spt_field *field, const spt_settings *settings, size_t count) {
    static float in[8][most + stray];
    static uint32_t out[9][most + stray];
    spt_rays view;
    spt_hits hits;
    spt_column *read[8];
    spt_sink *write[9];
    list_columns(&view, read);
    list_sinks(&hits, write);
    memset(&view, 0, sizeof view);
    for (size_t i = 0; i < count; ++i) {
        float values[8];
        memcpy(values, &rays[i], sizeof values);
        for (int column = 0; column < 8; ++column) in[column][i + stray] = values[column];
    }
    for (int column = 0; column < 8; ++column) {
        read[column]->first = in[column] + stray;
        read[column]->stride = sizeof(float);
    }
    for (int sink = 0; sink < 9; ++sink) {
        write[sink]->first = out[sink] + stray;
        write[sink]->stride = sizeof(uint32_t);
    }
    const spt_status status = spt_trace(field, settings, count, &view, &hits, NULL);
    for (size_t i = 0; i < count; ++i) {
        uint32_t values[9];
        for (int sink = 0; sink < 9; ++sink) values[sink] = out[sink][i + stray];
        memcpy(&found[i], values, sizeof found[i]);
    }
    return status;
}

/* From the last ray to the first: negative strides. */
static spt_status trace_backwards(const spt_field *field, const spt_settings *settings,
                                  size_t count) {
    if (count == 0) return trace_structures(field, settings, 0);
    spt_rays view = spt_rays_of(rays + count - 1);
    spt_hits hits = spt_hits_of(found + count - 1);
    spt_column *read[8];
    spt_sink *write[9];
    list_columns(&view, read);
    list_sinks(&hits, write);
    for (int column = 0; column < 8; ++column) read[column]->stride *= -1;
    for (int sink = 0; sink < 9; ++sink) write[sink]->stride *= -1;
    return spt_trace(field, settings, count, &view, &hits, NULL);
}

static spt_status trace_masked(const spt_field *field, const spt_settings *settings, size_t count) {
    static int32_t active[most];
    spt_rays view = spt_rays_of(rays);
    const spt_hits hits = spt_hits_of(found);
    spt_status status = SPT_OK;
    view.active.first = active;
    view.active.stride = sizeof active[0];
    for (size_t half = 0; half < 2; ++half) {
        for (size_t i = 0; i < count; ++i) active[i] = (i * 2654435761u >> 7 & 1) == half ? -1 : 0;
        if (status == SPT_OK) status = spt_trace(field, settings, count, &view, &hits, NULL);
    }
    return status;
}

static trace_fn *const layouts[] = {trace_structures, trace_arrays, trace_backwards, trace_masked};
enum { layout_count = sizeof layouts / sizeof layouts[0] };

/* Everything about one scene and rule against one lane and the array of structures. */
static void compare_all(const scene *shown, const rule *one, float pixel_radius) {
    spt_field field = scene_field(shown, 1);
    spt_settings settings = settings_of(one, pixel_radius, 1);
    check_context("scene %s, rule %s", shown->name, one->name);
    CHECK(trace_structures(&field, &settings, most) == SPT_OK);
    memcpy(expected, found, sizeof found);
    for (int width = 0; width < width_count; ++width) {
        const size_t lanes = widths[width];
        const size_t counts[] = {0, 1, lanes - 1, lanes, lanes + 1, 2 * lanes + 1, most};
        settings = settings_of(one, pixel_radius, widths[width]);
        field = scene_field(shown, width_run(widths[width]));
        for (int layout = 0; layout < layout_count; ++layout) {
            for (size_t i = 0; i < sizeof counts / sizeof counts[0]; ++i) {
                memset(found, 0xa5, sizeof found);
                CHECK(layouts[layout](&field, &settings, counts[i]) == SPT_OK);
                const size_t differing = differences(found, expected, counts[i]);
                CHECK_SAY(differing == 0, "%u differ of %u; %u lanes, layout %d",
                          (unsigned)differing, (unsigned)counts[i], (unsigned)lanes, layout);
            }
        }
    }
    field = scene_field(shown, 0); /* the callback for one point */
    settings = settings_of(one, pixel_radius, 0);
    CHECK(trace_structures(&field, &settings, most) == SPT_OK);
    CHECK(differences(found, expected, most) == 0);
}

static void parity_widths_counts_layouts(void) {
    for (size_t i = 0; i < scene_count; ++i) {
        const float pixel_radius = scene_test_rays(scenes[i]);
        for (int j = 0; j < rule_count; ++j) {
            if (rule_allowed(&rules[j], scenes[i]->flags)) {
                compare_all(scenes[i], &rules[j], pixel_radius);
            }
        }
    }
}

/* A ray's result does not depend on the rays beside it. */
static void parity_random_neighbours(void) {
    static spt_ray mixed[most];
    for (size_t i = 0; i < scene_count; ++i) {
        const float pixel_radius = scene_test_rays(scenes[i]);
        for (int j = 0; j < rule_count; ++j) {
            if (!rule_allowed(&rules[j], scenes[i]->flags)) continue;
            const spt_settings settings = settings_of(&rules[j], pixel_radius, 0);
            const spt_field field = scene_field(scenes[i], spt_lanes());
            check_context("scene %s, rule %s", scenes[i]->name, rules[j].name);
            CHECK(trace_structures(&field, &settings, most) == SPT_OK);
            memcpy(expected, found, sizeof found);
            for (size_t k = 0; k < most; ++k) order[k] = k;
            for (size_t k = most - 1; k > 0; --k) {
                const size_t other = check_random() % (k + 1), kept = order[k];
                order[k] = order[other];
                order[other] = kept;
            }
            for (size_t k = 0; k < most; ++k) mixed[k] = rays[order[k]];
            const spt_rays view = spt_rays_of(mixed);
            const spt_hits hits = spt_hits_of(found);
            CHECK(spt_trace(&field, &settings, most, &view, &hits, NULL) == SPT_OK);
            size_t differing = 0;
            for (size_t k = 0; k < most; ++k) {
                differing += memcmp(&found[k], &expected[order[k]], sizeof found[k]) != 0;
            }
            CHECK_SAY(differing == 0, "%u differ", (unsigned)differing);
        }
    }
}

/* Leaving a result out must not change another one. */
static void parity_absent_sinks(void) {
    const scene *const shown = scene_named("primitives");
    const float pixel_radius = scene_test_rays(shown);
    const spt_field field = scene_field(shown, spt_lanes());
    for (int j = 0; j < rule_count; ++j) {
        if (!rule_allowed(&rules[j], shown->flags)) continue;
        const spt_settings settings = settings_of(&rules[j], pixel_radius, 0);
        CHECK(trace_structures(&field, &settings, most) == SPT_OK);
        memcpy(expected, found, sizeof found);
        for (unsigned wanted = 0; wanted < 512; ++wanted) {
            const spt_rays view = spt_rays_of(rays);
            spt_hits hits = spt_hits_of(found);
            spt_sink *sinks[9];
            list_sinks(&hits, sinks);
            memset(found, 0x5a, sizeof found);
            for (int sink = 0; sink < 9; ++sink) {
                if (!(wanted >> sink & 1)) sinks[sink]->first = NULL;
            }
            check_context("rule %s, sinks %x", rules[j].name, wanted);
            CHECK(spt_trace(&field, &settings, 64, &view, &hits, NULL) == SPT_OK);
            for (size_t i = 0; i < 64; ++i) {
                uint32_t word[9], right[9];
                memcpy(word, &found[i], sizeof word);
                memcpy(right, &expected[i], sizeof right);
                for (int sink = 0; sink < 9; ++sink) {
                    CHECK(word[sink] == (wanted >> sink & 1 ? right[sink] : 0x5a5a5a5au));
                }
            }
        }
    }
}

static void parity_examples_know_every_rule(void) {
    for (int j = 0; j < rule_count; ++j) {
        CHECK(step_rule((size_t)j) == rules[j].method());
        CHECK(strcmp(spt_method_name(rules[j].method()), rules[j].name) == 0);
    }
    CHECK(step_rule(rule_count) == NULL);
}

void suite_parity(void) {
    RUN(parity_widths_counts_layouts);
    RUN(parity_random_neighbours);
    RUN(parity_absent_sinks);
    RUN(parity_examples_know_every_rule);
}
