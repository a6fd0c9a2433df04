// The controls above and below the pictures.
'use strict';
(function (R) {
const make = R.make;
const shows = {
  picture: 'picture',
  signed: 'signed error',
  absolute: 'absolute error',
  relative: 'relative error'
};
const modes = {
  slider: 'Slider',
  flip: 'Flip',
  grid: 'All'
};

const field = (label, control) => make('span', {class: 'field'}, make('label', { for: control.id
                                       }, label), control);
const button = (id, text, title, onclick) =>
    make('button', {type: 'button', id, title, onclick}, text);
const select = (id, key, number) => make(
    'select',
    {id, onchange: (e) => R.set({[key]: number ? Number(e.target.value) : e.target.value})});
const range = (id, min, max, step, oninput) => make(
    'input', {id, type: 'range', min, max, step, oninput: (e) => oninput(Number(e.target.value))});

// Label, control, value in words, a button.
  const row = (id, name, control, more) => {
  const input = control.tagName === 'INPUT';
    return make('div', { class: 'row', id: `${id}-row` },
      make(input ? 'label' : 'span', { class: 'label', for: input ? id : null }, name),
      control, make('output', {
      id: `${id}-text`, for: id
    }), more);
  };

  function play() {
    const last = R.snapshotTimes().length - 1;
    if (R.playing) {
      clearInterval(R.playing);
      R.playing = null;
    } else {
      if (R.snapshotIndex() >= last) R.set({snapshot: 0});
      R.playing = setInterval(() => {
        // A picture that is still loading is waited for.
        if (R.panesShown().some((n) => R.shownImage(n).pending)) return;
        if (R.snapshotIndex() >= last)
          play();
        else
          R.set({snapshot: R.snapshotIndex() + 1});
      }, 450);
    }
    R.byId('play').textContent = R.playing ? 'Stop' : 'Play';
  }
  R.swap = () => R.set({ a: R.state.b, b: R.state.a });

  // Built once; their values follow the state.
  R.makeControls = function () {
    const mode = make(
        'span', {class: 'segments', role: 'group', 'aria-label': 'How pictures are compared'},
        Object.entries(modes).map(
            ([key, text]) => make(
                'button', {type: 'button', id: `mode-${key}`, onclick: () => R.set({mode: key})},
                text)));
    const frames = make(
        'label', {class: 'check'},
        make(
            'input',
            {type: 'checkbox', id: 'frames', onchange: (e) => R.set({frames: e.target.checked})}),
        'outline insets');
    const show = select('show', 'show');
    show.append(...Object.entries(shows).map(([value, text]) => make('option', {value}, text)));
    return {
      above: make(
          'div', {class: 'bar'}, mode, field('A', select('a', 'a', true)),
          button('swap', '⇄', 'Swap A and B (space)', R.swap), field('B', select('b', 'b', true)),
          field('Show', show), frames),
      below: make(
          'div', {class: 'sliders'},
          row('time', 'Time', range('time', 0, 0, 1, (v) => R.set({snapshot: v})),
              button('play', 'Play', 'Step through the snapshots', play)),
          row('exposure', 'Exposure', range('exposure', -12, 12, 0.25, (v) => R.set({exposure: v})),
              button('exposure-reset', '0', 'No exposure (r)', () => R.set({exposure: 0}))),
          row('split', 'Split', range('split', 0, 1, 0.01, (v) => R.set({split: v})),
              button('split-reset', '½', 'Split in the middle', () => R.set({split: 0.5}))),
          row('zoom', 'Zoom',
              make(
                  'span', {class: 'buttons', id: 'zoom', role: 'group', 'aria-label': 'Zoom'},
                  button('zoom-out', '−', 'Zoom out (-)', () => R.zoom(0.5)),
                  button('zoom-in', '+', 'Zoom in (+)', () => R.zoom(2)),
                  button('zoom-fit', 'Fit', 'The whole picture (r)', () => R.setView(1, 0.5, 0.5)),
                  button('zoom-one', '1:1', 'One pixel to one of the screen', R.oneToOne)),
              make('span'))),
    };
  };

  const timeText = () => {
    const times = R.panesShown().filter((n) => n > 0).map((n) => R.snapshot(n)).filter(Boolean);
    const main = R.snapshotTimes()[R.snapshotIndex()];
    if (!R.known(main)) return 'no snapshots';
    const logarithmic = times.some((t) => t.precision === 'logarithmic');
    return R.seconds(main) + (logarithmic ? ' (8 bit)' : '');
  };

  R.updateControls = function () {
    const s = R.state, last = Math.max(0, R.snapshotTimes().length - 1);
    for (const key of Object.keys(modes))
      R.byId(`mode-${key}`).setAttribute('aria-pressed', String(s.mode === key));
    for (const key of ['a', 'b', 'show', 'exposure', 'split']) R.byId(key).value = String(s[key]);
    Object.assign(R.byId('time'), {max: last, value: R.snapshotIndex(), disabled: last === 0});
    R.byId('time').setAttribute('aria-valuetext', R.byId('time-text').textContent = timeText());
    const stops = `${
        s.exposure > 0     ? '+' :
            s.exposure < 0 ? '−' :
                             ''}${Math.abs(s.exposure)} stops`;
    R.byId('exposure').setAttribute('aria-valuetext', R.byId('exposure-text').textContent = stops);
    R.byId('split-text').textContent = `${Math.round(100 * s.split)} %`;
    R.byId('split-row').hidden = s.mode !== 'slider';
    R.byId('frames').checked = s.frames;
    R.byId('b').disabled = s.mode !== 'slider' && s.mode !== 'flip';
    R.byId('a').disabled = s.mode === 'grid';
    R.byId('zoom-text').textContent = `${R.number(s.view.scale, 2)} ×`;
  };
  R.fillChoices = function () {
    const entries = [...Array(R.shownCount() + 1).keys()]
                        .map((n) => (n + 1) % (R.shownCount() + 1))
                        .map((n) => [n, `${n}  ${R.shownName(n)}`]);
    for (const id of ['a', 'b']) R.fillSelect(R.byId(id), entries);
  };
})(window.pssmltReport);
