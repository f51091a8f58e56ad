"""The answer in sentences and lines."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product

from stickslip.catalogue import Catalogue

from cosim.gap.judge import NOTHING_MISSING
from cosim.gap.quantities import TABLES, Quantity, digits, quantity
from cosim.gap.quantities import percent as percent
from cosim.gap.rates import NONE, answer_text
from cosim.gap.result import Gap, Ranked

#: Beginning of a measurement fault's name.
FAULT = "measurement."
#: Settings that are points of a curve, of the fit's own, or said elsewhere.
UNSAID = (TABLES, FAULT, "with_", "per_weight.", "springs.force_curve", "scatter.")
#: Channel -> how its noise is written, from SI and from thousandths.
NOISE_OF = {
    "x": "x: {1:.3g} mm", "y": "y: {1:.3g} mm", "phi": "φ: {1:.3g} mrad",
    "force": "a force: {0:.3g} N",
}  # fmt: skip


def faults_of(gap: Gap) -> list[str]:
    """Measurement faults that were named."""
    return [effect for effect in gap.effects if effect.startswith(FAULT)]


def gap_line(gap: Gap) -> str:
    """`5 fitted runs 3.78 → 1.01, 2 held-out runs 4.1 → 1.05`."""
    rungs = gap.ladder[:: max(len(gap.ladder) - 1, 1)]
    held_out = sum(run.hold_out for run in gap.plain.runs)
    said = [
        f"{count} {which} run{'s' * (count != 1)} {' → '.join(map(digits, values))}"
        for count, which, values in (
            (len(gap.plain.runs) - held_out, "fitted", [rung.gap.fit for rung in rungs]),
            (held_out, "held-out", [rung.gap.held_out for rung in rungs]),
        )
        if count
    ]
    return ", ".join(said) if held_out else f"{said[0]}; no run was held out"


def noise_of(noise: Mapping[str, float]) -> str:
    """`x: 0.3 mm, φ: 2 mrad`."""
    return ", ".join(
        NOISE_OF[channel].format(value, 1e3 * value) for channel, value in noise.items()
    )


def what_is_left(gap: Gap) -> str:
    """Of the gap after everything that was found, a sentence."""
    held_out = gap.after.held_out or 0.0
    if max(gap.after.fit, held_out) <= NOTHING_MISSING:
        return "What is left is as large as the tracker's noise."
    which = "held-out" if held_out > gap.after.fit else "fitted"
    return f"What is left in the {which} runs is more than the tracker's noise explains."


def probability(part: float) -> str:
    """No more certain than it is."""
    if 0.001 <= part <= 0.999:
        return f"{part:.3f}"
    return "< 0.001" if part < 0.5 else "> 0.999"


def evidence(value: float | None) -> str:
    """A logarithm: whole from 10 on; a dash for none."""
    if value is None:
        return "–"
    return (f"{value:.0f}" if abs(value) >= 10.0 else f"{value:.1f}").replace("-", "−")


def numbers_of(row: Ranked, known: Sequence[Quantity], catalogue: Catalogue) -> list[str]:
    """Of an effect that was tried; of one in the final model those of that."""
    own = [one.text for one in known if one.key.startswith(row.effect) and not one.owner]
    return own or [
        quantity(key, value, row.intervals.get(key), "not determined" * (key in row.undetermined),
                 catalogue).text
        for key, value in row.parameters.items()
        if key.startswith(row.effect)
    ]  # fmt: skip


def runner_up(gap: Gap) -> str:
    """The most probable effect that was not named; "" where none was tried."""
    others = [row for row in gap.ranking if row.effect not in gap.effects]
    best = max(others, key=lambda row: row.evidence, default=None)
    return f"{best.effect}, probability {probability(best.probability)}" if best else ""


def rates_lines(gap: Gap) -> list[str]:
    """What else would have led to this answer, and how often."""
    is_class = gap.verdict == "class"
    names = [answer_text(gap.effects)] if is_class else gap.effects or [gap.verdict]
    lines = []
    for said, (truth, answers) in product(names, gap.rates.table.items() if gap.rates else ()):
        if gap.rates and truth not in gap.effects and answers.get(said, 0) > 0:
            were = "nothing were missing" if truth == NONE else f"it were {truth}"
            times = f"{answers[said]} times in {gap.rates.each}"
            lines.append(f"If {were}, these runs would say {said} {times}.")
    return lines


def assumptions(gap: Gap) -> list[str]:
    """What was taken as the campaign states it."""
    campaign, errors = gap.campaign, gap.campaign.errors
    fitted = {label.partition("@")[0] for label in gap.extended.values}
    kept = {key: value for run in gap.extended.runs for key, value in run.values.items()}
    kept = {k: v for k, v in kept.items() if k not in fitted and not k.startswith(UNSAID)}
    estimated = campaign.noise_estimated
    return [
        "masses and geometry of the rig, exactly as stated",
        "no damping and no effect, but what is said here",
        f"stiffness of the springs, as stated within {100.0 * errors.stiffness:.3g} %",
        f"surface speeds, as stated within {100.0 * errors.surface_speed:.3g} %",
        *(
            f"noise of {noise_of({channel: value})}, "
            f"{'from the data' if channel in estimated else 'as stated'}"
            for channel, value in campaign.noise.items()
        ),
        *(quantity(*one, None, catalogue=campaign.catalogue).text for one in kept.items()),
        *([campaign.friction_table.text] if campaign.friction_table else []),
    ]


def closing_lines(gap: Gap) -> list[str]:
    """What a terminal says at the end."""
    lines = [f"{gap.campaign.name}: {gap.verdict}", f"  {gap.sentence}"]
    other = "runner-up" if gap.effects or gap.verdict == "none" else "nearest"
    said = {
        "gap": f"{gap_line(gap)} (1 is noise)",
        other: runner_up(gap),
        "next": gap.next_experiment["text"] if gap.next_experiment else "",
    }
    lines += [f"  {word:<10} {text}" for word, text in said.items() if text]
    return lines + [f"  doubt      {doubt.text}" for doubt in gap.doubts]
