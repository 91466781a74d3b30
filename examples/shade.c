/* SPDX-License-Identifier: MIT
 *
 * The shading of the pictures: one key light, the sky, a ground. What a caller of the library does
 * with hits, none of it part of the library. */
#include "shade.h"

#include "shade_light.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { probe_side = 48 };

static const float sun_light[3] = {2.60f, 2.30f, 1.90f};

/* The lowest point of the surface: rays upwards from under the bound, none of which sees less than
 * the object's underside. Returns 0 where memory ran out. */
static int find_lowest(const shading *shader, const float low[3], const float high[3],
                       float *lowest) {
    enum { count = probe_side * probe_side };
    spt_ray *rays = malloc(count * sizeof *rays);
    float *t = malloc(count * sizeof *t);
    float nearest = INFINITY;
    for (size_t i = 0; rays != NULL && i < count; ++i) {
        const float across = ((float)(i % probe_side) + 0.5f) / probe_side;
        const float along = ((float)(i / probe_side) + 0.5f) / probe_side;
        const spt_ray up = {{low[0] + across * (high[0] - low[0]), low[1] - 0.5f,
                             low[2] + along * (high[2] - low[2])},
                            0.0f,
                            {0.0f, 1.0f, 0.0f},
                            high[1] - low[1] + 1.0f};
        rays[i] = up;
    }
    spt_settings settings = spt_settings_default();
    settings.max_lanes = shader->max_lanes;
    spt_hits hits;
    memset(&hits, 0, sizeof hits);
    hits.t.first = t;
    hits.t.stride = sizeof *t;
    const int ready = rays != NULL && t != NULL;
    if (ready) {
        const spt_rays views = spt_rays_of(rays);
        if (spt_trace(&shader->field, &settings, count, &views, &hits, NULL) == SPT_OK) {
            for (size_t i = 0; i < count; ++i) nearest = t[i] < nearest ? t[i] : nearest;
        }
    }
    free(rays);
    free(t);
    *lowest = nearest < INFINITY ? low[1] - 0.5f + nearest : low[1];
    return ready;
}

int shade_lanes(uint32_t max_lanes) {
    const int lanes = spt_lanes();
    return max_lanes != 0 && (int)max_lanes < lanes ? (int)max_lanes : lanes;
}

int shading_create(shading *shader, const scene *shown, scene_grain grain, float epsilon,
                   float pixel_radius, int sun_side, uint32_t max_lanes) {
    memset(shader, 0, sizeof *shader);
    shader->look = look_of(shown->name);
    shader->field = scene_field(shown, shade_lanes(max_lanes));
    shader->epsilon = epsilon;
    shader->pixel_radius = pixel_radius;
    shader->sun_side = sun_side;
    shader->shadows = 1;
    shader->max_lanes = max_lanes;
    double away = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        away += (shown->target[axis] - shown->eye[axis]) * (shown->target[axis] - shown->eye[axis]);
    }
    shader->size = (float)sqrt(away) * 0.5f;
    shader->ground = -INFINITY;
    shader->haze = 0.7f * (float)shown->t_max;
    float low[3], high[3];
    if (shader->look->has_ground) {
        shader->ground = shader->look->ground;
        shader->ground_is_traced = 1;
        shader->ground_is_added = shown->bound != NULL;
    } else if (shown->bound != NULL && spt_bound_extent(shown->bound, low, high) == SPT_OK) {
        if (!find_lowest(shader, low, high, &shader->ground)) return 0;
        shader->ground_is_added = 1;
        shader->haze = 20.0f * shader->size;
        shader->size = 0.5f * fmaxf(high[0] - low[0], fmaxf(high[1] - low[1], high[2] - low[2]));
    }
    light_prepare_casters(shader, shown, grain);
    return 1;
}

int shade_scratch_create(shade_scratch *scratch, const shading *shader) {
    const size_t arrays = 4 * SPT_BATCH * sizeof(float);
    spt_settings settings = spt_settings_default();
    settings.method = spt_relaxed();
    scratch->workspace_size = spt_scene_workspace(&shader->casters.scene, &settings);
    scratch->memory = malloc(64 + arrays + scratch->workspace_size);
    if (scratch->memory == NULL) return 0;
    float *first = (float *)(((uintptr_t)scratch->memory + 63) & ~(uintptr_t)63);
    scratch->x = first;
    scratch->y = first + SPT_BATCH;
    scratch->z = first + 2 * SPT_BATCH;
    scratch->distance = first + 3 * SPT_BATCH;
    scratch->workspace = first + 4 * SPT_BATCH;
    return 1;
}

void shade_scratch_free(shade_scratch *scratch) {
    free(scratch->memory);
    scratch->memory = NULL;
}

float shade_ground_at(const shading *shader, const spt_ray *ray) {
    if (!shader->ground_is_added || !(ray->direction[1] < 0.0f)) return INFINITY;
    const float t = (shader->ground - ray->origin[1]) / ray->direction[1];
    return t > 0.0f ? t : INFINITY;
}

void shade_normals(const shading *shader, shade_scratch *scratch, size_t count,
                   const float (*points)[3], const float *half_pixel, float (*normals)[3]) {
    float step[SPT_BATCH];
    for (size_t i = 0; i < count; ++i) {
        /* The step where rounding (unit 2^-24, of coordinates and size) and curvature do equal
         * harm; at least a quarter of the half pixel, so that what is smaller is averaged. */
        const float largest =
            fmaxf(fabsf(points[i][0]), fmaxf(fabsf(points[i][1]), fabsf(points[i][2])));
        const float size = shader->size;
        step[i] = cbrtf(0x1p-24f * (largest + size) * size * size);
        step[i] = fmaxf(step[i], 0.25f * half_pixel[i]);
    }
    for (int side = 0; side < 6; ++side) {
        float *const moved[3] = {scratch->x, scratch->y, scratch->z};
        const int axis = side / 2;
        const float sign = side % 2 == 0 ? 1.0f : -1.0f;
        for (size_t i = 0; i < count; ++i) {
            scratch->x[i] = points[i][0];
            scratch->y[i] = points[i][1];
            scratch->z[i] = points[i][2];
            moved[axis][i] += sign * step[i];
        }
        light_evaluate(shader, scratch, count);
        for (size_t i = 0; i < count; ++i) {
            normals[i][axis] =
                (side % 2 == 0 ? 0.0f : normals[i][axis]) + sign * scratch->distance[i];
        }
    }
    for (size_t i = 0; i < count; ++i) {
        const float length = sqrtf(light_dot(normals[i], normals[i]));
        const float inverse = length > 0.0f && length < INFINITY ? 1.0f / length : 0.0f;
        for (int axis = 0; axis < 3; ++axis) {
            normals[i][axis] = inverse > 0.0f ? normals[i][axis] * inverse : 0.0f;
        }
    }
}

/* How far the end of a ray still is from the surface, at least. */
static float distance_of(const shading *shader, const spt_hit *hit) {
    const float lipschitz = hit->component >= 0 ? shader->casters.fields[hit->component].lipschitz
                                                : shader->field.lipschitz;
    return fmaxf(hit->residual, 0.0f) / lipschitz;
}

/* Where the ground that the field holds ends and the added one goes on, differences see an edge. */
static int is_rim_of_ground(const shading *shader, const surface_points *found, size_t k) {
    return shader->ground_is_traced && shader->ground_is_added && found->normal[k][1] > 0.3f &&
           found->point[k][1] - shader->ground < 2.0f * found->half_pixel[k];
}

/* The points that rays reach, on the object or the ground, with their normals. */
static void gather(const shading *shader, shade_scratch *scratch, size_t count, const spt_ray *rays,
                   const spt_hit *hits, surface_points *found) {
    found->count = 0;
    for (size_t i = 0; i < count; ++i) {
        const float ground = shade_ground_at(shader, &rays[i]);
        float t = INFINITY;
        if (hits[i].outcome == SPT_HIT) t = hits[i].t;
        /* The budget ran out: the candidate is the best guess of what is there. */
        if (hits[i].outcome == SPT_LIMIT) t = hits[i].candidate_t;
        const int on_ground = ground < t;
        if (on_ground) t = ground;
        if (!(t < INFINITY)) continue;
        const size_t k = found->count++;
        found->place[k] = i;
        found->t[k] = t;
        found->on_ground[k] = on_ground;
        found->over[k] = on_ground ? 0.0f : distance_of(shader, &hits[i]);
        /* At least as coarse as the ray was traced. */
        found->half_pixel[k] = fmaxf(shader->pixel_radius * t, found->over[k]);
        for (int axis = 0; axis < 3; ++axis) {
            found->point[k][axis] = rays[i].origin[axis] + t * rays[i].direction[axis];
        }
    }
    if (found->count == 0) return;
    shade_normals(shader, scratch, found->count, (const float(*)[3])found->point, found->half_pixel,
                  found->normal);
    for (size_t k = 0; k < found->count; ++k) {
        if (found->on_ground[k] || is_rim_of_ground(shader, found, k)) {
            memcpy(found->normal[k], (const float[3]){0.0f, 1.0f, 0.0f}, sizeof found->normal[k]);
        } else if (!(light_dot(found->normal[k], found->normal[k]) > 0.0f)) {
            for (int axis = 0; axis < 3; ++axis) {
                found->normal[k][axis] = -rays[found->place[k]].direction[axis];
            }
        }
    }
}

/* Light of the sun mirrored by a rough surface (GGX; Walter et al. 2007), for unit vectors. */
static float highlight(const float normal[3], const float view[3], float roughness) {
    float half[3];
    for (int axis = 0; axis < 3; ++axis) half[axis] = light_sun_direction[axis] + view[axis];
    const float length = sqrtf(light_dot(half, half));
    if (!(length > 0.0f)) return 0.0f;
    const float cosine = light_clamp(light_dot(normal, half) / length, 0.0f, 1.0f);
    const float width = roughness * roughness * roughness * roughness;
    const float fall = cosine * cosine * (width - 1.0f) + 1.0f;
    return 0.25f * width / (fall * fall);
}

static void surface_colour(const shading *shader, const surface_points *points, size_t k,
                           const spt_ray *ray, float colour[3]) {
    const float *normal = points->normal[k], *point = points->point[k];
    const float length = sqrtf(light_dot(ray->direction, ray->direction));
    float view[3], mirrored[3], albedo[3], sky[3], ground_albedo[3];
    for (int c = 0; c < 3; ++c) view[c] = -ray->direction[c] / length;
    const float facing = light_clamp(light_dot(normal, view), 0.0f, 1.0f);
    for (int c = 0; c < 3; ++c) mirrored[c] = 2.0f * facing * normal[c] - view[c];

    /* On a ground that is part of the field: what lies within two half pixels of its plane, and
     * softly so. */
    const float slope = fmaxf(fabsf(view[1]), 1e-3f);
    float grounded = points->on_ground[k] ? 1.0f : 0.0f;
    if (shader->ground_is_traced) {
        const float over =
            (point[1] - shader->ground) / (2.0f * fmaxf(points->half_pixel[k], shader->epsilon));
        grounded =
            light_clamp(2.0f - over, 0.0f, 1.0f) * light_clamp(normal[1] * 4.0f - 2.0f, 0.0f, 1.0f);
    }
    look_albedo(shader->look, point, albedo);
    look_ground_albedo(point[0], point[2], 0.5f * shader->size,
                       2.0f * points->half_pixel[k] / slope, ground_albedo);
    look_sky(mirrored, sky);
    const float gloss = shader->look->gloss * (1.0f - grounded);
    const float cosine = light_clamp(light_dot(normal, light_sun_direction), 0.0f, 1.0f);
    const float away = 1.0f - facing;
    const float fresnel = 0.04f + 0.96f * away * away * away * away * away;
    const float shine = gloss * fresnel * highlight(normal, view, 0.45f);
    for (int c = 0; c < 3; ++c) {
        static const float above[3] = {0.36f, 0.45f, 0.60f}, below[3] = {0.20f, 0.18f, 0.16f};
        const float body = albedo[c] + grounded * (ground_albedo[c] - albedo[c]);
        const float around = below[c] + (0.5f + 0.5f * normal[1]) * (above[c] - below[c]);
        const float sun = sun_light[c] * cosine * points->light[k];
        colour[c] = body * (sun + around * points->openness[k]) + shine * sun +
                    0.5f * gloss * fresnel * sky[c] * points->openness[k];
    }
    /* Far ground melts into the sky at the horizon, so that its edge is never seen. */
    const float haze = points->t[k] * length / shader->haze;
    const float clear = expf(-haze * haze * haze * haze);
    look_sky((const float[3]){view[0], 0.0f, view[2]}, sky);
    for (int c = 0; c < 3; ++c) colour[c] = sky[c] + clear * (colour[c] - sky[c]);
}

/* Compresses bright light as film does (the fit of Narkowicz 2015). */
static void develop(float colour[3]) {
    for (int c = 0; c < 3; ++c) {
        const float x = 0.55f * colour[c];
        colour[c] =
            light_clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 0.0f, 1.0f);
    }
}

void shade_rays(const shading *shader, shade_scratch *scratch, size_t count, const spt_ray *rays,
                const spt_hit *hits, const int *part, float (*colours)[3]) {
    static const float broken[3] = {1.0f, 0.0f, 1.0f};
    surface_points points;
    for (size_t i = 0; i < count; ++i) {
        const float length = sqrtf(light_dot(rays[i].direction, rays[i].direction));
        float direction[3];
        for (int axis = 0; axis < 3; ++axis) direction[axis] = rays[i].direction[axis] / length;
        look_sky(direction, colours[i]);
    }
    gather(shader, scratch, count, rays, hits, &points);
    if (points.count != 0) {
        light_find_openness(shader, scratch, &points);
        light_find_sun(shader, scratch, part, &points);
    }
    for (size_t k = 0; k < points.count; ++k) {
        surface_colour(shader, &points, k, &rays[points.place[k]], colours[points.place[k]]);
    }
    for (size_t i = 0; i < count; ++i) {
        develop(colours[i]);
        /* A value that is no number is the field's fault and has to be seen. */
        if (hits[i].outcome == SPT_NONFINITE) memcpy(colours[i], broken, sizeof broken);
    }
}
