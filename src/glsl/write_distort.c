/* SPDX-License-Identifier: MIT
 *
 * Distorted fields and level sets as GLSL. */
#include <spheretrace/krs.h>
#include <spheretrace/surface.h>

#include "../base/arguments.h"
#include "writer.h"

/* The arguments that name the frame. */
static void put_frame(spti_glsl *out, const spt_distorted *distorted) {
    spti_glsl_format(out, "%v,\n        %v, %v,\n        %v", distorted->distortion.origin,
                     distorted->frame[0], distorted->frame[1], distorted->frame[2]);
}

/* To the region's nearest point and from there back to where the field is: distort_kernel.h. A
 * height along the axis is in y, one along `side` in x; cylinders and cones have it first. */
static void put_kind(spti_glsl *out, const spt_distorted *distorted) {
    const spt_distortion *const distortion = &distorted->distortion;
    const float *const low = distorted->bound.low, *const high = distorted->bound.high;
    const double rate = (double)distortion->rate;
    const float rise = high[1] - low[1], widening = high[0] - low[0];
    const float square = rise * rise + widening * widening + FLT_MIN;
    switch (distortion->kind) {
    case SPT_DISTORTION_TWIST:
        spti_glsl_format(out, "    q = spt_into_cylinder(q.yxz, %F, %F, %F, apart).yxz;\n",
                         (double)low[1], (double)high[1], (double)low[0]);
        spti_glsl_format(out, "    q = spt_twist(q, %F);\n", rate);
        break;
    case SPT_DISTORTION_BEND:
        spti_glsl_format(out, "    q = spt_into_cylinder(q, %F, %F, %F, apart);\n", (double)low[1],
                         (double)high[1], (double)low[0]);
        spti_glsl_format(out, "    q = spt_bend(q.yzx, %F).zxy;\n", rate);
        break;
    case SPT_DISTORTION_TAPER:
        spti_glsl_format(out, "    q = spt_into_cone(q.yxz, vec2(%F, %F), vec2(%F, %F),\n",
                         (double)low[1], (double)high[1], (double)low[0], (double)high[0]);
        spti_glsl_format(out, "        %F, %F, apart).yxz;\n", (double)(widening / rise),
                         (double)(1.0f / square));
        spti_glsl_format(out, "    q = spt_untaper(q, %F);\n", rate);
        break;
    default:
        spti_glsl_format(out, "    q = spt_into_box(q, %v,\n        %v, apart);\n", low, high);
        spti_glsl_format(out, "    q = spt_unsway(q, %F, %F, %F);\n", rate,
                         (double)distortion->wave, (double)distortion->phase);
        break;
    }
}

static void put_deformed(spti_glsl *out, const spt_distorted *distorted, int inner, int number) {
    static const char *const titles[] = {"", "twisted", "bent", "tapered", "swaying"};
    const float lipschitz = distorted->inner.lipschitz * distorted->distortion.lipschitz;
    spti_glsl_format(out,
                     "// A %s field (Hart 1996), beyond a region around the body with the way to "
                     "its nearest\n// point.\nfloat spt_field_%d(vec3 p) {\n    float apart;\n",
                     titles[distorted->distortion.kind], number);
    spti_glsl_put(out, "    vec3 q = spt_into_frame(p, ");
    put_frame(out, distorted);
    spti_glsl_put(out, ");\n");
    put_kind(out, distorted);
    spti_glsl_put(out, "    q = spt_out_of_frame(q, ");
    put_frame(out, distorted);
    spti_glsl_put(out, ");\n");
    spti_glsl_format(out, "    return spt_join_way(spt_field_%d(q), apart, %F, %F);\n}\n", inner,
                     (double)lipschitz, (double)(1.0f / lipschitz));
}

/* The digits of a number below 1000 behind a name, and what follows it. */
static void name_function(char name[64], const char *before, int number, const char *behind) {
    size_t length = strlen(before);
    memcpy(name, before, length);
    for (int power = 100; power > 0; power /= 10) {
        if (number >= power || power == 1) name[length++] = (char)('0' + number / power % 10);
    }
    memcpy(name + length, behind, strlen(behind) + 1);
}

static void put_map(spti_glsl *out, const spt_distorted *distorted, int inner, int number) {
    const spt_distortion *const map = &distorted->distortion;
    const int guarded = spti_glsl_has(out, SPTI_GLSL_BIT(guards));
    char head[64];
    name_function(head, "vec3 spt_unmap_", number, "(vec3 p)");
    spti_glsl_body(out, head, map->glsl);
    spti_glsl_format(out, "float spt_field_%d(vec3 p) {\n    vec3 q = spt_unmap_%d(p);\n", number,
                     number);
    spti_glsl_format(out,
                     guarded ? "    return spt_unless_lost(spt_field_%d(q), q);\n}\n"
                             : "    return spt_field_%d(q);\n}\n",
                     inner);
}

int spti_glsl_distorted(spti_glsl *out, const spt_field *field) {
    const spt_distorted *const distorted = field->user;
    const int mapped = distorted->distortion.kind == SPT_DISTORTION_MAP;
    if (mapped && distorted->distortion.glsl == NULL) {
        spti_glsl_stop(out, SPT_UNSUPPORTED);
        return 0;
    }
    const int inner = spti_glsl_field(out, &distorted->inner);
    if (mapped) spti_glsl_prelude(out, distorted->distortion.glsl_prelude);
    const int number = spti_glsl_next_field(out);
    if (out->status != SPT_OK) return 0;
    if (mapped) {
        put_map(out, distorted, inner, number);
    } else {
        put_deformed(out, distorted, inner, number);
    }
    return number;
}

int spti_glsl_level_set(spti_glsl *out, const spt_field *field) {
    const spt_level_set *const set = field->user;
    const int inner = spti_glsl_field(out, &set->inner);
    const int number = spti_glsl_next_field(out);
    spti_glsl_format(out,
                     "// The level set that the stop at half a pixel does not inflate.\n"
                     "float spt_field_%d(vec3 p) {\n    return spt_level_set(spt_field_%d(p), p, "
                     "%v, %F, %F);\n}\n",
                     number, inner, set->eye, (double)set->path, (double)set->widening);
    return number;
}
