// The live page: body, head signals and interface drift as the windows complete.
import uPlot from 'uplot';
import { floats } from './bytes.js';
import { oncePerPicture } from './once_per_picture.js';
import { Stage } from './stage.js';
import { Viewer, hasWebGl } from './viewer.js';

const kCharts = { acceleration: 'acceleration [g]', speed: 'speed [m/s]', force: 'force [kN]',
                  drift: 'energy [J]' };
const kFont = '12px system-ui, "DejaVu Sans", sans-serif';

class GrowingChart {
  constructor(name, host) {
    this.data = [[], []];
    this.host = host;
    this.drawSoon = oncePerPicture(() => this.plot.setData(this.data));
    const axis = { font: kFont, labelFont: kFont, labelSize: 20, grid: { stroke: '#e6e9ec' } };
    this.plot = new uPlot({
      width: host.clientWidth, height: 170, legend: { show: false },
      scales: { x: { time: false } },
      axes: [{ ...axis, label: 'simulated time [ms]' }, { ...axis, label: kCharts[name], size: 58 }],
      series: [{}, { stroke: '#0072b2', width: 1.6, points: { show: false } }],
    }, this.data, host);
    new ResizeObserver(() => {
      if (host.clientWidth > 0) this.plot.setSize({ width: host.clientWidth, height: 170 });
    }).observe(host);
  }

  append({ t, y }) {
    const end = this.data[0].at(-1) ?? -Infinity;
    t.forEach((time, i) => {
      if (time <= end) return;
      this.data[0].push(time);
      this.data[1].push(y[i]);
    });
    this.host.dataset.points = String(this.data[0].length);
    this.drawSoon();
  }
}

export function startLive() {
  const state = document.querySelector('[data-output=state]');
  const time = document.querySelector('[data-output=time]');
  const canvas = document.querySelector('canvas');
  const view = document.querySelector('[data-action=view]');
  const charts = {};
  let stage = null;
  let viewer = null;
  for (const host of document.querySelectorAll('[data-live-chart]')) {
    charts[host.dataset.liveChart] = new GrowingChart(host.dataset.liveChart, host);
  }
  const source = new EventSource('/events');
  const on = (name, take) => source.addEventListener(name, (e) => take(JSON.parse(e.data)));
  on('scene', (scene) => {
    if (!hasWebGl()) return;
    stage = new Stage(scene);
    viewer = new Viewer(canvas, stage);
    viewer.look('oblique', 0);
    view.addEventListener('change', () => viewer.look(view.value, stage.headPosition.y));
  });
  on('frames', ({ poses }) => {
    if (!stage) return;
    const before = stage.headPosition.clone();
    const isFirst = stage.count === 0;
    stage.append(floats(poses));
    stage.place(stage.end);
    if (!isFirst) viewer.shift(stage.headPosition.clone().sub(before).setX(0).setZ(0));
    viewer.draw();
    time.textContent = `${(1e3 * stage.end).toFixed(1)} ms`;
    canvas.dataset.frames = String(stage.count);
  });
  on('samples', (samples) => {
    for (const [name, news] of Object.entries(samples)) charts[name]?.append(news);
  });
  on('state', (s) => {
    state.textContent = `${s.scenario} (${s.mode}): ${s.t_ms.toFixed(2)} ms of ${s.duration_ms} ms `
      + `after first contact, ${s.contacts} contacts`;
    document.querySelector('progress').value = Math.min(1, s.t_ms / s.duration_ms);
  });
  on('end', ({ reason }) => {
    state.textContent = reason ? `The run has ended early: ${reason}` : 'The run is complete.';
  });
  on('report', () => {
    source.close();
    location.href = '/report.html';
  });
}
