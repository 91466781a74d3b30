/* SPDX-License-Identifier: MIT
 *
 * Calls of spt_glsl_emit(), and what glsl.h promises of each combination of options. */
#include "test_glsl_world.h"

#include "check.h"

#include <string.h>

enum { fill = 0xa5, behind = 64, looked_at = 1 << 14 };

/* Whether all bytes from `from` on are as they were. */
static int is_filled(const char *memory, size_t from, size_t to) {
    for (size_t i = from; i < to; ++i) {
        if ((unsigned char)memory[i] != fill) return 0;
    }
    return 1;
}

spt_status glsl_world_emit(glsl_world *world) {
    static char memory[glsl_room];
    static size_t written = glsl_room; /* by the last call */
    size_t length = (size_t)-7, needed = (size_t)-7;
    memset(memory, fill, written < glsl_room ? written : glsl_room);
    world->text = memory;
    world->length = 0;
    written = 0;
    const spt_status counted = spt_glsl_emit(&world->options, NULL, 0, &needed);
    const spt_status status = spt_glsl_emit(&world->options, memory, sizeof memory, &length);
    if (status != SPT_OK) {
        CHECK_SAY(status == SPT_BAD_ARGUMENT || status == SPT_UNSUPPORTED, "%s",
                  spt_status_name(status));
        CHECK_SAY(counted == status, "asked for the length: %s", spt_status_name(counted));
        CHECK(length == (size_t)-7 && needed == (size_t)-7);
        CHECK(is_filled(memory, 0, looked_at));
        return status;
    }
    CHECK_SAY(counted == SPT_BUFFER_TOO_SMALL, "asked for the length: %s",
              spt_status_name(counted));
    CHECK_SAY(length == needed, "%u and %u bytes", (unsigned)length, (unsigned)needed);
    CHECK(length < sizeof memory - behind);
    if (length >= sizeof memory - behind) return SPT_BUFFER_TOO_SMALL;
    CHECK(memchr(memory, 0, length) == NULL && memory[length] == 0);
    CHECK(is_filled(memory, length + 1, length + behind));
    written = length + behind;
    world->length = length;
    return SPT_OK;
}

/* ---- What must be there ---------------------------------------------------------------------- */

/* The functions that a text is for. */
static int roots_of(const glsl_world *world, const char *roots[16]) {
    static const struct {
        uint32_t feature;
        const char *function;
    } asked[] = {
        {SPT_GLSL_NORMAL, "spt_hit_normal"},  {SPT_GLSL_REFINE, "spt_refine"},
        {SPT_GLSL_OFFSET, "spt_offset"},      {SPT_GLSL_OFFSET, "spt_offset_checked"},
        {SPT_GLSL_SHADOW, "spt_soft_shadow"}, {SPT_GLSL_OCCLUSION, "spt_ambient_occlusion"},
        {SPT_GLSL_PLACE, "spt_kernel_at"}};
    const uint32_t features = world->options.features;
    int count = 0;
    if (world->options.target == SPT_GLSL_SHADERTOY) {
        roots[count++] = "mainImage";
        return count;
    }
    if (world->options.target != SPT_GLSL_LIBRARY) {
        roots[count++] = "main";
        return count;
    }
    roots[count++] = (features & SPT_GLSL_CONVEX) != 0   ? "spt_trace_convex"
                     : (features & SPT_GLSL_BINARY) != 0 ? "spt_binary_trace"
                                                         : "spt_trace";
    for (size_t i = 0; i < sizeof asked / sizeof *asked; ++i) {
        if ((features & asked[i].feature) != 0) roots[count++] = asked[i].function;
    }
    if ((features & SPT_GLSL_COMPONENT) != 0 && world->options.scene != NULL &&
        world->scene.materials != NULL)
        roots[count++] = "spt_material";
    return count;
}

/* A library may hold the field for its own sake; who asked for a binary trace may not get one. */
static int optional_roots(const glsl_world *world, const glsl_text *text, const char *roots[16],
                          int count) {
    if (world->options.target == SPT_GLSL_LIBRARY &&
        (glsl_text_what(text, "spt_map") & GLSL_IS_FUNCTION) != 0)
        roots[count++] = "spt_map";
    return count;
}

void glsl_world_allow(const glsl_world *world, glsl_text *text) {
    const uint32_t target = world->options.target;
    glsl_text_allow_nothing(text);
    glsl_text_allow(text, "my_*");
    for (int i = 0; i < glsl_most_callers && world->callers[i] != NULL; ++i) {
        glsl_text_allow_text(text, world->callers[i]);
    }
    if (target == SPT_GLSL_SHADERTOY) {
        glsl_text_allow(text, "iResolution");
        glsl_text_allow(text, "iTime");
        glsl_text_allow(text, "iFrame");
        glsl_text_allow(text, "mainImage");
    } else if (target != SPT_GLSL_LIBRARY) {
        glsl_text_allow(text, "main");
    }
    for (int i = 0; i < SPT_GLSL_NAMES && world->options.names != NULL; ++i) {
        if (world->names[i] != NULL) glsl_text_allow(text, world->names[i]);
    }
}

/* Audits what was written last. */
static int audit_written(const glsl_world *world, glsl_text *text) {
    const char *roots[16];
    const int is_library = world->options.target == SPT_GLSL_LIBRARY;
    glsl_world_allow(world, text);
    const int fine = glsl_text_read(text, world->text) && glsl_text_parse(text);
    const int count = optional_roots(world, text, roots, roots_of(world, roots));
    const int sound = fine && glsl_text_audit(text, roots, count) &&
                      (!is_library || glsl_text_audit_library(text));
    CHECK_SAY(sound, "%s", text->fault);
    CHECK(text->length == world->length);
    return sound;
}

int glsl_world_audit(glsl_world *world, glsl_text *text) {
    const spt_status status = glsl_world_emit(world);
    CHECK_SAY(status == SPT_OK, "%s", spt_status_name(status));
    return status == SPT_OK && audit_written(world, text);
}

/* ---- What glsl.h says ------------------------------------------------------------------------ */

enum {
    LIBRARY = 1u << 0, /* where something is said to be */
    HITS = 1u << 1,
    PICTURE = 1u << 2,
    POINTS = 1u << 3,
    CONES = 1u << 4,
    ANYWHERE = 31u
};

static uint32_t place_of(const glsl_world *world) {
    static const uint32_t places[SPT_GLSL_PROGRAMS] = {PICTURE, HITS, POINTS, CONES};
    return world->options.target == SPT_GLSL_LIBRARY ? LIBRARY : places[world->options.program];
}

static const struct {
    uint32_t feature, written, refused;
} said[] = {{SPT_GLSL_GUARDS, LIBRARY | HITS, 0},
            {SPT_GLSL_FLAGS, LIBRARY | HITS, 0},
            {SPT_GLSL_CANDIDATE, LIBRARY | HITS, 0},
            {SPT_GLSL_FALLBACKS, LIBRARY | HITS, 0},
            {SPT_GLSL_COMPONENT, LIBRARY | HITS, 0},
            {SPT_GLSL_PATH, LIBRARY | HITS, 0},
            {SPT_GLSL_NORMAL, LIBRARY | HITS | PICTURE, POINTS | CONES},
            {SPT_GLSL_REFINE, LIBRARY | HITS | PICTURE, 0},
            {SPT_GLSL_OFFSET, LIBRARY, HITS | POINTS | CONES},
            {SPT_GLSL_SHADOW, LIBRARY | PICTURE, HITS | POINTS | CONES},
            {SPT_GLSL_OCCLUSION, LIBRARY | PICTURE, HITS | POINTS | CONES},
            {SPT_GLSL_CONVEX, LIBRARY | HITS, 0},
            {SPT_GLSL_BINARY, LIBRARY | HITS, 0},
            {SPT_GLSL_STARTS, HITS | PICTURE, POINTS | CONES},
            {SPT_GLSL_DEPTH_WRITE, PICTURE, LIBRARY | HITS | POINTS | CONES},
            {SPT_GLSL_ARRAYS, LIBRARY | HITS | PICTURE, 0},
            {SPT_GLSL_MERGED, LIBRARY | HITS | PICTURE, 0},
            {SPT_GLSL_PLACE, LIBRARY | HITS, 0}};

static int has_place(glsl_subject subject) {
    return (subject >= GLSL_KRS_0 && subject <= GLSL_KRS_FIELD) || subject == GLSL_MOEKRS;
}

/* One feature of a program whose target has it. */
static int verdict_of_feature(const glsl_world *world, size_t i) {
    const uint32_t place = place_of(world), feature = said[i].feature;
    const int many = world->options.scene != NULL;
    const int one_only = feature == SPT_GLSL_CONVEX || feature == SPT_GLSL_BINARY;
    if ((said[i].refused & place) != 0 || (one_only && many)) return -1;
    if (feature == SPT_GLSL_PLACE && !has_place(world->subject)) return -1;
    if (feature == SPT_GLSL_CONVEX && glsl_world_field(world)->bound == NULL) return -1;
    if ((said[i].written & place) == 0) return 0;
    if (feature == SPT_GLSL_CONVEX && (world->settings.flags & SPT_STOP_INSIDE) != 0) return -1;
    if (feature == SPT_GLSL_BINARY && world->settings.flags != 0) return -1;
    if ((feature == SPT_GLSL_MERGED || feature == SPT_GLSL_COMPONENT) && !many) return 0;
    /* shadows look for candidates of their own */
    if (feature == SPT_GLSL_SHADOW && (world->settings.flags & SPT_CANDIDATE_CLOSEST) != 0)
        return 0;
    if (feature == SPT_GLSL_ARRAYS && !has_place(world->subject)) return 0;
    if (feature == SPT_GLSL_DEPTH_WRITE && world->options.target == SPT_GLSL_SHADERTOY) return 0;
    if (feature == SPT_GLSL_STARTS && world->options.target > SPT_GLSL_FRAGMENT_300_ES) return 0;
    return 1;
}

int glsl_world_verdict(const glsl_world *world) {
    const uint32_t target = world->options.target, features = world->options.features;
    const uint32_t place = place_of(world);
    /* what takes the place of spt_trace(), or changes what a component is */
    const uint32_t alone =
        SPT_GLSL_CONVEX | SPT_GLSL_BINARY | SPT_GLSL_MERGED | SPT_GLSL_PLACE | SPT_GLSL_STARTS;
    const uint32_t others = features & alone;
    int verdict = 1;
    if (target == SPT_GLSL_SHADERTOY && place != PICTURE) return -1;
    if (target >= SPT_GLSL_COMPUTE_310_ES && place == PICTURE) return -1;
    if (target >= SPT_GLSL_COMPUTE_310_ES && place == CONES) verdict = 0;
    if (others != 0 && features != others) verdict = 0;
    if ((others & (others - 1)) != 0) verdict = 0;
    for (size_t i = 0; i < sizeof said / sizeof *said; ++i) {
        if ((features & said[i].feature) == 0) continue;
        const int one = verdict_of_feature(world, i);
        if (one < 0) return -1;
        if (one == 0) verdict = 0;
    }
    return verdict;
}

void glsl_world_try(glsl_world *world, glsl_text *text) {
    const spt_glsl_options *const options = &world->options;
    const int verdict = glsl_world_verdict(world);
    check_context("%s, target %u, program %u, features 0x%x, uniforms 0x%x, flags %u, %s",
                  glsl_subject_names[world->subject], (unsigned)options->target,
                  (unsigned)options->program, (unsigned)options->features,
                  (unsigned)options->uniforms, (unsigned)world->settings.flags,
                  spt_method_name(world->settings.method));
    const spt_status status = glsl_world_emit(world);
    if (verdict > 0) CHECK_SAY(status == SPT_OK, "%s", spt_status_name(status));
    if (verdict < 0) CHECK(status != SPT_OK);
    if (status == SPT_OK) audit_written(world, text);
}
