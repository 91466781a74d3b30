/* SPDX-License-Identifier: MIT
 *
 * Toroidal capsules by the flatness of their arcs: as shapes.h computes them, and around the center
 * of the circle, as they are usually written. */
#include "accuracy.h"
#include "accuracy_shapes_table.h"

#include "../../oracle/surface_oracle.h"

#include <math.h>

static const float tube = 0.03125f;

/* The usual way, in float, where the point stands over the arc: both ends and a point between give
 * the circumcenter (a, b: from the third point to the ends), which flat arcs put far away. */
static float usual_arc(const float points[3][3], const double p[3]) {
    float a[3], b[3], n[3], center[3], from[3];
    float aa = 0, bb = 0, nn = 0, radius = 0, high = 0, flat = 0;
    for (int i = 0; i < 3; ++i) {
        a[i] = points[0][i] - points[2][i];
        b[i] = points[1][i] - points[2][i];
        aa += a[i] * a[i];
        bb += b[i] * b[i];
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = a[j] * b[k] - a[k] * b[j];
        nn += n[i] * n[i];
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const float way =
            ((aa * b[j] - bb * a[j]) * n[k] - (aa * b[k] - bb * a[k]) * n[j]) / (2 * nn);
        center[i] = points[2][i] + way;
        radius += way * way;
        from[i] = (float)p[i] - center[i];
        high += from[i] * n[i] / sqrtf(nn);
    }
    for (int i = 0; i < 3; ++i) {
        const float in_plane = from[i] - high * n[i] / sqrtf(nn);
        flat += in_plane * in_plane;
    }
    flat = sqrtf(flat) - sqrtf(radius);
    return sqrtf(flat * flat + high * high) - tube;
}

/* An arc with a chord of 1 about the origin, and a point over its middle part, turned together. */
static void draw(report_random *random, double sagitta, float points[3][3], double p[3]) {
    double own[4][3] = {{-0.5, 0, 0}, {0.5, 0, 0}, {0, 0, 0}, {0, 0, 0}}, axes[3][3], along;
    own[2][1] = sagitta;
    own[3][0] = report_uniform(random, -0.2, 0.2);
    for (int axis = 1; axis < 3; ++axis) own[3][axis] = report_uniform(random, -0.3, 0.3);
    accuracy_unit(random, axes[0]);
    do {
        accuracy_unit(random, axes[1]);
        along = surface_dot(axes[0], axes[1]);
    } while (fabs(along) > 0.9);
    for (int axis = 0; axis < 3; ++axis) axes[1][axis] -= along * axes[0][axis];
    surface_unit(axes[1]);
    for (int axis = 0; axis < 3; ++axis) {
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        axes[2][axis] = axes[0][next] * axes[1][last] - axes[0][last] * axes[1][next];
    }
    for (int which = 0; which < 4; ++which) {
        for (int axis = 0; axis < 3; ++axis) {
            double turned = 0;
            for (int i = 0; i < 3; ++i) turned += own[which][i] * axes[i][axis];
            if (which < 3) points[which][axis] = (float)turned;
            if (which == 3) p[axis] = (double)(float)turned;
        }
    }
}

void accuracy_arcs(const report_options *options, FILE *rows) {
    const accuracy_subject subjects[2] = {
        {"arc", "sagitta over chord", "of the arc's size",
         "shapes_primitives.h: off by at most 1.5e-6 times the size of the arc at every flatness"},
        {"arc_usual", "sagitta over chord", "of the arc's size", ""}};
    for (int usual = 0; usual < 2; ++usual) {
        for (int power = -1; power >= -7; --power) {
            report_random random = {(uint64_t)-power};
            accuracy_errors errors = {NULL, 0, 0};
            for (size_t left = accuracy_samples(options, 16000); left > 0; --left) {
                float points[3][3];
                double p[3];
                draw(&random, pow(10, power), points, p);
                const double truth = accuracy_arc_double((const float(*)[3])points, tube, p);
                const double seen = usual ? (double)usual_arc((const float(*)[3])points, p)
                                          : accuracy_arc_float((const float(*)[3])points, tube, p);
                accuracy_add(&errors, fabs(seen - truth));
            }
            accuracy_write(rows, &subjects[usual], pow(10, power), usual ? 0 : 1.5e-6, &errors);
        }
    }
}
