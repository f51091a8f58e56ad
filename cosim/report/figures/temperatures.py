"""Temperatures of contact and belt over time: rises over the air."""

from __future__ import annotations

import numpy as np
import xarray as xr

from cosim.report.heat_numbers import ambient_degC
from cosim.report.live import Curve, Panel
from cosim.report.style import BLUE, GREEN, INK, RED, readable

from .over_time import TimeFigure

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


def temperatures(dataset: xr.Dataset) -> TimeFigure:
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
    return TimeFigure(f"Temperatures in air at {air} °C", panels, height=2.2, share_y=False)


def _difference(dataset: xr.Dataset) -> Panel:
    difference = dataset[ICE].values - dataset[CONTACT].values
    scaled = readable(difference, "K", SMALLEST_RISE)
    return Panel(
        f"ice less contact [{scaled.unit}]",
        [Curve("face of the ice less contact", scaled(difference), INK)],
        span=scaled.factor * SMALLEST_RISE,
    )
