"""The scenario, and the two maps around it: growth of small disturbances, and regimes.

Growth over pretension and speed. Regimes over speed and mu_s/mu_k, from three starts, beside what
is known in closed form.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from stickslip import Parameters
from stickslip.packing import GRAVITY
from stickslip.parameters import EffectTables
from stickslip.reference.coulomb_oscillator import BeltStart, CoulombOscillator
from stickslip.steady_motion import Assessment, Interface, RunEnded, assess, with_pretension
from stickslip.steady_motion.borders import at_speed, with_ratio
from stickslip.steady_motion.regimes import SLIDING, STICK_SLIP, regime_of
from stickslip.steady_motion.stability import cycle_stability, guided
from stickslip.steady_motion.starts import RAMP, REST, RIDING, other_starts

from cosim.scenario import Scenario

Array = np.ndarray
#: Called with 1 after each cell of a map.
Done = Callable[[int], object]
#: Length of a run after the surface has its speed, s, and in natural periods.
SECONDS, PERIODS = 20.0, 40.0


class NotAMotion(ValueError):
    """A scenario that has no stick-slip motion to be studied; one line: what, what is allowed."""


@dataclass(frozen=True)
class Case:
    """A scenario's mechanics and the assessment of its own run.

    interface: what friction feels there, of belt and ice as cold as the air.
    """

    name: str
    parameters: Parameters
    interface: Interface
    assessment: Assessment


def case_of(scenario: Scenario) -> Case:
    """The scenario with its own assessment. NotAMotion where there is nothing to assess.

    >>> from cosim import case_of, read_scenario
    >>> case_of(read_scenario("study")).assessment.stability.verdict
    'unstable'
    """
    parameters, interface = scenario.mechanics, Interface(scenario.ambient.temperature_degC)
    if fault := _fault(parameters):
        raise NotAMotion(f"{scenario.name}: {fault}")
    found = assess(parameters, scenario.run.duration, interface, most_steps=math.inf)
    if found is None:
        raise NotAMotion(
            f"{scenario.name}: run.duration = {scenario.run.duration:g} s: the motion ends early, "
            "or is over before five swings at constant speed; allowed is a longer run that can be "
            "followed"
        )
    return Case(scenario.name, parameters, interface, found)


def _fault(parameters: Parameters) -> str:
    """What keeps a rig from having steady motions that could be told apart, or nothing."""
    law = parameters.rate_and_state
    if parameters.surface.speed == 0.0:
        return "surface.speed = 0: needed is a surface that moves"
    if parameters.natural_frequency == 0.0:
        return "springs.stiffness = 0: needed are springs"
    if parameters.friction.has_table:
        return "friction.table_speed: a map over mu_s/mu_k needs one mu_k; leave the table out"
    if parameters.friction.mu_k == 0.0:
        return "friction.mu_k = 0: needed is friction in slip, for a map over mu_s/mu_k"
    if law.direct != 0.0 or law.evolution != 0.0:
        return "rate_and_state: its runs take too long to be repeated; leave it out"
    return ""


def run_length(parameters: Parameters) -> float:
    """Speed ramp and what follows it, s."""
    return parameters.surface.run_up_time + max(SECONDS, PERIODS / parameters.natural_frequency)


@dataclass(frozen=True)
class PretensionMap:
    """growth (n, m): largest multiplier of a cycle at pretensions (n,) m and speeds (m,) m/s.

    sticks (n, m): whether the block sticks there. NaN: not computed, or no motion that can be
    followed.
    """

    pretensions: Array
    speeds: Array
    growth: Array
    sticks: Array


def pretension_map(
    case: Case, pretensions: Array, speeds: Array, done: Done = lambda cells: None
) -> PretensionMap:
    """The map around a case; ``done`` is called with 1 after each cell.

    >>> from cosim import case_of, pretension_map, read_scenario
    >>> found = pretension_map(case_of(read_scenario("study")), [0.0, 0.03], [0.15])
    >>> (found.growth < 1.0).tolist()
    [[False], [True]]
    """
    growth = np.full((len(pretensions), len(speeds)), np.nan)
    sticks = growth.copy()
    for j, speed in enumerate(speeds):
        moving = at_speed(case.parameters, speed)
        for i, pretension in enumerate(pretensions):
            growth[i, j], sticks[i, j] = _cell(with_pretension(moving, pretension), case.interface)
            done(1)
    return PretensionMap(np.asarray(pretensions), np.asarray(speeds), growth, sticks)


def _cell(parameters: Parameters, interface: Interface) -> tuple[float, float]:
    """Growth, and 1 where the block sticks on its line, else 0; NaN where it cannot be followed."""
    duration = run_length(parameters)
    try:
        growth = cycle_stability(parameters, duration, interface).growth
        return growth, float(regime_of(guided(parameters), duration, interface).slip_share < 1.0)
    except RunEnded:
        return np.nan, np.nan


MAPPED = (REST, RIDING, RAMP)
#: Blocks with which the motion along the line is still that of a Coulomb oscillator.
HARMLESS = {"lateral_friction", "structural_damping", "imperfections"}


@dataclass(frozen=True)
class RegimeMap:
    """Names of regimes (n, m) by start, at ratios mu_s/mu_k (n,) and speeds (m,) m/s.

    simulated: by the model; an empty name is a run that ended early. closed_form: of the Coulomb
    oscillator with the same numbers; None where the scenario's motion is not that of one, as is in
    how many cells, of all starts, the two differ. closed_form_borders: for each start (k, 2) of
    speed and ratio, far closer than the grid.
    """

    ratios: Array
    speeds: Array
    simulated: dict[str, Array]
    closed_form: dict[str, Array] | None
    cells_that_differ: int | None
    fastest_from_rest: float | None
    closed_form_borders: dict[str, Array]


def regime_map(
    case: Case, ratios: Array, speeds: Array, done: Done = lambda cells: None
) -> RegimeMap:
    """The map around a case, whose mu_k is kept; ``done`` is called with 1 after each cell.

    >>> from cosim import case_of, read_scenario, regime_map
    >>> found = regime_map(case_of(read_scenario("study")), [1.3], [0.05, 2.0])
    >>> found.simulated["rest"].tolist()
    [['stick-slip', 'sliding']]
    """
    simulated = np.full((len(MAPPED), len(ratios), len(speeds)), "", dtype=object)
    closed = simulated.copy()
    known = is_coulomb_oscillator(case.parameters)
    for i, ratio in enumerate(ratios):
        for j, speed in enumerate(speeds):
            parameters = with_ratio(at_speed(case.parameters, speed), ratio)
            simulated[:, i, j] = _simulated(parameters, case.interface)
            if known:
                closed[:, i, j] = predicted(parameters)
            done(1)
    by_start = np.asarray(ratios), np.asarray(speeds), dict(zip(MAPPED, simulated, strict=True))
    if not known:
        return RegimeMap(*by_start, None, None, None, {})
    borders = {
        start: _borders(case.parameters, start, names, ratios, speeds)
        for start, names in zip(MAPPED, closed, strict=True)
    }
    differ = int(np.sum((simulated != closed) & (simulated != "")))
    fastest = belt_start(case.parameters).fastest_from_rest
    return RegimeMap(*by_start, dict(zip(MAPPED, closed, strict=True)), differ, fastest, borders)


def _simulated(parameters: Parameters, interface: Interface) -> list[str]:
    starts, names = other_starts(parameters), []
    for started in (starts[start] for start in MAPPED):
        try:
            names.append(regime_of(started, run_length(started), interface).name)
        except RunEnded:
            names.append("")
    return names


def is_coulomb_oscillator(parameters: Parameters) -> bool:
    """Is the motion along the line that of `BeltStart`?

    Imperfections of a hundredth move the borders by as much.
    """
    plain = Parameters()
    effects = set(EffectTables.model_fields) - HARMLESS
    return (
        all(getattr(parameters, name) == getattr(plain, name) for name in effects)
        and parameters.rig.surface == "belt"
        and not parameters.springs.force_curve_extension
        and parameters.friction.stick_creep == 0.0
        and parameters.friction.transition_speed == 0.0
        and not parameters.friction.has_table
        and parameters.structural_damping.coefficient < parameters.critical_damping
        and parameters.structural_damping.quadratic == 0.0
        and parameters.structural_damping.dry_force == 0.0
    )


def belt_start(parameters: Parameters) -> BeltStart:
    """The oscillator of the motion along the line, on a belt that runs up as that of RAMP."""
    rig, friction, load = parameters.rig, parameters.friction, parameters.rig.mass * GRAVITY
    stiffness, speed = 4.0 * parameters.springs.stiffness, abs(parameters.surface.speed)
    limits = max(friction.mu_s, friction.mu_k) * load, friction.mu_k * load
    return BeltStart(
        CoulombOscillator(rig.mass, stiffness, speed, *limits),
        parameters.structural_damping.coefficient,
        other_starts(parameters)[RAMP].surface.run_up_time,
    )


STICKS: dict[str, Callable[[BeltStart], bool]] = {
    REST: BeltStart.sticks_from_rest,
    RIDING: BeltStart.sticks_riding,
    RAMP: BeltStart.sticks_after_run_up,
}


def predicted(parameters: Parameters) -> list[str]:
    """Names of the regimes from `MAPPED` in closed form."""
    start = belt_start(parameters)
    return [STICK_SLIP if STICKS[name](start) else SLIDING for name in MAPPED]


#: Halvings of a cell in which a border lies.
HALVINGS = 7


def _borders(
    parameters: Parameters, start: str, names: Array, ratios: Array, speeds: Array
) -> Array:
    """Between neighbours of the grid whose ``names`` (n, m) differ, where: (k, 2) speed, ratio."""

    def sticks(point: Array) -> bool:
        speed, ratio = point
        return STICKS[start](belt_start(with_ratio(at_speed(parameters, speed), ratio)))

    grid = np.stack(np.meshgrid(speeds, ratios), axis=-1)
    found = []
    for before, after in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
        differ = names[before] != names[after]
        for one, other in zip(grid[before][differ], grid[after][differ], strict=True):
            here = sticks(one)
            for _ in range(HALVINGS):
                middle = 0.5 * (one + other)
                one, other = (middle, other) if sticks(middle) == here else (one, middle)
            found.append(0.5 * (one + other))
    return np.reshape(found, (-1, 2))
