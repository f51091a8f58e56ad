// The belt's temperature over time (across) and place (upwards), with the way of the block; hover or
// use the arrow keys to read it.
"use strict";
live.each("belt_map", (stage, data) => {
  const HEIGHT = 320, PAPER = 0.5, LEFT = 52, BOTTOM = 40, TOP = 8, RIGHT = 8, FONT = '12px system-ui, "DejaVu Sans", sans-serif';
  const time = live.numbers(data.time), contact = live.numbers(data.contact), levels = live.numbers(data.levels);
  const [times, places] = data.shape, colours = live.colours(data.colours);
  const begin = time[0], end = time[times - 1] > begin ? time[times - 1] : begin + 1;
  const canvas = live.element("canvas", {
    class: "map", tabindex: "0", role: "img",
    "aria-label": `Temperature of the ${data.surface} over time and place. Arrow keys move the pointer.`,
  });
  const said = live.element("output", { class: "small" });
  const picture = painted();
  let context = null, width = 0, tall = HEIGHT, pointer = null;
  stage.append(canvas, live.scale(data, "rise over the air"), said);

  // One pixel for each number: times across, places upwards.
  function painted() {
    const made = live.element("canvas");
    made.width = times;
    made.height = places;
    const inside = made.getContext("2d"), image = inside.createImageData(times, places);
    for (let t = 0; t < times; t++) {
      for (let p = 0; p < places; p++) {
        const at = 4 * ((places - 1 - p) * times + t), [r, g, b] = colours[levels[t * places + p]];
        image.data.set([r, g, b, 255], at);
      }
    }
    inside.putImageData(image, 0, 0);
    return made;
  }

  const inner = () => width - LEFT - RIGHT;
  const px = (t) => LEFT + inner() * (t - begin) / (end - begin);
  const py = (place) => TOP + tall * (1 - place / data.length);

  function drawAxes() {
    context.fillStyle = live.onPaper() ? "#222" : getComputedStyle(canvas).color;
    context.strokeStyle = "#8a8a8a";
    context.lineWidth = 1;
    context.font = FONT;
    context.textAlign = "center";
    for (const t of live.ticks(begin, end, inner() / 80)) {
      context.fillText(live.told(t), px(t), TOP + tall + 17);
      context.strokeRect(px(t), TOP + tall, 0, 4);
    }
    context.fillText("time [s]", LEFT + 0.5 * inner(), TOP + tall + 34);
    context.textAlign = "right";
    for (const place of live.ticks(0, data.length, 5)) {
      context.fillText(live.told(place), LEFT - 7, py(place) + 4);
      context.strokeRect(LEFT - 4, py(place), 4, 0);
    }
    context.save();
    context.translate(12, TOP + 0.5 * tall);
    context.rotate(-Math.PI / 2);
    context.textAlign = "center";
    context.fillText(`place on the ${data.surface} [m]`, 0, 0);
    context.restore();
  }

  function drawWay() {
    context.strokeStyle = "#56b4e9";
    context.lineWidth = 1.2;
    context.beginPath();
    for (let t = 0; t < times; t++) {
      const jump = t === 0 || Math.abs(contact[t] - contact[t - 1]) > 0.5 * data.length;
      context[jump ? "moveTo" : "lineTo"](px(time[t]), py(contact[t]));
    }
    context.stroke();
  }

  function cross(t, place) {
    context.strokeStyle = "#fff";
    context.setLineDash([3, 3]);
    context.strokeRect(px(t), TOP, 0, tall);
    if (place !== null) context.strokeRect(LEFT, py(place), inner(), 0);
    context.setLineDash([]);
  }

  function draw() {
    if (!context) return;
    context.clearRect(0, 0, width, TOP + tall + BOTTOM);
    context.imageSmoothingEnabled = false;
    context.drawImage(picture, LEFT, TOP, inner(), tall);
    drawWay();
    drawAxes();
    if (live.clock.time !== null && live.clock.time <= end) cross(live.clock.time, null);
    if (!pointer) return;
    cross(...pointer);
    const row = live.placeOf(time, pointer[0]);
    const column = Math.min(places - 1, Math.floor(pointer[1] / data.length * places));
    const value = data.low + (data.high - data.low) * levels[row * places + column] / 255;
    said.textContent = `${live.told(pointer[0], 3)} s, ${live.told(pointer[1], 3)} m: ` +
      `${live.told(value, 3)} ${data.unit} over the air`;
  }

  function move(t, place) {
    pointer = [Math.max(begin, Math.min(end, t)), Math.max(0, Math.min(data.length, place))];
    draw();
  }

  canvas.addEventListener("pointermove", (event) => {
    const box = canvas.getBoundingClientRect();
    move(begin + (end - begin) * (event.clientX - box.left - LEFT) / inner(),
      data.length * (1 - (event.clientY - box.top - TOP) / tall));
  });
  canvas.addEventListener("keydown", (event) => {
    const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key];
    if (!by) return;
    const [t, place] = pointer || [0.5 * (begin + end), 0.5 * data.length];
    move(t + by[0] * (end - begin) / 100, place + by[1] * data.length / 50);
    event.preventDefault();
  });
  live.clock.follow(draw);
  live.onWidth(stage, (wide) => {
    width = wide;
    tall = live.onPaper() ? PAPER * HEIGHT : HEIGHT;
    context = live.sized(canvas, width, TOP + tall + BOTTOM);
    draw();
  });
});
