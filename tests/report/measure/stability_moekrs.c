/* SPDX-License-Identifier: MIT
 *
 * Kernel-reflection sequences with an inversion between their levels (Szecsi et al. 2016, section
 * 7), traced by the library's distance bound. The truth are all the balls that the kernels become,
 * each carried through every choice of mirrors by the textbook image of a ball. */
#include <math.h>

#include <spheretrace/mobius.h>

#include "stability.h"

enum { most_levels = 14 };

typedef struct ball {
    double center[3], radius;
} ball;

/* q -> shift + scale turn (center + square (q - center) / |q - center|^2). */
typedef struct level_map {
    double center[3], square, turn[3][3], scale, shift[3];
} level_map;

typedef struct moekrs_memory {
    spt_moekrs moekrs;
    int levels, count;
    ball kernel[most_levels + 1];
    level_map map[most_levels];
    ball balls[(2 << most_levels) - 1];
} moekrs_memory;

/* ---- Maps of points and balls --------------------------------------------------------------- */

static void to_center(const level_map *map, const double q[3], double from[3]) {
    for (int axis = 0; axis < 3; ++axis) from[axis] = q[axis] - map->center[axis];
}

/* What comes after the inversion, from a vector seen from its centre. */
static void move_on(const level_map *map, const double from[3], double p[3]) {
    double at[3];
    for (int axis = 0; axis < 3; ++axis) at[axis] = map->center[axis] + from[axis];
    for (int axis = 0; axis < 3; ++axis)
        p[axis] = map->shift[axis] + map->scale * stability_dot(map->turn[axis], at);
}

/* The image of a ball that the centre is outside of. */
static ball ball_image(const level_map *map, const ball *one) {
    double from[3];
    ball image;
    to_center(map, one->center, from);
    const double power = stability_dot(from, from) - one->radius * one->radius;
    for (int axis = 0; axis < 3; ++axis) from[axis] *= map->square / power;
    move_on(map, from, image.center);
    image.radius = map->scale * map->square * one->radius / power;
    return image;
}

/* The preimage of a point, how many times lengths grow on the way to it, and how far the point is
 * from the image of infinity. */
static void point_back(const level_map *map, const double p[3], double q[3], double *growth,
                       double *from_pole) {
    double at[3], from[3];
    for (int axis = 0; axis < 3; ++axis) {
        at[axis] = 0;
        for (int k = 0; k < 3; ++k) at[axis] += map->turn[k][axis] * (p[k] - map->shift[k]);
        at[axis] /= map->scale;
    }
    to_center(map, at, from);
    const double square = stability_dot(from, from);
    for (int axis = 0; axis < 3; ++axis)
        q[axis] = map->center[axis] + from[axis] * map->square / square;
    *growth = map->square / square / map->scale;
    *from_pole = map->scale * sqrt(square);
}

/* ---- The bound of section 6, level by level ------------------------------------------------- */

static double kernel_distance(const ball *kernel, const double q[3]) {
    const double from[3] = {q[0] - kernel->center[0], q[1] - kernel->center[1],
                            q[2] - kernel->center[2]};
    return stability_length(from) - kernel->radius;
}

/* A ball of radius r around the preimage reaches, as its image, h / (1 + h / d) around the point,
 * with h = r / growth, and d the distance from the image of infinity (see stability_conformal.c);
 * which grows with r, so that the least of several comes first. */
static double moekrs_value(const stability_world *world, const double p[3]) {
    const moekrs_memory *const model = world->memory;
    double q[most_levels + 1][3], growth[most_levels], from_pole[most_levels];
    double at[3] = {p[0], p[1], p[2]};
    for (int i = model->levels; i-- > 0;) {
        point_back(&model->map[i], at, q[i], &growth[i], &from_pole[i]);
        at[0] = -fabs(q[i][0]);
        at[1] = q[i][1];
        at[2] = q[i][2];
    }
    double least = kernel_distance(&model->kernel[0], at);
    for (int i = 0; i < model->levels; ++i) {
        least = fmin(least, kernel_distance(&model->kernel[i + 1], q[i]));
        const double h = least / growth[i];
        least = h / (1 + fabs(h) / from_pole[i]);
    }
    return least;
}

/* ---- A model: every level in a ball before the mirror --------------------------------------- */

static double draw(report_random *random, double low, double high) {
    return stability_rounded(report_uniform(random, low, high));
}

static void expect(spt_status status) {
    report_expect(status == SPT_OK, "a map is refused");
}

/* An inversion in a sphere beside all of the level, within 1.5 of the origin, a turn about an axis,
 * and the way back into the ball of radius 0.7 at x = -0.8, or for the last map to the origin. */
static void draw_map(report_random *random, int last, level_map *map, spt_mobius *library) {
    const double angle = draw(random, -3, 3);
    double axis[3], away[3] = {draw(random, -0.3, 0.3), draw(random, -1, 1), draw(random, 0.7, 1)};
    const double length = stability_length(away);
    for (int i = 0; i < 3; ++i) {
        axis[i] = draw(random, -1, 1);
        map->center[i] = stability_rounded(away[i] / length * 3.5);
    }
    const double c = cos(angle), s = sin(angle), size = stability_length(axis);
    for (int i = 0; i < 3; ++i) { /* Rodrigues */
        for (int k = 0; k < 3; ++k) {
            const double sine =
                i == k ? 0 : axis[3 - i - k] / size * ((k - i + 3) % 3 == 1 ? -s : s);
            map->turn[i][k] = axis[i] * axis[k] / (size * size) * (1 - c) + (i == k ? c : 0) + sine;
        }
    }
    map->square = 4;
    map->scale = 1;
    map->shift[0] = map->shift[1] = map->shift[2] = 0;
    const ball all = {{0, 0, 0}, 1.5};
    const ball image = ball_image(map, &all);
    map->scale = stability_rounded((last ? 1.2 : 0.7) / image.radius);
    for (int i = 0; i < 3; ++i)
        map->shift[i] =
            stability_rounded((i == 0 && !last ? -0.8 : 0) - map->scale * image.center[i]);
    spt_mobius step;
    expect(spt_mobius_inversion(map->center, sqrt(map->square), library));
    expect(spt_mobius_rotation(axis, angle, &step));
    expect(spt_mobius_compose(&step, library, library));
    expect(spt_mobius_dilation(map->scale, &step));
    expect(spt_mobius_compose(&step, library, library));
    expect(spt_mobius_translation(map->shift, &step));
    expect(spt_mobius_compose(&step, library, library));
}

/* All balls of L_(i+1) from those of L_i, in place. */
static void expand_level(moekrs_memory *model, int i) {
    for (int k = 0; k < model->count; ++k) {
        model->balls[model->count + k] = model->balls[k];
        model->balls[model->count + k].center[0] *= -1;
    }
    model->count *= 2;
    model->balls[model->count++] = model->kernel[i + 1];
    for (int k = 0; k < model->count; ++k)
        model->balls[k] = ball_image(&model->map[i], &model->balls[k]);
}

static spt_kernel draw_kernel(report_random *random, double x, ball *kept) {
    kept->center[0] = x;
    kept->center[1] = draw(random, -0.4, 0.4);
    kept->center[2] = draw(random, -0.4, 0.4);
    kept->radius = draw(random, 0.2, 0.3);
    return spt_kernel_sphere((float)x, (float)kept->center[1], (float)kept->center[2],
                             (float)kept->radius);
}

static void moekrs_build(stability_world *world, double value) {
    moekrs_memory *const model = report_allocate(sizeof *model);
    spt_kernel kernels[most_levels + 1];
    spt_mobius maps[most_levels];
    report_random random = {5};
    stability_begin(world, moekrs_value);
    model->levels = (int)value;
    kernels[0] = draw_kernel(&random, -0.75, &model->kernel[0]);
    model->balls[model->count++] = model->kernel[0];
    for (int i = 0; i < model->levels; ++i) {
        kernels[i + 1] = draw_kernel(&random, 0, &model->kernel[i + 1]);
        draw_map(&random, i + 1 == model->levels, &model->map[i], &maps[i]);
        expand_level(model, i);
    }
    spt_moekrs_model described = spt_moekrs_model_default();
    described.levels = (uint32_t)model->levels;
    described.kernels = kernels;
    described.maps = maps;
    expect(spt_moekrs_build(&described, &model->moekrs));
    world->memory = model;
    world->field = spt_moekrs_field(&model->moekrs);
    /* mobius.h: above the distance by about 2^-20 = 16u of the coordinates that the levels see, as
     * lengths in the world, where those of lower levels are smaller: 3 to 5 here, of all levels
     * together. */
    world->units = 3 + 16;
    world->reach = 5;
}

/* At and around an instance that is drawn: a kernel of any level, through half of the mirrors. */
static void moekrs_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    const moekrs_memory *const model = world->memory;
    const int number = (int)(report_bits(random) % (uint32_t)(model->levels + 1));
    double from[3], through[3];
    ball one = model->kernel[number];
    for (int i = number > 0 ? number - 1 : 0; i < model->levels; ++i) {
        const int mirrored = i >= number && (report_bits(random) & 1) != 0;
        if (mirrored) one.center[0] *= -1;
        one = ball_image(&model->map[i], &one);
    }
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = report_uniform(random, -0.2, 0.2);
        through[axis] = one.center[axis] + report_uniform(random, -1.3, 1.3) * one.radius;
    }
    from[2] -= 4;
    stability_aim(ray, from, through, 20);
}

static void moekrs_truth(const stability_world *world, const spt_ray *ray, stability_truth *truth) {
    const moekrs_memory *const model = world->memory;
    const double less = stability_rounding(world, ray, 4);
    double in, out;
    stability_nothing(truth);
    for (int i = 0; i < model->count; ++i) {
        const ball *const one = &model->balls[i];
        if (!stability_ball_interval(ray, one->center, one->radius, &in, &out)) continue;
        stability_crossing(truth, in, 0);
        if (stability_ball_interval(ray, one->center, one->radius - less, &in, &out))
            stability_crossing(truth, in, 1);
    }
}

const stability_family stability_moekrs = {.name = "moekrs",
                                           .parameter = "levels",
                                           .bound = 1,
                                           .count = 9,
                                           .values = {1, 2, 3, 4, 6, 8, 10, 12, 14},
                                           .build = moekrs_build,
                                           .ray = moekrs_ray,
                                           .truth = moekrs_truth};
