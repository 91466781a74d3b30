/* SPDX-License-Identifier: MIT
 *
 * One instance of the march kernel. The Makefile compiles this file once for every rule and
 * instruction set, with SPTI_RULE (the rule's header), SPTI_MARCH (the name of the table) and
 * SPT_LANES defined, and with that set's flags. */
#include SPTI_RULE

#include "../trace/march_kernel.h"

/* One function for every combination of wanted results; what is not leaves no instruction. */
#define INSTANCE(wants) \
    static int pass_##wants(spti_chunk *chunk, const spti_march *march, size_t count, int first) { \
        const int any = march_pass(chunk, march, count, first, wants); \
        spti_clear_upper(); \
        return any; \
    }
INSTANCE(0)
INSTANCE(1)
INSTANCE(2)
INSTANCE(3)
INSTANCE(4)
INSTANCE(5)
INSTANCE(6)
INSTANCE(7)

extern spti_march_fn *const SPTI_MARCH[SPTI_WANTS];
spti_march_fn *const SPTI_MARCH[SPTI_WANTS] = {pass_0, pass_1, pass_2, pass_3,
                                               pass_4, pass_5, pass_6, pass_7};
