// The page of `pssmlt stress`: totals, a table of cases by verdict, every run of every case. Uses
// the comparison report's core.js and table.js. Texts of the data become text nodes, never HTML.
'use strict';
(function(R) {
const data = JSON.parse(R.byId('data').textContent);
R.unknown = 'unknown';
const kinds = {
  'pass': 'pass',
  'FAIL': 'fail',
  'cannot see': 'blind'
};
const kindOf = (run) => kinds[run.verdict] ?? 'open';
const number = (v) => v === null || v === undefined ? '' : Number(v).toPrecision(2);

function counts(runs) {
  const n = {pass: 0, fail: 0, blind: 0, open: 0};
  for (const run of runs) n[kindOf(run)]++;
  return n;
}
const runsOf = (c) => c.points.flatMap((p) => p.runs);

function techniqueOf(run) {
  if (!run.integrator) return run.sampler || 'once';
  return `${run.sampler}(${run.integrator})`;
}

function banners() {
  const t = data.totals, box = R.byId('banners');
  const add = (kind, text) => box.append(R.make('p', {class: `banner ${kind}`}, text));
  if (t.fail > 0) add('bad', `${t.fail} runs failed.`);
  if (t.undecided > 0) {
    add('warn', `${t.undecided} runs were too noisy to decide in the time they had.`);
  }
  if (t.not_run > 0) add('warn', `${t.not_run} runs did not fit into the time.`);
}

function overview() {
  const titles = ['case', 'pass', 'fail', 'cannot see', 'undecided or not run'];
  const columns = titles.map((title) => ({title}));
  const rows = data.cases.map((c) => {
    const n = counts(runsOf(c));
    return {
      name: R.make('a', {href: `#case-${c.name}`}, `${c.group}. ${c.name}`),
      cells: [n.pass, {text: String(n.fail), strong: n.fail > 0}, n.blind, n.open].map(
          (cell) => typeof cell === 'number' ? String(cell) : cell)
    };
  });
  R.byId('overview').append(R.table('Runs by case', columns, rows));
}

const columns = [
  'value', 'technique', 'verdict', 'deviation', 'tolerance', 'dropped', 'speed', 'acceptance',
  'stuck', 'reason, or what the tolerance means'
];

function runRow(point, run) {
  const kind = kindOf(run);
  const cell = (text, attributes) => R.make('td', attributes, text);
  return R.make(
      'tr', {}, R.make('th', {scope: 'row'}, point.value), cell(techniqueOf(run)),
      cell(run.verdict, {class: kind}), cell(number(run.deviation)), cell(number(run.tolerance)),
      cell(String(run.dropped)), cell(number(run.relative_speed)), cell(number(run.acceptance)),
      cell(run.longest_stuck === null ? '' : String(run.longest_stuck)),
      cell([...new Set([run.reason, run.meaning])].filter(Boolean).join('\n'), {class: 'reason'}));
}

function caseDetails(c) {
  const n = counts(runsOf(c));
  const body = R.make('div', {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': c.name});
  const element = R.make(
      'details', {class: n.fail > 0 ? 'case fail' : 'case', id: `case-${c.name}`},
      R.make(
          'summary', {}, R.make('b', {}, `${c.group}. ${c.name}`), c.about,
          R.make(
              'span', {class: 'faint'},
              `${n.pass} pass, ${n.fail} fail, ${n.blind} cannot see, ` +
                  `${n.open} open`)),
      body);
  // Made when it is opened: the full grid has thousands of rows.
  element.addEventListener('toggle', () => {
    if (body.firstChild !== null) return;
    const head = R.make('tr', {}, columns.map((title) => R.make('th', {scope: 'col'}, title)));
    const rows = c.points.flatMap((p) => p.runs.map((run) => runRow(p, run)));
    body.append(R.make('table', {}, R.make('thead', {}, head), R.make('tbody', {}, rows)));
  });
  element.open = n.fail > 0;
  return element;
}

function openTarget() {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (target !== null && target.tagName === 'DETAILS') target.open = true;
}

function theme() {
  const button = R.byId('theme');
  button.addEventListener('click', () => {
    const dark = button.getAttribute('aria-pressed') !== 'true';
    button.setAttribute('aria-pressed', String(dark));
    document.documentElement.dataset.theme = dark ? 'dark' : 'light';
  });
  if (matchMedia('(prefers-color-scheme: dark)').matches) button.click();
}

const t = data.totals;
R.byId('subtitle').textContent =
    `${data.cases.length} cases, ${Math.round(data.seconds)} s, ${data.time}`;
R.byId('headline').textContent = `${t.pass} pass, ${t.fail} fail, ${t.cannot_see} cannot see the ` +
    `light, ${t.undecided} undecided, ${
                                     t.not_run} not run. A run of the whole grid fails by chance ` +
    `with a probability below ${data.false_alarm}.`;
banners();
overview();
R.byId('case-list').append(...data.cases.map(caseDetails));
R.byId('provenance').append(R.pairs([
  ['Command', data.command], ['Program', JSON.stringify(data.program)],
  ['Machine', JSON.stringify(data.machine)]
]));
theme();
addEventListener('hashchange', openTarget);
openTarget();
})(window.pssmltReport);
