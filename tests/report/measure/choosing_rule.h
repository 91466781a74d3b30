/* SPDX-License-Identifier: MIT
 *
 * A step rule of the study as an object: a template, included once a file. Parameters: SPTI_METHOD,
 * its name, and SPTI_RULE, its header as src/backend sees it. Defines choosing_rule_NAME().
 * It runs with max_lanes 1 only: counts do not depend on the width, and one kernel is enough. */
#define SPT_LANES 1
#define SPTI_MARCH SPTI_JOIN2(choosing_march, SPTI_METHOD)
#include "../../../src/backend/march.c"

#include "../../../src/trace/method.h"
#include "choosing_rules.h"

const spt_method *SPTI_JOIN2(choosing_rule, SPTI_METHOD)(void) {
    static const spt_method method = {
        SPTI_TEXT(SPTI_METHOD), rule_probes, rule_pending, rule_memory, rule_blends,
        rule_needs_convex,      NULL,        {SPTI_MARCH}};
    return &method;
}
