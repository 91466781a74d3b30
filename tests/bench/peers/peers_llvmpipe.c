/* SPDX-License-Identifier: MIT
 *
 * llvmpipe through EGL without a surface. It takes its number of threads from the environment when
 * a context is made: 0 keeps the work in the caller's. No shader comes from its cache on the disk,
 * so that what is said of the time to build one is true. */
#define _POSIX_C_SOURCE 200112L
#define EGL_NO_X11
#define GL_GLEXT_PROTOTYPES
#include "peers_llvmpipe.h"

#include <stdlib.h>
#include <string.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>

/* Rays that follow one another in the picture's order are neighbours (Morton order in a tile): 8 of
 * them fill a row of a work group, and 64 a work group, which is then a block of 8 x 8 pixels. */
enum { GROUP_SIDE = 8 };

struct peers_shader {
    peers_stage stage;
    const frame_picture *picture;
    GLuint program;
    GLuint buffers[2];           /* rays, hits */
    GLuint textures[3], drawing; /* origins, directions, hits */
};

static char renderer[128];

static EGLContext context_of(EGLDisplay display) {
    static const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                        4,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        5,
                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                        EGL_NONE};
    static const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                    EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = NULL;
    EGLint count = 0;
    eglBindAPI(EGL_OPENGL_API);
    eglChooseConfig(display, wanted, &config, 1, &count);
    return eglCreateContext(display, count > 0 ? config : NULL, EGL_NO_CONTEXT, attributes);
}

int peers_llvmpipe_open(void) {
    GLuint vertices;
    EGLContext context = EGL_NO_CONTEXT;
    EGLDisplay display = EGL_NO_DISPLAY;
    setenv("LP_NUM_THREADS", "0", 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    const PFNEGLGETPLATFORMDISPLAYEXTPROC platform_display =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    if (platform_display != NULL) {
        display = platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    }
    if (display != EGL_NO_DISPLAY && eglInitialize(display, NULL, NULL)) {
        context = context_of(display);
    }
    if (context == EGL_NO_CONTEXT ||
        !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        printf("skipped: llvmpipe, no OpenGL 4.5 through EGL without a surface\n");
        return 0;
    }
    snprintf(renderer, sizeof renderer, "%s", (const char *)glGetString(GL_RENDERER));
    if (strstr(renderer, "llvmpipe") == NULL) {
        printf("skipped: llvmpipe, OpenGL is %s\n", renderer);
        return 0;
    }
    glGenVertexArrays(1, &vertices);
    glBindVertexArray(vertices);
    return 1;
}

const char *peers_llvmpipe_name(void) {
    return renderer;
}

/* ---- Programs ------------------------------------------------------------------------------- */

static void fail(const char *what, const char *log) {
    fprintf(stderr, "llvmpipe: %s: %s\n", what, log);
    exit(1);
}

static void expect_no_error(const char *what) {
    char log[32];
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) return;
    snprintf(log, sizeof log, "error 0x%04x", error);
    fail(what, log);
}

static void attach(GLuint program, GLenum stage, const char *text) {
    char log[1024] = "";
    GLint good = 0;
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    if (!good) fail("does not compile", log);
    glAttachShader(program, shader);
    glDeleteShader(shader);
}

/* A triangle that covers the viewport. */
static const char triangle[] =
    "#version 330 core\n"
    "void main() {\n"
    "    vec2 v = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));\n"
    "    gl_Position = vec4(v * 2.0 - 1.0, 0.0, 1.0);\n"
    "}\n";

static GLuint program_of(peers_stage stage, const char *text) {
    char log[1024] = "";
    GLint good = 0;
    const GLuint program = glCreateProgram();
    attach(program, stage == PEERS_COMPUTE ? GL_COMPUTE_SHADER : GL_FRAGMENT_SHADER, text);
    if (stage == PEERS_FRAGMENT) attach(program, GL_VERTEX_SHADER, triangle);
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    glGetProgramInfoLog(program, sizeof log, NULL, log);
    if (!good) fail("does not link", log);
    return program;
}

/* ---- Rays and hits -------------------------------------------------------------------------- */

static void make_buffers(peers_shader *shader) {
    const frame_picture *const picture = shader->picture;
    const GLsizeiptr size[2] = {(GLsizeiptr)(picture->count * sizeof *picture->rays),
                                (GLsizeiptr)(picture->count * 4 * sizeof(float))};
    const void *const filled[2] = {picture->rays, NULL};
    glGenBuffers(2, shader->buffers);
    for (int i = 0; i < 2; ++i) {
        glBindBuffer(GL_SHADER_STORAGE_BUFFER, shader->buffers[i]);
        glBufferData(GL_SHADER_STORAGE_BUFFER, size[i], filled[i], GL_STATIC_DRAW);
    }
}

static void make_texture(const peers_shader *shader, GLuint texture, const float *texels) {
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, (GLsizei)shader->picture->width,
                 (GLsizei)shader->picture->height, 0, GL_RGBA, GL_FLOAT, texels);
    /* Without this the texture is incomplete and reads as 0. */
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

static void make_textures(peers_shader *shader) {
    const frame_picture *const picture = shader->picture;
    float(*const texels)[4] = frame_allocate(picture->count * sizeof *texels);
    glGenTextures(3, shader->textures);
    for (int part = 0; part < 2; ++part) {
        for (size_t i = 0; i < picture->count; ++i) {
            const spt_ray *const ray = &picture->rays[i];
            const float *const members = part == 0 ? ray->origin : ray->direction;
            memcpy(texels[picture->pixel[i]], members, 3 * sizeof(float));
            texels[picture->pixel[i]][3] = part == 0 ? ray->t_min : ray->t_max;
        }
        make_texture(shader, shader->textures[part], texels[0]);
    }
    free(texels);
    make_texture(shader, shader->textures[2], NULL);
    glGenFramebuffers(1, &shader->drawing);
    glBindFramebuffer(GL_FRAMEBUFFER, shader->drawing);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, shader->textures[2],
                           0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        fail("framebuffer", "not complete");
    }
}

peers_shader *peers_shader_of(peers_stage stage, const char *text, const frame_picture *picture,
                              uint32_t budget) {
    peers_shader *const shader = frame_allocate(sizeof *shader);
    const GLint width = stage == PEERS_COMPUTE ? GROUP_SIDE : (GLint)picture->width;
    shader->stage = stage;
    shader->picture = picture;
    shader->program = program_of(stage, text);
    if (stage == PEERS_COMPUTE) {
        make_buffers(shader);
    } else {
        make_textures(shader);
    }
    glUseProgram(shader->program);
    glUniform2i(glGetUniformLocation(shader->program, "spt_size"), width,
                (GLint)picture->count / width);
    glUniform1i(glGetUniformLocation(shader->program, "spt_budget"), (GLint)budget);
    glUniform1i(glGetUniformLocation(shader->program, "spt_ray_origin"), 0);
    glUniform1i(glGetUniformLocation(shader->program, "spt_ray_direction"), 1);
    expect_no_error("setting up");
    return shader;
}

void peers_shader_free(peers_shader *shader) {
    glDeleteProgram(shader->program);
    if (shader->stage == PEERS_COMPUTE) {
        glDeleteBuffers(2, shader->buffers);
    } else {
        glDeleteTextures(3, shader->textures);
        glDeleteFramebuffers(1, &shader->drawing);
    }
    free(shader);
}

double peers_shader_run(const peers_shader *shader) {
    const frame_picture *const picture = shader->picture;
    glUseProgram(shader->program);
    for (GLuint i = 0; i < 2; ++i) {
        if (shader->stage == PEERS_COMPUTE) {
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, shader->buffers[i]);
        } else {
            glActiveTexture(GL_TEXTURE0 + i);
            glBindTexture(GL_TEXTURE_2D, shader->textures[i]);
        }
    }
    glFinish();
    const double before = bench_seconds();
    if (shader->stage == PEERS_COMPUTE) {
        glDispatchCompute(1, (GLuint)(picture->count / (GROUP_SIDE * GROUP_SIDE)), 1);
    } else {
        glBindFramebuffer(GL_FRAMEBUFFER, shader->drawing);
        glViewport(0, 0, (GLsizei)picture->width, (GLsizei)picture->height);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    glFinish();
    const double seconds = bench_seconds() - before;
    expect_no_error("running");
    return seconds;
}

void peers_shader_hits(const peers_shader *shader, float (*hits)[4]) {
    const frame_picture *const picture = shader->picture;
    if (shader->stage == PEERS_COMPUTE) {
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        glBindBuffer(GL_SHADER_STORAGE_BUFFER, shader->buffers[1]);
        glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, (GLsizeiptr)(picture->count * sizeof *hits),
                           hits);
    } else {
        float(*const by_pixel)[4] = frame_allocate(picture->count * sizeof *by_pixel);
        glBindFramebuffer(GL_FRAMEBUFFER, shader->drawing);
        glReadBuffer(GL_COLOR_ATTACHMENT0);
        glReadPixels(0, 0, (GLsizei)picture->width, (GLsizei)picture->height, GL_RGBA, GL_FLOAT,
                     by_pixel);
        for (size_t i = 0; i < picture->count; ++i) {
            memcpy(hits[i], by_pixel[picture->pixel[i]], sizeof hits[i]);
        }
        free(by_pixel);
    }
    expect_no_error("reading back");
}
