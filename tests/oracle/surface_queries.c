/* SPDX-License-Identifier: MIT
 *
 * Every query of surface.h behind one signature: see surface_queries.h. */
#include "surface_queries.h"

#include <string.h>

spt_column query_column(const query_table *at, size_t offset) {
    spt_column view = {NULL, 0};
    view.first = at->first + offset;
    view.stride = at->stride;
    return view;
}

spt_sink query_sink(const query_table *at, size_t offset) {
    spt_sink view = {NULL, 0};
    view.first = at->first + offset;
    view.stride = at->stride;
    return view;
}

static spt_vectors vectors(const query_table *at, size_t offset) {
    spt_vectors view;
    for (size_t axis = 0; axis < 3; ++axis) {
        view.axis[axis] = query_column(at, offset + axis * sizeof(float));
    }
    return view;
}

static spt_vector_sinks vector_sinks(const query_table *at, size_t offset) {
    spt_vector_sinks view;
    for (size_t axis = 0; axis < 3; ++axis) {
        view.axis[axis] = query_sink(at, offset + axis * sizeof(float));
    }
    return view;
}

spt_rays query_rays(const query_table *at) {
    const spt_vectors origin = vectors(at, offsetof(query_row, ray) + offsetof(spt_ray, origin)),
                      direction =
                          vectors(at, offsetof(query_row, ray) + offsetof(spt_ray, direction));
    spt_rays view;
    for (int axis = 0; axis < 3; ++axis) {
        view.origin[axis] = origin.axis[axis];
        view.direction[axis] = direction.axis[axis];
    }
    view.t_min = query_column(at, offsetof(query_row, ray) + offsetof(spt_ray, t_min));
    view.t_max = query_column(at, offsetof(query_row, ray) + offsetof(spt_ray, t_max));
    view.path = query_column(at, offsetof(query_row, path));
    view.active = query_column(at, offsetof(query_row, active));
    return view;
}

static spt_hits hit_sinks(const query_table *at) {
    const size_t hit = offsetof(query_row, hit);
    spt_hits view;
    view.t = query_sink(at, hit + offsetof(spt_hit, t));
    view.residual = query_sink(at, hit + offsetof(spt_hit, residual));
    view.outcome = query_sink(at, hit + offsetof(spt_hit, outcome));
    view.evaluations = query_sink(at, hit + offsetof(spt_hit, evaluations));
    view.flags = query_sink(at, hit + offsetof(spt_hit, flags));
    view.component = query_sink(at, hit + offsetof(spt_hit, component));
    view.candidate_t = query_sink(at, hit + offsetof(spt_hit, candidate_t));
    view.candidate_ratio = query_sink(at, hit + offsetof(spt_hit, candidate_ratio));
    view.fallbacks = query_sink(at, hit + offsetof(spt_hit, fallbacks));
    return view;
}

/* ---- The queries --------------------------------------------------------------------------- */

static spt_status trace_flagged(const query_views *of, const query_table *at, uint32_t flags) {
    const spt_rays rays = query_rays(at);
    const spt_hits hits = hit_sinks(at);
    spt_settings settings = of->settings;
    settings.flags = flags;
    return spt_trace(&of->all, &settings, at->count, &rays, &hits, NULL);
}

static spt_status trace_closest(const query_views *of, const query_table *at) {
    return trace_flagged(of, at, SPT_CANDIDATE_CLOSEST);
}

static spt_status trace_penumbra(const query_views *of, const query_table *at) {
    return trace_flagged(of, at, SPT_CANDIDATE_PENUMBRA | SPT_STOP_INSIDE);
}

static spt_status trace_level_set(const query_views *of, const query_table *at) {
    static const float eye[3] = {0, 0, 0};
    const spt_rays rays = query_rays(at);
    const spt_hits hits = hit_sinks(at);
    spt_settings settings = of->settings;
    spt_level_set memory;
    spt_field field;
    const spt_status status =
        spt_level_set_field(&of->all, eye, 0, 0.7f, &settings, &memory, &field);
    if (status != SPT_OK) return status;
    return spt_trace(&field, &settings, at->count, &rays, &hits, NULL);
}

static spt_status refine(const query_views *of, const query_table *at) {
    const spt_rays rays = query_rays(at);
    const spt_hits hits = hit_sinks(at);
    return spt_refine(of->each, query_fields, &of->settings, 4, at->count, &rays, &hits);
}

static spt_status normals_by(const query_views *of, const query_table *at, spt_normal_rule rule) {
    const spt_rays rays = query_rays(at);
    const spt_hits hits = hit_sinks(at);
    const spt_vector_sinks normals = vector_sinks(at, offsetof(query_row, vector));
    return spt_normals(of->each, query_fields, &of->settings, rule, 0, at->count, &rays, &hits,
                       &normals);
}

static spt_status normals_tetrahedron(const query_views *of, const query_table *at) {
    return normals_by(of, at, SPT_NORMAL_TETRAHEDRON);
}

static spt_status normals_central(const query_views *of, const query_table *at) {
    return normals_by(of, at, SPT_NORMAL_CENTRAL);
}

static spt_status occluded(const query_views *of, const query_table *at) {
    const spt_rays rays = query_rays(at);
    const spt_sink answers = query_sink(at, offsetof(query_row, other));
    return spt_occluded(&of->all, &of->settings, at->count, &rays, &answers, NULL);
}

static spt_status soft_shadow(const query_views *of, const query_table *at) {
    const spt_rays rays = query_rays(at);
    const spt_column tangents = query_column(at, offsetof(query_row, tangent));
    const spt_sink visibility = query_sink(at, offsetof(query_row, value));
    return spt_soft_shadow(&of->all, &of->settings, &tangents, 1, at->count, &rays, &visibility,
                           NULL);
}

static spt_status crossings(const query_views *of, const query_table *at) {
    const spt_rays rays = query_rays(at);
    spt_crossings found;
    found.t = query_sink(at, offsetof(query_row, more));
    found.t_step = sizeof(float);
    found.most = query_room;
    found.number = query_sink(at, offsetof(query_row, count));
    found.inside = query_sink(at, offsetof(query_row, number));
    found.thickness = query_sink(at, offsetof(query_row, value));
    found.outcome = query_sink(at, offsetof(query_row, other));
    return spt_crossings_of(&of->all, &of->settings, at->count, &rays, &found, NULL);
}

static spt_status ambient(const query_views *of, const query_table *at) {
    const spt_vectors points = vectors(at, offsetof(query_row, point)),
                      normals = vectors(at, offsetof(query_row, normal));
    const spt_sink openness = query_sink(at, offsetof(query_row, value));
    return spt_ambient_occlusion(of->each, query_fields, 5, 0.3f, at->count, &points, &normals,
                                 &openness);
}

static spt_status collide_as(const query_views *of, const query_table *at, int balls) {
    spt_bodies bodies;
    spt_contacts contacts;
    memset(&bodies, 0, sizeof bodies);
    bodies.from = vectors(at, offsetof(query_row, from));
    if (!balls) bodies.to = vectors(at, offsetof(query_row, to));
    bodies.radius = query_column(at, offsetof(query_row, radius));
    contacts.distance = query_sink(at, offsetof(query_row, value));
    contacts.normal = vector_sinks(at, offsetof(query_row, vector));
    contacts.place = query_sink(at, offsetof(query_row, more));
    contacts.component = query_sink(at, offsetof(query_row, other));
    return spt_collide(of->each, query_fields, &of->settings, at->count, &bodies, &contacts);
}

static spt_status collide_balls(const query_views *of, const query_table *at) {
    return collide_as(of, at, 1);
}

static spt_status collide_capsules(const query_views *of, const query_table *at) {
    return collide_as(of, at, 0);
}

const query_entry queries[query_count] = {{"closest", trace_closest, 1},
                                          {"penumbra", trace_penumbra, 1},
                                          {"level set", trace_level_set, 1},
                                          {"refine", refine, 1},
                                          {"normals, tetrahedron", normals_tetrahedron, 1},
                                          {"normals, central", normals_central, 1},
                                          {"occluded", occluded, 1},
                                          {"soft shadow", soft_shadow, 1},
                                          {"crossings", crossings, 1},
                                          {"ambient occlusion", ambient, 0},
                                          {"balls", collide_balls, 1},
                                          {"capsules", collide_capsules, 1}};
