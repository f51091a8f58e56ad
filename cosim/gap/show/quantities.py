"""Numbers as a reader sees them: unit, meaning, digits, and whether the data determine them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from cosim.gap.result import Gap
from cosim.scenario import Scenario

#: Standard deviations to either side in which a number lies with 90 %.
NINETY = 1.645
#: Numbers of tracker and drive: factor from SI, unit shown, meaning. Logarithms are shown as the
#: parts that they are of.
BESIDE_THE_MODEL = {
    "offset.x": (1e3, "mm", "tracker's zero along x"),
    "offset.y": (1e3, "mm", "tracker's zero along y"),
    "offset.speed": (1e2, "%", "surface faster than stated"),
    "offset.friction": (1e2, "%", "friction higher than in the other runs"),
    "offset.stiffness": (1e2, "%", "springs stiffer than stated"),
    "springs.stiffness": (1.0, "", "stiffness over what is stated"),
    "measurement.scale": (1e2, "%", "x and y written too large by the camera"),
    "measurement.clock": (1e2, "%", "times written too long by the camera"),
    "measurement.rotation": (180.0 / math.pi, "°", "turn of the camera's axes"),
    "measurement.drift_rate_x": (1e3, "mm/s", "creep of the camera's zero along x"),
    "measurement.drift_rate_y": (1e3, "mm/s", "creep of the camera's zero along y"),
    "measurement.drift_x": (1e3, "mm", "creep of the camera's zero along x once it has settled"),
    "measurement.drift_y": (1e3, "mm", "creep of the camera's zero along y once it has settled"),
    "measurement.drift_time": (1.0, "s", "time in which the camera's zero settles"),
    "measurement.latency": (1e3, "ms", "how much later a place 0.1 m further along x is seen"),
    "measurement.smoothing": (1e3, "ms", "standard deviation of the tracker's filter"),
    "measurement.smoothing_past": (1e3, "ms", "time constant of the tracker's filter"),
    "measurement.quantisation": (1e3, "mm", "step of the numbers that the tracker writes"),
}
#: Points of a curve that stands in a figure.
TABLES = "friction.table_"


@dataclass(frozen=True)
class Quantity:
    """A number in words.

    owner : a run or a set-up; "" for the campaign; value, interval : text; an interval of 90 %
    """

    key: str
    owner: str
    meaning: str
    value: str
    interval: str
    unit: str

    @property
    def text(self) -> str:
        """`key = value unit (low to high)`; what a scenario has no key for by its meaning."""
        name = self.meaning if self.key in BESIDE_THE_MODEL else self.key
        if not self.value[-1:].isdigit():
            return f"{name} {self.value}"
        said = f"{name} = {self.value}{' ' * bool(self.unit)}{self.unit}"
        return f"{said} ({self.interval})" if self.interval else said


def fitted_quantities(gap: Gap) -> list[Quantity]:
    """Numbers of the extended model: friction, what was added, then what is of a run or set-up."""
    fitted = gap.extended
    open_keys = undetermined(gap)
    labels = [label for label in fitted.values if not label.startswith(TABLES)]
    labels.sort(key=lambda label: ("@" in label, label.partition("@")[2]))
    found = []
    for label in labels:
        value, sd = fitted.values[label], NINETY * fitted.sd[label]
        span = named_intervals(gap).get(label, (value - sd, value + sd))
        instead = "at its bound" if label in fitted.at_bound else ""
        found.append(
            quantity(label, value, span, "not determined" if label in open_keys else instead)
        )
    return found


def named_intervals(gap: Gap) -> dict[str, tuple[float, float]]:
    """Intervals that the search found of what the extended model has, where its value is inside."""
    known = gap.extended.values
    return {
        key: (float(low), float(high))
        for row in gap.ranking
        if row.effect in gap.effects
        for key, (low, high) in row.intervals.items()
        if key in known and low <= known[key] <= high and math.isfinite(high - low)
    }


def undetermined(gap: Gap) -> set[str]:
    """Labels of the extended model of which the data say nothing: any value fits as well."""
    said = {key for row in gap.ranking if row.effect in gap.effects for key in row.undetermined}
    fitted = gap.extended
    return {
        label
        for label, sd in fitted.sd.items()
        if label in said
        or not math.isfinite(sd)
        or (_is_strength(label) and _is_open(fitted, label))
    }


def _is_strength(label: str) -> bool:
    """Whether 0 would be no number of friction, springs or an effect, unlike of an offset."""
    return not label.startswith(("offset.", "measurement."))


def _is_open(fitted: Any, label: str) -> bool:
    return fitted.sd[label] > abs(fitted.values[label]) > 0.0


def quantity(
    label: str, value: float, interval: tuple[float, float] | None, instead: str = ""
) -> Quantity:
    """A number in the unit that it is read in. instead : said in place of the value."""
    key, _, owner = label.partition("@")
    factor, unit, meaning = _presented(key)
    if instead:
        return Quantity(key, _owner(owner), meaning, instead, "", unit)
    if interval is None or not all(map(math.isfinite, interval)):
        return Quantity(key, _owner(owner), meaning, digits(factor * value), "", unit)
    value_text, *ends = with_digits(factor * value, *(factor * end for end in interval))
    return Quantity(key, _owner(owner), meaning, value_text, " to ".join(ends), unit)


def _owner(owner: str) -> str:
    number = owner.removeprefix("setup ")
    return f"set-up {int(number) + 1}" if number != owner else owner


def _presented(key: str) -> tuple[float, str, str]:
    """Factor, unit and meaning."""
    if key in BESIDE_THE_MODEL:
        return BESIDE_THE_MODEL[key]
    unit, meaning = unit_and_meaning(key)
    return 1.0, unit, meaning


def unit_and_meaning(key: str) -> tuple[str, str]:
    """Of `block.parameter` in SI; the unit is "" for a pure number."""
    block, _, name = key.partition(".")
    fields = getattr(Scenario.model_fields.get(block), "annotation", None)
    field: Any = getattr(fields, "model_fields", {}).get(name.partition("[")[0])
    if field is None:
        return "", name.replace("_", " ")
    unit = (field.json_schema_extra or {}).get("unit", "1")
    return ("" if unit == "1" else unit), field.description


def with_digits(value: float, *others: float) -> list[str]:
    """Numbers with the decimals that their spread deserves: two digits of half of it."""
    half = 0.5 * float(np.ptp([value, *others]))
    if not half > 0.0 or not math.isfinite(half):
        return [digits(one) for one in (value, *others)]
    decimals = 1 - math.floor(math.log10(half))
    if decimals > 7 or max(map(abs, (value, *others))) >= 1e6:
        return [digits(one) for one in (value, *others)]
    return [
        _minus(f"{round(one, decimals) + 0.0:.{max(decimals, 0)}f}") for one in (value, *others)
    ]


def digits(value: float | None, count: int = 3) -> str:
    """So many significant digits, no power of ten for usual sizes; a dash for none."""
    if value is None or not math.isfinite(value):
        return "–"
    if 1e-4 <= abs(value) < 1e6:
        places = max(count - 1 - math.floor(math.log10(abs(value))), 0)
        return _minus(f"{round(value, places):.{places}f}")
    return _minus(f"{value:.{count}g}")


def _minus(text: str) -> str:
    return text.replace("-", "−")
