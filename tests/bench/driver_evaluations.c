/* SPDX-License-Identifier: MIT
 *
 * How many evaluations a ray the step rules need, over ten kinds of field and with two stops, and
 * whether any of them loses a surface. Counts, not times: the same on every machine. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "bench_scenes.h"
#include "truth.h"

static const char *const kinds[] = {"sphere",     "box",           "plane", "thin_torus",
                                    "hollow_box", "village_boxes", "slabs", "smooth_union",
                                    "bumpy_ball", "mandelbulb"};
enum { KINDS = sizeof kinds / sizeof kinds[0], STOPS = 2 };

static const char *const stops[STOPS] = {"half_pixel", "absolute"};

static const char *const rules[] = {
#define X(scene, method, convex) #method,
    BENCH_METHODS(X, any)
#undef X
};
enum { RULES = sizeof rules / sizeof rules[0] };

/* Sums of logarithms, for the geometric means. */
typedef struct evaluations_sum {
    double logarithms[STOPS][RULES];
    int scenes[STOPS][RULES];
} evaluations_sum;

typedef struct evaluations_picture {
    const scene *shown;
    spt_ray *rays;
    size_t count;
    float pixel_radius;
    bench_hit *hits;
    double *last_t;
} evaluations_picture;

static spt_settings settings_of(const evaluations_picture *picture, int stop, int rule) {
    spt_settings settings = bench_settings(rules[rule], stop == 0 ? picture->pixel_radius : 0, 0);
    settings.budget = 1000; /* the longest ray of these scenes needs some hundreds */
    return settings;
}

static void count_rule(FILE *file, const evaluations_picture *picture, int stop, int rule,
                       evaluations_sum *sum) {
    const spt_field field = scene_field(picture->shown, spt_lanes());
    const spt_settings settings = settings_of(picture, stop, rule);
    const spt_rays columns = spt_rays_of(picture->rays);
    const spt_hits sinks = bench_hits_of(picture->hits);
    spt_statistics statistics = spt_statistics_default();
    unsigned long lost = 0, late = 0;
    if (spt_trace(&field, &settings, picture->count, &columns, &sinks, &statistics) != SPT_OK) {
        fprintf(stderr, "%s: the trace was refused\n", picture->shown->name);
        exit(1);
    }
    for (size_t i = 0; i < picture->count; ++i) {
        lost += truth_lost(picture->last_t[i], &picture->hits[i]) != 0;
        late += truth_late(picture->last_t[i], &picture->hits[i]) != 0;
    }
    const double rays = (double)statistics.rays;
    const double each = (double)statistics.evaluations / rays;
    const unsigned long hits = (unsigned long)statistics.outcomes[SPT_HIT];
    const unsigned long limits = (unsigned long)statistics.outcomes[SPT_LIMIT];
    fprintf(file, "%s,%s,%s,%.4f,%.4f,%lu,%lu,%lu,%lu\n", picture->shown->name, stops[stop],
            rules[rule], each, (double)statistics.fallbacks / rays, hits, limits, lost, late);
    printf("%-15s%-12s%-13s%12.2f%12.3f%9lu%8lu%7lu%7lu\n", picture->shown->name, stops[stop],
           rules[rule], each, (double)statistics.fallbacks / rays, hits, limits, lost, late);
    sum->logarithms[stop][rule] += log(each);
    sum->scenes[stop][rule] += 1;
}

static void count_scene(const bench_options *options, FILE *file, const char *name,
                        evaluations_sum *sum) {
    evaluations_picture picture;
    picture.shown = scene_named(name);
    picture.count = (size_t)options->small_width * (size_t)options->small_height;
    picture.rays = malloc(picture.count * sizeof *picture.rays);
    picture.hits = malloc(picture.count * sizeof *picture.hits);
    picture.last_t = malloc(picture.count * sizeof *picture.last_t);
    if (picture.rays == NULL || picture.hits == NULL || picture.last_t == NULL) exit(1);
    scene_rays_tiled(picture.shown, options->small_width, options->small_height, picture.rays, NULL,
                     &picture.pixel_radius);
    for (int stop = 0; stop < STOPS; ++stop) {
        const spt_settings settings = settings_of(&picture, stop, 0);
        for (size_t i = 0; i < picture.count; ++i) {
            picture.last_t[i] = truth_last_t(picture.shown, &settings, &picture.rays[i]);
        }
        for (int rule = 0; rule < RULES; ++rule) {
            const int convex = strcmp(rules[rule], "convex") == 0;
            if (convex && !(picture.shown->flags & SPT_FIELD_CONVEX)) continue;
            count_rule(file, &picture, stop, rule, sum);
        }
    }
    free(picture.rays);
    free(picture.hits);
    free(picture.last_t);
}

static int rule_named(const char *name) {
    int rule = 0;
    while (strcmp(rules[rule], name) != 0) ++rule;
    return rule;
}

static void print_means(const evaluations_sum *sum) {
    const double target = 0.75; /* adaptive over basic */
    printf("\nGeometric means (convex: of the convex ones alone):\n");
    for (int stop = 0; stop < STOPS; ++stop) {
        double mean[RULES];
        printf("%-12s", stops[stop]);
        for (int rule = 0; rule < RULES; ++rule) {
            mean[rule] = exp(sum->logarithms[stop][rule] / sum->scenes[stop][rule]);
            printf("  %s %.2f", rules[rule], mean[rule]);
        }
        const double ratio = mean[rule_named("adaptive")] / mean[rule_named("basic")];
        printf("\n%-12s  adaptive / basic %.3f   target %.2f %s\n", "", ratio, target,
               ratio <= target ? "reached" : "NOT REACHED");
    }
}

void bench_evaluations(const bench_options *options) {
    FILE *file = bench_open(options, "evaluations.csv",
                            "scene,stop,method,evaluations_per_ray,fallbacks_per_ray,hits,limits,"
                            "lost,late");
    evaluations_sum sum;
    memset(&sum, 0, sizeof sum);
    printf("\nEvaluations of the step rules, %dx%d rays:\n%-15s%-12s%-13s%12s%12s%9s%8s%7s%7s\n",
           options->small_width, options->small_height, "scene", "stop", "method", "evals/ray",
           "fallbacks", "hits", "limits", "lost", "late");
    for (int i = 0; i < KINDS; ++i) count_scene(options, file, kinds[i], &sum);
    print_means(&sum);
    fclose(file);
}
