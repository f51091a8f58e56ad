"""What `stickslip stability` finds of a rig, as one result."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from stickslip.steady_motion.starts import STARTS

from cosim.files import write_text
from cosim.report.files import without_nan
from cosim.report.page import PageResult, Picture, render, texts, tiles_of
from cosim.report.run_text import border_sentence, regime_sentence, stability_sentence
from cosim.scenario import Scenario

from . import maps
from .maps import MAPPED, Case, NotAMotion, PretensionMap, RegimeMap
from .stick_slip_range import range_sentence, stick_slip_range

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
        stretched, regimes = self.pretension, self.regimes
        return {
            "name": self.case.name,
            **self.case.assessment.as_dict(),
            "starts": STARTS,
            "pretension_map": stretched
            and {key: without_nan(values.tolist()) for key, values in vars(stretched).items()},
            "regime_map": regimes
            and {
                "ratios": regimes.ratios.tolist(),
                "speeds": regimes.speeds.tolist(),
                "simulated": _by_start(regimes.simulated),
                "closed_form": _by_start(regimes.closed_form),
                "cells_that_differ": regimes.wrong,
                "fastest_from_rest": regimes.fastest_from_rest,
                "closed_form_borders": _by_start(regimes.borders),
            },
            "stick_slip_range": self.stick_slip,
        }

    @property
    def sentences(self) -> list[str]:
        """What the numbers say, what was asked first."""
        numbers = self.summary()
        told = (stability_sentence, regime_sentence, border_sentence)
        first = [] if self.stick_slip is None else [range_sentence(self.stick_slip)]
        return [*first, *(speaks(numbers) for speaks in told)]


def stability(scenario: Scenario, *, grid: int = 0, border: str = "") -> Stability:
    """Which steady motions a rig has, which of them it can keep to, and where stick-slip stops.

    grid : points a side of each map, at least 2; 0 for none
    border : "speed", "ramp", "damping", "pretension" or "ratio": the range of that number in which
        the block sticks and slips; "" is not asked

    Raises NotAMotion, in one line, where there is nothing to be assessed.

    >>> from cosim import read_scenario, stability
    >>> found = stability(read_scenario("study").changed(run_duration=20.0))
    >>> found.summary()["name"], found.save("results/stability").name
    ('study', 'stability')
    """
    if grid < 0 or grid == 1:
        raise NotAMotion(f"grid = {grid}: must be at least 2, or 0 for none")
    found = Stability(maps.case_of(scenario))
    if border:
        found.stick_slip = stick_slip_range(found.case, border)
    if grid:
        found.fill_maps(grid)
    return found


def _by_start(tables: Iterable[np.ndarray] | None) -> dict[str, Any] | None:
    if tables is None:
        return None
    return {start: table.tolist() for start, table in zip(MAPPED, tables, strict=False)}


def write_numbers(found: Stability, folder: Path) -> None:
    """All numbers."""
    write_text(json.dumps(found.summary(), indent=1), folder / RESULT)


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
    """HTML of the numbers and what they say, the first of it first; and the maps."""
    from .figures import draw_pretension_map, draw_regime_map

    # the heading is one sentence, and what it goes on with stands below
    first, *others = found.sentences
    sentence, *rest = re.split(r"(?<=\.) (?=[A-Z])", first, maxsplit=1)
    pairs = ((draw_pretension_map, found.pretension), (draw_regime_map, found.regimes))
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
