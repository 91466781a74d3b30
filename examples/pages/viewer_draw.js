// SPDX-License-Identifier: MIT
// Drawing on demand: while something moves, a picture as small as it takes to keep up; then the
// full size in bands of rows, none of which keeps the browser waiting; then, for smooth edges, four
// samples a pixel.

const PLENTY = 30; // milliseconds that a picture or a band may take

const CORNERS = `#version 300 es
void main() {
    vec2 corner = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
`;
const STRETCH = `#version 300 es
precision highp float;
uniform sampler2D image;
uniform vec2 scale;
layout(location = 0) out vec4 colour;
void main() {
    colour = vec4(texture(image, gl_FragCoord.xy * scale).rgb, 1.0);
}
`;

// A picture that is kept: a texture of its size.
class Surface {
  constructor(gl) {
    this.gl = gl;
    this.texture = gl.createTexture();
    this.framebuffer = gl.createFramebuffer();
    this.width = this.height = 0;
    this.rows = 0; // that are drawn, from below
  }

  resize(width, height) {
    const gl = this.gl;
    this.rows = 0;
    if (width === this.width && height === this.height) return;
    this.width = width;
    this.height = height;
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
      gl.texParameteri(gl.TEXTURE_2D, filter, gl.LINEAR);
    }
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) {
      gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.texture, 0);
  }
}

const nextFrame = () => new Promise(resolve => requestAnimationFrame(resolve));

class Painter {
  constructor(gl) {
    this.gl = gl;
    this.parallel = gl.getExtension('KHR_parallel_shader_compile');
    this.small = new Surface(gl);
    this.full = new Surface(gl);
    this.fine = new Surface(gl);
    gl.bindVertexArray(gl.createVertexArray());
    gl.disable(gl.DITHER);
  }

  engine() {
    const gl = this.gl;
    const info = gl.getExtension('WEBGL_debug_renderer_info');
    const name = gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
    return name.replace(/^ANGLE \([^,]*, (.*), [^,]*\)$/, '$1'); // without vendor and driver
  }

  // Compiles in the background where the browser can. Throws an Error with the log.
  async compile(text) {
    const gl = this.gl;
    const program = gl.createProgram();
    const stages = [[gl.VERTEX_SHADER, CORNERS], [gl.FRAGMENT_SHADER, text]];
    const shaders = stages.map(([kind, source]) => {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      return shader;
    });
    gl.linkProgram(program);
    if (this.parallel) {
      while (gl.getProgramParameter(program, this.parallel.COMPLETION_STATUS_KHR) === false) {
        await nextFrame();
      }
    }
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
      throw new Error(shaders.map(shader => gl.getShaderInfoLog(shader)).join('') +
                      gl.getProgramInfoLog(program));
    }
    const at = {};
    const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS);
    for (let i = 0; i < count; ++i) {
      const {name, type} = gl.getActiveUniform(program, i);
      at[name] = {place: gl.getUniformLocation(program, name), type};
    }
    return {program, at, cost: 0}; // cost: milliseconds a pixel, 0 until it is known
  }

  set(compiled, values) {
    const gl = this.gl;
    gl.useProgram(compiled.program);
    for (const [name, {place, type}] of Object.entries(compiled.at)) {
      const value = values[name];
      if (type === gl.INT) gl.uniform1i(place, value);
      else if (type === gl.INT_VEC2) gl.uniform2iv(place, value);
      else if (type === gl.FLOAT) gl.uniform1f(place, value);
      else if (type === gl.FLOAT_VEC2) gl.uniform2fv(place, value);
      else if (type === gl.FLOAT_VEC3) gl.uniform3fv(place, value);
      else if (type === gl.FLOAT_VEC4) gl.uniform4fv(place, value);
    }
  }

  // Draws the next rows of a surface, waits until they are there, and returns the milliseconds.
  band(compiled, surface, rows, values) {
    const gl = this.gl;
    const began = performance.now();
    gl.bindFramebuffer(gl.FRAMEBUFFER, surface.framebuffer);
    gl.viewport(0, 0, surface.width, surface.height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(0, surface.rows, surface.width, rows);
    this.set(compiled, values(surface.width, surface.height));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.readPixels(0, surface.rows, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    gl.disable(gl.SCISSOR_TEST);
    surface.rows += rows;
    const took = performance.now() - began;
    const cost = took / (rows * surface.width);
    compiled.cost = compiled.cost ? 0.7 * compiled.cost + 0.3 * cost : cost;
    return took;
  }

  // As many rows as should take no longer than is pleasant.
  rowsOf(compiled, surface) {
    const rows = Math.floor(PLENTY / (compiled.cost * surface.width));
    return clamp(rows, Math.min(8, surface.height), surface.height);
  }

  // The whole picture, at a whole fraction of the full size. Returns milliseconds and size.
  sketch(compiled, width, height, values) {
    if (!compiled.cost) { // the first pixels also pay for what the driver put off
      this.small.resize(16, 16);
      this.band(compiled, this.small, 16, values);
      compiled.cost = 0;
      this.small.resize(64, 48);
      this.band(compiled, this.small, 48, values);
    }
    const part = clamp(Math.ceil(Math.sqrt(compiled.cost * width * height / PLENTY)), 1, 8);
    this.small.resize(Math.ceil(width / part), Math.ceil(height / part));
    const took = this.band(compiled, this.small, this.small.height, values);
    this.present(width, height, [this.small]);
    return took;
  }

  // Lays surfaces over one another, each as far as it is drawn, and shows them.
  present(width, height, surfaces) {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.useProgram(this.stretch.program);
    gl.enable(gl.SCISSOR_TEST);
    for (const surface of surfaces) {
      if (surface.rows === 0) continue;
      gl.bindTexture(gl.TEXTURE_2D, surface.texture);
      gl.scissor(0, 0, width, Math.floor(height * surface.rows / surface.height));
      gl.uniform2f(this.stretch.at.scale.place, 1 / width, 1 / height);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
    gl.disable(gl.SCISSOR_TEST);
  }

  // The bytes of a surface, four a pixel.
  pixels(surface) {
    const gl = this.gl;
    const bytes = new Uint8Array(4 * surface.width * surface.height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, surface.framebuffer);
    gl.readPixels(0, 0, surface.width, surface.height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    return bytes;
  }

  async prepare() {
    this.stretch = await this.compile(STRETCH);
  }
}
