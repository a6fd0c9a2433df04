// The work on pixels: tone mapping and error maps, from codes to 8-bit colours by tables.
'use strict';
(function(R) {
const pack = (r, g, b) => (255 << 24 | b << 16 | g << 8 | r) >>> 0;
const notFinite = pack(255, 0, 255);

// The colours of [0, 1], from evenly spaced ones.
function ramp(colours) {
  const table = new Uint32Array(256);
  for (let i = 0; i < 256; ++i) {
    const at = i / 255 * (colours.length - 1), k = Math.min(Math.floor(at), colours.length - 2);
    const mix = (c) => Math.round(colours[k][c] + (colours[k + 1][c] - colours[k][c]) * (at - k));
    table[i] = pack(mix(0), mix(1), mix(2));
  }
  return table;
}
const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
// Both are told apart with every kind of colour vision: viridis, and blue to red through white.
R.rampColours = {
  sequential: ['#440154', '#414487', '#2a788e', '#22a884', '#7ad151', '#fde725'],
  signed: ['#053061', '#2166ac', '#67a9cf', '#f7f7f7', '#ef8a62', '#b2182b', '#67001f'],
};
const sequential = ramp(R.rampColours.sequential.map(rgb));
const signed = ramp(R.rampColours.signed.map(rgb));

// IEC 61966-2-1.
const encode = (v) => (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);

const toneTables = new WeakMap();  // image -> {exposure, table}
function toneTable(image, exposure) {
  const old = toneTables.get(image);
  if (old?.exposure === exposure) return old.table;
  const gain = 2 ** exposure, values = image.values;
  const table = new Uint8Array(values.length);
  for (let i = 0; i < values.length; ++i) {
    const v = values[i] * gain;
    table[i] = v >= 1 ? 255 : v > 0 ? Math.round(255 * encode(v)) : 0;
  }
  toneTables.set(image, {exposure, table});
  return table;
}

// `box`: {x, y, width, height} in pixels of the image.
function picture(image, box, exposure, out) {
  const {codes, values, width} = image, table = toneTable(image, exposure);
  for (let y = 0, o = 0; y < box.height; ++y) {
    let k = 3 * ((box.y + y) * width + box.x);
    for (let x = 0; x < box.width; ++x, k += 3, ++o) {
      out[o] = 0xff000000 | table[codes[k + 2]] << 16 | table[codes[k + 1]] << 8 | table[codes[k]];
      if (image.nonFinite &&
          !Number.isFinite(values[codes[k]] + values[codes[k + 1]] + values[codes[k + 2]])) {
        out[o] = notFinite;
      }
    }
  }
}

// Rec. 709 luminance of one pixel.
R.luminance = (image, i) => 0.2126 * image.values[image.codes[3 * i]] +
    0.7152 * image.values[image.codes[3 * i + 1]] + 0.0722 * image.values[image.codes[3 * i + 2]];
const luminances = new WeakMap();
R.luminances = function(image) {
  let all = luminances.get(image);
  if (all) return all;
  all = new Float32Array(image.width * image.height);
  for (let i = 0; i < all.length; ++i) all[i] = R.luminance(image, i);
  luminances.set(image, all);
  return all;
};
// What is added to the reference's luminance where a relative error divides: 1 % of its mean.
const offsets = new WeakMap();
R.relativeOffset = function(reference) {
  if (offsets.has(reference)) return offsets.get(reference);
  let sum = 0, count = 0;
  for (const v of R.luminances(reference))
    if (Number.isFinite(v)) {
      sum += v;
      ++count;
    }
  offsets.set(reference, 0.01 * sum / Math.max(count, 1) || 1e-30);
  return offsets.get(reference);
};

function errors(image, reference, show, box, exposure, out) {
  const r = R.luminances(reference), l = R.luminances(image), gain = 2 ** exposure,
        offset = R.relativeOffset(reference);
  for (let y = 0, o = 0; y < box.height; ++y) {
    let i = (box.y + y) * image.width + box.x;
    for (let x = 0; x < box.width; ++x, ++i, ++o) {
      const d = (l[i] - r[i]) * gain;
      if (!Number.isFinite(d))
        out[o] = notFinite;
      else if (show === 'signed')
        out[o] = signed[Math.max(0, Math.min(255, Math.round(127.5 + 127.5 * d)))];
      else {
        const e = show === 'relative' ? Math.abs(d) / (Math.abs(r[i]) + offset) : Math.abs(d);
        out[o] = sequential[Math.min(255, Math.round(255 * e))];
      }
    }
  }
}

// Fills an ImageData of the box's size. Without a reference of the same size there is no error map.
R.paint = function(imageData, image, reference, box, show, exposure) {
  const out = new Uint32Array(imageData.data.buffer);
  if (show === 'picture')
    picture(image, box, exposure, out);
  else if (!reference || reference.width !== image.width || reference.height !== image.height)
    out.fill(0xff808080);
  else
    errors(image, reference, show, box, exposure, out);
};
R.wholeBox = (image) => ({x: 0, y: 0, width: image.width, height: image.height});
})(window.pssmltReport);
