"""The answer as data: what `plan.json` holds, and the lines that a terminal gets."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from stickslip import EFFECTS
from stickslip.quantity import details

from cosim.gap.plan.plan import Plan
from cosim.gap.plan.sizes import DRAWS, Size
from cosim.report.files import json_text
from cosim.report.page import unit_text

#: Significant digits: more than a smallest size has a meaning.
DIGITS = 3


def as_json(plan: Plan) -> str:
    """JSON text without NaN; what there is not is null."""
    return json_text(as_data(plan))


def as_data(plan: Plan) -> dict[str, Any]:
    """A tree of plain values. Of an effect with two directions the larger size is its smallest."""
    planned = plan.planned
    smallest: dict[str, Size] = {}
    for size in plan.sizes:
        other = smallest.setdefault(size.law.candidate.effect, size)
        if (size.percent or math.inf) > (other.percent or math.inf):
            smallest[size.law.candidate.effect] = size
    tree = {
        "campaign": planned.campaign.name,
        "power": plan.wanted,
        "false_names": plan.false,
        "friction": dict(planned.friction),
        "noise": dict(planned.campaign.noise),
        "runs": [
            {
                "mass": run.setting.mass, "stiffness": run.setting.stiffness,
                "surface_speed": run.setting.surface_speed, "duration": run.duration,
                "rate": run.rate,
            }
            for run in planned.runs
        ],
        "smallest": {effect: _of(size) for effect, size in smallest.items()},
        "laws": [{"effect": size.law.candidate.effect, **_of(size)} for size in plan.sizes],
        "not_tried": dict(plan.silent),
        "pairs": [
            {"truth": truth, "other": other, "share": share} for truth, other, share in plan.pairs
        ],
        "next_runs": [plan.next_run.as_data()] if plan.next_run else [],
        "remarks": list(planned.campaign.remarks),
    }  # fmt: skip
    plain: dict[str, Any] = _plain(tree)
    return plain


def _of(size: Size) -> dict[str, Any]:
    starts = {free.key: free.start for free in size.law.candidate.free_parameters[1:]}
    return {
        "law": size.law.candidate.form,
        "parameter": size.law.key,
        "unit": unit_of(size) or "1",
        "smallest": size.value,
        "smallest_alone": size.alone,
        "percent_of_friction": size.percent,
        "at": {**starts, **size.law.unknown.settings},
        "answers": {answer: count / DRAWS for answer, count in size.answers.items()},
    }


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(entry) for entry in value]
    if isinstance(value, float):
        return float(f"{value:.{DIGITS}g}") if math.isfinite(value) else None
    return value


def unit_of(size: Size) -> str:
    """Of the parameter; "" where it has none."""
    block, _, name = size.law.key.partition(".")
    (table,) = (effect.table for effect in EFFECTS if effect.id == block)
    unit = details(table.model_fields[name])["unit"]
    return "" if unit == "1" else unit


def value_text(value: float | None, size: Size, never: str = "not seen") -> str:
    """A size with its unit."""
    if value is None:
        return never
    return f"{value:.{DIGITS}g} {unit_text(unit_of(size))}".rstrip()


def percent_text(size: Size) -> str:
    """Of friction; of the surface's speed, where that is what changes."""
    of = "the surface's speed" if size.law.argument == "speed_ripple" else "friction"
    return f"{size.percent:.2g} % of {of}" if size.percent is not None else "–"


def sentence(plan: Plan) -> str:
    """The answer in a sentence."""
    runs = len(plan.planned.runs)
    seen = [size for size in plan.sizes if size.percent is not None]
    start = f"{runs} run{'s' * (runs != 1)}"
    if not seen:
        return f"{start} would name no effect of the catalogue, whatever its size"
    best, worst = min(seen, key=_percent), max(seen, key=_percent)
    return (
        f"{start} would name effects from {percent_text(best)} ({best.law.argument}) to "
        f"{percent_text(worst)} ({worst.law.argument}) in {100 * plan.wanted:.0f} of 100 campaigns"
    )


def _percent(size: Size) -> float:
    return size.percent or 0.0


def pair_text(truth: str, other: str, share: float) -> str:
    """One of `Plan.pairs`."""
    return f"{truth} is named as {other}, or in a class with it, {100 * share:.0f} times in 100"


def closing_lines(plan: Plan) -> list[str]:
    """What is said at the end, on a terminal."""
    lines = [f"{plan.planned.campaign.name}: {sentence(plan)}"]
    width = max(map(len, [*(size.law.key for size in plan.sizes), *plan.silent]), default=0)
    for size in plan.sizes:
        said = percent_text(size) if size.value is not None else "whatever its size"
        if size.value is not None and size.alone != size.value:
            said += f", by itself from {value_text(size.alone, size, 'no size on')}"
        lines.append(f"  {size.law.key:{width}}  {value_text(size.value, size):>16}  {said}")
    lines += [
        f"  {effect:{width}}  {'not tried':>16}  {why}" for effect, why in plan.silent.items()
    ]
    lines += [f"  pair  {pair_text(*pair)}" for pair in plan.pairs[:3]]
    return lines + ([f"  next  {plan.next_run.text}"] if plan.next_run else [])
