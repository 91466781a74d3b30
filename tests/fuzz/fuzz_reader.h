/* SPDX-License-Identifier: MIT
 *
 * Numbers out of the bytes of a fuzzer, which never end: behind the last all are 0. */
#ifndef FUZZ_READER_H
#define FUZZ_READER_H

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>

typedef struct reader {
    const uint8_t *data;
    size_t size, at;
    int hostile;
} reader;

static inline uint32_t read_byte(reader *from) {
    return from->at < from->size ? from->data[from->at++] : 0;
}

/* Some bytes for another reader. */
static inline reader read_slice(reader *from, size_t bytes) {
    reader slice = {from->data + from->at, from->size - from->at, 0, from->hostile};
    if (slice.size > bytes) slice.size = bytes;
    from->at += slice.size;
    return slice;
}

static inline float read_special(reader *from) {
    static const float list[] = {0.0f,     -0.0f,   INFINITY, -INFINITY, NAN,   FLT_MAX,
                                 -FLT_MAX, FLT_MIN, 1e-42f,   1e-45f,    1e20f, -1e30f,
                                 1e18f,    -1.0f,   1e-30f,   1.0f};
    return list[read_byte(from) & 15u];
}

static inline float read_number(reader *from, float low, float high) {
    if (from->hostile && (read_byte(from) & 7u) == 0) return read_special(from);
    const uint32_t word = read_byte(from) << 8 | read_byte(from);
    return low + (high - low) * ((float)word / 65536.0f);
}

#endif
