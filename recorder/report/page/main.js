// Entry of the page script: makes the static report interactive.
import 'uplot/dist/uPlot.min.css';
import { drawCharts } from './charts.js';
import { startLive } from './live.js';
import { startPlayback } from './playback.js';

const source = document.getElementById('report-data');
if (source) {
  const data = JSON.parse(source.textContent);
  document.documentElement.classList.add('scripted');
  drawCharts(data.charts);
  const host = document.querySelector('[data-playback]');
  if (host && data.scene) startPlayback(data.scene, host);
}
if ('live' in document.body.dataset) startLive();
