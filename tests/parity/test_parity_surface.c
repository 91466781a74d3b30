/* SPDX-License-Identifier: MIT
 *
 * Equal bits of surface.h: every call gives the same results on every scene at every width, for
 * every number, order and company of what it is called with, and for both forms of callback. */
#include "check.h"
#include "rules.h"
#include "stress/surface_scene.h"

#include <string.h>

static surface_scene work;
static surface_scene_outputs expected, mixed_out;
static uint32_t mixed_in[surface_inputs][surface_scene_most];
static size_t order[surface_scene_most];
static surface_call call;

static void place(void) {
    const spt_status status = surface_place(&call);
    CHECK_SAY(status == SPT_OK, "%s", spt_status_name(status));
}

static size_t differing(surface_scene_outputs now, const size_t *places) {
    size_t count = 0;
    for (int column = 0; column < surface_outputs; ++column) {
        const size_t words = surface_width(column) / 4;
        if (!SURFACE_HAS(surface_table[call.door].outputs, column)) continue;
        for (size_t i = 0; i < work.count; ++i) {
            const size_t from = places != NULL ? places[i] : i;
            count +=
                memcmp(&now[column][i * words], &expected[column][from * words], 4 * words) != 0;
        }
    }
    return count;
}

static void shuffle(void) {
    for (size_t i = 0; i < work.count; ++i) order[i] = i;
    for (size_t i = work.count - 1; i > 0; --i) {
        const size_t other = check_random() % (i + 1), kept = order[i];
        order[i] = order[other];
        order[other] = kept;
    }
}

/* In another order and in calls of random sizes. */
static void place_divided(void) {
    const surface_call whole = call;
    size_t done = 0;
    shuffle();
    surface_scene_clear(&work, call.door, work.out);
    for (size_t i = 0; i < work.count; ++i) {
        for (int column = 0; column < surface_inputs; ++column) {
            mixed_in[column][i] = work.in[column][order[i]];
        }
        for (int column = 0; column < surface_outputs; ++column) {
            const size_t words = surface_width(column) / 4;
            memcpy(&mixed_out[column][i * words], &work.out[column][order[i] * words], 4 * words);
        }
    }
    while (done < work.count) {
        const size_t wanted = 1 + check_random() % (check_random() % 2 != 0 ? 20 : 200);
        call.count = wanted < work.count - done ? wanted : work.count - done;
        for (int column = 0; column < surface_inputs; ++column) {
            call.in[column].first = &mixed_in[column][done];
        }
        for (int column = 0; column < surface_outputs; ++column) {
            call.out[column].first = &mixed_out[column][done * (surface_width(column) / 4)];
        }
        place();
        done += call.count;
    }
    call = whole;
    CHECK_SAY(differing(mixed_out, order) == 0, "%u differ in other calls",
              (unsigned)differing(mixed_out, order));
}

static void compare_all(surface_door door, void (*change)(void)) {
    surface_scene_call(&call, &work, door, 1);
    change();
    place();
    memcpy(expected, work.out, sizeof expected);
    for (int way = 1; way <= width_count; ++way) { /* the widths but the first, and one point */
        const int lanes = way < width_count ? width_run(widths[way]) : 0;
        check_context("scene %s, %s, %d lanes", work.shown->name, surface_table[door].name, lanes);
        surface_scene_call(&call, &work, door, lanes);
        change();
        place();
        CHECK_SAY(differing(work.out, NULL) == 0, "%u differ", (unsigned)differing(work.out, NULL));
        if (way == width_count - 1 || way == 1) place_divided();
    }
    memcpy(work.out, expected, sizeof expected);
}

static void change_nothing(void) {
}

/* The most expensive scenes get fewer rays. */
static size_t rays_of(const scene *shown) {
    const char *const slow[] = {"mandelbulb", "repeated", "arches", "village", "city"};
    for (size_t i = 0; i < sizeof slow / sizeof *slow; ++i) {
        if (strcmp(shown->name, slow[i]) == 0) return surface_scene_most / 4;
    }
    return surface_scene_most;
}

static void parity_surface_scenes(void) {
    for (size_t i = 0; i < scene_count; ++i) {
        size_t hits = 0;
        surface_scene_make(&work, scenes[i], rays_of(scenes[i]));
        for (size_t j = 0; j < work.count; ++j) hits += work.hits[OUT_OUTCOME][j] == SPT_HIT;
        CHECK_SAY(hits > work.count / 20, "scene %s: %u hits", scenes[i]->name, (unsigned)hits);
        for (int door = 0; door < surface_doors; ++door) {
            if (!surface_scene_has(&work, (surface_door)door)) continue;
            compare_all((surface_door)door, change_nothing);
            surface_scene_go_on(&work, (surface_door)door);
        }
    }
}

/* ---- Every step rule, and what calls may be told --------------------------------------------- */

static const rule *used;
static uint32_t flags;

static void change_settings(void) {
    work.settings.method = used->method();
    work.settings.flags = flags;
    call.rule = flags & 1u ? SPT_NORMAL_TETRAHEDRON : SPT_NORMAL_CENTRAL;
    call.checks = flags & 3u;
    call.smooth = (flags & 1u) != 0;
    call.detail = flags & 1u ? 0.01f : 0.0f;
    call.most_crossings = 1 + (flags & 1u);
}

static void parity_surface_rules(void) {
    static const char *const names[] = {"dodecahedron", "sphere", "primitives"};
    for (size_t i = 0; i < 3; ++i) {
        for (int j = 0; j < rule_count; ++j) {
            const scene *const shown = scene_named(names[i]);
            used = &rules[j];
            if (!rule_allowed(used, shown->flags)) continue;
            surface_scene_make(&work, shown, surface_scene_most / 2);
            for (int door = 0; door < surface_doors; ++door) {
                if (!surface_scene_has(&work, (surface_door)door)) continue;
                flags = j % 2 != 0 ? SPT_SKIP_START : 0;
                if (door == DOOR_CONVEX && j % 3 != 0) flags |= SPT_CHECK_CONVEX;
                compare_all((surface_door)door, change_settings);
                surface_scene_go_on(&work, (surface_door)door);
            }
        }
    }
}

void suite_parity_surface(void) {
    RUN(parity_surface_scenes);
    RUN(parity_surface_rules);
}
