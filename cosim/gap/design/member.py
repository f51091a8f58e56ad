"""One of the models that a campaign cannot tell apart."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from stickslip.effects.candidate import FreeParameter

from cosim.gap.estimation.fitted import Fitted, Point
from cosim.gap.estimation.problem import Problem


@dataclass(frozen=True)
class Member:
    """A fitted model with the name of what it adds.

    Attributes
    ----------
    effect : id in the catalogue, or several joined by " + "
    free parameters, settings : what is turned and what is set
    fitted : the fit to the campaign, with its derivatives
    """

    effect: str
    free_parameters: tuple[FreeParameter, ...]
    settings: Mapping[str, float]
    fitted: Fitted = field(repr=False)

    def __post_init__(self) -> None:
        if self.fitted.columns is None:
            raise ValueError(f"{self.effect}: fitted without derivatives; with_columns adds them")

    @property
    def values(self) -> dict[str, float]:
        """`block.parameter` -> value, the first run's phases included."""
        return {**self.settings, **self.fitted.values, **self.fitted.own_values(0)}

    @property
    def point(self) -> Point:
        """The fit's, with the first run's own free parameters; no states."""
        return Point(self.fitted.point.shared, (self.fitted.point.own[0],), ())

    def information(self) -> np.ndarray:
        """(g, g) inverse of the covariance of the shared free parameters, as the campaign has it.

        On the scale of the fit. States and phases are eliminated; prior knowledge counts.
        """
        weight = Problem((), self.free_parameters, dict(self.settings)).prior(
            self.fitted.point.shared
        )[1]
        known = np.diag(weight**2)
        for columns in self.fitted.derivatives:
            left = columns.left(columns.shared)
            known = known + left.T @ left
        return known


def without_zero(values: Mapping[str, float], offsets: Sequence[str]) -> dict[str, float]:
    """Parameters of the model alone, without the tracker's zero."""
    return {key: value for key, value in values.items() if key not in offsets}
