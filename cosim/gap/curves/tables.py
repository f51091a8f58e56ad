"""A curve over the sliding speed as a table of friction, in the model and fitted on in it.

One look from the plain model tells that the sliding speed matters; what the model's other numbers
had made up for it, they give back only where the curve is in the model. A contact whose friction is
free to fall slowly is a curve over the sliding speed itself: what is seen from there is what it
lacks, not the law. So the table is sought from a contact that falls within the curve's first
stretch.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from cosim.gap.candidates.plain import EXPONENT, TRANSITION
from cosim.gap.data import MeasuredRun
from cosim.gap.estimation.drive import TABLE, parts_at, table
from cosim.gap.estimation.trial import Model
from cosim.gap.evidence.settled import Settled, settled
from cosim.processes import Map

from .axes import simulated
from .columns import of_sliding_speed
from .curve import Curve
from .spline import KNOTS
from .vote import counted, quick

#: Points of a table: as many as the kernel takes.
POINTS = 16
#: Looks from a model with the table, the turns in which such a model settles, and the first one.
LOOKS, _TURNS, _QUICK_TURNS = 4, 2, 4
#: Parts of the way to a curve that are tried: what was seen along a line may be far too much of it.
_PARTS = (1.0, 0.3, 0.1)


def table_of(curve: Curve) -> dict[str, float]:
    """Settings `friction.table_speed[i]`, `friction.table_mu[i]` of a curve, for a scenario."""
    speeds, factors = _points(curve)
    return table(speeds, curve.level * factors, TABLE)


def with_table(
    base: Settled, runs: Sequence[MeasuredRun], curve: Curve, turns: int = _TURNS
) -> Settled:
    """The base with a curve over the sliding speed in it, its other numbers settled anew."""
    settings = {**base.model.settings, **table(*_points(curve))}
    model = replace(base.model, settings=settings)
    return settled(base.problem.segmented_runs, runs, model, base, turns)


def refined(
    base: Settled, runs: Sequence[MeasuredRun], curve: Curve, mapped: Map, looks: int = LOOKS
) -> tuple[Curve, Settled]:
    """A curve over the sliding speed and the model that holds it, the likeliest of some looks.

    base : the plain model, from which the curve was first seen, up to the fastest sliding
    """
    if looks < 1:
        raise ValueError(f"looks = {looks}: must be at least 1")
    before = falling_at_once(base, runs, float(curve.values[-1]))
    now = _seen(before, runs, mapped)
    found: list[tuple[Curve, Settled]] = []
    for _ in range(looks):
        ways = [(before, runs, _towards(before, now, part)) for part in _PARTS]
        after = min(mapped(with_table, ways), key=lambda each: each.deviance)
        if found and after.deviance >= found[-1][1].deviance:
            break
        more = _seen(after, runs, mapped)
        before, now = after, _together(after, more, base.left_out - after.left_out)
        found.append((now, after))
    return found[-1]


def falling_at_once(base: Settled, runs: Sequence[MeasuredRun], fastest: float) -> Settled:
    """The plain model with a contact that falls within the first stretch of a curve up to a speed.

    From the balance of forces: from where a slow fall was left the way back is long.
    """
    model = base.model
    stretch = fastest / (KNOTS - 1) ** 2  # knots are even over the root of the speed
    shape = next((f.start for f in model.free_parameters if f.key == EXPONENT), None)
    settings = model.settings if shape is None else {**model.settings, EXPONENT: shape}
    free_parameters = tuple(
        replace(f, high=max(stretch, f.start)) if f.key == TRANSITION else f
        for f in model.free_parameters
        if f.key != EXPONENT
    )
    quickly = Model(free_parameters, settings)
    return settled(base.problem.segmented_runs, runs, quickly, None, _QUICK_TURNS)


def _seen(base: Settled, runs: Sequence[MeasuredRun], mapped: Map) -> Curve:
    """What one look from a model sees over the sliding speed."""
    return counted(base, quick(base, of_sliding_speed(base, runs, simulated(base), mapped)))


def _towards(before: Settled, curve: Curve, part: float) -> Curve:
    """A part of the way from the table that a model has to a curve."""
    held = np.log(np.maximum(parts_at(before.model.settings, curve.values), 1e-6))
    held -= held.mean()
    return replace(curve, mean=held + part * (curve.mean - held))


def _together(after: Settled, more: Curve, gains: np.ndarray) -> Curve:
    """What a model's table says and what a look from there adds; gains : of the model itself."""
    held = np.log(np.maximum(parts_at(after.model.settings, more.values), 1e-6))
    middle = float(held.mean())
    about = held - middle
    return replace(
        more,
        mean=more.mean + about,
        low=more.low + about,
        high=more.high + about,
        level=more.level * float(np.exp(middle)),
        gain=float(gains.sum()),
        error=float(np.std(gains, ddof=1) * np.sqrt(gains.size)),
        gains=gains,
    )


def _points(curve: Curve) -> tuple[np.ndarray, np.ndarray]:
    """Speeds, m/s, and factors on the curve's level."""
    if (curve.axis, curve.on) != ("sliding speed", "mu_k"):
        raise ValueError(f"a table is of mu_k over sliding speed, not of {curve.on}, {curve.axis}")
    places = np.linspace(0, curve.values.size - 1, POINTS)
    speeds = np.interp(places, np.arange(curve.values.size), curve.values)
    return speeds, np.exp(np.interp(speeds, curve.values, curve.mean))
