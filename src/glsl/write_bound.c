/* SPDX-License-Identifier: MIT
 *
 * Writes bounding volumes: calls of the pieces of bound.glsl.h with the numbers of one volume, as
 * interval_of_bound() takes them. Left out: the callers' own volumes. */
#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "../bound/bound_check.h"
#include "writer.h"

/* GLSL has no infinity. */
static void literals(const float numbers[3], float to[3]) {
    for (int i = 0; i < 3; ++i) {
        to[i] = spti_finite(numbers[i]) ? numbers[i] : numbers[i] > 0.0f ? 3e38f : -3e38f;
    }
}

/* Whether the box of a copy cuts anything. */
static int has_end(const spt_bound *bound) {
    for (int axis = 0; axis < 3; ++axis) {
        if (spti_finite(bound->low[axis]) || spti_finite(bound->high[axis])) return 1;
    }
    return 0;
}

/* `before` is what is done with the interval. */
static void write_box(spti_glsl *out, const char *before, const spt_bound *bound) {
    float low[3], high[3];
    literals(bound->low, low);
    literals(bound->high, high);
    spti_glsl_format(out,
                     "    %s spt_interval_box(origin, direction, reach, range,\n"
                     "        %v,\n        %v,\n        %f);\n",
                     before, low, high, (double)spti_bound_size(bound));
}

static void write_sphere(spti_glsl *out, const spt_bound *bound) {
    spti_glsl_format(out,
                     "    return spt_interval_sphere(origin, direction, span, reach, range,\n"
                     "        %v, %f, %f);\n",
                     bound->center, (double)bound->radius, (double)spti_bound_size(bound));
}

static void write_axes(spti_glsl *out, const char *function, const spt_bound *bound) {
    spti_glsl_format(out,
                     "    return %s(origin, direction, range,\n        %v,\n"
                     "        %v,\n        %v,\n        %v,\n",
                     function, bound->center, bound->axis[0], bound->axis[1], bound->axis[2]);
}

static void write_ellipsoid(spti_glsl *out, const spt_bound *bound) {
    write_axes(out, "spt_interval_ellipsoid", bound);
    spti_glsl_format(out, "        %v, %f, %f);\n", bound->end, (double)bound->radius,
                     (double)bound->range[0]);
}

/* A capsule or a cylinder. */
static void write_tube(spti_glsl *out, const spt_bound *bound) {
    const int capsule = bound->kind == SPT_BOUND_CAPSULE;
    spti_glsl_format(out, "    return %s(origin, direction, range,\n        %v,\n",
                     capsule ? "spt_interval_capsule" : "spt_interval_cylinder", bound->center);
    if (capsule) spti_glsl_format(out, "        %v,\n", bound->end);
    spti_glsl_format(out, "        %v, %f, %f);\n", bound->axis[0], (double)bound->half[0],
                     (double)bound->radius);
}

/* A caller's normal by a power of two, as volume_normal(). Returns that power, at least 2^-126. */
static float unit_normal(const float normal[3], float to[3]) {
    float most = FLT_MIN, unit;
    uint32_t bits;
    for (int axis = 0; axis < 3; ++axis) {
        if (fabsf(normal[axis]) > most) most = fabsf(normal[axis]);
    }
    if (most > 0x1p126f) most = 0x1p126f;
    memcpy(&bits, &most, sizeof bits);
    bits &= 0xff800000u;
    memcpy(&unit, &bits, sizeof unit);
    unit = 1.0f / unit;
    for (int axis = 0; axis < 3; ++axis) to[axis] = normal[axis] * unit;
    return unit;
}

/* Cuts with what is behind a plane. An offset that overflowed is no constraint in volume_behind(),
 * either. */
static void write_plane(spti_glsl *out, const float normal[3], float offset) {
    if (!spti_finite(offset)) return;
    spti_glsl_format(out,
                     "    range = spt_interval_behind(\n"
                     "        %v, origin, direction, %f, range);\n",
                     normal, (double)offset);
}

static void write_planes(spti_glsl *out, const spt_bound *bound) {
    float normal[3];
    if (bound->kind == SPT_BOUND_SLAB) {
        const float unit = unit_normal(bound->axis[0], normal);
        write_plane(out, normal, bound->range[1] * unit);
        for (int axis = 0; axis < 3; ++axis) normal[axis] = -normal[axis];
        write_plane(out, normal, -bound->range[0] * unit);
    } else {
        for (size_t i = 0; i < bound->plane_count; ++i) {
            const float unit = unit_normal(bound->planes[i].normal, normal);
            write_plane(out, normal, bound->planes[i].offset * unit);
        }
    }
    spti_glsl_put(out, "    return range;\n");
}

void spti_glsl_clip(spti_glsl *out, int number, const spt_bound *bound) {
    spti_glsl_format(
        out,
        "// Where a ray is in bound %d, cut with range; t_in > t_out where it is not.\n"
        "vec2 spt_clip_%d(vec3 origin, vec3 direction, float span, float reach, vec2 range) {\n",
        number, number);
    switch (bound->kind) {
    case SPT_BOUND_SPHERE:
        write_sphere(out, bound);
        break;
    case SPT_BOUND_BOX:
        write_box(out, "return", bound);
        break;
    case SPT_BOUND_ORIENTED_BOX:
        write_axes(out, "spt_interval_oriented_box", bound);
        spti_glsl_format(out, "        %v);\n", bound->half);
        break;
    case SPT_BOUND_ELLIPSOID:
        write_ellipsoid(out, bound);
        break;
    case SPT_BOUND_CAPSULE:
    case SPT_BOUND_CYLINDER:
        write_tube(out, bound);
        break;
    case SPT_BOUND_SLAB:
    case SPT_BOUND_POLYTOPE:
        if (has_end(bound)) write_box(out, "range =", bound);
        write_planes(out, bound);
        break;
    default:
        spti_glsl_stop(out, SPT_UNSUPPORTED);
        break;
    }
    spti_glsl_put(out, "}\n");
}

void spti_glsl_hull(spti_glsl *out, int number, const spt_bound *bound) {
    float low[3], high[3];
    literals(bound->low, low);
    literals(bound->high, high);
    spti_glsl_format(out,
                     "// The point of bound %d, a sphere or the box around any other, that is\n"
                     "// nearest to p.\nvec3 spt_hull_%d(vec3 p) {\n",
                     number, number);
    if (bound->kind == SPT_BOUND_SPHERE) {
        spti_glsl_format(out, "    return spt_hull_sphere(p, %v, %f);\n", bound->center,
                         (double)bound->radius);
    } else if (has_end(bound)) {
        spti_glsl_format(out, "    return min(max(p, %v),\n               %v);\n", low, high);
    } else {
        spti_glsl_put(out, "    return p;\n");
    }
    spti_glsl_put(out, "}\n");
}
