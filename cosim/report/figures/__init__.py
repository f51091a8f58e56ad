"""The figures of a run, each from the dataset alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import xarray as xr
from matplotlib.figure import Figure

from .heat import draw_heat, draw_melting
from .motion import draw_friction_force, draw_motion, draw_phase_portrait
from .temperatures import draw_belt_temperature, draw_temperatures
from .top_view import draw_top_view


@dataclass(frozen=True)
class Plate:
    """A figure: name of its file, caption, how it is drawn, the variable that it needs.

    grows: that variable must rise above 0, or there is nothing to see.
    """

    name: str
    caption: str
    draw: Callable[[xr.Dataset], Figure]
    needs: str = "x"
    grows: bool = False


PLATES = (
    Plate(
        "motion",
        "Position x along the motion of the surface, y across it and rotation φ (counter-clockwise)"
        " of the block. Slip is shaded; in between the block sticks to the surface and moves with"
        " it.",
        draw_motion,
    ),
    Plate(
        "friction_force",
        "Friction of the surface on the block. Dashed: the largest that static friction holds"
        " (μ_s m g) and what sliding friction amounts to (μ_k m g). Drawn at the recorded"
        " times: a peak between two of them is cut.",
        draw_friction_force,
    ),
    Plate(
        "phase_portrait",
        "Velocity over position. On the dashed line the block moves with the surface: it sticks."
        " A closed loop is a stick-slip cycle.",
        draw_phase_portrait,
    ),
    Plate(
        "heat",
        "Friction heat: power (mean over the interval between two rows), its sum since the start,"
        " and what of it is found where.",
        draw_heat,
    ),
    Plate(
        "temperatures",
        "Rise of the temperatures over that of the air; the scale at the right is the"
        " thermometer's. Before and behind the contact: an eighth of the contact's length outside"
        " it.",
        draw_temperatures,
        needs="interface_temperature",
    ),
    Plate(
        "melting",
        "Stress of friction on the contact; mean thickness of the water under the block, and what"
        " the melting of the moment alone would feed (the rest has come round on the belt); ice"
        " that the block has lost, and what of it lies frozen on the belt. Dotted: what the film"
        " would be sheared with if it covered the whole contact; where that is more than friction,"
        " it does not.",
        draw_melting,
        needs="melted_mass",
        grows=True,
    ),
    Plate(
        "belt_temperature",
        "Contact face of the belt along its length, in the belt's own coordinate, at several times."
        " Below, in the same colours: where the block stood. Where the belt runs forwards the"
        " block moves to the left in this coordinate.",
        draw_belt_temperature,
        needs="belt_temperature",
    ),
    Plate(
        "top_view",
        "Block and springs from above with their exact geometry, to scale. Dotted: the block at"
        " rest; squares: fixed ends of the springs; the line from the centre turns with the block.",
        draw_top_view,
    ),
)


def plates_of(dataset: xr.Dataset) -> list[Plate]:
    """The figures that a dataset has the variables (and at least one row) for."""
    if dataset.sizes["time"] == 0:
        return []
    return [plate for plate in PLATES if _has(dataset, plate)]


def _has(dataset: xr.Dataset, plate: Plate) -> bool:
    if plate.needs not in dataset or dataset[plate.needs].size == 0:
        return False
    return not plate.grows or float(dataset[plate.needs].max()) > 0.0
