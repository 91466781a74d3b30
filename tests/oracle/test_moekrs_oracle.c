/* SPDX-License-Identifier: MIT
 *
 * The oracle of MöKRS against itself: regions by center and radius against images of points, ways
 * to kernels and back, Algorithm 3 mended against instance spheres. Left out: the library, but for
 * the maps that Algorithm 3 needs as matrices. */
#include "moekrs_model.h"
#include "moekrs_printed.h"
#include "../check.h"

#include <math.h>

static moekrs_model model;

static const moekrs_region *any_instance(int *kernel, uint64_t *mirrors) {
    const moekrs_instance *one = &model.instance[check_random() % (uint32_t)model.count];
    *kernel = one->kernel;
    *mirrors = one->mirrors;
    return &one->region;
}

static void draw_any(int draw) {
    const moekrs_flavour flavour = (moekrs_flavour)(draw % MOEKRS_CUT);
    const uint64_t unmirrored = draw % 3 == 0 ? check_random() : 0;
    check_context("draw %d", draw);
    moekrs_draw(&model, 1 + draw % moekrs_levels, flavour, unmirrored);
}

/* A point on a kernel's surface lies on its instance's, one inside inside: to 1e-12 of the size of
 * what it passed, in long double. */
static void moekrs_oracle_instances(void) {
    for (int draw = 0; draw < 60; ++draw) {
        draw_any(draw);
        for (int i = 0; i < 20; ++i) {
            int kernel;
            uint64_t mirrors;
            const moekrs_region *region = any_instance(&kernel, &mirrors);
            const spt_kernel *one = &model.kernels[kernel];
            const wide shrink = i % 2 == 0 ? 1 : 0.875L;
            wide q[3], p[3], back[3], distance, size;
            if (one->kind != SPT_KERNEL_SPHERE) continue;
            for (int axis = 0; axis < 3; ++axis) q[axis] = (wide)check_uniform(-1, 1);
            size = moekrs_length(q);
            for (int axis = 0; axis < 3; ++axis) {
                q[axis] = (wide)one->a[axis] + shrink * (wide)one->radius * q[axis] / size;
            }
            moekrs_to_world(&model, kernel, mirrors, q, p);
            distance = moekrs_region_distance(region, p);
            size = moekrs_length(p) + region->radius;
            CHECK_SAY(i % 2 == 0 ? fabsl(distance) <= 1e-12L * size : distance < 0,
                      "distance %Lg of %Lg", distance, size);
            moekrs_to_kernel(&model, kernel, mirrors, p, back);
            for (int axis = 0; axis < 3; ++axis) {
                CHECK_SAY(fabsl(back[axis] - q[axis]) <= 1e-12L * (1 + moekrs_length(q)),
                          "%Lg for %Lg", back[axis], q[axis]);
            }
        }
    }
}

/* The number of instances, and no two the same. */
static void moekrs_oracle_names(void) {
    for (int levels = 0; levels <= moekrs_levels; ++levels) {
        int expected = 0;
        moekrs_draw(&model, levels, MOEKRS_PLAIN, 0);
        for (int kernel = 0; kernel <= levels; ++kernel) {
            if (model.kernels[kernel].kind != SPT_KERNEL_EMPTY) expected += 1 << (levels - kernel);
        }
        CHECK_SAY(model.count == expected, "%d of %d", model.count, expected);
        for (int i = 0; i < model.count; ++i) {
            const moekrs_instance *one = &model.instance[i];
            CHECK(one->mirrors >> levels == 0);
            CHECK((one->mirrors & ((UINT64_C(1) << one->kernel) - 1)) == 0);
            for (int k = 0; k < i; ++k) {
                CHECK(model.instance[k].kernel != one->kernel ||
                      model.instance[k].mirrors != one->mirrors);
            }
        }
    }
}

/* A ball carried back through the maps is free of the kernels where the ball in the world is free
 * of the instances, unless it turned: Algorithm 3 mended, in double. 1e-9: its coefficients lose
 * what gamma cancels. */
static void moekrs_oracle_probes(void) {
    int turned = 0, probes = 0;
    for (int draw = 0; draw < 150; ++draw) {
        draw_any(draw);
        for (int i = 0; i < 20; ++i) {
            float p[3];
            double center[3], distance, rho;
            int unbounding;
            moekrs_point(&model, p);
            for (int axis = 0; axis < 3; ++axis) center[axis] = (double)p[axis];
            distance = moekrs_distance(&model, p, NULL);
            rho = fabs(distance) * check_uniform(0.1, 2);
            if (fabs(distance - rho) <= 1e-6 * (1 + rho)) continue;
            unbounding = printed_unbounding(&model, PRINTED_MENDED, -1, center, rho);
            ++probes;
            turned += moekrs_turns(&model, p, rho);
            CHECK_SAY(unbounding == (distance >= rho && !moekrs_turns(&model, p, rho)),
                      "levels %d, distance %g, rho %g: %d", model.levels, distance, rho,
                      unbounding);
        }
    }
    CHECK(probes > 2000 && turned > 10 && turned < probes / 2);
}

void suite_moekrs_oracle(void) {
    RUN(moekrs_oracle_instances);
    RUN(moekrs_oracle_names);
    RUN(moekrs_oracle_probes);
}
