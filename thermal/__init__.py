"""Heat in belt and ice: scikit-fem assembles, exact propagators advance, meshio writes.

>>> from thermal import BeltIceModel, ThermalParameters
>>> model = BeltIceModel(ThermalParameters())
>>> model.step(duration=0.01, heat=0.03, displacement=0.0015)
>>> abs(model.outputs()["heat_residual"]) < 1e-12
True
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .belt.parameters import Belt, Layer
    from .belt.single_pass import SinglePass
    from .contact.parameters import Contact
    from .ice.mesh_file import MeshError
    from .ice.parameters import Ice
    from .model import BeltIceModel
    from .output import FieldSeries, RigView, collection, rig_view
    from .parameters import Ambient, ParameterError, ThermalParameters
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

_NAMES = {
    ".belt.single_pass": ("SinglePass",),
    ".ice.mesh_file": ("MeshError",),
    ".model": ("BeltIceModel",),
    ".output": ("FieldSeries", "RigView", "collection", "rig_view"),
    ".parameters": ("Ambient", "Belt", "Contact", "Ice", "Layer", "ParameterError"),
    ".steady_sliding": ("SlidingState", "SteadySliding"),
    ".steady_state": ("NoSteadyState", "settle"),
}
_HOME = {name: module for module, names in _NAMES.items() for name in names}
_HOME["ThermalParameters"] = ".parameters"


def __getattr__(name: str) -> Any:
    """Import on first use: who reads parameters needs no finite elements."""
    if name in _HOME:
        return getattr(import_module(_HOME[name], __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
