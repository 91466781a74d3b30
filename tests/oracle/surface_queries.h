/* SPDX-License-Identifier: MIT
 *
 * Every query of surface.h behind one signature, on rows of all that they read and write, so that
 * one test can compare them all. Left out: spt_offset() and spt_trace_convex(). */
#ifndef TESTS_ORACLE_SURFACE_QUERIES_H
#define TESTS_ORACLE_SURFACE_QUERIES_H

#include "surface_oracle.h"

#include <spheretrace/surface.h>

enum { query_room = 4, query_fields = 3 };

/* All that any query reads and writes of one ray, point or body. Equal bytes are equal bits. */
typedef struct query_row {
    spt_ray ray;
    float path, tangent, point[3], normal[3], from[3], to[3], radius;
    int32_t active;
    spt_hit hit;
    float vector[3], value, more[query_room];
    int32_t number, other;
    uint32_t count;
} query_row;

/* Rows anywhere in memory, aligned to nothing. */
typedef struct query_table {
    char *first;
    ptrdiff_t stride;
    size_t count;
} query_table;

/* What is asked: some fields, and all as one. */
typedef struct query_views {
    spt_field each[query_fields], all;
    spt_settings settings;
} query_views;

/* Views of a member of all rows, by its offset; and those of the ray. */
spt_column query_column(const query_table *at, size_t offset);
spt_sink query_sink(const query_table *at, size_t offset);
spt_rays query_rays(const query_table *at);

typedef spt_status query_call(const query_views *of, const query_table *at);

/* THE LIST. settings: whether it reads settings at all. */
typedef struct query_entry {
    const char *name;
    query_call *call;
    int settings;
} query_entry;
enum { query_count = 12 };
extern const query_entry queries[query_count];

#endif
