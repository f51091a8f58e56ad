// The rig from above in motion, on the belt with its temperature.
"use strict";
live.each("top_view", (stage, data) => {
  const WORDS = 26, RED = "#a34700", ICE = "rgba(207,227,241,.82)";
  const [times, travel, mode, x, y, phi] = ["time", "travel", "mode", "x", "y", "phi"].map((name) => live.numbers(data[name]));
  const [left, right, low, high] = data.box;
  const known = data.map && live.dataOf(data.map), map = known && known.panels[0].map;
  const canvas = live.element("canvas", { role: "img", "aria-label": "the rig from above at the time of the slider" });
  const said = live.element("output", { class: "small" });
  const plot = live.element("div", { class: "plot" }, canvas);
  stage.append(plot);
  let colours, levels, mapTimes, contact, floor;
  if (map) {
    colours = live.colours(map.colours);
    [levels, mapTimes, contact] = [map.levels, known.time, known.panels[0].curves[0].values].map(live.numbers);
    stage.append(live.scale(map));
    // below the rig, so that the dark does not turn its colours over
    plot.prepend(floor = live.element("canvas", { class: "map" }));
  }
  let context = null, ground = null, view = null, now = data.start;

  // The colour of the belt so far (m) ahead of the middle of the block: its material is looked up
  // in the map, where the block stands at this very time.
  function colourAt(time) {
    const [, places] = map.shape, row = live.placeOf(mapTimes, time);
    return (ahead) => {
      const place = (((contact[row] + ahead) / map.length) % 1 + 1) % 1;
      return `rgb(${colours[levels[row * places + Math.min(places - 1, Math.floor(place * places))]]})`;
    };
  }

  // The direction of the surface, below the rig.
  function drawWords() {
    const y0 = view.height - 12, forwards = data.speed < 0 ? -1 : 1;
    const from = 14 + (forwards < 0 ? 40 : 0), to = from + 40 * forwards;
    for (const each of new Set([context, ground])) each.clearRect(0, y0 - 10, view.width, 30);
    if (!data.speed) return;
    context.strokeStyle = context.fillStyle = RED;
    context.lineWidth = 2.5;
    live.rig.stroke(context, [from, y0], [to - 8 * forwards, y0]);
    context.beginPath();
    for (const [back, up] of [[0, 0], [10, -5], [10, 5]]) context.lineTo(to - back * forwards, y0 + up);
    context.fill();
    context.font = '13px system-ui, "DejaVu Sans", sans-serif';
    context.fillText(`${data.curvature ? "slab" : "belt"}, ${live.told(Math.abs(data.speed))} m/s`, 62, y0 + 4);
  }

  function draw(time) {
    now = time;
    if (!context) return;
    const row = live.placeOf(times, time), next = Math.min(row + 1, times.length - 1);
    const span = times[next] - times[row], part = span > 0 ? (time - times[row]) / span : 0;
    const at = (values) => values[row] + part * (values[next] - values[row]);
    const pose = { x: at(x), y: at(y), phi: at(phi), travel: at(travel) };
    for (const each of new Set([context, ground])) each.clearRect(0, 0, view.width, view.height + 2);
    // what is not turned over in the dark
    data.ground = ground === context ? "" : getComputedStyle(stage).getPropertyValue("--line");
    live.rig.surface(ground, data, view, pose, map && colourAt(time));
    live.rig.block(context, data, view, pose, ICE);
    drawWords();
    // of a millimetre and of a degree: less is rounding
    const told = (value) => live.told(Math.abs(value) < 1e-6 ? 0 : value, 3);
    said.textContent = `t = ${time.toFixed(2)} s, ${mode[row] ? "slip" : "stick"}; x = ${told(1e3 * pose.x)} mm, ` +
      `y = ${told(1e3 * pose.y)} mm, φ = ${told(pose.phi * 180 / Math.PI)}°`;
  }

  stage.append(live.element("p", { class: "small" }, `${data.words}.`));
  live.player(stage, times, data.start, draw);
  stage.append(said);
  live.onWidth(stage, (width) => {
    const scale = width / (right - left), height = (high - low) * scale + WORDS;
    view = { scale, width, height, x: (metres) => (metres - left) * scale, y: (metres) => (high - metres) * scale };
    context = live.sized(canvas, width, height);
    // on paper what is cleared is white, and covers what is below
    if (map) floor.style.display = live.onPaper() ? "none" : "";
    ground = map && !live.onPaper() ? live.sized(floor, width, height) : context;
    draw(now);
  });
});
