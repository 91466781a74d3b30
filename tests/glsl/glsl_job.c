/* SPDX-License-Identifier: MIT
 *
 * Making, running and comparing. */
#include "glsl_job.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Making --------------------------------------------------------------------------------- */

static int is_compute(uint32_t target) {
    return target == SPT_GLSL_COMPUTE_310_ES || target == SPT_GLSL_COMPUTE_430 ||
           target == SPT_GLSL_COMPUTE_450 || target == SPT_GLSL_VULKAN_450;
}

static uint32_t flags_of(const glsl_subject *subject) {
    return subject->field != NULL ? subject->field->flags : 0;
}

enum {
    few = 20,     /* a budget that is meant to run out */
    plenty = 4000 /* one that does not: of a scene it counts for each component in shaders, but for
                   * all together in C */
};

int glsl_job_allowed(const glsl_subject *subject, const glsl_case *how, const spt_method *method,
                     uint32_t target) {
    if (method == spt_convex() && (flags_of(subject) & SPT_FIELD_CONVEX) == 0) return 0;
    if ((subject->traits & GLSL_ODD) != 0 && (how->features & SPT_GLSL_GUARDS) == 0) return 0;
    if (subject->scene != NULL && how->budget < few) return 0;
    if ((how->features & SPT_GLSL_ARRAYS) != 0 && (subject->traits & GLSL_MODEL) == 0) return 0;
    return target == SPT_GLSL_FRAGMENT_330 || target == SPT_GLSL_FRAGMENT_300_ES ||
           is_compute(target);
}

static void name_uniform(glsl_job *job, uint32_t name, engine_type type, float x, float y) {
    const engine_uniform uniform = {spt_glsl_default_name(name), type, {x, y, 0, 0}};
    job->uniforms[job->uniform_count++] = uniform;
}

/* In the order of spt_glsl_name, which is that of Vulkan's push constants. */
static void name_uniforms(glsl_job *job) {
    const spt_settings *settings = &job->settings;
    const struct {
        uint32_t name;
        float number;
    } numbers[] = {{SPT_GLSL_NAME_EPSILON, settings->epsilon},
                   {SPT_GLSL_NAME_PIXEL_RADIUS, settings->pixel_radius},
                   {SPT_GLSL_NAME_RELAXATION, settings->relaxation},
                   {SPT_GLSL_NAME_EXTRAPOLATION, settings->extrapolation},
                   {SPT_GLSL_NAME_SLOPE_BLEND, settings->slope_blend},
                   {SPT_GLSL_NAME_STEP_CAP, settings->step_cap}};
    name_uniform(job, SPT_GLSL_NAME_SIZE, ENGINE_IVEC2, GLSL_COLUMNS, GLSL_ROWS);
    name_uniform(job, SPT_GLSL_NAME_BUDGET, ENGINE_INT, (float)settings->budget, 0);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i) {
        if ((job->options.uniforms >> numbers[i].name & 1) == 0) continue;
        name_uniform(job, numbers[i].name, ENGINE_FLOAT, numbers[i].number, 0);
    }
}

/* The uniforms that a step rule reads; a shader has no others. */
static uint32_t uniforms_of(const spt_method *method, uint32_t wanted) {
    uint32_t rules = 1u << SPT_GLSL_NAME_RELAXATION | 1u << SPT_GLSL_NAME_EXTRAPOLATION |
                     1u << SPT_GLSL_NAME_SLOPE_BLEND | 1u << SPT_GLSL_NAME_STEP_CAP;
    if (method == spt_relaxed()) rules &= ~(1u << SPT_GLSL_NAME_RELAXATION);
    if (method == spt_enhanced() || method == spt_adaptive()) {
        rules &= ~(1u << SPT_GLSL_NAME_EXTRAPOLATION);
    }
    if (method == spt_auto_relaxed()) rules &= ~(1u << SPT_GLSL_NAME_SLOPE_BLEND);
    if (method == spt_adaptive()) rules &= ~(1u << SPT_GLSL_NAME_STEP_CAP);
    return wanted & ~rules;
}

static int emit(glsl_job *job) {
    size_t length = 0;
    if (spt_glsl_emit(&job->options, NULL, 0, &length) == SPT_BUFFER_TOO_SMALL) {
        job->shader = malloc(length + 1);
        if (job->shader != NULL &&
            spt_glsl_emit(&job->options, job->shader, length + 1, NULL) == SPT_OK) {
            return 1;
        }
    }
    printf("no shader is written: status %d\n",
           (int)spt_glsl_emit(&job->options, NULL, 0, &length));
    return 0;
}

/* Rays as buffers and as textures. */
static void place_rays(glsl_job *job) {
    const int vectors = (job->how->features & SPT_GLSL_PATH) != 0 ? 3 : 2;
    for (int i = 0; i < GLSL_RAYS; ++i) {
        const spt_ray *ray = &job->rays[i];
        const float path[4] = {job->paths[i], 0, 0, 0};
        const float *parts[3] = {ray->origin, ray->direction, path};
        for (int k = 0; k < 3; ++k) memcpy(&job->texels[k][4 * i], parts[k], sizeof path);
        for (int k = 0; k < vectors; ++k) {
            memcpy(&job->in[4 * (vectors * i + k)], parts[k], sizeof path);
        }
    }
    for (uint32_t k = 0; k < 3; ++k) {
        const engine_texture texture = {spt_glsl_default_name(SPT_GLSL_NAME_RAY_ORIGIN + k),
                                        GLSL_COLUMNS, GLSL_ROWS, job->texels[k]};
        job->textures[k] = texture;
    }
}

static spt_rays view_of(const glsl_job *job) {
    spt_rays view = spt_rays_of(job->rays);
    if ((job->how->features & SPT_GLSL_PATH) != 0) {
        view.path.first = job->paths;
        view.path.stride = sizeof job->paths[0];
    }
    return view;
}

static int trace_field(glsl_job *job) {
    const spt_rays view = view_of(job);
    const spt_hits hits = spt_hits_of(job->expected);
    const int well =
        spt_trace(job->subject->field, &job->settings, GLSL_RAYS, &view, &hits, NULL) == SPT_OK;
    for (int i = 0; i < GLSL_RAYS; ++i) {
        job->least_evaluations[i] = job->most_evaluations[i] = job->expected[i].evaluations;
    }
    return well;
}

/* A shader asks one component after the other, and leaves one that is behind what was hit before.
 * So it asks the one that is hit to the end, and of all together no more than if each were traced
 * alone. */
static int trace_scene(glsl_job *job) {
    const spt_scene *scene = job->subject->scene;
    static spt_hit alone[GLSL_RAYS];
    const spt_rays view = view_of(job);
    const spt_hits hits = spt_hits_of(job->expected), hits_alone = spt_hits_of(alone);
    const size_t bytes = spt_scene_workspace(scene, &job->settings);
    void *workspace = malloc(bytes);
    int well = workspace != NULL && spt_scene_trace(scene, &job->settings, GLSL_RAYS, &view, &hits,
                                                    workspace, bytes, NULL) == SPT_OK;
    free(workspace);
    memset(job->most_evaluations, 0, sizeof job->most_evaluations);
    memset(job->least_evaluations, 0, sizeof job->least_evaluations);
    for (size_t k = 0; k < scene->count; ++k) {
        spt_settings settings = job->settings;
        if ((scene->fields[k].flags & SPT_FIELD_CONVEX) != 0) settings.method = spt_convex();
        if (spt_trace(&scene->fields[k], &settings, GLSL_RAYS, &view, &hits_alone, NULL) !=
            SPT_OK) {
            well = 0;
        }
        for (int i = 0; i < GLSL_RAYS; ++i) {
            job->most_evaluations[i] += alone[i].evaluations;
            if (job->expected[i].component == (int32_t)k) {
                job->least_evaluations[i] = alone[i].evaluations;
            }
        }
    }
    return well;
}

int glsl_job_make(glsl_job *job, const glsl_subject *subject, const glsl_case *how,
                  const spt_method *method, uint32_t target) {
    const uint32_t second = SPT_GLSL_COMPONENT | SPT_GLSL_FLAGS | SPT_GLSL_CANDIDATE;
    memset(job, 0, sizeof *job);
    job->subject = subject;
    job->how = how;
    job->settings = spt_settings_default();
    job->settings.method = method;
    job->settings.budget = subject->scene != NULL ? plenty : how->budget;
    job->settings.flags = how->flags;
    job->settings.epsilon = how->epsilon;
    job->settings.pixel_radius = how->pixel_radius;
    job->settings.size = how->size;
    job->options = spt_glsl_options_default();
    job->options.field = subject->field;
    job->options.scene = subject->scene;
    job->options.settings = &job->settings;
    job->options.target = target;
    job->options.features = how->features;
    job->options.uniforms = uniforms_of(method, how->uniforms);
    job->vectors =
        1 + ((how->features & second) != 0) + ((how->features & SPT_GLSL_FALLBACKS) != 0);
    glsl_rays((how->features & SPT_GLSL_GUARDS) != 0, GLSL_RAYS, job->rays, job->paths);
    place_rays(job);
    name_uniforms(job);
    if (!emit(job)) return 0;
    if (subject->field != NULL ? trace_field(job) : trace_scene(job)) return 1;
    printf("the library refuses to trace\n");
    return 0;
}

void glsl_job_release(glsl_job *job) {
    free(job->shader);
    job->shader = NULL;
}

/* ---- Running -------------------------------------------------------------------------------- */

engine_fragment glsl_job_fragment(glsl_job *job) {
    engine_fragment run = {.context = job->options.target == SPT_GLSL_FRAGMENT_330 ? ENGINE_GL_45
                                                                                   : ENGINE_ES_32,
                           .shader = job->shader,
                           .width = GLSL_COLUMNS,
                           .height = GLSL_ROWS,
                           .textures = job->textures,
                           .texture_count = (job->how->features & SPT_GLSL_PATH) != 0 ? 3 : 2,
                           .uniforms = job->uniforms,
                           .uniform_count = job->uniform_count};
    for (int k = 0; k < job->vectors; ++k) run.out[k] = job->out[k];
    return run;
}

engine_compute glsl_job_compute(glsl_job *job) {
    const engine_compute run = {
        .context = job->options.target == SPT_GLSL_COMPUTE_310_ES ? ENGINE_ES_32 : ENGINE_GL_45,
        .shader = job->shader,
        .width = GLSL_COLUMNS,
        .height = GLSL_ROWS,
        .in = job->in,
        .in_count = (size_t)((job->how->features & SPT_GLSL_PATH) != 0 ? 12 : 8) * GLSL_RAYS,
        .out = job->out[0],
        .out_count = 4 * (size_t)job->vectors * GLSL_RAYS,
        .uniforms = job->uniforms,
        .uniform_count = job->uniform_count};
    return run;
}

int glsl_job_run(glsl_job *job, engine_compiler compiler) {
    if (job->options.target == SPT_GLSL_FRAGMENT_330 ||
        job->options.target == SPT_GLSL_FRAGMENT_300_ES) {
        const engine_fragment run = glsl_job_fragment(job);
        return engine_gl_fragment(&run);
    }
    const engine_compute run = glsl_job_compute(job);
    return job->options.target == SPT_GLSL_VULKAN_450 ? engine_vulkan_compute(&run, compiler)
                                                      : engine_gl_compute(&run);
}

/* ---- Comparing ------------------------------------------------------------------------------ */

/* The vector of a ray's hit, of those that hits have. */
static const float *vector_of(const glsl_job *job, int ray, int number) {
    return is_compute(job->options.target) ? &job->out[0][4 * (job->vectors * ray + number)]
                                           : &job->out[number][4 * ray];
}

static float with_infinity(float number) {
    return number == 3.0e38f ? INFINITY : number;
}

/* A count, or one that no count equals. */
static uint32_t count_of(float number) {
    return number >= 0.0f && number < 16777216.0f && number == floorf(number) ? (uint32_t)number
                                                                              : UINT32_MAX;
}

spt_hit glsl_job_hit(const glsl_job *job, int ray) {
    const uint32_t features = job->how->features;
    const uint32_t second = SPT_GLSL_COMPONENT | SPT_GLSL_FLAGS | SPT_GLSL_CANDIDATE;
    const float *one = vector_of(job, ray, 0);
    const float *two = vector_of(job, ray, (features & second) != 0 ? 1 : 0);
    const float *last = vector_of(job, ray, job->vectors - 1);
    spt_hit hit = job->expected[ray];
    hit.t = with_infinity(one[0]);
    hit.residual = with_infinity(one[1]);
    hit.evaluations = count_of(one[2]);
    hit.outcome = (int32_t)count_of(one[3]);
    if ((features & SPT_GLSL_COMPONENT) != 0) {
        hit.component = two[0] == -1.0f ? -1 : (int32_t)count_of(two[0]);
    }
    if ((features & SPT_GLSL_FLAGS) != 0) hit.flags = count_of(two[1]);
    if ((features & SPT_GLSL_CANDIDATE) != 0) {
        hit.candidate_t = with_infinity(two[2]);
        hit.candidate_ratio = with_infinity(two[3]);
    }
    if ((features & SPT_GLSL_FALLBACKS) != 0) hit.fallbacks = count_of(last[3]);
    return hit;
}

static int same_number(float a, float b) {
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

/* What a shader of a scene gives of its own: which components are asked, and how far, is not as in
 * C, and so are the samples among which the candidate is the best and flags are seen. */
static int same_hit(const glsl_job *job, int ray, const spt_hit *hit) {
    const spt_hit *expected = &job->expected[ray];
    if (!same_number(hit->t, expected->t) || !same_number(hit->residual, expected->residual) ||
        hit->outcome != expected->outcome || hit->component != expected->component ||
        hit->evaluations < job->least_evaluations[ray] ||
        hit->evaluations > job->most_evaluations[ray]) {
        return 0;
    }
    return job->subject->scene != NULL ||
           (hit->flags == expected->flags && hit->fallbacks == expected->fallbacks &&
            same_number(hit->candidate_t, expected->candidate_t) &&
            same_number(hit->candidate_ratio, expected->candidate_ratio));
}

static void describe(const char *who, const spt_hit *hit, char *text, size_t size) {
    const size_t at = strlen(text);
    snprintf(text + at, size - at,
             "\n  %s t %.9g residual %.9g outcome %d evaluations %u flags %u component %d "
             "candidate %.9g %.9g fallbacks %u",
             who, (double)hit->t, (double)hit->residual, (int)hit->outcome,
             (unsigned)hit->evaluations, (unsigned)hit->flags, (int)hit->component,
             (double)hit->candidate_t, (double)hit->candidate_ratio, (unsigned)hit->fallbacks);
}

static void describe_ray(const glsl_job *job, int number, const spt_hit *hit, char *text,
                         size_t size) {
    const spt_ray *ray = &job->rays[number];
    snprintf(text, size,
             "ray %d: origin %.9g %.9g %.9g direction %.9g %.9g %.9g t %.9g to %.9g path %.9g",
             number, (double)ray->origin[0], (double)ray->origin[1], (double)ray->origin[2],
             (double)ray->direction[0], (double)ray->direction[1], (double)ray->direction[2],
             (double)ray->t_min, (double)ray->t_max, (double)job->paths[number]);
    describe("C   ", &job->expected[number], text, size);
    describe("GLSL", hit, text, size);
}

int glsl_job_differences(const glsl_job *job, char *first, size_t size) {
    int different = 0;
    first[0] = '\0';
    for (int i = 0; i < GLSL_RAYS; ++i) {
        const spt_hit hit = glsl_job_hit(job, i);
        if (same_hit(job, i, &hit)) continue;
        if (different++ == 0) describe_ray(job, i, &hit, first, size);
    }
    return different;
}

int glsl_job_far(const glsl_job *job, char *first, size_t size) {
    int far = 0;
    first[0] = '\0';
    for (int i = 0; i < GLSL_RAYS; ++i) {
        const spt_hit hit = glsl_job_hit(job, i);
        const float t = job->expected[i].t;
        const int near = same_number(hit.t, t) || fabsf(hit.t - t) <= 2e-6f * fabsf(t);
        if (near && hit.outcome == job->expected[i].outcome) continue;
        if (far++ == 0) describe_ray(job, i, &hit, first, size);
    }
    return far;
}

/* trace.h: the tolerance at t, world length. */
static float tolerance_at(const glsl_job *job, const spt_ray *ray, float path, float t) {
    const float *d = ray->direction, *o = ray->origin;
    const float length = sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), way = t * length;
    const float reach = fmaxf(fmaxf(fabsf(o[0]), fabsf(o[1])), fabsf(o[2]));
    const float cone = job->settings.pixel_radius * (path + way);
    const float resolved = ldexpf(reach + way + job->settings.size + 2, -22);
    return fmaxf(fmaxf(job->settings.epsilon, cone), resolved);
}

int glsl_job_wrong(const glsl_job *job, float error, int *outcomes, char *first, size_t size) {
    const spt_field *field = job->subject->field;
    int wrong = 0;
    first[0] = '\0';
    *outcomes = 0;
    for (int i = 0; i < GLSL_RAYS; ++i) {
        const spt_hit hit = glsl_job_hit(job, i);
        const spt_ray *ray = &job->rays[i];
        int bad = hit.outcome < SPT_MISS || hit.outcome > SPT_BAD_RAY;
        *outcomes += hit.outcome != job->expected[i].outcome;
        if (hit.outcome == SPT_HIT) {
            const float path = (job->how->features & SPT_GLSL_PATH) != 0 ? job->paths[i] : 0.0f;
            float p[3];
            for (int k = 0; k < 3; ++k) p[k] = ray->origin[k] + hit.t * ray->direction[k];
            const float f = field->point(field->user, p[0], p[1], p[2]) / field->lipschitz;
            /* SPT_STOP_INSIDE: the first sample, whatever f is there, if it is inside in C, too. */
            const int inside = (job->expected[i].flags & SPT_FLAG_INSIDE) != 0 && f <= error &&
                               hit.t == job->expected[i].t &&
                               (job->settings.flags & SPT_STOP_INSIDE) != 0;
            bad |= !inside && !(fabsf(f) <= tolerance_at(job, ray, path, hit.t) + error);
        }
        if (bad && wrong++ == 0) describe_ray(job, i, &hit, first, size);
    }
    return wrong;
}
