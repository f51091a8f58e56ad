"""The folder `documentation` of a unit: its equations and variables, and a run to compare with."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from stickslip import EFFECTS, Parameters
from stickslip.kernel.layout import O_SIZE, U_SIZE, constants

from cosim.fmu.description import UnitFacts
from cosim.fmu.variables import Variable

STOP, STEP = 10.0, 0.01  # s, of the run to compare with


def documentation(facts: UnitFacts, variables: Sequence[Variable]) -> dict[str, bytes]:
    """Path in the unit -> content."""
    from cosim.report.page import render

    page = render(
        "documentation.html.j2",
        "cosim.fmu.description",
        facts=facts,
        variables=variables,
        effects=EFFECTS,
        allowed=allowed,
    )
    opt = f"StartTime, 0\nStopTime, {STOP:g}\nStepSize, {STEP:g}\nRelTol, 1e-9\n"
    files = {
        "index.html": page,
        f"{facts.name}_ref.opt": opt,
        f"{facts.name}_in.csv": _inputs(variables),
        f"{facts.name}_ref.csv": _reference(variables),
    }
    return {f"documentation/{name}": text.encode() for name, text in files.items()}


def allowed(variable: Variable) -> str:
    """The range of a variable, in words."""
    low, high = variable.min, variable.max
    if low is None and high is None:
        return ""
    above = "above" if variable.above_min else "at least"
    parts = [f"{above} {low:g}" if low is not None else ""]
    parts.append(f"at most {high:g}" if high is not None else "")
    return ", ".join(filter(None, parts))


def _inputs(variables: Sequence[Variable]) -> str:
    inputs = [variable for variable in variables if variable.causality == "input"]
    starts = [variable.start or 0.0 for variable in inputs]
    return _csv([each.name for each in inputs], iter([(0.0, starts), (STOP, starts)]))


def _reference(variables: Sequence[Variable]) -> str:
    """Outputs of the model at its defaults, interpreted: not by what it is to be compared with."""
    places = constants()
    outputs = [variable for variable in variables if variable.causality == "output"]
    starts = {each.slot: each.start for each in variables if each.causality == "input"}
    u = [0.0] * U_SIZE
    for slot, start in starts.items():
        u[int(str(places[slot]))] = start or 0.0
    slots = [int(str(places[each.slot])) for each in outputs]
    return _csv([each.name for each in outputs], _rows(u, slots))


def _rows(u: list[float], slots: list[int]) -> Iterator[tuple[float, list[float]]]:
    from stickslip.arrays import RunArrays  # numba: only for who gets here

    run = RunArrays.begin(Parameters().pack(), u, interpreted=True)
    o = [0.0] * O_SIZE
    for n in range(round(STOP / STEP) + 1):
        if not run.advance(n * STEP):
            raise ValueError(f"the run to compare with stops: {run.failure}")
        run.kernel.show(run.p, run.u, run.z, run.w, o, 0)
        yield n * STEP, [o[slot] for slot in slots]


def _csv(names: list[str], rows: Iterator[tuple[float, list[float]]]) -> str:
    lines = [",".join(f'"{name}"' for name in ["time", *names])]
    lines += [",".join(repr(float(value)) for value in (time, *values)) for time, values in rows]
    return "\n".join(lines) + "\n"
