"use strict";
/* Block, springs and surface from above, in the frame of the rig, to scale. */

const ICE_STICK = "rgba(156,200,228,.85)", ICE_SLIP = "rgba(240,176,124,.85)";

class TopView {
  constructor(canvas) {
    this.canvas = canvas;
  }

  /* now: x, y, phi, surface_travel, mode of the moment. */
  show(run, now) {
    if (!run.anchors || this.canvas.clientWidth === 0) return;
    const context = live.fitted(this.canvas), { clientWidth: width, clientHeight: height } = this.canvas;
    context.fillStyle = "#ffffff";
    context.fillRect(0, 0, width, height);
    const radius = run.scenario.get("rig.contact_radius");
    const rig = {
      anchors: run.anchors, arms: run.attachments, radius, ring: 2 * radius, speed: run.scenario.get("surface.speed"),
      curvature: kernelValue(run.scenario, "turning_surface.curvature"), width: beltWidth(run.scenario),
    };
    const view = this.view(rig, width, height), pose = { ...now, travel: now.surface_travel };
    live.rig.surface(context, rig, view, pose);
    live.rig.block(context, rig, view, pose, now.mode === 1 ? ICE_SLIP : ICE_STICK);
    this.words(context, rig, now, view);
  }

  /* Where a point of the rig (m) is on the canvas: x to the right, y upwards. */
  view({ anchors, radius }, width, height) {
    const [xs, ys] = [0, 1].map((axis) => [...anchors].filter((_, i) => i % 2 === axis));
    const [left, right] = [Math.min(...xs, -2 * radius), Math.max(...xs, 2 * radius)];
    const [low, high] = [Math.min(...ys, -1.4 * radius), Math.max(...ys, 1.4 * radius)];
    const scale = Math.min((width - 40) / (right - left), (height - 56) / (high - low));
    const [cx, cy] = [(left + right) / 2, (low + high) / 2];
    return { scale, width, height, x: (x) => width / 2 + (x - cx) * scale, y: (y) => height / 2 - (y - cy) * scale };
  }

  words(context, rig, now, { scale, width, height }) {
    Object.assign(context, { font: live.FONT, fillStyle: INK, textBaseline: "top", textAlign: "left" });
    context.fillText(now.mode === 1 ? "slip" : "stick", 8, 6);
    context.textAlign = "center";
    const speed = now.surface_speed_actual;
    const arrow = speed > 0 ? " →" : speed < 0 ? " ←" : "";
    const what = rig.curvature ? "turning slab" : `belt, ${live.told(MM * rig.width, 3)} mm wide`;
    context.fillText(`${what}, ${live.told(MM * speed, 3)} mm/s${arrow}`, width / 2, 6);
    const bar = 0.05 * scale;
    Object.assign(context, { textBaseline: "bottom", textAlign: "right" });
    context.fillText("50 mm", width - 10, height - 9);
    context.fillRect(width - 10 - bar, height - 7, bar, 2);
  }
}

const beltWidth = (scenario) => scenario.tables.belt?.width ?? DATA.belt_width;
