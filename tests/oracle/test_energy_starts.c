/* SPDX-License-Identifier: MIT
 *
 * Secondary rays of the path tracer on all scenes, looked at between the library's calls: they begin
 * on the right side, inherit the path, and none meets the surface that it leaves. */
#include <path_room.h>
#include <path_wave.h>

#include "../check.h"

#include <math.h>

enum { width = 640, height = 360, side = 48 };
static path_stage stage;
static path_state leaving[PATH_WAVE]; /* by pixel: the ray that met the surface, */
static spt_hit left[PATH_WAVE];       /* where, */
static int32_t start[PATH_WAVE];      /* and how its successor began */

/* What was seen on a scene. */
typedef struct survey {
    uint64_t rays, near; /* near: hits within the offset length */
} survey;

/* The distance to a component in double, over its Lipschitz constant, at t on a ray. */
static double distance_along(const scene *shown, int32_t component, const spt_ray *ray, double t) {
    double p[3], f;
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = (double)ray->origin[axis] + t * (double)ray->direction[axis];
    }
    scene_part_reference(shown, SCENE_OBJECTS, (size_t)component, 1, &p[0], &p[1], &p[2], &f);
    return f / (double)stage.scene.fields[component].lipschitz;
}

/* Whether a ray crosses the component before `end`, by at most 10 000 steps in double. */
static int crosses(const scene *shown, int32_t component, const spt_ray *ray, double end) {
    double t = 0;
    for (int step = 0; step < 10000 && t < end; ++step) {
        const double f = distance_along(shown, component, ray, t);
        if (f < 1e-7) return 1;
        t += f;
    }
    return 0;
}

/* A hit within the offset length of the ray's own start is true if the surface is there, or if the
 * ray comes closer to it: in a corner, or on a hollow. */
static void look_at_hit(const scene *shown, const path_state *path, const spt_hit *hit,
                        double tolerance, survey *seen) {
    const spt_ray *ray = &path->ray;
    const double t = (double)hit->t;
    if (hit->outcome != SPT_HIT || t > 2 * tolerance) return;
    ++seen->near;
    if (hit->component != left[path->pixel].component) return;
    const double first = distance_along(shown, hit->component, ray, 0);
    const double last = distance_along(shown, hit->component, ray, t);
    if (first < 0) { /* no offset came out of a gap */
        CHECK_SAY(start[path->pixel] != SPT_START_CLEAR, "begins %g inside", -first);
    } else if (!crosses(shown, hit->component, ray, 16 * tolerance)) {
        CHECK_SAY(last < first, "leaves component %d at %g, ends at %g (t %g, tolerance %g)",
                  hit->component, first, last, t, tolerance);
    }
}

/* The path of a ray is that of the one before and its length. */
static void check_inheritance(const path_state *path) {
    const path_state *before = &leaving[path->pixel];
    const double way = (double)before->travelled + (double)left[path->pixel].t;
    CHECK_SAY(fabs((double)path->travelled - way) <= 1e-6 * way, "path %g, not %g",
              (double)path->travelled, way);
}

static void look_at_rays(const scene *shown, const path_wave *wave, survey *seen) {
    const spt_settings *settings = &wave->job->scattered;
    for (size_t i = 0; i < wave->count; ++i) {
        const path_state *path = &wave->paths[i];
        const double cone = (double)settings->pixel_radius * (double)path->travelled;
        check_inheritance(path);
        look_at_hit(shown, path, &wave->hits[i], fmax((double)settings->epsilon, cone), seen);
    }
    seen->rays += wave->count;
}

static void trace_wave(const scene *shown, path_wave *wave, const uint32_t area[4], survey *seen) {
    path_wave_begin(wave, area, 0);
    while (wave->count > 0) {
        path_wave_trace(wave);
        if (wave->bounce > 0) look_at_rays(shown, wave, seen);
        path_wave_escape(wave);
        path_wave_land(wave);
        for (size_t i = 0; i < wave->count; ++i) {
            const uint32_t pixel = wave->paths[i].pixel;
            leaving[pixel] = wave->paths[i];
            left[pixel] = wave->hits[i];
            start[pixel] = wave->start[i];
        }
        path_wave_shine(wave);
        path_wave_scatter(wave);
    }
    CHECK(wave->status == SPT_OK);
}

static void energy_starts_on_all_scenes(void) {
    static const uint32_t area[4] = {288, 160, 288 + side, 160 + side};
    survey all = {0, 0};
    for (size_t k = 0; k < scene_count; ++k) {
        path_settings settings = path_settings_default();
        path_job job;
        settings.roulette = settings.bounces + 1;
        check_context("%s", scenes[k]->name);
        path_open_air(&stage, scenes[k], SCENE_OBJECTS, width, height);
        CHECK(path_job_create(&job, &stage.world, &settings, width, height));
        path_wave *wave = path_wave_create(&job);
        CHECK(wave != NULL);
        if (wave != NULL) trace_wave(scenes[k], wave, area, &all);
        path_wave_free(wave);
        path_job_free(&job);
    }
    CHECK_SAY(all.rays > 50000 && all.near > 200, "%llu rays, %llu near hits",
              (unsigned long long)all.rays, (unsigned long long)all.near);
}

void suite_energy_starts(void) {
    RUN(energy_starts_on_all_scenes);
}
