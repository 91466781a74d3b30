/* SPDX-License-Identifier: MIT
 *
 * The extreme fields. Their callbacks compute in double and round once: what is lost is lost by the
 * step rule, not by rounding. */
#include "choosing.h"

#include <math.h>
#include <string.h>

static double length(double x, double y, double z) {
    return sqrt(x * x + y * y + z * z);
}

static double repeat(double x, double period) {
    return x - period * round(x / period);
}

/* ---- Distance bounds ------------------------------------------------------------------------- */

/* Three plates, a five-hundredth thick, cut by a ball. */
static double plates(double x, double y, double z) {
    const double first = fabs(0.6 * x + 0.8 * y), second = fabs(y - 0.3);
    const double third = fabs(0.8 * z - 0.6 * x);
    return fmax(fmin(first, fmin(second, third)) - 1e-3, length(x, y, z) - 1.2);
}

/* A ball's skin, open above. */
static double shell(double x, double y, double z) {
    return fmax(fabs(length(x, y, z) - 1) - 1e-3, y - 0.4);
}

/* A lattice of wires along all three axes. The nearest of each kind is that of its own cell. */
static double wires(double x, double y, double z) {
    const double a = repeat(x, 0.3), b = repeat(y, 0.3), c = repeat(z, 0.3);
    const double nearest =
        fmin(sqrt(a * a + b * b), fmin(sqrt(b * b + c * c), sqrt(c * c + a * a)));
    return fmax(nearest - 0.004, length(x, y, z) - 1.2);
}

/* A ball displaced by a product of sines, of which the gradient is at most 20: slope 1 + 2. */
static double bumps(double x, double y, double z) {
    return length(x, y, z) - 1 + 0.1 * sin(20 * x) * sin(20 * y) * sin(20 * z);
}

/* A sheet along Schoen's gyroid. Each partial derivative of the sum is cos cos - sin sin of
 * different angles, at most 1, so that the gradient is at most 6 sqrt(3). */
static double gyroid(double x, double y, double z) {
    const double sum = sin(6 * x) * cos(6 * y) + sin(6 * y) * cos(6 * z) + sin(6 * z) * cos(6 * x);
    return fmax(fabs(sum) / (6 * sqrt(3.0)) - 0.005, length(x, y, z) - 1.2);
}

/* A torus whose distance is said to be a tenth of what it is. */
static double tenth(double x, double y, double z) {
    const double ring = sqrt(x * x + z * z) - 1;
    return 0.1 * (sqrt(ring * ring + y * y) - 0.25);
}

/* ---- No distance bounds ---------------------------------------------------------------------- */

/* Twisted blades: far from the axis the slope is 1.5 times the distance to it. */
static double blades(double x, double y, double z) {
    const double u = cos(1.5 * y) * x - sin(1.5 * y) * z, v = sin(1.5 * y) * x + cos(1.5 * y) * z;
    return fmax(fmax(fabs(repeat(u, 0.4)) - 0.01, fabs(v) - 0.8), fabs(y) - 1);
}

/* A grid of balls of different sizes, where each cell knows of its own ball only. */
static double cells(double x, double y, double z) {
    const double a = round(2 * x), b = round(2 * y), c = round(2 * z);
    const double mixed = sin(12.9898 * a + 78.233 * b + 37.719 * c) * 43758.5453;
    const double radius = 0.02 + 0.2 * (mixed - floor(mixed));
    return fmax(length(x - a / 2, y - b / 2, z - c / 2) - radius, length(x, y, z) - 1.5);
}

/* Where a sum of waves is positive: no distance at all. */
static double waves(double x, double y, double z) {
    const double sum = sin(7 * x) + sin(9 * y) + sin(8 * z) + 0.3;
    return fmax(sum, 3 * (length(x, y, z) - 1.3)) / 4;
}

/* ---- As scenes ------------------------------------------------------------------------------- */

#define CALLBACKS(name) \
    static void name##_reference(size_t n, const double *x, const double *y, const double *z, \
                                 double *distance) { \
        for (size_t i = 0; i < n; ++i) distance[i] = name(x[i], y[i], z[i]); \
    } \
    static void name##_batch(void *user, size_t n, const float *x, const float *y, const float *z, \
                             float *distance) { \
        (void)user; \
        for (size_t i = 0; i < n; ++i) { \
            distance[i] = (float)name((double)x[i], (double)y[i], (double)z[i]); \
        } \
    }
CALLBACKS(plates)
CALLBACKS(shell)
CALLBACKS(wires)
CALLBACKS(bumps)
CALLBACKS(gyroid)
CALLBACKS(tenth)
CALLBACKS(blades)
CALLBACKS(cells)
CALLBACKS(waves)

#define FIELD(called, function, told) \
    { \
        .name = called, .lipschitz = told, .eye = {0.9, 1.1, 2.9}, .field_of_view = 50, \
        .t_max = 20, \
        .batch = {function##_batch, function##_batch, function##_batch, function##_batch}, \
        .reference = function##_reference \
    }

scene choosing_stiff(int number) {
    static const scene stiff[choosing_stiff_count] = {
        FIELD("plates", plates, 1), FIELD("shell", shell, 1),   FIELD("wires", wires, 1),
        FIELD("bumps", bumps, 3),   FIELD("gyroid", gyroid, 1), FIELD("tenth", tenth, 1)};
    return stiff[number];
}

/* The bulb from three sides, from near, where its estimate is worst; then four that are told a
 * lesser slope than they have. */
scene choosing_wild(int number) {
    static const double eyes[3][3] = {{1.6, 0.4, 0}, {-0.6, -0.5, 1.5}, {-1, 1.1, -0.8}};
    static const char *const names[3] = {"mandelbulb_1", "mandelbulb_2", "mandelbulb_3"};
    static const scene wild[choosing_wild_count - 3] = {
        FIELD("untold_bumps", bumps, 1), FIELD("blades", blades, 1), FIELD("cells", cells, 1),
        FIELD("waves", waves, 1)};
    if (number >= 3) return wild[number - 3];
    scene shown = *scene_named("mandelbulb");
    shown.name = names[number];
    for (int axis = 0; axis < 3; ++axis) shown.eye[axis] = eyes[number][axis];
    return shown;
}

int choosing_is_bound(const scene *shown) {
    int bound = strcmp(shown->name, choice_kind[choice_kinds - 1]) != 0; /* the Mandelbulb */
    for (int i = 0; i < choosing_wild_count; ++i) {
        bound &= strcmp(shown->name, choosing_wild(i).name) != 0;
    }
    return bound;
}
