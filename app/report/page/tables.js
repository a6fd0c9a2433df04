// The tables of the chosen scene.
'use strict';
(function(R) {
const known = R.known;
const rowsOf = (cells) => R.results().map(([index, t]) => ({index, name: t.name, cells: cells(t)}));
const lowest = (metric) =>
    Math.min(...R.results().map(([, t]) => t.at_end?.[metric]?.mean).filter(known));

// An error at the end; what is near the reference's own error is no more than a bound.
R.errorCell = (end, best) => ({
  text: R.interval(end) + (end?.near_floor ? ' *' : ''),
  strong: known(end?.mean) && end.mean === best,
  note: end?.near_floor ? 'Near the reference’s own error' : null
});
const plusMinus = (x) => (known(x) ? ` ± ${R.number(x, 2)}` : '');
const slopeText = (slope) =>
    (known(slope?.value) ? R.number(slope.value, 3) + plusMinus(slope.error) : R.unknown);

function atEnd() {
  const metric = R.state.metric, best = lowest(metric);
  const rows = rowsOf(
      (t) =>
          [R.errorCell(t.at_end?.[metric], best),
           R.interval(t.speed_up?.[metric], R.times),
           R.number(t.efficiency?.[metric]),
           slopeText(t.slope?.[metric]),
           t.slope?.[metric]?.verdict ?? R.unknown,
  ]);
  const columns = [
    {title: 'technique'},
    {title: 'error [95 %]'},
    {title: 'speed-up [95 %]', note: 'Error of the first technique over this one’s'},
    {title: 'efficiency', note: '1 / (error × time), in 1/s'},
    {title: 'slope', note: 'In the log-log chart; −1: independent samples'},
    {title: 'verdict'},
  ];
  const marked = R.results().some(([, t]) => t.at_end?.[metric]?.near_floor);
  return R.table(
      `${R.metric().name ?? metric} ${R.endText()}`, columns, rows,
      'Speed-up: error of the first technique / error of this one after the same time. ' +
          'Efficiency: 1 / (error × time). Lowest error in bold.' +
          (marked ? ' *: near the reference’s own error.' : ''));
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
    if (!known(entry.seconds)) return 'not reached';
    // Below it from the first snapshot on: when it was reached is not known.
    return (entry.at_most ? '≤ ' : '') + R.interval({...entry, mean: entry.seconds}, R.seconds);
  }));
  return R.table(
      `Time to reach an error (${R.metric().name ?? metric})`,
      [{title: 'technique'}, ...targets.map((e) => ({title: R.number(e)}))], rows,
      'Interpolated between snapshots, never extrapolated.');
}

function allMetrics() {
  const metrics = R.metrics(), best = metrics.map((m) => lowest(m.id));
  const rows = rowsOf(
      (t) =>
          [...metrics.map((m, i) => R.errorCell(t.at_end?.[m.id], best[i])),
           bias(t, R.scene()?.reference?.mean_error),
  ]);
  const columns = [
    {title: 'technique'},
    ...metrics.map((m) => ({title: m.name ?? m.id, note: m.formula})),
    {title: 'bias of the mean', note: 'Mean luminance less the reference’s, over the reference’s'},
  ];
  return R.table(`All metrics ${R.endText()}`, columns, rows);
}
// Mean over the runs; its standard error from the runs where there are several, with that of the
// reference, which all runs share.
function bias(t, ofReference) {
  const last =
      (t.runs ?? []).map((r) => r.points?.[r.points.length - 1]).filter((p) => known(p?.mean_bias));
  if (!last.length) return R.unknown;
  const mean = last.reduce((s, p) => s + p.mean_bias, 0) / last.length;
  const spread = Math.sqrt(
      last.reduce((s, p) => s + (p.mean_bias - mean) ** 2, 0) / Math.max(1, last.length - 1) /
      last.length);
  const shared = known(ofReference) ? ofReference : 0;
  const error = last.length > 1 ? Math.hypot(spread, shared) : last[0].mean_bias_error;
  return `${R.number(100 * mean, 2)} %` + (known(error) ? ` ± ${R.number(100 * error, 2)} %` : '');
}

function work() {
  const ofChains = (x) =>
      (x === null ? {text: 'no chains', faint: true} : {text: R.plain(x), faint: x === undefined});
  const rows = rowsOf(
      (t) =>
          [R.count(t.rates?.samples_per_second),
           R.count(t.rates?.rays_per_second),
           ofChains(t.acceptance),
           ofChains(t.b),
           R.integer(t.non_finite),
           R.bytes(t.film_bytes),
           R.bytes(t.peak_bytes),
  ]);
  const columns = [
    {title: 'technique'},
    {title: 'samples/s'},
    {title: 'rays/s'},
    {title: 'acceptance'},
    {title: 'b', note: 'The picture’s mean, estimated by independent samples'},
    {title: 'dropped samples', note: 'Not finite, negative or beyond the film’s range'},
    {title: 'film'},
    {title: 'peak memory', note: 'Of the process, which all techniques share'},
  ];
  const load = R.scene().load_seconds;
  const note = `Loading the scene took ${R.seconds(load)}, which is part of no technique’s time.`;
  return R.table('Work', columns, rows, known(load) ? note : null);
}

R.on('data scene metric theme', () => {
  const tables = [R.suiteTable(), atEnd(), timeTo(), allMetrics(), work()];
  R.byId('tables').replaceChildren(...tables.filter(Boolean));
});
})(window.pssmltReport);
