// The rig from above in motion: belt with its temperature, springs, block.
"use strict";
live.each("top_view", (stage, data) => {
  const INK = "#222", BLUE = "#0072b2", RED = "#a34700", TURNS = 9, ARROW = 0.05, MARKS = 0.05;
  const times = live.numbers(data.time), travel = live.numbers(data.travel), mode = live.numbers(data.mode);
  const x = live.numbers(data.x), y = live.numbers(data.y), phi = live.numbers(data.phi);
  const [left, right, low, high] = data.box;
  const map = data.map && live.dataOf(data.map);
  const canvas = live.element("canvas", { role: "img", "aria-label": "the rig from above at the time of the slider" });
  const said = live.element("output", { class: "small" });
  const plot = live.element("div", { class: "plot" });
  plot.append(canvas);
  stage.append(plot);
  let colours = null, levels = null, mapTimes = null, contact = null;
  if (map) {
    colours = live.colours(map.colours);
    levels = live.numbers(map.levels);
    mapTimes = live.numbers(map.time);
    contact = live.numbers(map.contact);
    stage.append(live.scale(map, "rise over the air"));
  }
  // below the rig, so that the dark does not turn its colours over
  const floor = map && live.element("canvas", { class: "map" });
  if (map) plot.prepend(floor);
  let context = null, ground = null, width = 0, scale = 1, now = data.start;
  const px = (metres) => (metres - left) * scale;
  const py = (metres) => (high - metres) * scale;

  // Between two rows a straight line.
  function at(values, row, part) {
    const next = Math.min(row + 1, values.length - 1);
    return values[row] + part * (values[next] - values[row]);
  }

  // The colour of the belt so far (m) ahead of the middle of the block: its material is looked up
  // in the map, where the block stands at this very time.
  function colour(row, ahead) {
    const [, places] = map.shape;
    const place = (((contact[row] + ahead) / map.length) % 1 + 1) % 1;
    return colours[levels[row * places + Math.min(places - 1, Math.floor(place * places))]];
  }

  function drawBelt(pose, moved) {
    const half = 0.5 * data.width, row = map ? live.placeOf(mapTimes, now) : 0;
    const top = data.width ? py(half) : 0, bottom = data.width ? py(-half) : py(low);
    ground.fillStyle = "#e3e3e3";
    ground.fillRect(0, top, width, bottom - top);
    if (map) {
      for (let column = 0; column < width; column++) {
        ground.fillStyle = `rgb(${colour(row, left + (column + 0.5) / scale - pose.x)})`;
        ground.fillRect(column, top, 1.5, bottom - top);
      }
    }
    // marks that lie on the belt
    ground.strokeStyle = map ? "rgba(255,255,255,.75)" : "#8a8a8a";
    ground.lineWidth = 1.5;
    const first = Math.ceil((left - moved) / MARKS);
    for (let n = first; n * MARKS + moved < right; n++) chevron(px(n * MARKS + moved), top, bottom);
  }

  function chevron(at, top, bottom) {
    const size = Math.min(6, 0.12 * (bottom - top)), forwards = data.speed < 0 ? -1 : 1;
    for (const middle of [top + size + 3, bottom - size - 3]) {
      ground.beginPath();
      ground.moveTo(at - forwards * size, middle - size);
      ground.lineTo(at, middle);
      ground.lineTo(at - forwards * size, middle + size);
      ground.stroke();
    }
  }

  // A slab turns about its centre; the block goes round on a ring of it.
  function drawSlab(pose, moved) {
    const centre = 1 / data.curvature, radius = Math.abs(centre), side = Math.sign(centre);
    const row = map ? live.placeOf(mapTimes, now) : 0;
    ground.fillStyle = map && !live.onPaper() ? getComputedStyle(stage).getPropertyValue("--line") : "#e3e3e3";
    ground.fillRect(0, 0, width, py(low));
    // points of the ring by the way along it from below the centre
    const ring = (way, r) => {
      const angle = way / radius;
      return [px(r * Math.sin(angle)), py(centre - side * r * Math.cos(angle))];
    };
    const reach = Math.max(-left, right) * 1.3, inner = radius - 0.5 * data.ring, outer = radius + 0.5 * data.ring;
    if (map) {
      const here = radius * Math.atan2(pose.x, radius - side * pose.y), step = 1.2 / scale;
      ground.lineWidth = 2.4;
      for (let way = -reach; way < reach; way += step) {
        ground.strokeStyle = `rgb(${colour(row, way - here)})`;
        ground.beginPath();
        ground.moveTo(...ring(way, inner));
        ground.lineTo(...ring(way, outer));
        ground.stroke();
      }
    }
    ground.strokeStyle = map ? "rgba(255,255,255,.4)" : "#b5b5b5";
    ground.lineWidth = 1;
    const first = Math.ceil((-reach - moved) / MARKS);
    for (let n = first; n * MARKS + moved < reach; n++) {
      ground.beginPath();
      ground.moveTo(...ring(n * MARKS + moved, inner));
      ground.lineTo(...ring(n * MARKS + moved, outer));
      ground.stroke();
    }
  }

  function drawSpring(x0, y0, x1, y1) {
    const length = Math.hypot(x1 - x0, y1 - y0), ux = (x1 - x0) / length, uy = (y1 - y0) / length;
    context.beginPath();
    context.moveTo(px(x0), py(y0));
    for (let n = 0; n <= 2 * TURNS + 1; n++) {
      const along = length * (0.12 + 0.76 * n / (2 * TURNS + 1));
      const across = n === 0 || n === 2 * TURNS + 1 ? 0 : n % 2 ? 0.003 : -0.003;
      context.lineTo(px(x0 + along * ux - across * uy), py(y0 + along * uy + across * ux));
    }
    context.lineTo(px(x1), py(y1));
    context.stroke();
  }

  function disc(at, height, radius, fill, stroke) {
    context.beginPath();
    context.arc(px(at), py(height), radius, 0, 2 * Math.PI);
    if (fill) { context.fillStyle = fill; context.fill(); }
    if (stroke) { context.strokeStyle = stroke; context.stroke(); }
  }

  function drawBlock(pose) {
    const c = Math.cos(pose.phi), s = Math.sin(pose.phi), radius = data.radius * scale;
    const ends = [0, 1, 2, 3].map((n) => {
      const bx = data.arms[2 * n], by = data.arms[2 * n + 1];
      return [pose.x + c * bx - s * by, pose.y + s * bx + c * by];
    });
    context.setLineDash([2, 3]);
    context.lineWidth = 1;
    disc(0, 0, radius, null, "#5c5c5c");
    context.setLineDash([]);
    context.lineWidth = 3;
    context.strokeStyle = BLUE;
    for (const [ex, ey] of ends) {
      context.beginPath();
      context.moveTo(px(pose.x), py(pose.y));
      context.lineTo(px(ex), py(ey));
      context.stroke();
    }
    context.lineWidth = 2;
    disc(pose.x, pose.y, radius, "rgba(207,227,241,.82)", BLUE);
    context.beginPath();
    context.moveTo(px(pose.x), py(pose.y));
    context.lineTo(px(pose.x + 0.8 * data.radius * c), py(pose.y + 0.8 * data.radius * s));
    context.stroke();
    ends.forEach(([ex, ey], n) => {
      const ax = data.anchors[2 * n], ay = data.anchors[2 * n + 1];
      // a pale edge, to be seen on whatever colour the belt has
      for (const [stroke, thick] of [["rgba(255,255,255,.8)", 3.5], [INK, 1.3]]) {
        context.strokeStyle = stroke;
        context.lineWidth = thick;
        drawSpring(ax, ay, ex, ey);
      }
      context.lineWidth = 1;
      disc(ex, ey, 3.5, INK, "#fff");
      context.fillStyle = INK;
      context.fillRect(px(ax) - 5, py(ay) - 5, 10, 10);
      context.strokeStyle = "#fff";
      context.strokeRect(px(ax) - 5, py(ay) - 5, 10, 10);
    });
  }

  // The direction of the surface, below the rig.
  function drawWords() {
    const y0 = py(low) - 12, forwards = data.speed < 0 ? -1 : 1;
    const from = 14 + (forwards < 0 ? 40 : 0), to = from + 40 * forwards;
    context.fillStyle = "#fff";
    context.fillRect(0, y0 - 10, width, 30);
    context.strokeStyle = context.fillStyle = RED;
    context.lineWidth = 2.5;
    if (data.speed) {
      context.beginPath();
      context.moveTo(from, y0);
      context.lineTo(to - 8 * forwards, y0);
      context.stroke();
      context.beginPath();
      context.moveTo(to, y0);
      context.lineTo(to - 10 * forwards, y0 - 5);
      context.lineTo(to - 10 * forwards, y0 + 5);
      context.fill();
    }
    context.font = '13px system-ui, "DejaVu Sans", sans-serif';
    const way = Math.abs(data.speed) ? `${data.curvature ? "slab" : "belt"}, ${live.told(Math.abs(data.speed))} m/s` : "";
    context.fillText(way, 62, y0 + 4);
  }

  function draw(time) {
    now = time;
    if (!context) return;
    const row = live.placeOf(times, time), next = Math.min(row + 1, times.length - 1);
    const span = times[next] - times[row], part = span > 0 ? (time - times[row]) / span : 0;
    const pose = { x: at(x, row, part), y: at(y, row, part), phi: at(phi, row, part) };
    for (const each of new Set([context, ground])) each.clearRect(0, 0, width, py(low) + 2);
    (data.curvature ? drawSlab : drawBelt)(pose, at(travel, row, part));
    drawBlock(pose);
    drawWords();
    // of a millimetre and of a degree: less is rounding
    const told = (value) => live.told(Math.abs(value) < 1e-6 ? 0 : value, 3);
    said.textContent = `t = ${time.toFixed(2)} s, ${mode[row] ? "slip" : "stick"}; x = ${told(1e3 * pose.x)} mm, ` +
      `y = ${told(1e3 * pose.y)} mm, φ = ${told(pose.phi * 180 / Math.PI)}°`;
  }

  stage.append(live.element("p", { class: "small" }, `${data.words}.`));
  live.player(stage, times, data.start, draw);
  stage.append(said);
  live.onWidth(stage, (wide) => {
    width = wide;
    scale = width / (right - left);
    context = live.sized(canvas, width, (high - low) * scale);
    ground = map ? live.sized(floor, width, (high - low) * scale) : context;
    draw(now);
  });
});
