/* SPDX-License-Identifier: MIT
 *
 * Fields in bounding volumes of every kind: rays begin where spt_bound_interval() says, with the
 * same bits at every width, scenes give what their components give alone, frames lose nothing; and
 * boxes around volumes, and cones that may meet them. */
#include "bounds_volume.h"
#include "frame_views.h"
#include "frame_worlds.h"
#include "scene_draw.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <string.h>

enum { first_kind = SPT_BOUND_SPHERE, last_kind = SPT_BOUND_CALLBACK };

static float nowhere(void *user, float x, float y, float z) {
    (void)user;
    (void)x;
    (void)y;
    (void)z;
    return 1;
}

/* ---- One field ------------------------------------------------------------------------------ */

enum { begun_rays = 37 };

/* Through the boundary of the volume, or towards some point of the box that it holds. */
static void draw_begun_ray(const volume *self, int around, double scale, int i, spt_ray *ray) {
    if (!around) volume_ray(self, ray->origin, ray->direction);
    for (int axis = 0; axis < 3 && around; ++axis) {
        const double target = self->middle[axis] + check_uniform(-1, 1) * scale;
        ray->origin[axis] = (float)check_uniform(-scale, scale);
        ray->direction[axis] = (float)(target - (double)ray->origin[axis]);
    }
    ray->t_min = i % 3 == 0 ? (float)check_uniform(0, 2) : 0;
    ray->t_max = i % 5 == 0 ? (float)check_uniform(0, 4) : (float)INFINITY;
}

/* Returns how many rays are in the volume. */
static int check_begun(const volume *self, const spt_ray *ray, const spt_hit *hit) {
    int met = 0;
    for (int i = 0; i < begun_rays; ++i) {
        float entry, exit;
        CHECK(spt_bound_interval(&self->bound, ray[i].origin, ray[i].direction, ray[i].t_min,
                                 ray[i].t_max, &entry, &exit) == SPT_OK);
        CHECK_SAY(check_same_bits(hit[i].t, entry) &&
                      hit[i].outcome == (entry <= exit ? SPT_LIMIT : SPT_MISS),
                  "ray %d begins at %.9g, enters at %.9g", i, (double)hit[i].t, (double)entry);
        met += entry <= exit;
    }
    return met;
}

/* Rays that are out of budget before their first sample stay where they begin. */
static void Q20_rays_begin_where_intervals_do(void) {
    enum { volumes = 24 };
    static volume self;
    static spt_ray ray[begun_rays];
    static spt_hit hit[begun_rays];
    const spt_rays from = spt_rays_of(ray);
    const spt_hits to = spt_hits_of(hit);
    spt_settings settings = spt_settings_default();
    spt_field field = spt_field_default();
    field.point = nowhere;
    field.bound = &self.bound;
    settings.budget = 0;
    for (int k = first_kind; k <= last_kind; ++k) {
        int met = 0;
        for (int i = 0; i < volumes; ++i) {
            const int around = k == SPT_BOUND_CALLBACK || i % 2 == 0;
            const double scale = volume_magnitude(3);
            const float low[3] = {(float)-scale, (float)-scale, (float)(2 * scale)};
            const float high[3] = {(float)scale, (float)(0.5 * scale), (float)(4 * scale)};
            if (around) volume_around(&self, (spt_bound_kind)k, low, high);
            if (!around) volume_draw(&self, (spt_bound_kind)k, scale);
            for (int j = 0; j < begun_rays; ++j) {
                draw_begun_ray(&self, around, scale, j, &ray[j]);
            }
            for (int lanes = 0; lanes < width_count; ++lanes) {
                settings.max_lanes = widths[lanes];
                check_context("kind %d, volume %d, %u lanes", k, i, widths[lanes]);
                CHECK(spt_trace(&field, &settings, begun_rays, &from, &to, NULL) == SPT_OK);
                met += check_begun(&self, ray, hit);
            }
        }
        CHECK_SAY(met > volumes * begun_rays * width_count / 8, "kind %d: %d met", k, met);
    }
}

/* ---- Scenes --------------------------------------------------------------------------------- */

/* Every bound becomes one of another kind that holds it. */
static void exchange_bounds(drawn_scene *made, volume *volumes, int first) {
    for (size_t i = 0; i < made->scene.count; ++i) {
        float low[3], high[3];
        if (made->fields[i].bound == NULL) continue;
        CHECK(spt_bound_extent(made->fields[i].bound, low, high) == SPT_OK);
        const int kind = first_kind + ((int)i + first) % last_kind;
        volume_around(&volumes[i], (spt_bound_kind)kind, low, high);
        made->fields[i].bound = &volumes[i].bound;
    }
}

static void Q23_bounds_of_every_kind_as_if_alone(void) {
    enum { draws = 5, rays = 80 };
    static drawn_scene made;
    static volume volumes[drawn_components];
    static scene_ray ray[rays];
    static scene_expected expected[rays];
    static spt_hit hit[rays];
    char title[] = "bounds of every kind";
    int hits = 0;
    for (int draw = 0; draw < draws; ++draw) {
        spt_settings settings = scene_draw_settings();
        scene_draw(&made, 18, draw % 2 == 0 ? 0 : DRAW_UNITED);
        exchange_bounds(&made, volumes, draw);
        for (int i = 0; i < rays; ++i) {
            ray[i] = scene_draw_ray();
            if (i % 11 == 0) ray[i].active = 0;
            if (i % 11 == 0 || i % 13 == 0) ray[i].ray.origin[1] = NAN;
        }
        if (draw % 3 == 1) settings.flags |= SPT_SKIP_START;
        for (scene_rules walk = scene_first_rule(&made.scene, title); scene_next_rule(&walk);) {
            settings.method = walk.method;
            settings.max_lanes = 0;
            scene_expect(&made.scene, &settings, rays, ray, expected);
            for (int width = 0; width < width_count; ++width) {
                if (width_run(widths[width]) != (int)widths[width]) continue;
                settings.max_lanes = widths[width];
                memset(hit, 0xa5, sizeof hit);
                scene_run(&made.scene, &settings, rays, ray, hit);
                scene_check(&made.scene, &settings, rays, ray, expected, hit);
            }
            for (int i = 0; i < rays; ++i) {
                hits += ray[i].active != 0 && hit[i].outcome == SPT_HIT;
            }
        }
    }
    CHECK_SAY(hits > 500, "%d hits", hits);
}

/* ---- Frames --------------------------------------------------------------------------------- */

enum { width = 40, height = 30 };
static spt_camera_ray rays_of_frame[width * height];
static spt_hit plain[width * height], culled[width * height], sent[width * height];

/* Where the truth is decided, cones change neither outcome nor place. */
static int check_clear(const spt_frame *frame, const world *shape, const spt_hit *given) {
    int hits = 0;
    for (size_t pixel = 0; pixel < frame_pixels(frame); ++pixel) {
        const world_hit truth = world_trace(shape, &rays_of_frame[pixel].ray);
        if (!(truth.gap > 0.02)) continue;
        hits += truth.t < 50;
        CHECK_SAY(
            given[pixel].outcome == (truth.t <= 50 ? SPT_HIT : SPT_MISS) &&
                (given[pixel].outcome != SPT_HIT || fabs((double)given[pixel].t - truth.t) < 0.05),
            "pixel %g %g: outcome %d at %g, truth %g", frame_x(frame, pixel), frame_y(frame, pixel),
            given[pixel].outcome, (double)given[pixel].t, truth.t);
    }
    return hits;
}

static void Q15_bounds_of_every_kind_in_frames(void) {
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, 8};
    static volume volumes[ball_parts];
    int hits = 0;
    for (int i = 0; i < 27; ++i) {
        const world shape = world_draw();
        ball_scene balls;
        spt_frame frame;
        spt_camera camera =
            camera_draw(i % 2 == 0 ? SPT_CAMERA_PINHOLE : SPT_CAMERA_ORTHOGRAPHIC,
                        check_random() % CAMERA_VARIANTS, eye, target, 0.5, 0.6, 4.0 / 3);
        camera.t_max = 50;
        ball_scene_of(&balls, &shape, ~0u, check_random());
        for (size_t part = 0; part < balls.scene.count; ++part) {
            float low[3], high[3];
            const int kind = first_kind + (i + (int)part) % last_kind;
            if (balls.fields[part].bound == NULL) continue;
            CHECK(spt_bound_extent(balls.fields[part].bound, low, high) == SPT_OK);
            volume_around(&volumes[part], (spt_bound_kind)kind, low, high);
            balls.fields[part].bound = &volumes[part].bound;
        }
        check_context("world %d", i);
        CHECK(spt_frame_init(&frame, &balls.scene, &camera, width, height) == SPT_OK);
        frame.settings.budget = 2000;
        frame.settings.epsilon = 1e-4f;
        frame.settings.pixel_radius = 1e-5f;
        frame.settings.max_lanes = widths[i % width_count];
        frame_lend_workspace(&frame);
        frame_rays(&frame, rays_of_frame);
        frame_plain(&frame, rays_of_frame, plain);
        frame_trace(&frame, SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING, culled);
        frame_same(&frame, culled, plain, "plain");
        frame_trace(&frame, SPT_FRAME_NO_CONES, culled);
        frame_same_answer(&frame, culled, plain, "culled");
        frame_trace(&frame, SPT_FRAME_NO_CULLING, culled);
        frame_trace(&frame, 0, sent);
        frame_same_answer(&frame, sent, culled, "cones, culled");
        hits += check_clear(&frame, &shape, sent);
        for (int lanes = 0; lanes < width_count; ++lanes) {
            frame.settings.max_lanes = widths[lanes];
            frame_trace(&frame, 0, culled);
            frame_same(&frame, culled, sent, "width");
        }
    }
    CHECK_SAY(hits > 1000, "%d hits", hits);
}

/* ---- Boxes and cones ------------------------------------------------------------------------ */

/* Each side of the box is where the volume's largest coordinate is, and not within, but for the
 * last place of a sphere's, which is rounded to the nearest. */
static void Q20_boxes_around_every_kind(void) {
    static volume self;
    for (int k = first_kind; k < SPT_BOUND_SLAB; ++k) {
        const double within = k == SPT_BOUND_SPHERE ? 0x1p-24 : 1e-12;
        for (int i = 0; i < 300; ++i) {
            float low[3], high[3];
            volume_draw(&self, (spt_bound_kind)k, volume_magnitude(3));
            CHECK(spt_bound_extent(&self.bound, low, high) == SPT_OK);
            for (int side = 0; side < 6; ++side) {
                const int axis = side % 3, up = side >= 3;
                const float end = up ? high[axis] : low[axis];
                const double extent = fabs((double)low[axis]) + fabs((double)high[axis]);
                const double far = volume_support(&self.bound, axis, up ? 1 : -1);
                CHECK_SAY((up ? far - (double)end : (double)end - far) <= within * extent,
                          "kind %d, volume %d: side %d at %.9g, %.12g", k, i, side, (double)end,
                          far);
                CHECK_SAY(fabs((double)end - far) <= 0x1p-22 * extent,
                          "kind %d, volume %d: side %d at %.9g, %.12g", k, i, side, (double)end,
                          far);
            }
        }
    }
}

/* The least distance of a cone's points from the middle of a sphere, over rays all around it. */
static double least_apart(const double middle[3], const double d[3], double chord, double t_max) {
    double least = HUGE_VAL, across[3] = {0, 0, 0}, other[3];
    across[fabs(d[0]) < 0.6 ? 0 : 1] = 1;
    camera_cross(d, across, other);
    camera_unit(other);
    camera_cross(other, d, across);
    for (int ring = 0; ring <= 40; ++ring) {
        const double angle = 2 * asin(0.5 * chord) * ring / 40;
        for (int turn = 0; turn < 90; ++turn) {
            const double x = sin(angle) * cos(turn * 0.0698131700797732);
            const double y = sin(angle) * sin(turn * 0.0698131700797732);
            double along = 0, apart = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const double ray = cos(angle) * d[axis] + x * across[axis] + y * other[axis];
                along += ray * middle[axis];
            }
            along = fmin(fmax(along, 0), t_max);
            for (int axis = 0; axis < 3; ++axis) {
                const double ray = cos(angle) * d[axis] + x * across[axis] + y * other[axis];
                apart += (along * ray - middle[axis]) * (along * ray - middle[axis]);
            }
            least = fmin(least, sqrt(apart));
        }
    }
    return least;
}

static void Q20_spheres_and_cones(void) {
    int counts[2] = {0, 0};
    for (int i = 0; i < 500; ++i) {
        const float o[3] = {(float)check_uniform(-9, 9), 1, 2};
        const float chord = i % 7 == 0 ? 0 : (float)pow(10, check_uniform(-3, -0.01));
        const float t_max = i % 3 == 0 ? (float)INFINITY : (float)check_uniform(0, 6);
        const double factor = volume_magnitude(3);
        float d[3];
        double unit[3], middle[3];
        int meets = 7;
        for (int axis = 0; axis < 3; ++axis) {
            d[axis] = (float)(check_uniform(-1, 1) * factor);
            unit[axis] = (double)d[axis];
            middle[axis] = check_uniform(-4, 4);
        }
        const double length = sqrt(camera_dot(unit, unit));
        camera_unit(unit);
        spt_bound ball = spt_bound_sphere(o[0] + (float)middle[0], o[1] + (float)middle[1],
                                          o[2] + (float)middle[2], 1);
        for (int axis = 0; axis < 3; ++axis) {
            middle[axis] = (double)ball.center[axis] - (double)o[axis];
        }
        const float last = t_max / (float)length;
        const double apart = least_apart(middle, unit, (double)chord, (double)last * length);
        /* The rays lie so dense that none of the cone's points is farther from one than this. */
        const double step = 0.035 * (double)chord * sqrt(camera_dot(middle, middle)) + 1e-9;
        ball.radius = (float)(apart + (i % 2 == 0 ? 1e-5 + 1e-7 * apart : -step - 1e-5));
        if (!(ball.radius > 0)) continue;
        CHECK(spt_bound_meets_cone(&ball, o, d, chord, last, &meets) == SPT_OK);
        CHECK_SAY(meets == (i % 2 == 0), "cone %d: meets %d, apart %.9g, radius %.9g", i, meets,
                  apart, (double)ball.radius);
        ++counts[i % 2];
    }
    CHECK_SAY(counts[0] > 100 && counts[1] > 100, "%d met, %d not", counts[0], counts[1]);
}

/* A volume that some ray of the cone meets is never said not to be met. */
static void Q20_every_kind_and_cones(void) {
    static volume self;
    for (int k = first_kind; k <= last_kind; ++k) {
        int met = 0, missed = 0;
        for (int i = 0; i < 300; ++i) {
            const float low[3] = {-1, -0.5f, 5}, high[3] = {1, 1, 7};
            const float o[3] = {0, 0, 0};
            const float axis[3] = {(float)check_uniform(-0.8, 0.8), (float)check_uniform(-0.8, 0.8),
                                   1};
            const float chord = (float)check_uniform(0, 0.5), t_max = (float)check_uniform(1, 9);
            double d[3] = {(double)axis[0], (double)axis[1], (double)axis[2]};
            const double length = sqrt(camera_dot(d, d));
            int meets = 7;
            camera_unit(d);
            volume_around(&self, (spt_bound_kind)k, low, high);
            CHECK(spt_bound_meets_cone(&self.bound, o, axis, chord, t_max, &meets) == SPT_OK);
            missed += !meets;
            for (int ray = 0; ray < 8; ++ray) {
                float along[3], entry, exit;
                double turned[3], apart = 0;
                for (int j = 0; j < 3; ++j) {
                    turned[j] = d[j] + check_uniform(-0.5, 0.5) * (double)chord;
                }
                camera_unit(turned);
                for (int j = 0; j < 3; ++j) {
                    along[j] = (float)turned[j];
                    apart += (turned[j] - d[j]) * (turned[j] - d[j]);
                }
                if (sqrt(apart) > (double)chord) continue;
                CHECK(spt_bound_interval(&self.bound, o, along, 0, t_max * (float)length, &entry,
                                         &exit) == SPT_OK);
                if (!(entry <= exit)) continue;
                ++met;
                CHECK_SAY(meets, "kind %d, cone %d: a ray meets it at %g", k, i, (double)entry);
            }
        }
        CHECK_SAY(met > 20, "kind %d: %d rays met", k, met);
        CHECK_SAY(missed > 10 || k >= SPT_BOUND_SLAB, "kind %d: %d cones missed", k, missed);
    }
}

static void Q20_bad_cones(void) {
    const spt_bound ball = spt_bound_sphere(0, 0, 5, 1);
    const float o[3] = {0, 0, 0}, d[3] = {0, 0, 1}, none[3] = {0, 0, 0}, bad[3] = {0, NAN, 1};
    int meets = 7;
    CHECK(spt_bound_meets_cone(NULL, o, d, 0, 1, &meets) == SPT_BAD_ARGUMENT);
    CHECK(spt_bound_meets_cone(&ball, NULL, d, 0, 1, &meets) == SPT_BAD_ARGUMENT);
    CHECK(spt_bound_meets_cone(&ball, o, NULL, 0, 1, &meets) == SPT_BAD_ARGUMENT);
    CHECK(spt_bound_meets_cone(&ball, o, d, 0, 1, NULL) == SPT_BAD_ARGUMENT);
    CHECK(spt_bound_meets_cone(&ball, o, none, 0, 1, &meets) == SPT_BAD_ARGUMENT);
    CHECK(spt_bound_meets_cone(&ball, bad, d, 0, 1, &meets) == SPT_BAD_ARGUMENT);
    CHECK(spt_bound_meets_cone(&ball, o, bad, 0, 1, &meets) == SPT_BAD_ARGUMENT);
    CHECK(spt_bound_meets_cone(&ball, o, d, -0.1f, 1, &meets) == SPT_BAD_ARGUMENT);
    CHECK(spt_bound_meets_cone(&ball, o, d, 1, 1, &meets) == SPT_BAD_ARGUMENT);
    CHECK(spt_bound_meets_cone(&ball, o, d, NAN, 1, &meets) == SPT_BAD_ARGUMENT);
    CHECK(spt_bound_meets_cone(&ball, o, d, 0, NAN, &meets) == SPT_BAD_ARGUMENT);
    CHECK(meets == 7);
    CHECK(spt_bound_meets_cone(&ball, o, d, 0, -1, &meets) == SPT_OK && meets == 0);
    CHECK(spt_bound_meets_cone(&ball, o, d, 0, 3.9f, &meets) == SPT_OK && meets == 0);
    CHECK(spt_bound_meets_cone(&ball, o, d, 0, 4, &meets) == SPT_OK && meets == 1);
}

void suite_bounds_traced(void) {
    RUN(Q20_rays_begin_where_intervals_do);
    RUN(Q23_bounds_of_every_kind_as_if_alone);
    RUN(Q15_bounds_of_every_kind_in_frames);
    RUN(Q20_boxes_around_every_kind);
    RUN(Q20_spheres_and_cones);
    RUN(Q20_every_kind_and_cones);
    RUN(Q20_bad_cones);
}
