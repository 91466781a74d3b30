/* SPDX-License-Identifier: MIT
 *
 * Parsing of render's command line, and its help. */
#include "render_options.h"

#include "part_file.h"
#include "step_rules.h"
#include "workers.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "Usage: render [options] SCENE\n"
    "       render [options] --part K/N SCENE\n"
    "       render [-o FILE] --merge PART...\n"
    "       render [--size WxH] [--samples N] [--threads N] [--large] --gallery FOLDER\n"
    "Traces a picture of a scene.\n"
    "\n"
    "What is shown\n"
    "  -o, --output FILE   .png .ppm .pfm, and others if built with OpenImageIO; a .pfm holds the\n"
    "                      numbers themselves (default: SCENE.png)\n"
    "  --kind KIND         shaded, normal, heat (evaluations of the rays themselves), fallback\n"
    "                      (rejected probes), depth, outcome or kept (components a tile kept)\n"
    "                      (default: shaded)\n"
    "  --size WxH          pixels (default: 640x360)\n"
    "  --region X,Y,WxH    only that much of the picture, from its upper left corner\n"
    "  --samples N         N x N samples a pixel, 1 to 8 (default: 2, in the gallery 3)\n"
    "  --shadows, --no-shadows\n"
    "                      whether the sun casts them (default: it does)\n"
    "\n"
    "How it is traced\n"
    "  --whole             the scene as one field, not as a union of its objects\n"
    "  --no-cones          rays start at the camera\n"
    "  --no-culling        tiles leave no component out\n"
    "  --method RULE[,..]  step rules, side by side (default: adaptive). In a union the convex\n"
    "                      objects are always traced by rule 'convex'; compare rules with --whole\n"
    "  --budget N          most evaluations a ray, and the end of the heat scale (default: 128)\n"
    "  --epsilon X         absolute tolerance, world length (default: 0.0001)\n"
    "  --to-epsilon        trace down to epsilon instead of to half a pixel\n"
    "  --lanes N           no wider than 1, 4, 8 or 16 (default: the widest there is)\n"
    "  --threads N         (default: the number of processors). The picture is the same for any\n"
    "\n"
    "A picture in parts, each traced by another process or machine\n"
    "  --part K/N          the K-th of N parts, into a file that is no picture yet (default:\n"
    "                      SCENE_K_of_N.part)\n"
    "  --merge             put parts together: the same picture, byte for byte, as without parts\n"
    "\n"
    "  --gallery FOLDER    render the whole gallery; with --large also the large pictures\n"
    "  --list              list scenes and step rules\n"
    "  --help              print this\n"
    "\n"
    "Ctrl-C ends the tracing, writes what is there (the rest is black) and gives status 130.\n"
    "Exit status: 0; 1 if a picture failed; 2 for a bad command line, parts that do not belong\n"
    "together, or a file that cannot be written.\n";

void render_refuse(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fputs("render: ", stderr);
    vfprintf(stderr, format, arguments);
    fputs("\nTry render --help.\n", stderr);
    va_end(arguments);
    exit(2);
}

/* ---- One function an option ---------------------------------------------------------------- */

/* The command line as far as it was read. */
typedef struct parsing {
    render_options chosen;
    uint32_t tile_flags;
    const char *region; /* until the size is known */
} parsing;

static void take_help(parsing *state, const char *unused) {
    (void)state, (void)unused;
    fputs(usage, stdout);
    exit(0);
}

static void take_list(parsing *state, const char *unused) {
    (void)state, (void)unused;
    printf("Scenes:\n");
    for (size_t i = 0; i < scene_count; ++i) {
        printf("  %-18s %s\n", scenes[i]->name, scenes[i]->description);
    }
    printf("Step rules:\n");
    for (size_t i = 0; step_rule(i) != NULL; ++i) printf("  %s\n", spt_method_name(step_rule(i)));
    exit(0);
}

static long integer_of(const char *text, const char *option, long low, long high) {
    char *end = NULL;
    errno = 0;
    const long value = strtol(text, &end, 10);
    if (end == text || *end != '\0' || errno != 0 || value < low || value > high) {
        render_refuse("%s wants a whole number from %ld to %ld, not '%s'", option, low, high, text);
    }
    return value;
}

static void take_output(parsing *state, const char *value) {
    state->chosen.output = value;
}

static void take_gallery(parsing *state, const char *value) {
    state->chosen.gallery = value;
}

static void take_large(parsing *state, const char *unused) {
    (void)unused;
    state->chosen.large = 1;
}

static void take_merge(parsing *state, const char *unused) {
    (void)unused;
    state->chosen.merge = 1;
}

static void take_part(parsing *state, const char *value) {
    render_options *chosen = &state->chosen;
    int end = 0;
    if (sscanf(value, "%5d/%5d%n", &chosen->part, &chosen->of, &end) != 2 || value[end] != '\0' ||
        chosen->part < 1 || chosen->of > part_most || chosen->part > chosen->of) {
        render_refuse("--part wants K/N with 1 <= K <= N <= %d, not '%s'", part_most, value);
    }
}

static void take_threads(parsing *state, const char *value) {
    state->chosen.threads = (int)integer_of(value, "--threads", 1, 1024);
}

static void take_kind(parsing *state, const char *value) {
    for (int kind = 0; kind < picture_kinds; ++kind) {
        if (strcmp(picture_kind_names[kind], value) == 0) {
            state->chosen.job.kind = (picture_kind)kind;
            return;
        }
    }
    render_refuse("there is no kind '%s'", value);
}

static void take_methods(parsing *state, const char *value) {
    picture_job *job = &state->chosen.job;
    job->panel_count = 0;
    for (const char *name = value;; ++name) {
        char single[32];
        const size_t length = strcspn(name, ",");
        if (job->panel_count == picture_panels) {
            render_refuse("at most %d step rules", picture_panels);
        }
        snprintf(single, sizeof single, "%.*s", (int)length, name);
        const spt_method *method = length < sizeof single ? step_rule_named(single) : NULL;
        if (method == NULL) render_refuse("there is no step rule '%.*s'", (int)length, name);
        job->panels[job->panel_count++].method = method;
        name += length;
        if (*name == '\0') return;
    }
}

static void take_size(parsing *state, const char *value) {
    const int most = image_largest_side - 64; /* a legend fits below */
    int end = 0, width, height;
    if (sscanf(value, "%5dx%5d%n", &width, &height, &end) != 2 || value[end] != '\0' || width < 1 ||
        height < 1 || width > most || height > most) {
        render_refuse("--size wants WIDTHxHEIGHT, each from 1 to %d, not '%s'", most, value);
    }
    picture_set_size(&state->chosen.job, width, height);
}

static void take_region(parsing *state, const char *value) {
    state->region = value;
}

static void take_samples(parsing *state, const char *value) {
    state->chosen.samples = (int)integer_of(value, "--samples", 1, picture_largest_samples);
}

static void take_budget(parsing *state, const char *value) {
    state->chosen.job.budget = (uint32_t)integer_of(value, "--budget", 1, 1000000);
}

static void take_epsilon(parsing *state, const char *value) {
    char *end = NULL;
    const float epsilon = strtof(value, &end);
    if (end == value || *end != '\0' || !(epsilon > 0.0f) || !(epsilon < INFINITY)) {
        render_refuse("--epsilon wants a number above 0, not '%s'", value);
    }
    state->chosen.job.epsilon = epsilon;
}

static void take_lanes(parsing *state, const char *value) {
    const long lanes = integer_of(value, "--lanes", 1, 16);
    if (lanes != 1 && lanes != 4 && lanes != 8 && lanes != 16) {
        render_refuse("--lanes wants 1, 4, 8 or 16, not '%s'", value);
    }
    state->chosen.job.max_lanes = (uint32_t)lanes;
}

static void take_shadows(parsing *state, const char *unused) {
    (void)unused;
    state->chosen.job.shadows = 1;
}

static void take_no_shadows(parsing *state, const char *unused) {
    (void)unused;
    state->chosen.job.shadows = 0;
}

static void take_whole(parsing *state, const char *unused) {
    (void)unused;
    state->chosen.job.whole = 1;
}

static void take_no_cones(parsing *state, const char *unused) {
    (void)unused;
    state->tile_flags |= SPT_FRAME_NO_CONES;
}

static void take_no_culling(parsing *state, const char *unused) {
    (void)unused;
    state->tile_flags |= SPT_FRAME_NO_CULLING;
}

static void take_to_epsilon(parsing *state, const char *unused) {
    (void)unused;
    state->chosen.job.pixel_cone = 0;
}

/* ---- All of them --------------------------------------------------------------------------- */

typedef struct option {
    const char *name;
    int has_value;
    void (*take)(parsing *state, const char *value);
    int of_merge, of_gallery; /* whether it says anything there */
} option;

static const option options[] = {
    {"-o", 1, take_output, 1, 0},
    {"--output", 1, take_output, 1, 0},
    {"--kind", 1, take_kind, 0, 0},
    {"--size", 1, take_size, 0, 1},
    {"--region", 1, take_region, 0, 0},
    {"--samples", 1, take_samples, 0, 1},
    {"--shadows", 0, take_shadows, 0, 0},
    {"--no-shadows", 0, take_no_shadows, 0, 0},
    {"--whole", 0, take_whole, 0, 0},
    {"--no-cones", 0, take_no_cones, 0, 0},
    {"--no-culling", 0, take_no_culling, 0, 0},
    {"--method", 1, take_methods, 0, 0},
    {"--budget", 1, take_budget, 0, 0},
    {"--epsilon", 1, take_epsilon, 0, 0},
    {"--to-epsilon", 0, take_to_epsilon, 0, 0},
    {"--lanes", 1, take_lanes, 0, 0},
    {"--threads", 1, take_threads, 0, 1},
    {"--part", 1, take_part, 0, 0},
    {"--merge", 0, take_merge, 1, 0},
    {"--gallery", 1, take_gallery, 0, 1},
    {"--large", 0, take_large, 0, 1},
    {"--list", 0, take_list, 1, 1},
    {"--help", 0, take_help, 1, 1},
    {"-h", 0, take_help, 1, 1},
};
enum { option_count = sizeof options / sizeof options[0] };

static const option *option_named(const char *name) {
    for (size_t i = 0; i < option_count; ++i) {
        if (strcmp(options[i].name, name) == 0) return &options[i];
    }
    render_refuse("there is no option '%s'", name);
}

static void set_region(picture_job *job, const char *text) {
    int end = 0, left, top, width, height;
    if (sscanf(text, "%5d,%5d,%5dx%5d%n", &left, &top, &width, &height, &end) != 4 ||
        text[end] != '\0' || left < 0 || top < 0 || width < 1 || height < 1 ||
        left + width > job->width || top + height > job->height) {
        render_refuse("--region wants LEFT,TOP,WIDTHxHEIGHT inside %dx%d, not '%s'", job->width,
                      job->height, text);
    }
    job->left = left;
    job->top = top;
    job->right = left + width;
    job->bottom = top + height;
}

/* What the words that are no options mean. */
static void take_words(render_options *chosen) {
    if (chosen->merge) {
        if (chosen->word_count == 0) render_refuse("--merge wants the files of the parts");
    } else if (chosen->gallery != NULL) {
        if (chosen->word_count > 0) {
            render_refuse("the gallery renders its own scenes, not '%s'", chosen->words[0]);
        }
    } else {
        if (chosen->word_count == 0) render_refuse("which scene?");
        if (chosen->word_count > 1) {
            render_refuse("one scene at a time, not '%s' too", chosen->words[1]);
        }
        chosen->job.shown = scene_named(chosen->words[0]);
        if (chosen->job.shown == NULL) {
            render_refuse("there is no scene '%s'; see --list", chosen->words[0]);
        }
    }
}

render_options render_options_of(int count, char **arguments) {
    parsing state;
    memset(&state, 0, sizeof state);
    render_options *chosen = &state.chosen;
    chosen->job = picture_job_default(NULL);
    chosen->threads = workers_processors();
    chosen->words = arguments;
    const char *no_merge = NULL, *no_gallery = NULL;
    for (int i = 1; i < count; ++i) {
        char *argument = arguments[i];
        if (argument[0] != '-') {
            chosen->words[chosen->word_count++] = argument;
            continue;
        }
        const option *given = option_named(argument);
        if (given->has_value && ++i == count) render_refuse("%s wants a value", argument);
        given->take(&state, given->has_value ? arguments[i] : NULL);
        if (!given->of_merge) no_merge = argument;
        if (!given->of_gallery) no_gallery = argument;
    }
    if (chosen->merge && no_merge != NULL) {
        render_refuse("--merge takes all from the parts and has no use for %s", no_merge);
    }
    if (chosen->gallery != NULL && no_gallery != NULL) {
        render_refuse("--gallery has no use for %s", no_gallery);
    }
    if (chosen->large && chosen->gallery == NULL) render_refuse("--large is for --gallery");
    take_words(chosen);
    if (state.region != NULL) set_region(&chosen->job, state.region);
    if (chosen->samples != 0) chosen->job.samples = chosen->samples;
    for (int i = 0; i < chosen->job.panel_count; ++i)
        chosen->job.panels[i].flags = state.tile_flags;
    return *chosen;
}
