/* SPDX-License-Identifier: MIT
 *
 * Rows G1, G3, G5, G7 and G10 for scenes: hosts with another floating-point environment, callbacks
 * of components that leave by longjmp or trace scenes themselves, and the state of the vector
 * registers. Threads are in test_frame_host.c. */
#include "test_scene_cases.h"
#include "test_scene_registers.h"

#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#if defined(__SSE2__)
#define HAVE_MXCSR
#include <immintrin.h>
#endif

/* ---- G7: recursion --------------------------------------------------------------------------- */

enum { depths = 100, levels_parts = 3 };

/* Where in a trace the callback traces. */
typedef enum moment { AT_THE_FIRST_VALUE, WHILE_SKIPPING, IN_A_BRACKET } moment;

typedef struct descent {
    const stress_way *way;
    moment when;
    int depth;
    spt_hit hits[depths + 1];
    uintptr_t caller[depths + 1]; /* an address in the frame that called the tracer */
    uintptr_t frame[depths + 1];  /* and in the callback's, at each depth */
    unsigned char *workspaces;
    size_t workspace_size;
} descent;

static void descend(descent *self);

/* The sphere of the base scene; a slab that begins where the ray does and is left at 18; a jump. */
static float distance_at(moment when, float x, float y, float z) {
    if (when == WHILE_SKIPPING) return z < 9.0f ? z : 18.0f - z;
    if (when == IN_A_BRACKET) return z < 1.003f ? 0.5f : -0.5f;
    return stress_sphere_distance(stress_base().data, x, y, z);
}

/* Steps of 0.5 do not come so near to the jump as the bracket around it must. */
static int is_moment(moment when, float z) {
    if (when == WHILE_SKIPPING) return z > 0.0f;
    if (when == IN_A_BRACKET) return z > 1.001f && z < 1.005f;
    return 1;
}

/* One value of each level is asked for while all levels below it are traced. */
static float descending_distance(const void *data, float x, float y, float z) {
    descent *self = (descent *)(uintptr_t)data;
    volatile char here = 0;
    if (self->frame[self->depth] == 0 && is_moment(self->when, z)) {
        self->frame[self->depth] = (uintptr_t)&here;
        if (self->depth < depths) descend(self);
    }
    return distance_at(self->when, x, y, z);
}

/* In a small frame of its own: the compiler does not see through the pointer. */
static spt_status trace_below(descent *self, const spt_scene *scene, const spt_settings *settings,
                              const spt_rays *rays, const spt_hits *hits) {
    volatile char here = 0;
    unsigned char *const workspace =
        self->workspaces + (size_t)(self->depth - 1) * self->workspace_size;
    self->caller[self->depth] = (uintptr_t)&here;
    const spt_status status =
        spt_scene_trace(scene, settings, 1, rays, hits, workspace, self->workspace_size, NULL);
    return here == 0 ? status : SPT_BAD_ARGUMENT;
}

static spt_status (*volatile trace_from_here)(descent *, const spt_scene *, const spt_settings *,
                                              const spt_rays *, const spt_hits *) = trace_below;

/* The descending component between two that the ray never meets. */
static void descend(descent *self) {
    static const stress_sphere aside = {{0.0f, 30.0f, 5.0f}, 1.0f};
    const spt_ray ray = stress_base().ray;
    const spt_rays rays = spt_rays_of(&ray);
    spt_settings settings = union_settings(self->way);
    union_part parts[levels_parts];
    spt_field fields[levels_parts];
    spt_scene scene = spt_scene_default();
    spt_hit hit;
    const spt_hits hits = spt_hits_of(&hit);
    /* Also for the bracket: the way to it may be the longer for it. */
    if (self->when != AT_THE_FIRST_VALUE) settings.flags = SPT_SKIP_START;
    for (int i = 0; i < levels_parts; ++i) {
        parts[i] = union_part_of(i == 1 ? descending_distance : stress_sphere_distance,
                                 i == 1 ? (const void *)self : &aside);
        fields[i] = union_field(self->way, &parts[i]);
    }
    scene.fields = fields;
    scene.count = levels_parts;
    if (self->workspaces == NULL) {
        self->workspace_size = spt_scene_workspace(&scene, &settings);
        self->workspaces = malloc(depths * self->workspace_size);
    }
    ++self->depth;
    CHECK(trace_from_here(self, &scene, &settings, &rays, &hits) == SPT_OK);
    CHECK(parts[1].faults == 0);
    self->hits[self->depth] = hit;
    --self->depth;
}

/* trace.h: a level takes at most 32 KiB besides the callback's own, which here is the frames of the
 * part and of what it calls: few hundred bytes, and no exception is made for them. */
static void check_frames(const descent *self) {
#ifndef FRAMES_ARE_WIDENED
    for (int depth = 1; depth <= depths; ++depth) {
        const uintptr_t above = self->caller[depth], below = self->frame[depth];
        const size_t level = (size_t)(above > below ? above - below : below - above);
        CHECK_SAY(level > 0 && level <= 32 * 1024, "%u bytes at depth %d", (unsigned)level, depth);
    }
#else
    (void)self;
#endif
}

static void recurse(moment when) {
    static descent levels;
    const uint32_t convex = when == AT_THE_FIRST_VALUE ? STRESS_CONVEX : 0;
    for (stress_way way = stress_ways(convex | STRESS_OWN_RAYS); stress_next(&way);) {
        memset(&levels, 0, sizeof levels);
        levels.way = &way;
        levels.when = when;
        descend(&levels);
        for (int depth = 1; depth <= depths; ++depth) {
            CHECK(levels.hits[depth].outcome == SPT_HIT && levels.hits[depth].component == 1);
            CHECK(levels.frame[depth] != 0);
            CHECK(stress_same_hit(&levels.hits[depth], &levels.hits[1]));
        }
        check_frames(&levels);
        free(levels.workspaces);
    }
}

static void G7e_scene_recursion(void) {
    recurse(AT_THE_FIRST_VALUE);
}

static void G7f_scene_recursion_while_skipping(void) {
    recurse(WHILE_SKIPPING);
}

static void G7g_scene_recursion_in_a_bracket(void) {
    recurse(IN_A_BRACKET);
}

/* ---- G5: longjmp ----------------------------------------------------------------------------- */

enum { many = 60 };

typedef struct escape {
    jmp_buf way_out;
    int left; /* values before leaving; negative: stays */
} escape;

static escape leaving;

static float escaping_distance(const void *data, float x, float y, float z) {
    if (leaving.left >= 0 && leaving.left-- == 0) longjmp(leaving.way_out, 1);
    return stress_sphere_distance(data, x, y, z);
}

static union_scene world;
static spt_ray rays[many];
static spt_hit hits[many], right[many];

static spt_status trace_world(const spt_settings *settings) {
    static unsigned char *workspace;
    static size_t size;
    const spt_rays in = spt_rays_of(rays);
    const spt_hits out = spt_hits_of(hits);
    const size_t needed = spt_scene_workspace(&world.scene, settings);
    if (workspace == NULL || needed > size) { /* as the call before left it otherwise */
        free(workspace);
        workspace = malloc(needed);
        size = needed;
    }
    memset(hits, 0xa5, sizeof hits);
    return spt_scene_trace(&world.scene, settings, many, &in, &out, workspace, size, NULL);
}

static int escapes(const spt_settings *settings, int after) {
    leaving.left = after;
    if (setjmp(leaving.way_out) != 0) return 1;
    trace_world(settings);
    return 0;
}

static void G5b_longjmp_out_of_a_component(void) {
    for (size_t i = 0; i < many; ++i) rays[i] = union_ray(4 * i);
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        const spt_settings settings = union_settings(&way);
        int escaped = 0;
        union_base(&world, &way);
        world.parts[4].distance = escaping_distance; /* asked by every ray, at any time */
        leaving.left = -1;
        CHECK(trace_world(&settings) == SPT_OK);
        memcpy(right, hits, sizeof hits);
        for (int after = 0; after < 200; after += 1 + after / 4) {
            escaped += escapes(&settings, after);
            leaving.left = -1;
            CHECK(trace_world(&settings) == SPT_OK);
            CHECK_SAY(memcmp(hits, right, sizeof hits) == 0, "after an escape at %d", after);
        }
        CHECK_SAY(escaped > 10, "%d escapes", escaped);
    }
}

/* ---- G1, G3: the floating-point environment -------------------------------------------------- */

#ifdef HAVE_MXCSR
enum { control_bits = 0xffc0, flush_bits = 0x8040, invalid_masked = 0x80, division_masked = 0x200 };
enum { invalid_seen = 0x01, division_seen = 0x04 };

static struct {
    unsigned control;
    size_t changed, calls;
} spy;

static float spying_distance(const void *data, float x, float y, float z) {
    ++spy.calls;
    spy.changed += (_mm_getcsr() & control_bits) != spy.control;
    return stress_sphere_distance(data, x, y, z);
}

/* Rays that lie in a face of a bound, run along an axis and pass everything are among them, and a
 * zone is in the way of many. */
static void prepare_world(const stress_way *way) {
    static const spt_zone zone = {{0.0f, 0.0f, 4.0f}, 0.5f, -1};
    for (size_t i = 0; i < many; ++i) rays[i] = union_ray(4 * i);
    for (size_t i = 0; i < 3; ++i) {
        rays[i] = stress_base().ray;
        rays[i].origin[0] = 0.4f;
        rays[i].direction[i] = -1.0f;
    }
    rays[4].t_max = stress_infinity();
    union_base(&world, way);
    world.parts[4].distance = spying_distance;
    world.scene.zones = &zone;
    world.scene.zone_count = 1;
}
#endif

static void G1b_scene_control_bits_untouched(void) {
#ifdef HAVE_MXCSR
    static const unsigned modes[] = {0, flush_bits, 0x2000, 0x4000, 0x6000 | flush_bits};
    const unsigned saved = _mm_getcsr();
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        const spt_settings settings = union_settings(&way);
        prepare_world(&way);
        for (int i = 0; i < 5; ++i) {
            _mm_setcsr(saved | modes[i]);
            spy.control = _mm_getcsr() & control_bits;
            spy.changed = spy.calls = 0;
            const spt_status status = trace_world(&settings);
            const unsigned after = _mm_getcsr() & control_bits;
            _mm_setcsr(saved);
            CHECK(status == SPT_OK && after == spy.control);
            CHECK(spy.calls > 0 && spy.changed == 0);
        }
    }
#else
    check_skip("G1b: no MXCSR here");
#endif
}

static void G1c_scene_denormals_flushed(void) {
#ifdef HAVE_MXCSR
    const unsigned saved = _mm_getcsr();
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        const spt_settings settings = union_settings(&way);
        prepare_world(&way);
        CHECK(trace_world(&settings) == SPT_OK);
        memcpy(right, hits, sizeof hits);
        _mm_setcsr(saved | flush_bits);
        const spt_status status = trace_world(&settings);
        _mm_setcsr(saved);
        CHECK(status == SPT_OK && memcmp(hits, right, sizeof hits) == 0);
    }
#else
    check_skip("G1c: no MXCSR here");
#endif
}

static void G3b_scene_exceptions_unmasked(void) {
#ifdef HAVE_MXCSR
    const unsigned saved = _mm_getcsr();
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        const spt_settings settings = union_settings(&way);
        prepare_world(&way);
        _mm_setcsr(saved & ~(unsigned)(invalid_seen | division_seen));
        CHECK(trace_world(&settings) == SPT_OK);
        const unsigned seen = _mm_getcsr() & (invalid_seen | division_seen);
        _mm_setcsr(saved);
        CHECK_SAY(seen == 0, "exceptions %x raised", seen);
        if (seen != 0) return; /* unmasked, they would end the program */
        memcpy(right, hits, sizeof hits);
        _mm_setcsr((saved & ~(unsigned)(invalid_masked | division_masked)) & control_bits);
        const spt_status status = trace_world(&settings);
        _mm_setcsr(saved);
        CHECK(status == SPT_OK && memcmp(hits, right, sizeof hits) == 0);
    }
#else
    check_skip("G3b: no MXCSR here");
#endif
}

/* ---- G10: the upper halves of the vector registers ------------------------------------------- */

static int dirty;

static float register_spy(const void *data, float x, float y, float z) {
    dirty += upper_halves_used();
    return stress_sphere_distance(data, x, y, z);
}

static void G10b_scene_upper_halves_are_clean(void) {
    if (!upper_halves_are_visible()) {
        check_skip("G10b: the state of the upper halves cannot be read here");
        return;
    }
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        const spt_settings settings = union_settings(&way);
        for (size_t i = 0; i < many; ++i) rays[i] = union_ray(4 * i);
        union_base(&world, &way);
        for (int i = 0; i < union_parts; ++i) {
            if (i != 2 && i != 3) world.parts[i].distance = register_spy;
        }
        dirty = 0;
        const spt_status status = trace_world(&settings);
        const int after = upper_halves_used();
        upper_halves_clean();
        CHECK(status == SPT_OK && world.parts[4].calls > 0);
        CHECK_SAY(dirty == 0, "%d callbacks found them used", dirty);
        CHECK(!after);
    }
}

void suite_scene_host(void) {
    RUN(G7e_scene_recursion);
    RUN(G7f_scene_recursion_while_skipping);
    RUN(G7g_scene_recursion_in_a_bracket);
    RUN(G5b_longjmp_out_of_a_component);
    RUN(G1b_scene_control_bits_untouched);
    RUN(G1c_scene_denormals_flushed);
    RUN(G3b_scene_exceptions_unmasked);
    RUN(G10b_scene_upper_halves_are_clean);
}
