"""A block that slides in the plane on springs and a moving surface: the tests' own model.

Spring forces are the gradient of the elastic energy (complex step), friction is a sum over points
of the contact, the integrator is scipy's DOP853. It shares no code with the kernel and knows no
parameter names. It only slides: sticking is not its business.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

GRAVITY = 9.81
STATE = ("x", "y", "phi", "vx", "vy", "omega", "heat")
CORNER_ANGLES = np.radians([160.0, 20.0, 200.0, 340.0])
ATTACHMENT = 0.05
CORNERS = ATTACHMENT * np.array([np.cos(CORNER_ANGLES), np.sin(CORNER_ANGLES)])
OUTWARD = np.array([-1.0, 1.0, -1.0, 1.0])


def straight_anchors(length: float) -> np.ndarray:
    """Anchors (2, 4) of springs along x."""
    return CORNERS + length * np.array([OUTWARD, [0.0] * 4])


def contact_points(radius: float, radial: int = 40, angular: int = 80) -> tuple[np.ndarray, ...]:
    """Points and weights on the disc: Gauss in r^2, trapezoid in the angle."""
    nodes, weights = np.polynomial.legendre.leggauss(radial)
    r = radius * np.sqrt(0.5 * (nodes + 1.0))
    theta = 2.0 * np.pi * np.arange(angular) / angular
    r, theta = np.meshgrid(r, theta, indexing="ij")
    x, y = (r * np.cos(theta)).ravel(), (r * np.sin(theta)).ravel()
    return x, y, np.repeat(0.5 * weights / angular, angular)


@dataclass
class Slider:
    """M q'' = springs + friction + damping.

    Attributes
    ----------
    law : local friction coefficient of local sliding speeds (m/s)
    spring_energy : J of extensions (m), complex ones too
    film : N s/m of the whole contact; damping, damping_rotation : N s/m, N m s
    ratio : friction across the motion relative to that along x
    """

    law: Callable[[np.ndarray], np.ndarray] = lambda speed: 0.2086 + 0.0 * speed
    spring_energy: Callable[[np.ndarray], np.ndarray] = lambda e: 0.5 * 20.17 * e**2
    mass: float = 0.67
    radius: float = 0.04
    natural: float = 0.17
    anchors: np.ndarray = None
    speed: float = 0.15
    curvature: float = 0.0
    ratio: float = 1.0
    film: float = 0.0
    damping: float = 0.0
    damping_rotation: float = 0.0

    def run(self, start: tuple[float, ...], end: float) -> np.ndarray:
        """State (7,) at ``end`` (s) from six numbers at 0."""
        self.anchors = straight_anchors(0.2) if self.anchors is None else self.anchors
        points = contact_points(self.radius)
        inertia = np.array([1.0, 1.0, 0.5 * self.radius**2]) * self.mass
        brake = np.array([self.damping, self.damping, self.damping_rotation])

        def slopes(t, state):
            q, velocity = state[:3], state[3:6]
            sliding = velocity - self._surface(q)
            force = self.friction(sliding, points)
            loads = self._springs(q) + force - brake * velocity
            return np.concatenate([velocity, loads / inertia, [-force @ sliding]])

        found = solve_ivp(
            slopes, (0.0, end), [*start, 0.0], method="DOP853", rtol=1e-12, atol=1e-13
        )
        return found.y[:, -1]

    def friction(self, sliding: np.ndarray, points: tuple[np.ndarray, ...]) -> np.ndarray:
        """Force and moment against a sliding velocity (x, y, turning)."""
        px, py, w = points
        scale = np.array([1.0, self.ratio, self.ratio])
        sx, sy, turn = scale * sliding
        ux, uy = sx - turn * py, sy + turn * px
        speed = np.hypot(ux, uy)
        traction = -w * (self.law(speed) * self.mass * GRAVITY / speed + self.film)
        return scale * [traction @ ux, traction @ uy, traction @ (px * uy - py * ux)]

    def _springs(self, q: np.ndarray) -> np.ndarray:
        step = 1e-30
        return np.array([-self._elastic(q + 1j * step * row).imag / step for row in np.eye(3)])

    def _elastic(self, q: np.ndarray) -> complex:
        x, y, phi = q
        turn = [[np.cos(phi), -np.sin(phi)], [np.sin(phi), np.cos(phi)]]
        arms = np.array(turn) @ CORNERS
        gap = self.anchors - arms - np.array([[x], [y]])
        return np.sum(self.spring_energy(np.sqrt(gap[0] ** 2 + gap[1] ** 2) - self.natural))

    def _surface(self, q: np.ndarray) -> np.ndarray:
        v, c = self.speed, self.curvature
        return np.array([v * (1.0 - c * q[1]), v * c * q[0], v * c])
