/* SPDX-License-Identifier: MIT
 *
 * spt_probe_of_field(): a ball is free where f / lipschitz >= radius, by either callback and of any
 * value; traced it gives the bits of a probe that says just that. */
#include "moekrs_ask.h"
#include "../check.h"
#include "../rules.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { room = 200 };

/* 3 times the distance to the unit ball, in float; special at places of its own. */
static float value_at(float x, float y, float z) {
    if (x > 20) return x > 40 ? INFINITY : x > 30 ? -INFINITY : NAN;
    return 3 * (sqrtf(x * x + y * y + z * z) - 1);
}

static float field_point(void *user, float x, float y, float z) {
    (void)user;
    return value_at(x, y, z);
}

static void field_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                        float *distance) {
    (void)user;
    for (size_t i = 0; i < n; ++i) distance[i] = value_at(x[i], y[i], z[i]);
}

static float own_probe(void *user, float x, float y, float z, float radius) {
    (void)user;
    if (isnan(value_at(x, y, z))) return NAN;
    return value_at(x, y, z) / 3 >= radius ? 0.0f : -1.0f;
}

static spt_field field_of(int point) {
    spt_field field = spt_field_default();
    field.lipschitz = 3;
    if (point) {
        field.point = field_point;
    } else {
        field.batch = field_batch;
    }
    return field;
}

static void binary_field_answers(void) {
    static moekrs_query queries[room];
    for (int point = 0; point < 2; ++point) {
        const spt_field field = field_of(point);
        const spt_probe probe = spt_probe_of_field(&field);
        CHECK(probe.struct_size == sizeof probe && (probe.batch != NULL || probe.point != NULL));
        CHECK(probe.bound == NULL);
        for (int i = 0; i < room; ++i) {
            float *const p = queries[i].point;
            for (int axis = 0; axis < 3; ++axis) p[axis] = (float)check_uniform(-4, 4);
            if (i % 10 == 0) p[0] = (float)check_uniform(20.5, 50);
            queries[i].radius = value_at(p[0], p[1], p[2]) / 3;
            if (!(queries[i].radius > 0) || i % 10 == 0) queries[i].radius = 0.5f;
            if (i % 4 == 1) queries[i].radius = nextafterf(queries[i].radius, 0);
            if (i % 4 == 2) queries[i].radius = nextafterf(queries[i].radius, 100);
            if (i % 4 == 3) queries[i].radius *= (float)check_uniform(0.1, 2);
        }
        moekrs_ask_probe(&probe, probe.batch == NULL, room, queries);
        for (int i = 0; i < room; ++i) {
            const float *p = queries[i].point;
            const float value = value_at(p[0], p[1], p[2]);
            const int free = value / 3 >= queries[i].radius;
            CHECK_SAY((queries[i].answer >= 0) == free,
                      "point %d: clearance %g at f %.9g, radius %.9g", point,
                      (double)queries[i].answer, (double)value, (double)queries[i].radius);
            CHECK(!isnan(value) || isnan(queries[i].answer));
        }
    }
}

static void binary_field_traced(void) {
    const spt_settings defaults = spt_settings_default();
    for (int width = 0; width < 2 * width_count; ++width) {
        static spt_ray rays[room];
        static spt_hit hits[2][room];
        const spt_field field = field_of(width % 2);
        const spt_bound bound = spt_bound_sphere(0, 0, 0, 1.5f);
        spt_field bounded = field;
        spt_settings settings = defaults;
        const spt_rays from = spt_rays_of(rays);
        int outcomes[SPT_OUTCOMES] = {0, 0, 0, 0, 0};
        bounded.bound = &bound;
        settings.max_lanes = widths[width / 2];
        check_context("%u lanes, point %d", settings.max_lanes, width % 2);
        for (int i = 0; i < room; ++i) {
            memset(&rays[i], 0, sizeof rays[i]);
            for (int axis = 0; axis < 3; ++axis) {
                rays[i].origin[axis] = (float)check_uniform(-4, 4);
                rays[i].direction[axis] = (float)check_uniform(-2, 2) - rays[i].origin[axis];
            }
            rays[i].t_max = 20;
        }
        for (int own = 0; own < 2; ++own) {
            const spt_hits to = spt_hits_of(hits[own]);
            spt_probe probe = spt_probe_of_field(&field);
            if (own) probe = spt_probe_default();
            if (own) probe.point = own_probe;
            CHECK(spt_binary_trace(&probe, NULL, &settings, room, &from, &to, NULL) == SPT_OK);
        }
        CHECK(memcmp(hits[0], hits[1], sizeof hits[0]) == 0);
        for (int i = 0; i < room; ++i) ++outcomes[hits[0][i].outcome];
        CHECK(outcomes[SPT_HIT] > room / 8 && outcomes[SPT_NONFINITE] > 0 &&
              outcomes[SPT_MISS] > room / 8);
        for (int own = 0; own < 2; ++own) { /* the field's bound is the probe's */
            const spt_hits to = spt_hits_of(hits[own]);
            spt_probe probe = spt_probe_of_field(own ? &field : &bounded);
            CHECK(own || probe.bound == &bound);
            if (own) probe.bound = &bound;
            CHECK(spt_binary_trace(&probe, NULL, &settings, room, &from, &to, NULL) == SPT_OK);
        }
        CHECK(memcmp(hits[0], hits[1], sizeof hits[0]) == 0);
    }
}

void suite_binary_fields(void) {
    RUN(binary_field_answers);
    RUN(binary_field_traced);
}
