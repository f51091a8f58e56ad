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
    from .belt.parameters import Belt as Belt
    from .belt.parameters import Layer as Layer
    from .belt.single_pass import SinglePass as SinglePass
    from .contact.parameters import Contact as Contact
    from .ice.mesh_file import MeshError as MeshError
    from .ice.parameters import Ice as Ice
    from .model import BeltIceModel as BeltIceModel
    from .output import FieldSeries as FieldSeries
    from .output import RigView as RigView
    from .output import collection as collection
    from .output import rig_view as rig_view
    from .parameters import Ambient as Ambient
    from .parameters import ParameterError as ParameterError
    from .parameters import ThermalParameters as ThermalParameters
    from .steady_sliding import NoSteadyState as NoSteadyState
    from .steady_sliding import SlidingState as SlidingState
    from .steady_sliding import SteadySliding as SteadySliding

_HOMES = {
    ".belt.parameters": "Belt Layer",
    ".belt.single_pass": "SinglePass",
    ".contact.parameters": "Contact",
    ".ice.mesh_file": "MeshError",
    ".ice.parameters": "Ice",
    ".model": "BeltIceModel",
    ".output": "FieldSeries RigView collection rig_view",
    ".parameters": "Ambient ParameterError ThermalParameters",
    ".steady_sliding": "NoSteadyState SlidingState SteadySliding",
}
_HOME = {name: home for home, names in _HOMES.items() for name in names.split()}
__all__ = sorted(_HOME)


def __getattr__(name: str) -> Any:
    """Import on first use: who reads parameters needs no finite elements."""
    if name in _HOME:
        return getattr(import_module(_HOME[name], __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return __all__
