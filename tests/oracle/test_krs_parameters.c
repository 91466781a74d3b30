/* SPDX-License-Identifier: MIT
 *
 * The kernels' own parameters (u, v) that spt_krs_locate() tells, by what they must do: run from 0
 * to 1, by the length of an arc, by angles, by lengths in a plane. Which way an angle is counted,
 * and from where, is left to the library. */
#include "krs_places.h"
#include "../check.h"

#include <math.h>

static const double turn = 6.283185307179586;
enum { count = 200 };
static float points[count][3];
static krs_place places[count];
static krs_body body;

/* A model of one kernel, at its points. */
static void locate(const spt_kernel *kernel) {
    static spt_krs krs;
    spt_krs_model model = spt_krs_model_default();
    model.kernels = kernel;
    CHECK(spt_krs_build(&model, &krs) == SPT_OK);
    body = krs_body_of(kernel);
    krs_locate_points(&krs, 0, 0, count, (const float(*)[3])points, places);
}

static void check_unit_range(int with_v) {
    for (int i = 0; i < count; ++i) {
        CHECK_SAY(places[i].u >= 0 && places[i].u <= 1, "u = %g", (double)places[i].u);
        CHECK_SAY(!with_v || (places[i].v >= 0 && places[i].v <= 1), "v = %g", (double)places[i].v);
    }
}

/* Turns apart, to the nearest whole turn. */
static double turns_apart(double a, double b) {
    return a - b - rint(a - b);
}

/* What is left of turns: both count the same way, or the other way, from anywhere. */
static int same_turns(const double *found, const double *truth, int number, double tolerance) {
    int with = 1, against = 1;
    for (int i = 1; i < number; ++i) {
        const double step = turns_apart(found[i], found[0]), wanted = truth[i] - truth[0];
        with = with && fabs(turns_apart(step, wanted)) < tolerance;
        against = against && fabs(turns_apart(step, -wanted)) < tolerance;
    }
    return with || against;
}

/* The same, for numbers that may run from 0 to 1 or from 1 to 0. */
static int same_run(const double *found, const double *truth, int number, double tolerance) {
    int with = 1, against = 1;
    for (int i = 0; i < number; ++i) {
        with = with && fabs(found[i] - truth[i]) < tolerance;
        against = against && fabs(found[i] - (1 - truth[i])) < tolerance;
    }
    return with || against;
}

/* Longitude about y in turns, latitude from pole to pole by its angle. */
static void krs_parameters_of_spheres(void) {
    static double longitude[count], latitude[count], found_u[count], found_v[count];
    const spt_kernel kernel = spt_kernel_sphere(0.5f, -1, 2, 0.75f);
    for (int i = 0; i < count; ++i) {
        longitude[i] = check_uniform(0, 1);
        latitude[i] = check_uniform(0.02, 0.98); /* at a pole there is no longitude */
        const double up = turn / 2 * (latitude[i] - 0.5), around = turn * longitude[i];
        points[i][0] = (float)(0.5 + 0.75 * cos(up) * cos(around));
        points[i][1] = (float)(-1 + 0.75 * sin(up));
        points[i][2] = (float)(2 + 0.75 * cos(up) * sin(around));
    }
    locate(&kernel);
    check_unit_range(1);
    for (int i = 0; i < count; ++i) {
        found_u[i] = (double)places[i].u;
        found_v[i] = (double)places[i].v;
    }
    /* coordinates of 3 are off by 2e-7, on circles about y of radius 0.047 and more */
    CHECK(same_turns(found_u, longitude, count, 1e-5));
    CHECK(same_run(found_v, latitude, count, 1e-5));
    /* At the poles and in the middle: some number in range. */
    for (int i = 0; i < count; ++i) {
        points[i][0] = 0.5f;
        points[i][1] = -1 + 0.75f * (float)(i % 3 - 1);
        points[i][2] = 2;
    }
    locate(&kernel);
    check_unit_range(1);
}

/* An isometry from the plane: lengths and therefore angles are kept; across it nothing changes. */
static void krs_parameters_of_half_spaces(void) {
    for (int draw = 0; draw < 20; ++draw) {
        double normal[3];
        surface_random_unit(normal);
        if (draw < 6) {
            for (int axis = 0; axis < 3; ++axis)
                normal[axis] = axis == draw / 2 ? (draw % 2 != 0 ? -1 : 1) : 0;
        }
        const spt_kernel kernel = spt_kernel_half_space(
            (float)(2 * normal[0]), (float)(2 * normal[1]), (float)(2 * normal[2]), 1);
        for (int i = 0; i < count; ++i) {
            double p[3];
            for (int axis = 0; axis < 3; ++axis) p[axis] = check_uniform(-4, 4);
            const double above = surface_dot(normal, p) - 0.5;
            for (int axis = 0; axis < 3; ++axis)
                points[i][axis] = (float)(p[axis] - above * normal[axis]);
        }
        locate(&kernel);
        for (int i = 1; i < count; ++i) {
            double way[3];
            for (int axis = 0; axis < 3; ++axis)
                way[axis] = (double)points[i][axis] - (double)points[i - 1][axis];
            const double moved = hypot((double)places[i].u - (double)places[i - 1].u,
                                       (double)places[i].v - (double)places[i - 1].v);
            CHECK_SAY(fabs(moved - surface_length(way)) < 1e-5, "%g for %g", moved,
                      surface_length(way));
        }
    }
}

/* Along the arc by its length, around the tube by the angle. */
static void krs_parameters_of_capsules(void) {
    static krs_drawn sample;
    static double around[count], found[count];
    for (int draw = 0; draw < 40; ++draw) {
        spt_kernel kernel = krs_draw_kernel(&sample, 0, KRS_CAPSULES);
        const int straight = draw % 4 == 3;
        if (straight) {
            for (int axis = 0; axis < 3; ++axis)
                kernel.control[axis] = 0.5f * (kernel.a[axis] + kernel.b[axis]);
        }
        body = krs_body_of(&kernel);
        double chord[3], out[3], across[3];
        for (int axis = 0; axis < 3; ++axis) chord[axis] = body.b[axis] - body.a[axis];
        for (int i = 0; i < count; ++i) {
            /* The middle of the tube there, and two directions across the arc. */
            const double part = check_uniform(0.01, 0.99), angle = part * body.angle;
            double middle[3];
            around[i] = check_uniform(0, 1);
            if (body.angle > 0) {
                for (int axis = 0; axis < 3; ++axis) {
                    out[axis] = cos(angle) * body.axis[0][axis] + sin(angle) * body.axis[1][axis];
                    middle[axis] = body.center[axis] + body.circle_radius * out[axis];
                    across[axis] = body.axis[2][axis];
                }
            } else {
                if (i == 0) {
                    double any[3];
                    surface_random_unit(any);
                    krs_cross(chord, any, out);
                    surface_unit(out);
                    krs_cross(chord, out, across);
                    surface_unit(across);
                }
                for (int axis = 0; axis < 3; ++axis)
                    middle[axis] = body.a[axis] + part * chord[axis];
            }
            for (int axis = 0; axis < 3; ++axis)
                points[i][axis] =
                    (float)(middle[axis] + body.radius * (cos(turn * around[i]) * out[axis] +
                                                          sin(turn * around[i]) * across[axis]));
        }
        locate(&kernel);
        check_unit_range(1);
        check_context("angle %g, radius %g of %g", body.angle, body.radius, body.circle_radius);
        for (int i = 0; i < count; ++i) {
            double p[3];
            krs_widen(points[i], p);
            const double truth = krs_arc_fraction(&body, p);
            /* points are off by 1e-7, on circles of at least half the circle's radius 0.05, of
             * arcs from 0.1 on, so that 1e-5 of the length is ten times that */
            CHECK_SAY(fabs((double)places[i].u - truth) < 2e-5, "%g, arc %g", (double)places[i].u,
                      truth);
            found[i] = (double)places[i].v;
        }
        /* tubes are at least 0.01 thick, a turn is 0.06 of way, and points are off by 4e-7 */
        CHECK(same_turns(found, around, count, 1e-4));
        /* Beyond the ends. */
        for (int i = 0; i < count; ++i) {
            for (int axis = 0; axis < 3; ++axis) points[i][axis] = (float)check_uniform(-1.5, 1.5);
        }
        locate(&kernel);
        check_unit_range(1);
        for (int i = 0; i < count; ++i) {
            double p[3];
            krs_widen(points[i], p);
            const double truth = krs_arc_fraction(&body, p);
            if (truth > 0 && truth < 1) continue;
            CHECK_SAY(fabs((double)places[i].u - truth) < 2e-5, "%g, end %g", (double)places[i].u,
                      truth);
        }
    }
}

/* From tip to tip and from edge to edge; in the middle of its length the edges are `width` off. */
static void krs_parameters_of_leaves(void) {
    static krs_drawn sample;
    static double across[count], found[count];
    for (int draw = 0; draw < 30; ++draw) {
        const spt_kernel kernel = krs_draw_kernel(&sample, 0, KRS_LEAVES);
        body = krs_body_of(&kernel);
        for (int i = 0; i < count; ++i) { /* the middle line from edge to edge */
            across[i] = check_uniform(0, 1);
            for (int axis = 0; axis < 3; ++axis)
                points[i][axis] = (float)(body.center[axis] +
                                          body.width * (2 * across[i] - 1) * body.axis[1][axis] +
                                          (i % 2 != 0 ? 1 : -1) * body.radius * body.axis[2][axis]);
        }
        locate(&kernel);
        check_unit_range(1);
        check_context("half %g, width %g", body.half, body.width);
        for (int i = 0; i < count; ++i) {
            CHECK_SAY(fabs((double)places[i].u - 0.5) < 1e-5, "%g", (double)places[i].u);
            found[i] = (double)places[i].v;
        }
        CHECK(same_run(found, across, count, 2e-5)); /* 4e-7 of widths from 0.02 on */
        for (int i = 0; i < count; ++i) {            /* from tip to tip */
            const double along = i / (count - 1.0);
            for (int axis = 0; axis < 3; ++axis)
                points[i][axis] =
                    (float)(body.center[axis] + body.half * (2 * along - 1) * body.axis[0][axis]);
        }
        locate(&kernel);
        check_unit_range(1);
        CHECK(places[0].u < 1e-5f && places[count - 1].u > 1 - 1e-5f);
        for (int i = 1; i < count; ++i) {
            CHECK(places[i].u > places[i - 1].u);
            if (i < count - 1) CHECK(fabs((double)places[i].v - 0.5) < 1e-2);
        }
        for (int i = 0; i < count; ++i) {
            for (int axis = 0; axis < 3; ++axis) points[i][axis] = (float)check_uniform(-1.5, 1.5);
        }
        locate(&kernel);
        check_unit_range(1);
    }
}

static void krs_parameters_of_fields(void) {
    static krs_drawn sample;
    const spt_kernel kernel = krs_draw_kernel(&sample, 0, KRS_FIELDS);
    for (int i = 0; i < count; ++i) {
        for (int axis = 0; axis < 3; ++axis) points[i][axis] = (float)check_uniform(-1.5, 1.5);
    }
    locate(&kernel);
    for (int i = 0; i < count; ++i) {
        CHECK(!(fabsf(places[i].u) > 0));
        CHECK(!(fabsf(places[i].v) > 0));
    }
}

void suite_krs_parameters(void) {
    RUN(krs_parameters_of_spheres);
    RUN(krs_parameters_of_half_spaces);
    RUN(krs_parameters_of_capsules);
    RUN(krs_parameters_of_leaves);
    RUN(krs_parameters_of_fields);
}
