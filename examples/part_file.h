/* SPDX-License-Identifier: MIT
 *
 * Parts of a picture as files, so that several machines can trace one picture: each writes the
 * pieces it traced, and whoever has all the files puts them together.
 *
 * A part file, all numbers little endian whatever the machine:
 *     8 bytes        "SPTPART1"
 *     uint32 x 24    the settings: part_file.c lists them
 *     32 bytes       the scene's name, zeros behind it
 *     uint32         which part, from 1 on
 *     uint64 x 44    the counts of four panels, 11 each: rays, five outcomes, evaluations,
 *                    fallbacks, cone evaluations, components kept and culled
 *     float ...      the pieces, each the values of its pixels row by row (picture.h)
 *     uint64         FNV-1a of all bytes before */
#ifndef EXAMPLES_PART_FILE_H
#define EXAMPLES_PART_FILE_H

#include "picture.h"

enum { part_most = 9999 };

/* The pieces of part `part` (1 .. of): a run, as long as the others or one longer. */
void part_pieces(const picture_job *job, int part, int of, size_t *first, size_t *end);

/* Writes a part whose pieces are all done. Returns 0, or -1 with errno set where the system gave a
 * reason. */
int part_write(const char *path, const film *exposed, int part, int of);

/* Reads all parts of a picture, in any order, onto one film. values is NULL, after a message on
 * standard error, where a file cannot be read or is damaged, or parts are missing, doubled or of
 * another picture. */
film part_merge(char *const *paths, int count);

#endif
