/* notes.test.js - the teaching notes in headless Chromium. Prints TAP.
 *
 *   node tests/browser/notes.test.js [SITE]
 *
 * Run from anywhere in the repository after `make`. Makes the site in a temporary folder with the program in
 * $ECLAIRAGE, or looks at one that is made: SITE, such as build/notes, or $NOTES_SITE where it is there already.
 * Every page is opened at the width of a telephone and of a desk, in light and in dark; what a page does is tried
 * where there is such a thing.
 */
'use strict';
const fs = require('node:fs');
const path = require('node:path');
const { spawnSync } = require('node:child_process');
const { root, skip, test, same, holds, openPage, brightness, run } = require('./harness.js');

const hasChapters = ['en', 'fr'].some((language) => fs.existsSync(path.join(root, 'notes', language)));
if (!process.argv[2]) {
  if (!hasChapters) skip('there are no chapters yet');
  if (process.env.ECLAIRAGE_SANITIZED) skip('the notes show what the program without sanitizers does');
  for (const tool of ['pandoc', 'jq', 'povray']) if (spawnSync(tool, ['--version']).error) skip(`${tool} is not installed (make setup installs it)`);
}

/* Elements that stick out of the window and are not inside a box that scrolls by itself. */
const outside = (page) => page.evaluate(() => {
  if (document.documentElement.scrollWidth <= innerWidth) return [];
  const wide = [...document.querySelectorAll('body *')].filter((e) => e.getBoundingClientRect().right > innerWidth + 1);
  return [`the page is ${document.documentElement.scrollWidth} wide`, ...wide.slice(0, 3).map((e) => e.outerHTML.slice(0, 80))];
});

/* Texts whose contrast with what is behind them is below 4.5 (WCAG 2.1, 1.4.3). A canvas turns any colour into bytes. */
const faint = (page) => page.evaluate(() => {
  const context = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
  const paint = (colours) => {
    context.fillStyle = '#fff';
    context.fillRect(0, 0, 1, 1);
    for (const colour of colours) { context.fillStyle = colour; context.fillRect(0, 0, 1, 1); }
    return [...context.getImageData(0, 0, 1, 1).data].slice(0, 3);
  };
  const light = (rgb) => rgb.map((v) => v / 255).map((v) => (v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)).reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const bad = new Set();
  for (const element of document.querySelectorAll('body *')) {
    if (element.closest('svg, .stage, .map, .brand, .hidden, .thumb') || ![...element.childNodes].some((n) => n.nodeType === 3 && n.data.trim()) || !element.checkVisibility()) continue;
    const behind = [];
    for (let e = element; e; e = e.parentElement) behind.unshift(getComputedStyle(e).backgroundColor);
    const back = paint(behind), front = paint([...behind, getComputedStyle(element).color]);
    const [high, low] = [light(front), light(back)].sort((a, b) => b - a);
    const contrast = (high + 0.05) / (low + 0.05);
    if (contrast < 4.5) bad.add(`${element.tagName}.${element.className} ${contrast.toFixed(2)}`);
  }
  return [...bad];
});

async function testPage(file, name) {
  const page = await openPage(file, { viewport: { width: 360, height: 740 } });
  await test(`${name}: at a telephone's and at a desk's width nothing sticks out`, async () => {
    same(await outside(page), [], 'at 360');
    await page.setViewportSize({ width: 1200, height: 900 });
    same(await outside(page), [], 'at 1200');
  });
  await test(`${name}: texts can be read in light and in dark`, async () => {
    for (const colorScheme of ['light', 'dark']) {
      await page.emulateMedia({ colorScheme });
      same(await faint(page), [], colorScheme);
    }
  });
  await test(`${name}: every formula has a place, every picture came, every control has a name`, async () => {
    const found = await page.evaluate(() => ({
      formulas: [...document.querySelectorAll('math')].filter((m) => m.checkVisibility() && !(m.getBoundingClientRect().width > 0 && m.getBoundingClientRect().height > 0)).length,
      pictures: [...document.images].filter((i) => !(i.complete && i.naturalWidth > 0)).length,
      silent: [...document.querySelectorAll('main figure img, main figure svg[role="img"]')].filter((e) => (e.getAttribute('alt') || e.getAttribute('aria-label') || '').length < 5).length,
      nameless: [...document.querySelectorAll('button, input, summary, a')].filter((e) => !(e.getAttribute('aria-label') || e.textContent.trim() || e.closest('label') || e.closest('.sourceCode'))).length,
    }));
    same(found, { formulas: 0, pictures: 0, silent: 0, nameless: 0 }, 'without');
  });
  await test(`${name}: on a telephone commands are whole, and the words of a drawing can be read`, async () => {
    await page.setViewportSize({ width: 360, height: 740 });
    await page.evaluate(() => document.querySelectorAll('.answer').forEach((answer) => { answer.open = true; }));
    const found = await page.evaluate(() => ({
      cut: [...document.querySelectorAll('.run pre.sh')].filter((pre) => pre.scrollWidth > pre.clientWidth + 1).map((pre) => pre.textContent),
      torn: [...document.querySelectorAll('.run .word')].filter((word) => word.textContent.length < 32 && word.getBoundingClientRect().height > 30).map((word) => word.textContent),
      small: [...document.querySelectorAll('.drawing img')].filter((drawing) => drawing.getBoundingClientRect().width < 0.8 * drawing.naturalWidth).length,
    }));
    same(found, { cut: [], torn: [], small: 0 }, 'found');
  });
  await test(`${name}: it says nothing on the console and asks for nothing`, async () => same(page.complaints, [], 'complaints'));
  await page.context().close();
}

/* What a page does, on the chapter that has a slider and an exercise. */
async function testBehaviour(file, name) {
  const page = await openPage(file, { colorScheme: 'dark' });
  await test(`${name}: the theme button overrides the system, and the choice is kept`, async () => {
    holds(await brightness(page) < 150, 'the dark page is bright');
    await page.locator('#theme-button').click();
    holds(await brightness(page) > 600, 'the light page is dark');
    same(await page.locator('#theme-button').getAttribute('aria-pressed'), 'false', 'pressed');
    await page.reload();
    holds(await brightness(page) > 600, 'the choice was forgotten');
  });
  await test(`${name}: the first key leads to the text, the focus can be seen`, async () => {
    await page.keyboard.press('Tab');
    const at = await page.evaluate(() => [document.activeElement.className, getComputedStyle(document.activeElement).outlineStyle, document.activeElement.getBoundingClientRect().left >= 0]);
    same(at, ['skip', 'solid', true], 'focus');
  });
  await test(`${name}: the slider moves with the arrow keys and with the mouse`, async () => {
    const wiper = page.locator('.wiper').first();
    const range = wiper.locator('input'), stage = wiper.locator('.stage'), second = wiper.locator('.second');
    await range.focus();
    const cut = () => second.evaluate((e) => getComputedStyle(e).clipPath);
    const before = await cut();
    for (let i = 0; i < 10; i++) await page.keyboard.press('ArrowRight');
    same([await range.inputValue(), before, await cut()], ['60', 'inset(0px 0px 0px 50%)', 'inset(0px 0px 0px 60%)'], 'by key');
    holds(/60 %/.test(await range.getAttribute('aria-valuetext')), 'it is not said');
    await stage.evaluate((e) => e.scrollIntoView({block: 'center', behavior: 'instant'}));
    const box = await stage.boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 4, box.y + box.height / 2);
    await page.mouse.up();
    same(await range.inputValue(), '25', 'by mouse');
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    same(await range.inputValue(), '25', 'after the mouse was let go');
  });
  await test(`${name}: an answer opens with the keyboard`, async () => {
    const answer = page.locator('.answer').first();
    holds(!await answer.locator('.answer-text').isVisible(), 'it is open at once');
    await answer.locator('summary').focus();
    await page.keyboard.press('Enter');
    await answer.locator('.answer-text').waitFor({ state: 'visible' });
    await page.keyboard.press('Enter');
  });
  await test(`${name}: the list of chapters opens, and closes with Escape`, async () => {
    await page.locator('.menu summary').click();
    await page.locator('.menu nav').waitFor({ state: 'visible' });
    await page.keyboard.press('Escape');
    await page.locator('.menu nav').waitFor({ state: 'hidden' });
  });
  await test(`${name}: in print the answers stand there and both pictures, the controls do not`, async () => {
    await page.emulateMedia({ media: 'print' });
    /* The page hears of another medium with its next frame, which a busy machine may draw late. */
    const answers = page.locator('.answer-text');
    for (let i = 0; i < await answers.count(); i++) await answers.nth(i).waitFor({ state: 'visible' });
    same(await page.locator('button:visible, input:visible, .top:visible, .turn:visible').count(), 0, 'controls');
    const [first, second] = await page.locator('.stage').first().evaluate((stage) => [...stage.querySelectorAll('img')].map((i) => i.getBoundingClientRect().left));
    holds(second > first + 50, 'the pictures lie on each other');
    same(await page.locator('.second').first().evaluate((e) => getComputedStyle(e).clipPath), 'none', 'cut');
    await page.emulateMedia({ media: 'screen' });
    for (let i = 0; i < await answers.count(); i++) await answers.nth(i).waitFor({ state: 'hidden' });
  });
  await page.context().close();

  const plain = await openPage(file, { javaScriptEnabled: false });
  await test(`${name}: without JavaScript both pictures stand side by side, and no control does nothing`, async () => {
    const boxes = await Promise.all(['first', 'second'].map((side) => plain.locator(`.side.${side} img`).first().boundingBox()));
    holds(boxes[1].x > boxes[0].x + boxes[0].width - 1 && boxes[0].width > 80, JSON.stringify(boxes));
    same(await plain.locator('button:visible, input:visible').count(), 0, 'controls');
    await plain.locator('.answer summary').first().click();
    await plain.locator('.answer-text').first().waitFor({ state: 'visible' });
  });
  await plain.context().close();
}

run(async (folder) => {
  let site = process.argv[2] && path.resolve(process.argv[2]);
  if (!site && process.env.NOTES_SITE && fs.existsSync(process.env.NOTES_SITE)) site = process.env.NOTES_SITE;
  if (!site) {
    site = path.join(folder, 'site');
    const program = path.resolve(root, process.env.ECLAIRAGE || 'build/eclairage');
    const done = spawnSync(path.join(root, 'notes', 'make-notes.sh'), [site], { encoding: 'utf8', env: { ...process.env, ECLAIRAGE: program } });
    /* 1: only a number is another, which tests/suites/notes.sh tells. */
    if (done.status !== 0 && done.status !== 1) throw new Error(`notes/make-notes.sh failed: ${done.stderr}`);
  }
  await testPage(path.join(site, 'index.html'), 'index.html');
  for (const language of ['en', 'fr']) {
    if (!fs.existsSync(path.join(site, language))) continue;
    const names = fs.readdirSync(path.join(site, language)).filter((name) => name.endsWith('.html')).sort();
    for (const name of names) await testPage(path.join(site, language, name), `${language}/${name}`);
    const rich = names.find((name) => {
      const text = fs.readFileSync(path.join(site, language, name), 'utf8');
      return text.includes('class="wiper"') && text.includes('class="answer"');
    });
    await test(`${language}: there is a chapter with a slider and an exercise`, async () => holds(rich, 'none'));
    if (rich) await testBehaviour(path.join(site, language, rich), `${language}/${rich}`);
  }
});
