// Error against time, log-log: one large chart of the chosen scene and a small one a scene.
'use strict';
(function(R) {
const known = R.known;
const transparent = (colour, alpha) =>
    colour + Math.round(alpha * 255).toString(16).padStart(2, '0');

// [{x, y, low, high, near}] of a technique; what cannot be drawn on a logarithmic axis is left out.
R.curvePoints = function(result, metric) {
  const curve = result.curve ?? {}, m = curve[metric] ?? {};
  return (curve.seconds ?? [])
      .map((x, i) => ({
             x,
             y: m.mean?.[i],
             low: m.low?.[i],
             high: m.high?.[i],
             near: m.near_floor?.[i] === true
           }))
      .filter((p) => known(p.x) && p.x > 0 && known(p.y) && p.y > 0);
};

// Those of a run that goes on and is not part of the curves yet.
R.runningPoints = (result, metric) =>
    (result.running ?? [])
        .map((p) => ({x: p.seconds, y: p.metrics?.[metric]}))
        .filter((p) => known(p.x) && p.x > 0 && known(p.y) && p.y > 0);

// The line of the fitted slope through the centre of the points that entered the fit.
function fitted(points, slope) {
  const used = points.filter((p) => !p.near);
  if (!known(slope?.value) || used.length < 2) return [];
  const mean = (f) => used.reduce((sum, p) => sum + Math.log(f(p)), 0) / used.length;
  const lx = mean((p) => p.x), ly = mean((p) => p.y);
  return [used[0], used[used.length - 1]].map(
      ({x}) => ({x, y: Math.exp(ly + slope.value * (Math.log(x) - lx))}));
}

function setsOf(index, result, metric, floorOfAxis, small) {
  const look = R.look(index), points = R.curvePoints(result, metric);
  const line = {borderColor: look.colour, pointRadius: 0, pointHitRadius: 0, order: 2};
  const banded = R.state.bands ? points.filter((p) => known(p.low) && known(p.high)) : [];
  const sets = [
    {
      ...line,
      kind: 'low',
      borderWidth: 0,
      data: banded.map((p) => ({x: p.x, y: Math.max(p.low, floorOfAxis)}))
    },
    {
      ...line,
      kind: 'high',
      borderWidth: 0,
      data: banded.map((p) => ({x: p.x, y: Math.max(p.high, floorOfAxis)})),
      fill: '-1',
      backgroundColor: transparent(look.colour, 0.17)
    },
    {
      kind: 'mean',
      label: result.name,
      technique: index,
      data: points,
      order: 1,
      borderColor: look.colour,
      borderWidth: R.textSize() * (small ? 0.09 : 0.13),
      borderDash: look.dash.map((d) => d * R.textSize() / 16),
      pointStyle: look.marker,
      pointRadius: small ? 2.5 : R.textSize() * 0.3,
      pointHoverRadius: R.textSize() * 0.45,
      pointBorderWidth: 1.6,
      pointHitRadius: 12,
      pointBorderColor: look.colour,
      pointBackgroundColor: points.map((p) => (p.near ? R.css('--page') : look.colour))
    },
  ];
  const slope = R.state.fits ? fitted(points, result.slope?.[metric]) : [];
  if (slope.length)
    sets.push({...line, kind: 'fit', data: slope, borderWidth: 1.2, borderDash: [2, 2]});
  const running = R.runningPoints(result, metric);
  if (running.length)
    sets.push({...line, kind: 'running', data: running, borderWidth: 1, pointRadius: 1.5});
  return sets;
}

// Squared errors fall as 1/t, their roots (of which smape and flip are kin) need not.
const squared = (metric) => /mse/.test(metric);
function guideOf(all, metric) {
  const points = all.flat();
  if (!R.state.guide || !squared(metric) || points.length < 2) return [];
  const xs = points.map((p) => p.x), x0 = Math.min(...xs), x1 = Math.max(...xs);
  const y0 = Math.max(...points.filter((p) => p.x < x0 * 1.3).map((p) => p.y));
  return [{x: x0, y: y0}, {x: x1, y: y0 * x0 / x1}];
}

R.curveSets = function(scene, metric, small) {
  const shown = R.results(scene).filter(([, t]) => !R.state.hidden.has(t.name));
  const all = shown.map(([, t]) => R.curvePoints(t, metric));
  const points = all.concat(shown.map(([, t]) => R.runningPoints(t, metric))).flat();
  const floor = scene.reference?.floor?.[metric];
  const x = R.around(points.map((p) => p.x));
  const bands = R.state.bands ? all.flat().flatMap((p) => [p.low, p.high]) : [];
  const y = R.around(points.map((p) => p.y).concat(bands, floor > 0 ? [floor] : []));
  const sets = shown.flatMap(([index, t]) => setsOf(index, t, metric, y[0], small));
  const grey = {
    borderColor: R.css('--faint'),
    pointRadius: 0,
    pointHitRadius: 0,
    order: 3,
    borderWidth: 1.4
  };
  if (floor > 0)
    sets.push({...grey, kind: 'floor', borderDash: [1, 3], data: x.map((v) => ({x: v, y: floor}))});
  const guide = guideOf(all, metric);
  if (guide.length) sets.push({...grey, kind: 'guide', borderWidth: 1, data: guide});
  return {sets, x, y};
};

const describe = (set, p) =>
    `${set.label}: ${R.interval({mean: p.y, low: p.low, high: p.high})} after ` + R.seconds(p.x) +
    (p.near ? ' (near the reference’s own error)' : '');
const tooltip = {
  filter: (item) => item.dataset.kind === 'mean',
  callbacks: {title: () => '', label: (item) => describe(item.dataset, item.raw)},
};

// `canvas` shows the curves of `scene`.
R.drawCurves = function(canvas, scene, small) {
  const metric = R.state.metric, {sets, x, y} = R.curveSets(scene, metric, small);
  const name = R.metric().name ?? metric;
  canvas.setAttribute(
      'aria-label',
      `Chart of ${name} against time, both logarithmic, scene ${scene.name ?? R.unknown}` +
          (small ? '' : '. Arrow keys read out its points.'));
  return R.draw(canvas, {
    type: 'line',
    data: {datasets: sets},
    options: R.chartOptions(
        R.logAxis(small ? '' : 'wall time', x, 'time', small),
        R.logAxis(small ? '' : name, y, 'error', small), tooltip)
  });
};

// Arrow keys walk over the points of the large chart.
const canvas = R.byId('chart'), at = {
  set: 0,
  point: -1
};
canvas.addEventListener('keydown', (event) => {
  const chart = R.chartOf(canvas);
  const sets = chart ? chart.data.datasets.map((d, i) => [d, i])
                           .filter(([d]) => d.kind === 'mean' && d.data.length) :
                       [];
  const step = {ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowDown: [1, 0], ArrowUp: [
                  -1, 0
                ]}[event.key];
  if (!step || !sets.length) return;
  event.preventDefault();
  event.stopPropagation();
  at.set = (at.set + step[0] + sets.length) % sets.length;
  const [set, index] = sets[at.set];
  at.point = Math.max(0, Math.min(set.data.length - 1, at.point + step[1]));
  const {x, y} = chart.getDatasetMeta(index).data[at.point];
  chart.setActiveElements([{datasetIndex: index, index: at.point}]);
  chart.tooltip.setActiveElements([{datasetIndex: index, index: at.point}], {x, y});
  chart.update();
  R.byId('chart-spoken').textContent = describe(set, set.data[at.point]);
});
})(window.pssmltReport);
