"""The variables of the units, from the declarations that their descriptions are made of."""

from collections.abc import Iterable

from cosim.fmu.thermal import variables as heat
from cosim.fmu.variables import Variable, by_array, variables

from .markdown import code, heading, table

HEAD = ("variable", "unit", "start", "allowed", "is")


def mechanics() -> str:
    """StickSlip3DOF: ports and parameters."""
    return by_causality(variables())


def thermal() -> str:
    """BeltIceThermal, the reduced one: ports and parameters."""
    return by_causality([*heat.reduced()])


def by_causality(declared: Iterable[Variable]) -> str:
    """Inputs, outputs, parameters: a table each, arrays as one line."""
    declared = list(declared)
    parts = []
    for causality in ("input", "output", "parameter"):
        found = by_array(one for one in declared if one.causality == causality)
        parts.append(heading(3, f"{causality.capitalize()}s") + table(HEAD, map(_row, found)))
    return "".join(parts)


def _row(group: list[Variable]) -> tuple[str, ...]:
    first = group[0]
    many = len(group) > 1
    name = f"{first.array}[1..{len(group)}]" if many else first.name
    start = "" if many or first.start is None else f"{first.start:g}"
    tunable = " (tunable in a run)" if first.is_tunable else ""
    unit = {None: "Boolean" if first.is_boolean else "integer", "1": ""}.get(first.unit, first.unit)
    return code(name), unit, start, _bounds(first), first.description + tunable


def _bounds(variable: Variable) -> str:
    low, high = variable.min, variable.max
    if low is None and high is None:
        return ""
    first = "(-inf" if low is None else f"{'(' if variable.above_min else '['}{low:g}"
    return f"{first}, inf)" if high is None else f"{first}, {high:g}]"
