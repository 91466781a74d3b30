/* SPDX-License-Identifier: MIT
 *
 * Reads bytes as a case of fuzz_scene.h. Any bytes are a case, and few make a large one. */
#include "fuzz_scene.h"

#include "fuzz_reader.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Bytes and numbers ---------------------------------------------------------------------- */

/* ---- Components ------------------------------------------------------------------------------ */

float fuzz_part_value(const fuzz_part *part, float x, float y, float z) {
    return fuzz_value(&part->distance, x - part->offset[0], y - part->offset[1],
                      z - part->offset[2]);
}

static float take_point(fuzz_part *part, float x, float y, float z) {
    fuzz_field *const field = &part->distance;
    ++field->points;
    field->faults += !(fabsf(x) <= FLT_MAX && fabsf(y) <= FLT_MAX && fabsf(z) <= FLT_MAX);
    return fuzz_part_value(part, x, y, z);
}

static void part_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                       float *distance) {
    fuzz_part *const part = user;
    float *const scratch[] = {(float *)(uintptr_t)x, (float *)(uintptr_t)y, (float *)(uintptr_t)z};
    part->distance.faults += n == 0 || n % 16 != 0 || n > SPT_BATCH;
    for (size_t i = 0; i < n; ++i) distance[i] = take_point(part, x[i], y[i], z[i]);
    for (size_t i = 0; part->distance.scribble && i < 3 * n; ++i) scratch[i % 3][i / 3] = NAN;
}

static float part_point(void *user, float x, float y, float z) {
    return take_point(user, x, y, z);
}

uint64_t fuzz_scene_points(const fuzz_scene_case *what) {
    uint64_t points = 0;
    for (size_t i = 0; i < what->scene.count; ++i) points += what->parts[i].distance.points;
    return points;
}

uint64_t fuzz_scene_faults(const fuzz_scene_case *what) {
    uint64_t faults = 0;
    for (size_t i = 0; i < what->scene.count; ++i) faults += what->parts[i].distance.faults;
    return faults;
}

void fuzz_scene_clear(fuzz_scene_case *what) {
    for (size_t i = 0; i < what->scene.count; ++i) {
        what->parts[i].distance.points = what->parts[i].distance.faults = 0;
    }
}

static void read_part(reader *from, fuzz_scene_case *what, size_t index) {
    static fuzz_case one;
    fuzz_part *const part = &what->parts[index];
    const reader bytes = read_slice(from, 20);
    spt_field *const field = &what->fields[index];
    fuzz_read(&one, bytes.data, bytes.size);
    part->distance = one.distance;
    part->bound = one.bound;
    *field = one.field;
    field->user = part;
    field->batch = part->distance.point ? NULL : part_batch;
    field->point = part->distance.point ? part_point : NULL;
    for (int axis = 0; axis < 3; ++axis) {
        const float offset = read_number(from, -3.0f, 3.0f);
        part->offset[axis] = offset;
        part->bound.center[axis] += offset;
        part->bound.low[axis] += offset;
        part->bound.high[axis] += offset;
    }
    if (field->bound != NULL) field->bound = &part->bound;
}

static void read_scene(reader *from, fuzz_scene_case *what) {
    what->scene = spt_scene_default();
    what->scene.fields = what->fields;
    what->scene.count = 1 + read_byte(from) % fuzz_most_parts;
    what->scene.zone_count = read_byte(from) % 16;
    if (what->scene.zone_count > fuzz_most_zones) what->scene.zone_count = 0;
    what->scene.zones = what->scene.zone_count != 0 ? what->zones : NULL;
    for (size_t i = 0; i < what->scene.count; ++i) {
        const uint32_t same = read_byte(from);
        if (i > 0 && same % 8 == 1) { /* one of those before once more */
            const size_t other = same / 8 % i;
            what->parts[i] = what->parts[other];
            what->fields[i] = what->fields[other];
            what->fields[i].user = &what->parts[i];
            if (what->fields[i].bound != NULL) what->fields[i].bound = &what->parts[i].bound;
        } else {
            read_part(from, what, i);
        }
    }
    for (size_t i = 0; i < what->scene.zone_count; ++i) {
        spt_zone *const zone = &what->zones[i];
        for (int axis = 0; axis < 3; ++axis) zone->center[axis] = read_number(from, -4.0f, 4.0f);
        zone->radius = fabsf(read_number(from, 0.01f, 3.0f));
        zone->component = (int32_t)(read_byte(from) % (what->scene.count + 1)) - 1;
    }
}

/* ---- Frames ---------------------------------------------------------------------------------- */

/* The caller's rays are those of the case, picked by the place in the image. */
static void camera_rays(void *user, size_t count, const float *x, const float *y,
                        spt_camera_ray *rays) {
    const fuzz_scene_case *const what = user;
    for (size_t i = 0; i < count; ++i) {
        const uint32_t place = (uint32_t)(x[i] * 2.0f) * 31u + (uint32_t)(y[i] * 2.0f) * 17u;
        const fuzz_ray *const from = &what->rest.rays[place % what->rest.count];
        memcpy(rays[i].ray.origin, from->origin, sizeof from->origin);
        memcpy(rays[i].ray.direction, from->direction, sizeof from->direction);
        rays[i].ray.t_min = from->t_min;
        rays[i].ray.t_max = from->t_max;
        rays[i].path = from->path;
        rays[i].active = from->active;
    }
}

/* Colours of everything that a shader is handed. */
static void shade(void *user, size_t count, const float *x, const float *y, const spt_ray *rays,
                  const spt_hit *hits, float *colours) {
    const fuzz_scene_case *const what = user;
    const uint32_t channels = what->frame.channels;
    for (size_t i = 0; i < count * channels; ++i) {
        const size_t pixel = i / channels;
        colours[i] = i % channels == 0 ? hits[pixel].t + rays[pixel].direction[0]
                                       : x[pixel] - y[pixel] + (float)hits[pixel].evaluations;
    }
}

static spt_status read_camera(reader *from, fuzz_scene_case *what, uint32_t width,
                              uint32_t height) {
    const uint32_t choice = read_byte(from);
    float eye[3], target[3], up[3] = {0.0f, 1.0f, 0.0f};
    if ((choice & 3) == 3) {
        what->camera = spt_camera_of_rays(camera_rays, what);
        return SPT_OK;
    }
    for (int axis = 0; axis < 3; ++axis) {
        eye[axis] = read_number(from, -6.0f, 6.0f);
        target[axis] = read_number(from, -1.0f, 1.0f);
    }
    const float opening = fabsf(read_number(from, 0.01f, 3.0f));
    const spt_status status =
        (choice & 1) != 0
            ? spt_camera_orthographic(&what->camera, eye, target, up, opening, width, height)
            : spt_camera_pinhole(&what->camera, eye, target, up, opening, width, height);
    if (status == SPT_OK && (choice & 4) != 0) {
        what->camera.x_low *= read_number(from, -1.0f, 3.0f);
        what->camera.y_high += read_number(from, -1.0f, 3.0f);
    }
    if (status == SPT_OK && (choice & 8) != 0) what->camera.t_min = read_number(from, 0.0f, 5.0f);
    if (status == SPT_OK && (choice & 16) != 0) what->camera.t_max = read_number(from, 0.0f, 12.0f);
    return status;
}

static void read_passes(reader *from, fuzz_scene_case *what) {
    static const size_t counts[] = {1, 2, 4, 6};
    const uint32_t choice = read_byte(from);
    what->frame.passes = spt_passes(counts[choice % 4]);
    what->frame.pass_count = counts[choice % 4];
    if ((choice & 8) == 0) return;
    what->frame.pass_count = 1 + (choice >> 4) % fuzz_most_passes;
    for (size_t i = 0; i < what->frame.pass_count; ++i) {
        spt_pass *const pass = &what->passes[i];
        pass->denominator = 1 + read_byte(from) % 9;
        pass->numerator = 1 + read_byte(from) % pass->denominator;
        pass->share = ((float)read_byte(from) + 1.0f) / 256.0f;
        if (i + 1 == what->frame.pass_count) pass->numerator = pass->denominator;
    }
    what->frame.passes = what->passes;
}

static void read_frame(reader *from, fuzz_scene_case *what) {
    const uint32_t width = 1 + read_byte(from) % 24, height = 1 + read_byte(from) % 20;
    const uint32_t choice = read_byte(from);
    const int in_a_corner = (choice & 1) != 0; /* so that more tiles than one are met */
    const uint32_t whole_width = in_a_corner ? width + 50 : width;
    what->has_frame = 0;
    if (read_camera(from, what, whole_width, height) != SPT_OK) return;
    if (spt_frame_init(&what->frame, &what->scene, &what->camera, whole_width, height) != SPT_OK) {
        return;
    }
    what->has_frame = 1;
    what->frame.left = whole_width - width;
    what->frame.top = (choice & 2) != 0 ? height / 3 : 0;
    if ((choice & 4) == 0) what->rest.settings.pixel_radius = what->frame.settings.pixel_radius;
    what->frame.settings = what->rest.settings;
    what->frame.flags = (choice >> 3) & 3u;
    read_passes(from, what);
    what->slice = 1 + (read_byte(from) << 4);
    if ((choice & 32) != 0) {
        what->frame.shade = shade;
        what->frame.shade_user = what;
        what->frame.channels = 1 + read_byte(from) % 4;
    }
    if ((choice & 64) == 0) return;
    for (size_t i = 0; i < fuzz_most_pixels; ++i) {
        what->depths[i] = i < 8 ? read_number(from, 0.0f, 10.0f) : what->depths[i % 8];
    }
    what->frame.t_max.first = what->depths;
    what->frame.t_max.stride = sizeof *what->depths;
}

void fuzz_scene_read(fuzz_scene_case *what, const uint8_t *data, size_t size) {
    reader from = {data, size, 0, 0};
    memset(what, 0, sizeof *what);
    from.hostile = (read_byte(&from) & 3) == 0;
    read_scene(&from, what);
    reader frame_bytes = read_slice(&from, 48);
    fuzz_read(&what->rest, data + from.at, size - from.at);
    read_frame(&frame_bytes, what);
}

/* ---- Rules ----------------------------------------------------------------------------------- */

static int is_finite(float a) {
    return fabsf(a) <= FLT_MAX;
}

static int within(float a, float low, float high) {
    return a >= low && a <= high;
}

static int bound_is_legal(const spt_bound *bound) {
    if (bound == NULL) return 1;
    for (int axis = 0; axis < 3; ++axis) {
        if (bound->kind == SPT_BOUND_SPHERE) {
            if (!is_finite(bound->center[axis])) return 0;
        } else {
            if (!is_finite(bound->low[axis]) || !is_finite(bound->high[axis])) return 0;
            if (!(bound->low[axis] <= bound->high[axis])) return 0;
        }
    }
    return bound->kind != SPT_BOUND_SPHERE || (is_finite(bound->radius) && bound->radius > 0.0f);
}

int fuzz_scene_is_legal(const fuzz_scene_case *what) {
    const spt_settings *const s = &what->rest.settings;
    for (size_t i = 0; i < what->scene.count; ++i) {
        const spt_field *const field = &what->fields[i];
        if (!within(field->lipschitz, 0x1p-100f, 0x1p100f)) return 0;
        if (!bound_is_legal(field->bound)) return 0;
        if (s->method == spt_convex() && (field->flags & SPT_FIELD_CONVEX) == 0) return 0;
    }
    for (size_t i = 0; i < what->scene.zone_count; ++i) {
        const spt_zone *const zone = &what->zones[i];
        for (int axis = 0; axis < 3; ++axis) {
            if (!is_finite(zone->center[axis])) return 0;
        }
        if (!(zone->radius > 0.0f) || !is_finite(zone->radius)) return 0;
    }
    return is_finite(s->epsilon) && s->epsilon > 0.0f && within(s->pixel_radius, 0.0f, FLT_MAX) &&
           within(s->size, 0.0f, FLT_MAX) && s->relaxation >= 1.0f && s->relaxation < 2.0f &&
           within(s->extrapolation, 0.0f, 1.0f) && s->slope_blend > 0.0f &&
           s->slope_blend <= 1.0f && within(s->step_cap, 1.0f, 100.0f);
}

/* ---- Memory ---------------------------------------------------------------------------------- */

enum { slack = 64, slack_value = 0xe7 };

static unsigned char *memories[2];

void *fuzz_memory(int which, size_t size, int value) {
    static size_t rooms[2];
    if (memories[which] == NULL || size > rooms[which]) {
        free(memories[which]);
        memories[which] = malloc(size + slack);
        if (memories[which] == NULL) abort();
        rooms[which] = size;
    }
    memset(memories[which], value, size);
    memset(memories[which] + size, slack_value, slack);
    return memories[which];
}

int fuzz_memory_kept(int which, size_t size) {
    for (size_t i = size; i < size + slack; ++i) {
        if (memories[which][i] != slack_value) return 0;
    }
    return 1;
}
