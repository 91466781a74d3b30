/* SPDX-License-Identifier: MIT
 *
 * Balls and half spaces under maps, as fields and as truth. */
#include "mobius_world.h"
#include "../check.h"
#include "tolerance.h"

#include <math.h>

/* ---- The inner field, in double, rounded once ------------------------------------------------ */

static double kernel_distance(const mapped_world *world, const double p[3], int *which) {
    double least = HUGE_VAL;
    for (int i = 0; i < world->count; ++i) {
        const solid *one = &world->kernel[i];
        double sum = 0, distance;
        for (int k = 0; k < 3; ++k) {
            const double c = (double)one->center[k];
            sum += one->kind == SPT_REGION_HALF_SPACE ? c * p[k] : (p[k] - c) * (p[k] - c);
        }
        distance = (one->kind == SPT_REGION_HALF_SPACE ? sum : sqrt(sum)) - (double)one->radius;
        if (distance < least) {
            least = distance;
            *which = i;
        }
    }
    return least;
}

static void kernel_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                         float *distance) {
    for (size_t i = 0; i < n; ++i) {
        const double p[3] = {(double)x[i], (double)y[i], (double)z[i]};
        int which = 0;
        distance[i] = (float)kernel_distance(user, p, &which);
    }
}

static void kernel_gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                            float *gradient_x, float *gradient_y, float *gradient_z) {
    const mapped_world *world = user;
    for (size_t i = 0; i < n; ++i) {
        const double p[3] = {(double)x[i], (double)y[i], (double)z[i]};
        float *const gradient[3] = {&gradient_x[i], &gradient_y[i], &gradient_z[i]};
        int which = 0;
        const double distance = kernel_distance(world, p, &which);
        const solid *one = &world->kernel[which];
        for (int k = 0; k < 3; ++k) {
            const double c = (double)one->center[k];
            *gradient[k] = (float)(one->kind == SPT_REGION_HALF_SPACE
                                       ? c
                                       : (p[k] - c) / (distance + (double)one->radius));
        }
    }
}

/* ---- Worlds ---------------------------------------------------------------------------------- */

static const double origin[3] = {0, 0, 0};

void mapped_build(mapped_world *world) {
    world->map = chain_build(&world->steps);
    world->pole = chain_image(&world->steps, 0, place_infinite());
    world->size = world->extent * (double)chain_scale(&world->steps, 0, place_of(origin));
    for (int i = 0; i < world->count; ++i)
        world->image[i] = chain_solid(&world->steps, 0, world->kernel[i]);
    world->inner = spt_field_default();
    world->inner.batch = kernel_batch;
    world->inner.gradient = kernel_gradient;
    world->inner.user = world;
    CHECK(spt_conformal_field(&world->inner, &world->map, &world->memory, &world->field) == SPT_OK);
}

static extended as_float(double value) {
    return (extended)(float)value;
}

static void draw_kernel(mapped_world *world, int half_space) {
    solid *one = &world->kernel[world->count++];
    if (half_space) { /* an axis, so that the normal is a unit in float, too */
        const int axis = (int)(check_random() % 3);
        one->kind = SPT_REGION_HALF_SPACE;
        for (int i = 0; i < 3; ++i) one->center[i] = 0;
        one->center[axis] = check_random() % 2 == 0 ? 1 : -1;
        one->radius = as_float(-world->extent * check_uniform(0.2, 1.5));
        return;
    }
    one->kind = SPT_REGION_BALL;
    for (int i = 0; i < 3; ++i) one->center[i] = as_float(world->extent * check_uniform(-1.5, 1.5));
    one->radius = as_float(world->extent * check_uniform(0.2, 0.8));
}

void mapped_draw(mapped_world *world, int n) {
    const int balls = n % 3 == 0 ? 1 : n % 3 == 1 ? 1 + n % mapped_most : n % 2;
    world->extent = pow(10, check_uniform(-7, 7));
    chain_draw(&world->steps, 1 + n % 5, origin, world->extent);
    if (n % 2 == 0) {
        const extended middle[3] = {0, 0, 0};
        world->steps.steps[0] = chain_draw_step(CHAIN_INVERSION, middle, world->extent);
    }
    world->count = 0;
    if (n % 3 == 2) draw_kernel(world, 1);
    for (int i = 0; i < balls; ++i) draw_kernel(world, 0);
    mapped_build(world);
}

void mapped_point(const mapped_world *world, double reach, float p[3]) {
    double q[3];
    place to;
    for (int i = 0; i < 3; ++i) q[i] = world->extent * reach * check_uniform(-1, 1);
    to = chain_image(&world->steps, 0, place_of(q));
    for (int i = 0; i < 3; ++i) p[i] = (float)to.at[i];
}

place mapped_place(const float p[3]) {
    const double q[3] = {(double)p[0], (double)p[1], (double)p[2]};
    return place_of(q);
}

extended mapped_distance(const mapped_world *world, const place *p) {
    extended least = HUGE_VALL;
    for (int i = 0; i < world->count; ++i)
        least = fminl(least, solid_distance(&world->image[i], p->at));
    return least;
}

extended mapped_pole_distance(const mapped_world *world, const place *p) {
    return world->pole.infinite ? HUGE_VALL : extended_distance(world->pole.at, p->at);
}

/* Seven arrays of 16 points, aligned. */
enum { lanes = 16 };
static float *aligned(float *room, const float p[3]) {
    float *first = room + (64 - (uintptr_t)room % 64) % 64 / sizeof *room;
    for (int i = 0; i < 3 * lanes; ++i) first[i] = p[i / lanes];
    return first;
}

float mapped_value(const mapped_world *world, const float p[3]) {
    float room[8 * lanes];
    float *at = aligned(room, p);
    world->field.batch(world->field.user, lanes, at, at + lanes, at + 2 * lanes, at + 3 * lanes);
    return at[3 * lanes];
}

void mapped_gradient(const mapped_world *world, const float p[3], float gradient[3]) {
    float room[8 * lanes];
    float *at = aligned(room, p);
    world->field.gradient(world->field.user, lanes, at, at + lanes, at + 2 * lanes, at + 4 * lanes,
                          at + 5 * lanes, at + 6 * lanes);
    for (int i = 0; i < 3; ++i) gradient[i] = at[(4 + i) * lanes];
}

/* ---- What float costs ------------------------------------------------------------------------ */

static extended modulus(spt_quaternion q) {
    return sqrtl((extended)spt_quaternion_square(q));
}

/* The relative error of u = a - x c, and how far L^-1 is off, without the 32u. */
static extended relative_of_u(const mapped_world *world, const place *x, extended *preimage) {
    const spt_mobius *map = &world->map;
    const extended length = extended_length(x->at);
    const extended rows = modulus(map->a) + length * modulus(map->c);
    const extended root = sqrtl(chain_scale(&world->steps, 1, *x)); /* 1 / |u| */
    const place q = chain_image(&world->steps, 1, *x);
    *preimage = root * (modulus(map->d) * length + modulus(map->b) + extended_length(q.at) * rows);
    return root * rows;
}

extended mapped_rounding(const mapped_world *world, const place *x) {
    extended preimage, u, square, kernel;
    if (!(mapped_pole_distance(world, x) > 0)) return HUGE_VALL;
    square = 1 / chain_scale(&world->steps, 1, *x);
    u = relative_of_u(world, x, &preimage);
    if (!(32 * 0x1p-24L * u < 0.01L)) return HUGE_VALL;
    kernel = fabsl(mapped_distance(world, x)) * (1 + 2 * u);
    return 32 * 0x1p-24L * (square * preimage + kernel);
}

extended mapped_turn(const mapped_world *world, const place *x) {
    extended preimage, u = relative_of_u(world, x, &preimage), least = HUGE_VALL;
    for (int i = 0; i < world->count; ++i)
        if (world->kernel[i].kind != SPT_REGION_HALF_SPACE)
            least = fminl(least, world->kernel[i].radius);
    return 32 * 0x1p-24L * (2 * u + preimage / least + 1);
}

/* ---- Rays ------------------------------------------------------------------------------------ */

static place ray_at(const spt_ray *ray, extended t) {
    place p = mapped_place(ray->origin);
    for (int i = 0; i < 3; ++i) p.at[i] += t * (extended)ray->direction[i];
    return p;
}

/* Whether a ray from the free side crosses a boundary, where first, and how far it is from grazing:
 * `gap`, left alone where there is no such danger. */
static int crossing(const solid *one, const spt_ray *ray, extended *gap, extended *at,
                    extended *cosine) {
    const place o = mapped_place(ray->origin), d = mapped_place(ray->direction);
    const extended length = extended_length(d.at);
    extended closest, way, offset[3], t;
    if (one->kind == SPT_REGION_HALF_SPACE) {
        const extended slope = extended_dot(one->center, d.at) / length;
        *cosine = -slope;
        if (fabsl(slope) < 0.05L) *gap = 0;
        *at = -solid_distance(one, o.at) / (slope * length);
        return slope < 0;
    }
    for (int i = 0; i < 3; ++i) offset[i] = one->center[i] - o.at[i];
    t = extended_dot(offset, d.at) / (length * length);
    closest = extended_distance(ray_at(ray, t).at, one->center);
    if (one->kind == SPT_REGION_BALL && t < 0) return 0;
    *gap = fabsl(closest - one->radius);
    if (closest > one->radius) return 0;
    way = sqrtl((one->radius - closest) * (one->radius + closest));
    *cosine = way / one->radius;
    if (one->kind == SPT_REGION_OUTSIDE) *gap = one->radius * *cosine * *cosine / 10;
    *at = t + (one->kind == SPT_REGION_BALL ? -way : way) / length;
    return 1;
}

mapped_hit mapped_trace(const mapped_world *world, const spt_ray *ray, double gap) {
    const extended t_max = (extended)ray->t_max;
    mapped_hit hit = {0, 1, 0, 0};
    for (int i = 0; i < world->count; ++i) {
        extended near_by = 2 * (extended)gap, at = 0, cosine = 0;
        const int meets = crossing(&world->image[i], ray, &near_by, &at, &cosine);
        if (near_by < (extended)gap) hit.clear = 0;
        if (meets && at > t_max && at < 1.1L * t_max) hit.clear = 0;
        if (!meets || at > t_max || (hit.meets && at > hit.t)) continue;
        hit.meets = 1;
        hit.t = at;
        hit.cosine = cosine;
    }
    if (hit.meets && hit.cosine < 0.2L) hit.clear = 0;
    if (!world->pole.infinite) {
        const place o = mapped_place(ray->origin), d = mapped_place(ray->direction);
        extended way[3], t;
        for (int i = 0; i < 3; ++i) way[i] = world->pole.at[i] - o.at[i];
        t = extended_dot(way, d.at) / extended_dot(d.at, d.at);
        t = fmaxl(0, fminl(t, hit.meets ? hit.t : t_max));
        if (extended_distance(ray_at(ray, t).at, world->pole.at) < (extended)gap) hit.clear = 0;
    }
    return hit;
}

int mapped_ray(const mapped_world *world, spt_ray *ray) {
    const solid *kernel = &world->kernel[check_random() % (uint32_t)world->count];
    place to = {{0, 0, 0}, 0}, from;
    extended length, distance;
    for (int i = 0; i < 3; ++i)
        to.at[i] = (kernel->kind == SPT_REGION_HALF_SPACE ? kernel->center[i] * kernel->radius
                                                          : kernel->center[i]) +
                   (extended)(world->extent * check_uniform(-0.8, 0.8));
    to = chain_image(&world->steps, 0, to);
    mapped_point(world, 4, ray->origin);
    from = mapped_place(ray->origin);
    length = extended_distance(from.at, to.at);
    distance = mapped_distance(world, &from);
    if (!(distance > 0.01L * length) || to.infinite || !(length < 100 * (extended)world->size))
        return 0;
    if (extended_length(from.at) + extended_length(to.at) > 200 * (extended)world->size) return 0;
    for (int i = 0; i < 3; ++i)
        ray->direction[i] = (float)((to.at[i] - from.at[i]) * (extended)check_uniform(0.99, 1.01));
    ray->t_min = 0;
    ray->t_max = (float)check_uniform(2, 8);
    return 1;
}

extended mapped_slack(const mapped_world *world, const spt_settings *settings, const spt_ray *ray,
                      const mapped_hit *truth) {
    const place at = ray_at(ray, truth->t);
    const double t = (double)truth->t;
    const extended value = (extended)oracle_tolerance(settings, ray, t) +
                           mapped_rounding(world, &at) + (extended)oracle_floor(settings, ray, t);
    const extended k = value / (mapped_pole_distance(world, &at) - value);
    return 1.1L * value * (1 + k) / (1 - k) / truth->cosine / (extended)oracle_length(ray);
}
