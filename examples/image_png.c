/* SPDX-License-Identifier: MIT
 *
 * Writes a picture as PNG of 8 bits a channel: row filters, then the zlib stream of
 * image_deflate.c. Left out: palettes, 16 bits, alpha, interlacing. */
#include "image.h"

#include <stdlib.h>
#include <string.h>

static void store_big_endian(uint8_t bytes[4], uint32_t value) {
    for (int i = 0; i < 4; ++i) bytes[i] = (uint8_t)(value >> (24 - 8 * i));
}

/* CRC-32 (PNG specification, annex D), bit by bit: a picture has few hundred thousand bytes. */
static uint32_t crc_of(uint32_t crc, const uint8_t *bytes, size_t size) {
    for (size_t i = 0; i < size; ++i) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (0xedb88320u & (0u - (crc & 1u)));
    }
    return crc;
}

static void write_chunk(FILE *file, const char *type, const uint8_t *data, size_t size) {
    uint8_t head[8], tail[4];
    store_big_endian(head, (uint32_t)size);
    memcpy(head + 4, type, 4);
    uint32_t crc = crc_of(0xffffffffu, head + 4, 4); /* over type and data, not the length */
    if (size != 0) crc = crc_of(crc, data, size);
    store_big_endian(tail, ~crc);
    fwrite(head, 1, sizeof head, file);
    if (size != 0) fwrite(data, 1, size, file);
    fwrite(tail, 1, sizeof tail, file);
}

/* The nearest of the three to left + up - corner (PNG specification, 9.4). */
static int paeth(int left, int up, int corner) {
    const int from_left = abs(up - corner), from_up = abs(left - corner);
    const int from_corner = abs(left + up - 2 * corner);
    if (from_left <= from_up && from_left <= from_corner) return left;
    return from_up <= from_corner ? up : corner;
}

/* One row through a filter: none, sub, up, average, Paeth. Returns the sum of the absolute signed
 * residuals, the usual estimate of how well the row will compress. */
static unsigned long filter_row(int filter, const uint8_t *row, const uint8_t *above, size_t size,
                                size_t step, uint8_t *out) {
    unsigned long sum = 0;
    for (size_t i = 0; i < size; ++i) {
        const int left = i >= step ? row[i - step] : 0, up = above[i];
        const int corner = i >= step ? above[i - step] : 0;
        const int guess[5] = {0, left, up, (left + up) / 2, paeth(left, up, corner)};
        out[i] = (uint8_t)(row[i] - guess[filter]);
        sum += (unsigned long)(out[i] < 128 ? out[i] : 256 - out[i]);
    }
    return sum;
}

/* All rows, each behind the number of the filter that suits it best. trial holds one row, as does
 * blank, which is zero and stands above the first one. */
static void filter_rows(const uint8_t *bytes, size_t height, size_t row_size, size_t step,
                        uint8_t *trial, const uint8_t *blank, uint8_t *filtered) {
    for (size_t y = 0; y < height; ++y) {
        const uint8_t *row = bytes + y * row_size, *above = y > 0 ? row - row_size : blank;
        uint8_t *out = filtered + y * (row_size + 1);
        unsigned long least = (unsigned long)-1;
        for (int filter = 0; filter < 5; ++filter) {
            const unsigned long sum = filter_row(filter, row, above, row_size, step, trial);
            if (sum >= least) continue;
            least = sum;
            out[0] = (uint8_t)filter;
            memcpy(out + 1, trial, row_size);
        }
    }
}

int image_write_png(FILE *file, const image *picture) {
    static const uint8_t signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    const size_t height = (size_t)picture->height, step = (size_t)picture->channels;
    const size_t row_size = (size_t)picture->width * step, filtered_size = height * (row_size + 1);
    uint8_t *bytes = image_bytes(picture), *filtered = malloc(filtered_size);
    uint8_t *rows = calloc(2, row_size), *stream = NULL;
    size_t stream_size = 0;
    if (bytes != NULL && filtered != NULL && rows != NULL) {
        filter_rows(bytes, height, row_size, step, rows, rows + row_size, filtered);
        stream = image_deflate(filtered, filtered_size, &stream_size);
    }
    free(bytes);
    free(filtered);
    free(rows);
    if (stream == NULL) return -1;

    uint8_t header[13] = {0};
    store_big_endian(header, (uint32_t)picture->width);
    store_big_endian(header + 4, (uint32_t)picture->height);
    header[8] = 8;                                         /* bits a channel */
    header[9] = (uint8_t)(picture->channels == 3 ? 2 : 0); /* colour type: RGB or grey */
    fwrite(signature, 1, sizeof signature, file);
    write_chunk(file, "IHDR", header, sizeof header);
    write_chunk(file, "IDAT", stream, stream_size);
    write_chunk(file, "IEND", NULL, 0);
    free(stream);
    return ferror(file) ? -1 : 0;
}
