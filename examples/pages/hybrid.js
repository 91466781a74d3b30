// SPDX-License-Identifier: MIT
// A host that rasterises: it draws its triangles as ever, and then one triangle over all of the
// picture whose fragments trace the field and write gl_FragDepth. The order makes no difference.

const byId = id => document.getElementById(id);
const data = JSON.parse(byId('data').textContent);
const canvas = byId('canvas');
const orbit = new Orbit(data.camera);
// depth = a + b / z, from spt_glsl_depth(): what the projection of the triangles has, too.
const [a, b] = data.depth;

const CORNERS = `#version 300 es
void main() {
    vec2 corner = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
`;
const MESH_CORNERS = `#version 300 es
precision highp float;
uniform vec3 eye, right, up, forward;
uniform vec4 window;
uniform vec2 depth;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
out vec3 side;
void main() {
    vec3 from = position - eye;
    float z = dot(from, forward);
    vec2 size = window.yw - window.xz;
    vec2 from_middle = vec2(dot(from, right), dot(from, up)) - 0.5 * (window.xz + window.yw) * z;
    gl_Position.xy = 2.0 * from_middle / size;
    gl_Position.z = (2.0 * depth.x - 1.0) * z + 2.0 * depth.y; // clip space: -w to w
    gl_Position.w = z;
    side = normal;
}
`;
const MESH_SIDES = `#version 300 es
precision highp float;
uniform vec3 light;
in vec3 side;
layout(location = 0) out vec4 colour;
void main() {
    vec3 lit = vec3(0.86, 0.30, 0.20) * (0.35 + 0.65 * max(dot(side, light), 0.0));
    colour = vec4(sqrt(lit), 1.0);
}
`;

function fail(title, log) {
  document.documentElement.dataset.state = 'failed';
  byId('failure-title').textContent = title;
  byId('failure-log').textContent = log;
  byId('failure').hidden = false;
}

function compile(gl, vertex, fragment) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) {
      throw new Error(gl.getShaderInfoLog(shader));
    }
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    throw new Error(gl.getProgramInfoLog(program));
  }
  return program;
}

// A tube along a trefoil knot: six floats a corner, place and normal.
function knot(middle, radius, tube) {
  const along = u => [
    0.5 * radius * (2 + Math.cos(1.5 * u)) * Math.cos(u),
    0.5 * radius * (2 + Math.cos(1.5 * u)) * Math.sin(u),
    0.5 * radius * Math.sin(1.5 * u)
  ];
  const LONG = 200, ROUND = 20;
  const corner = (i, j) => {
    const u = 4 * Math.PI * i / LONG, v = 2 * Math.PI * j / ROUND;
    const here = along(u), ahead = add(along(u + 0.01), here, -1);
    const across = unit(cross(ahead, here)), out = unit(cross(across, ahead));
    const normal = add(out.map(c => Math.cos(v) * c), across, Math.sin(v));
    return [...add(add(middle, here), normal, tube), ...normal];
  };
  const numbers = [];
  for (let i = 0; i < LONG; ++i) {
    for (let j = 0; j < ROUND; ++j) {
      for (const [k, l] of [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]]) {
        numbers.push(...corner(i + k, j + l));
      }
    }
  }
  return new Float32Array(numbers);
}

const unitLight = unit(data.light);
const size = orbit.start * data.camera.tangent;
const mesh = knot(orbit.target, 0.3 * size, 0.05 * size);
let gl = null, programs = {}, corners = null;

function uniforms(program, values) {
  gl.useProgram(program);
  for (const [name, value] of Object.entries(values)) {
    const place = gl.getUniformLocation(program, name);
    if (place) gl['uniform' + value.length + 'fv'](place, value);
  }
}

function drawTriangles(view) {
  uniforms(programs.mesh, {...view, depth: [a, b], light: unitLight});
  gl.bindVertexArray(corners);
  gl.drawArrays(gl.TRIANGLES, 0, mesh.length / 6);
}

function drawField(view, width, height) {
  const settings = data.values;
  const named = {
    ...view, epsilon: settings.epsilon, relaxation: settings.relaxation,
    extrapolation: settings.extrapolation, slope_blend: settings.slope_blend,
    step_cap: settings.step_cap, light: unitLight, light_tangent: settings.light_tangent,
    occlusion: settings.occlusion, depth: [a, b], time: 0,
    pixel_radius: (view.window[1] - view.window[0]) / (2 * width)
  };
  const program = programs.field;
  uniforms(program, Object.fromEntries(
    Object.entries(named).map(([name, value]) => [data.names[name], [value].flat()])));
  gl.uniform2i(gl.getUniformLocation(program, data.names.size), width, height);
  gl.uniform1i(gl.getUniformLocation(program, data.names.budget), settings.budget);
  gl.bindVertexArray(null);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
}

// Draws 'triangles' and 'field', as many of them as are named, in that order.
function paint(parts) {
  const {width, height} = canvas;
  const view = orbit.view(width / height);
  gl.viewport(0, 0, width, height);
  gl.enable(gl.DEPTH_TEST);
  gl.clearColor(0.78, 0.85, 0.93, 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  for (const part of parts) {
    if (part === 'triangles') drawTriangles(view);
    else drawField(view, width, height);
  }
}

let asked = false, held = false;

function changed() {
  document.documentElement.dataset.state = 'drawing';
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => {
    asked = false;
    const dense = Math.min(window.devicePixelRatio || 1, 2) * (held ? 0.4 : 1);
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * dense));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * dense));
    const began = performance.now();
    paint(['triangles', 'field'].filter(part => byId(part).checked));
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits
    byId('time').textContent = `${Math.round(performance.now() - began)} ms`;
    document.documentElement.dataset.state = 'drawn';
  });
}

function start() {
  gl = canvas.getContext('webgl2', {antialias: false, alpha: false});
  if (!gl) return fail('This page needs WebGL 2', 'This browser does not offer it.');
  try {
    programs = {
      mesh: compile(gl, MESH_CORNERS, MESH_SIDES), field: compile(gl, CORNERS, data.text)
    };
  } catch (error) {
    return fail('A shader does not compile here', error.message);
  }
  corners = gl.createVertexArray();
  gl.bindVertexArray(corners);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, mesh, gl.STATIC_DRAW);
  for (let i = 0; i < 2; ++i) {
    gl.enableVertexAttribArray(i);
    gl.vertexAttribPointer(i, 3, gl.FLOAT, false, 24, 12 * i);
  }
  orbit.listen(canvas, changed, down => {
    held = down;
    if (!down) changed();
  });
  for (const part of ['triangles', 'field']) byId(part).addEventListener('change', changed);
  new ResizeObserver(changed).observe(canvas);
}

start();
