// Values under the cursor, the scale of the error maps, and what the encodings lost.
'use strict';
(function(R) {
const make = R.make;

function row(n, pixel) {
  const {image, entry} = R.shownImage(n);
  const cells = [];
  if (!image || pixel.x >= image.width || pixel.y >= image.height) {
    cells.push(R.unknown, '', '', '', '', '');
  } else {
    const i = pixel.y * image.width + pixel.x, reference = R.shownImage(0).image;
    for (let c = 0; c < 3; ++c)
      cells.push(
          R.number(image.values[image.codes[3 * i + c]], image.precision === 'exact' ? 4 : 2));
    const y = R.luminance(image, i);
    cells.push(R.number(y, 3));
    if (n > 0 && reference?.width === image.width && reference?.height === image.height) {
      const d = y - R.luminance(reference, i);
      cells.push(
          R.number(d, 2),
          R.number(
              Math.abs(d) / (Math.abs(R.luminance(reference, i)) + R.relativeOffset(reference)),
              2));
    } else
      cells.push('', '');
  }
  const about = image?.precision === 'logarithmic' ? `≈ ±${R.number(100 * image.error, 2)} %` : '';
  return make(
      'tr', {}, make('th', {scope: 'row'}, n > 0 ? R.swatch(n - 1) : null, R.shownName(n)),
      cells.map((c) => make('td', {}, Number.isNaN(c) ? 'NaN' : c)),
      make('td', {class: 'faint'}, entry ? about : ''));
}

R.updateReadout = function() {
  const {cursor} = R.state, box = R.byId('readout');
  const head = ['', 'R', 'G', 'B', 'luminance', 'error', 'relative', ''];
  const shown = [...R.panesShown()].sort((x, y) => (x || 99) - (y || 99));
  if (!shown.includes(0)) shown.push(0);
  const place = cursor ? `pixel ${cursor.x}, ${cursor.y}` : 'point at a pixel';
  box.replaceChildren(make(
      'table', {}, make('caption', {}, place),
      make('thead', {}, make('tr', {}, head.map((h) => make('th', {scope: 'col'}, h)))),
      make(
          'tbody', {},
          shown.map(
              (n) => (
                  cursor ?
                      row(n, cursor) :
                      make(
                          'tr', {},
                          make(
                              'th', {scope: 'row'}, n > 0 ? R.swatch(n - 1) : null, R.shownName(n)),
                          head.slice(1).map(() => make('td', {}, ' '))))))));
};

R.updateScale = function() {
  const {show, exposure} = R.state, box = R.byId('scale');
  box.hidden = show === 'picture';
  if (box.hidden) return;
  const top = 2 ** -exposure, colours = R.rampColours[show === 'signed' ? 'signed' : 'sequential'];
  const formula = {
    signed: 'luminance − reference’s',
    absolute: '|luminance − reference’s|',
    relative: '|luminance − reference’s| / (reference’s + 1 % of its mean)'
  }[show];
  const bar = make('span', {class: 'ramp'});
  bar.style.background = `linear-gradient(to right, ${colours.join(', ')})`;
  box.replaceChildren(
      make('span', {}, R.number(show === 'signed' ? -top : 0, 2)), bar,
      make('span', {}, R.number(top, 2)), make('span', {class: 'note'}, formula));
};

const counted = (n) => `${R.integer(n)} ${n === 1 ? 'value' : 'values'}`;
R.updateMarks = function() {
  const marks = [];
  for (const n of R.panesShown()) {
    const {image} = R.shownImage(n);
    if (!image) continue;
    const what = [];
    if (image.precision === 'logarithmic')
      what.push(`8-bit logarithmic snapshot, values ±${R.number(100 * image.error, 2)} %`);
    if (image.nonFinite) what.push(`${counted(image.nonFinite)} not finite (magenta)`);
    if (image.clamped) what.push(`${counted(image.clamped)} beyond the encoding’s range`);
    if (what.length) marks.push(`${R.shownName(n)}: ${what.join('; ')}.`);
  }
  const text = marks.join(' ');
  if (R.byId('marks').textContent !== text) R.byId('marks').textContent = text;
};
})(window.pssmltReport);
