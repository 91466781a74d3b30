/* SPDX-License-Identifier: MIT
 *
 * Row K3: models that their mirrors cut. The distance is a lower bound of that to what is left, and
 * may exceed that to the union without cuts. Lipschitz constants are in test_krs_distances.c, what
 * spt_krs_check() says of cuts in test_krs_faults.c. */
#include "krs_draw.h"
#include "../check.h"

#include <math.h>

enum { most_points = 400 };
static float points[most_points][3], values[most_points];
static krs_drawn sample;
static spt_krs krs;

static void evaluate(size_t count) {
    krs_build(&sample, 0, &krs);
    const spt_field field = spt_krs_field(&krs);
    krs_values(&field, count, (const float(*)[3])points, values);
}

/* ---- What is left of a ball -------------------------------------------------------------------- */

/* An instance of a sphere, cut by the mirrors that it went through or stayed before. */
typedef struct cut_ball {
    const krs_instance *instance;
    int planes;
    double normal[krs_most_levels][3], offset[krs_most_levels]; /* in the world */
} cut_ball;

static cut_ball cut_ball_of(const krs_expansion *truth, size_t index) {
    cut_ball ball = {0};
    ball.instance = &truth->instances[index];
    for (uint32_t i = ball.instance->kernel; i < truth->levels; ++i) {
        double *const normal = ball.normal[ball.planes], foot[3], head[3];
        for (int axis = 0; axis < 3; ++axis) {
            foot[axis] = truth->offset[i] * truth->normal[i][axis];
            head[axis] = foot[axis] + truth->normal[i][axis];
        }
        for (uint32_t j = i; j < truth->levels; ++j) { /* out to the world */
            if ((ball.instance->mirrors >> j & 1) == 0) continue;
            krs_reflect(truth, j, foot);
            krs_reflect(truth, j, head);
        }
        for (int axis = 0; axis < 3; ++axis) normal[axis] = head[axis] - foot[axis];
        ball.offset[ball.planes++] = surface_dot(normal, foot);
    }
    return ball;
}

static double distance_between(const double a[3], const double b[3]) {
    const double way[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    return surface_length(way);
}

/* The nearest point of one of the sets whose intersection the cut ball is: a half space, or, with
 * the number after the last of them, the ball. */
static void project(const cut_ball *ball, int set, const double from[3], double to[3]) {
    const krs_body *const body = &ball->instance->body;
    if (set < ball->planes) {
        const double beyond = fmax(0, surface_dot(ball->normal[set], from) - ball->offset[set]);
        for (int axis = 0; axis < 3; ++axis)
            to[axis] = from[axis] - beyond * ball->normal[set][axis];
        return;
    }
    const double away = distance_between(from, body->a),
                 share = away > body->radius ? body->radius / away : 1;
    for (int axis = 0; axis < 3; ++axis)
        to[axis] = body->a[axis] + share * (from[axis] - body->a[axis]);
}

/* The distance from p to a cut ball by alternating projections with correction (Dykstra 1983), or
 * +infinity where they do not end in a point of all sets within 1e-8: nothing may be left of it. A
 * point of all sets proves an upper bound of the distance, however near to the truth. */
static double cut_ball_distance(const cut_ball *ball, const double p[3]) {
    double at[3] = {p[0], p[1], p[2]}, correction[krs_most_levels + 1][3] = {{0}};
    for (int round = 0; round < 300; ++round) {
        double moved = 0, off = 0;
        for (int set = 0; set <= ball->planes; ++set) {
            double from[3], to[3];
            for (int axis = 0; axis < 3; ++axis) from[axis] = at[axis] + correction[set][axis];
            project(ball, set, from, to);
            moved += distance_between(at, to);
            for (int axis = 0; axis < 3; ++axis) {
                correction[set][axis] = from[axis] - to[axis];
                at[axis] = to[axis];
            }
        }
        if (moved > 1e-9) continue;
        for (int set = 0; set <= ball->planes; ++set) {
            double to[3];
            project(ball, set, at, to);
            off = fmax(off, distance_between(at, to));
        }
        return off < 1e-8 ? distance_between(p, at) : HUGE_VAL;
    }
    return HUGE_VAL;
}

/* ---- Bounds from both sides -------------------------------------------------------------------- */

/* Union without cuts <= field <= what is left of the union; the first may be far below. */
static void K3_spheres_between_cut_and_union(void) {
    int queries = 0, above_union = 0, decided = 0;
    for (uint32_t levels = 1; levels <= 4; ++levels) {
        static cut_ball balls[31];
        for (int draw = 0; draw < 6; ++draw) {
            check_context("%u levels", levels);
            krs_draw(&sample, levels, KRS_SPHERES, 0.9);
            for (size_t i = 0; i < sample.truth.count; ++i)
                balls[i] = cut_ball_of(&sample.truth, i);
            krs_draw_points(&sample, 60, points);
            evaluate(60);
            for (int i = 0; i < 60; ++i) {
                double p[3], least = HUGE_VAL;
                krs_widen(points[i], p);
                const double whole = krs_expansion_distance(&sample.truth, p, NULL, NULL),
                             rounding = krs_rounding(levels, sample.mirrors, p),
                             value = (double)values[i];
                for (size_t ball = 0; ball < sample.truth.count; ++ball) {
                    const krs_body *const body = &balls[ball].instance->body;
                    if (distance_between(p, body->a) - body->radius < least)
                        least = fmin(least, cut_ball_distance(&balls[ball], p));
                }
                CHECK_SAY(value <= least + 1e-8 + rounding, "%g, cut at %g", value, least);
                CHECK_SAY(value >= whole - rounding, "%g, union at %g", value, whole);
                ++queries;
                decided += least < HUGE_VAL;
                above_union += value > whole + 0.01;
            }
        }
    }
    CHECK_SAY(decided > queries * 9 / 10, "%d of %d", decided, queries);
    /* The control: these models are cut, and their fields no bound of the union. */
    CHECK_SAY(above_union > queries / 20, "%d of %d", above_union, queries);
}

/* Any kernels: no farther than any point of a surface that is left. */
static void K3_no_farther_than_what_is_left(void) {
    int left = 0, beyond = 0, above = 0;
    for (uint32_t levels = 1; levels <= krs_most_levels; ++levels) {
        for (int draw = 0; draw < 4; ++draw) {
            static double near[most_points][3];
            static int kept[most_points];
            check_context("%u levels", levels);
            krs_draw(&sample, levels, KRS_SOLID, 0.9);
            for (int i = 0; i < most_points / 2; ++i) {
                double way[3];
                const size_t index = krs_draw_on_surface(&sample, near[i]);
                const double length = pow(10, check_uniform(-5, 0.5));
                kept[i] = krs_instance_kept(&sample.truth, index, near[i], 0);
                surface_random_unit(way);
                for (int axis = 0; axis < 3; ++axis)
                    points[i][axis] = (float)(near[i][axis] + length * way[axis]);
            }
            evaluate(most_points / 2);
            for (int i = 0; i < most_points / 2; ++i) {
                double p[3];
                krs_widen(points[i], p);
                const double away = distance_between(p, near[i]),
                             rounding = krs_rounding(levels, sample.mirrors, p);
                /* sampled points are within 1e-7 of their surface */
                const int too_far = (double)values[i] > away + 1e-7 + rounding;
                if (kept[i]) {
                    CHECK_SAY(!too_far, "%g, a point left at %g", (double)values[i], away);
                    ++left;
                } else {
                    ++beyond;
                    above += too_far;
                }
            }
        }
    }
    CHECK_SAY(left > 300 && beyond > 300, "%d left, %d cut off", left, beyond);
    /* The control: points that are cut off are passed by. */
    CHECK_SAY(above > beyond / 10, "%d of %d", above, beyond);
}

/* A ball whose middle is 0.2 beyond its mirror: less than a half is left, and its image, which meet
 * in a disc with a rim. By hand: where the ball's nearest point is left the distance is that to it,
 * else the rim is what is nearest. */
static void K3_one_ball_beyond_its_mirror(void) {
    const double beyond = (double)0.2f, rim = sqrt(0.25 - beyond * beyond);
    int exact = 0, above_union = 0;
    sample.levels = 1;
    sample.kernels[0] = spt_kernel_sphere(0.2f, 0, 0, 0.5f);
    sample.kernels[1] = spt_kernel_empty();
    sample.mirrors[0].normal[0] = 1;
    sample.mirrors[0].normal[1] = sample.mirrors[0].normal[2] = sample.mirrors[0].offset = 0;
    for (int i = 0; i < most_points; ++i) {
        for (int axis = 0; axis < 3; ++axis) points[i][axis] = (float)check_uniform(-1, 1);
    }
    evaluate(most_points);
    for (int i = 0; i < most_points; ++i) {
        const double x = -fabs((double)points[i][0]),
                     off_axis = hypot((double)points[i][1], (double)points[i][2]);
        const double to_middle = hypot(x - beyond, off_axis),
                     nearest_x = beyond + 0.5 * (x - beyond) / to_middle;
        const double cut = nearest_x <= 0 ? to_middle - 0.5 : hypot(x, off_axis - rim),
                     whole = hypot(x + beyond, off_axis) - 0.5, value = (double)values[i];
        const double rounding = ldexp(1 + 4, -22) * 2; /* |p| < 2 */
        CHECK_SAY(value <= cut + rounding, "%g, cut at %g", value, cut);
        if (nearest_x <= 0) CHECK_SAY(value >= cut - rounding, "%g, cut at %g", value, cut);
        exact += nearest_x <= 0;
        above_union += value > whole + 0.01;
    }
    CHECK(exact > most_points / 4 && exact < most_points);
    CHECK(above_union > most_points / 4);
}

void suite_krs_cuts(void) {
    RUN(K3_spheres_between_cut_and_union);
    RUN(K3_no_farther_than_what_is_left);
    RUN(K3_one_ball_beyond_its_mirror);
}
