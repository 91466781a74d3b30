/* SPDX-License-Identifier: MIT
 *
 * The fields of test_shapes_list.h as tables of functions, once over float and once over double.
 * A file that defines SHAPES_TABLE to the name of its table also gets the table's contents. */
#ifndef TESTS_TEST_SHAPES_TABLE_H
#define TESTS_TEST_SHAPES_TABLE_H

#include <stddef.h>

#include "test_shapes_oracle.h"

enum {
    SHAPE_EXACT_OUTSIDE = 1,
    SHAPE_EXACT_INSIDE = 2,
    SHAPE_EXACT = 3,
    SHAPE_CONVEX = 4, /* a convex function */
    SHAPE_POWERS = 8  /* goes through exp and log, so that its errors are theirs */
};

/* The points at which fields are asked lie within this of the axes: what the Lipschitz constants of
 * twisted and bent fields are for. */
#define SHAPE_REACH 6

/* The most points that one call of `values` takes. */
enum { SHAPE_BATCH = 64 };

typedef struct shape_entry {
    const char *name;
    double (*value)(double x, double y, double z); /* arguments that are floats */
    /* the same at count points in one loop, which the compiler may vectorise */
    void (*values)(size_t count, const double *x, const double *y, const double *z, double *value);
    double (*lipschitz)(void);
    int flags;
    const shape_body *body; /* what it must be, or NULL */
} shape_entry;

extern const shape_entry shapes_float[], shapes_double[];
extern const size_t shape_count;

/* The mathematics, by the same precisions. */
typedef struct shape_mathematics {
    double (*sine)(double), (*cosine)(double), (*exponential)(double), (*logarithm)(double);
} shape_mathematics;

extern const shape_mathematics mathematics_float, mathematics_double;

#endif

#ifdef SHAPES_TABLE
#include <spheretrace/shapes.h>

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

/* What is built once: a corner of a cube cut off, by three faces towards -x, -y, -z and one across,
 * a dodecahedron as slabs, arcs and a rotation. */
typedef struct test_parts {
    spt_half_space tetrahedron[4], dodecahedron[6];
    spt_arc bent, wound, straight, point;
    spt_rotation oblique;
} test_parts;

static test_parts parts_of(void) {
    const double normals[4][3] = {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {0.48, 0.6, 0.64}};
    const double offsets[4] = {0.5, 0.625, 0.75, 0.875};
    test_parts parts;
    for (int i = 0; i < 4; ++i) {
        parts.tetrahedron[i].normal = at(normals[i][0], normals[i][1], normals[i][2]);
        parts.tetrahedron[i].offset = real(offsets[i]);
    }
    for (int i = 0; i < 6; ++i) {
        const double a = 0.850650808352040, b = i % 2 ? -0.525731112119134 : 0.525731112119134;
        parts.dodecahedron[i].normal = i < 2 ? at(a, b, 0) : i < 4 ? at(0, a, b) : at(b, 0, a);
        parts.dodecahedron[i].offset = 1;
    }
    parts.bent = spt_arc_of(at(-1, 0, 0.5), at(1, 0.5, 0), at(0.25, 1, -0.5), real(0.25));
    parts.wound = spt_arc_of(at(-0.5, 0, 0.25), at(0.5, 0.25, 0), at(0.25, 2, -0.5), real(0.25));
    parts.straight = spt_arc_of(at(-1, 0, 0.5), at(1, 0.5, 0), at(0, 0.25, 0.25), real(0.25));
    parts.point = spt_arc_of(at(0.5, 0, 0), at(0.5, 0, 0), at(0.5, 0, 0), real(0.5));
    parts.oblique = spt_rotation_of(at(1, -2, 0.5), real(0.75));
    return parts;
}

static const test_parts *kept_parts(void) {
    static test_parts parts;
    static int built;
    if (!built) parts = parts_of();
    built = 1;
    return &parts;
}

#define SHAPE(name, field, lipschitz, flags, body) \
    static double name##_value(double x, double y, double z) { \
        const test_parts *const with = kept_parts(); \
        const spt_point p = spt_point_of((spt_real)x, (spt_real)y, (spt_real)z); \
        (void)with; \
        return (double)(field); \
    } \
    static void name##_values(size_t count, const double *x, const double *y, const double *z, \
                              double *value) { \
        const test_parts kept = *kept_parts(), *const with = &kept; \
        spt_real in[3][SHAPE_BATCH], out[SHAPE_BATCH]; \
        (void)with; \
        for (size_t i = 0; i < SHAPE_BATCH; ++i) { \
            in[0][i] = (spt_real)x[i % count]; \
            in[1][i] = (spt_real)y[i % count]; \
            in[2][i] = (spt_real)z[i % count]; \
        } \
        for (size_t i = 0; i < SHAPE_BATCH; ++i) { \
            const spt_point p = spt_point_of(in[0][i], in[1][i], in[2][i]); \
            out[i] = (field); \
        } \
        for (size_t i = 0; i < count; ++i) value[i] = (double)out[i]; \
    } \
    static double name##_lipschitz(void) { \
        const test_parts *const with = kept_parts(); \
        (void)with; \
        return (double)(lipschitz); \
    }
#include "test_shapes_list.h"
#undef SHAPE

const shape_entry SHAPES_TABLE[] = {
#define SHAPE(name, field, lipschitz, flags, body) \
    {#name, name##_value, name##_values, name##_lipschitz, flags, body},
#include "test_shapes_list.h"
#undef SHAPE
};

static double sine(double x) {
    return (double)spt_sin((spt_real)x);
}

static double cosine(double x) {
    return (double)spt_cos((spt_real)x);
}

static double exponential(double x) {
    return (double)spt_exp((spt_real)x);
}

static double logarithm(double x) {
    return (double)spt_log((spt_real)x);
}

const shape_mathematics SHAPES_MATHEMATICS = {sine, cosine, exponential, logarithm};
#endif
