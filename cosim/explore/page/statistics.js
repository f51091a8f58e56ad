"use strict";
/* What a motion is like after the run-up: the numbers of `after_run_up` in summary.json. */

function statistics(run) {
  const begin = run.rampEnd, end = run.rows ? run.time[run.rows - 1] : 0, window = end - begin;
  const aways = run.events.filter(([time, mode]) => mode === 1 && time >= begin && time <= end);
  const starts = aways.map(([time]) => time);
  const first = run.time.findIndex((time) => time >= begin);
  const late = { from: first < 0 ? run.rows : first, to: run.rows };
  const reached = window > 0;
  const period = starts.length > 1 ? (starts.at(-1) - starts[0]) / (starts.length - 1) : NaN;
  return {
    begin,
    duration: reached ? window : 0,
    break_aways: starts.length,
    frequency: reached && starts.length === 0 ? 0 : 1 / period,
    mean_period: period,
    slip_share: reached ? slipTime(run, begin, end) / window : NaN,
    mean_x: timeMean(run, "x", late, "vx"),
    ...extremes(run, "x", late, "vx"),
    mean_y: timeMean(run, "y", late, "vy"),
    ...extremes(run, "y", late, "vy"),
    max_rotation_deg: (largest(run, "phi", late, "omega") * 180) / Math.PI,
    mean_friction_force_x: timeMean(run, "friction_force_x", late),
    mean_heat_flow: reached && late.to > late.from
      ? (run.at("heat", late.to - 1) - run.at("heat", late.from)) / window : NaN,
  };
}

/* Begin and end of every slip, s. */
function slips(run) {
  if (run.rows === 0) return [];
  const found = [], end = run.time[run.rows - 1];
  let since = run.at("mode", 0) === 1 ? run.time[0] : null;
  for (const [time, mode] of [...run.events, [end, 0]]) {
    if (time <= run.time[0] || time > end) continue;
    if (mode === 0 && since !== null) found.push([since, time]);
    since = mode === 0 ? null : since ?? time;
  }
  return found;
}

function slipTime(run, begin, end) {
  const inside = ([from, to]) => Math.max(0, Math.min(to, end) - Math.max(from, begin));
  return slips(run).reduce((sum, slip) => sum + inside(slip), 0);
}

/* Mean over time; of a position, whose rate of change is given, of the cubics between the rows. */
function timeMean(run, name, { from, to }, rate = "") {
  if (to - from < 2) return to > from ? run.at(name, from) : NaN;
  let sum = 0;
  for (let i = from + 1; i < to; i++) {
    const size = run.time[i] - run.time[i - 1];
    sum += 0.5 * (run.at(name, i) + run.at(name, i - 1)) * size;
    if (rate) sum -= ((run.at(rate, i) - run.at(rate, i - 1)) * size ** 2) / 12;
  }
  return sum / (run.time[to - 1] - run.time[from]);
}

/* Of those cubics, or of the rows. */
function extremes(run, name, { from, to }, rate = "") {
  let [low, high] = [Infinity, -Infinity];
  const take = (value) => { low = Math.min(low, value); high = Math.max(high, value); };
  for (let i = from; i < to; i++) {
    take(run.at(name, i));
    if (rate && i > from) turns(run, name, i, rate).forEach(take);
  }
  return { [`min_${name}`]: low, [`max_${name}`]: high };
}

/* Values where the cubic from the row before row i turns. */
function turns(run, name, i, rate) {
  const size = run.time[i] - run.time[i - 1], start = run.at(name, i - 1);
  const rise = run.at(name, i) - start;
  const first = size * run.at(rate, i - 1), last = size * run.at(rate, i);
  const square = 3 * rise - 2 * first - last, cube = first + last - 2 * rise;
  const root = Math.sqrt(Math.max(square ** 2 - 3 * cube * first, 0));
  return [square + root, square - root].map((part) => -first / part)
    .filter((s) => s > 0 && s < 1)
    .map((s) => start + s * (first + s * (square + s * cube)));
}

function largest(run, name, rows, rate) {
  const ends = Object.values(extremes(run, name, rows, rate)).map(Math.abs);
  return rows.to > rows.from ? Math.max(...ends) : NaN;
}

/* What the block does, in words. */
function regime(numbers) {
  if (!(numbers.duration > 0)) return "still in the run-up";
  if (numbers.slip_share >= 1) return "slides without ever sticking";
  if (numbers.slip_share === 0) return "sticks and never slips";
  return numbers.break_aways > 1 ? "sticks and slips" : "comes to rest";
}
