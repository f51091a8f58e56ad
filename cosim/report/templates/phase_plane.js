// Ways in a plane of velocity over place.
"use strict";
(() => {
  const SIZE = 340, FAINT = 0.15, FULL = 0.9, PIECES = 24, MARGIN = 0.06;

  function ends(ways, name) {
    const all = ways.flatMap((way) => way[name] ? [way[name].reduce((a, b) => (b < a ? b : a), Infinity),
      way[name].reduce((a, b) => (b > a ? b : a), -Infinity)] : []).filter(Number.isFinite);
    if (!all.length) return [0, 1];
    const low = Math.min(...all), high = Math.max(...all), room = MARGIN * (high - low) || 0.5;
    return [low - room, high + room];
  }

  function draw(plot, { fades, ...way }) {
    const pieces = fades ? PIECES : 1, count = way.y.length, dash = way.dash ? live.DASH : [];
    if (!way.x) live.plots.line(plot, "y", plot.valToPos(way.y[0], "y", true), way.colour, way.width, dash);
    else for (let n = 0; n < pieces; n++) {
      plot.ctx.globalAlpha = fades ? FAINT + (FULL - FAINT) * n / (pieces - 1) : 1;
      const [from, to] = [Math.floor(n * count / pieces), Math.min(count, Math.ceil((n + 1) * count / pieces) + 1)];
      live.plots.way(plot, { ...way, dash, from, to });
    }
    plot.ctx.globalAlpha = 1;
  }

  function make(room, { across, upwards, ways }) {
    for (const way of ways) {
      way.x = way.x && live.numbers(way.x);
      way.y = live.numbers(way.y);
    }
    const box = live.element("div", { class: "panel" }), bar = live.element("div", { class: "bar" });
    for (const way of ways) if (way.label) bar.append(live.element("span", {}, live.swatchOf(way), way.label));
    const holder = live.element("div", { class: "plot" });
    box.append(bar, holder);
    room.append(box);
    const ranges = [ends(ways, "x"), ends(ways, "y")], drawAll = (plot) => ways.forEach((way) => draw(plot, way));
    const axes = [{ size: 26, label: across }, { size: 58, label: upwards }];
    const plot = live.plots.plane(holder, axes, [8, 14, 0, 0], () => ranges, drawAll);
    live.onWidth(holder, (width) => plot.setSize({ width, height: live.onPaper() ? 0.6 * SIZE : SIZE }));
  }

  live.each("phase_plane", (stage, { planes }) => {
    const room = live.element("div", { class: planes.length > 1 ? "columns" : "" });
    stage.append(room);
    for (const plane of planes) make(room, plane);
  });
})();
