/* SPDX-License-Identifier: MIT
 *
 * Frames of the Whitted renderer with two reflections, eight refractions and three refinements
 * (Keinert et al. 2014, section 4): whole ones, with shading, which the paper has in its time for
 * the lit jewel; and the library's part of them by itself, the renderer's own rays traced and
 * refined again, for the convex body, where the paper leaves shading out. */
#include "../../bench/keinert/keinert_record.h"
#include "claims.h"

#include <whitted.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Whole frames --------------------------------------------------------------------------- */

typedef struct frame_turn {
    const claims_way *way;
    glass_world world;
    scene body; /* the world's, with the callbacks and the licence of this way */
    int width, height;
    float *pixels;
    whitted_statistics statistics;
} frame_turn;

static double run_frame(void *user, int round) {
    frame_turn *const turn = user;
    whitted_settings settings = whitted_settings_default();
    (void)round;
    settings.method = bench_method(turn->way->method);
    settings.convex = turn->way->convex;
    const double before = bench_seconds();
    report_expect(whitted_render(&turn->world, &settings, turn->width, turn->height, turn->pixels,
                                 &turn->statistics),
                  "a frame of glass cannot be rendered");
    return bench_seconds() - before;
}

static void enter_frame(frame_turn *turn, const report_options *options,
                        const claims_case *measured, int which, claims_callback callback) {
    memset(turn, 0, sizeof *turn);
    turn->way = &measured->ways[which];
    turn->width = options->quick ? 192 : 320;
    turn->height = options->quick ? 108 : 180;
    turn->pixels = report_allocate((size_t)(turn->width * turn->height) * 3 * sizeof(float));
    report_expect(glass_world_named(measured->scene, &turn->world), "a world is not there");
    turn->body = *turn->world.body;
    if (!turn->way->licence) turn->body.flags &= ~(uint32_t)SPT_FIELD_CONVEX;
    claims_repeat_scene(&turn->body, callback);
    turn->world.body = &turn->body;
}

void claims_frames(const report_options *options, const claims_case *measured,
                   claims_callback callback, int rounds, claims_result *results) {
    frame_turn *const turns = report_allocate((size_t)measured->number * sizeof *turns);
    void *users[claims_most_ways];
    for (int i = 0; i < measured->number; ++i) {
        enter_frame(&turns[i], options, measured, i, callback);
        users[i] = &turns[i];
    }
    claims_race(measured, users, run_frame, rounds, results);
    for (int i = 0; i < measured->number; ++i) {
        for (int kind = 0; kind < whitted_kinds; ++kind) {
            results[i].rays += (double)turns[i].statistics.of[kind].rays;
            results[i].evaluations += (double)turns[i].statistics.of[kind].evaluations;
        }
        free(turns[i].pixels);
    }
    free(turns);
}

/* ---- Tracing and refining alone ------------------------------------------------------------- */

/* Rays a call, about as many as the renderer has in a generation of a tile. */
enum { WIDTH = 1280, HEIGHT = 720, CALL = 4096, REFINEMENTS = 3 };

typedef struct glass_turn {
    const claims_way *way;
    const keinert_record *record;
    spt_field field;
    spt_hit *hits; /* of a call */
    double rays, evaluations;
} glass_turn;

static void trace(glass_turn *turn, whitted_kind kind, size_t first, size_t count) {
    whitted_queue rest = turn->record->of[kind];
    rest.rays += first;
    const spt_rays rays = whitted_columns(&rest);
    const spt_settings settings =
        keinert_record_settings(turn->record, kind, bench_method(turn->way->method));
    spt_hits hits = spt_hits_of(turn->hits);
    hits.component.first = hits.candidate_t.first = hits.candidate_ratio.first = NULL;
    hits.fallbacks.first = NULL;
    if (kind == WHITTED_INSIDE && turn->way->convex) {
        keinert_expect(spt_trace_convex(&turn->field, &settings, count, &rays, &hits, NULL),
                       "spt_trace_convex");
    } else {
        keinert_expect(spt_trace(&turn->field, &settings, count, &rays, &hits, NULL), "spt_trace");
    }
    keinert_expect(spt_refine(&turn->field, 1, &settings, REFINEMENTS, count, &rays, &hits),
                   "spt_refine");
}

/* All rays, or, to count, all with a look at what they took. */
static void trace_all(glass_turn *turn, int counting) {
    for (int kind = 0; kind < KEINERT_KINDS; ++kind) {
        const size_t number = turn->record->of[kind].count;
        for (size_t done = 0; done < number; done += CALL) {
            const size_t count = number - done < CALL ? number - done : CALL;
            trace(turn, (whitted_kind)kind, done, count);
            turn->rays += counting ? (double)count : 0;
            for (size_t i = 0; i < count && counting; ++i) {
                turn->evaluations += (double)turn->hits[i].evaluations;
            }
        }
    }
}

static double run_glass(void *user, int round) {
    const double before = bench_seconds();
    (void)round;
    trace_all(user, 0);
    return bench_seconds() - before;
}

void claims_glass(const report_options *options, const claims_case *measured,
                  claims_callback callback, int rounds, claims_result *results) {
    glass_turn turns[claims_most_ways];
    void *users[claims_most_ways];
    glass_world world;
    keinert_record record;
    report_expect(glass_world_named(measured->scene, &world), "a world is not there");
    const spt_field field = glass_world_field(&world, spt_lanes());
    /* Tiles across and down are no multiples of these. */
    keinert_record_rays(&world, &field, WIDTH, HEIGHT, options->quick ? 33 : 7, &record);
    scene body = *world.body;
    claims_repeat_scene(&body, callback);
    spt_hit *const hits = report_allocate(CALL * sizeof *hits);
    for (int i = 0; i < measured->number; ++i) {
        glass_turn *const turn = &turns[i];
        memset(turn, 0, sizeof *turn);
        turn->way = &measured->ways[i];
        turn->record = &record;
        turn->field = scene_field(&body, spt_lanes());
        if (!turn->way->licence) turn->field.flags &= ~(uint32_t)SPT_FIELD_CONVEX;
        turn->hits = hits;
        trace_all(turn, 1);
        results[i].rays = turn->rays;
        results[i].evaluations = turn->evaluations;
        users[i] = turn;
    }
    claims_race(measured, users, run_glass, rounds, results);
    keinert_record_free(&record);
    free(hits);
}
