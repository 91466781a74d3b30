/* SPDX-License-Identifier: MIT
 *
 * Plain steps for a while, rejected probes forgotten. */
#define REARM_PENDING 0
#define SPTI_METHOD after_forgetting
#define SPTI_RULE "../../tests/report/rules/rearm_after.h"
#include "choosing_rule.h"
