/* harness.js - what the tests in a browser have in common: TAP, and pages in headless Chromium.
 *
 * Where there is no Chromium or no driver for it, loading this file prints that the tests are skipped and ends.
 */
'use strict';
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const { pathToFileURL } = require('node:url');

const root = path.join(__dirname, '..', '..');

/* Say why nothing can be tested, and end. */
const skip = (reason) => { console.log(`1..0 # SKIP ${reason}`); process.exit(0); };

const executablePath = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find((file) => fs.existsSync(file));
if (!executablePath) skip('chromium is not installed (make setup installs it)');
let chromium;
try { ({ chromium } = require('playwright-core')); } catch { skip('playwright-core is not installed (make setup installs it)'); }

/* --- TAP --- */

let number = 0, failures = 0;

/* Run one test; it fails when body throws. */
async function test(name, body) {
  number++;
  try {
    await body();
    console.log(`ok ${number} - ${name}`);
  } catch (error) {
    failures++;
    console.log(`not ok ${number} - ${name}`);
    for (const line of String(error.stack || error).split('\n').slice(0, 8)) console.log(`# ${line}`);
  }
}
function same(found, wanted, what) {
  if (JSON.stringify(found) !== JSON.stringify(wanted)) throw new Error(`${what}: found ${JSON.stringify(found)}, not ${JSON.stringify(wanted)}`);
}
function holds(condition, what) { if (!condition) throw new Error(what); }

/* --- Pages --- */

let browser;
const complaints = []; /* of all pages: what they said on the console and asked for outside themselves */

/* Open a file in a window of its own; options are those of a browser's context. page.complaints are its own. */
async function openPage(file, options = {}, hash = '') {
  browser ??= await chromium.launch({
    executablePath,
    args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
  });
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  const page = await context.newPage();
  page.complaints = [];
  const complain = (text) => { page.complaints.push(text); complaints.push(text); };
  page.on('console', (message) => { if (['error', 'warning'].includes(message.type()) && !message.text().includes('getImageData')) /* which only tests call */ complain(`${message.type()}: ${message.text()}`); });
  page.on('pageerror', (error) => complain(`exception: ${error.message}`));
  page.on('request', (request) => { if (!request.url().startsWith('data:') && request.url().split('#')[0] !== pathToFileURL(file).href) complain(`request: ${request.url()}`); });
  await page.goto(pathToFileURL(file).href + hash);
  return page;
}

/* Whether the page is dark or bright: the sum of the background's three bytes. */
const brightness = (page) => page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).slice(0, 3).reduce((a, b) => a + +b, 0));

/* --- The whole --- */

/* Let body(folder) test, with a temporary folder; then clean up, print the plan and set the exit code. */
async function run(body) {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'eclairage-browser-'));
  try {
    await body(folder);
    console.log(`1..${number}`);
  } catch (error) {
    failures++;
    for (const line of String(error.stack || error).split('\n')) console.log(`# ${line}`);
    console.log(`Bail out! ${error.message}`);
  } finally {
    if (browser) await browser.close();
    fs.rmSync(folder, { recursive: true, force: true });
  }
  process.exitCode = failures > 0 ? 1 : 0;
}

module.exports = { root, skip, test, same, holds, openPage, brightness, complaints, run };
