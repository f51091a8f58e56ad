"""Every answer that is not right, with what was hidden and what was tried: for whoever mends it."""

from __future__ import annotations

import json
from collections.abc import Sequence

from .answers import Row
from .exponents import exponents_are_near, exponents_stated
from .outcome import gap, is_right, outcome, verdict

FIRST = 3  # of the ranking


def number(value: float | None) -> str:
    """Three digits, or a dash."""
    return "–" if value is None else f"{value:.3g}"


def truth_lines(row: Row) -> list[str]:
    """What is true, with its text and its size."""
    truth = row.truth
    lines = [
        f"- hidden: **{each['name']}**, {each['shape']}; size {each['size']['size']:.1f} noise "
        f"units, strength {each['strength']:.3g}; {each['law']}"
        for each in truth.hidden
    ]
    if not truth.hidden:
        names = ", ".join(sorted(truth.effects or truth.members)) or truth.kind or "nothing"
        lines.append(f"- hidden: **{names}**")
    if truth.exponents:
        lines.append(f"- exponents: {dict(truth.exponents)}")
    if truth.contact:
        numbers = ", ".join(
            f"{key} {value:.3g}" for key, value in truth.contact.items() if key != "form"
        )
        lines.append(f"- contact {truth.contact['form']}: {numbers}; scatter {truth.scatter}")
    return lines


def answer_lines(row: Row) -> list[str]:
    """What was said of it."""
    if row.found is None:
        return [f"- no answer: {row.error}"]
    said = f"- said: **{verdict(row)}** {', '.join(row.found['effects'])}"
    gaps = ", ".join(
        f"{part} {number(gap(row, 'before', part))} → {number(gap(row, 'after', part))}"
        for part in ("fit", "held_out")
    )
    lines = [said, f"- gap {gaps.replace('held_out', 'held out')}; {row.seconds:.0f} s"]
    for place, each in enumerate(row.found.get("ranking", [])[:FIRST], 1):
        numbers = ", ".join(f"{key} {number(v)}" for key, v in each["parameters"].items())
        lines.append(
            f"- {place}. {each['effect']} ({each['form']}): held out "
            f"{number(each['held_out_gap'])}, fit {number(each['fit_gap'])}, "
            f"dBIC {number(each['delta_bic'])}; {numbers}"
        )
    ranked = [each["effect"] for each in row.found.get("ranking", [])]
    for name in sorted(row.truth.effects - set(ranked[:FIRST])):
        place = f"place {ranked.index(name) + 1}" if name in ranked else "not in the ranking"
        lines.append(f"- {name}: {place}")
    if row.found.get("share") is not None:
        lines.append(f"- share of the misfit that is taken: {number(row.found['share'])}")
    lines += [f"- ladder: {json.dumps(step)}" for step in row.found.get("ladder") or ()]
    if exponents_stated(row):
        lines.append(f"- exponents stated: {exponents_stated(row)}")
    if row.found.get("remarks"):
        lines.append("- remarks: " + "; ".join(row.found["remarks"]))
    return lines


def is_listed(row: Row) -> bool:
    """Wrong, or right with a wrong power."""
    return not is_right(row) or bool(row.truth.exponents) and not exponents_are_near(row)


def listing(rows: Sequence[Row]) -> str:
    """A chapter for every one of them."""
    listed = [row for row in rows if is_listed(row)]
    parts = [f"# {len(listed)} of {len(rows)} campaigns not answered right\n"]
    for row in listed:
        lines = [*truth_lines(row), *answer_lines(row)]
        parts.append(f"## {row.suite} {row.name}: {outcome(row)}\n" + "\n".join(lines) + "\n")
    return "\n".join(parts)
