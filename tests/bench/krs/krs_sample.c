/* SPDX-License-Identifier: MIT
 *
 * Rays of a picture that hits are judged by, and where their surfaces are. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "krs_bench.h"

enum { EVERY = 16, FINER = 100, MOST_EVALUATIONS = 20000 };

/* Hits so many tolerances before a surface are of something that the exact ray passes. */
static const double of_another = 20;

krs_sample krs_sample_of(const frame_picture *picture) {
    krs_sample sample = {0, NULL, NULL, NULL};
    const size_t most = (picture->count / SPT_BATCH / EVERY + 1) * SPT_BATCH;
    sample.rays = frame_allocate(most * sizeof *sample.rays);
    sample.place = frame_allocate(most * sizeof *sample.place);
    sample.exact = frame_allocate(most * sizeof *sample.exact);
    for (size_t i = 0; i < picture->count; ++i) {
        if (i / SPT_BATCH % EVERY != 0) continue;
        sample.rays[sample.count] = picture->rays[i];
        sample.place[sample.count++] = i;
    }
    return sample;
}

void krs_sample_free(krs_sample *sample) {
    free(sample->rays);
    free(sample->place);
    free(sample->exact);
}

/* By the basic rule, ray by ray, with a hundredth of the tolerance. */
void krs_sample_exact(krs_sample *sample, const krs_models *models, krs_body body,
                      const spt_settings *settings) {
    spt_settings finer = *settings;
    finer.method = spt_basic();
    finer.budget = MOST_EVALUATIONS;
    finer.epsilon /= FINER;
    finer.pixel_radius /= FINER;
    const spt_rays rays = spt_rays_of(sample->rays);
    bench_hit *const hits = frame_image_of(sample->count);
    const spt_hits sinks = bench_hits_of(hits);
    const spt_scene *const traced = &models->scenes[body];
    const size_t size = spt_scene_workspace(traced, &finer);
    void *const workspace = frame_allocate(size);
    frame_expect(
        spt_scene_trace(traced, &finer, sample->count, &rays, &sinks, workspace, size, NULL),
        "spt_scene_trace");
    free(workspace);
    for (size_t i = 0; i < sample->count; ++i) {
        sample->exact[i] = hits[i].outcome == SPT_MISS ? HUGE_VAL : (double)hits[i].t;
    }
    free(hits);
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

krs_error krs_sample_judge(const krs_sample *sample, const spt_settings *settings,
                           const bench_hit *hits) {
    krs_error error = {0, 0, 0, 0, 0, 0};
    double *const found = frame_allocate((sample->count + 1) * sizeof *found);
    double evaluations = 0;
    size_t number = 0, kept = 0;
    for (size_t i = 0; i < sample->count; ++i) {
        const bench_hit *const hit = &hits[i];
        const double t = (double)hit->t, exact = sample->exact[i];
        const double reached = hit->outcome == SPT_HIT ? t : exact;
        const double tolerance =
            fmax((double)settings->epsilon, (double)settings->pixel_radius * reached);
        error.undecided += hit->outcome == SPT_LIMIT;
        if (hit->outcome == SPT_MISS) error.lost += exact < HUGE_VAL;
        if (hit->outcome != SPT_HIT) continue;
        const double before = (exact - t) / tolerance;
        ++number;
        evaluations += hit->evaluations;
        error.lost += before < -1;
        error.passed += before > of_another;
        if (before <= of_another) found[kept++] = before;
    }
    for (size_t i = 0; i < kept; ++i) error.mean += found[i] / (double)kept;
    qsort(found, kept, sizeof *found, compare);
    error.most = kept > 0 ? found[kept * 95 / 100] : 0;
    error.passed /= (double)sample->count;
    error.lost /= (double)sample->count;
    error.undecided /= (double)sample->count;
    error.per_hit = number > 0 ? evaluations / (double)number : 0;
    free(found);
    return error;
}

double krs_hits_ratio(size_t count, const bench_hit *ones, const bench_hit *others) {
    double one = 0, other = 0;
    for (size_t i = 0; i < count; ++i) {
        if (ones[i].outcome != SPT_HIT || others[i].outcome != SPT_HIT) continue;
        one += ones[i].evaluations;
        other += others[i].evaluations;
    }
    return one / other;
}
