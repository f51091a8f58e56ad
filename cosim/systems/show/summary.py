"""The numbers of a system's run: what `summary.json` and the page show."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from cosim.coupling import Causality, Connection, CoupledSystem
from cosim.coupling.conversion import watts
from cosim.coupling.messages import WARNING
from cosim.coupling.system import ENERGY_UNIT, find_port
from cosim.report.columns import Columns
from cosim.report.coupling import efforts, step_numbers
from cosim.report.files import results_line
from cosim.report.page import number
from cosim.systems.run import SystemRun
from cosim.systems.show.dataset import is_rounding

#: Remarks that the terminal shows.
MOST_NOTES = 4


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
    powers = []
    for connection in run.assembly.system.connections:
        given, made, counted = _integrals(run, connection)
        if given is not None and made is not None:
            powers.append(
                {
                    "connection": str(connection),
                    "given": given,
                    "made" if counted else "under_the_curve": made,
                    "added": given - made,
                }
            )
    return {"energies": energies, "powers": powers, "residuals": residuals}


def _integrals(run: SystemRun, connection: Connection) -> tuple[float | None, float | None, bool]:
    """J given to the sink, J that the source made, and whether by its own total.

    The total of `name_flow` in W is `name` in J beside it; else what is under the source's curve.
    None for what is no power.
    """
    participants, result = run.assembly.system.participants, run.result
    source = watts(find_port(participants, connection.source))
    sink = watts(find_port(participants, connection.sink))
    if source is None or sink is None or result.time.size < 2:
        return None, None, False
    given = result.values[str(connection.sink)]
    sent = result.values[str(connection.source)]
    total = str(connection.source).removesuffix("_flow")
    address = replace(connection.source, port=connection.source.port.removesuffix("_flow"))
    ports = participants[address.participant].ports
    counted = (
        address != connection.source
        and address.port in ports
        and (ports[address.port].unit == ENERGY_UNIT)
    )
    made = (
        float(result.values[total][-1] - result.values[total][0])
        if counted else source * float(np.trapezoid(sent, result.time))
    )  # fmt: skip
    return _number(sink * float(np.sum(given[1:] * np.diff(result.time)))), _number(made), counted


def _coupling(run: SystemRun) -> dict[str, Any]:
    settings, steps = run.specification.coupling, run.steps
    return {
        "scheme": settings.scheme,
        "order": list(run.assembly.order),
        "step_control": settings.step_control,
        "macro_step": run.assembly.macro_step,
        **step_numbers(run.result),
        "shortest_step": _number(float(steps.shortest.min())) if steps.count else None,
        "longest_step": _number(float(steps.longest.max())) if steps.count else None,
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
                "start": _number(float(values[0])) if values.size else None,
                "end": _last(values),
                "lowest": _number(float(np.min(values))) if values.size else None,
                "highest": _number(float(np.max(values))) if values.size else None,
                "rounding": bool(values.size) and is_rounding(columns, str(name)),
            }
    return found


def _last(values: np.ndarray) -> float | None:
    return _number(float(values[-1])) if values.size else None


def _largest(values: np.ndarray) -> float | None:
    return _number(float(np.max(np.abs(values)))) if values.size else None


def _number(value: float) -> float | None:
    return value + 0.0 if math.isfinite(value) else None  # no negative zero


def in_few_lines(said: Sequence[str]) -> list[str]:
    """The first of them, and how many more there are."""
    more = len(said) - MOST_NOTES
    return [*said[:MOST_NOTES], *([f"{more} more on the page"] if more > 0 else [])]


def closing_lines(numbers: Mapping[str, Any], folder: Path, wall_time: float) -> list[str]:
    """What whoever waited for the run is told."""
    coupling = numbers["coupling"]
    lines = [
        f"{numbers['name']}: {numbers['time_reached']:g} s in {wall_time:.1f} s of wall time, "
        f"{numbers['wall_time']:.2g} s of them in the units",
        f"  units        {len(numbers['participants'])}, {len(numbers['connections'])} connections",
        f"  steps        {coupling['steps']} by {coupling['scheme']}, "
        f"{_range(coupling['shortest_step'], coupling['longest_step'])}{_repeated(coupling)}",
    ]
    lines += [f"  energy       {line}" for line in ledger_lines(numbers["ledger"])]
    lines += [f"  note         {remark}" for remark in in_few_lines(numbers["remarks"])]
    return [*lines, results_line(folder)]


def ledger_lines(found: Mapping[str, Any]) -> list[str]:
    """A line for every connection that carries energy."""
    lines = [
        f"{flow['connection']}: {number(flow['handed'])} J handed over, "
        f"{number(flow['in_transit'], 2, largest=flow['handed'] or 0.0)} J of them not taken up"
        for flow in found["energies"]
    ]
    return lines + [
        f"{flow['connection']}: {number(flow['given'])} J given, "
        + (
            f"{number(flow['made'])} J made by the source"
            if "made" in flow
            else f"{number(flow['under_the_curve'])} J under the output's curve"
        )
        for flow in found["powers"]
    ]


def _repeated(coupling: Mapping[str, Any]) -> str:
    """What was made more than once, and what stands although it should not."""
    parts = []
    if coupling["rejected"]:
        parts.append(f"{coupling['rejected']} taken back")
    if coupling["most_iterations"] > 1:
        parts.append(f"at most {coupling['most_iterations']} iterations a step")
    for key, words in (("unconverged", "not converged"), ("above_tolerance", "above tolerance")):
        if coupling[key]:
            parts.append(f"{coupling[key]} {words}")
    return "".join(f", {part}" for part in parts)


def _range(shortest: float | None, longest: float | None) -> str:
    if shortest is None or longest is None:
        return "none made"
    if longest - shortest <= 1e-6 * longest:
        return f"{longest:.4g} s each"
    return f"{shortest:.3g} to {longest:.3g} s"
