// node browser_test.mjs CHROMIUM WRITE_SAMPLE FOLDER: opens the sample report and checks that no
// script error occurs, the charts are drawn, the playback moves and no width overflows.
// Exit 77 means skipped: the page was built without npm, or the browser does not start here.
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync } from 'node:fs';
import { Browser, pause } from './browser.mjs';

const [chromium, writeSample, folder] = process.argv.slice(2);
const kSkipped = 77;
const kCharts = 7;  // over time and not folded, of the sample
let failed = 0;

function expect(isTrue, text) {
  if (isTrue) return;
  console.log(`FAILED: ${text}`);
  failed = 1;
}

async function checkPlayback(browser) {
  const state = () => browser.value('({...document.querySelector("[data-playback]").dataset})');
  if ((await state()).fault) {
    console.log('no WebGL 2 in this browser: playback not checked');
    return;
  }
  const before = await state();
  await browser.value('document.querySelector("[data-action=speed]").value = "0.25"');
  await browser.value('document.querySelector("[data-action=play]").click()');
  const moves = await browser.until(
    `document.querySelector("[data-playback]").dataset.head !== ${JSON.stringify(before.head)}`);
  const after = await state();
  console.log(`playback: head (${before.head}) at ${before.time} s, (${after.head}) at ${after.time} s`);
  expect(moves && Number(after.time) > Number(before.time), 'the playback moves');
}

async function check(browser) {
  const url = `file://${folder}/report.html`;
  await browser.open(url);
  await browser.until(`Number(document.documentElement.dataset.charts) >= ${kCharts}`);
  const charts = await browser.value('document.querySelectorAll(".live canvas").length');
  console.log(`charts drawn: ${charts}`);
  expect(charts === kCharts, `${kCharts} charts drawn`);
  await browser.value('document.querySelector("details.group").open = true');
  expect(await browser.until(`document.querySelectorAll(".live canvas").length > ${kCharts}`, 5),
         'folded charts are drawn when opened');
  await checkPlayback(browser);
  for (const width of [1280, 400]) {
    await browser.open(url, width);
    await pause(300);
    const wide = await browser.value('document.documentElement.scrollWidth');
    expect(wide <= width, `no sideways scrolling at ${width} px, found ${wide} px`);
  }
  expect(browser.faults.length === 0, `no script errors, found: ${browser.faults.join('; ')}`);
}

mkdirSync(folder, { recursive: true });
execFileSync(writeSample, [`${folder}/report.html`]);
if (!readFileSync(`${folder}/report.html`, 'utf8').includes('id="report-data"')) {
  console.log('built without npm: the page has no script');
  process.exit(kSkipped);
}
const browser = new Browser(chromium, folder);
try {
  await browser.send('Browser.getVersion');
} catch (error) {
  console.log(`the browser does not start: ${error.message}`);
  process.exit(kSkipped);
}
try {
  await check(browser);
} catch (error) {
  expect(false, error.message);
}
browser.close();
process.exit(failed);
