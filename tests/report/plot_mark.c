/* SPDX-License-Identifier: MIT
 *
 * Marks of a plot: lines across it, and words that hide neither data nor each other. */
#include <float.h>
#include <math.h>

#include "plot_parts.h"

const char plot_halo[] =
    " paint-order=\"stroke\" stroke=\"#fff\" stroke-width=\"4\" stroke-linejoin=\"round\"";

enum { margin_most = 110, margin_line = 15 };

typedef struct box {
    double left, right, top, bottom;
} box;

static int is_seen(const plot_frame *frame, const plot_mark *mark) {
    const plot_scale *const scale = mark->vertical ? &frame->x : &frame->y;
    if (!plot_has_place(scale, mark->at)) return 0;
    const double at = plot_place(scale, mark->at);
    return at >= fmin(scale->from, scale->to) - .01 && at <= fmax(scale->from, scale->to) + .01;
}

/* Whether it has words, and those stand above the frame (vertical) or not. */
static int has_words(const plot_frame *frame, const plot_mark *mark, int vertical) {
    return mark->words != NULL && !mark->vertical == !vertical && is_seen(frame, mark);
}

/* The middle of a vertical mark's words. */
static double middle_of(const plot_frame *frame, const plot_mark *mark) {
    const double half = .5 * plot_width(mark->words, plot_text_size);
    return fmax(fmin(plot_place(&frame->x, mark->at), frame->right - half), frame->left + half);
}

void plot_layout_marks(plot_frame *frame) {
    const plot_mark *const marks = frame->drawn->marks;
    frame->mark_rows = 0;
    for (int i = 0; i < frame->drawn->mark_count; ++i) {
        frame->mark_row[i] = -1;
        if (!has_words(frame, &marks[i], 1)) continue;
        const double at = middle_of(frame, &marks[i]);
        const double half = .5 * plot_width(marks[i].words, plot_text_size);
        int row = 0;
        for (int k = 0; k < i; ++k) {
            if (frame->mark_row[k] != row) continue;
            const double room = half + .5 * plot_width(marks[k].words, plot_text_size) + 10;
            if (fabs(at - middle_of(frame, &marks[k])) >= room) continue;
            ++row;
            k = -1;
        }
        frame->mark_row[i] = row;
        if (row + 1 > frame->mark_rows) frame->mark_rows = row + 1;
    }
}

static int has_bars(const plot *drawn) {
    for (int i = 0; i < drawn->series_count; ++i) {
        if (drawn->series[i].style == PLOT_BARS) return 1;
    }
    return 0;
}

double plot_mark_margin(const plot *drawn) {
    double widest = 0;
    if (!has_bars(drawn)) return 0;
    for (int i = 0; i < drawn->mark_count; ++i) {
        const plot_mark *const mark = &drawn->marks[i];
        if (mark->vertical || mark->words == NULL) continue;
        widest = fmax(widest, plot_wrap(mark->words, margin_most, plot_text_size, 3).width);
    }
    return widest;
}

/* The words of a horizontal mark: above or below its line, right, left or between, where they hide
 * the least of the data and of the words before them. */
static box place_inside(const plot_frame *frame, const plot_mark *mark, const box *taken,
                        int count) {
    const double width = plot_width(mark->words, plot_text_size);
    const double y = plot_place(&frame->y, mark->at);
    const double room = frame->right - frame->left - 12 - width;
    box best = {0, 0, 0, 0};
    int least = -1;
    for (int i = 0; i < 10; ++i) {
        const double left = frame->left + 6 + room * (1 - i / 2 * .25);
        const double top = i % 2 ? y + 3 : y - 18;
        const box tried = {left, left + width, top, top + 15};
        int hidden = plot_hidden(frame, left, left + width, top, top + 15);
        if (tried.top < frame->top - 4 || tried.bottom > frame->bottom) hidden += 1000;
        for (int k = 0; k < count; ++k) {
            if (tried.left < taken[k].right + 4 && tried.right > taken[k].left - 4 &&
                tried.top < taken[k].bottom && tried.bottom > taken[k].top) {
                hidden += 400;
            }
        }
        if (least >= 0 && hidden >= least) continue;
        least = hidden;
        best = tried;
    }
    return best;
}

/* The horizontal mark with the highest value below `below` that has words; -1: none. */
static int next_lower(const plot_frame *frame, double below, int after) {
    const plot_mark *const marks = frame->drawn->marks;
    int best = -1;
    for (int i = 0; i < frame->drawn->mark_count; ++i) {
        if (!has_words(frame, &marks[i], 0)) continue;
        if (marks[i].at > below || (marks[i].at >= below && i <= after)) continue;
        if (best < 0 || marks[i].at > marks[best].at) best = i;
    }
    return best;
}

/* Words of horizontal marks right of the frame, from above to below. */
static void draw_beside(FILE *file, const plot_frame *frame) {
    double free_from = frame->top - margin_line;
    for (int i = next_lower(frame, DBL_MAX, -1); i >= 0;
         i = next_lower(frame, frame->drawn->marks[i].at, i)) {
        const plot_mark *const mark = &frame->drawn->marks[i];
        const plot_lines words = plot_wrap(mark->words, margin_most, plot_text_size, 3);
        const double y = plot_place(&frame->y, mark->at);
        const double top = fmax(y - .5 * margin_line * words.count, free_from);
        for (int k = 0; k < words.count; ++k) {
            plot_text(file, frame->right + 6, top + margin_line * k + 11.5, "start", plot_halo,
                      words.line[k]);
        }
        free_from = top + margin_line * words.count + 2;
    }
}

void plot_draw_marks(FILE *file, const plot_frame *frame) {
    const plot_mark *const marks = frame->drawn->marks;
    const int count = frame->drawn->mark_count;
    box taken[plot_most_marks];
    for (int i = 0; i < count; ++i) {
        if (!is_seen(frame, &marks[i])) continue;
        const double at = plot_place(marks[i].vertical ? &frame->x : &frame->y, marks[i].at);
        if (marks[i].vertical) {
            const int row = frame->mark_row[i] > 0 ? frame->mark_row[i] : 0;
            fprintf(file, "<path d=\"M%.1f %.1fV%.1f\"", at, frame->bottom,
                    frame->top - row * plot_line_height - 3);
        } else {
            fprintf(file, "<path d=\"M%.1f %.1fH%.1f\"", frame->left, at, frame->right);
        }
        fprintf(file, " stroke=\"%s\" stroke-width=\"1.3\" stroke-dasharray=\"3 3\"/>\n", PLOT_INK);
    }
    for (int i = 0; i < count; ++i) {
        if (!has_words(frame, &marks[i], 1)) continue;
        plot_text(file, middle_of(frame, &marks[i]),
                  frame->top - 6 - frame->mark_row[i] * plot_line_height, "middle", plot_halo,
                  marks[i].words);
    }
    if (has_bars(frame->drawn)) {
        draw_beside(file, frame);
        return;
    }
    for (int i = 0, placed = 0; i < count; ++i) {
        if (!has_words(frame, &marks[i], 0)) continue;
        taken[placed] = place_inside(frame, &marks[i], taken, placed);
        plot_text(file, taken[placed].left, taken[placed].bottom - 3.5, "start", plot_halo,
                  marks[i].words);
        ++placed;
    }
}
