"""A run that is set to given states at given moments: model flights between measured states.

Positions and velocities are set; what cannot be seen of a block - the heat and the age of its
contact, the way slid, the place on the surface - goes on from the model's own past.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from .compiled import compiled_kernel
from .kernel.layout import (
    E_CAPACITY,
    E_FIRST,
    E_WIDTH,
    HOLD_SINCE,
    INSTANT,
    MODE,
    O_SIZE,
    SHOWN,
    SLIP,
    STICK,
    TRACKED,
    U_FORCE_X,
    U_FORCE_Y,
    U_SIZE,
    U_SPEED,
    U_TEMPERATURE,
    W_SIZE,
    Z_HAS_NEXT,
    Z_SIZE,
    Z_STARTED,
    X,
)

STATE = ("x", "y", "phi", "vx", "vy", "omega")
#: A block of the model's state (see `layout`) -> external force along x, N.
Force = Callable[[Sequence[float]], float]


@dataclass(frozen=True)
class Restart:
    """One moment at which a run is set to a state.

    Attributes
    ----------
    row : number of the time at which it happens
    state : (6,) x, y, phi (m, m, rad), vx, vy, omega (m/s, m/s, rad/s); NaN leaves the model's own
    hold_since : when the stick began that the block is in, s: its velocity is then that of a stick;
        NaN: not in stick
    """

    row: int
    state: np.ndarray
    hold_since: float = np.nan


def simulate_restarted(
    p: Sequence[float],
    speed: float,
    temperature: float,
    times: np.ndarray,
    restarts: Sequence[Restart],
    force: Force | None = None,
    aside: float = 0.0,
) -> np.ndarray:
    """Outputs at ``times`` (n,), s, increasing: (n, O_SIZE), columns as `ports.OUTPUTS` slots.

    p : kernel vector of `packing.pack`; speed, m/s and temperature, degC: the inputs, constant.
    The first restart is at row 0. Rows are NaN from where the model gave up to the next restart.
    force : from the model's own state, constant from one time to the next: extrapolated to the
    middle of the interval, so that the error is of second order in it. aside : constant external
    force along y, N.
    """
    record = compiled_kernel().record
    inputs = _inputs(speed, temperature, aside)
    return _simulated(p, inputs, times, restarts, force, record, O_SIZE)


def track_restarted(
    p: Sequence[float],
    speed: float,
    temperature: float,
    times: np.ndarray,
    restarts: Sequence[Restart],
    force: Force | None = None,
    aside: float = 0.0,
) -> np.ndarray:
    """As `simulate_restarted`, but x, y and phi alone, (n, 3): in four fifths of the time."""
    track = compiled_kernel().track
    inputs = _inputs(speed, temperature, aside)
    return _simulated(p, inputs, times, restarts, force, track, TRACKED)


def _inputs(speed: float, temperature: float, aside: float) -> np.ndarray:
    u = np.zeros(U_SIZE)
    u[U_SPEED], u[U_TEMPERATURE], u[U_FORCE_Y] = speed, temperature, aside
    return u


def _simulated(p, u, times, restarts, force, record, width: int) -> np.ndarray:
    """Rows (n, width) as ``record`` of the kernel writes them."""
    kernel = compiled_kernel()
    p, times = np.asarray(p, dtype=float), np.ascontiguousarray(times, dtype=float)
    z, w = np.zeros(Z_SIZE), np.zeros(W_SIZE)
    e = np.zeros(E_FIRST + E_WIDTH)
    e[E_CAPACITY] = 1.0
    o = np.full(width * len(times), np.nan)
    kernel.initialise(p, z, times[0])
    ends = [restart.row for restart in restarts[1:]] + [len(times)]
    for restart, end in zip(restarts, ends, strict=True):
        _set(kernel, p, u, z, w, e, times[restart.row], restart)
        if force is None:
            record(p, u, z, w, e, times, o, restart.row, end - restart.row)
        else:
            _record_forced(record, p, u, z, w, e, times, o, (restart.row, end), force)
    return o.reshape(-1, width)


def _record_forced(record, p, u, z, w, e, times: np.ndarray, o, rows, force: Force) -> None:
    """Row by row, each under the force that the row before has set."""
    before, mode = None, None
    for row in range(*rows):
        if record(p, u, z, w, e, times, o, row, 1) != 1:
            break
        block = z[SHOWN : SHOWN + INSTANT].tolist()
        now = u[U_FORCE_X] = force(block)
        if before is not None and mode == block[MODE] and row + 1 < len(times):
            growth = (now - before) / (times[row] - times[row - 1])
            u[U_FORCE_X] += 0.5 * growth * (times[row + 1] - times[row])
        before, mode = now, block[MODE]
    u[U_FORCE_X] = 0.0


def _set(kernel, p, u, z, w, e, time: float, restart: Restart) -> None:
    """Reach the moment by the model's own motion, then set the state and settle the contact."""
    past = z[Z_STARTED]
    if past:
        kernel.advance(p, u, z, w, e, time)
    z[SHOWN] = time
    given = np.isfinite(restart.state)
    z[SHOWN + X : SHOWN + X + 6][given] = restart.state[given]
    if np.isfinite(restart.hold_since):  # a stick's velocity is the surface's; it creeps from there
        z[SHOWN + MODE], z[SHOWN + HOLD_SINCE] = STICK, restart.hold_since
        kernel.look_at(p, u, z, w, SHOWN)
        kernel.follow_surface(p, u, z, w, SHOWN, 0.0)
    elif past and given[STATE.index("vx")]:  # how the model moved before must not decide
        z[SHOWN + MODE] = SLIP
    z[Z_STARTED], z[Z_HAS_NEXT] = 0.0, 0.0
    kernel.advance(p, u, z, w, e, time)
