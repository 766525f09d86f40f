// Playback of the impact: orbit, scrub, speed, three standard views.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Stage } from './stage.js';

/** Camera offsets from the target (m). The pedestrian faces +x, the car travels along +y. */
const kViews = { oblique: [-3.4, 2.6, 1.7], posterior: [-5, 0.001, 0], superior: [-0.001, 0, 5] };

function hasWebGl() {
  return Boolean(document.createElement('canvas').getContext('webgl2'));
}

export function startPlayback(data, host) {
  if (!hasWebGl()) {
    host.dataset.fault = 'webgl';
    host.textContent = 'This browser has no WebGL 2; the pictures above show the same run.';
    return;
  }
  const stage = new Stage(data);
  const canvas = host.querySelector('canvas');
  const part = (name) => host.querySelector(`[data-action=${name}]`);
  const output = host.querySelector('[data-output=time]');
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
  renderer.setPixelRatio(Math.min(2, devicePixelRatio));
  const camera = new THREE.PerspectiveCamera(36, 1, 0.05, 60);
  camera.up.set(0, 0, 1);
  const orbit = new OrbitControls(camera, canvas);
  let time = stage.begin;
  let isPlaying = false;
  let last = null;

  const draw = () => {
    stage.place(time);
    renderer.render(stage.scene, camera);
    output.textContent = `${(1e3 * time).toFixed(1)} ms`;
    part('scrub').value = String(Math.round(1000 * (time - stage.begin) / (stage.end - stage.begin)));
    host.dataset.time = time.toFixed(4);
    host.dataset.head = stage.headPosition.toArray().map((v) => v.toFixed(3)).join(' ');
  };
  const show = (t) => {
    const before = stage.headPosition.clone();
    time = t;
    stage.place(time);
    if (part('follow').checked) {
      const moved = stage.headPosition.clone().sub(before);
      camera.position.add(moved);
      orbit.target.add(moved);
    }
    orbit.update();
    draw();
  };
  const resize = () => {
    renderer.setSize(canvas.clientWidth, canvas.clientHeight, false);
    camera.aspect = canvas.clientWidth / Math.max(1, canvas.clientHeight);
    camera.updateProjectionMatrix();
    draw();
  };
  const look = (name) => {
    stage.place(time);
    const middle = stage.begin + 0.6 * (stage.end - stage.begin);
    const now = time;
    stage.place(middle);
    const ahead = stage.headPosition.y;
    stage.place(now);
    orbit.target.set(0, part('follow').checked ? stage.headPosition.y : 0.5 * ahead, 0.9);
    camera.position.copy(orbit.target).add(new THREE.Vector3(...kViews[name]));
    orbit.update();
    draw();
  };
  const step = (now) => {
    if (!isPlaying) return;
    const passed = last === null ? 0 : Math.min(100, now - last);  // ms
    const next = time + 1e-3 * passed * Number(part('speed').value);
    last = now;
    show(next > stage.end ? stage.begin : next);
    requestAnimationFrame(step);
  };
  const play = (want) => {
    isPlaying = want;
    part('play').textContent = isPlaying ? 'Pause' : 'Play';
    last = null;
    if (isPlaying) requestAnimationFrame(step);
  };

  part('play').addEventListener('click', () => play(!isPlaying));
  part('scrub').addEventListener('input', (event) => {
    play(false);
    show(stage.begin + (stage.end - stage.begin) * Number(event.target.value) / 1000);
  });
  part('view').addEventListener('change', (event) => look(event.target.value));
  orbit.addEventListener('change', draw);
  new ResizeObserver(resize).observe(canvas);
  resize();
  look('oblique');
}
