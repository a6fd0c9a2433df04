// The table over all scenes.
'use strict';
(function(R) {
const endOf = (result) => result?.at_end?.[R.state.metric];

// One cell a scene, then the mean over them.
function cells(technique, index) {
  const ofScenes = R.scenes().map((scene) => {
    const ends = (scene.techniques ?? []).map((t) => endOf(t)?.mean).filter(R.known);
    return R.errorCell(endOf(R.result(index, scene)), Math.min(...ends));
  });
  const mean = R.data.suite?.[R.state.metric]?.[technique.name];
  return [...ofScenes, R.interval(mean && {...mean, value: mean.geometric_mean}, R.times)];
}

// Null for a single scene.
R.suiteTable = function() {
  const scenes = R.scenes(), name = R.metric().name ?? R.state.metric;
  if (scenes.length < 2) return null;
  const rows = R.techniques().map((t, index) => ({index, name: t.name, cells: cells(t, index)}));
  const columns = [
    {title: 'technique'},
    ...scenes.map((s) => ({title: s.name})),
    {title: 'speed-up, geometric mean'},
  ];
  return R.table(
      `All scenes: ${name} at the end`, columns, rows,
      `Speed-up: ${R.techniques()[0]?.name}’s error / this one’s after the same time. ` +
          'Lowest error of a scene in bold.');
};
})(window.pssmltReport);
