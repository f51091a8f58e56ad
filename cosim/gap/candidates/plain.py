"""The plain model: what is free in it, and whether its block leaves its line.

A wrong number is not a missing effect: the plain model's own numbers are fitted first.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from stickslip.effects.candidate import FreeParameter
from stickslip.packing import GRAVITY

from cosim.gap.data import Campaign, MeasuredRun, cycle_features
from cosim.gap.data.stick_remarks import SPEED_ERRORS, SPEED_PART, never_slips
from cosim.gap.estimation.drive import SPEED_OFFSET

#: Speed at which the surface leaves a block behind that sticks and is about to break away, m/s.
CREEP = "friction.stick_creep"
#: A friction coefficient that is stated is not this many of its standard deviations off.
_KNOWN = 4.0
#: The tracker's zero is known to this many standard deviations of its noise.
_ZERO = 2.0
#: It is not further off than so many: a mu_k that swings a block about another place is no zero,
#: and a block that comes to rest beside the line between the anchors has crooked springs.
_ZERO_MOST = {"x": 10.0, "y": 3.0}
#: Sticks that tell a surface's speed; one that is off is so in most runs: a ripple is another
#: matter, and may seem so in some.
_STICKS = 5
#: The surface's speed, where it is off at all, is off by about this part.
_SPEED = 0.03
#: A set-point is kept to this part; creeps are equal within this part.
_SET_POINT, _EQUAL = 0.003, 0.5


def plain_free_parameters(campaign: Campaign, planar: bool) -> tuple[FreeParameter, ...]:
    """mu_s, mu_k, the tracker's zero and, where sticks tell of it, how the surface runs.

    They start where the data put them, or as they are known.
    """
    runs = [run for run in campaign.fit_runs if run.track is not None]
    everywhere = [run for run in campaign.runs if run.track is not None]
    free_parameters = []
    for name, guess in zip(("mu_s", "mu_k"), first_guess(runs, everywhere), strict=True):
        value, deviation = campaign.friction.get(name, (guess, None))
        low, high = (0.3 * guess if name == "mu_s" else 0.0), 20.0
        if deviation is not None:  # what is known stays known
            low, high = max(value - _KNOWN * deviation, 0.0), value + _KNOWN * deviation
        free_parameters.append(
            FreeParameter(f"friction.{name}", value, 0.05 * guess, low, high, prior=deviation)
        )
    for channel in ("x", "y") if planar else ("x",):
        if channel in campaign.noise:
            zero = _ZERO * campaign.noise[channel]
            most = _ZERO_MOST[channel] * campaign.noise[channel]
            free_parameters.append(
                FreeParameter(f"offset.{channel}", 0.0, zero, -most, most, prior=zero)
            )
    return (*free_parameters, *drive_free_parameters(runs))


def drive_free_parameters(runs: Sequence[MeasuredRun]) -> tuple[FreeParameter, ...]:
    """What sticks tell of the surface's speed: nothing, one creep for all, or each run its own."""
    sticking = [run for run in runs if len(run.sticks) >= _STICKS]
    off = sum(_speed_is_off(run) for run in sticking)
    creep = common_creep(sticking) if off else None
    if creep is not None:
        value, error = creep  # as measured: what a model lacks would be put down to it
        return (
            FreeParameter(
                CREEP, value, error, value - 3.0 * error, value + 3.0 * error, prior=error
            ),
        )
    if 2 * off > len(sticking):
        return (FreeParameter(SPEED_OFFSET, 0.0, 0.02, per_run=True, prior=_SPEED),)
    return ()


def common_creep(runs: Sequence[MeasuredRun]) -> tuple[float, float] | None:
    """Creep at break-away, m/s, that lets all runs' sticks lag as they do, and its error.

    A contact is sheared before it slides, in proportion to its load: the lag of a stick is that of
    its mean load. None where the runs do not agree in it.
    """
    lag, error, load = np.array([_lag(run) for run in runs]).reshape(-1, 3).T
    seen = np.isfinite(lag) & np.isfinite(error) & (load > 0.0)
    lag, error, load = lag[seen], error[seen], load[seen]
    if not lag.size:
        return None
    precision = float(np.sum((load / error) ** 2))
    creep = float(np.sum(lag * load / error**2)) / precision
    of_mean = precision**-0.5
    indistinguishable = np.abs(lag - creep * load) <= np.maximum(
        SPEED_ERRORS * error, _EQUAL * creep * load
    )
    return (creep, of_mean) if creep > SPEED_ERRORS * of_mean and indistinguishable.all() else None


def _lag(run: MeasuredRun) -> tuple[float, float, float]:
    """How much slower than the surface sticks are, m/s, its error, and their mean load.

    The load is a part of that at break-away.
    """
    sign = 1.0 if run.surface_speed >= 0.0 else -1.0
    speed = cycle_features(run).stick_speed
    ends = np.array([[run.motion.x[s.first], run.motion.x[s.last]] for s in run.sticks])
    load = float(np.nanmedian(ends.mean(axis=1)) / np.nanmedian(ends[:, 1]))
    error = float(np.hypot(speed.error, _SET_POINT * run.surface_speed))
    return sign * (run.surface_speed - speed.value), error, load


def _speed_is_off(run: MeasuredRun) -> bool:
    """Whether the block, in stick, moves at another speed than the surface's set-point."""
    speed = cycle_features(run).stick_speed
    off = abs(speed.value - run.surface_speed)
    return off > max(SPEED_ERRORS * speed.error, SPEED_PART * abs(run.surface_speed))


def first_guess(
    runs: Sequence[MeasuredRun], everywhere: Sequence[MeasuredRun] = ()
) -> tuple[float, float]:
    """mu_s from where sticks end, mu_k from about where the block swings between two sticks.

    Where no run slips, mu_s is more than any load that was held in the runs ``everywhere``.
    """
    holding, sliding = [], []
    for run in runs:
        per_metre = run.total_stiffness / (run.mass * GRAVITY)
        seen = run.motion.x[np.isfinite(run.motion.x)]
        ends = [run.motion.x[s.last] for s in run.sticks if np.isfinite(s.end_sd)]
        starts = [run.motion.x[s.first] for s in run.sticks if np.isfinite(s.start_sd)]
        if ends and starts:
            holding.append(per_metre * np.nanmedian(ends))
            sliding.append(per_metre * 0.5 * (np.nanmedian(ends) + np.nanmedian(starts)))
        else:
            sliding.append(per_metre * np.mean(seen[seen.size // 4 :]))
    mu_k = max(float(np.median(np.abs(sliding))), 1e-3)
    mu_s = float(np.median(np.abs(holding))) if holding else 1.3 * mu_k
    if everywhere and all(never_slips(run) for run in everywhere):
        held = [
            run.total_stiffness * np.nanmax(np.abs(run.motion.x)) / (run.mass * GRAVITY)
            for run in everywhere
        ]
        mu_s = 1.3 * max(held)
    return max(mu_s, 1.05 * mu_k), mu_k


#: A track is cut into so many pieces, whose means have little noise left.
_PIECES = 200
#: Scatter of the pieces' means, or mean of all, in units of one sample's noise.
_MOVES, _STANDS = 0.5, 1.0


def moves_across(campaign: Campaign) -> bool:
    """Seen in y or phi of any run; False where neither was measured or the rig allows neither."""
    free = set(campaign.rig.degrees_of_freedom) & {"y", "phi"}
    return bool(free) and any(
        _moves(run, channel)
        for run in campaign.runs
        if run.track is not None
        for channel in ("y", "phi")
        if channel in run.motion.channels
    )


def _moves(run: MeasuredRun, channel: str) -> bool:
    values = run.motion[channel]
    values = values[np.isfinite(values)]
    each = max(5, values.size // _PIECES)
    means = values[: values.size // each * each].reshape(-1, each).mean(axis=1)
    noise = run.noise[channel]
    alone = noise / np.sqrt(each)  # what noise leaves of the means' scatter
    scatter = np.sqrt(max(np.var(means) - alone**2, 0.0))
    return bool(scatter > _MOVES * noise or abs(means.mean()) > _STANDS * noise)
