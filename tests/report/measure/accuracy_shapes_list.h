/* SPDX-License-Identifier: MIT
 *
 * THE LIST of the shapes whose rounding is measured:
 *     SHAPE(name, size of the body: its largest coordinate, Lipschitz constant within 7 of the
 *           origin, whether general exponents double the error, value at p) */

SHAPE(sphere, 1.25, 1, 0, spt_sphere(p, real(1.25)))
SHAPE(plane, 0.5, 1, 0, spt_plane(p, at(0.6, 0.8, 0), real(0.5)))
SHAPE(box, 1.5, 1, 0, spt_box(p, at(0.5, 1, 1.5)))
SHAPE(rounded_box, 1.5, 1, 0, spt_rounded_box(p, at(0.75, 1, 1.5), real(0.3)))
SHAPE(torus, 2, 1, 0, spt_torus(p, real(1.5), real(0.5)))
SHAPE(capped_torus, 1.75, 1, 0, spt_capped_torus(p, real(0.6), real(0.8), real(1.5), real(0.25)))
SHAPE(capsule, 1.5, 1, 0, spt_capsule(p, at(-1, 0.5, 0.25), at(1, 1, -0.5), real(0.5)))
SHAPE(cylinder, 1.25, 1, 0, spt_cylinder(p, real(0.75), real(1.25)))
SHAPE(cone, 2, 1, 0, spt_cone(p, real(2), real(0.6), real(0.8)))
SHAPE(ellipsoid, 2, 1, 0, spt_ellipsoid(p, at(0.5, 1, 2)))
SHAPE(toroidal_capsule, 1.3, 1, 0, spt_toroidal_capsule(p, &with->bent))
SHAPE(polytope, 3.6, 1, 0, spt_polytope(p, 4, with->corner))
SHAPE(slabs, 1.26, 1, 0, spt_slabs(p, 6, with->dodecahedron))
SHAPE(generalised_2_5, 3.6, spt_generalised_lipschitz(4, with->corner, real(2.5), 0), 1,
      spt_generalised_distance(p, 4, with->corner, real(2.5)))
SHAPE(generalised_512, 3.6, spt_generalised_lipschitz(4, with->corner, 512, 0), 1,
      spt_generalised_distance(p, 4, with->corner, 512))
SHAPE(generalised_slabs_7, 1.26, spt_generalised_lipschitz(6, with->dodecahedron, 7, 1), 1,
      spt_generalised_slabs(p, 6, with->dodecahedron, 7))
SHAPE(squaring_4, 3.6, spt_generalised_lipschitz(4, with->corner, 4, 0), 0,
      spt_generalised_distance_by_squaring(p, 4, with->corner, 2))
SHAPE(squaring_64, 1.26, spt_generalised_lipschitz(6, with->dodecahedron, 64, 1), 0,
      spt_generalised_slabs_by_squaring(p, 6, with->dodecahedron, 6))
SHAPE(smooth_union, 1.75, 1, 0, spt_smooth_union(ball(p), block(p), real(0.75)))
SHAPE(rotate, 1.35, 1, 0, block(spt_rotate(p, &with->oblique)))
SHAPE(repeat, 7, 1, 0, spt_box(spt_repeat(p, at(2, 0, 1.75)), at(0.5, 0.75, 0.25)))
SHAPE(twist, 1.35, spt_twist_lipschitz(real(1.5), 7), 0, block(spt_twist(p, real(1.5))))
SHAPE(bend, 1.35, spt_bend_lipschitz(real(-0.75), 7), 0, block(spt_bend(p, real(-0.75))))
