/* SPDX-License-Identifier: MIT
 *
 * Figures of the page: plots, inlined and as files beside it, and pictures within it. */
#include <stdlib.h>
#include <string.h>

#include "page.h"
#include "page_text.h"

static void fail(const char *what, const char *which) {
    fprintf(stderr, "page: %s %s\n", what, which);
    exit(1);
}

static FILE *opened(const page *out, const char *name, const char *ending, const char *mode) {
    char path[1024];
    if (snprintf(path, sizeof path, "%s/%s%s", out->tables, name, ending) >= (int)sizeof path) {
        fail("the path is too long of", name);
    }
    FILE *const file = fopen(path, mode);
    if (file == NULL) fail("cannot open", path);
    return file;
}

/* widest: of what is in it, in pixels; 0: as wide as the page. */
static void begin_figure(page *out, const char *kind, double widest) {
    if (out->place != PAGE_BETWEEN) fail("a figure within something,", kind);
    fprintf(out->html, "<figure id=\"figure-%d\"><div class=\"%s\"", ++out->figures, kind);
    if (widest > 0) fprintf(out->html, " style=\"max-width:%.0fpx\"", widest);
    fputs(">\n", out->html);
}

static void begin_caption(page *out) {
    out->place = PAGE_CAPTION;
    fprintf(out->html, "</div>\n<figcaption><b>Figure %d.</b> ", out->figures);
}

void page_figures(page *out, const char *const *names, const plot *drawn, int count) {
    /* A view box that is drawn larger than it is has large letters: not by much. */
    const int width = drawn[0].width > 0 ? drawn[0].width : 560;
    if (count > 1) {
        begin_figure(out, width < 450 ? "plots small" : "plots", 0);
    } else {
        begin_figure(out, width > 600 ? "plot wide" : "plot", 1.2 * width);
    }
    for (int i = 0; i < count; ++i) {
        FILE *const file = opened(out, names[i], ".svg", "w");
        plot_svg(file, &drawn[i]);
        if (fclose(file) != 0) fail("cannot write", names[i]);
        plot_svg(out->html, &drawn[i]);
    }
    begin_caption(out);
}

void page_figure(page *out, const char *name, const plot *drawn) {
    page_figures(out, &name, drawn, 1);
}

void page_figure_end(page *out) {
    if (out->place != PAGE_CAPTION) fail("the end of a figure that was not begun", "");
    out->place = PAGE_BETWEEN;
    fputs("</figcaption></figure>\n", out->html);
}

static void base64(FILE *html, FILE *file) {
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    unsigned char three[3];
    size_t got;
    while ((got = fread(three, 1, 3, file)) > 0) {
        for (size_t i = got; i < 3; ++i) three[i] = 0;
        fputc(digit[three[0] >> 2], html);
        fputc(digit[(three[0] & 3) << 4 | three[1] >> 4], html);
        fputc(got > 1 ? digit[(three[1] & 15) << 2 | three[2] >> 6] : '=', html);
        fputc(got > 2 ? digit[three[2] & 63] : '=', html);
    }
}

void page_picture(page *out, const char *file, const char *alternative) {
    FILE *const picture = opened(out, file, "", "rb");
    begin_figure(out, "picture", 0);
    fputs("<img alt=\"", out->html);
    page_escape(out->html, alternative);
    fputs("\" src=\"data:image/png;base64,", out->html);
    base64(out->html, picture);
    fputs("\">\n", out->html);
    fclose(picture);
    begin_caption(out);
}
