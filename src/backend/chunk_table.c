/* SPDX-License-Identifier: MIT
 *
 * The chunk kernels by instruction set. They take whole groups at any width, with the same bits, so
 * that not every set needs its own: SSE2 prepares for one lane, too, since it runs wherever it is
 * built; and without the byte shuffle of SSSE3 gaps are closed faster one lane at a time. */
#include "../trace/chunk.h"
#include "isa.h"

spti_prepare_fn spti_prepare_scalar, spti_prepare_sse2, spti_prepare_avx2, spti_prepare_avx512;
spti_compact_fn spti_compact_scalar, spti_compact_ssse3, spti_compact_avx2, spti_compact_avx512;

const spti_chunk_kernels spti_chunk_kernels_of[SPTI_ISA_COUNT] = {
#ifdef SPTI_HAVE_SSE2
    [SPTI_scalar] = {spti_prepare_sse2, spti_compact_scalar},
    [SPTI_sse2] = {spti_prepare_sse2, spti_compact_scalar},
#else
    [SPTI_scalar] = {spti_prepare_scalar, spti_compact_scalar},
#endif
#ifdef SPTI_HAVE_SSSE3
    [SPTI_ssse3] = {spti_prepare_sse2, spti_compact_ssse3},
#endif
#ifdef SPTI_HAVE_AVX2
    [SPTI_avx2] = {spti_prepare_avx2, spti_compact_avx2},
#endif
#ifdef SPTI_HAVE_AVX512
    [SPTI_avx512] = {spti_prepare_avx512, spti_compact_avx512},
#endif
};
