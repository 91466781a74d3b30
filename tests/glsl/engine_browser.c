/* SPDX-License-Identifier: MIT
 *
 * Fragment shaders in Chromium without a window: a page that holds shaders and inputs renders them
 * by WebGL 2 and writes what it reads back into its own text, which the browser then prints. */
#define _GNU_SOURCE /* WEXITSTATUS under gnu99 */
#include "engine.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

static char renderer[256];

const char *engine_browser_name(void) {
    return renderer;
}

static const char script[] =
    "function floats(text) {\n"
    "  const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));\n"
    "  return new Float32Array(bytes.buffer);\n"
    "}\n"
    "function text(numbers) {\n"
    "  const bytes = new Uint8Array(numbers.buffer);\n"
    "  let all = '';\n"
    "  for (let i = 0; i < bytes.length; i += 8192)\n"
    "    all += String.fromCharCode.apply(null, bytes.subarray(i, i + 8192));\n"
    "  return btoa(all);\n"
    "}\n"
    "function compile(gl, stage, source) {\n"
    "  const shader = gl.createShader(stage);\n"
    "  gl.shaderSource(shader, source);\n"
    "  gl.compileShader(shader);\n"
    "  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS))\n"
    "    throw new Error(gl.getShaderInfoLog(shader));\n"
    "  return shader;\n"
    "}\n"
    "function build(gl, source) {\n"
    "  const program = gl.createProgram();\n"
    "  gl.attachShader(program, compile(gl, gl.VERTEX_SHADER, '#version 300 es\\n' +\n"
    "    'void main() {\\n' +\n"
    "    '  vec2 v = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));\\n' +\n"
    "    '  gl_Position = vec4(v * 2.0 - 1.0, 0.0, 1.0);\\n' +\n"
    "    '}\\n'));\n"
    "  gl.attachShader(program, compile(gl, gl.FRAGMENT_SHADER, source));\n"
    "  gl.linkProgram(program);\n"
    "  if (!gl.getProgramParameter(program, gl.LINK_STATUS))\n"
    "    throw new Error(gl.getProgramInfoLog(program));\n"
    "  gl.useProgram(program);\n"
    "  return program;\n"
    "}\n"
    "function texture(gl, width, height, texels) {\n"
    "  const made = gl.createTexture();\n"
    "  gl.bindTexture(gl.TEXTURE_2D, made);\n"
    "  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, width, height, 0, gl.RGBA, gl.FLOAT, texels);\n"
    "  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);\n"
    "  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);\n"
    "  return made;\n"
    "}\n"
    "function uniform(gl, program, [name, whole, components, bits]) {\n"
    "  const place = gl.getUniformLocation(program, name);\n"
    "  if (place === null) return;\n"
    "  const numbers = new Float32Array(new Uint32Array(bits).buffer).slice(0, components);\n"
    "  if (whole) gl['uniform' + components + 'iv'](place, Array.from(numbers));\n"
    "  else gl['uniform' + components + 'fv'](place, numbers);\n"
    "}\n"
    "function draw(gl, run) {\n"
    "  const program = build(gl, run.shader);\n"
    "  const made = [];\n"
    "  run.textures.forEach(([name, index], unit) => {\n"
    "    const [width, height, texels] = inputs[index];\n"
    "    gl.activeTexture(gl.TEXTURE0 + unit);\n"
    "    made.push(texture(gl, width, height, floats(texels)));\n"
    "    gl.uniform1i(gl.getUniformLocation(program, name), unit);\n"
    "  });\n"
    "  run.uniforms.forEach(one => uniform(gl, program, one));\n"
    "  gl.activeTexture(gl.TEXTURE0 + run.textures.length);\n"
    "  const frame = gl.createFramebuffer(), buffers = [];\n"
    "  gl.bindFramebuffer(gl.FRAMEBUFFER, frame);\n"
    "  for (let i = 0; i < run.outs; ++i) {\n"
    "    const out = texture(gl, run.width, run.height, null);\n"
    "    made.push(out);\n"
    "    buffers.push(gl.COLOR_ATTACHMENT0 + i);\n"
    "    gl.framebufferTexture2D(gl.FRAMEBUFFER, buffers[i], gl.TEXTURE_2D, out, 0);\n"
    "  }\n"
    "  gl.drawBuffers(buffers);\n"
    "  if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE)\n"
    "    throw new Error('the framebuffer is not complete');\n"
    "  gl.viewport(0, 0, run.width, run.height);\n"
    "  gl.drawArrays(gl.TRIANGLES, 0, 3);\n"
    "  const outs = buffers.map(buffer => {\n"
    "    const numbers = new Float32Array(4 * run.width * run.height);\n"
    "    gl.readBuffer(buffer);\n"
    "    gl.readPixels(0, 0, run.width, run.height, gl.RGBA, gl.FLOAT, numbers);\n"
    "    return text(numbers);\n"
    "  });\n"
    "  const error = gl.getError();\n"
    "  if (error !== gl.NO_ERROR) throw new Error('WebGL error ' + error);\n"
    "  gl.deleteFramebuffer(frame);\n"
    "  made.forEach(one => gl.deleteTexture(one));\n"
    "  gl.deleteProgram(program);\n"
    "  return outs;\n"
    "}\n"
    "const lines = [];\n"
    "const gl = document.createElement('canvas').getContext('webgl2');\n"
    "if (gl && gl.getExtension('EXT_color_buffer_float')) {\n"
    "  const info = gl.getExtension('WEBGL_debug_renderer_info');\n"
    "  lines.push('RENDERER ' + gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL\n"
    "                                                : gl.RENDERER));\n"
    "  gl.bindVertexArray(gl.createVertexArray());\n"
    "  runs.forEach((run, index) => {\n"
    "    try {\n"
    "      draw(gl, run).forEach(out => lines.push('OUT ' + index + ' ' + out));\n"
    "      lines.push('DONE ' + index);\n"
    "    } catch (error) {\n"
    "      lines.push('FAILED ' + index + ' ' + error.message.split('\\n').join(' | '));\n"
    "    }\n"
    "  });\n"
    "} else {\n"
    "  lines.push('RENDERER none');\n"
    "}\n"
    "document.getElementById('result').textContent = 'RESULT\\n' + lines.join('\\n') + "
    "'\\nEND\\n';\n";

/* ---- Writing the page ----------------------------------------------------------------------- */

static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

static void write_base64(FILE *page, const void *data, size_t size) {
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i += 3) {
        const size_t left = size - i;
        const uint32_t three = (uint32_t)bytes[i] << 16 |
                               (left > 1 ? (uint32_t)bytes[i + 1] << 8 : 0) |
                               (left > 2 ? bytes[i + 2] : 0);
        fputc(letters[three >> 18], page);
        fputc(letters[three >> 12 & 63], page);
        fputc(left > 1 ? letters[three >> 6 & 63] : '=', page);
        fputc(left > 2 ? letters[three & 63] : '=', page);
    }
}

static void write_string(FILE *page, const char *text) {
    fputc('"', page);
    for (; *text != '\0'; ++text) {
        if (*text == '\n') {
            fputs("\\n", page);
        } else if (*text == '"' || *text == '\\' || *text == '<') {
            fprintf(page, "\\u%04x", (unsigned)*text);
        } else {
            fputc(*text, page);
        }
    }
    fputc('"', page);
}

/* Textures that several runs share are written once. */
typedef struct inputs {
    const engine_texture *all[1024];
    int count;
} inputs;

static size_t texture_size(const engine_texture *texture) {
    return 4 * sizeof(float) * (size_t)texture->width * (size_t)texture->height;
}

static int input_number(inputs *known, const engine_texture *texture) {
    for (int i = 0; i < known->count; ++i) {
        if (known->all[i]->width == texture->width && known->all[i]->height == texture->height &&
            memcmp(known->all[i]->texels, texture->texels, texture_size(texture)) == 0) {
            return i;
        }
    }
    if (known->count < 1024) known->all[known->count++] = texture;
    return known->count - 1;
}

static void write_run(FILE *page, inputs *known, const engine_fragment *run) {
    static const int components[] = {1, 2, 1, 2, 3, 4};
    int outs = 0;
    while (outs < ENGINE_ATTACHMENTS && run->out[outs] != NULL) ++outs;
    fprintf(page, "{width: %d, height: %d, outs: %d, textures: [", run->width, run->height, outs);
    for (int i = 0; i < run->texture_count; ++i) {
        fprintf(page, "[\"%s\", %d], ", run->textures[i].name,
                input_number(known, &run->textures[i]));
    }
    fprintf(page, "], uniforms: [");
    for (int i = 0; i < run->uniform_count; ++i) {
        const engine_uniform *one = &run->uniforms[i];
        uint32_t bits[4];
        memcpy(bits, one->number, sizeof bits);
        fprintf(page, "[\"%s\", %d, %d, [%lu, %lu, %lu, %lu]], ", one->name,
                one->type == ENGINE_INT || one->type == ENGINE_IVEC2, components[one->type],
                (unsigned long)bits[0], (unsigned long)bits[1], (unsigned long)bits[2],
                (unsigned long)bits[3]);
    }
    fprintf(page, "], shader: ");
    write_string(page, run->shader);
    fprintf(page, "},\n");
}

static int write_page(const char *folder, int count, const engine_fragment *runs) {
    static inputs known;
    char path[512];
    snprintf(path, sizeof path, "%s/page.html", folder);
    FILE *page = fopen(path, "wb");
    if (page == NULL) return 0;
    known.count = 0;
    fprintf(page, "<!DOCTYPE html><meta charset=\"utf-8\"><pre id=\"result\"></pre><script>\n"
                  "const runs = [\n");
    for (int i = 0; i < count; ++i) write_run(page, &known, &runs[i]);
    fprintf(page, "];\nconst inputs = [\n");
    for (int i = 0; i < known.count; ++i) {
        const engine_texture *one = known.all[i];
        fprintf(page, "[%d, %d, \"", one->width, one->height);
        write_base64(page, one->texels, texture_size(one));
        fprintf(page, "\"],\n");
    }
    fprintf(page, "];\n%s</script>\n", script);
    return fclose(page) == 0;
}

/* ---- Reading what it said ------------------------------------------------------------------- */

/* At most `size` bytes. */
static void read_base64(const char *text, size_t length, void *data, size_t size) {
    unsigned char *bytes = data;
    uint32_t held = 0;
    int bits = 0;
    for (size_t i = 0, written = 0; i < length && text[i] != '=' && text[i] != '\0'; ++i) {
        const char *letter = strchr(letters, text[i]);
        if (letter == NULL) return;
        held = held << 6 | (uint32_t)(letter - letters);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        if (written == size) return;
        bytes[written++] = (unsigned char)(held >> bits);
    }
}

static void read_line(const char *line, size_t length, int count, const engine_fragment *runs,
                      int *statuses, int *outs) {
    int index = 0, at = 0;
    if (strncmp(line, "RENDERER ", 9) == 0) {
        snprintf(renderer, sizeof renderer, "%.*s", (int)(length - 9), line + 9);
    } else if (sscanf(line, "OUT %d %n", &index, &at) == 1 && index >= 0 && index < count) {
        const engine_fragment *run = &runs[index];
        if (outs[index] < ENGINE_ATTACHMENTS && run->out[outs[index]] != NULL) {
            read_base64(line + at, length - (size_t)at, run->out[outs[index]],
                        4 * sizeof(float) * (size_t)run->width * (size_t)run->height);
        }
        ++outs[index];
    } else if (sscanf(line, "DONE %d", &index) == 1 && index >= 0 && index < count) {
        statuses[index] = ENGINE_OK;
    } else if (sscanf(line, "FAILED %d %n", &index, &at) == 1 && index >= 0 && index < count) {
        if (runs[index].quiet) return;
        engine_print_numbered(runs[index].shader);
        printf("the browser: %.*s\n", (int)(length - (size_t)at), line + at);
    }
}

static int read_answer(int count, const engine_fragment *runs, int *statuses) {
    char *answer = engine_read_file("page.out", NULL);
    int *outs = calloc((size_t)count + 1, sizeof *outs);
    const char *line = answer != NULL ? strstr(answer, "<pre id=\"result\">RESULT\n") : NULL;
    const int heard = line != NULL && strstr(line, "\nEND\n") != NULL && outs != NULL;
    while (heard && strncmp(line, "END\n", 4) != 0) {
        const size_t length = strcspn(line, "\n");
        read_line(line, length, count, runs, statuses, outs);
        line += length + 1;
    }
    free(answer);
    free(outs);
    return heard;
}

int engine_browser_fragments(engine_browser browser, int count, const engine_fragment *runs,
                             int *statuses) {
    static const char *const flags[ENGINE_BROWSERS] = {
        "--use-angle=swiftshader --enable-unsafe-swiftshader",
        "--use-angle=gl-egl --ignore-gpu-blocklist"};
    static const char *const wanted[ENGINE_BROWSERS] = {"SwiftShader", "llvmpipe"};
    char command[2048];
    const char *folder = engine_folder();
    if (folder == NULL || !write_page(folder, count, runs)) return ENGINE_FAILED;
    for (int i = 0; i < count; ++i) statuses[i] = ENGINE_FAILED;
    renderer[0] = '\0';
    snprintf(command, sizeof command,
             "timeout 180 chromium --headless --no-sandbox --disable-quic --no-first-run "
             "--disable-background-networking --disable-component-update --disable-sync "
             "--disable-gpu-watchdog --user-data-dir=%s/profile --use-gl=angle %s "
             "--virtual-time-budget=60000 --dump-dom file://%s/page.html "
             ">%s/page.out 2>%s/page.log",
             folder, flags[browser], folder, folder, folder);
    const int status = system(command);
    if (WIFEXITED(status) && (WEXITSTATUS(status) == 127 || WEXITSTATUS(status) == 126)) {
        return ENGINE_MISSING;
    }
    if (!read_answer(count, runs, statuses)) {
        printf("the browser (%s) said nothing\n", wanted[browser]);
        return ENGINE_FAILED;
    }
    return strstr(renderer, wanted[browser]) != NULL ? ENGINE_OK : ENGINE_MISSING;
}
