/* report.test.js - the report's page in headless Chromium. Prints TAP.
 *
 *   node tests/browser/report.test.js [PAGE...]
 *
 * Run from anywhere in the repository after `make`. Builds its own pages with report_fixture.c: hostile
 * names, all outcomes, pictures of all sizes. Further pages, such as build/report/index.html, get the checks
 * that every page must pass; so does one that the program in $ECLAIRAGE makes of two course scenes, if there
 * is POV-Ray. Samples that a page shows are held against the PNG files beside it, read here with node's
 * zlib. BUILD is the build folder, CC the compiler.
 */
'use strict';
const fs = require('node:fs');
const path = require('node:path');
const zlib = require('node:zlib');
const { spawnSync } = require('node:child_process');
const { root, test, same, holds, openPage, brightness, complaints, run } = require('./harness.js');

/* --- The samples of a 16-bit RGB PNG, told apart from the page's own decoder by zlib and plain loops --- */

function readSamples(file) {
  const bytes = fs.readFileSync(file);
  const data = [];
  let header;
  for (let at = 8; at < bytes.length; at += 12 + bytes.readUInt32BE(at)) {
    const kind = bytes.toString('latin1', at + 4, at + 8), body = bytes.subarray(at + 8, at + 8 + bytes.readUInt32BE(at));
    if (kind === 'IHDR') header = body;
    if (kind === 'IDAT') data.push(body);
  }
  const width = header.readUInt32BE(0), height = header.readUInt32BE(4);
  same([...header.subarray(8, 13)], [16, 2, 0, 0, 0], `${file}: 16-bit RGB`);
  const packed = zlib.inflateSync(Buffer.concat(data));
  const stride = width * 6, rows = [Buffer.alloc(stride)];
  for (let y = 0; y < height; y++) {
    const filter = packed[y * (stride + 1)], row = Buffer.from(packed.subarray(y * (stride + 1) + 1, (y + 1) * (stride + 1))), above = rows[y];
    for (let i = 0; i < stride; i++) {
      const a = i < 6 ? 0 : row[i - 6], b = above[i], c = i < 6 ? 0 : above[i - 6], p = a + b - c;
      const nearest = [a, b, c].reduce((best, v) => (Math.abs(p - v) < Math.abs(p - best) ? v : best));
      row[i] = (row[i] + [0, a, b, (a + b) >> 1, nearest][filter]) & 255;
    }
    rows.push(row);
  }
  return { width, height, at: (x, y) => [0, 2, 4].map((c) => rows[y + 1].readUInt16BE(6 * x + c)) };
}

/* A PNG of these bytes a row, each row with the next of the five filters. */
function makePng(width, height, depth, colourType, rows, { interlaced = 0, gamma = 100000 } = {}) {
  const chunk = (kind, body) => {
    const whole = Buffer.alloc(body.length + 12); /* the sum of 4 bytes at the end is not read by the page */
    whole.writeUInt32BE(body.length);
    whole.write(kind, 4, 'latin1');
    body.copy(whole, 8);
    return whole;
  };
  const header = Buffer.alloc(13), gammaBody = Buffer.alloc(4);
  header.writeUInt32BE(width);
  header.writeUInt32BE(height, 4);
  header.set([depth, colourType, 0, 0, interlaced], 8);
  gammaBody.writeUInt32BE(gamma);
  const left = ({ 0: 1, 2: 3, 4: 2, 6: 4 }[colourType] ?? 1) * Math.max(1, depth / 8);
  const filtered = rows.map((row, y) => {
    const filter = y % 5;
    return Buffer.from([filter, ...row.map((value, i) => {
      const a = i < left ? 0 : row[i - left], b = y ? rows[y - 1][i] : 0, c = i < left || !y ? 0 : rows[y - 1][i - left], p = a + b - c;
      const nearest = [a, b, c].reduce((best, v) => (Math.abs(p - v) < Math.abs(p - best) ? v : best));
      return (value - [0, a, b, (a + b) >> 1, nearest][filter]) & 255;
    })]);
  });
  const packed = zlib.deflateSync(Buffer.concat(filtered));
  const middle = packed.length >> 1;
  return [...Buffer.concat([Buffer.alloc(8), chunk('IHDR', header), chunk('gAMA', gammaBody), chunk('IDAT', packed.subarray(0, middle)), chunk('IDAT', packed.subarray(middle)), chunk('IEND', Buffer.alloc(0))])];
}

/* What a screen shows of a linear 16-bit sample (IEC 61966-2-1). */
function screenValue(value) {
  const v = value / 65535;
  return Math.floor((v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055) * 255 + 0.5);
}

/* --- Fixture --- */

function makeFixture(folder) {
  const build = path.resolve(root, process.env.BUILD || 'build');
  const flags = spawnSync('pkg-config', ['--cflags', '--libs', 'libpng', 'yaml-0.1', 'zlib'], { encoding: 'utf8' }).stdout.trim().split(/\s+/);
  const sanitize = process.env.SANITIZE ? [`-fsanitize=${process.env.SANITIZE}`] : [];
  const program = path.join(folder, 'report_fixture');
  const compiler = (process.env.CC || 'cc').split(/\s+/);
  const steps = [
    [...compiler, '-std=c17', '-O1', '-D_POSIX_C_SOURCE=200809L', ...sanitize, '-Isrc', '-I.', '-o', program, 'tests/browser/report_fixture.c', path.join(build, 'libeclairage.a'), ...flags, '-lm', '-pthread'],
    [program, folder],
  ];
  for (const [command, ...rest] of steps) {
    const done = spawnSync(command, rest, { cwd: root, encoding: 'utf8' });
    if (done.status !== 0) throw new Error(`${command} failed: ${done.stderr || done.error}`);
  }
}

/* The page of a real comparison, or none where it cannot be made. */
function makeRealPages(folder) {
  const program = process.env.ECLAIRAGE;
  if (!program || spawnSync('povray', ['--version']).error) return [];
  const course = path.join(root, 'scenes', 'course');
  const scenes = fs.readdirSync(course).filter((name) => name.endsWith('.yaml')).sort().slice(0, 2);
  const done = spawnSync(program, ['compare', ...scenes.map((name) => path.join(course, name)), '--out', path.join(folder, 'real')], { encoding: 'utf8' });
  if (done.status > 1) throw new Error(`${program} compare failed: ${done.stderr}`);
  return [path.join(folder, 'real', 'index.html')];
}

/* --- Pages --- */

/* Bring a scene to the screen and wait for its viewer. */
async function openScene(page, id) {
  const scene = page.locator(`#${id}`);
  await scene.evaluate((element) => element.scrollIntoView({ behavior: 'instant' }));
  await scene.locator('.viewer.ready').waitFor({ timeout: 15000 });
  return scene;
}

/* The values the probe shows: two times r g b. */
const shownSamples = (scene) => scene.locator('.samples').evaluate((table) => ['2', '3'].map((column) => [...table.querySelectorAll(`tbody tr > :nth-child(${column})`)].map((cell) => +cell.dataset.value)));
const shownPlace = (scene) => scene.locator('.probe-place').textContent();
const pathsOf = (scene, folder) => scene.locator('.files a').evaluateAll((links) => links.slice(0, 2).map((link) => decodeURIComponent(new URL(link.href).pathname.split('/').pop()))).then((names) => names.map((name) => path.join(folder, name)));

/* Move the mouse over the middle of a pixel, as the fitted view shows it. */
async function pointAt(page, scene, which, x, y, width, height) {
  const frame = await scene.locator(`.pane[data-pane="${which}"]`).boundingBox();
  const scale = Math.min(frame.width / width, frame.height / height);
  await page.mouse.move(frame.x + (frame.width - width * scale) / 2 + (x + 0.5) * scale, frame.y + (frame.height - height * scale) / 2 + (y + 0.5) * scale);
}

/* What every report must keep, whatever is in it. */
async function testEveryPage(file, name) {
  const page = await openPage(file);
  const results = JSON.parse(fs.readFileSync(path.join(path.dirname(file), 'results.json'), 'utf8'));
  await test(`${name}: the verdict comes first, in words, and is that of results.json`, async () => {
    const heading = await page.locator('main :is(h1, h2)').first().textContent();
    const differing = results.scenes.filter((s) => !s.pass && !s.error).length, failed = results.scenes.filter((s) => s.error).length;
    if (results.pass) holds(/agrees? with POV-Ray\.$/.test(heading), heading);
    else holds((differing === 0 || /differs? from POV-Ray/.test(heading)) && (failed === 0 || /be compared/.test(heading)), heading);
    same(await page.locator('.verdict').getAttribute('class'), `verdict ${results.pass ? 'agree' : differing ? 'differ' : 'failed'}`, 'class');
    same(await page.title(), `${heading} – Éclairage`, 'title');
  });
  await test(`${name}: every scene is there, with its name and outcome`, async () => {
    const found = await page.locator('.scene').evaluateAll((scenes) => scenes.map((s) => s.dataset.outcome));
    same(found, results.scenes.map((s) => (s.error ? 'failed' : s.pass ? 'agree' : 'differ')), 'outcomes');
    holds(!(await page.content()).includes('{{#') && !/\{\{(?!run-command\}\}\.yaml)/.test(await page.locator('body').innerText()), 'a field of the template is left');
  });
  await test(`${name}: every picture and canvas has an alternative text`, async () => {
    const silent = await page.evaluate(() => [...document.querySelectorAll('.scene img, .pane canvas')].filter((e) => (e.alt || e.getAttribute('aria-label') || '').length < 12).length);
    same(silent, 0, 'without text');
  });
  await test(`${name}: every control has a name`, async () => {
    const nameless = await page.evaluate(() => [...document.querySelectorAll('button, input')].filter((e) => !(e.getAttribute('aria-label') || e.textContent.trim() || e.closest('label'))).length);
    same(nameless, 0, 'without name');
  });
  const measured = results.scenes.findIndex((s) => !s.error && s.width > 1);
  if (measured >= 0) {
    await test(`${name}: the probe shows the samples of the PNG files`, async () => {
      const scene = await openScene(page, `scene-${measured + 1}`);
      const [ours, povray] = (await pathsOf(scene, path.dirname(file))).map(readSamples);
      for (const [u, v] of [[0.5, 0.5], [0.31, 0.77], [0.9, 0.12]]) {
        const x = Math.floor(u * ours.width), y = Math.floor(v * ours.height);
        await pointAt(page, scene, 'ours', x, y, ours.width, ours.height);
        const place = JSON.parse((await shownPlace(scene)).replace('(', '[').replace(')', ']'));
        same(await shownSamples(scene), [ours.at(...place), povray.at(...place)], `at ${place}`);
      }
    });
  }
  await page.setViewportSize({ width: 360, height: 740 });
  await test(`${name}: at a telephone's width nothing sticks out`, async () => {
    await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth);
  });
  await page.context().close();
}

async function testMixed(folder) {
  const file = path.join(folder, 'mixed', 'index.html');
  const page = await openPage(file);
  await test('the heading counts what differs and what failed', async () => {
    same(await page.locator('h1').textContent(), '3 of 12 scenes differ from POV-Ray, 4 could not be compared.', 'heading');
  });
  await test('hostile names stay text', async () => {
    same(await page.locator('#scene-4 h2').textContent(), 'scenes/<script>window.hacked=1</script>"\'><img src=x onerror="window.hacked=1">&amp;{{run-command}}.yaml', 'name');
    same(await page.evaluate(() => [window.hacked === undefined, document.querySelectorAll('img[src="x"]').length, document.scripts.length]), [true, 0, 2], 'page');
    holds((await page.locator('#scene-11 h2').textContent()).includes('\uFFFD\uFFFD[31m'), 'bytes that are not UTF-8 or are control characters were kept');
    holds((await page.locator('#scene-9 pre').textContent()).includes('</pre><script>window.hacked=1</script>'), 'the message was cut');
  });
  await test('a scene that failed shows its message and exit code', async () => {
    holds((await page.locator('#scene-10').innerText()).includes('there is no such file'), 'message');
    same(await page.locator('.error-meaning .soft').allTextContents(), ['Exit code 3', 'Exit code 4', 'Exit code 5', 'Exit code 7'], 'codes');
  });
  await test('reasons are given in words where a scene differs, and only there', async () => {
    same(await page.locator('.reasons').evaluateAll((all) => all.map((e) => e.closest('.scene').id)), ['scene-2', 'scene-3', 'scene-6'], 'scenes');
    holds((await page.locator('#scene-2 .reasons li').first().textContent()).length > 20, 'a sentence');
  });
  await test('the table of terms names the one that disagrees, in words and with both pictures', async () => {
    same(await page.locator('table.terms').count(), 1, 'tables');
    same(await page.locator('table.terms tbody tr').evaluateAll((rows) => rows.map((row) => row.className)), ['agree', 'differ'], 'outcomes');
    const text = await page.locator('table.terms tr.differ').innerText();
    holds(/specular/i.test(text) && /disagrees/.test(text) && /\/65535/.test(text), text);
    same((await page.locator('.reasons li', { hasText: 'term disagrees' }).allInnerTexts()).map((line) => line.split(':')[0]), ['The specular term disagrees'], 'reasons');
    const widths = await page.locator('img.term-thumb').evaluateAll((images) => Promise.all(images.map((image) => image.decode().then(() => image.naturalWidth))));
    same(widths, [240, 240, 240, 240], 'widths of the small pictures');
  });
  await test('a metric beyond its limit says so in words', async () => {
    same(await page.locator('#scene-3 .metrics tbody tr').evaluateAll((rows) => rows.filter((r) => r.textContent.includes('✗ beyond')).map((r) => r.cells[0].firstChild.data)), ['Differing pixels', 'SSIM'], 'beyond');
    same(await page.locator('#scene-1 .held').evaluateAll((cells) => cells.map((c) => c.textContent).filter(Boolean)), ['✓ within', '✓ within', '✓ within'], 'within');
  });

  await test('the page decodes every filter, depth and colour type it says it reads', async () => {
    let seed = 1;
    const random = () => { seed = (seed * 48271) % 2147483647; return seed & 255; };
    for (const depth of [8, 16]) {
      for (const [colourType, channels] of [[0, 1], [2, 3], [4, 2], [6, 4]]) {
        const [width, height, size] = [7, 11, depth / 8];
        const rows = Array.from({ length: height }, () => Array.from({ length: width * channels * size }, random));
        const wanted = rows.flatMap((row) => Array.from({ length: width * 3 }, (_, i) => {
          const at = (Math.floor(i / 3) * channels + (channels < 3 ? 0 : i % 3)) * size;
          return size === 2 ? row[at] * 256 + row[at + 1] : row[at];
        }));
        const found = await page.evaluate(async (bytes) => { const p = await decodePng(new Uint8Array(bytes)); return { ...p, samples: [...p.samples] }; }, makePng(width, height, depth, colourType, rows));
        same(found, { width, height, max: depth === 16 ? 65535 : 255, linear: true, samples: wanted }, `depth ${depth}, colour type ${colourType}`);
      }
    }
  });
  await test('a PNG that the page cannot read is an error, not a wrong picture', async () => {
    const good = [[1, 2, 3], [4, 5, 6]];
    const cases = [makePng(1, 2, 8, 2, good, { interlaced: 1 }), makePng(1, 2, 8, 3, good), makePng(1, 3, 8, 2, good), makePng(1, 2, 4, 0, good), []];
    const outcomes = await page.evaluate((all) => Promise.all(all.map((bytes) => decodePng(new Uint8Array(bytes)).then(() => 'read', () => 'error'))), cases);
    same(outcomes, cases.map(() => 'error'), 'outcomes');
    same(await page.evaluate(async (bytes) => (await decodePng(new Uint8Array(bytes))).linear, makePng(1, 2, 8, 2, good, { gamma: 45455 })), false, 'a gamma of 1/2.2 is not linear');
  });

  const scene = await openScene(page, 'scene-2');
  const [ours, povray] = (await pathsOf(scene, path.dirname(file))).map(readSamples);
  const worst = JSON.parse(fs.readFileSync(path.join(folder, 'mixed', 'results.json'), 'utf8')).scenes[1].worst_pixel;
  const stage = scene.locator('.stage');
  const root_ = scene.locator('.viewer');

  await test('the arrow keys move the probe, with Shift by ten, and stop at the border', async () => {
    await pointAt(page, scene, 'povray', 320, 240, 640, 480);
    const before = JSON.parse((await shownPlace(scene)).replace('(', '[').replace(')', ']'));
    await stage.focus();
    for (const key of ['ArrowRight', 'ArrowDown', 'ArrowDown', 'Shift+ArrowLeft']) await page.keyboard.press(key);
    const [x, y] = [before[0] - 9, before[1] + 2];
    same(await shownPlace(scene), `(${x}, ${y})`, 'place');
    same(await shownSamples(scene), [ours.at(x, y), povray.at(x, y)], 'samples');
    for (let i = 0; i < 70; i++) await page.keyboard.press('Shift+ArrowLeft');
    same(await shownPlace(scene), `(0, ${y})`, 'at the border');
  });
  await test('the probe tells fractions and 8-bit sRGB too', async () => {
    await scene.locator('.worst-button').click();
    const [value, fraction, screen] = await scene.locator('.samples tbody tr').first().locator('td').first().evaluate((cell) => [+cell.dataset.value, ...[...cell.querySelectorAll('small')].map((s) => s.textContent)]);
    same([fraction, screen], [(value / 65535).toFixed(5), String(screenValue(value))], 'texts');
  });
  await test('the button goes to the worst pixel, which is marked', async () => {
    same(await shownPlace(scene), `(${worst.x}, ${worst.y})`, 'place');
    same((await shownSamples(scene)).map((rgb) => rgb[worst.channel]), [worst.a, worst.b].map((v) => Math.round(v * 65535)), 'samples');
    same(await scene.locator('.pane[data-pane="ours"] .ring').evaluate((ring) => getComputedStyle(ring).display !== 'none'), true, 'ring');
  });
  await test('what the screen shows is the sRGB encoding of the samples', async () => {
    const pixel = await scene.locator('.pane[data-pane="ours"] canvas').evaluate((canvas, at) => [...canvas.getContext('2d').getImageData(at.x, at.y, 1, 1).data], worst);
    same(pixel, [...ours.at(worst.x, worst.y).map(screenValue), 255], 'pixel');
    const table = await page.evaluate(() => [...makeScreenTable({ max: 65535, linear: true })]);
    same(table.map((value, sample) => value - screenValue(sample)).filter(Boolean), [], 'the table of all samples');
  });
  await test('the slider moves by keyboard and by mouse', async () => {
    await page.keyboard.press('2');
    same(await root_.getAttribute('data-mode'), 'slider', 'mode');
    const split = scene.locator('.split');
    await split.focus();
    for (let i = 0; i < 3; i++) await page.keyboard.press('ArrowRight');
    same(await stage.evaluate((e) => e.style.getPropertyValue('--split')), '53%', 'split');
    const clip = await scene.locator('.pane[data-pane="povray"]').evaluate((e) => getComputedStyle(e).clipPath);
    holds(clip.includes('53%'), `clip-path ${clip}`);
    const frame = await scene.locator('.pane[data-pane="ours"]').boundingBox();
    await page.mouse.move(frame.x + frame.width / 2, frame.y + 50);
    await page.mouse.down();
    await page.mouse.move(frame.x + frame.width / 4, frame.y + 60, { steps: 4 });
    await page.mouse.up();
    same(Math.round(parseFloat(await stage.evaluate((e) => e.style.getPropertyValue('--split')))), 25, 'dragged');
  });
  await test('blink flips between the two pictures, by button, by key and by itself', async () => {
    await page.keyboard.press('3');
    const visible = () => scene.locator('.pane').evaluateAll((panes) => panes.filter((p) => p.offsetWidth > 0 && getComputedStyle(p).visibility === 'visible').map((p) => p.dataset.pane));
    holds(await scene.locator('.auto').isChecked(), 'it does not start by itself');
    await page.emulateMedia({ reducedMotion: 'reduce' });
    await page.keyboard.press('1');
    await page.keyboard.press('3');
    holds(!await scene.locator('.auto').isChecked(), 'it moves although the user asked for less motion');
    const first = await visible();
    same(first.length, 1, 'one at a time');
    await scene.locator('.flip').click();
    const second = await visible();
    holds(second[0] !== first[0] && second.length === 1, 'the button does nothing');
    await stage.focus();
    await page.keyboard.press(' ');
    same(await visible(), first, 'the space key');
    await scene.locator('.auto').setChecked(true);
    /* A look at every frame, so that no flip is missed, however late it comes. */
    await scene.locator(`.pane[data-pane="${second[0]}"]`).waitFor({ state: 'visible' });
    await scene.locator('.auto').setChecked(false);
  });
  await test('the gain changes the difference as it should', async () => {
    await page.keyboard.press('4');
    const gain = scene.locator('.gain');
    const pixel = () => scene.locator('.pane[data-pane="gain"] canvas').evaluate((canvas, at) => [...canvas.getContext('2d').getImageData(at.x, at.y, 1, 1).data].slice(0, 3), worst);
    const expected = (factor) => ours.at(worst.x, worst.y).map((v, c) => Math.min(255, Math.floor((Math.abs(v - povray.at(worst.x, worst.y)[c]) / 65535) * factor * 255 + 0.5)));
    for (const [power, factor] of [[0, 1], [3, 8], [16, 65535]]) {
      await gain.fill(String(power));
      same(await scene.locator('.gain-value').textContent(), `×\u2009${factor}`, 'label');
      same(await pixel(), expected(factor), `gain ${factor}`);
    }
    await gain.focus();
    await page.keyboard.press('Home');
    await page.keyboard.press('.');
    same(await scene.locator('.gain-value').textContent(), '×\u20092', 'by key');
  });
  await test('zooming keeps the probe on its pixel', async () => {
    await page.keyboard.press('1');
    for (let i = 0; i < 4; i++) await page.keyboard.press('+');
    const scale = await scene.locator('.pane[data-pane="ours"] canvas').evaluate((c) => new DOMMatrix(getComputedStyle(c).transform).a);
    holds(scale > 10, `the scale is ${scale}`);
    const box = await scene.locator('.pane[data-pane="ours"]').boundingBox();
    await scene.locator('.stage').focus();
    const cross = await scene.locator('.pane[data-pane="ours"] .cross').boundingBox();
    holds(cross.x > box.x && cross.x + cross.width < box.x + box.width && cross.y > box.y, 'the probe is outside');
    same(await shownPlace(scene), `(${worst.x}, ${worst.y})`, 'place');
    await page.mouse.move(cross.x + cross.width / 2, cross.y + cross.height / 2);
    await page.mouse.click(cross.x + cross.width / 2, cross.y + cross.height / 2);
    same(await shownPlace(scene), `(${worst.x}, ${worst.y})`, 'where the mouse points');
    await page.keyboard.press('0');
    same(await scene.locator('.zoom-value').textContent(), 'fit', 'fit again');
  });
  await test('the histogram counts every pixel once', async () => {
    const label = await scene.locator('.chart svg').getAttribute('aria-label');
    const total = [...label.matchAll(/: (\d+)/g)].reduce((sum, [, n]) => sum + +n, 0);
    same(total, 640 * 480, label);
    const equal = JSON.parse(fs.readFileSync(path.join(folder, 'mixed', 'results.json'), 'utf8')).scenes[1].identical_pixels;
    holds(label.includes(` 0: ${equal}`), `${label}: not ${equal} identical pixels`);
  });
  await test('keys go from scene to scene and to what does not agree', async () => {
    await page.evaluate(() => scrollTo({ top: 0, behavior: 'instant' }));
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press('x');
    const at = () => page.evaluate(() => document.activeElement.closest('.scene')?.id);
    same(await at(), 'scene-2', 'x');
    await page.keyboard.press('x');
    same(await at(), 'scene-3', 'x again');
    await page.keyboard.press('n');
    same(await at(), 'scene-4', 'n');
    await page.keyboard.press('p');
    same(await at(), 'scene-3', 'p');
  });
  await test('the keys are listed, and can be turned off', async () => {
    await page.keyboard.press('?');
    holds(await page.locator('#help').isVisible(), 'no list');
    await page.locator('#keys-on').setChecked(false);
    await page.keyboard.press('Escape');
    const before = await page.locator('#scene-3 .viewer').getAttribute('data-mode');
    await page.keyboard.press('4');
    same(await page.locator('#scene-3 .viewer').getAttribute('data-mode'), before, 'mode');
    await page.evaluate(() => { document.getElementById('keys-on').checked = true; });
  });
  await test('a filter leaves the scenes of one outcome', async () => {
    await page.locator('[data-filter="failed"]').click();
    same(await page.locator('.scene:visible').count(), 4, 'scenes');
    await page.locator('[data-filter="all"]').click();
    same(await page.locator('.scene:visible').count(), 12, 'all scenes');
  });
  await test('a command can be copied', async () => {
    await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
    await page.locator('[data-copy="command-1"]').click();
    same(await page.evaluate(() => navigator.clipboard.readText()), "eclairage compare 'scenes/course/03-lambert.yaml' --out report", 'clipboard');
  });
  await test('small, wide and tall pictures are shown whole', async () => {
    for (const [id, width, height] of [['scene-5', 1, 1], ['scene-6', 8, 8], ['scene-7', 4000, 600], ['scene-8', 150, 900]]) {
      const odd = await openScene(page, id);
      const [canvas, pane] = [await odd.locator('.pane[data-pane="ours"] canvas').boundingBox(), await odd.locator('.pane[data-pane="ours"]').boundingBox()];
      holds(canvas.width <= pane.width + 1 && canvas.height <= pane.height + 1 && Math.max(canvas.width / pane.width, canvas.height / pane.height) > 0.98, `${id}: ${JSON.stringify([canvas, pane])}`);
      holds(canvas.width >= 80 || canvas.height >= 80, `${id} is too small to see`);
      same(+(canvas.width / canvas.height).toFixed(1), +(width / height).toFixed(1), `${id}: aspect`);
    }
    holds(await page.locator('#scene-5 .worst-button').isDisabled(), 'identical pictures have no worst pixel');
  });
  await page.context().close();

  await test('light and dark: the system chooses, the button overrides, the choice is kept', async () => {
    const dark = await openPage(file, { colorScheme: 'dark' });
    holds(await brightness(dark) < 150, 'the dark page is bright');
    same(await dark.locator('#theme-button').getAttribute('aria-pressed'), 'true', 'pressed');
    await dark.keyboard.press('t');
    holds(await brightness(dark) > 600, 'the light page is dark');
    await dark.reload();
    holds(await brightness(dark) > 600, 'the choice was forgotten');
    await dark.context().close();
  });
  await test('without JavaScript: verdict, pictures, metrics, reasons, commands', async () => {
    const plain = await openPage(file, { javaScriptEnabled: false });
    const text = await plain.locator('body').innerText();
    for (const wanted of ['3 of 12 scenes differ', 'Why it differs', 'Largest difference', "eclairage compare 'scenes/course/03-lambert.yaml'"]) holds(text.includes(wanted), `no "${wanted}"`);
    for (const kind of ['ours', 'povray', 'difference']) holds((await plain.locator(`#scene-1 img.${kind}`).boundingBox()).width > 200, `no picture of ${kind}`);
    same(await plain.locator('button:visible, .viewer').count(), 0, 'controls that do nothing');
    await plain.context().close();
  });
  await test('in print: the pictures stand there, the controls do not', async () => {
    const print = await openPage(file);
    await openScene(print, 'scene-1');
    await print.emulateMedia({ media: 'print' });
    holds(await print.locator('#scene-1 img.ours').isVisible() && await print.locator('#scene-1 .pictures img.difference').isVisible(), 'no pictures');
    same(await print.locator('button:visible, .viewer:visible').count(), 0, 'controls');
    await print.context().close();
  });
}

run(async (folder) => {
  makeFixture(folder);
  await testMixed(folder);
  for (const name of ['mixed', 'agree', 'many']) await testEveryPage(path.join(folder, name, 'index.html'), name);
  for (const file of makeRealPages(folder)) await testEveryPage(file, 'a comparison');
  for (const file of process.argv.slice(2)) await testEveryPage(path.resolve(file), file);
  await test('no page asked for anything outside itself, and none complained', async () => same(complaints, [], 'complaints'));
});
