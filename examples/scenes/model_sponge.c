/* SPDX-License-Identifier: MIT
 *
 * A sponge: a lump with holes in a field, folded all around by mirrors (Szécsi et al. 2016, Fig.
 * 10). Its caves are dark: for ambient occlusion. */
#include "model_nature.h"

#include <spheretrace/shapes.h>

#include <math.h>

enum { SPONGE_HOLES = 10, SPONGE_MIRRORS = 7, SPONGE_KINDS = 4, SPONGE_POINTS = 512 };

/* What the mirrors leave of a sponge: a piece of its rind with holes, which are capsules that lead
 * inwards. World units. */
typedef struct sponge_piece {
    spt_point middle; /* of the lump, a ball */
    float radius;
    spt_point mouth[SPONGE_HOLES], inward[SPONGE_HOLES];
    float depth[SPONGE_HOLES], size[SPONGE_HOLES];
    float soft; /* how far the rims of holes are rounded */
} sponge_piece;

SPT_SHAPE spt_real sponge_hole(const sponge_piece *piece, int i, spt_point p) {
    const spt_point q = spt_translate(p, piece->mouth[i]);
    const spt_real in = spt_clamp(spt_dot(q, piece->inward[i]), 0, piece->depth[i]);
    return spt_length_3(q.x - in * piece->inward[i].x, q.y - in * piece->inward[i].y,
                        q.z - in * piece->inward[i].z) -
           piece->size[i];
}

SPT_SHAPE spt_real sponge_distance(const sponge_piece *piece, spt_point p) {
    spt_real least = sponge_hole(piece, 0, p);
    SPT_UNROLL
    for (int i = 1; i < SPONGE_HOLES; ++i) least = spt_union(least, sponge_hole(piece, i, p));
    const spt_real lump = spt_sphere(spt_translate(p, piece->middle), piece->radius);
    return spt_smooth_difference(lump, least, piece->soft);
}

static void sponge_batch(void *user, size_t n, const float *restrict x, const float *restrict y,
                         const float *restrict z, float *restrict distance) {
    const sponge_piece piece = *(const sponge_piece *)user;
    for (size_t i = 0; i < n; ++i) {
        distance[i] = sponge_distance(&piece, spt_point_of(x[i], y[i], z[i]));
    }
}

/* Differences along the diagonals of a cube (four of its corners), a thousandth of its radius. */
static void sponge_gradient(void *user, size_t n, const float *restrict x, const float *restrict y,
                            const float *restrict z, float *restrict gradient_x,
                            float *restrict gradient_y, float *restrict gradient_z) {
    const sponge_piece piece = *(const sponge_piece *)user;
    const float h = 0.001f * piece.radius;
    for (size_t i = 0; i < n; ++i) {
        const float a = sponge_distance(&piece, spt_point_of(x[i] + h, y[i] + h, z[i] + h));
        const float b = sponge_distance(&piece, spt_point_of(x[i] + h, y[i] - h, z[i] - h));
        const float c = sponge_distance(&piece, spt_point_of(x[i] - h, y[i] + h, z[i] - h));
        const float d = sponge_distance(&piece, spt_point_of(x[i] - h, y[i] - h, z[i] + h));
        gradient_x[i] = (a + b) - (c + d);
        gradient_y[i] = (a + c) - (b + d);
        gradient_z[i] = (a + d) - (b + c);
    }
}

/* Points all over a sponge, as the kernel below the mirrors so far sees them. */
typedef struct sponge_points {
    double at[SPONGE_POINTS][3], mean[3];
} sponge_points;

static void sponge_mean(sponge_points *points) {
    for (int k = 0; k < 3; ++k) {
        points->mean[k] = 0;
        for (int i = 0; i < SPONGE_POINTS; ++i) points->mean[k] += points->at[i][k] / SPONGE_POINTS;
    }
}

/* The variance of the points along a unit vector. */
static double sponge_spread(const sponge_points *points, const double along[3]) {
    double spread = 0;
    for (int i = 0; i < SPONGE_POINTS; ++i) {
        const double off = model_dot(points->at[i], along) - model_dot(points->mean, along);
        spread += off * off / SPONGE_POINTS;
    }
    return spread;
}

/* A mirror that halves what the mirrors outside it have left: of some random planes through the
 * mean of the points, nearly along the way out from the middle, the one across which they spread
 * most. So the pieces are of about one size and shape, and no two mirrors are alike. */
static spt_mirror sponge_halve(sponge_points *points, double middle[3], uint32_t *state) {
    double best[3] = {1, 0, 0}, most = -1, out[3];
    sponge_mean(points);
    for (int k = 0; k < 3; ++k) out[k] = points->mean[k] - middle[k];
    const double length = sqrt(model_dot(out, out));
    for (int trial = 0; trial < 12; ++trial) {
        double normal[3];
        sketch_direction(state, normal);
        const double outward = length > 0.3 ? 0.9 * model_dot(normal, out) / (length * length) : 0;
        for (int k = 0; k < 3; ++k) normal[k] -= outward * out[k];
        model_unit(normal);
        const double spread = sponge_spread(points, normal);
        if (spread < most) continue;
        most = spread;
        for (int k = 0; k < 3; ++k) best[k] = normal[k];
    }
    model_sketch one;
    const spt_kernel nothing = spt_kernel_empty();
    sketch_begin(&one, &nothing);
    sketch_double(&one, points->mean, best, NULL);
    sketch_fold(&one, 0, middle);
    for (int i = 0; i < SPONGE_POINTS; ++i) sketch_fold(&one, 0, points->at[i]);
    return one.mirrors[0];
}

/* Holes in the rind, each at the one of some random points that is farthest from the others. */
static void sponge_holes(const sponge_points *points, const double middle[3], double scale,
                         uint32_t *state, sponge_piece *piece) {
    static const double sizes[SPONGE_HOLES] = {0.125, 0.09, 0.08, 0.07, 0.055,
                                               0.05,  0.04, 0.04, 0.03, 0.03};
    for (int hole = 0; hole < SPONGE_HOLES; ++hole) {
        double farthest = -1e30, best[3] = {0, 1, 0};
        for (int trial = 0; trial < 12; ++trial) {
            const int i = (int)model_random(state, 0, SPONGE_POINTS);
            double out[3], nearest = 1e30;
            for (int k = 0; k < 3; ++k) out[k] = points->at[i][k] - middle[k];
            model_unit(out);
            for (int other = 0; other < hole; ++other) {
                const spt_point in = piece->inward[other];
                const double way[3] = {out[0] + (double)in.x, out[1] + (double)in.y,
                                       out[2] + (double)in.z};
                const double between = sqrt(model_dot(way, way)) - sizes[other];
                nearest = between < nearest ? between : nearest;
            }
            if (nearest <= farthest) continue;
            farthest = nearest;
            for (int k = 0; k < 3; ++k) best[k] = out[k];
        }
        piece->mouth[hole] =
            spt_point_of((float)(middle[0] + scale * best[0]), (float)(middle[1] + scale * best[1]),
                         (float)(middle[2] + scale * best[2]));
        piece->inward[hole] = spt_point_of((float)-best[0], (float)-best[1], (float)-best[2]);
        piece->size[hole] = (float)(scale * sizes[hole]);
        piece->depth[hole] = (float)(scale * (0.08 + 3 * sizes[hole]));
    }
}

model_component *model_add_sponge(model_world *world, const model_place *place, int which) {
    static sponge_piece pieces[SPONGE_KINDS]; /* of fixed content: each is only ever one sponge's */
    sponge_piece *const piece = &pieces[which];
    spt_mirror mirrors[SPONGE_MIRRORS];
    sponge_points points;
    uint32_t state = which % 2 == 0 ? 4 : 6;
    double middle[3];
    for (int k = 0; k < 3; ++k) middle[k] = place->position[k];
    for (int i = 0; i < SPONGE_POINTS; ++i) {
        sketch_direction(&state, points.at[i]);
        for (int k = 0; k < 3; ++k) {
            points.at[i][k] = middle[k] + place->scale * points.at[i][k];
        }
    }
    for (int i = SPONGE_MIRRORS; i-- > 0;) mirrors[i] = sponge_halve(&points, middle, &state);
    sponge_holes(&points, middle, place->scale, &state, piece);
    piece->middle = spt_point_of((float)middle[0], (float)middle[1], (float)middle[2]);
    piece->radius = (float)place->scale;
    piece->soft = (float)(0.03 * place->scale);

    spt_field field = spt_field_default();
    field.batch = sponge_batch;
    field.gradient = sponge_gradient;
    field.user = piece;
    spt_kernel kernels[SPONGE_MIRRORS + 1];
    kernels[0] = spt_kernel_field(&field);
    for (int i = 1; i <= SPONGE_MIRRORS; ++i) kernels[i] = spt_kernel_empty();
    const spt_bound bound =
        spt_bound_sphere((float)place->position[0], (float)place->position[1],
                         (float)place->position[2], (float)(1.5 * place->scale));
    spt_krs_model described = spt_krs_model_default();
    described.levels = SPONGE_MIRRORS;
    described.kernels = kernels;
    described.mirrors = mirrors;
    described.bound = &bound;
    described.smooth = (float)(0.02 * place->scale);
    return model_add_krs(world, &described, MODEL_SPONGE);
}

static int build(model_world *world, int variant) {
    const model_place place = {{0, 0.85, 0}, 1, 0}, other = {{1.7, 0.3, 0.5}, 0.5, 0};
    const model_place bed = {{0, 0, 0}, 1, 0};
    (void)variant;
    model_begin(world);
    if (model_add_seabed(world, &bed) == NULL || model_add_sponge(world, &place, 0) == NULL ||
        model_add_sponge(world, &other, 1) == NULL) {
        return 0;
    }
    return model_finish(world);
}

const model model_sponge = {.name = "sponge",
                            .description = "a sponge full of holes",
                            .eye = {-1.3, 2.6, 5.4},
                            .target = {0.45, 0.7, 0},
                            .field_of_view = 45,
                            .t_max = 40,
                            .haze = 16,
                            .under_water = 1,
                            .build = build};
