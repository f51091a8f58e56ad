"""The folder `documentation` of a unit: its equations and variables, and a run to compare with.

The run is in the files that the FMI cross-check asks for, by the unit's name: `_in.csv`, inputs
over the time; `_ref.opt`, the times and the tolerance of the run; `_ref.csv`, at most ten outputs,
computed by the model in Python and not by the unit. Rules: github.com/modelica/fmi-cross-check,
section 9.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache

from stickslip import Parameters
from stickslip.catalogue import CATALOGUE, Catalogue
from stickslip.kernel import layout
from stickslip.kernel.layout import O_SIZE, U_SIZE

from cosim.fmu.description import UnitFacts
from cosim.fmu.libraries import FMI2
from cosim.fmu.variables import Variable, by_array, rig_defaults

Row = tuple[float, Sequence[float]]


def documentation(
    facts: UnitFacts,
    variables: Sequence[Variable],
    fmi: int = FMI2,
    catalogue: Catalogue = CATALOGUE,
) -> dict[str, bytes]:
    """Path in the unit -> content; the page is that of a version of FMI."""
    from cosim.report.page import render

    page = render(
        "documentation.html.j2",
        "cosim.fmu.description",
        facts=facts,
        fmi=fmi,
        variables=by_array(variables),
        effects=catalogue.effects,
        allowed=allowed,
        starts=starts,
        reference=MECHANICS,
    )
    return {"documentation/index.html": page.encode()} | of_mechanics(
        facts.name, variables, catalogue
    )


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


@dataclass(frozen=True)
class Experiment:
    """Stop time and step, s, and relative tolerance of a run from time 0 on."""

    stop: float
    step: float
    tolerance: float

    @property
    def times(self) -> list[float]:
        """Communication points, s."""
        return [n * self.step for n in range(round(self.stop / self.step) + 1)]

    @property
    def text(self) -> str:
        """`_ref.opt`."""
        return (
            f"StartTime, 0\nStopTime, {self.stop:g}\nStepSize, {self.step:g}\n"
            f"RelTol, {self.tolerance:g}\n"
        )


#: Over the run-up of the surface, and as long at its speed.
MECHANICS = Experiment(20.0, 0.01, 1e-9)
#: Those that are not zero but for rounding, and the same in co-simulation and in model exchange.
SHOWN_OF_MECHANICS = (
    "x", "vx", "friction_force_x", "sliding_speed", "heat", "sliding_distance",
    "surface_travel", "mode", "slip_count",
)  # fmt: skip


Table = tuple[Sequence[str], Iterable[Row]]


def cross_check(
    name: str, experiment: Experiment, inputs: Table, reference: Table
) -> dict[str, bytes]:
    """Path in the unit -> content; ``inputs``, linear in between, and ``reference``: names of the
    variables, and times, s, each with their values."""
    files = {"ref.opt": experiment.text, "in.csv": _csv(*inputs), "ref.csv": _csv(*reference)}
    return {f"documentation/{name}_{file}": text.encode() for file, text in files.items()}


def _csv(columns: Sequence[str], rows: Iterable[Row]) -> str:
    lines = [",".join(f'"{name}"' for name in ["time", *columns])]
    lines += [",".join(repr(float(value)) for value in (time, *values)) for time, values in rows]
    return "\n".join(lines) + "\n"


def of_mechanics(
    name: str, variables: Sequence[Variable], catalogue: Catalogue = CATALOGUE
) -> dict[str, bytes]:
    """Of the block as the unit starts: the interpreted model."""
    inputs = [each for each in variables if each.causality == "input"]
    starts = [each.start or 0.0 for each in inputs]
    u = [0.0] * U_SIZE
    for each, start in zip(inputs, starts, strict=True):
        u[_place(each)] = start
    given = [(time, starts) for time in (0.0, MECHANICS.stop)]
    shown = [each for each in variables if each.name in SHOWN_OF_MECHANICS]
    motion = ((t, [o[_place(each)] for each in shown]) for t, o in _motion(tuple(u), catalogue))
    tables = ([each.name for each in inputs], given), ([each.name for each in shown], motion)
    return cross_check(name, MECHANICS, *tables)


def _place(variable: Variable) -> int:
    return int(getattr(layout, variable.slot))


@cache
def _motion(u: tuple[float, ...], catalogue: Catalogue) -> list[tuple[float, list[float]]]:
    """Times, s, and all outputs of the kernel; once for the units of a process."""
    from stickslip.arrays import RunArrays  # numpy: only for who gets here

    rig = Parameters.of(catalogue).model_validate(rig_defaults())
    run = RunArrays.begin(rig.pack(), list(u), interpreted=True, catalogue=catalogue)
    rows = []
    for time in MECHANICS.times:
        o = [0.0] * O_SIZE
        run.advance(time)
        run.kernel.show(run.p, run.u, run.z, run.w, o, 0)
        rows.append((time, o))
    return rows
