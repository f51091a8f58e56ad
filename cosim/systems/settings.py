"""The tables [coupling] and [run] of a system: how it is coupled, and over what time."""

from __future__ import annotations

import math
from typing import Self

from pydantic import Field, model_validator
from stickslip.quantity import Table, quantity

from cosim.scenario.method import Method

#: What a number stands at that a file leaves out.
NOT_GIVEN = math.inf


class Coupling(Method):
    """How the units talk to each other."""

    power_bonds: tuple[tuple[str, str], ...] = Field(
        (), description="for energy: outputs that feed each other and whose product is a power"
    )
    order: tuple[str, ...] = Field(
        (), description="units, in the order in which they step; left out, as the file has them"
    )
    macro_step: float = quantity(
        NOT_GIVEN, "s", "time between two exchanges; of a step control, the first step", gt=0
    )


#: Keys of [coupling] that mean something to the iterated scheme alone, and to a step control alone.
_OF_ITERATION = (
    *("waveform", "sweep", "acceleration", "relaxation"),
    *("relative_tolerance", "max_iterations", "on_divergence"),
)
_OF_CONTROL = ("largest_step", "step_tolerance", "safety")


class Run(Table):
    """From when to when, and how often there is a row of results.

    start : time at which the units start
    stop : time at which the run ends
    output_interval : time between two rows of the results; left out, a row a macro step
    checkpoint_seconds : wall time between two checkpoints, from which --resume goes on, the first
        after a second; 0: none
    checkpoint_steps : the same in macro steps, whichever is first; 0: by wall time alone
    """

    start: float = quantity(0.0, "s")
    stop: float = quantity(NOT_GIVEN, "s")
    output_interval: float = quantity(NOT_GIVEN, "s", gt=0)
    checkpoint_seconds: float = quantity(30.0, "s", ge=0)
    checkpoint_steps: int = quantity(0, "1", ge=0)

    @model_validator(mode="after")
    def _has_a_length(self) -> Self:
        if self.stop <= self.start:
            raise ValueError(
                f"stop = {self.stop:g} s, allowed is a time after run.start = {self.start:g} s"
            )
        return self


def unused(coupling: Coupling, run: Run) -> list[str]:
    """What was said and has no meaning beside the rest, a line each."""
    iterated, control = coupling.scheme == "iterated", coupling.step_control
    without: dict[str, str] = {}
    if iterated:
        without["extrapolation"] = 'scheme = "iterated"'
    else:
        without |= dict.fromkeys(_OF_ITERATION, f'scheme = "{coupling.scheme}"')
    if control == "fixed":
        without |= dict.fromkeys(_OF_CONTROL, 'step_control = "fixed"')
    if control != "energy":
        without["power_bonds"] = f'step_control = "{control}"'
    said = [key for key in Coupling.model_fields if key in coupling.model_fields_set]
    lines = [f"coupling.{key} is not used with {without[key]}" for key in said if key in without]
    if control != "fixed" and "output_interval" in run.model_fields_set:
        lines.append(
            f'run.output_interval is not used with step_control = "{control}": a row a step'
        )
    return lines
