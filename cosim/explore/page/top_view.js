"use strict";
/* Block, springs and surface from above, in the frame of the rig, to scale. */

const SURFACE = "#e9e4da", SURFACE_MARK = "#b9b0a0", SPRING = "#555555", ICE_STICK = "#9cc8e4", ICE_SLIP = "#f0b07c";
const MARK_DISTANCE = 0.05; // m, between two marks on the surface

class TopView {
  constructor(canvas) {
    this.plot = new Plot(canvas, "", "", "");
    this.canvas = canvas;
  }

  /* now: x, y, phi, surface_travel, mode of the moment. */
  show(run, now) {
    if (!run.anchors || this.canvas.clientWidth === 0) return;
    this.plot.fit();
    const context = this.canvas.getContext("2d");
    const density = this.plot.density;
    const [width, height] = [this.canvas.width / density, this.canvas.height / density];
    context.setTransform(density, 0, 0, density, 0, 0);
    context.fillStyle = "#ffffff";
    context.fillRect(0, 0, width, height);
    context.font = FONT;
    const view = this.view(run, width, height);
    if (run.scenario.get("rig.surface") === "slab") this.slab(context, run, now, view, width, height);
    else this.belt(context, run, now, view, width);
    this.springs(context, run, now, view);
    this.block(context, run, now, view);
    this.words(context, run, now, view, width, height);
  }

  /* Where a point of the rig (m) is on the canvas: x to the right, y upwards. */
  view(run, width, height) {
    const xs = [], ys = [];
    for (let i = 0; i < 4; i++) {
      xs.push(run.anchors[2 * i]);
      ys.push(run.anchors[2 * i + 1]);
    }
    const radius = run.scenario.get("rig.contact_radius");
    const [left, right] = [Math.min(...xs, -2 * radius), Math.max(...xs, 2 * radius)];
    const [low, high] = [Math.min(...ys, -1.4 * radius), Math.max(...ys, 1.4 * radius)];
    const scale = Math.min((width - 40) / (right - left), (height - 56) / (high - low));
    const [cx, cy] = [(left + right) / 2, (low + high) / 2];
    return {
      scale,
      x: (x) => width / 2 + (x - cx) * scale,
      y: (y) => height / 2 - (y - cy) * scale,
    };
  }

  belt(context, run, now, view, width) {
    const half = beltWidth(run.scenario) / 2;
    context.fillStyle = SURFACE;
    context.fillRect(0, view.y(half), width, 2 * half * view.scale);
    context.strokeStyle = SURFACE_MARK;
    context.lineWidth = 2;
    const step = MARK_DISTANCE * view.scale;
    const first = (((view.x(now.surface_travel) % step) + step) % step) - step;
    for (let x = first; x < width + step; x += step) {
      stroke(context, x, view.y(half), x, view.y(0.6 * half));
      stroke(context, x, view.y(-half), x, view.y(-0.6 * half));
    }
  }

  /* Rays and rings about the centre of turning. */
  slab(context, run, now, view, width, height) {
    const distance = run.scenario.get("rig.slab_radius");
    const [cx, cy] = [view.x(0), view.y(distance)];
    context.fillStyle = SURFACE;
    context.fillRect(0, 0, width, height);
    context.strokeStyle = SURFACE_MARK;
    context.lineWidth = 1.5;
    const far = Math.hypot(width, height) + Math.abs(distance) * view.scale;
    const turned = now.surface_travel / distance;
    const rays = Math.max(8, Math.round((2 * Math.PI * Math.abs(distance)) / MARK_DISTANCE));
    for (let i = 0; i < rays; i++) {
      const angle = turned + (2 * Math.PI * i) / rays;
      stroke(context, cx, cy, cx + far * Math.cos(angle), cy - far * Math.sin(angle));
    }
  }

  springs(context, run, now, view) {
    const [c, s] = [Math.cos(now.phi), Math.sin(now.phi)];
    context.strokeStyle = SPRING;
    for (let i = 0; i < 4; i++) {
      const [bx, by] = [run.attachments[2 * i], run.attachments[2 * i + 1]];
      const from = [view.x(now.x + c * bx - s * by), view.y(now.y + s * bx + c * by)];
      const to = [view.x(run.anchors[2 * i]), view.y(run.anchors[2 * i + 1])];
      context.lineWidth = 2.5;
      stroke(context, view.x(now.x), view.y(now.y), ...from); // what holds the spring to the block
      context.lineWidth = 1.3;
      zigzag(context, from, to);
      context.fillStyle = INK;
      context.fillRect(to[0] - 3, to[1] - 6, 6, 12);
    }
  }

  block(context, run, now, view) {
    const radius = run.scenario.get("rig.contact_radius") * view.scale;
    const [x, y] = [view.x(now.x), view.y(now.y)];
    context.fillStyle = now.mode === 1 ? ICE_SLIP : ICE_STICK;
    context.globalAlpha = 0.85;
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fill();
    context.globalAlpha = 1;
    context.strokeStyle = INK;
    context.lineWidth = 1.5;
    context.stroke();
    context.lineWidth = 1;
    const [dx, dy] = [Math.cos(now.phi) * radius, -Math.sin(now.phi) * radius];
    stroke(context, x, y, x + dx, y + dy); // how it is turned
  }

  words(context, run, now, view, width, height) {
    const slab = run.scenario.get("rig.surface") === "slab";
    context.fillStyle = INK;
    context.textBaseline = "top";
    context.textAlign = "left";
    context.fillText(now.mode === 1 ? "slip" : "stick", 8, 6);
    context.textAlign = "center";
    const speed = now.surface_speed_actual;
    const arrow = speed > 0 ? " →" : speed < 0 ? " ←" : "";
    const what = slab ? "turning slab" : `belt, ${shown(MM * beltWidth(run.scenario), 3)} mm wide`;
    context.fillText(`${what}, ${shown(MM * speed, 3)} mm/s${arrow}`, width / 2, 6);
    const bar = 0.05 * view.scale;
    context.textBaseline = "bottom";
    context.textAlign = "right";
    context.fillText("50 mm", width - 10, height - 9);
    context.strokeStyle = INK;
    context.lineWidth = 2;
    stroke(context, width - 10 - bar, height - 6, width - 10, height - 6);
  }
}

function beltWidth(scenario) {
  return scenario.tables.belt?.width ?? DATA.belt_width;
}

/* A coil seen from the side. */
function zigzag(context, [x1, y1], [x2, y2]) {
  const length = Math.hypot(x2 - x1, y2 - y1) || 1;
  const [nx, ny] = [(-(y2 - y1) / length) * 5, ((x2 - x1) / length) * 5];
  const turns = 10;
  context.beginPath();
  context.moveTo(x1, y1);
  for (let i = 0; i <= turns; i++) {
    const part = 0.12 + (0.76 * i) / turns;
    const side = i === 0 || i === turns ? 0 : i % 2 ? 1 : -1;
    context.lineTo(x1 + (x2 - x1) * part + nx * side, y1 + (y2 - y1) * part + ny * side);
  }
  context.lineTo(x2, y2);
  context.stroke();
}
