/* SPDX-License-Identifier: MIT
 *
 * Row Q20: intervals of rays in spheres and boxes against the same in double: never narrower than
 * the true one, edges, rims and grazing rays included, and no wider than bound.h says. */
#include <spheretrace/bound.h>
#include <spheretrace/trace.h>

#include "check.h"

#include <math.h>

typedef struct interval {
    double entry, exit; /* none: entry > exit */
} interval;

typedef struct sample {
    spt_bound bound;
    float origin[3], direction[3];
} sample;

static double largest(const float v[3]) {
    return fmax(fabs((double)v[0]), fmax(fabs((double)v[1]), fabs((double)v[2])));
}

static double length_of(const float v[3]) {
    const double x = (double)v[0], y = (double)v[1], z = (double)v[2];
    return sqrt(x * x + y * y + z * z);
}

/* ---- The reference -------------------------------------------------------------------------- */

static const interval outside = {1, 0}, everywhere = {-HUGE_VAL, HUGE_VAL};

static interval true_box(const sample *self, double grown) {
    interval inside = everywhere;
    for (int axis = 0; axis < 3; ++axis) {
        const double o = (double)self->origin[axis], d = (double)self->direction[axis];
        const double low = (double)self->bound.low[axis] - grown;
        const double high = (double)self->bound.high[axis] + grown;
        if (d == 0.0) {
            if (o < low || o > high) return outside;
            continue;
        }
        const double a = (low - o) / d, b = (high - o) / d;
        inside.entry = fmax(inside.entry, fmin(a, b));
        inside.exit = fmin(inside.exit, fmax(a, b));
    }
    return inside;
}

static interval true_sphere(const sample *self, double grown) {
    double square = 0, along = 0, apart = 0;
    double offset[3];
    const double radius = (double)self->bound.radius + grown;
    for (int axis = 0; axis < 3; ++axis) {
        const double d = (double)self->direction[axis];
        offset[axis] = (double)self->origin[axis] - (double)self->bound.center[axis];
        square += d * d;
        along += d * offset[axis];
    }
    const double closest = -along / square;
    for (int axis = 0; axis < 3; ++axis) {
        const double side = offset[axis] + closest * (double)self->direction[axis];
        apart += side * side;
    }
    if (apart > radius * radius) return outside;
    const double half = sqrt((radius * radius - apart) / square);
    const interval inside = {closest - half, closest + half};
    return inside;
}

static interval true_interval(const sample *self, double grown) {
    return self->bound.kind == SPT_BOUND_BOX ? true_box(self, grown) : true_sphere(self, grown);
}

/* ---- Samples -------------------------------------------------------------------------------- */

static double magnitude(double decades) {
    return pow(10, check_uniform(-decades, decades));
}

static int chance(unsigned of) {
    return check_random() % of == 0;
}

/* A volume of any size somewhere; of boxes some are flat, to a plate, a line or a point. */
static void make_bound(sample *self, double scale, double target[3]) {
    float c[3], low[3], high[3];
    const double radius = check_uniform(0.01, 1) * scale * pow(10, check_uniform(-4, 0));
    for (int axis = 0; axis < 3; ++axis) {
        c[axis] = (float)(check_uniform(-1, 1) * scale);
        low[axis] = (float)((double)c[axis] - radius);
        high[axis] = chance(6) ? low[axis] : (float)((double)c[axis] + radius);
    }
    if (chance(2)) {
        self->bound = spt_bound_box(low[0], low[1], low[2], high[0], high[1], high[2]);
        /* A corner, an edge, a face or the middle. */
        for (int axis = 0; axis < 3; ++axis) {
            const double part = chance(3) ? check_uniform(0, 1) : (double)(check_random() & 1);
            target[axis] = (double)low[axis] * (1 - part) + (double)high[axis] * part;
        }
        return;
    }
    self->bound = spt_bound_sphere(c[0], c[1], c[2], (float)radius);
    const float normal[3] = {(float)check_uniform(-1, 1), (float)check_uniform(-1, 1),
                             (float)check_uniform(-1, 1)};
    for (int axis = 0; axis < 3; ++axis) {
        target[axis] = (double)c[axis] + (double)normal[axis] / length_of(normal) * radius;
    }
    /* Half of the rays are tangents there: what the direction has of the normal is taken off. */
    if (chance(2)) return;
    double part = 0;
    for (int axis = 0; axis < 3; ++axis) {
        part += (double)self->direction[axis] * (double)normal[axis];
    }
    part /= length_of(normal) * length_of(normal);
    for (int axis = 0; axis < 3; ++axis) {
        self->direction[axis] =
            (float)((double)self->direction[axis] - part * (double)normal[axis]);
    }
}

/* A ray through a point of the volume's surface, from near or from far, of any length. */
static void make_sample(sample *self) {
    const double scale = magnitude(8), unit = magnitude(6), far = magnitude(4) * scale;
    double target[3];
    for (int axis = 0; axis < 3; ++axis) {
        self->direction[axis] = (float)(check_uniform(-1, 1) * (chance(5) ? 1e-6 : 1));
    }
    if (chance(4)) self->direction[check_random() % 3] = 0;
    make_bound(self, scale, target);
    if (largest(self->direction) < 1e-7) self->direction[0] = 1;
    for (int axis = 0; axis < 3; ++axis) {
        self->origin[axis] = (float)(target[axis] - (double)self->direction[axis] * far);
        self->direction[axis] = (float)((double)self->direction[axis] * unit);
    }
}

static double extent_of(const spt_bound *bound) {
    return bound->kind == SPT_BOUND_BOX ? fmax(largest(bound->low), largest(bound->high))
                                        : largest(bound->center) + (double)bound->radius;
}

/* ---- Tests ---------------------------------------------------------------------------------- */

enum { samples = 300000 };

static void Q20_never_narrower_than_true(void) {
    int touched = 0;
    for (int i = 0; i < samples; ++i) {
        sample self;
        float entry, exit;
        make_sample(&self);
        interval true_one = true_interval(&self, 0);
        true_one.entry = fmax(true_one.entry, 0);
        if (true_one.entry > true_one.exit) continue;
        ++touched;
        CHECK(spt_bound_interval(&self.bound, self.origin, self.direction, 0, (float)INFINITY,
                                 &entry, &exit) == SPT_OK);
        CHECK_SAY((double)entry <= true_one.entry && true_one.exit <= (double)exit,
                  "sample %d, kind %u: [%.9g, %.9g] for [%.12g, %.12g]", i,
                  (unsigned)self.bound.kind, (double)entry, (double)exit, true_one.entry,
                  true_one.exit);
    }
    CHECK(touched > samples / 4);
}

/* A box's faces move out by 2^-22 (|o| + extent), a sphere's radius by 2^-22 (|o| + |o - c|), and
 * both ends by the floor at t. The library's own rounding is less than that, or the interval would
 * not be safe: so it lies in the exact interval of a volume grown by twice as much. */
static void Q20_no_wider_than_documented(void) {
    for (int i = 0; i < samples; ++i) {
        sample self;
        float entry, exit;
        make_sample(&self);
        const double reach = largest(self.origin), extent = extent_of(&self.bound);
        const double unit = length_of(self.direction);
        double other = extent;
        if (self.bound.kind == SPT_BOUND_SPHERE) {
            double square = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const double d = (double)self.origin[axis] - (double)self.bound.center[axis];
                square += d * d;
            }
            other = sqrt(square);
        }
        interval widest = true_interval(&self, 2 * 0x1p-22 * (reach + other));
        const double still = 2 * 0x1p-22 * (reach + extent) / unit;
        widest.entry -= still + 2 * 0x1p-22 * fabs(widest.entry);
        widest.exit += still + 2 * 0x1p-22 * fabs(widest.exit);
        CHECK(spt_bound_interval(&self.bound, self.origin, self.direction, 0, (float)INFINITY,
                                 &entry, &exit) == SPT_OK);
        if (widest.entry > widest.exit || widest.exit < 0) {
            CHECK_SAY(entry > exit, "sample %d, kind %u: [%.9g, %.9g] for none", i,
                      (unsigned)self.bound.kind, (double)entry, (double)exit);
        } else if (entry <= exit) {
            CHECK_SAY((double)entry >= widest.entry && (double)exit <= widest.exit,
                      "sample %d, kind %u: [%.9g, %.9g] for [%.12g, %.12g]", i,
                      (unsigned)self.bound.kind, (double)entry, (double)exit, widest.entry,
                      widest.exit);
        }
    }
}

/* The interval is cut with the ray's own. */
static void Q20_cut_with_the_ray(void) {
    const spt_bound bound = spt_bound_box(-1, -1, 9, 1, 1, 11);
    const float origin[3] = {0, 0, 0}, direction[3] = {0, 0, 1};
    float entry, exit;
    CHECK(spt_bound_interval(&bound, origin, direction, 9.5f, 10.5f, &entry, &exit) == SPT_OK);
    CHECK(check_same_bits(entry, 9.5f) && check_same_bits(exit, 10.5f));
    CHECK(spt_bound_interval(&bound, origin, direction, 12, 20, &entry, &exit) == SPT_OK);
    CHECK(check_same_bits(entry, (float)INFINITY) && check_same_bits(exit, (float)-INFINITY));
    CHECK(spt_bound_interval(&bound, origin, direction, 0, 8, &entry, &exit) == SPT_OK);
    CHECK(check_same_bits(entry, (float)INFINITY) && check_same_bits(exit, (float)-INFINITY));
}

/* The exact distance to the square -1 <= x, y <= 1 at z = 10. */
static float plate_distance(void *user, float x, float y, float z) {
    const float a = fabsf(x) - 1, b = fabsf(y) - 1, c = fabsf(z - 10);
    const float p = a > 0 ? a : 0, q = b > 0 ? b : 0;
    (void)user;
    return sqrtf(p * p + q * q + c * c);
}

/* A ray to the rim x = 1, from some distance and slope; half of them askew. Whether it meets the
 * plate in double, which of every such ray is decided by its last bits. */
static int rim_ray(int i, spt_ray *ray) {
    const int skew = i & 1;
    const float dx = (float)check_uniform(-0.5, 0.5);
    const float dy = skew ? (float)check_uniform(-0.5, 0.5) : 0.0f;
    const float oz = (float)check_uniform(0, 5);
    const double t = 10 - (double)oz, y = skew ? check_uniform(-1, 1) : 0;
    const float ox = (float)(1 - t * (double)dx), oy = (float)(y - t * (double)dy);
    const spt_ray made = {{ox, oy, oz}, 0, {dx, dy, 1}, (float)INFINITY};
    *ray = made;
    return (double)ox + t * (double)dx <= 1 && fabs((double)oy + t * (double)dy) <= 1;
}

static void Q20_a_plate_in_its_own_bound(void) {
    enum { rays = 40000 };
    const spt_bound bound = spt_bound_box(-1, -1, 10, 1, 1, 10);
    const spt_settings settings = spt_settings_default();
    spt_field field = spt_field_default();
    int meet = 0, lost = 0;
    field.point = plate_distance;
    field.bound = &bound;
    for (int i = 0; i < rays; ++i) {
        spt_ray ray;
        spt_hit hit;
        if (!rim_ray(i, &ray)) continue;
        const spt_rays view = spt_rays_of(&ray);
        const spt_hits hits = spt_hits_of(&hit);
        CHECK(spt_trace(&field, &settings, 1, &view, &hits, NULL) == SPT_OK);
        ++meet;
        lost += hit.outcome != SPT_HIT;
    }
    CHECK(meet > rays / 4);
    CHECK_SAY(lost == 0, "%d of %d lost", lost, meet);
}

void suite_bounds(void) {
    RUN(Q20_never_narrower_than_true);
    RUN(Q20_no_wider_than_documented);
    RUN(Q20_cut_with_the_ray);
    RUN(Q20_a_plate_in_its_own_bound);
}
