/* SPDX-License-Identifier: MIT
 *
 * Fields under one map traced: spt_conformal_field() by every step rule and width, and
 * spt_conformal_trace() by exits, against where rays meet the images of balls and half spaces.
 * Stiff rays and broken calls of spt_conformal_trace() are in test_mobius_trace_cases.c. */
#include "../check.h"
#include "mobius_world.h"

#include "harness.h"

#include <float.h>
#include <math.h>

enum { worlds = 48 };

/* A world with rays, the truth, and settings of its scale. Not to be copied. */
typedef struct traced_world {
    mapped_world world;
    spt_settings settings;
    spt_ray rays[mapped_rays];
    mapped_hit truth[mapped_rays];
    extended slack[mapped_rays];
    int clear[mapped_rays];
    size_t count;
} traced_world;

/* A ray is decided if it passes what it does not meet by 100 tolerances, and float costs the field
 * less than a tenth of that at both its ends. */
static void draw_traced(traced_world *one, int n) {
    double gap;
    mapped_draw(&one->world, n);
    one->settings = spt_settings_default();
    one->settings.epsilon = (float)(1e-4 * one->world.size);
    one->settings.budget = 1000;
    gap = 100 * (double)one->settings.epsilon;
    one->count = 0;
    for (int i = 0; i < 4 * mapped_rays && one->count < mapped_rays; ++i) {
        spt_ray *ray = &one->rays[one->count];
        mapped_hit *truth = &one->truth[one->count];
        place from;
        if (!mapped_ray(&one->world, ray)) continue;
        *truth = mapped_trace(&one->world, ray, gap);
        from = mapped_place(ray->origin);
        one->clear[one->count] =
            truth->clear && mapped_rounding(&one->world, &from) < (extended)gap / 10;
        if (truth->meets && truth->cosine >= 0.2L) {
            one->slack[one->count] = mapped_slack(&one->world, &one->settings, ray, truth);
            if (!(one->slack[one->count] * (extended)oracle_length(ray) < (extended)gap))
                one->clear[one->count] = 0;
        }
        ++one->count;
    }
}

/* Where the truth is decided, a hit is where it must be, and a miss is one. No hit is ever behind
 * a surface that is met at a fair angle. Returns whether it was a decided hit. */
static int judge(const traced_world *one, size_t i, const spt_hit *hit) {
    const mapped_hit *truth = &one->truth[i];
    if (truth->meets && truth->cosine >= 0.2L && one->slack[i] >= 0) {
        CHECK_SAY(hit->outcome != SPT_MISS || !one->clear[i], "ray %d: missed", (int)i);
        if (hit->outcome != SPT_MISS)
            CHECK_SAY((extended)hit->t <= truth->t + one->slack[i], "ray %d: %g behind %Lg", (int)i,
                      (double)hit->t, truth->t);
    }
    if (!one->clear[i]) return 0;
    CHECK_SAY(hit->outcome == (truth->meets ? SPT_HIT : SPT_MISS),
              "ray %d: outcome %d at %g, truth %Lg", (int)i, (int)hit->outcome, (double)hit->t,
              truth->t);
    if (!truth->meets || hit->outcome != SPT_HIT) return 0;
    CHECK_SAY(fabsl((extended)hit->t - truth->t) <= one->slack[i], "ray %d: %g for %Lg, slack %Lg",
              (int)i, (double)hit->t, truth->t, one->slack[i]);
    return 1;
}

/* ---- By the step rules ----------------------------------------------------------------------- */

static void traced_by_every_rule(void) {
    int met = 0;
    for (int n = 0; n < worlds; ++n) {
        traced_world one;
        spt_hit first[mapped_rays], hits[mapped_rays];
        const spt_method *method = NULL;
        int rules_run = 0;
        oracle_run run = oracle_first_run;
        draw_traced(&one, n);
        if (one.count == 0) continue; /* an image too far away for float */
        while (oracle_next(&run, 0)) {
            one.settings.method = run.method;
            one.settings.max_lanes = run.lanes;
            oracle_trace(&one.world.field, &one.settings, one.count, one.rays, hits);
            for (size_t i = 0; i < one.count; ++i) {
                if (method == run.method) {
                    CHECK_SAY(oracle_same_hit(&hits[i], &first[i]), "world %d, ray %d: other bits",
                              n, (int)i);
                    continue;
                }
                met += judge(&one, i, &hits[i]);
                if (one.clear[i])
                    CHECK_SAY(!(hits[i].flags & SPT_FLAG_STEEP), "world %d, ray %d: steep", n,
                              (int)i);
                first[i] = hits[i];
            }
            rules_run += method != run.method;
            method = run.method;
        }
        CHECK_SAY(rules_run >= 5, "%d rules", rules_run);
    }
    CHECK_SAY(met > worlds * 4 * 5, "%d decided hits", met);
}

/* ---- By exits -------------------------------------------------------------------------------- */

static void trace_by_exits(const traced_world *one, uint32_t lanes, spt_hit *hits) {
    const spt_rays from = spt_rays_of(one->rays);
    const spt_hits to = spt_hits_of(hits);
    spt_settings settings = one->settings;
    spt_statistics statistics = spt_statistics_default();
    uint64_t evaluations = 0, outcomes[SPT_OUTCOMES] = {0};
    settings.max_lanes = lanes;
    CHECK(spt_conformal_trace(&one->world.memory, &settings, one->count, &from, &to, &statistics) ==
          SPT_OK);
    for (size_t i = 0; i < one->count; ++i) {
        evaluations += hits[i].evaluations;
        ++outcomes[hits[i].outcome];
    }
    CHECK(statistics.rays == one->count && statistics.evaluations == evaluations);
    for (int i = 0; i < SPT_OUTCOMES; ++i) CHECK(statistics.outcomes[i] == outcomes[i]);
}

/* Two truths within the tolerance of the same t are twice that apart. */
static void traced_by_exits(void) {
    static const uint32_t lanes[] = {1, 4, 8, 16};
    uint64_t by_exits = 0, by_field = 0;
    int met = 0;
    for (int n = 0; n < worlds; ++n) {
        traced_world one;
        spt_hit hits[4][mapped_rays], centred[mapped_rays];
        draw_traced(&one, n);
        one.settings.method = spt_basic();
        oracle_trace(&one.world.field, &one.settings, one.count, one.rays, centred);
        for (int k = 0; k < 4; ++k) {
            check_context("world %d, %u lanes", n, lanes[k]);
            trace_by_exits(&one, lanes[k], hits[k]);
        }
        for (size_t i = 0; i < one.count; ++i) {
            const spt_hit *hit = &hits[0][i];
            check_context("world %d, ray %d, %d steps", n, (int)i, one.world.steps.count);
            for (int k = 1; k < 4; ++k) CHECK(oracle_same_hit(hit, &hits[k][i]));
            CHECK((hit->flags & ~(uint32_t)SPT_FLAG_INSIDE) == 0);
            CHECK(hit->candidate_t > FLT_MAX && hit->candidate_ratio > FLT_MAX);
            CHECK(hit->component == (hit->outcome == SPT_HIT ? 0 : -1));
            met += judge(&one, i, hit);
            if (!one.clear[i]) continue;
            CHECK_SAY(hit->outcome == centred[i].outcome, "%d, the field %d", (int)hit->outcome,
                      (int)centred[i].outcome);
            if (hit->outcome == SPT_HIT && centred[i].outcome == SPT_HIT)
                CHECK_SAY(fabsl((extended)hit->t - (extended)centred[i].t) <= 2 * one.slack[i],
                          "%g, the field %g", (double)hit->t, (double)centred[i].t);
            by_exits += hit->evaluations;
            by_field += centred[i].evaluations;
        }
    }
    CHECK_SAY(met > worlds * 4, "%d decided hits", met);
    CHECK_SAY(by_exits <= by_field, "%u evaluations, the field %u", (unsigned)by_exits,
              (unsigned)by_field);
}

void suite_mobius_trace(void) {
    RUN(traced_by_every_rule);
    RUN(traced_by_exits);
}
