// The page's one global object, its state and the helpers that make elements.
//
// From outside (the live server's script, the image files) these are called:
//   pssmltReport.update(data)     replaces the data, format 1 as in data.json, and shows them; what
//                                 the reader has chosen (scene, metric, zoom, ...) stays.
//   pssmltReport.image(packed)    an image file's content; an image of the same id is replaced and
//                                 drawn anew wherever it is shown.
//   pssmltReport.forget(id)       the image has changed at its source: load it when it is next
//   used. pssmltReport.imageUrl(id)     where the file of an image is; may be replaced.
//   pssmltReport.on("key", f)     calls f after the state's key changed (list of keys: below).
// The element #live is empty and hidden, for controls of a live server (live.js).
'use strict';
window.pssmltReport = {};
(function(R) {
R.data = {};
R.state = {
  data: 0,  // counts updates
  scene: 0,
  metric: '',
  hidden: new Set(),  // names of techniques left out of the charts
  bands: true,
  fits: false,
  guide: true,
  a: 1,
  b: -1,                             // 1.. techniques, 0 the reference; -1: not chosen yet
  mode: 'slider',                    // slider, flip, grid
  show: 'picture',                   // picture, signed, absolute, relative
  snapshot: Infinity,                // index into R.snapshotTimes(); beyond the end: the last
  exposure: 0,                       // in stops
  split: 0.5,                        // of the slider, part of the view's width
  view: {scale: 1, x: 0.5, y: 0.5},  // 1: the whole picture fits; the centre, part of the picture
  cursor: null,                      // {x, y} pixel under the cursor
  frames: true,                      // whether insets are outlined in the pictures
  insets: [],                        // [{x, y, size}] pixels
  images: 0,                         // counts replaced images
  theme: '',
};

const listeners = {};
R.on = function(keys, listener) {
  for (const key of keys.split(' ')) (listeners[key] ??= []).push(listener);
};
// Changes the state, then calls each listener of what has changed once.
R.set = function(patch) {
  const called = new Set();
  for (const [key, value] of Object.entries(patch)) {
    if (Object.is(R.state[key], value)) continue;
    R.state[key] = value;
    for (const listener of listeners[key] ?? []) called.add(listener);
  }
  for (const listener of called) listener(R.state);
};

R.byId = (id) => document.getElementById(id);

// An element. Children are nodes or texts; texts are never read as HTML.
R.make = function(tag, attributes, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith('on'))
      element.addEventListener(name.slice(2), value);
    else
      element.setAttribute(name, value === true ? '' : String(value));
  }
  element.append(...children.flat().filter((c) => c !== null && c !== undefined));
  return element;
};
R.svg = function(tag, attributes, ...children) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
};

// f at most once a frame, with the last arguments.
R.eachFrame = function(f) {
  let waiting = false;
  return function() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      f();
    });
  };
};

R.css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
// Pixels of the page's text, which grows with the window.
R.textSize = () => parseFloat(getComputedStyle(document.documentElement).fontSize);
})(window.pssmltReport);
