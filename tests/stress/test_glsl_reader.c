/* SPDX-License-Identifier: MIT
 *
 * The reader of GLSL that the other suites rely on: it must find each fault, and none in a text
 * that has none. */
#include "check.h"
#include "test_glsl_text.h"

#include <string.h>

static glsl_text text;

static const char good[] = "#version 330 core\n"
                           "layout(location = 0) out vec4 spt_out;\ninvariant spt_out;\n"
                           "uniform ivec2 spt_size;\n"
                           "uniform sampler2D spt_rays;\n"
                           "#define SPT_PRECISE\n"
                           "#define SPT_EPSILON 1.0e-4\n"
                           "// what a text may hold; while and length do not count here\n"
                           "struct SptHit {\n"
                           "    float t, residual; /* a comment */\n"
                           "    int outcome;\n"
                           "};\n"
                           "const float spt_third = 0.333333343;\n"
                           "float spt_map(vec3 p) {\n"
                           "    const vec2 spt_k[2] = vec2[2](vec2(1.0), vec2((-1.0), 0.0));\n"
                           "    SPT_PRECISE float d = p.x * p.x + spt_k[0].y, e = d - (-1.5);\n"
                           "    return e > 0.0 ? -1.0 : spt_third;\n"
                           "}\n"
                           "\n"
                           "SptHit spt_trace(vec3 o, int budget) {\n"
                           "    SptHit hit = SptHit(0.0, 0.0, 0);\n"
                           "    for (int i = 0; i < budget && hit.outcome == 0; ++i) {\n"
                           "        hit.t += spt_map(o + hit.t * vec3(0.0, 0.0, 1.0));\n"
                           "        if (hit.t < SPT_EPSILON) hit.outcome = 1;\n"
                           "    }\n"
                           "    hit.residual = hit.t;\n"
                           "    return hit;\n"
                           "}\n"
                           "void main() {\n"
                           "    vec4 ray = texelFetch(spt_rays, ivec2(gl_FragCoord.xy), 0);\n"
                           "    SptHit hit = spt_trace(ray.xyz, spt_size.x);\n"
                           "    spt_out = vec4(hit.t, hit.residual, float(hit.outcome), 0.0);\n"
                           "}\n";

typedef struct wrong {
    const char *from, *to; /* what is replaced in the good text */
    const char *fault;
} wrong;

static const wrong outside[] = {
    {"hit.residual = hit.t;\n", "hit.residual = hit.t; \n", "blanks"},
    {"    hit.residual", "   hit.residual", "indent"},
    {"    hit.residual", "hit.residual", "indent"},
    {"        if (hit.t", "    if (hit.t", "indent"},
    {"    hit.residual", "\thit.residual", "unknown character"},
    {"a comment", "a c\xc3\xb6mment", "printable"},
    {"\n\nSptHit", "\n\n\nSptHit", "two empty"},
    {"0.0);\n}\n", "0.0);\n}", "newline"},
    {"what a text may hold;",
     "what a text may hold, 123456789 123456789 123456789 123456789 123456789 123456789 123456;",
     "long line"},
    {"hit.t;\n", "hit.t);\n", "does not fit"},
    {"hit.t;\n", "hit.t];\n", "does not fit"},
    {"0.0);\n}\n", "0.0);\n", "open bracket"},
    {"(-1.5)", "-1.5", "without brackets"},
    {"- (-1.5)", "--1.5", "a sign behind"},
    {"1.0e-4", "1.0e-40", "subnormal"},
    {"1.0e-4", "1.0e39", "not finite"},
    {"1.0e-4", "1.0f", "no number"},
    {"1.0e-4", "017", "no integer"},
    {"1.0e-4", "2147483649", "beyond int"},
    {"1.0e-4", "1.0.0", "no number"},
    {"1.0e-4", "nan", "unknown name"},
    {"1.0e-4", "0,0001", ""},
    {"hit.t;\n", "hit.t; #\n", "# inside"},
    {"hit.t;\n", "hit.t; $\n", "unknown character"},
    {"float d ", "float d__e ", "two underlines"},
    {"float d ", "float gl_d ", "gl_"},
    {"float d ", "float half ", "reserved word"},
    {"float d ", "double d ", "reserved word"},
    {"for (int i = 0; i < budget && hit.outcome == 0; ++i)", "while (true)", "reserved word"}};

static const wrong inside[] = {
    {"float d ", "float spt_size ", "hides"},
    {"float d ", "float spt_map ", "hides"},
    {"float d ", "float SPT_EPSILON ", "hides"},
    {"p.x * p.x", "d * p.x", "unknown name"},
    {"p.x * p.x", "q.x * p.x", "unknown name"},
    {"p.x * p.x", "hit.t * p.x", "unknown name"},
    {"p.x * p.x", "spt_trace(p, 1).t", "unknown name"},
    {"p.x * p.x", "p.x * p.extent", "unknown member"},
    {"e > 0.0", "d > 0.0", "not used"},
    {"const float spt_third", "const float third", "begin with spt"},
    {"struct SptHit", "struct Hit", "begin with spt"},
    {"#define SPT_EPSILON 1.0e-4\n", "#define EPSILON 1.0e-4\n", "begin with spt"},
    {"uniform ivec2 spt_size", "uniform ivec2 size", "begin with spt"},
    {"uniform ivec2 spt_size;\n", "uniform ivec2 spt_size;\nuniform int spt_size;\n", "already"},
    {"uniform ivec2 spt_size;\n", "uniform ivec2 spt_size;\nuniform int spt_view;\n", "not used"},
    {"#define SPT_PRECISE\n", "#define SPT_PRECISE\n#define SPT_OTHER 1\n", "not used"},
    {"const float", "const float spt_half = 0.5;\nconst float", "not used"},
    {"struct SptHit", "struct SptRay {\n    float t;\n};\nstruct SptHit", "not used"},
    {"void main", "float spt_dead() {\n    return 1.0;\n}\nvoid main", "no one calls"},
    {"? -1.0", "? spt_map(p)", "circle"},
    {"i < budget && hit.outcome == 0", "i < 16", "constant bound"},
    {"i < budget && hit.outcome == 0", "i < SPT_EPSILON", "constant bound"},
    {"int i = 0; i < budget", "int i = budget; 0 < i", "does not count"},
    {"for (int i = 0; i < budget", "int n = 16;\n    for (int i = 0; i < n", "constant bound"},
    {"i < budget && hit.outcome == 0", "hit.outcome == 0", "does not count"},
    {"void main()", "void main_()", "begin with spt"},
    {"spt_trace(ray.xyz, spt_size.x)", "SptHit(ray.x, 0.0, spt_size.x)", "no one calls"}};

/* The good text with one part replaced. */
static const char *changed(const wrong *change) {
    static char with[4096];
    const char *const at = strstr(good, change->from);
    CHECK_SAY(at != NULL, "%s", change->from);
    if (at == NULL) return good;
    const size_t before = (size_t)(at - good), size = strlen(change->to);
    CHECK(strlen(good) + size < sizeof with);
    memcpy(with, good, before);
    memcpy(with + before, change->to, size);
    strcpy(with + before + size, at + strlen(change->from));
    return with;
}

static int is_found(const char *source) {
    static const char *const roots[] = {"main"};
    return !glsl_text_check(&text, source, 0, roots, 1);
}

static void allow_main(void) {
    glsl_text_allow_nothing(&text);
    glsl_text_allow(&text, "main");
}

static void H6a_reader_accepts_a_sound_text(void) {
    allow_main();
    CHECK_SAY(!is_found(good), "%s", text.fault);
    CHECK(text.function_count == 3);
    CHECK(glsl_text_what(&text, "budget") == (GLSL_IS_LOCAL | GLSL_IS_PARAMETER));
    CHECK(glsl_text_what(&text, "spt_size") == GLSL_IS_UNIFORM);
    CHECK((glsl_text_what(&text, "spt_k") & GLSL_IS_LOCAL) != 0);
    CHECK(glsl_text_what(&text, "nothing") == 0);
    float numbers[64];
    const size_t count = glsl_text_numbers(&text, numbers, 64);
    CHECK(count > 3 && numbers[0] == 1.0e-4f && numbers[1] == 0.333333343f);
    CHECK(numbers[2] == 1.0f && numbers[3] == -1.0f && numbers[4] == 0.0f);
}

static void expect(const wrong *list, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        allow_main();
        const int found = is_found(changed(&list[i]));
        CHECK_SAY(found, "not found: %s", list[i].to);
        CHECK_SAY(strstr(text.fault, list[i].fault) != NULL, "%s: %s", list[i].to, text.fault);
    }
}

static void H6b_reader_finds_faults_outside(void) {
    expect(outside, sizeof outside / sizeof *outside);
}

static void H6c_reader_finds_faults_inside(void) {
    expect(inside, sizeof inside / sizeof *inside);
}

/* What a caller brings may have any name, and need not be called. */
static void H6d_reader_knows_what_callers_bring(void) {
    static const wrong theirs = {"void main",
                                 "float my_dead(float f) {\n    return f;\n}\nvoid main", ""};
    allow_main();
    CHECK(is_found(changed(&theirs)));
    glsl_text_allow(&text, "my_*");
    CHECK_SAY(!is_found(changed(&theirs)), "%s", text.fault);
}

static const char library[] = "#ifndef SPT_EPSILON\n"
                              "#define SPT_EPSILON 1.0e-4\n"
                              "#endif\n"
                              "#ifndef SPT_PRECISE\n"
                              "#if !defined(GL_ES) && __VERSION__ >= 400\n"
                              "#define SPT_PRECISE precise\n"
                              "#else\n"
                              "#define SPT_PRECISE\n"
                              "#endif\n"
                              "#endif\n"
                              "#ifndef spt_map\n"
                              "#define spt_map spt_map\n"
                              "float spt_map(vec3 p) {\n"
                              "    SPT_PRECISE float d = p.x - SPT_EPSILON;\n"
                              "    return d;\n"
                              "}\n"
                              "#endif\n"
                              "#ifndef SPT_HAS_TRACE\n"
                              "float spt_trace(vec3 p) {\n"
                              "    return spt_map(p);\n"
                              "}\n"
                              "#endif\n";

static void H6e_reader_knows_libraries(void) {
    static const wrong faults[] = {
        {"#ifndef spt_map\n#define spt_map spt_map\n", "", "cannot be replaced"},
        {"#ifndef SPT_HAS_TRACE\n", "#ifdef SPT_HAS_TRACE\n", "cannot be replaced"},
        {"#ifndef SPT_EPSILON\n", "#ifndef SPT_OTHER\n", "cannot be replaced"},
        {"#ifndef SPT_EPSILON\n", "#version 330\n#ifndef SPT_EPSILON\n", "with: version"},
        {"float spt_map", "uniform float spt_f;\nfloat spt_map", ""}};
    static const char *const roots[] = {"spt_trace"};
    glsl_text_allow_nothing(&text);
    CHECK_SAY(glsl_text_check(&text, library, 1, roots, 1), "%s", text.fault);
    for (size_t i = 0; i < sizeof faults / sizeof *faults; ++i) {
        static char with[2048];
        const char *const at = strstr(library, faults[i].from);
        const size_t before = (size_t)(at - library);
        memcpy(with, library, before);
        strcpy(with + before, faults[i].to);
        strcat(with, at + strlen(faults[i].from));
        CHECK_SAY(!glsl_text_check(&text, with, 1, roots, 1), "not found: %s", faults[i].to);
        CHECK_SAY(strstr(text.fault, faults[i].fault) != NULL, "%s: %s", faults[i].to, text.fault);
    }
}

void suite_glsl_reader(void) {
    RUN(H6a_reader_accepts_a_sound_text);
    RUN(H6b_reader_finds_faults_outside);
    RUN(H6c_reader_finds_faults_inside);
    RUN(H6d_reader_knows_what_callers_bring);
    RUN(H6e_reader_knows_libraries);
}
