/* SPDX-License-Identifier: MIT
 *
 * powers.csv: scenes scaled by powers of two, and rays whose directions are, with all that is
 * measured in the same unit. Every result must be the scaled bits of the unscaled one.
 * powers_summary.csv: that over all powers. */
#include <math.h>
#include <string.h>

#include "../csv.h"
#include "../report.h"

enum { most_power = 60, rays_each = 500 };

/* A ball, a box, a ring and a floor; or the box alone, which is convex. */
typedef struct scaled_scene {
    double scale;
    int box_only;
} scaled_scene;

static double length(double x, double y, double z) {
    return sqrt(x * x + y * y + z * z);
}

static double box_distance(double x, double y, double z) {
    const double outside = length(fmax(x, 0), fmax(y, 0), fmax(z, 0));
    return outside + fmin(fmax(x, fmax(y, z)), 0);
}

/* In double, whose range holds the squares of all these scales: only + - * sqrt and comparisons, so
 * that scaling by a power of two commutes with every rounding. */
static void scene_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                        float *distance) {
    const scaled_scene *const shown = user;
    const double s = shown->scale;
    for (size_t i = 0; i < n; ++i) {
        const double px = (double)x[i], py = (double)y[i], pz = (double)z[i];
        const double box = box_distance(fabs(px - 0.75 * s) - 0.5 * s, fabs(py) - 0.375 * s,
                                        fabs(pz - 3.5 * s) - 0.25 * s);
        const double ball = length(px + 0.875 * s, py - 0.125 * s, pz - 4 * s) - 0.625 * s;
        const double ring =
            length(length(px, py - 0.5 * s, 0) - 1.5 * s, pz - 5 * s, 0) - 0.125 * s;
        const double all = fmin(fmin(box, ball), fmin(ring, py + 0.75 * s));
        distance[i] = (float)(shown->box_only ? box : all);
    }
}

static void draw_rays(int seed, spt_ray *rays) {
    report_random random = {(uint64_t)seed};
    for (int i = 0; i < rays_each; ++i) {
        double way[3];
        way[0] = report_uniform(&random, -0.5, 0.5);
        way[1] = report_uniform(&random, -0.4, 0.4);
        way[2] = 1;
        const double size = length(way[0], way[1], way[2]);
        for (int axis = 0; axis < 3; ++axis) {
            rays[i].origin[axis] = (float)report_uniform(&random, -0.25, 0.25);
            rays[i].direction[axis] = (float)(way[axis] / size);
        }
        rays[i].t_min = (float)report_uniform(&random, 0, 0.25);
        rays[i].t_max = 8;
    }
}

static float shifted(float number, int power) {
    return (float)ldexp((double)number, power); /* exact: nothing here under- or overflows */
}

typedef struct scaling {
    int scene, direction; /* powers: of all lengths, and of the direction alone */
} scaling;

static void trace(const char *rule, int box_only, scaling by, const spt_ray *unscaled,
                  spt_hit *hits) {
    scaled_scene shown = {ldexp(1, by.scene), box_only};
    spt_field field = spt_field_default();
    spt_settings settings = spt_settings_default();
    spt_ray rays[rays_each];
    field.batch = scene_batch;
    field.user = &shown;
    field.flags = box_only ? (uint32_t)SPT_FIELD_CONVEX : 0;
    settings.method = bench_method(rule);
    settings.epsilon = shifted(settings.epsilon, by.scene);
    for (int i = 0; i < rays_each; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            rays[i].origin[axis] = shifted(unscaled[i].origin[axis], by.scene);
            rays[i].direction[axis] = shifted(unscaled[i].direction[axis], by.direction);
        }
        rays[i].t_min = shifted(unscaled[i].t_min, by.scene - by.direction);
        rays[i].t_max = shifted(unscaled[i].t_max, by.scene - by.direction);
    }
    const spt_rays traced = spt_rays_of(rays);
    const spt_hits results = spt_hits_of(hits);
    report_expect(spt_trace(&field, &settings, rays_each, &traced, &results, NULL) == SPT_OK,
                  "a scaled scene is refused");
    for (int i = 0; i < rays_each; ++i) {
        hits[i].t = shifted(hits[i].t, by.direction - by.scene);
        hits[i].candidate_t = shifted(hits[i].candidate_t, by.direction - by.scene);
        hits[i].residual = shifted(hits[i].residual, -by.scene);
    }
}

static int different(const spt_hit *ones, const spt_hit *others) {
    int count = 0;
    for (int i = 0; i < rays_each; ++i) count += memcmp(&ones[i], &others[i], sizeof *ones) != 0;
    return count;
}

static int step(const report_options *options) {
    return options->quick ? 12 : 1;
}

static int cells(const report_options *options) {
    return 2 * most_power / step(options) + 1;
}

static void measure(const report_options *options, int cell, FILE *rows) {
    static const scaling none = {0, 0};
    const int power = cell * step(options) - most_power;
    const scaling ways[] = {{power, 0}, {0, power}};
    spt_ray rays[rays_each];
    spt_hit expected[rays_each], hits[rays_each];
    for (int rule = 0; rule < report_rules; ++rule) {
        const int convex_only = bench_method(report_rule[rule]) == spt_convex();
        int count = 0, unlike = 0;
        for (int box_only = convex_only; box_only < 2; ++box_only) {
            draw_rays(1 + box_only, rays);
            trace(report_rule[rule], box_only, none, rays, expected);
            for (int way = 0; way < 2; ++way) {
                trace(report_rule[rule], box_only, ways[way], rays, hits);
                count += rays_each;
                unlike += different(expected, hits);
            }
        }
        fprintf(rows, "%d,%s,%d,%d\n", power, report_rule[rule], count, unlike);
    }
}

const report_part report_powers = {"powers", "exponent,method,rays,different", cells, measure, 0,
                                   {1, 0.1}};

/* least_exponent, largest_exponent: between which nothing differs. */
static void measure_summary(const report_options *options, int rule, FILE *rows) {
    csv_table *const table = csv_open(options->output, "powers");
    double count = 0, unlike = 0, least = -most_power, largest = most_power;
    for (int row = -1; (row = csv_next(table, row, "method=%s", report_rule[rule])) >= 0;) {
        const double exponent = csv_number(table, row, "exponent");
        const double here = csv_number(table, row, "different");
        count += csv_number(table, row, "rays");
        unlike += here;
        if (here > 0 && exponent < 0) least = fmax(least, exponent + step(options));
        if (here > 0 && exponent > 0) largest = fmin(largest, exponent - step(options));
    }
    fprintf(rows, "%s,%.9g,%.9g,%.9g,%.9g\n", report_rule[rule], count, unlike, least, largest);
    csv_close(table);
}

static int each_rule(const report_options *options) {
    (void)options;
    return report_rules;
}

const report_part report_powers_summary = {"powers_summary",
                                           "method,rays,different,least_exponent,largest_exponent",
                                           each_rule,
                                           measure_summary,
                                           0,
                                           {0.1, 0.1}};
