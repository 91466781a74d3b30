/* SPDX-License-Identifier: MIT
 *
 * Rows F7, F8 and F11 for the calls of krs.h and mobius.h: whatever the strides, their sign and
 * alignment, whichever sinks are wanted and which rays are active, what is written is the same and
 * nothing beside it is touched. */
#include "krs_world.h"
#include "stress.h"
#include "stress_guard.h"

#include <string.h>

static krs_world world;
static krs_call call;
static unsigned char right[krs_outputs][krs_most][8];

static void place(const char *what) {
    const spt_status status = krs_place_call(&call);
    CHECK_SAY(status == SPT_OK, "%s: %s", what, spt_status_name(status));
}

/* The call as it stands in arrays, kept in `right`. */
static void prepare(int door) {
    check_context("%s", krs_table[door].name);
    krs_world_call(&call, &world, (krs_door)door);
    place("arrays");
    memcpy(right, world.out, sizeof right);
    krs_world_call(&call, &world, (krs_door)door);
}

#define FOR_EACH_DOOR(door) \
    CHECK(krs_world_make(&world, KRS_GRADIENT, 0)); \
    for (int door = 0; door < krs_doors; ++door)

/* ---- Records --------------------------------------------------------------------------------- */

enum { record = 173, most_bytes = krs_most * record };

/* A record holds all columns, hits and outputs of an index, unaligned, in 140 bytes and gaps. */
static size_t place_in(int column) {
    return (size_t)(1 + 5 * column);
}

static size_t place_out(int column) {
    return (size_t)(1 + 5 * krs_inputs + 8 * column);
}

static unsigned char *at_index(unsigned char *records, int backwards, size_t index) {
    return records + (backwards ? krs_most - 1 - index : index) * record;
}

static void fill_records(unsigned char *records, int backwards) {
    memset(records, krs_fill, most_bytes);
    for (size_t i = 0; i < krs_most; ++i) {
        unsigned char *const at = at_index(records, backwards, i);
        for (int column = 0; column < krs_inputs; ++column) {
            memcpy(at + place_in(column), &world.in[column][i], 4);
        }
    }
}

static void call_on_records(unsigned char *records, int backwards) {
    unsigned char *const first = at_index(records, backwards, 0);
    for (int column = 0; column < krs_inputs; ++column) {
        call.in[column].first = first + place_in(column);
        call.in[column].stride = backwards ? -record : record;
    }
    for (int column = 0; column < krs_table[call.door].outputs; ++column) {
        call.out[column].first = first + place_out(column);
        call.out[column].stride = backwards ? -record : record;
    }
}

/* Bytes of the records that are not as they must be: outputs as right, the others as before. */
static size_t wrong_bytes(unsigned char *records, int backwards) {
    static unsigned char expected[most_bytes];
    size_t wrong = 0;
    fill_records(expected, backwards);
    for (size_t i = 0; i < krs_most; ++i) {
        unsigned char *const at = at_index(expected, backwards, i);
        for (int column = 0; column < krs_table[call.door].outputs; ++column) {
            memcpy(at + place_out(column), right[column][i], krs_width(call.door, column));
        }
    }
    for (size_t i = 0; i < most_bytes; ++i) wrong += expected[i] != records[i];
    return wrong;
}

static void F7ka_krs_strides(void) {
    static unsigned char records[most_bytes];
    FOR_EACH_DOOR(door) {
        for (int backwards = 0; backwards < 2; ++backwards) {
            prepare(door);
            fill_records(records, backwards);
            call_on_records(records, backwards);
            place("records");
            CHECK_SAY(wrong_bytes(records, backwards) == 0, "backwards %d: %u bytes differ",
                      backwards, (unsigned)wrong_bytes(records, backwards));
        }
    }
}

/* One value for all: as if it stood in the column. */
static void F7kb_krs_columns_of_one_value(void) {
    FOR_EACH_DOOR(door) {
        for (int column = 0; column < krs_table[door].inputs; ++column) {
            uint32_t kept[krs_most];
            memcpy(kept, world.in[column], sizeof kept);
            for (int i = 0; i < krs_most; ++i) world.in[column][i] = kept[6];
            prepare(door);
            memcpy(world.in[column], kept, sizeof kept);
            call.in[column].first = &world.in[column][6];
            call.in[column].stride = 0;
            place("stride 0");
            CHECK_SAY(memcmp(right, world.out, sizeof right) == 0, "column %d", column);
        }
    }
}

/* Arrays that end where no one may read or write, or begin there. */
static void F7kc_krs_guarded_arrays(void) {
    enum { arrays = krs_inputs + krs_hit_sinks + krs_outputs, words = krs_most * 4 };
    static stress_guard guard[arrays];
    int made = 1;
    for (int i = 0; i < arrays; ++i) made &= stress_guard_make(&guard[i], 2 * words);
    if (!made) {
        check_skip("F7kc: no guard pages here");
        return;
    }
    FOR_EACH_DOOR(door) {
        for (int top = 0; top < 2; ++top) {
            prepare(door);
            for (int i = 0; i < arrays; ++i) {
                const int output = i - krs_inputs - krs_hit_sinks;
                const size_t width = output >= 0 ? krs_width((krs_door)door, output) : 4;
                unsigned char *const array =
                    top ? stress_guard_top(&guard[i], krs_most * width) : guard[i].first;
                if (i < krs_inputs) {
                    memcpy(array, call.in[i].first, words);
                    call.in[i].first = array;
                } else if (output < 0) {
                    memcpy(array, call.found[i - krs_inputs].first, words);
                    call.found[i - krs_inputs].first = array;
                } else if (output < krs_table[door].outputs) {
                    memset(array, krs_fill, krs_most * width);
                    call.out[output].first = array;
                    call.out[output].stride = (ptrdiff_t)width;
                }
            }
            place("guarded arrays");
            for (int column = 0; column < krs_table[door].outputs; ++column) {
                const size_t width = krs_width((krs_door)door, column);
                const unsigned char *const array = call.out[column].first;
                size_t wrong = 0;
                for (size_t i = 0; i < krs_most; ++i) {
                    wrong += memcmp(array + i * width, right[column][i], width) != 0;
                }
                CHECK_SAY(wrong == 0, "output %d: %u differ", column, (unsigned)wrong);
            }
        }
    }
    for (int i = 0; i < arrays; ++i) stress_guard_free(&guard[i]);
}

/* ---- What is wanted -------------------------------------------------------------------------- */

/* Each sink alone, and all but each. */
static void F8ka_krs_absent_sinks(void) {
    FOR_EACH_DOOR(door) {
        const int outputs = krs_table[door].outputs;
        if (krs_table[door].outputs_needed) continue;
        for (int choice = 0; choice < 2 * outputs; ++choice) {
            size_t wrong = 0;
            prepare(door);
            for (int column = 0; column < outputs; ++column) {
                const int chosen = column == choice % outputs;
                if (chosen == (choice < outputs)) continue;
                call.out[column].first = NULL;
                memset(right[column], krs_fill, sizeof right[column]);
            }
            place("absent sinks");
            for (int column = 0; column < outputs; ++column) {
                wrong += memcmp(right[column], world.out[column], sizeof right[column]) != 0;
            }
            CHECK_SAY(wrong == 0, "choice %d: %u sinks differ", choice, (unsigned)wrong);
        }
        prepare(door);
        for (int column = 0; column < outputs; ++column) call.out[column].first = NULL;
        place("no sink at all");
    }
}

/* Sinks over columns of the same ray, as trace.h permits, and points that move in place. */
static void F8kb_krs_sinks_over_columns(void) {
    static uint32_t kept[krs_inputs][krs_most], kept_found[krs_hit_sinks][krs_most];
    static const int under[krs_outputs] = {7, 0, 8, 3, 4, 5, 1, 2, 6, 7, 8, 3, 4, 5};
    FOR_EACH_DOOR(door) {
        size_t wrong = 0;
        const int mapped = door == KRS_DOOR_MAPPED_PLACES;
        if (krs_locates((krs_door)door)) continue;
        prepare(door);
        memcpy(kept, world.in, sizeof kept);
        memcpy(kept_found, world.found[mapped], sizeof kept_found);
        for (int column = 0; column < krs_table[door].outputs; ++column) {
            const int input = krs_moves((krs_door)door) ? column : under[column];
            call.out[column].first = world.in[input];
            call.out[column].stride = 4;
        }
        place("over columns");
        for (int column = 0; column < krs_table[door].outputs; ++column) {
            const int input = krs_moves((krs_door)door) ? column : under[column];
            for (size_t i = 0; i < krs_most; ++i) {
                const int written = memcmp(right[column][i], right[column][i] + 4, 4) != 0;
                const void *const is = &world.in[input][i];
                wrong += memcmp(is, written ? (void *)right[column][i] : &kept[input][i], 4) != 0;
            }
        }
        CHECK_SAY(wrong == 0, "%u differ", (unsigned)wrong);
        memcpy(world.in, kept, sizeof kept);
    }
}

/* ---- Which rays ------------------------------------------------------------------------------ */

static void F11ka_krs_inactive_rays(void) {
    FOR_EACH_DOOR(door) {
        size_t wrong = 0;
        if (krs_table[door].inputs <= KRS_IN_ACTIVE) continue;
        prepare(door);
        call.in[KRS_IN_ACTIVE].first = NULL;
        place("all are active");
        for (size_t i = 0; i < krs_most; ++i) {
            for (int column = 0; column < krs_table[door].outputs; ++column) {
                const unsigned char idle[] = {krs_fill, krs_fill, krs_fill, krs_fill};
                const void *const expected =
                    world.in[KRS_IN_ACTIVE][i] ? (void *)world.out[column][i] : (void *)idle;
                wrong += memcmp(right[column][i], expected, 4) != 0;
            }
        }
        CHECK_SAY(wrong == 0, "%u differ", (unsigned)wrong);
        prepare(door);
        const uint32_t none = 0;
        call.in[KRS_IN_ACTIVE].first = &none;
        call.in[KRS_IN_ACTIVE].stride = 0;
        memset(right, krs_fill, sizeof right);
        place("none is active");
        CHECK(memcmp(right, world.out, sizeof right) == 0);
        CHECK(krs_world_calls(&world) == 0);
        CHECK(world.statistics.rays == 0 && world.statistics.evaluations == 0);
    }
}

/* Hits of other components, and what is no hit, are not looked at: their sinks keep what they held
 * (krs.h); nothing else of a hit is read. */
static void F11kb_krs_places_of_other_hits(void) {
    FOR_EACH_DOOR(door) {
        size_t hits = 0, wrong = 0;
        if (!krs_locates((krs_door)door)) continue;
        uint32_t(*const found)[krs_most] = world.found[door == KRS_DOOR_MAPPED_PLACES];
        prepare(door);
        for (size_t i = 0; i < krs_most; ++i) {
            const int looked_at =
                world.in[KRS_IN_ACTIVE][i] != 0 && found[KRS_OUT_OUTCOME][i] == SPT_HIT;
            hits += (size_t)looked_at;
            for (int column = 0; column < krs_outputs; ++column) {
                const unsigned char *const bytes = right[column][i];
                const int kept = bytes[0] == krs_fill && bytes[1] == krs_fill &&
                                 bytes[2] == krs_fill && bytes[3] == krs_fill;
                wrong += kept == looked_at;
            }
        }
        CHECK_SAY(hits >= 10 && hits < krs_most, "%u hits", (unsigned)hits);
        CHECK_SAY(wrong == 0, "%u differ", (unsigned)wrong);
        for (size_t i = 0; i < krs_most; i += 2) found[KRS_OUT_COMPONENT][i] = 5;
        for (size_t i = 0; i < krs_most; i += 2) memset(right[0][i], krs_fill, 8);
        place("others are of component 5");
        for (size_t i = 0; i < krs_most; ++i) {
            wrong += memcmp(right[0][i], world.out[0][i], 8) != 0;
        }
        CHECK_SAY(wrong == 0, "%u differ", (unsigned)wrong);
        prepare(door);
        call.component = 77;
        place("no such component");
        CHECK(krs_world_calls(&world) == 0);
    }
}

void suite_krs_views(void) {
    RUN(F7ka_krs_strides);
    RUN(F7kb_krs_columns_of_one_value);
    RUN(F7kc_krs_guarded_arrays);
    RUN(F8ka_krs_absent_sinks);
    RUN(F8kb_krs_sinks_over_columns);
    RUN(F11ka_krs_inactive_rays);
    RUN(F11kb_krs_places_of_other_hits);
}
