/* SPDX-License-Identifier: MIT
 *
 * Equal bits: every query of surface.h gives each ray, point and body the same results at every
 * width, with both forms of callback, alone and among others, in any order and from columns of any
 * stride. What the results should be is tested elsewhere. */
#include "surface_queries.h"
#include "../check.h"

#include <math.h>
#include <string.h>

enum { rows = 300 };

typedef struct world_fields {
    surface_body bodies[query_fields];
    surface_group group;
    reference_field references[query_fields], all;
} world_fields;

/* ---- Rows and worlds ------------------------------------------------------------------------ */

static world_fields shown;
static query_row given[rows], expected[rows], found[rows];

static void draw_world(void) {
    static const analytic_kind kinds[query_fields] = {ANALYTIC_SPHERE, ANALYTIC_TORUS,
                                                      ANALYTIC_BOX};
    for (int i = 0; i < query_fields; ++i) {
        surface_body *one = &shown.bodies[i];
        *one = surface_place_at(analytic_sample(kinds[i], 1.5), 2 * i - 2, 0.3 * i, 5);
        surface_turn(one);
        if (i > 0) one->factor = 0.5 * i;
        shown.references[i] = surface_body_field(one);
    }
    shown.group.bodies = shown.bodies;
    shown.group.count = query_fields;
    shown.all = surface_group_field(&shown.group);
}

static query_views view_world(const surface_run *run) {
    query_views all;
    for (int i = 0; i < query_fields; ++i) {
        all.each[i] = surface_field(run, &shown.references[i], 0);
    }
    all.all = surface_field(run, &shown.all, 0);
    all.settings = spt_settings_default();
    all.settings.max_lanes = run->lanes;
    all.settings.pixel_radius = 2e-3f;
    all.settings.budget = 50;
    return all;
}

static void draw_rows(void) {
    memset(given, 0, sizeof given);
    for (int i = 0; i < rows; ++i) {
        query_row *one = &given[i];
        const double away = i % 3 == 0 ? 6 : 0;
        double eye[3] = {0, 0, 0}, target[3], n[3];
        float *const triples[] = {one->point, one->from, one->to};
        surface_random_unit(n);
        for (int axis = 0; axis < 3; ++axis) {
            eye[axis] += away * n[axis];
            target[axis] = check_uniform(-3, 3) + (axis == 2 ? 5 : 0);
            one->normal[axis] = (float)n[axis];
            for (int k = 0; k < 3; ++k) {
                triples[k][axis] = (float)(check_uniform(-3, 3) + (axis == 2 ? 5 : 0));
            }
        }
        one->ray = surface_aim(eye, target, i % 5 == 0 ? pow(2, check_uniform(-8, 8)) : 1, 40);
        one->path = (float)check_uniform(0, 3);
        one->tangent = (float)check_uniform(0.01, 1);
        one->radius = (float)check_uniform(0, 1);
        one->active = i % 11 == 0 ? 0 : -1;
        one->hit.t = (float)check_uniform(3, 7);
        one->hit.residual = (float)check_uniform(-0.1, 0.1);
        one->hit.outcome = i % 7 == 0 ? SPT_LIMIT : SPT_HIT;
        one->hit.flags = i % 13 == 0 ? SPT_FLAG_STEEP : i % 4 == 0 ? SPT_FLAG_INSIDE : 0;
        one->hit.component = i % query_fields;
        if (i % 29 == 5) one->ray.origin[i % 3] = NAN;
        if (i % 31 == 6) one->ray.t_max = -1;
        if (i % 23 == 7) one->point[i % 3] = INFINITY;
        if (i % 23 == 8) one->to[i % 3] = NAN;
        if (i % 17 == 9) one->tangent = -1;
    }
}

/* ---- The comparisons ------------------------------------------------------------------------ */

static size_t order[rows];

static void shuffle(void) {
    for (size_t i = 0; i < rows; ++i) order[i] = i;
    for (size_t i = rows - 1; i > 0; --i) {
        const size_t other = check_random() % (i + 1), kept = order[i];
        order[i] = order[other];
        order[other] = kept;
    }
}

/* The first count of the rows in their order, in one of four layouts; found receives them. */
static spt_status run_rows(query_call *call, const query_views *of, int layout, size_t count) {
    static char memory[2 * rows * sizeof(query_row) + 1];
    query_table at = {NULL, (ptrdiff_t)sizeof(query_row), 0};
    spt_status status;
    at.count = count;
    at.first = memory;
    if (layout == 1) ++at.first; /* aligned to nothing */
    if (layout == 2) at.stride *= 2;
    if (layout == 3) {
        at.first += (count - 1) * sizeof(query_row);
        at.stride = -at.stride;
    }
    for (size_t i = 0; i < count; ++i) {
        memcpy(at.first + (ptrdiff_t)i * at.stride, &given[order[i]], sizeof(query_row));
    }
    status = call(of, &at);
    for (size_t i = 0; i < count; ++i) {
        memcpy(&found[order[i]], at.first + (ptrdiff_t)i * at.stride, sizeof(query_row));
    }
    return status;
}

/* Each query_row by itself, one lane wide. */
static void expect(query_call *call) {
    surface_run run = surface_runs(0);
    query_views of;
    CHECK(surface_next(&run));
    of = view_world(&run);
    for (size_t i = 0; i < rows; ++i) {
        order[0] = i;
        CHECK(run_rows(call, &of, 0, 1) == SPT_OK);
    }
    memcpy(expected, found, sizeof expected);
    CHECK(memcmp(expected, given, sizeof expected) != 0);
}

static void same_bits_everywhere(void) {
    draw_world();
    draw_rows();
    for (int k = 0; k < query_count; ++k) {
        check_context("%s", queries[k].name);
        expect(queries[k].call);
        for (surface_run run = surface_runs(0); surface_next(&run);) {
            const query_views of = view_world(&run);
            for (int layout = 0; layout < 4; ++layout) {
                const size_t count = layout == 2 ? 1 + check_random() % rows : rows;
                size_t differing = 0;
                shuffle();
                memset(found, 0x5a, sizeof found);
                CHECK(run_rows(queries[k].call, &of, layout, count) == SPT_OK);
                for (size_t i = 0; i < count; ++i) {
                    differing +=
                        memcmp(&found[order[i]], &expected[order[i]], sizeof(query_row)) != 0;
                }
                CHECK_SAY(differing == 0, "%s, layout %d: %zu of %zu", queries[k].name, layout,
                          differing, count);
            }
        }
    }
}

/* One value for all: stride 0 reads as the same value in every query_row. */
static void one_value_for_all(void) {
    draw_world();
    draw_rows();
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        const query_views of = view_world(&run);
        query_table at = {NULL, (ptrdiff_t)sizeof(query_row), rows};
        spt_rays rays;
        spt_column tangents;
        spt_sink visibility;
        for (int shared = 0; shared < 2; ++shared) {
            query_row *all = shared ? found : expected;
            memcpy(all, given, sizeof given);
            if (!shared) {
                for (int i = 0; i < rows; ++i) {
                    all[i].tangent = given[3].tangent;
                    memcpy(all[i].ray.origin, given[3].ray.origin, sizeof all[i].ray.origin);
                }
            }
            at.first = (char *)all;
            rays = query_rays(&at);
            tangents = query_column(&at, offsetof(query_row, tangent));
            visibility = query_sink(&at, offsetof(query_row, value));
            if (shared) {
                for (int axis = 0; axis < 3; ++axis) {
                    rays.origin[axis].first = &given[3].ray.origin[axis];
                    rays.origin[axis].stride = 0;
                }
                tangents.first = &given[3].tangent;
                tangents.stride = 0;
            }
            CHECK(spt_soft_shadow(&of.all, &of.settings, &tangents, 0, rows, &rays, &visibility,
                                  NULL) == SPT_OK);
        }
        for (int i = 0; i < rows; ++i) {
            CHECK_SAY(check_same_bits(found[i].value, expected[i].value), "query_row %d", i);
        }
    }
}

/* No rays: nothing is looked at, but a bad field is refused all the same. */
static void nothing_to_do(void) {
    surface_run run = surface_runs(0);
    query_views of;
    const query_table none = {(char *)given, (ptrdiff_t)sizeof(query_row), 0};
    draw_world();
    draw_rows();
    memcpy(expected, given, sizeof given);
    CHECK(surface_next(&run));
    of = view_world(&run);
    for (int k = 0; k < query_count; ++k) {
        check_context("%s", queries[k].name);
        CHECK(queries[k].call(&of, &none) == SPT_OK);
    }
    of.settings.max_lanes = 3;
    for (int k = 0; k < query_count; ++k) {
        check_context("%s", queries[k].name);
        if (!queries[k].settings) continue;
        CHECK(queries[k].call(&of, &none) == SPT_BAD_ARGUMENT);
    }
    CHECK(memcmp(expected, given, sizeof given) == 0);
}

void suite_surface_parity(void) {
    RUN(same_bits_everywhere);
    RUN(one_value_for_all);
    RUN(nothing_to_do);
}
