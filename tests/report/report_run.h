/* SPDX-License-Identifier: MIT
 *
 * Running the parts of the report: cell by cell into files of their own, so that an interrupted run
 * goes on where it was. */
#ifndef TESTS_REPORT_REPORT_RUN_H
#define TESTS_REPORT_REPORT_RUN_H

#include "report.h"

/* Nobody else may run in the folder from here on; ends the program where somebody does. */
void report_lock(const report_options *options);

/* Runs the parts whose wanted[] is not 0, in order; their tables and cells that are there already
 * are kept. parts: NULL, or how to open parts.csv, "w" or "a", for `part,cells,resumed,seconds` (of
 * wall time, since the last interruption) of those that were not finished before. */
void report_run(const report_options *options, const char *wanted, const char *parts);

/* Makes the folder ready for a run of all parts: goes on with one that the same program began on
 * this machine in the same mode and did not finish, else begins anew. Returns whether it goes on. */
int report_begin(const report_options *options);

/* Takes back what is there of a part, so that it is measured again. */
void report_forget(const report_options *options, int part);

/* A run of all parts has come to its end. */
void report_finish(const report_options *options);

/* Writes machine.csv: `what,value`. */
void report_machine(const report_options *options);

#endif
