/* SPDX-License-Identifier: MIT
 *
 * The door: checks what is asked for, finds out what that needs, and writes it. */
#include <math.h>

#include "../base/arguments.h"
#include "../bound/bound_check.h"
#include "../frame/job.h"
#include "../trace/driver.h"
#include "parameters.h"
#include "pieces.h"
#include "program.h"

enum { FEATURES = SPT_GLSL_PLACE * 2 - 1, UNIFORMS = (1 << SPT_GLSL_NAMES) - 1 };

/* What a call works with. */
typedef struct emission {
    spt_glsl_options options;
    spt_settings settings;
    spt_camera camera;
    const char *names[SPT_GLSL_NAMES];
    spti_glsl_component components[SPT_GLSL_FIELDS];
    uint32_t count;
    uint64_t conditions;
    spti_glsl out;
} emission;

/* ---- Options -------------------------------------------------------------------------------- */

static int all_finite(const float *numbers, int count) {
    int finite = 1;
    for (int i = 0; i < count; ++i) finite = finite && spti_finite(numbers[i]);
    return finite;
}

static int numbers_are_good(const spt_glsl_options *options) {
    return all_finite(options->light, 3) && all_finite(options->depth, 2) &&
           spti_finite(options->light_tangent) && options->light_tangent > 0.0f &&
           spti_finite(options->occlusion) && options->occlusion > 0.0f &&
           spti_within(options->detail, 0.0f, FLT_MAX) && options->iterations <= 16 &&
           options->samples >= 1 && options->samples <= 16 && options->cone_size >= 2 &&
           options->cone_size <= 64;
}

/* Which features a program has. */
static uint32_t legal_features(const spt_glsl_options *options) {
    const uint32_t tracing = SPT_GLSL_GUARDS | SPT_GLSL_FLAGS | SPT_GLSL_CANDIDATE |
                             SPT_GLSL_FALLBACKS | SPT_GLSL_COMPONENT | SPT_GLSL_PATH |
                             SPT_GLSL_NORMAL | SPT_GLSL_REFINE | SPT_GLSL_CONVEX | SPT_GLSL_BINARY |
                             SPT_GLSL_ARRAYS | SPT_GLSL_MERGED;
    if (options->target == SPT_GLSL_LIBRARY) {
        return tracing | SPT_GLSL_OFFSET | SPT_GLSL_SHADOW | SPT_GLSL_OCCLUSION | SPT_GLSL_PLACE;
    }
    switch (options->program) {
    case SPT_GLSL_PICTURE:
        return (tracing & ~(uint32_t)SPT_GLSL_FALLBACKS) | SPT_GLSL_SHADOW | SPT_GLSL_OCCLUSION |
               SPT_GLSL_STARTS | SPT_GLSL_DEPTH_WRITE;
    case SPT_GLSL_HITS:
        return tracing | SPT_GLSL_STARTS | SPT_GLSL_PLACE;
    case SPT_GLSL_POINTS:
        return SPT_GLSL_ARRAYS | SPT_GLSL_MERGED;
    default:
        return SPT_GLSL_GUARDS | SPT_GLSL_ARRAYS | SPT_GLSL_MERGED;
    }
}

static spt_status check_program(const spt_glsl_options *options) {
    const uint32_t target = options->target, program = options->program;
    const uint32_t features = options->features;
    const int compute = target >= SPT_GLSL_COMPUTE_310_ES;
    if (target >= SPT_GLSL_TARGETS) return SPT_BAD_ARGUMENT;
    if (target != SPT_GLSL_LIBRARY && program >= SPT_GLSL_PROGRAMS) return SPT_BAD_ARGUMENT;
    if ((features & ~(uint32_t)FEATURES) || (options->uniforms & ~(uint32_t)UNIFORMS)) {
        return SPT_BAD_ARGUMENT;
    }
    if (features & ~legal_features(options)) return SPT_UNSUPPORTED;
    if ((features & SPT_GLSL_CONVEX) && (features & SPT_GLSL_BINARY)) return SPT_UNSUPPORTED;
    if (target == SPT_GLSL_LIBRARY) return SPT_OK;
    if (target == SPT_GLSL_SHADERTOY && program != SPT_GLSL_PICTURE) return SPT_UNSUPPORTED;
    if (compute && program == SPT_GLSL_PICTURE) return SPT_UNSUPPORTED;
    if ((features & SPT_GLSL_STARTS) &&
        (target == SPT_GLSL_VULKAN_450 || target == SPT_GLSL_SHADERTOY)) {
        return SPT_UNSUPPORTED;
    }
    return SPT_OK;
}

/* Settings that some features exclude. */
static spt_status check_settings(const emission *e) {
    const uint32_t features = e->options.features, flags = e->settings.flags;
    if (flags & SPT_CHECK_CONVEX) return SPT_BAD_ARGUMENT;
    if ((features & SPT_GLSL_BINARY) && flags != 0) return SPT_BAD_ARGUMENT;
    if ((features & SPT_GLSL_CONVEX) && (flags & SPT_STOP_INSIDE)) return SPT_BAD_ARGUMENT;
    if ((features & SPT_GLSL_SHADOW) && (flags & SPT_CANDIDATE_CLOSEST)) return SPT_UNSUPPORTED;
    if ((features & SPT_GLSL_CONVEX) &&
        (flags & (SPT_CANDIDATE_PENUMBRA | SPT_CANDIDATE_CLOSEST))) {
        return SPT_UNSUPPORTED;
    }
    return SPT_OK;
}

static spt_status take_camera(emission *e) {
    spt_camera *const camera = &e->camera;
    const int needed =
        e->options.target != SPT_GLSL_LIBRARY &&
        (e->options.program == SPT_GLSL_PICTURE || e->options.program == SPT_GLSL_CONES);
    if (!needed) {
        e->options.camera = NULL;
        return SPT_OK;
    }
    if (!spti_camera_copy(camera, e->options.camera)) return SPT_BAD_ARGUMENT;
    e->options.camera = camera;
    if (camera->kind == SPT_CAMERA_RAYS) return SPT_UNSUPPORTED;
    if (camera->kind != SPT_CAMERA_PINHOLE && (e->options.features & SPT_GLSL_DEPTH_WRITE)) {
        return SPT_UNSUPPORTED;
    }
    return camera->t_max > 1e18f && camera->t_max < INFINITY ? SPT_UNSUPPORTED : SPT_OK;
}

/* ---- Fields --------------------------------------------------------------------------------- */

/* A quarter of the bound's least side, or 1, as spt_normals() has it. */
static float usual_detail(const spt_bound *bound) {
    float detail = 1.0f;
    for (int axis = 0; bound != NULL && axis < 3; ++axis) {
        const float quarter = 0.25f * bound->high[axis] - 0.25f * bound->low[axis];
        if (quarter > 0.0f && quarter < detail) detail = quarter;
    }
    return detail;
}

static spt_status take_field(emission *e, const spt_field *field) {
    spti_glsl_component *const component = &e->components[e->count];
    spt_bound bound;
    if (!spti_field_copy(&component->field, &bound, field)) return SPT_BAD_ARGUMENT;
    const spt_bound *const inside = component->field.bound;
    if (inside != NULL && bound.kind == SPT_BOUND_CALLBACK) return SPT_UNSUPPORTED;
    const float extent = inside != NULL ? spti_bound_size(&bound) : 0.0f;
    const float size = e->settings.size > extent ? e->settings.size : extent;
    component->inverse_lipschitz = 1.0f / component->field.lipschitz;
    component->floor_of_size = SPTI_FLOOR * size;
    component->detail =
        e->options.detail > 0.0f ? e->options.detail : usual_detail(inside != NULL ? &bound : NULL);
    component->convex = 0;
    e->count += 1;
    return SPT_OK;
}

static spt_status take_scene(emission *e) {
    spt_scene scene = spt_scene_default();
    const int points = e->options.program == SPT_GLSL_POINTS &&
                       e->options.target != SPT_GLSL_LIBRARY &&
                       !(e->options.features & SPT_GLSL_MERGED);
    if (!spti_copy_sized(&scene, e->options.scene, sizeof scene)) return SPT_BAD_ARGUMENT;
    if (scene.fields == NULL || scene.count == 0) return SPT_BAD_ARGUMENT;
    if (scene.count > SPT_GLSL_FIELDS) return SPT_BAD_ARGUMENT;
    if (scene.zone_count > 0) return SPT_UNSUPPORTED;
    size_t stride;
    memcpy(&stride, scene.fields, sizeof stride);
    if (stride < sizeof(spt_field)) return SPT_BAD_ARGUMENT;
    if (points && e->options.field_number >= scene.count) return SPT_BAD_ARGUMENT;
    for (size_t i = 0; i < scene.count; ++i) {
        const char *const at = (const char *)scene.fields + i * stride;
        if (points && i != e->options.field_number) continue;
        const spt_status status = take_field(e, (const spt_field *)(const void *)at);
        if (status != SPT_OK) return status;
        spti_glsl_component *const component = &e->components[e->count - 1];
        component->convex = (component->field.flags & SPT_FIELD_CONVEX) != 0 &&
                            !(e->options.features & SPT_GLSL_MERGED);
        if (!component->convex && e->settings.method->needs_convex) return SPT_BAD_ARGUMENT;
    }
    return SPT_OK;
}

static spt_status take_fields(emission *e) {
    const uint32_t features = e->options.features;
    const int alone = (features & (SPT_GLSL_CONVEX | SPT_GLSL_BINARY | SPT_GLSL_PLACE)) != 0;
    if ((e->options.field == NULL) == (e->options.scene == NULL)) return SPT_BAD_ARGUMENT;
    if (e->options.scene != NULL) return alone ? SPT_UNSUPPORTED : take_scene(e);
    const spt_status status = take_field(e, e->options.field);
    if (status != SPT_OK) return status;
    if (e->options.program == SPT_GLSL_POINTS && e->options.target != SPT_GLSL_LIBRARY &&
        e->options.field_number > 0) {
        return SPT_BAD_ARGUMENT;
    }
    spti_glsl_component *const component = &e->components[0];
    const int convex = (component->field.flags & SPT_FIELD_CONVEX) != 0;
    if (!spti_method_allowed(e->settings.method, &component->field)) return SPT_BAD_ARGUMENT;
    if ((features & SPT_GLSL_CONVEX) && component->field.bound == NULL) return SPT_BAD_ARGUMENT;
    component->convex = convex && (features & SPT_GLSL_CONVEX);
    return SPT_OK;
}

/* ---- Conditions ----------------------------------------------------------------------------- */

static uint64_t when(int holds, uint64_t bits) {
    return holds ? bits : 0;
}

static uint64_t conditions_of_features(uint32_t features) {
    static const struct {
        uint32_t feature;
        uint64_t condition;
    } table[] = {
        {SPT_GLSL_GUARDS, SPTI_GLSL_BIT(guards)},
        {SPT_GLSL_FLAGS, SPTI_GLSL_BIT(flags)},
        {SPT_GLSL_CANDIDATE, SPTI_GLSL_BIT(candidate) | SPTI_GLSL_BIT(seen)},
        {SPT_GLSL_FALLBACKS, SPTI_GLSL_BIT(fallbacks)},
        {SPT_GLSL_COMPONENT, SPTI_GLSL_BIT(component)},
        {SPT_GLSL_PATH, SPTI_GLSL_BIT(path)},
        {SPT_GLSL_NORMAL, SPTI_GLSL_BIT(normal)},
        {SPT_GLSL_REFINE, SPTI_GLSL_BIT(refine)},
        {SPT_GLSL_OFFSET, SPTI_GLSL_BIT(offset)},
        {SPT_GLSL_SHADOW, SPTI_GLSL_BIT(shadow) | SPTI_GLSL_BIT(seen)},
        {SPT_GLSL_OCCLUSION, SPTI_GLSL_BIT(occlusion)},
        {SPT_GLSL_CONVEX, SPTI_GLSL_BIT(reverse)},
        {SPT_GLSL_BINARY, SPTI_GLSL_BIT(binary)},
        {SPT_GLSL_STARTS, SPTI_GLSL_BIT(starts)},
        {SPT_GLSL_DEPTH_WRITE, SPTI_GLSL_BIT(depth)},
        {SPT_GLSL_MERGED, SPTI_GLSL_BIT(merged)},
        {SPT_GLSL_PLACE, SPTI_GLSL_BIT(place)},
    };
    uint64_t bits = 0;
    for (size_t i = 0; i < sizeof table / sizeof *table; ++i) {
        bits |= when((features & table[i].feature) != 0, table[i].condition);
    }
    return bits;
}

static uint64_t conditions_of_settings(const emission *e) {
    const uint32_t flags = e->settings.flags, uniforms = e->options.uniforms;
    const int candidate = (e->options.features & SPT_GLSL_CANDIDATE) != 0;
    const int penumbra = candidate && (flags & SPT_CANDIDATE_PENUMBRA);
    const int closest = candidate && (flags & SPT_CANDIDATE_CLOSEST);
    const int pixel =
        e->settings.pixel_radius > 0.0f || (uniforms >> SPT_GLSL_NAME_PIXEL_RADIUS & 1);
    return when((flags & SPT_SKIP_START) != 0, SPTI_GLSL_BIT(skip_start)) |
           when((flags & SPT_STOP_INSIDE) != 0, SPTI_GLSL_BIT(stop_inside)) |
           when(penumbra, SPTI_GLSL_BIT(penumbra) | SPTI_GLSL_BIT(between)) |
           when(closest, SPTI_GLSL_BIT(closest) | SPTI_GLSL_BIT(between)) |
           when(pixel, SPTI_GLSL_BIT(pixel)) |
           when((uniforms >> SPT_GLSL_NAME_VIEW & 1) != 0, SPTI_GLSL_BIT(views));
}

static void settle_conditions(emission *e) {
    const uint32_t target = e->options.target;
    const int scene = e->options.scene != NULL,
              merged = (e->options.features & SPT_GLSL_MERGED) != 0;
    const int many = scene && !merged && e->count > 1;
    uint64_t bits = conditions_of_features(e->options.features) | conditions_of_settings(e);
    /* Functions that concern one surface of many ask for its component. */
    const uint64_t asks = SPTI_GLSL_BIT(normal) | SPTI_GLSL_BIT(refine) | SPTI_GLSL_BIT(offset) |
                          SPTI_GLSL_BIT(shadow);
    const int picture = target != SPT_GLSL_LIBRARY && e->options.program == SPT_GLSL_PICTURE;
    if (many && ((bits & asks) || picture)) bits |= SPTI_GLSL_BIT(component);
    for (uint32_t i = 0; i < e->count; ++i) {
        const spti_glsl_component *const component = &e->components[i];
        bits |= when(component->floor_of_size > 0.0f, SPTI_GLSL_BIT(sized));
        bits |= when(!merged && component->field.bound != NULL, SPTI_GLSL_BIT(bounded));
    }
    bits |= when(many, SPTI_GLSL_BIT(many)) | when(picture, SPTI_GLSL_BIT(picture)) |
            when(target == SPT_GLSL_LIBRARY, SPTI_GLSL_BIT(library)) |
            when(target == SPT_GLSL_SHADERTOY, SPTI_GLSL_BIT(shadertoy)) |
            when(target >= SPT_GLSL_COMPUTE_310_ES, SPTI_GLSL_BIT(compute) | SPTI_GLSL_BIT(exact)) |
            when(scene && e->options.scene->materials != NULL, SPTI_GLSL_BIT(materials)) |
            when(e->options.camera != NULL && e->camera.kind == SPT_CAMERA_PINHOLE,
                 SPTI_GLSL_BIT(pinhole));
    e->conditions = bits;
}

/* What functions that take no component are to know of it: of the one, or of all at once. */
static void settle_common(const emission *e, spti_glsl *out) {
    const int merged = (e->options.features & SPT_GLSL_MERGED) != 0;
    out->inverse_lipschitz = merged ? 1.0f : e->components[0].inverse_lipschitz;
    out->floor_of_size = e->components[0].floor_of_size;
    out->detail = e->components[0].detail;
    for (uint32_t i = 1; i < e->count; ++i) {
        const spti_glsl_component *const component = &e->components[i];
        if (component->floor_of_size > out->floor_of_size) {
            out->floor_of_size = component->floor_of_size;
        }
        if (component->detail < out->detail) out->detail = component->detail;
    }
}

/* ---- Writing -------------------------------------------------------------------------------- */

static void begin(const emission *e, spti_glsl *out) {
    out->options = &e->options;
    out->components = e->components;
    out->component_count = e->count;
    out->settings = e->settings;
    out->names = e->names;
    out->conditions = e->conditions;
    out->uniforms = e->options.target == SPT_GLSL_LIBRARY || e->options.target == SPT_GLSL_SHADERTOY
                        ? 0
                        : e->options.uniforms | SPTI_GLSL_ALWAYS;
    out->line = 1;
    settle_common(e, out);
    const float *const light = e->options.light;
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) square += (double)light[axis] * (double)light[axis];
    for (int axis = 0; axis < 3; ++axis) {
        out->light[axis] = (float)((double)light[axis] / sqrt(square));
    }
}

static spt_status take_options(emission *e, const spt_glsl_options *options) {
    e->options = spt_glsl_options_default();
    if (!spti_copy_sized(&e->options, options, sizeof e->options)) return SPT_BAD_ARGUMENT;
    if (!numbers_are_good(&e->options)) return SPT_BAD_ARGUMENT;
    const float *const light = e->options.light;
    const double x = (double)light[0], y = (double)light[1], z = (double)light[2];
    if (!(x * x + y * y + z * z > 0)) return SPT_BAD_ARGUMENT;
    for (uint32_t i = 0; i < SPT_GLSL_NAMES; ++i) {
        const char *const name = e->options.names != NULL ? e->options.names[i] : NULL;
        e->names[i] = name != NULL ? name : spt_glsl_default_name(i);
    }
    if (!spti_glsl_names_are_good(e->names)) return SPT_BAD_ARGUMENT;
    if (!spti_settings_copy(&e->settings, e->options.settings)) return SPT_BAD_ARGUMENT;
    spt_status status = check_program(&e->options);
    if (status == SPT_OK) status = check_settings(e);
    if (status == SPT_OK) status = take_camera(e);
    return status == SPT_OK ? take_fields(e) : status;
}

/* Finds out what is named, from main() back to the first piece. */
static void find_needed(spti_glsl *out) {
    out->scanning = 1;
    spti_glsl_end(out);
    spti_glsl_reach_all(out);
    out->scanning = 0;
    out->fields = out->preludes = out->texts = 0;
}

spt_status spt_glsl_emit(const spt_glsl_options *options, char *buffer, size_t capacity,
                         size_t *length) {
    emission e;
    if (options == NULL || (buffer == NULL && capacity > 0)) return SPT_BAD_ARGUMENT;
    memset(&e, 0, sizeof e);
    spt_status status = take_options(&e, options);
    if (status != SPT_OK) return status;
    settle_conditions(&e);
    begin(&e, &e.out);
    find_needed(&e.out);
    if (e.out.clashes & e.out.used & e.out.uniforms) return SPT_BAD_ARGUMENT;
    if (e.out.status != SPT_OK) return e.out.status;
    e.out.buffer = buffer;
    e.out.capacity = capacity;
    spti_glsl_begin(&e.out);
    spti_glsl_write_pieces(&e.out);
    spti_glsl_end(&e.out);
    if (capacity > 0) buffer[e.out.length < capacity ? e.out.length : capacity - 1] = '\0';
    if (length != NULL) *length = e.out.length;
    return e.out.length < capacity ? SPT_OK : SPT_BUFFER_TOO_SMALL;
}
