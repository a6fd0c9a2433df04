// Follows a render: one event source for numbers, one request at a time for pictures, so that a
// slow browser leaves pictures out instead of falling behind.
'use strict';

const at = (id) => document.getElementById(id);
const view = {
  token: '',
  width: 0,
  height: 0,
  exponent: 0,
  halves: null,  // Uint16Array, R G B of every pixel
  pixels: null,  // ImageData of the picture
  version: 0,    // of the picture that is shown
  wanted: 0,     // of the newest one
  loading: false,
  final: false,
  exposure: 0,                   // in stops
  bytes: new Uint8Array(65536),  // half float -> what the display gets
  cross: null,
  errors: [],  // [seconds, relMSE]
};

// --- numbers ---------------------------------------------------------------------------------

function duration(s) {
  if (s === null || s === undefined) return 'unknown';
  if (s > 3.6e6) return 'more than 1000 h';
  if (s < 60) return s.toFixed(1) + ' s';
  const whole = Math.round(s), two = (n) => String(n).padStart(2, '0');
  if (whole < 3600) return Math.floor(whole / 60) + ' m ' + two(whole % 60) + ' s';
  return Math.floor(whole / 3600) + ' h ' + two(Math.floor(whole / 60) % 60) + ' m';
}

function count(n) {
  for (const [size, prefix] of [[1e12, 'T'], [1e9, 'G'], [1e6, 'M'], [1e3, 'k']]) {
    if (n >= size) return (n / size).toPrecision(3) + ' ' + prefix;
  }
  return String(Math.round(n));
}

const number = (v) => Number.isInteger(v) ? String(v) : v.toPrecision(4);

function fill(list, rows) {
  list.replaceChildren(...rows.flatMap(([name, value]) => {
    const term = document.createElement('dt'), text = document.createElement('dd');
    term.textContent = name;
    text.textContent = value;
    return [term, text];
  }));
}

// The numbers of a sampler's report as rows "name, value"; parts of parts get both names.
function rows_of(report, prefix = '') {
  return Object.entries(report || {}).flatMap(([name, value]) => {
    const label = prefix + name.replaceAll('_', ' ');
    if (typeof value === 'number') return [[label, number(value)]];
    if (value && value.rate !== undefined) {
      const of = `${(100 * value.rate).toFixed(1)} % of ${count(value.mutations || 0)}`;
      return [[label, of]];
    }
    if (value && typeof value === 'object' && !Array.isArray(value))
      return rows_of(value, label + ', ');
    return typeof value === 'string' ? [[label, value]] : [];
  });
}

function show_layers(layers) {
  at('layers').replaceChildren(...(layers || []).flatMap((layer) => {
    const head = document.createElement('h2'), table = document.createElement('table');
    head.textContent = `${layer.sampler} × ${layer.integrator}`;
    const rows = [
      ['samples per pixel', number(layer.samples_per_pixel)], ['rounds', String(layer.rounds)],
      ...rows_of(layer.report)
    ];
    for (const [name, value] of rows) {
      const row = table.insertRow(), cell = document.createElement('th');
      cell.scope = 'row';
      cell.textContent = name;
      row.append(cell);
      row.insertCell().textContent = value;
    }
    return [head, table];
  }));
}

function show_error(error, seconds) {
  if (!error || !error.known) {
    at('error').textContent = 'not known yet' + (error && error.why ? ': ' + error.why : '');
    return;
  }
  const p = (v) => v.toPrecision(3);
  at('error').textContent =
      `relMSE ${p(error.relmse)}, 95 % interval ${p(error.low)} to ${p(error.high)}`;
  const last = view.errors.at(-1);
  if (!last || last[1] !== error.relmse) {
    view.errors.push([Math.max(seconds, 1e-3), Math.max(error.relmse, 1e-30)]);
    // Half of them, every second one, are enough when there are many.
    if (view.errors.length > 400) view.errors = view.errors.filter((_, i) => i % 2 === 0);
    draw_curve();
  }
}

function draw_curve() {
  const canvas = at('curve'), pen = canvas.getContext('2d');
  const logs = view.errors.map(([s, e]) => [Math.log10(s), Math.log10(e)]);
  const range = (k) => [Math.min(...logs.map((p) => p[k])), Math.max(...logs.map((p) => p[k]))];
  const [x0, x1] = range(0), [y0, y1] = range(1);
  const place = ([x, y]) =>
      [8 + (canvas.width - 16) * (x - x0) / (x1 - x0 || 1),
       canvas.height - 8 - (canvas.height - 16) * (y - y0) / (y1 - y0 || 1)];
  pen.clearRect(0, 0, canvas.width, canvas.height);
  pen.strokeStyle = pen.fillStyle = getComputedStyle(canvas).color;
  pen.lineWidth = 2;
  pen.beginPath();
  for (const p of logs) pen.lineTo(...place(p));
  pen.stroke();
  const [x, y] = place(logs.at(-1));
  pen.fillRect(x - 3, y - 3, 6, 6);
}

const state_text = {
  loading: 'loading the scene',
  preparing: 'preparing',
  bootstrap: 'bootstrap',
  rendering: 'rendering',
  writing: 'writing',
};

function end_text(s) {
  const done = s.stopped_by === 'interrupted' ? 'stopped' : 'finished';
  const files = (s.outputs || []).join(', ');
  return files ? `${done}; wrote ${files}` : done;
}

function show_status(s) {
  at('scene').textContent = s.scene;
  at('state').textContent = s.final ? end_text(s) : state_text[s.state] || s.state;
  document.title = `${Math.round(100 * (s.fraction || 0))} % ${s.scene}`;
  at('fraction').value = s.final ? 1 : s.fraction || 0;
  at('stop').disabled = s.final || s.state === 'writing' || !view.token;
  const what = s.chains ? 'mutations' : 'samples';
  if (s.elapsed !== undefined) {
    fill(at('numbers'), [
      ['elapsed', duration(s.elapsed)], ['remaining', duration(s.remaining)],
      [what, count(s.samples)], [what + ' per second', count(s.samples_per_second || 0)],
      ['picture shows', s.image ? duration(s.image.seconds) : 'nothing yet']
    ]);
  }
  show_error(s.error, s.elapsed);
  show_layers(s.layers);
  view.final = s.final;
  end_if_done();
}

// --- picture ---------------------------------------------------------------------------------

function half_to_number(h) {
  const sign = h & 0x8000 ? -1 : 1, exponent = h >> 10 & 31, mantissa = h & 1023;
  if (exponent === 31) return mantissa ? NaN : sign * Infinity;
  return sign * (exponent ? (mantissa + 1024) * 2 ** (exponent - 25) : mantissa * 2 ** -24);
}

// What the display gets for each of the 65536 half floats: exposure, then the sRGB curve.
function tabulate() {
  const factor = 2 ** (view.exposure - view.exponent);
  for (let h = 0; h < 65536; ++h) {
    const v = half_to_number(h) * factor;
    const code = v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
    view.bytes[h] = Number.isNaN(v) ? 255 : Math.round(255 * Math.min(Math.max(code, 0), 1));
  }
}

function paint() {
  if (!view.halves) return;
  tabulate();
  const out = view.pixels.data, from = view.halves, table = view.bytes;
  for (let i = 0, o = 0; i < from.length; i += 3, o += 4) {
    out[o] = table[from[i]];
    out[o + 1] = table[from[i + 1]];
    out[o + 2] = table[from[i + 2]];
  }
  at('picture').getContext('2d').putImageData(view.pixels, 0, 0);
  show_pixel();
}

function take_picture(buffer) {
  const head = new DataView(buffer);
  const magic = String.fromCharCode(...new Uint8Array(buffer, 0, 4));
  if (magic !== 'PSH1') throw new Error('not a picture: ' + magic);
  const width = head.getInt32(4, true), height = head.getInt32(8, true);
  if (width !== view.width || height !== view.height) {
    view.width = at('picture').width = width;
    view.height = at('picture').height = height;
    view.pixels = new ImageData(width, height);
    view.pixels.data.fill(255);
  }
  view.exponent = head.getInt32(12, true);
  view.halves = new Uint16Array(buffer, 16);
  paint();
}

async function load_picture() {
  if (view.loading) return;
  view.loading = true;
  try {
    while (view.version < view.wanted) {
      const reply = await fetch(`image/picture?after=${view.version}`);
      if (reply.status !== 200) break;
      const version = Number(reply.headers.get('Pssmlt-Version'));
      take_picture(await reply.arrayBuffer());
      view.version = version;
    }
  } catch (error) {
    at('pixel').textContent = String(error);
  }
  view.loading = false;
  end_if_done();
}

function show_pixel() {
  if (!view.cross || !view.halves) {
    if (view.halves) at('pixel').textContent = `${view.width} × ${view.height}`;
    return;
  }
  const {x, y} = view.cross, i = 3 * (y * view.width + x), factor = 2 ** -view.exponent;
  const values = [0, 1, 2].map((c) => (half_to_number(view.halves[i + c]) * factor).toPrecision(4));
  at('pixel').textContent = `${x}, ${y}:  R ${values[0]}  G ${values[1]}  B ${values[2]}`;
  const scale = at('picture').clientWidth / view.width;
  at('cross').style.left = `${(x + 0.5) * scale}px`;
  at('cross').style.top = `${(y + 0.5) * scale}px`;
  at('cross').hidden = false;
}

function move_cross(x, y) {
  if (!view.halves) return;
  view.cross = {
    x: Math.min(Math.max(x, 0), view.width - 1),
    y: Math.min(Math.max(y, 0), view.height - 1)
  };
  show_pixel();
}

// --- controls --------------------------------------------------------------------------------

function set_exposure(stops) {
  view.exposure = Math.min(Math.max(stops, -10), 10);
  at('exposure').value = view.exposure;
  at('stops').textContent = view.exposure.toFixed(1);
  paint();
}

function toggle_zoom() {
  const actual = at('frame').classList.toggle('actual');
  at('zoom').setAttribute('aria-pressed', actual);
  show_pixel();
}

function toggle_theme() {
  const root = document.documentElement;
  const dark = root.dataset.theme ? root.dataset.theme === 'dark' :
                                    matchMedia('(prefers-color-scheme: dark)').matches;
  root.dataset.theme = dark ? 'light' : 'dark';
  if (view.errors.length) draw_curve();
}

async function stop_run() {
  at('confirm').close();
  at('stop').disabled = true;
  const reply = await fetch('stop', {method: 'POST', headers: {'Pssmlt-Token': view.token}});
  if (!reply.ok) at('state').textContent = 'not stopped: ' + await reply.text();
}

function ask_to_stop() {
  if (!at('stop').disabled && !at('confirm').open) at('confirm').showModal();
}

const keys = {
  e: () => set_exposure(view.exposure + 0.5),
  d: () => set_exposure(view.exposure - 0.5),
  0: () => set_exposure(0),
  z: toggle_zoom,
  t: toggle_theme,
  s: ask_to_stop,
};
const arrows = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1]
};

document.addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || at('confirm').open) return;
  const action = keys[event.key.toLowerCase()];
  if (action) action();
});
at('picture').addEventListener('keydown', (event) => {
  const step = arrows[event.key];
  if (!step) return;
  event.preventDefault();
  const from = view.cross || {x: view.width >> 1, y: view.height >> 1},
        by = event.shiftKey ? 10 : 1;
  move_cross(from.x + by * step[0], from.y + by * step[1]);
});
at('picture').addEventListener('pointermove', (event) => {
  const scale = view.width / at('picture').clientWidth;
  move_cross(Math.floor(event.offsetX * scale), Math.floor(event.offsetY * scale));
});
at('exposure').addEventListener('input', (event) => set_exposure(Number(event.target.value)));
at('zoom').addEventListener('click', toggle_zoom);
at('theme').addEventListener('click', toggle_theme);
at('stop').addEventListener('click', ask_to_stop);
at('yes').addEventListener('click', stop_run);
at('no').addEventListener('click', () => at('confirm').close());
addEventListener('resize', show_pixel);

// --- events ----------------------------------------------------------------------------------

const source = new EventSource('events');

// The run is over and the last picture is here: the program may end.
function end_if_done() {
  if (view.final && !view.loading && view.version >= view.wanted) source.close();
}

source.addEventListener('hello', (event) => {
  const {token} = JSON.parse(event.data);
  if (token !== view.token) view.version = view.wanted = 0;  // another run at the same port
  view.token = token;
});
source.addEventListener('status', (event) => show_status(JSON.parse(event.data)));
source.addEventListener('image', (event) => {
  view.wanted = Math.max(view.wanted, JSON.parse(event.data).version);
  load_picture();
});
source.addEventListener('error', () => {
  at('state').textContent = 'the connection is lost; trying again';
  at('stop').disabled = true;
});
