/* SPDX-License-Identifier: MIT
 *
 * kernels.csv: what the kernels of a kernel-reflection sequence take, and that a level whose kernel
 * is empty takes its mirror only, in time and in the emitted shader. */
#include "left_out_shaders.h"

#include "../report.h"

#include <math.h>
#include <string.h>

enum { levels = 16, model_count = 5, most_rounds = 32 };

static const int every[model_count] = {1, 2, 4, 8, 16}; /* which levels have a kernel */

/* Capsules between mirrors that turn by the golden angle. Where they are makes no difference: a
 * level's work is the same everywhere. */
static void build(spt_krs *krs, int step) {
    spt_kernel kernels[levels + 1];
    spt_mirror mirrors[levels];
    spt_krs_model model = spt_krs_model_default();
    for (int level = 0; level <= levels; ++level) {
        const float turn = 2.4f * (float)level, up = 0.1f * (float)level;
        const float from[3] = {0.0f, up, 0.0f}, to[3] = {cosf(turn), up + 0.5f, sinf(turn)};
        const float bend[3] = {0.4f * cosf(turn), up + 0.4f, 0.6f * sinf(turn)};
        const spt_mirror mirror = {{sinf(turn), 0.3f, cosf(turn)}, 0.5f + up};
        kernels[level] =
            level % step == 0 ? spt_kernel_capsule(from, to, bend, 0.05f) : spt_kernel_empty();
        if (level < levels) mirrors[level] = mirror;
    }
    model.levels = levels;
    model.kernels = kernels;
    model.mirrors = mirrors;
    report_expect(spt_krs_build(&model, krs) == SPT_OK, "a model was refused");
}

/* Nanoseconds an evaluation. */
static double time_field(const spt_field *field, double least_seconds) {
    /* What callbacks are promised is 64 bytes. */
    static float room[4 * SPT_BATCH + 16];
    float *const x = room + (64 - (uintptr_t)room % 64) % 64 / sizeof *room;
    float *const y = x + SPT_BATCH, *const z = y + SPT_BATCH, *const to = z + SPT_BATCH;
    report_random random = {7};
    for (int i = 0; i < 3 * SPT_BATCH; ++i) x[i] = (float)report_uniform(&random, -2, 2);
    const double before = bench_seconds();
    double seconds;
    int times = 0;
    do {
        for (int i = 0; i < 16; ++i) field->batch(field->user, SPT_BATCH, x, y, z, to);
        seconds = bench_seconds() - before;
        times += 16;
    } while (seconds < least_seconds);
    return 1e9 * seconds / ((double)times * SPT_BATCH);
}

static int kernel_count(const spt_krs *krs) {
    int count = 0;
    for (int level = 0; level <= levels; ++level) {
        count += krs->kernels[level].kind != SPT_KERNEL_EMPTY;
    }
    return count;
}

static int one(const report_options *options) {
    (void)options;
    return 1;
}

static void measure(const report_options *options, int cell, FILE *rows) {
    static spt_krs krs[model_count];
    static double nanoseconds[model_count][most_rounds];
    const size_t rounds = options->quick ? 7 : 21;
    spt_field fields[model_count];
    spt_glsl_options library = spt_glsl_options_default();
    (void)cell;
    library.target = SPT_GLSL_LIBRARY;
    for (int i = 0; i < model_count; ++i) {
        build(&krs[i], every[i]);
        fields[i] = spt_krs_field(&krs[i]);
    }
    for (size_t round = 0; round < rounds; ++round) {
        for (int i = 0; i < model_count; ++i) {
            nanoseconds[i][round] = time_field(&fields[i], options->quick ? 0.002 : 0.006);
        }
    }
    for (int i = model_count - 1; i >= 0; --i) {
        const int kernels = kernel_count(&krs[i]);
        const shader_size size = shader_size_of(&fields[i], &library);
        double ratios[most_rounds];
        for (size_t k = 0; k < rounds; ++k) ratios[k] = nanoseconds[i][k] / nanoseconds[0][k];
        fprintf(rows, "%d,%d,%d,%.9g,%.9g,%.9g,%.9g,%d\n", levels, kernels, levels + 1 - kernels,
                report_quantile(ratios, rounds, 0.5), report_quantile(ratios, rounds, 0.25),
                report_quantile(ratios, rounds, 0.75), report_quantile(nanoseconds[i], rounds, 0.5),
                size.code_lines);
    }
}

const report_part report_kernels = {
    "kernels", "levels,kernels,empty,ratio,low,high,nanoseconds,code_lines", one, measure, 1,
    {1, 0.2}};
