"""How often a campaign that is as stated may be doubted."""

from __future__ import annotations

from scipy import stats

#: Chance that a campaign which is as stated is doubted, all runs of one check together.
LEVEL = 1e-3


def far(count: int) -> float:
    """Standard deviations, either way, that one of ``count`` figures exceeds in `LEVEL` of cases.

    >>> round(far(1), 2), round(far(6), 2)
    (3.29, 3.76)
    """
    return float(stats.norm.isf(0.5 * LEVEL / max(count, 1)))
