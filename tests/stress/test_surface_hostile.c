/* SPDX-License-Identifier: MIT
 *
 * The calls of surface.h on rays, hits, normals, points and bodies that hold anything at all, and
 * on fields that answer anything at all: results are defined, loops end within what a call may
 * spend, and what is hostile in one place changes nothing in another. */
#include "stress.h"
#include "surface_results.h"
#include "surface_world.h"

#include <float.h>
#include <math.h>
#include <string.h>

static surface_world world;
static surface_call call;
static uint32_t before[surface_outputs][surface_most * surface_most_crossings];
static uint32_t first_seen[surface_outputs][surface_most * surface_most_crossings];

static float ball_value(const void *user, size_t field, float x, float y, float z) {
    const surface_world *const self = user;
    return surface_body_distance(&self->bodies[field], x, y, z);
}

static surface_truth truth_of(float (*value)(const void *, size_t, float, float, float)) {
    surface_truth truth;
    truth.value = value;
    truth.user = &world;
    truth.size = 16.0;
    memcpy(before, world.out, sizeof before);
    for (int column = 0; column < surface_outputs; ++column) truth.before[column] = before[column];
    return truth;
}

/* Makes the call and checks every result. The widths and forms of a call must agree: the first of
 * them is kept. */
static void place_and_check(const surface_truth *truth, int is_first) {
    size_t wrong = 0;
    const spt_status status = surface_place(&call);
    CHECK_SAY(status == SPT_OK, "%s", spt_status_name(status));
    for (size_t i = 0; i < call.count; ++i) {
        const char *const why = surface_wrong(&call, truth, i);
        if (why != NULL && wrong++ < 3) CHECK_SAY(0, "index %u: %s", (unsigned)i, why);
    }
    CHECK(wrong == 0);
    if (is_first) memcpy(first_seen, world.out, sizeof first_seen);
    CHECK_SAY(memcmp(first_seen, world.out, sizeof first_seen) == 0, "not as with 1 lane");
    if (world.fields[0].batch != NULL) return;
    const size_t calls = world.bodies[0].calls + world.bodies[1].calls;
    CHECK_SAY(calls <= surface_most_evaluations(&call) * call.count, "%u evaluations",
              (unsigned)calls);
}

/* ---- Numbers --------------------------------------------------------------------------------- */

enum { specials = 20 };

static uint32_t special(size_t which) {
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
    return surface_bits(list[which % specials]);
}

/* Integers are spoilt as well: flags, outcomes and components that no trace gives. */
static void spoil(size_t index, size_t column, size_t which) {
    if (column < surface_inputs) {
        if (column != IN_ACTIVE) world.in[column][index] = special(which);
        return;
    }
    const size_t output = column - surface_inputs;
    const uint32_t odd[] = {0xffffffffu, 7, 0x80000000u, 2, 3, 0, 1, 100};
    const uint32_t read =
        surface_table[call.door].outputs_kept | surface_table[call.door].outputs_changed;
    if (!SURFACE_HAS(read, output)) return;
    world.out[output][index] = output >= OUT_OUTCOME ? odd[which % 8] : special(which);
}

enum { spoilt_columns = surface_inputs + 6, rounds = 6 };

/* One column of each index in the first rounds, and then more and more of them. */
static void spoil_all(int round) {
    for (size_t i = 0; i < surface_most; ++i) {
        if (i % 5 == 0) continue; /* clean neighbours */
        if (round < 3) {
            const size_t place = i + (size_t)round * surface_most;
            spoil(i, place % spoilt_columns, place / spoilt_columns);
        } else {
            for (int times = 0; times < 2 * round; ++times) {
                spoil(i, check_random() % spoilt_columns, check_random());
            }
        }
    }
}

static size_t clean_that_differ(uint32_t expected[][surface_most * surface_most_crossings]) {
    size_t differing = 0;
    for (int column = 0; column < surface_outputs; ++column) {
        const size_t words = surface_width(column) / 4;
        if (!SURFACE_HAS(surface_table[call.door].outputs, column)) continue;
        for (size_t i = 0; i < surface_most; i += 5) {
            differing +=
                memcmp(&world.out[column][i * words], &expected[column][i * words], 4 * words) != 0;
        }
    }
    return differing;
}

static void run_spoilt(int door, int round) {
    static uint32_t clean[surface_outputs][surface_most * surface_most_crossings];
    static uint32_t kept[surface_inputs][surface_most], spoilt[surface_inputs][surface_most];
    static uint32_t spoilt_out[surface_outputs][surface_most * surface_most_crossings];
    surface_call_make(&call, &world, (surface_door)door, 1, 0);
    CHECK(surface_place(&call) == SPT_OK);
    memcpy(clean, world.out, sizeof clean);
    memcpy(kept, world.in, sizeof kept);
    surface_call_make(&call, &world, (surface_door)door, 1, 0);
    spoil_all(round);
    memcpy(spoilt, world.in, sizeof spoilt);
    memcpy(spoilt_out, world.out, sizeof spoilt_out);
    for (int way = 0; way < 2 * STRESS_WIDTHS; ++way) {
        const uint32_t lanes = stress_widths[way / 2];
        check_context("%s, round %d, %u lanes, form %d", surface_table[door].name, round,
                      (unsigned)lanes, way % 2);
        surface_call_make(&call, &world, (surface_door)door, lanes, way % 2 ? SURFACE_POINT : 0);
        memcpy(world.out, spoilt_out, sizeof spoilt_out);
        const surface_truth truth = truth_of(ball_value);
        place_and_check(&truth, way == 0);
        CHECK_SAY(world.bodies[0].faults + world.bodies[1].faults == 0, "a callback saw %u",
                  (unsigned)(world.bodies[0].faults + world.bodies[1].faults));
        CHECK_SAY(clean_that_differ(clean) == 0, "neighbours differ");
    }
    memcpy(world.in, kept, sizeof kept);
}

static void R2sa_surface_hostile_numbers(void) {
    surface_world_make(&world);
    for (int door = 0; door < surface_doors; ++door) {
        for (int round = 0; round < rounds; ++round) run_spoilt(door, round);
    }
}

/* ---- Fields ---------------------------------------------------------------------------------- */

/* What a callback answers that keeps no promise; the same for the same point. */
typedef enum answer {
    ANSWER_NAN,
    ANSWER_INFINITE,
    ANSWER_MINUS_INFINITE,
    ANSWER_DENORMAL,
    ANSWER_ZERO,
    ANSWER_HUGE,
    ANSWER_NEGATIVE,
    ANSWER_NOISE,    /* any bits */
    ANSWER_SIGNS,    /* of one magnitude */
    ANSWER_STEEP,    /* thirty times the distance */
    ANSWER_FLAT,     /* a thousandth of it */
    ANSWER_HALF_NAN, /* behind z = 9.2 */
    ANSWER_TINY_STEPS /* just above every tolerance */,
    answers
} answer;

static answer answering;

static uint32_t hash_of(float x, float y, float z) {
    uint32_t hash = surface_bits(x) * 2654435761u ^ surface_bits(y) * 40503u;
    hash = (hash ^ hash >> 15 ^ surface_bits(z)) * 2246822519u;
    return hash ^ hash >> 13;
}

static float hostile_value(const void *user, size_t field, float x, float y, float z) {
    const float distance =
        surface_body_distance(&((const surface_world *)user)->bodies[field], x, y, z);
    const uint32_t hash = hash_of(x, y, z);
    switch (answering) {
    case ANSWER_NAN:
        return stress_nan();
    case ANSWER_INFINITE:
        return stress_infinity();
    case ANSWER_MINUS_INFINITE:
        return -stress_infinity();
    case ANSWER_DENORMAL:
        return (hash & 1) != 0 ? 1e-42f : -1e-42f;
    case ANSWER_ZERO:
        return (hash & 1) != 0 ? 0.0f : -0.0f;
    case ANSWER_HUGE:
        return (hash & 1) != 0 ? FLT_MAX : -FLT_MAX;
    case ANSWER_NEGATIVE:
        return -1.0f;
    case ANSWER_NOISE:
        return surface_float(hash);
    case ANSWER_SIGNS:
        return (hash & 1) != 0 ? 0.5f : -0.5f;
    case ANSWER_STEEP:
        return distance * 30.0f;
    case ANSWER_FLAT:
        return distance * 1e-3f;
    case ANSWER_HALF_NAN:
        return z > 9.2f ? stress_nan() : distance;
    default:
        return 0.05f;
    }
}

static float hostile_point(void *user, float x, float y, float z) {
    surface_body *const body = user;
    ++body->calls;
    body->faults += !(fabsf(x) <= FLT_MAX && fabsf(y) <= FLT_MAX && fabsf(z) <= FLT_MAX);
    return hostile_value(&world, (size_t)(body - world.bodies), x, y, z);
}

/* Writes over its points as well, which it may (A9). */
static void hostile_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                          float *distance) {
    for (size_t i = 0; i < n; ++i) {
        float *const scratch[] = {(float *)(uintptr_t)&x[i], (float *)(uintptr_t)&y[i],
                                  (float *)(uintptr_t)&z[i]};
        distance[i] = hostile_point(user, x[i], y[i], z[i]);
        for (int axis = 0; axis < 3; ++axis) *scratch[axis] = distance[i];
    }
}

static void hostile_gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                             float *gradient_x, float *gradient_y, float *gradient_z) {
    for (size_t i = 0; i < n; ++i) {
        gradient_x[i] = hostile_point(user, x[i], y[i], z[i]);
        gradient_y[i] = hostile_point(user, y[i], z[i], x[i]);
        gradient_z[i] = (hash_of(x[i], y[i], z[i]) & 1) != 0 ? 1.0f : 0.0f;
    }
}

/* Hits are those of these fields. */
static void write_residuals(void) {
    for (size_t i = 0; i < surface_most; ++i) {
        const int32_t component = (int32_t)world.hits[OUT_COMPONENT][i];
        const float t = surface_float(world.hits[OUT_T][i]);
        float p[3];
        if (component < 0 || !SURFACE_HAS(surface_table[call.door].outputs_kept, OUT_OUTCOME))
            continue;
        for (int axis = 0; axis < 3; ++axis) {
            const float along = t * surface_float(world.in[IN_DIRECTION + axis][i]);
            p[axis] = surface_float(world.in[IN_ORIGIN + axis][i]) + along;
        }
        world.out[OUT_RESIDUAL][i] =
            surface_bits(hostile_value(&world, (size_t)component, p[0], p[1], p[2]));
    }
}

static void run_hostile_field(int door, int concave) {
    for (int way = 0; way < 2 * STRESS_WIDTHS; ++way) {
        const uint32_t lanes = stress_widths[way / 2];
        check_context("%s, answer %d, %u lanes, form %d", surface_table[door].name, (int)answering,
                      (unsigned)lanes, way % 2 + 2 * concave);
        surface_call_make(&call, &world, (surface_door)door, lanes, 0);
        for (int i = 0; i < surface_most_fields; ++i) {
            world.fields[i].batch = way % 2 ? NULL : hostile_batch;
            world.fields[i].point = hostile_point;
            if (concave) world.fields[i].flags = 0;
            if (concave) world.fields[i].gradient = hostile_gradient;
        }
        if (concave) world.settings.flags = SPT_CHECK_CONVEX;
        call.count = 64;
        write_residuals();
        const surface_truth truth = truth_of(hostile_value);
        place_and_check(&truth, way == 0);
        CHECK(world.bodies[0].faults + world.bodies[1].faults == 0);
    }
}

static void A1sa_surface_hostile_fields(void) {
    surface_world_make(&world);
    for (int door = 0; door < surface_doors; ++door) {
        for (int which = 0; which < answers; ++which) {
            answering = (answer)which;
            run_hostile_field(door, 0);
            run_hostile_field(door, 1);
        }
    }
}

void suite_surface_hostile(void) {
    RUN(R2sa_surface_hostile_numbers);
    RUN(A1sa_surface_hostile_fields);
}
