/* SPDX-License-Identifier: MIT
 *
 * The scenes and their components as GLSL: that each has a text, or is the library's own to write,
 * and that all of them can be written for every target. Left out: whether the text is right, which
 * tests/glsl/test_scenes_glsl.c looks at. */
#include "../check.h"

#include "scenes/parts.h"
#include "scenes/scenes.h"

#include <stdlib.h>
#include <string.h>

/* Scenes of the list, and behind them the one that is found by its name only. */
static const scene *scene_at(size_t index) {
    return index < scene_count ? scenes[index] : scene_named("krs_tree_28");
}

static void scenes_have_a_text(void) {
    for (size_t s = 0; s <= scene_count; ++s) {
        const scene *const shown = scene_at(s);
        const int lanes[] = {0, 1, spt_lanes()};
        check_context("%s", shown->name);
        CHECK((shown->glsl != NULL) == (shown->field == NULL));
        for (int i = 0; i < 3; ++i) {
            const spt_field field = scene_field(shown, lanes[i]);
            CHECK(field.glsl != NULL);
            if (shown->field == NULL) {
                CHECK(field.glsl == shown->glsl && field.glsl_prelude == shown->glsl_prelude);
            }
        }
    }
}

/* Those of an entry of a table are its own: no two components of a scene have the same. */
static void scenes_components_have_texts(void) {
    static scene_parts parts;
    for (size_t s = 0; s < scene_count; ++s) {
        for (int grain = 0; grain < scene_grains; ++grain) {
            scene_parts_of(scenes[s], (scene_grain)grain, 1, &parts);
            check_context("%s, grain %d", scenes[s]->name, grain);
            for (size_t i = 0; i < parts.scene.count; ++i) {
                CHECK_SAY(parts.fields[i].glsl != NULL, "component %zu", i);
                for (size_t k = 0; k < i && parts.fields[i].glsl != NULL; ++k) {
                    CHECK_SAY(strcmp(parts.fields[i].glsl, parts.fields[k].glsl) != 0,
                              "components %zu and %zu", k, i);
                }
            }
        }
    }
}

/* How often a text stands in another. */
static int occurrences(const char *text, const char *of) {
    int count = 0;
    for (const char *at = strstr(text, of); at != NULL; at = strstr(at + 1, of)) ++count;
    return count;
}

/* Writes what the options say, to memory that the caller frees; NULL where that fails. */
static char *written(const spt_glsl_options *options) {
    size_t length = 0, again = 0;
    CHECK(spt_glsl_emit(options, NULL, 0, &length) == SPT_BUFFER_TOO_SMALL);
    char *const text = malloc(length + 1);
    if (text == NULL) return NULL;
    const spt_status status = spt_glsl_emit(options, text, length + 1, &again);
    CHECK_SAY(status == SPT_OK, "status %d", (int)status);
    CHECK(again == length && strlen(text) == length);
    if (status == SPT_OK) return text;
    free(text);
    return NULL;
}

static spt_glsl_options options_of(const spt_settings *settings, const spt_camera *camera,
                                   uint32_t target) {
    spt_glsl_options options = spt_glsl_options_default();
    options.settings = settings;
    options.camera = camera;
    options.target = target;
    if (target == SPT_GLSL_SHADERTOY) options.program = SPT_GLSL_PICTURE;
    return options;
}

/* Every line of a text stands in what was written. */
static int holds_lines(const char *whole, const char *text) {
    char line[256];
    for (; *text != '\0'; text += strcspn(text, "\n"), text += *text == '\n') {
        const size_t length = strcspn(text, "\n");
        if (length >= sizeof line) return 0;
        memcpy(line, text, length);
        line[length] = '\0';
        if (strstr(whole, line) == NULL) return 0;
    }
    return 1;
}

static void scenes_are_written_for_every_target(void) {
    for (size_t s = 0; s <= scene_count; ++s) {
        const scene *const shown = scene_at(s);
        const spt_field field = scene_field(shown, 1);
        const spt_camera camera = scene_camera(shown, 160, 90);
        const spt_settings settings = spt_settings_default();
        for (uint32_t target = 0; target < SPT_GLSL_TARGETS; ++target) {
            spt_glsl_options options = options_of(&settings, &camera, target);
            options.field = &field;
            check_context("%s, target %u", shown->name, (unsigned)target);
            char *const text = written(&options);
            if (text == NULL) continue;
            if (shown->glsl != NULL) CHECK(holds_lines(text, shown->glsl));
            if (shown->glsl_prelude != NULL) {
                CHECK(holds_lines(text, shown->glsl_prelude));
                CHECK(occurrences(text, shown->glsl_prelude) == 1);
            }
            free(text);
        }
    }
}

/* As unions of components: what these share is written once. */
static void scenes_components_are_written(void) {
    static scene_parts parts;
    for (size_t s = 0; s < scene_count; ++s) {
        for (int grain = 0; grain < scene_grains; ++grain) {
            const spt_settings settings = spt_settings_default();
            spt_glsl_options options = options_of(&settings, NULL, SPT_GLSL_COMPUTE_450);
            scene_parts_of(scenes[s], (scene_grain)grain, 1, &parts);
            options.scene = &parts.scene;
            for (int merged = 0; merged < 2; ++merged) {
                options.features = merged ? SPT_GLSL_MERGED : 0;
                check_context("%s, grain %d, merged %d", scenes[s]->name, grain, merged);
                char *const text = written(&options);
                if (text == NULL) continue;
                for (size_t i = 0; i < parts.scene.count; ++i) {
                    const char *const prelude = parts.fields[i].glsl_prelude;
                    if (scenes[s]->field == NULL) CHECK(holds_lines(text, parts.fields[i].glsl));
                    if (prelude != NULL) CHECK(occurrences(text, prelude) == 1);
                }
                free(text);
            }
        }
    }
}

void suite_scenes_glsl(void) {
    RUN(scenes_have_a_text);
    RUN(scenes_components_have_texts);
    RUN(scenes_are_written_for_every_target);
    RUN(scenes_components_are_written);
}
