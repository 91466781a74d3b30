/* SPDX-License-Identifier: MIT
 *
 * A field for the processor and, as GLSL, for the GPU: writes the functions that trace it, to be
 * pasted into a shader of one's own. emit.c writes whole programs and pages.
 *
 * usage: shader > functions.glsl */
#include <spheretrace/spheretrace.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* README: begin */
/* A bead on a ring, */
static float bead(void *user, float x, float y, float z) {
    const spt_point p = spt_point_of(x, y, z);
    (void)user;
    return spt_smooth_union(spt_torus(p, 1.0f, 0.2f),
                            spt_sphere(spt_translate(p, spt_point_of(1, 0, 0)), 0.5f), 0.25f);
}

/* and the same for a shader. The shapes have the same names there, and the same bits. */
static const char bead_glsl[] = "    float ring = spt_torus(p, 1.0, 0.2);\n"
                                "    float ball = spt_sphere(p - vec3(1.0, 0.0, 0.0), 0.5);\n"
                                "    return spt_smooth_union(ring, ball, 0.25);\n";

/* Returns the text, to be freed, or NULL where something is refused. */
static char *write_shader(const spt_field *field, const spt_settings *settings) {
    spt_glsl_options options = spt_glsl_options_default();
    size_t length = 0;
    options.field = field;
    options.settings = settings;
    options.target = SPT_GLSL_LIBRARY; /* functions only; there are whole programs, too */
    options.features = SPT_GLSL_NORMAL;
    if (spt_glsl_emit(&options, NULL, 0, &length) != SPT_BUFFER_TOO_SMALL) return NULL;
    char *const text = malloc(length + 1);
    if (text != NULL && spt_glsl_emit(&options, text, length + 1, NULL) != SPT_OK) text[0] = '\0';
    return text;
}
/* README: end */

int main(void) {
    spt_field field = spt_field_default();
    const spt_settings settings = spt_settings_default();
    field.point = bead;
    field.glsl = bead_glsl;
    field.lipschitz = 1.0f;
    char *const text = write_shader(&field, &settings);
    if (text == NULL) return 1;
    fputs(text, stdout);
    /* It holds what was asked for, and not what was not. */
    const int whole = strstr(text, "SptHit spt_trace(SptRay ray, int budget)") != NULL &&
                      strstr(text, "float spt_smooth_union(") != NULL &&
                      strstr(text, "vec3 spt_hit_normal(") != NULL &&
                      strstr(text, "spt_soft_shadow") == NULL && strstr(text, "spt_box") == NULL;
    free(text);
    return whole ? 0 : 1;
}
