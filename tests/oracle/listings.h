/* SPDX-License-Identifier: MIT
 *
 * The papers' listings as they are printed, misprints included, as negative controls for
 * test_papers.c. Nothing here is right, and nothing here is to be mended. */
#ifndef TESTS_ORACLE_LISTINGS_H
#define TESTS_ORACLE_LISTINGS_H

#include <stdint.h>

typedef float listing_distance_fn(void *user, float x, float y, float z);

/* What a listing takes from outside, and how many values it asked the field for. */
typedef struct listing {
    listing_distance_fn *distance;
    void *user;
    float origin[3], direction[3];
    int max_iterations;
    uint32_t evaluations; /* counted up from where the caller left it */
} listing;

/* Keinert et al. 2014, Listing 1: sphere tracing. */
float keinert_listing_1(listing *in, float t_min, float t_max, float tau);

/* Keinert et al. 2014, Listing 2: over-relaxation with screen-space selection. omega is 1.2 in the
 * listing. */
float keinert_listing_2(listing *in, float t_min, float t_max, float omega, float pixel_radius,
                        int force_hit);

/* Bálint & Valasek 2018, Algorithms 1 to 3; "not too small" is written r >= epsilon. */
float balint_algorithm_1(listing *in, float epsilon);
float balint_algorithm_2(listing *in, float epsilon, float omega);
float balint_algorithm_3(listing *in, float epsilon, float omega);

/* The step of Algorithm 3 with Equation 1 as printed, from the last step, the radius before it and
 * the radius now. */
double balint_printed_step(double step, double previous, double radius, double omega);

#endif
