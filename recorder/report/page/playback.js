// Playback of the impact: orbit, scrub, speed, three standard views.
import { Stage } from './stage.js';
import { Viewer, hasWebGl } from './viewer.js';

export function startPlayback(data, host) {
  if (!hasWebGl()) {
    host.dataset.fault = 'webgl';
    host.textContent = 'This browser has no WebGL 2; the pictures above show the same run.';
    return;
  }
  const stage = new Stage(data);
  const part = (name) => host.querySelector(`[data-action=${name}]`);
  const output = host.querySelector('[data-output=time]');
  let time = stage.begin;
  let isPlaying = false;
  let last = null;

  stage.place(time);
  const viewer = new Viewer(host.querySelector('canvas'), stage);
  const show = (t) => {
    const before = stage.headPosition.clone();
    time = t;
    stage.place(time);
    if (part('follow').checked) viewer.shift(stage.headPosition.clone().sub(before));
    viewer.draw();
    output.textContent = `${(1e3 * time).toFixed(1)} ms`;
    part('scrub').value = String(Math.round(1000 * (time - stage.begin) / (stage.end - stage.begin)));
    host.dataset.time = time.toFixed(4);
    host.dataset.head = stage.headPosition.toArray().map((v) => v.toFixed(3)).join(' ');
  };
  const look = (name) => {
    const middle = 0.5 * stage.headAt(stage.begin + 0.6 * (stage.end - stage.begin)).y;
    stage.place(time);
    viewer.look(name, part('follow').checked ? stage.headPosition.y : middle);
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
  look('oblique');
  show(time);
}
