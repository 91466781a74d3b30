/* SPDX-License-Identifier: MIT
 *
 * The part "accuracy": how far float32 is from double in each part of the library, by a swept
 * parameter, beside the bound that the public header promises. The measurements are in the files
 * accuracy_*.c. */
#include "accuracy.h"

#include <math.h>
#include <stdlib.h>

static accuracy_cell *const cells[] = {accuracy_hits,
                                       accuracy_hits_floor,
                                       accuracy_binary,
                                       accuracy_normals_distance,
                                       accuracy_normals_curvature,
                                       accuracy_offsets,
                                       accuracy_refining,
                                       accuracy_glass,
                                       accuracy_krs,
                                       accuracy_maps,
                                       accuracy_regions,
                                       accuracy_exits,
                                       accuracy_conformal,
                                       accuracy_pulled_points,
                                       accuracy_pulled_balls,
                                       accuracy_moekrs,
                                       accuracy_bounds,
                                       accuracy_shapes,
                                       accuracy_arcs,
                                       accuracy_functions};

void accuracy_add(accuracy_errors *errors, double error) {
    if (errors->count == errors->room) {
        errors->room = errors->room != 0 ? 2 * errors->room : 256;
        errors->values = realloc(errors->values, errors->room * sizeof *errors->values);
        report_expect(errors->values != NULL, "out of memory");
    }
    errors->values[errors->count++] = isnan(error) ? HUGE_VAL : error;
}

void accuracy_write_named(FILE *rows, const accuracy_subject *subject, const char *value,
                          double promised, accuracy_errors *errors) {
    const size_t count = errors->count;
    fprintf(rows, "%s,%s,%s,%lu", subject->name, subject->parameter, value, (unsigned long)count);
    fprintf(rows, ",%.9g", report_quantile(errors->values, count, 0.5));
    fprintf(rows, ",%.9g", report_quantile(errors->values, count, 0.95));
    fprintf(rows, ",%.9g,", report_quantile(errors->values, count, 1));
    if (promised > 0) fprintf(rows, "%.9g", promised);
    fprintf(rows, ",%s,%s\n", subject->unit, subject->source);
    free(errors->values);
    *errors = (accuracy_errors){NULL, 0, 0};
}

void accuracy_write(FILE *rows, const accuracy_subject *subject, double value, double promised,
                    accuracy_errors *errors) {
    char text[32];
    snprintf(text, sizeof text, "%.9g", value);
    accuracy_write_named(rows, subject, text, promised, errors);
}

size_t accuracy_samples(const report_options *options, size_t full) {
    return options->quick ? full / 8 : full;
}

/* ---- Drawing --------------------------------------------------------------------------------- */

double accuracy_spread(report_random *random, double low, double high) {
    return exp(report_uniform(random, log(low), log(high)));
}

void accuracy_unit(report_random *random, double direction[3]) {
    double square;
    do {
        square = 0;
        for (int axis = 0; axis < 3; ++axis) {
            direction[axis] = report_uniform(random, -1, 1);
            square += direction[axis] * direction[axis];
        }
    } while (!(square <= 1 && square > 1e-4));
    for (int axis = 0; axis < 3; ++axis) direction[axis] /= sqrt(square);
}

/* An inversion's center lies outside the ball, whose image so stays a ball. */
static chain_step draw_step(report_random *random, const solid *ball) {
    chain_step step = {(chain_kind)(report_bits(random) % CHAIN_KINDS), {0, 0, 0}, 0};
    const double radius = (double)ball->radius;
    accuracy_unit(random, step.vector);
    switch (step.kind) {
    case CHAIN_TRANSLATION:
        for (int axis = 0; axis < 3; ++axis) step.vector[axis] *= 2 * radius;
        break;
    case CHAIN_DILATION:
        step.number = accuracy_spread(random, 0.5, 2) * (report_bits(random) % 4 == 0 ? -1 : 1);
        break;
    case CHAIN_ROTATION:
        step.number = report_uniform(random, -3, 3);
        break;
    case CHAIN_REFLECTION:
        step.number = radius * report_uniform(random, -2, 2);
        for (int axis = 0; axis < 3; ++axis)
            step.number += step.vector[axis] * (double)ball->center[axis];
        break;
    default: {
        const double away = radius * report_uniform(random, 1.5, 4);
        step.number = radius * report_uniform(random, 1, 3);
        for (int axis = 0; axis < 3; ++axis)
            step.vector[axis] = (double)ball->center[axis] + away * step.vector[axis];
    }
    }
    return step;
}

void accuracy_chain(report_random *random, chain *one, int count) {
    solid ball = {SPT_REGION_BALL, {0, 0, 0}, 1};
    one->count = count;
    for (int i = 0; i < count; ++i) {
        chain single;
        single.count = 1;
        single.steps[0] = one->steps[i] = draw_step(random, &ball);
        ball = chain_solid(&single, 0, ball);
    }
}

const int accuracy_levels[] = {1, 2, 4, 7, 10, 14, 20, 28, 64};

int accuracy_level_count(int most) {
    int count = 0;
    while (count < (int)(sizeof accuracy_levels / sizeof accuracy_levels[0]) &&
           accuracy_levels[count] <= most) {
        ++count;
    }
    return count;
}

/* ---- The part -------------------------------------------------------------------------------- */

static int count_cells(const report_options *options) {
    (void)options;
    return sizeof cells / sizeof cells[0];
}

static void measure(const report_options *options, int cell, FILE *rows) {
    cells[cell](options, rows);
}

const report_part report_accuracy = {
    "accuracy",  "subject,parameter,value,samples,error_50,error_95,error_100,promised,unit,source",
    count_cells, measure,
    0,           {20, 3}};
