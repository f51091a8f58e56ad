"""What is measured of a run, as rows of unit noise; and what unknowns do to them.

Three kinds of rows, each linear in what is unknown:

slip        integral of phi (m x'' + F(x)) dt = integral of phi (friction + other forces) dt
stick       integral of phi (x' - V) dt = integral of phi (what the surface is faster by) dt
break-away  spring force at which the block let go = static friction

phi are B-splines inside one slip or stick; x'' and x' go over to phi by parts.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
from scipy import sparse
from scipy.interpolate import BSpline
from scipy.linalg import cholesky_banded
from scipy.linalg.lapack import dtbtrs
from stickslip.packing import GRAVITY

from cosim.gap.data.campaign_file import Rig
from cosim.gap.weak_form.across import Plane
from cosim.gap.weak_form.breakaway import BreakAway, break_aways
from cosim.gap.weak_form.constants import DAMPED, KNOTS, ROUNDING
from cosim.gap.weak_form.rig_geometry import spring_loads
from cosim.gap.weak_form.track import SmoothTrack

#: Kinds of rows.
SLIP, STICK, BREAK_AWAY = 0, 2, 3


@dataclass(frozen=True)
class Response:
    """What unknowns, q of them, do to one run by each unit; None: nothing.

    Attributes
    ----------
    force : (n, q) N, on the block along x while it slips
    place : (n, q) m, by which the measured x is off
    speed : (n, q) m/s, by which the surface is faster than its set-point
    inertia : (q,) parts by which m x'' counts more
    static : (events, q) N, by which the block holds more before it lets go
    """

    force: np.ndarray | None = None
    place: np.ndarray | None = None
    speed: np.ndarray | None = None
    inertia: np.ndarray | None = None
    static: np.ndarray | None = None


@dataclass(frozen=True)
class _Block:
    """Rows of one kind: weights on the grid, and the Cholesky factor of their covariance.

    force : (r, n) weights of a force or a speed; place : (r, n) of the measured places;
    inertia : (r, n) the part of ``place`` that stands for m x''; all sparse, as splines overlap
    few others. factor : lower bands of the factor
    """

    force: sparse.csr_array
    place: sparse.csr_array
    inertia: sparse.csr_array
    factor: np.ndarray

    def whitened(self, rows: np.ndarray) -> np.ndarray:
        """(r,) or (r, q) rows of unit noise."""
        if rows.shape[0] == 0:
            return rows
        solved, info = dtbtrs(self.factor, rows, uplo="L")
        if info != 0:
            raise ArithmeticError(f"dtbtrs: {info}")
        return np.asarray(solved.reshape(rows.shape))


@dataclass(frozen=True)
class RunRows:
    """The rows of one run.

    values : (rows,) of unit noise: slips, then sticks, then break-aways
    kinds : (rows,) 0 slip, 2 stick, 3 break-away
    restoring : (n,) N, force with which the springs, as stated, pull the block back along x
    counted : (rows,) 1, or 0 for rows that are left out
    """

    track: SmoothTrack
    rig: Rig
    events: tuple[BreakAway, ...]
    slip: _Block = field(repr=False)
    stick: _Block = field(repr=False)
    values: np.ndarray = field(repr=False)
    kinds: np.ndarray = field(repr=False)
    restoring: np.ndarray = field(repr=False)
    counted: np.ndarray = field(repr=False)

    @property
    def weight(self) -> float:
        """Normal force, N."""
        return self.track.run.mass * GRAVITY

    def __len__(self) -> int:
        return self.values.size

    def respond(self, response: Response, unknowns: int) -> np.ndarray:
        """(rows, q) of unit noise."""
        parts = [_slip_part(self.slip, response, unknowns, self.track)]
        parts += [_stick_part(self.stick, response, unknowns), self._static(response, unknowns)]
        return np.asarray(self.counted[:, None] * np.concatenate(parts))

    def only(self, kind: int) -> RunRows:
        """The same, of which rows of one kind alone count."""
        counted = (self.kinds == kind).astype(float)
        return replace(self, values=counted * self.values, counted=counted)

    def _static(self, response: Response, unknowns: int) -> np.ndarray:
        rows = np.zeros((len(self.events), unknowns))
        if not self.events:
            return rows
        if response.static is not None:
            rows = rows + response.static
        if response.place is not None:
            at = [event.at for event in self.events]
            sign = np.sign(self.track.run.surface_speed)
            rows = rows + sign * self.track.run.total_stiffness * response.place[at]
        return np.asarray(rows / np.array([event.sd for event in self.events])[:, None])


def _slip_part(block: _Block, response: Response, unknowns: int, track: SmoothTrack) -> np.ndarray:
    rows = np.zeros((block.force.shape[0], unknowns))
    if response.force is None and response.place is None and response.inertia is None:
        return rows
    if response.force is not None:
        rows += block.force @ response.force
    if response.place is not None:
        rows += block.place @ response.place
    if response.inertia is not None:
        rows -= np.outer(block.inertia @ track.x, response.inertia)
    return block.whitened(rows)


def _stick_part(block: _Block, response: Response, unknowns: int) -> np.ndarray:
    rows = np.zeros((block.force.shape[0], unknowns))
    if response.speed is None and response.place is None:
        return rows
    if response.speed is not None:
        rows += block.force @ response.speed
    if response.place is not None:
        rows += block.place @ response.place
    return block.whitened(rows)


def rows_of(
    track: SmoothTrack, rig: Rig, plane: Plane | None = None,
    events: tuple[BreakAway, ...] | None = None,
) -> RunRows:  # fmt: skip
    """Rows of a run. plane : how the block moves across, where it does; events : None, all seen."""
    run = track.run
    knots = max(1, round(KNOTS / run.natural_frequency / track.interval))
    slip = _block(track, track.slips, _slip_weights(track, knots), run.noise["x"])
    stick = _block(track, track.sticks, _stick_weights(track, knots), run.noise["x"])
    drive = np.full(track.time.size, run.surface_speed)
    loads: Callable[[np.ndarray], np.ndarray] = partial(spring_loads, rig, run.stiffness)
    if plane is not None:
        loads, drive = partial(plane.loads, rig, run.stiffness), plane.drive(run.surface_speed)
    events = break_aways(track, rig, plane) if events is None else events
    values = [
        slip.whitened(slip.inertia @ track.x - slip.force @ loads(track.x)[0]),
        stick.whitened(stick.place @ track.x - stick.force @ drive),
        np.array([event.force / event.sd for event in events]),
    ]
    kinds = np.repeat([SLIP, STICK, BREAK_AWAY], [part.size for part in values])
    return RunRows(track, rig, events, slip, stick, np.concatenate(values), kinds,
                   -loads(track.cause)[0], np.ones(kinds.size))  # fmt: skip


#: Weights of the samples of one spline: of a force, of the places, of the part m x'', of the noise
#: and of what damping makes of it.
_Weights = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]


def _slip_weights(track: SmoothTrack, knots: int) -> _Weights:
    """phi, m phi'' + K phi, m phi'' of a quintic spline at its inner samples.

    Noise weighs as it does on the springs that are there: what they are stiffer by than stated is
    on the right-hand side, at places that have the same noise. So is what damps the block, at
    speeds that have its derivative: of a block at rest next to nothing else is left of the noise at
    the frequency of its swings. One that swings on is not damped (see `_block`).
    """
    run = track.run
    value, first, second = _spline(5, knots, track.interval)
    inertia = run.mass * second
    stated = inertia + run.total_stiffness * value
    damping = 2.0 * DAMPED * np.sqrt(track.stiffness * run.mass)
    return value, stated, inertia, inertia + track.stiffness * value, damping * first


def _stick_weights(track: SmoothTrack, knots: int) -> _Weights:
    """phi, -phi' of a cubic spline."""
    value, first, _ = _spline(3, knots, track.interval)
    return value, -first, np.zeros_like(value), -first, np.zeros_like(value)


def _spline(degree: int, knots: int, interval: float) -> list[np.ndarray]:
    """A B-spline and its first two derivatives, times the samples' interval, at inner samples."""
    basis = BSpline.basis_element(np.arange(degree + 2), extrapolate=False)
    at = np.arange(1, (degree + 1) * knots) / knots
    step = knots * interval
    return [interval * basis.derivative(n)(at) / step**n if n else interval * basis(at)
            for n in range(3)]  # fmt: skip


def _block(
    track: SmoothTrack, stretches: tuple[tuple[int, int], ...], weights: _Weights, noise: float
) -> _Block:
    """Rows of all stretches that hold a spline, one for each shift by a knot."""
    size = weights[0].size
    knots = (size + 1) // (6 if weights[2].any() else 4)
    starts = [np.arange(first, last - size + 1, knots) for first, last in stretches]
    begin = np.concatenate([np.zeros(0, dtype=int), *starts])
    at = (np.repeat(np.arange(begin.size), size), (begin[:, None] + np.arange(size)).ravel())
    shape = (begin.size, track.time.size)
    rows = [sparse.csr_array((np.tile(w, begin.size), at), shape=shape) for w in weights]
    force, place, inertia, noisy, damped = rows
    noisy = [noisy, damped @ sparse.diags_array(track.at_rest.astype(float))]
    noisy = [each if track.errors is None else each @ track.errors for each in noisy]
    return _Block(force, place, inertia, _factor(noise**2 * sum(each @ each.T for each in noisy)))


def _factor(covariance: sparse.csr_array) -> np.ndarray:
    """Lower bands (b, r) of the Cholesky factor of a banded covariance (r, r)."""
    if covariance.shape[0] == 0:
        return np.ones((1, 0))
    entries = covariance.tocoo()
    below = entries.row - entries.col
    width = int(below.max()) + 1
    bands = np.zeros((width, covariance.shape[0]))
    lower = below >= 0
    bands[below[lower], entries.col[lower]] = entries.data[lower]
    bands[0] *= 1.0 + ROUNDING
    return np.asarray(cholesky_banded(bands, lower=True))
