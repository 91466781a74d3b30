/* SPDX-License-Identifier: MIT
 *
 * The shapes of shapes.h in float, by the same formulas in double, and its functions, by libm. */
#define ACCURACY_TYPE float
#include "accuracy_shapes_table.h"

#include "accuracy.h"

#include <math.h>
#include <stdlib.h>

static const double unit = 0x1p-24;
const int accuracy_shape_count = sizeof accuracy_shapes_float / sizeof accuracy_shapes_float[0];

/* ---- Shapes ---------------------------------------------------------------------------------- */

static void draw_point(report_random *random, double reach, double p[3]) {
    for (int axis = 0; axis < 3; ++axis)
        p[axis] = (double)(float)report_uniform(random, -reach, reach);
}

void accuracy_shapes(const report_options *options, FILE *rows) {
    const accuracy_subject subject = {
        "shape", "shape", "2^-24 of (sum of the coordinates + size) L",
        "shapes.h: less than 1e-6 (sum of the coordinates + size of the body) L; exponents twice"};
    const size_t count = accuracy_samples(options, 40000);
    double(*const points)[3] = report_allocate(count * sizeof *points);
    double *const single = report_allocate(count * sizeof *single);
    double *const twice = report_allocate(count * sizeof *twice);
    for (int i = 0; i < accuracy_shape_count; ++i) {
        const accuracy_shape *const shape = &accuracy_shapes_double[i];
        const double slope = shape->slope();
        report_random random = {0};
        accuracy_errors errors = {NULL, 0, 0};
        for (size_t k = 0; k < count; ++k) draw_point(&random, k % 2 ? 4 : 1.5, points[k]);
        accuracy_shapes_float[i].values(count, (const double(*)[3])points, single);
        shape->values(count, (const double(*)[3])points, twice);
        for (size_t k = 0; k < count; ++k) {
            const double *const p = points[k];
            const double scale = fabs(p[0]) + fabs(p[1]) + fabs(p[2]) + shape->size;
            accuracy_add(&errors, fabs(single[k] - twice[k]) / (unit * scale * slope));
        }
        accuracy_write_named(rows, &subject, shape->name, (shape->exponents ? 2e-6 : 1e-6) / unit,
                             &errors);
    }
    free(points);
    free(single);
    free(twice);
}

/* ---- Functions ------------------------------------------------------------------------------- */

static double sine(double x) {
    return (double)spt_sin((float)x) - sin(x);
}

static double cosine(double x) {
    return (double)spt_cos((float)x) - cos(x);
}

/* By decades of the angle: the last one is rounded where the others are not. */
static void sweep_angles(const report_options *options, FILE *rows, const char *name,
                         double (*off)(double)) {
    const accuracy_subject subject = {
        name, "angle", "absolute",
        "shapes_math.h: below 1.5e-7 for |angle| <= 1e4; below 2.2e-6 up to 1e5"};
    for (int power = 0; power <= 5; ++power) {
        report_random random = {(uint64_t)power};
        accuracy_errors errors = {NULL, 0, 0};
        const double most = pow(10, power);
        for (size_t left = accuracy_samples(options, 400000); left > 0; --left) {
            const float x = (float)report_uniform(&random, -most, most);
            accuracy_add(&errors, fabs(off((double)x)));
        }
        accuracy_write(rows, &subject, most, power <= 4 ? 1.5e-7 : 2.2e-6, &errors);
    }
}

/* Of the logarithm a unit in the last place, that of the binade of the true value. */
void accuracy_functions(const report_options *options, FILE *rows) {
    const accuracy_subject powers = {"exponential", "numbers", "relative",
                                     "shapes_math.h: relative error below 1.5e-7"};
    const accuracy_subject logarithms = {"logarithm", "numbers", "units in the last place",
                                         "shapes_math.h: error below 1 unit in the last place"};
    const size_t count = accuracy_samples(options, 800000);
    report_random random = {0};
    accuracy_errors errors = {NULL, 0, 0};
    sweep_angles(options, rows, "sine", sine);
    sweep_angles(options, rows, "cosine", cosine);
    for (size_t i = 0; i < count; ++i) {
        const float x = (float)report_uniform(&random, -86.5, 88.7);
        accuracy_add(&errors, fabs((double)spt_exp(x) / exp((double)x) - 1));
    }
    accuracy_write_named(rows, &powers, "-86.5 to 88.7", 1.5e-7, &errors);
    for (size_t i = 0; i < count; ++i) {
        const float x = (float)accuracy_spread(&random, 1e-37, 1e38);
        const double truth = log((double)x);
        int exponent;
        if (!(fabs(truth) > 0)) continue;
        frexp(truth, &exponent);
        accuracy_add(&errors, fabs((double)spt_log(x) - truth) / ldexp(1, exponent - 24));
    }
    accuracy_write_named(rows, &logarithms, "1e-37 to 1e38", 1, &errors);
}
