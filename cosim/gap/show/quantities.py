"""Parameters as a reader sees them: unit, meaning, number of digits."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from stickslip.effects.candidate import SECOND

from cosim.gap.camera import faults
from cosim.gap.estimation.drive import LOADING, REFERENCE, SCALING, STIFFNESS_OFFSET
from cosim.scenario import Scenario

#: Of the tracker and the drive, not of the model.
OFFSETS = {
    "offset.x": ("m", "zero of the tracker along x"),
    "offset.y": ("m", "zero of the tracker along y"),
    "offset.speed": ("", "part by which the surface is faster than its set-point"),
    LOADING: ("s^0.5", "static friction lacking where springs load by m g in 1 s, a part"),
    "speed_ripple.wavelength": ("m", "travel of the surface in one period of its speed"),
} | {
    f"{effect}.{part}": ("", f"second harmonic {how}, as part of the first's amplitude")
    for effect in ("speed_ripple", "surface_pattern")
    for part, how in zip(SECOND, ("in phase", "a quarter of its period ahead"), strict=True)
}
#: The same in a word or two, for a line of a terminal; of springs by their set-up.
BRIEFLY = {
    "offset.x": "tracker's zero",
    "offset.y": "tracker's zero",
    "offset.speed": "surface faster by this part",
    LOADING: "static friction lost to fast loading",
}
#: Units of what a strength may go with.
SCALES = {"mass": "kg", "speed": "m/s", "stiffness": "N/m"}
#: Part of a number's own size that is rounding.
ROUNDING = 1e-12
PLAIN = ("friction.mu_s", "friction.mu_k")


@dataclass(frozen=True)
class Quantity:
    """A fitted number with its 95 % interval (None: not known), unit "" for pure numbers.

    undetermined : the interval is all that the number may be, and the value only where a fit ended
    """

    key: str
    value: float
    interval: tuple[float, float] | None
    unit: str
    meaning: str
    undetermined: bool = False

    @property
    def text(self) -> str:
        """`key = value unit (low to high)`, or `key not determined, anything from low to high`."""
        unit = f" {self.unit}" if self.unit else ""
        if self.undetermined and self.interval is not None:
            low, high = self.interval
            return f"{self.key} not determined, anything from {low:.4g} to {high:.4g}{unit}"
        said = f"{self.key} = {self.value:.4g}{unit}"
        if self.interval is None:
            return said
        return f"{said} ({self.interval[0]:.4g} to {self.interval[1]:.4g})"

    @property
    def line(self) -> str:
        """As `text`, with a word or two behind a name that is no key of a scenario."""
        brief = _briefly(self.key)
        return f"{self.text}, {brief}" if brief else self.text


def _briefly(key: str) -> str:
    if key.startswith(STIFFNESS_OFFSET):
        setup = int(key.removeprefix(STIFFNESS_OFFSET)) + 1
        return f"springs of set-up {setup} stiffer, logarithm"
    return BRIEFLY.get(key, "")


def unit_and_meaning(key: str) -> tuple[str, str]:
    """Of `block.parameter`; the unit is "" for a pure number."""
    if key in OFFSETS:
        return OFFSETS[key]
    if faults.is_fault(key):
        return faults.QUANTITIES[key]
    if key.startswith(STIFFNESS_OFFSET):
        setup = int(key.removeprefix(STIFFNESS_OFFSET)) + 1
        return "", f"logarithm by which the springs of set-up {setup} are stiffer than stated"
    if key.startswith(SCALING):
        quantity, effect = key.removeprefix(SCALING).split(".")
        return "", f"power of the {quantity} by which the strength of {effect} goes"
    if key.startswith(REFERENCE):
        quantity = key.removeprefix(REFERENCE)
        return SCALES[quantity], f"{quantity} at which a strength is what it says"
    block, _, name = key.partition(".")
    table: Any = Scenario.model_fields[block].annotation  # a class of keys
    field = table.model_fields[name.partition("[")[0]]  # one of several numbers is as all of them
    unit = (field.json_schema_extra or {}).get("unit", "1")
    return ("" if unit == "1" else unit), field.description


def quantities(
    values: Mapping[str, float],
    intervals: Mapping[str, Any],
    keys: Iterable[str] | None = None,
    undetermined: Collection[str] = (),
) -> list[Quantity]:
    """Of the keys wanted (all when left out), in the order of ``values``.

    undetermined : keys whose interval is the whole range that a fit allows
    """
    wanted = values if keys is None else [key for key in values if key in set(keys)]
    found = []
    for key in wanted:
        pair = _interval(intervals.get(key))
        size = max(map(abs, pair)) if pair else 1.0
        shown = (_shown(pair[0], size), _shown(pair[1], size)) if pair else None
        value, words = _shown(float(values[key]), size), unit_and_meaning(key)
        found.append(Quantity(key, value, shown, *words, key in undetermined))
    return found


def _shown(value: float, size: float) -> float:
    """Without what is only rounding beside a size."""
    return 0.0 if abs(value) <= ROUNDING * size else value


def _interval(pair: tuple[float, float] | None) -> tuple[float, float] | None:
    """None for one that is a point, or reaches to infinity: nothing is known of it."""
    if pair is None or not 0.0 < pair[1] - pair[0] < math.inf:
        return None
    return float(pair[0]), float(pair[1])
