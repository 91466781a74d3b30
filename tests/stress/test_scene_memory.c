/* SPDX-License-Identifier: MIT
 *
 * Rows F7, F8 and F11 for scenes: every count of rays, every placement of rays, results, scene and
 * workspace between guard pages; workspaces of any alignment, contents and past. The results must
 * be the same bits throughout. */
#include "test_scene_cases.h"
#include "stress_guard.h"

#include <string.h>

enum { most = 257, inputs = 10, outputs = 9 };
enum { path_column = 8, active_column };

static const size_t counts[] = {0, 1, 3, 4, 5, 7, 8, 9, 15, 16, 17, 33, 255, 256, 257};
enum { count_of_counts = sizeof counts / sizeof counts[0] };

static spt_ray rays[most];
static spt_hit expected[most], found[most];

static void make_rays(void) {
    for (size_t i = 0; i < most; ++i) rays[i] = union_ray(i);
}

static spt_column *column_of(spt_rays *view, int column) {
    spt_column *const rest[] = {&view->t_min, &view->t_max, &view->path, &view->active};
    if (column < 3) return &view->origin[column];
    return column < 6 ? &view->direction[column - 3] : rest[column - 6];
}

static spt_sink *sink_of(spt_hits *hits, int column) {
    spt_sink *const all[outputs] = {&hits->t,           &hits->residual,        &hits->outcome,
                                    &hits->evaluations, &hits->flags,           &hits->component,
                                    &hits->candidate_t, &hits->candidate_ratio, &hits->fallbacks};
    return all[column];
}

static void write_input(unsigned char *to, int column, size_t ray) {
    const float values[] = {rays[ray].origin[0],    rays[ray].origin[1],    rays[ray].origin[2],
                            rays[ray].direction[0], rays[ray].direction[1], rays[ray].direction[2],
                            rays[ray].t_min,        rays[ray].t_max,        0.0f};
    static const int32_t active = -1;
    memcpy(to, column == active_column ? (const void *)&active : &values[column], 4);
}

static size_t differing(const spt_hit *hits, size_t count) {
    size_t differ = 0;
    for (size_t i = 0; i < count; ++i) differ += !stress_same_hit(&hits[i], &expected[i]);
    return differ;
}

/* ---- F7: counts and guard pages ------------------------------------------------------------ */

static stress_guard input_memory[inputs], output_memory[outputs], work_memory, scene_memory[4];

static int make_memory(size_t workspace) {
    int made = stress_guard_make(&work_memory, workspace);
    for (int i = 0; i < inputs; ++i) made &= stress_guard_make(&input_memory[i], 4 * most);
    for (int i = 0; i < outputs; ++i) made &= stress_guard_make(&output_memory[i], 4 * most);
    for (int i = 0; i < 4; ++i) made &= stress_guard_make(&scene_memory[i], 1024);
    return made;
}

static void free_memory(void) {
    stress_guard_free(&work_memory);
    for (int i = 0; i < inputs; ++i) stress_guard_free(&input_memory[i]);
    for (int i = 0; i < outputs; ++i) stress_guard_free(&output_memory[i]);
    for (int i = 0; i < 4; ++i) stress_guard_free(&scene_memory[i]);
}

/* Bytes against the upper or the lower guard. */
static void *place(const stress_guard *guard, size_t size, int top) {
    return top ? stress_guard_top(guard, size) : guard->first;
}

/* The scene's arrays against the upper guards. */
static spt_scene place_scene(const union_scene *world) {
    static const spt_zone zone = {{30.0f, 0.0f, 0.0f}, 1.0f, -1};
    spt_scene scene = world->scene;
    spt_field *const fields = place(&scene_memory[0], sizeof world->fields, 1);
    spt_bound *const bounds = place(&scene_memory[1], sizeof world->bounds, 1);
    int32_t *const materials = place(&scene_memory[2], sizeof world->materials, 1);
    spt_zone *const zones = place(&scene_memory[3], sizeof zone, 1);
    memcpy(fields, world->fields, sizeof world->fields);
    memcpy(bounds, world->bounds, sizeof world->bounds);
    memcpy(materials, world->materials, sizeof world->materials);
    *zones = zone; /* none of the rays comes near it */
    fields[0].bound = &bounds[0];
    fields[1].bound = &bounds[1];
    scene.fields = fields;
    scene.materials = materials;
    scene.zones = zones;
    scene.zone_count = 1;
    return scene;
}

static void trace_guarded(const spt_scene *scene, const spt_settings *settings, size_t count,
                          int top) {
    const size_t size = spt_scene_workspace(scene, settings);
    unsigned char *const workspace = place(&work_memory, size, top);
    unsigned char *out[outputs];
    spt_rays view;
    spt_hits hits;
    memset(work_memory.first, 0xff, work_memory.size);
    for (int column = 0; column < inputs; ++column) {
        unsigned char *const first = place(&input_memory[column], 4 * count, top);
        memset(input_memory[column].first, 0xff, input_memory[column].size); /* NaN */
        for (size_t i = 0; i < count; ++i) write_input(first + 4 * i, column, i);
        column_of(&view, column)->first = first;
        column_of(&view, column)->stride = 4;
    }
    for (int column = 0; column < outputs; ++column) {
        out[column] = place(&output_memory[column], 4 * count, top);
        memset(output_memory[column].first, 0xa5, output_memory[column].size);
        sink_of(&hits, column)->first = out[column];
        sink_of(&hits, column)->stride = 4;
    }
    CHECK(spt_scene_trace(scene, settings, count, &view, &hits, workspace, size, NULL) == SPT_OK);
    CHECK(stress_guard_is_filled(&work_memory, workspace, size, 0xff));
    for (int column = 0; column < outputs; ++column) {
        int same = 1;
        CHECK(stress_guard_is_filled(&output_memory[column], out[column], 4 * count, 0xa5));
        for (size_t i = 0; i < count; ++i) {
            same &= memcmp(out[column] + 4 * i, (const char *)&expected[i] + 4 * column, 4) == 0;
        }
        CHECK_SAY(same, "column %d of %u rays", column, (unsigned)count);
    }
}

static void F7c_scene_counts_between_guard_pages(void) {
    static union_scene world;
    make_rays();
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        union_base(&world, &way);
        const spt_settings settings = union_settings(&way);
        union_trace(&way, &world.scene, world.parts, &settings, most, rays, expected);
        spt_scene scene = world.scene;
        scene.zone_count = 1; /* the workspace may grow with it */
        scene.zones = &(spt_zone){{30.0f, 0.0f, 0.0f}, 1.0f, -1};
        if (!make_memory(spt_scene_workspace(&scene, &settings))) {
            check_skip("F7c: no guard pages here");
            return;
        }
        scene = place_scene(&world);
        for (int i = 0; i < count_of_counts; ++i) {
            trace_guarded(&scene, &settings, counts[i], 0);
            trace_guarded(&scene, &settings, counts[i], 1);
        }
        free_memory();
    }
}

/* ---- The workspace ------------------------------------------------------------------------- */

static spt_status trace_in(const spt_scene *scene, const spt_settings *settings, void *workspace,
                           size_t size) {
    const spt_rays in = spt_rays_of(rays);
    const spt_hits out = spt_hits_of(found);
    memset(found, 0xa5, sizeof found);
    return spt_scene_trace(scene, settings, most, &in, &out, workspace, size, NULL);
}

static void F8b_scene_workspace_of_any_alignment(void) {
    enum { fill = 0x77, alignments = 64 };
    static union_scene world;
    make_rays();
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_ONCE); stress_next(&way);) {
        union_base(&world, &way);
        const spt_settings settings = union_settings(&way);
        union_trace(&way, &world.scene, world.parts, &settings, most, rays, expected);
        const size_t size = spt_scene_workspace(&world.scene, &settings);
        unsigned char *const memory = union_memory(size + 2 * alignments, fill);
        CHECK(memory != NULL);
        if (memory == NULL) return;
        for (size_t shift = 0; shift < alignments; ++shift) {
            CHECK(trace_in(&world.scene, &settings, memory + shift, size) == SPT_OK);
            CHECK_SAY(differing(found, most) == 0, "%u rays differ, %u bytes off",
                      (unsigned)differing(found, most), (unsigned)shift);
            size_t written = 0;
            for (size_t i = size + shift; i < size + 2 * alignments; ++i) {
                written += memory[i] != fill;
            }
            CHECK_SAY(written == 0, "%u bytes behind it", (unsigned)written);
        }
    }
}

/* What lies in the workspace does not matter: any byte, or what another scene left there. A
 * workspace that is larger than asked for is as good. */
static void F8c_scene_workspace_with_a_past(void) {
    static union_scene world, other;
    static const int fills[] = {0x00, 0x01, 0x3f, 0x7f, 0x80, 0xff};
    make_rays();
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        union_base(&world, &way);
        union_base(&other, &way);
        const spt_settings settings = union_settings(&way);
        spt_settings other_settings = settings;
        union_trace(&way, &world.scene, world.parts, &settings, most, rays, expected);
        const size_t size = spt_scene_workspace(&world.scene, &settings);
        for (size_t i = 0; i < sizeof fills / sizeof *fills; ++i) {
            unsigned char *const memory = union_memory(size, fills[i]);
            CHECK(trace_in(&world.scene, &settings, memory, size) == SPT_OK);
            CHECK_SAY(differing(found, most) == 0, "bytes of %x", (unsigned)fills[i]);
        }
        unsigned char *const memory = union_memory(2 * size, 0);
        other.scene.count = 2; /* fewer components: everything lies elsewhere */
        other_settings.budget = 3;
        other_settings.flags = SPT_SKIP_START;
        CHECK(trace_in(&other.scene, &other_settings, memory, size) == SPT_OK);
        CHECK(differing(found, most) > most / 2);
        CHECK(trace_in(&world.scene, &settings, memory, size) == SPT_OK);
        CHECK_SAY(differing(found, most) == 0, "after another scene");
        CHECK(trace_in(&world.scene, &settings, memory, 2 * size) == SPT_OK);
        CHECK_SAY(differing(found, most) == 0, "in twice the size");
    }
}

/* ---- F11: rays that are not active --------------------------------------------------------- */

static void F11b_scene_inactive_rays(void) {
    static spt_ray mixed[most];
    static int32_t active[most];
    static union_scene world;
    make_rays();
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        union_base(&world, &way);
        const spt_settings settings = union_settings(&way);
        union_trace(&way, &world.scene, world.parts, &settings, most, rays, expected);
        spt_rays view = spt_rays_of(mixed);
        const spt_hits hits = spt_hits_of(found);
        const size_t size = spt_scene_workspace(&world.scene, &settings);
        view.active.first = active;
        view.active.stride = sizeof *active;
        for (int round = 0; round < 3; ++round) {
            spt_statistics statistics = spt_statistics_default();
            uint64_t live = 0;
            for (size_t i = 0; i < most; ++i) {
                active[i] = round < 2 && check_random() % 3 != 0 ? (round == 0 ? 1 : -1) : 0;
                mixed[i] = rays[i];
                if (active[i] == 0) memset(&mixed[i], 0xff, sizeof mixed[i]); /* NaN */
                live += active[i] != 0;
            }
            for (int i = 0; i < union_parts; ++i) world.parts[i].calls = 0;
            memset(found, 0xa5, sizeof found);
            CHECK(spt_scene_trace(&world.scene, &settings, most, &view, &hits,
                                  union_memory(size, 0xff), size, &statistics) == SPT_OK);
            CHECK(statistics.rays == live);
            size_t wrong = 0, calls = 0;
            for (size_t i = 0; i < most; ++i) {
                static const unsigned char untouched = 0xa5;
                int kept = 1;
                for (size_t k = 0; k < sizeof found[i]; ++k) {
                    kept &= ((const unsigned char *)&found[i])[k] == untouched;
                }
                wrong += active[i] != 0 ? !stress_same_hit(&found[i], &expected[i]) : !kept;
            }
            for (int i = 0; i < union_parts; ++i) {
                CHECK(world.parts[i].faults == 0);
                calls += world.parts[i].calls;
            }
            CHECK_SAY(wrong == 0, "%u rays are wrong", (unsigned)wrong);
            CHECK(live != 0 || calls == 0);
        }
    }
}

void suite_scene_memory(void) {
    RUN(F7c_scene_counts_between_guard_pages);
    RUN(F8b_scene_workspace_of_any_alignment);
    RUN(F8c_scene_workspace_with_a_past);
    RUN(F11b_scene_inactive_rays);
}
