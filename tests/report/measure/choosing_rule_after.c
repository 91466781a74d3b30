/* SPDX-License-Identifier: MIT
 *
 * Plain steps for a while, rejected probes kept. */
#define REARM_PENDING 1
#define SPTI_METHOD after
#define SPTI_RULE "../../tests/report/rules/rearm_after.h"
#include "choosing_rule.h"
