/* SPDX-License-Identifier: MIT
 *
 * Row H4 for the texts that callers bring with their fields: what could reach out of its place is
 * refused with nothing written; the rest stands in the text byte for byte, with lines numbered as
 * its author sees them. */
#include "check.h"
#include "test_glsl_world.h"

#include <stdio.h>
#include <string.h>

static glsl_world world;
static glsl_text text;

enum { longest = 1 << 20 };

/* Where a text of a caller's may stand. */
typedef enum place { BODY, PRELUDE, OF_SCENE, OF_KERNEL, OF_MAP, places } place;

static spt_status with(place where, const char *callers) {
    static const glsl_subject subjects[places] = {GLSL_BALL, GLSL_SHAPES, GLSL_SCENE,
                                                  GLSL_KRS_FIELD, GLSL_MAP};
    glsl_world_make(&world, subjects[where]);
    switch (where) {
    case BODY:
        world.field.glsl = callers;
        break;
    case PRELUDE:
        world.field.glsl_prelude = callers;
        break;
    case OF_SCENE:
        world.fields[8].glsl = callers;
        break;
    case OF_KERNEL:
        world.krs.kernels[0].glsl = callers;
        break;
    default:
        world.distorted.distortion.glsl = callers;
        break;
    }
    check_context("place %d", (int)where);
    return glsl_world_emit(&world);
}

static void refuse(const char *callers) {
    for (int where = 0; where < places; ++where) {
        const spt_status status = with((place)where, callers);
        CHECK_SAY(status == SPT_BAD_ARGUMENT, "\"%.40s\": %s", callers, spt_status_name(status));
    }
}

static void accept(const char *callers) {
    for (int where = 0; where < places; ++where) {
        const spt_status status = with((place)where, callers);
        CHECK_SAY(status == SPT_OK, "\"%.40s\": %s", callers, spt_status_name(status));
        if (status == SPT_OK) CHECK(strstr(world.text, callers) != NULL);
    }
}

static void H4j_texts_that_reach_out(void) {
    static const char *const bad[] = {"",
                                      "return 1.0; }",
                                      "{ return 1.0;",
                                      "return (1.0;",
                                      "return 1.0);",
                                      "return a[0;",
                                      "return a0];",
                                      "return (1.0];",
                                      "{ return 1.0; ) ( }",
                                      "} {",
                                      "return 1.0; /*",
                                      "return 1.0; /* { } ",
                                      "/*/ return 1.0;",
                                      "#define p 1\nreturn 1.0;",
                                      "return 1.0;\n#endif",
                                      "return 1.0; // #",
                                      "return 1.0; \\\n",
                                      "return 1.0; // it's",
                                      "return \"1.0\";",
                                      "return 1.0; // \\",
                                      "return 1.0;\r\n",
                                      "return 1.0;\x01",
                                      "return 1.0;\x7f",
                                      "return 1.0;\x0c",
                                      "return 1.0; // \xc3\xa4",
                                      "return 1.0;\xff",
                                      "return 1.0;\x80"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) refuse(bad[i]);
}

static void H4k_texts_that_are_right(void) {
    static const char *const good[] = {
        "return 1.0;",
        "return 1.0; // a comment at the end, with { ( [ in it",
        "return 1.0; // */",
        "return 1.0; /* ) } ] and // inside */",
        "/**/ return 1.0; /* * / */",
        "\treturn 1.0;\n\n\n",
        "float a[3];\nfor (int i = 0; i < 3; ++i) {\n  a[i] = p.x;\n}\nreturn a[0];",
        "return 1.0; // ?@$`~!%^&|"};
    for (size_t i = 0; i < sizeof good / sizeof *good; ++i) accept(good[i]);
}

/* A comment at the end of a text without a newline must not swallow what comes behind. */
static void H4l_open_lines_are_closed(void) {
    const spt_status status = with(BODY, "return p.x; // no newline here");
    CHECK(status == SPT_OK);
    if (status != SPT_OK) return;
    glsl_text_allow_nothing(&text);
    glsl_text_allow_text(&text, world.field.glsl);
    CHECK_SAY(glsl_text_read(&text, world.text) && glsl_text_parse(&text), "%s", text.fault);
    CHECK((glsl_text_what(&text, "spt_trace") & GLSL_IS_FUNCTION) != 0);
}

static void H4m_lengths_of_texts(void) {
    static char memory[longest + 2];
    static char room[longest + (1 << 17)];
    size_t length = 0;
    memset(memory, '\n', sizeof memory);
    memcpy(memory, "return p.x;", 11);
    memory[longest + 1] = 0;
    CHECK(with(BODY, memory) == SPT_BAD_ARGUMENT && with(PRELUDE, memory) == SPT_BAD_ARGUMENT);
    memory[longest] = 0; /* 2^20 bytes */
    glsl_world_make(&world, GLSL_BALL);
    world.field.glsl = memory;
    CHECK(spt_glsl_emit(&world.options, room, sizeof room, &length) == SPT_OK);
    CHECK(length > longest && strlen(room) == length && strstr(room, memory) != NULL);
}

/* ---- Where they stand ------------------------------------------------------------------------ */

static int count_of(const char *source, const char *part) {
    int count = 0;
    for (const char *at = strstr(source, part); at != NULL; at = strstr(at + 1, part)) ++count;
    return count;
}

static void H4n_equal_preludes_are_written_once(void) {
    static char copy[256];
    glsl_world_make(&world, GLSL_SCENE);
    strcpy(copy, world.shapes.glsl_prelude);
    world.fields[1].glsl_prelude = copy; /* equal, at another address */
    check_context("preludes");
    CHECK(glsl_world_audit(&world, &text));
    CHECK(count_of(world.text, "my_box(vec3 p) {") == 1);
    world.fields[3].glsl_prelude = "float my_other(vec3 p) { return my_box(p); }";
    CHECK(glsl_world_emit(&world) == SPT_OK);
    CHECK(count_of(world.text, "my_box(vec3 p) {") == 1);
    CHECK(count_of(world.text, "my_other(vec3 p) {") == 1);
}

/* #line N 0 gives the next line its own number again; #line 1 S stands before a caller's text, whose
 * source string is 2 i + 1 for body i and 2 i + 2 for its prelude. Libraries have none. */
static void look_at_line_numbers(const char *source, int is_library) {
    uint32_t line = 1;
    int inside = 0, directives = 0;
    for (const char *at = source; *at != 0; ++line) {
        unsigned number, string;
        if (sscanf(at, "#line %u %u", &number, &string) == 2) {
            ++directives;
            if (string == 0) CHECK_SAY(number == line + 1, "line %u says %u", line, number);
            if (string > 0) CHECK_SAY(number == 1, "line %u says %u", line, number);
            CHECK_SAY((string > 0) != inside, "line %u", line);
            inside = string > 0;
        }
        at += strcspn(at, "\n");
        at += *at == '\n';
    }
    CHECK(!inside);
    CHECK((directives == 0) == is_library);
}

static unsigned string_before(const char *source, const char *part) {
    const char *at = strstr(source, part);
    unsigned number = 0, string = 0;
    CHECK_SAY(at != NULL && at > source, "%s", part);
    if (at == NULL || at == source) return 0;
    for (--at; at > source && at[-1] != '\n'; --at) {
    }
    CHECK(sscanf(at, "#line %u %u", &number, &string) == 2 && number == 1);
    return string;
}

static void H4o_line_numbers(void) {
    static const glsl_subject some[] = {GLSL_BALL,      GLSL_SHAPES, GLSL_SCENE,
                                        GLSL_KRS_FIELD, GLSL_MAP,    GLSL_NESTED};
    for (int i = 0; i < 6; ++i) {
        for (uint32_t target = 0; target < SPT_GLSL_TARGETS; ++target) {
            glsl_world_make(&world, some[i]);
            world.options.target = target;
            if (target == SPT_GLSL_SHADERTOY) world.options.program = SPT_GLSL_PICTURE;
            check_context("%s, target %u", glsl_subject_names[some[i]], (unsigned)target);
            CHECK(glsl_world_emit(&world) == SPT_OK);
            look_at_line_numbers(world.text, target == SPT_GLSL_LIBRARY);
        }
    }
    glsl_world_make(&world, GLSL_SHAPES);
    world.options.target = SPT_GLSL_FRAGMENT_330;
    CHECK(glsl_world_emit(&world) == SPT_OK);
    CHECK(string_before(world.text, world.field.glsl) == 1);
    CHECK(string_before(world.text, world.field.glsl_prelude) == 2);
}

/* The library's own fields are told by what their text is; a caller's copy of it is none of them, and
 * has no user that is a model. */
static void H4p_marks_of_our_own_fields(void) {
    for (int subject = GLSL_KRS_0; subject <= GLSL_LEVEL_SET; ++subject) {
        char copy[256];
        glsl_world_make(&world, (glsl_subject)subject);
        const char *const mark = world.field.glsl;
        CHECK(mark != NULL && strlen(mark) < sizeof copy);
        if (mark == NULL || strlen(mark) >= sizeof copy) continue;
        strcpy(copy, mark);
        world.field = world.ball;
        world.field.glsl = copy;
        world.field.user = NULL;
        CHECK(glsl_world_emit(&world) == SPT_BAD_ARGUMENT);
    }
}

void suite_glsl_texts(void) {
    RUN(H4j_texts_that_reach_out);
    RUN(H4k_texts_that_are_right);
    RUN(H4l_open_lines_are_closed);
    RUN(H4m_lengths_of_texts);
    RUN(H4n_equal_preludes_are_written_once);
    RUN(H4o_line_numbers);
    RUN(H4p_marks_of_our_own_fields);
}
