"""How well the data determine what was fitted."""

from __future__ import annotations

import numpy as np

from cosim.gap.shooting.trial import Trial

#: Standard deviations of a 95 % interval.
_NINETY_FIVE = 1.96
#: A parameter whose interval is wider than this part of its value is not determined.
_DETERMINED = 0.5


def intervals(trial: Trial) -> dict[str, tuple[float, float]]:
    """`block.parameter` -> 95 % interval, from the Fisher information of the fit runs.

    Residuals of neighbouring samples are not independent where a model does not fit: the
    information is that of so many samples as would have the gap's scatter (its square divides it).
    """
    shared = [knob for knob in trial.model.knobs if not knob.per_run]
    weight = np.array([k.step / k.prior if k.prior else 0.0 for k in shared])
    information = np.diag(weight**2)
    for columns in trial.fitted.columns:
        left = columns.left(columns.shared)
        information = information + left.T @ left / max(trial.fitted.gap(), 1.0) ** 2
    # what the data do not feel at all has an interval as wide as its range
    scale = np.sqrt(np.clip(np.diag(information), 1e-12, None))
    covariance = np.linalg.pinv(information / np.outer(scale, scale), rcond=1e-10, hermitian=True)
    reach = _NINETY_FIVE * np.sqrt(np.clip(np.diag(covariance), 0.0, None)) / scale
    reach[np.diag(information) <= 1e-12] = np.inf
    result = {}
    for knob, at, wide in zip(shared, trial.fitted.point.shared, reach, strict=True):
        ends = (knob.value(knob.inside(at - wide)), knob.value(knob.inside(at + wide)))
        result[knob.key] = (float(min(ends)), float(max(ends)))
    return result


def determined(trial: Trial) -> dict[str, tuple[float, float, float]]:
    """The parameters that the data determine: value and 95 % interval."""
    values, result = trial.fitted.values, {}
    for key, (low, high) in intervals(trial).items():
        if key.startswith("offset."):
            continue
        if np.isfinite(high - low) and high - low <= 2.0 * _DETERMINED * abs(values[key]):
            result[key] = (float(values[key]), low, high)
    return result
