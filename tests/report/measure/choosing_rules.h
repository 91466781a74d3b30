/* SPDX-License-Identifier: MIT
 *
 * THE LIST of step rules that were made to answer when over-relaxation should be taken up again;
 * the rules are in rules/, each is built by a file choosing_rule_NAME.c. For max_lanes 1. */
#ifndef TESTS_REPORT_CHOOSING_RULES_H
#define TESTS_REPORT_CHOOSING_RULES_H

#include <spheretrace/trace.h>

const spt_method *choosing_rule_after(void);
const spt_method *choosing_rule_after_forgetting(void);
const spt_method *choosing_rule_growing(void);
const spt_method *choosing_rule_halving(void);
const spt_method *choosing_rule_slope(void);

#endif
