"use strict";
/* A plot in a box of the page. What changes from frame to frame (a moment, a dot) is drawn in front of
   the rest, which is drawn when it changes. */

const INK = "#222222", AXIS = "#6b6b6b";
const BLUE = "#0072B2", PALE_BLUE = "#A9CFE6", GREY = "#9a9a9a", ORANGE = "#D55E00";

class Plot {
  constructor(box, title, across, upwards) {
    Object.assign(this, { box, title: `${title}: ${upwards}`, spec: { x: [0, 1], y: [0, 1], curves: [] } });
    this.front = live.element("canvas", { class: "front" });
    this.uplot = live.plots.plane(box, [{ size: 26, label: across }, { size: 58 }], [22, 10, 0, 0],
      () => [this.spec.x, this.spec.y], () => this.inside(), () => this.under());
    this.uplot.over.append(this.front);
  }

  /* x, y: ranges; bands: spans of x; patches: [x, y, width, height, colour]; lines: levels of y;
     curves: {x, y, colour, width, from, to, rises: whether x does}; dots: {x, y, colour}. */
  draw(spec) {
    this.spec = spec;
    const { clientWidth: width, clientHeight: height } = this.box;
    if (width === 0) return; // folded away
    this.uplot.setSize({ width, height });
    this.uplot.setData(this.uplot.data);
  }

  /* A pixel more than they are: no seams. */
  under() {
    const { ctx, bbox } = this.uplot, dense = live.plots.density();
    const px = (x) => this.uplot.valToPos(x, "x", true), py = (y) => this.uplot.valToPos(y, "y", true);
    Object.assign(ctx, { font: live.FONT.replace("12px", `${12 * dense}px`), fillStyle: INK, textAlign: "left" });
    ctx.fillText(this.title, 6, bbox.top - 8 * dense);
    live.plots.shade(this.uplot, (this.spec.bands || []).flat());
    for (const [x, y, width, height, colour] of this.spec.patches || []) {
      ctx.fillStyle = colour;
      ctx.fillRect(px(x), py(y + height), px(x + width) - px(x) + 0.5, py(y) - py(y + height) + 0.5);
    }
  }

  inside() {
    for (const level of this.spec.lines || []) {
      live.plots.line(this.uplot, "y", this.uplot.valToPos(level, "y", true), AXIS, 1, live.DASH);
    }
    for (const curve of this.spec.curves) live.plots.way(this.uplot, curve);
    if (live.onPaper()) this.dotsOnPaper();
  }

  /* There is no front on paper, where what is cleared is white. */
  dotsOnPaper() {
    const { ctx } = this.uplot;
    for (const { x, y, colour, radius = 4 } of this.spec.dots || []) {
      if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
      ctx.fillStyle = colour;
      ctx.beginPath();
      ctx.arc(this.uplot.valToPos(x, "x", true), this.uplot.valToPos(y, "y", true), radius * live.plots.density(), 0, 2 * Math.PI);
      ctx.fill();
    }
  }

  /* In front a moment (a line at x) and dots. */
  show(moment, dots = []) {
    const { box, uplot, front, spec } = this, { clientWidth: width, clientHeight: height } = uplot.over;
    if (box.clientWidth === 0) return;
    if (uplot.width !== box.clientWidth || uplot.height !== box.clientHeight) this.draw(spec);
    const context = live.fitted(front);
    context.clearRect(0, 0, width, height);
    const part = ([low, high], value) => (value - low) / (high - low);
    if (moment !== null) context.fillRect(part(spec.x, moment) * width - 0.5, 0, 1, height);
    for (const { x, y, colour, radius = 4 } of [...(spec.dots || []), ...dots]) {
      if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
      context.fillStyle = colour;
      context.beginPath();
      context.arc(part(spec.x, x) * width, (1 - part(spec.y, y)) * height, radius, 0, 2 * Math.PI);
      context.fill();
    }
    context.fillStyle = INK;
  }
}

/* A range with some air, of all values that are given; never empty. */
function rangeOf(parts, least = 1e-9) {
  let [low, high] = [Infinity, -Infinity];
  for (const { values, from = 0, to = values.length } of parts) {
    for (let i = from; i < to; i++) {
      if (values[i] < low) low = values[i];
      if (values[i] > high) high = values[i];
    }
  }
  if (!(high >= low)) return [-1, 1];
  const air = Math.max(0.06 * (high - low), least);
  return [low - air, high + air];
}
