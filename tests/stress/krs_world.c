/* SPDX-License-Identifier: MIT
 *
 * The world of krs_world.h. */
#include "krs_world.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* ---- Callbacks ------------------------------------------------------------------------------- */

static void see(krs_witness *self, float x, float y, float z) {
    ++self->points;
    if (fabsf(x) <= FLT_MAX && fabsf(y) <= FLT_MAX && fabsf(z) <= FLT_MAX) return;
    if (self->faults++ != 0) return;
    self->fault[0] = x;
    self->fault[1] = y;
    self->fault[2] = z;
}

static void see_batch(krs_witness *self, size_t n, const float *x, const float *y, const float *z,
                      const float *to) {
    const uintptr_t addresses = (uintptr_t)x | (uintptr_t)y | (uintptr_t)z | (uintptr_t)to;
    ++self->calls;
    self->faults += n == 0 || n % 16 != 0 || n > SPT_BATCH || addresses % 64 != 0;
    for (size_t i = 0; i < n; ++i) see(self, x[i], y[i], z[i]);
    if (self->visit != NULL) self->visit(self->visited);
}

static void scribble(const krs_witness *self, size_t n, const float *x, const float *y,
                     const float *z) {
    float *const scratch[] = {(float *)(uintptr_t)x, (float *)(uintptr_t)y, (float *)(uintptr_t)z};
    for (size_t i = 0; self->scribbles && i < 3 * n; ++i) scratch[i % 3][i / 3] = NAN;
}

float krs_witness_distance(const krs_witness *self, float x, float y, float z) {
    if (self->answer != NULL) return self->answer(self, x, y, z);
    const float a = x - self->center[0], b = y - self->center[1], c = z - self->center[2];
    return 2.0f * (sqrtf(a * a + b * b + c * c) - self->radius);
}

static void witness_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                          float *distance) {
    see_batch(user, n, x, y, z, distance);
    for (size_t i = 0; i < n; ++i) distance[i] = krs_witness_distance(user, x[i], y[i], z[i]);
    scribble(user, n, x, y, z);
}

static float witness_point(void *user, float x, float y, float z) {
    krs_witness *const self = user;
    ++self->calls;
    see(self, x, y, z);
    if (self->visit != NULL) self->visit(self->visited);
    return krs_witness_distance(self, x, y, z);
}

static void witness_gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                             float *gradient_x, float *gradient_y, float *gradient_z) {
    const krs_witness *const self = user;
    see_batch(user, n, x, y, z, gradient_x);
    for (size_t i = 0; i < n; ++i) {
        gradient_x[i] = x[i] - self->center[0];
        gradient_y[i] = y[i] - self->center[1];
        gradient_z[i] = z[i] - self->center[2];
    }
    scribble(user, n, x, y, z);
}

/* The inverse of a shear by a quarter of the height: its constant is (a + sqrt(a^2 + 4)) / 2 with
 * a = 1/4, below 1.14. */
static void unshear(void *user, size_t n, float *x, float *y, float *z) {
    see_batch(user, n, x, y, z, x);
    for (size_t i = 0; i < n; ++i) x[i] -= 0.25f * y[i];
}

/* ---- Models ---------------------------------------------------------------------------------- */

static void make_witnesses(krs_world *world) {
    static const float balls[krs_witnesses][4] = {
        {-0.5f, 0.5f, 0.25f, 0.75f}, {-2.5f, 0.5f, 0.0f, 0.5f}, {0.25f, 1.0f, 0.5f, 1.0f}};
    for (int i = 0; i < krs_witnesses; ++i) {
        krs_witness *const witness = &world->witness[i];
        spt_field *const field = &world->inner[i];
        memcpy(witness->center, balls[i], sizeof witness->center);
        witness->radius = balls[i][3];
        world->inner_bound[i] =
            spt_bound_sphere(balls[i][0], balls[i][1], balls[i][2], balls[i][3] * 1.0625f);
        *field = spt_field_default();
        field->batch = world->form & KRS_POINT ? NULL : witness_batch;
        field->point = world->form & KRS_POINT ? witness_point : NULL;
        field->gradient = world->form & KRS_GRADIENT ? witness_gradient : NULL;
        field->user = witness;
        field->lipschitz = 2.0f;
        field->bound = &world->inner_bound[i];
    }
}

static void make_kernels(krs_world *world) {
    static const float a[3] = {-1, 0, 0}, b[3] = {1, 0.5f, 0}, control[3] = {0, 0.75f, 0};
    static const float c[3] = {-1.5f, 1, 0.5f}, d[3] = {-0.5f, 2, 0.5f}, across[3] = {0, 0.25f, 1};
    static const spt_mirror mirrors[krs_levels] = {
        {{1, 0, 0}, 1.5f}, {{0.6f, 0.8f, 0}, 2}, {{0, 0, 1}, 1}};
    world->kernels[0] = spt_kernel_capsule(a, b, control, 0.25f);
    world->kernels[1] = spt_kernel_field(&world->inner[0]);
    world->kernels[2] = spt_kernel_leaf(c, d, across, 0.25f, 0.0625f);
    world->kernels[3] = spt_kernel_half_space(0, 1, 0, -1);
    memcpy(world->mirrors, mirrors, sizeof mirrors);
    world->mapped_kernels[0] = spt_kernel_sphere(-2, 0, 0, 0.75f);
    world->mapped_kernels[1] = spt_kernel_field(&world->inner[1]);
    world->mapped_kernels[2] = spt_kernel_capsule(c, d, c, 0.125f);
    world->mapped_kernels[3] = spt_kernel_empty();
}

static int make_maps(krs_world *world) {
    static const double center[3] = {1, 0.25, 0.5}, axis[3] = {0.25, 1, 0.5}, by[3] = {-2, 0, 0};
    spt_mobius *const maps = world->maps;
    spt_mobius move;
    int good = spt_mobius_inversion(center, 2.5, &maps[0]) == SPT_OK &&
               spt_mobius_rotation(axis, 0.75, &maps[1]) == SPT_OK &&
               spt_mobius_translation(by, &move) == SPT_OK &&
               spt_mobius_dilation(0.75, &maps[2]) == SPT_OK;
    for (int i = 0; i < 2; ++i) good = good && !spt_mobius_compose(&move, &maps[i], &maps[i]);
    return good;
}

static void describe_models(krs_world *world) {
    world->model = spt_krs_model_default();
    world->model.levels = krs_levels;
    world->model.kernels = world->kernels;
    world->model.mirrors = world->mirrors;
    world->model.smooth = world->form & KRS_GRADIENT ? 0.125f : 0.0f;
    world->model.max_lanes = world->lanes;
    world->mapped_model = spt_moekrs_model_default();
    world->mapped_model.levels = krs_levels;
    world->mapped_model.kernels = world->mapped_kernels;
    world->mapped_model.maps = world->maps;
    world->mapped_model.unmirrored = 2;
    world->mapped_model.smooth = world->model.smooth;
    world->mapped_model.max_lanes = world->lanes;
    world->distortion = world->unmapping = spt_distortion_default();
    world->distortion.kind = SPT_DISTORTION_TWIST;
    world->distortion.rate = 0.5f;
    world->unmapping.kind = SPT_DISTORTION_MAP;
    world->unmapping.unmap = unshear;
    world->unmapping.user = &world->witness[2];
    world->unmapping.lipschitz = 1.140625f;
    world->map_bound = spt_bound_box(-3, -1, -1, 3, 3, 2);
    world->unmapping.bound = &world->map_bound;
    world->binary = spt_binary_default();
}

int krs_world_models(krs_world *world) {
    const int good = spt_krs_build(&world->model, &world->krs) == SPT_OK &&
                     spt_moekrs_build(&world->mapped_model, &world->moekrs) == SPT_OK &&
                     spt_conformal_field(&world->inner[0], &world->maps[0], &world->conformal,
                                         &world->fields[KRS_DOOR_CONFORMAL]) == SPT_OK &&
                     spt_distorted_field(&world->inner[2], &world->distortion, &world->distorted,
                                         &world->fields[KRS_DOOR_DISTORTED]) == SPT_OK &&
                     spt_distorted_field(&world->inner[2], &world->unmapping, &world->unmapped,
                                         &world->fields[KRS_DOOR_UNMAPPED]) == SPT_OK;
    world->conformal.max_lanes = world->lanes;
    world->fields[KRS_DOOR_SEQUENCE] = spt_krs_field(&world->krs);
    world->fields[KRS_DOOR_MAPPED] = spt_moekrs_field(&world->moekrs);
    world->probes[0] = spt_moekrs_probe(&world->moekrs);
    world->probes[1] = spt_probe_of_field(&world->fields[KRS_DOOR_SEQUENCE]);
    return good;
}

/* ---- Rays ------------------------------------------------------------------------------------ */

/* From all sides to the models, of directions of any length; some that are odd. */
static void make_rays(krs_world *world) {
    uint32_t state = 1;
    float in[krs_inputs];
    for (int i = 0; i < krs_most; ++i) {
        for (int column = 0; column < 6; ++column) {
            state = state * 1664525u + 1013904223u;
            in[column] = (float)(state >> 8) * 0x1p-22f - 2.0f;
        }
        in[i % 3] = i % 2 != 0 ? 7.0f : -7.0f;
        for (int axis = 0; axis < 3; ++axis) {
            in[3 + axis] = (0.5f * in[3 + axis] - in[axis]) * (i % 4 != 0 ? 1.0f : 0.125f);
        }
        in[KRS_IN_T_MIN] = i % 5 != 0 ? 0.0f : 0.5f;
        in[KRS_IN_T_MAX] = i % 7 != 0 ? 4.0f : INFINITY;
        in[KRS_IN_PATH] = i % 3 != 0 ? 0.0f : 2.0f;
        if (i % 12 == 5) in[3] = in[4] = in[5] = 0.0f;
        if (i % 12 == 5) in[3 + i % 3] = i % 2 != 0 ? -1.0f : 1.0f;
        if (i == 20) in[KRS_IN_T_MAX] = in[KRS_IN_T_MIN];
        if (i == 21) in[KRS_IN_T_MAX] = -1.0f;
        if (i == 22) in[4] = NAN;
        if (i == 23) in[KRS_IN_T_MIN] = -1.0f;
        if (i == 24) in[0] = in[1] = in[2] = -0.25f; /* inside of some */
        for (int column = 0; column < KRS_IN_ACTIVE; ++column) {
            world->in[column][i] = krs_bits(in[column]);
        }
        world->in[KRS_IN_ACTIVE][i] = i % 11 != 3;
    }
}

static void forget(krs_world *world) {
    for (int i = 0; i < krs_witnesses; ++i) {
        krs_witness *const witness = &world->witness[i];
        witness->calls = witness->points = witness->faults = 0;
    }
}

static void trace_hits(krs_world *world) {
    for (int door = KRS_DOOR_SEQUENCE; door <= KRS_DOOR_MAPPED; ++door) {
        krs_call call;
        krs_world_call(&call, world, (krs_door)door);
        memset(world->found[door], 0, sizeof world->found[door]);
        for (int column = 0; column < krs_hit_sinks; ++column) {
            call.out[column].first = world->found[door][column];
            call.out[column].stride = 4;
        }
        (void)krs_place_call(&call);
    }
    forget(world);
}

int krs_world_make(krs_world *world, uint32_t form, uint32_t lanes) {
    memset(world, 0, sizeof *world);
    world->form = form;
    world->lanes = lanes;
    make_witnesses(world);
    make_kernels(world);
    describe_models(world);
    if (!make_maps(world) || !krs_world_models(world)) return 0;
    make_rays(world);
    trace_hits(world);
    return 1;
}

int krs_world_vary(krs_world *world, int variant) {
    spt_kernel kernels[krs_levels + 1], mapped_kernels[krs_levels + 1];
    spt_mirror mirrors[krs_levels];
    spt_mobius maps[krs_levels];
    memcpy(kernels, world->kernels, sizeof kernels);
    memcpy(mapped_kernels, world->mapped_kernels, sizeof mapped_kernels);
    memcpy(mirrors, world->mirrors, sizeof mirrors);
    memcpy(maps, world->maps, sizeof maps);
    for (int i = 0; i <= krs_levels; ++i) {
        world->kernels[i] = kernels[(i + variant) % (krs_levels + 1)];
        world->mapped_kernels[i] = mapped_kernels[(i + variant) % (krs_levels + 1)];
    }
    for (int i = 0; i < krs_levels; ++i) {
        world->mirrors[i] = mirrors[(i + 2 * variant) % krs_levels];
        world->maps[i] = maps[(i + variant) % krs_levels];
    }
    world->distortion.kind = (uint32_t)(SPT_DISTORTION_TWIST + variant);
    world->distortion.rate = 0.5f / (float)(1 + variant);
    world->distortion.wave = 1.0f;
    if (!krs_world_models(world)) return 0;
    trace_hits(world);
    return 1;
}

void krs_world_call(krs_call *call, krs_world *world, krs_door door) {
    const int mapped = door == KRS_DOOR_MAPPED_PLACES;
    const int unmapped = door == KRS_DOOR_UNMAPPED_POINTS;
    memset(call, 0, sizeof *call);
    call->door = door;
    if (door <= KRS_DOOR_UNMAPPED) call->field = &world->fields[door];
    call->krs = &world->krs;
    call->moekrs = &world->moekrs;
    call->conformal = &world->conformal;
    call->distorted = unmapped ? &world->unmapped : &world->distorted;
    call->probe = &world->probes[door == KRS_DOOR_FIELD_PROBES];
    call->binary = &world->binary;
    call->settings = &world->settings;
    call->statistics = &world->statistics;
    call->count = krs_most;
    world->settings = spt_settings_default();
    world->settings.max_lanes = world->lanes;
    world->settings.pixel_radius = 0x1p-11f;
    world->statistics = spt_statistics_default();
    for (int column = 0; column < krs_inputs; ++column) {
        call->in[column].first = world->in[column];
        call->in[column].stride = 4;
    }
    for (int column = 0; column < krs_hit_sinks; ++column) {
        call->found[column].first = world->found[mapped][column];
        call->found[column].stride = 4;
    }
    for (int column = 0; column < krs_table[door].outputs; ++column) {
        call->out[column].first = world->out[column];
        call->out[column].stride = 8;
    }
    memset(world->out, krs_fill, sizeof world->out);
    forget(world);
}

size_t krs_world_calls(const krs_world *world) {
    size_t calls = 0;
    for (int i = 0; i < krs_witnesses; ++i) calls += world->witness[i].calls;
    return calls;
}

size_t krs_world_faults(const krs_world *world) {
    size_t faults = 0;
    for (int i = 0; i < krs_witnesses; ++i) faults += world->witness[i].faults;
    return faults;
}

void krs_world_visit(krs_world *world, void (*visit)(void *to), void *visited) {
    for (int i = 0; i < krs_witnesses; ++i) {
        world->witness[i].visit = visit;
        world->witness[i].visited = visited;
    }
}
