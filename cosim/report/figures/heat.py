"""Friction heat, temperatures of contact and belt, and melting over time."""

from typing import Any

import numpy as np
from stickslip.friction.law import feels_water

from cosim.report import palette as ink
from cosim.report.columns import Data
from cosim.report.contents import mechanics_of
from cosim.report.heat_numbers import SINKS, Film, ambient_degC, film_of, held, other_heat
from cosim.report.live import Curve, Panel, TimeFigure
from cosim.report.palette import Scaled, readable

#: Sink -> label and colour.
LOOKS = {
    "belt": ("in the belt", ink.BLUE),
    "ice": ("in the ice", ink.SKY),
    "air": ("in the air", ink.ORANGE),
    "supports": ("in the supports", ink.GREEN),
    "melting": ("melting", ink.PURPLE),
}
#: Sinks that most runs do not have.
RARE = ("supports", "melting")
#: Of all the heat: shares of less are not drawn.
SMALLEST_PART = 2e-3


def heat(dataset: Data) -> TimeFigure:
    """Heat flow, cumulative heat and, where there is a thermal model, the shares."""
    sinks, beside = sinks_of(dataset), other_heat(dataset)
    power, produced = dataset["heat_flow"].values, dataset["heat"].values
    flow, total = readable(power, "W"), readable(produced + beside, "J")
    sums = [
        Curve(label, total(held(dataset, SINKS[sink])), colour, fill=True)
        for sink, (label, colour) in sinks.items()
    ]
    sums.append(Curve("friction heat", total(produced), ink.INK))
    if beside.any():
        sums.append(Curve("with railing's, rollers'", total(produced + beside), ink.INK, dash=True))
    mean = [Curve("mean power", flow(power), ink.RED, steps=True)]
    # shading would mix with the colours of what is stacked
    look: Any = {"stacked": bool(sinks), "from_zero": True, "shaded": not sinks}
    panels = [
        Panel(f"friction heat [{flow.unit}]", mean, from_zero=True),
        Panel(f"heat since start [{total.unit}]", sums, **look),
    ]
    if sinks:
        label = "share of the heat [%]"
        panels.append(Panel(label, _shares(dataset, sinks), from_zero=True, top=100.0))
    return TimeFigure(dataset["time"].values, panels, title="Friction heat", height=2.0)


def sinks_of(dataset: Data) -> dict[str, tuple[str, str]]:
    """Sinks that the dataset knows -> look; the rare ones only where they took heat."""
    return {
        sink: LOOKS[sink]
        for sink, name in SINKS.items()
        if name in dataset and (sink not in RARE or float(dataset[name].max()) > 0.0)
    }


def _shares(dataset: Data, sinks: dict[str, tuple[str, str]]) -> list[Curve]:
    received = dataset["heat_received"].values + other_heat(dataset)
    # of the first joules the parts are rounding and the mesh's
    least = SMALLEST_PART * float(np.nanmax(received, initial=0.0))
    whole = np.where(received > least, received, np.nan)
    return [
        Curve(label, 100.0 * held(dataset, SINKS[sink]) / whole, colour, width=1.8)
        for sink, (label, colour) in sinks.items()
    ]


MASSES = (
    ("melted_mass", "melted", ink.PURPLE),
    ("refrozen_mass", "of it, ice on the belt", ink.SKY),
    ("wiped_ice_mass", "of it, ice wiped off", ink.GREY),
)


def melting(dataset: Data) -> TimeFigure:
    """Stresses in the contact, thickness of the film, melted and frozen mass."""
    film = film_of(dataset)
    stress, thickness = readable(film.friction_stress, "Pa"), readable(film.film_thickness, "m")
    mass = readable(1e3 * dataset["melted_mass"].values, "g")
    masses = [
        Curve(label, mass(1e3 * dataset[name].values), colour)
        for name, label, colour in MASSES
        if name != "wiped_ice_mass" or dataset[name].max() > 0.0
    ]
    water = [
        Curve("film", thickness(film.film_thickness), ink.BLUE),
        Curve(
            "film that melting alone would feed",
            thickness(film.film_fed_by_melting),
            ink.GREY,
            dash=True,
        ),
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
    curves = [Curve("friction", scaled(film.friction_stress), ink.INK)]
    if parts:
        water = np.nan_to_num(film.water_shear)
        curves.append(Curve("dry part of it", scaled(film.friction_stress - water), ink.ORANGE))
        curves.append(Curve("shear of the water", scaled(film.water_shear), ink.BLUE))
    highest = 1.3 * scaled.factor * float(np.nanmax(film.friction_stress, initial=0.0)) or 1.0
    whole = scaled(film.whole_film_shear)
    with np.errstate(invalid="ignore"):
        whole = np.where(whole <= highest, whole, np.nan)
    curves.append(Curve("shear of a film over the whole contact", whole, ink.LIGHT_BLUE, dash=True))
    return curves


CONTACT, ICE = "interface_temperature", "ice_face_temperature"
GROUPS = (
    ((CONTACT, "contact, mean of both faces", ink.RED),),
    (
        ("belt_entry_temperature", "belt before the contact", ink.BLUE),
        ("belt_exit_temperature", "belt behind the contact", ink.GREEN),
    ),
)
# below this (K) a rise is rounding
ROUNDING = 1e-9


def temperatures(dataset: Data) -> TimeFigure:
    """Rise over the air of the contact and of the belt, and how much warmer the ice's face is.

    Contact and ice differ by thousandths of their rise: as two curves they would be one.
    """
    ambient = ambient_degC(dataset)
    groups = [
        [
            (dataset[name].values - ambient, label, colour)
            for name, label, colour in group
            if name in dataset
        ]
        for group in GROUPS
    ]
    scaled = readable(
        np.concatenate([rise for group in groups for rise, *_ in group]), "K", ROUNDING
    )
    panels = [
        Panel(
            f"rise over the air [{scaled.unit}]",
            [Curve(label, scaled(rise), colour) for rise, label, colour in group],
            span=scaled.factor * ROUNDING,
            thermometer=(ambient, scaled.factor),
        )
        for group in groups
    ]
    if ICE in dataset:
        difference = dataset[ICE].values - dataset[CONTACT].values
        own = readable(difference, "K", ROUNDING)
        curve = Curve("face of the ice less contact", own(difference), ink.INK)
        label, span = f"ice less contact [{own.unit}]", own.factor * ROUNDING
        panels.insert(1, Panel(label, [curve], span=span))
    air = f"{ambient:g}".replace("-", "−")
    said = f"Temperatures in air at {air} °C"
    return TimeFigure(dataset["time"].values, panels, title=said, height=2.2, own_scale=True)
