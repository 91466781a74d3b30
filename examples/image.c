/* SPDX-License-Identifier: MIT
 *
 * Pictures in memory, the sRGB curve, and the choice of a writer by the ending of the path. */
#define _POSIX_C_SOURCE 200809L /* strcasecmp, and errno from fopen */
#include "image.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

image image_create(int width, int height, int channels) {
    image result = {width, height, channels, NULL};
    if (width >= 1 && height >= 1 && width <= image_largest_side && height <= image_largest_side) {
        const size_t count = (size_t)width * (size_t)height;
        result.pixels = calloc(count, (size_t)channels * sizeof(float));
    }
    return result;
}

void image_free(image *picture) {
    free(picture->pixels);
    picture->pixels = NULL;
}

uint8_t image_srgb_byte(float linear) {
    if (!(linear > 0.0f)) return 0; /* and NaN */
    if (linear >= 1.0f) return 255;
    const float curve =
        linear <= 0.0031308f ? 12.92f * linear : 1.055f * powf(linear, 1.0f / 2.4f) - 0.055f;
    return (uint8_t)(255.0f * curve + 0.5f);
}

float image_linear(float srgb) {
    if (!(srgb > 0.0f)) return 0.0f;
    if (srgb >= 1.0f) return 1.0f;
    return srgb <= 0.04045f ? srgb / 12.92f : powf((srgb + 0.055f) / 1.055f, 2.4f);
}

uint8_t *image_bytes(const image *picture) {
    const size_t count =
        (size_t)picture->width * (size_t)picture->height * (size_t)picture->channels;
    uint8_t *bytes = malloc(count);
    if (bytes == NULL) return NULL;
    for (size_t i = 0; i < count; ++i) bytes[i] = image_srgb_byte(picture->pixels[i]);
    return bytes;
}

typedef int image_write_fn(FILE *file, const image *picture);

static const struct {
    const char *ending;
    image_write_fn *write;
    int is_float;
} formats[] = {
    {".png", image_write_png, 0},
    {".ppm", image_write_ppm, 0},
    {".pfm", image_write_pfm, 1},
};
enum { format_count = sizeof formats / sizeof formats[0] };

/* The index of the format, or format_count: not one of ours. */
static size_t format_of(const char *path) {
    const char *dot = strrchr(path, '.');
    size_t index = 0;
    while (dot != NULL && index < format_count && strcasecmp(dot, formats[index].ending) != 0) {
        ++index;
    }
    return dot != NULL ? index : format_count;
}

int image_is_known(const char *path) {
#ifdef SPT_EXAMPLES_OIIO
    return strrchr(path, '.') != NULL;
#else
    return format_of(path) != format_count;
#endif
}

int image_is_float(const char *path) {
    const size_t format = format_of(path);
#ifdef SPT_EXAMPLES_OIIO
    const char *dot = strrchr(path, '.');
    if (dot != NULL && strcasecmp(dot, ".exr") == 0) return 1;
#endif
    return format != format_count ? formats[format].is_float : 0;
}

int image_can_write(const char *path) {
    FILE *there = fopen(path, "rb");
    if (there != NULL) fclose(there);
    FILE *file = fopen(path, "ab");
    if (file == NULL) return 0;
    fclose(file);
    if (there == NULL) remove(path);
    return 1;
}

int image_write(const char *path, const image *picture) {
    const size_t format = format_of(path);
#ifdef SPT_EXAMPLES_OIIO
    if (format == format_count) {
        const int failed = image_write_oiio(path, picture);
        errno = 0; /* it has said why */
        return failed ? -1 : 0;
    }
#endif
    errno = 0;
    if (format == format_count) return -1;
    FILE *file = fopen(path, "wb");
    if (file == NULL) return -1;
    int result = formats[format].write(file, picture);
    if (fclose(file) != 0) result = -1; /* a full disk may show only here */
    return result;
}
