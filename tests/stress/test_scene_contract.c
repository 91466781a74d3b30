/* SPDX-License-Identifier: MIT
 *
 * Row F10 for scenes: wrong arguments of spt_scene_trace() and spt_scene_workspace(). Each must be
 * refused with nothing written, the workspace included, and no callback called. Memory is in
 * test_scene_memory.c. */
#include "test_scene_cases.h"
#include "stress_guard.h"

#include <stdlib.h>
#include <string.h>

/* One call with everything it needs, to be spoilt in one place. */
typedef struct scene_call {
    union_scene world; /* points into itself: calls are not copied */
    spt_zone zones[2];
    spt_settings settings;
    spt_statistics statistics;
    spt_ray ray[2];
    spt_hit hit[2];
    spt_rays rays;
    spt_hits hits;
    size_t count;
    void *workspace;
    size_t workspace_size;
    /* What is handed over; NULL where the test wants NULL. */
    const spt_scene *given_scene;
    const spt_settings *given_settings;
    const spt_rays *given_rays;
    const spt_hits *given_hits;
    spt_statistics *given_statistics;
} scene_call;

enum { workspace_fill = 0x3c };

static scene_call self;

static void prepare(const stress_way *way) {
    static unsigned char *workspace;
    static size_t size;
    union_base(&self.world, way);
    memset(self.zones, 0, sizeof self.zones);
    self.zones[0].center[2] = 3.0f;
    self.zones[0].radius = 1.0f;
    self.zones[0].component = -1;
    self.zones[1] = self.zones[0];
    self.zones[1].component = union_parts - 1;
    self.world.scene.zones = self.zones;
    self.world.scene.zone_count = 2;
    self.settings = union_settings(way);
    self.statistics = spt_statistics_default();
    self.ray[0] = self.ray[1] = stress_base().ray;
    memset(self.hit, 0x5a, sizeof self.hit);
    self.rays = spt_rays_of(self.ray);
    self.hits = spt_hits_of(self.hit);
    self.count = 2;
    self.workspace_size = spt_scene_workspace(&self.world.scene, &self.settings);
    if (workspace == NULL || size < self.workspace_size) {
        free(workspace);
        size = self.workspace_size;
        workspace = malloc(size + 1);
        memset(workspace, workspace_fill, size + 1);
    }
    self.workspace = workspace;
    self.given_scene = &self.world.scene;
    self.given_settings = &self.settings;
    self.given_rays = &self.rays;
    self.given_hits = &self.hits;
    self.given_statistics = &self.statistics;
}

static spt_status place_call(void) {
    return spt_scene_trace(self.given_scene, self.given_settings, self.count, self.given_rays,
                           self.given_hits, self.workspace, self.workspace_size,
                           self.given_statistics);
}

/* The parts count their calls, so that equal bytes also mean that no callback was called. */
static void refuse(spt_status expected, const char *why) {
    static unsigned char before[sizeof self];
    memcpy(before, &self, sizeof self);
    const spt_status status = place_call();
    CHECK_SAY(status == expected, "%s: %s", why, spt_status_name(status));
    CHECK_SAY(memcmp(before, &self, sizeof self) == 0, "%s: something was written", why);
}

/* A scene or settings that break their rules: there is no workspace for them either. */
static void refuse_scene(const char *why) {
    refuse(SPT_BAD_ARGUMENT, why);
    CHECK_SAY(spt_scene_workspace(self.given_scene, self.given_settings) == 0, "%s: workspace",
              why);
    self.count = 0; /* they are checked even where there is nothing to trace */
    refuse(SPT_BAD_ARGUMENT, why);
}

#define REFUSE(spoil) (prepare(&way), (void)(spoil), refuse(SPT_BAD_ARGUMENT, #spoil))
#define REFUSE_SCENE(spoil) (prepare(&way), (void)(spoil), refuse_scene(#spoil))
#define REFUSE_SMALL(spoil) (prepare(&way), (void)(spoil), refuse(SPT_BUFFER_TOO_SMALL, #spoil))

#define FOR_EACH_WAY \
    stress_way way = stress_ways(STRESS_CONVEX | STRESS_ONCE); \
    stress_next(&way);

static void F10f_scene_null_pointers(void) {
    for (FOR_EACH_WAY) {
        prepare(&way);
        CHECK(place_call() == SPT_OK && self.hit[1].outcome == SPT_HIT);
        REFUSE_SCENE(self.given_scene = NULL);
        REFUSE_SCENE(self.given_settings = NULL);
        REFUSE_SCENE(self.world.scene.fields = NULL);
        REFUSE_SCENE(self.settings.method = NULL);
        REFUSE_SCENE(self.world.scene.zones = NULL);
        REFUSE(self.given_rays = NULL);
        REFUSE(self.given_hits = NULL);
        for (int axis = 0; axis < 3; ++axis) {
            REFUSE(self.rays.origin[axis].first = NULL);
            REFUSE(self.rays.direction[axis].first = NULL);
        }
        for (int i = 0; i < union_parts; ++i) {
            spt_field *const field = &self.world.fields[i];
            REFUSE_SCENE((field->batch = NULL, field->point = NULL));
        }
        prepare(&way); /* what may be absent */
        self.given_statistics = NULL;
        self.world.scene.materials = NULL;
        self.world.scene.zones = NULL;
        self.world.scene.zone_count = 0;
        CHECK(place_call() == SPT_OK && self.hit[1].outcome == SPT_HIT);
        prepare(&way);
        self.count = 0;
        self.given_rays = NULL;
        self.given_hits = NULL;
        CHECK(place_call() == SPT_OK);
        for (int i = 0; i < union_parts; ++i) CHECK(self.world.parts[i].calls == 0);
    }
}

static void F10g_scene_sizes_and_counts(void) {
    static const size_t counts[] = {SIZE_MAX, SIZE_MAX / 2, SIZE_MAX / 4, SIZE_MAX / 32 + 1};
    for (FOR_EACH_WAY) {
        REFUSE_SCENE(self.world.scene.struct_size = 0);
        REFUSE_SCENE(self.world.scene.struct_size -= 1);
        REFUSE_SCENE(self.settings.struct_size = 0);
        REFUSE_SCENE(self.settings.struct_size -= 1);
        REFUSE(self.statistics.struct_size = 0);
        for (int i = 0; i < union_parts; ++i) {
            REFUSE_SCENE(self.world.fields[i].struct_size = 0);
            REFUSE_SCENE(self.world.fields[i].struct_size -= 1);
        }
        REFUSE_SCENE(self.world.fields[3].struct_size += 8); /* not the same in all fields */
        REFUSE_SCENE(self.world.scene.count = 0);
        REFUSE_SCENE(self.world.scene.count = ((size_t)1 << 23) + 1);
        REFUSE_SCENE(self.world.scene.count = SIZE_MAX);
        REFUSE_SCENE(self.world.scene.zone_count = ((size_t)1 << 16) + 1);
        REFUSE_SCENE(self.world.scene.zone_count = SIZE_MAX);
        for (int i = 0; i < 4; ++i) REFUSE(self.count = counts[i]);
        REFUSE_SMALL(self.workspace_size -= 1);
        REFUSE_SMALL(self.workspace_size = 0);
    }
}

/* NULL is no workspace, whatever its size is said to be. */
static void F10h_scene_no_workspace(void) {
    for (FOR_EACH_WAY) {
        prepare(&way);
        void *const workspace = self.workspace;
        self.workspace = NULL;
        static unsigned char before[sizeof self];
        memcpy(before, &self, sizeof self);
        CHECK(place_call() != SPT_OK);
        CHECK(memcmp(before, &self, sizeof self) == 0);
        self.workspace_size = 0;
        memcpy(before, &self, sizeof self);
        CHECK(place_call() != SPT_OK);
        CHECK(memcmp(before, &self, sizeof self) == 0);
        self.workspace = workspace;
    }
}

/* One byte too small: not a byte of the workspace is written. */
static void F10i_scene_small_workspace_is_not_written(void) {
    for (FOR_EACH_WAY) {
        prepare(&way);
        unsigned char *const memory = malloc(self.workspace_size);
        CHECK(memory != NULL);
        if (memory == NULL) return;
        memset(memory, workspace_fill, self.workspace_size);
        self.workspace = memory;
        self.workspace_size -= 1;
        refuse(SPT_BUFFER_TOO_SMALL, "one byte too small");
        self.workspace_size += 1;
        self.settings.epsilon = 0.0f;
        refuse(SPT_BAD_ARGUMENT, "epsilon");
        size_t kept = 0;
        while (kept < self.workspace_size && memory[kept] == workspace_fill) ++kept;
        CHECK_SAY(kept == self.workspace_size, "byte %u was written", (unsigned)kept);
        free(memory);
    }
}

static void F10j_scene_numbers_and_flags(void) {
    static const uint32_t lanes[] = {2, 3, 5, 7, 9, 15, 17, 32, 0xffffffffu};
    const float nan = stress_nan(), infinity = stress_infinity();
    for (FOR_EACH_WAY) {
        for (int i = 0; i < 9; ++i) REFUSE_SCENE(self.settings.max_lanes = lanes[i]);
        for (int bit = 5; bit < 32; ++bit) REFUSE_SCENE(self.settings.flags = (uint32_t)1 << bit);
        REFUSE_SCENE(self.settings.epsilon = nan);
        REFUSE_SCENE(self.settings.pixel_radius = -1.0f);
        REFUSE_SCENE(self.settings.size = infinity);
        REFUSE_SCENE(self.settings.relaxation = 2.0f);
        for (int i = 0; i < union_parts; ++i) {
            REFUSE_SCENE(self.world.fields[i].lipschitz = 0.0f);
            REFUSE_SCENE(self.world.fields[i].lipschitz = nan);
            REFUSE_SCENE(self.world.fields[i].lipschitz = infinity);
            REFUSE_SCENE(self.world.fields[i].flags |= 2u);
            REFUSE_SCENE(self.world.fields[i].flags |= 0x80000000u);
        }
        REFUSE_SCENE(self.world.bounds[0].radius = 0.0f);
        REFUSE_SCENE(self.world.bounds[0].center[1] = nan);
        REFUSE_SCENE(self.world.bounds[1].low[0] = infinity);
        REFUSE_SCENE(self.world.bounds[1].low[2] = self.world.bounds[1].high[2] + 1.0f);
        REFUSE_SCENE(self.world.bounds[1].kind = 77);
        REFUSE_SCENE(self.world.bounds[1].struct_size = 0);
        /* One component that is not declared convex has no licence for the secant. */
        REFUSE_SCENE((self.settings.method = spt_convex(), self.world.fields[2].flags = 0));
    }
}

static void F10k_scene_zones(void) {
    const float bad[] = {stress_nan(), stress_infinity(), -stress_infinity()};
    const float radii[] = {0.0f, -0.0f, -1.0f, stress_nan(), stress_infinity()};
    for (FOR_EACH_WAY) {
        for (int zone = 0; zone < 2; ++zone) {
            for (int i = 0; i < 9; ++i) REFUSE_SCENE(self.zones[zone].center[i / 3] = bad[i % 3]);
            for (int i = 0; i < 5; ++i) REFUSE_SCENE(self.zones[zone].radius = radii[i]);
            REFUSE_SCENE(self.zones[zone].component = -2);
            REFUSE_SCENE(self.zones[zone].component = union_parts);
            REFUSE_SCENE(self.zones[zone].component = INT32_MAX);
            REFUSE_SCENE(self.zones[zone].component = INT32_MIN);
        }
    }
}

static spt_sink *sink(spt_hits *hits, int index) {
    spt_sink *const all[] = {&hits->t,           &hits->residual,        &hits->outcome,
                             &hits->evaluations, &hits->flags,           &hits->component,
                             &hits->candidate_t, &hits->candidate_ratio, &hits->fallbacks};
    return all[index];
}

static void F10l_scene_sinks(void) {
    for (FOR_EACH_WAY) {
        for (int i = 0; i < 9; ++i) {
            REFUSE(sink(&self.hits, i)->stride = 0);
            prepare(&way);
            sink(&self.hits, i)->stride = 0; /* one ray has no second result to overwrite it */
            self.count = 1;
            CHECK(place_call() == SPT_OK && self.hit[0].outcome == SPT_HIT);
            prepare(&way);
            *sink(&self.hits, i) = (spt_sink){NULL, 0}; /* absent: its stride does not matter */
            CHECK(place_call() == SPT_OK);
        }
    }
}

/* ---- Structures longer than this library knows ---------------------------------------------- */

enum { kinds_of_structure = 4, future = 4096 };

/* The known part lies against the upper guard: whoever reads the rest that struct_size claims, or
 * writes it, ends the program. */
static void F10m_scene_longer_structures(void) {
    stress_guard guard[kinds_of_structure];
    int made = 1;
    for (int i = 0; i < kinds_of_structure; ++i) made &= stress_guard_make(&guard[i], 512);
    if (!made) {
        check_skip("F10m: no guard pages here");
        return;
    }
    spt_scene *const scene = stress_guard_top(&guard[0], sizeof *scene);
    spt_settings *const settings = stress_guard_top(&guard[1], sizeof *settings);
    spt_statistics *const statistics = stress_guard_top(&guard[2], sizeof *statistics);
    spt_bound *const bound = stress_guard_top(&guard[3], sizeof *bound);
    for (FOR_EACH_WAY) {
        prepare(&way);
        *scene = self.world.scene;
        *settings = self.settings;
        *statistics = self.statistics;
        *bound = self.world.bounds[0];
        self.world.fields[0].bound = bound;
        scene->struct_size += future;
        settings->struct_size += future;
        statistics->struct_size += future;
        bound->struct_size += future;
        self.given_scene = scene;
        self.given_settings = settings;
        self.given_statistics = statistics;
        CHECK(spt_scene_workspace(scene, settings) == self.workspace_size);
        CHECK(place_call() == SPT_OK);
        CHECK(self.hit[0].outcome == SPT_HIT && self.hit[1].outcome == SPT_HIT);
        CHECK(statistics->rays == 2 && statistics->lanes == way.lanes);
        CHECK(statistics->struct_size == sizeof *statistics + future);
    }
    for (int i = 0; i < kinds_of_structure; ++i) stress_guard_free(&guard[i]);
}

/* An array of fields of a later version: each is longer than ours, and read at its own stride. */
static void F10n_scene_fields_of_a_later_version(void) {
    typedef struct later_field {
        spt_field known;
        unsigned char unknown[40];
    } later_field;
    static later_field later[union_parts];
    for (FOR_EACH_WAY) {
        prepare(&way);
        CHECK(place_call() == SPT_OK);
        const spt_hit right = self.hit[0];
        memset(later, 0xff, sizeof later);
        for (int i = 0; i < union_parts; ++i) {
            later[i].known = self.world.fields[i];
            later[i].known.struct_size = sizeof *later;
        }
        self.world.scene.fields = &later[0].known;
        memset(self.hit, 0x5a, sizeof self.hit);
        CHECK(spt_scene_workspace(&self.world.scene, &self.settings) == self.workspace_size);
        CHECK(place_call() == SPT_OK && stress_same_hit(&self.hit[0], &right));
        later[union_parts - 1].known.lipschitz = 0.0f;
        refuse_scene("the last field of the later version");
    }
}

void suite_scene_contract(void) {
    RUN(F10f_scene_null_pointers);
    RUN(F10g_scene_sizes_and_counts);
    RUN(F10h_scene_no_workspace);
    RUN(F10i_scene_small_workspace_is_not_written);
    RUN(F10j_scene_numbers_and_flags);
    RUN(F10k_scene_zones);
    RUN(F10l_scene_sinks);
    RUN(F10m_scene_longer_structures);
    RUN(F10n_scene_fields_of_a_later_version);
}
