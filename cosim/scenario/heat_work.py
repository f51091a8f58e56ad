"""Whether the heat of a coupled run can be computed in the time that a scenario allows."""

from stickslip.packing import GRAVITY

from cosim.scenario.durations import in_words
from cosim.scenario.scenario import Scenario
from cosim.scenario.validation import ScenarioError
from thermal.model import MOST_LOOPS
from thermal.work import ice_unknowns, internal_steps, seconds_to_prepare, seconds_to_run


def check_heat(scenario: Scenario) -> float:
    """Seconds that the heat of a coupled run will take; ScenarioError where it cannot, or as above.

    Friction is taken as kinetic all along, at the surface's speed.
    """
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
