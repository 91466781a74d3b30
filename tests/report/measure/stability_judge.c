/* SPDX-License-Identifier: MIT
 *
 * Drawing rays of a family, and judging what became of them. */
#include "stability_judge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../oracle/tolerance.h"

#define FAMILY(name) &stability_##name,
const stability_family *const stability_families[] = {
#include "stability_list.h"
};
#undef FAMILY
const int stability_family_count = sizeof stability_families / sizeof stability_families[0];

enum { quick_values = 5 };

int stability_value_count(const report_options *options, int family) {
    return options->quick ? quick_values : stability_families[family]->count;
}

double stability_value(const report_options *options, int family, int number) {
    const stability_family *const swept = stability_families[family];
    if (!options->quick) return swept->values[number];
    return swept->values[number * (swept->count - 1) / (quick_values - 1)];
}

void stability_trace(const stability_world *world, const char *rule,
                     const stability_sample *sample) {
    spt_settings settings = world->settings;
    const spt_rays rays = spt_rays_of(sample->rays);
    const spt_hits hits = spt_hits_of(sample->hits);
    settings.method = bench_method(rule);
    report_expect(spt_trace(&world->field, &settings, sample->count, &rays, &hits, NULL) == SPT_OK,
                  "a field is refused");
}

int stability_runs(int family, const char *rule) {
    return bench_method(rule) != spt_convex() || stability_families[family]->convex;
}

size_t stability_ray_count(const report_options *options) {
    return options->quick ? 2000 : 20000;
}

stability_sample stability_sample_of(size_t count) {
    stability_sample sample;
    sample.count = count;
    sample.rays = report_allocate(count * sizeof *sample.rays);
    sample.truths = report_allocate(count * sizeof *sample.truths);
    sample.hits = report_allocate(count * sizeof *sample.hits);
    sample.evaluations = report_allocate(count * sizeof *sample.evaluations);
    sample.failed = report_allocate(count);
    return sample;
}

void stability_sample_free(stability_sample *sample) {
    free(sample->rays);
    free(sample->truths);
    free(sample->hits);
    free(sample->evaluations);
    free(sample->failed);
}

void stability_draw(int family, double value, stability_world *world, stability_sample *sample) {
    const stability_family *const swept = stability_families[family];
    report_random random = {(uint64_t)family};
    size_t unknown = 0;
    memset(world, 0, sizeof *world);
    swept->build(world, value);
    world->bound = swept->bound;
    for (size_t i = 0; i < sample->count; ++i) {
        swept->ray(world, &random, &sample->rays[i]);
        swept->truth(world, &sample->rays[i], &sample->truths[i]);
        stability_find_last(world, &sample->rays[i], &sample->truths[i]);
        unknown += sample->truths[i].unknown != 0;
    }
    report_expect(100 * unknown <= sample->count, "the truth of too many rays is not found");
}

/* A hit is right if it lies where the surface is, as far as tolerance and rounding tell, or next to
 * the place where the ray meets the body, and overlooks nothing before it. The tolerance is one of
 * |f| / lipschitz: of a bound that underestimates hits may lie as many times farther off. */
static int is_right(const stability_world *world, const spt_ray *ray, const stability_truth *truth,
                    double t) {
    const double apart = fabs(t - truth->first) * oracle_length(ray);
    const double allowed =
        oracle_tolerance(&world->settings, ray, t) + stability_rounding(world, ray, t);
    return t <= truth->last && (stability_near(world, ray, t) || apart <= allowed);
}

static void judge_hit(const stability_world *world, const spt_ray *ray,
                      const stability_truth *truth, const spt_hit *hit, stability_tally *sum) {
    const double t = (double)hit->t;
    ++sum->hits;
    if (!truth->unknown && !is_right(world, ray, truth, t)) {
        if (truth->first < HUGE_VAL) {
            ++sum->wrong;
        } else {
            ++sum->ghosts;
        }
    }
    if (!world->bound && (hit->flags & SPT_FLAG_STEEP) != 0) return;
    /* The library compares in float: r and the tolerance are off by 4u each, at most. */
    const double residual = fabs((double)hit->residual) / (double)world->field.lipschitz /
                            oracle_tolerance(&world->settings, ray, t);
    sum->residual_over_tolerance = fmax(sum->residual_over_tolerance, residual);
    sum->bad_residual += !(residual <= 1 + 8 * 0x1p-24);
}

static void judge_ray(const stability_world *world, const spt_ray *ray,
                      const stability_truth *truth, const spt_hit *hit, stability_tally *sum) {
    const int outcome = (int)hit->outcome;
    const int clear_miss = !truth->unknown && !(truth->first < HUGE_VAL);
    const int clear = clear_miss || (!truth->unknown && truth->clear < HUGE_VAL);
    report_expect(outcome != SPT_BAD_RAY, "a ray that was drawn is none");
    sum->truth_hits += truth->first < HUGE_VAL;
    sum->clear_hits += truth->clear < HUGE_VAL;
    sum->lost += outcome == SPT_MISS && truth->clear < HUGE_VAL;
    sum->undecided += outcome == SPT_LIMIT;
    sum->clear_misses += clear_miss;
    sum->clear_undecided += clear && (outcome == SPT_LIMIT || outcome == SPT_NONFINITE);
    sum->nonfinite += outcome == SPT_NONFINITE;
    sum->steep += (hit->flags & SPT_FLAG_STEEP) != 0;
    sum->bad_nan += isnan(hit->t) || isnan(hit->candidate_t) || isnan(hit->candidate_ratio) ||
                    (isnan(hit->residual) && outcome != SPT_NONFINITE);
    sum->bad_budget += hit->evaluations > world->settings.budget;
    if (outcome == SPT_HIT) judge_hit(world, ray, truth, hit, sum);
}

static int failures(const stability_tally *sum) {
    return sum->wrong + sum->lost + sum->ghosts;
}

stability_tally stability_judge(const stability_world *world, stability_sample *sample) {
    stability_tally sum;
    memset(&sum, 0, sizeof sum);
    sum.residual_over_tolerance = (double)NAN;
    for (size_t i = 0; i < sample->count; ++i) {
        const int before = failures(&sum);
        judge_ray(world, &sample->rays[i], &sample->truths[i], &sample->hits[i], &sum);
        sample->failed[i] = failures(&sum) > before;
        sample->evaluations[i] = sample->hits[i].evaluations;
    }
    return sum;
}
