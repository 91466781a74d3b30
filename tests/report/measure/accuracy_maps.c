/* SPDX-License-Identifier: MIT
 *
 * Möbius maps in double against elementary maps in long double: points, vectors, balls and exits
 * under products of several maps; and rays in float32 against the image of a ball. */
#include "accuracy.h"

#include "../../oracle/harness.h"
#include "../../oracle/surface_oracle.h"

#include <math.h>

static const double unit = 0x1p-53;

/* A chain, its product, and a point of the ball that it was drawn around. */
typedef struct draught {
    chain steps;
    spt_mobius map;
    double from[3];
    place image;
    extended seen; /* the largest coordinate on the way, as a length in the image's space */
} draught;

static void draw(report_random *random, int count, draught *one) {
    place at;
    double direction[3];
    accuracy_chain(random, &one->steps, count);
    one->map = chain_build(&one->steps);
    accuracy_unit(random, direction);
    for (int axis = 0; axis < 3; ++axis)
        one->from[axis] = direction[axis] * report_uniform(random, 0, 1);
    at = place_of(one->from);
    one->seen = extended_length(at.at);
    for (int i = 0; i < count; ++i) {
        chain single;
        single.count = 1;
        single.steps[0] = one->steps.steps[i];
        one->seen *= chain_scale(&single, 0, at);
        at = chain_image(&single, 0, at);
        one->seen = fmaxl(one->seen, extended_length(at.at));
    }
    one->image = at;
}

static double apart(const double a[3], const extended b[3]) {
    const place at = place_of(a);
    return (double)extended_distance(at.at, b);
}

void accuracy_maps(const report_options *options, FILE *rows) {
    const accuracy_subject points = {"map_point", "maps in one",
                                     "2^-53 of the largest coordinate on the way", ""};
    const accuracy_subject vectors = {"map_vector", "maps in one", "2^-53 radians", ""};
    accuracy_errors point[16], vector[16];
    const int count = accuracy_level_count(chain_most);
    for (int i = 0; i < count; ++i) {
        report_random random = {(uint64_t)i};
        point[i] = vector[i] = (accuracy_errors){NULL, 0, 0};
        for (size_t left = accuracy_samples(options, 8000); left > 0; --left) {
            draught one;
            double image[3], normal[3], turned[3];
            extended truth[3];
            draw(&random, accuracy_levels[i], &one);
            spt_mobius_point(&one.map, one.from, image);
            accuracy_add(&point[i], apart(image, one.image.at) / (unit * (double)one.seen));
            accuracy_unit(&random, normal);
            for (int axis = 0; axis < 3; ++axis) truth[axis] = (extended)normal[axis];
            chain_vector(&one.steps, 0, place_of(one.from), truth);
            spt_mobius_vector(&one.map, one.from, normal, turned);
            accuracy_add(&vector[i], apart(turned, truth) / unit);
        }
    }
    for (int i = 0; i < count; ++i) accuracy_write(rows, &points, accuracy_levels[i], 0, &point[i]);
    for (int i = 0; i < count; ++i)
        accuracy_write(rows, &vectors, accuracy_levels[i], 0, &vector[i]);
}

/* Balls of all sizes around the image, pulled back by the inverse: what a probe is tested by. */
void accuracy_regions(const report_options *options, FILE *rows) {
    const accuracy_subject centers = {"region_center", "maps in one",
                                      "2^-53 of the largest coordinate on the way", ""};
    const accuracy_subject radii = {"region_radius", "maps in one", "2^-53 of the radius", ""};
    accuracy_errors center[16], radius[16];
    const int count = accuracy_level_count(chain_most);
    for (int i = 0; i < count; ++i) {
        report_random random = {(uint64_t)i};
        center[i] = radius[i] = (accuracy_errors){NULL, 0, 0};
        for (size_t left = accuracy_samples(options, 8000); left > 0; --left) {
            draught one;
            spt_region ball = {SPT_REGION_BALL, {0, 0, 0}, 0}, pulled;
            draw(&random, accuracy_levels[i], &one);
            const spt_mobius back = spt_mobius_inverse(&one.map);
            const extended scale = chain_scale(&one.steps, 0, place_of(one.from));
            for (int axis = 0; axis < 3; ++axis) ball.center[axis] = (double)one.image.at[axis];
            ball.radius = (double)scale * accuracy_spread(&random, 1e-6, 0.5);
            report_expect(spt_mobius_region(&back, &ball, &pulled) == SPT_OK,
                          "a ball cannot be pulled back");
            const solid truth = chain_solid(&one.steps, 1, solid_of(&ball));
            const extended off = fabsl((extended)pulled.radius - truth.radius) / truth.radius;
            accuracy_add(&radius[i], truth.kind == (spt_region_kind)pulled.kind ? (double)off / unit
                                                                                : HUGE_VAL);
            accuracy_add(&center[i],
                         apart(pulled.center, truth.center) / (unit * (double)(one.seen / scale)));
        }
    }
    for (int i = 0; i < count; ++i)
        accuracy_write(rows, &centers, accuracy_levels[i], 0, &center[i]);
    for (int i = 0; i < count; ++i) accuracy_write(rows, &radii, accuracy_levels[i], 0, &radius[i]);
}

/* A way leaves the unbounding ball where the preimages of its ends are rho apart. */
void accuracy_exits(const report_options *options, FILE *rows) {
    const accuracy_subject subject = {"exit", "maps in one", "2^-53 of the ball's radius", ""};
    for (int i = 0; i < accuracy_level_count(chain_most); ++i) {
        report_random random = {(uint64_t)i};
        accuracy_errors errors = {NULL, 0, 0};
        const size_t samples = accuracy_samples(options, 8000);
        while (errors.count < samples) {
            draught one;
            double at[3], way[3];
            draw(&random, accuracy_levels[i], &one);
            for (int axis = 0; axis < 3; ++axis) at[axis] = (double)one.image.at[axis];
            accuracy_unit(&random, way);
            const double rho = accuracy_spread(&random, 1e-4, 1);
            const double exit = spt_mobius_exit(&one.map, at, way, rho);
            const place from = place_of(at);
            place to = from;
            if (isinf(exit)) continue; /* never leaves it */
            for (int axis = 0; axis < 3; ++axis)
                to.at[axis] += (extended)exit * (extended)way[axis];
            const extended length = (extended)exit * extended_length(place_of(way).at);
            const extended ratio = chain_apart(&one.steps, 1, from, to, length) / (extended)rho;
            accuracy_add(&errors, (double)fabsl(ratio - 1) / unit);
        }
        accuracy_write(rows, &subject, accuracy_levels[i], 0, &errors);
    }
}

/* ---- Rays in float32 ------------------------------------------------------------------------- */

typedef struct seen_ball {
    double radius;
} seen_ball;

static float ball_distance(void *user, float x, float y, float z) {
    const double p[3] = {(double)x, (double)y, (double)z};
    return (float)(surface_length(p) - ((const seen_ball *)user)->radius);
}

/* A ray from outside the image of the ball towards its inner half. */
static spt_ray aim(report_random *random, const solid *image) {
    double from[3], target[3], out[3];
    const double size = (double)image->radius;
    accuracy_unit(random, out);
    for (int axis = 0; axis < 3; ++axis) {
        const double center = (double)image->center[axis];
        from[axis] = center + size * report_uniform(random, 1.5, 4) * out[axis];
        target[axis] = center + size * report_uniform(random, -0.4, 0.4);
    }
    return surface_aim(from, target, 1, 10 * size);
}

/* The most that a hit may be off the image: f is below the tolerance there, and at least
 * (1 - k) / (1 + k) of the distance, k = f / (d - f), d the distance from the pole; positions
 * resolve the floor. */
static double allowed(const chain *steps, const spt_settings *settings, const spt_ray *ray,
                      double t, const place *at) {
    const place pole = chain_image(steps, 0, place_infinite());
    const double tolerance = oracle_tolerance(settings, ray, t);
    double k = 0;
    if (!pole.infinite) k = tolerance / ((double)extended_distance(pole.at, at->at) - tolerance);
    return tolerance * (1 + k) / (1 - k) + oracle_floor(settings, ray, t);
}

/* With a tolerance of a ten thousandth of the image's radius. Maps that the library refuses, since
 * float32 cannot hold their product, are left out. */
void accuracy_conformal(const report_options *options, FILE *rows) {
    const accuracy_subject subject = {
        "conformal_hit", "maps in one", "of what tolerance and floor allow",
        "mobius.h: a lower bound that tends to the distance; trace.h: |f| < tolerance at a hit"};
    for (int i = 0; i < accuracy_level_count(chain_most); ++i) {
        report_random random = {(uint64_t)i};
        accuracy_errors errors = {NULL, 0, 0};
        for (size_t left = accuracy_samples(options, 4000); left > 0; --left) {
            chain steps;
            seen_ball ball = {1};
            spt_conformal memory;
            spt_field inner = spt_field_default(), field;
            const spt_region region = {SPT_REGION_BALL, {0, 0, 0}, 1};
            spt_settings settings = spt_settings_default();
            spt_hit hit;
            accuracy_chain(&random, &steps, accuracy_levels[i]);
            const spt_mobius map = chain_build(&steps);
            const solid image = chain_solid(&steps, 0, solid_of(&region));
            inner.point = ball_distance;
            inner.user = &ball;
            if (spt_conformal_field(&inner, &map, &memory, &field) != SPT_OK) continue;
            const spt_ray ray = aim(&random, &image);
            settings.epsilon = (float)(1e-4 * (double)image.radius);
            const spt_rays rays = spt_rays_of(&ray);
            const spt_hits hits = spt_hits_of(&hit);
            report_expect(spt_conformal_trace(&memory, &settings, 1, &rays, &hits, NULL) == SPT_OK,
                          "conformal tracing refuses its arguments");
            double p[3];
            surface_point(&ray, (double)hit.t, p);
            const place at = place_of(p);
            const double off = (double)fabsl(solid_distance(&image, at.at));
            accuracy_add(&errors, hit.outcome == SPT_HIT
                                      ? off / allowed(&steps, &settings, &ray, (double)hit.t, &at)
                                      : HUGE_VAL);
        }
        /* Of one map: products round by their entries besides, as the header says. */
        const double promised = accuracy_levels[i] > 1 ? 0 : 1;
        if (errors.count > 0) accuracy_write(rows, &subject, accuracy_levels[i], promised, &errors);
    }
}
