/* SPDX-License-Identifier: MIT
 *
 * Distorted fields against deformations in double: where points go, where bodies end, how much
 * lengths stretch, and what distances may be. */
#include "bounds_volume.h"
#include "distort_world.h"
#include "check.h"

#include <math.h>
#include <string.h>

static void undistort(const spt_distorted *distorted, const double p[3], double q[3]) {
    float point[3];
    for (int k = 0; k < 3; ++k) point[k] = (float)p[k];
    const spt_vectors from = spt_vectors_of(point);
    const spt_vector_sinks to = spt_vector_sinks_of(point);
    CHECK(spt_distorted_points(distorted, 1, &from, &to) == SPT_OK);
    for (int k = 0; k < 3; ++k) q[k] = (double)point[k];
}

static double apart(const double a[3], const double b[3]) {
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return distort_length(d);
}

/* ---- Points and volumes --------------------------------------------------------------------- */

/* A point of the body, deformed, comes back. What may be lost, u = 2^-24: coordinates of up to 3
 * sizes are rounded before and after, with three products each way through the frame, 16u of them
 * together, and stretched by W; angles of up to 80 are off by 3u of themselves, sines and cosines
 * by 2.5u, which moves points of up to 2 sizes. Whole turns of a phase lose nothing. */
static void U1_points_come_back(void) {
    for (int i = 0; i < 400; ++i) {
        distort_case at;
        double q[3], p[3], back[3];
        const uint32_t kind = distort_kind_of[i % distort_kinds];
        distort_draw_case(&at, kind, distort_most_turn(kind));
        const double angle =
            3.2 +
            2 * at.size * (fabs((double)at.distortion.wave) + fabs((double)at.distortion.rate));
        const double lost =
            0x1p-24 * at.size * (48 * (double)at.field.lipschitz + 2 * (2.5 + 3 * angle));
        for (int j = 0; j < 10; ++j) {
            distort_body_point(&at, q);
            distort_forward(&at.distortion, q, p);
            distort_back(&at.distortion, p, back);
            CHECK_SAY(apart(q, back) <= 1e-12 * at.size, "the oracle's ways: %g", apart(q, back));
            CHECK_SAY(volume_excess(&at.memory.bound, p) < 0, "outside by %g",
                      volume_excess(&at.memory.bound, p));
            undistort(&at.memory, p, back);
            CHECK_SAY(apart(q, back) <= lost, "off by %g, %g", apart(q, back), lost);
        }
    }
}

/* Whatever volume the body fills and wherever the deformation has its origin, the result's bound
 * holds what becomes of it. */
static void U2_bounds_hold_bodies(void) {
    static const spt_bound_kind kinds[] = {SPT_BOUND_SPHERE,    SPT_BOUND_BOX,
                                           SPT_BOUND_CAPSULE,   SPT_BOUND_CYLINDER,
                                           SPT_BOUND_ELLIPSOID, SPT_BOUND_ORIENTED_BOX};
    int tried = 0;
    double fullest = -HUGE_VAL;
    for (int i = 0; i < 360; ++i) {
        volume inside;
        distort_body body = distort_body_of(ANALYTIC_SPHERE, 1);
        spt_field field = distort_field_of(&body, DISTORT_BATCH), result;
        spt_distorted memory;
        const uint32_t kind = distort_kind_of[i % distort_kinds];
        const double scale = pow(10, check_uniform(-3, 3));
        volume_draw(&inside, kinds[i / 4 % 6], scale);
        spt_distortion distortion = distort_draw(kind, 3 * scale, distort_most_turn(kind));
        field.bound = &inside.bound;
        check_context("kind %u of volume %d, scale %g", (unsigned)kind, (int)kinds[i / 4 % 6],
                      scale);
        CHECK(spt_distorted_field(&field, &distortion, &memory, &result) == SPT_OK);
        CHECK(result.bound == &memory.bound);
        for (int j = 0; j < 60; ++j) {
            double q[3], p[3];
            for (int k = 0; k < 3; ++k) {
                const double low = volume_support(&inside.bound, k, -1);
                const double high = volume_support(&inside.bound, k, 1);
                q[k] = low + (high - low) * fmin(fmax(check_uniform(-0.2, 1.2), 0), 1);
            }
            if (volume_excess(&inside.bound, q) > 0) continue;
            distort_forward(&distortion, q, p);
            const double excess = volume_excess(&memory.bound, p);
            CHECK_SAY(excess < 0, "outside by %g of %g", excess, inside.size);
            fullest = fmax(fullest, excess / inside.size);
            ++tried;
        }
    }
    /* They do not hold much more: some bodies come close to the boundary. */
    CHECK_SAY(tried > 3000 && fullest > -0.01, "%d points, %g", tried, fullest);
}

/* ---- Constants ------------------------------------------------------------------------------ */

/* The scale of a taper at a place. */
static double scale_at(const spt_distortion *distortion, const double p[3]) {
    double axis[3], height = 0;
    for (int k = 0; k < 3; ++k) axis[k] = (double)distortion->axis[k];
    for (int k = 0; k < 3; ++k) {
        height += (p[k] - (double)distortion->origin[k]) * axis[k] / distort_length(axis);
    }
    return 1 + (double)distortion->rate * height;
}

/* A random point of a box, on its faces as often as not. */
static void box_point(const spt_bound *box, double p[3]) {
    for (int k = 0; k < 3; ++k) p[k] = (double)box->center[k];
    for (int i = 0; i < 3; ++i) {
        const double share = fmin(fmax(check_uniform(-2, 2), -1), 1);
        for (int k = 0; k < 3; ++k) {
            p[k] += share * (double)box->half[i] * (double)box->axis[i][k];
        }
    }
}

/* A random point of the region where the constant holds, on its boundary as often as not: of a
 * sway, the bound; of the others the cylinder that is the bound, or about which it is a box, and of
 * a taper the part of that within a radius that follows the scale. */
static void region_point(const distort_case *at, double p[3]) {
    const spt_bound *const bound = &at->memory.bound;
    const double turn = check_uniform(0, 6.3), edge = fmin(check_uniform(0, 2), 1);
    const double share = fmin(fmax(check_uniform(-0.5, 1.5), 0), 1);
    const int tall = at->distortion.kind == SPT_DISTORTION_BEND ? 0 : 1;
    double from[3], to[3], along[3], a[3], b[3], radius = (double)bound->radius, slant = 0;
    if (at->distortion.kind == SPT_DISTORTION_SWAY) {
        box_point(bound, p);
        return;
    }
    for (int k = 0; k < 3; ++k) {
        const double half = (double)bound->half[tall] * (double)bound->axis[tall][k];
        from[k] = (double)bound->center[k];
        to[k] = (double)bound->end[k];
        if (bound->kind != SPT_BOUND_ORIENTED_BOX) continue;
        to[k] = from[k] + half;
        from[k] -= half;
        radius = (double)bound->half[2];
    }
    distort_unit(a);
    for (int k = 0; k < 3; ++k) {
        along[k] = to[k] - from[k];
        p[k] = from[k] + share * along[k];
    }
    const double length = distort_length(along);
    for (int k = 0; k < 3; ++k) slant += a[k] * along[k] / (length * length);
    for (int k = 0; k < 3; ++k) a[k] -= slant * along[k];
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        b[k] = (along[i] * a[j] - along[j] * a[i]) / length;
    }
    if (at->distortion.kind == SPT_DISTORTION_TAPER) {
        radius *= scale_at(&at->distortion, p) /
                  fmax(scale_at(&at->distortion, from), scale_at(&at->distortion, to));
    }
    const double arm = radius * edge / distort_length(a);
    for (int k = 0; k < 3; ++k) p[k] += arm * (cos(turn) * a[k] + sin(turn) * b[k]);
}

/* Nowhere in the region is the stretch above the constant, and somewhere it is nearly that; of a
 * sway in some phase. Differences in distort_stretch() are good to 1e-7 or so. */
static void U3_constants_hold_and_are_attained(void) {
    for (int i = 0; i < 40; ++i) {
        distort_case at;
        double largest = 0;
        const uint32_t kind = distort_kind_of[i % distort_kinds];
        distort_draw_case(&at, kind, kind == SPT_DISTORTION_TAPER ? 0.8 : 3);
        /* Steps of the differences are meant for sizes about 1. */
        if (at.size < 0.5) continue;
        const double constant = (double)at.field.lipschitz;
        for (int j = 0; j < 400; ++j) {
            double p[3];
            spt_distortion phase = at.distortion;
            if (kind == SPT_DISTORTION_SWAY) phase.phase = (float)check_uniform(-3.2, 3.2);
            region_point(&at, p);
            largest = fmax(largest, distort_stretch(&phase, p));
        }
        CHECK_SAY(largest <= constant * (1 + 1e-6), "%.9g above %.9g", largest, constant);
        CHECK_SAY(largest >= constant * 0.97, "%.9g, not %.9g", largest, constant);
    }
}

/* The field is never more than constant times the distance to a point of the deformed body, and
 * changes no faster, from anywhere to anywhere: inside, near and far beyond the bound. */
static void U4_distances_are_bounds_everywhere(void) {
    for (int i = 0; i < 160; ++i) {
        distort_case at;
        double last[3] = {0, 0, 0}, value = 0, steepest = 0;
        const uint32_t kind = distort_kind_of[i % distort_kinds];
        distort_draw_case(&at, kind, distort_most_turn(kind));
        const double constant = (double)at.field.lipschitz;
        for (int j = 0; j < 60; ++j) {
            double q[3], p[3], x[3];
            const double away = at.size * pow(10, check_uniform(-3, j % 4 == 0 ? 3 : 0.5));
            distort_body_point(&at, q);
            distort_forward(&at.distortion, q, p);
            distort_unit(x);
            for (int k = 0; k < 3; ++k) {
                x[k] = (double)(float)((j % 2 == 0 ? p[k] : last[k]) + away * x[k]);
            }
            const double here = (double)distort_ask(&at.field, x);
            /* U1's, with coordinates of up to 3 sizes and `reach`; and f rounds. */
            const double reach = distort_length(x) + distort_length(last) + 3 * at.size;
            const double noise = 0x1p-24 * constant * 64 * reach;
            const double distance = apart(x, p), step = apart(x, last);
            CHECK_SAY(here <= constant * distance + noise, "%.9g, distance %.9g times %g", here,
                      distance, constant);
            if (j > 0) {
                CHECK_SAY(fabs(here - value) <= constant * step + noise,
                          "changes by %.9g in %.9g times %g", fabs(here - value), step, constant);
                steepest = fmax(steepest, (fabs(here - value) - noise) / (constant * step));
            }
            const double excess = volume_excess(&at.memory.bound, x);
            CHECK_SAY(here >= constant * fmin(excess, 1e3 * at.size) * 0.999 - noise,
                      "%.9g at %.9g beyond the bound", here, excess);
            memcpy(last, x, sizeof last);
            value = here;
        }
        CHECK_SAY(steepest > 0.3, "%g", steepest);
    }
}

/* The library's own audit finds nothing. */
static void U5_fields_keep_their_promises(void) {
    for (int i = 0; i < 16; ++i) {
        distort_case at;
        spt_field_faults faults;
        const uint32_t kind = distort_kind_of[i % distort_kinds];
        distort_draw_case(&at, kind, kind == SPT_DISTORTION_TAPER ? 0.8 : 3);
        CHECK(spt_field_check(&at.field, 400, (uint32_t)i, &faults) == SPT_OK);
        CHECK_SAY(faults.steep == 0 && faults.outside_bound == 0 && faults.nonfinite == 0,
                  "%u steep, %u outside", (unsigned)faults.steep, (unsigned)faults.outside_bound);
        CHECK(at.body.faults == 0);
    }
}

/* ---- Time ----------------------------------------------------------------------------------- */

/* Constant and bound of a sway are the same in all phases, and what moves does so by no more than
 * rate height^2 times the change of the phase, over whole turns, too. */
static void U6_phases_are_continuous(void) {
    for (int i = 0; i < 20; ++i) {
        distort_case at;
        double p[3] = {0, 0, 0}, before = 0;
        float phase = (float)check_uniform(-30, 20);
        distort_draw_case(&at, SPT_DISTORTION_SWAY, 2);
        const spt_field inner = distort_field_of(&at.body, DISTORT_BATCH);
        const spt_distorted first = at.memory;
        const double height = 1.9 * at.size;
        const double sway = fabs((double)at.distortion.rate) * height * height;
        for (int k = 0; k < 3; ++k) p[k] = at.size * check_uniform(-1, 1);
        for (int j = 0; j < 150; ++j) {
            const float next = phase + 0.05f;
            at.distortion.phase = next;
            CHECK(spt_distorted_field(&inner, &at.distortion, &at.memory, &at.field) == SPT_OK);
            CHECK(check_same_bits(at.memory.distortion.lipschitz, first.distortion.lipschitz));
            CHECK(memcmp(&at.memory.bound, &first.bound, sizeof first.bound) == 0);
            const double here = (double)distort_ask(&at.field, p);
            const double moved = sway * ((double)next - (double)phase);
            const double noise = 0x1p-24 * (100 + 3 * 40) * (at.size + sway);
            if (j > 0) {
                CHECK_SAY(fabs(here - before) <= moved + noise, "%g in a step of %g",
                          fabs(here - before), moved);
            }
            before = here;
            phase = next;
        }
    }
}

void suite_distort(void) {
    RUN(U1_points_come_back);
    RUN(U2_bounds_hold_bodies);
    RUN(U3_constants_hold_and_are_attained);
    RUN(U4_distances_are_bounds_everywhere);
    RUN(U5_fields_keep_their_promises);
    RUN(U6_phases_are_continuous);
}
