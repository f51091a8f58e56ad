"use strict";
/* A plot on a canvas: axes with round numbers, curves, shaded spans. What changes from frame to frame
   (a moment, a dot) is drawn over a picture of the rest, which is drawn when it changes. */

const INK = "#222222", GRID = "#e3e3e3", AXIS = "#6b6b6b";
const BLUE = "#0072B2", PALE_BLUE = "#A9CFE6", GREY = "#9a9a9a", ORANGE = "#D55E00", SLIP_BAND = "#F8EAD0";
const MARGIN = { left: 58, right: 10, top: 22, bottom: 34 };
const FONT = '12px system-ui, "DejaVu Sans", "Segoe UI", sans-serif';

class Plot {
  constructor(canvas, title, xLabel, yLabel) {
    Object.assign(this, { canvas, title, xLabel, yLabel });
    this.back = document.createElement("canvas");
    this.context = canvas.getContext("2d");
    this.spec = null;
  }

  /* As many pixels as the screen has where the canvas lies; whether that is another number. */
  fit() {
    const density = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.round(this.canvas.clientWidth * density);
    const height = Math.round(this.canvas.clientHeight * density);
    if (width === this.canvas.width && height === this.canvas.height && this.density === density) {
      return false;
    }
    this.density = density;
    for (const each of [this.canvas, this.back]) Object.assign(each, { width, height });
    return true;
  }

  get box() {
    return {
      left: MARGIN.left,
      right: this.canvas.width / this.density - MARGIN.right,
      top: MARGIN.top,
      bottom: this.canvas.height / this.density - MARGIN.bottom,
    };
  }

  /* x, y: ranges; bands: spans of x; patches: [x, y, width, height, colour]; lines: levels of y;
     curves: {x, y, colour, width, from, to, time: whether x grows}; dots: {x, y, colour}. */
  draw(spec) {
    this.spec = spec;
    if (this.canvas.clientWidth === 0) return; // folded away
    this.fit();
    const context = this.back.getContext("2d");
    context.setTransform(this.density, 0, 0, this.density, 0, 0);
    context.fillStyle = "#ffffff";
    context.fillRect(0, 0, this.back.width, this.back.height);
    context.font = FONT;
    const box = this.box;
    if (box.right <= box.left || box.bottom <= box.top) return;
    this.shade(context, spec.bands || [], box);
    for (const patch of spec.patches || []) this.patch(context, patch);
    this.axes(context, spec, box);
    context.save();
    context.beginPath();
    context.rect(box.left, box.top - 1, box.right - box.left, box.bottom - box.top + 2);
    context.clip();
    for (const level of spec.lines || []) this.level(context, level, box);
    for (const curve of spec.curves) this.curve(context, curve, box);
    for (const dot of spec.dots || []) this.dot(context, dot);
    context.restore();
  }

  px(x) {
    const [low, high] = this.spec.x;
    const { left, right } = this.box;
    return left + ((x - low) / (high - low)) * (right - left);
  }

  py(y) {
    const [low, high] = this.spec.y;
    const { top, bottom } = this.box;
    return bottom - ((y - low) / (high - low)) * (bottom - top);
  }

  /* What stands at a place of the canvas, CSS pixels. */
  at(left, top) {
    const { box, spec } = this;
    const part = [(left - box.left) / (box.right - box.left), (box.bottom - top) / (box.bottom - box.top)];
    return [spec.x, spec.y].map(([low, high], i) => low + (high - low) * Math.min(Math.max(part[i], 0), 1));
  }

  shade(context, bands, box) {
    context.fillStyle = SLIP_BAND;
    for (const [from, to] of bands) {
      const left = Math.max(this.px(from), box.left);
      const right = Math.min(this.px(to), box.right);
      if (right > left) context.fillRect(left, box.top, Math.max(right - left, 0.5), box.bottom - box.top);
    }
  }

  /* A pixel more than it is: no seams. */
  patch(context, [x, y, width, height, colour]) {
    const [left, top] = [this.px(x), this.py(y + height)];
    context.fillStyle = colour;
    context.fillRect(left, top, this.px(x + width) - left + 0.5, this.py(y) - top + 0.5);
  }

  axes(context, spec, box) {
    context.strokeStyle = GRID;
    context.fillStyle = AXIS;
    context.lineWidth = 1;
    context.textAlign = "center";
    context.textBaseline = "top";
    for (const value of ticks(spec.x, (box.right - box.left) / 70)) {
      stroke(context, this.px(value), box.top, this.px(value), box.bottom);
      context.fillText(live.told(value, 6), this.px(value), box.bottom + 4);
    }
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const value of ticks(spec.y, (box.bottom - box.top) / 32)) {
      stroke(context, box.left, this.py(value), box.right, this.py(value));
      context.fillText(live.told(value, 6), box.left - 5, this.py(value));
    }
    context.strokeStyle = AXIS;
    stroke(context, box.left, box.bottom, box.right, box.bottom);
    stroke(context, box.left, box.top, box.left, box.bottom);
    context.fillStyle = INK;
    context.textBaseline = "top";
    context.textAlign = "left";
    context.fillText(`${this.title}: ${this.yLabel}`, 6, 3);
    context.textAlign = "right";
    context.textBaseline = "bottom";
    context.fillText(this.xLabel, box.right, this.back.height / this.density - 1);
  }

  level(context, y, box) {
    context.save();
    context.strokeStyle = AXIS;
    context.setLineDash([5, 4]);
    stroke(context, box.left, this.py(y), box.right, this.py(y));
    context.restore();
  }

  curve(context, { x, y, colour, width = 1.4, from = 0, to = x.length, time = false }, box) {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.lineJoin = "round";
    context.beginPath();
    const dense = time && to - from > 4 * this.density * (box.right - box.left);
    if (dense) this.columns(context, x, y, from, to);
    else for (let i = from; i < to; i++) context.lineTo(this.px(x[i]), this.py(y[i]));
    context.stroke();
  }

  /* Of each column of pixels the lowest and the highest value: no peak is lost, none made. */
  columns(context, x, y, from, to) {
    const column = (i) => Math.floor(this.px(x[i]) * this.density);
    let i = from;
    while (i < to) {
      const here = column(i);
      let [low, high] = [i, i];
      for (; i < to && column(i) === here; i++) {
        if (y[i] < y[low]) low = i;
        if (y[i] > y[high]) high = i;
      }
      for (const each of low < high ? [low, high] : [high, low]) {
        context.lineTo(this.px(x[each]), this.py(y[each]));
      }
    }
  }

  dot(context, { x, y, colour, radius = 4 }) {
    context.fillStyle = colour;
    context.beginPath();
    context.arc(this.px(x), this.py(y), radius, 0, 2 * Math.PI);
    context.fill();
  }

  /* The picture, and over it a moment (a line at x) and dots. */
  show(moment, dots = []) {
    if (!this.spec || this.canvas.clientWidth === 0) return;
    if (this.fit()) this.draw(this.spec);
    const { context, density } = this;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(this.back, 0, 0);
    context.setTransform(density, 0, 0, density, 0, 0);
    const box = this.box;
    if (moment !== null && moment >= this.spec.x[0] && moment <= this.spec.x[1]) {
      context.strokeStyle = INK;
      context.lineWidth = 1;
      stroke(context, this.px(moment), box.top, this.px(moment), box.bottom);
    }
    for (const dot of dots) if (Number.isFinite(dot.x) && Number.isFinite(dot.y)) this.dot(context, dot);
  }
}

function stroke(context, x1, y1, x2, y2) {
  context.beginPath();
  context.moveTo(x1, y1);
  context.lineTo(x2, y2);
  context.stroke();
}

/* Round numbers inside a range, about so many. */
function ticks([low, high], count) {
  const span = high - low;
  if (!(span > 0) || !Number.isFinite(span)) return [];
  const rough = span / Math.max(count, 1);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((each) => each * power >= rough * (1 - 1e-9));
  const found = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * span; i++) {
    found.push(Number((i * step).toPrecision(12)));
  }
  return found;
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
