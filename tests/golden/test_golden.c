/* SPDX-License-Identifier: MIT
 *
 * Pinned results: one hash of (t, outcome, evaluations) and the evaluations per scene and rule, the
 * same for every width, compiler and architecture. A changed line of golden_hashes.h is explained
 * in the change that makes it; `build/check golden` prints the lines that differ. */
#include "check.h"
#include "rules.h"
#include "scenes/scenes.h"

#include <stdio.h>
#include <string.h>

enum { width = 96, height = 64, count = width * height };

typedef struct golden {
    const char *scene, *rule;
    uint64_t evaluations;
    uint32_t hash;
} golden;

static const golden pinned[] = {
#define GOLDEN(scene, rule, evaluations, hash) {#scene, #rule, evaluations, hash},
#include "golden_hashes.h"
#undef GOLDEN
};
enum { pinned_count = sizeof pinned / sizeof pinned[0] };

static spt_ray rays[count];
static spt_hit hits[count];

static uint32_t fnv(uint32_t hash, uint32_t word) {
    for (int byte = 0; byte < 4; ++byte) {
        hash = (hash ^ (word >> 8 * byte & 255)) * 16777619u; /* FNV-1a */
    }
    return hash;
}

static const golden *pinned_for(const char *scene_name, const char *rule_name) {
    for (int i = 0; i < pinned_count; ++i) {
        if (strcmp(pinned[i].scene, scene_name) == 0 && strcmp(pinned[i].rule, rule_name) == 0) {
            return &pinned[i];
        }
    }
    return NULL;
}

static void compare(const scene *shown, const rule *one, uint32_t lanes, float pixel_radius) {
    const spt_field field = scene_field(shown, width_run(lanes));
    const spt_rays in = spt_rays_of(rays);
    const spt_hits out = spt_hits_of(hits);
    spt_settings settings = spt_settings_default();
    uint32_t hash = 2166136261u;
    uint64_t evaluations = 0;
    settings.method = one->method();
    settings.pixel_radius = pixel_radius;
    settings.max_lanes = lanes;
    CHECK(spt_trace(&field, &settings, count, &in, &out, NULL) == SPT_OK);
    for (int i = 0; i < count; ++i) {
        hash = fnv(hash, check_bits(hits[i].t));
        hash = fnv(hash, (uint32_t)hits[i].outcome);
        hash = fnv(hash, hits[i].evaluations);
        evaluations += hits[i].evaluations;
    }
    const golden *const right = pinned_for(shown->name, one->name);
    CHECK_SAY(right != NULL && right->hash == hash && right->evaluations == evaluations,
              "%u lanes: GOLDEN(%s, %s, %lu, 0x%08xu)", (unsigned)lanes, shown->name, one->name,
              (unsigned long)evaluations, (unsigned)hash);
}

static void golden_hashes(void) {
    for (size_t i = 0; i < scene_count; ++i) {
        float pixel_radius;
        scene_rays_tiled(scenes[i], width, height, rays, NULL, &pixel_radius);
        for (int j = 0; j < rule_count; ++j) {
            for (int k = 0; k < width_count; ++k) {
                if (!rule_allowed(&rules[j], scenes[i]->flags)) continue;
                compare(scenes[i], &rules[j], widths[k], pixel_radius);
            }
        }
    }
}

void suite_golden(void) {
    RUN(golden_hashes);
}
