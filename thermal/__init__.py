"""Heat in belt and ice: scikit-fem assembles, exact propagators advance, meshio writes.

>>> from thermal import BeltIceModel, ThermalParameters
>>> model = BeltIceModel(ThermalParameters())
>>> model.step(duration=0.01, heat=0.03, displacement=0.0015)
>>> abs(model.outputs()["heat_residual"]) < 1e-12
True
"""

from stickslip.lazy import lazy

# who reads parameters needs no finite elements
__getattr__, __dir__, __all__ = lazy(__name__, __file__)
