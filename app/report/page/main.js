// Starts the page: first all that is text and charts, then, when that has been painted, the
// pictures.
'use strict';
(function(R) {
R.update = function(data) {
  R.data = data ?? {};
  const patch = {data: R.state.data + 1};
  if (R.state.scene >= R.scenes().length) patch.scene = 0;
  if (!R.metrics().some((m) => m.id === R.state.metric)) {
    patch.metric = (R.metrics().find((m) => m.id === 'relmse') ?? R.metrics()[0])?.id ?? '';
  }
  R.set(patch);
};

R.applyTheme();
let data = {};
try {
  data = JSON.parse(R.byId('data').textContent);
} catch (error) {
  R.broken = error.message;
}
R.update(data);
// Two frames later the first one has been shown.
requestAnimationFrame(() => requestAnimationFrame(() => R.startViewer()));

// Fonts and lines grow with the window's width.
let size = R.textSize();
addEventListener('resize', () => {
  if (R.textSize() === size) return;
  size = R.textSize();
  R.set({theme: R.state.theme + ' '});
});
})(window.pssmltReport);
