/* SPDX-License-Identifier: MIT
 *
 * report_bench [--quick] [--output FOLDER] [--build FOLDER] [PART...]
 * Measures what the report shows, into tables. All parts: a run that was interrupted goes on; named
 * ones are measured again. Ends with 3 where a promise is broken that does not depend on the
 * machine. */
#include "report_run.h"

#include <stdlib.h>
#include <string.h>

#include "csv.h"

#define PART(name) extern const report_part report_##name;
#include "report_list.h"
#undef PART

const report_part *const report_parts[] = {
#define PART(name) &report_##name,
#include "report_list.h"
#undef PART
};
const int report_part_count = sizeof report_parts / sizeof report_parts[0];

static int part_named(const char *name) {
    for (int i = 0; i < report_part_count; ++i) {
        if (strcmp(report_parts[i]->name, name) == 0) return i;
    }
    return -1;
}

/* Prints the promises that were broken; returns how many of those must hold on every machine. */
static int broken_promises(const report_options *options) {
    csv_table *const promises = csv_open(options->output, "promises");
    int broken = 0;
    for (int row = 0; row < csv_rows(promises); ++row) {
        if (strcmp(csv_text(promises, row, "kept"), "1") == 0) continue;
        const int measured = csv_text(promises, row, "kept")[0] != '\0';
        const int exact = strcmp(csv_text(promises, row, "exact"), "1") == 0;
        printf("%s: %s, seen %s, required %s\n",
               !measured ? "not measured"
               : exact   ? "BROKEN"
                         : "not reached",
               csv_text(promises, row, "promise"), csv_text(promises, row, "seen"),
               csv_text(promises, row, "required"));
        broken += exact && measured;
    }
    csv_close(promises);
    return broken;
}

int main(int argc, char **argv) {
    report_options options = {0, "build/report", "build"};
    char *const wanted = report_allocate((size_t)report_part_count);
    int named = 0;
    for (int i = 1; i < argc; ++i) {
        if (strcmp(argv[i], "--quick") == 0) {
            options.quick = 1;
        } else if (strcmp(argv[i], "--output") == 0 && i + 1 < argc) {
            options.output = argv[++i];
        } else if (strcmp(argv[i], "--build") == 0 && i + 1 < argc) {
            options.build = argv[++i];
        } else if (part_named(argv[i]) >= 0) {
            wanted[part_named(argv[i])] = 1;
            named = 1;
        } else {
            fprintf(stderr,
                    "usage: report_bench [--quick] [--output FOLDER] [--build FOLDER] [PART...]\n");
            return 2;
        }
    }
    report_lock(&options);
    if (named) {
        for (int i = 0; i < report_part_count; ++i) {
            if (wanted[i]) report_forget(&options, i);
        }
        report_run(&options, wanted, NULL);
        free(wanted);
        printf("tables that are made from these are as they were\n");
        return 0;
    }
    memset(wanted, 1, (size_t)report_part_count);
    const int goes_on = report_begin(&options);
    if (goes_on) printf("going on with the run that was interrupted\n");
    report_machine(&options);
    report_run(&options, wanted, goes_on ? "a" : "w");
    report_finish(&options);
    free(wanted);
    return broken_promises(&options) == 0 ? 0 : 3;
}
