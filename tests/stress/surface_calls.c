/* SPDX-License-Identifier: MIT
 *
 * The table of the calls of surface.h, and each of them made of the same columns. */
#include "surface_calls.h"

#include <string.h>

size_t surface_width(int column) {
    return column == OUT_CROSSING ? 4 * surface_most_crossings : 4;
}

/* ---- The table ------------------------------------------------------------------------------- */

enum {
    LINES = SURFACE_BITS(IN_ORIGIN, 3) | SURFACE_BITS(IN_DIRECTION, 3),
    RAYS = SURFACE_BITS(IN_ORIGIN, 10),
    HIT_RAYS = LINES | SURFACE_BIT(IN_PATH) | SURFACE_BIT(IN_ACTIVE),
    POINTS = SURFACE_BITS(IN_POINT, 3),
    NORMALS = SURFACE_BITS(IN_NORMAL, 3),
    VECTOR = SURFACE_BITS(OUT_VECTOR, 3),
    PLACES = SURFACE_BIT(OUT_T) | SURFACE_BIT(OUT_RESIDUAL),
    SOLVED = PLACES | SURFACE_BIT(OUT_OUTCOME),
    KINDS = SURFACE_BIT(OUT_OUTCOME) | SURFACE_BIT(OUT_FLAGS) | SURFACE_BIT(OUT_COMPONENT),
    ANSWER = SURFACE_BIT(OUT_ANSWER),
    SOME_FIELDS = TAKES_FIELD | TAKES_FIELDS,
    TRACES = TAKES_FIELD | TAKES_SETTINGS | TAKES_RAYS | TAKES_STATISTICS
};

const surface_facts surface_table[surface_doors] = {
    [DOOR_REFINE] = {"spt_refine", SOME_FIELDS | TAKES_SETTINGS | TAKES_RAYS | TAKES_HITS, RAYS,
                     LINES, PLACES | KINDS | SURFACE_BIT(OUT_EVALUATIONS), SOLVED, KINDS,
                     PLACES | SURFACE_BIT(OUT_EVALUATIONS)},
    [DOOR_NORMALS] = {"spt_normals",
                      SOME_FIELDS | TAKES_SETTINGS | TAKES_RAYS | TAKES_HITS | TAKES_SINKS,
                      HIT_RAYS, LINES,
                      VECTOR | SURFACE_BIT(OUT_T) | SURFACE_BIT(OUT_OUTCOME) |
                          SURFACE_BIT(OUT_COMPONENT),
                      VECTOR | SURFACE_BIT(OUT_T),
                      SURFACE_BIT(OUT_T) | SURFACE_BIT(OUT_OUTCOME) | SURFACE_BIT(OUT_COMPONENT),
                      0},
    [DOOR_OFFSET] = {"spt_offset",
                     SOME_FIELDS | TAKES_SETTINGS | TAKES_RAYS | TAKES_HITS | TAKES_NORMALS |
                         TAKES_SINKS,
                     HIT_RAYS | NORMALS | SURFACE_BIT(IN_CROSS), LINES | NORMALS,
                     VECTOR | PLACES | KINDS | SURFACE_BIT(OUT_NEW_PATH) | SURFACE_BIT(OUT_START),
                     VECTOR | SOLVED, PLACES | KINDS, 0},
    [DOOR_CONVEX] = {"spt_trace_convex", TRACES | TAKES_HITS, RAYS, LINES, SURFACE_BITS(OUT_T, 9),
                     0, 0, 0},
    [DOOR_OCCLUDED] = {"spt_occluded", TRACES | TAKES_SINKS, RAYS, LINES, ANSWER, ANSWER, 0, 0},
    [DOOR_CROSSINGS] = {"spt_crossings_of", TRACES | TAKES_SINKS, RAYS, LINES,
                        SURFACE_BITS(OUT_CROSSING, 5), 0, 0, 0},
    [DOOR_SHADOW] = {"spt_soft_shadow", TRACES | TAKES_TANGENT | TAKES_SINKS,
                     RAYS | SURFACE_BIT(IN_TANGENT), LINES | SURFACE_BIT(IN_TANGENT), ANSWER,
                     ANSWER, 0, 0},
    [DOOR_AMBIENT] = {"spt_ambient_occlusion",
                      SOME_FIELDS | TAKES_POINTS | TAKES_NORMALS | TAKES_SINKS, POINTS | NORMALS,
                      POINTS | NORMALS, ANSWER, ANSWER, 0, 0},
    [DOOR_COLLIDE] = {"spt_collide", SOME_FIELDS | TAKES_SETTINGS | TAKES_POINTS | TAKES_SINKS,
                      POINTS | SURFACE_BITS(IN_TO, 3) | SURFACE_BIT(IN_RADIUS), POINTS,
                      ANSWER | VECTOR | SURFACE_BIT(OUT_PLACE) | SURFACE_BIT(OUT_WHICH), 0, 0, 0}};

/* ---- Columns --------------------------------------------------------------------------------- */

uint32_t surface_read(const spt_column *column, size_t index, uint32_t absent) {
    if (column->first == NULL) return absent;
    memcpy(&absent, (const char *)column->first + (ptrdiff_t)index * column->stride, 4);
    return absent;
}

uint32_t surface_bits(float a) {
    uint32_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

float surface_float(uint32_t bits) {
    float a;
    memcpy(&a, &bits, sizeof a);
    return a;
}

spt_rays surface_rays(const surface_call *call) {
    spt_rays rays;
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis] = call->in[IN_ORIGIN + axis];
        rays.direction[axis] = call->in[IN_DIRECTION + axis];
    }
    rays.t_min = call->in[IN_T_MIN];
    rays.t_max = call->in[IN_T_MAX];
    rays.path = call->in[IN_PATH];
    rays.active = call->in[IN_ACTIVE];
    return rays;
}

spt_hits surface_hits(const surface_call *call) {
    const spt_hits hits = {
        call->out[OUT_T],           call->out[OUT_RESIDUAL],        call->out[OUT_OUTCOME],
        call->out[OUT_EVALUATIONS], call->out[OUT_FLAGS],           call->out[OUT_COMPONENT],
        call->out[OUT_CANDIDATE_T], call->out[OUT_CANDIDATE_RATIO], call->out[OUT_FALLBACKS]};
    return hits;
}

static spt_vectors vectors_of(const surface_call *call, int first) {
    spt_vectors vectors;
    for (int axis = 0; axis < 3; ++axis) vectors.axis[axis] = call->in[first + axis];
    return vectors;
}

static spt_vector_sinks vector_sinks_of(const surface_call *call) {
    spt_vector_sinks sinks;
    for (int axis = 0; axis < 3; ++axis) sinks.axis[axis] = call->out[OUT_VECTOR + axis];
    return sinks;
}

/* ---- Calls ----------------------------------------------------------------------------------- */

static int is_withheld(const surface_call *call, uint32_t structure) {
    return (call->withheld & structure) != 0;
}

#define GIVEN(structure, pointer) (is_withheld(call, structure) ? NULL : (pointer))

static spt_status place_offset(const surface_call *call, const spt_rays *rays,
                               const spt_hits *hits) {
    const spt_vectors normals = vectors_of(call, IN_NORMAL);
    spt_starts starts;
    starts.origin = vector_sinks_of(call);
    starts.path = call->out[OUT_NEW_PATH];
    starts.start = call->out[OUT_START];
    return spt_offset(GIVEN(TAKES_FIELD, call->fields), call->field_count,
                      GIVEN(TAKES_SETTINGS, call->settings), call->count, rays, hits,
                      GIVEN(TAKES_NORMALS, &normals), &call->in[IN_CROSS], call->checks,
                      GIVEN(TAKES_SINKS, &starts));
}

static spt_status place_crossings(const surface_call *call, const spt_rays *rays) {
    spt_crossings crossings;
    crossings.t = call->out[OUT_CROSSING];
    crossings.t_step = call->crossing_step;
    crossings.most = call->most_crossings;
    crossings.number = call->out[OUT_NUMBER];
    crossings.inside = call->out[OUT_INSIDE];
    crossings.thickness = call->out[OUT_THICKNESS];
    crossings.outcome = call->out[OUT_ENDED];
    return spt_crossings_of(GIVEN(TAKES_FIELD, call->fields), GIVEN(TAKES_SETTINGS, call->settings),
                            call->count, rays, GIVEN(TAKES_SINKS, &crossings),
                            GIVEN(TAKES_STATISTICS, call->statistics));
}

static spt_status place_ambient(const surface_call *call) {
    const spt_vectors points = vectors_of(call, IN_POINT), normals = vectors_of(call, IN_NORMAL);
    return spt_ambient_occlusion(GIVEN(TAKES_FIELD, call->fields), call->field_count, call->samples,
                                 call->distance, call->count, GIVEN(TAKES_POINTS, &points),
                                 GIVEN(TAKES_NORMALS, &normals),
                                 GIVEN(TAKES_SINKS, &call->out[OUT_ANSWER]));
}

static spt_status place_collide(const surface_call *call) {
    spt_bodies bodies;
    spt_contacts contacts;
    bodies.from = vectors_of(call, IN_POINT);
    bodies.to = vectors_of(call, IN_TO);
    bodies.radius = call->in[IN_RADIUS];
    contacts.distance = call->out[OUT_ANSWER];
    contacts.normal = vector_sinks_of(call);
    contacts.place = call->out[OUT_PLACE];
    contacts.component = call->out[OUT_WHICH];
    return spt_collide(GIVEN(TAKES_FIELD, call->fields), call->field_count,
                       GIVEN(TAKES_SETTINGS, call->settings), call->count,
                       GIVEN(TAKES_POINTS, &bodies), GIVEN(TAKES_SINKS, &contacts));
}

spt_status surface_place(const surface_call *call) {
    const spt_rays rays_of_call = surface_rays(call);
    const spt_hits hits_of_call = surface_hits(call);
    const spt_vector_sinks vectors = vector_sinks_of(call);
    const spt_field *const fields = GIVEN(TAKES_FIELD, call->fields);
    const spt_settings *const settings = GIVEN(TAKES_SETTINGS, call->settings);
    const spt_rays *const rays = GIVEN(TAKES_RAYS, &rays_of_call);
    const spt_hits *const hits = GIVEN(TAKES_HITS, &hits_of_call);
    const spt_sink *const answer = GIVEN(TAKES_SINKS, &call->out[OUT_ANSWER]);
    spt_statistics *const statistics = GIVEN(TAKES_STATISTICS, call->statistics);
    switch (call->door) {
    case DOOR_REFINE:
        return spt_refine(fields, call->field_count, settings, call->iterations, call->count, rays,
                          hits);
    case DOOR_NORMALS:
        return spt_normals(fields, call->field_count, settings, call->rule, call->detail,
                           call->count, rays, hits, GIVEN(TAKES_SINKS, &vectors));
    case DOOR_OFFSET:
        return place_offset(call, rays, hits);
    case DOOR_CONVEX:
        return spt_trace_convex(fields, settings, call->count, rays, hits, statistics);
    case DOOR_OCCLUDED:
        return spt_occluded(fields, settings, call->count, rays, answer, statistics);
    case DOOR_CROSSINGS:
        return place_crossings(call, rays);
    case DOOR_SHADOW:
        return spt_soft_shadow(fields, settings, GIVEN(TAKES_TANGENT, &call->in[IN_TANGENT]),
                               call->smooth, call->count, rays, answer, statistics);
    case DOOR_AMBIENT:
        return place_ambient(call);
    default:
        return place_collide(call);
    }
}
