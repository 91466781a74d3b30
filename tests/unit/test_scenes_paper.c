/* SPDX-License-Identifier: MIT
 *
 * The scenes of the paper's figures against answers found in other ways: the gem by its corners and
 * by its planes one by one, the city by looking at every tower around. */
#include "../check.h"

#include "scenes/scene_city.h"
#include "scenes/scene_jewel.h"
#include "scenes/scenes.h"
#include "test_scenes.h"

#include <math.h>

static const double unit_roundoff = 5.9604644775390625e-8; /* 2^-24 */

/* ---- The gem --------------------------------------------------------------------------------- */

/* From the stone's own axes, as a distance from its axis, a height and a turn in degrees, to where
 * it lies: on its lowest main, whose normal is -y. */
static void as_it_lies(double radius, double height, double degrees, double p[3]) {
    const double angle = degrees * (3.14159265358979324 / 180), lean = 40.75 * atan(1) / 45;
    const double first = radius * cos(angle);
    p[0] = radius * sin(angle);
    p[1] = cos(lean) * height - sin(lean) * first;
    p[2] = sin(lean) * height + cos(lean) * first;
}

/* On the surface, where several facets meet. The field's constants, six a facet, are rounded to
 * float, coordinates are at most 1.1. */
static void check_corner(double radius, double height, double degrees) {
    double p[3];
    as_it_lies(radius, height, degrees, p);
    const double f = reference_at(scene_named("jewel"), p);
    CHECK_SAY(fabs(f) < 6 * 1.1 * unit_roundoff, "%g at radius %g, height %g, %g degrees", f,
              radius, height, degrees);
}

/* Corners from the proportions of the cut: crown and pavilion angles, table, stars half way. */
static void scenes_jewel_corners(void) {
    const double degree = atan(1) / 45, girdle = 0.02, table = 0.56;
    const double crown = tan(34.5 * degree), pavilion = tan(40.75 * degree);
    const double edge = table * cos(22.5 * degree), star = edge + 0.5 * (1 - edge);
    const double lower = 1 - 0.78;
    check_corner(0, -girdle - pavilion, 0); /* the point below */
    for (int turn = 0; turn < 16; ++turn) {
        const double degrees = 22.5 * turn;
        check_corner(1, girdle, degrees);
        check_corner(1, -girdle, degrees);
        if (turn % 2 == 0) {
            check_corner(table, girdle + (1 - table) * crown, degrees);
        } else {
            check_corner(star, girdle + (1 - star * cos(22.5 * degree)) * crown, degrees);
            check_corner(lower, -girdle - (1 - lower * cos(22.5 * degree)) * pavilion, degrees);
        }
    }
}

/* The field is the greatest of the planes that programs get: normals rounded to float, three
 * products each, and offsets. Every facet is ahead somewhere. */
static void scenes_jewel_is_its_planes(void) {
    const scene *const shown = scene_named("jewel");
    spt_bound_plane planes[JEWEL_PLANES];
    int ahead[JEWEL_PLANES] = {0};
    jewel_planes(planes);
    for (int i = 0; i < 20000; ++i) {
        const double box[3] = {1.1, 1.1, 1.1}, low[3] = {-1.1, -1.1, -1.1};
        double p[3], greatest = -HUGE_VAL;
        int first = 0;
        draw_between(low, box, p);
        for (int plane = 0; plane < JEWEL_PLANES; ++plane) {
            double height = -(double)planes[plane].offset;
            for (int axis = 0; axis < 3; ++axis) {
                height += (double)planes[plane].normal[axis] * p[axis];
            }
            if (height > greatest) first = plane;
            if (height > greatest) greatest = height;
        }
        ++ahead[first];
        const double size = fabs(p[0]) + fabs(p[1]) + fabs(p[2]) + 1;
        /* two roundings for each side's normals, one for their offsets */
        CHECK_SAY(fabs(reference_at(shown, p) - greatest) <= 4 * unit_roundoff * size,
                  "%.9g, planes %.9g", reference_at(shown, p), greatest);
    }
    for (int plane = 0; plane < JEWEL_PLANES; ++plane) {
        CHECK_SAY(ahead[plane] > 0, "plane %d", plane);
    }
}

/* It touches the plane that it is said to lie on with a whole facet, and goes no lower. */
static void scenes_jewel_lies(void) {
    const scene *const shown = scene_named("jewel");
    for (int i = 0; i < 4000; ++i) {
        double p[3] = {check_uniform(-1, 1), (double)(float)JEWEL_LOWEST, check_uniform(-1, 1)};
        CHECK(reference_at(shown, p) > -2 * unit_roundoff);
    }
    double middle[3];
    as_it_lies(0.5, -0.02 - 0.5 * tan(40.75 * atan(1) / 45), 0, middle);
    CHECK(fabs(middle[1] - JEWEL_LOWEST) < 1e-8);
    CHECK(fabs(reference_at(shown, middle)) < 6 * unit_roundoff);
}

/* ---- The city -------------------------------------------------------------------------------- */

/* The distance from outside to the tower of a cell by its nearest points, 0 inside. */
static double tower_oracle(int32_t column, int32_t row, const double p[3]) {
    const city_tower tower = city_tower_of(city_hash(column, row));
    double nearest = HUGE_VAL;
    for (int upper = 0; upper < 2; ++upper) {
        const double recess = upper ? 0.25 : 0;
        const double width = (double)tower.half_width - recess;
        const double depth = (double)tower.half_depth - recess;
        const double height = (double)(upper ? tower.height : tower.shoulder);
        const double x = p[0] - 4.0 * column, z = p[2] - 4.0 * row;
        const double foot[3] = {4.0 * column + fmin(fmax(x, -width), width), fmin(p[1], height),
                                4.0 * row + fmin(fmax(z, -depth), depth)};
        nearest = fmin(nearest, apart(p, foot));
    }
    return nearest;
}

/* The distance to the ground and to the towers of 7x7 cells: all that can be nearest to a point
 * whose height is at most 12, since others are farther than that. */
static double city_oracle(const double p[3]) {
    const int32_t column = (int32_t)floor(p[0] / 4 + 0.5), row = (int32_t)floor(p[2] / 4 + 0.5);
    double nearest = fmax(p[1], 0);
    for (int32_t i = -3; i <= 3; ++i) {
        for (int32_t k = -3; k <= 3; ++k) {
            nearest = fmin(nearest, tower_oracle(column + i, row + k, p));
        }
    }
    return nearest;
}

/* Never above the true distance, the distance itself where that is less than the kerb, and below
 * zero exactly inside. */
static void scenes_city_is_a_bound(void) {
    const scene *const shown = scene_named("city");
    int near_tower = 0, inside = 0;
    for (int i = 0; i < 20000; ++i) {
        double p[3] = {check_uniform(-40, 40), check_uniform(-0.5, 12), check_uniform(-40, 40)};
        if (i % 4 == 0) p[0] = 2 + 4 * floor(p[0] / 4); /* on a border */
        const double f = reference_at(shown, p), truth = city_oracle(p);
        CHECK_SAY(f <= truth + 1e-12, "%.9g for %.9g at %g %g %g", f, truth, p[0], p[1], p[2]);
        CHECK((f <= 0) == (truth <= 0));
        inside += f < 0;
        if (!(truth > 0) || truth >= CITY_KERB) continue;
        ++near_tower;
        CHECK_SAY(fabs(f - truth) < 1e-12, "%.9g, not %.9g", f, truth);
    }
    CHECK_SAY(near_tower > 2000 && inside > 1000, "%d near, %d inside", near_tower, inside);
}

/* No jump from cell to cell, near and as far away as there are cells, and behind the last one. */
static void scenes_city_has_no_jumps(void) {
    const scene *const shown = scene_named("city");
    const double step = 0x1p-20; /* exact at all these places, in double */
    for (int i = 0; i < 20000; ++i) {
        const double far = i % 2 == 0 ? 0 : 4 * (double)(check_random() % 4194300);
        const double border = 2 + 4 * floor(check_uniform(-10, 10)) + far;
        double p[3] = {border, check_uniform(0, 9), check_uniform(-40, 40)}, q[3];
        if (i % 3 == 0) p[2] = check_uniform(-3e7, 3e7);
        for (int axis = 0; axis < 3; ++axis) q[axis] = p[axis];
        p[i / 4 % 2 * 2] = border - step;
        q[i / 4 % 2 * 2] = border + step;
        CHECK(fabs(reference_at(shown, p) - reference_at(shown, q)) <= 2 * step);
    }
}

/* Streets are free, no tower exceeds the skyline, some come close, and towers differ. */
static void scenes_city_towers(void) {
    int high = 0, low = 0;
    for (int32_t column = -40; column < 40; ++column) {
        for (int32_t row = -40; row < 40; ++row) {
            const city_tower tower = city_tower_of(city_hash(column, row));
            CHECK(tower.half_width <= 2 - (spt_real)CITY_KERB && tower.half_width > 0.5f);
            CHECK(tower.half_depth <= 2 - (spt_real)CITY_KERB && tower.half_depth > 0.5f);
            CHECK(tower.height < CITY_SKYLINE && tower.shoulder <= tower.height);
            high += tower.height > 6;
            low += tower.height < 1.5f;
        }
    }
    CHECK_SAY(high > 200 && high < 1600 && low > 1000 && low < 3200, "%d high, %d low", high, low);
}

void suite_scenes_paper(void) {
    RUN(scenes_jewel_corners);
    RUN(scenes_jewel_is_its_planes);
    RUN(scenes_jewel_lies);
    RUN(scenes_city_is_a_bound);
    RUN(scenes_city_has_no_jumps);
    RUN(scenes_city_towers);
}
