"use strict";
/* What becomes of the block at other speeds and dampings: each cell of the map is a run of its own, in
   a thread of its own, when all else is done. `explorer.map.regimes`: what was found, by places. */

const AXES = ["surface.speed", "structural_damping.coefficient"];
const CELLS = [40, 24], COARSE = 8; // along the axes; cells of the first sight
const IDLE_MS = 300; // before the first of them
// As the kernel counts them.
const REGIMES = [["ends early", "#8c8c8c"], ["sticks and never slips", "#dcdcdc"], ["sticks and slips", "#8fbfe0"],
  ["slides", "#f3deb2"], ["creeps as fast as the surface", "#c9dfc6"]];

class RegimeMap {
  /* moved: called with keys and values of a place that is chosen. */
  constructor(box, legend, models, moved) {
    Object.assign(this, { legend, models, regimes: [], cells: [], tops: [1, 1], here: [NaN, NaN] });
    this.plot = new Plot(box, "regimes", "speed of the surface [m/s]", "damping [N s/m]");
    const { uplot } = this.plot;
    uplot.over.addEventListener("click", (event) => {
      const place = [uplot.posToVal(event.offsetX, "x") * this.sign, uplot.posToVal(event.offsetY, "y")];
      AXES.forEach((key, i) => moved(key, Number(place[i].toPrecision(2))));
    });
  }

  /* The map around a run that is done: another one if more than its own place has changed. */
  wish({ scenario, time, rampEnd }) {
    const values = kernelValues(scenario), inputs = kernelInputs(scenario);
    const place = DATA.names.indexOf(AXES[1]), end = time.at(-1);
    this.here = AXES.map((key) => Math.abs(scenario.get(key)));
    const sign = scenario.get(AXES[0]) < 0 ? -1 : 1;
    const tops = AXES.map((key, i) => Math.max(0.5 * CONTROLS.get(key).slider.high, 1.1 * this.here[i]));
    inputs[DATA.sizes.speed] = values[place] = 0;
    const asked = JSON.stringify([[...values], [...inputs], end, rampEnd, sign, tops]);
    if (asked === this.asked) return;
    Object.assign(this, { asked, sign, tops, regimes: [], cells: cellsOf(tops) });
    this.worker?.terminate();
    clearTimeout(this.waiting);
    this.waiting = setTimeout(() => {
      this.worker = thread(this.models, ({ found }) => {
        this.regimes.push(...found);
        this.show();
      });
      this.worker.postMessage({
        run: 0, values, inputs, place, sizes: DATA.sizes, begin: 0.5 * (end + Math.min(rampEnd, end)), end,
        cells: this.cells.map((_, i) => this.middle(i)),
      });
    }, IDLE_MS);
  }

  /* Where a cell is computed: in the middle of the finest one at its corner. */
  middle(cell) {
    const [x, y] = this.cells[cell].slice(0, 2).map((at, i) => at + (0.5 * this.tops[i]) / CELLS[i]);
    return [this.sign * x, y];
  }

  show() {
    const here = { x: this.here[0], y: this.here[1], colour: ORANGE, radius: 6 };
    const patches = this.regimes.map((regime, i) => [...this.cells[i], REGIMES[regime][1]]);
    this.plot.draw({ x: [0, this.tops[0]], y: [0, this.tops[1]], patches, curves: [], dots: [here] });
    this.plot.show(null);
    const there = REGIMES.filter((_, regime) => this.regimes.includes(regime));
    const computed = Math.floor((100 * this.regimes.length) / (this.cells.length || 1));
    this.legend.replaceChildren(...there.flatMap(([words, colour]) => [live.swatch(colour), `${words}; `]), computed < 100 ? `computing, ${computed} %` : "dot: here; a click goes there");
  }
}

/* Left, bottom, width and height of all cells, coarse ones first, which finer ones cover in part. */
function cellsOf(tops) {
  const [width, height] = tops.map((top, i) => top / CELLS[i]);
  const cells = [];
  for (let step = COARSE; step >= 1; step /= 2) {
    for (let j = 0; j < CELLS[1]; j += step) for (let i = 0; i < CELLS[0]; i += step) {
      const isThere = step < COARSE && i % (2 * step) === 0 && j % (2 * step) === 0;
      if (!isThere) cells.push([i * width, j * height, step * width, step * height]);
    }
  }
  return cells;
}
