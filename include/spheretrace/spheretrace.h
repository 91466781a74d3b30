/* SPDX-License-Identifier: MIT
 *
 * libspheretrace: finds where rays meet surfaces given as signed distance functions.
 * This umbrella includes the other headers and holds nothing of its own. Left out is simd.h, which
 * brings the compiler's vector types: a file that writes SIMD callbacks by hand includes it. */
#ifndef SPHERETRACE_SPHERETRACE_H
#define SPHERETRACE_SPHERETRACE_H

#include "base.h"
#include "bound.h"
#include "field.h"
#include "frame.h"
#include "glsl.h"
#include "krs.h"
#include "mobius.h"
#include "scene.h"
#include "shapes.h"
#include "surface.h"
#include "trace.h"

#endif
