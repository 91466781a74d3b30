/* SPDX-License-Identifier: MIT
 *
 * The models, and callers' fields for their kernels. */
#include "krs_glsl_world.h"

#include <math.h>

#include "glsl_check.h"

/* ---- Callers' fields ------------------------------------------------------------------------- */

static float box(void *user, float x, float y, float z) {
    const float a = 0.8f * x - 0.6f * y, b = 0.6f * x + 0.8f * y;
    const float u = fabsf(a) - 0.25f, v = fabsf(b) - 0.5f, w = fabsf(z) - 0.125f;
    const float p = u > 0.0f ? u : 0.0f, q = v > 0.0f ? v : 0.0f, r = w > 0.0f ? w : 0.0f;
    const float most = fmaxf(u, fmaxf(v, w));
    (void)user;
    return sqrtf((p * p + q * q) + r * r) + fminf(most, 0.0f);
}
static const char box_text[] =
    "SPT_PRECISE vec2 turned = vec2(0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y);\n"
    "SPT_PRECISE vec3 q = abs(vec3(turned, p.z)) - vec3(0.25, 0.5, 0.125);\n"
    "vec3 r = max(q, 0.0);\n"
    "SPT_PRECISE float d = sqrt((r.x * r.x + r.y * r.y) + r.z * r.z) + "
    "min(max(q.x, max(q.y, q.z)), 0.0);\n"
    "return d;\n";

static float torus(void *user, float x, float y, float z) {
    const float ring = sqrtf(x * x + z * z) - 0.5f;
    return 2.0f * (sqrtf(ring * ring + y * y) - *(const float *)user);
}
static const char torus_prelude[] =
    "// Twice the distance.\n"
    "float twice_torus(vec3 p, float radius) {\n"
    "    SPT_PRECISE float ring = sqrt(p.x * p.x + p.z * p.z) - 0.5;\n"
    "    SPT_PRECISE float d = 2.0 * (sqrt(ring * ring + p.y * p.y) - radius);\n"
    "    return d;\n"
    "}";

static float torus_with_nan(void *user, float x, float y, float z) {
    return z > 0.5f ? NAN : z < -0.5f ? -INFINITY : torus(user, x, y, z);
}

static float thick = 0.25f, thin = 0.125f;

static spt_field field_of(spt_distance_fn *point, void *user, float lipschitz, const char *text,
                          const char *prelude) {
    static const spt_bound ball = {
        .struct_size = sizeof ball, .kind = SPT_BOUND_SPHERE, .radius = 1};
    spt_field field = spt_field_default();
    field.point = point;
    field.user = user;
    field.lipschitz = lipschitz;
    field.bound = &ball;
    field.glsl = text;
    field.glsl_prelude = prelude;
    return field;
}

const spt_field *world_field(int number) {
    static spt_field fields[WORLD_FIELDS];
    fields[0] = field_of(box, NULL, 1, box_text, NULL);
    fields[1] = field_of(torus, &thick, 2, "return twice_torus(p, 0.25);", torus_prelude);
    fields[2] = field_of(torus, &thin, 2, "return twice_torus(p, 0.125);\n", torus_prelude);
    return &fields[number];
}

const spt_field *world_field_with_nan(void) {
    static spt_field field;
    field = field_of(torus_with_nan, &thick, 2,
                     "if (p.z > 0.5) return uintBitsToFloat(0x7fc00000u);\n"
                     "if (p.z < -0.5) return uintBitsToFloat(0xff800000u);\n"
                     "return twice_torus(p, 0.25);\n",
                     torus_prelude);
    return &field;
}

static float nothing(void *user, float x, float y, float z) {
    (void)user;
    (void)x;
    (void)y;
    (void)z;
    return INFINITY;
}

const spt_field *world_field_of_nothing(float lipschitz) {
    static spt_field field;
    field = field_of(nothing, NULL, lipschitz, "return uintBitsToFloat(0x7f800000u);", NULL);
    return &field;
}

/* ---- Models ---------------------------------------------------------------------------------- */

static float between(double low, double high) {
    return (float)check_uniform(low, high);
}

static void random_vector(double reach, float v[3]) {
    for (int axis = 0; axis < 3; ++axis) v[axis] = between(-reach, reach);
}

/* Sometimes straight, sometimes nearly so. */
static spt_kernel random_capsule(void) {
    float a[3], b[3], control[3], away[3];
    const uint32_t turn = check_random() % 4;
    const float bent = turn == 0 ? 0.0f : turn == 1 ? between(0, 1e-4) : between(0.1, 1);
    random_vector(0.5, a);
    random_vector(0.5, b);
    random_vector(0.5, away);
    for (int axis = 0; axis < 3; ++axis) {
        control[axis] = 0.5f * (a[axis] + b[axis]) + bent * away[axis];
    }
    return spt_kernel_capsule(a, b, control, between(0, 0.2));
}

static spt_kernel random_leaf(void) {
    float tip[3], other[3], across[3], square = 0.0f;
    random_vector(0.5, tip);
    random_vector(0.5, other);
    random_vector(1, across);
    other[0] += 0.25f + fabsf(other[0] - tip[0]); /* not the same */
    for (int axis = 0; axis < 3; ++axis) {
        square += (other[axis] - tip[axis]) * (other[axis] - tip[axis]);
    }
    return spt_kernel_leaf(tip, other, across, sqrtf(square) * between(0.02, 0.49),
                           between(0, 0.1));
}

spt_kernel world_kernel(uint32_t kinds) {
    uint32_t kind = check_random() % SPT_KERNEL_KINDS;
    float p[3];
    while (!(kinds >> kind & 1)) kind = check_random() % SPT_KERNEL_KINDS;
    random_vector(0.75, p);
    switch (kind) {
    case SPT_KERNEL_SPHERE:
        return spt_kernel_sphere(p[0], p[1], p[2], between(0, 0.5));
    case SPT_KERNEL_HALF_SPACE:
        return spt_kernel_half_space(p[0], p[1], p[2], between(-2, -1));
    case SPT_KERNEL_CAPSULE:
        return random_capsule();
    case SPT_KERNEL_LEAF:
        return random_leaf();
    case SPT_KERNEL_FIELD:
        return spt_kernel_field(world_field((int)(check_random() % WORLD_FIELDS)));
    default:
        return spt_kernel_empty();
    }
}

void world_krs(uint32_t levels, uint32_t kinds, spt_krs *krs) {
    spt_kernel kernels[SPT_KRS_LEVELS + 1];
    spt_mirror mirrors[SPT_KRS_LEVELS];
    spt_krs_model model = spt_krs_model_default();
    for (uint32_t level = 0; level <= levels; ++level) kernels[level] = world_kernel(kinds);
    for (uint32_t level = 0; level < levels; ++level) {
        random_vector(1, mirrors[level].normal);
        /* Along the axes, too, and of length 1 up to rounding. */
        if (level % 5 == 4) mirrors[level].normal[0] = mirrors[level].normal[1] = 0.0f;
        mirrors[level].offset = between(-0.1, 0.75);
    }
    model.levels = levels;
    model.kernels = kernels;
    model.mirrors = mirrors;
    CHECK(spt_krs_build(&model, krs) == SPT_OK);
}

static void append(spt_mobius *map, const spt_mobius *next, spt_status status) {
    CHECK(status == SPT_OK);
    CHECK(spt_mobius_compose(next, map, map) == SPT_OK);
}

spt_mobius world_map(void) {
    spt_mobius map = spt_mobius_identity(), next = spt_mobius_identity();
    const uint32_t steps = check_random();
    const double move[3] = {check_uniform(-1, 0.25), check_uniform(-0.5, 0.5),
                            check_uniform(-0.5, 0.5)};
    const double axis[3] = {check_uniform(-1, 1), check_uniform(-1, 1), check_uniform(0.1, 1)};
    const double center[3] = {check_uniform(1.5, 3), check_uniform(-1, 1), check_uniform(-1, 1)};
    spt_status status = spt_mobius_translation(move, &next);
    append(&map, &next, status);
    if (steps & 1) {
        status = spt_mobius_rotation(axis, check_uniform(-3, 3), &next);
        append(&map, &next, status);
    }
    if (steps & 2) {
        status = spt_mobius_dilation(check_uniform(0.6, 1.2), &next);
        append(&map, &next, status);
    }
    if (steps & 4) {
        status = spt_mobius_reflection(axis, 0.25, &next);
        append(&map, &next, status);
    }
    if (steps & 24) { /* of two, one is weak */
        status = spt_mobius_inversion(center, check_uniform(1, 3), &next);
        append(&map, &next, status);
    }
    return map;
}

void world_moekrs(uint32_t levels, uint32_t kinds, uint64_t unmirrored, spt_moekrs *moekrs) {
    spt_kernel kernels[SPT_KRS_LEVELS + 1];
    spt_mobius maps[SPT_KRS_LEVELS];
    spt_moekrs_model model = spt_moekrs_model_default();
    for (uint32_t level = 0; level <= levels; ++level) kernels[level] = world_kernel(kinds);
    for (uint32_t level = 0; level < levels; ++level) maps[level] = world_map();
    model.levels = levels;
    model.kernels = kernels;
    model.maps = maps;
    model.unmirrored = unmirrored;
    CHECK(spt_moekrs_build(&model, moekrs) == SPT_OK);
}
