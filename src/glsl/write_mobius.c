/* SPDX-License-Identifier: MIT
 *
 * Moebius kernel-reflection sequences and conformal fields as GLSL, and the probes of binary
 * tracing. */
#include "../base/arguments.h"
#include "../base/marks.h"
#include "../bound/bound_check.h"
#include "write_krs.h"

/* ---- Maps ------------------------------------------------------------------------------------ */

/* The two ways to a preimage. */
enum { INVERSION, QUATERNION, WAYS, BOTH_WAYS = 1 << INVERSION | 1 << QUATERNION };

static const spti_glsl_call map_calls[WAYS] = {{"spt_pull_inversion",
                                                {{"map_pole", 3},
                                                 {"map_nearest", 1},
                                                 {"map_row_0", 3},
                                                 {"map_row_1", 3},
                                                 {"map_row_2", 3},
                                                 {"map_center", 3},
                                                 {"map_shrink", 1}}},
                                               {"spt_pull_quaternion",
                                                {{"map_a", 4},
                                                 {"map_b", 4},
                                                 {"map_c", 4},
                                                 {"map_d", 4},
                                                 {"map_infinity", 3},
                                                 {"map_c_length", 1},
                                                 {"map_least", 1},
                                                 {"map_most", 1}}}};

/* A ball, which in a loop all maps have. */
static const spti_glsl_call whole_call = {"", {{"map_whole", 4}}};

static int way_of(const spt_built_map *map) {
    return map->inverts ? INVERSION : QUATERNION;
}

static float *add(float *to, const float *from, size_t count) {
    memcpy(to, from, count * sizeof *to);
    return to + count;
}

/* Real parts last, as GLSL has them. */
static float *add_quaternion(float *to, const float quaternion[4]) {
    return add(add(to, &quaternion[1], 3), quaternion, 1);
}

static void map_row(const spt_built_map *map, float *to) {
    const float nearest = map->inverts ? map->least / map->c_length : 0.0f;
    const float most = map->c_length > 0.0f ? 0x1p80f : 0x1.8p126f; /* as pull_kernel.h has it */
    if (map->inverts) {
        to = add(add(to, map->pole, 3), &nearest, 1);
        to = add(add(to, map->matrix, 9), map->center, 3);
        add(to, &map->c_inverse, 1);
    } else {
        to = add_quaternion(add_quaternion(to, map->a), map->b);
        to = add_quaternion(add_quaternion(to, map->c), map->d);
        to = add(add(to, map->center, 3), &map->c_length, 1);
        add(add(to, &map->least, 1), &most, 1);
    }
}

static const char *variable_of(spti_glsl_question question) {
    return question == SPTI_GLSL_CLEARANCE ? "ball" : "way";
}

static const char *point_of(spti_glsl_question question) {
    return question == SPTI_GLSL_CLEARANCE ? "ball.at" : "way.at";
}

/* "way = spt_pull_level(way, " */
static void begin_map(spti_glsl *out, spti_glsl_question question) {
    const char *const function =
        question == SPTI_GLSL_CLEARANCE ? "spt_ball_level" : "spt_pull_level";
    const char *const variable = variable_of(question);
    spti_glsl_format(out, "%s = %s(%s, ", variable, function, variable);
}

void spti_glsl_map(spti_glsl *out, const spt_built_map *map, spti_glsl_question question) {
    float row[SPTI_GLSL_ROW];
    spti_glsl_put(out, "    ");
    begin_map(out, question);
    spti_glsl_format(out, "vec4(%F, %F, %F, %F),\n        ", (double)map->whole[0],
                     (double)map->whole[1], (double)map->whole[2], (double)map->whole[3]);
    map_row(map, row);
    spti_glsl_put_call(out, &map_calls[way_of(map)], point_of(question), row, NULL, "            ");
    spti_glsl_put(out, ");\n");
}

/* ---- Maps in a loop -------------------------------------------------------------------------- */

/* The ways that occur, as bits. */
static unsigned ways_of(const spti_glsl_model *model) {
    unsigned ways = 0;
    for (uint32_t i = 0; i < model->levels; ++i) ways |= 1u << way_of(&model->maps[i]);
    return ways;
}

void spti_glsl_map_arrays(spti_glsl *out, const spti_glsl_model *model) {
    const unsigned ways = ways_of(model);
    int pairs[SPT_KRS_LEVELS][2], mirrors[SPT_KRS_LEVELS];
    spti_glsl_table table;
    table.count = (int)model->levels;
    for (uint32_t i = 0; i < model->levels; ++i) {
        memcpy(table.rows[i], model->maps[i].whole, sizeof model->maps[i].whole);
        mirrors[i] = !(model->unmirrored >> i & 1);
    }
    spti_glsl_put_arrays(out, &whole_call, &table);
    for (int way = 0; way < WAYS; ++way) {
        table.count = 0;
        for (uint32_t i = 0; i < model->levels; ++i) {
            if (way_of(&model->maps[i]) != way) continue;
            map_row(&model->maps[i], table.rows[table.count]);
            pairs[i][0] = way;
            pairs[i][1] = table.count++;
        }
        spti_glsl_put_arrays(out, &map_calls[way], &table);
    }
    if (ways == BOTH_WAYS) {
        spti_glsl_put(out, "    // kind and place of each: 0 by an inversion, 1 by quaternions\n");
        spti_glsl_put_integers(out, "maps", 2, (int)model->levels, pairs[0]);
    }
    if (model->unmirrored != 0) {
        spti_glsl_put(out, "    // whether there is a mirror at a level\n");
        spti_glsl_put_integers(out, "mirrors", 1, (int)model->levels, mirrors);
    }
}

void spti_glsl_map_of_level(spti_glsl *out, const spti_glsl_model *model,
                            spti_glsl_question question) {
    const char *const at = point_of(question);
    const unsigned ways = ways_of(model);
    spti_glsl_format(out, "        if (level < %d%s) %s = spt_pull_mirror(%s);\n",
                     (int)model->levels, model->unmirrored != 0 ? " && mirrors[level] == 1" : "",
                     at, at);
    spti_glsl_format(out, "        int map = level - 1%s;\n",
                     ways == BOTH_WAYS ? ", m = maps[max(level - 1, 0)].y" : "");
    for (int way = 0; way < WAYS; ++way) {
        if (!(ways >> way & 1)) continue;
        spti_glsl_put(out, "        if (level > 0");
        if (ways == BOTH_WAYS) spti_glsl_format(out, " && maps[map].x == %d", way);
        spti_glsl_put(out, ") ");
        begin_map(out, question);
        spti_glsl_put(out, "map_whole[map],\n                ");
        spti_glsl_put_call(out, &map_calls[way], at, NULL, ways == BOTH_WAYS ? "m" : "map",
                           "                    ");
        spti_glsl_put(out, ");\n");
    }
}

/* ---- Functions ------------------------------------------------------------------------------- */

static int put_mapped(spti_glsl *out, const spt_field *field, const char *title) {
    spti_glsl_model model;
    spti_glsl_model_of(field, &model);
    spti_glsl_model_fields(out, &model);
    const int number = spti_glsl_next_field(out);
    spti_glsl_format(out, "%sfloat spt_field_%d(vec3 p)", title, number);
    spti_glsl_model_body(out, &model, SPTI_GLSL_DISTANCE);
    return number;
}

int spti_glsl_moekrs(spti_glsl *out, const spt_field *field) {
    return put_mapped(out, field,
                      "// A Moebius kernel-reflection sequence (Szecsi et al. 2016, section 7): a "
                      "lower bound of\n// its distance.\n");
}

int spti_glsl_conformal(spti_glsl *out, const spt_field *field) {
    return put_mapped(out, field,
                      "// A field under a Moebius map (Szecsi et al. 2016, section 6).\n");
}

/* What the first probe of binary.c takes its radius from. */
static void put_extent(spti_glsl *out, const spt_bound *bound) {
    float low[3], high[3], extent = 0.0f;
    spt_bound copy;
    if (bound == NULL) return;
    if (!spti_bound_copy(&copy, bound) || spt_bound_extent(&copy, low, high) != SPT_OK) {
        spti_glsl_stop(out, SPT_BAD_ARGUMENT);
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const float side = 0.25f * high[axis] - 0.25f * low[axis];
        if (side > extent && side <= FLT_MAX) extent = side;
    }
    spti_glsl_format(out,
                     "// Half of the largest half side of the bound; 0: it has no end.\n"
                     "float spt_probe_extent() {\n    return %F;\n}\n",
                     (double)extent);
}

void spti_glsl_probe(spti_glsl *out, const spt_field *field) {
    static const char head[] =
        "// Whether a ball is clear of the body: then its clearance is not negative.\n"
        "float spt_probe(vec3 center, float radius)";
    spti_glsl_model model;
    put_extent(out, field->bound);
    if (field->glsl == spti_mark_moekrs && spti_glsl_model_of(field, &model)) {
        spti_glsl_model_fields_once(out, &model);
        spti_glsl_put(out, head);
        spti_glsl_model_body(out, &model, SPTI_GLSL_CLEARANCE);
        return;
    }
    spti_glsl_format(out, "%s {\n    return spt_clearance(spt_map(center), %F, radius);\n}\n", head,
                     (double)field->lipschitz);
}
