// Ways in a plane of velocity over place, on uPlot's axes: their points do not go from left to right.
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

  function stroke(plot, way, from, to) {
    const { ctx } = plot;
    let isDown = false;
    ctx.beginPath();
    for (let i = from; i < to; i++) {
      if (!Number.isFinite(way.x[i]) || !Number.isFinite(way.y[i])) { isDown = false; continue; }
      ctx[isDown ? "lineTo" : "moveTo"](plot.valToPos(way.x[i], "x", true), plot.valToPos(way.y[i], "y", true));
      isDown = true;
    }
    ctx.stroke();
  }

  function draw(plot, ways) {
    const { ctx, bbox } = plot, dense = devicePixelRatio || 1;
    ctx.save();
    ctx.lineJoin = "round";
    for (const way of ways) {
      ctx.strokeStyle = way.colour;
      ctx.lineWidth = way.width * dense;
      ctx.setLineDash(way.dash ? live.DASH.map((length) => length * dense) : []);
      const pieces = way.fades ? PIECES : 1, count = way.y.length;
      if (!way.x) {
        const height = plot.valToPos(way.y[0], "y", true);
        ctx.beginPath();
        ctx.moveTo(bbox.left, height);
        ctx.lineTo(bbox.left + bbox.width, height);
        ctx.stroke();
      } else for (let n = 0; n < pieces; n++) {
        ctx.globalAlpha = way.fades ? FAINT + (FULL - FAINT) * n / (pieces - 1) : 1;
        stroke(plot, way, Math.floor(n * count / pieces), Math.min(count, Math.ceil((n + 1) * count / pieces) + 1));
      }
      ctx.globalAlpha = 1;
    }
    ctx.restore();
  }

  function make(room, { across, upwards, ways }) {
    for (const way of ways) {
      way.x = way.x && live.numbers(way.x);
      way.y = live.numbers(way.y);
    }
    const box = live.element("div", { class: "panel" }), bar = live.element("div", { class: "bar" });
    for (const { label, colour, dash } of ways.filter((way) => way.label)) {
      const swatch = live.swatch(colour);
      if (dash) swatch.style.height = ".15rem";
      bar.append(live.element("span", {}, swatch, label));
    }
    const holder = live.element("div", { class: "plot" });
    box.append(bar, holder);
    room.append(box);
    const x = ends(ways, "x"), y = ends(ways, "y");
    const look = { ...live.axis, labelSize: 18 };
    const plot = new uPlot({
      width: 300, height: SIZE, legend: { show: false }, cursor: { show: false }, padding: [8, 14, 0, 0],
      scales: { x: { time: false, range: x }, y: { range: y } }, series: [{}, {}],
      axes: [{ ...look, size: 26, label: across }, { ...look, size: 58, label: upwards }],
      hooks: { draw: [(plot) => draw(plot, ways)] },
    }, [x, [null, null]], holder);
    live.onWidth(holder, (width) => plot.setSize({ width, height: live.onPaper() ? 0.6 * SIZE : SIZE }));
  }

  live.each("phase_plane", (stage, { planes }) => {
    const room = live.element("div", { class: planes.length > 1 ? "columns" : "" });
    stage.append(room);
    for (const plane of planes) make(room, plane);
  });
})();
