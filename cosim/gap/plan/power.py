"""The chance that an effect is named: the one place that knows the rule of naming.

A law is named where the sum of squares that it takes away, in noise units, is more than chance
gives the best of the whole catalogue at a family-wise level. What it takes away is noncentrally
chi-square distributed (Wilks 1938): its noncentrality is the sum of squares that the plain model is
left with when it is fitted to the effect's own motion without noise, its degrees of freedom are the
law's free parameters. The chances of the catalogue's laws add up at most (Bonferroni). Judging by
runs that were left out costs no power that this counts where the runs repeat one another; an effect
that shows in a single run alone is named less often than is said here.
"""

from __future__ import annotations

from functools import cache

from scipy.optimize import brentq
from scipy.stats import chi2, ncx2

#: Family-wise chance that something is named where nothing is, and the chance that what is there is
#: named: the usual ones of a test (Cohen 1988 has 80 %).
LEVEL, WANTED = 0.05, 0.9


def power(
    noncentrality: float, level: float = LEVEL, number_of_laws: int = 1, freedoms: int = 1
) -> float:
    """Chance that a law is named.

    noncentrality : squared length of what is left of its response, in noise units
    level : chance that any of so many laws is named where there is none; freedoms : of the law
    """
    limit = chi2.isf(level / number_of_laws, freedoms)
    return float(ncx2.sf(limit, freedoms, noncentrality))


def threshold(level: float = LEVEL, number_of_laws: int = 1, freedoms: int = 1) -> float:
    """Sum of squares that a law has to take away to be named."""
    return float(chi2.isf(level / number_of_laws, freedoms))


@cache
def needed(
    wanted: float = WANTED, level: float = LEVEL, number_of_laws: int = 1, freedoms: int = 1
) -> float:
    """Noncentrality at which the chance is the wanted one."""
    limit = threshold(level, number_of_laws, freedoms)
    upper = 4.0 * (limit + freedoms) + 100.0  # its square root is more than 5 sigma beyond
    return float(
        brentq(lambda size: power(size, level, number_of_laws, freedoms) - wanted, 0.0, upper)
    )
