"""Disc on a spring and a torsion spring, friction at its rim (Leine et al. 1998, 2DOF).

The belt touches the disc at radius r, so the contact moves with x' + r phi'. With y = (x, x',
r phi, r phi'), the load F of the belt on the contact and w = r^2/J:

    x''     = (F - k x)/m,        r phi'' = w F - (k_t/J) r phi
    slip:   |F| = F_s / (1 + delta |v_rel|) along v_rel = v - x' - r phi'
    stick:  x' + r phi' = v, hence F = (k x + k_t (m/J) phi r) / (1 + r^2 m/J)

In stick the mass still swings against the rotation: only the contact moves with the belt.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from leine_oscillator import ATOL, RTOL
from scipy.integrate import solve_ivp

STICK, SLIP = 0, 1


@dataclass(frozen=True)
class Segment:
    """A stretch of one mode: time (n,) s; state (4, n): x, x', r phi, r phi' in m, m/s."""

    mode: int
    time: np.ndarray
    state: np.ndarray


@dataclass(frozen=True)
class LeineDisc:
    """mass kg; stiffness N/m; inertia kg m2; torsion_stiffness N m/rad; radius m; belt_speed m/s;
    static_force N; weakening s/m."""

    mass: float = 1.0
    stiffness: float = 1.0
    inertia: float = 1.0
    torsion_stiffness: float = 1.0
    radius: float = 1.0
    belt_speed: float = 1.0
    static_force: float = 1.0
    weakening: float = 3.0

    def __post_init__(self) -> None:
        for name in ("mass", "stiffness", "inertia", "belt_speed", "static_force"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} = {getattr(self, name):g}: must be above 0")

    def sticking_force(self, state: np.ndarray) -> float:
        """Load that keeps the contact on the belt, N (thesis eq. 2.11)."""
        ratio = self.mass / self.inertia
        spring = self.stiffness * state[0]
        # k_t (m/J) phi r with state[2] = r phi
        torsion = self.torsion_stiffness * ratio * state[2]
        found: float = (spring + torsion) / (1.0 + self.radius**2 * ratio)
        return found

    def sliding_force(self, state: np.ndarray, side: float) -> float:
        """Friction in slip, N; ``side`` +1 where the belt overtakes the contact, else -1."""
        sliding = max(side * (self.belt_speed - state[1] - state[3]), 0.0)
        found: float = side * self.static_force / (1.0 + self.weakening * sliding)
        return found

    def motion(self, state: np.ndarray, force: float) -> list[float]:
        """State's rate under a load on the contact, N."""
        per_inertia = self.radius**2 / self.inertia
        return [
            state[1],
            (force - self.stiffness * state[0]) / self.mass,
            state[3],
            per_inertia * force - self.torsion_stiffness / self.inertia * state[2],
        ]

    def energy(self, state: np.ndarray) -> np.ndarray:
        """Kinetic and spring energy, J; state (4, ...). radius 0 has no rotation."""
        turn = state[2] / self.radius, state[3] / self.radius
        found: np.ndarray = 0.5 * (
            self.mass * state[1] ** 2
            + self.stiffness * state[0] ** 2
            + self.inertia * turn[1] ** 2
            + self.torsion_stiffness * turn[0] ** 2
        )
        return found

    def simulate(self, duration: float) -> list[Segment]:
        """Segments of stick and slip, their ends located; starts at rest on the belt."""
        state = np.array([0.0, self.belt_speed, 0.0, 0.0])
        time, segments = 0.0, []
        mode, side = STICK, 1.0
        while time < duration:
            solution = self._segment(mode, side, time, state, duration)
            segments.append(Segment(mode, solution.t, solution.y))
            time, state = float(solution.t[-1]), solution.y[:, -1].copy()
            if solution.status == 1:
                mode, side = self._after(mode, side, state)
        return segments

    def _after(self, mode: int, side: float, state: np.ndarray) -> tuple[int, float]:
        """Mode and side that follow the event in which a segment ended."""
        force = self.sticking_force(state)
        if mode == STICK:
            return SLIP, math.copysign(1.0, force)
        if abs(force) < self.static_force:
            return STICK, side
        return SLIP, -side  # slides through the belt's speed

    def _segment(self, mode, side, time, state, duration):
        def rate(_time, y):
            return self.motion(
                y, self.sticking_force(y) if mode == STICK else self.sliding_force(y, side)
            )

        def breakaway(_time, y):
            return abs(self.sticking_force(y)) - self.static_force

        def restick(_time, y):
            return side * (y[1] + y[3] - self.belt_speed)

        event: Any = breakaway if mode == STICK else restick  # carries what solve_ivp asks
        event.terminal, event.direction = True, 1.0
        swing = math.sqrt(min(self.mass / self.stiffness, self._turning_time() ** 2))
        return solve_ivp(
            rate,
            (time, duration),
            state,
            method="DOP853",
            rtol=RTOL,
            atol=ATOL,
            events=event,
            max_step=0.05 * swing,
        )

    def _turning_time(self) -> float:
        """1/omega of the free rotation, s."""
        if self.torsion_stiffness <= 0.0:
            return math.inf
        return math.sqrt(self.inertia / self.torsion_stiffness)
