// Follows a comparison that runs: served by it, not part of the page on disk. An event source says
// what is being done and which data there are; they are asked for one at a time, so that a slow
// browser leaves some out instead of falling behind.
'use strict';
(function(R) {
const make = R.make;
let token = '', status = {data: 0};
let loaded = 0, loading = false, ended = false;
const pictures = new Map();  // id -> what its file holds

const stateLine = make('p', {id: 'live-state', role: 'status'}, 'connecting');
const stopButton =
    make('button', {type: 'button', id: 'live-stop', disabled: true}, 'Stop and write');
const fraction =
    make('progress', {id: 'live-fraction', max: 1, value: 0, 'aria-label': 'share that is done'});
const numbers = make('p', {id: 'live-numbers', class: 'note'});
const yes = make('button', {type: 'button', id: 'live-yes'}, 'Stop');
const no = make('button', {type: 'button', id: 'live-no', autofocus: true}, 'Go on');
const confirm = make(
    'dialog', {id: 'live-confirm'},
    make(
        'p', {},
        'Stop the comparison? The round is finished, then the report of what there is ' +
            'is written; --resume continues.'),
    make('div', {class: 'bar'}, yes, no));
R.byId('live').append(
    make('div', {class: 'bar'}, stateLine, stopButton), fraction, numbers, confirm);
R.byId('live').hidden = false;
document.querySelector('main').hidden = true;  // until there is a scene

// --- what is being done ------------------------------------------------------------------------

const states = {
  checking: () => 'checking scenes and techniques',
  loading: () => 'loading the scene',
  reference: () => 'making the reference',
  running: (s) => `run ${s.run} of ${s.runs}`,
};

function stateText(s) {
  if (s.final) {
    const done = s.exit_code ? 'Stopped' : 'Finished';
    return `${done}; the report is in ${s.report}`;
  }
  const where = s.scenes > 1 ? `${s.scene} (scene ${s.number} of ${s.scenes})` : s.scene;
  return `${where}: ${states[s.state]?.(s) ?? s.state}`;
}

function techniqueText(t, of) {
  const error =
      R.known(t.relmse) ? `, relMSE ${R.number(t.relmse)} at ${R.seconds(t.seconds)}` : '';
  const estimate = R.known(t.estimate) ? ` (estimated ${R.number(t.estimate)})` : '';
  return `${t.name}: ${R.seconds(t.elapsed)} of ${R.seconds(of)}${error}${estimate}`;
}

function numbersText(s) {
  if (s.final) return [];
  if (s.techniques) return s.techniques.map((t) => techniqueText(t, s.of));
  return R.known(s.seconds) ? [`${R.seconds(s.seconds)} of ${R.seconds(s.of)}`] : [];
}

function showStatus(s) {
  status = s;
  const text = stateText(s);
  if (stateLine.textContent !== text) stateLine.textContent = text;  // it is read out
  numbers.replaceChildren(...numbersText(s).map((line) => make('span', {}, line)));
  fraction.value = s.fraction ?? 0;
  stopButton.disabled = s.final || !token;
  loadData();
}

// --- data --------------------------------------------------------------------------------------

// [id, what its file holds]: a picture is written anew if it was not to be the last one and is.
const picturesOf = (data) =>
    (data.scenes ?? [])
        .flatMap(
            (scene) =>
                [...(scene.techniques ?? [])
                     .flatMap((t) => t.images ?? [])
                     .map((i) => [i.image, `${token} ${i.seconds} ${i.precision}`]),
                 ...(scene.reference?.image ? [[scene.reference.image, token]] : []),
]);

async function show(data) {
  for (const [id, content] of picturesOf(data)) {
    if (pictures.has(id) && pictures.get(id) !== content) {
      await R.loadImage(id).catch(() => {});  // what is on its way may be the old one
      R.forget(id);
    }
    pictures.set(id, content);
  }
  const main = document.querySelector('main');
  if (main.hidden && data.scenes?.length) {
    R.set({a: 1, b: -1, mode: 'slider'});  // chosen anew, now that there is what to choose from
    main.hidden = false;
  }
  R.update(data);
}

async function loadData() {
  if (loading) return;
  loading = true;
  try {
    while (loaded < status.data) {
      const version = status.data, run = token;
      const reply = await fetch('data.json');
      if (!reply.ok) break;
      await show(await reply.json());
      if (run === token) loaded = version;
    }
  } catch (error) {
    numbers.textContent = String(error);
  }
  loading = false;
  end();
}

// --- the stop button ---------------------------------------------------------------------------

async function stop() {
  confirm.close();
  stopButton.disabled = true;
  const reply = await fetch('stop', {method: 'POST', headers: {'Pssmlt-Token': token}});
  if (!reply.ok) stateLine.textContent = 'not stopped: ' + await reply.text();
}
stopButton.addEventListener('click', () => confirm.showModal());
yes.addEventListener('click', stop);
no.addEventListener('click', () => confirm.close());

// --- events ------------------------------------------------------------------------------------

const source = new EventSource('events');

// All is here when the comparison is over and so are the pictures: then the program may end.
async function end() {
  if (!status.final || loading || loaded < status.data || ended) return;
  ended = true;
  for (const id of pictures.keys()) await R.loadImage(id).catch(() => {});
  source.close();
}

source.addEventListener('hello', (event) => {
  const before = token;
  token = JSON.parse(event.data).token;
  if (before !== token) loaded = 0;  // the first one, or another comparison at the same port
});
source.addEventListener('status', (event) => showStatus(JSON.parse(event.data)));
source.addEventListener('error', () => {
  stopButton.disabled = true;
  if (status.final)
    source.close();
  else
    stateLine.textContent = 'the connection is lost; trying again';
});
R.live = {
  closed: () => source.readyState === EventSource.CLOSED,
  version: () => loaded
};
})(window.pssmltReport);
