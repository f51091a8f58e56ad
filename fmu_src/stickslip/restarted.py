"""A run that is set to given states at given moments: simulated segments between measured states.

Positions and velocities are set; what cannot be seen of a block - the heat and the age of its
contact, the distance slid, the place on the surface - goes on from the model's own past.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, Self

import numpy as np

from .arrays import RunArrays, inputs
from .catalogue import CATALOGUE, Catalogue
from .kernel.layout import (
    O_SIZE,
    P_MU_K,
    P_MU_S,
    P_MU_SCALE,
    R_SIZE,
    TRACKED,
    U_FORCE_X,
)

#: An instant of the model's motion (see `kernel.layout`) -> external force along x, N.
Force = Callable[[Sequence[float]], float]


class Restarts(NamedTuple):
    """Instants at which a run is set to states.

    Attributes
    ----------
    rows : (k,) numbers of the times at which they happen, increasing; the first is 0
    states : (k, 6) x, y, phi (m, m, rad), vx, vy, omega (m/s, m/s, rad/s); NaN leaves the model's
        own
    hold_since : (k,) when the stick began that the block is in, s: its velocity is then that of a
        stick; NaN: not in stick
    friction : (k, 2) mu_s and mu_k from there on, in parts of the model's own
    """

    rows: np.ndarray
    states: np.ndarray
    hold_since: np.ndarray
    friction: np.ndarray

    @classmethod
    def at(
        cls,
        rows: Sequence[int],
        states: Sequence[np.ndarray],
        hold_since: Sequence[float] | None = None,
        friction: Sequence[Sequence[float]] | None = None,
    ) -> Self:
        """Not in stick, and with the model's own friction, if not said."""
        count = len(rows)
        since = np.full(count, np.nan) if hold_since is None else np.asarray(hold_since)
        parts = np.ones((count, 2)) if friction is None else np.asarray(friction)
        return cls(np.asarray(rows), np.asarray(states), since, parts)

    def flat(self, p: np.ndarray) -> np.ndarray:
        """(k R_SIZE,) as the kernel takes them, with the friction of ``p``."""
        static, kinetic = self.friction.T
        own = [static * p[P_MU_S], kinetic * p[P_MU_K], kinetic * p[P_MU_SCALE]]
        return np.column_stack([self.rows, self.states, self.hold_since, *own]).ravel()


def simulate_restarted(
    p: Sequence[float],
    speed: float,
    temperature: float,
    times: np.ndarray,
    restarts: Restarts,
    force: Force | None = None,
    aside: float = 0.0,
    catalogue: Catalogue = CATALOGUE,
) -> np.ndarray:
    """Outputs at ``times`` (n,), s, increasing: (n, O_SIZE), columns as `ports.OUTPUTS` slots.

    p : kernel vector of `packing.pack`; speed, m/s and temperature, degC: the inputs, constant.
    Rows are NaN from where the model gave up to the next restart. force : from the model's own
    state, constant from one time to the next: extrapolated to the middle of the interval, so that
    the error is of second order in it. aside : constant external force along y, N. catalogue : of
    ``p``.
    """
    run = _begin(p, inputs(speed, temperature, aside=aside), times, catalogue)
    kernel = run.kernel
    return _simulated(run, times, restarts, force, kernel.record_restarted, kernel.record, O_SIZE)


def track_restarted(
    p: Sequence[float],
    speed: float,
    temperature: float,
    times: np.ndarray,
    restarts: Restarts,
    force: Force | None = None,
    aside: float = 0.0,
    catalogue: Catalogue = CATALOGUE,
) -> np.ndarray:
    """As `simulate_restarted`, but x, y and phi alone, (n, 3): in four fifths of the time."""
    run = _begin(p, inputs(speed, temperature, aside=aside), times, catalogue)
    kernel = run.kernel
    return _simulated(run, times, restarts, force, kernel.track_restarted, kernel.track, TRACKED)


def _begin(p: Sequence[float], u: np.ndarray, times: np.ndarray, catalogue: Catalogue) -> RunArrays:
    return RunArrays.begin(p, u, start=float(times[0]), catalogue=catalogue)


def _simulated(
    run: RunArrays,
    times: np.ndarray,
    restarts: Restarts,
    force: Force | None,
    restarted: Callable[..., None],
    record: Callable[..., int],
    width: int,
) -> np.ndarray:
    """Rows (n, width) as ``restarted`` of the kernel writes them, or ``record`` under a force."""
    times = np.ascontiguousarray(times, dtype=float)
    o, r = np.full(width * len(times), np.nan), restarts.flat(run.p)
    if force is None:
        restarted(*run.all, times, o, len(times), r, len(restarts.rows))
        return o.reshape(-1, width)
    ends = [*restarts.rows[1:].tolist(), len(times)]
    for number, rows in enumerate(zip(restarts.rows.tolist(), ends, strict=True)):
        run.kernel.restart(*run.all, times, r, number * R_SIZE)
        _record_forced(run, record, times, o, rows, force)
    return o.reshape(-1, width)


def _record_forced(
    run: RunArrays,
    record: Callable[..., int],
    times: np.ndarray,
    o: np.ndarray,
    rows: tuple[int, int],
    force: Force,
) -> None:
    """Row by row, each under the force that the row before has set."""
    before, mode = None, None
    for row in range(*rows):
        if record(*run.all, times, o, row, 1) != 1:
            break
        now = run.u[U_FORCE_X] = force(run.instant)
        if before is not None and mode == run.sticks and row + 1 < len(times):
            growth = (now - before) / (times[row] - times[row - 1])
            run.u[U_FORCE_X] += 0.5 * growth * (times[row + 1] - times[row])
        before, mode = now, run.sticks
    run.u[U_FORCE_X] = 0.0
