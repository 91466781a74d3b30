/* SPDX-License-Identifier: MIT
 *
 * The programs whose sizes are measured, in one text: one ball and basic tracing, and what USE
 * names of the functions below. Compilers drop those that nobody calls and what they would link. */
#include <spheretrace/spheretrace.h>

enum { side = 8 }; /* of the frames, pixels */

static float ball(void *user, float x, float y, float z) {
    (void)user;
    return sqrtf(x * x + y * y + z * z) - 1.0f;
}

/* Without spt_settings_default(), which names spt_adaptive(). */
static spt_settings settings_of(const spt_method *method) {
    const spt_settings settings = {sizeof settings, method, 128,  1e-4f, 0.0f, 0.0f, 1.2f,
                                   0.88f,           0.3f,   3.0f, 0,     0};
    return settings;
}

static spt_field ball_field(void) {
    spt_field field = spt_field_default();
    field.point = ball;
    return field;
}

/* A ray along z that meets whatever has a surface within `reach` before the origin. */
static int hits(spt_status status, const spt_hit *hit, float nearest, float farthest) {
    return status == SPT_OK && hit->outcome == SPT_HIT && hit->t > nearest && hit->t < farthest;
}

static const spt_ray ray = {{0.05f, 0.1f, -3.0f}, 0.0f, {0.0f, 0.0f, 1.0f}, 10.0f};

static int trace(const spt_field *field, const spt_method *method) {
    const spt_settings settings = settings_of(method);
    spt_hit hit;
    const spt_rays rays = spt_rays_of(&ray);
    const spt_hits view = spt_hits_of(&hit);
    return hits(spt_trace(field, &settings, 1, &rays, &view, NULL), &hit, 1.0f, 2.9f);
}

/* ---- What may be used beside it ------------------------------------------------------------- */

static int nothing(void) {
    return 1;
}

static int relaxed(void) {
    const spt_field field = ball_field();
    return trace(&field, spt_relaxed());
}

static int enhanced(void) {
    const spt_field field = ball_field();
    return trace(&field, spt_enhanced());
}

static int auto_relaxed(void) {
    const spt_field field = ball_field();
    return trace(&field, spt_auto_relaxed());
}

static int adaptive(void) {
    const spt_field field = ball_field();
    return trace(&field, spt_adaptive());
}

static int convex(void) {
    spt_field field = ball_field();
    field.flags = SPT_FIELD_CONVEX;
    return trace(&field, spt_convex());
}

static int rules(void) {
    return relaxed() && enhanced() && auto_relaxed() && adaptive() && convex();
}

static int bounds(void) {
    const spt_bound bound = spt_bound_sphere(0, 0, 0, 1.5f);
    spt_field field = ball_field();
    float t_in, t_out;
    field.bound = &bound;
    return trace(&field, spt_basic()) &&
           spt_bound_interval(&bound, ray.origin, ray.direction, 0, 10, &t_in, &t_out) == SPT_OK;
}

static int normals(void) {
    const spt_settings settings = settings_of(spt_basic());
    const spt_field field = ball_field();
    spt_hit hit = {2.0f, 0, SPT_HIT, 0, 0, 0, 0, 0, 0};
    float normal[3];
    const spt_rays rays = spt_rays_of(&ray);
    const spt_hits view = spt_hits_of(&hit);
    const spt_vector_sinks sinks = spt_vector_sinks_of(normal);
    return spt_normals(&field, 1, &settings, SPT_NORMAL_CENTRAL, 0, 1, &rays, &view, &sinks) ==
               SPT_OK &&
           normal[2] < -0.9f;
}

/* One call of each of surface.h. */
static int surface(void) {
    const spt_bound bound = spt_bound_sphere(0, 0, 0, 1.5f);
    spt_settings settings = settings_of(spt_basic());
    spt_field field = ball_field(), level;
    spt_level_set memory;
    spt_hit hit;
    float normal[3] = {0, 0, -1}, number = 0.1f, t[2];
    int32_t occluded;
    spt_vector_sinks sinks = spt_vector_sinks_of(normal);
    const spt_vectors points = spt_vectors_of(ray.origin), directions = spt_vectors_of(normal);
    const spt_rays rays = spt_rays_of(&ray);
    const spt_hits view = spt_hits_of(&hit);
    const spt_column tangent = {&number, 0};
    const spt_sink to_number = {&number, 4}, to_occluded = {&occluded, 4};
    spt_starts starts = {{{{NULL, 0}, {NULL, 0}, {NULL, 0}}}, {NULL, 0}, {NULL, 0}};
    spt_crossings crossings = {{NULL, 0}, 4, 2, {NULL, 0}, {NULL, 0}, {NULL, 0}, {NULL, 0}};
    spt_bodies bodies = {points, {{{NULL, 0}, {NULL, 0}, {NULL, 0}}}, {NULL, 0}};
    spt_contacts contacts = {to_number, {{{NULL, 0}, {NULL, 0}, {NULL, 0}}}, {NULL, 0}, {NULL, 0}};
    field.bound = &bound;
    starts.origin = sinks;
    crossings.t.first = t;
    crossings.t.stride = sizeof t;
    return spt_trace_convex(&field, &settings, 1, &rays, &view, NULL) == SPT_OK &&
           spt_refine(&field, 1, &settings, 3, 1, &rays, &view) == SPT_OK && normals() &&
           spt_offset(&field, 1, &settings, 1, &rays, &view, &directions, NULL, 1, &starts) ==
               SPT_OK &&
           spt_occluded(&field, &settings, 1, &rays, &to_occluded, NULL) == SPT_OK && occluded &&
           spt_crossings_of(&field, &settings, 1, &rays, &crossings, NULL) == SPT_OK &&
           spt_soft_shadow(&field, &settings, &tangent, 0, 1, &rays, &to_number, NULL) == SPT_OK &&
           spt_ambient_occlusion(&field, 1, 5, 0.1f, 1, &points, &directions, &to_number) ==
               SPT_OK &&
           spt_collide(&field, 1, &settings, 1, &bodies, &contacts) == SPT_OK &&
           spt_level_set_field(&field, ray.origin, 0, 0.5f, &settings, &memory, &level) == SPT_OK;
}

static int scene(void) {
    static char workspace[1 << 18];
    const spt_settings settings = settings_of(spt_basic());
    const spt_field field = ball_field();
    spt_scene of_one = spt_scene_default();
    spt_hit hit;
    const spt_rays rays = spt_rays_of(&ray);
    const spt_hits view = spt_hits_of(&hit);
    of_one.fields = &field;
    of_one.count = 1;
    return spt_scene_workspace(&of_one, &settings) <= sizeof workspace &&
           hits(spt_scene_trace(&of_one, &settings, 1, &rays, &view, workspace, sizeof workspace,
                                NULL),
                &hit, 1.0f, 2.9f);
}

/* A whole picture; spt_frame_init() sets default settings, so the default rule is linked, too. */
static int frame(void) {
    static char workspace[1 << 18];
    static spt_hit image[side * side];
    static const float target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    const spt_field field = ball_field();
    spt_scene of_one = spt_scene_default();
    spt_camera camera;
    spt_frame whole;
    const spt_hits view = spt_hits_of(image);
    of_one.fields = &field;
    of_one.count = 1;
    if (spt_camera_pinhole(&camera, ray.origin, target, up, 0.2f, side, side) != SPT_OK) return 0;
    if (spt_frame_init(&whole, &of_one, &camera, side, side) != SPT_OK) return 0;
    whole.workspace = workspace;
    whole.workspace_size = sizeof workspace;
    return hits(spt_frame_trace(&whole, 0, spt_frame_tiles(&whole), &view, NULL),
                &image[side * side / 2], 1.0f, 2.9f);
}

static int krs(void) {
    static spt_krs tree;
    static const spt_mirror mirror = {{1, 0, 0}, 0};
    const spt_kernel kernels[2] = {spt_kernel_sphere(-0.5f, 0, 0, 0.5f),
                                   spt_kernel_sphere(0, 0.5f, 0, 0.5f)};
    spt_krs_model model = spt_krs_model_default();
    model.levels = 1;
    model.kernels = kernels;
    model.mirrors = &mirror;
    if (spt_krs_build(&model, &tree) != SPT_OK) return 0;
    const spt_field field = spt_krs_field(&tree);
    return trace(&field, spt_basic());
}

static int mobius(void) {
    static spt_conformal memory;
    static const double center[3] = {0, 0, 3};
    const spt_field field = ball_field();
    spt_mobius map;
    spt_field mapped;
    return spt_mobius_inversion(center, 3, &map) == SPT_OK &&
           spt_conformal_field(&field, &map, &memory, &mapped) == SPT_OK &&
           trace(&mapped, spt_basic());
}

static int glsl(void) {
    static char text[1 << 16];
    const spt_settings settings = settings_of(spt_basic());
    spt_glsl_options options = spt_glsl_options_default();
    spt_field field = ball_field();
    size_t length;
    field.glsl = "return length(p) - 1.0;";
    options.field = &field;
    options.settings = &settings;
    return spt_glsl_emit(&options, text, sizeof text, &length) == SPT_OK && length > 0;
}

static int everything(void) {
    return rules() && bounds() && surface() && scene() && frame() && krs() && mobius() && glsl();
}

int main(void) {
    const spt_field field = ball_field();
    return trace(&field, spt_basic()) && USE() ? 0 : 1;
}
