/* SPDX-License-Identifier: MIT
 *
 * The library's part of the frames of keinert_frames.c: the renderer's own rays, recorded, and
 * traced and refined again. And of those in the body the way out by itself, with and without the
 * optimisation for convex bodies. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "keinert_bench.h"
#include "keinert_depth.h"
#include "keinert_record.h"

/* Rays a call, about as many as the renderer has in a generation of a tile. */
enum { CALL = 4096, REFINEMENTS = 3 };

typedef struct glass_way {
    const char *name;
    const spt_method *(*method)(void);
    int convex, licence, scalar; /* as in keinert_frames.c */
    int against;
    double paper, fewer; /* as in keinert_contender */
} glass_way;

/* The default way is compared with what it replaces: the way through by the same rule. */
static const glass_way inside_ways[] = {
    {"through, basic", spt_basic, 0, 1, 0, 0, 0, 0},
    {"through, relaxed 1.2", spt_relaxed, 0, 1, 0, 0, 0, 0},
    {"through, adaptive", spt_adaptive, 0, 1, 0, 0, 0, 0},
    {"backwards, basic", spt_basic, 1, 0, 0, 0, 0, 0},
    {"backwards, adaptive", spt_adaptive, 1, 0, 0, 2, 0, 2},
    {"convex (default)", spt_adaptive, 1, 1, 0, 2, 0, 2},
    {"convex, against basic", spt_adaptive, 1, 1, 0, 0, 0, 2},
    {"scalar callback, through", spt_adaptive, 0, 1, 1, 7, 0, 0},
    {"scalar callback, convex", spt_adaptive, 1, 1, 1, 7, 0, 2},
};
enum { INSIDE_WAYS = sizeof inside_ways / sizeof inside_ways[0] };

typedef struct glass_runner {
    const glass_way *way;
    const bench_options *options;
    const keinert_record *record;
    spt_field field;
    whitted_kind first; /* kinds from this one on are traced */
    uint32_t refinements;
    spt_hit *hits; /* of a call */
    spt_statistics statistics;
    uint64_t refining;
} glass_runner;

static spt_rays rays_from(const whitted_queue *queue, size_t first) {
    whitted_queue rest = *queue;
    rest.rays += first;
    return whitted_columns(&rest);
}

static spt_hits sinks_of(spt_hit *hits) {
    spt_hits sinks = spt_hits_of(hits);
    sinks.component.first = sinks.candidate_t.first = sinks.candidate_ratio.first = NULL;
    sinks.fallbacks.first = NULL;
    return sinks;
}

/* Traces up to CALL rays of a kind; statistics may be NULL. */
static void trace(const glass_runner *runner, whitted_kind kind, size_t first, size_t count,
                  spt_hit *hits, spt_statistics *statistics) {
    const spt_settings settings =
        keinert_record_settings(runner->record, kind, runner->way->method());
    const spt_rays rays = rays_from(&runner->record->of[kind], first);
    const spt_hits sinks = sinks_of(hits);
    if (kind == WHITTED_INSIDE && runner->way->convex) {
        keinert_expect(
            spt_trace_convex(&runner->field, &settings, count, &rays, &sinks, statistics),
            "spt_trace_convex");
    } else {
        keinert_expect(spt_trace(&runner->field, &settings, count, &rays, &sinks, statistics),
                       "spt_trace");
    }
}

static void refine(const glass_runner *runner, whitted_kind kind, size_t first, size_t count) {
    const spt_settings settings =
        keinert_record_settings(runner->record, kind, runner->way->method());
    const spt_rays rays = rays_from(&runner->record->of[kind], first);
    const spt_hits sinks = sinks_of(runner->hits);
    keinert_expect(
        spt_refine(&runner->field, 1, &settings, runner->refinements, count, &rays, &sinks),
        "spt_refine");
}

static uint64_t evaluations_of(const glass_runner *runner, size_t count) {
    uint64_t sum = 0;
    for (size_t i = 0; i < count; ++i) sum += runner->hits[i].evaluations;
    return sum;
}

static double run(void *user, int round) {
    const glass_runner *const runner = user;
    const double before = bench_seconds();
    for (int kind = (int)runner->first; kind < KEINERT_KINDS; ++kind) {
        const keinert_part part =
            keinert_part_of(runner->record->of[kind].count, round, runner->options->rounds);
        for (size_t done = 0; done < part.count; done += CALL) {
            const size_t count = part.count - done < CALL ? part.count - done : CALL;
            trace(runner, (whitted_kind)kind, part.begin + done, count, runner->hits, NULL);
            if (runner->refinements == 0) continue;
            refine(runner, (whitted_kind)kind, part.begin + done, count);
        }
    }
    return bench_seconds() - before;
}

/* All rays once, to count. */
static void count_all(glass_runner *runner, keinert_row *row) {
    row->rays = 0;
    for (int kind = (int)runner->first; kind < KEINERT_KINDS; ++kind) {
        const size_t number = runner->record->of[kind].count;
        spt_statistics statistics = spt_statistics_default();
        for (size_t done = 0; done < number; done += CALL) {
            const size_t count = number - done < CALL ? number - done : CALL;
            trace(runner, (whitted_kind)kind, done, count, runner->hits, &statistics);
            if (runner->refinements == 0) continue;
            const uint64_t before = evaluations_of(runner, count);
            refine(runner, (whitted_kind)kind, done, count);
            runner->refining += evaluations_of(runner, count) - before;
        }
        runner->statistics.evaluations += statistics.evaluations;
        runner->statistics.outcomes[SPT_LIMIT] += statistics.outcomes[SPT_LIMIT];
        row->rays += (double)statistics.rays;
        if (kind == WHITTED_INSIDE) {
            row->inside_a_ray = (double)statistics.evaluations / (double)statistics.rays;
        }
    }
    row->evaluations = (double)(runner->statistics.evaluations + runner->refining);
    row->undecided = (double)runner->statistics.outcomes[SPT_LIMIT];
}

/* How far the ways out are from the true ones. Returns how many exits are not within the tolerance
 * of the surface, though a hit is defined by that. */
static size_t judge_exits(const glass_runner *runner, const scene *shown, keinert_row *row) {
    const spt_settings settings =
        keinert_record_settings(runner->record, WHITTED_INSIDE, runner->way->method());
    const whitted_queue *const queue = &runner->record->of[WHITTED_INSIDE];
    double square = 0, landed = 0;
    size_t wrong = 0;
    row->passed = 0;
    row->lost = 0;
    for (size_t first = 0; first < queue->count; first += CALL) {
        const size_t count = queue->count - first < CALL ? queue->count - first : CALL;
        trace(runner, WHITTED_INSIDE, first, count, runner->hits, NULL);
        for (size_t i = 0; i < count; ++i) {
            const whitted_ray *const ray = &queue->rays[first + i];
            const spt_hit *const hit = &runner->hits[i];
            double p[3], f;
            row->lost += hit->outcome != SPT_HIT;
            if (hit->outcome != SPT_HIT) continue;
            for (int axis = 0; axis < 3; ++axis) {
                p[axis] = (double)ray->ray.origin[axis] +
                          (double)hit->t * (double)ray->ray.direction[axis];
            }
            shown->reference(1, &p[0], &p[1], &p[2], &f);
            const double cone =
                (double)settings.pixel_radius * ((double)ray->path + (double)hit->t);
            /* 16 u of coordinates up to 2: positions, and rounding in the callback. */
            wrong += fabs(f) > fmax((double)settings.epsilon, cone) + 32 * 0x1p-24;
            const double depth =
                keinert_depth(shown, &settings, &ray->ray, ray->path, -1.0, (double)hit->t);
            if (isnan(depth)) {
                row->passed += 1;
                continue;
            }
            square += depth * depth;
            landed += 1;
        }
    }
    row->error = sqrt(square / landed);
    row->error_of = "RMS way along the ray to the exit; lost: rays without a way out";
    return wrong;
}

typedef struct glass_race {
    const char *measure;
    const glass_way *ways;
    int number;
    whitted_kind first;
    uint32_t refinements;
} glass_race;

static int hold(const bench_options *options, FILE *file, const glass_race *race,
                const glass_world *world, const keinert_record *record) {
    enum { MOST = INSIDE_WAYS };
    static keinert_contender contenders[MOST];
    static glass_runner runners[MOST];
    static keinert_row rows[MOST];
    static spt_hit hits[CALL];
    size_t wrong = 0;
    memset(contenders, 0, sizeof contenders);
    for (int i = 0; i < race->number; ++i) {
        glass_runner *const runner = &runners[i];
        memset(runner, 0, sizeof *runner);
        runner->way = &race->ways[i];
        runner->options = options;
        runner->record = record;
        runner->field = scene_field(world->body, runner->way->scalar ? 1 : spt_lanes());
        if (!runner->way->licence) runner->field.flags &= ~(uint32_t)SPT_FIELD_CONVEX;
        runner->first = race->first;
        runner->refinements = race->refinements;
        runner->hits = hits;
        contenders[i].name = runner->way->name;
        contenders[i].against = runner->way->against;
        contenders[i].paper = runner->way->paper;
        contenders[i].fewer = runner->way->fewer;
        contenders[i].user = runner;
        rows[i] = keinert_row_of(race->measure, world->name);
    }
    keinert_race(contenders, race->number, options->rounds, run);
    for (int i = 0; i < race->number; ++i) {
        count_all(&runners[i], &rows[i]);
        if (race->refinements == 0) wrong += judge_exits(&runners[i], world->body, &rows[i]);
        rows[i].error_of_base = rows[contenders[i].against].error;
        rows[i].nanoseconds = 1e9 * keinert_middle_seconds(&contenders[i], options->rounds) *
                              options->rounds / rows[i].rays;
    }
    keinert_report(file, contenders, rows, race->number, options->rounds);
    if (wrong > 0) printf("%s: %zu exits are not on the surface\n", world->name, wrong);
    return wrong == 0;
}

static int trace_world(const bench_options *options, FILE *file, const char *name,
                       const glass_way *ways, int number) {
    const glass_race whole = {"tracing and refining of a frame", ways, number, WHITTED_PRIMARY,
                              REFINEMENTS};
    const glass_race inside = {"rays inside", inside_ways, INSIDE_WAYS, WHITTED_INSIDE, 0};
    const size_t step = options->width >= 1280 ? 7 : 1; /* across and down are no multiples */
    glass_world world;
    keinert_record record;
    if (!glass_world_named(name, &world)) return 0;
    const spt_field field = glass_world_field(&world, spt_lanes());
    keinert_record_rays(&world, &field, options->width, options->height, step, &record);
    const int first = hold(options, file, &whole, &world, &record);
    const int second = hold(options, file, &inside, &world, &record);
    keinert_record_free(&record);
    return first && second;
}

int keinert_glass(const bench_options *options, FILE *file) {
    const double jewel_saved = 22.470 / 21.11, convex_saved = 3.03 / 2.73;
    const glass_way jewel[] = {
        {"basic", spt_basic, 0, 1, 0, 0, 0, 0},
        {"relaxed 1.2", spt_relaxed, 0, 1, 0, 0, 0, 0},
        {"adaptive (default rule)", spt_adaptive, 0, 1, 0, 0, jewel_saved, 0},
        {"adaptive, convex (default)", spt_adaptive, 1, 1, 0, 0, jewel_saved, 0},
        {"convex rule, convex", spt_convex, 1, 1, 0, 0, jewel_saved, 0},
        {"scalar callback, basic", spt_basic, 0, 1, 1, 5, 0, 0},
        {"scalar callback, adaptive", spt_adaptive, 0, 1, 1, 5, jewel_saved, 0},
    };
    const glass_way glass[] = {
        {"through, basic", spt_basic, 0, 1, 0, 0, 0, 0},
        {"through, relaxed 1.2", spt_relaxed, 0, 1, 0, 0, 0, 0},
        {"through, adaptive", spt_adaptive, 0, 1, 0, 0, 0, 0},
        {"backwards, adaptive", spt_adaptive, 1, 0, 0, 2, convex_saved, 0},
        {"convex (default)", spt_adaptive, 1, 1, 0, 2, convex_saved, 0},
        {"scalar callback, through", spt_adaptive, 0, 1, 1, 5, 0, 0},
        {"scalar callback, convex", spt_adaptive, 1, 1, 1, 5, convex_saved, 0},
    };
    const int first =
        trace_world(options, file, "jewel", jewel, (int)(sizeof jewel / sizeof jewel[0]));
    const int second =
        trace_world(options, file, "glass", glass, (int)(sizeof glass / sizeof glass[0]));
    return first && second;
}
