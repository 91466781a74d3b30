/* SPDX-License-Identifier: MIT
 *
 * Guarded memory by mmap and mprotect. */
#if defined(__unix__) || defined(__APPLE__)
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#define HAVE_PAGES
#include <sys/mman.h>
#include <unistd.h>
#endif

#include "stress_guard.h"

#include <stdint.h>

int stress_guard_make(stress_guard *guard, size_t size) {
    guard->first = NULL;
    guard->size = guard->page = 0;
#ifdef HAVE_PAGES
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    const size_t inner = (size + page - 1) / page * page;
    void *map =
        mmap(NULL, inner + 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (map == MAP_FAILED) return 0;
    unsigned char *first = (unsigned char *)map + page;
    if (mprotect(map, page, PROT_NONE) != 0 || mprotect(first + inner, page, PROT_NONE) != 0) {
        munmap(map, inner + 2 * page);
        return 0;
    }
    guard->first = first;
    guard->size = inner;
    guard->page = page;
    return 1;
#else
    (void)size;
    return 0;
#endif
}

void stress_guard_free(stress_guard *guard) {
#ifdef HAVE_PAGES
    if (guard->first != NULL) munmap(guard->first - guard->page, guard->size + 2 * guard->page);
#endif
    guard->first = NULL;
}

void *stress_guard_top(const stress_guard *guard, size_t size) {
    return guard->first + guard->size - size;
}

int stress_guard_is_filled(const stress_guard *guard, const void *used, size_t size,
                           unsigned char value) {
    const size_t from = (size_t)((uintptr_t)used - (uintptr_t)guard->first);
    for (size_t i = 0; i < guard->size; ++i) {
        if (i == from) i += size;
        if (i < guard->size && guard->first[i] != value) return 0;
    }
    return 1;
}
