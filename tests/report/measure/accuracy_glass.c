/* SPDX-License-Identifier: MIT
 *
 * Where and how light leaves bodies of glass, by the tolerance, against exact crossings and Snell's
 * law. Left out: paths that pass an edge or the critical angle so closely that a tracer may rightly
 * take another one. */
#include "accuracy.h"

#include "../../oracle/glass_run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double tolerances[] = {2e-6, 5e-6, 2e-5, 1e-4, 3e-4, 1e-3};

/* From three radii away towards somewhere in the body. */
static spt_ray draw(report_random *random, const glass_body *body) {
    spt_ray ray = {{0, 0, 0}, 0, {0, 0, 0}, 100};
    double out[3], to[3], length = 0;
    accuracy_unit(random, out);
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = (float)(body->center[axis] + 3 * out[axis]);
        to[axis] =
            body->center[axis] + report_uniform(random, -0.6, 0.6) - (double)ray.origin[axis];
        length += to[axis] * to[axis];
    }
    for (int axis = 0; axis < 3; ++axis) ray.direction[axis] = (float)(to[axis] / sqrt(length));
    return ray;
}

/* glass_trace() keeps what it works on, so no other cell may call it. */
static void follow(report_random *random, double tolerance, int number, accuracy_errors *point,
                   accuracy_errors *direction) {
    glass_body body = glass_body_number(number % 6);
    glass_run run;
    spt_ray *const rays = report_allocate(glass_rays * sizeof *rays);
    glass_record *const records = report_allocate(glass_rays * sizeof *records);
    memset(&run, 0, sizeof run);
    run.body = &body;
    run.index = 1.5;
    run.settings = spt_settings_default();
    run.settings.budget = 100000;
    run.settings.epsilon = (float)tolerance;
    run.settings.flags = SPT_SKIP_START;
    run.checks = 4;
    run.declared = 1;
    run.gradient = 1;
    for (int i = 0; i < glass_rays; ++i) rays[i] = draw(random, &body);
    glass_trace(&run, glass_rays, rays, records);
    for (int i = 0; i < glass_rays; ++i) {
        glass_path truth;
        const int last = glass_follow_ray(&run, &rays[i], &truth) ? truth.count - 1 : -1;
        if (last < 0 || !truth.event[last].certain) continue;
        const int same = records[i].count == truth.count && !records[i].lost;
        accuracy_add(point, same ? glass_apart(truth.event[last].point, records[i].point[last])
                                 : HUGE_VAL);
        accuracy_add(direction,
                     same ? glass_apart(truth.event[last].direction, records[i].direction[last])
                          : HUGE_VAL);
    }
    free(rays);
    free(records);
}

void accuracy_glass(const report_options *options, FILE *rows) {
    const accuracy_subject places = {"glass_place", "tolerance", "world length", ""};
    const accuracy_subject directions = {"glass_direction", "tolerance", "radians", ""};
    enum { count = sizeof tolerances / sizeof tolerances[0] };
    accuracy_errors point[count], direction[count];
    for (int i = 0; i < count; ++i) {
        report_random random = {0};
        point[i] = direction[i] = (accuracy_errors){NULL, 0, 0};
        for (size_t run = 0; run < 6 * accuracy_samples(options, 32); ++run)
            follow(&random, tolerances[i], (int)run, &point[i], &direction[i]);
    }
    for (int i = 0; i < count; ++i) accuracy_write(rows, &places, tolerances[i], 0, &point[i]);
    for (int i = 0; i < count; ++i)
        accuracy_write(rows, &directions, tolerances[i], 0, &direction[i]);
}
