"""Colours of figures, and the units in which their numbers are read."""

from typing import NamedTuple

import numpy as np

from cosim.report.columns import Array

from .page import unit_text

# Okabe and Ito's palette: told apart with any kind of colour vision, and unequal in grey
SERIES = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
BLUE, RED, GREEN, PURPLE, ORANGE, SKY = SERIES
LIGHT_BLUE, PALE_BLUE, FAINT_BLUE = "#8FBFDD", "#CFE3F1", "#D3E5F0"
INK, GREY = "#222222", "#7A7A7A"
# of words: enough contrast with white
DARK_RED = "#A34700"
# from dark to pale, for what stands behind or is of no weight
SOFT_GREY, LIGHT_GREY, PALE_GREY = "#CFCFCF", "#E3E3E3", "#EDEDED"
SAND, SLIP = "#F3D9A4", "#F8EAD0"
#: Colours of temperatures: from dark to bright, read alike with any kind of colour vision.
HEAT_MAP = "inferno"

PREFIXES = ((1e-9, "n"), (1e-6, "µ"), (1e-3, "m"), (1.0, ""), (1e3, "k"), (1e6, "M"))


class Scaled(NamedTuple):
    """Values in the unit that makes them readable: value [unit] = factor * SI value."""

    factor: float
    unit: str

    def __call__(self, values: Array) -> Array:
        return self.factor * np.asarray(values, float)


def readable(values: Array, unit: str, floor: float = 0.0) -> Scaled:
    """The SI prefix with which the largest magnitude lies in 1 ... 1000.

    floor: magnitude (SI) below which values are nothing and choose no smaller prefix.
    """
    spelled = unit_text(unit)
    finite = np.abs(values[np.isfinite(values)])
    largest = max(float(finite.max(initial=0.0)), floor)
    if spelled in ("1", "°C", "°") or largest == 0.0:
        return Scaled(1.0, spelled)
    size, prefix = max(filter(lambda one: largest >= one[0], PREFIXES), default=PREFIXES[0])
    return Scaled(1.0 / size, prefix + spelled)
