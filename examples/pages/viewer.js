// SPDX-License-Identifier: MIT
// The page: holds the state, and draws when it changes.

const data = JSON.parse(byId('data').textContent);
const canvas = byId('canvas');
const orbit = new Orbit(data.camera);
const first = {...data.values, azimuth: azimuthOf(data.light), elevation: elevationOf(data.light)};
const state = {...first};
const LONG = 4000; // milliseconds that smooth edges may take
let view = 0, method = data.methods.findIndex(m => m.name === data.method);
let painter = null, compiled = null, backs = [];
let held = false, movedAt = -Infinity, drawing = false, changes = 0;

// The text of a step rule's shader, put together from pieces of the first one's and its own.
const textOf = one => one.pieces.map(piece =>
  typeof piece === 'string' ? piece : data.text.substr(piece[0], piece[1])).join('');

function fail(title, text, log) {
  document.documentElement.dataset.state = 'failed';
  byId('failure-title').textContent = title;
  byId('failure-text').textContent = text;
  byId('failure-log').textContent = log || '';
  byId('failure-log').hidden = !log;
  byId('failure').hidden = false;
  byId('panel').hidden = !log; // other step rules may still work, no WebGL never does
}

// The log, and the lines that it names.
function logWithLines(log, text) {
  const lines = text.split('\n');
  const named = [...new Set([...log.matchAll(/\b\d+:(\d+)/g)].map(m => Number(m[1])))];
  const shown = named.filter(n => n >= 1 && n <= lines.length).map(n => `${n}: ${lines[n - 1]}`);
  return [log.trim(), ...shown].join('\n');
}

// ---- What is drawn ------------------------------------------------------------------------------

// Values of all that a shader may ask for, by its names, for a picture of a size.
function valuesFor(width, height) {
  const seen = orbit.view(width / height);
  const values = {
    ...seen, size: [width, height], view, light: toward(state.azimuth, state.elevation)
  };
  for (const {name} of [...TRACING, ...LIGHTING]) values[name] = values[name] ?? state[name];
  // Half a pixel of the picture as it will be seen, also while it is drawn smaller.
  values.pixel_radius = state.pixel_radius * (seen.window[1] - seen.window[0]) / (2 * width);
  const named = Object.entries(values).map(([name, v]) => [data.names[name] || name, v]);
  return Object.fromEntries(named);
}

function size() {
  const dense = Math.min(window.devicePixelRatio || 1, 2);
  const width = Math.max(1, Math.round(canvas.clientWidth * dense));
  const height = Math.max(1, Math.round(canvas.clientHeight * dense));
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  return [width, height];
}

const say = (ms, width, height) =>
  byId('time').textContent = `${short(ms)} ms at ${width}\u00d7${height}`;

// Draws until nothing is left to do. Starts again whenever something changes.
async function draw() {
  if (drawing || !compiled || painter.gl.isContextLost()) return;
  drawing = true;
  try {
    for (let seen = -1; seen !== changes;) {
      seen = changes;
      await drawOnce(() => seen !== changes || painter.gl.isContextLost());
    }
  } finally {
    drawing = false;
  }
}

async function drawOnce(stale) {
  await nextFrame();
  const [width, height] = size();
  const sketched = painter.sketch(compiled, width, height, valuesFor);
  say(sketched, painter.small.width, painter.small.height);
  let shown = [painter.small];
  const most = painter.gl.getParameter(painter.gl.MAX_TEXTURE_SIZE);
  // Edges of numbers are not smoothed, and nothing where that would take long.
  const smooth = byId('smooth').checked && (view === 0 || view === 4) &&
                 2 * Math.max(width, height) <= most;
  let total = 0;
  for (const [surface, times] of [[painter.full, 1], [painter.fine, 2]]) {
    if (times === 2 && (!smooth || total > LONG / 4)) break;
    surface.resize(times * width, times * height);
    while (surface.rows < surface.height) {
      do await nextFrame(); while (!stale() && (held || performance.now() - movedAt < 150));
      if (stale()) return;
      const rows = Math.min(painter.rowsOf(compiled, surface), surface.height - surface.rows);
      total += painter.band(compiled, surface, rows, valuesFor);
      painter.present(width, height, [...shown, surface]);
      if (surface.rows === surface.height && times === 1) say(total, width, height);
    }
    shown = [surface];
  }
  showAverage();
  document.documentElement.dataset.state = 'drawn';
}

function changed() {
  ++changes;
  if (document.documentElement.dataset.state === 'drawn') {
    document.documentElement.dataset.state = 'drawing';
  }
  draw();
}

function moved() {
  movedAt = performance.now();
  changed();
}

// ---- What can be chosen -------------------------------------------------------------------------

function showSliders() {
  backs = [];
  for (const [parent, specs] of [[byId('tracing'), TRACING], [byId('lighting'), LIGHTING]]) {
    parent.replaceChildren();
    for (const spec of specs) {
      const read = {azimuth: 'light', elevation: 'light'}[spec.name] || spec.name;
      if (!compiled.at[data.names[read]]) continue;
      const {element, back} = slider(spec, state, () => {
        showLegend();
        moved();
      });
      parent.append(element);
      backs.push(back);
    }
  }
  byId('light').hidden = byId('lighting').children.length === 0;
}

function showLegend() {
  const {title, scale} = VIEWS[view];
  byId('legend').hidden = !scale;
  if (!scale) return;
  byId('legend-title').textContent = title;
  byId('legend-scale').replaceChildren(...scale(state.budget, data.components));
}

// The average beside the title, once the picture is there.
function showAverage() {
  const {title, average} = VIEWS[view];
  if (!average) return;
  const mean = average(painter.pixels(painter.full), state.budget);
  byId('legend-title').textContent = `${title}: ${mean.toFixed(2)} on average`;
}

const made = new Map(); // step rules that were compiled

async function choose(index) {
  method = index;
  const text = textOf(data.methods[index]);
  const waiting = setTimeout(() => {
    byId('notice').textContent = 'Compiling the shader\u2026';
    byId('notice').hidden = false;
  }, 200);
  try {
    if (!made.has(index)) made.set(index, painter.compile(text));
    const ready = await made.get(index);
    if (method !== index) return; // another one was chosen meanwhile
    compiled = ready;
    byId('source-lines').textContent = `(${text.split('\n').length - 1} lines of GLSL)`;
    byId('source-text').textContent = text;
    showSliders();
    changed();
  } catch (error) {
    fail('The shader does not compile here', painter.engine(), logWithLines(error.message, text));
  } finally {
    clearTimeout(waiting);
    byId('notice').hidden = true;
  }
}

function listen() {
  const views = VIEWS.slice(0, data.components > 1 ? 6 : 5).map(one => one.name);
  choice(byId('views'), 'view', views, view, i => {
    view = i;
    showLegend();
    changed();
  });
  const methods = data.methods.map(one => one.name.replace('_', ' '));
  choice(byId('methods'), 'method', methods, method, choose);
  orbit.listen(canvas, moved, down => {
    held = down;
  });
  byId('smooth').addEventListener('change', changed);
  byId('reset').addEventListener('click', () => {
    Object.assign(state, first);
    orbit.reset();
    backs.forEach(back => back());
    showLegend();
    changed();
  });
  byId('copy').addEventListener('click', async () => {
    const range = document.createRange();
    range.selectNodeContents(byId('source-text'));
    getSelection().removeAllRanges();
    getSelection().addRange(range);
    try {
      await navigator.clipboard.writeText(byId('source-text').textContent);
      byId('copy').textContent = 'Copied';
    } catch {
      byId('copy').textContent = 'Selected: copy it now';
    }
    setTimeout(() => byId('copy').textContent = 'Copy', 2000);
  });
  new ResizeObserver(changed).observe(canvas);
  canvas.addEventListener('webglcontextlost', event => {
    event.preventDefault();
    compiled = null;
    byId('notice').textContent = 'The graphics processor was reset\u2026';
    byId('notice').hidden = false;
  });
  canvas.addEventListener('webglcontextrestored', start);
}

async function start() {
  const gl = canvas.getContext('webgl2', {antialias: false, depth: false, alpha: false});
  if (!gl) {
    fail('This page needs WebGL 2', 'This browser does not offer it: perhaps it is too old, or ' +
         'hardware acceleration is switched off in its settings.');
    return;
  }
  made.clear();
  painter = new Painter(gl);
  byId('engine').textContent = painter.engine();
  await painter.prepare();
  await choose(method);
}

listen();
start();
