/* SPDX-License-Identifier: MIT
 *
 * The shading of the pictures: one key light, the sky, a ground. What a caller of the library does
 * with hits, none of it part of the library. */
#include "shade.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { occlusion_samples = 5, probe_side = 48 };

static const float sun_direction[3] = {-0.7011f, 0.6210f,
                                       0.3506f}; /* unit length, towards the sun */
static const float sun_light[3] = {2.60f, 2.30f, 1.90f};
static const float sun_radius = 0.045f; /* tangent of the disc's angular radius */

/* What is known of the points to be shaded; entry k belongs to ray place[k]. */
typedef struct surface_points {
    size_t count;
    size_t place[SPT_BATCH];
    float point[SPT_BATCH][3], normal[SPT_BATCH][3];
    float t[SPT_BATCH], half_pixel[SPT_BATCH], residual[SPT_BATCH];
    float light[SPT_BATCH], openness[SPT_BATCH]; /* of sun and sky, 0 to 1 */
    int on_ground[SPT_BATCH];                    /* on the added ground */
} surface_points;

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static float clamp(float value, float low, float high) {
    return value > low ? (value < high ? value : high) : low; /* NaN becomes low */
}

/* The field at the first count points of the batch. */
static void evaluate(const shading *shader, size_t count) {
    shade_batch *batch = shader->batch;
    const size_t padded = (count + 15) / 16 * 16;
    for (size_t i = count; i < padded; ++i) {
        batch->x[i] = batch->x[0];
        batch->y[i] = batch->y[0];
        batch->z[i] = batch->z[0];
    }
    shader->field.batch(shader->field.user, padded, batch->x, batch->y, batch->z, batch->distance);
}

/* The lowest point of the surface: rays upwards from under the bound, none of which sees less than
 * the object's underside. */
static float lowest_point(const shading *shader, const float low[3], const float high[3]) {
    enum { count = probe_side * probe_side };
    spt_ray *rays = malloc(count * sizeof *rays);
    float *t = malloc(count * sizeof *t);
    float lowest = INFINITY;
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
    if (rays != NULL && t != NULL) {
        const spt_rays views = spt_rays_of(rays);
        if (spt_trace(&shader->field, &settings, count, &views, &hits, NULL) == SPT_OK) {
            for (size_t i = 0; i < count; ++i) lowest = t[i] < lowest ? t[i] : lowest;
        }
    }
    free(rays);
    free(t);
    return lowest < INFINITY ? low[1] - 0.5f + lowest : low[1];
}

spt_field shade_field(const scene *shown, uint32_t max_lanes) {
    int lanes = spt_lanes();
    if (max_lanes != 0 && (int)max_lanes < lanes) lanes = (int)max_lanes;
    return scene_field(shown, lanes);
}

shading shader_create(const scene *shown, float epsilon, float pixel_radius, int sun_side,
                      uint32_t max_lanes, spt_statistics *statistics) {
    shading shader;
    memset(&shader, 0, sizeof shader);
    shader.look = look_of(shown->name);
    shader.field = shade_field(shown, max_lanes);
    shader.epsilon = epsilon;
    shader.pixel_radius = pixel_radius;
    shader.sun_side = sun_side;
    shader.max_lanes = max_lanes;
    shader.statistics = statistics;
    shader.memory = malloc(sizeof *shader.batch + 64);
    if (shader.memory == NULL) return shader;
    shader.batch = (shade_batch *)(((uintptr_t)shader.memory + 63) & ~(uintptr_t)63);
    double away = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        away += (shown->target[axis] - shown->eye[axis]) * (shown->target[axis] - shown->eye[axis]);
    }
    shader.size = (float)sqrt(away) * 0.5f;
    shader.ground = -INFINITY;
    shader.haze = 0.7f * (float)shown->t_max;
    float low[3], high[3];
    if (shader.look->has_ground) {
        shader.ground = shader.look->ground;
        shader.ground_is_traced = 1;
        shader.ground_is_added = shown->bound != NULL;
    } else if (shown->bound != NULL && spt_bound_extent(shown->bound, low, high) == SPT_OK) {
        shader.ground = lowest_point(&shader, low, high);
        shader.ground_is_added = 1;
        shader.haze = 20.0f * shader.size;
        shader.size = 0.5f * fmaxf(high[0] - low[0], fmaxf(high[1] - low[1], high[2] - low[2]));
    }
    return shader;
}

void shader_free(shading *shader) {
    free(shader->memory);
    shader->memory = NULL;
    shader->batch = NULL;
}

/* Where a ray meets the added ground, or infinity. */
static float ground_at(const shading *shader, const spt_ray *ray) {
    if (!shader->ground_is_added || !(ray->direction[1] < 0.0f)) return INFINITY;
    const float t = (shader->ground - ray->origin[1]) / ray->direction[1];
    return t > 0.0f ? t : INFINITY;
}

void shade_cut_rays(const shading *shader, size_t count, spt_ray *rays) {
    for (size_t i = 0; i < count; ++i) {
        const float ground = ground_at(shader, &rays[i]);
        if (ground < rays[i].t_max) rays[i].t_max = ground;
    }
}

void shade_normals(const shading *shader, size_t count, const float (*points)[3],
                   const float *scale, float (*normals)[3]) {
    shade_batch *batch = shader->batch;
    float step[SPT_BATCH];
    for (size_t i = 0; i < count; ++i) {
        /* The step where rounding (unit 2^-24, of coordinates and size) and curvature do equal
         * harm; at least a quarter of the half pixel, so that what is smaller is averaged. */
        const float largest =
            fmaxf(fabsf(points[i][0]), fmaxf(fabsf(points[i][1]), fabsf(points[i][2])));
        const float size = shader->size;
        step[i] = cbrtf(0x1p-24f * (largest + size) * size * size);
        step[i] = fmaxf(step[i], 0.25f * scale[i]);
    }
    for (int side = 0; side < 6; ++side) {
        float *const moved[3] = {batch->x, batch->y, batch->z};
        const int axis = side / 2;
        const float sign = side % 2 == 0 ? 1.0f : -1.0f;
        for (size_t i = 0; i < count; ++i) {
            batch->x[i] = points[i][0];
            batch->y[i] = points[i][1];
            batch->z[i] = points[i][2];
            moved[axis][i] += sign * step[i];
        }
        evaluate(shader, count);
        for (size_t i = 0; i < count; ++i) {
            normals[i][axis] =
                (side % 2 == 0 ? 0.0f : normals[i][axis]) + sign * batch->distance[i];
        }
    }
    for (size_t i = 0; i < count; ++i) {
        const float length = sqrtf(dot(normals[i], normals[i]));
        const float inverse = length > 0.0f && length < INFINITY ? 1.0f / length : 0.0f;
        for (int axis = 0; axis < 3; ++axis) {
            normals[i][axis] = inverse > 0.0f ? normals[i][axis] * inverse : 0.0f;
        }
    }
}

/* The points that rays reach, on the object or the ground, with their normals. */
static void gather(const shading *shader, size_t count, const spt_ray *rays, const spt_hit *hits,
                   surface_points *found) {
    found->count = 0;
    for (size_t i = 0; i < count; ++i) {
        const float ground = ground_at(shader, &rays[i]);
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
        found->half_pixel[k] = shader->pixel_radius * t;
        found->residual[k] = on_ground ? 0.0f : fmaxf(hits[i].residual, 0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            found->point[k][axis] = rays[i].origin[axis] + t * rays[i].direction[axis];
        }
    }
    if (found->count == 0) return;
    shade_normals(shader, found->count, (const float(*)[3])found->point, found->half_pixel,
                  found->normal);
    for (size_t k = 0; k < found->count; ++k) {
        if (found->on_ground[k]) {
            memcpy(found->normal[k], (const float[3]){0.0f, 1.0f, 0.0f}, sizeof found->normal[k]);
        } else if (!(dot(found->normal[k], found->normal[k]) > 0.0f)) {
            for (int axis = 0; axis < 3; ++axis) {
                found->normal[k][axis] = -rays[found->place[k]].direction[axis];
            }
        }
    }
}

/* Ambient occlusion by distances along the normal (Evans 2006): how much nearer the surface is than
 * over a plane, near samples counting most. */
static void find_openness(const shading *shader, surface_points *points) {
    shade_batch *batch = shader->batch;
    const float spacing = 0.04f * shader->size;
    float lost[SPT_BATCH] = {0.0f}, most = 0.0f, weight = 1.0f;
    for (int sample = 1; sample <= occlusion_samples; ++sample) {
        const float height = spacing * (float)sample;
        weight *= 0.5f;
        most += weight * height;
        for (size_t k = 0; k < points->count; ++k) {
            batch->x[k] = points->point[k][0] + height * points->normal[k][0];
            batch->y[k] = points->point[k][1] + height * points->normal[k][1];
            batch->z[k] = points->point[k][2] + height * points->normal[k][2];
        }
        evaluate(shader, points->count);
        for (size_t k = 0; k < points->count; ++k) {
            float distance = batch->distance[k] / shader->field.lipschitz;
            if (shader->ground_is_added) distance = fminf(distance, batch->y[k] - shader->ground);
            lost[k] += weight * (height - clamp(distance, 0.0f, height));
        }
    }
    for (size_t k = 0; k < points->count; ++k) {
        /* A corner still gets light from its open side, which samples along its walls miss. */
        points->openness[k] = 1.0f - 0.7f * lost[k] / most;
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
    const float flat =
        sqrtf(sun_direction[0] * sun_direction[0] + sun_direction[2] * sun_direction[2]);
    const float right[3] = {sun_direction[2] / flat, 0.0f, -sun_direction[0] / flat};
    const float up[3] = {sun_direction[1] * right[2],
                         sun_direction[2] * right[0] - sun_direction[0] * right[2],
                         -sun_direction[1] * right[0]};
    for (int axis = 0; axis < 3; ++axis) {
        direction[axis] =
            sun_direction[axis] +
            sun_radius * radius * (cosf(angle) * right[axis] + sinf(angle) * up[axis]);
    }
}

/* How much of the sun is seen. Each ray goes to one part of its disc; how closely it passes other
 * surfaces, as an angle, tells how much of that part they cover. The closeness comes with the hit:
 * with no path travelled before, candidate_ratio is the least distance over length of the way. */
static void find_light(const shading *shader, const int *part, surface_points *points) {
    spt_ray rays[SPT_BATCH];
    spt_hit hits[SPT_BATCH];
    for (size_t k = 0; k < points->count; ++k) {
        /* Two tolerances off the surface, less what the hit already is. */
        const float lift = fmaxf(2.0f * fmaxf(points->half_pixel[k], shader->epsilon) -
                                     points->residual[k] / shader->field.lipschitz,
                                 0.0f);
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
    const spt_rays ray_views = spt_rays_of(rays);
    const spt_hits hit_views = spt_hits_of(hits);
    spt_trace(&shader->field, &settings, points->count, &ray_views, &hit_views, shader->statistics);
    /* As far as from the middle of one part to the next, so that the shadows' edges join. */
    const float part_radius = 2.0f * sun_radius / (float)shader->sun_side;
    for (size_t k = 0; k < points->count; ++k) {
        const float share = clamp(hits[k].candidate_ratio / part_radius, 0.0f, 1.0f);
        points->light[k] =
            hits[k].outcome == SPT_HIT ? 0.0f : share * share * (3.0f - 2.0f * share);
    }
}

/* Light of the sun mirrored by a rough surface (GGX; Walter et al. 2007), for unit vectors. */
static float highlight(const float normal[3], const float view[3], float roughness) {
    float half[3];
    for (int axis = 0; axis < 3; ++axis) half[axis] = sun_direction[axis] + view[axis];
    const float length = sqrtf(dot(half, half));
    if (!(length > 0.0f)) return 0.0f;
    const float cosine = clamp(dot(normal, half) / length, 0.0f, 1.0f);
    const float width = roughness * roughness * roughness * roughness;
    const float fall = cosine * cosine * (width - 1.0f) + 1.0f;
    return 0.25f * width / (fall * fall);
}

static void surface_colour(const shading *shader, const surface_points *points, size_t k,
                           const spt_ray *ray, float colour[3]) {
    const float *normal = points->normal[k], *point = points->point[k];
    const float length = sqrtf(dot(ray->direction, ray->direction));
    float view[3], mirrored[3], albedo[3], sky[3], ground_albedo[3];
    for (int c = 0; c < 3; ++c) view[c] = -ray->direction[c] / length;
    const float facing = clamp(dot(normal, view), 0.0f, 1.0f);
    for (int c = 0; c < 3; ++c) mirrored[c] = 2.0f * facing * normal[c] - view[c];

    /* On a ground that is part of the field: what lies within two half pixels of its plane, and
     * softly so. */
    const float slope = fmaxf(fabsf(view[1]), 1e-3f);
    float grounded = points->on_ground[k] ? 1.0f : 0.0f;
    if (shader->ground_is_traced) {
        const float over =
            (point[1] - shader->ground) / (2.0f * fmaxf(points->half_pixel[k], shader->epsilon));
        grounded = clamp(2.0f - over, 0.0f, 1.0f) * clamp(normal[1] * 4.0f - 2.0f, 0.0f, 1.0f);
    }
    look_albedo(shader->look, point, albedo);
    look_ground_albedo(point[0], point[2], 0.5f * shader->size,
                       2.0f * points->half_pixel[k] / slope, ground_albedo);
    look_sky(mirrored, sky);
    const float gloss = shader->look->gloss * (1.0f - grounded);
    const float cosine = clamp(dot(normal, sun_direction), 0.0f, 1.0f);
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
        colour[c] = clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 0.0f, 1.0f);
    }
}

void shade_rays(const shading *shader, size_t count, const spt_ray *rays, const spt_hit *hits,
                const int *part, float (*colours)[3]) {
    static const float broken[3] = {1.0f, 0.0f, 1.0f};
    surface_points points;
    for (size_t i = 0; i < count; ++i) {
        const float length = sqrtf(dot(rays[i].direction, rays[i].direction));
        float direction[3];
        for (int axis = 0; axis < 3; ++axis) direction[axis] = rays[i].direction[axis] / length;
        look_sky(direction, colours[i]);
    }
    gather(shader, count, rays, hits, &points);
    if (points.count != 0) {
        find_openness(shader, &points);
        find_light(shader, part, &points);
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
