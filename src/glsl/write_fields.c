/* SPDX-License-Identifier: MIT
 *
 * The fields of a scene as functions, and what else is known of its components. */
#include "../base/arguments.h"
#include "../bound/bound_check.h"
#include "pieces.h"
#include "write.h"
#include "write_krs.h"

/* ---- Fields --------------------------------------------------------------------------------- */

static int is_callers(const spt_field *field) {
    return field->glsl != NULL && field->glsl[0] != '#';
}

/* One after the other, not each in the else of the one before: llvmpipe loses its way in chains of
 * about 80. */
static void write_choice(spti_glsl *out) {
    spti_glsl_put(out, "float spt_map(int component, vec3 p) {\n    float f = 3.0e38;\n");
    for (uint32_t i = 0; i < out->component_count; ++i) {
        spti_glsl_format(out, "    if (component == %d) f = spt_field_%d(p);\n", (int)i,
                         out->number_of[i]);
    }
    spti_glsl_put(out, "    return f;\n}\n");
}

/* With guards NaN is the answer, whichever field it comes from: min() may lose it. */
static void write_least(spti_glsl *out, const char *head) {
    spti_glsl_format(out, "%s {\n    float least = 3.0e38;\n", head);
    for (uint32_t i = 0; i < out->component_count; ++i) {
        const float factor = out->components[i].inverse_lipschitz;
        spti_glsl_format(out, i == 0 ? "    float f = spt_field_%d(p)" : "    f = spt_field_%d(p)",
                         out->number_of[i]);
        if (factor < 1.0f || factor > 1.0f) spti_glsl_format(out, " * %f", (double)factor);
        spti_glsl_put(out, ";\n");
        spti_glsl_expand(out,
                         "[guards]    if (!spt_is_number(f)) return f;\n"
                         "    least = min(least, f);\n",
                         NULL);
    }
    spti_glsl_put(out, "    return least;\n}\n");
}

void spti_glsl_write_map(spti_glsl *out) {
    const spti_glsl_component *const components = out->components;
    const int many = spti_glsl_has(out, SPTI_GLSL_BIT(many));
    const int merged = spti_glsl_has(out, SPTI_GLSL_BIT(merged));
    if (!many && !merged && is_callers(&components[0].field)) {
        spti_glsl_prelude(out, components[0].field.glsl_prelude);
        spti_glsl_next_field(out);
        spti_glsl_begin_guard(out, "spt_map");
        spti_glsl_body(out, "float spt_map(vec3 p)", components[0].field.glsl);
        spti_glsl_end_guard(out, "spt_map");
        return;
    }
    for (uint32_t i = 0; i < out->component_count && out->status == SPT_OK; ++i) {
        out->number_of[i] = spti_glsl_field(out, &components[i].field);
    }
    spti_glsl_put(out, "\n");
    spti_glsl_begin_guard(out, "spt_map");
    if (merged) {
        spti_glsl_put(
            out, "// The union as one field: the least of all over their Lipschitz constants.\n");
        write_least(out, "float spt_map(vec3 p)");
    } else if (many) {
        write_choice(out);
    } else {
        spti_glsl_format(out, "float spt_map(vec3 p) {\n    return spt_field_%d(p);\n}\n",
                         out->number_of[0]);
    }
    spti_glsl_end_guard(out, "spt_map");
}

void spti_glsl_write_nearest(spti_glsl *out) {
    if (!spti_glsl_has(out, SPTI_GLSL_BIT(many))) {
        spti_glsl_expand(out,
                         "float spt_scene_distance(vec3 p) {\n"
                         "    $precise float nearest = spt_map(p) * $L;\n"
                         "    return nearest;\n"
                         "}\n",
                         NULL);
        return;
    }
    spti_glsl_put(out, "// The least of all components over their Lipschitz constants.\n");
    write_least(out, "float spt_scene_distance(vec3 p)");
}

/* The arg-min of the union; no threshold on the place, since hits lie above the surface. */
void spti_glsl_write_component_at(spti_glsl *out) {
    spti_glsl_put(out, "// The component that is nearest; of equals the first.\n"
                       "int spt_component_at(vec3 p) {\n"
                       "    int component = 0;\n"
                       "    float least = 3.0e38, f;\n");
    for (uint32_t i = 0; i < out->component_count; ++i) {
        spti_glsl_format(out, "    f = spt_field_%d(p) * %f;\n", out->number_of[i],
                         (double)out->components[i].inverse_lipschitz);
        spti_glsl_format(out, "    if (f < least) component = %d;\n    least = min(least, f);\n",
                         (int)i);
    }
    spti_glsl_put(out, "    return component;\n}\n");
}

/* ---- Numbers of components ------------------------------------------------------------------- */

/* A number of each component; the first one of a run of equals stands for it. */
typedef float number_fn(const spti_glsl_component *component);

static float inverse_lipschitz(const spti_glsl_component *component) {
    return component->inverse_lipschitz;
}

static float floor_of_size(const spti_glsl_component *component) {
    return component->floor_of_size;
}

static float detail(const spti_glsl_component *component) {
    return component->detail;
}

static void choose_number(spti_glsl *out, const char *name, number_fn *number_of) {
    float last = number_of(&out->components[0]);
    spti_glsl_format(out, "float %s(int component) {\n    float number = %F;\n", name,
                     (double)last);
    for (uint32_t i = 1; i < out->component_count; ++i) {
        const float number = number_of(&out->components[i]);
        if (memcmp(&number, &last, sizeof number) == 0) continue;
        spti_glsl_format(out, "    if (component >= %d) number = %F;\n", (int)i, (double)number);
        last = number;
    }
    spti_glsl_put(out, "    return number;\n}\n");
}

void spti_glsl_write_inverse_lipschitz(spti_glsl *out) {
    choose_number(out, "spt_inverse_lipschitz", inverse_lipschitz);
}

void spti_glsl_write_floor_of_size(spti_glsl *out) {
    spti_glsl_put(out, "// 2^-22 times the size of a component: its part of the rounding floor.\n");
    choose_number(out, "spt_floor_of_size", floor_of_size);
}

void spti_glsl_write_detail(spti_glsl *out) {
    spti_glsl_put(out, "// The size of the least features of a component, for normals.\n");
    choose_number(out, "spt_detail", detail);
}

void spti_glsl_write_material(spti_glsl *out) {
    const int32_t *const materials = out->options->scene->materials;
    spti_glsl_put(out, "// The material of a component; -1: none was hit.\n"
                       "int spt_material(int component) {\n    int material = -1;\n");
    for (uint32_t i = 0; i < out->component_count; ++i) {
        spti_glsl_format(out, "    if (component == %d) material = %d;\n", (int)i,
                         (int)materials[i]);
    }
    spti_glsl_put(out, "    return material;\n}\n");
}

/* ---- Bounds --------------------------------------------------------------------------------- */

/* What is written of a bound. */
typedef void bound_fn(spti_glsl *out, int number, const spt_bound *bound);

static void write_bound(spti_glsl *out, uint32_t i, bound_fn *write) {
    spt_bound bound;
    if (out->components[i].field.bound == NULL) return;
    if (!spti_bound_copy(&bound, out->components[i].field.bound)) {
        spti_glsl_stop(out, SPT_BAD_ARGUMENT);
        return;
    }
    write(out, (int)i, &bound);
}

static void write_bounds(spti_glsl *out, bound_fn *write) {
    for (uint32_t i = 0; i < out->component_count; ++i) {
        if (out->components[i].field.bound == NULL) continue;
        write_bound(out, i, write);
        spti_glsl_put(out, "\n");
    }
}

static void choose_bound(spti_glsl *out, const char *call) {
    for (uint32_t i = 0; i < out->component_count; ++i) {
        if (out->components[i].field.bound == NULL) continue;
        spti_glsl_format(out, "    if (component == %d) ", (int)i);
        spti_glsl_format(out, call, (int)i);
    }
}

void spti_glsl_write_clip_0(spti_glsl *out) {
    write_bound(out, 0, spti_glsl_clip);
}

void spti_glsl_write_clip(spti_glsl *out) {
    write_bounds(out, spti_glsl_clip);
    spti_glsl_begin_guard(out, "spt_clip");
    spti_glsl_put(out, "vec2 spt_clip(int component, vec3 origin, vec3 direction, float span, "
                       "float reach,\n              vec2 range) {\n");
    choose_bound(out, "range = spt_clip_%d(origin, direction, span, reach, range);\n");
    spti_glsl_put(out, "    return range;\n}\n");
    spti_glsl_end_guard(out, "spt_clip");
}

void spti_glsl_write_hull_0(spti_glsl *out) {
    write_bound(out, 0, spti_glsl_hull);
}

void spti_glsl_write_hull(spti_glsl *out) {
    write_bounds(out, spti_glsl_hull);
    spti_glsl_put(out, "vec3 spt_hull(int component, vec3 p) {\n    vec3 nearest = p;\n");
    choose_bound(out, "nearest = spt_hull_%d(p);\n");
    spti_glsl_put(out, "    return nearest;\n}\n");
}

/* ---- Models --------------------------------------------------------------------------------- */

void spti_glsl_write_probe(spti_glsl *out) {
    spti_glsl_probe(out, &out->components[0].field);
}

void spti_glsl_write_place(spti_glsl *out) {
    spti_glsl_place(out, &out->components[0].field);
}
