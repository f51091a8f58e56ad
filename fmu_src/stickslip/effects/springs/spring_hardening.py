"""Springs stiffen with their extension, or with its change since then: a cubic or quintic term.

The force of a spring of extension e is k e + k_3 (e - e_n)^3 + k_5 (e - e_n)^5: the odd terms of a
force that is its own mirror image. The quintic one stays small for long and then bends sharply.
"""

from collections.abc import Iterator

from ...quantity import Table, quantity
from ..effect import Candidate, Case, Effect, FormsOf, Scales


class SpringHardening(Table):
    """Springs stiffen with their extension, or with its change since then.

    cubic : k_3 of the spring force k e + k_3 (e - e_n)^3
    neutral_extension : extension e_n at which these terms vanish: 0, or as installed
    quintic : k_5 of the spring force's term k_5 (e - e_n)^5
    """

    cubic: float = quantity(0.0, "N/m3", ge=0, typical=(500.0, 5e4))
    neutral_extension: float = quantity(0.0, "m", ge=0, tried=(0.0, 0.03))
    quintic: float = quantity(0.0, "N/m5", ge=0, typical=(1e5, 1e8))


def spring_force(extension: float, cubic: float, neutral_extension: float, quintic: float) -> float:
    """What one spring pulls with besides, N."""
    change = extension - neutral_extension
    force = cubic * change * change * change
    if quintic != 0.0:
        square = change * change
        force += quintic * square * square * change
    return force


def spring_energy(
    extension: float, cubic: float, neutral_extension: float, quintic: float
) -> float:
    """The integral of `spring_force`, J."""
    change = extension - neutral_extension
    square = change * change
    energy = 0.25 * cubic * square * square
    if quintic != 0.0:
        energy += quintic * square * square * square / 6.0
    return energy


own = FormsOf("spring_hardening")


def candidates(s: Scales) -> Iterator[Candidate]:
    """Either term in the extension, or in its change since the spring was installed."""
    for name, degree in (("cubic", 3), ("quintic", 5)):
        much = 0.1 * s.stiffness / s.travel ** (degree - 1)
        term = own.free(name, much, much, 0.0, 1e4 * much)
        yield own.form(name, term)
        if s.extension != 0.0:  # as found by pulling at the block in its place
            yield own.form(f"{name} as installed", term, neutral_extension=s.extension)


EFFECT = Effect(
    id="spring_hardening",
    table=SpringHardening,
    switch=("cubic", "quintic"),
    enters="springs",
    axis="position",
    source="the source study: springs stiffen beyond a few centimetres",
    terms=(spring_force, spring_energy),
    candidates=candidates,
    case=Case({"cubic": 3e4}),
)
