/* SPDX-License-Identifier: MIT
 *
 * The section on what a scene leaves out, and of it the objects that a static link takes. */
#include "page_left_out.h"

#include <math.h>
#include <string.h>

enum { most_programs = 32, programs_of_all = 2 /* the last ones, which are everything */ };

static void plot_programs(page *out, const csv_table *sizes) {
    static const char *names[most_programs];
    static double x[most_programs], kibibytes[most_programs];
    const double promised = csv_number(sizes, 0, "promised");
    const int rows = csv_rows(sizes) - programs_of_all;
    int count = 0;
    plot drawn = {0};
    for (int row = 0; row < rows && count < most_programs; ++row) {
        names[count] = csv_text(sizes, row, "program");
        kibibytes[count] = csv_number(sizes, row, "text_bytes") / 1024;
        x[count] = count;
        ++count;
    }
    drawn.title = "What a program carries of the library";
    drawn.x.title = "what a program uses besides one sphere and basic tracing (minimal)";
    drawn.x.names = names;
    drawn.x.name_count = count;
    drawn.y.title = "code, KiB";
    drawn.width = 720;
    plot_add(&drawn, NULL, PLOT_BARS, count, x, kibibytes);
    if (!isnan(promised)) plot_add_mark(&drawn, 0, promised / 1024, "promised for minimal");
    page_figure(out, "left_out_sizes", &drawn);
    page_words(out, "Library code that programs carry, for all instruction sets together (");
    page_number(out, sizes, 0, "isas", "");
    page_words(out, "), from the map that the linker writes. Each bar is a program that does one "
                    "thing more than the first. What is not called is not there; all that is "
                    "linked is linked for every set, since the set is chosen when it runs. ");
    page_source(out, "sizes");
    page_figure_end(out);
}

static void table_programs(page *out, const csv_table *sizes) {
    page_fold(out, "The sizes in bytes, and what is code");
    page_table(out, "Bytes of the archive's objects in each program: all sections that are loaded.",
               "program|what it uses|library|code|constants|unwinding|objects|more than minimal");
    for (int row = 0; row < csv_rows(sizes); ++row) {
        page_row(out);
        page_cell_number(out, NULL, sizes, row, "program", "");
        page_cell_number(out, NULL, sizes, row, "features", "");
        page_cell_number(out, NULL, sizes, row, "library_bytes", "%.0f");
        page_cell_number(out, NULL, sizes, row, "text_bytes", "%.0f");
        page_cell_number(out, NULL, sizes, row, "constant_bytes", "%.0f");
        page_cell_number(out, NULL, sizes, row, "unwind_bytes", "%.0f");
        page_cell_number(out, NULL, sizes, row, "objects", "%.0f");
        page_cell_number(out, NULL, sizes, row, "added_bytes", "%.0f");
    }
    page_table_end(out);
    page_source(out, "sizes");
    page_fold_end(out);
}

/* What objects are for, by how their names begin. */
static const char *purpose_of(const char *object) {
    static const struct {
        const char *begins, *purpose;
    } purposes[] = {
        {"basic_", "the kernel of the step rule, once for each set of wanted results"},
        {"basic", "the step rule: its name, its shader, its kernels"},
        {"chunk_table", "the kernels of chunks by instruction set"},
        {"chunk_", "rays into their own units, bounds, compaction"},
        {"chunk", "the life of a chunk, from loading to results"},
        {"bound_check", "checks of bounding volumes"},
        {"bound", "bounding volumes"},
        {"special", "starts on surfaces, brackets around jumps, last samples of candidates"},
        {"trace", "the public call"},
        {"leave", "writing of results"},
        {"narrow", "bounding volumes by callback"},
        {"taken", "checks of fields and settings"},
        {"isa", "the choice of an instruction set"},
    };
    for (size_t i = 0; i < sizeof purposes / sizeof purposes[0]; ++i) {
        if (strncmp(object, purposes[i].begins, strlen(purposes[i].begins)) == 0) {
            return purposes[i].purpose;
        }
    }
    return "";
}

static void table_map(page *out) {
    csv_table *const map = csv_open(out->tables, "size_map");
    page_table(out, "The map of the minimal program: which objects of the archive it carries.",
               "object|bytes|of which code|what it is");
    for (int row = 0; row < csv_rows(map); ++row) {
        page_row(out);
        page_cell_number(out, NULL, map, row, "object", "");
        page_cell_number(out, NULL, map, row, "bytes", "%.0f");
        page_cell_number(out, NULL, map, row, "text_bytes", "%.0f");
        page_cell(out, "quiet", "%s", purpose_of(csv_text(map, row, "object")));
    }
    page_table_end(out);
    page_source(out, "size_map");
    csv_close(map);
}

void left_out_objects(page *out) {
    csv_table *const sizes = csv_open(out->tables, "sizes");
    const double bytes = csv_number(sizes, 0, "text_bytes");
    const int kept = bytes <= csv_number(sizes, 0, "promised");
    page_heading(out, "Objects: what a program links");
    page_begin(out);
    if (isnan(bytes)) {
        page_words(out, "Not measured on this machine: that takes a linker that writes maps.");
        page_end(out);
        csv_close(sizes);
        return;
    }
    page_words(out, "A static link takes the objects that a program names, one a capability, step "
                    "rule and instruction set. The smallest program, one sphere and basic "
                    "tracing, carries ");
    page_number(out, sizes, 0, "text_bytes", "%.0f");
    page_words(out, " bytes of code, ");
    page_number(out, sizes, 0, "library_bytes", "%.0f");
    page_words(out, " with constants and what unwinding needs; promised are at most ");
    page_number(out, sizes, 0, "promised", "%.0f");
    page_words(
        out, kept ? " of code. The promise is kept."
                  : " of code: *the promise is not kept*. What the program carries without use are "
                    "kernels for results that it does not ask for, and bounding volumes: "
                    "whether a call wants them shows only when it runs.");
    page_end(out);
    plot_programs(out, sizes);
    table_programs(out, sizes);
    table_map(out);
    csv_close(sizes);
}

void page_left_out(page *out) {
    page_section(out, "left_out", "What a scene leaves out");
    page_begin(out);
    page_words(out,
               "What a program does not use should cost it nothing. There are four levels on which "
               "things are left out: objects of the link, instructions of the loops, components "
               "of the scene in each tile of a picture, and functions of emitted shaders.");
    page_end(out);
    left_out_objects(out);
    left_out_loops(out);
    left_out_tiles(out);
    left_out_shaders(out);
}
