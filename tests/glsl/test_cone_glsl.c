/* SPDX-License-Identifier: MIT
 *
 * Cameras and cones in shaders: rays are those of spt_camera_rays(), and none that begins where its
 * block's cone stopped loses anything. */
#include "glsl_check.h"

#include <spheretrace/frame.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/bound/bound.glsl.h"
#include "../../src/bound/bound_check.h"
#include "../../src/frame/camera.glsl.h"
#include "../../src/frame/cone.glsl.h"
#include "../../src/glsl/writer.h"
#include "../../src/trace/trace.glsl.h"

enum {
    width = 150, /* no multiple of the blocks' size */
    height = 110,
    pixels = width * height,
    most_blocks = (width / 4 + 1) * (height / 4 + 1),
    most_components = 3,
    t_max = 20
};

/* ---- Texts ---------------------------------------------------------------------------------- */

static char text[1 << 16];

/* Begins with the rays of a camera; the size of the picture is a constant here. */
static void begin_text(spti_glsl *out, spt_glsl_options *options, const spt_camera *camera,
                       int columns, int rows) {
    static const char *names[SPT_GLSL_NAMES];
    for (uint32_t i = 0; i < SPT_GLSL_NAMES; ++i) names[i] = spt_glsl_default_name(i);
    *options = spt_glsl_options_default();
    options->target = SPT_GLSL_COMPUTE_450;
    options->camera = camera;
    memset(out, 0, sizeof *out);
    out->options = options;
    out->names = names;
    out->settings = spt_settings_default();
    out->uniforms = 1u << SPT_GLSL_NAME_SIZE | 1u << SPT_GLSL_NAME_STARTS;
    out->buffer = text;
    out->capacity = sizeof text;
    if (camera->kind == SPT_CAMERA_PINHOLE) out->conditions |= SPTI_GLSL_BIT(pinhole);
    spti_glsl_format(out, "const ivec2 spt_size = ivec2(%d, %d);\n#define SPT_ZERO 0\n", columns,
                     rows);
    spti_glsl_expand(out, spti_glsl_basis[0].text, NULL); /* SptRay */
    spti_glsl_expand(out, spti_glsl_camera[0].text, NULL);
}

static void end_text(spti_glsl *out) {
    CHECK(out->status == SPT_OK && out->length < sizeof text);
    text[out->length < sizeof text ? out->length : 0] = '\0';
}

/* ---- Cameras -------------------------------------------------------------------------------- */

/* A window whose sides are floats gives the bits of C. In others the way from pixel to pixel is off
 * by two units in the last place at most, so that of a whole side by 2^-22 of it; the image plane
 * is at distance 1 or beyond, and rounding adds a few units of 2^-24. */
static void check_camera(const spt_camera *camera, int columns, int rows) {
    enum { points = 2048 };
    static float in[points][4], out[points][8], x[points], y[points];
    static spt_camera_ray rays[points];
    const float across = camera->x_high - camera->x_low, down = camera->y_low - camera->y_high;
    const int exact = (double)across == (double)camera->x_high - (double)camera->x_low &&
                      (double)down == (double)camera->y_low - (double)camera->y_high;
    const double off = exact ? 0 : 0x1p-22 * ((double)fabsf(across) + (double)fabsf(down) + 1);
    spt_glsl_options options;
    spti_glsl glsl;
    begin_text(&glsl, &options, camera, columns, rows);
    end_text(&glsl);
    for (int i = 0; i < points; ++i) {
        in[i][0] = x[i] = (float)(check_random() % (uint32_t)columns) + (i % 4 != 0 ? 0.5f : 0.0f);
        in[i][1] = y[i] = (float)(check_random() % (uint32_t)rows) + (i % 8 != 0 ? 0.5f : 1.0f);
    }
    CHECK(engine_values(text,
                        "    SptRay ray = spt_camera_ray(q[0].xy);\n"
                        "    r[0] = vec4(ray.origin, ray.t_min);\n"
                        "    r[1] = vec4(ray.direction, ray.t_max);\n",
                        points, 1, in[0], 2, out[0]) == ENGINE_OK);
    CHECK(spt_camera_rays(camera, (uint32_t)columns, (uint32_t)rows, points, x, y, rays) == SPT_OK);
    for (int i = 0; i < points; ++i) {
        const spt_ray *const ray = &rays[i].ray;
        CHECK(check_same_bits(out[i][3], ray->t_min));
        CHECK(check_same_bits(out[i][7], fminf(ray->t_max, 1e18f)));
        for (int axis = 0; axis < 3; ++axis) {
            const double origin = (double)ray->origin[axis] - (double)out[i][axis];
            const double direction = (double)ray->direction[axis] - (double)out[i][4 + axis];
            CHECK_SAY(fabs(origin) <= off && fabs(direction) <= off,
                      "point %g %g: off by %g and %g of %g", (double)x[i], (double)y[i], origin,
                      direction, off);
        }
    }
}

static void F1_camera_rays(void) {
    static const int sizes[][2] = {{640, 480}, {1, 1}, {1921, 7}, {1 << 22, 3}, {150, 110}};
    const float eye[3] = {0.3f, 1.7f, -3}, target[3] = {0, 0.25f, 0}, up[3] = {0, 1, 0.1f};
    for (int i = 0; i < 20; ++i) {
        const int columns = sizes[i % 5][0], rows = sizes[i % 5][1];
        spt_camera camera;
        check_context("camera %d", i);
        CHECK((i % 2 == 0 ? spt_camera_pinhole : spt_camera_orthographic)(
                  &camera, eye, target, up, (float)check_uniform(0.1, 3), (uint32_t)columns,
                  (uint32_t)rows) == SPT_OK);
        check_camera(&camera, columns, rows);
        camera.t_min = 0.125f;
        camera.t_max = 40;
        camera.x_low = (float)check_uniform(-2, -1);
        camera.y_high = (float)check_uniform(0.001, 0.01);
        check_camera(&camera, columns, rows);
        camera.x_low = -0.25f;
        camera.x_high = 1;
        camera.y_low = 1; /* upside down, */
        camera.y_high = -0.5f;
        camera.right[1] += 0.5f; /* and oblique */
        check_camera(&camera, columns, rows);
    }
}

/* ---- Scenes --------------------------------------------------------------------------------- */

/* A field, and its text. Outside of its bound the text is wrong, so that asking there shows. */
typedef struct body {
    spt_distance_fn *point;
    const char *glsl;
    float lipschitz;
    int bound; /* 0: none */
} body;

static float hypotenuse(float a, float b) {
    return sqrtf(a * a + b * b);
}

/* Thin rods over a ground. */
static float rods(void *user, float x, float y, float z) {
    float f = y + 1;
    (void)user;
    for (int i = 0; i < 5; ++i) {
        const float rod = hypotenuse(x - 0.45f * (float)(i - 2), z - 0.3f * (float)i) - 0.02f;
        f = rod < f ? rod : f;
    }
    return f;
}

static const char rods_text[] =
    "    float f = p.y + 1.0;\n"
    "    for (int i = 0; i < 5; ++i) {\n"
    "        f = min(f, length(p.xz - vec2(0.45 * float(i - 2), 0.3 * float(i))) - 0.02);\n"
    "    }\n"
    "    return f;\n";

/* Twice the distance to a torus. */
static float torus(void *user, float x, float y, float z) {
    (void)user;
    return 2 * (hypotenuse(hypotenuse(x, z) - 0.8f, y) - 0.15f);
}

static const char torus_text[] =
    "    if (any(greaterThan(abs(p), vec3(0.9501, 0.1501, 0.9501)))) return 1.0e6;\n"
    "    return 2.0 * (length(vec2(length(p.xz) - 0.8, p.y)) - 0.15);\n";

static float ball(void *user, float x, float y, float z) {
    (void)user;
    return hypotenuse(hypotenuse(x - 0.7f, y - 0.6f), z) - 0.35f;
}

static const char ball_text[] = "    vec3 q = p - vec3(0.7, 0.6, 0.0);\n"
                                "    return length(q) > 0.4001 ? 1.0e6 : length(q) - 0.35;\n";

/* What is met head-on leaves the least room. */
static float wall(void *user, float x, float y, float z) {
    (void)user, (void)x, (void)y;
    return 2 - z;
}

static spt_bound bound_of(int which) {
    return which == 1 ? spt_bound_box(-0.95f, -0.15f, -0.95f, 0.95f, 0.15f, 0.95f)
                      : spt_bound_sphere(0.7f, 0.6f, 0, 0.4f);
}

#define RODS \
    { rods, rods_text, 1, 0 }
#define TORUS \
    { torus, torus_text, 2, 1 }
#define BALL \
    { ball, ball_text, 1, 2 }
#define WALL \
    { wall, "    return 2.0 - p.z;\n", 1, 0 }

typedef struct world {
    const char *name;
    int count;
    body bodies[most_components];
    int kind, block; /* of camera; pixels */
    float window, pixel_radius, epsilon;
    double saved; /* evaluations without cones over those with, theirs included, are at least this,
                   * a little less than what was seen; in the ball's own ball nothing is saved */
} world;

static const world worlds[] = {
    {"rods", 1, {RODS}, SPT_CAMERA_PINHOLE, 8, 0.6f, 0, 1e-5f, 1.15},
    {"torus", 1, {TORUS}, SPT_CAMERA_PINHOLE, 8, 0.6f, 0, 1e-5f, 1},
    {"ball", 1, {BALL}, SPT_CAMERA_PINHOLE, 7, 0.6f, 0, 1e-5f, 0.95},
    {"wide", 3, {RODS, TORUS, BALL}, SPT_CAMERA_PINHOLE, 16, 2.5f, 0, 1e-5f, 1.14},
    {"large blocks", 3, {BALL, TORUS, RODS}, SPT_CAMERA_PINHOLE, 64, 4, 0, 1e-5f, 1},
    {"half a pixel", 3, {BALL, RODS, TORUS}, SPT_CAMERA_PINHOLE, 8, 0.6f, 0.004f, 1e-4f, 1.4},
    {"coarse", 3, {WALL, TORUS, RODS}, SPT_CAMERA_PINHOLE, 4, 0.6f, 0.02f, 1e-4f, 1},
    {"thick", 1, {WALL}, SPT_CAMERA_PINHOLE, 4, 0.6f, 0, 0.3f, 1},
    {"wall", 1, {WALL}, SPT_CAMERA_PINHOLE, 16, 0.6f, 0, 1e-7f, 1},
    {"beams", 1, {RODS}, SPT_CAMERA_ORTHOGRAPHIC, 4, 1.5f, 0, 1e-5f, 1.2},
    {"wide beams", 3, {TORUS, BALL, RODS}, SPT_CAMERA_ORTHOGRAPHIC, 8, 1.5f, 0, 1e-5f, 1.1},
};
enum { world_count = sizeof worlds / sizeof *worlds };

static spt_camera camera_of(const world *at) {
    const float eye[3] = {0.3f, 0.7f, -3}, target[3] = {0, -0.1f, 0.2f}, up[3] = {0, 1, 0};
    spt_camera camera;
    CHECK((at->kind == SPT_CAMERA_PINHOLE ? spt_camera_pinhole : spt_camera_orthographic)(
              &camera, eye, target, up, at->window, width, height) == SPT_OK);
    camera.t_max = t_max;
    return camera;
}

/* What cones are told of a world; `asked` counts. All sizes are at most 2. */
static void put_world(spti_glsl *out, const world *at) {
    for (int i = 0; i < at->count; ++i) {
        spti_glsl_format(out, "float body_%d(vec3 p) {\n%s}\n", i, at->bodies[i].glsl);
        if (at->bodies[i].bound == 0) continue;
        spt_bound bound = bound_of(at->bodies[i].bound), copy;
        CHECK(spti_bound_copy(&copy, &bound));
        spti_glsl_hull(out, i, &copy);
    }
    spti_glsl_expand(out, "int asked = 0;\nfloat spt_map($Pvec3 p) {\n    asked += 1;\n", NULL);
    for (int i = 1; i < at->count; ++i) {
        spti_glsl_format(out, "    if (component == %d) return body_%d(p);\n", i, i);
    }
    spti_glsl_put(out, "    return body_0(p);\n}\n");
    if (at->count == 1) return;
    spti_glsl_put(out, "vec3 spt_hull(int component, vec3 p) {\n");
    for (int i = 0; i < at->count; ++i) {
        if (at->bodies[i].bound == 0) continue;
        spti_glsl_format(out, "    if (component == %d) return spt_hull_%d(p);\n", i, i);
    }
    spti_glsl_put(out, "    return p;\n}\nfloat spt_inverse_lipschitz(int component) {\n");
    for (int i = 0; i < at->count; ++i) {
        spti_glsl_format(out, "    if (component == %d) return %f;\n", i,
                         1.0 / (double)at->bodies[i].lipschitz);
    }
    spti_glsl_put(out, "    return 1.0;\n}\nfloat spt_floor_of_size(int component) {\n"
                       "    return 4.76837158e-7;\n}\n");
}

static void write_world(const world *at) {
    const spt_camera camera = camera_of(at);
    spt_glsl_options options;
    spti_glsl out;
    begin_text(&out, &options, &camera, width, height);
    out.settings.epsilon = at->epsilon;
    out.settings.pixel_radius = at->pixel_radius;
    out.component_count = (uint32_t)at->count;
    /* Not equal, so that the text asks the functions above for them. */
    static spti_glsl_component components[most_components];
    for (int i = 0; i < most_components; ++i) {
        components[i].inverse_lipschitz = components[i].floor_of_size = (float)(i + 1);
    }
    out.components = components;
    out.inverse_lipschitz = 1.0f / at->bodies[0].lipschitz;
    out.floor_of_size = 0x1p-21f;
    out.conditions |= SPTI_GLSL_BIT(sized);
    if (at->count > 1) out.conditions |= SPTI_GLSL_BIT(many);
    if (at->pixel_radius > 0) out.conditions |= SPTI_GLSL_BIT(pixel);
    for (int i = 0; i < at->count; ++i) {
        if (at->bodies[i].bound != 0) out.conditions |= SPTI_GLSL_BIT(bounded);
    }
    for (size_t i = 0; i < sizeof spti_glsl_bound / sizeof *spti_glsl_bound; ++i) {
        spti_glsl_expand(&out, spti_glsl_bound[i].text, NULL);
    }
    put_world(&out, at);
    spti_glsl_expand(&out, spti_glsl_cone[0].text, NULL);
    spti_glsl_expand(&out, spti_glsl_cone[1].text, NULL);
    end_text(&out);
}

/* ---- Cones ---------------------------------------------------------------------------------- */

static struct {
    float start[pixels];
    spt_ray rays[pixels];
    spt_hit plain[pixels], ahead[pixels];
    uint64_t cone_evaluations;
} frame;

/* Sends the cones of `text` and hands each pixel where its block's stopped. */
static void send_cones(const world *at) {
    static float in[most_blocks][4], out[most_blocks][4], x[pixels], y[pixels];
    static spt_camera_ray rays[pixels];
    const spt_camera camera = camera_of(at);
    const int size = at->block, columns = (width + size - 1) / size;
    const int blocks = columns * ((height + size - 1) / size);
    for (int i = 0; i < blocks; ++i) {
        in[i][0] = (float)(i % columns * size);
        in[i][1] = (float)(i / columns * size);
        in[i][2] = in[i][0] + (float)size;
        in[i][3] = in[i][1] + (float)size;
    }
    CHECK(engine_values(text,
                        "    float t = spt_block_cone(q[0].xy, q[0].zw, 200);\n"
                        "    r[0] = vec4(t, float(asked), 0.0, 0.0);\n",
                        (size_t)blocks, 1, in[0], 1, out[0]) == ENGINE_OK);
    frame.cone_evaluations = 0;
    for (int i = 0; i < blocks; ++i) frame.cone_evaluations += (uint64_t)out[i][1];
    for (int i = 0; i < pixels; ++i) {
        x[i] = (float)(i % width) + 0.5f;
        y[i] = (float)(i / width) + 0.5f;
        frame.start[i] = out[i / width / size * columns + i % width / size][0];
    }
    CHECK(spt_camera_rays(&camera, width, height, pixels, x, y, rays) == SPT_OK);
    for (int i = 0; i < pixels; ++i) frame.rays[i] = rays[i].ray;
}

/* Both ways: from t_min, and from where the cones stopped. */
static void trace(const world *at) {
    static spt_ray ahead[pixels];
    spt_bound bounds[most_components];
    spt_field fields[most_components];
    spt_scene scene = spt_scene_default();
    spt_settings settings = spt_settings_default();
    for (int i = 0; i < at->count; ++i) {
        bounds[i] = bound_of(at->bodies[i].bound);
        fields[i] = spt_field_default();
        fields[i].point = at->bodies[i].point;
        fields[i].lipschitz = at->bodies[i].lipschitz;
        fields[i].bound = at->bodies[i].bound != 0 ? &bounds[i] : NULL;
    }
    scene.fields = fields;
    scene.count = (size_t)at->count;
    settings.epsilon = at->epsilon;
    settings.pixel_radius = at->pixel_radius;
    settings.size = 2;
    settings.budget = 4096;
    for (int i = 0; i < pixels; ++i) {
        ahead[i] = frame.rays[i];
        ahead[i].t_min = fmaxf(frame.start[i], ahead[i].t_min);
    }
    const size_t size = spt_scene_workspace(&scene, &settings);
    void *const workspace = malloc(size);
    const spt_rays from[2] = {spt_rays_of(frame.rays), spt_rays_of(ahead)};
    const spt_hits to[2] = {spt_hits_of(frame.plain), spt_hits_of(frame.ahead)};
    for (int i = 0; i < 2; ++i) {
        CHECK(spt_scene_trace(&scene, &settings, pixels, &from[i], &to[i], workspace, size, NULL) ==
              SPT_OK);
    }
    free(workspace);
}

/* With the rounding floor of an origin within 3 and a size of 2. */
static float tolerance_at(const world *at, float t) {
    return fmaxf(fmaxf(at->epsilon, at->pixel_radius * t), 0x1p-22f * (5 + t));
}

/* The least of f / lipschitz over the tolerance along a ray between from and to, of all components,
 * or the first that is below `enough`: below 1 the ray would be taken for having reached something.
 * By steps of half of what is left, or of a tenth of the tolerance. */
static float least_of(const world *at, const spt_ray *ray, float from, float to, float enough) {
    float least = FLT_MAX;
    for (int i = 0; i < at->count; ++i) {
        const body *const one = &at->bodies[i];
        const spt_bound bound = bound_of(one->bound);
        float first = from, last = to;
        if (one->bound != 0) {
            CHECK(spt_bound_interval(&bound, ray->origin, ray->direction, from, to, &first,
                                     &last) == SPT_OK);
        }
        for (double t = (double)first; t <= (double)last && !(least < enough);) {
            const float *const o = ray->origin, *const d = ray->direction, place = (float)t;
            const float f =
                one->point(NULL, o[0] + place * d[0], o[1] + place * d[1], o[2] + place * d[2]);
            const float tolerance = tolerance_at(at, place);
            least = fminf(f / one->lipschitz / tolerance, least);
            t += fmax(0.5 * (double)(f / one->lipschitz - tolerance), 0.1 * (double)tolerance);
        }
    }
    return least;
}

/* How many rays would have ended before the place where their cone stopped, but for rounding. */
static int count_lost(const world *at) {
    int lost = 0;
    for (int i = 0; i < pixels; ++i) {
        const float end = fminf(frame.start[i], t_max) * (1 - 0x1p-20f);
        lost += least_of(at, &frame.rays[i], 0, end, 1) < 1;
    }
    return lost;
}

/* Both ways must give the same. Where they do not, the ray must only come near to a surface, where
 * either answer is right: f stays above 0 from the first hit to the second, or to the end. */
static void compare(const world *at) {
    for (int i = 0; i < pixels; ++i) {
        const spt_hit *const a = &frame.plain[i], *const b = &frame.ahead[i];
        const int hits = a->outcome == SPT_HIT && b->outcome == SPT_HIT;
        const float first = fminf(a->t, b->t), last = hits ? fmaxf(a->t, b->t) : t_max;
        const float tolerance = tolerance_at(at, first);
        CHECK(a->outcome == SPT_HIT || a->outcome == SPT_MISS);
        CHECK_SAY(!(a->t < frame.start[i]), "pixel %d: hit at %.9g, begun at %.9g", i, (double)a->t,
                  (double)frame.start[i]);
        if ((a->outcome == b->outcome && !hits) || last - first <= 4 * tolerance) continue;
        CHECK_SAY(least_of(at, &frame.rays[i], first, last - 2 * tolerance, 0) > 0,
                  "pixel %d: outcome %d at %.9g, then %d at %.9g", i, (int)a->outcome, (double)a->t,
                  (int)b->outcome, (double)b->t);
    }
}

static void F2_no_ray_is_lost(void) {
    for (int i = 0; i < world_count; ++i) {
        const world *const at = &worlds[i];
        uint64_t plain = 0, ahead = 0;
        check_context("%s", at->name);
        write_world(at);
        send_cones(at);
        CHECK(count_lost(at) == 0);
        trace(at);
        compare(at);
        ahead = frame.cone_evaluations;
        for (int k = 0; k < pixels; ++k) {
            plain += frame.plain[k].evaluations;
            ahead += frame.ahead[k].evaluations;
        }
        CHECK_SAY((double)plain >= at->saved * (double)ahead,
                  "evaluations a pixel: %.3f without cones, %.3f with them", (double)plain / pixels,
                  (double)ahead / pixels);
    }
}

/* The checks see what is lost by the step that the paper prints. */
static void F3_printed_step_loses(void) {
    static const char right[] = "(radius - kept) / (1.0 + alpha)";
    static const char printed[] = "(radius - 0.00) / (1.0 + 0.000)";
    write_world(&worlds[0]);
    char *const step = strstr(text, right);
    CHECK(step != NULL);
    if (step == NULL) return;
    memcpy(step, printed, strlen(printed));
    send_cones(&worlds[0]);
    CHECK_SAY(count_lost(&worlds[0]) > pixels / 100, "%d", count_lost(&worlds[0]));
}

/* Each pixel finds its block. */
static void F4_starts(void) {
    enum { size = 7, columns = (width + size - 1) / size, rows = (height + size - 1) / size };
    static float starts[rows * columns][4], found[pixels][4];
    const spt_camera camera = camera_of(&worlds[0]);
    spt_glsl_options options;
    spti_glsl out;
    begin_text(&out, &options, &camera, width, height);
    options.cone_size = size;
    out.length = 0;
    spti_glsl_put(&out, "#version 330 core\nuniform sampler2D spt_starts;\nout vec4 result;\n");
    spti_glsl_expand(&out, spti_glsl_cone[2].text, NULL);
    spti_glsl_put(&out, "void main() {\n"
                        "    result = vec4(spt_start(ivec2(gl_FragCoord.xy)), 0.0, 0.0, 0.0);\n"
                        "}\n");
    end_text(&out);
    for (int i = 0; i < rows * columns; ++i) starts[i][0] = (float)check_uniform(0, 20);
    const engine_texture texture = {"spt_starts", columns, rows, starts[0]};
    const engine_fragment run = {.context = ENGINE_GL_45,
                                 .shader = text,
                                 .width = width,
                                 .height = height,
                                 .textures = &texture,
                                 .texture_count = 1,
                                 .out = {found[0]}};
    CHECK(engine_gl_fragment(&run) == ENGINE_OK);
    for (int i = 0; i < pixels; ++i) {
        const int block = i / width / size * columns + i % width / size;
        CHECK(check_same_bits(found[i][0], starts[block][0]));
    }
}

void suite_cone_glsl(void) {
    if (!engine_here(engine_gl_open(), "EGL")) return;
    RUN(F1_camera_rays);
    RUN(F2_no_ray_is_lost);
    RUN(F3_printed_step_loses);
    RUN(F4_starts);
}
