/* SPDX-License-Identifier: MIT
 *
 * The races of peers_bench: who is raced against whom, and what is reported of each. */
#ifndef TESTS_BENCH_PEERS_RACE_H
#define TESTS_BENCH_PEERS_RACE_H

#include "../bench.h"

/* A line of peers.csv. */
typedef struct peers_result {
    const char *peer, *scene;
    const char *peer_way, *our_way; /* how each side traced it */
    int lanes;                      /* of ours */
    size_t rays;
    double peer_nanoseconds, our_nanoseconds; /* a ray, medians */
    double ratio;                             /* the median of theirs over ours */
    double target;                            /* that it is to reach; 0: none */
} peers_result;

void peers_report(FILE *table, const peers_result *result);

/* Each returns how many hits differ that must not; -1 where the peer is not on this machine. */
int peers_race_llvmpipe(const bench_options *options, FILE *table);
int peers_race_embree(const bench_options *options, FILE *table);

#endif
