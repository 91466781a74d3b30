/* SPDX-License-Identifier: MIT
 *
 * All step rules of the library, for programs that compare them or take one by its name. */
#ifndef EXAMPLES_STEP_RULES_H
#define EXAMPLES_STEP_RULES_H

#include <spheretrace/spheretrace.h>

#include <string.h>

/* The rule of an index counted from 0, NULL behind the last. */
static inline const spt_method *step_rule(size_t index) {
    switch (index) {
    case 0:
        return spt_basic();
    case 1:
        return spt_relaxed();
    case 2:
        return spt_enhanced();
    case 3:
        return spt_auto_relaxed();
    case 4:
        return spt_adaptive();
    case 5:
        return spt_convex();
    default:
        return NULL;
    }
}

/* The rule of a name, or NULL. */
static inline const spt_method *step_rule_named(const char *name) {
    size_t index = 0;
    while (step_rule(index) != NULL && strcmp(spt_method_name(step_rule(index)), name) != 0) {
        ++index;
    }
    return step_rule(index);
}

/* Whether a rule may trace a field: the convex one needs a convex function. */
static inline int step_rule_allowed(const spt_method *method, uint32_t field_flags) {
    return method != spt_convex() || (field_flags & SPT_FIELD_CONVEX) != 0;
}

#endif
