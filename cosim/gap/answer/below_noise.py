"""Whether a model leaves less than noise: then what was taken for noise is something else.

Of n samples that a true model with p numbers leaves, the sum of squares in units of the noise is
chi-square with n - p degrees of freedom, and an estimate of the noise from the same samples
scatters by about sqrt(2.3 / (2 n)) (`data.noise`). Where so little is left that as much again as
any model may leave would go unseen, "none" is no answer; an effect that is named in spite of such a
noise is there all the same.
"""

from __future__ import annotations

import math

import numpy as np

from cosim.gap.doubts.doubt import Doubt, far, listed, rounded
from cosim.gap.doubts.sampling import HIDES
from cosim.gap.result import FittedModel, FittedRun

#: Variance of an estimated noise, in parts of itself, times the number of samples.
ESTIMATED = 2.3 / 2.0
#: Numbers that a fit turns for each stretch of a run, and those that it turns for a run.
OF_STRETCH, OF_RUN = 4, 4
#: Parts of the noise by which numbers that a camera writes, or filters, are quieter than they
#: should be, without being motion: what is left below is no noise.
QUIET = 0.1


def doubts_of_noise(model: FittedModel, estimated: bool, nothing: bool) -> list[Doubt]:
    """One for all runs in which a model leaves less than noise can be.

    estimated : whether the noise was taken from the data; nothing : whether the model is to be
    believed as it is, with nothing missing
    """
    limit = far(len(model.runs))
    quiet = [run for run in model.runs if _left(run) < _least(run, limit, estimated)]
    if not quiet:
        return []
    worst = min(quiet, key=_left)
    said = "estimated" if estimated else "given"
    hint = (
        "the estimate took motion for noise: cannot tell, sample faster or give noise.x"
        if estimated
        else "check noise.x, which hides what is missing if it is too large"
    )
    return [
        Doubt(
            "noise",
            listed([run.name for run in quiet]),
            _left(worst),
            1.0,
            "noise units",
            f"{listed([run.name for run in quiet])}: the model leaves {rounded(_left(worst))} of "
            f"the noise that is {said} ({rounded(1e3 * worst.track.run.noise['x'])} mm), expected "
            f"is 1, and {rounded(_least(worst, limit, estimated))} at least: {hint}",
            nothing and _left(worst) < 1.0 / HIDES,
        )  # fmt: skip
    ]


def _residuals(run: FittedRun) -> np.ndarray:
    rows = run.track.residual("x")
    return rows[np.isfinite(rows)]


def _left(run: FittedRun) -> float:
    """Root mean square residual of x in units of the noise, for its degrees of freedom."""
    rows = _residuals(run)
    return math.sqrt(float(rows @ rows) / max(_freedom(run), 1))


def _freedom(run: FittedRun) -> int:
    stretches = int(np.unique(run.track.segments).size)
    return _residuals(run).size - OF_RUN - OF_STRETCH * stretches


def _least(run: FittedRun, limit: float, estimated: bool) -> float:
    """What a true model leaves at least, at the stated error rate."""
    freedom = _freedom(run)
    if freedom < 2 * OF_STRETCH:
        return 0.0
    variance = 0.5 / freedom + (ESTIMATED / freedom if estimated else 0.0)
    return max((1.0 - QUIET) * (1.0 - limit * math.sqrt(variance)), 0.0)
