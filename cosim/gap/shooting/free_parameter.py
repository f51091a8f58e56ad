"""What a fit may turn: a parameter of the model or of the tracker, with its range."""

from __future__ import annotations

import math
from dataclasses import dataclass

#: Free parameters of the tracker, not of the model: where its zero lies.
OFFSETS = ("offset.x", "offset.y")


@dataclass(frozen=True)
class FreeParameter:
    """A number to be fitted.

    Attributes
    ----------
    key : `block.parameter` of the model, one of OFFSETS (m), or of the drive
    start : first guess
    step : change that is felt but small: scale of the fit and of its differences
    low, high : bounds
    per_run : its own value in every run (a phase), else one for the campaign
    prior : standard deviation about ``start`` that is known beforehand, or None
    log : fitted on a logarithmic scale; ``step`` is then relative
    plain_below : at ``low``, and beyond it, what it belongs to is a plain number by another name
    """

    key: str
    start: float
    step: float
    low: float = -math.inf
    high: float = math.inf
    per_run: bool = False
    prior: float | None = None
    log: bool = False
    plain_below: bool = False

    def inside(self, value: float) -> float:
        """The nearest allowed value to ``value``, on the scale of the fit."""
        low, high = (self.scaled(self.low), self.scaled(self.high))
        return min(max(value, low), high)

    def scaled(self, value: float) -> float:
        """From the parameter to the scale of the fit, where steps are of the order of one."""
        if self.log:
            return math.log(value) / self.step if value > 0.0 else -math.inf
        return value / self.step

    def value(self, scaled: float) -> float:
        """From the scale of the fit to the parameter."""
        return math.exp(scaled * self.step) if self.log else scaled * self.step
