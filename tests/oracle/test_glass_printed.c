/* SPDX-License-Identifier: MIT
 *
 * Row K12 of the errata as a negative control: secondary rays that begin where Keinert et al. 2014,
 * section 3.3, puts them, along the normal by 2 max(epsilon_min, |f|), against spt_offset() on the
 * same rays. Left out: what is right, which test_glass_paths.c says. */
#include "check.h"
#include "glass_run.h"

#include <math.h>
#include <string.h>

/* The paper's epsilon_min, and tolerances of the hits, all but the last above twice that. */
static const float epsilon_min = 2e-6f;
static const float tolerances[] = {1e-3f, 1e-4f, 1e-5f, 2e-6f};
enum { tolerance_count = 4, ray_count = 17 };

typedef struct tally {
    int certain, at_once, right_number, right_exit; /* paths */
    double worst; /* error of an exit, where the number is right */
} tally;

static void follow(const glass_run *run, tally *sum) {
    spt_ray rays[ray_count];
    glass_record records[ray_count];
    for (int i = 0; i < ray_count; ++i) rays[i] = glass_ray_towards(run->body);
    glass_trace(run, ray_count, rays, records);
    for (int i = 0; i < ray_count; ++i) {
        const glass_record *seen = &records[i];
        const glass_event *last;
        glass_path truth;
        double off;
        if (!glass_follow_ray(run, &rays[i], &truth)) continue;
        last = &truth.event[truth.count - 1];
        if (!last->certain || truth.count < 2) continue;
        /* Whether the printed origin is within the tolerance is up to rounding, floor(4). */
        if (run->settings.epsilon > 2 * epsilon_min &&
            glass_distance(run->body, seen->point[0]) >
                (double)run->settings.epsilon - 0x1p-22 * 4) {
            continue;
        }
        ++sum->certain;
        sum->at_once += seen->count > 1 && seen->length[1] < 1e-6;
        if (seen->count != truth.count || seen->lost) continue;
        ++sum->right_number;
        off = glass_apart(seen->point[truth.count - 1], last->point);
        sum->right_exit += off <= last->off;
        sum->worst = fmax(sum->worst, off);
    }
}

static tally all_bodies(glass_start start, float tolerance) {
    tally sum = {0, 0, 0, 0, 0};
    for (int which = 0; which < 4; ++which) {
        glass_body body = which == 0   ? glass_ball()
                          : which == 1 ? glass_plate()
                          : which == 2 ? glass_cube()
                                       : glass_dodecahedron();
        glass_run run;
        memset(&run, 0, sizeof run);
        run.body = &body;
        run.index = 1.5;
        run.settings = spt_settings_default();
        run.settings.budget = 100000;
        run.settings.epsilon = tolerance;
        run.start = start;
        run.epsilon_min = epsilon_min;
        run.march = run.gradient = run.declared = 1;
        follow(&run, &sum);
    }
    return sum;
}

/* The printed origin lies max(2 epsilon_min - |f|, |f|) beyond the surface. Where the tolerance is
 * above twice epsilon_min that is within the tolerance, whatever f is, so that the next ray ends
 * where it begins. Most paths have the right number of events all the same: the ray enters, is in
 * the body and leaves at once, a whole body before the true exit. */
static void K12_printed_origins_hit_at_once(void) {
    for (int i = 0; i < tolerance_count; ++i) {
        const int above = tolerances[i] > 2 * epsilon_min;
        const tally printed = all_bodies(GLASS_PRINTED, tolerances[i]);
        const tally ours = all_bodies(GLASS_OFFSET, tolerances[i]);
        check_context("tolerance %g", (double)tolerances[i]);
        CHECK_SAY(printed.certain > 40 && ours.certain > 40, "%d and %d certain paths",
                  printed.certain, ours.certain);
        CHECK(!above || printed.at_once == printed.certain);
        CHECK(!above || printed.right_exit == 0);
        CHECK_SAY(!above || 10 * printed.right_number > 7 * printed.certain, "%d of %d",
                  printed.right_number, printed.certain);
        CHECK_SAY(!above || printed.worst > 1.9, "%g", printed.worst);
        CHECK_SAY(ours.at_once == 0 && ours.right_exit == ours.certain, "%d and %d of %d",
                  ours.at_once, ours.right_exit, ours.certain);
    }
}

void suite_glass_printed(void) {
    RUN(K12_printed_origins_hit_at_once);
}
