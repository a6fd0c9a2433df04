// Logarithmic axes and what all charts have in common.
'use strict';
(function(R) {
const mantissa = (x) => Math.round(x / 10 ** Math.floor(Math.log10(x) + 1e-9));

// Powers of ten; where there are few, 2 and 5 times them too.
function tick(value, ticks, format) {
  const decades = Math.log10(ticks[ticks.length - 1].value / ticks[0].value);
  const wanted = decades > 2.5 ? [1] :
      decades > 1.2            ? [1, 3] :
      decades > 0.7            ? [1, 2, 5] :
                                 [1, 2, 3, 4, 5, 7];
  // The ends of the axis are ticks too, but not round.
  const m = mantissa(value),
        round = Math.abs(value / (m * 10 ** Math.floor(Math.log10(value) + 1e-9)) - 1) < 1e-6;
  return round && wanted.includes(m) ? format(value) : '';
}
const errorText = (v) => {
  const exponent = Math.floor(Math.log10(v) + 1e-9), m = mantissa(v);
  if (exponent >= -2 && exponent <= 3) return String(Number(v.toPrecision(2)));
  return m === 1 ? R.power(exponent) : `${m}·${R.power(exponent)}`;
};
const timeText = (v) =>
    (v < 90 ? `${Number(v.toPrecision(2))} s` : `${Number((v / 60).toPrecision(2))} min`);

// Slightly beyond [low, high], so that no marker is cut.
R.around = (values) => {
  const positive = values.filter((v) => R.known(v) && v > 0);
  if (!positive.length) return [0.1, 1];
  return [Math.min(...positive) / 1.15, Math.max(...positive) * 1.15];
};

R.logAxis = function(title, [min, max], kind, small) {
  const size = R.textSize() * (small ? 0.72 : 0.82);
  return {
    type: 'logarithmic',
    min,
    max,
    title: {display: title !== '', text: title, color: R.css('--text'), font: {size}},
    grid: {
      color: R.css('--grid'),
      borderColor: R.css('--faint'),
      lineWidth: (c) => (c.tick && mantissa(c.tick.value) === 1 ? 1.4 : 0.5)
    },
    ticks: {
      color: R.css('--text'),
      font: {size},
      maxRotation: 0,
      autoSkip: true,
      autoSkipPadding: 6,
      callback: (value, i, ticks) => tick(value, ticks, kind === 'time' ? timeText : errorText)
    },
  };
};

R.chartOptions = (x, y, tooltip) => ({
  animation: false,
  responsive: true,
  maintainAspectRatio: false,
  parsing: false,
  interaction: {mode: 'nearest', axis: 'xy', intersect: false},
  scales: {x, y},
  plugins: {
    legend: {display: false},
    tooltip: {
      backgroundColor: R.css('--raised'),
      titleColor: R.css('--text'),
      bodyColor: R.css('--text'),
      borderColor: R.css('--line'),
      borderWidth: 1,
      usePointStyle: true,
      titleFont: {size: R.textSize() * 0.85},
      bodyFont: {size: R.textSize() * 0.85},
      padding: 10,
      ...tooltip
    }
  },
});

const charts = new Map();  // canvas -> chart
R.draw = function(canvas, config) {
  charts.get(canvas)?.destroy();
  const chart = new Chart(canvas, config);
  charts.set(canvas, chart);
  return chart;
};
R.chartOf = (canvas) => charts.get(canvas);
R.undraw = function(canvas) {
  charts.get(canvas)?.destroy();
  charts.delete(canvas);
};
})(window.pssmltReport);
