/* SPDX-License-Identifier: MIT
 *
 * Normals blended near mirrors (Szécsi et al. 2016, section 8.1): continuous across them, the plain
 * ones farther away, as wide as `smooth` or a pixel, and what the formula gives in double between. */
#include "krs_fold.h"
#include "krs_places.h"
#include "../check.h"

#include <math.h>

static float points[krs_most_points][3];
static krs_place plain[krs_most_points], places[krs_most_points];
static krs_drawn sample;
static krs_folded folded;
static spt_krs krs, smooth_krs;

static void build(double smooth) {
    spt_krs_model model = krs_model_of(&sample);
    CHECK(spt_krs_build(&model, &krs) == SPT_OK);
    model.smooth = (float)smooth;
    CHECK(spt_krs_build(&model, &smooth_krs) == SPT_OK);
    CHECK(check_same_bits(smooth_krs.smooth, model.smooth));
}

static void locate_both(float pixel_radius, float path, size_t count) {
    krs_locate_points(&krs, 0, 0, count, (const float(*)[3])points, plain);
    krs_locate_points(&smooth_krs, pixel_radius, path, count, (const float(*)[3])points, places);
}

/* The point onto mirror i of the way to the kernel it now sees, as the world sees that mirror. */
static void put_on_mirror(uint32_t i, float p[3], double beside) {
    double at[3];
    krs_widen(p, at);
    krs_fold(sample.levels, sample.kernels, sample.mirrors, at, &folded);
    double foot[3];
    for (int axis = 0; axis < 3; ++axis)
        foot[axis] = folded.at[i + 1][axis] - (folded.beyond[i] - beside) * folded.normal[i][axis];
    for (uint32_t j = i + 1; j < sample.levels; ++j) { /* back out */
        if (!(folded.beyond[j] > 0)) continue;
        const double beyond =
            surface_dot(folded.normal[j], foot) - (double)sample.mirrors[j].offset;
        for (int axis = 0; axis < 3; ++axis) foot[axis] -= 2 * beyond * folded.normal[j][axis];
    }
    for (int axis = 0; axis < 3; ++axis) p[axis] = (float)foot[axis];
}

/* What rounding may turn a normal by: the point and the nearest one are off, which turns the gradient
 * by at most 2 sqrt(3) times as much as such a step along the worst of the axes does. Blending may
 * shorten the gradient before it is made of length 1, which lengthens all errors. */
static double allowed_turn(const float point[3], double width, double length) {
    const krs_body body = krs_body_of(&sample.kernels[folded.kernel]);
    double p[3], here[3], there[3], turned = 0;
    krs_widen(point, p);
    const double rounding = krs_rounding(sample.levels, sample.mirrors, p);
    krs_body_gradient(&body, folded.at[folded.kernel], here);
    if (fabs(surface_length(here) - 1) > 1e-4) return HUGE_VAL; /* turns within the differences */
    for (int i = 0; i < 6; ++i) {
        double at[3];
        for (int axis = 0; axis < 3; ++axis) at[axis] = folded.at[folded.kernel][axis];
        at[i / 2] += i % 2 != 0 ? rounding : -rounding;
        krs_body_gradient(&body, at, there);
        turned = fmax(turned, surface_angle(here, there));
    }
    /* smoothstep's slope is at most 3 / (4 width), a share turns the gradient by at most 2 of it */
    const double blended = width > 0 ? 1.5 * rounding / width * sample.levels : 0;
    return (3.5 * turned + blended + ldexp(64, -24)) / length;
}

/* Against the formula in double, over points about mirrors and elsewhere. */
static int check_formula(double width, size_t count) {
    int blended = 0;
    for (size_t i = 0; i < count; ++i) {
        double p[3], wanted[3], found[3], before[3];
        krs_widen(points[i], p);
        krs_fold(sample.levels, sample.kernels, sample.mirrors, p, &folded);
        if (places[i].kernel != (int32_t)folded.kernel) continue; /* too near two kernels */
        const double length =
            krs_fold_normal(&folded, sample.levels, sample.kernels, width, wanted);
        const double allowed = allowed_turn(points[i], width, length);
        if (length < 0.01 || allowed > 0.02) continue; /* the normal is nearly undecided there */
        krs_widen(places[i].normal, found);
        krs_widen(plain[i].normal, before);
        CHECK_SAY(surface_angle(found, wanted) <= allowed, "off by %g, allowed %g, width %g",
                  surface_angle(found, wanted), allowed, width);
        CHECK(fabs(surface_length(found) - 1) < 1e-6);
        if (folded.nearest_mirror > width + krs_rounding(sample.levels, sample.mirrors, p)) {
            CHECK_SAY(surface_angle(found, before) <= 1e-6, "far away, off by %g",
                      surface_angle(found, before));
        } else if (folded.nearest_mirror < 0.9 * width) {
            blended += surface_angle(found, before) > 0.01;
        }
        for (int axis = 0; axis < 3; ++axis) { /* the kernel's own is not blended */
            CHECK(check_same_bits(places[i].kernel_normal[axis], plain[i].kernel_normal[axis]));
            CHECK(check_same_bits(places[i].point[axis], plain[i].point[axis]));
        }
    }
    return blended;
}

static void draw_about_mirrors(double width, size_t count) {
    krs_draw_points(&sample, count, points);
    for (size_t i = 0; i < count; ++i) {
        const uint32_t mirror = check_random() % sample.levels;
        if (i % 4 != 0) put_on_mirror(mirror, points[i], check_uniform(-1.5, 1.5) * width);
    }
}

static void krs_normals_blended(void) {
    for (uint32_t levels = 1; levels <= 6; ++levels) {
        const double widths[] = {0.01, 0.1, 0.5};
        int blended = 0;
        for (int i = 0; i < 6; ++i) {
            const double width = widths[i % 3];
            check_context("%u levels, width %g", levels, width);
            krs_draw(&sample, levels, KRS_SOLID, i % 2 != 0 ? 0.7 : 0);
            build(width);
            draw_about_mirrors(width, 60);
            locate_both(0, 0, 60);
            blended += check_formula((double)(float)width, 60);
        }
        CHECK_SAY(blended > 20, "%d", blended);
    }
}

/* On both sides of a mirror, nearer and nearer: the plain normals keep their difference, the
 * blended ones lose it with the distance. */
static void krs_normals_continuous(void) {
    double worst = 0, jump = 0;
    for (int draw = 0; draw < 60; ++draw) {
        const uint32_t levels = 1 + (uint32_t)draw % 5, mirror = check_random() % levels;
        krs_draw(&sample, levels, KRS_SPHERES, 0.7);
        build(0.25);
        krs_draw_points(&sample, 1, points);
        const float start[3] = {points[0][0], points[0][1], points[0][2]};
        for (int side = 0; side < 2; ++side) {
            for (int step = 0; step < 4; ++step) {
                float *const p = points[2 * step + side];
                for (int axis = 0; axis < 3; ++axis) p[axis] = start[axis];
                put_on_mirror(mirror, p, (side != 0 ? 1 : -1) * pow(10, -step - 1));
            }
        }
        locate_both(0, 0, 8);
        for (int step = 0; step < 4; ++step) {
            double a[3], b[3];
            const krs_place *const one = &places[2 * step], *const other = one + 1;
            double p[3];
            krs_widen(points[2 * step], p);
            krs_fold(levels, sample.kernels, sample.mirrors, p, &folded);
            /* The same kernel through the same other mirrors; and not the undecided normal. */
            if (one->kernel != other->kernel || one->kernel > (int32_t)mirror ||
                (one->mirrors ^ other->mirrors) != UINT64_C(1) << mirror ||
                krs_fold_normal(&folded, levels, sample.kernels, 0.25, a) < 0.3)
                continue;
            krs_widen(one->normal, a);
            krs_widen(other->normal, b);
            /* The gradient itself turns by the way over the distance from the ball's middle, each
             * share by 3 / (4 width) of the way, and the whole is made longer by up to 1 / 0.3. */
            const double way = 2 * pow(10, -step - 1);
            const krs_body body = krs_body_of(&sample.kernels[folded.kernel]);
            const double from_middle =
                krs_body_distance(&body, folded.at[folded.kernel]) + body.radius;
            if (from_middle < 0.1 || step == 0) continue;
            const double most = (2 * way / from_middle + levels * 1.5 * way / 0.25) / 0.3 + 1e-4;
            CHECK_SAY(surface_angle(a, b) <= most, "%g apart: %g, allowed %g", way,
                      surface_angle(a, b), most);
            if (step < 3) continue;
            worst = fmax(worst, surface_angle(a, b));
            krs_widen(plain[2 * step].normal, a);
            krs_widen(plain[2 * step + 1].normal, b);
            jump = fmax(jump, surface_angle(a, b));
        }
    }
    CHECK_SAY(worst < 0.05 && jump > 0.3, "blended %g, plain %g", worst, jump);
}

/* Either makes the width: `smooth`, or half a pixel at the way travelled; the larger counts. */
static void krs_normals_minified(void) {
    int blended = 0;
    for (int draw = 0; draw < 16; ++draw) {
        const double smooth = draw % 2 != 0 ? 0.01 : 0;
        const float pixel_radius = 0.002f, path = draw % 4 < 2 ? 100 : 2;
        const double width = fmax(smooth, (double)pixel_radius * (double)path);
        check_context("smooth %g, path %g", smooth, (double)path);
        krs_draw(&sample, 1 + (uint32_t)draw % 4, KRS_SOLID, 0.5);
        build(smooth);
        draw_about_mirrors(width, 60);
        locate_both(pixel_radius, path, 60);
        blended += check_formula(width, 60);
    }
    CHECK_SAY(blended > 100, "%d", blended);
}

/* The width counts t |direction| as well, and the same place has the same normal however the ray
 * came there, if the way is as long. */
static void krs_normals_by_the_way(void) {
    krs_draw(&sample, 3, KRS_SOLID, 0.5);
    build(0);
    draw_about_mirrors(0.3, 60);
    for (int i = 0; i < 60; ++i) {
        for (int axis = 0; axis < 3; ++axis) /* so that o + t d is exact */
            points[i][axis] = ldexpf(rintf(ldexpf(points[i][axis], 12)), -12);
    }
    krs_locate_points(&krs, 0.02f, 15, 60, (const float(*)[3])points, plain);
    for (int i = 0; i < 60; ++i) {
        const float t = 4, path = 3; /* and |direction| = 3 */
        const spt_ray ray = {
            {points[i][0] - 4, points[i][1] + 8, points[i][2] - 8}, 0, {1, -2, 2}, 9};
        const spt_krs_places view = krs_places_of(&places[i]);
        spt_settings settings = spt_settings_default();
        spt_rays rays = spt_rays_of(&ray);
        spt_hits hits = {0};
        float at = t;
        settings.pixel_radius = 0.02f;
        rays.path.first = &path;
        hits.t.first = &at;
        CHECK(spt_krs_locate(&krs, 0, &settings, 1, &rays, &hits, &view) == SPT_OK);
        CHECK(places[i].kernel == plain[i].kernel && places[i].mirrors == plain[i].mirrors);
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(check_same_bits(places[i].point[axis], plain[i].point[axis]));
            /* the width may be rounded another way; shares are continuous in it */
            CHECK_SAY(fabs((double)places[i].normal[axis] - (double)plain[i].normal[axis]) < 1e-4,
                      "%g, %g", (double)places[i].normal[axis], (double)plain[i].normal[axis]);
        }
    }
}

void suite_krs_normals(void) {
    RUN(krs_normals_blended);
    RUN(krs_normals_continuous);
    RUN(krs_normals_minified);
    RUN(krs_normals_by_the_way);
}
