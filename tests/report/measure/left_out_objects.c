/* SPDX-License-Identifier: MIT
 *
 * sizes.csv, size_map.csv, instructions.csv: what is left out of a link and of loops. Scripts in
 * the folder above do it, from the top of the tree, with the compiler of this build and the tools
 * that came with it. Where they cannot, SPT_REQUIRE=1 ends the program; else sizes has a row
 * without numbers and the other tables have no rows. */
#define _POSIX_C_SOURCE 200809L
#include "../report.h"

#include <stdlib.h>
#include <string.h>

static int one(const report_options *options) {
    (void)options;
    return 1;
}

/* Copies what a script prints, if it ends well. Returns whether it did. */
static int copy_rows(const char *command, FILE *rows) {
    size_t size = 0, capacity = 1 << 20;
    char *const text = report_allocate(capacity);
    FILE *const pipe = popen(command, "r");
    if (pipe != NULL) size = fread(text, 1, capacity, pipe);
    report_expect(size < capacity, "a script has too much to say");
    const int good = pipe != NULL && pclose(pipe) == 0 && size > 0;
    if (good) fwrite(text, 1, size, rows);
    free(text);
    return good;
}

static int run_script(const report_options *options, const char *script, const char *mode,
                      FILE *rows) {
    char command[4096];
    const int length =
        snprintf(command, sizeof command,
                 "folder='%s/left_out'; sh tests/report/%s %s '%s' \"$folder\"; good=$?; "
                 "rm -rf \"$folder\"; exit $good",
                 options->output, script, mode, options->build);
    report_expect(length > 0 && (size_t)length < sizeof command, "the folder's name is too long");
    if (copy_rows(command, rows)) return 1;
    const char *const required = getenv("SPT_REQUIRE");
    fprintf(stderr, "skipped: tests/report/%s %s failed\n", script, mode);
    report_expect(required == NULL || strcmp(required, "1") != 0, "what is required failed");
    return 0;
}

static void measure_sizes(const report_options *options, int cell, FILE *rows) {
    (void)cell;
    if (!run_script(options, "left_out_sizes.sh", "sizes", rows)) fputs("minimal,,,,,,,,,\n", rows);
}

static void measure_map(const report_options *options, int cell, FILE *rows) {
    (void)cell;
    run_script(options, "left_out_sizes.sh", "map", rows);
}

static void measure_instructions(const report_options *options, int cell, FILE *rows) {
    (void)cell;
    run_script(options, "left_out_instructions.sh", options->quick ? "quick" : "full", rows);
}

const report_part report_sizes = {"sizes",
                                  "program,features,isas,library_bytes,text_bytes,objects,constant_"
                                  "bytes,unwind_bytes,added_bytes,"
                                  "promised",
                                  one,
                                  measure_sizes,
                                  0,
                                  {3, 3}};

const report_part report_size_map = {
    "size_map", "program,object,bytes,text_bytes", one, measure_map, 0, {0.2, 0.2}};

const report_part report_instructions = {
    "instructions",
    "feature,method,isa,cut,off,on,off_whole,on_whole,identical,same",
    one,
    measure_instructions,
    0,
    {25, 13}};
