/* SPDX-License-Identifier: MIT
 *
 * Binary tracing: probes that say anything, rays of any kind, numbers at the ends of their ranges
 * (M5 and the header). Beyond them: test_binary_arguments.c; random scenes: test_binary_scenes.c. */
#include "binary_told.h"
#include "../check.h"

#include <math.h>
#include <string.h>

/* ---- What probes say ----------------------------------------------------------------------- */

/* Never free: a hit at once; free only where the ball has no size: a hit at t_min, after as many
 * probes as the penalty needs from the first radius to probe_ratio times the tolerance: from 50 / 8
 * to 1e-5 by 0.3, 12; and one to see that the ray does not begin inside. */
static void binary_no_way(void) {
    binary_call c;
    binary_call_of(&c, BINARY_NEVER);
    c.ray.t_min = 3;
    for (int way = 0; binary_way(&c, &way);) {
        c.as.what = BINARY_NEVER;
        binary_expect(&c, SPT_HIT, 3, 3);
        c.as.what = BINARY_NEARLY;
        binary_expect(&c, SPT_HIT, 3, 3);
        CHECK_SAY(c.hit.evaluations >= 10 && c.hit.evaluations <= 14, "%u probes",
                  c.hit.evaluations);
        CHECK(c.hit.fallbacks + 1 >= c.hit.evaluations);
    }
}

/* M5: a miss ends: at t_max, at the bound's end, and, without either, at the end of numbers. */
static void binary_no_surface(void) {
    binary_call c;
    binary_call_of(&c, BINARY_ALWAYS);
    for (int way = 0; binary_way(&c, &way);) {
        static const float ends[] = {0, 1e-30f, 50, 1e18f, FLT_MAX, INFINITY};
        for (int end = 0; end < 6; ++end) {
            for (int bounded = 0; bounded < 2; ++bounded) {
                c.ray.t_max = ends[end];
                c.probe.bound = bounded ? &c.bound : NULL;
                binary_expect(&c, SPT_MISS, HUGE_VAL, HUGE_VAL);
                CHECK(check_same_bits(c.hit.residual, INFINITY) && c.hit.fallbacks == 0);
                /* From half the bound, or from 1 at least, doubling to 2^127. */
                CHECK_SAY(c.hit.evaluations <= (bounded ? 6u : 130u), "%u probes",
                          c.hit.evaluations);
            }
        }
        c.ray.t_max = INFINITY;
        c.probe.bound = NULL;
        c.binary.first = 1; /* doubling from 1 to 2^127 */
        binary_expect(&c, SPT_MISS, HUGE_VAL, HUGE_VAL);
        CHECK_SAY(c.hit.evaluations <= 130, "%u probes", c.hit.evaluations);
        c.binary.first = 0;
    }
}

/* A ray that passes its bound asks nothing; a surface is found from outside of it. */
static void binary_bounds(void) {
    binary_call c;
    binary_call_of(&c, BINARY_WALL);
    c.probe.bound = &c.bound;
    for (int way = 0; binary_way(&c, &way);) {
        c.ray.origin[0] = -1000;
        c.ray.t_max = INFINITY;
        binary_expect(&c, SPT_HIT, 1005 - 0.002, 1005);
        c.ray.origin[1] = 21;
        binary_expect(&c, SPT_MISS, HUGE_VAL, HUGE_VAL);
        CHECK(c.hit.evaluations == 0 && c.as.asked == 0);
        c.ray.origin[0] = c.ray.origin[1] = 0;
    }
}

/* A NaN is not free; the ray goes on where a smaller ball has an answer, and is NONFINITE where the
 * last had none. */
static void binary_not_numbers(void) {
    binary_call c;
    binary_call_of(&c, BINARY_NOT_A_NUMBER);
    for (int way = 0; binary_way(&c, &way);) {
        c.as.what = BINARY_NOT_A_NUMBER;
        binary_expect(&c, SPT_NONFINITE, 0, 0);
        c.as.what = BINARY_NAN_BEYOND;
        binary_expect(&c, SPT_NONFINITE, 4.99, 10);
        c.as.what = BINARY_NAN_IF_LARGE;
        binary_expect(&c, SPT_HIT, 5 - 1e-4, 5);
    }
}

/* ---- Rays ---------------------------------------------------------------------------------- */

static void binary_intervals(void) {
    binary_call c;
    binary_call_of(&c, BINARY_WALL);
    for (int way = 0; binary_way(&c, &way);) {
        c.ray.t_min = c.ray.t_max = 2; /* a point, free */
        binary_expect(&c, SPT_MISS, HUGE_VAL, HUGE_VAL);
        c.ray.t_min = c.ray.t_max = 6; /* inside */
        binary_expect(&c, SPT_HIT, 6, 6);
        c.ray.t_min = c.ray.t_max = 5; /* on the surface: not free */
        binary_expect(&c, SPT_HIT, 5, 5);
        c.ray.t_min = 2;
        c.ray.t_max = 1;
        binary_expect(&c, SPT_MISS, HUGE_VAL, HUGE_VAL);
        CHECK(c.hit.evaluations == 0 && c.as.asked == 0);
        c.ray.t_max = 50;
        c.settings.budget = 0;
        binary_expect(&c, SPT_LIMIT, 2, 2);
        CHECK(c.hit.evaluations == 0 && c.as.asked == 0 &&
              check_same_bits(c.hit.residual, INFINITY));
        for (c.settings.budget = 1; c.settings.budget < 8; ++c.settings.budget) {
            binary_expect(&c, SPT_LIMIT, 2, 5);
            CHECK(c.hit.evaluations == c.settings.budget);
        }
        c.settings.budget = 128;
        c.ray.t_max = 4.9375f; /* behind the end: nothing */
        binary_expect(&c, SPT_MISS, HUGE_VAL, HUGE_VAL);
        c.ray.t_min = 0;
        c.ray.t_max = 50;
    }
}

static void binary_bad_rays(void) {
    static const float bad[] = {NAN, INFINITY, -INFINITY};
    binary_call c;
    binary_call_of(&c, BINARY_WALL);
    for (int way = 0; binary_way(&c, &way);) {
        for (int i = 0; i < 12 * 3 + 2; ++i) {
            const spt_ray ray = c.ray;
            const float value = i < 36 ? bad[i % 3] : -1.0f;
            float *const at[] = {&c.ray.origin[0],   &c.ray.origin[1],    &c.ray.origin[2],
                                 &c.ray.t_min,       &c.ray.direction[0], &c.ray.direction[1],
                                 &c.ray.direction[2]};
            if (i == 36) {
                c.ray.t_min = value;
            } else if (i == 37) {
                memset(c.ray.direction, 0, sizeof c.ray.direction);
            } else if (i / 3 < 7) {
                *at[i / 3] = value;
            } else {
                c.ray.t_max = NAN;
            }
            binary_expect(&c, SPT_BAD_RAY, HUGE_VAL, HUGE_VAL);
            CHECK(c.hit.evaluations == 0 && c.as.asked == 0);
            CHECK(check_same_bits(c.hit.residual, INFINITY) && c.hit.component == -1);
            c.ray = ray;
        }
    }
}

/* ---- Numbers ------------------------------------------------------------------------------- */

/* The first probe: none larger than the ray needs or smaller than what ends it goes unasked. M5:
 * epsilon 2 and a first radius of 1 returned 0 without a probe. */
static void binary_first_radius(void) {
    static const float firsts[] = {FLT_MIN, 1e-6f, 1, 3, 1e6f, 1e30f, FLT_MAX};
    binary_call c;
    binary_call_of(&c, BINARY_FAR_WALL);
    c.ray.t_max = 1000;
    for (int way = 0; binary_way(&c, &way);) {
        for (int i = 0; i < 7; ++i) {
            c.binary = spt_binary_default();
            c.binary.first = firsts[i];
            c.settings.budget = 1000;
            c.settings.epsilon = 1e-4f;
            binary_expect(&c, SPT_HIT, 100 - 0.67e-4 - 100 * 0x1p-21, 100);
            c.binary.probe_ratio = 1;
            c.settings.epsilon = 2;
            binary_expect(&c, SPT_HIT, 100 - 2 / 0.3 * 2, 100);
        }
        c.binary = spt_binary_default();
    }
}

/* Each is legal, and the wall is found in as many probes as there are. */
static void binary_extremes(void) {
    static const spt_binary legal[] = {{sizeof(spt_binary), 1.0000002f, 0.3f, 0.1f, 0},
                                       {sizeof(spt_binary), 8, 0.3f, 0.1f, 0},
                                       {sizeof(spt_binary), 2, 0.99f, 0.1f, 0},
                                       {sizeof(spt_binary), 2, 1e-3f, 0.1f, 0},
                                       {sizeof(spt_binary), 2, 0.3f, 1, 0},
                                       {sizeof(spt_binary), 8, 0.99f, 1, 0},
                                       {sizeof(spt_binary), 1.0625f, 0.0625f, 1, FLT_MAX}};
    binary_call c;
    binary_call_of(&c, BINARY_WALL);
    c.settings.budget = 100000;
    for (int way = 0; binary_way(&c, &way);) {
        for (int i = 0; i < 7; ++i) {
            const double most = (double)legal[i].probe_ratio * 1e-4 / (double)legal[i].penalty;
            c.binary = legal[i];
            binary_expect(&c, SPT_HIT, 5 - 2 * most - 5 * 0x1p-21, 5);
        }
    }
}

/* ---- Views and counts ---------------------------------------------------------------------- */

static void binary_counts_and_views(void) {
    enum { count = 1000 };
    static spt_ray rays[count];
    static float t[2 * count];
    static int32_t active[count];
    static spt_hit all[count];
    const spt_hits hits = spt_hits_of(all);
    spt_statistics statistics = spt_statistics_default();
    spt_rays from = spt_rays_of(rays);
    spt_hits only;
    uint64_t outcomes[SPT_OUTCOMES] = {0, 0, 0, 0, 0}, probes = 0, fallbacks = 0;
    binary_call c;
    binary_call_of(&c, BINARY_WALL);
    for (int i = 0; i < count; ++i) {
        rays[i] = c.ray;
        rays[i].origin[0] = (float)check_uniform(-4, 6);
        rays[i].direction[1] = (float)check_uniform(-2, 2);
        rays[i].t_max = (float)check_uniform(-1, 20);
        active[i] = i % 3 != 0;
    }
    CHECK(spt_binary_trace(&c.probe, NULL, &c.settings, count, &from, &hits, &statistics) ==
          SPT_OK);
    for (int i = 0; i < count; ++i) {
        ++outcomes[all[i].outcome];
        probes += all[i].evaluations;
        fallbacks += all[i].fallbacks;
        t[2 * i] = t[2 * i + 1] = -7;
    }
    CHECK(statistics.rays == count && statistics.evaluations == probes);
    CHECK(memcmp(outcomes, statistics.outcomes, sizeof outcomes) == 0);
    CHECK(statistics.fallbacks == fallbacks && statistics.slots >= probes);
    CHECK(statistics.slots == c.as.asked && statistics.passes > 0);
    CHECK(statistics.lanes == (uint32_t)spt_lanes());
    CHECK(outcomes[SPT_HIT] > 100 && outcomes[SPT_MISS] > 100);
    memset(&only, 0, sizeof only);
    only.t.first = &t[1];
    only.t.stride = 2 * sizeof *t;
    from.active.first = active;
    from.active.stride = sizeof *active;
    CHECK(spt_binary_trace(&c.probe, NULL, &c.settings, count, &from, &only, NULL) == SPT_OK);
    for (int i = 0; i < count; ++i) {
        CHECK(check_same_bits(t[2 * i], -7));
        CHECK(check_same_bits(t[2 * i + 1], active[i] ? all[i].t : -7));
    }
}

void suite_binary_calls(void) {
    RUN(binary_no_way);
    RUN(binary_no_surface);
    RUN(binary_bounds);
    RUN(binary_not_numbers);
    RUN(binary_intervals);
    RUN(binary_bad_rays);
    RUN(binary_first_radius);
    RUN(binary_extremes);
    RUN(binary_counts_and_views);
}
