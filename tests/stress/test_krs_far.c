/* SPDX-License-Identifier: MIT
 *
 * Rows R1 and A3 for the evaluators of krs.h and mobius.h: models of every size that is legal, asked
 * at points of every magnitude. What comes back is a number or an infinity, callers' fields are asked
 * at finite points only, and both forms of callback agree to the bit. */
#include "krs_world.h"
#include "stress.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { points = SPT_BATCH, magnitudes = 20 };

static krs_world world;
static float drawn[3][points];
static float memory[8][points + 16];

static float *column(int i) {
    return memory[i] + (64 - (uintptr_t)memory[i] % 64) % 64 / sizeof(float);
}

static void draw(int magnitude) {
    static const float sizes[magnitudes] = {1e-45f, 1e-40f, 1e-38f, 1e-30f, 1e-15f, 1e-6f,  1.0f,
                                            1e3f,   1e6f,   1e10f,  1e15f,  1e18f,  1e19f,  1e20f,
                                            1e25f,  1e30f,  1e35f,  1e38f,  2e38f,  FLT_MAX};
    for (int i = 0; i < points; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const float share = (float)check_uniform(-1.0, 1.0);
            const int flat = i % 4 != 0 && (i >> 2 * axis & 3) == 0;
            const int extreme = (i >> 1) % 5 == 0;
            drawn[axis][i] = sizes[magnitude] * (flat ? 0.0f : extreme ? 1.0f : share);
        }
    }
}

static void fill(void) {
    for (int axis = 0; axis < 3; ++axis) memcpy(column(axis), drawn[axis], sizeof drawn[axis]);
}

static void check_faults(const char *what) {
    for (int i = 0; i < krs_witnesses; ++i) {
        krs_witness *const witness = &world.witness[i];
        CHECK_SAY(witness->faults == 0, "%s: %u faults, the first at %g %g %g", what,
                  (unsigned)witness->faults, (double)witness->fault[0], (double)witness->fault[1],
                  (double)witness->fault[2]);
        witness->faults = 0;
    }
}

static void ask(const char *name, const spt_field *field) {
    size_t no_numbers = 0, differ = 0;
    fill();
    field->batch(field->user, points, column(0), column(1), column(2), column(3));
    for (int i = 0; i < points; ++i) no_numbers += isnan(column(3)[i]) != 0;
    CHECK_SAY(no_numbers == 0, "%s: %u are no numbers", name, (unsigned)no_numbers);
    for (int i = 0; i < points && field->point != NULL; ++i) {
        const float alone = field->point(field->user, drawn[0][i], drawn[1][i], drawn[2][i]);
        differ += krs_bits(alone) != krs_bits(column(3)[i]);
    }
    CHECK_SAY(differ == 0, "%s: %u differ alone", name, (unsigned)differ);
    check_faults(name);
    if (field->gradient == NULL) return;
    fill();
    field->gradient(field->user, points, column(0), column(1), column(2), column(4), column(5),
                    column(6));
    check_faults(name);
}

static void feel(const spt_probe *probe) {
    static const float sizes[] = {FLT_MIN, 1e-10f, 1.0f, 1e10f, 1e18f, FLT_MAX};
    for (int size = 0; size < 6; ++size) {
        size_t no_numbers = 0, differ = 0;
        fill();
        for (int i = 0; i < points; ++i) column(4)[i] = sizes[size];
        probe->batch(probe->user, points, column(0), column(1), column(2), column(4), column(3));
        for (int i = 0; i < points; ++i) no_numbers += isnan(column(3)[i]) != 0;
        for (int i = 0; i < points && probe->point != NULL; ++i) {
            const float alone =
                probe->point(probe->user, drawn[0][i], drawn[1][i], drawn[2][i], sizes[size]);
            differ += krs_bits(alone) != krs_bits(column(3)[i]);
        }
        CHECK_SAY(no_numbers == 0, "probe: %u are no numbers", (unsigned)no_numbers);
        CHECK_SAY(differ == 0, "probe: %u differ alone", (unsigned)differ);
        check_faults("probe");
    }
}

static void ask_all(void) {
    for (int magnitude = 0; magnitude < magnitudes; ++magnitude) {
        draw(magnitude);
        for (int door = 0; door <= KRS_DOOR_UNMAPPED; ++door) {
            ask(krs_table[door].name, &world.fields[door]);
        }
        feel(&world.probes[0]);
    }
}

static void R1ka_krs_points_of_any_size(void) {
    for (int variant = 0; variant < krs_variants; ++variant) {
        check_context("variant %d", variant);
        CHECK(krs_world_make(&world, KRS_GRADIENT, stress_widths[variant]));
        CHECK(krs_world_vary(&world, variant));
        ask_all();
    }
}

/* Bodies and mirrors, all sized alike, of the least and the largest that krs.h permits. */
static void scale_model(float by) {
    for (int i = 0; i <= krs_levels; ++i) {
        spt_kernel *const kernel = &world.kernels[i];
        for (int axis = 0; axis < 3; ++axis) {
            if (kernel->kind != SPT_KERNEL_HALF_SPACE) kernel->a[axis] *= by;
            kernel->b[axis] *= by;
            if (kernel->kind == SPT_KERNEL_CAPSULE) kernel->control[axis] *= by;
        }
        kernel->radius *= by;
        kernel->width *= by;
        if (kernel->kind == SPT_KERNEL_FIELD) *kernel = spt_kernel_sphere(-by, by, 0.0f, by);
    }
    for (int i = 0; i < krs_levels; ++i) world.mirrors[i].offset *= by;
    world.model.smooth = 0.0f;
}

static void R1kb_krs_models_of_any_size(void) {
    static const float sizes[] = {3e-14f, 1e-6f, 1e6f, 1e12f, 2.5e17f};
    for (int size = 0; size < 5; ++size) {
        check_context("size %g", (double)sizes[size]);
        CHECK(krs_world_make(&world, KRS_GRADIENT, 0));
        scale_model(sizes[size]);
        CHECK(spt_krs_build(&world.model, &world.krs) == SPT_OK);
        world.fields[KRS_DOOR_SEQUENCE] = spt_krs_field(&world.krs);
        for (int magnitude = 0; magnitude < magnitudes; ++magnitude) {
            draw(magnitude);
            ask("spt_krs_field", &world.fields[KRS_DOOR_SEQUENCE]);
        }
    }
}

/* What is far and what is small within one model. */
static void R1kc_krs_sizes_mixed(void) {
    static const float sizes[] = {1e-15f, 1e-6f, 1.0f, 1e6f, 1e17f};
    for (int case_of = 0; case_of < 25; ++case_of) {
        const float far = sizes[case_of / 5], small = sizes[case_of % 5];
        check_context("offset %g, size %g", (double)far, (double)small);
        CHECK(krs_world_make(&world, 0, 0));
        scale_model(small);
        for (int i = 0; i < krs_levels; ++i) world.mirrors[i].offset = far;
        /* Arcs of no length are straight, but leaves have tips that do not coincide. */
        if (small < 1e-14f) world.kernels[2] = spt_kernel_sphere(far, far, far, small);
        CHECK(spt_krs_build(&world.model, &world.krs) == SPT_OK);
        world.fields[KRS_DOOR_SEQUENCE] = spt_krs_field(&world.krs);
        for (int magnitude = 0; magnitude < magnitudes; ++magnitude) {
            draw(magnitude);
            ask("spt_krs_field", &world.fields[KRS_DOOR_SEQUENCE]);
        }
    }
}

/* The pole of a map, points beside it, and on the way to it. */
static void R1kd_krs_poles(void) {
    CHECK(krs_world_make(&world, KRS_GRADIENT, 0));
    for (int map = 0; map < 2; ++map) {
        const spt_built_map *const built = map == 0 ? &world.conformal.map : &world.moekrs.maps[0];
        for (int i = 0; i < points; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                const float away = i < 16 ? 0.0f : ldexpf((float)check_uniform(-1, 1), -i / 2);
                drawn[axis][i] = built->pole[axis] + away;
            }
        }
        ask("spt_conformal_field", &world.fields[KRS_DOOR_CONFORMAL]);
        ask("spt_moekrs_field", &world.fields[KRS_DOOR_MAPPED]);
        feel(&world.probes[0]);
    }
}

/* Any finite bits. */
static void R1ke_krs_points_of_any_bits(void) {
    CHECK(krs_world_make(&world, KRS_GRADIENT, 0));
    for (int round = 0; round < 20; ++round) {
        for (int i = 0; i < points; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                const float any = krs_float(check_random() ^ check_random() << 16);
                drawn[axis][i] = fabsf(any) <= FLT_MAX ? any : 0.0f;
            }
        }
        for (int door = 0; door <= KRS_DOOR_UNMAPPED; ++door) {
            ask(krs_table[door].name, &world.fields[door]);
        }
        feel(&world.probes[0]);
    }
}

/* A body that a chain of maps made too small to see is passed by rays that pass it by 1, at any
 * scale: where points do not fit into kernel space, that is no reason to be near. */
static void R1kf_krs_scales_that_vanish(void) {
    static const double scales[] = {0.1, 0.25, 0.4, 0.5};
    static const spt_bound around = {
        .struct_size = sizeof(spt_bound), .kind = SPT_BOUND_SPHERE, .radius = 50.0f};
    static spt_mobius maps[SPT_KRS_LEVELS];
    static spt_kernel kernels[SPT_KRS_LEVELS + 1];
    for (int i = 0; i < 4 * 11; ++i) {
        spt_moekrs_model model = spt_moekrs_model_default();
        spt_ray ray = {{-10, 1, 0}, 0, {1, 0, 0}, 20};
        const spt_rays rays = spt_rays_of(&ray);
        spt_hit hit;
        const spt_hits hits = spt_hits_of(&hit);
        const spt_settings settings = spt_settings_default();
        model.levels = (uint32_t)(4 + i / 4 * 6);
        for (uint32_t level = 0; level < model.levels; ++level) {
            CHECK(spt_mobius_dilation(scales[i % 4], &maps[level]) == SPT_OK);
            kernels[level + 1] = spt_kernel_empty();
        }
        kernels[0] = spt_kernel_sphere(-3, 0, 0, 1);
        model.kernels = kernels;
        model.maps = maps;
        model.bound = &around;
        if (spt_moekrs_build(&model, &world.moekrs) != SPT_OK) continue; /* refused is right, too */
        const spt_field field = spt_moekrs_field(&world.moekrs);
        CHECK(spt_trace(&field, &settings, 1, &rays, &hits, NULL) == SPT_OK);
        CHECK_SAY(hit.outcome == SPT_MISS, "%u levels of %g: outcome %d at %g",
                  (unsigned)model.levels, scales[i % 4], (int)hit.outcome, (double)hit.t);
    }
}

void suite_krs_far(void) {
    RUN(R1ka_krs_points_of_any_size);
    RUN(R1kb_krs_models_of_any_size);
    RUN(R1kc_krs_sizes_mixed);
    RUN(R1kd_krs_poles);
    RUN(R1ke_krs_points_of_any_bits);
    RUN(R1kf_krs_scales_that_vanish);
}
