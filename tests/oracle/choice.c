/* SPDX-License-Identifier: MIT
 *
 * What is swept, counts, and the rule that takes a value. */
#include "choice.h"
#include "../rules.h"

#include <stddef.h>
#include <string.h>

const char *const choice_kind[choice_kinds] = {
    "sphere",        "box",   "plane",        "thin_torus", "hollow_box",
    "village_boxes", "slabs", "smooth_union", "bumpy_ball", "mandelbulb"};

const char *const choice_stop[choice_stops] = {"half_pixel", "absolute"};

const choice_sweep choice_sweep_of[choice_sweeps] = {
    {"relaxation",
     "relaxed",
     11,
     {1.0f, 1.1f, 1.2f, 1.3f, 1.4f, 1.5f, 1.6f, 1.7f, 1.8f, 1.9f, 1.95f}},
    {"extrapolation",
     "adaptive",
     13,
     {0, 0.2f, 0.4f, 0.6f, 0.7f, 0.76f, 0.8f, 0.84f, 0.88f, 0.92f, 0.96f, 0.98f, 1}},
    {"extrapolation",
     "enhanced",
     13,
     {0, 0.2f, 0.4f, 0.6f, 0.7f, 0.76f, 0.8f, 0.84f, 0.88f, 0.92f, 0.96f, 0.98f, 1}},
    {"slope_blend",
     "auto_relaxed",
     11,
     {0.05f, 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f, 0.9f, 1}},
    {"step_cap", "adaptive", 11, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 100}}};

const char *const choice_method[choice_methods] = {"basic", "relaxed", "auto_relaxed", "enhanced",
                                                   "adaptive"};

/* Half a percent: no clock tells such values apart, and a scene more or less moves their means by
 * more. */
static const double as_good = 1.005;

float *choice_setting(spt_settings *settings, const char *setting) {
    static const struct {
        const char *name;
        size_t place;
    } members[] = {{"relaxation", offsetof(spt_settings, relaxation)},
                   {"extrapolation", offsetof(spt_settings, extrapolation)},
                   {"slope_blend", offsetof(spt_settings, slope_blend)},
                   {"step_cap", offsetof(spt_settings, step_cap)}};
    for (size_t i = 0; i < sizeof members / sizeof members[0]; ++i) {
        if (strcmp(members[i].name, setting) == 0) {
            return (float *)(void *)((char *)settings + members[i].place);
        }
    }
    return NULL;
}

/* The longest ray of the ten kinds takes some hundreds. */
spt_settings choice_settings(const spt_settings *given, const char *method, int stop,
                             float pixel_radius) {
    spt_settings settings = *given;
    for (int i = 0; i < rule_count; ++i) {
        if (strcmp(rules[i].name, method) == 0) settings.method = rules[i].method();
    }
    settings.budget = 1000;
    settings.pixel_radius = stop == 0 ? pixel_radius : 0;
    return settings;
}

size_t choice_rays(const scene *shown, int every, spt_ray *rays, float *pixel_radius) {
    size_t count = 0;
    scene_rays(shown, choice_width, choice_height, rays, pixel_radius);
    for (int row = every / 2; row < choice_height; row += every) {
        for (int column = every / 2; column < choice_width; column += every) {
            rays[count++] = rays[row * choice_width + column];
        }
    }
    return count;
}

choice_count choice_evaluations(const scene *shown, const spt_settings *settings, size_t count,
                                const spt_ray *rays, spt_hit *hits) {
    choice_count counted = {0, 0};
    const spt_field field = scene_field(shown, spt_lanes());
    const spt_rays from = spt_rays_of(rays);
    spt_hits to;
    memset(&to, 0, sizeof to);
    to.evaluations.first = &hits->evaluations;
    to.evaluations.stride = (ptrdiff_t)sizeof *hits;
    if (spt_trace(&field, settings, count, &from, &to, NULL) != SPT_OK) return counted;
    for (size_t i = 0; i < count; ++i) {
        const uint64_t evaluations = hits[i].evaluations;
        counted.sum += evaluations;
        counted.squares += evaluations * evaluations;
    }
    return counted;
}

int choice_pick(const choice_value *values, int count) {
    int least = -1;
    for (int i = 0; i < count; ++i) {
        if (values[i].lost != 0) continue;
        if (least < 0 || values[i].evaluations < values[least].evaluations) least = i;
    }
    for (int i = 0; i < least; ++i) {
        if (values[i].lost == 0 && values[i].evaluations <= as_good * values[least].evaluations) {
            return i;
        }
    }
    return least;
}
