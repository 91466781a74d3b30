/* SPDX-License-Identifier: MIT
 *
 * Far and enormous worlds, where culling and cones were once wrong: they must change nothing
 * though coordinates are a million times the body's size, and as far as rays are traced at all. */
#include "test_frame_cases.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { square = 64, square_pixels = square * square };

static spt_hit right[square_pixels], seen[square_pixels];

/* All widths, one method, one form: what frames do by themselves is the same for all. */
static int is_chosen(const stress_way *way) {
    return way->method == spt_basic() && !way->point;
}

#define FOR_EACH_WIDTH \
    stress_way way = stress_ways(STRESS_OWN_RAYS); \
    stress_next(&way);

/* ---- One body --------------------------------------------------------------------------------- */

typedef struct box {
    double center[3], half[3];
} box;

static float box_distance(const void *data, float x, float y, float z) {
    const box *const body = data;
    const double point[3] = {(double)x, (double)y, (double)z};
    double outside = 0.0, inside = -DBL_MAX;
    for (int axis = 0; axis < 3; ++axis) {
        const double beyond = fabs(point[axis] - body->center[axis]) - body->half[axis];
        if (beyond > 0.0) outside += beyond * beyond;
        inside = fmax(inside, beyond);
    }
    return (float)(outside > 0.0 ? sqrt(outside) : inside);
}

/* A single body and a square picture of it. */
typedef struct lone {
    union_part part;
    spt_field field;
    spt_bound bound;
    spt_scene scene;
    spt_camera camera;
    spt_frame frame;
    spt_statistics statistics;
} lone;

static void lone_body(lone *world, const stress_way *way, stress_distance_fn *distance,
                      const void *data, int bounded) {
    world->part = union_part_of(distance, data);
    world->field = union_field(way, &world->part);
    world->field.bound = bounded ? &world->bound : NULL;
    world->scene = spt_scene_default();
    world->scene.fields = &world->field;
    world->scene.count = 1;
}

static void lone_frame(lone *world, const stress_way *way, uint32_t side) {
    CHECK(spt_frame_init(&world->frame, &world->scene, &world->camera, side, side) == SPT_OK);
    world->frame.settings.method = way->method;
    world->frame.settings.max_lanes = way->lanes;
    world->frame.settings.budget = 1000;
    world->frame.statistics = &world->statistics;
}

static void lone_trace(lone *world, uint32_t flags, spt_hit *hits) {
    const spt_hits image = spt_hits_of(hits);
    world->statistics = spt_statistics_default();
    world->frame.flags = flags;
    world->frame.workspace_size = spt_frame_workspace(&world->frame);
    world->frame.workspace = malloc(world->frame.workspace_size);
    CHECK(world->frame.workspace != NULL && spt_frame_tiles(&world->frame) == 1);
    memset(hits, 0xa5, (size_t)world->frame.width * world->frame.height * sizeof *hits);
    CHECK(spt_frame_tile(&world->frame, 0, &image) == SPT_OK);
    CHECK(world->part.faults == 0);
    free(world->frame.workspace);
}

/* ---- Far from the origin ---------------------------------------------------------------------- */

/* A box with corners among the few floats there are, looked at from some way off. */
static void draw_far_box(lone *world, box *body, int orthographic) {
    static const float up[3] = {0.0f, 1.0f, 0.0f};
    const double far = 4e6, away = check_uniform(10.0, 100.0);
    float low[3], high[3], eye[3], target[3];
    double direction[3], length = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double center = check_uniform(-far, far), half = check_uniform(0.2, 1.2);
        low[axis] = (float)(center - half);
        high[axis] = (float)(center + half);
        body->center[axis] = 0.5 * ((double)low[axis] + (double)high[axis]);
        body->half[axis] = 0.5 * ((double)high[axis] - (double)low[axis]);
        target[axis] = (float)center;
        direction[axis] = check_uniform(-1.0, 1.0);
        length += direction[axis] * direction[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        eye[axis] = (float)((double)target[axis] - direction[axis] / sqrt(length) * away);
    }
    world->bound = spt_bound_box(low[0], low[1], low[2], high[0], high[1], high[2]);
    CHECK((orthographic
               ? spt_camera_orthographic(&world->camera, eye, target, up, 1.5f, square, square)
               : spt_camera_pinhole(&world->camera, eye, target, up, 0.03f, square, square)) ==
          SPT_OK);
}

/* Whether what the bounds of tiles and blocks leave out changes a bit. Counts hits and misses. */
static void expect_culling_to_be_silent(lone *world, const stress_way *way, const char *what,
                                        uint64_t outcomes[SPT_OUTCOMES]) {
    lone_frame(world, way, square);
    world->frame.settings.epsilon = 1e-4f;
    world->frame.settings.pixel_radius = 0.0f;
    lone_trace(world, SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING, right);
    for (int i = 0; i < SPT_OUTCOMES; ++i) outcomes[i] += world->statistics.outcomes[i];
    lone_trace(world, SPT_FRAME_NO_CONES, seen);
    const size_t differ = frame_differing(seen, right, square_pixels);
    CHECK_SAY(differ == 0, "%s: %u pixels differ", what, (unsigned)differ);
}

/* Coordinates a million times the body's size. */
static void far_culling_of_boxes(void) {
    for (FOR_EACH_WIDTH) {
        if (!is_chosen(&way)) continue;
        for (int orthographic = 0; orthographic < 2; ++orthographic) {
            uint64_t outcomes[SPT_OUTCOMES] = {0, 0, 0, 0, 0};
            for (int trial = 0; trial < 12; ++trial) {
                lone world;
                box body;
                draw_far_box(&world, &body, orthographic);
                lone_body(&world, &way, box_distance, &body, 1);
                expect_culling_to_be_silent(&world, &way, orthographic ? "orthographic" : "pinhole",
                                            outcomes);
            }
            CHECK(outcomes[SPT_HIT] > 0 && outcomes[SPT_MISS] > 0);
        }
    }
}

/* Parallel rays whose origins are rounded to a quarter, past a ball of 0.7. */
static void far_parallel_rays(void) {
    static const stress_sphere ball = {{-2982834.0f, -1281128.0f, -3205594.0f}, 0.7f};
    static const float eye[3] = {-2982831.0f, -1281131.5f, -3205590.75f}, up[3] = {0, 1, 0};
    for (FOR_EACH_WIDTH) {
        uint64_t outcomes[SPT_OUTCOMES] = {0, 0, 0, 0, 0};
        lone world;
        if (!is_chosen(&way)) continue;
        world.bound = spt_bound_sphere(ball.center[0], ball.center[1], ball.center[2], ball.radius);
        CHECK(spt_camera_orthographic(&world.camera, eye, ball.center, up, 3.0f, square, square) ==
              SPT_OK);
        lone_body(&world, &way, stress_sphere_distance, &ball, 1);
        expect_culling_to_be_silent(&world, &way, "ball", outcomes);
        CHECK(outcomes[SPT_HIT] > 0 && outcomes[SPT_MISS] > 0);
    }
}

/* ---- Near the largest number ------------------------------------------------------------------ */

static float plane_ahead(const void *data, float x, float y, float z) {
    (void)x, (void)y;
    return *(const float *)data - z;
}

/* All rays hit, with cones as without, at most so many tolerances from where they should. */
static void expect_all_hit(lone *world, const stress_way *way, double (*truth)(const spt_ray *),
                           double tolerances) {
    lone_frame(world, way, square);
    for (uint32_t flags = 0; flags < 4; ++flags) {
        size_t far = 0;
        lone_trace(world, flags, seen);
        CHECK_SAY(world->statistics.outcomes[SPT_HIT] == square_pixels, "flags %u: %u hits",
                  (unsigned)flags, (unsigned)world->statistics.outcomes[SPT_HIT]);
        for (size_t i = 0; i < square_pixels; ++i) {
            const float x = (float)(i % square) + 0.5f, y = (float)(i / square) + 0.5f;
            spt_camera_ray ray;
            stress_case what = stress_case_of(world->part.distance, world->part.data);
            what.bound = world->field.bound;
            what.settings = world->frame.settings;
            CHECK(spt_camera_rays(&world->camera, square, square, 1, &x, &y, &ray) == SPT_OK);
            what.ray = ray.ray;
            const double t = truth(&ray.ray);
            far += !(fabs((double)seen[i].t - t) <= tolerances * stress_tolerance(&what, (float)t));
        }
        CHECK_SAY(far == 0, "flags %u: %u hits elsewhere", (unsigned)flags, (unsigned)far);
    }
}

static const float plane_at = 6e37f;

static double plane_truth(const spt_ray *ray) {
    return (double)plane_at / (double)ray->direction[2];
}

/* As far as rays are traced cones must go, too. The ray comes along the normal within 1e-4, so a
 * hit is within a tolerance of the plane, and the position was rounded by less than another. */
static void far_plane_at_the_end_of_the_world(void) {
    static const float eye[3] = {0.0f, 0.0f, 0.0f}, target[3] = {0.0f, 0.0f, 1.0f};
    static const float up[3] = {0.0f, 1.0f, 0.0f};
    for (FOR_EACH_WIDTH) {
        lone world;
        if (!is_chosen(&way)) continue;
        CHECK(spt_camera_pinhole(&world.camera, eye, target, up, 0.01f, square, square) == SPT_OK);
        lone_body(&world, &way, plane_ahead, &plane_at, 0);
        expect_all_hit(&world, &way, plane_truth, 2.001);
    }
}

static const box huge = {{9e18, 9e18, 9e18}, {1e17, 1e17, 1e17}};

static double huge_truth(const spt_ray *ray) {
    double t = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = huge.center[axis] - huge.half[axis];
        t = fmax(t, (low - (double)ray->origin[axis]) / (double)ray->direction[axis]);
    }
    return t;
}

/* Squares of such distances overflow. Rays come to the corner along the diagonal within 0.002, so
 * that each of the three planes is met at a cosine above 0.57. */
static void far_box_whose_square_overflows(void) {
    static const float eye[3] = {-9e18f, -9e18f, -9e18f}, target[3] = {0.0f, 0.0f, 0.0f};
    static const float up[3] = {0.0f, 1.0f, 0.0f};
    for (FOR_EACH_WIDTH) {
        lone world;
        if (!is_chosen(&way)) continue;
        world.bound = spt_bound_box(8.8e18f, 8.8e18f, 8.8e18f, 9.2e18f, 9.2e18f, 9.2e18f);
        CHECK(spt_camera_pinhole(&world.camera, eye, target, up, 0.001f, square, square) == SPT_OK);
        lone_body(&world, &way, box_distance, &huge, 1);
        expect_all_hit(&world, &way, huge_truth, 2.0 / 0.57);
    }
}

/* Callbacks see finite points (counted as faults of the part), even where cones begin near the
 * largest number. */
static void far_points_stay_finite(void) {
    static const float step = 1e37f, eyes[] = {1.6e38f, 1.8e38f, 3.3e38f, FLT_MAX};
    static const float target[3] = {1.0f, 0.0f, 0.0f}, up[3] = {0.0f, 1.0f, 0.0f};
    static const float origin[3] = {0.0f, 0.0f, 0.0f};
    for (FOR_EACH_WIDTH) {
        for (size_t k = 0; is_chosen(&way) && k < sizeof eyes / sizeof *eyes; ++k) {
            lone world;
            CHECK(spt_camera_pinhole(&world.camera, origin, target, up, 0.01f, square, square) ==
                  SPT_OK);
            world.camera.eye[0] = eyes[k];
            lone_body(&world, &way, stress_constant_distance, &step, 0);
            lone_frame(&world, &way, square);
            for (uint32_t flags = 0; flags < 4; ++flags) {
                lone_trace(&world, flags, seen);
                CHECK(world.statistics.outcomes[SPT_MISS] == square_pixels);
            }
            CHECK(world.part.points > 0);
        }
    }
}

void suite_frame_far(void) {
    RUN(far_culling_of_boxes);
    RUN(far_parallel_rays);
    RUN(far_plane_at_the_end_of_the_world);
    RUN(far_box_whose_square_overflows);
    RUN(far_points_stay_finite);
}
