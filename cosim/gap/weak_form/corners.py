"""Corners of a track, where a block that stuck lets go and where it sticks again, as rows.

Inside a slip, or a stick, a linear filter commutes with the equation of motion: what it smooths
obeys the same equation. Where the two meet it does not. The path of an ideal contact goes from the
line of the stick to the curve of the slip without a step in place and speed: the curve touches the
line at t_c, where its speed is the surface's, V. A filter of the variance w^2 moves the curve by
w^2/2 x'' and leaves the line, which opens a gap of w^2/2 x''(t_c) between them.

A test function with phi = 0 and phi' = 1 at the corner sees that, and sees an error d of t_c by
x'' d^2 / 2 alone:

    integral over the slip of m phi'' (x - x_line(t_c)) + phi F(x) dt = integral of phi (friction)

with x_line(t_c) from a straight line through the samples of the stick next to it. What slips and
sticks have said already is taken out of these rows by the noise that they share.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, fields, replace

import numpy as np
from scipy.interpolate import interp1d
from scipy.linalg import solve_triangular

from cosim.gap.weak_form.constants import CORNER_CONTACT, CORNER_SHORTEST, KNOTS
from cosim.gap.weak_form.rows import SLIP, STICK, Response, RunRows
from cosim.gap.weak_form.track import SmoothTrack
from cosim.gap.weak_form.unknowns import Unknown, column

#: Kind of these rows, after those of `rows`.
CORNER = 4
#: Part of a row's variance that is left to it at least: what rounding leaves of the difference.
FLOOR = 1e-3


@dataclass(frozen=True)
class CornerResponse(Response):
    """With what opens a gap at corners: (corners, q) m, by which the curve is beyond the line."""

    gap: np.ndarray | None = None


@dataclass(frozen=True)
class Corner:
    """One corner.

    Attributes
    ----------
    time : t_c, s
    breaks : lets go; otherwise it sticks again
    swing : size (m) and turn (rad) of the slip's curve x_k + size cos(omega (t - t_c) + turn)
    acceleration : of that curve at t_c, m/s^2
    weights : (3, n) on the grid: of a force, s m; of the part m x''; of the line at t_c; None:
        slip or stick are too short for a row
    """

    time: float
    breaks: bool
    swing: tuple[float, float]
    acceleration: float
    weights: np.ndarray | None = field(repr=False)


@dataclass(frozen=True)
class CornerRows(RunRows):
    """Rows of a run with those of its corners behind all others.

    before : the others. touched : every corner that was found; corners : those with a row;
    force, bend, line (c, n) : weights of these, see `Corner`. shared (c, rows) : covariance with
    the rows before; lower (c, c) : Cholesky factor of what is left of their own
    """

    before: RunRows = field(repr=False)
    touched: tuple[Corner, ...]
    corners: tuple[Corner, ...]
    force: np.ndarray = field(repr=False)
    bend: np.ndarray = field(repr=False)
    line: np.ndarray = field(repr=False)
    shared: np.ndarray = field(repr=False)
    lower: np.ndarray = field(repr=False)

    def respond(self, response: Response, unknowns: int) -> np.ndarray:
        """(rows, q) of unit noise."""
        before = self.before.respond(response, unknowns)
        after = self.whitened(self._responded(response, unknowns), before)
        return np.asarray(self.counted[:, None] * np.concatenate([before, after]))

    def whitened(self, rows: np.ndarray, before: np.ndarray) -> np.ndarray:
        """(c, q) of unit noise, of what the rows before have not said."""
        if not self.corners:  # LAPACK may not be asked for nothing
            return rows
        left = rows - self.shared @ before
        return np.asarray(solve_triangular(self.lower, left, lower=True))

    @property
    def _held(self) -> np.ndarray:
        """(c, 1) kg, by which the line's place counts."""
        return np.asarray(-self.bend.sum(axis=1, keepdims=True))

    def _responded(self, response: Response, unknowns: int) -> np.ndarray:
        rows = np.zeros((len(self.corners), unknowns))
        if response.force is not None:
            rows += self.force @ response.force
        if response.place is not None:
            stiffness = self.track.run.total_stiffness
            rows += self.of_places(response.place) + self.force @ (stiffness * response.place)
        if response.inertia is not None:
            rows -= self.of_places(self.track.x[:, None]) * response.inertia
        if response.speed is not None:
            carried = np.cumsum(response.speed, axis=0) * self.track.interval
            there = interp1d(self.track.time, carried, axis=0)
            rows += self._held * (self.line @ carried - there([c.time for c in self.corners]))
        if isinstance(response, CornerResponse) and response.gap is not None:
            rows -= self._held * response.gap
        return rows

    def of_places(self, places: np.ndarray) -> np.ndarray:
        """(c, q) integral of m phi'' (x - x_line) for places (n, q)."""
        return np.asarray(self.bend @ places + self._held * (self.line @ places))


def with_corners(rows: RunRows) -> RunRows:
    """The rows of a run, and those of its corners if it has any."""
    track, run = rows.track, rows.track.run
    touched = tuple(corner for slip in track.slips for corner in _corners_of(track, slip))
    if not touched:
        return rows
    rowed = tuple(corner for corner in touched if corner.weights is not None)
    shape = (len(rowed), 3, track.time.size)
    force, bend, line = np.reshape([each.weights for each in rowed], shape).swapaxes(0, 1)
    places = bend - bend.sum(axis=1, keepdims=True) * line + run.total_stiffness * force
    samples = places if track.errors is None else (track.errors.T @ places.T).T
    shared = run.noise["x"] * _along(rows, samples)
    own = run.noise["x"] ** 2 * samples @ samples.T
    left = own - shared @ shared.T + FLOOR * np.diag(np.diag(own))
    try:
        lower = np.linalg.cholesky(left)
    except np.linalg.LinAlgError:  # the others say all that these do
        return rows
    kinds = np.concatenate([rows.kinds, np.full(len(rowed), CORNER)])
    before = replace(rows, track=_swinging(track, touched))
    common = {each.name: getattr(before, each.name) for each in fields(RunRows)}
    common |= {"kinds": kinds, "counted": np.ones(kinds.size)}
    made = CornerRows(**common, before=before, touched=touched, corners=rowed, force=force,
                      bend=bend, line=line, shared=shared, lower=lower)  # fmt: skip
    # what the sums make of a path V (t - t_c), of which the integral makes nothing
    lever = track.time - np.array([corner.time for corner in rowed]).reshape(-1, 1)
    sums = run.surface_speed * np.sum(bend * lever, axis=1, keepdims=True)
    values = made.of_places(track.x[:, None]) + (force @ rows.restoring)[:, None] - sums
    values = made.whitened(values, rows.values[:, None])
    return replace(made, values=np.concatenate([rows.values, values[:, 0]]))


def _swinging(track: SmoothTrack, corners: tuple[Corner, ...]) -> SmoothTrack:
    """With the swing's own sliding speed and acceleration next to corners, inside their slips.

    There a smoothed velocity is mostly noise, and as often as not of the wrong sign.
    """
    sliding, acceleration = track.sliding.copy(), track.acceleration.copy()
    omega = track.run.natural_frequency
    for corner in corners:
        since = omega * (track.time - corner.time)
        near = since if corner.breaks else -since
        here = (near > 0.0) & (near < 2.0 * KNOTS)
        (size, turn), angle = corner.swing, since[here]
        sliding[here] = track.run.surface_speed + omega * size * np.sin(angle + turn)
        acceleration[here] = -(omega**2) * size * np.cos(angle + turn)
    return replace(track, sliding=sliding, acceleration=acceleration)


def _along(rows: RunRows, samples: np.ndarray) -> np.ndarray:
    """(c, rows) products of weights of the samples (c, m) with those of slips and sticks."""
    matrix = rows.track.errors
    gridded = samples.T if matrix is None else matrix @ samples.T
    products = np.zeros((rows.values.size, samples.shape[0]))
    for kind, block in ((SLIP, rows.slip), (STICK, rows.stick)) if samples.size else ():
        products[rows.kinds == kind] = rows.track.run.noise["x"] * block.whitened(
            block.place @ gridded
        )
    return products.T


def _corners_of(track: SmoothTrack, slip: tuple[int, int]) -> Iterator[Corner]:
    """Where the free swing inside a slip has the surface's speed V, next to either end.

    x_k + R cos(omega (t - t_0) - psi) has it where the sine is -V / (omega R).
    """
    omega, speed = track.run.natural_frequency, track.run.surface_speed
    margin = round(KNOTS / omega / track.interval)
    inside = slice(slip[0] + margin, slip[1] - margin)
    time = track.time[inside]
    if time.size < 6 or time[-1] - time[0] < CORNER_SHORTEST / omega:
        return
    angle = omega * (time - time[0])
    shapes = np.column_stack([np.ones_like(angle), np.cos(angle), np.sin(angle)])
    _, a, b = np.linalg.lstsq(shapes, track.x[inside], rcond=None)[0]
    size, lag = np.hypot(a, b), np.arctan2(b, a)
    for breaks, end in ((True, slip[0]), (False, slip[1])):
        if not 0 < end < track.time.size or not track.seen[end - 1 : end + 1].all():
            continue
        turn = np.arcsin(np.clip(speed / (omega * size), -1.0, 1.0))
        turn = -turn if (speed > 0.0) == breaks else np.pi + turn
        near = omega * (track.time[end] - time[0])
        at = lag + turn + 2.0 * np.pi * np.round((near - lag - turn) / (2.0 * np.pi))
        if abs(np.cos(turn)) >= 0.2 and abs(at - near) <= 0.5:
            touches = float(time[0] + at / omega)
            weights = _weights(track, slip, touches, breaks)
            acceleration = float(-(omega**2) * size * np.cos(turn))
            yield Corner(touches, breaks, (float(size), float(turn)), acceleration, weights)


def _stick_beside(track: SmoothTrack, end: int, breaks: bool) -> slice | None:
    """The stick that ends, or begins, next to the end of a slip; no more of it than is straight."""
    omega = track.run.natural_frequency
    reach = round(3.0 * CORNER_SHORTEST / omega / track.interval)
    near = round(2.5 * KNOTS / omega / track.interval) + 1
    for first, last in track.sticks:
        beside = 0 <= (end - last if breaks else first - end) <= near
        if beside and last - first > max(4, round(CORNER_SHORTEST / omega / track.interval)):
            return (
                slice(max(first, last - reach), last)
                if breaks
                else slice(first, min(last, first + reach))
            )
    return None


def _weights(
    track: SmoothTrack, slip: tuple[int, int], time: float, breaks: bool
) -> np.ndarray | None:
    """(3, n) of a corner, see `Corner`; phi = u (1 - u)^4 (1 + 4 u) over its part of the slip.

    That is smooth enough at its far end for sums over samples.
    """
    omega = track.run.natural_frequency
    stick = _stick_beside(track, slip[0] if breaks else slip[1], breaks)
    length = (slip[1] - slip[0]) * track.interval - KNOTS / omega
    length = min(length, 3.0 * CORNER_SHORTEST / omega)
    u = (track.time - time) / (length if breaks else -length)
    inside = (u > 0.0) & (u < 1.0)
    too_short = length < CORNER_SHORTEST / omega or inside.sum() < 6
    if stick is None or too_short or not (track.seen[inside].all() and track.seen[stick].all()):
        return None
    phi = np.polynomial.Polynomial([0.0, 1.0, 0.0, -10.0, 20.0, -15.0, 4.0])
    line, lever = np.zeros_like(u), track.time[stick] - track.time[stick].mean()
    ahead = time - track.time[stick].mean()
    line[stick] = 1.0 / lever.size + ahead * lever / np.sum(lever**2)
    force = track.interval * length * phi(u) * inside
    bend = track.run.mass * track.interval * phi.deriv(2)(u) / length * inside
    return np.array([force, bend, line])


def corner_contact() -> list[Unknown]:
    """Gaps at corners that a contact leaves by itself, where it lets go and where it grips again.

    Bristles that give way by z under mu m g give way by z J / (mu g) where the force on them jumps
    by m J: as a filter does with w^2 = 2 z / (mu g).
    """

    def gaps(run: RunRows, breaks: bool) -> Response:
        if not isinstance(run, CornerRows):
            return Response()
        sizes = [0.5 * c.acceleration * (c.breaks == breaks) for c in run.corners]
        return CornerResponse(gap=column(sizes))

    prior = CORNER_CONTACT**2 * np.eye(1)
    return [
        Unknown("contact", "gap where it lets go", lambda run: gaps(run, True), prior),
        Unknown("contact", "gap where it grips", lambda run: gaps(run, False), prior),
    ]
