"""The answer in sentences."""

from __future__ import annotations

from collections.abc import Sequence

from stickslip import EFFECTS

from cosim.gap.camera import faults
from cosim.gap.doubts.doubt import not_looked, rounded, unbelieved
from cosim.gap.result import Gap, Power
from cosim.studies.reproduction.summary import SummaryGap

from .quantities import PLAIN, Quantity, quantities
from .reproduced import Reproduced

#: Of the tracker; said where everything is.
ZEROS = ("offset.x", "offset.y")
#: Points of a curve; a figure shows them.
TABLES = "friction.table_"
Answer = Gap | SummaryGap
SENTENCES = {entry.id: entry.sentence.rstrip(".") for entry in EFFECTS} | faults.SENTENCES


def verdict(gap: Answer) -> str:
    """The verdict and what it rests on."""
    return f"{gap.verdict.capitalize()}: {reason(gap)}"


def reason(gap: Answer) -> str:
    """What the verdict's word stands for here, one sentence."""
    if isinstance(gap, Gap) and not gap.believed:
        return _not_believed(gap)
    if isinstance(gap, Gap) and gap.verdict == "partial":
        return _partial(gap)
    if gap.verdict == "none":
        return "the plain model, its numbers fitted, leaves only noise."
    if gap.verdict == "named":
        return f"{' and '.join(map(described, gap.effects))}."
    return _class(gap) if gap.verdict == "class" else _unknown(gap)


def _not_believed(gap: Gap) -> str:
    """Whatever was found is not believed, for the first doubt that forbids it."""
    first, *more = unbelieved(gap.doubts, ())
    others = f" (and {len(more)} more doubts)" if len(more) > 1 else ""
    return f"these data cannot tell. {first.text}{others or (' (and another doubt)' * len(more))}."


def held_out(gap: Answer, value: float | None) -> float | None:
    """A held-out gap; None where nothing was held out: it would be that of the fit."""
    return None if isinstance(gap, Gap) and not gap.has_held_out else value


def bound_lines(gap: Answer) -> list[str]:
    """Numbers of the shown model that are at their bounds."""
    if isinstance(gap, SummaryGap):
        return []
    return [
        f"{key} is at its bound, {bound:.4g}: the fit would turn it further, and its value is the "
        "bound's, not the data's"
        for key, bound in gap.model.at_bound.items()
    ]


def described(effect: str) -> str:
    """An effect's id with what it adds."""
    return f"{effect} ({SENTENCES[effect][0].lower()}{SENTENCES[effect][1:]})"


def _class(gap: Answer) -> str:
    groups = [" or ".join(group) for group in gap.classes]
    alone = [e for e in gap.effects if not any(e in group for group in gap.classes)]
    beside = f", beside {' and '.join(alone)}" if alone else ""
    return f"{'; '.join(groups)}{beside}; these data cannot tell which."


def _partial(gap: Gap) -> str:
    takes = "takes" if len(gap.effects) == 1 else "together take"
    left = f"; what remains needs {'; '.join(gap.reasons)}" if gap.reasons else ""
    return (
        f"{' and '.join(gap.effects)} {takes} {percent(gap.share)} of the misfit and "
        f"{'helps' if len(gap.effects) == 1 else 'help'} in every run{left}."
    )


def _unknown(gap: Answer) -> str:
    if isinstance(gap, Gap):
        return _unknown_of_runs(gap)
    if gap.effects:
        return (
            f"with {' and '.join(gap.effects)} the model comes nearer, but a disagreement "
            "is left that no catalogued effect repairs."
        )
    return "the plain model does not fit, and no catalogued effect repairs it."


def _unknown_of_runs(gap: Gap) -> str:
    first, nearest = (gap.ladder[0], gap.ladder[-1]) if gap.ladder else (None, None)
    said = "the plain model does not fit, and no catalogued effect repairs it"
    # what helps in short segments alone is not near
    if first and nearest and nearest.effects and nearest.fit_gap < first.fit_gap:
        names = " and ".join(nearest.effects)
        said += f"; {names} would take {percent(nearest.share)} of the misfit"
    elif gap.reasons:
        said += "; it would fit better"
    return f"{said}{', with ' + '; '.join(gap.reasons) if gap.reasons else ''}."


def percent(part: float) -> str:
    """A part in percent; never more than all of it, nor all of it where some is left."""
    return "all" if part >= 0.9995 else f"{100.0 * part:.3g} %"


def probability(part: float | None) -> str:
    """A probability, no more certain than it is; a dash for none."""
    if part is None:
        return "–"
    if part < 0.001:
        return "< 0.001"
    return "> 0.999" if part > 0.999 else f"{part:.3f}"


def sentence(text: str) -> str:
    """With a capital and a full stop."""
    return f"{text[0].upper()}{text[1:]}."


def gap_line(gap: Answer) -> str:
    """Before and after, held out and fit."""
    figures = isinstance(gap, SummaryGap)
    unit = "standard deviations" if figures else "noise units"
    one = "what the observations leave open" if figures else "measurement noise"
    (fit, held), (fit_after, held_after) = gap.gap_before, gap.gap_after
    if isinstance(gap, Gap) and not gap.has_held_out:
        return f"nothing was held out; fit {fit:.3g} → {fit_after:.3g} {unit} (1 is {one})"
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
    shown = [key for key in values if key not in ZEROS and not key.startswith(TABLES)]
    shown.sort(key=lambda key: key not in PLAIN)
    return quantities(
        {key: values[key] for key in shown}, intervals, undetermined=fitted.undetermined
    )


def spreads_line(gap: Gap) -> str:
    """What differs by itself, which no effect explains; "" where nothing was estimated."""
    names = {
        "friction_from_run_to_run": "friction from run to run",
        "friction_within_a_run": "friction from stretch to stretch of a run",
        "static_friction_beside_it": "static friction beside that",
        "surface_speed": "surface speed from run to run",
    }
    parts = [f"{names[key]} {100.0 * value:.2g} %" for key, value in gap.spreads.items()]
    return ", ".join(parts)


def powers_lines(gap: Gap) -> list[str]:
    """How strengths go with mass, speed and stiffness, of those that do."""
    return [_power(one) for one in gap.powers if one.stated]


#: Quantity -> what a strength is for each of.
_EACH = {"mass": "kilogram", "speed": "metre per second", "stiffness": "newton per metre"}


def _power(one: Power) -> str:
    low, high = one.low, one.high
    said = (
        f"its strength goes with {one.quantity}^{one.value:.2g}"
        f" (90 % interval {low:.2g} to {high:.2g})"
    )
    if low <= -1.0 <= high:
        said = f"per {_EACH[one.quantity]}: {said}"
    elif low <= 1.0 <= high:
        said = f"in proportion to {one.quantity}: {said}"
    other = f"; these runs cannot tell {one.quantity} from {' or '.join(one.instead)}"
    return f"{one.effect}, {said}{other if one.instead else ''}"


def faults_of(gap: Answer) -> tuple[str, ...]:
    """Faults of the measurement that were named, alone or beside effects."""
    members = {effect for group in gap.classes for effect in group}
    return tuple(e for e in gap.effects if faults.is_fault(e) and e not in members)


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
    lines += [f"  doubt      {doubt.text}" for doubt in gap.doubts] if isinstance(gap, Gap) else []
    lines.append(f"  where      {gap.where.text}")
    if isinstance(gap, Gap):
        lines += _of_runs(gap)
    numbers = fitted_quantities(gap)
    if numbers:
        how = "; of a model that does not fit" if gap.verdict == "unknown" else ""
        how = f" (in brackets: 95 % intervals{how})"
        lines.append(f"  numbers    {'; '.join(one.line for one in numbers)}{how}")
    lines += [f"  bound      {line}" for line in bound_lines(gap)]
    if reproduced:
        lines.append(f"  fmu        {'; '.join(map(flight, reproduced))}")
    if gap.empirical:
        lines.append(f"  formula    {formula(gap)}")
    if gap.next_experiment:
        lines.append(f"  next       {next_experiment(gap)}")
    return lines


def _of_runs(gap: Gap) -> list[str]:
    """What only runs with a time series tell."""
    lines = []
    if gap.remains and gap.verdict == "partial":
        lines.append(f"  remains    {gap.remains.text}")
    if not gap.searched:
        lines.append(f"  search     {not_looked(gap.doubts)}")
    lines += [f"  ladder     {line}" for line in ladder_lines(gap)]
    lines += [f"  scaling    {line}" for line in powers_lines(gap)]
    if any(law.in_model for law in gap.laws):
        lines.append(f"  curve      {TABLE_SENTENCE}")
    if gap.spreads:
        lines.append(f"  spreads    {spreads_line(gap)}")
    return lines + [f"  lacks      {line}" for line in gap.lacks]


def flight(one: Reproduced) -> str:
    """What the FMU did of a run, from its start on."""
    whole = f", {one.whole:.3g} over all {one.time[-1]:.3g} s" if one.first < one.time.size else ""
    return (
        f"{one.name}, from one initial state: gap {one.gap:.3g} in its first "
        f"{one.time[one.first - 1]:.2g} s{whole}"
    )


#: Of a curve that is in the model.
TABLE_SENTENCE = (
    "friction over the sliding speed is in the model as a table: a shape that no law of the "
    "catalogue has"
)


def ladder_lines(gap: Gap) -> list[str]:
    """A line for each step over the plain model."""
    return [
        f"{' + '.join(step.effects)}: evidence {rounded(step.gain)}, {percent(step.share)} of the "
        f"misfit; {f'held out {step.held_out_gap:.3g}, ' * gap.has_held_out}fit {step.fit_gap:.3g}"
        for step in gap.ladder
        if step.effects
    ]


def formula(gap: Answer) -> str:
    """What is proposed where the catalogue has no name."""
    proposed = gap.empirical or {}
    return str(proposed.get("text") or proposed.get("formula") or proposed)
