/* SPDX-License-Identifier: MIT
 *
 * The shared scenes as unions, and rays through them. */
#include "scene_views.h"
#include "../check.h"

#include <math.h>
#include <stdio.h>

int scene_next_view(scene_view *view) {
    static scene_parts parts;
    while (view->place < scene_count * (scene_grains - 1)) {
        const size_t before = view->count;
        view->shown = scenes[view->place / (scene_grains - 1)];
        view->grain = (scene_grain)(SCENE_OBJECTS + view->place % (scene_grains - 1));
        ++view->place;
        scene_parts_of(view->shown, view->grain, 0, &parts);
        view->count = parts.scene.count;
        if (view->count < 2 || (view->grain != SCENE_OBJECTS && view->count == before)) continue;
        snprintf(view->title, sizeof view->title, "%s, %u components", view->shown->name,
                 (unsigned)view->count);
        check_context("%s", view->title);
        return 1;
    }
    return 0;
}

/* A ray that begins on, before or behind what another one met. */
static scene_ray secondary_ray(const spt_ray *from, const spt_hit *hit) {
    scene_ray self = {{{0, 0, 0}, 0, {0, 0, 0}, INFINITY}, 0, 1};
    const double offsets[4] = {0, 1e-4, -1e-4, 0.3};
    const double t = (hit->outcome == SPT_HIT ? (double)hit->t : check_uniform(0, 10)) -
                     offsets[check_random() % 4];
    const double factor = check_random() % 3 != 0 ? 1 : pow(10, check_uniform(-2, 2));
    double d[3], length = 0;
    for (int axis = 0; axis < 3; ++axis) {
        self.ray.origin[axis] =
            (float)((double)from->origin[axis] + t * (double)from->direction[axis]);
        d[axis] = check_uniform(-1, 1);
        length += d[axis] * d[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        self.ray.direction[axis] = (float)(d[axis] / sqrt(length) * factor);
    }
    if (check_random() % 3 == 0) self.ray.t_min = (float)(check_uniform(0, 2) / factor);
    if (check_random() % 2 == 0) self.ray.t_max = (float)(check_uniform(0, 20) / factor);
    if (check_random() % 2 == 0) self.path = (float)fabs(t);
    return self;
}

float scene_view_rays(const scene *shown, scene_ray *rays) {
    static spt_ray primary[view_pixels];
    static spt_hit hits[view_pixels];
    const spt_settings settings = spt_settings_default();
    const spt_field field = scene_field(shown, spt_lanes());
    const spt_rays from = spt_rays_of(primary);
    const spt_hits to = spt_hits_of(hits);
    float pixel_radius;
    scene_rays(shown, view_width, view_height, primary, &pixel_radius);
    CHECK(spt_trace(&field, &settings, view_pixels, &from, &to, NULL) == SPT_OK);
    for (int i = 0; i < view_pixels; ++i) {
        rays[i].ray = primary[i];
        rays[i].path = 0;
        rays[i].active = 1;
    }
    for (int i = view_pixels; i < view_rays; ++i) {
        const uint32_t pick = check_random() % view_pixels;
        rays[i] = secondary_ray(&primary[pick], &hits[pick]);
    }
    return pixel_radius;
}
