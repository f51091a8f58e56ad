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
from .belt_map import belt_temperature_live, draw_belt_temperature
from .friction_table import draw_friction_table
from .heat import heat, melting, temperatures
from .motion import draw_phase_portrait, friction_force, motion
from .over_time import over_time
from .top_view import draw_top_view, top_view_live


@dataclass(frozen=True)
class Plate:
    """A figure: name of its file, title, caption, how it is drawn, the variable that it needs.

    alt: what a reader hears who does not see it. live: what the page's scripts draw; None where
    the page has the drawing. grows: the variable must rise above 0, or there is nothing to see.
    """

    name: str
    title: str
    caption: str
    alt: str
    draw: Callable[[Data], Figure]
    live: Callable[[Data], Live] | None = None
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


PLATES = (
    Plate(
        "top_view",
        "Block and springs from above",
        "Block and springs from above with their exact geometry, to scale. Squares: fixed ends of"
        " the springs; the line from the centre turns with the block. Dotted: the block at rest.",
        "The rig seen from above: block, four springs and the moving surface.",
        draw_top_view,
        top_view_live,
    ),
    Plate(
        "motion",
        "Motion of the block",
        "Position x along the motion of the surface, y across it and rotation φ (counter-clockwise)"
        " of the block. Slip is shaded; in between the block sticks to the surface and moves with"
        " it.",
        "Position and rotation of the block over time, phases of slip shaded.",
        *over_time(motion),
    ),
    Plate(
        "friction_force",
        "Friction on the block",
        "Friction of the surface on the block. Dashed: the largest that static friction holds"
        " (μₛ m g) and what sliding friction amounts to (μₖ m g). Drawn through the located"
        " break-aways and re-sticks: a peak between two recorded times is whole, unless it is"
        " narrower than their distance.",
        "Friction on the block over time, beside its limits in stick and in slip.",
        *over_time(friction_force),
    ),
    Plate(
        "phase_portrait",
        "Phase portrait",
        "Velocity over position. On the dashed line the block moves with the surface below it: it"
        " sticks. A closed loop is a stick-slip cycle. The speed ramp comes out of the paper, the"
        " faintest first.",
        "Velocity of the block over its position: a closed loop for each stick-slip cycle.",
        draw_phase_portrait,
    ),
    Plate(
        "heat",
        "Friction heat",
        "Friction heat: power (mean over the interval between two rows), its sum since the start,"
        " and what of it is found where.",
        "Power and sum of the friction heat over time, and the shares of belt, ice and air.",
        *over_time(heat),
    ),
    Plate(
        "temperatures",
        "Temperatures",
        "Rise of the temperatures over that of the air. The face of the ice and the mean of both"
        " faces differ so little that their difference is drawn. Before and behind the contact: an"
        " eighth of the contact's length outside it.",
        "Temperatures of the contact and of the belt before and behind it over time.",
        *over_time(temperatures),
        needs="interface_temperature",
    ),
    Plate(
        "melting",
        "Melting",
        "Stress of friction on the contact; mean thickness of the water under the block, and what"
        " the melting of the moment alone would feed (the rest has come round on the belt); ice"
        " that the block has lost, and what of it lies frozen on the belt. Pale: what the film"
        " would be sheared with if it covered the whole contact; where that is more than friction,"
        " it does not.",
        "Stress in the contact, thickness of the water and mass of melted ice over time.",
        *over_time(melting),
        needs="melted_mass",
        grows=True,
    ),
    Plate(
        "belt_temperature",
        "Temperature of the surface over time and place",
        "Contact face of the belt over time, place by place of its own material. Blue: the place"
        " below the middle of the block; a belt that runs forwards comes to it from higher places."
        " Below the block the mean of the contact. Between the times at which the belt was"
        " recorded a place keeps its temperature until the block has passed, then has the next.",
        "Map of the temperature of the belt over time and place; warmest below the block.",
        draw_belt_temperature,
        belt_temperature_live,
        needs="belt_temperature",
    ),
)

#: Of a run whose friction is a table.
TABLE = Plate(
    "friction_table",
    "Friction as measured",
    "The table in place of μ_k: its points, and what the model has between and beyond them"
    " (monotone cubics). Shaded: speeds at which the block slid; dotted: static friction.",
    "Kinetic friction over sliding speed: the points of the table and the curve through them.",
    draw_friction_table,
    needs="sliding_speed",
)


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
