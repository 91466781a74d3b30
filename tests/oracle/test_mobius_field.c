/* SPDX-License-Identifier: MIT
 *
 * spt_conformal_field() against the exact distance to the images of balls and half spaces: never
 * above it, its sign, its slope, how it tends to it, its gradient and its bound. Traced in
 * test_mobius_trace.c. */
#include "../check.h"
#include "mobius_world.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { worlds = 120, points = 60 };

/* Points near and far, on both sides. */
static place draw_point(const mapped_world *world, int n, float p[3]) {
    static const double reaches[] = {1, 2, 8, 100};
    mapped_point(world, reaches[n % 4], p);
    return mapped_place(p);
}

/* Not above the distance, on either side; the sign; and with k = f / (d - f), d the distance from
 * the pole, the kernel's ball reaches the surface within (1 + k) / (1 - k) f: its preimage's
 * nearest surface point s is at kappa, |L(s) - x| <= kappa U / (1 - kappa / |q - Q|), and kappa /
 * |q - Q| = k, f = kappa U / (1 + k). Inside only of one kernel: of several the inner field itself
 * is not exact there. */
static void bounds_the_distance(void) {
    int compared = 0, near_by = 0;
    for (int n = 0; n < worlds; ++n) {
        mapped_world world;
        mapped_draw(&world, n);
        check_context("world %d, %d steps, %d kernels", n, world.steps.count, world.count);
        CHECK(!(fabs((double)world.field.lipschitz - 1) > 0));
        CHECK(world.field.gradient != NULL && world.field.batch != NULL);
        for (int i = 0; i < points; ++i) {
            float p[3], value;
            const place x = draw_point(&world, i, p);
            const extended distance = mapped_distance(&world, &x);
            const extended rounding = mapped_rounding(&world, &x);
            extended size, k;
            if (!(rounding < HUGE_VALL)) continue;
            if (distance < 0 && world.count > 1) continue;
            value = mapped_value(&world, p);
            size = fabsl((extended)value);
            ++compared;
            CHECK_SAY(size <= fabsl(distance) + rounding, "%Lg of %Lg, rounding %Lg", size,
                      distance, rounding);
            CHECK_SAY(fabsl(distance) <= rounding || (distance < 0) == (value < 0), "%g for %Lg",
                      (double)value, distance);
            k = size / (mapped_pole_distance(&world, &x) - size);
            if (!(k >= 0 && k < 0.9L)) continue;
            CHECK_SAY(size * (1 + k) / (1 - k) + rounding * (1 + k) / (1 - k) >= fabsl(distance),
                      "%Lg of %Lg, k %Lg", size, distance, k);
            near_by += k < 0.1L;
        }
    }
    CHECK_SAY(compared > worlds * points / 2 && near_by > compared / 10, "%d compared, %d near",
              compared, near_by);
}

/* On pairs at all distances. */
static void changes_by_one(void) {
    int steep = 0, compared = 0;
    for (int n = 0; n < worlds; ++n) {
        mapped_world world;
        mapped_draw(&world, n);
        check_context("world %d, %d steps, %d kernels", n, world.steps.count, world.count);
        for (int i = 0; i < points; ++i) {
            float p[3], q[3], one, other;
            const place x = draw_point(&world, i, p);
            const double step = world.size * pow(10, check_uniform(-3, 2));
            place y;
            extended apart, rounding, change;
            for (int k = 0; k < 3; ++k) q[k] = (float)((double)p[k] + step * check_uniform(-1, 1));
            y = mapped_place(q);
            rounding = mapped_rounding(&world, &x) + mapped_rounding(&world, &y);
            if (!(rounding < HUGE_VALL)) continue;
            apart = extended_distance(x.at, y.at);
            one = mapped_value(&world, p);
            other = mapped_value(&world, q);
            change = fabsl((extended)one - (extended)other);
            CHECK_SAY(change <= apart * 1.00001L + rounding, "%Lg over %Lg, rounding %Lg", change,
                      apart, rounding);
            ++compared;
            steep += change > 0.5L * apart;
        }
    }
    CHECK_SAY(compared > worlds * points / 2 && steep > compared / 20, "%d compared, %d steep",
              compared, steep);
}

/* Points of an image's boundary, by the image of one of its kernel's. */
static place surface_point(const mapped_world *world, int which) {
    const solid *kernel = &world->kernel[which];
    place q = {{0, 0, 0}, 0};
    extended v[3], length;
    for (int i = 0; i < 3; ++i) v[i] = (extended)check_uniform(-1, 1);
    if (kernel->kind == SPT_REGION_HALF_SPACE) {
        const extended off = extended_dot(v, kernel->center);
        for (int i = 0; i < 3; ++i)
            q.at[i] = kernel->center[i] * kernel->radius +
                      2 * (extended)world->extent * (v[i] - off * kernel->center[i]);
    } else {
        length = extended_length(v);
        for (int i = 0; i < 3; ++i) q.at[i] = kernel->center[i] + v[i] * (kernel->radius / length);
    }
    return chain_image(&world->steps, 0, q);
}

/* The exact normal is that of the image, a sphere or plane; a point in float lies beside the
 * boundary by its rounding, which turns the normal by that over the radius. */
static void gradient_is_the_normal(void) {
    int compared = 0;
    for (int n = 0; n < worlds; ++n) {
        mapped_world world;
        mapped_draw(&world, n);
        check_context("world %d, %d steps, %d kernels", n, world.steps.count, world.count);
        for (int i = 0; i < 24; ++i) {
            const int which = i % world.count;
            const solid *image = &world.image[which];
            place x = surface_point(&world, which);
            extended normal[3], seen[3], length, turn;
            float p[3], gradient[3];
            int alone = 1;
            for (int k = 0; k < 3; ++k) p[k] = (float)x.at[k];
            x = mapped_place(p);
            /* Where kernels meet or cover one another another one may answer. */
            for (int k = 0; k < world.count; ++k)
                if (k != which &&
                    !(solid_distance(&world.image[k], x.at) > 0.01L * (extended)world.size))
                    alone = 0;
            turn = mapped_turn(&world, &x);
            if (!alone || !(turn < 0.05L)) continue;
            mapped_gradient(&world, p, gradient);
            for (int k = 0; k < 3; ++k) {
                normal[k] = image->center[k];
                if (image->kind != SPT_REGION_HALF_SPACE)
                    normal[k] = (x.at[k] - normal[k]) * (image->kind == SPT_REGION_BALL ? 1 : -1);
                seen[k] = (extended)gradient[k];
            }
            length = extended_length(normal);
            if (image->kind != SPT_REGION_HALF_SPACE)
                turn += 0x1p-23L * extended_length(x.at) / image->radius;
            for (int k = 0; k < 3; ++k) normal[k] /= length;
            length = extended_length(seen);
            CHECK_SAY(length > 0 && length < HUGE_VALL, "length %Lg", length);
            for (int k = 0; k < 3; ++k) seen[k] /= length;
            CHECK_SAY(extended_distance(seen, normal) <= turn, "off by %Lg of %Lg",
                      extended_distance(seen, normal), turn);
            ++compared;
        }
    }
    CHECK_SAY(compared > worlds * 10, "%d compared", compared);
}

/* ---- Bounds ---------------------------------------------------------------------------------- */

/* Of an inner field with a ball or box around the kernels. The image's bound contains the images,
 * or is dropped where the image of the inner bound has no end. */
static void bound_is_mapped(void) {
    int mapped = 0, dropped = 0;
    for (int n = 0; n < worlds; ++n) {
        mapped_world world;
        spt_field inner;
        spt_bound bound;
        const float reach = 3.0f;
        float extent;
        solid around = {SPT_REGION_BALL, {0, 0, 0}, 0}, image;
        mapped_draw(&world, n - n % 3);
        extent = (float)world.extent * reach;
        inner = world.inner;
        bound = n % 2 == 0 ? spt_bound_sphere(0, 0, 0, extent)
                           : spt_bound_box(-extent, -extent, -extent, extent, extent, extent);
        inner.bound = &bound;
        check_context("world %d, bound %u", n, bound.kind);
        CHECK(spt_conformal_field(&inner, &world.map, &world.memory, &world.field) == SPT_OK);
        /* A ball in the bound whose image has no end: neither has the bound's. */
        around.radius = (extended)extent;
        image = chain_solid(&world.steps, 0, around);
        if (world.field.bound == NULL) {
            /* The box's own ball may hold the pole where the box does not. */
            around.radius *= n % 2 == 0 ? 1 : 1.7321L;
            image = chain_solid(&world.steps, 0, around);
            ++dropped;
            CHECK_SAY(image.kind != SPT_REGION_BALL, "dropped with radius %Lg", image.radius);
            continue;
        }
        ++mapped;
        CHECK_SAY(image.kind == SPT_REGION_BALL, "kept");
        CHECK(world.field.bound->kind == SPT_BOUND_SPHERE);
        for (int i = 0; i < 40; ++i) {
            const place x = surface_point(&world, 0);
            const place center = mapped_place(world.field.bound->center);
            const extended over =
                extended_distance(x.at, center.at) - (extended)world.field.bound->radius;
            CHECK_SAY(over <= 0, "a point of the body is out by %Lg of radius %g", over,
                      (double)world.field.bound->radius);
        }
    }
    CHECK_SAY(mapped > 20 && dropped > 20, "%d mapped, %d dropped", mapped, dropped);
}

/* ---- Other inner fields ---------------------------------------------------------------------- */

static float point_of_batch(void *user, float x, float y, float z) {
    const mapped_world *world = user;
    float room[4 * 16 + 16];
    float *first = room + (64 - (uintptr_t)room % 64) % 64 / sizeof *room;
    for (int i = 0; i < 16; ++i) {
        first[i] = x;
        first[16 + i] = y;
        first[32 + i] = z;
    }
    world->inner.batch(world->inner.user, 16, first, first + 16, first + 32, first + 48);
    return first[48];
}

static float twice(void *user, float x, float y, float z) {
    return 2 * point_of_batch(user, x, y, z);
}

/* The same body by the callback for one point, and twice the distance with lipschitz 2: the same
 * bits. */
static void other_callbacks(void) {
    for (int n = 0; n < 12; ++n) {
        mapped_world world;
        mapped_draw(&world, n);
        for (int i = 0; i < points; ++i) {
            float p[3], value[3];
            (void)draw_point(&world, i, p);
            for (int form = 0; form < 3; ++form) {
                spt_field inner = world.inner;
                if (form > 0) inner.batch = NULL;
                if (form > 0) inner.point = form == 1 ? point_of_batch : twice;
                if (form == 2) inner.lipschitz = 2;
                CHECK(spt_conformal_field(&inner, &world.map, &world.memory, &world.field) ==
                      SPT_OK);
                value[form] = mapped_value(&world, p);
            }
            CHECK_SAY(check_same_bits(value[0], value[1]), "%g by batch, %g by point",
                      (double)value[0], (double)value[1]);
            CHECK_SAY(check_same_bits(value[0], value[2]), "%g with 1, %g with 2", (double)value[0],
                      (double)value[2]);
        }
    }
}

static float constant_value(void *user, float x, float y, float z) {
    (void)x, (void)y, (void)z;
    return *(const float *)user;
}

/* +infinity is no surface anywhere, and comes out as a value above zero; NaN as NaN. */
static void values_that_are_no_numbers(void) {
    float values[] = {INFINITY, NAN, FLT_MAX, 0};
    for (int n = 0; n < 24; ++n) {
        mapped_world world;
        const float constant = values[n % 4];
        mapped_draw(&world, n);
        world.inner.batch = NULL;
        world.inner.point = constant_value;
        world.inner.user = &values[n % 4];
        CHECK(spt_conformal_field(&world.inner, &world.map, &world.memory, &world.field) == SPT_OK);
        check_context("world %d, %g", n, (double)constant);
        for (int i = 0; i < 20; ++i) {
            float p[3], value;
            (void)draw_point(&world, i, p);
            value = mapped_value(&world, p);
            if (n % 4 == 1) CHECK(isnan(value));
            if (n % 4 == 0 || n % 4 == 2) CHECK_SAY(value > 0, "%g", (double)value);
            if (n % 4 == 3) CHECK_SAY(!(fabs((double)value) > 0), "%g", (double)value);
        }
    }
}

/* ---- What is refused ------------------------------------------------------------------------- */

static void fields_refused(void) {
    static const double far[3] = {1e39, 0, 0};
    mapped_world world;
    spt_field bad, result;
    spt_field before;
    spt_conformal memory;
    spt_mobius map;
    mapped_draw(&world, 0);
    memset(&result, 0x5a, sizeof result);
    memset(&memory, 0x5a, sizeof memory);
    before = result;
    map = world.map;
    CHECK(spt_conformal_field(NULL, &map, &memory, &result) == SPT_BAD_ARGUMENT);
    CHECK(spt_conformal_field(&world.inner, NULL, &memory, &result) == SPT_BAD_ARGUMENT);
    CHECK(spt_conformal_field(&world.inner, &map, NULL, &result) == SPT_BAD_ARGUMENT);
    CHECK(spt_conformal_field(&world.inner, &map, &memory, NULL) == SPT_BAD_ARGUMENT);
    bad = world.inner;
    bad.batch = NULL;
    CHECK(spt_conformal_field(&bad, &map, &memory, &result) == SPT_BAD_ARGUMENT);
    bad = world.inner;
    bad.lipschitz = 0;
    CHECK(spt_conformal_field(&bad, &map, &memory, &result) == SPT_BAD_ARGUMENT);
    bad = world.inner;
    bad.flags = 0x80000000u;
    CHECK(spt_conformal_field(&bad, &map, &memory, &result) == SPT_BAD_ARGUMENT);
    bad = world.inner;
    bad.struct_size = 8;
    CHECK(spt_conformal_field(&bad, &map, &memory, &result) == SPT_BAD_ARGUMENT);
    CHECK(spt_mobius_translation(far, &map) == SPT_OK);
    CHECK(spt_conformal_field(&world.inner, &map, &memory, &result) == SPT_BAD_ARGUMENT);
    map = world.map;
    map.a.y = (double)NAN;
    CHECK(spt_conformal_field(&world.inner, &map, &memory, &result) == SPT_BAD_ARGUMENT);
    CHECK(memcmp(&result, &before, sizeof result) == 0);
    for (size_t i = 0; i < sizeof memory; ++i) CHECK(((unsigned char *)&memory)[i] == 0x5a);
    bad = world.inner;
    bad.gradient = NULL;
    CHECK(spt_conformal_field(&bad, &world.map, &memory, &result) == SPT_OK);
    CHECK(result.gradient == NULL);
}

void suite_mobius_field(void) {
    RUN(bounds_the_distance);
    RUN(changes_by_one);
    RUN(gradient_is_the_normal);
    RUN(bound_is_mapped);
    RUN(other_callbacks);
    RUN(values_that_are_no_numbers);
    RUN(fields_refused);
}
