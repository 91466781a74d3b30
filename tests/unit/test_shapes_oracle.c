/* SPDX-License-Identifier: MIT
 *
 * The search for nearest points, and the bodies of test_shapes_list.h by what they are. */
#include "test_shapes_oracle.h"

#include <math.h>
#include <string.h>

static double distance(const double a[3], const double b[3]) {
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

/* ---- The search over a surface: rays from the centre meet it once. ---- */

/* Where the ray from the centre along a direction leaves the body: bisection down to 3 * 2^-42. */
static void surface_point(const shape_body *body, const double direction[3], double point[3]) {
    const double length = sqrt(direction[0] * direction[0] + direction[1] * direction[1] +
                               direction[2] * direction[2]);
    double low = 0, high = body->reach / length;
    for (int i = 0; i < 42; ++i) {
        const double middle = 0.5 * (low + high);
        for (int k = 0; k < 3; ++k) point[k] = body->centre[k] + middle * direction[k];
        if (body->inside(point)) {
            low = middle;
        } else {
            high = middle;
        }
    }
}

enum { samples_on_an_edge = 17, samples = 6 * samples_on_an_edge * samples_on_an_edge };

typedef struct surface_samples {
    double direction[samples][3], point[samples][3];
} surface_samples;

/* Directions through a grid on the surface of a cube. Kept for the next call with the same body. */
static const surface_samples *surface_samples_of(const shape_body *body) {
    static surface_samples kept;
    static const shape_body *kept_body;
    if (kept_body == body) return &kept;
    for (int i = 0; i < samples; ++i) {
        const int face = i / (samples_on_an_edge * samples_on_an_edge);
        const int row = i / samples_on_an_edge % samples_on_an_edge,
                  column = i % samples_on_an_edge;
        kept.direction[i][face % 3] = face < 3 ? 1 : -1;
        kept.direction[i][(face + 1) % 3] = 2.0 * row / (samples_on_an_edge - 1) - 1;
        kept.direction[i][(face + 2) % 3] = 2.0 * column / (samples_on_an_edge - 1) - 1;
        surface_point(body, kept.direction[i], kept.point[i]);
    }
    kept_body = body;
    return &kept;
}

/* A search over directions through one face of the cube: coordinate `fixed` stays. */
typedef struct face_search {
    const shape_body *body;
    const double *p;
    double direction[3];
    int fixed;
} face_search;

/* The least value on an interval of a function with one minimum there, to SHAPE_SEARCH_STEP. */
static double golden_section(double (*value)(face_search *search, double u), face_search *search,
                             double low, double high) {
    const double ratio = 0.6180339887498949;
    double a = high - ratio * (high - low), b = low + ratio * (high - low);
    double at_a = value(search, a), at_b = value(search, b);
    while (high - low > SHAPE_SEARCH_STEP) {
        if (at_a < at_b) {
            high = b;
            b = a;
            at_b = at_a;
            a = high - ratio * (high - low);
            at_a = value(search, a);
        } else {
            low = a;
            a = b;
            at_a = at_b;
            b = low + ratio * (high - low);
            at_b = value(search, b);
        }
    }
    return at_a < at_b ? at_a : at_b;
}

static double at_both(face_search *search, double v) {
    double point[3];
    search->direction[(search->fixed + 2) % 3] = v;
    surface_point(search->body, search->direction, point);
    return distance(search->p, point);
}

static double least_over_second(face_search *search, double u) {
    const int second = (search->fixed + 2) % 3;
    const double v = search->direction[second];
    search->direction[(search->fixed + 1) % 3] = u;
    const double least = golden_section(at_both, search, v - 0.125, v + 0.125);
    search->direction[second] = v;
    return least;
}

/* The least distance within a cell of the grid around one sample: for each first coordinate the
 * least over the second, and the least of that. Edges do not trap it, as they do a descent. */
static double improve(const shape_body *body, const double p[3], const double start[3]) {
    face_search search = {body, p, {start[0], start[1], start[2]}, 0};
    search.fixed = fabs(start[0]) >= 1 ? 0 : fabs(start[1]) >= 1 ? 1 : 2;
    const double u = start[(search.fixed + 1) % 3];
    return golden_section(least_over_second, &search, u - 0.125, u + 0.125);
}

static double surface_distance(const shape_body *body, const double p[3]) {
    const surface_samples *sampled = surface_samples_of(body);
    enum { starts = 4 };
    int nearest[starts];
    double least[starts];
    for (int k = 0; k < starts; ++k) least[k] = HUGE_VAL;
    for (int i = 0; i < samples; ++i) {
        const double d = distance(p, sampled->point[i]);
        int place = starts;
        while (place > 0 && d < least[place - 1]) --place;
        if (place == starts) continue;
        for (int k = starts - 1; k > place; --k) {
            least[k] = least[k - 1];
            nearest[k] = nearest[k - 1];
        }
        least[place] = d;
        nearest[place] = i;
    }
    double best = HUGE_VAL;
    for (int k = 0; k < starts; ++k) {
        const double d = improve(body, p, sampled->direction[nearest[k]]);
        best = d < best ? d : best;
    }
    return best;
}

/* ---- The search along a curve ---- */

static double curve_distance_at(void (*curve)(double t, double point[3]), double t,
                                const double p[3]) {
    double point[3];
    curve(t < 0 ? 0 : t > 1 ? 1 : t, point);
    return distance(p, point);
}

double shape_curve_distance(void (*curve)(double t, double point[3]), const double p[3]) {
    enum { steps = 256 };
    int nearest = 0;
    double least = HUGE_VAL;
    for (int i = 0; i <= steps; ++i) {
        const double d = curve_distance_at(curve, (double)i / steps, p);
        if (d < least) {
            least = d;
            nearest = i;
        }
    }
    double low = (double)(nearest - 1) / steps, high = (double)(nearest + 1) / steps;
    for (int i = 0; i < 50; ++i) {
        const double a = high - 0.6180339887 * (high - low), b = low + 0.6180339887 * (high - low);
        const double at_a = curve_distance_at(curve, a, p), at_b = curve_distance_at(curve, b, p);
        if (at_a < at_b) {
            high = b;
        } else {
            low = a;
        }
        least = at_a < least ? at_a : least;
        least = at_b < least ? at_b : least;
    }
    return least;
}

double shape_search(const shape_body *body, const double p[3]) {
    if (body->curve != NULL) return shape_curve_distance(body->curve, p) - body->radius;
    const double d = surface_distance(body, p);
    return body->inside(p) ? -d : d;
}

/* In the plane of the three points, with complex numbers, a at -1 and b at 1: the Moebius map that
 * takes 0 to a, 1/2 to control and 1 to b takes the real line to their circle. */
void shape_arc_point(const double a[3], const double b[3], const double control[3], double t,
                     double point[3]) {
    double along[3], across[3], to_control[3];
    double half = 0, on_chord = 0, height = 0;
    for (int k = 0; k < 3; ++k) {
        along[k] = 0.5 * (b[k] - a[k]);
        to_control[k] = control[k] - 0.5 * (a[k] + b[k]);
        half += along[k] * along[k];
        on_chord += along[k] * to_control[k];
    }
    const double u = on_chord / half;
    for (int k = 0; k < 3; ++k) {
        across[k] = to_control[k] - u * along[k];
        height += across[k] * across[k];
    }
    const double v = sqrt(height / half);
    /* w = (c - a)/(b - c) = (u + 1 + iv)/(1 - u - iv) */
    const double square = (1 - u) * (1 - u) + v * v;
    const double w_re = ((u + 1) * (1 - u) - v * v) / square, w_im = 2 * v / square;
    /* z = (-(1 - t) + w t)/((1 - t) + w t) */
    const double above_re = t - 1 + w_re * t, below_re = 1 - t + w_re * t, both_im = w_im * t;
    const double divisor = below_re * below_re + both_im * both_im;
    const double z_re = (above_re * below_re + both_im * both_im) / divisor;
    const double z_im = both_im * (below_re - above_re) / divisor;
    for (int k = 0; k < 3; ++k) {
        point[k] = 0.5 * (a[k] + b[k]) + z_re * along[k] + (v > 0 ? z_im / v * across[k] : 0);
    }
}

/* ---- The bodies ---- */

static int in_sphere(const double p[3]) {
    return p[0] * p[0] + p[1] * p[1] + p[2] * p[2] <= 1.25 * 1.25;
}

static int in_box(const double p[3]) {
    return fabs(p[0]) <= 0.5 && fabs(p[1]) <= 1 && fabs(p[2]) <= 1.5;
}

/* within 0.5 of a point of the inner box */
static int in_rounded_box(const double p[3]) {
    const double inner[3] = {0.25, 0.5, 1};
    double square = 0;
    for (int k = 0; k < 3; ++k) {
        const double beyond = fabs(p[k]) > inner[k] ? fabs(p[k]) - inner[k] : 0;
        square += beyond * beyond;
    }
    return square <= 0.25;
}

static int in_cylinder(const double p[3]) {
    return fabs(p[1]) <= 0.75 && p[0] * p[0] + p[2] * p[2] <= 1.25 * 1.25;
}

/* The sides rise by 0.8 for 0.6 towards the apex; the constants as floats have them. */
static int in_cone(const double p[3]) {
    const double tangent = (double)0.6f / (double)0.8f;
    return p[1] <= 0 && p[1] >= -2 && hypot(p[0], p[2]) <= -p[1] * tangent;
}

static int in_ellipsoid(const double p[3]) {
    return 4 * p[0] * p[0] + p[1] * p[1] + 0.25 * p[2] * p[2] <= 1;
}

/* The norm of order `exponent` of what the coordinates along the normals exceed offset - width. */
static int in_tetrahedron_norm(const double p[3], double exponent) {
    const double height[4] = {-p[0], -p[1], -p[2],
                              (double)0.48f * p[0] + (double)0.6f * p[1] + (double)0.64f * p[2]};
    const double offset[4] = {0.5, 0.625, 0.75, 0.875}, width = 0.5;
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
        const double excess = height[i] - (offset[i] - width);
        if (exponent > 0 && excess > 0) sum += pow(excess / width, exponent);
        if (exponent <= 0 && height[i] > offset[i]) return 0;
    }
    return sum <= 1;
}

static int in_dodecahedron_norm(const double p[3], double exponent) {
    const double a = (double)0.850650808352040f, b = (double)0.525731112119134f;
    double sum = 0;
    for (int i = 0; i < 6; ++i) {
        const int axis = i / 2; /* (a, +-b, 0), (0, a, +-b), (+-b, 0, a) */
        const double height = fabs(a * p[axis] + (i % 2 ? -b : b) * p[(axis + 1) % 3]);
        if (exponent > 0) sum += pow(height, exponent);
        if (exponent <= 0 && height > 1) return 0;
    }
    return sum <= 1;
}

static int in_tetrahedron(const double p[3]) {
    return in_tetrahedron_norm(p, 0);
}

static int in_tetrahedron_2_5(const double p[3]) {
    return in_tetrahedron_norm(p, 2.5);
}

static int in_tetrahedron_4(const double p[3]) {
    return in_tetrahedron_norm(p, 4);
}

static int in_dodecahedron(const double p[3]) {
    return in_dodecahedron_norm(p, 0);
}

static int in_dodecahedron_7(const double p[3]) {
    return in_dodecahedron_norm(p, 7);
}

static int in_dodecahedron_32(const double p[3]) {
    return in_dodecahedron_norm(p, 32);
}

static void ring(double angle, double point[3]) {
    point[0] = 1.5 * sin(angle);
    point[1] = 0;
    point[2] = 1.5 * cos(angle);
}

static void torus_curve(double t, double point[3]) {
    ring(6.283185307179586 * t, point);
}

static void capped_torus_curve(double t, double point[3]) {
    ring((2 * t - 1) * atan2((double)0.6f, (double)0.8f), point);
}

static void capped_torus_wide_curve(double t, double point[3]) {
    ring((2 * t - 1) * atan2((double)0.6f, -(double)0.8f), point);
}

static void segment(const double a[3], const double b[3], double t, double point[3]) {
    for (int k = 0; k < 3; ++k) point[k] = a[k] + t * (b[k] - a[k]);
}

static void capsule_curve(double t, double point[3]) {
    const double a[3] = {-1, 0.5, 0.25}, b[3] = {1, 1, -0.5};
    segment(a, b, t, point);
}

static void capsule_point_curve(double t, double point[3]) {
    const double a[3] = {0.5, 0, 0};
    segment(a, a, t, point);
}

static void arc_curve(double t, double point[3]) {
    const double a[3] = {-1, 0, 0.5}, b[3] = {1, 0.5, 0}, control[3] = {0.25, 1, -0.5};
    shape_arc_point(a, b, control, t, point);
}

static void arc_long_curve(double t, double point[3]) {
    const double a[3] = {-0.5, 0, 0.25}, b[3] = {0.5, 0.25, 0}, control[3] = {0.25, 2, -0.5};
    shape_arc_point(a, b, control, t, point);
}

static void arc_straight_curve(double t, double point[3]) {
    const double a[3] = {-1, 0, 0.5}, b[3] = {1, 0.5, 0};
    segment(a, b, t, point);
}

const shape_body body_sphere = {in_sphere, {0, 0, 0}, 2, NULL, 0};
const shape_body body_box = {in_box, {0, 0, 0}, 3, NULL, 0};
const shape_body body_rounded_box = {in_rounded_box, {0, 0, 0}, 3, NULL, 0};
const shape_body body_torus = {NULL, {0, 0, 0}, 0, torus_curve, 0.5};
const shape_body body_capped_torus = {NULL, {0, 0, 0}, 0, capped_torus_curve, 0.25};
const shape_body body_capped_torus_wide = {NULL, {0, 0, 0}, 0, capped_torus_wide_curve, 0.25};
const shape_body body_capsule = {NULL, {0, 0, 0}, 0, capsule_curve, 0.5};
const shape_body body_capsule_point = {NULL, {0, 0, 0}, 0, capsule_point_curve, 0.5};
const shape_body body_cylinder = {in_cylinder, {0, 0, 0}, 2, NULL, 0};
const shape_body body_cone = {in_cone, {0, -1.25, 0}, 3, NULL, 0};
const shape_body body_ellipsoid = {in_ellipsoid, {0, 0, 0}, 3, NULL, 0};
const shape_body body_arc = {NULL, {0, 0, 0}, 0, arc_curve, 0.25};
const shape_body body_arc_long = {NULL, {0, 0, 0}, 0, arc_long_curve, 0.25};
const shape_body body_arc_straight = {NULL, {0, 0, 0}, 0, arc_straight_curve, 0.25};
const shape_body body_tetrahedron = {in_tetrahedron, {0, 0, 0}, 4, NULL, 0};
const shape_body body_dodecahedron = {in_dodecahedron, {0, 0, 0}, 2, NULL, 0};
const shape_body body_tetrahedron_2_5 = {in_tetrahedron_2_5, {0, 0, 0}, 4, NULL, 0};
const shape_body body_dodecahedron_7 = {in_dodecahedron_7, {0, 0, 0}, 2, NULL, 0};
const shape_body body_tetrahedron_4 = {in_tetrahedron_4, {0, 0, 0}, 4, NULL, 0};
const shape_body body_dodecahedron_32 = {in_dodecahedron_32, {0, 0, 0}, 2, NULL, 0};
