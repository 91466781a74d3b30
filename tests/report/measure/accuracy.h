/* SPDX-License-Identifier: MIT
 *
 * What the measurements of accuracy share: a list of errors, the rows that sum it up, and random
 * numbers, vectors and chains of maps. Left out: the references themselves, which are tests/oracle.
 */
#ifndef TESTS_REPORT_ACCURACY_H
#define TESTS_REPORT_ACCURACY_H

#include "../report.h"
#include "../../oracle/mobius_region.h"

/* One subject, a cell or a part of one: what is swept, what errors count in, and which words of
 * which header promise a bound of them ("": none does). */
typedef struct accuracy_subject {
    const char *name, *parameter, *unit, *source;
} accuracy_subject;

/* Errors as they come in. Begin with all 0. */
typedef struct accuracy_errors {
    double *values;
    size_t count, room;
} accuracy_errors;

/* NaN counts as +infinity: no answer where there is one is no small error. */
void accuracy_add(accuracy_errors *errors, double error);

/* Writes the row of a value of the parameter and empties the list, which must not be empty.
 * promised: 0 where the header promises nothing for this value. */
void accuracy_write(FILE *rows, const accuracy_subject *subject, double value, double promised,
                    accuracy_errors *errors);
/* The same for a parameter that is a name. */
void accuracy_write_named(FILE *rows, const accuracy_subject *subject, const char *value,
                          double promised, accuracy_errors *errors);

/* How many samples a row takes: `full`, or an eighth of it. */
size_t accuracy_samples(const report_options *options, size_t full);

/* ---- Drawing --------------------------------------------------------------------------------- */

/* Log-uniform: low and high > 0. */
double accuracy_spread(report_random *random, double low, double high);
void accuracy_unit(report_random *random, double direction[3]);

/* A chain of elementary maps around a ball of center 0 and radius 1, each step about the size and
 * place of what the ball has become: as they follow one another in models. */
void accuracy_chain(report_random *random, chain *one, int count);

/* Numbers of levels, or of maps, that are swept: those of at most `most`. */
extern const int accuracy_levels[];
int accuracy_level_count(int most);

/* ---- Cells ----------------------------------------------------------------------------------- */

/* Each writes the rows of its subjects. */
typedef void accuracy_cell(const report_options *options, FILE *rows);
accuracy_cell accuracy_hits, accuracy_hits_floor, accuracy_binary, accuracy_normals_distance,
    accuracy_normals_curvature, accuracy_offsets, accuracy_refining, accuracy_glass, accuracy_krs,
    accuracy_maps, accuracy_regions, accuracy_exits, accuracy_conformal, accuracy_pulled_points,
    accuracy_pulled_balls, accuracy_moekrs, accuracy_bounds, accuracy_shapes, accuracy_arcs,
    accuracy_functions;

#endif
