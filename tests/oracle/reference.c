/* SPDX-License-Identifier: MIT
 *
 * The reference tracer: Hart's loop with the step rules of Keinert et al. 2014, Bálint & Valasek
 * 2018 and Bán & Valasek 2023, their misprints mended. Read `turn` first: it is the whole loop. */
#include "reference.h"

#include <float.h>
#include <math.h>

typedef struct sample {
    real t;
    real value; /* f as the callback gave it */
    real r;     /* radius of the unbounding sphere in units of t, negative beyond the surface */
} sample;

typedef struct march {
    const reference_field *field;
    const reference_settings *settings;
    const reference_ray *ray;
    real length, origin_size, t_max;
    real side; /* +1 for a start outside, -1 inside */
    sample at; /* the ray is certified free up to here */
    int plain; /* the next step is the plain one: a probe was just rejected */
    int has_pending, has_pair;
    sample pending;    /* the probe that was rejected */
    real step, before; /* the last step and the radius it started from, where has_pair */
    real descent;      /* m: descent of r per unit step, enhanced and adaptive */
    real slope;        /* M: its running mean with the other sign, auto_relaxed */
    reference_hit hit;
} march;

static real magnitude(real a) {
    return a < 0 ? -a : a;
}

static real lesser(real a, real b) {
    return a < b ? a : b;
}

static real greater(real a, real b) {
    return a > b ? a : b;
}

static real largest_of(const real v[3]) {
    return greater(magnitude(v[0]), greater(magnitude(v[1]), magnitude(v[2])));
}

/* The length without overflow or underflow on the way. */
static real length_of(const real v[3]) {
    int exponent;
    double sum = 0;
    (void)frexp((double)largest_of(v), &exponent);
    for (int axis = 0; axis < 3; ++axis) {
        const double scaled = ldexp((double)v[axis], -exponent);
        sum += scaled * scaled;
    }
    return (real)ldexp(sqrt(sum), exponent);
}

static int is_finite(real a) {
    return magnitude(a) <= (real)FLT_MAX;
}

/* Lengths below are in units of t, like r. The floor is that of float32 also where real is double,
 * so that both stop at the same place. */
static real rounding_floor(const march *m, real t) {
    const real ulps = (real)0x1p-22;
    return ulps * (m->origin_size / m->length + t + m->settings->size / m->length);
}

static real tolerance(const march *m, real t) {
    const real cone = m->settings->pixel_radius * (m->ray->path / m->length + t);
    return greater(greater(m->settings->epsilon / m->length, cone), rounding_floor(m, t));
}

static sample evaluate(march *m, real t) {
    sample s;
    real position[3];
    for (int axis = 0; axis < 3; ++axis) {
        position[axis] = m->ray->origin[axis] + t * m->ray->direction[axis];
    }
    s.t = t;
    s.value = m->field->distance(m->field->user, position);
    s.r = m->side * s.value / (m->field->lipschitz * m->length);
    ++m->hit.evaluations;
    return s;
}

/* NaN or -infinity. */
static int is_no_distance(sample s) {
    return !(s.value >= -(real)FLT_MAX);
}

/* Ends the ray; 0 so that `turn` can return it. */
static int finish(march *m, spt_outcome outcome, sample where) {
    const int nowhere = outcome == SPT_MISS || outcome == SPT_BAD_RAY;
    m->hit.outcome = outcome;
    m->hit.t = nowhere ? (real)INFINITY : where.t;
    m->hit.residual = nowhere ? (real)INFINITY : where.value;
    return 0;
}

/* The sample that looks closest to the surface from the eye (Keinert 3.2; no division by t). */
static void note_candidate(march *m) {
    const real seen = m->ray->path / m->length + m->at.t;
    const real ratio = magnitude(m->at.r) / greater(seen, m->settings->epsilon / m->length);
    if (ratio < m->hit.candidate_ratio) {
        m->hit.candidate_ratio = ratio;
        m->hit.candidate_t = m->at.t;
    }
}

/* Whether the spheres of two samples cover the ray between them. Strict, signed and with a margin:
 * spheres that only touch may touch on the surface. */
static int covered(const march *m, sample from, sample to) {
    const real apart = to.t - from.t;
    const real margin = (real)0x1p-22 * apart + rounding_floor(m, to.t);
    return !is_no_distance(to) && to.r >= 0 && from.r + to.r > apart + margin;
}

/* Audits the Lipschitz constant between two successive samples. */
static void audit(march *m, sample from, sample to) {
    const real step = to.t - from.t, change = magnitude(to.r - from.r);
    const real explained = 2 * rounding_floor(m, to.t);
    if (is_finite(change)) {
        const real slope = m->field->lipschitz * (change - explained) / step;
        if (change > (real)1.001 * step + explained) m->hit.flags |= SPT_FLAG_STEEP;
        m->hit.largest_slope = greater(m->hit.largest_slope, slope);
    }
}

/* Makes a verified sample the current one. */
static void accept(march *m, sample next) {
    const real step = next.t - m->at.t, blend = m->settings->slope_blend;
    audit(m, m->at, next);
    m->descent = greater((real)-0.98, lesser((m->at.r - next.r) / step, 1));
    m->slope += blend * ((next.r - m->at.r) / step - m->slope);
    m->before = m->at.r;
    m->step = step;
    m->has_pair = 1;
    m->at = next;
    m->plain = 0;
}

static void reject(march *m, sample probe) {
    const reference_rule rule = m->settings->rule;
    const int remembers =
        rule == REFERENCE_RELAXED || rule == REFERENCE_AUTO_RELAXED || rule == REFERENCE_ADAPTIVE;
    m->has_pending = remembers && probe.r > 0;
    m->pending = probe;
    m->slope = -1;
    m->plain = 1;
    ++m->hit.fallbacks;
}

/* f crossed zero inside its own unbounding sphere, so it is no distance bound there. Finds a root,
 * not certainly the first, by regula falsi and bisection in turn. */
static int close_bracket(march *m, sample outside, sample beyond) {
    m->hit.flags |= SPT_FLAG_STEEP;
    audit(m, outside, beyond);
    for (int round = 0; round < 40; ++round) {
        const real width = beyond.t - outside.t, inset = (real)0.05 * width;
        const real secant = width * outside.r / (outside.r - beyond.r);
        const real inward = round % 2 == 0 ? secant : width / 2;
        sample middle;
        if (width <= tolerance(m, outside.t)) break;
        if (m->hit.evaluations == m->settings->budget) return finish(m, SPT_LIMIT, outside);
        middle = evaluate(m, outside.t + lesser(greater(inward, inset), width - inset));
        if (is_no_distance(middle)) return finish(m, SPT_NONFINITE, middle);
        if (magnitude(middle.r) < tolerance(m, middle.t)) return finish(m, SPT_HIT, middle);
        if (middle.r > 0) {
            outside = middle;
        } else {
            beyond = middle;
        }
    }
    return finish(m, SPT_HIT, outside);
}

/* The step that makes the next sphere touch this one on a plane, its second radius weighted
 * (Bálint & Valasek Equation 1, written so that it does not divide by zero). */
static real planar_step(const march *m) {
    const real second = m->at.r * (1 - m->descent) / (1 + m->descent);
    return m->at.r + m->settings->extrapolation * second;
}

/* Half a rounding floor, the rounding error of one value of f that the secant allows for. */
static real secant_slack(const march *m) {
    return rounding_floor(m, m->at.t) / 2;
}

static real secant_descent(const march *m) {
    return m->before - m->at.r + 2 * secant_slack(m);
}

/* The step that the rule would like, before it is bounded. */
static real wanted_step(const march *m) {
    const real r = m->at.r;
    switch (m->settings->rule) {
    case REFERENCE_RELAXED:
        return m->settings->relaxation * r;
    case REFERENCE_ENHANCED:
        return planar_step(m);
    case REFERENCE_AUTO_RELAXED:
        return r * greater(1, 2 / (1 - lesser(m->slope, (real)0.98)));
    case REFERENCE_ADAPTIVE:
        return lesser(planar_step(m), m->settings->step_cap * r);
    case REFERENCE_CONVEX:
        if (!m->has_pair || m->side < 0) return r;
        return (r - secant_slack(m)) * m->step / secant_descent(m);
    default:
        return r;
    }
}

/* Never shorter than the certified step, never past t_max, never into the sphere of the pending
 * probe, which will be reached for free. */
static real bounded_step(const march *m) {
    const real r = m->at.r, rest = m->t_max - m->at.t;
    real step = m->plain ? r : greater(r, wanted_step(m));
    if (step > rest) step = greater(r, rest);
    if (m->has_pending && m->at.t + step > m->pending.t - m->pending.r) step = r;
    return step;
}

/* One turn of the loop: the ray is certified free up to m->at. 0 when it ended. */
static int turn(march *m) {
    const int convex = m->settings->rule == REFERENCE_CONVEX && m->side > 0;
    const sample at = m->at;
    real step;
    sample next;
    note_candidate(m);
    if (at.r < tolerance(m, at.t)) return finish(m, SPT_HIT, at);
    if (m->has_pending && m->pending.t <= at.t) m->has_pending = 0;
    if (m->has_pending && covered(m, at, m->pending)) { /* Keinert 3.1, "trivial extension" */
        m->has_pending = 0;
        accept(m, m->pending);
        return 1;
    }
    if (!(at.t + at.r <= m->t_max)) return finish(m, SPT_MISS, at);
    if (convex && m->has_pair && !(secant_descent(m) > 0)) return finish(m, SPT_MISS, at);

    step = bounded_step(m);
    if (!(at.t + step > at.t)) return finish(m, SPT_LIMIT, at);
    if (m->hit.evaluations == m->settings->budget) return finish(m, SPT_LIMIT, at);
    next = evaluate(m, lesser(at.t + step, m->t_max));
    if (step > at.r && !convex) { /* a probe: only its overlap makes it count */
        if (!covered(m, at, next)) {
            reject(m, next);
            return 1;
        }
    } else if (is_no_distance(next)) {
        return finish(m, SPT_NONFINITE, next);
    } else if (!(next.r > -tolerance(m, next.t))) {
        return close_bracket(m, at, next);
    }
    accept(m, next);
    return 1;
}

static void note_side(march *m) {
    m->hit.flags = m->at.value < 0 ? SPT_FLAG_INSIDE : 0;
}

/* Steps of one tolerance until the surface on which the ray starts is left behind. 0: ended. */
static int leave_start(march *m) {
    while (magnitude(m->at.r) < tolerance(m, m->at.t)) {
        const real t = m->at.t + tolerance(m, m->at.t);
        if (!(t <= m->t_max)) return finish(m, SPT_MISS, m->at);
        if (m->hit.evaluations == m->settings->budget) return finish(m, SPT_LIMIT, m->at);
        m->at = evaluate(m, t);
        note_side(m);
        if (is_no_distance(m->at)) return finish(m, SPT_NONFINITE, m->at);
    }
    return 1;
}

static int is_bad(const reference_ray *ray) {
    int bad = !is_finite(ray->t_min) || ray->t_min < 0 || ray->t_max != ray->t_max ||
              !is_finite(ray->path) || ray->path < 0 || largest_of(ray->direction) < (real)FLT_MIN;
    for (int axis = 0; axis < 3; ++axis) {
        bad |= !is_finite(ray->origin[axis]) || !is_finite(ray->direction[axis]);
    }
    return bad;
}

/* The farthest t at which every position is a finite float. */
static real reach(const march *m) {
    real t = lesser(m->ray->t_max, (real)(FLT_MAX / 4) / m->length);
    for (int axis = 0; axis < 3; ++axis) {
        const real room = (real)FLT_MAX - magnitude(m->ray->origin[axis]);
        const real d = magnitude(m->ray->direction[axis]);
        if (d > 0) t = lesser(t, room / d);
    }
    return t;
}

/* Up to the first verified sample. 0: the ray ended. */
static int begin(march *m) {
    const sample start = {m->ray->t_min, (real)INFINITY, (real)INFINITY};
    if (is_bad(m->ray)) return finish(m, SPT_BAD_RAY, start);
    m->length = length_of(m->ray->direction);
    m->origin_size = largest_of(m->ray->origin);
    m->t_max = reach(m);
    if (!(m->ray->t_min <= m->t_max)) return finish(m, SPT_MISS, start);
    if (m->settings->budget == 0) return finish(m, SPT_LIMIT, start);
    m->at = evaluate(m, m->ray->t_min);
    note_side(m);
    if (is_no_distance(m->at)) return finish(m, SPT_NONFINITE, m->at);
    if ((m->settings->flags & SPT_SKIP_START) != 0 && !leave_start(m)) return 0;
    if (m->at.value < 0) { /* the sign of the first sample, not of f(o) (Keinert Listing 2) */
        m->side = -1;
        m->at.r = -m->at.r;
        if ((m->settings->flags & SPT_STOP_INSIDE) != 0) {
            note_candidate(m);
            return finish(m, SPT_HIT, m->at);
        }
    }
    return 1;
}

reference_hit reference_trace(const reference_field *field, const reference_settings *settings,
                              const reference_ray *ray) {
    march m = {0};
    m.field = field;
    m.settings = settings;
    m.ray = ray;
    m.side = 1;
    m.descent = 1; /* the first step is plain; as printed it is 0/0 (Bálint & Valasek Alg. 3) */
    m.slope = -1;
    m.hit.candidate_t = m.hit.candidate_ratio = (real)INFINITY;
    if (begin(&m)) {
        while (turn(&m)) {
        }
    }
    return m.hit;
}

reference_settings reference_settings_of(const spt_settings *settings, reference_rule rule) {
    reference_settings copy;
    copy.rule = rule;
    copy.budget = settings->budget;
    copy.flags = settings->flags;
    copy.epsilon = (real)settings->epsilon;
    copy.pixel_radius = (real)settings->pixel_radius;
    copy.size = (real)settings->size;
    copy.relaxation = (real)settings->relaxation;
    copy.extrapolation = (real)settings->extrapolation;
    copy.slope_blend = (real)settings->slope_blend;
    copy.step_cap = (real)settings->step_cap;
    return copy;
}

reference_ray reference_ray_of(const spt_ray *ray) {
    reference_ray copy;
    for (int axis = 0; axis < 3; ++axis) {
        copy.origin[axis] = (real)ray->origin[axis];
        copy.direction[axis] = (real)ray->direction[axis];
    }
    copy.t_min = (real)ray->t_min;
    copy.t_max = (real)ray->t_max;
    copy.path = 0;
    return copy;
}
