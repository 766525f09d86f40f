// Interactive charts: zoom by dragging, values under the pointer, one cursor across all charts.
import uPlot from 'uplot';
import { floats } from './bytes.js';

const kHeight = 300;
const kFont = '12px system-ui, "DejaVu Sans", sans-serif';
const sync = uPlot.sync('time');

const holes = (values) => Array.from(values, (v) => (Number.isFinite(v) ? v : null));
const dashes = (text) => (text ? text.split(' ').map(Number) : undefined);
const shown = (value) => (value == null ? '–' : Number(value.toPrecision(4)).toString());

/** The border style that comes nearest to a curve's dashes, for its mark in the legend. */
function borderOf(dash) {
  if (!dash) return 'solid';
  return Number(dash.split(' ')[0]) < 3 ? 'dotted' : 'dashed';
}

const kSymbolEvery = 84;  // px
const kSymbols = ['○', '□', '△', '◇', '●', '■', '▲', '◆'];
const symbolOf = (curve) => (curve.symbol < 0 ? '' : kSymbols[curve.symbol % kSymbols.length]);

/** Symbols along the curves, so that they are told apart without colour. */
function drawSymbols(plot, curves) {
  const { ctx, bbox } = plot;
  const ratio = devicePixelRatio;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.lineWidth = 1.2 * ratio;
  curves.forEach((curve, k) => {
    if (curve.symbol < 0 || !plot.series[k + 1].show) return;
    const every = kSymbolEvery * ratio;
    const shape = curve.symbol % 4;
    ctx.strokeStyle = curve.colour;
    ctx.fillStyle = Math.floor(curve.symbol / 4) % 2 === 1 ? curve.colour : '#fff';
    for (let at = every * (k + 0.5) / curves.length; at < bbox.width; at += every) {
      const i = sampleNear(plot.data[k + 1], plot.valToIdx(plot.posToVal(at / ratio, 'x')));
      if (i < 0) continue;
      const value = plot.data[k + 1][i];
      const x = plot.valToPos(plot.data[0][i], 'x', true);
      const y = plot.valToPos(value, 'y', true);
      const r = 3.2 * ratio;
      ctx.beginPath();
      if (shape === 0) ctx.arc(x, y, r, 0, 2 * Math.PI);
      if (shape === 1) ctx.rect(x - r, y - r, 2 * r, 2 * r);
      if (shape === 2) polygon(ctx, [[x, y - 1.2 * r], [x + 1.2 * r, y + 0.9 * r], [x - 1.2 * r, y + 0.9 * r]]);
      if (shape === 3) polygon(ctx, [[x, y - 1.3 * r], [x + 1.3 * r, y], [x, y + 1.3 * r], [x - 1.3 * r, y]]);
      ctx.fill();
      ctx.stroke();
    }
  });
  ctx.restore();
}

/** The index next to `i` at which a series has a value (curves may stand on different times). */
function sampleNear(values, i) {
  for (let off = 0; off < 100; ++off) {
    if (values[i + off] != null) return i + off;
    if (values[i - off] != null) return i - off;
  }
  return -1;
}

function polygon(ctx, corners) {
  corners.forEach(([x, y], i) => (i === 0 ? ctx.moveTo(x, y) : ctx.lineTo(x, y)));
  ctx.closePath();
}

/** Vertical lines such as "head contact". */
function drawMarks(plot, marks) {
  const { ctx, bbox } = plot;
  const ratio = devicePixelRatio;
  ctx.save();
  ctx.strokeStyle = '#444';
  ctx.fillStyle = '#333';
  ctx.font = `${11 * ratio}px system-ui, "DejaVu Sans", sans-serif`;
  ctx.setLineDash([4 * ratio, 3 * ratio]);
  ctx.textBaseline = 'top';
  for (const mark of marks) {
    const x = plot.valToPos(mark.x, 'x', true);
    if (x < bbox.left || x > bbox.left + bbox.width) continue;
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    const isRight = x > bbox.left + 0.6 * bbox.width;
    ctx.textAlign = isRight ? 'right' : 'left';
    ctx.fillText(mark.label, x + (isRight ? -4 : 4) * ratio, bbox.top + 3 * ratio);
  }
  ctx.restore();
}

function options(chart, width) {
  const axis = { font: kFont, labelFont: kFont, labelSize: 22, stroke: '#1b1f23',
                 grid: { stroke: '#e6e9ec', width: 1 }, ticks: { stroke: '#9aa3ab', width: 1 } };
  return {
    width,
    height: kHeight,
    cursor: { sync: { key: sync.key, setSeries: false }, drag: { x: true, y: false } },
    scales: { x: { time: false }, y: { range: { min: { pad: 0.06 }, max: { pad: 0.06 } } } },
    axes: [{ ...axis, label: chart.x_label },
           { ...axis, label: chart.y_label, size: 62, values: (_, ticks) => ticks.map(shown) }],
    legend: { markers: { dash: (_, i) => borderOf(chart.curves[i - 1]?.dash) } },
    series: [
      { label: 't [ms]', value: (_, v) => (v == null ? '–' : v.toFixed(1)) },
      ...chart.curves.map((curve) => ({
        label: `${symbolOf(curve)} ${curve.label}`.trim(), stroke: curve.colour, width: curve.width, dash: dashes(curve.dash),
        points: { show: false }, value: (_, v) => shown(v) })),
    ],
    hooks: { draw: [(plot) => drawMarks(plot, chart.marks),
                    (plot) => drawSymbols(plot, chart.curves)] },
  };
}

function isSameGrid(curves) {
  const first = curves[0].x;
  return curves.every((c) => c.x.length === first.length && c.x.every((v, i) => v === first[i]));
}

export function drawChart(chart, host) {
  const curves = chart.curves.map((c) => ({ ...c, x: floats(c.x), y: floats(c.y) }));
  const data = isSameGrid(curves)
    ? [Array.from(curves[0].x), ...curves.map((c) => holes(c.y))]
    : uPlot.join(curves.map((c) => [Array.from(c.x), holes(c.y)]));
  const plot = new uPlot(options({ ...chart, curves }, host.clientWidth), data, host);
  new ResizeObserver(() => {
    if (host.clientWidth > 0 && host.clientWidth !== plot.width) {
      plot.setSize({ width: host.clientWidth, height: kHeight });
    }
  }).observe(host);
  return plot;
}

/** Draws every chart over time; paths in space keep their static drawing. */
export function drawCharts(charts) {
  const byId = new Map(charts.map((chart) => [chart.id, chart]));
  const draw = (host) => {
    const chart = byId.get(host.dataset.chart);
    if (!chart || chart.trajectory || host.childElementCount > 0) return;
    host.closest('figure').classList.add('drawn');
    drawChart(chart, host);
    const root = document.documentElement.dataset;
    root.charts = String(Number(root.charts ?? 0) + 1);
  };
  for (const host of document.querySelectorAll('[data-chart]')) {
    const fold = host.closest('details');
    if (!fold) {
      draw(host);
    } else {
      fold.addEventListener('toggle', () => {
        if (fold.open) fold.querySelectorAll('[data-chart]').forEach(draw);
      });
    }
  }
}
