/* SPDX-License-Identifier: MIT
 *
 * The lists of ways, the base scene and the audited callback of the stress tests. What every
 * result must satisfy is in stress_contract.c. */
#include "stress.h"

#include "rules.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const uint32_t stress_widths[STRESS_WIDTHS] = {1, 4, 8, 16};

enum { forms = 2, ways_of_a_method = STRESS_WIDTHS * forms };

stress_way stress_ways(uint32_t selection) {
    stress_way way;
    memset(&way, 0, sizeof way);
    way.selection = selection;
    way.place = -1;
    way.index = -1;
    return way;
}

/* The hash of the way that ends is compared with that of the first way of its method. */
static void close_way(stress_way *way) {
    if (way->index < 0 || (way->selection & STRESS_OWN_RAYS) != 0) return;
    if (way->hashed != way->method) {
        way->hashed = way->method;
        way->first_results = way->results;
    } else {
        CHECK_SAY(way->results == way->first_results, "results differ from those of 1 lane");
    }
}

static void say_missing_widths(void) {
    static int said = 0;
    if (said) return;
    said = 1;
    for (int i = 0; i < STRESS_WIDTHS; ++i) {
        if ((int)stress_widths[i] > spt_lanes()) {
            printf("this machine has no %u lanes: stress tests do not run at that width\n",
                   (unsigned)stress_widths[i]);
        }
    }
}

int stress_next(stress_way *way) {
    close_way(way);
    say_missing_widths();
    for (++way->place; way->place < rule_count * ways_of_a_method; ++way->place) {
        const int method = way->place / ways_of_a_method;
        const uint32_t lanes = stress_widths[way->place / forms % STRESS_WIDTHS];
        const int point = way->place % forms;
        if (!rule_allowed(&rules[method], way->selection & STRESS_CONVEX ? SPT_FIELD_CONVEX : 0)) {
            continue;
        }
        if ((int)lanes > spt_lanes()) continue;
        if (point && (way->selection & (STRESS_BATCH | STRESS_ONCE)) != 0) continue;
        if ((int)lanes != spt_lanes() && (way->selection & STRESS_ONCE) != 0) continue;
        way->method = rules[method].method();
        way->name = spt_method_name(way->method);
        way->lanes = lanes;
        way->point = point;
        way->results = 0xcbf29ce484222325u; /* the offset of FNV-1a */
        ++way->index;
        check_context("method %s, %u lanes, %s", way->name, (unsigned)lanes,
                      point ? "one point" : "batch");
        return 1;
    }
    check_context("%s", "");
    CHECK(way->index >= 0);
    return 0;
}

/* ---- Cases --------------------------------------------------------------------------------- */

float stress_sphere_distance(const void *data, float x, float y, float z) {
    const stress_sphere *sphere = data;
    const float dx = x - sphere->center[0], dy = y - sphere->center[1], dz = z - sphere->center[2];
    return sqrtf(dx * dx + dy * dy + dz * dz) - sphere->radius;
}

float stress_constant_distance(const void *data, float x, float y, float z) {
    (void)x, (void)y, (void)z;
    return *(const float *)data;
}

float stress_floor_distance(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)z;
    return y;
}

static const stress_sphere base_sphere = {{0.0f, 0.0f, 10.0f}, 1.0f};

stress_case stress_base(void) {
    return stress_case_of(stress_sphere_distance, &base_sphere);
}

stress_case stress_case_of(stress_distance_fn *distance, const void *data) {
    const spt_ray ray = {{0.0f, 0.0f, 0.0f}, 0.0f, {0.0f, 0.0f, 1.0f}, 100.0f};
    stress_case what;
    memset(&what, 0, sizeof what);
    what.distance = distance;
    what.data = data;
    what.lipschitz = 1.0f;
    what.ray = ray;
    what.settings = spt_settings_default();
    what.settings.budget = 128;
    what.settings.epsilon = 1e-4f;
    return what;
}

/* ---- The audited callback ------------------------------------------------------------------ */

static int finite_bits(float a) {
    return (check_bits(a) & 0x7f800000u) != 0x7f800000u;
}

static void record(stress_probe *probe, float x, float y, float z, float value) {
    if (probe->recorded == STRESS_RECORD) return;
    probe->position[probe->recorded][0] = x;
    probe->position[probe->recorded][1] = y;
    probe->position[probe->recorded][2] = z;
    probe->value[probe->recorded] = value;
    ++probe->recorded;
}

static int aligned(const void *pointer) {
    return ((uintptr_t)pointer & 63u) == 0;
}

static int apart(const float *a, const float *b, size_t n) {
    const uintptr_t first = (uintptr_t)a, second = (uintptr_t)b;
    return (first > second ? first - second : second - first) >= n * sizeof(float);
}

static void audited_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                          float *distance) {
    stress_probe *probe = user;
    ++probe->calls;
    probe->points += n;
    if (n == 0 || n % 16 != 0 || n > SPT_BATCH) {
        ++probe->faults;
        return;
    }
    if (!(aligned(x) && aligned(y) && aligned(z) && aligned(distance))) ++probe->faults;
    if (!(apart(x, y, n) && apart(x, z, n) && apart(y, z, n))) ++probe->faults;
    if (!(apart(x, distance, n) && apart(y, distance, n) && apart(z, distance, n))) {
        ++probe->faults;
    }
    for (size_t i = 0; i < n; ++i) {
        if (!(finite_bits(x[i]) && finite_bits(y[i]) && finite_bits(z[i]))) ++probe->faults;
        if (probe->single && !(check_same_bits(x[i], x[0]) && check_same_bits(y[i], y[0]) &&
                               check_same_bits(z[i], z[0]))) {
            ++probe->faults;
        }
        distance[i] = probe->distance(probe->data, x[i], y[i], z[i]);
    }
    record(probe, x[0], y[0], z[0], distance[0]);
}

static float audited_point(void *user, float x, float y, float z) {
    stress_probe *probe = user;
    const float value = probe->distance(probe->data, x, y, z);
    ++probe->calls;
    ++probe->points;
    if (!(finite_bits(x) && finite_bits(y) && finite_bits(z))) ++probe->faults;
    record(probe, x, y, z, value);
    return value;
}

void stress_probe_of(stress_probe *probe, const stress_case *what, int single) {
    probe->distance = what->distance;
    probe->data = what->data;
    probe->single = single;
    probe->calls = probe->points = probe->faults = probe->recorded = 0;
}

spt_field stress_field(const stress_way *way, const stress_case *what, stress_probe *probe) {
    spt_field field = spt_field_default();
    if (way->point) {
        field.point = audited_point;
    } else {
        field.batch = audited_batch;
    }
    field.user = probe;
    field.lipschitz = what->lipschitz;
    field.flags = (way->selection & STRESS_CONVEX) != 0 ? SPT_FIELD_CONVEX : 0;
    field.bound = what->bound;
    return field;
}

spt_settings stress_settings(const stress_way *way, const stress_case *what) {
    spt_settings settings = what->settings;
    settings.method = way->method;
    settings.max_lanes = way->lanes;
    return settings;
}
