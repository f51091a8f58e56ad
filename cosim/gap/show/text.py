"""The answer in sentences and lines."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from stickslip import EFFECTS

from cosim.gap.result import Exponent, Gap, Ranked, Score

from .quantities import Quantity, digits, quantity, with_digits

#: Of the measurement, not of the model.
FAULT = "measurement."
#: Held-out gap above which more than noise is left.
NOISE_LEFT = 1.1
SENTENCES = {entry.id: entry.sentence.rstrip(".") for entry in EFFECTS} | {
    "measurement.scale": "The camera's scale is off",
    "measurement.clock": "The camera's clock is off",
    "measurement.rotation": "The camera's axes are turned against the motion",
    "measurement.drift": "The camera's zero creeps during a run",
    "measurement.latency": "The time at which the camera sees the block depends on its place",
    "measurement.smoothing": "The tracker's filter rounds the motion",
    "measurement.quantisation": "The tracker writes steps that are coarser than its noise",
}


def faults_of(gap: Gap) -> tuple[str, ...]:
    """Measurement faults that were named."""
    return tuple(effect for effect in gap.effects if effect.startswith(FAULT))


def gap_line(before: Score, after: Score, is_the_same: bool = False) -> str:
    """`fitted runs 3.78 → 1.01, held-out runs 4.1 → 1.05`."""

    def pair(one: float | None, other: float | None) -> str:
        return digits(one) if is_the_same else f"{digits(one)} → {digits(other)}"

    said = f"fitted runs {pair(before.fit, after.fit)}"
    if before.held_out is None or after.held_out is None:
        return f"{said}; no run was held out"
    return f"{said}, held-out runs {pair(before.held_out, after.held_out)}"


def what_is_left(gap: Gap) -> str:
    """Of the gap after everything that was found, a sentence."""
    worst = max(gap.after.fit, gap.after.held_out or 0.0)
    if worst <= NOISE_LEFT:
        return "What is left is as large as the tracker's noise."
    which = "the fitted runs" if worst == gap.after.fit else "the held-out runs"
    return f"What is left in {which} is more than the tracker's noise explains."


def percent(part: float) -> str:
    """A part in percent; never all of it where some is left."""
    return "all" if part >= 0.9995 else f"{digits(100.0 * part)} %"


def probability(part: float) -> str:
    """No more certain than it is."""
    if part < 0.001:
        return "< 0.001"
    return "> 0.999" if part > 0.999 else f"{part:.3f}"


def evidence(value: float | None) -> str:
    """A logarithm: whole from 10 on; a dash for none."""
    if value is None:
        return "–"
    return (f"{value:.0f}" if abs(value) >= 10.0 else f"{value:.1f}").replace("-", "−")


def numbers_of(gap: Gap, row: Ranked, known: list[Quantity]) -> list[str]:
    """Of an effect that was tried; of one that was named those of the final model."""
    own = [one for one in known if one.key.startswith(row.effect)]
    if row.effect in gap.effects and own:
        return [one.text for one in own]
    return [
        quantity(
            key, value, row.intervals.get(key), "not determined" * (key in row.undetermined)
        ).text
        for key, value in row.parameters.items()
        if key.startswith((f"{row.effect}.", f"{row.effect}_")) or key == row.effect
    ]


def runner_up(gap: Gap) -> str:
    """The most probable effect that was not named; "" where none was tried."""
    others = [row for row in gap.ranking if row.effect not in gap.effects]
    if not others:
        return ""
    best = max(others, key=lambda row: row.evidence)
    return f"{best.effect}, probability {probability(best.probability)}"


def exponent_line(one: Exponent) -> str:
    """By which power an effect goes."""
    value, low, high = with_digits(one.value, one.low, one.high)
    return (
        f"{one.effect}: its force goes as the {one.quantity} to the power {value} "
        f"({low} to {high}); the law of the catalogue has {one.catalogue:.3g}"
    )


def scatter_line(scatter: tuple[float, float, float] | None) -> str:
    """Of friction from run to run; "" where there is nothing to tell by."""
    if scatter is None:
        return ""
    value, low, high = with_digits(*(100.0 * part for part in scatter))
    return f"Friction differs from run to run by {value} % ({low} to {high} %) of itself."


def rates_lines(gap: Gap) -> list[str]:
    """What else would have led to this answer, and how often."""
    rates = gap.rates
    if rates is None:
        return []
    said = gap.effects[0] if len(gap.effects) == 1 else gap.verdict
    return [
        f"If it were {truth}, these runs would say {said} {answers[said]} times in {rates.each}."
        for truth, answers in rates.table.items()
        if truth not in gap.effects and answers.get(said, 0) > 0
    ]


def next_experiment(proposed: Mapping[str, Any] | None) -> str:
    """The run that would tell most; "" for none."""
    if not proposed:
        return ""
    if "text" in proposed:
        return str(proposed["text"])
    names = {"mass": "kg", "stiffness": "N/m", "surface_speed": "m/s", "hold": "s"}
    return ", ".join(
        f"{key.replace('_', ' ')} {proposed[key]:.4g} {unit}"
        for key, unit in names.items()
        if key in proposed
    )


def assumptions(gap: Gap) -> list[str]:
    """What was taken as the campaign states it."""
    campaign = gap.campaign
    errors = campaign.errors
    noise = ", ".join(
        f"{channel} {quantity_of_noise(channel, value)}"
        f" ({'from the data' if channel in campaign.noise_estimated else 'as stated'})"
        for channel, value in campaign.noise.items()
    )
    lines = [
        "masses, geometry and springs' lengths of the rig, exactly as stated",
        f"stiffness of the springs, as stated within {100.0 * errors.stiffness:.3g} %",
        f"surface speeds, as stated within {100.0 * errors.surface_speed:.3g} %",
        f"noise of a sample: {noise}",
    ]
    fitted = {label.partition("@")[0] for label in gap.extended.values}
    kept = {
        key: value
        for run in gap.extended.runs
        for key, value in run.values.items()
        if key not in fitted and not key.startswith("friction.table_")
    }
    lines += [f"{quantity(key, value, None).text}, set, not fitted" for key, value in kept.items()]
    if campaign.friction_table is not None:
        lines.append(campaign.friction_table.text)
    return lines


def quantity_of_noise(channel: str, value: float) -> str:
    """A standard deviation in the unit that a tracker is thought of in."""
    unit = {"phi": "mrad", "force": "N"}.get(channel, "mm")
    return f"{value if unit == 'N' else 1e3 * value:.3g} {unit}"


def closing_lines(gap: Gap) -> list[str]:
    """What a terminal says at the end."""
    nothing_added = len(gap.ladder) == 1
    lines = [
        f"{gap.campaign.name}: {gap.verdict}",
        f"  {gap.sentence}",
        f"  gap        {gap_line(gap.before, gap.after, nothing_added)} (1 is noise)",
    ]
    lines += [f"  doubt      {doubt.text}" for doubt in gap.doubts]
    if runner_up(gap):
        lines.append(f"  runner-up  {runner_up(gap)}")
    if gap.next_experiment:
        lines.append(f"  next       {next_experiment(gap.next_experiment)}")
    return lines
