// Play and pause, a slider for the time, a choice of speeds; the space bar and the arrow keys.
"use strict";
live.player = function (stage, times, start, show) {
  const begin = times[0], end = times[times.length - 1];
  const button = live.button("▶ play", {}, () => set(!playing));
  const slider = live.element("input", {
    type: "range", min: String(begin), max: String(end), step: "any", value: String(begin), "aria-label": "time",
  });
  const rate = live.element("select", { "aria-label": "speed" });
  const rates = [[0.1, "a tenth"], [0.25, "a quarter"], [1, "real time"], [4, "4 times"]];
  rate.append(...rates.map(([value, word]) => live.element("option", { value }, word)));
  rate.value = "1";
  stage.append(live.element("div", { class: "bar" }, button, slider, rate));

  let time = begin, playing = false, last = 0;

  function go(to) {
    time = Math.max(begin, Math.min(end, to));
    slider.value = String(time);
    slider.setAttribute("aria-valuetext", `${time.toFixed(2)} seconds`);
    show(time);
    live.clock.show(time);
  }

  function set(state) {
    playing = state;
    button.textContent = state ? "❚❚ pause" : "▶ play";
    if (!state) return;
    if (time >= end) time = begin;
    last = performance.now();
    requestAnimationFrame(step);
  }

  function step(now) {
    if (!playing) return;
    go(time + Number(rate.value) * (now - last) / 1000);
    last = now;
    if (time >= end) set(false);
    else requestAnimationFrame(step);
  }

  slider.addEventListener("input", () => go(Number(slider.value)));
  // one row further, where a range input would go a hundredth of the run
  slider.addEventListener("keydown", (event) => {
    const by = { ArrowLeft: -1, ArrowRight: 1, ArrowDown: -1, ArrowUp: 1, PageDown: -50, PageUp: 50 }[event.key];
    if (event.key === " ") set(!playing);
    else if (by) go(times[Math.max(0, Math.min(times.length - 1, live.placeOf(times, time) + by))]);
    else return;
    event.preventDefault();
  });
  time = Math.max(begin, Math.min(end, start));
  slider.value = String(time);
  show(time);
};
