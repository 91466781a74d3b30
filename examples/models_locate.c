/* SPDX-License-Identifier: MIT
 *
 * Where hits are: refined, located in the kernels, with the normals that their pixels see. */
#include "models_surface.h"

#include <math.h>
#include <string.h>

/* Points of one component as they are located: those of rays that end where they begin, the way
 * from the eye behind them, which tells how large a pixel is there. */
typedef struct located {
    float origin[SPT_BATCH][3]; /* before the distortion */
    spt_hit hits[SPT_BATCH];
    spt_rays rays;
} located;

static spt_sink sink_of(void *first, size_t stride) {
    const spt_sink sink = {first, (ptrdiff_t)stride};
    return sink;
}

static spt_column column_of(const void *first, size_t stride) {
    const spt_column column = {first, (ptrdiff_t)stride};
    return column;
}

static spt_krs_places places_of(models_points *points) {
    spt_krs_places places;
    memset(&places, 0, sizeof places);
    places.kernel = sink_of(points->kernel, sizeof points->kernel[0]);
    places.mirrors = sink_of(points->mirrors, sizeof points->mirrors[0]);
    places.point = spt_vector_sinks_of(points->kernel_point[0]);
    places.normal = spt_vector_sinks_of(points->normal[0]);
    places.kernel_normal = spt_vector_sinks_of(points->kernel_normal[0]);
    places.u = sink_of(points->u, sizeof points->u[0]);
    places.v = sink_of(points->v, sizeof points->v[0]);
    places.scale = sink_of(points->scale, sizeof points->scale[0]);
    return places;
}

static spt_status ask(const models_stage *stage, int32_t index, size_t count, located *at,
                      const spt_krs_places *places) {
    const model_component *component = &stage->world->components[index];
    const spt_hits hits = spt_hits_of(at->hits);
    return component->krs != NULL ? spt_krs_locate(component->krs, index, &stage->settings, count,
                                                   &at->rays, &hits, places)
                                  : spt_moekrs_locate(component->moekrs, index, &stage->settings,
                                                      count, &at->rays, &hits, places);
}

/* ---- The size of a pixel in u and v -------------------------------------------------------- */

/* Two unit vectors in the plane across a normal. */
static void tangents(const float normal[3], float along[2][3]) {
    const int least = fabsf(normal[0]) < fabsf(normal[1])
                          ? (fabsf(normal[0]) < fabsf(normal[2]) ? 0 : 2)
                          : (fabsf(normal[1]) < fabsf(normal[2]) ? 1 : 2);
    const int b = (least + 1) % 3, c = (least + 2) % 3;
    const float length = sqrtf(normal[b] * normal[b] + normal[c] * normal[c]);
    along[0][least] = 0.0f;
    along[0][b] = -normal[c] / length;
    along[0][c] = normal[b] / length;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        along[1][i] = normal[j] * along[0][k] - normal[k] * along[0][j];
    }
}

/* How much u and v change over a pixel: from two points beside each, half a pixel away. Where both
 * lie on other kernels the kernel is smaller than that: all of it is in the pixel. */
static spt_status measure(const models_stage *stage, int32_t index, located *at,
                          models_points *points) {
    float moved[SPT_BATCH][3], u[SPT_BATCH], v[SPT_BATCH];
    float square[SPT_BATCH][2] = {{0.0f, 0.0f}};
    int32_t kernel[SPT_BATCH], found[SPT_BATCH] = {0};
    spt_krs_places places;
    spt_status status = SPT_OK;
    memset(&places, 0, sizeof places);
    places.kernel = sink_of(kernel, sizeof kernel[0]);
    places.u = sink_of(u, sizeof u[0]);
    places.v = sink_of(v, sizeof v[0]);
    for (int axis = 0; axis < 3; ++axis) {
        at->rays.origin[axis] = column_of(&moved[0][axis], sizeof moved[0]);
    }
    for (int side = 0; side < 2 && status == SPT_OK; ++side) {
        for (size_t k = 0; k < points->count; ++k) {
            float along[2][3];
            tangents(points->normal[k], along);
            for (int axis = 0; axis < 3; ++axis) {
                moved[k][axis] = at->origin[k][axis] + 0.5f * points->wide[k] * along[side][axis];
            }
        }
        status = ask(stage, index, points->count, at, &places);
        for (size_t k = 0; k < points->count; ++k) {
            if (points->hits[k].component != index || kernel[k] != points->kernel[k]) continue;
            const float du = 2.0f * (u[k] - points->u[k]);
            float dv = fabsf(v[k] - points->v[k]);
            dv = 2.0f * fminf(dv, 1.0f - dv); /* around a capsule */
            square[k][0] += du * du;
            square[k][1] += dv * dv;
            found[k] = 1;
        }
    }
    for (size_t k = 0; k < points->count; ++k) {
        if (points->hits[k].component != index) continue;
        points->u_wide[k] = found[k] ? sqrtf(square[k][0]) : 1.0f;
        points->v_wide[k] = found[k] ? sqrtf(square[k][1]) : 1.0f;
    }
    return status;
}

/* ---- Locating ------------------------------------------------------------------------------ */

static spt_status locate(const models_stage *stage, int32_t index, models_points *points) {
    const spt_distorted *distorted = stage->world->components[index].distorted;
    const spt_vectors from = spt_vectors_of(points->point[0]);
    const spt_krs_places places = places_of(points);
    located at;
    const spt_vector_sinks to = spt_vector_sinks_of(at.origin[0]);
    spt_status status = SPT_OK;
    memcpy(at.origin, points->point, points->count * sizeof at.origin[0]);
    if (distorted != NULL) status = spt_distorted_points(distorted, points->count, &from, &to);
    memcpy(at.hits, points->hits, points->count * sizeof at.hits[0]);
    at.rays = spt_rays_of(points->rays);
    for (int axis = 0; axis < 3; ++axis) {
        at.rays.origin[axis] = column_of(&at.origin[0][axis], sizeof at.origin[0]);
    }
    at.rays.t_min.first = NULL;
    at.rays.t_max.first = NULL;
    at.rays.path = column_of(&points->hits[0].t, sizeof points->hits[0]);
    for (size_t k = 0; k < points->count; ++k) at.hits[k].t = 0.0f;
    if (status == SPT_OK) status = ask(stage, index, points->count, &at, &places);
    for (size_t k = 0; k < points->count; ++k) {
        float *n = points->normal[k];
        if (n[0] * n[0] + n[1] * n[1] + n[2] * n[2] > 0.5f) continue;
        for (int axis = 0; axis < 3; ++axis) n[axis] = -points->rays[k].direction[axis];
    }
    return status == SPT_OK ? measure(stage, index, &at, points) : status;
}

/* ---- Normals ------------------------------------------------------------------------------- */

/* Normals by differences of the field, at chosen points. over: how many pixels they span. */
static spt_status difference_normals(const models_stage *stage, models_points *points,
                                     const int32_t *wanted, int without_gradients, float over,
                                     float (*normals)[3]) {
    const size_t count = stage->world->scene.count;
    spt_settings settings = stage->settings;
    spt_field fields[MODEL_COMPONENTS];
    spt_rays rays = spt_rays_of(points->rays);
    const spt_hits hits = spt_hits_of(points->hits);
    const spt_vector_sinks sinks = spt_vector_sinks_of(normals[0]);
    memcpy(fields, stage->world->scene.fields, count * sizeof fields[0]);
    for (size_t i = 0; i < count && without_gradients; ++i) fields[i].gradient = NULL;
    rays.active = column_of(wanted, sizeof wanted[0]);
    settings.pixel_radius *= 4.0f * over; /* a step is an eighth of a pixel */
    return spt_normals(fields, count, &settings, SPT_NORMAL_CENTRAL, 0.0f, points->count, &rays,
                       &hits, &sinks);
}

/* Distorted bodies have other normals than what they are made of, and leaves that are smaller than
 * a pixel have no single one: that of their crown, by differences over the pixel. */
static spt_status mend_normals(const models_stage *stage, models_points *points) {
    int32_t distorted[SPT_BATCH], small[SPT_BATCH], any_distorted = 0, any_small = 0;
    float crown[SPT_BATCH][3];
    spt_status status = SPT_OK;
    for (size_t k = 0; k < points->count; ++k) {
        distorted[k] = stage->world->components[points->hits[k].component].distorted != NULL;
        small[k] = models_material_of(stage, points, k) == MODEL_LEAF && points->u_wide[k] > 0.2f;
        any_distorted |= distorted[k];
        any_small |= small[k];
    }
    if (any_distorted) {
        status = difference_normals(stage, points, distorted, 0, 0.25f, points->normal);
    }
    if (!any_small || status != SPT_OK) return status;
    status = difference_normals(stage, points, small, 1, 2.0f, crown);
    for (size_t k = 0; k < points->count; ++k) {
        const float share = fminf((points->u_wide[k] - 0.2f) / 0.6f, 1.0f);
        float *n = points->normal[k], square = 0.0f;
        if (!small[k]) continue;
        for (int axis = 0; axis < 3; ++axis) {
            n[axis] += share * (crown[k][axis] - n[axis]);
            square += n[axis] * n[axis];
        }
        if (!(square > 1e-6f)) continue;
        for (int axis = 0; axis < 3; ++axis) n[axis] /= sqrtf(square);
    }
    return status;
}

/* ---- Hits ---------------------------------------------------------------------------------- */

static void take_hits(size_t count, const spt_ray *rays, const spt_hit *hits,
                      models_points *points) {
    points->count = 0;
    for (size_t i = 0; i < count; ++i) {
        if (hits[i].outcome != SPT_HIT) continue;
        const size_t k = points->count++;
        points->place[k] = i;
        points->rays[k] = rays[i];
        points->hits[k] = hits[i];
    }
}

spt_status models_find_points(const models_stage *stage, size_t count, const spt_ray *rays,
                              const spt_hit *hits, models_points *points) {
    const spt_scene *scene = &stage->world->scene;
    take_hits(count, rays, hits, points);
    if (points->count == 0) return SPT_OK;
    memset(points->normal, 0, sizeof points->normal);
    const spt_rays ray_views = spt_rays_of(points->rays);
    const spt_hits hit_views = spt_hits_of(points->hits);
    spt_status status = spt_refine(scene->fields, scene->count, &stage->settings, 3, points->count,
                                   &ray_views, &hit_views);
    for (size_t k = 0; k < points->count; ++k) {
        points->wide[k] = 2.0f * stage->settings.pixel_radius * points->hits[k].t;
        for (int axis = 0; axis < 3; ++axis) {
            points->point[k][axis] =
                points->rays[k].origin[axis] + points->hits[k].t * points->rays[k].direction[axis];
        }
    }
    for (size_t i = 0; status == SPT_OK && i < scene->count; ++i) {
        int met = 0;
        for (size_t k = 0; k < points->count; ++k) met |= points->hits[k].component == (int32_t)i;
        if (met) status = locate(stage, (int32_t)i, points);
    }
    return status == SPT_OK ? mend_normals(stage, points) : status;
}
