/* SPDX-License-Identifier: MIT
 *
 * The numbers by which a shader writes a depth buffer. */
#include "../base/arguments.h"

#include <spheretrace/glsl.h>

spt_status spt_glsl_depth(float near_plane, float far_plane, float coefficients[2]) {
    const double near = (double)near_plane, far = (double)far_plane;
    if (coefficients == NULL || !(near > 0) || !(far > 0)) return SPT_BAD_ARGUMENT;
    const int near_ends = spti_finite(near_plane), far_ends = spti_finite(far_plane);
    if (!near_ends && !far_ends) return SPT_BAD_ARGUMENT;
    if (near_ends && far_ends && !(near < far) && !(near > far)) return SPT_BAD_ARGUMENT;
    /* a + b / z is 0 at the near plane and 1 at the far one. */
    if (!far_ends) {
        coefficients[0] = 1.0f;
        coefficients[1] = (float)-near;
    } else if (!near_ends) {
        coefficients[0] = 0.0f;
        coefficients[1] = (float)far;
    } else {
        coefficients[0] = (float)(far / (far - near));
        coefficients[1] = (float)(-far * near / (far - near));
    }
    return SPT_OK;
}
