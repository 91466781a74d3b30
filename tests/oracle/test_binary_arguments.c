/* SPDX-License-Identifier: MIT
 *
 * Arguments that spt_binary_trace() refuses, with nothing written and nothing asked. */
#include "binary_told.h"
#include "../check.h"

#include <math.h>
#include <string.h>

/* Refused, with nothing written and nothing asked. */
static void refused(const spt_probe *probe, const spt_binary *binary, const spt_settings *settings,
                    const binary_call *c, int line) {
    const spt_rays rays = spt_rays_of(&c->ray);
    spt_statistics statistics = spt_statistics_default();
    unsigned char before[sizeof(spt_hit)], marked[sizeof(spt_hit)];
    spt_hit hit;
    const spt_hits hits = spt_hits_of(&hit);
    const uint64_t asked = c->as.asked;
    memset(before, 0x5a, sizeof before);
    memset(&hit, 0x5a, sizeof hit);
    check_context("case of line %d", line);
    CHECK(spt_binary_trace(probe, binary, settings, 1, &rays, &hits, &statistics) ==
          SPT_BAD_ARGUMENT);
    memcpy(marked, &hit, sizeof hit);
    CHECK(memcmp(before, marked, sizeof before) == 0);
    CHECK(statistics.rays == 0 && statistics.passes == 0 && c->as.asked == asked);
}

#define REFUSED(...) \
    do { \
        spt_probe probe = c.probe; \
        spt_binary binary = c.binary; \
        spt_settings settings = c.settings; \
        __VA_ARGS__; \
        refused(&probe, &binary, &settings, &c, __LINE__); \
    } while (0)

static void binary_refusals(void) {
    const float no_ratio[] = {0, -1, NAN, INFINITY};
    const uint32_t flags[] = {SPT_SKIP_START,        SPT_STOP_INSIDE,  SPT_CANDIDATE_PENUMBRA,
                              SPT_CANDIDATE_CLOSEST, SPT_CHECK_CONVEX, 1u << 31};
    spt_bound empty = spt_bound_sphere(0, 0, 0, -1);
    binary_call c;
    binary_call_of(&c, BINARY_WALL);
    for (int i = 0; i < 4; ++i) {
        REFUSED(binary.bonus = no_ratio[i]);
        REFUSED(binary.penalty = no_ratio[i]);
        REFUSED(binary.probe_ratio = no_ratio[i]);
        if (i > 0) REFUSED(binary.first = no_ratio[i]);
        REFUSED(settings.epsilon = no_ratio[i]);
    }
    for (int i = 0; i < 6; ++i) REFUSED(settings.flags = flags[i]);
    REFUSED(binary.bonus = 1);
    REFUSED(binary.bonus = 8.000001f);
    REFUSED(binary.penalty = 1);
    REFUSED(binary.probe_ratio = 1.0000001f);
    REFUSED(binary.struct_size = 0);
    REFUSED(settings.struct_size = 0);
    REFUSED(settings.max_lanes = 3);
    REFUSED(settings.pixel_radius = -1);
    REFUSED(settings.size = NAN);
    REFUSED(probe.struct_size = 0);
    REFUSED(probe.batch = NULL);
    REFUSED(probe.bound = &empty);
    REFUSED(probe = spt_probe_of_field(NULL));
}

static void binary_null_pointers(void) {
    binary_call c;
    spt_rays rays, without;
    spt_hits hits;
    binary_call_of(&c, BINARY_WALL);
    rays = without = spt_rays_of(&c.ray);
    hits = spt_hits_of(&c.hit);
    without.direction[1].first = NULL;
#define STATUS(probe, settings, count, from, to) \
    spt_binary_trace(probe, NULL, settings, count, from, to, NULL)
    CHECK(STATUS(NULL, &c.settings, 1, &rays, &hits) == SPT_BAD_ARGUMENT);
    CHECK(STATUS(&c.probe, NULL, 1, &rays, &hits) == SPT_BAD_ARGUMENT);
    CHECK(STATUS(&c.probe, &c.settings, 1, NULL, &hits) == SPT_BAD_ARGUMENT);
    CHECK(STATUS(&c.probe, &c.settings, 1, &rays, NULL) == SPT_BAD_ARGUMENT);
    CHECK(STATUS(&c.probe, &c.settings, 1, &without, &hits) == SPT_BAD_ARGUMENT);
    CHECK(STATUS(&c.probe, &c.settings, 0, NULL, NULL) == SPT_OK);
    CHECK(c.as.asked == 0 && c.hit.evaluations == 0);
    CHECK(STATUS(&c.probe, &c.settings, 1, &rays, &hits) == SPT_OK); /* binary NULL: the defaults */
    CHECK(c.hit.outcome == SPT_HIT && c.hit.evaluations > 0);
#undef STATUS
}

void suite_binary_arguments(void) {
    RUN(binary_refusals);
    RUN(binary_null_pointers);
}
