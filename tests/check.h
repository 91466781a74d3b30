/* SPDX-License-Identifier: MIT
 *
 * What a test needs: run by name, check, say where, draw reproducible random numbers. A test file
 * exports one suite function, listed in suites.h, that runs its tests:
 *     static void A1_nan_beyond_z5(void) { CHECK(...); }
 *     void suite_callback_values(void) { RUN(A1_nan_beyond_z5); }
 * `build/check A1 Q shapes` runs the tests whose names begin with A1 or with Q, and all of the
 * suite shapes; a word that finds no test is a failure. `build/check 1/2` runs every second one. */
#ifndef TESTS_CHECK_H
#define TESTS_CHECK_H

#include <stdint.h>

#define SUITE(name) void suite_##name(void);
#include "suites.h"
#undef SUITE

/* Runs a test unless the command line filters it out. It fails if any of its checks does. */
#define RUN(test) check_run(#test, test)
void check_run(const char *name, void (*test)(void));

/* The condition must hold. The test goes on; only its first failures are printed. */
#define CHECK(condition) check_that((condition) != 0, #condition, __FILE__, __LINE__)
/* The same, with a printf-style text that says what was seen. */
#define CHECK_SAY(condition, ...) \
    ((condition) ? (void)0 \
                 : (check_say(__VA_ARGS__), check_that(0, #condition, __FILE__, __LINE__)))
void check_that(int holds, const char *condition, const char *file, int line);

/* A printf-style text printed with the next failed checks, such as "method basic, 8 lanes". */
void check_context(const char *format, ...);
void check_say(const char *format, ...);

/* The test cannot run here, for this reason; counts as skipped, or as failed with SPT_REQUIRE=1. */
void check_skip(const char *reason);

/* Random numbers, restarted from one printed seed at the start of every test. */
uint32_t check_random(void);
double check_uniform(double low, double high);

/* Equality of bits, which is what parity means; NaN equals itself. */
int check_same_bits(float a, float b);
uint32_t check_bits(float a);

#endif
