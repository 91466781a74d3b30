/* SPDX-License-Identifier: MIT
 *
 * The shapes of accuracy_shapes_list.h as a table over one number type, and what else of shapes.h
 * is measured. A file that defines ACCURACY_TYPE to float or double, and SPT_SHAPES_DOUBLE for
 * double, gets the contents. Constants are numbers of float in both. */
#ifndef TESTS_REPORT_ACCURACY_SHAPES_TABLE_H
#define TESTS_REPORT_ACCURACY_SHAPES_TABLE_H

#include <stddef.h>

typedef struct accuracy_shape {
    const char *name;
    double size;
    int exponents;
    double (*slope)(void);
    void (*values)(size_t count, const double (*points)[3], double *values);
} accuracy_shape;

extern const accuracy_shape accuracy_shapes_float[], accuracy_shapes_double[];
extern const int accuracy_shape_count;

/* The distance from a tube around the arc through three points. */
double accuracy_arc_float(const float points[3][3], float radius, const double p[3]);
double accuracy_arc_double(const float points[3][3], float radius, const double p[3]);

#endif

#ifdef ACCURACY_TYPE
#include <spheretrace/shapes.h>

#define ACCURACY_JOIN(name, type) name##type
#define ACCURACY_OF(name, type) ACCURACY_JOIN(name, type)
#define ACCURACY_NAME(name) ACCURACY_OF(name, ACCURACY_TYPE)

SPT_SHAPE spt_real real(double value) {
    return (spt_real)(float)value;
}

SPT_SHAPE spt_point at(double x, double y, double z) {
    return spt_point_of(real(x), real(y), real(z));
}

SPT_SHAPE spt_real ball(spt_point p) {
    return spt_sphere(spt_translate(p, at(0.75, 0.5, 0)), 1);
}

SPT_SHAPE spt_real block(spt_point p) {
    return spt_box(p, at(0.5, 1, 0.75));
}

/* What is built before it is asked: three faces of a cube and one across its corner, a dodecahedron
 * as slabs, an arc, a rotation. */
typedef struct parts {
    spt_half_space corner[4], dodecahedron[6];
    spt_arc bent;
    spt_rotation oblique;
} parts;

static parts parts_of(void) {
    static const double normals[4][3] = {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {0.48, 0.6, 0.64}};
    static const double offsets[4] = {0.5, 0.625, 0.75, 0.875};
    parts made;
    for (int i = 0; i < 4; ++i) {
        made.corner[i].normal = at(normals[i][0], normals[i][1], normals[i][2]);
        made.corner[i].offset = real(offsets[i]);
    }
    for (int i = 0; i < 6; ++i) {
        const double a = 0.850650808352040, b = i % 2 ? -0.525731112119134 : 0.525731112119134;
        made.dodecahedron[i].normal = i < 2 ? at(a, b, 0) : i < 4 ? at(0, a, b) : at(b, 0, a);
        made.dodecahedron[i].offset = 1;
    }
    made.bent = spt_arc_of(at(-1, 0, 0.5), at(1, 0.5, 0), at(0.25, 1, -0.5), real(0.25));
    made.oblique = spt_rotation_of(at(1, -2, 0.5), real(0.75));
    return made;
}

#define SHAPE(name, size, slope, exponents, field) \
    static double name##_slope(void) { \
        const parts made = parts_of(), *const with = &made; \
        (void)with; \
        return (double)(slope); \
    } \
    static void name##_values(size_t count, const double(*points)[3], double *values) { \
        const parts made = parts_of(), *const with = &made; \
        (void)with; \
        for (size_t i = 0; i < count; ++i) { \
            const spt_point p = spt_point_of((spt_real)points[i][0], (spt_real)points[i][1], \
                                             (spt_real)points[i][2]); \
            values[i] = (double)(field); \
        } \
    }
#include "accuracy_shapes_list.h"
#undef SHAPE

const accuracy_shape ACCURACY_NAME(accuracy_shapes_)[] = {
#define SHAPE(name, size, slope, exponents, field) \
    {#name, size, exponents, name##_slope, name##_values},
#include "accuracy_shapes_list.h"
#undef SHAPE
};

double ACCURACY_NAME(accuracy_arc_)(const float points[3][3], float radius, const double p[3]) {
    spt_point at_points[3];
    for (int i = 0; i < 3; ++i)
        at_points[i] =
            spt_point_of((spt_real)points[i][0], (spt_real)points[i][1], (spt_real)points[i][2]);
    const spt_arc arc = spt_arc_of(at_points[0], at_points[1], at_points[2], (spt_real)radius);
    const spt_point q = spt_point_of((spt_real)p[0], (spt_real)p[1], (spt_real)p[2]);
    return (double)spt_toroidal_capsule(q, &arc);
}
#endif
