/* SPDX-License-Identifier: MIT
 *
 * Whether all who are raced found the same: each hit against that of the exact triangles. */
#ifndef TESTS_BENCH_PEERS_CHECK_H
#define TESTS_BENCH_PEERS_CHECK_H

#include "peers_embree.h"

/* Pixels by what was found. */
typedef struct peers_found {
    size_t equal;      /* misses on both sides, or hits within the stop of the surface */
    size_t silhouette; /* stopped where the ray passes a body by less than the stop, half a pixel */
    size_t limit;      /* ran out of its budget */
    size_t different;  /* neither */
} peers_found;

/* truth: of triangles; step: the stop, or NULL for hits that are exact, too. Prints the first few
 * that differ, with name. */
peers_found peers_compare(const char *name, const frame_picture *picture, const peers_step *step,
                          const peers_hit *truth, const peers_hit *hits);

#endif
