/* SPDX-License-Identifier: MIT
 *
 * Distorted fields against deformations in double: where rays hit, and gradients. */
#include "distort_world.h"
#include "harness.h"
#include "check.h"

#include <math.h>
#include <string.h>

/* ---- Rays ----------------------------------------------------------------------------------- */

enum { ray_count = 16, dense = 1500 };

/* The first crossing of f(W(p)) on dense samples; +infinity where there is none. */
static double first_crossing(const distort_case *at, const spt_ray *ray) {
    double before = 0, p[3];
    for (int i = 0; i <= dense; ++i) {
        double t = (double)ray->t_max * i / dense;
        for (int k = 0; k < 3; ++k) {
            p[k] = (double)ray->origin[k] + t * (double)ray->direction[k];
        }
        if (distort_distance(&at->body, &at->distortion, p) < 0) {
            double low = before, high = t;
            for (int half = 0; half < 50; ++half) {
                const double middle = 0.5 * (low + high);
                for (int k = 0; k < 3; ++k) {
                    p[k] = (double)ray->origin[k] + middle * (double)ray->direction[k];
                }
                if (distort_distance(&at->body, &at->distortion, p) < 0)
                    high = middle;
                else
                    low = middle;
            }
            return high;
        }
        before = t;
    }
    return HUGE_VAL;
}

static void draw_ray(const distort_case *at, spt_ray *ray) {
    double q[3], p[3], from[3], length;
    distort_body_point(at, q);
    distort_forward(&at->distortion, q, p);
    distort_unit(from);
    for (int k = 0; k < 3; ++k) {
        ray->origin[k] = (float)(at->size * 6 * from[k]);
        p[k] += at->size * check_uniform(-0.2, 0.2);
        from[k] = p[k] - (double)ray->origin[k];
    }
    length = distort_length(from);
    for (int k = 0; k < 3; ++k) ray->direction[k] = (float)(from[k] / length);
    ray->t_min = 0;
    ray->t_max = (float)(at->size * 12);
}

/* No crossing that dense samples find is passed, by any rule at any width; and where a ray is said
 * to hit, the body is within the tolerance in double. */
static void U7_rays_lose_no_hit(void) {
    for (int i = 0; i < 2 * distort_kinds; ++i) {
        distort_case at;
        spt_ray rays[ray_count];
        spt_hit hits[ray_count];
        double truth[ray_count];
        int met = 0;
        oracle_run run = oracle_first_run;
        const uint32_t kind = distort_kind_of[i % distort_kinds];
        do {
            distort_draw_case(&at, kind, distort_most_turn(kind));
        } while (at.size < 0.1 || at.size > 10 || at.body.shape.kind == ANALYTIC_TORUS);
        for (int ray = 0; ray < ray_count; ++ray) {
            draw_ray(&at, &rays[ray]);
            truth[ray] = first_crossing(&at, &rays[ray]);
            met += truth[ray] < HUGE_VAL;
        }
        CHECK(met > 4);
        while (oracle_next(&run, 0)) {
            spt_settings settings = oracle_settings(&run);
            settings.budget = 4000;
            settings.epsilon = (float)(1e-4 * at.size);
            oracle_trace(&at.field, &settings, ray_count, rays, hits);
            for (int ray = 0; ray < ray_count; ++ray) {
                const double t = (double)hits[ray].t;
                /* epsilon, and what float positions of 6 to 12 sizes are off by: 2^-19 of them */
                const double allowed = (1e-4 + 12 * 0x1p-19) * at.size;
                CHECK_SAY(hits[ray].outcome != SPT_LIMIT && hits[ray].flags == 0,
                          "outcome %d, flags %u", hits[ray].outcome, hits[ray].flags);
                CHECK_SAY(truth[ray] >= HUGE_VAL || hits[ray].outcome == SPT_HIT,
                          "lost a hit at %.9g", truth[ray]);
                if (hits[ray].outcome != SPT_HIT) continue;
                double p[3];
                for (int k = 0; k < 3; ++k) {
                    p[k] = (double)rays[ray].origin[k] + t * (double)rays[ray].direction[k];
                }
                const double f = distort_distance(&at.body, &at.distortion, p);
                CHECK_SAY(fabs(f) <= allowed * (double)at.field.lipschitz, "%g at a hit", f);
                CHECK_SAY(t <= truth[ray] + allowed, "hit at %.9g, not %.9g", t, truth[ray]);
            }
        }
    }
}

/* ---- Gradients ------------------------------------------------------------------------------ */

/* J^T g with the Jacobian by differences in double. Its direction is off by little more than the
 * inner gradient's, which is exact to 1e-6 where it does not jump, times what angles are stretched
 * by, the square of the constant at most; points where it jumps nearby are left out. */
static void U8_gradients(void) {
    int looked = 0;
    for (int i = 0; i < 120; ++i) {
        distort_case at;
        const uint32_t kind = distort_kind_of[i % distort_kinds];
        distort_draw_case(&at, kind, distort_most_turn(kind));
        if (at.size < 0.5 || at.size > 20) continue;
        for (int j = 0; j < 10; ++j) {
            double q[3], p[3], n[3], wanted[3], seen[3], dot = 0;
            distort_body_point(&at, q);
            distort_forward(&at.distortion, q, p);
            for (int k = 0; k < 3; ++k) p[k] = (double)(float)p[k];
            distort_back(&at.distortion, p, q);
            double jump = 0;
            for (int k = 0; k < 3; ++k) {
                double ends[2], at_end[3];
                for (int end = 0; end < 2; ++end) {
                    memcpy(at_end, q, sizeof at_end);
                    at_end[k] += (end ? 1 : -1) * 1e-3 * at.size;
                    ends[end] = analytic_distance(&at.body.shape, at_end);
                }
                n[k] = (ends[1] - ends[0]) / (2e-3 * at.size);
                jump =
                    fmax(jump, fabs(ends[0] + ends[1] - 2 * analytic_distance(&at.body.shape, q)) /
                                   at.size);
            }
            if (jump > 1e-5) continue;
            distort_back_transposed(&at.distortion, p, n, wanted);
            distort_ask_gradient(&at.field, p, seen);
            for (int k = 0; k < 3; ++k) dot += wanted[k] * seen[k];
            dot /= distort_length(wanted) * distort_length(seen);
            CHECK_SAY(dot >= 1 - 1e-4, "cosine %.9g, L %g", dot, (double)at.field.lipschitz);
            ++looked;
        }
    }
    CHECK_SAY(looked > 100, "%d points", looked);
}

void suite_distort_rays(void) {
    RUN(U7_rays_lose_no_hit);
    RUN(U8_gradients);
}
