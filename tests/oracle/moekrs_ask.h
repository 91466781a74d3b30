/* SPDX-License-Identifier: MIT
 *
 * Asks fields and probes directly, as the library would: in batches of aligned arrays, padded with
 * a point that is there. Left out: what the answers should be. */
#ifndef TESTS_ORACLE_MOEKRS_ASK_H
#define TESTS_ORACLE_MOEKRS_ASK_H

#include <spheretrace/mobius.h>

#include <stddef.h>

typedef struct moekrs_query {
    float point[3], radius;
    float answer;
} moekrs_query;

/* answer: the distance; and whether the gap to the surface is free. Callbacks must be there; point:
 * ask one by one. */
void moekrs_ask_field(const spt_field *field, int point, size_t count, moekrs_query *queries);
void moekrs_ask_probe(const spt_probe *probe, int point, size_t count, moekrs_query *queries);

/* Whether SPT_FULL_COUNT=1 asks for the full numbers of "when it is done", and for figures. */
int moekrs_full(void);

#endif
