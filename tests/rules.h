/* SPDX-License-Identifier: MIT
 *
 * The library's own list of step rules, for tests that loop over all of them. */
#ifndef TESTS_RULES_H
#define TESTS_RULES_H

#define SPT_LANES 1
#include "../src/methods/methods.h"

#include <spheretrace/trace.h>

typedef struct rule {
    const char *name;
    const spt_method *(*method)(void);
} rule;

static const rule rules[] = {
#define X(name) {#name, spt_##name},
    SPTI_METHODS(X)
#undef X
};
enum { rule_count = sizeof rules / sizeof rules[0] };

/* The widths the library may run; those the machine lacks fall to the next lower one. */
static const uint32_t widths[] = {1, 4, 8, 16};
enum { width_count = 4 };

/* The width that runs when max_lanes is `lanes`, for callbacks that are built by width. */
static inline int width_run(uint32_t lanes) {
    return (int)lanes < spt_lanes() ? (int)lanes : spt_lanes();
}

/* Whether a rule may trace a field of these flags. */
static inline int rule_allowed(const rule *one, uint32_t field_flags) {
    return one->method() != spt_convex() || (field_flags & SPT_FIELD_CONVEX) != 0;
}

#endif
