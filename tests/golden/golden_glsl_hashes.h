/* SPDX-License-Identifier: MIT
 *
 * The pinned texts of test_golden_glsl.c. */
GOLDEN_GLSL(smallest, 0x1f35481bu)
GOLDEN_GLSL(shapes, 0x2ef0fdb2u)
GOLDEN_GLSL(body, 0x75afbe3fu)
GOLDEN_GLSL(guarded, 0xc1d49927u)
GOLDEN_GLSL(model, 0xb4265367u)
GOLDEN_GLSL(model_in_arrays, 0x0d4b53dau)
GOLDEN_GLSL(model_places, 0xd9482291u)
GOLDEN_GLSL(mapped, 0x8ff30ee8u)
GOLDEN_GLSL(nested, 0x74baf8afu)
GOLDEN_GLSL(distances, 0xb90cfa21u)
GOLDEN_GLSL(cones, 0x4c3cb83eu)
GOLDEN_GLSL(scene, 0xe32b327du)
GOLDEN_GLSL(scene_library, 0xc835bdfdu)
GOLDEN_GLSL(merged, 0x96721058u)
