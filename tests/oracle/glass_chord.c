/* SPDX-License-Identifier: MIT
 *
 * Chords of convex bodies in double. Along a line f is convex, so that it has one least value,
 * found by thirds, and at most two roots. */
#include "glass_chord.h"
#include "check.h"

#include <math.h>

enum { thirds = 100 };

double glass_chord_distance(const glass_body *body, const glass_chord *chord, double at) {
    double p[3];
    for (int axis = 0; axis < 3; ++axis)
        p[axis] = chord->origin[axis] + at * chord->direction[axis];
    return glass_distance(body, p);
}

static double deepest(const glass_body *body, const glass_chord *chord, double low, double high) {
    for (int i = 0; i < thirds; ++i) {
        const double first = low + (high - low) / 3, second = high - (high - low) / 3;
        if (glass_chord_distance(body, chord, first) < glass_chord_distance(body, chord, second)) {
            high = second;
        } else {
            low = first;
        }
    }
    return (low + high) / 2;
}

static double clamped(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}

/* Entry and exit of the whole line; the closest point to the center is within 30 of the origin. */
static void cross(const glass_body *body, glass_chord *chord) {
    double far[3], at[3], entry = 0, leave = 0;
    const double back = 60;
    for (int axis = 0; axis < 3; ++axis) {
        far[axis] = chord->origin[axis] - back * chord->direction[axis];
    }
    chord->middle = deepest(body, chord, -back, back);
    chord->meets = glass_cross(body, far, chord->direction, 0, &entry);
    if (!chord->meets) return;
    for (int axis = 0; axis < 3; ++axis) at[axis] = far[axis] + entry * chord->direction[axis];
    chord->meets = glass_cross(body, at, chord->direction, 1, &leave);
    chord->entry = entry - back;
    chord->leave = entry - back + leave;
}

glass_chord glass_chord_of(const glass_body *body, const spt_ray *ray) {
    glass_chord chord;
    double square = 0, least;
    for (int axis = 0; axis < 3; ++axis) {
        chord.origin[axis] = (double)ray->origin[axis];
        chord.direction[axis] = (double)ray->direction[axis];
        square += chord.direction[axis] * chord.direction[axis];
    }
    chord.length = sqrt(square);
    for (int axis = 0; axis < 3; ++axis) chord.direction[axis] /= chord.length;
    chord.from = (double)ray->t_min * chord.length;
    chord.to = (double)ray->t_max * chord.length;
    cross(body, &chord);
    chord.inside = chord.meets && chord.entry < chord.from && chord.from < chord.leave;
    chord.hit = chord.inside ? chord.leave : chord.entry;
    chord.outcome =
        chord.meets && chord.hit >= chord.from && chord.hit <= chord.to ? SPT_HIT : SPT_MISS;
    if (!(chord.from <= chord.to)) {
        chord.outcome = SPT_MISS;
        chord.decided = HUGE_VAL;
        return chord;
    }
    chord.decided = fabs(glass_chord_distance(body, &chord, chord.from));
    if (chord.to < HUGE_VAL) {
        chord.decided = fmin(chord.decided, fabs(glass_chord_distance(body, &chord, chord.to)));
    }
    /* From inside the least does not matter. */
    least = glass_chord_distance(body, &chord, clamped(chord.middle, chord.from, chord.to));
    if (!chord.inside) chord.decided = fmin(chord.decided, fabs(least));
    return chord;
}

double glass_chord_floor(const glass_body *body, const glass_chord *chord, double t) {
    double largest = 0, size = 0;
    for (int axis = 0; axis < 3; ++axis) {
        largest = fmax(largest, fabs(chord->origin[axis]));
        size = fmax(size, fabs(body->center[axis]));
    }
    /* No bound of these tests reaches farther than four of the ball around the body. */
    return 0x1p-22 * (largest + t + size + 4 * (double)body->bound.radius);
}

double glass_chord_tolerance(const spt_settings *settings, const glass_body *body,
                             const glass_chord *chord, double t) {
    const double cone = (double)settings->pixel_radius * t;
    return fmax(fmax((double)settings->epsilon, cone), glass_chord_floor(body, chord, t));
}

/* Somewhere in a ball of that many radii of the body's. */
static void somewhere(const glass_body *body, double radii, double p[3]) {
    double square;
    do {
        square = 0;
        for (int axis = 0; axis < 3; ++axis) {
            p[axis] = check_uniform(-1, 1);
            square += p[axis] * p[axis];
        }
    } while (square > 1);
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = body->center[axis] + radii * (double)body->bound.radius * p[axis];
    }
}

spt_ray glass_chord_ray(const glass_body *body, int place) {
    spt_ray ray = {{0, 0, 0}, 0, {0, 0, 0}, INFINITY};
    const int doublings = (int)(check_random() % 14) - 7;
    const double scale = ldexp(check_uniform(1, 2), doublings);
    double from[3], to[3], square = 0;
    int drawn = 0;
    do {
        somewhere(body, place == 2 ? 6 : place == 1 ? 1.4 : 1, from);
        ++drawn;
    } while (drawn < 1000 && (glass_distance(body, from) < 0) != (place == 0));
    somewhere(body, 1.1, to);
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = (float)from[axis];
        square += (to[axis] - from[axis]) * (to[axis] - from[axis]);
    }
    for (int axis = 0; axis < 3; ++axis) {
        ray.direction[axis] = (float)((to[axis] - from[axis]) / sqrt(square) * scale);
    }
    if (check_random() % 3 == 0) ray.t_min = (float)(check_uniform(0, 4) / scale);
    if (check_random() % 3 == 0) ray.t_max = (float)(check_uniform(0, 5) / scale);
    return ray;
}
