/* report_picture.js - the pictures of the report as exact samples.
 *
 * A browser shows a 16-bit PNG through 8 bits; the probe, the gain and the histogram need the samples as
 * stored. So the page decodes its own PNG files (W3C PNG, third edition; sections 5, 9 and 10): no
 * interlacing, no palette, 8 or 16 bits, which is what Éclairage writes. Every other file is an Error.
 */
'use strict';

/* The bytes of a base64 data address. */
function readDataAddress(address) {
  const text = atob(address.slice(address.indexOf(',') + 1));
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function inflate(parts) {
  const stream = new Blob(parts).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/* Undo the row filters in place (section 9.2). Each row is a filter byte and rowBytes bytes; left is the
 * distance in bytes to the pixel on the left. */
function unfilter(data, height, rowBytes, left) {
  for (let y = 0; y < height; y++) {
    const row = y * (rowBytes + 1) + 1;
    const above = row - rowBytes - 1;
    const filter = data[row - 1];
    if (filter > 4) throw new Error('a row of the PNG has an unknown filter');
    for (let i = 0; filter > 0 && i < rowBytes; i++) {
      const a = i >= left ? data[row + i - left] : 0;
      const b = y > 0 ? data[above + i] : 0;
      let guess = a;
      if (filter === 2) guess = b;
      if (filter === 3) guess = (a + b) >> 1;
      if (filter === 4) {
        /* Paeth: whichever of left, above and above left is nearest to left + above - above left. */
        const c = y > 0 && i >= left ? data[above + i - left] : 0;
        const toA = Math.abs(b - c), toB = Math.abs(a - c), toC = Math.abs(a + b - c - c);
        guess = toA <= toB && toA <= toC ? a : toB <= toC ? b : c;
      }
      data[row + i] += guess;
    }
  }
}

/* {width, height, max: 255 or 65535, linear, samples: 3 a pixel}. */
async function decodePng(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  const found = { idat: [], gamma: 0, srgb: false };
  for (let at = 8; at + 12 <= bytes.length;) {
    const length = view.getUint32(at);
    const kind = String.fromCharCode(...bytes.subarray(at + 4, at + 8));
    if (kind === 'IHDR') found.header = at + 8;
    if (kind === 'gAMA') found.gamma = view.getUint32(at + 8);
    if (kind === 'sRGB' || kind === 'iCCP') found.srgb = true;
    if (kind === 'IDAT') found.idat.push(bytes.subarray(at + 8, at + 8 + length));
    at += length + 12;
  }
  if (found.header === undefined) throw new Error('the PNG has no header');
  const width = view.getUint32(found.header), height = view.getUint32(found.header + 4);
  const [depth, colourType, , , interlaced] = bytes.subarray(found.header + 8, found.header + 13);
  const channels = { 0: 1, 2: 3, 4: 2, 6: 4 }[colourType];
  if (!channels || interlaced || (depth !== 8 && depth !== 16)) throw new Error('the PNG is of a kind that this page does not read');

  const size = depth / 8, rowBytes = width * channels * size;
  const data = await inflate(found.idat);
  if (data.length < height * (rowBytes + 1)) throw new Error('the PNG is cut short');
  unfilter(data, height, rowBytes, channels * size);

  /* Gather big-endian samples; grey is repeated, alpha dropped. */
  const samples = new Uint16Array(width * height * 3);
  const green = channels < 3 ? 0 : 1, blue = channels < 3 ? 0 : 2;
  let to = 0;
  for (let y = 0; y < height; y++) {
    let from = y * (rowBytes + 1) + 1;
    for (let x = 0; x < width; x++, from += channels * size) {
      for (const channel of [0, green, blue]) {
        const i = from + channel * size;
        samples[to++] = size === 2 ? (data[i] << 8) | data[i + 1] : data[i];
      }
    }
  }
  return { width, height, max: depth === 16 ? 65535 : 255, linear: !found.srgb && Math.abs(found.gamma - 100000) <= 1000, samples };
}

/* For every stored sample the 8-bit sRGB value that a screen expects (IEC 61966-2-1). */
function makeScreenTable(picture) {
  const table = new Uint8Array(picture.max + 1);
  for (let i = 0; i <= picture.max; i++) {
    const v = i / picture.max;
    const encoded = !picture.linear ? v : v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
    table[i] = Math.floor(encoded * 255 + 0.5);
  }
  return table;
}

/* Draw a picture for the screen. */
function drawPicture(canvas, picture) {
  paint(canvas, picture.width, picture.height, makeScreenTable(picture), (i) => picture.samples[i]);
}

/* Draw |a - b| * gain of each channel, clamped; the result is a share of full brightness on the screen. */
function drawDifference(canvas, a, b, gain) {
  const table = new Uint8Array(a.max + 1);
  for (let i = 0; i <= a.max; i++) table[i] = Math.min(255, Math.floor((i / a.max) * gain * 255 + 0.5));
  paint(canvas, a.width, a.height, table, (i) => Math.abs(a.samples[i] - b.samples[i]));
}

/* Fill a canvas with table[value(i)] in bands, so that one band's memory is enough for any size. */
function paint(canvas, width, height, table, value) {
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext('2d');
  const bandRows = Math.max(1, Math.floor(1e6 / width));
  for (let top = 0; top < height; top += bandRows) {
    const rows = Math.min(bandRows, height - top);
    const band = context.createImageData(width, rows);
    let i = top * width * 3;
    for (let to = 0; to < band.data.length; to += 4) {
      band.data[to] = table[value(i++)];
      band.data[to + 1] = table[value(i++)];
      band.data[to + 2] = table[value(i++)];
      band.data[to + 3] = 255;
    }
    context.putImageData(band, 0, top);
  }
}

/* counts[n]: the pixels whose largest channel difference is n steps; and the largest n there is. */
function countDifferences(a, b) {
  const counts = new Uint32Array(a.max + 1);
  let largest = 0;
  for (let i = 0; i < a.samples.length; i += 3) {
    let worst = 0;
    for (let c = i; c < i + 3; c++) worst = Math.max(worst, Math.abs(a.samples[c] - b.samples[c]));
    counts[worst]++;
    if (worst > largest) largest = worst;
  }
  return { counts, largest };
}
