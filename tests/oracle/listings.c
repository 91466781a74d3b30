/* SPDX-License-Identifier: MIT
 *
 * Keinert et al. 2014, Listings 1 and 2, and Bálint & Valasek 2018, Algorithms 1 to 3, line by line
 * and in float. Only brackets that compilers demand were added. */
#include "listings.h"

#include <math.h>

/* f(d*t + o) */
static float f(listing *in, float t) {
    const float *o = in->origin, *d = in->direction;
    ++in->evaluations;
    return in->distance(in->user, d[0] * t + o[0], d[1] * t + o[1], d[2] * t + o[2]);
}

float keinert_listing_1(listing *in, float t_min, float t_max, float tau) {
    const int MAX_ITERATIONS = in->max_iterations;
    float t = t_min;
    int i = 0;
    while (i < MAX_ITERATIONS && t < t_max) {
        float radius = f(in, t);
        if (radius < tau) break;
        t += radius;
        i++;
    }
    if (i == MAX_ITERATIONS || t > t_max) return INFINITY;
    return t;
}

float keinert_listing_2(listing *in, float t_min, float t_max, float omega, float pixelRadius,
                        int forceHit) {
    const int MAX_ITERATIONS = in->max_iterations;
    float t = t_min;
    float candidate_error = INFINITY;
    float candidate_t = t_min;
    float previousRadius = 0;
    float stepLength = 0;
    float functionSign = f(in, 0) < 0 ? -1.0f : +1.0f;
    for (int i = 0; i < MAX_ITERATIONS; ++i) {
        float signedRadius = functionSign * f(in, t);
        float radius = fabsf(signedRadius);
        int sorFail = omega > 1 && (radius + previousRadius) < stepLength;
        if (sorFail) {
            stepLength -= omega * stepLength;
            omega = 1;
        } else {
            stepLength = signedRadius * omega;
        }
        previousRadius = radius;
        float error = radius / t;
        if (!sorFail && error < candidate_error) {
            candidate_t = t;
            candidate_error = error;
        }
        if ((!sorFail && error < pixelRadius) || t > t_max) break;
        t += stepLength;
    }
    if ((t > t_max || candidate_error > pixelRadius) && !forceHit) return INFINITY;
    return candidate_t;
}

float balint_algorithm_1(listing *in, float epsilon) {
    float t = 0;
    for (int i = 0; i < in->max_iterations && f(in, t) >= epsilon; i = i + 1) t = t + f(in, t);
    return t;
}

float balint_algorithm_2(listing *in, float epsilon, float omega) {
    float r = 0, next = INFINITY, t = 0;
    for (int i = 0; i < in->max_iterations && next >= epsilon; i = i + 1) {
        float d = r + omega * r;
        next = f(in, t + d);
        if (d > r + next) {
            d = r;
            next = f(in, t + d);
        }
        t = t + d;
        r = next;
    }
    return t;
}

float balint_algorithm_3(listing *in, float epsilon, float omega) {
    float previous = 0, r = 0, next = INFINITY;
    float d = 0, t = 0;
    for (int i = 0; i < in->max_iterations && next >= epsilon; i = i + 1) {
        d = r + omega * r * ((d - previous + r) / (d + previous - r));
        next = f(in, t + d);
        if (d > r + next) {
            d = r;
            next = f(in, t + d);
        }
        t = t + d;
        previous = r;
        r = next;
    }
    return t;
}

double balint_printed_step(double step, double previous, double radius, double omega) {
    return radius + omega * radius * ((step - previous + radius) / (step + previous - radius));
}
