/* SPDX-License-Identifier: MIT
 *
 * Omega from the slope. */
#define SPTI_METHOD slope
#define SPTI_RULE "../../tests/report/rules/rearm_slope.h"
#include "choosing_rule.h"
