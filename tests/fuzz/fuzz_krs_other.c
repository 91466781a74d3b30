/* SPDX-License-Identifier: MIT
 *
 * The fuzzed calls of krs.h and mobius.h that take no rays: what maps do to points, vectors and
 * regions, and the sampled check of models. */
#include "fuzz_krs.h"

#include <float.h>
#include <math.h>
#include <string.h>

static int is_place(const double p[3]) {
    return fabs(p[0]) <= DBL_MAX && fabs(p[1]) <= DBL_MAX && fabs(p[2]) <= DBL_MAX;
}

static double length(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void check_point(const spt_mobius *map, const double point[3]) {
    static const double normal[3] = {0.48, 0.6, 0.64};
    double image[3], vector[3];
    const int finite = spt_mobius_point(map, point, image);
    FUZZ_CHECK(finite == 0 || finite == 1);
    FUZZ_CHECK(finite ? is_place(image)
                      : image[0] > DBL_MAX && image[1] > DBL_MAX && image[2] > DBL_MAX);
    FUZZ_CHECK(spt_mobius_scale(map, point) >= 0);
    spt_mobius_vector(map, point, normal, vector);
    /* As long as before to a few roundings, or zero at the pole. */
    const double size = length(vector);
    FUZZ_CHECK(!(size > 0) ? size >= 0 : fabs(size - 1) <= 0x1p-40);
}

static void check_exit(const spt_mobius *map, const double point[3]) {
    static const double forth[3] = {0.48, 0.6, 0.64};
    for (int i = 0; i < 5; ++i) {
        const double rho = ldexp(1, 40 * i - 80) - 0x1p-80;
        FUZZ_CHECK(spt_mobius_exit(map, point, forth, rho) >= 0);
    }
}

static int is_region(const spt_region *region) {
    const double size = length(region->center);
    if (!is_place(region->center) || !(fabs(region->radius) <= DBL_MAX)) return 0;
    if (region->kind == SPT_REGION_HALF_SPACE) return fabs(size - 1) <= 1e-6;
    return (region->kind == SPT_REGION_BALL || region->kind == SPT_REGION_OUTSIDE) &&
           region->radius > 0;
}

static void check_region(const spt_mobius *map, spt_region region) {
    static const double forth[3] = {0.48, 0.6, 0.64};
    spt_region image;
    memset(&image, fuzz_krs_fill, sizeof image);
    const spt_region before = image;
    const spt_status status = spt_mobius_region(map, &region, &image);
    FUZZ_CHECK(status == SPT_OK || status == SPT_BAD_ARGUMENT);
    FUZZ_CHECK(status == SPT_OK ? is_region(&image) : memcmp(&before, &image, sizeof image) == 0);
    FUZZ_CHECK(status != SPT_OK || is_region(&region));
    if (status != SPT_OK) return;
    const spt_sphere_coefficients of_image = spt_region_coefficients(&image);
    const spt_sphere_coefficients pulled = spt_mobius_pull_back(map, &of_image);
    double t[2] = {0, 0};
    const int meets = spt_sphere_meets_line(&pulled, region.center, forth, t);
    FUZZ_CHECK(meets >= 0 && meets <= 2);
    FUZZ_CHECK(meets < 2 || t[0] <= t[1]);
}

static void check_maps(const fuzz_krs_case *what) {
    for (uint32_t i = 0; i < what->model.levels && i < 3; ++i) {
        const spt_mobius *const given = &what->maps[i];
        spt_mobius map;
        const spt_status status = spt_mobius_matrix(given->a, given->b, given->c, given->d, &map);
        if (status != SPT_OK) continue; /* no map of space */
        const spt_mobius inverse = spt_mobius_inverse(&map);
        spt_region region = {1 + (what->seed + i) % 3, {0, 0, 0}, 0};
        for (size_t ray = 0; ray < what->call.count && ray < 4; ++ray) {
            for (int axis = 0; axis < 3; ++axis) {
                region.center[axis] = (double)krs_float(what->in[axis][ray]);
            }
            region.radius = (double)krs_float(what->in[KRS_IN_PATH][ray]);
            check_point(&map, region.center);
            check_point(&inverse, region.center);
            if (is_place(region.center)) check_exit(&map, region.center);
            check_region(&map, region);
        }
    }
}

static void check_samples(const fuzz_krs_case *what) {
    enum { samples = 8 };
    static spt_krs krs;
    static spt_krs_faults faults, again;
    if (spt_krs_build(&what->model, &krs) != SPT_OK) return;
    memset(&faults, fuzz_krs_fill, sizeof faults);
    const spt_status status = spt_krs_check(&krs, samples, what->seed, &faults);
    FUZZ_CHECK(status == SPT_OK || status == SPT_UNSUPPORTED);
    if (status != SPT_OK) return;
    FUZZ_CHECK(spt_krs_check(&krs, samples, what->seed, &again) == SPT_OK);
    FUZZ_CHECK(memcmp(&faults, &again, sizeof faults) == 0);
    for (uint32_t level = 0; level < SPT_KRS_LEVELS; ++level) {
        const float *const worst = faults.worst[level];
        FUZZ_CHECK(faults.samples[level] <= samples);
        FUZZ_CHECK(faults.discarded[level] <= faults.samples[level]);
        FUZZ_CHECK(faults.depth[level] >= 0.0f);
        FUZZ_CHECK((faults.depth[level] > 0.0f) == (faults.discarded[level] > 0));
        for (int axis = 0; axis < 3; ++axis) FUZZ_CHECK(fabsf(worst[axis]) <= FLT_MAX);
        if (level < krs.levels) continue;
        FUZZ_CHECK(faults.samples[level] == 0 && faults.discarded[level] == 0);
    }
    FUZZ_CHECK(fuzz_krs_faults(what) == 0);
}

void fuzz_krs_other_calls(const fuzz_krs_case *what) {
    check_maps(what);
    check_samples(what);
}
