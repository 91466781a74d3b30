/* SPDX-License-Identifier: MIT
 *
 * The shared scenes against answers found in other ways: nearest points, corners, the fractal with
 * angles; and the rays of their cameras. What holds for every scene is in test_scenes.c. */
#include "../check.h"

#include "scenes/scene_boxes.h"
#include "scenes/scene_mandelbulb.h"
#include "scenes/scenes.h"
#include "test_scenes.h"

#include <math.h>
#include <string.h>

static const double unit_roundoff = 5.9604644775390625e-8; /* 2^-24 */

/* A random point of [-reach, reach]^3, its coordinates floats. */
static void draw(double reach, double point[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        point[axis] = (double)(float)check_uniform(-reach, reach);
    }
}

/* The distance to a box by its nearest point, and from inside by its nearest face. */
static double box_oracle(const placed_box *box, const double p[3]) {
    const double center[3] = {(double)box->center.x, (double)box->center.y, (double)box->center.z};
    const double half[3] = {(double)box->half.x, (double)box->half.y, (double)box->half.z};
    double nearest[3], face = HUGE_VAL;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = center[axis] - half[axis], high = center[axis] + half[axis];
        nearest[axis] = fmin(fmax(p[axis], low), high);
        face = fmin(face, fmin(p[axis] - low, high - p[axis]));
    }
    return face > 0 ? -face : apart(p, nearest);
}

static double boxes_oracle(const placed_box *boxes, int count, const double p[3]) {
    double least = HUGE_VAL;
    for (int i = 0; i < count; ++i) least = fmin(least, box_oracle(&boxes[i], p));
    return least;
}

static double torus_oracle(const double p[3]) {
    const double r = sqrt(p[0] * p[0] + p[2] * p[2]);
    const double nearest[3] = {p[0] / r, 0, p[2] / r};
    return apart(p, nearest) - (double)0.05f;
}

static void scenes_known_distances(void) {
    static const placed_box box = {{0, 0, 0}, {1, 0.7f, 0.85f}};
    const double origin[3] = {0, 0, 0};
    double p[3];
    for (int i = 0; i < 2000; ++i) {
        draw(2, p);
        CHECK(fabs(reference_at(scene_named("sphere"), p) - (apart(p, origin) - 1)) < 1e-14);
        CHECK(fabs(reference_at(scene_named("box"), p) - box_oracle(&box, p)) < 1e-14);
        CHECK(fabs(reference_at(scene_named("thin_torus"), p) - torus_oracle(p)) < 1e-14);
        CHECK(fabs(reference_at(scene_named("slabs"), p) - boxes_oracle(slab_boxes, SLABS, p)) <
              1e-14);
        draw(6, p);
        CHECK(fabs(reference_at(scene_named("village_boxes"), p) -
                   boxes_oracle(town_boxes, TOWN_BOXES, p)) < 1e-14);
    }
}

/* The fractal as it is usually written, with angles. */
static double mandelbulb_oracle(const double p[3], int *iterations) {
    double x = p[0], y = p[1], z = p[2], derivative = 1;
    double squared = x * x + y * y + z * z;
    for (*iterations = 0; *iterations < MANDELBULB_ITERATIONS; ++*iterations) {
        const double r = sqrt(squared), polar = 8 * acos(y / r), around = 8 * atan2(x, z);
        if (squared > (double)MANDELBULB_ESCAPE) break;
        derivative = 8 * pow(r, 7) * derivative + 1;
        x = p[0] + pow(r, 8) * sin(polar) * sin(around);
        y = p[1] + pow(r, 8) * cos(polar);
        z = p[2] + pow(r, 8) * sin(polar) * cos(around);
        squared = x * x + y * y + z * z;
    }
    return 0.5 * log(sqrt(squared)) * sqrt(squared) / derivative;
}

/* An iteration multiplies a relative error by 8 and adds some 50 roundings (each of three squarings
 * doubles what it gets), the sum with p a few times that where |q^8| is not much more than |p|. So
 * up to 1000 roundings after two iterations and 16000 after three. */
static void scenes_mandelbulb_without_angles(void) {
    const scene *const shown = scene_named("mandelbulb");
    int compared = 0, inside = 0;
    for (int i = 0; i < 20000; ++i) {
        double p[3];
        int iterations;
        draw(1.2, p);
        const double oracle = mandelbulb_oracle(p, &iterations);
        inside += oracle < 0;
        if (!(fabs(oracle) > 1e-4) || iterations > 3) continue;
        ++compared;
        const double double_roundoff = unit_roundoff / 536870912; /* 2^-53 */
        const double error = fabs(reference_at(shown, p) - oracle);
        CHECK_SAY(error <= 16000 * double_roundoff * fabs(oracle), "%.17g, not %.17g",
                  reference_at(shown, p), oracle);
        if (iterations > 2) continue;
        const double seen = (double)shown->point(NULL, (float)p[0], (float)p[1], (float)p[2]);
        CHECK_SAY(fabs(seen - oracle) <= 1000 * unit_roundoff * fabs(oracle), "%.9g, not %.9g",
                  seen, oracle);
    }
    CHECK_SAY(compared > 5000 && inside > 1000, "%d compared, %d inside", compared, inside);
}

/* The axis and the middle are no exceptions. */
static void scenes_mandelbulb_on_its_axis(void) {
    const scene *const shown = scene_named("mandelbulb");
    for (int i = -20; i <= 20; ++i) {
        const float y = 0.0625f * (float)i;
        CHECK(isfinite(shown->point(NULL, 0, y, 0)));
        CHECK(isfinite(shown->point(NULL, 1e-20f, y, -1e-30f)));
    }
    CHECK(fabsf(shown->point(NULL, 0, 0, 0)) < 1e-10f);
}

/* Corners of the dodecahedron whose faces are at distance 1: (1, 1, 1), (0, phi, 1/phi) and so on
 * with all signs, times what brings the first onto the plane of the face (1, phi, 0)/|..|. */
static void scenes_dodecahedron_corners(void) {
    const double phi = (1 + sqrt(5)) / 2, scale = sqrt(1 + phi * phi) / (1 + phi);
    const double corners[4][3] = {
        {1, 1, 1}, {0, phi, 1 / phi}, {1 / phi, 0, phi}, {phi, 1 / phi, 0}};
    for (int kind = 0; kind < 4; ++kind) {
        for (int signs = 0; signs < 8; ++signs) {
            double p[3];
            for (int axis = 0; axis < 3; ++axis) {
                p[axis] = (signs >> axis & 1 ? -scale : scale) * corners[kind][axis];
            }
            /* two products with rounded normals of up to 1.26 each */
            CHECK(fabs(reference_at(scene_named("dodecahedron"), p)) < 4 * unit_roundoff);
        }
    }
}

/* The generalised distance by pow(), with normals to full precision. */
static void scenes_dodecahedron_power(void) {
    const double phi = (1 + sqrt(5)) / 2, length = sqrt(1 + phi * phi);
    for (int i = 0; i < 2000; ++i) {
        double p[3], sum = 0, size;
        draw(3, p);
        for (int axis = 0; axis < 3; ++axis) {
            const double a = p[axis], b = p[(axis + 1) % 3];
            sum += pow((a + phi * b) / length, 32) + pow((a - phi * b) / length, 32);
        }
        size = fabs(p[0]) + fabs(p[1]) + fabs(p[2]);
        /* the normals are rounded to float */
        CHECK(fabs(reference_at(scene_named("dodecahedron_p32"), p) - (pow(sum, 1.0 / 32) - 1)) <
              unit_roundoff * size + 1e-9);
    }
}

static void scenes_rays_are_the_cameras(void) {
    enum { width = 37, height = 22 };
    static spt_ray rays[width * height];
    for (size_t s = 0; s < scene_count; ++s) {
        const scene *const shown = scenes[s];
        const double distance = apart(shown->eye, shown->target);
        float pixel_radius;
        double mean[3] = {0, 0, 0};
        check_context("%s", shown->name);
        scene_rays(shown, width, height, rays, &pixel_radius);
        for (int i = 0; i < width * height; ++i) {
            const double zero[3] = {0, 0, 0};
            const double direction[3] = {(double)rays[i].direction[0], (double)rays[i].direction[1],
                                         (double)rays[i].direction[2]};
            /* three components, each rounded */
            CHECK(fabs(apart(direction, zero) - 1) < 2 * unit_roundoff);
            CHECK(rays[i].t_min == 0 && fabs((double)rays[i].t_max - shown->t_max) < 1e-4);
            for (int axis = 0; axis < 3; ++axis) {
                CHECK((double)rays[i].origin[axis] == (double)(float)shown->eye[axis]);
                mean[axis] += direction[axis];
            }
        }
        /* A picture is symmetric about its middle, so that its rays add up towards the target. */
        const double zero[3] = {0, 0, 0}, sum = apart(mean, zero);
        double forward[3], angle = 0;
        for (int axis = 0; axis < 3; ++axis) {
            forward[axis] = (shown->target[axis] - shown->eye[axis]) / distance;
            mean[axis] /= sum;
        }
        CHECK(apart(forward, mean) < 4 * unit_roundoff);
        /* Neighbours in the middle are a pixel apart, and the left and right ends of the middle row
         * see the field of view but for half a pixel each. Rows run from the top. */
        const spt_ray *const row = &rays[height / 2 * width];
        double left[3], right[3], cosine = 0;
        for (int axis = 0; axis < 3; ++axis) {
            left[axis] = (double)row[0].direction[axis];
            right[axis] = (double)row[width - 1].direction[axis];
            cosine += left[axis] * right[axis];
        }
        angle = 2 * atan((width - 1) * (double)pixel_radius);
        /* the row is half a pixel below the middle, which narrows the angle by its square */
        CHECK(fabs(acos(cosine) - angle) < 2 * (double)(pixel_radius * pixel_radius));
        CHECK(fabs(tan(shown->field_of_view / 360 * 3.14159265358979) -
                   width * (double)pixel_radius) < 1e-6);
        CHECK(rays[0].direction[1] > rays[(height - 1) * width].direction[1]);
        /* right is right: forward x up */
        CHECK((right[0] - left[0]) * -forward[2] + (right[2] - left[2]) * forward[0] > 0);
    }
}

static void scenes_tiles_permute_the_rays(void) {
    enum { width = 45, height = 35 };
    static spt_ray rays[width * height], tiled[width * height];
    static size_t pixel[width * height];
    static unsigned char met[width * height];
    float radius, radius_tiled;
    const scene *const shown = scenes[0];
    scene_rays(shown, width, height, rays, &radius);
    scene_rays_tiled(shown, width, height, tiled, pixel, &radius_tiled);
    CHECK(check_same_bits(radius, radius_tiled));
    memset(met, 0, sizeof met);
    for (int i = 0; i < width * height; ++i) {
        CHECK(pixel[i] < width * height && !met[pixel[i]]);
        met[pixel[i]] = 1;
        CHECK(memcmp(&tiled[i], &rays[pixel[i]], sizeof tiled[i]) == 0);
    }
    /* The first 256 are the first tile, each 16 of them a block of 4x4, each 4 one of 2x2. */
    for (size_t i = 0; i < 256; ++i) {
        const size_t column = pixel[i] % width, row = pixel[i] / width;
        CHECK(column / 4 == i / 16 % 2 + 2 * (i / 64 % 2) && row / 4 == i / 32 % 2 + i / 128 * 2);
        CHECK(column % 2 == i % 2 && row % 2 == i / 2 % 2);
    }
    scene_rays_tiled(shown, width, height, rays, NULL, &radius_tiled);
    CHECK(memcmp(rays, tiled, sizeof rays) == 0);
}

/* How far a component of scene_camera()'s directions may be from scene_rays()'s, which rounds once:
 * u = 2^-24, T and V half the picture's sides at distance 1. Each component of the axes and of
 * their products with the place in the picture is rounded once, the sums twice: 4 (1 + T + V). The
 * place across is x step - T, x step at most 2 T: step, product, difference and T itself 6 T, and
 * one more for V. Both as vectors (sqrt 3), and 6 for the root, the division and the other side's
 * rounding. Eye and target rounded to float turn the axes by the angle aim and, as far as they
 * stand off the vertical (level), about it by aim / level. */
static double camera_rounding(const scene *shown, int width, int height) {
    const double origin[3] = {0, 0, 0};
    const double half_across = tan(shown->field_of_view / 2 * 3.14159265358979323846 / 180);
    const double half_up = half_across * height / width;
    const double away = apart(shown->target, shown->eye);
    const double aim = (apart(shown->eye, origin) + apart(shown->target, origin)) / away;
    const double level =
        hypot(shown->target[0] - shown->eye[0], shown->target[2] - shown->eye[2]) / away;
    const double picture = 4 * (1 + half_across + half_up) + 6 * half_across + 7 * half_up;
    return unit_roundoff *
           (sqrt(3) * picture + aim * (1 + (half_across + 2 * half_up) / level) + 6);
}

static void scenes_frame_camera_is_the_camera(void) {
    enum { width = 40, height = 24, count = width * height };
    static spt_ray rays[count];
    static spt_camera_ray seen[count];
    static float x[count], y[count];
    for (int i = 0; i < count; ++i) {
        x[i] = (float)(i % width) + 0.5f;
        y[i] = (float)(i / width) + 0.5f;
    }
    for (size_t s = 0; s < scene_count; ++s) {
        const spt_camera camera = scene_camera(scenes[s], width, height);
        const double rounding = camera_rounding(scenes[s], width, height);
        float pixel_radius;
        check_context("%s", scenes[s]->name);
        scene_rays(scenes[s], width, height, rays, &pixel_radius);
        CHECK(spt_camera_rays(&camera, width, height, count, x, y, seen) == SPT_OK);
        for (int i = 0; i < count; ++i) {
            const spt_ray *const one = &seen[i].ray;
            CHECK(check_same_bits(one->t_min, rays[i].t_min));
            CHECK(check_same_bits(one->t_max, rays[i].t_max));
            for (int axis = 0; axis < 3; ++axis) {
                const double difference =
                    fabs((double)one->direction[axis] - (double)rays[i].direction[axis]);
                CHECK(check_same_bits(one->origin[axis], rays[i].origin[axis]));
                CHECK_SAY(difference <= rounding, "%g, allowed %g", difference, rounding);
            }
        }
    }
}

static void scenes_by_name(void) {
    for (size_t s = 0; s < scene_count; ++s) CHECK(scene_named(scenes[s]->name) == scenes[s]);
    CHECK(scene_named("no such scene") == NULL);
}

void suite_scenes_known(void) {
    RUN(scenes_known_distances);
    RUN(scenes_mandelbulb_without_angles);
    RUN(scenes_mandelbulb_on_its_axis);
    RUN(scenes_dodecahedron_corners);
    RUN(scenes_dodecahedron_power);
    RUN(scenes_rays_are_the_cameras);
    RUN(scenes_tiles_permute_the_rays);
    RUN(scenes_frame_camera_is_the_camera);
    RUN(scenes_by_name);
}
