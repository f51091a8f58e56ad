"""The folder `documentation` of the mechanical unit: its equations and variables, and a run to
compare with."""

from __future__ import annotations

from collections.abc import Sequence

from stickslip import EFFECTS

from cosim.fmu.description import UnitFacts
from cosim.fmu.description.cross_check import of_mechanics
from cosim.fmu.libraries import FMI2
from cosim.fmu.variables import Variable, by_array


def documentation(
    facts: UnitFacts, variables: Sequence[Variable], fmi: int = FMI2
) -> dict[str, bytes]:
    """Path in the unit -> content; the page is that of a version of FMI."""
    from cosim.report.page import render

    page = render(
        "documentation.html.j2",
        "cosim.fmu.description",
        facts=facts,
        fmi=fmi,
        variables=by_array(variables),
        effects=EFFECTS,
        allowed=allowed,
        starts=starts,
    )
    return {"documentation/index.html": page.encode()} | of_mechanics(facts.name, variables)


def allowed(variable: Variable) -> str:
    """The range of a variable, in words."""
    low, high = variable.min, variable.max
    if low is None and high is None:
        return ""
    if low is None:
        return f"at most {high:.10g}"
    if high is None:
        return f"{'above' if variable.above_min else 'at least'} {low:.10g}"
    return f"{'above ' if variable.above_min else ''}{low:.10g} to {high:.10g}"


def starts(elements: Sequence[Variable]) -> str:
    """Start value of a variable, or of an array: once, where all of its elements have the same."""
    values = [f"{each.start:g}" for each in elements if each.start is not None]
    return ", ".join(values if len(set(values)) > 1 else values[:1])
