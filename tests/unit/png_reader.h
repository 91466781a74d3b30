/* SPDX-License-Identifier: MIT
 *
 * A reader for the PNG files that the examples write, after the specifications and sharing nothing
 * with the writers. Left out: dynamic Huffman codes, palettes, interlacing. */
#ifndef TESTS_PNG_READER_H
#define TESTS_PNG_READER_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* ---- Inflating: stored blocks and fixed codes only ----------------------------------------- */

typedef struct reader {
    const uint8_t *bytes;
    size_t size, bit;
    int failed;
} reader;

static unsigned take_bit(reader *in) {
    if (in->bit / 8 >= in->size) {
        in->failed = 1;
        return 0;
    }
    const unsigned bit = (unsigned)in->bytes[in->bit / 8] >> (in->bit % 8) & 1u;
    ++in->bit;
    return bit;
}

static unsigned take_bits(reader *in, int count) {
    unsigned value = 0;
    for (int i = 0; i < count; ++i) value |= take_bit(in) << i;
    return value;
}

static unsigned take_code(reader *in, unsigned code, int count) {
    for (int i = 0; i < count; ++i) code = code << 1 | take_bit(in);
    return code;
}

/* RFC 1951, 3.2.6: 7 bits 0000000 .. 0010111 are 256 .. 279, 8 bits 00110000 .. 10111111 are
 * 0 .. 143, 8 bits 11000000 .. 11000111 are 280 .. 287, 9 bits from 110010000 are 144 .. 255. */
static unsigned take_symbol(reader *in) {
    unsigned code = take_code(in, 0, 7);
    if (code <= 0x17) return 256 + code;
    code = take_code(in, code, 1);
    if (code >= 0x30 && code <= 0xbf) return code - 0x30;
    if (code >= 0xc0 && code <= 0xc7) return 280 + code - 0xc0;
    code = take_code(in, code, 1);
    return 144 + code - 0x190;
}

static size_t inflate_fixed(reader *in, uint8_t *out, size_t capacity, size_t size) {
    /* The tables of 3.2.5, as printed there. */
    static const uint16_t lengths[29] = {3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                         15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                         67, 83, 99, 115, 131, 163, 195, 227, 258};
    static const uint8_t length_bits[29] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                            2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
    static const uint16_t distances[30] = {
        1,   2,   3,   4,   5,   7,    9,    13,   17,   25,   33,   49,   65,    97,    129,
        193, 257, 385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
    static const uint8_t distance_bits[30] = {0, 0, 0, 0, 1, 1, 2, 2,  3,  3,  4,  4,  5,  5,  6,
                                              6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13};
    for (;;) {
        const unsigned symbol = take_symbol(in);
        if (in->failed || symbol == 256) return size;
        if (symbol < 256) {
            if (size == capacity) break;
            out[size++] = (uint8_t)symbol;
            continue;
        }
        if (symbol > 285) break;
        const unsigned extra = take_bits(in, length_bits[symbol - 257]);
        const size_t length = lengths[symbol - 257] + extra;
        const unsigned code = take_code(in, 0, 5);
        if (code > 29) break;
        const size_t distance = distances[code] + take_bits(in, distance_bits[code]);
        /* 284 with 31 extra bits would be 258 once more, which the format forbids. */
        if (symbol == 284 && extra == 31) break;
        if (in->failed || distance > size || length > capacity - size) break;
        for (size_t i = 0; i < length; ++i, ++size) out[size] = out[size - distance];
    }
    in->failed = 1;
    return size;
}

static uint32_t big_endian(const uint8_t *bytes) {
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

/* The bytes of a zlib stream, which must number capacity; 0 if anything is amiss. */
static int inflate_zlib(const uint8_t *stream, size_t stream_size, uint8_t *out, size_t capacity) {
    reader in = {stream, stream_size, 16, 0};
    if (stream_size < 6 || (stream[0] * 256 + stream[1]) % 31 != 0 || stream[0] != 0x78) return 0;
    size_t size = 0;
    unsigned last = 0;
    while (last == 0 && !in.failed) {
        last = take_bit(&in);
        const unsigned kind = take_bits(&in, 2);
        if (kind == 1) {
            size = inflate_fixed(&in, out, capacity, size);
        } else if (kind == 0) {
            in.bit = (in.bit + 7) / 8 * 8;
            const unsigned length = take_bits(&in, 16), inverse = take_bits(&in, 16);
            if ((length ^ inverse) != 0xffff || length > capacity - size) return 0;
            for (unsigned i = 0; i < length; ++i) out[size++] = (uint8_t)take_bits(&in, 8);
        } else {
            return 0;
        }
    }
    uint64_t a = 1, b = 0; /* Adler-32 the slow way */
    for (size_t i = 0; i < size; ++i) {
        a = (a + out[i]) % 65521;
        b = (b + a) % 65521;
    }
    const size_t tail = (in.bit + 7) / 8;
    return !in.failed && size == capacity && tail + 4 == stream_size &&
           big_endian(stream + tail) == (b << 16 | a);
}

/* ---- Reading PNG --------------------------------------------------------------------------- */

/* CRC-32 as a division of polynomials, bits reflected, straight from its definition. */
static uint32_t crc_by_division(const uint8_t *bytes, size_t size) {
    uint32_t remainder = 0xffffffffu;
    for (size_t i = 0; i < size * 8; ++i) {
        const uint32_t top = (remainder ^ (uint32_t)(bytes[i / 8] >> (i % 8))) & 1u;
        remainder = remainder >> 1 ^ (top ? 0xedb88320u : 0u);
    }
    return ~remainder;
}

/* A chunk of the type at a place, with a correct CRC; returns its data and steps behind it. */
static const uint8_t *chunk_at(const uint8_t *file, size_t size, size_t *at, const char *type,
                               size_t *length) {
    if (size - *at < 12) return NULL;
    const uint8_t *head = file + *at;
    *length = big_endian(head);
    if (*length > size - *at - 12 || memcmp(head + 4, type, 4) != 0) return NULL;
    if (big_endian(head + 8 + *length) != crc_by_division(head + 4, *length + 4)) return NULL;
    *at += *length + 12;
    return head + 8;
}

/* Undoes the row filters in place (PNG specification, chapter 9). Counts which ones were used. */
static int unfilter(uint8_t *rows, size_t height, size_t row_size, size_t step, int used[5]) {
    for (size_t y = 0; y < height; ++y) {
        uint8_t *row = rows + y * (row_size + 1) + 1;
        const uint8_t *above = y > 0 ? row - (row_size + 1) : NULL;
        if (row[-1] > 4) return 0;
        ++used[row[-1]];
        for (size_t i = 0; i < row_size; ++i) {
            const int a = i >= step ? row[i - step] : 0, b = above != NULL ? above[i] : 0;
            const int c = i >= step && above != NULL ? above[i - step] : 0, p = a + b - c;
            int guess = 0;
            if (row[-1] == 1) guess = a;
            if (row[-1] == 2) guess = b;
            if (row[-1] == 3) guess = (a + b) >> 1;
            if (row[-1] == 4) {
                guess = abs(p - b) <= abs(p - c) ? b : c;
                if (abs(p - a) <= abs(p - b) && abs(p - a) <= abs(p - c)) guess = a;
            }
            row[i] = (uint8_t)(row[i] + guess);
        }
    }
    return 1;
}

#endif
