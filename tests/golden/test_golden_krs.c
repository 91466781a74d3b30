/* SPDX-License-Identifier: MIT
 *
 * Pinned results of krs.h and mobius.h: one hash of all that each call writes on each model, of the
 * fields and their normals, and of what maps do, the same for every width, compiler and
 * architecture. No function of libm but the square root is used. A changed line of
 * golden_krs_hashes.h is explained in the change that makes it; `build/check golden_krs` prints the
 * lines that differ. */
#include "check.h"
#include "rules.h"
#include "stress/krs_world.h"

#include <stdio.h>
#include <string.h>

typedef struct golden {
    int variant;
    const char *what;
    uint32_t hash;
} golden;

static const golden pinned[] = {
#define GOLDEN_KRS(variant, what, hash) {variant, #what, hash},
#include "golden_krs_hashes.h"
#undef GOLDEN_KRS
};
enum { pinned_count = sizeof pinned / sizeof pinned[0] };

static krs_world world;
static krs_call call;

static const uint32_t start = 2166136261u;

/* FNV-1a, by value: the bytes of a double are those of an architecture. */
static uint32_t hash_of_doubles(const double *numbers, int count, uint32_t hash) {
    for (int i = 0; i < count; ++i) {
        uint64_t bits;
        memcpy(&bits, &numbers[i], sizeof bits);
        for (int byte = 0; byte < 8; ++byte) {
            hash = (hash ^ (uint32_t)(bits >> 8 * byte & 255)) * 16777619u;
        }
    }
    return hash;
}

static uint32_t hash_of_words(const uint32_t *words, size_t count, uint32_t hash) {
    for (size_t i = 0; i < count; ++i) {
        for (int byte = 0; byte < 4; ++byte) {
            hash = (hash ^ (words[i] >> 8 * byte & 255)) * 16777619u;
        }
    }
    return hash;
}

static void compare(int variant, const char *what, uint32_t hash) {
    int same = 0;
    for (int i = 0; i < pinned_count && !same; ++i) {
        same = pinned[i].variant == variant && strcmp(pinned[i].what, what) == 0 &&
               pinned[i].hash == hash;
    }
    CHECK(same);
    if (!same) printf("GOLDEN_KRS(%d, %s, 0x%08xu)\n", variant, what, (unsigned)hash);
}

/* Rays that end: what is beyond 1e18 is not pinned. */
static void make_world(int variant, uint32_t lanes) {
    CHECK(krs_world_make(&world, KRS_GRADIENT, lanes) && krs_world_vary(&world, variant));
    for (int i = 0; i < krs_most; ++i) {
        if (krs_float(world.in[KRS_IN_T_MAX][i]) > 1e6f) {
            world.in[KRS_IN_T_MAX][i] = krs_bits(1e6f);
        }
    }
}

static uint32_t hash_of_outputs(void) {
    uint32_t hash = start;
    for (int column = 0; column < krs_table[call.door].outputs; ++column) {
        for (size_t i = 0; i < krs_most; ++i) {
            for (size_t word = 0; word < krs_width(call.door, column) / 4; ++word) {
                uint32_t value;
                uint64_t mirrors;
                memcpy(&value, world.out[column][i], 4);
                memcpy(&mirrors, world.out[column][i], 8);
                if (krs_width(call.door, column) == 8) value = (uint32_t)(mirrors >> 32 * word);
                hash = hash_of_words(&value, 1, hash);
            }
        }
    }
    return hash;
}

/* Each call at another width, so that all models together have all of them. */
static void golden_krs_calls(void) {
    for (int variant = 0; variant < krs_variants; ++variant) {
        for (int door = 0; door < krs_doors; ++door) {
            const int of_map = door == KRS_DOOR_UNMAPPED || door == KRS_DOOR_UNMAPPED_POINTS;
            if (of_map && variant > 0) continue; /* there is one map only */
            const uint32_t lanes = widths[(variant + door) % width_count];
            make_world(variant, lanes);
            krs_world_call(&call, &world, (krs_door)door);
            CHECK(krs_place_call(&call) == SPT_OK);
            compare(variant, krs_table[door].name, hash_of_outputs());
        }
    }
}

/* The gradient callbacks of the fields, at the places of the rays' beginnings. */
static void golden_krs_normals(void) {
    static const char *const names[] = {"normals", "mapped_normals", "conformal_normals",
                                        "distorted_normals"};
    for (int variant = 0; variant < krs_variants; ++variant) {
        make_world(variant, widths[variant % width_count]);
        for (int door = 0; door <= KRS_DOOR_DISTORTED; ++door) {
            static const float zero = 0.0f;
            static uint32_t normal[3][krs_most];
            krs_world_call(&call, &world, (krs_door)door);
            spt_rays rays;
            spt_hits hits;
            spt_vector_sinks normals;
            memcpy(&rays, call.in, sizeof rays);
            memset(&hits, 0, sizeof hits);
            memset(normal, 0, sizeof normal);
            hits.t.first = (void *)(uintptr_t)&zero; /* only read */
            hits.t.stride = 0;
            for (int axis = 0; axis < 3; ++axis) {
                normals.axis[axis].first = normal[axis];
                normals.axis[axis].stride = 4;
            }
            for (size_t i = 0; i < krs_most; ++i) {
                spt_rays one = rays;
                spt_vector_sinks to = normals;
                for (int axis = 0; axis < 3; ++axis) {
                    one.origin[axis].first = &world.in[axis][i];
                    one.direction[axis].first = &world.in[3 + axis][i];
                    to.axis[axis].first = &normal[axis][i];
                }
                CHECK(spt_normals(call.field, 1, &world.settings, SPT_NORMAL_TETRAHEDRON, 0.0f, 1,
                                  &one, &hits, &to) == SPT_OK);
            }
            compare(variant, names[door], hash_of_words(normal[0], 3 * krs_most, start));
        }
    }
}

static uint32_t hash_of_region(const spt_mobius *map, uint32_t kind, const double center[3],
                               uint32_t hash) {
    spt_region region = {kind, {0.48, 0.6, 0.64}, 0.75};
    const uint32_t *const kinds = &region.kind;
    if (kind != SPT_REGION_HALF_SPACE) memcpy(region.center, center, sizeof region.center);
    CHECK(spt_mobius_region(map, &region, &region) == SPT_OK);
    const spt_sphere_coefficients image = spt_region_coefficients(&region);
    const spt_sphere_coefficients back = spt_mobius_pull_back(map, &image);
    const double numbers[] = {region.center[0], region.center[1], region.center[2],
                              region.radius,    back.alpha,       back.beta[0],
                              back.beta[1],     back.beta[2],     back.gamma};
    return hash_of_doubles(numbers, 9, hash_of_words(kinds, 1, hash));
}

static void golden_krs_maps(void) {
    static const double forth[3] = {0.48, 0.6, 0.64};
    CHECK(krs_world_make(&world, 0, 0));
    for (int i = 0; i < krs_levels; ++i) {
        const spt_mobius *const map = &world.maps[i];
        const spt_quaternion entries[4] = {map->a, map->b, map->c, map->d};
        uint32_t hash = start;
        for (int entry = 0; entry < 4; ++entry) {
            const double parts[] = {entries[entry].real, entries[entry].x, entries[entry].y,
                                    entries[entry].z};
            hash = hash_of_doubles(parts, 4, hash);
        }
        for (size_t ray = 0; ray < 20; ++ray) {
            double point[3], image[3], vector[3];
            for (int axis = 0; axis < 3; ++axis) {
                point[axis] = (double)krs_float(world.in[axis][ray]);
            }
            CHECK(spt_mobius_point(map, point, image));
            spt_mobius_vector(map, point, forth, vector);
            const double scalars[] = {spt_mobius_scale(map, point),
                                      spt_mobius_exit(map, point, forth, 0.25)};
            hash = hash_of_doubles(image, 3, hash);
            hash = hash_of_doubles(vector, 3, hash);
            hash = hash_of_doubles(scalars, 2, hash);
            hash = hash_of_region(map, 1 + (uint32_t)ray % 3, point, hash);
        }
        compare(i, "spt_mobius", hash);
    }
}

static void golden_krs_checks(void) {
    static spt_krs_faults faults;
    for (int variant = 0; variant < krs_variants; ++variant) {
        make_world(variant, 0);
        CHECK(spt_krs_check(&world.krs, 200, 7, &faults) == SPT_OK);
        uint32_t hash = hash_of_words(faults.samples, SPT_KRS_LEVELS, start);
        hash = hash_of_words(faults.discarded, SPT_KRS_LEVELS, hash);
        for (int level = 0; level < SPT_KRS_LEVELS; ++level) {
            uint32_t words[4] = {krs_bits(faults.depth[level]), 0, 0, 0};
            for (int axis = 0; axis < 3; ++axis) {
                words[1 + axis] = krs_bits(faults.worst[level][axis]);
            }
            hash = hash_of_words(words, 4, hash);
        }
        compare(variant, "spt_krs_check", hash);
    }
}

void suite_golden_krs(void) {
    RUN(golden_krs_calls);
    RUN(golden_krs_normals);
    RUN(golden_krs_maps);
    RUN(golden_krs_checks);
}
