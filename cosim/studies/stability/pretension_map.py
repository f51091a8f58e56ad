"""Growth of small disturbances over pretension and speed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from stickslip import Parameters
from stickslip.steady_motion import Interface, RunEnded, with_pretension
from stickslip.steady_motion.regimes import regime_of
from stickslip.steady_motion.stability import growth_in_a_cycle, guided

from .case import Case, at_speed, run_length


@dataclass(frozen=True)
class PretensionMap:
    """growth (n, m): largest multiplier of a cycle at pretensions (n,) m and speeds (m,) m/s.

    sticks (n, m): whether the block sticks there. NaN: not computed, or no motion that can be
    followed.
    """

    pretensions: np.ndarray
    speeds: np.ndarray
    growth: np.ndarray
    sticks: np.ndarray


def pretension_map(
    case: Case, pretensions: np.ndarray, speeds: np.ndarray, done: Callable[[int], object]
) -> PretensionMap:
    """The map around a case; ``done`` is called with 1 after each cell."""
    growth = np.full((len(pretensions), len(speeds)), np.nan)
    sticks = growth.copy()
    for j, speed in enumerate(speeds):
        moving = at_speed(case.parameters, speed)
        for i, pretension in enumerate(pretensions):
            parameters = with_pretension(moving, pretension)
            growth[i, j], sticks[i, j] = _cell(parameters, case.interface)
            done(1)
    return PretensionMap(np.asarray(pretensions), np.asarray(speeds), growth, sticks)


def _cell(parameters: Parameters, interface: Interface) -> tuple[float, float]:
    """Growth, and 1 where the block sticks on its line, else 0; NaN where it cannot be followed."""
    duration = run_length(parameters)
    try:
        growth = growth_in_a_cycle(parameters, duration, interface)
        return growth, float(regime_of(guided(parameters), duration, interface).slip_share < 1.0)
    except RunEnded:
        return np.nan, np.nan
