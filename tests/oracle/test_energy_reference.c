/* SPDX-License-Identifier: MIT
 *
 * Pictures of the path tracer against those of a second one, whose intersections are exact: path by
 * path with the same random numbers, and on average with others and without next-event lighting. */
#include "energy_world.h"
#include "../check.h"

#include <math.h>
#include <string.h>

enum { width = 40, height = 32, pixels = width * height, block = 8 };
enum { blocks = pixels / (block * block) };
static const uint32_t whole_picture[4] = {0, 0, width, height};
static energy_world shown;
static double light[pixels][3], exact[pixels][3];

static energy_body *add(energy_world *self, energy_kind kind, float x, float y, float z, float red,
                        float green, float blue) {
    energy_body *body = &self->bodies[self->count++];
    const float albedo[3] = {red, green, blue};
    memset(body, 0, sizeof *body);
    body->kind = kind;
    body->center[0] = x;
    body->center[1] = y;
    body->center[2] = z;
    memcpy(body->material.albedo, albedo, sizeof albedo);
    return body;
}

static void set(float to[3], float x, float y, float z) {
    to[0] = x;
    to[1] = y;
    to[2] = z;
}

/* A third of a room, open to the sky: floor, back and left wall, two balls, one that glows, and a
 * box under a panel. */
static void build_corner(energy_world *self) {
    energy_body *body;
    memset(self, 0, sizeof *self);
    set(add(self, ENERGY_WALL, 0, 0, 0, 0.75f, 0.75f, 0.75f)->normal, 0, 1, 0);
    body = add(self, ENERGY_WALL, 0, 0, 0, 0.75f, 0.25f, 0.25f);
    set(body->normal, 1, 0, 0);
    body->offset = -2;
    body = add(self, ENERGY_WALL, 0, 0, 0, 0.5f, 0.75f, 0.5f);
    set(body->normal, 0, 0, 1);
    body->offset = -2;
    add(self, ENERGY_BALL, -0.75f, 0.75f, -0.5f, 0.9f, 0.9f, 0.9f)->radius = 0.75f;
    body = add(self, ENERGY_BALL, 1.25f, 0.375f, 0.75f, 0.25f, 0.25f, 0.75f);
    body->radius = 0.375f;
    set(body->material.emission, 0.5f, 0.25f, 0);
    set(add(self, ENERGY_BOX, 0.875f, 0.5f, -0.75f, 0.75f, 0.5f, 0.25f)->half, 0.5f, 0.5f, 0.375f);
    set(add(self, ENERGY_BOX, 0, 3.0625f, 0, 0.5f, 0.5f, 0.5f)->half, 1, 0.0625f, 0.75f);
    set(self->panel.corner, -1, 3, -0.75f);
    set(self->panel.along, 2, 0, 0);
    set(self->panel.across, 0, 0, 1.5f);
    set(self->panel.radiance, 4, 3, 2);
    self->panel.component = self->count - 1;
    self->world.panel = &self->panel;
}

/* Brighter above and to the right; a sun from over the shoulder. */
static void sky(void *user, const float direction[3], float radiance[3]) {
    (void)user;
    for (int c = 0; c < 3; ++c) {
        radiance[c] = 0.25f + 0.25f * direction[1] + 0.125f * (float)c * (1 + direction[0]);
    }
}

static void add_daylight(energy_world *self) {
    set(self->sun.direction, 0.48f, 0.6f, 0.64f);
    set(self->sun.irradiance, 2, 2, 1.5f);
    self->sun.sine = 0.25f;
    self->world.sun = &self->sun;
    self->world.sky = sky;
}

static void look(energy_world *self, int across, int down) {
    static const float eye[3] = {1.75f, 2, 5}, target[3] = {0, 1, 0};
    energy_look(self, eye, target, across, down);
}

/* ---- Comparing ----------------------------------------------------------------------------- */

/* The mean over a block of pixels, and its standard error squared: pixels are independent. */
typedef struct estimate {
    double mean, variance;
} estimate;

static estimate over_block(double (*values)[3], int index, int c) {
    const int left = index % (width / block) * block, top = index / (width / block) * block;
    const int count = block * block;
    double sum = 0, squares = 0;
    for (int i = 0; i < count; ++i) {
        const double value = values[(top + i / block) * width + left + i % block][c];
        sum += value;
        squares += value * value;
    }
    const estimate result = {sum / count,
                             (squares / count - sum / count * sum / count) / (count - 1)};
    return result;
}

/* Fills exact[] with the mean of so many samples, of paths of another seed if wished. */
static void render_exact(path_settings settings, uint32_t samples, int next_event, uint32_t seed) {
    settings.seed = seed;
    for (uint32_t i = 0; i < pixels; ++i) {
        energy_reference(&shown, &settings, next_event, i % width, i / width, width, height, 0,
                         samples, exact[i]);
        for (int c = 0; c < 3; ++c) exact[i][c] /= samples;
    }
}

static void render(const path_settings *settings, uint32_t samples) {
    energy_render(&shown, settings, width, height, whole_picture, 0, samples, light, NULL);
    for (int i = 0; i < pixels; ++i) {
        for (int c = 0; c < 3; ++c) light[i][c] /= samples;
    }
}

/* Each block's mean difference is within four standard errors of it, and `allowance` of the light:
 * what the tolerances may do. */
static void check_differences(double allowance) {
    static double difference[pixels][3];
    for (int i = 0; i < pixels; ++i) {
        for (int c = 0; c < 3; ++c) difference[i][c] = light[i][c] - exact[i][c];
    }
    for (int index = 0; index < blocks; ++index) {
        for (int c = 0; c < 3; ++c) {
            const double there = over_block(exact, index, c).mean;
            const estimate off = over_block(difference, index, c);
            CHECK_SAY(fabs(off.mean) < 4 * sqrt(off.variance) + allowance * there,
                      "block %d, colour %d: %g and %g more, standard error %g", index, c, there,
                      off.mean, sqrt(off.variance));
        }
    }
}

/* ---- The tests ----------------------------------------------------------------------------- */

/* With the same random numbers the paths are the same, but that their points are off by up to three
 * epsilons: hits come one early, origins stand two off the surface. Light that falls off with the
 * square of a distance of at least 2 changes by as much, in parts. Some paths (edges, shadows, and
 * round bodies, off which errors fly five times as large) become others. */
static void energy_path_by_path(void) {
    path_settings settings = path_settings_default();
    int close = 0;
    settings.roulette = settings.bounces + 1;
    settings.pixel_cone = 0;
    settings.epsilon = 1e-5f;
    build_corner(&shown);
    add_daylight(&shown);
    energy_build(&shown, 0);
    energy_add_gradients(&shown);
    look(&shown, width, height);
    render(&settings, 8);
    render_exact(settings, 8, 1, settings.seed);
    for (int i = 0; i < pixels; ++i) {
        int same = 1;
        for (int c = 0; c < 3; ++c) {
            same = same && fabs(light[i][c] - exact[i][c]) < 1e-3 * exact[i][c];
        }
        close += same;
    }
    CHECK_SAY(close > 0.99 * pixels, "only %d of %d pixels are the same", close, (int)pixels);
    check_differences(3 * 1e-5);
}

/* One field is of one material, and no panel can be told from the rest of it. */
static void make_one_field(energy_world *self) {
    self->world.panel = NULL;
    for (int c = 0; c < 3; ++c) self->bodies[4].material.emission[c] = 0;
    for (int k = 1; k < self->count; ++k) self->bodies[k].material = self->bodies[0].material;
    energy_build(self, 1);
}

/* As users have it: rays end at half a pixel, which makes shadows wider, and normals are of
 * differences. In blocks all over a picture of 640 x 512 light is that of exact intersections within
 * 1 %. */
static void energy_with_pixel_cones(void) {
    enum { times = 16, side = 4 };
    static double seen[side * side][3];
    for (int whole = 0; whole < 2; ++whole) {
        path_settings settings = path_settings_default();
        double sum = 0, expected = 0, squares = 0;
        check_context("as %s", whole ? "one field" : "a union");
        settings.roulette = settings.bounces + 1;
        build_corner(&shown);
        add_daylight(&shown);
        if (whole)
            make_one_field(&shown);
        else
            energy_build(&shown, 0);
        look(&shown, times * width, times * height);
        for (uint32_t y = 32; y < times * height; y += 64) {
            for (uint32_t x = 32; x < times * width; x += 64) {
                const uint32_t area[4] = {x, y, x + side, y + side};
                energy_render(&shown, &settings, times * width, times * height, area, 0, 4, seen,
                              NULL);
                for (uint32_t i = 0; i < side * side; ++i) {
                    double there[3];
                    energy_reference(&shown, &settings, 1, x + i % side, y + i / side,
                                     times * width, times * height, 0, 4, there);
                    sum += seen[i][1] - there[1];
                    squares += (seen[i][1] - there[1]) * (seen[i][1] - there[1]);
                    expected += there[1];
                }
            }
        }
        CHECK_SAY(fabs(sum) < 0.01 * expected, "off by %g, standard error %g", sum / expected,
                  sqrt(squares) / expected);
    }
}

/* Paths that do not look for the panel but meet it by chance bring the same light on average: none
 * counts twice, none is forgotten. Independent random numbers; roulette, too. */
static void energy_without_next_event(void) {
    path_settings settings = path_settings_default();
    settings.pixel_cone = 0;
    build_corner(&shown);
    shown.world.sky = sky;
    energy_build(&shown, 0);
    energy_add_gradients(&shown);
    look(&shown, width, height);
    render(&settings, 16);
    render_exact(settings, 64, 0, settings.seed + 1);
    check_differences(0);
    double sum = 0, squares = 0, expected = 0;
    for (int i = 0; i < pixels; ++i) {
        sum += light[i][1] - exact[i][1];
        squares += (light[i][1] - exact[i][1]) * (light[i][1] - exact[i][1]);
        expected += exact[i][1];
    }
    CHECK_SAY(sqrt(squares) < 0.005 * expected, "noise of %g", sqrt(squares) / expected);
    CHECK_SAY(fabs(sum) < 4 * sqrt(squares), "off by %g, standard error %g", sum / expected,
              sqrt(squares) / expected);
}

void suite_energy_reference(void) {
    RUN(energy_path_by_path);
    RUN(energy_with_pixel_cones);
    RUN(energy_without_next_event);
}
