/* SPDX-License-Identifier: MIT
 *
 * Contenders that take turns, and their rows. */
#include "keinert_bench.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void keinert_expect(spt_status status, const char *what) {
    if (status == SPT_OK) return;
    fprintf(stderr, "%s: %s\n", what, spt_status_name(status));
    exit(1);
}

void *keinert_allocate(size_t size) {
    void *memory = calloc(1, size);
    if (memory == NULL) {
        fprintf(stderr, "out of memory\n");
        exit(1);
    }
    return memory;
}

void keinert_race(keinert_contender *contenders, int number, int rounds, keinert_run_fn *run) {
    for (int round = 0; round < rounds; ++round) {
        for (int turn = 0; turn < number; ++turn) {
            keinert_contender *const contender = &contenders[(round + turn) % number];
            contender->seconds[round] = run(contender->user, round);
        }
    }
}

double keinert_time_ratio(const keinert_contender *contenders, int which, int rounds) {
    const keinert_contender *const one = &contenders[which];
    double ratios[BENCH_MOST_ROUNDS];
    for (int round = 0; round < rounds; ++round) {
        ratios[round] = contenders[one->against].seconds[round] / one->seconds[round];
    }
    return bench_median(ratios, rounds);
}

double keinert_middle_seconds(const keinert_contender *contender, int rounds) {
    double seconds[BENCH_MOST_ROUNDS];
    memcpy(seconds, contender->seconds, sizeof seconds);
    return bench_median(seconds, rounds);
}

keinert_part keinert_part_of(size_t count, int round, int rounds) {
    keinert_part part;
    part.begin = count * (size_t)round / (size_t)rounds;
    part.count = count * ((size_t)round + 1) / (size_t)rounds - part.begin;
    return part;
}

keinert_row keinert_row_of(const char *measure, const char *shown) {
    const double none = (double)NAN;
    const keinert_row row = {measure, shown, none, none, none, none, none,
                             "none",  none,  none, none, none, none, none};
    return row;
}

/* ---- Rows ---------------------------------------------------------------------------------- */

/* A field of the table; empty where nothing was measured. */
static void write_number(FILE *file, double number) {
    if (isnan(number)) {
        fprintf(file, ",");
    } else {
        fprintf(file, ",%.9g", number);
    }
}

static void print_number(double number, int width, int digits) {
    if (isnan(number)) {
        printf("%*s", width, "-");
    } else {
        printf("%*.*f", width, digits, number);
    }
}

static void write_row(FILE *file, const keinert_contender *contenders, const keinert_row *rows,
                      int which, double time_ratio) {
    const keinert_contender *const one = &contenders[which];
    const keinert_row *const row = &rows[which], *const base = &rows[one->against];
    /* Names hold commas. */
    fprintf(file, "%s,%s,\"%s\",\"%s\"", row->measure, row->scene, one->name,
            contenders[one->against].name);
    write_number(file, row->rays);
    write_number(file, row->evaluations);
    write_number(file, row->evaluations / row->rays);
    write_number(file, base->evaluations / row->evaluations);
    write_number(file, time_ratio);
    write_number(file, row->of_the_library);
    write_number(file, one->paper > 0 ? one->paper : (double)NAN);
    write_number(file, row->nanoseconds);
    write_number(file, row->error);
    write_number(file, row->error_of_base);
    fprintf(file, ",\"%s\"", row->error_of);
    write_number(file, row->lost);
    write_number(file, row->late);
    write_number(file, row->passed);
    write_number(file, row->undecided);
    write_number(file, row->inside_a_ray);
    fprintf(file, "\n");
}

static void print_row(const keinert_contender *contenders, const keinert_row *rows, int which,
                      double time_ratio) {
    const keinert_contender *const one = &contenders[which];
    const keinert_row *const row = &rows[which], *const base = &rows[one->against];
    printf("%-28s", one->name);
    print_number(row->evaluations / row->rays, 9, 3);
    print_number(row->evaluations * 1e-6, 10, 2);
    print_number(row->inside_a_ray, 8, 2);
    print_number(base->evaluations / row->evaluations, 8, 3);
    print_number(time_ratio, 8, 3);
    print_number(row->of_the_library, 8, 3);
    print_number(row->nanoseconds, 9, 1);
    if (isnan(row->error)) {
        printf("%11s", "-");
    } else {
        printf("%11.3e", row->error);
    }
    print_number(row->lost, 6, 0);
    print_number(row->late, 6, 0);
    print_number(row->passed, 8, 0);
    print_number(row->undecided, 10, 0);
    printf("   %s\n", contenders[one->against].name);
}

/* What the paper saved, and what this does, at which error. */
static void print_judgement(const keinert_contender *contenders, const keinert_row *rows, int which,
                            double time_ratio) {
    const keinert_contender *const one = &contenders[which];
    const keinert_row *const row = &rows[which], *const base = &rows[one->against];
    const double evaluations = base->evaluations / row->evaluations;
    const double library = row->of_the_library;
    if (one->fewer > 0) {
        printf("  %s against %s: goal %.2f times fewer evaluations: %.3f %s   (time %.3f)",
               one->name, contenders[one->against].name, one->fewer, evaluations,
               evaluations >= one->fewer ? "reached" : "NOT REACHED", time_ratio);
    } else if (one->paper > 0) {
        printf("  %s against %s: paper %.2f   time %.3f %s   evaluations %.3f %s", one->name,
               contenders[one->against].name, one->paper, time_ratio,
               time_ratio >= one->paper ? "reached" : "NOT REACHED", evaluations,
               evaluations >= one->paper ? "reached" : "NOT REACHED");
    } else {
        return;
    }
    if (!isnan(library)) {
        printf("   tracing alone %.3f %s", library,
               library >= one->paper ? "reached" : "NOT REACHED");
    }
    if (!isnan(row->error)) {
        printf("   error %.3e (%s %.3e)", row->error,
               row->error <= row->error_of_base ? "not more than" : "MORE THAN",
               row->error_of_base);
    }
    printf("\n");
}

void keinert_report(FILE *file, const keinert_contender *contenders, const keinert_row *rows,
                    int number, int rounds) {
    double ratios[16];
    printf("\n%s, %s (error: %s)\n%-28s%9s%10s%8s%8s%8s%8s%9s%11s%6s%6s%8s%10s   %s\n",
           rows->measure, rows->scene, rows->error_of, "", "evals/ray", "1e6 evals", "inside",
           "evals x", "time x", "tracing", "ns/ray", "error", "lost", "late", "passed", "undecided",
           "x: against");
    for (int which = 0; which < number; ++which) {
        ratios[which] = keinert_time_ratio(contenders, which, rounds);
        write_row(file, contenders, rows, which, ratios[which]);
        print_row(contenders, rows, which, ratios[which]);
    }
    for (int which = 0; which < number; ++which) {
        print_judgement(contenders, rows, which, ratios[which]);
    }
    fflush(stdout);
}
