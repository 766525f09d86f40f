// node live_test.mjs CHROMIUM PROGRAMS SCENARIO FOLDER: a run with --watch, its page in a headless
// browser: signals and body come while windows complete, a closed browser does not matter.
// Exit 77 means skipped: the page was built without npm, or the browser does not start here.
import { spawn } from 'node:child_process';
import { existsSync, rmSync } from 'node:fs';
import { Browser, pause } from '../recorder/report/browser.mjs';

const [chromium, programs, scenario, folder] = process.argv.slice(2);
const kSkipped = 77;
let failed = 0;

function expect(isTrue, text) {
  if (isTrue) return;
  console.log(`FAILED: ${text}`);
  failed = 1;
}

/** `crosswalk run --watch`: its output, its live page's address and its end. */
class WatchedRun {
  constructor(out, untilMs) {
    rmSync(out, { recursive: true, force: true });
    this.text = '';
    this.process = spawn(`${programs}/crosswalk`, [
      'run', scenario, '--mode', 'multibody', '--until-ms', String(untilMs), '--watch', '--out', out]);
    for (const stream of [this.process.stdout, this.process.stderr]) {
      stream.on('data', (data) => { this.text += data; });
    }
    this.end = new Promise((resolve) => { this.process.on('exit', resolve); });
  }

  async address() {
    for (let i = 0; i < 600 && !this.text.includes('page'); ++i) await pause(100);
    return this.text.match(/live page: (http:\S+)/)?.[1];
  }
}

const drawn = (name) => `document.querySelector('[data-live-chart=${name}]')?.dataset.points ?? 0`;

async function checkPage(browser, url) {
  await browser.open(url);
  expect(await browser.until(`Number(${drawn('acceleration')}) > 20`, 60), 'acceleration is drawn');
  const before = Number(await browser.value(drawn('acceleration')));
  expect(await browser.until(`Number(${drawn('acceleration')}) > ${before}`, 60),
         'acceleration grows while the run goes on');
  const frames = 'Number(document.querySelector("canvas").dataset.frames ?? 0)';
  const hasWebGl = await browser.value('!!document.createElement("canvas").getContext("webgl2")');
  if (hasWebGl) {
    const first = await browser.value(frames);
    expect(await browser.until(`${frames} > ${first}`, 60), 'the body moves');
  }
  console.log(`points ${before}, then ${await browser.value(drawn('acceleration'))}, `
    + `frames ${await browser.value(frames)}`);
}

async function main() {
  const out = `${folder}/watched`;
  const run = new WatchedRun(out, 60);
  const url = await run.address();
  if (!url) {
    const isScriptless = run.text.includes('npm');
    await run.end;
    console.log(run.text);
    process.exit(isScriptless ? kSkipped : 1);
  }
  const browser = new Browser(chromium, folder);
  try {
    await browser.send('Browser.getVersion');
  } catch (error) {
    console.log(`the browser does not start: ${error.message}`);
    run.process.kill('SIGINT');
    process.exit(kSkipped);
  }
  await checkPage(browser, url);
  expect(browser.faults.length === 0, `no script errors, found: ${browser.faults.join('; ')}`);
  browser.close();
  expect(run.process.exitCode === null, 'the browser is closed before the run ends');
  expect(await run.end === 0, `the run ends well without its browser:\n${run.text}`);
  for (const name of ['channels.csv', 'report.html']) expect(existsSync(`${out}/${name}`), name);
}

try {
  await main();
} catch (error) {
  expect(false, error.message);
}
process.exit(failed);
