/* SPDX-License-Identifier: MIT
 *
 * Runs the fuzzing harness of glsl.h on pseudo-random bytes, so that every build tries it. */
#include "fuzz_glsl.h"

#include "check.h"

static void failed(const char *condition, const char *file, int line) {
    check_that(0, condition, file, line);
}

static void fuzz_glsl_on_random_bytes(void) {
    enum { inputs = 300, longest = 400 };
    uint8_t data[longest];
    fuzz_failed = failed;
    for (int i = 0; i < inputs; ++i) {
        const size_t size = check_random() % longest;
        for (size_t at = 0; at < size; ++at) data[at] = (uint8_t)(check_random() >> 8);
        check_context("input %d of %u bytes", i, (unsigned)size);
        fuzz_glsl_input(data, size);
    }
    fuzz_failed = NULL;
}

void suite_fuzz_glsl(void) {
    RUN(fuzz_glsl_on_random_bytes);
}
