/* SPDX-License-Identifier: MIT
 *
 * Batches of points for callbacks. */
#include "moekrs_ask.h"

#include <stdlib.h>
#include <string.h>

enum { columns = 5, alignment = 64 };

/* x, y, z, radius and the answer, each on a line of its own. */
static void columns_of(float *room, float *column[columns]) {
    const uintptr_t past = (uintptr_t)room % alignment;
    char *const first = (char *)room + (past == 0 ? 0 : alignment - past);
    for (int i = 0; i < columns; ++i) {
        column[i] = (float *)(void *)(first + (size_t)i * SPT_BATCH * sizeof(float));
    }
}

static void load(float *const column[columns], size_t count, size_t padded,
                 const moekrs_query *queries) {
    for (size_t i = 0; i < padded; ++i) {
        const moekrs_query *query = &queries[i < count ? i : 0];
        for (int axis = 0; axis < 3; ++axis) column[axis][i] = query->point[axis];
        column[3][i] = query->radius;
    }
}

static void ask(const spt_field *field, const spt_probe *probe, size_t count,
                moekrs_query *queries) {
    float room[columns * SPT_BATCH + alignment], *column[columns];
    columns_of(room, column);
    while (count > 0) {
        const size_t here = count < SPT_BATCH ? count : SPT_BATCH, padded = (here + 15) / 16 * 16;
        load(column, here, padded, queries);
        if (field != NULL) {
            field->batch(field->user, padded, column[0], column[1], column[2], column[4]);
        } else {
            probe->batch(probe->user, padded, column[0], column[1], column[2], column[3],
                         column[4]);
        }
        for (size_t i = 0; i < here; ++i) queries[i].answer = column[4][i];
        queries += here;
        count -= here;
    }
}

void moekrs_ask_field(const spt_field *field, int point, size_t count, moekrs_query *queries) {
    if (!point) ask(field, NULL, count, queries);
    for (size_t i = 0; i < count && point; ++i) {
        const float *p = queries[i].point;
        queries[i].answer = field->point(field->user, p[0], p[1], p[2]);
    }
}

void moekrs_ask_probe(const spt_probe *probe, int point, size_t count, moekrs_query *queries) {
    if (!point) ask(NULL, probe, count, queries);
    for (size_t i = 0; i < count && point; ++i) {
        const float *p = queries[i].point;
        queries[i].answer = probe->point(probe->user, p[0], p[1], p[2], queries[i].radius);
    }
}

int moekrs_full(void) {
    const char *full = getenv("SPT_FULL_COUNT");
    return full != NULL && strcmp(full, "1") == 0;
}
