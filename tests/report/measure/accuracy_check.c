/* SPDX-License-Identifier: MIT
 *
 * What tests/check.h is to the oracles here, where only their mathematics is used: a check that
 * fails ends the report, and so does drawing, since cells have random numbers of their own. Left
 * out: running tests. */
#include "../report.h"
#include "../../check.h"

#include <string.h>

void check_that(int holds, const char *condition, const char *file, int line) {
    if (!holds) fprintf(stderr, "%s:%d: %s\n", file, line, condition);
    report_expect(holds, "a reference does not keep what it checks");
}

void check_context(const char *format, ...) {
    (void)format;
}

void check_say(const char *format, ...) {
    (void)format;
}

uint32_t check_random(void) {
    report_expect(0, "a reference draws random numbers, which are the cells'");
    return 0;
}

double check_uniform(double low, double high) {
    (void)high;
    check_random();
    return low;
}

uint32_t check_bits(float a) {
    uint32_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

int check_same_bits(float a, float b) {
    return check_bits(a) == check_bits(b);
}
