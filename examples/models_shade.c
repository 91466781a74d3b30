/* SPDX-License-Identifier: MIT
 *
 * The light of sun, sky and ground on a textured point, seen through air or water. */
#include "models_shade.h"

#include "models_noise.h"
#include "models_texture.h"

#include <stdlib.h>
#include <string.h>

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

int models_desk_create(models_desk *desk, const models_stage *stage) {
    desk->workspace_size = models_workspace(stage);
    desk->workspace = desk->workspace_size != 0 ? malloc(desk->workspace_size) : NULL;
    return desk->workspace != NULL;
}

void models_desk_free(models_desk *desk) {
    free(desk->workspace);
    desk->workspace = NULL;
}

/* ---- Textures ------------------------------------------------------------------------------ */

/* Carries a direction from the space of an instance's kernel to the world: back through the
 * mirrors that were folded at, the last one first. */
static void to_world(const spt_krs *krs, int32_t kernel, uint64_t mirrors, float direction[3]) {
    for (uint32_t i = (uint32_t)kernel; i < krs->levels; ++i) {
        const float *normal = krs->mirrors[i].normal;
        if (!(mirrors >> i & 1)) continue;
        const float twice = 2.0f * dot(direction, normal);
        for (int axis = 0; axis < 3; ++axis) direction[axis] -= twice * normal[axis];
    }
}

/* What a pixel sees of the surface: the longer the more it lies along the ray, but across the ray
 * it is no longer, so that something between both is shown. */
static float footprint_at(const models_points *points, size_t k) {
    const float towards = fabsf(dot(points->normal[k], points->rays[k].direction));
    return points->wide[k] / powf(fmaxf(towards, 0.02f), 0.75f);
}

static void look_at(const models_stage *stage, const models_points *points, size_t k,
                    texture_look *look) {
    const model_component *component = &stage->world->components[points->hits[k].component];
    texture_place place;
    place.material = models_material_of(stage, points, k);
    place.unit = stage->air.unit;
    place.footprint = footprint_at(points, k);
    place.u = points->u[k];
    place.v = points->v[k];
    place.scale = points->scale[k];
    place.u_wide = points->u_wide[k];
    place.v_wide = points->v_wide[k];
    place.identity = spt_krs_identity(points->kernel[k], points->mirrors[k], 0);
    const uint32_t levels =
        component->krs != NULL ? component->krs->levels : component->moekrs->levels;
    place.branch = spt_krs_identity(0, points->mirrors[k], levels > 4 ? levels - 4 : 0);
    memcpy(place.world, points->point[k], sizeof place.world);
    memcpy(place.normal, points->normal[k], sizeof place.normal);
    memcpy(place.kernel_point, points->kernel_point[k], sizeof place.kernel_point);
    memcpy(place.kernel_normal, points->kernel_normal[k], sizeof place.kernel_normal);
    memcpy(place.tint, component->tint, sizeof place.tint);
    models_texture(&place, look);
    if (look->in_kernel && component->krs != NULL) {
        to_world(component->krs, points->kernel[k], points->mirrors[k], look->relief);
    } else if (look->in_kernel) {
        memset(look->relief, 0, sizeof look->relief);
    }
}

/* The normal of a surface that rises by the relief. */
static void lean(const float normal[3], const float relief[3], float leaning[3]) {
    const float along = dot(relief, normal);
    for (int axis = 0; axis < 3; ++axis) {
        leaning[axis] = normal[axis] - (relief[axis] - along * normal[axis]);
    }
    const float length = sqrtf(dot(leaning, leaning));
    for (int axis = 0; axis < 3; ++axis) leaning[axis] /= length; /* normal is at right angles */
}

/* ---- Light --------------------------------------------------------------------------------- */

/* What a wet or waxy surface mirrors of the sun (GGX; Walter et al. 2007). */
static float highlight(const float normal[3], const float sun[3], const float view[3]) {
    const float width = 0.03f;
    float half[3];
    for (int axis = 0; axis < 3; ++axis) half[axis] = sun[axis] - view[axis];
    const float length = fmaxf(sqrtf(dot(half, half)), 1e-3f);
    const float cosine = noise_clamp(dot(normal, half) / length, 0.0f, 1.0f);
    const float fall = cosine * cosine * (width - 1.0f) + 1.0f;
    return 0.25f * width / (fall * fall);
}

static void light_point(const models_stage *stage, const models_points *points, size_t k,
                        float colour[3]) {
    const models_air *air = &stage->air;
    const float *direction = points->rays[k].direction;
    texture_look look;
    float normal[3], left[3], pattern, mirrored[3], sky[3];
    look_at(stage, points, k, &look);
    lean(points->normal[k], look.relief, normal);
    models_depth(air, points->point[k], footprint_at(points, k), left, &pattern);
    const float facing = dot(points->normal[k], air->sun);
    /* Relief must not light what faces away from the sun. */
    const float cosine =
        noise_clamp(dot(normal, air->sun), 0.0f, 1.0f) * noise_step(-0.05f, 0.15f, facing);
    const float through =
        points->behind[k] ? look.through * noise_clamp(-facing, 0.0f, 1.0f) : 0.0f;
    const float sun =
        points->sun[k] * (1.0f + (pattern - 1.0f) * noise_step(0.0f, 0.6f, normal[1]));
    const float up = 0.5f + 0.5f * normal[1], open = points->openness[k];
    const float towards = noise_clamp(-dot(normal, direction), 0.0f, 1.0f);
    const float away = 1.0f - towards;
    const float fresnel = look.gloss * (0.04f + 0.6f * away * away * away * away * away);
    for (int axis = 0; axis < 3; ++axis) {
        mirrored[axis] = direction[axis] + 2.0f * towards * normal[axis];
    }
    models_sky(air, mirrored, sky);
    const float shine = look.gloss * 0.08f * highlight(normal, air->sun, direction);
    for (int c = 0; c < 3; ++c) {
        static const float leaf[3] = {1.25f, 1.15f, 0.45f}; /* what a leaf lets through */
        const float direct = air->sun_light[c] * left[c] * sun;
        const float around = air->from_below[c] + up * (air->from_above[c] - air->from_below[c]);
        colour[c] = look.albedo[c] * (direct * (cosine + through * leaf[c]) +
                                      around * left[c] * (0.15f + 0.85f * open)) +
                    direct * shine * cosine + fresnel * sky[c] * open;
    }
    models_haze(air, direction, points->hits[k].t, colour);
}

spt_status models_shade(const models_stage *stage, models_desk *desk, size_t count,
                        const spt_ray *rays, const spt_hit *hits, float (*colours)[3]) {
    static const float broken[3] = {1.0f, 0.0f, 1.0f};
    models_points *points = &desk->points;
    spt_status status = models_find_points(stage, count, rays, hits, points);
    if (status == SPT_OK) {
        status = models_find_light(stage, desk->workspace, desk->workspace_size, points);
    }
    if (status != SPT_OK) return status;
    for (size_t i = 0; i < count; ++i) {
        if (hits[i].outcome != SPT_HIT) models_sky(&stage->air, rays[i].direction, colours[i]);
    }
    for (size_t k = 0; k < points->count; ++k) {
        light_point(stage, points, k, colours[points->place[k]]);
    }
    for (size_t i = 0; i < count; ++i) {
        models_develop(colours[i]);
        /* A value that is no number is the field's fault and has to be seen. */
        if (hits[i].outcome == SPT_NONFINITE) memcpy(colours[i], broken, sizeof broken);
    }
    return status;
}
