/* SPDX-License-Identifier: MIT
 *
 * One harness for libFuzzer and for the unit run: the calls of krs.h and mobius.h on models, maps,
 * distortions, probes, rays and hits made of bytes, and what the headers say of every result,
 * whatever they are.
 *     clang -std=c99 -g -O1 -DFUZZ_KRS_ALONE -fsanitize=fuzzer,address,undefined -Iinclude -Itests \
 *         tests/fuzz/fuzz_krs*.c tests/fuzz/fuzz_input.c tests/stress/krs_calls.c \
 *         tests/stress/krs_results.c build/libspheretrace.a -lm */
#include "fuzz_krs.h"

#include "stress/krs_results.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef FUZZ_KRS_ALONE /* without fuzz_trace.c, which has these for the unit run */
fuzz_failed_fn *fuzz_failed;

void fuzz_fail(const char *condition, const char *file, int line) {
    if (fuzz_failed == NULL) {
        fprintf(stderr, "%s:%d: %s\n", file, line, condition);
        abort();
    }
    fuzz_failed(condition, file, line);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    return fuzz_krs_input(data, size);
}
#endif

static fuzz_krs_case what;

/* ---- Models ---------------------------------------------------------------------------------- */

static int is_filled(const void *memory, size_t size) {
    const unsigned char *const bytes = memory;
    for (size_t i = 0; i < size; ++i) {
        if (bytes[i] != fuzz_krs_fill) return 0;
    }
    return 1;
}

/* Makes something in memory of its own; with any status but SPT_OK nothing was written. */
#define MAKE(memory, call) \
    (memset(&(memory), fuzz_krs_fill, sizeof(memory)), status_of_making = (call), \
     made_status(is_filled(&(memory), sizeof(memory))))

static spt_status status_of_making;

static int made_status(int untouched) {
    const spt_status status = status_of_making;
    FUZZ_CHECK((status == SPT_OK) != untouched);
    FUZZ_CHECK(status == SPT_OK || status == SPT_BAD_ARGUMENT || status == SPT_UNSUPPORTED);
    return status == SPT_OK;
}

static int make_distorted(void) {
    what.distortion.kind =
        what.call.door == KRS_DOOR_UNMAPPED || what.call.door == KRS_DOOR_UNMAPPED_POINTS
            ? SPT_DISTORTION_MAP
            : what.distortion.kind;
    return MAKE(what.distorted, spt_distorted_field(&what.fields[0], &what.distortion,
                                                    &what.distorted, &what.field));
}

static int make_conformal(uint32_t lanes) {
    const int made = MAKE(what.conformal, spt_conformal_field(&what.fields[0], &what.maps[0],
                                                              &what.conformal, &what.field));
    if (made) what.conformal.max_lanes = lanes;
    return made;
}

/* What the door is about. Returns 0 where it was refused, which only hostile numbers may be, or
 * maps and distortions that do not fit. */
static int make(uint32_t lanes) {
    int made;
    what.model.max_lanes = what.mapped_model.max_lanes = lanes;
    what.settings.max_lanes = lanes;
    switch (what.call.door) {
    case KRS_DOOR_SEQUENCE:
    case KRS_DOOR_FIELD_PROBES:
    case KRS_DOOR_PLACES:
        made = MAKE(what.krs, spt_krs_build(&what.model, &what.krs));
        FUZZ_CHECK(made || what.hostile || what.promises == 0);
        if (made) what.field = spt_krs_field(&what.krs);
        if (made) what.probe = spt_probe_of_field(&what.field);
        return made;
    case KRS_DOOR_MAPPED:
    case KRS_DOOR_PROBES:
    case KRS_DOOR_MAPPED_PLACES:
        made = MAKE(what.moekrs, spt_moekrs_build(&what.mapped_model, &what.moekrs));
        if (made) what.field = spt_moekrs_field(&what.moekrs);
        if (made) what.probe = spt_moekrs_probe(&what.moekrs);
        return made;
    case KRS_DOOR_CONFORMAL:
    case KRS_DOOR_EXITS:
        return make_conformal(lanes);
    default:
        return make_distorted();
    }
}

/* ---- One call -------------------------------------------------------------------------------- */

static spt_status place(spt_statistics *statistics) {
    what.call.statistics = statistics;
    memset(what.out, fuzz_krs_fill, sizeof what.out);
    const spt_status status = krs_place_call(&what.call);
    FUZZ_CHECK(status == SPT_OK || status == SPT_BAD_ARGUMENT);
    FUZZ_CHECK(fuzz_krs_faults(&what) == 0);
    return status;
}

static void check_results(void) {
    for (size_t i = 0; i < what.call.count; ++i) {
        const char *const why = krs_wrong(&what.call, fuzz_krs_fill, what.promises, i);
        if (why != NULL) fuzz_fail(why, __FILE__, __LINE__);
    }
}

static void check_statistics(const spt_statistics *statistics) {
    uint64_t outcomes = 0, evaluations = 0;
    if ((krs_table[what.call.door].takes & KRS_TAKES_STATISTICS) == 0) return;
    for (size_t i = 0; i < what.call.count; ++i) {
        if (krs_read(&what.call.in[KRS_IN_ACTIVE], i, 1) == 0) continue;
        evaluations += krs_written(&what.call.out[KRS_OUT_EVALUATIONS], i, 0);
    }
    for (int i = 0; i < SPT_OUTCOMES; ++i) outcomes += statistics->outcomes[i];
    FUZZ_CHECK(statistics->rays == outcomes && outcomes <= what.call.count);
    FUZZ_CHECK(statistics->evaluations == evaluations);
    FUZZ_CHECK(statistics->slots >= evaluations);
    FUZZ_CHECK(statistics->largest_slope >= 0.0f && statistics->largest_slope <= FLT_MAX);
}

/* Everything backwards, and at another width. */
static void check_other_order(uint32_t lanes) {
    static unsigned char first[krs_outputs][fuzz_krs_most][8];
    const krs_call forward = what.call;
    const ptrdiff_t last = (ptrdiff_t)forward.count - 1;
    memcpy(first, what.out, sizeof first);
    if (!make(lanes)) {
        fuzz_fail("a model is not refused at another width", __FILE__, __LINE__);
        return;
    }
    for (int column = 0; column < krs_inputs; ++column) {
        spt_column *const view = &what.call.in[column];
        if (view->first == NULL) continue;
        view->first = (const char *)view->first + last * view->stride;
        view->stride = -view->stride;
    }
    for (int column = 0; column < krs_hit_sinks + krs_outputs; ++column) {
        spt_sink *const view = column < krs_hit_sinks ? &what.call.found[column]
                                                      : &what.call.out[column - krs_hit_sinks];
        if (view->first == NULL) continue;
        view->first = (char *)view->first + last * view->stride;
        view->stride = -view->stride;
    }
    FUZZ_CHECK(place(NULL) == SPT_OK);
    FUZZ_CHECK(memcmp(first, what.out, sizeof first) == 0);
    what.call = forward;
}

/* ---- Callbacks by themselves ----------------------------------------------------------------- */

enum { columns = 6, lanes_of_call = 16 };

/* Finite points of any magnitude, and balls around them. */
static void draw_points(float *at[columns], uint32_t seed) {
    for (int i = 0; i < 3 * lanes_of_call; ++i) {
        seed = seed * 1664525u + 1013904223u;
        const float any = krs_float(seed ^ seed >> 15);
        const float usual = (float)(seed >> 8) * 0x1p-21f - 4.0f;
        const int is_usual = i % 3 != 0 || !(fabsf(any) <= FLT_MAX);
        at[i / lanes_of_call][i % lanes_of_call] = is_usual ? usual : any;
    }
    for (int i = 0; i < lanes_of_call; ++i) at[3][i] = 0x1p-6f * (float)(1 + i * i);
}

/* Both forms of a callback agree, and nothing but a caller's field answers NaN. */
static void check_callbacks(void) {
    static float memory[columns * lanes_of_call + 16];
    float *const aligned = memory + (64 - (uintptr_t)memory % 64) % 64 / sizeof *memory;
    float *at[columns];
    const int feels = what.call.door == KRS_DOOR_PROBES;
    for (int i = 0; i < columns; ++i) at[i] = aligned + i * lanes_of_call;
    draw_points(at, what.seed * 2654435761u);
    if (feels) {
        what.probe.batch(what.probe.user, lanes_of_call, at[0], at[1], at[2], at[3], at[4]);
    } else {
        what.field.batch(what.field.user, lanes_of_call, at[0], at[1], at[2], at[4]);
    }
    draw_points(at, what.seed * 2654435761u);
    for (int i = 0; i < lanes_of_call; ++i) {
        const float x = at[0][i], y = at[1][i], z = at[2][i];
        at[5][i] = at[4][i];
        if (feels) at[5][i] = what.probe.point(what.probe.user, x, y, z, at[3][i]);
        if (!feels && what.field.point != NULL)
            at[5][i] = what.field.point(what.field.user, x, y, z);
        FUZZ_CHECK(krs_bits(at[4][i]) == krs_bits(at[5][i]));
        FUZZ_CHECK(!isnan(at[4][i]) || (what.promises & KRS_TAME) == 0);
    }
    FUZZ_CHECK(fuzz_krs_faults(&what) == 0);
}

int fuzz_krs_input(const uint8_t *data, size_t size) {
    static const uint32_t widths[] = {0, 4, 8, 16};
    spt_statistics statistics = spt_statistics_default();
    fuzz_krs_read(&what, data, size);
    fuzz_krs_other_calls(&what);
    if (!make(1)) return 0;
    const spt_status status = place(&statistics);
    if (status != SPT_OK) {
        FUZZ_CHECK(is_filled(what.out, sizeof what.out) && statistics.slots == 0);
        return 0;
    }
    check_results();
    check_statistics(&statistics);
    check_other_order(widths[size % 4]);
    if (!krs_moves(what.call.door)) check_callbacks();
    return 0;
}
