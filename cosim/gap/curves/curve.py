"""A curve with its band: what an effect's law looks like, whatever the catalogue holds."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.stats import ttest_1samp

#: Of the axes.
UNITS = {
    "sliding speed": "m/s",
    "hold time": "s",
    "heat memory": "J",
    "distance": "m",
    "place": "m",
    "load": "N",
    "position": "m",
    "time": "s",
    "velocity": "m/s",
}


@dataclass(frozen=True)
class Curve:
    """An effect's law over its axis, in the runs' own range.

    Attributes
    ----------
    axis : of `stickslip.effects.effect.AXES`
    on : what it moves: "mu_k", "mu_s", "both", or "force", a force along x on the block
    values : (n,) of the axis, in its unit
    mean, low, high : (n,) logarithm of the factor by which friction is larger than on the mean of
        the axis, or force, N, and its 90 % band
    gain : -2 ln likelihood that it takes away of all runs, each predicted from the others
    error : standard error of that, by run
    gains : (runs,) of each
    level : mu_k where the curve is 0
    memory : time after which heat is forgotten, s, of heat memory alone
    per : "mass" where the axis counts for each kilogram of the block; or ""
    """

    axis: str
    on: str
    values: np.ndarray = field(repr=False)
    mean: np.ndarray = field(repr=False)
    low: np.ndarray = field(repr=False)
    high: np.ndarray = field(repr=False)
    gain: float
    error: float
    gains: np.ndarray = field(repr=False)
    level: float
    memory: float = 0.0
    per: str = ""

    @property
    def unit(self) -> str:
        """Of the axis."""
        return UNITS[self.axis] + ("/kg" if self.per == "mass" else "")

    def helps(self, level: float = 0.05) -> bool:
        """Whether it predicts runs better than no curve does, run by run (Student's t)."""
        return bool(ttest_1samp(self.gains, 0.0, alternative="greater").pvalue < level)

    def is_told_from(self, other: Curve, level: float = 0.05) -> bool:
        """Whether it predicts runs better than the other, run by run (Student's t of the pairs)."""
        pairs = self.gains - other.gains
        return bool(ttest_1samp(pairs, 0.0, alternative="greater").pvalue < level)
