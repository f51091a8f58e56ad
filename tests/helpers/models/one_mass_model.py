"""A block on a spring and a moving belt, one degree of freedom: the tests' own model.

Forces are plain functions given by the test, the integrator is scipy's DOP853, break-away and
re-stick are scipy's events. It shares no code with the kernel and knows no parameter names.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

GRAVITY = 9.81
#: The source study's first case, which is what is not given.
MASS, STIFFNESS, MU_S, MU_K, SPEED = 0.67, 80.68, 0.2815, 0.2086, 0.15
NORMAL = MASS * GRAVITY
X, V, HEAT, RECENT_HEAT, DISTANCE, TRAVEL = range(6)
# an order below what the comparisons ask for; 3e-14 is the least that scipy takes
ACCURACY = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-14}


@dataclass
class OneMass:
    """m x'' = pull(x) - damping(x') + friction on a belt of speed(t).

    Attributes
    ----------
    pull : force of the springs on the block at x, N
    damping : force against the block's own velocity, N, of it
    kinetic : friction of a slip, N >= 0, of (sliding speed, state)
    static : what the contact holds, N, of (time at rest, state)
    speed, acceleration : of the belt, of t
    relaxation : s, in which recent heat is forgotten
    judged : part of the load by which stick is judged
    lag : m/s, by which a stick creeps behind the belt, of the state
    """

    mass: float = MASS
    pull: Callable[[float], float] = lambda x: -STIFFNESS * x
    kinetic: Callable[[float, np.ndarray], float] = lambda sliding, state: MU_K * NORMAL
    static: Callable[[float, np.ndarray], float] = lambda held, state: MU_S * NORMAL
    speed: Callable[[float], float] = lambda t: SPEED
    acceleration: Callable[[float], float] = lambda t: 0.0
    damping: Callable[[float], float] = lambda velocity: 0.0
    relaxation: float = np.inf
    judged: float = 1.0
    lag: Callable[[np.ndarray], float] = lambda state: 0.0
    max_step: float = 0.02

    def run(self, times: np.ndarray, x: float = 0.0):
        """States (6, n) at ``times`` and events [(t, mode after, x)], from rest on the belt."""
        state = np.array([x, self.speed(times[0]), 0.0, 0.0, 0.0, 0.0])
        t, since, side = times[0], times[0], 0.0
        samples, events = np.empty((6, len(times))), []
        while t < times[-1]:
            how, more = (self._slip, side) if side else (self._stick, since)
            phase = how(t, more, state, times)
            inside = (times >= t) & (times <= phase.t[-1])
            samples[:, inside] = phase.sol(times[inside])
            t, state = phase.t[-1], phase.y[:, -1].copy()
            if t < times[-1]:
                side, since = self._after(t, since, side, state), t
                events.append((t, abs(side), state[X]))
        return samples, np.array(events)

    def _stick(self, t, since, state, times):
        def slopes(t, s):
            fading = -s[RECENT_HEAT] / self.relaxation
            speed = self.speed(t)
            return [speed - self.lag(s), self.acceleration(t), 0.0, fading, 0.0, speed]

        def gives_way(t, s):
            return abs(self._holding(t, s)) * self.judged - self.static(t - since, s)

        return self._solve(slopes, gives_way, 1.0, t, state, times)

    def _slip(self, t, side, state, times):
        def slopes(t, s):
            sliding = abs(s[V] - self.speed(t))
            friction = self.kinetic(sliding, s)
            force = self.pull(s[X]) - self.damping(s[V]) - side * friction
            heat = friction * sliding
            warming = heat - s[RECENT_HEAT] / self.relaxation
            return [s[V], force / self.mass, heat, warming, sliding, self.speed(t)]

        def comes_to_rest(t, s):
            return side * (s[V] - self.speed(t))

        return self._solve(slopes, comes_to_rest, -1.0, t, state, times)

    def _solve(self, slopes, event, direction, t, state, times):
        event.terminal, event.direction = True, direction
        return solve_ivp(
            slopes, (t, times[-1]), state, events=event, dense_output=True, max_step=self.max_step,
            **ACCURACY,
        )  # fmt: skip

    def _holding(self, t, s):
        """Friction that would keep the block on the belt, N."""
        return self.mass * self.acceleration(t) - self.pull(s[X]) + self.damping(self.speed(t))

    def _after(self, t, since, side, s):
        """0: stick; +-1: the side to which the block slides on."""
        holding = self._holding(t, s)
        if side != 0.0:
            s[V] = self.speed(t)
            if abs(holding) * self.judged < self.static(0.0, s):
                return 0.0
        else:
            s[V] -= self.lag(s)
        return -np.sign(holding)
