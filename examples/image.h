/* SPDX-License-Identifier: MIT
 *
 * Pictures of the examples: floats in memory, written as PNG, PPM or PFM by own code, and as
 * whatever OpenImageIO knows where the build found it. Left out: reading. */
#ifndef EXAMPLES_IMAGE_H
#define EXAMPLES_IMAGE_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Linear light, row by row from the top. Float formats store it as it is, formats of 8 bits put it
 * through the sRGB curve, once. */
typedef struct image {
    int width, height;
    int channels; /* 1 (grey) or 3 (red, green, blue) */
    float *pixels;
} image;

enum { image_largest_side = 32767 };

/* A black picture, sides from 1 to image_largest_side; pixels is NULL where memory ran out. */
image image_create(int width, int height, int channels);
void image_free(image *picture);

/* The three floats (or the one) of a pixel. */
static inline float *image_at(const image *picture, int x, int y) {
    return picture->pixels +
           ((size_t)y * (size_t)picture->width + (size_t)x) * (size_t)picture->channels;
}

/* The sRGB curve (IEC 61966-2-1), both ways; values are cut to [0, 1], NaN counts as 0. */
uint8_t image_srgb_byte(float linear);
float image_linear(float srgb);

/* All pixels as bytes, through the curve; from malloc, or NULL. */
uint8_t *image_bytes(const image *picture);

/* ---- Files --------------------------------------------------------------------------------- */

/* Whether the ending of a path names a format that can be written. */
int image_is_known(const char *path);

/* Whether the format stores floats, so that numbers may be written instead of colours. */
int image_is_float(const char *path);

/* Whether the file can be created; one that was not there before is not there afterwards. */
int image_can_write(const char *path);

/* Writes the picture in the format of the ending (.png .ppm .pfm and, with OpenImageIO, others).
 * Returns 0, or -1 with errno set where the system gave a reason. */
int image_write(const char *path, const image *picture);

/* One format each, to a file opened for binary output; 0 or -1. Small and complete, to be copied. */
int image_write_png(FILE *file, const image *picture);
int image_write_ppm(FILE *file, const image *picture);
int image_write_pfm(FILE *file, const image *picture);

/* A zlib stream (RFC 1950, 1951: one block of LZ77 and fixed Huffman codes) of at most 2^30 bytes;
 * from malloc, or NULL. */
uint8_t *image_deflate(const uint8_t *data, size_t size, size_t *stream_size);

/* In image_oiio.cc, only with OpenImageIO. Returns 0, or 1 after a message on standard error. */
int image_write_oiio(const char *path, const image *picture);

#ifdef __cplusplus
}
#endif
#endif
