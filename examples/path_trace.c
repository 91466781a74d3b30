/* SPDX-License-Identifier: MIT
 *
 * What a wave asks the library for: hits, shadows, normals, and origins off the surface. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime */
#include "path_wave.h"

#include <time.h>

static double thread_seconds(void) {
#ifdef CLOCK_THREAD_CPUTIME_ID
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
#else
    return (double)clock() / CLOCKS_PER_SEC;
#endif
}

/* The rays and the lengths travelled where they lie, in structures of that size. */
static spt_rays rays_among(const spt_ray *first, const float *travelled, size_t size) {
    spt_rays rays = spt_rays_of(first);
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis].stride = rays.direction[axis].stride = (ptrdiff_t)size;
    }
    rays.t_min.stride = rays.t_max.stride = rays.path.stride = (ptrdiff_t)size;
    rays.path.first = travelled;
    return rays;
}

static spt_rays path_columns(const path_wave *wave) {
    return rays_among(&wave->paths->ray, &wave->paths->travelled, sizeof *wave->paths);
}

/* Of a hit only what is used, so that the rest is not worked out. */
static spt_hits hit_columns(path_wave *wave) {
    const spt_hits all = spt_hits_of(wave->hits);
    spt_hits hits = {0};
    hits.t = all.t;
    hits.residual = all.residual;
    hits.outcome = all.outcome;
    hits.component = all.component;
    return hits;
}

static void trace_scene(path_wave *wave, const spt_settings *settings, size_t count,
                        const spt_rays *rays, const spt_hits *hits, spt_statistics *statistics) {
    const spt_scene *scene = &wave->job->scene;
    const spt_status status =
        scene->count == 1 ? spt_trace(scene->fields, settings, count, rays, hits, statistics)
                          : spt_scene_trace(scene, settings, count, rays, hits, wave->workspace,
                                            wave->workspace_size, statistics);
    path_wave_note(wave, status);
}

void path_wave_trace(path_wave *wave) {
    const path_ray kind = wave->bounce == 0 ? PATH_PRIMARY : PATH_SECONDARY;
    const spt_rays rays = path_columns(wave);
    const spt_hits hits = hit_columns(wave);
    const double before = thread_seconds();
    trace_scene(wave, kind == PATH_PRIMARY ? &wave->job->primary : &wave->job->scattered,
                wave->count, &rays, &hits, &wave->statistics.traced[kind]);
    wave->statistics.seconds[kind] += thread_seconds() - before;
}

void path_wave_trace_shadows(path_wave *wave) {
    const path_job *job = wave->job;
    const size_t count = wave->shadow_count;
    const spt_rays rays =
        rays_among(&wave->shadows->ray, &wave->shadows->travelled, sizeof *wave->shadows);
    spt_statistics *statistics = &wave->statistics.traced[PATH_SHADOW];
    spt_hits hits = {0};
    const double before = thread_seconds();
    hits.outcome.first = wave->occluded; /* SPT_MISS is 0: the ray is free */
    hits.outcome.stride = sizeof *wave->occluded;
    if (job->scene.count == 1) {
        const spt_status status = spt_occluded(job->scene.fields, &job->scattered, count, &rays,
                                               &hits.outcome, statistics);
        path_wave_note(wave, status);
    } else {
        trace_scene(wave, &job->scattered, count, &rays, &hits, statistics);
    }
    wave->statistics.seconds[PATH_SHADOW] += thread_seconds() - before;
}

void path_wave_land(path_wave *wave) {
    enum { checks = 2 };
    const path_job *job = wave->job;
    const spt_rays rays = path_columns(wave);
    const spt_hits hits = hit_columns(wave);
    const spt_vector_sinks normals = spt_vector_sinks_of(wave->normal[0]);
    spt_starts starts;
    starts.origin = spt_vector_sinks_of(wave->origin[0]);
    starts.path.first = wave->travelled;
    starts.path.stride = sizeof *wave->travelled;
    starts.start.first = wave->start;
    starts.start.stride = sizeof *wave->start;
    spt_status status = spt_normals(job->scene.fields, job->scene.count, &job->scattered,
                                    SPT_NORMAL_CENTRAL, 0.0f, wave->count, &rays, &hits, &normals);
    for (size_t i = 0; status == SPT_OK && i < wave->count; ++i) {
        float *normal = wave->normal[i];
        if (path_dot(normal, normal) > 0.0f) continue; /* else back to where the path came from */
        for (int c = 0; c < 3; ++c) normal[c] = -wave->paths[i].ray.direction[c];
    }
    if (status == SPT_OK) {
        const spt_vectors outward = spt_vectors_of(wave->normal[0]);
        const spt_column stay = {NULL, 0};
        /* Without hits.flags all rays count as begun outside. Those that SPT_STOP_INSIDE ended in a
         * wall (next to the one they left, in a corner) so come out of it. */
        status = spt_offset(job->scene.fields, job->scene.count, &job->scattered, wave->count,
                            &rays, &hits, &outward, &stay, checks, &starts);
    }
    path_wave_note(wave, status);
}
