/* SPDX-License-Identifier: MIT
 *
 * Furnaces: worlds in which every path brings the same light, so that a ray that leaks through a
 * wall, meets the surface it starts from or gets lost shows in its own pixel. */
#include "energy_world.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <string.h>

enum { across = 8, pixels = across * across };
static const uint32_t area[4] = {300, 200, 300 + across, 200 + across};
static const float albedo[3] = {0.25f, 0.5f, 0.75f};
static energy_world shown;
static double light[pixels][3];

static energy_body *add(energy_world *self, energy_kind kind, float x, float y, float z,
                        float radius) {
    energy_body *body = &self->bodies[self->count++];
    memset(body, 0, sizeof *body);
    body->kind = kind;
    body->center[0] = x;
    body->center[1] = y;
    body->center[2] = z;
    body->radius = radius;
    memcpy(body->material.albedo, albedo, sizeof albedo);
    return body;
}

/* A room from low to high, of walls so thin that what leaks through one is outside. */
static void add_room(energy_world *self, const float low[3], const float high[3]) {
    static const float thickness = 0.25f; /* half of it */
    for (int side = 0; side < 6; ++side) {
        energy_body *wall = add(self, ENERGY_BOX, 0, 0, 0, 0);
        for (int axis = 0; axis < 3; ++axis) {
            wall->center[axis] = 0.5f * (low[axis] + high[axis]);
            wall->half[axis] = 0.5f * (high[axis] - low[axis]) + 2 * thickness;
        }
        wall->half[side / 2] = thickness;
        wall->center[side / 2] =
            side % 2 == 0 ? low[side / 2] - thickness : high[side / 2] + thickness;
    }
}

/* A ball and a box that touch the floor at y = -1 and the box the wall x = 2, a ring that is in
 * both, and narrow gaps between. */
static void add_objects(energy_world *self) {
    energy_body *box;
    add(self, ENERGY_BALL, -0.75f, -0.5f, -0.25f, 0.5f);
    box = add(self, ENERGY_BOX, 1.5f, -0.25f, -0.75f, 0);
    box->half[0] = box->half[2] = 0.5f;
    box->half[1] = 0.75f;
    add(self, ENERGY_RING, 0.5f, -0.75f, -0.5f, 0.625f)->tube = 0.25f;
    add(self, ENERGY_BALL, 0.25f, 0.25f, 0.5f, 0.25f);
}

static void build_closed_box(energy_world *self) {
    static const float low[3] = {-2, -1, -2}, high[3] = {2, 1.5f, 3};
    memset(self, 0, sizeof *self);
    add_room(self, low, high);
    add_objects(self);
}

static void build_closed_ball(energy_world *self) {
    memset(self, 0, sizeof *self);
    add(self, ENERGY_HOLLOW, 0, 0, 0, 3.5f);
    add_objects(self);
}

/* The rule of an index: the path tracer's own choice first, then all that any field may have. */
static int rule_at(int index, const spt_method **method, const char **name) {
    *method = NULL;
    *name = "own choice";
    if (index > rule_count) return 0;
    if (index > 0) {
        *method = rules[index - 1].method();
        *name = rules[index - 1].name;
    }
    return 1;
}

static void check_settings(int cone, const char *name) {
    check_context("%s, as %s, rule %s, pixel cone %d",
                  shown.bodies[0].kind == ENERGY_HOLLOW ? "hollow ball" : "box",
                  shown.scene.count == 1 ? "one field" : "a union", name, cone);
}

/* Every surface shines by 1, the room is closed: after 10 bounces the eye sees the sum of the
 * powers of the albedo. The sums of these albedos are exact in float up to 3^10 / 2^20. */
static void check_closed(const spt_method *method, int cone) {
    path_settings settings = path_settings_default();
    path_statistics statistics;
    settings.method = method;
    settings.pixel_cone = cone;
    settings.roulette = settings.bounces + 1;
    energy_render(&shown, &settings, 640, 400, area, 0, 2, light, &statistics);
    for (int i = 0; i < pixels; ++i) {
        for (int c = 0; c < 3; ++c) {
            const double a = (double)albedo[c];
            const double expected = 2 * (1 - pow(a, settings.bounces + 1)) / (1 - a);
            CHECK_SAY(fabs(light[i][c] - expected) <= 1e-12 * expected,
                      "pixel %d, colour %d: %.9g, not %.9g", i, c, light[i][c], expected);
        }
    }
    for (int kind = PATH_PRIMARY; kind <= PATH_SECONDARY; ++kind) {
        const spt_statistics *traced = &statistics.traced[kind];
        CHECK_SAY(traced->outcomes[SPT_HIT] == traced->rays, "%llu of %llu rays hit",
                  (unsigned long long)traced->outcomes[SPT_HIT], (unsigned long long)traced->rays);
    }
}

static void energy_of_closed_furnaces(void) {
    static const float eye[3] = {-0.5f, 0.2f, 2.5f}, target[3] = {2, -1, -2}; /* a corner */
    for (int room = 0; room < 2; ++room) {
        for (int whole = 0; whole < 2; ++whole) {
            const spt_method *method;
            const char *name;
            (room == 0 ? build_closed_box : build_closed_ball)(&shown);
            for (int k = 0; k < shown.count; ++k) {
                for (int c = 0; c < 3; ++c) shown.bodies[k].material.emission[c] = 1;
            }
            energy_build(&shown, whole);
            energy_look(&shown, eye, target, 640, 400);
            for (int i = 0; rule_at(i, &method, &name); ++i) {
                if (method == spt_convex()) continue; /* a hollow is not convex */
                for (int cone = 0; cone < 2; ++cone) {
                    check_settings(cone, name);
                    check_closed(method, cone);
                }
            }
        }
    }
}

/* ---- In the open --------------------------------------------------------------------------- */

static void white(void *user, const float direction[3], float radiance[3]) {
    (void)user;
    (void)direction;
    for (int c = 0; c < 3; ++c) radiance[c] = 1;
}

static void build_open(energy_kind kind) {
    memset(&shown, 0, sizeof shown);
    energy_body *body = add(&shown, kind, 0, 0, 0, 1);
    body->tube = 0.375f;
    for (int c = 0; c < 3; ++c) body->half[c] = 0.25f + 0.25f * (float)c;
    shown.world.sky = white;
}

/* A path that meets a convex body flies off it into the sky, which is white: the eye sees the
 * albedo, once, or the sky. What meets its own surface again would be darker. */
static void energy_of_convex_bodies(void) {
    static const energy_kind kinds[] = {ENERGY_BALL, ENERGY_BOX};
    static const float eye[3] = {2.5f, 1.5f, 3}, target[3] = {0, 0, 0};
    static const uint32_t middle[4] = {304, 184, 336, 216};
    static double seen[32 * 32][3];
    for (int k = 0; k < 2; ++k) {
        const spt_method *method;
        const char *name;
        build_open(kinds[k]);
        energy_build(&shown, 0);
        energy_look(&shown, eye, target, 640, 400);
        for (int i = 0; rule_at(i, &method, &name); ++i) {
            for (int cone = 0; cone < 2; ++cone) {
                path_settings settings = path_settings_default();
                int bodies = 0;
                settings.method = method;
                settings.pixel_cone = cone;
                check_context("%s, rule %s, pixel cone %d", k == 0 ? "ball" : "box", name, cone);
                energy_render(&shown, &settings, 640, 400, middle, 0, 1, seen, NULL);
                for (int pixel = 0; pixel < 32 * 32; ++pixel) {
                    const int dark = check_same_bits((float)seen[pixel][0], albedo[0]);
                    for (int c = 0; c < 3; ++c) {
                        const float expected = dark ? albedo[c] : 1;
                        CHECK_SAY(check_same_bits((float)seen[pixel][c], expected), "pixel %d: %g",
                                  pixel, seen[pixel][c]);
                    }
                    bodies += dark;
                }
                CHECK_SAY(bodies > 600, "only %d paths met the body", bodies);
            }
        }
    }
}

/* A white ring under a white sky cannot be told from it, as long as paths come to an end: of those
 * inside, one in two flies off at every bounce. */
static void energy_of_a_white_ring(void) {
    static const float eye[3] = {0, 2, 1.5f}, target[3] = {0, 0, 0};
    const spt_method *method;
    const char *name;
    build_open(ENERGY_RING);
    for (int c = 0; c < 3; ++c) shown.bodies[0].material.albedo[c] = 1;
    energy_build(&shown, 0);
    energy_look(&shown, eye, target, 640, 400);
    for (int i = 0; rule_at(i, &method, &name); ++i) {
        path_settings settings = path_settings_default();
        if (method == spt_convex()) continue;
        settings.method = method;
        settings.bounces = 100;
        check_context("rule %s", name);
        energy_render(&shown, &settings, 640, 400, area, 0, 8, light, NULL);
        for (int pixel = 0; pixel < pixels; ++pixel) {
            CHECK_SAY(fabs(light[pixel][0] - 8) <= 0, "pixel %d: %g", pixel, light[pixel][0]);
        }
    }
}

/* With roulette the sum of the powers comes only on average: over independent pixels within four
 * standard errors, of which one is to be 0.2 %. */
static void energy_with_roulette(void) {
    static const float eye[3] = {0.4f, 0.2f, 2.5f}, target[3] = {0.2f, -0.4f, 0};
    static const uint32_t middle[4] = {288, 168, 352, 232};
    static double seen[64 * 64][3];
    path_settings settings = path_settings_default();
    build_closed_ball(&shown);
    for (int k = 0; k < shown.count; ++k) {
        for (int c = 0; c < 3; ++c) shown.bodies[k].material.emission[c] = 1;
    }
    energy_build(&shown, 0);
    energy_look(&shown, eye, target, 640, 400);
    settings.roulette = 1;
    energy_render(&shown, &settings, 640, 400, middle, 0, 4, seen, NULL);
    for (int c = 0; c < 3; ++c) {
        const double a = (double)albedo[c];
        const double expected = 4 * (1 - pow(a, settings.bounces + 1)) / (1 - a);
        double sum = 0, squares = 0;
        for (int i = 0; i < 64 * 64; ++i) {
            sum += seen[i][c] / expected - 1;
            squares += (seen[i][c] / expected - 1) * (seen[i][c] / expected - 1);
        }
        const double error = sqrt(squares) / (64 * 64);
        CHECK_SAY(error < 0.004, "noise %g", error);
        CHECK_SAY(fabs(sum / (64 * 64)) < 4 * error, "off by %g, standard error %g",
                  sum / (64 * 64), error);
    }
}

void suite_energy_furnace(void) {
    RUN(energy_of_closed_furnaces);
    RUN(energy_of_convex_bodies);
    RUN(energy_of_a_white_ring);
    RUN(energy_with_roulette);
}
