/* SPDX-License-Identifier: MIT
 *
 * Equal bits of krs.h and mobius.h: every call gives the same results on every model at every width
 * of the model and of the call, for both forms of callback, and in any order, number and company of
 * rays. */
#include "check.h"
#include "rules.h"
#include "stress/krs_world.h"

#include <string.h>

enum { many = 700 };

static krs_world world;
static krs_call call;
static unsigned char expected[krs_doors][krs_outputs][krs_most][8];

static void make_world(int variant, uint32_t form, uint32_t lanes) {
    CHECK(krs_world_make(&world, form, lanes) && krs_world_vary(&world, variant));
}

static void place(void) {
    const spt_status status = krs_place_call(&call);
    CHECK_SAY(status == SPT_OK, "%s", spt_status_name(status));
}

/* Some of the rays often, in random order, in calls of random sizes. */
static void place_in_company(int door) {
    static uint32_t in[krs_inputs][many], found[krs_hit_sinks][many];
    static unsigned char out[krs_outputs][many][8];
    size_t index[many], wrong = 0;
    const int mapped = door == KRS_DOOR_MAPPED_PLACES;
    for (size_t i = 0; i < many; ++i) {
        index[i] = check_random() % krs_most;
        for (int column = 0; column < krs_inputs; ++column) {
            in[column][i] = world.in[column][index[i]];
        }
        for (int column = 0; column < krs_hit_sinks; ++column) {
            found[column][i] = world.found[mapped][column][index[i]];
        }
    }
    memset(out, krs_fill, sizeof out);
    for (size_t done = 0; done < many; done += call.count) {
        const size_t wanted = 1 + check_random() % (check_random() % 2 != 0 ? 20 : 600);
        call.count = wanted < many - done ? wanted : many - done;
        for (int column = 0; column < krs_inputs; ++column)
            call.in[column].first = &in[column][done];
        for (int column = 0; column < krs_hit_sinks; ++column) {
            call.found[column].first = &found[column][done];
        }
        for (int column = 0; column < krs_table[door].outputs; ++column) {
            call.out[column].first = out[column][done];
        }
        place();
    }
    for (size_t i = 0; i < many; ++i) {
        for (int column = 0; column < krs_table[door].outputs; ++column) {
            wrong += memcmp(out[column][i], expected[door][column][index[i]], 8) != 0;
        }
    }
    CHECK_SAY(wrong == 0, "%u differ in company", (unsigned)wrong);
}

static void parity_krs_widths_and_company(void) {
    for (int way = 0; way < krs_variants * 2; ++way) {
        const int variant = way / 2;
        const uint32_t form = way % 2 != 0 ? KRS_GRADIENT : 0;
        make_world(variant, form, 1);
        for (int door = 0; door < krs_doors; ++door) {
            krs_world_call(&call, &world, (krs_door)door);
            place();
            memcpy(expected[door], world.out, sizeof world.out);
        }
        /* The model at one width, the call at another. */
        for (int lanes = 0; lanes < 2 * width_count; ++lanes) {
            const uint32_t point = lanes % 2 != 0 ? KRS_POINT : 0;
            make_world(variant, form | point, widths[lanes / 2]);
            for (int door = 0; door < krs_doors; ++door) {
                krs_world_call(&call, &world, (krs_door)door);
                world.settings.max_lanes = widths[(lanes / 2 + lanes % 2 * 3) % width_count];
                check_context("%s, variant %d, model of %u lanes, call of %u, form %u",
                              krs_table[door].name, variant, (unsigned)world.lanes,
                              (unsigned)world.settings.max_lanes, (unsigned)world.form);
                place();
                CHECK(memcmp(expected[door], world.out, sizeof world.out) == 0);
                if (lanes >= 2 * width_count - 2) place_in_company(door);
            }
        }
    }
}

void suite_parity_krs(void) {
    RUN(parity_krs_widths_and_company);
}
