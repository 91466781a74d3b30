/* SPDX-License-Identifier: MIT
 *
 * Guarded calls of spt_scene_trace() and its expectation, component by component. */
#include "scene_run.h"
#include "harness.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

spt_rays scene_rays_of(const scene_ray *array) {
    spt_rays rays = spt_rays_of(&array->ray);
    spt_column *columns[8] = {&rays.origin[0],    &rays.origin[1],    &rays.origin[2],
                              &rays.t_min,        &rays.direction[0], &rays.direction[1],
                              &rays.direction[2], &rays.t_max};
    for (int i = 0; i < 8; ++i) columns[i]->stride = (ptrdiff_t)sizeof *array;
    rays.path.first = &array->path;
    rays.active.first = &array->active;
    rays.path.stride = rays.active.stride = (ptrdiff_t)sizeof *array;
    return rays;
}

/* ---- Runs ---------------------------------------------------------------------------------- */

scene_rules scene_first_rule(const spt_scene *united, const char *title) {
    scene_rules walk = {NULL, NULL, 0, 1};
    walk.title = title;
    for (size_t i = 0; i < united->count; ++i) {
        walk.all_convex &= (united->fields[i].flags & SPT_FIELD_CONVEX) != 0;
    }
    return walk;
}

int scene_next_rule(scene_rules *walk) {
    while (walk->place < rule_count) {
        const rule *one = &rules[walk->place++];
        if (!rule_allowed(one, walk->all_convex ? SPT_FIELD_CONVEX : 0)) continue;
        walk->method = one->method();
        check_context("%s, method %s", walk->title, one->name);
        return 1;
    }
    return 0;
}

enum { guard = 61 }; /* odd, so that the workspace has no alignment */

static unsigned char *guarded; /* kept between calls: what a workspace holds must not matter */
static size_t guarded_size;

static void keep_room(size_t size) {
    if (size <= guarded_size) return;
    free(guarded);
    guarded = malloc(size);
    guarded_size = guarded != NULL ? size : 0;
    CHECK(guarded != NULL);
    if (guarded != NULL) memset(guarded, 0xff, size);
}

void scene_call(const spt_scene *united, const spt_settings *settings, size_t count,
                const spt_rays *rays, const spt_hits *hits, spt_statistics *statistics) {
    const size_t size = spt_scene_workspace(united, settings);
    int kept = 1;
    CHECK(size > 0);
    keep_room(size + 2 * guard);
    if (guarded == NULL) return;
    memset(guarded, 0x5a, guard);
    memset(guarded + guard + size, 0x5a, guard);
    CHECK(spt_scene_trace(united, settings, count, rays, hits, guarded + guard, size, statistics) ==
          SPT_OK);
    for (size_t i = 0; i < guard; ++i) {
        kept &= guarded[i] == 0x5a && guarded[guard + size + i] == 0x5a;
    }
    CHECK(kept);
}

void scene_run(const spt_scene *united, const spt_settings *settings, size_t count,
               const scene_ray *rays, spt_hit *hits) {
    spt_statistics counted = spt_statistics_default();
    uint64_t active = 0, evaluations = 0, fallbacks = 0, outcomes[SPT_OUTCOMES] = {0};
    const spt_rays from = scene_rays_of(rays);
    const spt_hits to = spt_hits_of(hits);
    scene_call(united, settings, count, &from, &to, &counted);
    for (size_t i = 0; i < count; ++i) {
        if (rays[i].active == 0) continue;
        ++active;
        evaluations += hits[i].evaluations;
        fallbacks += hits[i].fallbacks;
        CHECK(hits[i].outcome >= 0 && hits[i].outcome < SPT_OUTCOMES);
        CHECK(hits[i].evaluations <= settings->budget);
        if (hits[i].outcome >= 0 && hits[i].outcome < SPT_OUTCOMES) ++outcomes[hits[i].outcome];
    }
    CHECK_SAY(counted.rays == active, "%lu rays counted, %lu active", (unsigned long)counted.rays,
              (unsigned long)active);
    CHECK_SAY(counted.evaluations == evaluations, "%lu evaluations counted, %lu told",
              (unsigned long)counted.evaluations, (unsigned long)evaluations);
    CHECK(counted.fallbacks == fallbacks);
    CHECK(memcmp(counted.outcomes, outcomes, sizeof outcomes) == 0);
    CHECK(counted.slots >= counted.evaluations);
    CHECK(active == 0 ||
          counted.lanes == (uint32_t)width_run(settings->max_lanes == 0 ? (uint32_t)spt_lanes()
                                                                        : settings->max_lanes));
}

/* ---- The components one by one ------------------------------------------------------------- */

void scene_trace_alone(const spt_scene *united, size_t index, const spt_settings *settings,
                       size_t count, const spt_rays *rays, spt_hit *hits) {
    const spt_field *field = &united->fields[index];
    const spt_hits to = spt_hits_of(hits);
    spt_settings own = *settings;
    if ((field->flags & SPT_FIELD_CONVEX) != 0) own.method = spt_convex();
    CHECK(spt_trace(field, &own, count, rays, &to, NULL) == SPT_OK);
}

void scene_expect_nothing(scene_expected *expected) {
    const scene_expected nothing = {
        {INFINITY, INFINITY, SPT_MISS, 0, 0, -1, INFINITY, INFINITY, 0}, INFINITY, 0, 0, 0};
    *expected = nothing;
}

/* Of equally small ratios the earlier sample. */
static void keep_candidate(spt_hit *kept, const spt_hit *other) {
    if (other->candidate_ratio < kept->candidate_ratio ||
        (check_same_bits(other->candidate_ratio, kept->candidate_ratio) &&
         other->candidate_t < kept->candidate_t)) {
        kept->candidate_ratio = other->candidate_ratio;
        kept->candidate_t = other->candidate_t;
    }
}

static int is_event(const spt_hit *hit) {
    return hit->outcome == SPT_HIT || hit->outcome == SPT_NONFINITE;
}

void scene_expect_also(scene_expected *expected, const spt_hit *alone, int32_t component) {
    spt_hit *first = &expected->first;
    keep_candidate(first, alone);
    expected->sum += alone->evaluations;
    expected->any |= alone->flags;
    first->fallbacks += alone->fallbacks;
    if (alone->outcome == SPT_LIMIT) expected->undecided = 1;
    if (alone->outcome == SPT_BAD_RAY) first->outcome = SPT_BAD_RAY;
    if (!is_event(alone)) return;
    if ((alone->flags & SPT_FLAG_STEEP) == 0 && alone->t < expected->promised) {
        expected->promised = alone->t;
    }
    if (alone->t < first->t) {
        first->t = alone->t;
        first->residual = alone->residual;
        first->outcome = alone->outcome;
        first->component = alone->outcome == SPT_HIT ? component : -1;
        first->flags = alone->flags;
        first->evaluations = alone->evaluations;
    }
}

void scene_expect(const spt_scene *united, const spt_settings *settings, size_t count,
                  const scene_ray *rays, scene_expected *expected) {
    const spt_rays from = scene_rays_of(rays);
    spt_hit *alone = calloc(count, sizeof *alone);
    CHECK(alone != NULL);
    if (alone == NULL) return;
    for (size_t i = 0; i < count; ++i) {
        scene_expect_nothing(&expected[i]);
        expected[i].undecided = rays[i].active == 0;
    }
    for (size_t component = 0; component < united->count; ++component) {
        scene_trace_alone(united, component, settings, count, &from, alone);
        for (size_t i = 0; i < count; ++i) {
            if (rays[i].active == 0) continue;
            scene_expect_also(&expected[i], &alone[i], (int32_t)component);
        }
    }
    for (size_t i = 0; i < count; ++i) {
        if (expected[i].sum > settings->budget) expected[i].undecided = 1;
    }
    free(alone);
}

static int same_event(const spt_hit *hit, const spt_hit *event, int32_t component) {
    return check_same_bits(hit->t, event->t) && check_same_bits(hit->residual, event->residual) &&
           hit->outcome == event->outcome && hit->component == component;
}

/* Whether it is the event of some component, not behind what was promised. */
static int is_any_event(const spt_scene *united, const spt_settings *settings, const scene_ray *ray,
                        const scene_expected *expected, const spt_hit *hit) {
    const spt_rays from = scene_rays_of(ray);
    for (size_t component = 0; component < united->count; ++component) {
        spt_hit alone;
        scene_trace_alone(united, component, settings, 1, &from, &alone);
        if (is_event(&alone) && hit->t <= expected->promised &&
            same_event(hit, &alone, alone.outcome == SPT_HIT ? (int32_t)component : -1)) {
            return 1;
        }
    }
    return 0;
}

/* A ray that met nothing asked every component to its end. */
static void check_miss(const scene_expected *expected, const spt_hit *hit, size_t place) {
    const spt_hit *first = &expected->first;
    CHECK_SAY(hit->evaluations == expected->sum, "ray %lu: %u evaluations, alone %lu",
              (unsigned long)place, hit->evaluations, (unsigned long)expected->sum);
    CHECK_SAY(hit->flags == expected->any && hit->fallbacks == first->fallbacks,
              "ray %lu: flags %u and %u, fallbacks %u and %u", (unsigned long)place, hit->flags,
              expected->any, hit->fallbacks, first->fallbacks);
    CHECK_SAY(check_same_bits(hit->candidate_t, first->candidate_t) &&
                  check_same_bits(hit->candidate_ratio, first->candidate_ratio),
              "ray %lu: candidate %.9g at %.9g, alone %.9g at %.9g", (unsigned long)place,
              (double)hit->candidate_ratio, (double)hit->candidate_t,
              (double)first->candidate_ratio, (double)first->candidate_t);
}

void scene_check(const spt_scene *united, const spt_settings *settings, size_t count,
                 const scene_ray *rays, const scene_expected *expected, const spt_hit *hits) {
    for (size_t i = 0; i < count; ++i) {
        const spt_hit *first = &expected[i].first;
        const int same = same_event(&hits[i], first, first->component);
        if (expected[i].undecided) continue;
        CHECK_SAY(same || ((expected[i].any & SPT_FLAG_STEEP) != 0 &&
                           is_any_event(united, settings, &rays[i], &expected[i], &hits[i])),
                  "ray %lu: outcome %d at %.9g, f %.9g of %d; alone %d at %.9g, %.9g of %d",
                  (unsigned long)i, hits[i].outcome, (double)hits[i].t, (double)hits[i].residual,
                  hits[i].component, first->outcome, (double)first->t, (double)first->residual,
                  first->component);
        if (!same) continue;
        if (first->outcome == SPT_MISS) {
            check_miss(&expected[i], &hits[i], i);
        } else {
            CHECK_SAY(hits[i].evaluations >= first->evaluations &&
                          hits[i].evaluations <= expected[i].sum,
                      "ray %lu: %u evaluations, alone %u of %lu", (unsigned long)i,
                      hits[i].evaluations, first->evaluations, (unsigned long)expected[i].sum);
            CHECK_SAY((hits[i].flags & first->flags) == first->flags &&
                          (hits[i].flags & ~expected[i].any) == 0,
                      "ray %lu: flags %u, of those hit %u, of all %u", (unsigned long)i,
                      hits[i].flags, first->flags, expected[i].any);
        }
    }
}
