/* SPDX-License-Identifier: MIT
 *
 * Probes without a body. */
#include "binary_told.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <string.h>

static float say(binary_told *as, float x, float radius) {
    ++as->asked;
    switch (as->what) {
    case BINARY_NEVER:
        return -1;
    case BINARY_NEARLY:
        return radius > 1e-30f ? -1.0f : 0.0f;
    case BINARY_ALWAYS:
        return 1;
    case BINARY_NOT_A_NUMBER:
        return NAN;
    case BINARY_NAN_BEYOND:
        return x > 5 ? NAN : 1.0f;
    case BINARY_NAN_IF_LARGE:
        return radius > 0.5f ? NAN : 5 - x - radius;
    case BINARY_WALL:
        return 5 - x - radius;
    case BINARY_FAR_WALL:
        return 100 - x - radius;
    }
    return 0;
}

static void say_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                      const float *radius, float *clearance) {
    (void)y, (void)z;
    for (size_t i = 0; i < n; ++i) clearance[i] = say(user, x[i], radius[i]);
}

static float say_point(void *user, float x, float y, float z, float radius) {
    (void)y, (void)z;
    return say(user, x, radius);
}

void binary_call_of(binary_call *c, binary_saying what) {
    const spt_ray ray = {{0, 0, 0}, 0, {1, 0, 0}, 50};
    memset(c, 0, sizeof *c);
    c->as.what = what;
    c->probe = spt_probe_default();
    c->probe.batch = say_batch;
    c->probe.user = &c->as;
    c->bound = spt_bound_sphere(0, 0, 0, 20);
    c->binary = spt_binary_default();
    c->settings = spt_settings_default();
    c->ray = ray;
}

void binary_call_trace(binary_call *c) {
    const spt_rays rays = spt_rays_of(&c->ray);
    const spt_hits hits = spt_hits_of(&c->hit);
    c->as.asked = 0;
    CHECK(spt_binary_trace(&c->probe, &c->binary, &c->settings, 1, &rays, &hits, NULL) == SPT_OK);
    CHECK_SAY(c->hit.evaluations <= c->settings.budget, "%u probes", c->hit.evaluations);
    CHECK(c->hit.outcome == SPT_MISS || c->hit.outcome == SPT_BAD_RAY || isfinite(c->hit.t));
    CHECK(!isnan(c->hit.t));
}

void binary_expect(binary_call *c, spt_outcome outcome, double low, double high) {
    binary_call_trace(c);
    CHECK_SAY(
        c->hit.outcome == (int32_t)outcome && (double)c->hit.t >= low && (double)c->hit.t <= high,
        "outcome %d at %.9g after %u probes", c->hit.outcome, (double)c->hit.t, c->hit.evaluations);
}

int binary_way(binary_call *c, int *way) {
    if (*way == 2 * width_count) return 0;
    c->settings.max_lanes = widths[*way / 2];
    c->probe.batch = *way % 2 == 0 ? say_batch : NULL;
    c->probe.point = *way % 2 == 0 ? NULL : say_point;
    check_context("%u lanes, point %d", widths[*way / 2], *way % 2);
    ++*way;
    return 1;
}
