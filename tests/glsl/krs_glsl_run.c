/* SPDX-License-Identifier: MIT
 *
 * The way of a model to a shader, and of its answers back. */
#include "krs_glsl_world.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "glsl_check.h"

static float between(double low, double high) {
    return (float)check_uniform(low, high);
}

/* ---- Shaders --------------------------------------------------------------------------------- */

char *world_emit(const spt_glsl_options *options, spt_status *status) {
    size_t length = 0;
    *status = spt_glsl_emit(options, NULL, 0, &length);
    if (*status != SPT_BUFFER_TOO_SMALL) return NULL;
    char *const text = malloc(length + 1);
    if (text != NULL) *status = spt_glsl_emit(options, text, length + 1, NULL);
    return text;
}

enum { columns = 64, rows = WORLD_POINTS / columns };

/* Distances of all points, of four floats each. */
static int run_points(const char *shader, uint32_t target, const float *points, float *out) {
    const engine_uniform uniforms[] = {
        {spt_glsl_default_name(SPT_GLSL_NAME_SIZE), ENGINE_IVEC2, {columns, rows, 0, 0}}};
    const engine_context context =
        target == SPT_GLSL_FRAGMENT_300_ES || target == SPT_GLSL_COMPUTE_310_ES ? ENGINE_ES_32
                                                                                : ENGINE_GL_45;
    if (target >= SPT_GLSL_COMPUTE_310_ES) {
        const engine_compute run = {.context = context,
                                    .shader = shader,
                                    .width = columns,
                                    .height = rows,
                                    .in = points,
                                    .in_count = 4 * WORLD_POINTS,
                                    .out = out,
                                    .out_count = 4 * WORLD_POINTS,
                                    .uniforms = uniforms,
                                    .uniform_count = 1};
        return target == SPT_GLSL_VULKAN_450 ? engine_vulkan_compute(&run, ENGINE_GLSLC)
                                             : engine_gl_compute(&run);
    }
    const engine_texture texture = {spt_glsl_default_name(SPT_GLSL_NAME_RAY_ORIGIN), columns, rows,
                                    points};
    const engine_fragment run = {.context = context,
                                 .shader = shader,
                                 .width = columns,
                                 .height = rows,
                                 .textures = &texture,
                                 .texture_count = 1,
                                 .uniforms = uniforms,
                                 .uniform_count = 1,
                                 .out = {out}};
    return engine_gl_fragment(&run);
}

/* The callbacks want four arrays of 16 floats aligned to 64 bytes. */
static float *aligned(float *room) {
    return room + (64 - (uintptr_t)room % 64) % 64 / sizeof *room;
}

static void ask(const spt_field *field, const float *points, float *expected) {
    float room[4 * 16 + 16], *const x = aligned(room), *const y = x + 16, *const z = y + 16;
    for (int i = 0; i < WORLD_POINTS; i += 16) {
        for (int k = 0; k < 16; ++k) {
            x[k] = points[4 * (i + k)];
            y[k] = points[4 * (i + k) + 1];
            z[k] = points[4 * (i + k) + 2];
        }
        if (field->batch != NULL) {
            field->batch(field->user, 16, x, y, z, z + 16);
            memcpy(&expected[i], z + 16, 16 * sizeof *expected);
            continue;
        }
        for (int k = 0; k < 16; ++k) expected[i + k] = field->point(field->user, x[k], y[k], z[k]);
    }
}

/* Those of spt_glsl_check_field(); the last sixteenth farther away, up to 5e17; and 16 of each
 * place, nearer and nearer. */
static void draw_points(const spt_field *field, float (*places)[3], int place_count,
                        float *points) {
    CHECK(spt_glsl_check_field(field, WORLD_POINTS, check_random(), points) == SPT_OK);
    for (int i = WORLD_POINTS - WORLD_POINTS / 16; i < WORLD_POINTS; ++i) {
        const float far = exp2f(between(0, 59));
        for (int axis = 0; axis < 3; ++axis) points[4 * i + axis] = far * between(-1, 1);
    }
    for (int i = 0; i < 16 * place_count; ++i) {
        const float away = i % 16 == 0 ? 0.0f : exp2f((float)(-2 * (i % 16)));
        for (int axis = 0; axis < 3; ++axis) {
            points[4 * i + axis] = places[i / 16][axis] + away * between(-1, 1);
        }
    }
}

/* 3.0e38 stands for infinity, and NaN is as good as another. */
static int agree(float shader, float c) {
    if (isnan(c)) return isnan(shader);
    return shader >= 3.0e38f ? c >= 3.0e38f : check_same_bits(shader, c);
}

int world_differences_at(const spt_field *field, uint32_t target, uint32_t features,
                         float (*places)[3], int place_count, char said[512]) {
    static float points[4 * WORLD_POINTS], out[4 * WORLD_POINTS], expected[WORLD_POINTS];
    const spt_settings settings = spt_settings_default();
    spt_glsl_options options = spt_glsl_options_default();
    spt_status status;
    options.field = field;
    options.settings = &settings;
    options.target = target;
    options.program = SPT_GLSL_POINTS;
    options.features = features;
    char *const shader = world_emit(&options, &status);
    if (shader == NULL) {
        snprintf(said, 512, "status %d", (int)status);
        return -1;
    }
    draw_points(field, places, place_count, points);
    ask(field, points, expected);
    const int ran = run_points(shader, target, points, out);
    free(shader);
    if (ran != ENGINE_OK) {
        snprintf(said, 512, "it did not run: %d", ran);
        return -1;
    }
    int different = 0;
    for (int i = 0; i < WORLD_POINTS; ++i) {
        if (agree(out[4 * i], expected[i])) continue;
        if (different++ != 0) continue;
        snprintf(said, 512, "point %d, %.9g %.9g %.9g: %.9g in the shader, %.9g in C", i,
                 (double)points[4 * i], (double)points[4 * i + 1], (double)points[4 * i + 2],
                 (double)out[4 * i], (double)expected[i]);
    }
    return different;
}

int world_differences(const spt_field *field, uint32_t target, uint32_t features, char said[512]) {
    float origin[1][3] = {{0, 0, 0}};
    return world_differences_at(field, target, features, origin, 1, said);
}

/* ---- Rays ------------------------------------------------------------------------------------ */

void world_rays(const spt_field *field, spt_ray rays[WORLD_RAYS], float paths[WORLD_RAYS]) {
    float low[3] = {-1, -1, -1}, high[3] = {1, 1, 1};
    if (field->bound != NULL) spt_bound_extent(field->bound, low, high);
    for (int i = 0; i < WORLD_RAYS; ++i) {
        const float stretch = exp2f(between(-3, 3));
        const float away = i % 8 == 0 ? 0.25f : 1.5f; /* some begin within */
        for (int axis = 0; axis < 3; ++axis) {
            const float middle = 0.5f * (low[axis] + high[axis]);
            const float half = 0.5f * (high[axis] - low[axis]);
            const float to = middle + half * between(-0.5, 0.5);
            rays[i].origin[axis] = middle + away * half * between(-1, 1);
            rays[i].direction[axis] = stretch * (to - rays[i].origin[axis]);
        }
        rays[i].t_min = i % 5 == 0 ? between(0, 0.1) : 0.0f;
        rays[i].t_max = i % 3 == 0 ? between(0, 2) : 1e5f;
        paths[i] = i % 2 == 0 ? between(0, 10) : 0.0f;
    }
}

static float finite_or_infinite(float a) {
    return a >= 3.0e38f ? INFINITY : a;
}

/* Where a hit's vec4 are, as glsl.h has it. */
static int has_second(uint32_t features) {
    return (features &
            (SPT_GLSL_COMPONENT | SPT_GLSL_FLAGS | SPT_GLSL_CANDIDATE | SPT_GLSL_PLACE)) != 0;
}

static int has_third(uint32_t features) {
    return (features & (SPT_GLSL_NORMAL | SPT_GLSL_FALLBACKS)) != 0;
}

static void read_hit(uint32_t features, const float *from, spt_hit *hit) {
    memset(hit, 0, sizeof *hit);
    hit->t = finite_or_infinite(from[0]);
    hit->residual = finite_or_infinite(from[1]);
    hit->evaluations = (uint32_t)from[2];
    hit->outcome = (int32_t)from[3];
    from += 4;
    if (has_second(features)) {
        hit->component = (int32_t)from[0];
        hit->flags = (uint32_t)from[1];
        hit->candidate_t = finite_or_infinite(from[2]);
        hit->candidate_ratio = finite_or_infinite(from[3]);
        from += 4;
    }
    if (has_third(features)) hit->fallbacks = (uint32_t)from[3];
}

int world_run(world_trace *trace, char said[512]) {
    static float in[12 * WORLD_RAYS], out[12 * WORLD_RAYS];
    const int words = (trace->features & SPT_GLSL_PATH) != 0 ? 12 : 8;
    const int floats = 4 * (1 + has_second(trace->features) + has_third(trace->features));
    spt_glsl_options options = spt_glsl_options_default();
    spt_status status;
    options.field = trace->field;
    options.settings = trace->settings;
    options.target = SPT_GLSL_COMPUTE_450;
    options.features = trace->features;
    char *const shader = world_emit(&options, &status);
    if (shader == NULL) {
        snprintf(said, 512, "status %d", (int)status);
        return 0;
    }
    memset(in, 0, sizeof in);
    for (int i = 0; i < WORLD_RAYS; ++i) {
        memcpy(&in[words * i], &trace->rays[i], sizeof trace->rays[i]);
        if (words == 12) in[words * i + 8] = trace->paths[i];
    }
    const engine_uniform uniforms[] = {
        {spt_glsl_default_name(SPT_GLSL_NAME_SIZE), ENGINE_IVEC2, {WORLD_RAYS, 1, 0, 0}},
        {spt_glsl_default_name(SPT_GLSL_NAME_BUDGET),
         ENGINE_INT,
         {(float)trace->settings->budget, 0, 0, 0}}};
    const engine_compute run = {.context = ENGINE_GL_45,
                                .shader = shader,
                                .width = WORLD_RAYS,
                                .height = 1,
                                .in = in,
                                .in_count = (size_t)(words * WORLD_RAYS),
                                .out = out,
                                .out_count = (size_t)(floats * WORLD_RAYS),
                                .uniforms = uniforms,
                                .uniform_count = 2};
    const int ran = engine_gl_compute(&run);
    free(shader);
    snprintf(said, 512, "it did not run: %d", ran);
    for (int i = 0; i < WORLD_RAYS; ++i) {
        read_hit(trace->features, &out[floats * i], &trace->hits[i]);
    }
    return ran == ENGINE_OK;
}

static int same_hit(uint32_t features, const spt_hit *a, const spt_hit *b) {
    int same =
        a->outcome == b->outcome && a->evaluations == b->evaluations &&
        check_same_bits(a->t, b->t) &&
        (check_same_bits(a->residual, b->residual) || (isnan(a->residual) && isnan(b->residual)));
    if (features & SPT_GLSL_FLAGS) same = same && a->flags == b->flags;
    if (features & SPT_GLSL_FALLBACKS) same = same && a->fallbacks == b->fallbacks;
    if (features & SPT_GLSL_COMPONENT) same = same && a->component == b->component;
    if (features & SPT_GLSL_CANDIDATE) {
        same = same && check_same_bits(a->candidate_t, b->candidate_t) &&
               check_same_bits(a->candidate_ratio, b->candidate_ratio);
    }
    return same;
}

int world_wrong_hits(const world_trace *trace, const spt_hit expected[WORLD_RAYS], char said[512]) {
    int wrong = 0;
    for (int i = 0; i < WORLD_RAYS; ++i) {
        const spt_hit *const a = &trace->hits[i], *const b = &expected[i];
        if (same_hit(trace->features, a, b) || wrong++ != 0) continue;
        snprintf(said, 512,
                 "ray %d: t %.9g for %.9g, residual %.9g for %.9g, outcome %d for %d, "
                 "evaluations %u for %u, flags %u for %u, fallbacks %u for %u",
                 i, (double)a->t, (double)b->t, (double)a->residual, (double)b->residual,
                 (int)a->outcome, (int)b->outcome, (unsigned)a->evaluations,
                 (unsigned)b->evaluations, (unsigned)a->flags, (unsigned)b->flags,
                 (unsigned)a->fallbacks, (unsigned)b->fallbacks);
    }
    return wrong;
}
