// Keys, their documentation (one table for both), and the theme.
'use strict';
(function(R) {
const step = (key, by, low, high) =>
    R.set({[key]: Math.max(low, Math.min(high, R.state[key] + by))});
const time = (by) =>
    R.set({snapshot: Math.max(0, Math.min(R.snapshotTimes().length - 1, R.snapshotIndex() + by))});
const cycle = (key, values) =>
    R.set({[key]: values[(values.indexOf(R.state[key]) + 1) % values.length]});
const show = (side, n) => {
  if (n <= R.shownCount()) R.set({[side]: n});
};

// [keys, what they do, how they are written]
const keys = [
  [
    '1 2 3 4 5 6 7 8 9', 'show that technique (left side, A)', (e) => show('a', Number(e.key)),
    '1 … 9'
  ],
  ['0', 'show the reference (left side, A)', () => show('a', 0)],
  [
    'Digit', 'the same for the right side (B)', (e) => show('b', Number(e.code.slice(5))),
    'Shift 0 … 9'
  ],
  [' ', 'swap A and B', () => R.swap(), 'Space'],
  ['m', 'slider, flip, all', () => cycle('mode', ['slider', 'flip', 'grid'])],
  [
    's', 'picture, signed, absolute, relative error',
    () => cycle('show', ['picture', 'signed', 'absolute', 'relative'])
  ],
  ['[ ,', 'earlier snapshot', () => time(-1), '[ or ,'],
  ['] .', 'later snapshot', () => time(1), '] or .'],
  ['i', 'insets outlined or not', () => R.set({frames: !R.state.frames})],
  ['e', 'brighter', () => step('exposure', 0.5, -12, 12)],
  ['d', 'darker', () => step('exposure', -0.5, -12, 12)],
  ['+ =', 'zoom in', () => R.zoom(2), '+'],
  ['- _', 'zoom out', () => R.zoom(0.5), '−'],
  [
    'r', 'whole picture, no exposure',
    () => {
      R.set({exposure: 0});
      R.setView(1, 0.5, 0.5);
    }
  ],
  ['t', 'light or dark page', () => R.toggleTheme()],
  ['?', 'this list', () => R.byId('help').showModal()],
];
const others = [
  [
    'Arrow keys',
    'in the picture: move by an eighth of the view (with Shift by one ' +
        'pixel; the values are those of the middle); in the chart: read out its points'
  ],
  ['Drag', 'move the picture; at the slider’s line, move the line'],
  ['Wheel', 'zoom at the cursor, once the picture has been clicked (or with Ctrl)'],
  ['Two fingers, double click', 'zoom'],
  ['Legend', 'each button leaves a technique out of the charts or takes it in again'],
];

const handlers = new Map(
    keys.flatMap(([names, , f]) => (names === ' ' ? [' '] : names.split(' ')).map((k) => [k, f])));
document.addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey || event.defaultPrevented) return;
  const target = event.target;
  if (target.matches?.('select, textarea, input:not([type=range]):not([type=checkbox])') ||
      R.byId('help').open)
    return;
  if (event.key === ' ' && target.matches?.('button, summary, input, .scroll')) return;
  const name = event.shiftKey && /^Digit\d$/.test(event.code) && !handlers.has(event.key) ?
      'Digit' :
      event.key;
  const handler = handlers.get(name);
  if (!handler) return;
  event.preventDefault();
  handler(event);
});

const line = (written, what) => R.make(
    'tr', {}, R.make('th', {scope: 'row'}, R.make('kbd', {}, written)), R.make('td', {}, what));
R.byId('help-text')
    .append(R.make(
        'table', {},
        R.make(
            'tbody', {}, keys.map(([names, what, , written]) => line(written ?? names, what)),
            others.map(([w, what]) => line(w, what)))));
R.byId('help-open').addEventListener('click', () => R.byId('help').showModal());

// The theme: the system's until chosen; kept where the browser allows it.
const stored = () => {
  try {
    return localStorage.getItem('pssmlt-theme');
  } catch {
    return null;
  }
};
const store = (theme) => {
  try {
    localStorage.setItem('pssmlt-theme', theme);
  } catch { /* not kept */
  }
};
const system = matchMedia('(prefers-color-scheme: dark)');
R.applyTheme = function() {
  const theme = stored() ?? (system.matches ? 'dark' : 'light');
  document.documentElement.dataset.theme = theme;
  R.byId('theme').setAttribute('aria-pressed', String(theme === 'dark'));
  R.set({theme});
};
R.toggleTheme = function() {
  store(R.state.theme === 'dark' ? 'light' : 'dark');
  if (!stored())
    document.documentElement.dataset.theme = R.state.theme === 'dark' ? 'light' : 'dark';
  const theme = stored() ?? document.documentElement.dataset.theme;
  document.documentElement.dataset.theme = theme;
  R.byId('theme').setAttribute('aria-pressed', String(theme === 'dark'));
  R.set({theme});
};
system.addEventListener('change', R.applyTheme);
R.byId('theme').addEventListener('click', R.toggleTheme);
})(window.pssmltReport);
