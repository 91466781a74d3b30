/* SPDX-License-Identifier: MIT
 *
 * The idea introduced here: a still picture. Threads of the program's own trace its tiles, hits
 * become colours, or a map of what the tracing cost; and processes can share one picture. */
#include "gallery.h"
#include "part_file.h"
#include "render_options.h"
#include "step_rules.h"
#include "workers.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* As shells see a program that a signal ended. */
enum { status_of_signal = 128 };

/* Refuses what cannot become a file before anything is traced. */
static void check_output(const char *path, int is_picture) {
    if (is_picture && !image_is_known(path)) {
        render_refuse("'%s' does not end in .png, .ppm or .pfm", path);
    }
    if (!image_can_write(path)) render_refuse("cannot write '%s': %s", path, strerror(errno));
}

static void check_rules(const picture_job *job) {
    scene_parts parts;
    scene_parts_of(job->shown, job->whole ? SCENE_WHOLE : SCENE_OBJECTS, 1, &parts);
    for (size_t part = 0; part < parts.scene.count; ++part) {
        for (int i = 0; i < job->panel_count; ++i) {
            if (!step_rule_allowed(job->panels[i].method, parts.fields[part].flags)) {
                render_refuse("scene '%s' is not all convex, which rule 'convex' needs",
                              job->shown->name);
            }
        }
    }
}

/* Writes the picture, or a message. Returns the program's exit status. */
static int write_picture(const char *path, const film *exposed) {
    image picture = film_print(exposed, image_is_float(path));
    errno = picture.pixels == NULL ? ENOMEM : 0;
    const int written = picture.pixels != NULL && image_write(path, &picture) == 0;
    if (!written) {
        fprintf(stderr, "render: cannot write '%s'%s%s\n", path, errno != 0 ? ": " : "",
                errno != 0 ? strerror(errno) : "");
    }
    image_free(&picture);
    return written ? 0 : 1;
}

static void report(const char *path, const film *exposed) {
    uint64_t rays = 0, evaluations = 0, cones = 0, hits = 0, undecided = 0;
    for (int i = 0; i < exposed->job.panel_count; ++i) {
        const spt_statistics *statistics = &exposed->statistics[i];
        rays += statistics->rays;
        evaluations += statistics->evaluations;
        cones += statistics->cone_evaluations;
        hits += statistics->outcomes[SPT_HIT];
        undecided += statistics->outcomes[SPT_LIMIT];
    }
    const double share = rays != 0 ? 1.0 / (double)rays : 0.0;
    printf("%s: %llu rays, %.2f evaluations a ray and %.2f of cones, %llu hits, %llu undecided\n",
           path, (unsigned long long)rays, (double)evaluations * share, (double)cones * share,
           (unsigned long long)hits, (unsigned long long)undecided);
}

static int merge(const render_options *chosen) {
    char default_output[64];
    film whole = part_merge(chosen->words, chosen->word_count);
    if (whole.values == NULL) return 2;
    snprintf(default_output, sizeof default_output, "%s.png", whole.job.shown->name);
    const char *output = chosen->output != NULL ? chosen->output : default_output;
    check_output(output, 1);
    const int status = write_picture(output, &whole);
    if (status == 0) report(output, &whole);
    film_free(&whole);
    return status;
}

/* Says what an interrupt left undone, and writes the rest. Returns the program's exit status. */
static int leave_partial(const char *path, const film *exposed, long missing, int is_part) {
    fprintf(stderr, "render: interrupted, %ld of %llu tiles are missing; ", missing,
            (unsigned long long)(exposed->end - exposed->first));
    if (is_part) {
        fprintf(stderr, "no part is written\n");
    } else {
        fprintf(stderr, "they are black in '%s'\n", path);
        write_picture(path, exposed);
    }
    return status_of_signal + workers_interrupted();
}

static int render(const render_options *chosen) {
    const picture_job *job = &chosen->job;
    const int is_part = chosen->of != 0;
    char default_output[64];
    const char *output = chosen->output != NULL ? chosen->output : default_output;
    size_t first = 0, end = picture_pieces(job);
    if (is_part) {
        part_pieces(job, chosen->part, chosen->of, &first, &end);
        snprintf(default_output, sizeof default_output, "%s_%d_of_%d.part", job->shown->name,
                 chosen->part, chosen->of);
    } else {
        snprintf(default_output, sizeof default_output, "%s.png", job->shown->name);
    }
    check_rules(job);
    if ((job->right - job->left + 4) * job->panel_count > image_largest_side) {
        render_refuse("the picture is too wide");
    }
    check_output(output, !is_part);
    film exposed = film_create(job, first, end);
    if (exposed.values == NULL) {
        fprintf(stderr, "render: out of memory\n");
        return 1;
    }
    const long missing = film_expose(&exposed, chosen->threads, job->shown->name);
    int status = missing >= 0 ? 0 : 1;
    if (missing > 0) {
        status = leave_partial(output, &exposed, missing, is_part);
    } else if (missing == 0 && is_part) {
        status = part_write(output, &exposed, chosen->part, chosen->of) == 0 ? 0 : 1;
        if (status != 0) fprintf(stderr, "render: cannot write '%s'\n", output);
    } else if (missing == 0) {
        status = write_picture(output, &exposed);
    }
    if (status == 0) report(output, &exposed);
    film_free(&exposed);
    return status;
}

int main(int count, char **arguments) {
    const render_options chosen = render_options_of(count, arguments);
    if (chosen.merge) return merge(&chosen);
    workers_catch_interrupts();
    if (chosen.gallery == NULL) return render(&chosen);
    const picture_job *job = &chosen.job;
    return gallery_render(chosen.gallery, job->width, job->height,
                          chosen.samples != 0 ? chosen.samples : 3, chosen.threads, chosen.large);
}
