/* SPDX-License-Identifier: MIT
 *
 * The reference and the library against closed-form hits of simple shapes, for every step rule at
 * every width: ordinary, grazing, inside, far, tiny and huge. Left out: scenes of several bodies,
 * see test_truth.c. */
#include "analytic.h"
#include "harness.h"
#include "../check.h"

#include <math.h>

enum { rays_a_case = 64, budget = 4000 };

typedef enum ray_class { GENERIC, GRAZING, INSIDE, FAR, TINY, ENORMOUS, CLASSES } ray_class;

static const char *const class_names[CLASSES] = {"generic", "grazing", "inside",
                                                 "far",     "tiny",    "enormous"};

/* A shape, its rays and what is true of them. */
typedef struct oracle_case {
    analytic_shape shape;
    int convex, inside;
    spt_settings settings;
    spt_ray rays[rays_a_case];
    analytic_hit truth[rays_a_case];
} oracle_case;

/* 4u (|o| + |d| t + R), u = 2^-24: what float positions and values let a hit be off (measured 2.21u
 * of that sum): each of the three coordinates o + t d rounds twice, the value once. */
static double rounding(const oracle_case *c, const spt_ray *ray, double t) {
    const double x = (double)ray->origin[0], y = (double)ray->origin[1], z = (double)ray->origin[2];
    const double reach = sqrt(x * x + y * y + z * z) + t * oracle_length(ray);
    return 0x1p-22 * (reach + analytic_size(&c->shape));
}

static void random_in_ball(double p[3], double radius) {
    double square;
    do {
        square = 0;
        for (int axis = 0; axis < 3; ++axis) {
            p[axis] = check_uniform(-1, 1);
            square += p[axis] * p[axis];
        }
    } while (square > 1 || square < 1e-4);
    for (int axis = 0; axis < 3; ++axis) p[axis] *= radius;
}

/* The ray from o through target, with a direction of the given length. */
static spt_ray aim(const double o[3], const double target[3], double length) {
    spt_ray ray = {{0, 0, 0}, 0, {0, 0, 0}, 0};
    double d[3], apart = 0;
    for (int axis = 0; axis < 3; ++axis) {
        d[axis] = target[axis] - o[axis];
        apart += d[axis] * d[axis];
    }
    apart = sqrt(apart);
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = (float)o[axis];
        ray.direction[axis] = (float)(d[axis] / apart * length);
    }
    ray.t_max = (float)(3 * apart / length);
    return ray;
}

static int hits(const oracle_case *c, const double o[3], const double target[3]) {
    const spt_ray ray = aim(o, target, 1);
    const reference_ray exact = reference_ray_of(&ray);
    return analytic_trace(&c->shape, &exact, 0).t < HUGE_VAL;
}

/* Moves the target so that the ray from o nearly touches: between a hit and a miss, off by a part
 * of 10^-1.5 to 10^-6 of the size, inwards or outwards. */
static void graze(const oracle_case *c, const double o[3], double target[3]) {
    const double size = analytic_size(&c->shape), off = pow(10, -check_uniform(1.5, 6));
    const double sign = check_random() % 2 != 0 ? 1 : -1;
    double hit[3], miss[3];
    do random_in_ball(hit, size);
    while (!hits(c, o, hit));
    do {
        random_in_ball(miss, 3 * size);
        for (int axis = 0; axis < 3; ++axis) miss[axis] += o[axis];
    } while (hits(c, o, miss));
    for (int i = 0; i < 40; ++i) {
        for (int axis = 0; axis < 3; ++axis) target[axis] = (hit[axis] + miss[axis]) / 2;
        for (int axis = 0; axis < 3; ++axis) {
            *(hits(c, o, target) ? &hit[axis] : &miss[axis]) = target[axis];
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        target[axis] += off * (check_uniform(-size, size) - sign * target[axis]);
    }
}

static spt_ray draw_ray(const oracle_case *c, ray_class class) {
    const double size = analytic_size(&c->shape), length = pow(2, check_uniform(-3, 3));
    const double away = class == FAR ? pow(10, check_uniform(2, 6)) : size * check_uniform(3, 20);
    double o[3], target[3], radius = 0;
    if (class == INSIDE) {
        do random_in_ball(o, size);
        while (analytic_distance(&c->shape, o) > -0.05 * size);
        random_in_ball(target, 3 * size);
        return aim(o, target, length);
    }
    random_in_ball(o, 1);
    radius = sqrt(o[0] * o[0] + o[1] * o[1] + o[2] * o[2]);
    for (int axis = 0; axis < 3; ++axis) o[axis] *= away / radius;
    if (c->shape.kind == ANALYTIC_PLANE) o[1] = fabs(o[1]);
    random_in_ball(target, size);
    if (class == GRAZING) graze(c, o, target);
    return aim(o, target, length);
}

static analytic_hit true_hit(const oracle_case *c, const spt_ray *ray) {
    const reference_ray exact = reference_ray_of(ray);
    const double t = fmin(analytic_trace(&c->shape, &exact, 0).t, exact.t_max);
    const double depth = oracle_tolerance(&c->settings, ray, t) + 2 * rounding(c, ray, t);
    return analytic_trace(&c->shape, &exact, depth);
}

static oracle_case draw_case(analytic_kind kind, ray_class class, float epsilon) {
    oracle_case c;
    double scale = 1;
    if (class == FAR) scale = pow(10, check_uniform(-1, 2));
    if (class == TINY) scale = 1e-6;
    if (class == ENORMOUS) scale = 1e6;
    c.shape = analytic_sample(kind, scale);
    if (kind == ANALYTIC_PLANE) scale = 1;
    c.convex = kind != ANALYTIC_TORUS;
    c.inside = class == INSIDE;
    c.settings = spt_settings_default();
    c.settings.budget = budget;
    c.settings.epsilon = class == TINY ? 1e-6f * epsilon : epsilon;
    c.settings.pixel_radius = class == GENERIC ? 1e-5f : 0.0f;
    c.settings.size = (float)analytic_size(&c.shape);
    for (int i = 0; i < rays_a_case; ++i) {
        c.rays[i] = draw_ray(&c, class);
        c.truth[i] = true_hit(&c, &c.rays[i]);
    }
    return c;
}

/* What may be said of a ray. Where it never gets deeper than the tolerance and twice the rounding
 * either answer is right; else the surface must be found, and before the ray is that deep. A hit is
 * within tolerance and rounding of the surface wherever it is. */
static void judge(const oracle_case *c, int index, int outcome, double t) {
    const spt_ray *ray = &c->rays[index];
    const analytic_hit *truth = &c->truth[index];
    const int clear = truth->deep < HUGE_VAL && truth->cosine > 0.1;
    CHECK_SAY(outcome == SPT_HIT || outcome == SPT_MISS || outcome == SPT_LIMIT, "%d", outcome);
    if (outcome == SPT_MISS) {
        CHECK_SAY(!(truth->deep < HUGE_VAL), "ray %d missed, true hit at %.9g", index, truth->t);
        return;
    }
    CHECK_SAY(t <= truth->deep, "ray %d at %.9g, through at %.9g", index, t, truth->deep);
    CHECK_SAY(t >= 0 && t <= (double)ray->t_max, "ray %d at %.9g", index, t);
    CHECK_SAY(outcome == SPT_HIT || !clear, "ray %d undecided, true hit at %.9g", index, truth->t);
    if (outcome == SPT_HIT) {
        const double bound = oracle_tolerance(&c->settings, ray, t) + rounding(c, ray, t);
        const double length = oracle_length(ray);
        double p[3], distance;
        for (int axis = 0; axis < 3; ++axis) {
            p[axis] = (double)ray->origin[axis] + t * (double)ray->direction[axis];
        }
        distance = analytic_distance(&c->shape, p);
        CHECK_SAY(fabs(distance) <= bound, "ray %d hit %.9g at distance %.3g of %.3g", index, t,
                  distance, bound);
        if (c->convex && !c->inside && truth->t < HUGE_VAL) {
            /* a convex body lies behind the tangent plane of the true hit */
            CHECK_SAY((truth->t - t) * length * truth->cosine <= bound,
                      "ray %d hit %.9g for %.9g, cosine %.3g, bound %.3g", index, t, truth->t,
                      truth->cosine, bound);
        }
    }
}

static void each_case(ray_class class, void (*check)(const oracle_case *)) {
    for (int kind = 0; kind < ANALYTIC_KINDS; ++kind) {
        const oracle_case c = draw_case((analytic_kind)kind, class, 1e-4f);
        int clear = 0;
        for (int i = 0; i < rays_a_case; ++i) clear += c.truth[i].deep < HUGE_VAL;
        check_context("shape %d, %s rays", kind, class_names[class]);
        CHECK_SAY(clear >= rays_a_case / 16, "only %d rays hit", clear);
        check(&c);
    }
}

static void judge_reference(const oracle_case *c) {
    const reference_field field = analytic_field(&c->shape);
    for (int rule = 0; rule < (c->convex ? REFERENCE_RULES : REFERENCE_CONVEX); ++rule) {
        const reference_settings settings =
            reference_settings_of(&c->settings, (reference_rule)rule);
        check_context("reference, rule %d, shape %d", rule, c->shape.kind);
        for (int i = 0; i < rays_a_case; ++i) {
            const reference_ray ray = reference_ray_of(&c->rays[i]);
            const reference_hit hit = reference_trace(&field, &settings, &ray);
            judge(c, i, (int)hit.outcome, hit.t);
            CHECK((hit.flags & SPT_FLAG_STEEP) == 0);
            CHECK(((hit.flags & SPT_FLAG_INSIDE) != 0) == c->inside);
        }
    }
}

static void judge_library(const oracle_case *c) {
    const reference_field exact = analytic_field(&c->shape);
    const spt_field field = oracle_field(&exact, c->convex);
    oracle_run run = {0, 0, NULL, REFERENCE_BASIC};
    while (oracle_next(&run, c->convex)) {
        spt_settings settings = c->settings;
        spt_hit hit[rays_a_case];
        settings.method = run.method;
        settings.max_lanes = run.lanes;
        oracle_trace(&field, &settings, rays_a_case, c->rays, hit);
        for (int i = 0; i < rays_a_case; ++i) {
            judge(c, i, hit[i].outcome, (double)hit[i].t);
            CHECK_SAY((hit[i].flags & SPT_FLAG_STEEP) == 0, "ray %d", i);
            CHECK_SAY(((hit[i].flags & SPT_FLAG_INSIDE) != 0) == c->inside, "ray %d", i);
        }
    }
}

/* A ray that starts beside a capsule or cylinder of radius 25 or 40 and sinks to it along its side
 * over 20 to 100: f falls by less at a step than it is off by rounding. */
static spt_ray sinking_ray(const oracle_case *c) {
    const double height = pow(10, check_uniform(-3, -1)), turn = check_uniform(0, 6.28);
    const double sinking = height / check_uniform(20, 100);
    const double out[3] = {cos(turn), 0, sin(turn)};
    double o[3], target[3];
    for (int axis = 0; axis < 3; ++axis) {
        o[axis] = (c->shape.radius + height) * out[axis];
        target[axis] = o[axis] - sinking * out[axis];
    }
    o[1] = -70;
    target[1] = -69;
    return aim(o, target, 1);
}

/* Rounding must not make the convex rule take such a ray for one that rises, and misses. */
static void oracle_library_sinking(void) {
    for (int round = 0; round < 40; ++round) {
        const analytic_kind kind = round % 2 == 0 ? ANALYTIC_CAPSULE : ANALYTIC_CYLINDER;
        oracle_case c = draw_case(kind, FAR, 1e-9f);
        const reference_field exact = analytic_field(&c.shape);
        const spt_field field = oracle_field(&exact, 1);
        spt_hit hit[rays_a_case];
        c.shape = analytic_sample(kind, 100);
        c.settings.size = (float)analytic_size(&c.shape);
        c.settings.method = spt_convex();
        for (int i = 0; i < rays_a_case; ++i) {
            c.rays[i] = sinking_ray(&c);
            c.rays[i].t_max = 1000;
            c.truth[i] = true_hit(&c, &c.rays[i]);
        }
        check_context("shape %d, convex rule, round %d", kind, round);
        oracle_trace(&field, &c.settings, rays_a_case, c.rays, hit);
        for (int i = 0; i < rays_a_case; ++i) judge(&c, i, hit[i].outcome, (double)hit[i].t);
    }
}

static void oracle_reference_all(void) {
    for (int class = 0; class < CLASSES; ++class) each_case((ray_class) class, judge_reference);
}

static void oracle_library_generic(void) {
    each_case(GENERIC, judge_library);
}

static void oracle_library_grazing(void) {
    each_case(GRAZING, judge_library);
}

static void oracle_library_inside(void) {
    each_case(INSIDE, judge_library);
}

static void oracle_library_far(void) {
    each_case(FAR, judge_library);
}

static void oracle_library_tiny(void) {
    each_case(TINY, judge_library);
}

static void oracle_library_enormous(void) {
    each_case(ENORMOUS, judge_library);
}

void suite_oracle(void) {
    RUN(oracle_reference_all);
    RUN(oracle_library_generic);
    RUN(oracle_library_grazing);
    RUN(oracle_library_sinking);
    RUN(oracle_library_inside);
    RUN(oracle_library_far);
    RUN(oracle_library_tiny);
    RUN(oracle_library_enormous);
}
