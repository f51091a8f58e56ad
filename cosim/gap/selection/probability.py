"""How probable each effect is, of those tried, given what evidence there is for it.

Beforehand nothing is missing with a probability of one half, and one of the n effects tried with
the other half, each as probable as the next. With Bayes factors B (the best law's of each effect
over the model without it), that of an effect is (B_i / n) / (1 + sum B_j / n).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.special import logsumexp

from .tried import Tried


def probabilities(tried: Sequence[Tried], count: int) -> dict[str, float]:
    """Of each effect; count : of effects tried, be they among these or not."""
    best: dict[str, float] = {}
    for each in tried:
        effect = each.candidate.effect
        best[effect] = max(each.gain, best.get(effect, -np.inf))
    return posterior(best, count)


def posterior(gains: Mapping[str, float], count: int) -> dict[str, float]:
    """The same from gains in -2 ln evidence."""
    logarithms = 0.5 * np.array(list(gains.values())) - np.log(max(count, 1))
    whole = logsumexp(np.append(logarithms, 0.0))
    return dict(zip(gains, np.exp(logarithms - whole).tolist(), strict=True))
