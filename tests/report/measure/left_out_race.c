/* SPDX-License-Identifier: MIT
 *
 * The rounds of a race, and its rows. */
#include "left_out_race.h"

enum { most_rounds = 32 };

void left_out_enter(left_out_field *field, const char *feature, const char *kind, int against,
                    left_out_run *run, const void *work) {
    const left_out_runner runner = {feature, kind, against, run, work};
    report_expect(field->count < left_out_most_runners, "too many runners");
    field->runners[field->count++] = runner;
}

/* Seconds of one slice, which runs as often as the clock needs. */
static double run_slice(const left_out_runner *runner, size_t start, double least_seconds) {
    const double before = bench_seconds();
    double seconds;
    int times = 0;
    do {
        runner->run(runner->work, start);
        seconds = bench_seconds() - before;
        ++times;
    } while (seconds < least_seconds);
    return seconds / times;
}

static void write_row(const left_out_field *field, const left_out_runner *runner, int rounds,
                      double ratios[most_rounds], FILE *rows) {
    const size_t count = (size_t)rounds;
    fprintf(rows, "%s,%s,%s,%.9g,%.9g,%.9g,%s\n", runner->feature, field->scene, field->method,
            report_quantile(ratios, count, 0.5), report_quantile(ratios, count, 0.25),
            report_quantile(ratios, count, 0.75), runner->kind);
}

void left_out_race(const report_options *options, const left_out_field *field, FILE *rows) {
    static double seconds[left_out_most_runners][most_rounds];
    const int rounds = options->quick ? 7 : 21;
    const double slice_seconds = options->quick ? 0.002 : 0.006;
    const size_t slices = field->rays / left_out_slice;
    report_expect(slices > 0, "a picture is smaller than a slice");
    for (int round = 0; round < rounds; ++round) {
        const size_t start = (size_t)round % slices * left_out_slice;
        for (int turn = 0; turn < field->count; ++turn) {
            /* Not always the same one after the same other. */
            const int i = (turn + round) % field->count;
            seconds[i][round] = run_slice(&field->runners[i], start, slice_seconds);
        }
    }
    for (int i = 0; i < field->count; ++i) {
        const left_out_runner *const runner = &field->runners[i];
        double ratios[most_rounds];
        if (runner->feature == NULL) continue;
        for (int round = 0; round < rounds; ++round) {
            ratios[round] = seconds[i][round] / seconds[runner->against][round];
        }
        write_row(field, runner, rounds, ratios, rows);
    }
}
