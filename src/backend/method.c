/* SPDX-License-Identifier: MIT
 *
 * The object of one step rule. The Makefile compiles this file once for every rule, with
 * SPTI_METHOD (its name), SPTI_RULE and SPTI_RULE_GLSL (its headers) defined. An object of its own, so that a static
 * link carries only the rules a program names. */
#define SPT_LANES 1
#include SPTI_RULE
#include SPTI_RULE_GLSL

#include "../trace/method.h"

/* The byte shuffle of SSSE3 helps the compaction only: the march kernels of SSE2 serve both. */
#define KERNELS(isa) SPTI_JOIN2(SPTI_JOIN2(spti_march, SPTI_METHOD), isa)
#define DECLARE(isa) extern spti_march_fn *const KERNELS(isa)[SPTI_WANTS];
DECLARE(scalar)
#ifdef SPTI_HAVE_SSE2
DECLARE(sse2)
#endif
#ifdef SPTI_HAVE_AVX2
DECLARE(avx2)
#endif
#ifdef SPTI_HAVE_AVX512
DECLARE(avx512)
#endif

const spt_method *SPTI_JOIN2(spt, SPTI_METHOD)(void) {
    static const spt_method method = {SPTI_TEXT(SPTI_METHOD),
                                      rule_probes,
                                      rule_pending,
                                      rule_memory,
                                      rule_blends,
                                      rule_needs_convex,
                                      &rule_glsl,
                                      {
                                          KERNELS(scalar),
#ifdef SPTI_HAVE_SSE2
                                          KERNELS(sse2),
#endif
#ifdef SPTI_HAVE_SSSE3
                                          KERNELS(sse2),
#endif
#ifdef SPTI_HAVE_AVX2
                                          KERNELS(avx2),
#endif
#ifdef SPTI_HAVE_AVX512
                                          KERNELS(avx512),
#endif
                                      }};
    return &method;
}
