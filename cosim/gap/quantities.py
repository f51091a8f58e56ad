"""Numbers as a reader sees them: unit, meaning, digits, and whether the data determine them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from stickslip.catalogue import CATALOGUE, Catalogue
from stickslip.packaged import packaged_tables

from cosim.gap.result import NINETY, Gap
from cosim.report.page import unit_text
from cosim.scenario import Scenario
from cosim.scenario.validation import known_keys, unit_of

WORDS = packaged_tables(__package__, "words.toml")
#: Numbers of tracker and drive: factor from SI, unit shown, meaning.
BESIDE_THE_MODEL: dict[str, list[Any]] = WORDS["beside_the_model"]
#: Points of a curve that stands in a figure.
TABLES = "friction.table_"


@dataclass(frozen=True)
class Quantity:
    """A number in words.

    owner : a run or a set-up; "" for the campaign. value, interval : text; of 90 %
    """

    key: str
    owner: str
    meaning: str
    value: str
    interval: str
    unit: str

    @property
    def name(self) -> str:
        """Its key, where a scenario has that; else its meaning."""
        return self.meaning if self.key in BESIDE_THE_MODEL else self.key

    def holds(self, value: float) -> bool:
        """Whether a value in the unit shown is in the interval, to its digits."""
        low, high = (float(end.replace("−", "-")) for end in self.interval.split(" to "))
        digit = 0.02 * (high - low)
        return low - digit <= value <= high + digit

    @property
    def text(self) -> str:
        """`name = value unit (low to high)`, or `name not determined`."""
        if not self.value[-1:].isdigit():
            return f"{self.name} {self.value}"
        return f"{self.name} = {self.value} {unit_text(self.unit)}".rstrip() + (
            f" ({self.interval})" if self.interval else ""
        )


def fitted_quantities(gap: Gap) -> list[Quantity]:
    """Numbers of the extended model: of the campaign, then of each set-up and run."""
    fitted, unknown, found = gap.extended, undetermined(gap), []
    catalogue = gap.campaign.catalogue
    labels = [label for label in fitted.values if not label.startswith(TABLES)]
    for label in sorted(labels, key=lambda label: ("@" in label, label.partition("@")[2])):
        value, sd = float(fitted.values[label]), NINETY * float(fitted.sd[label])
        instead = "at its bound" if label in fitted.at_bound else ""
        instead = "not determined" if label in unknown else instead
        found.append(quantity(label, value, (value - sd, value + sd), instead, catalogue))
    return found


def undetermined(gap: Gap) -> set[str]:
    """Labels of the extended model of which the data say nothing.

    Where a number that is no offset has a standard deviation as large as itself, or the search
    found that any value does.
    """
    values, sd = gap.extended.values, gap.extended.sd
    said = {key for row in gap.ranking for key in row.undetermined}
    return {
        label
        for label in sd
        if label in said
        or not math.isfinite(sd[label])
        or (label.partition("@")[0] not in BESIDE_THE_MODEL and sd[label] > abs(values[label]) > 0)
    }


def quantity(
    label: str, value: float, interval: tuple[float, float] | None, instead: str = "",
    catalogue: Catalogue = CATALOGUE,
) -> Quantity:  # fmt: skip
    """A number in the unit that it is read in. instead : said in place of the value; catalogue :
    of the effects that it may be of."""
    key, _, owner = label.partition("@")
    if owner.startswith("setup "):
        owner = f"set-up {int(owner.removeprefix('setup ')) + 1}"
    factor, unit, meaning = BESIDE_THE_MODEL.get(key) or (1.0, *unit_and_meaning(key, catalogue))
    if instead:
        return Quantity(key, owner, meaning, instead, "", unit)
    ends = interval if interval and 0.0 < np.ptp(interval) < math.inf else ()
    shown, *around = with_digits(*(factor * number for number in (value, *ends)))
    return Quantity(key, owner, meaning, shown, " to ".join(around), unit)


def unit_and_meaning(key: str, catalogue: Catalogue) -> tuple[str, str]:
    """Of `block.parameter` in SI; the unit is "" for a pure number."""
    field = known_keys(Scenario.of(catalogue)).get(key.partition("[")[0])
    if field is None:
        return "", key.partition(".")[2].replace("_", " ")
    unit = unit_of(field)
    return "" if unit == "1" else unit, str(field.description)


def with_digits(*values: float) -> list[str]:
    """Numbers with the decimals that their spread deserves: two digits of half of it."""
    half = 0.5 * float(np.ptp(values))
    decimals = 1 - math.floor(math.log10(half)) if half > 0.0 else 8
    if decimals > 7 or max(map(abs, values)) >= 1e6:
        return [digits(one) for one in values]
    return [
        f"{round(one, decimals) + 0.0:.{max(decimals, 0)}f}".replace("-", "−") for one in values
    ]


def percent(part: float) -> str:
    """A part in percent; never all of it where some is left."""
    return "all" if part >= 0.9995 else f"{digits(round(100.0 * part, 1))} %" if part else "0 %"


def digits(value: float | None, count: int = 3) -> str:
    """So many significant digits, no power of ten for usual sizes; a dash for none."""
    if value is None or not math.isfinite(value):
        return "–"
    text = f"{value:.{count}g}"
    if 1e-4 <= abs(float(text)) < 1e6:
        places = max(count - 1 - math.floor(math.log10(abs(float(text)))), 0)
        text = f"{float(text):.{places}f}"
    return text.replace("-", "−")
