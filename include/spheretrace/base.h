/* SPDX-License-Identifier: MIT
 *
 * What every other header stands on: how symbols are exported, the version, the status a call
 * returns and the strided views through which arrays are read and written.
 * Nothing about rays, fields or surfaces: see field.h and trace.h. */
#ifndef SPHERETRACE_BASE_H
#define SPHERETRACE_BASE_H

#include <stddef.h>
#include <stdint.h>

/* The version, written here only; the build reads it from these lines. A change of MAJOR may break
 * callers, MINOR adds to the interface, PATCH mends. */
#define SPT_VERSION_MAJOR 0
#define SPT_VERSION_MINOR 1
#define SPT_VERSION_PATCH 0

/* Linkage of the public functions. A program that links the static library defines nothing. On
 * Windows a user of the DLL defines SPT_SHARED (and the build of the DLL also SPT_BUILD). May be
 * defined by the including program instead. */
#ifndef SPT_API
#if defined(_WIN32) && defined(SPT_SHARED)
#ifdef SPT_BUILD
#define SPT_API __declspec(dllexport)
#else
#define SPT_API __declspec(dllimport)
#endif
#elif defined(__GNUC__) && __GNUC__ >= 4
#define SPT_API __attribute__((visibility("default")))
#else
#define SPT_API
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* What a call says of its ARGUMENTS. What a ray meets is never a status but data in its hit.
 * With any status but SPT_OK nothing was written and no callback was called; only a clock that
 * stands still is found out by calling it, and the field; and that a bound is empty, by asking
 * it. */
typedef enum spt_status {
    SPT_OK = 0,
    SPT_BAD_ARGUMENT,     /* an argument outside its documented range */
    SPT_BUFFER_TOO_SMALL, /* the caller's memory does not hold the result */
    SPT_UNSUPPORTED       /* legal, but not possible here (a clock that stands still, say) */
} spt_status;

/* The enumerator's name, "SPT_OK" and so on; "unknown status" for any other value. Never NULL. */
SPT_API const char *spt_status_name(spt_status status);

/* MAJOR * 10000 + MINOR * 100 + PATCH of the library that was linked, to compare with the macros
 * of the header that was compiled. */
SPT_API int spt_version(void);

/* A column of values that the library reads: value i starts at (char *)first + i * stride. So an
 * array of structures (stride = size of the structure) and a plain array (stride = 4) are both
 * read where they lie. stride 0 means one value for all; it may be negative. first NULL means the
 * column is absent and its documented default holds. Values need no alignment. */
typedef struct spt_column {
    const void *first;
    ptrdiff_t stride; /* bytes */
} spt_column;

/* The same for values that the library writes. first NULL means: not wanted, and the work that
 * only this result needs is left out of the loop. stride must not be 0 where count > 1. */
typedef struct spt_sink {
    void *first;
    ptrdiff_t stride; /* bytes */
} spt_sink;

#ifdef __cplusplus
}
#endif
#endif
