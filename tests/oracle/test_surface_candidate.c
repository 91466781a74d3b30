/* SPDX-License-Identifier: MIT
 *
 * The screen-space candidate and what callers make of it: rows D5, E4, P15 and P16,
 * spt_hit_or_candidate(), and spt_coverage() against the exact area of a disc in its pixels. */
#include "surface_oracle.h"
#include "../check.h"

#include <spheretrace/surface.h>

#include <math.h>

/* S0 past the unit sphere at (0, 5, 10). Forcing a hit as printed gives t = 12.2. */
static void D5_candidate_of_a_miss(void) {
    const surface_body ball = surface_sphere(0, 5, 10, 1);
    const reference_field reference = surface_body_field(&ball);
    const spt_ray ray = {{0, 0, 0}, 0, {0, 0, 1}, 100};
    for (surface_run run = surface_runs(SURFACE_ALL_RULES | SURFACE_CONVEX); surface_next(&run);) {
        const spt_settings given = spt_settings_default();
        const spt_settings settings = surface_settings(&run, &given);
        const spt_field field = surface_field(&run, &reference, SPT_FIELD_CONVEX);
        const spt_hit hit = oracle_trace_one(&field, &settings, &ray);
        const double t = (double)hit.candidate_t, ratio = (double)hit.candidate_ratio;
        const double there = (sqrt(25 + (10 - t) * (10 - t)) - 1) / t;
        CHECK(hit.outcome == SPT_MISS);
        CHECK_SAY(fabs(ratio - there) <= 0x1p-22, "%.9g at %.9g: %.9g", ratio, t, there);
        /* The least there is: 0.3654 at t = 12. */
        CHECK_SAY(ratio >= 0.365 && ratio <= 0.5, "%.9g", ratio);
        CHECK(check_same_bits(spt_hit_or_candidate(&hit, SPT_FORCE_PIXEL, 1), INFINITY));
        CHECK(check_same_bits(spt_hit_or_candidate(&hit, SPT_FORCE_LIMIT, 1), INFINITY));
        CHECK(check_same_bits(spt_hit_or_candidate(&hit, SPT_FORCE_ALWAYS, 0), hit.candidate_t));
    }
}

/* P15: the text returns the candidate and the listing infinity unless a hit is forced. */
static void P15_hit_or_candidate(void) {
    static const struct {
        int32_t outcome;
        float ratio;
        int candidate[3]; /* by force: whether the candidate counts */
    } cases[] = {{SPT_MISS, 0.5e-3f, {0, 0, 1}},    {SPT_MISS, 2e-3f, {0, 0, 1}},
                 {SPT_LIMIT, 0.5e-3f, {1, 1, 1}},   {SPT_LIMIT, 2e-3f, {0, 1, 1}},
                 {SPT_LIMIT, 1e-3f, {0, 1, 1}},     {SPT_NONFINITE, 0.5e-3f, {0, 0, 0}},
                 {SPT_BAD_RAY, INFINITY, {0, 0, 0}}};
    for (int i = 0; i < 7; ++i) {
        for (int force = 0; force < 3; ++force) {
            spt_hit hit = {3, 0.1f, 0, 5, 0, -1, 7, 0, 0};
            hit.outcome = cases[i].outcome;
            hit.candidate_ratio = cases[i].ratio;
            CHECK_SAY(check_same_bits(spt_hit_or_candidate(&hit, (spt_force)force, 1e-3f),
                                      cases[i].candidate[force] ? 7 : INFINITY),
                      "case %d, force %d", i, force);
            hit.outcome = SPT_HIT;
            CHECK(check_same_bits(spt_hit_or_candidate(&hit, (spt_force)force, 1e-3f), 3));
        }
    }
}

/* P16: as seen from the eye, not from where a secondary ray begins. */
static void P16_candidate_with_a_path(void) {
    const surface_body ball = surface_sphere(0, 3, 10, 1);
    const reference_field reference = surface_body_field(&ball);
    for (surface_run run = surface_runs(SURFACE_ALL_RULES | SURFACE_CONVEX); surface_next(&run);) {
        const spt_field field = surface_field(&run, &reference, SPT_FIELD_CONVEX);
        for (int i = 0; i < 8; ++i) {
            const spt_ray ray = {{0, 0, 0}, 0, {0, 0, 2}, 50};
            const float path = (float)(i % 4 * 10);
            spt_settings given = spt_settings_default(), settings;
            spt_rays rays = spt_rays_of(&ray);
            spt_hit hit = {0, 0, 0, 0, 0, 0, 0, 0, 0};
            const spt_hits hits = spt_hits_of(&hit);
            double z, distance;
            /* The ray passes 2 from the ball where it has gone 10: with 0.06 it stops only if the
             * path makes that pixel wide enough, which is from 2 / 0.06 - 10 = 23 on. */
            given.pixel_radius = i < 4 ? 0 : 0.06f;
            settings = surface_settings(&run, &given);
            rays.path.first = &path;
            CHECK(spt_trace(&field, &settings, 1, &rays, &hits, NULL) == SPT_OK);
            z = 2 * (double)hit.candidate_t;
            distance = sqrt(9 + (10 - z) * (10 - z)) - 1;
            CHECK_SAY(hit.outcome == (i < 7 ? SPT_MISS : SPT_HIT), "case %d: %d", i, hit.outcome);
            CHECK_SAY(fabs((double)hit.candidate_ratio - distance / ((double)path + z)) <=
                          0x1p-22 * (double)hit.candidate_ratio * 8,
                      "case %d: %.9g for %.9g", i, (double)hit.candidate_ratio,
                      distance / ((double)path + z));
            if (hit.outcome == SPT_HIT) CHECK(check_same_bits(hit.candidate_t, hit.t));
        }
    }
}

static real ripples(const void *user, const real position[3]) {
    (void)user;
    return (real)(0.01 + 0.005 * sin(40 * (double)position[2]));
}

/* E4: never reached within the budget; the candidate is the least ratio seen, hence no more than
 * at the last sample, and it is what a forced hit gives. */
static void E4_candidate_of_a_limit(void) {
    const reference_field reference = {ripples, NULL, 1};
    const spt_ray ray = {{0, 0, 0}, 0, {0, 0, 1}, 100};
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        const spt_settings given = spt_settings_default();
        const spt_settings settings = surface_settings(&run, &given);
        const spt_field field = surface_field(&run, &reference, 0);
        const spt_hit hit = oracle_trace_one(&field, &settings, &ray);
        const double t = (double)hit.candidate_t;
        CHECK(hit.outcome == SPT_LIMIT && hit.evaluations == 128);
        CHECK(hit.candidate_ratio <= hit.residual / hit.t * (1 + 0x1p-20f));
        CHECK_SAY(fabs((double)hit.candidate_ratio - (0.01 + 0.005 * sin(40 * t)) / t) <=
                      0x1p-20 * (double)hit.candidate_ratio + 0.2 * 0x1p-24,
                  "%.9g at %.9g", (double)hit.candidate_ratio, t);
        CHECK(check_same_bits(spt_hit_or_candidate(&hit, SPT_FORCE_LIMIT, 1e-6f), hit.candidate_t));
        CHECK(check_same_bits(spt_hit_or_candidate(&hit, SPT_FORCE_PIXEL, 1e-6f), INFINITY));
        CHECK(check_same_bits(spt_hit_or_candidate(&hit, SPT_FORCE_PIXEL, 1), hit.candidate_t));
    }
}

/* ---- Coverage ------------------------------------------------------------------------------ */

enum { side = 64, columns = 256 };
static const double disc_radius = 25.3; /* pixels */
static const double shift[2] = {0.31, 0.17};

/* The part of the pixel with the center (x, y), a square with sides of 1, that lies in the disc
 * around 0: exact along y, the mean of many columns along x. */
static double disc_area(double x, double y) {
    double sum = 0;
    for (int i = 0; i < columns; ++i) {
        const double across = x - 0.5 + (i + 0.5) / columns;
        const double square = disc_radius * disc_radius - across * across;
        if (square > 0) {
            const double reach = sqrt(square);
            sum += fmax(0, fmin(reach, y + 0.5) - fmax(-reach, y - 0.5));
        }
    }
    return sum / columns;
}

/* Coverage of the pixels that a ball's silhouette touches though their middle misses it. Rays are
 * traced to the ball itself: with the pixel cone on all these would be hits.
 *
 * The estimate's error. A straight edge at distance d (in pixels) from the middle covers 1/2 - d of
 * a pixel that lies along it, which is the estimate with q = d; of one that stands on a corner
 * (1/sqrt(2) - d)^2, up to (sqrt(2) - 1)^2 / 4 = 0.043 off at d = 0.21 and 0.5. The disc curves away
 * from its tangent by at most 0.5 / (2 * 25.3) = 0.01 over a pixel. Samples lie at most step apart,
 * so one within step / 2 of the closest approach: f there is at most (step / 2)^2 / 2R more than d,
 * 0.01 d for d <= 1/2 and plain steps, 0.05 for the longest (of 3 f, or 2 f and less where f is
 * level). The rule for convex fields ends where f rises, wherever its last samples were. */
static void coverage_of_a_disc(void) {
    const double half = 1e-3; /* half a pixel at distance 1 */
    const double away = 10, tangent = disc_radius * 2 * half;
    const surface_body ball = surface_sphere(0, 0, away, away * tangent / hypot(1, tangent));
    const reference_field reference = surface_body_field(&ball);
    static spt_ray rays[side * side];
    static spt_hit hits[side * side];
    static double area[side * side];
    for (int i = 0; i < side * side; ++i) {
        const double x = i % side + 0.5 - side / 2 + shift[0],
                     y = i / side + 0.5 - side / 2 + shift[1];
        const double eye[3] = {0, 0, 0}, target[3] = {2 * half * x, 2 * half * y, 1};
        rays[i] = surface_aim(eye, target, 1, 100);
        area[i] = disc_area(x, y);
    }
    for (surface_run run = surface_runs(SURFACE_ALL_RULES | SURFACE_CONVEX); surface_next(&run);) {
        const spt_field field = surface_field(&run, &reference, SPT_FIELD_CONVEX);
        spt_settings given = spt_settings_default(), settings;
        const int convex = run.method == spt_convex();
        const double allowed = 0.043 + 0.01 + (run.method == spt_basic() ? 0.01 : 0.05);
        int edges = 0, partly = 0;
        if (run.point || (run.lanes != 1 && run.lanes != (uint32_t)spt_lanes())) continue;
        given.epsilon = 1e-5f;
        given.budget = 400;
        settings = surface_settings(&run, &given);
        oracle_trace(&field, &settings, side * side, rays, hits);
        for (int i = 0; i < side * side; ++i) {
            const spt_hit *hit = &hits[i];
            const double covered =
                (double)spt_coverage(hit->outcome, hit->candidate_ratio, (float)half);
            CHECK(covered >= 0 && covered <= 1);
            if (hit->outcome == SPT_HIT) {
                CHECK(covered >= 1);
                continue;
            }
            CHECK(hit->outcome == SPT_MISS && covered <= 0.5);
            CHECK_SAY(covered - area[i] <= allowed, "pixel %d: %g, area %g", i, covered, area[i]);
            if (!convex) {
                CHECK_SAY(area[i] - covered <= allowed, "pixel %d: %g, area %g", i, covered,
                          area[i]);
            }
            edges += area[i] > 0;
            partly += covered > 0;
        }
        CHECK_SAY(edges > 80 && (convex || partly > 60), "%d pixels, %d covered", edges, partly);
    }
}

static void coverage_by_outcome(void) {
    CHECK(check_same_bits(spt_coverage(SPT_HIT, 0.7f, 1), 1));
    CHECK(check_same_bits(spt_coverage(SPT_MISS, 0, 2e-3f), 0.5f));
    CHECK(check_same_bits(spt_coverage(SPT_LIMIT, 0, 2e-3f), 0.5f));
    CHECK(check_same_bits(spt_coverage(SPT_MISS, 1, 2), 0.25f));
    CHECK(check_same_bits(spt_coverage(SPT_MISS, 2, 2), 0));
    CHECK(check_same_bits(spt_coverage(SPT_MISS, INFINITY, 2), 0));
    CHECK(check_same_bits(spt_coverage(SPT_NONFINITE, 0, 2), 0));
    CHECK(check_same_bits(spt_coverage(SPT_BAD_RAY, INFINITY, 2), 0));
}

void suite_surface_candidate(void) {
    RUN(D5_candidate_of_a_miss);
    RUN(P15_hit_or_candidate);
    RUN(P16_candidate_with_a_path);
    RUN(E4_candidate_of_a_limit);
    RUN(coverage_of_a_disc);
    RUN(coverage_by_outcome);
}
