"""Water between ice and belt: fed by melting, dragged out by the belt, squeezed out by the ice.

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
"""

import math

from thermal.materials import WATER_DENSITY, WATER_VISCOSITY


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
