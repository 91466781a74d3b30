/* SPDX-License-Identifier: MIT
 *
 * The measurements of Keinert et al. 2014, section 4, on our scenes: what over-relaxation and its
 * successors save in ray casting, in glass and in path tracing, what the optimisation for convex
 * bodies saves, and what rays cost that begin on surfaces.
 *     keinert_bench [--quick] [--only PART] [--output DIR]
 * --quick: smaller pictures and fewer rounds. PART: cast, frames, glass, paths or secondary. Fails
 * where results differ that must not; a ratio that is not reached is printed and no failure. */
#include "keinert_bench.h"

#include <string.h>

typedef struct bench_part {
    const char *name;
    int (*run)(const bench_options *options, FILE *file);
} bench_part;

static int secondary(const bench_options *options, FILE *file) {
    (void)file;
    return keinert_secondary(options);
}

static const bench_part parts[] = {{"cast", keinert_cast},
                                   {"frames", keinert_frames},
                                   {"glass", keinert_glass},
                                   {"paths", keinert_paths},
                                   {"secondary", secondary}};
enum { PARTS = sizeof parts / sizeof parts[0] };

static int is_part(const char *name) {
    for (int part = 0; part < PARTS; ++part) {
        if (strcmp(parts[part].name, name) == 0) return 1;
    }
    return 0;
}

int main(int argc, char **argv) {
    bench_options options = {1280, 720, 0, 0, 15, 0.005, "."};
    const char *only = NULL;
    int agreed = 1;
    for (int i = 1; i < argc; ++i) {
        if (strcmp(argv[i], "--quick") == 0) {
            options.width = 640;
            options.height = 384;
            options.rounds = 5;
            options.slice_seconds = 0.002;
        } else if (strcmp(argv[i], "--output") == 0 && i + 1 < argc) {
            options.output = argv[++i];
        } else if (strcmp(argv[i], "--only") == 0 && i + 1 < argc && is_part(argv[i + 1])) {
            only = argv[++i];
        } else {
            fprintf(stderr, "usage: keinert_bench [--quick] [--only cast|frames|glass|paths|"
                            "secondary] [--output DIR]\n");
            return 2;
        }
    }
    FILE *file = bench_open(&options, "keinert.csv",
                            "measure,scene,contender,against,rays,evaluations,evaluations_per_ray,"
                            "evaluation_ratio,time_ratio,library_time_ratio,paper_ratio,ns_per_ray,"
                            "error,error_of_against,"
                            "error_of,lost,late,passed,undecided,evaluations_inside_per_ray");
    for (int part = 0; part < PARTS; ++part) {
        if (only != NULL && strcmp(parts[part].name, only) != 0) continue;
        agreed &= parts[part].run(&options, file);
        fflush(stdout);
    }
    fclose(file);
    return agreed ? 0 : 1;
}
