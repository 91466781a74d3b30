/* SPDX-License-Identifier: MIT
 *
 * The idea introduced here: global illumination by waves of rays. All paths of a tile are traced in
 * one call a bounce, and so are their shadow rays; normals and origins come from the library, too.
 * The picture is written again and again while samples gather. Without a file it only checks that a
 * white furnace is evenly bright. */
#include "image.h"
#include "path_room.h"
#include "step_rules.h"
#include "workers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "usage: path_tracer [--scene NAME] [--method RULE] [--samples N] [--bounces N] [--size WxH]\n"
    "                   [--threads N] [FILE]\n"
    "scenes: room (the default), or one of render's, in the open\n";

typedef struct options {
    const char *scene, *file;
    path_settings settings;
    uint32_t samples;
    int width, height;
} options;

static void refuse(const char *what, const char *value) {
    fprintf(stderr, "path_tracer: %s '%s'\n%s", what, value, usage);
    exit(2);
}

static long number(const char *value, long low, long high) {
    char *end;
    const long n = strtol(value, &end, 10);
    if (end == value || *end != '\0' || n < low || n > high) refuse("no use for the number", value);
    return n;
}

static void read_option(options *chosen, const char *name, const char *value) {
    if (strcmp(name, "--scene") == 0) {
        chosen->scene = value;
        if (strcmp(value, "room") != 0 && scene_named(value) == NULL) refuse("no scene", value);
    } else if (strcmp(name, "--method") == 0) {
        chosen->settings.method = step_rule_named(value);
        if (chosen->settings.method == NULL) refuse("no step rule", value);
    } else if (strcmp(name, "--samples") == 0) {
        chosen->samples = (uint32_t)number(value, 1, 1 << 20);
    } else if (strcmp(name, "--bounces") == 0) {
        chosen->settings.bounces = (uint32_t)number(value, 0, 1000);
    } else if (strcmp(name, "--threads") == 0) {
        chosen->settings.threads = (int)number(value, 1, 1024);
    } else if (strcmp(name, "--size") == 0) {
        int used = 0;
        if (sscanf(value, "%5dx%5d%n", &chosen->width, &chosen->height, &used) != 2 ||
            value[used] != '\0' || chosen->width < 1 || chosen->width > image_largest_side ||
            chosen->height < 1 || chosen->height > image_largest_side) {
            refuse("no size", value);
        }
    } else {
        refuse("no option", name);
    }
}

static options options_of(int count, char **arguments) {
    options chosen = {"room", NULL, path_settings_default(), 64, 640, 360};
    chosen.settings.threads = workers_processors();
    for (int i = 1; i < count; ++i) {
        if (strncmp(arguments[i], "--", 2) == 0) {
            if (i + 1 == count) refuse("nothing after", arguments[i]);
            read_option(&chosen, arguments[i], arguments[i + 1]);
            ++i;
        } else if (chosen.file != NULL || !image_is_known(arguments[i])) {
            refuse("no use for", arguments[i]);
        } else {
            chosen.file = arguments[i];
        }
    }
    return chosen;
}

/* Samples in stages, each as many as there are already, and a picture after each. Returns the
 * program's exit status. */
static int render(const options *chosen, const path_world *world) {
    path_statistics statistics = path_statistics_default();
    path_film film = path_film_create(chosen->width, chosen->height);
    image picture = image_create(chosen->width, chosen->height, 3);
    int status = film.sums == NULL || picture.pixels == NULL;
    long missing = 0;
    uint32_t samples = 0;
    while (status == 0 && missing == 0 && samples < chosen->samples) {
        const uint32_t more = samples == 0 ? 1 : samples, rest = chosen->samples - samples;
        missing = path_expose(&film, world, &chosen->settings, more < rest ? more : rest,
                              chosen->scene, &statistics);
        samples += more < rest ? more : rest;
        path_film_print(&film, picture.pixels);
        status = missing < 0 || image_write(chosen->file, &picture) != 0;
    }
    if (status != 0) fprintf(stderr, "path_tracer: no picture '%s'\n", chosen->file);
    if (status == 0) path_statistics_print(&statistics);
    if (missing > 0) fprintf(stderr, "interrupted: %ld tiles have fewer samples\n", missing);
    image_free(&picture);
    path_film_free(&film);
    return status != 0 ? 1 : missing > 0 ? 128 + workers_interrupted() : 0;
}

/* Where all surfaces of a closed room shine by 1 and scatter the share a, the eye sees
 * 1 + a + ... + a^10 in every direction, whatever is in the room: paths lose nothing on their way,
 * and none gets out. */
static int check_furnace(path_stage *stage) {
    enum { width = 32, height = 20 };
    static float pixels[3 * width * height];
    static const float albedo[3] = {0.25f, 0.5f, 0.75f};
    path_settings settings = path_settings_default();
    double off = 0.0;
    settings.roulette = settings.bounces + 1;
    path_room(stage, width, height);
    stage->world.panel = NULL;
    for (size_t i = 0; i < stage->scene.count; ++i) {
        for (int c = 0; c < 3; ++c) {
            stage->materials[i].albedo[c] = albedo[c];
            stage->materials[i].emission[c] = 1.0f;
        }
    }
    if (path_render(&stage->world, &settings, width, height, 4, pixels, NULL) != 0) return 0;
    for (size_t i = 0; i < sizeof pixels / sizeof pixels[0]; ++i) {
        const double a = (double)albedo[i % 3];
        const double expected = (1.0 - pow(a, settings.bounces + 1)) / (1.0 - a);
        off = fmax(off, fabs((double)pixels[i] - expected) / expected);
    }
    printf("the furnace is even within %.1e\n", off);
    return off < 11 * 0x1p-23; /* a product and a sum for each of 11 surfaces */
}

int main(int count, char **arguments) {
    static path_stage stage;
    const options chosen = options_of(count, arguments);
    if (chosen.file == NULL) return !check_furnace(&stage);
    if (!image_can_write(chosen.file)) refuse("cannot write", chosen.file);
    if (strcmp(chosen.scene, "room") == 0) {
        path_room(&stage, chosen.width, chosen.height);
    } else {
        path_open_air(&stage, scene_named(chosen.scene), SCENE_OBJECTS, chosen.width,
                      chosen.height);
    }
    workers_catch_interrupts();
    return render(&chosen, &stage.world);
}
