// Insets: crops where the techniques' errors differ most, linked to time, exposure and what is
// shown.
'use strict';
(function(R) {
const count = 3;
R.insetName = (i) => 'abc'[i];
let round = 0, placed = null, scene = null;
let cells = [];  // [{n, inset, canvas}]

// The mean over a block of |luminance - reference| / (reference + offset), each pixel at most 1, so
// that no single firefly decides.
function blockErrors(image, reference, size) {
  const across = Math.floor(image.width / size), down = Math.floor(image.height / size);
  const errors = new Float64Array(across * down);
  const l = R.luminances(image), r = R.luminances(reference), offset = R.relativeOffset(reference);
  for (let y = 0; y < down * size; ++y) {
    for (let x = 0; x < across * size; ++x) {
      const i = y * image.width + x, e = Math.abs(l[i] - r[i]) / (Math.abs(r[i]) + offset);
      errors[Math.floor(y / size) * across + Math.floor(x / size)] +=
          (e < 1 ? e : 1) / (size * size);
    }
  }
  return {errors, across};
}

// [{x, y, size, spread}]: squares of two by two blocks about those whose errors spread most, apart
// from each other.
R.findInsets = function(images, reference) {
  const block = Math.max(4, Math.round(Math.min(reference.width, reference.height) / 16));
  const all = images.filter((i) => i.width === reference.width && i.height === reference.height)
                  .map((i) => blockErrors(i, reference, block));
  if (!all.length) return [];
  const {across} = all[0], size = Math.min(3 * block, reference.width, reference.height);
  const candidates =
      [...all[0].errors.keys()]
          .map((k) => {
            const e = all.map((a) => a.errors[k]);
            // A single technique: where its own error is largest.
            return {k, spread: all.length > 1 ? Math.max(...e) - Math.min(...e) : e[0]};
          })
          .sort((p, q) => q.spread - p.spread);
  const chosen = [];
  for (const {k, spread} of candidates) {
    if (chosen.length === count || !(spread > 0)) break;
    const at = (c, limit) =>
        Math.max(0, Math.min(limit - size, Math.round((c + 0.5) * block - size / 2)));
    const x = at(k % across, reference.width), y = at(Math.floor(k / across), reference.height);
    if (chosen.every((c) => Math.abs(c.x - x) > 1.2 * size || Math.abs(c.y - y) > 1.2 * size))
      chosen.push({x, y, size, spread});
  }
  return chosen;
};

R.placeInsets = async function() {
  const mine = ++round, note = R.byId('insets-note');
  const entries = [...Array(R.shownCount() + 1).keys()].map((n) => R.lastSnapshot(n));
  // New data about the same pictures: only names may have changed.
  const pictures = [R.state.scene, ...entries.map((e) => e?.image)].join(' ');
  // Places of the scene's earlier pictures stay until there are better ones.
  if (scene !== R.state.scene) R.set({insets: []});
  scene = R.state.scene;
  build();
  if (pictures === placed) return;
  placed = null;
  if (!entries[0]) {
    note.textContent = 'Without a reference no places can be chosen.';
    return;
  }
  if (!R.state.insets.length) note.textContent = 'Looking for them …';
  const [reference, ...images] =
      await Promise.all(entries.map((e) => (e ? R.loadImage(e.image).catch(() => null) : null)));
  if (mine !== round) return;
  if (!reference) {
    note.textContent = 'The reference’s picture is missing.';
    return;
  }
  if (!images.some(Boolean)) {
    note.textContent = 'No technique has a picture yet.';
    return;
  }
  const insets = R.findInsets(images.filter(Boolean), reference);
  note.textContent = insets.length ? 'Chosen on the last snapshots by the spread of the relative ' +
          'error; they follow time, exposure and what is shown. Choose one to see it above.' :
                                     'The techniques do not differ anywhere.';
  placed = pictures;
  R.set({insets});
  build();
  R.redraw();
};

function goTo(n, inset) {
  const image = R.viewedImage();
  if (R.state.mode !== 'grid') R.set({a: n});
  if (!image) return;
  R.setView(
      0.5 * Math.min(image.width, image.height) / inset.size,
      (inset.x + inset.size / 2) / image.width, (inset.y + inset.size / 2) / image.height);
  R.byId('viewer').scrollIntoView({block: 'nearest'});
}

function build() {
  cells = [];
  const order = [...Array(R.shownCount()).keys()].map((i) => i + 1).concat(0);
  const head = R.make(
      'tr', {}, R.make('td'),
      order.map((n) => R.make('th', {scope: 'col'}, n ? R.swatch(n - 1) : null, R.shownName(n))));
  const rows = R.state.insets.map(
      (inset, i) =>
          R.make('tr', {}, R.make('th', {scope: 'row'}, R.insetName(i)), order.map((n) => {
            const canvas = R.make('canvas', {width: inset.size, height: inset.size});
            cells.push({n, inset, canvas});
            return R.make(
                'td', {},
                R.make(
                    'button', {
                      type: 'button',
                      class: 'inset',
                      onclick: () => goTo(n, inset),
                      'aria-label': `Inset ${R.insetName(i)} of ${R.shownName(n)}: show it above`
                    },
                    canvas));
          })));
  const box = R.byId('insets');
  box.replaceChildren(
      ...(rows.length ?
              [R.make(
                  'div', {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'Insets'},
                  R.make(
                      'table', {class: 'insets'}, R.make('thead', {}, head),
                      R.make('tbody', {}, rows)))] :
              []));
}

R.drawInsets = function() {
  const {show, exposure} = R.state;
  for (const {n, inset, canvas} of cells) {
    const {image} = R.shownImage(n);
    const reference = show === 'picture' ? null : R.shownImage(0).image;
    if (!image || inset.x + inset.size > image.width || inset.y + inset.size > image.height)
      continue;
    if (canvas.image === image && canvas.reference === reference &&
        canvas.shows === show + exposure)
      continue;
    Object.assign(canvas, {image, reference, shows: show + exposure});
    const data = new ImageData(inset.size, inset.size);
    R.paint(
        data, image, reference, {x: inset.x, y: inset.y, width: inset.size, height: inset.size},
        n === 0 ? 'picture' : show, exposure);
    canvas.getContext('2d').putImageData(data, 0, 0);
  }
};
})(window.pssmltReport);
