// Title, warnings, choice of scene and metric, and the result in a sentence.
'use strict';
(function(R) {
function banner(kind, title, text) {
  return R.make(
      'div', {class: `banner ${kind}`, role: kind === 'bad' ? 'alert' : 'status'},
      R.make('strong', {}, title), text ? ' ' + text : '');
}

function banners() {
  const list = [];
  if (R.broken) list.push(banner('bad', 'The data of this page cannot be read.', R.broken));
  if (R.data.format !== undefined && R.data.format !== 1) {
    list.push(banner(
        'bad', 'Unknown format.',
        `These data have format ${R.plain(R.data.format)}; this page shows format 1.`));
  }
  if (R.data.partial) {
    list.push(banner(
        'warn', 'Partial results.',
        R.data.why_partial || 'The comparison did not run to its end.'));
  }
  const doubts = R.scenes().filter((s) => s.reference?.agreement?.biased).map((s) => {
    const {text, p_value: p} = s.reference.agreement;
    return `${s.name}: ${
               text || 'the techniques that made it disagree beyond what statistics allow'}` +
        (R.known(p) ? ` (p = ${R.number(p, 2)})` : '');
  });
  if (doubts.length) {
    list.push(banner(
        'bad', 'A reference is in doubt; errors against it contain that disagreement.',
        doubts.join('; ') + '.'));
  }
  for (const scene of R.scenes()) {
    const bad = (scene.techniques ?? [])
                    .filter((t) => t.non_finite > 0)
                    .map((t) => `${t.name}: ${R.integer(t.non_finite)}`);
    if (bad.length)
      list.push(banner(
          'warn', `Dropped samples in “${scene.name}”:`,
          `${bad.join(', ')}. They were left out of the pictures.`));
    for (const warning of scene.warnings ?? [])
      list.push(banner('warn', `“${scene.name}”:`, warning));
    for (const t of scene.techniques ?? []) {
      for (const warning of t.warnings ?? [])
        list.push(banner('warn', `${t.name} in “${scene.name}”:`, warning));
    }
  }
  R.byId('banners').replaceChildren(...list);
}

function title() {
  const scenes = R.scenes().map((s) => s.name), names = R.techniques().map((t) => t.name);
  const what = scenes.length === 1 ? scenes[0] :
      scenes.length                ? `${scenes.length} scenes` :
                                     'no scene yet';
  R.byId('title').textContent = `Error against run time: ${what}`;
  document.title = `${what}: ${names.join(', ')}`;
  const s = R.data.settings ?? {}, machine = R.data.machine ?? {};
  R.byId('subtitle').textContent = [
    names.join(' · '), R.known(s.seconds) && `${R.seconds(s.seconds)} each`,
    R.known(s.runs) && (s.runs === 1 ? '1 run' : `${s.runs} independent runs`),
    R.known(s.threads) && `${s.threads} threads`, machine.processor, R.data.created
  ].filter(Boolean).join(', ');
}

// The same entries stay: a list that is open would be closed.
R.fillSelect = function(select, entries) {
  const now = JSON.stringify(entries);
  if (select.entries === now) return;
  select.entries = now;
  select.replaceChildren(...entries.map(([value, text]) => R.make('option', {value}, text)));
};
function options(select, entries, chosen) {
  R.fillSelect(select, entries);
  select.value = String(chosen);
}
function choices() {
  R.byId('scene-field').hidden = R.scenes().length < 2;
  options(R.byId('scene'), R.scenes().map((s, i) => [i, s.name]), R.state.scene);
  options(R.byId('metric'), R.metrics().map((m) => [m.id, m.name ?? m.id]), R.state.metric);
  const m = R.metric();
  R.byId('metric-formula').textContent = [m.formula, m.note].filter(Boolean).join(' — ');
}

// Lowest error at the end; whether it is apart from the next is said by the intervals.
function headline() {
  const ends =
      R.results()
          .map(
              ([, t]) =>
                  ({name: t.name, ...t.at_end?.[R.state.metric], up: t.speed_up?.[R.state.metric]}))
          .filter((t) => R.known(t.mean))
          .sort((x, y) => x.mean - y.mean);
  const line = R.byId('headline');
  if (!ends.length) {
    line.textContent = 'No error is known yet.';
    return;
  }
  const [best, next] = ends, time = R.endText().replace('a', 'A');
  const unclear = next && (!R.known(best.high) || !R.known(next.low) || best.high >= next.low);
  const error = `${R.metric().name ?? R.state.metric} ${R.interval(best)}`;
  const first = R.techniques()[0]?.name;
  const up = best.name !== first && R.known(best.up?.value) ?
      `; ${R.number(best.up.value)} times less than ${first}` +
          (R.known(best.up.low) ? ` (95 %: ${R.number(best.up.low)} to ${R.number(best.up.high)})` :
                                  '') :
      '';
  line.textContent = unclear ? `${time}, ${best.name} has the lowest mean (${
                                   error}), but its interval does not exclude ${next.name}.` :
                               `${time}, ${best.name} has the lowest error (${error})${up}.`;
}

R.byId('scene').addEventListener('change', (e) => R.set({scene: Number(e.target.value)}));
R.byId('metric').addEventListener('change', (e) => R.set({metric: e.target.value}));
R.on('data', () => {
  banners();
  title();
});
R.on('data scene metric', () => {
  choices();
  headline();
});
})(window.pssmltReport);
