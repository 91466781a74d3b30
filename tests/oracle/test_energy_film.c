/* SPDX-License-Identifier: MIT
 *
 * What a picture of the path tracer must not depend on, and that its random numbers are even. */
#include <path_random.h>
#include <path_room.h>

#include "../check.h"

#include <math.h>
#include <string.h>

/* Two tiles by two, not whole ones. */
enum { width = 70, height = 66, count = 3 * width * height };
static float picture[count], other[count];
static path_stage stage;

static void check_picture(const path_settings *settings, const char *what) {
    path_statistics statistics = path_statistics_default();
    memset(other, 0, sizeof other);
    CHECK(path_render(&stage.world, settings, width, height, 3, other, &statistics) == 0);
    CHECK_SAY(memcmp(picture, other, sizeof picture) == 0, "%s: other bits", what);
    CHECK(statistics.traced[PATH_PRIMARY].rays == 3 * width * height);
    CHECK(statistics.traced[PATH_SECONDARY].rays > 0 && statistics.traced[PATH_SHADOW].rays > 0);
}

static void energy_of_any_division(void) {
    path_settings settings = path_settings_default();
    path_film film = path_film_create(width, height);
    settings.bounces = 1;
    path_room(&stage, width, height);
    CHECK(film.sums != NULL);
    if (film.sums == NULL) return;
    CHECK(path_expose(&film, &stage.world, &settings, 1, "", NULL) == 0);
    CHECK(path_expose(&film, &stage.world, &settings, 2, "", NULL) == 0);
    path_film_print(&film, picture);
    path_film_free(&film);
    for (int i = 0; i < count; ++i) {
        CHECK_SAY(picture[i] >= 0.0f && picture[i] < 100.0f, "pixel %d: %g", i / 3,
                  (double)picture[i]);
    }
    check_picture(&settings, "at once");
    settings.threads = 3;
    check_picture(&settings, "three threads");
    settings.max_lanes = 1;
    check_picture(&settings, "one lane");
}

/* Of 64 samples each part of the unit square that is 2^-k wide and 2^(k - 6) high holds one: what
 * Sobol's first two dimensions have, and Owen's scrambling keeps. */
static void energy_of_even_numbers(void) {
    for (uint32_t pixel = 0; pixel < 50; ++pixel) {
        for (int k = 0; k <= 6; ++k) {
            uint64_t held = 0;
            for (uint32_t sample = 0; sample < 64; ++sample) {
                const path_pair pair = path_random(pixel * 7919, pixel % 11, sample);
                const int column = (int)(pair.first * (float)(1 << k));
                const int row = (int)(pair.second * (float)(1 << (6 - k)));
                CHECK(pair.first >= 0 && pair.first < 1 && pair.second >= 0 && pair.second < 1);
                held |= (uint64_t)1 << (column * (1 << (6 - k)) + row);
            }
            CHECK_SAY(held == UINT64_MAX, "pixel %u, %d columns", pixel, 1 << k);
        }
    }
}

/* Directions are of unit length, and their mean lies on the axis at 2/3: that of the cosine. Of 2^12
 * even samples it is known much better than of random ones, whose standard error is 0.004. */
static void energy_of_directions(void) {
    for (int i = 0; i < 50; ++i) {
        const double turn = check_uniform(0, 6.28), z = i == 0 ? -1 : check_uniform(-1, 1);
        const double flat = sqrt(1 - z * z);
        const float axis[3] = {(float)(flat * cos(turn)), (float)(flat * sin(turn)), (float)z};
        double mean[3] = {0, 0, 0};
        for (uint32_t sample = 0; sample < 4096; ++sample) {
            const path_pair pair = path_random((uint32_t)i, 1, sample);
            float d[3];
            double square = 0;
            path_direction(axis, pair.first, pair.second, d);
            for (int c = 0; c < 3; ++c) {
                square += (double)d[c] * (double)d[c];
                mean[c] += (double)d[c] / 4096;
            }
            CHECK_SAY(fabs(square - 1) < 1e-5, "length %g", sqrt(square));
        }
        for (int c = 0; c < 3; ++c) {
            CHECK_SAY(fabs(mean[c] - (double)axis[c] * 2 / 3) < 1e-3, "axis %d: %g, not %g", c,
                      mean[c], (double)axis[c] * 2 / 3);
        }
    }
}

void suite_energy_film(void) {
    RUN(energy_of_any_division);
    RUN(energy_of_even_numbers);
    RUN(energy_of_directions);
}
