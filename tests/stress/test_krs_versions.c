/* SPDX-License-Identifier: MIT
 *
 * Row F10 once more for krs.h and mobius.h: structures that are shorter or longer than this library
 * knows, in calls and in the making of models. */
#include "krs_world.h"
#include "stress.h"
#include "stress_guard.h"

#include <string.h>

static krs_world world, before;
static krs_call call;

/* ---- Calls ----------------------------------------------------------------------------------- */

static void refuse(const char *why) {
    memcpy(&before, &world, sizeof before);
    const spt_status status = krs_place_call(&call);
    CHECK_SAY(status == SPT_BAD_ARGUMENT, "%s: %s", why, spt_status_name(status));
    CHECK_SAY(krs_same_bytes(&before, &world, sizeof before), "%s: something was written", why);
}

#define REFUSE(spoil) (krs_world_call(&call, &world, (krs_door)door), (void)(spoil), refuse(#spoil))

static void F10kg_krs_shorter_structures_of_calls(void) {
    CHECK(krs_world_make(&world, KRS_GRADIENT, 0));
    for (int door = 0; door < krs_doors; ++door) {
        const uint32_t takes = krs_table[door].takes;
        check_context("%s", krs_table[door].name);
        if ((takes & KRS_TAKES_SETTINGS) != 0) {
            REFUSE(world.settings.struct_size = 0);
            REFUSE(world.settings.struct_size -= 1);
        }
        if ((takes & KRS_TAKES_STATISTICS) != 0) {
            REFUSE(world.statistics.struct_size = 0);
            REFUSE(world.statistics.struct_size -= 1);
        }
        if ((takes & KRS_TAKES_BINARY) == 0) continue;
        const spt_binary binary = world.binary;
        REFUSE(world.binary.struct_size = 0);
        REFUSE((world.binary = binary, world.binary.struct_size -= 1));
        world.binary = binary;
        for (int i = 0; i < 2; ++i) {
            const spt_probe probe = world.probes[i];
            world.probes[i].struct_size = 0;
            if (call.probe == &world.probes[i]) REFUSE(0);
            world.probes[i].struct_size = sizeof probe - 1;
            if (call.probe == &world.probes[i]) REFUSE(0);
            world.probes[i] = probe;
        }
    }
}

enum { future = 4096, kinds_of_structure = 8 };

/* Guarded memory whose last bytes are a structure of a later version: its known part lies against
 * the guard, so that whoever reads the rest that struct_size claims, or writes it, ends the
 * program. */
static stress_guard guard[kinds_of_structure];

static int make_guards(void) {
    int made = 1;
    for (int i = 0; i < kinds_of_structure; ++i) made &= stress_guard_make(&guard[i], 1024);
    if (!made) check_skip("no guard pages here");
    return made;
}

static void free_guards(void) {
    for (int i = 0; i < kinds_of_structure; ++i) stress_guard_free(&guard[i]);
}

static void *later(int place, const void *known, size_t size) {
    const size_t claimed = size + future;
    unsigned char *const at = stress_guard_top(&guard[place], size);
    memcpy(at, known, size);
    memcpy(at, &claimed, sizeof claimed);
    return at;
}

static void F10kh_krs_longer_structures_of_calls(void) {
    static unsigned char right[krs_outputs][krs_most][8];
    if (!make_guards()) return;
    CHECK(krs_world_make(&world, KRS_GRADIENT, 0));
    for (int door = 0; door < krs_doors; ++door) {
        check_context("%s", krs_table[door].name);
        krs_world_call(&call, &world, (krs_door)door);
        CHECK(krs_place_call(&call) == SPT_OK);
        memcpy(right, world.out, sizeof right);
        const spt_statistics counted = world.statistics;
        krs_world_call(&call, &world, (krs_door)door);
        spt_statistics *const statistics = later(0, &world.statistics, sizeof *statistics);
        call.settings = later(1, &world.settings, sizeof *call.settings);
        call.binary = later(2, &world.binary, sizeof *call.binary);
        call.probe = later(3, call.probe, sizeof *call.probe);
        if (call.field != NULL) call.field = later(4, call.field, sizeof *call.field);
        call.statistics = statistics;
        CHECK(krs_place_call(&call) == SPT_OK);
        CHECK(memcmp(right, world.out, sizeof right) == 0);
        CHECK(statistics->struct_size == sizeof *statistics + future);
        CHECK(statistics->evaluations == counted.evaluations);
    }
    free_guards();
}

/* ---- Models ---------------------------------------------------------------------------------- */

/* What is made of the descriptions in a world. */
typedef struct krs_made {
    spt_krs krs;
    spt_moekrs moekrs;
    spt_conformal conformal;
    spt_distorted distorted;
    spt_field of_conformal, of_distorted;
    spt_status status[4];
} krs_made;

static const char *const made_names[4] = {"spt_krs_build", "spt_moekrs_build",
                                          "spt_conformal_field", "spt_distorted_field"};

typedef struct krs_descriptions {
    const spt_krs_model *model;
    const spt_moekrs_model *mapped_model;
    const spt_field *field;
    const spt_distortion *distortion;
} krs_descriptions;

static void make(krs_made *made, const krs_descriptions *from) {
    memset(made, krs_fill, sizeof *made);
    made->status[0] = spt_krs_build(from->model, &made->krs);
    made->status[1] = spt_moekrs_build(from->mapped_model, &made->moekrs);
    made->status[2] =
        spt_conformal_field(from->field, &world.maps[0], &made->conformal, &made->of_conformal);
    made->status[3] =
        spt_distorted_field(from->field, from->distortion, &made->distorted, &made->of_distorted);
}

static krs_descriptions descriptions(void) {
    const krs_descriptions from = {&world.model, &world.mapped_model, &world.inner[0],
                                   &world.distortion};
    return from;
}

/* Of the four, those in the set must have been refused, and nothing of them been written. */
static void check_made(const char *why, uint32_t refused) {
    static krs_made made;
    const void *const memory[4] = {&made.krs, &made.moekrs, &made.conformal, &made.distorted};
    static const size_t sizes[4] = {sizeof made.krs, sizeof made.moekrs, sizeof made.conformal,
                                    sizeof made.distorted};
    const krs_descriptions from = descriptions();
    make(&made, &from);
    for (int i = 0; i < 4; ++i) {
        const int expected = (refused >> i & 1) != 0;
        const unsigned char *const bytes = memory[i];
        size_t written = 0;
        for (size_t at = 0; at < sizes[i]; ++at) written += bytes[at] != krs_fill;
        CHECK_SAY(made.status[i] == (expected ? SPT_BAD_ARGUMENT : SPT_OK), "%s, %s: %s", why,
                  made_names[i], spt_status_name(made.status[i]));
        CHECK_SAY((written == 0) == expected, "%s, %s: %u bytes written", why, made_names[i],
                  (unsigned)written);
    }
    CHECK(krs_world_calls(&world) == 0);
}

#define MAKE(spoil, refused) \
    (CHECK(krs_world_make(&world, KRS_GRADIENT, 0)), \
     krs_world_call(&call, &world, KRS_DOOR_SEQUENCE), (void)(spoil), check_made(#spoil, refused))

static void F10ki_krs_shorter_structures_of_models(void) {
    MAKE(0, 0);
    MAKE(world.model.struct_size = 0, 1);
    MAKE(world.model.struct_size -= 1, 1);
    MAKE(world.mapped_model.struct_size = 0, 2);
    MAKE(world.mapped_model.struct_size -= 1, 2);
    MAKE(world.distortion.struct_size = 0, 8);
    MAKE(world.distortion.struct_size -= 1, 8);
    /* kernel 1 of the model, the field of the map and that of the distortion */
    MAKE(world.inner[0].struct_size = 0, 13);
    MAKE(world.inner[0].struct_size -= 1, 13);
    MAKE(world.inner_bound[0].struct_size = 0, 13);
    MAKE(world.inner_bound[0].struct_size -= 1, 13);
    MAKE(world.inner[1].struct_size -= 1, 2);
    MAKE(world.inner_bound[1].struct_size -= 1, 2);
}

static void F10kj_krs_longer_structures_of_models(void) {
    static krs_made right, made;
    if (!make_guards()) return;
    CHECK(krs_world_make(&world, KRS_GRADIENT, 0));
    krs_descriptions from = descriptions();
    make(&right, &from);
    world.inner[0].bound = later(0, &world.inner_bound[0], sizeof world.inner_bound[0]);
    world.inner[1].bound = later(1, &world.inner_bound[1], sizeof world.inner_bound[1]);
    from.field = later(2, &world.inner[0], sizeof world.inner[0]);
    world.kernels[1].field = from.field;
    world.mapped_kernels[1].field = later(3, &world.inner[1], sizeof world.inner[1]);
    from.model = later(4, &world.model, sizeof world.model);
    from.mapped_model = later(5, &world.mapped_model, sizeof world.mapped_model);
    from.distortion = later(6, &world.distortion, sizeof world.distortion);
    make(&made, &from);
    for (int i = 0; i < 4; ++i) CHECK_SAY(made.status[i] == SPT_OK, "%s", made_names[i]);
    CHECK(krs_same_bytes(&right.krs, &made.krs, sizeof made.krs));
    CHECK(krs_same_bytes(&right.moekrs, &made.moekrs, sizeof made.moekrs));
    CHECK(krs_same_bytes(&right.conformal, &made.conformal, sizeof made.conformal));
    CHECK(made.of_conformal.struct_size == sizeof(spt_field));
    CHECK(made.of_distorted.struct_size == sizeof(spt_field));
    free_guards();
}

void suite_krs_versions(void) {
    RUN(F10kg_krs_shorter_structures_of_calls);
    RUN(F10kh_krs_longer_structures_of_calls);
    RUN(F10ki_krs_shorter_structures_of_models);
    RUN(F10kj_krs_longer_structures_of_models);
}
