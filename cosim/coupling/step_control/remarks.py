"""What the user of a run should know before its first step, and what may be wrong with it after."""

from __future__ import annotations

from cosim.coupling.participant import capabilities
from cosim.coupling.schemes.scheme import Scheme
from cosim.coupling.step_control.control import StepControl
from cosim.coupling.system import CoupledSystem

#: Degree of the inputs over a step -> its name.
DEGREES = {2: "quadratic"}


def remarks_of(
    system: CoupledSystem, scheme: Scheme, control: StepControl, length: float
) -> list[str]:
    """What of the settings comes to something else than they say, a line each.

    length: of the run, s.
    """
    size = control.first_size
    found = []
    if size > length * (1.0 + 1e-9):
        found.append(
            f"macro_step = {size:g} s is longer than the run, which is one step of {length:g} s"
        )
    return [*found, *_lower_degrees(system, scheme)]


def _lower_degrees(system: CoupledSystem, scheme: Scheme) -> list[str]:
    """Participants that are given less of their inputs' course than the scheme knows of it."""
    degree = scheme.accuracy - 1
    if degree not in DEGREES:
        return []
    fed = {connection.sink.participant for connection in system.connections}
    found = []
    for name in system.participants:
        order = capabilities(system.participants[name]).input_order
        if name in fed and order is not None and order < degree:
            found.append(
                f"{name} takes no more than first derivatives of its inputs: they are linear over"
                f" a step there, not {DEGREES[degree]}"
            )
    return found
