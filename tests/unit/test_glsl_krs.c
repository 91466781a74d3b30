/* SPDX-License-Identifier: MIT
 *
 * The text of kernel-reflection sequences and what is made of them: that it holds what a model
 * needs and nothing else. What it computes is compared on engines, in tests/glsl. */
#include "../check.h"

#include <spheretrace/spheretrace.h>

#include <math.h>
#include <string.h>

enum { capacity = 1 << 17 };
static char text[capacity];

/* Writes a program for the field into text. */
static spt_status emit(const spt_field *field, uint32_t program, uint32_t features) {
    const spt_settings settings = spt_settings_default();
    spt_glsl_options options = spt_glsl_options_default();
    options.field = field;
    options.settings = &settings;
    options.target = SPT_GLSL_COMPUTE_450;
    options.program = program;
    options.features = features;
    memset(text, 0, sizeof text);
    return spt_glsl_emit(&options, text, sizeof text, NULL);
}

/* How often a word of code, or the beginning of one, is in the text. */
static int count_of(const char *word) {
    int count = 0;
    for (const char *at = strstr(text, word); at != NULL; at = strstr(at + 1, word)) ++count;
    return count;
}

/* ---- Models ---------------------------------------------------------------------------------- */

static float some_number(void) {
    return (float)check_uniform(-1, 1);
}

static float unit_ball(void *user, float x, float y, float z) {
    (void)user;
    return sqrtf(x * x + y * y + z * z) - 1;
}

static spt_field caller_field(const char *body) {
    static const spt_bound bound = {
        .struct_size = sizeof bound, .kind = SPT_BOUND_SPHERE, .radius = 2};
    spt_field field = spt_field_default();
    field.point = unit_ball;
    field.bound = &bound;
    field.glsl = body;
    field.glsl_prelude = "float ball(vec3 p) { return length(p) - 1.0; }\n";
    return field;
}

/* A kernel of a kind; `field` of one that is a field. */
static spt_kernel kernel_of(uint32_t kind, const spt_field *field) {
    const float a[3] = {some_number(), some_number(), some_number()};
    const float b[3] = {a[0] + 1, some_number(), some_number()};
    const float control[3] = {some_number(), some_number(), 2};
    const float across[3] = {0, some_number(), 1};
    switch (kind) {
    case SPT_KERNEL_SPHERE:
        return spt_kernel_sphere(a[0], a[1], a[2], 0.5f);
    case SPT_KERNEL_HALF_SPACE:
        return spt_kernel_half_space(a[0], a[1], 1, 0.5f);
    case SPT_KERNEL_CAPSULE:
        return spt_kernel_capsule(a, b, control, 0.25f);
    case SPT_KERNEL_LEAF:
        return spt_kernel_leaf(a, b, across, 0.25f, 0.1f);
    case SPT_KERNEL_FIELD:
        return spt_kernel_field(field);
    default:
        return spt_kernel_empty();
    }
}

/* Kernels in turn of those kinds. */
static void fill_kernels(spt_kernel *kernels, uint32_t levels, const uint32_t *kinds,
                         uint32_t kind_count, const spt_field *field) {
    for (uint32_t i = 0; i <= levels; ++i) kernels[i] = kernel_of(kinds[i % kind_count], field);
}

static spt_field make_krs(uint32_t levels, const uint32_t *kinds, uint32_t kind_count,
                          const spt_field *field, spt_krs *krs) {
    spt_kernel kernels[SPT_KRS_LEVELS + 1];
    spt_mirror mirrors[SPT_KRS_LEVELS];
    spt_krs_model model = spt_krs_model_default();
    fill_kernels(kernels, levels, kinds, kind_count, field);
    for (uint32_t i = 0; i < levels; ++i) {
        const spt_mirror mirror = {{some_number(), some_number(), 1}, some_number()};
        mirrors[i] = mirror;
    }
    model.levels = levels;
    model.kernels = kernels;
    model.mirrors = mirrors;
    CHECK(spt_krs_build(&model, krs) == SPT_OK);
    return spt_krs_field(krs);
}

static spt_field make_moekrs(uint32_t levels, const uint32_t *kinds, uint32_t kind_count,
                             const spt_field *field, const spt_mobius *map, spt_moekrs *moekrs) {
    spt_kernel kernels[SPT_KRS_LEVELS + 1];
    spt_mobius maps[SPT_KRS_LEVELS];
    spt_moekrs_model model = spt_moekrs_model_default();
    fill_kernels(kernels, levels, kinds, kind_count, field);
    for (uint32_t i = 0; i < levels; ++i) maps[i] = *map;
    model.levels = levels;
    model.kernels = kernels;
    model.maps = maps;
    CHECK(spt_moekrs_build(&model, moekrs) == SPT_OK);
    return spt_moekrs_field(moekrs);
}

/* About a point next to the origin: then preimages are computed as it is written. */
static spt_mobius inversion(void) {
    const double center[3] = {0.125, 0, 0};
    spt_mobius map = spt_mobius_identity();
    CHECK(spt_mobius_inversion(center, 1, &map) == SPT_OK);
    return map;
}

static spt_mobius translation(void) {
    const double by[3] = {-1, 0.5, 0};
    spt_mobius map = spt_mobius_identity();
    CHECK(spt_mobius_translation(by, &map) == SPT_OK);
    return map;
}

/* ---- Texts ----------------------------------------------------------------------------------- */

/* The function of a kind of kernel, and how often it is written and called. */
static const char *const functions[SPT_KERNEL_KINDS] = {
    "?", "spt_kernel_sphere(", "spt_kernel_half_space(", "spt_kernel_capsule(", "spt_kernel_leaf(",
    "?"};

/* Each pair of kinds: a call for each kernel, and the functions of no other kind. */
static void G1_only_what_occurs(void) {
    static spt_krs krs;
    for (uint32_t first = 0; first < SPT_KERNEL_FIELD; ++first) {
        for (uint32_t second = 0; second < SPT_KERNEL_FIELD; ++second) {
            const uint32_t kinds[2] = {first, second};
            const spt_field field = make_krs(1, kinds, 2, NULL, &krs);
            check_context("kinds %u and %u", (unsigned)first, (unsigned)second);
            CHECK(emit(&field, SPT_GLSL_POINTS, 0) == SPT_OK);
            for (uint32_t kind = 1; kind < SPT_KERNEL_FIELD; ++kind) {
                const int calls = (kind == first) + (kind == second);
                CHECK(count_of(functions[kind]) == (calls > 0 ? calls + 1 : 0));
            }
            const int arcs = first >= SPT_KERNEL_CAPSULE || second >= SPT_KERNEL_CAPSULE;
            CHECK((count_of("spt_arc_square(") > 0) == arcs);
            CHECK(count_of("p = spt_fold(") == 1);
            CHECK(count_of("spt_pull") == 0 && count_of("spt_nearer") == 0);
        }
    }
}

/* Empty kernels leave nothing but the fold, and one of nothing at all is infinitely far. */
static void G2_empty_kernels(void) {
    static spt_krs krs;
    const uint32_t nothing[1] = {SPT_KERNEL_EMPTY};
    const uint32_t rare[4] = {SPT_KERNEL_SPHERE, SPT_KERNEL_EMPTY, SPT_KERNEL_EMPTY,
                              SPT_KERNEL_EMPTY};
    spt_field field = make_krs(7, nothing, 1, NULL, &krs);
    CHECK(emit(&field, SPT_GLSL_POINTS, 0) == SPT_OK);
    CHECK(count_of("spt_kernel_") == 0 && count_of("min(") == 0);
    CHECK(count_of("p = spt_fold(") == 7);
    CHECK(count_of("float d = 3.0e38;\n") == 1 && count_of("return d;\n") == 1);
    field = make_krs(7, rare, 4, NULL, &krs);
    CHECK(emit(&field, SPT_GLSL_POINTS, 0) == SPT_OK);
    CHECK(count_of("d = min(d, ") == 2 && count_of("spt_kernel_sphere(") == 3);
    CHECK(emit(&field, SPT_GLSL_POINTS, SPT_GLSL_ARRAYS) == SPT_OK);
    CHECK(count_of("sphere_center[2] = vec3[2](") == 1);
    CHECK(count_of("kernels[8] = ivec2[8](") == 1);
}

/* A line a level, or one in a loop. */
static void G3_folds(void) {
    static spt_krs krs;
    const uint32_t kinds[3] = {SPT_KERNEL_SPHERE, SPT_KERNEL_LEAF, SPT_KERNEL_CAPSULE};
    for (uint32_t levels = 0; levels <= SPT_KRS_LEVELS; levels = 2 * levels + 1) {
        const spt_field field = make_krs(levels, kinds, 3, NULL, &krs);
        check_context("%u levels", (unsigned)levels);
        CHECK(emit(&field, SPT_GLSL_POINTS, 0) == SPT_OK);
        CHECK(count_of("p = spt_fold(") == (int)levels);
        CHECK(count_of("d = min(d, ") == (int)levels + 1 && count_of("for (") == 0);
        CHECK(emit(&field, SPT_GLSL_POINTS, SPT_GLSL_ARRAYS) == SPT_OK);
        if (levels < 2) continue; /* nothing to loop over */
        CHECK(count_of("p = spt_fold(") == 1 && count_of("d = min(d, ") == 3);
        CHECK(count_of("for (") == 1);
    }
}

/* A level of capsules is a mirror of 4 numbers and a kernel of 17, one of maps 26 more, and a
 * number takes 16 bytes with what is around it at most; functions and lines take the rest. */
static void G4_sizes(void) {
    static spt_krs krs;
    static spt_moekrs moekrs;
    const uint32_t kinds[1] = {SPT_KERNEL_CAPSULE};
    const spt_mobius map = inversion();
    const spt_field field = make_krs(SPT_KRS_LEVELS, kinds, 1, NULL, &krs);
    const spt_field mapped = make_moekrs(SPT_KRS_LEVELS, kinds, 1, NULL, &map, &moekrs);
    const size_t numbers = 65 * 21 * 16, more = 64 * 26 * 16;
    CHECK(emit(&field, SPT_GLSL_POINTS, 0) == SPT_OK);
    CHECK_SAY(strlen(text) < numbers + 65 * 200 + 6000, "%d bytes", (int)strlen(text));
    CHECK(emit(&field, SPT_GLSL_POINTS, SPT_GLSL_ARRAYS) == SPT_OK);
    CHECK_SAY(strlen(text) < numbers + 65 * 100 + 6000, "%d bytes", (int)strlen(text));
    CHECK(emit(&mapped, SPT_GLSL_POINTS, 0) == SPT_OK);
    CHECK_SAY(strlen(text) < numbers + more + 65 * 350 + 9000, "%d bytes", (int)strlen(text));
    CHECK(emit(&mapped, SPT_GLSL_POINTS, SPT_GLSL_ARRAYS) == SPT_OK);
    CHECK_SAY(strlen(text) < numbers + more + 65 * 200 + 9000, "%d bytes", (int)strlen(text));
}

/* Both ways to a preimage are written only where one is gone. */
static void G5_maps(void) {
    static spt_moekrs moekrs;
    const uint32_t kinds[1] = {SPT_KERNEL_SPHERE};
    const spt_mobius by_inversion = inversion(), by_quaternions = translation();
    spt_field field = make_moekrs(3, kinds, 1, NULL, &by_inversion, &moekrs);
    CHECK(moekrs.maps[0].inverts);
    CHECK(emit(&field, SPT_GLSL_POINTS, 0) == SPT_OK);
    CHECK(count_of("spt_pull_inversion(") == 4 && count_of("spt_pull_quaternion(") == 0);
    CHECK(count_of("spt_pull_mirror(") == 4 && count_of("spt_ball") == 0);
    CHECK(count_of("image.from_center") == 0 && count_of("    vec3 from_center;") == 0);
    field = make_moekrs(3, kinds, 1, NULL, &by_quaternions, &moekrs);
    CHECK(!moekrs.maps[0].inverts);
    CHECK(emit(&field, SPT_GLSL_POINTS, SPT_GLSL_ARRAYS) == SPT_OK);
    CHECK(count_of("spt_pull_inversion(") == 0 && count_of("spt_pull_quaternion(") == 2);
}

/* A field that is the kernel of many levels is written once, and its prelude as well. */
static void G6_fields_once(void) {
    static spt_krs krs;
    static spt_moekrs moekrs;
    const uint32_t kinds[2] = {SPT_KERNEL_FIELD, SPT_KERNEL_SPHERE};
    const spt_field inner = caller_field("return ball(p);");
    const spt_mobius map = inversion();
    const spt_field field = make_krs(9, kinds, 2, &inner, &krs);
    const spt_field mapped = make_moekrs(9, kinds, 2, &inner, &map, &moekrs);
    CHECK(emit(&field, SPT_GLSL_POINTS, 0) == SPT_OK);
    CHECK(count_of("float spt_field_") == 2 && count_of("float ball(") == 1);
    CHECK(count_of("spt_field_0(p)") == 5);
    /* By probes there is no distance of the whole, but the fields of its kernels are there; */
    CHECK(emit(&mapped, SPT_GLSL_HITS, SPT_GLSL_BINARY) == SPT_OK);
    CHECK(count_of("float spt_field_") == 1 && count_of("float ball(") == 1);
    CHECK(count_of("spt_field_0(ball.at)") == 5 && count_of("spt_map(") == 0);
    /* also where the kernels at hits are asked for, or normals, which need it. */
    CHECK(emit(&mapped, SPT_GLSL_HITS, SPT_GLSL_BINARY | SPT_GLSL_PLACE) == SPT_OK);
    CHECK(count_of("float spt_field_") == 1 && count_of("spt_field_0(way.at)") == 5);
    CHECK(emit(&mapped, SPT_GLSL_HITS, SPT_GLSL_BINARY | SPT_GLSL_PLACE | SPT_GLSL_NORMAL) ==
          SPT_OK);
    CHECK(count_of("float spt_field_") == 2 && count_of("spt_field_0(way.at)") == 10);
}

/* ---- Whatever is written is called ----------------------------------------------------------- */

static int is_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* How often the whole word is there. */
static int word_count(const char *word, size_t length) {
    int count = 0;
    for (const char *at = text; *at != '\0'; ++at) {
        if (strncmp(at, word, length) != 0 || is_word(at[length])) continue;
        count += at == text || !is_word(at[-1]);
    }
    return count;
}

/* Functions begin in the first column and name themselves there. */
static void check_no_function_is_dead(void) {
    for (const char *line = text; *line != '\0'; line += strcspn(line, "\n") + 1) {
        const char *const name = strstr(line, " spt_");
        const size_t end = strcspn(line, "\n");
        if (!is_word(line[0]) || name == NULL || name > line + end || line[end - 1] != '{')
            continue;
        size_t length = 0;
        for (; is_word(name[1 + length]); ++length) continue;
        if (name[1 + length] != '(') continue;
        CHECK_SAY(word_count(name + 1, length) > 1, "%.*s", (int)length, name + 1);
    }
}

static void G7_nothing_is_dead(void) {
    static const uint32_t features[] = {
        0,
        SPT_GLSL_ARRAYS,
        SPT_GLSL_GUARDS,
        SPT_GLSL_PLACE,
        SPT_GLSL_BINARY,
        SPT_GLSL_BINARY | SPT_GLSL_GUARDS | SPT_GLSL_ARRAYS,
        SPT_GLSL_BINARY | SPT_GLSL_PLACE | SPT_GLSL_NORMAL,
    };
    static spt_krs krs;
    static spt_moekrs moekrs;
    const uint32_t kinds[6] = {SPT_KERNEL_EMPTY,   SPT_KERNEL_SPHERE, SPT_KERNEL_HALF_SPACE,
                               SPT_KERNEL_CAPSULE, SPT_KERNEL_LEAF,   SPT_KERNEL_FIELD};
    const spt_field inner = caller_field("return ball(p);");
    const spt_mobius map = inversion();
    for (size_t i = 0; i < sizeof features / sizeof features[0]; ++i) {
        const spt_field fields[2] = {make_krs(11, kinds, 6, &inner, &krs),
                                     make_moekrs(11, kinds, 6, &inner, &map, &moekrs)};
        for (int k = 0; k < 2; ++k) {
            check_context("features %x, field %d", (unsigned)features[i], k);
            CHECK(emit(&fields[k], SPT_GLSL_HITS, features[i]) == SPT_OK);
            check_no_function_is_dead();
        }
    }
}

/* ---- What cannot be written ------------------------------------------------------------------ */

static void unmap(void *user, size_t n, float *x, float *y, float *z) {
    (void)user;
    (void)y;
    (void)z;
    for (size_t i = 0; i < n; ++i) x[i] *= 0.5f;
}

static void check_refused(const spt_field *field, spt_status expected) {
    const spt_settings settings = spt_settings_default();
    spt_glsl_options options = spt_glsl_options_default();
    char small[8] = "as ever";
    size_t length = 99;
    options.field = field;
    options.settings = &settings;
    options.program = SPT_GLSL_POINTS;
    options.target = SPT_GLSL_COMPUTE_450;
    CHECK(spt_glsl_emit(&options, small, sizeof small, &length) == expected);
    CHECK(length == 99 && strcmp(small, "as ever") == 0);
}

/* Of a field without a text, or with a bad one, nothing can be made. */
static void G8_refused(void) {
    static spt_krs krs;
    static spt_moekrs moekrs;
    const char *const texts[2] = {NULL, "return ball(p"};
    const spt_status statuses[2] = {SPT_UNSUPPORTED, SPT_BAD_ARGUMENT};
    const uint32_t kinds[2] = {SPT_KERNEL_SPHERE, SPT_KERNEL_FIELD};
    const float eye[3] = {0, 0, 5};
    const spt_mobius map = inversion();
    for (int i = 0; i < 2; ++i) {
        const spt_field inner = caller_field(texts[i]);
        const spt_field models[2] = {make_krs(3, kinds, 2, &inner, &krs),
                                     make_moekrs(3, kinds, 2, &inner, &map, &moekrs)};
        spt_conformal conformal;
        spt_distorted distorted;
        spt_level_set set;
        spt_field made;
        spt_settings settings = spt_settings_default();
        spt_distortion twist = spt_distortion_default();
        twist.kind = SPT_DISTORTION_TWIST;
        twist.rate = 0.1f;
        check_context("text %d", i);
        check_refused(&models[0], statuses[i]);
        check_refused(&models[1], statuses[i]);
        CHECK(spt_conformal_field(&inner, &map, &conformal, &made) == SPT_OK);
        check_refused(&made, statuses[i]);
        CHECK(spt_distorted_field(&inner, &twist, &distorted, &made) == SPT_OK);
        check_refused(&made, statuses[i]);
        CHECK(spt_level_set_field(&inner, eye, 0, 0.5f, &settings, &set, &made) == SPT_OK);
        check_refused(&made, statuses[i]);
    }
}

/* A caller's map needs a text as well. */
static void G9_maps_without_text(void) {
    const char *const texts[3] = {NULL, "return vec3(0.5 * p.x, p.yz;",
                                  "return vec3(0.5 * p.x, p.yz);"};
    const spt_status statuses[3] = {SPT_UNSUPPORTED, SPT_BAD_ARGUMENT, SPT_OK};
    const spt_field inner = caller_field("return ball(p);");
    for (int i = 0; i < 3; ++i) {
        const spt_bound bound = spt_bound_sphere(0, 0, 0, 3);
        spt_distortion distortion = spt_distortion_default();
        spt_distorted distorted;
        spt_field made;
        distortion.kind = SPT_DISTORTION_MAP;
        distortion.unmap = unmap;
        distortion.bound = &bound;
        distortion.glsl = texts[i];
        CHECK(spt_distorted_field(&inner, &distortion, &distorted, &made) == SPT_OK);
        check_context("text %d", i);
        if (statuses[i] != SPT_OK) {
            check_refused(&made, statuses[i]);
        } else {
            CHECK(emit(&made, SPT_GLSL_POINTS, 0) == SPT_OK);
            CHECK(count_of("vec3 spt_unmap_1(vec3 p) {\n") == 1);
        }
    }
}

void suite_glsl_krs(void) {
    RUN(G1_only_what_occurs);
    RUN(G2_empty_kernels);
    RUN(G3_folds);
    RUN(G4_sizes);
    RUN(G5_maps);
    RUN(G6_fields_once);
    RUN(G7_nothing_is_dead);
    RUN(G8_refused);
    RUN(G9_maps_without_text);
}
