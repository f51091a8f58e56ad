"""The figures of a run, each from the dataset alone: as a drawing, and alive on a page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from cosim.names import unknown_name
from cosim.report.columns import Data
from cosim.report.live import Live, TimeFigure
from cosim.report.page import Picture

from ..contents import material_of, mechanics_of
from ..material import figure_of_material, live_of_material
from ..quantities import TABLES
from .belt_map import belt_temperature
from .heat import heat, melting, temperatures
from .over_time import friction_force, motion, time_figure
from .phase_portrait import phase_portrait_live
from .top_view import top_view_live

if TYPE_CHECKING:
    from matplotlib.figure import Figure  # loaded when somebody asks for a drawing


@dataclass(frozen=True)
class Plate:
    """A figure: name of its file, title, caption, the variable that it needs.

    show: what it shows over time, or what else the page's scripts draw; None where the page has the
    drawing. alt: what a reader hears who does not see it. grows: the variable must rise above 0, or
    there is nothing to see.
    """

    name: str
    show: Callable[[Data], TimeFigure | Live] | None
    title: str
    caption: str
    alt: str
    needs: str = "x"
    grows: bool = False

    def drawn(self, dataset: Data) -> Figure:
        """The drawing."""
        from .drawn import drawing  # loads what draws

        return figure_of_material(drawing(self.name, self.show, dataset), material_of(dataset))

    def png(self, dataset: Data) -> bytes:
        """The drawing as a file's content."""
        from cosim.report.style import png

        return png(self.drawn(dataset))

    def picture(self, dataset: Data) -> Picture:
        """For a page: with what its scripts draw, or else the drawing."""
        shown = self.show(dataset) if self.show else None
        alive = shown.live() if isinstance(shown, TimeFigure) else shown
        if alive is not None:
            alive = live_of_material({"title": self.title, **alive}, material_of(dataset))
        return Picture(self.name, self.caption, partial(self.png, dataset), self.alt, alive)


_SHOWN: dict[str, Callable[[Data], TimeFigure | Live] | None] = {
    "top_view": top_view_live,
    "motion": partial(time_figure, motion),
    "friction_force": partial(time_figure, friction_force),
    "phase_portrait": phase_portrait_live,
    "heat": partial(time_figure, heat),
    "temperatures": partial(time_figure, temperatures),
    "melting": partial(time_figure, melting),
    "belt_temperature": belt_temperature,
    "friction_table": None,
}
#: In the order of a page; the last is of a run whose friction is a table.
*PLATES, TABLE = (Plate(name, show, **TABLES["figures"][name]) for name, show in _SHOWN.items())


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
    from cosim.report.style import displayed

    return displayed(named_plates(dataset, [name])[0].drawn(dataset))


def _has(dataset: Data, plate: Plate) -> bool:
    if plate.needs not in dataset or dataset[plate.needs].size == 0:
        return False
    return not plate.grows or float(dataset[plate.needs].max()) > 0.0
