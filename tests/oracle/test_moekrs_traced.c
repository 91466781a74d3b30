/* SPDX-License-Identifier: MIT
 *
 * MöKRS traced: by its field with every step rule, and by binary tracing of its probe; neither
 * crosses an instance, both give equal bits at every width, and the field takes at most half the
 * evaluations. With SPT_FULL_COUNT=1 in the environment the means are printed. */
#include "binary_scene.h"
#include "moekrs_ask.h"
#include "moekrs_model.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { per_model = 40 };

static moekrs_model model;
static spt_moekrs built;
static spt_ray rays[per_model];
static spt_hit hits[per_model];
static double first_hits[per_model]; /* of the model less what rounding hides */
static double certain[per_model];    /* of the model itself */

static void random_on_sphere(double v[3]) {
    double length;
    do {
        for (int axis = 0; axis < 3; ++axis) v[axis] = check_uniform(-1, 1);
        length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    } while (!(length > 0.1 && length <= 1));
    for (int axis = 0; axis < 3; ++axis) v[axis] /= length;
}

/* From three times the model's size to somewhere in it. */
static void draw_rays(void) {
    for (int i = 0; i < per_model; ++i) {
        double from[3], to[3], length = 0;
        random_on_sphere(from);
        random_on_sphere(to);
        for (int axis = 0; axis < 3; ++axis) {
            from[axis] = model.middle[axis] + 3 * model.reach * from[axis];
            to[axis] = model.middle[axis] + 0.6 * model.reach * to[axis];
            length += (to[axis] - from[axis]) * (to[axis] - from[axis]);
        }
        for (int axis = 0; axis < 3; ++axis) {
            rays[i].origin[axis] = (float)from[axis];
            rays[i].direction[axis] = (float)((to[axis] - from[axis]) / sqrt(length));
        }
        rays[i].t_min = 0;
        rays[i].t_max = (float)(10 * model.reach);
    }
}

/* The first instance on a ray, all of them smaller by what the float field or probe may be off. */
static double first_instance(const spt_ray *ray, double shrink) {
    double first = HUGE_VAL;
    for (int k = 0; k < model.count; ++k) {
        const moekrs_instance *one = &model.instance[k];
        binary_body ball = {BINARY_BALL, {0, 0, 0}, {0, 0, 0}};
        double from, to;
        memcpy(ball.center, one->center, sizeof ball.center);
        ball.size[0] = one->radius;
        binary_inside(&ball, ray, shrink, &from, &to);
        if (from <= to && to >= 0 && from <= (double)ray->t_max) first = fmin(first, fmax(from, 0));
    }
    return first;
}

static void find_truth(void) {
    for (int i = 0; i < per_model; ++i) {
        double p[3], shrink;
        float at[3];
        certain[i] = first_instance(&rays[i], 0);
        binary_at(&rays[i], certain[i] < HUGE_VAL ? certain[i] : 3 * model.reach, p);
        for (int axis = 0; axis < 3; ++axis) at[axis] = (float)p[axis];
        /* Positions as in test_binary_scenes.c. */
        shrink = moekrs_margin(&model, at, 0).absolute + 0x1p-21 * 8 * model.reach;
        first_hits[i] = first_instance(&rays[i], shrink);
    }
}

static void draw_any(int draw, uint64_t unmirrored) {
    check_context("draw %d", draw);
    do {
        moekrs_draw(&model, 1 + draw % 6, draw % 4 == 3 ? MOEKRS_SIMILAR : MOEKRS_PLAIN,
                    unmirrored);
    } while (model.reach > 100);
    moekrs_built(&model, 0, &built);
    draw_rays();
    find_truth();
}

/* Neither behind a surface nor far before it: where the ray ends as a hit the distance is within 2
 * tolerances (of the bound f < tolerance, and f / d tends to 1) or, of a probe, within 0.67. */
static void check_ends(int binary, double tolerance) {
    for (int i = 0; i < per_model; ++i) {
        const spt_hit *hit = &hits[i];
        double p[3], distance;
        float at[3];
        CHECK_SAY(hit->outcome <= SPT_LIMIT && hit->outcome >= 0, "outcome %d", hit->outcome);
        if (hit->outcome == SPT_MISS) {
            CHECK_SAY(!(first_hits[i] < HUGE_VAL), "missed what is at %.9g", first_hits[i]);
            continue;
        }
        CHECK_SAY((double)hit->t <= first_hits[i], "%.9g is behind %.9g", (double)hit->t,
                  first_hits[i]);
        if (hit->outcome != SPT_HIT) continue;
        binary_at(&rays[i], (double)hit->t, p);
        for (int axis = 0; axis < 3; ++axis) at[axis] = (float)p[axis];
        distance = moekrs_distance(&model, at, NULL);
        CHECK_SAY(distance <= (binary ? 0.67 : 2) * tolerance +
                                  moekrs_margin(&model, at, 0).absolute + 0x1p-21 * 8 * model.reach,
                  "ends %g from it", distance);
    }
}

static void trace_field(const spt_settings *settings) {
    const spt_field field = spt_moekrs_field(&built);
    const spt_rays from = spt_rays_of(rays);
    const spt_hits to = spt_hits_of(hits);
    CHECK(spt_trace(&field, settings, per_model, &from, &to, NULL) == SPT_OK);
}

static void trace_probe(const spt_settings *settings) {
    const spt_probe probe = spt_moekrs_probe(&built);
    const spt_rays from = spt_rays_of(rays);
    const spt_hits to = spt_hits_of(hits);
    CHECK(spt_binary_trace(&probe, NULL, settings, per_model, &from, &to, NULL) == SPT_OK);
}

/* The mean over rays that both say hit. */
static void moekrs_traced_truly(void) {
    const int draws = moekrs_full() ? 600 : 60;
    double by_field = 0, by_probe = 0, missed_field = 0, missed_probe = 0;
    int both = 0, neither = 0, missed = 0;
    for (int draw = 0; draw < draws; ++draw) {
        static spt_hit kept[per_model];
        spt_settings settings = spt_settings_default();
        draw_any(draw, draw % 3 == 0 ? check_random() : 0);
        settings.epsilon = (float)(1e-4 * model.reach);
        settings.budget = 1000;
        trace_field(&settings);
        check_ends(0, (double)settings.epsilon);
        memcpy(kept, hits, sizeof kept);
        trace_probe(&settings);
        check_ends(1, (double)settings.epsilon);
        for (int i = 0; i < per_model; ++i) {
            missed += kept[i].outcome == SPT_LIMIT || hits[i].outcome == SPT_LIMIT;
            if (kept[i].outcome == SPT_HIT && hits[i].outcome == SPT_HIT) {
                ++both;
                by_field += kept[i].evaluations;
                by_probe += hits[i].evaluations;
            } else if (kept[i].outcome == SPT_MISS && hits[i].outcome == SPT_MISS) {
                ++neither;
                missed_field += kept[i].evaluations;
                missed_probe += hits[i].evaluations;
            }
        }
    }
    check_context("all draws");
    if (moekrs_full()) {
        printf(
            "traced: %d hit with %g evaluations, by probes %g; %d missed with %g, by probes %g\n",
            both, by_field / both, by_probe / both, neither, missed_field / neither,
            missed_probe / neither);
    }
    CHECK(both > draws * per_model / 8 && missed == 0);
    CHECK_SAY(by_field <= by_probe / 2, "%g evaluations, by probes %g", by_field / both,
              by_probe / both);
}

/* ---- Bits ---------------------------------------------------------------------------------- */

static void traced_by(const rule *one, uint32_t settings_lanes, uint32_t model_lanes) {
    spt_settings settings = spt_settings_default();
    settings.epsilon = (float)(1e-4 * model.reach);
    settings.budget = 1000;
    settings.max_lanes = settings_lanes;
    moekrs_built(&model, model_lanes, &built);
    if (one == NULL) {
        trace_probe(&settings);
    } else {
        settings.method = one->method();
        trace_field(&settings);
    }
}

/* Rules that may trace it, and binary tracing as one more. */
static void moekrs_traced_bits(void) {
    for (int draw = 0; draw < 5; ++draw) {
        draw_any(draw, draw % 2 == 0 ? check_random() : 0);
        for (int i = 0; i <= rule_count; ++i) {
            static spt_hit first[per_model];
            const rule *one = i < rule_count ? &rules[i] : NULL;
            if (one != NULL && !rule_allowed(one, 0)) continue;
            for (int width = 0; width < width_count; ++width) {
                for (int inner = 0; inner < width_count; ++inner) {
                    if (width != inner && width * inner != 0) continue;
                    check_context("draw %d, %s, %u lanes of %u", draw,
                                  one == NULL ? "binary" : one->name, widths[width], widths[inner]);
                    traced_by(one, widths[width], widths[inner]);
                    if (width == 0 && inner == 0) {
                        check_ends(one == NULL, 1e-4 * model.reach);
                        memcpy(first, hits, sizeof first);
                    }
                    CHECK(memcmp(first, hits, sizeof first) == 0);
                }
            }
        }
    }
}

/* ---- M4 ------------------------------------------------------------------------------------ */

/* At the pole nothing is certified: balls that reach it are inside-out, and the bound is 0. So rays
 * end there as if at a surface, within a few tolerances; or else at one. */
static void check_near_pole(const double pole[3], double tolerance) {
    for (int k = 0; k < per_model; ++k) {
        const double t = (double)hits[k].t;
        double p[3], square = 0;
        if (hits[k].outcome != SPT_HIT) continue;
        binary_at(&rays[k], t, p);
        for (int axis = 0; axis < 3; ++axis)
            square += (p[axis] - pole[axis]) * (p[axis] - pole[axis]);
        CHECK_SAY(sqrt(square) <= 4 * tolerance || fabs(t - certain[k]) <= 100 * tolerance,
                  "ends %g from the pole, at %g for %g", sqrt(square), t, certain[k]);
    }
}

/* An inversion's centre at the origin of a ray and on it, and rays that miss it by a little. */
static void M4_pole_on_the_ray(void) {
    static const double poles[][3] = {{0, 0, 0}, {0.1, -0.3, 0.7}};
    for (int i = 0; i < 8; ++i) {
        const double *pole = poles[i % 2];
        memset(&model, 0, sizeof model);
        model.levels = 1;
        model.kernels[0] = spt_kernel_sphere(-2, 0, 0, 0.5f);
        model.kernels[1] = spt_kernel_empty();
        moekrs_append(&model.chain[0], MOEKRS_INVERSION, pole, 1);
        moekrs_expand(&model);
        moekrs_built(&model, 0, &built);
        draw_rays();
        for (int k = 0; k < per_model; ++k) {
            for (int axis = 0; axis < 3; ++axis) {
                const double back = i / 2 % 2 == 0 ? 0 : (double)(k % 5) / 4;
                const double beside = i / 4 == 0 ? 0 : 1e-7 * (axis == k % 3);
                rays[k].origin[axis] =
                    (float)(pole[axis] + beside - back * (double)rays[k].direction[axis]);
            }
        }
        find_truth();
        for (int binary = 0; binary < 2; ++binary) {
            spt_settings settings = spt_settings_default();
            check_context("case %d, binary %d", i, binary);
            (binary ? trace_probe : trace_field)(&settings);
            for (int k = 0; k < per_model; ++k) {
                CHECK_SAY(hits[k].outcome <= SPT_LIMIT && !isnan(hits[k].t), "outcome %d at %g",
                          hits[k].outcome, (double)hits[k].t);
            }
            check_near_pole(pole, (double)settings.epsilon);
        }
    }
}

void suite_moekrs_traced(void) {
    RUN(moekrs_traced_truly);
    RUN(moekrs_traced_bits);
    RUN(M4_pole_on_the_ray);
}
