/* SPDX-License-Identifier: MIT
 *
 * What the driver achieves: its speed against a scalar loop, what it costs besides the callback,
 * and how many evaluations the step rules need.
 *     driver [--quick] [--output DIR]
 * --quick: smaller pictures and fewer rounds. Fails where the results of library and scalar loop
 * differ in a bit; a target that is not reached is printed and no failure. */
#include <string.h>

#include "bench.h"

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
    bench_options options = {1280, 720, 160, 120, 15, 0.06, "."};
    for (int i = 1; i < argc; ++i) {
        if (strcmp(argv[i], "--quick") == 0) {
            options.width = 640;
            options.height = 352;
            options.small_width = 80;
            options.small_height = 60;
            options.rounds = 5;
            options.slice_seconds = 0.02;
        } else if (strcmp(argv[i], "--output") == 0 && i + 1 < argc) {
            options.output = argv[++i];
        } else {
            fprintf(stderr, "usage: driver [--quick] [--output DIR]\n");
            return 2;
        }
    }
    print_machine();
    const int equal = bench_race(&options);
    bench_overhead(&options);
    bench_evaluations(&options);
    return equal ? 0 : 1;
}
