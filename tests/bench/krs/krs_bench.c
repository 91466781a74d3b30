/* SPDX-License-Identifier: MIT
 *
 * The measurements of Szécsi et al. 2016, section 11: what kernel-reflection sequences take by
 * their number of levels, traced directly, by binary tracing, after cones, and as compounds, and
 * Möbius sequences by binary tracing and by the bound of their distance.
 *     krs_bench [--quick] [--output DIR]
 * --quick: a quarter of the pixels and fewer rounds. Fails where a ray overlooks a surface; a goal
 * that is not reached is printed and no failure. */
#include "krs_bench.h"

#include <string.h>

static void print_machine(void) {
    char line[256];
    FILE *file = fopen("/proc/cpuinfo", "r");
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        if (strncmp(line, "model name", 10) == 0) {
            fputs(line, stdout);
            break;
        }
    }
    if (file != NULL) fclose(file);
    printf("compiler   : %s\nlanes      : %d\n\n", __VERSION__, spt_lanes());
}

int main(int argc, char **argv) {
    bench_options options = {1920, 1200, 0, 0, 15, 0.008, "."};
    for (int i = 1; i < argc; ++i) {
        if (strcmp(argv[i], "--quick") == 0) {
            options.width = 960;
            options.height = 600;
            options.rounds = 5;
            options.slice_seconds = 0.002;
        } else if (strcmp(argv[i], "--output") == 0 && i + 1 < argc) {
            options.output = argv[++i];
        } else {
            fprintf(stderr, "usage: krs_bench [--quick] [--output DIR]\n");
            return 2;
        }
    }
    print_machine();
    FILE *file = bench_open(&options, "krs.csv",
                            "case,levels,components,instances,rule,ms_per_picture,ns_per_pixel,"
                            "evaluations_per_pixel,ns_per_evaluation,evaluations_per_hit,"
                            "error_mean,error_95,passed,lost,undecided,probe_ratio");
    krs_evaluations(&options, file);
    const int sound = krs_race(&options, file);
    fclose(file);
    return sound ? 0 : 1;
}
