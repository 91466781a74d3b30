/* SPDX-License-Identifier: MIT
 *
 * The table of pieces: the texts of all rooms and what is written by code, in the order in which
 * they stand in a shader. A piece names only pieces before it. */
#include "pieces.h"

#include "../base/arguments.h"
#include "../bound/bound.glsl.h"
#include "../frame/camera.glsl.h"
#include "../frame/cone.glsl.h"
#include "../krs/binary.glsl.h"
#include "../krs/distort.glsl.h"
#include "../krs/krs.glsl.h"
#include "../krs/mobius.glsl.h"
#include "../surface/landing.glsl.h"
#include "../surface/light.glsl.h"
#include "../surface/normals.glsl.h"
#include "../surface/offset.glsl.h"
#include "../surface/refine.glsl.h"
#include "../surface/reverse.glsl.h"
#include "../trace/trace.glsl.h"
#include "program.glsl.h"
#include "shapes_math.glsl.h"
#include "shapes_operators.glsl.h"
#include "shapes_polytopes.glsl.h"
#include "shapes_primitives.glsl.h"
#include "write.h"

typedef struct written_piece {
    const char *name;
    spti_glsl_write_fn *write;
    int one;     /* only where there is one component: with several, another piece brings it */
    int several; /* it writes several functions */
} written_piece;

static const written_piece fields[] = {
    {"spt_map", spti_glsl_write_map, 0, 1},
    {"spt_scene_distance", spti_glsl_write_nearest, 0, 0},
    {"spt_component_at", spti_glsl_write_component_at, 0, 0},
    {"spt_inverse_lipschitz", spti_glsl_write_inverse_lipschitz, 0, 0},
    {"spt_floor_of_size", spti_glsl_write_floor_of_size, 0, 0},
    {"spt_detail", spti_glsl_write_detail, 0, 0},
    {"spt_material", spti_glsl_write_material, 0, 0},
    {"spt_clip_0", spti_glsl_write_clip_0, 1, 0},
    {"spt_clip", spti_glsl_write_clip, 0, 1},
    {"spt_hull_0", spti_glsl_write_hull_0, 1, 0},
    {"spt_hull", spti_glsl_write_hull, 0, 0},
    {"spt_probe", spti_glsl_write_probe, 0, 0},
    {"spt_kernel_at", spti_glsl_write_place, 0, 0},
};

static const written_piece traces[] = {
    {"spt_trace", spti_glsl_write_trace, 0, 1},
    {"spt_trace_shadow", spti_glsl_write_trace_shadow, 0, 1},
    {"spt_trace_back", spti_glsl_write_trace_back, 0, 0},
};

/* A room's pieces: texts, or what is written by code. */
typedef struct room {
    const spti_glsl_piece *pieces;
    const written_piece *written;
    uint32_t count;
} room;

#define TEXTS(list) \
    { list, NULL, sizeof list / sizeof *list }
#define WRITTEN(list) \
    { NULL, list, sizeof list / sizeof *list }

static const room rooms[] = {
    TEXTS(spti_glsl_macros),
    TEXTS(spti_glsl_basis),
    TEXTS(spti_glsl_shapes_math),
    TEXTS(spti_glsl_shapes_primitives),
    TEXTS(spti_glsl_shapes_polytopes),
    TEXTS(spti_glsl_shapes_operators),
    TEXTS(spti_glsl_bound),
    TEXTS(spti_glsl_krs_pieces),
    TEXTS(spti_glsl_mobius_pieces),
    TEXTS(spti_glsl_distort_pieces),
    WRITTEN(fields),
    TEXTS(spti_glsl_march_parts),
    WRITTEN(traces),
    TEXTS(spti_glsl_binary_pieces),
    TEXTS(spti_glsl_reverse),
    TEXTS(spti_glsl_landing),
    TEXTS(spti_glsl_refine),
    TEXTS(spti_glsl_normals),
    TEXTS(spti_glsl_offset),
    TEXTS(spti_glsl_light),
    TEXTS(spti_glsl_camera),
    TEXTS(spti_glsl_cone),
    TEXTS(spti_glsl_cone_pass),
    TEXTS(spti_glsl_picture),
};
enum { ROOMS = sizeof rooms / sizeof *rooms };

static int is_reached(const spti_glsl *out, uint32_t number) {
    return (int)(out->reached[number / 32] >> number % 32 & 1);
}

static const char *name_of(const room *in, uint32_t i) {
    return in->pieces != NULL ? in->pieces[i].name : in->written[i].name;
}

void spti_glsl_reach(spti_glsl *out, const char *word) {
    uint32_t number = 0;
    if (strncmp(word, "spt_", 4) != 0 && strncmp(word, "Spt", 3) != 0 &&
        strncmp(word, "SPT_", 4) != 0) {
        return;
    }
    for (int r = 0; r < ROOMS; ++r) {
        for (uint32_t i = 0; i < rooms[r].count; ++i, ++number) {
            if (strcmp(name_of(&rooms[r], i), word) != 0) continue;
            if (rooms[r].written != NULL && rooms[r].written[i].one &&
                spti_glsl_has(out, SPTI_GLSL_BIT(many))) {
                return;
            }
            out->reached[number / 32] |= 1u << number % 32;
            return;
        }
    }
}

static int is_guarded(const spti_glsl *out, const char *name) {
    if (out->options->target != SPT_GLSL_LIBRARY) return 0;
    return strncmp(name, "spt_", 4) == 0 || strncmp(name, "Spt", 3) == 0;
}

/* SPT_OWN_TRACE of spt_trace, SPT_OWN_RAY of SptRay. */
void spti_glsl_begin_guard(spti_glsl *out, const char *name) {
    if (!is_guarded(out, name)) return;
    spti_glsl_put(out, "#ifndef SPT_OWN_");
    for (const char *c = name + (name[0] == 's' ? 4 : 3); *c != '\0'; ++c) {
        const char upper = (char)(*c >= 'a' && *c <= 'z' ? *c - 'a' + 'A' : *c);
        spti_glsl_put_bytes(out, &upper, 1);
    }
    spti_glsl_put(out, "\n");
}

void spti_glsl_end_guard(spti_glsl *out, const char *name) {
    if (is_guarded(out, name)) spti_glsl_put(out, "#endif\n");
}

static void write_piece(spti_glsl *out, const room *in, uint32_t i) {
    const char *const name = name_of(in, i);
    if (in->written != NULL && in->written[i].several) {
        in->written[i].write(out);
        return;
    }
    spti_glsl_begin_guard(out, name);
    if (in->pieces != NULL) {
        spti_glsl_expand(out, in->pieces[i].text, NULL);
    } else {
        in->written[i].write(out);
    }
    spti_glsl_end_guard(out, name);
}

void spti_glsl_reach_all(spti_glsl *out) {
    uint32_t number = 0;
    for (int r = 0; r < ROOMS; ++r) number += rooms[r].count;
    for (int r = ROOMS; r-- > 0;) {
        for (uint32_t i = rooms[r].count; i-- > 0;) {
            if (is_reached(out, --number)) write_piece(out, &rooms[r], i);
        }
    }
}

void spti_glsl_write_pieces(spti_glsl *out) {
    uint32_t number = 0;
    for (int r = 0; r < ROOMS; ++r) {
        for (uint32_t i = 0; i < rooms[r].count && out->status == SPT_OK; ++i, ++number) {
            if (!is_reached(out, number)) continue;
            /* Macros stand close together. */
            if (r > 0) spti_glsl_put(out, "\n");
            write_piece(out, &rooms[r], i);
        }
    }
}
