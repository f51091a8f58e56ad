"""Faults of the camera as unknowns, asked beside the effects.

What each does to the rows, for a belt of speed V under a block on linear springs, omega^2 = K / m,
m x'' + K x = F in slip, x' = V in stick; x~ is what is written:

* **scale**, x~ = (1 + a) x: F and V are larger by a. F is fitted, so the slopes of the sticks tell,
  and break-aways a little, whose overshoot V / omega is taken off unscaled. Exactly a surface that
  is faster by a in every run. Not a wrong spring, which has another period.
* **clock**, t~ = (1 + b) t: m x'' counts more by 2 b and V is less by b. Exactly springs softer by
  2 b *on a surface slower by b*; without sticks springs alone, without slips a scale of -b.
* **drift**, x~ = x + d(t): friction, static and kinetic, that changes by K d / (m g), by the same
  amount. Runs of other m / K tell, and the slopes of sticks (V + d').
* **latency**, x~(t) = x(t + c x~ / 0.1 m): sticks of the slope V (1 + c V / 0.1 m) and strokes that
  lean over. With one speed nearly a scale. Not linear in c: what a delay of one of some sizes does
  is asked for, by how much of it there is. A delay of all samples alike is not seen by any data of
  one clock.
* **smoothing**, x~ = x convolved with a kernel of the standard deviation w: inside slips and sticks
  that commutes with the equation of motion and is not seen. A corner, where x'' jumps by J, is
  rounded: a gap of w^2 J / 2 opens between line and curve (see `corners`), and about it stays

      Gaussian       J w^2 [(u^2 + 1) / 2 (P(u) - H(u)) + u p(u) / 2],   u = t / w, p = P' normal
      of the past   -J w^2 exp(-u - 1) after it,
      a mean         J w^2 [(u + r)^3 / (12 r) - H(u) (u^2 + 1) / 2] for |u| < r = sqrt(3),

  on the side of the slip; H is the step. A filter of the past is a delay as well, which is not
  seen. A contact that lets go and grips as bristles do leaves gaps alike, up to w of some 10 ms.
* **zero**: places of a run, or of all, off by more than the campaign states.

A fault often sits in some runs only. Which these may be is read off the fault's size in each run by
itself: the runs are ordered by it, and the first of the order are asked together.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.special import ndtr

from cosim.gap.weak_form.added import Added
from cosim.gap.weak_form.constants import FAULT_SIZES, FILTER_WIDTHS, LATENCIES, LONGER, MOST_LEAN
from cosim.gap.weak_form.corners import CornerResponse, CornerRows
from cosim.gap.weak_form.rig_unknowns import Level
from cosim.gap.weak_form.rows import Response, RunRows
from cosim.gap.weak_form.system import Rung
from cosim.gap.weak_form.track import derivatives
from cosim.gap.weak_form.unknowns import Unknown, column

#: Place along x over which a rolling shutter's delay is stated, m.
ACROSS = 0.1
#: Courses of a zero that creeps, from 0 at the beginning of a run (u = 0) to 1 at its end (u = 1).
COURSES: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "linear": lambda u: u,
    "settling": lambda u: -np.expm1(-5.0 * u),
    "root": np.sqrt,
    "logarithmic": lambda u: np.log1p(20.0 * u) / np.log(21.0),
}
DRIFT, SMOOTHING = "measurement.drift", "measurement.smoothing"
#: Filters of a tracker: their number is a setting of the fault. The last is a mean over a window.
FILTERS = GAUSSIAN, PAST, WINDOW = ("Gaussian", "of the past", "moving average")
#: What a variant's words end with that is in no run alone.
ALL_RUNS = "all runs"
#: Half the window of a mean, in standard deviations.
HALF_WINDOW = np.sqrt(3.0)
#: How far from a corner what a filter leaves is felt, in standard deviations: e^-31 of the last.
TAIL = 30.0
#: Every fault that has a name; a turned camera is found in the plane.
FAULTS = tuple(f"measurement.{name}" for name in (*FAULT_SIZES, "rotation", "quantisation"))

Respond = Callable[[RunRows], Response]


def camera_faults(rung: Rung) -> dict[str, list[Unknown]]:
    """fault -> its variants: in all runs, and in those which a rung's rows ask for."""
    level, runs = rung.system.level, rung.system.fitted
    made = {
        "measurement.scale": _among(rung, _fault("scale", scale(level))),
        "measurement.clock": _among(rung, _fault("clock", clock(level))),
        DRIFT: [
            one for number, course in enumerate(COURSES)  # the root lies between the others
            for one in _among(rung, _fault("drift", drift(course), course, course=number),
                              course == "root")
        ],
        "measurement.latency": latencies(rung),
        SMOOTHING: filters(rung),
        "measurement.zero": [replace(_fault("zero", zero, "each run"), per_run=True)],
    }  # fmt: skip
    if len({run.track.run.stiffness for run in runs}) > 1:  # else it is a force
        made["measurement.zero"].append(_fault("zero", zero, "all runs"))
    return {name: variants for name, variants in made.items() if variants}


def _fault(name: str, respond: Respond, variant: str = "", **settings: float) -> Unknown:
    """Of one size in all runs."""
    prior = FAULT_SIZES[name] ** 2 * np.eye(1)
    return Unknown(f"measurement.{name}", variant, respond, prior, settings=settings)


def scale(level: Level) -> Respond:
    """x~ = (1 + a) x, by a."""

    def respond(run: RunRows) -> Response:
        track = run.track
        held = column([event.force for event in run.events])
        return Response(
            force=column(level.kinetic * run.weight * track.direction),
            speed=np.full((track.time.size, 1), track.run.surface_speed),
            static=held + run.track.run.total_stiffness * _ahead(run)[1],
        )

    return respond


def clock(level: Level) -> Respond:
    """t~ = (1 + b) t, by b: m x'' = F - K x counts 2 b more."""

    def respond(run: RunRows) -> Response:
        track = run.track
        inertia = level.kinetic * run.weight * track.direction - run.restoring
        return Response(
            force=column(-2.0 * inertia),
            speed=np.full((track.time.size, 1), -track.run.surface_speed),
        )

    return respond


def crept(course: str, run: np.ndarray, times: np.ndarray) -> np.ndarray:
    """(n,) part of its creep that a zero has gone at times (n,), s, of a run's times (m,), s."""
    return np.asarray(COURSES[course]((times - run[0]) / (run[-1] - run[0])))


def drift(course: str) -> Respond:
    """x~ = x + d, by d at the end of a run, m."""

    def respond(run: RunRows) -> Response:
        return Response(place=column(crept(course, run.track.time, run.track.time)))

    return respond


def latencies(rung: Rung) -> list[Unknown]:
    """Delays in all runs, and in some, each about as long as it is asked for.

    Of a short one there may be less, it is in proportion.
    """
    delays = [sign * size for size in LATENCIES for sign in (1.0, -1.0)]
    forms = {delay: _fault("latency", latency(delay)) for delay in delays}
    best = max(delays, key=lambda one: rung.offered([replace(forms[one], per_run=True)])[0])
    found = [(delay, one) for delay in delays for one in _among(rung, forms[delay], False)]
    for one in _among(rung, forms[best])[1:]:
        size = _sizes(rung, one)[0][0]
        near = min(delays, key=lambda delay: abs(delay - size))
        names = frozenset(key.removeprefix("in@") for key, part in one.settings.items() if part)
        found.append((near, replace(one, respond=_within(latency(near), names))))

    def holds(delay: float, unknown: Unknown) -> bool:
        part = _sizes(rung, unknown)[0][0] / delay
        return part < LONGER and (part > 1.0 / LONGER or abs(delay) == LATENCIES[0])

    return [one for delay, one in found if holds(delay, one)]


def latency(delay: float) -> Respond:
    """x~(t) = x(t + c x~ / 0.1 m), by c, s, exact where c is the delay."""

    def respond(run: RunRows) -> Response:
        track = run.track
        later = (track.place - leaning(track.time, track.place, delay)) / delay
        static = -track.run.total_stiffness * _at_events(run, later)
        return Response(place=column(later), static=static)

    return respond


def leaning(time: np.ndarray, x: np.ndarray, delay: float) -> np.ndarray:
    """(n,) m: places x (n,) that are where they are later by a delay, s, for each 0.1 m of them.

    What a camera of the delay c sees of a motion is this with -c, the motion from what it saw with
    c. Where times would not grow, the delay is as long as they do.
    """
    there = np.isfinite(x)  # a model may be lost
    if there.sum() < 2:
        return x
    places, seen, late = np.full(x.shape, np.nan), time[there], delay * x[there] / ACROSS
    most = float(np.max(-np.diff(late) / np.diff(seen)))
    lean = seen + late * min(1.0, MOST_LEAN / max(most, 1e-300))
    places[there] = CubicSpline(lean, x[there])(seen)
    return places


def zero(run: RunRows) -> Response:
    """x~ = x + z, by z, m."""
    return Response(place=np.ones((run.track.time.size, 1)))


def smoothing(width: float, kind: str) -> Respond:
    """A filter of a standard deviation, s, by how much of w^2 there is. kind : of FILTERS"""
    past, rounding = kind == PAST, _ROUNDED[kind]

    def respond(run: RunRows) -> Response:
        if not isinstance(run, CornerRows):
            return Response(place=_undone(run, width)) if past else Response()
        own = run.track.run
        rounded = np.zeros(run.track.time.size)
        for corner in run.touched:
            reach = corner.time + TAIL * width * np.array([-1.0, 1.0])
            near = slice(*np.searchsorted(run.track.time, reach))
            at = (run.track.time[near] - corner.time) / width
            forward = at if corner.breaks or past else -at
            size = corner.acceleration * width**2 * (1.0 if corner.breaks or not past else -1.0)
            rounded[near] += size * rounding(forward)
        rounded += width * _at_the_ends(run, width, kind)
        lower = -0.5 * (own.natural_frequency * width) ** 2 * sum(_ahead(run))
        return CornerResponse(
            place=column(rounded),
            static=own.total_stiffness * (lower - _at_events(run, rounded)),
            gap=column([0.5 * width**2 * corner.acceleration for corner in run.corners]),
        )

    return respond


def _at_the_ends(run: RunRows, width: float, kind: str) -> np.ndarray:
    """(n,) m/s: what a filter leaves where a record begins and ends, as it holds the sample there.

    Of a velocity v there: v exp(-u) after the beginning; at either end v (p(u) - u P(-u)), or, of
    a mean, v (r - u)^2 / (4 r).
    """
    time, surface = run.track.time, run.track.run.surface_speed
    velocity = np.where(run.track.slips_mask, run.track.velocity, surface)
    begun, left = (time - time[0]) / width, (time[-1] - time) / width
    if kind == PAST:
        return np.asarray(velocity[0] * np.exp(-begun))

    def end(u: np.ndarray) -> np.ndarray:
        if kind == WINDOW:
            return np.asarray(np.maximum(HALF_WINDOW - u, 0.0) ** 2 / (4.0 * HALF_WINDOW))
        return np.asarray(np.exp(-0.5 * u**2) / np.sqrt(2.0 * np.pi) - u * ndtr(-u))

    return np.asarray(velocity[0] * end(begun) - velocity[-1] * end(left))


def _undone(run: RunRows, width: float) -> np.ndarray:
    """(n, 1) m: what an exponential filter takes off, -w x~' exactly, where no corner is found.

    So in fast runs: where a stick is shorter than the filter no slip reaches the surface's speed.
    """
    rate = derivatives(run.track.x, run.track.interval, 0.5 * width, 3)[1]
    return -width * column(rate)


def _gaussian(u: np.ndarray) -> np.ndarray:
    """What is left of a rounded corner, in J w^2: the slip is at u > 0, its own share taken off."""
    near = np.abs(u) < 6.0
    v = np.where(near, u, 0.0)
    density = np.exp(-0.5 * v**2) / np.sqrt(2.0 * np.pi)
    left = 0.5 * (v**2 + 1.0) * (ndtr(v) - (v > 0.0)) + 0.5 * v * density
    return np.where(near, left, 0.0)


def _past(u: np.ndarray) -> np.ndarray:
    """The same of an exponential filter: u = 0 is where curve and line seem to touch, w late."""
    return np.where(u > 0.0, -np.exp(-np.maximum(u, 0.0) - 1.0), 0.0)


def _mean(u: np.ndarray) -> np.ndarray:
    """The same of a mean over a window."""
    inside = np.clip(u, -HALF_WINDOW, HALF_WINDOW)
    left = (inside + HALF_WINDOW) ** 3 / (12.0 * HALF_WINDOW) - 0.5 * (u > 0.0) * (inside**2 + 1.0)
    return np.where(np.abs(u) < HALF_WINDOW, left, 0.0)


_ROUNDED = {GAUSSIAN: _gaussian, PAST: _past, WINDOW: _mean}


def _at_events(run: RunRows, place: np.ndarray) -> np.ndarray:
    """(events, 1) m: a place (n,) where the block lets go, ahead along the surface's motion.

    Break-aways are read off where the block turns: what is off at their instant alone is not seen.
    """
    return column(np.sign(run.track.run.surface_speed) * place[[e.at for e in run.events]])


def _ahead(run: RunRows) -> tuple[np.ndarray, np.ndarray]:
    """(events, 1) m: x_b - x_k, and (V / omega)^2 over it.

    All that is scaled by a part, but V / omega, shifts x_b = x_k + sqrt(A^2 - (V / omega)^2) by the
    second; A alone by their sum.
    """
    own, track = run.track.run, run.track
    slips = track.slips_mask
    balance = track.place[slips] + track.acceleration[slips] / own.natural_frequency**2
    middle = float(np.sign(own.surface_speed) * np.median(balance)) if slips.any() else 0.0
    over = abs(own.surface_speed) / own.natural_frequency
    ahead = column([event.force / own.total_stiffness - middle for event in run.events])
    ahead = np.maximum(ahead, 0.3 * over + 1e-9)
    return ahead, over**2 / ahead


def filters(rung: Rung) -> list[Unknown]:
    """Every width in all runs; that which the rows prefer in some; none that would sharpen.

    What a filter does is in proportion to no power of its width: the likeliest of a kind is asked
    for at the width that the rows have it with, too.
    """
    if not any(isinstance(run, CornerRows) for run in rung.system.fitted):
        return []
    variants: list[Unknown] = []
    for kind in FILTERS:
        forms = [_filter(kind, width) for width in FILTER_WIDTHS]
        best = max(forms, key=lambda form: rung.offered([replace(form, per_run=True)])[0])
        of_kind = [
            variant for form in forms
            for variant in _among(rung, form, in_some=form is best)
            if _sizes(rung, variant)[0][0] > 0.0
        ]  # fmt: skip
        if of_kind:
            likeliest = max(of_kind, key=lambda variant: rung.offered([variant])[0])
            width = likeliest.settings["width"] * np.sqrt(_sizes(rung, likeliest)[0][0])
            where = [key.removeprefix("in@") for key, part in likeliest.settings.items() if part]
            of_kind.append(_in_runs(rung, _filter(kind, width), where))
        variants += of_kind
    return variants


def likeliest_filters(rung: Rung, variants: Sequence[Unknown]) -> Iterator[tuple[float, Added]]:
    """Of each kind that in some runs, and that in all, which the rows prefer, and by which ln.

    rung : without any of them
    """
    for number, in_all in product(range(len(FILTERS)), (False, True)):
        of_kind = [variant for variant in variants if variant.settings["kind"] == number
                   and variant.variant.endswith(ALL_RUNS) == in_all]  # fmt: skip
        if of_kind:
            evidence, added = rung.offered(of_kind)
            yield evidence - rung.evidence, added


def filter_among(rung: Rung, unknown: Unknown, some: Collection[str]) -> Unknown:
    """The same filter in runs of these names."""
    kind, width = FILTERS[int(unknown.settings["kind"])], float(unknown.settings["width"])
    return _in_runs(rung, _filter(kind, width), some)


def _filter(kind: str, width: float) -> Unknown:
    words = f"{kind}, {1e3 * width:.0f} ms"
    number = FILTERS.index(kind)
    return _fault("smoothing", smoothing(width, kind), words, width=width, kind=number)


def _among(rung: Rung, unknown: Unknown, in_some: bool = True) -> list[Unknown]:
    """In all runs; and in those where it is largest, or most negative by itself: one, two, ...

    In all runs is as probable beforehand as in any of some.
    """
    names = [run.track.run.name for run in rung.system.fitted]
    in_all = _in_runs(rung, unknown, names)
    if not in_some or len(names) < 2:
        return [in_all]
    mean, sd = _sizes(rung, replace(unknown, per_run=True))
    order = [names[number] for number in np.argsort(-mean / sd)]
    found = [_in_runs(rung, unknown, each[:n])
             for each in (order, order[::-1]) for n in range(1, len(order))]  # fmt: skip
    return [in_all, *(replace(one, weight=unknown.weight / len(found)) for one in found)]


def _in_runs(rung: Rung, unknown: Unknown, some: Collection[str]) -> Unknown:
    """A fault in runs of these names alone."""
    names = [run.track.run.name for run in rung.system.fitted]
    among = frozenset(some).intersection(names)
    is_in_all = len(among) == len(names)
    words = ALL_RUNS if is_in_all else "in " + ", ".join(sorted(among))
    return replace(
        unknown, variant=", ".join(filter(None, [unknown.variant, words])),
        respond=unknown.respond if is_in_all else _within(unknown.respond, among),
        settings=unknown.settings | {f"in@{name}": float(name in among) for name in names},
    )  # fmt: skip


def _within(respond: Respond, names: frozenset[str]) -> Respond:
    return lambda run: respond(run) if run.track.run.name in names else Response()


def _sizes(rung: Rung, unknown: Unknown) -> tuple[np.ndarray, np.ndarray]:
    """Mean and standard deviation of an unknown's numbers on a rung."""
    added = Added(unknown)
    with_it = rung.with_more([added])
    mean, covariance = with_it.posterior
    part = with_it.part_of(added)
    return mean[part], np.sqrt(np.diag(covariance)[part])
