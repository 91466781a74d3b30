/* SPDX-License-Identifier: MIT
 *
 * Reads bytes as a case of fuzz_krs.h. Any bytes are a case, and few make a large one. */
#include "fuzz_krs.h"

#include "fuzz_reader.h"
#include "stress/krs_results.h"

#include <string.h>

/* ---- Callers' fields ------------------------------------------------------------------------- */

static float take_point(fuzz_field *field, float x, float y, float z) {
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
    fuzz_field *const field = user;
    field->faults += n == 0 || n % 16 != 0 || n > SPT_BATCH;
    for (size_t i = 0; i < n; ++i) distance[i] = take_point(field, x[i], y[i], z[i]);
    if (field->scribble) spoil_points(n, x, y, z);
}

static float part_point(void *user, float x, float y, float z) {
    return take_point(user, x, y, z);
}

/* Right for balls around the origin, something for the others. */
static void part_gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                          float *gradient_x, float *gradient_y, float *gradient_z) {
    fuzz_field *const field = user;
    field->faults += n == 0 || n % 16 != 0 || n > SPT_BATCH;
    for (size_t i = 0; i < n; ++i) {
        (void)take_point(field, x[i], y[i], z[i]);
        gradient_x[i] = x[i] * field->number[1];
        gradient_y[i] = y[i] * field->number[1];
        gradient_z[i] = z[i] * field->number[1];
    }
    if (field->scribble) spoil_points(n, x, y, z);
}

/* An inverse that is the identity, a shear, or nonsense. */
static void unmap(void *user, size_t n, float *x, float *y, float *z) {
    fuzz_field *const map = user;
    map->faults += n == 0 || n % 16 != 0 || n > SPT_BATCH;
    for (size_t i = 0; i < n; ++i) {
        map->faults +=
            !(fabsf(x[i]) <= FLT_MAX && fabsf(y[i]) <= FLT_MAX && fabsf(z[i]) <= FLT_MAX);
        if (map->kind == 1) x[i] -= 0.25f * y[i];
        if (map->kind == 2) z[i] = fuzz_value(map, x[i], y[i], z[i]);
        if (map->kind == 3) y[i] = map->number[3];
    }
}

/* Fields that are distances, whatever the point. */
static int is_tame(const fuzz_field *field) {
    return field->kind <= 3 || field->kind == 5;
}

static void read_part(reader *from, fuzz_krs_case *what, int index) {
    static fuzz_case one;
    const reader bytes = read_slice(from, 16);
    const uint32_t choice = read_byte(from);
    spt_field *const field = &what->fields[index];
    fuzz_read(&one, bytes.data, bytes.size);
    what->parts[index] = one.distance;
    what->bounds[index] = one.bound;
    *field = one.field;
    field->user = &what->parts[index];
    field->batch = one.distance.point ? NULL : part_batch;
    field->point = one.distance.point ? part_point : NULL;
    field->gradient = choice & 1 ? part_gradient : NULL;
    if (field->bound != NULL) field->bound = &what->bounds[index];
    if (!is_tame(&one.distance) || one.hostile) what->promises = 0;
}

/* ---- Models ---------------------------------------------------------------------------------- */

static void read_triple(reader *from, float to[3], float low, float high) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = read_number(from, low, high);
}

static void read_kernel(reader *from, fuzz_krs_case *what, spt_kernel *kernel) {
    const uint32_t choice = read_byte(from);
    float a[3], b[3], control[3];
    *kernel = spt_kernel_empty();
    if (choice % 8 >= SPT_KERNEL_KINDS + (from->hostile ? 1 : 0)) return;
    read_triple(from, a, -2.0f, 0.0f);
    if (choice % 8 == SPT_KERNEL_SPHERE) {
        *kernel = spt_kernel_sphere(a[0], a[1], a[2], read_number(from, 0.0f, 1.0f));
    } else if (choice % 8 == SPT_KERNEL_HALF_SPACE) {
        *kernel = spt_kernel_half_space(a[0] - 0.125f, a[1], a[2], read_number(from, -2.0f, 1.0f));
    } else if (choice % 8 == SPT_KERNEL_FIELD) {
        *kernel = spt_kernel_field(&what->fields[choice >> 3 & 1]);
    } else {
        read_triple(from, b, 0.5f, 2.0f);
        read_triple(from, control, -2.0f, 2.0f);
        *kernel = spt_kernel_capsule(a, b, control, read_number(from, 0.0f, 0.5f));
    }
    if (choice % 8 == SPT_KERNEL_LEAF) {
        if (!from->hostile) { /* along the least component of the chord: never along the chord */
            memset(kernel->control, 0, sizeof control);
            kernel->control[choice >> 3 & 1] = 1.0f;
            kernel->b[choice >> 3 & 1] = kernel->a[choice >> 3 & 1];
        }
        kernel->width = read_number(from, 0.01f, 0.25f);
    }
    kernel->kind = choice % 8;
}

static void read_mirror(reader *from, spt_mirror *mirror) {
    read_triple(from, mirror->normal, -1.0f, 1.0f);
    if (!from->hostile && fabsf(mirror->normal[0]) < 0.125f) mirror->normal[0] = 1.0f;
    mirror->offset = read_number(from, -1.0f, 3.0f);
}

/* One to three elementary maps, and, of hostile ones, an entry that is anything. */
static void read_map(reader *from, spt_mobius *map) {
    const uint32_t choice = read_byte(from);
    *map = spt_mobius_identity();
    for (uint32_t i = 0; i <= (choice >> 6) % 3; ++i) {
        spt_mobius one = spt_mobius_identity();
        double v[3];
        float vector[3];
        read_triple(from, vector, -2.0f, 2.0f);
        for (int axis = 0; axis < 3; ++axis) v[axis] = (double)vector[axis];
        const double number = (double)read_number(from, 0.25f, 3.0f);
        if (!from->hostile) v[0] += v[0] < 0 ? -0.125 : 0.125;
        switch ((choice >> 2 * i) % 5) {
        case 0:
            (void)spt_mobius_dilation(number, &one);
            break;
        case 1:
            (void)spt_mobius_translation(v, &one);
            break;
        case 2:
            (void)spt_mobius_rotation(v, number, &one);
            break;
        case 3:
            (void)spt_mobius_reflection(v, number, &one);
            break;
        default:
            (void)spt_mobius_inversion(v, number, &one);
            break;
        }
        (void)spt_mobius_compose(&one, map, map);
    }
    if (from->hostile && (read_byte(from) & 15u) == 0) {
        map->c.y = (double)read_special(from);
        map->orientation = (int32_t)(choice & 3u) - 1;
    }
}

static void read_models(reader *from, fuzz_krs_case *what) {
    const uint32_t choice = read_byte(from);
    uint32_t levels = choice % 7;
    if (choice >= 250) levels = 64 - (255 - choice);
    what->model = spt_krs_model_default();
    what->mapped_model = spt_moekrs_model_default();
    for (uint32_t level = 0; level <= levels; ++level) {
        read_kernel(from, what, &what->kernels[level]);
        if (level == levels) break;
        read_mirror(from, &what->mirrors[level]);
        read_map(from, &what->maps[level]);
    }
    what->model.levels = what->mapped_model.levels = levels;
    what->model.kernels = what->mapped_model.kernels = what->kernels;
    what->model.mirrors = what->mirrors;
    what->mapped_model.maps = what->maps;
    what->mapped_model.unmirrored = read_byte(from);
    const uint32_t more = read_byte(from);
    int gradients = 1;
    for (int i = 0; i < fuzz_krs_fields; ++i) gradients &= what->fields[i].gradient != NULL;
    if ((more & 3) == 1 && (gradients || from->hostile)) {
        what->model.smooth = what->mapped_model.smooth = read_number(from, 0.0f, 0.5f);
    }
    if ((more & 12) != 4) return;
    what->model_bound = spt_bound_sphere(0, 0, 0, 1.0f + read_number(from, 0.0f, 6.0f));
    what->model.bound = what->mapped_model.bound = &what->model_bound;
}

static void read_distortion(reader *from, fuzz_krs_case *what) {
    spt_distortion *const distortion = &what->distortion;
    const uint32_t choice = read_byte(from);
    *distortion = spt_distortion_default();
    distortion->kind = 1 + choice % (from->hostile ? 6 : 5);
    distortion->rate = read_number(from, -0.25f, 0.25f);
    if ((choice & 64) != 0) read_triple(from, distortion->origin, -1.0f, 1.0f);
    if ((choice & 128) != 0) read_triple(from, distortion->axis, -1.0f, 1.0f);
    distortion->wave = read_number(from, 0.0f, 2.0f);
    distortion->phase = read_number(from, -3.0f, 3.0f);
    what->unmapped.kind = (choice >> 4) % 4;
    what->unmapped.number[3] = from->hostile ? read_special(from) : 0.5f;
    distortion->unmap = unmap;
    distortion->user = &what->unmapped;
    distortion->lipschitz = 1.140625f;
    what->map_bound = spt_bound_box(-3, -3, -3, 3, 3, 3);
    distortion->bound = &what->map_bound;
}

/* ---- Calls ----------------------------------------------------------------------------------- */

static void read_rays(const fuzz_case *rays, fuzz_krs_case *what) {
    for (size_t i = 0; i < what->call.count; ++i) {
        const fuzz_ray *const ray = &rays->rays[i];
        for (int axis = 0; axis < 3; ++axis) {
            what->in[axis][i] = krs_bits(ray->origin[axis]);
            what->in[3 + axis][i] = krs_bits(ray->direction[axis]);
        }
        what->in[KRS_IN_T_MIN][i] = krs_bits(ray->t_min);
        what->in[KRS_IN_T_MAX][i] = krs_bits(ray->t_max);
        what->in[KRS_IN_PATH][i] = krs_bits(ray->path);
        what->in[KRS_IN_ACTIVE][i] = (uint32_t)ray->active;
    }
}

/* Hits that somebody may have traced, or nobody ever. */
static void read_hits(reader *from, fuzz_krs_case *what) {
    for (size_t i = 0; i < what->call.count; ++i) {
        const uint32_t choice = read_byte(from);
        what->found[KRS_OUT_T][i] = krs_bits(read_number(from, 0.0f, 6.0f));
        what->found[KRS_OUT_OUTCOME][i] = (choice & 7) != 0 ? SPT_HIT : choice >> 3;
        what->found[KRS_OUT_COMPONENT][i] = choice >> 6;
    }
}

static void read_call(reader *from, fuzz_krs_case *what) {
    krs_call *const call = &what->call;
    const uint32_t choice = read_byte(from);
    call->door = (krs_door)(choice % krs_doors);
    call->field = &what->field;
    call->krs = &what->krs;
    call->moekrs = &what->moekrs;
    call->conformal = &what->conformal;
    call->distorted = &what->distorted;
    call->probe = &what->probe;
    call->binary = &what->binary;
    call->settings = &what->settings;
    for (int column = 0; column < krs_inputs; ++column) {
        call->in[column].first = what->in[column];
        call->in[column].stride = 4;
    }
    for (int column = 0; column < krs_hit_sinks; ++column) {
        call->found[column].first = what->found[column];
        call->found[column].stride = 4;
    }
    for (int column = 0; column < krs_table[call->door].outputs; ++column) {
        call->out[column].first = what->out[column];
        call->out[column].stride = 8;
    }
    what->binary = spt_binary_default();
    what->choice = read_byte(from);
    what->seed = read_byte(from);
    if ((what->choice & 3) != 0) return;
    what->binary.bonus = read_number(from, 1.01f, 8.0f);
    what->binary.penalty = read_number(from, 0.01f, 0.99f);
    what->binary.probe_ratio = read_number(from, 0.01f, 1.0f);
    what->binary.first = read_number(from, 0.0f, 4.0f);
}

void fuzz_krs_read(fuzz_krs_case *what, const uint8_t *data, size_t size) {
    static fuzz_case rest;
    reader from = {data, size, 0, 0};
    memset(what, 0, sizeof *what);
    what->hostile = from.hostile = (read_byte(&from) & 3) == 0;
    what->promises = what->hostile ? 0 : KRS_TAME;
    for (int i = 0; i < fuzz_krs_fields; ++i) read_part(&from, what, i);
    read_call(&from, what);
    read_distortion(&from, what);
    read_models(&from, what);
    reader own = read_slice(&from, (size - from.at) / 3);
    fuzz_read(&rest, data + from.at, size - from.at);
    what->settings = rest.settings;
    if (krs_table[what->call.door].own_pass && !what->hostile) what->settings.flags = 0;
    if (rest.hostile || what->unmapped.kind > 1) what->promises = 0;
    what->call.count = 1 + (rest.count - 1) % fuzz_krs_most;
    if (!rest.masked) what->call.in[KRS_IN_ACTIVE].first = NULL;
    read_rays(&rest, what);
    read_hits(&own, what);
}

uint64_t fuzz_krs_faults(const fuzz_krs_case *what) {
    return what->parts[0].faults + what->parts[1].faults + what->unmapped.faults;
}
