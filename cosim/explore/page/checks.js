"use strict";
/* What is wrong with a scenario, in the words of `stickslip simulate`. What the kernel refuses it
   says itself, in the same words; here is what is checked before it comes to the kernel. */

const BOUNDS = {
  gt: (value, bound) => value > bound, ge: (value, bound) => value >= bound,
  lt: (value, bound) => value < bound, le: (value, bound) => value <= bound,
};
const MOST_ROWS = 1e7; // of a run
const KEEPABLE = 2e5; // rows that a page takes

/* The first fault of any single key; "" where there is none. */
function outOfBounds(scenario) {
  for (const control of CONTROLS.values()) {
    const { key } = control, value = scenario.get(key);
    const text = typeof value === "number" ? boundFault(control, value) : listFault(control, value);
    if (text) return { key, text };
  }
  return null;
}

function boundFault(control, value) {
  const { max_length, ...ends } = control.bounds;
  const [bounds, what] = control.kind === "inertia" ? [{ gt: 0 }, "not possible"] : [ends, "out of range"];
  const fits = Object.entries(bounds).every(([kind, bound]) => BOUNDS[kind](value, bound));
  return fits ? "" : `${control.key}: ${what} (${value}), allowed is ${control.allowed}`;
}

function listFault(control, value) {
  if (control.kind !== "list") return "";
  const most = control.bounds.max_length ?? Infinity;
  const few = control.default.length > 0 && value.length < control.default.length;
  const many = value.length > (control.default.length || most);
  if (!few && !many) return value.map((entry) => boundFault(control, entry)).find(Boolean) ?? "";
  const what = `has too ${few ? "few" : "many"} entries ([${value.join(", ")}])`;
  return `${control.key}: ${what}, allowed is ${control.allowed}`;
}

/* Keys that do not go together, as far as the kernel does not say so; null where all do. */
function contradiction(scenario) {
  const get = (key) => scenario.get(key);
  const slab = get("rig.surface") === "slab";
  if (!get("rig.degrees_of_freedom").includes("x")) {
    return fault("rig.degrees_of_freedom", 'must contain "x"');
  }
  if (slab && Math.abs(get("rig.slab_radius")) <= get("rig.contact_radius")) {
    return fault("rig.slab_radius", `${g(get("rig.slab_radius"))} m puts the slab's centre under the ` +
      `block; allowed is a distance above contact_radius = ${g(get("rig.contact_radius"))} m`);
  }
  for (const [table, one, other] of [["springs", "force_curve_extension", "force_curve_force"],
    ["friction", "table_speed", "table_mu"]]) {
    const [ours, theirs] = [one, other].map((name) => get(`${table}.${name}`).length);
    if (ours !== theirs) {
      return fault(`${table}.${one}`, `has ${ours} values and ${other} has ${theirs}: allowed is the same number`);
    }
  }
  if (slab && get("turning_surface.curvature") !== 0) {
    return fault("rig.surface", '"slab" already sets turning_surface.curvature to 1/slab_radius; ' +
      "give one of the two");
  }
  return tooFine(scenario);
}

/* Rows of a run: as many as it may have, and as a page can keep. */
function tooFine(scenario) {
  const [duration, interval] = ["run.duration", "run.output_interval"].map((key) => scenario.get(key));
  const beyond = [
    [MOST_ROWS, `steps, allowed is at least ${g(duration / MOST_ROWS)} s`],
    [KEEPABLE, "rows, which is too much for a page; stickslip simulate takes it"],
  ].find(([most]) => duration / interval > most);
  return beyond ? fault("run.output_interval", `${g(interval)} s cuts run.duration = ${g(duration)} s ` +
    `into more than ${beyond.join(" ")}`) : null;
}

/* What the kernel does not mind and a run is refused for all the same; null if nothing. */
function refusedBeside(scenario) {
  const speed = Math.abs(scenario.get("surface.speed"));
  const creep = scenario.get("friction.stick_creep");
  if (speed === 0 || speed > creep) return null;
  return fault("friction.stick_creep", `${g(creep)} m/s is not below surface.speed = ${g(speed)} ` +
    "m/s: the contact would creep as fast as the surface, and stick while it slides; allowed is " +
    "less than the surface's speed");
}

/* What is allowed and should be known; "" if nothing. */
function remarks(scenario) {
  const get = (key) => scenario.get(key), said = [];
  const name = get("friction.table_speed").length > 0 ? "table_mu" : "mu_k";
  const [atRest] = [get(`friction.${name}`)].flat();
  if (atRest > get("friction.mu_s")) {
    said.push(`friction.${name} = ${g(atRest)} exceeds friction.mu_s = ${g(get("friction.mu_s"))}: ` +
      `the contact then holds up to ${name}`);
  }
  const [natural, installed] = [get("rig.spring_natural_length"), get("rig.spring_length")];
  if (natural > installed && get("rig.degrees_of_freedom").length > 1) {
    said.push(`rig.spring_natural_length = ${g(natural)} m exceeds rig.spring_length = ` +
      `${g(installed)} m: the springs push, and the rest position is unstable sideways`);
  }
  return said.join("; ");
}

const fault = (key, rest) => ({ key, text: `${key}: ${rest}` });

/* The kernel's sentence, `key = value ...`, as it is told: `key: value ...`. */
function kernelFault(sentence) {
  const found = /^([\w.]+) (?:= )?(.*)$/s.exec(sentence);
  if (found && CONTROLS.has(found[1])) return fault(found[1], found[2]);
  return { key: "", text: sentence };
}

/* A number as C writes it by %g: six digits, no zeros behind them. */
function g(value) {
  const [digits, power] = value.toExponential(5).split("e").map(Number);
  if (power >= -4 && power < 6) return String(Number(value.toPrecision(6)));
  return `${digits}e${power < 0 ? "-" : "+"}${String(Math.abs(power)).padStart(2, "0")}`;
}
