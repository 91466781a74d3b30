// SPDX-License-Identifier: MIT
// The panel: what can be chosen, and what the colours mean.

const byId = id => document.getElementById(id);

function make(tag, properties, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

// Three digits that matter, without tails of zeros.
const short = v => Number(v.toPrecision(3)).toString();
const degrees = v => Math.round(v * 180 / Math.PI) + '\u00b0';

// What the shaders can be told, in order. Shown is what the shader of the step rule reads. A curve
// of 'log' moves by factors.
const TRACING = [
  {name: 'budget', label: 'Budget, evaluations a ray', low: 4, high: 1024, curve: 'log',
   whole: true},
  {name: 'relaxation', label: 'Relaxation', low: 1, high: 1.99},
  {name: 'extrapolation', label: 'Extrapolation', low: 0, high: 1},
  {name: 'slope_blend', label: 'Weight of the newest slope', low: 0.01, high: 1},
  {name: 'step_cap', label: 'Longest step, radii', low: 1, high: 10},
  {name: 'pixel_radius', label: 'Tolerance, half pixels', low: 0, high: 8},
  {name: 'epsilon', label: 'Least tolerance, world length', low: 1e-6, high: 0.1, curve: 'log'},
  {name: 'time', label: 'Time', low: 0, high: 20}
];
const LIGHTING = [
  {name: 'azimuth', label: 'Direction', low: -Math.PI, high: Math.PI, show: degrees},
  {name: 'elevation', label: 'Height', low: 0.05, high: 1.5, show: degrees},
  {name: 'light_tangent', label: 'Softness', low: 0.005, high: 0.5, curve: 'log'},
  {name: 'occlusion', label: 'Reach of ambient occlusion', low: 0.005, high: 1, curve: 'log'}
];

// A slider of 1000 steps for values[spec.name]; back() shows a value that was set elsewhere.
function slider(spec, values, changed) {
  const log = spec.curve === 'log';
  const from = v => log ? Math.log(v) : v;
  const low = from(spec.low), high = from(spec.high);
  const output = make('output', {});
  const input = make('input', {type: 'range', min: 0, max: 1000, id: 'slider-' + spec.name});
  const back = () => {
    const v = values[spec.name];
    input.value = Math.round(1000 * (from(v) - low) / (high - low));
    output.value = (spec.show || short)(v);
    input.setAttribute('aria-valuetext', output.value);
  };
  input.addEventListener('input', () => {
    const at = low + input.valueAsNumber / 1000 * (high - low);
    const v = log ? Math.exp(at) : at;
    values[spec.name] = spec.whole ? Math.round(v) : v;
    output.value = (spec.show || short)(values[spec.name]);
    input.setAttribute('aria-valuetext', output.value);
    changed();
  });
  back();
  return {element: make('label', {}, make('span', {textContent: spec.label}), output, input), back};
}

// Buttons of which one is chosen.
function choice(parent, name, labels, first, chosen) {
  labels.forEach((label, i) => {
    const input = make('input', {type: 'radio', name, value: i, id: name + '-' + i});
    input.checked = i === first;
    input.addEventListener('change', () => chosen(i));
    parent.append(make('label', {}, input, make('span', {textContent: label})));
  });
}

// ---- Legends ------------------------------------------------------------------------------------

// Red, green and blue from 0 to 1 as spt_heat() of the shaders has them, for even steps.
const HEAT = [[0.02, 0.02, 0.12], [0.1, 0.25, 0.65], [0.1, 0.6, 0.45], [0.95, 0.8, 0.25],
              [1, 0.98, 0.92]];
// By the number of the outcome, as spt_view_of() has them.
const OUTCOMES = [['miss', [0.16, 0.18, 0.22]], ['hit', [0.36, 0.62, 0.48]],
                  ['undecided: budget used up', [0.94, 0.72, 0.22]],
                  ['not finite', [0.85, 0.2, 0.2]]];
const NORMALS = [['x', [1, 0.5, 0.5]], ['y, up', [0.5, 1, 0.5]], ['z', [0.5, 0.5, 1]]];

// spt_heat() of the shaders.
function heat(share) {
  const at = clamp(4 * share, 0, 4), step = Math.min(Math.floor(at), 3);
  return HEAT[step].map((v, i) => v + (at - step) * (HEAT[step + 1][i] - v));
}

// The mean of what a picture of evaluations shows. Exact as long as two neighbours of 0 .. budget
// have different colours, up to a budget of about 300.
function meanEvaluations(pixels, budget) {
  const counts = new Map();
  for (let i = 0; i < pixels.length; i += 4) {
    const colour = pixels[i] << 16 | pixels[i + 1] << 8 | pixels[i + 2];
    counts.set(colour, (counts.get(colour) || 0) + 1);
  }
  const known = Array.from({length: budget + 1}, (_, n) => heat(n / budget).map(v => 255 * v));
  let sum = 0;
  for (const [colour, count] of counts) {
    const rgb = [colour >> 16, colour >> 8 & 255, colour & 255];
    let best = 0, least = Infinity;
    known.forEach((like, n) => {
      const apart = Math.hypot(...add(like, rgb, -1));
      if (apart < least) [best, least] = [n, apart];
    });
    sum += best * count;
  }
  return sum / (pixels.length / 4);
}

const css = rgb => `rgb(${rgb.map(v => Math.round(255 * v)).join(', ')})`;

// spt_colour_of() of the shaders.
const colourOf = number =>
  [0.618034, 0.754878, 0.569840].map(v => 0.25 + 0.6 * ((number + 1) * v % 1));

// A bar from the palette's dark end to its light one, with numbers at even steps.
function bar(texts) {
  const colours = make('div', {className: 'bar'});
  colours.style.background = `linear-gradient(to right, ${HEAT.map(css).join(', ')})`;
  const numbers = texts.map(text => make('span', {textContent: text}));
  return [colours, make('div', {className: 'ticks'}, ...numbers)];
}

// Names beside patches of colour.
const patches = pairs => [make('div', {className: 'patches'}, ...pairs.map(([name, rgb]) => {
  const patch = make('span', {textContent: name});
  patch.style.setProperty('--patch', css(rgb));
  return patch;
}))];

// The names of the views, and their legends: a title and elements.
const VIEWS = [
  {name: 'Picture'},
  {name: 'Evaluations', title: 'Evaluations a ray', average: meanEvaluations,
   scale: (budget) => bar([0, 1, 2, 3, 4].map(i => short(budget * i / 4)))},
  {name: 'Residual', title: 'Distance left at the hit, over the tolerance',
   scale: () => bar(['1e-6', '3e-5', '0.001', '0.03', '1'])}, // 2^-20, 2^-15 ... 1
  {name: 'Outcome', title: 'How the ray ended', scale: () => patches(OUTCOMES)},
  {name: 'Normals', title: 'Axes of the normal', scale: () => patches(NORMALS)},
  {name: 'Parts', title: 'Number of the part that was hit', scale: (budget, parts) =>
    patches(Array.from({length: parts}, (_, i) => [i.toString(), colourOf(i)]))}
];
