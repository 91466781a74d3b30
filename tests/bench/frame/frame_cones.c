/* SPDX-License-Identifier: MIT
 *
 * How many evaluations a pixel cones save, for every scene: of the scene in one piece, and of its
 * components where it is traced lazily and culled. Counts, not times: the same on every machine. */
#include <stdlib.h>
#include <string.h>

#include "frame_bench.h"

static const char *const rules[] = {"basic", "adaptive", "convex"};
enum { RULES = sizeof rules / sizeof rules[0], JUDGED_RULES = 2, MOST_SCENES = 64 };

typedef struct cones_counted {
    double without, with;           /* cones; the scene in one piece */
    double lazy_without, lazy_with; /* the same of its components */
} cones_counted;

static double count(const frame_picture *picture, const frame_way *way, const char *rule) {
    frame_tracer *const tracer = frame_tracer_of(picture, way, rule, 0);
    const spt_statistics statistics = frame_tracer_count(tracer, picture);
    frame_tracer_free(tracer);
    return frame_evaluations(&statistics, picture);
}

static cones_counted count_all(const frame_picture *picture, const char *rule) {
    static const frame_way whole = {SCENE_WHOLE, 0, 1}, whole_cones = {SCENE_WHOLE, 1, 1};
    static const frame_way lazy = {SCENE_OBJECTS, 0, 1}, lazy_cones = {SCENE_OBJECTS, 1, 1};
    cones_counted counted;
    counted.without = count(picture, &whole, rule);
    counted.with = count(picture, &whole_cones, rule);
    counted.lazy_without = count(picture, &lazy, rule);
    counted.lazy_with = count(picture, &lazy_cones, rule);
    return counted;
}

/* The scene that is cheapest without cones need not gain. */
static void print_judgement(const char *rule, const cones_counted *counted, size_t number) {
    const double target = 2;
    size_t cheapest = 0, reached = 0;
    for (size_t i = 1; i < number; ++i) {
        if (counted[i].without < counted[cheapest].without) cheapest = i;
    }
    for (size_t i = 0; i < number; ++i) {
        reached += i != cheapest && counted[i].without >= target * counted[i].with;
    }
    printf("%-9s target %.0fx on all but the cheapest (%s %.2fx): %zu of %zu scenes %s", rule,
           target, scenes[cheapest]->name, counted[cheapest].without / counted[cheapest].with,
           reached, number - 1, reached == number - 1 ? "reached" : "NOT REACHED");
    for (size_t i = 0; i < number; ++i) {
        const double ratio = counted[i].without / counted[i].with;
        if (i != cheapest && ratio < target) printf(" %s %.2fx", scenes[i]->name, ratio);
    }
    printf("\n");
}

void frame_cones(const bench_options *options) {
    static cones_counted counted[RULES][MOST_SCENES];
    const size_t number = scene_count < MOST_SCENES ? scene_count : MOST_SCENES;
    FILE *file = bench_open(options, "cones.csv",
                            "scene,rule,evaluations_per_pixel,with_cones,ratio,"
                            "components_evaluated_per_pixel,components_with_cones");
    printf("\nEvaluations a pixel without and with cones, %dx%d (whole: of the scene in one piece; "
           "lazy: of its components, culled):\n%-18s%-9s%10s%10s%8s%12s%12s%8s\n",
           options->width, options->height, "scene", "rule", "whole", "cones", "ratio", "lazy",
           "lazy, cones", "ratio");
    for (size_t i = 0; i < number; ++i) {
        frame_picture *const picture = frame_picture_of(scenes[i], options->width, options->height);
        for (int rule = 0; rule < RULES; ++rule) {
            const int convex = strcmp(rules[rule], "convex") == 0;
            if (convex && !(scenes[i]->flags & SPT_FIELD_CONVEX)) continue;
            const cones_counted of = count_all(picture, rules[rule]);
            counted[rule][i] = of;
            fprintf(file, "%s,%s,%.4f,%.4f,%.4f,%.4f,%.4f\n", scenes[i]->name, rules[rule],
                    of.without, of.with, of.without / of.with, of.lazy_without, of.lazy_with);
            printf("%-18s%-9s%10.2f%10.2f%8.2f%12.2f%12.2f%8.2f\n", scenes[i]->name, rules[rule],
                   of.without, of.with, of.without / of.with, of.lazy_without, of.lazy_with,
                   of.lazy_without / of.lazy_with);
        }
        fflush(stdout);
        frame_picture_free(picture);
    }
    for (int rule = 0; rule < JUDGED_RULES; ++rule) {
        print_judgement(rules[rule], counted[rule], number);
    }
    fclose(file);
}
