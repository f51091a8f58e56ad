"""What an effect's law is as a curve: friction over a speed, a hold, a way, a load; a force.

Each is asked of the kernel, interpreted, as the motion asks it, with every effect that is on.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from ..arrays import inputs
from ..arrays import interface_temperature as temperature_of
from ..effects.effect import Effect
from ..generation.functions import arguments
from ..generation.slots import state_slot
from ..kernel.layout import DISTANCE, P_NORMAL_FORCE, TIME, U_TEMPERATURE, W_STATE, X
from ..packing import GRAVITY
from ..parameters import Parameters
from .law import friction_coefficient

Array = NDArray[np.float64]
#: x and y of a curve.
Points = tuple[Array, ArrayLike]
POINTS = 300
#: Temperature, which is over what an effect of it is a curve; others say so by their axis.
TEMPERATURE = "temperature"
#: Of the surface against the block where friction is asked for over the load, m/s.
SLIDING = 0.1


@dataclass(frozen=True)
class LawCurve:
    """A law over its axis.

    Attributes
    ----------
    axis, unit : over what, as FMI writes the unit; logarithmic : how it is best drawn
    x : (n,), in that unit
    quantity, of : what it gives, and its unit
    y : (n,), in that unit
    """

    axis: str
    unit: str
    x: Array
    quantity: str
    of: str
    y: Array
    logarithmic: bool = False


class _Law:
    """The kernel as a law is asked of it: p, u and w of a block at rest at the start."""

    def __init__(self, effect: Effect, parameters: Parameters, temperature: float, film: float):
        self.effect, self.parameters = effect, parameters
        self.interface = temperature, film
        self.kernel: Any = parameters.catalogue.kernel
        self.p = parameters.pack()
        self.u = list(inputs(parameters.surface.speed, *self.interface))
        self.w = [0.0] * self.kernel.W_SIZE

    def over(self, array: list[float], place: int, x: Array, ask: Callable[..., float]) -> Array:
        """What is asked of p, u, w with each of the values in a place of u or w."""
        found = np.empty(x.size)
        for i, value in enumerate(x.tolist()):
            array[place] = value
            found[i] = ask(self.p, self.u, self.w)
        return found


def law_curve(
    effect: Effect,
    parameters: Parameters,
    interface_temperature: float | None = None,
    film_thickness: float = 0.0,
    reach: float = 0.0,
) -> LawCurve | None:
    """The curve of an effect's law with these parameters; None of one that is no curve.

    interface_temperature : degC, and film_thickness : m, as for `friction_coefficient`; reach : up
    to where, in the axis's unit, for axes without a range of their own (a memory, a way, a time)
    """
    axis = axis_of(effect)
    if axis == SPEED and effect.states:
        axis = STEADY
    if axis not in _CURVES:
        return None
    temperature = temperature_of(parameters, interface_temperature)
    follow, over, unit, quantity, of = _CURVES[axis]
    x, y = follow(_Law(effect, parameters, temperature, film_thickness), reach)
    return LawCurve(over, unit, x, quantity, of, np.asarray(y), axis == HOLD)


def axis_of(effect: Effect) -> str:
    """Over what an effect is a curve; "" where it is none."""
    if effect.axis:
        return effect.axis
    taken = {name for term in effect.terms for name in arguments(term)}
    return TEMPERATURE if TEMPERATURE in taken else ""


def _speeds(reach: float) -> Array:
    return np.linspace(0.0, reach or 0.5, POINTS + 1)[1:]


def _over_speed(law: _Law, reach: float) -> Points:
    x = _speeds(reach)
    return x, friction_coefficient(law.parameters, x, *law.interface)


def _over_steady_sliding(law: _Law, reach: float) -> Points:
    x = _speeds(reach)
    return x, [_settled(law, speed) for speed in x.tolist()]


def _settled(law: _Law, speed: float) -> float:
    """Friction of a slip that has gone on for so long that what the effect remembers stays."""
    table, w = getattr(law.parameters, law.effect.id), list(law.w)
    for state in law.effect.states:
        own = {name: getattr(table, name) for name in type(table).model_fields}
        taken = {k: v for k, v in (own | {"speed": speed}).items() if k in arguments(state.rate)}
        if {*taken, state.name} == set(arguments(state.rate)):  # else it stays as at the start
            place = W_STATE + getattr(law.kernel, state_slot(law.effect, state.name))
            w[place] = brentq(
                lambda q, state=state, taken=taken: state.rate(**taken, **{state.name: q}), 0.0, 1e9
            )
    law.kernel.friction_in_slip(law.p, law.u, w, speed, 0.0, 0.0)
    friction: float = w[law.kernel.W_FRICTION]
    return -friction / law.p[P_NORMAL_FORCE]


def _over_hold(law: _Law, reach: float) -> Points:
    x = np.geomspace(1e-2, 1e3, POINTS)
    return x, law.over(law.w, W_STATE + TIME, x, law.kernel.static_coefficient)  # since the start


def _over_memory(law: _Law, reach: float) -> Points:
    """Of what an effect remembers first."""
    first = state_slot(law.effect, law.effect.states[0].name)
    return _over(getattr(law.kernel, first), law, reach)


def _over(place: int, law: _Law, reach: float) -> Points:
    """Over a number of the instant."""
    x = np.linspace(0.0, reach or 1.0, POINTS)
    return x, law.over(law.w, W_STATE + place, x, law.kernel.kinetic_coefficient)


def _over_load(law: _Law, reach: float) -> Points:
    x = np.linspace(1.0, 20.0, POINTS // 10)
    masses = (x / GRAVITY).tolist()
    loaded = (law.parameters.with_values("rig", mass=mass) for mass in masses)
    return x, [friction_coefficient(one, [SLIDING], *law.interface)[0] for one in loaded]


def _over_extension(law: _Law, reach: float) -> Points:
    x = np.linspace(-(reach or 0.1), reach or 0.1, POINTS)
    return x, [law.kernel.spring_tension(law.p, extension) for extension in x.tolist()]


def _over_velocity(law: _Law, reach: float) -> Points:
    x = np.linspace(-0.5, 0.5, POINTS)
    return x, [-law.kernel.damping_per_speed(law.p, v, 0.0) * v for v in x.tolist()]


def _over_time(law: _Law, reach: float) -> Points:
    x = np.linspace(0.0, reach or 4.0, POINTS)
    return x, [law.kernel.surface_speed(law.p, law.u, law.w, t) for t in x.tolist()]


def _over_temperature(law: _Law, reach: float) -> Points:
    x = np.linspace(law.interface[0] - 12.0, 0.0, POINTS)
    return x, law.over(law.u, U_TEMPERATURE, x, law.kernel.kinetic_coefficient)


SPEED, STEADY, HOLD = "sliding speed", "steady sliding", "hold time"
MU, MU_S, MU_K = (f"{kind}friction coefficient" for kind in ("", "static ", "kinetic "))
#: Axis of an effect -> what follows it, what it is and its unit, what is over it and its unit.
_CURVES: dict[str, tuple[Callable[[_Law, float], Points], str, str, str, str]] = {
    SPEED: (_over_speed, SPEED, "m/s", MU, "1"),
    STEADY: (_over_steady_sliding, "speed of steady sliding", "m/s", MU, "1"),
    HOLD: (_over_hold, "time at rest", "s", MU_S, "1"),
    "heat memory": (_over_memory, "remembered heat", "J", MU_K, "1"),
    "distance": (partial(_over, DISTANCE), "distance slid", "m", MU_K, "1"),
    "place": (partial(_over, X), "place on the surface", "m", MU_K, "1"),
    "load": (_over_load, "normal force", "N", MU, "1"),
    "position": (_over_extension, "extension of a spring", "m", "force of it", "N"),
    "velocity": (_over_velocity, "velocity of the block", "m/s", "force on it", "N"),
    "time": (_over_time, "time", "s", "speed of the surface", "m/s"),
    TEMPERATURE: (_over_temperature, "interface temperature", "degC", MU_K, "1"),
}
