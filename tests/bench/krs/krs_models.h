/* SPDX-License-Identifier: MIT
 *
 * The models of the bench of kernel-reflection sequences, by their number of levels, and from where
 * they are seen. Left out: leaves and all that makes a picture, see examples/scenes/models.h. */
#ifndef TESTS_BENCH_KRS_MODELS_H
#define TESTS_BENCH_KRS_MODELS_H

#include <scenes/scenes.h>

/* A grove is one tree and three mirrors more, eight times the tree. */
enum { KRS_DOUBLINGS = 3, KRS_TREES = 1 << KRS_DOUBLINGS, KRS_MOST_LEVELS = 28 };

/* What is traced. */
typedef enum krs_body {
    KRS_TREE,   /* one sequence of `levels` levels, a kernel on each */
    KRS_GROVE,  /* one sequence of levels + 3: eight trees, by mirrors with empty kernels */
    KRS_COPIES, /* a compound of the very same eight trees, each a sequence of its own */
    KRS_KINDS,  /* a compound of eight different trees at the same places */
    KRS_PALM,   /* a Möbius sequence of `levels` levels */
    krs_bodies
} krs_body;

/* Models of one number of levels. A tree of fewer levels is the same without its thinnest twigs. */
typedef struct krs_models {
    uint32_t levels;
    spt_krs krs[2 + 2 * KRS_TREES]; /* the tree, the grove, the copies, the kinds */
    spt_moekrs palm;
    spt_field fields[3 + 2 * KRS_TREES]; /* of these, in that order; the palm's by its bound */
    spt_probe probes[krs_bodies];        /* of the tree and of the palm */
    spt_scene scenes[krs_bodies];
} krs_models;

/* Builds them for a width (0: the widest), levels at most KRS_MOST_LEVELS. They hold pointers into
 * themselves. Ends the program where the library refuses. */
void krs_models_build(krs_models *models, uint32_t levels, int lanes);

/* The field of a body that is one. */
const spt_field *krs_models_field(const krs_models *models, krs_body body);

/* How many kernel instances a body has, empty ones left out. */
double krs_models_instances(uint32_t levels, krs_body body);

/* From where a body is seen; only its camera is meant. */
const scene *krs_view(krs_body body);

#endif
