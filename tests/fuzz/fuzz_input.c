/* SPDX-License-Identifier: MIT
 *
 * Reads bytes as a case: rays, settings and a field. Any bytes are a case, and few make a large one. */
#include "fuzz.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* ---- Bytes and numbers ---------------------------------------------------------------------- */

typedef struct reader {
    const uint8_t *data;
    size_t size, at;
    int hostile;
} reader;

static uint32_t read_byte(reader *from) {
    return from->at < from->size ? from->data[from->at++] : 0;
}

static uint32_t read_word(reader *from) {
    uint32_t word = read_byte(from);
    for (int i = 0; i < 3; ++i) word = word << 8 | read_byte(from);
    return word;
}

static float float_of(uint32_t bits) {
    float a;
    memcpy(&a, &bits, sizeof a);
    return a;
}

static uint32_t bits_of(float a) {
    uint32_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

static float read_special(reader *from) {
    static const float list[] = {0.0f,     -0.0f,   INFINITY, -INFINITY, NAN,       FLT_MAX,
                                 -FLT_MAX, FLT_MIN, -FLT_MIN, 1e-42f,    1e-45f,    1e-20f,
                                 1e20f,    -1e20f,  1e-30f,   1e30f,     0x1p127f,  0x1p126f,
                                 0x1p-60f, 0x1p60f, 8.5e37f,  -0x1p100f, 0x1p-100f, 1.0f};
    const uint32_t which = read_byte(from) & 31u;
    return which < sizeof list / sizeof *list ? list[which] : float_of(read_word(from));
}

static float read_uniform(reader *from, float low, float high) {
    const uint32_t word = read_byte(from) << 8 | read_byte(from);
    return low + (high - low) * ((float)word / 65536.0f);
}

/* Between two numbers, or anything at all where the case is hostile. */
static float read_number(reader *from, float low, float high) {
    if (from->hostile && (read_byte(from) & 7u) == 0) return read_special(from);
    return read_uniform(from, low, high);
}

/* ---- Fields --------------------------------------------------------------------------------- */

static uint32_t hash_of(float x, float y, float z) {
    uint32_t hash = bits_of(x) * 2654435761u ^ bits_of(y) * 40503u ^ bits_of(z) * 2246822519u;
    hash = (hash ^ hash >> 15) * 2246822519u;
    return hash ^ hash >> 13;
}

static float noise(uint32_t hash) {
    static const float list[] = {INFINITY, -1e-3f, 3e38f, -3e38f};
    return list[hash & 3];
}

static float smooth_value(const fuzz_field *field, float x, float y, float z, float radius) {
    const float *const p = field->number;
    switch (field->kind) {
    case 0:
        return radius - p[0];
    case 1:
        return z - p[0];
    case 2:
        return (radius - p[0]) * p[1];
    case 3:
        return p[3];
    case 4:
        return fabsf(sinf(z * 3.0f)) * 0.3f - p[1] * 0.01f;
    case 5:
        return fmaxf(fmaxf(fabsf(x), fabsf(y)), fabsf(z)) - p[0];
    default:
        return radius * p[1] - p[0] + 0.3f * sinf(7.0f * x) * sinf(7.0f * y) * sinf(7.0f * z);
    }
}

float fuzz_value(const fuzz_field *field, float x, float y, float z) {
    const float *const p = field->number;
    const uint32_t hash = hash_of(x, y, z);
    const float radius = sqrtf(x * x + y * y + z * z);
    switch (field->kind) {
    case 7:
        return z < p[0] ? p[1] : p[2];
    case 8:
        return (hash & 7) != 0 ? radius - p[0] : float_of(hash * 747796405u);
    case 9:
        return float_of(hash);
    case 10:
        return z > p[0] ? NAN : fabsf(z - p[0] - 1.0f) + p[1];
    case 11:
        return (hash & 1) != 0 ? 1.0f : -1.0f;
    case 12:
        return noise(hash);
    default:
        return smooth_value(field, x, y, z, radius);
    }
}

static float take_point(fuzz_field *field, float x, float y, float z) {
    const float value = fuzz_value(field, x, y, z);
    if (field->points == 0) field->first_value = value;
    ++field->points;
    field->faults += !(fabsf(x) <= FLT_MAX && fabsf(y) <= FLT_MAX && fabsf(z) <= FLT_MAX);
    return value;
}

static void batch_distance(void *user, size_t n, const float *x, const float *y, const float *z,
                           float *distance) {
    fuzz_field *field = user;
    field->faults += n == 0 || n % 16 != 0 || n > SPT_BATCH;
    for (size_t i = 0; i < n; ++i) distance[i] = take_point(field, x[i], y[i], z[i]);
    if (!field->scribble) return;
    float *const scratch[] = {(float *)(uintptr_t)x, (float *)(uintptr_t)y, (float *)(uintptr_t)z};
    for (size_t i = 0; i < 3 * n; ++i) scratch[i % 3][i / 3] = noise((uint32_t)i);
}

static float point_distance(void *user, float x, float y, float z) {
    return take_point(user, x, y, z);
}

/* ---- Cases ---------------------------------------------------------------------------------- */

static void read_field(reader *from, fuzz_case *what) {
    fuzz_field *const distance = &what->distance;
    const uint32_t choice = read_byte(from);
    distance->kind = read_byte(from) % fuzz_kinds;
    distance->number[0] = read_number(from, 0.2f, 3.0f);
    distance->number[1] = read_number(from, 0.1f, 3.0f);
    distance->number[2] = read_number(from, -2.0f, 2.0f);
    distance->number[3] = from->hostile ? read_special(from) : read_uniform(from, -1.0f, 1.0f);
    distance->point = (choice & 1) != 0;
    distance->scribble = (choice & 128) != 0;
    what->field = spt_field_default();
    if (distance->point) {
        what->field.point = point_distance;
    } else {
        what->field.batch = batch_distance;
    }
    what->field.user = distance;
    what->field.flags = (choice & 2) != 0 ? SPT_FIELD_CONVEX : 0;
    if ((choice & 12) == 12) what->field.lipschitz = read_number(from, 0.3f, 3.0f);
    if ((choice & 48) == 0) return;
    const float half = fabsf(read_number(from, 1e-3f, 4.0f));
    const float x = read_number(from, -1.0f, 1.0f);
    what->bound = (choice & 16) != 0
                      ? spt_bound_sphere(x, 0, 0, half)
                      : spt_bound_box(-half, -half, x, half, half, (choice & 64) != 0 ? x : 4.0f);
    what->field.bound = &what->bound;
}

static void read_settings(reader *from, fuzz_case *what) {
    static const uint32_t budgets[] = {0, 1, 2, 3, 5, 17, 64, 128};
    const spt_method *const methods[] = {spt_basic(),    spt_relaxed(), spt_enhanced(),
                                         spt_adaptive(), spt_convex(),  spt_auto_relaxed()};
    const uint32_t choice = read_byte(from);
    spt_settings *const settings = &what->settings;
    *settings = spt_settings_default();
    settings->method = methods[read_byte(from) % 6];
    settings->budget = budgets[read_byte(from) % 8];
    settings->flags = (choice & 1) != 0 ? read_byte(from) & 3u : 0;
    if ((choice & 2) != 0) settings->epsilon = fabsf(read_number(from, 1e-6f, 1e-2f));
    if ((choice & 4) != 0) settings->pixel_radius = fabsf(read_number(from, 0.0f, 1e-2f));
    if ((choice & 8) != 0) settings->size = fabsf(read_number(from, 0.0f, 10.0f));
    if ((choice & 16) != 0) settings->relaxation = read_number(from, 1.0f, 1.999f);
    if ((choice & 32) != 0) settings->extrapolation = read_number(from, 0.0f, 1.0f);
    if ((choice & 64) != 0) settings->slope_blend = read_number(from, 0.01f, 1.0f);
    if ((choice & 128) != 0) settings->step_cap = read_number(from, 1.0f, 100.0f);
}

static void read_ray(reader *from, fuzz_ray *ray) {
    const uint32_t choice = read_byte(from);
    float scale = 1.0f;
    if ((choice & 1) != 0) scale = read_uniform(from, 0.1f, 5.0f);
    if ((choice & 3) == 3) scale = ldexpf(scale, (int)read_byte(from) - 128);
    for (int axis = 0; axis < 3; ++axis) {
        ray->origin[axis] = read_number(from, -4.0f, 4.0f);
        ray->direction[axis] = read_number(from, -1.0f, 1.0f) * scale;
    }
    ray->t_min = (choice & 4) != 0 ? read_number(from, 0.0f, 3.0f) : 0.0f;
    ray->t_max = (choice & 8) != 0 ? read_number(from, 0.0f, 20.0f) : INFINITY;
    ray->path = (choice & 16) != 0 ? read_number(from, 0.0f, 5.0f) : 0.0f;
    ray->active = (choice & 96) != 0 ? -1 : 0;
}

/* Rays that the bytes do not reach repeat the others from beside them. */
static void read_rays(reader *from, fuzz_case *what) {
    what->masked = (read_byte(from) & 1) != 0;
    what->count = 1 + (read_byte(from) << 8 | read_byte(from)) % fuzz_most_rays;
    size_t read = 0;
    for (size_t i = 0; i < what->count; ++i) {
        if (i == 0 || from->at < from->size) {
            read_ray(from, &what->rays[i]);
            read = i + 1;
            continue;
        }
        what->rays[i] = what->rays[i % read];
        what->rays[i].origin[0] += 0.01f * (float)(i / read);
    }
}

void fuzz_read(fuzz_case *what, const uint8_t *data, size_t size) {
    reader from = {data, size, 0, 0};
    memset(what, 0, sizeof *what);
    from.hostile = (read_byte(&from) & 3) == 0;
    what->hostile = from.hostile;
    read_field(&from, what);
    read_settings(&from, what);
    read_rays(&from, what);
}
