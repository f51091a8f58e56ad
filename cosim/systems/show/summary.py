"""A run of a system as columns, of which files and figures are made, and its numbers: what
`summary.json` and the page show.
"""

import json
import math
from collections.abc import Callable
from dataclasses import replace
from operator import itemgetter
from typing import Any

import numpy as np

from cosim.coupling import Causality, Connection, CoupledSystem
from cosim.coupling.conversion import NO_UNIT, told_dimension, watts
from cosim.coupling.messages import WARNING
from cosim.coupling.system import ENERGY_UNIT, find_port
from cosim.report.columns import Column, Columns
from cosim.report.coupling import efforts, step_numbers
from cosim.report.files import provenance
from cosim.systems.run import SystemRun

RESIDUAL = "coupling_residual"
#: Size of a signal that is none: of what its participant has in the same unit, and of its nominal.
OF_ALIKE, OF_NOMINAL = 1e-11, 1e-13


def system_columns(run: SystemRun) -> Columns:
    """All outputs and connected inputs as `unit.port` over ``time`` (n,), ``macro_step`` over
    ``step_time``.

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
    said = "size of the macro steps since the recorded time before"
    variables["macro_step"] = Column(("step_time",), run.steps, _told("s", said))
    axes = {
        "time": Column(("time",), np.asarray(result.time), _told("s", "time")),
        "step_time": Column(("step_time",), result.time[1:], _told("s", "end of a macro step")),
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


def summary(run: SystemRun, columns: Columns) -> dict[str, Any]:
    """Status, steps, participants, connections, ledger, outputs, remarks, versions, the system,
    what the units warned of, and which of them left their rig.

    Times are in s, energies in J, outputs in their own units, which stand beside them; a number
    that a run does not have is None.
    """
    result, system = run.result, run.assembly.system
    time = result.time
    return {
        "name": columns.attrs["title"],
        "case": columns.attrs["case"],
        "status": result.status,
        "reason": result.reason,
        "time_reached": float(time[-1]) if time.size else None,
        "rows": int(time.size),
        "wall_time": float(result.wall_time),
        "coupling": _coupling(run),
        "participants": {name: _participant(run, name) for name in system.participants},
        "connections": [_connection(system, each) for each in system.connections],
        "ledger": ledger(run),
        "outputs": _outputs(columns),
        "remarks": [*run.assembly.remarks, *result.remarks],
        "warnings": warnings(run),
        "beyond_rig": beyond_rig(run),
        "created": columns.attrs["created"],
        "versions": json.loads(columns.attrs["versions"]),
        "source": run.specification.source,
        "system": run.specification.text,
    }


def warnings(run: SystemRun) -> list[str]:
    """What each unit warned of, with the first time of the same text, a line each."""
    found: dict[tuple[str, str], str] = {}
    for participant in run.assembly.system.participants.values():
        for message in participant.messages:  # type: ignore[attr-defined]  # all units have them
            if message.status == WARNING:
                said = f"{message.source}: {message.when}: {message.text}"
                found.setdefault((message.source, message.text), said)
    return list(found.values())


#: Outputs by which a unit says that no rig moves as it does, and what they say.
BEYOND_RIG = {
    "off_belt": "the block has left the belt",
    "spring_overstretched": "a spring is longer than it can be",
}


def beyond_rig(run: SystemRun) -> list[dict[str, Any]]:
    """Units that say so of themselves, with the time (s) from which on."""
    found = []
    for name, values in run.result.values.items():
        unit, _, port = name.rpartition(".")
        is_output = port in BEYOND_RIG and (
            run.assembly.system.participants[unit].ports[port].causality is Causality.OUTPUT
        )
        if is_output and np.any(values):
            since = float(run.result.time[np.flatnonzero(values)[0]])
            found.append({"unit": unit, "output": port, "since": since, "says": BEYOND_RIG[port]})
    return found


def ledger(run: SystemRun) -> dict[str, Any]:
    """Energy that has crossed: connections in J by their receipts, those in W by their integrals.

    Of a power the one integral is that of what the sink was given, held over each row, the other
    what the source has made, by its own total or by trapezoids under its curve; they differ by what
    the coupling has added.
    """
    result = run.result
    energies = [
        {
            "connection": str(flow.connection),
            "handed": _last(flow.handed),
            "taken": _last(flow.taken),
            "in_transit": _last(flow.in_transit),
            "most_in_transit": _largest(flow.in_transit),
        }
        for flow in result.ledger.flows
    ]
    residuals = [
        {"output": name, "end": _last(values), "largest": _largest(values)}
        for name, values in result.ledger.residuals.items()
    ]
    powers = [_power(run, connection) for connection in run.assembly.system.connections]
    return {"energies": energies, "powers": [*filter(None, powers)], "residuals": residuals}


def _power(run: SystemRun, connection: Connection) -> dict[str, Any] | None:
    """J given to the sink, and J that the source made; None for what is no power.

    The total of `name_flow` in W is `name` in J beside it; else what is under the source's curve.
    """
    participants, result = run.assembly.system.participants, run.result
    source = watts(find_port(participants, connection.source))
    sink = watts(find_port(participants, connection.sink))
    if source is None or sink is None or result.time.size < 2:
        return None
    sent = result.values[str(connection.source)]
    total = connection.source.port.removesuffix("_flow")
    beside = participants[connection.source.participant].ports.get(total)
    is_flow = total != connection.source.port
    counted = is_flow and beside is not None and beside.unit == ENERGY_UNIT
    if counted:
        sums = result.values[str(replace(connection.source, port=total))]
        made = _number(float(sums[-1] - sums[0]))
    else:
        made = _number(source * float(np.trapezoid(sent, result.time)))
    held = result.values[str(connection.sink)][1:] * np.diff(result.time)
    given = _number(sink * float(np.sum(held)))
    if given is None or made is None:
        return None
    return {
        "connection": str(connection),
        "given": given,
        "made" if counted else "under_the_curve": made,
        "added": given - made,
    }


def _coupling(run: SystemRun) -> dict[str, Any]:
    settings, done = run.specification.coupling, run.result.statistics
    return {
        "scheme": settings.scheme,
        "order": list(run.assembly.scheme.order),
        "step_control": settings.step_control,
        "macro_step": run.assembly.macro_step,
        **step_numbers(run.result),
        "shortest_step": done.shortest or None,
        "longest_step": done.longest or None,
    }


def _participant(run: SystemRun, name: str) -> dict[str, Any]:
    entry = next(unit for unit in run.specification.units if unit.name == name)
    participant: Any = run.assembly.system.participants[name]
    ports = participant.ports.values()
    return {
        "file": entry.file.name,
        "isolated": entry.isolate,
        "substeps": entry.substeps,
        "inputs": sum(port.causality == "input" for port in ports),
        "outputs": sum(port.causality == "output" for port in ports),
        **efforts(run.result)[name],
        "messages": participant.messages.said,
        "set": {key: start.value for key, start in entry.given.items()},
    }


def _connection(system: CoupledSystem, connection: Connection) -> dict[str, Any]:
    affine = system.conversions[connection]
    return {
        "from": str(connection.source),
        "to": str(connection.sink),
        "unit": find_port(system.participants, connection.source).unit,
        "to_unit": find_port(system.participants, connection.sink).unit,
        "factor": affine.factor,
        "offset": affine.offset,
    }


def _outputs(columns: Columns) -> dict[str, dict[str, Any]]:
    found = {}
    for name, variable in columns.data_vars.items():
        if variable.attrs.get("causality") == "output":
            values = variable.values
            found[str(name)] = {
                "unit": variable.attrs["units"],
                "nominal": variable.attrs["nominal"],
                "start": _picked(itemgetter(0), values),
                "end": _last(values),
                "lowest": _picked(np.min, values),
                "highest": _picked(np.max, values),
                "rounding": bool(values.size) and is_rounding(columns, str(name)),
            }
    return found


def _picked(pick: Callable[[np.ndarray], float], values: np.ndarray) -> float | None:
    """One of some values; None where there are none, or it is not finite."""
    return _number(float(pick(values))) if values.size else None


def _last(values: np.ndarray) -> float | None:
    return _picked(itemgetter(-1), values)


def _largest(values: np.ndarray) -> float | None:
    return _picked(np.max, np.abs(values))


def _number(value: float) -> float | None:
    return value + 0.0 if math.isfinite(value) else None  # no negative zero
