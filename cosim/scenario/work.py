"""What a run will take, estimated before it starts: what would not end is refused, in numbers.

The estimate is of the least work that the parameters ask for, on a usual core; it is right to a
factor of ten or so. It decides between minutes and days; a run.patience that is long enough lets
anything through that the models can do.
"""

from stickslip import Parameters, status

from cosim.scenario.durations import in_words
from cosim.scenario.scenario import Scenario
from cosim.scenario.validation import ScenarioError

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
    from cosim.scenario.heat_work import check_heat  # the finite elements

    return seconds + check_heat(scenario)
