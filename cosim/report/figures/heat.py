"""Friction heat, temperatures of contact and belt, and melting over time."""

from __future__ import annotations

import numpy as np
from stickslip.friction.law import feels_water

from cosim.report.columns import Data
from cosim.report.contents import mechanics_of
from cosim.report.heat_numbers import SINKS, Film, all_other_heat, ambient_degC, film_of, held
from cosim.report.live import Curve, Panel, TimeFigure
from cosim.report.palette import (
    BLUE,
    GREEN,
    GREY,
    INK,
    LIGHT_BLUE,
    ORANGE,
    PURPLE,
    RED,
    SKY,
    Scaled,
    readable,
)

COLOURS = {"belt": BLUE, "ice": SKY, "air": ORANGE, "supports": GREEN, "melting": PURPLE}
LABELS = {
    "belt": "in the belt",
    "ice": "in the ice",
    "air": "in the air",
    "supports": "in the supports",
    "melting": "melting",
}
#: Sinks that most runs do not have.
RARE = ("supports", "melting")
#: Of all the heat: shares of less are not drawn.
SMALLEST_PART = 2e-3


def heat(dataset: Data) -> TimeFigure:
    """Heat flow, cumulative heat and, where there is a thermal model, the shares."""
    sinks = sinks_of(dataset)
    beside = all_other_heat(dataset)
    flow = readable(dataset["heat_flow"].values, "W")
    total = readable(dataset["heat"].values + beside, "J")
    sums = [
        Curve(LABELS[sink], total(held(dataset, name)), COLOURS[sink], fill=True)
        for sink, name in sinks.items()
    ]
    sums.append(Curve("friction heat", total(dataset["heat"].values), INK))
    if beside.any():
        all_of_it = total(dataset["heat"].values + beside)
        sums.append(Curve("with railing's, rollers'", all_of_it, INK, dash=True))
    panels = [
        Panel(
            f"friction heat [{flow.unit}]",
            [Curve("mean power", flow(dataset["heat_flow"].values), RED, steps=True)],
            from_zero=True,
        ),
        Panel(
            f"heat since start [{total.unit}]",
            sums,
            stacked=bool(sinks),
            from_zero=True,
            # shading would mix with the colours of what is stacked
            shaded=not sinks,
        ),
    ]
    if sinks:
        label = "share of the heat [%]"
        panels.append(Panel(label, _shares(dataset, sinks), from_zero=True, top=100.0))
    return TimeFigure(dataset["time"].values, panels, title="Friction heat", height=2.0)


def sinks_of(dataset: Data) -> dict[str, str]:
    """Sinks that the dataset knows -> variable; the rare ones only where they took heat."""
    return {
        sink: name
        for sink, name in SINKS.items()
        if name in dataset and (sink not in RARE or float(dataset[name].max()) > 0.0)
    }


def _shares(dataset: Data, sinks: dict[str, str]) -> list[Curve]:
    received = dataset["heat_received"].values + all_other_heat(dataset)
    # of the first joules the parts are rounding and the mesh's
    least = SMALLEST_PART * float(np.nanmax(received, initial=0.0))
    whole = np.where(received > least, received, np.nan)
    return [
        Curve(LABELS[sink], 100.0 * held(dataset, name) / whole, COLOURS[sink], width=1.8)
        for sink, name in sinks.items()
    ]


def melting(dataset: Data) -> TimeFigure:
    """Stresses in the contact, thickness of the film, melted and frozen mass."""
    film = film_of(dataset)
    stress = readable(film.friction, "Pa")
    thickness = readable(film.thickness, "m")
    mass = readable(1e3 * dataset["melted_mass"].values, "g")

    def weight(name: str) -> np.ndarray:
        return mass(1e3 * dataset[name].values)

    masses = [
        Curve("melted", weight("melted_mass"), PURPLE),
        Curve("of it, ice on the belt", weight("refrozen_mass"), SKY),
    ]
    if dataset["wiped_ice_mass"].max() > 0.0:
        masses.append(Curve("of it, ice wiped off", weight("wiped_ice_mass"), GREY))
    water = [
        Curve("film", thickness(film.thickness), BLUE),
        Curve("film that melting alone would feed", thickness(film.fed), GREY, dash=True),
    ]
    stresses = _stresses(film, stress, feels_water(mechanics_of(dataset)))
    panels = [
        Panel(f"stress [{stress.unit}]", stresses, from_zero=True),
        Panel(f"water [{thickness.unit}]", water, from_zero=True),
        Panel(f"mass [{mass.unit}]", masses, from_zero=True),
    ]
    return TimeFigure(dataset["time"].values, panels, title="Melting", height=2.3, own_scale=True)


def _stresses(film: Film, scaled: Scaled, parts: bool) -> list[Curve]:
    """Friction, its parts where it feels the water, and what a film over all would be sheared with.

    The latter has no bound as the film thins: it is cut where the axis of friction ends.
    """
    curves = [Curve("friction", scaled(film.friction), INK)]
    if parts:
        water = np.nan_to_num(film.water)
        curves.append(Curve("dry part of it", scaled(film.friction - water), ORANGE))
        curves.append(Curve("shear of the water", scaled(film.water), BLUE))
    highest = 1.3 * scaled.factor * float(np.nanmax(film.friction, initial=0.0)) or 1.0
    whole = scaled(film.whole)
    with np.errstate(invalid="ignore"):
        whole = np.where(whole <= highest, whole, np.nan)
    curves.append(Curve("shear of a film over the whole contact", whole, LIGHT_BLUE, dash=True))
    return curves


CONTACT, ICE = "interface_temperature", "ice_face_temperature"
GROUPS = (
    ((CONTACT, "contact, mean of both faces", RED),),
    (
        ("belt_entry_temperature", "belt before the contact", BLUE),
        ("belt_exit_temperature", "belt behind the contact", GREEN),
    ),
)
# below this (K) a rise is rounding
SMALLEST_RISE = 1e-9


def temperatures(dataset: Data) -> TimeFigure:
    """Rise over the air of the contact and of the belt, and how much warmer the ice's face is.

    Contact and ice differ by thousandths of their rise: as two curves they would be one.
    """
    ambient = ambient_degC(dataset)
    names = [name for group in GROUPS for name, *_ in group if name in dataset]
    rises = np.concatenate([dataset[name].values - ambient for name in names])
    scaled = readable(rises, "K", SMALLEST_RISE)
    panels = [
        Panel(
            f"rise over the air [{scaled.unit}]",
            [
                Curve(label, scaled(dataset[name].values - ambient), colour)
                for name, label, colour in group
                if name in dataset
            ],
            span=scaled.factor * SMALLEST_RISE,
            thermometer=(ambient, scaled.factor),
        )
        for group in GROUPS
    ]
    if ICE in dataset:
        panels.insert(1, _difference(dataset))
    air = f"{ambient:g}".replace("-", "−")
    said = f"Temperatures in air at {air} °C"
    return TimeFigure(dataset["time"].values, panels, title=said, height=2.2, own_scale=True)


def _difference(dataset: Data) -> Panel:
    difference = dataset[ICE].values - dataset[CONTACT].values
    scaled = readable(difference, "K", SMALLEST_RISE)
    return Panel(
        f"ice less contact [{scaled.unit}]",
        [Curve("face of the ice less contact", scaled(difference), INK)],
        span=scaled.factor * SMALLEST_RISE,
    )
