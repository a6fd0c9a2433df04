// What is needed to judge and to repeat the comparison: reference, parameters, metrics, machine,
// versions, the command.
'use strict';
(function(R) {
const make = R.make;

function copyText(text, button) {
  const done = (word) => {
    button.textContent = word;
    setTimeout(() => {
      button.textContent = 'Copy';
    }, 1500);
  };
  const byHand = () => {
    // The clipboard's interface is missing where the page is not trusted.
    const area = make('textarea', {readonly: true});
    area.value = text;
    document.body.append(area);
    area.select();
    const worked = document.execCommand('copy');
    area.remove();
    done(worked ? 'Copied' : 'Select and copy by hand');
  };
  if (navigator.clipboard)
    navigator.clipboard.writeText(text).then(() => done('Copied'), byHand);
  else
    byHand();
}

function command() {
  const text = R.data.command ?? R.unknown;
  const button = make('button', {type: 'button', id: 'copy'}, 'Copy');
  button.addEventListener('click', () => copyText(text, button));
  return make('div', {class: 'command'}, make('pre', {tabindex: 0, id: 'command'}, text), button);
}

function reference(scene) {
  const r = scene.reference;
  if (!r) return R.pairs([['reference', 'none']]);
  const a = r.agreement;
  const floor = Object.entries(r.floor ?? {})
                    .filter(([, v]) => R.known(v))
                    .map(([id, v]) => `${id} ${R.number(v)}`)
                    .join(', ');
  return R.pairs([
    [
      'source',
      r.source === 'made' ? `made by ${R.plain(r.techniques)}` :
          r.source === 'file' ? 'a file that was given' :
                                r.source ?? R.unknown
    ],
    R.known(r.seconds) ? ['time', R.seconds(r.seconds)] : null,
    ['its own error', floor || R.unknown],
    [
      'agreement of its two halves',
      a ?
          [
            a.text,
            R.known(a.p_value) ? `(chi² ${R.number(a.chi_square)} over ${
                                     R.integer(a.blocks)} blocks, p = ${R.number(a.p_value, 2)})` :
                                 ''
          ].filter(Boolean)
              .join(' ') :
          R.unknown
    ],
    [
      'scene',
      `${scene.file ?? R.unknown}, ${R.plain(scene.width)} × ${R.plain(scene.height)}, hash ${
          scene.hash ?? R.unknown}`
    ]
  ]);
}

function parameters() {
  return R.results().map(([index, t]) => {
    const given = R.techniques()[index] ?? {};
    const list = (kind) => make(
        'div', {}, make('h4', {}, `${kind} ${given[kind] ?? R.unknown}`),
        R.pairs(Object.entries(t.parameters?.[kind] ?? {}).map(([k, v]) => [k, R.plain(v)])));
    const settings =
        (given.settings ?? []).length ? `set: ${given.settings.join(', ')}` : 'all by default';
    return make(
        'details', {},
        make(
            'summary', {}, R.swatch(index),
            `${t.name}: ${given.integrator ?? R.unknown} under ${given.sampler ?? R.unknown}, ${
                settings}`),
        make('div', {class: 'columns'}, list('integrator'), list('sampler')));
  });
}

function machine() {
  const m = R.data.machine ?? {}, p = R.data.program ?? {}, s = R.data.settings ?? {};
  return R.pairs([
    ['program', `pssmlt ${p.version ?? R.unknown}`],
    ['libraries', R.plain(p.libraries ?? {}) || R.unknown],
    [
      'processor',
      `${m.processor ?? R.unknown}, ${R.plain(m.threads)} threads, ${R.bytes(m.memory_bytes)}`
    ],
    [
      'settings',
      `${R.seconds(s.seconds)} a technique and run, ${R.plain(s.runs)} runs, ${
          R.plain(s.snapshots)} snapshots, ${R.plain(s.threads)} threads, seed ${R.plain(s.seed)}`
    ],
    ['made', R.data.created ?? R.unknown]
  ]);
}

function metrics() {
  return R.pairs(
      R.metrics().map((m) => [m.name ?? m.id, [m.formula, m.note].filter(Boolean).join(' — ')]));
}

R.on('data scene theme', () => {
  const open = [...R.byId('provenance').querySelectorAll('details')].map((d) => d.open);
  R.byId('provenance')
      .replaceChildren(
          make('h3', {}, 'The command that repeats it'), command(),
          make('h3', {}, `Reference and scene: ${R.scene().name ?? R.unknown}`),
          reference(R.scene()), make('h3', {}, 'Parameters in full'), ...parameters(),
          make('h3', {}, 'Metrics'), metrics(), make('h3', {}, 'Machine and versions'), machine());
  R.byId('provenance').querySelectorAll('details').forEach((d, i) => {
    d.open = open[i] ?? false;
  });
});
})(window.pssmltReport);
