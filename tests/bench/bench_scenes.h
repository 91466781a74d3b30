/* SPDX-License-Identifier: MIT
 *
 * THE LISTS of the driver's bench: which scenes are raced against a scalar loop, what an evaluation
 * of each costs, what the library is to reach, and which step rules there are. */
#ifndef TESTS_BENCH_SCENES_H
#define TESTS_BENCH_SCENES_H

/* X(scene, flop, divider, target at 4, 8 and 16 lanes)
 * flop: additions, subtractions, multiplications, minima and maxima of one evaluation, each 1,
 * counted in scene_*.h after folding constants. Magnitudes and selections by bits are free.
 * divider: roots and divisions, which have a unit of their own.
 *   primitives       5 balls of 9, 5 boxes of 18, 2 rounded ones of 19, 3 tori of 11, 2 cylinders
 *                    of 16, 4 capsules of 23; less 9 subtractions of zero; 21 minima. Roots: 2 a
 *                    torus and a cylinder, 1 each of the rest
 *   mandelbulb       |p|^2 5; an iteration 6 for the derivative, 40 for the power and 5 for the
 *                    next |q|^2, roots 2, division 1; the estimate 25, root 1, divisions 2. The
 *                    samples of the adaptive rule in the bench's picture take 3.04 in the mean
 *                    (counted by a callback); a vector waits for its slowest lane
 *   dodecahedron     6 products, 6 sums, 5 maxima, 1
 *   dodecahedron_p32 the same heights and greatest 18; 6 ratios and powers of 7; 5 sums; 2; roots
 *                    5, division 1
 *   village          40 houses of 24, their minimum included; the ground 6
 *   krs_tree_16      17 capsules of 40, roots 2 and a division each; 16 folds of 14 and a minimum
 *   krs_tree_28      29 and 28 of them */
#define BENCH_SCENES(X) \
    X(primitives, 342, 26, 3.2, 7.3, 8.6) \
    X(mandelbulb, 185, 12, 3.6, 8.0, 12.0) \
    X(dodecahedron, 18, 0, 2.0, 3.4, 4.4) \
    X(dodecahedron_p32, 67, 6, 3.6, 8.5, 12.0) \
    X(village, 966, 0, 2.8, 6.0, 10.0) \
    X(krs_tree_16, 920, 51, 2.4, 5.8, 9.5) \
    X(krs_tree_28, 1580, 87, 2.4, 6.4, 9.2)

/* X(scene, method, whether it needs a convex field), for the scene that the user names. */
#define BENCH_METHODS(X, scene) \
    X(scene, basic, 0) \
    X(scene, relaxed, 0) \
    X(scene, enhanced, 0) \
    X(scene, auto_relaxed, 0) \
    X(scene, adaptive, 0) \
    X(scene, convex, 1)

#endif
