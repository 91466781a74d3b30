/* SPDX-License-Identifier: MIT
 *
 * The light that points get of the sun and the sky, by the library's calls for secondary rays. */
#include "models_surface.h"

#include <math.h>
#include <string.h>

static spt_sink sink_of(void *first, size_t stride) {
    const spt_sink sink = {first, (ptrdiff_t)stride};
    return sink;
}

static spt_column column_of(const void *first, size_t stride) {
    const spt_column column = {first, (ptrdiff_t)stride};
    return column;
}

/* ---- The stage ----------------------------------------------------------------------------- */

/* Shadow rays lose light to what they only pass, so bounds must hold what is near, too. Of a
 * distorted field nothing is promised outside of its own bound. */
static void widen(models_stage *stage, size_t index, float by) {
    const spt_bound *bound = stage->fields[index].bound;
    float low[3], high[3];
    if (bound == NULL || stage->world->components[index].distorted != NULL) return;
    if (spt_bound_extent(bound, low, high) != SPT_OK) return;
    stage->bounds[index] = spt_bound_box(low[0] - by, low[1] - by, low[2] - by, high[0] + by,
                                         high[1] + by, high[2] + by);
    stage->fields[index].bound = &stage->bounds[index];
}

void models_stage_set(models_stage *stage, const model *shown, const model_world *world,
                      const spt_settings *settings, float sun) {
    memset(stage, 0, sizeof *stage);
    stage->world = world;
    stage->air = models_air_of(shown);
    stage->settings = *settings;
    stage->sun = sun;
    stage->occlusion = 1;
    stage->casters = world->scene;
    stage->casters.fields = stage->fields;
    for (size_t i = 0; i < world->scene.count; ++i) {
        stage->fields[i] = world->scene.fields[i];
        widen(stage, i, 0.5f * sun * stage->air.unit);
    }
}

size_t models_workspace(const models_stage *stage) {
    return spt_scene_workspace(&stage->casters, &stage->settings);
}

model_material models_material_of(const models_stage *stage, const models_points *points,
                                  size_t k) {
    const model_component *component = &stage->world->components[points->hits[k].component];
    return points->kernel[k] < component->leaf_kernels ? component->leaf_material
                                                       : component->material;
}

/* ---- Light --------------------------------------------------------------------------------- */

/* A leaf that the sun shines on from behind is lit through: its shadow ray starts there. A leaf's
 * thickness is not known here; it is small beside the measure of textures. */
static void start_behind_leaves(const models_stage *stage, models_points *points,
                                float (*origin)[3]) {
    for (size_t k = 0; k < points->count; ++k) {
        const float *n = points->normal[k], *sun = stage->air.sun;
        const float facing = n[0] * sun[0] + n[1] * sun[1] + n[2] * sun[2];
        points->behind[k] = facing < 0.0f && models_material_of(stage, points, k) == MODEL_LEAF;
        if (!points->behind[k]) continue;
        const float away =
            0.0015f * stage->air.unit + 4.0f * stage->settings.pixel_radius * points->hits[k].t;
        for (int axis = 0; axis < 3; ++axis) {
            origin[k][axis] = points->point[k][axis] - away * n[axis];
        }
    }
}

static spt_status find_sun(const models_stage *stage, void *workspace, size_t workspace_size,
                           float (*origin)[3], const float *path, models_points *points) {
    spt_settings settings = stage->settings;
    int32_t outcome[SPT_BATCH];
    float ratio[SPT_BATCH];
    const float far = 4.0f * stage->air.haze;
    spt_rays rays = spt_rays_of(points->rays);
    spt_hits hits;
    memset(&hits, 0, sizeof hits);
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis] = column_of(&origin[0][axis], sizeof origin[0]);
        rays.direction[axis] = column_of(&stage->air.sun[axis], 0);
    }
    rays.t_min.first = NULL;
    rays.t_max = column_of(&far, 0);
    rays.path = column_of(path, sizeof path[0]);
    hits.outcome = sink_of(outcome, sizeof outcome[0]);
    settings.flags = SPT_SKIP_START | SPT_STOP_INSIDE;
    if (stage->sun > 0.0f) {
        settings.method = spt_basic(); /* its samples tell most of what they pass */
        settings.flags |= SPT_CANDIDATE_PENUMBRA;
        hits.candidate_ratio = sink_of(ratio, sizeof ratio[0]);
    }
    const spt_status status = spt_scene_trace(&stage->casters, &settings, points->count, &rays,
                                              &hits, workspace, workspace_size, NULL);
    for (size_t k = 0; k < points->count; ++k) {
        const float seen = stage->sun > 0.0f ? spt_penumbra(outcome[k], ratio[k], stage->sun)
                                             : (float)(outcome[k] != SPT_HIT);
        points->sun[k] = seen * seen * (3.0f - 2.0f * seen);
    }
    return status;
}

spt_status models_find_light(const models_stage *stage, void *workspace, size_t workspace_size,
                             models_points *points) {
    const spt_scene *scene = &stage->world->scene;
    float origin[SPT_BATCH][3], path[SPT_BATCH];
    if (points->count == 0) return SPT_OK;
    const spt_rays rays = spt_rays_of(points->rays);
    const spt_hits hits = spt_hits_of(points->hits);
    const spt_vectors normals = spt_vectors_of(points->normal[0]);
    const spt_vectors at = spt_vectors_of(points->point[0]);
    const spt_sink openness = sink_of(points->openness, sizeof points->openness[0]);
    spt_starts starts;
    memset(&starts, 0, sizeof starts);
    starts.origin = spt_vector_sinks_of(origin[0]);
    starts.path = sink_of(path, sizeof path[0]);
    spt_status status = spt_offset(scene->fields, scene->count, &stage->settings, points->count,
                                   &rays, &hits, &normals, NULL, 1, &starts);
    start_behind_leaves(stage, points, origin);
    if (status == SPT_OK) {
        status = find_sun(stage, workspace, workspace_size, origin, path, points);
    }
    if (status != SPT_OK || !stage->occlusion) {
        for (size_t k = 0; k < points->count; ++k) points->openness[k] = 1.0f;
        return status;
    }
    return spt_ambient_occlusion(scene->fields, scene->count, 5, 0.016f * stage->air.unit,
                                 points->count, &at, &normals, &openness);
}
