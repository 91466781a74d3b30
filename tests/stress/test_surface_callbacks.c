/* SPDX-License-Identifier: MIT
 *
 * Rows A8 and A9 for the calls of surface.h: callbacks that leave values out, answer junk for
 * padding or write over their points; and what the padding is. Values that no field should give are
 * in test_surface_hostile.c. */
#include "stress.h"
#include "surface_results.h"
#include "surface_world.h"

#include <string.h>

static surface_world world;
static surface_call call;
static uint32_t clean[surface_outputs][surface_most * surface_most_crossings];

/* ---- Callbacks ------------------------------------------------------------------------------- */

typedef enum mischief {
    KEEP_QUIET,
    LEAVE_ONE, /* the first value of one call */
    WRITE_NOTHING,
    SPOIL_PADDING,
    OVERWRITE_POINTS,
    CHECK_POINTS /* that they are among the known ones */
} mischief;

enum { most_points = 4096 };

static struct {
    mischief mischief;
    size_t at_call, call;
    float points[most_points][3];
    size_t known;
    size_t strangers;
} culprit;

static int same_point(float x, float y, float z, const float p[3]) {
    return check_same_bits(x, p[0]) && check_same_bits(y, p[1]) && check_same_bits(z, p[2]);
}

/* A point that repeats one before it. No two of those that are asked for here are the same. */
static int is_padding(size_t i, const float *x, const float *y, const float *z) {
    for (size_t j = 0; j < i; ++j) {
        const float p[] = {x[j], y[j], z[j]};
        if (same_point(x[i], y[i], z[i], p)) return 1;
    }
    return 0;
}

static int is_known(float x, float y, float z) {
    for (size_t i = 0; i < culprit.known; ++i) {
        if (same_point(x, y, z, culprit.points[i])) return 1;
    }
    return 0;
}

static void write_over(size_t n, const float *x, const float *y, const float *z) {
    float *const scratch[] = {(float *)(uintptr_t)x, (float *)(uintptr_t)y, (float *)(uintptr_t)z};
    for (size_t i = 0; i < 3 * n; ++i) scratch[i % 3][i / 3] = i % 2 ? stress_nan() : 1e30f;
}

static void mischievous_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                              float *distance) {
    const size_t which = culprit.call++;
    if (culprit.mischief == WRITE_NOTHING) return;
    for (size_t i = 0; i < n; ++i) {
        const int padding = culprit.mischief == SPOIL_PADDING && is_padding(i, x, y, z);
        if (culprit.mischief == CHECK_POINTS) culprit.strangers += !is_known(x[i], y[i], z[i]);
        if (culprit.mischief == LEAVE_ONE && which == culprit.at_call && i == 0) continue;
        distance[i] = padding ? stress_nan() : surface_body_distance(user, x[i], y[i], z[i]);
    }
    if (culprit.mischief == OVERWRITE_POINTS) write_over(n, x, y, z);
}

/* Gradients are always written, but may be anything that is not finite. */
static void mischievous_gradient(void *user, size_t n, const float *x, const float *y,
                                 const float *z, float *gradient_x, float *gradient_y,
                                 float *gradient_z) {
    const surface_body *const body = user;
    const size_t which = culprit.call++;
    for (size_t i = 0; i < n; ++i) {
        const int none = culprit.mischief == WRITE_NOTHING ||
                         (culprit.mischief == SPOIL_PADDING && is_padding(i, x, y, z)) ||
                         (culprit.mischief == LEAVE_ONE && which == culprit.at_call && i == 0);
        if (culprit.mischief == CHECK_POINTS) culprit.strangers += !is_known(x[i], y[i], z[i]);
        gradient_x[i] = none ? stress_nan() : x[i] - body->center[0];
        gradient_y[i] = none ? stress_infinity() : y[i] - body->center[1];
        gradient_z[i] = none ? stress_nan() : z[i] - body->center[2];
    }
    if (culprit.mischief == OVERWRITE_POINTS) write_over(n, x, y, z);
}

/* Points are known from the callback for one point, and from the first of a gradient's. */
static float noting_point(void *user, float x, float y, float z) {
    const float p[] = {x, y, z};
    if (culprit.known < most_points) memcpy(culprit.points[culprit.known++], p, sizeof p);
    return surface_body_distance(user, x, y, z);
}

static void noting_gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                            float *gradient_x, float *gradient_y, float *gradient_z) {
    noting_point(user, x[0], y[0], z[0]);
    mischievous_gradient(user, n, x, y, z, gradient_x, gradient_y, gradient_z);
}

/* ---- Calls ----------------------------------------------------------------------------------- */

static void prepare(int door, int width, int gradient, mischief how) {
    check_context("%s, %u lanes, %s", surface_table[door].name, (unsigned)stress_widths[width],
                  gradient ? "gradient" : "differences");
    surface_call_make(&call, &world, (surface_door)door, stress_widths[width], 0);
    culprit.mischief = how;
    culprit.call = 0;
    for (int i = 0; i < surface_most_fields; ++i) {
        world.fields[i].batch = mischievous_batch;
        world.fields[i].gradient = gradient ? mischievous_gradient : NULL;
    }
}

/* Whatever the values were, results are defined. */
static void place(void) {
    static uint32_t before[surface_outputs][surface_most * surface_most_crossings];
    surface_truth truth;
    memset(&truth, 0, sizeof truth);
    truth.size = 16.0;
    memcpy(before, world.out, sizeof before);
    for (int column = 0; column < surface_outputs; ++column) truth.before[column] = before[column];
    const spt_status status = surface_place(&call);
    CHECK_SAY(status == SPT_OK, "%s", spt_status_name(status));
    for (size_t i = 0; i < call.count; ++i) {
        const char *const why = surface_wrong(&call, &truth, i);
        if (why != NULL) CHECK_SAY(0, "index %u: %s", (unsigned)i, why);
    }
}

static size_t differing_indices(void) {
    size_t differing = 0;
    for (size_t i = 0; i < call.count; ++i) {
        int same = 1;
        for (int column = 0; column < surface_outputs; ++column) {
            const size_t words = surface_width(column) / 4;
            same &=
                memcmp(&world.out[column][i * words], &clean[column][i * words], 4 * words) == 0;
        }
        differing += !same;
    }
    return differing;
}

#define FOR_EACH_WAY(door, width, gradient) \
    surface_world_make(&world); \
    for (int door = 0; door < surface_doors; ++door) \
        for (int width = 0; width < STRESS_WIDTHS; ++width) \
            for (int gradient = 0; gradient < 2; ++gradient)

enum { some = 40, calls = 6 };

/* A value that is left out concerns the one that it was for. */
static void A8sb_surface_value_left_unwritten(void) {
    FOR_EACH_WAY(door, width, gradient) {
        size_t ever = 0;
        prepare(door, width, gradient, KEEP_QUIET);
        call.count = some;
        place();
        memcpy(clean, world.out, sizeof clean);
        for (size_t at = 0; at < calls; ++at) {
            prepare(door, width, gradient, LEAVE_ONE);
            call.count = some;
            culprit.at_call = at;
            place();
            const size_t differing = differing_indices();
            CHECK_SAY(differing <= 1, "call %u: %u differ", (unsigned)at, (unsigned)differing);
            ever += differing;
        }
        CHECK(ever > 0 || door == DOOR_OCCLUDED); /* which takes no value for a hit */
    }
}

static void A8sc_surface_nothing_written(void) {
    FOR_EACH_WAY(door, width, gradient) {
        prepare(door, width, gradient, WRITE_NOTHING);
        call.count = some;
        place();
        if (width == 0) memcpy(clean, world.out, sizeof clean);
        CHECK(gradient != 0 || differing_indices() == 0);
        for (size_t i = 0; i < some && door == DOOR_CONVEX; ++i) {
            const int asked = world.out[OUT_EVALUATIONS][i] != 0;
            CHECK(world.out[OUT_OUTCOME][i] == (asked ? SPT_NONFINITE : SPT_MISS));
        }
    }
}

/* So few that no two of them ask for the same point. */
enum { few = 4 };

static void A8sd_surface_padding_spoiled(void) {
    FOR_EACH_WAY(door, width, gradient) {
        for (size_t count = 1; count <= few; count += few - 1) {
            prepare(door, width, gradient, KEEP_QUIET);
            call.count = count;
            place();
            memcpy(clean, world.out, sizeof clean);
            prepare(door, width, gradient, SPOIL_PADDING);
            call.count = count;
            place();
            CHECK(differing_indices() == 0);
        }
    }
}

/* field.h: padding repeats a real point. So a batch asks for no point that one by one are not. */
static void A8se_surface_padding_repeats_points(void) {
    FOR_EACH_WAY(door, width, gradient) {
        prepare(door, width, gradient, KEEP_QUIET);
        call.count = few;
        culprit.known = culprit.strangers = 0;
        for (int i = 0; i < surface_most_fields; ++i) {
            world.fields[i].batch = NULL;
            world.fields[i].point = noting_point;
            if (gradient) world.fields[i].gradient = noting_gradient;
        }
        for (size_t i = 0; i < few; ++i) { /* one by one, for the first of a gradient's points */
            surface_call one = call;
            one.count = 1;
            for (int column = 0; column < surface_inputs; ++column) {
                one.in[column].first = &world.in[column][i];
            }
            for (int column = 0; column < surface_outputs; ++column) {
                one.out[column].first = &world.out[column][i * (surface_width(column) / 4)];
            }
            CHECK(surface_place(&one) == SPT_OK);
        }
        CHECK(culprit.known > 0 && culprit.known < most_points);
        prepare(door, width, gradient, CHECK_POINTS);
        call.count = few;
        place();
        CHECK_SAY(culprit.strangers == 0, "%u unknown points", (unsigned)culprit.strangers);
    }
}

static void A9sb_surface_points_overwritten(void) {
    FOR_EACH_WAY(door, width, gradient) {
        prepare(door, width, gradient, KEEP_QUIET);
        place();
        memcpy(clean, world.out, sizeof clean);
        prepare(door, width, gradient, OVERWRITE_POINTS);
        place();
        CHECK_SAY(differing_indices() == 0, "%u differ", (unsigned)differing_indices());
    }
}

void suite_surface_callbacks(void) {
    RUN(A8sb_surface_value_left_unwritten);
    RUN(A8sc_surface_nothing_written);
    RUN(A8sd_surface_padding_spoiled);
    RUN(A8se_surface_padding_repeats_points);
    RUN(A9sb_surface_points_overwritten);
}
