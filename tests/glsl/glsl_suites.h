/* SPDX-License-Identifier: MIT
 *
 * THE LIST of the suites that need an implementation of GLSL; each is a function suite_NAME in some
 * file of this folder. */
SUITE(engines)
SUITE(surface_glsl)
SUITE(reverse_glsl)
SUITE(shapes_glsl)
SUITE(trace_glsl)
SUITE(scenes_glsl)
SUITE(krs_glsl)
SUITE(mobius_glsl)
SUITE(binary_glsl)
SUITE(bound_glsl)
SUITE(cone_glsl)
SUITE(found_glsl)
SUITE(found_names_glsl)
