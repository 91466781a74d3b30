/* SPDX-License-Identifier: MIT
 *
 * Bodies rounded off by sums of powers (Akleman and Chen 1999), whose edges grow sharp with the
 * exponent: a dodecahedron and a cube by the library's shapes in float, and the same cube as it
 * stands in books, where powers overflow. All are convex functions; the last is none in float. */
#include <math.h>

#include <spheretrace/shapes.h>

#include "stability.h"

enum { exponent = 0, most_slabs = 6 };

typedef struct slabs {
    int count;
    spt_half_space slab[most_slabs];
} slabs;

/* (sum of |normal . p|^e)^(1/e) - 1 around (0, 0, 4), divided by the largest term before it is
 * raised. */
static double slabs_value(const stability_world *world, const double p[3]) {
    const slabs *const body = world->memory;
    const double from[3] = {p[0], p[1], p[2] - 4};
    double term[most_slabs], largest = 0, sum = 0;
    for (int i = 0; i < body->count; ++i) {
        const spt_point normal = body->slab[i].normal;
        const double n[3] = {(double)normal.x, (double)normal.y, (double)normal.z};
        term[i] = fabs(stability_dot(n, from));
        largest = fmax(largest, term[i]);
    }
    if (!(largest > 0)) return -1;
    for (int i = 0; i < body->count; ++i) sum += pow(term[i] / largest, world->number[exponent]);
    return largest * pow(sum, 1 / world->number[exponent]) - 1;
}

static void slabs_build(stability_world *world, double value, int count, const double (*normals)[3],
                        spt_distance_batch_fn *batch) {
    slabs *const body = report_allocate(sizeof *body);
    stability_begin(world, slabs_value);
    body->count = count;
    for (int i = 0; i < count; ++i) {
        body->slab[i].normal =
            spt_point_of((float)normals[i][0], (float)normals[i][1], (float)normals[i][2]);
        body->slab[i].offset = 1;
    }
    world->memory = body;
    world->number[exponent] = value;
    world->field.batch = batch;
    world->field.flags = SPT_FIELD_CONVEX;
    world->reach = 4;
    /* The shapes' header: off by less than twice 1e-6, so 34u, of coordinates and size. */
    world->units = 42;
}

/* Camera at the side; up to half beyond the body. */
static void slabs_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    double from[3], through[3];
    (void)world;
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = report_uniform(random, -0.3, 0.3);
        through[axis] = report_uniform(random, -1.6, 1.6);
    }
    through[2] = 4;
    stability_aim(ray, from, through, 20);
}

/* ---- Dodecahedron: six slabs ---------------------------------------------------------------- */

#define LONG 0.85065080835203993 /* of (0, 1, golden ratio), of unit length */
#define SHORT 0.52573111211913361

static const double dodecahedron_normals[most_slabs][3] = {{0, SHORT, LONG}, {0, SHORT, -LONG},
                                                           {SHORT, LONG, 0}, {SHORT, -LONG, 0},
                                                           {LONG, 0, SHORT}, {-LONG, 0, SHORT}};

static void dodecahedron_batch(void *user, size_t n, const float *restrict x,
                               const float *restrict y, const float *restrict z,
                               float *restrict distance) {
    const stability_world *const world = user;
    const slabs *const body = world->memory;
    const float e = (float)world->number[exponent];
    for (size_t i = 0; i < n; ++i) {
        distance[i] =
            spt_generalised_slabs(spt_point_of(x[i], y[i], z[i] - 4.0f), most_slabs, body->slab, e);
    }
}

static void dodecahedron_build(stability_world *world, double value) {
    slabs_build(world, value, most_slabs, dodecahedron_normals, dodecahedron_batch);
    const slabs *const body = world->memory;
    world->field.lipschitz = spt_generalised_lipschitz(body->count, body->slab, (float)value, 1);
    world->slope = (double)world->field.lipschitz;
}

#define EXPONENTS \
    .parameter = "exponent", .count = 9, .values = {2, 4, 8, 16, 32, 64, 128, 256, 512}

const stability_family stability_dodecahedron = {.name = "dodecahedron",
                                                 EXPONENTS,
                                                 .bound = 1,
                                                 .convex = 1,
                                                 .build = dodecahedron_build,
                                                 .ray = slabs_ray,
                                                 .truth = stability_walk_ray};

/* ---- Cube: three slabs at right angles, turned ---------------------------------------------- */

static const double cube_normals[3][3] = {
    {0.93969262078590843, 0, -0.34202014332566871},
    {0.059391174613884703, 0.98480775301220802, 0.16317591116653482},
    {0.33682408883346515, -0.17364817766693033, 0.92541657839832336}};

static void cube_batch(void *user, size_t n, const float *restrict x, const float *restrict y,
                       const float *restrict z, float *restrict distance) {
    const stability_world *const world = user;
    const slabs *const body = world->memory;
    const float e = (float)world->number[exponent];
    for (size_t i = 0; i < n; ++i) {
        distance[i] =
            spt_generalised_slabs(spt_point_of(x[i], y[i], z[i] - 4.0f), 3, body->slab, e);
    }
}

/* Norms of exponents from 2 on are at most the Euclidean one: the slope is 1, but for what rounded
 * normals lack to be at right angles. */
static void cube_build(stability_world *world, double value) {
    slabs_build(world, value, 3, cube_normals, cube_batch);
    world->field.lipschitz = 1 + 1e-6f;
    world->slope = 1 + 1e-6;
}

const stability_family stability_superquadric = {.name = "superquadric",
                                                 EXPONENTS,
                                                 .bound = 1,
                                                 .convex = 1,
                                                 .build = cube_build,
                                                 .ray = slabs_ray,
                                                 .truth = stability_walk_ray};

/* Powers of more than FLT_MAX are infinite, and infinity says that nothing is anywhere: that is no
 * distance bound. */
static void naive_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                        float *distance) {
    const stability_world *const world = user;
    const slabs *const body = world->memory;
    const float e = (float)world->number[exponent];
    for (size_t i = 0; i < n; ++i) {
        const spt_point p = spt_point_of(x[i], y[i], z[i] - 4.0f);
        float sum = 0;
        for (int k = 0; k < 3; ++k) sum += powf(fabsf(spt_dot(body->slab[k].normal, p)), e);
        distance[i] = powf(sum, 1 / e) - 1;
    }
}

static void naive_build(stability_world *world, double value) {
    cube_build(world, value);
    world->field.batch = naive_batch;
    world->field.flags = 0;
}

const stability_family stability_superquadric_naive = {.name = "superquadric_naive",
                                                       EXPONENTS,
                                                       .bound = 0,
                                                       .build = naive_build,
                                                       .ray = slabs_ray,
                                                       .truth = stability_walk_ray};
