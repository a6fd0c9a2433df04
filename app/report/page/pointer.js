// Moving about in the pictures: drag, wheel, two fingers, keys. All panes share the view.
'use strict';
(function(R) {
const clamp = (x, low, high) => Math.max(low, Math.min(high, x));

// The picture's size in pixels, or null before one is there.
R.viewedImage = () => {
  for (const n of R.panesShown()) {
    const {image} = R.shownImage(n);
    if (image) return image;
  }
  return null;
};
const fitScale = (canvas, image) =>
    Math.min(canvas.clientWidth / image.width, canvas.clientHeight / image.height);

R.setView = function(scale, x, y) {
  const image = R.viewedImage(), canvas = R.mainPane();
  const most = image && canvas ? Math.max(1, 96 / fitScale(canvas, image)) : 64;
  const s = clamp(scale, 1, most), half = 0.5 / s;
  R.set({view: {scale: s, x: clamp(x, half, 1 - half), y: clamp(y, half, 1 - half)}});
};
// About the point (px, py) of a pane in CSS pixels; its centre if not given.
R.zoom = function(factor, canvas = R.mainPane(), px, py) {
  const image = R.viewedImage(), {view} = R.state;
  if (!image || !canvas) return;
  const g = R.geometry(canvas, image);
  const u = ((px ?? g.w / 2) - g.x) / (image.width * g.scale),
        v = ((py ?? g.h / 2) - g.y) / (image.height * g.scale);
  const before = view.scale;
  const most = Math.max(1, 96 / fitScale(canvas, image)), after = clamp(before * factor, 1, most);
  R.setView(after, u + (view.x - u) * before / after, v + (view.y - v) * before / after);
};
// One pixel of the picture to one of the screen.
R.oneToOne = function() {
  const image = R.viewedImage(), canvas = R.mainPane(), {view} = R.state;
  if (image) R.setView(1 / (fitScale(canvas, image) * devicePixelRatio), view.x, view.y);
};
// By parts of what is seen.
R.pan = (dx, dy) => R.setView(
    R.state.view.scale, R.state.view.x + dx / R.state.view.scale,
    R.state.view.y + dy / R.state.view.scale);

function pixelAt(canvas, px, py) {
  const image = R.viewedImage();
  if (!image) return null;
  const g = R.geometry(canvas, image);
  const x = Math.floor((px - g.x) / g.scale), y = Math.floor((py - g.y) / g.scale);
  return x >= 0 && y >= 0 && x < image.width && y < image.height ? {x, y} : null;
}
// Under the keyboard the cursor is the middle of the view.
R.centreCursor = function() {
  const image = R.viewedImage(), {view} = R.state;
  if (image)
    R.set({cursor: {x: Math.floor(view.x * image.width), y: Math.floor(view.y * image.height)}});
};

R.listenToPointer = function(canvas, isMain) {
  const fingers = new Map();
  let dragged = null;  // "split" or "view"
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  canvas.addEventListener('pointerdown', (event) => {
    const [x, y] = place(event);
    fingers.set(event.pointerId, [x, y]);
    canvas.setPointerCapture(event.pointerId);
    const atSplit = isMain && R.state.mode === 'slider' &&
        Math.abs(x - R.state.split * canvas.clientWidth) < 14;
    dragged = atSplit ? 'split' : 'view';
  });
  canvas.addEventListener('pointermove', (event) => {
    const [x, y] = place(event), before = fingers.get(event.pointerId);
    const cursor = pixelAt(canvas, x, y), old = R.state.cursor;
    if (cursor?.x !== old?.x || cursor?.y !== old?.y) R.set({cursor});
    if (!before) return;
    const image = R.viewedImage();
    if (fingers.size === 2 && image) {
      const other = [...fingers].find(([id]) => id !== event.pointerId)[1];
      const distance = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
      R.zoom(distance([x, y]) / distance(before), canvas, (x + other[0]) / 2, (y + other[1]) / 2);
    } else if (dragged === 'split') {
      R.set({split: clamp(x / canvas.clientWidth, 0, 1)});
    } else if (dragged === 'view' && image) {
      const g = R.geometry(canvas, image), {view} = R.state;
      R.setView(
          view.scale, view.x - (x - before[0]) / (image.width * g.scale),
          view.y - (y - before[1]) / (image.height * g.scale));
    }
    fingers.set(event.pointerId, [x, y]);
  });
  const release = (event) => {
    fingers.delete(event.pointerId);
    if (!fingers.size) dragged = null;
  };
  canvas.addEventListener('pointerup', release);
  canvas.addEventListener('pointercancel', release);
  canvas.addEventListener('pointerleave', () => R.set({cursor: null}));
  // Without focus the wheel scrolls the page, as everywhere else.
  canvas.addEventListener('wheel', (event) => {
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    R.zoom(2 ** (-event.deltaY / 240), canvas, ...place(event));
  }, {passive: false});
  canvas.addEventListener('dblclick', (event) => R.zoom(2, canvas, ...place(event)));
  canvas.addEventListener('keydown', (event) => {
    const step = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [
                    0, 1
                  ]}[event.key];
    const image = R.viewedImage();
    if (!step || !image || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    // With Shift one pixel, else an eighth of the view.
    if (event.shiftKey)
      R.setView(
          R.state.view.scale, R.state.view.x + step[0] / image.width,
          R.state.view.y + step[1] / image.height);
    else
      R.pan(step[0] / 8, step[1] / 8);
    R.centreCursor();
  });
  // A touch that cannot pan scrolls the page.
  R.on('view', () => {
    canvas.style.touchAction = R.state.view.scale > 1 ? 'none' : 'pan-y';
  });
  canvas.style.touchAction = 'pan-y';
};
})(window.pssmltReport);
