/* SPDX-License-Identifier: MIT
 *
 * Schools of fish: six of them, each in a pose of its own, through mirrors that keep them swimming
 * along x (Szécsi et al. 2016, Fig. 5). Variant 1: mirrors along the axes. The fish do not touch
 * the mirrors. */
#include "model_nature.h"

#include <spheretrace/shapes.h>

#include <math.h>

enum { FISH_POSES = 6, FISH_LEVELS = 10, FISH_MOST = 2 << FISH_LEVELS };

/* How a fish is seen: places of its kind in its own length, which is 1, its head towards x. */
typedef struct fish_pose {
    float x, y, z;    /* its middle */
    float size;       /* its length */
    float swing;      /* how its tail is bent, per length, at most 0.4 in magnitude */
    float half_depth; /* of its body, in its length */
} fish_pose;

/* The Lipschitz constant of the bent fish: the shear is at most 2 * 0.4 * 0.62 = a, and that of a
 * shear (a + sqrt(a^2 + 4)) / 2 = 1.28. */
#define FISH_LIPSCHITZ 1.28f

/* How thick a body is to how deep, and how thick a fin is, in lengths. */
#define FISH_FLAT 0.5f
#define FISH_FIN 0.004f

/* Between two circles through (-half, 0) and (half, 0) that reach `bulge` to the sides; x and
 * y >= 0. The distance in the plane. */
SPT_SHAPE spt_real fish_lens(spt_real x, spt_real y, spt_real half, spt_real bulge) {
    const spt_real radius = (half * half + bulge * bulge) / (2 * bulge);
    const spt_real below = radius - bulge;
    const spt_real up = y + below, aside = x - half;
    const int beyond = x * below > up * half;
    const spt_real square = spt_choose(beyond, aside * aside + y * y, x * x + up * up);
    return spt_root(square) - spt_choose(beyond, 0, radius);
}

/* A fin: such a lens in the plane z = 0, around (middle_x, middle_y) and along a unit vector. */
SPT_SHAPE spt_real fish_fin(spt_real x, spt_real y, spt_real z, spt_real middle_x,
                            spt_real middle_y, spt_real along_x, spt_real along_y, spt_real half,
                            spt_real bulge) {
    const spt_real a = x - middle_x, b = y - middle_y;
    const spt_real flat = fish_lens(spt_magnitude(a * along_x + b * along_y),
                                    spt_magnitude(b * along_x - a * along_y), half, bulge);
    return spt_length_2(spt_positive(flat), z) - FISH_FIN;
}

/* A fish of length 1. Above and below it is alike, since mirrors turn it over. */
SPT_SHAPE spt_real fish_body(spt_point p, spt_real swing, spt_real half_depth) {
    const spt_real behind = spt_clamp(p.x - 0.1f, -0.62f, 0);
    const spt_real x = p.x, y = spt_magnitude(p.y), z = p.z - swing * behind * behind;
    const spt_real side = spt_magnitude(z);
    /* squeezed to the side, hence the factor */
    const spt_real around = spt_length_2(y, side * (1 / FISH_FLAT));
    const spt_real body =
        FISH_FLAT * fish_lens(spt_magnitude(x - 0.04f), around, 0.46f, half_depth);
    const spt_real tail = fish_fin(x, y, z, -0.46f, 0.1f, -0.62f, 0.7846f, 0.14f, 0.035f);
    const spt_real back =
        fish_fin(x, y, z, -0.06f, half_depth * 0.93f, -0.93f, 0.3676f, 0.17f, 0.05f);
    const spt_real chest = fish_fin(x, side, p.y + 0.02f, 0.12f, half_depth * FISH_FLAT + 0.03f,
                                    -0.8f, 0.6f, 0.09f, 0.025f);
    const spt_real eye = spt_length_3(x - 0.37f, y, side - half_depth * FISH_FLAT * 0.4f) - 0.019f;
    const spt_real soft = spt_smooth_union(body, tail, 0.05f);
    return spt_union(spt_union(soft, spt_union(back, chest)), eye);
}

SPT_SHAPE spt_real fish_distance(const fish_pose *pose, spt_real x, spt_real y, spt_real z) {
    const spt_real inverse = 1 / pose->size;
    const spt_point p =
        spt_point_of((x - pose->x) * inverse, (y - pose->y) * inverse, (z - pose->z) * inverse);
    /* from afar the ball around it is the better bound */
    const spt_real ball = spt_sphere(p, 0.62f);
    return pose->size * spt_greatest(fish_body(p, pose->swing, pose->half_depth), ball);
}

static void fish_batch(void *user, size_t n, const float *restrict x, const float *restrict y,
                       const float *restrict z, float *restrict distance) {
    const fish_pose pose = *(const fish_pose *)user;
    for (size_t i = 0; i < n; ++i) distance[i] = fish_distance(&pose, x[i], y[i], z[i]);
}

/* Differences along the diagonals of a cube (four of its corners), a thousandth of a length. */
static void fish_gradient(void *user, size_t n, const float *restrict x, const float *restrict y,
                          const float *restrict z, float *restrict gradient_x,
                          float *restrict gradient_y, float *restrict gradient_z) {
    const fish_pose pose = *(const fish_pose *)user;
    const float h = 0.001f * pose.size;
    for (size_t i = 0; i < n; ++i) {
        const float a = fish_distance(&pose, x[i] + h, y[i] + h, z[i] + h);
        const float b = fish_distance(&pose, x[i] + h, y[i] - h, z[i] - h);
        const float c = fish_distance(&pose, x[i] - h, y[i] + h, z[i] - h);
        const float d = fish_distance(&pose, x[i] - h, y[i] - h, z[i] + h);
        gradient_x[i] = (a + b) - (c + d);
        gradient_y[i] = (a + c) - (b + d);
        gradient_z[i] = (a + d) - (b + c);
    }
}

/* ---- Schools ------------------------------------------------------------------------------- */

typedef struct fish_school {
    fish_pose poses[FISH_POSES]; /* one for each level from the lowest on, as far as there are */
    int levels;                  /* at most FISH_LEVELS */
    int aligned;
    uint32_t seed;
    float gap; /* least distance from a mirror, in lengths of the first fish */
    float tint[3];
} fish_school;

/* clang-format off */
static fish_school fish_schools[] = { /* never written, but callbacks take no pointer to const */
    {{{0, 0, 0, 0.55f, 0.3f, 0.13f}, {0.8f, 0.1f, 0.12f, 0.6f, -0.2f, 0.13f},
      {-0.85f, -0.12f, 0.1f, 0.5f, -0.35f, 0.13f}, {1.5f, 0.22f, -0.1f, 0.57f, 0.15f, 0.13f},
      {-1.6f, 0.15f, 0.3f, 0.53f, 0.25f, 0.13f}, {2.4f, -0.2f, 0.2f, 0.6f, -0.3f, 0.13f}},
     10, 0, 4, 0.05f, {1, 1, 1}},
    {{{0, 0, 0, 0.55f, 0.3f, 0.13f}, {0.8f, 0.1f, 0.12f, 0.6f, -0.2f, 0.13f},
      {-0.85f, -0.12f, 0.1f, 0.5f, -0.35f, 0.13f}, {1.5f, 0.22f, -0.1f, 0.57f, 0.15f, 0.13f},
      {-1.6f, 0.15f, 0.3f, 0.53f, 0.25f, 0.13f}, {2.4f, -0.2f, 0.2f, 0.6f, -0.3f, 0.13f}},
     10, 1, 1, 0.05f, {1, 1, 1}},
    {{{1.2f, 2.35f, -1, 0.2f, 0.3f, 0.17f}, {1.5f, 2.4f, -0.95f, 0.22f, -0.2f, 0.17f},
      {0.88f, 2.3f, -0.96f, 0.19f, -0.35f, 0.17f}, {1.8f, 2.45f, -1.02f, 0.2f, 0.15f, 0.17f},
      {0.58f, 2.4f, -0.92f, 0.21f, 0.25f, 0.17f}, {2.1f, 2.3f, -0.95f, 0.2f, -0.3f, 0.17f}},
     8, 0, 4, 0.3f, {1.5f, 1, 0.35f}},
    {{{-0.9f, 2, 1.2f, 0.5f, 0.3f, 0.15f}, {-0.2f, 2.1f, 1.3f, 0.55f, -0.2f, 0.15f},
      {-1.6f, 1.9f, 1.3f, 0.5f, -0.35f, 0.15f}, {0.4f, 2.3f, 1.1f, 0.5f, 0.15f, 0.15f},
      {0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0}},
     3, 0, 5, 0.3f, {0.6f, 0.9f, 1.5f}},
};
/* clang-format on */

/* What is known of a fish when mirrors are put beside it. */
typedef struct fish_instance {
    double middle[3], head[3], size;
} fish_instance;

/* How far fish reach along a unit vector, at most: 0.6 of a length to head and tail, and no more
 * than 0.22 across, fins and bend included. */
static double fish_reach(const fish_instance *fish, int count, const double along[3]) {
    double most = -1e30;
    for (int i = 0; i < count; ++i) {
        const double reach = model_dot(fish[i].middle, along) +
                             fish[i].size * (0.6 * fabs(model_dot(fish[i].head, along)) + 0.22);
        most = reach > most ? reach : most;
    }
    return most;
}

static void fish_reflect(const fish_instance *fish, const double normal[3], double offset,
                         fish_instance *image) {
    const double beyond = 2 * (model_dot(fish->middle, normal) - offset);
    const double turned = 2 * model_dot(fish->head, normal);
    *image = *fish;
    for (int k = 0; k < 3; ++k) {
        image->middle[k] -= beyond * normal[k];
        image->head[k] -= turned * normal[k];
    }
}

/* Normals are nearly along y or z: others would roll the fish, or turn them round. They lean less
 * the more fish they mirror, which would otherwise leave gaps in the shape of wedges. */
static void fish_normal(const fish_school *school, int level, uint32_t *state, double normal[3]) {
    const double lean = school->aligned ? 0 : 1 / (1 + 0.25 * level);
    const double along = lean * model_random(state, -0.5, 0.5);
    const double across = lean * model_random(state, -0.2, 0.2);
    const double way = model_random(state, -1, 1) < 0 ? -1 : 1;
    const int up = level % 5 == 1 || level % 5 == 3;
    normal[0] = along;
    normal[1] = up ? way : across;
    normal[2] = up ? across : way;
    model_unit(normal);
}

/* One more mirror, beside all fish so far. */
static int fish_double(const fish_school *school, model_sketch *sketch, fish_instance *fish,
                       int count, uint32_t *state) {
    double normal[3], point[3];
    fish_normal(school, (int)sketch->levels, state, normal);
    const double gap = (double)(school->gap * school->poses[0].size);
    const double offset = fish_reach(fish, count, normal) + gap * model_random(state, 0.3, 1.7);
    for (int k = 0; k < 3; ++k) point[k] = offset * normal[k];
    sketch_double(sketch, point, normal, NULL);
    for (int k = 0; k < count; ++k) fish_reflect(&fish[k], normal, offset, &fish[count + k]);
    return 2 * count;
}

model_component *model_add_fish(model_world *world, model_school which) {
    fish_instance fish[FISH_MOST];
    fish_school *const school = &fish_schools[which];
    spt_field fields[FISH_POSES];
    spt_bound bounds[FISH_POSES];
    model_sketch sketch;
    uint32_t state = school->seed;
    int count = 0;
    for (int i = 0; i <= school->levels; ++i) {
        if (i > 0) count = fish_double(school, &sketch, fish, count, &state);
        if (i >= FISH_POSES) continue;
        fish_pose *const pose = &school->poses[i];
        const fish_instance one = {
            {(double)pose->x, (double)pose->y, (double)pose->z}, {1, 0, 0}, (double)pose->size};
        bounds[i] = spt_bound_sphere(pose->x, pose->y, pose->z, 0.62f * pose->size);
        fields[i] = spt_field_default();
        fields[i].batch = fish_batch;
        fields[i].gradient = fish_gradient;
        fields[i].user = pose;
        fields[i].lipschitz = FISH_LIPSCHITZ;
        fields[i].bound = &bounds[i];
        const spt_kernel kernel = spt_kernel_field(&fields[i]);
        if (i == 0) sketch_begin(&sketch, &kernel);
        sketch.kernels[i] = kernel;
        fish[count++] = one;
    }
    model_component *const component = sketch_add(world, &sketch, 0, NULL, MODEL_FISH);
    if (component != NULL) {
        for (int k = 0; k < 3; ++k) component->tint[k] = school->tint[k];
    }
    return component;
}

static int build(model_world *world, int variant) {
    model_begin(world);
    if (model_add_fish(world, variant == 1 ? MODEL_SCHOOL_ALIGNED : MODEL_SCHOOL_ALONE) == NULL) {
        return 0;
    }
    return model_finish(world);
}

const model model_fish = {.name = "fish",
                          .description = "a school of fish in unaligned mirrors",
                          .eye = {0.5, -1, 9},
                          .target = {-1.6, -1.3, 0},
                          .field_of_view = 55,
                          .t_max = 40,
                          .haze = 22,
                          .under_water = 1,
                          .build = build};
