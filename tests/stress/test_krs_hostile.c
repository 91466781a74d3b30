/* SPDX-License-Identifier: MIT
 *
 * Rows A1, A8, A9, R2 for the calls of krs.h and mobius.h: callers' fields and maps that answer
 * anything at all, or nothing, and rays and hits that hold anything at all. Results are defined, the
 * same at every width and for both forms of callback, and what is hostile in one place changes
 * nothing in another. */
#include "krs_results.h"
#include "krs_world.h"
#include "stress.h"

#include <float.h>
#include <math.h>
#include <string.h>

static krs_world world;
static krs_call call;

/* The first of the ways that must agree. */
static unsigned char first_seen[krs_outputs][krs_most][8];

static void place_and_check(uint32_t promises, int is_first) {
    size_t wrong = 0;
    CHECK(krs_place_call(&call) == SPT_OK);
    for (size_t i = 0; i < call.count; ++i) {
        const char *const why = krs_wrong(&call, krs_fill, promises, i);
        if (why != NULL && wrong++ < 2) CHECK_SAY(0, "index %u: %s", (unsigned)i, why);
    }
    CHECK(wrong == 0);
    if (is_first) memcpy(first_seen, world.out, sizeof first_seen);
    CHECK_SAY(memcmp(first_seen, world.out, sizeof first_seen) == 0, "not as with 1 lane");
    CHECK_SAY(krs_world_faults(&world) == 0, "%u faults in what callbacks were asked",
              (unsigned)krs_world_faults(&world));
}

/* ---- Answers --------------------------------------------------------------------------------- */

static uint32_t hash_of(float x, float y, float z) {
    uint32_t hash = krs_bits(x) * 2654435761u ^ krs_bits(y) * 40503u;
    hash = (hash ^ hash >> 15 ^ krs_bits(z)) * 2246822519u;
    return hash ^ hash >> 13;
}

/* What a callback answers that keeps no promise; the same for the same point. */
static const char *const answer_names[] = {"nan",
                                           "infinite",
                                           "minus infinite",
                                           "denormal",
                                           "zero",
                                           "huge",
                                           "negative",
                                           "noise",
                                           "signs",
                                           "half nan",
                                           "just above every tolerance"};
enum { answers = sizeof answer_names / sizeof *answer_names };

static int answering;

static float answer(const krs_witness *self, float x, float y, float z) {
    const uint32_t hash = hash_of(x, y, z);
    const float a = x - self->center[0], b = y - self->center[1], c = z - self->center[2];
    const float values[answers] = {stress_nan(),
                                   stress_infinity(),
                                   -stress_infinity(),
                                   (hash & 1) != 0 ? 1e-42f : -1e-42f,
                                   (hash & 1) != 0 ? 0.0f : -0.0f,
                                   (hash & 1) != 0 ? FLT_MAX : -FLT_MAX,
                                   -1.0f,
                                   krs_float(hash),
                                   (hash & 1) != 0 ? 0.5f : -0.5f,
                                   y > 0.5f ? stress_nan()
                                            : 2.0f * (sqrtf(a * a + b * b + c * c) - self->radius),
                                   0.01f};
    return values[answering];
}

static void A1ka_krs_hostile_kernels(void) {
    for (int form = 0; form < krs_forms; form += KRS_GRADIENT) {
        for (int way = 0; way < 2 * STRESS_WIDTHS; ++way) {
            const uint32_t point = way % 2 != 0 ? KRS_POINT : 0;
            CHECK(krs_world_make(&world, (uint32_t)form | point, stress_widths[way / 2]));
            for (int i = 0; i < krs_witnesses; ++i) {
                world.witness[i].answer = answer;
                world.witness[i].scribbles = way % 2 == 0;
            }
            for (answering = 0; answering < answers; ++answering) {
                static unsigned char kept[answers][krs_doors][krs_outputs][krs_most][8];
                for (int door = 0; door < krs_doors; ++door) {
                    check_context("%s, %s, %u lanes, form %u", krs_table[door].name,
                                  answer_names[answering], (unsigned)world.lanes,
                                  (unsigned)world.form);
                    krs_world_call(&call, &world, (krs_door)door);
                    memcpy(first_seen, kept[answering][door], sizeof first_seen);
                    place_and_check(0, way == 0);
                    memcpy(kept[answering][door], first_seen, sizeof first_seen);
                }
            }
        }
    }
}

/* A callback that writes nothing is a field that is NaN (field.h). */
static void silent_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                         float *distance) {
    krs_witness *const self = user;
    (void)n, (void)x, (void)y, (void)z, (void)distance;
    ++self->calls;
}

static void silent_gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                            float *gradient_x, float *gradient_y, float *gradient_z) {
    (void)gradient_y, (void)gradient_z;
    silent_batch(user, n, x, y, z, gradient_x);
}

static void A8ka_krs_results_never_written(void) {
    static unsigned char as_nan[krs_doors][krs_outputs][krs_most][8];
    for (int width = 0; width < STRESS_WIDTHS; ++width) {
        for (int silent = 0; silent < 2; ++silent) {
            CHECK(krs_world_make(&world, KRS_GRADIENT, stress_widths[width]));
            answering = 0;
            for (int i = 0; i < krs_witnesses; ++i) {
                world.witness[i].answer = answer;
                world.inner[i].gradient = silent_gradient;
                if (silent) world.inner[i].batch = silent_batch;
            }
            CHECK(krs_world_models(&world));
            for (int door = 0; door < krs_doors; ++door) {
                check_context("%s, %u lanes", krs_table[door].name, (unsigned)world.lanes);
                krs_world_call(&call, &world, (krs_door)door);
                CHECK(krs_place_call(&call) == SPT_OK);
                if (!silent) memcpy(as_nan[door], world.out, sizeof world.out);
                /* A NaN may have any bits: only that it is one is compared. */
                for (int column = 0; column < krs_table[door].outputs; ++column) {
                    size_t differ = 0;
                    for (size_t i = 0; i < krs_most; ++i) {
                        float one, other;
                        memcpy(&one, as_nan[door][column][i], 4);
                        memcpy(&other, world.out[column][i], 4);
                        differ += krs_bits(one) != krs_bits(other) && !(isnan(one) && isnan(other));
                    }
                    CHECK_SAY(differ == 0, "output %d: %u differ", column, (unsigned)differ);
                }
            }
        }
    }
}

/* ---- Maps ------------------------------------------------------------------------------------ */

static int mapping;

static void hostile_unmap(void *user, size_t n, float *x, float *y, float *z) {
    krs_witness *const self = user;
    ++self->calls;
    for (size_t i = 0; i < n; ++i) {
        const uint32_t hash = hash_of(x[i], y[i], z[i]);
        const float values[] = {stress_nan(), stress_infinity(), -stress_infinity(),
                                3e38f,        krs_float(hash),   1e-42f};
        x[i] = values[mapping];
        y[i] = mapping == 4 ? krs_float(hash * 747796405u) : y[i];
    }
}

/* krs.h: what is infinite stays finite for the field, and NaN makes the distance NaN. */
static void A1kb_krs_hostile_maps(void) {
    static const int doors[] = {KRS_DOOR_UNMAPPED, KRS_DOOR_UNMAPPED_POINTS};
    for (mapping = 0; mapping < 6; ++mapping) {
        for (int i = 0; i < 2; ++i) {
            for (int way = 0; way < 2 * STRESS_WIDTHS; ++way) {
                const uint32_t point = way % 2 != 0 ? KRS_POINT : 0;
                check_context("map %d, %s, %u lanes", mapping, krs_table[doors[i]].name,
                              (unsigned)stress_widths[way / 2]);
                CHECK(krs_world_make(&world, KRS_GRADIENT | point, stress_widths[way / 2]));
                world.unmapping.unmap = hostile_unmap;
                CHECK(krs_world_models(&world));
                krs_world_call(&call, &world, (krs_door)doors[i]);
                place_and_check(0, way == 0);
                for (size_t index = 0; mapping == 0 && index < krs_most; ++index) {
                    float x;
                    memcpy(&x, world.out[0][index], 4);
                    CHECK(i == 0 || isnan(x));
                }
            }
        }
    }
}

/* ---- Numbers --------------------------------------------------------------------------------- */

enum { specials = 20, rounds = 5 };

static uint32_t special(uint32_t which) {
    const float list[specials] = {stress_nan(),
                                  stress_infinity(),
                                  -stress_infinity(),
                                  0.0f,
                                  -0.0f,
                                  -1.0f,
                                  1e-45f,
                                  -1e-42f,
                                  FLT_MIN,
                                  FLT_MAX,
                                  -FLT_MAX,
                                  1e20f,
                                  -1e20f,
                                  1e-20f,
                                  1e30f,
                                  -1e-30f,
                                  0x1p126f,
                                  0x1p-126f,
                                  1e6f,
                                  3.0f};
    return krs_bits(list[which % specials]);
}

/* Integers are spoilt as well: outcomes and components that no trace gives. */
static void spoil(size_t index, int round) {
    static const uint32_t odd[] = {0xffffffffu, 7, 0x80000000u, 2, 3, 0, 1, 100};
    for (int times = 0; times < 1 + round; ++times) {
        const uint32_t choice = check_random();
        const int column = (int)(choice % (krs_inputs + 3));
        const uint32_t which = choice >> 8;
        if (column < KRS_IN_ACTIVE) world.in[column][index] = special(which);
        for (int mapped = 0; column >= krs_inputs && mapped < 2; ++mapped) {
            uint32_t(*const found)[krs_most] = world.found[mapped];
            if (column == krs_inputs) found[KRS_OUT_T][index] = special(which);
            if (column == krs_inputs + 1) found[KRS_OUT_OUTCOME][index] = odd[which % 8];
            if (column == krs_inputs + 2) found[KRS_OUT_COMPONENT][index] = odd[which % 8];
        }
    }
}

static void R2ka_krs_hostile_numbers(void) {
    static unsigned char clean[krs_doors][krs_outputs][krs_most][8];
    static unsigned char kept[krs_doors][krs_outputs][krs_most][8];
    static uint32_t in[krs_inputs][krs_most], found[2][krs_hit_sinks][krs_most];
    for (int round = 0; round < rounds; ++round) {
        for (int way = 0; way < 2 * STRESS_WIDTHS; ++way) {
            const uint32_t point = way % 2 != 0 ? KRS_POINT : 0;
            CHECK(krs_world_make(&world, KRS_GRADIENT | point, stress_widths[way / 2]));
            for (int door = 0; way == 0 && door < krs_doors; ++door) {
                krs_world_call(&call, &world, (krs_door)door);
                CHECK(krs_place_call(&call) == SPT_OK);
                memcpy(clean[door], world.out, sizeof world.out);
            }
            for (size_t i = 0; way == 0 && i < krs_most; ++i) {
                if (i % 4 != 0) spoil(i, round);
            }
            if (way == 0) memcpy(in, world.in, sizeof in);
            if (way == 0) memcpy(found, world.found, sizeof found);
            memcpy(world.in, in, sizeof in);
            memcpy(world.found, found, sizeof found);
            for (int door = 0; door < krs_doors; ++door) {
                size_t differ = 0;
                check_context("%s, round %d, %u lanes, form %u", krs_table[door].name, round,
                              (unsigned)world.lanes, (unsigned)world.form);
                krs_world_call(&call, &world, (krs_door)door);
                memcpy(first_seen, kept[door], sizeof first_seen);
                place_and_check(0, way == 0);
                memcpy(kept[door], first_seen, sizeof first_seen);
                for (size_t i = 0; i < krs_most; i += 4) {
                    for (int column = 0; column < krs_table[door].outputs; ++column) {
                        differ += memcmp(world.out[column][i], clean[door][column][i], 8) != 0;
                    }
                }
                CHECK_SAY(differ == 0, "%u of clean neighbours differ", (unsigned)differ);
            }
        }
    }
}

/* Rays as they come, ends or none: whatever a ray misses it misses, and no callback is asked where
 * there is no place. */
static void R2kb_krs_usual_numbers(void) {
    for (int way = 0; way < 2 * STRESS_WIDTHS; ++way) {
        const uint32_t point = way % 2 != 0 ? KRS_POINT : 0;
        CHECK(krs_world_make(&world, KRS_GRADIENT | point, stress_widths[way / 2]));
        for (int door = 0; door < krs_doors; ++door) {
            static unsigned char kept[krs_doors][krs_outputs][krs_most][8];
            check_context("%s, %u lanes, form %u", krs_table[door].name, (unsigned)world.lanes,
                          (unsigned)world.form);
            krs_world_call(&call, &world, (krs_door)door);
            memcpy(first_seen, kept[door], sizeof first_seen);
            place_and_check(KRS_TAME, way == 0);
            memcpy(kept[door], first_seen, sizeof first_seen);
        }
    }
}

/* mobius.h: a hit is where a probe was not free. Where all are, a ray is free to its end, however
 * small the probes begin and whatever they end at. */
static void R2kc_krs_probes_of_nothing(void) {
    static const float ratios[] = {1e-3f, 0.01f, 0.05f, 0.1f, 1.0f};
    static const float firsts[] = {0.0f, 1e-30f, 1e-9f, 1.0f, 1e30f};
    static const float begins[] = {0.0f, 1.0f, 1000.0f, 1e7f};
    static const spt_kernel nothing = {SPT_KERNEL_EMPTY, {0}, {0}, {0}, 0.0f, 0.0f, NULL};
    CHECK(krs_world_make(&world, 0, 0));
    world.model.levels = 0;
    world.model.kernels = &nothing;
    CHECK(spt_krs_build(&world.model, &world.krs) == SPT_OK);
    for (int i = 0; i < 5 * 5 * 4; ++i) {
        const float t_min = begins[i / 25];
        spt_ray ray = {{0, 0, 0}, t_min, {0, 0, 1}, 2.0f * t_min + 1.0f};
        const spt_rays rays = spt_rays_of(&ray);
        spt_hit hit;
        const spt_hits hits = spt_hits_of(&hit);
        spt_settings settings = spt_settings_default();
        settings.epsilon = 1e-9f;
        settings.budget = 1000;
        world.binary.probe_ratio = ratios[i % 5];
        world.binary.first = firsts[i / 5 % 5];
        CHECK(spt_binary_trace(&world.probes[1], &world.binary, &settings, 1, &rays, &hits, NULL) ==
              SPT_OK);
        CHECK_SAY(hit.outcome == SPT_MISS, "ratio %g, first %g, t_min %g: outcome %d at %g",
                  (double)world.binary.probe_ratio, (double)world.binary.first, (double)t_min,
                  (int)hit.outcome, (double)hit.t);
    }
}

void suite_krs_hostile(void) {
    RUN(A1ka_krs_hostile_kernels);
    RUN(A1kb_krs_hostile_maps);
    RUN(A8ka_krs_results_never_written);
    RUN(R2ka_krs_hostile_numbers);
    RUN(R2kb_krs_usual_numbers);
    RUN(R2kc_krs_probes_of_nothing);
}
