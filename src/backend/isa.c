/* SPDX-License-Identifier: MIT
 *
 * The choice of an instruction set. The compiler's own detector is asked, which also knows what the
 * operating system saves; it was filled before main and costs a load, where a cpuid instruction
 * costs microseconds on a virtual machine. No state of our own, so there is nothing to race for. */
#include "isa.h"

#include <spheretrace/trace.h>

#include "../base/compiler.h"

static int runs(spti_isa isa) {
    switch (isa) {
#ifdef SPTI_HAVE_SSSE3
    case SPTI_ssse3:
        return __builtin_cpu_supports("ssse3") != 0;
#endif
#ifdef SPTI_HAVE_AVX2
    case SPTI_avx2:
        return __builtin_cpu_supports("avx2") != 0;
#endif
#ifdef SPTI_HAVE_AVX512
    case SPTI_avx512:
        return __builtin_cpu_supports("avx512f") != 0;
#endif
    default:
        return 1; /* what the target itself demands */
    }
}

int spti_isa_lanes(spti_isa isa) {
    static const unsigned char lanes_of[] = {
#define X(name, lanes) lanes,
        SPTI_ISAS(X)
#undef X
    };
    return lanes_of[isa];
}

spti_isa spti_isa_choose(unsigned max_lanes) {
    for (int isa = SPTI_ISA_COUNT - 1; isa > 0; --isa) {
        const unsigned lanes = (unsigned)spti_isa_lanes((spti_isa)isa);
        if ((max_lanes == 0 || lanes <= max_lanes) && runs((spti_isa)isa)) return (spti_isa)isa;
    }
    return SPTI_scalar;
}

int spt_lanes(void) {
    return spti_isa_lanes(spti_isa_choose(0));
}
