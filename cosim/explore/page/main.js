"use strict";
/* The page: what is turned becomes a run, what the run gives is shown, frame by frame.

   `explorer` is what the console and other scripts may use: `explorer.run` (time, column(name),
   events, state, reason), `explorer.set(key, value)`, and the calls below. */

const byId = (id) => document.getElementById(id);
const explorer = {
  scenario: null, // as it is turned
  run: null, // the newest run
  seen: null, // the run that is shown: the newest that has rows
  kept: null, // for comparison
  moment: null, // that is shown, s
  range: null, // of time that is shown, s
  frames: 0, // since the page began
  pending: false, // whether something was turned since the last run was wished for
  renewals: 0, // how often it has been wished for, or refused
};

explorer.start = async function () {
  const models = {
    kernel: await WebAssembly.compile(await unpacked(DATA.kernel)),
    heat: await WebAssembly.compile(await unpacked(DATA.heat)),
    blocks: await Promise.all(DATA.presets.map(async ({ heat }) => new Uint8Array(await unpacked(heat.block)))),
  };
  explorer.runs = new Runs(models, heard);
  explorer.map = new RegimeMap(byId("regimes"), byId("legend"), models, explorer.set);
  explorer.pictures = new Pictures();
  explorer.top = new TopView(byId("top"));
  explorer.controls = new Controls(byId("groups"), explorer.set, refuse);
  preparePlayer();
  prepareBar();
  const { scenario, strange } = ofAddress(location.hash, DATA.presets[DATA.chosen]);
  explorer.scenario = scenario;
  if (strange.length) say(`not understood in the address: ${strange.join(", ")}`);
  changed();
  requestAnimationFrame(frame);
};

/* Base64 of what zlib has packed. */
async function unpacked(text) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

/* --- from the controls to a run ----------------------------------------------------------------- */

/* A key's new value; undefined: what it began with. */
explorer.set = function (key, value = explorer.scenario.begun(key)) {
  explorer.scenario.set(key, value);
  changed();
};

let addressing = null;

/* The scenario is another one: once a frame is as often as anybody sees. */
function changed() {
  if (explorer.pending) return;
  explorer.pending = true;
  requestAnimationFrame(() => {
    explorer.pending = false;
    explorer.renewals++;
    renew();
  });
}

function renew() {
  const { scenario } = explorer;
  const wrong = outOfBounds(scenario) || contradiction(scenario);
  showScenario(wrong ? wrong.key : "");
  if (wrong) refuse(wrong.key, wrong.text);
  else explorer.run = explorer.runs.wish(scenario.copy());
}

function showScenario(wrong) {
  const { scenario, controls } = explorer;
  controls.show(scenario, wrong);
  byId("name").value = scenario.name;
  byId("preset").value = DATA.presets.indexOf(scenario.preset);
  clearTimeout(addressing);
  addressing = setTimeout(showAddress, 250); // browsers mind an address that changes all the time
}

function showAddress() {
  try {
    history.replaceState(null, "", addressOf(explorer.scenario));
  } catch {
    // a browser that keeps a file's address as it is; "Copy link" has it all the same
  }
}

/* Something is not allowed: the motion before it stays. */
function refuse(key, text) {
  explorer.run = null;
  show(byId("fault"), text);
  show(byId("remark"), "");
  const row = explorer.controls.rows.get(key);
  if (row) {
    row.input.setAttribute("aria-invalid", "true");
    row.state = null; // to be shown anew, whatever comes
  }
  document.body.classList.add("refused");
}

function show(place, text) {
  Object.assign(place, { textContent: text, hidden: !text });
}

const say = (text) => (byId("done").textContent = text);

/* --- from a run to the page ----------------------------------------------------------------------- */

let stale = true; // the plots are older than what there is to plot

function heard(run, message) {
  if (run !== explorer.run) return;
  const beside = message.begun && refusedBeside(run.scenario);
  const wrong = run.state === "refused" ? kernelFault(run.reason) : beside;
  if (beside) explorer.runs.current = null;
  if (wrong) {
    refuse(wrong.key, wrong.text);
    return;
  }
  if (message.begun) {
    document.body.classList.remove("refused");
    show(byId("fault"), "");
    show(byId("remark"), remarks(run.scenario));
  }
  if (run.rows > 0) explorer.seen = run;
  if (run.state === "done" && run.reason) show(byId("fault"), run.reason);
  if (message.warmed || (message.done && run.heat.why)) explorer.map.wish(run);
  stale = true;
}

/* --- the moment that is shown ---------------------------------------------------------------------- */

const player = { playing: false, moment: 0, last: 0, computed: null, since: 0 };

function preparePlayer() {
  player.playing = !window.matchMedia("(prefers-reduced-motion: reduce)").matches;
  byId("play").addEventListener("click", () => play(!player.playing));
  byId("moment").addEventListener("input", (event) => {
    play(false);
    player.moment = (Number(event.target.value) / 1000) * endOf(explorer.seen);
  });
  byId("span").addEventListener("change", () => (stale = true));
  new ResizeObserver(() => (stale = true)).observe(byId("x"));
  for (const event of ["beforeprint", "afterprint"]) addEventListener(event, fit);
  play(player.playing);
}

/* Drawn anew at once: paper has another width, and waits for no frame. */
function fit() {
  const run = explorer.seen;
  if (!run) return;
  redraw(run, shownRange(run, explorer.moment));
  showMoment(run, explorer.moment);
}

function play(on) {
  player.playing = on;
  press(byId("play"), on, on ? "Pause" : "Play");
}

function press(button, on, words) {
  button.setAttribute("aria-pressed", String(on));
  button.textContent = words;
}

const endOf = (run) => run?.time.at(-1) ?? 0;

function frame(now) {
  requestAnimationFrame(frame);
  explorer.frames++;
  showProgress(now);
  const run = explorer.seen, passed = Math.min((now - player.last) / 1000, 0.1);
  player.last = now;
  if (!run) return;
  if (player.playing) {
    player.moment += passed * Number(byId("pace").value);
    if (player.moment > endOf(run)) player.moment = 0;
  }
  const moment = Math.min(player.moment, run.time[run.rows - 1]), range = shownRange(run, moment);
  if (moment === explorer.moment && !stale) return; // a page at rest costs nothing
  explorer.moment = moment;
  if (stale || !same(range, explorer.range)) redraw(run, range);
  showMoment(run, moment);
}

const QUICK_MS = 400; // what takes no longer need not be told of

/* How far a run is that takes its time. */
function showProgress(now) {
  const run = explorer.run;
  if (run !== player.computed) Object.assign(player, { computed: run, since: now });
  const slow = ["wished", "begun"].includes(run?.state) && now - player.since > QUICK_MS;
  const text = slow ? `computing, ${Math.floor((100 * run.rows) / run.time.length)} %` : "";
  if (byId("progress").textContent !== text) byId("progress").textContent = text;
}

function showMoment(run, moment) {
  const state = stateAt(run, moment), said = `${moment.toFixed(2)} s`, slider = byId("moment");
  explorer.pictures.show(run, moment, state);
  explorer.top.show(run, state);
  if (document.activeElement !== slider) slider.value = (1000 * moment) / (endOf(run) || 1);
  slider.setAttribute("aria-valuetext", said);
  byId("clock").textContent = said;
  byId("ledger").textContent = ledger(state);
}

/* Times that are shown, s: a page of so many seconds is turned when the moment leaves it. */
function shownRange(run, moment) {
  const end = endOf(run), choice = byId("span").value;
  if (choice === "all") return [0, end];
  if (choice === "late") return [Math.min(run.rampEnd, end * 0.999), end];
  const length = Math.min(Number(choice), end), begin = Math.floor(moment / length) * length;
  return [begin, begin + length];
}

function redraw(run, range) {
  explorer.pictures.draw(run, explorer.kept, range);
  explorer.map.show();
  byId("cold").textContent = run.heat.why ? `No heat from here on: ${run.heat.why}.` : "";
  explorer.range = range;
  stale = false;
  showStatistics(run);
}

/* Numbers of a moment: between two rows on a straight line. */
function stateAt(run, moment) {
  const low = live.placeOf(run.time.subarray(0, run.rows), moment), high = Math.min(low + 1, run.rows - 1);
  const span = run.time[high] - run.time[low];
  const part = span > 0 ? Math.min(Math.max((moment - run.time[low]) / span, 0), 1) : 0;
  const between = (name) => (1 - part) * run.at(name, low) + part * run.at(name, high);
  const state = Object.fromEntries(Object.keys(DATA.outputs).map((name) => [name, between(name)]));
  return { ...state, mode: run.at("mode", part < 0.5 ? low : high) };
}

/* The energy ledger in one line: what came in, and where it is. */
function ledger(now) {
  const came = now.surface_work + now.external_work;
  const small = 1e-9 * Math.max(Math.abs(came), now.heat); // below that it is rounding
  const joules = (value) => `${live.told(Math.abs(value) < small ? 0 : value)} J`;
  const gained = came - now.heat - now.damping_heat + now.energy_residual;
  return `Work of the surface ${joules(came)} = friction heat ${joules(now.heat)} + damping ` +
    `${joules(now.damping_heat)} + gained by block and springs ${joules(gained)}; residual ` +
    joules(now.energy_residual);
}

/* --- numbers --------------------------------------------------------------------------------------- */

explorer.statistics = (run = explorer.seen) => statistics(run);

function showStatistics(run) {
  const numbers = statistics(run), before = explorer.kept && statistics(explorer.kept);
  const mm = (value) => `${live.told(MM * value, 3)} mm`;
  const rows = [
    ["the block", (n) => regime(n)],
    ["stick-slip frequency", (n) => `${live.told(n.mean_period ? 1 / n.mean_period : 0, 3)} Hz`],
    ["break-aways", (n) => `${n.break_aways} in ${live.told(n.duration, 4)} s`],
    ["share in slip", (n) => `${live.told(100 * n.slip_share, 3)} %`],
    ["x, mean", (n) => mm(n.mean_x)],
    ["x, from … to", (n) => `${live.told(MM * n.min_x, 3)} … ${mm(n.max_x)}`],
    ["y, from … to", (n) => `${live.told(MM * still(n.min_y), 3)} … ${mm(still(n.max_y))}`],
    ["largest rotation", (n) => `${live.told(still(n.max_rotation_deg), 3)}°`],
    ["friction heat, mean", (n) => `${live.told(n.mean_heat_flow, 3)} W`],
    ["interface, warmest", (n, of) => `${live.told(warmest(of), 4)} °C`],
  ];
  const entries = rows.map(([name, text]) => {
    const parts = [live.element("dt", {}, name), live.element("dd", {}, text(numbers, run))];
    if (before) parts.push(live.element("dd", { class: "kept" }, `kept: ${text(before, explorer.kept)}`));
    return live.element("div", {}, ...parts);
  });
  byId("statistics").replaceChildren(...entries);
  const all = run.rows === run.time.length;
  for (const [id, what] of [["x", "x"], ["y", "y"], ["phi", "rotation"]]) {
    byId(id).setAttribute("aria-label", `${what} over time: the block ${regime(numbers)}${all ? "" : ", still computing"}`);
  }
}

function warmest(run) {
  return extremes(run, "interface_temperature", { from: 0, to: run.warmed }).max_interface_temperature;
}

/* Rounding is nothing. */
const still = (value) => (Math.abs(value) < 1e-9 ? 0 : value);

/* --- presets, files, links ------------------------------------------------------------------------ */

/* The file that "Save as scenario" gives, what "Copy link" puts behind the #, the kernel's `v`. */
explorer.toml = () => toml(explorer.scenario);
explorer.address = () => addressOf(explorer.scenario);
explorer.python = () => python(explorer.scenario);
explorer.values = () => kernelValues(explorer.scenario);

/* What a text means for a key, as it is typed; undefined for what is no value of it. */
explorer.read = (key, text) => valueOfText(CONTROLS.get(key), text);

function prepareBar() {
  DATA.presets.forEach((each, i) => byId("preset").append(live.element("option", { value: i }, each.name)));
  const link = () => location.href.replace(/#.*$/, "") + explorer.address();
  for (const [id, call] of Object.entries({
    reset: () => begin(explorer.scenario.preset), freeze: keep, save,
    share: () => copy(link(), "a link that opens this page with these numbers"),
    "copy-toml": () => copy(explorer.toml(), "a scenario file"),
    "copy-python": () => copy(explorer.python(), "Python that gives this motion"),
  })) byId(id).addEventListener("click", call);
  byId("preset").addEventListener("change", (event) => begin(DATA.presets[event.target.value]));
  byId("name").addEventListener("change", (event) => rename(event.target.value));
  byId("find").addEventListener("input", (event) => explorer.controls.find(event.target.value));
  window.addEventListener("hashchange", (event) => {
    // the address may have been written over since
    const hash = event.newURL ? new URL(event.newURL).hash : location.hash;
    explorer.scenario = ofAddress(hash, explorer.scenario.preset).scenario;
    changed();
  });
}

function begin(preset) {
  explorer.scenario = new Scenario(preset);
  say("");
  changed();
}

/* The run that is seen stays, in grey; once more: it goes. */
function keep() {
  explorer.kept = explorer.kept ? null : explorer.seen;
  press(byId("freeze"), Boolean(explorer.kept), explorer.kept ? "Drop comparison" : "Keep for comparison");
  stale = true;
}

/* A name is also that of a folder: what every file system takes. */
function rename(name) {
  const isOne = /^[^\s./\\:*?"<>|\x00-\x1f][^/\\:*?"<>|\x00-\x1f]*$/.test(name);
  if (isOne) explorer.scenario.name = name;
  say(isOne ? "" : 'a name has 1 to 100 characters without /\\:*?"<>|, a dot or a space not first');
}

function save() {
  const { scenario } = explorer;
  if (document.body.classList.contains("refused")) {
    say("not saved: what is said above is not allowed");
    return;
  }
  const address = URL.createObjectURL(new Blob([toml(scenario)], { type: "application/toml" }));
  const link = live.element("a", { href: address, download: `${scenario.name}.toml` });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
  say(`saved as ${scenario.name}.toml: stickslip simulate ${scenario.name}.toml`);
}

async function copy(text, said) {
  try {
    await navigator.clipboard.writeText(text);
    say(`copied: ${said}`);
  } catch {
    say(text);
  }
}

window.explorer = explorer;
explorer.start().catch((error) => {
  show(byId("fault"), `the kernel does not run in this browser: ${error.message}`);
});
