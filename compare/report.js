/* report.js - the viewers of the report, its overview and its keys.
 *
 * Each scene is a Viewer, which decodes its two pictures when it comes near the screen and lets them go
 * again when many others are open. All panes of a viewer share one view (scale and offset in CSS pixels)
 * and one probe, so they always show the same place. Without this script the page shows plain pictures.
 */
const byId = (id) => document.getElementById(id);
const clamp = (value, low, high) => Math.min(high, Math.max(low, value));
const CHANNELS = ['R', 'G', 'B'];
const LOUPE_PIXELS = 11; /* on a side, the probed one in the middle */
const OPEN_PIXELS_BUDGET = 24e6; /* decoded at a time; each takes about 24 bytes */
const MAX_SCALE = 64;
const reducedMotion = matchMedia('(prefers-reduced-motion: reduce)');

function announce(text) { byId('announce').textContent = text; }

class Viewer {
  constructor(section, box) {
    this.section = section;
    this.box = box;
    this.worst = { x: +box.dataset.worstX, y: +box.dataset.worstY };
    this.maxDifference = +box.dataset.maxDifference;
    this.fail = +box.dataset.fail;
    this.images = { ours: box.querySelector('.ours'), povray: box.querySelector('.povray') };
    this.held = false;
    this.mode = 'side';
    this.near = false;
    this.width = +box.dataset.width;
    this.height = +box.dataset.height;
    this.probe = this.maxDifference > 0 ? { ...this.worst } : { x: this.width >> 1, y: this.height >> 1 };
    this.build();
  }

  /* --- Opening and closing --- */

  async open() {
    if (this.pictures || this.opening) return;
    this.opening = true;
    try {
      const a = await decodePng(readDataAddress(this.images.ours.src));
      const b = await decodePng(readDataAddress(this.images.povray.src));
      if (a.width !== b.width || a.height !== b.height || a.max !== b.max || a.width !== this.width || a.height !== this.height) throw new Error('the two pictures are not of one size and depth');
      this.pictures = { ours: a, povray: b };
      this.screen = { ours: makeScreenTable(a), povray: makeScreenTable(b) };
      this.max = a.max;
      drawPicture(this.panes[0].querySelector('canvas'), a);
      drawPicture(this.panes[1].querySelector('canvas'), b);
      this.gainDrawn = null;
      this.setMode(this.mode);
      this.moveProbe(this.probe.x, this.probe.y);
      if (!this.section.querySelector('.chart')) this.drawChart();
      this.root.classList.add('ready');
    } catch (error) {
      this.pictures = null;
      this.root.hidden = true;
      this.box.classList.remove('viewed');
      if (!this.notice) {
        this.notice = document.createElement('p');
        this.notice.className = 'notice';
        this.notice.textContent = `These pictures can be seen but not measured here: ${error.message}.`;
        this.box.after(this.notice);
      }
    }
    this.opening = false;
  }

  close() {
    for (const canvas of this.root.querySelectorAll('.pane canvas')) canvas.width = canvas.height = 0;
    this.root.classList.remove('ready');
    this.pictures = null;
    this.setAuto(false);
  }

  /* Put the viewer, still dark but of its final size, in the place of the plain pictures, and listen. */
  build() {
    this.root = byId('viewer-template').content.firstElementChild.cloneNode(true);
    const find = (selector) => this.root.querySelector(selector);
    this.parts = {
      stage: find('.stage'), split: find('.split'), flip: find('.flip'), auto: find('.auto'), gain: find('.gain'), gainValue: find('.gain-value'),
      zoomValue: find('.zoom-value'), place: find('.probe-place'), heldNote: find('.held-note'), rows: find('.samples tbody'),
      unit: find('.probe-unit'), say: find('.probe-say'),
    };
    this.panes = [...this.root.querySelectorAll('.pane')];
    const name = this.section.querySelector('h2').textContent;
    this.parts.stage.setAttribute('aria-label', `Pictures of ${name}. Arrow keys move the pixel probe.`);
    this.parts.stage.style.setProperty('--aspect', clamp(this.width / this.height, 0.05, 20));
    for (const pane of this.panes) {
      const image = this.images[pane.dataset.pane];
      pane.querySelector('canvas').setAttribute('aria-label', image ? image.alt : `${name}, difference of each channel times the gain`);
    }
    const map = this.box.querySelector('.map-figure');
    if (map) find('.pane-map').append(map.cloneNode(true));
    for (const radio of this.root.querySelectorAll('.modes input')) {
      radio.name = `mode-${this.section.id}`;
      radio.addEventListener('change', () => this.setMode(radio.value));
    }

    /* Start with the gain that makes the largest difference fully bright. */
    this.parts.gain.value = this.maxDifference > 0 ? clamp(Math.log2(1 / this.maxDifference), 0, 16) : 16;
    this.parts.gain.addEventListener('input', () => this.drawGain());
    this.parts.split.addEventListener('input', () => this.setSplit(+this.parts.split.value));
    this.setSplit(50);
    this.parts.flip.addEventListener('click', () => { this.setAuto(false); this.flip(); });
    this.parts.auto.addEventListener('change', () => this.setAuto(this.parts.auto.checked));
    find('.zoom-in').addEventListener('click', () => this.zoom(2));
    find('.zoom-out').addEventListener('click', () => this.zoom(0.5));
    find('.zoom-fit').addEventListener('click', () => this.fit());
    const worstButton = find('.worst-button');
    if (this.maxDifference > 0) worstButton.addEventListener('click', () => this.goToWorst());
    else { worstButton.disabled = true; worstButton.textContent = 'No pixel differs'; }
    this.listenToStage();
    this.root.dataset.mode = this.mode;
    this.root.classList.toggle('stacked', this.width > 2.2 * this.height);
    this.box.after(this.root);
    this.box.classList.add('viewed');
    new ResizeObserver(() => { if (this.zoomed) this.place(); else this.fit(); }).observe(this.parts.stage);
  }

  /* --- Modes --- */

  setMode(mode) {
    this.mode = mode;
    this.root.dataset.mode = mode;
    for (const radio of this.root.querySelectorAll('.modes input')) radio.checked = radio.value === mode;
    this.setAuto(mode === 'blink' && !reducedMotion.matches);
    if (mode === 'blink') this.showBlink(false);
    if (mode === 'difference') this.drawGain();
    if (!this.zoomed) this.fit();
    else this.place();
  }

  setSplit(percent) {
    this.parts.split.value = percent;
    this.parts.split.setAttribute('aria-valuetext', `Éclairage up to ${Math.round(percent)} %, then POV-Ray`);
    this.parts.stage.style.setProperty('--split', `${percent}%`);
  }

  /* Blinking is once a second for each picture, slower than the three flashes that WCAG 2.3.1 allows. */
  setAuto(on) {
    clearInterval(this.timer);
    this.timer = on ? setInterval(() => { if (this.near) this.flip(); }, 1000) : 0;
    if (this.parts) this.parts.auto.checked = on;
  }

  flip() {
    if (this.mode !== 'blink') this.setMode('blink');
    this.showBlink(!this.root.classList.contains('flipped'));
  }

  showBlink(povray) {
    this.root.classList.toggle('flipped', povray);
    this.parts.flip.textContent = povray ? 'Show Éclairage' : 'Show POV-Ray';
  }

  get gain() {
    const power = +this.parts.gain.value;
    return power >= 16 ? 65535 : Math.round(2 ** power);
  }

  drawGain() {
    this.parts.gainValue.textContent = `×\u2009${this.gain}`;
    this.parts.gain.setAttribute('aria-valuetext', `times ${this.gain}`);
    if (!this.pictures || this.gainDrawn === this.gain) return;
    this.gainDrawn = this.gain;
    drawDifference(this.panes[2].querySelector('canvas'), this.pictures.ours, this.pictures.povray, this.gain);
  }

  /* --- The view: what of the picture is where in the panes --- */

  paneSize() {
    const pane = this.panes.find((p) => p.offsetWidth > 0);
    return pane ? { width: pane.clientWidth, height: pane.clientHeight } : null;
  }

  fitScale(size) { return Math.min(size.width / this.width, size.height / this.height); }

  fit() {
    const size = this.paneSize();
    if (!size) return;
    this.zoomed = false;
    this.scale = this.fitScale(size);
    this.x = (size.width - this.width * this.scale) / 2;
    this.y = (size.height - this.height * this.scale) / 2;
    this.place();
  }

  /* Zoom around a place in the pane, by default the probe's. */
  zoom(factor, at) {
    const size = this.paneSize();
    if (!size) return;
    const least = this.fitScale(size);
    const scale = clamp(this.scale * factor, least, Math.max(MAX_SCALE, least));
    if (scale <= least * 1.001) { this.fit(); return; }
    const centre = at || { x: this.x + (this.probe.x + 0.5) * this.scale, y: this.y + (this.probe.y + 0.5) * this.scale };
    this.x = centre.x - ((centre.x - this.x) / this.scale) * scale;
    this.y = centre.y - ((centre.y - this.y) / this.scale) * scale;
    this.scale = scale;
    this.zoomed = true;
    this.place();
    if (!at) this.reveal();
  }

  /* Keep the picture over the pane, and put canvases and markers where the view says. */
  place() {
    const size = this.paneSize();
    if (!size || !this.pictures) return;
    const spare = { x: size.width - this.width * this.scale, y: size.height - this.height * this.scale };
    this.x = spare.x > 0 ? spare.x / 2 : clamp(this.x, spare.x, 0);
    this.y = spare.y > 0 ? spare.y / 2 : clamp(this.y, spare.y, 0);
    for (const pane of this.panes) {
      const canvas = pane.querySelector('canvas');
      canvas.style.transform = `translate(${this.x}px, ${this.y}px) scale(${this.scale})`;
      canvas.classList.toggle('sharp', this.scale * devicePixelRatio >= 2);
      this.mark(pane.querySelector('.cross'), this.probe, this.scale);
      this.mark(pane.querySelector('.ring'), this.worst, 0);
      pane.querySelector('.ring').hidden = !(this.maxDifference > 0);
    }
    this.parts.zoomValue.textContent = this.zoomed ? `${this.scale < 10 ? this.scale.toFixed(1) : Math.round(this.scale)}×` : 'fit';
  }

  mark(element, pixel, side) {
    element.style.left = `${this.x + (pixel.x + 0.5) * this.scale}px`;
    element.style.top = `${this.y + (pixel.y + 0.5) * this.scale}px`;
    if (side > 0) element.style.width = element.style.height = `${side}px`;
    element.classList.toggle('large', side > 20);
  }

  /* Scroll a zoomed view until the probe is inside. */
  reveal() {
    const size = this.paneSize();
    if (!this.zoomed || !size) return;
    const margin = Math.min(40, size.width / 4, size.height / 4);
    const x = this.x + (this.probe.x + 0.5) * this.scale, y = this.y + (this.probe.y + 0.5) * this.scale;
    if (x < margin || x > size.width - margin) this.x += size.width / 2 - x;
    if (y < margin || y > size.height - margin) this.y += size.height / 2 - y;
    this.place();
  }

  /* --- The probe --- */

  moveProbe(x, y, say) {
    if (!this.pictures) return;
    this.probe = { x: clamp(x, 0, this.width - 1), y: clamp(y, 0, this.height - 1) };
    const { ours, povray } = this.pictures;
    const at = 3 * (this.probe.y * this.width + this.probe.x);
    this.parts.place.textContent = `(${this.probe.x}, ${this.probe.y})`;
    this.parts.heldNote.hidden = !this.held;
    const rows = CHANNELS.map((channel, c) => {
      const a = ours.samples[at + c], b = povray.samples[at + c];
      const cell = (value, table) => `<td data-value="${value}">${value}<small class="fraction">${(value / this.max).toFixed(5)}</small><small class="screen">${table[value]}</small></td>`;
      const difference = a === b ? '0' : `${a > b ? '+' : '\u2212'}${Math.abs(a - b)}`;
      return `<tr><th scope="row">${channel}</th>${cell(a, this.screen.ours)}${cell(b, this.screen.povray)}<td class="${a === b ? '' : 'unequal'}">${difference}</td></tr>`;
    });
    this.parts.rows.innerHTML = rows.join('');
    this.parts.unit.textContent = `The sample as stored (of ${this.max}), as a fraction, and as 8-bit sRGB on the screen.`;
    for (const loupe of this.root.querySelectorAll('.loupe')) this.drawLoupe(loupe);
    if (say) {
      const values = (picture) => [0, 1, 2].map((c) => picture.samples[at + c]).join(' ');
      this.parts.say.textContent = `${this.probe.x}, ${this.probe.y}: Éclairage ${values(ours)}, POV-Ray ${values(povray)}`;
    }
    this.place();
  }

  /* The probe's neighbourhood, one pixel a square; outside the picture stays dark. */
  drawLoupe(canvas) {
    const picture = this.pictures[canvas.dataset.pane], table = this.screen[canvas.dataset.pane];
    const context = canvas.getContext('2d');
    const side = canvas.width / LOUPE_PIXELS, half = (LOUPE_PIXELS - 1) / 2;
    context.fillStyle = '#0b0c0e';
    context.fillRect(0, 0, canvas.width, canvas.height);
    for (let dy = -half; dy <= half; dy++) {
      for (let dx = -half; dx <= half; dx++) {
        const x = this.probe.x + dx, y = this.probe.y + dy;
        if (x < 0 || y < 0 || x >= this.width || y >= this.height) continue;
        const at = 3 * (y * this.width + x);
        context.fillStyle = `rgb(${table[picture.samples[at]]} ${table[picture.samples[at + 1]]} ${table[picture.samples[at + 2]]})`;
        context.fillRect((dx + half) * side, (dy + half) * side, side, side);
      }
    }
    context.strokeStyle = '#000';
    context.strokeRect(half * side - 1.5, half * side - 1.5, side + 3, side + 3);
    context.strokeStyle = '#fff';
    context.strokeRect(half * side - 0.5, half * side - 0.5, side + 1, side + 1);
  }

  goToWorst() {
    this.held = true;
    this.moveProbe(this.worst.x, this.worst.y, true);
    this.reveal();
  }

  /* --- Pointer and keys --- */

  listenToStage() {
    const stage = this.parts.stage;
    let press = null;
    const locate = (event) => {
      const pane = event.target.closest('.pane');
      if (!pane) return null;
      const frame = pane.getBoundingClientRect();
      const x = event.clientX - frame.left, y = event.clientY - frame.top;
      return { x, y, share: (100 * x) / frame.width, column: Math.floor((x - this.x) / this.scale), row: Math.floor((y - this.y) / this.scale) };
    };
    stage.addEventListener('pointerdown', (event) => {
      const at = locate(event);
      if (!at || event.button !== 0) return;
      press = { x: event.clientX, y: event.clientY, moved: false };
      if (event.pointerType === 'mouse') stage.setPointerCapture(event.pointerId);
      if (event.pointerType !== 'mouse') this.moveProbe(at.column, at.row);
    });
    stage.addEventListener('pointermove', (event) => {
      if (press) {
        const dx = event.clientX - press.x, dy = event.clientY - press.y;
        press.moved ||= Math.abs(dx) + Math.abs(dy) > 4;
        if (!press.moved) return;
        if (this.mode === 'slider') {
          const frame = this.panes[0].getBoundingClientRect();
          this.setSplit(clamp((100 * (event.clientX - frame.left)) / frame.width, 0, 100));
        } else if (this.zoomed) {
          this.x += dx;
          this.y += dy;
          press.x = event.clientX;
          press.y = event.clientY;
          this.place();
        }
        return;
      }
      const at = locate(event);
      if (at && !this.held && event.pointerType === 'mouse') this.moveProbe(at.column, at.row);
    });
    stage.addEventListener('pointerup', (event) => {
      const clicked = press && !press.moved && event.pointerType === 'mouse';
      press = null;
      if (!clicked) return;
      const pane = this.panes.find((p) => {
        const frame = p.getBoundingClientRect();
        return p.offsetWidth > 0 && event.clientX >= frame.left && event.clientX < frame.right && event.clientY >= frame.top && event.clientY < frame.bottom;
      });
      if (!pane) return;
      const frame = pane.getBoundingClientRect();
      this.held = !this.held;
      this.moveProbe(Math.floor((event.clientX - frame.left - this.x) / this.scale), Math.floor((event.clientY - frame.top - this.y) / this.scale));
    });
    stage.addEventListener('pointercancel', () => { press = null; });
    stage.addEventListener('wheel', (event) => {
      const at = locate(event);
      if (!at || !event.ctrlKey) return;
      event.preventDefault();
      this.zoom(2 ** (-event.deltaY / 200), at);
    }, { passive: false });
    stage.addEventListener('keydown', (event) => {
      const step = event.shiftKey ? 10 : 1;
      const move = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] }[event.key];
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (move) {
        this.held = true;
        this.moveProbe(this.probe.x + move[0], this.probe.y + move[1], true);
        this.reveal();
      } else if (event.key === ' ') {
        this.flip();
        this.setAuto(false);
      } else return;
      event.preventDefault();
    });
  }

  /* A single key that is meant for this viewer; false when it has no meaning. */
  press(key) {
    if (!this.pictures) return false;
    const modes = { 1: 'side', 2: 'slider', 3: 'blink', 4: 'difference' };
    if (modes[key]) this.setMode(modes[key]);
    else if (key === 'w') this.goToWorst();
    else if (key === '+' || key === '=') this.zoom(2);
    else if (key === '-') this.zoom(0.5);
    else if (key === '0') this.fit();
    else if (key === ',' || key === '.') {
      const sign = key === '.' ? 1 : -1;
      if (this.mode === 'slider') this.setSplit(clamp(+this.parts.split.value + 5 * sign, 0, 100));
      else { if (this.mode !== 'difference') this.setMode('difference'); this.parts.gain.value = +this.parts.gain.value + sign; this.drawGain(); }
    } else return false;
    return true;
  }

  /* --- The histogram --- */

  drawChart() {
    const place = this.section.querySelector('.chart-place');
    const { counts, largest } = countDifferences(this.pictures.ours, this.pictures.povray);

    /* Make one bar a step where there are few, else one for each power of two. */
    const bins = [];
    if (largest <= 12) for (let n = 0; n <= Math.max(4, largest); n++) bins.push({ from: n, to: n });
    else { bins.push({ from: 0, to: 0 }); for (let n = 1; n <= largest; n *= 2) bins.push({ from: n, to: Math.min(2 * n - 1, this.max) }); }
    for (const bin of bins) {
      bin.count = 0;
      for (let n = bin.from; n <= bin.to && n <= largest; n++) bin.count += counts[n] ?? 0;
      bin.name = bin.from === bin.to ? `${bin.from}` : `${bin.from}\u2013${bin.to}`;
    }

    /* Lay the bars out; heights are logarithmic, and a single pixel can still be seen. */
    const tilt = bins.length > 7, width = 520, height = tilt ? 226 : 182, base = 160, top = 22;
    const slot = width / bins.length, most = Math.log10(this.width * this.height + 1) || 1;
    const limit = Math.floor(this.fail * this.max + 1e-9);
    const parts = [`<line class="axis" x1="0" x2="${width}" y1="${base}" y2="${base}"/>`];
    bins.forEach((bin, i) => {
      const x = i * slot, tall = bin.count ? 6 + (base - top - 6) * (Math.log10(bin.count) / most) : 0;
      const outside = bin.from > limit;
      parts.push(`<rect class="${outside ? 'outside' : 'inside'}" x="${x + slot * 0.12}" width="${slot * 0.76}" y="${base - tall}" height="${tall}" rx="2"/>`);
      if (outside && tall > 6) for (let h = 6; h < tall; h += 7) parts.push(`<line class="outside-hatch" x1="${x + slot * 0.12}" x2="${x + slot * 0.88}" y1="${base - h}" y2="${base - h - 3}"/>`);
      if (bin.count) parts.push(`<text class="bar-count" x="${x + slot / 2}" y="${base - tall - 5}" text-anchor="middle">${shortCount(bin.count, bins.length)}</text>`);
      parts.push(`<text ${tilt ? `transform="translate(${x + slot / 2 + 3} ${base + 12}) rotate(-38)" text-anchor="end"` : `x="${x + slot / 2}" y="${base + 16}" text-anchor="middle"`}>${bin.name}</text>`);
    });
    const beyond = bins.findIndex((bin) => bin.from > limit);
    if (beyond > 0) parts.push(`<line class="limit-line" x1="${beyond * slot}" x2="${beyond * slot}" y1="${top - 8}" y2="${base + 6}"/><text x="${beyond * slot + 4}" y="${top}">differs from here: more than ${limit}</text>`);

    const figure = document.createElement('figure');
    figure.className = 'chart';
    const told = bins.filter((bin) => bin.count).map((bin) => `${bin.name}: ${bin.count}`).join('; ');
    figure.innerHTML = `<figcaption class="chart-title">Pixels by their largest difference <span class="soft">in steps of 1/${this.max}</span></figcaption>`
      + `<svg viewBox="0 -4 ${width} ${height}" role="img" aria-label="Histogram, pixels by difference in steps of 1/${this.max}. ${told}.">${parts.join('')}</svg>`
      + `<p class="soft probe-hint">Bar heights are logarithmic. ${limit < largest ? 'Hatched bars lie beyond the scene’s fail.' : ''}</p>`;
    place.replaceChildren(figure);
  }
}

/* A count that fits over its bar. */
function shortCount(count, bars) {
  if (bars <= 8 || count < 10000) return String(count);
  return count < 1e6 ? `${Math.round(count / 1000)}k` : `${(count / 1e6).toFixed(1)}M`;
}

/* --- The page --- */

const viewers = new Map();
for (const section of document.querySelectorAll('.scene')) {
  const box = section.querySelector('.pictures');
  if (!box) continue;
  box.classList.toggle('small', +box.dataset.width < 200 && +box.dataset.height < 200);
  viewers.set(section, new Viewer(section, box));
}

/* Open what comes near, one after the other; close the one not near for longest when too much is open. */
const opened = [];
let opening = Promise.resolve();
function openNear(viewer) {
  opening = opening.then(async () => {
    if (!viewer.near || viewer.pictures) return;
    await viewer.open();
    if (!viewer.pictures) return;
    opened.push(viewer);
    let total = opened.reduce((sum, v) => sum + v.width * v.height, 0);
    for (const old of opened.filter((v) => !v.near)) {
      if (total <= OPEN_PIXELS_BUDGET) break;
      total -= old.width * old.height;
      old.close();
      opened.splice(opened.indexOf(old), 1);
    }
  });
}
const nearScreen = new IntersectionObserver((entries) => {
  for (const entry of entries) {
    const viewer = viewers.get(entry.target);
    viewer.near = entry.isIntersecting;
    if (viewer.near) openNear(viewer);
  }
}, { rootMargin: '400px 0px' });
for (const section of viewers.keys()) nearScreen.observe(section);

/* Give every card a small copy of the scene's picture. */
for (const thumb of document.querySelectorAll('.thumb')) {
  const box = byId(thumb.dataset.scene).querySelector('.pictures');
  thumb.classList.toggle('empty', !box);
  if (!box) continue;
  const image = new Image();
  image.alt = '';
  image.decoding = 'async';
  image.src = box.querySelector('.ours').src;
  thumb.classList.toggle('small', box.classList.contains('small'));
  thumb.append(image);
}

/* Filter the scenes by outcome. */
const filters = [...document.querySelectorAll('[data-filter]')];
function filterScenes(wanted) {
  for (const button of filters) button.setAttribute('aria-pressed', String(button.dataset.filter === wanted));
  for (const item of document.querySelectorAll('.card, .scene')) item.hidden = wanted !== 'all' && item.dataset.outcome !== wanted;
  announce(`${document.querySelectorAll('.scene:not([hidden])').length} scenes shown`);
}
for (const button of filters) {
  const empty = button.dataset.filter !== 'all' && button.querySelector('b').textContent === '0';
  button.hidden = empty;
  button.addEventListener('click', () => filterScenes(button.dataset.filter));
}
/* A link to a hidden scene shows it again. */
addEventListener('hashchange', () => {
  const target = document.querySelector(`.scene[id="${CSS.escape(location.hash.slice(1))}"]`);
  if (target && target.hidden) { filterScenes('all'); target.scrollIntoView(); }
});

/* Copy a command; without clipboard access, select it so that the user can. */
for (const button of document.querySelectorAll('.copy')) {
  button.addEventListener('click', async () => {
    const code = byId(button.dataset.copy);
    let said = 'Copied';
    try { await navigator.clipboard.writeText(code.textContent); } catch {
      const range = document.createRange();
      range.selectNodeContents(code);
      getSelection().removeAllRanges();
      getSelection().addRange(range);
      if (!document.execCommand('copy')) said = 'Selected';
    }
    button.textContent = said;
    announce(said);
    setTimeout(() => { button.textContent = 'Copy'; }, 1500);
  });
}

/* Light and dark: the system's choice until the user makes one. */
const systemDark = matchMedia('(prefers-color-scheme: dark)');
const isDark = () => (document.documentElement.dataset.theme || (systemDark.matches ? 'dark' : 'light')) === 'dark';
function showTheme() { byId('theme-button').setAttribute('aria-pressed', String(isDark())); }
function toggleTheme() {
  document.documentElement.dataset.theme = isDark() ? 'light' : 'dark';
  try { localStorage.setItem('eclairage-theme', document.documentElement.dataset.theme); } catch { /* it lasts as long as the page */ }
  showTheme();
}
byId('theme-button').addEventListener('click', toggleTheme);
systemDark.addEventListener('change', showTheme);
showTheme();

const help = byId('help');
byId('help-button').addEventListener('click', () => help.showModal());

/* The scene that the user is at: the focused one, else the one that covers the screen's middle. */
function currentScene() {
  const focused = document.activeElement && document.activeElement.closest('.scene');
  if (focused) return focused;
  const scenes = [...document.querySelectorAll('.scene:not([hidden])')];
  return scenes.find((scene) => scene.getBoundingClientRect().bottom > innerHeight / 2) || scenes[0];
}

function goToScene(step, wanted) {
  const scenes = [...document.querySelectorAll('.scene:not([hidden])')];
  const current = currentScene();
  const started = current && (current.contains(document.activeElement) || current.getBoundingClientRect().top < innerHeight / 2);
  let next = scenes.indexOf(current) + (step > 0 && !started ? 0 : step);
  while (wanted && scenes[next] && !wanted(scenes[next])) next += step;
  const scene = scenes[next];
  if (!scene) return;
  scene.scrollIntoView();
  const stage = scene.querySelector('.stage');
  (stage || scene).focus({ preventScroll: true });
}

document.addEventListener('keydown', (event) => {
  const typing = event.target instanceof Element && event.target.matches('input:not([type="range"], [type="radio"], [type="checkbox"]), textarea, select');
  if (event.ctrlKey || event.metaKey || event.altKey || typing || help.open) return;
  if (event.key === '?') help.showModal();
  else if (!byId('keys-on').checked) return;
  else if (event.key === 't') toggleTheme();
  else if (event.key === 'n') goToScene(1);
  else if (event.key === 'p') goToScene(-1);
  else if (event.key === 'x') goToScene(1, (scene) => scene.dataset.outcome !== 'agree');
  else {
    const viewer = viewers.get(currentScene());
    if (!viewer || !viewer.press(event.key)) return;
  }
  event.preventDefault();
});
