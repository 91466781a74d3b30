/* SPDX-License-Identifier: MIT
 *
 * Faults of emitted shaders that were found and mended, each with the smallest case that shows it,
 * ray by ray against the C library. Left out: names and uniforms (test_found_names_glsl.c), and what
 * the suites of the features cover. */
#include "glsl_check.h"
#include "glsl_written.h"

#include <spheretrace/spheretrace.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 8, RAYS = SIDE * SIDE, WORDS = 8 }; /* a hit is two vec4 here */

/* ---- Fields --------------------------------------------------------------------------------- */

typedef struct ball {
    float y, z, radius;
    char text[256];
} ball;

static float ball_distance(void *user, float x, float y, float z) {
    const ball *b = user;
    y -= b->y;
    z -= b->z;
    return sqrtf((x * x + y * y) + z * z) - b->radius;
}

static spt_field ball_field(ball *b, float y, float z, float radius) {
    spt_field field = spt_field_default();
    b->y = y;
    b->z = z;
    b->radius = radius;
    snprintf(b->text, sizeof b->text,
             "vec3 q = p - vec3(0.0, %.9f, %.9f);\n"
             "SPT_PRECISE float s = (q.x * q.x + q.y * q.y) + q.z * q.z;\n"
             "SPT_PRECISE float d = sqrt(s) - %.9f;\nreturn d;\n",
             (double)y, (double)z, (double)radius);
    field.point = ball_distance;
    field.user = b;
    field.glsl = b->text;
    return field;
}

static spt_field unit_ball(void) {
    static ball b;
    return ball_field(&b, 0, 0, 1);
}

static float no_number(void *user, float x, float y, float z) {
    (void)user, (void)x, (void)y, (void)z;
    return NAN;
}

/* ---- Emitting and running ------------------------------------------------------------------- */

static spt_glsl_options hits_of(const spt_field *field, const spt_scene *scene,
                                const spt_settings *settings, uint32_t features) {
    spt_glsl_options options = spt_glsl_options_default();
    options.field = field;
    options.scene = scene;
    options.settings = settings;
    options.target = SPT_GLSL_COMPUTE_450;
    options.features = features;
    return options;
}

static spt_ray ray_of(float y, float z, float length, float t_min, float t_max) {
    const spt_ray ray = {{0, y, z}, t_min, {0, 0, length}, t_max};
    return ray;
}

/* RAYS of them through a shader of HITS whose hits have two vec4, 3.0e38 as +infinity. */
static void run_hits(const spt_glsl_options *options, const spt_ray *rays,
                     float results[RAYS][WORDS]) {
    static float in[RAYS][8];
    char *const text = written(options);
    const engine_uniform uniforms[] = {
        {"spt_size", ENGINE_IVEC2, {SIDE, SIDE, 0, 0}},
        {"spt_budget", ENGINE_INT, {(float)options->settings->budget, 0, 0, 0}}};
    const engine_compute run = {ENGINE_GL_45,  text,       SIDE,         SIDE,     in[0],
                                sizeof in / 4, results[0], RAYS * WORDS, uniforms, 2};
    for (int i = 0; i < RAYS; ++i) memcpy(in[i], &rays[i], sizeof in[i]);
    memset(results, 0, sizeof(float) * RAYS * WORDS);
    if (text != NULL) CHECK(engine_gl_compute(&run) == ENGINE_OK);
    for (int i = 0; i < RAYS; ++i) {
        for (int k = 0; k < WORDS; ++k)
            results[i][k] = results[i][k] == 3.0e38f ? INFINITY : results[i][k];
    }
    free(text);
}

static void trace(const spt_field *field, const spt_settings *settings, const spt_ray *rays,
                  spt_hit *hits) {
    const spt_rays columns = spt_rays_of(rays);
    const spt_hits sinks = spt_hits_of(hits);
    CHECK(spt_trace(field, settings, RAYS, &columns, &sinks, NULL) == SPT_OK);
}

/* t, residual, evaluations and outcome. */
static void check_end(int ray, const spt_hit *c, const float gl[WORDS]) {
    CHECK_SAY(check_same_bits(gl[0], c->t) && check_same_bits(gl[1], c->residual) &&
                  gl[2] == (float)c->evaluations && gl[3] == (float)c->outcome,
              "ray %d: C t %.9g residual %.9g evaluations %u outcome %d, GLSL %.9g %.9g %g %g", ray,
              (double)c->t, (double)c->residual, (unsigned)c->evaluations, (int)c->outcome,
              (double)gl[0], (double)gl[1], (double)gl[2], (double)gl[3]);
}

static void check_candidate(int ray, const spt_hit *c, const float gl[WORDS]) {
    CHECK_SAY(check_same_bits(gl[6], c->candidate_t) && check_same_bits(gl[7], c->candidate_ratio),
              "ray %d: C candidate %.9g %.9g, GLSL %.9g %.9g", ray, (double)c->candidate_t,
              (double)c->candidate_ratio, (double)gl[6], (double)gl[7]);
}

/* ---- Tracing -------------------------------------------------------------------------------- */

/* Guards: directions whose squares over- or underflow. Each length with rays that hit in the middle,
 * aslant, that pass and that begin inside. */
static void T0_lengths(void) {
    static const float lengths[] = {1e-30f, 1e-24f, 1e-21f, 1e-19f, 1, 1e19f, 2e19f, 1e21f, 1e30f};
    static const float heights[] = {0, 0.625f, 1.2f, 0.25f};
    enum { length_count = sizeof lengths / sizeof lengths[0] };
    static spt_ray rays[RAYS];
    static spt_hit hits[RAYS];
    static float results[RAYS][WORDS];
    const spt_bound bound = spt_bound_sphere(0, 0, 0, 1.5f);
    for (int i = 0; i < RAYS; ++i) {
        const float length = lengths[i / 4 % length_count];
        rays[i] = ray_of(heights[i % 4], i % 4 == 3 ? 0.1f : -3, length, 0, 10 / length);
        if (i % 4 == 1) rays[i].direction[1] = -0.1f * length;
    }
    for (int way = 0; way < 4; ++way) {
        spt_field field = unit_ball();
        spt_settings settings = spt_settings_default();
        if (way % 2 == 1) field.bound = &bound;
        settings.method = way < 2 ? spt_basic() : spt_adaptive();
        check_context("%s, %s", way < 2 ? "basic" : "adaptive", way % 2 ? "bounded" : "unbounded");
        const spt_glsl_options options =
            hits_of(&field, NULL, &settings, SPT_GLSL_GUARDS | SPT_GLSL_CANDIDATE);
        run_hits(&options, rays, results);
        trace(&field, &settings, rays, hits);
        for (int i = 0; i < RAYS; ++i) {
            CHECK_SAY(hits[i].outcome == (i % 4 == 2 ? SPT_MISS : SPT_HIT), "ray %d: outcome %d", i,
                      (int)hits[i].outcome);
            check_end(i, &hits[i], results[i]);
            check_candidate(i, &hits[i], results[i]);
        }
    }
}

/* Convex tracing has no candidates between samples. */
static void T1_convex_candidates(void) {
    static const uint32_t flags[] = {0, SPT_CANDIDATE_PENUMBRA, SPT_CANDIDATE_CLOSEST};
    static const uint32_t targets[] = {SPT_GLSL_LIBRARY, SPT_GLSL_COMPUTE_450};
    const spt_bound bound = spt_bound_sphere(0, 0, 0, 1.5f);
    spt_field field = unit_ball();
    field.flags = SPT_FIELD_CONVEX;
    field.bound = &bound;
    for (int i = 0; i < 12; ++i) {
        spt_settings settings = spt_settings_default();
        settings.flags = flags[i % 3];
        spt_glsl_options options =
            hits_of(&field, NULL, &settings,
                    i < 6 ? SPT_GLSL_CONVEX : SPT_GLSL_CONVEX | SPT_GLSL_CANDIDATE);
        options.target = targets[i / 3 % 2];
        check_context("flags %u, target %u", (unsigned)settings.flags, (unsigned)options.target);
        CHECK(spt_glsl_emit(&options, NULL, 0, NULL) ==
              (i % 3 == 0 ? SPT_BUFFER_TOO_SMALL : SPT_UNSUPPORTED));
    }
}

/* The candidate of a hit is that of the component hit, though another comes closer for a pixel; of
 * a miss the best of all. In either order, as a hit leaves out what is behind it. */
static void T2_candidate_of_hit(void) {
    static const uint32_t flags[] = {0, SPT_CANDIDATE_PENUMBRA, SPT_CANDIDATE_CLOSEST};
    static spt_ray rays[RAYS];
    static spt_hit hits[2][RAYS];
    static float results[RAYS][WORDS];
    static ball balls[2];
    int others = 0, misses = 0;
    for (int i = 0; i < RAYS; ++i) rays[i] = ray_of(0.03f * (float)i - 0.2f, -5, 1, 0, 100);
    for (int way = 0; way < 12; ++way) {
        const int far = way % 2; /* which is the farther one */
        spt_field fields[2];
        fields[far] = ball_field(&balls[far], 0, 10, 1);
        fields[1 - far] = ball_field(&balls[1 - far], 0.5f, 0, 1);
        spt_scene scene = spt_scene_default();
        scene.fields = fields;
        scene.count = 2;
        spt_settings settings = spt_settings_default();
        settings.method = spt_basic();
        settings.flags = flags[way / 2 % 3];
        const spt_glsl_options options =
            hits_of(NULL, &scene, &settings,
                    SPT_GLSL_CANDIDATE | SPT_GLSL_COMPONENT | (way < 6 ? 0 : SPT_GLSL_GUARDS));
        check_context("flags %u, %s first%s", (unsigned)settings.flags, far ? "nearer" : "farther",
                      way < 6 ? "" : ", guards");
        run_hits(&options, rays, results);
        for (int k = 0; k < 2; ++k) trace(&fields[k], &settings, rays, hits[k]);
        for (int i = 0; i < RAYS; ++i) {
            const int hit = hits[1 - far][i].outcome == SPT_HIT ? 1 - far
                            : hits[far][i].outcome == SPT_HIT   ? far
                                                                : -1;
            const int less = hits[1][i].candidate_ratio < hits[0][i].candidate_ratio;
            CHECK_SAY(results[i][4] == (float)hit, "ray %d: component %g", i,
                      (double)results[i][4]);
            check_candidate(i, &hits[hit >= 0 ? hit : less][i], results[i]);
            others += hit >= 0 && hit != less;
            misses += hit < 0;
        }
    }
    CHECK_SAY(others >= 30 && misses >= 30, "%d others are closer, %d misses", others, misses);
}

/* NaN of any field is the answer of the union, which min() may lose. */
static void T3_merged_nan(void) {
    static spt_ray rays[RAYS];
    static float results[RAYS][WORDS];
    static ball b;
    for (int i = 0; i < RAYS; ++i) rays[i] = ray_of(0, -3, 1, 0.5f, 10);
    for (int order = 0; order < 2; ++order) {
        spt_field fields[2];
        fields[order] = ball_field(&b, 0, 0, 1);
        fields[1 - order] = spt_field_default();
        fields[1 - order].point = no_number;
        fields[1 - order].glsl = "return uintBitsToFloat(0x7fc00000u);";
        spt_scene scene = spt_scene_default();
        scene.fields = fields;
        scene.count = 2;
        spt_settings settings = spt_settings_default();
        const spt_glsl_options options = hits_of(
            NULL, &scene, &settings, SPT_GLSL_MERGED | SPT_GLSL_GUARDS | SPT_GLSL_COMPONENT);
        run_hits(&options, rays, results);
        CHECK_SAY(results[0][3] == (float)SPT_NONFINITE && results[0][0] == 0.5f &&
                      results[0][2] == 1.0f,
                  "NaN %s: outcome %g, t %g", order ? "first" : "second", (double)results[0][3],
                  (double)results[0][0]);
    }
}

/* The last sample at the end of a ray of 1e18 world length, whatever t is there. */
static void T4_far_end(void) {
    static spt_ray rays[RAYS];
    static spt_hit hits[RAYS];
    static float results[RAYS][WORDS];
    for (int i = 0; i < RAYS; ++i) {
        const float length = i % 2 ? 0.2f : 1;
        rays[i] = ray_of(2 + 0.1f * (float)i, -3, length, 0, i % 2 ? 4.995e18f : 0.999e18f);
    }
    for (int guards = 0; guards < 2; ++guards) {
        const spt_field field = unit_ball();
        spt_settings settings = spt_settings_default();
        settings.method = spt_basic();
        settings.budget = 1000;
        settings.flags = SPT_CANDIDATE_CLOSEST;
        const spt_glsl_options options =
            hits_of(&field, NULL, &settings, SPT_GLSL_CANDIDATE | (guards ? SPT_GLSL_GUARDS : 0));
        check_context("%s", guards ? "guards" : "no guards");
        run_hits(&options, rays, results);
        trace(&field, &settings, rays, hits);
        for (int i = 0; i < RAYS; ++i) {
            CHECK(hits[i].outcome == SPT_MISS);
            check_end(i, &hits[i], results[i]);
            check_candidate(i, &hits[i], results[i]);
        }
    }
}

/* Where the first step off the surface ends the ray, there is no candidate. */
static void T5_skip_to_end(void) {
    static spt_ray rays[RAYS];
    static spt_hit hits[RAYS];
    static float results[RAYS][WORDS];
    for (int i = 0; i < RAYS; ++i) {
        const spt_ray ray = {{-39, 0, 0}, 10, {4, 0, 0}, 10.01f};
        rays[i] = ray;
    }
    for (int guards = 0; guards < 2; ++guards) {
        const spt_field field = unit_ball();
        spt_settings settings = spt_settings_default();
        settings.method = spt_basic();
        settings.flags = SPT_SKIP_START;
        settings.epsilon = 0.1f;
        const spt_glsl_options options =
            hits_of(&field, NULL, &settings, SPT_GLSL_CANDIDATE | (guards ? SPT_GLSL_GUARDS : 0));
        check_context("%s", guards ? "guards" : "no guards");
        run_hits(&options, rays, results);
        trace(&field, &settings, rays, hits);
        CHECK(hits[0].outcome == SPT_MISS && isinf(hits[0].candidate_t));
        check_end(0, &hits[0], results[0]);
        check_candidate(0, &hits[0], results[0]);
    }
}

/* ---- Pictures ------------------------------------------------------------------------------- */

enum { WIDTH = 64, HEIGHT = 40, PIXELS = WIDTH * HEIGHT };

/* The camera's rays in C, the row of y = 0 (the lowest) first. */
static void trace_picture(const spt_camera *camera, const spt_field *field,
                          const spt_settings *settings, spt_ray *rays, spt_hit *hits) {
    static spt_camera_ray drawn[PIXELS];
    static float x[PIXELS], y[PIXELS];
    for (int i = 0; i < PIXELS; ++i) {
        x[i] = (float)(i % WIDTH) + 0.5f;
        y[i] = (float)HEIGHT - ((float)(i / WIDTH) + 0.5f);
    }
    CHECK(spt_camera_rays(camera, WIDTH, HEIGHT, PIXELS, x, y, drawn) == SPT_OK);
    for (int i = 0; i < PIXELS; ++i) rays[i] = drawn[i].ray;
    const spt_rays columns = spt_rays_of(rays);
    const spt_hits sinks = spt_hits_of(hits);
    CHECK(spt_trace(field, settings, PIXELS, &columns, &sinks, NULL) == SPT_OK);
}

/* Misses leave colour and depth as they were; rays out of budget are drawn where they are, as they
 * are without a depth buffer. */
static void T6_depth_of_limit(void) {
    static const float eye[3] = {2, 1.5f, -4}, middle[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    static spt_ray rays[PIXELS];
    static spt_hit hits[PIXELS];
    static float colours[4 * PIXELS], depths[PIXELS];
    int outcomes[SPT_OUTCOMES] = {0};
    const spt_field field = unit_ball();
    spt_settings settings = spt_settings_default();
    spt_camera camera;
    settings.budget = 4;
    CHECK(spt_camera_pinhole(&camera, eye, middle, up, 0.5f, WIDTH, HEIGHT) == SPT_OK);
    camera.t_max = 5;
    trace_picture(&camera, &field, &settings, rays, hits);
    spt_glsl_options options = hits_of(&field, NULL, &settings, SPT_GLSL_DEPTH_WRITE);
    options.target = SPT_GLSL_FRAGMENT_330;
    options.program = SPT_GLSL_PICTURE;
    options.camera = &camera;
    CHECK(spt_glsl_depth(0.1f, 100, options.depth) == SPT_OK);
    char *const text = written(&options);
    const engine_uniform uniforms[] = {{"spt_size", ENGINE_IVEC2, {WIDTH, HEIGHT, 0, 0}},
                                       {"spt_budget", ENGINE_INT, {4, 0, 0, 0}}};
    const engine_fragment run = {.context = ENGINE_GL_45,
                                 .shader = text,
                                 .width = WIDTH,
                                 .height = HEIGHT,
                                 .uniforms = uniforms,
                                 .uniform_count = 2,
                                 .out = {colours},
                                 .depth = depths};
    if (text != NULL) CHECK(engine_gl_fragment(&run) == ENGINE_OK);
    for (int i = 0; i < PIXELS; ++i) {
        double along = 0;
        for (int k = 0; k < 3; ++k)
            along += (double)rays[i].direction[k] * (double)camera.forward[k];
        /* A dozen roundings of numbers up to 0.05 and one of a number up to 1 are below 2^-23. */
        const double z = (double)hits[i].t * along;
        const double depth = (double)options.depth[0] + (double)options.depth[1] / z;
        const int missed = hits[i].outcome == SPT_MISS;
        ++outcomes[hits[i].outcome];
        CHECK_SAY(missed ? isnan(colours[4 * i + 3]) && depths[i] == 1.0f
                         : colours[4 * i + 3] == 1.0f &&
                               fabs((double)depths[i] - depth) <= ldexp(1, -23),
                  "pixel %d: outcome %d, alpha %g, depth %.9g for %.9g", i, (int)hits[i].outcome,
                  (double)colours[4 * i + 3], (double)depths[i], depth);
    }
    CHECK_SAY(outcomes[SPT_HIT] >= 30 && outcomes[SPT_LIMIT] >= 30 && outcomes[SPT_MISS] >= 30,
              "%d hits, %d out of budget, %d misses", outcomes[SPT_HIT], outcomes[SPT_LIMIT],
              outcomes[SPT_MISS]);
    free(text);
}

/* ---- Libraries ------------------------------------------------------------------------------ */

/* The host's own structures and field stand before the library, and are what it uses: the ball of
 * the host has twice the radius. */
static void check_own(const spt_glsl_options *options, const char *map, uint32_t others) {
    static const char host[] =
        "#define SPT_OWN_RAY\n#define SPT_OWN_HIT\n#define SPT_OWN_MAP\n"
        "struct SptRay { float t_max, t_min, host; vec3 direction, origin; };\n"
        "struct SptHit { int evaluations, outcome; vec4 host; float residual, t; };\n";
    static const char statements[] =
        "    SptRay ray;\n"
        "    ray.origin = q[0].xyz;\n    ray.direction = vec3(0.0, 0.0, 1.0);\n"
        "    ray.t_min = 0.0;\n    ray.t_max = 10.0;\n"
        "    SptHit hit = spt_trace(ray, 128);\n"
        "    r[0] = vec4(hit.t, hit.residual, hit.evaluations, hit.outcome);\n"
        "    r[1] = vec4(spt_ambient_occlusion(vec3(0.0, 0.0, -2.0), vec3(0.0, 0.0, -1.0), 0.1, "
        "5));\n";
    static ball b;
    static spt_ray rays[RAYS];
    static spt_hit hits[RAYS];
    float in[RAYS][4], out[RAYS][WORDS] = {{0}};
    const spt_field doubled = ball_field(&b, 0, 0, 2);
    for (int i = 0; i < RAYS; ++i) {
        rays[i] = ray_of(0.02f * (float)i, -3, 1, 0, 10);
        memcpy(in[i], rays[i].origin, sizeof in[i]);
    }
    char *const text = written(options);
    char *const all = text == NULL ? NULL : joined(host, map, text);
    free(text);
    if (all == NULL) return;
    CHECK(engine_values(all, statements, RAYS, 1, in[0], 2, out[0]) == ENGINE_OK);
    trace(&doubled, options->settings, rays, hits);
    for (int i = 0; i < RAYS; ++i) {
        CHECK(hits[i].outcome == SPT_HIT);
        hits[i].evaluations += others; /* of a scene they are the sum */
        check_end(i, &hits[i], out[i]);
    }
    free(all);
}

static void T7_own(void) {
    static ball balls[2];
    spt_field fields[2];
    fields[0] = ball_field(&balls[0], 0, 0, 1);
    fields[1] = ball_field(&balls[1], 0, 40, 1);
    spt_scene scene = spt_scene_default();
    scene.fields = fields;
    scene.count = 2;
    const spt_settings settings = spt_settings_default();
    spt_glsl_options options = hits_of(fields, NULL, &settings, SPT_GLSL_OCCLUSION);
    options.target = SPT_GLSL_LIBRARY;
    check_context("one field");
    check_own(&options,
              "float spt_map(vec3 p) {\n    precise float s = (p.x * p.x + p.y * p.y) + "
              "p.z * p.z;\n    precise float d = sqrt(s) - 2.0;\n    return d;\n}\n",
              0);
    options.field = NULL;
    options.scene = &scene;
    check_context("a scene");
    check_own(&options,
              "float spt_map(int component, vec3 p) {\n    if (component == 1) return "
              "1000.0;\n    precise float s = (p.x * p.x + p.y * p.y) + p.z * p.z;\n"
              "    precise float d = sqrt(s) - 2.0;\n    return d;\n}\n",
              1);
}

void suite_found_glsl(void) {
    RUN(T0_lengths);
    RUN(T1_convex_candidates);
    RUN(T2_candidate_of_hit);
    RUN(T3_merged_nan);
    RUN(T4_far_end);
    RUN(T5_skip_to_end);
    RUN(T6_depth_of_limit);
    RUN(T7_own);
}
