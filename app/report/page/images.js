// Images: loaded by script tags (the only way from file://), inflated, kept as codes. An image is
// {width, height, codes (3 a pixel), values (of a code), precision, ...}; tables of 256 or 65536
// entries then do all work on pixels.
'use strict';
(function(R) {
const cache = new Map();  // id -> {promise, resolve, reject, image, used}
const budget = 700e6;     // bytes of codes
let clock = 0;
let version = 0;

R.imageUrl = (id) => `images/${encodeURIComponent(id)}.js`;

function entryOf(id) {
  let entry = cache.get(id);
  if (!entry) {
    entry = {};
    entry.promise = new Promise((resolve, reject) => Object.assign(entry, {resolve, reject}));
    entry.promise.catch(() => {});
    cache.set(id, entry);
  }
  entry.used = ++clock;
  return entry;
}

function drop() {
  const done = [...cache].filter(([, e]) => e.image).sort((x, y) => x[1].used - y[1].used);
  let total = done.reduce((sum, [, e]) => sum + e.image.codes.byteLength, 0);
  for (const [id, entry] of done) {
    if (total <= budget) return;
    total -= entry.image.codes.byteLength;
    cache.delete(id);
  }
}

// A promise of the image; rejected where its file is missing or broken.
R.loadImage = function(id) {
  const known = cache.has(id);
  const entry = entryOf(id);
  if (known) return entry.promise;
  const url = R.imageUrl(id);
  const script = R.make('script', {src: version ? `${url}?${version}` : url});
  const fail = (why) => {
    entry.failed = true;
    entry.reject(new Error(`images/${id}.js ${why}`));
  };
  script.onload = () => {
    script.remove();
    if (!entry.arrived) fail('does not hold that picture');
  };
  script.onerror = () => {
    script.remove();
    fail('is missing');
  };
  document.head.append(script);
  return entry.promise;
};
// The image if it is there, else null.
R.imageNow = function(id) {
  const entry = cache.get(id);
  if (entry) entry.used = ++clock;
  return entry?.image ?? null;
};
// What could not be loaded is tried again with new data only.
R.on('data', () => {
  for (const [id, entry] of cache)
    if (entry.failed) cache.delete(id);
});
R.forget = function(id) {
  cache.delete(id);
  ++version;
};

R.image = async function(packed) {
  const entry = entryOf(packed.id);
  const replaced = entry.image;
  entry.arrived = true;
  try {
    entry.image = await decode(packed);
    entry.image.id = packed.id;
    entry.promise = Promise.resolve(entry.image);
    entry.resolve(entry.image);
    drop();
    if (replaced) R.set({images: R.state.images + 1});
  } catch (error) {
    entry.failed = true;
    entry.reject(new Error(`images/${packed.id}.js is broken: ${error.message}`));
  }
};

async function inflate(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Planes of G, R - G, B - G back to codes of R, G, B; the arrays' types wrap around by themselves.
function unpack(bytes, pixels, wide) {
  const codes = new (wide ? Uint16Array : Uint8Array)(3 * pixels);
  const plane = wide ? 2 * pixels : pixels;
  if (bytes.length !== 3 * plane) throw new Error('wrong length');
  const at = (start, i) =>
      (wide ? bytes[start + i] | bytes[start + pixels + i] << 8 : bytes[start + i]);
  for (let i = 0, k = 0; i < pixels; ++i, k += 3) {
    const g = at(0, i);
    codes[k] = at(plane, i) + g;
    codes[k + 1] = g;
    codes[k + 2] = at(2 * plane, i) + g;
  }
  return codes;
}

function halfValues(exponent) {
  const values = new Float32Array(65536);
  for (let code = 0; code < 65536; ++code) {
    const sign = code & 0x8000 ? -1 : 1, e = code >> 10 & 31, m = code & 1023;
    values[code] = e === 31 ?
        (m ? NaN : sign * Infinity) :
        sign * (e ? (1 + m / 1024) * 2 ** (e - 15) : m * 2 ** -24) * 2 ** -exponent;
  }
  return values;
}
function logValues(low, step) {
  const values = new Float32Array(256);
  for (let code = 1; code < 255; ++code) values[code] = 2 ** (low + (code - 1) * step);
  values[255] = NaN;
  return values;
}

async function decode(packed) {
  const {width, height, precision} = packed;
  const wide = precision === 'exact';
  const codes = unpack(await inflate(packed.data), width * height, wide);
  return {
    width,
    height,
    precision,
    codes,
    values: wide ? halfValues(packed.exponent) : logValues(packed.low, packed.step),
    clamped: packed.clamped,
    nonFinite: packed.non_finite,
    error: wide ? 2 ** -11 : 2 ** (packed.step / 2) - 1,  // largest relative one
  };
}
})(window.pssmltReport);
