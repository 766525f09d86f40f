// node live_test.mjs CHROMIUM PROGRAMS SCENARIO FOLDER: a run with --watch whose reader goes away in
// the middle, then its log growing again, piece by piece, before a headless browser: signals and
// body follow, and the server outlives the browser.
// Exit 77 means skipped: the page was built without npm, or the browser does not start here.
import { spawn } from 'node:child_process';
import { appendFileSync, existsSync, mkdirSync, readFileSync, rmSync } from 'node:fs';
import { Browser, pause } from '../recorder/report/browser.mjs';

const [chromium, programs, scenario, folder] = process.argv.slice(2);
const kSkipped = 77;
const kPieces = 40;
let failed = 0;

function expect(isTrue, text) {
  if (isTrue) return;
  console.log(`FAILED: ${text}`);
  failed = 1;
}

/** A program, what it says, and its end. */
class Program {
  constructor(name, options) {
    this.text = '';
    this.process = spawn(`${programs}/${name}`, options);
    for (const stream of [this.process.stdout, this.process.stderr]) {
      stream.on('data', (data) => { this.text += data; });
    }
    this.end = new Promise((resolve) => { this.process.on('exit', resolve); });
  }

  /** The live page's address, once it is told. */
  async address() {
    for (let i = 0; i < 600; ++i) {
      const found = this.text.match(/http:\/\/[0-9.:]+\//)?.[0];
      if (found || this.process.exitCode !== null || this.text.includes('no live page')) return found;
      await pause(100);
    }
    return undefined;
  }
}

/** Reads some events and goes away, as a closed browser does. */
async function lookBriefly(url) {
  const leave = new AbortController();
  const events = await fetch(`${url}events`, { signal: leave.signal });
  const { value } = await events.body.getReader().read();
  leave.abort();
  return new TextDecoder().decode(value);
}

async function watchedRun(out) {
  const run = new Program('crosswalk', [
    'run', scenario, '--mode', 'multibody', '--until-ms', '20', '--watch', '--out', out]);
  const url = await run.address();
  if (!url) {
    console.log(run.text);
    process.exit(run.text.includes('npm') ? kSkipped : 1);
  }
  const text = await lookBriefly(url);
  expect(text.startsWith('id: 0') || text.startsWith(':'), `events come, found: ${text.slice(0, 80)}`);
  expect(await run.end === 0, `the run ends well without its reader:\n${run.text}`);
  for (const name of ['channels.csv', 'report.html']) expect(existsSync(`${out}/${name}`), name);
}

const points = 'Number(document.querySelector("[data-live-chart=acceleration]").dataset.points ?? 0)';
const frames = 'Number(document.querySelector("canvas").dataset.frames ?? 0)';

async function growingPage(browser, log, out) {
  rmSync(out, { recursive: true, force: true });
  mkdirSync(out, { recursive: true });
  const watch = new Program('recorder', ['watch', out, '--port', '0']);
  const url = await watch.address();
  await browser.open(url);
  const piece = Math.ceil(log.length / kPieces);
  const add = (i) => appendFileSync(`${out}/signals.lcmlog`, log.subarray(i * piece, (i + 1) * piece));
  for (let i = 0; i < kPieces / 2; ++i) add(i);
  expect(await browser.until(`${points} > 10`, 60), 'acceleration is drawn');
  const before = [await browser.value(points), await browser.value(frames)];
  for (let i = kPieces / 2; i < kPieces - 1; ++i) add(i);
  expect(await browser.until(`${points} > ${before[0]}`, 60), 'acceleration follows the log');
  if (await browser.value('!!document.createElement("canvas").getContext("webgl2")')) {
    expect(await browser.until(`${frames} > ${before[1]}`, 60), 'the body moves');
  }
  console.log(`points and frames: ${before}, then ${await browser.value(points)}, `
    + `${await browser.value(frames)}`);
  expect(browser.faults.length === 0, `no script errors, found: ${browser.faults.join('; ')}`);
  browser.close();
  await pause(500);
  add(kPieces - 1);
  expect((await fetch(url)).ok, 'the server outlives the browser');
  watch.process.kill('SIGINT');
  expect(await watch.end === 0, 'the server ends when asked');
}

async function main() {
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  await watchedRun(`${folder}/watched`);
  const browser = new Browser(chromium, folder);
  try {
    await browser.send('Browser.getVersion');
  } catch (error) {
    console.log(`the browser does not start: ${error.message}`);
    process.exit(kSkipped);
  }
  await growingPage(browser, readFileSync(`${folder}/watched/signals.lcmlog`), `${folder}/growing`);
}

try {
  await main();
} catch (error) {
  expect(false, error.message);
}
process.exit(failed);
