"""Heat in belt and ice: scikit-fem assembles, exact propagators advance, meshio writes.

>>> from thermal import BeltIceModel, ThermalParameters
>>> model = BeltIceModel(ThermalParameters())
>>> model.step(duration=0.01, heat=0.03, displacement=0.0015)
>>> abs(model.outputs()["heat_residual"]) < 1e-12
True
"""

from .fields import FieldSeries
from .ice_mesh import MeshError
from .model import BeltIceModel
from .parameters import Ambient, Belt, Contact, Ice, Layer, ParameterError, ThermalParameters
from .rig_view import RigView, rig_view
from .single_pass import SinglePass
from .steady import NoSteadyState, settle
from .steady_sliding import SlidingState, SteadySliding

__all__ = [
    "Ambient",
    "Belt",
    "BeltIceModel",
    "Contact",
    "FieldSeries",
    "Ice",
    "Layer",
    "MeshError",
    "NoSteadyState",
    "ParameterError",
    "RigView",
    "SinglePass",
    "SlidingState",
    "SteadySliding",
    "ThermalParameters",
    "rig_view",
    "settle",
]
