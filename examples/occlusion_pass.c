/* SPDX-License-Identifier: MIT
 *
 * The idea introduced here: ambient occlusion by 16 frames of short rays from the hits, at half the
 * resolution, each traced a few evaluations a call. Some of the ground is checked by formula. */
#include "image.h"
#include "scenes/scene_village.h"
#include "shade_light.h"

#include <math.h>
#include <string.h>

enum { width = 640, height = 360, count = width * height, coarser = 2 };
enum { small_width = width / coarser, small_count = small_width * (height / coarser) };
enum { samples = 16, a_call = 50000 };
static const float reach = 0.75f; /* of the rays: no wall is as low */

/* What the first pass leaves behind (tolerance 0: nothing was hit) and what is made of it. */
static float point[count][3], normal[count][3], tolerance[count], light[count];
static spt_hit primary[count], found[small_count], again[small_count];
static int seen[small_count];
static char workspace[1 << 22], state[1 << 23]; /* too small a one is refused */

/* The rays of sample *user, their directions by the density of the cosine: the normal and a point
 * of the sphere, of the even sequence of Roberts (2018) that begins at a hash of the pixel. */
static void occlusion_rays(void *user, size_t points, const float *x, const float *y,
                           spt_camera_ray *rays) {
    for (size_t i = 0; i < points; ++i) {
        const int pixel = ((int)y[i] * width + (int)x[i]) * coarser;
        rays[i].active = tolerance[pixel] > 0.0f;
        if (!rays[i].active) continue;
        uint64_t hash = ((uint64_t)pixel + 1) * 0x9e3779b97f4a7c15;
        hash = (hash ^ hash >> 32) * 0xd6e8feb86659fd93;
        const uint32_t u = (uint32_t)(hash >> 32) + *(const uint32_t *)user * 3242174889u;
        const uint32_t v = (uint32_t)(hash >> 8) + *(const uint32_t *)user * 2447445414u;
        const float z = 1.0f - (float)(u >> 8) * 0x1p-23f, radius = sqrtf(1.0f - z * z);
        const float angle = (float)(v >> 8) * 0x1.921fb6p-22f;
        const float ball[3] = {radius * cosf(angle), radius * sinf(angle), z};
        for (int c = 0; c < 3; ++c) rays[i].ray.direction[c] = normal[pixel][c] + ball[c];
        memcpy(rays[i].ray.origin, point[pixel], sizeof point[pixel]);
        rays[i].ray.t_max = reach / sqrtf(light_dot(rays[i].ray.direction, rays[i].ray.direction));
        rays[i].path = primary[pixel].t; /* the tolerance goes on from that of the hit */
    }
}

/* Far from all houses the ground sees the whole sky. Before a long wall a chord cuts off those that
 * hit it from directions by the density of the cosine, even in the unit disc (Nusselt). */
static int check_ground(void) {
    int open = 0, dark = 0, walls = 0;
    double mean = 0.0, expected = 0.0, error = 0.0; /* sums, until they are printed */
    for (int i = 0; i < small_count; ++i) {
        const int pixel = (i / small_width * width + i % small_width) * coarser;
        const spt_point ground = spt_point_of(point[pixel][0], 0, point[pixel][2]);
        float away = INFINITY; /* from the wall; -1: there is more than its middle */
        if (!(fabsf(point[pixel][1]) < tolerance[pixel])) continue;
        for (int k = 0; k < VILLAGE_HOUSES; ++k) {
            const village_house *const house = &village_houses[k];
            const spt_point q = village_seen_from(house, ground);
            const float across = q.x - house->half_width, along = q.z - house->half_depth;
            const float most = fmaxf(across, along), least = fminf(across, along);
            if (most > reach + tolerance[pixel]) continue;
            away = away == INFINITY && least < -reach ? most : -1.0f;
        }
        open += away == INFINITY;
        dark += away == INFINITY && seen[i] != samples;
        if (!(away > 0.0f && away < reach)) continue;
        const double h = (double)(away / reach), pi = acos(-1.0);
        ++walls;
        mean += (double)seen[i] / samples;
        expected += 1.0 - (acos(h) - h * sqrt(1.0 - h * h)) / pi;
        error += 2.0 / pi * (double)(tolerance[pixel] / reach); /* hits come early */
    }
    error += 4.0 * 0.5 * sqrt(walls / (double)samples); /* four sigma of independent rays */
    printf("%d pixels of open ground, %d dark; %d by a wall: %.4f, by formula %.4f within %.4f\n",
           open, dark, walls, mean / walls, expected / walls, error / walls);
    return open > 0 && dark == 0 && fabs(mean - expected) < error;
}

/* The light at a pixel: bilinear in means of 4x4, without those off its plane. */
static float light_at(int x, int y) {
    const int own = y * width + x;
    float sum = 0.0f, weights = 0.0f;
    for (int k = 0; tolerance[own] > 0.0f && k < 36; ++k) {
        const int i = x / coarser - 2 + k % 6, j = y / coarser - 2 + k / 6;
        if (i < 0 || j < 0 || i >= small_width || j >= height / coarser) continue;
        const int other = (j * width + i) * coarser;
        const float off = light_dot(normal[own], point[other]) - light_dot(normal[own], point[own]);
        float weight = light_clamp(2.5f - fabsf((float)i - (float)x / coarser), 0, 1) *
                       light_clamp(2.5f - fabsf((float)j - (float)y / coarser), 0, 1);
        if (!(fabsf(off) < 4.0f * fminf(tolerance[own], tolerance[other]))) weight *= 1e-3f;
        sum += weight * (float)seen[j * small_width + i] / samples;
        weights += weight;
    }
    return weights > 0.0f ? (0.5f + 0.25f * normal[own][1]) * sum / weights : 1.0f;
}

/* Where the rays of the eye ended, and the normals of what they hit, by central differences. */
static void find_points(const spt_frame *frame, const scene *f) {
    for (int i = 0; i < count; ++i) {
        const float x = (float)(i % width) + 0.5f, y = (float)(i / width) + 0.5f, t = primary[i].t;
        float *const p = point[i], *const n = normal[i];
        spt_camera_ray eye_ray;
        if (primary[i].outcome != SPT_HIT) continue;
        tolerance[i] = frame->settings.pixel_radius * t;
        spt_camera_rays(frame->camera, width, height, 1, &x, &y, &eye_ray);
        for (int c = 0; c < 3; ++c) p[c] = eye_ray.ray.origin[c] + t * eye_ray.ray.direction[c];
        const float h = 0.5f * tolerance[i];
        n[0] = f->point(NULL, p[0] + h, p[1], p[2]) - f->point(NULL, p[0] - h, p[1], p[2]);
        n[1] = f->point(NULL, p[0], p[1] + h, p[2]) - f->point(NULL, p[0], p[1] - h, p[2]);
        n[2] = f->point(NULL, p[0], p[1], p[2] + h) - f->point(NULL, p[0], p[1], p[2] - h);
        const float length = sqrtf(light_dot(n, n));
        for (int c = 0; c < 3; ++c) n[c] /= length;
    }
}

int main(int argument_count, char **arguments) {
    static scene_parts parts;
    uint32_t sample, calls = 0, different = 0;
    const scene *const shown = scene_named("village");
    const spt_camera eye = scene_camera(shown, width, height);
    const spt_camera hemisphere = spt_camera_of_rays(occlusion_rays, &sample);
    const spt_hits all = spt_hits_of(primary), each = spt_hits_of(found), once = spt_hits_of(again);
    const image picture = {width, height, 1, light};
    spt_frame frame;
    scene_parts_of(shown, SCENE_OBJECTS, spt_lanes(), &parts);
    spt_frame_init(&frame, &parts.scene, &eye, width, height);
    frame.workspace = workspace;
    frame.workspace_size = sizeof workspace;
    if (spt_frame_trace(&frame, 0, spt_frame_tiles(&frame), &all, NULL) != SPT_OK) return 1;
    find_points(&frame, shown);
    frame.camera = &hemisphere;
    frame.width = frame.right = small_width;
    frame.height = frame.bottom = height / coarser;
    frame.settings.flags = SPT_SKIP_START; /* off the surface that the ray starts on */
    frame.flags = SPT_FRAME_NO_CONES;      /* rays from all over the scene share none */
    for (sample = 0; sample < samples; ++sample) {
        spt_frame_progress now = {0, 0, 0, 0, 0};
        if (spt_frame_restart(&frame, state, sizeof state) != SPT_OK) return 1;
        for (; now.pass == 0; ++calls) {
            if (spt_frame_advance(&frame, state, sizeof state, a_call, &each, &now)) return 1;
        }
        for (int i = 0; i < small_count; ++i) seen[i] += found[i].outcome == SPT_MISS;
        if (spt_frame_trace(&frame, 0, spt_frame_tiles(&frame), &once, NULL)) return 1;
        different += memcmp(found, again, sizeof found) != 0;
    }
    printf("%u calls, %u frames not as without a break\n", (unsigned)calls, (unsigned)different);
    if (!check_ground() || different != 0 || calls < 2 * samples) return 1;
    for (int i = 0; i < count; ++i) light[i] = light_at(i % width, i / width);
    return argument_count > 1 && image_write(arguments[1], &picture) != 0 ? 2 : 0;
}
