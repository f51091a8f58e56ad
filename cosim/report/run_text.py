"""What is said of a run, from the numbers of its summary: `run.txt.j2`, with what that asks for.

At the top of its page, on stability and regimes, beyond its bounds, and on the terminal at its end.
"""

import math
from collections.abc import Mapping
from functools import cache, partial
from pathlib import Path
from typing import Any

from stickslip.steady_motion.regimes import ASIDE_ANGLE_DEG as ASIDE_ANGLE_DEG
from stickslip.steady_motion.regimes import ASIDE_LENGTH as ASIDE_LENGTH

from cosim.scenario.durations import in_words

from .bounds import LEDGER_LIMIT as LEDGER_LIMIT
from .bounds import is_believed as is_believed
from .files import results_line
from .material import ICE, of_material
from .page import sentences, texts, tiles_of
from .quantities import FOUND_RISE, ROUNDING, TABLES, digits
from .quantities import told as told

Numbers = Mapping[str, Any]
#: What a summary calls a motion from which the block is not disturbed.
ALONG = "along the line"
#: Multipliers that differ by less than this part are told as one.
ALIKE = 0.02
#: Of a number: a rig whose border is further off than this is well inside.
WELL_INSIDE = 1.0 / 3.0
#: A tenth of a millimetre, which every rig is off by, times this is a centimetre.
MUCH = 100.0
#: Regime -> what the block does in it.
REGIMES: dict[str, str] = TABLES["regimes"]
#: Start -> its words, the most usual first.
STARTS: dict[str, str] = TABLES["starts"]


@cache
def macros() -> Any:
    """The macros of `run.txt.j2`."""
    return texts("run.txt.j2", __package__ or "", globals())


def headline(numbers: Numbers) -> str:
    """Whether the block sticks and slips, and how warm its interface gets."""
    return in_a_line(macros().headline(numbers))


def tiles(numbers: Numbers) -> list[tuple[str, str]]:
    """Words and figures, four at most; none where no row was computed."""
    return tiles_of(macros().tiles(numbers))


def stability_sentence(numbers: Numbers) -> str:
    """Whether a rig could make the motion."""
    return in_a_line(macros().stability(numbers))


def regime_sentence(numbers: Numbers) -> str:
    """Which regime the run is in, how many starts lead to it, and what exists beside it."""
    return in_a_line(macros().regimes(numbers))


def border_sentence(numbers: Numbers) -> str:
    """How little of its numbers would have to differ for the rig to do something else."""
    return in_a_line(macros().border(numbers))


def bounds_sentences(numbers: Numbers) -> list[str]:
    """What a run does that its rig could not, or its ledger does not hold, a sentence each."""
    return sentences(macros().bounds(numbers))


def closing_lines(
    numbers: Numbers, folder: Path, wall_time: float, material: str = ICE
) -> list[str]:
    """A few lines for whoever waited. material: of the block."""
    said = macros().closing(numbers, wall_time, partial(of_material, material=material))
    return [*said.strip("\n").split("\n"), results_line(folder)]


def in_a_line(text: str) -> str:
    """A text of the template without its breaks."""
    return " ".join(sentences(text))


def near_borders(numbers: Numbers) -> dict[str, list[Mapping[str, Any]]]:
    """What the rig does beyond a border within `WELL_INSIDE` -> all such borders."""
    near: dict[str, list[Mapping[str, Any]]] = {}
    for one in numbers["nearest_borders"] or ():
        if one["margin"] is not None and one["margin"] < WELL_INSIDE:
            where = ", aside of its line or turned" if one["aside"] else ""
            does = REGIMES.get(one["beyond"], "cannot be followed") + where
            near.setdefault(does, []).append(one)
    return near


def starts_to(groups: Mapping[str, str | None], regime: str | None) -> list[str]:
    """Words of the starts that lead to a regime, named by a start; None: to none in the time."""
    return [STARTS[one] for one in STARTS if one in groups and groups[one] == regime]


def span(seconds: float) -> str:
    """A time of some hours in seconds, a longer one in words."""
    return f"{float(f'{seconds:.2g}'):g} s" if seconds < 7200.0 else in_words(seconds)


def degrees(value: float, rise: float) -> str:
    """A temperature with the decimals of a rise of two digits, which is known to no more."""
    decimals = 1 - math.floor(math.log10(abs(rise))) if abs(rise) >= ROUNDING["K"] else 1
    return f"{value:z.{min(max(decimals, 0), 4)}f}"


def signed(rise: float) -> str:
    """A rise with its sign and two digits; 0, and what is but rounding, has none."""
    if abs(rise) < ROUNDING["K"]:
        return "0"
    return f"{'-' if rise < 0.0 else '+'}{digits(abs(rise), FOUND_RISE)}"
