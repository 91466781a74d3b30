/* SPDX-License-Identifier: MIT
 *
 * Secondary rays as passes: a camera whose callback makes the shadow ray of a pixel from its hit,
 * at full and at a quarter of the resolution, against a slow walk in double. */
#include "frame_advance.h"
#include "../check.h"

#include <math.h>
#include <string.h>

enum { width = 48, height = 36, pixels = width * height, coarse = 4 };

static view shown_view;
static spt_camera_ray primary[pixels], rays[pixels];
static spt_hit seen[pixels], shadow[pixels], others[pixels];
static ray_truth truths[pixels];

/* The shadow rays of the primary hits. scale: pixels of the primary image on a side of one here. */
typedef struct shadow_camera {
    const view *primary;
    const spt_camera_ray *rays;
    const spt_hit *hits;
    float light[3];
    float scale;
} shadow_camera;

static double distance_at(const view *v, const double p[3]) {
    double f;
    v->shown->reference(1, &p[0], &p[1], &p[2], &f);
    return f;
}

/* From a fiftieth before the hit along the normal, by central differences in double. */
static void shadow_ray(const shadow_camera *from, size_t pixel, spt_camera_ray *ray) {
    const spt_ray *first = &from->rays[pixel].ray;
    const double t = (double)from->hits[pixel].t;
    double p[3], normal[3], square = 0, length = 0, to_light[3];
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = (double)first->origin[axis] + t * (double)first->direction[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        double ahead[3], behind[3];
        memcpy(ahead, p, sizeof p);
        memcpy(behind, p, sizeof p);
        ahead[axis] += 1e-3;
        behind[axis] -= 1e-3;
        normal[axis] =
            (double)distance_at(from->primary, ahead) - (double)distance_at(from->primary, behind);
        square += normal[axis] * normal[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] += 0.02 * normal[axis] / sqrt(square);
        to_light[axis] = (double)from->light[axis] - p[axis];
        length += to_light[axis] * to_light[axis];
    }
    length = sqrt(length);
    for (int axis = 0; axis < 3; ++axis) {
        ray->ray.origin[axis] = (float)p[axis];
        ray->ray.direction[axis] = (float)(to_light[axis] / length);
    }
    ray->ray.t_max = (float)length;
    ray->path = from->hits[pixel].t;
}

static void shadow_rays(void *user, size_t count, const float *x, const float *y,
                        spt_camera_ray *to) {
    const shadow_camera *from = user;
    for (size_t i = 0; i < count; ++i) {
        const size_t column = (size_t)(x[i] * from->scale), row = (size_t)(y[i] * from->scale);
        const size_t pixel = row * width + column;
        if (from->hits[pixel].outcome == SPT_HIT) {
            shadow_ray(from, pixel, &to[i]);
        } else {
            to[i].active = 0;
        }
    }
}

typedef struct shadow_case {
    shadow_camera lens;
    spt_camera camera;
    spt_frame frame;
} shadow_case;

/* The primary picture, and a frame of shadow rays at a part of its resolution. */
static void open_case(shadow_case *c, const char *name, uint32_t scale) {
    static const float light[3] = {14, 22, 12};
    view_of(&shown_view, scene_named(name), SCENE_OBJECTS, 55, width, height);
    frame_rays(&shown_view.frame, primary);
    /* Primary hits must lie nearer to the surface than the shadow rays' start. */
    shown_view.frame.settings.pixel_radius = 0;
    frame_trace(&shown_view.frame, 0, seen);
    c->lens.primary = &shown_view;
    c->lens.rays = primary;
    c->lens.hits = seen;
    c->lens.scale = (float)scale;
    memcpy(c->lens.light, light, sizeof light);
    c->camera = spt_camera_of_rays(shadow_rays, &c->lens);
    CHECK(spt_frame_init(&c->frame, &shown_view.parts.scene, &c->camera, width / scale,
                         height / scale) == SPT_OK);
    CHECK(check_same_bits(c->frame.settings.pixel_radius, 0));
    c->frame.settings.budget = 2000;
    frame_lend_workspace(&c->frame);
    frame_rays(&c->frame, rays);
}

/* In shadow iff the walk in double meets something; rays that pass something by no more than three
 * tolerances or enter it no deeper than one are not clear, and are left out. */
static void judge(const shadow_case *c, const spt_hit *results, const char *what) {
    const truth_field field = truth_of_scene(shown_view.shown);
    size_t in_shadow = 0, lit = 0, unclear = 0;
    for (size_t i = 0; i < frame_pixels(&c->frame); ++i) {
        if (rays[i].active == 0) {
            CHECK(frame_is_blank(&results[i]));
            continue;
        }
        CHECK_SAY(truth_judge(&field, &c->frame.settings, &rays[i].ray, (double)rays[i].path,
                              &truths[i], &results[i]) == TRUTH_AGREES,
                  "%s: pixel %zu: outcome %d t %g; zero %g, deep %g", what, i, results[i].outcome,
                  (double)results[i].t, truths[i].zero, truths[i].deep);
        if (truths[i].through < HUGE_VAL) {
            CHECK_SAY(results[i].outcome == SPT_HIT, "%s: pixel %zu is in shadow: outcome %d", what,
                      i, results[i].outcome);
            ++in_shadow;
        } else if (!(truths[i].zero < HUGE_VAL) && truths[i].clearance > 3) {
            CHECK_SAY(results[i].outcome == SPT_MISS, "%s: pixel %zu is lit: outcome %d t %g", what,
                      i, results[i].outcome, (double)results[i].t);
            ++lit;
        } else {
            ++unclear;
        }
    }
    CHECK_SAY(in_shadow > 3 && lit > 30 && unclear < 5 + lit / 20, "%zu in shadow, %zu lit, %zu?",
              in_shadow, lit, unclear);
}

static void check_shadow(const char *name, uint32_t scale) {
    const spt_hits sinks = spt_hits_of(others);
    const truth_field field = truth_of_scene(scene_named(name));
    shadow_case c;
    advance a;
    check_context("%s, 1/%u", name, scale);
    open_case(&c, name, scale);
    for (size_t i = 0; i < frame_pixels(&c.frame); ++i) {
        if (rays[i].active == 0) continue;
        truths[i] = truth_walk(&field, &c.frame.settings, &rays[i].ray, (double)rays[i].path);
    }
    frame_blank(pixels, others);
    CHECK(spt_frame_trace(&c.frame, 0, spt_frame_tiles(&c.frame), &sinks, NULL) == SPT_OK);
    judge(&c, others, "tiles");
    for (int i = 0; i < schedule_count; ++i) {
        schedule_set(&c.frame, &schedules[i]);
        a = advance_begin(&c.frame, 0, shadow);
        advance_run(&a, 1u << 20);
        judge(&c, shadow, schedules[i].name);
        a = advance_begin(&c.frame, 0, others);
        advance_run(&a, 1 + check_random() % 3000);
        for (size_t pixel = 0; pixel < frame_pixels(&c.frame); ++pixel) {
            CHECK_SAY(memcmp(&shadow[pixel], &others[pixel], sizeof *shadow) == 0,
                      "schedule %s, pixel %zu: interrupted", schedules[i].name, pixel);
        }
    }
}

static void frame_shadow_full(void) {
    check_shadow("primitives", 1);
    check_shadow("village", 1);
    check_shadow("arches", 1);
}

static void frame_shadow_quarter(void) {
    check_shadow("primitives", coarse);
    check_shadow("village", coarse);
    check_shadow("arches", coarse);
}

void suite_frame_shadow(void) {
    RUN(frame_shadow_full);
    RUN(frame_shadow_quarter);
}
