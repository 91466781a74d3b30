/* SPDX-License-Identifier: MIT
 *
 * The library against its peers, one thread on both sides: all scenes against Mesa's llvmpipe, with
 * the shader that this library writes, and the village against Embree 3.
 *     peers_bench [--quick] [--output DIR]
 * --quick: smaller pictures and fewer rounds. A peer that is not there is skipped (with
 * SPT_REQUIRE=1 that fails). Fails where hits differ by more than they may; a target that is not
 * reached is printed and no failure. */
#include <stdlib.h>
#include <string.h>

#include "peers_race.h"

void peers_report(FILE *table, const peers_result *result) {
    fprintf(table, "%s,%s,%s,%s,%d,%zu,%.3f,%.3f,%.3f,%.1f\n", result->peer, result->scene,
            result->peer_way, result->our_way, result->lanes, result->rays,
            result->peer_nanoseconds, result->our_nanoseconds, result->ratio, result->target);
}

typedef int race_fn(const bench_options *options, FILE *table);

int main(int argc, char **argv) {
    /* llvmpipe first, while there is one thread only. */
    static race_fn *const races[] = {
#ifdef PEERS_LLVMPIPE
        peers_race_llvmpipe,
#endif
#ifdef PEERS_EMBREE
        peers_race_embree,
#endif
        NULL};
    const char *const require = getenv("SPT_REQUIRE");
    bench_options options = {1280, 720, 320, 192, 15, 0.02, "."};
    int different = 0, missing = 0;
    for (int i = 1; i < argc; ++i) {
        if (strcmp(argv[i], "--quick") == 0) {
            const bench_options quick = {640, 384, 160, 128, 5, 0.005, options.output};
            options = quick;
        } else if (strcmp(argv[i], "--output") == 0 && i + 1 < argc) {
            options.output = argv[++i];
        } else {
            fprintf(stderr, "usage: peers_bench [--quick] [--output DIR]\n");
            return 2;
        }
    }
#ifndef PEERS_LLVMPIPE
    printf("skipped: llvmpipe, built without the headers of EGL and OpenGL\n");
    missing = 1;
#endif
#ifndef PEERS_EMBREE
    printf("skipped: Embree, built without its headers\n");
    missing = 1;
#endif
    FILE *const table = bench_open(&options, "peers.csv",
                                   "peer,scene,peer_way,our_way,lanes,rays,peer_ns_per_ray,"
                                   "our_ns_per_ray,ratio,target");
    for (int i = 0; races[i] != NULL; ++i) {
        const int found = races[i](&options, table);
        missing |= found < 0;
        different += found > 0 ? found : 0;
    }
    fclose(table);
    return different > 0 || (missing && require != NULL && strcmp(require, "1") == 0);
}
