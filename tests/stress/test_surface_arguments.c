/* SPDX-License-Identifier: MIT
 *
 * Row F10 for the calls of surface.h: each wrong argument must be refused with nothing written,
 * compared byte by byte, and no callback called. Structures of other versions, the level set and
 * spt_field_check() are in test_surface_versions.c, bounds in test_surface_bounds.c. */
#include "stress.h"
#include "surface_world.h"

#include <string.h>

static surface_world world;
static surface_call call;

/* A call that is right in everything, of two indices. */
static void prepare(int door) {
    surface_call_make(&call, &world, (surface_door)door, 0, SURFACE_GRADIENT);
    call.count = 2;
    check_context("%s", surface_table[door].name);
}

static void refuse(const char *why) {
    static surface_world before;
    memcpy(&before, &world, sizeof before);
    const spt_status status = surface_place(&call);
    CHECK_SAY(status == SPT_BAD_ARGUMENT, "%s: %s", why, spt_status_name(status));
    CHECK_SAY(memcmp(&before, &world, sizeof before) == 0, "%s: something was written", why);
}

static void accept(const char *why) {
    const spt_status status = surface_place(&call);
    CHECK_SAY(status == SPT_OK, "%s: %s", why, spt_status_name(status));
    CHECK(surface_faults_seen(&world) == 0);
}

#define FOR_EACH_DOOR(door) \
    surface_world_make(&world); \
    for (int door = 0; door < surface_doors; ++door)
#define REFUSE(spoil) (prepare(door), (void)(spoil), refuse(#spoil))
#define ACCEPT(change) (prepare(door), (void)(change), accept(#change))

static int takes(int door, uint32_t what) {
    return (surface_table[door].takes & what) != 0;
}

/* How many fields the calls of a door are given here. */
static int fields_of(int door) {
    return takes(door, TAKES_FIELDS) ? surface_most_fields : 1;
}

/* ---- Pointers and columns -------------------------------------------------------------------- */

static void F10sa_surface_null_pointers(void) {
    FOR_EACH_DOOR(door) {
        prepare(door);
        accept("all that it takes");
        CHECK(surface_calls_seen(&world) != 0);
        for (uint32_t bit = 1; bit < TAKES_STATISTICS; bit <<= 1) {
            if (takes(door, bit)) REFUSE(call.withheld = bit);
        }
        ACCEPT(call.withheld = TAKES_STATISTICS);
        for (int i = 0; i < fields_of(door); ++i) REFUSE(world.fields[i].batch = NULL);
        if (takes(door, TAKES_SETTINGS)) REFUSE(world.settings.method = NULL);
    }
}

static void F10sb_surface_absent_columns(void) {
    FOR_EACH_DOOR(door) {
        const surface_facts *const facts = &surface_table[door];
        const int names_component =
            SURFACE_HAS(facts->outputs, OUT_COMPONENT) && door != DOOR_CONVEX;
        for (int column = 0; column < surface_inputs; ++column) {
            if (SURFACE_HAS(facts->inputs_needed, column)) {
                REFUSE(call.in[column].first = NULL);
            } else if (column < IN_TO || column >= IN_TO + 3) {
                ACCEPT(call.in[column].first = NULL);
            }
        }
        for (int column = 0; column < surface_outputs; ++column) {
            const int component = column == OUT_COMPONENT && names_component;
            if (SURFACE_HAS(facts->outputs_needed, column) || component) {
                REFUSE(call.out[column].first = NULL); /* nobody says which field was hit */
            } else {
                ACCEPT(call.out[column].first = NULL);
            }
            if (component) ACCEPT((call.out[column].first = NULL, call.field_count = 1));
        }
    }
    const int door = DOOR_COLLIDE;
    for (int axis = 0; axis < 3; ++axis) { /* part of an axis is none */
        REFUSE(call.in[IN_TO + axis].first = NULL);
        REFUSE((call.in[IN_TO + axis].first = NULL, call.in[IN_TO + (axis + 1) % 3].first = NULL));
    }
    ACCEPT((call.in[IN_TO].first = call.in[IN_TO + 1].first = call.in[IN_TO + 2].first = NULL));
}

static void F10sc_surface_counts_and_strides(void) {
    static const size_t counts[] = {SIZE_MAX, SIZE_MAX / 2, SIZE_MAX / 4, SIZE_MAX / 32 + 1};
    FOR_EACH_DOOR(door) {
        const surface_facts *const facts = &surface_table[door];
        for (int i = 0; i < 4; ++i) {
            if (counts[i] > (size_t)PTRDIFF_MAX / 4) REFUSE(call.count = counts[i]);
        }
        for (int column = 0; column < surface_inputs; ++column) {
            if (!SURFACE_HAS(facts->inputs, column)) continue;
            REFUSE((call.in[column].stride = PTRDIFF_MAX, call.count = 3));
            REFUSE((call.in[column].stride = PTRDIFF_MIN, call.count = 3));
            ACCEPT(call.in[column].stride = 0); /* one for all */
        }
        for (int column = 0; column < surface_outputs; ++column) {
            if (!SURFACE_HAS(facts->outputs, column)) continue;
            REFUSE(call.out[column].stride = 0);
            REFUSE((call.out[column].stride = PTRDIFF_MAX, call.count = 3));
            ACCEPT((call.out[column].stride = 0, call.count = 1));
            if (SURFACE_HAS(facts->outputs_needed, column)) continue;
            if (column == OUT_COMPONENT && door != DOOR_CONVEX) continue;
            ACCEPT((call.out[column].first = NULL, call.out[column].stride = 0));
        }
        if (!takes(door, TAKES_FIELDS)) continue;
        REFUSE(call.field_count = 0);
        REFUSE(call.field_count = SIZE_MAX);
        REFUSE(call.field_count = SIZE_MAX / sizeof(spt_field) + 1);
    }
}

/* Nothing is done, and what has no elements may be NULL; the rest is checked all the same. */
static void F10sd_surface_no_indices(void) {
    FOR_EACH_DOOR(door) {
        const int as_trace = takes(door, TAKES_RAYS);
        ACCEPT(call.count = 0);
        CHECK(surface_calls_seen(&world) == 0);
        for (uint32_t bit = TAKES_RAYS; bit < TAKES_STATISTICS && as_trace; bit <<= 1) {
            if (door == DOOR_CROSSINGS && bit == TAKES_SINKS) continue; /* says how many */
            ACCEPT((call.count = 0, call.withheld = bit));
            CHECK(surface_calls_seen(&world) == 0);
        }
        REFUSE((call.count = 0, call.withheld = TAKES_FIELD));
        REFUSE((call.count = 0, world.fields[0].lipschitz = 0.0f));
        if (!takes(door, TAKES_SETTINGS)) continue;
        REFUSE((call.count = 0, call.withheld = TAKES_SETTINGS));
        REFUSE((call.count = 0, world.settings.epsilon = 0.0f));
    }
}

/* ---- Numbers --------------------------------------------------------------------------------- */

static void F10se_surface_settings(void) {
    static const uint32_t lanes[] = {2, 3, 5, 6, 7, 9, 12, 15, 17, 32, 0xffffffffu};
    const float bad[] = {stress_nan(), stress_infinity(), -stress_infinity(), -1.0f, 1e30f};
    FOR_EACH_DOOR(door) {
        spt_settings *const s = &world.settings;
        if (!takes(door, TAKES_SETTINGS)) continue;
        for (int i = 0; i < 11; ++i) REFUSE(s->max_lanes = lanes[i]);
        for (int bit = 5; bit < 32; ++bit) REFUSE(s->flags = (uint32_t)1 << bit);
        REFUSE(s->flags = SPT_CANDIDATE_PENUMBRA | SPT_CANDIDATE_CLOSEST);
        ACCEPT(s->flags = SPT_CANDIDATE_PENUMBRA | SPT_CHECK_CONVEX);
        ACCEPT(s->flags = SPT_CANDIDATE_CLOSEST | SPT_SKIP_START);
        REFUSE(s->epsilon = 0.0f);
        REFUSE(s->epsilon = -0.0f);
        REFUSE(s->relaxation = 2.0f);
        REFUSE(s->relaxation = 0.99f);
        REFUSE(s->extrapolation = 1.01f);
        REFUSE(s->slope_blend = 0.0f);
        REFUSE(s->slope_blend = 1.01f);
        REFUSE(s->step_cap = 0.99f);
        REFUSE(s->step_cap = 100.1f);
        for (int i = 0; i < 5; ++i) {
            if (i < 4) REFUSE(s->epsilon = bad[i]);
            if (i < 4) REFUSE(s->pixel_radius = bad[i]);
            if (i < 4) REFUSE(s->size = bad[i]);
            REFUSE(s->relaxation = bad[i]);
            REFUSE(s->extrapolation = bad[i]);
            REFUSE(s->slope_blend = bad[i]);
            REFUSE(s->step_cap = bad[i]);
        }
    }
}

static void F10sf_surface_fields(void) {
    const float bad[] = {0.0f,        -0.0f,     -1.0f, stress_nan(), stress_infinity(),
                         0x1.fp-101f, 0x1.1p100f};
    FOR_EACH_DOOR(door) {
        for (int i = 0; i < fields_of(door); ++i) {
            spt_field *const field = &world.fields[i];
            for (int j = 0; j < 7; ++j) REFUSE(field->lipschitz = bad[j]);
            for (int bit = 1; bit < 32; ++bit) REFUSE(field->flags |= (uint32_t)1 << bit);
        }
        REFUSE(world.bound.radius = 0.0f);
        REFUSE(world.bound.center[1] = stress_nan());
        REFUSE(world.bound.kind = 0);
        REFUSE(world.bound.kind = 10);
        REFUSE(world.bound.kind = 0xffffffffu);
        if (!takes(door, TAKES_STATISTICS)) continue; /* those that march */
        REFUSE((world.settings.method = spt_convex(), world.fields[0].flags = 0));
        ACCEPT(world.settings.method = spt_convex());
    }
}

/* What one call alone takes. */
static void F10sg_surface_own_numbers(void) {
    const float bad[] = {stress_nan(), stress_infinity(), -stress_infinity(), -1.0f, -0x1p-149f};
    int door = DOOR_REFINE;
    surface_world_make(&world);
    ACCEPT(call.iterations = 0);
    ACCEPT(call.iterations = 16);
    REFUSE(call.iterations = 17);
    REFUSE(call.iterations = UINT32_MAX);
    door = DOOR_NORMALS;
    for (int i = 0; i < 5; ++i) REFUSE(call.detail = bad[i]);
    ACCEPT(call.detail = 1.0f);
    ACCEPT(call.rule = SPT_NORMAL_TETRAHEDRON);
    REFUSE(call.rule = (spt_normal_rule)(SPT_NORMAL_CENTRAL + 1));
    REFUSE(call.rule = (spt_normal_rule)77);
    door = DOOR_OFFSET;
    ACCEPT(call.checks = 0);
    REFUSE(call.checks = 5);
    REFUSE(call.checks = UINT32_MAX);
    door = DOOR_AMBIENT;
    for (int i = 0; i < 5; ++i) REFUSE(call.distance = bad[i]);
    REFUSE(call.distance = 0.0f);
    ACCEPT(call.samples = 16);
    REFUSE(call.samples = 0);
    REFUSE(call.samples = 17);
    REFUSE(call.samples = UINT32_MAX);
}

static void F10sh_surface_own_flags(void) {
    int door = DOOR_CONVEX;
    surface_world_make(&world);
    REFUSE(world.fields[0].bound = NULL);
    REFUSE(world.settings.flags = SPT_STOP_INSIDE);
    ACCEPT(world.settings.flags = SPT_CHECK_CONVEX);
    ACCEPT(world.fields[0].flags = 0);
    door = DOOR_CROSSINGS;
    REFUSE(world.settings.flags = SPT_STOP_INSIDE);
    REFUSE(call.most_crossings = 0);
    REFUSE(call.most_crossings = 1025);
    REFUSE(call.most_crossings = UINT32_MAX);
    REFUSE(call.crossing_step = 0);
    REFUSE(call.crossing_step = PTRDIFF_MAX);
    REFUSE(call.crossing_step = PTRDIFF_MIN);
    ACCEPT((call.most_crossings = 1, call.crossing_step = 0));
    ACCEPT((call.out[OUT_CROSSING].first = NULL, call.crossing_step = 0));
    ACCEPT((call.out[OUT_CROSSING].first = NULL, call.most_crossings = 1024));
}

void suite_surface_arguments(void) {
    RUN(F10sa_surface_null_pointers);
    RUN(F10sb_surface_absent_columns);
    RUN(F10sc_surface_counts_and_strides);
    RUN(F10sd_surface_no_indices);
    RUN(F10se_surface_settings);
    RUN(F10sf_surface_fields);
    RUN(F10sg_surface_own_numbers);
    RUN(F10sh_surface_own_flags);
}
