/* SPDX-License-Identifier: MIT
 *
 * Row Q20 for every kind of bounding volume: intervals of rays against the same in double, never
 * narrower than the true one and no wider than bound.h says; and rows F1, F2 and F4: rays in faces,
 * bad volumes, and where a ray touches. */
#include "bounds_volume.h"
#include "../check.h"

#include <math.h>
#include <spheretrace/trace.h>
#include <string.h>

static const spt_bound_kind kinds[] = {
    SPT_BOUND_SPHERE,   SPT_BOUND_BOX,       SPT_BOUND_ORIENTED_BOX, SPT_BOUND_CAPSULE,
    SPT_BOUND_CYLINDER, SPT_BOUND_ELLIPSOID, SPT_BOUND_SLAB,         SPT_BOUND_POLYTOPE};
enum { kind_count = sizeof kinds / sizeof kinds[0], volumes = 400, rays = 5 };

static const float axes_of_world[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

static volume_interval asked(const spt_bound *bound, const float o[3], const float d[3]) {
    float entry = NAN, exit = NAN;
    const spt_status status = spt_bound_interval(bound, o, d, 0, (float)INFINITY, &entry, &exit);
    const volume_interval answer = {(double)entry, (double)exit};
    CHECK_SAY(status == SPT_OK, "%s", spt_status_name(status));
    return answer;
}

/* ---- Q20 ------------------------------------------------------------------------------------ */

static void Q20_kinds_never_narrower_nor_too_wide(void) {
    static volume self;
    for (int k = 0; k < kind_count; ++k) {
        int met = 0, open = 0;
        check_context("kind %d", (int)kinds[k]);
        for (int i = 0; i < volumes * rays; ++i) {
            float o[3], d[3];
            if (i % rays == 0) volume_draw(&self, kinds[k], volume_magnitude(8));
            volume_ray(&self, o, d);
            const volume_interval truth = volume_truth(&self.bound, o, d);
            const volume_interval widest = volume_widest(&self.bound, o, d);
            const volume_interval answer = asked(&self.bound, o, d);
            met += truth.entry <= truth.exit;
            open += truth.entry <= truth.exit && truth.entry > 0;
            CHECK_SAY(truth.entry > truth.exit ||
                          (answer.entry <= truth.entry && truth.exit <= answer.exit),
                      "ray %d: [%.9g, %.9g] is narrower than [%.12g, %.12g]", i, answer.entry,
                      answer.exit, truth.entry, truth.exit);
            CHECK_SAY(answer.entry > answer.exit ||
                          (answer.entry >= widest.entry && answer.exit <= widest.exit),
                      "ray %d: [%.9g, %.9g] is wider than [%.12g, %.12g]", i, answer.entry,
                      answer.exit, widest.entry, widest.exit);
        }
        CHECK_SAY(met > volumes * rays / 4 && open > volumes * rays / 8, "%d met, %d from outside",
                  met, open);
    }
}

/* From a million away the same volumes are met where they are: the margins that bound.h names, and
 * no more, are what a coordinate of a million costs. */
static void Q20_kinds_from_far(void) {
    static volume self;
    for (int k = 0; k < kind_count; ++k) {
        int met = 0;
        check_context("kind %d", (int)kinds[k]);
        for (int i = 0; i < volumes; ++i) {
            float o[3], d[3];
            double square = 0;
            volume_draw(&self, kinds[k], 1);
            for (int axis = 0; axis < 3; ++axis) {
                d[axis] = (float)check_uniform(-1, 1);
                square += (double)d[axis] * (double)d[axis];
            }
            for (int axis = 0; axis < 3; ++axis) {
                o[axis] = (float)(self.middle[axis] - (double)d[axis] * (1e6 / sqrt(square)));
            }
            const volume_interval truth = volume_truth(&self.bound, o, d);
            const volume_interval widest = volume_widest(&self.bound, o, d);
            const volume_interval answer = asked(&self.bound, o, d);
            CHECK_SAY(truth.entry > truth.exit ||
                          (answer.entry <= truth.entry && truth.exit <= answer.exit),
                      "volume %d: [%.9g, %.9g] is narrower than [%.12g, %.12g]", i, answer.entry,
                      answer.exit, truth.entry, truth.exit);
            CHECK(answer.entry > answer.exit ||
                  (answer.entry >= widest.entry && answer.exit <= widest.exit));
            met += answer.entry <= answer.exit;
        }
        CHECK_SAY(met > volumes / 2, "%d met", met);
    }
}

/* ---- F1, F2, F4 ----------------------------------------------------------------------------- */

static spt_bound_plane cube_planes[6];

/* The cube from -1 to 1 as a volume of four sorts; as a slab only a pair of its faces. */
enum { CUBE_BOX, CUBE_ORIENTED, CUBE_POLYTOPE, CUBE_SLAB };

static spt_bound cube(int sort, int axis) {
    static const float middle[3] = {0, 0, 0}, half[3] = {1, 1, 1};
    float turned[3][3], normal[3] = {0, 0, 0};
    for (int i = 0; i < 6; ++i) {
        memset(&cube_planes[i], 0, sizeof cube_planes[i]);
        cube_planes[i].normal[i / 2] = i % 2 == 0 ? 3.0f : -0.25f;
        cube_planes[i].offset = i % 2 == 0 ? 3.0f : 0.25f;
    }
    memcpy(turned, axes_of_world, sizeof turned);
    normal[axis] = 1;
    if (sort == CUBE_ORIENTED) return spt_bound_oriented_box(middle, turned, half);
    if (sort == CUBE_POLYTOPE) return spt_bound_polytope(cube_planes, 6);
    if (sort == CUBE_SLAB) return spt_bound_slab(normal, -1, 1);
    return spt_bound_box(-1, -1, -1, 1, 1, 1);
}

static void F1_rays_in_faces_of_every_kind(void) {
    for (int sort = CUBE_BOX; sort <= CUBE_SLAB; ++sort) {
        for (int i = 0; i < 24; ++i) {
            const int axis = i % 3, along = (axis + 1) % 3, outside = i >= 12;
            const float side = i / 3 % 2 == 0 ? 1.0f : -1.0f, zero = i / 6 % 2 == 0 ? 0.0f : -0.0f;
            /* Of a slab the faces are those that the ray lies in, or those that it runs towards. */
            const int towards = sort == CUBE_SLAB && i % 2 == 0;
            const spt_bound bound = cube(sort, towards ? along : axis);
            float o[3] = {0, 0, 0}, d[3] = {zero, zero, zero};
            o[along] = -5;
            d[along] = 1;
            o[axis] = outside ? 1.5f * side : side;
            const volume_interval answer = asked(&bound, o, d);
            check_context("sort %d, ray %d", sort, i);
            if (sort == CUBE_SLAB && !towards && !outside) {
                CHECK_SAY(answer.entry <= 0 && answer.exit > 1e38, "[%g, %g]", answer.entry,
                          answer.exit);
            } else if (outside && !towards) {
                CHECK_SAY(answer.entry > answer.exit, "[%g, %g]", answer.entry, answer.exit);
            } else {
                /* 4 e (5 + 6 + 1) at most, and e t */
                CHECK_SAY(answer.entry <= 4 && answer.entry >= 4 - 2e-5 && answer.exit >= 6 &&
                              answer.exit <= 6 + 2e-5,
                          "[%.9g, %.9g]", answer.entry, answer.exit);
            }
        }
    }
}

static int refused(const spt_bound *bound) {
    static const float o[3] = {0, 0, -5}, d[3] = {0, 0, 1};
    float entry = 7, exit = 7, low[3] = {7, 7, 7}, high[3] = {7, 7, 7};
    int meets = 7;
    const int all = spt_bound_interval(bound, o, d, 0, 9, &entry, &exit) == SPT_BAD_ARGUMENT &&
                    spt_bound_extent(bound, low, high) == SPT_BAD_ARGUMENT &&
                    spt_bound_meets_cone(bound, o, d, 0.1f, 9, &meets) == SPT_BAD_ARGUMENT;
    return all && check_same_bits(entry, 7) && check_same_bits(exit, 7) &&
           check_same_bits(low[0], 7) && check_same_bits(high[2], 7) && meets == 7;
}

static void no_interval(void *user, const float origin[3], const float direction[3], float *t_in,
                        float *t_out) {
    (void)user;
    (void)origin;
    (void)direction;
    (void)t_in;
    (void)t_out;
}

static spt_bound good_bound(spt_bound_kind kind) {
    static const float a[3] = {0, 1, 2}, b[3] = {1, 1, 3}, half[3] = {1, 2, 3};
    float axis[3][3];
    memcpy(axis, axes_of_world, sizeof axis);
    switch (kind) {
    case SPT_BOUND_BOX:
        return spt_bound_box(-1, -1, -1, 1, 1, 1);
    case SPT_BOUND_ORIENTED_BOX:
        return spt_bound_oriented_box(a, axis, half);
    case SPT_BOUND_ELLIPSOID:
        return spt_bound_ellipsoid(a, axis, half);
    case SPT_BOUND_CAPSULE:
        return spt_bound_capsule(a, b, 1);
    case SPT_BOUND_CYLINDER:
        return spt_bound_cylinder(a, b, 1);
    case SPT_BOUND_SLAB:
        return spt_bound_slab(a, -1, 1);
    case SPT_BOUND_POLYTOPE:
        cube(CUBE_POLYTOPE, 0);
        return spt_bound_polytope(cube_planes, 6);
    case SPT_BOUND_CALLBACK:
        return spt_bound_callback(NULL, no_interval, NULL);
    default:
        return spt_bound_sphere(0, 0, 0, 1);
    }
}

/* Which numbers of a volume its kind uses, as bits in the order of the structure. */
enum {
    USES_CENTER = 1,
    USES_RADIUS = 2,
    USES_ENDS = 4, /* of the box; infinite ones are legal except of a box itself */
    USES_AXES = 8,
    USES_HALF = 16,
    USES_END = 32,
    USES_RANGE = 64,
    USES_NORMAL = 128
};
static const unsigned uses[] = {0,
                                USES_CENTER | USES_RADIUS,
                                USES_ENDS,
                                USES_CENTER | USES_AXES | USES_HALF,
                                USES_CENTER | USES_RADIUS | USES_END,
                                USES_CENTER | USES_RADIUS | USES_END,
                                USES_CENTER | USES_AXES | USES_HALF,
                                USES_ENDS | USES_NORMAL | USES_RANGE,
                                USES_ENDS,
                                USES_ENDS};

#define REFUSE(change) \
    do { \
        bound = good_bound(kind); \
        change; \
        CHECK_SAY(refused(&bound), "%s is taken", #change); \
    } while (0)
#define TAKE(change) \
    do { \
        bound = good_bound(kind); \
        change; \
        CHECK_SAY(!refused(&bound), "%s is refused", #change); \
    } while (0)

/* Every number that a kind uses is looked at, and no other. */
static void refuse_number(spt_bound_kind kind, float bad) {
    const unsigned used = uses[kind];
    spt_bound bound;
    for (int i = 0; i < 3; ++i) {
        if (used & USES_CENTER) REFUSE(bound.center[i] = bad);
        if (!(used & USES_CENTER)) TAKE(bound.center[i] = bad);
        if (used & USES_HALF) REFUSE(bound.half[i] = bad);
        if (!(used & USES_HALF)) TAKE(bound.half[i] = bad);
        if (used & USES_END) REFUSE(bound.end[i] = bad);
        if (!(used & USES_END)) TAKE(bound.end[i] = bad);
        if (used & (USES_AXES | USES_NORMAL)) REFUSE(bound.axis[0][i] = bad);
        if (used & USES_AXES) REFUSE(bound.axis[2][i] = bad);
        if (!(used & USES_AXES)) TAKE(bound.axis[2][i] = bad);
        if (!(used & USES_ENDS)) TAKE(bound.low[i] = bound.high[i] = bad);
        if ((used & USES_ENDS) && (isnan(bad) || kind == SPT_BOUND_BOX || bad > 0)) {
            REFUSE(bound.low[i] = bad);
        }
        if ((used & USES_ENDS) && (isnan(bad) || kind == SPT_BOUND_BOX || bad < 0)) {
            REFUSE(bound.high[i] = bad);
        }
    }
    if (used & USES_RADIUS) REFUSE(bound.radius = bad);
    if (!(used & USES_RADIUS)) TAKE(bound.radius = bad);
    if (used & USES_RANGE) REFUSE(bound.range[0] = bad);
    if (used & USES_RANGE) REFUSE(bound.range[1] = bad);
    if (!(used & USES_RANGE)) TAKE(bound.range[0] = bad);
}

static void F2_bad_volumes_of_every_kind(void) {
    for (int k = SPT_BOUND_SPHERE; k <= SPT_BOUND_CALLBACK; ++k) {
        const spt_bound_kind kind = (spt_bound_kind)k;
        spt_bound bound;
        check_context("kind %d", k);
        TAKE((void)0);
        refuse_number(kind, NAN);
        refuse_number(kind, (float)INFINITY);
        refuse_number(kind, (float)-INFINITY);
        REFUSE(bound.struct_size = 0);
        REFUSE(bound.struct_size -= 1);
        if (uses[k] & USES_RADIUS) REFUSE(bound.radius = 0);
        if (uses[k] & USES_RADIUS) REFUSE(bound.radius = -1);
        if (uses[k] & USES_HALF) REFUSE(bound.half[1] = -1);
        if (uses[k] & USES_ENDS) REFUSE((bound.low[1] = 2, bound.high[1] = 1));
        if (uses[k] & USES_ENDS) TAKE((bound.low[1] = 1, bound.high[1] = 1));
        if (uses[k] & USES_AXES) {
            REFUSE(bound.axis[1][1] = 1.0011f);
            REFUSE(bound.axis[1][1] = 0.9989f);
            REFUSE(bound.axis[1][2] = 0.0011f);
            REFUSE(bound.axis[0][2] = -0.0011f);
            REFUSE(memset(bound.axis[2], 0, sizeof bound.axis[2]));
            TAKE((bound.axis[1][1] = 1.0009f, bound.axis[1][2] = 0.0009f));
        }
    }
}

static void F2_bad_volumes_of_one_kind(void) {
    spt_bound bound;
    spt_bound_kind kind = SPT_BOUND_ORIENTED_BOX;
    TAKE(bound.half[0] = bound.half[1] = 0);
    kind = SPT_BOUND_ELLIPSOID;
    REFUSE(bound.half[2] = 0);
    kind = SPT_BOUND_CAPSULE;
    TAKE(memcpy(bound.end, bound.center, sizeof bound.end));
    kind = SPT_BOUND_CYLINDER;
    REFUSE(memcpy(bound.end, bound.center, sizeof bound.end));
    kind = SPT_BOUND_SLAB;
    TAKE(bound.range[0] = bound.range[1] = 1);
    REFUSE(bound.range[0] = 2);
    REFUSE(memset(bound.axis[0], 0, sizeof bound.axis[0]));
    TAKE((memset(bound.axis[0], 0, sizeof bound.axis[0]), bound.axis[0][1] = -1e-44f));
    TAKE(bound.axis[0][1] = 3e38f);
    kind = SPT_BOUND_POLYTOPE;
    REFUSE(bound.planes = NULL);
    REFUSE(bound.plane_count = 0);
    REFUSE(bound.plane_count = SPT_BOUND_PLANES + 1);
    for (int i = 0; i < 6; ++i) {
        REFUSE(cube_planes[i].offset = (float)INFINITY);
        REFUSE(cube_planes[i].offset = NAN);
        REFUSE(cube_planes[i].normal[i % 3] = NAN);
        REFUSE(memset(cube_planes[i].normal, 0, sizeof cube_planes[i].normal));
    }
    kind = SPT_BOUND_CALLBACK;
    REFUSE(bound.point = NULL);
    kind = SPT_BOUND_BOX;
    REFUSE(bound.kind = 0);
    REFUSE(bound.kind = SPT_BOUND_CALLBACK + 1);
}

/* The unit ball in volumes that reach 1.5 in z. */
static float ball_distance(void *user, float x, float y, float z) {
    (void)user;
    return sqrtf(x * x + y * y + z * z) - 1;
}

static spt_bound reaching(spt_bound_kind kind) {
    static const float middle[3] = {0, 0, 0}, a[3] = {0, 0, -1.5f}, b[3] = {0, 0, 1.5f};
    static const float up[3] = {0, 0, 2}, half[3] = {1.5f, 1.5f, 1.5f};
    float axis[3][3];
    memcpy(axis, axes_of_world, sizeof axis);
    switch (kind) {
    case SPT_BOUND_BOX:
        return spt_bound_box(-1.5f, -1.5f, -1.5f, 1.5f, 1.5f, 1.5f);
    case SPT_BOUND_ORIENTED_BOX:
        return spt_bound_oriented_box(middle, axis, half);
    case SPT_BOUND_ELLIPSOID:
        return spt_bound_ellipsoid(middle, axis, half);
    case SPT_BOUND_CAPSULE:
        return spt_bound_capsule(middle, middle, 1.5f);
    case SPT_BOUND_CYLINDER:
        return spt_bound_cylinder(a, b, 1.5f);
    case SPT_BOUND_SLAB:
        return spt_bound_slab(up, -3, 3);
    case SPT_BOUND_POLYTOPE:
        cube(CUBE_POLYTOPE, 0);
        for (int i = 0; i < 6; ++i) cube_planes[i].offset *= 1.5f;
        return spt_bound_polytope(cube_planes, 6);
    default:
        return spt_bound_sphere(0, 0, 0, 1.5f);
    }
}

static void F4_rays_that_touch_every_kind(void) {
    spt_settings settings = spt_settings_default();
    for (int k = 0; k < kind_count; ++k) {
        const spt_bound around = reaching(kinds[k]);
        spt_field field = spt_field_default();
        spt_ray ray = {{0, 0, -1.5f}, 0, {0, 0, 1}, (float)INFINITY};
        spt_hit hit;
        const spt_rays from = spt_rays_of(&ray);
        const spt_hits to = spt_hits_of(&hit);
        check_context("kind %d", (int)kinds[k]);
        field.point = ball_distance;
        field.bound = &around;
        CHECK(spt_trace(&field, &settings, 1, &from, &to, NULL) == SPT_OK);
        CHECK_SAY(hit.outcome == SPT_HIT && fabsf(hit.t - 0.5f) <= 2e-4f, "outcome %d at %g",
                  hit.outcome, (double)hit.t);
        ray.direction[2] = -1;
        CHECK(spt_trace(&field, &settings, 1, &from, &to, NULL) == SPT_OK);
        CHECK_SAY(hit.outcome == SPT_MISS && hit.evaluations <= 1, "outcome %d, %u evaluations",
                  hit.outcome, hit.evaluations);
        ray.origin[2] = -9; /* beside it, and away from it */
        CHECK(spt_trace(&field, &settings, 1, &from, &to, NULL) == SPT_OK);
        CHECK_SAY(hit.outcome == SPT_MISS && hit.evaluations == 0, "outcome %d, %u evaluations",
                  hit.outcome, hit.evaluations);
    }
}

void suite_bounds_kinds(void) {
    RUN(Q20_kinds_never_narrower_nor_too_wide);
    RUN(Q20_kinds_from_far);
    RUN(F1_rays_in_faces_of_every_kind);
    RUN(F2_bad_volumes_of_every_kind);
    RUN(F2_bad_volumes_of_one_kind);
    RUN(F4_rays_that_touch_every_kind);
}
