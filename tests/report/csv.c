/* SPDX-License-Identifier: MIT
 *
 * Tables of the report, held whole in memory. Left out: quotes, which no cell has. */
#include "csv.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { most_columns = 64, most_pairs = 8, longest_where = 512 };

struct csv_table {
    char *name, *text; /* the file, cut into cells */
    const char **cell; /* of all rows, columns side by side; the header first */
    int columns, rows;
};

static void broken(const char *name, const char *what, const char *which) {
    fprintf(stderr, "%s.csv: %s%s\n", name, what, which);
    exit(1);
}

static void *allocated(size_t size) {
    void *const memory = malloc(size != 0 ? size : 1);
    if (memory == NULL) broken("csv", "out of memory", "");
    return memory;
}

static FILE *opened(const char *folder, const char *name) {
    char *const path = allocated(strlen(folder) + strlen(name) + sizeof "/.csv");
    sprintf(path, "%s/%s.csv", folder, name);
    FILE *const file = fopen(path, "rb");
    free(path);
    return file;
}

int csv_exists(const char *folder, const char *name) {
    FILE *const file = opened(folder, name);
    if (file == NULL) return 0;
    fclose(file);
    return 1;
}

static char *text_of(const char *folder, const char *name) {
    FILE *const file = opened(folder, name);
    if (file == NULL) broken(name, "is not in the folder ", folder);
    size_t size = 0, room = 65536, got;
    char *text = allocated(room + 1);
    while ((got = fread(text + size, 1, room - size, file)) > 0) {
        size += got;
        if (size < room) continue;
        room *= 2;
        text = realloc(text, room + 1);
        if (text == NULL) broken(name, "out of memory", "");
    }
    if (ferror(file) || memchr(text, '\0', size) != NULL) broken(name, "cannot be read", "");
    fclose(file);
    text[size] = '\0';
    return text;
}

/* Cuts a line into cells; returns how many. */
static int cut(char *line, const char **cell, int most) {
    int count = 0;
    for (char *from = line;; ++count) {
        char *const comma = strchr(from, ',');
        if (count < most) cell[count] = from;
        if (comma == NULL) return count + 1;
        *comma = '\0';
        from = comma + 1;
    }
}

/* Ends the line at `from` and returns where the next begins. */
static char *end_line(char *from) {
    char *const end = from + strcspn(from, "\n");
    char *const next = *end == '\n' ? end + 1 : end;
    *end = '\0';
    if (end > from && end[-1] == '\r') end[-1] = '\0';
    return next;
}

csv_table *csv_open(const char *folder, const char *name) {
    csv_table *const table = allocated(sizeof *table);
    const char *header[most_columns];
    table->name = allocated(strlen(name) + 1);
    strcpy(table->name, name);
    table->text = text_of(folder, name);
    size_t lines = 1;
    for (const char *at = table->text; *at != '\0'; ++at) lines += *at == '\n';
    const char *const end = table->text + strlen(table->text);
    char *line = table->text, *next = end_line(line);
    table->columns = cut(line, header, most_columns);
    if (table->columns > most_columns) broken(name, "has too many columns", "");
    table->cell = allocated(lines * (size_t)table->columns * sizeof *table->cell);
    memcpy(table->cell, header, (size_t)table->columns * sizeof *table->cell);
    table->rows = 0;
    for (line = next; line < end; line = next) {
        char number[32];
        next = end_line(line);
        sprintf(number, "%d", table->rows + 2);
        ++table->rows;
        if (cut(line, table->cell + (size_t)table->rows * (size_t)table->columns, table->columns) !=
            table->columns) {
            broken(name, "has too few or too many cells in line ", number);
        }
    }
    return table;
}

void csv_close(csv_table *table) {
    if (table == NULL) return;
    free(table->cell);
    free(table->text);
    free(table->name);
    free(table);
}

const char *csv_name(const csv_table *table) {
    return table->name;
}

int csv_rows(const csv_table *table) {
    return table->rows;
}

static int column_of(const csv_table *table, const char *column) {
    for (int i = 0; i < table->columns; ++i) {
        if (strcmp(table->cell[i], column) == 0) return i;
    }
    broken(table->name, "has no column ", column);
    return 0;
}

static const char *cell_at(const csv_table *table, int row, int column) {
    return table->cell[(size_t)(row + 1) * (size_t)table->columns + (size_t)column];
}

const char *csv_text(const csv_table *table, int row, const char *column) {
    if (row < 0 || row >= table->rows)
        broken(table->name, "is asked for a row it has not, ", column);
    return cell_at(table, row, column_of(table, column));
}

static double number_in(const csv_table *table, const char *text) {
    char *end;
    if (text[0] == '\0') return (double)NAN;
    const double number = strtod(text, &end);
    if (*end != '\0') broken(table->name, "is asked for a number, and has ", text);
    return number;
}

double csv_number(const csv_table *table, int row, const char *column) {
    return number_in(table, csv_text(table, row, column));
}

/* What the cells of a row must be. */
typedef struct condition {
    char text[longest_where];
    int count, column[most_pairs];
    const char *value[most_pairs];
} condition;

/* Takes condition->text apart. */
static void understand(const csv_table *table, condition *where) {
    where->count = 0;
    char *comma = where->text[0] == '\0' ? NULL : where->text;
    while (comma != NULL) {
        char *const pair = comma, *const equals = strchr(pair, '=');
        comma = strchr(pair, ',');
        if (comma != NULL) *comma++ = '\0';
        if (equals == NULL || strchr(pair, '=') == NULL || where->count == most_pairs) {
            broken(table->name, "does not understand ", pair);
        }
        *equals = '\0';
        where->column[where->count] = column_of(table, pair);
        where->value[where->count++] = equals + 1;
    }
}

static int next_row(const csv_table *table, int row, const condition *where) {
    while (++row < table->rows) {
        int i = 0;
        while (i < where->count &&
               strcmp(cell_at(table, row, where->column[i]), where->value[i]) == 0) {
            ++i;
        }
        if (i == where->count) return row;
    }
    return -1;
}

int csv_next(const csv_table *table, int row, const char *where, ...) {
    condition asked;
    va_list arguments;
    va_start(arguments, where);
    const int length = vsnprintf(asked.text, sizeof asked.text, where, arguments);
    va_end(arguments);
    if (length < 0 || length >= longest_where) broken(table->name, "is asked too much: ", where);
    understand(table, &asked);
    return next_row(table, row, &asked);
}

int csv_distinct(const csv_table *table, const char *column, const char **texts, int most) {
    const int place = column_of(table, column);
    int count = 0;
    for (int row = 0; row < table->rows && count < most; ++row) {
        const char *const text = cell_at(table, row, place);
        int i = 0;
        while (i < count && strcmp(texts[i], text) != 0) ++i;
        if (i == count) texts[count++] = text;
    }
    return count;
}

int csv_points(const csv_table *table, const char *where, const char *x_column,
               const char *y_column, double *x, double *y, int most) {
    condition asked;
    const int x_place = column_of(table, x_column), y_place = column_of(table, y_column);
    int count = 0;
    if (strlen(where) >= longest_where) broken(table->name, "is asked too much: ", where);
    strcpy(asked.text, where);
    understand(table, &asked);
    for (int row = next_row(table, -1, &asked); row >= 0 && count < most;
         row = next_row(table, row, &asked)) {
        x[count] = number_in(table, cell_at(table, row, x_place));
        y[count] = number_in(table, cell_at(table, row, y_place));
        if (!isnan(x[count]) && !isnan(y[count])) ++count;
    }
    return count;
}
