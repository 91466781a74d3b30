/* SPDX-License-Identifier: MIT
 *
 * The door and the windows of tracers that step by a pass of their own. */
#include "own_pass.h"

#include "../base/columns.h"

static SPTI_NOINLINE void trace_window(const spti_call *call, spti_own_field *own, size_t first,
                                       size_t window) {
    SPTI_ALIGNED(64) float arrays[SPTI_STOP][SPTI_ROOM];
    spti_chunk chunk;
    chunk.array = arrays;
    own->chunk = &chunk;
    spti_trace_chunk(call, &chunk, first, window);
}

spt_status spti_trace_by(spti_call *call, spti_own_field *own, spti_march_fn *pass,
                         const spti_own_numbers *numbers, const spt_settings *settings,
                         size_t count, const spt_rays *rays, const spt_hits *hits,
                         spt_statistics *statistics) {
    spti_march_fn *passes[SPTI_WANTS];
    spt_method method = {.name = "own", .memory = 2};
    if (!spti_settings_copy(&call->settings, settings)) return SPT_BAD_ARGUMENT;
    if (call->settings.flags != 0) return SPT_BAD_ARGUMENT;
    if (statistics != NULL && statistics->struct_size < sizeof *statistics) return SPT_BAD_ARGUMENT;
    if (count == 0) return SPT_OK;
    if (rays == NULL || hits == NULL) return SPT_BAD_ARGUMENT;
    if (!spti_views_fit(rays, hits, count)) return SPT_BAD_ARGUMENT;
    /* The same pass for all widths, and whatever is wanted. */
    for (int wants = 0; wants < SPTI_WANTS; ++wants) passes[wants] = pass;
    for (int isa = 0; isa < SPTI_ISA_COUNT; ++isa) method.march[isa] = passes;
    call->settings.method = &method;
    call->rays = rays;
    call->hits = hits;
    call->statistics = statistics;
    call->leave = spti_write_hits;
    spti_call_settle(call);
    call->march.relaxation = numbers->number[0];
    call->march.extrapolation = numbers->number[1];
    call->march.slope_blend = numbers->number[2];
    call->march.step_cap = numbers->number[3];
    if (statistics != NULL) statistics->lanes = (uint32_t)spti_isa_lanes(call->isa);
    for (size_t first = 0; first < count; first += SPT_BATCH) {
        const size_t left = count - first;
        trace_window(call, own, first, left < SPT_BATCH ? left : SPT_BATCH);
    }
    return SPT_OK;
}
