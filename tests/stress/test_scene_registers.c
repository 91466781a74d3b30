/* SPDX-License-Identifier: MIT
 *
 * XGETBV with ecx = 1 tells which parts of the registers are in use. */
#include "test_scene_registers.h"

#include <stdint.h>

#if defined(__x86_64__) && defined(__GNUC__)
#include <cpuid.h>

int upper_halves_used(void) {
    uint32_t low, high;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(1));
    (void)high;
    return (low & 4u) != 0; /* bit 2: the upper halves */
}

void upper_halves_clean(void) {
    __asm__ volatile("vzeroupper" : : : "xmm0");
}

/* The processor has that form of XGETBV, and it tells used from clean. */
int upper_halves_are_visible(void) {
    unsigned a, b, c, d;
    if (!__get_cpuid_count(1, 0, &a, &b, &c, &d) || (c & (1u << 27)) == 0) return 0; /* OSXSAVE */
    if (!__get_cpuid_count(0xd, 1, &a, &b, &c, &d) || (a & 4u) == 0) return 0;
    if (!__builtin_cpu_supports("avx2")) return 0;
    __asm__ volatile("vpcmpeqd %%ymm0, %%ymm0, %%ymm0" : : : "xmm0");
    const int used = upper_halves_used();
    upper_halves_clean();
    return used && !upper_halves_used();
}
#else
int upper_halves_used(void) {
    return 0;
}

void upper_halves_clean(void) {
}

int upper_halves_are_visible(void) {
    return 0;
}
#endif
