"""Which regime a run is in, and whether another exists beside it.

Dry friction lets several steady motions exist side by side, and the start decides between them: a
block that rides on the surface breaks away, slips and is caught again, while the same block started
from rest may swing about the place where its springs balance kinetic friction, for ever slower than
the surface. So the model is started in three ways: from rest on a surface that has its full speed,
riding on it, and on a surface that runs up to its speed; and as its scenario has it, but pushed
aside and turned a little, as every rig is.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..parameters import Parameters
from ..simulation import simulate
from ..trajectory import Trajectory, break_away_frequency, slip_share
from .live import DRY, Interface, RunEnded

STICK_SLIP, SLIDING, STICKING, CREEPING = "stick-slip", "sliding", "sticking", "creeping"
OWN, DISTURBED, REST, RIDING, RAMP = "own", "disturbed", "rest", "riding", "ramp"
#: How each start is told.
STARTS = {
    OWN: "as the scenario starts",
    DISTURBED: "as the scenario starts, but 0.1 mm aside and turned by 1 mrad",
    REST: "from rest on a surface at full speed",
    RIDING: "riding on a surface at full speed",
    RAMP: "on a surface that runs up to its speed",
}
#: Of the disturbed start, m and rad.
ASIDE, TURNED = 1e-4, 1e-3
#: Speed ramp of the third start where the scenario has none, s.
RAMP_TIME = 10.0
#: Shortest run at constant speed that a regime is read from, s, and in natural periods.
SHORTEST, PERIODS = 20.0, 20.0
#: Part of the run at constant speed, from its end, that is looked at.
LATE = 0.5
#: A contact that is said to stick, but slides at this part of the surface's speed, creeps.
FULL_SPEED = 0.9


@dataclass(frozen=True)
class Regime:
    """What a run has come to in its last part.

    Attributes
    ----------
    name : stick-slip, sliding (does not stick), sticking (does not slip) or creeping (its contact
        is sheared at nearly the surface's speed and never breaks away)
    frequency : of the break-aways, from the first to the last, Hz; 0 of fewer than two
    slip_share : part of the time in slip
    mean_x, half_range_x : m
    max_y : largest distance from the line, m
    max_rotation_deg : largest rotation, deg
    """

    name: str
    frequency: float
    slip_share: float
    mean_x: float
    half_range_x: float
    max_y: float
    max_rotation_deg: float


def regimes(
    parameters: Parameters,
    duration: float = 30.0,
    interface: Interface = DRY,
    look: Callable[[], None] = lambda: None,
) -> dict[str, Regime]:
    """The regime of the scenario's own run and of the other starts, by the names of `STARTS`.

    duration: of the own run, s; each of the others is at constant speed as long, and at least 20 s.
    interface: its temperature and the water in it. look: called now and then; may raise. Raises
    `live.RunEnded` where the own motion cannot be followed; another start of which that is so is
    left out.
    """
    found = {OWN: regime_of(parameters, duration, interface, look)}
    steady = duration - parameters.surface.run_up_time
    natural = PERIODS / max(parameters.natural_frequency, 0.1)
    steady = max(steady, SHORTEST, natural)
    for name, started in other_starts(parameters).items():
        try:
            length = duration if name == DISTURBED else steady + started.surface.run_up_time
            found[name] = regime_of(started, length, interface, look)
        except RunEnded:
            continue
    return found


def coexisting(found: dict[str, Regime]) -> dict[str, Regime]:
    """Those of `regimes` that differ by name from the scenario's own."""
    return {start: regime for start, regime in found.items() if regime.name != found[OWN].name}


def other_starts(parameters: Parameters) -> dict[str, Parameters]:
    """The same rig disturbed, from rest, riding, and on a surface that runs up to its speed."""
    surface, initial = parameters.surface, parameters.initial
    at_speed = surface.model_copy(update={"run_up_time": 0.0})
    running_up = surface.model_copy(update={"run_up_time": surface.run_up_time or RAMP_TIME})
    curvature = parameters.turning_surface.curvature
    if parameters.rig.surface == "slab":
        curvature = 1.0 / parameters.rig.slab_radius
    still = {"x": 0.0, "vx": 0.0, "vy": 0.0, "omega": 0.0}
    carried = still | {"vx": surface.speed, "omega": surface.speed * curvature}
    aside = {"y": initial.y + ASIDE, "phi": initial.phi + TURNED}
    guided = {"y", "phi"} - set(parameters.rig.degrees_of_freedom)
    aside = {name: place for name, place in aside.items() if name not in guided}
    return {
        DISTURBED: parameters.model_copy(update={"initial": initial.model_copy(update=aside)}),
        REST: parameters.model_copy(
            update={"surface": at_speed, "initial": initial.model_copy(update=still)}
        ),
        RIDING: parameters.model_copy(
            update={"surface": at_speed, "initial": initial.model_copy(update=carried)}
        ),
        RAMP: parameters.model_copy(
            update={"surface": running_up, "initial": initial.model_copy(update=still)}
        ),
    }


def regime_of(
    parameters: Parameters,
    duration: float,
    interface: Interface = DRY,
    look: Callable[[], None] = lambda: None,
) -> Regime:
    """The regime that a run of ``duration`` (s) has come to. RunEnded where it ends early.

    look: called now and then; may raise.
    """
    period = 1.0 / max(parameters.natural_frequency, 0.1)
    run = simulate(
        parameters,
        duration,
        min(0.05 * period, 0.01 * duration),
        **interface.inputs,
        progress=lambda reached: look(),
    )
    if not run.complete:
        raise RunEnded(run.reason)
    constant = min(parameters.surface.run_up_time, duration)
    return read_regime(run, duration - LATE * (duration - constant))


def read_regime(run: Trajectory, begin: float) -> Regime:
    """The regime of a run from ``begin`` (s) on."""
    late = run.time >= begin
    time, mode = run.time[late], run["mode"][late]
    share = slip_share(time, mode, run.events)
    starts = run.slip_starts
    frequency = break_away_frequency(starts[(starts >= time[0]) & (starts <= time[-1])])
    x = run["x"][late]
    return Regime(
        name=_name(run, late, share),
        frequency=0.0 if math.isnan(frequency) else frequency,
        slip_share=share,
        mean_x=float(np.trapezoid(x, time) / np.ptp(time)),
        half_range_x=0.5 * float(np.ptp(x)),
        max_y=float(np.abs(run["y"][late]).max()),
        max_rotation_deg=float(np.degrees(np.abs(run["phi"][late]).max())),
    )


def _name(run: Trajectory, late: np.ndarray, share: float) -> str:
    if share == 1.0:
        return SLIDING
    if share > 0.0:
        return STICK_SLIP
    speed = abs(run["surface_speed_actual"][late][-1])
    slid = np.ptp(run["sliding_distance"][late]) / np.ptp(run.time[late])
    return CREEPING if speed > 0.0 and slid > FULL_SPEED * speed else STICKING
