/* SPDX-License-Identifier: MIT
 *
 * THE LIST of instruction sets that kernels are built for, narrowest first, and the choice among
 * them at run time. The Makefile defines SPTI_HAVE_* for those the compiler can build. */
#ifndef SPTI_ISA_H
#define SPTI_ISA_H

/* X(name, lanes) */
#define SPTI_ISA_SCALAR(X) X(scalar, 1)
#ifdef SPTI_HAVE_SSE2
#define SPTI_ISA_SSE2(X) X(sse2, 4)
#else
#define SPTI_ISA_SSE2(X)
#endif
#ifdef SPTI_HAVE_SSSE3
#define SPTI_ISA_SSSE3(X) X(ssse3, 4)
#else
#define SPTI_ISA_SSSE3(X)
#endif
#ifdef SPTI_HAVE_AVX2
#define SPTI_ISA_AVX2(X) X(avx2, 8)
#else
#define SPTI_ISA_AVX2(X)
#endif
#ifdef SPTI_HAVE_AVX512
#define SPTI_ISA_AVX512(X) X(avx512, 16)
#else
#define SPTI_ISA_AVX512(X)
#endif
#define SPTI_ISAS(X) \
    SPTI_ISA_SCALAR(X) SPTI_ISA_SSE2(X) SPTI_ISA_SSSE3(X) SPTI_ISA_AVX2(X) SPTI_ISA_AVX512(X)

typedef enum spti_isa {
#define X(name, lanes) SPTI_##name,
    SPTI_ISAS(X)
#undef X
        SPTI_ISA_COUNT
} spti_isa;

/* The best that this machine and its operating system run, of at most max_lanes lanes (0: any). */
spti_isa spti_isa_choose(unsigned max_lanes);

/* Its lanes. */
int spti_isa_lanes(spti_isa isa);

#endif
