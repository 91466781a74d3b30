/* SPDX-License-Identifier: MIT
 *
 * The idea introduced here: a still picture. Rays go to the library tile by tile, hits come back
 * and become colours, or a map of what the tracing cost. */
#include "gallery.h"
#include "picture.h"
#include "step_rules.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct options {
    picture_job job;
    const char *output, *gallery;
    int samples; /* as asked for, or 0 */
    char default_output[128];
} options;

static const char usage[] =
    "Usage: render [options] SCENE\n"
    "       render [--size WxH] [--samples N] --gallery FOLDER\n"
    "Traces a picture of a scene.\n"
    "\n"
    "  -o, --output FILE   .png .ppm .pfm, and others if built with OpenImageIO; a .pfm holds the\n"
    "                      numbers themselves (default: SCENE.png)\n"
    "  --kind KIND         shaded, normal, heat (evaluations), fallback (rejected probes), depth "
    "or\n"
    "                      outcome (default: shaded)\n"
    "  --method RULE[,..]  step rules, side by side (default: adaptive)\n"
    "  --size WxH          pixels (default: 640x360)\n"
    "  --samples N         N x N samples a pixel, 1 to 8 (default: 2, in the gallery 3)\n"
    "  --budget N          most evaluations a ray, and the end of the heat scale (default: 128)\n"
    "  --epsilon X         absolute tolerance, world length (default: 0.0001)\n"
    "  --no-cone           trace down to epsilon instead of to half a pixel\n"
    "  --lanes N           no wider than 1, 4, 8 or 16 (default: the widest there is)\n"
    "  --gallery FOLDER    render the whole gallery\n"
    "  --list              list scenes and step rules\n"
    "  --help              print this\n"
    "\n"
    "Exit status: 0; 1 if a picture failed; 2 for a bad command line or a file that cannot be\n"
    "written.\n";

/* Prints a printf-style message about the command line and ends the program. */
#if defined(__GNUC__)
__attribute__((noreturn, format(printf, 1, 2)))
#endif
static void
refuse(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fputs("render: ", stderr);
    vfprintf(stderr, format, arguments);
    fputs("\nTry render --help.\n", stderr);
    va_end(arguments);
    exit(2);
}

static long integer_of(const char *text, const char *option, long low, long high) {
    char *end = NULL;
    errno = 0;
    const long value = strtol(text, &end, 10);
    if (end == text || *end != '\0' || errno != 0 || value < low || value > high) {
        refuse("%s wants a whole number from %ld to %ld, not '%s'", option, low, high, text);
    }
    return value;
}

static void set_size(picture_job *job, const char *text) {
    int end = 0;
    if (sscanf(text, "%5dx%5d%n", &job->width, &job->height, &end) != 2 || text[end] != '\0' ||
        job->width < 1 || job->height < 1 || job->width > 8192 || job->height > 8192) {
        refuse("--size wants WIDTHxHEIGHT, each from 1 to 8192, not '%s'", text);
    }
}

static void set_kind(picture_job *job, const char *name) {
    for (int kind = 0; kind < picture_kinds; ++kind) {
        if (strcmp(picture_kind_names[kind], name) == 0) {
            job->kind = (picture_kind)kind;
            return;
        }
    }
    refuse("there is no kind '%s'", name);
}

static void set_methods(picture_job *job, const char *names) {
    job->panels = 0;
    for (const char *name = names;; ++name) {
        char single[32];
        const size_t length = strcspn(name, ",");
        if (job->panels == picture_panels) refuse("at most %d step rules", picture_panels);
        snprintf(single, sizeof single, "%.*s", (int)length, name);
        const spt_method *method = length < sizeof single ? step_rule_named(single) : NULL;
        if (method == NULL) refuse("there is no step rule '%.*s'", (int)length, name);
        job->methods[job->panels++] = method;
        name += length;
        if (*name == '\0') return;
    }
}

static float positive_of(const char *text, const char *option) {
    char *end = NULL;
    const float value = strtof(text, &end);
    if (end == text || *end != '\0' || !(value > 0.0f) || !(value < INFINITY)) {
        refuse("%s wants a number above 0, not '%s'", option, text);
    }
    return value;
}

static uint32_t lanes_of(const char *text) {
    const long lanes = integer_of(text, "--lanes", 1, 16);
    if (lanes != 1 && lanes != 4 && lanes != 8 && lanes != 16) {
        refuse("--lanes wants 1, 4, 8 or 16, not '%s'", text);
    }
    return (uint32_t)lanes;
}

static void list_all(void) {
    printf("Scenes:\n");
    for (size_t i = 0; i < scene_count; ++i) {
        printf("  %-18s %s\n", scenes[i]->name, scenes[i]->description);
    }
    printf("Step rules:\n");
    for (size_t i = 0; step_rule(i) != NULL; ++i) printf("  %s\n", spt_method_name(step_rule(i)));
}

/* Takes an option that has a value. */
static void set_option(options *chosen, const char *option, const char *value) {
    picture_job *job = &chosen->job;
    if (value == NULL) refuse("%s wants a value", option);
    if (strcmp(option, "-o") == 0 || strcmp(option, "--output") == 0) {
        chosen->output = value;
    } else if (strcmp(option, "--kind") == 0) {
        set_kind(job, value);
    } else if (strcmp(option, "--method") == 0) {
        set_methods(job, value);
    } else if (strcmp(option, "--size") == 0) {
        set_size(job, value);
    } else if (strcmp(option, "--samples") == 0) {
        chosen->samples = (int)integer_of(value, option, 1, picture_largest_samples);
    } else if (strcmp(option, "--budget") == 0) {
        job->budget = (uint32_t)integer_of(value, option, 1, 1000000);
    } else if (strcmp(option, "--epsilon") == 0) {
        job->epsilon = positive_of(value, option);
    } else if (strcmp(option, "--lanes") == 0) {
        job->max_lanes = lanes_of(value);
    } else {
        chosen->gallery = value;
    }
}

static int takes_value(const char *option) {
    static const char *const names[] = {"-o",      "--output",  "--kind",   "--method",
                                        "--size",  "--samples", "--budget", "--epsilon",
                                        "--lanes", "--gallery"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        if (strcmp(option, names[i]) == 0) return 1;
    }
    return 0;
}

/* Refuses what cannot become a picture before anything is traced. */
static void check_job(options *chosen) {
    picture_job *job = &chosen->job;
    if (job->shown == NULL) refuse("which scene?");
    for (int i = 0; i < job->panels; ++i) {
        if (!step_rule_allowed(job->methods[i], job->shown->flags)) {
            refuse("the field of scene '%s' is not convex, which rule 'convex' needs",
                   job->shown->name);
        }
    }
    if (chosen->output == NULL) {
        snprintf(chosen->default_output, sizeof chosen->default_output, "%s.png", job->shown->name);
        chosen->output = chosen->default_output;
    }
    if (!image_is_known(chosen->output)) {
        refuse("'%s' does not end in .png, .ppm or .pfm", chosen->output);
    }
    if (chosen->samples != 0) job->samples = chosen->samples;
    if (job->width * job->panels > image_largest_side - 64) refuse("the picture is too wide");
    job->numbers = image_is_float(chosen->output);
    if (!image_can_write(chosen->output)) {
        refuse("cannot write '%s': %s", chosen->output, strerror(errno));
    }
}

static void parse(options *chosen, int count, char **arguments) {
    chosen->job = picture_job_default(NULL);
    for (int i = 1; i < count; ++i) {
        const char *argument = arguments[i];
        if (strcmp(argument, "--help") == 0 || strcmp(argument, "-h") == 0) {
            fputs(usage, stdout);
            exit(0);
        } else if (strcmp(argument, "--list") == 0) {
            list_all();
            exit(0);
        } else if (strcmp(argument, "--no-cone") == 0) {
            chosen->job.pixel_cone = 0;
        } else if (takes_value(argument)) {
            ++i;
            set_option(chosen, argument, i < count ? arguments[i] : NULL);
        } else if (argument[0] == '-') {
            refuse("there is no option '%s'", argument);
        } else if (chosen->job.shown != NULL) {
            refuse("one scene at a time, not '%s' too", argument);
        } else {
            chosen->job.shown = scene_named(argument);
            if (chosen->job.shown == NULL) refuse("there is no scene '%s'; see --list", argument);
        }
    }
}

int main(int count, char **arguments) {
    options chosen;
    memset(&chosen, 0, sizeof chosen);
    parse(&chosen, count, arguments);
    const picture_job *job = &chosen.job;
    if (chosen.gallery != NULL) {
        if (job->shown != NULL)
            refuse("the gallery renders its own scenes, not '%s'", job->shown->name);
        return gallery_render(chosen.gallery, job->width, job->height,
                              chosen.samples != 0 ? chosen.samples : 3);
    }
    check_job(&chosen);
    spt_statistics statistics = spt_statistics_default();
    image picture = picture_render(job, job->shown->name, &statistics);
    if (picture.pixels == NULL) return 1;
    const int written = image_write(chosen.output, &picture) == 0;
    if (!written) {
        fprintf(stderr, "render: cannot write '%s'%s%s\n", chosen.output, errno != 0 ? ": " : "",
                errno != 0 ? strerror(errno) : "");
        image_free(&picture);
        return 1;
    }
    image_free(&picture);
    printf("%s: %llu rays, %.2f evaluations a ray, %llu hits, %llu undecided, %u lanes\n",
           chosen.output, (unsigned long long)statistics.rays,
           (double)statistics.evaluations / (double)statistics.rays,
           (unsigned long long)statistics.outcomes[SPT_HIT],
           (unsigned long long)statistics.outcomes[SPT_LIMIT], statistics.lanes);
    return 0;
}
