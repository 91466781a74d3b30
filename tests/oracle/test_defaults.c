/* SPDX-License-Identifier: MIT
 *
 * The defaults of trace.h are what the rule of choice.h takes from the counts in choice_table.h,
 * and those counts are of this library; SPT_BATCH and the schedule of frames follow their own
 * rules. Left out: lost rays, which the report counts. */
#include "choice.h"
#include "choice_table.h"
#include "../../src/trace/chunk.h"
#include "../check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { few_most = choice_width * choice_height, methods = choice_sweeps };

static int values_of(int sweep) {
    return sweep == methods ? (int)choice_methods : choice_sweep_of[sweep].count;
}

static const char *method_of(int sweep, int value) {
    return sweep == methods ? choice_method[value] : choice_sweep_of[sweep].method;
}

/* The row of the table: it stands in the order of the sweeps. */
static const choice_row *row_of(int sweep, int value) {
    int place = value;
    for (int i = 0; i < sweep; ++i) place += values_of(i);
    return &choice_table[place];
}

static int is_first_of_setting(int sweep) {
    for (int i = 0; i < sweep; ++i) {
        if (strcmp(choice_sweep_of[i].setting, choice_sweep_of[sweep].setting) == 0) return 0;
    }
    return 1;
}

/* The place of what the rule takes from the table. */
static int chosen_of(int sweep) {
    choice_value values[choice_most_values];
    for (int i = 0; i < values_of(sweep); ++i) {
        values[i].evaluations = row_of(sweep, i)->evaluations;
        values[i].lost = row_of(sweep, i)->lost;
    }
    return choice_pick(values, values_of(sweep));
}

/* The table has a row for every value. */
static void D1_table_is_whole(void) {
    int rows = 0;
    for (int sweep = 0; sweep <= methods; ++sweep) rows += values_of(sweep);
    CHECK(rows == choice_rows);
    for (int sweep = 0; sweep <= methods && rows == choice_rows; ++sweep) {
        for (int value = 0; value < values_of(sweep); ++value) {
            const choice_row *const row = row_of(sweep, value);
            check_context("row %s %s %g", row->setting, row->method, row->value);
            CHECK(strcmp(row->method, method_of(sweep, value)) == 0);
            if (sweep == methods) continue;
            CHECK(strcmp(row->setting, choice_sweep_of[sweep].setting) == 0);
            CHECK(check_same_bits((float)row->value, choice_sweep_of[sweep].values[value]));
        }
    }
}

static void D2_defaults_are_what_the_rule_takes(void) {
    spt_settings defaults = spt_settings_default();
    for (int sweep = 0; sweep < choice_sweeps; ++sweep) {
        const choice_sweep *const swept = &choice_sweep_of[sweep];
        const int chosen = chosen_of(sweep);
        if (!is_first_of_setting(sweep)) continue;
        CHECK(chosen >= 0);
        if (chosen < 0) continue;
        const float header = *choice_setting(&defaults, swept->setting);
        CHECK_SAY(check_same_bits(header, swept->values[chosen]), "%s: %g in trace.h, chosen %g",
                  swept->setting, (double)header, (double)swept->values[chosen]);
    }
    const int chosen = chosen_of(methods);
    CHECK(chosen >= 0);
    if (chosen < 0) return;
    CHECK_SAY(strcmp(spt_method_name(defaults.method), choice_method[chosen]) == 0,
              "%s in trace.h, chosen %s", spt_method_name(defaults.method), choice_method[chosen]);
}

/* ---- The table and this library -------------------------------------------------------------- */

/* What was measured around: the chosen values, whatever trace.h says. */
static spt_settings chosen_settings(void) {
    spt_settings settings = spt_settings_default();
    for (int sweep = 0; sweep < choice_sweeps; ++sweep) {
        const int chosen = chosen_of(sweep);
        if (!is_first_of_setting(sweep) || chosen < 0) continue;
        *choice_setting(&settings, choice_sweep_of[sweep].setting) =
            choice_sweep_of[sweep].values[chosen];
    }
    return settings;
}

typedef struct small_value {
    uint64_t sampled;
    double logarithms, variance; /* of the logarithm's estimate, summed */
} small_value;

typedef struct small_sweep {
    small_value value[choice_sweeps + 1][choice_most_values];
} small_sweep;

/* The mean m of n counts of variance v stands for all rays with a variance of v / n, and its
 * logarithm with v / (n m^2). */
static void add_count(small_value *to, const choice_count *counted, double count) {
    const double mean = (double)counted->sum / count;
    const double variance = (double)counted->squares / count - mean * mean;
    to->sampled += counted->sum;
    to->logarithms += log(mean);
    to->variance += variance / (count * mean * mean);
}

static void add_scene(small_sweep *small, const scene *shown, spt_ray *rays, spt_hit *hits) {
    const spt_settings given = chosen_settings();
    float pixel_radius;
    const size_t count = choice_rays(shown, choice_every, rays, &pixel_radius);
    for (int stop = 0; stop < choice_stops; ++stop) {
        for (int sweep = 0; sweep <= methods; ++sweep) {
            for (int value = 0; value < values_of(sweep); ++value) {
                spt_settings settings =
                    choice_settings(&given, method_of(sweep, value), stop, pixel_radius);
                if (sweep != methods) {
                    *choice_setting(&settings, choice_sweep_of[sweep].setting) =
                        choice_sweep_of[sweep].values[value];
                }
                const choice_count counted =
                    choice_evaluations(shown, &settings, count, rays, hits);
                add_count(&small->value[sweep][value], &counted, (double)count);
            }
        }
    }
}

static void check_value(const small_sweep *small, int sweep, int value) {
    const small_value *const seen = &small->value[sweep][value];
    const choice_row *const row = row_of(sweep, value);
    const int terms = choice_kinds * choice_stops;
    const double off = seen->logarithms / terms - log(row->evaluations);
    check_context("%s %s %g", row->setting, row->method, row->value);
    CHECK_SAY(seen->sampled == row->sampled, "%llu evaluations, the table has %llu: measure again",
              (unsigned long long)seen->sampled, (unsigned long long)row->sampled);
    /* Four standard deviations of what so few rays say. */
    CHECK_SAY(fabs(off) <= 4 * sqrt(seen->variance) / terms, "off by %.2f %%", 100 * off);
}

/* The same sweep with few rays: to the last evaluation what the table says, means like its means,
 * and the rule takes the same values. */
static void D3_table_is_of_this_library(void) {
    static small_sweep small;
    spt_ray *const rays = malloc(few_most * sizeof *rays);
    spt_hit *const hits = malloc(few_most * sizeof *hits);
    CHECK(rays != NULL && hits != NULL);
    memset(&small, 0, sizeof small);
    for (int kind = 0; rays != NULL && hits != NULL && kind < choice_kinds; ++kind) {
        add_scene(&small, scene_named(choice_kind[kind]), rays, hits);
    }
    for (int sweep = 0; sweep <= methods; ++sweep) {
        choice_value values[choice_most_values];
        for (int value = 0; value < values_of(sweep); ++value) {
            check_value(&small, sweep, value);
            values[value].evaluations =
                exp(small.value[sweep][value].logarithms / (choice_kinds * choice_stops));
            values[value].lost = row_of(sweep, value)->lost;
        }
        CHECK(choice_pick(values, values_of(sweep)) == chosen_of(sweep));
    }
    free(rays);
    free(hits);
}

/* ---- Chunks and schedules -------------------------------------------------------------------- */

static size_t state_bytes(size_t rays) {
    return SPTI_ARRAYS * (rays + SPTI_GROUP) * sizeof(float);
}

/* The most rays, of powers of two, whose state fits in a first data cache of 32 KiB. */
static void D4_batch_fits_the_first_cache(void) {
    CHECK(state_bytes(SPT_BATCH) <= 32768);
    CHECK(state_bytes(2 * SPT_BATCH) > 32768);
}

enum { frame_width = 80, frame_height = 60 };

/* Evaluations of a whole picture, cones included; passes 0: tile by tile. */
static uint64_t picture(const scene *shown, uint32_t flags, size_t passes) {
    const spt_field field = scene_field(shown, spt_lanes());
    const spt_camera camera = scene_camera(shown, frame_width, frame_height);
    spt_scene all = spt_scene_default();
    spt_statistics statistics = spt_statistics_default();
    spt_frame_progress progress = {0, 0, 0, 0, 0};
    spt_frame frame;
    spt_hits nothing;
    memset(&nothing, 0, sizeof nothing);
    all.fields = &field;
    all.count = 1;
    CHECK(spt_frame_init(&frame, &all, &camera, frame_width, frame_height) == SPT_OK);
    frame.flags = flags;
    frame.statistics = &statistics;
    if (passes != 0) {
        frame.passes = spt_passes(passes);
        frame.pass_count = passes;
    }
    const size_t size = passes != 0 ? spt_frame_state_size(&frame) : spt_frame_workspace(&frame);
    void *const memory = malloc(size);
    CHECK(memory != NULL);
    if (memory == NULL) return 0;
    if (passes != 0) {
        CHECK(spt_frame_restart(&frame, memory, size) == SPT_OK);
        CHECK(spt_frame_advance(&frame, memory, size, UINT64_MAX, &nothing, &progress) == SPT_OK);
        CHECK(progress.pass == passes);
    } else {
        frame.workspace = memory;
        frame.workspace_size = size;
        CHECK(spt_frame_trace(&frame, 0, spt_frame_tiles(&frame), &nothing, NULL) == SPT_OK);
    }
    free(memory);
    return statistics.evaluations + statistics.cone_evaluations;
}

static double mean_picture(uint32_t flags, size_t passes) {
    double sum = 0;
    for (int kind = 0; kind < choice_kinds; ++kind) {
        sum += log((double)picture(scene_named(choice_kind[kind]), flags, passes));
    }
    return exp(sum / choice_kinds);
}

/* Tiles with cones, which is what a frame does unless it is told otherwise, take the fewest
 * evaluations of all schedules. */
static void D5_schedule(void) {
    const scene *const sphere = scene_named("sphere");
    const spt_camera camera = scene_camera(sphere, frame_width, frame_height);
    const spt_field field = scene_field(sphere, spt_lanes());
    spt_scene all = spt_scene_default();
    spt_frame frame;
    all.fields = &field;
    all.count = 1;
    CHECK(spt_frame_init(&frame, &all, &camera, frame_width, frame_height) == SPT_OK);
    CHECK(frame.flags == 0 && frame.passes == NULL);
    const double cones = mean_picture(frame.flags, 0);
    CHECK(cones < mean_picture(SPT_FRAME_NO_CONES, 0));
    for (size_t passes = 2; passes <= 6; passes += 2) {
        check_context("%d passes", (int)passes);
        CHECK(cones < mean_picture(0, passes));
    }
}

/* ---- The rule itself ------------------------------------------------------------------------- */

static void D6_rule(void) {
    const choice_value falling[] = {{4, 0}, {3, 0}, {2, 0}},
                       near_least[] = {{2.02, 0}, {2.009, 0}, {2, 0}};
    const choice_value losing[] = {{2, 0}, {1, 1}, {3, 0}}, all_lose[] = {{2, 1}, {1, 7}};
    const choice_value valley[] = {{2.5, 0}, {2.1, 0}, {2.0, 0}, {2.001, 0}};
    CHECK(choice_pick(falling, 3) == 2);
    CHECK(choice_pick(near_least, 3) == 1);
    CHECK(choice_pick(losing, 3) == 0);
    CHECK(choice_pick(all_lose, 2) == -1);
    CHECK(choice_pick(valley, 4) == 2);
    CHECK(choice_pick(valley, 0) == -1);
}

void suite_defaults(void) {
    RUN(D1_table_is_whole);
    RUN(D2_defaults_are_what_the_rule_takes);
    RUN(D3_table_is_of_this_library);
    RUN(D4_batch_fits_the_first_cache);
    RUN(D5_schedule);
    RUN(D6_rule);
}
