"""Numbers of the heat: where it went, how warm it got, what the coupling lost."""

from __future__ import annotations

import numpy as np
import xarray as xr

from .blocks import value_of
from .quantities import Quantity, ratio

TEMPERATURES = (
    "interface_temperature",
    "belt_entry_temperature",
    "belt_exit_temperature",
    "ice_face_temperature",
)
SINKS = {
    "belt": "belt_heat",
    "ice": "ice_heat",
    "air": "air_heat",
    "supports": "support_heat",
    "melting": "meltwater_heat",
}


def heat_ledger(dataset: xr.Dataset) -> dict[str, Quantity]:
    """Heat received and found, J at the end of the run."""
    received = _last(dataset, "heat_received")
    residual = _largest(dataset, "heat_residual")
    found = {
        sink: Quantity(_last(dataset, name), "J") for sink, name in SINKS.items() if name in dataset
    }
    railing = other_heat(dataset)["railing"]
    rubbed = {"from_railing": Quantity(float(railing[-1]), "J")} if railing.any() else {}
    return {
        "received": Quantity(received, "J"),
        **rubbed,
        **found,
        "residual": Quantity(_last(dataset, "heat_residual"), "J"),
        "largest_residual": Quantity(residual, "J"),
        "relative_residual": Quantity(ratio(residual, received), "1"),
    }


def heat_shares(dataset: xr.Dataset) -> dict[str, Quantity]:
    """Share of the heat received, at the contact and from elsewhere, that each sink holds at the
    end; supports that give heat hold none.

    from_contact_to_belt: share of the contact's that entered the belt there, part of which went on
    to the air.
    """
    received = _last(dataset, "heat_received") + float(sum(other_heat(dataset).values())[-1])
    shares = {
        sink: Quantity(ratio(float(held(dataset, name)[-1]), received), "1")
        for sink, name in SINKS.items()
        if name in dataset
    }
    if "belt_share" in dataset:
        shares["from_contact_to_belt"] = Quantity(_last(dataset, "belt_share"), "1")
    return shares


def other_heat(dataset: xr.Dataset) -> dict[str, np.ndarray]:
    """What entered the belt beside the contact's heat, J, each (times,).

    From its rubbing on the railing, and from supports that gave more than they took.
    """
    none = np.zeros(dataset.sizes["time"])
    railing = dataset["railing_heat"].values if "railing_heat" in dataset else none
    supports = dataset["support_heat"].values if "support_heat" in dataset else none
    return {"railing": railing, "supports": np.maximum(-supports, 0.0)}


def held(dataset: xr.Dataset, name: str) -> np.ndarray:
    """Heat that a sink holds, J: (times,); none where supports have given more than they took."""
    values = dataset[name].values
    return np.maximum(values, 0.0) if name == SINKS["supports"] else values


def coupling_ledger(dataset: xr.Dataset) -> dict[str, Quantity]:
    """Joules that the mechanics handed over and that the thermal model took."""
    heat, received = dataset["heat"].values, dataset["heat_received"].values
    handed, taken = float(heat[-1] - heat[0]), float(received[-1] - received[0])
    difference = (heat - heat[0]) - (received - received[0])
    largest = float(np.nanmax(np.abs(difference), initial=0.0))
    ledger = {
        "handed_over": Quantity(handed, "J"),
        "taken_up": Quantity(taken, "J"),
        "largest_difference": Quantity(largest, "J"),
        "relative_difference": Quantity(ratio(largest, handed), "1"),
    }
    if "coupling_residual" in dataset:
        ledger["largest_total_residual"] = Quantity(_largest(dataset, "coupling_residual"), "J")
    return ledger


def temperatures(dataset: xr.Dataset) -> dict[str, dict[str, Quantity]]:
    """End, extremes and rise over the ambient air of each recorded temperature."""
    ambient = ambient_degC(dataset)
    found: dict[str, dict[str, Quantity]] = {"ambient": {"value_degC": Quantity(ambient, "degC")}}
    for name in TEMPERATURES:
        if name not in dataset:
            continue
        values = dataset[name].values
        known = values[np.isfinite(values)]
        low, high = (known.min(), known.max()) if known.size else (None, None)
        found[name.removesuffix("_temperature")] = {
            "end_degC": Quantity(float(values[-1]), "degC"),
            "min_degC": Quantity(low, "degC"),
            "max_degC": Quantity(high, "degC"),
            "end_rise": Quantity(float(values[-1]) - ambient, "K"),
            "max_rise": Quantity(None if high is None else high - ambient, "K"),
        }
    return found


def ambient_degC(dataset: xr.Dataset) -> float:
    """Temperature of the air, degC; the first interface temperature where it is not stated."""
    stated = value_of(dataset, "ambient", "temperature_degC")
    return float(dataset["interface_temperature"][0] if stated is None else stated)


def _last(dataset: xr.Dataset, name: str) -> float:
    return float(dataset[name][-1])


def _largest(dataset: xr.Dataset, name: str) -> float:
    return float(np.nanmax(np.abs(dataset[name].values), initial=0.0))
