"use strict";
/* The models in a thread of their own, so that the page moves however long a run takes.

   In: {kernel, heat, blocks} once: both models, and belts and blocks as the second reads them. Then
   runs, {run, values, inputs, times, speeds, ...}, or surveys, {run, values, inputs, cells, ...}; the
   last one counts. Out, each with the run's number: {refused}, or {begun} with the geometry and the
   friction curve, {rows, events} one after the other, {done}, and the heat, {warmth} and {warmed}; of a
   survey {found}, a regime for each cell. */

let kernel = null, heat = null, blocks = [], newest = 0;
const CHUNK_MS = 12, MOST_ROWS = 1024; // between two answers
const turn = new MessageChannel();
let goOn = null;
turn.port1.onmessage = () => {
  const next = goOn;
  goOn = null; // the turn of work that has been let go may still come: nothing is done twice
  if (next) next();
};

onmessage = ({ data }) => {
  if (data.kernel) {
    [kernel, heat] = [data.kernel, data.heat].map((each) => new WebAssembly.Instance(each).exports);
    for (const each of [kernel, heat]) each._initialize();
    blocks = data.blocks;
    return;
  }
  newest = data.run;
  if (data.cells) survey(data);
  else begin(data);
};

const array = (model, at, length) => new Float64Array(model.memory.buffer, at, length);

function sentence(model, at) {
  const bytes = new Uint8Array(model.memory.buffer, at);
  return String.fromCharCode(...bytes.subarray(0, bytes.indexOf(0)));
}

function tell({ values, inputs }) {
  array(kernel, kernel.values(), values.length).set(values);
  array(kernel, kernel.inputs(), inputs.length).set(inputs);
}

/* Work on places up to a length, as many at once as fit into a while; then the page and newer wishes
   have a turn. work: from a place, so many; returns how many it did, fewer where it ends. */
function inChunks({ run }, length, work, ended, from = 0, guess = 4) {
  if (run !== newest) return;
  const began = performance.now();
  const wanted = Math.min(guess, MOST_ROWS, length - from);
  const made = work(from, wanted), next = from + made;
  if (made < wanted || next === length) {
    ended(made < wanted);
    return;
  }
  const taken = Math.max(performance.now() - began, 0.1);
  const rate = Math.max(1, Math.round(Math.min(4 * wanted, (wanted * CHUNK_MS) / taken)));
  goOn = () => inChunks({ run }, length, work, ended, next, rate);
  turn.port2.postMessage(null);
}

function begin(asked) {
  const { run, speeds, times } = asked;
  tell(asked);
  const refused = sentence(kernel, kernel.begin());
  if (refused) {
    postMessage({ run, refused });
    return;
  }
  postMessage({
    run,
    begun: true,
    attachments: array(kernel, kernel.attachments(), 8).slice(),
    anchors: array(kernel, kernel.anchors(), 8).slice(),
    curve: Float64Array.from(speeds, (speed) => kernel.coefficient(speed)),
  });
  asked.past = new Float64Array(4 * times.length);
  inChunks(asked, times.length, (from, count) => record(asked, from, count), (early) => {
    const reason = early
      ? `the run ended at t = ${kernel.reached()} s: ${sentence(kernel, kernel.why_not())}` : "";
    postMessage({ run, done: true, reason });
    warm(asked);
  });
}

function record({ run, times, sizes, places, past }, from, count) {
  array(kernel, kernel.times(), count).set(times.subarray(from, from + count));
  const made = kernel.record(count);
  const rows = array(kernel, kernel.outputs(), made * sizes.row).slice();
  const events = array(kernel, kernel.events(), kernel.take_events() * sizes.event).slice();
  for (let i = 0; i < made; i++) {
    past.set([times[from + i], ...places.map((place) => rows[i * sizes.row + place])], 4 * (from + i));
  }
  postMessage({ run, rows, events, from }, [rows.buffer, events.buffer]);
  return made;
}

/* Belt and ice, as the run that is there has warmed them. */
function warm({ run, past, times, sizes, warmed }) {
  if (!warmed) return;
  const block = blocks[warmed.block];
  new Uint8Array(heat.memory.buffer, heat.file(), block.length).set(block);
  array(heat, heat.parameters(), warmed.parameters.length).set(warmed.parameters);
  const wrong = sentence(heat, heat.read(block.length)) || sentence(heat, heat.begin(past[3]));
  if (wrong) {
    postMessage({ run, warmed: true, reason: wrong });
    return;
  }
  const there = times.findIndex((time, row) => row > 0 && past[4 * row] === 0);
  inChunks({ run }, there < 0 ? times.length : there, (from, count) => {
    array(heat, heat.rows(), 4 * count).set(past.subarray(4 * from, 4 * (from + count)));
    const made = heat.warm(count);
    const warmth = array(heat, heat.outputs(), made * sizes.warmth).slice();
    postMessage({ run, warmth, from }, [warmth.buffer]);
    return made;
  }, () => postMessage({ run, warmed: true, reason: sentence(heat, heat.why_not()) }));
}

/* The regimes of many speeds and dampings, in the order in which they are asked for. */
function survey({ run, values, inputs, cells, sizes, place, begin, end }) {
  inChunks({ run }, cells.length, (from, count) => {
    const found = cells.slice(from, from + count).map(([speed, damping]) => {
      inputs[sizes.speed] = speed;
      values[place] = damping;
      tell({ values, inputs });
      return kernel.regime(begin, end);
    });
    postMessage({ run, found, from });
    return count;
  }, () => {});
}
