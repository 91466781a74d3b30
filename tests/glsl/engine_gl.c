/* SPDX-License-Identifier: MIT
 *
 * Shaders on Mesa's llvmpipe, through EGL without a surface: no window system, no display. */
#define GL_GLEXT_PROTOTYPES
#include "engine.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct {
    int tried, missing;
    EGLDisplay display;
    EGLContext contexts[2];
    char name[128];
} gl;

static EGLContext make_context(int es, int major, int minor) {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                             es ? EGL_OPENGL_ES3_BIT : EGL_OPENGL_BIT, EGL_NONE};
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 major,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 minor,
                                 es ? EGL_NONE : EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
    EGLConfig config = NULL;
    EGLint count = 0;
    eglBindAPI(es ? EGL_OPENGL_ES_API : EGL_OPENGL_API);
    eglChooseConfig(gl.display, wanted, &config, 1, &count);
    return eglCreateContext(gl.display, count != 0 ? config : NULL, EGL_NO_CONTEXT, attributes);
}

static int use(engine_context context) {
    eglBindAPI(context == ENGINE_ES_32 ? EGL_OPENGL_ES_API : EGL_OPENGL_API);
    return eglMakeCurrent(gl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, gl.contexts[context])
               ? ENGINE_OK
               : ENGINE_MISSING;
}

static int open_contexts(void) {
    const PFNEGLGETPLATFORMDISPLAYEXTPROC platform_display =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    if (platform_display == NULL) return ENGINE_MISSING;
    gl.display = platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (gl.display == EGL_NO_DISPLAY || !eglInitialize(gl.display, NULL, NULL)) {
        return ENGINE_MISSING;
    }
    gl.contexts[ENGINE_GL_45] = make_context(0, 4, 5);
    gl.contexts[ENGINE_ES_32] = make_context(1, 3, 2);
    for (int i = 0; i < 2; ++i) {
        if (gl.contexts[i] == EGL_NO_CONTEXT || use((engine_context)i) != ENGINE_OK) {
            return ENGINE_MISSING;
        }
        /* A core profile draws nothing without one, even where there are no attributes. */
        GLuint vertices;
        glGenVertexArrays(1, &vertices);
        glBindVertexArray(vertices);
    }
    snprintf(gl.name, sizeof gl.name, "%s", (const char *)glGetString(GL_RENDERER));
    return ENGINE_OK;
}

int engine_gl_open(void) {
    if (!gl.tried) {
        gl.missing = open_contexts();
        gl.tried = 1;
    }
    return gl.missing;
}

const char *engine_gl_name(void) {
    return gl.name;
}

/* ---- Programs ------------------------------------------------------------------------------- */

/* A shader, or 0. */
static GLuint compile(GLenum stage, const char *text, int quiet) {
    char log[4096] = "";
    GLint good = 0;
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good) return shader;
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    if (!quiet) {
        engine_print_numbered(text);
        printf("does not compile: %s\n", log);
    }
    glDeleteShader(shader);
    return 0;
}

/* A triangle that covers the viewport, made from the numbers of its vertices. */
static const char triangle[] =
    "void main() {\n"
    "    vec2 v = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));\n"
    "    gl_Position = vec4(v * 2.0 - 1.0, 0.0, 1.0);\n"
    "}\n";

/* A linked program that is in use, or 0. */
static GLuint build(engine_context context, int is_compute, const char *text, int quiet) {
    char vertex[512], log[4096] = "";
    GLint good = 0;
    GLuint shaders[2] = {0, 0};
    snprintf(vertex, sizeof vertex, "#version %s\n%s",
             context == ENGINE_ES_32 ? "300 es" : "330 core", triangle);
    shaders[0] = compile(is_compute ? GL_COMPUTE_SHADER : GL_FRAGMENT_SHADER, text, quiet);
    if (shaders[0] == 0) return 0;
    if (!is_compute) shaders[1] = compile(GL_VERTEX_SHADER, vertex, quiet);
    GLuint program = glCreateProgram();
    for (int i = 0; i < 2; ++i) {
        if (shaders[i] != 0) glAttachShader(program, shaders[i]);
    }
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    for (int i = 0; i < 2; ++i) {
        if (shaders[i] != 0) glDeleteShader(shaders[i]);
    }
    if (!good) {
        glGetProgramInfoLog(program, sizeof log, NULL, log);
        if (!quiet) {
            engine_print_numbered(text);
            printf("does not link: %s\n", log);
        }
        glDeleteProgram(program);
        return 0;
    }
    glUseProgram(program);
    return program;
}

static void set_uniforms(GLuint program, const engine_uniform *uniforms, int count) {
    for (int i = 0; i < count; ++i) {
        const float *number = uniforms[i].number;
        const GLint place = glGetUniformLocation(program, uniforms[i].name);
        if (place < 0) continue;
        switch (uniforms[i].type) {
        case ENGINE_INT:
            glUniform1i(place, (GLint)number[0]);
            break;
        case ENGINE_IVEC2:
            glUniform2i(place, (GLint)number[0], (GLint)number[1]);
            break;
        case ENGINE_FLOAT:
            glUniform1fv(place, 1, number);
            break;
        case ENGINE_VEC2:
            glUniform2fv(place, 1, number);
            break;
        case ENGINE_VEC3:
            glUniform3fv(place, 1, number);
            break;
        case ENGINE_VEC4:
            glUniform4fv(place, 1, number);
            break;
        }
    }
}

static int all_went_well(const char *what) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) return ENGINE_OK;
    printf("%s: OpenGL error 0x%04x\n", what, error);
    while (glGetError() != GL_NO_ERROR) {
    }
    return ENGINE_FAILED;
}

int engine_gl_compiles(engine_context context, int is_compute, const char *shader) {
    if (engine_gl_open() != ENGINE_OK || use(context) != ENGINE_OK) return ENGINE_MISSING;
    const GLuint program = build(context, is_compute, shader, 1);
    if (program == 0) return ENGINE_FAILED;
    glDeleteProgram(program);
    return ENGINE_OK;
}

/* ---- Fragments ------------------------------------------------------------------------------ */

static GLuint make_texture(GLint format, int width, int height, const float *texels) {
    const int depth = format == GL_DEPTH_COMPONENT32F;
    GLuint texture;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, depth ? GL_DEPTH_COMPONENT : GL_RGBA,
                 GL_FLOAT, texels);
    /* Without this the texture is incomplete and reads as 0. */
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

enum { most_textures = 8 };

static void draw(const engine_fragment *run, int attachments) {
    const float clear[4] = {NAN, NAN, NAN, NAN}, far_plane = 1.0f;
    GLenum buffers[ENGINE_ATTACHMENTS];
    for (int i = 0; i < attachments; ++i) buffers[i] = GL_COLOR_ATTACHMENT0 + (GLenum)i;
    glDrawBuffers(attachments, buffers);
    glViewport(0, 0, run->width, run->height);
    for (int i = 0; i < attachments; ++i) glClearBufferfv(GL_COLOR, i, clear);
    if (run->depth != NULL) {
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glClearBufferfv(GL_DEPTH, 0, &far_plane);
    }
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_DEPTH_TEST);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    for (int i = 0; i < attachments; ++i) {
        glReadBuffer(GL_COLOR_ATTACHMENT0 + (GLenum)i);
        glReadPixels(0, 0, run->width, run->height, GL_RGBA, GL_FLOAT, run->out[i]);
    }
    if (run->depth != NULL) {
        glReadPixels(0, 0, run->width, run->height, GL_DEPTH_COMPONENT, GL_FLOAT, run->depth);
    }
}

static int run_fragment(const engine_fragment *run, GLuint program) {
    GLuint textures[most_textures + ENGINE_ATTACHMENTS + 1], frame;
    int used = 0, attachments = 0, result = ENGINE_FAILED;
    for (int i = 0; i < run->texture_count && i < most_textures; ++i) {
        const engine_texture *in = &run->textures[i];
        const GLint place = glGetUniformLocation(program, in->name);
        glActiveTexture(GL_TEXTURE0 + (GLenum)i);
        textures[used++] = make_texture(GL_RGBA32F, in->width, in->height, in->texels);
        if (place >= 0) glUniform1i(place, i);
    }
    set_uniforms(program, run->uniforms, run->uniform_count);
    glActiveTexture(GL_TEXTURE0 + most_textures);
    glGenFramebuffers(1, &frame);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    for (; attachments < ENGINE_ATTACHMENTS && run->out[attachments] != NULL; ++attachments) {
        textures[used] = make_texture(GL_RGBA32F, run->width, run->height, NULL);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + (GLenum)attachments,
                               GL_TEXTURE_2D, textures[used++], 0);
    }
    if (run->depth != NULL) {
        textures[used] = make_texture(GL_DEPTH_COMPONENT32F, run->width, run->height, NULL);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, textures[used++],
                               0);
    }
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) {
        draw(run, attachments);
        result = all_went_well("fragment shader");
    } else {
        printf("the framebuffer is not complete\n");
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &frame);
    glDeleteTextures(used, textures);
    return result;
}

int engine_gl_fragment(const engine_fragment *run) {
    if (engine_gl_open() != ENGINE_OK || use(run->context) != ENGINE_OK) return ENGINE_MISSING;
    const GLuint program = build(run->context, 0, run->shader, run->quiet);
    if (program == 0) return ENGINE_FAILED;
    const int result = run_fragment(run, program);
    glDeleteProgram(program);
    return result;
}

/* ---- Compute -------------------------------------------------------------------------------- */

static int run_compute(const engine_compute *run, GLuint program) {
    const GLsizeiptr in_size = (GLsizeiptr)(run->in_count * sizeof(float)),
                     out_size = (GLsizeiptr)(run->out_count * sizeof(float));
    GLuint buffers[2];
    int result = ENGINE_FAILED;
    for (size_t i = 0; i < run->out_count; ++i) run->out[i] = NAN;
    glGenBuffers(2, buffers);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffers[0]);
    glBufferData(GL_SHADER_STORAGE_BUFFER, in_size, run->in, GL_STATIC_DRAW);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers[0]);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffers[1]);
    glBufferData(GL_SHADER_STORAGE_BUFFER, out_size, run->out, GL_STATIC_READ);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffers[1]);
    set_uniforms(program, run->uniforms, run->uniform_count);
    glDispatchCompute(((GLuint)run->width + 7) / 8, ((GLuint)run->height + 7) / 8, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const void *mapped = glMapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, out_size, GL_MAP_READ_BIT);
    if (mapped != NULL) {
        memcpy(run->out, mapped, (size_t)out_size);
        glUnmapBuffer(GL_SHADER_STORAGE_BUFFER);
        result = all_went_well("compute shader");
    } else {
        all_went_well("compute shader");
    }
    glDeleteBuffers(2, buffers);
    return result;
}

int engine_gl_compute(const engine_compute *run) {
    if (engine_gl_open() != ENGINE_OK || use(run->context) != ENGINE_OK) return ENGINE_MISSING;
    const GLuint program = build(run->context, 1, run->shader, 0);
    if (program == 0) return ENGINE_FAILED;
    const int result = run_compute(run, program);
    glDeleteProgram(program);
    return result;
}

/* ---- Single functions ----------------------------------------------------------------------- */

static const char values_shader[] =
    "#version 450 core\n"
    "%s\n"
    "layout(local_size_x = 8, local_size_y = 8) in;\n"
    "layout(std430, binding = 0) readonly buffer engine_in { vec4 engine_q[]; };\n"
    "layout(std430, binding = 1) writeonly buffer engine_out { vec4 engine_r[]; };\n"
    "uniform int engine_count, engine_row;\n"
    "void main() {\n"
    "    int i = int(gl_GlobalInvocationID.x) + int(gl_GlobalInvocationID.y) * engine_row;\n"
    "    if (int(gl_GlobalInvocationID.x) >= engine_row || i >= engine_count) return;\n"
    "    vec4 q[%d];\n"
    "    precise vec4 r[%d];\n"
    "    for (int k = 0; k < %d; ++k) q[k] = engine_q[i * %d + k];\n"
    "%s\n"
    "    for (int k = 0; k < %d; ++k) engine_r[i * %d + k] = r[k];\n"
    "}\n";

int engine_values(const char *functions, const char *statements, size_t count, int inputs,
                  const float *in, int outputs, float *out) {
    if (count == 0) return ENGINE_OK;
    const size_t length = sizeof values_shader + strlen(functions) + strlen(statements) + 128;
    char *shader = malloc(length);
    if (shader == NULL) return ENGINE_FAILED;
    snprintf(shader, length, values_shader, functions, inputs, outputs, inputs, inputs, statements,
             outputs, outputs);
    const int row = count < 1024 ? (int)count : 1024;
    const engine_uniform uniforms[] = {{"engine_count", ENGINE_INT, {(float)count, 0, 0, 0}},
                                       {"engine_row", ENGINE_INT, {(float)row, 0, 0, 0}}};
    const engine_compute run = {
        ENGINE_GL_45, shader,
        row,          (int)((count + (size_t)row - 1) / (size_t)row),
        in,           4 * (size_t)inputs * count,
        out,          4 * (size_t)outputs * count,
        uniforms,     2,
    };
    const int result = engine_gl_compute(&run);
    free(shader);
    return result;
}

int engine_points(const char *functions, const char *expression, size_t count, const float *xyzw,
                  float *out) {
    const size_t length = strlen(expression) + 64;
    char *statements = malloc(length);
    float *results = malloc(4 * count * sizeof *results);
    int result = ENGINE_FAILED;
    if (statements != NULL && results != NULL) {
        snprintf(statements, length,
                 "    vec4 point = q[0];\n    { vec4 q = point; r[0] = vec4(%s); }", expression);
        result = engine_values(functions, statements, count, 1, xyzw, 1, results);
        for (size_t i = 0; result == ENGINE_OK && i < count; ++i) out[i] = results[4 * i];
    }
    free(statements);
    free(results);
    return result;
}
