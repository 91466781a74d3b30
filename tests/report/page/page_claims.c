/* SPDX-License-Identifier: MIT
 *
 * The section on the papers' claims: the verdicts. Left out: plots, see page_claims_plots.c. */
#include <string.h>

#include "page_claims.h"

static void printed(page *out, const csv_table *claims, int row) {
    const double low = csv_number(claims, row, "printed_low");
    const double high = csv_number(claims, row, "printed_high");
    page_cell_begin(out, NULL);
    if (low < high) {
        page_number(out, claims, row, "printed_low", "%.2f");
        page_words(out, " to ");
    } else if (!(low == low) && high == high) {
        page_words(out, "up to ");
    }
    page_number(out, claims, row, "printed_high", "%.2f");
    page_cell_end(out);
}

static void ours(page *out, const csv_table *claims, int row) {
    /* A correlation is told by the third digit. */
    const int close = strncmp(csv_text(claims, row, "unit"), "R²", strlen("R²")) == 0;
    const char *const format = close ? "%.3f" : "%.2f";
    page_cell_begin(out, NULL);
    page_number(out, claims, row, "ours", format);
    page_words(out, " ");
    page_number(out, claims, row, "unit", "");
    page_words(out, " (");
    page_number(out, claims, row, "ours_low", format);
    page_words(out, " to ");
    page_number(out, claims, row, "ours_high", format);
    page_words(out, ")");
    page_cell_end(out);
}

/* Which claim it is, and where it stands. */
static void headline(page *out, const csv_table *claims, int row) {
    page_cell_begin(out, NULL);
    page_number(out, claims, row, "number", "");
    page_words(out, ". ");
    page_number(out, claims, row, "claim", "");
    page_words(out, " (");
    page_number(out, claims, row, "paper", "");
    page_words(out, ", section ");
    page_number(out, claims, row, "section", "");
    page_words(out, ")");
    page_cell_end(out);
}

static void verdicts(page *out, const csv_table *claims) {
    page_table(out,
               "The papers' headlines, what they print, and what this run came to. In brackets the "
               "quartiles of the rounds or a range, as the last column says.",
               "headline|printed|ours|verdict|how, and why");
    for (int row = 0; row < csv_rows(claims); ++row) {
        const char *const verdict = csv_text(claims, row, "verdict");
        page_row(out);
        headline(out, claims, row);
        printed(out, claims, row);
        ours(out, claims, row);
        page_cell_number(out, strcmp(verdict, "not reached") == 0 ? "bad" : "good", claims, row,
                         "verdict", "");
        page_cell_number(out, "quiet", claims, row, "why", "");
    }
    page_table_end(out);
    page_source(out, "claims");
}

void page_claims(page *out) {
    csv_table *const claims = csv_open(out->tables, "claims");
    page_section(out, "claims", "The papers' claims beside ours");
    page_begin(out);
    page_words(
        out,
        "The papers measured on graphics cards (^GTX Titan, GTX 1080 Ti, GTX Titan X^), this is "
        "one thread of a processor, so only ratios are compared. Each is judged by the unit of "
        "the paper, by a rule that stands in `tests/report/measure/claims.c` beside the claim: "
        "a gain is *reached* where the middle of the rounds is as large as what is printed, "
        "and *exceeded* where even the lower quartile is as large as the most that is printed; "
        "costs the other way round.");
    page_end(out);
    verdicts(out, claims);
    csv_close(claims);
    page_claims_steps(out);
    page_claims_error(out);
    page_claims_levels(out);
    page_claims_secondary(out);
}
