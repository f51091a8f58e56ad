"""A run that is set to given states at given moments: simulated segments between measured states.

Positions and velocities are set; what cannot be seen of a block - the heat and the age of its
contact, the distance slid, the place on the surface - goes on from the model's own past.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from .arrays import STATE, RunArrays, inputs
from .kernel.layout import (
    BRISTLES,
    HELD,
    HOLD_SINCE,
    INSTANT,
    MODE,
    O_SIZE,
    P_MU_K,
    P_MU_S,
    P_MU_SCALE,
    SHOWN,
    SLIP,
    STICK,
    TRACKED,
    U_FORCE_X,
    UNKNOWN,
    Z_STARTED,
    X,
)

#: An instant of the model's motion (see `kernel.layout`) -> external force along x, N.
Force = Callable[[Sequence[float]], float]


@dataclass(frozen=True)
class Restart:
    """One instant at which a run is set to a state.

    Attributes
    ----------
    row : number of the time at which it happens
    state : (6,) x, y, phi (m, m, rad), vx, vy, omega (m/s, m/s, rad/s); NaN leaves the model's own
    hold_since : when the stick began that the block is in, s: its velocity is then that of a stick;
        NaN: not in stick
    friction : mu_s and mu_k from there on, in parts of the model's own
    """

    row: int
    state: np.ndarray
    hold_since: float = np.nan
    friction: tuple[float, float] = (1.0, 1.0)


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
    run = _begin(p, inputs(speed, temperature, aside=aside), times)
    return _simulated(run, times, restarts, force, run.kernel.record, O_SIZE)


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
    run = _begin(p, inputs(speed, temperature, aside=aside), times)
    return _simulated(run, times, restarts, force, run.kernel.track, TRACKED)


def _begin(p: Sequence[float], u: np.ndarray, times: np.ndarray) -> RunArrays:
    return RunArrays.begin(p, u, start=float(times[0]))


def _simulated(
    run: RunArrays,
    times: np.ndarray,
    restarts: Sequence[Restart],
    force: Force | None,
    record: Callable[..., int],
    width: int,
) -> np.ndarray:
    """Rows (n, width) as ``record`` of the kernel writes them."""
    times = np.ascontiguousarray(times, dtype=float)
    o = np.full(width * len(times), np.nan)
    ends = [restart.row for restart in restarts[1:]] + [len(times)]
    whole = run.p[P_MU_S], run.p[P_MU_K], run.p[P_MU_SCALE]
    for restart, end in zip(restarts, ends, strict=True):
        _set(run, times[restart.row], restart, whole)
        if force is None:
            record(*run.all, times, o, restart.row, end - restart.row)
        else:
            _record_forced(run, record, times, o, (restart.row, end), force)
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
        instant = run.z[SHOWN : SHOWN + INSTANT].tolist()
        now = run.u[U_FORCE_X] = force(instant)
        if before is not None and mode == instant[MODE] and row + 1 < len(times):
            growth = (now - before) / (times[row] - times[row - 1])
            run.u[U_FORCE_X] += 0.5 * growth * (times[row + 1] - times[row])
        before, mode = now, instant[MODE]
    run.u[U_FORCE_X] = 0.0


def _set(run: RunArrays, time: float, restart: Restart, whole: tuple[float, float, float]) -> None:
    """Reach the instant by the model's own motion, then set the state and settle the contact.

    whole : mu_s, mu_k and what multiplies mu_k in slip, as the model has them
    """
    z, past = run.z, run.z[Z_STARTED]
    if past:
        run.advance(time)
    static, kinetic = restart.friction
    run.p[P_MU_S], run.p[P_MU_K] = static * whole[0], kinetic * whole[1]
    run.p[P_MU_SCALE] = kinetic * whole[2]  # what slip takes, of mu_k or of a table of it
    z[SHOWN] = time
    given = np.isfinite(restart.state)
    z[SHOWN + X : SHOWN + X + 6][given] = restart.state[given]
    if given.any():  # the shear of the contact belongs to what it was set to
        z[SHOWN + BRISTLES] = UNKNOWN
    if np.isfinite(
        restart.hold_since
    ):  # a stick's velocity is the surface's; it preslides from there
        z[SHOWN + MODE], z[SHOWN + HOLD_SINCE] = STICK, restart.hold_since
        z[SHOWN + BRISTLES] = HELD
        run.follow_surface()
    elif past and given[STATE.index("vx")]:  # how the model moved before must not decide
        z[SHOWN + MODE] = SLIP
    run.settle(time)
