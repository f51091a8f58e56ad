"use strict";
/* A scenario as the page holds it, the kernel's numbers that it stands for, and its TOML. */

const DATA = JSON.parse(document.getElementById("data").textContent);

// Key -> its control, of everything that can be turned.
const CONTROLS = new Map();
for (const group of DATA.groups) for (const each of group.controls) CONTROLS.set(each.key, each);

const GRAVITY = 9.81; // m/s2
const FREEDOM = ["x", "y", "phi"];
// Keys that make another belt or block, of which the page has none.
const OF_BLOCK = ["rig.contact_radius", "rig.surface", "rig.slab_radius"];

/* Keys whose values differ from the plain model are in `tables`; also those of belt, ice and
   coupling, which the page does not show and a saved scenario keeps. */
class Scenario {
  constructor(preset) {
    this.preset = preset;
    this.name = preset.name;
    this.tables = structuredClone(preset.tables);
  }

  /* As it is now, whatever is turned then. */
  copy() {
    const { name, tables, preset } = this;
    return Object.assign(new Scenario(preset), { name, tables: structuredClone(tables) });
  }

  get(key) {
    return valueIn(this.tables, key);
  }

  set(key, value) {
    const [table, name] = parted(key);
    (this.tables[table] ??= {})[name] = value;
  }

  /* What the scenario was begun with. */
  begun(key) {
    return valueIn(this.preset.tables, key);
  }

  /* Keys that have another value than at the beginning. */
  changed() {
    return [...CONTROLS.keys()].filter((key) => !same(this.get(key), this.begun(key)));
  }
}

function valueIn(tables, key) {
  const [table, name] = parted(key);
  return tables[table]?.[name] ?? CONTROLS.get(key).default;
}

function parted(key) {
  const at = key.indexOf(".");
  return [key.slice(0, at), key.slice(at + 1)];
}

const same = (one, other) => JSON.stringify(one) === JSON.stringify(other);

/* --- the kernel's numbers ------------------------------------------------------------------ */

/* The kernel's array `v`: what `Parameters.flat` of the Python package is, in its order. */
function kernelValues(scenario) {
  return Float64Array.from(DATA.names, (name) => kernelValue(scenario, name));
}

function kernelValue(scenario, name) {
  const element = /^(.*)\[(\d+)\]$/.exec(name);
  if (element) return ofList(scenario.get(element[1]), Number(element[2]) - 1);
  const freedom = /^rig\.free_(.*)$/.exec(name);
  if (freedom) return Number(scenario.get("rig.degrees_of_freedom").includes(freedom[1]));
  if (name === "rig.inertia") return inertia(scenario);
  const turns = name === "turning_surface.curvature" && scenario.get("rig.surface") === "slab";
  return turns ? 1 / scenario.get("rig.slab_radius") : scenario.get(name);
}

function kernelInputs(scenario) {
  const { inputs: count, speed, temperature } = DATA.sizes, inputs = new Float64Array(count);
  inputs[speed] = scenario.get("surface.speed");
  inputs[temperature] = scenario.get("ambient.temperature_degC");
  return inputs;
}

/* Of belt and ice: the preset that their matrices are of, and the parameters of the unit; or why there
   are none. */
function heatOf(scenario) {
  const { heat, tables } = scenario.preset;
  const other = OF_BLOCK.find((key) => !same(scenario.get(key), scenario.begun(key)));
  if (heat.why) return { why: heat.why };
  if (other) return { why: `${other} is not that of the scenario, whose belt and block the page has` };
  const parameters = { ...heat.parameters };
  parameters["ambient.temperature_degC"] = scenario.get("ambient.temperature_degC");
  if (!tables.contact?.load) parameters["contact.load"] = GRAVITY * scenario.get("rig.mass");
  return { block: DATA.presets.indexOf(scenario.preset), parameters: Object.values(parameters), why: "" };
}

/* 0 stands for a disc, by the kernel's own rule. */
function inertia(scenario) {
  const said = scenario.get("rig.inertia");
  if (said === "disc") return 0;
  if (said === "ring") return scenario.get("rig.mass") * scenario.get("rig.attachment_radius") ** 2;
  return said;
}

/* Unused places of a curve repeat its last value, which ends it. */
const ofList = (list, place) => list[Math.min(place, list.length - 1)] ?? 0;

/* --- the file ------------------------------------------------------------------------------ */

/* The text of a file that `stickslip` reads: what departs from the plain model. */
function toml(scenario) {
  const lines = [
    "# Made by the explorer. SI units; what is left out is as in the plain model, its effects off.",
    "#",
    "#   stickslip simulate FILE    gives this motion",
    "#   stickslip run FILE         the same with the heat in belt and ice",
    "",
  ];
  lines.push(...Object.entries({ ...scenario.preset.top, name: scenario.name }).map(tomlRow));
  for (const [table, entries] of Object.entries(scenario.tables)) {
    const rows = Object.entries(entries).filter(([name, value]) => departs(table, name, value));
    if (rows.length) lines.push("", `[${table}]`, ...rows.map(tomlRow));
  }
  return lines.join("\n") + "\n";
}

const tomlRow = ([name, value]) => `${name} = ${tomlValue(value)}`;

/* What was set, and set back to the plain model's, need not be said. */
function departs(table, name, value) {
  const control = CONTROLS.get(`${table}.${name}`);
  return !control || !same(value, control.default);
}

function tomlValue(value) {
  if (Array.isArray(value)) return `[${value.map(tomlValue).join(", ")}]`;
  if (typeof value === "string") return JSON.stringify(value).replace(/\x7f/g, "\\u007f");
  if (typeof value === "object") return `{ ${Object.entries(value).map(tomlRow).join(", ")} }`;
  return String(value); // of a number, the shortest digits that give it back
}

/* The same for whoever goes on in Python. */
function python(scenario) {
  const text = toml(scenario).replace(/^#.*\n/gm, "").trim();
  return `import tomllib

from cosim import Scenario, simulate_scenario

scenario = Scenario.from_tables(tomllib.loads(r"""
${text}
"""))
run = simulate_scenario(scenario)
run.plot("motion")
`;
}

/* --- the address --------------------------------------------------------------------------- */

/* What was changed, behind the # of the page's address. */
function addressOf(scenario) {
  const parts = [["preset", scenario.preset.name]];
  for (const key of scenario.changed()) {
    const value = scenario.get(key);
    parts.push([key, typeof value === "number" ? String(value) : JSON.stringify(value)]);
  }
  return `#${parts.map(([key, text]) => `${key}=${encodeURIComponent(text)}`).join("&")}`;
}

/* The scenario of an address, and what of it was not understood. */
function ofAddress(hash, begin) {
  const said = hash.replace(/^#/, "").split("&").filter(Boolean).map((part) => {
    const at = part.indexOf("=");
    return [part.slice(0, at), decoded(part.slice(at + 1))];
  });
  const named = said.find(([key]) => key === "preset")?.[1];
  const preset = DATA.presets.find((each) => each.name === named);
  const scenario = new Scenario(preset || begin), strange = [];
  for (const [key, text] of said) {
    const value = key === "preset" ? preset : ofText(CONTROLS.get(key), text);
    if (value === undefined) strange.push(`${key}=${text}`);
    else if (key !== "preset") scenario.set(key, value);
  }
  return { scenario, strange };
}

function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/* The value of a control from JSON; undefined for what it cannot be. Bounds are checked later. */
function ofText(control, text) {
  let value;
  try {
    value = JSON.parse(text);
  } catch {
    return undefined;
  }
  if (!control || Array.isArray(value) !== Array.isArray(control.default)) return undefined;
  if (control.kind === "freedom") return value.every((each) => FREEDOM.includes(each)) ? value : undefined;
  if (control.kind === "choice") return control.choices.includes(value) ? value : undefined;
  return valueOfText(control, textOf(value));
}
