/* SPDX-License-Identifier: MIT
 *
 * Algorithm 3, its spheres as coefficients alpha |p|^2 + 2 Re(beta p) + gamma (Equation 2). */
#include "moekrs_printed.h"

#include <math.h>

typedef struct sphere {
    double alpha, gamma;
    spt_quaternion beta;
} sphere;

static spt_quaternion times(spt_quaternion p, spt_quaternion q, spt_quaternion r) {
    return spt_quaternion_product(spt_quaternion_product(p, q), r);
}

/* TRANSFORMSPHERE: Appendix A as printed. */
static sphere transform(const sphere *s, const spt_mobius *L) {
    const spt_quaternion b = spt_quaternion_conjugate(L->b), c = spt_quaternion_conjugate(L->c),
                         d = spt_quaternion_conjugate(L->d),
                         beta = spt_quaternion_conjugate(s->beta);
    sphere original;
    original.alpha = s->alpha * spt_quaternion_square(L->a) + 2 * times(c, s->beta, L->a).real +
                     s->gamma * spt_quaternion_square(L->c);
    original.beta = spt_quaternion_sum(
        spt_quaternion_sum(spt_quaternion_scaled(spt_quaternion_product(b, L->a), s->alpha),
                           times(d, s->beta, L->a)),
        spt_quaternion_sum(times(b, beta, L->c),
                           spt_quaternion_scaled(spt_quaternion_product(d, L->c), s->gamma)));
    original.gamma = s->alpha * spt_quaternion_square(L->b) + 2 * times(d, s->beta, L->b).real +
                     s->gamma * spt_quaternion_square(L->d);
    return original;
}

/* Lines 9 to 11: whether a kernel lets the sphere be. */
static int passes(const moekrs_model *model, unsigned mended, int nan_kernel, int kernel,
                  const sphere *s) {
    const spt_kernel *one = &model->kernels[kernel];
    const int fixed = (mended & PRINTED_SPHERE) != 0;
    const double below = fixed ? s->alpha : s->gamma,
                 offset = fixed ? s->gamma / s->alpha : s->gamma;
    const double x = s->beta.x / below, y = s->beta.y / below, z = s->beta.z / below;
    const double rho = sqrt(x * x + y * y + z * z - offset);
    const double a = (double)one->a[0], b = (double)one->a[1], c = (double)one->a[2];
    double k = HUGE_VAL;
    if (one->kind == SPT_KERNEL_SPHERE) {
        k = sqrt((x - a) * (x - a) + (y - b) * (y - b) + (z - c) * (z - c)) - (double)one->radius;
    } else if (one->kind == SPT_KERNEL_HALF_SPACE) {
        k = (a * x + b * y + c * z - (double)one->radius) / sqrt(a * a + b * b + c * c);
    }
    if (kernel == nan_kernel) k = (double)NAN;
    return (mended & PRINTED_ORDERED) != 0 ? k >= rho : !(k < rho);
}

int printed_unbounding(const moekrs_model *model, unsigned mended, int nan_kernel,
                       const double center[3], double rho) {
    const int order = (mended & PRINTED_ORDER) != 0, inside = (mended & PRINTED_INSIDE) != 0;
    sphere s;
    s.alpha = 1;
    s.beta = spt_quaternion_of(0, center[0], center[1], center[2]);
    s.gamma = spt_quaternion_square(s.beta) - rho * rho;
    for (int i = model->levels - 1; i >= 0; --i) {
        double side;
        s = transform(&s, &model->maps[i]);
        if (inside && !(s.alpha > 0)) return 0;
        if (order && !passes(model, mended, nan_kernel, i + 1, &s)) return 0;
        side = (mended & PRINTED_COMMENT) != 0 ? s.beta.x : -s.beta.x;
        if (side < 0 && (model->unmirrored >> i & 1) == 0) s.beta.x = -s.beta.x;
        if (!order && !passes(model, mended, nan_kernel, i, &s)) return 0;
    }
    if (!inside && s.alpha < 0) return 0;
    return !order || passes(model, mended, nan_kernel, 0, &s);
}
