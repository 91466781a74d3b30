/* SPDX-License-Identifier: MIT
 *
 * What trace.h, krs.h and mobius.h say of every result of the calls of krs_calls.h, whatever the
 * fields, models, rays and hits. What is right for a given model is not here. Knows nothing of
 * check.h: the fuzzing harness uses it, too. */
#ifndef TESTS_KRS_RESULTS_H
#define TESTS_KRS_RESULTS_H

#include "krs_calls.h"

enum { KRS_TAME = 1u << 0 /* all numbers are usual, and no callback answers nonsense */ };

/* The first broken promise in the results of an index, as text; NULL where there is none. before:
 * what the bytes of the sinks held, all of them the same. */
const char *krs_wrong(const krs_call *call, unsigned char before, uint32_t promises, size_t index);

/* A word of a column, or of a sink; absent ones give the word absent. */
uint32_t krs_read(const spt_column *column, size_t index, uint32_t absent);
uint32_t krs_written(const spt_sink *sink, size_t index, uint32_t absent);

int krs_ray_is_bad(const krs_call *call, size_t index);

#endif
