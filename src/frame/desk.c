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

static spti_call *call_of(spti_desk *desk, uint32_t component) {
    spti_call *const call = &desk->calls[component];
    if (!desk->settled[component]) {
        spti_scene_call(call, &desk->lazy, &desk->job->scene, component, &desk->settings,
                        desk->wanted, desk->statistics);
        desk->settled[component] = 1;
    }
    return call;
}

/* ---- Bundles -------------------------------------------------------------------------------- */

static int has_rays_of_its_own(const spti_desk *desk) {
    return desk->job->view.kind == SPT_CAMERA_RAYS;
}

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

/* Sends the bundles ahead along a component by one walk, or where they do not walk, up to its bound.
 * Returns whether they are there; *met: those that may meet it. */
static int send(spti_desk *desk, uint32_t component, int walk, float t[SPTI_BUNDLES],
                unsigned *met) {
    const spti_bundles *const bundles = &desk->bundles;
    const spti_call *const call = call_of(desk, component);
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
    if (has_rays_of_its_own(desk)) return;
    squares(desk, column * SPT_TILE, row * SPT_TILE, SPTI_CHUNK_SIDE, &desk->bundles);
}

int spti_desk_tile_cones(spti_desk *desk, int walk) {
    const size_t components = desk->job->scene.count;
    for (; desk->next < components; ++desk->next) {
        const uint32_t component = (uint32_t)desk->next;
        float *const t = desk->tile_t + desk->next * SPTI_BUNDLES;
        unsigned met = 1;
        int there = has_rays_of_its_own(desk);
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

/* ---- Chunks --------------------------------------------------------------------------------- */

static void set_column(spt_column *column, const void *first, ptrdiff_t stride) {
    column->first = first;
    column->stride = stride;
}

/* The points of a chunk's rays, and which are traced. Returns 0 where none is. */
static int place_rays(spti_desk *desk) {
    const spti_grid *const grid = &desk->grid;
    const spti_rectangle *const part = &grid->part;
    const uint32_t side = SPTI_CHUNK_SIDE;
    float across[SPTI_CHUNK_SIDE], down[SPTI_CHUNK_SIDE];
    int any = 0;
    desk->all = desk->left >= part->x_0 && desk->left + side <= part->x_1 &&
                desk->top >= part->y_0 && desk->top + side <= part->y_1;
    for (uint32_t i = 0; i < side; ++i) {
        const uint32_t x = desk->left + i < grid->width ? desk->left + i : grid->width - 1;
        const uint32_t y = desk->top + i < grid->height ? desk->top + i : grid->height - 1;
        across[i] = ((float)x + 0.5f) * grid->step_x;
        down[i] = ((float)y + 0.5f) * grid->step_y;
    }
    for (size_t i = 0; i < SPT_BATCH; i += 4) { /* a row of a block */
        const size_t left = i / 16 % 4 * 4, row = i / 64 * 4 + i / 4 % 4;
        const size_t place = spti_desk_place_of(desk, i);
        for (size_t k = 0; k < 4; ++k) {
            desk->x[i + k] = across[left + k];
            desk->y[i + k] = down[row];
            desk->own_places[i + k] = place + k;
        }
    }
    if (desk->all) return 1;
    for (size_t i = 0; i < SPT_BATCH; ++i) {
        const uint32_t column = spti_desk_column(desk, i), row = spti_desk_row(desk, i);
        const int traced =
            column >= part->x_0 && column < part->x_1 && row >= part->y_0 && row < part->y_1;
        desk->active[i] = traced ? -1 : 0;
        any |= traced;
    }
    return any;
}

/* The rays of a caller's camera. Returns 0 where none is active. */
static int ask_camera(spti_desk *desk) {
    int any = 0;
    spti_view_rays(&desk->job->view, &desk->job->camera, desk->isa, SPT_BATCH, desk->x, desk->y,
                   desk->camera_rays);
    for (size_t i = 0; i < SPT_BATCH; ++i) {
        spt_camera_ray *const ray = &desk->camera_rays[i];
        if (!desk->all && desk->active[i] == 0) ray->active = 0;
        desk->active[i] = ray->active;
        any |= ray->active;
        for (int axis = 0; axis < 3; ++axis) {
            desk->rays.origin[axis][i] = ray->ray.origin[axis];
            desk->rays.direction[axis][i] = ray->ray.direction[axis];
        }
        desk->t_min[i] = ray->ray.t_min;
        desk->t_max[i] = ray->ray.t_max;
        desk->path[i] = ray->path;
    }
    desk->all = 0;
    set_column(&desk->columns.t_min, desk->t_min, 4);
    set_column(&desk->columns.t_max, desk->t_max, 4);
    set_column(&desk->columns.path, desk->path, 4);
    return any;
}

/* Cuts rays of the full image off at the caller's depths. */
static void cut_at_depths(spti_desk *desk) {
    const spt_frame *const frame = &desk->job->frame;
    const spt_column *const depths = &frame->t_max;
    if (depths->first == NULL || desk->grid.width != frame->width ||
        desk->grid.height != frame->height) {
        return;
    }
    for (size_t i = 0; i < SPT_BATCH; ++i) {
        float t;
        const int own = has_rays_of_its_own(desk);
        const float before = own ? desk->t_max[i] : desk->job->view.t_max;
        desk->t_max[i] = before;
        if (!desk->all && desk->active[i] == 0) continue;
        memcpy(&t, (const char *)depths->first + (ptrdiff_t)desk->own_places[i] * depths->stride,
               sizeof t);
        if (t < before || !(t <= INFINITY)) desk->t_max[i] = t; /* NaN stays, a bad ray */
    }
    set_column(&desk->columns.t_max, desk->t_max, 4);
}

/* The rays of a chunk, but for what fill_rays() does. Returns 0 where none is traced. */
static int make_rays(spti_desk *desk) {
    const spti_view *const view = &desk->job->view;
    const ptrdiff_t pinhole = view->kind == SPT_CAMERA_PINHOLE ? 0 : 4; /* all from the eye */
    if (!place_rays(desk)) return 0;
    for (int axis = 0; axis < 3; ++axis) {
        set_column(&desk->columns.origin[axis], desk->rays.origin[axis], pinhole);
        set_column(&desk->columns.direction[axis], desk->rays.direction[axis], 4);
    }
    if (has_rays_of_its_own(desk)) {
        if (!ask_camera(desk)) return 0;
    } else {
        set_column(&desk->columns.t_min, &view->t_min, 0);
        set_column(&desk->columns.t_max, &view->t_max, 0);
        set_column(&desk->columns.path, NULL, 0);
    }
    set_column(&desk->columns.active, desk->all ? NULL : desk->active, 4);
    cut_at_depths(desk);
    return 1;
}

/* The origins and directions of our own cameras: only of chunks that may meet something. */
static void fill_rays(spti_desk *desk) {
    if (has_rays_of_its_own(desk)) return;
    spti_cone_kernels_of[desk->isa]->rays(&desk->job->view, SPT_BATCH, desk->x, desk->y,
                                          &desk->rays);
}

int spti_desk_chunk(spti_desk *desk, size_t index) {
    const uint32_t side = SPTI_CHUNK_SIDE;
    desk->chunk = index;
    desk->left = desk->tile_column * SPT_TILE + (uint32_t)(index % CHUNKS_A_SIDE) * side;
    desk->top = desk->tile_row * SPT_TILE + (uint32_t)(index / CHUNKS_A_SIDE) * side;
    if (desk->left >= desk->grid.width || desk->top >= desk->grid.height) return 0;
    if (!make_rays(desk)) return 0;
    if (has_rays_of_its_own(desk)) {
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

/* ---- Pools ---------------------------------------------------------------------------------- */

/* Puts the chunk's rays into the pool, with how far its blocks came along each component. */
static void pool_chunk(spti_desk *desk) {
    const size_t chunk = desk->pooled++, row = desk->most_pooled * SPTI_BUNDLES;
    for (size_t i = 0; i < desk->chunk_listed; ++i) {
        const uint32_t component = desk->chunk_list[i];
        float *const t = desk->pool_t + component * row;
        if (!desk->in_pool[component]) {
            for (size_t k = 0; k < row; ++k) t[k] = INFINITY;
            desk->in_pool[component] = 1;
        }
        memcpy(t + chunk * SPTI_BUNDLES, desk->block_t + (size_t)component * SPTI_BUNDLES,
               SPTI_BUNDLES * sizeof *t);
    }
    memcpy(desk->places + chunk * SPT_BATCH, desk->own_places, sizeof desk->own_places);
    fill_rays(desk);
    spti_union_add(&desk->lazy, &desk->columns, 0, SPT_BATCH);
}

/* Lists the pool's components, and where its rays start along each of them. */
static void list_pool(spti_desk *desk) {
    const size_t row = desk->most_pooled * SPTI_BUNDLES;
    size_t listed = 0;
    for (size_t i = 0; i < desk->tile_listed; ++i) {
        const uint32_t component = desk->tile_list[i];
        const float *const t = desk->pool_t + component * row;
        float *const starts = desk->starts + listed * desk->lazy.pool;
        if (!desk->in_pool[component]) continue;
        for (size_t block = 0; block < desk->pooled * SPTI_BUNDLES; ++block) {
            for (size_t k = 0; k < SPTI_GROUP; ++k) starts[block * SPTI_GROUP + k] = t[block];
        }
        desk->list[listed++] = component;
        desk->in_pool[component] = 0;
    }
    desk->lazy.listed = listed;
}

void spti_desk_open(spti_desk *desk, const float *starts) {
    desk->pooled = 0;
    spti_union_clear(&desk->lazy);
    pool_chunk(desk);
    list_pool(desk);
    for (size_t place = 0; starts != NULL && place < desk->lazy.listed; ++place) {
        float *const t = desk->starts + place * desk->lazy.pool;
        for (size_t i = 0; i < SPT_BATCH; ++i) t[i] = starts[i] > t[i] ? starts[i] : t[i];
    }
    desk->next = 0;
    desk->walks = 0;
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

void spti_desk_enter(spti_desk *desk) {
    spti_union_enter(&desk->lazy, desk->starts);
}

void spti_desk_flush(spti_desk *desk, const spt_hits *image) {
    if (desk->pooled == 0) return;
    list_pool(desk);
    spti_union_enter(&desk->lazy, desk->starts);
    spti_union_run(&desk->lazy);
    spti_desk_write(desk, image);
    desk->pooled = 0;
    spti_union_clear(&desk->lazy);
}

/* ---- Tracing -------------------------------------------------------------------------------- */

/* A chunk that can meet nothing. */
static void miss_all(spti_desk *desk, const spt_hits *image) {
    const int32_t *const active = desk->all ? NULL : desk->active;
    uint64_t rays = 0;
    spti_write_misses(SPT_BATCH, active, desk->own_places, image);
    for (size_t i = 0; i < SPT_BATCH; ++i) rays += active == NULL || active[i] != 0;
    if (desk->statistics != NULL) {
        desk->statistics->rays += rays;
        desk->statistics->outcomes[SPT_MISS] += rays;
    }
}

/* A chunk that can meet one component only needs no union: it is traced as spt_trace() does. */
static void trace_alone(spti_desk *desk, const spt_hits *image) {
    const uint32_t component = desk->chunk_list[0];
    const float *const t = desk->block_t + (size_t)component * SPTI_BUNDLES;
    spt_rays columns = desk->columns;
    spti_call call = *call_of(desk, component);
    const int owns = has_rays_of_its_own(desk);
    fill_rays(desk);
    for (size_t block = 0; block < SPTI_BUNDLES; ++block) {
        const float start = t[block] < FLT_MAX ? t[block] : FLT_MAX;
        float *const t_min = desk->t_min + block * SPTI_GROUP;
        for (size_t i = 0; i < SPTI_GROUP; ++i) {
            const float own = owns ? t_min[i] : desk->job->view.t_min;
            t_min[i] = own >= 0.0f && start > own ? start : own; /* a bad ray stays one */
        }
    }
    set_column(&columns.t_min, desk->t_min, 4);
    call.rays = &columns;
    call.hits = image;
    call.places = desk->own_places;
    call.component = (int32_t)component;
    call.leave = spti_write_hits;
    call.stop = NULL;
    call.allowance = NULL;
    spti_call_settle(&call);
    call.field.lipschitz = 1.0f; /* slopes are counted relative to it */
    spti_trace_chunk(&call, &desk->lazy.chunk, 0, SPT_BATCH);
}

void spti_desk_trace(spti_desk *desk, const spt_hits *image) {
    const int may_be_bad = has_rays_of_its_own(desk) || desk->job->frame.t_max.first != NULL;
    if (desk->chunk_listed == 0 && !may_be_bad) {
        miss_all(desk, image);
    } else if (desk->chunk_listed == 1 && desk->lazy.zone_count == 0) {
        trace_alone(desk, image);
    } else {
        pool_chunk(desk);
        if (desk->pooled == desk->most_pooled) spti_desk_flush(desk, image);
    }
}

void spti_desk_write(const spti_desk *desk, const spt_hits *image) {
    if (image != NULL) spti_union_write(&desk->lazy, image, 0, desk->places);
    if (desk->statistics != NULL) spti_union_count(&desk->lazy, desk->statistics);
}

void spti_desk_adopt(spti_desk *desk, spt_statistics *statistics) {
    desk->statistics = statistics;
    for (size_t component = 0; component < desk->job->scene.count; ++component) {
        if (desk->settled[component]) desk->calls[component].statistics = statistics;
    }
}
