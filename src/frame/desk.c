/* SPDX-License-Identifier: MIT
 *
 * From a tile to the rays of its chunks: components that cannot be met are left out, and cones of
 * 16x16 and of 4x4 pixels are sent ahead along each of the others. */
#include "desk.h"

#include <float.h>
#include <math.h>

/* A walk takes at most SPT_BATCH evaluations: a progressive frame can be left after each. */
enum { WALK_STEPS = SPT_BATCH / SPTI_BUNDLES, MOST_WALKS = 4 };

enum { CHUNKS_A_SIDE = SPT_TILE / SPTI_CHUNK_SIDE, BLOCK_SIDE = 4 };

/* ---- Memory --------------------------------------------------------------------------------- */

static size_t whole_lines(size_t size) {
    return (size + 63) / 64 * 64;
}

/* The bytes of a component beside the union's. */
static size_t bytes_a_component(size_t chunks) {
    return sizeof(spti_call) + 2 + 3 * sizeof(uint32_t) +
           (2 + chunks) * SPTI_BUNDLES * sizeof(float) + chunks * SPT_BATCH * sizeof(float);
}

/* Chunks in a pool. What a component needs grows with it, so large scenes do with one. */
static size_t pool_of(size_t components) {
    return components <= 256 ? 4 : 1;
}

size_t spti_desk_size(size_t components) {
    const size_t chunks = pool_of(components), each = bytes_a_component(chunks);
    const size_t lazy = spti_union_size(components, chunks * SPT_BATCH);
    const size_t lines = 16 * 64; /* that arrays begin on whole ones */
    if (lazy == 0 || components > (SIZE_MAX - lazy) / 2 / each) return 0;
    return whole_lines(sizeof(spti_desk) + lazy + components * each +
                       chunks * SPT_BATCH * sizeof(size_t) + lines);
}

static char *take(char **memory, size_t size) {
    char *const taken = *memory;
    *memory += whole_lines(size);
    return taken;
}

spti_desk *spti_desk_place(void *memory, size_t components) {
    char *left = memory;
    spti_desk *const desk = (spti_desk *)(void *)take(&left, sizeof *desk);
    desk->calls = (spti_call *)(void *)take(&left, components * sizeof *desk->calls);
    desk->tile_t = (float *)(void *)take(&left, components * SPTI_BUNDLES * sizeof(float));
    desk->block_t = (float *)(void *)take(&left, components * SPTI_BUNDLES * sizeof(float));
    const size_t chunks = pool_of(components), rays = chunks * SPT_BATCH;
    desk->most_pooled = chunks;
    desk->pool_t = (float *)(void *)take(&left, components * chunks * SPTI_BUNDLES * sizeof(float));
    desk->starts = (float *)(void *)take(&left, components * rays * sizeof(float));
    desk->places = (size_t *)(void *)take(&left, rays * sizeof(size_t));
    desk->chunk_list = (uint32_t *)(void *)take(&left, components * sizeof(uint32_t));
    desk->in_pool = (unsigned char *)take(&left, components);
    desk->tile_list = (uint32_t *)(void *)take(&left, components * sizeof(uint32_t));
    desk->list = (uint32_t *)(void *)take(&left, components * sizeof(uint32_t));
    desk->settled = (unsigned char *)take(&left, components);
    spti_union_place(&desk->lazy, left, components, rays);
    return desk;
}

/* ---- The pass ------------------------------------------------------------------------------- */

void spti_desk_begin(spti_desk *desk, const spti_job *job, const spt_settings *settings,
                     const spti_grid *grid, const spt_hits *wanted, spt_statistics *statistics) {
    spti_union *const lazy = &desk->lazy;
    desk->job = job;
    desk->settings = *settings;
    desk->isa = spti_isa_choose(settings->max_lanes);
    desk->grid = *grid;
    desk->wanted = wanted;
    desk->statistics = statistics;
    desk->cone_evaluations = desk->kept = desk->culled = 0;
    memset(desk->settled, 0, job->scene.count);
    spti_union_scene(lazy, desk->calls, desk->list, &job->scene, settings);
    lazy->one_origin = job->view.kind == SPT_CAMERA_PINHOLE;
    memset(desk->in_pool, 0, job->scene.count);
    desk->pooled = 0;
    spti_union_clear(lazy);
}

spti_call *spti_desk_call(spti_desk *desk, uint32_t component) {
    spti_call *const call = &desk->calls[component];
    if (!desk->settled[component]) {
        spti_scene_call(call, &desk->lazy, &desk->job->scene, component, &desk->settings,
                        desk->wanted, desk->statistics);
        desk->settled[component] = 1;
    }
    return call;
}

/* ---- Bundles -------------------------------------------------------------------------------- */

/* A rectangle of pixels of the grid, cut with it, in pixels of the full image. */
static void image_rectangle(const spti_grid *grid, uint32_t x, uint32_t y, uint32_t side,
                            float rectangle[4]) {
    const uint32_t right = x + side < grid->width ? x + side : grid->width;
    const uint32_t bottom = y + side < grid->height ? y + side : grid->height;
    rectangle[0] = (float)x * grid->step_x;
    rectangle[1] = (float)y * grid->step_y;
    rectangle[2] = (float)right * grid->step_x;
    rectangle[3] = (float)bottom * grid->step_y;
}

/* The bundles of 4 x 4 squares of pixels from (x, y) on. They do not depend on which part of the
 * image is traced, so that its results do not. */
static void squares(const spti_desk *desk, uint32_t x, uint32_t y, uint32_t side,
                    spti_bundles *bundles) {
    float rectangles[SPTI_BUNDLES][4];
    unsigned present = 0;
    for (uint32_t i = 0; i < SPTI_BUNDLES; ++i) {
        const uint32_t left = x + i % 4 * side, top = y + i / 4 * side;
        const int inside = left < desk->grid.width && top < desk->grid.height;
        image_rectangle(&desk->grid, inside ? left : x, inside ? top : y, side, rectangles[i]);
        present |= (unsigned)inside << i;
    }
    spti_bundles_of(&desk->job->view, desk->isa, present, (const float(*)[4])rectangles, bundles);
    /* A cone around a single ray is none. */
    for (uint32_t i = 0; side > 1 && i < SPTI_BUNDLES; ++i) {
        const uint32_t left = x + i % 4 * side, top = y + i / 4 * side;
        if (left + 1 == desk->grid.width && top + 1 == desk->grid.height) {
            bundles->usable &= ~(1u << i);
        }
    }
}

/* Sends the bundles ahead along a component by one walk, or where they do not walk, up to its
 * bound. Returns whether they are there; *met: those that may meet it. */
static int send(spti_desk *desk, uint32_t component, int walk, float t[SPTI_BUNDLES],
                unsigned *met) {
    const spti_bundles *const bundles = &desk->bundles;
    const spti_call *const call = spti_desk_call(desk, component);
    const int culls = !(desk->job->frame.flags & SPT_FRAME_NO_CULLING);
    float before[SPTI_BUNDLES];
    int more = 0;
    memcpy(before, t, sizeof before);
    *met = 0;
    if (walk && !(desk->job->frame.flags & SPT_FRAME_NO_CONES)) {
        const uint32_t steps =
            desk->settings.budget < WALK_STEPS ? desk->settings.budget : WALK_STEPS;
        const uint64_t evaluations = spti_bundles_walk(bundles, call, steps, t, &more);
        desk->cone_evaluations += evaluations;
        desk->lazy.allowance -= (int64_t)evaluations;
    } else if (culls) {
        spti_bundles_enter(bundles, call, t);
    }
    for (size_t i = 0; i < SPTI_BUNDLES; ++i) {
        if (!culls && !(t[i] < INFINITY)) t[i] = before[i];
        if (t[i] < INFINITY) *met |= 1u << i;
    }
    *met &= bundles->present;
    desk->walks = more && desk->walks + 1 < MOST_WALKS ? desk->walks + 1 : 0;
    return desk->walks == 0;
}

/* ---- Tiles ---------------------------------------------------------------------------------- */

void spti_desk_tile(spti_desk *desk, uint32_t column, uint32_t row) {
    desk->tile_column = column;
    desk->tile_row = row;
    desk->tile_listed = 0;
    desk->next = 0;
    desk->walks = 0;
    if (spti_desk_owns_rays(desk)) return;
    squares(desk, column * SPT_TILE, row * SPT_TILE, SPTI_CHUNK_SIDE, &desk->bundles);
}

int spti_desk_tile_cones(spti_desk *desk, int walk) {
    const size_t components = desk->job->scene.count;
    for (; desk->next < components; ++desk->next) {
        const uint32_t component = (uint32_t)desk->next;
        float *const t = desk->tile_t + desk->next * SPTI_BUNDLES;
        unsigned met = 1;
        int there = spti_desk_owns_rays(desk);
        for (size_t i = 0; desk->walks == 0 && i < SPTI_BUNDLES; ++i) t[i] = 0.0f;
        for (int turn = 0; !there && turn < MOST_WALKS; ++turn) {
            if (desk->lazy.allowance <= 0) return 0;
            there = send(desk, component, walk, t, &met);
        }
        if (met) desk->tile_list[desk->tile_listed++] = component;
    }
    desk->kept += desk->tile_listed;
    desk->culled += components - desk->tile_listed;
    return 1;
}

/* ---- Chunks ---------------------------------------------------------------------------------- */

int spti_desk_chunk(spti_desk *desk, size_t index) {
    const uint32_t side = SPTI_CHUNK_SIDE;
    desk->chunk = index;
    desk->left = desk->tile_column * SPT_TILE + (uint32_t)(index % CHUNKS_A_SIDE) * side;
    desk->top = desk->tile_row * SPT_TILE + (uint32_t)(index / CHUNKS_A_SIDE) * side;
    if (desk->left >= desk->grid.width || desk->top >= desk->grid.height) return 0;
    if (!spti_desk_make_rays(desk)) return 0;
    if (spti_desk_owns_rays(desk)) {
        spti_bundles_of_rays(desk->camera_rays, &desk->bundles);
    } else {
        squares(desk, desk->left, desk->top, BLOCK_SIDE, &desk->bundles);
    }
    desk->chunk_listed = 0;
    desk->next = 0;
    desk->walks = 0;
    return 1;
}

int spti_desk_chunk_cones(spti_desk *desk, int walk) {
    for (; desk->next < desk->tile_listed; ++desk->next) {
        const uint32_t component = desk->tile_list[desk->next];
        const float tile_t = desk->tile_t[(size_t)component * SPTI_BUNDLES + desk->chunk];
        float *const t = desk->block_t + (size_t)component * SPTI_BUNDLES;
        if (!(tile_t < INFINITY)) continue;
        unsigned met = 0;
        for (size_t i = 0; desk->walks == 0 && i < SPTI_BUNDLES; ++i) t[i] = tile_t;
        for (int turn = 0, there = 0; !there && turn < MOST_WALKS; ++turn) {
            if (desk->lazy.allowance <= 0) return 0;
            there = send(desk, component, walk, t, &met);
        }
        if (met) desk->chunk_list[desk->chunk_listed++] = component;
    }
    return 1;
}

/* A block's pixels as bundles. The least t of the components is where a pixel is free of all. */
static void begin_block(spti_desk *desk, size_t block, float *pixel_t) {
    const size_t first = block * SPTI_BUNDLES;
    const uint32_t x = spti_desk_column(desk, first), y = spti_desk_row(desk, first);
    for (size_t i = 0; i < SPTI_BUNDLES; ++i) pixel_t[first + i] = FLT_MAX;
    if (x < desk->grid.width && y < desk->grid.height) {
        squares(desk, x, y, 1, &desk->bundles);
    } else {
        desk->bundles.usable = desk->bundles.present = 0;
    }
}

int spti_desk_pixel_cones(spti_desk *desk, float *pixel_t) {
    const size_t listed = desk->lazy.listed, turns = listed > 0 ? listed : 1;
    for (; desk->next < SPTI_BUNDLES * turns; ++desk->next) {
        const size_t block = desk->next / turns, place = desk->next % turns;
        float *const t = desk->starts + place * desk->lazy.pool + block * SPTI_BUNDLES;
        float *const least = pixel_t + block * SPTI_BUNDLES;
        unsigned met;
        if (desk->walks == 0 && place == 0) begin_block(desk, block, pixel_t);
        for (int turn = 0, there = listed == 0; !there && turn < MOST_WALKS; ++turn) {
            if (desk->lazy.allowance <= 0) return 0;
            there = send(desk, desk->list[place], 1, t, &met);
        }
        if (listed == 0) continue;
        for (size_t i = 0; i < SPTI_BUNDLES; ++i) least[i] = t[i] < least[i] ? t[i] : least[i];
    }
    return 1;
}

void spti_desk_adopt(spti_desk *desk, spt_statistics *statistics) {
    desk->statistics = statistics;
    for (size_t component = 0; component < desk->job->scene.count; ++component) {
        if (desk->settled[component]) desk->calls[component].statistics = statistics;
    }
}
