/* SPDX-License-Identifier: MIT
 *
 * The call of the library: a text is asked for twice, first for its length. */
#include "emit_shader.h"

#include <stdlib.h>
#include <string.h>

/* In the order of their enumerators. */
const char *const emit_targets[] = {"library", "330", "300es",  "shadertoy", "310es",
                                    "430",     "450", "vulkan", NULL};
const char *const emit_programs[] = {"picture", "hits", "points", "cones", NULL};
const char *const emit_features[] = {"guards",    "flags",  "candidate", "fallbacks", "component",
                                     "path",      "normal", "refine",    "offset",    "shadow",
                                     "occlusion", "convex", "binary",    "starts",    "depth_write",
                                     "arrays",    "merged", "place",     NULL};
const char *const emit_parameters[] = {
    "size",        "budget",   "epsilon", "pixel_radius",  "relaxation", "extrapolation",
    "slope_blend", "step_cap", "eye",     "right",         "up",         "forward",
    "window",      "range",    "light",   "light_tangent", "occlusion",  "depth",
    "time",        "view",     NULL};

int emit_word(const char *const *words, const char *word) {
    for (int i = 0; words[i] != NULL; ++i) {
        if (strcmp(words[i], word) == 0) return i;
    }
    return -1;
}

emit_job emit_job_default(void) {
    emit_job job;
    memset(&job, 0, sizeof job);
    job.target = SPT_GLSL_FRAGMENT_300_ES;
    job.program = SPT_GLSL_PICTURE;
    job.width = 960;
    job.height = 640;
    job.settings = spt_settings_default();
    return job;
}

char *emit_shader(const emit_subject *subject, const emit_job *job, spt_status *status) {
    const spt_camera camera = emit_subject_camera(subject, job->width, job->height);
    spt_settings settings = job->settings;
    spt_glsl_options options = spt_glsl_options_default();
    settings.pixel_radius = (camera.x_high - camera.x_low) / (2.0f * (float)job->width);
    options.field = subject->world == NULL ? &subject->field : NULL;
    options.scene = subject->world == NULL ? NULL : &subject->world->scene;
    options.settings = &settings;
    options.camera = &camera;
    options.target = job->target;
    options.program = job->program;
    options.features = job->features;
    options.uniforms = job->uniforms;
    options.depth[0] = job->depth[0];
    options.depth[1] = job->depth[1];
    size_t length = 0;
    *status = spt_glsl_emit(&options, NULL, 0, &length);
    if (*status != SPT_BUFFER_TOO_SMALL) return NULL;
    char *const text = malloc(length + 1);
    *status = SPT_OK;
    if (text != NULL) *status = spt_glsl_emit(&options, text, length + 1, &length);
    return text;
}
