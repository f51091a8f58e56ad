"""Melt water: the film under the ice, and what the belt carries away.

Water between ice and belt: fed by melting, dragged out by the belt, squeezed out by the ice.

The film is shared evenly by the contact. In Couette flow the water moves at half the belt's speed
on the average, and a film that grows evenly along the way under the ice is twice as thick at the
exit as in the mean: so the belt drags out |v| h per width, and each bit of water stays for one
residence l/|v|,

    dh/dt = melt rate - |v| h / l - 2 p h^3 / (3 eta a^2),

h the mean thickness, l the length of the contact. The last term is the slow approach of a disc of
radius a under the pressure p to a plane through water of viscosity eta (Stefan 1874; Reynolds
1886). Melting, shear and squeeze are the balance that Colbeck (The kinetic friction of snow,
J. Glaciol. 34, 1988) takes for a melt film. Each term is advanced exactly, melting and shear
together, then the squeeze.

Where the shear of the film itself is all that melts, melt rate = eta v^2 / (rho L h), so that a
steady film is h = sqrt(eta v l / (rho L)) thick and is sheared with sqrt(eta v rho L / l). The
latter is exact: along the way x the film grows as sqrt(4 eta v x / (rho L)), and that is the mean
of eta v / h over it. (Water that moved with the belt, at twice the speed, would leave a film that
is thinner by the root of two, and sheared with sqrt(2 eta v rho L / l).)

Melt water that the belt carries away, freezes and thaws again.

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
from thermal.materials import WATER_DENSITY, WATER_VISCOSITY

from .footprint import strip_loads


class MeltFilm:
    """`mass` (kg) of water under the ice, and `squeezed` (kg) out of its sides since the start.

    area m2 and length m of the contact; pressure Pa.
    """

    def __init__(self, area: float, length: float, pressure: float) -> None:
        self._area, self._length = area, length
        #: dh/dt = -squeeze h^3, 1/(m2 s); a^2 = area / pi.
        self._squeeze = 2.0 * pressure * math.pi / (3.0 * WATER_VISCOSITY * area)
        self.mass: float = 0.0
        self.squeezed: float = 0.0

    @property
    def thickness(self) -> float:
        """Mean over the contact, m."""
        return self.mass / (WATER_DENSITY * self._area)

    def available(self, displacement: float) -> float:
        """Most mass (kg) that can freeze evenly over a step in which the belt moves (m)."""
        residences = abs(displacement) / self._length
        if residences == 0.0:
            return self.mass
        return self.mass * residences / math.expm1(residences)

    def advance(self, duration: float, displacement: float, melted: float) -> float:
        """Advance by duration (s); the mass (kg) that the belt took along behind the contact.

        melted: kg, evenly over the step; negative: frozen, at most what is `available`.
        """
        residences = abs(displacement) / self._length
        kept = 1.0 if residences == 0.0 else -math.expm1(-residences) / residences
        # all of it may freeze, but for rounding
        whole = max(0.0, self.mass + melted)
        stays = min(whole, max(0.0, self.mass * math.exp(-residences) + melted * kept))
        self.mass = stays
        thickness = self.thickness
        self.mass = stays / math.sqrt(1.0 + 2.0 * self._squeeze * thickness**2 * duration)
        self.squeezed += stays - self.mass
        return whole - stays


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
