"use strict";
/* The plots of a run, with a kept run behind them: x, y, phi and the temperature over time, phase
   portrait, friction. */

const MM = 1e3, DEG = 180 / Math.PI;
// Of what is drawn over time: its words, its unit, the factor to it, and below which it is at rest (rounding).
const OVER_TIME = {
  x: { title: "x", says: "position along the motion", unit: "mm", factor: MM, still: -1 },
  y: { title: "y", says: "position across", unit: "mm", factor: MM, still: 1e-9 },
  phi: { title: "phi", says: "rotation", unit: "°", factor: DEG, still: 1e-8 },
  interface_temperature: {
    id: "temperature", title: "heat", says: "temperature of the interface", unit: "°C", factor: 1, still: -1,
  },
};
const MOST_OF_PHASE = 20000; // points of a phase portrait, the latest

class Pictures {
  constructor() {
    const plot = (id, ...labels) => new Plot(document.getElementById(id), ...labels);
    this.over = {};
    for (const [name, { id = name, title, says, unit }] of Object.entries(OVER_TIME)) {
      this.over[name] = plot(id, title, "time [s]", `${says} [${unit}]`);
    }
    this.phase = plot("phase", "phase portrait", "x [mm]", "velocity along x [mm/s]");
    this.friction = plot("friction", "friction", "sliding speed [mm/s]", "coefficient [1]");
    this.columns = new WeakMap(); // run -> what has been taken out of it, and of how many rows
  }

  /* Columns in the units of the plots. */
  of(run) {
    let kept = this.columns.get(run);
    if (kept?.rows !== run.rows || kept.warmed !== run.warmed) {
      kept = { rows: run.rows, warmed: run.warmed, vx: run.column("vx", MM) };
      for (const [name, { factor }] of Object.entries(OVER_TIME)) kept[name] = run.column(name, factor);
      this.columns.set(run, kept);
    }
    return kept;
  }

  /* All plots anew. range: times that are shown, s. */
  draw(run, kept, range) {
    const runs = [kept, run].filter((each) => each && each.rows > 0), still = [];
    for (const [name, { unit }] of Object.entries(OVER_TIME)) {
      const isStill = !this.overTime(name, run, runs, range);
      if (isStill && runs.length) still.push(`${name} stays at ${live.told(this.of(run)[name][0], 3)} ${unit}`);
    }
    document.getElementById("flat").textContent = still.length ? `Nothing to draw in the time shown: ${still.join(", ")}.` : "";
    this.drawPhase(run, runs);
    this.drawFriction(run, [kept, run].filter((each) => each && each.curve));
  }

  /* Draws a channel; false where it never moves, and is folded away. */
  overTime(name, run, runs, range) {
    const plot = this.over[name], { still, factor } = OVER_TIME[name];
    const parts = runs.map((each) => ({ values: this.of(each)[name], ...inside(each, range) }));
    const [low, high] = rangeOf(parts, 0);
    plot.box.hidden = high - low <= still * factor;
    if (plot.box.hidden) return false;
    const width = (each) => (each === run ? 1.4 : 1);
    const curves = parts.map(({ values, from, to }, i) => ({
      x: runs[i].time, y: values, colour: colourOf(runs[i], run), rises: true, from, to, width: width(runs[i]),
    }));
    plot.draw({ x: range, y: rangeOf(parts, 1e-3), bands: slips(run), curves });
    return true;
  }

  drawPhase(run, runs) {
    const curves = [];
    for (const each of runs) {
      const { x, vx } = this.of(each), ramp = inside(each, [each.rampEnd, Infinity]).from;
      const from = Math.max(ramp, each.rows - MOST_OF_PHASE);
      if (each === run && ramp > 0) {
        curves.push({ x, y: vx, colour: PALE_BLUE, width: 1, from: Math.max(0, ramp - MOST_OF_PHASE), to: Math.min(ramp + 1, each.rows) });
      }
      curves.push({ x, y: vx, colour: colourOf(each, run), from, to: each.rows });
    }
    const parts = (name) => runs.map((each) => ({ values: this.of(each)[name] }));
    const belt = run.scenario.get("rig.surface") === "belt";
    const lines = belt ? [MM * run.scenario.get("surface.speed")] : [];
    const y = rangeOf([...parts("vx"), { values: [0, ...lines] }], 1e-3);
    this.phase.draw({ x: rangeOf(parts("x"), 1e-3), y, lines, curves });
  }

  drawFriction(run, runs) {
    const statics = (each) => each.scenario.get("friction.mu_s");
    const speeds = (each) => each.speeds.map((speed) => speed * MM);
    this.friction.draw({
      x: [0, Math.max(...runs.map((each) => speeds(each).at(-1)), 1)],
      y: [0, rangeOf(runs.map((each) => ({ values: [...each.curve, statics(each), 0] })), 1e-3)[1]],
      curves: runs.map((each) => ({ x: speeds(each), y: each.curve, colour: colourOf(each, run) })),
      dots: runs.map((each) => ({ x: 0, y: statics(each), colour: colourOf(each, run), radius: 5 })),
    });
  }

  /* The moment over all of them. */
  show(run, moment, now) {
    const colour = now.mode === 1 ? ORANGE : BLUE;
    for (const [name, plot] of Object.entries(this.over)) {
      plot.show(moment, [{ x: moment, y: now[name] * OVER_TIME[name].factor, colour }]);
    }
    this.phase.show(null, [{ x: now.x * MM, y: now.vx * MM, colour }]);
    const slides = now.mode === 1 && run.curve;
    const load = run.scenario.get("rig.mass") * GRAVITY;
    const mu = Math.hypot(now.friction_force_x, now.friction_force_y) / load;
    this.friction.show(null, slides ? [{ x: now.sliding_speed * MM, y: mu, colour }] : []);
  }
}

const colourOf = (each, run) => (each === run ? BLUE : GREY);

/* Rows of a run inside a span of time, one more on either side. */
function inside(run, [begin, end]) {
  let [from, to] = [0, run.rows];
  while (from < to && run.time[from] < begin) from++;
  while (to > from && run.time[to - 1] > end) to--;
  return { from: Math.max(from - 1, 0), to: Math.min(to + 1, run.rows) };
}
