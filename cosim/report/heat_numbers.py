"""Numbers of heat and melting: where it went, how warm it got, what the coupling lost, the film.

Water of the mean thickness h that covered the whole contact would be sheared with eta v / h. Where
friction is less than that, the water cannot cover it: on a share w it is h / w thick and sheared
with w^2 eta v / h in all, so that of the contact at most

    w = sqrt(tau h / (eta v))

can be flooded, tau the stress of friction.
"""

from typing import NamedTuple

import numpy as np
from stickslip.kernel.layout import (
    P_MIXED_LUBRICATION_COUETTE,
    P_MIXED_LUBRICATION_ROUGHNESS,
    P_MIXED_LUBRICATION_SHARE,
    P_NORMAL_FORCE,
    P_RADIUS,
)

from cosim.report.columns import Array, Data

from .contents import SLIP, mechanics_of, ramp_end, still_air_film, thermal_of, value_of
from .quantities import ratio

TINY = float(np.finfo(float).tiny)
TEMPERATURES = ("interface", "belt_entry", "belt_exit", "ice_face")
SINKS = {
    "belt": "belt_heat",
    "ice": "ice_heat",
    "air": "air_heat",
    "supports": "support_heat",
    "melting": "meltwater_heat",
}


def heat_ledger(dataset: Data) -> dict[str, float | None]:
    """Heat received and found, J at the end of the run."""
    received, residual = last(dataset, "heat_received"), largest_of(dataset, "heat_residual")
    found = {sink: last(dataset, name) for sink, name in SINKS.items() if name in dataset}
    rubs = "railing_heat" in dataset and dataset["railing_heat"].values.any()
    rubbed = {"from_railing": last(dataset, "railing_heat")} if rubs else {}
    return {
        "received": received,
        **rubbed,
        **found,
        "residual": last(dataset, "heat_residual"),
        "largest_residual": residual,
        "relative_residual": ratio(residual, received),
    }


def heat_shares(dataset: Data) -> dict[str, float | None]:
    """Share of the heat received, at the contact and from elsewhere, that each sink holds at the
    end; supports that give heat hold none.

    from_contact_to_belt: share of the contact's that entered the belt there, part of which went on
    to the air.
    """
    received = last(dataset, "heat_received") + float(other_heat(dataset)[-1])
    shares = {
        sink: ratio(float(held(dataset, name)[-1]), received)
        for sink, name in SINKS.items()
        if name in dataset
    }
    if "belt_share" in dataset:
        shares["from_contact_to_belt"] = last(dataset, "belt_share")
    return shares


def other_heat(dataset: Data) -> np.ndarray:
    """What entered the belt beside the contact's heat, J: of its rubbing on the railing, and of
    supports that gave more than they took; (times,)."""
    railing, supports = (
        dataset[name].values if name in dataset else np.zeros(dataset.sizes["time"])
        for name in ("railing_heat", "support_heat")
    )
    return np.asarray(railing + np.maximum(-supports, 0.0))


def held(dataset: Data, name: str) -> np.ndarray:
    """Heat that a sink holds, J: (times,); none where supports have given more than they took."""
    values = dataset[name].values
    return np.maximum(values, 0.0) if name == SINKS["supports"] else values


def coupling_ledger(dataset: Data) -> dict[str, float | None]:
    """Joules that the mechanics handed over and that the thermal model took."""
    heat, received = dataset["heat"].values, dataset["heat_received"].values
    handed, taken = growth(dataset, "heat"), growth(dataset, "heat_received")
    difference = (heat - heat[0]) - (received - received[0])
    largest = float(np.nanmax(np.abs(difference), initial=0.0))
    ledger = {
        "handed_over": handed,
        "taken_up": taken,
        "largest_difference": largest,
        "relative_difference": ratio(largest, handed),
    }
    if "coupling_residual" in dataset:
        ledger["largest_total_residual"] = largest_of(dataset, "coupling_residual")
    return ledger


def temperatures(dataset: Data) -> dict[str, dict[str, float | None]]:
    """End, extremes and rise over the ambient air of each recorded temperature."""
    ambient = ambient_degC(dataset)
    found: dict[str, dict[str, float | None]] = {"ambient": {"value_degC": ambient}}
    for place in TEMPERATURES:
        if f"{place}_temperature" in dataset:
            values = dataset[f"{place}_temperature"].values
            end, (low, high) = float(values[-1]), extremes(values)
            warmest = None if high is None else high - ambient
            degrees = {"end_degC": end, "min_degC": low, "max_degC": high}
            found[place] = degrees | {"end_rise": end - ambient, "max_rise": warmest}
    return found


def end_of_sliding(dataset: Data) -> dict[str, float | str | None]:
    """What the interface comes to if the sliding goes on for ever, and when it is near that.

    Steady sliding with the mean friction heat after the ramp, on a belt that gives as much to the
    air as in this run. Nothing for a run without such a time, nor for a mesh, which takes long.
    """
    from thermal import NoSteadyState
    from thermal.steady_sliding import in_the_end

    speed, ramp = abs(value_of(dataset, "surface", "speed") or 0.0), ramp_end(dataset)
    late = dataset.sel(time=slice(ramp, None))
    if late.sizes["time"] < 2 or speed == 0.0 or value_of(dataset, "ice", "mesh") != "":
        return {}
    power = float((late["heat"][-1] - late["heat"][0]) / (late["time"][-1] - late["time"][0]))
    if not power > 0.0:
        return {}
    try:
        thermal = thermal_of(dataset)
        end = in_the_end(thermal, speed, power / speed, ramp)
    except NoSteadyState as error:
        return {"reason": f"no end: {error}"}
    if end.rise is None:
        why = "none: the face of the block comes to melt, and stays at its melting point"
        return {"reason": why}
    return {
        "interface_rise": end.rise,
        "interface_degC": ambient_degC(dataset) + end.rise,
        "reached": end.reached,
        "within": end.within,
        "air_heat_transfer": thermal.belt.film,
        "still_air_heat_transfer": still_air_film(dataset),
        "speed": speed,
    }


def ambient_degC(dataset: Data) -> float:
    """Temperature of the air, degC; the first interface temperature where it is not stated."""
    stated = value_of(dataset, "ambient", "temperature_degC")
    return float(dataset["interface_temperature"][0] if stated is None else stated)


def last(dataset: Data, name: str) -> float:
    """The value at the end."""
    return float(dataset[name][-1])


def largest_of(dataset: Data, name: str) -> float:
    """The largest size that is known; 0 where none is."""
    return float(np.nanmax(np.abs(dataset[name].values), initial=0.0))


#: What a run is like before melting and at its end: means over so long, s.
WINDOW = 1.0
#: Water that is thinner than a molecule, m, is what rounding leaves of a film that froze.
THINNEST = 3e-10


class Film(NamedTuple):
    """Water and friction over time, each (n,).

    film_thickness: mean over the contact, m; film_fed_by_melting: what the melting of the moment
    alone would feed. friction_stress, Pa. whole_film_shear, water_shear: of the film if it covered
    the whole contact, and of the water as mixed_lubrication has it, Pa. largest_flooded_share,
    flooded_share: of the contact, the most that friction allows and what is flooded there.
    """

    film_thickness: Array
    film_fed_by_melting: Array
    friction_stress: Array
    whole_film_shear: Array
    largest_flooded_share: Array
    flooded_share: Array
    water_shear: Array


def melts(dataset: Data) -> bool:
    """Whether any ice melted."""
    return "melted_mass" in dataset and float(dataset["melted_mass"].max()) > 0.0


def melting_begins(dataset: Data) -> float:
    """Time of the last row before any ice melted, s."""
    melted = dataset["melted_mass"].values > 0.0
    return float(dataset["time"].values[max(0, int(np.argmax(melted)) - 1)])


def normal_force(dataset: Data) -> float:
    """Of the block as it is, with what its mass departs by, N."""
    return float(mechanics_of(dataset).pack()[P_NORMAL_FORCE])


def friction_coefficient(dataset: Data) -> Array:
    """Friction over normal force, (n,); not a number where the block sticks."""
    force = np.hypot(dataset["friction_force_x"].values, dataset["friction_force_y"].values)
    slips = dataset["mode"].values == SLIP
    return np.where(slips, force / normal_force(dataset), np.nan)


def film_of(dataset: Data) -> Film:
    """Film and friction at every row; not a number in stick, and where there is no water."""
    p = mechanics_of(dataset).pack()
    pressure = p[P_NORMAL_FORCE] / (np.pi * p[P_RADIUS] ** 2)
    film, slips = dataset["film_thickness"].values, dataset["mode"].values == SLIP
    thickness = np.where((film > THINNEST) & slips, film, np.nan)
    friction = pressure * friction_coefficient(dataset)
    sheared, roughness = p[P_MIXED_LUBRICATION_COUETTE], p[P_MIXED_LUBRICATION_ROUGHNESS]
    couette = pressure * sheared * dataset["sliding_speed"].values / thickness
    flooded = p[P_MIXED_LUBRICATION_SHARE] * thickness / (thickness + roughness)
    # of a film that is not sheared the whole contact
    at_most = np.sqrt(friction / np.maximum(np.maximum(friction, couette), TINY))
    return Film(thickness, _fed(dataset), friction, couette, at_most, flooded, flooded**2 * couette)


def _fed(dataset: Data) -> Array:
    """Melt rate times residence: what a film is that no water comes back to, m."""
    from thermal.materials import WATER_DENSITY

    lane = min(2.0 * value_of(dataset, "rig", "contact_radius"), value_of(dataset, "belt", "width"))
    if value_of(dataset, "ice", "mesh"):
        lane = np.nan  # the breadth is the mesh's
    speed = dataset["sliding_speed"].values
    slips = (dataset["mode"].values == SLIP) & (speed > 0.0)
    return dataset["melt_rate"].values / np.where(slips, WATER_DENSITY * lane * speed, np.nan)


def melting(dataset: Data) -> dict[str, float | None]:
    """What melted since when, and the balance of the film over the last second."""
    begin, end = melting_begins(dataset), last(dataset, "time")
    melted = last(dataset, "melted_mass")
    before = dataset.sel(time=slice(begin - WINDOW, begin))
    late = dataset.sel(time=slice(end - WINDOW, None))
    return {
        "onset": begin,
        "melted_mass": melted,
        "refrozen_mass": last(dataset, "refrozen_mass"),
        "wiped_ice_mass": last(dataset, "wiped_ice_mass"),
        "mean_melt_rate": ratio(melted, end - begin),
        "max_melt_rate": float(dataset["melt_rate"].max()),
        "melting_share": _share(dataset.sel(time=slice(begin, None))),
        "friction_before": mean_of(friction_coefficient(before)),
        "melting_share_end": _share(late),
        "friction_end": mean_of(friction_coefficient(late)),
        **{key: mean_of(each) for key, each in film_of(late)._asdict().items()},
    }


def extremes(values: Array) -> tuple[float, float] | tuple[None, None]:
    """Lowest and highest of what is a number; None where nothing is."""
    known = values[np.isfinite(values)]
    return (float(known.min()), float(known.max())) if known.size else (None, None)


def growth(rows: Data, name: str) -> float:
    """From the first row to the last."""
    return float(rows[name].values[-1] - rows[name].values[0])


def _share(rows: Data) -> float | None:
    """Of the friction heat of some rows, what melting took less what freezing gave back."""
    return ratio(growth(rows, "meltwater_heat"), growth(rows, "heat"))


def mean_of(values: Array) -> float | None:
    """Mean of what is a number; None where nothing is."""
    known = values[np.isfinite(values)]
    return float(known.mean()) if known.size else None
