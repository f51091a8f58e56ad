"""How far friction scatters, from run to run and from stick to stick, and what that costs.

A scatter is no number of the rig's that is known: it is averaged over, in the rows in closed form
(`weak_form.system`), in fits of simulated runs by what they have found of each run's and of each
stick's own friction. A model with the law that friction follows needs less scatter, and this is
how it gains by it.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
from scipy.special import logsumexp

from cosim.gap.quantities import with_digits
from cosim.gap.weak_form.constants import (
    SCATTER_ASKED,
    SCATTER_RANGE,
    STATIC_FLOOR,
    STICK_SCATTER,
    ZERO_PARTS_ASKED,
)
from cosim.gap.weak_form.system import Rung
from cosim.gap.windows.descent import LONGEST
from cosim.gap.windows.fitted import Fitted, Information

#: Numbers of the runs' own friction, and of the tracker's zeros.
OWN_FRICTION, OWN_ZEROS = "offset.friction@", ("offset.x@", "offset.y@")
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

    assumed : standard deviation of the runs' own friction in the fit, 0 where they have none;
    expected : beforehand. Of the tracker's zeros the fit assumes what is stated of them, of sticks
    what is expected; as in the rows, less of either is as probable beforehand.
    """
    asked = np.array([*product(SCATTER_ASKED, ZERO_PARTS_ASKED), (assumed or 1.0, 1.0)])
    of_runs = sum((_of_runs(fitted, known, asked) for known in fitted.known), np.zeros(len(asked)))
    sticks = np.concatenate([np.zeros(0), *(run.states[:, 6:].ravel() for run in fitted.runs)])
    values = np.array([*SCATTER_ASKED, STICK_SCATTER])
    return _averaged(of_runs, asked[:, 0], expected) + _averaged(
        _of_sticks(sticks[sticks != 0.0], values), values, STICK_SCATTER
    )


def _averaged(densities: np.ndarray, asked: np.ndarray, expected: float) -> float:
    """Over a half-normal of what is expected, less that of the last, which the fit assumes."""
    weights = -0.5 * (asked[:-1] / expected) ** 2
    return float(logsumexp(densities[:-1] + weights - logsumexp(weights)) - densities[-1])


def _of_runs(fitted: Fitted, known: Information, asked: np.ndarray) -> np.ndarray:
    """(s,) ln of how probable some runs are under scatters (s, 2), the last as the fit assumes.

    asked : of friction, and of the zeros in parts of what is stated. The runs' own friction and
    zeros are averaged over, and the numbers that the runs share follow: a law that half the scatter
    has taken up takes all of it where less scatter is allowed. With the fit's own information,
    linear about where it ended, and so good for some ten scales of a shared number, however little
    the runs determine it; one at a bound stays there.
    """
    of_friction = np.array([label.startswith(OWN_FRICTION) for label in known.labels])
    own = of_friction | [label.startswith(OWN_ZEROS) for label in known.labels]
    free = own | [label not in fitted.at_bound for label in known.labels]
    root, at = known.root[:, free], np.where(own, known.scaled, 0.0)[free]
    own, of_friction = own[free], of_friction[free]
    noise = max(1.0, fitted.misfit)
    told = (root.T @ root - np.diag(own.astype(float))) / noise
    slope = (known.slope[free] - at) / noise
    densities = []
    for scatter, zeros in (asked[-1] / asked) ** 2:
        pull = np.where(own, np.where(of_friction, scatter, zeros), LONGEST**-2)
        inner = told + np.diag(pull)
        step = np.linalg.lstsq(inner, -slope - pull * at, rcond=None)[0]
        off = step @ told @ step + 2.0 * slope @ step + pull @ (at + step) ** 2
        spread = np.linalg.slogdet(inner[np.ix_(own, own)])[1] - np.log(pull[own]).sum()
        densities.append(-0.5 * (off + spread))
    return np.array(densities)


def _of_sticks(own: np.ndarray, asked: np.ndarray) -> np.ndarray:
    """(s,) the same of the sticks' own friction (n,), each read off to `STATIC_FLOOR`.

    Of which the data alone say N(m, v), 1/v = 1/floor^2 - 1/assumed^2: under s N(m; 0, s^2 + v).
    """
    variance = 1.0 / (1.0 / STATIC_FLOOR**2 - 1.0 / asked[-1] ** 2)
    mean = own * (variance / STATIC_FLOOR**2)
    spread = asked[:, None] ** 2 + variance
    return np.asarray(-0.5 * np.sum(mean**2 / spread + np.log(spread), axis=1))
