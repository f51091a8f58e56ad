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

from dataclasses import dataclass, field, fields, replace

import numpy as np
from scipy.linalg import solve_triangular

from cosim.gap.weak_form.constants import (
    CORNER_CONTACT,
    CORNER_LINE,
    CORNER_REACH,
    CORNER_SHORTEST,
    STICK_MARGIN,
)
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
    time : t_c, s; at : the next grid point
    breaks : lets go; otherwise it sticks again
    swing : a, b of the slip's curve x_k + a cos omega (t - t_c) + b sin omega (t - t_c), m
    acceleration : of that curve at t_c, m/s^2
    """

    time: float
    at: int
    breaks: bool
    swing: tuple[float, float]
    acceleration: float


@dataclass(frozen=True)
class CornerRows(RunRows):
    """Rows of a run with those of its corners behind all others.

    before : the others. touched : every corner that was found; corners : those between a slip and a
    stick that are long enough for a row. Weights on the grid of n points, for c corners:
    force (c, n) s m, of a force; bend (c, n), the part of m x''; line (c, n), of the line at t_c.
    shared (c, rows) : covariance with the rows before; lower (c, c) : Cholesky factor of what is
    left of their own
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
        return self.counted[:, None] * np.concatenate([before, after])

    def whitened(self, rows: np.ndarray, before: np.ndarray) -> np.ndarray:
        """(c, q) of unit noise, of what the rows before have not said."""
        if not self.corners:
            return rows
        left = rows - self.shared @ before
        return np.asarray(solve_triangular(self.lower, left, lower=True)).reshape(rows.shape)

    @property
    def _held(self) -> np.ndarray:
        """(c,) kg, by which the line's place counts."""
        return -self.bend.sum(axis=1)

    def _responded(self, response: Response, unknowns: int) -> np.ndarray:
        rows = np.zeros((len(self.corners), unknowns))
        if not self.corners:
            return rows
        if response.force is not None:
            rows += self.force @ response.force
        if response.place is not None:
            rows += self._of_places(response.place)
            rows += self.force @ (self.track.run.total_stiffness * response.place)
        if response.inertia is not None:
            rows -= np.outer(self._of_places(self.track.x), response.inertia)
        if response.speed is not None:
            carried = np.cumsum(response.speed, axis=0) * self.track.interval
            there = [_at(carried, self.track, corner.time) for corner in self.corners]
            rows += self._held[:, None] * (self.line @ carried - np.array(there))
        if isinstance(response, CornerResponse) and response.gap is not None:
            rows -= self._held[:, None] * response.gap
        return rows

    def _of_places(self, places: np.ndarray) -> np.ndarray:
        """Integral of m phi'' (x - x_line) for places (n,) or (n, q)."""
        line = self.line @ places
        held = self._held if line.ndim == 1 else self._held[:, None]
        return np.asarray(self.bend @ places + held * line)


def _at(values: np.ndarray, track: SmoothTrack, time: float) -> np.ndarray:
    """(q,) of values (n, q) at a time."""
    place = np.clip((time - track.time[0]) / track.interval, 0, track.time.size - 1.001)
    first, part = int(place), place - int(place)
    return np.asarray((1.0 - part) * values[first] + part * values[first + 1])


def with_corners(rows: RunRows) -> RunRows:
    """The rows of a run, and those of its corners if it has any."""
    track = rows.track
    found = [(slip, corner) for slip in track.slips for corner in _corners_of(track, slip)]
    if not found:
        return rows
    touched = tuple(corner for _, corner in found)
    track = _swinging(track, touched)
    rowed = [made for pair in found if (made := _weights(track, *pair)) is not None]
    shape = (len(rowed), track.time.size)
    force, bend, line = (np.reshape([each[n] for each in rowed], shape) for n in (1, 2, 3))
    places = bend - bend.sum(axis=1)[:, None] * line + track.run.total_stiffness * force
    shared, lower = _covariances(rows, _sampled(track, places))
    if lower is None:  # the others say all that these do
        return rows
    kinds = np.concatenate([rows.kinds, np.full(len(rowed), CORNER)])
    before = replace(rows, track=track)
    common = {each.name: getattr(before, each.name) for each in fields(RunRows)}
    common |= {"kinds": kinds, "counted": np.ones(kinds.size)}
    all_rows = CornerRows(
        **common, before=before, touched=touched, corners=tuple(each[0] for each in rowed),
        force=force, bend=bend, line=line, shared=shared, lower=lower,
    )  # fmt: skip
    values = all_rows._of_places(track.x) + force @ rows.restoring - _quadrature(all_rows)
    values = all_rows.whitened(values[:, None], rows.values[:, None])[:, 0]
    return replace(all_rows, values=np.concatenate([rows.values, values]))


def _quadrature(rows: CornerRows) -> np.ndarray:
    """(c,) N s m: what the sums make of a path V (t - t_c), of which the integral makes nothing."""
    lever = rows.track.time - np.array([corner.time for corner in rows.corners]).reshape(-1, 1)
    return rows.track.run.surface_speed * np.sum(rows.bend * lever, axis=1)


def _covariances(rows: RunRows, samples: np.ndarray) -> tuple[np.ndarray, np.ndarray | None]:
    """Of corners' rows, weights of the samples (c, m): with all before, and what is left's factor.

    None where nothing is left, to rounding.
    """
    noise = rows.track.run.noise["x"]
    shared = noise**2 * _along(rows, samples)
    own = noise**2 * samples @ samples.T - shared @ shared.T
    own[np.diag_indices_from(own)] += FLOOR * noise**2 * np.sum(samples**2, axis=1)
    try:
        return shared, np.linalg.cholesky(own)
    except np.linalg.LinAlgError:
        return shared, None


def _swinging(track: SmoothTrack, corners: tuple[Corner, ...]) -> SmoothTrack:
    """With the swing's own sliding speed and acceleration next to corners, inside their slips.

    There a smoothed velocity is mostly noise, and as often as not of the wrong sign.
    """
    sliding, acceleration = track.sliding.copy(), track.acceleration.copy()
    omega = track.run.natural_frequency
    for corner in corners:
        since = track.time - corner.time
        near = (since if corner.breaks else -since) * omega
        here = (near > 0.0) & (near < 2.0 * STICK_MARGIN)
        (a, b), angle = corner.swing, omega * since[here]
        sliding[here] = track.run.surface_speed - omega * (b * np.cos(angle) - a * np.sin(angle))
        acceleration[here] = -(omega**2) * (a * np.cos(angle) + b * np.sin(angle))
    return replace(track, sliding=sliding, acceleration=acceleration)


def _sampled(track: SmoothTrack, weights: np.ndarray) -> np.ndarray:
    """Weights on the grid (c, n) as those of the file's samples."""
    return weights if track.samples is None else np.asarray((track.samples.T @ weights.T).T)


def _along(rows: RunRows, samples: np.ndarray) -> np.ndarray:
    """(c, rows) products of weights of the samples (c, m) with those of slips and sticks."""
    matrix = rows.track.samples
    gridded = samples.T if matrix is None else matrix @ samples.T
    products = np.zeros((rows.values.size, samples.shape[0]))
    if samples.shape[0] == 0:  # LAPACK may not be asked for nothing
        return products.T
    for kind, block in ((SLIP, rows.slip), (STICK, rows.stick)):
        products[rows.kinds == kind] = block.whitened(block.place @ gridded)
    return products.T


#: A corner with its weights of a force, of m x'', and of the line.
_Weighted = tuple[Corner, np.ndarray, np.ndarray, np.ndarray]


def _corners_of(track: SmoothTrack, slip: tuple[int, int]) -> list[Corner]:
    """The corners at the ends of a slip that a stick, however short, lies beside."""
    swing = _swing(track, slip)
    if swing is None:
        return []
    found = []
    for breaks, end in ((True, slip[0]), (False, slip[1])):
        inside = 0 < end < track.time.size and bool(track.seen[end - 1 : end + 1].all())
        corner = _touching(track, swing, end, breaks) if inside else None
        if corner is not None:
            found.append(corner)
    return found


def _swing(track: SmoothTrack, slip: tuple[int, int]) -> tuple[float, float, float] | None:
    """(a, b, t_0) of a free swing x_k + a cos omega (t - t_0) + b sin ... inside the slip."""
    omega = track.run.natural_frequency
    margin = round(STICK_MARGIN / omega / track.interval)
    inside = slice(slip[0] + margin, slip[1] - margin)
    time = track.time[inside]
    if time.size < 6 or time[-1] - time[0] < CORNER_SHORTEST / omega:
        return None
    angle = omega * (time - time[0])
    shapes = np.column_stack([np.ones_like(angle), np.cos(angle), np.sin(angle)])
    _, a, b = np.linalg.lstsq(shapes, track.x[inside], rcond=None)[0]
    return float(a), float(b), float(time[0])


def _touching(
    track: SmoothTrack, swing: tuple[float, float, float], end: int, breaks: bool
) -> Corner | None:
    """Where the swing has the surface's speed, near the end of the slip."""
    (a, b, start), omega = swing, track.run.natural_frequency
    speed = track.run.surface_speed
    time = float(track.time[min(end, track.time.size - 1)])
    for _ in range(8):
        angle = omega * (time - start)
        velocity = omega * (b * np.cos(angle) - a * np.sin(angle))
        acceleration = -(omega**2) * (a * np.cos(angle) + b * np.sin(angle))
        step = (speed - velocity) / acceleration if acceleration else 0.0
        time += float(np.clip(step, -0.2 / omega, 0.2 / omega))
    size = omega**2 * np.hypot(a, b)
    slows = acceleration * np.sign(speed) < 0.0
    if abs(velocity - speed) > 1e-3 * abs(speed) or abs(acceleration) < 0.2 * size:
        return None
    if slows != breaks or abs(time - track.time[min(end, track.time.size - 1)]) > 0.5 / omega:
        return None
    at = int(np.ceil((time - track.time[0]) / track.interval))
    turned = omega * (time - start)
    cosine = float(a * np.cos(turned) + b * np.sin(turned))
    sine = float(b * np.cos(turned) - a * np.sin(turned))
    return Corner(time, at, breaks, (cosine, sine), float(acceleration))


def _stick_beside(track: SmoothTrack, end: int, breaks: bool) -> tuple[int, int] | None:
    """The stick that ends, or begins, next to the end of a slip; no more of it than is straight."""
    omega = track.run.natural_frequency
    reach = round(CORNER_LINE / omega / track.interval)
    near = round(2.5 * STICK_MARGIN / omega / track.interval) + 1
    for first, last in track.sticks:
        beside = 0 <= (end - last if breaks else first - end) <= near
        if beside and last - first > max(4, round(CORNER_SHORTEST / omega / track.interval)):
            return (max(first, last - reach), last) if breaks else (first, min(last, first + reach))
    return None


def _weights(track: SmoothTrack, slip: tuple[int, int], corner: Corner) -> _Weighted | None:
    """Of a force, of m x'' and of the line, each (n,); None where slip or stick are too short."""
    stick = _stick_beside(track, slip[0] if corner.breaks else slip[1], corner.breaks)
    if stick is None:
        return None
    omega, since = track.run.natural_frequency, track.time - corner.time
    since = since if corner.breaks else -since
    length = (slip[1] - slip[0]) * track.interval - STICK_MARGIN / omega
    length = min(length, CORNER_REACH / omega)
    u = since / length
    inside = (u > 0.0) & (u < 1.0)
    if length < CORNER_SHORTEST / omega or inside.sum() < 6 or not track.seen[inside].all():
        return None
    u = np.where(inside, u, 0.0)
    # u (1 - u)^4 (1 + 4 u): smooth enough at its far end for sums over samples
    phi = length * (u - 10.0 * u**3 + 20.0 * u**4 - 15.0 * u**5 + 4.0 * u**6)
    second = (-60.0 * u + 240.0 * u**2 - 300.0 * u**3 + 120.0 * u**4) / length
    line = np.zeros_like(u)
    here = slice(*stick)
    if not track.seen[here].all():
        return None
    lever = track.time[here] - track.time[here].mean()
    ahead = corner.time - track.time[here].mean()
    line[here] = 1.0 / lever.size + ahead * lever / np.sum(lever**2)
    return corner, track.interval * phi, track.run.mass * track.interval * second, line


def corner_contact() -> list[Unknown]:
    """Gaps at corners that a contact leaves by itself, where it lets go and where it grips again.

    Bristles that give way by z under mu m g give way by z J / (mu g) where the force on them jumps
    by m J: as a filter does with w^2 = 2 z / (mu g).
    """

    def gaps(breaks: bool):
        def respond(run: RunRows) -> Response:
            if not isinstance(run, CornerRows):
                return Response()
            sizes = [0.5 * c.acceleration * (c.breaks == breaks) for c in run.corners]
            return CornerResponse(gap=column(sizes))

        return respond

    prior = CORNER_CONTACT**2 * np.eye(1)
    return [
        Unknown("contact", "gap where it lets go", gaps(True), prior),
        Unknown("contact", "gap where it grips", gaps(False), prior),
    ]
