/* SPDX-License-Identifier: MIT
 *
 * One harness for libFuzzer and for the unit run: the calls of surface.h on fields, volumes, rays,
 * hits, points and bodies made of bytes, and what the headers say of every result, whatever they
 * are.
 *     clang -std=c99 -g -O1 -DFUZZ_SURFACE_ALONE -fsanitize=fuzzer,address,undefined -Iinclude \
 *         -Itests tests/fuzz/fuzz_surface*.c tests/fuzz/fuzz_input.c tests/stress/surface_calls.c \
 *         tests/stress/surface_reading.c tests/stress/surface_results.c \
 *         tests/stress/surface_answers.c build/libspheretrace.a -lm */
#include "fuzz_surface.h"

#include "stress/surface_results.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef FUZZ_SURFACE_ALONE /* without fuzz_trace.c, which has these for the unit run */
fuzz_failed_fn *fuzz_failed;

void fuzz_fail(const char *condition, const char *file, int line) {
    if (fuzz_failed == NULL) {
        fprintf(stderr, "%s:%d: %s\n", file, line, condition);
        abort();
    }
    fuzz_failed(condition, file, line);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    return fuzz_surface_input(data, size);
}
#endif

static fuzz_surface_case what;

/* ---- One call -------------------------------------------------------------------------------- */

static spt_status place(uint32_t lanes, spt_statistics *statistics) {
    what.settings.max_lanes = lanes;
    what.call.statistics = statistics;
    memcpy(what.out, what.before, sizeof what.out);
    fuzz_surface_clear(&what);
    const spt_status status = surface_place(&what.call);
    FUZZ_CHECK(fuzz_surface_faults(&what) == 0);
    return status;
}

static void check_results(void) {
    surface_truth truth;
    truth.value = fuzz_surface_value;
    truth.user = what.parts;
    truth.size = fuzz_surface_size(&what);
    for (int column = 0; column < surface_outputs; ++column) {
        truth.before[column] = what.before[column];
    }
    for (size_t i = 0; i < what.call.count; ++i) {
        const char *const why = surface_wrong(&what.call, &truth, i);
        if (why != NULL) fuzz_fail(why, __FILE__, __LINE__);
    }
}

static void check_statistics(const spt_statistics *statistics) {
    const int marches = (surface_table[what.call.door].takes & TAKES_STATISTICS) != 0;
    const uint64_t most = surface_most_evaluations(&what.call) * what.call.count;
    if (what.fields[0].batch == NULL && what.fields[1].batch == NULL) {
        FUZZ_CHECK(fuzz_surface_points(&what) <= most);
    }
    if (!marches) return;
    FUZZ_CHECK(statistics->evaluations <= most && statistics->slots == fuzz_surface_points(&what));
    FUZZ_CHECK(statistics->largest_slope >= 0.0f && statistics->largest_slope <= FLT_MAX);
}

/* ---- Calls that are made of spt_trace() ------------------------------------------------------ */

static void check_against_trace(void) {
    static spt_hit found[fuzz_surface_most];
    const spt_rays rays = surface_rays(&what.call);
    const spt_hits hits = spt_hits_of(found);
    spt_settings settings = what.settings;
    const int shadow = what.call.door == DOOR_SHADOW;
    settings.flags &= ~(uint32_t)(SPT_CANDIDATE_CLOSEST | SPT_CANDIDATE_PENUMBRA);
    settings.flags |= shadow ? SPT_CANDIDATE_PENUMBRA : SPT_STOP_INSIDE;
    FUZZ_CHECK(spt_trace(what.fields, &settings, what.call.count, &rays, &hits, NULL) == SPT_OK);
    for (size_t i = 0; i < what.call.count; ++i) {
        const spt_hit *const hit = &found[i];
        const float tangent = surface_float(what.in[IN_TANGENT][i]);
        const int free_of_all = hit->outcome == SPT_MISS || hit->outcome == SPT_BAD_RAY;
        if (surface_is_idle(&what.call, i)) continue;
        if (!shadow) {
            FUZZ_CHECK(what.out[OUT_ANSWER][i] == (free_of_all ? 0u : 1u));
            continue;
        }
        if (!(tangent > 0.0f && tangent <= FLT_MAX) || hit->outcome == SPT_BAD_RAY) continue;
        const float seen = spt_penumbra(hit->outcome, hit->candidate_ratio, tangent);
        const float smooth = seen * seen * (3.0f - 2.0f * seen);
        const float answer = surface_float(what.out[OUT_ANSWER][i]);
        if (what.call.smooth) {
            FUZZ_CHECK(fabsf(answer - smooth) <= 4 * FLT_EPSILON); /* in any order of products */
        } else {
            FUZZ_CHECK(surface_bits(answer) == surface_bits(seen));
        }
    }
}

/* ---- Everything backwards, at another width -------------------------------------------------- */

static void check_other_order(uint32_t lanes) {
    static uint32_t first[surface_outputs][fuzz_surface_most * surface_most_crossings];
    const surface_call forward = what.call;
    const ptrdiff_t last = (ptrdiff_t)forward.count - 1;
    memcpy(first, what.out, sizeof first);
    for (int column = 0; column < surface_inputs; ++column) {
        spt_column *const view = &what.call.in[column];
        if (view->first == NULL) continue;
        view->first = (const char *)view->first + last * view->stride;
        view->stride = -view->stride;
    }
    for (int column = 0; column < surface_outputs; ++column) {
        spt_sink *const view = &what.call.out[column];
        view->first = (char *)view->first + last * view->stride;
        view->stride = -view->stride;
    }
    FUZZ_CHECK(place(lanes, NULL) == SPT_OK);
    FUZZ_CHECK(memcmp(first, what.out, sizeof first) == 0);
    what.call = forward;
}

/* ---- The other functions --------------------------------------------------------------------- */

static void check_interval(const spt_bound *bound, fuzz_legal legal) {
    float origin[3], direction[3], t_in = 77.0f, t_out = 77.0f;
    for (size_t i = 0; i < what.call.count; i += 1 + what.call.count / 4) {
        const float t_min = surface_float(what.in[IN_T_MIN][i]);
        const float t_max = surface_float(what.in[IN_T_MAX][i]);
        surface_call call = what.call;
        call.in[IN_PATH].first = NULL; /* a bad path makes no bad ray here */
        for (int axis = 0; axis < 3; ++axis) {
            origin[axis] = surface_float(what.in[IN_ORIGIN + axis][i]);
            direction[axis] = surface_float(what.in[IN_DIRECTION + axis][i]);
        }
        const spt_status status =
            spt_bound_interval(bound, origin, direction, t_min, t_max, &t_in, &t_out);
        const int bad = surface_ray_is_bad(&call, i) || legal == FUZZ_REFUSED;
        FUZZ_CHECK(legal == FUZZ_EITHER || status == (bad ? SPT_BAD_ARGUMENT : SPT_OK));
        if (status != SPT_OK) continue;
        if (t_in <= t_out) {
            FUZZ_CHECK(t_in >= t_min && t_out <= t_max);
        } else {
            FUZZ_CHECK(t_in >= INFINITY && t_out <= -INFINITY);
        }
    }
}

static void check_volume(const spt_bound *bound) {
    static const float up[] = {0.0f, 0.0f, 1.0f}, eye[] = {0.5f, 0.25f, -4.0f};
    const fuzz_legal legal = fuzz_bound_legal(bound);
    const float chord = (float)(what.seed & 63u) / 64.0f;
    float low[3], high[3];
    int meets = 7;
    const spt_status extent = spt_bound_extent(bound, low, high);
    const spt_status cone = spt_bound_meets_cone(bound, eye, up, chord, 9.0f, &meets);
    const spt_status right = legal == FUZZ_LEGAL ? SPT_OK : SPT_BAD_ARGUMENT;
    FUZZ_CHECK(legal == FUZZ_EITHER || (extent == right && cone == right));
    FUZZ_CHECK(extent != SPT_OK || (low[0] <= high[0] && low[1] <= high[1] && low[2] <= high[2]));
    FUZZ_CHECK(cone == SPT_OK ? meets == 0 || meets == 1 : meets == 7);
    check_interval(bound, legal);
}

static void check_field_check(const spt_field *field) {
    enum { samples = 20 };
    spt_field_faults faults, again;
    const fuzz_legal legal = fuzz_field_legal(field);
    memset(&faults, 0, sizeof faults);
    memset(&again, 0, sizeof again);
    const spt_status status = spt_field_check(field, samples, what.seed, &faults);
    FUZZ_CHECK(legal == FUZZ_EITHER || (status == SPT_BAD_ARGUMENT) == (legal == FUZZ_REFUSED));
    FUZZ_CHECK(spt_field_check(field, samples, what.seed, &again) == status);
    FUZZ_CHECK(memcmp(&faults, &again, sizeof faults) == 0);
    const float *const worst = faults.worst[0];
    for (int i = 0; i < 15; ++i) FUZZ_CHECK(fabsf(worst[i]) <= FLT_MAX);
    FUZZ_CHECK(field->bound != NULL || status == SPT_UNSUPPORTED || legal == FUZZ_REFUSED);
}

static void check_level_set(void) {
    static const float eye[] = {0.5f, 0.25f, -4.0f};
    spt_settings settings = what.settings;
    spt_level_set memory;
    spt_field result;
    const float share = (float)(what.seed & 63u) / 63.0f;
    const spt_status status =
        spt_level_set_field(what.fields, eye, 0.5f, share, &settings, &memory, &result);
    const fuzz_legal legal = fuzz_field_legal(what.fields);
    const int settled = fuzz_settings_legal(&what.settings);
    const int usual = what.settings.pixel_radius < 1e18f && what.fields[0].lipschitz < 1e10f &&
                      what.settings.method != spt_convex();
    if (legal == FUZZ_LEGAL && settled && usual) {
        FUZZ_CHECK(status == SPT_OK);
    }
    if (legal == FUZZ_REFUSED || !settled) FUZZ_CHECK(status == SPT_BAD_ARGUMENT);
    if (status != SPT_OK) return;
    spt_hit found[fuzz_surface_most];
    spt_rays rays = surface_rays(&what.call);
    const spt_hits hits = spt_hits_of(found);
    rays.active.first = NULL;
    if (spt_trace(&result, &settings, what.call.count, &rays, &hits, NULL) != SPT_OK) return;
    for (size_t i = 0; i < what.call.count; ++i) {
        FUZZ_CHECK(found[i].outcome >= 0 && found[i].outcome < SPT_OUTCOMES);
        FUZZ_CHECK(found[i].t <= INFINITY && found[i].evaluations <= settings.budget);
    }
}

int fuzz_surface_input(const uint8_t *data, size_t size) {
    static const uint32_t widths[] = {0, 4, 8, 16};
    spt_statistics statistics = spt_statistics_default();
    fuzz_surface_read(&what, data, size);
    const fuzz_legal legal = fuzz_surface_legal(&what);
    const spt_status status = place(1, &statistics);
    FUZZ_CHECK(status == SPT_OK || status == SPT_BAD_ARGUMENT);
    FUZZ_CHECK(legal == FUZZ_EITHER || (status == SPT_OK) == (legal == FUZZ_LEGAL));
    if (status != SPT_OK) {
        FUZZ_CHECK(fuzz_surface_points(&what) == 0);
        FUZZ_CHECK(memcmp(what.out, what.before, sizeof what.out) == 0);
    } else {
        check_results();
        check_statistics(&statistics);
        if (what.call.door == DOOR_OCCLUDED || what.call.door == DOOR_SHADOW) check_against_trace();
        check_other_order(widths[size % 4]);
    }
    if (!what.other_calls) return 0;
    for (int i = 0; i < surface_most_fields; ++i) {
        if (what.fields[i].bound != NULL) check_volume(what.fields[i].bound);
        check_field_check(&what.fields[i]);
    }
    check_level_set();
    FUZZ_CHECK(fuzz_surface_faults(&what) == 0);
    return 0;
}
