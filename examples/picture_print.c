/* SPDX-License-Identifier: MIT
 *
 * From the film to the picture: panels side by side, colours for numbers, legends. Palettes are in
 * heat.c. */
#include "heat.h"
#include "picture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { gap = 4 }; /* pixels between panels */

static const char *const outcome_names[SPT_OUTCOMES] = {"miss", "hit", "limit", "non-finite",
                                                        "bad ray"};
static const float outcome_colours[SPT_OUTCOMES][3] = {{0.02f, 0.03f, 0.06f},
                                                       {0.50f, 0.58f, 0.62f},
                                                       {0.95f, 0.40f, 0.03f},
                                                       {0.90f, 0.02f, 0.75f},
                                                       {0.80f, 0.01f, 0.01f}};

/* What the numbers of a panel are shown against. */
typedef struct scale {
    float nearest, farthest; /* depth */
    float largest;           /* heat, kept */
    double tiles;            /* that were traced */
} scale;

static int has_legend(picture_kind kind) {
    return !picture_is_averaged(kind) && kind != PICTURE_DEPTH;
}

/* ---- Legends ------------------------------------------------------------------------------- */

static void outcome_legend(const spt_statistics *statistics, image *picture, int left, int top,
                           int width) {
    static const float black[3] = {0.0f, 0.0f, 0.0f};
    char title[100];
    int x = left + 6;
    heat_fill(picture, left, top, width, heat_legend_height, black);
    for (int outcome = 0; outcome < SPT_OUTCOMES; ++outcome) {
        const double share = (double)statistics->outcomes[outcome] / (double)statistics->rays;
        snprintf(title, sizeof title, "%s %.2f%%", outcome_names[outcome], 100.0 * share);
        heat_fill(picture, x, top + 13, 9, 9, outcome_colours[outcome]);
        heat_text(picture, x + 13, top + 14, title, outcome_colours[SPT_HIT]);
        x += 13 + heat_text_width(title) + 12;
    }
}

static void draw_legend(const film *exposed, int index, const scale *shown, image *picture,
                        int left) {
    const picture_job *job = &exposed->job;
    const picture_panel *panel = &job->panels[index];
    const spt_statistics *statistics = &exposed->statistics[index];
    const char *name = spt_method_name(panel->method);
    const double rays = (double)statistics->rays;
    const int top = job->bottom - job->top, width = job->right - job->left;
    char title[160];
    if (job->kind == PICTURE_OUTCOME) {
        outcome_legend(statistics, picture, left, top, width);
    } else if (job->kind == PICTURE_FALLBACK) {
        snprintf(title, sizeof title, "%s: steps taken back, %.2f a ray", name,
                 (double)statistics->fallbacks / rays);
        heat_legend(picture, left, top, width, title, 100.0, " %");
    } else if (job->kind == PICTURE_KEPT) {
        const double all = (double)(statistics->kept + statistics->culled);
        snprintf(title, sizeof title, "components that a tile kept, %.2f on average of %.0f",
                 (double)statistics->kept / shown->tiles, all / shown->tiles);
        heat_legend(picture, left, top, width, title, (double)shown->largest, "");
    } else if ((panel->flags & SPT_FRAME_NO_CONES) != 0) {
        snprintf(title, sizeof title, "%s, no cones: evaluations a ray, %.2f on average", name,
                 (double)statistics->evaluations / rays);
        heat_legend(picture, left, top, width, title, (double)shown->largest, "");
    } else {
        snprintf(title, sizeof title,
                 "%s: evaluations of the ray itself, %.2f on average, and %.2f of cones", name,
                 (double)statistics->evaluations / rays,
                 (double)statistics->cone_evaluations / rays);
        heat_legend(picture, left, top, width, title, (double)shown->largest, "");
    }
}

/* ---- Colours ------------------------------------------------------------------------------- */

/* The nearest and farthest number that is finite, and the end of the palette. */
static scale scale_of(const film *exposed, int panel) {
    const picture_job *job = &exposed->job;
    scale result = {INFINITY, 0.0f, (float)job->budget, 0.0};
    for (size_t piece = exposed->first; piece < exposed->end; ++piece) {
        int area[4];
        if (!exposed->done[piece - exposed->first]) continue;
        if (picture_piece_area(job, piece, area) != panel) continue;
        result.tiles += 1.0;
        const float *values = film_piece(exposed, piece);
        const int count = (area[2] - area[0]) * (area[3] - area[1]);
        for (int i = 0; i < count; ++i) {
            const float value = values[i * exposed->channels];
            if (value < result.nearest) result.nearest = value;
            if (value < INFINITY && value > result.farthest) result.farthest = value;
        }
    }
    /* Whole numbers at the five marks of the legend. */
    if (job->kind == PICTURE_KEPT) result.largest = 4.0f * ceilf(fmaxf(result.farthest, 1) / 4.0f);
    return result;
}

static void colour_of(picture_kind kind, const scale *shown, const float *value, float rgb[3]) {
    const float number = value[0];
    switch (kind) {
    case PICTURE_SHADED:
        memcpy(rgb, value, 3 * sizeof *rgb);
        break;
    case PICTURE_NORMAL:
        /* Numbers that only look like a colour: the writer's curve must give them back. */
        for (int axis = 0; axis < 3; ++axis) {
            rgb[axis] = image_linear(0.5f * (value[3] + value[axis]) + 0.09f * (1.0f - value[3]));
        }
        break;
    case PICTURE_FALLBACK:
        heat_colour(number, rgb);
        break;
    case PICTURE_OUTCOME:
        memcpy(rgb, outcome_colours[(int)number], 3 * sizeof *rgb);
        break;
    case PICTURE_DEPTH:
        if (number < INFINITY) {
            /* Steps in 1/t look even: near things differ more. */
            const float range = 1.0f / shown->nearest - 1.0f / shown->farthest;
            const float share =
                range > 0.0f ? (1.0f / number - 1.0f / shown->farthest) / range : 1.0f;
            rgb[0] = rgb[1] = rgb[2] = image_linear(0.12f + 0.86f * share);
        }
        break;
    default:
        heat_colour(number / shown->largest, rgb);
    }
}

static void print_piece(const film *exposed, size_t piece, int numbers, const scale *scales,
                        image *picture) {
    const picture_job *job = &exposed->job;
    const float *value = film_piece(exposed, piece);
    int area[4];
    const int panel = picture_piece_area(job, piece, area);
    const int left = panel * (job->right - job->left + (numbers ? 0 : gap)) - job->left;
    for (int y = area[1]; y < area[3]; ++y) {
        for (int x = area[0]; x < area[2]; ++x) {
            float *pixel = image_at(picture, left + x, y - job->top);
            if (numbers) {
                memcpy(pixel, value, (size_t)picture->channels * sizeof *pixel);
            } else {
                colour_of(job->kind, &scales[panel], value, pixel);
            }
            value += exposed->channels;
        }
    }
}

image film_print(const film *exposed, int numbers) {
    const picture_job *job = &exposed->job;
    const int width = job->right - job->left, height = job->bottom - job->top;
    const int space = numbers ? 0 : gap * (job->panel_count - 1);
    const int legend = !numbers && has_legend(job->kind) ? heat_legend_height : 0;
    const int channels = !numbers || picture_is_averaged(job->kind) ? 3 : 1;
    image picture = image_create(width * job->panel_count + space, height + legend, channels);
    scale scales[picture_panels];
    if (picture.pixels == NULL) return picture;
    for (int panel = 0; panel < job->panel_count; ++panel) scales[panel] = scale_of(exposed, panel);
    for (size_t piece = exposed->first; piece < exposed->end; ++piece) {
        if (exposed->done[piece - exposed->first]) {
            print_piece(exposed, piece, numbers, scales, &picture);
        }
    }
    for (int panel = 0; panel < job->panel_count && legend != 0; ++panel) {
        if (exposed->statistics[panel].rays == 0) continue;
        draw_legend(exposed, panel, &scales[panel], &picture, panel * (width + gap));
    }
    return picture;
}
