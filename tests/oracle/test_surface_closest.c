/* SPDX-License-Identifier: MIT
 *
 * SPT_CANDIDATE_CLOSEST and SPT_CANDIDATE_PENUMBRA against the analytic closest approach of rays to
 * points, spheres, boxes and capsules, for every rule, through fields and scenes. */
#include "surface_passing.h"
#include "../check.h"

#include <spheretrace/scene.h>
#include <spheretrace/surface.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { rays_a_kind = 16 };

static const char *const kind_names[passing_kinds] = {"point", "sphere", "box", "capsule"};

static spt_hit trace_passing(const surface_run *run, const passing *what, uint32_t flags,
                             float path) {
    const reference_field reference = surface_body_field(&what->body);
    const spt_field field = surface_field(run, &reference, SPT_FIELD_CONVEX);
    spt_settings given = spt_settings_default(), settings;
    spt_rays rays = spt_rays_of(&what->ray);
    spt_hit hit = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    const spt_hits hits = spt_hits_of(&hit);
    given.flags = flags;
    given.budget = 2000;
    settings = surface_settings(run, &given);
    rays.path.first = &path;
    CHECK(spt_trace(&field, &settings, 1, &rays, &hits, NULL) == SPT_OK);
    CHECK_SAY(hit.outcome == SPT_MISS, "outcome %d", hit.outcome);
    return hit;
}

/* Every fourth ray begins behind where it passes closest. */
static passing draw(int i, passing_kind kind) {
    passing what = passing_draw(kind);
    if (i % 16 < 12) return what;
    what.ray.t_min = (float)(check_uniform(1, 1.5) * what.at);
    return passing_of(&what.body, &what.ray);
}

/* Never more than the true closest distance; for a point that distance, and its place. With plain
 * steps, step = r1, the circle of two neighbours has a^2 = r2^2 (1 - r2^2 / (4 r1^2)) where it lies
 * between them, which is where r2^2 <= 2 r1^2: at least 3/4 of the lesser square. */
static void closest_approach(void) {
    for (surface_run run = surface_runs(SURFACE_ALL_RULES | SURFACE_CONVEX); surface_next(&run);) {
        for (int i = 0; i < passing_kinds * rays_a_kind; ++i) {
            const passing_kind kind = (passing_kind)(i % passing_kinds);
            const passing what = draw(i, kind);
            const spt_hit hit = trace_passing(&run, &what, SPT_CANDIDATE_CLOSEST, 0);
            const double found = (double)hit.candidate_ratio, closest = what.closest,
                         rounding = passing_rounding(&what, found);
            const double at = fabs((double)hit.candidate_t - what.at) * oracle_length(&what.ray);
            CHECK_SAY(found <= closest + rounding, "%s: %g, truth %g", kind_names[kind], found,
                      closest);
            CHECK_SAY(found >= 0 && hit.candidate_t >= what.ray.t_min &&
                          hit.candidate_t <= what.ray.t_max,
                      "%s: %g at %g", kind_names[kind], found, (double)hit.candidate_t);
            if (run.method == spt_basic()) {
                CHECK_SAY(found >= sqrt(0.75) * closest - rounding, "%s: %g, truth %g",
                          kind_names[kind], found, closest);
            }
            if (kind != PASSING_POINT) continue;
            CHECK_SAY(fabs(found - closest) <= rounding, "point: %.9g, truth %.9g", found, closest);
            CHECK_SAY(at <= 0x1p-19 * passing_reach(&what), "point: at %.9g, truth %.9g",
                      (double)hit.candidate_t, what.at);
        }
    }
}

/* The angle whose tangent is found is never more than the true one, by which the ray misses the body
 * as seen from its origin. Of a point the circle gives the tangent itself, and samples near it give
 * down to the sine. With plain steps: (t, r1) to (t + r1, r2) gives at least sqrt(3/4) min(r1, r2)
 * over t + r1, and each r is at least t sine: no less than sqrt(3/4) sine / (1 + sine). */
static void penumbra_angle(void) {
    for (surface_run run = surface_runs(SURFACE_ALL_RULES | SURFACE_CONVEX); surface_next(&run);) {
        for (int i = 0; i < passing_kinds * rays_a_kind; ++i) {
            const passing_kind kind = (passing_kind)(i % passing_kinds);
            const passing what = draw(i, kind);
            const float path = i % 3 == 0 ? 5 : 0; /* which must not count */
            const spt_hit hit = trace_passing(&run, &what, SPT_CANDIDATE_PENUMBRA, path);
            const double found = (double)hit.candidate_ratio, sine = what.sine;
            /* Relative to the distances themselves, which stand over at least the way to where the
             * body is nearest less the distance. */
            const double rounding =
                found * (passing_rounding(&what, what.closest) / what.closest + 0x1p-20);
            CHECK_SAY(found / sqrt(1 + found * found) <= sine + rounding,
                      "%s: tangent %g, true sine %g", kind_names[kind], found, sine);
            CHECK(found >= 0 && hit.candidate_t >= what.ray.t_min &&
                  hit.candidate_t <= what.ray.t_max);
            if (run.method == spt_basic()) {
                CHECK_SAY(found >= sqrt(0.75) * sine / (1 + sine) - rounding,
                          "%s: tangent %g, true sine %g", kind_names[kind], found, sine);
            }
            if (kind == PASSING_POINT) {
                CHECK_SAY(found >= sine - rounding, "point: tangent %g, true sine %g", found, sine);
            }
        }
    }
}

/* Of a hit it is the hit, and nothing that it passed on the way is less. */
static void closest_of_hits(void) {
    for (surface_run run = surface_runs(SURFACE_ALL_RULES | SURFACE_CONVEX); surface_next(&run);) {
        for (int i = 0; i < 8; ++i) {
            const surface_body ball = surface_sphere(check_uniform(-0.5, 0.5), 0, 6, 1);
            const reference_field reference = surface_body_field(&ball);
            const spt_field field = surface_field(&run, &reference, SPT_FIELD_CONVEX);
            spt_settings given = spt_settings_default(), settings;
            const spt_ray ray = {{0, 0, 0}, 0, {0, 0, 0.5f}, 100};
            spt_hit plain, hit;
            settings = surface_settings(&run, &given);
            if (run.method == spt_convex())
                settings.method = spt_basic(); /* whose steps it takes */
            plain = oracle_trace_one(&field, &settings, &ray);
            given.flags = i % 2 == 0 ? SPT_CANDIDATE_CLOSEST : SPT_CANDIDATE_PENUMBRA;
            settings = surface_settings(&run, &given);
            hit = oracle_trace_one(&field, &settings, &ray);
            CHECK(hit.outcome == SPT_HIT && check_same_bits(hit.t, plain.t) &&
                  check_same_bits(hit.residual, plain.residual) &&
                  hit.evaluations == plain.evaluations);
            CHECK_SAY(hit.candidate_ratio >= 0 &&
                          hit.candidate_ratio <= fabsf(hit.residual) + 1e-6f,
                      "%g, residual %g", (double)hit.candidate_ratio, (double)hit.residual);
        }
    }
}

/* ---- Scenes -------------------------------------------------------------------------------- */

enum { company_bodies = 4 };

/* Several bodies, none of which the ray meets. least, most: what the candidate's ratio may be. */
typedef struct company {
    spt_ray ray;
    passing seen[company_bodies];
    reference_field references[company_bodies];
    double least, most;
} company;

/* The least of all distances; of points exactly. For penumbras of points: from the sine to the
 * tangent of the least angle. */
static void draw_company(company *all, int points, int penumbra) {
    const passing_kind first = points ? PASSING_POINT : PASSING_SPHERE;
    double rounding = 0;
    do {
        all->seen[0] = passing_draw(first);
    } while (all->seen[0].closest < 0.06);
    all->ray = all->seen[0].ray;
    all->least = all->most = HUGE_VAL;
    for (int i = 0; i < company_bodies; ++i) {
        passing *one = &all->seen[i];
        while (i > 0 && (!(one->closest > 0.05) || one->at > (double)all->ray.t_max / 3 ||
                         !(one->at > (double)all->ray.t_min))) {
            const passing other =
                passing_draw(points ? PASSING_POINT : (passing_kind)(i % passing_kinds));
            *one = passing_of(&other.body, &all->ray);
        }
        all->references[i] = surface_body_field(&one->body);
        all->least = fmin(all->least, penumbra ? one->sine : one->closest);
        all->most = fmin(all->most, penumbra ? one->closest / (one->at * oracle_length(&all->ray))
                                             : one->closest);
        rounding = fmax(rounding, passing_rounding(one, 0.05) / one->closest);
    }
    all->least = points ? all->least * (1 - rounding) : 0;
    all->most *= 1 + rounding;
}

static void closest_in_scenes(void) {
    enum { draws = 12 };
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        for (int draw = 0; draw < draws; ++draw) {
            const int points = draw % 2, penumbra = draw % 4 == 3;
            static company all;
            spt_field fields[company_bodies];
            spt_scene united = spt_scene_default();
            spt_settings given = spt_settings_default(), settings;
            const spt_rays rays = spt_rays_of(&all.ray);
            spt_hit hit = {0, 0, 0, 0, 0, 0, 0, 0, 0};
            const spt_hits hits = spt_hits_of(&hit);
            void *workspace;
            size_t size;
            memset(&all, 0, sizeof all);
            draw_company(&all, points, penumbra);
            for (int i = 0; i < company_bodies; ++i) {
                fields[i] = surface_field(&run, &all.references[i], 0);
            }
            united.fields = fields;
            united.count = company_bodies;
            given.flags = penumbra ? SPT_CANDIDATE_PENUMBRA : SPT_CANDIDATE_CLOSEST;
            given.budget = 4000;
            settings = surface_settings(&run, &given);
            size = spt_scene_workspace(&united, &settings);
            CHECK(size > 0);
            workspace = malloc(size);
            if (workspace == NULL) return;
            CHECK(spt_scene_trace(&united, &settings, 1, &rays, &hits, workspace, size, NULL) ==
                  SPT_OK);
            free(workspace);
            CHECK_SAY(hit.outcome == SPT_MISS, "%d", hit.outcome);
            CHECK_SAY((double)hit.candidate_ratio <= all.most &&
                          (double)hit.candidate_ratio >= all.least,
                      "%s: %.9g, truth %.9g to %.9g", penumbra ? "penumbra" : "closest",
                      (double)hit.candidate_ratio, all.least, all.most);
        }
    }
}

/* ---- Contract ------------------------------------------------------------------------------ */

static void closest_refuses_both(void) {
    const surface_body ball = surface_sphere(0, 0, 6, 1);
    const reference_field reference = surface_body_field(&ball);
    const spt_field field = oracle_field(&reference, 0);
    spt_settings settings = spt_settings_default();
    const spt_ray ray = {{0, 0, 0}, 0, {0, 0, 1}, 100};
    const spt_rays rays = spt_rays_of(&ray);
    spt_hit hit = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    const spt_hits hits = spt_hits_of(&hit);
    settings.flags = SPT_CANDIDATE_CLOSEST | SPT_CANDIDATE_PENUMBRA;
    CHECK(spt_trace(&field, &settings, 1, &rays, &hits, NULL) == SPT_BAD_ARGUMENT);
}

/* A wall just behind the end of the ray: its only sample is far from it, and what it ends next to
 * counts all the same. */
static void closest_at_the_end(void) {
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        const surface_body wall = surface_sphere(0, 0, 5 + 1e3, 1e3);
        const reference_field reference = surface_body_field(&wall);
        const spt_field field = surface_field(&run, &reference, 0);
        spt_settings given = spt_settings_default(), settings;
        const spt_ray ray = {{0, 0, 0}, 0, {0, 0, 1}, 4.9f};
        spt_hit hit;
        given.flags = SPT_CANDIDATE_CLOSEST;
        settings = surface_settings(&run, &given);
        hit = oracle_trace_one(&field, &settings, &ray);
        CHECK_SAY(hit.outcome == SPT_MISS && (double)hit.candidate_ratio <= 0.1 + 1e-4, "%d, %g",
                  hit.outcome, (double)hit.candidate_ratio);
    }
}

void suite_surface_closest(void) {
    RUN(closest_approach);
    RUN(penumbra_angle);
    RUN(closest_of_hits);
    RUN(closest_in_scenes);
    RUN(closest_at_the_end);
    RUN(closest_refuses_both);
}
