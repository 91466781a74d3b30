/* SPDX-License-Identifier: MIT
 *
 * Writing GLSL: pieces of text that are written only where what is written names them, with lines
 * that depend on conditions; numbers that do not pass through a locale. */
#ifndef SPTI_GLSL_WRITER_H
#define SPTI_GLSL_WRITER_H

#include <spheretrace/glsl.h>

#include "../base/glsl_piece.h"

/* What lines of a text may depend on. Traits of the step rule, features, settings.flags, and what
 * kind of program it is. */
#define SPTI_GLSL_CONDITIONS(X) \
    X(many) /* several components, which functions take the number of */ \
    X(library) \
    X(shadertoy) \
    X(compute) \
    X(picture) /* a program of colours, which shows rays out of budget where they are */ \
    X(exact)   /* the target has `precise` */ \
    X(back)    /* the march of spt_trace_convex(), in the unit of the one that calls it */ \
    X(probes)  /* of the step rule (methods/methods.h): */ \
    X(pending) \
    X(blends) \
    X(secant)    /* it is spt_convex() */ \
    X(remembers) /* it has a memory */ \
    X(striding)  /* its steps are not the certified radius (but with `between`, where spt_convex()
                     * takes plain ones) */ \
    X(stepping)  /* it looks at the step behind it, or something else does */ \
    X(first)     /* and at whether there was one */ \
    X(seen)      /* SptHit has room for a candidate */ \
    X(views)     /* the uniform `view` chooses what a picture shows */ \
    X(eye)       /* something asks for the path before the ray, */ \
    X(paired)    /* or for the radius at both ends of a step */ \
    X(guards)    /* features */ \
    X(flags) \
    X(candidate) \
    X(fallbacks) \
    X(component) \
    X(path) \
    X(normal) \
    X(refine) \
    X(offset) \
    X(shadow) \
    X(occlusion) \
    X(reverse) /* SPT_GLSL_CONVEX */ \
    X(binary) \
    X(starts) \
    X(depth) \
    X(merged) \
    X(place) \
    X(skip_start) /* settings.flags */ \
    X(stop_inside) \
    X(penumbra) \
    X(closest) \
    X(between) /* one of the last two */ \
    X(pixel)   /* there is a pixel cone: the radius is not the constant 0 */ \
    X(sized)   /* the rounding floor has a part of the size of the scene */ \
    X(bounded) /* the component, or one of many, has a bound */ \
    X(materials) \
    X(pinhole) /* the camera; else orthographic */

enum {
#define X(name) spti_glsl_is_##name,
    SPTI_GLSL_CONDITIONS(X)
#undef X
        SPTI_GLSL_CONDITION_COUNT
};

#define SPTI_GLSL_BIT(name) (UINT64_C(1) << spti_glsl_is_##name)

enum {
    SPTI_GLSL_PIECES = 512, /* most pieces of all rooms */
    SPTI_GLSL_WORD = 66     /* an identifier that is looked up is shorter */
};

/* A field to trace. */
typedef struct spti_glsl_component {
    spt_field field; /* a copy, whose bound is the caller's */
    float inverse_lipschitz, floor_of_size;
    float detail; /* for normals */
    int convex;   /* traced by spt_convex() although the settings' rule is another */
} spti_glsl_component;

typedef struct spti_glsl {
    const spt_glsl_options *options; /* the copy, checked */
    const spti_glsl_component *components;
    spt_settings settings;
    const char *const *names; /* SPT_GLSL_NAMES, all there */
    uint32_t uniforms;        /* those that are uniforms in this target */
    uint64_t conditions;
    char *buffer; /* NULL while scanning */
    size_t capacity, length;
    uint32_t line; /* of what was written so far, counted from 1 */
    int scanning;  /* nothing is written, what is named is marked */
    char word[SPTI_GLSL_WORD];
    unsigned word_length;
    int comment; /* 0; 1: after a slash; 2: to the end of the line; 3: to its end; 4: there,
                        * after a star */
    uint32_t reached[SPTI_GLSL_PIECES / 32];
    uint32_t component_count;
    float inverse_lipschitz, floor_of_size, detail; /* where functions take no component */
    float light[3];                                 /* of unit length */
    int number_of[SPT_GLSL_FIELDS];       /* of each component: the K of its spt_field_K(vec3 p) */
    uint32_t used;                        /* parameters that were named (bit SPT_GLSL_NAME_...) */
    uint32_t fields;                      /* numbers of fields that were given out */
    uint32_t depth;                       /* how deep the field that is written is nested */
    const char *prelude[SPT_GLSL_FIELDS]; /* those that were written */
    uint32_t preludes;
    uint32_t texts;    /* bodies of the caller's so far, for the numbers of source strings */
    int callers;       /* what is put now is a text of the caller's, */
    int naming;        /* or the name of a uniform; */
    int own_word;      /* the word that is being read is neither */
    uint32_t clashes;  /* names of uniforms that are words of our texts, too */
    spt_status status; /* what stopped the writing */
} spti_glsl;

/* ---- Text ----------------------------------------------------------------------------------- */

/* Writes bytes as they are. */
void spti_glsl_put(spti_glsl *out, const char *text);
void spti_glsl_put_bytes(spti_glsl *out, const char *text, size_t length);

/* Writes a text of a room (base/glsl_piece.h says how it is written), with `arguments` for $0, $1 ... in it;
 * NULL where it has none. */
void spti_glsl_expand(spti_glsl *out, const char *text, const char *const *arguments);

/* Writes by a format: %f a double as a float literal, %F the same without brackets around negative
 * ones, %d an int, %v a const float[3] as vec3(...), %s a string as it is, %% a percent sign.
 * Everything else as it is, conditions and $ too: it is for text that depends on a scene's numbers.
 */
void spti_glsl_format(spti_glsl *out, const char *format, ...);

/* "1.0", "-2.5e-7" (brackets around negative ones where wanted), in at most 24 characters with the
 * zero; returns how many without it. A number that reads back to the same bits, but 0.0 for those
 * below FLT_MIN. The number must be finite. */
size_t spti_glsl_number(float number, int brackets, char text[24]);

/* ---- Fields --------------------------------------------------------------------------------- */

/* Whether a caller's text is acceptable (glsl.h). */
int spti_glsl_text_is_good(const char *text);

/* Writes the functions that a text needs, once for all that are equal; NULL: none. */
void spti_glsl_prelude(spti_glsl *out, const char *prelude);

/* Writes a function of a caller's: `head` up to the body, "float spt_field_3(vec3 p)", and the body
 * in brackets, with the line numbers of its own. */
void spti_glsl_body(spti_glsl *out, const char *head, const char *body);

/* Writes the functions of a field, inner ones first, and returns its number K: it is then
 * float spt_field_K(vec3 p). Stops the writing (status) where it cannot be written. */
int spti_glsl_field(spti_glsl *out, const spt_field *field);

/* The next number for a field's functions; after all its inner ones have theirs. */
int spti_glsl_next_field(spti_glsl *out);

/* What one of the library's own fields is, told by its text being one of these (base/marks.h), and
 * who writes it: as spti_glsl_field(). */
typedef int spti_glsl_field_fn(spti_glsl *out, const spt_field *field);
spti_glsl_field_fn spti_glsl_krs, spti_glsl_moekrs, spti_glsl_conformal, spti_glsl_distorted,
    spti_glsl_level_set;

/* Writes vec2 spt_clip_N(vec3 origin, vec3 direction, float span, float reach, vec2 range), N the
 * number of the component: `range` (t_in, t_out) cut with where the ray is in the bound, as
 * spt_trace() does it (bound/interval_kernel.h). Empty: first > second. span: |direction|; reach:
 * the largest coordinate of the origin. `bound` is a copy (bound_check.h), no callback. */
void spti_glsl_clip(spti_glsl *out, int number, const spt_bound *bound);

/* Writes vec3 spt_hull_N(vec3 p): the point nearest to p of the bound, a sphere, or of the box of any
 * other. */
void spti_glsl_hull(spti_glsl *out, int number, const spt_bound *bound);

static inline int spti_glsl_has(const spti_glsl *out, uint64_t bits) {
    return (out->conditions & bits) == bits;
}

/* Stops the writing; the first reason counts. */
static inline void spti_glsl_stop(spti_glsl *out, spt_status status) {
    if (out->status == SPT_OK) out->status = status;
}

#endif
