/* SPDX-License-Identifier: MIT
 *
 * The public door: checks the arguments, settles what the call needs, and hands the rays over in
 * chunks. */
#include "../base/arguments.h"
#include "../base/columns.h"
#include "../bound/bound_check.h"
#include "driver.h"

static int check_rays(const spt_rays *rays, size_t count) {
    const spt_column *const columns[] = {
        &rays->origin[0],    &rays->origin[1],    &rays->origin[2], &rays->direction[0],
        &rays->direction[1], &rays->direction[2], &rays->t_min,     &rays->t_max,
        &rays->path,         &rays->active};
    for (size_t i = 0; i < sizeof columns / sizeof *columns; ++i) {
        if (columns[i]->first == NULL && i < 6) return 0;
        if (!spti_column_fits(columns[i], count)) return 0;
    }
    return 1;
}

static int check_hits(const spt_hits *hits, size_t count) {
    const spt_sink *const sinks[] = {&hits->t,           &hits->residual,        &hits->outcome,
                                     &hits->evaluations, &hits->flags,           &hits->component,
                                     &hits->candidate_t, &hits->candidate_ratio, &hits->fallbacks};
    for (size_t i = 0; i < sizeof sinks / sizeof *sinks; ++i) {
        if (!spti_sink_fits(sinks[i], count)) return 0;
    }
    return 1;
}

int spti_views_fit(const spt_rays *rays, const spt_hits *hits, size_t count) {
    return check_rays(rays, count) && check_hits(hits, count);
}

static void settle_wants(spti_call *call) {
    const spt_hits *hits = call->hits;
    const int counted = call->statistics != NULL;
    call->wants = 0;
    if (hits->candidate_t.first != NULL || hits->candidate_ratio.first != NULL) {
        call->wants |= SPTI_WANT_CANDIDATE;
    }
    if (hits->flags.first != NULL || counted) call->wants |= SPTI_WANT_SLOPE;
    if (hits->fallbacks.first != NULL || counted) call->wants |= SPTI_WANT_FALLBACKS;
}

/* Whether all rays have one origin, and no path before. */
static int have_one_origin(const spt_rays *rays) {
    return rays->origin[0].stride == 0 && rays->origin[1].stride == 0 &&
           rays->origin[2].stride == 0 && rays->path.first == NULL;
}

/* The arrays that hold something in this call, and not the same throughout; the others are not
 * moved. */
static void settle_arrays(spti_call *call) {
    const spt_method *method = call->settings.method;
    if (call->rays != NULL) {
        call->one_origin = call->turn == NULL && have_one_origin(call->rays);
    }
    call->array_count = 0;
    for (int array = 0; array < SPTI_ARRAYS; ++array) {
        int held = 1;
        if (array >= SPTI_ORIGIN && array < SPTI_ORIGIN + 3) held = !call->one_origin;
        if (array == SPTI_PATH) held = !call->one_origin;
        if (array == SPTI_MEMORY) held = method->memory > 0;
        if (array == SPTI_PENDING_T) held = method->pending || method->memory > 1;
        if (array == SPTI_PENDING_VALUE) {
            held = method->pending || (call->settings.flags & SPT_SKIP_START) != 0 ||
                   call->turn != NULL;
        }
        if (array == SPTI_SPENT) held = spti_keeps_spent(call);
        if (array == SPTI_STOP) held = call->stop != NULL;
        if (array == SPTI_STEEPEST) held = (call->wants & SPTI_WANT_SLOPE) != 0;
        if (array == SPTI_FALLBACKS) held = (call->wants & SPTI_WANT_FALLBACKS) != 0;
        if (array == SPTI_CANDIDATE_T || array == SPTI_CANDIDATE_RATIO) {
            held = (call->wants & SPTI_WANT_CANDIDATE) != 0;
        }
        if (held) call->arrays[call->array_count++] = (unsigned char)array;
    }
}

static void settle_march(spti_call *call) {
    const spt_settings *settings = &call->settings;
    const spt_bound *bound = call->field.bound != NULL ? &call->bound : NULL;
    const float extent = bound != NULL ? spti_bound_size(bound) : 0.0f;
    call->march.pixel_radius = settings->pixel_radius;
    call->march.relaxation = settings->relaxation;
    call->march.extrapolation = settings->extrapolation;
    call->march.slope_blend = settings->slope_blend;
    call->march.step_cap = settings->step_cap;
    call->march.epsilon = settings->epsilon;
    call->march.size = settings->size > extent ? settings->size : extent;
    call->march.inverse_lipschitz = 1.0f / call->field.lipschitz;
    const uint32_t between = SPT_CANDIDATE_PENUMBRA | SPT_CANDIDATE_CLOSEST;
    call->march.between = (call->wants & SPTI_WANT_CANDIDATE) ? settings->flags & between : 0;
    call->march.bound = bound;
}

void spti_call_settle(spti_call *call) {
    call->isa = spti_isa_choose(call->settings.max_lanes);
    settle_wants(call);
    settle_march(call);
    settle_arrays(call);
    call->pass = call->settings.method->march[call->isa][call->wants];
}

/* The chunk's frame is left before the public door's: no more than one is on the stack. */
SPTI_NOINLINE void spti_trace_window(const spti_call *call, size_t first, size_t window) {
    SPTI_ALIGNED(64) float arrays[SPTI_STOP][SPTI_ROOM]; /* all but that, the last */
    spti_chunk chunk;
    chunk.array = arrays;
    spti_trace_chunk(call, &chunk, first, window);
}

spt_status spt_trace(const spt_field *field, const spt_settings *settings, size_t count,
                     const spt_rays *rays, const spt_hits *hits, spt_statistics *statistics) {
    spti_call call;
    memset(&call, 0, sizeof call);
    if (!spti_field_copy(&call.field, &call.bound, field)) return SPT_BAD_ARGUMENT;
    if (!spti_settings_copy(&call.settings, settings)) return SPT_BAD_ARGUMENT;
    if (!spti_method_allowed(call.settings.method, &call.field)) return SPT_BAD_ARGUMENT;
    if (statistics != NULL && statistics->struct_size < sizeof *statistics) return SPT_BAD_ARGUMENT;
    if (count == 0) return SPT_OK;
    if (rays == NULL || hits == NULL) return SPT_BAD_ARGUMENT;
    if (!spti_views_fit(rays, hits, count)) return SPT_BAD_ARGUMENT;
    call.rays = rays;
    call.hits = hits;
    call.statistics = statistics;
    call.leave = spti_write_hits;
    spti_call_settle(&call);
    if (statistics != NULL) statistics->lanes = (uint32_t)spti_isa_lanes(call.isa);
    for (size_t first = 0; first < count; first += SPT_BATCH) {
        const size_t left = count - first;
        spti_trace_window(&call, first, left < SPT_BATCH ? left : SPT_BATCH);
    }
    return SPT_OK;
}

const char *spt_method_name(const spt_method *method) {
    return method != NULL ? method->name : NULL;
}
