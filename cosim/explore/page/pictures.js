"use strict";
/* The plots of a run, with a kept run behind them: x, y, phi and the temperature over time, phase
   portrait, friction. */

const MM = 1e3, DEG = 180 / Math.PI;
// Below these a channel is at rest: rounding, m and rad.
const STILL = { x: -1, y: 1e-9, phi: 1e-8, interface_temperature: -1 };
const SIGHT = { x: [MM, "mm"], y: [MM, "mm"], phi: [DEG, "°"], interface_temperature: [1, "°C"] };
const MOST_OF_PHASE = 20000; // points of a phase portrait, the latest

class Pictures {
  constructor() {
    const plot = (id, ...labels) => new Plot(document.getElementById(id), ...labels);
    this.over = {
      x: plot("x", "x", "time [s]", "position along the motion [mm]"),
      y: plot("y", "y", "time [s]", "position across [mm]"),
      phi: plot("phi", "phi", "time [s]", "rotation [°]"),
      interface_temperature: plot("temperature", "heat", "time [s]", "temperature of the interface [°C]"),
    };
    this.phase = plot("phase", "phase portrait", "x [mm]", "velocity along x [mm/s]");
    this.friction = plot("friction", "friction", "sliding speed [mm/s]", "coefficient");
    this.columns = new WeakMap(); // run -> what has been taken out of it, and of how many rows
  }

  /* Columns in the units of the plots. */
  of(run) {
    let kept = this.columns.get(run);
    if (!kept || kept.rows !== run.rows || kept.warmed !== run.warmed) {
      kept = {
        rows: run.rows, warmed: run.warmed, interface_temperature: run.column("interface_temperature"),
        x: run.column("x", MM), y: run.column("y", MM), vx: run.column("vx", MM),
        phi: run.column("phi", DEG),
      };
      this.columns.set(run, kept);
    }
    return kept;
  }

  /* All plots anew. range: times that are shown, s. */
  draw(run, kept, range) {
    const still = [];
    for (const name of Object.keys(this.over)) {
      const at = this.overTime(name, run, kept, range);
      if (at !== null) still.push(`${name} stays at ${live.told(at, 3)} ${SIGHT[name][1]}`);
    }
    document.getElementById("flat").textContent = still.length ? `Nothing to draw in the time shown: ${still.join(", ")}.` : "";
    this.drawPhase(run, kept);
    this.drawFriction(run, kept);
  }

  /* Draws a channel; its value where it never moves, and is folded away. */
  overTime(name, run, kept, range) {
    const plot = this.over[name];
    const runs = [kept, run].filter((each) => each && each.rows > 0);
    const parts = runs.map((each) => ({ values: this.of(each)[name], ...inside(each, range) }));
    const ends = rangeOf(parts, 0);
    const still = ends[1] - ends[0] <= STILL[name] * SIGHT[name][0];
    plot.canvas.hidden = still;
    if (still) return runs.length ? this.of(run)[name][0] : null;
    plot.draw({
      x: range,
      y: rangeOf(parts, 1e-3),
      bands: slips(run),
      curves: runs.map((each, i) => ({
        x: each.time, y: this.of(each)[name], colour: each === run ? BLUE : GREY, time: true,
        ...inside(each, range), width: parts.length > 1 && i === 0 ? 1 : 1.4,
      })),
    });
    return null;
  }

  drawPhase(run, kept) {
    const runs = [kept, run].filter((each) => each && each.rows > 0);
    const curves = [];
    for (const each of runs) {
      const { x, vx } = this.of(each);
      const ramp = inside(each, [each.rampEnd, Infinity]).from;
      const from = Math.max(ramp, each.rows - MOST_OF_PHASE);
      if (each === run && ramp > 0) {
        curves.push({ x, y: vx, colour: PALE_BLUE, width: 1, from: Math.max(0, ramp - MOST_OF_PHASE), to: Math.min(ramp + 1, each.rows) });
      }
      curves.push({ x, y: vx, colour: each === run ? BLUE : GREY, from, to: each.rows });
    }
    const parts = (name) => runs.map((each) => ({ values: this.of(each)[name] }));
    const belt = run.scenario.get("rig.surface") === "belt";
    const speed = MM * run.scenario.get("surface.speed");
    this.phase.draw({
      x: rangeOf(parts("x"), 1e-3),
      y: rangeOf([...parts("vx"), { values: [0] }, ...(belt ? [{ values: [speed] }] : [])], 1e-3),
      lines: belt ? [speed] : [],
      curves,
    });
  }

  drawFriction(run, kept) {
    const runs = [kept, run].filter((each) => each && each.curve);
    const statics = (each) => each.scenario.get("friction.mu_s");
    const values = runs.map((each) => ({ values: [...each.curve, statics(each), 0] }));
    const speeds = (each) => each.speeds.map((speed) => speed * MM);
    this.friction.draw({
      x: [0, Math.max(...runs.map((each) => each.speeds.at(-1) * MM), 1)],
      y: [0, rangeOf(values, 1e-3)[1]],
      curves: runs.map((each) => ({ x: speeds(each), y: each.curve, colour: each === run ? BLUE : GREY })),
      dots: runs.map((each) => ({ x: 0, y: statics(each), colour: each === run ? BLUE : GREY, radius: 5 })),
    });
  }

  /* The moment over all of them. */
  show(run, moment, now) {
    const colour = now.mode === 1 ? ORANGE : BLUE;
    for (const name of Object.keys(this.over)) {
      const y = now[name] * SIGHT[name][0];
      this.over[name].show(moment, [{ x: moment, y, colour }]);
    }
    this.phase.show(null, [{ x: now.x * MM, y: now.vx * MM, colour }]);
    const slides = now.mode === 1 && run.curve;
    const load = run.scenario.get("rig.mass") * GRAVITY;
    const mu = Math.hypot(now.friction_force_x, now.friction_force_y) / load;
    this.friction.show(null, slides ? [{ x: now.sliding_speed * MM, y: mu, colour }] : []);
  }
}

/* Rows of a run inside a span of time, one more on either side. */
function inside(run, [begin, end]) {
  let [from, to] = [0, run.rows];
  while (from < to && run.time[from] < begin) from++;
  while (to > from && run.time[to - 1] > end) to--;
  return { from: Math.max(from - 1, 0), to: Math.min(to + 1, run.rows) };
}
