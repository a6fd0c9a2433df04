// Numbers as text. What is missing is said in words, never shown as 0 or NaN.
'use strict';
(function(R) {
const known = (x) => typeof x === 'number' && Number.isFinite(x);
R.known = known;
R.unknown = 'unknown';

const superscripts = '⁰¹²³⁴⁵⁶⁷⁸⁹';
R.power = (n) =>
    '10' + (n < 0 ? '⁻' : '') + String(Math.abs(n)).replace(/\d/g, (d) => superscripts[d]);

// `digits` significant ones.
R.number = function(x, digits = 3) {
  if (!known(x)) return R.unknown;
  if (x === 0) return '0';
  const size = Math.abs(x);
  if (size >= 1e-3 && size < 1e5) {
    const text = x.toPrecision(digits);
    return text.includes('e') ? String(Math.round(x)) : text.replace('-', '−');
  }
  const [mantissa, exponent] = x.toExponential(digits - 1).split('e');
  return mantissa.replace('-', '−') + ' · ' + R.power(Number(exponent));
};
R.integer = (x) => (known(x) ? Math.round(x).toLocaleString('en-GB') : R.unknown);

R.seconds = function(x) {
  if (!known(x)) return R.unknown;
  if (x < 120) return (Number.isInteger(x) ? String(x) : R.number(x)) + ' s';
  const minutes = Math.floor(x / 60);
  if (minutes < 120) return `${minutes} min ${Math.round(x - 60 * minutes)} s`;
  return `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
};

const scaled = (x, base, units) => {
  let n = 0;
  while (Math.abs(x) >= base && n + 1 < units.length) {
    x /= base;
    ++n;
  }
  return x.toPrecision(3) + ' ' + units[n];
};
R.count = (x) =>
    (known(x) ? (x < 1000 ? R.number(x) : scaled(x, 1000, ['', 'K', 'M', 'G', 'T'])) : R.unknown);
R.bytes = (x) => (known(x) ? scaled(x, 1024, ['B', 'KiB', 'MiB', 'GiB', 'TiB']) : R.unknown);

// "mean [low, high]", the interval only where it is known.
R.interval = function(x, format = R.number) {
  if (!x || !known(x.mean ?? x.value)) return R.unknown;
  const text = format(x.mean ?? x.value);
  return known(x.low) && known(x.high) ? `${text} [${format(x.low)}, ${format(x.high)}]` : text;
};
R.times = (x) => (known(x) ? R.number(x) + ' ×' : R.unknown);

// Any JSON value in one line, for parameters and counters.
R.plain = function(value) {
  if (value === null || value === undefined) return R.unknown;
  if (typeof value === 'number')
    return Number.isInteger(value) ?
        String(value) :
        R.number(value, 5).replace(/^(−?\d*\.\d*?)0+$/, '$1').replace(/\.$/, '');
  if (Array.isArray(value)) return value.map(R.plain).join(', ');
  if (typeof value === 'object') {
    return Object.entries(value)
        .map(([k, v]) => `${k.replaceAll('_', ' ')} ${R.plain(v)}`)
        .join(', ');
  }
  return String(value);
};
})(window.pssmltReport);
