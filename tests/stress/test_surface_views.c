/* SPDX-License-Identifier: MIT
 *
 * Rows F7, F8 and F11 for the calls of surface.h: every count and placement of what is read and
 * written, between guard pages, of any alignment and stride; results left out, or written over what
 * was read; inactive rays. The results must be the same bits throughout. */
#include "stress.h"
#include "stress_guard.h"
#include "surface_results.h"
#include "surface_world.h"

#include <string.h>

static surface_world world;
static surface_call call;
/* From plain arrays, one lane; element i is that of index i whatever the count. */
static uint32_t expected[surface_doors][surface_outputs][surface_most * surface_most_crossings];

static void expect_all(void) {
    surface_world_make(&world);
    for (int door = 0; door < surface_doors; ++door) {
        surface_call_make(&call, &world, (surface_door)door, 1, SURFACE_GRADIENT);
        check_context("%s", surface_table[door].name);
        CHECK(surface_place(&call) == SPT_OK);
        CHECK(surface_faults_seen(&world) == 0);
        memcpy(expected[door], world.out, sizeof world.out);
    }
}

/* Runs the body for every call, width and form of callback. */
typedef struct way {
    int door, width;
    uint32_t form;
    int started;
} way;

static int next_way(way *self) {
    if (self->started) {
        self->form ^= SURFACE_POINT;
        if ((self->form & SURFACE_POINT) == 0 && ++self->width == STRESS_WIDTHS) {
            self->width = 0;
            ++self->door;
        }
    }
    self->started = 1;
    if (self->door == surface_doors) return 0;
    check_context("%s, %u lanes, form %u", surface_table[self->door].name,
                  (unsigned)stress_widths[self->width], (unsigned)self->form);
    surface_call_make(&call, &world, (surface_door)self->door, stress_widths[self->width],
                      self->form);
    return 1;
}

#define FOR_EACH_WAY(one) \
    way one = {0, 0, SURFACE_GRADIENT, 0}; \
    next_way(&one);

static void remake(const way *self) {
    surface_call_make(&call, &world, (surface_door)self->door, stress_widths[self->width],
                      self->form);
}

/* Whether an element is one that the call does not write. */
static int is_left(int door, int column, size_t index) {
    return expected[door][column][index * (surface_width(column) / 4)] == SURFACE_FILL_WORD;
}

/* The elements of an output of the call are those that are expected; or, where a call that does not
 * write one finds something else in it, that may be anything. */
static void compare(int door, int column, size_t count, int but_left) {
    const size_t width = surface_width(column);
    size_t differing = 0;
    for (size_t i = 0; i < count; ++i) {
        if (but_left && is_left(door, column, i)) continue;
        const char *const now =
            (const char *)call.out[column].first + (ptrdiff_t)i * call.out[column].stride;
        differing += memcmp(now, (const char *)expected[door][column] + i * width, width) != 0;
    }
    CHECK_SAY(differing == 0, "output %d: %u of %u differ", column, (unsigned)differing,
              (unsigned)count);
}

static void place_and_check(void) {
    const spt_status status = surface_place(&call);
    CHECK_SAY(status == SPT_OK, "%s", spt_status_name(status));
    CHECK_SAY(surface_faults_seen(&world) == 0, "%u broken promises",
              (unsigned)surface_faults_seen(&world));
}

/* ---- F7: counts and guard pages -------------------------------------------------------------- */

static stress_guard input_memory[surface_inputs], output_memory[surface_outputs];

static int make_memory(void) {
    int made = 1;
    for (int i = 0; i < surface_inputs; ++i) {
        made &= stress_guard_make(&input_memory[i], (surface_most + 1) * 4);
    }
    for (int i = 0; i < surface_outputs; ++i) {
        made &= stress_guard_make(&output_memory[i], (surface_most + 1) * surface_width(i));
    }
    return made;
}

static void free_memory(void) {
    for (int i = 0; i < surface_inputs; ++i) stress_guard_free(&input_memory[i]);
    for (int i = 0; i < surface_outputs; ++i) stress_guard_free(&output_memory[i]);
}

static void place_guarded(const way *self, size_t count, size_t offset, int top) {
    const surface_facts *const facts = &surface_table[self->door];
    remake(self);
    call.count = count;
    for (int column = 0; column < surface_inputs; ++column) {
        const stress_guard *const guard = &input_memory[column];
        unsigned char *const first =
            top ? (unsigned char *)stress_guard_top(guard, 4 * count + offset)
                : guard->first + offset;
        call.in[column].first = SURFACE_HAS(facts->inputs, column) ? first : NULL;
        if (call.in[column].first == NULL) continue;
        memset(guard->first, 0xff, guard->size); /* NaN */
        memcpy(first, world.in[column], 4 * count);
    }
    for (int column = 0; column < surface_outputs; ++column) {
        const stress_guard *const guard = &output_memory[column];
        const size_t bytes = surface_width(column) * count;
        unsigned char *const first =
            top ? (unsigned char *)stress_guard_top(guard, bytes + offset) : guard->first + offset;
        call.out[column].first = SURFACE_HAS(facts->outputs, column) ? first : NULL;
        if (call.out[column].first == NULL) continue;
        memset(guard->first, surface_fill, guard->size);
        memcpy(first, world.out[column], bytes);
    }
    place_and_check();
    CHECK(count != 0 || surface_calls_seen(&world) == 0);
    for (int column = 0; column < surface_outputs; ++column) {
        if (call.out[column].first == NULL) continue;
        compare(self->door, column, count, 0);
        CHECK_SAY(stress_guard_is_filled(&output_memory[column], call.out[column].first,
                                         surface_width(column) * count, surface_fill),
                  "output %d of %u: written beside it", column, (unsigned)count);
    }
}

static void F7sa_surface_counts_between_guard_pages(void) {
    static const size_t counts[] = {0, 1, 15, 16, 17, 255, 256, 257};
    size_t turn = 0;
    if (!make_memory()) {
        check_skip("F7sa: no guard pages here");
        return;
    }
    expect_all();
    for (FOR_EACH_WAY(one)) {
        for (int i = 0; i < 8; ++i) {
            for (int top = 0; top < 2; ++top) place_guarded(&one, counts[i], turn++ % 4, top);
            ++turn; /* so that each offset is met at either end */
        }
    }
    free_memory();
}

/* ---- F8: strides and alignment --------------------------------------------------------------- */

enum { strided_count = 65, widest_step = 64 };

static void place_strided(const way *self, ptrdiff_t step, size_t shift) {
    static unsigned char in[surface_inputs][strided_count * widest_step + 8];
    static unsigned char out[surface_outputs][strided_count * widest_step + 8];
    const size_t size = (size_t)(step < 0 ? -step : step);
    const size_t first = step < 0 ? (strided_count - 1) * size + shift : shift;
    remake(self);
    call.count = strided_count;
    memset(out, surface_fill, sizeof out);
    for (int column = 0; column < surface_inputs; ++column) {
        unsigned char *const start = in[column] + first;
        call.in[column].first = start;
        call.in[column].stride = step;
        for (ptrdiff_t i = 0; i < strided_count; ++i) {
            memcpy(start + i * step, &world.in[column][i], 4);
        }
    }
    for (int column = 0; column < surface_outputs; ++column) {
        unsigned char *const start = out[column] + first;
        const size_t words = surface_width(column) / 4;
        if (size < 4 * words) continue; /* stays plain */
        call.out[column].first = start;
        call.out[column].stride = step;
        for (ptrdiff_t i = 0; i < strided_count; ++i) {
            memcpy(start + i * step, &world.out[column][(size_t)i * words], 4 * words);
        }
    }
    place_and_check();
    for (int column = 0; column < surface_outputs; ++column) {
        if (!SURFACE_HAS(surface_table[self->door].outputs, column)) continue;
        compare(self->door, column, strided_count, 0);
        int clean = 1;
        for (size_t i = 0; i < strided_count && size >= surface_width(column); ++i) {
            for (size_t gap = surface_width(column); gap < size; ++gap) {
                clean &= out[column][shift + i * size + gap] == surface_fill;
            }
        }
        CHECK(clean);
    }
}

static void F8sa_surface_strides_and_alignment(void) {
    static const ptrdiff_t strides[] = {4, 32, 37, -4, -41, 64};
    size_t turn = 0;
    expect_all();
    for (FOR_EACH_WAY(one)) {
        for (int i = 0; i < 6; ++i) place_strided(&one, strides[i], turn++ % 4);
        ++turn;
    }
}

/* The crossings of a ray far apart, those of a later ray between them. */
static void F8sb_surface_crossings_by_planes(void) {
    expect_all();
    for (int width = 0; width < STRESS_WIDTHS; ++width) {
        static uint32_t planes[surface_most_crossings][surface_most];
        size_t differing = 0;
        surface_call_make(&call, &world, DOOR_CROSSINGS, stress_widths[width], 0);
        memset(planes, surface_fill, sizeof planes);
        call.out[OUT_CROSSING].first = planes[surface_most_crossings - 1];
        call.out[OUT_CROSSING].stride = 4;
        call.crossing_step = -(ptrdiff_t)sizeof planes[0];
        place_and_check();
        for (size_t i = 0; i < surface_most * surface_most_crossings; ++i) {
            const size_t plane = surface_most_crossings - 1 - i % surface_most_crossings;
            differing += planes[plane][i / surface_most_crossings] !=
                         expected[DOOR_CROSSINGS][OUT_CROSSING][i];
        }
        CHECK_SAY(differing == 0, "%u differ", (unsigned)differing);
    }
}

/* ---- Sinks ----------------------------------------------------------------------------------- */

/* Each result that need not be there: without it, and without the others. None changes by it, and
 * what is not asked for is not written. */
static void F8sc_surface_sinks_left_out(void) {
    expect_all();
    for (FOR_EACH_WAY(one)) {
        const surface_facts *const facts = &surface_table[one.door];
        const uint32_t kept = facts->outputs_needed | facts->outputs_kept;
        const uint32_t choices = facts->outputs & ~kept;
        for (int column = 0; column < surface_outputs; ++column) {
            if (!SURFACE_HAS(choices, column)) continue;
            for (int alone = 0; alone < 2; ++alone) {
                const uint32_t there =
                    alone ? kept | SURFACE_BIT(column) : facts->outputs & ~SURFACE_BIT(column);
                remake(&one);
                call.count = 33;
                for (int other = 0; other < surface_outputs; ++other) {
                    if (!SURFACE_HAS(there, other)) call.out[other].first = NULL;
                }
                place_and_check();
                for (int other = 0; other < surface_outputs; ++other) {
                    if (SURFACE_HAS(facts->outputs & there, other)) compare(one.door, other, 33, 0);
                }
            }
        }
    }
}

/* A sink that lies on a column of the same ray, point or body. */
typedef struct overlay {
    surface_door door;
    int output, input;
} overlay;

static const overlay overlays[] = {
    {DOOR_OFFSET, OUT_VECTOR, IN_ORIGIN},         {DOOR_OFFSET, OUT_VECTOR + 1, IN_ORIGIN + 1},
    {DOOR_OFFSET, OUT_VECTOR + 2, IN_ORIGIN + 2}, {DOOR_OFFSET, OUT_NEW_PATH, IN_PATH},
    {DOOR_OFFSET, OUT_START, IN_CROSS},           {DOOR_CONVEX, OUT_T, IN_T_MAX},
    {DOOR_CONVEX, OUT_RESIDUAL, IN_T_MIN},        {DOOR_CONVEX, OUT_OUTCOME, IN_ACTIVE},
    {DOOR_CONVEX, OUT_EVALUATIONS, IN_PATH},      {DOOR_CONVEX, OUT_FLAGS, IN_ORIGIN},
    {DOOR_CONVEX, OUT_CANDIDATE_T, IN_DIRECTION}, {DOOR_OCCLUDED, OUT_ANSWER, IN_ACTIVE},
    {DOOR_CROSSINGS, OUT_NUMBER, IN_ACTIVE},      {DOOR_CROSSINGS, OUT_INSIDE, IN_ORIGIN},
    {DOOR_CROSSINGS, OUT_THICKNESS, IN_T_MAX},    {DOOR_CROSSINGS, OUT_ENDED, IN_PATH},
    {DOOR_SHADOW, OUT_ANSWER, IN_TANGENT},        {DOOR_AMBIENT, OUT_ANSWER, IN_NORMAL},
    {DOOR_COLLIDE, OUT_VECTOR, IN_POINT},         {DOOR_COLLIDE, OUT_VECTOR + 1, IN_POINT + 1},
    {DOOR_COLLIDE, OUT_ANSWER, IN_RADIUS},        {DOOR_COLLIDE, OUT_PLACE, IN_TO},
    {DOOR_COLLIDE, OUT_WHICH, IN_TO + 1}};

static void F8sd_surface_sinks_on_columns(void) {
    static uint32_t kept[surface_inputs][surface_most];
    expect_all();
    memcpy(kept, world.in, sizeof kept);
    for (FOR_EACH_WAY(one)) {
        for (size_t i = 0; i < sizeof overlays / sizeof *overlays; ++i) {
            const int input = overlays[i].input, output = overlays[i].output;
            if ((int)overlays[i].door == one.door) call.out[output].first = world.in[input];
        }
        place_and_check();
        for (int column = 0; column < surface_outputs; ++column) {
            if (SURFACE_HAS(surface_table[one.door].outputs, column)) {
                compare(one.door, column, surface_most, 1);
            }
        }
        memcpy(world.in, kept, sizeof kept);
    }
}

/* ---- F11: inactive rays ---------------------------------------------------------------------- */

/* Rays that are off hold NaN, or lie where a callback tells that nobody should ask; what their hits
 * hold is junk. */
static void switch_off(uint32_t part, unsigned char off[surface_most]) {
    for (size_t i = 0; i < surface_most; ++i) {
        off[i] = (check_random() & 3u) < part;
        if (!off[i]) continue;
        for (int column = 0; column < surface_inputs; ++column) {
            world.in[column][i] = surface_bits(i % 2 != 0 ? stress_nan() : 1e6f);
        }
        world.in[IN_ACTIVE][i] = 0;
        for (int column = 0; column < surface_outputs; ++column) {
            const size_t words = surface_width(column) / 4;
            memset(&world.out[column][i * words], surface_fill, 4 * words);
        }
        world.out[OUT_OUTCOME][i] = SPT_HIT;
        world.out[OUT_COMPONENT][i] = 0;
    }
}

static void check_off(const way *self, const unsigned char off[surface_most]) {
    static uint32_t before[surface_outputs][surface_most * surface_most_crossings];
    surface_truth truth;
    size_t changed = 0, differing = 0;
    memset(&truth, 0, sizeof truth);
    memcpy(before, world.out, sizeof before);
    for (int column = 0; column < surface_outputs; ++column) truth.before[column] = before[column];
    place_and_check();
    for (size_t i = 0; i < surface_most; ++i) {
        if (off[i]) changed += !surface_untouched(&call, &truth, i);
        for (int column = 0; column < surface_outputs && !off[i]; ++column) {
            const size_t width = surface_width(column), words = width / 4;
            if (!SURFACE_HAS(surface_table[self->door].outputs, column)) continue;
            differing += memcmp(&world.out[column][i * words],
                                &expected[self->door][column][i * words], width) != 0;
        }
    }
    CHECK_SAY(changed == 0, "%u inactive rays were written", (unsigned)changed);
    CHECK_SAY(differing == 0, "%u results of active rays differ", (unsigned)differing);
}

static void F11sa_surface_inactive_rays(void) {
    static uint32_t kept[surface_inputs][surface_most];
    unsigned char off[surface_most];
    expect_all();
    memcpy(kept, world.in, sizeof kept);
    for (FOR_EACH_WAY(one)) {
        if (!SURFACE_HAS(surface_table[one.door].inputs, IN_ACTIVE)) continue;
        for (uint32_t part = 1; part <= 4; ++part) { /* a quarter, half ... of the rays are off */
            remake(&one);
            switch_off(part, off);
            check_off(&one, off);
            CHECK(part != 4 || surface_calls_seen(&world) == 0);
            memcpy(world.in, kept, sizeof kept);
        }
    }
}

void suite_surface_views(void) {
    RUN(F7sa_surface_counts_between_guard_pages);
    RUN(F8sa_surface_strides_and_alignment);
    RUN(F8sb_surface_crossings_by_planes);
    RUN(F8sc_surface_sinks_left_out);
    RUN(F8sd_surface_sinks_on_columns);
    RUN(F11sa_surface_inactive_rays);
}
