/* SPDX-License-Identifier: MIT
 *
 * spt_moekrs_build(): what it refuses, the bound that it finds, models of no levels and of 64,
 * kernels that are fields. */
#include "moekrs_ask.h"
#include "moekrs_model.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <string.h>

enum { per_model = 64 };

static moekrs_model model;
static spt_moekrs built;
static moekrs_query queries[per_model], others[per_model];

/* ---- Refusals ------------------------------------------------------------------------------ */

static spt_kernel kernels[SPT_KRS_LEVELS + 2];
static spt_mobius maps[SPT_KRS_LEVELS + 1];

static spt_moekrs_model fair_model(void) {
    spt_moekrs_model fair = spt_moekrs_model_default();
    const double by[3] = {-2, 0, 0};
    for (int i = 0; i < SPT_KRS_LEVELS + 2; ++i) kernels[i] = spt_kernel_empty();
    kernels[0] = spt_kernel_sphere(-1, 0, 0, 0.5f);
    for (int i = 0; i < SPT_KRS_LEVELS + 1; ++i) {
        CHECK(spt_mobius_translation(by, &maps[i]) == SPT_OK);
    }
    fair.levels = 3;
    fair.kernels = kernels;
    fair.maps = maps;
    return fair;
}

static void refused(const spt_moekrs_model *description, int line) {
    static spt_moekrs before;
    check_context("case of line %d", line);
    memset(&built, 0x5a, sizeof built);
    memset(&before, 0x5a, sizeof before);
    CHECK(spt_moekrs_build(description, &built) == SPT_BAD_ARGUMENT);
    CHECK(memcmp(&before, &built, sizeof built) == 0);
}

#define REFUSED(...) \
    do { \
        spt_moekrs_model bad = fair_model(); \
        __VA_ARGS__; \
        refused(&bad, __LINE__); \
    } while (0)

static spt_quaternion of(double real, double x, double y, double z) {
    return spt_quaternion_of(real, x, y, z);
}

static spt_mobius matrix(spt_quaternion a, spt_quaternion b, spt_quaternion c, spt_quaternion d) {
    spt_mobius map;
    map.a = a;
    map.b = b;
    map.c = c;
    map.d = d;
    map.orientation = 1;
    return map;
}

/* M3: matrices that are no maps of space. */
static void M3_moekrs_refuses_maps(void) {
    const spt_quaternion zero = of(0, 0, 0, 0), one = of(1, 0, 0, 0), two = of(2, 0, 0, 0);
    const spt_mobius bad_maps[] = {
        matrix(one, two, one, two),               /* singular */
        matrix(zero, zero, zero, zero),           /* nothing */
        matrix(one, of(0.5, 0, 0, 0), zero, one), /* moves by a real number */
        matrix(of(0.3, 1, 0.2, -2), of(1, 0.1, 3, 0), of(-1, 2, 0.7, 0.4), of(0.2, -0.6, 1, 1)),
        matrix(of((double)NAN, 0, 0, 0), zero, zero, one), /* not finite */
        matrix(one, of(0, HUGE_VAL, 0, 0), zero, one),
        matrix(of(1e30, 0, 0, 0), zero, zero, of(1e-30, 0, 0, 0))}; /* no float32 */
    for (size_t i = 0; i < sizeof bad_maps / sizeof bad_maps[0]; ++i) {
        for (int at = 0; at < 3; ++at) REFUSED(maps[at] = bad_maps[i]);
    }
    REFUSED(maps[1].orientation = 0);
    REFUSED(maps[1].orientation = -1); /* it keeps the orientation */
}

static void moekrs_build_refuses(void) {
    const spt_bound no_bound = spt_bound_sphere(0, 0, 0, -1);
    spt_field no_field = spt_field_default();
    spt_moekrs_model fair = fair_model();
    CHECK(spt_moekrs_build(&fair, &built) == SPT_OK);
    CHECK(spt_moekrs_build(&fair, NULL) == SPT_BAD_ARGUMENT);
    CHECK(spt_moekrs_build(NULL, &built) == SPT_BAD_ARGUMENT);
    REFUSED(bad.struct_size = 0);
    REFUSED(bad.levels = SPT_KRS_LEVELS + 1);
    REFUSED(bad.levels = UINT32_MAX);
    REFUSED(bad.kernels = NULL);
    REFUSED(bad.maps = NULL);
    REFUSED(bad.bound = &no_bound);
    REFUSED(bad.smooth = -1);
    REFUSED(bad.smooth = NAN);
    REFUSED(bad.smooth = INFINITY);
    REFUSED(bad.max_lanes = 3);
    REFUSED(kernels[2].kind = SPT_KERNEL_KINDS);
    REFUSED(kernels[3] = spt_kernel_sphere(0, NAN, 0, 1));
    REFUSED(kernels[0] = spt_kernel_sphere(0, 0, 0, -1));
    REFUSED(kernels[1] = spt_kernel_half_space(0, 0, 0, 1));
    REFUSED(kernels[1] = spt_kernel_field(NULL));
    REFUSED(kernels[1] = spt_kernel_field(&no_field));
    fair = fair_model();
    fair.levels = SPT_KRS_LEVELS;
    CHECK(spt_moekrs_build(&fair, &built) == SPT_OK && built.levels == SPT_KRS_LEVELS);
    fair.levels = 0;
    fair.maps = NULL;
    CHECK(spt_moekrs_build(&fair, &built) == SPT_OK && built.levels == 0);
}

/* ---- Bounds -------------------------------------------------------------------------------- */

/* All instances are in it, none reaches beyond by more than nothing; a model with an instance that
 * has no end has none. */
static void moekrs_bound_holds_all(void) {
    int bounded = 0, models = 0;
    for (int draw = 0; draw < 300; ++draw) {
        const moekrs_flavour flavour = (moekrs_flavour)(draw % MOEKRS_CUT);
        int endless = 0;
        spt_field field;
        spt_probe probe;
        check_context("draw %d", draw);
        moekrs_draw(&model, (int)(check_random() % (moekrs_levels + 1)), flavour,
                    draw % 3 == 0 ? check_random() : 0);
        moekrs_built(&model, 0, &built);
        for (int k = 0; k < model.count; ++k) {
            const moekrs_instance *one = &model.instance[k];
            double square = 0;
            endless |= one->region.kind != SPT_REGION_BALL;
            if (!built.bounded) continue;
            CHECK(built.bound.kind == SPT_BOUND_SPHERE);
            for (int axis = 0; axis < 3; ++axis) {
                const double d = one->center[axis] - (double)built.bound.center[axis];
                square += d * d;
            }
            CHECK_SAY(sqrt(square) + one->radius <= (double)built.bound.radius, "%.9g of %.9g",
                      sqrt(square) + one->radius, (double)built.bound.radius);
        }
        CHECK(!endless || !built.bounded);
        CHECK(flavour != MOEKRS_SIMILAR || built.bounded);
        field = spt_moekrs_field(&built);
        probe = spt_moekrs_probe(&built);
        CHECK((field.bound != NULL) == (built.bounded != 0));
        CHECK((probe.bound != NULL) == (built.bounded != 0));
        models += !endless;
        bounded += built.bounded != 0;
    }
    CHECK_SAY(bounded > models / 4, "%d of %d", bounded, models);
}

/* The caller's bound is taken instead. */
static void moekrs_bound_given(void) {
    const spt_bound given = spt_bound_sphere(1, 2, 3, 40);
    spt_moekrs_model description = fair_model();
    spt_field field;
    description.bound = &given;
    CHECK(spt_moekrs_build(&description, &built) == SPT_OK && built.bounded);
    field = spt_moekrs_field(&built);
    CHECK(field.bound != NULL && field.bound->kind == SPT_BOUND_SPHERE);
    CHECK(check_same_bits(field.bound->radius, 40) && check_same_bits(field.bound->center[1], 2));
    CHECK(field.bound != &given);
}

/* Bit i of straddles where L_i may reach beyond x = 0: never of models that were made apart by
 * similarities with one kernel, always where a kernel crosses it. */
static void moekrs_straddles(void) {
    spt_moekrs_model description = fair_model();
    CHECK(spt_moekrs_build(&description, &built) == SPT_OK);
    /* L_0 reaches to -1/2; L_1 = -2 + [-3/2, 3/2] does, too; L_2 = -2 + [-7/2, 7/2] crosses. */
    CHECK_SAY(built.straddles == 4, "%llx", (unsigned long long)built.straddles);
    kernels[0] = spt_kernel_sphere(-0.25f, 0, 0, 0.5f);
    CHECK(spt_moekrs_build(&description, &built) == SPT_OK);
    CHECK_SAY((built.straddles & 1) == 1, "%llx", (unsigned long long)built.straddles);
    description.unmirrored = 1; /* then it is no matter */
    CHECK(spt_moekrs_build(&description, &built) == SPT_OK);
    CHECK_SAY((built.straddles & 1) == 0, "%llx", (unsigned long long)built.straddles);
}

/* ---- 0 levels, fields ---------------------------------------------------------------------- */

static void doubled_sphere(void *user, size_t n, const float *x, const float *y, const float *z,
                           float *distance) {
    const spt_kernel *kernel = user;
    for (size_t i = 0; i < n; ++i) {
        const double a = (double)x[i] - (double)kernel->a[0],
                     b = (double)y[i] - (double)kernel->a[1],
                     c = (double)z[i] - (double)kernel->a[2];
        distance[i] = (float)(2 * (sqrt(a * a + b * b + c * c) - (double)kernel->radius));
    }
}

static spt_field doubled_field(spt_kernel *kernel) {
    spt_field field = spt_field_default();
    field.batch = doubled_sphere;
    field.user = kernel;
    field.lipschitz = 2;
    return field;
}

static void draw_points(void) {
    for (int i = 0; i < per_model; ++i) {
        for (int axis = 0; axis < 3; ++axis) queries[i].point[axis] = (float)check_uniform(-3, 3);
        others[i] = queries[i];
    }
}

/* No levels: the kernel itself, to the bit: as the KRS of it, and of a field the value that it
 * gives, divided. */
static void moekrs_of_no_levels(void) {
    const float tip[3] = {-1, 0, 0.25f}, other[3] = {1, 0.5f, 0}, side[3] = {0.25f, 1, 0};
    spt_kernel sphere = spt_kernel_sphere(0.3f, -0.2f, 0.9f, 0.7f);
    const spt_field field = doubled_field(&sphere);
    const spt_kernel all[] = {
        sphere, spt_kernel_half_space(1, 2, 3, 0.5f), spt_kernel_capsule(tip, other, side, 0.125f),
        spt_kernel_leaf(tip, other, side, 0.25f, 0.01f), spt_kernel_field(&field)};
    static spt_krs krs;
    for (int kind = 0; kind < 5; ++kind) {
        for (int width = 0; width < width_count; ++width) {
            spt_moekrs_model description = spt_moekrs_model_default();
            spt_krs_model like = spt_krs_model_default();
            spt_field one, two;
            check_context("kernel %d, %u lanes", kind, widths[width]);
            description.kernels = like.kernels = &all[kind];
            description.max_lanes = like.max_lanes = widths[width];
            CHECK(spt_moekrs_build(&description, &built) == SPT_OK);
            CHECK(spt_krs_build(&like, &krs) == SPT_OK);
            draw_points();
            one = spt_moekrs_field(&built);
            two = spt_krs_field(&krs);
            moekrs_ask_field(&one, 0, per_model, queries);
            moekrs_ask_field(&two, 0, per_model, others);
            for (int i = 0; i < per_model; ++i) {
                CHECK_SAY(check_same_bits(queries[i].answer, others[i].answer), "%.9g for %.9g",
                          (double)queries[i].answer, (double)others[i].answer);
            }
            if (kind != 4) continue;
            moekrs_ask_field(&field, 0, per_model, others);
            for (int i = 0; i < per_model; ++i) {
                CHECK(check_same_bits(queries[i].answer, others[i].answer / 2));
            }
        }
    }
}

/* Every sphere as a field of slope 2 in its ball instead: what it is off by is in the margin of
 * both. Without the balls the model has no end. */
static void moekrs_of_fields(void) {
    for (int draw = 0; draw < 40; ++draw) {
        static spt_kernel spheres[moekrs_levels + 1];
        static spt_field fields[moekrs_levels + 1];
        static spt_bound balls[moekrs_levels + 1];
        spt_field one, two;
        static spt_moekrs of_fields;
        spt_moekrs_model description;
        check_context("draw %d", draw);
        moekrs_draw(&model, draw % (moekrs_levels + 1),
                    draw % 2 == 0 ? MOEKRS_PLAIN : MOEKRS_SIMILAR, 0);
        moekrs_built(&model, 0, &built);
        description = moekrs_description(&model);
        memcpy(spheres, model.kernels, sizeof spheres);
        for (int i = 0; i <= model.levels; ++i) {
            fields[i] = doubled_field(&spheres[i]);
            if (spheres[i].kind == SPT_KERNEL_SPHERE)
                model.kernels[i] = spt_kernel_field(&fields[i]);
        }
        CHECK(spt_moekrs_build(&description, &of_fields) == SPT_OK);
        CHECK(!of_fields.bounded);
        for (int i = 0; i <= model.levels; ++i) {
            const float *const center = spheres[i].a;
            balls[i] = spt_bound_sphere(center[0], center[1], center[2], spheres[i].radius);
            fields[i].bound = &balls[i];
        }
        CHECK(spt_moekrs_build(&description, &of_fields) == SPT_OK);
        CHECK(of_fields.bounded == built.bounded);
        memcpy(model.kernels, spheres, sizeof spheres);
        for (int i = 0; i < per_model; ++i) {
            moekrs_point(&model, queries[i].point);
            others[i] = queries[i];
        }
        one = spt_moekrs_field(&built);
        two = spt_moekrs_field(&of_fields);
        moekrs_ask_field(&one, 0, per_model, queries);
        moekrs_ask_field(&two, 0, per_model, others);
        for (int i = 0; i < per_model; ++i) {
            const moekrs_error error = moekrs_margin(&model, queries[i].point, 0);
            const double f = (double)queries[i].answer, g = (double)others[i].answer;
            CHECK_SAY(fabs(f - g) <= error.absolute + error.relative * fabs(f), "%.9g for %.9g", g,
                      f);
        }
    }
}

/* ---- 64 levels ----------------------------------------------------------------------------- */

/* Way 0: every level is turned a little about x, and each even one is mirrored, 7/16 as large and
 * moved left by 2.25: from L_0 in [-3/2, -1/2] each lies in [-4, -1/2]. Way 1: small turns and
 * moves, no mirrors. 2^64 in one model would overflow squares of coordinates. */
static void chain_of_64(int way, int i, moekrs_chain *chain) {
    const double x[3] = {1, 0, 0}, tilted[3] = {1, 0.25, -0.5}, left[3] = {-2.25, 0, 0},
                 away[3] = {-0.05, 0.03, 0};
    chain->count = 0;
    moekrs_append(chain, MOEKRS_ROTATION, way == 0 ? x : tilted, 0.01 * (i % 7));
    if (way == 0 && i % 2 == 0) {
        moekrs_append(chain, MOEKRS_DILATION, NULL, 0.4375);
        moekrs_append(chain, MOEKRS_TRANSLATION, left, 0);
    } else if (way == 1) {
        moekrs_append(chain, MOEKRS_TRANSLATION, away, 0);
    }
}

/* Algorithm 1 with maps, in long double: similarities keep distances but for their factor. */
static wide folded_64(const moekrs_chain *undone, uint64_t unmirrored, const float point[3]) {
    wide p[3], least = HUGE_VALL, factor = 1;
    for (int axis = 0; axis < 3; ++axis) p[axis] = (wide)point[axis];
    for (int level = SPT_KRS_LEVELS - 1; level >= -1; --level) {
        const spt_kernel *kernel = &kernels[level + 1];
        wide from[3];
        if (level >= 0) {
            moekrs_move(&undone[level], p, p);
            for (int i = 0; i < undone[level].count; ++i) {
                const moekrs_step *step = &undone[level].step[i];
                if (step->kind == MOEKRS_DILATION) factor /= step->number;
            }
        }
        for (int axis = 0; axis < 3; ++axis) from[axis] = p[axis] - (wide)kernel->a[axis];
        least = fminl(least, factor * (moekrs_length(from) - (wide)kernel->radius));
        if (level >= 0 && (unmirrored >> level & 1) == 0) p[0] = -fabsl(p[0]);
    }
    return least;
}

/* Each level rounds its point and its scale by 4 products and sums of numbers that are, seen from
 * the world, at most 8: 64 times 4 times 8 units of rounding. */
static void moekrs_of_64_levels(void) {
    for (int way = 0; way < 2; ++way) {
        static moekrs_chain undone[SPT_KRS_LEVELS];
        spt_moekrs_model description = fair_model();
        spt_field field;
        for (int i = 0; i < SPT_KRS_LEVELS; ++i) {
            moekrs_chain chain;
            chain_of_64(way, i, &chain);
            undone[i] = moekrs_undone(&chain);
            maps[i] = moekrs_library_map(&chain);
            kernels[i + 1] = spt_kernel_sphere(-0.75f, 0.25f * (float)(i % 3) - 0.25f, 0, 0.25f);
        }
        description.levels = SPT_KRS_LEVELS;
        description.unmirrored = way == 0 ? UINT64_C(0xaaaaaaaaaaaaaaaa) : UINT64_MAX;
        CHECK(spt_moekrs_build(&description, &built) == SPT_OK);
        CHECK(built.bounded && built.unmirrored == description.unmirrored);
        CHECK_SAY(built.straddles == 0, "%llx", (unsigned long long)built.straddles);
        draw_points();
        field = spt_moekrs_field(&built);
        moekrs_ask_field(&field, 0, per_model, queries);
        for (int i = 0; i < per_model; ++i) {
            const wide least = folded_64(undone, description.unmirrored, queries[i].point);
            CHECK_SAY(fabs((double)queries[i].answer - (double)least) <= 64 * 4 * 8 * 0x1p-24,
                      "way %d: %.9g for %.9Lg", way, (double)queries[i].answer, least);
        }
    }
}

void suite_moekrs_build(void) {
    RUN(M3_moekrs_refuses_maps);
    RUN(moekrs_build_refuses);
    RUN(moekrs_bound_holds_all);
    RUN(moekrs_bound_given);
    RUN(moekrs_straddles);
    RUN(moekrs_of_no_levels);
    RUN(moekrs_of_fields);
    RUN(moekrs_of_64_levels);
}
