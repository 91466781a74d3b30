/* SPDX-License-Identifier: MIT
 *
 * What soft shadows at a quarter of the resolution take of the primary ray casting (Szécsi et al.
 * 2016, sections 8.5 and 11): passes over blocks from all over pictures of the models that the
 * paper is about, at its resolution. A shadow pass is a frame of a camera that makes the shadow
 * ray of a pixel from its hit, as in examples/shadow_pass.c. */
#include "../../bench/frame/frame_picture.h"
#include "claims.h"

#include <scenes/models.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 1920, HEIGHT = 1200, BLOCK = 256, TILE = SPT_TILE };
enum { ACROSS = (WIDTH + BLOCK - 1) / BLOCK, DOWN = (HEIGHT + BLOCK - 1) / BLOCK };
enum { BLOCKS = ACROSS * DOWN, MOST_ROUNDS = 7 };

/* coarser: pixels of the picture that one of the pass is wide. */
typedef struct second_pass {
    const char *name, *method;
    uint32_t flags; /* of the frame; of the settings */
    uint32_t candidate;
    int shadow, coarser;
} second_pass;

/* The quarter is read as that of the pixels, which is harder than one of each side. Shadow rays go
 * by the basic rule, whose samples tell most of the penumbra (spt_penumbra()), and share no cones,
 * so that they are compared with primary rays that do not, either. */
static const second_pass passes[] = {
    {"primary_basic", "basic", SPT_FRAME_NO_CONES, 0, 0, 1},
    {"primary", "adaptive", SPT_FRAME_NO_CONES, 0, 0, 1},
    {"primary_cones", "adaptive", 0, 0, 0, 1},
    {"shadow_quarter", "basic", SPT_FRAME_NO_CONES, SPT_CANDIDATE_PENUMBRA, 1, 2},
    {"shadow_quarter_samples", "basic", SPT_FRAME_NO_CONES, 0, 1, 2}, /* the paper's way */
    {"shadow_sixteenth", "basic", SPT_FRAME_NO_CONES, SPT_CANDIDATE_PENUMBRA, 1, 4},
};
enum { PASSES = sizeof passes / sizeof passes[0], PRIMARY = 1, CONES = 2 };

/* By pixel: where the primary ray hit, and how far that is; +infinity: nowhere. */
typedef struct second_place {
    float point[3], t;
} second_place;

typedef struct second_track {
    const model *shown;
    model_world world;
    spt_camera camera;
    second_place *places;
    bench_hit *image;
    int32_t *outcome;
    float *ratio;
    int blocks[BLOCKS], block_count;
} second_track;

typedef struct second_runner {
    const second_pass *pass;
    second_track *track;
    spt_camera camera;
    spt_frame frame;
    spt_statistics statistics;
    double seconds[MOST_ROUNDS];
} second_runner;

/* ---- Shadow rays ---------------------------------------------------------------------------- */

static const float towards_the_sun[3] = {-0.48f, 0.64f, 0.6f}; /* unit length */

static void shadow_rays(void *user, size_t count, const float *x, const float *y,
                        spt_camera_ray *rays) {
    const second_runner *const runner = user;
    const float coarser = (float)runner->pass->coarser;
    for (size_t i = 0; i < count; ++i) {
        const size_t column = (size_t)fminf(x[i] * coarser, WIDTH - 1);
        const size_t row = (size_t)fminf(y[i] * coarser, HEIGHT - 1);
        const second_place *const place = &runner->track->places[row * WIDTH + column];
        rays[i].active = place->t < INFINITY;
        if (!rays[i].active) continue;
        memcpy(rays[i].ray.origin, place->point, sizeof place->point);
        memcpy(rays[i].ray.direction, towards_the_sun, sizeof towards_the_sun);
        rays[i].ray.t_max = (float)runner->track->shown->t_max;
        rays[i].path = place->t;
    }
}

static void find_places(second_track *track) {
    for (size_t row = 0; row < HEIGHT; ++row) {
        for (size_t first = 0; first < WIDTH; first += SPT_BATCH) {
            const size_t left = WIDTH - first, count = left < SPT_BATCH ? left : SPT_BATCH;
            float x[SPT_BATCH], y[SPT_BATCH];
            spt_camera_ray rays[SPT_BATCH];
            for (size_t i = 0; i < count; ++i) {
                x[i] = (float)(first + i) + 0.5f;
                y[i] = (float)row + 0.5f;
            }
            frame_expect(spt_camera_rays(&track->camera, WIDTH, HEIGHT, count, x, y, rays),
                         "spt_camera_rays");
            for (size_t i = 0; i < count; ++i) {
                second_place *const place = &track->places[row * WIDTH + first + i];
                const bench_hit *const hit = &track->image[row * WIDTH + first + i];
                place->t = hit->outcome == SPT_HIT ? hit->t : INFINITY;
                for (int axis = 0; axis < 3; ++axis) {
                    place->point[axis] =
                        rays[i].ray.origin[axis] + hit->t * rays[i].ray.direction[axis];
                }
            }
        }
    }
}

/* ---- Passes --------------------------------------------------------------------------------- */

static void enter_pass(second_runner *runner, const second_pass *pass, second_track *track) {
    spt_frame *const frame = &runner->frame;
    const uint32_t coarser = (uint32_t)pass->coarser;
    memset(runner, 0, sizeof *runner);
    runner->pass = pass;
    runner->track = track;
    runner->camera = pass->shadow ? spt_camera_of_rays(shadow_rays, runner) : track->camera;
    frame_expect(spt_frame_init(frame, &track->world.scene, &runner->camera, WIDTH / coarser,
                                HEIGHT / coarser),
                 "spt_frame_init");
    frame->settings.method = bench_method(pass->method);
    frame->flags = pass->flags;
    if (pass->shadow) {
        const spt_camera *const eye = &track->camera;
        frame->settings.flags = SPT_SKIP_START | pass->candidate;
        /* half a pixel of the pass, whose rays go on with the path of the primary ones */
        frame->settings.pixel_radius =
            (eye->x_high - eye->x_low) * (float)coarser / (2.0f * (float)WIDTH);
    }
    frame->workspace_size = spt_frame_workspace(frame);
    frame->workspace = report_allocate(frame->workspace_size);
    frame->statistics = &runner->statistics;
}

/* The tiles of a block. */
static void trace_block(const second_runner *runner, int block, const spt_hits *image) {
    const int coarser = runner->pass->coarser, side = BLOCK / coarser / TILE;
    const int columns = (WIDTH / coarser + TILE - 1) / TILE;
    const int rows = (HEIGHT / coarser + TILE - 1) / TILE;
    const int left = block % ACROSS * side, top = block / ACROSS * side;
    for (int row = top; row < top + side && row < rows; ++row) {
        for (int column = left; column < left + side && column < columns; ++column) {
            frame_expect(spt_frame_tile(&runner->frame, (size_t)(row * columns + column), image),
                         "spt_frame_tile");
        }
    }
}

static double run(second_runner *runner) {
    second_track *const track = runner->track;
    spt_hits image = bench_hits_of(track->image);
    if (runner->pass->shadow) {
        memset(&image, 0, sizeof image);
        image.outcome.first = track->outcome;
        image.outcome.stride = sizeof *track->outcome;
        image.candidate_ratio.first = track->ratio;
        image.candidate_ratio.stride = sizeof *track->ratio;
    }
    runner->statistics = spt_statistics_default();
    const double before = bench_seconds();
    for (int i = 0; i < track->block_count; ++i) trace_block(runner, track->blocks[i], &image);
    return bench_seconds() - before;
}

/* ---- Models --------------------------------------------------------------------------------- */

/* Those of section 9; a quick report has every third. */
static const char *const shown[] = {"tree",    "twisted_tree", "grove", "forest", "coral",
                                    "terrain", "rock",         "fish",  "sponge", "reef"};
enum { MODELS = sizeof shown / sizeof shown[0], QUICK_STEP = 3 };

static int cells(const report_options *options) {
    return options->quick ? (MODELS + QUICK_STEP - 1) / QUICK_STEP : MODELS;
}

static second_track *enter(const report_options *options, const char *name) {
    second_track *const track = report_allocate(sizeof *track);
    const size_t pixels = (size_t)WIDTH * HEIGHT;
    float eye[3], target[3];
    const float up[3] = {0, 1, 0};
    track->shown = model_named(name);
    report_expect(track->shown != NULL && track->shown->build(&track->world, 0),
                  "a model is not there");
    for (int axis = 0; axis < 3; ++axis) {
        eye[axis] = (float)track->shown->eye[axis];
        target[axis] = (float)track->shown->target[axis];
    }
    const double tangent = tan(track->shown->field_of_view * (acos(-1.0) / 360));
    frame_expect(spt_camera_pinhole(&track->camera, eye, target, up, (float)tangent, WIDTH, HEIGHT),
                 "spt_camera_pinhole");
    track->camera.t_max = (float)track->shown->t_max;
    track->places = report_allocate(pixels * sizeof *track->places);
    track->outcome = report_allocate(pixels * sizeof *track->outcome);
    track->ratio = report_allocate(pixels * sizeof *track->ratio);
    track->image = report_allocate(pixels * sizeof *track->image);
    for (size_t i = 0; i < pixels; ++i) track->image[i].outcome = SPT_MISS;
    /* 17 has no divisor in common with the 40 blocks. The first is near the middle. */
    track->block_count = options->quick ? 3 : 6;
    for (int i = 0; i < track->block_count; ++i) track->blocks[i] = (20 + 17 * i) % BLOCKS;
    return track;
}

static void leave(second_track *track) {
    free(track->places);
    free(track->outcome);
    free(track->ratio);
    free(track->image);
    free(track);
}

static double pixels_of(const second_track *track) {
    double pixels = 0;
    for (int i = 0; i < track->block_count; ++i) {
        const int left = track->blocks[i] % ACROSS * BLOCK, top = track->blocks[i] / ACROSS * BLOCK;
        pixels += fmin(BLOCK, WIDTH - left) * fmin(BLOCK, HEIGHT - top);
    }
    return pixels;
}

static void write_rows(const second_track *track, const second_runner *runners, int rounds,
                       FILE *rows) {
    const double pixels = pixels_of(track);
    for (int i = 0; i < PASSES; ++i) {
        const second_runner *const runner = &runners[i];
        const claims_spread spread = claims_seconds(runner->seconds, rounds);
        const double rays = (double)runner->statistics.rays;
        const double evaluations =
            (double)(runner->statistics.evaluations + runner->statistics.cone_evaluations);
        fprintf(rows, "%s,%s,%s,%d,%.9g,%.9g", track->shown->name, runner->pass->name,
                runner->pass->method, runner->pass->coarser, pixels, rays);
        claims_write(rows, 1e9 * spread.middle / pixels);
        claims_write(rows, claims_noise(spread));
        claims_write(rows, evaluations / pixels);
        claims_write(rows, (double)runner->statistics.outcomes[SPT_LIMIT]);
        claims_write_spread(rows, claims_faster(runners[PRIMARY].seconds, runner->seconds, rounds));
        claims_write(rows, claims_faster(runners[0].seconds, runner->seconds, rounds).middle);
        claims_write(rows, claims_faster(runners[CONES].seconds, runner->seconds, rounds).middle);
        fputc('\n', rows);
    }
}

static void measure(const report_options *options, int cell, FILE *rows) {
    const int rounds = options->quick ? 5 : MOST_ROUNDS;
    second_track *const track = enter(options, shown[options->quick ? cell * QUICK_STEP : cell]);
    second_runner *const runners = report_allocate(PASSES * sizeof *runners);
    for (int i = 0; i < PASSES; ++i) enter_pass(&runners[i], &passes[i], track);
    run(&runners[PRIMARY]);
    find_places(track);
    for (int round = 0; round < rounds; ++round) {
        for (int turn = 0; turn < PASSES; ++turn) {
            second_runner *const runner = &runners[(round + turn) % PASSES];
            runner->seconds[round] = run(runner);
        }
    }
    write_rows(track, runners, rounds, rows);
    for (int i = 0; i < PASSES; ++i) free(runners[i].frame.workspace);
    free(runners);
    leave(track);
}

/* By pixel of the picture, also of passes that have fewer. share: of the time of the pass
 * `primary`, the middle of the rounds and their quartiles; of_basic, of_cones: of those. */
const report_part report_claim_secondary = {
    "claim_secondary",
    "model,pass,rule,coarser,pixels,rays,nanoseconds,noise,evaluations,undecided,share,share_low,"
    "share_high,of_basic,of_cones",
    cells,
    measure,
    1,
    {56, 10}};
