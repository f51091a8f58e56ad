"""Steady sliding at every speed and ambient temperature, and the slopes of friction over speed.

Where friction falls with the speed, a block on springs swings of itself. Here guides keep it on its
line and a damper against the frame, three times what the falling friction drives, and enough for a
block of dry friction not to swing either, keeps it at rest there, so that what is seen is the
friction of one speed. A block at rest takes nothing from the
damper: neither friction nor its heat is another for it.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from operator import itemgetter
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from stickslip import Parameters, friction_coefficient
from stickslip.packing import GRAVITY

from cosim.coupling.case import run_scenario
from cosim.report.files import plain_data
from cosim.report.page import PageResult
from cosim.scenario import Scenario, as_scenario

from .laws import laws_of, measured_beside

#: Damping over what the fall of friction with the speed drives.
DAMPING = 3.0
#: Steady is friction that changes by less than this part in the last tenth of a run: the interface
#: warms for ever, like the root of the time.
STEADY = 1e-2
#: Step of speed, part of it, over which the fall of friction is taken.
NUDGE = 1e-4


class NotSteady(ValueError):
    """A case in which the block does not slide steadily; the message is one line."""


@dataclass(frozen=True)
class SteadySliding:
    """Steady sliding at the end of a coupled run.

    speed: of sliding, m/s. ambient_degC: of the air, from which belt and ice started.
    interface_degC: what friction has made of it. friction: coefficient of the run; law: that of the
    friction law at the ambient temperature, without any heating. melt_rate: kg/s. energy_residual:
    of the mechanics, part of the friction heat.
    """

    speed: float
    ambient_degC: float
    interface_degC: float
    friction: float
    law: float
    melt_rate: float
    energy_residual: float


def steady_sliding(
    scenario: Scenario, speed: float, ambient_degC: float, duration: float
) -> SteadySliding:
    """Slide steadily on a belt of ``speed`` (m/s) in air of ``ambient_degC`` for ``duration`` (s).

    Raises NotSteady where the block sticks, swings or is carried away, ScenarioError for a speed,
    temperature or duration that cannot be.
    """
    case = steady_scenario(scenario, speed, ambient_degC, duration)
    run = run_scenario(case)
    where = f"{speed:g} m/s, {ambient_degC:g} degC"
    if run.result.status == "interrupted":
        raise KeyboardInterrupt  # which the coupled run keeps to itself, and a map of many must not
    if run.result.status != "complete":
        raise NotSteady(f"{where}: the coupled run gave up: {run.result.reason}")
    values = run.result
    friction = np.abs(values["mechanics.friction_force_x"]) / (case.rig.mass * GRAVITY)
    last = slice(-max(2, len(friction) // 10), None)
    if np.any(values["mechanics.mode"] == 0):
        raise NotSteady(f"{where}: the block comes to stick, in spite of guides and damper")
    if np.ptp(friction[last]) > STEADY * np.max(friction[last]):
        raise NotSteady(f"{where}: friction still changes after {duration:g} s")
    (law,) = friction_coefficient(case.mechanics, [speed], ambient_degC)
    return SteadySliding(
        speed=float(values["mechanics.sliding_speed"][-1]),
        ambient_degC=ambient_degC,
        interface_degC=float(values["thermal.interface_temperature"][-1]),
        friction=float(friction[-1]),
        law=float(law),
        melt_rate=float(values["thermal.melt_rate"][-1]),
        energy_residual=float(
            values["mechanics.energy_residual"][-1] / values["mechanics.heat"][-1]
        ),
    )


def steady_scenario(
    scenario: Scenario, speed: float, ambient_degC: float, duration: float
) -> Scenario:
    """The case of steady sliding: guided, damped, at its balance from the start."""
    state = ("x", "y", "phi", "vx", "vy", "omega")
    changes: dict[str, Any] = {f"initial.{name}": 0.0 for name in state} | {
        "surface.speed": speed,
        "surface.run_up_time": 0.0,
        "ambient.temperature_degC": ambient_degC,
        "rig.degrees_of_freedom": ("x",),
        "run.duration": duration,
        "run.output_interval": scenario.coupling.macro_step,
    }
    case = scenario.changed(changes)
    force, fall = _friction(case.mechanics, speed, ambient_degC)
    reach = 4.0 * case.springs.stiffness * case.rig.spring_length
    if force >= reach:
        raise NotSteady(
            f"springs.stiffness = {case.springs.stiffness:g} N/m: friction of {force:.3g} N "
            "carries the block into the springs' anchors; allowed is what holds it within "
            f"rig.spring_length = {case.rig.spring_length:g} m"
        )
    damping = max(DAMPING * fall, case.mechanics.critical_damping)
    balance = force / (4.0 * case.springs.stiffness)
    return case.changed({"initial.x": balance, "structural_damping.coefficient": damping})


def _friction(parameters: Parameters, speed: float, temperature: float) -> tuple[float, float]:
    """Friction force (N) and how fast it falls with the speed (N s/m)."""
    load = parameters.rig.mass * GRAVITY
    step = NUDGE * speed
    here, faster = load * friction_coefficient(parameters, [speed, speed + step], temperature)
    return float(here), float(here - faster) / step


Array = NDArray[np.float64]

#: Points that a slope over a decade needs at least.
FEWEST = 4
FEWEST_OF_MINIMUM = 3
#: Friction that differs by less than this part over the speeds is the same at all of them.
SAME = 1e-3
#: A decade may be short or long by this part, for speeds that are rounded and blocks that creep.
ROUNDING = 1e-2


def decade_slopes(speed: ArrayLike, value: ArrayLike) -> list[dict[str, float]]:
    """The slope over each decade of speed that begins at one of the speeds (n,), growing.

    slope: d log(value) / d log(speed) by least squares from the speed ``low`` to ``high``.
    The window that begins at a speed holds all up to ten times that; windows of fewer than four
    points, or that reach less than a decade, are left out. Values (n,) must be positive.
    """
    speed, value = np.asarray(speed, dtype=float), np.asarray(value, dtype=float)
    slopes = []
    for low in speed:
        inside = (speed >= low) & (speed <= 10.0 * low * (1.0 + ROUNDING))
        high = speed[inside][-1]
        if inside.sum() < FEWEST or high < 10.0 * low * (1.0 - ROUNDING):
            continue
        slope = np.polyfit(np.log(speed[inside]), np.log(value[inside]), 1)[0]
        slopes.append({"slope": float(slope), "low": float(low), "high": float(high)})
    return slopes


def lowest_friction(speed: Array, value: Array) -> tuple[float, float] | None:
    """Speed and value of a minimum inside the range: a parabola through three points, log-log.

    None where the lowest value stands at an end.
    """
    at = int(np.argmin(value))
    if at in (0, len(value) - 1):
        return None
    three = slice(at - 1, at + 2)
    a, b, c = np.polyfit(np.log(speed[three]), np.log(value[three]), 2)
    bottom = -b / (2.0 * a)
    return float(np.exp(bottom)), float(np.exp(c - b * b / (4.0 * a)))


MELTING_POINT = 0.0  # degC
SLOPE = itemgetter("slope")


@dataclass(frozen=True)
class FrictionMap(PageResult):
    """Points of all ambient temperatures (warmest last), each with the speeds growing.

    failed: a line for each point at which the block does not slide steadily, with the reason.
    """

    SHOWN_BY = f"{__package__}.page"

    scenario: Scenario
    duration: float
    points: tuple[SteadySliding, ...]
    failed: tuple[str, ...] = ()

    @property
    def ambients(self) -> list[float]:
        """Ambient temperatures, degC, growing."""
        return sorted({point.ambient_degC for point in self.points})

    def at(self, ambient_degC: float) -> list[SteadySliding]:
        """The points of one ambient temperature, speed growing."""
        return [point for point in self.points if point.ambient_degC == ambient_degC]

    def is_flat(self, ambient_degC: float) -> bool:
        """Whether friction is the same at all speeds of one temperature."""
        friction = [point.friction for point in self.at(ambient_degC)]
        return max(friction) - min(friction) <= SAME * max(friction)

    @property
    def laws(self) -> list[dict[str, str]]:
        """For what real contact the laws of friction hold that are on, see `laws_of`."""
        return laws_of(self.scenario, [point.speed for point in self.points])

    def no_slope(self, ambient_degC: float) -> str:
        """Why there is no slope over a decade of speed, where there is none."""
        speeds = [point.speed for point in self.at(ambient_degC)]
        if max(speeds) < 10.0 * min(speeds) * (1.0 - ROUNDING):
            return "less than a decade of speeds"
        return f"fewer than {FEWEST} speeds in a decade"

    def regimes(self, ambient_degC: float) -> dict[str, Any]:
        """Steepest fall and rise over a decade of speed, and the minimum, of one temperature.

        The fall twice: of the friction itself, and of friction over the warming that melting
        takes, T_m - T with the run's own interface temperature. Faster sliding warms the interface,
        so the first falls faster than the law of a given temperature; the second does not.
        None where the speeds reach over no decade, or no minimum lies inside.
        """
        told = [(one.speed, one.friction, one.interface_degC) for one in self.at(ambient_degC)]
        speed, friction, interface = np.transpose(told)
        slopes, warming = decade_slopes(speed, friction), MELTING_POINT - interface
        warmed = decade_slopes(speed, friction / warming) if np.all(warming > 0.0) else []
        changes = len(told) >= FEWEST_OF_MINIMUM and not self.is_flat(ambient_degC)
        lowest = lowest_friction(speed, friction) if changes else None
        return {
            "ambient_degC": ambient_degC,
            "steepest_fall": min(slopes, key=SLOPE, default=None),
            "steepest_rise": max(slopes, key=SLOPE, default=None),
            "steepest_fall_over_warming": min(warmed, key=SLOPE, default=None),
            "minimum": lowest and {"speed": lowest[0], "friction": lowest[1]},
        }

    def __repr__(self) -> str:
        """How many points of which temperatures, in a line."""
        air = ", ".join(f"{ambient:g}" for ambient in self.ambients)
        return f"<FrictionMap of {self.scenario.name}: {len(self.points)} points, air {air} degC>"

    def summary(self) -> dict[str, Any]:
        """What `friction_map.json` holds: everything as plain data."""
        told = {"scenario": self.scenario.to_tables(), "duration": self.duration}
        told |= {"regimes": [*map(self.regimes, self.ambients)], "points": self.points}
        told |= {"failed": self.failed, "measured": measured_beside(self.scenario)}
        return dict(plain_data(told))


def friction_map(
    scenario: Scenario | str | Path,
    speeds: Sequence[float],
    ambients_degC: Sequence[float],
    duration: float = 2.0,
    progress: Callable[[], object] = lambda: None,
) -> FrictionMap:
    """Slide steadily at every speed (m/s, > 0) and ambient temperature (degC, below melting).

    progress: called after each run. Raises ScenarioError for what cannot be, and NotSteady where
    the block slides steadily nowhere; a point at which it does not is in `FrictionMap.failed`.

    >>> from cosim import friction_map
    >>> found = friction_map("study", [0.1, 1.0], [-8.0], duration=0.5)
    >>> [(point.speed, point.friction) for point in found.points]
    [(0.1..., 0.2086...), (1.0, 0.2086...)]
    """
    if any(not speed > 0.0 for speed in speeds):
        raise NotSteady(f"speed = {min(speeds):g} m/s: allowed is above 0")
    scenario = as_scenario(scenario)
    points, failed = [], []
    for ambient in sorted(set(ambients_degC)):
        for speed in sorted(set(speeds)):
            try:
                points.append(steady_sliding(scenario, speed, ambient, duration))
            except NotSteady as reason:
                failed.append(str(reason))
            progress()
    if not points:
        raise NotSteady(failed[0])
    return FrictionMap(scenario, duration, tuple(points), tuple(failed))
