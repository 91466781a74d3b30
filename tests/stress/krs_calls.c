/* SPDX-License-Identifier: MIT
 *
 * The table of the calls of krs.h and mobius.h, and each of them made of the same columns. */
#include "krs_calls.h"

#include <string.h>

enum {
    TRACES = KRS_TAKES_MODEL | KRS_TAKES_SETTINGS | KRS_TAKES_RAYS | KRS_TAKES_HITS |
             KRS_TAKES_STATISTICS,
    LOCATES =
        KRS_TAKES_MODEL | KRS_TAKES_SETTINGS | KRS_TAKES_RAYS | KRS_TAKES_HITS | KRS_TAKES_PLACES,
    MOVES = KRS_TAKES_MODEL | KRS_TAKES_RAYS | KRS_TAKES_PLACES
};

const krs_facts krs_table[krs_doors] = {
    [KRS_DOOR_SEQUENCE] = {"spt_krs_field", TRACES, 10, 6, 9, 0, 0},
    [KRS_DOOR_MAPPED] = {"spt_moekrs_field", TRACES, 10, 6, 9, 0, 0},
    [KRS_DOOR_CONFORMAL] = {"spt_conformal_field", TRACES, 10, 6, 9, 0, 0},
    [KRS_DOOR_DISTORTED] = {"spt_distorted_field", TRACES, 10, 6, 9, 0, 0},
    [KRS_DOOR_UNMAPPED] = {"map", TRACES, 10, 6, 9, 0, 0},
    [KRS_DOOR_EXITS] = {"spt_conformal_trace", TRACES, 10, 6, 9, 0, 1},
    [KRS_DOOR_PROBES] = {"spt_moekrs_probe", TRACES | KRS_TAKES_BINARY, 10, 6, 9, 0, 1},
    [KRS_DOOR_FIELD_PROBES] = {"spt_probe_of_field", TRACES | KRS_TAKES_BINARY, 10, 6, 9, 0, 1},
    [KRS_DOOR_PLACES] = {"spt_krs_locate", LOCATES, 10, 6, 14, 0, 0},
    [KRS_DOOR_MAPPED_PLACES] = {"spt_moekrs_locate", LOCATES, 10, 6, 14, 0, 0},
    [KRS_DOOR_POINTS] = {"spt_distorted_points", MOVES, 3, 3, 3, 1, 0},
    [KRS_DOOR_UNMAPPED_POINTS] = {"points_of_map", MOVES, 3, 3, 3, 1, 0}};

size_t krs_width(krs_door door, int column) {
    return krs_locates(door) && column == KRS_OUT_MIRRORS ? 8 : 4;
}

/* The structures hold nothing but columns, in the order of the arrays. */
typedef char rays_are_columns[sizeof(spt_rays) == krs_inputs * sizeof(spt_column) ? 1 : -1];
typedef char hits_are_sinks[sizeof(spt_hits) == krs_hit_sinks * sizeof(spt_sink) ? 1 : -1];
typedef char places_are_sinks[sizeof(spt_krs_places) == krs_outputs * sizeof(spt_sink) ? 1 : -1];

#define GIVEN(structure, pointer) ((call->withheld & (structure)) != 0 ? NULL : (pointer))

static spt_status place_trace(const krs_call *call, const spt_rays *rays, const spt_hits *hits) {
    const spt_settings *const settings = GIVEN(KRS_TAKES_SETTINGS, call->settings);
    spt_statistics *const statistics = GIVEN(KRS_TAKES_STATISTICS, call->statistics);
    switch (call->door) {
    case KRS_DOOR_EXITS:
        return spt_conformal_trace(GIVEN(KRS_TAKES_MODEL, call->conformal), settings, call->count,
                                   rays, hits, statistics);
    case KRS_DOOR_PROBES:
    case KRS_DOOR_FIELD_PROBES:
        return spt_binary_trace(GIVEN(KRS_TAKES_MODEL, call->probe),
                                GIVEN(KRS_TAKES_BINARY, call->binary), settings, call->count, rays,
                                hits, statistics);
    default:
        return spt_trace(GIVEN(KRS_TAKES_MODEL, call->field), settings, call->count, rays, hits,
                         statistics);
    }
}

static spt_status place_locate(const krs_call *call, const spt_rays *rays) {
    const spt_settings *const settings = GIVEN(KRS_TAKES_SETTINGS, call->settings);
    spt_hits found;
    spt_krs_places places;
    memcpy(&found, call->found, sizeof found);
    memcpy(&places, call->out, sizeof places);
    if (call->door == KRS_DOOR_PLACES) {
        return spt_krs_locate(GIVEN(KRS_TAKES_MODEL, call->krs), call->component, settings,
                              call->count, rays, GIVEN(KRS_TAKES_HITS, &found),
                              GIVEN(KRS_TAKES_PLACES, &places));
    }
    return spt_moekrs_locate(GIVEN(KRS_TAKES_MODEL, call->moekrs), call->component, settings,
                             call->count, rays, GIVEN(KRS_TAKES_HITS, &found),
                             GIVEN(KRS_TAKES_PLACES, &places));
}

spt_status krs_place_call(const krs_call *call) {
    spt_rays rays;
    spt_hits hits;
    memcpy(&rays, call->in, sizeof rays);
    memcpy(&hits, call->out, sizeof hits);
    if (krs_locates(call->door)) return place_locate(call, GIVEN(KRS_TAKES_RAYS, &rays));
    if (krs_moves(call->door)) {
        spt_vectors points;
        spt_vector_sinks moved;
        memcpy(&points, call->in, sizeof points);
        memcpy(&moved, call->out, sizeof moved);
        return spt_distorted_points(GIVEN(KRS_TAKES_MODEL, call->distorted), call->count,
                                    GIVEN(KRS_TAKES_RAYS, &points),
                                    GIVEN(KRS_TAKES_PLACES, &moved));
    }
    return place_trace(call, GIVEN(KRS_TAKES_RAYS, &rays), GIVEN(KRS_TAKES_HITS, &hits));
}

uint32_t krs_bits(float a) {
    uint32_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

float krs_float(uint32_t bits) {
    float a;
    memcpy(&a, &bits, sizeof a);
    return a;
}
