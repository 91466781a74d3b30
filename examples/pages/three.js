// SPDX-License-Identifier: MIT
// One mesh covers the picture. Its fragments trace the field along the camera's rays and write the
// depth that a mesh would have there, so that meshes and field hide each other as they should.
import * as THREE from 'three';

const data = JSON.parse(document.getElementById('data').textContent);
const canvas = document.getElementById('canvas');
const orbit = new Orbit(data.camera);
const renderer = new THREE.WebGLRenderer({canvas, antialias: true});
const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera();
const sun = new THREE.Vector3(...data.light).normalize();

const field = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), new THREE.ShaderMaterial({
  uniforms: {
    clipOfWorld: {value: new THREE.Matrix4()}, worldOfClip: {value: new THREE.Matrix4()},
    sun: {value: sun}, pixelRadius: {value: 0}, reach: {value: data.camera.far},
    budget: {value: data.values.budget}
  },
  vertexShader: `
    varying vec2 place;
    void main() {
        place = position.xy;
        gl_Position = vec4(position.xy, 0.0, 1.0);
    }`,
  fragmentShader: document.getElementById('fragment').textContent
}));
field.frustumCulled = false; // it is everywhere
scene.add(field);

const size = orbit.start * data.camera.tangent;
const knot = new THREE.Mesh(new THREE.TorusKnotGeometry(0.3 * size, 0.05 * size, 160, 16),
                            new THREE.MeshStandardMaterial({color: 0xd2502e, roughness: 0.4}));
knot.position.set(...orbit.target);
const lamp = new THREE.DirectionalLight(0xffffff, 3);
lamp.position.copy(sun);
scene.add(knot, lamp, new THREE.HemisphereLight(0xbfd4ff, 0x554f48, 1.5));
scene.background = new THREE.Color(0.55, 0.68, 0.85);

renderer.debug.onShaderError = (gl, program, vertex, fragment) =>
  fail('The shader does not compile here', gl.getShaderInfoLog(fragment));

let asked = false;
function draw() {
  asked = false;
  const width = canvas.parentElement.clientWidth, height = canvas.parentElement.clientHeight;
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.setSize(width, height, false);
  const {eye, forward, window, range} = orbit.view(width / height);
  camera.fov = 2 * Math.atan(window[3]) * 180 / Math.PI;
  camera.aspect = width / height;
  camera.near = orbit.start / 50;
  camera.far = range[1];
  camera.position.set(...eye);
  camera.lookAt(...add(eye, forward));
  camera.updateProjectionMatrix();
  camera.updateMatrixWorld();
  const {clipOfWorld, worldOfClip, pixelRadius, reach} = field.material.uniforms;
  clipOfWorld.value.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  worldOfClip.value.copy(clipOfWorld.value).invert();
  pixelRadius.value = window[3] / renderer.domElement.height;
  reach.value = range[1];
  renderer.render(scene, camera);
  if (document.documentElement.dataset.state !== 'failed') {
    document.documentElement.dataset.state = 'drawn';
  }
}

function changed() {
  document.documentElement.dataset.state = 'drawing';
  if (!asked) requestAnimationFrame(draw);
  asked = true;
}
orbit.listen(canvas, changed, () => {});
new ResizeObserver(changed).observe(canvas.parentElement);
