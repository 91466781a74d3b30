/* SPDX-License-Identifier: MIT
 *
 * Angles of points in a plane, without libm. */
#ifndef SPTI_ANGLE_H
#define SPTI_ANGLE_H

/* The angle of (x, y) in turns, from -1/2 to 1/2; 0 for the origin. To 1e-9: the series of the arc
 * tangent to the 21st power, up to an eighth of a half turn. */
static inline double spti_turns(double y, double x) {
    const double half_turn = 3.14159265358979323846, eighth = 0.41421356237309503;
    const double across = y < 0 ? -y : y, ahead = x < 0 ? -x : x;
    const double larger = across > ahead ? across : ahead;
    if (!(larger > 0)) return 0;
    const double t = (across > ahead ? ahead : across) / larger;
    const double s = t > eighth ? (t - 1) / (t + 1) : t, square = s * s;
    double series = 0;
    for (int power = 21; power > 0; power -= 2) series = 1.0 / power - square * series;
    double turns = s * series / (2 * half_turn) + (t > eighth ? 0.125 : 0);
    if (across > ahead) turns = 0.25 - turns;
    if (x < 0) turns = 0.5 - turns;
    return y < 0 ? -turns : turns;
}

#endif
