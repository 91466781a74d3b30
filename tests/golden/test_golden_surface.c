/* SPDX-License-Identifier: MIT
 *
 * Pinned results of surface.h: one hash of all that each call writes, per scene, the same for every
 * width, compiler and architecture. The scenes use no function of libm but the square root. A
 * changed line of golden_surface_hashes.h is explained in the change that makes it;
 * `build/check golden_surface` prints the lines that differ. */
#include "check.h"
#include "rules.h"
#include "stress/surface_scene.h"

#include <stdio.h>
#include <string.h>

typedef struct golden {
    const char *scene, *door;
    uint32_t hash;
} golden;

static const golden pinned[] = {
#define GOLDEN_SURFACE(scene, door, hash) {#scene, #door, hash},
#include "golden_surface_hashes.h"
#undef GOLDEN_SURFACE
};
enum { pinned_count = sizeof pinned / sizeof pinned[0] };

static const char *const shown[] = {"sphere",     "box",        "dodecahedron",
                                    "primitives", "thin_torus", "hollow_box"};
enum { shown_count = sizeof shown / sizeof shown[0] };

static surface_scene work;
static surface_call call;

/* FNV-1a of every word of the outputs of a call. */
static uint32_t hash_of_outputs(void) {
    uint32_t hash = 2166136261u;
    for (int column = 0; column < surface_outputs; ++column) {
        if (!SURFACE_HAS(surface_table[call.door].outputs, column)) continue;
        for (size_t i = 0; i < work.count * (surface_width(column) / 4); ++i) {
            for (int byte = 0; byte < 4; ++byte) {
                hash = (hash ^ (work.out[column][i] >> 8 * byte & 255)) * 16777619u;
            }
        }
    }
    return hash;
}

static void compare(const char *scene_name) {
    const char *const door = surface_table[call.door].name;
    const uint32_t hash = hash_of_outputs();
    int same = 0;
    for (int i = 0; i < pinned_count && !same; ++i) {
        same = strcmp(pinned[i].scene, scene_name) == 0 && strcmp(pinned[i].door, door) == 0 &&
               pinned[i].hash == hash;
    }
    CHECK(same);
    if (!same) printf("GOLDEN_SURFACE(%s, %s, 0x%08xu)\n", scene_name, door, (unsigned)hash);
}

/* Each call at another width, so that all scenes together have all of them. */
static void golden_surface_calls(void) {
    for (int i = 0; i < shown_count; ++i) {
        surface_scene_make(&work, scene_named(shown[i]), surface_scene_most);
        for (int door = 0; door < surface_doors; ++door) {
            const int lanes = width_run(widths[(i + door) % width_count]);
            if (!surface_scene_has(&work, (surface_door)door)) continue;
            surface_scene_call(&call, &work, (surface_door)door, lanes);
            check_context("scene %s, %s, %d lanes", shown[i], surface_table[door].name, lanes);
            CHECK(surface_place(&call) == SPT_OK);
            compare(shown[i]);
            surface_scene_go_on(&work, (surface_door)door);
        }
    }
}

void suite_golden_surface(void) {
    RUN(golden_surface_calls);
}
