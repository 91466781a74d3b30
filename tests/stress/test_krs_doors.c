/* SPDX-License-Identifier: MIT
 *
 * Row F10 for the calls of krs.h and mobius.h that take columns: each wrong argument is refused with
 * nothing written, compared byte by byte, and no callback called. What models, maps, distortions and
 * probes must be is tested beside their values; structures of other versions in
 * test_krs_versions.c. */
#include "krs_world.h"
#include "stress.h"

#include <string.h>

static krs_world world;
static krs_call call;

/* A call that is right in everything, of two indices. */
static void prepare(int door) {
    krs_world_call(&call, &world, (krs_door)door);
    call.count = 2;
    check_context("%s", krs_table[door].name);
}

/* The world holds all that a call may write, and what its callbacks saw. */
static void refuse(const char *why) {
    static krs_world before;
    memcpy(&before, &world, sizeof before);
    const spt_status status = krs_place_call(&call);
    CHECK_SAY(status == SPT_BAD_ARGUMENT, "%s: %s", why, spt_status_name(status));
    CHECK_SAY(krs_same_bytes(&before, &world, sizeof before), "%s: something was written", why);
}

static void accept(const char *why) {
    const spt_status status = krs_place_call(&call);
    CHECK_SAY(status == SPT_OK, "%s: %s", why, spt_status_name(status));
}

#define REFUSE(spoil) (prepare(door), (void)(spoil), refuse(#spoil))
#define ACCEPT(change) (prepare(door), (void)(change), accept(#change))

#define FOR_EACH_DOOR(door) \
    CHECK(krs_world_make(&world, KRS_GRADIENT, 0)); \
    for (int door = 0; door < krs_doors; ++door)

static int takes(int door, uint32_t structure) {
    return (krs_table[door].takes & structure) != 0;
}

static void F10ka_krs_null_pointers(void) {
    static const uint32_t needed[] = {KRS_TAKES_MODEL, KRS_TAKES_SETTINGS, KRS_TAKES_RAYS,
                                      KRS_TAKES_HITS, KRS_TAKES_PLACES};
    FOR_EACH_DOOR(door) {
        ACCEPT(call.withheld = KRS_TAKES_STATISTICS | KRS_TAKES_BINARY);
        for (size_t i = 0; i < sizeof needed / sizeof *needed; ++i) {
            if (takes(door, needed[i])) REFUSE(call.withheld = needed[i]);
        }
    }
}

static void F10kb_krs_absent_columns(void) {
    FOR_EACH_DOOR(door) {
        const krs_facts *const facts = &krs_table[door];
        for (int i = 0; i < facts->inputs; ++i) {
            if (i < facts->inputs_needed) {
                REFUSE(call.in[i].first = NULL);
            } else {
                ACCEPT(call.in[i].first = NULL);
            }
        }
        for (int i = 0; i < facts->outputs; ++i) {
            if (facts->outputs_needed) {
                REFUSE(call.out[i].first = NULL);
            } else {
                ACCEPT(call.out[i].first = NULL);
            }
        }
        for (int i = 0; krs_locates((krs_door)door) && i < krs_hit_sinks; ++i) {
            if (i == KRS_OUT_T) {
                REFUSE(call.found[i].first = NULL);
            } else {
                ACCEPT(call.found[i].first = NULL);
            }
        }
    }
}

static void F10kc_krs_counts_and_strides(void) {
    FOR_EACH_DOOR(door) {
        const krs_facts *const facts = &krs_table[door];
        REFUSE(call.count = SIZE_MAX);
        REFUSE(call.count = SIZE_MAX / 4);
        REFUSE(call.count = (size_t)PTRDIFF_MAX);
        for (int i = 0; i < facts->inputs; ++i) {
            ACCEPT(call.in[i].stride = 0);
            REFUSE(call.in[i].stride = PTRDIFF_MAX);
            REFUSE(call.in[i].stride = PTRDIFF_MIN);
        }
        for (int i = 0; i < facts->outputs; ++i) {
            ACCEPT((call.out[i].stride = 0, call.count = 1));
            REFUSE(call.out[i].stride = 0);
            REFUSE(call.out[i].stride = PTRDIFF_MAX);
            REFUSE(call.out[i].stride = PTRDIFF_MIN);
        }
    }
}

/* Rays and hits may be NULL when there are none; what is no array is checked all the same. */
static void F10kd_krs_no_indices(void) {
    static krs_world before;
    FOR_EACH_DOOR(door) {
        const int moves = krs_moves((krs_door)door);
        for (int withheld = 0; withheld < (moves ? 1 : 2); ++withheld) {
            prepare(door);
            call.count = 0;
            if (withheld) call.withheld = KRS_TAKES_RAYS | KRS_TAKES_HITS | KRS_TAKES_PLACES;
            call.statistics = NULL;
            memcpy(&before, &world, sizeof before);
            accept("count 0");
            CHECK(krs_same_bytes(&before, &world, sizeof before));
        }
        REFUSE((call.count = 0, call.withheld = KRS_TAKES_MODEL));
        if (moves) continue;
        REFUSE((call.count = 0, call.withheld = KRS_TAKES_SETTINGS));
        REFUSE((call.count = 0, world.settings.epsilon = 0.0f));
        REFUSE((call.count = 0, world.settings.flags = 1u << 31));
    }
}

static void F10ke_krs_settings(void) {
    const float bad[] = {stress_nan(), stress_infinity(), -stress_infinity(), -1.0f};
    static const uint32_t flags[] = {SPT_SKIP_START, SPT_STOP_INSIDE, SPT_CANDIDATE_PENUMBRA,
                                     SPT_CANDIDATE_CLOSEST, SPT_CHECK_CONVEX};
    FOR_EACH_DOOR(door) {
        if (!takes(door, KRS_TAKES_SETTINGS)) continue;
        REFUSE(world.settings.epsilon = 0.0f);
        for (int i = 0; i < 4; ++i) {
            REFUSE(world.settings.epsilon = bad[i]);
            REFUSE(world.settings.pixel_radius = bad[i]);
            REFUSE(world.settings.size = bad[i]);
        }
        for (uint32_t lanes = 2; lanes < 40; ++lanes) {
            if (lanes != 4 && lanes != 8 && lanes != 16) REFUSE(world.settings.max_lanes = lanes);
        }
        REFUSE(world.settings.flags = 1u << 31);
        for (int i = 0; i < 5; ++i) {
            if (krs_table[door].own_pass) {
                REFUSE(world.settings.flags = flags[i]);
            } else if (!krs_locates((krs_door)door)) {
                ACCEPT(world.settings.flags = flags[i]);
            }
        }
    }
}

/* Fields of this library promise no convexity; a step rule is nothing to passes of their own. */
static void F10kf_krs_step_rules(void) {
    FOR_EACH_DOOR(door) {
        if (!takes(door, KRS_TAKES_STATISTICS)) continue;
        if (krs_table[door].own_pass) {
            ACCEPT(world.settings.method = spt_convex());
        } else {
            REFUSE(world.settings.method = spt_convex());
        }
    }
}

void suite_krs_doors(void) {
    RUN(F10ka_krs_null_pointers);
    RUN(F10kb_krs_absent_columns);
    RUN(F10kc_krs_counts_and_strides);
    RUN(F10kd_krs_no_indices);
    RUN(F10ke_krs_settings);
    RUN(F10kf_krs_step_rules);
}
