/* SPDX-License-Identifier: MIT
 *
 * The worlds, and the way to the engine and back. */
#include "surface_glsl_world.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "glsl_check.h"

enum { INPUTS = 5 }; /* vec4 a ray in the shaders */

/* ---- Fields --------------------------------------------------------------------------------- */

static float sphere(void *user, float x, float y, float z) {
    (void)user;
    return sqrtf((x * x + y * y) + z * z) - 1.0f;
}
static const char sphere_glsl[] =
    "SPT_PRECISE float d = sqrt((p.x * p.x + p.y * p.y) + p.z * p.z) - 1.0;\nreturn d;\n";

/* The same with slices that answer nonsense. */
static float broken(void *user, float x, float y, float z) {
    if (x > 0.25f && x < 0.5f) return -INFINITY;
    if (x < -0.75f) return NAN;
    return sphere(user, x, y, z);
}
static const char broken_glsl[] =
    "SPT_PRECISE float d = sqrt((p.x * p.x + p.y * p.y) + p.z * p.z) - 1.0;\n"
    "if (p.x > 0.25 && p.x < 0.5) d = uintBitsToFloat(0xff800000u);\n"
    "if (p.x < -0.75) d = uintBitsToFloat(0x7fc00000u);\n"
    "return d;\n";

static float box(void *user, float x, float y, float z) {
    const float a = fabsf(x) - 1.0f, b = fabsf(y) - 0.75f, c = fabsf(z) - 0.5f;
    const float u = fmaxf(a, 0.0f), v = fmaxf(b, 0.0f), w = fmaxf(c, 0.0f);
    const float most = fmaxf(a, fmaxf(b, c));
    (void)user;
    return sqrtf((u * u + v * v) + w * w) + fminf(most, 0.0f);
}
static const char box_glsl[] =
    "vec3 q = abs(p) - vec3(1.0, 0.75, 0.5), e = max(q, 0.0);\n"
    "float most = max(q.x, max(q.y, q.z));\n"
    "SPT_PRECISE float d = sqrt((e.x * e.x + e.y * e.y) + e.z * e.z) + min(most, 0.0);\n"
    "return d;\n";

/* Twice the distance. */
static float torus(void *user, float x, float y, float z) {
    const float ring = sqrtf(x * x + z * z) - 1.0f;
    (void)user;
    return 2.0f * (sqrtf(ring * ring + y * y) - 0.375f);
}
static const char torus_glsl[] =
    "SPT_PRECISE float ring = sqrt(p.x * p.x + p.z * p.z) - 1.0;\n"
    "SPT_PRECISE float d = 2.0 * (sqrt(ring * ring + p.y * p.y) - 0.375);\n"
    "return d;\n";

static float capsule(float x, float y, float z, const float axis[3]) {
    const float square = (axis[0] * axis[0] + axis[1] * axis[1]) + axis[2] * axis[2];
    float along = ((x * axis[0] + y * axis[1]) + z * axis[2]) / square;
    along = along < 0.0f ? 0.0f : along > 1.0f ? 1.0f : along;
    x = x - along * axis[0];
    y = y - along * axis[1];
    z = z - along * axis[2];
    return sqrtf((x * x + y * y) + z * z) - 0.25f;
}
static float capsules(void *user, float x, float y, float z) {
    static const float first[3] = {1.25f, 0.5f, -0.25f}, second[3] = {-0.75f, 0.5f, 0.75f};
    (void)user;
    return fminf(capsule(x, y, z, first), capsule(x, y, z, second));
}
static const char capsules_glsl[] =
    "return min(capsule(p, vec3(1.25, 0.5, -0.25)), capsule(p, vec3(-0.75, 0.5, 0.75)));\n";
static const char capsules_prelude[] =
    "float capsule(vec3 p, vec3 a) {\n"
    "    SPT_PRECISE float square = (a.x * a.x + a.y * a.y) + a.z * a.z;\n"
    "    SPT_PRECISE float along = ((p.x * a.x + p.y * a.y) + p.z * a.z) / square;\n"
    "    SPT_PRECISE vec3 q = p - clamp(along, 0.0, 1.0) * a;\n"
    "    SPT_PRECISE float d = sqrt((q.x * q.x + q.y * q.y) + q.z * q.z) - 0.25;\n"
    "    return d;\n"
    "}\n";

/* A maximum of planes: a convex function. */
#define LONG 0.850650787f /* of the unit normals (0, 1, golden ratio) */
#define SHORT 0.525731087f
static float dodecahedron(void *user, float x, float y, float z) {
    const float a = fabsf(x), b = fabsf(y), c = fabsf(z);
    const float u = b * SHORT + c * LONG, v = c * SHORT + a * LONG, w = a * SHORT + b * LONG;
    (void)user;
    return fmaxf(u, fmaxf(v, w)) - 1.0f;
}
static const char dodecahedron_glsl[] =
    "SPT_PRECISE vec3 u = abs(p.yzx) * 0.525731087 + abs(p.zxy) * 0.850650787;\n"
    "SPT_PRECISE float d = max(u.x, max(u.y, u.z)) - 1.0;\n"
    "return d;\n";

/* A branching tree of five levels. */
static spt_krs tree;
static void grow_tree(void) {
    spt_kernel kernels[6];
    spt_mirror mirrors[5];
    spt_krs_model model = spt_krs_model_default();
    for (int i = 0; i < 6; ++i) {
        const float low[3] = {0.0f, 0.3f * (float)i - 1.0f, 0.0f};
        const float high[3] = {0.04f * (float)i, 0.3f * (float)i - 0.7f, 0.02f * (float)i};
        kernels[i] = spt_kernel_capsule(low, high, low, 0.2f - 0.03f * (float)i);
    }
    for (int i = 0; i < 5; ++i) {
        const float point[3] = {0.05f, 0.3f * (float)i - 0.7f, 0.0f};
        const float normal[3] = {i % 2 == 0 ? 1.0f : 0.3f, 0.4f, i % 2 == 0 ? 0.2f : 1.0f};
        mirrors[i] = spt_mirror_at(point, normal);
    }
    model.levels = 5;
    model.kernels = kernels;
    model.mirrors = mirrors;
    CHECK(spt_krs_build(&model, &tree) == SPT_OK);
}

/* ---- Worlds --------------------------------------------------------------------------------- */

static struct {
    int made;
    spt_bound ball, shell, half, tight;
    spt_field fields[SURFACE_WORLDS + SURFACE_SPECIAL][2];
    surface_world worlds[SURFACE_WORLDS + SURFACE_SPECIAL];
} all_worlds;

static spt_field field_of(spt_distance_fn *point, const char *glsl, const char *prelude,
                          float lipschitz, const spt_bound *bound) {
    spt_field field = spt_field_default();
    field.point = point;
    field.glsl = glsl;
    field.glsl_prelude = prelude;
    field.lipschitz = lipschitz;
    field.bound = bound;
    return field;
}

static void add(int index, const char *name, spt_field field) {
    all_worlds.fields[index][0] = field;
    all_worlds.worlds[index].name = name;
    all_worlds.worlds[index].fields = all_worlds.fields[index];
    all_worlds.worlds[index].count = 1;
}

static void make_worlds(void) {
    const spt_bound *const ball = &all_worlds.ball;
    spt_field field;
    all_worlds.made = 1;
    all_worlds.ball = spt_bound_sphere(0, 0, 0, 1.75f);
    all_worlds.shell = spt_bound_box(-1.5f, -0.5f, -1.5f, 1.5f, 0.5f, 1.5f);
    all_worlds.tight = spt_bound_sphere(0, 0, 0, 1.001f);
    all_worlds.half = spt_bound_sphere(0, 0.5f, 0, 1.25f);
    add(0, "sphere", field_of(sphere, sphere_glsl, NULL, 1, ball));
    add(1, "box", field_of(box, box_glsl, NULL, 1, NULL));
    add(2, "torus", field_of(torus, torus_glsl, NULL, 2, &all_worlds.shell));
    add(3, "capsules", field_of(capsules, capsules_glsl, capsules_prelude, 1, NULL));
    field = field_of(dodecahedron, dodecahedron_glsl, NULL, 1, ball);
    field.flags = SPT_FIELD_CONVEX;
    add(4, "dodecahedron", field);
    grow_tree();
    field = spt_krs_field(&tree);
    field.gradient = NULL; /* GLSL has differences only */
    add(5, "tree", field);
    add(6, "two bodies", field_of(capsules, capsules_glsl, capsules_prelude, 1, NULL));
    all_worlds.fields[6][1] = field_of(torus, torus_glsl, NULL, 2, &all_worlds.shell);
    all_worlds.worlds[6].count = 2;
    /* Sticks out of its bound. */
    add(7, "cut sphere", field_of(sphere, sphere_glsl, NULL, 1, &all_worlds.half));
    add(8, "tight sphere", field_of(sphere, sphere_glsl, NULL, 1, &all_worlds.tight));
    add(9, "broken sphere", field_of(broken, broken_glsl, NULL, 1, ball));
}

const surface_world *surface_world_of(int index) {
    if (!all_worlds.made) make_worlds();
    return &all_worlds.worlds[index];
}

const surface_world *surface_world_named(const char *name) {
    const surface_world *found = NULL;
    for (int i = 0; i < SURFACE_WORLDS + SURFACE_SPECIAL; ++i) {
        if (strcmp(surface_world_of(i)->name, name) == 0) found = surface_world_of(i);
    }
    CHECK(found != NULL);
    return found;
}

/* ---- Rays and hits -------------------------------------------------------------------------- */

void surface_set_variant(surface_case *all, const surface_world *world, int variant) {
    static const uint32_t features[SURFACE_VARIANTS] = {0, SPT_GLSL_PATH | SPT_GLSL_FLAGS,
                                                        SPT_GLSL_FLAGS, 0};
    static const float epsilon[SURFACE_VARIANTS] = {1e-5f, 1e-4f, 1e-2f, 1e-6f};
    all->world = world;
    all->settings = spt_settings_default();
    all->settings.pixel_radius = variant == 1 || variant == 2 ? 0.004f : 0.0f;
    all->settings.epsilon = epsilon[variant];
    all->settings.size = variant == 1 ? 4.0f : 0.0f;
    all->features = features[variant];
    check_context("%s, variant %d", world->name, variant);
}

void surface_draw(surface_case *all, double inside) {
    for (int i = 0; i < SURFACE_RAYS; ++i) {
        const double far = check_uniform(0, 1) < inside ? 0.75 : 4;
        const double scale = check_uniform(0.25, 4);
        spt_ray *const ray = &all->rays[i];
        for (int axis = 0; axis < 3; ++axis) {
            const double from = check_uniform(-far, far), to = check_uniform(-1.25, 1.25);
            ray->origin[axis] = (float)from;
            ray->direction[axis] = (float)((to - from) * scale);
        }
        ray->t_min = i % 8 == 0 ? (float)check_uniform(0, 0.1) : 0.0f;
        ray->t_max = i % 16 == 0 ? (float)check_uniform(0, 1) : 64.0f;
        all->path[i] = (all->features & SPT_GLSL_PATH) != 0 ? (float)check_uniform(0, 8) : 0.0f;
        all->cross[i] = i % 2;
    }
}

spt_rays surface_rays(const surface_case *all) {
    spt_rays rays = spt_rays_of(all->rays);
    rays.path.first = all->path;
    rays.path.stride = (ptrdiff_t)sizeof *all->path;
    return rays;
}

spt_hits surface_hits(surface_case *all) {
    spt_hits hits = spt_hits_of(all->hits);
    if ((all->features & SPT_GLSL_FLAGS) == 0) hits.flags.first = NULL;
    return hits;
}

void surface_trace(surface_case *all) {
    const surface_world *const world = all->world;
    const spt_rays rays = surface_rays(all);
    const spt_vector_sinks normals = spt_vector_sinks_of(all->normals[0]);
    spt_hits hits = spt_hits_of(all->hits);
    hits.candidate_t.first = hits.candidate_ratio.first = NULL;
    if (world->count == 1) {
        CHECK(spt_trace(world->fields, &all->settings, SURFACE_RAYS, &rays, &hits, NULL) == SPT_OK);
    } else {
        spt_scene scene = spt_scene_default();
        scene.fields = world->fields;
        scene.count = world->count;
        const size_t size = spt_scene_workspace(&scene, &all->settings);
        void *const workspace = malloc(size);
        CHECK(spt_scene_trace(&scene, &all->settings, SURFACE_RAYS, &rays, &hits, workspace, size,
                              NULL) == SPT_OK);
        free(workspace);
    }
    CHECK(spt_normals(world->fields, world->count, &all->settings, SPT_NORMAL_CENTRAL, 0,
                      SURFACE_RAYS, &rays, &hits, &normals) == SPT_OK);
}

/* ---- Shaders -------------------------------------------------------------------------------- */

/* The text of a library; NULL: the emitter refused. */
static char *emit(const surface_case *all, uint32_t features) {
    spt_glsl_options options = spt_glsl_options_default();
    spt_scene scene = spt_scene_default();
    size_t length = 0;
    scene.fields = all->world->fields;
    scene.count = all->world->count;
    if (scene.count == 1) {
        options.field = scene.fields;
    } else {
        options.scene = &scene;
    }
    options.settings = &all->settings;
    options.target = SPT_GLSL_LIBRARY;
    options.features = all->features | features;
    if (scene.count > 1) options.features |= SPT_GLSL_COMPONENT;
    if (spt_glsl_emit(&options, NULL, 0, &length) != SPT_BUFFER_TOO_SMALL) return NULL;
    char *const text = malloc(length + 1);
    if (spt_glsl_emit(&options, text, length + 1, NULL) == SPT_OK) return text;
    free(text);
    return NULL;
}

/* What of a ray and its hit the structures of the shader have. */
static void begin_statements(const surface_case *all, char *text, size_t capacity) {
    snprintf(text, capacity,
             "    SptRay ray;\n"
             "    SptHit hit;\n"
             "    ray.origin = q[0].xyz;\n"
             "    ray.t_min = q[0].w;\n"
             "    ray.direction = q[1].xyz;\n"
             "    ray.t_max = q[1].w;\n"
             "    hit.t = q[2].x;\n"
             "    hit.residual = q[2].y;\n"
             "    hit.outcome = int(q[2].z);\n"
             "    hit.evaluations = int(q[2].w);\n"
             "%s%s%s"
             "    vec3 normal = q[4].xyz;\n",
             (all->features & SPT_GLSL_PATH) != 0 ? "    ray.path = q[3].x;\n" : "",
             (all->features & SPT_GLSL_FLAGS) != 0 ? "    hit.flags = int(q[3].y);\n" : "",
             all->world->count > 1 ? "    hit.component = int(q[3].z);\n" : "");
}

static float finite_or_far(float number) {
    return number <= 3.0e38f ? number : 3.0e38f;
}

static int run(const surface_case *all, const char *library, const char *statements, float *out) {
    static float in[SURFACE_RAYS][4 * INPUTS];
    char text[4096];
    begin_statements(all, text, sizeof text);
    strcat(text, statements);
    for (int i = 0; i < SURFACE_RAYS; ++i) {
        const spt_ray *const ray = &all->rays[i];
        const spt_hit *const hit = &all->hits[i];
        const float of_ray[20] = {ray->origin[0],        ray->origin[1],
                                  ray->origin[2],        ray->t_min,
                                  ray->direction[0],     ray->direction[1],
                                  ray->direction[2],     ray->t_max,
                                  finite_or_far(hit->t), finite_or_far(hit->residual),
                                  (float)hit->outcome,   (float)hit->evaluations,
                                  all->path[i],          (float)hit->flags,
                                  (float)hit->component, 0,
                                  all->normals[i][0],    all->normals[i][1],
                                  all->normals[i][2],    (float)all->cross[i]};
        memcpy(in[i], of_ray, sizeof of_ray);
    }
    return engine_values(library, text, SURFACE_RAYS, INPUTS, in[0], 2, out);
}

int surface_ask(const surface_case *all, uint32_t features, const char *statements,
                float results[SURFACE_RAYS][SURFACE_RESULTS]) {
    char *const library = emit(all, features);
    int status = ENGINE_FAILED;
    CHECK(library != NULL);
    for (int i = 0; i < SURFACE_RAYS; ++i) {
        for (int k = 0; k < SURFACE_RESULTS; ++k) results[i][k] = NAN;
    }
    if (library != NULL) status = run(all, library, statements, results[0]);
    CHECK(status == ENGINE_OK);
    free(library);
    return status == ENGINE_OK;
}

int surface_agrees(float glsl, float c) {
    if (isnan(c)) return isnan(glsl);
    return check_same_bits(glsl, c > 3.0e38f ? 3.0e38f : c);
}
