"use strict";
/* Runs of the kernel: one at a time, the newest wish first, what comes of it kept by columns. */

const PATIENCE_MS = 1500; // that a thread may be silent while another run is wished for
const CURVE_POINTS = 160;

/* A run as it comes: columns by name, filled up to `rows`; events as time, mode, x. */
class Run {
  constructor(scenario, number) {
    Object.assign(this, { scenario, number });
    this.time = sampleTimes(scenario.get("run.duration"), scenario.get("run.output_interval"));
    this.rampEnd = scenario.get("surface.run_up_time");
    this.speeds = curveSpeeds(scenario);
    this.table = new Float64Array(this.time.length * DATA.sizes.all).fill(NaN);
    this.heat = heatOf(scenario);
    // warmed: rows that have their heat; state: then begun, refused or done
    Object.assign(this, { rows: 0, warmed: 0, events: [], state: "wished", reason: "" });
  }

  /* A column at all rows there are, times a factor. */
  column(name, factor = 1) {
    const values = new Float64Array(this.rows);
    let at = DATA.outputs[name];
    for (let i = 0; i < this.rows; i++, at += DATA.sizes.all) values[i] = this.table[at] * factor;
    return values;
  }

  at(name, row) {
    return this.table[row * DATA.sizes.all + DATA.outputs[name]];
  }

  /* Rows of some width from one on, into their columns; the row behind them. */
  put(numbers, from, width, column) {
    let row = from;
    for (let i = 0; i < numbers.length; i += width, row++) {
      this.table.set(numbers.subarray(i, i + width), row * DATA.sizes.all + column);
    }
    return row;
  }

  take(message) {
    if (message.refused !== undefined) {
      Object.assign(this, { state: "refused", reason: message.refused });
    } else if (message.begun) {
      this.state = "begun";
      ({ attachments: this.attachments, anchors: this.anchors, curve: this.curve } = message);
    } else if (message.rows) {
      this.rows = this.put(message.rows, message.from, DATA.sizes.row, 0);
      const { events } = message, width = DATA.sizes.event;
      for (let i = 0; i < events.length; i += width) this.events.push(events.slice(i, i + width));
    } else if (message.warmth) {
      this.warmed = this.put(message.warmth, message.from, DATA.sizes.warmth, DATA.sizes.row);
    } else if (message.warmed) {
      Object.assign(this.heat, { ended: true, why: message.reason });
    } else if (message.done) {
      Object.assign(this, { state: "done", reason: message.reason });
      // the internal step that the run ends in may have met an event beyond that end
      const end = this.time[this.rows - 1] ?? 0;
      if (!this.reason) this.events = this.events.filter((event) => event[0] <= end);
    }
  }
}

/* 0, interval, 2 interval, ... and the duration itself, s: the times of `stickslip simulate`. */
function sampleTimes(duration, interval) {
  const count = Math.floor((duration / interval) * (1 + 1e-12));
  const times = Array.from({ length: count + 1 }, (_, i) => i * interval);
  if (duration - times[count] > 1e-9 * interval) times.push(duration);
  else times[count] = duration;
  return Float64Array.from(times);
}

/* Sliding speeds of the friction curve: closer together where they are small. */
function curveSpeeds(scenario) {
  const top = 2 * Math.max(Math.abs(scenario.get("surface.speed")), 0.02);
  return Float64Array.from({ length: CURVE_POINTS }, (_, i) => top * ((i + 1) / CURVE_POINTS) ** 2);
}

/* A thread with the models; heard: called with what it says. */
function thread(models, heard) {
  const text = document.getElementById("worker").textContent;
  const address = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
  const worker = new Worker(address);
  URL.revokeObjectURL(address);
  worker.onmessage = ({ data }) => heard(data);
  worker.postMessage(models);
  return worker;
}

/* The thread that computes, begun anew where it does not answer. `told` is called with each run that
   has changed. */
class Runs {
  constructor(models, told) {
    Object.assign(this, { models, told, number: 0, current: null, waiting: null });
    this.begin();
  }

  begin() {
    this.worker = thread(this.models, (message) => this.heard(message));
  }

  /* Compute a scenario; what was being computed is let go. */
  wish(scenario) {
    const run = new Run(scenario, ++this.number);
    this.current = run;
    clearTimeout(this.waiting);
    this.waiting = setTimeout(() => this.restart(run), PATIENCE_MS);
    this.ask(run);
    return run;
  }

  ask(run) {
    const { number, scenario, time, speeds, heat } = run;
    this.worker.postMessage({
      run: number, values: kernelValues(scenario), inputs: kernelInputs(scenario), times: time, speeds,
      sizes: DATA.sizes, places: ["surface_travel", "heat", "x"].map((name) => DATA.outputs[name]),
      warmed: heat.parameters && heat,
    });
  }

  /* The thread sits in one long call of an earlier run: only another thread helps. */
  restart(run) {
    if (run !== this.current || run.state !== "wished") return;
    this.worker.terminate();
    this.begin();
    this.ask(run);
  }

  heard(message) {
    const run = this.current;
    if (!run || message.run !== run.number) return;
    clearTimeout(this.waiting);
    run.take(message);
    this.told(run, message);
  }
}
