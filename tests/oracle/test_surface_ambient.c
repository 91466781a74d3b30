/* SPDX-License-Identifier: MIT
 *
 * Ambient occlusion (spt_ambient_occlusion) against its formula in double with exact distances, and
 * where the answer is known without it. */
#include "surface_oracle.h"
#include "../check.h"

#include <spheretrace/surface.h>

#include <math.h>
#include <string.h>

/* Evans 2006: 1 - sum 2^-i (i D - clamp(f(p + i D n), 0, i D)) / sum 2^-i i D. */
static double exact_openness(const surface_group *group, uint32_t samples, double distance,
                             const float point[3], const float normal[3]) {
    double missing = 0, whole = 0, weight = 1;
    for (uint32_t i = 1; i <= samples; ++i) {
        const double reach = i * distance;
        double p[3];
        weight /= 2;
        for (int axis = 0; axis < 3; ++axis) {
            p[axis] = (double)point[axis] + reach * (double)normal[axis];
        }
        missing += weight * (reach - fmin(fmax(surface_group_distance(group, p, NULL), 0), reach));
        whole += weight * reach;
    }
    return 1 - missing / whole;
}

/* Each value may be off by the rounding of its position, at most 2^-21 (|p| + N D) as in
 * surface_rounding(); the weights over their sum with i D make at most 1 / D of it. The sums of up
 * to 16 terms in [0, 1] round by 2^-20. */
static double openness_rounding(uint32_t samples, double distance, const float point[3]) {
    const double p[3] = {(double)point[0], (double)point[1], (double)point[2]};
    return 0x1p-21 * (surface_length(p) + samples * distance) / distance + 0x1p-20;
}

enum { most_fields = 3 };

typedef struct surroundings {
    surface_body bodies[most_fields];
    surface_group group;
    reference_field references[most_fields];
    spt_field fields[most_fields];
} surroundings;

static void surround(const surface_run *run, surroundings *all, size_t count) {
    all->group.bodies = all->bodies;
    all->group.count = count;
    for (size_t i = 0; i < count; ++i) {
        all->references[i] = surface_body_field(&all->bodies[i]);
        all->fields[i] = surface_field(run, &all->references[i], 0);
    }
}

static float openness(const surroundings *all, uint32_t samples, float distance,
                      const float point[3], const float normal[3]) {
    const spt_vectors points = spt_vectors_of(point), normals = spt_vectors_of(normal);
    float found = -1;
    spt_sink sink = {NULL, sizeof found};
    sink.first = &found;
    CHECK(spt_ambient_occlusion(all->fields, all->group.count, samples, distance, 1, &points,
                                &normals, &sink) == SPT_OK);
    return found;
}

/* On the surfaces of random bodies and beside them, along normals and elsewhere. */
static void ambient_of_bodies(void) {
    static const analytic_kind kinds[] = {ANALYTIC_SPHERE, ANALYTIC_BOX, ANALYTIC_TORUS,
                                          ANALYTIC_CAPSULE, ANALYTIC_PLANE};
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        for (int draw = 0; draw < 120; ++draw) {
            static surroundings all;
            const size_t count = 1 + check_random() % most_fields;
            const uint32_t samples = 1 + check_random() % 16;
            const float distance = (float)pow(10, check_uniform(-2, 0));
            float point[3], normal[3], found;
            double n[3], expected;
            for (size_t i = 0; i < count; ++i) {
                all.bodies[i] = surface_place_at(
                    analytic_sample(kinds[check_random() % 5], check_uniform(0.5, 2)),
                    check_uniform(-1, 1), check_uniform(-1, 1), check_uniform(-1, 1));
                surface_turn(&all.bodies[i]);
                all.bodies[i].factor = pow(2, check_uniform(-5, 5));
                if (check_random() % 4 == 0) all.bodies[i].factor *= -1;
            }
            surround(&run, &all, count);
            surface_random_unit(n);
            for (int axis = 0; axis < 3; ++axis) {
                point[axis] = (float)check_uniform(-2, 2);
                normal[axis] = (float)n[axis];
            }
            expected = exact_openness(&all.group, samples, (double)distance, point, normal);
            found = openness(&all, samples, distance, point, normal);
            CHECK_SAY(found >= 0 && found <= 1, "%.9g", (double)found);
            CHECK_SAY(fabs((double)found - expected) <=
                          openness_rounding(samples, (double)distance, point),
                      "%u samples, %zu fields: %.9g for %.9g", samples, count, (double)found,
                      expected);
        }
    }
}

/* Over a plane and over a ball all is open; in a gap that is closed nothing; in a corner one wall at
 * distance a stands before the samples beyond it: with 5 of them, D = 1, a = 2.5 hides 1/2, 3/2 and
 * 5/2 of those at 3, 4 and 5, whose weights over the whole (57/32) are 4/57, 2/57 and 1/57. */
static void ambient_known(void) {
    const float up[3] = {0, 1, 0}, on_plane[3] = {0.3f, 0, 0.4f}, on_ball[3] = {0, 1, 0},
                in_corner[3] = {2.5f, 0, 7};
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        static surroundings all;
        for (uint32_t samples = 1; samples <= 16; ++samples) {
            all.bodies[0] = surface_plane(0);
            surround(&run, &all, 1);
            CHECK_SAY(fabs((double)openness(&all, samples, 0.1f, on_plane, up) - 1) <= 0x1p-20,
                      "plane, %u samples", samples);
            all.bodies[0] = surface_sphere(0, 0, 0, 1);
            surround(&run, &all, 1);
            CHECK_SAY(fabs((double)openness(&all, samples, 0.25f, on_ball, up) - 1) <= 0x1p-20,
                      "ball, %u samples", samples);
            all.bodies[0] = surface_plane(0);
            all.bodies[1] = surface_plane(0);
            all.bodies[1].factor = -2; /* solid above, too */
            surround(&run, &all, 2);
            CHECK_SAY(fabs((double)openness(&all, samples, 0.1f, on_plane, up)) <= 0x1p-20,
                      "gap, %u samples", samples);
        }
        all.bodies[0] = surface_plane(0);
        all.bodies[1] = surface_plane(0);
        all.bodies[1].axis[0][0] = all.bodies[1].axis[1][1] = 0;
        all.bodies[1].axis[0][1] = -1; /* the wall x = 0 */
        all.bodies[1].axis[1][0] = 1;
        all.bodies[1].factor = 3;
        surround(&run, &all, 2);
        CHECK_SAY(fabs((double)openness(&all, 5, 1, in_corner, up) -
                       (1 - (0.5 * 4 + 1.5 * 2 + 2.5) / 57)) <= 0x1p-20,
                  "corner: %.9g", (double)openness(&all, 5, 1, in_corner, up));
        for (int i = 0; i < 3; ++i) { /* a field that exaggerates by its constant darkens */
            all.bodies[0] = surface_plane(0);
            surround(&run, &all, 1);
            all.fields[0].lipschitz = ldexpf(1, i);
            CHECK_SAY(fabs((double)openness(&all, 5, 1, on_plane, up) - ldexp(1, -i)) <= 0x1p-20,
                      "lipschitz %g: %.9g", ldexp(1, i),
                      (double)openness(&all, 5, 1, on_plane, up));
        }
    }
}

static float constant_value(void *user, float x, float y, float z) {
    (void)x;
    (void)y;
    (void)z;
    return *(const float *)user;
}

static void ambient_not_finite(void) {
    const float bad[] = {NAN, INFINITY, -INFINITY};
    const float point[3] = {0, 0.5f, 0}, up[3] = {0, 1, 0};
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        static surroundings all;
        float value = INFINITY;
        all.bodies[0] = surface_plane(0);
        surround(&run, &all, 1);
        for (int i = 0; i < 18; ++i) {
            float p[3], n[3];
            memcpy(p, point, sizeof p);
            memcpy(n, up, sizeof n);
            (i < 9 ? p : n)[i % 3] = bad[i / 3 % 3];
            CHECK_SAY(check_same_bits(openness(&all, 5, 0.1f, p, n), 0), "case %d", i);
        }
        all.fields[0] = spt_field_default();
        all.fields[0].point = constant_value;
        all.fields[0].user = &value;
        CHECK(check_same_bits(openness(&all, 5, 0.1f, point, up), 1)); /* nothing anywhere */
        value = -INFINITY;
        CHECK(check_same_bits(openness(&all, 5, 0.1f, point, up), 0));
        value = NAN;
        CHECK(openness(&all, 5, 0.1f, point, up) >= 0);
        CHECK(openness(&all, 5, 0.1f, point, up) <= 1);
    }
}

static void ambient_refuses(void) {
    const float point[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    const float bad[] = {0, -1, NAN, INFINITY};
    const spt_vectors points = spt_vectors_of(point), normals = spt_vectors_of(up);
    static surroundings all;
    surface_run run = surface_runs(0);
    float found = 0.75f;
    spt_sink sink = {NULL, sizeof found};
    CHECK(surface_next(&run));
    all.bodies[0] = surface_plane(0);
    surround(&run, &all, 1);
#define REFUSED(...) CHECK(spt_ambient_occlusion(__VA_ARGS__) == SPT_BAD_ARGUMENT)
    REFUSED(all.fields, 1, 5, 0.1f, 1, &points, &normals, &sink);
    sink.first = &found;
    REFUSED(all.fields, 0, 5, 0.1f, 1, &points, &normals, &sink);
    REFUSED(NULL, 1, 5, 0.1f, 1, &points, &normals, &sink);
    REFUSED(all.fields, 1, 0, 0.1f, 1, &points, &normals, &sink);
    REFUSED(all.fields, 1, 17, 0.1f, 1, &points, &normals, &sink);
    for (int i = 0; i < 4; ++i) REFUSED(all.fields, 1, 5, bad[i], 1, &points, &normals, &sink);
    REFUSED(all.fields, 1, 5, 0.1f, 1, NULL, &normals, &sink);
    REFUSED(all.fields, 1, 5, 0.1f, 1, &points, NULL, &sink);
    REFUSED(all.fields, 1, 5, 0.1f, 1, &points, &normals, NULL);
#undef REFUSED
    CHECK(check_same_bits(found, 0.75f));
}

void suite_surface_ambient(void) {
    RUN(ambient_of_bodies);
    RUN(ambient_known);
    RUN(ambient_not_finite);
    RUN(ambient_refuses);
}
