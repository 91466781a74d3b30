/* SPDX-License-Identifier: MIT
 *
 * Row G7 for the calls of krs.h and mobius.h: callers' fields that call the library themselves, down
 * to a depth, and what a level of that takes of the stack. */
#include "krs_world.h"
#include "stress.h"
#include "test_scene_registers.h"

#include <string.h>

static krs_world world;

enum { depths = 20 };

/* At each depth another call, of one index, made by a callback of the one above. */
static struct {
    int door, depth;
    uintptr_t caller[depths + 1]; /* an address in the frame that called */
    uintptr_t frame[depths + 1];  /* and in the visit of a callback */
    unsigned char out[depths + 1][krs_outputs][8];
} descent;

static void visit_below(void *unused);

/* Those that ask a caller's field. */
static int door_at(int depth) {
    const int door = (descent.door + depth) % krs_doors;
    return door == KRS_DOOR_POINTS ? KRS_DOOR_UNMAPPED_POINTS : door;
}

static krs_call prepared[krs_doors];

/* Calls of one index that asks a caller's field. */
static void prepare_descent(void) {
    krs_call one_more;
    for (int door = 0; door < krs_doors; ++door) {
        krs_call *const one = &prepared[door];
        krs_world_call(one, &world, (krs_door)door);
        one->count = 1;
        one->statistics = NULL;
        one->in[KRS_IN_ACTIVE].first = NULL;
        for (size_t i = 0; i < krs_most; ++i) {
            for (int column = 0; column < KRS_IN_ACTIVE; ++column) {
                one->in[column].first = &world.in[column][i];
            }
            for (int column = 0; column < krs_hit_sinks; ++column) {
                one->found[column].first = &world.found[door == KRS_DOOR_MAPPED_PLACES][column][i];
            }
            one->found[KRS_OUT_OUTCOME].first = NULL;
            (void)krs_place_call(one);
            if (krs_world_calls(&world) > 0) break;
        }
        CHECK(krs_world_calls(&world) > 0 || door == KRS_DOOR_POINTS);
    }
    krs_world_call(&one_more, &world, KRS_DOOR_SEQUENCE); /* what was seen is forgotten */
}

static void call_below(krs_call *below, int depth) {
    *below = prepared[door_at(depth)];
    memset(descent.out[depth], krs_fill, sizeof descent.out[depth]);
    for (int column = 0; column < krs_table[below->door].outputs; ++column) {
        below->out[column].first = descent.out[depth][column];
    }
}

/* In a small frame of its own: the compiler does not see through the pointer. */
static spt_status place_below(const krs_call *below) {
    volatile char here = 0;
    descent.caller[descent.depth] = (uintptr_t)&here;
    const spt_status status = krs_place_call(below);
    return here == 0 ? status : SPT_BAD_ARGUMENT;
}

static spt_status (*volatile place_from_here)(const krs_call *) = place_below;

static void visit_below(void *unused) {
    static krs_call below[depths + 1];
    volatile char here = 0;
    (void)unused;
    if (descent.frame[descent.depth] != 0) return;
    descent.frame[descent.depth] = (uintptr_t)&here;
    if (descent.depth >= depths) return;
    const int depth = ++descent.depth;
    call_below(&below[depth], depth);
    CHECK(place_from_here(&below[depth]) == SPT_OK);
    --descent.depth;
}

/* trace.h: a level of recursion takes at most 32 KiB, surface.h 64 KiB, besides the callback's own;
 * krs.h and mobius.h name no other number. What is here besides is few hundred bytes. */
static void check_frames(void) {
    for (int depth = 1; depth <= depths; ++depth) {
        const uintptr_t above = descent.caller[depth], below = descent.frame[depth];
        const size_t level = (size_t)(above > below ? above - below : below - above);
        CHECK_SAY(below != 0, "nothing was asked at depth %d", depth);
#ifndef FRAMES_ARE_WIDENED
        CHECK_SAY(level > 0 && level <= 64 * 1024, "%u bytes in %s", (unsigned)level,
                  krs_table[door_at(depth)].name);
#else
        (void)level;
#endif
    }
}

static void G7ka_krs_recursion(void) {
    static unsigned char alone[krs_outputs][8];
    for (int way = 0; way < STRESS_WIDTHS * krs_forms; ++way) {
        CHECK(krs_world_make(&world, (uint32_t)way % krs_forms, stress_widths[way / krs_forms]));
        prepare_descent();
        for (int door = 0; door < krs_doors; ++door) {
            krs_call below;
            memset(&descent, 0, sizeof descent);
            descent.door = door;
            call_below(&below, 0);
            krs_world_visit(&world, visit_below, NULL);
            CHECK(place_from_here(&below) == SPT_OK);
            krs_world_visit(&world, NULL, NULL);
            check_context("%u lanes, form %u, from %s", (unsigned)world.lanes, (unsigned)world.form,
                          krs_table[door].name);
            check_frames();
            for (int depth = 0; depth <= depths; ++depth) {
                below = prepared[door_at(depth)];
                memset(alone, krs_fill, sizeof alone);
                for (int column = 0; column < krs_table[below.door].outputs; ++column) {
                    below.out[column].first = alone[column];
                }
                CHECK(krs_place_call(&below) == SPT_OK);
                CHECK_SAY(memcmp(alone, descent.out[depth], sizeof alone) == 0, "depth %d, %s",
                          depth, krs_table[below.door].name);
            }
        }
    }
}

void suite_krs_recursion(void) {
    RUN(G7ka_krs_recursion);
}
