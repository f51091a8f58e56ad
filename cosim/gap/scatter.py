"""How far friction scatters, from run to run and from stick to stick, and what that costs.

A scatter is no number of the rig's that is known: it is averaged over, in the rows in closed form
(`weak_form.system`), in fits of simulated runs by what they have found of each run's and of each
stick's own friction. A model with the law that friction follows needs less scatter, and this is
how it gains by it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import logsumexp

from cosim.gap.quantities import with_digits
from cosim.gap.weak_form.constants import (
    SCATTER_ASKED,
    SCATTER_RANGE,
    STATIC_FLOOR,
    STICK_SCATTER,
)
from cosim.gap.weak_form.system import Rung
from cosim.gap.windows import Fitted

#: Value and 90 % interval.
Interval = tuple[float, float, float]


@dataclass(frozen=True)
class Scatter:
    """Of friction from run to run, a part of it: median and 90 % interval.

    seen : as the rows alone have it; expected : with what the campaign expects beforehand
    """

    seen: Interval
    expected: Interval

    @classmethod
    def of(cls, rung: Rung) -> Scatter:
        """As a rung's rows have it."""
        spreads, *weights = rung.scatter_posterior()
        shares = [np.interp([0.5, 0.05, 0.95], np.cumsum(w), spreads).tolist() for w in weights]
        return cls(*(tuple(share) for share in shares))


def is_determined(scatter: Interval) -> bool:
    """Whether its interval leaves out the least scatter that is asked for."""
    return scatter[1] > 2.0 * SCATTER_RANGE[0]


def scatter_text(scatter: Interval) -> str:
    """In a sentence; at most so much where it is not determined."""
    value, low, high = with_digits(*(100.0 * part for part in scatter))
    if not is_determined(scatter):
        return f"friction scatters from run to run by at most {high} %"
    return f"friction scatters from run to run by {value} % ({low} to {high} %)"


def averaged_over(fitted: Fitted, assumed: float, expected: float) -> float:
    """ln of how much more probable a fit is with its scatters averaged over than as assumed.

    assumed : standard deviation of the runs' own friction in the fit, expected : beforehand. Of
    sticks the fit assumes what is expected of them.
    """
    own = [label for label in fitted.values if label.startswith("offset.friction@")]
    values = np.array([fitted.values[label] for label in own])
    of_runs = _averaged(values, np.array([fitted.sd[label] for label in own]), assumed, expected)
    sticks = np.concatenate([np.zeros(0), *(run.states[:, 6:].ravel() for run in fitted.runs)])
    sticks = sticks[sticks != 0.0]
    read = np.full(sticks.size, STATIC_FLOOR)
    return of_runs + _averaged(sticks, read, STICK_SCATTER, STICK_SCATTER)


def _averaged(own: np.ndarray, sd: np.ndarray, assumed: float, expected: float) -> float:
    """Of numbers (n,) as fitted, known to sd (n,), under a scatter that is assumed.

    What the data alone say of each has the mean m and the variance v, 1/v = 1/sd^2 - 1/assumed^2;
    under a scatter s it is N(m; 0, s^2 + v), and s is half-normal, as expected.
    """
    told = sd < 0.999 * assumed
    if not told.any():
        return 0.0
    variance = 1.0 / (1.0 / sd[told] ** 2 - 1.0 / assumed**2)
    mean = own[told] * (variance / sd[told] ** 2)
    asked = np.array([*SCATTER_ASKED, assumed])
    spread = asked[:, None] ** 2 + variance
    densities = -0.5 * np.sum(mean**2 / spread + np.log(spread), axis=1)
    weights = -0.5 * (asked[:-1] / expected) ** 2
    return float(logsumexp(densities[:-1] + weights - logsumexp(weights)) - densities[-1])
