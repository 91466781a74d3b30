/* SPDX-License-Identifier: MIT
 *
 * Runs the cases of the stress tests and checks what must hold for every result whatever the case:
 * the table of outcomes in trace.h, the counts, the candidate. Tolerances are worked out in double
 * from the formulas of trace.h, not taken from the library. */
#include "stress.h"

#include <float.h>
#include <math.h>
#include <string.h>

float stress_slope;

/* ---- Numbers ------------------------------------------------------------------------------- */

float stress_from_bits(uint32_t bits) {
    float a;
    memcpy(&a, &bits, sizeof a);
    return a;
}

float stress_nan(void) {
    return stress_from_bits(0x7fc00000u);
}

float stress_infinity(void) {
    return stress_from_bits(0x7f800000u);
}

int stress_is_nan(float a) {
    return (check_bits(a) & 0x7fffffffu) > 0x7f800000u;
}

float stress_scaled(float a, int exponent) {
    return (float)ldexp((double)a, exponent);
}

double stress_ulp(double a) {
    int exponent;
    frexp(fabs(a), &exponent); /* 2^(exponent - 1) <= |a| */
    return ldexp(1.0, exponent - 24);
}

int stress_within(double a, double b, double tolerance) {
    return fabs(a - b) <= tolerance;
}

double stress_length(const float vector[3]) {
    const double x = (double)vector[0], y = (double)vector[1], z = (double)vector[2];
    return sqrt(x * x + y * y + z * z);
}

/* The largest coordinate of a bound, which counts as size. */
static double bound_size(const spt_bound *bound) {
    double size = 0.0;
    for (int axis = 0; bound != NULL && axis < 3; ++axis) {
        if (bound->kind == SPT_BOUND_BOX) {
            size =
                fmax(size, fmax(fabs((double)bound->low[axis]), fabs((double)bound->high[axis])));
        } else {
            size = fmax(size, fabs((double)bound->center[axis]) + (double)bound->radius);
        }
    }
    return size;
}

double stress_tolerance(const stress_case *what, float t) {
    const double world = (double)t * stress_length(what->ray.direction);
    double origin = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        origin = fmax(origin, fabs((double)what->ray.origin[axis]));
    const double size = fmax((double)what->settings.size, bound_size(what->bound));
    const double floor_of_t = ldexp(world + origin + size, -22);
    const double cone = (double)what->settings.pixel_radius * ((double)what->path + world);
    return fmax(fmax((double)what->settings.epsilon, cone), floor_of_t);
}

void stress_position(const spt_ray *ray, float t, float position[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        const float offset = t * ray->direction[axis];
        position[axis] = ray->origin[axis] + offset;
    }
}

float stress_value(const stress_case *what, float t) {
    float p[3];
    stress_position(&what->ray, t, p);
    return what->distance(what->data, p[0], p[1], p[2]);
}

void stress_expect(const spt_hit *hit, spt_outcome outcome, double t, double tolerance) {
    CHECK_SAY(hit->outcome == (int32_t)outcome, "outcome %d at t %.9g after %u, expected %d",
              (int)hit->outcome, (double)hit->t, (unsigned)hit->evaluations, (int)outcome);
    if (outcome == SPT_MISS || outcome == SPT_BAD_RAY) return;
    CHECK_SAY(stress_within((double)hit->t, t, tolerance), "t %.9g, expected %.9g +- %.3g",
              (double)hit->t, t, tolerance);
}

void stress_expect_evaluations(const spt_hit *hit, uint32_t low, uint32_t high) {
    CHECK_SAY(hit->evaluations >= low && hit->evaluations <= high,
              "%u evaluations, expected %u .. %u", (unsigned)hit->evaluations, (unsigned)low,
              (unsigned)high);
}

int stress_same_hit(const spt_hit *a, const spt_hit *b) {
    return memcmp(a, b, sizeof *a) == 0; /* nine fields of four bytes, no padding */
}

/* ---- What every result satisfies ----------------------------------------------------------- */

/* The library forms the tolerance and the candidate in float with fewer than ten operations, each
 * within 2^-24, on both sides of the comparison. */
static const double rounding = 1.0 / (1 << 20);

static int inside_interval(const stress_case *what, float t) {
    return t >= what->ray.t_min && t <= what->ray.t_max;
}

static void check_surface(const stress_case *what, const spt_hit *hit) {
    const int stopped_inside =
        (hit->flags & SPT_FLAG_INSIDE) != 0 && (what->settings.flags & SPT_STOP_INSIDE) != 0;
    const double r = fabs((double)hit->residual) / (double)what->lipschitz;
    CHECK_SAY(inside_interval(what, hit->t), "t %.9g", (double)hit->t);
    CHECK_SAY(check_same_bits(hit->residual, stress_value(what, hit->t)),
              "residual %.9g at t %.9g where f is %.9g", (double)hit->residual, (double)hit->t,
              (double)stress_value(what, hit->t));
    CHECK(hit->evaluations >= 1);
    CHECK(hit->component == 0);
    if ((hit->flags & SPT_FLAG_STEEP) == 0 && !stopped_inside) {
        CHECK_SAY(r < stress_tolerance(what, hit->t) * (1.0 + rounding), "r %.9g, tolerance %.9g",
                  r, stress_tolerance(what, hit->t));
    }
}

static void check_limit(const stress_case *what, const spt_hit *hit) {
    CHECK_SAY(inside_interval(what, hit->t), "t %.9g", (double)hit->t);
    if (hit->evaluations == 0) {
        CHECK(check_same_bits(hit->t, what->ray.t_min));
        CHECK(check_same_bits(hit->residual, stress_infinity()));
    } else {
        CHECK_SAY(check_same_bits(hit->residual, stress_value(what, hit->t)),
                  "residual %.9g at t %.9g where f is %.9g", (double)hit->residual, (double)hit->t,
                  (double)stress_value(what, hit->t));
    }
    if (hit->evaluations != what->settings.budget) { /* fewer only where t cannot move any more */
        const double step = fabs((double)hit->residual) / (double)what->lipschitz /
                            stress_length(what->ray.direction);
        CHECK_SAY(check_same_bits((float)((double)hit->t + step), hit->t),
                  "undecided after %u evaluations", (unsigned)hit->evaluations);
    }
}

static void check_outcome(const stress_case *what, const spt_hit *hit) {
    const float infinity = stress_infinity();
    switch (hit->outcome) {
    case SPT_HIT:
        check_surface(what, hit);
        break;
    case SPT_LIMIT:
        check_limit(what, hit);
        break;
    case SPT_MISS:
    case SPT_BAD_RAY:
        CHECK(check_same_bits(hit->t, infinity));
        CHECK(check_same_bits(hit->residual, infinity));
        if (hit->outcome == SPT_BAD_RAY) {
            CHECK(hit->evaluations == 0);
            CHECK(hit->flags == 0);
            CHECK(check_same_bits(hit->candidate_ratio, infinity));
        }
        break;
    case SPT_NONFINITE:
        CHECK(inside_interval(what, hit->t));
        CHECK(hit->evaluations >= 1);
        CHECK(stress_is_nan(hit->residual) || check_same_bits(hit->residual, -infinity));
        CHECK(check_same_bits(hit->residual, stress_value(what, hit->t)));
        break;
    default:
        CHECK_SAY(0, "outcome %d", (int)hit->outcome);
    }
}

/* Keinert 2014, section 3.2, with the denominator of trace.h. */
static void check_candidate(const stress_case *what, const spt_hit *hit) {
    CHECK(!stress_is_nan(hit->candidate_ratio) && !stress_is_nan(hit->candidate_t));
    CHECK(hit->candidate_ratio >= 0.0f);
    if (hit->candidate_ratio > FLT_MAX) return;
    CHECK(hit->evaluations >= 1);
    CHECK_SAY(inside_interval(what, hit->candidate_t), "candidate_t %.9g",
              (double)hit->candidate_t);
    const double world =
        (double)what->path + (double)hit->candidate_t * stress_length(what->ray.direction);
    const double value = fabs((double)stress_value(what, hit->candidate_t));
    const double ratio =
        value / (double)what->lipschitz / fmax(world, (double)what->settings.epsilon);
    CHECK_SAY(stress_within((double)hit->candidate_ratio, ratio, rounding * ratio + 1e-44),
              "ratio %.9g at t %.9g where it is %.9g", (double)hit->candidate_ratio,
              (double)hit->candidate_t, ratio);
}

void stress_check_hit(const stress_case *what, const spt_hit *hit) {
    check_outcome(what, hit);
    check_candidate(what, hit);
    CHECK(hit->evaluations <= what->settings.budget);
    CHECK(hit->fallbacks == 0 || hit->fallbacks < hit->evaluations);
    CHECK((hit->flags & ~(uint32_t)(SPT_FLAG_STEEP | SPT_FLAG_INSIDE)) == 0);
    CHECK(!stress_is_nan(hit->t));
    CHECK(!stress_is_nan(hit->residual) || hit->outcome == SPT_NONFINITE);
    CHECK(hit->component == (hit->outcome == SPT_HIT ? 0 : -1));
}

static void check_statistics(const stress_way *way, const spt_hit *hits, size_t count,
                             const stress_probe *probe, const spt_statistics *statistics) {
    uint64_t outcomes[SPT_OUTCOMES] = {0, 0, 0, 0, 0}, evaluations = 0, fallbacks = 0;
    for (size_t i = 0; i < count; ++i) {
        if (hits[i].outcome >= 0 && hits[i].outcome < SPT_OUTCOMES) ++outcomes[hits[i].outcome];
        evaluations += hits[i].evaluations;
        fallbacks += hits[i].fallbacks;
    }
    CHECK_SAY(statistics->lanes == way->lanes, "%u lanes ran", (unsigned)statistics->lanes);
    CHECK(statistics->rays == count);
    CHECK(memcmp(statistics->outcomes, outcomes, sizeof outcomes) == 0);
    CHECK(statistics->evaluations == evaluations);
    CHECK(statistics->fallbacks == fallbacks);
    CHECK(statistics->slots >= evaluations);
    CHECK(!stress_is_nan(statistics->largest_slope));
    CHECK_SAY(probe->faults == 0, "the callback saw %u broken promises", (unsigned)probe->faults);
    if (way->point) {
        CHECK_SAY(probe->calls == evaluations, "%u calls", (unsigned)probe->calls);
    } else {
        CHECK(probe->points == statistics->slots);
        CHECK(probe->calls == statistics->passes);
    }
}

static void add_results(stress_way *way, const spt_hit *hit) {
    unsigned char bytes[sizeof *hit];
    memcpy(bytes, hit, sizeof bytes);
    for (size_t i = 0; i < sizeof bytes; ++i) {
        way->results = (way->results ^ bytes[i]) * 0x100000001b3u;
    }
}

spt_hit stress_run(stress_way *way, const stress_case *what, stress_probe *probe) {
    static const unsigned char junk = 0xa5;
    stress_probe own;
    stress_probe *const seen = probe != NULL ? probe : &own;
    spt_statistics statistics = spt_statistics_default();
    spt_rays rays = spt_rays_of(&what->ray);
    const spt_settings settings = stress_settings(way, what);
    spt_hit hit;
    spt_hits hits = spt_hits_of(&hit);
    stress_probe_of(seen, what, 1);
    const spt_field field = stress_field(way, what, seen);
    memset(&hit, junk, sizeof hit);
    rays.path.first = &what->path;
    CHECK(spt_trace(&field, &settings, 1, &rays, &hits, &statistics) == SPT_OK);
    stress_check_hit(what, &hit);
    check_statistics(way, &hit, 1, seen, &statistics);
    /* One ray: every call, of either form, is one evaluation. */
    CHECK_SAY(seen->calls == hit.evaluations, "%u calls, %u evaluations", (unsigned)seen->calls,
              (unsigned)hit.evaluations);
    stress_slope = statistics.largest_slope;
    add_results(way, &hit);
    return hit;
}

void stress_run_many(const stress_way *way, const stress_case *what, size_t count,
                     const spt_ray *rays, spt_hit *hits) {
    stress_probe probe;
    spt_statistics statistics = spt_statistics_default();
    const spt_settings settings = stress_settings(way, what);
    spt_rays columns = spt_rays_of(rays);
    const spt_hits sinks = spt_hits_of(hits);
    stress_probe_of(&probe, what, 0);
    const spt_field field = stress_field(way, what, &probe);
    columns.path.first = &what->path; /* stride 0: one for all */
    if (count != 0) memset(hits, 0xa5, count * sizeof *hits);
    CHECK(spt_trace(&field, &settings, count, &columns, &sinks, &statistics) == SPT_OK);
    check_statistics(way, hits, count, &probe, &statistics);
}

void stress_refused(const stress_way *way, const stress_case *what) {
    spt_statistics statistics = spt_statistics_default(), statistics_before;
    const spt_rays rays = spt_rays_of(&what->ray);
    const spt_settings settings = stress_settings(way, what);
    spt_hit hit, before;
    const spt_hits hits = spt_hits_of(&hit);
    stress_probe probe;
    stress_probe_of(&probe, what, 1);
    const spt_field field = stress_field(way, what, &probe);
    memset(&hit, 0x5a, sizeof hit);
    before = hit;
    memcpy(&statistics_before, &statistics, sizeof statistics);
    CHECK(spt_trace(&field, &settings, 1, &rays, &hits, &statistics) == SPT_BAD_ARGUMENT);
    CHECK(memcmp(&hit, &before, sizeof hit) == 0);
    CHECK(memcmp(&statistics, &statistics_before, sizeof statistics) == 0);
    CHECK(probe.calls == 0);
}
