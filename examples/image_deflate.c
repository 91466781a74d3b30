/* SPDX-License-Identifier: MIT
 *
 * A zlib stream in one block of fixed Huffman codes (RFC 1950 and 1951). Left out: codes fitted to
 * the data, which would save about a fifth on rendered pictures. */
#include "image.h"

#include <stdlib.h>

enum {
    window = 32768,    /* how far back a match may lie; a power of two */
    hash_size = 32768, /* of three bytes */
    chain_tries = 32,  /* earlier places looked at */
    shortest_match = 3,
    longest_match = 258,
    distant = 4096, /* a match of three bytes from further back costs more than the bytes */
    largest_adler_run = 5552 /* bytes until the sums of Adler-32 might overflow 32 bits */
};

typedef struct bit_writer {
    uint8_t *bytes;
    size_t size;
    uint32_t bits; /* not yet written, the first one lowest */
    int count;
} bit_writer;

static void put_bits(bit_writer *writer, uint32_t value, int count) {
    writer->bits |= value << writer->count; /* count <= 13 and fewer than 8 are waiting */
    writer->count += count;
    while (writer->count >= 8) {
        writer->bytes[writer->size++] = (uint8_t)writer->bits;
        writer->bits >>= 8;
        writer->count -= 8;
    }
}

/* Huffman codes go in highest bit first, everything else lowest bit first (RFC 1951, 3.1.1). */
static void put_code(bit_writer *writer, uint32_t code, int count) {
    uint32_t reversed = 0;
    for (int i = 0; i < count; ++i) reversed |= ((code >> i) & 1u) << (count - 1 - i);
    put_bits(writer, reversed, count);
}

/* The fixed code of a literal or length symbol (RFC 1951, 3.2.6). */
static void put_symbol(bit_writer *writer, uint32_t symbol) {
    if (symbol < 144) {
        put_code(writer, 0x30 + symbol, 8);
    } else if (symbol < 256) {
        put_code(writer, 0x190 + symbol - 144, 9);
    } else if (symbol < 280) {
        put_code(writer, symbol - 256, 7);
    } else {
        put_code(writer, 0xc0 + symbol - 280, 8);
    }
}

/* RFC 1951, 3.2.5: lengths and distances come in ranges of 2^k values, some k bits behind the
 * symbol; four ranges (two for distances) share one k. Length 258 has a symbol of its own. */
static void put_match(bit_writer *writer, uint32_t length, uint32_t distance) {
    int extra = 0;
    if (length == longest_match) {
        put_symbol(writer, 285);
    } else {
        const uint32_t value = length - shortest_match;
        while (value >> (extra + 3) != 0) ++extra;
        const uint32_t base = extra == 0 ? value : 4u * (uint32_t)extra + (value >> extra);
        put_symbol(writer, 257 + base);
        put_bits(writer, value & ((1u << extra) - 1u), extra);
    }
    const uint32_t value = distance - 1;
    extra = 0;
    while (value >> (extra + 2) != 0) ++extra;
    const uint32_t base = extra == 0 ? value : 2u * (uint32_t)extra + (value >> extra);
    put_code(writer, base, 5);
    put_bits(writer, value & ((1u << extra) - 1u), extra);
}

/* Earlier places with the same hash: the newest in head, each one's predecessor in previous. */
typedef struct match_finder {
    int32_t head[hash_size], previous[window];
} match_finder;

static uint32_t hash_of(const uint8_t *three) {
    const uint32_t value = (uint32_t)three[0] | (uint32_t)three[1] << 8 | (uint32_t)three[2] << 16;
    return (value * 0x9e3779b1u) >> 17;
}

static void remember(match_finder *finder, const uint8_t *data, size_t size, size_t at) {
    if (size - at < shortest_match) return;
    const uint32_t hash = hash_of(data + at);
    finder->previous[at % window] = finder->head[hash];
    finder->head[hash] = (int32_t)at;
}

/* The longest match for what stands at a place, 0 for none. */
static size_t find_match(const match_finder *finder, const uint8_t *data, size_t size, size_t at,
                         size_t *distance) {
    size_t best = 0;
    if (size - at < shortest_match) return 0;
    const size_t limit = size - at < longest_match ? size - at : longest_match;
    int32_t place = finder->head[hash_of(data + at)];
    for (int tries = 0; tries < chain_tries && place >= 0 && at - (size_t)place <= window;
         ++tries) {
        const uint8_t *old = data + place;
        size_t length = 0;
        while (length < limit && old[length] == data[at + length]) ++length;
        if (length > best) {
            best = length;
            *distance = at - (size_t)place;
            if (best == limit) break;
        }
        /* Not yet overwritten, since the place lies within the window; so it leads back, too. */
        place = finder->previous[(size_t)place % window];
    }
    return best < shortest_match || (best == shortest_match && *distance > distant) ? 0 : best;
}

static uint32_t adler_of(const uint8_t *data, size_t size) {
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < size;) {
        const size_t end = size - i < largest_adler_run ? size : i + largest_adler_run;
        for (; i < end; ++i) {
            a += data[i];
            b += a;
        }
        a %= 65521;
        b %= 65521;
    }
    return b << 16 | a;
}

uint8_t *image_deflate(const uint8_t *data, size_t size, size_t *stream_size) {
    if (size > (size_t)1 << 30) return NULL;
    /* No byte takes more than 9 bits: a literal at most 9, a match of three bytes at most
     * 7 + 5 + 11, a longer one at most 31. Then the header, 3 + 7 bits around the block, 4 bytes. */
    bit_writer writer = {malloc(size + size / 8 + 16), 0, 0, 0};
    match_finder *finder = malloc(sizeof *finder);
    if (writer.bytes == NULL || finder == NULL) {
        free(writer.bytes);
        free(finder);
        return NULL;
    }
    for (size_t i = 0; i < hash_size; ++i) finder->head[i] = -1;
    put_bits(&writer, 0x78, 8); /* deflate, window 32768 */
    put_bits(&writer, 0x01, 8); /* makes the pair a multiple of 31 */
    put_bits(&writer, 1, 1);    /* last block */
    put_bits(&writer, 1, 2);    /* fixed codes */
    for (size_t at = 0; at < size;) {
        size_t distance = 0;
        const size_t match = find_match(finder, data, size, at, &distance);
        if (match == 0) {
            put_symbol(&writer, data[at]);
        } else {
            put_match(&writer, (uint32_t)match, (uint32_t)distance);
        }
        const size_t end = at + (match == 0 ? 1 : match);
        for (; at < end; ++at) remember(finder, data, size, at);
    }
    put_symbol(&writer, 256);
    if (writer.count > 0) put_bits(&writer, 0, 8 - writer.count);
    const uint32_t adler = adler_of(data, size);
    for (int shift = 24; shift >= 0; shift -= 8) put_bits(&writer, (adler >> shift) & 255u, 8);
    free(finder);
    *stream_size = writer.size;
    return writer.bytes;
}
