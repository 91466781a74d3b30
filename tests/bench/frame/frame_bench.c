/* SPDX-License-Identifier: MIT
 *
 * What whole frames achieve: cones, culling and lazy unions against a scalar loop that has the
 * distance of the whole scene inlined, two threads, and how many evaluations cones save.
 *     frame_bench [--quick] [--output DIR]
 * --quick: smaller pictures and fewer rounds. Fails where results differ that must not; a target
 * that is not reached is printed and no failure. */
#include "frame_bench.h"

#include <string.h>

void frame_write_row(FILE *file, const frame_row *row) {
    fprintf(file, "%s,%d,%d,%d,%d,%.3f,%.4f,%zu,%s,%zu,%.3f,%.3f,%zu\n", row->scene, row->lanes,
            row->cones, row->culling, row->threads, row->ratio, row->evaluations, row->flips,
            row->rule, row->components, row->whole_ratio, row->nanoseconds, row->own_flips);
}

int main(int argc, char **argv) {
    bench_options options = {1280, 720, 0, 0, 15, 0.005, "."};
    for (int i = 1; i < argc; ++i) {
        if (strcmp(argv[i], "--quick") == 0) {
            options.width = 640;
            options.height = 384;
            options.rounds = 5;
            options.slice_seconds = 0.002;
        } else if (strcmp(argv[i], "--output") == 0 && i + 1 < argc) {
            options.output = argv[++i];
        } else {
            fprintf(stderr, "usage: frame_bench [--quick] [--output DIR]\n");
            return 2;
        }
    }
    FILE *file = bench_open(&options, "frame.csv",
                            "scene,lanes,cones,culling,threads,ratio_to_scalar,"
                            "evaluations_per_pixel,flips,rule,components,ratio_of_sums,"
                            "ns_per_pixel,own_flips");
    const int equal = frame_race(&options, file);
    fclose(file);
    frame_cones(&options);
    return equal ? 0 : 1;
}
