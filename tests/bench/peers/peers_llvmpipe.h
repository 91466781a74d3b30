/* SPDX-License-Identifier: MIT
 *
 * Mesa's llvmpipe as a peer: an emitted shader of SPT_GLSL_HITS on the processor, in the thread of
 * the caller. Left out: what the shader is of. */
#ifndef TESTS_BENCH_PEERS_LLVMPIPE_H
#define TESTS_BENCH_PEERS_LLVMPIPE_H

#include "../frame/frame_picture.h"

/* How it runs: for numbers by a compute shader (target SPT_GLSL_COMPUTE_450), or as a picture is
 * drawn (SPT_GLSL_FRAGMENT_330). */
typedef enum peers_stage { PEERS_COMPUTE, PEERS_FRAGMENT, peers_stages } peers_stage;

typedef struct peers_shader peers_shader;

/* Whether it is on this machine; says so if not. No other thread may run: it changes the
 * environment. */
int peers_llvmpipe_open(void);

/* "llvmpipe (LLVM ...)" */
const char *peers_llvmpipe_name(void);

/* A shader that is ready to run on the rays of a picture; it is compiled by its first run. Ends the
 * program where it cannot be built. */
peers_shader *peers_shader_of(peers_stage stage, const char *text, const frame_picture *picture,
                              uint32_t budget);
void peers_shader_free(peers_shader *shader);

/* Traces the whole picture, once; seconds of the process. */
double peers_shader_run(const peers_shader *shader);

/* What the last run wrote: (t, residual, evaluations, outcome) for each ray of the picture in its
 * order. */
void peers_shader_hits(const peers_shader *shader, float (*hits)[4]);

#endif
