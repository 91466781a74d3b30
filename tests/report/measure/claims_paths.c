/* SPDX-License-Identifier: MIT
 *
 * Path tracing with ten bounces and one sample a pixel (Keinert et al. 2014, section 4): tiles of
 * the still life in its room, all of the path tracer's time. */
#include "claims.h"

#include <path_room.h>
#include <path_wave.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 1280, HEIGHT = 720, ACROSS = WIDTH / PATH_TILE };
enum { TILES = ACROSS * ((HEIGHT + PATH_TILE - 1) / PATH_TILE) };

typedef struct path_turn {
    path_job job;
    path_wave *wave;
    int tiles;     /* in a round, */
    uint32_t side; /* and how much of each: pixels */
} path_turn;

/* Tile number i of an order in which every run of them is spread over the picture: 89 has no
 * divisor in common with the 240 tiles, and is near their golden section. */
static void area_of(const path_turn *turn, int i, uint32_t area[4]) {
    const uint32_t tile = (uint32_t)i * 89u % TILES;
    area[0] = tile % ACROSS * PATH_TILE;
    area[1] = tile / ACROSS * PATH_TILE;
    area[2] = area[0] + turn->side;
    area[3] = area[1] + turn->side < HEIGHT ? area[1] + turn->side : HEIGHT;
}

static double run(void *user, int round) {
    path_turn *const turn = user;
    const double before = bench_seconds();
    (void)round;
    turn->wave->statistics = path_statistics_default();
    for (int i = 0; i < turn->tiles; ++i) {
        uint32_t area[4];
        area_of(turn, i, area);
        path_wave_begin(turn->wave, area, 0);
        while (path_wave_step(turn->wave)) {
        }
        keinert_expect(turn->wave->status, "a wave of paths");
    }
    return bench_seconds() - before;
}

static void enter(path_turn *turn, const report_options *options, const path_stage *stage,
                  const claims_way *way) {
    path_settings settings = path_settings_default();
    settings.method = bench_method(way->method);
    report_expect(path_job_create(&turn->job, &stage->world, &settings, WIDTH, HEIGHT),
                  "out of memory");
    turn->job.primary.relaxation = turn->job.scattered.relaxation = way->relaxation;
    turn->wave = path_wave_create(&turn->job);
    report_expect(turn->wave != NULL, "out of memory");
    turn->tiles = 4;
    turn->side = options->quick ? PATH_TILE / 4 : PATH_TILE / 2;
}

void claims_paths(const report_options *options, const claims_case *measured,
                  claims_callback callback, int rounds, claims_result *results) {
    path_turn *const turns = report_allocate((size_t)measured->number * sizeof *turns);
    path_stage *const stage = report_allocate(sizeof *stage);
    void *users[claims_most_ways];
    claims_repeated repeated[SCENE_PARTS_MOST + 4];
    path_room(stage, WIDTH, HEIGHT);
    if (callback.scalar)
        scene_parts_of(scene_named(measured->scene), SCENE_OBJECTS, 1, &stage->parts);
    for (size_t i = 0; i < stage->parts.scene.count; ++i) {
        stage->fields[i] = stage->parts.fields[i]; /* the walls and the lamp stand behind them */
    }
    for (size_t i = 0; i < stage->scene.count && callback.times > 1; ++i) {
        claims_repeat_field(&stage->fields[i], callback.times, &repeated[i]);
    }
    for (int i = 0; i < measured->number; ++i) {
        enter(&turns[i], options, stage, &measured->ways[i]);
        users[i] = &turns[i];
    }
    claims_race(measured, users, run, rounds, results);
    for (int i = 0; i < measured->number; ++i) {
        for (int kind = 0; kind < path_rays; ++kind) {
            const spt_statistics *const traced = &turns[i].wave->statistics.traced[kind];
            results[i].rays += (double)traced->rays;
            results[i].evaluations += (double)traced->evaluations;
        }
        path_wave_free(turns[i].wave);
        path_job_free(&turns[i].job);
    }
    free(stage);
    free(turns);
}
