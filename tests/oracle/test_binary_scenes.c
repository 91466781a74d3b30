/* SPDX-License-Identifier: MIT
 *
 * Binary tracing (Q19, P19) of balls, half spaces and boxes whose hits are known: it never crosses
 * a surface, always ends, and ends as close as it says. Left out: its arguments, see
 * test_binary_calls.c. */
#include "binary_scene.h"
#include "moekrs_ask.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { per_scene = 2 };

typedef struct run {
    spt_binary binary;
    spt_settings settings;
    binary_scene scene;
    spt_ray rays[per_scene];
    spt_hit hits[per_scene];
    double scale, size; /* size: largest coordinate of the bound, if there is one */
} run;

typedef struct tally {
    int rays, hits, misses, limits, head_on, closest, inside;
    double probes, worst;
} tally;

/* ---- What holds of every result ------------------------------------------------------------ */

static double tolerance_at(const run *r, const spt_ray *ray, double t) {
    const double travelled = t * binary_length(ray);
    double reach = 0;
    for (int axis = 0; axis < 3; ++axis) reach = fmax(reach, fabs((double)ray->origin[axis]));
    return fmax(fmax((double)r->settings.epsilon, (double)r->settings.pixel_radius * travelled),
                0x1p-22 * (reach + travelled + r->size));
}

/* How far a float position and the ends of probes are off, world length: each coordinate of o + t d
 * is rounded twice, 2^-24 (|o| + 2 t |d|) and sqrt(3) times that in space; t itself at the middle
 * and at the end of a probe, and its radius, 2^-24 t |d| each: below 2^-21 in all. */
static double rounding_at(const spt_ray *ray, double t) {
    double reach = 0;
    for (int axis = 0; axis < 3; ++axis) reach = fmax(reach, fabs((double)ray->origin[axis]));
    return 0x1p-21 * (reach + t * binary_length(ray));
}

/* No body, made smaller by what rounding hides, is met before t. */
static void check_free(const run *r, const spt_ray *ray, double t) {
    const double first = binary_first(&r->scene, ray, rounding_at(ray, t), NULL);
    CHECK_SAY(first >= t, "free up to %.9g, but a surface at %.9g", t, first);
}

/* With s the last probe that was not free: it touches the ray's end and meets a body, so the body
 * is within 2 s of that; and s penalty < probe_ratio tolerance, or so little that t + 2 s penalty
 * rounds to t, which takes 2 s penalty <= 2^-24 t. Where it can only be the body that
 * is hit at the cosine c, the ray is short of it by s (1 + c) / c at most: of a plane just that, of
 * whatever lies behind its tangent plane less. */
static void check_hit(const run *r, const spt_ray *ray, const spt_hit *hit, tally *all) {
    const double t = (double)hit->t, length = binary_length(ray);
    const double slack = rounding_at(ray, t);
    const double least = (double)r->binary.probe_ratio * tolerance_at(r, ray, t);
    const double most =
        fmax(least, 0x1p-25 * t * length) / (double)r->binary.penalty * (1 + 0x1p-20);
    double p[3], others = HUGE_VAL, short_of, cosine;
    int which = -1;
    const double first = binary_first(&r->scene, ray, 0, &which);
    CHECK_SAY(hit->t >= ray->t_min && hit->t <= ray->t_max, "t %.9g", t);
    CHECK_SAY((double)hit->residual > 0 && (double)hit->residual <= most, "residual %g, at most %g",
              (double)hit->residual, most);
    binary_at(ray, t, p);
    CHECK_SAY(binary_distance(&r->scene, p, NULL) <= 2 * most + slack, "ends %g from it",
              binary_distance(&r->scene, p, NULL));
    if (!(first < HUGE_VAL) || first <= (double)ray->t_min) return;
    for (int i = 0; i < r->scene.count; ++i) {
        if (i != which) others = fmin(others, binary_body_distance(&r->scene.body[i], p));
    }
    cosine = binary_cosine(&r->scene.body[which], ray, first);
    if (others <= 4 * most + slack || cosine < 0.01) return;
    ++all->closest;
    all->head_on += cosine > 0.999;
    short_of = (first - t) * length;
    all->worst = fmax(all->worst, short_of / (most * (1 + cosine) / cosine + slack / cosine));
    CHECK_SAY(short_of <= most * (1 + cosine) / cosine * 1.001 + slack / cosine,
              "short by %g at cosine %g, tolerance %g", short_of, cosine, tolerance_at(r, ray, t));
}

/* A ray that begins inside ends where it begins, and only that one is said to. */
static int begins_inside(const run *r, const spt_ray *ray, const spt_hit *hit) {
    const double slack = rounding_at(ray, (double)ray->t_min);
    const int says = (hit->flags & SPT_FLAG_INSIDE) != 0;
    double p[3], distance;
    binary_at(ray, (double)ray->t_min, p);
    distance = binary_distance(&r->scene, p, NULL);
    CHECK_SAY(hit->flags == (says ? SPT_FLAG_INSIDE : 0u), "flags %u", hit->flags);
    if (r->settings.budget == 0) return 0;
    if (fabs(distance) > slack) CHECK_SAY(says == (distance < 0), "says %d at %g", says, distance);
    CHECK_SAY(!says || (hit->outcome == SPT_HIT && check_same_bits(hit->t, ray->t_min) &&
                        hit->evaluations == 1),
              "outcome %d at %.9g of one inside at %.9g, %u probes", hit->outcome, (double)hit->t,
              (double)ray->t_min, hit->evaluations);
    return says;
}

static void check_result(const run *r, const spt_ray *ray, const spt_hit *hit, tally *all) {
    const int certain = hit->outcome == SPT_MISS;
    ++all->rays;
    all->probes += hit->evaluations;
    CHECK_SAY(hit->evaluations <= r->settings.budget, "%u probes of %u", hit->evaluations,
              r->settings.budget);
    CHECK(hit->fallbacks <= hit->evaluations);
    CHECK(check_same_bits(hit->candidate_t, INFINITY) &&
          check_same_bits(hit->candidate_ratio, INFINITY));
    CHECK_SAY(hit->component == (hit->outcome == SPT_HIT ? 0 : -1), "outcome %d, component %d",
              hit->outcome, hit->component);
    CHECK_SAY(hit->outcome == SPT_HIT || hit->outcome == SPT_MISS || hit->outcome == SPT_LIMIT,
              "outcome %d", hit->outcome);
    if (begins_inside(r, ray, hit)) {
        ++all->inside;
        return;
    }
    check_free(r, ray, certain ? fmin((double)ray->t_max, 1e9) : (double)hit->t);
    if (hit->outcome == SPT_HIT) {
        ++all->hits;
        CHECK(hit->evaluations > 0 && hit->fallbacks > 0);
        check_hit(r, ray, hit, all);
    } else if (certain) {
        ++all->misses;
        CHECK(check_same_bits(hit->t, INFINITY) && check_same_bits(hit->residual, INFINITY));
    } else {
        ++all->limits;
        CHECK_SAY(hit->evaluations == r->settings.budget, "%u of %u probes, t %.9g of %.9g",
                  hit->evaluations, r->settings.budget, (double)hit->t, (double)ray->t_max);
        CHECK(hit->t >= ray->t_min && hit->t <= ray->t_max);
    }
}

/* ---- Random scenes ------------------------------------------------------------------------- */

static spt_hit trace_one(run *r, const spt_bound *bound, const spt_ray *ray, int point) {
    const spt_rays rays = spt_rays_of(ray);
    spt_hit hit = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    const spt_hits hits = spt_hits_of(&hit);
    spt_probe probe = binary_probe(&r->scene, point);
    probe.bound = bound;
    r->scene.asked = r->scene.refused = 0;
    CHECK(spt_binary_trace(&probe, &r->binary, &r->settings, 1, &rays, &hits, NULL) == SPT_OK);
    CHECK_SAY(point || r->scene.asked == hit.evaluations, "%u probes counted, %u asked",
              hit.evaluations, (unsigned)r->scene.asked);
    CHECK_SAY(point || r->scene.refused == hit.fallbacks, "%u fallbacks counted, %u refused",
              hit.fallbacks, (unsigned)r->scene.refused);
    return hit;
}

static int has_end(const binary_scene *scene) {
    int end = 1;
    for (int i = 0; i < scene->count; ++i) {
        if (scene->body[i].kind == BINARY_HALF_SPACE) end = 0;
    }
    return end;
}

/* Every other scene with the defaults; else numbers anywhere they may be. */
static void draw_run(run *r, int draw) {
    const double scale = pow(10, check_uniform(-2, 3));
    memset(r, 0, sizeof *r);
    r->scale = scale;
    binary_draw(&r->scene, scale);
    r->binary = spt_binary_default();
    r->settings = spt_settings_default();
    r->settings.epsilon = (float)(scale * pow(10, check_uniform(-6, -2)));
    r->settings.pixel_radius = draw % 3 == 0 ? 1e-3f : 0.0f;
    r->settings.max_lanes = widths[check_random() % width_count];
    for (int i = 0; i < per_scene; ++i) {
        const int exponent = draw % 4 == 0 ? (int)(check_random() % 40) - 20 : 0;
        r->rays[i] = binary_ray(&r->scene, scale, ldexp(1, exponent));
    }
    if (draw % 2 == 0) return;
    r->settings.budget = check_random() % 4 == 0 ? check_random() % 64 : 2000;
    r->binary.bonus = (float)check_uniform(1.0625, 8);
    r->binary.penalty = (float)check_uniform(0.05, 0.9);
    r->binary.probe_ratio = (float)check_uniform(0.01, 1);
    if (draw % 4 == 1) r->binary.first = (float)(scale * pow(10, check_uniform(-7, 4)));
}

static void Q19_binary_scenes(void) {
    static run r;
    tally all;
    memset(&all, 0, sizeof all);
    for (int draw = 0; draw < 10000; ++draw) {
        spt_bound bound;
        spt_hit hit;
        int bounded;
        draw_run(&r, draw);
        check_context("draw %d, %u lanes", draw, r.settings.max_lanes);
        bounded = has_end(&r.scene) && draw % 5 == 0;
        bound = spt_bound_sphere(0, 0, 0, (float)(20 * r.scale));
        r.size = bounded ? 20 * r.scale : 0;
        if (draw % 5 == 0) r.rays[0].t_max = INFINITY;
        hit = trace_one(&r, bounded ? &bound : NULL, &r.rays[0], draw % 7 == 0);
        check_result(&r, &r.rays[0], &hit, &all);
    }
    check_context("all draws");
    if (moekrs_full()) {
        printf(
            "binary: rays %d, hits %d (head-on %d, the nearest body's own %d), misses %d, limits "
            "%d, begun inside %d; probes a ray %g; closest to what is allowed: %g\n",
            all.rays, all.hits, all.head_on, all.closest, all.misses, all.limits, all.inside,
            all.probes / all.rays, all.worst);
    }
    CHECK(all.hits > all.rays / 4 && all.misses > all.rays / 8);
    CHECK(all.closest > all.hits / 2 && all.head_on > 20 && all.inside > 20);
    CHECK_SAY(all.limits <= all.rays / 8, "%d limits", all.limits);
}

/* The same bits at every width, in any company and by either callback, and for rays of any length:
 * t scales. */
static void binary_bits(void) {
    static run r;
    for (int draw = 0; draw < 300; ++draw) {
        spt_hit first[per_scene];
        draw_run(&r, draw);
        for (int width = 0; width < width_count; ++width) {
            for (int point = 0; point < 2; ++point) {
                const spt_rays rays = spt_rays_of(r.rays);
                const spt_hits hits = spt_hits_of(r.hits);
                const spt_probe probe = binary_probe(&r.scene, point);
                check_context("draw %d, %u lanes, point %d", draw, widths[width], point);
                r.settings.max_lanes = widths[width];
                if (width == 0 && point == 0) {
                    for (int i = 0; i < per_scene; ++i) {
                        first[i] = trace_one(&r, NULL, &r.rays[i], 0);
                    }
                }
                CHECK(spt_binary_trace(&probe, &r.binary, &r.settings, per_scene, &rays, &hits,
                                       NULL) == SPT_OK);
                CHECK(memcmp(first, r.hits, sizeof first) == 0);
            }
        }
        for (int i = 0; i < per_scene; ++i) {
            spt_ray longer = r.rays[i];
            spt_hit hit;
            const int exponent = draw % 21 - 10;
            for (int axis = 0; axis < 3; ++axis) {
                longer.direction[axis] = ldexpf(longer.direction[axis], exponent);
            }
            longer.t_min = ldexpf(longer.t_min, -exponent);
            longer.t_max = ldexpf(longer.t_max, -exponent);
            hit = trace_one(&r, NULL, &longer, 0);
            hit.t = ldexpf(hit.t, exponent);
            CHECK_SAY(memcmp(&hit, &first[i], sizeof hit) == 0, "2^%d: t %.9g for %.9g", exponent,
                      (double)hit.t, (double)first[i].t);
        }
    }
}

/* ---- Algorithm 2 as printed ---------------------------------------------------------------- */

static double shell(double t) {
    return fabs(t - 4.95);
}
static double plate(double t) {
    return fabs(t - 3);
}

static float shell_batch_one(void *user, float x, float y, float z, float radius) {
    (void)user, (void)y, (void)z;
    return (float)(shell((double)x) - (double)radius);
}

/* P19: growing before it advances, the ray passes a shell at 4.95 and ends at 114.88; S5: a plate
 * at 3. Advancing first it ends at 4.9496 after 22 probes; and ours asks first whether it begins
 * inside. */
static void P19_printed_advance(void) {
    const spt_ray ray = {{0, 0, 0}, 0, {1, 0, 0}, 100};
    const spt_rays rays = spt_rays_of(&ray);
    const spt_probe point = {sizeof point, NULL, shell_batch_one, NULL, NULL};
    spt_binary binary = spt_binary_default();
    spt_settings settings = spt_settings_default();
    spt_hit hit = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    const spt_hits hits = spt_hits_of(&hit);
    binary_end end = binary_printed(shell, 0, 1, 1e-4, 100, 1000);
    CHECK_SAY(fabs(end.t - 114.88) < 1e-9, "%.9g", end.t);
    end = binary_printed(plate, 0, 1, 1e-4, 1000, 1000);
    CHECK_SAY(end.t > 1000, "%.9g", end.t);
    end = binary_printed(shell, 1, 1, 1e-4, 100, 1000);
    CHECK_SAY(end.probes == 22 && fabs(end.t - 4.9496) < 5e-5, "%.9g, %d probes", end.t,
              end.probes);
    binary.first = 1;
    binary.probe_ratio = 1; /* s > epsilon, as printed */
    CHECK(spt_binary_trace(&point, &binary, &settings, 1, &rays, &hits, NULL) == SPT_OK);
    CHECK_SAY(hit.outcome == SPT_HIT && hit.evaluations == 23 &&
                  fabs((double)hit.t - end.t) < 22 * 0x1p-22,
              "outcome %d at %.9g after %u", hit.outcome, (double)hit.t, hit.evaluations);
}

static double nothing(double t) {
    (void)t;
    return HUGE_VAL;
}

/* M5: `while s > epsilon` does not end on a miss; ours does, see binary_no_surface() in
 * test_binary_calls.c. */
static void M5_printed_never_ends(void) {
    const binary_end end = binary_printed(nothing, 0, 1, 1e-4, HUGE_VAL, 1000);
    CHECK(end.probes == 1000);
}

void suite_binary_scenes(void) {
    RUN(Q19_binary_scenes);
    RUN(binary_bits);
    RUN(P19_printed_advance);
    RUN(M5_printed_never_ends);
}
