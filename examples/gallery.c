/* SPDX-License-Identifier: MIT
 *
 * The list of the gallery's pictures, and the loop over it. */
#define _POSIX_C_SOURCE 200809L /* mkdir */
#include "gallery.h"

#include "picture.h"
#include "progress.h"
#include "step_rules.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#ifdef _WIN32
#include <direct.h>
#endif

typedef struct gallery_entry {
    const char *file, *scene;
    picture_kind kind;
    const char *methods[2]; /* NULL: the default rule, or no second panel */
    uint32_t budget;        /* 0: the default; else also the end of the heat map's scale */
} gallery_entry;

static const gallery_entry entries[] = {
    {"primitives.png", "primitives", PICTURE_SHADED, {NULL, NULL}, 0},
    {"village.png", "village", PICTURE_SHADED, {NULL, NULL}, 0},
    {"mandelbulb.png", "mandelbulb", PICTURE_SHADED, {NULL, NULL}, 0},
    {"dodecahedron.png", "dodecahedron", PICTURE_SHADED, {NULL, NULL}, 0},
    {"dodecahedron_p32.png", "dodecahedron_p32", PICTURE_SHADED, {NULL, NULL}, 0},
    {"twisted.png", "twisted", PICTURE_SHADED, {NULL, NULL}, 0},
    {"bent.png", "bent", PICTURE_SHADED, {NULL, NULL}, 0},
    {"blended.png", "blended", PICTURE_SHADED, {NULL, NULL}, 0},
    {"repeated.png", "repeated", PICTURE_SHADED, {NULL, NULL}, 0},
    {"arches.png", "arches", PICTURE_SHADED, {NULL, NULL}, 0},
    {"primitives_normals.png", "primitives", PICTURE_NORMAL, {NULL, NULL}, 0},
    {"primitives_evaluations.png", "primitives", PICTURE_HEAT, {"basic", "adaptive"}, 128},
    {"village_evaluations.png", "village", PICTURE_HEAT, {"basic", "adaptive"}, 64},
    {"mandelbulb_evaluations.png", "mandelbulb", PICTURE_HEAT, {"basic", "adaptive"}, 64},
    {"primitives_fallbacks.png", "primitives", PICTURE_FALLBACK, {"relaxed", "enhanced"}, 0},
    {"village_fallbacks.png", "village", PICTURE_FALLBACK, {"relaxed", "enhanced"}, 0},
};
enum { entry_count = sizeof entries / sizeof entries[0] };

static int make_folder(const char *folder) {
#ifdef _WIN32
    return _mkdir(folder) == 0 || errno == EEXIST;
#else
    return mkdir(folder, 0777) == 0 || errno == EEXIST;
#endif
}

static picture_job job_of(const gallery_entry *entry, const scene *shown) {
    picture_job job = picture_job_default(shown);
    job.kind = entry->kind;
    for (int i = 0; i < 2 && entry->methods[i] != NULL; ++i) {
        job.methods[i] = step_rule_named(entry->methods[i]);
        job.panels = i + 1;
    }
    if (entry->budget != 0) job.budget = entry->budget;
    return job;
}

/* Returns 0 after a message. */
static int render_entry(const gallery_entry *entry, const char *path, int width, int height,
                        int samples) {
    const scene *shown = scene_named(entry->scene);
    if (shown == NULL) {
        fprintf(stderr, "there is no scene %s\n", entry->scene);
        return 0;
    }
    picture_job job = job_of(entry, shown);
    job.width = width;
    job.height = height;
    job.samples = samples;
    spt_statistics statistics = spt_statistics_default();
    image picture = picture_render(&job, entry->file, &statistics);
    if (picture.pixels == NULL) return 0;
    errno = 0;
    const int written = image_write(path, &picture) == 0;
    if (!written) {
        fprintf(stderr, "cannot write %s: %s\n", path, errno != 0 ? strerror(errno) : "no memory");
    } else {
        printf("%-28s %6.2f evaluations a ray\n", entry->file,
               (double)statistics.evaluations / (double)statistics.rays);
    }
    image_free(&picture);
    return written;
}

int gallery_render(const char *folder, int width, int height, int samples) {
    char path[1024];
    if (strlen(folder) > sizeof path - 64 || !make_folder(folder)) {
        fprintf(stderr, "cannot create the folder %s\n", folder);
        return 2;
    }
    for (size_t i = 0; i < entry_count; ++i) {
        snprintf(path, sizeof path, "%s/%s", folder, entries[i].file);
        if (!image_can_write(path)) {
            fprintf(stderr, "cannot write %s: %s\n", path, strerror(errno));
            return 2;
        }
        if (!render_entry(&entries[i], path, width, height, samples)) return 1;
        fflush(stdout);
    }
    printf("%d pictures in %s\n", (int)entry_count, folder);
    return 0;
}
