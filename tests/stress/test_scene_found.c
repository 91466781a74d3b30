/* SPDX-License-Identifier: MIT
 *
 * Faults once found in scenes, and in what they share with spt_trace(): rays that begin in a zone
 * and leave it into a body, and SPT_SKIP_START with bounds. */
#include "test_scene_cases.h"

#include <spheretrace/frame.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Zones ----------------------------------------------------------------------------------- */

static int same_surface(const spt_hit *a, const spt_hit *b) {
    return check_same_bits(a->t, b->t) && check_same_bits(a->residual, b->residual) &&
           a->flags == b->flags && a->outcome == b->outcome && a->component == b->component;
}

/* The zone reaches from -1 to 1, the sphere from 0.5 to 3.5. A ray that begins in the zone begins
 * where it leaves it, inside of the sphere, and looks for the way out; one that comes from outside
 * meets the cut; one that begins in the sphere and comes to the zone goes on behind it. A bound
 * changes none of that. */
static void found_rays_that_begin_in_a_zone(void) {
    static const stress_sphere sphere = {{0.0f, 0.0f, 2.0f}, 1.5f};
    static const spt_zone zone = {{0.0f, 0.0f, 0.0f}, 1.0f, -1};
    static const spt_ray rays[] = {
        {{0.0f, 0.0f, 0.0f}, 0.0f, {0.0f, 0.0f, 1.0f}, 50.0f},   /* in the zone: the way out */
        {{0.0f, 0.0f, -2.0f}, 1.25f, {0.0f, 0.0f, 1.0f}, 50.0f}, /* by its t_min: likewise */
        {{0.0f, 0.0f, 0.75f}, 0.0f, {0.0f, 0.0f, 1.0f}, 50.0f},  /* and in the sphere, too */
        {{0.0f, 0.0f, -2.0f}, 0.0f, {0.0f, 0.0f, 1.0f}, 50.0f},  /* before it: the cut */
        {{0.0f, 0.0f, 3.0f}, 0.0f, {0.0f, 0.0f, -1.0f}, 50.0f}}; /* inside, and behind it nothing */
    static const double expected[] = {3.5, 5.5, 2.75, 3.0};
    enum { count = sizeof rays / sizeof *rays };
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        const spt_bound bound = spt_bound_sphere(0.0f, 0.0f, 2.0f, 1.5f);
        const spt_settings settings = union_settings(&way);
        union_part part = union_part_of(stress_sphere_distance, &sphere);
        spt_field field = union_field(&way, &part);
        spt_scene scene = spt_scene_default();
        spt_hit hits[2][count];
        scene.fields = &field;
        scene.count = 1;
        scene.zones = &zone;
        scene.zone_count = 1;
        union_trace(&way, &scene, &part, &settings, count, rays, hits[0]);
        field.bound = &bound;
        union_trace(&way, &scene, &part, &settings, count, rays, hits[1]);
        for (size_t i = 0; i < 2 * count; ++i) {
            const spt_hit *const hit = &hits[i / count][i % count];
            const uint32_t flags = i % count == 3 ? 0 : SPT_FLAG_INSIDE;
            CHECK_SAY(same_surface(hit, &hits[0][i % count]), "ray %u with a bound: t %.9g",
                      (unsigned)(i % count), (double)hit->t);
            CHECK_SAY(hit->flags == flags, "ray %u: flags %u", (unsigned)(i % count),
                      (unsigned)hit->flags);
            if (i % count == 4) {
                CHECK(hit->outcome == SPT_MISS);
                continue;
            }
            /* The rays lie in the axis, so t is off by what the residual may be. */
            CHECK(hit->outcome == SPT_HIT && hit->component == 0);
            CHECK_SAY(stress_within((double)hit->t, expected[i % count],
                                    (double)settings.epsilon * 1.001),
                      "ray %u: t %.9g", (unsigned)(i % count), (double)hit->t);
        }
    }
}

/* ---- SPT_SKIP_START and bounds --------------------------------------------------------------- */

typedef struct cuboid {
    float half[3];
} cuboid;

static float cuboid_distance(const void *data, float x, float y, float z) {
    const cuboid *const body = data;
    const float beyond[3] = {fabsf(x) - body->half[0], fabsf(y) - body->half[1],
                             fabsf(z) - body->half[2]};
    float outside = 0.0f, inside = -INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
        if (beyond[axis] > 0.0f) outside += beyond[axis] * beyond[axis];
        if (beyond[axis] > inside) inside = beyond[axis];
    }
    return outside > 0.0f ? sqrtf(outside) : inside;
}

static const cuboid cube = {{1.0f, 1.0f, 1.0f}}, plate = {{1.0f, 1.0f, 0.0f}};
static const cuboid *const bodies[] = {&cube, &plate};
enum { body_count = 2, from_outside = 3, from_a_face = 2 };

/* Along the axes, so that the face is met at its normal: t is off by what the residual may be. */
static const spt_ray outside_rays[from_outside] = {
    {{0.2f, 0.1f, -4.0f}, 0.0f, {0.0f, 0.0f, 1.0f}, 100.0f},
    {{0.2f, 0.1f, 6.0f}, 0.0f, {0.0f, 0.0f, -1.0f}, INFINITY},
    {{-0.7f, 0.3f, -9.0f}, 2.0f, {0.0f, 0.0f, 2.0f}, 50.0f}};

static double face_met(const spt_ray *ray, const cuboid *body) {
    return (fabs((double)ray->origin[2]) - (double)body->half[2]) / stress_length(ray->direction);
}

static void expect_faces(const cuboid *body, const spt_settings *settings, const spt_hit *hits,
                         const char *what) {
    for (size_t i = 0; i < from_outside; ++i) {
        const double t = face_met(&outside_rays[i], body);
        CHECK_SAY(hits[i].outcome == SPT_HIT && hits[i].flags == 0 && hits[i].component == 0,
                  "%s, ray %u: outcome %d, flags %u", what, (unsigned)i, (int)hits[i].outcome,
                  (unsigned)hits[i].flags);
        CHECK_SAY(stress_within((double)hits[i].t, t, (double)settings->epsilon * 1.001),
                  "%s, ray %u: t %.9g", what, (unsigned)i, (double)hits[i].t);
    }
}

static spt_bound tight_bound(const cuboid *body) {
    const float *const half = body->half;
    return spt_bound_box(-half[0], -half[1], -half[2], half[0], half[1], half[2]);
}

/* A ray that comes to the bound from outside is in the open there, though it is within a tolerance
 * of the face: it meets it with the flag as without, by the same evaluations. */
static void found_skipping_and_the_face_of_a_bound(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (size_t k = 0; k < body_count; ++k) {
            const spt_bound bound = tight_bound(bodies[k]);
            stress_case what = stress_case_of(cuboid_distance, bodies[k]);
            for (int bounded = 0; bounded < 2; ++bounded) {
                spt_hit plain[from_outside], skipping[from_outside];
                what.bound = bounded ? &bound : NULL;
                what.settings.flags = 0;
                stress_run_many(&way, &what, from_outside, outside_rays, plain);
                what.settings.flags = SPT_SKIP_START;
                stress_run_many(&way, &what, from_outside, outside_rays, skipping);
                for (size_t i = 0; i < from_outside; ++i) {
                    CHECK_SAY(stress_same_hit(&skipping[i], &plain[i]),
                              "body %u, bounded %d, ray %u: t %.9g, without the flag %.9g",
                              (unsigned)k, bounded, (unsigned)i, (double)skipping[i].t,
                              (double)plain[i].t);
                }
                expect_faces(bodies[k], &what.settings, plain, "plain");
                expect_faces(bodies[k], &what.settings, skipping, "skipping");
            }
        }
    }
}

/* The same in a union, where another component stands beside the rays. */
static void found_skipping_in_a_union(void) {
    static const stress_sphere beside = {{6.0f, 0.0f, 0.0f}, 1.0f};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (size_t k = 0; k < body_count; ++k) {
            const spt_bound bound = tight_bound(bodies[k]);
            union_part parts[2] = {union_part_of(cuboid_distance, bodies[k]),
                                   union_part_of(stress_sphere_distance, &beside)};
            spt_field fields[2] = {union_field(&way, &parts[0]), union_field(&way, &parts[1])};
            spt_settings settings = union_settings(&way);
            spt_scene scene = spt_scene_default();
            scene.fields = fields;
            for (int kind = 0; kind < 4; ++kind) { /* alone or not, bounded or not */
                spt_hit plain[from_outside], skipping[from_outside];
                scene.count = 1 + (size_t)kind / 2;
                fields[0].bound = kind % 2 != 0 ? &bound : NULL;
                settings.flags = 0;
                union_trace(&way, &scene, parts, &settings, from_outside, outside_rays, plain);
                settings.flags = SPT_SKIP_START;
                union_trace(&way, &scene, parts, &settings, from_outside, outside_rays, skipping);
                for (size_t i = 0; i < from_outside; ++i) {
                    CHECK_SAY(stress_same_hit(&skipping[i], &plain[i]),
                              "body %u, kind %d, ray %u: t %.9g, without the flag %.9g",
                              (unsigned)k, kind, (unsigned)i, (double)skipping[i].t,
                              (double)plain[i].t);
                }
                expect_faces(bodies[k], &settings, plain, "plain");
                expect_faces(bodies[k], &settings, skipping, "skipping");
            }
        }
    }
}

/* A secondary ray begins on the face, which is the bound's, too: there the flag does skip it. */
static void found_skipping_on_the_face_of_a_bound(void) {
    static const spt_ray rays[from_a_face] = {
        {{0.2f, 0.1f, -1.0f}, 0.0f, {0.0f, 0.0f, -1.0f}, 100.0f}, /* away */
        {{0.2f, 0.1f, -1.0f}, 0.0f, {0.0f, 0.0f, 1.0f}, 100.0f}}; /* through the body */
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        const spt_bound bound = tight_bound(&cube);
        stress_case what = stress_case_of(cuboid_distance, &cube);
        for (int bounded = 0; bounded < 2; ++bounded) {
            spt_hit hits[from_a_face];
            what.bound = bounded ? &bound : NULL;
            what.settings.flags = SPT_SKIP_START;
            stress_run_many(&way, &what, from_a_face, rays, hits);
            CHECK_SAY(hits[0].outcome == SPT_MISS, "away: t %.9g", (double)hits[0].t);
            CHECK_SAY(hits[1].outcome == SPT_HIT && hits[1].flags == SPT_FLAG_INSIDE,
                      "through: outcome %d, flags %u", (int)hits[1].outcome,
                      (unsigned)hits[1].flags);
            CHECK_SAY(stress_within((double)hits[1].t, 2.0, (double)what.settings.epsilon * 1.001),
                      "through: t %.9g", (double)hits[1].t);
        }
    }
}

/* ---- Starts that are skipped in frames ---------------------------------------------------------- */

static float found_slab(void *user, float x, float y, float z) {
    (void)user, (void)x, (void)y;
    return z < 2.0f ? -z : z - 4.0f;
}

/* A frame whose tiles cull knows where a ray itself begins: from nearer than the tolerance the
 * surface is skipped, from farther not, as in spt_scene_trace(). */
static void found_skipped_starts_of_culled_frames(void) {
    enum { side = 8, pixels = side * side };
    static const float up[3] = {0, 1, 0}, target[3] = {0, 0, 1};
    static spt_hit seen[pixels], right[pixels];
    static spt_camera_ray rays[pixels];
    const spt_bound bound = spt_bound_box(-9, -9, 0, 9, 9, 4);
    const spt_hits seen_view = spt_hits_of(seen), right_view = spt_hits_of(right);
    spt_rays view = spt_rays_of(&rays->ray);
    spt_field field = spt_field_default();
    spt_scene scene = spt_scene_default();
    field.point = found_slab;
    field.bound = &bound;
    scene.fields = &field;
    scene.count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        view.origin[axis].stride = view.direction[axis].stride = sizeof *rays;
    }
    view.t_min.stride = view.t_max.stride = sizeof *rays;
    for (int far = 0; far < 2; ++far) {
        const float eye[3] = {0.0f, 0.0f, far ? -0.03f : -0.003f};
        float x[pixels], y[pixels];
        spt_camera camera;
        spt_frame frame;
        for (int i = 0; i < pixels; ++i) {
            x[i] = (float)(i % side) + 0.5f;
            y[i] = (float)(i / side) + 0.5f;
        }
        CHECK(spt_camera_pinhole(&camera, eye, target, up, 1e-4f, side, side) == SPT_OK);
        CHECK(spt_camera_rays(&camera, side, side, pixels, x, y, rays) == SPT_OK);
        CHECK(spt_frame_init(&frame, &scene, &camera, side, side) == SPT_OK);
        frame.settings.epsilon = 0.01f;
        frame.settings.flags = SPT_SKIP_START;
        frame.flags = SPT_FRAME_NO_CONES;
        frame.workspace_size = spt_frame_workspace(&frame);
        const size_t size = spt_scene_workspace(&scene, &frame.settings);
        void *const workspace = malloc(size);
        frame.workspace = malloc(frame.workspace_size);
        CHECK(workspace != NULL && frame.workspace != NULL);
        CHECK(spt_frame_trace(&frame, 0, 1, &seen_view, NULL) == SPT_OK);
        CHECK(spt_scene_trace(&scene, &frame.settings, pixels, &view, &right_view, workspace, size,
                              NULL) == SPT_OK);
        for (int i = 0; i < pixels; ++i) {
            CHECK_SAY(memcmp(&seen[i], &right[i], sizeof seen[i]) == 0, "far %d, pixel %d", far, i);
            CHECK((right[i].outcome == SPT_HIT && right[i].t < 1.0f) == far);
        }
        free(frame.workspace);
        free(workspace);
    }
}

void suite_scene_found(void) {
    RUN(found_rays_that_begin_in_a_zone);
    RUN(found_skipping_and_the_face_of_a_bound);
    RUN(found_skipping_in_a_union);
    RUN(found_skipping_on_the_face_of_a_bound);
    RUN(found_skipped_starts_of_culled_frames);
}
