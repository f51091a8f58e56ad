"""Kinetic friction falls once the contact slides faster than an onset speed.

    mu_k (1 - c v^2 / (v^2 + v_o^2))

A law to begin with: give it its name, its formula and its source, then try it. This text is what
`stickslip effects` prints: the first line says what the effect does, indented lines are formulas.
"""

from collections.abc import Iterator

from stickslip.effects import Candidate, Case, Effect, FreeParameter, Scales, Table, quantity


class Template(Table):
    """Kinetic friction falls once the contact slides faster than an onset speed."""

    # Each parameter: default, unit, words, bounds (gt, ge, lt, le). They are keys of a scenario's
    # table and parameters of the FMU. A switch is off at 0; `typical`: sizes of it that show.
    fall: float = quantity(
        0.0, "1", "c, part of mu_k that is lost at high speed", ge=0, le=1, typical=(0.05, 0.5)
    )
    # `tried`: from where tests draw what has no size of its own.
    onset: float = quantity(
        0.05, "m/s", "v_o, at which half of it is lost", gt=0, tried=(0.01, 0.3)
    )


# A term: its name is the place where it enters (dry_factor: mu_k of the dry contact in proportion,
# at a local sliding speed). It takes by name the parameters above, and what the place knows: here
# `speed`. Floats in, a float out, `from math import ...` only: it becomes C and machine code too.
def dry_factor(speed: float, fall: float, onset: float) -> float:
    """mu_k at a local sliding speed over its value at rest."""
    return 1.0 - fall * speed * speed / (speed * speed + onset * onset)


# What `stickslip gap` may turn to find the law in measurements: where each number starts, a step
# that is felt but small, and the range. `s` says what is typical of the campaign (s.speed, m/s).
def candidates(s: Scales) -> Iterator[Candidate]:
    """One start; the onset on a logarithmic scale."""
    fall = FreeParameter("template.fall", 0.2, 0.1, 0.0, 1.0)
    onset = FreeParameter("template.onset", s.speed, 0.3, 0.1 * s.speed, 10.0 * s.speed, log=True)
    yield Candidate("template", "smooth step", (fall, onset))


EFFECT = Effect(
    id="template",  # name of the scenario's table, and what gap calls it
    table=Template,
    switch=("fall",),  # the parameters any of which turns it on
    enters="friction",  # friction, springs, surface or contact, for the reader
    axis="sliding speed",  # over what it is a curve
    source="nobody yet: who derived or measured the law, where",
    terms=(dry_factor,),
    candidates=candidates,
    case=Case({"fall": 0.3, "onset": 0.05}),  # a size that shows on its page
)
