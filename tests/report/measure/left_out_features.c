/* SPDX-License-Identifier: MIT
 *
 * features.csv: what each option of spt_trace() takes when it is switched on, in time. Queries and
 * frames are in left_out_queries.c. */
#include "../left_out_options.h"
#include "left_out_race.h"

#include <stdlib.h>

static const char *const option_scenes[] = {"primitives", "mandelbulb", "dodecahedron"};
static const char *const option_methods[] = {"adaptive", "basic"};
enum { option_scene_count = 3, width = 320, height = 192 };

static int option_cells(const report_options *options_of_run) {
    return option_scene_count * (options_of_run->quick ? 1 : 2);
}

static void run_call(const void *work, size_t start) {
    option_call call = *(const option_call *)work;
    for (int axis = 0; axis < 3; ++axis) {
        call.rays.origin[axis].first =
            (const char *)call.rays.origin[axis].first + start * sizeof(spt_ray);
        call.rays.direction[axis].first =
            (const char *)call.rays.direction[axis].first + start * sizeof(spt_ray);
    }
    report_expect(option_call_run(&call, left_out_slice) == SPT_OK, "a call was refused");
}

/* The candidate that looks between samples, too, over the one at samples. */
static void add_between(option_call *call) {
    option_candidate(call);
    call->settings.flags |= SPT_CANDIDATE_CLOSEST;
}

static void enter_options(left_out_field *field, const option_call *plain, option_call *calls) {
    int candidate = 0;
    calls[0] = *plain;
    left_out_enter(field, NULL, NULL, 0, run_call, &calls[0]);
    for (int i = 0; i < option_count; ++i) {
        option_call *const call = &calls[field->count];
        /* All rays here end at the scene's t_max. */
        if (options[i].add == option_t_max) continue;
        *call = *plain;
        options[i].add(call);
        if (options[i].add == option_candidate) candidate = field->count;
        left_out_enter(field, options[i].name, options[i].kind, 0, run_call, call);
    }
    calls[field->count] = *plain;
    add_between(&calls[field->count]);
    left_out_enter(field, "closest candidate", "flag", candidate, run_call, &calls[field->count]);
}

static void measure_options(const report_options *options_of_run, int cell, FILE *rows) {
    static option_call calls[left_out_most_runners];
    static spt_hit hit[left_out_slice];
    const scene *const shown = scene_named(option_scenes[cell % option_scene_count]);
    bench_picture picture = bench_picture_of(shown, width, height);
    const char *const method = option_methods[cell / option_scene_count];
    const spt_settings settings = bench_settings(method, picture.pixel_radius, spt_lanes());
    const float t_max = (float)shown->t_max;
    const spt_bound *const own = shown->bound;
    left_out_field field = {shown->name, method, picture.count, 0, {{NULL, NULL, 0, NULL, NULL}}};
    spt_field traced = scene_field(shown, spt_lanes());
    traced.bound = NULL; /* so that it is an option, too */
    option_call plain = option_call_of(&traced, &settings, picture.rays, hit);
    plain.rays.t_max.first = &t_max;
    enter_options(&field, &plain, calls);
    if (own != NULL) {
        option_call *const call = &calls[field.count];
        *call = plain;
        call->field.bound = own;
        left_out_enter(&field, "bound that fits", "field", 0, run_call, call);
    }
    left_out_race(options_of_run, &field, rows);
    bench_picture_free(&picture);
}

static int cells(const report_options *options_of_run) {
    return option_cells(options_of_run) + left_out_query_cells;
}

static void measure(const report_options *options_of_run, int cell, FILE *rows) {
    const int own = option_cells(options_of_run);
    if (cell < own)
        measure_options(options_of_run, cell, rows);
    else
        left_out_measure_query(options_of_run, cell - own, rows);
}

const report_part report_features = {
    "features", "feature,scene,method,ratio,low,high,kind", cells, measure, 1, {37, 3}};
