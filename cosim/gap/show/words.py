"""The answer in sentences."""

from __future__ import annotations

from collections.abc import Sequence

from stickslip import EFFECTS

from cosim.gap.camera import faults
from cosim.gap.result import Gap
from cosim.studies.reproduction.summary import SummaryGap

from .quantities import PLAIN, Quantity, quantities
from .reproduced import Reproduced

#: Of the tracker; said where everything is.
ZEROS = ("offset.x", "offset.y")
Answer = Gap | SummaryGap
SENTENCES = {entry.id: entry.sentence.rstrip(".") for entry in EFFECTS} | faults.SENTENCES


def verdict(gap: Answer) -> str:
    """The verdict and what it rests on."""
    return f"{gap.verdict.capitalize()}: {reason(gap)}"


def reason(gap: Answer) -> str:
    """What the verdict's word stands for here, one sentence."""
    if gap.verdict == "none":
        return "the plain model, its numbers fitted, leaves only noise."
    if gap.verdict == "named":
        return f"{' and '.join(map(described, gap.effects))}."
    return _class(gap) if gap.verdict == "class" else _unknown(gap)


def described(effect: str) -> str:
    """An effect's id with what it adds."""
    return f"{effect} ({SENTENCES[effect][0].lower()}{SENTENCES[effect][1:]})"


def _class(gap: Answer) -> str:
    groups = [" or ".join(group) for group in gap.classes]
    alone = [e for e in gap.effects if not any(e in group for group in gap.classes)]
    beside = f", beside {' and '.join(alone)}" if alone else ""
    return f"{'; '.join(groups)}{beside}; these data cannot tell which."


def _unknown(gap: Answer) -> str:
    if gap.effects:
        return (
            f"with {' and '.join(gap.effects)} the model comes nearer, but a disagreement "
            "is left that no catalogued effect repairs."
        )
    return "the plain model does not fit, and no catalogued effect repairs it."


def gap_line(gap: Answer) -> str:
    """Before and after, held out and fit."""
    figures = isinstance(gap, SummaryGap)
    unit = "standard deviations" if figures else "noise units"
    one = "what the observations leave open" if figures else "measurement noise"
    (fit, held), (fit_after, held_after) = gap.gap_before, gap.gap_after
    return (
        f"held out {held:.3g} → {held_after:.3g} {unit}, "
        f"fit {fit:.3g} → {fit_after:.3g} (1 is {one})"
    )


def fitted_quantities(gap: Answer) -> list[Quantity]:
    """The numbers of the model that is left: friction, then what was added, fitted or set."""
    if isinstance(gap, SummaryGap):
        model = gap.extended or gap.plain
        intervals = {key: (low, high) for key, (_, low, high) in gap.determined.items()}
        for row in gap.ranking:
            if row.effect in gap.found:
                intervals |= row.intervals
        return quantities(model.values, intervals)
    fitted = gap.model
    known = {key: (low, high) for key, (_, low, high) in gap.determined.items()}
    intervals = dict(fitted.intervals) or (known if gap.extended is None else {})
    values = {**fitted.values, **fitted.settings}
    shown = [key for key in values if key not in ZEROS]
    shown.sort(key=lambda key: key not in PLAIN)
    return quantities({key: values[key] for key in shown}, intervals)


def next_experiment(gap: Answer) -> str:
    """The run that would tell most, or nothing."""
    proposed = gap.next_experiment
    if not proposed:
        return ""
    if "text" in proposed:
        return str(proposed["text"])
    names = {"mass": "kg", "stiffness": "N/m", "surface_speed": "m/s", "hold": "s"}
    parts = [
        f"{key} = {proposed[key]:.4g} {unit}" for key, unit in names.items() if key in proposed
    ]
    return ", ".join(parts)


def closing_lines(gap: Answer, reproduced: Sequence[Reproduced] = ()) -> list[str]:
    """What is said at the end, on a terminal; the FMU's own runs where there were any."""
    lines = [f"{gap.campaign.name}: {verdict(gap)}", f"  gap        {gap_line(gap)}"]
    lines.append(f"  where      {gap.where.text}")
    numbers = fitted_quantities(gap)
    if numbers:
        lines.append(f"  numbers    {'; '.join(one.text for one in numbers)}")
    if reproduced:
        simulated = [f"{one.name} {one.gap:.3g} ({one.time[-1]:.3g} s)" for one in reproduced]
        lines.append(f"  fmu        gap in its runs' first segments: {', '.join(simulated)}")
    if gap.empirical:
        lines.append(f"  formula    {formula(gap)}")
    if gap.next_experiment:
        lines.append(f"  next       {next_experiment(gap)}")
    return lines


def formula(gap: Answer) -> str:
    """What is proposed where the catalogue has no name."""
    proposed = gap.empirical or {}
    return str(proposed.get("text") or proposed.get("formula") or proposed)
