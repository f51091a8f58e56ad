"""A doubt about a campaign, and whether an answer can stand beside it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from scipy import stats

#: Chance that a campaign which is as stated is doubted, all runs of one check together.
LEVEL = 1e-3


@dataclass(frozen=True)
class Doubt:
    """One figure of a campaign that is not what it should be.

    Attributes
    ----------
    check : sampling, direction, stick_speed, springs, force, record, runs or noise
    run : its name, several with commas between them; "" for the campaign
    figure, expected, unit : what was found, what would be expected (of a limit: the limit)
    text : the same as a line
    decisive : that no answer is believed beside it, unless it holds one of ``explained_by``
    explained_by : effects and faults of the measurement that make such a figure themselves
    """

    check: str
    run: str
    figure: float
    expected: float
    unit: str
    text: str
    decisive: bool = False
    explained_by: tuple[str, ...] = ()


def unbelieved(doubts: Sequence[Doubt], effects: Sequence[str]) -> tuple[Doubt, ...]:
    """The doubts for which an answer with these effects is not believed."""
    return tuple(
        doubt for doubt in doubts if doubt.decisive and not set(doubt.explained_by) & set(effects)
    )


def hopeless(doubts: Sequence[Doubt]) -> tuple[Doubt, ...]:
    """The doubts beside which no answer can be believed, whatever is found."""
    return tuple(doubt for doubt in doubts if doubt.decisive and not doubt.explained_by)


def not_looked(doubts: Sequence[Doubt]) -> str:
    """Why no effect was looked for."""
    checks = ", ".join(dict.fromkeys(doubt.check for doubt in hopeless(doubts)))
    return (
        f"no effect was looked for: nothing that could be found explains the doubt ({checks}), and "
        "nothing would be believed beside it"
    )


def far(count: int) -> float:
    """Standard deviations, either way, that one of ``count`` figures exceeds in `LEVEL` of cases.

    >>> round(far(1), 2), round(far(6), 2)
    (3.29, 3.76)
    """
    return float(stats.norm.isf(0.5 * LEVEL / max(count, 1)))


def listed(names: Sequence[str]) -> str:
    """Names with commas between them."""
    return ", ".join(names)


def rounded(value: float, digits: int = 3) -> str:
    """Of so many digits, without an exponent for what a reader meets every day.

    >>> rounded(0.0123456), rounded(12345.6)
    ('0.0123', '12300')
    """
    if value == 0.0 or not math.isfinite(value):
        return f"{value:g}"
    places = digits - 1 - math.floor(math.log10(abs(value)))
    return (
        f"{round(value, places):.{max(places, 0)}f}" if abs(places) < 8 else f"{value:.{digits}g}"
    )
