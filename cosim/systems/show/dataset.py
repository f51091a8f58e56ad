"""A run of a system as an xarray Dataset: what files, figures and summary are made of."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from cosim.coupling import Causality
from cosim.coupling.conversion import told_dimension
from cosim.report.files import provenance
from cosim.systems.run import SystemRun

Array = NDArray[np.float64]
RESIDUAL = "coupling_residual"


def system_dataset(run: SystemRun) -> xr.Dataset:
    """All outputs and connected inputs as `unit.port` over ``time`` (n,), steps over ``step_time``.

    Attributes of a variable: units, participant, causality, fed_by for an input; where its unit is
    defined, base_units, si_factor and si_offset (value in them = factor * value + offset).
    """
    result, sources = run.result, _sources(run)
    variables = {
        column(name): ("time", values, _attributes(run, name, sources))
        for name, values in result.values.items()
    }
    if result.ledger.flows or result.ledger.residuals:
        attributes: dict[str, str | float] = {
            "units": "J",
            "long_name": "energy handed over and not taken up, and what units state to be off by",
        }
        variables[RESIDUAL] = ("time", result.ledger.residual, attributes)
    time = {"units": "s", "long_name": "time"}
    dataset = xr.Dataset(variables, coords={"time": ("time", np.asarray(result.time), time)})
    dataset.attrs.update(
        title=run.specification.name,
        case="system",
        status=result.status,
        unconverged_steps=len(result.statistics.unconverged),
        reason=result.reason,
        system=run.specification.text,
        wall_time=float(result.wall_time),
        **provenance(),
    )
    return dataset.merge(_steps(run))


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
    }
    if causality is Causality.INPUT:
        found["fed_by"] = sources.get(name, "")
    if unit is not None:
        # for whoever has the same quantity in another unit
        base = told_dimension(unit.exponents)
        found |= {"base_units": base, "si_factor": unit.factor, "si_offset": unit.offset}
    return found


def _sources(run: SystemRun) -> dict[str, str]:
    return {str(each.sink): str(each.source) for each in run.assembly.system.connections}


def _steps(run: SystemRun) -> xr.Dataset:
    """Sizes of the macro steps; an entry is one step or, in a long run, some neighbouring ones."""
    steps = run.steps
    sizes = {
        "shortest_step": ("smallest macro step up to this time", steps.shortest),
        "longest_step": ("largest macro step up to this time", steps.longest),
    }
    return xr.Dataset(
        {
            name: ("step_time", values, {"units": "s", "long_name": text})
            for name, (text, values) in sizes.items()
        },
        coords={
            "step_time": (
                "step_time",
                steps.ends,
                {"units": "s", "long_name": "end of a macro step"},
            )
        },
    )
