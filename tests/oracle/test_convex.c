/* SPDX-License-Identifier: MIT
 *
 * spt_trace_convex() against exact entries and exits (Keinert et al. 2014, section 3.5, row K13 of
 * the errata): all three cases, in every kind of bound, by every rule, forwards and backwards.
 * Left out: bodies that are not convex, see test_convex_check.c. */
#include "check.h"
#include "glass_bounds.h"
#include "glass_chord.h"
#include "rules.h"

#include <spheretrace/surface.h>

#include <math.h>
#include <string.h>

enum { body_count = 8, ray_count = 24 };

/* The ball of body->bound goes into a bound of that number. */
static void put_in_bound(glass_body *body, int number, spt_bound *bound, glass_volume *volume,
                         const char **name) {
    *bound = glass_bound(number, body->center, (double)body->bound.radius, volume, name);
}

static const float epsilons[] = {1e-6f, 1e-4f, 1e-3f};

static spt_settings settings_number(uint32_t number, uint32_t field_flags) {
    spt_settings settings = spt_settings_default();
    const rule *one = &rules[number % (uint32_t)rule_count];
    settings.method = rule_allowed(one, field_flags) ? one->method() : spt_adaptive();
    settings.budget = 100000; /* basic steps along a face take many */
    settings.epsilon = epsilons[number % 3];
    settings.pixel_radius = number % 5 == 0 ? 1e-3f : 0.0f;
    settings.max_lanes = widths[number / 2 % width_count];
    if (number % 2 == 0) settings.flags |= SPT_CHECK_CONVEX;
    return settings;
}

/* ---- Entries and exits ---------------------------------------------------------------------- */

typedef struct tally {
    long rays, decided, hits, exits, misses, cut; /* cut: from inside to a t_max inside */
} tally;

/* A hit is where |f| is within the tolerance and what floats round, on its own side of the deepest
 * point of the line; there f is monotone, so that the crossing is where f is zero. */
static void expect_hit(const glass_body *body, const spt_settings *settings,
                       const glass_chord *chord, const spt_ray *ray, const spt_hit *hit) {
    const double at = (double)hit->t * chord->length;
    const double lipschitz = body->lipschitz;
    const double round = glass_chord_floor(body, chord, at);
    const double tolerance = glass_chord_tolerance(settings, body, chord, at);
    const double f = glass_chord_distance(body, chord, at);
    CHECK(hit->t >= ray->t_min && hit->t <= ray->t_max);
    CHECK_SAY(fabs(f) <= (tolerance + round) * lipschitz, "f %g at %.9g, tolerance %g", f, at,
              tolerance);
    CHECK_SAY(fabs((double)hit->residual - f) <= 2 * round, "residual %g, f %g",
              (double)hit->residual, f);
    CHECK_SAY(chord->inside ? at > chord->middle : at < chord->middle,
              "at %.9g, not %.9g; deepest %.9g", at, chord->hit, chord->middle);
}

static void expect(const glass_body *body, const spt_settings *settings, const glass_chord *chord,
                   const spt_ray *ray, const spt_hit *hit, tally *sum) {
    const double far = fmax(chord->from, chord->meets ? chord->leave : chord->middle);
    const double undecided = 2 * body->lipschitz *
                             (glass_chord_tolerance(settings, body, chord, fabs(far)) +
                              glass_chord_floor(body, chord, fabs(far)));
    ++sum->rays;
    CHECK(hit->evaluations <= settings->budget && (hit->flags & ~(uint32_t)SPT_FLAG_INSIDE) == 0);
    CHECK(hit->outcome == SPT_HIT || hit->outcome == SPT_MISS);
    if (!(chord->decided > undecided)) return;
    ++sum->decided;
    CHECK_SAY(hit->outcome == (int32_t)chord->outcome,
              "outcome %d, not %d, t %.9g of [%.9g, %.9g], chord %d [%.9g, %.9g]", hit->outcome,
              (int)chord->outcome, (double)hit->t * chord->length, chord->from, chord->to,
              chord->meets, chord->entry, chord->leave);
    CHECK_SAY(hit->flags == (chord->inside && chord->from <= chord->to ? SPT_FLAG_INSIDE : 0u),
              "flags %x", hit->flags);
    sum->hits += chord->outcome == SPT_HIT && !chord->inside;
    sum->exits += chord->outcome == SPT_HIT && chord->inside;
    sum->misses += chord->outcome == SPT_MISS;
    sum->cut += chord->outcome == SPT_MISS && chord->inside && chord->from <= chord->to;
    if (chord->outcome == SPT_HIT && hit->outcome == SPT_HIT) {
        expect_hit(body, settings, chord, ray, hit);
    } else {
        CHECK(hit->outcome != SPT_MISS || (hit->t >= INFINITY && hit->residual >= INFINITY));
    }
}

static void trace_all(glass_body *body, const spt_field *field, const spt_settings *settings,
                      tally *sum) {
    static spt_ray rays[ray_count];
    static spt_hit hits[ray_count];
    const spt_rays from = spt_rays_of(rays);
    const spt_hits to = spt_hits_of(hits);
    spt_statistics statistics = spt_statistics_default();
    uint64_t evaluations = 0;
    for (int i = 0; i < ray_count; ++i) rays[i] = glass_chord_ray(body, i % 3);
    CHECK(spt_trace_convex(field, settings, ray_count, &from, &to, &statistics) == SPT_OK);
    for (int i = 0; i < ray_count; ++i) {
        const glass_chord chord = glass_chord_of(body, &rays[i]);
        expect(body, settings, &chord, &rays[i], &hits[i], sum);
        evaluations += hits[i].evaluations;
    }
    CHECK(statistics.rays == ray_count && statistics.evaluations == evaluations);
    CHECK(statistics.outcomes[SPT_HIT] + statistics.outcomes[SPT_MISS] == ray_count);
}

static void K13_entries_and_exits(void) {
    tally sum = {0, 0, 0, 0, 0, 0};
    uint32_t number = 0;
    for (int which = 0; which < body_count; ++which) {
        glass_body body = glass_body_number(which);
        for (int kind = 0; kind < glass_bound_count; ++kind) {
            for (int declared = 0; declared < 2; ++declared, ++number) {
                const char *name;
                glass_volume volume;
                spt_bound bound;
                spt_field field = glass_field(&body, 0);
                spt_settings settings;
                put_in_bound(&body, kind, &bound, &volume, &name);
                field.bound = &bound;
                field.flags = declared ? SPT_FIELD_CONVEX : 0;
                settings = settings_number(number, field.flags);
                body.single = (int)(number / 3 % 2);
                check_context("%s in %s, %s, declared %d, epsilon %g, way %u", body.name, name,
                              spt_method_name(settings.method), declared, (double)settings.epsilon,
                              number);
                trace_all(&body, &field, &settings, &sum);
            }
        }
    }
    check_context("all");
    CHECK_SAY(10 * sum.decided > 9 * sum.rays, "%ld of %ld decided", sum.decided, sum.rays);
    CHECK_SAY(sum.hits > 300 && sum.exits > 300 && sum.misses > 300 && sum.cut > 50,
              "%ld %ld %ld %ld", sum.hits, sum.exits, sum.misses, sum.cut);
}

/* ---- Starts on the surface ------------------------------------------------------------------ */

/* A point on the surface where the line of a random ray leaves the body, off it by at most half a
 * tolerance, and any direction but along a face: out of the body f is to rise by a tolerance on a
 * length of 1, far more than it rounds. */
static int on_surface(const glass_body *body, double tolerance, spt_ray *ray, double *cosine) {
    const spt_ray line = glass_chord_ray(body, 0);
    const glass_chord chord = glass_chord_of(body, &line);
    const double off = check_uniform(-0.5, 0.5) * tolerance;
    double p[3], normal[3], square = 0;
    if (!chord.meets) return 0;
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = chord.origin[axis] + chord.leave * chord.direction[axis];
    }
    glass_normal(body, p, normal);
    *cosine = 0;
    ray->t_min = 0;
    ray->t_max = INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
        const double d = check_uniform(-1, 1);
        ray->origin[axis] = (float)(p[axis] + off * normal[axis]);
        ray->direction[axis] = (float)d;
        square += d * d;
        *cosine += d * normal[axis];
    }
    *cosine /= sqrt(square);
    return *cosine < 0 || *cosine > tolerance;
}

/* Into the body a skipped start is one from inside, out of it a miss; unskipped it is a hit where
 * it begins, as of spt_trace(). Tolerances of depth hide a chord: f is at least -0.5 of them at the
 * start and at most 0.75 at the hit, so that half way, f being convex, it is below its start where
 * it falls to -2 of them: (-2 + 0.75) / 2 < -0.5 leaves an eighth for rounding. */
static void expect_start(glass_body *body, const spt_settings *settings, const spt_ray *ray,
                         double cosine) {
    const spt_field field = glass_field(body, 0);
    const spt_rays from = spt_rays_of(ray);
    const glass_chord chord = glass_chord_of(body, ray);
    const double tolerance = (double)settings->epsilon;
    spt_hit hit;
    const spt_hits to = spt_hits_of(&hit);
    CHECK(spt_trace_convex(&field, settings, 1, &from, &to, NULL) == SPT_OK);
    CHECK(hit.evaluations <= settings->budget);
    if (!(settings->flags & SPT_SKIP_START)) {
        CHECK_SAY(hit.outcome == SPT_HIT && hit.t <= 0 && hit.evaluations == 1,
                  "outcome %d at %g, %u evaluations", hit.outcome, (double)hit.t, hit.evaluations);
    } else if (cosine > 0) {
        CHECK_SAY(hit.outcome == SPT_MISS, "outcome %d at %g, out of the body", hit.outcome,
                  (double)hit.t);
    } else if (chord.meets && glass_chord_distance(body, &chord, chord.middle) <
                                  -2 * tolerance * body->lipschitz) {
        const int inside = hit.outcome == SPT_HIT && (hit.flags & SPT_FLAG_INSIDE) != 0;
        const double f =
            glass_chord_distance(body, &chord, (double)hit.t * chord.length) / tolerance;
        CHECK_SAY(inside, "outcome %d, flags %x, into the body", hit.outcome, hit.flags);
        CHECK_SAY(!inside || (fabs(f) < 1.1 && (double)hit.t * chord.length > chord.middle),
                  "at %g, not %g", (double)hit.t * chord.length, chord.leave);
    }
}

static void K13_starts_on_the_surface(void) {
    int done = 0;
    for (uint32_t number = 0; number < 32; ++number) {
        glass_body body = glass_body_number((int)(number % body_count));
        spt_settings settings = settings_number(number, SPT_FIELD_CONVEX);
        settings.epsilon = 1e-4f;
        settings.pixel_radius = 0;
        if (number % 4 != 0) settings.flags |= SPT_SKIP_START;
        check_context("%s, %s, flags %x", body.name, spt_method_name(settings.method),
                      (unsigned)settings.flags);
        for (int i = 0; i < 30; ++i) {
            spt_ray ray;
            double cosine;
            if (!on_surface(&body, (double)settings.epsilon, &ray, &cosine)) continue;
            expect_start(&body, &settings, &ray, cosine);
            ++done;
        }
    }
    CHECK_SAY(done > 500, "%d", done);
}

/* ---- Exits far before the end of the bound -------------------------------------------------- */

/* A slab has no end along its faces, and a box may be long: the way back to the body is then long,
 * and what floats round at its beginning must not be left in the hit. */
static void K13_far_exits(void) {
    static const float ends[] = {10, 1e3f, 1e5f, 1e7f, 1e12f, 1e18f, 1e30f, INFINITY};
    const float normal[3] = {0, 0, 1};
    glass_body body = glass_ball();
    for (int i = 0; i < (int)(sizeof ends / sizeof ends[0]); ++i) {
        for (int declared = 0; declared < 2; ++declared) {
            const spt_bound bound = spt_bound_slab(normal, -1.5f, 1.5f);
            spt_field field = glass_field(&body, 0);
            spt_settings settings = spt_settings_default();
            const spt_ray ray = {{0.3f, -0.2f, 0.25f}, 0, {0.6f, 0.8f, 0}, ends[i]};
            const glass_chord chord = glass_chord_of(&body, &ray);
            const spt_rays from = spt_rays_of(&ray);
            spt_hit hit;
            const spt_hits to = spt_hits_of(&hit);
            check_context("t_max %g, declared %d", (double)ends[i], declared);
            field.bound = &bound;
            field.flags = declared ? SPT_FIELD_CONVEX : 0;
            CHECK(spt_trace_convex(&field, &settings, 1, &from, &to, NULL) == SPT_OK);
            CHECK_SAY(hit.outcome == SPT_HIT, "outcome %d", hit.outcome);
            if (hit.outcome == SPT_HIT) expect_hit(&body, &settings, &chord, &ray, &hit);
        }
    }
}

void suite_convex(void) {
    RUN(K13_starts_on_the_surface);
    RUN(K13_far_exits);
    RUN(K13_entries_and_exits);
}
