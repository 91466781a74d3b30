/* SPDX-License-Identifier: MIT
 *
 * Every function of shapes.h in GLSL: the bits that the C function gives, for drawn arguments at
 * drawn points; that a caller's text may name each; that no function of the headers is without. */
#include "glsl_check.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>

#include "../../src/glsl/shapes_math.glsl.h"
#include "../../src/glsl/shapes_operators.glsl.h"
#include "../../src/glsl/shapes_polytopes.glsl.h"
#include "../../src/glsl/shapes_primitives.glsl.h"
#include "../../src/glsl/writer.h"
#include "shapes_table.h"

enum { points = 4096, most_pieces = 256 };

/* ---- Texts ---------------------------------------------------------------------------------- */

static char text[1 << 18];
static spti_glsl out;

static void begin_text(const char *head, spt_glsl_target target) {
    static spt_glsl_options options;
    options = spt_glsl_options_default();
    options.target = (uint32_t)target;
    memset(&out, 0, sizeof out);
    out.options = &options;
    out.buffer = text;
    out.capacity = sizeof text;
    spti_glsl_put(&out, head);
}

static void end_text(void) {
    CHECK(out.status == SPT_OK && out.length < sizeof text);
    text[out.length < sizeof text ? out.length : 0] = '\0';
}

/* All pieces of the four lists, in the order in which they are written. */
static const spti_glsl_piece *all_pieces[most_pieces];

static int find_pieces(void) {
    int count = 0;
#define GATHER(list) \
    for (size_t i = 0; i < sizeof(list) / sizeof *(list); ++i) all_pieces[count++] = &(list)[i];
    GATHER(spti_glsl_shapes_math)
    GATHER(spti_glsl_shapes_primitives)
    GATHER(spti_glsl_shapes_polytopes)
    GATHER(spti_glsl_shapes_operators)
#undef GATHER
    return count;
}

static int belongs_to_word(char c) {
    return isalnum((unsigned char)c) || c == '_';
}

/* How often a word stands in the code of a text, comments left out. */
static int count_word(const char *code, const char *word) {
    const size_t length = strlen(word);
    int count = 0;
    for (const char *at = code; *at != '\0'; ++at) {
        if (at[0] == '/' && at[1] == '/') at += strcspn(at, "\n");
        if (at > code && belongs_to_word(at[-1])) continue;
        count += strncmp(at, word, length) == 0 && !belongs_to_word(at[length]);
    }
    return count;
}

/* The pieces that the question needs; all of them where it is NULL. */
static void put_functions(const char *question) {
    int needed[most_pieces] = {0};
    const int count = find_pieces();
    for (int i = count; i-- > 0;) {
        const char *const name = all_pieces[i]->name;
        needed[i] = question == NULL || count_word(question, name) > 0;
        for (int k = i + 1; k < count && !needed[i]; ++k) {
            needed[i] = needed[k] && count_word(all_pieces[k]->text, name) > 0;
        }
    }
    for (int i = 0; i < count; ++i) {
        if (needed[i]) spti_glsl_expand(&out, all_pieces[i]->text, NULL);
    }
    spti_glsl_put(&out, helpers);
}

/* ---- Bits ----------------------------------------------------------------------------------- */

enum { stride = 4 + most_arguments };

typedef struct comparison {
    int differ, number; /* how many do, and which number of the answer is the worst */
    double difference;
    const float *in;
    float c, glsl;
} comparison;

static void compare(comparison *worst, double slack, const float *in, const float *c,
                    const float *glsl) {
    double largest = 1;
    for (int k = 0; k < stride; ++k) largest = fmax(largest, fabs((double)in[k]));
    for (int k = 0; k < most_results; ++k) {
        const double difference = fabs((double)c[k] - (double)glsl[k]);
        const double allowed = slack * fmax(largest, fabs((double)c[k]));
        if (check_same_bits(c[k], glsl[k]) || (slack > 0 && difference <= allowed)) continue;
        ++worst->differ;
        if (worst->differ > 1 && !(difference > worst->difference)) continue;
        worst->difference = difference;
        worst->number = k;
        worst->in = in;
        worst->c = c[k];
        worst->glsl = glsl[k];
    }
}

static void report(const shape *this, const comparison *worst, int count) {
    char numbers[most_arguments * 16 + 1] = "";
    if (worst->differ == 0) return;
    for (int k = 0; k < count; ++k) {
        const size_t length = strlen(numbers);
        snprintf(numbers + length, sizeof numbers - length, " %.9g", (double)worst->in[4 + k]);
    }
    CHECK_SAY(0,
              "%s: %d differ, worst number %d: %.9g in C, %.9g in GLSL, at (%.9g, %.9g, %.9g) by%s",
              this->name, worst->differ, worst->number, (double)worst->c, (double)worst->glsl,
              (double)worst->in[0], (double)worst->in[1], (double)worst->in[2], numbers);
}

static float all_in[points][stride], all_out[points][most_results];
static float expected[points][most_results];

/* Nothing is precise in the shader but what the pieces bring, so that each must bring its own; with
 * targets that have no `precise` these bring nothing. */
static void check_shape(const shape *this, spt_glsl_target target, double slack) {
    char question[2048];
    int count = 0;
    memset(all_in, 0, sizeof all_in);
    memset(expected, 0, sizeof expected);
    for (int i = 0; i < points; ++i) {
        float *const in = all_in[i];
        const int steps = i % 4 == 0 ? 4 : 0;
        const spt_point p = draw_point(steps);
        memcpy(in, &p, sizeof p);
        count = draw_all(this->arguments, steps, in + 4);
        this->ask(p, in + 4, expected[i]);
    }
    begin_text("#version 450 core\n", target);
    format_question(this, question, sizeof question);
    put_functions(question);
    spti_glsl_format(&out,
                     "layout(local_size_x = 8, local_size_y = 8) in;\n"
                     "layout(std430, binding = 0) readonly buffer in_buffer { float all_in[]; };\n"
                     "layout(std430, binding = 1) writeonly buffer out_buffer { vec4 all_r[]; };\n"
                     "void main() {\n"
                     "    int i = int(gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * 64u);\n"
                     "    int at = %d * i;\n"
                     "    vec3 p = vec3(all_in[at], all_in[at + 1], all_in[at + 2]);\n"
                     "    float a[%d];\n"
                     "    for (int k = 0; k < %d; ++k) a[k] = all_in[at + 4 + k];\n"
                     "%s    for (int k = 0; k < 5; ++k) all_r[5 * i + k] = r[k];\n"
                     "}\n",
                     stride, count, count, question);
    end_text();
    const engine_compute run = {ENGINE_GL_45, text,
                                64,           points / 64,
                                all_in[0],    sizeof all_in / sizeof(float),
                                all_out[0],   sizeof all_out / sizeof(float),
                                NULL,         0};
    CHECK_SAY(engine_gl_compute(&run) == ENGINE_OK, "%s does not run", this->name);
    comparison worst = {0, 0, 0, NULL, 0, 0};
    for (int i = 0; i < points; ++i) {
        compare(&worst, slack, all_in[i], expected[i], all_out[i]);
    }
    report(this, &worst, count);
}

static void S1_same_bits_as_c(void) {
    for (int i = 0; i < shape_count; ++i) {
        if (shapes[i].ask == NULL) continue;
        check_shape(&shapes[i], SPT_GLSL_COMPUTE_450, shapes[i].slack);
    }
}

/* Where an arc is nearly straight its numbers differ from those of C, but not what they describe:
 * each distance is off by less than 1e-6 times the coordinates and the size (shapes.h). */
static void ask_built_capsule(spt_point p, const float *a, float *r) {
    const spt_arc built = spt_arc_of(spt_point_of(a[0], a[1], a[2]), spt_point_of(a[3], a[4], a[5]),
                                     spt_point_of(a[6], a[7], a[8]), a[9]);
    r[0] = spt_toroidal_capsule(p, &built);
}

static void S2_flat_arcs(void) {
    static const shape flat = {
        "spt_arc_of",
        "Sz",
        "spt_toroidal_capsule(p, spt_arc_of(vec3(a[0], a[1], a[2]), vec3(a[3], a[4], a[5]),\n"
        "                                   vec3(a[6], a[7], a[8]), a[9]))",
        "float",
        "r[0].x = value;",
        2e-6,
        ask_built_capsule};
    check_shape(&flat, SPT_GLSL_COMPUTE_450, flat.slack);
    check_shape(&flat, SPT_GLSL_FRAGMENT_330, flat.slack);
}

/* GLSL may then contract, re-associate and take zeros of either sign (glsl.h). */
static void S3_without_precise(void) {
    for (int i = 0; i < shape_count; ++i) {
        /* Nearly whole circles magnify errors in the numbers of the arc; above are distances. */
        if (shapes[i].ask == NULL || strcmp(shapes[i].type, "SptArc") == 0) continue;
        check_shape(&shapes[i], SPT_GLSL_FRAGMENT_330, 2e-6);
    }
}

/* ---- Through the door ----------------------------------------------------------------------- */

/* A field that asks for one number of the answer, with arguments that are constants of its text. */
typedef struct asked {
    const shape *shape;
    int number;
    float a[most_arguments];
} asked;

static float answer(void *user, float x, float y, float z) {
    const asked *const this = user;
    float r[most_results] = {0};
    this->shape->ask(spt_point_of(x, y, z), this->a, r);
    return r[this->number];
}

static void put_constants(char *body, size_t size, const float *a, int count) {
    snprintf(body, size, "const float a[%d] = float[%d](\n", count, count);
    for (int k = 0; k < count; ++k) {
        const size_t length = strlen(body);
        snprintf(body + length, size - length, "float(%.9g)%s\n", (double)a[k],
                 k + 1 < count ? "," : ");");
    }
}

/* What the body of a caller's text may do: name any function, and have the bits of the callback. */
static void check_text(const shape *this) {
    static char body[8192], question[2048];
    static float in[points][4], seen[points][4];
    asked user = {this, 0, {0}};
    const int count = draw_all(this->arguments, 4, user.a);
    const engine_uniform size = {"spt_size", ENGINE_IVEC2, {64, points / 64, 0, 0}};
    spt_field field = spt_field_default();
    spt_glsl_options options = spt_glsl_options_default();
    const spt_settings settings = spt_settings_default();
    user.number = this->type[0] == 'v' ? (int)(check_random() % 3) : 0;
    format_question(this, question, sizeof question);
    put_constants(body, sizeof body, user.a, count);
    snprintf(body + strlen(body), sizeof body - strlen(body), "%sreturn r[0][%d];\n", question,
             user.number);
    field.point = answer;
    field.user = &user;
    field.glsl = body;
    field.glsl_prelude = helpers;
    options.field = &field;
    options.settings = &settings;
    options.target = SPT_GLSL_COMPUTE_450;
    options.program = SPT_GLSL_POINTS;
    CHECK(spt_glsl_check_field(&field, points, check_random(), in[0]) == SPT_OK);
    const spt_status status = spt_glsl_emit(&options, text, sizeof text, NULL);
    CHECK_SAY(status == SPT_OK, "%s: status %d", this->name, (int)status);
    const engine_compute run = {ENGINE_GL_45, text,    64,         points / 64, in[0],
                                4 * points,   seen[0], 4 * points, &size,       1};
    CHECK_SAY(status == SPT_OK && engine_gl_compute(&run) == ENGINE_OK, "%s", this->name);
    for (int i = 0; i < points; ++i) {
        const double difference = fabs((double)in[i][3] - (double)seen[i][0]);
        CHECK_SAY(check_same_bits(in[i][3], seen[i][0]) || difference < 8 * this->slack,
                  "%s: %.9g in C, %.9g in GLSL, at (%.9g, %.9g, %.9g)", this->name,
                  (double)in[i][3], (double)seen[i][0], (double)in[i][0], (double)in[i][1],
                  (double)in[i][2]);
    }
}

static void S4_callers_texts(void) {
    for (int i = 0; i < shape_count; ++i) {
        if (shapes[i].ask != NULL) check_text(&shapes[i]);
    }
}

/* ---- The lists ------------------------------------------------------------------------------ */

/* Each piece names only pieces before it, and itself once; its lines fit; it says what it is. */
static void S5_pieces(void) {
    const int count = find_pieces();
    for (int i = 0; i < count; ++i) {
        const char *const code = all_pieces[i]->text;
        CHECK_SAY(strncmp(code, "// ", 3) == 0 || strstr(code, "#define") != NULL, "%s",
                  all_pieces[i]->name);
        for (const char *line = code; *line != '\0'; line += strcspn(line, "\n") + 1) {
            CHECK_SAY(strcspn(line, "\n") <= 100 && strchr(line, '\n') != NULL, "%s", line);
        }
        if (strchr(code, '#') == NULL) {
            CHECK_SAY(count_word(code, all_pieces[i]->name) == 1, "%s", all_pieces[i]->name);
        }
        for (int k = i + 1; k < count; ++k) {
            CHECK_SAY(count_word(code, all_pieces[k]->name) == 0, "%s names %s",
                      all_pieces[i]->name, all_pieces[k]->name);
        }
    }
}

static int is_listed(const char *name) {
    for (int i = 0; i < shape_count; ++i) {
        if (strcmp(shapes[i].name, name) == 0) return 1;
    }
    return 0;
}

/* Every function that the headers define for callers is in the list; returns how many. */
static int check_header(const char *path) {
    char line[512];
    int count = 0;
    FILE *const header = fopen(path, "r");
    CHECK_SAY(header != NULL, "%s, from the folder of the Makefile", path);
    while (header != NULL && fgets(line, sizeof line, header) != NULL) {
        if (strncmp(line, "SPT_SHAPE ", 10) != 0 && strncmp(line, "static inline ", 14) != 0) {
            continue;
        }
        line[strcspn(line, "(\n")] = '\0';
        const char *name = line + strlen(line);
        while (name > line && belongs_to_word(name[-1])) --name;
        if (strncmp(name, "spt_", 4) != 0) continue; /* spti_: internal */
        ++count;
        CHECK_SAY(is_listed(name), "%s of %s is not in shapes_list.h", name, path);
    }
    if (header != NULL) fclose(header);
    return count;
}

static void S6_every_function_is_listed(void) {
    static const char *const headers[] = {"math", "primitives", "polytopes", "operators"};
    int count = 0;
    for (int i = 0; i < 4; ++i) {
        char path[64];
        snprintf(path, sizeof path, "include/spheretrace/shapes_%s.h", headers[i]);
        count += check_header(path);
    }
    CHECK_SAY(count == shape_count, "%d in the headers, %d in the list", count, shape_count);
    for (int i = 0; i < shape_count; ++i) {
        const shape *const this = &shapes[i];
        const int asked_for = this->ask == NULL || count_word(this->expression, this->name) > 0;
        CHECK_SAY(asked_for, "%s", this->name);
    }
}

/* ---- Another front end ---------------------------------------------------------------------- */

/* A shader that asks each shape. */
static void write_all_questions(const char *head, spt_glsl_target target) {
    char question[2048];
    begin_text(head, target);
    put_functions(NULL);
    for (int i = 0; i < shape_count; ++i) {
        if (shapes[i].ask == NULL) continue;
        format_question(&shapes[i], question, sizeof question);
        spti_glsl_format(&out, "float ask_%d(vec3 p, float a[%d]) {\n%s    return r[0].x;\n}\n", i,
                         (int)most_arguments, question);
    }
    spti_glsl_format(&out,
                     "layout(location = 0) out vec4 color;\nvoid main() {\n"
                     "    float a[%d], sum = 0.0;\n"
                     "    for (int k = 0; k < %d; ++k) a[k] = gl_FragCoord.x;\n",
                     (int)most_arguments, (int)most_arguments);
    for (int i = 0; i < shape_count; ++i) {
        if (shapes[i].ask != NULL) {
            spti_glsl_format(&out, "    sum += ask_%d(gl_FragCoord.xyz, a);\n", i);
        }
    }
    spti_glsl_put(&out, "    color = vec4(sum);\n}\n");
    end_text();
}

static void S7_validator(void) {
    static const struct {
        const char *head;
        spt_glsl_target target;
    } versions[] = {
        {"#version 330 core\n", SPT_GLSL_FRAGMENT_330},
        {"#version 300 es\nprecision highp float;\nprecision highp int;\n",
         SPT_GLSL_FRAGMENT_300_ES},
        {"#version 450 core\n", SPT_GLSL_COMPUTE_450},
    };
    if (system("glslangValidator -v >/dev/null 2>&1") != 0) {
        check_skip("no glslangValidator");
        return;
    }
    for (size_t i = 0; i < sizeof versions / sizeof *versions; ++i) {
        char path[512], command[1100];
        write_all_questions(versions[i].head, versions[i].target);
        snprintf(path, sizeof path, "%s/shapes.frag", engine_folder());
        FILE *const file = fopen(path, "w");
        CHECK(file != NULL && fputs(text, file) >= 0);
        CHECK(file != NULL && fclose(file) == 0);
        snprintf(command, sizeof command, "glslangValidator -S frag %s", path);
        CHECK_SAY(system(command) == 0, "%s", versions[i].head);
    }
}

void suite_shapes_glsl(void) {
    RUN(S1_same_bits_as_c);
    RUN(S2_flat_arcs);
    RUN(S3_without_precise);
    RUN(S4_callers_texts);
    RUN(S5_pieces);
    RUN(S6_every_function_is_listed);
    RUN(S7_validator);
}
