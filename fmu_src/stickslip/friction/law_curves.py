"""What an effect's law is as a curve: friction over a speed, a hold, a way, a load; a force.

Each is asked of the kernel, interpreted, as the motion asks it, with every effect that is on.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray
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


@dataclass(frozen=True)
class _Asked:
    """What a curve is asked of: parameters, the kernel's arrays, and where the interface is."""

    effect: Effect
    parameters: Parameters
    temperature: float
    film: float

    @property
    def kernel(self) -> Any:
        """Of the parameters' effects."""
        return self.parameters.catalogue.kernel

    def arrays(self) -> tuple[list[float], list[float], list[float]]:
        """p, u and w of a block at rest at the start."""
        u = list(inputs(self.parameters.surface.speed, self.temperature, self.film))
        return self.parameters.pack(), u, [0.0] * self.kernel.W_SIZE

    def over(self, place: int, values: Array, ask: Callable[..., float]) -> Array:
        """What is asked of p, u, w with each of the values in a place of w."""
        p, u, w = self.arrays()
        found = np.empty(values.size)
        for i, value in enumerate(values):
            w[place] = float(value)
            found[i] = ask(p, u, w)
        return found

    def coefficient(self, speeds: Array) -> Array:
        """Friction of a slip, 1."""
        return friction_coefficient(self.parameters, speeds, self.temperature, self.film)


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
    if axis not in _CURVES:
        return None
    temperature = temperature_of(parameters, interface_temperature)
    return _CURVES[axis](_Asked(effect, parameters, temperature, film_thickness), reach)


def axis_of(effect: Effect) -> str:
    """Over what an effect is a curve; "" where it is none."""
    if effect.axis:
        return effect.axis
    taken = {name for term in effect.terms for name in arguments(term)}
    return TEMPERATURE if TEMPERATURE in taken else ""


def _over_speed(asked: _Asked, reach: float) -> LawCurve:
    x = np.linspace(0.0, reach or 0.5, POINTS + 1)[1:]
    if asked.effect.states:
        y = np.array([_settled(asked, float(speed)) for speed in x])
        return LawCurve("speed of steady sliding", "m/s", x, "friction coefficient", "1", y)
    return LawCurve("sliding speed", "m/s", x, "friction coefficient", "1", asked.coefficient(x))


def _settled(asked: _Asked, speed: float) -> float:
    """Friction of a slip that has gone on for so long that what the effect remembers stays."""
    p, u, w = asked.arrays()
    table = getattr(asked.parameters, asked.effect.id)
    for state in asked.effect.states:
        own = {name: getattr(table, name) for name in type(table).model_fields}
        taken = {k: v for k, v in (own | {"speed": speed}).items() if k in arguments(state.rate)}
        if {*taken, state.name} == set(arguments(state.rate)):  # else it stays as at the start
            place = W_STATE + getattr(asked.kernel, state_slot(asked.effect, state.name))
            w[place] = brentq(
                lambda q, state=state, taken=taken: state.rate(**taken, **{state.name: q}), 0.0, 1e9
            )
    asked.kernel.friction_in_slip(p, u, w, speed, 0.0, 0.0)
    friction: float = w[asked.kernel.W_FRICTION]
    return -friction / p[P_NORMAL_FORCE]


def _over_hold(asked: _Asked, reach: float) -> LawCurve:
    x = np.geomspace(1e-2, 1e3, POINTS)
    y = asked.over(W_STATE + TIME, x, asked.kernel.static_coefficient)  # held since the start
    return LawCurve("time at rest", "s", x, "static friction coefficient", "1", y, True)


def _over_memory(asked: _Asked, reach: float) -> LawCurve:
    """Of what an effect remembers first."""
    first = state_slot(asked.effect, asked.effect.states[0].name)
    return _over(getattr(asked.kernel, first), "remembered heat", "J", asked, reach)


def _over(place: int, axis: str, unit: str, asked: _Asked, reach: float) -> LawCurve:
    """Kinetic friction over a number of the instant."""
    x = np.linspace(0.0, reach or 1.0, POINTS)
    y = asked.over(W_STATE + place, x, asked.kernel.kinetic_coefficient)
    return LawCurve(axis, unit, x, "kinetic friction coefficient", "1", y)


def _over_load(asked: _Asked, reach: float) -> LawCurve:
    x, y = np.linspace(1.0, 20.0, POINTS // 10), []
    for load in x:
        loaded = asked.parameters.with_values("rig", mass=float(load) / GRAVITY)
        (mu,) = friction_coefficient(loaded, [SLIDING], asked.temperature, asked.film)
        y.append(mu)
    return LawCurve("normal force", "N", x, "friction coefficient", "1", np.array(y))


def _over_extension(asked: _Asked, reach: float) -> LawCurve:
    p, _, _ = asked.arrays()
    x = np.linspace(-(reach or 0.1), reach or 0.1, POINTS)
    y = np.array([asked.kernel.spring_tension(p, float(extension)) for extension in x])
    return LawCurve("extension of a spring", "m", x, "force of it", "N", y)


def _over_velocity(asked: _Asked, reach: float) -> LawCurve:
    p, _, _ = asked.arrays()
    x = np.linspace(-0.5, 0.5, POINTS)
    y = np.array([-asked.kernel.damping_per_speed(p, float(v), 0.0) * v for v in x])
    return LawCurve("velocity of the block", "m/s", x, "force on it", "N", y)


def _over_time(asked: _Asked, reach: float) -> LawCurve:
    p, u, w = asked.arrays()
    x = np.linspace(0.0, reach or 4.0, POINTS)
    y = np.array([asked.kernel.surface_speed(p, u, w, float(t)) for t in x])
    return LawCurve("time", "s", x, "speed of the surface", "m/s", y)


def _over_temperature(asked: _Asked, reach: float) -> LawCurve:
    p, u, w = asked.arrays()
    x, y = np.linspace(asked.temperature - 12.0, 0.0, POINTS), []
    for degrees in x:
        u[U_TEMPERATURE] = float(degrees)
        y.append(asked.kernel.kinetic_coefficient(p, u, w))
    return LawCurve(
        "interface temperature", "degC", x, "kinetic friction coefficient", "1", np.array(y)
    )


_CURVES: dict[str, Callable[[_Asked, float], LawCurve]] = {
    "sliding speed": _over_speed,
    "hold time": _over_hold,
    "heat memory": _over_memory,
    "distance": partial(_over, DISTANCE, "distance slid", "m"),
    "place": partial(_over, X, "place on the surface", "m"),
    "load": _over_load,
    "position": _over_extension,
    "velocity": _over_velocity,
    "time": _over_time,
    TEMPERATURE: _over_temperature,
}
