"""How well the data determine what was fitted."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from stickslip.effects.candidate import FreeParameter

from cosim.gap.estimation.fitted import shared_of
from cosim.gap.estimation.trial import Trial

#: Standard deviations of a 95 % interval.
_NINETY_FIVE = 1.96
#: Information below which the data do not feel a number: its interval is as wide as its range.
_UNFELT = 1e-12
#: A parameter whose interval is wider than this part of its value is not determined.
_DETERMINED = 0.5
#: Steps of a free parameter within which an interval ends at its bound: it was cut off there.
_AT_END = 1e-3


def intervals(trial: Trial) -> dict[str, tuple[float, float]]:
    """`block.parameter` -> 95 % interval, from the Fisher information of the fit runs.

    Residuals of neighbouring samples are not independent where a model does not quite fit. Two
    estimates allow for that, and the wider one counts: the information of so many samples as would
    have the residual's scatter (its mean square divides it), and the covariance of estimates whose
    residuals are independent from segment to segment only (Liang & Zeger 1986).
    """
    shared = shared_of(trial.model.free_parameters)
    weight = np.array([free.step / free.prior if free.prior else 0.0 for free in shared])
    information, scatter = _information(trial)
    known = np.diag(weight**2)
    scarce = known + information / max(trial.fitted.rms_residual(), 1.0) ** 2
    reach = _NINETY_FIVE * np.sqrt(
        np.maximum(
            np.diag(_inverse(scarce)),
            np.diag(
                _inverse(known + information) @ (known + scatter) @ _inverse(known + information)
            ),
        )
    )
    reach[np.diag(scarce) <= _UNFELT] = np.inf
    result = {}
    for free, at, wide in zip(shared, trial.fitted.point.shared, reach, strict=True):
        ends = (
            free.value(free.inside(at - wide)),
            free.value(free.inside(at + wide)),
        )
        result[free.key] = (float(min(ends)), float(max(ends)))
    return result


def undetermined(
    free_parameters: Sequence[FreeParameter], pairs: Mapping[str, tuple[float, float]]
) -> tuple[str, ...]:
    """Keys whose 95 % interval, of ``pairs``, is all that they may be: the data say nothing.

    A number that may be anything has no such range, and one that a bound cuts off on one side only
    is known to be on the other's side of something.
    """
    return tuple(
        free.key
        for free in free_parameters
        if free.key in pairs
        and all(math.isfinite(end) for end in (free.low, free.high))
        and _reaches(free, pairs[free.key])
    )


def _reaches(free: FreeParameter, pair: tuple[float, float]) -> bool:
    """Whether an interval ends at both bounds, on the scale of the fit."""
    ends = zip(sorted(pair), (free.low, free.high), strict=True)
    return all(abs(free.scaled(end) - free.scaled(bound)) < _AT_END for end, bound in ends)


def _information(trial: Trial) -> tuple[np.ndarray, np.ndarray]:
    """(g, g) Fisher information of white noise, and the scatter of the segments' scores."""
    shared = len(shared_of(trial.model.free_parameters))
    information, scores = np.zeros((shared, shared)), []
    for columns in trial.fitted.derivatives:
        left, residuals = columns.left(columns.shared), columns.left(columns.residuals)
        information = information + left.T @ left
        scores += [left[rows].T @ residuals[rows] for rows, _ in columns.states]
    count = len(scores)
    stacked = np.array(scores).reshape(count, shared)
    return information, stacked.T @ stacked * count / max(count - shared, 1)


def _inverse(matrix: np.ndarray) -> np.ndarray:
    """Of an information whose numbers may differ by many orders; 0 where nothing is known."""
    scale = np.sqrt(np.clip(np.diag(matrix), _UNFELT, None))
    inverse = np.linalg.pinv(matrix / np.outer(scale, scale), rcond=1e-10, hermitian=True)
    return inverse / np.outer(scale, scale)


def determined(trial: Trial) -> dict[str, tuple[float, float, float]]:
    """The parameters that the data determine: value and 95 % interval."""
    values, result = trial.fitted.values, {}
    for key, (low, high) in intervals(trial).items():
        if key.startswith("offset."):
            continue
        if np.isfinite(high - low) and high - low <= 2.0 * _DETERMINED * abs(values[key]):
            result[key] = (float(values[key]), low, high)
    return result
