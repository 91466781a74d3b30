/* SPDX-License-Identifier: MIT
 *
 * Writing and reading parts of a picture, byte by byte. What is read comes from elsewhere and is
 * trusted with nothing. */
#include "part_file.h"

#include "step_rules.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* The settings in their order in the file, by the names that messages use. */
static const char *const setting_names[] = {"version of the library",
                                            "kind",
                                            "width",
                                            "height",
                                            "region",
                                            "region",
                                            "region",
                                            "region",
                                            "samples",
                                            "budget",
                                            "epsilon",
                                            "pixel cone",
                                            "shadows",
                                            "union",
                                            "number of panels",
                                            "step rule",
                                            "tile flags",
                                            "step rule",
                                            "tile flags",
                                            "step rule",
                                            "tile flags",
                                            "step rule",
                                            "tile flags",
                                            "count of parts"};
enum {
    setting_count = sizeof setting_names / sizeof setting_names[0],
    name_size = 32,
    counts_of_panel = 11
};
static const char magic[8] = {'S', 'P', 'T', 'P', 'A', 'R', 'T', '1'};

/* What stands before the counts. */
typedef struct header {
    uint32_t settings[setting_count];
    char name[name_size];
    uint32_t part;
} header;

void part_pieces(const picture_job *job, int part, int of, size_t *first, size_t *end) {
    const size_t pieces = picture_pieces(job);
    const size_t each = pieces / (size_t)of, longer = pieces % (size_t)of;
    const size_t before = (size_t)part - 1;
    *first = before * each + (before < longer ? before : longer);
    *end = *first + each + (before < longer ? 1 : 0);
}

/* ---- Bytes --------------------------------------------------------------------------------- */

typedef struct stream {
    FILE *file;
    uint64_t checksum;
    int failed;
} stream;

static stream stream_of(FILE *file) {
    const stream result = {file, UINT64_C(14695981039346656037), 0};
    return result;
}

/* FNV-1a (Fowler, Noll & Vo; draft-eastlake-fnv). */
static void add_to_checksum(stream *bytes, unsigned char byte) {
    bytes->checksum = (bytes->checksum ^ byte) * UINT64_C(1099511628211);
}

static void put(stream *to, uint64_t value, int size) {
    for (int i = 0; i < size; ++i) {
        const unsigned char byte = (unsigned char)(value >> (8 * i) & 255);
        add_to_checksum(to, byte);
        if (putc(byte, to->file) == EOF) to->failed = 1;
    }
}

static uint64_t get(stream *from, int size) {
    uint64_t value = 0;
    for (int i = 0; i < size; ++i) {
        const int byte = getc(from->file);
        if (byte == EOF) from->failed = 1;
        add_to_checksum(from, (unsigned char)byte);
        value |= (uint64_t)(unsigned char)byte << (8 * i);
    }
    return value;
}

static uint32_t bits_of(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static float float_of(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* ---- Settings and counts ------------------------------------------------------------------- */

static header header_of(const picture_job *job, int part, int of) {
    header made;
    size_t n = 0;
    memset(&made, 0, sizeof made);
    made.settings[n++] = (uint32_t)spt_version();
    made.settings[n++] = (uint32_t)job->kind;
    made.settings[n++] = (uint32_t)job->width;
    made.settings[n++] = (uint32_t)job->height;
    made.settings[n++] = (uint32_t)job->left;
    made.settings[n++] = (uint32_t)job->top;
    made.settings[n++] = (uint32_t)job->right;
    made.settings[n++] = (uint32_t)job->bottom;
    made.settings[n++] = (uint32_t)job->samples;
    made.settings[n++] = job->budget;
    made.settings[n++] = bits_of(job->epsilon);
    made.settings[n++] = (uint32_t)job->pixel_cone;
    made.settings[n++] = (uint32_t)job->shadows;
    made.settings[n++] = (uint32_t)job->whole;
    made.settings[n++] = (uint32_t)job->panel_count;
    for (int i = 0; i < picture_panels; ++i, n += 2) {
        uint32_t rule = 0;
        if (i >= job->panel_count) continue;
        while (step_rule(rule) != job->panels[i].method) ++rule;
        made.settings[n] = rule;
        made.settings[n + 1] = job->panels[i].flags;
    }
    made.settings[n] = (uint32_t)of;
    strncpy(made.name, job->shown->name, name_size - 1);
    made.part = (uint32_t)part;
    return made;
}

/* The job of a header; its shown is NULL where that is no picture of this program. */
static picture_job job_of(const header *read) {
    const uint32_t *value = read->settings;
    picture_job job = picture_job_default(NULL);
    for (int i = 2; i <= 8; ++i) {
        if (value[i] > image_largest_side) return job;
    }
    picture_set_size(&job, (int)value[2], (int)value[3]);
    job.kind = (picture_kind)(value[1] < picture_kinds ? value[1] : 0);
    job.left = (int)value[4];
    job.top = (int)value[5];
    job.right = (int)value[6];
    job.bottom = (int)value[7];
    job.samples = (int)value[8];
    job.budget = value[9];
    job.epsilon = float_of(value[10]);
    job.pixel_cone = value[11] != 0;
    job.shadows = value[12] != 0;
    job.whole = value[13] != 0;
    job.panel_count = value[14] <= picture_panels ? (int)value[14] : 0;
    for (int i = 0; i < job.panel_count; ++i) {
        const uint32_t rule = value[15 + 2 * i];
        job.panels[i].method = rule < 16 ? step_rule(rule) : NULL;
        job.panels[i].flags = value[16 + 2 * i];
        if (job.panels[i].method == NULL) return job;
    }
    const int sound = value[1] < picture_kinds && job.panel_count > 0 && job.samples >= 1 &&
                      job.samples <= picture_largest_samples && job.left < job.right &&
                      job.right <= job.width && job.top < job.bottom && job.bottom <= job.height;
    if (sound) job.shown = scene_named(read->name);
    return job;
}

/* The counts that are kept, as pointers, so that writing and reading walk the same list. */
static void counts_of(spt_statistics *of, uint64_t *counts[counts_of_panel]) {
    int n = 0;
    counts[n++] = &of->rays;
    for (int i = 0; i < SPT_OUTCOMES; ++i) counts[n++] = &of->outcomes[i];
    counts[n++] = &of->evaluations;
    counts[n++] = &of->fallbacks;
    counts[n++] = &of->cone_evaluations;
    counts[n++] = &of->kept;
    counts[n++] = &of->culled;
}

/* How many values a piece has. */
static size_t piece_size(const film *exposed, size_t piece) {
    int area[4];
    picture_piece_area(&exposed->job, piece, area);
    return (size_t)(area[2] - area[0]) * (size_t)(area[3] - area[1]) * (size_t)exposed->channels;
}

/* ---- Writing ------------------------------------------------------------------------------- */

int part_write(const char *path, const film *exposed, int part, int of) {
    const header made = header_of(&exposed->job, part, of);
    errno = 0;
    stream to = stream_of(fopen(path, "wb"));
    if (to.file == NULL) return -1;
    for (size_t i = 0; i < sizeof magic; ++i) put(&to, (unsigned char)magic[i], 1);
    for (size_t i = 0; i < setting_count; ++i) put(&to, made.settings[i], 4);
    for (size_t i = 0; i < name_size; ++i) put(&to, (unsigned char)made.name[i], 1);
    put(&to, made.part, 4);
    for (int panel = 0; panel < picture_panels; ++panel) {
        spt_statistics copy = exposed->statistics[panel];
        uint64_t *counts[counts_of_panel];
        counts_of(&copy, counts);
        for (int i = 0; i < counts_of_panel; ++i) put(&to, *counts[i], 8);
    }
    for (size_t piece = exposed->first; piece < exposed->end; ++piece) {
        const float *values = film_piece(exposed, piece);
        const size_t size = piece_size(exposed, piece);
        for (size_t i = 0; i < size; ++i) put(&to, bits_of(values[i]), 4);
    }
    put(&to, to.checksum, 8);
    if (fclose(to.file) != 0) to.failed = 1;
    return to.failed ? -1 : 0;
}

/* ---- Merging ------------------------------------------------------------------------------- */

/* What has been put together so far. */
typedef struct merging {
    header first; /* of the first file */
    film film;
    const char **owners; /* the file that brought each part */
    const char *path;    /* being read */
} merging;

/* Prints a message about the file being read. Returns 0. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static int
refuse(const merging *all, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "%s: ", all->path);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    return 0;
}

/* Reads what is before the counts. Returns 0 after a message. */
static int read_header(merging *all, stream *from, header *read) {
    memset(read, 0, sizeof *read);
    for (size_t i = 0; i < sizeof magic; ++i) {
        if (get(from, 1) != (unsigned char)magic[i]) return refuse(all, "is no part of a picture");
    }
    for (size_t i = 0; i < setting_count; ++i) read->settings[i] = (uint32_t)get(from, 4);
    for (size_t i = 0; i < name_size; ++i) read->name[i] = (char)get(from, 1);
    read->name[name_size - 1] = '\0';
    read->part = (uint32_t)get(from, 4);
    if (from->failed) return refuse(all, "ends too early");
    return 1;
}

/* Prepares the film for the picture of the first file. Returns 0 after a message. */
static int begin(merging *all, const header *read) {
    const uint32_t of = read->settings[setting_count - 1];
    const picture_job job = job_of(read);
    if (read->settings[0] != (uint32_t)spt_version()) {
        return refuse(all, "was traced by another version of the library");
    }
    if (job.shown == NULL || of < 1 || of > part_most || read->part < 1 || read->part > of) {
        return refuse(all, "is of no picture that is known here");
    }
    all->first = *read;
    all->film = film_create(&job, 0, picture_pieces(&job));
    all->owners = calloc(of, sizeof *all->owners);
    if (all->film.values == NULL || all->owners == NULL) return refuse(all, "out of memory");
    return 1;
}

/* Whether a part belongs to the first file's picture and is not there yet; 0 after a message. */
static int belongs(merging *all, const header *read) {
    for (size_t i = 0; i < setting_count; ++i) {
        if (read->settings[i] != all->first.settings[i]) {
            return refuse(all, "belongs to another picture: its %s differs", setting_names[i]);
        }
    }
    if (strcmp(read->name, all->first.name) != 0) {
        return refuse(all, "belongs to another picture: of scene %s", read->name);
    }
    if (read->part < 1 || read->part > read->settings[setting_count - 1]) {
        return refuse(all, "is damaged");
    }
    const char *owner = all->owners[read->part - 1];
    if (owner != NULL) {
        return refuse(all, "is part %lu once more, after %s", (unsigned long)read->part, owner);
    }
    return 1;
}

/* Reads one part. Returns 0 after a message. */
static int read_part(merging *all, FILE *file) {
    stream from = stream_of(file);
    header read;
    size_t first, end;
    if (!read_header(all, &from, &read)) return 0;
    if (all->owners == NULL && !begin(all, &read)) return 0;
    if (!belongs(all, &read)) return 0;
    all->owners[read.part - 1] = all->path;
    for (int panel = 0; panel < picture_panels; ++panel) {
        uint64_t *counts[counts_of_panel];
        counts_of(&all->film.statistics[panel], counts);
        for (int i = 0; i < counts_of_panel; ++i) *counts[i] += get(&from, 8);
    }
    part_pieces(&all->film.job, (int)read.part, (int)read.settings[setting_count - 1], &first,
                &end);
    for (size_t piece = first; piece < end && !from.failed; ++piece) {
        float *values = film_piece(&all->film, piece);
        const size_t size = piece_size(&all->film, piece);
        for (size_t i = 0; i < size; ++i) values[i] = float_of((uint32_t)get(&from, 4));
        all->film.done[piece] = 1;
    }
    const uint64_t checksum = from.checksum;
    if (get(&from, 8) != checksum || from.failed || getc(file) != EOF) {
        return refuse(all, "is damaged");
    }
    return 1;
}

film part_merge(char *const *paths, int count) {
    merging all;
    int sound = 1;
    memset(&all, 0, sizeof all);
    for (int i = 0; i < count && sound; ++i) {
        all.path = paths[i];
        FILE *file = fopen(paths[i], "rb");
        sound = file != NULL ? read_part(&all, file) : refuse(&all, "%s", strerror(errno));
        if (file != NULL) fclose(file);
    }
    const uint32_t of = sound ? all.first.settings[setting_count - 1] : 0;
    for (uint32_t part = 0; part < of; ++part) {
        if (all.owners[part] != NULL) continue;
        fprintf(stderr, "part %lu of %lu is missing\n", (unsigned long)part + 1, (unsigned long)of);
        sound = 0;
    }
    if (!sound) film_free(&all.film);
    free(all.owners);
    return all.film;
}
