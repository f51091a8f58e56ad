"""Motion across the surface, y and phi, as springs and friction make it of the measured x.

Along x everything is measured; what is left is a linear equation for q = (y, phi),

    M q'' + W (q' - V c (x, 1)) = P(x, q),    M = diag(m, J),

with the springs P, linear about the last round's q, and friction that goes with the direction of
sliding (`stickslip.kernel.friction`; U sliding speed, s rim speed, f and m of the disc):

    W = g mu_k N diag(f / U, a^2 m / s),    U^2 = U_x^2 + g U_y^2,    s^2 = g a^2 Omega^2.

g is the square of lateral_friction.ratio. In stick U goes to zero, W beyond all bounds, and q moves
with the surface: one equation for the whole record, in which errors of the measured motion do not
add up, as friction makes y a matter of the distance slid, not of time.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from scipy.linalg.lapack import dtbtrs

from cosim.gap.data.campaign_file import Rig
from cosim.gap.weak_form.constants import MOST_TURN, PLANE_STEP, SLOWEST_SLIDING
from cosim.gap.weak_form.rig_geometry import spring_loads
from cosim.gap.weak_form.track import SmoothTrack

#: Unknowns of a form: 1/R (1/m), turn of the springs (rad), shift of their anchors (m), ln g.
CURVATURE, TURN, SHIFT, SHARE = "curvature", "turn", "shift", "share"
#: Unknowns of every run: y (m), y' (m/s) and phi (rad) where the record begins.
STARTS = ("y", "vy", "phi")


@dataclass(frozen=True)
class Plane:
    """What a run does in the plane.

    Attributes
    ----------
    y, phi : (n,) m, rad; velocity_y, turning : (n,) m/s, rad/s, in the steps of the grid
    curvature, turn, shift : of surface and springs, 1/m, rad, m
    share : g, how much friction acts across, as part of that along x
    """

    y: np.ndarray
    phi: np.ndarray
    velocity_y: np.ndarray
    turning: np.ndarray
    curvature: float = 0.0
    turn: float = 0.0
    shift: float = 0.0
    share: float = 0.0

    def at(self, point: int) -> Plane:
        """At one point of the grid."""
        here = slice(point, point + 1)
        return replace(self, y=self.y[here], phi=self.phi[here],
                       velocity_y=self.velocity_y[here], turning=self.turning[here])  # fmt: skip

    def drive(self, speed: np.ndarray | float) -> np.ndarray:
        """(n,) speed along x of the surface under the block, of its speed on the axis, m/s."""
        return np.asarray(speed * (1.0 - self.curvature * self.y))

    def sliding(self, track: SmoothTrack, radius: float) -> tuple[np.ndarray, ...]:
        """(n,) each: U_x of the surface over the block; U; and s: m/s."""
        speed = track.surface_speed
        along = self.drive(speed) - track.velocity
        ratio = np.sqrt(self.share)
        across = ratio * (speed * self.curvature * track.place - self.velocity_y)
        spin = ratio * radius * np.abs(speed * self.curvature - self.turning)
        return along, np.hypot(along, across), spin

    def loads(
        self, rig: Rig, stiffness: float, x: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(n,) forces of the springs along x and y, N, and their moment, N m, at places x (n,)."""
        return spring_loads(rig, stiffness, x, self.y - self.shift, self.phi, self.turn)


def at_rest(track: SmoothTrack) -> Plane:
    """A block that goes along x alone."""
    still = np.zeros(track.time.size)
    return Plane(still, still, still, still)


@cache
def _disc() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """s / (U + s), and f and m there (integrals of `disc_friction`, midpoint rule)."""
    part = np.linspace(0.0, 1.0, 101)[:, None]
    psi = (np.arange(200) + 0.5) * np.pi / 400.0
    k = np.minimum(part, 1.0 - part) / np.maximum(part, 1.0 - part)
    root = np.sqrt(1.0 - (k * np.sin(psi)) ** 2)
    slides = 2.0 * np.mean(np.cos(psi) ** 2 * root, axis=1)
    turns = np.where(
        part[:, 0] <= 0.5,
        2.0 / 3.0 * k[:, 0] * np.mean(np.cos(psi) ** 4 / root, axis=1),
        2.0 / 3.0 * np.mean(root**3, axis=1),
    )
    return part[:, 0], np.where(part[:, 0] <= 0.5, 1.0, k[:, 0]) * slides, turns


def disc(sliding: np.ndarray, spin: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(n,) f and m of a disc at U and s, m/s."""
    part, force, moment = _disc()
    at = spin / np.maximum(sliding + spin, 1e-12)
    return np.interp(at, part, force), np.interp(at, part, moment)


def inertia(rig: Rig, mass: float) -> float:
    """Moment of inertia about the vertical, kg m2."""
    if rig.inertia == "disc":
        return 0.5 * mass * rig.contact_radius**2
    return mass * rig.attachment_radius**2 if rig.inertia == "ring" else float(rig.inertia)


@dataclass(frozen=True)
class Course:
    """q as it depends on the unknowns: offset (2, n) and columns (u, 2, n), (m, rad) each."""

    offset: np.ndarray
    columns: np.ndarray

    def plane(self, track: SmoothTrack, values: dict[str, float]) -> Plane:
        """q for values of all unknowns, in the order of the columns.

        Where it leaves the measured range it is cut off: springs and sliding direction follow it in
        the next round, and a wrong form could carry them away.
        """
        q = self.offset + np.tensordot(np.array(list(values.values())), self.columns, 1)
        q = np.array([
            np.clip(q[0], *_range(track.y, track.run.noise.get("y", 0.0), 0.0)),
            np.clip(q[1], *_range(track.phi, track.run.noise.get("phi", 0.0), MOST_TURN)),
        ])  # fmt: skip
        rates = np.gradient(q, track.interval, axis=1)
        curvature, turn, shift = (values.get(name, 0.0) for name in (CURVATURE, TURN, SHIFT))
        share = float(np.exp(values[SHARE])) if SHARE in values else 0.0
        return Plane(q[0], q[1], rates[0], rates[1], curvature, turn, shift, share)


def _range(values: np.ndarray | None, noise: float, most: float) -> tuple[float, float]:
    """Least and largest measured value, m or rad; -most and most where there are none."""
    if values is None:
        return -most, most
    return float(np.min(values)) - noise, float(np.max(values)) + noise


def course(
    track: SmoothTrack, rig: Rig, friction: float, unknowns: tuple[str, ...], about: Plane
) -> Course:
    """Solution of the equation, linear about a plane. friction : mu_k N, N."""
    h, x, v = track.interval, track.place, track.surface_speed
    mass = np.array([track.run.mass, inertia(rig, track.run.mass)])[:, None]
    drag = _drag(track, rig, friction, about) if SHARE in unknowns else np.zeros((2, x.size))
    load = np.array(about.loads(rig, track.run.stiffness, x)[1:])
    here = np.array([about.y, about.phi])
    slope = np.array([_slope(about, track, rig, name, load) for name in ("y", "phi")])
    surface = np.array([v * x, v])
    columns = {
        CURVATURE: drag * surface,
        TURN: _slope(about, track, rig, "turn", load),
        SHIFT: -slope[0],
        SHARE: drag * (about.curvature * surface - [about.velocity_y, about.turning]),
    }
    known = {CURVATURE: 0.0, TURN: about.turn, SHIFT: about.shift,
             SHARE: np.log(max(about.share, 1e-12))}  # fmt: skip
    right = np.zeros((1 + len(unknowns) + len(STARTS), 2, x.size))
    right[0] = load - np.einsum("qcn,qn->cn", slope, here)
    for number, name in enumerate(unknowns, 1):
        right[number] = columns[name]
        right[0] -= columns[name] * known[name]
    solved = _solve(mass, drag, slope, right, h)
    return Course(solved[0], solved[1:])


def _drag(track: SmoothTrack, rig: Rig, friction: float, about: Plane) -> np.ndarray:
    """(2, n) W, N s/m and N m s; in stick as at next to no sliding speed."""
    radius = rig.contact_radius
    _, sliding, spin = about.sliding(track, radius)
    sliding = np.where(track.slips_mask, np.maximum(sliding, SLOWEST_SLIDING), SLOWEST_SLIDING)
    spin = np.where(track.slips_mask, spin, 0.0)
    force, moment = disc(sliding, spin)
    slow = spin < 1e-3 * sliding
    per_spin = np.where(slow, 0.25 / sliding, moment / np.where(slow, 1.0, spin))
    share = about.share * friction
    return np.array([share * force / sliding, share * radius**2 * per_spin])


def _slope(about: Plane, track: SmoothTrack, rig: Rig, name: str, load: np.ndarray) -> np.ndarray:
    """(2, n) derivative of the springs' force along y and moment."""
    more = replace(about, **{name: getattr(about, name) + PLANE_STEP})
    there = more.loads(rig, track.run.stiffness, track.place)
    return (np.array(there[1:]) - load) / PLANE_STEP


def _solve(
    mass: np.ndarray, drag: np.ndarray, slope: np.ndarray, right: np.ndarray, h: float
) -> np.ndarray:
    """(u, 2, n) q of right sides (u, 2, n); the last three set out from y, y' and phi of 1.

    M (q+ - 2 q + q-) / h^2 + W (b (q+ - q) + (1 - b) (q - q-)) / h - P' q = right, where b makes
    the decay over a step exact (exponential fitting): 1/2 for weak friction, 1 in stick. One
    triangular band matrix for all right sides.
    """
    n = right.shape[2]
    decay = np.maximum(drag * h / mass, 1e-6)
    b = 1.0 / -np.expm1(-decay) - 1.0 / decay
    after = mass / h**2 + drag * b / h
    now = -2.0 * mass / h**2 + drag * (1.0 - 2.0 * b) / h
    before = mass / h**2 - drag * (1.0 - b) / h
    bands = np.zeros((5, 2 * n))  # row d, column j: entry (j + d, j); q in the order y, phi, y, ...
    bands[0, 2::2], bands[0, 3::2] = after[:, :-1]
    bands[0, :2] = 1.0
    bands[2, :-2:2], bands[2, 1:-2:2] = now[:, :-1] - slope[[0, 1], [0, 1], :-1]
    bands[3, :-2:2] = -slope[0, 1, :-1]  # of y on the moment
    bands[1, 1:-2:2] = -slope[1, 0, :-1]  # of phi on the force
    bands[4, :-4:2], bands[4, 1:-4:2] = before[:, 1:-1]
    sides = np.zeros((2 * n, right.shape[0]))
    sides[2::2], sides[3::2] = right[:, 0, :-1].T, right[:, 1, :-1].T
    sides[0, -3] = sides[1, -1] = 1.0
    # q- of the first step is q - h q': it joins the entries of q, and y' the right side
    bands[2, :2] += before[:, 0]
    sides[2, -2] = before[0, 0] * h
    solved, info = dtbtrs(bands, sides, uplo="L")
    if info != 0:
        raise ArithmeticError(f"dtbtrs: {info}")
    return np.asarray(solved.T.reshape(right.shape[0], n, 2).transpose(0, 2, 1))
