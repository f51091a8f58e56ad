"""The figures of a run, each from the dataset alone: as a drawing, and alive on a page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from matplotlib.figure import Figure

from cosim.names import unknown_name
from cosim.report.columns import Data
from cosim.report.live import Live
from cosim.report.page import Picture
from cosim.report.style import displayed, png

from ..contents import material_of, mechanics_of
from ..material import figure_of_material, live_of_material
from ..quantities import TABLES
from .belt_map import belt_temperature
from .friction_table import draw_friction_table
from .heat import heat, melting, temperatures
from .motion import draw_phase_portrait, friction_force, motion
from .over_time import drawn_and_live, over_time
from .top_view import draw_top_view, top_view_live


@dataclass(frozen=True)
class Plate:
    """A figure: name of its file, how it is drawn, title, caption, the variable that it needs.

    live: what the page's scripts draw; None where the page has the drawing. alt: what a reader
    hears who does not see it. grows: the variable must rise above 0, or there is nothing to see.
    """

    name: str
    draw: Callable[[Data], Figure]
    live: Callable[[Data], Live] | None
    title: str
    caption: str
    alt: str
    needs: str = "x"
    grows: bool = False

    def drawn(self, dataset: Data) -> Figure:
        """The drawing."""
        return figure_of_material(self.draw(dataset), material_of(dataset))

    def picture(self, dataset: Data) -> Picture:
        """For a page: with what its scripts draw, or else the drawing."""
        alive = None
        if self.live is not None:
            alive = {"title": self.title, **self.live(dataset)}
            alive = live_of_material(alive, material_of(dataset))
        return Picture(self.name, self.caption, lambda: png(self.drawn(dataset)), self.alt, alive)


_DRAWN: dict[str, tuple[Callable[[Data], Figure], Callable[[Data], Live] | None]] = {
    "top_view": (draw_top_view, top_view_live),
    "motion": over_time(motion),
    "friction_force": over_time(friction_force),
    "phase_portrait": (draw_phase_portrait, None),
    "heat": over_time(heat),
    "temperatures": over_time(temperatures),
    "melting": over_time(melting),
    "belt_temperature": drawn_and_live(belt_temperature),
    "friction_table": (draw_friction_table, None),
}
#: In the order of a page; the last is of a run whose friction is a table.
*PLATES, TABLE = (Plate(name, *drawn, **TABLES["figures"][name]) for name, drawn in _DRAWN.items())


def plates_of(dataset: Data) -> list[Plate]:
    """The figures that a dataset has the variables (and at least one row) for."""
    if dataset.sizes["time"] == 0:
        return []
    shown = [plate for plate in PLATES if _has(dataset, plate)]
    return [*shown, TABLE] if mechanics_of(dataset).friction.has_table else shown


def named_plates(dataset: Data, names: Sequence[str]) -> list[Plate]:
    """Those of some names, all of them for none; ValueError for a name that is none."""
    plates = {plate.name: plate for plate in plates_of(dataset)}
    for name in names:
        if name not in plates:
            raise ValueError(unknown_name("figure of this run", name, plates))
    return [plates[name] for name in names or plates]


def figure_of(dataset: Data, name: str) -> Figure:
    """The figure of a name, of those that `plates_of` has; ValueError for a name that is none."""
    return displayed(named_plates(dataset, [name])[0].drawn(dataset))


def _has(dataset: Data, plate: Plate) -> bool:
    if plate.needs not in dataset or dataset[plate.needs].size == 0:
        return False
    return not plate.grows or float(dataset[plate.needs].max()) > 0.0
