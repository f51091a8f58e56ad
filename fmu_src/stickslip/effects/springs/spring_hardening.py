"""Springs stiffen with their extension, or with its change since then: a cubic term.

The force of a spring of extension e is k e + k_3 (e - e_n)^3.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...quantity import Table, quantity
from ..candidate import Candidate, FreeParameter, Scales
from ..effect import Case, Effect


class SpringHardening(Table):
    """Springs stiffen with their extension, or with its change since then: a cubic term."""

    cubic: float = quantity(
        0.0, "N/m3", "k_3 of the spring force k e + k_3 (e - e_n)^3", ge=0, typical=(500.0, 5e4)
    )
    neutral_extension: float = quantity(
        0.0,
        "m",
        "extension e_n at which the cubic term vanishes: 0, or as installed",
        ge=0,
        tried=(0.0, 0.03),
    )


def spring_force(extension: float, cubic: float, neutral_extension: float) -> float:
    """What one spring pulls with besides, N."""
    change = extension - neutral_extension
    return cubic * change * change * change


def spring_energy(extension: float, cubic: float, neutral_extension: float) -> float:
    """The integral of `spring_force`, J."""
    change = extension - neutral_extension
    square = change * change
    return 0.25 * cubic * square * square


def candidates(s: Scales) -> Iterator[Candidate]:
    """Cubic in the extension, or in its change since the spring was installed."""
    much = 0.1 * s.stiffness / s.travel**2
    cubic = FreeParameter("spring_hardening.cubic", much, much, 0.0, 1e4 * much)
    yield Candidate("spring_hardening", "cubic", (cubic,))
    if s.extension != 0.0:  # as found by pulling at the block in its place
        yield Candidate(
            "spring_hardening",
            "cubic as installed",
            (cubic,),
            {"spring_hardening.neutral_extension": s.extension},
        )


EFFECT = Effect(
    id="spring_hardening",
    table=SpringHardening,
    switch=("cubic",),
    enters="springs",
    source="the source study: springs stiffen beyond a few centimetres",
    terms=(spring_force, spring_energy),
    candidates=candidates,
    case=Case({"cubic": 3e4}),
)
