"""Intervals of fitted parameters against what is true, where both mean the same number.

Compared are mu_k and mu_s where nothing hidden makes friction change with time, place, speed or
load, the exponent of a power of the load, the curvature of a turning surface, the period of a
ripple or a pattern, and the amounts of a camera's faults. Other laws of the laboratory have shapes
that the catalogue does not hold: their numbers have no counterpart. mu of a scattering campaign is
the mean over all runs that could be made. Rotation is compared by size: its sign is a convention.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from statistics import NormalDist

from .answers import FAULT, Row
from .outcome import is_right

WANTED = 0.9  # level of an interval at which coverage is counted

# Hidden things that leave mu_k and mu_s numbers of the contact.
STEADY = {"lateral_friction", "turning_surface", "spring_hardening", "spring_misalignment",
          "structural_damping", "speed_ripple"}  # fmt: skip
# Contacts whose static friction is a number of their own, and not the peak of a curve.
WITH_STATIC = {"jump", "lugre", "elasto_plastic", "iwan"}
# Shape of a fault -> the parameter that is its amount, in the same unit.
AMOUNTS = {
    "scale": f"{FAULT}scale",
    "clock": f"{FAULT}clock",
    "rotation": f"{FAULT}rotation",
    "rolling_shutter": f"{FAULT}latency",
    "smoothing": f"{FAULT}smoothing",
    "lagging": f"{FAULT}smoothing_past",
}
UNSIGNED = {"turning_surface.curvature", f"{FAULT}rotation"}


def deviations(level: float) -> float:
    """Standard deviations either side of a normal estimate in an interval of that level."""
    return NormalDist().inv_cdf(0.5 + level / 2)


@dataclass(frozen=True)
class Compared:
    """A parameter with its standard deviation; its true value, known up to `slack` either way."""

    row: Row
    key: str
    value: float
    sd: float
    true: float
    slack: float = 0.0

    def covers(self, level: float = WANTED) -> bool:
        """Whether the interval of that level, of a normal estimate, holds the true value."""
        return bool(self.distance <= deviations(level))

    @property
    def distance(self) -> float:
        """Of the estimate from the truth, in standard deviations of the estimate."""
        off = max(abs(self.true - self.value) - self.slack, 0.0)
        return off / self.sd if self.sd > 0.0 else math.inf


def rounded(text: str) -> tuple[float, float]:
    """A number written with three digits, and how far the unwritten one may be from it."""
    value = float(text)
    digits = 2 - math.floor(math.log10(abs(value)))
    return value, 0.5 * 10.0**-digits


def true_values(row: Row) -> Iterator[tuple[str, float, float]]:
    """Key, true value, slack: of all parameters that mean the same in both."""
    truth = row.truth
    if truth.contact and truth.kind is None and truth.effects <= STEADY:
        yield "friction.mu_k", float(truth.contact["mu_k"]), 0.0
        if truth.contact["form"] in WITH_STATIC:
            yield "friction.mu_s", float(truth.contact["mu_s"]), 0.0
    for hidden in truth.hidden:
        name, shape, law = hidden["name"], hidden["shape"], hidden["law"]
        if name == "load_dependence" and shape == "power":
            yield "load_dependence.exponent", float(hidden["strength"]), 0.0
        if name == "turning_surface" and shape == "abreast":
            yield "turning_surface.curvature", float(hidden["strength"]), 0.0
        if name == "speed_ripple" and (match := re.search(r"([\d.]+) Hz$", law)):
            yield "speed_ripple.frequency", *rounded(match[1])
        if name == "surface_pattern" and (match := re.search(r"every ([\d.]+) m", law)):
            yield "surface_pattern.wavelength", *rounded(match[1])
        if name.startswith(FAULT) and shape in AMOUNTS:
            yield AMOUNTS[shape], float(hidden["strength"]), 0.0


def compared(row: Row) -> list[Compared]:
    """Parameters of a right answer that can be compared, with their intervals."""
    if row.found is None or not is_right(row) or row.found["verdict"] == "unknown":
        return []
    fitted = row.found.get("extended") or {}
    values, deviation = fitted.get("parameters") or {}, fitted.get("sd") or {}
    found = []
    for key, true, slack in true_values(row):
        if key not in values or deviation.get(key) is None or key in fitted.get("at_bound", ()):
            continue
        value = float(values[key])
        if key in UNSIGNED:
            value, true = abs(value), abs(true)
        found.append(Compared(row, key, value, float(deviation[key]), true, slack))
    return found
