// The renderer's own estimate of its relative MSE against the true one.
'use strict';
(function(R) {
// [{x: true, y: estimated, low, high, seconds}] over all runs. True is what is measured less the
// reference's own error; points near that have none.
R.calibrationPoints = (result, floor) =>
    (result.runs ?? [])
        .flatMap((run) => run.points ?? [])
        .filter((p) => p.estimate?.known && p.estimate.relmse > 0 && p.metrics?.relmse > 4 * floor)
        .map((p) => ({
               x: p.metrics.relmse - floor,
               y: p.estimate.relmse,
               low: p.estimate.low,
               high: p.estimate.high,
               seconds: p.seconds
             }));

function chart() {
  const canvas = R.byId('calibration-chart'), floor = R.scene()?.reference?.floor?.relmse ?? 0;
  const shown = R.results()
                    .filter(([, t]) => !R.state.hidden.has(t.name))
                    .map(([index, t]) => [index, t, R.calibrationPoints(t, floor)]);
  const points = shown.flatMap(([, , p]) => p);
  R.byId('calibration').hidden =
      !points.length && !R.results().some(([, t]) => R.known(t.calibration?.ratio));
  if (!points.length) {
    R.undraw(canvas);
    return;
  }
  const range = R.around(points.flatMap((p) => [p.x, p.y]));
  const sets = shown.map(([index, t, data]) => {
    const look = R.look(index);
    return {
      kind: 'mean',
      label: t.name,
      data,
      showLine: false,
      pointStyle: look.marker,
      pointRadius: R.textSize() * 0.26,
      borderColor: look.colour,
      backgroundColor: look.colour + '90',
      pointBorderWidth: 1.4
    };
  });
  const line = (factor, dash) => ({
    kind: 'line',
    data: range.map((v) => ({x: v, y: v * factor})),
    pointRadius: 0,
    pointHitRadius: 0,
    borderColor: R.css('--faint'),
    borderWidth: factor === 1 ? 1.6 : 1,
    borderDash: dash
  });
  sets.push(line(1, []), line(2, [4, 4]), line(0.5, [4, 4]));
  canvas.setAttribute(
      'aria-label',
      'Chart of estimated against true relative MSE, logarithmic; dashed lines: a factor of 2');
  R.draw(canvas, {
    type: 'line',
    data: {datasets: sets},
    options: R.chartOptions(
        R.logAxis('true relative MSE', range, 'error'),
        R.logAxis('estimated relative MSE', range, 'error'), {
          filter: (item) => item.dataset.kind === 'mean',
          callbacks: {
            title: () => '',
            label: ({dataset, raw}) => `${dataset.label}: estimated ${
                R.interval({mean: raw.y, low: raw.low, high: raw.high})}, true ${
                R.number(raw.x)}, after ${R.seconds(raw.seconds)}`
          },
        })
  });
}

function table() {
  const rows = R.results().map(([index, t]) => {
    const c = t.calibration ?? {};
    const verdict = !R.known(c.ratio) ? R.unknown :
        c.ratio > 1                   ? 'states more than it has' :
                                        'states less than it has';
    return {
      index,
      name: t.name,
      cells: [
        R.interval({value: c.ratio, low: c.low, high: c.high}),
        R.known(c.ratio) && c.low <= 1 && c.high >= 1 ? 'agrees within its interval' : verdict
      ]
    };
  });
  R.byId('calibration-table')
      .replaceChildren(R.table(
          'Calibration: estimated / true relative MSE',
          [{title: 'technique'}, {title: 'ratio [95 %]'}, {title: 'the estimate'}], rows,
          'Dashed lines: a factor of 2.'));
}

R.on('data scene hidden theme', chart);
R.on('data scene theme', table);
})(window.pssmltReport);
