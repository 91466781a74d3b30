/* SPDX-License-Identifier: MIT
 *
 * The few compiler extensions the library needs outside src/lanes, and the one thing it refuses. */
#ifndef SPTI_COMPILER_H
#define SPTI_COMPILER_H

/* Reassociation and "no NaN" would break the equal bits, the rounding floor and the NaN policy. */
#ifdef __FAST_MATH__
#error "libspheretrace must not be compiled with -ffast-math"
#endif

#if defined(__GNUC__)
#define SPTI_INLINE static inline __attribute__((always_inline))
#define SPTI_NOINLINE __attribute__((noinline))
#define SPTI_COLD __attribute__((cold, noinline)) /* runs rarely: small before fast */
#define SPTI_ALIGNED(bytes) __attribute__((aligned(bytes)))
#else
#define SPTI_INLINE static inline
#define SPTI_NOINLINE
#define SPTI_COLD
#define SPTI_ALIGNED(bytes)
#endif

/* The place of the lowest set bit of a number that is not zero. */
static inline unsigned spti_lowest_bit(unsigned bits) {
#if defined(__GNUC__)
    return (unsigned)__builtin_ctz(bits);
#else
    unsigned place = 0;
    for (; !(bits >> place & 1); ++place) {
    }
    return place;
#endif
}

/* Joins two or three words after expanding them, for the names of kernel instances. */
#define SPTI_JOIN2(a, b) SPTI_JOIN2_(a, b)
#define SPTI_JOIN2_(a, b) a##_##b
#define SPTI_TEXT(a) SPTI_TEXT_(a)
#define SPTI_TEXT_(a) #a

#endif
