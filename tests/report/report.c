/* SPDX-License-Identifier: MIT
 *
 * What the parts of the report share: scenes and rules, random numbers, memory, quantiles. */
#include "report.h"

#include <math.h>
#include <stdlib.h>

const char *const report_scenes[] = {"sphere",       "box",           "plane",      "thin_torus",
                                     "hollow_box",   "village_boxes", "slabs",      "smooth_union",
                                     "bumpy_ball",   "mandelbulb",    "primitives", "village",
                                     "dodecahedron", "krs_tree_16",   "city",       "jewel"};
const int report_scene_count = sizeof report_scenes / sizeof report_scenes[0];

const char *const report_rule[report_rules] = {"basic",        "relaxed",  "enhanced",
                                               "auto_relaxed", "adaptive", "convex"};

/* splitmix64: any seed will do, also small ones. */
uint32_t report_bits(report_random *random) {
    uint64_t x = random->state += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return (uint32_t)(x >> 32);
}

double report_uniform(report_random *random, double low, double high) {
    return low + (high - low) * (report_bits(random) / 4294967296.0);
}

void report_expect(int holds, const char *what) {
    if (holds) return;
    fprintf(stderr, "report: %s\n", what);
    exit(1);
}

void *report_allocate(size_t size) {
    void *const memory = calloc(size != 0 ? size : 1, 1);
    report_expect(memory != NULL, "out of memory");
    return memory;
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double report_quantile(double *values, size_t count, double share) {
    report_expect(count > 0, "a quantile of nothing");
    qsort(values, count, sizeof *values, ascending);
    const size_t place = (size_t)floor(share * (double)count);
    return values[place < count ? place : count - 1];
}
