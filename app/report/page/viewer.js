// The viewer: its panes by mode (slider, flip, all), put together and kept up to date.
'use strict';
(function(R) {
let main, grid = [];  // canvases; of the grid with their n
R.mainPane = () => (R.state.mode === 'grid' ? grid[0]?.canvas : main);
// What is seen now.
R.panesShown = function() {
  const {mode, a, b} = R.state;
  if (mode === 'grid') return [...Array(R.shownCount() + 1).keys()];
  return mode === 'slider' ? [a, b] : [a];
};

function build() {
  const controls = R.makeControls();
  main =
      R.make('canvas', {id: 'view', tabindex: 0, role: 'img', 'aria-describedby': 'readout marks'});
  R.listenToPointer(main, true);
  R.byId('viewer').replaceChildren(
      controls.above, R.make('div', {id: 'stage'}, main), R.make('div', {id: 'grid', hidden: true}),
      R.make('div', {id: 'scale', class: 'scale', hidden: true}), controls.below,
      R.make('p', {id: 'marks', class: 'note', role: 'status'}), R.make('div', {
        id: 'readout',
        class: 'scroll',
        tabindex: 0,
        role: 'region',
        'aria-label': 'Values under the cursor'
      }));
}

function buildGrid() {
  if (grid.length === R.shownCount() + 1) {
    for (const {n, canvas} of grid) {
      canvas.setAttribute('aria-label', `Picture of ${R.shownName(n)}`);
    }
    return;
  }
  const order = [...Array(R.shownCount()).keys()].map((i) => i + 1).concat(0);
  grid = order.map((n) => {
    const canvas = R.make(
        'canvas',
        {tabindex: 0, role: 'img', 'data-shown': n, 'aria-label': `Picture of ${R.shownName(n)}`});
    R.listenToPointer(canvas, false);
    return {n, canvas};
  });
  R.byId('grid').replaceChildren(...grid.map((g) => g.canvas));
  R.byId('grid').style.setProperty('--across', grid.length === 4 ? 2 : Math.min(3, grid.length));
}

function shape() {
  const {width, height} = R.scene(), image = R.viewedImage();
  const aspect = `${width || image?.width || 16} / ${height || image?.height || 9}`;
  for (const canvas of [main, ...grid.map((g) => g.canvas)]) canvas.style.aspectRatio = aspect;
}

function draw() {
  const {mode, a, b, split} = R.state;
  R.byId('stage').hidden = mode === 'grid';
  R.byId('grid').hidden = mode !== 'grid';
  shape();
  if (mode === 'grid')
    for (const g of grid) R.drawPane(g.canvas, [{n: g.n, from: 0, to: 1}]);
  else if (mode === 'slider')
    R.drawPane(main, [{n: a, from: 0, to: split}, {n: b, from: split, to: 1}]);
  else
    R.drawPane(main, [{n: a, from: 0, to: 1}]);
  const names = R.panesShown().map(R.shownName).join(' beside ');
  main.setAttribute(
      'aria-label', `Picture: ${names}, ${R.state.show}. Arrow keys move, plus and minus zoom.`);
  R.updateReadout();
  R.updateMarks();
  R.drawInsets();
}
R.redraw = R.eachFrame(() => {
  if (R.viewerOn) draw();
});

function choose() {
  const count = R.shownCount(), has = (n) => n >= 0 && n <= count;
  const reference = Boolean(R.scene().reference?.image);
  const patch = {};
  // Nothing to stand beside it.
  if (count === 1 && !reference && R.state.b < 0) patch.mode = 'flip';
  if (!has(R.state.a)) patch.a = Math.min(1, count);
  if (!has(R.state.b) || (R.state.b === 0 && !reference && count > 1))
    patch.b = count > 1 ? count : 0;
  R.set(patch);
}

// Pictures are loaded once the page stands; the snapshots of what is seen follow when it is idle.
const idle = window.requestIdleCallback ?? ((f) => setTimeout(f, 200));
let round = 0;
async function prefetch() {
  const mine = ++round;
  const last = R.snapshotTimes().length - 1;
  for (let back = 0; back <= last; ++back) {
    for (const n of R.panesShown()) {
      await new Promise((resolve) => idle(resolve));
      if (mine !== round) return;
      const entry = R.snapshot(n, last - back);
      if (entry) await R.loadImage(entry.image).catch(() => {});
    }
  }
}

R.startViewer = function() {
  R.viewerOn = true;
  R.redraw();
  R.placeInsets();
  prefetch();
};
build();
R.on('data scene', () => {
  R.fillChoices();
  choose();
  buildGrid();
  if (R.viewerOn) R.startViewer();
});
R.on('data scene a b mode show snapshot exposure split view frames images', () => {
  R.updateControls();
  R.redraw();
});
R.on('show exposure data', R.updateScale);
R.on('cursor insets theme', R.redraw);
R.on('a b', () => {
  if (R.viewerOn) prefetch();
});
new ResizeObserver(() => R.redraw()).observe(R.byId('viewer'));
})(window.pssmltReport);
