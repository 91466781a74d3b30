/* SPDX-License-Identifier: MIT
 *
 * Whether something stops a ray, and how nearly something does. */
#include <math.h>

#include "landing.h"

spt_status spt_occluded(const spt_field *field, const spt_settings *settings, size_t count,
                        const spt_rays *rays, const spt_sink *occluded,
                        spt_statistics *statistics) {
    spt_settings copy;
    spt_hits hits;
    if (!spti_settings_copy(&copy, settings)) return SPT_BAD_ARGUMENT;
    if (count > 0 && (occluded == NULL || occluded->first == NULL)) return SPT_BAD_ARGUMENT;
    memset(&hits, 0, sizeof hits);
    if (count > 0) hits.outcome = *occluded;
    copy.flags |= SPT_STOP_INSIDE;
    const spt_status status = spt_trace(field, &copy, count, rays, &hits, statistics);
    if (status != SPT_OK) return status;
    for (size_t i = 0; i < count; ++i) {
        const spt_column outcomes = spti_column_of(&hits.outcome);
        if (!spti_is_active(rays, i)) continue;
        const int32_t outcome = spti_read_integer(&outcomes, i, SPT_MISS);
        spti_write_integer(occluded, i, outcome != SPT_MISS && outcome != SPT_BAD_RAY);
    }
    return SPT_OK;
}

spt_status spt_soft_shadow(const spt_field *field, const spt_settings *settings,
                           const spt_column *tangent, int smooth, size_t count,
                           const spt_rays *rays, const spt_sink *visibility,
                           spt_statistics *statistics) {
    int32_t outcomes[SPT_BATCH];
    float ratios[SPT_BATCH];
    spt_settings copy;
    spt_hits hits;
    spt_status status;
    if (!spti_settings_copy(&copy, settings)) return SPT_BAD_ARGUMENT;
    copy.flags = (copy.flags & ~(uint32_t)SPT_CANDIDATE_CLOSEST) | SPT_CANDIDATE_PENUMBRA;
    memset(&hits, 0, sizeof hits);
    /* The arguments are checked once, by a call of no rays and with the caller's views. */
    status = spt_trace(field, &copy, 0, rays, &hits, statistics);
    if (status != SPT_OK || count == 0) return status;
    if (rays == NULL || tangent == NULL || tangent->first == NULL || visibility == NULL ||
        visibility->first == NULL || !spti_column_fits(tangent, count)) {
        return SPT_BAD_ARGUMENT;
    }
    hits.candidate_ratio = *visibility;
    if (!spti_views_fit(rays, &hits, count)) return SPT_BAD_ARGUMENT;
    hits.candidate_ratio.first = ratios;
    hits.candidate_ratio.stride = (ptrdiff_t)sizeof *ratios;
    hits.outcome.first = outcomes;
    hits.outcome.stride = (ptrdiff_t)sizeof *outcomes;
    for (size_t first = 0; first < count; first += SPT_BATCH) {
        const size_t window = spti_window(first, count);
        const spt_rays some = spti_rays_from(rays, first);
        status = spt_trace(field, &copy, window, &some, &hits, statistics);
        if (status != SPT_OK) return status;
        for (size_t i = 0; i < window; ++i) {
            const float width = spti_read(tangent, first + i, 0.0f);
            float seen = 0.0f;
            if (!spti_is_active(rays, first + i)) continue;
            if (width > 0.0f && width < INFINITY) {
                seen = spt_penumbra(outcomes[i], ratios[i], width);
            }
            if (smooth) seen = seen * seen * (3.0f - 2.0f * seen);
            spti_write(visibility, first + i, seen);
        }
    }
    return SPT_OK;
}
