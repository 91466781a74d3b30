/* SPDX-License-Identifier: MIT
 *
 * One comparison: a subject, a step rule, settings and a target give a shader and what the C
 * library says of the same rays; an engine gives results, and these are compared ray by ray. */
#ifndef TESTS_GLSL_JOB_H
#define TESTS_GLSL_JOB_H

#include "engine.h"
#include "glsl_scenes.h"

/* What is asked for, beside the step rule. */
typedef struct glsl_case {
    const char *name;
    uint32_t features, flags; /* SPT_GLSL_*, settings.flags */
    uint32_t uniforms;        /* bits of spt_glsl_name */
    uint32_t budget;
    float epsilon, pixel_radius, size;
} glsl_case;

enum { GLSL_COLUMNS = 33, GLSL_ROWS = 15, GLSL_RAYS = GLSL_COLUMNS * GLSL_ROWS };
#define GLSL_JOB_UNIFORMS 8

typedef struct glsl_job {
    const glsl_subject *subject;
    const glsl_case *how;
    spt_settings settings;
    spt_glsl_options options;
    char *shader;
    int vectors; /* vec4 that a hit has, 1 to 3 */
    engine_uniform uniforms[GLSL_JOB_UNIFORMS];
    int uniform_count;
    engine_texture textures[3];
    spt_ray rays[GLSL_RAYS];
    float paths[GLSL_RAYS];
    spt_hit expected[GLSL_RAYS];
    uint32_t most_evaluations[GLSL_RAYS], least_evaluations[GLSL_RAYS];
    float texels[3][4 * GLSL_RAYS];
    float in[12 * GLSL_RAYS];
    float out[ENGINE_ATTACHMENTS][4 * GLSL_RAYS]; /* compute: hits one behind the other, from the
                                                   * first array on */
} glsl_job;

/* Whether that combination exists. */
int glsl_job_allowed(const glsl_subject *subject, const glsl_case *how, const spt_method *method,
                     uint32_t target);

/* Emits the shader and traces the rays in C; 0 and a printed reason where that fails. Release the
 * job in any case. */
int glsl_job_make(glsl_job *job, const glsl_subject *subject, const glsl_case *how,
                  const spt_method *method, uint32_t target);
void glsl_job_release(glsl_job *job);

/* What engines take. */
engine_fragment glsl_job_fragment(glsl_job *job);
engine_compute glsl_job_compute(glsl_job *job);

/* Runs it where its target runs from C; Vulkan with a compiler. */
int glsl_job_run(glsl_job *job, engine_compiler compiler);

/* One ray's results as the shader gave them, 3.0e38 as +infinity; what was not asked for is as in
 * `expected`. */
spt_hit glsl_job_hit(const glsl_job *job, int ray);

/* How many rays differ, in the bits of anything that was asked for. `first` receives a text about
 * the first of them. */
int glsl_job_differences(const glsl_job *job, char *first, size_t size);

/* How many rays end otherwise than in C, or elsewhere by more than 2e-6 of the way there: what is
 * asked of targets that may put operations together. */
int glsl_job_far(const glsl_job *job, char *first, size_t size);

/* The same for shaders with transcendental functions, which err by at most `error`: a hit must be
 * one of the C field, too, as far as that error goes. */
int glsl_job_wrong(const glsl_job *job, float error, int *outcomes, char *first, size_t size);

#endif
