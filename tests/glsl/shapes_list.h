/* SPDX-License-Identifier: MIT
 *
 * THE LIST of what shapes.h has, each with an expression that is the same text in C and in GLSL.
 *     KIND(function, arguments, expression)
 * KIND says what comes back: NUMBER, INTEGER, BITS, POINT, SURFACE, ROTATION or ARC. The expression
 * may use the point p, the numbers a[0] a[1] ..., whole(a[0]) for an int, bits(a[0]) for the bits
 * of a number, and planes, arc and rotation where they are drawn. How numbers are drawn, one letter
 * each, or as many numbers as it says:
 *     v  coordinate            f  distance, any sign     l  length > 0       z  length or 0
 *     t  sine, cosine (2) of an angle in [0, pi]         c  of one that is sharp, of a cone
 *     u  unit vector (3)       g  angle                  e  -100 to 100      w  any normal number
 *     m  material              q  squarings              n  count of planes  x  exponent
 *     P  16 planes (64), which are called planes         A  an arc (17), called arc
 *     R  a rotation (9), called rotation                 S  the points of a flat arc (9)
 * Included several times with different definitions of the kinds and of EXEMPT(function), which
 * names what GLSL does not have. */

/* shapes_math.h */
POINT(spt_point_of, "vvv", spt_point_of(a[0], a[1], a[2]))
NUMBER(spt_least, "ff", spt_least(a[0], a[1]))
NUMBER(spt_greatest, "ff", spt_greatest(a[0], a[1]))
BITS(spt_bits_of, "w", spt_bits_of(a[0]))
NUMBER(spt_real_of, "w", spt_real_of(bits(a[0])))
BITS(spt_sign_bit, "w", spt_sign_bit(a[0]))
NUMBER(spt_positive, "f", spt_positive(a[0]))
NUMBER(spt_negative, "f", spt_negative(a[0]))
NUMBER(spt_clamp, "fll", spt_clamp(a[0], -a[1], a[2]))
NUMBER(spt_choose, "ffff", spt_choose(a[0] < a[1], a[2], a[3]))
NUMBER(spt_magnitude, "w", spt_magnitude(a[0]))
NUMBER(spt_root, "w", spt_root(spt_magnitude(a[0])))
NUMBER(spt_dot, "vvv", spt_dot(p, spt_point_of(a[0], a[1], a[2])))
NUMBER(spt_length_2, "vv", spt_length_2(a[0], a[1]))
NUMBER(spt_length_3, "vvv", spt_length_3(a[0], a[1], a[2]))
NUMBER(spt_limit, "wl", spt_limit(a[0], a[1]))
INTEGER(spt_nearest, "g", spt_nearest(a[0]))
NUMBER(spt_sin, "g", spt_sin(a[0]))
NUMBER(spt_cos, "g", spt_cos(a[0]))
NUMBER(spt_exp, "e", spt_exp(a[0]))
NUMBER(spt_log, "w", spt_log(a[0]))

/* shapes_primitives.h */
NUMBER(spt_sphere, "z", spt_sphere(p, a[0]))
NUMBER(spt_plane, "uf", spt_plane(p, spt_point_of(a[0], a[1], a[2]), a[3]))
NUMBER(spt_box, "zzz", spt_box(p, spt_point_of(a[0], a[1], a[2])))
NUMBER(spt_rounded_box, "lllz", spt_rounded_box(p, spt_point_of(a[0], a[1], a[2]), a[3]))
NUMBER(spt_torus, "lz", spt_torus(p, a[0], a[1]))
NUMBER(spt_capped_torus, "tlz", spt_capped_torus(p, a[0], a[1], a[2], a[3]))
NUMBER(spt_capsule, "vvvzzzz",
       spt_capsule(p, spt_point_of(a[0], a[1], a[2]),
                   spt_point_of(a[0] + a[3], a[1] + a[4], a[2] + a[5]), a[6]))
NUMBER(spt_cylinder, "zz", spt_cylinder(p, a[0], a[1]))
NUMBER(spt_cone, "lc", spt_cone(p, a[0], a[1], a[2]))
NUMBER(spt_ellipsoid, "lll", spt_ellipsoid(p, spt_point_of(a[0], a[1], a[2])))
ARC(spt_arc_of, "vvvvvvvvvz",
    spt_arc_of(spt_point_of(a[0], a[1], a[2]), spt_point_of(a[3], a[4], a[5]),
               spt_point_of(a[6], a[7], a[8]), a[9]))
NUMBER(spt_toroidal_capsule, "A", spt_toroidal_capsule(p, arc))

/* shapes_polytopes.h */
NUMBER(spt_polytope, "Pn", spt_polytope(p, whole(a[64]), planes))
NUMBER(spt_slabs, "Pn", spt_slabs(p, whole(a[64]), planes))
NUMBER(spt_generalised_distance, "Pnx", spt_generalised_distance(p, whole(a[64]), planes, a[65]))
NUMBER(spt_generalised_slabs, "Pnx", spt_generalised_slabs(p, whole(a[64]), planes, a[65]))
NUMBER(spt_generalised_distance_by_squaring, "Pnq",
       spt_generalised_distance_by_squaring(p, whole(a[64]), planes, whole(a[65])))
NUMBER(spt_generalised_slabs_by_squaring, "Pnq",
       spt_generalised_slabs_by_squaring(p, whole(a[64]), planes, whole(a[65])))
EXEMPT(spt_generalised_lipschitz) /* for spt_field.lipschitz, before there is a shader */

/* shapes_operators.h */
NUMBER(spt_union, "ff", spt_union(a[0], a[1]))
NUMBER(spt_intersection, "ff", spt_intersection(a[0], a[1]))
NUMBER(spt_difference, "ff", spt_difference(a[0], a[1]))
NUMBER(spt_smooth_union, "ffz", spt_smooth_union(a[0], a[1], a[2]))
NUMBER(spt_smooth_intersection, "ffz", spt_smooth_intersection(a[0], a[1], a[2]))
NUMBER(spt_smooth_difference, "ffz", spt_smooth_difference(a[0], a[1], a[2]))
SURFACE(spt_surface_of, "fm", spt_surface_of(a[0], whole(a[1])))
SURFACE(spt_surface_union, "fmfm",
        spt_surface_union(spt_surface_of(a[0], whole(a[1])), spt_surface_of(a[2], whole(a[3]))))
SURFACE(spt_surface_intersection, "fmfm",
        spt_surface_intersection(spt_surface_of(a[0], whole(a[1])),
                                 spt_surface_of(a[2], whole(a[3]))))
SURFACE(spt_surface_difference, "fmfm",
        spt_surface_difference(spt_surface_of(a[0], whole(a[1])),
                               spt_surface_of(a[2], whole(a[3]))))
SURFACE(spt_surface_smooth_union, "fmfmz",
        spt_surface_smooth_union(spt_surface_of(a[0], whole(a[1])),
                                 spt_surface_of(a[2], whole(a[3])), a[4]))
SURFACE(spt_surface_smooth_intersection, "fmfmz",
        spt_surface_smooth_intersection(spt_surface_of(a[0], whole(a[1])),
                                        spt_surface_of(a[2], whole(a[3])), a[4]))
SURFACE(spt_surface_smooth_difference, "fmfmz",
        spt_surface_smooth_difference(spt_surface_of(a[0], whole(a[1])),
                                      spt_surface_of(a[2], whole(a[3])), a[4]))
POINT(spt_translate, "vvv", spt_translate(p, spt_point_of(a[0], a[1], a[2])))
ROTATION(spt_rotation_of, "vvvg", spt_rotation_of(spt_point_of(a[0], a[1], a[2]), a[3]))
POINT(spt_rotate, "R", spt_rotate(p, rotation))
POINT(spt_scale, "l", spt_scale(p, a[0]))
POINT(spt_repeat, "zzz", spt_repeat(p, spt_point_of(a[0], a[1], a[2])))
POINT(spt_twist, "v", spt_twist(p, a[0]))
NUMBER(spt_twist_lipschitz, "vl", spt_twist_lipschitz(a[0], a[1]))
POINT(spt_bend, "v", spt_bend(p, a[0]))
NUMBER(spt_bend_lipschitz, "vl", spt_bend_lipschitz(a[0], a[1]))
