/* SPDX-License-Identifier: MIT
 *
 * The field of MöKRS (spt_moekrs_field) against explicit instances: a lower bound of the distance
 * on both sides, of slope 1, that tends to it at the surface. With SPT_FULL_COUNT=1 in the
 * environment 100 000 queries instead of 20 000, and the figures are printed. */
#include "moekrs_ask.h"
#include "moekrs_model.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { per_model = 100 };

static moekrs_model model;
static spt_moekrs built;
static moekrs_query queries[per_model];

static spt_field draw_any(int draw, moekrs_flavour flavour) {
    const uint64_t unmirrored = draw % 3 == 0 ? check_random() : 0;
    check_context("draw %d, flavour %d", draw, (int)flavour);
    moekrs_draw(&model, 1 + (int)(check_random() % moekrs_levels), flavour, unmirrored);
    moekrs_built(&model, 0, &built);
    return spt_moekrs_field(&built);
}

/* What rounding may make of a value f at p. */
static double rounding(const float p[3], double f) {
    const moekrs_error error = moekrs_margin(&model, p, 0);
    return error.absolute + error.relative * fabs(f);
}

/* ---- The bound ----------------------------------------------------------------------------- */

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The largest |c|, for what the header says of rounding. */
static double largest_c(void) {
    double most = 0;
    for (int i = 0; i < model.levels; ++i) {
        most = fmax(most, sqrt(spt_quaternion_square(model.maps[i].c)));
    }
    return most;
}

/* Outside f <= d, inside -f <= -d: never above the distance. The median of f / d is "0.7" over
 * places as far away as the model is large, but of similarities, of which it is
 * 1. */
static void moekrs_field_is_a_bound(void) {
    static double ratios[1000 * per_model / 2];
    const int draws = moekrs_full() ? 1000 : 200;
    int outside = 0 /* of those anywhere */, inside = 0, above = 0;
    double worst = 0, documented = 0;
    for (int draw = 0; draw < draws; ++draw) {
        const moekrs_flavour flavour = (moekrs_flavour)(draw % MOEKRS_CUT);
        const spt_field field = draw_any(draw, flavour);
        const double c = largest_c();
        CHECK(check_same_bits(field.lipschitz, 1.0f) && field.batch != NULL);
        for (int i = 0; i < per_model; ++i) {
            (i % 2 == 0 ? moekrs_somewhere : moekrs_point)(&model, queries[i].point);
        }
        moekrs_ask_field(&field, 0, per_model, queries);
        for (int i = 0; i < per_model; ++i) {
            const float *p = queries[i].point;
            const double d = moekrs_distance(&model, p, NULL), f = (double)queries[i].answer;
            const double over = d > 0 ? f - d : d - f;
            const double length = sqrt((double)p[0] * (double)p[0] + (double)p[1] * (double)p[1] +
                                       (double)p[2] * (double)p[2]);
            const double margin = rounding(p, d);
            CHECK_SAY(over <= margin, "levels %d: f %.9g for %.9g, margin %g", model.levels, f, d,
                      margin);
            /* The other way, sign and all: never through the surface. */
            CHECK_SAY(d > 0 ? f >= -margin : f <= margin, "levels %d: f %.9g for %.9g, margin %g",
                      model.levels, f, d, margin);
            above += over > 0;
            worst = fmax(worst, over / margin);
            documented = fmax(documented, over / (0x1p-20 * (1 + length * c)));
            inside += d <= 0;
            if (d > 0 && i % 2 == 0 && flavour != MOEKRS_SIMILAR) ratios[outside++] = f / d;
        }
    }
    qsort(ratios, (size_t)outside, sizeof *ratios, ascending);
    check_context("all draws");
    if (moekrs_full()) {
        printf(
            "field: outside %d, inside %d, above by rounding %d, worst %g of the margin, %g of the "
            "header's; ratio to the distance: 5%% %g, median %g, 95%% %g\n",
            outside, inside, above, worst, documented, ratios[outside / 20], ratios[outside / 2],
            ratios[outside / 20 * 19]);
    }
    CHECK(inside > outside / 20);
    CHECK_SAY(ratios[outside / 2] > 0.6 && ratios[outside / 2] < 0.9, "median %g",
              ratios[outside / 2]);
}

/* |f(p) - f(q)| <= |p - q|, near and far, through surfaces and mirrors, and in models that are cut
 * there. */
static void moekrs_field_has_slope_1(void) {
    for (int draw = 0; draw < 100; ++draw) {
        const spt_field field = draw_any(draw, (moekrs_flavour)(draw % moekrs_flavours));
        for (int i = 0; i < per_model; i += 2) {
            float *p = queries[i].point, *q = queries[i + 1].point;
            const double apart = model.reach * pow(10, check_uniform(-4, 0));
            moekrs_point(&model, p);
            for (int axis = 0; axis < 3; ++axis) {
                q[axis] = (float)((double)p[axis] + apart * check_uniform(-1, 1));
            }
        }
        moekrs_ask_field(&field, 0, per_model, queries);
        for (int i = 0; i < per_model; i += 2) {
            const float *p = queries[i].point, *q = queries[i + 1].point;
            const double f = (double)queries[i].answer, g = (double)queries[i + 1].answer;
            double square = 0, margin = rounding(p, f) + rounding(q, g);
            for (int axis = 0; axis < 3; ++axis) {
                const double d = (double)p[axis] - (double)q[axis];
                square += d * d;
            }
            CHECK_SAY(fabs(f - g) <= sqrt(square) + margin, "%.9g and %.9g at %.9g, margin %g", f,
                      g, sqrt(square), margin);
        }
    }
}

/* The largest of some: near small ones float32 resolves little. */
static const moekrs_instance *any_large(void) {
    const moekrs_instance *largest = &model.instance[check_random() % (uint32_t)model.count];
    for (int i = 0; i < 8; ++i) {
        const moekrs_instance *other = &model.instance[check_random() % (uint32_t)model.count];
        if (other->radius > largest->radius) largest = other;
    }
    return largest;
}

/* 1 - f / d falls in proportion to d: from one distance to an eighth of it to a quarter at most
 * (twice the share that is of the second order), and what rounding is of d. */
static void moekrs_field_tends_to_the_distance(void) {
    int seen = 0;
    for (int draw = 0; draw < 150; ++draw) {
        const spt_field field = draw_any(draw, MOEKRS_PLAIN);
        for (int i = 0; i < 20; ++i) {
            const moekrs_instance *one = any_large();
            double n[3], length = 0, lost[2], margin[2];
            int alone = 1;
            for (int axis = 0; axis < 3; ++axis) {
                n[axis] = check_uniform(-1, 1);
                length += n[axis] * n[axis];
            }
            for (int step = 0; step < 2; ++step) {
                const double away = one->radius * (step == 0 ? 0.08 : 0.01);
                moekrs_query query;
                double d;
                int which;
                for (int axis = 0; axis < 3; ++axis) {
                    query.point[axis] =
                        (float)(one->center[axis] + n[axis] / sqrt(length) * (one->radius + away));
                }
                d = moekrs_distance(&model, query.point, &which);
                alone = alone && &model.instance[which] == one && d > 0;
                moekrs_ask_field(&field, 0, 1, &query);
                lost[step] = 1 - (double)query.answer / d;
                margin[step] = rounding(query.point, d) / d;
            }
            if (!alone || margin[1] > 0.01) continue;
            ++seen;
            CHECK_SAY(lost[1] <= fmax(lost[0], 0) / 4 + margin[0] / 4 + margin[1],
                      "1 - f / d: %g, closer %g, margin %g", lost[0], lost[1], margin[1]);
        }
    }
    CHECK_SAY(seen > 500, "%d seen", seen);
}

/* ---- Bits ---------------------------------------------------------------------------------- */

static void moekrs_field_bits(void) {
    static moekrs_query first[per_model];
    for (int draw = 0; draw < 24; ++draw) {
        draw_any(draw, (moekrs_flavour)(draw % moekrs_flavours));
        for (int i = 0; i < per_model; ++i) moekrs_point(&model, queries[i].point);
        for (int width = 0; width < width_count; ++width) {
            for (int point = 0; point < 2; ++point) {
                spt_field field;
                check_context("draw %d, %u lanes, point %d", draw, widths[width], point);
                moekrs_built(&model, widths[width], &built);
                field = spt_moekrs_field(&built);
                if (point && field.point == NULL) continue;
                moekrs_ask_field(&field, point, per_model, queries);
                if (width == 0 && point == 0) memcpy(first, queries, sizeof first);
                for (int i = 0; i < per_model; ++i) {
                    CHECK_SAY(check_same_bits(queries[i].answer, first[i].answer), "%.9g for %.9g",
                              (double)queries[i].answer, (double)first[i].answer);
                }
            }
        }
    }
}

/* The image of infinity under an inversion in a unit sphere is its center, where no point of kernel
 * space is near. One ball is seen there as the ball that the inversion makes of it: center
 * c + (k - c) / (|k - c|^2 - r^2), radius r / (|k - c|^2 - r^2). */
static void moekrs_field_at_the_pole(void) {
    const double pole[3] = {0.25, -0.5, 0.125};
    for (int shift = 0; shift < 8; ++shift) {
        const float x = -1.5f - 0.25f * (float)shift, radius = 0.375f;
        const spt_kernel kernels[] = {spt_kernel_sphere(x, 0.25f, -0.5f, radius),
                                      spt_kernel_empty()};
        const double away[3] = {(double)x - pole[0], 0.25 - pole[1], -0.5 - pole[2]};
        const double square = away[0] * away[0] + away[1] * away[1] + away[2] * away[2];
        const double scale = 1 / (square - (double)radius * (double)radius);
        const double distance = scale * (sqrt(square) - (double)radius);
        spt_moekrs_model description = spt_moekrs_model_default();
        spt_mobius inversion;
        check_context("shift %d", shift);
        CHECK(spt_mobius_inversion(pole, 1, &inversion) == SPT_OK);
        description.levels = 1;
        description.kernels = kernels;
        description.maps = &inversion;
        description.unmirrored = 1;
        CHECK(spt_moekrs_build(&description, &built) == SPT_OK);
        const spt_field field = spt_moekrs_field(&built);
        const spt_probe probe = spt_moekrs_probe(&built);
        for (int step = 0; step < 4; ++step) {
            const float beside = step == 0 ? 0.0f : 0x1p-20f * (float)(1 << 5 * step);
            const float at = (float)pole[0] - beside, reached = 0.98f * (float)distance - beside;
            const float f = field.point(field.user, at, (float)pole[1], (float)pole[2]);
            CHECK_SAY((double)f > 0.98 * distance - (double)beside &&
                          (double)f < 1.00001 * distance + (double)beside,
                      "%.9g for %.9g", (double)f, distance);
            CHECK(probe.point(probe.user, at, (float)pole[1], (float)pole[2], reached) >= 0);
        }
    }
}

void suite_moekrs_field(void) {
    RUN(moekrs_field_at_the_pole);
    RUN(moekrs_field_is_a_bound);
    RUN(moekrs_field_has_slope_1);
    RUN(moekrs_field_tends_to_the_distance);
    RUN(moekrs_field_bits);
}
