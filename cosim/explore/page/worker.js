"use strict";
/* The kernel in a thread of its own, so that the page moves however long a run takes.

   In: {kernel} once, the WebAssembly; then {run, values, speed, temperature, times, speeds, ...} for
   each run, of which the last one counts. Out, each with the run's number: {refused}, or {begun} with
   the geometry and the friction curve, {rows, events} one after the other, and {done}. */

let kernel = null;
let newest = 0;
const CHUNK_MS = 12; // between two answers
const turn = new MessageChannel();
let goOn = null;
turn.port1.onmessage = () => goOn && goOn();

onmessage = ({ data }) => {
  if (data.kernel) {
    kernel = new WebAssembly.Instance(new WebAssembly.Module(data.kernel)).exports;
    kernel._initialize();
    postMessage({ ready: true });
    return;
  }
  newest = data.run;
  begin(data);
};

function array(at, length) {
  return new Float64Array(kernel.memory.buffer, at, length);
}

function sentence(at) {
  const bytes = new Uint8Array(kernel.memory.buffer, at);
  return String.fromCharCode(...bytes.subarray(0, bytes.indexOf(0)));
}

function begin(asked) {
  const { run, sizes, speeds } = asked;
  array(kernel.values(), asked.values.length).set(asked.values);
  const inputs = array(kernel.inputs(), sizes.inputs);
  inputs.fill(0);
  inputs[sizes.speed] = asked.speed;
  inputs[sizes.temperature] = asked.temperature;
  const refused = sentence(kernel.begin());
  if (refused) {
    postMessage({ run, refused });
    return;
  }
  postMessage({
    run,
    begun: true,
    attachments: array(kernel.attachments(), 8).slice(),
    anchors: array(kernel.anchors(), 8).slice(),
    curve: Float64Array.from(speeds, (speed) => kernel.coefficient(speed)),
  });
  goOn = () => advance(asked, 0, 16);
  goOn();
}

/* Rows from a place on, as many as fit into a while; then the page and newer wishes have a turn. */
function advance(asked, from, guess) {
  const { run, times, sizes } = asked;
  goOn = null;
  if (run !== newest) return;
  const began = performance.now();
  const wanted = Math.min(guess, kernel.most_rows(), times.length - from);
  array(kernel.times(), wanted).set(times.subarray(from, from + wanted));
  const made = kernel.record(wanted);
  const rows = array(kernel.outputs(), made * sizes.row).slice();
  const events = array(kernel.events(), kernel.take_events() * sizes.event).slice();
  const next = from + made;
  const ended = made < wanted || next === times.length;
  postMessage({ run, rows, events, from }, [rows.buffer, events.buffer]);
  if (ended) {
    const reason = made < wanted
      ? `the run ended at t = ${kernel.reached()} s: ${sentence(kernel.why_not())}` : "";
    postMessage({ run, done: true, reason, energyAtStart: kernel.energy_at_start() });
    return;
  }
  const taken = Math.max(performance.now() - began, 0.1);
  const rate = Math.max(1, Math.round(Math.min(4 * wanted, (wanted * CHUNK_MS) / taken)));
  goOn = () => advance(asked, next, rate);
  turn.port2.postMessage(null);
}
