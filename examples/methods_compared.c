/* SPDX-License-Identifier: MIT
 *
 * The idea introduced here: the step rule is a setting. All rules on one scene, side by side: what
 * they cost, and that none loses a surface. */
#include "scenes/scenes.h"
#include "step_rules.h"

#include <stdio.h>
#include <stdlib.h>

enum { width = 320, height = 180, count = width * height };

static spt_ray rays[count];
static spt_hit hits[count], strict[count];

/* Rays whose surface is certain, since a plain march down to the epsilon met it, but for which a
 * rule that may stop at half a pixel says that there is none. */
static int count_lost(void) {
    int lost = 0;
    for (int i = 0; i < count; ++i) {
        lost += strict[i].outcome == SPT_HIT && hits[i].outcome == SPT_MISS;
    }
    return lost;
}

int main(int argument_count, char **arguments) {
    const char *name = argument_count > 1 ? arguments[1] : "primitives";
    const scene *shown = scene_named(name);
    if (shown == NULL || argument_count > 2) {
        fprintf(stderr, "usage: methods_compared [SCENE]\nThe scenes are");
        for (size_t i = 0; i < scene_count; ++i) fprintf(stderr, " %s", scenes[i]->name);
        fprintf(stderr, ".\n");
        return 2;
    }
    const spt_field field = scene_field(shown, spt_lanes());
    spt_settings settings = spt_settings_default();
    float pixel_radius = 0.0f;
    scene_rays_tiled(shown, width, height, rays, NULL, &pixel_radius);
    const spt_rays in = spt_rays_of(rays);
    const spt_hits out = spt_hits_of(hits), out_strict = spt_hits_of(strict);

    settings.method = spt_basic();
    settings.budget = 10000;
    if (spt_trace(&field, &settings, count, &in, &out_strict, NULL) != SPT_OK) return 1;
    settings = spt_settings_default();
    settings.pixel_radius = pixel_radius;
    printf("%s, %d x %d: %s\n", shown->name, width, height, shown->description);
    printf("%-13s %11s %10s %7s %10s %5s %14s\n", "rule", "evaluations", "fallbacks", "hits",
           "undecided", "lost", "largest slope");
    int all_lost = 0;
    for (size_t i = 0; step_rule(i) != NULL; ++i) {
        if (!step_rule_allowed(step_rule(i), field.flags)) continue;
        spt_statistics statistics = spt_statistics_default();
        settings.method = step_rule(i);
        if (spt_trace(&field, &settings, count, &in, &out, &statistics) != SPT_OK) return 1;
        const int lost = count_lost();
        printf("%-13s %11.2f %10.2f %7llu %10llu %5d %14.4f\n", spt_method_name(settings.method),
               (double)statistics.evaluations / count, (double)statistics.fallbacks / count,
               (unsigned long long)statistics.outcomes[SPT_HIT],
               (unsigned long long)statistics.outcomes[SPT_LIMIT], lost,
               (double)statistics.largest_slope);
        all_lost += lost;
    }
    printf(
        "Evaluations and fallbacks are averages a ray. A slope above %g, the Lipschitz constant\n"
        "given, says that the field is no bound of the distance; then rays may be lost.\n",
        (double)field.lipschitz);
    return all_lost == 0 ? 0 : 1;
}
