// Questions to the data that several parts of the page ask. Everything may be missing.
'use strict';
(function(R) {
R.scenes = () => R.data.scenes ?? [];
R.scene = () => R.scenes()[R.state.scene] ?? {};
R.techniques = () => R.data.techniques ?? [];
R.metrics = () => R.data.metrics ?? [];
R.metric = () => R.metrics().find((m) => m.id === R.state.metric) ?? {};
R.budget = () => R.data.settings?.seconds;

// A scene's results in the order of the list of techniques; [index, result].
R.results = (scene = R.scene()) =>
    (scene.techniques ??
     []).map((result) => [R.techniques().findIndex((t) => t.name === result.name), result]);
R.result = (index, scene = R.scene()) =>
    (scene.techniques ?? []).find((t) => t.name === R.techniques()[index]?.name);

// Colour, dash and marker of the n-th technique: told apart without colour too.
const dashes = [[], [9, 5], [2, 4], [12, 4, 3, 4], [16, 5], [6, 3, 2, 3, 2, 3], [4, 4], [1, 3]];
const markers =
    ['circle', 'rect', 'triangle', 'rectRot', 'crossRot', 'star', 'rectRounded', 'cross'];
R.look = (index) => ({
  colour: R.css(`--t${index % 8 + 1}`),
  dash: dashes[(index + Math.floor(index / 8)) % 8],
  marker: markers[(index + Math.floor(index / 8)) % 8],
});

// What the viewer calls 0 is the reference, 1.. the techniques.
R.shownName = (n) => (n === 0 ? 'reference' : R.techniques()[n - 1]?.name ?? R.unknown);
R.shownCount = () => R.techniques().length;

const imagesOf = (n) => {
  const images = R.result(n - 1)?.images ?? [];
  return images.filter((i) => i && i.image).sort((x, y) => x.seconds - y.seconds);
};
// Of the technique with most pictures; the others' are taken where they are nearest.
R.snapshotTimes = function() {
  let longest = [];
  for (let n = 1; n <= R.shownCount(); ++n) {
    const times = imagesOf(n).map((i) => i.seconds);
    if (times.length > longest.length) longest = times;
  }
  return longest;
};
R.snapshotIndex = () => Math.max(0, Math.min(R.state.snapshot, R.snapshotTimes().length - 1));
// {image, seconds, precision} of what the viewer calls n, or null.
R.snapshot = function(n, index = R.snapshotIndex()) {
  if (n === 0) {
    const id = R.scene().reference?.image;
    return id ? {image: id, seconds: null, precision: 'exact'} : null;
  }
  const time = R.snapshotTimes()[index];
  let best = null;
  for (const image of imagesOf(n)) {
    if (!best ||
        Math.abs(Math.log(image.seconds / time)) < Math.abs(Math.log(best.seconds / time))) {
      best = image;
    }
  }
  return best;
};
R.lastSnapshot = (n) => R.snapshot(n, Math.max(0, R.snapshotTimes().length - 1));
})(window.pssmltReport);
