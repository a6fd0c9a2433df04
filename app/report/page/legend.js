// What surrounds the curves: the legend (techniques can be left out), the caption, the numbers, the
// small charts of a suite.
'use strict';
(function(R) {
function legend() {
  const buttons = R.results().map(([index, t]) => {
    const slope = t.slope?.[R.state.metric];
    const text = R.known(slope?.value) ? `slope ${R.number(slope.value, 2)}` : null;
    return R.make(
        'button', {
          type: 'button',
          'aria-pressed': String(!R.state.hidden.has(t.name)),
          'data-technique': t.name,
          onclick: () => {
            const hidden = new Set(R.state.hidden);
            if (!hidden.delete(t.name)) hidden.add(t.name);
            R.set({hidden});
          }
        },
        R.swatch(index), R.make('span', {}, t.name), text ? R.make('small', {}, text) : null);
  });
  const box = R.byId('legend'), focused = document.activeElement?.dataset?.technique;
  box.replaceChildren(...buttons);
  if (focused !== undefined) buttons.find((b) => b.dataset.technique === focused)?.focus();
}

function caption() {
  const scene = R.scene(), parts = [];
  const floor = scene.reference?.floor?.[R.state.metric];
  // Fewer than were asked for while the comparison runs, or where it was cut.
  const runs = R.results()[0]?.[1].runs?.length ?? R.data.settings?.runs;
  parts.push(
      !R.known(runs) || runs === 1 ? 'One run: no interval is known.' :
          runs > 1                 ? `Mean of ${runs} runs; bands: 95 % intervals of the mean.` :
                                     'No run has a point yet.');
  parts.push(
      R.known(floor) && floor > 0 ?
          `Dotted line: the reference’s own error, ${
              R.number(floor)}; hollow points are near it and left out of slopes.` :
          'The reference’s own error is unknown.');
  if (R.state.guide && /mse/.test(R.state.metric))
    parts.push('Thin line: slope −1, the law of independent samples.');
  R.byId('chart-caption').textContent = parts.join(' ');
}

function numbers() {
  const metric = R.state.metric;
  const rows = R.results().flatMap(
      ([index, t]) => R.curvePoints(t, metric).map(
          (p) => ({
            index,
            name: t.name,
            cells: [
              R.seconds(p.x), R.number(p.y), R.known(p.low) ? R.number(p.low) : R.unknown,
              R.known(p.high) ? R.number(p.high) : R.unknown, p.near ? 'yes' : 'no'
            ]
          })));
  R.byId('curve-table')
      .replaceChildren(R.table(
          `${R.metric().name ?? metric} against time`,
          [
            {title: 'technique'}, {title: 'wall time'}, {title: 'mean'}, {title: 'low (95 %)'},
            {title: 'high (95 %)'}, {title: 'near the floor'}
          ],
          rows));
}

function multiples() {
  const box = R.byId('multiples'), scenes = R.scenes();
  for (const canvas of box.querySelectorAll('canvas')) R.undraw(canvas);
  box.hidden = scenes.length < 2;
  box.replaceChildren();
  if (box.hidden) return;
  scenes.forEach((scene, i) => {
    const canvas = R.make('canvas', {role: 'img'});
    box.append(R.make(
        'figure', {class: i === R.state.scene ? 'chosen' : null},
        R.make(
            'button', {
              type: 'button',
              'aria-pressed': String(i === R.state.scene),
              onclick: () => R.set({scene: i})
            },
            scene.name),
        R.make('div', {class: 'chart small'}, canvas)));
    R.drawCurves(canvas, scene, true);
  });
}

for (const key of ['bands', 'fits', 'guide']) {
  R.byId(key).addEventListener('change', (e) => R.set({[key]: e.target.checked}));
}
R.on('data scene metric hidden theme', legend);
R.on('data scene metric guide', caption);
R.on('data scene metric', numbers);
R.on('data scene metric hidden theme bands fits guide', () => {
  R.drawCurves(R.byId('chart'), R.scene(), false);
  multiples();
});
})(window.pssmltReport);
