// The tables of the chosen scene, and over all scenes.
'use strict';
(function(R) {
const known = R.known;
const rowsOf = (cells) =>
    R.results().map(([index, t]) => ({index, name: t.name, cells: cells(t, index)}));
const lowest = (metric) =>
    Math.min(...R.results().map(([, t]) => t.at_end?.[metric]?.mean).filter(known));

function atEnd() {
  const metric = R.state.metric, best = lowest(metric);
  const rows = rowsOf((t) => {
    const end = t.at_end?.[metric], slope = t.slope?.[metric];
    return [
      {text: R.interval(end), strong: end?.mean === best},
      R.interval(t.speed_up?.[metric], R.times), R.number(t.efficiency?.[metric]),
      known(slope?.value) ?
          R.number(slope.value, 3) + (known(slope.error) ? ` ± ${R.number(slope.error, 2)}` : '') :
                                                           R.unknown,
      slope?.verdict ?? R.unknown
    ];
  });
  const columns = [
    {title: 'technique'},
    {title: 'error [95 %]'},
    {title: 'speed-up [95 %]', note: 'Error of the first technique over this one’s'},
    {title: 'efficiency', note: '1 / (error × time), in 1/s'},
    {title: 'slope', note: 'In the log-log chart; −1: independent samples'},
    {title: 'verdict'},
  ];
  return R.table(
      `${R.metric().name ?? metric} at the end`, columns, rows,
      'Speed-up: error of the first technique / error of this one after the same time. ' +
          'Efficiency: 1 / (error × time). Lowest error in bold.');
}

function timeTo() {
  const metric = R.state.metric;
  const targets = [
    ...new Set(R.results().flatMap(([, t]) => (t.time_to?.[metric] ?? []).map((e) => e.error)))
  ].filter(known).sort((x, y) => y - x);
  if (!targets.length) return null;
  const rows = rowsOf((t) => targets.map((target) => {
    const entry = (t.time_to?.[metric] ?? []).find((e) => e.error === target);
    if (!entry) return R.unknown;
    return known(entry.seconds) ?
        R.interval({mean: entry.seconds, low: entry.low, high: entry.high}, R.seconds) :
        'not reached';
  }));
  return R.table(
      `Time to reach an error (${R.metric().name ?? metric})`,
      [{title: 'technique'}, ...targets.map((e) => ({title: R.number(e)}))], rows,
      'Interpolated between snapshots, never extrapolated.');
}

function allMetrics() {
  const metrics = R.metrics();
  const rows = rowsOf(
      (t) => metrics
                 .map((m) => ({
                        text: R.interval(t.at_end?.[m.id]),
                        strong: t.at_end?.[m.id]?.mean === lowest(m.id)
                      }))
                 .concat(bias(t)));
  return R.table(
      'All metrics at the end',
      [
        {title: 'technique'}, ...metrics.map((m) => ({title: m.name ?? m.id, note: m.formula})), {
          title: 'bias of the mean',
          note: 'Mean luminance less the reference\'s, over the reference\'s'
        }
      ],
      rows);
}
// Mean over the runs; its standard error from the runs where there are several.
function bias(t) {
  const last =
      (t.runs ?? []).map((r) => r.points?.[r.points.length - 1]).filter((p) => known(p?.mean_bias));
  if (!last.length) return R.unknown;
  const mean = last.reduce((s, p) => s + p.mean_bias, 0) / last.length;
  const spread = Math.sqrt(
      last.reduce((s, p) => s + (p.mean_bias - mean) ** 2, 0) / Math.max(1, last.length - 1) /
      last.length);
  const error = last.length > 1 ? spread : last[0].mean_bias_error;
  return `${R.number(100 * mean, 2)} %` + (known(error) ? ` ± ${R.number(100 * error, 2)} %` : '');
}

function work() {
  const rows = rowsOf(
      (t) =>
          [R.count(t.rates?.samples_per_second), R.count(t.rates?.rays_per_second), {
            text: t.acceptance === null ? 'no chains' : R.plain(t.acceptance),
            faint: t.acceptance === null
          },
           {text: t.b === null ? 'no chains' : R.plain(t.b), faint: t.b === null},
           R.integer(t.non_finite), R.bytes(t.peak_bytes)]);
  const load = R.scene().load_seconds;
  return R.table(
      'Work',
      [
        {title: 'technique'}, {title: 'samples/s'}, {title: 'rays/s'}, {title: 'acceptance'},
        {title: 'b', note: 'The picture\'s mean, estimated by independent samples'},
        {title: 'non-finite samples'}, {title: 'peak memory'}
      ],
      rows,
      known(load) ?
          `Loading the scene took ${R.seconds(load)}, which is not part of any technique’s time.` :
          null);
}

function suite() {
  const metric = R.state.metric, scenes = R.scenes(), means = R.data.suite?.[metric];
  if (scenes.length < 2) return null;
  const first = R.techniques()[0]?.name;
  const rows = R.techniques().map(
      (t, index) => ({
        index,
        name: t.name,
        cells:
            scenes
                .map((scene) => {
                  const ends =
                      (scene.techniques ?? []).map((x) => x.at_end?.[metric]?.mean).filter(known);
                  const end = R.result(index, scene)?.at_end?.[metric];
                  return {
                    text: R.interval(end),
                    strong: known(end?.mean) && end.mean === Math.min(...ends)
                  };
                })
                .concat((() => {
                  const m = means?.[t.name];
                  return R.interval(m ? {value: m.geometric_mean, low: m.low, high: m.high} : null);
                })())
      }));
  return R.table(
      `All scenes: ${R.metric().name ?? metric} at the end`,
      [{title: 'technique'}, ...scenes.map((s) => ({title: s.name})), {title: 'geometric mean'}],
      rows,
      `Geometric mean over the scenes of the error’s ratio to ${
          first}’s. Lowest error of a scene in bold.`);
}

R.on('data scene metric theme', () => {
  R.byId('tables').replaceChildren(
      ...[suite(), atEnd(), timeTo(), allMetrics(), work()].filter(Boolean));
});
})(window.pssmltReport);
