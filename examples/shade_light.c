/* SPDX-License-Identifier: MIT
 *
 * Soft shadows from the candidates of shadow rays, ambient occlusion from values near a surface. */
#include "shade_light.h"

#include <math.h>
#include <string.h>

enum { occlusion_samples = 5 };

const float light_sun_direction[3] = {-0.7011f, 0.6210f, 0.3506f};
static const float sun_radius = 0.045f; /* tangent of the disc's angular radius */

void light_evaluate(const shading *shader, const shade_scratch *at, size_t count) {
    const size_t padded = (count + 15) / 16 * 16;
    for (size_t i = count; i < padded; ++i) {
        at->x[i] = at->x[0];
        at->y[i] = at->y[0];
        at->z[i] = at->z[0];
    }
    shader->field.batch(shader->field.user, padded, at->x, at->y, at->z, at->distance);
}

/* ---- The sun ------------------------------------------------------------------------------- */

/* How near, over the way there, a shadow ray must pass a body to lose light to it: from the middle
 * of one part of the sun to the next, so that the shadows' edges join. */
static float part_radius(const shading *shader) {
    return 2.0f * sun_radius / (float)shader->sun_side;
}

/* A bound wide enough for all rays that lose light to what is in it. To come within `wider` of a
 * body that ends at height high[1], a ray from low_light or higher climbs at most high[1] + wider -
 * low_light, so that wider = part_radius (high[1] + wider - low_light) / climb is enough. Outside
 * of the scene's own bound the field may be none of distance: no wider than that. */
static spt_bound widened(const shading *shader, const scene *shown, const spt_bound *bound,
                         float low_light) {
    const float climb = light_sun_direction[1] - sun_radius;
    float low[3], high[3], most_low[3], most_high[3];
    if (spt_bound_extent(bound, low, high) != SPT_OK) return *bound;
    const float wider = part_radius(shader) * (high[1] - low_light) / (climb - part_radius(shader));
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] -= wider;
        high[axis] += wider;
    }
    if (shown->bound != NULL && spt_bound_extent(shown->bound, most_low, most_high) == SPT_OK) {
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = fmaxf(low[axis], most_low[axis]);
            high[axis] = fminf(high[axis], most_high[axis]);
        }
    }
    return spt_bound_box(low[0], low[1], low[2], high[0], high[1], high[2]);
}

void light_prepare_casters(shading *shader, const scene *shown, scene_grain grain) {
    scene_parts *casters = &shader->casters;
    float low_light = shader->ground > -INFINITY ? shader->ground : INFINITY, low[3], high[3];
    scene_parts_of(shown, grain, shade_lanes(shader->max_lanes), casters);
    for (size_t i = 0; i < casters->scene.count; ++i) {
        const spt_bound *bound = casters->fields[i].bound;
        if (bound != NULL && spt_bound_extent(bound, low, high) == SPT_OK && low[1] < low_light) {
            low_light = low[1];
        }
    }
    for (size_t i = 0; i < casters->scene.count; ++i) {
        spt_field *field = &casters->fields[i];
        /* The convex rule leaves a body behind as soon as it is certain to miss it, however
         * closely. */
        field->flags &= ~(uint32_t)SPT_FIELD_CONVEX;
        if (field->bound == NULL) continue;
        if (shown->bound != NULL && shown->bound->kind == SPT_BOUND_SPHERE) {
            field->bound = shown->bound;
        } else {
            casters->bounds[i] = widened(shader, shown, field->bound, low_light);
            field->bound = &casters->bounds[i];
        }
    }
}

/* The direction to the middle of one of side^2 equal parts of the sun's disc. */
static void sun_part(const shading *shader, int part, float direction[3]) {
    const int side = shader->sun_side;
    /* Concentric map of the square to the disc (Shirley & Chiu 1997). */
    const float a = 2.0f * ((float)(part % side) + 0.5f) / (float)side - 1.0f;
    const float b = 2.0f * ((float)(part / side) + 0.5f) / (float)side - 1.0f;
    const float radius = fmaxf(fabsf(a), fabsf(b));
    float angle = 0.0f;
    if (radius > 0.0f) {
        angle = fabsf(a) > fabsf(b) ? 0.785398f * b / a : 1.570796f - 0.785398f * a / b;
        if (fabsf(a) > fabsf(b) ? a < 0.0f : b < 0.0f) angle += 3.141593f;
    }
    /* Two directions across the sun's, which is not vertical. */
    const float flat = sqrtf(light_sun_direction[0] * light_sun_direction[0] +
                             light_sun_direction[2] * light_sun_direction[2]);
    const float right[3] = {light_sun_direction[2] / flat, 0.0f, -light_sun_direction[0] / flat};
    const float up[3] = {light_sun_direction[1] * right[2],
                         light_sun_direction[2] * right[0] - light_sun_direction[0] * right[2],
                         -light_sun_direction[1] * right[0]};
    for (int axis = 0; axis < 3; ++axis) {
        direction[axis] =
            light_sun_direction[axis] +
            sun_radius * radius * (cosf(angle) * right[axis] + sinf(angle) * up[axis]);
    }
}

/* How much of the sun is seen. Each ray goes to one part of its disc; how closely it passes other
 * surfaces, as an angle, tells how much of that part they cover. The closeness comes with the hit:
 * with no path travelled before, candidate_ratio is the least distance over length of the way. */
void light_find_sun(const shading *shader, shade_scratch *scratch, const int *part,
                    surface_points *points) {
    spt_ray rays[SPT_BATCH];
    spt_hit hits[SPT_BATCH];
    for (size_t k = 0; k < points->count; ++k) points->light[k] = 1.0f;
    if (!shader->shadows) return;
    for (size_t k = 0; k < points->count; ++k) {
        /* Two tolerances off the surface, less what the hit already is. */
        const float lift =
            fmaxf(2.0f * fmaxf(points->half_pixel[k], shader->epsilon) - points->over[k], 0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            rays[k].origin[axis] = points->point[k][axis] + lift * points->normal[k][axis];
        }
        sun_part(shader, part[points->place[k]], rays[k].direction);
        rays[k].t_min = 0.0f;
        rays[k].t_max = 40.0f * shader->size;
    }
    spt_settings settings = spt_settings_default();
    settings.method =
        spt_relaxed(); /* the longer steps of others pass too far from closest points */
    settings.epsilon = shader->epsilon;
    settings.max_lanes = shader->max_lanes;
    settings.flags = SPT_SKIP_START;
    /* Each part is asked at least once. */
    settings.budget += 8 * (uint32_t)shader->casters.scene.count;
    const spt_rays ray_views = spt_rays_of(rays);
    const spt_hits hit_views = spt_hits_of(hits);
    spt_scene_trace(&shader->casters.scene, &settings, points->count, &ray_views, &hit_views,
                    scratch->workspace, scratch->workspace_size, NULL);
    for (size_t k = 0; k < points->count; ++k) {
        const float share = light_clamp(hits[k].candidate_ratio / part_radius(shader), 0.0f, 1.0f);
        points->light[k] =
            hits[k].outcome == SPT_HIT ? 0.0f : share * share * (3.0f - 2.0f * share);
    }
}

/* ---- The sky ------------------------------------------------------------------------------- */

/* Ambient occlusion by distances along the normal (Evans 2006): how much nearer the surface is than
 * over a plane, near samples counting most. */
void light_find_openness(const shading *shader, shade_scratch *scratch, surface_points *points) {
    const float spacing = 0.04f * shader->size;
    float lost[SPT_BATCH] = {0.0f}, most = 0.0f, weight = 1.0f;
    for (int sample = 1; sample <= occlusion_samples; ++sample) {
        const float height = spacing * (float)sample;
        weight *= 0.5f;
        most += weight * height;
        for (size_t k = 0; k < points->count; ++k) {
            scratch->x[k] = points->point[k][0] + height * points->normal[k][0];
            scratch->y[k] = points->point[k][1] + height * points->normal[k][1];
            scratch->z[k] = points->point[k][2] + height * points->normal[k][2];
        }
        light_evaluate(shader, scratch, points->count);
        for (size_t k = 0; k < points->count; ++k) {
            float distance = scratch->distance[k] / shader->field.lipschitz;
            if (shader->ground_is_added) distance = fminf(distance, scratch->y[k] - shader->ground);
            lost[k] += weight * (height - light_clamp(distance, 0.0f, height));
        }
    }
    for (size_t k = 0; k < points->count; ++k) {
        /* A corner still gets light from its open side, which samples along its walls miss. */
        points->openness[k] = 1.0f - 0.7f * lost[k] / most;
    }
}
