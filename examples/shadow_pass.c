/* SPDX-License-Identifier: MIT
 *
 * The idea introduced here: secondary rays as a frame of their own. A camera whose callback makes
 * the shadow ray of a pixel from its hit gives a shadow pass; at a quarter of the resolution it
 * takes a sixteenth of the rays, and is put over the picture where depths agree. */
#include "image.h"
#include "shade_light.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { width = 640, height = 360, count = width * height, coarser = 4 };
enum { small_width = width / coarser, small_count = small_width * (height / coarser) };

/* What the first pass leaves behind. */
static spt_camera_ray eye_rays[count];
static float t[count];

/* The shadow rays of pixels that are *user pixels of the picture across. */
static void shadow_rays(void *user, size_t points, const float *x, const float *y,
                        spt_camera_ray *rays) {
    const float across = *(const float *)user;
    for (size_t i = 0; i < points; ++i) {
        const int column = (int)fminf(x[i] * across, width - 1);
        const int pixel = (int)fminf(y[i] * across, height - 1) * width + column;
        const spt_ray *eye_ray = &eye_rays[pixel].ray;
        rays[i].active = t[pixel] < INFINITY;
        if (!rays[i].active) continue;
        for (int axis = 0; axis < 3; ++axis) {
            rays[i].ray.origin[axis] = eye_ray->origin[axis] + t[pixel] * eye_ray->direction[axis];
            rays[i].ray.direction[axis] = light_sun_direction[axis];
        }
    }
}

/* Traces a whole frame whose pixels are so many of the picture's across. */
static int trace(const spt_scene *parts, const spt_camera *camera, float across,
                 const spt_hits *hits) {
    spt_statistics statistics = spt_statistics_default();
    spt_frame frame;
    const uint32_t columns = (uint32_t)(width / across), rows = (uint32_t)(height / across);
    if (spt_frame_init(&frame, parts, camera, columns, rows) != SPT_OK) return 0;
    if (camera->kind == SPT_CAMERA_RAYS) {
        frame.settings.method = spt_relaxed(); /* its samples come close to what they pass */
        frame.settings.flags = SPT_SKIP_START; /* off the surface that the ray starts on */
        frame.flags = SPT_FRAME_NO_CONES;      /* rays from all over the scene share none */
    }
    frame.statistics = &statistics;
    frame.workspace_size = spt_frame_workspace(&frame);
    frame.workspace = malloc(frame.workspace_size);
    const int traced = frame.workspace != NULL &&
                       spt_frame_trace(&frame, 0, spt_frame_tiles(&frame), hits, NULL) == SPT_OK;
    free(frame.workspace);
    printf("%7llu rays, %.2f evaluations each\n", (unsigned long long)statistics.rays,
           (double)statistics.evaluations / (double)statistics.rays);
    return traced;
}

/* The shadow pass of pixels that are so many of the picture's across. */
static int trace_shadows(const spt_scene *casters, float across, spt_hit *found) {
    const spt_camera camera = spt_camera_of_rays(shadow_rays, &across);
    const spt_hits hits = spt_hits_of(found);
    return trace(casters, &camera, across, &hits);
}

static spt_hit coarse[small_count], fine[count];

/* The pixel of the picture that a pixel of the coarse pass stands for. */
static int middle_of(int column, int row) {
    return (row * coarser + coarser / 2) * width + column * coarser + coarser / 2;
}

/* The light at a pixel: bilinear in the coarse pass, without pixels of another depth. */
static float light_at(int x, int y) {
    const float own = t[y * width + x];
    const float column = ((float)x + 0.5f) / coarser - 0.5f;
    const float row = ((float)y + 0.5f) / coarser - 0.5f;
    float light = 0.0f, weights = 0.0f;
    for (int corner = 0; corner < 4; ++corner) {
        const int i = (int)floorf(column) + corner % 2, j = (int)floorf(row) + corner / 2;
        if (i < 0 || j < 0 || i >= small_width || j >= height / coarser) continue;
        float weight = (1.0f - fabsf(column - (float)i)) * (1.0f - fabsf(row - (float)j)) + 1e-6f;
        if (!(fabsf(t[middle_of(i, j)] - own) < 0.05f * own)) weight *= 1e-3f;
        const spt_hit *hit = &coarse[j * small_width + i];
        if (hit->outcome != SPT_HIT) light += weight * fminf(hit->candidate_ratio / 0.09f, 1.0f);
        weights += weight;
    }
    return light / weights;
}

/* The colours of a row. */
static void compose(const shading *shader, shade_scratch *scratch, int y, image *picture) {
    for (int x = 0; x < width; ++x) {
        const int pixel = y * width + x;
        const spt_ray *ray = &eye_rays[pixel].ray;
        float *colour = image_at(picture, x, y), point[1][3], normal[1][3], albedo[3];
        const float half_pixel = shader->pixel_radius * t[pixel];
        look_sky(ray->direction, colour);
        if (!(t[pixel] < INFINITY)) continue;
        for (int c = 0; c < 3; ++c) point[0][c] = ray->origin[c] + t[pixel] * ray->direction[c];
        shade_normals(shader, scratch, 1, (const float(*)[3])point, &half_pixel, normal);
        look_albedo(shader->look, point[0], albedo);
        if (point[0][1] < 2.0f * half_pixel) {
            look_ground_albedo(point[0][0], point[0][2], 4.0f, 4.0f * half_pixel, albedo);
        }
        const float cosine = light_dot(normal[0], light_sun_direction);
        const float sun = cosine > 0.0f ? 1.2f * cosine * light_at(x, y) : 0.0f;
        for (int c = 0; c < 3; ++c) colour[c] = albedo[c] * (sun + 0.35f + 0.15f * normal[0][1]);
    }
}

int main(int argument_count, char **arguments) {
    static scene_parts parts;
    static shading shader;
    shade_scratch scratch;
    const scene *const shown = scene_named("village");
    const spt_camera camera = scene_camera(shown, width, height);
    image picture = image_create(width, height, 3);
    const float pixel_radius = (camera.x_high - camera.x_low) / (2 * width);
    spt_hits hits = {0};
    hits.t.first = t;
    hits.t.stride = sizeof *t;
    for (int i = 0; i < count; ++i) {
        const float x = (float)(i % width) + 0.5f, y = (float)(i / width) + 0.5f;
        spt_camera_rays(&camera, width, height, 1, &x, &y, &eye_rays[i]);
    }
    scene_parts_of(shown, SCENE_OBJECTS, spt_lanes(), &parts);
    if (picture.pixels == NULL || !trace(&parts.scene, &camera, 1, &hits) ||
        !shading_create(&shader, shown, SCENE_OBJECTS, 1e-4f, pixel_radius, 1, 0) ||
        !shade_scratch_create(&scratch, &shader) ||
        !trace_shadows(&shader.casters.scene, coarser, coarse) ||
        !trace_shadows(&shader.casters.scene, 1, fine)) {
        return 1;
    }
    int different = 0; /* the same rays, traced among others */
    for (int i = 0; i < small_count; ++i) {
        const spt_hit *hit = &fine[middle_of(i % small_width, i / small_width)];
        different += coarse[i].outcome != hit->outcome || coarse[i].t != hit->t;
    }
    printf("%d of the coarse pass are not as in the fine one\n", different);
    for (int y = 0; y < height; ++y) compose(&shader, &scratch, y, &picture);
    const int failed = argument_count > 1 && image_write(arguments[1], &picture) != 0;
    shade_scratch_free(&scratch);
    image_free(&picture);
    return failed ? 2 : different != 0;
}
