/* SPDX-License-Identifier: MIT
 *
 * The test program: runs the suites of suites.h, or of another list (CHECK_SUITES), and ends with
 * "N passed, N failed". CHECK_NEEDS: a function that returns 0 where what they run on is there. */
#include "check.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef CHECK_SUITES
#define CHECK_SUITES "suites.h"
#endif
#define SUITE(name) void suite_##name(void);
#include CHECK_SUITES
#undef SUITE
#ifdef CHECK_NEEDS
int CHECK_NEEDS(void);
#endif

enum { seed = 20141202, printed_failures = 3 };

enum { most_filters = 64 };

static struct {
    char **filters;
    int filter_count;
    char used[most_filters]; /* filters that found a test */
    int part, parts;         /* every parts-th test only, from the part-th on */
    int seen;                /* tests that the filters want */
    const char *suite;
    int passed, failed, skipped;
    int failures; /* of the running test */
    int skip;     /* the running test asked for it */
    uint32_t random;
    char context[256], said[1024];
} state;

static int wanted(const char *name) {
    int found = state.filter_count == 0;
    for (int i = 0; i < state.filter_count; ++i) {
        if (strncmp(name, state.filters[i], strlen(state.filters[i])) == 0 ||
            strcmp(state.suite, state.filters[i]) == 0) {
            state.used[i] = 1;
            found = 1;
        }
    }
    return found;
}

void check_run(const char *name, void (*test)(void)) {
    if (!wanted(name)) return;
    if (state.seen++ % state.parts != state.part - 1) return;
    state.failures = 0;
    state.skip = 0;
    state.random = seed;
    state.context[0] = state.said[0] = '\0';
    test();
    if (state.failures != 0) {
        ++state.failed;
        printf("FAILED %s: %d checks\n", name, state.failures);
    } else if (state.skip) {
        ++state.skipped;
    } else {
        ++state.passed;
    }
    fflush(stdout);
}

void check_that(int holds, const char *condition, const char *file, int line) {
    if (!holds) {
        if (state.failures < printed_failures) {
            printf("%s:%d: %s", file, line, condition);
            if (state.context[0] != '\0') printf(" [%s]", state.context);
            if (state.said[0] != '\0') printf(": %s", state.said);
            printf("\n");
        }
        ++state.failures;
    }
    state.said[0] = '\0';
}

void check_context(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(state.context, sizeof state.context, format, arguments);
    va_end(arguments);
}

void check_say(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(state.said, sizeof state.said, format, arguments);
    va_end(arguments);
}

void check_skip(const char *reason) {
    const char *require = getenv("SPT_REQUIRE");
    printf("skipped: %s\n", reason);
    if (require != NULL && strcmp(require, "1") == 0) {
        ++state.failures;
    } else {
        state.skip = 1;
    }
}

uint32_t check_random(void) {
    uint32_t x = state.random += 0x9e3779b9u; /* splitmix32 */
    x = (x ^ (x >> 16)) * 0x85ebca6bu;
    x = (x ^ (x >> 13)) * 0xc2b2ae35u;
    return x ^ (x >> 16);
}

double check_uniform(double low, double high) {
    return low + (high - low) * (check_random() / 4294967296.0);
}

uint32_t check_bits(float a) {
    uint32_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

int check_same_bits(float a, float b) {
    return check_bits(a) == check_bits(b);
}

int main(int count, char **arguments) {
    const int divided = count > 1 && sscanf(arguments[1], "%d/%d", &state.part, &state.parts) == 2;
    if (!divided || state.part < 1 || state.parts < state.part) state.part = state.parts = 1;
    state.filters = arguments + 1 + divided;
    state.filter_count = count - 1 - divided;
    if (state.filter_count > most_filters) state.filter_count = most_filters;
#ifdef CHECK_NEEDS
    if (CHECK_NEEDS() != 0) {
        check_skip("all tests, what they run on is not there");
        return state.failures != 0 ? 1 : 77;
    }
#endif
    printf("random numbers from seed %d\n", seed);
#define SUITE(name) \
    state.suite = #name; \
    suite_##name();
#include CHECK_SUITES
#undef SUITE
    for (int i = 0; i < state.filter_count; ++i) {
        if (state.used[i]) continue;
        printf("FAILED %s: no such test or suite\n", state.filters[i]);
        ++state.failed;
    }
    printf("%d passed, %d failed", state.passed, state.failed);
    if (state.skipped != 0) printf(", %d skipped", state.skipped);
    printf("\n");
    return state.failed != 0 || (state.parts == 1 && state.passed + state.skipped == 0);
}
