/* SPDX-License-Identifier: MIT
 *
 * The worlds, and what is met in them analytically. Their light is in glass_light.c. */
#include "glass_world.h"

#include "scenes/jewel_planes.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* A mirror, a matt and a glass ball, all on the ground. */
static const glass_ball three_balls[] = {
    {{-2.2f, -0.1f, -1.75f}, 0.9f, {GLASS_MIRROR, {0.92f, 0.90f, 0.86f}, 1.0f, {0, 0, 0}}},
    {{1.85f, -0.45f, -1.05f}, 0.55f, {GLASS_MATT, {0.62f, 0.13f, 0.07f}, 1.0f, {0, 0, 0}}},
    {{1.4f, -0.66f, 0.95f}, 0.34f, {GLASS_CLEAR, {1, 1, 1}, 1.5f, {0.25f, 0.10f, 0.45f}}},
};

/* The sun, whose disc is spread over some degrees so that pixels do not miss its image, and its
 * glow. It is the one that lights matt points. */
#define SUN \
    { -0.7011f, 0.6210f, 0.3506f }
static const glass_lamp sun[] = {{SUN, {9.0f, 8.0f, 6.6f}, 900.0f},
                                 {SUN, {0.5f, 0.44f, 0.37f}, 40.0f}};
static const glass_lamp studio[] = {{SUN, {14.0f, 12.4f, 10.2f}, 300.0f},
                                    {SUN, {0.5f, 0.44f, 0.37f}, 30.0f},
                                    {{0.5883f, 0.7845f, 0.1961f}, {5.0f, 5.0f, 5.4f}, 160.0f},
                                    {{0.1796f, 0.4491f, 0.8752f}, {4.0f, 3.8f, 3.4f}, 90.0f},
                                    {{-0.2673f, 0.8018f, -0.5345f}, {4.0f, 4.2f, 4.6f}, 60.0f}};

int glass_world_named(const char *name, glass_world *world) {
    static const glass_material bluish = {GLASS_CLEAR, {1, 1, 1}, 1.5f, {0.24f, 0.09f, 0.06f}};
    static const glass_material pink_diamond = {
        GLASS_CLEAR, {1, 1, 1}, 2.417f, {0.06f, 0.42f, 0.24f}};
    memset(world, 0, sizeof *world);
    world->name = name;
    world->body = scene_named(name);
    world->has_ground = 1;
    if (strcmp(name, "glass") == 0) {
        world->body_material = bluish;
        world->balls = three_balls;
        world->ball_count = sizeof three_balls / sizeof three_balls[0];
        world->ground = -1.0f;
        world->square = 0.8f;
        world->lamps = sun;
        world->lamp_count = sizeof sun / sizeof sun[0];
    } else if (strcmp(name, "jewel") == 0) {
        world->body_material = pink_diamond;
        jewel_planes(world->facets);
        world->facet_count = JEWEL_PLANES;
        world->ground = (float)JEWEL_LOWEST;
        world->square = 0.5f;
        world->lamps = studio;
        world->lamp_count = sizeof studio / sizeof studio[0];
    } else {
        return 0;
    }
    world->haze = 26.0f;
    world->sky = world->lamps == studio ? 0.3f : 1.0f;
    return world->body != NULL;
}

/* The normal of the facet whose plane is farthest inwards; one loop over the points for each, which
 * compilers vectorise. */
static void facet_gradient(void *user, size_t n, const float *restrict x, const float *restrict y,
                           const float *restrict z, float *restrict gradient_x,
                           float *restrict gradient_y, float *restrict gradient_z) {
    const glass_world *const world = user;
    float greatest[SPT_BATCH];
    for (size_t i = 0; i < n; ++i) greatest[i] = -FLT_MAX;
    for (size_t facet = 0; facet < world->facet_count; ++facet) {
        const spt_bound_plane plane = world->facets[facet];
        for (size_t i = 0; i < n; ++i) {
            const float height = plane.normal[0] * x[i] + plane.normal[1] * y[i] +
                                 plane.normal[2] * z[i] - plane.offset;
            const int ahead = height > greatest[i];
            greatest[i] = ahead ? height : greatest[i];
            gradient_x[i] = ahead ? plane.normal[0] : gradient_x[i];
            gradient_y[i] = ahead ? plane.normal[1] : gradient_y[i];
            gradient_z[i] = ahead ? plane.normal[2] : gradient_z[i];
        }
    }
}

spt_field glass_world_field(glass_world *world, int lanes) {
    spt_field field = scene_field(world->body, lanes);
    if (world->facet_count > 0) {
        field.gradient = facet_gradient;
        field.user = world; /* the scenes' own callbacks have no use for it */
    }
    return field;
}

glass_world glass_furnace(const glass_world *world, glass_ball *balls) {
    glass_world furnace = *world;
    for (int i = 0; i < world->ball_count; ++i) {
        balls[i] = world->balls[i];
        for (int c = 0; c < 3; ++c) {
            balls[i].material.colour[c] = 1.0f;
            balls[i].material.absorption[c] = 0.0f;
        }
        if (balls[i].material.surface == GLASS_MATT) balls[i].material.surface = GLASS_MIRROR;
    }
    for (int c = 0; c < 3; ++c) furnace.body_material.absorption[c] = 0.0f;
    furnace.balls = balls;
    furnace.has_ground = 0;
    furnace.furnace = 1;
    return furnace;
}

/* In the centre form, which keeps its digits far from the ball (Haines et al. 2019, Ray Tracing
 * Gems, chapter 7). */
static float meet_ball(const glass_ball *ball, const float origin[3], const float direction[3],
                       int is_inside) {
    float along = 0.0f, square = 0.0f, to_center[3];
    for (int axis = 0; axis < 3; ++axis) {
        to_center[axis] = ball->center[axis] - origin[axis];
        along += to_center[axis] * direction[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        const float across = to_center[axis] - along * direction[axis];
        square += across * across;
    }
    const float half_chord_square = ball->radius * ball->radius - square;
    if (is_inside) return spt_greatest(along + sqrtf(spt_greatest(half_chord_square, 0.0f)), 0.0f);
    if (!(half_chord_square > 0.0f)) return INFINITY;
    const float t = along - sqrtf(half_chord_square);
    return t > 0.0f ? t : INFINITY;
}

float glass_meet(const glass_world *world, const float origin[3], const float direction[3],
                 int from, int inside, int *object) {
    float nearest = INFINITY;
    *object = GLASS_NOTHING;
    if (inside >= 0) {
        *object = inside;
        return meet_ball(&world->balls[inside], origin, direction, 1);
    }
    for (int i = 0; i < world->ball_count; ++i) {
        const float t =
            i != from ? meet_ball(&world->balls[i], origin, direction, 0) : (float)INFINITY;
        if (!(t < nearest)) continue;
        nearest = t;
        *object = i;
    }
    if (world->has_ground && from != GLASS_GROUND) {
        const float over = origin[1] - world->ground;
        const float t = !(over > 0.0f)        ? 0.0f
                        : direction[1] < 0.0f ? over / -direction[1]
                                              : (float)INFINITY;
        if (t < nearest) {
            nearest = t;
            *object = GLASS_GROUND;
        }
    }
    return nearest;
}

void glass_world_normal(const glass_world *world, int object, const float point[3],
                        float normal[3]) {
    normal[0] = normal[2] = 0.0f;
    normal[1] = 1.0f;
    if (object < 0) return;
    const glass_ball *const ball = &world->balls[object];
    for (int axis = 0; axis < 3; ++axis) {
        normal[axis] = (point[axis] - ball->center[axis]) / ball->radius;
    }
}
