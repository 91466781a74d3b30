/* SPDX-License-Identifier: MIT
 *
 * Faults once found in the queries of surfaces, each as the smallest case that shows it, against
 * exact entries, exits and distances, at every width. Those of candidates of spt_trace() are in
 * test_surface_found_candidates.c. */
#include "surface_found.h"

#include <spheretrace/scene.h>
#include <spheretrace/surface.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Fields --------------------------------------------------------------------------------- */

static float cube_distance(const void *data, float x, float y, float z) {
    (void)data;
    return fmaxf(fabsf(x), fmaxf(fabsf(y), fabsf(z))) - 1.0f;
}

/* R = 1, r = 0.3, about y. */
static float torus_distance(const void *data, float x, float y, float z) {
    const float ring = sqrtf(x * x + z * z) - 1.0f;
    (void)data;
    return sqrtf(ring * ring + y * y) - 0.3f;
}

static const stress_sphere twice = {{0.0f, 0.0f, 0.0f}, 2.0f};
static subject large = {stress_sphere_distance, &twice, 0};
static subject cube = {cube_distance, NULL, 0};
static subject torus = {torus_distance, NULL, 0};

static spt_hit convex_hit(const spt_field *field, const spt_settings *settings,
                          const spt_ray *ray) {
    const spt_rays from = spt_rays_of(ray);
    spt_hit hit;
    const spt_hits to = spt_hits_of(&hit);
    memset(&hit, 0, sizeof hit);
    CHECK(spt_trace_convex(field, settings, 1, &from, &to, NULL) == SPT_OK);
    return hit;
}

/* The distance of a ray's point from the unit ball. */
static double ball_at(const spt_ray *ray, double t) {
    double square = 0;
    for (int i = 0; i < 3; ++i) {
        const double x = (double)ray->origin[i] + t * (double)ray->direction[i];
        square += x * x;
    }
    return sqrt(square) - 1;
}

/* ---- Starts on a convex surface -------------------------------------------------------------- */

/* A ray of unit direction from the unit ball's surface, at that cosine to the normal. */
static spt_ray ray_from_ball(double cosine) {
    spt_ray ray = {{0, 0, 0}, 0, {0, 0, 0}, INFINITY};
    double normal[3], other[3], along, across = 0;
    do {
        random_unit(normal);
        random_unit(other);
        along = normal[0] * other[0] + normal[1] * other[1] + normal[2] * other[2];
    } while (fabs(along) > 0.9);
    across = sqrt((1 - cosine * cosine) / (1 - along * along));
    for (int i = 0; i < 3; ++i) {
        ray.origin[i] = (float)normal[i];
        ray.direction[i] = (float)(cosine * normal[i] + across * (other[i] - along * normal[i]));
    }
    return ray;
}

static void found_shallow_ways_out_that_hit(void) {
    static const spt_ray rays[2] = {{{0, 1, 0}, 0, {1, 0.1f, 0}, INFINITY},
                                    {{0, 1, 0}, 0, {1, 1e-4f, 0}, INFINITY}};
    const spt_bound bound = spt_bound_sphere(0, 0, 0, 2);
    for (FOR_EACH_WIDTH) {
        for (int i = 0; i < 4; ++i) {
            const spt_field field = field_of(i < 2 ? &ball : &cube, SPT_FIELD_CONVEX, &bound);
            const spt_settings settings = settings_of(width, SPT_SKIP_START);
            const spt_hit hit = convex_hit(&field, &settings, &rays[i % 2]);
            CHECK_SAY(hit.outcome == SPT_MISS && hit.flags == 0, "case %d: %d at %g", i,
                      hit.outcome, (double)hit.t);
        }
    }
}

/* A ray from the surface leaves the ball where it runs outwards; else it leaves it at 2 |cosine|,
 * and has been as deep as cosine^2 / 2, which is more than the tolerance here. f rises behind the
 * middle of that chord only, so that a hit behind it, within the tolerance, is the exit. */
static void expect_from_ball(const spt_ray *ray, const spt_settings *settings, double path,
                             const spt_hit *hit) {
    const double outward = product(ray->origin, ray->direction);
    const double at = outward < 0 ? (double)hit->t : 0;
    const double floor = 0x1p-22 * (1 + at + 2);
    const double tolerance =
        fmax((double)settings->epsilon, (double)settings->pixel_radius * (path + at));
    if (outward >= 0) {
        CHECK_SAY(hit->outcome == SPT_MISS, "cosine %g: %d at %g", outward, hit->outcome,
                  (double)hit->t);
        return;
    }
    CHECK_SAY(hit->outcome == SPT_HIT && hit->flags == SPT_FLAG_INSIDE, "cosine %g: %d, flags %x",
              outward, hit->outcome, (unsigned)hit->flags);
    if (hit->outcome != SPT_HIT) return;
    CHECK_SAY(at > -outward && fabs(ball_at(ray, at)) <= tolerance + floor,
              "cosine %g: at %g, f %g", outward, at, ball_at(ray, at));
}

static void found_starts_of_all_angles(void) {
    enum { count = 300 };
    static spt_ray rays[count];
    static spt_hit hits[count];
    const spt_bound bound = spt_bound_sphere(0, 0, 0, 2);
    const spt_field field = field_of(&ball, SPT_FIELD_CONVEX, &bound);
    const float path = 1;
    for (FOR_EACH_WIDTH) {
        for (int pixel = 0; pixel < 2; ++pixel) {
            spt_settings settings = settings_of(width, SPT_SKIP_START);
            spt_rays from = spt_rays_of(rays);
            const spt_hits to = spt_hits_of(hits);
            settings.pixel_radius = pixel ? 1e-3f : 0.0f;
            from.path.first = &path;
            for (int i = 0; i < count; ++i) {
                const double least = pixel ? 0.05 : 0.02, shallow = pow(10, -check_uniform(0, 6));
                rays[i] = ray_from_ball(i % 3 == 0   ? -check_uniform(least * 1.001, 1)
                                        : i % 3 == 1 ? check_uniform(1e-6, 1)
                                                     : fmax(shallow, 1e-6));
            }
            CHECK(spt_trace_convex(&field, &settings, count, &from, &to, NULL) == SPT_OK);
            for (int i = 0; i < count; ++i) expect_from_ball(&rays[i], &settings, 1, &hits[i]);
        }
    }
}

/* ---- Hits that are no roots ------------------------------------------------------------------ */

/* The hit is neither refined nor left: it is nowhere near the surface. */
static void expect_to_stay(const spt_field *field, const spt_settings *settings, const spt_ray *ray,
                           const spt_hit *hit) {
    static const float normal[3] = {-1, 0, 0};
    const spt_rays from = spt_rays_of(ray);
    const spt_vectors normals = spt_vectors_of(normal);
    spt_hit refined = *hit;
    const spt_hits to = spt_hits_of(&refined);
    float origin[3] = {7, 7, 7};
    int32_t start = -1;
    spt_starts starts;
    memset(&starts, 0, sizeof starts);
    starts.origin = spt_vector_sinks_of(origin);
    starts.start.first = &start;
    CHECK(spt_refine(field, 1, settings, 3, 1, &from, &to) == SPT_OK);
    CHECK_SAY(stress_same_hit(&refined, hit), "t %.9g, residual %.9g", (double)refined.t,
              (double)refined.residual);
    for (uint32_t checks = 0; checks < 5; ++checks) {
        CHECK(spt_offset(field, 1, settings, 1, &from, &to, &normals, NULL, checks, &starts) ==
              SPT_OK);
        CHECK_SAY(start == SPT_START_AT_HIT, "start %d", start);
        for (int i = 0; i < 3; ++i) {
            CHECK(check_same_bits(origin[i], ray->origin[i] + hit->t * ray->direction[i]));
        }
    }
}

static void found_hits_that_are_no_roots(void) {
    static const spt_ray through = {{-5, 0, 0}, 0, {1, 0, 0}, 100};
    static const spt_ray within = {{0, 0, 0.2f}, 0, {1, 0, 0}, 100};
    static const spt_zone zone = {{-2, 0, 0}, 1, -1};
    const spt_field whole = field_of(&large, 0, NULL), small = field_of(&ball, 0, NULL);
    spt_scene scene = spt_scene_default();
    scene.fields = &whole;
    scene.count = 1;
    scene.zones = &zone;
    scene.zone_count = 1;
    for (FOR_EACH_WIDTH) {
        for (int pixel = 0; pixel < 2; ++pixel) {
            spt_settings settings = settings_of(width, SPT_STOP_INSIDE);
            const spt_rays from = spt_rays_of(&through);
            spt_hit hit;
            const spt_hits to = spt_hits_of(&hit);
            settings.pixel_radius = pixel ? 1e-3f : 0.0f;
            const size_t size = spt_scene_workspace(&scene, &settings);
            void *const workspace = malloc(size);
            CHECK(workspace != NULL);
            if (workspace == NULL) return;
            CHECK(spt_scene_trace(&scene, &settings, 1, &from, &to, workspace, size, NULL) ==
                  SPT_OK);
            free(workspace);
            CHECK_SAY(hit.outcome == SPT_HIT && stress_within((double)hit.t, 4, 1e-5) &&
                          stress_within((double)hit.residual, -1, 1e-5),
                      "%d at %.9g, residual %.9g", hit.outcome, (double)hit.t,
                      (double)hit.residual);
            expect_to_stay(&whole, &settings, &through, &hit);
            const spt_rays inside = spt_rays_of(&within);
            CHECK(spt_trace(&small, &settings, 1, &inside, &to, NULL) == SPT_OK);
            CHECK(hit.outcome == SPT_HIT && hit.t <= 0 && hit.flags == SPT_FLAG_INSIDE);
            CHECK(stress_within((double)hit.residual, -0.8, 1e-6));
            expect_to_stay(&small, &settings, &within, &hit);
        }
    }
}

/* ---- A sink on a column ---------------------------------------------------------------------- */

static void found_a_normal_over_the_radius(void) {
    enum { count = 300 }; /* more than a window */
    static float balls[count][4], kept[count][4], plain[count], distance[count], normals[3 * count];
    const spt_field field = field_of(&ball, 0, NULL);
    for (FOR_EACH_WIDTH) {
        const spt_settings settings = settings_of(width, 0);
        spt_bodies from;
        spt_contacts to;
        memset(&from, 0, sizeof from);
        memset(&to, 0, sizeof to);
        for (int i = 0; i < 4 * count; ++i) balls[i / 4][i % 4] = (float)check_uniform(-2, 2);
        for (int i = 0; i < count; ++i) balls[i][3] = fabsf(balls[i][3]);
        memcpy(kept, balls, sizeof balls);
        from.radius.first = &balls[0][3];
        from.radius.stride = sizeof balls[0];
        for (int axis = 0; axis < 3; ++axis) {
            from.from.axis[axis].first = &balls[0][axis];
            from.from.axis[axis].stride = sizeof balls[0];
        }
        to.distance.first = plain;
        to.distance.stride = sizeof *plain;
        to.normal = spt_vector_sinks_of(normals);
        CHECK(spt_collide(&field, 1, &settings, count, &from, &to) == SPT_OK);
        to.distance.first = distance;
        to.normal.axis[0].first = &balls[0][3];
        to.normal.axis[0].stride = sizeof balls[0];
        CHECK(spt_collide(&field, 1, &settings, count, &from, &to) == SPT_OK);
        for (int i = 0; i < count; ++i) {
            const double truth = sqrt(product(kept[i], kept[i])) - 1 - (double)kept[i][3];
            /* As surface.h says; and the last subtraction rounds. */
            const double floors = 4 * 0x1p-22 * (2 + 2.5 + 2.5);
            CHECK_SAY((double)distance[i] <= truth + 0x1p-23 * fabs(truth) &&
                          (double)distance[i] >= truth - (double)settings.epsilon - floors,
                      "body %d: %.9g, truth %.9g", i, (double)distance[i], truth);
            CHECK(check_same_bits(distance[i], plain[i]));
            CHECK(check_same_bits(balls[i][3], normals[3 * i]));
        }
    }
}

/* ---- The way back ---------------------------------------------------------------------------- */

/* From inside the tube through the hole: the last exit is at 2.3, f > 0 on the way to it, and the
 * first one at 0.3 is what the forward trace finds. */
static void found_limits_of_betrayed_rays(void) {
    static const spt_ray ray = {{1, 0, 0}, 0, {-1, 0, 0}, INFINITY};
    const spt_bound bound = spt_bound_sphere(0, 0, 0, 1.5f);
    const spt_field field = field_of(&torus, 0, &bound);
    for (FOR_EACH_WIDTH) {
        for (uint32_t budget = 0; budget <= 100; budget += budget < 8 ? 1 : 92) {
            spt_settings settings = settings_of(width, SPT_CHECK_CONVEX);
            settings.budget = budget;
            torus.calls = 0;
            const spt_hit hit = convex_hit(&field, &settings, &ray);
            CHECK_SAY(hit.evaluations <= budget && hit.evaluations == torus.calls,
                      "budget %u: %u, calls %u", (unsigned)budget, (unsigned)hit.evaluations,
                      (unsigned)torus.calls);
            CHECK(budget < 1 || (hit.flags & SPT_FLAG_INSIDE) != 0);
            CHECK(hit.candidate_t >= INFINITY && hit.candidate_ratio >= INFINITY);
            if (hit.outcome == SPT_HIT) {
                CHECK_SAY(stress_within((double)hit.t, 0.3, 1.01e-4), "%.9g", (double)hit.t);
                CHECK((hit.flags & SPT_FLAG_NOT_CONVEX) != 0);
                continue;
            }
            CHECK(hit.outcome == SPT_LIMIT && budget < 100 && hit.t <= 0.3f);
            CHECK_SAY(budget < 1 || stress_within((double)hit.residual, (double)hit.t - 0.3, 1e-6),
                      "budget %u: %.9g at %.9g", (unsigned)budget, (double)hit.residual,
                      (double)hit.t);
        }
    }
}

static void found_candidates_of_ways_back(void) {
    static const uint32_t kinds[] = {0, SPT_CANDIDATE_PENUMBRA, SPT_CANDIDATE_CLOSEST};
    static const float up[3] = {0, 1, 0};
    const spt_bound bounds[] = {spt_bound_sphere(0, 0, 0, 2), spt_bound_slab(up, -2, 2),
                                spt_bound_box(-2, -2, -2, 2, 2, 2)};
    for (FOR_EACH_WIDTH) {
        for (int i = 0; i < 90; ++i) {
            const spt_field field =
                field_of(i % 2 ? &ball : &cube, i % 4 < 2 ? SPT_FIELD_CONVEX : 0, &bounds[i / 30]);
            spt_settings settings = settings_of(width, kinds[i % 3]);
            spt_ray ray = {{0, 0, 0}, 0, {1, 0.01f, 0}, i % 5 == 0 ? 0.3f : INFINITY};
            if (i % 7 == 0) settings.budget = check_random() % 5;
            for (int axis = 0; axis < 3; ++axis) ray.origin[axis] = (float)check_uniform(-.4, .4);
            const spt_hit hit = convex_hit(&field, &settings, &ray);
            CHECK_SAY(hit.candidate_t >= INFINITY && hit.candidate_ratio >= INFINITY,
                      "case %d, outcome %d: %g at %g", i, hit.outcome, (double)hit.candidate_ratio,
                      (double)hit.candidate_t);
            CHECK(settings.budget < 128 || hit.outcome == (i % 5 == 0 ? SPT_MISS : SPT_HIT));
        }
    }
}

void suite_surface_found(void) {
    RUN(found_shallow_ways_out_that_hit);
    RUN(found_starts_of_all_angles);
    RUN(found_hits_that_are_no_roots);
    RUN(found_a_normal_over_the_radius);
    RUN(found_limits_of_betrayed_rays);
    RUN(found_candidates_of_ways_back);
}
