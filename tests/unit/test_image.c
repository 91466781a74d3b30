/* SPDX-License-Identifier: MIT
 *
 * The image writers of the examples: independent readers must give back the pixels. Also the sRGB
 * curve and the palette of the heat maps. Left out: OpenImageIO, which is not ours. */
#include "../../examples/heat.h"
#include "../../examples/image.h"
#include "../check.h"
#include "png_reader.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint8_t *file_contents(FILE *file, size_t *size) {
    if (fseek(file, 0, SEEK_END) != 0) return NULL;
    const long end = ftell(file);
    if (end < 0 || fseek(file, 0, SEEK_SET) != 0) return NULL;
    uint8_t *bytes = malloc((size_t)end + 1);
    *size = bytes != NULL ? fread(bytes, 1, (size_t)end, file) : 0;
    if (bytes != NULL) bytes[*size] = 0;
    return bytes;
}

/* What a writer puts into a file, or NULL. */
static uint8_t *written(int (*write)(FILE *, const image *), const image *picture, size_t *size) {
    FILE *file = tmpfile();
    if (file == NULL) return NULL;
    uint8_t *bytes = write(file, picture) == 0 ? file_contents(file, size) : NULL;
    fclose(file);
    return bytes;
}

/* Writes the picture as PNG, reads it back and compares every byte. Returns the file's size. */
static size_t check_png(const image *picture, int used[5]) {
    const size_t height = (size_t)picture->height, step = (size_t)picture->channels;
    const size_t row_size = (size_t)picture->width * step, rows_size = height * (row_size + 1);
    static const uint8_t signature[8] = {137, 80, 78, 71, 13, 10, 26, 10};
    size_t size = 0, at = 8, length = 0;
    uint8_t *file = written(image_write_png, picture, &size), *rows = malloc(rows_size);
    CHECK(file != NULL && rows != NULL && size > 8);
    if (file == NULL || rows == NULL || size <= 8) return 0;
    CHECK(memcmp(file, signature, 8) == 0);
    const uint8_t *header = chunk_at(file, size, &at, "IHDR", &length);
    CHECK(header != NULL && length == 13);
    if (header != NULL) {
        CHECK(big_endian(header) == (uint32_t)picture->width);
        CHECK(big_endian(header + 4) == (uint32_t)picture->height);
        CHECK(header[8] == 8 && header[9] == (step == 3 ? 2 : 0));
        CHECK(header[10] == 0 && header[11] == 0 && header[12] == 0);
    }
    const uint8_t *data = chunk_at(file, size, &at, "IDAT", &length);
    const int inflated = data != NULL && inflate_zlib(data, length, rows, rows_size);
    CHECK(chunk_at(file, size, &at, "IEND", &length) != NULL && length == 0 && at == size);
    const int readable = inflated && unfilter(rows, height, row_size, step, used);
    CHECK(readable);
    if (readable) {
        size_t wrong = 0;
        for (size_t y = 0; y < height; ++y) {
            for (size_t i = 0; i < row_size; ++i) {
                const float value = picture->pixels[y * row_size + i];
                wrong += rows[y * (row_size + 1) + 1 + i] != image_srgb_byte(value);
            }
        }
        CHECK_SAY(wrong == 0, "%zu bytes differ", wrong);
    }
    free(file);
    free(rows);
    return size;
}

/* ---- Pictures ------------------------------------------------------------------------------ */

/* Bands in which each filter has its turn: flat, ramps along x and y, a slope, noise. */
static image test_picture(int width, int height, int channels) {
    image picture = image_create(width, height, channels);
    for (int y = 0; picture.pixels != NULL && y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < channels; ++c) {
                const int band = y * 6 / height;
                float value = 0.25f * (float)(c + 1);
                if (band == 1) value = image_linear((float)(x * 3 % 256) / 255.0f);
                if (band == 2) value = image_linear((float)((y * 7 + x * x * 5) % 256) / 255.0f);
                if (band == 3) value = image_linear((float)((x + y) / 3 % 256) / 255.0f);
                if (band == 4) value = (float)check_uniform(-0.1, 1.1);
                if (band == 5) value = (float)(x * x + y * y) / (float)(2 * width * width);
                image_at(&picture, x, y)[c] = value;
            }
        }
    }
    return picture;
}

static void image_png_comes_back(void) {
    static const int sizes[][2] = {{257, 131}, {1, 1}, {1, 300}, {300, 1}, {2, 3}, {640, 97}};
    int used[5] = {0};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; ++i) {
        for (int channels = 1; channels <= 3; channels += 2) {
            check_context("%dx%d, %d channels", sizes[i][0], sizes[i][1], channels);
            image picture = test_picture(sizes[i][0], sizes[i][1], channels);
            check_png(&picture, used);
            image_free(&picture);
        }
    }
    for (int filter = 0; filter < 5; ++filter) CHECK_SAY(used[filter] > 0, "filter %d", filter);
}

static void image_png_is_compressed(void) {
    int used[5] = {0};
    image picture = image_create(640, 400, 3);
    for (int y = 0; y < 400; ++y) {
        for (int x = 0; x < 640; ++x) {
            const int disc = (x - 320) * (x - 320) + (y - 200) * (y - 200) < 150 * 150;
            for (int c = 0; c < 3; ++c) {
                image_at(&picture, x, y)[c] = disc ? (float)(x + c) / 700.0f : (float)y / 500.0f;
            }
        }
    }
    /* 770 kB stored; smooth shading must fall well below a tenth. */
    const size_t size = check_png(&picture, used);
    CHECK_SAY(size != 0 && size < 77000, "%zu bytes", size);
    image_free(&picture);
}

static void check_deflate(const uint8_t *data, size_t size) {
    size_t stream_size = 0;
    uint8_t *stream = image_deflate(data, size, &stream_size), *back = malloc(size + 1);
    CHECK(stream != NULL && back != NULL);
    if (stream != NULL && back != NULL) {
        CHECK(inflate_zlib(stream, stream_size, back, size));
        CHECK(memcmp(back, data, size) == 0);
        CHECK_SAY(stream_size <= size + size / 8 + 16, "%zu of %zu", stream_size, size);
    }
    free(stream);
    free(back);
}

static void image_deflate_comes_back(void) {
    enum { most = 200000 };
    uint8_t *data = malloc(most);
    CHECK(data != NULL);
    if (data == NULL) return;
    memset(data, 7, most);
    for (size_t size = 0; size < 600; ++size) { /* every length of match, 258 and 259 above all */
        check_context("run of %zu", size);
        check_deflate(data, size);
    }
    check_context("long run");
    check_deflate(data, most);
    for (size_t i = 0; i < most; ++i) data[i] = (uint8_t)(144 + check_random() % 112);
    check_context("noise of 9-bit literals");
    check_deflate(data, most);
    /* Every range of distances, its ends, and repeats just within and just beyond the window. */
    for (size_t distance = 1; distance <= 32770;
         distance += distance < 300 || distance >= 32766 ? 1 : distance / 3) {
        const size_t length = 3 + check_random() % 300;
        if (distance > 32766 - distance / 3 && distance < 32766) distance = 32766;
        for (size_t i = 0; i < distance; ++i) data[i] = (uint8_t)check_random();
        for (size_t i = 0; i < length; ++i) data[distance + i] = data[i];
        check_context("distance %zu", distance);
        check_deflate(data, distance + length);
    }
    for (size_t i = 0; i < most; ++i) data[i] = (uint8_t)(check_random() % 3);
    check_context("crowded hash chains");
    check_deflate(data, most);
    free(data);
}

/* A negative control: the reader must notice a flipped bit anywhere. */
static void image_reader_notices_damage(void) {
    uint8_t data[400], back[400];
    for (size_t i = 0; i < sizeof data; ++i) data[i] = (uint8_t)(check_random() % 20);
    size_t size = 0;
    uint8_t *stream = image_deflate(data, sizeof data, &size);
    CHECK(stream != NULL && inflate_zlib(stream, size, back, sizeof back));
    for (size_t bit = 0; stream != NULL && bit < size * 8; ++bit) {
        stream[bit / 8] ^= (uint8_t)(1u << (bit % 8));
        const int padding = bit / 8 == size - 5; /* the bits behind the block mean nothing */
        const int accepted = inflate_zlib(stream, size, back, sizeof back);
        CHECK_SAY(!accepted || (padding && memcmp(back, data, sizeof data) == 0), "bit %zu", bit);
        stream[bit / 8] ^= (uint8_t)(1u << (bit % 8));
    }
    free(stream);
}

static void image_pfm_comes_back(void) {
    for (int channels = 1; channels <= 3; channels += 2) {
        image picture = test_picture(257, 131, channels);
        image_at(&picture, 5, 9)[0] = (float)INFINITY;
        image_at(&picture, 6, 9)[0] = -0.0f;
        char header[40];
        const int header_size =
            snprintf(header, sizeof header, "%s\n257 131\n-1.0\n", channels == 3 ? "PF" : "Pf");
        size_t size = 0, wrong = 0;
        uint8_t *file = written(image_write_pfm, &picture, &size);
        const size_t row = 257 * (size_t)channels;
        const int whole = file != NULL && size == (size_t)header_size + 131 * row * 4;
        CHECK(whole);
        if (whole) {
            CHECK(memcmp(file, header, (size_t)header_size) == 0);
            for (size_t i = 0; i < 131 * row; ++i) { /* rows stand from the bottom */
                const uint8_t *b = file + header_size + 4 * i;
                const uint32_t bits = (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 |
                                      (uint32_t)b[3] << 24;
                wrong += bits != check_bits(picture.pixels[(130 - i / row) * row + i % row]);
            }
        }
        CHECK_SAY(wrong == 0, "%zu floats differ", wrong);
        free(file);
        image_free(&picture);
    }
}

static void image_ppm_comes_back(void) {
    static const char header[] = "P6\n131 257\n255\n";
    for (int channels = 1; channels <= 3; channels += 2) {
        image picture = test_picture(131, 257, channels);
        size_t size = 0, wrong = 0;
        uint8_t *file = written(image_write_ppm, &picture, &size);
        const int whole = file != NULL && size == sizeof header - 1 + 131 * 257 * 3;
        CHECK(whole);
        if (whole) {
            CHECK(memcmp(file, header, sizeof header - 1) == 0);
            for (int i = 0; i < 131 * 257 * 3; ++i) {
                const int from = channels == 3 ? i : i / 3;
                wrong +=
                    file[sizeof header - 1 + (size_t)i] != image_srgb_byte(picture.pixels[from]);
            }
        }
        CHECK_SAY(wrong == 0, "%zu bytes differ", wrong);
        free(file);
        image_free(&picture);
    }
}

/* Values of IEC 61966-2-1, worked out by hand: the join of both pieces, the half, the ends. */
static void image_srgb_curve(void) {
    CHECK(image_srgb_byte(0.0f) == 0 && image_srgb_byte(1.0f) == 255);
    CHECK(image_srgb_byte(-1.0f) == 0 && image_srgb_byte((float)NAN) == 0);
    CHECK(image_srgb_byte((float)INFINITY) == 255);
    CHECK(image_srgb_byte(0.5f) == 188);       /* 255 * 0.73536 = 187.5 */
    CHECK(image_srgb_byte(0.2158605f) == 128); /* ((128/255 + 0.055) / 1.055)^2.4 */
    CHECK(image_srgb_byte(0.0031308f) == 10);  /* 255 * 0.04045 = 10.3 */
    for (int value = 0; value < 256; ++value) {
        CHECK_SAY(image_srgb_byte(image_linear((float)value / 255.0f)) == value, "%d", value);
    }
}

/* CIE 1976 lightness of linear light, 0 to 100. */
static double lightness(const float rgb[3]) {
    const double y = 0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1] + 0.0722 * (double)rgb[2];
    return y > 216.0 / 24389.0 ? 116.0 * cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

/* The palette must read in grey: lightness rises everywhere, and by 8 to 15 from each of the nine
 * colours to the next (even steps would be 12). */
static void image_palette_rises(void) {
    float rgb[3];
    heat_colour(0.0f, rgb);
    double last = lightness(rgb), last_knot = last;
    CHECK(last < 5.0);
    for (int i = 1; i <= 256; ++i) {
        heat_colour((float)i / 256.0f, rgb);
        const double now = lightness(rgb);
        CHECK_SAY(now > last, "%d of 256: %g after %g", i, now, last);
        last = now;
        if (i % 32 != 0) continue;
        CHECK_SAY(now - last_knot > 8.0 && now - last_knot < 15.0, "step %d: %g", i / 32,
                  now - last_knot);
        last_knot = now;
    }
    CHECK(last > 95.0);
    float below[3], above[3], not_a_number[3], first[3];
    heat_colour(0.0f, first);
    heat_colour(-3.0f, below);
    heat_colour(7.0f, above);
    heat_colour((float)NAN, not_a_number);
    CHECK(memcmp(below, first, sizeof first) == 0 && memcmp(above, rgb, sizeof rgb) == 0);
    CHECK(memcmp(not_a_number, first, sizeof first) == 0);
}

/* The legend's numbers, read back: the digit 8 right above the end of a scale of 8. */
static void image_legend_has_numbers(void) {
    static const char *const eight[7] = {".###.", "#...#", "#...#", ".###.",
                                         "#...#", "#...#", ".###."};
    image picture = image_create(200, heat_legend_height, 3);
    CHECK(picture.pixels != NULL);
    if (picture.pixels == NULL) return;
    heat_legend(&picture, 0, 0, 200, "title", 8.0, "");
    int matches = 0;
    for (int y = 0; y + 7 <= heat_legend_height; ++y) {
        for (int x = 180; x + 5 <= 200; ++x) {
            int same = 1;
            for (int i = 0; i < 35 && same; ++i) {
                same = (image_at(&picture, x + i % 5, y + i / 5)[0] > 0.5f) ==
                       (eight[i / 5][i % 5] == '#');
            }
            matches += same;
        }
    }
    CHECK_SAY(matches == 1, "%d", matches);
    heat_text(&picture, 197, heat_legend_height - 3, "cut at the edge", picture.pixels);
    image_free(&picture);
}

static void image_endings(void) {
    CHECK(image_is_known("a.png") && image_is_known("b.c/d.PPM") && image_is_known("x.pfm"));
    CHECK(!image_is_known("png") && !image_is_known(""));
    CHECK(image_is_float("x.pfm") && !image_is_float("x.png") && !image_is_float("x"));
    CHECK(!image_can_write("no such folder/x.png"));
    CHECK(image_create(0, 1, 3).pixels == NULL && image_create(1, 40000, 3).pixels == NULL);
}

void suite_image(void) {
    RUN(image_png_comes_back);
    RUN(image_png_is_compressed);
    RUN(image_deflate_comes_back);
    RUN(image_reader_notices_damage);
    RUN(image_pfm_comes_back);
    RUN(image_ppm_comes_back);
    RUN(image_srgb_curve);
    RUN(image_palette_rises);
    RUN(image_legend_has_numbers);
    RUN(image_endings);
}
