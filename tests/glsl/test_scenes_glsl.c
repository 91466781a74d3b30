/* SPDX-License-Identifier: MIT
 *
 * The scenes on an implementation of GLSL: distances and whole pictures against the C library, bit
 * by bit. None needs a tolerance: all are made of + - * / sqrt, and the sines and logarithms of
 * `bumpy_ball`, `twisted`, `bent` and `mandelbulb` are polynomials on both sides (shapes_math.h).
 * It prints how many lines and functions the shader of each scene has. */
#include "glsl_check.h"

#include "../unit/test_scenes.h"

#include <scenes/parts.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 160, HEIGHT = 90, RAYS = WIDTH * HEIGHT, POINTS = 8192 };

/* Scenes of the list, and behind them the one that is found by its name only. */
static const scene *scene_at(size_t index) {
    return index < scene_count ? scenes[index] : scene_named("krs_tree_28");
}

/* Writes what the options say, to memory that the caller frees; NULL where that fails. */
static char *written(const spt_glsl_options *options) {
    size_t length = 0;
    (void)spt_glsl_emit(options, NULL, 0, &length);
    char *const text = malloc(length + 1);
    const spt_status status =
        text == NULL ? SPT_BUFFER_TOO_SMALL : spt_glsl_emit(options, text, length + 1, &length);
    CHECK_SAY(status == SPT_OK, "status %d", (int)status);
    if (status == SPT_OK) return text;
    free(text);
    return NULL;
}

/* ---- Points --------------------------------------------------------------------------------- */

static float places[4 * POINTS], distances[4 * POINTS];

/* Half of them in the scene's region, a quarter as far as the camera sees, a quarter on its surface
 * or near it, where rays end; and at the front some where zeros and signs go wrong. Their squares
 * are no subnormal numbers, which an implementation of GLSL may take for zero. */
static void draw_points(const scene *shown) {
    static const float special[8][3] = {
        {0, 0, 0}, {-0.0f, -0.0f, -0.0f}, {1, 0, 0},          {0, -1, 0},
        {0, 0, 1}, {0, 0.5f, -0.0f},      {1e-10f, 0, 1e-8f}, {1.25f, 0.75f, -0.5f}};
    static spt_ray rays[RAYS];
    static spt_hit hits[RAYS];
    float pixel_radius;
    const spt_field field = scene_field(shown, spt_lanes());
    const spt_settings settings = spt_settings_default();
    scene_rays(shown, WIDTH, HEIGHT, rays, &pixel_radius);
    const spt_rays columns = spt_rays_of(rays);
    const spt_hits sinks = spt_hits_of(hits);
    CHECK(spt_trace(&field, &settings, RAYS, &columns, &sinks, NULL) == SPT_OK);
    for (int i = 0; i < POINTS; ++i) {
        double point[3];
        draw_in_region(shown, point);
        const uint32_t ray = check_random() % RAYS;
        float t = (float)check_uniform(0, shown->t_max);
        if (i % 4 == 3 && hits[ray].outcome == SPT_HIT) {
            t = hits[ray].t * (float)check_uniform(0.999, 1.001);
        }
        for (int axis = 0; axis < 3; ++axis) {
            const float seen = rays[ray].origin[axis] + t * rays[ray].direction[axis];
            places[4 * i + axis] = i < 8 ? special[i][axis] : i % 4 < 2 ? (float)point[axis] : seen;
        }
        places[4 * i + 3] = 0;
    }
}

static void SG1_equal_distances(void) {
    const spt_settings settings = spt_settings_default();
    const engine_uniform uniforms[] = {{"spt_size", ENGINE_IVEC2, {64, POINTS / 64, 0, 0}}};
    for (size_t s = 0; s <= scene_count; ++s) {
        const scene *const shown = scene_at(s);
        const spt_field field = scene_field(shown, 0);
        spt_glsl_options options = spt_glsl_options_default();
        int different = 0;
        options.field = &field;
        options.settings = &settings;
        options.target = SPT_GLSL_COMPUTE_450;
        options.program = SPT_GLSL_POINTS;
        check_context("%s", shown->name);
        draw_points(shown);
        char *const shader = written(&options);
        if (shader == NULL) continue;
        const engine_compute run = {ENGINE_GL_45, shader,    64,         POINTS / 64, places,
                                    4 * POINTS,   distances, 4 * POINTS, uniforms,    1};
        CHECK(engine_gl_compute(&run) == ENGINE_OK);
        for (int i = 0; i < POINTS; ++i) {
            const float *const p = &places[4 * i];
            const float expected = field.point(field.user, p[0], p[1], p[2]);
            const int same = check_same_bits(distances[4 * i], expected);
            different += !same;
            CHECK_SAY(same, "%.9g, in C %.9g, at %.9g %.9g %.9g", (double)distances[4 * i],
                      (double)expected, (double)p[0], (double)p[1], (double)p[2]);
        }
        if (different > 0) printf("%s: %d of %d points differ\n", shown->name, different, POINTS);
        free(shader);
    }
}

/* ---- Pictures ------------------------------------------------------------------------------- */

static float packed_rays[8 * RAYS], seen_hits[4 * RAYS];
static spt_ray rays[RAYS];
static spt_hit hits[RAYS];

/* In GLSL 3.0e38 stands for infinity. */
static float as_in_glsl(float number) {
    return number > 3.0e38f ? 3.0e38f : number;
}

static void pack_rays(void) {
    for (int i = 0; i < RAYS; ++i) memcpy(&packed_rays[8 * i], &rays[i], sizeof rays[i]);
}

/* All pixels: t, residual, evaluations and outcome. */
static void check_hits(const float *seen, const spt_hit *expected, int width, int count) {
    int different = 0, undecided = 0;
    for (int i = 0; i < count; ++i, seen += 4, ++expected) {
        const int same = check_same_bits(seen[0], as_in_glsl(expected->t)) &&
                         check_same_bits(seen[1], as_in_glsl(expected->residual)) &&
                         (uint32_t)seen[2] == expected->evaluations &&
                         (int32_t)seen[3] == expected->outcome;
        different += !same;
        undecided += expected->outcome == SPT_LIMIT;
        CHECK_SAY(same, "pixel %d %d: %.9g %.9g %g %g, in C %.9g %.9g %u %d", i % width, i / width,
                  (double)seen[0], (double)seen[1], (double)seen[2], (double)seen[3],
                  (double)expected->t, (double)expected->residual, (unsigned)expected->evaluations,
                  (int)expected->outcome);
    }
    CHECK_SAY(different == 0, "%d of %d pixels differ", different, count);
    CHECK(undecided < count / 10);
}

/* What all methods of a scene trace, and in C, too. */
static spt_settings prepare_picture(const scene *shown, const spt_field *field,
                                    const spt_method *method) {
    const spt_rays columns = spt_rays_of(rays);
    const spt_hits sinks = spt_hits_of(hits);
    spt_settings settings = spt_settings_default();
    scene_rays(shown, WIDTH, HEIGHT, rays, &settings.pixel_radius);
    settings.method = method;
    pack_rays();
    CHECK(spt_trace(field, &settings, RAYS, &columns, &sinks, NULL) == SPT_OK);
    return settings;
}

static const engine_uniform picture_uniforms[] = {{"spt_size", ENGINE_IVEC2, {WIDTH, HEIGHT, 0, 0}},
                                                  {"spt_budget", ENGINE_INT, {128, 0, 0, 0}}};

static void SG2_equal_pictures(void) {
    for (size_t s = 0; s <= scene_count; ++s) {
        const scene *const shown = scene_at(s);
        const spt_field field = scene_field(shown, spt_lanes());
        const spt_method *const methods[] = {spt_basic(), spt_adaptive(), spt_convex()};
        const int count = (field.flags & SPT_FIELD_CONVEX) != 0 ? 3 : 2;
        for (int m = 0; m < count; ++m) {
            const spt_settings settings = prepare_picture(shown, &field, methods[m]);
            spt_glsl_options options = spt_glsl_options_default();
            options.field = &field;
            options.settings = &settings;
            options.target = SPT_GLSL_COMPUTE_450;
            check_context("%s, %s", shown->name, spt_method_name(methods[m]));
            char *const shader = written(&options);
            if (shader == NULL) continue;
            const engine_compute run = {ENGINE_GL_45,     shader,   WIDTH,     HEIGHT,
                                        packed_rays,      8 * RAYS, seen_hits, 4 * RAYS,
                                        picture_uniforms, 2};
            CHECK(engine_gl_compute(&run) == ENGINE_OK);
            check_hits(seen_hits, hits, WIDTH, RAYS);
            free(shader);
        }
    }
}

/* The same in SPIR-V, on Vulkan: adaptive, which has the most to get wrong. */
static void SG3_equal_pictures_on_vulkan(void) {
    if (!engine_here(engine_vulkan_open(), "Vulkan")) return;
    for (size_t s = 0; s <= scene_count; ++s) {
        const scene *const shown = scene_at(s);
        const spt_field field = scene_field(shown, spt_lanes());
        const spt_settings settings = prepare_picture(shown, &field, spt_adaptive());
        spt_glsl_options options = spt_glsl_options_default();
        options.field = &field;
        options.settings = &settings;
        options.target = SPT_GLSL_VULKAN_450;
        check_context("%s", shown->name);
        char *const shader = written(&options);
        if (shader == NULL) continue;
        const engine_compute run = {ENGINE_GL_45,     shader,   WIDTH,     HEIGHT,
                                    packed_rays,      8 * RAYS, seen_hits, 4 * RAYS,
                                    picture_uniforms, 2};
        CHECK(engine_vulkan_compute(&run, ENGINE_GLSLC) == ENGINE_OK);
        check_hits(seen_hits, hits, WIDTH, RAYS);
        free(shader);
    }
}

/* In a browser, by WebGL 2 on its own renderer: smaller pictures, all in one page. */
enum { SMALL_WIDTH = 80, SMALL_RAYS = SMALL_WIDTH * 45, MOST_SCENES = 40 };

typedef struct browser_picture {
    float texels[2][4 * SMALL_RAYS], seen[4 * SMALL_RAYS];
    spt_hit expected[SMALL_RAYS];
    engine_texture textures[2];
    char *shader;
} browser_picture;

static const engine_uniform small_uniforms[] = {
    {"spt_size", ENGINE_IVEC2, {SMALL_WIDTH, SMALL_RAYS / SMALL_WIDTH, 0, 0}},
    {"spt_budget", ENGINE_INT, {128, 0, 0, 0}}};

static engine_fragment prepare_browser(const scene *shown, browser_picture *picture) {
    static const char *const names[] = {"spt_ray_origin", "spt_ray_direction"};
    const int height = SMALL_RAYS / SMALL_WIDTH;
    const spt_field field = scene_field(shown, spt_lanes());
    const spt_rays columns = spt_rays_of(rays);
    const spt_hits sinks = spt_hits_of(picture->expected);
    spt_settings settings = spt_settings_default();
    spt_glsl_options options = spt_glsl_options_default();
    scene_rays(shown, SMALL_WIDTH, height, rays, &settings.pixel_radius);
    CHECK(spt_trace(&field, &settings, SMALL_RAYS, &columns, &sinks, NULL) == SPT_OK);
    for (int i = 0; i < SMALL_RAYS; ++i) {
        memcpy(&picture->texels[0][4 * i], rays[i].origin, 3 * sizeof(float));
        memcpy(&picture->texels[1][4 * i], rays[i].direction, 3 * sizeof(float));
        picture->texels[0][4 * i + 3] = rays[i].t_min;
        picture->texels[1][4 * i + 3] = rays[i].t_max;
    }
    for (int k = 0; k < 2; ++k) {
        const engine_texture texture = {names[k], SMALL_WIDTH, height, picture->texels[k]};
        picture->textures[k] = texture;
    }
    options.field = &field;
    options.settings = &settings;
    options.target = SPT_GLSL_FRAGMENT_300_ES;
    picture->shader = written(&options);
    const engine_fragment run = {.context = ENGINE_ES_32,
                                 .shader = picture->shader != NULL ? picture->shader : "",
                                 .width = SMALL_WIDTH,
                                 .height = height,
                                 .textures = picture->textures,
                                 .texture_count = 2,
                                 .uniforms = small_uniforms,
                                 .uniform_count = 2,
                                 .out = {picture->seen}};
    return run;
}

static void SG7_equal_pictures_in_a_browser(void) {
    static browser_picture pictures[MOST_SCENES];
    engine_fragment runs[MOST_SCENES];
    int statuses[MOST_SCENES];
    const int count = scene_count < MOST_SCENES ? (int)scene_count + 1 : MOST_SCENES;
    for (int s = 0; s < count; ++s) {
        check_context("%s", scene_at((size_t)s)->name);
        runs[s] = prepare_browser(scene_at((size_t)s), &pictures[s]);
    }
    const int status = engine_browser_fragments(ENGINE_SWIFTSHADER, count, runs, statuses);
    if (engine_here(status, "Chromium with SwiftShader")) {
        CHECK(status == ENGINE_OK);
        for (int s = 0; s < count && status == ENGINE_OK; ++s) {
            check_context("%s", scene_at((size_t)s)->name);
            CHECK(statuses[s] == ENGINE_OK);
            check_hits(pictures[s].seen, pictures[s].expected, SMALL_WIDTH, SMALL_RAYS);
        }
    }
    for (int s = 0; s < count; ++s) free(pictures[s].shader);
}

/* ---- Unions of components ------------------------------------------------------------------- */

static const engine_uniform patient_uniforms[] = {{"spt_size", ENGINE_IVEC2, {WIDTH, HEIGHT, 0, 0}},
                                                  {"spt_budget", ENGINE_INT, {4000, 0, 0, 0}}};

/* The settings of a union's picture. No ray runs out of this budget, which the shader gives to each
 * component and spt_scene_trace() to all of them. */
static spt_settings prepare_union(const scene *shown) {
    spt_settings settings = spt_settings_default();
    scene_rays(shown, WIDTH, HEIGHT, rays, &settings.pixel_radius);
    settings.budget = 4000;
    pack_rays();
    return settings;
}

static int run_union(const scene_parts *parts, const spt_settings *settings, uint32_t features) {
    spt_glsl_options options = spt_glsl_options_default();
    options.scene = &parts->scene;
    options.settings = settings;
    options.target = SPT_GLSL_COMPUTE_450;
    options.features = features;
    char *const shader = written(&options);
    if (shader == NULL) return 0;
    const engine_compute run = {ENGINE_GL_45, shader,    WIDTH,    HEIGHT,           packed_rays,
                                8 * RAYS,     seen_hits, 4 * RAYS, patient_uniforms, 2};
    const int status = engine_gl_compute(&run);
    CHECK(status == ENGINE_OK);
    free(shader);
    return status == ENGINE_OK;
}

/* t, residual and outcome; evaluations, too, where those count the same. */
static void check_union(int evaluations) {
    int different = 0;
    for (int i = 0; i < RAYS; ++i) {
        const float *const seen = &seen_hits[4 * i];
        const int same = check_same_bits(seen[0], as_in_glsl(hits[i].t)) &&
                         check_same_bits(seen[1], as_in_glsl(hits[i].residual)) &&
                         (int32_t)seen[3] == hits[i].outcome &&
                         (!evaluations || (uint32_t)seen[2] == hits[i].evaluations);
        different += !same;
        CHECK(hits[i].outcome == SPT_HIT || hits[i].outcome == SPT_MISS);
        CHECK_SAY(same, "pixel %d %d: %.9g %.9g %g, in C %.9g %.9g %d", i % WIDTH, i / WIDTH,
                  (double)seen[0], (double)seen[1], (double)seen[3], (double)hits[i].t,
                  (double)hits[i].residual, (int)hits[i].outcome);
    }
    CHECK_SAY(different == 0, "%d of %d pixels differ", different, RAYS);
}

static void SG5_unions_of_components(void) {
    static scene_parts parts;
    const spt_rays columns = spt_rays_of(rays);
    const spt_hits sinks = spt_hits_of(hits);
    for (size_t s = 0; s < scene_count; ++s) {
        scene_parts_of(scenes[s], SCENE_OBJECTS, spt_lanes(), &parts);
        if (parts.scene.count == 1) continue;
        check_context("%s", scenes[s]->name);
        const spt_settings settings = prepare_union(scenes[s]);
        const size_t size = spt_scene_workspace(&parts.scene, &settings);
        void *const workspace = malloc(size);
        CHECK(spt_scene_trace(&parts.scene, &settings, RAYS, &columns, &sinks, workspace, size,
                              NULL) == SPT_OK);
        free(workspace);
        if (run_union(&parts, &settings, 0)) check_union(0);
    }
}

/* As one field, whose distances have the scene's bits: what spt_trace() says of the scene, without
 * the bound that a merged field has not. `size` is larger than the bounds of all components, which
 * would otherwise count on one side only. */
static void SG6_merged_unions(void) {
    static scene_parts parts;
    const spt_rays columns = spt_rays_of(rays);
    const spt_hits sinks = spt_hits_of(hits);
    for (size_t s = 0; s < scene_count; ++s) {
        spt_field field = scene_field(scenes[s], spt_lanes());
        scene_parts_of(scenes[s], SCENE_OBJECTS, spt_lanes(), &parts);
        if (parts.scene.count == 1 || field.lipschitz > 1) continue;
        check_context("%s", scenes[s]->name);
        spt_settings settings = prepare_union(scenes[s]);
        settings.size = 16;
        field.bound = NULL;
        CHECK(spt_trace(&field, &settings, RAYS, &columns, &sinks, NULL) == SPT_OK);
        if (run_union(&parts, &settings, SPT_GLSL_MERGED)) check_union(1);
    }
}

/* ---- Sizes ---------------------------------------------------------------------------------- */

/* A line that begins a function: its type stands at the margin, and it opens a block. */
static int begins_function(const char *line, size_t length) {
    static const char *const others[] = {"struct ", "layout", "uniform ", "const "};
    if (length == 0 || !((line[0] >= 'a' && line[0] <= 'z') || (line[0] >= 'A' && line[0] <= 'Z')))
        return 0;
    for (size_t i = 0; i < sizeof others / sizeof *others; ++i) {
        if (strncmp(line, others[i], strlen(others[i])) == 0) return 0;
    }
    const char *const open = memchr(line, '(', length);
    return open != NULL && memchr(line, '=', length) == NULL;
}

/* The list that users ask for: how long what is written for each scene is. */
static void SG4_lines_and_functions(void) {
    printf("scene              lines and functions of: library, basic   compute 450, adaptive\n");
    for (size_t s = 0; s <= scene_count; ++s) {
        const scene *const shown = scene_at(s);
        const spt_field field = scene_field(shown, 1);
        int lines[2] = {0, 0}, functions[2] = {0, 0};
        for (int which = 0; which < 2; ++which) {
            spt_settings settings = spt_settings_default();
            spt_glsl_options options = spt_glsl_options_default();
            settings.method = which == 0 ? spt_basic() : spt_adaptive();
            options.field = &field;
            options.settings = &settings;
            options.target = which == 0 ? SPT_GLSL_LIBRARY : SPT_GLSL_COMPUTE_450;
            check_context("%s", shown->name);
            char *const shader = written(&options);
            if (shader == NULL) continue;
            for (const char *line = shader; *line != '\0';) {
                const size_t length = strcspn(line, "\n");
                lines[which] += 1;
                functions[which] += begins_function(line, length);
                line += length + (line[length] == '\n');
            }
            free(shader);
        }
        printf("%-18s %24d %4d %20d %4d\n", shown->name, lines[0], functions[0], lines[1],
               functions[1]);
        CHECK(functions[0] >= 2 && functions[1] > 2);
    }
}

void suite_scenes_glsl(void) {
    RUN(SG1_equal_distances);
    RUN(SG2_equal_pictures);
    RUN(SG3_equal_pictures_on_vulkan);
    RUN(SG4_lines_and_functions);
    RUN(SG5_unions_of_components);
    RUN(SG6_merged_unions);
    RUN(SG7_equal_pictures_in_a_browser);
}
