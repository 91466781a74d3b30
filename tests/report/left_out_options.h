/* SPDX-License-Identifier: MIT
 *
 * THE LIST of what a call of spt_trace() may be asked for beside t and outcome, or told beside
 * origin and direction, each of which leaves those as they are: what a caller who does not ask for
 * it is not to pay. For the program that counts instructions and the part that takes times. */
#ifndef TESTS_REPORT_LEFT_OUT_OPTIONS_H
#define TESTS_REPORT_LEFT_OUT_OPTIONS_H

#include <spheretrace/spheretrace.h>

#include <string.h>

typedef struct option_call {
    spt_field field;
    spt_bound bound; /* of the field, where its struct_size is not 0 */
    spt_settings settings;
    spt_rays rays;
    spt_hits hits;
    spt_hit *hit; /* where the results go */
    int counted;  /* whether statistics are asked for */
} option_call;

/* A call without options. */
static inline option_call option_call_of(const spt_field *field, const spt_settings *settings,
                                         const spt_ray *ray, spt_hit *hit) {
    option_call call;
    const spt_rays rays = spt_rays_of(ray);
    const spt_hits hits = spt_hits_of(hit);
    memset(&call, 0, sizeof call);
    call.field = *field;
    call.settings = *settings;
    for (int axis = 0; axis < 3; ++axis) {
        call.rays.origin[axis] = rays.origin[axis];
        call.rays.direction[axis] = rays.direction[axis];
    }
    call.hits.t = hits.t;
    call.hits.outcome = hits.outcome;
    call.hit = hit;
    return call;
}

static inline spt_status option_call_run(const option_call *call, size_t count) {
    spt_statistics statistics = spt_statistics_default();
    spt_field field = call->field;
    if (call->bound.struct_size != 0) field.bound = &call->bound;
    return spt_trace(&field, &call->settings, count, &call->rays, &call->hits,
                     call->counted ? &statistics : NULL);
}

#define OPTION_SINK(name) \
    static inline void option_##name(option_call *call) { \
        call->hits.name = spt_hits_of(call->hit).name; \
    }
OPTION_SINK(residual)
OPTION_SINK(evaluations)
OPTION_SINK(component)
OPTION_SINK(flags)
OPTION_SINK(fallbacks)
#undef OPTION_SINK

static inline void option_candidate(option_call *call) {
    call->hits.candidate_t = spt_hits_of(call->hit).candidate_t;
    call->hits.candidate_ratio = spt_hits_of(call->hit).candidate_ratio;
}

static inline void option_statistics(option_call *call) {
    call->counted = 1;
}

static inline void option_t_max(option_call *call) {
    static const float no_end = INFINITY;
    call->rays.t_max.first = &no_end;
}

static inline void option_path(option_call *call) {
    static const float none = 0.0f;
    call->rays.path.first = &none;
}

static inline void option_active(option_call *call) {
    static const int32_t yes = -1;
    call->rays.active.first = &yes;
}

/* Around the camera, too. */
static inline void option_bound(option_call *call) {
    call->bound = spt_bound_sphere(0.0f, 0.0f, 0.0f, 1000.0f);
}

static inline void option_stop_inside(option_call *call) {
    call->settings.flags |= SPT_STOP_INSIDE;
}

static inline void option_skip_start(option_call *call) {
    call->settings.flags |= SPT_SKIP_START;
}

typedef struct option {
    const char *name;
    const char *kind; /* result, input or flag */
    void (*add)(option_call *call);
} option;

static const option options[] = {{"residual", "result", option_residual},
                                 {"evaluations", "result", option_evaluations},
                                 {"component", "result", option_component},
                                 {"fallbacks", "result", option_fallbacks},
                                 {"flags", "result", option_flags},
                                 {"candidate", "result", option_candidate},
                                 {"statistics", "result", option_statistics},
                                 {"t_max", "input", option_t_max},
                                 {"path", "input", option_path},
                                 {"active", "input", option_active},
                                 {"bound", "input", option_bound},
                                 {"stop inside", "flag", option_stop_inside},
                                 {"skip start", "flag", option_skip_start}};
enum { option_count = sizeof options / sizeof options[0] };

#endif
