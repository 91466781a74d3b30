/* SPDX-License-Identifier: MIT
 *
 * Plain steps until the radius grows. */
#define SPTI_METHOD growing
#define SPTI_RULE "../../tests/report/rules/rearm_growing.h"
#include "choosing_rule.h"
