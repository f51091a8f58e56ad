// What all live pictures share: their numbers, their stage, and the time that they all show.
"use strict";
const live = (() => {
  const KINDS = { f4: Float32Array, f8: Float64Array, u1: Uint8Array };

  // Numbers as Python packed them: base64 of a little-endian array.
  function numbers(packed) {
    const bytes = Uint8Array.from(atob(packed.data), (letter) => letter.charCodeAt(0));
    return new KINDS[packed.type](bytes.buffer);
  }

  function element(tag, attributes = {}, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    made.append(...children);
    return made;
  }

  function button(text, attributes, call) {
    const made = element("button", { type: "button", ...attributes }, text);
    made.addEventListener("click", call);
    return made;
  }

  // An attribute with a value; without one (false), none.
  function attribute(one, name, value) {
    if (value) one.setAttribute(name, value);
    else one.removeAttribute(name);
  }

  // The colour of a phase or of a curve, for a legend.
  const swatch = (colour, look = "") => element("span", { class: "swatch", style: `background: ${colour}; ${look}` });
  const swatchOf = ({ colour, dash }) => swatch(colour, dash ? "height: .15rem" : "");

  // A number with so many significant digits and a true minus, as the rest of the page has them.
  function told(value, digits = 4) {
    if (!Number.isFinite(value)) return "–";
    const size = Math.abs(value);
    const text = size !== 0 && (size < 1e-4 || size >= 1e6)
      ? value.toExponential(digits - 1).replace(/\.?0+e/, "e").replace("e+", "e")
      : String(Number(value.toPrecision(digits)));
    return text.replaceAll("-", "−");
  }

  // What axes look like, whatever is between them.
  const DASH = [5, 4], FONT = '12px system-ui, "DejaVu Sans", sans-serif';
  const axis = { stroke: "#222", font: FONT, labelFont: FONT, grid: { stroke: "#e3e3e3", width: 1 },
    ticks: { stroke: "#8a8a8a", width: 1, size: 5 },
    values: (_, values) => values.map((value) => (value === null ? "" : told(value, 6))) };

  // Each figure of a kind with its data and an empty stage; none where its script fails.
  function each(kind, draw) {
    for (const figure of document.querySelectorAll("figure.live:has(script)")) {
      const script = figure.querySelector("script"), data = JSON.parse(script.textContent);
      if (data.kind !== kind) continue;
      const stage = element("div", { class: "stage", role: "group", "aria-label": figure.dataset.alt });
      if (data.title) stage.append(element("h3", {}, data.title));
      figure.insertBefore(stage, script);
      figure.classList.add("on");
      try {
        draw(stage, data, figure);
      } catch (error) {
        stage.remove();
        figure.classList.remove("on");
        console.error(figure.dataset.name, error);
      }
    }
  }

  function dataOf(name) {
    const script = document.querySelector(`figure.live[data-name="${name}"] script`);
    return script && JSON.parse(script.textContent);
  }

  // Call with the width of a box, at once and whenever it changes; on paper that of a sheet, which
  // there is before it is printed.
  const looks = [];
  for (const [event, on] of [["beforeprint", true], ["afterprint", false]]) {
    addEventListener(event, () => {
      document.documentElement.classList.toggle("paper", on);
      for (const look of looks) look();
    });
  }
  const onPaper = () => document.documentElement.classList.contains("paper");

  function onWidth(box, call) {
    let width = 0;
    const look = () => {
      if (box.clientWidth && box.clientWidth !== width) call((width = box.clientWidth));
    };
    looks.push(look);
    new ResizeObserver(look).observe(box);
    look();
  }

  // A canvas for so many CSS pixels, sharp on any screen; its context, in CSS pixels.
  function sized(canvas, width, height) {
    const dense = window.devicePixelRatio || 1;
    canvas.width = Math.round(width * dense);
    canvas.height = Math.round(height * dense);
    canvas.style.width = `${width}px`;
    canvas.style.height = `${height}px`;
    const context = canvas.getContext("2d");
    context.setTransform(dense, 0, 0, dense, 0, 0);
    return context;
  }

  // The context of a canvas, in CSS pixels, with as many pixels as the screen has where it lies.
  function fitted(canvas) {
    const dense = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((size) => Math.round(size * dense));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const context = canvas.getContext("2d");
    context.setTransform(dense, 0, 0, dense, 0, 0);
    return context;
  }

  // "rrggbb" after "rrggbb" as [r, g, b] after [r, g, b].
  function colours(table) {
    const colour = (text) => text.match(/../g).map((part) => parseInt(part, 16));
    return table.match(/.{6}/g).map(colour);
  }

  // The scale of a colour table: lowest value, colours, highest value.
  function scale(map) {
    const stops = colours(map.colours).filter((_, i) => i % 15 === 0).map((c) => `rgb(${c})`);
    const style = `background: linear-gradient(to right, ${stops})`;
    return element("div", { class: "bar" },
      element("span", {}, map.label), element("span", {}, told(map.low, 3)),
      element("span", { class: "ramp", role: "presentation", style }),
      element("span", {}, `${told(map.high, 3)} ${map.unit}`));
  }

  // The last place at which a rising array is not above a value.
  function placeOf(array, value) {
    let low = 0, high = array.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (array[middle] <= value) low = middle; else high = middle - 1;
    }
    return low;
  }

  // The time that the animation shows, for whoever draws over time.
  const listeners = [];
  const clock = {
    time: null,
    follow: (call) => listeners.push(call),
    show(time) {
      clock.time = time;
      for (const call of listeners) call(time);
    },
  };

  return { DASH, FONT, axis, numbers, element, button, attribute, swatch, swatchOf, told, each, dataOf, onPaper, onWidth,
    sized, fitted, colours, scale, placeOf, clock };
})();
