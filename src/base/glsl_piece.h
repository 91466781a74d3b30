/* SPDX-License-Identifier: MIT
 *
 * How the GLSL of a room is kept beside its C code: in NAME.glsl.h, as a list of pieces, each a
 * function, structure or macro. A piece is written where something that is written names it, and a
 * room's pieces come after those they name.
 *
 * A text is made of whole lines, indented by four spaces, at most 100 columns. In it
 *     [name]code    writes the line only where the condition holds (writer.h: the list), [!name]
 *                   where it does not; several may follow one another, and all must hold
 *     $precise      `precise`, SPT_PRECISE (in libraries, where the host's version decides) or
 *                   nothing, with the blank behind it
 *     $epsilon      a parameter (spt_glsl_name): the uniform's name, or the constant
 *     $zero         0 for the start of loops, as an expression that no compiler knows
 *     $C  $P        "component, " and "int component, " with several components, else nothing
 *     $L  $S        of the component that is asked: 1 / lipschitz, and 2^-22 times the size that
 *                   counts for its rounding floor
 *     $n $iterations $samples $cone_size   numbers of components and of the options, as literals
 *     $miss $hit $limit $nonfinite $bad    the values of spt_outcome
 *     $0 .. $9      what the writer of this text brings; alone in a line it may be several lines,
 *                   which are indented like it, or none
 * Rules of the traced path (everything that t, residual, outcome and evaluations depend on): scalar
 * operations in the order of the C code, every result of more than one operation in a variable that
 * is $precise, and returned from there; no dot length distance normalize reflect mix, no matrix; no
 * min(), max() where a NaN or the sign of zero decides; NaN is told by spt_is_number(). Loops begin at
 * $zero and have a bound; no recursion. Names are those of the C code, spt_ or local; nothing that
 * any GLSL version reserves (half input output filter active common partition sample ...). */
#ifndef SPTI_GLSL_PIECE_H
#define SPTI_GLSL_PIECE_H

typedef struct spti_glsl_piece {
    const char *name; /* what others call it by */
    const char *text;
} spti_glsl_piece;

/* A step rule, beside its C code in methods/NAME.glsl.h: lines of spt_trace(), not indented. */
typedef struct spti_rule_glsl {
    const char *declared; /* its memory */
    const char *step;     /* declares the step it would like to make, `wish`, from `radius` (of the
                           * certified sphere) and the memory; of spt_convex() an expression */
    const char *accepted; /* the memory after a certified sample: `step`, `before`, `after` are the
                           * pair */
    const char *rejected; /* and after a probe that was turned down */
    const char *title;    /* what it is and where it comes from */
} spti_rule_glsl;

#endif
