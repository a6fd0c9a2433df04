// Tables: a caption, columns that say what they mean, rows named by their first cell. Wide ones
// scroll in a box of their own.
'use strict';
(function(R) {
// columns: [{title, note}]; rows: [{name, index (of a technique, for its swatch), cells}]. A cell
// is a text or {text, strong, faint, note}.
R.table = function(caption, columns, rows, note) {
  const cellOf = (cell) => {
    const c =
        typeof cell === 'object' && cell !== null && !(cell instanceof Node) ? cell : {text: cell};
    const faint = c.faint || c.text === R.unknown || c.text === 'not reached';
    return R.make(
        'td', {
          class: [c.strong && 'strong', faint && 'faint'].filter(Boolean).join(' ') || null,
          title: c.note
        },
        c.text);
  };
  const head =
      R.make('tr', {}, columns.map((c) => R.make('th', {scope: 'col', title: c.note}, c.title)));
  const body = rows.map(
      (row) => R.make(
          'tr', {},
          R.make('th', {scope: 'row'}, row.index >= 0 ? R.swatch(row.index) : null, row.name),
          row.cells.map(cellOf)));
  const table = R.make(
      'table', {}, R.make('caption', {}, caption), R.make('thead', {}, head),
      R.make('tbody', {}, body));
  return R.make(
      'div', {class: 'table'},
      R.make('div', {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': caption}, table),
      note ? R.make('p', {class: 'note'}, note) : null);
};

// Names and values, one below the other.
R.pairs = (pairs) => R.make(
    'dl', {},
    pairs.filter(Boolean).flatMap(
        ([name, value]) => [R.make('dt', {}, name), R.make('dd', {}, value)]));

// A technique's line, dash and marker.
R.swatch = function(index) {
  const look = R.look(index);
  const line = R.svg('line', {
    x1: 1,
    y1: 7,
    x2: 35,
    y2: 7,
    stroke: 'currentColor',
    'stroke-width': 2,
    'stroke-dasharray': look.dash.map((d) => d * 0.8).join(' ')
  });
  const shapes = {
    circle: ['circle', {cx: 18, cy: 7, r: 4}],
    rect: ['rect', {x: 14, y: 3, width: 8, height: 8}],
    rectRounded: ['rect', {x: 14, y: 3, width: 8, height: 8, rx: 2.5}],
    triangle: ['path', {d: 'M18 2 L22.5 10.5 L13.5 10.5 Z'}],
    rectRot: ['path', {d: 'M18 2 L23 7 L18 12 L13 7 Z'}],
    cross: ['path', {d: 'M18 2 V12 M13 7 H23', stroke: 'currentColor', 'stroke-width': 2}],
    crossRot: ['path', {d: 'M14 3 L22 11 M22 3 L14 11', stroke: 'currentColor', 'stroke-width': 2}],
    star: [
      'path', {
        d: 'M14 3 L22 11 M22 3 L14 11 M18 1 V13 M12 7 H24',
        stroke: 'currentColor',
        'stroke-width': 2
      }
    ],
  };
  const [tag, attributes] = shapes[look.marker];
  const svg = R.svg(
      'svg', {class: `swatch t${index % 8 + 1}`, viewBox: '0 0 36 14', 'aria-hidden': 'true'}, line,
      R.svg(tag, {...attributes, fill: 'currentColor'}));
  return svg;
};
})(window.pssmltReport);
