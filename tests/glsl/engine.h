/* SPDX-License-Identifier: MIT
 *
 * Running shaders without a GPU: a text and its inputs go to an implementation of GLSL that renders
 * on the processor, and numbers come back. Left out: what is in the shaders, and comparing. */
#ifndef TESTS_GLSL_ENGINE_H
#define TESTS_GLSL_ENGINE_H

#include <stddef.h>

/* What all that run something return. */
enum {
    ENGINE_OK = 0,
    ENGINE_FAILED = 1, /* the shader does not compile or run: log and numbered source are printed */
    ENGINE_MISSING = 77 /* the engine is not on this machine */
};

typedef enum engine_context {
    ENGINE_GL_45, /* OpenGL 4.5 core: 330, 430, 450 */
    ENGINE_ES_32  /* OpenGL ES 3.2: 300 es, 310 es, 320 es */
} engine_context;

typedef enum engine_type {
    ENGINE_INT,
    ENGINE_IVEC2,
    ENGINE_FLOAT,
    ENGINE_VEC2,
    ENGINE_VEC3,
    ENGINE_VEC4
} engine_type;

/* A uniform by its name. Names that the shader does not have are passed over. */
typedef struct engine_uniform {
    const char *name;
    engine_type type;
    float number[4]; /* integers of at most 2^24 are exact */
} engine_uniform;

/* A sampler2D by its name: width * height texels of four floats (RGBA32F), row by row. */
typedef struct engine_texture {
    const char *name;
    int width, height;
    const float *texels;
} engine_texture;

#define ENGINE_ATTACHMENTS 3

/* A fragment shader on a viewport of width x height pixels. */
typedef struct engine_fragment {
    engine_context context;
    const char *shader;
    int width, height;
    const engine_texture *textures;
    int texture_count;
    const engine_uniform *uniforms;
    int uniform_count;
    float *out[ENGINE_ATTACHMENTS]; /* colour attachments, NULL behind the last; each receives
                                     * 4 * width * height floats, the row of pixel y = 0 first */
    float *depth;                   /* receives width * height of them, or NULL: no depth buffer */
    int quiet;                      /* an error is expected: nothing is printed */
} engine_fragment;

/* A compute shader with a local size of 8 x 8, run for at least width x height invocations. */
typedef struct engine_compute {
    engine_context context;
    const char *shader;
    int width, height;
    const float *in; /* std430 buffer at binding 0 */
    size_t in_count; /* floats in it */
    float *out;      /* at binding 1; before the run it holds NaN */
    size_t out_count;
    const engine_uniform *uniforms; /* on Vulkan: push constants, in this order */
    int uniform_count;
} engine_compute;

/* ---- Mesa's llvmpipe through EGL without a surface ------------------------------------------ */

/* Whether there is such an engine: ENGINE_OK or ENGINE_MISSING. */
int engine_gl_open(void);

/* "llvmpipe (LLVM ...)"; after engine_gl_open(). */
const char *engine_gl_name(void);

int engine_gl_fragment(const engine_fragment *run);
int engine_gl_compute(const engine_compute *run);

/* Whether a shader compiles and links, without printing anything. */
int engine_gl_compiles(engine_context context, int is_compute, const char *shader);

/* For tests of single functions, on 4.5 core: `statements` reads vec4 q[inputs], one set a
 * point, and writes vec4 r[outputs]. in holds 4 * inputs * count floats, out receives
 * 4 * outputs * count. `functions` stand before main(), after the version. */
int engine_values(const char *functions, const char *statements, size_t count, int inputs,
                  const float *in, int outputs, float *out);

/* The same for an expression of one float, of vec4 q: engine_points("float f(vec3 p) {...}",
 * "f(q.xyz)", count, xyzw, out) with 4 * count floats in and count out. */
int engine_points(const char *functions, const char *expression, size_t count, const float *xyzw,
                  float *out);

/* ---- Vulkan on the processor ---------------------------------------------------------------- */

typedef enum engine_device {
    ENGINE_LAVAPIPE,          /* Mesa's */
    ENGINE_VULKAN_SWIFTSHADER /* the one that Chromium brings */
} engine_device;
#define ENGINE_DEVICES 2

/* Who makes SPIR-V of the text; both are programs. */
typedef enum engine_compiler {
    ENGINE_GLSLANG, /* glslangValidator -V */
    ENGINE_GLSLC    /* glslc -O */
} engine_compiler;
#define ENGINE_COMPILERS 2

/* Runs what follows on this device; ENGINE_OK or ENGINE_MISSING. */
int engine_vulkan_use(engine_device device);

/* On lavapipe. */
int engine_vulkan_open(void);

const char *engine_vulkan_name(void);

/* Bindings 0 and 1 are in set 0. run->context does not count; the uniforms are the members of the
 * push constant block, all of them in their order, laid out as std430. */
int engine_vulkan_compute(const engine_compute *run, engine_compiler compiler);

/* ---- Chromium: WebGL 2 ---------------------------------------------------------------------- */

/* What the browser renders with. */
typedef enum engine_browser {
    ENGINE_SWIFTSHADER,    /* its own renderer on the processor */
    ENGINE_ANGLE_LLVMPIPE, /* llvmpipe, through ANGLE's translation of the shader */
} engine_browser;
#define ENGINE_BROWSERS 2

/* Runs many fragment shaders (300 es) in one page, since a browser takes seconds to start. Of each
 * run statuses receives ENGINE_OK or ENGINE_FAILED; depth and context do not count. Returns
 * ENGINE_MISSING without the browser or where it renders by other means, and ENGINE_FAILED where
 * the page said nothing. */
int engine_browser_fragments(engine_browser browser, int count, const engine_fragment *runs,
                             int *statuses);

/* What the browser says that it renders with; after a run. */
const char *engine_browser_name(void);

/* ---- What engines share --------------------------------------------------------------------- */

/* A folder for files that programs read; it is removed at exit. NULL where none can be made. */
const char *engine_folder(void);

/* Reads a whole file of that folder, with a zero behind it; NULL where there is none. The caller
 * frees it. size may be NULL. */
char *engine_read_file(const char *name, size_t *size);

void engine_print_numbered(const char *text);

#endif
