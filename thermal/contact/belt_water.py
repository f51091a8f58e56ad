"""Melt water that the belt carries away, freezes and thaws again.

Water that leaves the contact lies on the belt's face. Where the face would end a step below the
melting point, the water freezes and its heat warms the face, but not above the melting point; where
the face would end above it, ice on the belt thaws in the same way. What is still water when it
comes under the block again joins the film.

Approximated: water and ice on the belt have no heat capacity of their own (10 um of ice hold 3 % of
a belt's 588 J/m2K), so freezing gives the belt at once all that melting took; what freezing in
one place does to its neighbours within a step is taken as if all places froze. Nothing dries the
belt, but a wiper in front of the contact may take water and ice off it.
"""

import math

import numpy as np

from thermal.arrays import Array

from .footprint import strip_loads


class BeltWater:
    """`water` and `frozen` (cells,), kg on the belt at its nodes, `cell` (m) apart.

    melt_heat: J for a kilogram; melting: the melting point, K above the air.
    """

    def __init__(self, cells: int, cell: float, melt_heat: float, melting: float) -> None:
        self.water: Array = np.zeros(cells)
        self.frozen: Array = np.zeros(cells)
        self._cell = cell
        self._melt_heat = melt_heat
        self._melting = melting

    @property
    def wet(self) -> bool:
        """Whether there is anything on the belt."""
        return bool(self.water.any() or self.frozen.any())

    def lay(self, mass: float, edge: float, movement: float) -> None:
        """Lay down mass (kg) evenly where an edge of the contact (m) passes in a movement (m)."""
        if mass <= 0.0:
            return
        half = 0.5 * self._cell
        first, loads = strip_loads(np.array([-half, half]), 1.0, edge, movement, self._cell)
        share = loads[0] / loads[0].sum()
        np.add.at(self.water, (first + np.arange(share.size)) % self.water.size, mass * share)

    def wipe(self, edge: float, movement: float, share: float) -> tuple[float, float]:
        """Masses (kg) of water and of ice that a wiper takes off the nodes it passes.

        It stands where the edge (m) does and moves along; share: what it takes of either.
        """
        low, high = sorted((edge, edge + movement))
        nodes = np.arange(math.ceil(low / self._cell), math.ceil(high / self._cell))
        nodes = np.unique(nodes % self.water.size)
        taken = share * float(self.water[nodes].sum()), share * float(self.frozen[nodes].sum())
        self.water[nodes] *= 1.0 - share
        self.frozen[nodes] *= 1.0 - share
        return taken

    def pick_up(self, centre: float, length: float) -> float:
        """Mass (kg) of water on the nodes below the contact, a cell from its edges; taken away."""
        reach = 0.5 * length / self._cell - 1.0
        first = int(np.ceil(centre / self._cell - reach))
        count = min(int(np.floor(centre / self._cell + reach)) - first + 1, self.water.size)
        nodes = (first + np.arange(max(0, count))) % self.water.size
        taken = float(self.water[nodes].sum())
        self.water[nodes] = 0.0
        return taken

    def freeze(self, duration: float, face: Array, response: float) -> Array:
        """Freeze and thaw over a step; power into the belt's face (cells,) W per node.

        face: at the end of the step if nothing froze, K (cells,); response: its rise for 1 W on
        every node, K/W.
        """
        wanted = (self._melting - face) * (duration / (response * self._melt_heat))
        mass = np.clip(wanted, -self.frozen, self.water)
        self.water -= mass
        self.frozen += mass
        return mass * (self._melt_heat / duration)
