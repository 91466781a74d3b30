/* SPDX-License-Identifier: MIT
 *
 * The public door: checks the arguments, settles what the call needs, and hands the rays over in
 * chunks. */
#include "../base/arguments.h"
#include "../base/columns.h"
#include "../bound/bound_check.h"
#include "driver.h"

/* Views consist of columns and of nothing else. The first six of rays must be there. */
static int check_rays(const spt_rays *rays, size_t count) {
    for (size_t i = 0; i < sizeof *rays / sizeof(spt_column); ++i) {
        spt_column column;
        memcpy(&column, (const char *)rays + i * sizeof column, sizeof column);
        if ((column.first == NULL && i < 6) || !spti_column_fits(&column, count)) return 0;
    }
    return 1;
}

static int check_hits(const spt_hits *hits, size_t count) {
    for (size_t i = 0; i < sizeof *hits / sizeof(spt_sink); ++i) {
        spt_sink sink;
        memcpy(&sink, (const char *)hits + i * sizeof sink, sizeof sink);
        if (!spti_sink_fits(&sink, count)) return 0;
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
    const int skips = (call->settings.flags & SPT_SKIP_START) != 0;
    uint32_t absent = 0;
    if (call->rays != NULL) {
        call->one_origin = call->turn == NULL && have_one_origin(call->rays);
    }
    if (call->one_origin) absent |= 7u << SPTI_ORIGIN | 1u << SPTI_PATH;
    if (method->memory < 1) absent |= 1u << SPTI_MEMORY;
    if (method->memory < 2 && !method->pending) absent |= 1u << SPTI_PENDING_T;
    if (!method->pending && !skips && call->turn == NULL) absent |= 1u << SPTI_PENDING_VALUE;
    if (!spti_keeps_spent(call)) absent |= 1u << SPTI_SPENT;
    if (call->stop == NULL) absent |= 1u << SPTI_STOP;
    if (!(call->wants & SPTI_WANT_SLOPE)) absent |= 1u << SPTI_STEEPEST;
    if (!(call->wants & SPTI_WANT_FALLBACKS)) absent |= 1u << SPTI_FALLBACKS;
    if (!(call->wants & SPTI_WANT_CANDIDATE)) {
        absent |= 1u << SPTI_CANDIDATE_T | 1u << SPTI_CANDIDATE_RATIO;
    }
    call->array_count = 0;
    for (int array = 0; array < SPTI_ARRAYS; ++array) {
        if (!(absent >> array & 1)) call->arrays[call->array_count++] = (unsigned char)array;
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
