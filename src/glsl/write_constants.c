/* SPDX-License-Identifier: MIT
 *
 * Functions of which most arguments are constants: calls of them, and arrays of what they are
 * called with. */
#include <string.h>

#include "write_krs.h"

static void put_vector(spti_glsl *out, const float *numbers, int width) {
    if (width == 1) {
        spti_glsl_format(out, "%F", (double)numbers[0]);
        return;
    }
    spti_glsl_format(out, "vec%d(", width);
    for (int i = 0; i < width; ++i) {
        spti_glsl_format(out, i > 0 ? ", %F" : "%F", (double)numbers[i]);
    }
    spti_glsl_put(out, ")");
}

/* The head of an array, and what stands before an element. */
static void begin_array(spti_glsl *out, const char *type, const char *name, int count) {
    spti_glsl_format(out, "    const %s %s[%d] = %s[%d](", type, name, count, type, count);
}

static void begin_element(spti_glsl *out, int i, int in_a_line) {
    const char *const line = i > 0 ? ",\n        " : "\n        ";
    spti_glsl_put(out, i % in_a_line == 0 ? line : ", ");
}

void spti_glsl_put_arrays(spti_glsl *out, const spti_glsl_call *call,
                          const spti_glsl_table *table) {
    static const char *const types[] = {"", "float", "vec2", "vec3", "vec4"};
    int place = 0;
    for (int i = 0; table->count > 0 && call->columns[i].width > 0; ++i) {
        const int width = call->columns[i].width;
        begin_array(out, types[width], call->columns[i].name, table->count);
        for (int row = 0; row < table->count; ++row) {
            begin_element(out, row, width == 1 ? 6 : 1);
            put_vector(out, &table->rows[row][place], width);
        }
        spti_glsl_put(out, ");\n");
        place += width;
    }
}

void spti_glsl_put_integers(spti_glsl *out, const char *name, int width, int count,
                            const int *numbers) {
    begin_array(out, width == 1 ? "int" : "ivec2", name, count);
    for (int i = 0; i < count; ++i) {
        begin_element(out, i, width == 1 ? 16 : 6);
        if (width == 1) {
            spti_glsl_format(out, "%d", numbers[i]);
        } else {
            spti_glsl_format(out, "ivec2(%d, %d)", numbers[2 * i], numbers[2 * i + 1]);
        }
    }
    spti_glsl_put(out, ");\n");
}

/* How long the numbers of a row are as arguments. */
static size_t length_of(const spti_glsl_call *call, const float *row) {
    char number[24];
    size_t length = 0;
    int count = 0;
    for (int i = 0; call->columns[i].width > 0; ++i) count += call->columns[i].width;
    for (int i = 0; i < count; ++i) length += spti_glsl_number(row[i], 0, number) + strlen(", ");
    return length;
}

void spti_glsl_put_call(spti_glsl *out, const spti_glsl_call *call, const char *at,
                        const float *row, const char *index, const char *indent) {
    const int in_a_line = row != NULL ? 1 : 3;
    const int many = call->columns[2].width > 0 || (row != NULL && length_of(call, row) > 52);
    int place = 0;
    spti_glsl_format(out, "%s(%s", call->function, at);
    for (int i = 0; call->columns[i].width > 0; ++i) {
        if (many && i % in_a_line == 0) {
            spti_glsl_format(out, ",\n%s", indent);
        } else {
            spti_glsl_put(out, ", ");
        }
        if (row != NULL) {
            put_vector(out, &row[place], call->columns[i].width);
        } else {
            spti_glsl_format(out, "%s[%s]", call->columns[i].name, index);
        }
        place += call->columns[i].width;
    }
    spti_glsl_put(out, ")");
}
