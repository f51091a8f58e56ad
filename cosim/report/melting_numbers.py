"""Numbers of melting: how much, since when, and whether film, shear and friction fit together.

Water of the mean thickness h that covered the whole contact would be sheared with eta v / h. Where
friction is less than that, the water cannot cover it: on a share w it is h / w thick and sheared
with w^2 eta v / h in all, so that of the contact at most

    w = sqrt(tau h / (eta v))

can be flooded, tau the stress of friction.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from stickslip import Parameters
from stickslip.kernel.layout import (
    P_MIXED_LUBRICATION_COUETTE,
    P_MIXED_LUBRICATION_ROUGHNESS,
    P_MIXED_LUBRICATION_SHARE,
    P_NORMAL_FORCE,
    P_RADIUS,
)

from thermal.materials import WATER_DENSITY

from .blocks import mechanics_of, value_of
from .phases import SLIP
from .quantities import Quantity, ratio

Array = NDArray[np.float64]

#: What a run is like before melting and at its end: means over so long, s.
WINDOW = 1.0
#: Water that is thinner than a molecule, m, is what rounding leaves of a film that froze.
THINNEST = 3e-10


class Film(NamedTuple):
    """Water and friction over time, each (n,).

    thickness: mean over the contact, m. friction: its stress, Pa. whole, water: shear of the film
    if it covered the whole contact, and of the water as mixed_lubrication has it, Pa. flooded,
    at_most: share of the contact that it floods there, and the most that friction allows. fed:
    thickness that the melting of the moment alone would feed, m.
    """

    thickness: Array
    friction: Array
    whole: Array
    water: Array
    flooded: Array
    at_most: Array
    fed: Array


def melts(dataset: xr.Dataset) -> bool:
    """Whether any ice melted."""
    return "melted_mass" in dataset and float(dataset["melted_mass"].max()) > 0.0


def melting_begins(dataset: xr.Dataset) -> float:
    """Time of the last row before any ice melted, s."""
    melted = dataset["melted_mass"].values > 0.0
    return float(dataset["time"].values[max(0, int(np.argmax(melted)) - 1)])


def friction_coefficient(dataset: xr.Dataset) -> Array:
    """Friction over normal force, (n,); not a number where the block sticks."""
    force = np.hypot(dataset["friction_force_x"].values, dataset["friction_force_y"].values)
    slips = dataset["mode"].values == SLIP
    return np.where(slips, force / mechanics_of(dataset).pack()[P_NORMAL_FORCE], np.nan)


def film_of(dataset: xr.Dataset) -> Film:
    """Film and friction at every row; not a number in stick, and where there is no water."""
    p = mechanics_of(dataset).pack()
    pressure = p[P_NORMAL_FORCE] / (np.pi * p[P_RADIUS] ** 2)
    thickness = np.where(
        (dataset["film_thickness"] > THINNEST) & (dataset["mode"] == SLIP),
        dataset["film_thickness"],
        np.nan,
    )
    friction = pressure * friction_coefficient(dataset)
    couette = (
        pressure * p[P_MIXED_LUBRICATION_COUETTE] * dataset["sliding_speed"].values / thickness
    )
    flooded = (
        p[P_MIXED_LUBRICATION_SHARE] * thickness / (thickness + p[P_MIXED_LUBRICATION_ROUGHNESS])
    )
    return Film(
        thickness,
        friction,
        couette,
        flooded**2 * couette,
        flooded,
        np.minimum(1.0, np.sqrt(friction / couette)),
        _fed(dataset),
    )


def _fed(dataset: xr.Dataset) -> Array:
    """Melt rate times residence: what a film is that no water comes back to, m."""
    lane = min(2.0 * value_of(dataset, "rig", "contact_radius"), value_of(dataset, "belt", "width"))
    if value_of(dataset, "ice", "mesh"):
        lane = np.nan  # the breadth is the mesh's
    speed = dataset["sliding_speed"].values
    slips = (dataset["mode"].values == SLIP) & (speed > 0.0)
    return dataset["melt_rate"].values / np.where(slips, WATER_DENSITY * lane * speed, np.nan)


def melting(dataset: xr.Dataset) -> dict[str, Quantity]:
    """What melted since when, and the balance of the film over the last second."""
    begin, end = melting_begins(dataset), float(dataset["time"][-1])
    melted = float(dataset["melted_mass"][-1])
    before = dataset.sel(time=slice(begin - WINDOW, begin))
    return {
        "onset": Quantity(begin, "s"),
        "melted_mass": Quantity(melted, "kg"),
        "refrozen_mass": Quantity(float(dataset["refrozen_mass"][-1]), "kg"),
        "wiped_ice_mass": Quantity(float(dataset["wiped_ice_mass"][-1]), "kg"),
        "mean_melt_rate": Quantity(ratio(melted, end - begin), "kg/s"),
        "max_melt_rate": Quantity(float(dataset["melt_rate"].max()), "kg/s"),
        "melting_share": Quantity(_share(dataset.sel(time=slice(begin, None))), "1"),
        "friction_before": Quantity(mean_of(friction_coefficient(before)), "1"),
        **_balance(dataset.sel(time=slice(end - WINDOW, None))),
    }


def _balance(late: xr.Dataset) -> dict[str, Quantity]:
    film = film_of(late)
    return {
        "melting_share_end": Quantity(_share(late), "1"),
        "friction_end": Quantity(mean_of(friction_coefficient(late)), "1"),
        "film_thickness": Quantity(mean_of(film.thickness), "m"),
        "film_fed_by_melting": Quantity(mean_of(film.fed), "m"),
        "friction_stress": Quantity(mean_of(film.friction), "Pa"),
        "whole_film_shear": Quantity(mean_of(film.whole), "Pa"),
        "largest_flooded_share": Quantity(mean_of(film.at_most), "1"),
        "flooded_share": Quantity(mean_of(film.flooded), "1"),
        "water_shear": Quantity(mean_of(film.water), "Pa"),
    }


def _share(rows: xr.Dataset) -> float | None:
    """Of the friction heat of some rows, what melting took less what freezing gave back."""
    heat, spent = (float(rows[name][-1] - rows[name][0]) for name in ("heat", "meltwater_heat"))
    return ratio(spent, heat)


def mean_of(values: Array) -> float | None:
    """Mean of what is a number; None where nothing is."""
    known = values[np.isfinite(values)]
    return float(known.mean()) if known.size else None


def floods(parameters: Parameters) -> bool:
    """Whether the friction of a rig feels the film."""
    return parameters.mixed_lubrication.share > 0.0
