/* SPDX-License-Identifier: MIT
 *
 * spt_offset(): row F5 of the catalogue, thin sheets and narrow gaps, bounds that underestimate,
 * far coordinates, starts inside. The state that it returns must be true in double, and the right
 * one where one of its depths would do. Left out: paths through bodies, see test_glass_paths.c. */
#include "check.h"
#include "glass_landing.h"
#include "rules.h"

#include <math.h>

#include <string.h>

static landing surface_of(landing_kind kind, double place, double width, double weak) {
    landing surface = {kind, place, width, weak, 0, 0};
    return surface;
}

/* One case; the evaluations, one call each, are at most the checks. */
static landing_result offset_one(landing *surface, const spt_settings *settings, uint32_t checks,
                                 const landing_case *one) {
    const spt_field field = landing_field(surface);
    landing_result result;
    surface->calls = 0;
    landing_offset(&field, settings, checks, 1, one, &result);
    CHECK_SAY(surface->calls <= checks, "%u evaluations of %u", surface->calls, checks);
    return result;
}

static double clearance_of(const landing *surface, const landing_case *one,
                           const landing_result *result) {
    const double p[3] = {(double)result->origin[0], (double)result->origin[1],
                         (double)result->origin[2]};
    return landing_clearance(surface, one, p);
}

/* ---- F5: two plates ------------------------------------------------------------------------- */

/* A hit with |f| = 0.05 needs a tolerance above that. In the gap of 0.05 and below no point has
 * such an f; there the hit is in the middle. */
static void F5_two_plates(void) {
    static const double gaps[] = {0.4, 0.2, 0.1, 0.05, 0.025};
    for (int i = 0; i < 5; ++i) {
        landing surface = surface_of(LANDING_GAP, 0, gaps[i], 1);
        const double over = fmin(0.05, gaps[i] / 2);
        spt_settings settings = spt_settings_default();
        settings.epsilon = 0.06f;
        for (uint32_t checks = 1; checks <= 4; ++checks) {
            for (int cross = 0; cross < 2; ++cross) {
                landing_case one = landing_hit(&surface, over, 0, 0);
                landing_result result;
                double clearance;
                check_context("gap %g, %u checks, cross %d", gaps[i], checks, cross);
                one.cross = cross;
                one.normal[2] = 1; /* in the middle both plates are as near */
                result = offset_one(&surface, &settings, checks, &one);
                clearance = clearance_of(&surface, &one, &result);
                landing_expect_true(&surface, &settings, &one, &result);
                CHECK_SAY(clearance > 0 || result.start == SPT_START_AT_HIT,
                          "clearance %g, start %d", clearance, (int)result.start);
                /* Room for twice the tolerance: under the plate always. The ray begins within 4. */
                CHECK_SAY((!cross && gaps[i] < 0.24) || clearance >= 0.12 - 0x1p-22 * 4,
                          "clearance %g", clearance);
                /* No depth from 0.06 on stays in a gap that is narrower. */
                CHECK_SAY(cross || gaps[i] > 0.06 || result.start == SPT_START_AT_HIT, "start %d",
                          (int)result.start);
            }
        }
    }
}

/* As printed, 2 max(epsilon_min, |f|) along the normal, in gaps up to 0.1: in the other plate. */
static void F5_two_plates_printed(void) {
    static const double gaps[] = {0.4, 0.2, 0.1};
    for (int i = 0; i < 3; ++i) {
        const landing surface = surface_of(LANDING_GAP, 0, gaps[i], 1);
        const double p[3] = {0, 0, 0.05 + 2 * fmax(1e-4, 0.05)};
        CHECK((landing_distance(&surface, p) < 0) == (gaps[i] < 0.15));
    }
}

/* ---- The truth of every state --------------------------------------------------------------- */

/* The depth at which an origin is tried lies beyond the surface as f tells where that is;
 * algorithms names w, and then w / 2, 2 w and 4 w. Where one of them is on the side that was asked
 * for by more than rounding, an origin must be found there. */
static void expect_found(const landing *surface, const spt_settings *settings,
                         const landing_case *one, const landing_result *result, int depths) {
    static const double share[4] = {1, 0.5, 2, 4};
    const double w = 2 * landing_tolerance(settings, result);
    const int inside = (one->hit.flags & SPT_FLAG_INSIDE) != 0;
    const double side = inside ? -1 : 1, g = side * (double)one->hit.residual;
    int found = 0;
    for (int i = 0; i < depths; ++i) {
        const double move = one->cross ? -(g + share[i] * w) : fmax(0, share[i] * w - g);
        double p[3];
        for (int axis = 0; axis < 3; ++axis) {
            p[axis] = (double)one->ray.origin[axis] +
                      (double)one->hit.t * (double)one->ray.direction[axis] +
                      side * move * (double)one->normal[axis];
        }
        found |= landing_clearance(surface, one, p) > 0.01 * w + 0x1p-22 * fabs(p[2]);
    }
    CHECK_SAY(!found || result->start != SPT_START_AT_HIT, "start %d, f %.9g, w %.9g",
              (int)result->start, (double)one->hit.residual, w);
}

typedef struct tally {
    int states[3], rays;
} tally;

static void expect_all(landing *surface, spt_settings *settings, tally *sum) {
    const int inside = check_random() % 3 == 0;
    const double path = settings->pixel_radius > 0 ? check_uniform(0, 20) : 0;
    const double far = fabs(surface->place) + 4;
    /* The tolerance of the hit and of the next ray differ by the rounding at most. */
    const double tolerance = fmax(fmax((double)settings->epsilon, 0x1p-22 * 2 * far),
                                  (double)settings->pixel_radius * path);
    const double over = check_uniform(-0.1, 0.95) * tolerance * surface->weak;
    landing_case one = landing_hit(surface, inside ? -over : over, inside, path);
    landing_result result;
    one.cross = check_random() % 2 != 0;
    for (uint32_t checks = 1; checks <= 4; ++checks) {
        result = offset_one(surface, settings, checks, &one);
        landing_expect_true(surface, settings, &one, &result);
        expect_found(surface, settings, &one, &result, checks == 4 ? 4 : 1);
        ++sum->states[result.start < 0 || result.start > 2 ? 2 : result.start];
        ++sum->rays;
    }
    result = offset_one(surface, settings, 0, &one); /* trusts: an exact surface with room around */
    if (surface->weak > 1 || surface->width < 100 * tolerance) return;
    landing_expect_true(surface, settings, &one, &result);
    CHECK(result.start == SPT_START_CLEAR);
}

/* Widths from a tenth of a tolerance to far more, bounds down to a tenth of the distance, places
 * out to 1e6, pixel cones. */
static void F5_states_are_true(void) {
    static const double places[] = {0, -1, 100, 1e4, 1e6};
    static const double weaknesses[] = {1, 1, 2, 5, 10};
    static const float epsilons[] = {1e-4f, 1e-3f, 1e-2f};
    tally all = {{0, 0, 0}, 0};
    for (int draw = 0; draw < 4000; ++draw) {
        const landing_kind kind = (landing_kind)(check_random() % LANDING_KINDS);
        const double place = places[check_random() % 5], weak = weaknesses[check_random() % 5];
        spt_settings settings = spt_settings_default();
        double tolerance, width;
        landing surface;
        settings.epsilon = epsilons[check_random() % 3];
        if (check_random() % 4 == 0) settings.pixel_radius = 1e-3f;
        tolerance = fmax((double)settings.epsilon, 0x1p-21 * fabs(place));
        width = tolerance * pow(10, check_uniform(-1, 4));
        if (kind == LANDING_BALL) width = fmax(width, 20 * tolerance);
        surface = surface_of(kind, place, width, weak);
        check_context("kind %d at %g, width %g, weak %g, epsilon %g, pixel %g", (int)kind, place,
                      width, weak, (double)settings.epsilon, (double)settings.pixel_radius);
        expect_all(&surface, &settings, &all);
    }
    check_context("all");
    CHECK_SAY(all.states[0] > all.rays / 2 && all.states[1] > 50 && all.states[2] > 200,
              "%d clear, %d near, %d at the hit", all.states[0], all.states[1], all.states[2]);
}

void suite_offset(void) {
    RUN(F5_two_plates);
    RUN(F5_two_plates_printed);
    RUN(F5_states_are_true);
}
