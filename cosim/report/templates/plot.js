// What stands on uPlot's axes beside its own curves: shaded spans, straight lines, and ways, whose points
// need not go from left to right.
"use strict";
live.plots = (() => {
  const SHADE = "#f8ead0";
  const density = () => devicePixelRatio || 1;

  // Axes with nothing between them but what draw puts there. axes: what differs from the usual look.
  // ranges: gives those of x and y. under: draws below the grid.
  function plane(box, axes, padding, ranges, draw, under = () => {}) {
    const range = (axis) => () => ranges()[axis];
    return new uPlot({
      width: 300, height: 150, padding, legend: { show: false }, cursor: { show: false }, series: [{}, {}],
      scales: { x: { time: false, range: range(0) }, y: { range: range(1) } },
      axes: axes.map((axis) => ({ ...live.axis, labelSize: 18, ...axis })),
      hooks: { drawClear: [under], draw: [(plot) => inside(plot, draw)] },
    }, [[0, 1], [null, null]], box);
  }

  function inside(plot, draw) {
    const { ctx, bbox: { left, top, width, height } } = plot;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, width, height);
    ctx.clip();
    draw(plot);
    ctx.restore();
  }

  // Spans of x, each from and to, over the full height.
  function shade(plot, spans) {
    const { ctx, bbox } = plot, { min, max } = plot.scales.x;
    ctx.save();
    ctx.fillStyle = SHADE;
    for (let i = 0; i < spans.length; i += 2) {
      if (spans[i + 1] < min || spans[i] > max) continue;
      const left = plot.valToPos(Math.max(spans[i], min), "x", true);
      const right = plot.valToPos(Math.min(spans[i + 1], max), "x", true);
      ctx.fillRect(left, bbox.top, Math.max(right - left, 0.5), bbox.height);
    }
    ctx.restore();
  }

  function pen({ ctx }, colour, width, dash) {
    ctx.strokeStyle = colour;
    ctx.lineWidth = width * density();
    ctx.lineJoin = "round";
    ctx.setLineDash(dash.map((length) => length * density()));
    ctx.beginPath();
  }

  // Across at a height, or upright at an x, both in pixels of the canvas.
  function line(plot, axis, at, colour, width = 1, dash = []) {
    const { ctx, bbox: { left, top, width: across, height } } = plot;
    pen(plot, colour, width, dash);
    ctx.moveTo(...(axis === "y" ? [left, at] : [at, top]));
    ctx.lineTo(...(axis === "y" ? [left + across, at] : [at, top + height]));
    ctx.stroke();
  }

  // Points joined from one to another of them, with gaps where there is no number. Of dense rising ones
  // each column of pixels has its lowest and its highest: no peak is lost, none made.
  function way(plot, { x, y, colour, width = 1.4, dash = [], rises = false, from = 0, to = y.length }) {
    const { ctx, bbox } = plot, column = (i) => Math.floor(plot.valToPos(x[i], "x", true));
    let isDown = false;
    function point(i) {
      const isThere = Number.isFinite(x[i]) && Number.isFinite(y[i]);
      if (isThere) ctx[isDown ? "lineTo" : "moveTo"](plot.valToPos(x[i], "x", true), plot.valToPos(y[i], "y", true));
      isDown = isThere;
    }
    pen(plot, colour, width, dash);
    const isDense = rises && to - from > 4 * bbox.width;
    for (let i = from; i < to;) {
      let [low, high] = [i, i];
      const here = isDense && column(i);
      do {
        if (y[i] < y[low]) low = i;
        if (y[i] > y[high]) high = i;
        i++;
      } while (isDense && i < to && column(i) === here);
      point(Math.min(low, high));
      if (low !== high) point(Math.max(low, high));
    }
    ctx.stroke();
  }

  return { SHADE, density, plane, shade, line, way };
})();
