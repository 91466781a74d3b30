/* SPDX-License-Identifier: MIT
 *
 * What the families of stability.csv are, in words. */
#include <string.h>

#include "page_stability.h"

const stability_name stability_names[] = {
    {"plate", "1", "Plate", "thickness", "A plate before a wall, tolerance `1e-4`."},
    {"plate_fine", "1", "Plate, least tolerance", "thickness",
     "The same with the least tolerance that float32 resolves: the rounding floor."},
    {"shell", "1", "Shell", "thickness", "A hollow ball before a wall, tolerance `1e-4`."},
    {"shell_fine", "1", "Shell, least tolerance", "thickness",
     "The same with the rounding floor alone."},
    {"wire", "1", "Wire", "thickness", "An endless wire before a wall, tolerance `1e-4`."},
    {"wire_fine", "1", "Wire, least tolerance", "thickness",
     "The same with the rounding floor alone."},
    {"sheet", "1", "Sheet without thickness", "distance",
     "The unsigned distance to a plane, met head-on or nearly so, with the rounding floor alone."},
    {"grazing_plane", "1", "Plane at a small angle", "angle",
     "Rays that come down to a plane, or go up from it, at the angle; `budget 128`."},
    {"grazing_plane_patient", "1", "Plane at a small angle, patient", "angle",
     "The same with `budget 1000`."},
    {"grazing_ball", "1", "Ball at a small angle", "angle",
     "Rays that meet a ball at the angle, or pass it as closely."},
    {"sine", "1", "Rippled ball, slope told", "slope",
     "A ball with sines added, their slope given as the Lipschitz constant."},
    {"sine", "0", "Rippled ball, slope not told", "slope",
     "The same, the Lipschitz constant left at `1`."},
    {"twist", "1", "Twisted column, slope told", "slope",
     "A twisted box in a cylinder as its bound, the slope of the twist given."},
    {"twist", "0", "Twisted column, slope not told", "slope",
     "The same, the Lipschitz constant left at `1`."},
    {"divided", "1", "Distance divided", "divisor",
     "A ball, a box and a floor, the distance divided and nothing told: a bound that "
     "underestimates."},
    {"divided_told", "1", "Distance divided, told", "divisor",
     "The same with the Lipschitz constant divided as well."},
    {"far_ball", "1", "Ball of fixed size far away", "distance",
     "Its radius is `1`; the field in double and rounded; tolerance `1e-4`, or what float32 "
     "resolves."},
    {"far_ball_float", "1", "Ball of fixed size, in float", "distance",
     "The same, the field in float."},
    {"growing_ball", "1", "Ball growing with distance", "distance",
     "Its radius a quarter of its distance; the field in double and rounded."},
    {"growing_ball_float", "1", "Ball growing, in float", "distance",
     "The same, the field in float."},
    {"planet", "1", "Planet, size told", "radius",
     "A ball of this radius two units below the camera, in float, the radius given as "
     "`settings.size`."},
    {"planet", "0", "Planet, size not told", "radius",
     "The same without: what float loses in the radius is taken for distance."},
    {"scale", "1", "Everything scaled", "scale",
     "A ball, a box and a floor, tolerance and all; the factors are no powers of two."},
    {"dodecahedron", "1", "Rounded dodecahedron", "exponent",
     "The generalised distance of six slabs, in float by the library's shapes."},
    {"superquadric", "1", "Superquadric cube", "exponent",
     "The generalised distance of three slabs, in float by the library's shapes."},
    {"superquadric_naive", "0", "Superquadric, powers overflow", "exponent",
     "The same as it stands in books: powers overflow to infinity, which says that nothing is "
     "there."},
    {"krs", "1", "Kernel-reflection sequence", "levels",
     "Balls folded by mirrors through their levels; the truth folds in double."},
    {"moekrs", "1", "Möbius sequence, by its bound", "levels",
     "The same with an inversion between levels; the truth are all balls one by one."},
    {"conformal_pole", "1", "Surface through a pole", "distance from the pole",
     "A half space seen through an inversion: a ball, met this close to the image of infinity."},
    {"conformal_ball", "1", "Kernel at the inversion's centre", "gap to the centre",
     "A ball that passes this close to the centre of its inversion, whose image grows without "
     "end."},
    {"jump", "0", "Jump", "height",
     "A ball whose left half is larger by this; the field on the right does not know it."},
    {"cells", "0", "Cells, no look at neighbours", "offset",
     "A ball in each cell, off its middle by up to this; the field asks one cell only."},
    {"nan_cells", "0", "NaN in a share of space", "share",
     "A ball, a box and a floor; this share of all cells gives NaN."},
    {"mandelbulb", "0", "Mandelbulb, estimate", "iterations",
     "The usual estimate of the distance, Lipschitz constant `1`."},
    {"mandelbulb_halved", "0", "Mandelbulb, estimate halved", "iterations",
     "The same with Lipschitz constant `2`."}};

const int stability_name_count = sizeof stability_names / sizeof stability_names[0];

const stability_name *stability_name_of(const char *family, const char *bound) {
    for (int i = 0; i < stability_name_count; ++i) {
        if (strcmp(stability_names[i].family, family) == 0 &&
            strcmp(stability_names[i].bound, bound) == 0) {
            return &stability_names[i];
        }
    }
    static const stability_name unnamed = {"", "", "a family without a name", "value", ""};
    return &unnamed;
}
