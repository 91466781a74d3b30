/* SPDX-License-Identifier: MIT
 *
 * Writes a picture as binary PPM (P6): RGB bytes, rows from the top. */
#include "image.h"

#include <stdlib.h>

int image_write_ppm(FILE *file, const image *picture) {
    uint8_t *bytes = image_bytes(picture);
    if (bytes == NULL) return -1;
    const size_t count = (size_t)picture->width * (size_t)picture->height;
    fprintf(file, "P6\n%d %d\n255\n", picture->width, picture->height);
    if (picture->channels == 3) {
        fwrite(bytes, 3, count, file);
    } else {
        for (size_t i = 0; i < count; ++i) {
            const uint8_t grey[3] = {bytes[i], bytes[i], bytes[i]};
            fwrite(grey, 1, 3, file);
        }
    }
    free(bytes);
    return ferror(file) ? -1 : 0;
}
