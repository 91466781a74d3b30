/* SPDX-License-Identifier: MIT
 *
 * Probes that say what they are told to, and calls of binary tracing with one ray: for the tests of
 * its contract. Left out: real bodies, see binary_scene.h. */
#ifndef TESTS_ORACLE_BINARY_TOLD_H
#define TESTS_ORACLE_BINARY_TOLD_H

#include <spheretrace/mobius.h>

typedef enum binary_saying {
    BINARY_NEVER,  /* never free */
    BINARY_NEARLY, /* nothing is free but what has no size */
    BINARY_ALWAYS, /* all is free */
    BINARY_NOT_A_NUMBER,
    BINARY_NAN_BEYOND,   /* NaN where the ball's middle is beyond x = 5 */
    BINARY_NAN_IF_LARGE, /* NaN for balls larger than 1/2, and a wall at x = 5 */
    BINARY_WALL,         /* the half space x >= 5 */
    BINARY_FAR_WALL      /* x >= 100 */
} binary_saying;

typedef struct binary_told {
    binary_saying what;
    uint64_t asked;
} binary_told;

typedef struct binary_call {
    binary_told as;
    spt_probe probe;
    spt_bound bound;
    spt_binary binary;
    spt_settings settings;
    spt_ray ray;
    spt_hit hit;
} binary_call;

/* A ray along x from 0, t up to 50. Not to be copied once it is filled. */
void binary_call_of(binary_call *call, binary_saying what);

/* Traces it, and checks what holds of every result; then how it must end. */
void binary_call_trace(binary_call *call);
void binary_expect(binary_call *call, spt_outcome outcome, double low, double high);

/* Every width, both callbacks: for (int way = 0; binary_way(&call, &way);) ... */
int binary_way(binary_call *call, int *way);

#endif
