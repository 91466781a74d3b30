#!/bin/sh
# SPDX-License-Identifier: MIT
#
# usage: choice_table.sh SWEEP_MEAN.CSV >choice_table.h
# The table that test_defaults.c compares the header with, from a full report's figures.
set -eu
cat <<'END'
/* SPDX-License-Identifier: MIT
 *
 * Evaluations that the ten kinds take by settings: the columns both, lost and sampled of
 * sweep_mean.csv as a full report writes it. Written by choice_table.sh:
 *     sh tests/oracle/choice_table.sh build/report/sweep_mean.csv >tests/oracle/choice_table.h */
#ifndef TESTS_ORACLE_CHOICE_TABLE_H
#define TESTS_ORACLE_CHOICE_TABLE_H

#include <stdint.h>

typedef struct choice_row {
    const char *setting, *method;
    double value, evaluations; /* geometric mean a ray */
    uint64_t lost;             /* rays of distance bounds */
    uint64_t sampled;          /* evaluations of the few rays that the test counts, all together */
} choice_row;

static const choice_row choice_table[] = {
END
awk -F, 'NR > 1 {
  printf "    {\"%s\", \"%s\", %s, %s, %s, %s},\n", $1, $3, $2, $6, $8, $12
}' "$1"
cat <<'END'
};
enum { choice_rows = sizeof choice_table / sizeof choice_table[0] };

#endif
END
