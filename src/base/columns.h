/* SPDX-License-Identifier: MIT
 *
 * Strided views as the public doors read and write them, one value at a time. By memcpy, since
 * values need no alignment. */
#ifndef SPTI_COLUMNS_H
#define SPTI_COLUMNS_H

#include <spheretrace/base.h>

#include <string.h>

/* Whether count values of this stride can lie in memory at all. */
static inline int spti_fits(ptrdiff_t stride, size_t count) {
    const size_t most = PTRDIFF_MAX;
    const size_t step = stride < 0 ? (size_t)0 - (size_t)stride : (size_t)stride;
    if (count == 0) return 1;
    return count <= most && step <= most && (step == 0 || count - 1 <= (most - 4) / step);
}

/* Absent columns and sinks fit. */
static inline int spti_column_fits(const spt_column *column, size_t count) {
    return column->first == NULL || spti_fits(column->stride, count);
}

static inline int spti_sink_fits(const spt_sink *sink, size_t count) {
    return sink->first == NULL ||
           ((sink->stride != 0 || count <= 1) && spti_fits(sink->stride, count));
}

static inline float spti_read(const spt_column *column, size_t index, float absent) {
    if (column->first == NULL) return absent;
    memcpy(&absent, (const char *)column->first + (ptrdiff_t)index * column->stride, 4);
    return absent;
}

static inline int32_t spti_read_integer(const spt_column *column, size_t index, int32_t absent) {
    if (column->first == NULL) return absent;
    memcpy(&absent, (const char *)column->first + (ptrdiff_t)index * column->stride, 4);
    return absent;
}

/* A sink that is read back, as a column. */
static inline spt_column spti_column_of(const spt_sink *sink) {
    const spt_column column = {sink->first, sink->stride};
    return column;
}

static inline void spti_write(const spt_sink *sink, size_t index, float value) {
    if (sink->first == NULL) return;
    memcpy((char *)sink->first + (ptrdiff_t)index * sink->stride, &value, sizeof value);
}

static inline void spti_write_integer(const spt_sink *sink, size_t index, int32_t value) {
    if (sink->first == NULL) return;
    memcpy((char *)sink->first + (ptrdiff_t)index * sink->stride, &value, sizeof value);
}

#endif
