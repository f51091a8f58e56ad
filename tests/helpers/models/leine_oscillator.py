"""Mass on a spring and a belt, friction that weakens with sliding speed (Leine et al. 1998, 1DOF).

    m x'' + k x = F,   |F| = F_s / (1 + delta |v - x'|) in slip,   |F| <= F_s in stick

R. I. Leine, D. H. van Campen, A. de Kraker, L. van den Steen, Stick-slip vibrations induced by
alternate friction models, Nonlinear Dynamics 16 (1998) 41-54.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

# figures of a cycle are wanted to 1e-9; the integrator's own limit is about 100 eps
RTOL, ATOL = 1e-13, 1e-14
# a slip that has not ended after this many natural periods slides for good
LONGEST_SLIP = 20.0


@dataclass(frozen=True)
class LimitCycle:
    """Periodic stick-slip motion: times s, places m, speed m/s."""

    slip_time: float
    stick_time: float
    slip_starts_at: float
    slip_ends_at: float
    x_max: float
    x_min: float
    speed_min: float

    @property
    def period(self) -> float:
        """s"""
        return self.slip_time + self.stick_time


@dataclass(frozen=True)
class LeineOscillator:
    """mass kg; stiffness N/m; belt_speed m/s > 0; static_force N; weakening delta, s/m."""

    mass: float = 1.0
    stiffness: float = 1.0
    belt_speed: float = 0.2
    static_force: float = 1.0
    weakening: float = 3.0

    def __post_init__(self) -> None:
        for name in ("mass", "stiffness", "belt_speed", "static_force"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} = {getattr(self, name):g}: must be above 0")
        if not self.weakening >= 0.0:
            raise ValueError(f"weakening = {self.weakening:g} s/m: must not be negative")

    def friction(self, speed: float) -> float:
        """Friction on the sliding block of velocity ``speed`` (m/s), N."""
        sliding = self.belt_speed - speed
        size = self.static_force / (1.0 + self.weakening * abs(sliding))
        return math.copysign(size, sliding)

    def slip(self, _time: float, state: np.ndarray) -> list[float]:
        """Right-hand side in slip; state (x, x')."""
        x, speed = state
        # slip below the belt's speed: continued smoothly across it, where the event ends it
        sliding = max(self.belt_speed - speed, 0.0)
        force = self.static_force / (1.0 + self.weakening * sliding)
        return [speed, (force - self.stiffness * x) / self.mass]

    def limit_cycle(self) -> LimitCycle:
        """One slip from break-away to re-stick and the stick that closes the cycle.

        Every cycle is this one: slip always begins at (F_s/k, v).
        Raises ValueError where the block goes on sliding.
        """
        start = self.static_force / self.stiffness
        longest = LONGEST_SLIP * 2.0 * math.pi * math.sqrt(self.mass / self.stiffness)
        solution = solve_ivp(
            self.slip,
            (0.0, longest),
            [start, self.belt_speed],
            method="DOP853",
            rtol=RTOL,
            atol=ATOL,
            events=self._events(),
            max_step=0.02 * math.sqrt(self.mass / self.stiffness),
        )
        if solution.status != 1:
            raise ValueError(
                f"belt_speed = {self.belt_speed:g} m/s: the block does not stick again within "
                f"{longest:g} s of slip"
            )
        end = float(solution.y_events[0][0][0])
        standing, strongest = solution.y_events[1], solution.y_events[2]
        return LimitCycle(
            slip_time=float(solution.t_events[0][0]),
            stick_time=(start - end) / self.belt_speed,
            slip_starts_at=start,
            slip_ends_at=end,
            x_max=float(standing[:, 0].max()),
            x_min=float(standing[:, 0].min()),
            speed_min=float(strongest[:, 1].min()),
        )

    def _events(self) -> list:
        """Belt's speed reached again (ends the slip); standing still; no acceleration."""

        def restick(_time, state):
            return state[1] - self.belt_speed

        def standing(_time, state):
            return state[1]

        def coasting(time, state):
            return self.slip(time, state)[1]

        rising: Any = restick  # functions carry what solve_ivp asks of its events
        rising.terminal, rising.direction = True, 1.0
        strongest: Any = coasting
        strongest.direction = 1.0
        return [restick, standing, coasting]
