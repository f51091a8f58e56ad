"""How the strengths and stiffnesses of an Iwan contact's elements are spread.

An element yields at a share of mu N; before, it is a spring whose deflection then is its give.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from .apparatus import ELEMENTS, LEVELS

SPREADS = ("even", "lognormal", "power")


def spread_elements(
    give: float, spread: str = "even", width: float = 0.9, stiffer: float = 1.0
) -> dict[str, NDArray]:
    """Shares of the load and gives, m: of the elements on a line, and of the levels of a point.

    Parameters
    ----------
    give : deflection, m, at which all elements together would carry mu_s N did none of them yield
    spread : of the strengths, at evenly spaced probabilities (Iwan, J. Appl. Mech. 33, 893, 1966)
    width : half the range over the mean (even), standard deviation of the logarithm (lognormal), or
        the power to which a probability is raised (power)
    stiffer : stiffness of every second element over that of the others
    """
    q = (np.arange(ELEMENTS) + 0.5) / ELEMENTS
    strengths = {
        "even": 1 + width * (2 * q - 1),
        "lognormal": np.exp(width * ndtri(q)),
        "power": q**width,
    }[spread]
    stiffness = np.where(np.arange(ELEMENTS) % 2, stiffer, 1.0)
    share, part = strengths / strengths.sum(), stiffness / stiffness.sum()
    level_share, level_part = (a.reshape(LEVELS, -1).sum(axis=1) for a in (share, part))
    return {
        "element_share": share,
        "element_give": give * share / part,
        "level_share": level_share,
        "level_give": give * level_share / level_part,
    }
