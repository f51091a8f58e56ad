"""Motion across the surface, y and phi, as springs and friction make it of the measured x.

Along x everything is measured; what is left is a linear equation for q = (y, phi),

    M q'' + W (q' - V c (x, 1)) = P(x, q),    M = diag(m, J),

with the springs P, linear about the measured q (phi of the last round, where it is not measured),
and friction that goes with the direction of
sliding (`stickslip.kernel.friction`; U sliding speed, s rim speed, f and m of the disc):

    W = g mu_k N diag(f / U, a^2 m / s),    U^2 = U_x^2 + g U_y^2,    s^2 = g a^2 Omega^2.

g is the square of lateral_friction.ratio. In stick U goes to zero, W beyond all bounds, and q moves
with the surface: one equation for the whole record, in which errors of the measured motion do not
add up, as friction makes y a matter of the distance slid, not of time.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from scipy.linalg.lapack import dtbtrs

from cosim.gap.data import MeasuredRun
from cosim.gap.data.campaign_file import Rig
from cosim.gap.weak_form.constants import (
    MOST_TURN,
    QUINTIC_REACH,
    SLOWEST_SLIDING,
    STILL_PIECE,
    STILL_SIGMAS,
)
from cosim.gap.weak_form.rig_geometry import spring_loads
from cosim.gap.weak_form.track import SmoothTrack, derivatives, stretches

#: Unknowns of a form: 1/R (1/m), angle by which the surface runs askew under the resting block (a
#: slab's centre ahead of it, rad), ln g; turn of each spring and of their frame (rad), shift of all
#: anchors and of those on one diagonal against the others (m).
CURVATURE, ASKEW, SHARE = "curvature", "askew", "share"
PLACED = TURN, FRAME, SHIFT, DIAGONAL = "turn", "frame", "shift", "diagonal"
#: Unknowns of every run: parts by which the springs are stiffer along y, as their pretension makes
#: them, and against a turn, as inertia and places of the hooks seem to; then, for each piece of the
#: record without a hole, y (m), y' (m/s), phi (rad) and its rate (rad/s) where that begins.
SPRINGS, STATES = 2, 4


def moves_across(run: MeasuredRun) -> bool:
    """Whether means of a run's y over short pieces differ by more than noise makes them."""
    y = run.motion["y"][np.isfinite(run.motion["y"])]
    means = y[: y.size // STILL_PIECE * STILL_PIECE].reshape(-1, STILL_PIECE).mean(axis=1)
    free = means.size - 1
    if free < 1:
        return False
    square = free * np.var(means, ddof=1) * STILL_PIECE / run.noise["y"] ** 2
    return bool(square > free + STILL_SIGMAS * np.sqrt(2.0 * free))


@dataclass(frozen=True)
class Plane:
    """What a run does in the plane.

    Attributes
    ----------
    y, phi : (n,) m, rad; velocity_y, turning : (n,) m/s, rad/s, in the steps of the grid
    curvature, askew, turn, frame, shift, diagonal : of surface and springs, 1/m, rad, m
    share : g, how much friction acts across, as part of that along x
    """

    y: np.ndarray
    phi: np.ndarray
    velocity_y: np.ndarray
    turning: np.ndarray
    curvature: float = 0.0
    askew: float = 0.0
    turn: float = 0.0
    frame: float = 0.0
    shift: float = 0.0
    diagonal: float = 0.0
    share: float = 0.0

    def at(self, point: int) -> Plane:
        """At one point of the grid."""
        here = slice(point, point + 1)
        return replace(self, y=self.y[here], phi=self.phi[here],
                       velocity_y=self.velocity_y[here], turning=self.turning[here])  # fmt: skip

    def drive(self, speed: np.ndarray | float) -> np.ndarray:
        """(n,) speed along x of the surface under the block, of its speed on the axis, m/s."""
        return np.asarray(speed * (1.0 - self.curvature * self.y))

    def drift(self, speed: np.ndarray, x: np.ndarray) -> np.ndarray:
        """(n,) speed along y of the surface under the block, m/s."""
        return speed * (self.curvature * x + self.askew)

    def sliding(self, track: SmoothTrack, radius: float) -> tuple[np.ndarray, ...]:
        """(n,) each: U_x of the surface over the block; U; and s: m/s."""
        speed = track.surface_speed
        along = self.drive(speed) - track.velocity
        ratio = np.sqrt(self.share)
        across = ratio * (self.drift(speed, track.place) - self.velocity_y)
        spin = ratio * radius * np.abs(speed * self.curvature - self.turning)
        return along, np.hypot(along, across), spin

    def loads(self, rig: Rig, stiffness: float, x: np.ndarray) -> np.ndarray:
        """(3, n) forces of the springs along x and y, N, and moment, N m, at places x (n,)."""
        y = self.y - self.shift
        return spring_loads(rig, stiffness, x, y, self.phi, self.turn, self.frame, self.diagonal)


def measured(track: SmoothTrack) -> Plane:
    """As the tracker saw it, smoothed; a turn that it did not see is none."""
    phi = np.zeros((2, track.time.size))
    if track.phi is not None:
        reach = QUINTIC_REACH / track.run.natural_frequency
        phi = derivatives(track.phi, track.interval, reach, 5)[:2]
    return Plane(track.place_y, phi[0], track.velocity_y, phi[1])


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

        Where it leaves the measured range it is cut off: sliding direction and springs follow it in
        the next round, and a wrong form could carry them away.
        """
        q = self.offset + np.tensordot(np.array(list(values.values())), self.columns, 1)
        q = np.array([_within(q[0], track.y, 0.0), _within(q[1], track.phi, MOST_TURN)])
        rates = np.gradient(q, track.interval, axis=1)
        known = {name: values[name] for name in (CURVATURE, ASKEW, *PLACED) if name in values}
        share = float(np.exp(values[SHARE])) if SHARE in values else 0.0
        return Plane(q[0], q[1], rates[0], rates[1], share=share, **known)


def _within(values: np.ndarray, seen: np.ndarray | None, most: float) -> np.ndarray:
    """Cut off at the least and the largest that was seen; at -most and most where nothing was."""
    if seen is None:
        return np.asarray(np.clip(values, -most, most))
    return np.asarray(np.clip(values, np.min(seen), np.max(seen)))


def pieces(track: SmoothTrack) -> list[int]:
    """Grid points where the record begins, and after holes too long to know the motion in them.

    What springs do while nobody sees where the block is would swing on for the rest of the record.
    """
    longest = QUINTIC_REACH / track.run.natural_frequency / track.interval
    holes = ((first, last) for first, last in stretches(~track.seen) if last - first > longest)
    # the first sample after a hole lies behind the last point that is not seen
    return [0, *(last - 1 for first, last in holes if 0 < first and last < track.time.size - 1)]


def course(
    track: SmoothTrack, rig: Rig, friction: float, unknowns: tuple[str, ...], about: Plane
) -> Course:
    """Solution of the equation, linear about a plane. friction : mu_k N, N."""
    h, x, v = track.interval, track.place, track.surface_speed
    mass = np.array([track.run.mass, inertia(rig, track.run.mass)])[:, None]
    drag = _drag(track, rig, friction, about) if SHARE in unknowns else np.zeros((2, x.size))
    held = measured(track)
    held = replace(about, y=held.y, phi=about.phi if track.phi is None else held.phi)
    load = held.loads(rig, track.run.stiffness, x)[1:]
    slope = np.array([_slope(held, track, rig, name) for name in ("y", "phi")])
    surface = np.array([v * x, v])
    columns = {
        CURVATURE: drag * surface,
        ASKEW: drag * [v, np.zeros_like(v)],
        SHARE: drag * [about.drift(v, x) - about.velocity_y, about.curvature * v - about.turning],
    }
    columns |= {name: _slope(held, track, rig, name) for name in PLACED if name in unknowns}
    known = {CURVATURE: 0.0, ASKEW: 0.0, SHARE: np.log(max(about.share, 1e-12))}
    known |= {name: getattr(about, name) for name in PLACED}
    starts = pieces(track)
    right = np.zeros((1 + len(unknowns) + SPRINGS + STATES * len(starts), 2, x.size))
    right[0] = load - np.einsum("qcn,qn->cn", slope, [held.y, held.phi])
    for number, name in enumerate(unknowns, 1):
        right[number] = columns[name]
        right[0] -= columns[name] * known[name]
    right[1 + len(unknowns), 0], right[2 + len(unknowns), 1] = load
    solved = _solve(mass, drag, slope, right, h, starts)
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


def _slope(about: Plane, track: SmoothTrack, rig: Rig, name: str) -> np.ndarray:
    """(2, n) derivative of the springs' force along y and moment, by a complex step."""
    more = replace(about, **{name: getattr(about, name) + 1e-20j})
    return np.imag(more.loads(rig, track.run.stiffness, track.place)[1:]) / 1e-20


def _solve(
    mass: np.ndarray, drag: np.ndarray, slope: np.ndarray, right: np.ndarray, h: float,
    starts: Sequence[int],
) -> np.ndarray:  # fmt: skip
    """(u, 2, n) q of right sides (u, 2, n); the last set out from y, y', phi, phi' of 1 at starts.

    M (q+ - 2 q + q-) / h^2 + W (b (q+ - q) + (1 - b) (q - q-)) / h - P' q = right, where b makes
    the decay over a step exact (exponential fitting): 1/2 for weak friction, 1 in stick; and M
    is larger by what makes the period of each swing exact, which nothing damps for hundreds of
    periods. One triangular band matrix for all right sides.
    """
    n = right.shape[2]
    swing = 0.5 * h * np.sqrt(np.maximum(-slope[[0, 1], [0, 1]] / mass, 0.0))
    mass = mass / np.sinc(swing / np.pi) ** 2
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
    # q- of a start's step is q - h q'
    for number, at in enumerate(starts):
        first = right.shape[0] - STATES * (len(starts) - number)
        for row, column in ((0, first), (1, first + 2)):
            sides[2 * at + row, column] = after[row, at - 1] if at else 1.0
            sides[2 * at + 2 + row, column] = -before[row, at]
            sides[2 * at + 2 + row, column + 1] = before[row, at] * h
    solved, info = dtbtrs(bands, sides, uplo="L")
    if info != 0:
        raise ArithmeticError(f"dtbtrs: {info}")
    return np.asarray(solved.T.reshape(right.shape[0], n, 2).transpose(0, 2, 1))
