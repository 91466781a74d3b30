/* SPDX-License-Identifier: MIT
 *
 * Writes a picture as PFM: floats, rows from the BOTTOM, infinity kept. Best for depth and for
 * pictures that a program compares. */
#include "image.h"

#include <string.h>

int image_write_pfm(FILE *file, const image *picture) {
    const int row = picture->width * picture->channels;
    /* A negative scale says little endian. */
    fprintf(file, "%s\n%d %d\n-1.0\n", picture->channels == 3 ? "PF" : "Pf", picture->width,
            picture->height);
    for (int y = picture->height - 1; y >= 0; --y) {
        const float *pixels = image_at(picture, 0, y);
        for (int i = 0; i < row; ++i) {
            uint32_t bits;
            memcpy(&bits, &pixels[i], sizeof bits);
            const uint8_t bytes[4] = {(uint8_t)bits, (uint8_t)(bits >> 8), (uint8_t)(bits >> 16),
                                      (uint8_t)(bits >> 24)};
            fwrite(bytes, 1, sizeof bytes, file);
        }
    }
    return ferror(file) ? -1 : 0;
}
