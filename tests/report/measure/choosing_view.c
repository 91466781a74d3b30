/* SPDX-License-Identifier: MIT
 *
 * Rays, what is true of them, and what became of them. */
#include "choosing.h"

#include <math.h>
#include <stdlib.h>

#include "../../bench/truth.h"
#include "../../oracle/tolerance.h"

choosing_view *choosing_view_of(const report_options *options, const scene *shown, int stop) {
    const size_t most = (size_t)choice_width * choice_height;
    choosing_view *const view = report_allocate(sizeof *view);
    view->shown = *shown;
    view->stop = stop;
    view->bound = choosing_is_bound(shown);
    view->rays = report_allocate(most * sizeof *view->rays);
    view->count = choice_rays(shown, options->quick ? 2 : 1, view->rays, &view->pixel_radius);
    view->hits = report_allocate(view->count * sizeof *view->hits);
    view->last_t = report_allocate(view->count * sizeof *view->last_t);
    const spt_settings defaults = spt_settings_default();
    const spt_settings settings = choice_settings(&defaults, "basic", stop, view->pixel_radius);
    for (size_t i = 0; i < view->count; ++i) {
        view->last_t[i] = truth_last_t(shown, &settings, &view->rays[i]);
    }
    return view;
}

void choosing_view_free(choosing_view *view) {
    free(view->rays);
    free(view->hits);
    free(view->last_t);
    free(view);
}

/* Farther from zero than tolerance and rounding explain. Of a field that is no distance bound a jump
 * of f, and a bracket between samples, is said to be no certain hit and is not counted. */
static int is_wrong(const choosing_view *view, const spt_settings *settings, const spt_ray *ray,
                    const spt_hit *hit) {
    const double t = (double)hit->t;
    double p[3], distance;
    const int excused = !view->bound && (hit->flags & SPT_FLAG_STEEP) != 0;
    if (hit->outcome != SPT_HIT || excused) return 0;
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = (double)ray->origin[axis] + t * (double)ray->direction[axis];
    }
    view->shown.reference(1, &p[0], &p[1], &p[2], &distance);
    const double most = oracle_tolerance(settings, ray, t) + 2 * oracle_floor(settings, ray, t);
    return fabs(distance) / (double)view->shown.lipschitz > most;
}

choosing_count choosing_trace(const choosing_view *view, const spt_settings *settings) {
    choosing_count count = {0, 0, 0, 0, 0, 0, 0};
    const spt_field field = scene_field(&view->shown, spt_lanes());
    const spt_rays from = spt_rays_of(view->rays);
    const spt_hits to = spt_hits_of(view->hits);
    spt_statistics statistics = spt_statistics_default();
    report_expect(spt_trace(&field, settings, view->count, &from, &to, &statistics) == SPT_OK,
                  "a trace was refused");
    for (size_t i = 0; i < view->count; ++i) {
        const spt_hit *const hit = &view->hits[i];
        const bench_hit end = {hit->t, hit->residual, hit->outcome, hit->evaluations};
        const int lost = truth_lost(view->last_t[i], &end),
                  late = truth_late(view->last_t[i], &end);
        count.lost += lost != 0;
        count.late += late != 0;
        count.flagged += (lost || late) && (hit->flags & SPT_FLAG_STEEP) != 0;
        count.wrong += is_wrong(view, settings, &view->rays[i], hit) != 0;
    }
    count.evaluations = (double)statistics.evaluations / (double)view->count;
    count.fallbacks = (double)statistics.fallbacks / (double)view->count;
    count.undecided = statistics.outcomes[SPT_LIMIT];
    return count;
}
