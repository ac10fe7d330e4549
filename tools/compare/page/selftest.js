// Opened with ?selftest the page tries itself out as a person would, and leaves what it found as
// JSON in the element #selftest: {"passed": true, "checks": {...}, "errors": [...]}.
'use strict';

const errors = [];
addEventListener('error', (event) => errors.push(String(event.message)));
addEventListener('unhandledrejection', (event) => errors.push(String(event.reason)));

const copy = document.createElement('canvas');

/// All bytes of the canvas, summed: the same for the same picture, nearly never for another.
function fingerprint() {
  copy.width = canvas.width;
  copy.height = canvas.height;
  const pen = copy.getContext('2d', { willReadFrequently: true });
  pen.drawImage(canvas, 0, 0);
  const { data: bytes } = pen.getImageData(0, 0, copy.width, copy.height);
  return bytes.reduce((sum, byte, i) => (sum * 31 + byte * (i % 251 + 1)) % 1000000007, 7);
}

function slide(id, value) {
  element(id).value = value;
  element(id).dispatchEvent(new Event('input'));
}

function changes(action) {
  const before = fingerprint();
  action();
  return fingerprint() !== before;
}

/// Every probe is a value of the float picture: [picture, pixel, channel, value]. A half float has
/// 11 bits, and is never further from its number than half its last place or half of 2^-24.
function probesAgree() {
  return page.probes.every(([p, pixel, channel, value]) => {
    const half = floatOfHalf[page.pictures[p].planes[channel][pixel]];
    if (value === null) return !isFinite(half);
    return Math.abs(half - value) <= Math.max(Math.abs(value) * 2 ** -11, 2 ** -25);
  });
}

/// The pictures look as OpenColorIO shows them: 99 % of all colours within the table's error, so of
/// the few here nine in ten.
function coloursAgree() {
  const agree = page.shown.filter(([p, pixel, ...expected]) => {
    const pen = shaded(page.pictures[p]).getContext('2d');
    const x = pixel % page.width, y = Math.floor(pixel / page.width);
    const { data: bytes } = pen.getImageData(x, y, 1, 1);
    return expected.every((v, c) => Math.abs(bytes[c] - v) <= view.error);
  });
  return agree.length >= 0.9 * page.shown.length;
}

/// Every cell shows its number of the data, to the five digits it has room for.
function cellsAgree() {
  const cells = [...document.querySelectorAll('#figures td[data-pointer]')];
  return cells.length > 0 && cells.every((cell) => {
    const value = find(cell.dataset.pointer);
    if (typeof value !== 'number') return cell.textContent === (value ?? '');
    return Math.abs(Number(cell.textContent) - value) <= 5e-5 * Math.abs(value);
  });
}

function wheelAndPoint() {
  const box = canvas.getBoundingClientRect();
  const at = { clientX: box.left + box.width / 4, clientY: box.top + box.height / 2 };
  const before = state.scale;
  canvas.dispatchEvent(new WheelEvent('wheel', { ...at, deltaY: -240, cancelable: true }));
  canvas.dispatchEvent(new PointerEvent('pointermove', at));
  return state.scale === 2 * before && element('values').rows.length === page.pictures.length &&
         /^pixel \d+, \d+/.test(element('place').textContent);
}

function dragDivider() {
  setWipe(0.5);
  const box = canvas.getBoundingClientRect(), clientY = box.top + 50;
  const at = (share) => ({ clientX: box.left + share * box.width, clientY, pointerId: 1 });
  canvas.dispatchEvent(new PointerEvent('pointerdown', at(0.5)));
  canvas.dispatchEvent(new PointerEvent('pointermove', at(0.25)));
  canvas.dispatchEvent(new PointerEvent('pointerup', at(0.25)));
  return Math.abs(state.wipe - 0.25) < 0.01 && Math.abs(element('wipe').value - 0.25) < 0.01;
}

async function selftest() {
  await started;
  const checks = {};
  checks.probes = probesAgree();
  checks.colours = coloursAgree();
  checks.cells = cellsAgree();
  slide('wipe', 0.2);
  checks.wipe = changes(() => slide('wipe', 0.8)) && state.wipe === 0.8;
  checks.divider = changes(() => dragDivider()) && state.wipe < 0.3;
  checks.exposure = changes(() => slide('exposure', page.exposure + 2));
  checks.exposure_back = changes(() => slide('exposure', page.exposure));
  setMode('blink');
  checks.blink = changes(blink) && changes(blink);
  setMode('side');
  checks.side = changes(() => setPair(0, page.pictures.length - 1) || setPair(1, 0));
  checks.zoom = wheelAndPoint();
  setMode('wipe');
  checks.no_errors = errors.length === 0;
  const passed = Object.values(checks).every(Boolean);
  const result = document.createElement('pre');
  result.id = 'selftest';
  result.textContent = JSON.stringify({ passed, checks, errors });
  document.body.append(result);
}

if (new URLSearchParams(location.search).has('selftest')) {
  selftest().catch((error) => {
    const result = document.createElement('pre');
    result.id = 'selftest';
    result.textContent = JSON.stringify({ passed: false, errors: [...errors, String(error)] });
    document.body.append(result);
  });
}
