"""How much work a run of the heat is, from its parameters alone.

The constants are those of a usual core, from runs with meshes of different size; they are right to
a factor of two or so, which is what a decision on minutes or days needs.
"""

import math

from .ice.body import TOLERANCE
from .ice.melting import LONGEST_RECESSION, melt_heat
from .model import MOVEMENT
from .parameters import ThermalParameters

#: An internal step, s; more for each unknown of the belt, and of the ice.
_STEP, _OF_BELT, _OF_ICE = 1e-4, 1.2e-8, 6e-7
#: Assembly and modes of the ice, s for the cube of its unknowns; modes alone.
_ASSEMBLY, _MODES = 7.5e-9, 1e-9
#: A sample from a mesh file is reduced to so many unknowns.
_OF_SAMPLE = 30
#: Times that the modes of melting ice are formed anew, until nothing of it is left.
_MOST_FITS = 8000


def ice_unknowns(parameters: ThermalParameters) -> int:
    """Unknowns of the ice's temperature."""
    ice = parameters.ice
    if ice.mesh:
        return _OF_SAMPLE
    return (2 * ice.radial_elements + 1) * (2 * ice.axial_elements + 1)


def seconds_to_prepare(parameters: ThermalParameters) -> float:
    """Until the model can make its first step, s; the reading of a mesh file not counted."""
    return float(_ASSEMBLY * ice_unknowns(parameters) ** 3)


def internal_steps(
    parameters: ThermalParameters, duration: float, step: float, speed: float, heating: float
) -> float:
    """Internal steps of a run: with its macro steps, and those that movement and melting cut.

    duration, step: of the run and of a macro step, s. speed: of the belt under the contact, m/s.
    heating: by friction, W.
    """
    length = parameters.contact.length or 2.0 * parameters.contact.radius
    moved = abs(speed) * step / (MOVEMENT * length)
    melted = _recession(parameters, heating * step) / LONGEST_RECESSION
    return duration / step * max(1.0, moved, melted)


def seconds_to_run(
    parameters: ThermalParameters, duration: float, step: float, speed: float, heating: float
) -> float:
    """As `internal_steps`, in s; modes that melting forms anew included."""
    belt, ice = parameters.belt, ice_unknowns(parameters)
    unknowns = belt.cells * (2 * belt.elements + 1)
    each = _STEP + _OF_BELT * unknowns + _OF_ICE * ice
    fits = _recession(parameters, heating * duration) / (TOLERANCE * parameters.ice.height)
    steps = internal_steps(parameters, duration, step, speed, heating)
    return steps * each + min(fits, _MOST_FITS) * _MODES * ice**3


def _recession(parameters: ThermalParameters, heat: float) -> float:
    """How far the face recedes where all the heat (J) melts ice, m."""
    ice, contact = parameters.ice, parameters.contact
    if not math.isfinite(parameters.melting_rise):
        return 0.0
    area = math.pi * contact.radius**2
    return heat / (area * ice.density * melt_heat(ice, parameters.melting_rise))
