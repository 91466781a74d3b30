/* SPDX-License-Identifier: MIT
 *
 * shapes_list.h as an array: each function with its C code and what is needed to ask for it in
 * GLSL. Static, for one file of tests. */
#ifndef TESTS_GLSL_SHAPES_TABLE_H
#define TESTS_GLSL_SHAPES_TABLE_H

#include <stdio.h>

#include "shapes_draw.h"

enum { most_arguments = 68, most_results = 20 };

typedef struct shape {
    const char *name, *arguments, *expression;
    const char *type;  /* of the result, which is called value, in GLSL */
    const char *taken; /* writes it into vec4 r[] */
    double slack; /* how far off an answer may be, in units of the largest of 1 and the numbers of
                   * the point, the arguments and the answer; 0: same bits */
    void (*ask)(spt_point p, const float *a, float *r);
} shape;

static int whole(float x) {
    return (int)x;
}

static uint32_t bits(float x) {
    return check_bits(x);
}

#define ASK(name, type, expression, ...) \
    static void ask_##name(spt_point p, const float *a, float *r) { \
        const type value = expression; \
        const float results[] = {__VA_ARGS__}; \
        (void)p, (void)a; \
        memcpy(r, results, sizeof results); \
    }
#define COORDINATES(point) (point).x, (point).y, (point).z
#define LOW_AND_HIGH(number) (float)((number)&0xffff), (float)((number) >> 16)
#define NUMBER(name, arguments, expression) ASK(name, float, expression, value)
#define INTEGER(name, arguments, expression) \
    ASK(name, uint32_t, (uint32_t)(expression), LOW_AND_HIGH(value))
#define BITS(name, arguments, expression) ASK(name, uint32_t, expression, LOW_AND_HIGH(value))
#define POINT(name, arguments, expression) ASK(name, spt_point, expression, COORDINATES(value))
#define SURFACE(name, arguments, expression) \
    ASK(name, spt_surface, expression, value.distance, (float)value.material)
#define ROTATION(name, arguments, expression) \
    ASK(name, spt_rotation, expression, COORDINATES(value.x), COORDINATES(value.y), \
        COORDINATES(value.z))
#define ARC(name, arguments, expression) \
    ASK(name, spt_arc, expression, COORDINATES(value.middle), COORDINATES(value.outward), \
        COORDINATES(value.along), COORDINATES(value.normal), value.curvature, value.half_chord, \
        value.cosine, value.sagitta, value.radius)
#define EXEMPT(name)
#include "shapes_list.h"
#undef NUMBER
#undef INTEGER
#undef BITS
#undef POINT
#undef SURFACE
#undef ROTATION
#undef ARC
#undef EXEMPT

/* The builders are in double in C and in pairs of floats in GLSL, which have 48 bits: each of some
 * ten operations loses up to 3 of the units in the last of them, of its largest operand. */
#define PAIRS (64 / 281474976710656.0)

#define NUMBER(name, arguments, expression) \
    {#name, arguments, #expression, "float", "r[0].x = value;", 0, ask_##name},
#define INTEGER(name, arguments, expression) BITS(name, arguments, uint(expression))
#define BITS(name, arguments, expression) \
    {#name, \
     arguments, \
     #expression, \
     "uint", \
     "r[0].xy = vec2(float(value & 0xffffu), float(value >> 16));", \
     0, \
     ask_##name},
#define POINT(name, arguments, expression) \
    {#name, arguments, #expression, "vec3", "r[0].xyz = value;", 0, ask_##name},
#define SURFACE(name, arguments, expression) \
    {#name, \
     arguments, \
     #expression, \
     "SptSurface", \
     "r[0].xy = vec2(value.distance, float(value.material));", \
     0, \
     ask_##name},
#define ROTATION(name, arguments, expression) \
    {#name, \
     arguments, \
     #expression, \
     "SptRotation", \
     "r[0] = vec4(value.x, value.y.x); r[1] = vec4(value.y.yz, value.z.xy); r[2].x = value.z.z;", \
     PAIRS, \
     ask_##name},
#define ARC(name, arguments, expression) \
    {#name, \
     arguments, \
     #expression, \
     "SptArc", \
     "r[0] = vec4(value.middle, value.outward.x); r[1] = vec4(value.outward.yz, value.along.xy);" \
     " r[2] = vec4(value.along.z, value.normal); r[3] = vec4(value.curvature, value.half_chord," \
     " value.cosine, value.sagitta); r[4].x = value.radius;", \
     PAIRS, \
     ask_##name},
#define EXEMPT(name) {#name, NULL, NULL, NULL, NULL, 0, NULL},
static const shape shapes[] = {
#include "shapes_list.h"
};
enum { shape_count = sizeof shapes / sizeof *shapes };

/* ---- Asking in GLSL ------------------------------------------------------------------------- */

/* What the expressions call beside the shapes. */
static const char helpers[] = "int whole(float x) {\n    return int(x);\n}\n"
                              "uint bits(float x) {\n    return floatBitsToUint(x);\n}\n";

/* From the numbers in a[] what the expression calls by name. */
static const char *named_arguments(const shape *this) {
    if (strchr(this->arguments, 'P') != NULL) {
        return "SptHalfSpace planes[SPT_PLANES];\n"
               "for (int k = 0; k < 16; ++k) {\n"
               "    planes[k].normal = vec3(a[4 * k], a[4 * k + 1], a[4 * k + 2]);\n"
               "    planes[k].offset = a[4 * k + 3];\n"
               "}\n";
    }
    if (strchr(this->arguments, 'A') != NULL) {
        return "SptArc arc = SptArc(vec3(a[0], a[1], a[2]), vec3(a[3], a[4], a[5]),\n"
               "                    vec3(a[6], a[7], a[8]), vec3(a[9], a[10], a[11]),\n"
               "                    a[12], a[13], a[14], a[15], a[16]);\n";
    }
    if (strchr(this->arguments, 'R') != NULL) {
        return "SptRotation rotation = SptRotation(vec3(a[0], a[1], a[2]),\n"
               "    vec3(a[3], a[4], a[5]), vec3(a[6], a[7], a[8]));\n";
    }
    return "";
}

/* Statements that ask the shape for p and a[], and leave the answer in r[]. */
static void format_question(const shape *this, char *question, size_t size) {
    snprintf(question, size,
             "%svec4 r[5];\nfor (int k = 0; k < 5; ++k) r[k] = vec4(0.0);\n%s value = %s;\n%s\n",
             named_arguments(this), this->type, this->expression, this->taken);
}

#endif
