/* SPDX-License-Identifier: MIT
 *
 * binary.csv: the bonus and the penalty of binary tracing, of which Szécsi et al. (2016, section
 * 12) did no extensive analysis; binary_mean.csv: geometric means; binary_best.csv: the best pair
 * of each body; binary_endless.csv: rays without end that meet nothing. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <scenes/models.h>

#include "../../oracle/survey.h"
#include "../../oracle/tolerance.h"
#include "../csv.h"
#include "choosing.h"

static const char *const bodies[] = {"sphere",       "plane", "thin_torus",  "village_boxes",
                                     "smooth_union", "slabs", "krs_tree_16", "palm_crown"};
enum { body_count = sizeof bodies / sizeof bodies[0], palm = body_count - 1 };

static const float bonuses[] = {1.1f, 1.25f, 1.5f, 1.75f, 2, 2.5f, 3, 4, 6};
static const float penalties[] = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f};
enum {
    bonus_count = sizeof bonuses / sizeof bonuses[0],
    penalty_count = sizeof penalties / sizeof penalties[0],
    pair_count = bonus_count * penalty_count,
    cell_count = body_count * choice_stops,
    most_probes = 4000
};

/* A body, its rays, and where they meet it: of the palm, which has no reference in double, that is
 * not known. */
typedef struct binary_view {
    spt_probe probe;
    spt_field field;
    model_world *world;
    int stop;
    size_t count;
    float pixel_radius;
    spt_ray *rays;
    spt_hit *hits;
    survey_truth *truth;
} binary_view;

static scene palm_scene(void) {
    const model *const shown = model_named("palm");
    scene as_scene;
    memset(&as_scene, 0, sizeof as_scene);
    for (int axis = 0; axis < 3; ++axis) {
        as_scene.eye[axis] = shown->eye[axis];
        as_scene.target[axis] = shown->target[axis];
    }
    as_scene.field_of_view = shown->field_of_view;
    as_scene.t_max = shown->t_max;
    return as_scene;
}

static spt_settings binary_settings(const binary_view *view) {
    const spt_settings defaults = spt_settings_default();
    spt_settings settings = choice_settings(&defaults, "basic", view->stop, view->pixel_radius);
    settings.budget = most_probes;
    return settings;
}

static binary_view *view_of(const report_options *options, int body, int stop) {
    const scene shown = body == palm ? palm_scene() : *scene_named(bodies[body]);
    const size_t most = (size_t)choice_width * choice_height;
    binary_view *const view = report_allocate(sizeof *view);
    view->stop = stop;
    view->rays = report_allocate(most * sizeof *view->rays);
    view->count = choice_rays(&shown, options->quick ? 4 : 2, view->rays, &view->pixel_radius);
    view->hits = report_allocate(view->count * sizeof *view->hits);
    if (body == palm) {
        view->world = report_allocate(sizeof *view->world);
        report_expect(model_named("palm")->build(view->world, 0), "the palm was refused");
        view->probe = spt_moekrs_probe(&view->world->moekrs[0]);
    } else {
        const spt_settings settings = binary_settings(view);
        view->field = scene_field(&shown, spt_lanes());
        view->probe = spt_probe_of_field(&view->field);
        view->truth = report_allocate(view->count * sizeof *view->truth);
        survey_find_truth(&shown, &settings, view->count, view->rays, view->truth);
    }
    return view;
}

static void view_free(binary_view *view) {
    free(view->rays);
    free(view->hits);
    free(view->truth);
    free(view->world);
    free(view);
}

/* How far hits are short of the surface, in tolerances, and how many rays missed what is there. */
typedef struct binary_judgement {
    double error;
    unsigned long lost, undecided;
} binary_judgement;

static binary_judgement judge(const binary_view *view, const spt_settings *settings) {
    binary_judgement seen = {0, 0, 0};
    size_t hits = 0;
    for (size_t i = 0; i < view->count; ++i) {
        const spt_hit *const hit = &view->hits[i];
        seen.undecided += hit->outcome == SPT_LIMIT;
        if (view->truth == NULL) continue;
        const survey_truth *const truth = &view->truth[i];
        const double t = (double)hit->t;
        if (truth->through < HUGE_VAL && hit->outcome != SPT_LIMIT) {
            seen.lost += hit->outcome != SPT_HIT || t > truth->through;
        }
        if (hit->outcome != SPT_HIT || !(truth->t < HUGE_VAL)) continue;
        seen.error += fabs(truth->t - t) / oracle_tolerance(settings, &view->rays[i], t);
        ++hits;
    }
    if (hits > 0) seen.error /= (double)hits;
    return seen;
}

static int cells(const report_options *options) {
    (void)options;
    return cell_count;
}

/* A hit is short of the surface by up to probe_ratio / penalty tolerances, times what the slope
 * makes of it: probe_ratio goes with the penalty, so that all pairs are held to the same error. */
static void measure(const report_options *options, int cell, FILE *rows) {
    const int body = cell / choice_stops;
    binary_view *const view = view_of(options, body, cell % choice_stops);
    const spt_settings settings = binary_settings(view);
    const spt_rays from = spt_rays_of(view->rays);
    const spt_hits to = spt_hits_of(view->hits);
    for (int i = 0; i < pair_count; ++i) {
        spt_binary binary = spt_binary_default();
        spt_statistics statistics = spt_statistics_default();
        const float share = binary.probe_ratio / binary.penalty;
        binary.bonus = bonuses[i / penalty_count];
        binary.penalty = penalties[i % penalty_count];
        binary.probe_ratio = share * binary.penalty;
        report_expect(spt_binary_trace(&view->probe, &binary, &settings, view->count, &from, &to,
                                       &statistics) == SPT_OK,
                      "binary tracing was refused");
        const binary_judgement seen = judge(view, &settings);
        fprintf(rows, "%.6g,%.6g,%s,%s,%.9g,", (double)binary.bonus, (double)binary.penalty,
                bodies[body], choice_stop[view->stop],
                (double)statistics.evaluations / (double)view->count);
        if (view->truth != NULL) {
            fprintf(rows, "%.9g,%lu,%lu\n", seen.error, seen.lost, seen.undecided);
        } else {
            fprintf(rows, ",,%lu\n", seen.undecided);
        }
    }
    view_free(view);
}

const report_part report_binary = {
    "binary", "bonus,penalty,body,stop,probes,error,lost,undecided", cells, measure, 0, {4, 1}};

/* ---- Means ----------------------------------------------------------------------------------- */

/* The probes of a pair in a cell: rows stand in the order in which they were measured. */
static double probes_of(const csv_table *from, int cell, int pair) {
    return csv_number(from, cell * pair_count + pair, "probes");
}

static csv_table *open_whole(const report_options *options) {
    csv_table *const from = csv_open(options->output, "binary");
    report_expect(csv_rows(from) == pair_count * cell_count, "binary.csv is not whole");
    return from;
}

static int one_cell(const report_options *options) {
    (void)options;
    return 1;
}

static double mean_of(const csv_table *from, int pair) {
    double sum = 0;
    for (int cell = 0; cell < cell_count; ++cell) sum += log(probes_of(from, cell, pair));
    return exp(sum / cell_count);
}

static double sum_of(const csv_table *from, int pair, const char *column) {
    double sum = 0;
    for (int cell = 0; cell < cell_count; ++cell) {
        const double value = csv_number(from, cell * pair_count + pair, column);
        if (!isnan(value)) sum += value;
    }
    return sum;
}

static void mean_measure(const report_options *options, int cell, FILE *rows) {
    csv_table *const from = open_whole(options);
    double least = HUGE_VAL;
    (void)cell;
    for (int pair = 0; pair < pair_count; ++pair) least = fmin(least, mean_of(from, pair));
    for (int pair = 0; pair < pair_count; ++pair) {
        const double mean = mean_of(from, pair);
        fprintf(rows, "%s,%s,%.9g,%.9g,%.9g,%.9g\n", csv_text(from, pair, "bonus"),
                csv_text(from, pair, "penalty"), mean, 100 * (mean / least - 1),
                sum_of(from, pair, "lost"), sum_of(from, pair, "undecided"));
    }
    csv_close(from);
}

const report_part report_binary_mean = {
    "binary_mean", "bonus,penalty,probes,above_least,lost,undecided", one_cell, mean_measure, 0,
    {0.1, 0.1}};

/* The pair of the paper (section 6.1). */
static int pair_of_paper(const csv_table *from) {
    const int row = csv_next(from, -1, "bonus=2,penalty=0.3");
    report_expect(row >= 0 && row < pair_count, "the paper's pair was not tried");
    return row;
}

static void best_measure(const report_options *options, int cell, FILE *rows) {
    csv_table *const from = open_whole(options);
    const int paper = pair_of_paper(from);
    (void)cell;
    for (int i = 0; i < cell_count; ++i) {
        int best = 0;
        for (int pair = 1; pair < pair_count; ++pair) {
            if (probes_of(from, i, pair) < probes_of(from, i, best)) best = pair;
        }
        const double probes = probes_of(from, i, best), paper_probes = probes_of(from, i, paper);
        fprintf(rows, "%s,%s,%s,%s,%.9g,%.9g,%.9g\n", bodies[i / choice_stops],
                choice_stop[i % choice_stops], csv_text(from, best, "bonus"),
                csv_text(from, best, "penalty"), probes, paper_probes,
                100 * (1 - probes / paper_probes));
    }
    csv_close(from);
}

const report_part report_binary_best = {
    "binary_best", "body,stop,bonus,penalty,probes,paper_probes,saved", one_cell, best_measure, 0,
    {0.1, 0.1}};

/* ---- Rays without end ------------------------------------------------------------------------ */

static float all_free(void *user, float x, float y, float z, float radius) {
    (void)user, (void)x, (void)y, (void)z;
    return radius;
}

/* A ray through nothing, as far as float reaches, from where its first probe has radius 1: how many
 * probes it takes, and whether the default budget is enough. */
static void endless_measure(const report_options *options, int cell, FILE *rows) {
    const spt_ray ray = {{1, 0, 0}, 0, {1, 0, 0}, HUGE_VALF};
    const spt_rays from = spt_rays_of(&ray);
    spt_probe nothing = spt_probe_default();
    nothing.point = all_free;
    (void)options, (void)cell;
    for (int i = 0; i < bonus_count; ++i) {
        spt_binary binary = spt_binary_default();
        spt_settings settings = spt_settings_default();
        const uint32_t budget = settings.budget;
        spt_hit hit;
        const spt_hits to = spt_hits_of(&hit);
        binary.bonus = bonuses[i];
        settings.budget = most_probes;
        report_expect(spt_binary_trace(&nothing, &binary, &settings, 1, &from, &to, NULL) == SPT_OK,
                      "binary tracing was refused");
        report_expect(hit.outcome == SPT_MISS, "a ray through nothing does not miss");
        fprintf(rows, "%.6g,%lu,%lu,%d\n", (double)binary.bonus, (unsigned long)hit.evaluations,
                (unsigned long)budget, hit.evaluations <= budget);
    }
}

const report_part report_binary_endless = {
    "binary_endless", "bonus,probes,budget,decided", one_cell, endless_measure, 0, {0.1, 0.1}};
