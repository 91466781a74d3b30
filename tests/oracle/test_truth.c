/* SPDX-License-Identifier: MIT
 *
 * The library against the double-precision reference on random worlds, and on the shared scenes
 * against their truth: no ray lost, and evaluations saved. */
#include "harness.h"
#include "survey.h"
#include "../check.h"

#include <math.h>
#include <string.h>

enum { worlds = 120, rays_a_world = 40, width = 48, height = 36, pixels = width * height };

/* As those of oracle_draw. */
static spt_settings world_settings(void) {
    spt_settings settings = spt_settings_default();
    settings.budget = 200;
    settings.epsilon = 1e-4f;
    settings.pixel_radius = 1e-5f;
    return settings;
}

typedef struct agreement {
    uint64_t rays, equal, library, reference;
} agreement;

/* Both stop at a clear hit (gap > 0.02) where |f| is below the tolerance, so both t are within
 * tolerance / cosine of the truth. The least cosine of such a hit is 0.02, at the floor, where gap
 * is the sine; at a ball of radius 1.1 it is 0.19. Rounding adds one floor. */
static const double least_cosine = 0.02;

static void compare(const world_hit *truth, const spt_settings *settings, const spt_ray *ray,
                    const spt_hit *hit, const reference_hit *expected, agreement *sum) {
    ++sum->rays;
    sum->equal +=
        hit->evaluations == expected->evaluations && hit->fallbacks == expected->fallbacks;
    sum->library += hit->evaluations;
    sum->reference += expected->evaluations;
    if (!(truth->gap > 0.02)) return;
    CHECK_SAY(hit->outcome == (int)expected->outcome, "%d, reference %d", hit->outcome,
              (int)expected->outcome);
    if (hit->outcome == SPT_HIT) {
        const double t = expected->t, apart = fabs((double)hit->t - t) * oracle_length(ray);
        const double off = oracle_tolerance(settings, ray, t) + oracle_floor(settings, ray, t);
        CHECK_SAY(apart * least_cosine <= off, "t %.9g, reference %.9g", (double)hit->t, t);
    }
}

/* How often may the counts of evaluations differ? Float and double part where a quantity that
 * decides, the last radius against the tolerance above all, lies within its rounding e of the
 * threshold. Radii of successive samples fall by a factor q, so their logarithm is spread evenly
 * and the chance is 2 (e/tol) / ln(1/q). Coordinates are up to 15 here and e is some u * 15 = 9e-7,
 * tol is 1e-4, and q mostly below 1/2: 2 %, and as much again for probes. Hence 19 in 20 must be
 * equal; and the counts must not lean to either side, so their sums agree within 1 %. */
static void oracle_agrees_with_reference(void) {
    agreement sums[REFERENCE_RULES];
    memset(sums, 0, sizeof sums);
    for (int i = 0; i < worlds; ++i) {
        const world w = world_draw();
        const reference_field exact = world_field(&w);
        const spt_field field = oracle_field(&exact, 0);
        spt_ray rays[rays_a_world];
        oracle_run run = {0, 0, NULL, REFERENCE_BASIC};
        for (int ray = 0; ray < rays_a_world; ++ray) rays[ray] = world_ray();
        while (oracle_next(&run, 0)) {
            spt_settings settings = world_settings();
            const reference_settings same = reference_settings_of(&settings, run.rule);
            spt_hit hits[rays_a_world];
            if (run.rule == REFERENCE_RULES) continue;
            settings.method = run.method;
            settings.max_lanes = run.lanes;
            oracle_trace(&field, &settings, rays_a_world, rays, hits);
            for (int ray = 0; ray < rays_a_world; ++ray) {
                const world_hit truth = world_trace(&w, &rays[ray]);
                const reference_ray one = reference_ray_of(&rays[ray]);
                const reference_hit expected = reference_trace(&exact, &same, &one);
                compare(&truth, &settings, &rays[ray], &hits[ray], &expected, &sums[run.rule]);
            }
        }
    }
    for (int rule = 0; rule < REFERENCE_CONVEX; ++rule) {
        const agreement *sum = &sums[rule];
        const double ratio = (double)sum->library / (double)sum->reference;
        check_context("method %s", spt_method_name(oracle_method((reference_rule)rule)));
        CHECK(sum->rays > 0);
        CHECK_SAY(sum->equal * 20 >= sum->rays * 19, "%g of the counts are equal",
                  (double)sum->equal / (double)sum->rays);
        CHECK_SAY(fabs(ratio - 1) < 0.01, "evaluations over the reference's %g", ratio);
    }
}

static world draw_ball(void) {
    world w = world_draw();
    w.count = 1;
    w.has_floor = 0;
    return w;
}

/* A single convex body for the convex rule. */
static void oracle_convex_agrees_with_reference(void) {
    agreement sum = {0, 0, 0, 0};
    for (int i = 0; i < worlds; ++i) {
        const world one_ball = draw_ball();
        const reference_field exact = world_field(&one_ball);
        const spt_field field = oracle_field(&exact, 1);
        spt_settings settings = world_settings();
        const reference_settings same = reference_settings_of(&settings, REFERENCE_CONVEX);
        settings.method = spt_convex();
        for (int ray = 0; ray < rays_a_world; ++ray) {
            const spt_ray one = world_ray();
            const reference_ray converted = reference_ray_of(&one);
            const world_hit truth = world_trace(&one_ball, &one);
            const spt_hit hit = oracle_trace_one(&field, &settings, &one);
            const reference_hit expected = reference_trace(&exact, &same, &converted);
            compare(&truth, &settings, &one, &hit, &expected, &sum);
        }
    }
    CHECK_SAY(sum.equal * 20 >= sum.rays * 19, "%g of the counts are equal",
              (double)sum.equal / (double)sum.rays);
    CHECK(fabs((double)sum.library / (double)sum.reference - 1) < 0.01);
}

/* The kinds of scene that the published figures are a geometric mean of. */
static const char *const kinds[] = {"sphere",     "box",           "plane", "thin_torus",
                                    "hollow_box", "village_boxes", "slabs", "smooth_union",
                                    "bumpy_ball", "mandelbulb"};
enum { kind_count = sizeof kinds / sizeof *kinds };

static int is_kind(const char *name) {
    int place = 0;
    while (place < kind_count && strcmp(kinds[place], name) != 0) ++place;
    return place < kind_count;
}

/* No ray is lost on any scene. The fractal alone is no distance bound: for it only the default rule
 * promises that, and only there may a ray be STEEP. */
static void check_survey(const scene *shown, reference_rule rule, const survey *sum) {
    const int bound = strcmp(shown->name, "mandelbulb") != 0;
    CHECK(sum->outcomes[SPT_HIT] > pixels / 20);
    CHECK(sum->outcomes[SPT_NONFINITE] == 0 && sum->outcomes[SPT_BAD_RAY] == 0);
    if (bound || rule == REFERENCE_ADAPTIVE) {
        CHECK_SAY(sum->lost == 0, "%d rays lost", (int)sum->lost);
    }
    if (bound) CHECK(sum->steep == 0 && sum->doubtful == 0);
}

/* Both stops of the published figures: half a pixel, and 1e-4 everywhere. Published: adaptive takes
 * 0.70 and 0.67 of the evaluations of basic. */
static void survey_scenes(int cone) {
    static spt_ray rays[pixels];
    static survey_truth truth[pixels];
    static spt_hit hits[pixels];
    double logarithms[REFERENCE_RULES] = {0, 0, 0, 0, 0, 0}, saved;
    int kinds_seen = 0;
    for (size_t i = 0; i < scene_count; ++i) {
        const scene *shown = scenes[i];
        spt_settings settings = spt_settings_default();
        float pixel_radius;
        scene_rays(shown, width, height, rays, &pixel_radius);
        settings.budget = 1000;
        if (cone) settings.pixel_radius = pixel_radius;
        survey_find_truth(shown, &settings, pixels, rays, truth);
        kinds_seen += is_kind(shown->name);
        for (int rule = 0; rule < REFERENCE_RULES; ++rule) {
            survey sum;
            settings.method = oracle_method((reference_rule)rule);
            if (rule == REFERENCE_CONVEX && (shown->flags & SPT_FIELD_CONVEX) == 0) continue;
            check_context("%s, method %s", shown->name, spt_method_name(settings.method));
            sum = survey_trace(shown, &settings, pixels, rays, truth, hits);
            check_survey(shown, (reference_rule)rule, &sum);
            if (is_kind(shown->name)) logarithms[rule] += log(survey_mean(&sum)) / kind_count;
        }
    }
    CHECK(kinds_seen == kind_count);
    saved = exp(logarithms[REFERENCE_ADAPTIVE] - logarithms[REFERENCE_BASIC]);
    CHECK_SAY(saved <= 0.75, "adaptive over basic: %g", saved);
}

static void oracle_scenes_half_pixel(void) {
    survey_scenes(1);
}

static void oracle_scenes_absolute(void) {
    survey_scenes(0);
}

void suite_truth(void) {
    RUN(oracle_agrees_with_reference);
    RUN(oracle_convex_agrees_with_reference);
    RUN(oracle_scenes_half_pixel);
    RUN(oracle_scenes_absolute);
}
