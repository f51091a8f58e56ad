"""What a run will take, estimated before it starts: what would not end is refused, in numbers.

The estimate is of the least work that the parameters ask for, on a usual core; it is right to a
factor of ten or so. It decides between minutes and days; a run.patience that is long enough lets
anything through that the models can do.

Beside it, numbers that no rig has and that another unit would make usual: grams, millimetres.
"""

from math import log

from stickslip import Parameters, status
from stickslip.packing import GRAVITY

from cosim.scenario.durations import in_words
from cosim.scenario.scenario import Scenario
from cosim.scenario.validation import WORDS, ScenarioError

#: A run that takes longer says so when it starts, s.
WORTH_SAYING = 60.0


def check_mechanics(parameters: Parameters, duration: float, patience: float) -> float:
    """Seconds that the mechanics will take; ScenarioError where it cannot, or for too long.

    duration: of the run, s; patience: the most that it may take, s.
    """
    step = status.longest_step(parameters)
    if step.per_second > status.MOST_STEPS_PER_SECOND:
        raise ScenarioError(
            f"{step.reason}, followed in steps of {step.size:.2g} s; allowed are steps from "
            f"{1.0 / status.MOST_STEPS_PER_SECOND:.2g} s: make it slower"
        )
    carried = min(status.time_to_slide(parameters), duration)
    steps = carried * step.per_second
    step = status.likely_step(parameters)
    steps += (duration - carried) * step.per_second
    seconds = steps * status.SECONDS_PER_STEP
    if seconds > patience:
        raise ScenarioError(
            f"run.duration: {duration:g} s takes {steps:.2g} steps, some {in_words(seconds)} "
            f"({step.reason}), allowed is what takes run.patience = {patience:g} s: a shorter run, "
            "or more patience"
        )
    return seconds


def check_work(scenario: Scenario, *, coupled: bool) -> float:
    """Seconds that a run will take; ScenarioError where it cannot end within run.patience."""
    run = scenario.run
    seconds = check_mechanics(scenario.mechanics, run.duration, run.patience)
    if not coupled:
        return seconds
    return seconds + _check_heat(scenario)


def _check_heat(scenario: Scenario) -> float:
    """Seconds that the heat of a coupled run will take; ScenarioError where it cannot, or as above.

    Friction is taken as kinetic all along, at the surface's speed.
    """
    from thermal.model import MOST_LOOPS  # the finite elements
    from thermal.work import ice_unknowns, internal_steps, seconds_to_prepare, seconds_to_run

    run, step, surface = scenario.run, scenario.coupling.macro_step, scenario.surface
    speed, length = abs(surface.speed), scenario.belt.length
    if speed * step > MOST_LOOPS * length:
        raise ScenarioError(
            f"coupling.macro_step: {step:g} s at surface.speed = {surface.speed:g} m/s is "
            f"{speed * step / length:.3g} loops of the belt, allowed are up to {MOST_LOOPS} in a "
            "macro step"
        )
    thermal, patience = scenario.thermal, run.patience
    preparing = seconds_to_prepare(thermal)
    if preparing > patience:
        raise ScenarioError(
            f"ice.radial_elements: {scenario.ice.radial_elements} by ice.axial_elements = "
            f"{scenario.ice.axial_elements} are {ice_unknowns(thermal)} unknowns, which take some "
            f"{in_words(preparing)} to prepare, allowed is what takes run.patience = "
            f"{patience:g} s: fewer elements, or more patience"
        )
    heating = scenario.friction.mu_k * GRAVITY * scenario.rig.mass * speed
    arguments = (thermal, run.duration, step, speed, heating)
    seconds = seconds_to_run(*arguments)
    if preparing + seconds > patience:
        cuts = internal_steps(*arguments) * step / run.duration
        raise ScenarioError(
            f"run.duration: {run.duration:g} s takes some {in_words(preparing + seconds)} with "
            f"{cuts:.3g} internal steps of the heat in each coupling.macro_step = {step:g} s "
            f"(surface.speed = {surface.speed:g} m/s, ice.density = {scenario.ice.density:g} "
            f"kg/m3), allowed is what takes run.patience = {patience:g} s: a shorter run, a "
            "coarser mesh, or more patience"
        )
    return preparing + seconds


def doubted(parameters: Parameters) -> str:
    """A sentence on the numbers that are likely in another unit; "" where none is.

    That one is named which makes the number most like the default.
    """
    found, usual = [], Parameters()
    for key, ((least, most), units) in WORDS["usual"].items():
        value, default = _number(parameters, key), _number(usual, key)
        size = abs(value)
        off = {
            unit: abs(log(size * factor / default))
            for unit, factor in units.items()
            if not least <= size <= most and least <= size * factor <= most
        }
        if off:
            found.append(f"{key} = {value:g} ({min(off, key=off.__getitem__)}?)")
    return f"{', '.join(found)}: no rig has that in SI units" if found else ""


def _number(parameters: Parameters, key: str) -> float:
    table, _, name = key.partition(".")
    return float(getattr(getattr(parameters, table), name))
