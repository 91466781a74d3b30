/* SPDX-License-Identifier: MIT
 *
 * The idea introduced here: a renderer around the library, with glass in it. Writes the pair of
 * pictures after Keinert et al. 2014, Figure 11 (a convex body traced through its inside, and from
 * outside backwards) and a cut gem; without a folder it checks itself on small pictures. */
#include "whitted_check.h"
#include "whitted_pair.h"
#include "workers.h"

#include <stdio.h>
#include <string.h>

/* The mean of 2 x 2 pixels each; empty where memory ran out. */
static image halved(const image *picture) {
    image half = image_create(picture->width / 2, picture->height / 2, 3);
    for (int y = 0; half.pixels != NULL && y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) {
            const float *const above = image_at(picture, 2 * x, 2 * y);
            const float *const below = image_at(picture, 2 * x, 2 * y + 1);
            float *const to = image_at(&half, x, y);
            for (int c = 0; c < 3; ++c) {
                to[c] = 0.25f * (above[c] + above[c + 3] + below[c] + below[c + 3]);
            }
        }
    }
    return half;
}

static int make_gem(const char *path) {
    whitted_settings settings = whitted_settings_default();
    whitted_statistics statistics;
    glass_world world;
    settings.threads = workers_processors();
    if (!glass_world_named("jewel", &world)) return 0;
    image picture = whitted_shown(&world, &settings, 1280, 720, &statistics);
    if (picture.pixels == NULL) return 0;
    image half = halved(&picture);
    const int good = half.pixels != NULL && image_write(path, &half) == 0;
    printf("%s\n  %llu rays inside, %.2f evaluations each, %llu self-intersections\n", path,
           (unsigned long long)statistics.of[WHITTED_INSIDE].rays,
           (double)statistics.of[WHITTED_INSIDE].evaluations /
               (double)statistics.of[WHITTED_INSIDE].rays,
           (unsigned long long)statistics.self_hits);
    image_free(&half);
    image_free(&picture);
    return good;
}

int main(int argument_count, char **arguments) {
    char pair[1024], gem[1024];
    if (argument_count < 2 || strcmp(arguments[1], "--check") == 0) return !whitted_check();
    if (arguments[1][0] == '-' || strlen(arguments[1]) > sizeof pair - 64) {
        fprintf(stderr, "usage: whitted [--check | FOLDER]\n");
        return 2;
    }
    snprintf(pair, sizeof pair, "%s/keinert_fig11.png", arguments[1]);
    snprintf(gem, sizeof gem, "%s/whitted_jewel.png", arguments[1]);
    if (whitted_pair(pair) && make_gem(gem)) return 0;
    fprintf(stderr, "whitted: no picture, or it cannot be written\n");
    return 1;
}
