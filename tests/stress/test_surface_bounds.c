/* SPDX-License-Identifier: MIT
 *
 * Rows F2 and F10 for every kind of bound.h: what is refused, wherever a volume is used, with
 * nothing written. Callbacks of volumes are in test_surface_intervals.c; where rays meet volumes is
 * the oracles' to say. */
#include "stress.h"

#include <spheretrace/surface.h>

#include <math.h>
#include <string.h>

enum { kinds = 9 };

static const float unit_axes[3][3] = {{0.6f, 0.8f, 0.0f}, {-0.8f, 0.6f, 0.0f}, {0.0f, 0.0f, 1.0f}};
static spt_bound_plane planes[SPT_BOUND_PLANES + 1];

static void free_interval(void *user, const float origin[3], const float direction[3], float *t_in,
                          float *t_out) {
    (void)origin, (void)direction;
    ++*(size_t *)user;
    *t_in = 0.0f;
    *t_out = 100.0f;
}

static size_t interval_calls;

/* One legal volume of a kind, around the origin. */
static spt_bound bound_of(int kind) {
    static const float center[] = {0.1f, -0.2f, 0.3f}, end[] = {0.5f, 0.25f, -1.0f};
    static const float half[] = {1.0f, 0.5f, 2.0f};
    float axes[3][3];
    spt_bound bound;
    memcpy(axes, unit_axes, sizeof axes);
    for (int i = 0; i <= SPT_BOUND_PLANES; ++i) {
        planes[i].normal[0] = cosf((float)i);
        planes[i].normal[1] = sinf((float)i);
        planes[i].normal[2] = i % 2 ? 1.0f : -1.0f;
        planes[i].offset = 1.5f;
    }
    switch (kind) {
    case SPT_BOUND_SPHERE:
        return spt_bound_sphere(center[0], center[1], center[2], 1.25f);
    case SPT_BOUND_BOX:
        return spt_bound_box(-1.0f, -2.0f, -3.0f, 1.0f, 2.0f, 3.0f);
    case SPT_BOUND_ORIENTED_BOX:
        return spt_bound_oriented_box(center, axes, half);
    case SPT_BOUND_CAPSULE:
        return spt_bound_capsule(center, end, 0.5f);
    case SPT_BOUND_CYLINDER:
        return spt_bound_cylinder(center, end, 0.5f);
    case SPT_BOUND_ELLIPSOID:
        return spt_bound_ellipsoid(center, axes, half);
    case SPT_BOUND_SLAB:
        bound = spt_bound_slab(end, -1.0f, 1.5f);
        break;
    case SPT_BOUND_POLYTOPE:
        bound = spt_bound_polytope(planes, 12);
        break;
    default:
        bound = spt_bound_callback(NULL, free_interval, &interval_calls);
        break;
    }
    bound.low[0] = bound.low[1] = -4.0f;
    bound.high[2] = 4.0f;
    return bound;
}

/* ---- Every use of a volume ------------------------------------------------------------------- */

typedef struct results {
    float t_in, t_out, low[3], high[3];
    int meets;
    spt_hit hit;
    spt_field_faults faults;
} results;

static float no_distance(void *user, float x, float y, float z) {
    (void)x, (void)y, (void)z;
    ++*(size_t *)user;
    return 1.0f;
}

/* Uses a volume in all ways; each must say what is expected. */
static void use(const spt_bound *bound, spt_status expected, const char *why) {
    static const float origin[] = {0.0f, 0.0f, -5.0f}, direction[] = {0.0f, 0.0f, 1.0f};
    const spt_ray ray = {{0.0f, 0.0f, -5.0f}, 0.0f, {0.0f, 0.0f, 1.0f}, 100.0f};
    const spt_rays rays = spt_rays_of(&ray);
    spt_settings settings = spt_settings_default();
    spt_field field = spt_field_default();
    results now, before;
    const spt_hits hits = spt_hits_of(&now.hit);
    size_t calls = 0;
    field.point = no_distance;
    field.user = &calls;
    field.bound = bound;
    interval_calls = 0;
    memset(&now, 0x5a, sizeof now);
    before = now;
    const spt_status found[] = {
        spt_bound_interval(bound, origin, direction, 0.0f, 100.0f, &now.t_in, &now.t_out),
        spt_bound_extent(bound, now.low, now.high),
        spt_bound_meets_cone(bound, origin, direction, 0.1f, 100.0f, &now.meets),
        spt_trace(&field, &settings, 1, &rays, &hits, NULL),
        spt_trace_convex(&field, &settings, 1, &rays, &hits, NULL),
        spt_field_check(&field, 1, 1, &now.faults)};
    for (int i = 0; i < 6; ++i) {
        const int infinite = i == 5 && found[i] == SPT_UNSUPPORTED; /* to be drawn from */
        CHECK_SAY(found[i] == expected || (expected == SPT_OK && infinite), "%s: use %d gives %s",
                  why, i, spt_status_name(found[i]));
    }
    if (expected == SPT_OK) return;
    CHECK_SAY(memcmp(&now, &before, sizeof now) == 0, "%s: something was written", why);
    CHECK_SAY(calls == 0 && interval_calls == 0, "%s: something was called", why);
}

#define REFUSE(spoil) (bound = bound_of(kind), (void)(spoil), use(&bound, SPT_BAD_ARGUMENT, #spoil))
#define ACCEPT(change) (bound = bound_of(kind), (void)(change), use(&bound, SPT_OK, #change))

#define FOR_EACH_KIND(kind) \
    spt_bound bound; \
    for (int kind = 1; kind <= kinds; ++kind) /* and says which */ \
        if (check_context("kind %d", kind), 1)

/* ---- Numbers --------------------------------------------------------------------------------- */

enum { most_numbers = 24 };

/* The numbers of a volume that its kind uses and that must be finite; how many. */
static int numbers_of(spt_bound *bound, float *numbers[most_numbers]) {
    const uint32_t kind = bound->kind;
    int count = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const int centered = kind != SPT_BOUND_BOX && kind <= SPT_BOUND_ELLIPSOID;
        const int turned = kind == SPT_BOUND_ORIENTED_BOX || kind == SPT_BOUND_ELLIPSOID;
        if (centered) numbers[count++] = &bound->center[axis];
        if (kind == SPT_BOUND_BOX) numbers[count++] = &bound->low[axis];
        if (kind == SPT_BOUND_BOX) numbers[count++] = &bound->high[axis];
        if (turned) numbers[count++] = &bound->half[axis];
        if (kind == SPT_BOUND_CAPSULE || kind == SPT_BOUND_CYLINDER) {
            numbers[count++] = &bound->end[axis];
        }
        if (kind == SPT_BOUND_SLAB) numbers[count++] = &bound->axis[0][axis];
        for (int other = 0; other < 3 && turned; ++other) {
            numbers[count++] = &bound->axis[other][axis];
        }
    }
    if (kind == SPT_BOUND_SPHERE || kind == SPT_BOUND_CAPSULE || kind == SPT_BOUND_CYLINDER) {
        numbers[count++] = &bound->radius;
    }
    if (kind == SPT_BOUND_SLAB) numbers[count++] = &bound->range[0];
    if (kind == SPT_BOUND_SLAB) numbers[count++] = &bound->range[1];
    return count;
}

static void F2sa_bound_numbers_not_finite(void) {
    const float bad[] = {stress_nan(), stress_infinity(), -stress_infinity()};
    FOR_EACH_KIND(kind) {
        float *numbers[most_numbers];
        ACCEPT(0);
        const int count = numbers_of(&bound, numbers);
        for (int i = 0; i < count; ++i) {
            for (int j = 0; j < 3; ++j) REFUSE(*numbers[i] = bad[j]);
        }
        for (int axis = 0; axis < 3; ++axis) {
            if (kind != SPT_BOUND_BOX && kind < SPT_BOUND_SLAB) continue; /* does not use them */
            REFUSE(bound.low[axis] = bad[0]);
            REFUSE(bound.high[axis] = bad[0]);
            REFUSE((bound.low[axis] = 1.0f, bound.high[axis] = 0.5f));
            ACCEPT((bound.low[axis] = 1.0f, bound.high[axis] = 1.0f)); /* flat */
        }
    }
}

static void F2sb_bound_numbers_out_of_range(void) {
    const float lengths[] = {0.0f, -0.0f, -1.0f, -1e-45f};
    FOR_EACH_KIND(kind) {
        const int round =
            kind == SPT_BOUND_SPHERE || kind == SPT_BOUND_CAPSULE || kind == SPT_BOUND_CYLINDER;
        const int turned = kind == SPT_BOUND_ORIENTED_BOX || kind == SPT_BOUND_ELLIPSOID;
        for (int i = 0; i < 4 && round; ++i) REFUSE(bound.radius = lengths[i]);
        for (int axis = 0; axis < 3 && turned; ++axis) {
            REFUSE(bound.half[axis] = -1.0f);
            if (kind == SPT_BOUND_ELLIPSOID) {
                REFUSE(bound.half[axis] = 0.0f);
            } else {
                ACCEPT(bound.half[axis] = 0.0f); /* flat */
            }
            /* Unit length and right angles to 1e-3. */
            REFUSE(bound.axis[2][2] = 1.01f);
            ACCEPT(bound.axis[2][2] = 1.0001f);
            REFUSE(bound.axis[2][axis % 2] = 0.02f);
            ACCEPT(bound.axis[2][axis % 2] = 1e-4f);
            REFUSE((bound.axis[axis][0] = bound.axis[axis][1] = bound.axis[axis][2] = 0.0f));
            REFUSE(memcpy(bound.axis[axis], bound.axis[(axis + 1) % 3], sizeof bound.axis[0]));
        }
    }
}

static void F2sc_bound_parts_missing(void) {
    int kind = SPT_BOUND_CYLINDER;
    spt_bound bound;
    REFUSE(memcpy(bound.end, bound.center, sizeof bound.end)); /* no length */
    kind = SPT_BOUND_CAPSULE;
    ACCEPT(memcpy(bound.end, bound.center, sizeof bound.end)); /* a sphere */
    kind = SPT_BOUND_SLAB;
    REFUSE((bound.axis[0][0] = bound.axis[0][1] = bound.axis[0][2] = 0.0f));
    REFUSE((bound.range[0] = 1.0f, bound.range[1] = 0.5f));
    ACCEPT((bound.range[0] = 1.0f, bound.range[1] = 1.0f));
    kind = SPT_BOUND_POLYTOPE;
    REFUSE(bound.planes = NULL);
    REFUSE(bound.plane_count = 0);
    REFUSE(bound.plane_count = SPT_BOUND_PLANES + 1);
    REFUSE(bound.plane_count = SIZE_MAX);
    ACCEPT(bound.plane_count = 1);
    ACCEPT(bound.plane_count = SPT_BOUND_PLANES);
    for (int plane = 0; plane < 12; plane += 11) {
        spt_bound_plane *const p = &planes[plane];
        REFUSE((p->normal[0] = p->normal[1] = p->normal[2] = 0.0f));
        REFUSE(p->offset = stress_nan());
        REFUSE(p->offset = stress_infinity());
        for (int axis = 0; axis < 3; ++axis) {
            REFUSE(p->normal[axis] = stress_nan());
            REFUSE(p->normal[axis] = -stress_infinity());
        }
    }
    kind = SPT_BOUND_CALLBACK;
    REFUSE(bound.point = NULL);
}

static void F10so_bound_sizes_and_kinds(void) {
    FOR_EACH_KIND(kind) {
        REFUSE(bound.struct_size = 0);
        REFUSE(bound.struct_size = sizeof(size_t));
        REFUSE(bound.struct_size -= 1);
        REFUSE(bound.kind = 0);
        REFUSE(bound.kind = kinds + 1);
        REFUSE(bound.kind = UINT32_MAX);
        REFUSE(bound.kind |= 0x80000000u);
    }
}

/* ---- Arguments of the three functions -------------------------------------------------------- */

typedef struct query {
    const spt_bound *bound;
    const float *origin, *direction;
    float t_min, t_max, chord;
    float *t_in, *t_out;
} query;

static void ask(const query *q, spt_status expected, const char *why) {
    const spt_status status = spt_bound_interval(q->bound, q->origin, q->direction, q->t_min,
                                                 q->t_max, q->t_in, q->t_out);
    CHECK_SAY(status == expected, "%s: %s", why, spt_status_name(status));
}

static void F10sp_bound_interval_arguments(void) {
    const float infinity = stress_infinity(), nan = stress_nan();
    FOR_EACH_KIND(kind) {
        float origin[] = {0.0f, 0.1f, -5.0f}, direction[] = {0.0f, 0.0f, 1.0f};
        float t_in = 1e-20f, t_out = 1e-21f; /* what no interval has */
        bound = bound_of(kind);
        const query good = {&bound, origin, direction, 0.0f, 100.0f, 0.1f, &t_in, &t_out};
        query q;
#define BAD(spoil) (q = good, (void)(spoil), ask(&q, SPT_BAD_ARGUMENT, #spoil))
        BAD(q.bound = NULL);
        BAD(q.origin = NULL);
        BAD(q.direction = NULL);
        BAD(q.t_in = NULL);
        BAD(q.t_out = NULL);
        BAD(q.t_min = -1.0f);
        BAD(q.t_min = infinity);
        BAD(q.t_min = nan);
        BAD(q.t_max = nan);
        for (int axis = 0; axis < 3; ++axis) {
            const float was[] = {origin[axis], direction[axis]};
            const float bad[] = {nan, infinity, -infinity};
            for (int i = 0; i < 3; ++i) {
                BAD(origin[axis] = bad[i]);
                origin[axis] = was[0];
                BAD(direction[axis] = bad[i]);
                direction[axis] = was[1];
            }
        }
        BAD(direction[2] = 0.0f);
        BAD(direction[2] = 1e-40f);
        direction[2] = 1.0f;
        CHECK(check_same_bits(t_in, 1e-20f) && check_same_bits(t_out, 1e-21f));
        ask(&good, SPT_OK, "as it is");
        CHECK(t_in >= 0.0f && t_in <= t_out && t_out <= 100.0f);
        q = good;
        q.t_min = 2.0f;
        q.t_max = 1.0f;
        ask(&q, SPT_OK, "no length");
        CHECK(check_same_bits(t_in, infinity) && check_same_bits(t_out, -infinity));
        q = good;
        q.t_max = infinity;
        ask(&q, SPT_OK, "no end");
        CHECK(t_in <= t_out);
#undef BAD
    }
}

static void F10sq_bound_extent_and_cone_arguments(void) {
    const float bad_chords[] = {-0.1f, 1.0f, 1.5f, stress_nan(), stress_infinity()};
    FOR_EACH_KIND(kind) {
        static const float origin[] = {0.0f, 0.0f, -5.0f}, direction[] = {0.0f, 0.0f, 1.0f};
        const float bad[] = {stress_nan(), 0.0f, 1.0f};
        float low[3], high[3];
        int meets = 77;
        bound = bound_of(kind);
#define CONE(a, b, c, d, e, f) CHECK(spt_bound_meets_cone(a, b, c, d, e, f) == SPT_BAD_ARGUMENT)
        CONE(NULL, origin, direction, 0.1f, 9.0f, &meets);
        CONE(&bound, NULL, direction, 0.1f, 9.0f, &meets);
        CONE(&bound, origin, NULL, 0.1f, 9.0f, &meets);
        CONE(&bound, origin, direction, 0.1f, 9.0f, NULL);
        CONE(&bound, bad, direction, 0.1f, 9.0f, &meets);
        CONE(&bound, origin, bad, 0.1f, 9.0f, &meets);
        CONE(&bound, origin, direction, 0.1f, bad[0], &meets);
        for (int i = 0; i < 5; ++i) CONE(&bound, origin, direction, bad_chords[i], 9.0f, &meets);
#undef CONE
        CHECK(meets == 77);
        CHECK(spt_bound_meets_cone(&bound, origin, direction, 0.0f, 9.0f, &meets) == SPT_OK);
        CHECK(meets == 1);
        CHECK(spt_bound_extent(NULL, low, high) == SPT_BAD_ARGUMENT);
        CHECK(spt_bound_extent(&bound, NULL, high) == SPT_BAD_ARGUMENT);
        CHECK(spt_bound_extent(&bound, low, NULL) == SPT_BAD_ARGUMENT);
        CHECK(spt_bound_extent(&bound, low, high) == SPT_OK);
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(low[axis] <= high[axis]);
            if (kind < SPT_BOUND_SLAB) continue;
            CHECK(check_same_bits(low[axis], bound.low[axis]));
            CHECK(check_same_bits(high[axis], bound.high[axis]));
        }
    }
}

void suite_surface_bounds(void) {
    RUN(F2sa_bound_numbers_not_finite);
    RUN(F2sb_bound_numbers_out_of_range);
    RUN(F2sc_bound_parts_missing);
    RUN(F10so_bound_sizes_and_kinds);
    RUN(F10sp_bound_interval_arguments);
    RUN(F10sq_bound_extent_and_cone_arguments);
}
