/* SPDX-License-Identifier: MIT
 *
 * The list of the gallery's pictures, and the loop over it. */
#define _POSIX_C_SOURCE 200809L /* mkdir */
#include "gallery.h"

#include "picture.h"
#include "step_rules.h"
#include "workers.h"

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
    uint32_t flags[2];      /* SPT_FRAME_*, by panel */
    uint32_t budget;        /* 0: the default; else also the end of the heat map's scale */
    int whole;              /* the scene as one field */
    int large;              /* 1920 x 1080, in the large gallery only */
    int no_shadows;
} gallery_entry;

/* Nothing but one step rule: each ray by itself through one field. */
#define ALONE \
    .whole = 1, .flags = {SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING, \
                          SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING}

static const gallery_entry entries[] = {
    {"primitives.png", "primitives", .kind = PICTURE_SHADED},
    {"village.png", "village", .kind = PICTURE_SHADED},
    {"mandelbulb.png", "mandelbulb", .kind = PICTURE_SHADED},
    {"dodecahedron.png", "dodecahedron", .kind = PICTURE_SHADED},
    {"dodecahedron_p32.png", "dodecahedron_p32", .kind = PICTURE_SHADED},
    {"twisted.png", "twisted", .kind = PICTURE_SHADED},
    {"bent.png", "bent", .kind = PICTURE_SHADED},
    {"blended.png", "blended", .kind = PICTURE_SHADED},
    {"repeated.png", "repeated", .kind = PICTURE_SHADED},
    {"arches.png", "arches", .kind = PICTURE_SHADED},
    {"primitives_normals.png", "primitives", .kind = PICTURE_NORMAL},
    {"primitives_evaluations.png", "primitives", .kind = PICTURE_HEAT,
     .methods = {"basic", "adaptive"}, ALONE, .budget = 128},
    {"village_evaluations.png", "village", .kind = PICTURE_HEAT, .methods = {"basic", "adaptive"},
     ALONE, .budget = 64},
    {"mandelbulb_evaluations.png", "mandelbulb", .kind = PICTURE_HEAT,
     .methods = {"basic", "adaptive"}, ALONE, .budget = 64},
    {"primitives_fallbacks.png", "primitives", .kind = PICTURE_FALLBACK,
     .methods = {"relaxed", "enhanced"}, ALONE},
    {"village_fallbacks.png", "village", .kind = PICTURE_FALLBACK,
     .methods = {"relaxed", "enhanced"}, ALONE},
    {"primitives_cones.png", "primitives", .kind = PICTURE_HEAT,
     .methods = {"adaptive", "adaptive"}, .flags = {SPT_FRAME_NO_CONES, 0}, .budget = 32},
    {"village_cones.png", "village", .kind = PICTURE_HEAT, .methods = {"adaptive", "adaptive"},
     .flags = {SPT_FRAME_NO_CONES, 0}, .budget = 32},
    {"mandelbulb_cones.png", "mandelbulb", .kind = PICTURE_HEAT,
     .methods = {"adaptive", "adaptive"}, .flags = {SPT_FRAME_NO_CONES, 0}, .budget = 32},
    {"village_kept.png", "village", .kind = PICTURE_KEPT, .large = 1},
    {"primitives_large.png", "primitives", .kind = PICTURE_SHADED, .large = 1},
    {"primitives_large_no_shadows.png", "primitives", .kind = PICTURE_SHADED, .large = 1,
     .no_shadows = 1},
    {"village_large.png", "village", .kind = PICTURE_SHADED, .large = 1},
    {"village_large_no_shadows.png", "village", .kind = PICTURE_SHADED, .large = 1,
     .no_shadows = 1},
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
        job.panels[i].method = step_rule_named(entry->methods[i]);
        job.panels[i].flags = entry->flags[i];
        job.panel_count = i + 1;
    }
    if (entry->budget != 0) job.budget = entry->budget;
    job.whole = entry->whole;
    job.shadows = !entry->no_shadows;
    return job;
}

/* Returns the program's exit status, after a message unless 0. */
static int render_entry(const gallery_entry *entry, const char *path, const picture_job *job,
                        int threads) {
    film exposed = film_create(job, 0, picture_pieces(job));
    const long missing = exposed.values != NULL ? film_expose(&exposed, threads, entry->file) : -1;
    image picture = {0, 0, 0, NULL};
    if (exposed.values == NULL) fprintf(stderr, "out of memory\n");
    if (missing > 0) {
        fprintf(stderr, "interrupted; %s is not written\n", entry->file);
    } else if (missing == 0) {
        picture = film_print(&exposed, 0);
        errno = picture.pixels == NULL ? ENOMEM : 0;
    }
    int status = missing > 0 ? 128 + workers_interrupted() : missing < 0;
    if (missing == 0 && (picture.pixels == NULL || image_write(path, &picture) != 0)) {
        fprintf(stderr, "cannot write %s: %s\n", path, errno != 0 ? strerror(errno) : "failed");
        status = 1;
    }
    if (status == 0) {
        const spt_statistics *last = &exposed.statistics[job->panel_count - 1];
        printf("%-32s %6.2f evaluations a ray and %5.2f of cones\n", entry->file,
               (double)last->evaluations / (double)last->rays,
               (double)last->cone_evaluations / (double)last->rays);
    }
    image_free(&picture);
    film_free(&exposed);
    return status;
}

int gallery_render(const char *folder, int width, int height, int samples, int threads, int large) {
    char path[1024];
    int count = 0;
    if (strlen(folder) > sizeof path - 64 || !make_folder(folder)) {
        fprintf(stderr, "cannot create the folder %s\n", folder);
        return 2;
    }
    for (size_t i = 0; i < entry_count; ++i) {
        const gallery_entry *entry = &entries[i];
        if (entry->large && !large) continue;
        const scene *shown = scene_named(entry->scene);
        snprintf(path, sizeof path, "%s/%s", folder, entry->file);
        if (shown == NULL || !image_can_write(path)) {
            fprintf(stderr, "cannot write %s\n", path);
            return 2;
        }
        picture_job job = job_of(entry, shown);
        picture_set_size(&job, entry->large ? 1920 : width, entry->large ? 1080 : height);
        job.samples = samples;
        const int status = render_entry(entry, path, &job, threads);
        if (status != 0) return status;
        fflush(stdout);
        ++count;
    }
    printf("%d pictures in %s\n", count, folder);
    return 0;
}
