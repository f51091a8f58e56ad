"""A standing block of ice as eigenmodes: warmed at its contact face, cooled by the air, melting.

Its Galerkin space is diagonalised, so a constant flux is advanced exactly, whatever the step.
Melting lowers the block (see `thermal.assembly`). Within a step the ice sinks at a constant speed
and the heat that this moves is a constant load, taken at the mean of the temperatures at the step's
ends: second order in the step. The modes belong to one height; they are formed anew when the
present one is off by `TOLERANCE` of itself. Temperatures are rises above the air.
"""

from collections.abc import Callable
from functools import lru_cache, partial

import numpy as np

from thermal.arrays import Array
from thermal.assembly import HeatSpace
from thermal.relaxation import STEP_SIZES, Step, eigenmodes, step

#: Change of the height, relative, that the modes bear; the conductance upwards then errs by twice
#: that, to one side and the other in turn.
TOLERANCE = 2e-4

#: Part of the first height that has to be left.
_LEAST_HEIGHT = 0.05

# Heights whose modes are kept: a step that is taken back goes from one to another and returns.
_MOST_KNOWN = 4


class IceMelted(RuntimeError):
    """So much ice has melted that there is no block any more."""


class IceBody:
    """Temperature of a block of ice in a Galerkin space; `amplitudes` (n,), `rates` (n,) 1/s.

    `melted_depth`: how far the face has receded, m.
    """

    def __init__(self, space: HeatSpace) -> None:
        self.space = space
        self.melted_depth: float = 0.0
        self._fitted_depth = 0.0
        self._modes = lru_cache(_MOST_KNOWN)(
            lambda height_ratio: eigenmodes(space.factor(height_ratio), space.capacity)
        )
        self._diagonalise()
        self.amplitudes: Array = np.zeros(self.rates.size)

    def _diagonalise(self) -> None:
        """Modes of the present height."""
        space, height_ratio = self.space, self.height_ratio
        rates, self._shapes = self._modes(height_ratio)
        self.rates: Array = rates
        self._face = space.contact @ self._shapes
        self._heat = space.heat @ self._shapes
        self._air = space.air(height_ratio) @ self._shapes
        self._sinking = self._shapes.T @ space.sinking @ self._shapes
        self._step: Callable[[float], Step[Array]] = lru_cache(STEP_SIZES)(partial(step, rates))

    @property
    def height_ratio(self) -> float:
        """Present height over that at the start, J of `space`: 1 until ice melts."""
        return 1.0 - self.melted_depth / self.space.height

    def face_response(self, duration: float, recession: float = 0.0) -> tuple[float, float]:
        """Contact face for 1 W on the contact, K/W: mean over the step and at its end.

        recession: how far the face recedes in the step, m.
        """
        held, held_mean = self._step(duration)[2:]
        middle, end = self._height_ratios(recession)
        return (
            float(np.sum(self._face**2 * held_mean)) / middle,
            float(self._face @ (self._face * held)) / end,
        )

    def free_face(
        self, duration: float, sinking: Array | None = None, recession: float = 0.0
    ) -> tuple[float, float]:
        """Mean contact face without flux, K: mean over the step and at its end.

        sinking: load on the modes from `sinking`; recession: of the face in the step, m.
        """
        mean, end = self._under(duration, 0.0, sinking)
        ratio_middle, ratio_end = self._height_ratios(recession)
        return float(self._face @ mean) / ratio_middle, float(self._face @ end) / ratio_end

    def _height_ratios(self, recession: float) -> tuple[float, float]:
        """Height ratios in the middle and at the end of a step in which the face recedes (m)."""
        part = recession / self.space.height
        return self.height_ratio - 0.5 * part, self.height_ratio - part

    def sinking(
        self, duration: float, recession: float, load: float, before: Array | None = None
    ) -> Array:
        """Load on the modes (n,) from ice that sinks towards a face that recedes (m) in a step.

        load: W on the contact; before: an estimate of what is returned.
        """
        _, end = self._under(duration, load, before)
        speed = recession / (duration * self._height_ratios(recession)[0])
        return speed * (self._sinking @ (0.5 * (self.amplitudes + end)))

    def _under(self, duration: float, load: float, sinking: Array | None) -> tuple[Array, Array]:
        """Amplitudes in a step under a load (W) on the contact: their mean, and at its end."""
        loads = self._face * load
        if sinking is not None:
            loads = loads + sinking
        of_step = self._step(duration)
        mean = self.amplitudes * of_step.mean + of_step.held_mean * loads
        return mean, self.amplitudes * of_step.decay + of_step.held * loads

    def advance(
        self, duration: float, load: float, sinking: Array | None = None, recession: float = 0.0
    ) -> float:
        """Advance by duration (s) under a load (W) on the contact; heat to the air, J.

        sinking: load on the modes; recession: of the face in the step, m. IceMelted when less than
        5 % of the height is left.
        """
        mean, self.amplitudes[:] = self._under(duration, load, sinking)
        loss = duration * float(self._air @ mean)
        if recession != 0.0:
            self._recede(recession)
        return loss

    def _recede(self, depth: float) -> None:
        self.melted_depth += depth
        if self.height_ratio < _LEAST_HEIGHT:
            raise IceMelted(
                f"the ice has melted: of its {self.space.height:g} m less than"
                f" {_LEAST_HEIGHT * self.space.height:g} m are left"
            )
        bears = TOLERANCE * (self.space.height - self._fitted_depth)
        gone = self.melted_depth - self._fitted_depth
        if abs(gone) > bears:
            self._fit(self.melted_depth + np.copysign(bears, gone))

    def _fit(self, depth: float) -> None:
        """Form the modes of another depth; the field, and with it the heat, stays what it is."""
        field = self.space.capacity @ (self._shapes @ self.amplitudes)
        present, self.melted_depth = self.melted_depth, depth
        self._diagonalise()
        self.melted_depth, self._fitted_depth = present, depth
        self.amplitudes = self._shapes.T @ field

    def fill(self, rise: float) -> None:
        """Make the whole block as warm, K above the air."""
        self.amplitudes[:] = 0.0
        self.warm(rise)

    def warm(self, rise: float) -> None:
        """Make the whole block warmer, K."""
        # phi^T C phi = 1, so the coefficients of 1 are phi^T C 1: the heat of each mode
        self.amplitudes += rise * self._heat

    def heat(self) -> float:
        """Heat stored above ambient, J."""
        return float(self._heat @ self.amplitudes)

    def face(self) -> float:
        """Mean temperature rise of the contact face, K."""
        return float(self._face @ self.amplitudes) / self.height_ratio

    def nodal(self) -> Array:
        """Temperature rise at the degrees of freedom, K: (N,)."""
        return self.space.trial @ (self._shapes @ self.amplitudes) / self.height_ratio

    def state(self) -> Array:
        """Everything that a continuation needs, as a copy."""
        return np.concatenate(([self.melted_depth, self._fitted_depth], self.amplitudes))

    def restore(self, state: Array) -> None:
        """Take a state that `state` returned; the continuation is the same bit for bit."""
        depth, fitted = float(state[0]), float(state[1])
        if fitted != self._fitted_depth:
            self._fit(fitted)
        self.melted_depth = depth
        self.amplitudes = np.array(state[2:])
