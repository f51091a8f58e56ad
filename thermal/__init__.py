"""Heat in belt and ice: scikit-fem assembles, exact propagators advance, meshio writes.

>>> from thermal import BeltIceModel, ThermalParameters
>>> model = BeltIceModel(ThermalParameters())
>>> model.step(duration=0.01, heat=0.03, displacement=0.0015)
>>> abs(model.outputs()["heat_residual"]) < 1e-12
True
"""

from .belt.single_pass import SinglePass
from .ice.mesh_file import MeshError
from .model import BeltIceModel
from .output import FieldSeries, RigView, collection, rig_view
from .parameters import Ambient, Belt, Contact, Ice, Layer, ParameterError, ThermalParameters
from .steady_sliding import SlidingState, SteadySliding
from .steady_state import NoSteadyState, settle

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
    "collection",
    "rig_view",
    "settle",
]
