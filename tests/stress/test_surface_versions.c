/* SPDX-License-Identifier: MIT
 *
 * Row F10 once more for surface.h: structures that are shorter or longer than this library knows,
 * arrays of fields of a later version, the flags for candidates, and the contracts of
 * spt_level_set_field() and spt_field_check(). */
#include "stress.h"
#include "stress_guard.h"
#include "surface_world.h"

#include <math.h>
#include <string.h>

static surface_world world;
static surface_call call;
static uint32_t right[surface_outputs][surface_most * surface_most_crossings];

static void prepare(int door, uint32_t form) {
    surface_call_make(&call, &world, (surface_door)door, 0, form);
    check_context("%s", surface_table[door].name);
}

#define FOR_EACH_DOOR(door) \
    surface_world_make(&world); \
    for (int door = 0; door < surface_doors; ++door)

/* ---- Structures ------------------------------------------------------------------------------ */

static void refuse(const char *why) {
    static surface_world before;
    memcpy(&before, &world, sizeof before);
    const spt_status status = surface_place(&call);
    CHECK_SAY(status == SPT_BAD_ARGUMENT, "%s: %s", why, spt_status_name(status));
    CHECK_SAY(memcmp(&before, &world, sizeof before) == 0, "%s: something was written", why);
}

#define REFUSE(spoil) (prepare(door, SURFACE_GRADIENT), (void)(spoil), refuse(#spoil))

static void F10si_surface_shorter_structures(void) {
    FOR_EACH_DOOR(door) {
        const uint32_t takes = surface_table[door].takes;
        const int fields = (takes & TAKES_FIELDS) != 0 ? surface_most_fields : 1;
        for (int i = 0; i < fields; ++i) {
            REFUSE(world.fields[i].struct_size = 0);
            REFUSE(world.fields[i].struct_size -= 1);
        }
        if (fields > 1) REFUSE(world.fields[1].struct_size += 8); /* not the same in all */
        REFUSE(world.bound.struct_size = 0);
        REFUSE(world.bound.struct_size -= 1);
        if ((takes & TAKES_SETTINGS) != 0) {
            REFUSE(world.settings.struct_size = 0);
            REFUSE(world.settings.struct_size -= 1);
        }
        if ((takes & TAKES_STATISTICS) != 0) {
            REFUSE(world.statistics.struct_size = 0);
            REFUSE(world.statistics.struct_size -= 1);
        }
    }
}

enum { kinds_of_structure = 4, future = 4096 };

/* The known part lies against the upper guard: whoever reads the rest that struct_size claims, or
 * writes it, ends the program. */
static void F10sj_surface_longer_structures(void) {
    stress_guard guard[kinds_of_structure];
    int made = 1;
    for (int i = 0; i < kinds_of_structure; ++i) made &= stress_guard_make(&guard[i], 512);
    if (!made) {
        check_skip("F10sj: no guard pages here");
        return;
    }
    spt_field *const field = stress_guard_top(&guard[0], sizeof *field);
    spt_settings *const settings = stress_guard_top(&guard[1], sizeof *settings);
    spt_statistics *const statistics = stress_guard_top(&guard[2], sizeof *statistics);
    spt_bound *const bound = stress_guard_top(&guard[3], sizeof *bound);
    FOR_EACH_DOOR(door) {
        prepare(door, SURFACE_GRADIENT);
        call.field_count = 1;
        CHECK(surface_place(&call) == SPT_OK);
        memcpy(right, world.out, sizeof right);
        prepare(door, SURFACE_GRADIENT);
        *field = world.fields[0];
        *settings = world.settings;
        *statistics = world.statistics;
        *bound = world.bound;
        field->bound = bound;
        field->struct_size += future;
        settings->struct_size += future;
        statistics->struct_size += future;
        bound->struct_size += future;
        call.fields = field;
        call.field_count = 1;
        call.settings = settings;
        call.statistics = statistics;
        CHECK(surface_place(&call) == SPT_OK);
        CHECK(memcmp(right, world.out, sizeof right) == 0);
        CHECK(statistics->struct_size == sizeof *statistics + future);
    }
    for (int i = 0; i < kinds_of_structure; ++i) stress_guard_free(&guard[i]);
}

/* Each field is longer than ours, and read at its own stride. */
static void F10sk_surface_fields_of_a_later_version(void) {
    typedef struct later_field {
        spt_field known;
        unsigned char unknown[40];
    } later_field;
    static later_field later[surface_most_fields];
    FOR_EACH_DOOR(door) {
        if ((surface_table[door].takes & TAKES_FIELDS) == 0) continue;
        prepare(door, 0);
        CHECK(surface_place(&call) == SPT_OK);
        memcpy(right, world.out, sizeof right);
        prepare(door, 0);
        memset(later, 0xff, sizeof later);
        for (int i = 0; i < surface_most_fields; ++i) {
            later[i].known = world.fields[i];
            later[i].known.struct_size = sizeof *later;
        }
        call.fields = &later[0].known;
        CHECK(surface_place(&call) == SPT_OK);
        CHECK(memcmp(right, world.out, sizeof right) == 0);
        prepare(door, 0);
        call.fields = &later[0].known;
        later[surface_most_fields - 1].known.lipschitz = 0.0f;
        refuse("the last field of the later version");
    }
}

/* Candidates do not change how rays end, and only one kind may be asked for. Looking between the
 * samples takes one more of them for a ray that hits nothing. */
static void check_same_ends(int between) {
    size_t more = 0, differing = 0;
    for (size_t i = 0; i < surface_most; ++i) {
        const uint32_t was = right[OUT_EVALUATIONS][i], is = world.out[OUT_EVALUATIONS][i];
        const int extra = between && world.out[OUT_OUTCOME][i] == SPT_MISS;
        differing += right[OUT_T][i] != world.out[OUT_T][i];
        differing += right[OUT_RESIDUAL][i] != world.out[OUT_RESIDUAL][i];
        differing += right[OUT_OUTCOME][i] != world.out[OUT_OUTCOME][i];
        differing += right[OUT_FLAGS][i] != world.out[OUT_FLAGS][i];
        differing += is != was && !(extra && is == was + 1);
        more += is != was;
    }
    CHECK_SAY(differing == 0, "%u differ", (unsigned)differing);
    CHECK((more != 0) == between);
}

static void F10sl_flags_for_candidates(void) {
    static const uint32_t flags[] = {SPT_CANDIDATE_PENUMBRA, SPT_CANDIDATE_CLOSEST,
                                     SPT_CHECK_CONVEX};
    surface_world_make(&world);
    for (int width = 0; width < STRESS_WIDTHS; ++width) {
        surface_call_make(&call, &world, DOOR_CONVEX, stress_widths[width], 0);
        const spt_rays rays = surface_rays(&call);
        const spt_hits hits = surface_hits(&call);
        spt_settings settings = world.settings;
        CHECK(spt_trace(world.fields, &settings, surface_most, &rays, &hits, NULL) == SPT_OK);
        memcpy(right, world.out, sizeof right);
        for (int i = 0; i < 3; ++i) {
            settings.flags = flags[i];
            CHECK(spt_trace(world.fields, &settings, surface_most, &rays, &hits, NULL) == SPT_OK);
            check_same_ends(flags[i] != SPT_CHECK_CONVEX);
        }
        memset(world.out, surface_fill, sizeof world.out);
        memcpy(right, world.out, sizeof right);
        settings.flags = SPT_CANDIDATE_PENUMBRA | SPT_CANDIDATE_CLOSEST;
        CHECK(spt_trace(world.fields, &settings, surface_most, &rays, &hits, NULL) ==
              SPT_BAD_ARGUMENT);
        CHECK(memcmp(right, world.out, sizeof right) == 0);
    }
}

/* ---- The level set --------------------------------------------------------------------------- */

typedef struct level_set_call {
    spt_field field;
    spt_settings settings;
    spt_level_set memory;
    spt_field result;
    float eye[3], path, share;
    const spt_field *given_field;
    const float *given_eye;
    spt_settings *given_settings;
    spt_level_set *given_memory;
    spt_field *given_result;
} level_set_call;

static level_set_call level;

static void prepare_level(float share) {
    surface_call_make(&call, &world, DOOR_CONVEX, 0, 0);
    memset(&level, surface_fill, sizeof level);
    level.field = world.fields[0];
    level.settings = world.settings;
    level.eye[0] = level.eye[1] = level.eye[2] = 0.0f;
    level.path = 0.5f;
    level.share = share;
    level.given_field = &level.field;
    level.given_eye = level.eye;
    level.given_settings = &level.settings;
    level.given_memory = &level.memory;
    level.given_result = &level.result;
}

static spt_status make_level(void) {
    return spt_level_set_field(level.given_field, level.given_eye, level.path, level.share,
                               level.given_settings, level.given_memory, level.given_result);
}

static void refuse_level(const char *why) {
    static level_set_call before;
    memcpy(&before, &level, sizeof before);
    const spt_status status = make_level();
    CHECK_SAY(status == SPT_BAD_ARGUMENT, "%s: %s", why, spt_status_name(status));
    CHECK_SAY(memcmp(&before, &level, sizeof before) == 0, "%s: something was written", why);
    CHECK(surface_calls_seen(&world) == 0);
}

#define REFUSE_LEVEL(spoil) (prepare_level(0.5f), (void)(spoil), refuse_level(#spoil))

static void F10sm_level_set_arguments(void) {
    const float bad[] = {stress_nan(), stress_infinity(), -stress_infinity(), -1.0f};
    surface_world_make(&world);
    prepare_level(0.5f);
    CHECK(make_level() == SPT_OK && surface_calls_seen(&world) == 0);
    REFUSE_LEVEL(level.given_field = NULL);
    REFUSE_LEVEL(level.given_eye = NULL);
    REFUSE_LEVEL(level.given_settings = NULL);
    REFUSE_LEVEL(level.given_memory = NULL);
    REFUSE_LEVEL(level.given_result = NULL);
    REFUSE_LEVEL(level.field.batch = NULL);
    REFUSE_LEVEL(level.field.lipschitz = 0.0f);
    REFUSE_LEVEL(level.field.struct_size = 0);
    REFUSE_LEVEL(world.bound.radius = -1.0f);
    REFUSE_LEVEL(level.settings.epsilon = 0.0f);
    REFUSE_LEVEL(level.settings.method = NULL);
    REFUSE_LEVEL(level.settings.struct_size -= 1);
    REFUSE_LEVEL(level.share = 1.0001f);
    for (int i = 0; i < 4; ++i) {
        for (int axis = 0; axis < 3 && i < 3; ++axis) REFUSE_LEVEL(level.eye[axis] = bad[i]);
        REFUSE_LEVEL(level.path = bad[i]);
        REFUSE_LEVEL(level.share = bad[i]);
        REFUSE_LEVEL(level.settings.pixel_radius = bad[i]);
    }
}

/* Bound and licence are kept, and nothing but the pixel radius changes in the settings. */
static void F10sn_level_set_results(void) {
    surface_world_make(&world);
    for (int i = 0; i <= 4; ++i) {
        prepare_level(0.25f * (float)i);
        spt_settings settings = level.settings;
        CHECK(make_level() == SPT_OK);
        CHECK(level.result.batch != NULL && level.result.struct_size == sizeof level.result);
        CHECK(level.result.bound == level.field.bound);
        CHECK(level.result.flags == level.field.flags);
        settings.pixel_radius = level.settings.pixel_radius;
        CHECK(memcmp(&settings, &level.settings, sizeof settings) == 0);
        /* What is left of the half pixel, brought to slope 1: within the rounding of two sums and
         * two quotients. */
        const double radius = (double)world.settings.pixel_radius, share = 0.25 * i;
        CHECK(stress_within((double)level.settings.pixel_radius, radius / (1.0 + share * radius),
                            4 * 0x1p-24 * radius));
    }
}

static void scribbling_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                             float *distance) {
    float *const scratch[] = {(float *)(uintptr_t)x, (float *)(uintptr_t)y, (float *)(uintptr_t)z};
    for (size_t i = 0; i < n; ++i) distance[i] = surface_body_distance(user, x[i], y[i], z[i]);
    for (size_t i = 0; i < 3 * n; ++i) scratch[i % 3][i / 3] = stress_nan();
}

/* The rays of a level set; all of them primary. */
static void trace_level(uint32_t lanes) {
    surface_call_make(&call, &world, DOOR_CONVEX, lanes, 0);
    call.in[IN_PATH].stride = 0;
    level.settings.max_lanes = lanes;
    const spt_rays rays = surface_rays(&call);
    const spt_hits hits = surface_hits(&call);
    CHECK(spt_trace(&level.result, &level.settings, surface_most, &rays, &hits, NULL) == SPT_OK);
}

static void A9sa_level_set_callbacks(void) {
    surface_world_make(&world);
    for (int width = 0; width < STRESS_WIDTHS; ++width) {
        const uint32_t lanes = stress_widths[width];
        check_context("%u lanes", (unsigned)lanes);
        /* A share of 0 leaves all as it is. */
        prepare_level(0.0f);
        level.result = level.field;
        trace_level(lanes);
        memcpy(right, world.out, sizeof right);
        prepare_level(0.0f);
        CHECK(make_level() == SPT_OK);
        trace_level(lanes);
        CHECK(memcmp(right, world.out, sizeof right) == 0);
        CHECK(surface_faults_seen(&world) == 0 && surface_calls_seen(&world) > 0);
        /* The field's own callback may be for one point, and may use its points as scratch. */
        prepare_level(0.5f);
        CHECK(make_level() == SPT_OK);
        trace_level(lanes);
        memcpy(right, world.out, sizeof right);
        prepare_level(0.5f);
        level.field.batch = scribbling_batch;
        CHECK(make_level() == SPT_OK);
        trace_level(lanes);
        CHECK(memcmp(right, world.out, sizeof right) == 0);
        surface_call_make(&call, &world, DOOR_CONVEX, 0, SURFACE_POINT);
        const spt_field point = world.fields[0];
        prepare_level(0.5f);
        level.field.batch = NULL;
        level.field.point = point.point;
        CHECK(make_level() == SPT_OK);
        trace_level(lanes);
        CHECK(memcmp(right, world.out, sizeof right) == 0);
    }
}

void suite_surface_versions(void) {
    RUN(F10si_surface_shorter_structures);
    RUN(F10sj_surface_longer_structures);
    RUN(F10sk_surface_fields_of_a_later_version);
    RUN(F10sl_flags_for_candidates);
    RUN(F10sm_level_set_arguments);
    RUN(F10sn_level_set_results);
    RUN(A9sa_level_set_callbacks);
}
