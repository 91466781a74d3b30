/* SPDX-License-Identifier: MIT
 *
 * Traces the panels of a picture and lays them out. Shading is in shade.c, palettes in heat.c. */
#include "picture.h"

#include "heat.h"
#include "progress.h"
#include "shade.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const picture_kind_names[picture_kinds] = {"shaded",   "normal", "heat",
                                                       "fallback", "depth",  "outcome"};

enum { gap = 4 }; /* pixels between panels */

/* The frame that is being traced, finer than the picture by the samples a side. */
typedef struct frame {
    const picture_job *job;
    spt_settings settings;
    spt_field field;
    shading shader;
    int samples, width, height; /* width and height count samples */
    size_t count;
    spt_ray *rays;  /* by tiles */
    size_t *places; /* of each ray in the frame */
} frame;

picture_job picture_job_default(const scene *shown) {
    const spt_settings settings = spt_settings_default();
    picture_job job;
    memset(&job, 0, sizeof job);
    job.shown = shown;
    job.methods[0] = settings.method;
    job.panels = 1;
    job.width = 640;
    job.height = 360;
    job.samples = 2;
    job.budget = settings.budget;
    job.epsilon = settings.epsilon;
    job.pixel_cone = 1;
    return job;
}

static int is_averaged(picture_kind kind) {
    return kind == PICTURE_SHADED || kind == PICTURE_NORMAL;
}

static void frame_free(frame *traced) {
    free(traced->rays);
    free(traced->places);
    shader_free(&traced->shader);
}

/* The scene, seen as its look asks for. */
static scene framed(const scene *shown) {
    scene result = *shown;
    const look *chosen = look_of(shown->name);
    if (chosen->field_of_view > 0.0f) {
        result.field_of_view = (double)chosen->field_of_view;
        for (int axis = 0; axis < 3; ++axis) {
            result.eye[axis] = (double)chosen->eye[axis];
            result.target[axis] = (double)chosen->target[axis];
        }
    }
    return result;
}

/* Returns 0 where memory ran out. */
static int frame_create(const picture_job *job, spt_statistics *shadow_statistics, frame *traced) {
    memset(traced, 0, sizeof *traced);
    traced->job = job;
    traced->samples = is_averaged(job->kind) ? job->samples : 1;
    traced->width = job->width * traced->samples;
    traced->height = job->height * traced->samples;
    traced->count = (size_t)traced->width * (size_t)traced->height;
    traced->rays = malloc(traced->count * sizeof *traced->rays);
    traced->places = malloc(traced->count * sizeof *traced->places);
    if (traced->rays == NULL || traced->places == NULL) return 0;
    const scene shown = framed(job->shown);
    float pixel_radius = 0.0f;
    scene_rays_tiled(&shown, traced->width, traced->height, traced->rays, traced->places,
                     &pixel_radius);
    traced->field = shade_field(&shown, job->max_lanes);
    traced->settings = spt_settings_default();
    traced->settings.budget = job->budget;
    traced->settings.epsilon = job->epsilon;
    traced->settings.pixel_radius = job->pixel_cone ? pixel_radius : 0.0f;
    traced->settings.max_lanes = job->max_lanes;
    traced->shader = shader_create(&shown, job->epsilon, pixel_radius, traced->samples,
                                   job->max_lanes, shadow_statistics);
    if (job->kind == PICTURE_SHADED) shade_cut_rays(&traced->shader, traced->count, traced->rays);
    return traced->shader.batch != NULL;
}

/* Adds the colours of some rays to the pixels they belong to. */
static void add_colours(const frame *traced, image *panel, size_t count, const size_t *places,
                        const float (*colours)[3]) {
    const int samples = traced->samples;
    const float weight = 1.0f / (float)(samples * samples);
    for (size_t i = 0; i < count; ++i) {
        const int x = (int)(places[i] % (size_t)traced->width);
        const int y = (int)(places[i] / (size_t)traced->width);
        float *pixel = image_at(panel, x / samples, y / samples);
        for (int c = 0; c < 3; ++c) pixel[c] += weight * colours[i][c];
    }
}

/* Which part of the sun each sample sees: in a pixel every part once, and neighbours in a row or a
 * column see parts far apart. */
static void sun_parts(const frame *traced, size_t count, const size_t *places, int *part) {
    const int samples = traced->samples;
    for (size_t i = 0; i < count; ++i) {
        const int x = (int)(places[i] % (size_t)traced->width) % samples;
        const int y = (int)(places[i] / (size_t)traced->width) % samples;
        part[i] = (x + 2 * y) % samples * samples + (x + y) % samples;
    }
}

static void normals_of(const frame *traced, size_t count, const spt_ray *rays, const spt_hit *hits,
                       float (*colours)[3]) {
    float points[SPT_BATCH][3], scale[SPT_BATCH], normals[SPT_BATCH][3];
    for (size_t i = 0; i < count; ++i) {
        const float t = hits[i].outcome == SPT_HIT ? hits[i].t : 0.0f;
        scale[i] = traced->shader.pixel_radius * t;
        for (int axis = 0; axis < 3; ++axis) {
            points[i][axis] = rays[i].origin[axis] + t * rays[i].direction[axis];
        }
    }
    shade_normals(&traced->shader, count, (const float(*)[3])points, scale, normals);
    for (size_t i = 0; i < count; ++i) {
        const int hit = hits[i].outcome == SPT_HIT;
        for (int axis = 0; axis < 3; ++axis) {
            const float n = hit ? normals[i][axis] : 0.0f;
            /* Numbers that only look like a colour: the writer's curve must give them back. */
            colours[i][axis] =
                traced->job->numbers ? n : image_linear(hit ? 0.5f + 0.5f * n : 0.09f);
        }
    }
}

static float number_of(picture_kind kind, const spt_hit *hit) {
    switch (kind) {
    case PICTURE_HEAT:
        return (float)hit->evaluations;
    case PICTURE_FALLBACK: {
        /* Each step is one evaluation, or two where the probe before it was rejected; the first
         * evaluation is at the start. */
        const float steps = (float)hit->evaluations - 1.0f - (float)hit->fallbacks;
        if (hit->fallbacks == 0) return 0.0f;
        return steps > (float)hit->fallbacks ? (float)hit->fallbacks / steps : 1.0f;
    }
    case PICTURE_DEPTH:
        return hit->outcome == SPT_HIT ? hit->t : (float)INFINITY;
    default:
        return (float)hit->outcome;
    }
}

/* One chunk of at most SPT_BATCH rays. Returns 0 where the library refused. */
static int trace_chunk(const frame *traced, size_t first, size_t count, image *panel,
                       spt_statistics *statistics) {
    const picture_kind kind = traced->job->kind;
    const spt_ray *rays = traced->rays + first;
    const size_t *places = traced->places + first;
    spt_hit hits[SPT_BATCH];
    float colours[SPT_BATCH][3];
    int part[SPT_BATCH];
    const spt_rays ray_views = spt_rays_of(rays);
    const spt_hits hit_views = spt_hits_of(hits);
    const spt_status status =
        spt_trace(&traced->field, &traced->settings, count, &ray_views, &hit_views, statistics);
    if (status != SPT_OK) {
        fprintf(stderr, "the library refused: %s\n", spt_status_name(status));
        return 0;
    }
    if (kind == PICTURE_SHADED) {
        sun_parts(traced, count, places, part);
        shade_rays(&traced->shader, count, rays, hits, part, colours);
        add_colours(traced, panel, count, places, (const float(*)[3])colours);
    } else if (kind == PICTURE_NORMAL) {
        normals_of(traced, count, rays, hits, colours);
        add_colours(traced, panel, count, places, (const float(*)[3])colours);
    } else {
        for (size_t i = 0; i < count; ++i) panel->pixels[places[i]] = number_of(kind, &hits[i]);
    }
    return 1;
}

/* ---- Layout -------------------------------------------------------------------------------- */

static const char *const outcome_names[SPT_OUTCOMES] = {"miss", "hit", "limit", "non-finite",
                                                        "bad ray"};
static const float outcome_colours[SPT_OUTCOMES][3] = {{0.02f, 0.03f, 0.06f},
                                                       {0.50f, 0.58f, 0.62f},
                                                       {0.95f, 0.40f, 0.03f},
                                                       {0.90f, 0.02f, 0.75f},
                                                       {0.80f, 0.01f, 0.01f}};

static int has_legend(const picture_job *job) {
    return !job->numbers && (job->kind == PICTURE_HEAT || job->kind == PICTURE_FALLBACK ||
                             job->kind == PICTURE_OUTCOME);
}

static void draw_legend(const picture_job *job, const spt_method *method,
                        const spt_statistics *statistics, image *picture, int left) {
    const char *name = spt_method_name(method);
    const double rays = (double)statistics->rays;
    const int top = job->height, width = job->width;
    char title[100];
    if (job->kind == PICTURE_HEAT) {
        snprintf(title, sizeof title, "%s: evaluations a ray, %.2f on average", name,
                 (double)statistics->evaluations / rays);
        heat_legend(picture, left, top, width, title, (double)job->budget, "");
    } else if (job->kind == PICTURE_FALLBACK) {
        snprintf(title, sizeof title, "%s: steps taken back, %.2f a ray", name,
                 (double)statistics->fallbacks / rays);
        heat_legend(picture, left, top, width, title, 100.0, " %");
    } else {
        static const float black[3] = {0.0f, 0.0f, 0.0f};
        int x = left + 6;
        heat_fill(picture, left, top, width, heat_legend_height, black);
        for (int outcome = 0; outcome < SPT_OUTCOMES; ++outcome) {
            const float *colour = outcome_colours[outcome];
            snprintf(title, sizeof title, "%s %.2f%%", outcome_names[outcome],
                     100.0 * (double)statistics->outcomes[outcome] / rays);
            heat_fill(picture, x, top + 13, 9, 9, colour);
            heat_text(picture, x + 13, top + 14, title, outcome_colours[SPT_HIT]);
            x += 13 + heat_text_width(title) + 12;
        }
    }
}

/* The nearest and farthest number that is finite. */
static void range_of(const image *panel, float *nearest, float *farthest) {
    *nearest = INFINITY;
    *farthest = 0.0f;
    for (size_t i = 0; i < (size_t)panel->width * (size_t)panel->height; ++i) {
        const float t = panel->pixels[i];
        if (t < *nearest) *nearest = t;
        if (t < INFINITY && t > *farthest) *farthest = t;
    }
}

/* The colours of a panel's numbers. */
static void colour_panel(const picture_job *job, const image *panel, image *picture, int left) {
    float nearest, farthest;
    range_of(panel, &nearest, &farthest);
    for (int y = 0; y < panel->height; ++y) {
        for (int x = 0; x < panel->width; ++x) {
            const float number = *image_at(panel, x, y);
            float *rgb = image_at(picture, left + x, y);
            if (job->kind == PICTURE_HEAT) {
                heat_colour(number / (float)job->budget, rgb);
            } else if (job->kind == PICTURE_FALLBACK) {
                heat_colour(number, rgb);
            } else if (job->kind == PICTURE_OUTCOME) {
                memcpy(rgb, outcome_colours[(int)number], 3 * sizeof *rgb);
            } else if (number < INFINITY) {
                /* Steps in 1/t look even: near things differ more. */
                const float range = 1.0f / nearest - 1.0f / farthest;
                const float share = range > 0.0f ? (1.0f / number - 1.0f / farthest) / range : 1.0f;
                rgb[0] = rgb[1] = rgb[2] = image_linear(0.12f + 0.86f * share);
            }
        }
    }
}

static void paste_panel(const image *panel, image *picture, int left) {
    const size_t row = (size_t)panel->width * (size_t)panel->channels * sizeof(float);
    for (int y = 0; y < panel->height; ++y) {
        memcpy(image_at(picture, left, y), image_at(panel, 0, y), row);
    }
}

/* Traces one panel and puts it in its place. Returns 0 after a message. */
static int render_panel(frame *traced, int index, image *panel, image *picture, progress *bar,
                        spt_statistics *statistics) {
    const picture_job *job = traced->job;
    const int left = index * (job->width + (job->numbers ? 0 : gap));
    spt_statistics of_panel = spt_statistics_default();
    traced->settings.method = job->methods[index];
    memset(panel->pixels, 0,
           (size_t)panel->width * (size_t)panel->height * (size_t)panel->channels * sizeof(float));
    for (size_t first = 0; first < traced->count; first += SPT_BATCH) {
        const size_t left_over = traced->count - first;
        const size_t count = left_over < SPT_BATCH ? left_over : SPT_BATCH;
        if (!trace_chunk(traced, first, count, panel, &of_panel)) return 0;
        progress_show(bar, (size_t)index * traced->count + first + count);
    }
    if (job->numbers || is_averaged(job->kind)) {
        paste_panel(panel, picture, left);
    } else {
        colour_panel(job, panel, picture, left);
    }
    if (has_legend(job)) draw_legend(job, job->methods[index], &of_panel, picture, left);
    statistics->rays += of_panel.rays;
    statistics->evaluations += of_panel.evaluations;
    statistics->fallbacks += of_panel.fallbacks;
    statistics->lanes = of_panel.lanes;
    for (int i = 0; i < SPT_OUTCOMES; ++i) statistics->outcomes[i] += of_panel.outcomes[i];
    return 1;
}

image picture_render(const picture_job *job, const char *label, spt_statistics *statistics) {
    const int channels = is_averaged(job->kind) ? 3 : 1;
    const int space = job->numbers ? 0 : gap * (job->panels - 1);
    const int legend = has_legend(job) ? heat_legend_height : 0;
    spt_statistics of_shadows = spt_statistics_default();
    frame traced;
    image panel = image_create(job->width, job->height, channels);
    image picture = image_create(job->width * job->panels + space, job->height + legend,
                                 job->numbers ? channels : 3);
    int done =
        frame_create(job, &of_shadows, &traced) && panel.pixels != NULL && picture.pixels != NULL;
    if (!done) fprintf(stderr, "out of memory\n");
    progress bar = progress_start(label, traced.count * (size_t)job->panels);
    for (int index = 0; done && index < job->panels; ++index) {
        done = render_panel(&traced, index, &panel, &picture, &bar, statistics);
    }
    frame_free(&traced);
    image_free(&panel);
    if (!done) image_free(&picture);
    return picture;
}
