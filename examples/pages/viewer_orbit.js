// SPDX-License-Identifier: MIT
// A camera that turns about a point, moved by mouse, touch, wheel and keys. y is up.

const add = (a, b, times = 1) => a.map((v, i) => v + times * b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = a => a.map(v => v / Math.hypot(...a));
const clamp = (v, low, high) => Math.min(Math.max(v, low), high);

// The unit vector of an azimuth and an elevation.
const toward = (azimuth, elevation) => [
  Math.cos(elevation) * Math.sin(azimuth), Math.sin(elevation),
  Math.cos(elevation) * Math.cos(azimuth)
];
const azimuthOf = v => Math.atan2(v[0], v[2]);
const elevationOf = v => Math.asin(clamp(v[1] / Math.hypot(...v), -1, 1));

class Orbit {
  // first: {eye, target, tangent, far}; tangent is half the width of a 3:2 picture at distance 1.
  constructor(first) {
    this.first = first;
    this.reset();
  }

  reset() {
    const back = add(this.first.eye, this.first.target, -1);
    this.target = [...this.first.target];
    this.start = this.distance = Math.hypot(...back);
    this.azimuth = azimuthOf(back);
    this.elevation = elevationOf(back);
  }

  turn(right, up) {
    this.azimuth -= right;
    this.elevation = clamp(this.elevation + up, -1.55, 1.55);
  }

  zoom(factor) {
    this.distance = clamp(this.distance * factor, this.start / 200, this.start * 20);
  }

  // By fractions of the picture's height.
  move(right, up) {
    const view = this.view(1);
    const scale = this.distance * (view.window[3] - view.window[2]);
    this.target = add(add(this.target, view.right, -right * scale), view.up, -up * scale);
  }

  // What the shader wants to know, for a picture so many times as wide as high. A narrow picture
  // shows nearly all of the width, and more of the height.
  view(aspect) {
    const back = toward(this.azimuth, this.elevation);
    const forward = back.map(v => -v);
    const right = unit(cross(forward, [0, 1, 0]));
    const high = this.first.tangent * Math.max(1 / 1.5, 0.92 / aspect);
    return {
      eye: add(this.target, back, this.distance),
      right, up: cross(right, forward), forward,
      window: [-high * aspect, high * aspect, -high, high],
      range: [0, this.first.far * Math.max(1, this.distance / this.start)]
    };
  }

  // Listens to an element; changed() is called after every movement, and held(true or false) when
  // a finger or button goes down and when the last goes up.
  listen(element, changed, held) {
    const down = new Map();
    const middle = () => {
      const all = [...down.values()];
      const x = all.reduce((sum, p) => sum + p.x, 0) / all.length;
      const y = all.reduce((sum, p) => sum + p.y, 0) / all.length;
      const spread = all.length > 1 ? Math.hypot(all[0].x - all[1].x, all[0].y - all[1].y) : 0;
      return {x, y, spread};
    };
    const lift = event => {
      if (down.delete(event.pointerId) && down.size === 0) held(false);
    };
    element.addEventListener('pointerdown', event => {
      element.setPointerCapture(event.pointerId);
      down.set(event.pointerId, {x: event.clientX, y: event.clientY});
      if (down.size === 1) held(true);
    });
    element.addEventListener('pointermove', event => {
      if (!down.has(event.pointerId)) return;
      const before = middle();
      down.set(event.pointerId, {x: event.clientX, y: event.clientY});
      const after = middle();
      const right = (after.x - before.x) / element.clientHeight;
      const lower = (after.y - before.y) / element.clientHeight;
      if (down.size > 1) {
        if (before.spread > 0 && after.spread > 0) this.zoom(before.spread / after.spread);
        this.move(right, -lower);
      } else if (event.buttons > 1 || event.shiftKey) {
        this.move(right, -lower);
      } else {
        this.turn(3.5 * right, 3.5 * lower);
      }
      changed();
    });
    for (const ending of ['pointerup', 'pointercancel', 'lostpointercapture']) {
      element.addEventListener(ending, lift);
    }
    element.addEventListener('contextmenu', event => event.preventDefault());
    element.addEventListener('wheel', event => {
      event.preventDefault();
      const lines = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 30;
      this.zoom(Math.exp(0.0015 * lines * event.deltaY));
      changed();
    }, {passive: false});
    element.addEventListener('keydown', event => {
      const turns = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
      const zooms = {'+': 0.9, '=': 0.9, '-': 1 / 0.9};
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      if (turns[event.key]) this.turn(...turns[event.key].map(v => 0.08 * v));
      else if (zooms[event.key]) this.zoom(zooms[event.key]);
      else return;
      event.preventDefault();
      changed();
    });
  }
}
