"use strict";
/* A row for each key: name, slider, number, and a way back. Groups fold. */

const STEPS = 1000; // of a slider
const ENTERS = { friction: "Effects of friction", contact: "Effects of the contact at rest", springs: "Effects of the springs", surface: "Effects of the surface" };

class Controls {
  /* turned: called with a key and its new value; refused: with a key and what is wrong. */
  constructor(place, turned, refused) {
    Object.assign(this, { place, turned, refused, rows: new Map(), folds: [] });
    // what is no effect enters nowhere, and comes first
    for (const kind of new Set(["", ...DATA.groups.map((group) => group.enters)])) {
      if (kind) this.place.append(live.element("h3", {}, ENTERS[kind] || `Effects: ${kind}`));
      for (const group of DATA.groups) if (group.enters === kind) this.place.append(this.fold(group));
    }
  }

  fold(group) {
    const mark = live.element("span", { class: "mark" });
    const summary = live.element("summary", {}, live.element("span", {}, group.title), mark);
    const rows = group.controls.map((control) => this.row(control));
    const said = group.sentence ? [live.element("p", { class: "small" }, group.sentence)] : [];
    const fold = live.element("details", { id: `group-${group.id}` }, summary, ...said, ...rows);
    fold.open = group.open;
    this.folds.push({ group, fold, mark });
    return fold;
  }

  row(control) {
    const id = `key-${control.key.replace(/\W/g, "-")}`;
    const label = live.element("label", { for: id, class: control.switch ? "switch" : "" }, labelOf(control.name));
    const said = live.element("p", { class: "said", id: `${id}-said` }, control.description);
    const reset = live.button("↺", {
      class: "reset", title: `back to what ${control.key} began with`, "aria-label": `reset ${control.key}`,
    }, () => this.turned(control.key, undefined));
    const row = { control, reset, box: null, slider: null };
    const input = control.choices.length || control.kind === "freedom" ? this.choice(row, id) : this.text(row, id);
    input.setAttribute("aria-describedby", said.id);
    row.input = input;
    const unit = live.element("span", { class: "unit" }, control.spelled);
    const parts = [label, input, unit, reset];
    if (control.slider) parts.splice(1, 0, this.slider(row, id));
    row.box = live.element("div", { class: control.slider ? "row" : "row without", title: control.key }, ...parts, said);
    this.rows.set(control.key, row);
    return row.box;
  }

  slider(row, id) {
    const { control } = row;
    const slider = live.element("input", {
      type: "range", min: 0, max: STEPS, step: 1, "aria-label": `${control.key}, slider`, "aria-describedby": `${id}-said`,
    });
    slider.addEventListener("input", () => this.turned(control.key, atPosition(control, Number(slider.value))));
    row.slider = slider;
    return slider;
  }

  /* A value that is typed, with or without a unit; Enter or leaving the field takes it. */
  text(row, id) {
    const { control } = row;
    const input = live.element("input", { type: "text", id, spellcheck: false, autocomplete: "off", autocapitalize: "off" });
    input.addEventListener("change", () => {
      const { key, allowed, not_in } = control, value = valueOfText(control, input.value);
      if (value !== undefined) this.turned(key, value);
      else {
        const written = input.value.trim();
        this.refused(key, `${key}: ${wrongIn(not_in, written)} ("${written}"), allowed is ${allowed}`);
      }
    });
    return input;
  }

  choice(row, id) {
    const { control } = row;
    const choices = control.kind === "freedom"
      ? [["x", "y", "phi"], ["x", "y"], ["x", "phi"], ["x"]] : control.choices;
    const options = choices.map((each, i) => live.element("option", { value: i }, textOf(each)));
    const select = live.element("select", { id }, ...options);
    select.addEventListener("change", () => this.turned(control.key, choices[select.value]));
    row.choices = choices;
    return select;
  }

  /* Everything as a scenario has it; wrong: the key that is at fault, or "". */
  show(scenario, wrong = "") {
    for (const row of this.rows.values()) this.showRow(row, scenario, row.control.key === wrong);
    for (const { group, mark } of this.folds) {
      const on = group.controls.some((each) => each.switch && scenario.get(each.key) !== each.default);
      const changed = group.controls.some((each) => !same(scenario.get(each.key), scenario.begun(each.key)));
      mark.textContent = [on ? "on" : "", changed ? "changed" : ""].filter(Boolean).join(", ");
    }
  }

  showRow(row, scenario, isWrong) {
    const { control, input, slider, reset, choices, box } = row;
    const value = scenario.get(control.key);
    const changed = !same(value, scenario.begun(control.key));
    const state = JSON.stringify([value, changed, isWrong]);
    if (state === row.state && control.kind !== "inertia") return; // as it stands there
    row.state = state;
    input.value = choices ? choices.findIndex((each) => sameSet(each, value)) : textOf(value);
    live.attribute(input, "aria-invalid", isWrong && "true");
    reset.disabled = !changed;
    box.classList.toggle("changed", changed);
    if (slider) this.placeSlider(slider, control, value, scenario);
  }

  placeSlider(slider, control, value, scenario) {
    const number = control.kind === "inertia" ? inertia(scenario) || 0.5 * scenario.get("rig.mass") * scenario.get("rig.contact_radius") ** 2 : value;
    slider.value = positionOf(control, number);
    slider.setAttribute("aria-valuetext", `${textOf(value)} ${control.spelled}`.trim());
  }

  /* Rows whose key or words have all that is looked for; their groups open. */
  find(text) {
    const words = text.toLowerCase().split(/\s+/).filter(Boolean);
    for (const { group, fold } of this.folds) {
      fold.hidden = true;
      for (const { key, description } of group.controls) {
        const said = `${key.replace(/[_.]/g, " ")} ${key} ${description} ${group.sentence}`.toLowerCase();
        const found = words.every((word) => said.includes(word));
        this.rows.get(key).box.hidden = !found;
        if (found) fold.hidden = false;
      }
      fold.open = words.length ? !fold.hidden : group.open;
    }
  }
}

/* --- positions of a slider ------------------------------------------------------------------- */

/* Three digits are as many as a hand can set. */
function atPosition(control, position) {
  const { low, high, log, zero } = control.slider;
  if (zero && position === 0) return 0;
  const part = zero ? (position - 1) / (STEPS - 1) : position / STEPS;
  const value = log ? low * (high / low) ** part : low + (high - low) * part;
  if (position === STEPS) return high;
  if (position === 0) return low;
  if (control.kind === "whole") return Math.round(value);
  if (log) return Number(value.toPrecision(3));
  const digits = Math.ceil(Math.log10(STEPS / (high - low)));
  return Number(value.toFixed(Math.min(Math.max(digits, 0), 20)));
}

function positionOf(control, value) {
  const { low, high, log, zero } = control.slider;
  if (zero && value <= 0) return 0;
  const inside = Math.min(Math.max(value, low), high);
  const part = log ? Math.log(inside / low) / Math.log(high / low) : (inside - low) / (high - low);
  return Math.round(zero ? 1 + part * (STEPS - 1) : part * STEPS);
}

/* A key as a label: its unit stands behind the number; mu_s stays a symbol. */
const labelOf = (name) => name.replace(/_deg(C)?$/, "").replace(/_(?=[a-z]{2})/g, " ");

/* --- values as texts --------------------------------------------------------------------------- */

const textOf = (value) => [value].flat().join(", ");

/* undefined for what is no value of the control. */
function valueOfText(control, text) {
  if (control.kind === "list") {
    const entries = text.split(/[,;\s]+/).filter(Boolean).map((each) => typedValue(each, control.unit));
    return entries.every(Number.isFinite) ? entries : undefined;
  }
  if (control.kind === "inertia" && /^\s*(disc|ring)\s*$/.test(text)) return text.trim();
  const value = typedValue(text, control.unit);
  const isOne = control.kind === "whole" ? Number.isInteger(value) : Number.isFinite(value);
  return isOne ? value : undefined;
}

const sameSet = (...sets) => same(...sets.map((each) => [each].flat().sort()));
