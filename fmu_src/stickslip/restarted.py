"""A run that is set to given states at given moments: simulated segments between measured states.

Positions and velocities are set; what cannot be seen of a block - the heat and the age of its
contact, the distance slid, the place on the surface - goes on from the model's own past.
"""

from collections.abc import Sequence
from functools import partial
from typing import NamedTuple, Self

import numpy as np

from .arrays import RunArrays, inputs
from .catalogue import CATALOGUE, Catalogue
from .kernel.layout import O_SIZE, P_MU_K, P_MU_S, P_MU_SCALE, TRACKED


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
    p: Sequence[float] | np.ndarray,
    speed: float,
    temperature: float,
    times: np.ndarray,
    restarts: Restarts,
    catalogue: Catalogue = CATALOGUE,
    whole: bool = True,
) -> np.ndarray:
    """Outputs at ``times`` (n,), s, increasing: (n, O_SIZE), columns as `ports.OUTPUTS` slots.

    p : kernel vector of `packing.pack`, of a catalogue; speed, m/s and temperature, degC: the
    inputs, constant; whole : or x, y and phi alone, as `track_restarted` has it. Rows are NaN from
    where the model gave up to the next restart.
    """
    times = np.ascontiguousarray(times, dtype=float)
    u, start = inputs(speed, temperature), float(times[0])
    run = RunArrays.begin(p, u, start=start, catalogue=catalogue)
    width = O_SIZE if whole else TRACKED
    o, r = np.full(width * len(times), np.nan), restarts.flat(run.p)
    run.kernel.record_restarted(*run.all, times, o, len(times), r, len(restarts.rows), whole)
    return o.reshape(-1, width)


#: The same, but x, y and phi alone, what a tracker sees, (n, 3): in four fifths of the time.
track_restarted = partial(simulate_restarted, whole=False)
