/* SPDX-License-Identifier: MIT
 *
 * The upper halves of the vector registers, as callbacks find them (row G10), and whether stack
 * frames have their own size in this build (row G7). */
#ifndef TESTS_SCENE_REGISTERS_H
#define TESTS_SCENE_REGISTERS_H

/* Whether their state can be read here; leaves them clean. */
int upper_halves_are_visible(void);

/* Whether some upper half is not in its initial state; only where that is visible. */
int upper_halves_used(void);

/* Cleans them. */
void upper_halves_clean(void);

/* Sanitizers move locals out of the stack or widen frames, and without optimisation they are not
 * shared. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
#define FRAMES_ARE_WIDENED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || \
    __has_feature(thread_sanitizer)
#define FRAMES_ARE_WIDENED
#endif
#endif

#endif
