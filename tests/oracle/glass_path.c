/* SPDX-License-Identifier: MIT
 *
 * THE BOUND. Between two events the tracer's line is at most `lateral` off the true one at its
 * start and turned by at most `angle`. With c the cosine of incidence, k the curvature, w the depth
 * at which a ray starts (twice its tolerance), to first order, every c and sine taken at the end of
 * its range that gives the most:
 *   e = lateral + angle length        off at the surface, which its line crosses
 *   s = e / c                         from the point;
 *   a = tolerance / (slope c)         before that crossing it stops, at |f| < tolerance;
 *   n = k (s + a + w) + normal_error  is the most its normal is turned,
 *   i = angle + n                     and the most by which the angle of incidence is off.
 * Snell's law d' = r d + (r c - c') n, c'^2 = 1 - r^2 (1 - c^2), is differentiated for the new
 * angle: r angle + |r c - c'| n + r sin i |r c - c'| / c'; a reflection adds 2 n. What crosses at s
 * goes on max(1, c'/c) e off to the side; the hit, a before the crossing, and the start at depth w
 * add (a c / slope) tan c' + w sin', the curvature of the surface between them k (s + a + w)^2.
 * Floats round positions within the floor of tol_w, directions by 2^-24.
 *
 * An event is certain while these ranges hold: the cosine does not halve, no sine passes the
 * critical angle, and no other face comes within a tolerance, the depth or the reach of a normal of
 * where the tracer may be. Factors 1.1 cover the second order of k s, itself at most 0.1. */
#include "glass_path.h"

#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double rounding(const glass_tracer *tracer, const double origin[3], double length) {
    const double x = fabs(origin[0]), y = fabs(origin[1]), z = fabs(origin[2]);
    return 0x1p-22 * (fmax(x, fmax(y, z)) + length + tracer->size);
}

double glass_tolerance(const glass_tracer *tracer, const double origin[3], double path,
                       double length) {
    const double cone = tracer->pixel_radius * (path + length);
    return fmax(fmax(tracer->epsilon, cone), rounding(tracer, origin, length));
}

int glass_bend(const double direction[3], const double normal[3], double ratio, double bent[3]) {
    const double cosine = -dot(direction, normal);
    const double square = 1 - ratio * ratio * (1 - cosine * cosine);
    const double along = square > 0 ? ratio * cosine - sqrt(square) : 2 * cosine;
    const double kept = square > 0 ? ratio : 1;
    double length;
    for (int axis = 0; axis < 3; ++axis) {
        bent[axis] = kept * direction[axis] + along * normal[axis];
    }
    length = sqrt(dot(bent, bent));
    for (int axis = 0; axis < 3; ++axis) bent[axis] /= length;
    return square > 0;
}

/* What is known of the tracer's line on a segment. */
typedef struct doubt {
    double lateral, angle, path;
    int certain;
} doubt;

/* Its hit: see THE BOUND. */
typedef struct meeting {
    double cosine_low, cosine_high, sine_low, sine_high; /* of incidence */
    double e, s, a, n, i, tolerance, depth;
} meeting;

static double clamped(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}

static int meet(const glass_body *body, const glass_tracer *tracer, const doubt *from,
                const double origin[3], const glass_event *event, double cosine, meeting *m) {
    const double round = rounding(tracer, origin, event->length);
    const double quarter = acos(0.0), incidence = acos(clamped(cosine, 0, 1));
    m->e = from->lateral + from->angle * event->length + round;
    m->cosine_low = cosine;
    for (int turn = 0; turn < 8; ++turn) {
        double stretch;
        m->s = m->e / m->cosine_low;
        stretch = event->length + m->s;
        m->tolerance = glass_tolerance(tracer, origin, 1.01 * from->path, 1.01 * stretch) + round;
        m->a = m->tolerance / (body->slope * m->cosine_low);
        m->depth = 2 * glass_tolerance(tracer, event->point, 1.01 * (from->path + stretch), 0);
        m->depth = fmax(m->depth, m->tolerance);
        m->n = 1.1 * body->curvature * (m->s + m->a + m->depth);
        if (!(m->n < 0.1)) return 0;
        m->i = from->angle + m->n;
        m->cosine_low = cos(fmin(incidence + m->i, quarter));
        if (!(m->cosine_low > cosine / 2)) return 0;
    }
    m->n += tracer->normal_error;
    m->i += tracer->normal_error;
    m->sine_low = sin(fmax(incidence - m->i, 0));
    m->sine_high = sin(fmin(incidence + m->i, quarter));
    m->cosine_low = cos(fmin(incidence + m->i, quarter));
    m->cosine_high = cos(fmax(incidence - m->i, 0));
    return m->cosine_low > cosine / 2;
}

/* The doubt of the segment behind the event. */
static doubt leave(const glass_body *body, const glass_tracer *tracer, const glass_event *event,
                   const meeting *m, int refracts, double ratio, double cosine, doubt from) {
    const double slip = m->tolerance * m->sine_high / (body->slope * m->cosine_low);
    const double spread = m->s + m->a + m->depth;
    double out_low = m->cosine_low, out_high = m->cosine_high, sine_out = m->sine_high;
    const double far = rounding(tracer, event->point, 0);
    doubt to = from;
    to.path += event->length;
    if (refracts) {
        const double least = 1 - ratio * ratio * m->sine_high * m->sine_high;
        const double out = sqrt(fmax(0, 1 - ratio * ratio * (1 - cosine * cosine)));
        double bend;
        if (!(least > 0)) {
            to.certain = 0;
            return to;
        }
        out_low = sqrt(least);
        out_high = sqrt(fmax(0, 1 - ratio * ratio * m->sine_low * m->sine_low));
        sine_out = fmin(1, ratio * m->sine_high);
        bend = fabs(ratio * cosine - out) +
               ratio * m->sine_high * m->i * (1 + ratio * m->cosine_high / out_low);
        to.angle = ratio * from.angle + bend * m->n + ratio * m->sine_high * m->i * bend / out_low;
    } else {
        if (ratio * m->sine_low <= 1) to.certain = 0;
        to.angle += 2 * m->n;
    }
    to.angle += 0x1p-24;
    to.lateral = m->e * fmax(1, out_high / m->cosine_low) + slip * out_high +
                 m->depth * (sine_out + m->n) + 1.1 * body->curvature * spread * spread + 2 * far;
    /* It leaves to the side that it should. */
    if (!(out_low > 2 * to.angle)) to.certain = 0;
    return to;
}

int glass_follow(const glass_body *body, double index, const glass_tracer *tracer,
                 const double origin[3], const double direction[3], glass_path *path) {
    double o[3], d[3];
    doubt on = {0, 0, 0, 1};
    int inside = 0;
    memcpy(o, origin, sizeof o);
    memcpy(d, direction, sizeof d);
    path->count = 0;
    while (path->count < glass_events) {
        glass_event *event = &path->event[path->count];
        const double ratio = inside ? index : 1 / index;
        double normal[3], cosine, others;
        meeting m;
        int refracts;
        if (!glass_cross(body, o, d, inside, &event->length)) return path->count > 0;
        for (int axis = 0; axis < 3; ++axis) event->point[axis] = o[axis] + event->length * d[axis];
        event->face = glass_face(body, event->point);
        glass_normal(body, event->point, normal);
        for (int axis = 0; axis < 3 && inside; ++axis) normal[axis] = -normal[axis];
        cosine = -dot(d, normal);
        refracts = glass_bend(d, normal, ratio, event->direction);
        event->kind =
            refracts ? (inside ? GLASS_EXIT : GLASS_ENTRY) : (inside ? GLASS_TOTAL : GLASS_MIRROR);
        on.certain = on.certain && meet(body, tracer, &on, o, event, cosine, &m);
        if (on.certain) {
            others = m.s + m.a + 2 * m.tolerance + 2 * m.depth + tracer->normal_reach;
            event->off = m.s + m.a + rounding(tracer, o, event->length);
            on.certain = glass_other_faces(body, event->point) > others;
            on = leave(body, tracer, event, &m, refracts, ratio, cosine, on);
            event->turned = on.angle;
        }
        event->certain = on.certain;
        ++path->count;
        if (event->kind == GLASS_EXIT || event->kind == GLASS_MIRROR) break;
        inside = 1;
        /* The next crossing is looked for behind this one, which rounding may put before it. */
        memcpy(o, event->point, sizeof o);
        memcpy(d, event->direction, sizeof d);
    }
    return path->count > 0;
}
