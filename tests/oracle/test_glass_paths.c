/* SPDX-License-Identifier: MIT
 *
 * Light through glass (row K12 of the errata, property Q17 for bodies that refract): the library's
 * paths against exact ones, event by event, within the bound of glass_path.c. SPT_GLASS_RAYS=N
 * follows N rays in each combination, 32 by default. */
#include "glass_run.h"
#include "check.h"
#include "rules.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Combinations --------------------------------------------------------------------------- */

static const double indices[] = {1.1, 1.33, 1.5, 2.4, 1 / 1.5, 1 / 2.4};
enum { index_count = sizeof indices / sizeof indices[0] };

/* Those of the errata, and two pixel cones, of pictures about 1000 and 400 pixels wide. */
static const struct {
    float epsilon, pixel_radius;
} tolerances[] = {{2e-6f, 0}, {1e-5f, 0}, {1e-4f, 0}, {1e-3f, 0}, {2e-6f, 2e-4f}, {2e-6f, 5e-4f}};
enum { tolerance_count = sizeof tolerances / sizeof tolerances[0] };

enum { body_count = 9 };

/* One of the library's ways to do it: every rule, declared convex or not, marched through or
 * traced backwards, with and without SPT_SKIP_START, checks, gradients, float callbacks. */
static glass_run way_number(uint32_t number, glass_body *body) {
    glass_run run;
    memset(&run, 0, sizeof run);
    run.body = body;
    run.settings = spt_settings_default();
    run.settings.budget = 100000; /* basic steps along a face take many */
    run.declared = number % 2 == 0;
    run.march = number % 3 == 0;
    run.checks = number % 4;
    run.gradient = body->exponent != 0 || number % 5 < 2;
    run.settings.method = rules[number % (uint32_t)rule_count].method();
    if (!run.declared && run.settings.method == spt_convex()) run.settings.method = spt_basic();
    if (number % 7 < 4) run.settings.flags |= SPT_SKIP_START;
    run.settings.max_lanes = widths[number % width_count];
    body->single = (int)(number / 2 % 2);
    return run;
}

/* ---- Comparison ----------------------------------------------------------------------------- */

enum { most_errors = 1 << 16 };
typedef struct tally {
    long paths, certain, events, secondary, returned, early;
    long kinds[4]; /* certain events: entries, total reflections, exits, mirrors */
    size_t error_count;
    float errors[most_errors]; /* of last points, of certain paths */
} tally;

/* Compares a path as far as it is certain. */
static void compare(const glass_path *truth, const glass_record *seen, tally *sum) {
    int place = 0;
    for (; place < truth->count && truth->event[place].certain; ++place) {
        const glass_event *event = &truth->event[place];
        double off, turned, before;
        CHECK_SAY(place < seen->count, "event %d of %d is missing", place, truth->count);
        if (place >= seen->count) return;
        CHECK_SAY(seen->kind[place] == event->kind && seen->face[place] == event->face,
                  "event %d is %c at face %d, not %c at %d", place, (int)seen->kind[place],
                  seen->face[place], (int)event->kind, event->face);
        off = glass_apart(event->point, seen->point[place]);
        turned = glass_apart(event->direction, seen->direction[place]);
        CHECK_SAY(off <= event->off, "event %d is off by %g, not %g", place, off, event->off);
        CHECK_SAY(turned <= event->turned, "event %d is turned by %g, not %g", place, turned,
                  event->turned);
        CHECK_SAY(seen->start[place] == SPT_START_CLEAR, "event %d: start %d", place,
                  (int)seen->start[place]);
        before = place > 0 ? truth->event[place - 1].off : 0;
        sum->early += seen->length[place] < event->length - 4 * (event->off + before);
        ++sum->events;
        ++sum->kinds[event->kind == GLASS_ENTRY   ? 0
                     : event->kind == GLASS_TOTAL ? 1
                     : event->kind == GLASS_EXIT  ? 2
                                                  : 3];
    }
    if (place < truth->count) return;
    CHECK(seen->count == truth->count && !seen->lost && !seen->returned);
    sum->returned += seen->returned;
    sum->secondary += seen->secondary;
    ++sum->certain;
    if (sum->error_count < most_errors) {
        sum->errors[sum->error_count++] =
            (float)glass_apart(truth->event[place - 1].point, seen->point[place - 1]);
    }
}

static int ascending(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static double quantile(tally *sum, double share) {
    qsort(sum->errors, sum->error_count, sizeof *sum->errors, ascending);
    return sum->error_count == 0
               ? HUGE_VAL
               : (double)sum->errors[(size_t)(share * (double)(sum->error_count - 1))];
}

static void follow(const glass_run *run, int count, tally *sum) {
    static spt_ray rays[glass_rays];
    static glass_record records[glass_rays];
    for (int i = 0; i < count; ++i) rays[i] = glass_ray_towards(run->body);
    glass_trace(run, count, rays, records);
    for (int i = 0; i < count; ++i) {
        glass_path truth;
        /* What has left by the face it was at never comes back, near an edge or not. */
        CHECK(!records[i].returned || records[i].doubtful || !run->gradient ||
              run->body->exponent != 0);
        if (!glass_follow_ray(run, &rays[i], &truth)) continue;
        ++sum->paths;
        compare(&truth, &records[i], sum);
    }
}

static long rays_wanted(void) {
    const char *wanted = getenv("SPT_GLASS_RAYS");
    const long count = wanted != NULL ? strtol(wanted, NULL, 10) : 0;
    return count > 0 ? count : 48;
}

/* What algorithms say of the errors' distribution: at a tolerance of 2e-6 a median of 4e-6 and
 * 1.5e-5 for 95 of 100, and that they follow the tolerance. That of a pixel cone is what it is at
 * the usual length of a path, four: three to the body, one through it. */
static void expect_errors(tally *sum, double tolerance, const char *label) {
    const double median = quantile(sum, 0.5), most = quantile(sum, 0.95);
    check_context("%s", label);
    CHECK_SAY(median <= 2 * tolerance, "median %g", median);
    CHECK_SAY(most <= 7.5 * tolerance, "95 of 100 within %g", most);
    CHECK(sum->returned == 0 && sum->early == 0);
    CHECK_SAY(2 * sum->certain > sum->paths, "%ld of %ld paths", sum->certain, sum->paths);
    if (getenv("SPT_GLASS_RAYS") != NULL) {
        printf("%s: %ld paths, %ld certain with %ld events and %ld secondary rays; %ld returned, "
               "%ld stopped early; median error %.2g, 95 of 100 within %.2g\n",
               label, sum->paths, sum->certain, sum->events, sum->secondary, sum->returned,
               sum->early, median, most);
    }
}

static void K12_glass_paths(void) {
    static tally sums[tolerance_count];
    const long wanted = rays_wanted();
    long kinds[4] = {0, 0, 0, 0};
    uint32_t number = 0;
    memset(sums, 0, sizeof sums);
    for (int which = 0; which < body_count; ++which) {
        glass_body body = glass_body_number(which);
        for (int index = 0; index < index_count; ++index) {
            for (int tolerance = 0; tolerance < tolerance_count; ++tolerance, ++number) {
                glass_run run = way_number(number, &body);
                run.index = indices[index];
                run.settings.epsilon = tolerances[tolerance].epsilon;
                run.settings.pixel_radius = tolerances[tolerance].pixel_radius;
                check_context("%s, index %.2f, epsilon %g, pixel %g, way %u", body.name, run.index,
                              (double)run.settings.epsilon, (double)run.settings.pixel_radius,
                              number);
                for (long left = wanted; left > 0; left -= glass_rays) {
                    follow(&run, left < glass_rays ? (int)left : glass_rays, &sums[tolerance]);
                }
            }
        }
    }
    for (int tolerance = 0; tolerance < tolerance_count; ++tolerance) {
        const double epsilon = (double)tolerances[tolerance].epsilon;
        const double pixel = (double)tolerances[tolerance].pixel_radius;
        char label[64];
        snprintf(label, sizeof label, "epsilon %g, pixel radius %g", epsilon, pixel);
        expect_errors(&sums[tolerance], fmax(epsilon, 4 * pixel), label);
        for (int kind = 0; kind < 4; ++kind) kinds[kind] += sums[tolerance].kinds[kind];
    }
    for (int kind = 0; kind < 4; ++kind) CHECK_SAY(kinds[kind] > 500, "kind %d", kind);
}

void suite_glass_paths(void) {
    RUN(K12_glass_paths);
}
