// The page on which pictures are compared. Everything it shows is in the page itself: the numbers
// as JSON (#data, the same text as the JSON file), the pictures in #page as half floats.
//
// Pixels of a picture: one plane per channel, each value a half float; each row's bit patterns as
// differences from their left neighbour (mod 2^16), then all low bytes, then all high bytes, then
// zlib, then base64.
//
// The view is a table made by OpenColorIO: a curve per channel where channels do not mix, otherwise
// a cube with linear interpolation; both over log2(1 + v / offset), up to `top`.
'use strict';

const page = JSON.parse(document.getElementById('page').textContent);
const data = JSON.parse(document.getElementById('data').textContent);
const element = (id) => document.getElementById(id);

// ---- numbers -------------------------------------------------------------------------------

function halfToFloat(bits) {
  const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, fraction = bits & 1023;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (exponent ? 2 ** (exponent - 15) * (1 + fraction / 1024) : 2 ** -24 * fraction);
}

const floatOfHalf = new Float32Array(65536).map((_, bits) => halfToFloat(bits));

function bytesOf(base64) {
  return Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function undoDifferences(bytes, width) {
  const count = bytes.length / 2, halves = new Uint16Array(count);
  for (let i = 0; i < count; ++i) {
    const bits = bytes[i] | bytes[count + i] << 8;
    halves[i] = i % width ? halves[i - 1] + bits : bits;
  }
  return halves;
}

async function decode(picture) {
  const halves = undoDifferences(await inflate(bytesOf(picture.pixels)), page.width);
  const size = page.width * page.height;
  picture.planes = [];
  for (let i = 0; i < halves.length; i += size) picture.planes.push(halves.subarray(i, i + size));
}

// ---- colours -------------------------------------------------------------------------------

const view = page.view;
view.table = bytesOf(view.table);
const colourMaps = Object.fromEntries(
  Object.entries(page.maps).map(([name, colours]) => [name, bytesOf(colours)]));

/// Where every half float lies in the view's table, in [0, 1].
function tablePlaces(exposure) {
  const scale = 2 ** exposure, span = Math.log2(1 + view.top / view.offset);
  return floatOfHalf.map((v) => {
    const light = Math.min(v * scale, view.top);
    return light > 0 ? Math.log2(1 + light / view.offset) / span : 0;  // NaN too
  });
}

function shadeByCurve(planes, places, out) {
  const last = view.size - 1;
  for (let c = 0; c < 3; ++c) {
    const byte = new Uint8Array(65536);
    for (let h = 0; h < 65536; ++h) {
      const at = places[h] * last, low = Math.min(Math.floor(at), last - 1), t = at - low;
      const curve = 3 * low + c;
      byte[h] = Math.round((1 - t) * view.table[curve] + t * view.table[curve + 3]);
    }
    const plane = planes[c];
    for (let i = 0; i < plane.length; ++i) out[4 * i + c] = byte[plane[i]];
  }
}

function shadeByCube(planes, places, out) {
  const size = view.size, last = size - 1;
  const low = [0, 0, 0], t = [0, 0, 0], stride = [3 * size * size, 3 * size, 3];
  for (let i = 0; i < planes[0].length; ++i) {
    for (let c = 0; c < 3; ++c) {
      const at = places[planes[c][i]] * last;
      low[c] = Math.min(Math.floor(at), last - 1);
      t[c] = at - low[c];
    }
    let r = 0, g = 0, b = 0;
    for (let corner = 0; corner < 8; ++corner) {
      let weight = 1, at = 0;
      for (let c = 0; c < 3; ++c) {
        const up = corner >> c & 1;
        weight *= up ? t[c] : 1 - t[c];
        at += (low[c] + up) * stride[c];
      }
      r += weight * view.table[at];
      g += weight * view.table[at + 1];
      b += weight * view.table[at + 2];
    }
    out[4 * i] = r;
    out[4 * i + 1] = g;
    out[4 * i + 2] = b;
  }
}

function shadeByMap(picture, out) {
  const colours = colourMaps[picture.map], last = colours.length / 3 - 1;
  picture.planes[0].forEach((half, i) => {
    const v = floatOfHalf[half];
    const t = (v - picture.low) / (picture.high - picture.low);
    const at = 3 * Math.round(Math.min(Math.max(t, 0), 1) * last);
    for (let c = 0; c < 3; ++c) out[4 * i + c] = isFinite(v) ? colours[at + c] : c === 1 ? 0 : 255;
  });
}

/// The picture as a canvas, at the exposure of now.
function shaded(picture) {
  const exposure = picture.map ? 0 : state.exposure;
  if (picture.canvas && picture.exposure === exposure) return picture.canvas;
  const canvas = picture.canvas || document.createElement('canvas');
  canvas.width = page.width;
  canvas.height = page.height;
  const image = new ImageData(page.width, page.height);
  for (let i = 3; i < image.data.length; i += 4) image.data[i] = 255;
  if (picture.map) shadeByMap(picture, image.data);
  else if (view.kind === 'curve') shadeByCurve(picture.planes, tablePlaces(exposure), image.data);
  else shadeByCube(picture.planes, tablePlaces(exposure), image.data);
  canvas.getContext('2d', { willReadFrequently: true }).putImageData(image, 0, 0);
  picture.canvas = canvas;
  picture.exposure = exposure;
  return canvas;
}

// ---- drawing -------------------------------------------------------------------------------

const state = { a: 0, b: 1, mode: 'wipe', wipe: 0.5, exposure: page.exposure, blinkB: false,
                scale: 1, x: 0, y: 0 };
const canvas = element('view');

/// The panes of the canvas: [x, width, picture].
function panes() {
  const { width } = canvas, a = page.pictures[state.a], b = page.pictures[state.b];
  if (state.mode === 'blink') return [[0, width, state.blinkB ? b : a]];
  if (state.mode === 'side') return [[0, width / 2, a], [width / 2, width / 2, b]];
  return [[0, width, b], [0, state.wipe * width, a]];
}

/// Where panes put their picture: side by side they share zoom and place, each in its own half.
function paneOrigin(x) {
  return state.mode === 'side' ? x + state.x : state.x;
}

function draw() {
  canvas.width = canvas.clientWidth * devicePixelRatio;
  canvas.height = canvas.clientHeight * devicePixelRatio;
  const pen = canvas.getContext('2d');
  for (const [x, width, picture] of panes()) {
    pen.save();
    pen.beginPath();
    pen.rect(x, 0, width, canvas.height);
    pen.clip();
    pen.fillStyle = '#777';
    pen.fillRect(x, 0, width, canvas.height);
    pen.imageSmoothingEnabled = state.scale < 1;
    pen.drawImage(shaded(picture), paneOrigin(x), state.y, state.scale * page.width,
                  state.scale * page.height);
    drawName(pen, x, width, picture);
    pen.restore();
  }
  if (state.mode !== 'blink') drawDivider(pen);
}

function drawName(pen, x, width, picture) {
  pen.font = `${13 * devicePixelRatio}px system-ui, sans-serif`;
  const margin = 6 * devicePixelRatio, line = 18 * devicePixelRatio;
  const words = pen.measureText(picture.name).width;
  const isRight = state.mode === 'wipe' && picture === page.pictures[state.b];
  const left = isRight ? x + width - words - margin : x + margin;
  pen.fillStyle = '#000a';
  pen.fillRect(left - margin / 2, 0, words + margin, line);
  pen.fillStyle = '#fff';
  pen.fillText(picture.name, left, line * 0.75);
}

function drawDivider(pen) {
  const x = (state.mode === 'side' ? 0.5 : state.wipe) * canvas.width;
  pen.fillStyle = '#fff';
  pen.fillRect(x - 1, 0, 2, canvas.height);
  pen.fillStyle = '#000';
  pen.fillRect(x + 1, 0, 1, canvas.height);
}

// ---- looking around ------------------------------------------------------------------------

function fit() {
  canvas.width = canvas.clientWidth * devicePixelRatio;
  canvas.height = canvas.clientHeight * devicePixelRatio;
  const width = canvas.width / (state.mode === 'side' ? 2 : 1);
  state.scale = Math.min(width / page.width, canvas.height / page.height);
  state.x = (width - state.scale * page.width) / 2;
  state.y = (canvas.height - state.scale * page.height) / 2;
  draw();
}

/// The pixel of the canvas under the pointer, seen from its pane's left edge.
function pointer(event) {
  const box = canvas.getBoundingClientRect();
  let x = (event.clientX - box.left) * devicePixelRatio;
  const y = (event.clientY - box.top) * devicePixelRatio;
  if (state.mode === 'side' && x >= canvas.width / 2) x -= canvas.width / 2;
  return { x, y };
}

function zoom(factor, at) {
  const scale = Math.min(Math.max(state.scale * factor, 0.05), 64);
  state.x = at.x - (at.x - state.x) * scale / state.scale;
  state.y = at.y - (at.y - state.y) * scale / state.scale;
  state.scale = scale;
  draw();
}

function pixelAt(at) {
  const x = Math.floor((at.x - state.x) / state.scale);
  const y = Math.floor((at.y - state.y) / state.scale);
  const inside = x >= 0 && y >= 0 && x < page.width && y < page.height;
  return inside ? { x, y } : null;
}

function valueText(picture, index) {
  const values = picture.planes.map((plane) => floatOfHalf[plane[index]]);
  if (!picture.map) return values.map((v) => v.toPrecision(4));
  return [(values[0] / picture.unit_size).toPrecision(4) + picture.unit];
}

function showValues(pixel) {
  if (!pixel) return;
  const shrunk = page.shrink > 1 ? `, mean of ${page.shrink}x${page.shrink}` : '';
  element('place').textContent =
    `pixel ${pixel.x * page.shrink}, ${pixel.y * page.shrink}${shrunk}: red, green, blue`;
  const index = pixel.y * page.width + pixel.x;
  element('values').replaceChildren(...page.pictures.map((picture) =>
    row('td', [picture.name, ...valueText(picture, index)])));
}

// ---- tables --------------------------------------------------------------------------------

function row(tag, texts) {
  const tr = document.createElement('tr');
  for (const text of texts) {
    const cell = document.createElement(tag);
    cell.textContent = text;
    tr.append(cell);
  }
  return tr;
}

/// What a JSON pointer (RFC 6901) finds in the data.
function find(pointer) {
  return pointer.split('/').slice(1).reduce(
    (at, key) => at?.[key.replace(/~1/g, '/').replace(/~0/g, '~')], data);
}

function showFigures() {
  const table = element('figures');
  const head = row('th', ['', ...page.table.columns.map((c) => c.title)]);
  page.table.columns.forEach((c, i) => { head.children[i + 1].title = c.formula; });
  table.append(head);
  for (const line of page.table.rows) {
    const values = line.pointers.map(find);
    const texts = values.map((v) => typeof v === 'number' ? Number(v.toPrecision(5)).toString()
                                                          : v ?? '');
    const tr = row('td', [line.name, ...texts]);
    line.pointers.forEach((p, i) => { tr.children[i + 1].dataset.pointer = p; });
    table.append(tr);
  }
  markBest(table);
}

/// In columns that say which way is better, the best number is bold.
function markBest(table) {
  page.table.columns.forEach((column, i) => {
    const cells = [...table.querySelectorAll('tr')].slice(1).map((tr) => tr.children[i + 1]);
    const numbers = cells.map((cell) => find(cell.dataset.pointer));
    const known = numbers.filter((v) => typeof v === 'number');
    if (known.length < 2 || column.better === 'neither') return;
    const best = column.better === 'smaller' ? Math.min(...known) : Math.max(...known);
    cells.forEach((cell, k) => cell.classList.toggle('best', numbers[k] === best));
  });
}

function showScales() {
  const seen = new Set();
  for (const p of page.pictures.filter((picture) => picture.map)) {
    const key = [p.map, p.low, p.high, p.unit, p.caption].join();
    if (seen.has(key)) continue;
    seen.add(key);
    const colours = colourMaps[p.map], stops = [];
    for (let i = 0; i < colours.length; i += 3) {
      stops.push(`rgb(${colours[i]} ${colours[i + 1]} ${colours[i + 2]})`);
    }
    const scale = document.createElement('div'), bar = document.createElement('div');
    const numbers = document.createElement('div'), caption = document.createElement('div');
    scale.className = 'scale';
    bar.className = 'bar';
    bar.style.background = `linear-gradient(to right, ${stops.join()})`;
    numbers.className = 'numbers';
    for (let i = 0; i <= 4; ++i) {
      const span = document.createElement('span');
      const value = (p.low + (p.high - p.low) * i / 4) / p.unit_size;
      span.textContent = Number(value.toPrecision(3)) + p.unit;
      numbers.append(span);
    }
    caption.textContent = p.caption;
    scale.append(bar, numbers, caption);
    element('scales').append(scale);
  }
}

// ---- controls ------------------------------------------------------------------------------

function setMode(mode) {
  const wasSide = state.mode === 'side';
  state.mode = mode;
  document.querySelector(`input[name=mode][value=${mode}]`).checked = true;
  element('wipe-label').style.visibility = mode === 'wipe' ? 'visible' : 'hidden';
  if (wasSide !== (mode === 'side')) fit();
  else draw();
}

function setPair(a, b) {
  state.a = element('a').selectedIndex = a;
  state.b = element('b').selectedIndex = b;
  draw();
}

function setWipe(wipe) {
  state.wipe = Math.min(Math.max(wipe, 0), 1);
  element('wipe').value = state.wipe;
  draw();
}

function setExposure(exposure) {
  state.exposure = exposure;
  element('exposure').value = exposure;
  element('exposure-value').textContent = `${exposure > 0 ? '+' : ''}${exposure} stops`;
  draw();
}

function blink() {
  if (state.mode !== 'blink') return;
  state.blinkB = !state.blinkB;
  draw();
}

function connectControls() {
  for (const id of ['a', 'b']) {
    element(id).append(...page.pictures.map((picture) => new Option(picture.name)));
    element(id).addEventListener('change', () =>
      setPair(element('a').selectedIndex, element('b').selectedIndex));
  }
  for (const input of document.querySelectorAll('input[name=mode]')) {
    input.addEventListener('change', () => setMode(input.value));
  }
  element('swap').addEventListener('click', () => setPair(state.b, state.a));
  element('wipe').addEventListener('input', (event) => setWipe(Number(event.target.value)));
  element('exposure').addEventListener('input', (e) => setExposure(Number(e.target.value)));
  element('fit').addEventListener('click', fit);
  element('actual').addEventListener('click', () =>
    zoom(1 / state.scale, { x: canvas.width / 2, y: canvas.height / 2 }));
  addEventListener('resize', draw);
  setInterval(blink, 600);
}

/// Dragging near the divider moves it, elsewhere the pictures.
function connectCanvas() {
  let drag = null;
  canvas.addEventListener('pointerdown', (event) => {
    const at = pointer(event);
    const grip = 8 * devicePixelRatio;
    const onDivider = state.mode === 'wipe' && Math.abs(at.x - state.wipe * canvas.width) < grip;
    drag = { divider: onDivider, x: event.clientX, y: event.clientY };
    if (event.isTrusted) canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointerup', () => { drag = null; });
  canvas.addEventListener('pointermove', (event) => {
    showValues(pixelAt(pointer(event)));
    if (!drag) return;
    if (drag.divider) return setWipe(pointer(event).x / canvas.width);
    state.x += (event.clientX - drag.x) * devicePixelRatio;
    state.y += (event.clientY - drag.y) * devicePixelRatio;
    drag.x = event.clientX;
    drag.y = event.clientY;
    draw();
  });
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoom(2 ** (-event.deltaY / 240), pointer(event));
  }, { passive: false });
}

function connectKeys() {
  const keys = { b: () => setMode(state.mode === 'blink' ? 'wipe' : 'blink'), f: fit,
                 w: () => setMode('wipe'), s: () => setMode('side'),
                 x: () => setPair(state.b, state.a), 1: () => element('actual').click() };
  addEventListener('keydown', (event) => {
    const typing = ['SELECT', 'INPUT'].includes(event.target.tagName);
    if (!typing && !event.ctrlKey && !event.metaKey && keys[event.key]) keys[event.key]();
  });
}

async function start() {
  document.title = page.title;
  element('title').textContent = page.title;
  element('notes').append(...page.notes.map((note) => {
    const li = document.createElement('li');
    li.textContent = note;
    return li;
  }));
  await Promise.all(page.pictures.map(decode));
  connectControls();
  connectCanvas();
  connectKeys();
  showFigures();
  showScales();
  setPair(0, Math.min(1, page.pictures.length - 1));
  setExposure(page.exposure);
  fit();
}

const started = start();
