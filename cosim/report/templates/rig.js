// The rig from above, to scale: the surface with marks that go with it, springs and block.
//
// rig: anchors and arms (four times x, y; m), radius of the block, width of the belt (none: not known),
// curvature of the surface (1/m, 0 of a belt), ring (m, the track on a slab), speed, ground (colour of the
// surface; none: pale grey). view: x, y (m) to pixels, scale, and width and height in pixels of what is seen. pose: x, y, phi, travel of the surface.
"use strict";
live.rig = (() => {
  const INK = "#222", BLUE = "#0072b2", PLAIN = "#e3e3e3", TURNS = 9, MARKS = 0.05;

  function stroke(context, ...points) {
    context.beginPath();
    for (const point of points) context.lineTo(...point);
    context.stroke();
  }

  // The surface; colour: of what is so far (m) ahead of the middle of the block, none where not known.
  const surface = (context, rig, ...how) => (rig.curvature ? slab : belt)(context, rig, ...how);

  function belt(context, rig, view, pose, colour) {
    const half = 0.5 * rig.width, metres = (pixels) => (pixels - view.x(0)) / view.scale;
    const top = rig.width ? view.y(half) : 0, bottom = rig.width ? view.y(-half) : view.height;
    context.fillStyle = rig.ground || PLAIN;
    context.fillRect(0, top, view.width, bottom - top);
    for (let column = 0; colour && column < view.width; column++) {
      context.fillStyle = colour(metres(column + 0.5) - pose.x);
      context.fillRect(column, top, 2, bottom - top); // without seams on paper
    }
    context.strokeStyle = colour ? "rgba(255,255,255,.75)" : "#8a8a8a";
    context.lineWidth = 1.5;
    const size = Math.min(6, 0.12 * (bottom - top)), ahead = rig.speed < 0 ? -size : size;
    for (let n = Math.ceil((metres(0) - pose.travel) / MARKS); n * MARKS + pose.travel < metres(view.width); n++) {
      const at = view.x(n * MARKS + pose.travel);
      for (const middle of [top + size + 3, bottom - size - 3]) {
        stroke(context, [at - ahead, middle - size], [at, middle], [at - ahead, middle + size]);
      }
    }
  }

  // A slab turns about its centre; the block goes round on a ring of it.
  function slab(context, rig, view, pose, colour) {
    const centre = 1 / rig.curvature, radius = Math.abs(centre), side = Math.sign(centre);
    context.fillStyle = rig.ground || PLAIN;
    context.fillRect(0, 0, view.width, view.height);
    // points of the ring by the way along it from below the centre
    const at = (way, r) => [view.x(r * Math.sin(way / radius)), view.y(centre - side * r * Math.cos(way / radius))];
    const across = (way) => stroke(context, at(way, radius - 0.5 * rig.ring), at(way, radius + 0.5 * rig.ring));
    const reach = Math.min(1.3 * view.width / view.scale, Math.PI * radius);
    const here = radius * Math.atan2(pose.x, radius - side * pose.y);
    context.lineWidth = 2.4;
    for (let way = -reach; colour && way < reach; way += 1.2 / view.scale) {
      context.strokeStyle = colour(way - here);
      across(way);
    }
    context.strokeStyle = colour ? "rgba(255,255,255,.4)" : "#b5b5b5";
    context.lineWidth = 1;
    for (let n = Math.ceil((-reach - pose.travel) / MARKS); n * MARKS + pose.travel < reach; n++) {
      across(n * MARKS + pose.travel);
    }
  }

  function spring(context, view, x0, y0, x1, y1) {
    const length = Math.hypot(x1 - x0, y1 - y0), ux = (x1 - x0) / length, uy = (y1 - y0) / length;
    const coil = Array.from({ length: 2 * TURNS + 2 }, (_, n) => {
      const along = length * (0.12 + 0.76 * n / (2 * TURNS + 1));
      const across = n === 0 || n === 2 * TURNS + 1 ? 0 : n % 2 ? 0.003 : -0.003;
      return [view.x(x0 + along * ux - across * uy), view.y(y0 + along * uy + across * ux)];
    });
    stroke(context, [view.x(x0), view.y(y0)], ...coil, [view.x(x1), view.y(y1)]);
  }

  function disc(context, view, at, height, radius) {
    context.beginPath();
    context.arc(view.x(at), view.y(height), radius, 0, 2 * Math.PI);
  }

  // Springs and block, in a colour; dotted: where it is at rest.
  function block(context, rig, view, pose, colour) {
    const c = Math.cos(pose.phi), s = Math.sin(pose.phi), radius = rig.radius * view.scale;
    const middle = [view.x(pose.x), view.y(pose.y)];
    const ends = [0, 1, 2, 3].map((n) => {
      const [bx, by] = rig.arms.slice(2 * n, 2 * n + 2);
      return [pose.x + c * bx - s * by, pose.y + s * bx + c * by];
    });
    context.setLineDash([2, 3]);
    Object.assign(context, { lineWidth: 1, strokeStyle: "#5c5c5c" });
    disc(context, view, 0, 0, radius);
    context.stroke();
    context.setLineDash([]);
    Object.assign(context, { lineWidth: 3, strokeStyle: BLUE });
    for (const [ex, ey] of ends) stroke(context, middle, [view.x(ex), view.y(ey)]);
    Object.assign(context, { lineWidth: 2, fillStyle: colour });
    disc(context, view, pose.x, pose.y, radius);
    context.fill();
    context.stroke();
    stroke(context, middle, [view.x(pose.x + 0.8 * rig.radius * c), view.y(pose.y + 0.8 * rig.radius * s)]);
    ends.forEach(([ex, ey], n) => {
      const [ax, ay] = rig.anchors.slice(2 * n, 2 * n + 2);
      // a pale edge, to be seen on whatever colour the belt has
      for (const [edge, thick] of [["rgba(255,255,255,.8)", 3.5], [INK, 1.3]]) {
        Object.assign(context, { strokeStyle: edge, lineWidth: thick });
        spring(context, view, ax, ay, ex, ey);
      }
      Object.assign(context, { lineWidth: 1, fillStyle: INK, strokeStyle: "#fff" });
      disc(context, view, ex, ey, 3.5);
      context.fill();
      context.stroke();
      context.fillRect(view.x(ax) - 5, view.y(ay) - 5, 10, 10);
      context.strokeRect(view.x(ax) - 5, view.y(ay) - 5, 10, 10);
    });
  }

  return { stroke, surface, block };
})();
