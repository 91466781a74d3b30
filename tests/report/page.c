/* SPDX-License-Identifier: MIT
 *
 * Sections, paragraphs, numbers and tables of the page; each element that is opened is closed, or
 * the program ends. Left out: figures, see page_figure.c, and the file, see page_main.c. */
#include "page.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "page_text.h"

static void demand(const page *out, int holds, const char *what) {
    if (holds) return;
    fprintf(stderr, "page: %s, in section %s\n", what,
            out->section_count > 0 ? out->section_id[out->section_count - 1] : "none");
    exit(1);
}

static void demand_place(const page *out, page_place place, const char *what) {
    demand(out, out->place == place, what);
}

void page_finish(page *out) {
    demand_place(out, PAGE_BETWEEN, "something is not ended");
    demand(out, out->folds == 0, "a fold is not ended");
    if (out->section_count > 0) fputs("</section>\n", out->html);
}

void page_section(page *out, const char *id, const char *title) {
    page_finish(out);
    demand(out, out->section_count < page_most_sections, "too many sections");
    out->section_id[out->section_count] = id;
    out->section_title[out->section_count++] = title;
    fputs("\n<section id=\"", out->html);
    page_escape(out->html, id);
    fputs("\">\n<h2>", out->html);
    page_markup(out->html, title);
    fputs("</h2>\n", out->html);
}

void page_heading(page *out, const char *title) {
    demand_place(out, PAGE_BETWEEN, "a heading within something");
    fputs("<h3>", out->html);
    page_markup(out->html, title);
    fputs("</h3>\n", out->html);
}

void page_begin(page *out) {
    demand_place(out, PAGE_BETWEEN, "a paragraph within something");
    out->place = PAGE_PARAGRAPH;
    fputs("<p>", out->html);
}

void page_end(page *out) {
    demand_place(out, PAGE_PARAGRAPH, "the end of a paragraph that was not begun");
    out->place = PAGE_BETWEEN;
    fputs("</p>\n", out->html);
}

static int takes_words(const page *out) {
    return out->place == PAGE_PARAGRAPH || out->place == PAGE_CAPTION || out->place == PAGE_CELL;
}

void page_words(page *out, const char *format, ...) {
    va_list arguments;
    demand(out, takes_words(out), "words outside of paragraphs, captions and cells");
    va_start(arguments, format);
    page_markup_format(out->html, format, arguments);
    va_end(arguments);
}

void page_number(page *out, const csv_table *table, int row, const char *column,
                 const char *format) {
    demand(out, takes_words(out), "a number outside of paragraphs, captions and cells");
    const char *const text = csv_text(table, row, column);
    fputs("<data value=\"", out->html);
    page_escape(out->html, text);
    fputs("\" title=\"", out->html);
    page_escape(out->html, csv_name(table));
    fprintf(out->html, ".csv, line %d, ", row + 2);
    page_escape(out->html, column);
    fputs("\">", out->html);
    if (text[0] == '\0') {
        fputs("–", out->html);
    } else if (format == NULL || format[0] == '\0') {
        page_escape(out->html, text);
    } else {
        page_rounded(out->html, format, csv_number(table, row, column));
    }
    fputs("</data>", out->html);
}

void page_table(page *out, const char *caption, const char *columns) {
    demand_place(out, PAGE_BETWEEN, "a table within something");
    out->place = PAGE_TABLE;
    out->columns = 0;
    fputs("<figure class=\"table\"><figcaption>", out->html);
    page_markup(out->html, caption);
    fputs("</figcaption>\n<div class=\"scroll\"><table>\n<thead><tr>", out->html);
    for (const char *at = columns;; ++at) {
        const size_t length = strcspn(at, "|");
        char name[256];
        demand(out, length < sizeof name, "the name of a column is too long");
        memcpy(name, at, length);
        name[length] = '\0';
        fputs("<th>", out->html);
        page_markup(out->html, name);
        fputs("</th>", out->html);
        ++out->columns;
        at += length;
        if (*at == '\0') break;
    }
    fputs("</tr></thead>\n<tbody>\n", out->html);
}

static void end_row(page *out) {
    demand(out, out->place == PAGE_TABLE || out->place == PAGE_ROW, "a row outside of a table");
    if (out->place == PAGE_TABLE) return;
    demand(out, out->cells == out->columns, "a row with more or fewer cells than columns");
    fputs("</tr>\n", out->html);
    out->place = PAGE_TABLE;
}

void page_row(page *out) {
    end_row(out);
    out->place = PAGE_ROW;
    out->cells = 0;
    fputs("<tr>", out->html);
}

/* kinds: sign, for those who do not see the colour. */
static const char *sign_of(const page *out, const char *kind) {
    if (kind == NULL || strcmp(kind, "quiet") == 0) return "";
    if (strcmp(kind, "good") == 0) return "✓ ";
    if (strcmp(kind, "bad") == 0) return "✗ ";
    demand(out, strcmp(kind, "warn") == 0, "a cell of a kind that is none");
    return "! ";
}

static void begin_cell(page *out, const char *kind, const char *align) {
    demand_place(out, PAGE_ROW, "a cell outside of a row");
    out->place = PAGE_CELL;
    ++out->cells;
    fprintf(out->html, "<td class=\"%s %s\">%s", align, kind != NULL ? kind : "plain",
            sign_of(out, kind));
}

void page_cell_begin(page *out, const char *kind) {
    begin_cell(out, kind, "word");
}

void page_cell_end(page *out) {
    demand_place(out, PAGE_CELL, "the end of a cell that was not begun");
    out->place = PAGE_ROW;
    fputs("</td>", out->html);
}

void page_cell(page *out, const char *kind, const char *format, ...) {
    va_list arguments;
    begin_cell(out, kind, "word");
    va_start(arguments, format);
    page_markup_format(out->html, format, arguments);
    va_end(arguments);
    page_cell_end(out);
}

void page_cell_number(page *out, const char *kind, const csv_table *table, int row,
                      const char *column, const char *format) {
    char *end;
    const char *const text = csv_text(table, row, column);
    strtod(text, &end);
    begin_cell(out, kind, *end == '\0' ? "number" : "word");
    page_number(out, table, row, column, format);
    page_cell_end(out);
}

void page_table_end(page *out) {
    end_row(out);
    out->place = PAGE_BETWEEN;
    fputs("</tbody></table></div></figure>\n", out->html);
}

void page_fold(page *out, const char *words) {
    demand_place(out, PAGE_BETWEEN, "a fold within something");
    ++out->folds;
    fputs("<details><summary>", out->html);
    page_markup(out->html, words);
    fputs("</summary>\n", out->html);
}

void page_fold_end(page *out) {
    demand_place(out, PAGE_BETWEEN, "something is not ended in a fold");
    demand(out, out->folds > 0, "the end of a fold that was not begun");
    --out->folds;
    fputs("</details>\n", out->html);
}

void page_source(page *out, const char *name) {
    static const struct {
        const char *before, *after;
    } forms[] = {{"<p class=\"source\">From ", ".</p>\n"},
                 {" <span class=\"source\">From ", ".</span>"},
                 {"", ""}};
    demand(out, out->place == PAGE_BETWEEN || takes_words(out), "a source where none belongs");
    const int form = out->place == PAGE_BETWEEN ? 0 : out->place == PAGE_CELL ? 2 : 1;
    fprintf(out->html, "%s<a href=\"", forms[form].before);
    page_escape(out->html, name);
    fputs(".csv\">", out->html);
    page_escape(out->html, name);
    fprintf(out->html, ".csv</a>%s", forms[form].after);
}
