/* SPDX-License-Identifier: MIT
 *
 * One instance of the march kernel. The Makefile compiles this file once for every rule and
 * instruction set, with SPTI_RULE (the rule's header), SPTI_MARCH (the name of the table) and
 * SPT_LANES defined, and with that set's flags. */
#include SPTI_RULE

#include "../trace/march_kernel.h"

/* The half of a pass that does not depend on what is wanted. */
static SPTI_NOINLINE int points(spti_chunk *chunk, const spti_march *march, size_t count,
                                int keeps) {
    const int any = rule_pending && keeps ? march_points(chunk, march, count, 1)
                                          : march_points(chunk, march, count, 0);
    spti_clear_upper();
    return any;
}

/* One function for every combination of wanted results; what is not leaves no instruction. */
#define INSTANCE(wants) \
    static int pass_##wants(spti_chunk *chunk, const spti_march *march, size_t count, int first) { \
        return points(chunk, march, count, march_samples(chunk, march, count, first, wants)); \
    }
INSTANCE(0)
INSTANCE(1)
INSTANCE(2)
INSTANCE(3)
INSTANCE(4)
INSTANCE(5)
INSTANCE(6)
INSTANCE(7)

/* A rule without probes has none to count. */
#define COUNTING(counts, others) (rule_probes ? (counts) : (others))

extern spti_march_fn *const SPTI_MARCH[SPTI_WANTS];
spti_march_fn *const SPTI_MARCH[SPTI_WANTS] = {pass_0,
                                               pass_1,
                                               pass_2,
                                               pass_3,
                                               COUNTING(pass_4, pass_0),
                                               COUNTING(pass_5, pass_1),
                                               COUNTING(pass_6, pass_2),
                                               COUNTING(pass_7, pass_3)};
