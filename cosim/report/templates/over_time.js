// Curves over time, drawn by uPlot: hover for values, drag or use the buttons and keys to zoom. All
// figures of a page that are over the same time, from begin to end, zoom and point together.
"use strict";
(() => {
  const HEIGHT = 190, MAP_HEIGHT = 340, PAPER = 0.6, INK = "#222", SOFT = "#5c5c5c";
  const ON_A_SCREEN = 3, LONGEST_BESIDE = 10, { DASH, FONT } = live, { SHADE, density, shade, line } = live.plots;
  const plots = [];
  let sharing = false;

  // The same stretch of time in all plots over the same time; within what there is.
  function zoomTo(group, low, high) {
    sharing = true;
    for (const { plot, begin, end } of plots.filter((each) => each.group === group)) {
      const span = Math.min(high - low, end - begin);
      const from = Math.max(begin, Math.min(low, end - span));
      plot.setScale("x", { min: from, max: from + span });
    }
    sharing = false;
  }

  function zoomBy(group, plot, factor, shift = 0) {
    const { min, max } = plot.scales.x;
    const middle = 0.5 * (min + max) + shift * (max - min), half = 0.5 * factor * (max - min);
    zoomTo(group, middle - half, middle + half);
  }

  // Sums from below of the filled curves of a stacked panel; others as they are.
  function stacked(curves, values) {
    let below = [];
    const onTop = (own) => (below = own.map((v, i) => (below[i] || 0) + (v || 0)));
    return curves.map(({ fill }, n) => (fill ? onTop(Float64Array.from(values[n])) : values[n]));
  }

  // Broken lines at levels, upright lines at marks and at the time that the animation shows.
  function annotate(plot, panel, marks, named) {
    const { ctx, bbox } = plot, dense = density(), { min, max } = plot.scales.x;
    const right = bbox.left + bbox.width, bottom = bbox.top + bbox.height;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, 0, ctx.canvas.width - bbox.left, bottom);
    ctx.clip();
    Object.assign(ctx, { font: FONT.replace("12px", `${12 * dense}px`), fillStyle: INK, textAlign: "left" });
    for (const [height, text] of panel.levels) {
      const y = plot.valToPos(height, "y", true);
      if (y < bbox.top || y > bottom) continue;
      line(plot, "y", y, SOFT, 1, DASH);
      ctx.fillText(text, right + 4 * dense, y + 4 * dense);
    }
    for (const [time, text] of marks) {
      if (time < min || time > max) continue;
      const x = plot.valToPos(time, "x", true);
      line(plot, "x", x, INK, 1, [1, 3]);
      ctx.textAlign = x + ctx.measureText(text).width > ctx.canvas.width ? "right" : "left";
      if (named) ctx.fillText(text, x, bbox.top - 4 * dense);
    }
    const now = live.clock.time;
    if (now !== null && now >= min && now <= max) line(plot, "x", plot.valToPos(now, "x", true), "#b3261e");
    ctx.restore();
  }

  function range(panel) {
    return (plot, low, high) => {
      if (low === null || high === null) return [0, 1];
      for (const [height] of panel.levels) {
        const room = 0.1 * (high - low);
        if (height > low - room && height < high + room) [low, high] = [Math.min(low, height), Math.max(high, height)];
      }
      if (panel.logarithmic) return [low / 1.5, high * 1.5];
      if (high - low < panel.span) {
        const middle = 0.5 * (low + high);
        [low, high] = [middle - 0.5 * panel.span, middle + 0.5 * panel.span];
      }
      const margin = 0.06 * (high - low) || 0.05 * Math.abs(high) || 0.5;
      const bottom = panel.from_zero ? 0 : low - margin;
      return [bottom, panel.top !== null ? panel.top : high + margin];
    };
  }

  // A map below the curves, which the dark does not turn over: one pixel for each number.
  function floorOf({ map, curves }, data) {
    const [times, places] = map.shape, levels = live.numbers(map.levels), colours = live.colours(map.colours);
    const picture = live.element("canvas", { width: times, height: places });
    const inside = picture.getContext("2d"), image = inside.createImageData(times, places);
    levels.forEach((level, at) => {
      const [t, place] = [Math.floor(at / places), at % places];
      image.data.set([...colours[level], 255], 4 * ((places - 1 - place) * times + t));
    });
    inside.putImageData(image, 0, 0);
    const floor = live.element("canvas", { class: "map" }), way = live.numbers(curves[0].values);
    let painted = "";
    return {
      paint(plot) {
        if (!floor.parentNode) plot.under.append(floor);
        // while the animation plays, nothing of it changes
        const asked = JSON.stringify([live.onPaper(), plot.bbox, plot.scales.x.min, plot.scales.x.max]);
        if (asked === painted && !live.onPaper()) return;
        painted = asked;
        const { left, top, width, height } = plot.bbox, dense = density();
        // on paper what is cleared is white, and covers what is below
        const context = live.onPaper() ? plot.ctx : live.sized(floor, width / dense, height / dense);
        const px = (row) => plot.valToPos(data.time[row], "x", true);
        context.save();
        context.setTransform(1, 0, 0, 1, ...(live.onPaper() ? [0, 0] : [-left, -top]));
        context.imageSmoothingEnabled = false;
        context.drawImage(picture, px(0), top, px(times - 1) - px(0) || 1, height);
        context.strokeStyle = curves[0].colour;
        context.lineWidth = 1.2 * dense;
        context.beginPath();
        way.forEach((place, t) => {
          const jump = t === 0 || Math.abs(place - way[t - 1]) > 0.5 * map.length;
          context[jump ? "moveTo" : "lineTo"](px(t), plot.valToPos(place, "y", true));
        });
        context.stroke();
        context.restore();
      },
      // What is at the pointer.
      read({ cursor, posToVal }) {
        const time = posToVal(cursor.left, "x"), place = posToVal(cursor.top, "y");
        const column = Math.max(0, Math.min(places - 1, Math.floor(place / map.length * places)));
        const level = levels[live.placeOf(data.time, time) * places + column];
        return `${live.told(time, 3)} s, ${live.told(place, 3)} m: ` +
          `${live.told(map.low + (map.high - map.low) * level / 255, 3)} ${map.unit}`;
      },
    };
  }

  // Room for the names of levels, the same for all panels of a figure.
  function besidePlots(data) {
    const names = data.panels.flatMap((each) => each.levels.map(([, text]) => text.length));
    return names.length ? Math.max(28, 10 + 7.4 * Math.max(...names)) : 14;
  }

  // A label that is longer than the plot is high on paper stands above it; of plots side by side, all do.
  const isAbove = (panel, data) => data.columns > 1 || panel.label.length > LONGEST_BESIDE;

  function options(panel, data, first, last, onCursor, holder, floor) {
    const series = panel.curves.map((curve) => ({
      label: curve.label,
      stroke: curve.fill ? undefined : curve.colour,
      fill: curve.fill ? curve.colour : undefined,
      width: curve.fill || curve.dots ? 0 : curve.width + 0.1,
      dash: curve.dash ? DASH : undefined,
      pxAlign: 0,
      points: { show: curve.dots || data.time.length < 3, size: 4, fill: curve.colour },
      paths: curve.dots || floor ? () => null : curve.steps ? uPlot.paths.stepped({ align: -1 }) : undefined,
    }));
    const look = { ...live.axis, grid: { ...live.axis.grid, show: !floor } };
    return {
      width: 300,
      height: (floor ? MAP_HEIGHT : HEIGHT) + (first && data.marks.length ? 14 : 0) + (last ? 18 : 0),
      padding: [first && data.marks.length ? 20 : 6, besidePlots(data), 0, 0],
      legend: { show: false },
      scales: { x: { time: false }, y: { range: range(panel), distr: panel.logarithmic ? 3 : 1 } },
      axes: [
        { ...look, size: 26, label: last ? "time [s]" : undefined, labelSize: 18 },
        isAbove(panel, data)
          ? { ...look, size: data.columns > 1 ? 58 : 58 + 18 }
          : { ...look, size: 58, label: panel.label, labelSize: 18 },
      ],
      cursor: { sync: { key: data.group }, drag: { x: true, y: false }, points: { size: 7 } },
      series: [{}, ...series],
      hooks: {
        drawClear: [(plot) => (floor ? floor.paint(plot) : panel.shaded && shade(plot, data.phases))],
        draw: [(plot) => annotate(plot, panel, data.marks, first)],
        setCursor: [onCursor],
        setScale: [(plot, key) => {
          const { min, max } = plot.scales.x;
          [holder.dataset.from, holder.dataset.to] = [min, max];
          if (key === "x" && !sharing && min !== null) zoomTo(data.group, min, max);
        }],
      },
    };
  }

  // A button for each curve that shows its value where the pointer is, and takes it away: those places.
  function keys(panel, box, above, turn) {
    const bar = live.element("div", { class: "bar" });
    // a lone curve by the name of its panel
    const lone = panel.curves.length === 1 && panel.label.startsWith(panel.curves[0].label);
    if (above && !lone) box.append(live.element("div", { class: "small" }, panel.label));
    box.append(bar);
    return panel.curves.map((curve, n) => {
      const value = live.element("span"), key = live.button("", { class: "key", "aria-pressed": "true" }, () => {
        const show = key.getAttribute("aria-pressed") !== "true";
        key.setAttribute("aria-pressed", String(show));
        turn(n, show);
      });
      key.append(live.swatchOf(curve), `${above && lone ? panel.label : curve.label} `, value);
      bar.append(key);
      return value;
    });
  }

  function makePanel(room, data, panel, number) {
    const box = live.element("div", { class: "panel" });
    const turn = (n, show) => plot.setSeries(order.indexOf(n) + 1, { show });
    const shown = keys(panel, box, isAbove(panel, data), turn);
    const [, unit] = panel.label.match(/\[(.*)\]/) || ["", ""];
    const values = panel.curves.map((curve) => live.numbers(curve.values));
    // the lowest has the title for all, unless they are side by side or more than a screen is high
    const many = data.columns > 1 || data.panels.length > ON_A_SCREEN;
    const last = many || number === data.panels.length - 1;
    const onCursor = (plot) => {
      const at = plot.cursor.idx;
      const isThere = at !== null && at !== undefined;
      shown.forEach((value, n) => (value.textContent = isThere ? `${live.told(values[n][at])} ${unit}` : ""));
      if (floor) said.textContent = isThere ? floor.read(plot) : "";
    };
    const floor = panel.map && floorOf(panel, data), said = live.element("output", { class: "small" });
    if (floor) box.append(live.scale(panel.map), said);
    const drawn = panel.stacked ? stacked(panel.curves, values) : values;
    // filled ones from the highest down, so that each covers the lower part of the one before
    const places = panel.curves.map((_, n) => n), filled = places.filter((n) => panel.stacked && panel.curves[n].fill);
    const order = [...filled.reverse(), ...places.filter((n) => !filled.includes(n))];
    const sorted = { ...panel, curves: order.map((n) => panel.curves[n]) };
    const holder = live.element("div", {
      class: "plot", tabindex: "0", role: "group",
      "aria-label": `${panel.label} over time. Arrow keys move the pointer, plus and minus zoom, ` +
        "shift and arrows move along, Home shows the whole run.",
    });
    box.append(holder);
    room.append(box);
    const columns = [data.time, ...order.map((n) => Array.from(drawn[n], (v) => (Number.isFinite(v) ? v : null)))];
    const plot = new uPlot(options(sorted, data, number === 0, last, onCursor, holder, floor), columns, holder);
    const { time } = data, { height } = plot, lone = time[0] === time[time.length - 1] ? 0.5 : 0;
    plots.push({ plot, group: data.group, begin: time[0] - lone, end: time[time.length - 1] + lone });
    live.onWidth(holder, (width) => plot.setSize({ width, height: live.onPaper() ? PAPER * height : height }));
    live.clock.follow(() => plot.redraw(false, false));
    holder.addEventListener("keydown", (event) => onKey(event, data.group, plot, Boolean(floor)));
    return plot;
  }

  function onKey(event, group, plot, mapped) {
    const { key, shiftKey } = event, factor = { "+": 0.5, "=": 0.5, "-": 2 }[key];
    const shift = { ArrowLeft: -1, ArrowRight: 1 }[key], rise = { ArrowUp: -1, ArrowDown: 1 }[key];
    if (shift && shiftKey) zoomBy(group, plot, 1, 0.25 * shift);
    else if (shift || (rise && mapped)) point(plot, shift || 0, rise || 0);
    else if (factor) zoomBy(group, plot, factor);
    else if (["Home", "0", "Escape"].includes(key)) zoomTo(group, -Infinity, Infinity);
    else return;
    event.preventDefault();
  }

  // The pointer a hundredth of what is seen further; it begins in the middle.
  function point(plot, across, down) {
    const [left, top] = [["left", "width", across], ["top", "height", down]].map(([edge, size, step]) => {
      const length = plot.bbox[size] / density(), at = plot.cursor[edge];
      return Math.max(0, Math.min(length, (at >= 0 ? at : 0.5 * length) + 0.01 * step * length));
    });
    plot.setCursor({ left, top }, true);
  }

  function controls(stage, data, plot) {
    const bar = live.element("div", { class: "bar" }), { group } = data;
    const add = (text, label, call) => bar.append(live.button(text, { "aria-label": label }, call));
    add("whole run", "show the whole run", () => zoomTo(group, -Infinity, Infinity));
    if (data.part) add(data.part[2], `zoom to ${data.part[2]}`, () => zoomTo(group, data.part[0], data.part[1]));
    add("+", "zoom in", () => zoomBy(group, plot(), 0.5));
    add("−", "zoom out", () => zoomBy(group, plot(), 2));
    add("◀", "earlier", () => zoomBy(group, plot(), 1, -0.5));
    add("▶", "later", () => zoomBy(group, plot(), 1, 0.5));
    const shaded = live.swatch(SHADE, "outline: 1px solid #c9b48a");
    if (data.phases.length && data.phase) bar.append(live.element("span", {}, shaded, data.phase));
    const [rows, all] = data.rows;
    if (rows < all) bar.append(live.element("span", { class: "soft" },
      `${rows} of ${all} rows; lowest, highest and all known events are among them`));
    stage.append(bar);
  }

  function make(stage, data) {
    data.time = live.numbers(data.time);
    data.group = `${data.heading || "run"} ${data.time[0]} to ${data.time[data.time.length - 1]}`;
    if (data.heading) stage.append(live.element("h3", {}, data.heading));
    data.phases = live.numbers(data.phases);
    let first = null;
    controls(stage, data, () => first);
    const room = live.element("div", { class: data.columns > 1 ? "columns" : "" });
    stage.append(room);
    const made = data.panels.map((panel, number) => makePanel(room, data, panel, number));
    first = made[0];
    if (data.opens_at_part) zoomTo(data.group, data.part[0], data.part[1]);
    if (data.note) stage.append(live.element("p", { class: "small" }, data.note));
  }

  live.each("over_time", (stage, data) => {
    for (const one of data.figures || [data]) make(stage, one);
  });
})();
