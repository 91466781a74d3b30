/* SPDX-License-Identifier: MIT
 *
 * From a tile to the rays of its chunks: components that cannot be met are left out, and cones of
 * 16x16 and of 4x4 pixels are sent ahead along each of the others. */
#include "desk.h"

#include <float.h>
#include <math.h>

enum { CONE_BUDGET = 64, CHUNKS_A_SIDE = SPT_TILE / SPTI_CHUNK_SIDE, BLOCK_SIDE = 4 };

/* ---- Memory --------------------------------------------------------------------------------- */

static size_t whole_lines(size_t size) {
    return (size + 63) / 64 * 64;
}

/* The bytes of a component beside the union's. */
static size_t bytes_a_component(void) {
    return sizeof(spti_call) + 1 + 2 * sizeof(uint32_t) + 2 * SPTI_BUNDLES * sizeof(float) +
           SPT_BATCH * sizeof(float);
}

size_t spti_desk_size(size_t components) {
    const size_t lazy = spti_union_size(components, SPT_BATCH);
    if (lazy == 0 || components > (SIZE_MAX - lazy) / 2 / bytes_a_component()) return 0;
    return whole_lines(sizeof(spti_desk)) + lazy + components * bytes_a_component() +
           (size_t)8 * 64;
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
    desk->starts = (float *)(void *)take(&left, components * SPT_BATCH * sizeof(float));
    desk->tile_list = (uint32_t *)(void *)take(&left, components * sizeof(uint32_t));
    desk->list = (uint32_t *)(void *)take(&left, components * sizeof(uint32_t));
    desk->settled = (unsigned char *)take(&left, components);
    spti_union_place(&desk->lazy, left, components, SPT_BATCH);
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
    lazy->rays = &desk->columns;
    lazy->first = 0;
    lazy->count = SPT_BATCH;
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
}

/* Sends bundles ahead along a component, or where they do not walk, up to its bound. Returns those
 * that may meet it. */
static unsigned send(spti_desk *desk, const spti_bundles *bundles, uint32_t component, int walk,
                     float t[SPTI_BUNDLES]) {
    const spti_call *const call = call_of(desk, component);
    const int culls = !(desk->job->frame.flags & SPT_FRAME_NO_CULLING);
    float before[SPTI_BUNDLES];
    unsigned met = 0;
    memcpy(before, t, sizeof before);
    if (walk && !(desk->job->frame.flags & SPT_FRAME_NO_CONES)) {
        const uint32_t budget =
            desk->settings.budget < CONE_BUDGET ? desk->settings.budget : CONE_BUDGET;
        desk->cone_evaluations += spti_bundles_walk(bundles, call, budget, t);
    } else if (culls) {
        spti_bundles_enter(bundles, call, t);
    }
    for (size_t i = 0; i < SPTI_BUNDLES; ++i) {
        if (!culls && !(t[i] < INFINITY)) t[i] = before[i];
        if (t[i] < INFINITY) met |= 1u << i;
    }
    return met & bundles->present;
}

/* ---- Tiles ---------------------------------------------------------------------------------- */

void spti_desk_tile(spti_desk *desk, uint32_t column, uint32_t row, int walk) {
    const size_t components = desk->job->scene.count;
    spti_bundles bundles;
    desk->tile_column = column;
    desk->tile_row = row;
    desk->tile_listed = 0;
    if (!has_rays_of_its_own(desk)) {
        squares(desk, column * SPT_TILE, row * SPT_TILE, SPTI_CHUNK_SIDE, &bundles);
    }
    for (size_t component = 0; component < components; ++component) {
        float *const t = desk->tile_t + component * SPTI_BUNDLES;
        for (size_t i = 0; i < SPTI_BUNDLES; ++i) t[i] = 0.0f;
        if (!has_rays_of_its_own(desk) && !send(desk, &bundles, (uint32_t)component, walk, t)) {
            continue;
        }
        desk->tile_list[desk->tile_listed++] = (uint32_t)component;
    }
    desk->kept += desk->tile_listed;
    desk->culled += components - desk->tile_listed;
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
    int any = 0;
    desk->all = desk->left >= part->x_0 && desk->left + side <= part->x_1 &&
                desk->top >= part->y_0 && desk->top + side <= part->y_1;
    for (size_t i = 0; i < SPT_BATCH; ++i) {
        const uint32_t column = spti_desk_column(desk, i), row = spti_desk_row(desk, i);
        const uint32_t x = column < grid->width ? column : grid->width - 1;
        const uint32_t y = row < grid->height ? row : grid->height - 1;
        desk->x[i] = ((float)x + 0.5f) * grid->step_x;
        desk->y[i] = ((float)y + 0.5f) * grid->step_y;
        desk->places[i] = spti_desk_place_of(desk, i);
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
        memcpy(&t, (const char *)depths->first + (ptrdiff_t)desk->places[i] * depths->stride,
               sizeof t);
        desk->t_max[i] = before < t ? before : t; /* NaN stays, a bad ray */
    }
    set_column(&desk->columns.t_max, desk->t_max, 4);
}

/* The rays of a chunk. Returns 0 where none is traced. */
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
        spti_cone_kernels_of[desk->isa]->rays(view, SPT_BATCH, desk->x, desk->y, &desk->rays);
        set_column(&desk->columns.t_min, &view->t_min, 0);
        set_column(&desk->columns.t_max, &view->t_max, 0);
        set_column(&desk->columns.path, NULL, 0);
    }
    set_column(&desk->columns.active, desk->all ? NULL : desk->active, 4);
    cut_at_depths(desk);
    return 1;
}

int spti_desk_chunk(spti_desk *desk, size_t index, int walk) {
    const uint32_t side = SPTI_CHUNK_SIDE;
    spti_bundles bundles;
    size_t listed = 0;
    desk->left = desk->tile_column * SPT_TILE + (uint32_t)(index % CHUNKS_A_SIDE) * side;
    desk->top = desk->tile_row * SPT_TILE + (uint32_t)(index / CHUNKS_A_SIDE) * side;
    if (desk->left >= desk->grid.width || desk->top >= desk->grid.height) return 0;
    if (!make_rays(desk)) return 0;
    if (has_rays_of_its_own(desk)) {
        spti_bundles_of_rays(desk->camera_rays, &bundles);
    } else {
        squares(desk, desk->left, desk->top, BLOCK_SIDE, &bundles);
    }
    for (size_t i = 0; i < desk->tile_listed; ++i) {
        const uint32_t component = desk->tile_list[i];
        const float tile_t = desk->tile_t[(size_t)component * SPTI_BUNDLES + index];
        float *const t = desk->block_t + (size_t)component * SPTI_BUNDLES;
        if (!(tile_t < INFINITY)) continue;
        for (size_t block = 0; block < SPTI_BUNDLES; ++block) t[block] = tile_t;
        if (send(desk, &bundles, component, walk, t)) desk->list[listed++] = component;
    }
    desk->lazy.listed = listed;
    return 1;
}

/* Sends a cone ahead for every pixel of a block, along every component; the least t of the
 * components is where a pixel is free of all. */
static void send_pixels(spti_desk *desk, size_t block, float *pixel_t) {
    const size_t first = block * SPTI_BUNDLES;
    spti_bundles bundles;
    const uint32_t x = spti_desk_column(desk, first), y = spti_desk_row(desk, first);
    for (size_t i = 0; i < SPTI_BUNDLES; ++i) pixel_t[first + i] = FLT_MAX;
    if (x >= desk->grid.width || y >= desk->grid.height) return;
    squares(desk, x, y, 1, &bundles);
    for (size_t place = 0; place < desk->lazy.listed; ++place) {
        float *const t = desk->starts + place * SPT_BATCH + first;
        send(desk, &bundles, desk->list[place], 1, t);
        for (size_t i = 0; i < SPTI_BUNDLES; ++i) {
            if (t[i] < pixel_t[first + i]) pixel_t[first + i] = t[i];
        }
    }
}

void spti_desk_open(spti_desk *desk, const float *starts, float *pixel_t) {
    for (size_t place = 0; place < desk->lazy.listed; ++place) {
        const float *const t = desk->block_t + (size_t)desk->list[place] * SPTI_BUNDLES;
        float *const to = desk->starts + place * SPT_BATCH;
        for (size_t i = 0; i < SPT_BATCH; ++i) {
            const float block = t[i / SPTI_BUNDLES];
            to[i] = starts != NULL && starts[i] > block ? starts[i] : block;
        }
    }
    for (size_t block = 0; pixel_t != NULL && block < SPTI_BUNDLES; ++block) {
        send_pixels(desk, block, pixel_t);
    }
    spti_union_begin(&desk->lazy, desk->starts);
}

/* ---- Tracing -------------------------------------------------------------------------------- */

enum { RESULTS = 9 };

/* The sinks of an image one by one. */
static void list_sinks(const spt_hits *hits, spt_sink sinks[RESULTS]) {
    const spt_sink all[RESULTS] = {hits->t,           hits->residual,        hits->outcome,
                                   hits->evaluations, hits->flags,           hits->component,
                                   hits->candidate_t, hits->candidate_ratio, hits->fallbacks};
    memcpy(sinks, all, sizeof all);
}

/* Brings what was asked for from desk->alone to the image. */
static void write_alone(const spti_desk *desk, const spt_hits *image) {
    const spt_hits all = spt_hits_of((spt_hit *)(uintptr_t)desk->alone); /* only read */
    spt_sink from[RESULTS], to[RESULTS];
    list_sinks(&all, from);
    list_sinks(image, to);
    for (int result = 0; result < RESULTS; ++result) {
        char *const base = to[result].first;
        const char *const source = from[result].first;
        const ptrdiff_t stride = to[result].stride;
        if (base == NULL) continue;
        for (size_t i = 0; i < SPT_BATCH; ++i) {
            if (!desk->all && desk->active[i] == 0) continue;
            memcpy(base + (ptrdiff_t)desk->places[i] * stride, source + i * sizeof(spt_hit), 4);
        }
    }
}

/* A chunk that can meet nothing. */
static void miss_all(spti_desk *desk) {
    static const spt_hit miss = {INFINITY, INFINITY, SPT_MISS, 0, 0, -1, INFINITY, INFINITY, 0};
    uint64_t rays = 0;
    for (size_t i = 0; i < SPT_BATCH; ++i) {
        desk->alone[i] = miss;
        rays += desk->all || desk->active[i] != 0;
    }
    if (desk->statistics != NULL) {
        desk->statistics->rays += rays;
        desk->statistics->outcomes[SPT_MISS] += rays;
    }
}

/* A chunk that can meet one component only needs no union: it is traced as spt_trace() does. */
static void trace_alone(spti_desk *desk, const spt_hits *image) {
    const uint32_t component = desk->list[0];
    const float *const t = desk->block_t + (size_t)component * SPTI_BUNDLES;
    const spt_hits all = spt_hits_of(desk->alone);
    spt_hits sinks = all;
    spt_rays columns = desk->columns;
    spti_call call = *call_of(desk, component);
    for (size_t i = 0; i < SPT_BATCH; ++i) {
        const float own = has_rays_of_its_own(desk) ? desk->t_min[i] : desk->job->view.t_min;
        const float start = t[i / SPTI_BUNDLES] < FLT_MAX ? t[i / SPTI_BUNDLES] : FLT_MAX;
        desk->t_min[i] = start > own ? start : own; /* NaN stays, a bad ray */
    }
    set_column(&columns.t_min, desk->t_min, 4);
    if (image->t.first == NULL) sinks.t.first = NULL;
    if (image->residual.first == NULL) sinks.residual.first = NULL;
    if (image->outcome.first == NULL) sinks.outcome.first = NULL;
    if (image->evaluations.first == NULL) sinks.evaluations.first = NULL;
    if (image->flags.first == NULL) sinks.flags.first = NULL;
    if (image->component.first == NULL) sinks.component.first = NULL;
    if (image->candidate_t.first == NULL) sinks.candidate_t.first = NULL;
    if (image->candidate_ratio.first == NULL) sinks.candidate_ratio.first = NULL;
    if (image->fallbacks.first == NULL) sinks.fallbacks.first = NULL;
    call.rays = &columns;
    call.hits = &sinks;
    call.leave = spti_write_hits;
    call.stop = NULL;
    call.allowance = NULL;
    spti_call_settle(&call);
    call.field.lipschitz = 1.0f; /* slopes are counted relative to it */
    spti_trace_chunk(&call, &desk->lazy.chunk, 0, SPT_BATCH);
    for (size_t i = 0; i < SPT_BATCH && image->component.first != NULL; ++i) {
        if (desk->alone[i].component == 0) desk->alone[i].component = (int32_t)component;
    }
}

void spti_desk_trace(spti_desk *desk, const spt_hits *image) {
    const size_t listed = desk->lazy.listed;
    if (listed == 0 && !has_rays_of_its_own(desk)) {
        miss_all(desk);
        write_alone(desk, image);
    } else if (listed == 1 && desk->lazy.zone_count == 0) {
        trace_alone(desk, image);
        write_alone(desk, image);
    } else {
        spti_desk_open(desk, NULL, NULL);
        spti_union_run(&desk->lazy);
        spti_desk_write(desk, image);
    }
}

void spti_desk_write(const spti_desk *desk, const spt_hits *image) {
    const spti_record *const records = desk->lazy.records;
    if (image != NULL) spti_records_write(records, SPT_BATCH, image, 0, desk->places);
    if (desk->statistics != NULL) spti_records_count(records, SPT_BATCH, desk->statistics);
}

void spti_desk_adopt(spti_desk *desk, spt_statistics *statistics) {
    desk->statistics = statistics;
    for (size_t component = 0; component < desk->job->scene.count; ++component) {
        if (desk->settled[component]) desk->calls[component].statistics = statistics;
    }
}
