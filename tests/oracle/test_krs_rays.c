/* SPDX-License-Identifier: MIT
 *
 * Rays traced against models of balls by every rule at every width, and where they meet the
 * instances by closed form (algorithms.md, section 10). Left out: other kernels, whose distances
 * are tested alone. */
#include "krs_draw.h"
#include "../check.h"

#include <math.h>

enum { ray_count = 48 };

static krs_drawn sample;
static spt_ray rays[ray_count];
static spt_krs krs;

/* Where the ray first comes within `more` of a ball's surface, outside it; +infinity: nowhere. */
static double meets(const spt_ray *ray, const krs_body *ball, double more) {
    double origin[3], direction[3], to[3], nearest[3];
    krs_widen(ray->origin, origin);
    krs_widen(ray->direction, direction);
    const double square = surface_dot(direction, direction), radius = ball->radius + more;
    for (int axis = 0; axis < 3; ++axis) to[axis] = ball->a[axis] - origin[axis];
    const double middle = surface_dot(to, direction) / square;
    for (int axis = 0; axis < 3; ++axis) nearest[axis] = to[axis] - middle * direction[axis];
    const double half = radius * radius - surface_dot(nearest, nearest);
    if (!(half >= 0) || !(radius > 0)) return HUGE_VAL;
    const double t = middle - sqrt(half / square);
    return t >= 0 && t <= (double)ray->t_max ? t : HUGE_VAL;
}

static double first(const spt_ray *ray, double more) {
    double least = HUGE_VAL;
    for (size_t i = 0; i < sample.truth.count; ++i)
        least = fmin(least, meets(ray, &sample.truth.instances[i].body, more));
    return least;
}

/* From outside all, half of them at an instance, with directions of any length. */
static void draw_rays(void) {
    for (int i = 0; i < ray_count; ++i) {
        double origin[3], target[3];
        do {
            for (int axis = 0; axis < 3; ++axis)
                origin[axis] = check_uniform(-1.5, 1.5) * sample.reach;
        } while (krs_expansion_distance(&sample.truth, origin, NULL, NULL) < 0.05);
        if (i % 2 != 0) {
            krs_draw_on_surface(&sample, target);
        } else {
            for (int axis = 0; axis < 3; ++axis) target[axis] = check_uniform(-1, 1) * sample.reach;
        }
        const double length = pow(2, check_uniform(-4, 4));
        rays[i] = surface_aim(origin, target, length, 4 * sample.reach / length);
    }
}

/* Rays that meet what is left of the balls when they lose the tolerance, and what rounding makes
 * of it, hit: there at the latest, and not before they meet the balls that much larger. Those that
 * miss the larger ones miss. Returns how many are decided so. */
static int check_hits(const spt_settings *settings, const spt_hit *hits) {
    int decided = 0;
    for (int i = 0; i < ray_count; ++i) {
        const spt_ray *const ray = &rays[i];
        const double way = oracle_length(ray) * (double)ray->t_max;
        /* 4u (|o| + |d| t + R), and what the fold adds; R is that of the bound, within reach */
        double origin[3];
        krs_widen(ray->origin, origin);
        const double rounding = ldexp(surface_length(origin) + way + sample.reach, -22) +
                                krs_rounding(sample.levels, sample.mirrors, origin) +
                                ldexp(sample.levels + 4, -22) * way;
        const double surely = first(ray, -rounding);
        const double last = surely < HUGE_VAL ? surely : (double)ray->t_max;
        const double tolerance = oracle_tolerance(settings, ray, last);
        const double earliest = first(ray, tolerance + rounding);
        const double t = (double)hits[i].t;
        if (surely < HUGE_VAL) {
            CHECK_SAY(hits[i].outcome == SPT_HIT, "ray %d: outcome %d, %g levels, hit at %g", i,
                      hits[i].outcome, (double)sample.levels, surely);
            CHECK_SAY(t >= earliest * (1 - 1e-6) && t <= surely * (1 + 1e-6),
                      "ray %d: t = %.9g, from %.9g to %.9g", i, t, earliest, surely);
            ++decided;
        } else if (!(earliest < HUGE_VAL)) {
            CHECK_SAY(hits[i].outcome == SPT_MISS, "ray %d: outcome %d for a miss", i,
                      hits[i].outcome);
            ++decided;
        }
        CHECK_SAY((hits[i].flags & SPT_FLAG_STEEP) == 0, "ray %d is steep", i);
    }
    return decided;
}

static void krs_rays_meet_the_instances(void) {
    static const double pixel_radii[] = {0, 0.0005};
    for (uint32_t levels = 0; levels <= 8; levels += 2) {
        krs_draw(&sample, levels, KRS_SPHERES, 0);
        draw_rays();
        for (int cone = 0; cone < 2; ++cone) {
            static spt_hit hits[ray_count], before[ray_count];
            const spt_method *rule = NULL;
            for (oracle_run run = oracle_first_run; oracle_next(&run, 0);) {
                spt_settings settings = oracle_settings(&run);
                settings.budget = 2000;
                settings.pixel_radius = (float)pixel_radii[cone];
                krs_build(&sample, run.lanes, &krs);
                const spt_field field = spt_krs_field(&krs);
                oracle_trace(&field, &settings, ray_count, rays, hits);
                if (run.method == rule) { /* another width: the same bits, which were checked */
                    for (int i = 0; i < ray_count; ++i)
                        CHECK(oracle_same_hit(&hits[i], &before[i]));
                    continue;
                }
                rule = run.method;
                const int decided = check_hits(&settings, hits);
                CHECK_SAY(decided > ray_count * 8 / 10, "%d decided", decided);
                for (int i = 0; i < ray_count; ++i) before[i] = hits[i];
            }
        }
    }
}

/* What is hit can be asked for: the kernel named has the hit on its surface. */
static void krs_rays_name_what_they_hit(void) {
    krs_draw(&sample, 6, KRS_SOLID, 0);
    krs_build(&sample, 0, &krs);
    const spt_field field = spt_krs_field(&krs);
    static spt_hit hits[ray_count];
    static int32_t kernels[ray_count];
    static uint64_t mirrors[ray_count];
    const spt_settings settings = spt_settings_default();
    draw_rays();
    oracle_trace(&field, &settings, ray_count, rays, hits);
    spt_krs_places places = {0};
    const spt_rays from = spt_rays_of(rays);
    const spt_hits to = spt_hits_of(hits);
    places.kernel = (spt_sink){kernels, sizeof kernels[0]};
    places.mirrors = (spt_sink){mirrors, sizeof mirrors[0]};
    CHECK(spt_krs_locate(&krs, 0, &settings, ray_count, &from, &to, &places) == SPT_OK);
    int seen = 0;
    for (int i = 0; i < ray_count; ++i) {
        double p[3], seen_by[3];
        if (hits[i].outcome != SPT_HIT) continue;
        surface_point(&rays[i], (double)hits[i].t, p);
        krs_to_kernel(&sample.truth, (uint32_t)kernels[i], mirrors[i], p, seen_by);
        const krs_body body = krs_body_of(&sample.kernels[kernels[i]]);
        const double tolerance = oracle_tolerance(&settings, &rays[i], (double)hits[i].t) +
                                 2 * krs_rounding(6, sample.mirrors, p);
        CHECK_SAY(fabs(krs_body_distance(&body, seen_by)) <= tolerance, "%g off",
                  krs_body_distance(&body, seen_by));
        ++seen;
    }
    CHECK_SAY(seen > ray_count / 4, "%d", seen);
}

void suite_krs_rays(void) {
    RUN(krs_rays_meet_the_instances);
    RUN(krs_rays_name_what_they_hit);
}
