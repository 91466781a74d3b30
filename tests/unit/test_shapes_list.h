/* SPDX-License-Identifier: MIT
 *
 * THE LIST of the fields under test: every primitive alone, and every operator on a primitive.
 *     SHAPE(name, value at p, Lipschitz constant, flags, body in test_shapes_oracle.c or NULL)
 * Constants are wrapped in real(), so that float and double have the same ones; `with` points to
 * what is built once, see test_shapes_table.h. */

SHAPE(sphere, spt_sphere(p, real(1.25)), 1, SHAPE_EXACT | SHAPE_CONVEX, &body_sphere)
SHAPE(plane, spt_plane(p, at(0.6, 0.8, 0), real(0.5)), 1, SHAPE_CONVEX, NULL)
SHAPE(box, spt_box(p, at(0.5, 1, 1.5)), 1, SHAPE_EXACT | SHAPE_CONVEX, &body_box)
SHAPE(rounded_box, spt_rounded_box(p, at(0.75, 1, 1.5), real(0.5)), 1, SHAPE_EXACT | SHAPE_CONVEX,
      &body_rounded_box)
SHAPE(torus, spt_torus(p, real(1.5), real(0.5)), 1, SHAPE_EXACT, &body_torus)
SHAPE(capped_torus, spt_capped_torus(p, real(0.6), real(0.8), real(1.5), real(0.25)), 1,
      SHAPE_EXACT, &body_capped_torus)
SHAPE(capped_torus_wide, spt_capped_torus(p, real(0.6), real(-0.8), real(1.5), real(0.25)), 1,
      SHAPE_EXACT, &body_capped_torus_wide)
SHAPE(capsule, spt_capsule(p, at(-1, 0.5, 0.25), at(1, 1, -0.5), real(0.5)), 1,
      SHAPE_EXACT | SHAPE_CONVEX, &body_capsule)
SHAPE(capsule_point, spt_capsule(p, at(0.5, 0, 0), at(0.5, 0, 0), real(0.5)), 1,
      SHAPE_EXACT | SHAPE_CONVEX, &body_capsule_point)
SHAPE(cylinder, spt_cylinder(p, real(0.75), real(1.25)), 1, SHAPE_EXACT | SHAPE_CONVEX,
      &body_cylinder)
SHAPE(cone, spt_cone(p, real(2), real(0.6), real(0.8)), 1, SHAPE_EXACT | SHAPE_CONVEX, &body_cone)
SHAPE(ellipsoid, spt_ellipsoid(p, at(0.5, 1, 2)), 1, SHAPE_CONVEX, &body_ellipsoid)
SHAPE(toroidal_capsule, spt_toroidal_capsule(p, &with->bent), 1, SHAPE_EXACT, &body_arc)
SHAPE(toroidal_capsule_long, spt_toroidal_capsule(p, &with->wound), 1, SHAPE_EXACT, &body_arc_long)
SHAPE(toroidal_capsule_straight, spt_toroidal_capsule(p, &with->straight), 1,
      SHAPE_EXACT | SHAPE_CONVEX, &body_arc_straight)
SHAPE(toroidal_capsule_point, spt_toroidal_capsule(p, &with->point), 1, SHAPE_EXACT | SHAPE_CONVEX,
      &body_capsule_point)
SHAPE(polytope, spt_polytope(p, 4, with->tetrahedron), 1, SHAPE_EXACT_INSIDE | SHAPE_CONVEX,
      &body_tetrahedron)
SHAPE(slabs, spt_slabs(p, 6, with->dodecahedron), 1, SHAPE_EXACT_INSIDE | SHAPE_CONVEX,
      &body_dodecahedron)
SHAPE(generalised_distance, spt_generalised_distance(p, 4, with->tetrahedron, real(2.5)),
      spt_generalised_lipschitz(4, with->tetrahedron, real(2.5), 0), SHAPE_CONVEX | SHAPE_POWERS,
      &body_tetrahedron_2_5)
SHAPE(generalised_512, spt_generalised_distance(p, 4, with->tetrahedron, 512),
      spt_generalised_lipschitz(4, with->tetrahedron, 512, 0), SHAPE_CONVEX | SHAPE_POWERS, NULL)
SHAPE(generalised_slabs, spt_generalised_slabs(p, 6, with->dodecahedron, 7),
      spt_generalised_lipschitz(6, with->dodecahedron, 7, 1), SHAPE_CONVEX | SHAPE_POWERS,
      &body_dodecahedron_7)
SHAPE(generalised_distance_by_squaring,
      spt_generalised_distance_by_squaring(p, 4, with->tetrahedron, 2),
      spt_generalised_lipschitz(4, with->tetrahedron, 4, 0), SHAPE_CONVEX, &body_tetrahedron_4)
SHAPE(generalised_slabs_by_squaring, spt_generalised_slabs_by_squaring(p, 6, with->dodecahedron, 5),
      spt_generalised_lipschitz(6, with->dodecahedron, 32, 1), SHAPE_CONVEX, &body_dodecahedron_32)
SHAPE(generalised_64, spt_generalised_slabs_by_squaring(p, 6, with->dodecahedron, 6),
      spt_generalised_lipschitz(6, with->dodecahedron, 64, 1), SHAPE_CONVEX, NULL)

SHAPE(union, spt_union(ball(p), block(p)), 1, 0, NULL)
SHAPE(intersection, spt_intersection(ball(p), block(p)), 1, SHAPE_CONVEX, NULL)
SHAPE(difference, spt_difference(ball(p), block(p)), 1, 0, NULL)
SHAPE(smooth_union, spt_smooth_union(ball(p), block(p), real(0.75)), 1, 0, NULL)
SHAPE(smooth_union_hard, spt_smooth_union(ball(p), block(p), 0), 1, 0, NULL)
SHAPE(smooth_intersection, spt_smooth_intersection(ball(p), block(p), real(0.75)), 1, SHAPE_CONVEX,
      NULL)
SHAPE(smooth_difference, spt_smooth_difference(ball(p), block(p), real(0.75)), 1, 0, NULL)
SHAPE(translate, block(spt_translate(p, at(0.5, -1, 0.25))), 1, SHAPE_CONVEX, NULL)
SHAPE(rotate, block(spt_rotate(p, &with->oblique)), 1, SHAPE_CONVEX, NULL)
SHAPE(scale, block(spt_scale(p, real(0.375))) * real(0.375), 1, SHAPE_CONVEX, NULL)
SHAPE(repeat, spt_box(spt_repeat(p, at(2, 0, 1.75)), at(0.5, 0.75, 0.25)), 1, 0, NULL)
SHAPE(twist, block(spt_twist(p, real(1.5))), spt_twist_lipschitz(real(1.5), SHAPE_REACH), 0, NULL)
SHAPE(bend, block(spt_bend(p, real(-0.75))), spt_bend_lipschitz(real(-0.75), SHAPE_REACH), 0, NULL)
SHAPE(waves, spt_sin(p.x * 3) + spt_cos(p.y * 3), 6, 0, NULL)
