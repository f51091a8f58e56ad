"""The answer as data: what `plan.json` holds, and the lines that a terminal gets."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from cosim.report.files import json_text
from cosim.report.page import unit_text

from .next_run import NextRun
from .plan import Plan, Size

#: Significant digits: more than a smallest size has a meaning.
_DIGITS = 4


def as_json(plan: Plan) -> str:
    """JSON text without NaN; what there is not is null."""
    return json_text(as_data(plan))


def as_data(plan: Plan) -> dict[str, Any]:
    """A tree of plain values."""
    planned = plan.planned
    return _plain(
        {
            "campaign": planned.campaign.name,
            "level": plan.level,
            "power": plan.wanted,
            "friction": dict(planned.friction),
            "noise": dict(planned.campaign.noise),
            "runs": [
                {
                    "mass": run.setting.mass,
                    "stiffness": run.setting.stiffness,
                    "surface_speed": run.setting.surface_speed,
                    "duration": run.duration,
                    "rate": run.rate,
                }
                for run in planned.runs
            ],
            "smallest": {size.effect: _of(size) for size in plan.sizes},
            "laws": [{"effect": size.effect, **_of(size, alone=False)} for size in plan.laws],
            "not_tried": plan.silent,
            "pairs": [asdict(pair) for pair in plan.pairs],
            "classes": plan.indistinguishable,
            "next_runs": [asdict(run) for run in plan.next_runs],
            "next_runs_tried": plan.grid,
            "remarks": planned.campaign.remarks,
        }
    )


def _of(size: Size, alone: bool = True) -> dict[str, Any]:
    return {
        "law": size.form,
        "parameter": size.key,
        "unit": size.unit or "1",
        "smallest": size.value,
        **({"smallest_alone": size.alone} if alone else {}),
        "percent_of_friction": size.percent,
        "at": size.shapes,
        "typical": size.typical,
    }


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(entry) for entry in value]
    if isinstance(value, float):
        return float(f"{value:.{_DIGITS}g}") if math.isfinite(value) else None
    return value


def size_text(size: Size) -> str:
    """A smallest size with its unit."""
    return _with_unit(size.value, size) if math.isfinite(size.value) else "not seen"


def alone_text(size: Size) -> str:
    """The size from which it is told from every other effect, with its unit."""
    return _with_unit(size.alone, size) if math.isfinite(size.alone) else "never"


def _with_unit(value: float, size: Size) -> str:
    return f"{value:.3g} {unit_text(size.unit)}".rstrip()


def percent_text(percent: float) -> str:
    """So much of friction; a dash where there is no such size."""
    return f"{percent:.2g} %" if math.isfinite(percent) else "–"


def run_text(run: NextRun) -> str:
    """The setting of a next run and what it is for."""
    setting = (
        f"{run.mass:.4g} kg, springs of {run.stiffness:.4g} N/m, surface at "
        f"{run.surface_speed:.2g} m/s for {run.duration:.4g} s"
    )
    if len(run.effects) == 1:
        was = "not seen" if math.isinf(run.before) else f"{percent_text(run.before)} of friction"
        if math.isinf(run.after):
            return f"{setting}: nothing on the grid makes {run.effects[0]} seen"
        return f"{setting}: {run.effects[0]} from {was} to {percent_text(run.after)}"
    truth, other = run.effects
    was = "never" if math.isinf(run.before) else f"at {run.before:.2g} times its smallest size"
    then = "as soon as it is seen" if run.after <= 1.0 else f"at {run.after:.2g} times"
    return f"{setting}: {truth} told from {other} {was}, then {then}"


def closing_lines(plan: Plan) -> list[str]:
    """What is said at the end, on a terminal."""
    runs = len(plan.planned.runs)
    lines = [
        f"{plan.planned.campaign.name}: {runs} run{'s' * (runs != 1)}; smallest sizes named with "
        f"{100 * plan.wanted:.0f} % (and something with {100 * plan.level:.2g} % where nothing is)"
    ]
    width = max(map(len, [*(size.key for size in plan.sizes), *plan.silent]))
    for size in plan.sizes:
        percent = f"{percent_text(size.percent)} of friction"
        by_itself = ""
        if math.isfinite(size.value) and size.alone != size.value:
            by_itself = f", told from every other effect at {alone_text(size)}"
        said = f"{percent}{by_itself}" if math.isfinite(size.value) else "whatever its size"
        lines.append(f"  {size.key:{width}}  {size_text(size):>16}  {said}")
    lines += [
        f"  {effect:{width}}  {'not tried':>16}  {why}" for effect, why in plan.silent.items()
    ]
    lines += [f"  next, for the {run.aim}: {run_text(run)}" for run in plan.next_runs]
    return lines
