"""The plain model: what is free in it, and whether its block leaves its line.

A wrong number is not a missing effect: the plain model's own numbers are fitted first. They are
those of friction and of its contact, and what no two runs share: the tracker's zero, how far the
surface's speed is from its set-point and the springs from what is stated, and friction itself,
which scatters from run to run.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from stickslip.effects.candidate import FreeParameter
from stickslip.packing import GRAVITY

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.data.stick_remarks import never_slips
from cosim.gap.estimation.drive import (
    FRICTION_OFFSET,
    LOADING,
    SPEED_OFFSET,
    stiffness_offset,
    table,
)

#: How a contact gives way before it slides: it creeps, and the faster it is loaded the sooner it
#: breaks away; friction then falls from mu_s to mu_k over a speed.
CREEP = "friction.stick_creep"
TRANSITION = "friction.transition_speed"
EXPONENT = "friction.transition_exponent"
#: Speeds, m/s, over which dry friction falls: a tenth and ten times what contacts of this size are
#: known for.
_FALLS = (3e-4, 5e-2)
#: Bristles of 20 to 100 um that give way over 1 to 8 mm/s lack up to this at a loading rate of
#: 1/s.
_LACKS = 0.2
#: A friction coefficient that is stated is not this many of its standard deviations off.
_KNOWN = 4.0
#: Spread of friction from run to run that a fit sets out with; see `evidence.settled`.
SPREAD = 0.02


def plain_free_parameters(
    campaign: Campaign, planar: bool, spread: float = SPREAD
) -> tuple[FreeParameter, ...]:
    """Friction, its contact, and what is a run's own; they start where the data put them.

    spread : standard deviation of friction from run to run, a part of it
    """
    runs = [run for run in campaign.fit_runs if run.track is not None]
    everywhere = [run for run in campaign.runs if run.track is not None]
    return (
        *_friction(campaign, runs, everywhere),
        *contact_free_parameters(min(abs(run.surface_speed) for run in everywhere)),
        *_springs(campaign, everywhere),
        *own_free_parameters(campaign, planar, spread),
    )


def plain_settings(campaign: Campaign) -> dict[str, float]:
    """What is set beside the free parameters: the campaign's own table of friction, as parts."""
    own = campaign.friction_table
    return {} if own is None else table(own.speeds, own.parts)


def _friction(campaign: Campaign, runs, everywhere) -> list[FreeParameter]:
    free_parameters = []
    for name, guess in zip(("mu_s", "mu_k"), first_guess(runs, everywhere), strict=True):
        value, deviation = campaign.known_friction.get(name, (guess, None))
        # without friction bristles have no length in slip, and the kernel would not get on
        low, high = (0.3 if name == "mu_s" else 0.1) * guess, 20.0
        if deviation is not None:  # what is known stays known
            low, high = max(value - _KNOWN * deviation, 0.0), value + _KNOWN * deviation
        free_parameters.append(
            FreeParameter(f"friction.{name}", value, 0.05 * guess, low, high, prior=deviation)
        )
    return free_parameters


def contact_free_parameters(slowest: float) -> tuple[FreeParameter, ...]:
    """Of the contact; slowest : speed of the surface in any run, m/s."""
    return (
        FreeParameter(TRANSITION, min(2e-3, 0.05 * slowest), 0.3, *_FALLS, log=True),
        FreeParameter(EXPONENT, 1.3, 0.2, 0.5, 3.0, prior=0.5),
        FreeParameter(CREEP, 0.01 * slowest, 0.02 * slowest, 0.0, 0.3 * slowest),
        FreeParameter(LOADING, 0.02, 0.02, 0.0, 1.0, prior=_LACKS),
    )


def _springs(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[FreeParameter]:
    """How much stiffer than stated the springs of each set-up are."""
    error = campaign.errors.stiffness
    return [
        FreeParameter(stiffness_offset(setup), 0.0, 0.2 * error, -0.5, 0.5, prior=error)
        for setup in sorted({campaign.setup_of(run) for run in runs})
    ]


def own_free_parameters(
    campaign: Campaign, planar: bool, spread: float
) -> tuple[FreeParameter, ...]:
    """What every run has of its own: the tracker's zero, the surface's speed, friction."""
    own = []
    for channel in ("x", "y") if planar else ("x",):
        if channel in campaign.noise:
            zero = campaign.errors.zero * campaign.noise[channel]
            own.append(
                FreeParameter(f"offset.{channel}", 0.0, 0.2 * zero, per_run=True, prior=zero)
            )
    error = campaign.errors.surface_speed
    own.append(FreeParameter(SPEED_OFFSET, 0.0, 0.2 * error, -0.5, 0.5, True, error))
    own.append(FreeParameter(FRICTION_OFFSET, 0.0, 0.005, -1.0, 1.0, True, spread))
    return tuple(own)


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
#: Scatter of the pieces' means, in units of one sample's noise, and mean of all in standard
#: deviations of the tracker's zero: 3 in 1000 channels that stand still stand as far off.
_MOVES, _STANDS = 0.5, 3.0


def moves_across(campaign: Campaign) -> bool:
    """Seen in y or phi of any run; False where neither was measured or the rig allows neither."""
    free = set(campaign.rig.degrees_of_freedom) & {"y", "phi"}
    return bool(free) and any(
        _moves(run, channel, campaign.errors.zero)
        for run in campaign.runs
        if run.track is not None
        for channel in ("y", "phi")
        if channel in run.motion.channels
    )


def _moves(run: MeasuredRun, channel: str, zero: float) -> bool:
    """zero : standard deviation of the tracker's zero, in units of the noise"""
    values = run.motion[channel]
    values = values[np.isfinite(values)]
    each = max(5, values.size // _PIECES)
    means = values[: values.size // each * each].reshape(-1, each).mean(axis=1)
    noise = run.noise[channel]
    alone = noise / np.sqrt(each)  # what noise leaves of the means' scatter
    scatter = np.sqrt(max(np.var(means) - alone**2, 0.0))
    off = noise * np.hypot(zero, 1.0 / np.sqrt(values.size))
    return bool(scatter > _MOVES * noise or abs(means.mean()) > _STANDS * off)
