"""Co-simulation master: couples participants through named ports with units.

It knows of a participant nothing but its ports; which models there are is none of its business.
What couples the models of this product is in `cosim.coupling.case`.
"""

from stickslip.lazy import lazy

# a participant in a process of its own needs no master
__getattr__, __dir__, __all__ = lazy(__name__, __file__)
