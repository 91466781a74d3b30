/* SPDX-License-Identifier: MIT
 *
 * Another control on the same rays: the shader that spt_glsl_emit() writes for a scene, run by
 * Mesa's llvmpipe on the vectors of this processor, in this thread. */
#include "error_runs.h"

#ifdef REPORT_LLVMPIPE
#include <stdlib.h>

#include "../../bench/peers/peers_llvmpipe.h"

typedef struct shader_own {
    peers_shader *shader;
    float (*seen)[4];
} shader_own;

/* (t, residual, evaluations, outcome) of every ray. In GLSL 3.0e38 stands for infinity. */
static double run_shader(error_runner *runner, const error_scene *in, int all) {
    const shader_own *const own = runner->own;
    const double seconds = peers_shader_run(own->shader);
    if (!all) return seconds;
    peers_shader_hits(own->shader, own->seen);
    for (size_t i = 0; i < in->count; ++i) {
        in->hits[i].t = own->seen[i][0];
        in->hits[i].evaluations = (uint32_t)own->seen[i][2];
        in->hits[i].outcome = (int32_t)own->seen[i][3];
    }
    return seconds;
}

static void close_shader(error_runner *runner) {
    shader_own *const own = runner->own;
    peers_shader_free(own->shader);
    free(own->seen);
    free(own);
}

static char *text_of(const error_scene *in, const char *rule, uint32_t budget) {
    const spt_field field = scene_field(in->shown, 1);
    spt_settings settings = in->settings;
    spt_glsl_options options = spt_glsl_options_default();
    size_t length = 0;
    settings.method = bench_method(rule);
    settings.budget = budget;
    options.field = &field;
    options.settings = &settings;
    options.target = SPT_GLSL_COMPUTE_450;
    (void)spt_glsl_emit(&options, NULL, 0, &length);
    char *const text = report_allocate(length + 1);
    frame_expect(spt_glsl_emit(&options, text, length + 1, NULL), "spt_glsl_emit");
    return text;
}

static error_runner open_shader(const error_scene *in, const char *name, const char *rule,
                                uint32_t budget) {
    shader_own *const own = report_allocate(sizeof *own);
    const error_runner runner = {name,         0,    budget, in->identity, 0, run_shader,
                                 close_shader, NULL, own};
    char *const text = text_of(in, rule, budget);
    own->shader = peers_shader_of(PEERS_COMPUTE, text, in->picture, budget);
    own->seen = report_allocate(in->count * sizeof *own->seen);
    (void)peers_shader_run(own->shader); /* compiles it */
    free(text);
    return runner;
}

int error_shaders(error_runner *runners, const error_scene *in, uint32_t budget) {
    static int asked, there; /* a timed part: nothing runs beside it */
    if (!asked) there = peers_llvmpipe_open();
    asked = 1;
    if (!there) return 0;
    runners[0] = open_shader(in, "llvmpipe_basic", "basic", budget);
    runners[1] = open_shader(in, "llvmpipe_adaptive", "adaptive", budget);
    return 2;
}

#else

int error_shaders(error_runner *runners, const error_scene *in, uint32_t budget) {
    (void)runners, (void)in, (void)budget;
    return 0;
}

#endif
