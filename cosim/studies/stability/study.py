"""What `stickslip stability` finds of a rig, as one result.

And in which range of one number it sticks and slips: from rest, riding, and from a speed ramp.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from itertools import groupby, pairwise
from pathlib import Path
from typing import Any

import numpy as np
from stickslip.steady_motion import borders as rig
from stickslip.steady_motion.borders import COUNT, FARTHEST, all_borders, follower
from stickslip.steady_motion.regimes import STICK_SLIP
from stickslip.steady_motion.starts import RAMP, REST, STARTS, disturbed, other_starts

from ...report.files import plain_data, write_json
from ...report.page import PageResult, Picture, render, sentences, texts, tiles_of
from ...report.run_text import border_sentence, regime_sentence, stability_sentence
from ...scenario import Scenario, as_scenario
from . import maps
from .maps import MAPPED, Case, NotAMotion, PretensionMap, RegimeMap, run_length

#: From one value to another; None is beyond what was searched.
Window = tuple[float | None, float | None]
#: What the command line calls the numbers of `borders.numbers_of`.
NUMBERS = {
    "speed": rig.SPEED,
    "ramp": rig.RAMP,
    "damping": rig.DAMPING,
    "pretension": rig.PRETENSION,
    "ratio": rig.RATIO,
}


def stick_slip_range(
    case: Case, word: str, look: Callable[[], object] = lambda: None
) -> dict[str, Any]:
    """``key``, ``unit``, ``value``, ``searched`` (two values), ``ramp`` (s) and ``stick_slip``.

    The last is start -> windows (from, to) in which the block sticks and slips, the scenario's own
    start first; None is beyond what was searched. Every border of such a window is bisected to a
    ten-thousandth. word: of `NUMBERS`. NotAMotion for a number that the rig does not have. look:
    called after each step.
    """
    known = {number.key: number for number in rig.numbers_of(case.parameters)}
    if NUMBERS[word] not in known:
        has = ", ".join(name for name, key in NUMBERS.items() if key in known)
        raise NotAMotion(f"{case.name}: --border {word}: this rig has none; allowed is {has}")
    number = known[NUMBERS[word]]
    starts = other_starts(case.parameters)
    windows = {}
    has_ramp = case.parameters.surface.run_up_time > 0.0
    first = sorted(MAPPED, key=lambda start: start != (RAMP if has_ramp else REST))
    for start in (RAMP,) if number.key == rig.RAMP else first:
        parameters = disturbed(starts[start])
        duration = run_length(parameters)
        borders = all_borders(parameters, number, duration, case.interface, look)
        steady = duration - parameters.surface.run_up_time
        does = follower(parameters, number, steady, case.interface)
        lowest = borders[0].below if borders else does(number.value)
        windows[start] = _windows(lowest[0], [(one.value, one.above[0]) for one in borders])
    own = number.value - number.least or number.first
    return {
        "key": number.key,
        "unit": number.unit,
        "value": number.value,
        "searched": [number.least + own / FARTHEST, number.least + own * FARTHEST],
        "ramp": starts[RAMP].surface.run_up_time,
        "stick_slip": windows,
    }


def _windows(lowest: str, borders: list[tuple[float, str]]) -> list[Window]:
    """Where the block sticks and slips: by its regime at the least value and above each border."""
    names = [lowest, *(name for _, name in borders)]
    between = zip(names, pairwise([None, *(value for value, _ in borders), None]), strict=True)
    windows = []
    for sticks, neighbours in groupby(between, key=lambda one: one[0] == STICK_SLIP):
        ends = [end for _, pair in neighbours for end in pair]
        if sticks:
            windows.append((ends[0], ends[-1]))
    return windows


def range_sentence(found: dict[str, Any]) -> str:
    """The answer in a line: "... sticks and slips from rest up to 0.181 m/s; riding ..."."""
    return " ".join(sentences(_text().range(found)))


#: Steps of `stick_slip_range`, as many as there mostly are: values tried and a border's halvings.
STEPS = len(MAPPED) * (COUNT + 8)

RESULT, PAGE = "stability.json", "report.html"
#: Speeds of the maps as parts of the scenario's, its pretensions as parts of a spring's length, and
#: mu_s/mu_k.
SPEEDS, PRETENSIONS, RATIOS = (0.2, 4.0), (0.0, 0.2), (1.02, 2.0)


@dataclass
class Stability(PageResult):
    """The assessment of a scenario, and the maps and the range that were asked for.

    Attributes
    ----------
    case : the scenario's own assessment
    pretension, regimes : the maps around it; None where they were not computed
    stick_slip : what `stick_slip_range` says; None where that was not asked
    """

    SHOWN_BY = __name__

    case: Case
    pretension: PretensionMap | None = None
    regimes: RegimeMap | None = None
    stick_slip: dict[str, Any] | None = None

    def __repr__(self) -> str:
        """The sentence that answers, in a line."""
        return f"<Stability of {self.case.name}: {self.sentences[0]}>"

    def fill_maps(self, grid: int, done: Callable[[int], object] = lambda count: None) -> None:
        """Both maps, ``grid`` points a side, the second only once the first is whole.

        The first only of a rig that can leave its line. done: called with 1 after each cell.
        """
        rig, surface = self.case.parameters.rig, self.case.parameters.surface
        speeds = abs(surface.speed) * np.linspace(*SPEEDS, grid)
        if rig.degrees_of_freedom != ("x",):
            stretched = rig.spring_length * np.linspace(*PRETENSIONS, grid)
            self.pretension = maps.pretension_map(self.case, stretched, speeds, done)
        self.regimes = maps.regime_map(self.case, np.linspace(*RATIOS, grid), speeds, done)

    def summary(self) -> dict[str, Any]:
        """What `stability.json` holds: plain numbers, SI; what was not computed is None."""
        maps = {"pretension_map": self.pretension, "regime_map": self.regimes}
        told = {"name": self.case.name, **self.case.assessment.as_dict(), "starts": STARTS, **maps}
        return dict(plain_data(told | {"stick_slip_range": self.stick_slip}))

    @property
    def sentences(self) -> list[str]:
        """What the numbers say, what was asked first."""
        numbers = self.summary()
        told = (stability_sentence, regime_sentence, border_sentence)
        first = [] if self.stick_slip is None else [range_sentence(self.stick_slip)]
        return [*first, *(speaks(numbers) for speaks in told)]


def stability(scenario: Scenario | str | Path, *, grid: int = 0, border: str = "") -> Stability:
    """Which steady motions a rig has, which of them it can keep to, and where stick-slip stops.

    grid : points a side of each map, at least 2; 0 for none
    border : "speed", "ramp", "damping", "pretension" or "ratio": the range of that number in which
        the block sticks and slips; "" is not asked

    Raises NotAMotion, in one line, where there is nothing to be assessed.

    >>> from cosim import stability
    >>> found = stability("study")
    >>> found.summary()["name"], found.save("results/stability").name
    ('study', 'stability')
    """
    if grid < 0 or grid == 1:
        raise NotAMotion(f"grid = {grid}: must be at least 2, or 0 for none")
    found = Stability(maps.case_of(as_scenario(scenario)))
    if border:
        found.stick_slip = stick_slip_range(found.case, border)
    if grid:
        found.fill_maps(grid)
    return found


def write_numbers(found: Stability, folder: Path) -> None:
    """All numbers."""
    write_json(found.summary(), folder / RESULT)


def printed(found: Stability) -> str:
    """What the command prints."""
    return str(_text().printed(found.summary(), found.sentences))


def _text() -> Any:
    """The macros of `stability.txt.j2`."""
    return texts("stability.txt.j2", __package__ or "", {})


def headline(found: Stability) -> str:
    """What was asked first."""
    return found.sentences[0]


def page(found: Stability, command: str = "") -> tuple[str, list[Picture]]:
    """HTML of the numbers and what they say, the first of it first; and its pictures."""
    from .figures import draw_pretension_map, draw_range, draw_regime_map

    # the heading is one sentence, and what it goes on with stands below
    first, *others = found.sentences
    sentence, *rest = re.split(r"(?<=\.) (?=[A-Z])", first, maxsplit=1)
    pairs: Any = (
        (draw_range, found.stick_slip),
        (draw_pretension_map, found.pretension),
        (draw_regime_map, found.regimes),
    )
    pictures = [draw(drawn, found.case) for draw, drawn in pairs if drawn is not None]
    html = render(
        "stability.html.j2", __package__ or "", numbers=found.summary(), sentence=sentence,
        sentences=[*rest, *others], tiles=tiles(found), pictures=pictures,
    )  # fmt: skip
    return html, pictures


def tiles(found: Stability) -> list[tuple[str, str]]:
    """Four figures: where stick-slip stops if that is asked, how disturbances grow, what would
    help, and what the run does."""
    return tiles_of(_text().tiles(found.summary()))[:4]
