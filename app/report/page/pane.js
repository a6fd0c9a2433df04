// Panes: canvases that show techniques or the reference through one common view. The pixels of each
// are painted once into a buffer of the picture's size, which zoom and pan only draw.
'use strict';
(function(R) {
const shown = new Map();    // n -> {image, entry, wanted, error}: what the viewer calls n
const buffers = new Map();  // n -> {canvas, data, key}

// What to show of n now: the picture wanted, or while it loads the one before.
R.shownImage = function(n) {
  const entry = R.snapshot(n);
  let s = shown.get(n);
  if (!s) shown.set(n, s = {});
  const wanted = entry ? `${R.state.data}/${R.state.images}/${R.state.scene}/${entry.image}` : null;
  if (s.wanted === wanted) return s;
  const sameScene = s.scene === R.state.scene;
  Object.assign(s, {wanted, error: null, pending: Boolean(entry), scene: R.state.scene});
  if (!entry || !sameScene) Object.assign(s, {image: null, entry: null});
  if (!entry) return s;
  const arrived = (patch) => {
    if (s.wanted !== wanted) return;
    Object.assign(s, patch, {pending: false});
    R.redraw();
  };
  const now = R.imageNow(entry.image);
  if (now)
    Object.assign(s, {image: now, entry, pending: false});
  else
    R.loadImage(entry.image).then((image) => arrived({image, entry}), (error) => arrived({
                                                                        error: error.message
                                                                      }));
  return s;
};

// A canvas with the painted pixels of n, or null.
function bufferOf(n) {
  const s = R.shownImage(n), show = n === 0 ? 'picture' : R.state.show;
  if (!s.image) return null;
  const reference = show === 'picture' ? null : R.shownImage(0).image;
  const {image} = s;
  let buffer = buffers.get(n);
  if (!buffer || buffer.canvas.width !== image.width || buffer.canvas.height !== image.height) {
    const canvas = R.make('canvas', {width: image.width, height: image.height});
    buffer = {canvas, data: new ImageData(image.width, image.height)};
    buffers.set(n, buffer);
  }
  if (buffer.image === image && buffer.reference === reference && buffer.show === show &&
      buffer.exposure === R.state.exposure) {
    return buffer.canvas;
  }
  R.paint(buffer.data, image, reference, R.wholeBox(image), show, R.state.exposure);
  buffer.canvas.getContext('2d').putImageData(buffer.data, 0, 0);
  Object.assign(buffer, {image, reference, show, exposure: R.state.exposure});
  return buffer.canvas;
}

// Where the picture lies in a pane: CSS pixels a pixel, and the left upper corner.
R.geometry = function(canvas, image) {
  const {clientWidth: w, clientHeight: h} = canvas, {view} = R.state;
  const scale = Math.min(w / image.width, h / image.height) * view.scale;
  return {
    scale,
    x: w / 2 - view.x * image.width * scale,
    y: h / 2 - view.y * image.height * scale,
    w,
    h
  };
};

function outlines(g, context) {
  R.state.insets.forEach((inset, i) => {
    const x = g.x + inset.x * g.scale, y = g.y + inset.y * g.scale, size = inset.size * g.scale;
    context.lineWidth = 3;
    context.strokeStyle = '#000';
    context.strokeRect(x, y, size, size);
    context.lineWidth = 1.4;
    context.strokeStyle = '#fff';
    context.strokeRect(x, y, size, size);
    label(context, R.insetName(i), x + 2, y - 3 - R.textSize(), 'left');
  });
}
function label(context, text, x, y, align) {
  const size = R.textSize() * 0.85;
  context.font = `600 ${size}px ${R.css('--font')}`;
  context.textAlign = 'left';
  context.textBaseline = 'top';
  const width = context.measureText(text).width + size * 0.8;
  const left = align === 'right' ? x - width : x;
  context.fillStyle = 'rgba(0,0,0,.72)';
  context.fillRect(left, y, width, size * 1.5);
  context.fillStyle = '#fff';
  context.fillText(text, left + size * 0.4, y + size * 0.25);
}

function drawOne(context, g, n, x0, x1) {
  const buffer = bufferOf(n), s = R.shownImage(n);
  context.save();
  context.beginPath();
  context.rect(x0, 0, x1 - x0, g.h);
  context.clip();
  if (buffer) {
    context.imageSmoothingEnabled = g.scale * devicePixelRatio < 1;
    context.imageSmoothingQuality = 'high';
    context.drawImage(buffer, g.x, g.y, buffer.width * g.scale, buffer.height * g.scale);
  }
  const status = s.error ?? (s.pending ? 'loading …' : s.image ? null : 'no picture');
  if (status) label(context, status, (x0 + x1) / 2, g.h / 2, 'left');
  context.restore();
}

// `parts`: [{n, from, to}] in parts of the pane's width.
R.drawPane = function(canvas, parts) {
  const ratio = devicePixelRatio, w = canvas.clientWidth, h = canvas.clientHeight;
  const image = parts.map((p) => R.shownImage(p.n).image).find(Boolean);
  if (canvas.width !== Math.round(w * ratio)) canvas.width = Math.round(w * ratio);
  if (canvas.height !== Math.round(h * ratio)) canvas.height = Math.round(h * ratio);
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, w, h);
  const g = image ? R.geometry(canvas, image) : {scale: 1, x: 0, y: 0, w, h};
  for (const p of parts) drawOne(context, g, p.n, p.from * w, p.to * w);
  if (image && R.state.frames) outlines(g, context);
  parts.forEach((p, i) => label(context, R.shownName(p.n), i ? w - 6 : 6, 6, i ? 'right' : 'left'));
  if (parts.length === 2) {
    const x = parts[0].to * w;
    context.fillStyle = 'rgba(0,0,0,.6)';
    context.fillRect(x - 2, 0, 4, h);
    context.fillStyle = '#fff';
    context.fillRect(x - 0.75, 0, 1.5, h);
    context.beginPath();
    context.arc(x, h / 2, R.textSize() * 0.6, 0, 7);
    context.fill();
  }
  const {cursor} = R.state;
  if (cursor && image && g.scale >= 4) {
    context.strokeStyle = '#fff';
    context.lineWidth = 1;
    context.strokeRect(
        g.x + cursor.x * g.scale + 0.5, g.y + cursor.y * g.scale + 0.5, g.scale - 1, g.scale - 1);
  }
};
})(window.pssmltReport);
