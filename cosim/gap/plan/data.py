"""The answer as data: what `plan.json` holds, and the lines that a terminal gets."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from cosim.gap.plan.next_run import SETTINGS
from cosim.gap.plan.plan import Plan
from cosim.gap.plan.sizes import DRAWS, Size
from cosim.gap.show.numbers import tree
from cosim.report.page import unit_text


def as_data(plan: Plan) -> dict[str, Any]:
    """A tree of plain values. Of an effect with two directions the larger size is its smallest."""
    planned = plan.planned
    seen = sorted(plan.sizes, key=lambda size: (size.value is None, size.percent))
    told: dict[str, Any] = tree({
        "campaign": planned.campaign.name,
        "power": plan.wanted,
        "false_names": plan.false,
        "friction": planned.friction,
        "friction_source": planned.source,
        "noise": planned.campaign.noise,
        "runs": [
            {name: getattr(run.setting, name) for name in SETTINGS}
            | {"duration": run.duration, "rate": run.rate}
            for run in planned.runs
        ],
        "smallest": {size.law.candidate.effect: _of(size) for size in seen},
        "laws": [_of(size) for size in plan.sizes],
        "not_tried": plan.silent,
        "pairs": [dict(zip(("truth", "other", "share"), pair, strict=True)) for pair in plan.pairs],
        "next_runs": [plan.next_run.as_data()] if plan.next_run else [],
        "remarks": planned.campaign.remarks,
    })  # fmt: skip
    return told


def _of(size: Size) -> dict[str, Any]:
    starts = {free.key: free.start for free in size.law.candidate.free_parameters[1:]}
    return {
        "effect": size.law.candidate.effect, "law": size.law.candidate.form,
        "parameter": size.law.key, "unit": size.law.unit, "smallest": size.value,
        "smallest_alone": size.alone, "percent_of_friction": size.percent,
        "at": {**starts, **size.law.unknown.settings},
        "answers": {answer: count / DRAWS for answer, count in size.answers.items()},
    }  # fmt: skip


def value_text(value: float | None, size: Size, never: str = "not seen") -> str:
    """A size with its unit."""
    if value is None:
        return never
    return f"{value:.3g} {unit_text(size.law.unit)}".removesuffix(" 1")


def percent_text(size: Size) -> str:
    """Of friction; of the surface's speed, where that is what changes."""
    of = "the surface's speed" if size.law.argument == "speed_ripple" else "friction"
    return f"{size.percent:.2g} % of {of}" if size.percent is not None else "–"


def name_of(size: Size, sizes: Sequence[Size]) -> str:
    """Its parameter, of a wave its length, and of two directions which."""
    law = size.law
    if law.wave:
        return f"{law.key}, {law.unknown.variant}"
    if sum(other.law.key == law.key for other in sizes) == 1:
        return str(law.key)
    return f"{law.key} {'>' if law.most > law.neutral else '<'} {law.neutral:g}"


def sentence(plan: Plan) -> str:
    """The answer in a sentence."""
    runs = len(plan.planned.runs)
    seen = [size for size in plan.sizes if size.percent is not None]
    start = f"{runs} run{'s' * (runs != 1)}"
    if not seen:
        return f"{start} would name no effect of the catalogue, whatever its size"
    *_, worst = best, *_ = sorted(seen, key=lambda size: size.percent or 0.0)
    return (
        f"{start} would name effects from {percent_text(best)} ({best.law.argument}) to "
        f"{percent_text(worst)} ({worst.law.argument}) in {100 * plan.wanted:.0f} of 100 campaigns"
    )


def closing_lines(plan: Plan) -> list[str]:
    """What is said at the end, on a terminal."""
    lines = [f"{plan.planned.campaign.name}: {sentence(plan)}"]
    lines += [f"  friction  {plan.planned.source}"]
    names = [name_of(size, plan.sizes) for size in plan.sizes]
    width = max(map(len, [*names, *plan.silent]), default=0)
    for name, size in zip(names, plan.sizes, strict=True):
        said = percent_text(size) if size.value is not None else "whatever its size"
        if size.value is not None and size.alone != size.value:
            alone = value_text(size.alone, size)
            said += ", never by itself" if size.alone is None else f", by itself from {alone}"
        lines.append(f"  {name:{width}}  {value_text(size.value, size):>16}  {said}")
    for effect, why in plan.silent.items():
        lines.append(f"  {effect:{width}}  {'not tried':>16}  {why}")
    for truth, other, share in plan.pairs[:3]:
        times = f"{100 * share:.0f} times in 100"
        of_least = f"{truth} of its smallest size"
        lines.append(f"  pair  {of_least} is named as {other}, or in a class with it, {times}")
    return lines + ([f"  next  {plan.next_run.text}"] if plan.next_run else [])
