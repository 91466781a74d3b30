/* SPDX-License-Identifier: MIT
 *
 * The fields, models and scenes that are traced by both. Every callback stands beside its text. */
#include "glsl_models.h"
#include "glsl_scenes.h"

#include <math.h>
#include <string.h>

#include <spheretrace/shapes.h>

/* ---- Fields --------------------------------------------------------------------------------- */

#define FIELD(name) static float name(void *user, float x, float y, float z)
#define TEXT(name) static const char name##_text[]

FIELD(sphere) {
    (void)user;
    const float d = sqrtf((x * x + y * y) + z * z) - 1.0f;
    return d;
}
TEXT(sphere) = "SPT_PRECISE float d = sqrt((p.x * p.x + p.y * p.y) + p.z * p.z) - 1.0;\n"
               "return d;";

FIELD(box) {
    (void)user;
    return spt_box(spt_point_of(x, y, z), spt_point_of(0.9f, 0.6f, 0.7f));
}
TEXT(box) = "return spt_box(p, vec3(0.9, 0.6, 0.7));";

FIELD(torus) {
    (void)user;
    return spt_torus(spt_point_of(x, y, z), 0.8f, 0.25f);
}
TEXT(torus) = "return spt_torus(p, 0.8, 0.25);";

/* The fillet of two balls and a quarter circle: its gradient is at most sqrt(2) long. */
FIELD(rounded_union) {
    (void)user;
    const float ax = x - 0.5f, bx = x + 0.5f, r = 0.3f;
    const float a = sqrtf((ax * ax + y * y) + z * z) - 0.6f;
    const float b = sqrtf((bx * bx + y * y) + z * z) - 0.5f;
    const float u = r - a > 0.0f ? r - a : 0.0f, v = r - b > 0.0f ? r - b : 0.0f;
    const float least = a < b ? a : b, most = r > least ? r : least;
    return most - sqrtf(u * u + v * v);
}
TEXT(rounded_union) = "SPT_PRECISE float a = caller_sphere_at(p, vec3(0.5, 0.0, 0.0), 0.6);\n"
                      "SPT_PRECISE float b = caller_sphere_at(p, vec3(-0.5, 0.0, 0.0), 0.5);\n"
                      "float u = max(0.3 - a, 0.0);\n"
                      "float v = max(0.3 - b, 0.0);\n"
                      "SPT_PRECISE float d = max(0.3, min(a, b)) - sqrt(u * u + v * v);\n"
                      "return d;";
TEXT(sphere_at) = "float caller_sphere_at(vec3 p, vec3 center, float radius) {\n"
                  "    vec3 q = p - center;\n"
                  "    SPT_PRECISE float d = sqrt((q.x * q.x + q.y * q.y) + q.z * q.z) - radius;\n"
                  "    return d;\n"
                  "}";

FIELD(smooth_union) {
    (void)user;
    const spt_point p = spt_point_of(x, y, z);
    const float a = spt_sphere(spt_translate(p, spt_point_of(0, 0.4f, 0)), 0.5f);
    return spt_smooth_union(a, spt_box(p, spt_point_of(0.9f, 0.2f, 0.6f)), 0.3f);
}
TEXT(smooth_union) = "float a = spt_sphere(spt_translate(p, vec3(0.0, 0.4, 0.0)), 0.5);\n"
                     "return spt_smooth_union(a, spt_box(p, vec3(0.9, 0.2, 0.6)), 0.3);";

FIELD(hollow_box) {
    (void)user;
    const float d = spt_box(spt_point_of(x, y, z), spt_point_of(0.8f, 0.7f, 0.6f));
    return fabsf(d) - 0.05f;
}
TEXT(hollow_box) = "return abs(spt_box(p, vec3(0.8, 0.7, 0.6))) - 0.05;";

FIELD(thin_slabs) {
    (void)user;
    float least = 3.0e38f;
    for (int i = -2; i <= 2; ++i) {
        const float across = y - 0.4f * (float)i;
        const float d = spt_box(spt_point_of(x, across, z), spt_point_of(1, 0.002f, 1));
        least = d < least ? d : least;
    }
    return least;
}
TEXT(thin_slabs) = "float least = 3.0e38;\n"
                   "for (int i = -2; i <= 2; ++i) {\n"
                   "    SPT_PRECISE float across = p.y - 0.4 * float(i);\n"
                   "    float d = spt_box(vec3(p.x, across, p.z), vec3(1.0, 0.002, 1.0));\n"
                   "    least = min(least, d);\n"
                   "}\n"
                   "return least;";

/* Normals of the dodecahedron, (0, 1, phi) and so on over their length. */
FIELD(dodecahedron) {
    (void)user;
    const float s = 0.525731112f, l = 0.850650808f;
    const float a = fabsf(s * y) + fabsf(l * z), b = fabsf(s * z) + fabsf(l * x);
    const float c = fabsf(s * x) + fabsf(l * y), ab = a > b ? a : b;
    return (ab > c ? ab : c) - 0.9f;
}
TEXT(dodecahedron) = "vec3 s = abs(0.525731112 * p);\n"
                     "vec3 l = abs(0.850650808 * p);\n"
                     "SPT_PRECISE float a = s.y + l.z;\n"
                     "SPT_PRECISE float b = s.z + l.x;\n"
                     "SPT_PRECISE float c = s.x + l.y;\n"
                     "SPT_PRECISE float d = max(max(a, b), c) - 0.9;\n"
                     "return d;";

/* Twice a distance, and says so. */
FIELD(doubled) {
    return 2.5f * torus(user, x, y, z);
}
TEXT(doubled) = "return 2.5 * spt_torus(p, 0.8, 0.25);";

/* The same, and does not say so. */
FIELD(steep) {
    return 2.5f * torus(user, x, y, z);
}

/* Half a ball that answers one number inside and one outside: it has no root, but jumps. */
FIELD(jump) {
    const float d = sphere(user, x, y, z);
    return d < 0.0f ? (x < 0.3f ? -0.25f : 0.5f) : d + 0.25f;
}
TEXT(jump) = "SPT_PRECISE float d = sqrt((p.x * p.x + p.y * p.y) + p.z * p.z) - 1.0;\n"
             "if (d < 0.0) return p.x < 0.3 ? -0.25 : 0.5;\n"
             "return d + 0.25;";

/* Regions that answer NaN, both infinities, and between them a ball. */
FIELD(nonfinite) {
    const float d = sphere(user, x, y, z);
    if (x > 0.9f) return NAN;
    if (x < -0.9f) return -INFINITY;
    if (y > 1.1f && y < 1.3f && d > 0.0f) return INFINITY;
    return d;
}
TEXT(nonfinite) = "SPT_PRECISE float d = sqrt((p.x * p.x + p.y * p.y) + p.z * p.z) - 1.0;\n"
                  "if (p.x > 0.9) return uintBitsToFloat(0x7fc00000u);\n"
                  "if (p.x < -0.9) return uintBitsToFloat(0xff800000u);\n"
                  "if (p.y > 1.1 && p.y < 1.3 && d > 0.0) return uintBitsToFloat(0x7f800000u);\n"
                  "return d;";

/* |gradient| <= 1 + 0.1 * 8 * sqrt(3) < 2.4 */
FIELD(waves) {
    (void)user;
    const float d = sqrtf(x * x + y * y + z * z) - 0.9f;
    return d + 0.1f * (sinf(8 * x) * sinf(8 * y) * sinf(8 * z));
}
TEXT(waves) = "float d = length(p) - 0.9;\n"
              "return d + 0.1 * (sin(8.0 * p.x) * sin(8.0 * p.y) * sin(8.0 * p.z));";

/* A box whose sections turn: the map's Lipschitz constant is (a + sqrt(a^2 + 4)) / 2 with a = 1.5
 * times the distance from the axis, which is at most 1.1 in the bound. */
FIELD(twisted) {
    (void)user;
    const float c = cosf(1.5f * y), s = sinf(1.5f * y);
    return spt_box(spt_point_of(c * x - s * z, y, s * x + c * z), spt_point_of(0.5f, 0.8f, 0.3f));
}
TEXT(twisted) = "float c = cos(1.5 * p.y), s = sin(1.5 * p.y);\n"
                "return spt_box(vec3(c * p.x - s * p.z, p.y, s * p.x + c * p.z),\n"
                "               vec3(0.5, 0.8, 0.3));";

/* The unit ball of the fourth norm, a convex function, |gradient| <= 1. */
FIELD(fourth_norm) {
    (void)user;
    const float a = x * x, b = y * y, c = z * z;
    return powf((a * a + b * b) + c * c, 0.25f) - 0.9f;
}
TEXT(fourth_norm) = "vec3 a = p * p;\n"
                    "return pow((a.x * a.x + a.y * a.y) + a.z * a.z, 0.25) - 0.9;";

/* ---- Volumes around a body ------------------------------------------------------------------ */

/* Within 0.8 of the origin, and the first eight kinds of volumes around it. */
FIELD(body) {
    (void)user;
    return spt_rounded_box(spt_point_of(x, y, z), spt_point_of(0.5f, 0.4f, 0.3f), 0.1f);
}
TEXT(body) = "return spt_rounded_box(p, vec3(0.5, 0.4, 0.3), 0.1);";

enum { volumes = 8 };
static spt_bound bounds[volumes], around, turned_box, layer;
static spt_bound_plane planes[5];

static void build_bounds(void) {
    static const float center[3] = {0.05f, 0, -0.05f}, low[3] = {-0.4f, 0.1f, 0},
                       high[3] = {0.5f, 0, 0.1f}, half[3] = {1.0f, 0.8f, 0.9f},
                       wide[3] = {1.2f, 1.0f, 1.2f}, normal[3] = {0.2f, 1.0f, -0.3f};
    static float axes[3][3] = {{0.8f, 0.6f, 0}, {-0.6f, 0.8f, 0}, {0, 0, 1}};
    static const float offsets[5] = {0.9f, 0.8f, 1.0f, 0.9f, 1.2f};
    static const float normals[5][3] = {
        {1, 0.2f, 0}, {-0.7f, 0.1f, 0.6f}, {0, 1.5f, 0.4f}, {0.3f, -1, 0.1f}, {-0.3f, 0.2f, -1}};
    for (int i = 0; i < 5; ++i) {
        memcpy(planes[i].normal, normals[i], sizeof normals[i]);
        planes[i].offset = offsets[i];
    }
    bounds[0] = spt_bound_sphere(0.05f, -0.05f, 0, 0.95f);
    bounds[1] = spt_bound_box(-0.7f, -0.5f, -0.4f, 0.65f, 0.5f, 0.45f);
    bounds[2] = spt_bound_oriented_box(center, axes, half);
    bounds[3] = spt_bound_capsule(low, high, 0.7f);
    bounds[4] = spt_bound_cylinder(low, high, 0.9f);
    bounds[5] = spt_bound_ellipsoid(center, axes, half);
    bounds[6] = spt_bound_slab(normal, -0.9f, 0.8f);
    bounds[7] = spt_bound_polytope(planes, 5);
    around = spt_bound_sphere(0, 0, 0, 1.1f);
    turned_box = spt_bound_oriented_box(center, axes, wide);
    layer = spt_bound_slab(normal, -1.4f, 1.4f);
}

/* ---- The list ------------------------------------------------------------------------------- */

enum { most_subjects = 48, most_components = 6 };

static glsl_subject subjects[most_subjects];
static spt_field fields[most_subjects], components[most_components], convex_components[3];
static spt_scene several, all_convex;
static int subject_count;

static spt_field field_of(spt_distance_fn *point, const char *text, float lipschitz) {
    spt_field field = spt_field_default();
    field.point = point;
    field.glsl = text;
    field.lipschitz = lipschitz;
    return field;
}

static spt_field *add(const char *name, spt_field field, unsigned traits, float wobble) {
    spt_field *const kept = &fields[subject_count];
    const glsl_subject subject = {name, kept, NULL, traits, wobble};
    *kept = field;
    subjects[subject_count++] = subject;
    return kept;
}

static void add_scene(const char *name, const spt_scene *scene) {
    const glsl_subject subject = {name, NULL, scene, 0, 0};
    subjects[subject_count++] = subject;
}

static void add_fields(void) {
    add("sphere", field_of(sphere, sphere_text, 1), 0, 0)->flags = SPT_FIELD_CONVEX;
    add("box", field_of(box, box_text, 1), 0, 0)->flags = SPT_FIELD_CONVEX;
    add("torus", field_of(torus, torus_text, 1), 0, 0);
    add("rounded union", field_of(rounded_union, rounded_union_text, 1.4143f), 0, 0)->glsl_prelude =
        sphere_at_text;
    add("smooth union", field_of(smooth_union, smooth_union_text, 1), 0, 0);
    add("hollow box", field_of(hollow_box, hollow_box_text, 1), 0, 0);
    add("thin slabs", field_of(thin_slabs, thin_slabs_text, 1), 0, 0);
    add("dodecahedron", field_of(dodecahedron, dodecahedron_text, 1), 0, 0)->flags =
        SPT_FIELD_CONVEX;
    add("doubled", field_of(doubled, doubled_text, 2.5f), 0, 0);
    add("steep", field_of(steep, doubled_text, 1), GLSL_ODD, 0);
    add("jump", field_of(jump, jump_text, 1), GLSL_ODD, 0);
    add("nonfinite", field_of(nonfinite, nonfinite_text, 1), GLSL_ODD, 0);
    /* Three sines of 0.1, over the Lipschitz constant. */
    add("waves", field_of(waves, waves_text, 2.4f), GLSL_TRANSCENDENTAL, 0.3f / 2.4f);
    /* A rotation of points at most 1.1 away by a sine and a cosine. */
    add("twisted", field_of(twisted, twisted_text, 2.2f), GLSL_TRANSCENDENTAL, 1.5f * 1.1f / 2.2f)
        ->bound = &around;
    add("fourth norm", field_of(fourth_norm, fourth_norm_text, 1), GLSL_TRANSCENDENTAL, 1)->flags =
        SPT_FIELD_CONVEX;
}

static void add_bounded(void) {
    static const char *const names[volumes] = {
        "in a sphere",   "in a box",        "in an oriented box", "in a capsule",
        "in a cylinder", "in an ellipsoid", "in a slab",          "in a polytope"};
    for (int i = 0; i < volumes; ++i) {
        spt_field *const field = add(names[i], field_of(body, body_text, 1), 0, 0);
        field->flags = SPT_FIELD_CONVEX;
        field->bound = &bounds[i];
    }
}

/* The component's own place is in its callback: users are offsets. */
static float moved_ball(void *user, float x, float y, float z) {
    const float *at = user;
    return sphere(NULL, x - at[0], y - at[1], z - at[2]);
}
static float left_at[3] = {-1.1f, 0.2f, 0.3f};
TEXT(left) = "vec3 q = p - vec3(-1.1, 0.2, 0.3);\n"
             "SPT_PRECISE float d = sqrt((q.x * q.x + q.y * q.y) + q.z * q.z) - 1.0;\n"
             "return d;";

static void add_scenes(void) {
    int count;
    static const int32_t materials[most_components] = {7, 3, 0, 12, -5, 1};
    static spt_bound ball;
    ball = spt_bound_sphere(left_at[0], left_at[1], left_at[2], 1.01f);
    components[0] = field_of(torus, torus_text, 1);
    components[1] = field_of(moved_ball, left_text, 1);
    components[1].user = left_at;
    components[1].flags = SPT_FIELD_CONVEX;
    components[1].bound = &ball;
    components[2] = field_of(dodecahedron, dodecahedron_text, 1);
    components[2].flags = SPT_FIELD_CONVEX;
    components[3] = field_of(doubled, doubled_text, 2.5f);
    components[3].bound = &turned_box;
    components[4] = glsl_models(&count)[0].field;
    components[5] = field_of(thin_slabs, thin_slabs_text, 1);
    components[5].bound = &layer;
    several = spt_scene_default();
    several.fields = components;
    several.count = most_components;
    several.materials = materials;
    convex_components[0] = components[1];
    convex_components[1] = components[2];
    convex_components[2] = components[1];
    all_convex = spt_scene_default();
    all_convex.fields = convex_components;
    all_convex.count = 3;
    add_scene("scene", &several);
    add_scene("convex scene", &all_convex);
}

static void add_models(void) {
    int count;
    const glsl_model *models = glsl_models(&count);
    for (int i = 0; i < count; ++i) {
        add(models[i].name, models[i].field, models[i].is_sequence ? GLSL_MODEL : 0, 0);
    }
}

const glsl_subject *glsl_subjects(int *count) {
    if (subject_count == 0) {
        build_bounds();
        add_fields();
        add_bounded();
        add_models();
        add_scenes();
    }
    *count = subject_count;
    return subjects;
}

const glsl_subject *glsl_subject_named(const char *name) {
    int count;
    const glsl_subject *all = glsl_subjects(&count);
    for (int i = 0; i < count; ++i) {
        if (strcmp(all[i].name, name) == 0) return &all[i];
    }
    return NULL;
}
