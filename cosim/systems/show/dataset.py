"""A run of a system as columns: what files, figures and summary are made of."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cosim.coupling import Causality
from cosim.coupling.conversion import NO_UNIT, told_dimension
from cosim.report.columns import Column, Columns
from cosim.report.files import provenance
from cosim.systems.run import SystemRun

Array = NDArray[np.float64]
RESIDUAL = "coupling_residual"
#: Size of a signal that is none: of what its participant has in the same unit, and of its nominal.
OF_ALIKE, OF_NOMINAL = 1e-11, 1e-13


def system_columns(run: SystemRun) -> Columns:
    """All outputs and connected inputs as `unit.port` over ``time`` (n,), steps over ``step_time``.

    Attributes of a variable: units, participant, causality, nominal, fed_by for an input; where its
    unit is defined, base_units, si_factor and si_offset (value in them = factor * value + offset).
    """
    result = run.result
    sources = {str(each.sink): str(each.source) for each in run.assembly.system.connections}
    variables = {
        column(name): Column(("time",), np.asarray(values), _attributes(run, name, sources))
        for name, values in result.values.items()
    }
    if result.ledger.flows or result.ledger.residuals:
        said = "energy handed over and not taken up, and what units state to be off by"
        variables[RESIDUAL] = Column(("time",), result.ledger.residual, _told("J", said))
    # an entry is one step or, in a long run, some neighbouring ones
    ends, shortest, longest = run.steps.groups
    for name, values, said in (
        ("shortest_step", shortest, "smallest macro step up to this time"),
        ("longest_step", longest, "largest macro step up to this time"),
    ):
        variables[name] = Column(("step_time",), values, _told("s", said))
    axes = {
        "time": Column(("time",), np.asarray(result.time), _told("s", "time")),
        "step_time": Column(("step_time",), ends, _told("s", "end of a macro step")),
    }
    attributes = {
        "title": run.specification.name,
        "case": "system",
        "status": result.status,
        "unconverged_steps": len(result.statistics.unconverged),
        "reason": result.reason,
        "system": run.specification.text,
        "wall_time": float(result.wall_time),
        **provenance(),
    }
    return Columns(variables, axes, attributes)


def _told(unit: str, text: str) -> dict[str, str]:
    return {"units": unit, "long_name": text}


def column(name: str) -> str:
    """`unit.port` as the name of a variable: netCDF keeps the slash for its groups."""
    return name.replace("/", "|")


def _attributes(run: SystemRun, name: str, sources: dict[str, str]) -> dict[str, str | float]:
    participant, _, port = name.partition(".")
    described = run.assembly.system.participants[participant].ports[port]
    causality, unit = described.causality, described.definition
    found: dict[str, str | float] = {
        "units": run.result.units[name],
        "long_name": name,
        "participant": participant,
        "causality": str(causality),
        "nominal": described.nominal,
    }
    if causality is Causality.INPUT:
        found["fed_by"] = sources.get(name, "")
    if unit is not None:
        # for whoever has the same quantity in another unit
        base = told_dimension(unit.exponents)
        found |= {"base_units": base, "si_factor": unit.factor, "si_offset": unit.offset}
    return found


def is_rounding(columns: Columns, name: str) -> bool:
    """Whether it is never more than rounding of what its participant computes with."""
    own = columns[name].attrs
    alike = [
        _size(each)
        for each in columns.data_vars.values()
        if each.attrs.get("participant") == own["participant"]
        and each.attrs["units"] == own["units"] != NO_UNIT
    ]
    least = max(OF_NOMINAL * own["nominal"], OF_ALIKE * max(alike, default=0.0))
    return bool(0.0 < _size(columns[name]) < least)


def _size(column: Column) -> float:
    return float(np.max(np.abs(column.values)))
