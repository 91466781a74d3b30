/* SPDX-License-Identifier: MIT
 *
 * Reads bytes as a case of fuzz_surface.h. Any bytes are a case, and few make a large one. */
#include "fuzz_surface.h"

#include "fuzz_reader.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* ---- Bytes and numbers ---------------------------------------------------------------------- */

/* ---- Fields and volumes ---------------------------------------------------------------------- */

float fuzz_surface_value(const void *parts, size_t field, float x, float y, float z) {
    return fuzz_value(&((const fuzz_volume_part *)parts)[field].distance, x, y, z);
}

static float take_point(fuzz_volume_part *part, float x, float y, float z) {
    fuzz_field *const field = &part->distance;
    ++field->points;
    field->faults += !(fabsf(x) <= FLT_MAX && fabsf(y) <= FLT_MAX && fabsf(z) <= FLT_MAX);
    return fuzz_value(field, x, y, z);
}

static void spoil_points(size_t n, const float *x, const float *y, const float *z) {
    float *const scratch[] = {(float *)(uintptr_t)x, (float *)(uintptr_t)y, (float *)(uintptr_t)z};
    for (size_t i = 0; i < 3 * n; ++i) scratch[i % 3][i / 3] = NAN;
}

static void part_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                       float *distance) {
    fuzz_volume_part *const part = user;
    part->distance.faults += n == 0 || n % 16 != 0 || n > SPT_BATCH;
    for (size_t i = 0; i < n; ++i) distance[i] = take_point(part, x[i], y[i], z[i]);
    if (part->distance.scribble) spoil_points(n, x, y, z);
}

static float part_point(void *user, float x, float y, float z) {
    return take_point(user, x, y, z);
}

/* Right for balls around the origin, something for the others. */
static void part_gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                          float *gradient_x, float *gradient_y, float *gradient_z) {
    fuzz_volume_part *const part = user;
    const float scale = part->distance.number[1];
    part->distance.faults += n == 0 || n % 16 != 0 || n > SPT_BATCH;
    for (size_t i = 0; i < n; ++i) {
        gradient_x[i] = x[i] * scale;
        gradient_y[i] = y[i] * scale;
        gradient_z[i] = z[i] * scale;
    }
    if (part->distance.scribble) spoil_points(n, x, y, z);
}

/* What a caller's volume says of a ray; the same for the same ray. */
static void interval_of(fuzz_volume_part *part, const float origin[3], const float direction[3],
                        float *t_in, float *t_out) {
    static const float ends[][2] = {
        {-INFINITY, INFINITY}, {INFINITY, -INFINITY}, {NAN, NAN}, {1.0f, 6.0f},
        {3.0f, 2.0f},          {-FLT_MAX, FLT_MAX},   {NAN, 4.0f}};
    const uint32_t answer = part->answer % 8;
    float largest = 0.0f;
    for (int axis = 0; axis < 3; ++axis) largest = fmaxf(largest, fabsf(direction[axis]));
    ++part->intervals;
    part->distance.faults += !(largest >= 1.0f && largest <= 4.0f);
    part->distance.faults += !(fabsf(origin[0]) + fabsf(origin[1]) + fabsf(origin[2]) <= INFINITY);
    if (answer == 7) return;
    *t_in = ends[answer][0];
    *t_out = ends[answer][1];
}

static void interval_batch(void *user, size_t n, const float *const origin[3],
                           const float *const direction[3], float *t_in, float *t_out) {
    ((fuzz_volume_part *)user)->distance.faults += n == 0 || n % 16 != 0 || n > 256;
    for (size_t i = 0; i < n; ++i) {
        const float o[] = {origin[0][i], origin[1][i], origin[2][i]};
        const float d[] = {direction[0][i], direction[1][i], direction[2][i]};
        interval_of(user, o, d, &t_in[i], &t_out[i]);
    }
}

static void interval_point(void *user, const float origin[3], const float direction[3], float *t_in,
                           float *t_out) {
    interval_of(user, origin, direction, t_in, t_out);
}

static void read_triple(reader *from, float to[3], float low, float high) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = read_number(from, low, high);
}

static void read_planes(reader *from, fuzz_volume_part *part) {
    const size_t count = 1 + read_byte(from) % fuzz_surface_planes;
    for (size_t i = 0; i < count; ++i) {
        read_triple(from, part->planes[i].normal, -1.0f, 1.0f);
        part->planes[i].offset = read_number(from, -0.5f, 3.0f);
    }
    part->bound = spt_bound_polytope(part->planes, count);
}

static void read_bound(reader *from, fuzz_volume_part *part) {
    const uint32_t kind = 1 + read_byte(from) % 9, choice = read_byte(from);
    const float turn = choice & 1 ? 0.6f : 1.0f, rest = choice & 1 ? 0.8f : 0.0f;
    float axes[3][3] = {{turn, rest, 0.0f}, {-rest, turn, 0.0f}, {0.0f, 0.0f, 1.0f}};
    float one[3], other[3], half[3];
    spt_bound *const bound = &part->bound;
    read_triple(from, one, -1.0f, 1.0f);
    read_triple(from, other, -1.5f, 1.5f);
    read_triple(from, half, 0.01f, 3.0f);
    if (from->hostile && (choice & 30) == 2)
        axes[(choice >> 6) % 3][choice >> 5 & 1] = read_special(from);
    part->answer = choice >> 1;
    if (kind == SPT_BOUND_SPHERE) *bound = spt_bound_sphere(one[0], one[1], one[2], half[0]);
    if (kind == SPT_BOUND_BOX) {
        *bound = spt_bound_box(one[0] - half[0], one[1] - half[1], one[2] - half[2],
                               one[0] + half[0], one[1] + half[1], one[2] + half[2]);
    }
    if (kind == SPT_BOUND_ORIENTED_BOX) *bound = spt_bound_oriented_box(one, axes, half);
    if (kind == SPT_BOUND_CAPSULE) *bound = spt_bound_capsule(one, other, half[0]);
    if (kind == SPT_BOUND_CYLINDER) *bound = spt_bound_cylinder(one, other, half[0]);
    if (kind == SPT_BOUND_ELLIPSOID) *bound = spt_bound_ellipsoid(one, axes, half);
    if (kind == SPT_BOUND_SLAB) *bound = spt_bound_slab(other, one[0] - half[0], one[0] + half[1]);
    if (kind == SPT_BOUND_POLYTOPE) read_planes(from, part);
    if (kind == SPT_BOUND_CALLBACK) {
        *bound = spt_bound_callback(choice & 16 ? interval_batch : NULL,
                                    choice & 48 ? interval_point : NULL, part);
    }
    if (kind < SPT_BOUND_SLAB || (choice & 64) == 0) return;
    for (int axis = 0; axis < 3; ++axis) {
        bound->low[axis] = read_number(from, -4.0f, 0.0f);
        bound->high[axis] = read_number(from, 0.0f, 4.0f);
    }
}

static void read_part(reader *from, fuzz_surface_case *what, int index) {
    static fuzz_case one;
    fuzz_volume_part *const part = &what->parts[index];
    spt_field *const field = &what->fields[index];
    const reader bytes = read_slice(from, 16);
    const uint32_t choice = read_byte(from);
    fuzz_read(&one, bytes.data, bytes.size);
    part->distance = one.distance;
    *field = one.field;
    field->user = part;
    field->batch = part->distance.point ? NULL : part_batch;
    field->point = part->distance.point ? part_point : NULL;
    field->gradient = choice & 1 ? part_gradient : NULL;
    field->bound = NULL;
    if ((choice & 6) == 0) return;
    read_bound(from, part);
    field->bound = &part->bound;
}

/* ---- Columns --------------------------------------------------------------------------------- */

static void read_ray(fuzz_surface_case *what, const fuzz_ray *ray, size_t i) {
    for (int axis = 0; axis < 3; ++axis) {
        what->in[IN_ORIGIN + axis][i] = surface_bits(ray->origin[axis]);
        what->in[IN_DIRECTION + axis][i] = surface_bits(ray->direction[axis]);
    }
    what->in[IN_T_MIN][i] = surface_bits(ray->t_min);
    what->in[IN_T_MAX][i] = surface_bits(ray->t_max);
    what->in[IN_PATH][i] = surface_bits(ray->path);
    what->in[IN_ACTIVE][i] = (uint32_t)ray->active;
}

static void read_rest(reader *from, fuzz_surface_case *what, size_t i) {
    const float x = read_number(from, -1.0f, 1.0f), y = read_number(from, -1.0f, 1.0f);
    const float square = x * x + y * y;
    what->in[IN_NORMAL][i] = surface_bits(x);
    what->in[IN_NORMAL + 1][i] = surface_bits(y);
    what->in[IN_NORMAL + 2][i] = surface_bits(square < 1.0f ? sqrtf(1.0f - square) : y);
    what->in[IN_CROSS][i] = read_byte(from) & 1u;
    what->in[IN_TANGENT][i] = surface_bits(read_number(from, 0.001f, 1.0f));
    for (int axis = 0; axis < 3; ++axis) {
        what->in[IN_POINT + axis][i] = surface_bits(read_number(from, -3.0f, 3.0f));
        what->in[IN_TO + axis][i] = surface_bits(read_number(from, -3.0f, 3.0f));
    }
    what->in[IN_RADIUS][i] = surface_bits(fabsf(read_number(from, 0.0f, 1.0f)));
}

/* The hits of the rays with each of the fields by turns, or what nobody ever traced. */
static void read_hits(reader *from, fuzz_surface_case *what) {
    const uint32_t read = surface_table[what->call.door].outputs_kept |
                          surface_table[what->call.door].outputs_changed;
    const int junk = from->hostile && (read_byte(from) & 3u) == 0;
    const surface_call *const call = &what->call;
    spt_settings settings = what->settings;
    settings.flags &= (uint32_t)SPT_SKIP_START | SPT_STOP_INSIDE;
    for (size_t i = 0; i < call->count && read != 0; ++i) {
        const size_t component = i % call->field_count;
        spt_rays rays = surface_rays(call);
        spt_hit hit;
        const spt_hits hits = spt_hits_of(&hit);
        memset(&hit, 0, sizeof hit);
        hit.outcome = SPT_HIT;
        hit.t = read_number(from, 0.0f, 5.0f);
        hit.residual = read_number(from, -0.01f, 0.01f);
        rays.active.first = NULL;
        for (int axis = 0; axis < 3; ++axis) {
            rays.origin[axis].first = &what->in[IN_ORIGIN + axis][i];
            rays.direction[axis].first = &what->in[IN_DIRECTION + axis][i];
        }
        rays.t_min.first = &what->in[IN_T_MIN][i];
        rays.t_max.first = &what->in[IN_T_MAX][i];
        rays.path.first = &what->in[IN_PATH][i];
        if (!junk) (void)spt_trace(&what->fields[component], &settings, 1, &rays, &hits, NULL);
        uint32_t words[9];
        memcpy(words, &hit, sizeof words);
        if (hit.outcome == SPT_HIT) words[OUT_COMPONENT] = (uint32_t)component;
        for (int column = 0; column < 9; ++column) {
            if (SURFACE_HAS(read, column)) what->out[column][i] = words[column];
        }
    }
}

static void read_call(reader *from, fuzz_surface_case *what) {
    surface_call *const call = &what->call;
    const uint32_t choice = read_byte(from), more = read_byte(from);
    call->door = (surface_door)(choice % surface_doors);
    call->fields = what->fields;
    call->field_count = (surface_table[call->door].takes & TAKES_FIELDS) != 0 ? 1 + more % 2 : 1;
    call->settings = &what->settings;
    for (int column = 0; column < surface_inputs; ++column) {
        call->in[column].first = what->in[column];
        call->in[column].stride = 4;
    }
    for (int column = 0; column < surface_outputs; ++column) {
        call->out[column].first = what->out[column];
        call->out[column].stride = (ptrdiff_t)surface_width(column);
    }
    if (more & 128)
        call->in[IN_TO].first = call->in[IN_TO + 1].first = call->in[IN_TO + 2].first = NULL;
    call->crossing_step = 4;
    call->most_crossings = 1 + (more >> 1) % surface_most_crossings;
    call->iterations = (more >> 3) % 17;
    call->checks = (more >> 2) % 5;
    call->samples = 1 + (more >> 3) % 16;
    call->smooth = (more >> 4) & 1;
    call->rule = (more >> 5) & 1 ? SPT_NORMAL_CENTRAL : SPT_NORMAL_TETRAHEDRON;
    call->detail = more & 64 ? fabsf(read_number(from, 0.01f, 2.0f)) : 0.0f;
    call->distance = read_number(from, 0.01f, 1.0f);
    what->seed = more;
    what->other_calls = choice >= 9 * 24;
}

void fuzz_surface_read(fuzz_surface_case *what, const uint8_t *data, size_t size) {
    static fuzz_case rest;
    reader from = {data, size, 0, 0};
    memset(what, 0, sizeof *what);
    from.hostile = (read_byte(&from) & 3) == 0;
    for (int i = 0; i < surface_most_fields; ++i) read_part(&from, what, i);
    read_call(&from, what);
    const uint32_t flags = read_byte(&from);
    reader own = read_slice(&from, (size - from.at) / 3);
    fuzz_read(&rest, data + from.at, size - from.at);
    what->settings = rest.settings;
    if ((flags & 3) == 0) what->settings.flags |= flags & 31u; /* of which two exclude each other */
    what->call.count = 1 + (rest.count - 1) % fuzz_surface_most;
    if (!rest.masked) what->call.in[IN_ACTIVE].first = NULL;
    memset(what->out, 0xa5, sizeof what->out);
    for (size_t i = 0; i < what->call.count; ++i) {
        read_ray(what, &rest.rays[i], i);
        read_rest(&own, what, i);
    }
    read_hits(&own, what);
    memcpy(what->before, what->out, sizeof what->before);
    fuzz_surface_clear(what);
}

uint64_t fuzz_surface_points(const fuzz_surface_case *what) {
    return what->parts[0].distance.points + what->parts[1].distance.points;
}

uint64_t fuzz_surface_faults(const fuzz_surface_case *what) {
    return what->parts[0].distance.faults + what->parts[1].distance.faults;
}

void fuzz_surface_clear(fuzz_surface_case *what) {
    for (int i = 0; i < surface_most_fields; ++i) {
        what->parts[i].distance.points = what->parts[i].distance.faults = 0;
        what->parts[i].intervals = 0;
    }
}
