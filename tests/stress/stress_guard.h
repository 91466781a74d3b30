/* SPDX-License-Identifier: MIT
 *
 * Memory between two pages that no one may touch, so that an access one byte outside ends the
 * program, whatever instruction made it. POSIX; elsewhere nothing can be made, and tests skip. */
#ifndef TESTS_STRESS_GUARD_H
#define TESTS_STRESS_GUARD_H

#include <stddef.h>

typedef struct stress_guard {
    unsigned char *first; /* of the accessible bytes */
    size_t size;          /* of them, whole pages */
    size_t page;
} stress_guard;

/* At least size accessible bytes; 0 where there is no such memory. */
int stress_guard_make(stress_guard *guard, size_t size);
void stress_guard_free(stress_guard *guard);

/* The address size bytes before the upper guard. */
void *stress_guard_top(const stress_guard *guard, size_t size);

/* Whether all bytes but the size ones at used have the value. */
int stress_guard_is_filled(const stress_guard *guard, const void *used, size_t size,
                           unsigned char value);

#endif
