"""Faults of the camera as candidates, searched beside the effects of the catalogue.

What is confounded with what (a belt of speed v under a block on linear springs, omega^2 = 4 k / m,
m x'' = -4 k x + mu m g in slip, x' = v in stick; the data x(t)):

* **scale**, x -> (1 + a) x, is mu -> (1 + a) mu and v -> (1 + a) v, exactly. mu is fitted, so it is
  the set-point of v that tells: by the slope of the sticks. g and k / m are in omega and in the
  force per metre; they pin mu, not the scale. Exactly one class with **a surface that is faster by
  a in every run** (`offset.speed`, one value); and with mu alone where nothing ever sticks. It is
  not a wrong spring: k / m -> (1 - a) k / m has the same place at a given mu, but another period.
  A coefficient measured by itself (`[friction]`) tells it from the surface's speed. Laws of the
  sliding speed follow with v -> v / (1 + a); hardening springs, and lengths of the rig, tell too.
* **clock**, t -> (1 + b) t, is k / m -> k / m / (1 + b)^2, mu -> mu / (1 + b)^2, v -> v / (1 + b),
  exactly: a class with softer springs (or a heavier block) *on a surface that is slower by half of
  that*, not with either alone. Without sticks: with stiffness over mass alone. Where sticks are
  long and swings are not resolved the slope alone is left, and it is a class with the scale.
* **rotation** by alpha: y = -x sin alpha, also in stick, when a block on the belt goes along x
  alone: no friction across, no crooked spring does that. Along x it is a scale of cos alpha. Not
  seen where y is not measured; a class with a belt that runs askew to camera *and* springs.
* **drift** of x by d(t) is a friction that changes by 4 k d / (m g), mu_s and mu_k alike by the
  same *amount*, exactly where d is slow against a period: a class with such a drift of friction in
  runs of one m / k. Runs of other m / k tell (a camera's creep does not know the spring), as do a
  change in proportion to mu (the stroke changes with it) and a drift of y. One course for the
  campaign: what warms up or settles after it was touched does so alike in every run, and only that
  can be foretold of a run that was held out. A zero per run is plain.
* **latency** c over 0.1 m: x(t) + c x x' to first order, thus a slope of sticks v / (1 - c v) - a
  scale that grows with v - and strokes that lean over. With one speed nearly a class with the
  scale. A delay that is the same for all samples is not seen by any data of one clock.
* **smoothing** rounds corners in time: a Gaussian all of them alike and both ways, a filter of the
  past as a delay that is longer where the motion bends. Nearly a class with a contact that lets go
  over a distance or a speed where the corners are all that is seen; these round break-aways and
  re-sticks differently, and by more in fast runs.
  A stick that creeps before it lets go, where the model's contact is rigid, is taken for a filter
  or for a scale: creep and the transition to slip are plain, and are fitted before any of these.
* **quantisation** is no number of a fit: see `cosim.gap.camera.quantisation`.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from math import inf

from stickslip.effects.candidate import Candidate, FreeParameter, Scales

#: Beyond these a camera is not off but useless: part of scale and clock; rad; s over 0.1 m, the
#: whole frame's read-out of a slow chip (10 to 30 ms, Meingast 2005) with a block that crosses it
#: in a third; s of a filter.
_MOST_SCALE, _MOST_CLOCK, _MOST_TURN, _MOST_DELAY, _MOST_FILTER = 0.15, 0.15, 0.5, 0.1, 0.3
#: A settling camera is seen to settle between these parts of a run: faster it has, slower it is a
#: steady drift.
_SOONEST, _LATEST = 0.02, 3.0
#: A creep starts as this part of the stroke, and may be no larger than the stroke.
_CREEP = 0.03


def measurement_candidates(scales: Scales, channels: Collection[str]) -> tuple[Candidate, ...]:
    """Every fault that the channels ("x", "y", "phi") can show, with the places to set out from."""
    across = "y" in channels
    return (
        _one("scale", "factor", 0.01, 0.005, _MOST_SCALE),
        _one("clock", "factor", 0.005, 0.002, _MOST_CLOCK),
        *(_rotation() if across else ()),
        *_drifts(scales, across),
        _one("latency", "rolling shutter", 0.002, 0.001, _MOST_DELAY),
        _filter("smoothing", "Gaussian"),
        _filter("smoothing_past", "of the past"),
    )


def _one(fault: str, form: str, start: float, step: float, most: float) -> Candidate:
    free = FreeParameter(f"measurement.{fault}", start, step, -most, most)
    return Candidate(f"measurement.{fault}", form, (free,))


def _rotation() -> Iterator[Candidate]:
    free = FreeParameter("measurement.rotation", 0.02, 0.01, -_MOST_TURN, _MOST_TURN)
    yield Candidate("measurement.rotation", "angle", (free,), lateral=True)


def _filter(name: str, form: str) -> Candidate:
    """A width is not negative; a Gaussian is felt by its square: it does not start at nothing."""
    free = FreeParameter(f"measurement.{name}", 0.01, 0.002, 0.0, _MOST_FILTER)
    return Candidate("measurement.smoothing", form, (free,))


def _drifts(scales: Scales, across: bool) -> Iterator[Candidate]:
    """Steady; settling; and logarithmic, as clamps and feet creep under a load."""
    yield Candidate("measurement.drift", "linear", _creep("rate", scales, across))
    for form, kind, time in (
        ("settling", "", "measurement.drift_time"),
        ("logarithmic", "log", "measurement.drift_log_time"),
    ):
        constant = FreeParameter(
            time, 0.2 * scales.duration, 0.3, _SOONEST * scales.duration,
            _LATEST * scales.duration, log=True,
        )  # fmt: skip
        yield Candidate("measurement.drift", form, (*_creep(kind, scales, across), constant))


def _creep(kind: str, scales: Scales, across: bool) -> tuple[FreeParameter, ...]:
    """Amounts of a course of the zeros: of x, and of y where it is measured."""
    unit = scales.travel / scales.duration if kind == "rate" else scales.travel
    most = unit if unit > 0.0 else inf
    name = f"measurement.drift_{kind}_" if kind else "measurement.drift_"
    return tuple(
        FreeParameter(f"{name}{axis}", _CREEP * unit, 0.3 * _CREEP * unit, -most, most)
        for axis in ("xy" if across else "x")
    )
