"""Named parameters to the kernel's vector ``p``. Pure Python: it travels inside the FMU."""

from collections.abc import Mapping

from .draws import draws
from .kernel.layout import GRAVITY, P_SIZE
from .kernel.packing.vector import pack as pack_in_order
from .names import NAMES

__all__ = ["GRAVITY", "in_order", "pack"]


def pack(values: Mapping[str, float]) -> list[float]:
    """Kernel vector ``p`` from a mapping ``table.parameter`` -> value in SI units.

    The names are those of `Parameters.flat`, which are the FMU's; ``rig.inertia`` = 0 stands for a
    disc of the contact radius. The values are taken as checked.
    """
    v = in_order(values)
    p = [0.0] * P_SIZE
    pack_in_order(v, draws(v), p)
    return p


def in_order(values: Mapping[str, float]) -> list[float]:
    """The kernel's array ``v``: the parameters' values in the order of its places."""
    return [float(values[name]) for name in NAMES]
