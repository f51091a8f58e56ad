"""The friction law by itself: what a contact that slides steadily is braked by, what it feels."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arrays import inputs
from ..arrays import interface_temperature as temperature_of
from ..kernel.layout import P_NORMAL_FORCE
from ..parameters import Parameters


def friction_coefficient(
    parameters: Parameters,
    speed: ArrayLike,
    interface_temperature: float | None = None,
    film_thickness: float = 0.0,
) -> NDArray[np.float64]:
    """Friction over normal force of a contact that slides along x without turning, speeds (n,) m/s.

    Every effect of friction that is on has its say, with its memory as at the start of a run: no
    recent heat, no distance slid. interface_temperature: degC; left out, the reference temperature
    of ``temperature_dependence``. film_thickness: water in the contact, mean over it, m. Raises
    ValueError for a speed that is not positive.

    >>> friction_coefficient(Parameters(), [0.1])
    array([0.2086])
    """
    speeds = np.atleast_1d(np.asarray(speed, dtype=float))
    if not np.all(speeds > 0.0):
        raise ValueError(f"speed = {speeds.min():g} m/s: must be above 0")
    temperature = temperature_of(parameters, interface_temperature)
    kernel, layout = parameters.catalogue.compiled, parameters.catalogue.kernel
    u = inputs(0.0, temperature, film_thickness)
    p, w = np.array(parameters.pack()), np.zeros(layout.W_SIZE)
    coefficients = np.empty(speeds.size)
    for i, value in enumerate(speeds):
        kernel.friction_in_slip(p, u, w, value, 0.0, 0.0)
        coefficients[i] = -w[layout.W_FRICTION] / p[P_NORMAL_FORCE]
    return coefficients


def feels_water(parameters: Parameters) -> bool:
    """Whether water in the contact matters to its friction, by any of the effects that are on."""
    return bool(parameters.catalogue.kernel.feels_film(parameters.pack()))
