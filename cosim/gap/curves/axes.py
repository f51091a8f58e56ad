"""Where every stretch of every run stands on the axes along which friction may drift."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from stickslip.kernel import layout
from stickslip.packing import GRAVITY

from cosim.gap.data import MeasuredRun
from cosim.gap.evidence.settled import Settled

from .spline import KNOTS, Spline

#: Times after which heat is forgotten, parts of the longest run: within a few cycles, in the course
#: of it, hardly.
MEMORIES = (0.03, 0.3, 3.0)
#: Axes along which changes are quick at first and then slow, and the one over which they go by
#: the decade.
_ROOT, _LOGARITHM = ("distance", "time", "heat memory"), ("hold time",)


@dataclass(frozen=True)
class Stretches:
    """An axis and where the stretches stand on it.

    Attributes
    ----------
    axis : of `stickslip.effects.effect.AXES`
    values : of every run (segments,); NaN where a stretch has no such number
    memory : time after which heat is forgotten, s; 0: not of this axis
    per : "mass" where the values are for each kilogram of the block, which heats with it; or ""
    """

    axis: str
    values: tuple[np.ndarray, ...]
    memory: float = 0.0
    per: str = ""

    @property
    def spline(self) -> Spline | None:
        """Over all of them; None where they do not differ."""
        values = np.concatenate(self.values)
        values = values[np.isfinite(values)]
        warped = "root" if self.axis in _ROOT else "logarithm" if self.axis in _LOGARITHM else ""
        if not values.size or np.ptp(values) <= 1e-9 * np.abs(values).max():
            return None
        return Spline(float(values.min()), float(values.max()), warped)


def stretches(
    base: Settled, runs: Sequence[MeasuredRun], outputs: Sequence[np.ndarray]
) -> list[Stretches]:
    """Of every axis, of heat with every memory; outputs : of `simulated`.

    Of a surface that goes one way the place is the distance slid, and left out.
    """
    longest = max(run.motion.duration for run in runs)
    found: dict[tuple[str, float, str], list[np.ndarray]] = {}
    for segmented, run, out in zip(base.problem.segmented_runs, runs, outputs, strict=True):
        rows = [slice(one.first, one.last) for one in segmented.segments]
        time, heat = segmented.time, out[:, layout.O_HEAT]
        place = np.abs(out[:, layout.O_TRAVEL] - out[:, layout.O_X])
        by_row = {
            ("distance", 0.0, ""): out[:, layout.O_DISTANCE],
            ("time", 0.0, ""): time,
            ("place", 0.0, ""): place,
            ("load", 0.0, ""): np.full(time.size, run.mass * GRAVITY),
        }
        for part in MEMORIES:
            tau = part * longest
            recent = remembered(time, heat, tau)
            by_row["heat memory", tau, ""] = recent
            by_row["heat memory", tau, "mass"] = recent / run.mass
        for key, values in by_row.items():
            found.setdefault(key, []).append(np.array([np.nanmean(values[r]) for r in rows]))
        found.setdefault(("hold time", 0.0, ""), []).append(_holds(segmented, run))
    if _are_one(found["distance", 0.0, ""], found["place", 0.0, ""]):
        del found["place", 0.0, ""]
    return [Stretches(key[0], tuple(values), key[1], key[2]) for key, values in found.items()]


def _are_one(a: Sequence[np.ndarray], b: Sequence[np.ndarray]) -> bool:
    """Whether two axes differ by less than a curve resolves: a surface that never comes back."""
    first, second = np.concatenate(a), np.concatenate(b)
    return bool(np.ptp(first - second) <= np.ptp(first) / (KNOTS - 1))


def simulated(base: Settled) -> list[np.ndarray]:
    """Outputs (n, O_SIZE) of every run, as aligned; where the model was lost, as before that."""
    point = base.fitted.point
    found = []
    for run in range(len(point.states)):
        out, _ = base.problem.simulated(run, point.shared, point.own[run], point.states[run])
        good = np.where(np.isfinite(out[:, layout.O_X]), np.arange(len(out)), 0)
        found.append(out[np.maximum.accumulate(good)])
    return found


def remembered(time: np.ndarray, heat: np.ndarray, tau: float) -> np.ndarray:
    """(n,) heat that is not yet forgotten, J: q' = P - q / tau, P constant between two samples."""
    step = np.diff(time)
    left = np.exp(-step / tau)
    made = np.maximum(np.diff(heat), 0.0) * (1.0 - left) * tau / step
    kept = np.zeros(time.size)
    for i in range(step.size):
        kept[i + 1] = left[i] * kept[i] + made[i]
    return kept


def _holds(segmented, run: MeasuredRun) -> np.ndarray:
    """(segments,) mean time of the sticks that end in each, s; NaN where none does."""
    found = np.full(len(segmented.segments), np.nan)
    whole = [stick for stick in run.sticks if np.isfinite(stick.start_sd + stick.end_sd)]
    for number, one in enumerate(segmented.segments):
        held = [s.end - s.start for s in whole if one.first <= s.last < one.last]
        if held:
            found[number] = np.mean(held)
    return found
