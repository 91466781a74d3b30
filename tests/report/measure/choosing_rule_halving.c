/* SPDX-License-Identifier: MIT
 *
 * Omega halved at each rejected probe. */
#define SPTI_METHOD halving
#define SPTI_RULE "../../tests/report/rules/rearm_halving.h"
#include "choosing_rule.h"
