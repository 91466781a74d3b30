/* SPDX-License-Identifier: MIT
 *
 * The idea introduced here: a callback for many points at once, which the compiler turns into
 * vector code; and how to find out whether it did. */
#include <spheretrace/spheretrace.h>

#include <math.h>
#include <stdio.h>
#include <time.h>

/* README: begin */
/* A ball of radius 1 at the origin and a wall at z = 2. One loop, no branches, arrays that do not
 * overlap: compiled with -O3 -fno-math-errno and a wide -m flag it runs 4, 8 or 16 points at a
 * time. */
static void ball_and_wall(void *user, size_t n, const float *restrict x, const float *restrict y,
                          const float *restrict z, float *restrict distance) {
    (void)user;
    for (size_t i = 0; i < n; ++i) {
        const float ball = sqrtf(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]) - 1.0f;
        const float wall = 2.0f - z[i];
        distance[i] = ball < wall ? ball : wall;
    }
}
/* README: end */

/* The same for one point, to compare with. */
static float ball_and_wall_point(void *user, float x, float y, float z) {
    (void)user;
    const float ball = sqrtf(x * x + y * y + z * z) - 1.0f;
    const float wall = 2.0f - z;
    return ball < wall ? ball : wall;
}

enum { side = 128, count = side * side };

static spt_ray rays[count];
static float t[count];

/* Parallel rays along z from z = -3, in a square around the axis. None is in doubt: x^2 + y^2 is
 * (a^2 + b^2) / 48^2 with a and b odd, a^2 + b^2 is 2 more than a multiple of 8, and 48^2 is one; so
 * no ray passes nearer than 4e-4 to the rim of the ball. */
static void fill_rays(void) {
    for (int i = 0; i < count; ++i) {
        const float x = (float)(2 * (i % side) + 1 - side) / 48.0f;
        const float y = (float)(2 * (i / side) + 1 - side) / 48.0f;
        const spt_ray ray = {{x, y, -3.0f}, 0.0f, {0.0f, 0.0f, 1.0f}, INFINITY};
        rays[i] = ray;
    }
}

/* How many rays do not end between the surface and where its distance is epsilon, but for rounding:
 * of a position near 5 and of the distance, less than 1e-6, over the cosine to the normal. */
static int count_wrong(double epsilon) {
    int wrong = 0;
    for (int i = 0; i < count; ++i) {
        const double x = (double)rays[i].origin[0], y = (double)rays[i].origin[1];
        const double square = x * x + y * y, grown = 1.0 + epsilon;
        const double cosine = square < 1.0 ? sqrt(1.0 - square) : 1.0;
        const double surface = square < 1.0 ? 3.0 - cosine : 5.0;
        const double before = square < 1.0 ? 3.0 - sqrt(grown * grown - square) : 5.0 - epsilon;
        const double slack = 1e-6 / cosine;
        wrong += !((double)t[i] > before - slack && (double)t[i] < surface + slack);
    }
    return wrong;
}

static double processor_seconds(void *user) {
    (void)user;
    return (double)clock() / CLOCKS_PER_SEC;
}

int main(void) {
    spt_field field = spt_field_default();
    field.batch = ball_and_wall;
    const spt_settings settings = spt_settings_default();
    const spt_rays in = spt_rays_of(rays);
    spt_hits out = {0};
    out.t.first = t; /* the only result that is wanted */
    out.t.stride = sizeof *t;
    fill_rays();
    spt_statistics statistics = spt_statistics_default();
    if (spt_trace(&field, &settings, count, &in, &out, &statistics) != SPT_OK) return 1;
    printf("%d rays, %.2f evaluations each, %u at a time, %.1f %% of the lanes in use\n", count,
           (double)statistics.evaluations / count, statistics.lanes,
           100.0 * spt_utilisation(&statistics));
    const int wrong = count_wrong((double)settings.epsilon);
    printf("%d wrong\n", wrong);

    spt_field by_point = spt_field_default();
    by_point.point = ball_and_wall_point;
    spt_field_cost batch, point;
    if (spt_field_measure(&field, processor_seconds, NULL, &batch) != SPT_OK ||
        spt_field_measure(&by_point, processor_seconds, NULL, &point) != SPT_OK) {
        printf("This machine's clock is too coarse to measure the callback.\n");
        return wrong == 0 ? 0 : 1;
    }
    printf(
        "nanoseconds an evaluation: %.2f with 16 points a call, %.2f with 256, %.2f one by one\n",
        batch.nanoseconds_16, batch.nanoseconds_256, point.nanoseconds_256);
    if (batch.nanoseconds_256 > 0.6 * point.nanoseconds_256) {
        printf(
            "The callback did not vectorise. Compile its file with -O3 -fno-math-errno, mark its\n"
            "arrays restrict, and let gcc -fopt-info-vec-missed or clang\n"
            "-Rpass-missed=loop-vectorize say what is in the way.\n");
    }
    return wrong == 0 ? 0 : 1;
}
