/* SPDX-License-Identifier: MIT
 *
 * Kernel-reflection sequences as GLSL: level by level, each with what it needs, or as a loop over
 * arrays. */
#include "../base/arguments.h"
#include "../base/marks.h"
#include "write_krs.h"
#define SPT_LANES 1
#include "../krs/shape_kernel.h"

/* ---- Models ---------------------------------------------------------------------------------- */

spt_field spti_glsl_kernel_field(const spt_built_kernel *kernel) {
    spt_field field = spt_field_default();
    field.batch = kernel->batch;
    field.point = kernel->point;
    field.user = kernel->user;
    field.lipschitz = kernel->lipschitz;
    field.glsl = kernel->glsl;
    field.glsl_prelude = kernel->glsl_prelude;
    return field;
}

void spti_glsl_over(spti_glsl *out, float lipschitz) {
    if (!(lipschitz >= 1.0f && lipschitz <= 1.0f)) {
        spti_glsl_format(out, " / %F", (double)lipschitz);
    }
}

int spti_glsl_model_of(const spt_field *field, spti_glsl_model *model) {
    memset(model, 0, sizeof *model);
    if (field->glsl == spti_mark_krs) {
        const spt_krs *const krs = field->user;
        model->levels = krs->levels;
        model->kernels = krs->kernels;
        model->mirrors = krs->mirrors;
    } else if (field->glsl == spti_mark_moekrs) {
        const spt_moekrs *const moekrs = field->user;
        model->levels = moekrs->levels;
        model->kernels = moekrs->kernels;
        model->maps = moekrs->maps;
        model->unmirrored = moekrs->unmirrored;
    } else if (field->glsl == spti_mark_conformal) { /* a model of one level and no mirror */
        const spt_conformal *const conformal = field->user;
        model->levels = 1;
        model->kernels = conformal->kernels;
        model->maps = &conformal->map;
        model->unmirrored = 1;
    } else {
        return 0;
    }
    return 1;
}

/* The highest level that has this level's field as its kernel. */
static uint32_t first_with(const spti_glsl_model *model, uint32_t level) {
    const spt_built_kernel *const own = &model->kernels[level];
    for (uint32_t above = model->levels; above > level; --above) {
        const spt_built_kernel *const kernel = &model->kernels[above];
        if (kernel->kind == SPT_KERNEL_FIELD && kernel->glsl == own->glsl &&
            kernel->glsl_prelude == own->glsl_prelude && kernel->user == own->user) {
            return above;
        }
    }
    return level;
}

/* How many numbers a field's functions take. */
static int numbers_of(const spt_field *field) {
    spti_glsl_model model;
    int count = 1;
    if (field->glsl == spti_mark_distorted) {
        return 1 + numbers_of(&((const spt_distorted *)field->user)->inner);
    }
    if (field->glsl == spti_mark_level_set) {
        return 1 + numbers_of(&((const spt_level_set *)field->user)->inner);
    }
    if (!spti_glsl_model_of(field, &model)) return 1;
    for (uint32_t level = model.levels + 1; level-- > 0;) {
        if (model.kernels[level].kind != SPT_KERNEL_FIELD) continue;
        if (first_with(&model, level) != level) continue;
        const spt_field inner = spti_glsl_kernel_field(&model.kernels[level]);
        count += numbers_of(&inner);
    }
    return count;
}

/* Gives each field its number, in the order in which they are written. out: NULL where they were
 * the first that was written. */
static void number_fields(spti_glsl *out, spti_glsl_model *model) {
    int written = 0;
    for (uint32_t level = model->levels + 1; level-- > 0;) {
        if (model->kernels[level].kind != SPT_KERNEL_FIELD) continue;
        const uint32_t first = first_with(model, level);
        const spt_field inner = spti_glsl_kernel_field(&model->kernels[level]);
        if (first != level) {
            model->fields[level] = model->fields[first];
        } else if (out != NULL) {
            model->fields[level] = spti_glsl_field(out, &inner);
        } else {
            written += numbers_of(&inner);
            model->fields[level] = written - 1;
        }
    }
}

void spti_glsl_model_fields(spti_glsl *out, spti_glsl_model *model) {
    number_fields(out, model);
}

/* While scanning what is named counts, and not the order. */
void spti_glsl_model_fields_once(spti_glsl *out, spti_glsl_model *model) {
    const uint32_t fields = out->fields;
    if (!out->scanning && fields > 0) {
        number_fields(NULL, model);
        return;
    }
    number_fields(out, model);
    if (out->scanning) out->fields = fields;
}

/* ---- Kernels --------------------------------------------------------------------------------- */

static const spti_glsl_call kernel_calls[SPT_KERNEL_KINDS] = {
    {NULL, {{NULL, 0}}},
    {"spt_kernel_sphere", {{"sphere_center", 3}, {"sphere_radius", 1}}},
    {"spt_kernel_half_space", {{"plane_normal", 3}, {"plane_offset", 1}}},
    {"spt_kernel_capsule",
     {{"capsule_middle", 3},
      {"capsule_outward", 3},
      {"capsule_along", 3},
      {"capsule_normal", 3},
      {"capsule_arc", 4},
      {"capsule_radius", 1}}},
    {"spt_kernel_leaf",
     {{"leaf_middle", 3},
      {"leaf_outward", 3},
      {"leaf_along", 3},
      {"leaf_normal", 3},
      {"leaf_arc", 4},
      {"leaf_radius", 1}}},
    {NULL, {{NULL, 0}}}};

static const spti_glsl_call mirror_call = {"spt_fold",
                                           {{"mirror_normal", 3}, {"mirror_offset", 1}}};

static void kernel_row(const spt_built_kernel *kernel, float row[SPTI_GLSL_ROW]) {
    memcpy(row, kernel->number, (SHAPE_RADIUS + 1) * sizeof *row);
    if (kernel->kind == SPT_KERNEL_SPHERE || kernel->kind == SPT_KERNEL_HALF_SPACE) {
        row[SHAPE_CENTER + 3] = kernel->number[SHAPE_RADIUS];
    }
}

static void mirror_row(const spt_mirror *mirror, float row[SPTI_GLSL_ROW]) {
    memcpy(row, mirror->normal, sizeof mirror->normal);
    row[3] = mirror->offset;
}

/* Where the point is. */
static const char *point_of(const spti_glsl_model *model, spti_glsl_question question) {
    if (model->maps == NULL) return "p";
    return question == SPTI_GLSL_CLEARANCE ? "ball.at" : "way.at";
}

/* Without callers' fields there is nothing but numbers. */
static int has_fields(const spti_glsl_model *model) {
    int any = 0;
    for (uint32_t level = 0; level <= model->levels; ++level) {
        any |= model->kernels[level].kind == SPT_KERNEL_FIELD;
    }
    return any;
}

/* What is done with a kernel's distance stands around it. level: -1 in a loop. */
static void begin_kernel(spti_glsl *out, const spti_glsl_model *model, spti_glsl_question question,
                         int level) {
    const int guarded = spti_glsl_has(out, SPTI_GLSL_BIT(guards)) && has_fields(model);
    switch (question) {
    case SPTI_GLSL_DISTANCE:
        spti_glsl_put(out, guarded ? "d = spt_nearer(d, " : "d = min(d, ");
        if (model->maps != NULL) spti_glsl_put(out, "spt_pull_bound(way, ");
        break;
    case SPTI_GLSL_CLEARANCE:
        spti_glsl_put(out, "d = spt_ball_nearer(ball, d, ");
        break;
    case SPTI_GLSL_NEAREST:
        spti_glsl_put(out, "spt_take_nearer(");
        if (level >= 0) spti_glsl_format(out, "%d", level);
        if (level < 0) spti_glsl_put(out, "level");
        spti_glsl_put(out, ", least, kernel,");
        spti_glsl_put(out,
                      model->maps != NULL ? "\n                    spt_pull_radius(way, " : " ");
        break;
    }
}

static void end_kernel(spti_glsl *out, const spti_glsl_model *model, spti_glsl_question question) {
    const int twice = model->maps != NULL && question != SPTI_GLSL_CLEARANCE;
    spti_glsl_put(out, twice ? "));\n" : ");\n");
}

static void put_field_kernel(spti_glsl *out, const spti_glsl_model *model,
                             spti_glsl_question question, uint32_t level) {
    spti_glsl_format(out, "spt_field_%d(%s)", model->fields[level], point_of(model, question));
    spti_glsl_over(out, model->kernels[level].lipschitz);
}

/* ---- Level by level -------------------------------------------------------------------------- */

static int is_mirrored(const spti_glsl_model *model, uint32_t level) {
    return level < model->levels && !(model->unmirrored >> level & 1);
}

static void put_level(spti_glsl *out, const spti_glsl_model *model, spti_glsl_question question,
                      uint32_t level) {
    const char *const at = point_of(model, question);
    const spt_built_kernel *const kernel = &model->kernels[level];
    float row[SPTI_GLSL_ROW];
    if (level < model->levels || model->maps != NULL || kernel->kind != SPT_KERNEL_EMPTY) {
        spti_glsl_format(out, "    // level %d\n", (int)level);
    }
    if (model->maps == NULL && level < model->levels) {
        mirror_row(&model->mirrors[level], row);
        spti_glsl_put(out, "    p = ");
        spti_glsl_put_call(out, &mirror_call, at, row, NULL, "");
        spti_glsl_put(out, ";\n");
    } else if (model->maps != NULL) {
        if (is_mirrored(model, level)) {
            spti_glsl_format(out, "    %s = spt_pull_mirror(%s);\n", at, at);
        }
        if (level > 0) spti_glsl_map(out, &model->maps[level - 1], question);
    }
    if (kernel->kind == SPT_KERNEL_EMPTY) return;
    spti_glsl_put(out, "    ");
    begin_kernel(out, model, question, (int)level);
    if (kernel->kind == SPT_KERNEL_FIELD) {
        put_field_kernel(out, model, question, level);
    } else {
        kernel_row(kernel, row);
        spti_glsl_put_call(out, &kernel_calls[kernel->kind], at, row, NULL, "        ");
    }
    end_kernel(out, model, question);
}

/* ---- A loop ---------------------------------------------------------------------------------- */

/* Arrays of the kernels of each kind, and which of them is at which level. Returns the kinds that
 * occur, as bits. */
static unsigned put_kernel_arrays(spti_glsl *out, const spti_glsl_model *model) {
    int pairs[SPT_KRS_LEVELS + 1][2];
    unsigned kinds = 0;
    for (uint32_t kind = 0; kind < SPT_KERNEL_KINDS; ++kind) {
        spti_glsl_table table;
        table.count = 0;
        for (uint32_t level = 0; level <= model->levels; ++level) {
            if (model->kernels[level].kind != kind) continue;
            kernel_row(&model->kernels[level], table.rows[table.count]);
            pairs[level][0] = (int)kind;
            pairs[level][1] = table.count++;
        }
        if (table.count > 0) kinds |= 1u << kind;
        if (kernel_calls[kind].function != NULL) {
            spti_glsl_put_arrays(out, &kernel_calls[kind], &table);
        }
    }
    const unsigned shapes = kinds & ~(1u << SPT_KERNEL_EMPTY | 1u << SPT_KERNEL_FIELD);
    /* Of fields each level is told by its number. */
    if ((kinds & (kinds - 1)) == 0 || shapes == 0) return kinds;
    spti_glsl_put(out, "    // kind and place at each level: 0 none, 1 sphere, 2 half space, "
                       "3 capsule, 4 leaf, 5 field\n");
    spti_glsl_put_integers(out, "kernels", 2, (int)model->levels + 1, pairs[0]);
    return kinds;
}

static void put_mirror_arrays(spti_glsl *out, const spti_glsl_model *model) {
    spti_glsl_table table;
    table.count = (int)model->levels;
    for (uint32_t level = 0; level < model->levels; ++level) {
        mirror_row(&model->mirrors[level], table.rows[level]);
    }
    spti_glsl_put_arrays(out, &mirror_call, &table);
}

/* The kernels of a level, in the loop; kinds: those that occur. */
static void put_kernels_of_level(spti_glsl *out, const spti_glsl_model *model,
                                 spti_glsl_question question, unsigned kinds) {
    const int one_kind = (kinds & (kinds - 1)) == 0;
    const unsigned shapes = kinds & ~(1u << SPT_KERNEL_EMPTY | 1u << SPT_KERNEL_FIELD);
    if (!one_kind && shapes != 0) {
        spti_glsl_put(out, "        int kind = kernels[level].x, k = kernels[level].y;\n");
    }
    for (uint32_t kind = 1; kind < SPT_KERNEL_KINDS; ++kind) {
        if (!(shapes >> kind & 1)) continue;
        spti_glsl_put(out, "        ");
        if (!one_kind) spti_glsl_format(out, "if (kind == %d) ", (int)kind);
        begin_kernel(out, model, question, -1);
        spti_glsl_put_call(out, &kernel_calls[kind], point_of(model, question), NULL,
                           one_kind ? "level" : "k", "                ");
        end_kernel(out, model, question);
    }
    for (uint32_t level = model->levels + 1; level-- > 0;) {
        if (model->kernels[level].kind != SPT_KERNEL_FIELD) continue;
        spti_glsl_format(out, "        if (level == %d) ", (int)level);
        begin_kernel(out, model, question, -1);
        put_field_kernel(out, model, question, level);
        end_kernel(out, model, question);
    }
}

static void put_loop(spti_glsl *out, const spti_glsl_model *model, spti_glsl_question question) {
    const char *const at = point_of(model, question);
    const int levels = (int)model->levels;
    const unsigned kinds = put_kernel_arrays(out, model);
    if (model->maps == NULL) {
        put_mirror_arrays(out, model);
    } else {
        spti_glsl_map_arrays(out, model);
    }
    spti_glsl_expand(out, "    for (int i = $zero; ", NULL);
    spti_glsl_format(out, "i <= %d; ++i) {\n        int level = %d - i;\n", levels, levels);
    if (model->maps == NULL) {
        spti_glsl_format(out, "        if (level < %d) p = ", levels);
        spti_glsl_put_call(out, &mirror_call, at, NULL, "level", "");
        spti_glsl_put(out, ";\n");
    } else {
        spti_glsl_map_of_level(out, model, question);
    }
    put_kernels_of_level(out, model, question, kinds);
    spti_glsl_put(out, "    }\n");
}

/* ---- Functions ------------------------------------------------------------------------------- */

void spti_glsl_model_body(spti_glsl *out, const spti_glsl_model *model,
                          spti_glsl_question question) {
    const int in_a_loop = model->levels > 1 && (out->options->features & SPT_GLSL_ARRAYS) != 0;
    if (question == SPTI_GLSL_NEAREST) {
        spti_glsl_put(out, " {\n    float least = 3.0e38;\n    int kernel = -1;\n");
    } else {
        spti_glsl_put(out, " {\n    float d = 3.0e38;\n");
    }
    if (question == SPTI_GLSL_CLEARANCE) {
        spti_glsl_put(out, "    SptBall ball = SptBall(center, radius, false, false);\n");
    } else if (model->maps != NULL) {
        spti_glsl_put(out, "    SptPull way = SptPull(p, 1.0, 0.0, 0.0);\n");
    }
    if (in_a_loop) {
        put_loop(out, model, question);
    } else {
        for (uint32_t level = model->levels + 1; level-- > 0;) {
            put_level(out, model, question, level);
        }
    }
    spti_glsl_put(out, question == SPTI_GLSL_NEAREST     ? "    return kernel;\n}\n"
                       : question == SPTI_GLSL_CLEARANCE ? "    return spt_ball_clearance(ball, "
                                                           "d);\n}\n"
                                                         : "    return d;\n}\n");
}

int spti_glsl_krs(spti_glsl *out, const spt_field *field) {
    spti_glsl_model model;
    spti_glsl_model_of(field, &model);
    spti_glsl_model_fields(out, &model);
    const int number = spti_glsl_next_field(out);
    spti_glsl_format(out,
                     "// A kernel-reflection sequence of %d levels (Szecsi et al. 2016, Algorithm "
                     "1).\nfloat spt_field_%d(vec3 p)",
                     (int)model.levels, number);
    spti_glsl_model_body(out, &model, SPTI_GLSL_DISTANCE);
    return number;
}

void spti_glsl_place(spti_glsl *out, const spt_field *field) {
    spti_glsl_model model;
    if (!spti_glsl_model_of(field, &model) || field->glsl == spti_mark_conformal) {
        spti_glsl_stop(out, SPT_UNSUPPORTED);
        return;
    }
    spti_glsl_model_fields_once(out, &model);
    spti_glsl_put(out, "// The number of the kernel that is nearest; -1: there is none.\n"
                       "int spt_kernel_at(vec3 p)");
    spti_glsl_model_body(out, &model, SPTI_GLSL_NEAREST);
}
